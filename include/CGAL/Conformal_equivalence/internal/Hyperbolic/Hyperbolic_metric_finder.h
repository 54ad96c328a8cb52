// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The engine of `compute_hyperbolic_metric()`: Newton's method on the energy of Hyperbolic_energy.h in `double`, then a few steps with the residual
// of a wide number type. There is nothing to try in turn as in the plane: with flips there is exactly one metric for all angle sums
// that leave any area, and the energy is strictly convex.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_METRIC_FINDER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_METRIC_FINDER_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Hyperbolic_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Hyperbolic_energy.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Hyperbolic_linear_solver.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Delaunay_flipper.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/tell_flips.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Component_scales.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Edge_graph.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/Solver/feasibility.h>
#include <CGAL/Conformal_equivalence/internal/Solver/line_search.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Whether there can be a hyperbolic metric, decided before anything is computed. By Gauss-Bonnet the area of a component is what the prescribed
// angles leave of the total angle that a flat metric would have, and must be positive; so must be what is left for vertices of fixed u. Writes the
// area, or a bound of it where u is fixed, by component.
template <typename NT>
Outcome check_hyperbolic(const Intrinsic_triangulation<NT>& t, const Surface_components& pieces, const Conformal_conditions<NT>& conditions,
                         std::vector<double>& area)
{
  Outcome result = check_numbers(t, conditions);
  if(result.status == Status::OK)
    result = check_angle_ranges(t, conditions, false);
  if(result.status != Status::OK)
    return result;
  const std::vector<Angle_balance<NT> > balances = angle_balances(t, pieces, conditions);
  for(std::size_t c = 0; c < balances.size(); ++c) // the surfaces that need cones
    if(pieces.components[c].euler_characteristic() >= 0 && balances[c].fixed.empty() && balances[c].curved.empty())
    {
      if(result.faces.empty())
        result.amount = 2 * Number_constants<double>::pi() * double(pieces.components[c].euler_characteristic());
      result.status = Status::WRONG_TOPOLOGY;
      result.faces.push_back(pieces.components[c].first_face);
    }
  area.clear();
  for(std::size_t c = 0; c < balances.size() && result.status == Status::OK; ++c)
  {
    area.push_back(balances[c].radians());
    if(area.back() > 0)
      continue;
    result.status = balances[c].fixed.empty() ? Status::GAUSS_BONNET_VIOLATED : Status::NO_ANGLE_LEFT;
    result.amount = area.back();
    result.vertices = balances[c].fixed.empty() ? balances[c].curved : balances[c].fixed;
  }
  return result;
}

template <typename NT>
class Hyperbolic_metric_finder
{
public:
  typedef Hyperbolic_metric<NT> Metric;
  typedef typename Metric::Wide_number Wide;
  typedef std::uint32_t Index;

  // `t` with Euclidean lengths
  Hyperbolic_metric_finder(Intrinsic_triangulation<NT> t, const Conformal_conditions<NT>& conditions, const Solver_options& options,
                           std::unique_ptr<Factorization> factorization)
    : given_(std::move(t)), conditions_(conditions), options_(options), linear_(std::move(factorization), metric_.statistics),
      graph_(linear_.graph())
  {}

  Hyperbolic_metric_finder(const Hyperbolic_metric_finder&) = delete; // parts refer to one another
  Hyperbolic_metric_finder& operator=(const Hyperbolic_metric_finder&) = delete;

  Metric find()
  {
    const Stopwatch stopwatch;
    try
    {
      run();
    }
    catch(const std::bad_alloc&)
    {
      metric_ = Metric();
      metric_.status = Status::OUT_OF_MEMORY;
    }
    metric_.statistics.seconds.solve = stopwatch.seconds();
    return std::move(metric_);
  }

  // Gives the factors s of the metric `found` by find(), which was a success, more digits, until the residual is within `goal`, or there is nothing
  // to gain. Each step gains a dozen. Returns the residual.
  template <typename Number>
  Number improve(const Metric& found, std::vector<Number>& s, const Number& goal)
  {
    Scaled_vector residual = hyperbolic_residual(found.triangulation, s, conditions_);
    Number size = residual.template largest<Number>();
    const int most_steps = 100;
    double longest = 0;
    for(int step = 0; step < most_steps && size > goal && add_step(found.triangulation, residual, size, s, longest); ++step) {}
    return size;
  }

private:
  void run()
  {
    CGAL_precondition(conditions_.size() == given_.number_of_vertices() && !conditions_.has_bounds());
    options_.visitor.on_stage(Stage::SOLVE);
    metric_.triangulation = given_;
    if(given_.number_of_faces() == 0)
      return fail(Status::EMPTY_MESH);
    const Surface_components pieces = connected_components(given_);
    std::vector<double> area;
    metric_.set_outcome(check_hyperbolic(given_, pieces, conditions_, area));
    if(metric_.status != Status::OK || !make_delaunay_if_asked())
      return;
    begin(pieces, area);
    for(Index e = 0; e < given_.number_of_edges(); ++e)
      metric_.triangulation.set_length(e, NT(metric_.triangulation.length(e) / 2));
    energy_ = std::make_unique<Hyperbolic_energy<NT> >(metric_.triangulation);
    metric_.status = minimize_and_refine();
    tell();
  }

  void fail(Status status) { metric_.status = status; }

  // With `Retriangulation::ALWAYS` the intrinsic Delaunay triangulation of the metric given is that which is scaled.
  bool make_delaunay_if_asked()
  {
    if(options_.retriangulation != Retriangulation::ALWAYS)
      return true;
    if(make_intrinsic_delaunay(metric_.triangulation, metric_.faces, [&](Index e) { metric_.flips.push_back(e); }))
      return true;
    metric_.status = Status::DEGENERATE_METRIC;
    return false;
  }

  // Where u is fixed, so it is; elsewhere it begins where it is asked to, or where the Euclidean area of its component is what the hyperbolic one
  // is to be.
  void begin(const Surface_components& pieces, const std::vector<double>& area)
  {
    const Index n = given_.number_of_vertices();
    std::vector<char> free(n, 1);
    std::vector<double> euclidean(pieces.components.size(), 0.);
    for(Index f = 0; f < given_.number_of_faces(); ++f)
    {
      const Incircle_form<NT> triangle(given_.halfedge_length(3 * f), given_.halfedge_length(3 * f + 1), given_.halfedge_length(3 * f + 2));
      euclidean[pieces.component_of_vertex[given_.origin(3 * f)]] += static_cast<double>(NT(triangle.r * triangle.s));
    }
    u_ = options_.initial_log_scale_factors;
    const bool is_given = !u_.empty();
    u_.resize(n, 0.);
    for(Index v = 0; v < n; ++v)
    {
      const Index c = pieces.component_of_vertex[v];
      free[v] = !given_.is_isolated_vertex(v) && !conditions_.is_fixed(v);
      if(!free[v])
        u_[v] = given_.is_isolated_vertex(v) ? 0 : static_cast<double>(conditions_.log_scale_factor(v));
      else if(!is_given && euclidean[c] > 0)
        u_[v] = std::log(area[c] / euclidean[c]);
    }
    graph_.set_free(free);
    target_.assign(n, 0.);
    for(Index v = 0; v < n; ++v)
      if(free[v])
        target_[v] = conditions_.angle_sum(v).template radians<double>();
  }

  // The angle sums less their targets where these are prescribed. Returns their largest difference, or infinity.
  double evaluate(const Vertex_vector& u, Vertex_vector& r)
  {
    ++metric_.statistics.number_of_evaluations;
    is_moved_ = true;
    const bool is_finite = energy_->evaluate(u);
    r = energy_->angle_sums();
    for(Index v = 0; v < r.size(); ++v)
      r[v] -= target_[v];
    graph_.clear_fixed(r);
    return is_finite ? largest_entry(r) : std::numeric_limits<double>::infinity();
  }

  // Below this a residual cannot be told from rounding.
  double rounding_floor() const
  {
    const std::vector<double> sensitivity = energy_->sensitivities();
    double largest = 0;
    for(Index v = 0; v < target_.size(); ++v)
      if(graph_.is_free(v))
        largest = (std::max)(largest, sensitivity[v]);
    return 4 * std::numeric_limits<double>::epsilon() * largest;
  }

  // The same, found once, as it costs as much as an evaluation, when the residual is near to it.
  double known_floor(double size)
  {
    double& floor = metric_.statistics.residual_floor;
    if(floor == 0 && size <= 1e-4)
      floor = rounding_floor();
    return floor;
  }

  // d = H^-1 r on the free vertices, with the Hessian where the energy was last evaluated.
  bool solve(const Vertex_vector& r, double tolerance, Vertex_vector& d)
  {
    prepare_matrix();
    return linear_.solve(r, tolerance, d);
  }

  void prepare_matrix()
  {
    if(!is_moved_)
      return;
    hessian_ = energy_->hessian();
    linear_.set_matrix(metric_.triangulation, energy_->number_of_changes(), hessian_);
    is_moved_ = false;
  }

  // How accurately the next step is solved for, as in the plane: not to spoil quadratic convergence.
  double forcing_term(double tolerance) const
  {
    const std::vector<double>& history = metric_.statistics.residuals;
    const double size = history.back();
    const double gain = history.size() < 2 ? 1 : size / history[history.size() - 2];
    return (std::min)(1e-2, (std::max)(0.1 * gain * gain, 0.1 * tolerance / size));
  }

  // Half of the digits are enough where the last steps follow, each of which doubles their number, too. Where these come to nothing, all that
  // `double` has.
  Status minimize_and_refine()
  {
    const double near_enough = 1e-7;
    Status result = Status::ITERATIONS_EXHAUSTED;
    for(const double tolerance : {(std::max)(options_.gradient_tolerance, near_enough), options_.gradient_tolerance})
    {
      result = minimize(tolerance);
      if(result != Status::OK)
        return result;
      result = refine();
      if(result != Status::ITERATIONS_EXHAUSTED)
        return result;
    }
    return result;
  }

  Status minimize(double tolerance)
  {
    Vertex_vector r, d;
    metric_.statistics.residual_floor = 0; // not known yet
    double size = evaluate(u_, r);
    for(; ; ++metric_.statistics.number_of_iterations)
    {
      record(size);
      if(!std::isfinite(size))
        return Status::ITERATIONS_EXHAUSTED;
      if(size <= (std::max)(tolerance, known_floor(size)))
        return Status::OK;
      if(!options_.visitor.go_further())
        return Status::STOPPED_BY_VISITOR;
      if(metric_.statistics.number_of_iterations == options_.number_of_iterations)
        return Status::ITERATIONS_EXHAUSTED;
      if(!solve(r, forcing_term(tolerance), d))
        return Status::SINGULAR_PROBLEM;
      if(!step(d, r, size))
        return size <= 10 * rounding_floor() ? Status::OK : Status::ITERATIONS_EXHAUSTED;
    }
  }

  void record(double size)
  {
    metric_.statistics.residuals.push_back(size);
    metric_.statistics.residual = size;
    options_.visitor.on_iteration(metric_.statistics.number_of_iterations, size);
  }

  // Goes along d, from u, as far as E does not rise at the end more than half as steeply as it falls at the beginning. The slope of 2 E along d is
  // -r.d.
  bool step(const Vertex_vector& d, Vertex_vector& r, double& size)
  {
    const double slope = dot(r, d), longest_step = 5; // in u: far away triangulations are flipped in vain
    const double first = (std::min)(1., longest_step / largest_entry(d)), least = 1e-6 * first;
    if(!(slope > 0))
      return false;
    Vertex_vector trial(u_.size()), next;
    for(double t = first; t > least; )
    {
      for(Index v = 0; v < u_.size(); ++v)
        trial[v] = u_[v] + t * d[v];
      const double next_size = evaluate(trial, next);
      const double next_slope = std::isfinite(next_size) ? dot(next, d) : -std::numeric_limits<double>::infinity();
      if(next_slope >= -0.5 * slope)
      {
        u_.swap(trial);
        r.swap(next);
        size = next_size;
        return true;
      }
      t = shorter_step(t, slope, next_slope);
    }
    size = evaluate(u_, r);
    return false;
  }

  // The last steps, with the residual in the wide type and the linear systems in `double`: each gains as many digits as these have. They go on
  // until there is nothing to gain, as what is laid out adds up all residuals. A step with an error e^3 in s is as good as any.
  Status refine()
  {
    using std::exp;
    metric_.amount = 0;
    std::vector<Wide>& s = metric_.scale_factors;
    s.resize(u_.size());
    for(Index v = 0; v < u_.size(); ++v)
      s[v] = graph_.is_free(v) || given_.is_isolated_vertex(v) ? Wide(std::exp(u_[v] / 2))
                                                               : Wide(exp(Wide(Wide(conditions_.log_scale_factor(v)) / 2)));
    const int most_rounds = 10;  // of flips that rounding in `double` had hidden
    const int most_steps = 1000; // of a dozen digits each
    const Wide goal = (std::min)(Wide(options_.gradient_tolerance / 1e4), Wide(std::numeric_limits<Wide>::epsilon() * 1e4));
    Wide size(0);
    for(int round = 0; round < most_rounds; ++round)
    {
      Scaled_vector residual = hyperbolic_residual(metric_.triangulation, s, conditions_);
      size = residual.template largest<Wide>();
      double longest = 0; // of all entries of the last step
      for(int step = 0; step < most_steps && size > goal && add_step(metric_.triangulation, residual, size, s, longest); ++step)
        if(longest > 1e-12 && move_energy_to(s)) // that far the Hessian is another one
        {
          residual = hyperbolic_residual(metric_.triangulation, s, conditions_);
          size = residual.template largest<Wide>();
        }
      if(!energy_->make_delaunay(s))
        break;
      move_energy_to(s);
    }
    metric_.statistics.residual = static_cast<double>(size);
    metric_.statistics.residuals.push_back(metric_.statistics.residual);
    if(metric_.statistics.residual <= options_.gradient_tolerance)
      return Status::OK;
    metric_.amount = metric_.statistics.residual;
    const double floor = static_cast<double>(std::numeric_limits<Wide>::epsilon()) / std::numeric_limits<double>::epsilon() * rounding_floor();
    metric_.statistics.residual_floor = 8 * floor;
    return metric_.amount <= 8 * floor ? Status::CONVERGED_TO_ROUNDING : Status::ITERATIONS_EXHAUSTED;
  }

  // Evaluates the energy at s, rounded. Returns whether edges were flipped.
  bool move_energy_to(const std::vector<Wide>& s)
  {
    for(Index v = 0; v < u_.size(); ++v)
      u_[v] = 2 * std::log(static_cast<double>(s[v]));
    const std::size_t changes = energy_->number_of_changes();
    energy_->evaluate(u_);
    is_moved_ = true;
    return energy_->number_of_changes() != changes;
  }

  // One step, if it makes the residual smaller. Returns whether that is less than half of what it was.
  template <typename Number>
  bool add_step(const Intrinsic_triangulation<NT>& t, Scaled_vector& residual, Number& size, std::vector<Number>& s, double& longest)
  {
    using std::ldexp;
    Vertex_vector right = residual.entries, d;
    graph_.clear_fixed(right);
    // no more digits than quadratic convergence has
    const double tolerance = (std::min)(1e-3, (std::max)(1e-13, 1e-2 * static_cast<double>(size)));
    if(!solve(right, tolerance, d))
      return false;
    longest = std::ldexp(largest_entry(d), residual.exponent);
    std::vector<Number> moved = s;
    for(Index v = 0; v < d.size(); ++v)
      if(d[v] != 0)
      {
        const Number step = ldexp(Number(d[v]), residual.exponent);
        moved[v] = factor_after_step(s[v], step);
      }
    Scaled_vector next = hyperbolic_residual(t, moved, conditions_);
    const Number next_size = next.template largest<Number>();
    if(!(next_size < size))
      return false;
    const bool is_worth_it = next_size < size / 2;
    s.swap(moved);
    residual = std::move(next);
    size = next_size;
    return is_worth_it;
  }

  // u, the area, the faces at fault and figures.
  void tell()
  {
    Statistics& statistics = metric_.statistics;
    metric_.flips.insert(metric_.flips.end(), energy_->flips().begin(), energy_->flips().end());
    tell_flips(options_.retriangulation, energy_->flipper(), metric_);
    if(!is_success(metric_.status))
    {
      metric_.faces = energy_->broken_faces();
      metric_.amount = statistics.residual;
      metric_.scale_factors.clear();
      return;
    }
    prepare_matrix(); // for improve(): the triangulation is about to be handed over
    for(const Wide& s : metric_.scale_factors)
      metric_.log_scale_factors.push_back(logarithm_of_factor<NT>(s));
    judge();
    double least = 0, largest = 0;
    for(Index v = 0; v < u_.size(); ++v)
    {
      const double u = static_cast<double>(metric_.log_scale_factors[v]);
      least = v == 0 ? u : (std::min)(least, u);
      largest = v == 0 ? u : (std::max)(largest, u);
    }
    statistics.least_u = least;
    statistics.largest_u = largest;
  }

  // Sums up the area, and names the faces that are no triangles.
  void judge()
  {
    for(Index f = 0; f < metric_.triangulation.number_of_faces(); ++f)
    {
      const auto x = [&](Index h) { return static_cast<double>(metric_.wide_half_sinh(h)); };
      const Hyperbolic_sides<double> sides(x(3 * f), x(3 * f + 1), x(3 * f + 2));
      metric_.area += hyperbolic_area(sides);
      if(!sides.triangle().is_triangle && !scaled_sides(metric_.triangulation, metric_.scale_factors, f).triangle().is_triangle)
        metric_.faces.push_back(f);
    }
    if(!metric_.faces.empty())
      metric_.status = Status::DEGENERATE_METRIC;
  }

  const Intrinsic_triangulation<NT> given_;
  const Conformal_conditions<NT>& conditions_;
  const Solver_options& options_;
  Metric metric_;
  Hyperbolic_linear_solver linear_;
  Edge_graph& graph_; // that of the linear systems
  std::unique_ptr<Hyperbolic_energy<NT> > energy_;
  Coupled_vertices hessian_;
  bool is_moved_ = true; // since `hessian_` was found
  Vertex_vector u_, target_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_METRIC_FINDER_H
