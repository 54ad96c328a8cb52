// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The surface as the file has it. The program computes on a mesh of triangles, into which polygons are divided, and which --repair may
// have changed; what it says and writes is about the vertices and faces of the file.

#ifndef FLATTEN_MESH_GIVEN_SURFACE_H
#define FLATTEN_MESH_GIVEN_SURFACE_H

#include "mesh.h"
#include "options.h"
#include "Polygon_soup.h"
#include "repair_soup.h"
#include "results.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace flattening {

struct Given_surface
{
  // The vertices and faces of the file, where they are not just those of the mesh. Faces that --repair has turned are turned here, too.
  Polygon_soup soup;
  std::size_t number_of_vertices = 0, number_of_faces = 0; // of the file
  OBJ_attributes attributes;                               // of its faces
  std::vector<std::string> notices;                        // what of it was skipped
  std::optional<Repair_counts> repair;                     // with --repair

  // Where elements of the mesh come from; empty if its vertices and faces are those of the file, one by one. The vertices of the
  // mesh begin with those of the file.
  std::vector<std::uint32_t> face_of_triangle;   // by face of the mesh
  std::vector<std::uint32_t> original;           // by vertex of the mesh: the vertex of which it is a copy, or itself
  std::vector<std::uint32_t> representative;     // by vertex of the file: the one with the same point that stands for it

  bool is_mesh() const { return face_of_triangle.empty(); }
  std::size_t face(Face f) const { return is_mesh() ? f.idx() : face_of_triangle[f.idx()]; }
  std::size_t vertex(Vertex v) const { return original.empty() ? v.idx() : original[v.idx()]; }
  std::size_t representative_of(std::size_t i) const { return representative.empty() ? i : representative[i]; }

  // The vertex of the mesh that stands for vertex `i` of the file. Throws a `Failure` that begins with `where` if there is none, or if there
  // are several because --repair has taken the surface apart there.
  Vertex vertex_of_mesh(std::int64_t i, const std::string& where) const;
};

// Reads the file, repairs what it holds if that is asked for, and makes it a mesh of triangles. Throws a `Failure` if it is no manifold. `format` is
// as for `read_soup()`.
Given_surface read_surface(const std::string& file, bool repairs, Mesh& mesh, const std::string& format = "");

// The options, with vertices of the mesh for those of the file that they name.
Options with_vertices_of_mesh(Options options, const Given_surface& given);

// Names vertices and faces in the report as the file numbers them.
void name_as_given(const Given_surface& given, Report& report);

// The beginning of a message about a component of the mesh, told by its first face.
std::string name_of_component(const Given_surface& given, Face first_face, std::size_t number_of_triangles);

// Whether the edge divides a face of the file.
bool is_diagonal(const Given_surface& given, const Mesh& mesh, Mesh::Edge_index e);

// For each face of the file, and each of its corners, the corner of the mesh that has its place in the layout, as the halfedge to its vertex. What
// was dropped lies where it lies in the face that shares most of its points.
std::vector<std::vector<Halfedge> > corners_in_mesh(const Given_surface& given, const Mesh& mesh);

} // namespace flattening

#endif // FLATTEN_MESH_GIVEN_SURFACE_H
