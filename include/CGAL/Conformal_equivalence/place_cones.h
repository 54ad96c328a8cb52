// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file place_cones.h
/// Cones that place themselves (section 5.1 of Springborn, Schroeder and Pinkall, 2008), so that the scale is distorted little: their places and
/// angles are chosen together; or only the places, and u = 0 there. Their angles may be rounded to multiples of 2 pi / n (section 6), as textures and
/// meshes of quadrangles ask for.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_PLACE_CONES_H
#define CGAL_CONFORMAL_EQUIVALENCE_PLACE_CONES_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Cone_placement.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Cone_placer.h>
#include <CGAL/Conformal_equivalence/internal/Cones/report_cones.h>
#include <CGAL/Conformal_equivalence/internal/Doors/parameters_of_doors.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/internal/solver_traits_of.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/number_utils.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <type_traits>

namespace CGAL {
namespace Conformal_equivalence {

namespace internal {

// `measure`: what is made small if neither that nor a bound is given
template <typename NamedParameters>
Cone_options read_cone_options(const NamedParameters& np, Cone_measure measure = Cone_measure::MAXIMUM_U)
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  Cone_options options;
  options.number_of_cones = choose_parameter(get_parameter(np, internal_np::conformal_number_of_cones), options.number_of_cones);
  options.maximum_area_distortion =
    choose_parameter(get_parameter(np, internal_np::conformal_maximum_area_distortion), options.maximum_area_distortion);
  options.maximum_u = choose_parameter(get_parameter(np, internal_np::conformal_maximum_u), options.maximum_u);
  options.angle_quantum = choose_parameter(get_parameter(np, internal_np::conformal_angle_quantum), options.angle_quantum);
  options.maximum_root_mean_square =
    choose_parameter(get_parameter(np, internal_np::conformal_maximum_root_mean_square), options.maximum_root_mean_square);
  options.measure = choose_parameter(get_parameter(np, internal_np::conformal_cone_measure), options.measure_of_bounds(measure));
  options.angles = choose_parameter(get_parameter(np, internal_np::conformal_cone_angles), options.angles);
  options.number_of_sweeps = choose_parameter(get_parameter(np, internal_np::conformal_number_of_sweeps), options.number_of_sweeps);
  return options;
}

// Copies of solver traits may share one factor (those of Eigen_solver_traits do), and the search must keep its own: where it can, it makes new
// traits.
template <typename SolverTraits>
std::unique_ptr<Factorization> search_factorization(const SolverTraits& traits)
{
  CGAL_USE(traits);
  if constexpr(std::is_default_constructible<SolverTraits>::value)
    return make_factorization(SolverTraits());
  else
    return make_factorization(traits);
}

// Cones on a connected surface, with these options instead of those among the named parameters.
template <typename NT, typename NamedParameters>
Cone_placement<NT> place_cones_with(const Intrinsic_triangulation<NT>& t, const Cone_options& options, const NamedParameters& np)
{
  const auto traits = solver_traits_of(np);
  try
  {
    return Cone_placer<NT>(t, options, read_solver_options(np, t.number_of_vertices()), search_factorization(traits),
                           [&] { return make_factorization(traits); }).run();
  }
  catch(const std::bad_alloc&)
  {
    Cone_placement<NT> nothing;
    nothing.status = Status::OUT_OF_MEMORY;
    return nothing;
  }
}

// The angle sums of all vertices inside the surface.
template <typename TriangleMesh, typename VertexAngleMap>
void write_cone_angles(const Imported_mesh<TriangleMesh, double>& mesh, const Flattening_report<TriangleMesh>& report, VertexAngleMap cone_angle_map)
{
  const Intrinsic_triangulation<double>& t = mesh.triangulation;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v) && !t.is_border_vertex(v))
      put(cone_angle_map, mesh.vertex(v), 2 * CGAL_PI);
  for(const auto& cone : report.cones)
    put(cone_angle_map, cone.vertex, cone.angle);
}

template <typename TriangleMesh, typename NamedParameters>
void write_log_scale_factors(const Imported_mesh<TriangleMesh, double>& mesh, const Conformal_metric<double>& metric, const NamedParameters& np)
{
  for(std::uint32_t v = 0; v < mesh.triangulation.number_of_vertices(); ++v)
    if(!mesh.triangulation.is_isolated_vertex(v))
      put_if_given(np, internal_np::conformal_u, mesh.vertex(v), metric.log_scale_factors[v]);
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceSolver
///
/// places cones on a connected surface, and finds the metric with them. See `place_cones(tm, cone_angle_map, np)` for the method, the named
/// parameters and statuses.
/// \pre no vertex is in `non_manifold_vertices(t)`
template <typename NT, typename NamedParameters = parameters::Default_named_parameters>
Cone_placement<NT> place_cones(const Intrinsic_triangulation<NT>& t, const NamedParameters& np = parameters::default_values())
{
  return internal::place_cones_with(t, internal::read_cone_options(np), np);
}

/// \ingroup PkgConformalEquivalenceDoors
///
/// places cones on a mesh, so that the flat metric with these cones distorts the scale less: what `cone_measure` says is to be small.
///
/// The places and the angles are unknowns. To first order u is a linear function of the curvatures of the cones, with the columns of the inverse
/// of the Laplacian for its coefficients, which is exact for smooth surfaces. For given places the curvatures with the least root mean square of u
/// solve a linear system with as many unknowns as there are cones; those with nearly the least largest |u|, a few dozen of them, by p-norms of
/// growing p. The derivative by a curvature anywhere on the surface says where another cone helps most, and where to move those that are there (in
/// the spirit of Soliman, Slepcev and Crane, "Optimal Cone Singularities for Conformal Flattening", 2018). When this gains no more, the metric
/// with these cones is solved for. Where it is worse than foreseen the Laplacian is made anew there, and the cones are moved again. What is
/// returned is the best metric that was solved for. Where that is worse by more than a quarter than what was foreseen at first (a twentieth with an
/// `angle_quantum`, for the largest |u|), as may be where edges are flipped by the thousands, and on surfaces of fewer than 5000 vertices in any
/// case, cones with u = 0 are placed as well (see below), and the better one is returned. Angles are between pi / 4 and 4 pi, if Gauss and Bonnet's
/// formula allows.
///
/// On surfaces of 40000 inner vertices and more (20000 with `Cone_measure::ROOT_MEAN_SQUARE_U`), unless there is a bound, this is first done on a
/// coarse surface of some thousand vertices, whose cells are joined by finite volumes, and the cones are moved for a few rounds on the surface given.
///
/// With an `angle_quantum`, and `Cone_measure::ROOT_MEAN_SQUARE_U` or a coarse surface, the curvatures are multiples of it, those of a closest
/// vector in the lattice with the Gram matrix of the columns; then the cones move with these, and multiples are chosen anew.
///
/// With `Cone_angles::ZERO_U`, or an `angle_quantum` in other cases, or `Cone_measure::DIRICHLET_ENERGY`, or where there is no such metric
/// (because edges must not be flipped, for example), cones have u = 0:
///
///  - *Greedily*: the vertex with the largest |u| becomes a free cone (u = 0, any angle), one after the other. On borders u = 0. A closed surface of
///    a genus other than 1 begins with its curvature spread equally over the vertices, a sphere until it has three cones.
///  - *Concurrently*: each cone in turn is taken out, and put where |u| is largest then, until the cones settle or come back to where they were; the
///    best placement seen is kept.
///  - *Locally*: single cones are moved to vertices nearby, always where most is gained, as long as that makes it better.
///  - *Rounded*, if there is an `angle_quantum`: the angles become positive multiples of it, with the least possible largest error among those which
///    Gauss and Bonnet's formula allows. A cone with the angle 2 pi is none any more. The others are moved locally again, now with these angles.
///    Unless `Cone_angles::ZERO_U` is asked for, other multiples, the closest vectors for p-norms of u, and other places are tried from there, and
///    taken if the metric is better.
///
/// All of this uses one factorization; the metric with the cones found is then solved for to full precision. Where nothing determines the scale of a
/// closed surface, u is such that the largest |u| is least, or, with `Cone_measure::ROOT_MEAN_SQUARE_U`, that its mean is 0.
///
/// To have the same metric from `flatten()`, pass the cones with their angles, as `cone_angle_map`; on a closed surface that leaves the scale open.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam VertexAngleMap a model of `WritablePropertyMap` with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type
/// `double`
///
/// \param tm a triangle mesh: one component, of any topology
/// \param cone_angle_map receives the angle sums, in radians, of all vertices that are not on the border: those of the cones, and 2 pi
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below. The number of cones or a bound must be
///        given; cones are placed until there are as many, or all bounds that are given are met.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{number_of_cones}
///     \cgalParamDescription{how many cones}
///     \cgalParamType{`std::size_t`}
///     \cgalParamDefault{as many as it takes to meet the bounds, at most 256}
///   \cgalParamNEnd
///   \cgalParamNBegin{maximum_log_scale_factor}
///     \cgalParamDescription{the bound on |u|}
///     \cgalParamType{`double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{maximum_area_distortion}
///     \cgalParamDescription{the bound on the factor by which areas are scaled relative to the mean: on the largest max(a, 1 / a) of all faces, a = (scaled area / area) / (total scaled area / total area); faces without area do not count. Where edges were flipped, a is that of vertices, with e^{2u} for the first quotient}
///     \cgalParamType{`double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{maximum_root_mean_square}
///     \cgalParamDescription{the bound on the area-weighted root mean square of u, less its mean (`Cone_placement::root_mean_square`)}
///     \cgalParamType{`double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{angle_quantum}
///     \cgalParamDescription{2 pi / n: angles are rounded to multiples of it (radians)}
///     \cgalParamType{`double`}
///     \cgalParamDefault{`0`: they are not}
///   \cgalParamNEnd
///   \cgalParamNBegin{cone_measure}
///     \cgalParamDescription{what is to be small}
///     \cgalParamType{`Cone_measure`}
///     \cgalParamDefault{that of the bound given, the first in the order of this list; without any, `Cone_measure::MAXIMUM_U`}
///   \cgalParamNEnd
///   \cgalParamNBegin{cone_angles}
///     \cgalParamDescription{what determines the angles}
///     \cgalParamType{`Cone_angles`}
///     \cgalParamDefault{`Cone_angles::CHOSEN`}
///   \cgalParamNEnd
///   \cgalParamNBegin{number_of_sweeps}
///     \cgalParamDescription{of the concurrent optimization of cones with u = 0, at most}
///     \cgalParamType{`std::size_t`}
///     \cgalParamDefault{`10`}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{edge_length_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{mollification} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{log_scale_factor_map}
///     \cgalParamDescription{receives u of the metric with the cones}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{gradient_tolerance} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{number_of_iterations} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{number_of_threads} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{newton_strategy} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{retriangulation} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{border_edges} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{visitor} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{sparse_linear_solver} \cgalParamDescription{as in `compute_conformal_metric()`} \cgalParamNEnd
///   \cgalParamNBegin{flattening_report}
///     \cgalParamDescription{receives a copy of what is returned}
///     \cgalParamType{`std::reference_wrapper<Flattening_report<TriangleMesh> >`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the report, with the cones. Maps are written iff there are any: if it is a success; with `STOPPED_BY_VISITOR`, if a placement had been
///         solved for by then, with the best of these; and with `BOUND_NOT_MET`: then with the best placement found, `amount` is its largest |u| if
///         that is too large, else its area distortion if that is, else its root mean square of u. Statuses: those of `import_mesh()`;
///         `WRONG_TOPOLOGY` (several components); `MISSING_CONDITION` (neither number nor bounds; or fewer than three cones on a
///         sphere); `TOO_MANY_CONES` (more than vertices); `ANGLE_OUT_OF_RANGE` (the quantum is not 2 pi / n); `NOT_QUANTIZABLE`; those of
///         `Conformal_metric_solver::solve()`.
///
/// Time: two solutions with the one factor for each cone that is put, and one for each that is moved; for n vertices and k cones,
/// O(n k^2) for each change of the curvatures. Memory O(n) for each place where a cone has been, up to 240 megabytes.
template <typename TriangleMesh, typename VertexAngleMap, typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> place_cones(const TriangleMesh& tm,
                                            VertexAngleMap cone_angle_map,
                                            const NamedParameters& np = parameters::default_values())
{
  static_assert(internal::Check_vertex_map<VertexAngleMap, TriangleMesh>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_place_cones, TriangleMesh, NamedParameters>::value);
  const internal::Stopwatch stopwatch;
  const Imported_mesh<TriangleMesh, double> mesh = import_mesh(tm, np);
  Flattening_report<TriangleMesh> report = internal::import_report(mesh);
  const double seconds = stopwatch.seconds();
  if(bool(report))
  {
    const Cone_placement<double> placement = place_cones(mesh.triangulation, np);
    internal::report_cones(mesh, placement, report);
    if(internal::has_cones(placement))
    {
      internal::write_cone_angles(mesh, report, cone_angle_map);
      internal::write_log_scale_factors(mesh, placement.metric, np);
    }
  }
  report.statistics.seconds.import = seconds;
  internal::write_if_given(np, internal_np::conformal_report, report);
  return report;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_PLACE_CONES_H
