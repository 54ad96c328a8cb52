// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_MESH_H
#define FLATTEN_MESH_MESH_H

#include "messages.h"
#include "read_soup.h"
#include "Triangle_soup.h"

#include <CGAL/Conformal_equivalence/Status.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace flattening {

namespace CE = CGAL::Conformal_equivalence;

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3>                 Mesh;
typedef Mesh::Vertex_index                                  Vertex;
typedef Mesh::Halfedge_index                                Halfedge;
typedef Mesh::Face_index                                    Face;
template <typename T> using Vertex_map = Mesh::Property_map<Vertex, T>;
template <typename T> using Face_map = Mesh::Property_map<Face, T>;
typedef Mesh::Property_map<Halfedge, Kernel::Point_2>       UV_map;

// Vertices and faces keep their order and number; so do vertices without a face.
inline void build_mesh(const Triangle_soup& soup, const std::string& file, Mesh& mesh)
{
  mesh.reserve(static_cast<Mesh::size_type>(soup.points.size()),
               static_cast<Mesh::size_type>(soup.number_of_edges),
               static_cast<Mesh::size_type>(soup.triangles.size()));
  for(const auto& p : soup.points)
    mesh.add_vertex(Kernel::Point_3(p[0], p[1], p[2]));
  for(std::size_t f = 0; f < soup.triangles.size(); ++f)
  {
    const auto& t = soup.triangles[f];
    if(mesh.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])) == Mesh::null_face())
      fail(file, ": not a manifold at face ", f);
  }
}

inline void read_mesh(const std::string& file, Mesh& mesh)
{
  Triangle_soup soup = read_soup(file);
  check_soup(soup, file);
  build_mesh(soup, file, mesh);
}

inline bool is_on_border(const Mesh& mesh, Vertex v)
{
  return ! mesh.is_isolated(v) && mesh.is_border(v);
}

// The halfedges of the border that `h` belongs to, in their order.
inline std::vector<Halfedge> border_cycle(const Mesh& mesh, Halfedge h)
{
  std::vector<Halfedge> cycle;
  const Halfedge first = h;
  do
  {
    cycle.push_back(h);
    h = mesh.next(h);
  }
  while(h != first);
  return cycle;
}

// Some halfedge on the border; the null halfedge if the surface is closed.
inline Halfedge first_border_halfedge(const Mesh& mesh)
{
  for(Halfedge h : mesh.halfedges())
    if(mesh.is_border(h))
      return h;
  return Mesh::null_halfedge();
}

// The border halfedge to a border vertex.
inline Halfedge border_halfedge_to(const Mesh& mesh, Vertex v)
{
  for(Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v)))
    if(mesh.is_border(h))
      return h;
  return Mesh::null_halfedge();
}

} // namespace flattening

#endif // FLATTEN_MESH_MESH_H
