// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file map_to_sphere.h
/// A closed surface without handles as the unit sphere (section 4.3 of Springborn, Schroeder and Pinkall, 2008): one vertex is sent to infinity, what
/// is left is laid out in the plane, projected to the sphere, and the vertex comes back where the pole is. With flips there is a map for every
/// such surface, and it is one-to-one (Rivin, 1996; Springborn, 2020, section 7). A Moebius transformation then puts the barycentre
/// of the vertices in the centre (Springborn, 2005), so that the result does not depend on the vertex chosen.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_MAP_TO_SPHERE_H
#define CGAL_CONFORMAL_EQUIVALENCE_MAP_TO_SPHERE_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Spherical_refinement.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Doors/parameters_of_doors.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Sphere_mapping.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/write_refined_sphere.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <CGAL/assertions.h>

#include <type_traits>
#include <utility>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceDoors
///
/// maps a closed triangle mesh of genus 0 to the unit sphere: the chords between the images of the vertices are discretely conformally equivalent to
/// the edges of the mesh, all around every vertex. The barycentre of the vertices is the centre of the sphere.
///
/// On the triangulation of the mesh (`Retriangulation::NEVER`, or `WHEN_NEEDED` if that is possible) every triangle becomes a triangle of great arcs,
/// and length cross ratios are preserved. The result is kept only if all of these triangles are positive. Otherwise edges are flipped, as by
/// `flatten()`; the images of the vertices are then the corners of a convex polyhedron
/// that exists for every mesh, and triangles become the parts of `spherical_refinement`; straight triangles between the images may be flipped, which
/// is an error (`NOT_INJECTIVE`) unless the refinement is asked for. `map_to_sphere_refined()` makes a mesh of it.
///
/// Triangles are judged by exact predicates on the coordinates as they were computed, in pairs of `double`. If all are positive, and the solid angles
/// sum up to 4 pi (`Flattening_report::solid_angle`), the map is one-to-one. Where parts of the mesh become so small on the sphere that
/// `double` cannot tell their points apart, triangles may be lost when the points are rounded: these are counted exactly, and listed
/// (`Flattening_report::rounded_faces`); `map_to_sphere<NT>()` with more digits keeps them.
///
/// \tparam NT number type of lengths, and of the points: `double`, or a binary floating-point number of Boost.Multiprecision
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam VertexPointMap a model of `WritablePropertyMap` with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a value type
///        that can be made from three `NT`, such as `Point_3`
///
/// \param tm a triangle mesh: one component, without border and handles, with at least four vertices, apart from isolated ones
/// \param sphere_map receives the points; isolated vertices get none
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map} \cgalParamDescription{as in `import_mesh()`; the result is turned so that it is as near to these points as it can be} \cgalParamNEnd
///   \cgalParamNBegin{edge_length_map} \cgalParamDescription{as in `import_mesh()`; then the first vertex becomes (0, 0, 1), and the second one has y = 0 and x > 0} \cgalParamNEnd
///   \cgalParamNBegin{mollification} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{vertex_at_infinity}
///     \cgalParamDescription{the vertex that is sent to infinity on the way; the result depends on it by rounding only. Another one is taken where this one gives no result, but that does}
///     \cgalParamType{`boost::graph_traits<TriangleMesh>::%vertex_descriptor`}
///     \cgalParamDefault{the null vertex: one with well-shaped triangles around it is taken}
///   \cgalParamNEnd
///   \cgalParamNBegin{moebius_weights}
///     \cgalParamDescription{what has its barycentre in the centre}
///     \cgalParamType{`Moebius_weights`}
///     \cgalParamDefault{`Moebius_weights::VERTICES`}
///   \cgalParamNEnd
///   \cgalParamNBegin{log_scale_factor_map}
///     \cgalParamDescription{receives u: chords are e^{(u_i + u_j) / 2} times as long as edges}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{projective_weight_map}
///     \cgalParamDescription{receives the weights e^{-u} of projective interpolation, scaled to a maximum of 1}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{spherical_refinement}
///     \cgalParamDescription{receives the overlay of the mesh with the polyhedron, in triangles. Straight triangles that are flipped are then not refused, but listed in the report (`bent_faces`)}
///     \cgalParamType{`std::reference_wrapper<Spherical_refinement<NT> >`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{gradient_tolerance} \cgalParamDescription{as in `Conformal_metric_solver::solve()`; the solution is refined as far as the number type allows} \cgalParamNEnd
///   \cgalParamNBegin{number_of_iterations} \cgalParamDescription{as in `Conformal_metric_solver::solve()`; the solution is refined as far as the number type allows} \cgalParamNEnd
///   \cgalParamNBegin{number_of_threads} \cgalParamDescription{as in `Conformal_metric_solver::solve()`; the solution is refined as far as the number type allows} \cgalParamNEnd
///   \cgalParamNBegin{newton_strategy} \cgalParamDescription{as in `Conformal_metric_solver::solve()`; the solution is refined as far as the number type allows} \cgalParamNEnd
///   \cgalParamNBegin{retriangulation} \cgalParamDescription{as in `Conformal_metric_solver::solve()`; the solution is refined as far as the number type allows} \cgalParamNEnd
///   \cgalParamNBegin{visitor} \cgalParamDescription{as in `Conformal_metric_solver::solve()`; the solution is refined as far as the number type allows} \cgalParamNEnd
///   \cgalParamNBegin{sparse_linear_solver} \cgalParamDescription{as in `compute_conformal_metric()`} \cgalParamNEnd
///   \cgalParamNBegin{flattening_report}
///     \cgalParamDescription{receives a copy of what is returned}
///     \cgalParamType{`std::reference_wrapper<Flattening_report<TriangleMesh> >`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the report. Maps are written iff it is a success. Statuses: those of `import_mesh()`; `WRONG_TOPOLOGY`, with what was found
///         (`Flattening_report::topology`); those of `Conformal_metric_solver::solve()`; `SINGULAR_PROBLEM` if no Moebius transformation centres the
///         barycentre: with `Moebius_weights::AREAS` where no triangle has an area; `NOT_INJECTIVE` (faces); those of `compute_common_refinement()`
///         if the refinement was asked for.
///
/// Time is that of `flatten()` for a disk of that size; with flips that of a few of them.
///
/// \sa `CGAL::Conformal_equivalence::map_to_disk()`
template <typename NT = double, typename TriangleMesh, typename VertexPointMap, typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> map_to_sphere(const TriangleMesh& tm,
                                              VertexPointMap sphere_map,
                                              const NamedParameters& np = parameters::default_values())
{
  static_assert(internal::Check_vertex_map<VertexPointMap, TriangleMesh>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_map_to_sphere, TriangleMesh, NamedParameters>::value);
  constexpr bool is_refined = internal::is_given<internal_np::conformal_spherical_refinement_t, NamedParameters>;
  internal::Sphere_mapping<TriangleMesh, NT> mapping(tm);
  mapping.run(np, std::bool_constant<is_refined>());
  if(bool(mapping.report))
  {
    internal::write_sphere(mapping, sphere_map, np);
    internal::write_if_given(np, internal_np::conformal_spherical_refinement, std::move(mapping.refinement));
  }
  internal::write_report(mapping.report, np);
  return std::move(mapping.report);
}

/// \ingroup PkgConformalEquivalenceDoors
///
/// maps a closed triangle mesh of genus 0 to the unit sphere, as `map_to_sphere()` does, and makes a mesh of the parts into which the edges of the
/// convex polyhedron on the sphere cut the given one. Where no edge was flipped that is a copy.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam RefinedMesh a model of `MutableFaceGraph`
/// \tparam VertexPointMap a model of `WritablePropertyMap` with key type `boost::graph_traits<RefinedMesh>::%vertex_descriptor` and a value type that
///         can be made from three `double`
///
/// \param tm a triangle mesh
/// \param refined the mesh to be made, empty: vertices of `tm` come first, in the order of `vertices(tm)`, then the crossings of edges, which lie on
///        edges of `tm`. Its faces are triangles unless these would make several edges between the same two vertices.
/// \param sphere_map receives the points of the sphere
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of `map_to_sphere()`, with maps of `tm`
/// \param np_refined an optional sequence of \ref bgl_namedparameters "Named Parameters" for `refined`, among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{receives the points of the surface}
///     \cgalParamType{a read-write property map with key type `boost::graph_traits<RefinedMesh>::%vertex_descriptor` and as value type a `Point_3` that can be made from three coordinates}
///     \cgalParamDefault{`get(CGAL::vertex_point, refined)`}
///   \cgalParamNEnd
///   \cgalParamNBegin{projective_weight_map}
///     \cgalParamDescription{receives the weights w, see `Spherical_refinement`}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<RefinedMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{input_face_map}
///     \cgalParamDescription{receives the face of `tm` that a face of `refined` is a part of}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<RefinedMesh>::%face_descriptor` and value type `boost::graph_traits<TriangleMesh>::%face_descriptor`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the report of `map_to_sphere()`, with `bent_faces`; `NOT_REPRESENTABLE` if `refined` cannot hold the result. Meshes and maps are written
///        iff it is a success.
template <typename TriangleMesh, typename RefinedMesh, typename VertexPointMap,
          typename NamedParameters = parameters::Default_named_parameters,
          typename NamedParametersRefined = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> map_to_sphere_refined(const TriangleMesh& tm,
                                                      RefinedMesh& refined,
                                                      VertexPointMap sphere_map,
                                                      const NamedParameters& np = parameters::default_values(),
                                                      const NamedParametersRefined& np_refined = parameters::default_values())
{
  static_assert(internal::Check_vertex_map<VertexPointMap, RefinedMesh>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_map_to_sphere, TriangleMesh, NamedParameters>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_refined_sphere, RefinedMesh, NamedParametersRefined>::value);
  CGAL_precondition(vertices(refined).begin() == vertices(refined).end());
  internal::Sphere_mapping<TriangleMesh, double> mapping(tm);
  mapping.run(np, std::true_type());
  if(bool(mapping.report) && !internal::write_refined_sphere(mapping, refined, sphere_map, np, np_refined))
    mapping.report.status = Status::NOT_REPRESENTABLE;
  if(bool(mapping.report))
    internal::write_weights_of_sphere(mapping, np);
  if(bool(mapping.report))
    internal::write_if_given(np, internal_np::conformal_spherical_refinement, std::move(mapping.refinement));
  internal::write_report(mapping.report, np);
  return std::move(mapping.report);
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_MAP_TO_SPHERE_H
