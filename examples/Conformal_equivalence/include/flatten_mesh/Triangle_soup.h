// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_TRIANGLE_SOUP_H
#define FLATTEN_MESH_TRIANGLE_SOUP_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace flattening {

// What a file holds: vertices and triangles, counted from 0 in the order of the file.
struct Triangle_soup
{
  std::vector<std::array<double, 3> > points;
  std::vector<std::array<std::uint32_t, 3> > triangles;
  std::size_t number_of_edges = 0; // known after the check
};

// Throws a `Failure` that says what is wrong unless all coordinates are finite.
void check_points(const Triangle_soup& soup, const std::string& file);

// Throws a `Failure` that says what is wrong unless the soup is an oriented
// manifold with finite coordinates.
void check_soup(Triangle_soup& soup, const std::string& file);

} // namespace flattening

#endif // FLATTEN_MESH_TRIANGLE_SOUP_H
