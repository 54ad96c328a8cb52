// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Seamless layouts: their tiles, the paths along which they are cut, and a texture of tiles.

#ifndef FLATTEN_MESH_SEAMLESS_H
#define FLATTEN_MESH_SEAMLESS_H

#include "mesh.h"
#include "results.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace flattening {

// The tiles are hexagons, about the points a + b e^{i pi / 3}; otherwise squares, about those a + b i.
inline bool has_hexagons(int symmetry) { return symmetry == 3 || symmetry == 6; }
inline bool has_squares(int symmetry)  { return symmetry == 2 || symmetry == 4; }

// A path of the seam, from one of its special vertices to another; the motion that takes its left side to the right one is a rotation by a
// number of quanta and then the translation by a point of the lattice.
struct Seam_path
{
  Vertex from, to;
  std::size_t number_of_edges = 0; // of the mesh given
  int quanta = 0;
  std::array<std::int64_t, 2> translation = {{0, 0}};
};

// A map for the coordinates (a, b) of the lattice, which are written then.
UV_map add_lattice_coordinates(Mesh& mesh);

// Cartesian coordinates, which are drawn, for those of the lattice.
void draw_lattice_coordinates(int symmetry, Result& result);

// The layout was found in coordinates of the lattice: these are written, Cartesian ones are drawn.
void keep_lattice_coordinates(int symmetry, Result& result);

// Of the layout that is drawn, with the vertices and edges of the mesh given, of which it may be a refinement.
std::vector<Seam_path> seam_paths(const Mesh& given, const Result& drawn, const Report& report);

} // namespace flattening

#endif // FLATTEN_MESH_SEAMLESS_H
