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
#include <CGAL/Conformal_equivalence/internal/Cones/Rectangle_corners.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>
#include <CGAL/Conformal_equivalence/read_conditions.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <cstdint>

namespace CGAL {
namespace Conformal_equivalence {

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
  typedef typename boost::graph_traits<TriangleMesh>::halfedge_descriptor halfedge_descriptor;
  if(corners[0] == boost::graph_traits<TriangleMesh>::null_vertex())
    return;
  halfedge_descriptor first = halfedge(corners[0], tm);
  for(halfedge_descriptor h : halfedges_around_target(corners[0], tm))
    if(is_border(h, tm))
      first = h;
  CGAL_precondition(is_border(first, tm));

  halfedge_descriptor h = first;
  do
  {
    const bool is_corner = std::find(corners.begin(), corners.end(), target(h, tm)) != corners.end();
    put(border_angle_map, target(h, tm), is_corner ? CGAL_PI / 2 : CGAL_PI);
    h = next(h, tm);
  }
  while(h != first);
}

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
  using parameters::get_parameter;
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  const bool is_null = bhd == Graph_traits::null_halfedge(); // what PMP::longest_border() returns for closed meshes
  CGAL_precondition(is_null || is_border(bhd, tm));

  std::array<typename Graph_traits::vertex_descriptor, 4> corners;
  corners.fill(Graph_traits::null_vertex());

  const Imported_mesh<TriangleMesh> mesh = import_mesh(tm, np);
  Flattening_report<TriangleMesh> report = internal::import_report(mesh);
  if(bool(report) && (is_null || !report.topology.is_disk()))
    report.status = Status::WRONG_TOPOLOGY;
  if(bool(report))
  {
    const Retriangulation retriangulation = parameters::choose_parameter(get_parameter(np, internal_np::conformal_retriangulation),
                                                                         Retriangulation::WHEN_NEEDED);
    const std::uint32_t first = mesh.triangulation.next_on_border(mesh.index_of_halfedge(opposite(bhd, tm)));
    const internal::Rectangle_corners found = internal::select_rectangle_corners(mesh.triangulation, first, retriangulation);
    report.status = found.status;
    report.amount = found.amount;
    internal::name_elements(mesh, found.vertices, {}, {}, report);
    if(is_success(found.status))
      for(int k = 0; k < 4; ++k)
        corners[k] = mesh.vertex(found.corners[3 - k]); // CGAL's border halfedges run the other way
  }
  if constexpr(!parameters::is_default_parameter<NamedParameters, internal_np::conformal_report_t>::value)
    get_parameter(np, internal_np::conformal_report).get() = report;
  return corners;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_BOUNDARY_CONDITIONS_H
