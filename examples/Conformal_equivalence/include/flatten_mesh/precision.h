// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// With --precision BITS everything is computed with numbers of so many bits. What is drawn and measured is rounded; the OBJ
// file is not.

#ifndef FLATTEN_MESH_PRECISION_H
#define FLATTEN_MESH_PRECISION_H

#include "mesh.h"

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/multiprecision.h>

#include <array>
#include <cstddef>
#include <vector>

namespace flattening {

const unsigned int bits_of_double = 53;

// A point of the plane with many digits.
class Wide_point
{
public:
  Wide_point() = default;
  Wide_point(const CE::Multiprecision_number& x, const CE::Multiprecision_number& y) : x_(x), y_(y) {}
  const CE::Multiprecision_number& x() const { return x_; }
  const CE::Multiprecision_number& y() const { return y_; }

private:
  CE::Multiprecision_number x_, y_;
};

typedef Mesh::Property_map<Halfedge, Wide_point>          Wide_UV_map;
typedef CE::Common_refinement<CE::Multiprecision_number>  Wide_refinement;

// A layout before rounding.
struct Wide_layout
{
  bool is_used = false;
  Wide_UV_map uv;
  Wide_refinement refinement;
};

std::array<double, 2> rounded(const CE::Multiprecision_number& x, const CE::Multiprecision_number& y);

// The refinement that is drawn.
CE::Common_refinement<double> rounded(const Wide_refinement& wide);

void use_wide_points(Mesh& mesh, Wide_layout& wide);

// What is drawn of a layout.
void round_layout(const Mesh& mesh, const Wide_layout& wide, UV_map uv, CE::Common_refinement<double>& refinement);

// ---- Points of the sphere, and of the disk in the plane z = 0

typedef std::array<double, 3>                     Space_point;
typedef std::array<CE::Multiprecision_number, 3>  Wide_space_point;

Space_point rounded(const Wide_space_point& p);
std::vector<Space_point> rounded(const std::vector<Wide_space_point>& points);

template <typename NT>
std::array<NT, 3> origin() { return {{ NT(0), NT(0), NT(0) }}; }

} // namespace flattening

#endif // FLATTEN_MESH_PRECISION_H
