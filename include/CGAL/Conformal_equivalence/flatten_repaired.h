// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file flatten_repaired.h
/// The whole way in one call with the remedy of section 3.2 of Springborn, Schroeder and Pinkall, 2008: where the metric found
/// breaks triangles, edges are flipped or split, on a copy of the mesh, which is laid out.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_REPAIRED_H
#define CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_REPAIRED_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Repaired_metric.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Doors/Repaired_flattening.h>
#include <CGAL/Conformal_equivalence/internal/Doors/output_maps.h>
#include <CGAL/Conformal_equivalence/internal/Doors/parameters_of_doors.h>
#include <CGAL/Conformal_equivalence/internal/Doors/repaired_output_maps.h>
#include <CGAL/Conformal_equivalence/make_repaired_mesh.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceDoors
///
/// What `flatten_repaired()` reports: about the mesh given, with its elements, and about the mesh made. (In
/// `Flattening_report::transitions` there is nothing, and `Period_lattice::face` is the position of a face in `faces(repaired)`.)
template <typename TriangleMesh, typename RepairedMesh>
struct [[nodiscard]] Repair_report : public Flattening_report<TriangleMesh>
{
  std::vector<Edge_change<double> > changes;                             ///< how the triangulation was changed, in order
  std::vector<Seam_transition<RepairedMesh> > repaired_transitions;      ///< one for every edge of the seam
  Repaired_mesh_elements<RepairedMesh> elements;                         ///< the mesh made, by numbers of the triangulation
};

/// \ingroup PkgConformalEquivalenceDoors
///
/// flattens a triangle mesh of any topology, as `flatten()` does on a fixed triangulation; where the metric found breaks
/// triangles, edges are flipped or split, see `repair_locally()`, on a copy of the mesh, for which the texture coordinates are.
/// Where nothing had to be changed it is just a copy. On the copy, length cross ratios are those of the surface given: distances
/// across flipped edges are measured on it, not in space.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam RepairedMesh a model of `MutableFaceGraph`
/// \tparam HalfedgeUVMap a model of `WritablePropertyMap` with key type `boost::graph_traits<RepairedMesh>::%halfedge_descriptor`
///         and a value type that can be made from two `double`
///
/// \param tm a triangle mesh. It is not modified.
/// \param repaired the mesh to be made, empty; see `make_repaired_mesh()`
/// \param uv receives, at every halfedge `h` of `repaired`, where `target(h)` lies in `face(h)`; a border halfedge receives what
///        `prev(opposite(h))` does
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" with maps of `tm`, as in `flatten()`:
///        `vertex_point_map`, `edge_length_map`, `border_angle_map`, `cone_angle_map`, `vertex_is_constrained_map`,
///        `prescribed_log_scale_factor_map`, `initial_log_scale_factor_map`, `gradient_tolerance`, `number_of_iterations`,
///        `newton_strategy`, `sparse_linear_solver`, `layout_frame`, `visitor`, `flattening_report`; `maximum_number_of_changes`
///        as in `repair_locally()`; and the ones listed below. The others of `flatten()` are not read.
/// \param np_repaired an optional sequence of \ref bgl_namedparameters "Named Parameters" with maps of `repaired`, which are
///        written: `vertex_point_map`, as in `make_repaired_mesh()`; `log_scale_factor_map`, `projective_weight_map` and
///        `edge_is_seam_map`, as in `flatten()`
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{edge_is_seam_map}
///     \cgalParamDescription{`true` where the surface is to be cut in any case; such edges are not flipped, but may be split}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%edge_descriptor` and value type `bool`}
///     \cgalParamDefault{`false` for all edges}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_is_constrained_map}
///     \cgalParamDescription{`true` where the surface must not be cut; such edges are not flipped, but may be split}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%edge_descriptor` and value type `bool`}
///     \cgalParamDefault{`false` for all edges}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the report, with the changes. Meshes and maps are written iff it is a success. Statuses: those of `flatten()` and
///         `repair_locally()`, and `NOT_REPRESENTABLE` if `repaired` cannot hold the result. After changes, faces at fault are
///         told by those of their vertices that are vertices of `tm`.
///
/// Time is that of `repair_locally()`, and O(n log n) for the cut; all else is linear.
///
/// \sa `CGAL::Conformal_equivalence::flatten()`
template <typename TriangleMesh, typename RepairedMesh, typename HalfedgeUVMap,
          typename NamedParameters = parameters::Default_named_parameters,
          typename NamedParametersRepaired = parameters::Default_named_parameters>
Repair_report<TriangleMesh, RepairedMesh>
flatten_repaired(const TriangleMesh& tm,
                 RepairedMesh& repaired,
                 HalfedgeUVMap uv,
                 const NamedParameters& np = parameters::default_values(),
                 const NamedParametersRepaired& np_repaired = parameters::default_values())
{
  static_assert(internal::Check_halfedge_map<HalfedgeUVMap, RepairedMesh>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_flatten_repaired, TriangleMesh, NamedParameters>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_repaired_mesh, RepairedMesh, NamedParametersRepaired>::value);
  internal::Repaired_flattening<TriangleMesh> flattening(tm);
  flattening.run(np);
  Repair_report<TriangleMesh, RepairedMesh> report;
  static_cast<Flattening_report<TriangleMesh>&>(report) = std::move(flattening.report);
  report.changes = flattening.repaired.changes;
  if(bool(report))
  {
    report.elements = make_repaired_mesh(flattening.mesh, flattening.repaired, repaired, np, np_repaired);
    if(report.elements.faces.empty())
      report.status = Status::NOT_REPRESENTABLE;
  }
  if(bool(report))
  {
    internal::write_repaired_corners(flattening, report.elements, repaired, uv);
    internal::write_repaired_maps(flattening, report.elements, repaired, np_repaired);
    report.repaired_transitions = internal::repaired_transitions(flattening.layout, report.elements);
  }
  internal::write_report<TriangleMesh>(report, np);
  return report;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_REPAIRED_H
