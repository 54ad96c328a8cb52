// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_MESH_H
#define FLATTEN_MESH_MESH_H

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <string>
#include <vector>

// The package, which the functions of the program call by this name.
namespace CGAL { namespace Conformal_equivalence {} }

namespace flattening {

namespace CE = CGAL::Conformal_equivalence;

typedef CGAL::Simple_cartesian<double>                      Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3>                 Mesh;
typedef Mesh::Vertex_index                                  Vertex;
typedef Mesh::Halfedge_index                                Halfedge;
typedef Mesh::Face_index                                    Face;
template <typename T> using Vertex_map = Mesh::Property_map<Vertex, T>;
template <typename T> using Face_map = Mesh::Property_map<Face, T>;
typedef Mesh::Property_map<Halfedge, Kernel::Point_2>       UV_map;

struct Polygon_soup;

// Vertices and faces keep their order and number; so do vertices without a face. The soup is an oriented manifold.
void build_mesh(const Polygon_soup& soup, Mesh& mesh);

bool is_on_border(const Mesh& mesh, Vertex v);

// The halfedges of the border that `h` belongs to, in their order.
std::vector<Halfedge> border_cycle(const Mesh& mesh, Halfedge h);

// Some halfedge on the border; the null halfedge if the surface is closed.
Halfedge first_border_halfedge(const Mesh& mesh);

// The border halfedge to a border vertex.
Halfedge border_halfedge_to(const Mesh& mesh, Vertex v);

std::array<Vertex, 3> vertices_of_face(const Mesh& mesh, Face f);

} // namespace flattening

#endif // FLATTEN_MESH_MESH_H
