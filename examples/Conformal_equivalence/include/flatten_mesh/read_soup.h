// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Readers of OFF, OBJ, STL and PLY that name the line and the element at fault. They
// keep the vertices as they are, except that of STL, whose triangles repeat
// their points: there equal points become one vertex. What a file says beyond its vertices and faces
// is passed over; what might be meant as a vertex or a face, and is not understood, is an error or a notice.

#ifndef FLATTEN_MESH_READ_SOUP_H
#define FLATTEN_MESH_READ_SOUP_H

#include "Polygon_soup.h"

#include <string>

namespace flattening {

// Whether the machine's numbers begin with their most significant byte.
bool is_big_endian();

// Reads the file in the format `off`, `obj`, `ply` or `stl`, or, if that is empty, in the one that its extension names; the standard input, "-",
// in that of its content. Throws a `Failure` that says what is wrong.
Polygon_soup read_soup(const std::string& file, const std::string& format = "");

} // namespace flattening

#endif // FLATTEN_MESH_READ_SOUP_H
