// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file compute_hyperbolic_metric.h
/// From the lengths of a triangulated surface and conditions to the hyperbolic metric in its conformal class that meets them (section 6 of
/// Bobenko, Pinkall and Springborn, "Discrete conformal maps and ideal hyperbolic polyhedra", 2015).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_HYPERBOLIC_METRIC_H
#define CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_HYPERBOLIC_METRIC_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Hyperbolic_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Hyperbolic_metric_finder.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/solver_traits_of.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <utility>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceHyperbolic
///
/// finds the metric of curvature -1, with cones where they are asked for, that is discretely conformally equivalent to that of `t`: where u is not
/// fixed the angle sums are as prescribed. Edges are flipped on the way, by Ptolemy's relation, so that the triangulation is Delaunay for the
/// metric found. It exists, and is unique, iff the prescribed angles leave a positive area on every component (Gu, Guo, Luo, Sun and Wu, "A
/// discrete uniformization theorem for polyhedral surfaces II", 2018): without cones, for closed surfaces of genus at least 2.
///
/// The energy is strictly convex, and is minimized by Newton's method. The last residual is measured and reduced in a wider number type, for
/// `double` to about 1e-28.
///
/// \tparam NT number type of the lengths: `double`, or a wider binary floating-point number
/// \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
///
/// \param t a surface of any topology, with Euclidean lengths, which need not satisfy the triangle inequality
/// \param conditions one per vertex. A border whose u is fixed keeps its edges. (For borders that are to be geodesics, see
///        `uniformize_hyperbolic()`.)
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{gradient_tolerance} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{number_of_iterations} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{visitor} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{initial_log_scale_factor_map} \cgalParamDescription{as in `Conformal_metric_solver::solve()`}
///     \cgalParamDefault{constant where u is not fixed: such that the Euclidean area is about the hyperbolic one} \cgalParamNEnd
///   \cgalParamNBegin{retriangulation}
///     \cgalParamDescription{with `Retriangulation::ALWAYS` the surface that is scaled is the intrinsic Delaunay triangulation of the metric given, so that the result does not depend on how flat polygons are triangulated; with all other values it is the triangulation given. Edges are flipped in any case}
///     \cgalParamType{`Retriangulation`}
///     \cgalParamDefault{`Retriangulation::WHEN_NEEDED`}
///   \cgalParamNEnd
///   \cgalParamNBegin{sparse_linear_solver} \cgalParamDescription{as in `compute_conformal_metric()`} \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \pre there are no lower bounds on u among the conditions
///
/// \return the metric, with a status: `OK`, `CONVERGED_TO_ROUNDING`; `EMPTY_MESH`, `INVALID_NUMBER`, `ANGLE_OUT_OF_RANGE` as in
///         `Conformal_metric_solver::solve()`;
///         `WRONG_TOPOLOGY` (one face of every component without cones whose Euler characteristic is not negative; `amount`: 2 pi times it, which
///         the curvatures 2 pi - angle of cones must exceed), `GAUSS_BONNET_VIOLATED` (the vertices with prescribed angles that are not flat: they
///         leave the area `amount` <= 0), `NO_ANGLE_LEFT` (the vertices of fixed u): there is no such metric, nothing was computed;
///         `DEGENERATE_METRIC` (faces of the triangulation of the metric that violate the triangle inequality, which only happens at a border; or,
///         with `Retriangulation::ALWAYS`, of the one given), `ITERATIONS_EXHAUSTED`, `SINGULAR_PROBLEM`, `STOPPED_BY_VISITOR`, `OUT_OF_MEMORY`.
///
/// Time is that of a few sparse Cholesky factorizations, each of which serves for several Newton steps.
template <typename NT, typename NamedParameters = parameters::Default_named_parameters>
Hyperbolic_metric<NT> compute_hyperbolic_metric(Intrinsic_triangulation<NT> t, const Conformal_conditions<NT>& conditions,
                                                const NamedParameters& np = parameters::default_values())
{
  const Solver_options options = read_solver_options(np, t.number_of_vertices());
  return internal::Hyperbolic_metric_finder<NT>(std::move(t), conditions, options,
                                                internal::make_factorization(internal::solver_traits_of(np))).find();
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_HYPERBOLIC_METRIC_H
