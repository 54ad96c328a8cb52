// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A surface of genus 0 as an inscribed polyhedron: points of the sphere at its vertices, whose chords are discretely conformally equivalent to the
// edges (section 4.3 of Springborn, Schroeder and Pinkall, 2008).
//
// One vertex, the apex p, is sent to infinity. The edges l_ip become infinitely long parallels; u_i = -2 log l_ip at the link of p says that they
// begin at the same height (up to a constant for all: their typical length is the unit, so that u does not depend on scale). What remains of the
// surface is a disk, flat where it is inside:
//
//            p                            |   |     |   |
//          / | \ .                        |   |     |   |          the disk is laid out in the plane, and
//        /   |   \                        i---j-----k---l          projected to the sphere from the pole,
//       i----j----k     ---> infinity      \  | \  / \ /           where p is.
//        \  / \  /                          \ |  \/   /
//          .....                              . . . .
//
// On the triangulation as it is, triangles of the result may be flipped. With flips, the polyhedron is convex for every surface
// (I. Rivin, 1996; Springborn, 2020, section 7): u minimizes the energy of the rest of the surface subject to u_i + 2 log l_ip >= 0 for the edges ip
// of the current triangulation, and the active conditions make the link. Here the link is found by exchange: it is kept while
// the disk is made flat, then
//  - a link edge jk on which the triangle jkm has become longer than its other two sides is flipped to pm: m would violate its condition;
//  - an edge ip where the disk has an angle above pi is flipped, too: i is not held any more.
// The link of a vertex with well-shaped triangles hardly ever changes.
//
// Ties. Where m lies on one circle with p, j and k, the triangle jkm is flat, with an angle of pi at m, and rounding decides which of both
// conditions is violated. Neither matters: every triangulation that Ptolemy's relation leads to stands for the same ideal hyperbolic polyhedron, so
// that any triangulation of a cell with more than three corners gives the same points, and one that is concave by d at an edge moves them by
// the order of d^2, as the energy is twice continuously differentiable. A flat triangle in the disk, however, makes the problem as good as
// insoluble: its angles change like the root of its lengths. So m is taken in as soon as jkm is nearly flat, and let go only where
// the angle is larger than pi by more than what that makes it; and as no vertex is let go more than a few times, the exchange ends. It is
// first done with angle sums that are right to 1e-3 and 1e-6, as accurately as a nearly flat triangle lets them be in `double`; where they cannot be
// had, as the link is far from the one looked for, what came out tells nevertheless which triangles are to be taken in. Then all of them are made
// right, and the link is settled by bounds that are as narrow as that allows; last, without any, and if that is not possible, what was found before
// is the result.
//
// A surface with one border is treated in the same way with an apex on the border, where all other angles but those of the link are to be pi: the
// disk is then the part above a straight line of one that is symmetric about it, and the border becomes a circle.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IDEAL_POLYHEDRON_FINDER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IDEAL_POLYHEDRON_FINDER_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Metric_finder.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Apex_star.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Ideal_polyhedron.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Punctured_surface.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Stereographic_placement.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename NT>
class Ideal_polyhedron_finder
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;
  typedef Conformal_metric<NT> Metric;
  typedef Ideal_polyhedron<NT> Polyhedron;

public:
  // The triangulation is kept as a reference.
  Ideal_polyhedron_finder(const Triangulation& t, const Solver_options& options, Factorization_maker make_factorization)
    : given_(t), options_(options), make_factorization_(std::move(make_factorization))
  {}

  // On the triangulation as it is.
  Polyhedron on_fixed_triangulation(Index apex, const Symmetry_axis& axis) const
  {
    Polyhedron result;
    result.apex = apex;
    result.triangulation = given_;
    result.unit = typical_spoke(given_, apex);
    const Punctured_surface<NT> rest(given_, apex);
    if(!rest.is_disk())
      return refused(std::move(result), Status::SINGULAR_PROBLEM);
    Solver_options options = precise_options();
    options.retriangulation = Retriangulation::NEVER;
    const Metric metric = solve(rest.triangulation, conditions(result, rest.triangulation), options);
    take_over(metric, result);
    for(Index f : metric.faces)
      result.faces.push_back(rest.original_face[f]);
    if(is_success(result.status))
      place(metric, axis, result);
    return result;
  }

  // With flips: the convex polyhedron. `start` is a triangulation that `flips` have made of the one given.
  Polyhedron convex(Triangulation start, std::vector<Index> flips, Index apex, const Symmetry_axis& axis) const
  {
    Polyhedron result;
    result.apex = apex;
    result.triangulation = std::move(start);
    result.flips = std::move(flips);
    result.unit = typical_spoke(result.triangulation, apex);
    Metric metric;
    std::unique_ptr<Rest> rest;
    // A nearly flat triangle with an angle of pi - d has two sides that are by d^2 / 8 longer than the third: these are angles of 3e-3 and 1e-3.
    settle_link(1e-3, Link_bounds{1e-6, 3e-2, most_releases_}, result, metric, rest);
    if(is_success(result.status))
      settle_link(finest_estimate_, Link_bounds{1e-7, 1e-2, most_releases_}, result, metric, rest);
    if(is_success(result.status))
      settle_precisely(result, metric, rest);
    if(is_success(result.status))
      place(metric, axis, result);
    return result;
  }

private:
  // The surface without the triangles at the apex, and the solver for it: they last as long as the link is the same.
  struct Rest
  {
    Punctured_surface<NT> surface;
    Metric_finder<NT> finder;

    Rest(Punctured_surface<NT> s, std::unique_ptr<Factorization> factorization)
      : surface(std::move(s)), finder(surface.triangulation, std::move(factorization))
    {}
  };

  // With all the digits there are, and where these are not to be had, as the user wants it.
  void settle_precisely(Polyhedron& result, Metric& metric, std::unique_ptr<Rest>& rest) const
  {
    const Link_bounds bounds{0, 1e-5, 2 * most_releases_};
    const Polyhedron rough = result;
    const Metric rough_metric = metric;
    settle_link(precise_options().gradient_tolerance, bounds, result, metric, rest);
    if(!is_success(result.status) && result.status != Status::STOPPED_BY_VISITOR)
    {
      const Statistics statistics = result.statistics;
      result = rough;
      result.statistics = statistics;
      metric = rough_metric;
      rest.reset();
      settle_link(options_.gradient_tolerance, bounds, result, metric, rest);
    }
    if(is_success(result.status))
      settle_strictly(result, metric);
  }

  // Lets go what is reflex by more than rounding, if the polyhedron without these edges is found, too.
  void settle_strictly(Polyhedron& result, Metric& metric) const
  {
    const Link_bounds bounds{0, 1e-13, 3 * most_releases_}; // an angle sum whose residual is as small as `double` lets it be
    Polyhedron strict = result;
    Metric strict_metric = metric;
    if(!Apex_star<NT>(strict).exchange(Punctured_surface<NT>(result.triangulation, result.apex), metric, bounds))
      return;
    std::unique_ptr<Rest> strict_rest;
    settle_link(precise_options().gradient_tolerance, bounds, strict, strict_metric, strict_rest);
    if(!is_success(strict.status))
      return;
    result = std::move(strict);
    metric = std::move(strict_metric);
  }

  // Flattens the rest of the surface and changes the link in turn, until there is nothing to change. Begins at the factors of `metric`,
  // if it has any, and, if there is one, with the `rest` for the link as it is.
  void settle_link(double tolerance, const Link_bounds& bounds, Polyhedron& result, Metric& metric, std::unique_ptr<Rest>& rest) const
  {
    Solver_options options = precise_options();
    options.gradient_tolerance = tolerance;
    options.retriangulation = Retriangulation::WHEN_NEEDED;
    options.border_edges = Border_edges::KEPT;
    options.has_come_from_flips = true;
    options.is_estimate = tolerance >= finest_estimate_;
    for(int round = 0; round < most_exchanges_; ++round)
    {
      Apex_star<NT> star(result);
      if(rest)
        rest->finder.go_on_from(metric);
      else
      {
        star.prepare();
        Punctured_surface<NT> surface(result.triangulation, result.apex);
        if(!surface.is_disk())
        {
          result = refused(std::move(result), Status::SINGULAR_PROBLEM);
          return;
        }
        rest = std::make_unique<Rest>(std::move(surface), make_factorization_());
      }
      options.initial_log_scale_factors = rounded(metric.log_scale_factors);
      metric = rest->finder.find(conditions(result, rest->finder.triangulation()), options);
      take_over(metric, result);
      if(metric.scale_factors.empty())
        return;
      star.repeat_flips(rest->surface, metric);
      if(!star.exchange(rest->surface, metric, bounds))
        return;
      rest.reset();
      ++result.number_of_exchanges;
    }
    result = refused(std::move(result), Status::ITERATIONS_EXHAUSTED);
  }

  static Polyhedron refused(Polyhedron result, Status status)
  {
    result.status = status;
    result.vertices.assign(1, result.apex);
    return result;
  }

  // Points are to be right relative to the smallest chords; what the user asks for is judged at the end.
  Solver_options precise_options() const
  {
    const double least = std::is_same<NT, double>::value ? 1e-24 : 0; // the steps end where pairs of `double` do; other numbers say themselves where
    Solver_options result = options_;
    result.initial_log_scale_factors.clear();
    result.gradient_tolerance = (std::min)(options_.gradient_tolerance, least);
    return result;
  }

  static std::vector<double> rounded(const std::vector<NT>& numbers)
  {
    std::vector<double> result;
    for(const NT& x : numbers)
      result.push_back(static_cast<double>(x));
    return result;
  }

  // The geometric mean of the lengths of the edges at the apex, to a power of two.
  static double typical_spoke(const Triangulation& t, Index apex)
  {
    double sum = 0, number = 0;
    t.for_each_outgoing(apex, [&](Index h)
    {
      sum += std::log2(static_cast<double>(t.halfedge_length(h)));
      number += 1;
    });
    return std::isfinite(sum) && number > 0 ? std::exp2(std::round(sum / number)) : 1;
  }

  // What is left of the surface is flat, with a straight border but for the link of the apex.
  Conformal_conditions<NT> conditions(const Polyhedron& polyhedron, const Triangulation& rest) const
  {
    using std::log;
    const Triangulation& t = polyhedron.triangulation;
    const Index apex = polyhedron.apex;
    Conformal_conditions<NT> result(rest);
    for(Index v = 0; v < rest.number_of_vertices(); ++v)
      if(!rest.is_isolated_vertex(v) && rest.is_border_vertex(v))
        result.prescribe_angle_sum(v, Exact_angle<NT>::pi_times(1));
    t.for_each_outgoing(apex, [&](Index h)
    {
      for(Index e : {t.edge(h), t.edge(t.previous(h))})
        result.fix_log_scale_factor(t.origin(t.edge_halfedge(e)) == apex ? t.target(t.edge_halfedge(e)) : t.origin(t.edge_halfedge(e)),
                                    NT(-2 * log(NT(t.length(e) / polyhedron.unit))));
    });
    return result;
  }

  Metric solve(Triangulation rest, const Conformal_conditions<NT>& conditions, const Solver_options& options) const
  {
    Metric_finder<NT> finder(std::move(rest), make_factorization_());
    Metric result = finder.find(conditions, options);
    if(!result.is_retriangulated())
      result.triangulation = finder.take_triangulation();
    return result;
  }

  void take_over(const Metric& metric, Polyhedron& result) const
  {
    const Statistics before = result.statistics;
    result.statistics = metric.statistics;
    result.statistics += before;
    result.status = metric.status;
    result.amount = metric.amount;
    result.vertices = metric.vertices;
    if(metric.status == Status::CONVERGED_TO_ROUNDING && metric.statistics.residual <= options_.gradient_tolerance)
    {
      result.status = Status::OK;
      result.amount = 0;
    }
  }

  static void place(const Metric& metric, const Symmetry_axis& axis, Polyhedron& result)
  {
    Stereographic_placement<NT> placement(metric);
    placement(axis, result);
  }

  static constexpr double finest_estimate_ = 1e-6; // of angle sums, see above
  // The link hardly ever changes, and each exchange brings it nearer to the minimum: that a vertex comes and goes more often, or that there are more
  // rounds, means that rounding moves it to and fro.
  static constexpr int most_releases_ = 4;
  static constexpr int most_exchanges_ = 100;

  const Triangulation& given_;
  const Solver_options options_;
  const Factorization_maker make_factorization_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IDEAL_POLYHEDRON_FINDER_H
