// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// From a conformally equivalent flat metric of a surface with handles, or several borders, to one that turns by multiples of 2 pi / n along all
// loops, which is what section 8 of Springborn, Schroeder and Pinkall, 2008, leaves open: in a conformal class the cones alone determine how
// handles turn. So the class is left, as little as it takes (Turning_equations.h).
//
// How the handles shall turn is chosen among all that is allowed: the integers m that minimize (m q - kappa)^T G (m q - kappa), where kappa are the
// turnings of a basis in the metric given, q = 2 pi / n. This is a closest vector of a lattice (closest_vector.h). With the form F of the
// deformations that change the turnings, to first order, G is F + diag F: F alone lets one loop turn far, if that makes others turn as they should,
// but what is said to first order does not hold so far; its diagonal alone would be rounding one by one. Where Newton's method does not find a
// metric, the next nearest are tried. The user may prescribe turnings of some loops, modulo n: each is a congruence for the m
// (congruent_vectors.h).
//
// Where u is prescribed at a border, as at natural ones, the border is free to bend, and its edges change their lengths as all others.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_HANDLE_TURNER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_HANDLE_TURNER_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Cross_ratio_changes.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Dual_loops.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Quantized_cone.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Seamless_signature.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Turning_equations.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Turning_metric.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Turning_newton.h>
#include <CGAL/Conformal_equivalence/internal/Lattices/closest_vector.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/congruent_vectors.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/homology_basis.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/loop_classes.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/flipped_length.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <CGAL/number_utils.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// What the user prescribes: how the curve on the left of a closed chain of halfedges turns, modulo n.
struct Prescribed_turning
{
  std::vector<std::uint32_t> chain;
  long quanta;
};

// What is told of the handles of a metric. The status is one of `Turning_metric`, or of a conformal solve, or `NOT_REALIZABLE`.
struct Turned_handles : public Outcome
{
  std::vector<Dual_loops::Loop> loops;     // a basis of the first homology, on the triangulation given
  std::vector<double> conformal_turnings;  // by loop (radians): before
  std::vector<long> quanta;                // by loop: after, in units of 2 pi / n
  std::vector<std::vector<long> > others;  // what may be tried next, the nearest first
  bool is_nearest = true;                  // whether they are proven to be those that take the least deformation, to first order
  Surface_existence existence = Surface_existence::PROVEN;
  double mean_departure = 0;               // root of the mean square of the changes of the logarithms of length cross ratios
  double largest_departure = 0;            // the largest one
  double residual = 0;                     // largest difference of a turning from its target (radians)
  Turning_metric start;                    // the metric given, Delaunay; empty if it turns as it should
  std::shared_ptr<Turning_equations> equations; // there; null: as they were not needed
  Eigen::MatrixXd form;                    // by loop: what it takes, to first order, to turn more
  std::size_t number_of_steps = 0;
  std::size_t number_of_flips = 0;
};

// `NT` is `double`: it is a template so that it can be compiled once (compiled.h).
template <typename NT>
class Handle_turner
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;
  typedef Conformal_metric<NT> Metric;
  typedef Dual_loops::Loop Loop;

public:
  // `metric` is a conformally equivalent one of `t`, a connected surface, with these conditions, all of which are angles inside the surface. It is
  // not doubled; if all vertices of a border have angles, these make it turn by a multiple of 2 pi / n. The cones have such multiples. What is
  // prescribed is for closed surfaces. Keeps references.
  Handle_turner(const Triangulation& t, const Metric& metric, const Conformal_conditions<NT>& conditions,
                const std::vector<Quantized_cone>& cones, int n, const std::vector<Prescribed_turning>& prescribed,
                const Solver_options& options, const Factorization_maker& make_factorization = Turning_newton_options().make_factorization);

  // Finds how the handles shall turn.
  Turned_handles choose() const;

  // The metric in which they do. \pre choose() was a success
  Metric turn(Turned_handles& handles) const;

private:
  double quantum() const { return 2 * CGAL_PI / double(n_); }

  // ---- The metric given

  // On the triangulation of the metric.
  Dual_loops carried(const std::vector<Loop>& given) const
  {
    Dual_loops loops(t_, given);
    carry_through_flips(metric_.flips, t_, loops);
    return loops;
  }

  // ---- What is prescribed

  // The congruences for the turnings of the basis; a chain that is not closed goes to `edges`.
  std::vector<Congruence> congruences(const std::vector<Loop>& basis, const std::vector<double>& turning, Outcome& outcome) const
  {
    if(prescribed_.empty())
      return {};
    const Homology_coordinates<NT> coordinates(t_, basis);
    const Triangulation s = scaled_triangulation(metric_);
    const Corner_angles corners(s);
    std::vector<Congruence> result;
    for(const Prescribed_turning& p : prescribed_)
    {
      if(!is_closed_chain(t_, p.chain))
      {
        refuse(p, outcome);
        continue;
      }
      Congruence c{coordinates(p.chain), 0};
      // Rotations are a homomorphism of the first homology and the loops around cones: what the basis does not tell is a multiple, too.
      double rest = turning_of_loop(loop_on_the_left(t_, p.chain), s, corners);
      for(std::size_t i = 0; i < basis.size(); ++i)
        rest -= double(c.factors[i]) * turning[i];
      c.value = p.quanta - std::lround(rest / quantum());
      result.push_back(std::move(c));
    }
    return result;
  }

  // A loop that is contracted turns once.
  double turning_of_loop(const Loop& loop, const Triangulation& s, const Corner_angles& corners) const
  {
    const Loop reduced = Dual_loops::reduced(t_, loop);
    return reduced.empty() ? 2 * CGAL_PI : turnings(s, carried({reduced}), corners).front();
  }

  void refuse(const Prescribed_turning& p, Outcome& outcome) const
  {
    outcome.status = Status::NOT_REALIZABLE;
    for(Index h : p.chain)
      if(h < t_.number_of_halfedges())
        outcome.edges.push_back(t_.edge(h));
  }

  void refuse_all(Outcome& outcome) const
  {
    for(const Prescribed_turning& p : prescribed_)
      refuse(p, outcome);
  }

  // ---- The choice

  bool has_border() const
  {
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      if(t_.is_border_vertex(v))
        return true;
    return false;
  }

  // What is known is known of closed surfaces.
  Surface_existence existence(std::vector<long> quanta) const
  {
    return has_border() ? Surface_existence::EXPECTED : internal::existence(signature(std::move(quanta)));
  }

  Seamless_signature signature(std::vector<long> quanta) const
  {
    Seamless_signature result;
    result.genus = quanta.size() / 2;
    result.symmetry = n_;
    for(const Quantized_cone& cone : cones_)
      result.cones.push_back(cone.quanta);
    result.loops = std::move(quanta);
    return result;
  }

  // Takes the nearest that is admitted and exists.
  void choose_among(const Congruent_vectors& admitted, Turned_handles& result) const
  {
    const std::size_t most = 32, most_nodes = 200000; // some tenths of a second, and more than are ever refused in a row
    const std::vector<double> turning = turnings(result.start.triangulation, result.start.loops, Corner_angles(result.start.triangulation));
    const Eigen::Index dimension = Eigen::Index(turning.size());
    Eigen::MatrixXd basis(dimension, dimension);
    Eigen::VectorXd target(dimension);
    for(Eigen::Index i = 0; i < dimension; ++i)
    {
      target[i] = turning[std::size_t(i)] / quantum() - double(admitted.origin[std::size_t(i)]);
      for(Eigen::Index j = 0; j < dimension; ++j)
        basis(i, j) = double(admitted.basis[std::size_t(j)][std::size_t(i)]);
    }
    result.form = deformation_form(result);
    if(result.form.rows() != dimension)
    {
      result.status = Status::SINGULAR_PROBLEM;
      return;
    }
    const Reduced_lattice lattice(basis.transpose() * result.form * basis);
    result.status = lattice.is_valid() ? Status::NOT_REALIZABLE : Status::SINGULAR_PROBLEM;
    if(!lattice.is_valid())
      return;
    const auto candidates = lattice.nearest_vectors(basis.partialPivLu().solve(target), most, most_nodes);
    for(const Lattice_vector& v : candidates)
    {
      std::vector<long> quanta(admitted.origin.begin(), admitted.origin.end());
      for(std::size_t j = 0; j < v.coefficients.size(); ++j)
        for(std::size_t i = 0; i < quanta.size(); ++i)
          quanta[i] += long(v.coefficients[j] * admitted.basis[j][i]);
      if(existence(quanta) == Surface_existence::IMPOSSIBLE)
        continue;
      if(bool(result))
        result.others.push_back(std::move(quanta));
      else
      {
        take(std::move(quanta), result);
        result.is_nearest = v.is_closest;
      }
    }
  }

  void take(std::vector<long> quanta, Turned_handles& result) const
  {
    result.existence = existence(quanta);
    result.quanta = std::move(quanta);
    result.status = Status::OK;
  }

  // x^T G x is about what it takes to make the loops turn by x more, in units of the quantum. On a Delaunay triangulation: the sharp angles of
  // others promise more than they can give. The equations are kept: they serve for the first step.
  Eigen::MatrixXd deformation_form(Turned_handles& handles) const
  {
    const Turning_metric& start = handles.start;
    const Turning_rows rows(start.triangulation, free_vertices_);
    handles.equations = std::make_shared<Turning_equations>(start.triangulation, start.loops, rows, make_factorization_());
    if(!handles.equations->factorize())
      return Eigen::MatrixXd(0, 0);
    Eigen::MatrixXd result = quantum() * quantum() * handles.equations->form();
    result.diagonal() *= 2;
    return result;
  }

  // ---- The metric found

  Turning_targets targets(const std::vector<long>& quanta) const
  {
    Turning_targets result;
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      result.angle_sum.push_back(conditions_.angle_sum(v).template radians<double>());
    for(long q : quanta)
      result.turning.push_back(double(q) * quantum());
    result.is_free = free_vertices_;
    return result;
  }

  // Whether they are already.
  bool are_turned(Turned_handles& handles) const
  {
    const double rounding = 1e-9; // of turnings in a metric of `double`s, amply
    handles.residual = largest_difference(handles.conformal_turnings, handles.quanta);
    return handles.residual < rounding;
  }

  // Of turnings from their targets (radians).
  double largest_difference(const std::vector<double>& turning, const std::vector<long>& quanta) const
  {
    double result = 0;
    for(std::size_t i = 0; i < turning.size(); ++i)
      result = (std::max)(result, std::abs(turning[i] - double(quanta[i]) * quantum()));
    return result;
  }

  Turning_newton_options newton_options() const
  {
    Turning_newton_options result;
    result.tolerance = options_.gradient_tolerance;
    result.visitor = options_.visitor;
    result.make_factorization = make_factorization_;
    return result;
  }

  // The metric given, Delaunay and with its angle sums: where the triangulation given is not, the metric on it has other turnings.
  Turning_metric start(const std::vector<Loop>& loops) const
  {
    const std::vector<long> any(loops.size(), 0);
    Turning_newton<NT> newton(scaled_triangulation(metric_), carried(loops), targets(any), newton_options());
    Turning_metric result = newton.begin();
    result.residuals.clear();
    return result;
  }

  // For the nearest turnings; if the method is not on its way to an end soon, for a few others, and what is found is put into `handles`. If
  // it is for none of them, once more for the nearest, with patience.
  Turning_metric find(Turned_handles& handles) const
  {
    const std::size_t most_others = 4;
    std::vector<std::vector<long> > others = handles.others;
    std::vector<long> quanta = handles.quanta;
    Turning_metric result = find(quanta, !others.empty(), handles);
    for(std::size_t n = 0; n < most_others && is_another_needed(result) && !others.empty(); ++n)
    {
      quanta = take_next(result, handles, others);
      result = find(quanta, true, handles);
    }
    if(is_another_needed(result) && !handles.others.empty())
    {
      quanta = handles.quanta;
      result = find(quanta, false, handles);
    }
    if(bool(result) && quanta != handles.quanta)
    {
      take(std::move(quanta), handles);
      handles.is_nearest = false;
    }
    return result;
  }

  static bool is_another_needed(const Turning_metric& found) { return !bool(found) && found.status != Status::STOPPED_BY_VISITOR; }

  Turning_metric find(const std::vector<long>& quanta, bool may_give_up, Turned_handles& handles) const
  {
    const double much = 1.4; // where little growth leads nowhere this may lead elsewhere
    Turning_newton_options options = newton_options();
    options.may_give_up = may_give_up;
    Turning_metric result = find(quanta, options, handles);
    if(!may_give_up && result.status == Status::ITERATIONS_EXHAUSTED)
    {
      options.growth_on_return = much;
      result = find(quanta, options, handles);
    }
    return result;
  }

  Turning_metric find(const std::vector<long>& quanta, Turning_newton_options options, Turned_handles& handles) const
  {
    const std::size_t soon = 60; // steps, of which four to twelve are usual, most of them with a single trial
    options.maximum_number_of_steps = (std::min)(options_.number_of_iterations, soon);
    options.maximum_number_of_trials = options.may_give_up ? soon : 4 * soon;
    const Turning_metric& start = handles.start;
    Turning_metric result = Turning_newton<NT>(start.triangulation, start.loops, targets(quanta), options, handles.equations).run();
    handles.number_of_steps += result.number_of_steps;
    return result;
  }

  // Of what is left to be tried, what is nearest both to the metric given and to where the last try has ended.
  std::vector<long> take_next(const Turning_metric& failed, const Turned_handles& handles, std::vector<std::vector<long> >& others) const
  {
    const std::vector<double> begun = turnings(handles.start.triangulation, handles.start.loops, Corner_angles(handles.start.triangulation)),
                              ended = turnings(failed.triangulation, failed.loops, Corner_angles(failed.triangulation));
    const auto cost = [&](const std::vector<long>& quanta, const std::vector<double>& turning)
    {
      Eigen::VectorXd x(Eigen::Index(quanta.size()));
      for(std::size_t i = 0; i < quanta.size(); ++i)
        x[Eigen::Index(i)] = double(quanta[i]) - turning[i] / quantum();
      return x.dot(handles.form * x);
    };
    const auto both = [&](const std::vector<long>& quanta) { return cost(quanta, begun) + cost(quanta, ended); };
    const auto next = std::min_element(others.begin(), others.end(), [&](const std::vector<long>& a, const std::vector<long>& b)
      { return both(a) < both(b); });
    std::vector<long> result = std::move(*next);
    others.erase(next);
    return result;
  }

  // The logarithms of the lengths that Ptolemy's theorem gives after flips, as the lengths themselves may leave the range of numbers.
  std::vector<double> flipped_logarithms(const std::vector<Index>& flips) const
  {
    Triangulation t = t_;
    std::vector<double> result = logarithms(t.lengths());
    for(Index e : flips)
    {
      result[e] = log_ptolemy_length(result, quad_edges(t, e));
      t.flip_edge(e, t.length(e));
    }
    return result;
  }

  // The metric whose scaled lengths are those of `found`, with the factors that come nearest to its departure; and its angle sums made those
  // of the conditions up to the rounding of the wide number type, by a conformal change too little to be seen elsewhere.
  Metric with_factors(const Triangulation& found, std::vector<double> u) const
  {
    for(Index v = 0; v < found.number_of_vertices(); ++v)
      if(conditions_.is_fixed(v))
        u[v] = conditions_.log_scale_factor(v);
    std::vector<NT> lengths;
    for(Index e = 0; e < found.number_of_edges(); ++e)
    {
      const Index h = found.edge_halfedge(e);
      lengths.push_back(found.length(e) * std::exp(-(u[found.origin(h)] + u[found.target(h)]) / 2));
    }
    Metric unknown;
    unknown.status = Status::SCALE_OUT_OF_RANGE;
    if(!std::all_of(lengths.begin(), lengths.end(), [](const NT& l) { return l > 0 && std::isfinite(l); }))
      return unknown;
    Solver_options options = options_;
    options.retriangulation = Retriangulation::WHEN_NEEDED;
    options.initial_log_scale_factors = u;
    return metric_with_triangulation(found.with_lengths(std::move(lengths)), conditions_, options, make_factorization_());
  }

  static std::vector<char> free_vertices(const Conformal_conditions<NT>& conditions)
  {
    std::vector<char> result(conditions.size(), 0);
    for(Index v = 0; v < result.size(); ++v)
      result[v] = conditions.is_fixed(v) ? 1 : 0;
    return result;
  }

  const Triangulation& t_;
  const Metric& metric_;
  const Conformal_conditions<NT>& conditions_;
  const std::vector<Quantized_cone>& cones_;
  const long n_;
  const std::vector<Prescribed_turning>& prescribed_;
  const Solver_options options_;
  const Factorization_maker make_factorization_;
  const std::vector<char> free_vertices_; // by vertex: u is prescribed, and the angle sum may be any
};

template <typename NT>
Handle_turner<NT>::Handle_turner(const Triangulation& t, const Metric& metric, const Conformal_conditions<NT>& conditions,
                                 const std::vector<Quantized_cone>& cones, int n, const std::vector<Prescribed_turning>& prescribed,
                                 const Solver_options& options, const Factorization_maker& make_factorization)
  : t_(t), metric_(metric), conditions_(conditions), cones_(cones), n_(n), prescribed_(prescribed), options_(options),
    make_factorization_(make_factorization), free_vertices_(free_vertices(conditions))
{}

template <typename NT>
Turned_handles Handle_turner<NT>::choose() const
{
  Turned_handles result;
  result.loops = homology_basis(t_);
  const Triangulation s = scaled_triangulation(metric_);
  result.conformal_turnings = turnings(s, carried(result.loops), Corner_angles(s));
  const std::vector<Congruence> conditions = congruences(result.loops, result.conformal_turnings, result);
  if(!bool(result))
    return result;
  const Congruent_vectors admitted(result.loops.size(), conditions, n_);
  if(admitted.is_empty)
  {
    refuse_all(result);
    return result;
  }
  // a torus without cones turns nowhere, and nothing can be deformed for that
  const bool is_flat_torus = result.loops.size() == 2 && cones_.empty() && !has_border();
  const std::vector<long> zero(result.loops.size(), 0);
  if(!is_flat_torus && !result.loops.empty())
  {
    result.start = start(result.loops);
    result.set_outcome(result.start);
    if(!bool(result))
      return result;
    choose_among(admitted, result);
  }
  else if(std::all_of(conditions.begin(), conditions.end(), [&](const Congruence& c) { return c.value % n_ == 0; }))
    take(zero, result);
  else
    result.status = Status::NOT_REALIZABLE;
  if(result.status == Status::NOT_REALIZABLE)
  {
    result.existence = Surface_existence::IMPOSSIBLE;
    for(const Quantized_cone& cone : cones_)
      result.vertices.push_back(cone.vertex);
    refuse_all(result);
  }
  return result;
}

template <typename NT>
Conformal_metric<NT> Handle_turner<NT>::turn(Turned_handles& handles) const
{
  if(are_turned(handles))
    return metric_;
  if(handles.start.loops.size() != handles.loops.size()) // a torus without cones, which rounding has turned
    handles.start = start(handles.loops);
  Turning_metric found = find(handles);
  handles.set_outcome(found);
  handles.residual = found.residual();
  Metric result;
  result.set_outcome(found);
  if(!bool(found))
    return result;

  found.flips.insert(found.flips.begin(), handles.start.flips.begin(), handles.start.flips.end());
  handles.number_of_flips = found.flips.size();
  std::vector<Index> flips = metric_.flips;
  flips.insert(flips.end(), found.flips.begin(), found.flips.end());
  const Conformal_departure departure(flipped_logarithms(flips), found.triangulation);
  handles.mean_departure = departure.mean;
  handles.largest_departure = departure.largest;
  result = with_factors(found.triangulation, departure.u);
  handles.status = result.status;
  handles.amount = result.amount;
  if(!bool(result))
    return result;
  carry_through_flips(result.flips, found.triangulation, found.loops);
  flips.insert(flips.end(), result.flips.begin(), result.flips.end());
  result.flips = std::move(flips);
  const Triangulation s = scaled_triangulation(result);
  handles.residual = largest_difference(turnings(s, found.loops, Corner_angles(s)), handles.quanta);
  return result;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template Handle_turner<double>::Handle_turner(const Intrinsic_triangulation<double>&, const Conformal_metric<double>&,
                                                     const Conformal_conditions<double>&, const std::vector<Quantized_cone>&, int,
                                                     const std::vector<Prescribed_turning>&, const Solver_options&,
                                                     const Factorization_maker&);
extern template Turned_handles Handle_turner<double>::choose() const;
extern template Conformal_metric<double> Handle_turner<double>::turn(Turned_handles&) const;
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_HANDLE_TURNER_H
