// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file flatten.h
/// The whole way in one call: from a mesh of any topology and conditions to texture coordinates
/// (sections 3 to 5 of Springborn, Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_H
#define CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/internal/Doors/Flattening.h>
#include <CGAL/Conformal_equivalence/internal/Doors/output_maps.h>
#include <CGAL/Conformal_equivalence/internal/Doors/parameters_of_doors.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <utility>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceDoors
///
/// flattens a triangle mesh of any topology: finds the metric that is conformally equivalent to the mesh's, is flat except at cones, and
/// meets the conditions; cuts the surface open where that is needed, and lays it out in the plane. The result preserves length cross ratios
/// to rounding, the two sides of every seam edge have equal lengths, and no triangle is flipped, decided exactly on the coordinates
/// written.
///
/// The mesh may be closed or have any number of borders, none of which is filled, any number of handles, and any number of
/// components, each of which is a problem of its own. The layouts of the components do not overlap one another. Isolated vertices
/// are carried through untouched.
///
/// The triangulation is kept where it has a solution, see `retriangulation`. If edges were flipped, length cross ratios are not preserved, as
/// it is another triangulation that was scaled; points are written for the corners of the mesh, whose edges are no straight
/// lines in the flat surface, and a straight triangle between these points may be flipped, which is reported (`NOT_INJECTIVE`). The
/// map is continuous and positive on the parts of the triangles that the edges of both triangulations make: with `common_refinement` these
/// are what the verdict is on, and `flatten_refined()` makes a mesh of them.
///
/// *Cones* are interior vertices whose angle sum is prescribed (`cone_angle_map`) and not 2 pi, or where u is prescribed instead
/// (`vertex_is_constrained_map`: a free cone). On a component where no u is prescribed, the curvatures 2 pi - angle at interior vertices
/// and pi - angle on borders sum up to 2 pi chi (Gauss-Bonnet). So a closed surface needs cones, at least three on a sphere,
/// unless it is a torus: that has a flat metric without cones, and a lattice of periods, which the report holds.
///
/// *Charts*: with `face_patch_map` every maximal set of faces of one patch that is connected through edges is a surface of its own, and the
/// edges between patches are borders. Maps of vertices hold for all charts at a vertex; what is written to one is what was found for one of
/// them (for natural borders, u = 0 for all).
///
/// A `Seam_mesh` is taken for the surface that it is, cut open, with maps of its own vertices and edges; to use its seam
/// just for cutting, see `Surface_mesh_parameterization::Conformal_equivalence_parameterizer_3`.
///
/// Lengths, angles and points may have more digits than `double`: `flatten<NT>(tm, uv, np)`, where `NT` is a binary floating-point number of
/// Boost.Multiprecision; for as many digits as it holds with `gradient_tolerance(0.)`, where the status then is `CONVERGED_TO_ROUNDING`. The
/// verdict is on the points of that type.
///
/// \tparam NT number type of lengths, of u, and of the points
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam HalfedgeUVMap a model of `WritablePropertyMap` with key type
///         `boost::graph_traits<TriangleMesh>::%halfedge_descriptor` and a value type that can be made from two `NT`, for `double` such as
///         `Point_2` of any kernel
/// \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
///
/// \param tm a triangle mesh
/// \param uv receives, at every halfedge `h`, where `target(h, tm)` lies in the triangle of `face(h, tm)`; a
///        border halfedge receives what `prev(opposite(h, tm), tm)` does. So `uv[target(hd, seam_mesh)]` is what it should be for the `Seam_mesh`
///        that `make_seam_mesh()` makes of the seam.
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{edge_length_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{mollification} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{face_patch_map}
///     \cgalParamDescription{the patches of the faces}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%face_descriptor` and any value type with `==`}
///     \cgalParamDefault{none: no edge is a border that is not one of the mesh}
///   \cgalParamNEnd
///   \cgalParamNBegin{border_angle_map} \cgalParamDescription{as in `read_conditions()`} \cgalParamNEnd
///   \cgalParamNBegin{cone_angle_map} \cgalParamDescription{as in `read_conditions()`} \cgalParamNEnd
///   \cgalParamNBegin{vertex_is_constrained_map} \cgalParamDescription{as in `read_conditions()`} \cgalParamNEnd
///   \cgalParamNBegin{prescribed_log_scale_factor_map} \cgalParamDescription{as in `read_conditions()`} \cgalParamNEnd
///   \cgalParamNBegin{edge_is_seam_map}
///     \cgalParamDescription{on entry, `true` where the surface is to be cut in any case; receives the whole seam: the edges cut, and those between charts}
///     \cgalParamType{a read-write property map with key type `boost::graph_traits<TriangleMesh>::%edge_descriptor` and value type `bool`, copies of which share their values}
///     \cgalParamDefault{`false` for all edges}
///     \cgalParamExtra{Border edges are never seam edges, whatever is given for them.}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_is_constrained_map}
///     \cgalParamDescription{`true` where the surface must not be cut}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%edge_descriptor` and value type `bool`}
///     \cgalParamDefault{`false` for all edges}
///   \cgalParamNEnd
///   \cgalParamNBegin{seam_weight_map}
///     \cgalParamDescription{what it costs to cut an edge, see `compute_cut_graph()`}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%edge_descriptor` and a value type convertible to `double`}
///     \cgalParamDefault{the lengths}
///   \cgalParamNEnd
///   \cgalParamNBegin{initial_log_scale_factor_map}
///     \cgalParamDescription{where the solver begins}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a value type convertible to `double`}
///     \cgalParamDefault{the discretely harmonic extension of the fixed u}
///   \cgalParamNEnd
///   \cgalParamNBegin{log_scale_factor_map}
///     \cgalParamDescription{receives u}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{projective_weight_map}
///     \cgalParamDescription{receives the weights e^{-u} of projective interpolation (section 3.4), scaled to a maximum of 1}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{scaled_edge_length_map}
///     \cgalParamDescription{receives the lengths of the edges in the flat metric, or, if edges were flipped, of the straight lines that replace them}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%edge_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{layout_frame}
///     \cgalParamDescription{how the layout is placed in the plane}
///     \cgalParamType{`Layout_frame`, or `Pinned_frame<vertex_descriptor>`}
///     \cgalParamDefault{`Layout_frame::CANONICAL`}
///   \cgalParamNEnd
///   \cgalParamNBegin{gradient_tolerance} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{number_of_iterations} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{number_of_threads} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{newton_strategy} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{retriangulation} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{border_edges} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{visitor} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{sparse_linear_solver} \cgalParamDescription{as in `compute_conformal_metric()`} \cgalParamNEnd
///   \cgalParamNBegin{common_refinement}
///     \cgalParamDescription{if edges were flipped, receives the overlay of the mesh with the triangulation of the metric, see `compute_common_refinement()`; otherwise one without faces. Straight triangles that are flipped are then not refused, but listed in the report (`bent_faces`)}
///     \cgalParamType{`std::reference_wrapper<Common_refinement<NT> >`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{flattening_report}
///     \cgalParamDescription{receives a copy of what is returned}
///     \cgalParamType{`std::reference_wrapper<Flattening_report<TriangleMesh> >`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the report, with the cones, the motions across the seam edges, and the lattices of tori. Maps are written iff it is a success.
///         Statuses: those of `import_mesh()` and `Conformal_metric_solver::solve()`, `MISSING_CONDITION` (vertices), those of
///         `compute_cut_graph()` (edges, faces), those of `compute_common_refinement()` if it was asked for, and `NOT_INJECTIVE` (faces: triangles
///         that are flat or flipped: straight triangles where edges were flipped, or, where scale factors range too far for `double`, by rounding).
///
/// Time is that of the solver, see `Conformal_metric_solver::solve()`, and O(n log n) for the cut; all else is linear.
///
/// \sa `CGAL::Conformal_equivalence::make_seam_mesh()`
/// \sa `CGAL::Conformal_equivalence::verify_layout()`
template <typename NT = double, typename TriangleMesh, typename HalfedgeUVMap,
          typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> flatten(const TriangleMesh& tm,
                                        HalfedgeUVMap uv,
                                        const NamedParameters& np = parameters::default_values())
{
  static_assert(internal::Check_halfedge_map<HalfedgeUVMap, TriangleMesh>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_flatten, TriangleMesh, NamedParameters>::value);
  constexpr bool is_refined = internal::is_given<internal_np::conformal_common_refinement_t, NamedParameters>;
  const internal::Stopwatch stopwatch;
  internal::Flattening<TriangleMesh, NT> flattening(internal::import_charts<NT>(tm, np), stopwatch);
  if constexpr(is_refined)
    flattening.run_with_refinement(np, false);
  else
    flattening.run(np);
  if(bool(flattening.report))
  {
    internal::write_corners(flattening.mesh, flattening.layout, uv);
    internal::write_metric(flattening, np);
    internal::write_seam(flattening, np);
    if constexpr(is_refined)
      internal::write_if_given(np, internal_np::conformal_common_refinement, std::move(flattening.refinement));
  }
  internal::write_report(flattening.report, np);
  return std::move(flattening.report);
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_H
