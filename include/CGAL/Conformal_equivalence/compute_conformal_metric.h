// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file compute_conformal_metric.h
/// The heart: conditions in, metric out. Finds, within the conformal class of a
/// metric, the one with prescribed angle sums at some vertices and prescribed scale
/// factors, or lower bounds on them, at the others (Problem in section 2.1, sections 3.1 and 4 of Springborn,
/// Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_CONFORMAL_METRIC_H
#define CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_CONFORMAL_METRIC_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Eigen_pattern_solver_traits.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Surface_double.h>
#include <CGAL/Conformal_equivalence/internal/Solver/energy.h>
#include <CGAL/Conformal_equivalence/internal/Solver/feasibility.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Folded_double.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/ideal_delaunay_energy.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/length_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Newton_method.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_newton_step.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <CGAL/Default.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceSolver
///
/// Solves for conformally equivalent metrics of one surface, again and again:
/// triangulation, ordering, pattern and factor are kept, and every solve begins at
/// the last solution. As long as the same vertices are free, changed conditions need
/// no new factor.
///
/// The method is Newton's on the convex energy E (equations (7) to (10)), extended as
/// in section 3.1 to lengths that violate the triangle inequality. A *Newton step* is
/// one linearization with an accepted step; its linear system is solved by conjugate
/// gradients, preconditioned by a factor of the Hessian at the first metric. The last
/// residual is measured and reduced in a wider number type.
///
/// Copies of solver traits of \ref thirdpartyEigen "Eigen" share one factor: give every solver its own.
///
/// \tparam NT_ number type of the lengths: `double`, `long double`, or a Boost.Multiprecision binary
///         floating-point number. The linear algebra runs in `double` for all of them.
/// \tparam SolverTraits_ a model of `SparseLinearAlgebraWithFactorTraits_d` for symmetric
///         matrices of `double`, best one of `SparseLinearAlgebraWithPatternTraits_d`;
///         the default is `Default_solver_traits`.
template <typename NT_ = double, typename SolverTraits_ = Default>
class Conformal_metric_solver
{
public:
  typedef NT_ NT;                                     ///< number type of lengths and of u

  /// the linear solver
  typedef typename Default::Get<SolverTraits_, Default_solver_traits>::type Solver_traits;
  typedef Intrinsic_triangulation<NT> Triangulation;  ///< the surface
  typedef typename Triangulation::Index Index;        ///< of vertices, edges and faces
  typedef Conformal_metric<NT> Metric;                ///< what is found
  typedef typename Metric::Wide_number Wide_number;   ///< type of the last residual

  /// takes the surface. Its lengths need not satisfy the triangle inequality. Linear time.
  /// \pre all lengths are positive and finite; no vertex is in `non_manifold_vertices(t)`.
  explicit Conformal_metric_solver(Triangulation t, Solver_traits traits = Solver_traits())
    : triangulation_(std::move(t)),
      pieces_(connected_components(triangulation_)),
      linear_(traits)
  {
    linear_.set_edges(triangulation_);
  }

  // `linear_` refers to nothing here, but a copy would share its factor
  Conformal_metric_solver(const Conformal_metric_solver&) = delete;
  Conformal_metric_solver& operator=(const Conformal_metric_solver&) = delete;

  /// the surface, with the lengths given.
  const Triangulation& triangulation() const { return triangulation_; }

  /// its connected components.
  const Surface_components& components() const { return pieces_; }

  /// finds the metric with the given conditions. Where no u is fixed on a component, the sum of
  /// its u is zero; or, where there are lower bounds on u, but all angle sums are as prescribed nevertheless, u is the
  /// least within these. Everything is decided by convexity: the solution is unique.
  ///
  /// Time is that of one sparse Cholesky factorization (none if the last one serves) and of
  /// a few dozen solves and linear passes.
  ///
  /// \param conditions one per vertex of the triangulation
  /// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
  ///
  /// \cgalNamedParamsBegin
  ///   \cgalParamNBegin{gradient_tolerance}
  ///     \cgalParamDescription{the largest difference of an angle sum from its target, in radians}
  ///     \cgalParamType{`double`}
  ///     \cgalParamDefault{`1e-12`}
  ///   \cgalParamNEnd
  ///   \cgalParamNBegin{number_of_iterations}
  ///     \cgalParamDescription{the maximum number of Newton steps}
  ///     \cgalParamType{`unsigned int`}
  ///     \cgalParamDefault{`100`}
  ///   \cgalParamNEnd
  ///   \cgalParamNBegin{newton_strategy}
  ///     \cgalParamDescription{how steps are kept from going too far}
  ///     \cgalParamType{`Newton_strategy`}
  ///     \cgalParamDefault{`Newton_strategy::LINE_SEARCH`}
  ///   \cgalParamNEnd
  ///   \cgalParamNBegin{retriangulation}
  ///     \cgalParamDescription{whether edges may be flipped, so that there is a solution for all angles that sum up to what they must}
  ///     \cgalParamType{`Retriangulation`}
  ///     \cgalParamDefault{`Retriangulation::WHEN_NEEDED`}
  ///   \cgalParamNEnd
  ///   \cgalParamNBegin{border_edges}
  ///     \cgalParamDescription{whether border edges may be flipped, where there is no metric with only edges inside flipped; `Conformal_metric::lost_border_edges` tells which were}
  ///     \cgalParamType{`Border_edges`}
  ///     \cgalParamDefault{`Border_edges::FLIPPABLE`}
  ///   \cgalParamNEnd
  ///   \cgalParamNBegin{initial_log_scale_factor_map}
  ///     \cgalParamDescription{where to begin, instead of at the last solution}
  ///     \cgalParamType{a readable property map with key type `std::uint32_t` and a value type convertible to `double`}
  ///     \cgalParamDefault{the last solution; at first the discretely harmonic extension of the fixed u}
  ///   \cgalParamNEnd
  ///   \cgalParamNBegin{visitor}
  ///     \cgalParamDescription{is told the progress and may stop it; `std::ref` of it if it is to be changed}
  ///     \cgalParamType{a model of `ConformalEquivalenceVisitor`}
  ///     \cgalParamDefault{`Default_visitor`}
  ///   \cgalParamNEnd
  /// \cgalNamedParamsEnd
  ///
  /// \return the metric, with a status:
  ///  - `OK`, `CONVERGED_TO_ROUNDING`;
  ///  - `EMPTY_MESH`, `INVALID_NUMBER` (vertices), `ANGLE_OUT_OF_RANGE` (vertices), `MISSING_CONDITION` (one face of
  ///    every closed surface of a genus other than 1 that has no cone; `amount`: the curvature that cones must have there),
  ///    `GAUSS_BONNET_VIOLATED` (the vertices with an angle that is not flat, or the border), `NO_ANGLE_LEFT` (the vertices
  ///    of fixed or bounded u): the conditions have no solution, nothing was computed;
  ///  - `DEGENERATE_METRIC`: the minimizer was found, but is no metric: `faces` violate the
  ///    triangle inequality, decided exactly; or, with `Retriangulation::ALWAYS`, there are `faces` among those given that do;
  ///  - `ITERATIONS_EXHAUSTED` (`amount`: the residual; `faces`: the triangles broken there),
  ///    `SINGULAR_PROBLEM`, `STOPPED_BY_VISITOR`, `OUT_OF_MEMORY`.
  template <typename NamedParameters = parameters::Default_named_parameters>
  Metric solve(const Conformal_conditions<NT>& conditions, const NamedParameters& np = parameters::default_values()) &
  {
    Metric result = run(conditions, np);
    if(!result.is_retriangulated())
      result.triangulation = triangulation_;
    return result;
  }

  /// the same, for a solver that is not needed any more.
  template <typename NamedParameters = parameters::Default_named_parameters>
  Metric solve(const Conformal_conditions<NT>& conditions, const NamedParameters& np = parameters::default_values()) &&
  {
    Metric result = run(conditions, np);
    energy_.reset();
    if(!result.is_retriangulated())
      result.triangulation = std::move(triangulation_);
    return result;
  }

  /// \cond SKIP_IN_MANUAL
  // The same with Ptolemy flips from the beginning, of edges inside only: for a triangulation that has come from such flips.
  template <typename NamedParameters>
  Metric solve_with_flips(const Conformal_conditions<NT>& conditions, const NamedParameters& np) &&
  {
    flips_at_once_ = true;
    return std::move(*this).solve(conditions, Conformal_equivalence::combine_named_parameters(np,
      parameters::retriangulation(Retriangulation::WHEN_NEEDED).border_edges(Border_edges::KEPT)));
  }
  /// \endcond

private:
  typedef internal::Vertex_vector Vertex_vector;
  typedef internal::Conformal_energy<double, NT> Energy;

  template <typename NamedParameters>
  Metric run(const Conformal_conditions<NT>& conditions, const NamedParameters& np)
  {
    using parameters::choose_parameter;
    using parameters::get_parameter;

    const internal::Stopwatch stopwatch;
    Metric result;
    internal::Newton_options options;
    options.tolerance = choose_parameter(get_parameter(np, internal_np::conformal_gradient_tolerance), 1e-12);
    options.number_of_iterations = choose_parameter(get_parameter(np, internal_np::number_of_iterations), 100u);
    options.strategy = choose_parameter(get_parameter(np, internal_np::conformal_newton_strategy),
                                        Newton_strategy::LINE_SEARCH);
    auto visitor = choose_parameter<Default_visitor>(get_parameter(np, internal_np::visitor));
    const auto initial = get_parameter(np, internal_np::conformal_initial_u);
    const Retriangulation retriangulation =
      choose_parameter(get_parameter(np, internal_np::conformal_retriangulation), Retriangulation::WHEN_NEEDED);

    const Border_edges border_edges =
      choose_parameter(get_parameter(np, internal_np::conformal_border_edges), Border_edges::FLIPPABLE);

    try
    {
      solve(conditions, initial, retriangulation, border_edges, options, internal::unwrap(visitor), result);
    }
    catch(const std::bad_alloc&)
    {
      result = Metric();
      result.status = Status::OUT_OF_MEMORY;
    }
    result.statistics.seconds.solve = stopwatch.seconds();
    return result;
  }

  // Tells the record of flips, and the edges of the linear systems, of every flip.
  struct Flip_observer
  {
    std::vector<Index>& flips;
    internal::Laplacian_solver<Solver_traits>& linear;
    std::size_t number_of_lasting_flips = 0; // those before the energy was made

    void before_flip(const Triangulation&, Index e) { flips.push_back(e); }
    void after_flip(const Triangulation& t, Index e) { linear.change_edge(t, e); }
    void begin_anew(const Triangulation& t)
    {
      flips.resize(number_of_lasting_flips);
      for(Index e = 0; e < t.number_of_edges(); ++e)
        linear.change_edge(t, e);
    }
  };
  typedef internal::Ideal_delaunay_energy<NT, Flip_observer> Flipping_energy;
  typedef internal::Folded_flip_observer<NT, Solver_traits> Folded_flip_observer;
  typedef internal::Folded_energy<NT, Folded_flip_observer> Folded_energy;

  template <typename Initial, typename Visitor>
  void solve(const Conformal_conditions<NT>& conditions, const Initial& initial, Retriangulation retriangulation,
             Border_edges border_edges, const internal::Newton_options& options, Visitor& visitor, Metric& result)
  {
    const internal::Stopwatch stopwatch;
    if(retriangulation != Retriangulation::ALWAYS && !flips_at_once_)
    {
      solve_fixed(conditions, initial, options, visitor, result);
      if(retriangulation == Retriangulation::NEVER || !may_be_helped_by_flips(result))
        return;
    }
    const Metric refused = result.status == Status::ANGLE_OUT_OF_RANGE ? result : Metric();
    discard(result, stopwatch.seconds());
    solve_flipping(conditions, initial, retriangulation, options, visitor, result);
    if(refused.status == Status::ANGLE_OUT_OF_RANGE && is_balance_violated(result.status))
    {
      result = refused; // says more: it may be the reason why the angles sum up to what cannot be
      return;
    }
    if(may_be_helped_by_flips(result) && has_border() && border_edges == Border_edges::FLIPPABLE)
    {
      discard(result, stopwatch.seconds());
      solve_on_double(conditions, initial, retriangulation, options, visitor, result);
    }
  }

  // Do the prescribed angles sum up to what cannot be?
  static bool is_balance_violated(Status status)
  {
    return status == Status::GAUSS_BONNET_VIOLATED || status == Status::NO_ANGLE_LEFT;
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

  bool has_border() const
  {
    return std::any_of(pieces_.components.begin(), pieces_.components.end(),
                       [](const Surface_components::Component& c) { return c.number_of_borders > 0; });
  }

  // On the triangulation as it is.
  template <typename Initial, typename Visitor>
  void solve_fixed(Conformal_conditions<NT> conditions, const Initial& initial,
                   const internal::Newton_options& options, Visitor& visitor, Metric& result)
  {
    visitor.on_stage(Stage::SOLVE);
    if(!check(conditions, true, result))
      return;
    if(!energy_)
      energy_ = std::make_unique<Energy>(triangulation_, true);
    if(linear_has_flips_)
      linear_.set_edges(triangulation_);
    linear_has_flips_ = false;
    minimize(triangulation_, *energy_, conditions, initial, options, visitor, result);
  }

  // Where the fixed triangulation has no solution, or none that is a metric.
  static bool may_be_helped_by_flips(const Metric& result)
  {
    return result.status == Status::DEGENERATE_METRIC || result.status == Status::ITERATIONS_EXHAUSTED
        || result.status == Status::SINGULAR_PROBLEM
        || (result.status == Status::ANGLE_OUT_OF_RANGE && result.amount > 0);
  }

  // On a copy of the triangulation, which is flipped on the way.
  template <typename Initial, typename Visitor>
  void solve_flipping(Conformal_conditions<NT> conditions, const Initial& initial, Retriangulation retriangulation,
                      internal::Newton_options options, Visitor& visitor, Metric& result)
  {
    options.is_careful = true;
    visitor.on_stage(Stage::SOLVE);
    if(!check(conditions, false, result))
      return;
    result.triangulation = triangulation_;
    linear_.set_edges(triangulation_);
    linear_has_flips_ = true;
    Flip_observer observer{result.flips, linear_, 0};
    minimize_flipping(result.triangulation, observer, [&] { return Flipping_energy(result.triangulation, observer); },
                      conditions, initial, retriangulation, options, visitor, result);
  }

  // On the double, where border edges can be flipped, too. The unknowns are those of the surface.
  template <typename Initial, typename Visitor>
  void solve_on_double(Conformal_conditions<NT> conditions, const Initial& initial, Retriangulation retriangulation,
                       internal::Newton_options options, Visitor& visitor, Metric& result)
  {
    options.is_careful = true;
    visitor.on_stage(Stage::SOLVE);
    if(!check(conditions, false, result))
      return;
    const internal::Surface_double<NT> twofold(triangulation_);
    result.is_doubled = result.statistics.is_doubled = true;
    result.triangulation = twofold.triangulation;
    internal::Folded_double<NT> folded(triangulation_, twofold, result.triangulation);
    linear_.change_edges(folded); // the factor still serves, as the matrix is that of the surface until edges are flipped
    linear_has_flips_ = true;
    Folded_flip_observer observer{result.flips, linear_, folded, 0};
    minimize_flipping(folded, observer, [&] { return Folded_energy(result.triangulation, folded, observer); },
                      conditions, initial, retriangulation, options, visitor, result);
    if(is_success(result.status))
      result.lost_border_edges = twofold.lost_border_edges(triangulation_, result.triangulation, result.flips);
  }

  // Minimizes the energy on the triangulation of `result`, or, what is then `t`, its folding, with flips.
  template <typename Surface, typename Observer, typename Make_energy, typename Initial, typename Visitor>
  void minimize_flipping(const Surface& t, Observer& observer, const Make_energy& make_energy,
                         const Conformal_conditions<NT>& conditions, const Initial& initial, Retriangulation retriangulation,
                         const internal::Newton_options& options, Visitor& visitor, Metric& result)
  {
    const internal::Stopwatch stopwatch;
    if(retriangulation == Retriangulation::ALWAYS && !make_delaunay(observer, result))
      return;
    observer.number_of_lasting_flips = result.flips.size();
    const double seconds = stopwatch.seconds();
    auto energy = make_energy();
    minimize(t, energy, conditions, initial, options, visitor, result);
    if constexpr(!std::is_same<Surface, Triangulation>::value)
      unfold(t, energy, conditions, options.tolerance, result);
    result.statistics.number_of_flips = result.flips.size();
    const internal::Stopwatch verdict_stopwatch;
    tell_about_flips(energy.flipper(), result);
    result.statistics.seconds.flips = seconds + energy.seconds_of_flips() + verdict_stopwatch.seconds();
    result.statistics.conformal_class = retriangulation == Retriangulation::ALWAYS ? Conformal_class::DELAUNAY_TRIANGULATION
                                                                                   : Conformal_class::GIVEN_TRIANGULATION;
  }

  // Gives the images of vertices their factors, too. Where the triangulation is not symmetric, as the diagonal of a trapezoid is
  // not, its lengths are symmetric up to rounding only; then so are the angle sums.
  void unfold(const internal::Folded_double<NT>& t, Folded_energy& energy, Conformal_conditions<NT> conditions,
              double tolerance, Metric& result) const
  {
    result.scale_factors = t.spread(result.scale_factors);
    if(!is_success(result.status))
      return;
    for(Index v : result.active_bounds)
      conditions.fix_log_scale_factor(v, NT(conditions.lower_bound(v)));
    Statistics& statistics = result.statistics;
    const double residual = internal::largest_residual(t, result.scale_factors, conditions), before = statistics.residual;
    if(residual <= before)
      return;
    statistics.residual = statistics.residuals.back() = residual;
    if(residual <= (std::max)(tolerance, before))
      return;
    double rounding = 0; // of lengths
    for(Index e = 0; e < result.triangulation.number_of_edges(); ++e)
      rounding = (std::max)(rounding, energy.flipper().length_error(e));
    statistics.residual_floor = (std::max)(statistics.residual_floor, before + 8 * rounding * largest_sensitivity(energy));
    result.amount = residual;
    result.status = residual <= statistics.residual_floor ? Status::CONVERGED_TO_ROUNDING : Status::ITERATIONS_EXHAUSTED;
    if(!is_success(result.status))
      result.scale_factors.clear();
  }

  static void tell_about_flips(internal::Delaunay_flipper<NT>& flipper, Metric& result)
  {
    result.statistics.number_of_filter_failures = flipper.counts().filter_failures;
    result.statistics.number_of_exact_decisions = flipper.counts().exact_decisions;
    if(!is_success(result.status))
      return;
    const internal::Delaunay_verdict verdict = flipper.verdict(result.scale_factors);
    result.statistics.delaunay = verdict.is_exact         ? Delaunay_property::EXACT
                               : verdict.is_within_bounds ? Delaunay_property::WITHIN_ROUNDING
                                                          : Delaunay_property::NO;
  }

  // The intrinsic Delaunay triangulation of the metric given, by Euclidean flips.
  template <typename Observer>
  bool make_delaunay(Observer& observer, Metric& result) const
  {
    std::vector<Index> flipped;
    const bool is_possible = internal::make_intrinsic_delaunay(result.triangulation, result.faces, [&](Index e)
    {
      observer.before_flip(result.triangulation, e);
      flipped.push_back(e);
    });
    if(!is_possible)
    {
      // those of the surface come before their images
      result.faces.erase(std::lower_bound(result.faces.begin(), result.faces.end(), triangulation_.number_of_faces()), result.faces.end());
      result.status = Status::DEGENERATE_METRIC;
      return false;
    }
    for(Index e : flipped)
      observer.after_flip(result.triangulation, e);
    return true;
  }

  // Newton's method and what follows, on `t`, which the energy may flip: a triangulation, or a folded one.
  template <typename Surface, typename Any_energy, typename Initial, typename Visitor>
  void minimize(const Surface& t, Any_energy& energy, const Conformal_conditions<NT>& conditions, const Initial& initial,
                const internal::Newton_options& options, Visitor& visitor, Metric& result)
  {
    linear_.set_free(free_vertices(conditions));
    const internal::Lower_bounds bounds = lower_bounds(conditions);
    hold_one_of_each(bounds);
    const std::size_t factorizations_before = linear_.number_of_factorizations();

    Vertex_vector u;
    result.status = first_guess(energy, conditions, initial, u) ? Status::OK : Status::SINGULAR_PROBLEM;
    if(result.status == Status::OK)
    {
      const Vertex_vector target = targets(conditions);
      internal::Newton_method<Any_energy, Solver_traits, Visitor>
        newton(energy, linear_, target, options, result.statistics, visitor, bounds);
      result.status = newton(u);
    }
    if(result.status == Status::OK)
      finish(t, energy, conditions, bounds, u, options.tolerance, result);
    if(is_success(result.status) && conditions.has_bounds())
      settle(conditions, result.scale_factors);
    if(is_success(result.status))
      keep(result.scale_factors, conditions, u, result);
    result.statistics.number_of_factorizations = linear_.number_of_factorizations() - factorizations_before;
    result.statistics.number_of_regularized_rows = linear_.number_of_regularized_rows();
    judge(t, energy, result);
  }

  // The last steps; then edges are flipped that are not Delaunay by so little that rounding has hidden it on the way.
  // Angle sums hardly differ between both triangulations, but as there may be needles they are made right again.
  template <typename Surface, typename Any_energy>
  void finish(const Surface& t, Any_energy& energy, const Conformal_conditions<NT>& conditions,
              const internal::Lower_bounds& bounds, Vertex_vector& u, double tolerance, Metric& result)
  {
    const std::size_t steps = result.statistics.residuals.size();
    for(int round = 0; round < 10; ++round)
    {
      result.statistics.residuals.resize(steps);
      result.status = Status::OK;
      if(bounds.empty())
        refine(t, energy, conditions, u, tolerance, result);
      else
        refine_within_bounds(t, energy, conditions, bounds, u, tolerance, result);
      if constexpr(Any_energy::has_flips)
        if(is_success(result.status) && energy.make_delaunay(result.scale_factors, u))
          continue;
      return;
    }
  }

  bool check(Conformal_conditions<NT>& conditions, bool triangulation_is_fixed, Metric& result)
  {
    CGAL_precondition(conditions.size() == triangulation_.number_of_vertices());
    if(triangulation_.number_of_faces() == 0)
    {
      result.status = Status::EMPTY_MESH;
      return false;
    }
    const internal::Feasibility feasibility = internal::make_feasible(triangulation_, pieces_, conditions, triangulation_is_fixed);
    result.status = feasibility.status;
    result.amount = feasibility.amount;
    result.vertices = feasibility.vertices;
    result.faces = feasibility.faces;
    result.statistics.angle_defect_spread = feasibility.angle_defect_spread;
    rests_on_bounds_ = feasibility.rests_on_bounds;
    return feasibility.status == Status::OK;
  }

  // The vertices at which u is unknown. Where a component has no fixed u and no active bound, its first vertex is held,
  // which changes nothing but the scale.
  std::vector<char> free_vertices(const Conformal_conditions<NT>& conditions)
  {
    std::vector<char> free(triangulation_.number_of_vertices(), 0);
    std::vector<char> has_fixed = rests_on_bounds_;
    for(Index v = 0; v < triangulation_.number_of_vertices(); ++v)
    {
      if(triangulation_.is_isolated_vertex(v))
        continue;
      free[v] = conditions.is_fixed(v) ? 0 : 1;
      if(conditions.is_fixed(v))
        has_fixed[pieces_.component_of_vertex[v]] = 1;
    }
    for(std::size_t c = 0; c < has_fixed.size(); ++c)
      if(!has_fixed[c])
        free[triangulation_.origin(3 * pieces_.components[c].first_face)] = 0;
    floating_.assign(has_fixed.size(), 0);
    for(std::size_t c = 0; c < has_fixed.size(); ++c)
      floating_[c] = has_fixed[c] ? 0 : 1;
    return free;
  }

  Vertex_vector targets(const Conformal_conditions<NT>& conditions) const
  {
    Vertex_vector result(triangulation_.number_of_vertices(), 0.);
    for(Index v = 0; v < result.size(); ++v)
      if(!conditions.is_fixed(v))
        result[v] = conditions.angle_sum(v).template radians<double>();
    return result;
  }

  // Those of the components whose scale they determine.
  internal::Lower_bounds lower_bounds(const Conformal_conditions<NT>& conditions) const
  {
    internal::Lower_bounds result;
    if(!conditions.has_bounds())
      return result;
    const Index n = triangulation_.number_of_vertices();
    result.bound.assign(n, -std::numeric_limits<double>::infinity());
    result.resting.assign(n, Triangulation::null_index);
    result.number_of_components = Index(pieces_.components.size());
    bool is_empty = true;
    for(Index v = 0; v < n; ++v)
    {
      if(triangulation_.is_isolated_vertex(v))
        continue;
      const Index c = pieces_.component_of_vertex[v];
      if(rests_on_bounds_[c])
        result.resting[v] = c;
      if(!conditions.is_bounded(v) || floating_[c])
        continue;
      result.bound[v] = static_cast<double>(conditions.lower_bound(v));
      is_empty = false;
    }
    return is_empty ? internal::Lower_bounds() : result;
  }

  // Else the matrix of a component that rests on its bounds is singular.
  void hold_one_of_each(const internal::Lower_bounds& bounds)
  {
    if(bounds.empty())
      return;
    std::vector<char> held(triangulation_.number_of_vertices(), 0);
    for(const Index v : bounds.largest([](Index) { return 0; }))
      held[v] = 1;
    linear_.hold(std::move(held));
  }

  // The given u, else the last solution; at first the harmonic extension of the fixed u. The
  // factor, if there is none, is that of the Hessian at u = 0.
  template <typename Any_energy, typename Initial>
  bool first_guess(Any_energy& energy, const Conformal_conditions<NT>& conditions, const Initial& initial, Vertex_vector& u)
  {
    const bool has_last = !last_u_.empty();
    u = has_last ? last_u_ : Vertex_vector(triangulation_.number_of_vertices(), 0.);
    if constexpr(!std::is_same<std::decay_t<Initial>, internal_np::Param_not_found>::value)
      for(Index v = 0; v < u.size(); ++v)
        u[v] = static_cast<double>(get(initial, v));

    Vertex_vector step(u.size(), 0.); // at the fixed vertices
    for(Index v = 0; v < u.size(); ++v)
      if(conditions.is_fixed(v) && !triangulation_.is_isolated_vertex(v))
        step[v] = static_cast<double>(conditions.log_scale_factor(v)) - u[v];
    const bool is_moved = internal::largest_entry(step) > 0;
    if(internal::largest_entry(u) == 0 && !is_moved)
      return true; // the first Newton step will factorize
    if(!linear_.has_factor())
    {
      energy.evaluate(Vertex_vector(u.size(), 0.));
      if(!linear_.factorize(energy.weights()))
        return false;
    }
    if(!is_moved)
      return true;

    Vertex_vector pull, extension;
    energy.evaluate(Vertex_vector(u.size(), 0.));
    pull = linear_.graph().product(energy.weights(), step);
    for(double& x : pull)
      x = -x;
    if(!linear_.precondition(pull, extension))
      return false;
    for(Index v = 0; v < u.size(); ++v)
      u[v] += step[v] + extension[v];
    return true;
  }

  // Moves u on every component without a fixed vertex so that its sum is zero.
  void center(Vertex_vector& u) const
  {
    Vertex_vector sum(pieces_.components.size(), 0.);
    for(Index v = 0; v < u.size(); ++v)
      if(!triangulation_.is_isolated_vertex(v))
        sum[pieces_.component_of_vertex[v]] += u[v];
    for(Index v = 0; v < u.size(); ++v)
    {
      const Index c = pieces_.component_of_vertex[v];
      if(!triangulation_.is_isolated_vertex(v) && floating_[c])
        u[v] -= sum[c] / double(pieces_.components[c].number_of_vertices);
    }
  }

  // The last steps, with the residual in the wide type and the linear systems in double: each step gains as many digits as the
  // linear system is solved for, up to the rounding of its matrix. As a residual costs more than an iteration of conjugate
  // gradients, every system is solved for as many digits as can be gained. Where that comes to nothing before the tolerance is
  // reached, the matrix is that of the wide metric, factorized anew; then all of the linear algebra runs in the wide type.
  // A step with error e^3 in s is as good as any: what counts is the s that comes out.
  template <typename Surface, typename Any_energy>
  void refine(const Surface& t, const Any_energy& energy, const Conformal_conditions<NT>& conditions,
              Vertex_vector& u, double tolerance, Metric& result)
  {
    center(u);
    std::vector<Wide_number>& s = result.scale_factors;
    s.resize(u.size());
    for(Index v = 0; v < u.size(); ++v)
      s[v] = half_exponential(conditions.is_fixed(v) ? Wide_number(conditions.log_scale_factor(v)) : Wide_number(u[v]));

    const double goal = 1e-4 * tolerance; // so that layouts are not spoiled by the sum of all residuals
    Wide_number known_floor(0);
    const auto floor = [&]
    {
      if(known_floor == 0)
        known_floor = 8 * std::numeric_limits<Wide_number>::epsilon() * largest_sensitivity(energy);
      return known_floor;
    };
    internal::Scaled_vector residual = internal::scaled_wide_residual(t, s, conditions), next;
    Wide_number size = residual.template largest<Wide_number>();
    Refinement_arithmetic& arithmetic = result.statistics.refinement_arithmetic;
    arithmetic = Refinement_arithmetic::DOUBLE;
    std::vector<double> wide_weights; // empty: those of the energy
    double gain = (std::max)(1e-12, (std::min)(1e-3, static_cast<double>(size))); // of a step: the next residual relative to the last
    while(size > goal && !(size <= tolerance && size <= floor()) && std::isfinite(static_cast<double>(size)))
    {
      const double wanted = (std::max)({gain / 10, 1e-14, 0.3 * static_cast<double>(Wide_number(goal / size))});
      std::vector<Wide_number> moved = s;
      const bool has_moved = arithmetic == Refinement_arithmetic::WIDE
        ? internal::add_wide_newton_step(t, linear_.graph(), residual, moved)
        : add_newton_step(wide_weights.empty() ? energy.weights() : wide_weights, residual, (std::min)(1e-3, wanted), result, moved);
      Wide_number next_size = size;
      if(has_moved)
      {
        next = internal::scaled_wide_residual(t, moved, conditions);
        next_size = next.template largest<Wide_number>();
      }
      if(next_size < size)
      {
        gain = static_cast<double>(Wide_number(next_size / size));
        s.swap(moved);
        std::swap(residual, next);
        size = next_size;
        if(gain < (size > tolerance ? 0.1 : 0.5))
          continue;
      }
      // nothing much is gained any more; what cannot be gained is the rounding of the targets, which then do not add up to what they must
      if(size <= tolerance || solvable(residual) <= floor() || arithmetic == Refinement_arithmetic::WIDE)
        break;
      gain = 1e-12;
      if(arithmetic == Refinement_arithmetic::DOUBLE)
      {
        arithmetic = Refinement_arithmetic::WIDE_WEIGHTS;
        wide_weights = internal::wide_weights(t, s);
        if(linear_.factorize(wide_weights))
          continue;
      }
      if(size <= result.statistics.residual_floor && tolerance >= std::numeric_limits<double>::epsilon())
        break;
      arithmetic = Refinement_arithmetic::WIDE;
    }

    result.statistics.residual = rounded_up(size);
    result.statistics.residuals.push_back(result.statistics.residual);
    if(size <= tolerance)
      return;
    if(size <= floor())
      result.statistics.residual_floor = rounded_up(floor());
    result.amount = result.statistics.residual;
    result.status = result.statistics.residual <= result.statistics.residual_floor ? Status::CONVERGED_TO_ROUNDING
                                                                                   : Status::ITERATIONS_EXHAUSTED;
  }

  // Multiplies `s` by e^{d / 2} for the d of a step of Newton's method with the weights `w`. Returns whether there was a factor for it.
  bool add_newton_step(const std::vector<double>& w, const internal::Scaled_vector& residual, double tolerance,
                       Metric& result, std::vector<Wide_number>& s)
  {
    using std::ldexp;
    Vertex_vector right = residual.entries, d;
    linear_.graph().clear_fixed(right);
    bool converged;
    const std::size_t few = 30, many = 200;
    result.statistics.number_of_linear_iterations += linear_.conjugate_gradients(w, right, tolerance, few, d, converged);
    if(!converged && linear_.factorize(w))
      result.statistics.number_of_linear_iterations += linear_.conjugate_gradients(w, right, tolerance, many, d, converged);
    center(d);
    for(Index v = 0; v < d.size(); ++v)
      if(d[v] != 0)
      {
        const Wide_number step = ldexp(Wide_number(d[v]), residual.exponent);
        s[v] = s[v] + s[v] * (step / 2 + step * step / 8);
      }
    return linear_.has_factor();
  }

  // The largest entry at a vertex where u is unknown.
  Wide_number solvable(internal::Scaled_vector residual) const
  {
    linear_.graph().clear_fixed(residual.entries);
    return residual.template largest<Wide_number>();
  }

  // e^{u/2}
  static Wide_number half_exponential(const Wide_number& u)
  {
    using std::exp;
    return Wide_number(exp(Wide_number(u / 2)));
  }

  // As a double that is not 0 unless x is.
  static double rounded_up(const Wide_number& x)
  {
    return x == 0 ? 0 : (std::max)(static_cast<double>(x), std::numeric_limits<double>::denorm_min());
  }

  // By how many units of epsilon rounding may move the angle sums, at most.
  template <typename Any_energy>
  double largest_sensitivity(const Any_energy& energy) const
  {
    double result = 1;
    const Vertex_vector sensitivity = energy.sensitivities();
    for(Index v = 0; v < sensitivity.size(); ++v)
      if(linear_.graph().is_free(v))
        result = (std::max)(result, sensitivity[v]);
    return result;
  }

  // The same with some of the bounds active, as the solution has them: where Newton's method could not tell by
  // rounding, the wide type does.
  template <typename Surface, typename Any_energy>
  void refine_within_bounds(const Surface& t, const Any_energy& energy, const Conformal_conditions<NT>& conditions,
                            const internal::Lower_bounds& bounds, Vertex_vector& u, double tolerance, Metric& result)
  {
    std::vector<char> active(u.size(), 0);
    for(Index v = 0; v < u.size(); ++v)
      active[v] = u[v] <= bounds.bound[v];
    for(int attempt = 0; attempt < 20; ++attempt)
    {
      Conformal_conditions<NT> equalities = conditions;
      for(Index v = 0; v < u.size(); ++v)
        if(active[v])
          equalities.fix_log_scale_factor(v, NT(conditions.lower_bound(v)));
      linear_.hold(active);
      result.status = Status::OK;
      refine(t, energy, equalities, u, tolerance, result);
      if(!is_success(result.status) || !exchange_bounds(t, conditions, bounds, tolerance, result, active))
        return;
      for(Index v = 0; v < u.size(); ++v)
        u[v] = active[v] ? bounds.bound[v] : static_cast<double>(logarithm(result.scale_factors[v]));
    }
    result.status = Status::ITERATIONS_EXHAUSTED;
  }

  // Activates the bounds that are violated, and releases those where the angle sum is too large. Returns whether there were any.
  template <typename Surface>
  bool exchange_bounds(const Surface& t, const Conformal_conditions<NT>& conditions, const internal::Lower_bounds& bounds,
                       double tolerance, const Metric& result, std::vector<char>& active) const
  {
    const double most = (std::max)(tolerance, result.statistics.residual);
    const Vertex_vector residual = internal::wide_residual(t, result.scale_factors, conditions);
    bool is_changed = false;
    for(Index v = 0; v < active.size(); ++v)
    {
      if(!bounds.has(v) || (active[v] ? !(residual[v] > most) : !(result.scale_factors[v] < least_factor(conditions, v))))
        continue;
      active[v] = !active[v];
      is_changed = true;
    }
    return is_changed;
  }

  // e^{b/2} for the bound b at v
  static Wide_number least_factor(const Conformal_conditions<NT>& conditions, Index v)
  {
    using std::exp;
    return Wide_number(exp(Wide_number(conditions.lower_bound(v)) / 2));
  }

  // Scales the components where the bounds determine nothing but the scale: the least that they allow.
  void settle(const Conformal_conditions<NT>& conditions, std::vector<Wide_number>& s) const
  {
    std::vector<Wide_number> factor(pieces_.components.size(), Wide_number(0));
    for(Index v = 0; v < s.size(); ++v)
    {
      if(triangulation_.is_isolated_vertex(v) || !conditions.is_bounded(v) || !floating_[pieces_.component_of_vertex[v]])
        continue;
      const Wide_number needed = least_factor(conditions, v) / s[v];
      Wide_number& largest = factor[pieces_.component_of_vertex[v]];
      if(largest < needed)
        largest = needed;
    }
    for(Index v = 0; v < s.size(); ++v)
      if(!triangulation_.is_isolated_vertex(v) && Wide_number(0) < factor[pieces_.component_of_vertex[v]])
        s[v] = s[v] * factor[pieces_.component_of_vertex[v]];
  }

  // u of e^{u/2}
  static NT logarithm(const Wide_number& s)
  {
    using std::log;
    if constexpr(std::is_same<NT, double>::value)
      return 2 * (std::log(s.hi) + s.lo / s.hi);
    else
      return static_cast<NT>(2 * log(s));
  }

  void keep(const std::vector<Wide_number>& s, const Conformal_conditions<NT>& conditions, Vertex_vector& u, Metric& result)
  {
    using std::abs;
    result.log_scale_factors.resize(u.size());
    for(Index v = 0; v < u.size(); ++v)
    {
      NT& x = result.log_scale_factors[v];
      x = logarithm(s[v]);
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
    last_u_ = u;
  }

  // Names the triangles that the metric found breaks: exactly for a solution, as the last
  // evaluation saw them otherwise.
  template <typename Surface, typename Any_energy>
  void judge(const Surface& t, const Any_energy& energy, Metric& result) const
  {
    if(!is_success(result.status))
    {
      if(result.status == Status::ITERATIONS_EXHAUSTED)
      {
        result.faces = energy.broken_faces();
        result.amount = result.statistics.residual;
      }
      result.scale_factors.clear();
      return;
    }
    const std::vector<Wide_number>& s = result.scale_factors;
    for(Index f = 0; f < t.number_of_faces(); ++f)
    {
      const Index i = t.origin(3 * f), j = t.origin(3 * f + 1), k = t.origin(3 * f + 2);
      if(!internal::is_scaled_triangle(s[i], s[j], s[k],
                                       Wide_number(t.halfedge_length(3 * f)),
                                       Wide_number(t.halfedge_length(3 * f + 1)),
                                       Wide_number(t.halfedge_length(3 * f + 2))))
        result.faces.push_back(f);
    }
    if(!result.faces.empty())
      result.status = Status::DEGENERATE_METRIC;
  }

  Triangulation triangulation_;
  Surface_components pieces_;
  internal::Laplacian_solver<Solver_traits> linear_;
  std::unique_ptr<Energy> energy_;
  std::vector<char> rests_on_bounds_; // components without a fixed u where some bounds are active
  std::vector<char> floating_;  // components whose scale nothing determines
  Vertex_vector last_u_;
  bool linear_has_flips_ = false; // the edges of `linear_` are not those of `triangulation_`
  bool flips_at_once_ = false;    // see `solve_with_flips()`
};

/// \ingroup PkgConformalEquivalenceSolver
///
/// finds the metric conformally equivalent to that of `t` with the given conditions: one
/// `Conformal_metric_solver::solve()`, with the same named parameters and one more.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{sparse_linear_solver}
///     \cgalParamDescription{the solver of the linear systems}
///     \cgalParamType{a model of `SparseLinearAlgebraWithFactorTraits_d`}
///     \cgalParamDefault{`Default_solver_traits`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
template <typename NT, typename NamedParameters = parameters::Default_named_parameters>
Conformal_metric<NT> compute_conformal_metric(Intrinsic_triangulation<NT> t,
                                              const Conformal_conditions<NT>& conditions,
                                              const NamedParameters& np = parameters::default_values())
{
  typedef typename internal_np::Lookup_named_param_def<internal_np::sparse_linear_solver_t, NamedParameters,
                                                       Default_solver_traits>::type Solver_traits;
  using parameters::choose_parameter;
  using parameters::get_parameter;
  return Conformal_metric_solver<NT, Solver_traits>(
      std::move(t), choose_parameter<Solver_traits>(get_parameter(np, internal_np::sparse_linear_solver)))
    .solve(conditions, np);
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_CONFORMAL_METRIC_H
