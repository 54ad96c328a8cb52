// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file boundary_conditions.h
/// Functions that fill the property maps by which conditions on a mesh are described (sections 4.1, 4.2 and 5 of Springborn, Schroeder and
/// Pinkall, 2008); `read_conditions.h` says how they are described.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_BOUNDARY_CONDITIONS_H
#define CGAL_CONFORMAL_EQUIVALENCE_BOUNDARY_CONDITIONS_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Rectangle_corners.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>
#include <CGAL/Conformal_equivalence/read_conditions.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Conformal_equivalence {

namespace internal {

// The border halfedge that ends at `v`. \pre `v` is a border vertex
template <typename TriangleMesh>
typename boost::graph_traits<TriangleMesh>::halfedge_descriptor
border_halfedge_to(typename boost::graph_traits<TriangleMesh>::vertex_descriptor v, const TriangleMesh& tm)
{
  auto result = halfedge(v, tm);
  for(const auto h : halfedges_around_target(v, tm))
    if(is_border(h, tm))
      result = h;
  CGAL_precondition(is_border(result, tm));
  return result;
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceSolver
///
/// writes the border angles of a rectangle: pi / 2 at the four corners, pi at the other
/// vertices of the border on which `corners[0]` lies. Linear in the length of that border.
///
/// \param tm a triangle mesh
/// \param corners four different vertices of one border. If `corners[0]` is the null vertex, as when
///        `select_rectangle_corners()` found none, nothing is written.
/// \param border_angle_map a writable property map with key type
///        `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double` (radians)
///
/// \pre `corners[0]` is a border vertex or null.
template <typename TriangleMesh, typename VertexAngleMap>
void prescribe_rectangle(const TriangleMesh& tm,
                         const std::array<typename boost::graph_traits<TriangleMesh>::vertex_descriptor, 4>& corners,
                         VertexAngleMap border_angle_map)
{
  if(corners[0] == boost::graph_traits<TriangleMesh>::null_vertex())
    return;
  for(const auto h : halfedges_around_face(internal::border_halfedge_to(corners[0], tm), tm))
  {
    const bool is_corner = std::find(corners.begin(), corners.end(), target(h, tm)) != corners.end();
    put(border_angle_map, target(h, tm), is_corner ? CGAL_PI / 2 : CGAL_PI);
  }
}

namespace internal {

// The corners among the vertices of the border of `bhd`, which may be null. The report is told why there are none.
template <typename TriangleMesh>
std::array<typename boost::graph_traits<TriangleMesh>::vertex_descriptor, 4>
find_rectangle_corners(const Imported_mesh<TriangleMesh>& mesh, typename boost::graph_traits<TriangleMesh>::halfedge_descriptor bhd,
                       Retriangulation retriangulation, const Any_visitor& visitor, Flattening_report<TriangleMesh>& report)
{
  std::array<typename boost::graph_traits<TriangleMesh>::vertex_descriptor, 4> corners;
  corners.fill(boost::graph_traits<TriangleMesh>::null_vertex());
  if(bool(report) && (bhd == boost::graph_traits<TriangleMesh>::null_halfedge() || !report.topology.is_disk()))
    report.status = Status::WRONG_TOPOLOGY;
  if(!bool(report))
    return corners;
  const std::uint32_t first = mesh.triangulation.next_on_border(mesh.index_of_halfedge(opposite(bhd, mesh.mesh())));
  const Rectangle_corners found = internal::select_rectangle_corners(mesh.triangulation, first, retriangulation, visitor);
  report.status = found.status;
  report.amount = found.amount;
  name_elements(mesh, found.vertices, {}, {}, report);
  if(is_success(found.status))
    for(std::size_t k = 0; k < 4; ++k)
      corners[k] = mesh.vertex(found.corners[3 - k]); // CGAL's border halfedges run the other way
  return corners;
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceSolver
///
/// chooses the corners for a rectangle with little distortion. Up to four border vertices with one
/// triangle are corners; where there are more, only a map with flipped edges makes them straight. The others are chosen among the
/// vertices of extreme turning of the natural map's border, so that the Dirichlet energy of u (App. E) is least: first exactly for the
/// linearized problem (12), by trying all choices; then for the problem linearized at the metric of the best choice so far, of which the most
/// promising choices are solved for, five at most. On meshes with less than 200 vertices no exchange of a single corner is better.
///
/// Time is that of some five maps to a rectangle, with flips where the map needs them.
///
/// \param tm a triangle mesh
/// \param bhd a halfedge of the border of a topological disk; `null_halfedge()` is refused (`WRONG_TOPOLOGY`)
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{edge_length_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{retriangulation}
///     \cgalParamDescription{whether edges are flipped by the map for which the corners are}
///     \cgalParamType{`Retriangulation`}
///     \cgalParamDefault{`Retriangulation::WHEN_NEEDED`}
///   \cgalParamNEnd
///   \cgalParamNBegin{visitor} \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{flattening_report}
///     \cgalParamDescription{is told why there are no corners}
///     \cgalParamType{`std::reference_wrapper<Flattening_report<TriangleMesh> >`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the corners in their order along the border (as halfedges `next(bhd)` run); four null vertices if there are none.
///         The report then has a status of `import_mesh()` or of the solver, `WRONG_TOPOLOGY`, `MISSING_CONDITION` (fewer than
///         four border vertices), or `ANGLE_OUT_OF_RANGE` (more than four border vertices with a single triangle,
///         which cannot be straight with `Retriangulation::NEVER`).
template <typename TriangleMesh, typename NamedParameters = parameters::Default_named_parameters>
std::array<typename boost::graph_traits<TriangleMesh>::vertex_descriptor, 4>
select_rectangle_corners(const TriangleMesh& tm,
                         typename boost::graph_traits<TriangleMesh>::halfedge_descriptor bhd,
                         const NamedParameters& np = parameters::default_values())
{
  CGAL_precondition(bhd == boost::graph_traits<TriangleMesh>::null_halfedge() // what PMP::longest_border() returns for closed meshes
                    || is_border(bhd, tm));
  const Imported_mesh<TriangleMesh> mesh = import_mesh(tm, np);
  Flattening_report<TriangleMesh> report = internal::import_report(mesh);
  const Retriangulation retriangulation = parameters::choose_parameter(
    parameters::get_parameter(np, internal_np::conformal_retriangulation), Retriangulation::WHEN_NEEDED);
  const auto corners = internal::find_rectangle_corners(mesh, bhd, retriangulation, internal::visitor_of(np), report);
  internal::write_if_given(np, internal_np::conformal_report, report);
  return corners;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_BOUNDARY_CONDITIONS_H
