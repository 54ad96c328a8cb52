// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_MESH_H
#define FLATTEN_MESH_MESH_H

#include "messages.h"
#include "read_soup.h"
#include "Triangle_soup.h"

#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Status.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstddef>
#include <string>

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

// Before anything is computed: the surface is a disk.
inline void require_disk(const Mesh& mesh, const std::string& file)
{
  const auto imported = CE::import_mesh(mesh);
  const CE::Surface_topology t = CE::surface_topology(imported.triangulation, CE::connected_components(imported.triangulation));
  if(t.number_of_components > 1)
    fail(file, ": the mesh has ", t.number_of_components, " components; only one topological disk can be flattened");
  if(t.number_of_borders == 0)
    fail(file, ": the mesh is closed (genus ", t.genus, "); only a topological disk can be flattened");
  if(! t.is_disk())
    fail(file, ": the mesh has ", t.number_of_borders, t.number_of_borders == 1 ? " border" : " borders", " and genus ", t.genus,
         "; only a topological disk (1 border, genus 0) can be flattened");
}

inline bool is_on_border(const Mesh& mesh, std::size_t v)
{
  return ! mesh.is_isolated(Vertex(static_cast<Mesh::size_type>(v)))
      && mesh.is_border(Vertex(static_cast<Mesh::size_type>(v)));
}

} // namespace flattening

#endif // FLATTEN_MESH_MESH_H
