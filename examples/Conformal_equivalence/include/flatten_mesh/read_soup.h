// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Readers of OFF, OBJ, STL and PLY that name the line and the element at fault. They
// keep the vertices as they are, except that of STL, whose faces repeat
// their points: there equal points become one vertex.

#ifndef FLATTEN_MESH_READ_SOUP_H
#define FLATTEN_MESH_READ_SOUP_H

#include "Polygon_soup.h"

#include <string>

namespace flattening {

// Whether the machine's numbers begin with their most significant byte.
bool is_big_endian();

Polygon_soup read_soup(const std::string& file);

} // namespace flattening

#endif // FLATTEN_MESH_READ_SOUP_H
