// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_CONDITIONS_H
#define FLATTEN_MESH_CONDITIONS_H

#include "mesh.h"
#include "options.h"

namespace flattening {

// What is prescribed at each vertex: its angle sum, or u if it is constrained.
struct Conditions
{
  Vertex_map<double> border_angle, cone_angle, u;
  Vertex_map<bool> is_constrained;

  // u = 0 on all borders: they keep their lengths; no cones
  explicit Conditions(Mesh& mesh);
};

void set_conditions(const Options& options, const Mesh& mesh, Conditions& conditions);

} // namespace flattening

#endif // FLATTEN_MESH_CONDITIONS_H
