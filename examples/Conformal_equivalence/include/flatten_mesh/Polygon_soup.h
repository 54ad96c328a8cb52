// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_POLYGON_SOUP_H
#define FLATTEN_MESH_POLYGON_SOUP_H

#include "OBJ_attributes.h"

#include <boost/container/small_vector.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace flattening {

// The vertices of a face in their cyclic order. Nearly all faces have three or four, for which no memory is allocated.
typedef boost::container::small_vector<std::uint32_t, 4> Polygon;

// What a file holds: vertices and faces, counted from 0 in the order of the file.
struct Polygon_soup
{
  std::vector<std::array<double, 3> > points;
  std::vector<Polygon> faces;
  std::size_t number_of_edges = 0; // known after the check

  bool vertices_are_points = false;  // the file has no vertices: equal points have become one
  bool has_single_precision = false; // to which points were rounded before
  OBJ_attributes attributes;
  std::vector<std::string> notices;  // what of the file was skipped
};

// Throws a `Failure` if there is no face.
void require_faces(const Polygon_soup& soup, const std::string& file);


// Throws a `Failure` that says what is wrong unless all coordinates are finite.
void check_points(const Polygon_soup& soup, const std::string& file);

// Throws a `Failure` that says what is wrong, and whether --repair would mend it, unless the soup is an oriented manifold with finite
// coordinates, every face of which has at least three vertices, all of them different.
void check_soup(Polygon_soup& soup, const std::string& file);

} // namespace flattening

#endif // FLATTEN_MESH_POLYGON_SOUP_H
