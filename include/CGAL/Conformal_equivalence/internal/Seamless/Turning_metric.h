// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Metrics on the way to one that turns as it should (Turning_newton.h), and what brings them back to prescribed angle sums.
//
// Each is held by the lengths of a triangulation of its own that is Delaunay. In every conformal class there is one metric with given angle sums up
// to scale, and finding it is a convex problem (Springborn, "Ideal hyperbolic polyhedra and discrete uniformization", 2020). So whatever
// is done to the lengths, angle sums are had again by a conformal change and flips; nothing but the turnings of loops is left to Newton's
// method, and these depend on what is done to the conformal class only. Long thin handles, of which the scale factors range far, make angle sums as
// functions of lengths so curved that steps would otherwise have to be tiny.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TURNING_METRIC_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TURNING_METRIC_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Delaunay_flipper.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Metric_finder.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Cross_ratio_changes.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Dual_loops.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Turning_equations.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/delaunay_predicate.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/flipped_length.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// By edge, of lengths.
inline std::vector<double> logarithms(const std::vector<double>& lengths)
{
  std::vector<double> result;
  for(double l : lengths)
    result.push_back(std::log(l));
  return result;
}

// log((a c + b d) / e), by the logarithms of all lengths and the edges of the quadrilateral.
inline double log_ptolemy_length(const std::vector<double>& logarithm, const std::array<std::uint32_t, 5>& x)
{
  const double one = logarithm[x[1]] + logarithm[x[3]], other = logarithm[x[2]] + logarithm[x[4]];
  return (std::max)(one, other) + std::log1p(std::exp(-std::abs(one - other))) - logarithm[x[0]];
}

// A metric whose triangulation is on its way, with the loops on it. The status is `OK`, `CONVERGED_TO_ROUNDING`, `ITERATIONS_EXHAUSTED`,
// `SINGULAR_PROBLEM`, `STOPPED_BY_VISITOR`.
struct Turning_metric : public Outcome
{
  typedef std::uint32_t Index;

  Intrinsic_triangulation<double> triangulation;
  Dual_loops loops;
  std::vector<Index> flips;           // of the triangulation given, in order
  std::size_t number_of_steps = 0;
  double least_step = 1;              // the least part of a Newton step that was taken
  std::vector<double> residuals;      // largest differences from the targets (radians): before each step, and at the end

  std::vector<double> reference;      // by edge: log l of the metric from which departures are measured; empty: there are none

  double residual() const { return residuals.empty() ? 0 : residuals.back(); }

  // From here on.
  void follow_departure()
  {
    reference = logarithms(triangulation.lengths());
  }

  // By how much the logarithms of the length cross ratios are others than those of the reference.
  Eigen::VectorXd departure() const
  {
    Eigen::VectorXd change(Eigen::Index(reference.size()));
    for(Index e = 0; e < reference.size(); ++e)
      change[e] = 2 * (std::log(triangulation.length(e)) - reference[e]);
    return cross_ratio_changes(triangulation, change);
  }

  // It is called right before an edge of the triangulation, or of a conformally equivalent one, is flipped.
  void carry_through_flip(Index e)
  {
    loops.flip(triangulation, e);
    flips.push_back(e);
    if(!reference.empty())
      reference[e] = log_ptolemy_length(reference, quad_edges(triangulation, e));
  }
};

// The triangulation of a metric, with the scaled lengths.
template <typename NT>
Intrinsic_triangulation<NT> scaled_triangulation(const Conformal_metric<NT>& metric)
{
  std::vector<NT> lengths;
  for(std::uint32_t e = 0; e < metric.triangulation.number_of_edges(); ++e)
    lengths.push_back(metric.scaled_length(metric.triangulation.edge_halfedge(e)));
  return metric.triangulation.with_lengths(std::move(lengths));
}

// Carries loops through flips, of which the lengths do not matter.
template <typename NT>
void carry_through_flips(const std::vector<std::uint32_t>& flips, Intrinsic_triangulation<NT> t, Dual_loops& loops)
{
  for(std::uint32_t e : flips)
  {
    loops.flip(t, e);
    t.flip_edge(e, t.length(e));
  }
}

// A metric of `t`, which is found with its triangulation.
template <typename NT>
Conformal_metric<NT> metric_with_triangulation(Intrinsic_triangulation<NT> t, const Conformal_conditions<NT>& conditions,
                                               const Solver_options& options, std::unique_ptr<Factorization> factorization)
{
  Metric_finder<NT> finder(std::move(t), std::move(factorization));
  Conformal_metric<NT> result = finder.find(conditions, options);
  if(!result.is_retriangulated())
    result.triangulation = finder.take_triangulation();
  if(result.is_doubled)
    result.status = Status::ITERATIONS_EXHAUSTED;
  return result;
}

// Brings metrics back to what is prescribed for the vertices.
class Turning_projection
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<double> Triangulation;

public:
  // `t` has the vertices of all metrics.
  Turning_projection(const Triangulation& t, const Turning_targets& targets, double tolerance, const Factorization_maker& make_factorization,
                     const Any_visitor& visitor)
    : conditions_(t), make_factorization_(make_factorization)
  {
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      if(!targets.is_free.empty() && targets.is_free[v])
        conditions_.fix_log_scale_factor(v, 0.);
      else
        conditions_.prescribe_angle_sum(v, targets.angle_sum[v]);
    options_.gradient_tolerance = tolerance;
    options_.border_edges = Border_edges::KEPT;
    options_.has_come_from_flips = true; // it is Delaunay, and no other triangulation is one of the same metric
    options_.is_estimate = true;         // the last digits are had by Newton's method for all equations together
    options_.visitor = Any_visitor::of(Asking_visitor(visitor));
  }

  // By Ptolemy flips, which leave the point in the space of all decorated hyperbolic metrics where it is. Returns `false` if there are too many, or
  // if it was stopped.
  bool make_delaunay(Turning_metric& metric) const
  {
    Delaunay_flipper<double> flipper(metric.triangulation);
    const bool is_done = flipper.flip_to_delaunay(std::vector<double>(), all_edges(metric.triangulation), Flip_rule::PTOLEMY,
                                                  [&](Index e) { metric.carry_through_flip(e); }, options_.visitor);
    if(flipper.is_stopped())
      metric.status = Status::STOPPED_BY_VISITOR;
    return is_done;
  }

  // To the angle sums, in the conformal class, up to `tolerance` (radians). Returns `false` if they cannot be found, or if it was stopped.
  bool make_conformal(Turning_metric& metric, double tolerance) const
  {
    Solver_options options = options_;
    options.gradient_tolerance = (std::max)(options_.gradient_tolerance, tolerance);
    const Conformal_metric<double> found = metric_with_triangulation(metric.triangulation, conditions_, options, make_factorization_());
    if(found.status == Status::STOPPED_BY_VISITOR)
      metric.status = found.status;
    if(!is_success(found.status) && !is_near(found))
      return false;
    for(Index e : found.flips)
    {
      metric.carry_through_flip(e);
      metric.triangulation.flip_edge(e, ptolemy_length(metric.triangulation, e));
    }
    metric.triangulation = scaled_triangulation(found);
    return make_delaunay(metric); // edges that the factors found have left at a tie
  }

private:
  // Where rounding of sharp triangles keeps the residual above the tolerance, it is for the steps that follow to make it less.
  static bool is_near(const Conformal_metric<double>& found)
  {
    const double near_enough = 1e-7; // radians
    return found.status == Status::ITERATIONS_EXHAUSTED && !found.scale_factors.empty() && found.faces.empty()
        && found.statistics.residual < near_enough;
  }

  Conformal_conditions<double> conditions_;
  Factorization_maker make_factorization_;
  Solver_options options_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TURNING_METRIC_H
