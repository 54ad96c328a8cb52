// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// With --repair: a soup of polygons is made an oriented manifold. No vertex is moved.

#ifndef FLATTEN_MESH_REPAIR_SOUP_H
#define FLATTEN_MESH_REPAIR_SOUP_H

#include "Polygon_soup.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace flattening {

// What was done, by kind.
struct Repair_counts
{
  std::size_t merged_vertices = 0;    // equal to another one, which stands for them from then on
  std::size_t stitched_edges = 0;     // of two faces that did not share both of their vertices before
  std::size_t degenerate_faces = 0;   // without three different points: dropped
  std::size_t duplicate_faces = 0;    // with the same points as another one: dropped
  std::size_t turned_faces = 0;       // whose orientation was reversed
  std::size_t non_manifold_edges = 0; // of more than two faces: taken apart
  std::size_t copied_vertices = 0;    // copies made of vertices at which faces formed more than one fan
};

// A soup repaired. Its points begin with those of the soup given, some of which may belong to no face any more, and end with copies.
struct Repaired_soup
{
  Polygon_soup soup;
  std::vector<std::uint32_t> given_face;     // by face: the one that it was
  std::vector<bool> is_turned;               // by face: whether its orientation was reversed
  std::vector<std::uint32_t> given_vertex;   // by vertex: the one that it was or is a copy of
  std::vector<std::uint32_t> representative; // by vertex given: the one that stands for it
  Repair_counts counts;
};

// Merges equal points, drops degenerate and duplicate faces, orients, and takes apart what is no manifold. Throws a `Failure` if the surface
// cannot be oriented.
Repaired_soup repair_soup(const Polygon_soup& soup, const std::string& file);

// A place where a surface cannot be oriented: two faces that pass this edge in the same direction, however faces are turned.
struct Orientation_conflict
{
  std::array<std::uint32_t, 2> faces, edge;
};

// There is none where a surface can be oriented. Every face has at least three vertices, all of them different.
std::optional<Orientation_conflict> find_orientation_conflict(const Polygon_soup& soup);

std::string text_of(const Orientation_conflict& conflict);

} // namespace flattening

#endif // FLATTEN_MESH_REPAIR_SOUP_H
