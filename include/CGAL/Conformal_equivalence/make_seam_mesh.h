// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file make_seam_mesh.h
/// From marked edges to a `Seam_mesh`, the mesh of \cgal that is cut open there
/// (section 3.3 of Springborn, Schroeder and Pinkall, 2008: vertices on the cut have
/// several positions in the layout).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_MAKE_SEAM_MESH_H
#define CGAL_CONFORMAL_EQUIVALENCE_MAKE_SEAM_MESH_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Surface_mesh.h> // before Seam_mesh.h, which calls its functions by qualified names
#include <CGAL/boost/graph/Seam_mesh.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// returns `tm` cut open along the edges that are `true` in `edge_is_seam_map`.
///
/// `Seam_mesh` itself counts only the seams that are added to it one by one, and walks around a vertex
/// for ever that is marked without a seam edge. This function makes marks and counts consistent, in every
/// supported version of \cgal: on return `edge_is_seam_map` is `true` exactly at the edges that were marked and
/// are not on the border, and `vertex_is_on_seam_map` exactly at their ends, whatever it was before.
/// Linear time.
///
/// The seam mesh refers to `tm`, which must not change meanwhile, and holds copies of both maps.
/// \cgal's `is_valid_polygon_mesh()` refuses a seam mesh where a single seam edge is a border by itself
/// (inside the surface, and not continued by another one).
///
/// \tparam TriangleMesh a model of `FaceListGraph` and `HalfedgeListGraph`. If it is not `Surface_mesh`,
///         the header of the mesh is to be included before this one.
/// \tparam EdgeIsSeamMap a model of `ReadWritePropertyMap` with key type
///         `boost::graph_traits<TriangleMesh>::%edge_descriptor` and value type `bool`; copies must share their
///         values
/// \tparam VertexIsOnSeamMap a model of `ReadWritePropertyMap` with key type
///         `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `bool`; copies must share their
///         values
///
/// \param tm the mesh
/// \param edge_is_seam_map where to cut; marks on border edges are removed
/// \param vertex_is_on_seam_map receives the ends of the seam edges
///
/// \return the seam mesh
/// \sa `CGAL::Conformal_equivalence::compute_cut_graph()`
template <typename TriangleMesh, typename EdgeIsSeamMap, typename VertexIsOnSeamMap>
Seam_mesh<TriangleMesh, EdgeIsSeamMap, VertexIsOnSeamMap>
make_seam_mesh(const TriangleMesh& tm, EdgeIsSeamMap edge_is_seam_map, VertexIsOnSeamMap vertex_is_on_seam_map)
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  std::vector<typename Graph_traits::edge_descriptor> seam;
  for(typename Graph_traits::edge_descriptor e : CGAL::make_range(edges(tm)))
  {
    if(get(edge_is_seam_map, e) && !CGAL::is_border(e, tm))
      seam.push_back(e);
    put(edge_is_seam_map, e, false);
  }
  for(typename Graph_traits::vertex_descriptor v : CGAL::make_range(vertices(tm)))
    put(vertex_is_on_seam_map, v, false);

  // Constructed while nothing is marked, so that no version has counted anything yet. Seams are
  // marked by edge: Seam_mesh::add_seam() takes two vertices, which may be joined by several edges.
  Seam_mesh<TriangleMesh, EdgeIsSeamMap, VertexIsOnSeamMap> result(tm, edge_is_seam_map, vertex_is_on_seam_map);
  for(typename Graph_traits::edge_descriptor e : seam)
  {
    put(edge_is_seam_map, e, true);
    put(vertex_is_on_seam_map, source(e, tm), true);
    put(vertex_is_on_seam_map, target(e, tm), true);
  }
  result.set_seam_edges_number(static_cast<typename Graph_traits::edges_size_type>(seam.size()));
  return result;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_MAKE_SEAM_MESH_H
