// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The engine of `Conformal_metric_solver`. It tries the triangulation as it is; where there is no solution on it, or none that is a
// metric, it goes on with Ptolemy flips of edges inside the surface; and where a border triangle still breaks, on the double of the
// surface, where border edges can be flipped, too (section 3 of Springborn, Schroeder and Pinkall, 2008; discrete uniformization of
// Gu, Luo, Sun and Wu, 2018).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_METRIC_FINDER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_METRIC_FINDER_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/number_conversions.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Folded_double.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Surface_double.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/ideal_delaunay_energy.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/resolve_degenerate_faces.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/tell_flips.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Component_scales.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Fixed_energy.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Newton_method.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Wide_refinement.h>
#include <CGAL/Conformal_equivalence/internal/Solver/feasibility.h>
#include <CGAL/Conformal_equivalence/internal/Solver/starting_point.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

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

// Tells the record of flips, and the edges of the linear systems, of every flip.
template <typename NT>
class Recording_flip_observer final : public Flip_observer<NT>
{
public:
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;

  Recording_flip_observer(std::vector<Index>& flips, Laplacian_solver& linear)
    : flips_(flips), linear_(linear), number_of_lasting_flips_(flips.size())
  {}

  void before_flip(const Triangulation&, Index e) override { flips_.push_back(e); }
  void after_flip(const Triangulation& t, Index e) override { linear_.change_edge(t, e); }

  void begin_anew(const Triangulation& t) override
  {
    flips_.resize(number_of_lasting_flips_);
    for(Index e = 0; e < t.number_of_edges(); ++e)
      linear_.change_edge(t, e);
  }

  void keep_flips() override { number_of_lasting_flips_ = flips_.size(); }

private:
  std::vector<Index>& flips_;
  Laplacian_solver& linear_;
  std::size_t number_of_lasting_flips_;
};

template <typename NT>
class Metric_finder
{
public:
  typedef Intrinsic_triangulation<NT> Triangulation;
  typedef Conformal_conditions<NT> Conditions;
  typedef Conformal_metric<NT> Metric;
  typedef typename Metric::Wide_number Wide_number;
  typedef typename Triangulation::Index Index;

  Metric_finder(Triangulation t, std::unique_ptr<Factorization> factorization);
  ~Metric_finder();

  Metric_finder(const Metric_finder&) = delete; // parts refer to one another
  Metric_finder& operator=(const Metric_finder&) = delete;

  const Triangulation& triangulation() const { return triangulation_; }
  const Surface_components& components() const { return pieces_; }

  // The triangulation of the result is set only if edges were flipped.
  Metric find(const Conditions& conditions, const Solver_options& options);

  // Takes the triangulation of a metric just found as the one given, for a problem that is nearly the same. What is known of the linear systems
  // is kept, but for a factor that is that of another triangulation.
  void go_on_from(const Metric& found)
  {
    triangulation_ = found.triangulation;
    fixed_energy_.reset();
    linear_has_flips_ = false;
    if(!found.flips.empty())
      linear_.forget_factor();
  }

  // Gives the surface away, and what was kept for the next problem. \pre nothing is asked any more
  Triangulation take_triangulation();

private:
  void try_in_turn(const Conditions& conditions, const Solver_options& options, Metric& result)
  {
    const Stopwatch stopwatch;
    const bool is_final = try_with_border_kept(conditions, options, result);
    if(!is_final && may_be_helped_by_flips(result) && may_be_doubled(options))
    {
      discard(result, stopwatch.seconds());
      go_on_from_foreseen([&] { solve_on_double(conditions, options, result); }, stopwatch, result);
    }
  }

  // Tries a way that goes on where the last one was given up, if it was; if it comes to nothing, once more from elsewhere: what was near to
  // the end of one way may be a bad place for another.
  template <typename Way>
  void go_on_from_foreseen(const Way& way, const Stopwatch& stopwatch, Metric& result)
  {
    way();
    if(result.status != Status::ITERATIONS_EXHAUSTED || foreseen_.empty() || has_given_up_)
      return;
    foreseen_.clear();
    discard(result, stopwatch.seconds());
    way();
  }

  // Where there are faces of no area, on the triangulation without these. Returns whether nothing else is to be tried.
  bool try_with_border_kept(const Conditions& conditions, const Solver_options& options, Metric& result)
  {
    if(options.retriangulation != Retriangulation::WHEN_NEEDED || options.has_come_from_flips || degenerate_faces(triangulation_).empty())
      return try_fixed_and_flipping(conditions, options, result);
    Triangulation resolved = triangulation_;
    const std::vector<Index> flips = resolve_degenerate_faces(resolved);
    if(flips.empty())
      return try_fixed_and_flipping(conditions, options, result);
    exchange_triangulation(resolved);
    const bool is_final = try_fixed_and_flipping(conditions, options, result);
    exchange_triangulation(resolved);
    if(!result.is_retriangulated())
      result.triangulation = std::move(resolved);
    put_resolving_flips_first(flips, result);
    return is_final;
  }

  CGAL_CONFORMAL_EQUIVALENCE_COLD
  void exchange_triangulation(Triangulation& other)
  {
    std::swap(triangulation_, other);
    fixed_energy_.reset();
    linear_has_flips_ = true;
  }

  bool try_fixed_and_flipping(const Conditions& conditions, const Solver_options& options, Metric& result)
  {
    const Stopwatch stopwatch;
    if(options.retriangulation != Retriangulation::ALWAYS && !options.has_come_from_flips)
    {
      solve_fixed(conditions, options, result);
      if(options.retriangulation == Retriangulation::NEVER || !may_be_helped_by_flips(result))
        return true;
    }
    if(foreseen_.empty() && !options.has_come_from_flips)
      linear_.forget_factor(); // that of an attempt that has gone astray
    const Metric refused = result.status == Status::ANGLE_OUT_OF_RANGE ? result : Metric();
    discard(result, stopwatch.seconds());
    go_on_from_foreseen([&] { solve_flipping(conditions, options, result); }, stopwatch, result);
    const bool says_less = refused.status == Status::ANGLE_OUT_OF_RANGE && is_balance_violated(result.status);
    if(says_less)
      result = refused; // it may be the reason why the angles sum up to what cannot be
    return says_less;
  }

  // Do the prescribed angles sum up to what cannot be?
  static bool is_balance_violated(Status status)
  {
    return status == Status::GAUSS_BONNET_VIOLATED || status == Status::NO_ANGLE_LEFT;
  }

  // Where a triangulation, as it is, or with its border, has no solution, or none that is a metric.
  static bool may_be_helped_by_flips(const Metric& result)
  {
    return result.status == Status::DEGENERATE_METRIC || result.status == Status::ITERATIONS_EXHAUSTED
        || result.status == Status::SINGULAR_PROBLEM
        || (result.status == Status::ANGLE_OUT_OF_RANGE && result.amount > 0);
  }

  // Begins anew.
  static void discard(Metric& result, double seconds)
  {
    Metric next;
    next.statistics.seconds.discarded = seconds;
    next.statistics.number_of_discarded_iterations =
      result.statistics.number_of_discarded_iterations + result.statistics.number_of_iterations;
    result = std::move(next);
  }

  bool may_be_doubled(const Solver_options& options) const
  {
    return options.border_edges == Border_edges::FLIPPABLE
        && std::any_of(pieces_.components.begin(), pieces_.components.end(),
                       [](const Surface_components::Component& c) { return c.number_of_borders > 0; });
  }

  // For one way of several: may it be given up, as there is another one? Where the last steps follow, each of which doubles the number of digits,
  // too, half of the digits is enough; where active bounds are to be told from others, it is not.
  static Newton_options newton_options(const Solver_options& options, const Lower_bounds& bounds, bool may_give_up)
  {
    const double near_enough = 1e-7; // its square is less than a residual in `double` can tell
    Newton_options result;
    result.tolerance = options.is_estimate || !bounds.empty() ? options.gradient_tolerance : (std::max)(options.gradient_tolerance, near_enough);
    result.number_of_iterations = options.number_of_iterations;
    result.strategy = options.newton_strategy;
    result.may_give_up = may_give_up;
    const double square_roots_in_range = 600; // e^{u / 2}, and lengths for it, leave room for products and for digits below
    if(has_range_of_double<NT>())
      result.largest_u = square_roots_in_range;
    return result;
  }

  // ---- The three ways

  // On the triangulation as it is.
  void solve_fixed(Conditions conditions, const Solver_options& options, Metric& result)
  {
    options.visitor.on_stage(Stage::SOLVE);
    if(!check(conditions, true, result))
      return;
    if(!fixed_energy_)
      fixed_energy_ = std::make_unique<Fixed_energy<NT> >(triangulation_, true);
    if(linear_has_flips_)
      linear_.set_edges(triangulation_);
    linear_has_flips_ = false;
    minimize(*fixed_energy_, conditions, options, options.retriangulation == Retriangulation::WHEN_NEEDED, result);
  }

  // On a copy of the triangulation, which is flipped on the way.
  void solve_flipping(Conditions conditions, const Solver_options& options, Metric& result)
  {
    options.visitor.on_stage(Stage::SOLVE);
    if(!check(conditions, false, result))
      return;
    const Stopwatch stopwatch;
    result.triangulation = triangulation_;
    if(linear_has_flips_)
      linear_.set_edges(triangulation_); // else the factor that is there serves, if there is one
    linear_has_flips_ = true;
    Recording_flip_observer<NT> observer(result.flips, linear_);
    if(!make_delaunay_if_asked(options, observer, result))
      return;
    const double seconds = stopwatch.seconds();
    Flipping_energy<NT> energy(result.triangulation, observer);
    energy.ideal().set_visitor(options.visitor);
    minimize(energy, conditions, options, may_be_doubled(options), result);
    tell_about_flips(energy.ideal(), seconds, options, result);
  }

  // On the double, where border edges can be flipped, too. The unknowns are those of the surface.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  void solve_on_double(Conditions conditions, const Solver_options& options, Metric& result)
  {
    options.visitor.on_stage(Stage::SOLVE);
    if(!check(conditions, false, result))
      return;
    const Surface_double<NT> twofold(triangulation_);
    result.is_doubled = result.statistics.is_doubled = true;
    result.triangulation = twofold.triangulation;
    Folded_double<NT> folded(triangulation_, twofold, result.triangulation);
    const Stopwatch stopwatch;
    linear_.change_edges(folded); // the factor still serves, as the matrix is that of the surface until edges are flipped
    linear_has_flips_ = true;
    Folded_flip_observer<NT> observer(result.flips, linear_, folded);
    if(!make_delaunay_if_asked(options, observer, result))
      return;
    const double seconds = stopwatch.seconds();
    Folded_energy<NT> energy(result.triangulation, folded, observer);
    energy.ideal().set_visitor(options.visitor);
    minimize(energy, conditions, options, false, result);
    unfold(folded, energy, conditions, options.gradient_tolerance, result);
    tell_about_flips(energy.ideal(), seconds, options, result);
    if(is_success(result.status))
      result.lost_border_edges = twofold.lost_border_edges(triangulation_, result.triangulation, result.flips);
  }

  // With `Retriangulation::ALWAYS`: makes the triangulation of the result the intrinsic Delaunay triangulation of the metric given, by
  // Euclidean flips. Returns whether that is possible.
  bool make_delaunay_if_asked(const Solver_options& options, Flip_observer<NT>& observer, Metric& result) const
  {
    if(options.retriangulation != Retriangulation::ALWAYS)
      return true;
    std::vector<Index> flipped;
    const bool is_possible = make_intrinsic_delaunay(result.triangulation, result.faces, [&](Index e)
    {
      observer.before_flip(result.triangulation, e);
      flipped.push_back(e);
    }, options.visitor);
    if(!is_possible && result.faces.empty())
    {
      result.status = Status::STOPPED_BY_VISITOR;
      return false;
    }
    if(!is_possible)
    {
      // those of the surface come before their images
      result.faces.erase(std::lower_bound(result.faces.begin(), result.faces.end(), triangulation_.number_of_faces()), result.faces.end());
      result.status = Status::DEGENERATE_METRIC;
      return false;
    }
    for(Index e : flipped)
      observer.after_flip(result.triangulation, e);
    observer.keep_flips();
    return true;
  }

  // Gives the images of vertices their factors, too. Where the triangulation is not symmetric, as the diagonal of a trapezoid is
  // not, its lengths are symmetric up to rounding only; then so are the angle sums.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  void unfold(const Folded_double<NT>& t, Folded_energy<NT>& energy, Conditions conditions, double tolerance, Metric& result) const
  {
    result.scale_factors = t.spread(result.scale_factors);
    if(!is_success(result.status))
      return;
    for(Index v : result.active_bounds)
      conditions.fix_log_scale_factor(v, NT(conditions.lower_bound(v)));
    Statistics& statistics = result.statistics;
    const double residual = largest_residual(t, result.scale_factors, conditions), before = statistics.residual;
    if(residual <= before)
      return;
    statistics.residual = statistics.residuals.back() = residual;
    if(residual <= (std::max)(tolerance, before))
      return;
    double rounding = 0; // of lengths
    for(Index e = 0; e < result.triangulation.number_of_edges(); ++e)
      rounding = (std::max)(rounding, energy.ideal().flipper().length_error(e));
    statistics.residual_floor =
      (std::max)(statistics.residual_floor, before + 8 * rounding * largest_sensitivity(energy, linear_.graph()));
    result.amount = residual;
    result.status = residual <= statistics.residual_floor ? Status::CONVERGED_TO_ROUNDING : Status::ITERATIONS_EXHAUSTED;
    if(!is_success(result.status))
      result.scale_factors.clear();
  }

  static void tell_about_flips(Ideal_delaunay_energy<NT>& energy, double seconds_before, const Solver_options& options, Metric& result)
  {
    const Stopwatch stopwatch;
    tell_flips(options.retriangulation, energy.flipper(), result);
    result.statistics.seconds.flips = seconds_before + energy.seconds_of_flips() + stopwatch.seconds();
  }

  // ---- Newton's method and what comes before and after

  // Makes the conditions feasible, or says why they are not.
  bool check(Conditions& conditions, bool triangulation_is_fixed, Metric& result)
  {
    CGAL_precondition(conditions.size() == triangulation_.number_of_vertices());
    if(triangulation_.number_of_faces() == 0)
    {
      result.status = Status::EMPTY_MESH;
      return false;
    }
    const Feasibility feasibility = make_feasible(triangulation_, pieces_, conditions, triangulation_is_fixed);
    result.set_outcome(feasibility);
    result.statistics.angle_defect_spread = feasibility.angle_defect_spread;
    scales_.set_resting(feasibility.rests_on_bounds);
    return feasibility.status == Status::OK;
  }

  void minimize(Refinable_energy<NT>& energy, const Conditions& conditions, const Solver_options& options, bool may_give_up, Metric& result)
  {
    has_given_up_ = false;
    energy.set_concurrency(Concurrency(options.number_of_threads));
    linear_.set_number_of_threads(options.number_of_threads);
    linear_.set_free(scales_.free_vertices(conditions));
    const Lower_bounds bounds = scales_.lower_bounds(conditions);
    hold_one_of_each(bounds);
    const std::size_t factorizations_before = linear_.number_of_factorizations();

    Vertex_vector u = first_guess(options);
    const Starting_point start = move_to_fixed_factors(energy, linear_, triangulation_, conditions, u);
    result.status = start.has_factor ? Status::OK : Status::SINGULAR_PROBLEM;
    if(result.status == Status::OK)
      run_newton(energy, targets(conditions), options, newton_options(options, bounds, may_give_up), bounds, start.is_evaluated, u, result);
    const bool is_found = is_solution(result);
    const double residual_in_double = result.statistics.residual;
    if(result.status == Status::OK)
    {
      Wide_refinement<NT> last_steps(energy, linear_, scales_, conditions, bounds, options.gradient_tolerance);
      last_steps.set_visitor(options.visitor);
      if(options.is_estimate)
        last_steps.begin(u, result);
      else
        last_steps.run(u, result);
    }
    if(is_success(result.status) && conditions.has_bounds())
      scales_.settle(conditions, result.scale_factors);
    if(options.is_estimate && result.status == Status::ITERATIONS_EXHAUSTED) // the last u may still tell what is to be changed
      Wide_refinement<NT>::begin_at(conditions, u, result.scale_factors);
    if(leaves_range(energy) && (result.status == Status::ITERATIONS_EXHAUSTED || !are_factors(result.scale_factors)))
      tell_range(u, is_found, residual_in_double, result);
    else if(is_success(result.status) || !result.scale_factors.empty())
      keep(result.scale_factors, conditions, u, result);
    result.statistics.number_of_factorizations = linear_.number_of_factorizations() - factorizations_before;
    result.statistics.number_of_regularized_rows = linear_.number_of_regularized_rows();
    judge(energy, options.is_estimate, result);
  }

  // Where numbers range too far for the last steps, to the tolerance itself.
  void run_newton(Refinable_energy<NT>& energy, const Vertex_vector& target, const Solver_options& options, Newton_options newton_options,
                  const Lower_bounds& bounds, bool is_evaluated, Vertex_vector& u, Metric& result)
  {
    Newton_method newton(energy, linear_, target, newton_options, result.statistics, options.visitor, bounds);
    result.status = newton(u, is_evaluated);
    has_given_up_ = newton.has_given_up();
    if(newton.has_come_near())
      foreseen_ = u;
    has_left_needles_ = newton.has_left_needles();
    if(result.status != Status::OK || has_left_needles_ || newton_options.tolerance <= options.gradient_tolerance || !leaves_range(energy))
      return;
    newton_options.tolerance = options.gradient_tolerance;
    result.status = Newton_method(energy, linear_, target, newton_options, result.statistics, options.visitor, bounds)(u, true);
  }

  static bool leaves_range(const Abstract_energy& energy) { return has_range_of_double<NT>() && energy.ranges_far(); }

  // Else the matrix of a component that rests on its bounds is singular.
  void hold_one_of_each(const Lower_bounds& bounds)
  {
    if(bounds.empty())
      return;
    std::vector<char> held(triangulation_.number_of_vertices(), 0);
    for(const Index v : bounds.largest([](Index) { return 0; }))
      held[v] = 1;
    linear_.hold(std::move(held));
  }

  // Where an attempt was given up, if it was, else the u given, else the last solution, else zero.
  Vertex_vector first_guess(const Solver_options& options) const
  {
    if(!foreseen_.empty())
      return foreseen_;
    if(!options.initial_log_scale_factors.empty())
    {
      CGAL_precondition(options.initial_log_scale_factors.size() == triangulation_.number_of_vertices());
      return options.initial_log_scale_factors;
    }
    return last_u_.empty() ? Vertex_vector(triangulation_.number_of_vertices(), 0.) : last_u_;
  }

  Vertex_vector targets(const Conditions& conditions) const
  {
    Vertex_vector result(triangulation_.number_of_vertices(), 0.);
    for(Index v = 0; v < result.size(); ++v)
      if(!conditions.is_fixed(v))
        result[v] = conditions.angle_sum(v).template radians<double>();
    return result;
  }

  // Are all positive numbers with all their digits, as e^{u/2} is where it is in range?
  static bool are_factors(const std::vector<Wide_number>& s)
  {
    return std::all_of(s.begin(), s.end(), [](const Wide_number& x) { return x > 0 && std::isnormal(static_cast<double>(x)); });
  }

  // Is u, in `double`, the solution? It may also be as near to it as rounding allows, which among needles says nothing.
  bool is_solution(const Metric& result) const
  {
    const double close = 1e-3; // radians: more than rounding leaves where lengths range far, far less than needles cost
    return result.status == Status::OK && !has_left_needles_ && result.statistics.residual <= close;
  }

  // What `NT` cannot hold. If Newton's method has found the metric, u by itself is it nevertheless.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  static void tell_range(const Vertex_vector& u, bool is_found, double residual_in_double, Metric& result)
  {
    tell_extremes(u, result.statistics);
    result.scale_factors.clear();
    if(is_success(result.status))
      result.status = Status::ITERATIONS_EXHAUSTED;
    if(!is_found)
      return;
    result.status = Status::SCALE_OUT_OF_RANGE;
    result.statistics.residual = residual_in_double;
    result.amount = result.statistics.largest_u - result.statistics.least_u;
    result.faces.clear();
    for(const double x : u)
      result.log_scale_factors.push_back(NT(x));
  }

  static void tell_extremes(const Vertex_vector& u, Statistics& statistics)
  {
    const auto extremes = std::minmax_element(u.begin(), u.end());
    statistics.least_u = *extremes.first;
    statistics.largest_u = *extremes.second;
  }

  // The logarithms of the factors; those that are at their bounds, up to rounding, are these.
  void keep(const std::vector<Wide_number>& s, const Conditions& conditions, Vertex_vector& u, Metric& result)
  {
    using std::abs;
    result.log_scale_factors.resize(u.size());
    for(Index v = 0; v < u.size(); ++v)
    {
      NT& x = result.log_scale_factors[v];
      x = logarithm_of_factor<NT>(s[v]);
      if(conditions.is_bounded(v) && !triangulation_.is_isolated_vertex(v))
      {
        const NT& bound = conditions.lower_bound(v);
        const NT rounding = 4 * std::numeric_limits<NT>::epsilon() * (1 + abs(bound));
        if(x - bound <= rounding)
        {
          x = bound;
          result.active_bounds.push_back(v);
        }
      }
      u[v] = static_cast<double>(x);
    }
    tell_extremes(u, result.statistics);
    last_u_ = u;
  }

  // Names the triangles that the metric found breaks: exactly for a solution, as the last
  // evaluation saw them otherwise.
  static void judge(const Refinable_energy<NT>& energy, bool is_estimate, Metric& result)
  {
    if(is_success(result.status))
    {
      result.faces = energy.faces_violated_at(result.scale_factors);
      if(!result.faces.empty())
        result.status = Status::DEGENERATE_METRIC;
      return;
    }
    if(result.status == Status::ITERATIONS_EXHAUSTED)
    {
      result.faces = energy.broken_faces();
      result.amount = result.statistics.residual;
    }
    if(!is_estimate)
      result.scale_factors.clear();
  }

  Triangulation triangulation_;
  const Surface_components pieces_;
  Component_scales<NT> scales_;
  Laplacian_solver linear_;
  std::unique_ptr<Fixed_energy<NT> > fixed_energy_;
  Vertex_vector last_u_;
  Vertex_vector foreseen_; // where an attempt was given up on the way to its end, if any was
  bool has_given_up_ = false; // the last attempt, as triangles would have remained broken
  bool has_left_needles_ = false; // the last attempt, to the last steps
  bool linear_has_flips_ = false; // the edges of `linear_` are not those of `triangulation_`
};

template <typename NT>
Metric_finder<NT>::Metric_finder(Triangulation t, std::unique_ptr<Factorization> factorization)
  : triangulation_(std::move(t)), pieces_(connected_components(triangulation_)), scales_(triangulation_, pieces_),
    linear_(std::move(factorization))
{
  linear_.set_edges(triangulation_);
}

template <typename NT>
Metric_finder<NT>::~Metric_finder()
{}

template <typename NT>
Intrinsic_triangulation<NT> Metric_finder<NT>::take_triangulation()
{
  fixed_energy_.reset();
  return std::move(triangulation_);
}

template <typename NT>
Conformal_metric<NT> Metric_finder<NT>::find(const Conditions& conditions, const Solver_options& options)
{
  const Stopwatch stopwatch;
  Metric result;
  foreseen_.clear();
  try
  {
    try_in_turn(conditions, options, result);
  }
  catch(const std::bad_alloc&)
  {
    result = Metric();
    result.status = Status::OUT_OF_MEMORY;
  }
  result.statistics.seconds.solve = stopwatch.seconds();
  return result;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template Metric_finder<double>::Metric_finder(Intrinsic_triangulation<double>, std::unique_ptr<Factorization>);
extern template Metric_finder<double>::~Metric_finder();
extern template Intrinsic_triangulation<double> Metric_finder<double>::take_triangulation();
extern template Conformal_metric<double> Metric_finder<double>::find(const Conditions&, const Solver_options&);
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_METRIC_FINDER_H
