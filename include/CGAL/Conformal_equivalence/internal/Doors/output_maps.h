// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What was found is written to the property maps, and the objects, that the named parameters give for it.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_OUTPUT_MAPS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_OUTPUT_MAPS_H

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/internal/Doors/Flattening.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/projective_interpolation.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/use.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Writes a number in the type that the map holds.
template <typename Map, typename Key, typename NT>
void put_number(Map map, const Key& key, const NT& x)
{
  put(map, key, static_cast<typename boost::property_traits<Map>::value_type>(x));
}

// Writes u and the weights e^{-u}, if there are maps for them, at all vertices that are not isolated. `vertex(v)` is the vertex number v of
// the mesh.
template <typename NT, typename Vertex, typename NamedParameters>
void write_scale_factors(const Intrinsic_triangulation<NT>& t, const std::vector<NT>& u, Vertex vertex, const NamedParameters& np)
{
  using parameters::get_parameter;
  CGAL_USE(vertex);
  CGAL_USE(np);
  double least = (std::numeric_limits<double>::max)();
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v))
      least = (std::min)(least, static_cast<double>(u[v]));
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
  {
    if(t.is_isolated_vertex(v))
      continue;
    if constexpr(is_given<internal_np::conformal_u_t, NamedParameters>)
      put_number(get_parameter(np, internal_np::conformal_u), vertex(v), u[v]);
    if constexpr(is_given<internal_np::conformal_weight_t, NamedParameters>)
      put(get_parameter(np, internal_np::conformal_weight), vertex(v), projective_weight(static_cast<double>(u[v]), least));
  }
}

// Writes u, weights and scaled lengths.
template <typename TriangleMesh, typename NT, typename NamedParameters>
void write_metric(const Flattening<TriangleMesh, NT>& flattening, const NamedParameters& np)
{
  const Imported_mesh<TriangleMesh, NT>& mesh = flattening.mesh;
  const Intrinsic_triangulation<NT>& t = mesh.triangulation;
  write_scale_factors(t, flattening.metric.log_scale_factors, [&](std::uint32_t v) { return mesh.vertex(v); }, np);
  if constexpr(is_given<internal_np::conformal_scaled_length_t, NamedParameters>)
  {
    const std::vector<NT>& straight = flattening.layout.straight_lengths;
    for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
      put_number(parameters::get_parameter(np, internal_np::conformal_scaled_length), mesh.edge(e),
                 straight.empty() ? flattening.metric.scaled_length(t.edge_halfedge(e)) : straight[e]);
  }
}

// Writes the corners to all halfedges of imported faces; a halfedge without a face
// gets the corner of the face across. That comes first: on a Seam_mesh both may have the same key.
template <typename TriangleMesh, typename NT, typename HalfedgeUVMap>
void write_corners(const Imported_mesh<TriangleMesh, NT>& mesh, const Layout<NT>& layout, HalfedgeUVMap uv)
{
  typedef typename boost::property_traits<HalfedgeUVMap>::value_type Point_2;
  const Intrinsic_triangulation<NT>& t = mesh.triangulation;
  const auto point = [&](std::uint32_t h) { return Point_2(layout.corner[h][0], layout.corner[h][1]); };
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); ++h)
  {
    if(!t.is_border(h))
      continue;
    const auto across = opposite(mesh.halfedge(h), mesh.mesh());
    if(CGAL::is_border(across, mesh.mesh())) // and not between charts
      put(uv, across, point(t.previous(h)));
  }
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
  {
    auto hd = mesh.halfedge(t.halfedge(f));
    for(const std::uint32_t h : t.halfedges(f))
    {
      put(uv, hd, point(h));
      hd = next(hd, mesh.mesh());
    }
  }
}

// Writes the seam: the edges that were cut, and those between charts.
template <typename TriangleMesh, typename NT, typename NamedParameters>
void write_seam(const Flattening<TriangleMesh, NT>& flattening, const NamedParameters& np)
{
  CGAL_USE(flattening);
  CGAL_USE(np);
  if constexpr(is_given<internal_np::conformal_edge_is_seam_t, NamedParameters>)
  {
    const Imported_mesh<TriangleMesh, NT>& mesh = flattening.mesh;
    for(std::uint32_t e = 0; e < mesh.triangulation.number_of_edges(); ++e)
    {
      const auto ed = mesh.edge(e);
      const bool is_seam = mesh.triangulation.is_border_edge(e) ? !CGAL::is_border(ed, mesh.mesh()) : flattening.cut[e];
      put(parameters::get_parameter(np, internal_np::conformal_edge_is_seam), ed, is_seam);
    }
  }
}

template <typename TriangleMesh, typename NamedParameters>
void write_report(const Flattening_report<TriangleMesh>& report, const NamedParameters& np)
{
  write_if_given(np, internal_np::conformal_report, report);
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_OUTPUT_MAPS_H
