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
#include <CGAL/Conformal_equivalence/Multifrontal_solver_traits.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Metric_finder.h>
#include <CGAL/Conformal_equivalence/internal/solver_traits_of.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <CGAL/Default.h>

#include <utility>

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
    : finder_(std::move(t), internal::make_factorization(traits))
  {}

  /// the surface, with the lengths given.
  const Triangulation& triangulation() const { return finder_.triangulation(); }

  /// its connected components.
  const Surface_components& components() const { return finder_.components(); }

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
  ///   \cgalParamNBegin{number_of_threads}
  ///     \cgalParamDescription{how many threads may be used: in the passes over the triangles, and by `Multifrontal_solver_traits`. The result is the same, bit for bit, for any number. Only one is used where the program does not link the CMake target `Conformal_equivalence::TBB_support`}
  ///     \cgalParamType{`unsigned int`}
  ///     \cgalParamDefault{`1`}
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
  ///  - `SCALE_OUT_OF_RANGE` (`amount`: largest less least u): the metric was found, but leaves the range of `NT`. `log_scale_factors`, found in
  ///    `double`, are all that there is of it: their angle sums are right to `statistics.residual`, which is at most 1e-3 radians; a type with a
  ///    wider range of exponents finds the rest;
  ///  - `ITERATIONS_EXHAUSTED` (`amount`: the residual; `faces`: the triangles broken there): no metric was found. Where numbers ranged far,
  ///    `statistics` tell over which u the last step ranged;
  ///  - `SINGULAR_PROBLEM`, `STOPPED_BY_VISITOR`, `OUT_OF_MEMORY`.
  template <typename NamedParameters = parameters::Default_named_parameters>
  Metric solve(const Conformal_conditions<NT>& conditions, const NamedParameters& np = parameters::default_values()) &
  {
    return solve(conditions, read_solver_options(np, triangulation().number_of_vertices()));
  }

  /// the same, for a solver that is not needed any more.
  template <typename NamedParameters = parameters::Default_named_parameters>
  Metric solve(const Conformal_conditions<NT>& conditions, const NamedParameters& np = parameters::default_values()) &&
  {
    return std::move(*this).solve(conditions, read_solver_options(np, triangulation().number_of_vertices()));
  }

  /// the same, with the options as a value.
  Metric solve(const Conformal_conditions<NT>& conditions, const Solver_options& options) &
  {
    Metric result = finder_.find(conditions, options);
    if(!result.is_retriangulated())
      result.triangulation = finder_.triangulation();
    return result;
  }

  /// the same, for a solver that is not needed any more.
  Metric solve(const Conformal_conditions<NT>& conditions, const Solver_options& options) &&
  {
    Metric result = finder_.find(conditions, options);
    if(!result.is_retriangulated())
      result.triangulation = finder_.take_triangulation();
    return result;
  }

private:
  internal::Metric_finder<NT> finder_;
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
  typedef internal::Solver_traits_of<NamedParameters> Solver_traits;
  return Conformal_metric_solver<NT, Solver_traits>(std::move(t), internal::solver_traits_of(np)).solve(conditions, np);
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_CONFORMAL_METRIC_H
