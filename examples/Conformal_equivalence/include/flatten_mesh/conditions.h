// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_CONDITIONS_H
#define FLATTEN_MESH_CONDITIONS_H

#include "Given_surface.h"
#include "mesh.h"
#include "options.h"
#include "Progress.h"

#include <vector>

namespace flattening {

// A closed curve along edges, in order, and by how many times the quantum of angles it turns.
struct Prescribed_loop
{
  std::vector<Halfedge> halfedges;
  int quanta;
};

// What is prescribed at each vertex: its angle sum, or u if it is constrained.
struct Conditions
{
  Vertex_map<double> border_angle, cone_angle, u;
  Vertex_map<bool> is_constrained;
  Mesh::Property_map<Mesh::Edge_index, bool> is_diagonal; // of a face with more than three sides: no cut passes there

  std::vector<Prescribed_loop> loops;

  // u = 0 on all borders: they keep their lengths; no cones, and no diagonals
  explicit Conditions(Mesh& mesh);
  Conditions(const Given_surface& given, Mesh& mesh);
};

void set_conditions(const Options& options, const Mesh& mesh, const Given_surface& given, Progress& progress, Conditions& conditions);

} // namespace flattening

#endif // FLATTEN_MESH_CONDITIONS_H
