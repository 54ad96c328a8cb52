// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// How the vertices, faces, corners and seams of a refinement become those of a mesh: the steps of `make_refined_mesh()`. They fill vectors of
// descriptors, by the numbers of the elements in the refinement.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_REFINED_MESH_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_REFINED_MESH_H

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Refined_mesh_elements.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The vertices of a refinement, with their points on the input surface.
template <typename TriangleMesh, typename NT, typename PointMapIn, typename RefinedMesh, typename PointMapOut>
void add_refined_vertices(const Imported_mesh<TriangleMesh, NT>& mesh, const Common_refinement<NT>& refinement, PointMapIn point_in,
                          RefinedMesh& out, PointMapOut point_out, Refined_mesh_elements<RefinedMesh>& result)
{
  typedef std::uint32_t Index;
  typedef typename boost::property_traits<PointMapOut>::value_type Point_3;
  typedef std::decay_t<decltype(get(point_in, mesh.vertex(0)).x())> FT;
  const auto add = [&](const Point_3& p)
  {
    result.vertices.push_back(add_vertex(out));
    put(point_out, result.vertices.back(), p);
  };
  const Intrinsic_triangulation<NT>& t = mesh.triangulation;
  for(Index v = 0; v < refinement.number_of_input_vertices; ++v)
  {
    const auto& p = get(point_in, mesh.vertex(v));
    add(Point_3(p.x(), p.y(), p.z()));
  }
  for(const typename Common_refinement<NT>::Crossing& x : refinement.crossings)
  {
    const Index h = t.edge_halfedge(x.input_edge);
    const auto &p = get(point_in, mesh.vertex(t.origin(h))), &q = get(point_in, mesh.vertex(t.target(h)));
    const FT b(static_cast<double>(x.input_parameter)), a = 1 - b;
    add(Point_3(a * p.x() + b * q.x(), a * p.y() + b * q.y(), a * p.z() + b * q.z()));
  }
}

// Its faces, if the mesh can hold them.
template <typename NT, typename RefinedMesh>
bool add_refined_faces(const Common_refinement<NT>& refinement, RefinedMesh& out, Refined_mesh_elements<RefinedMesh>& result)
{
  typedef boost::graph_traits<RefinedMesh> Traits;
  std::vector<typename Traits::vertex_descriptor> corners;
  result.halfedges.resize(refinement.corner_vertex.size());
  for(std::uint32_t f = 0; f < refinement.number_of_faces(); ++f)
  {
    const std::size_t first = refinement.first_corner[f], last = refinement.first_corner[f + 1];
    corners.clear();
    for(std::size_t c = first; c < last; ++c)
      corners.push_back(result.vertices[refinement.corner_vertex[c]]);
    const typename Traits::face_descriptor fd = CGAL::Euler::add_face(corners, out);
    if(fd == Traits::null_face())
      return false;
    result.faces.push_back(fd);
    typename Traits::halfedge_descriptor h = halfedge(fd, out);
    while(target(h, out) != corners[0])
      h = next(h, out);
    for(std::size_t c = first; c < last; ++c, h = next(h, out))
      result.halfedges[c] = h;
  }
  return true;
}

template <typename NT, typename RefinedMesh, typename HalfedgeUVMap>
void write_refined_corners(const Common_refinement<NT>& refinement, const Refined_mesh_elements<RefinedMesh>& elements,
                           const RefinedMesh& out, HalfedgeUVMap uv)
{
  typedef typename boost::property_traits<HalfedgeUVMap>::value_type Point_2;
  const auto write = [&](typename boost::graph_traits<RefinedMesh>::halfedge_descriptor h, std::size_t c)
    { put(uv, h, Point_2(static_cast<double>(refinement.corner_uv[c][0]), static_cast<double>(refinement.corner_uv[c][1]))); };
  for(std::uint32_t f = 0; f < refinement.number_of_faces(); ++f)
  {
    const std::size_t first = refinement.first_corner[f], last = refinement.first_corner[f + 1];
    for(std::size_t c = first; c < last; ++c)
    {
      const auto h = elements.halfedges[c];
      write(h, c);
      if(CGAL::is_border(opposite(h, out), out))
        write(opposite(h, out), c == first ? last - 1 : c - 1);
    }
  }
}

template <typename NT, typename RefinedMesh, typename EdgeIsSeamMap>
void write_refined_seam(const Common_refinement<NT>& refinement, const Refined_mesh_elements<RefinedMesh>& elements,
                        RefinedMesh& out, EdgeIsSeamMap seam)
{
  typedef typename boost::graph_traits<RefinedMesh>::halfedge_descriptor halfedge_descriptor;
  const auto corner = get(CGAL::dynamic_halfedge_property_t<std::size_t>(), out);
  for(std::size_t c = 0; c < elements.halfedges.size(); ++c)
    put(corner, elements.halfedges[c], c);
  const auto point = [&](halfedge_descriptor h) { return refinement.corner_uv[get(corner, h)]; };
  for(halfedge_descriptor h : elements.halfedges)
  {
    const halfedge_descriptor g = opposite(h, out);
    const bool is_seam = !CGAL::is_border(g, out) && (point(h) != point(prev(g, out)) || point(g) != point(prev(h, out)));
    put(seam, edge(h, out), is_seam);
  }
}

// Writes corners, and weights and seam if there are maps for them.
template <typename NT, typename RefinedMesh, typename HalfedgeUVMap, typename NamedParameters>
void write_refined_maps(const Common_refinement<NT>& refinement, const Refined_mesh_elements<RefinedMesh>& elements, RefinedMesh& out,
                        HalfedgeUVMap uv, const NamedParameters& np)
{
  write_refined_corners(refinement, elements, out, uv);
  for(std::uint32_t v = 0; v < refinement.number_of_vertices(); ++v)
    put_if_given(np, internal_np::conformal_weight, elements.vertices[v], static_cast<double>(refinement.weights[v]));
  if constexpr(is_given<internal_np::conformal_edge_is_seam_t, NamedParameters>)
    write_refined_seam(refinement, elements, out, parameters::get_parameter(np, internal_np::conformal_edge_is_seam));
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_REFINED_MESH_H
