// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_TRIANGULATE_H
#define FLATTEN_MESH_TRIANGULATE_H

#include "mesh.h"

#include <cstdint>
#include <vector>

namespace flattening {

// Divides faces with more than three sides into triangles. Returns for each triangle the face that it is part of.
std::vector<std::uint32_t> triangulate_faces(Mesh& mesh);

} // namespace flattening

#endif // FLATTEN_MESH_TRIANGULATE_H
