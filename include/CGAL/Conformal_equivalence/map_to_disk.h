// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file map_to_disk.h
/// A topological disk as the unit disk, with all border vertices on the circle (sections 4.2 and 4.3 of Springborn, Schroeder and Pinkall, 2008): one
/// border vertex is sent to infinity, the border becomes a straight line, and a Moebius transformation takes the half-plane to the disk. With flips
/// there is a map for every disk: one half of the map of its double to the sphere.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_MAP_TO_DISK_H
#define CGAL_CONFORMAL_EQUIVALENCE_MAP_TO_DISK_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/Disk_frame.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Doors/parameters_of_doors.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Disk_mapping.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/make_refined_mesh.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <utility>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceDoors
///
/// maps a topological disk to the unit disk: the image is a polygon inscribed to the unit circle, with all border vertices on the circle, and
/// discretely conformally equivalent to the mesh. Among these maps, which differ by Moebius transformations of the disk, `disk_frame` tells which.
///
/// On the triangulation of the mesh (`Retriangulation::NEVER`, or `WHEN_NEEDED` if that is possible) triangles become straight triangles, and length
/// cross ratios are preserved; the result is kept only if all triangles are positive. Otherwise edges are flipped, on the double of the surface, as
/// by `map_to_sphere()`: there is a map for every disk, which is straight on the parts of the triangles that `common_refinement` holds. Straight
/// triangles between the images of the vertices may then be flipped, which is an error (`NOT_INJECTIVE`) unless the refinement is asked for; and a
/// border edge may become a broken line, which is a little nearer to the circle than the chord (`lost_border_edges`). `map_to_disk_refined()` makes a
/// mesh of the refinement.
///
/// Triangles are judged by exact predicates on the coordinates as they were computed, in pairs of `double`; those that are positive there, but not
/// when rounded, are listed (`Flattening_report::rounded_faces`). Positive triangles and a border that goes around once make the map one-to-one.
///
/// \tparam NT number type of lengths, and of the points: `double`, or a binary floating-point number of Boost.Multiprecision
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam VertexUVMap a model of `WritablePropertyMap` with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a value type that
///         can be made from two `NT`, such as `Point_2`
///
/// \param tm a triangle mesh: one component with one border, without handles, apart from isolated vertices
/// \param disk_map receives the points; isolated vertices get none
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{edge_length_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{mollification} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{disk_frame}
///     \cgalParamDescription{which of the maps}
///     \cgalParamType{`Barycentre_disk_frame`, `Centred_disk_frame<vertex_descriptor>`, or `Three_point_disk_frame<vertex_descriptor>`}
///     \cgalParamDefault{`Barycentre_disk_frame()`}
///   \cgalParamNEnd
///   \cgalParamNBegin{moebius_weights}
///     \cgalParamDescription{what has its barycentre in the centre, for `Barycentre_disk_frame`}
///     \cgalParamType{`Moebius_weights`}
///     \cgalParamDefault{`Moebius_weights::VERTICES`}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_at_infinity}
///     \cgalParamDescription{the border vertex that is sent to infinity on the way}
///     \cgalParamType{`boost::graph_traits<TriangleMesh>::%vertex_descriptor`}
///     \cgalParamDefault{the null vertex: one with well-shaped triangles around it is taken}
///   \cgalParamNEnd
///   \cgalParamNBegin{log_scale_factor_map}
///     \cgalParamDescription{receives u: the straight edges are e^{(u_i + u_j) / 2} times as long as those of the mesh}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{projective_weight_map}
///     \cgalParamDescription{receives the weights e^{-u} of projective interpolation, scaled to a maximum of 1}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{common_refinement}
///     \cgalParamDescription{if edges were flipped, receives the overlay of the mesh with the triangulation of the disk, in triangles; otherwise one without faces}
///     \cgalParamType{`std::reference_wrapper<Common_refinement<NT> >`}
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
///         (`Flattening_report::topology`); those of `Conformal_metric_solver::solve()`; `SINGULAR_PROBLEM` (vertices) if there is no such frame;
///         `NOT_INJECTIVE` (faces); those of `compute_common_refinement()` if the refinement was asked for.
///
/// \sa `CGAL::Conformal_equivalence::map_to_sphere()`
template <typename NT = double, typename TriangleMesh, typename VertexUVMap, typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> map_to_disk(const TriangleMesh& tm,
                                            VertexUVMap disk_map,
                                            const NamedParameters& np = parameters::default_values())
{
  static_assert(internal::Check_vertex_map<VertexUVMap, TriangleMesh>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_map_to_disk, TriangleMesh, NamedParameters>::value);
  constexpr bool is_refined = internal::is_given<internal_np::conformal_common_refinement_t, NamedParameters>;
  internal::Disk_mapping<TriangleMesh, NT> mapping(tm);
  mapping.run(np, is_refined, false);
  if(bool(mapping.report))
  {
    internal::write_disk(mapping, disk_map, np);
    internal::write_if_given(np, internal_np::conformal_common_refinement, std::move(mapping.refinement));
  }
  internal::write_report(mapping.report, np);
  return std::move(mapping.report);
}

/// \ingroup PkgConformalEquivalenceDoors
///
/// maps a topological disk to the unit disk, as `map_to_disk()` does, and makes a mesh of the parts into which the edges of the triangulation of the
/// disk cut the given one. Where no edge was flipped that is a copy.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam RefinedMesh a model of `MutableFaceGraph`
/// \tparam HalfedgeUVMap a model of `WritablePropertyMap` with key type `boost::graph_traits<RefinedMesh>::%halfedge_descriptor` and a
///         value type that can be made from two `double`
///
/// \param tm a triangle mesh
/// \param refined the mesh to be made, empty: vertices of `tm` come first, in the order of `vertices(tm)`, then the crossings of edges, which lie on
///        edges of `tm`
/// \param uv receives, at every halfedge `h` of `refined`, the point of `target(h)`
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of `map_to_disk()`, with maps of `tm`
/// \param np_refined an optional sequence of \ref bgl_namedparameters "Named Parameters" for `refined`: those of `make_refined_mesh()`
///
/// \return the report of `map_to_disk()`, with `bent_faces`; `NOT_REPRESENTABLE` if `refined` cannot hold the result. Meshes and maps are written iff
///        it is a success.
template <typename TriangleMesh, typename RefinedMesh, typename HalfedgeUVMap,
          typename NamedParameters = parameters::Default_named_parameters,
          typename NamedParametersRefined = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> map_to_disk_refined(const TriangleMesh& tm,
                                                    RefinedMesh& refined,
                                                    HalfedgeUVMap uv,
                                                    const NamedParameters& np = parameters::default_values(),
                                                    const NamedParametersRefined& np_refined = parameters::default_values())
{
  static_assert(internal::Check_halfedge_map<HalfedgeUVMap, RefinedMesh>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_map_to_disk, TriangleMesh, NamedParameters>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_refined_mesh, RefinedMesh, NamedParametersRefined>::value);
  internal::Disk_mapping<TriangleMesh, double> mapping(tm);
  mapping.run(np, true, true);
  if(bool(mapping.report) && make_refined_mesh(mapping.mesh, mapping.refinement, refined, uv, np, np_refined).faces.empty())
    mapping.report.status = Status::NOT_REPRESENTABLE;
  if(bool(mapping.report))
    internal::write_weights(mapping.mesh, mapping.weights, np);
  if(bool(mapping.report))
    internal::write_if_given(np, internal_np::conformal_common_refinement, std::move(mapping.refinement));
  internal::write_report(mapping.report, np);
  return std::move(mapping.report);
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_MAP_TO_DISK_H
