// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_PUNCTURED_SURFACE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_PUNCTURED_SURFACE_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The surface without the triangles at one vertex. Vertices keep their numbers; the apex becomes isolated.
template <typename NT>
struct Punctured_surface
{
  typedef std::uint32_t Index;

  Intrinsic_triangulation<NT> triangulation;
  std::vector<Index> original_edge; // by edge
  std::vector<Index> original_face; // by face

  Punctured_surface(const Intrinsic_triangulation<NT>& t, Index apex)
  {
    std::vector<Index> new_face(t.number_of_faces(), t.null_index);
    for(Index f = 0; f < t.number_of_faces(); ++f)
      if(t.origin(t.halfedge(f)) != apex && t.origin(t.halfedge(f, 1)) != apex && t.origin(t.halfedge(f, 2)) != apex)
      {
        new_face[f] = Index(original_face.size());
        original_face.push_back(f);
      }
    std::vector<Index> origin, twin;
    for(Index f : original_face)
      for(const Index h : t.halfedges(f))
      {
        const Index g = t.twin(h);
        origin.push_back(t.origin(h));
        const bool is_new = g != t.null_index && new_face[t.face(g)] != t.null_index;
        twin.push_back(is_new ? t.halfedge(new_face[t.face(g)], t.position_in_face(g)) : t.null_index);
      }
    triangulation = Intrinsic_triangulation<NT>(t.number_of_vertices(), std::move(origin), std::move(twin));
    original_edge.resize(triangulation.number_of_edges());
    for(Index e = 0; e < triangulation.number_of_edges(); ++e)
    {
      const Index h = triangulation.edge_halfedge(e);
      original_edge[e] = t.edge(t.halfedge(original_face[t.face(h)], t.position_in_face(h)));
      triangulation.set_length(e, t.length(original_edge[e]));
    }
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      has_all_others_ = has_all_others_ && (v == apex || t.is_isolated_vertex(v) || !triangulation.is_isolated_vertex(v));
  }

  // Is it one disk that has all vertices but the apex?
  bool is_disk() const
  {
    if(triangulation.number_of_faces() == 0 || !has_all_others_ || !non_manifold_vertices(triangulation).empty())
      return false;
    const Surface_components pieces = connected_components(triangulation);
    return pieces.components.size() == 1 && pieces.components[0].is_disk();
  }

private:
  bool has_all_others_ = true; // vertices
};

// The vertices that are to lie on one circle, the image of a line of symmetry or of a straight border: the apex, and others. From `first` to
// `last`, its neighbours there, the surface, or the half of it that counts, is on the left.
struct Symmetry_axis
{
  std::vector<char> contains; // by vertex; empty: there is no axis
  std::uint32_t first = 0, last = 0;

  bool empty() const { return contains.empty(); }
};

// The border of `t`, with an apex on it.
template <typename NT>
Symmetry_axis border_axis(const Intrinsic_triangulation<NT>& t, std::uint32_t apex)
{
  Symmetry_axis axis;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    axis.contains.push_back(t.is_border_vertex(v));
  std::uint32_t last = t.vertex_halfedge(apex);
  axis.first = t.target(last); // along the border
  t.for_each_outgoing(apex, [&](std::uint32_t h) { last = h; });
  axis.last = t.apex(last);
  return axis;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_PUNCTURED_SURFACE_H
