// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// With --precision BITS everything is computed with numbers of so many bits. What is drawn and measured is rounded; the OBJ
// file is not.

#ifndef FLATTEN_MESH_PRECISION_H
#define FLATTEN_MESH_PRECISION_H

#include "mesh.h"

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/Refined_mesh_elements.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/multiprecision.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <array>
#include <cstddef>
#include <functional>
#include <utility>
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

inline std::array<double, 2> rounded(const CE::Multiprecision_number& x, const CE::Multiprecision_number& y)
{
  return {{ static_cast<double>(x), static_cast<double>(y) }};
}

// The refinement that is drawn.
inline CE::Common_refinement<double> rounded(const Wide_refinement& wide)
{
  CE::Common_refinement<double> result;
  result.number_of_input_vertices = wide.number_of_input_vertices;
  for(const Wide_refinement::Crossing& x : wide.crossings)
    result.crossings.push_back({x.input_edge, static_cast<double>(x.input_parameter), x.flat_edge, static_cast<double>(x.flat_parameter)});
  for(const CE::Multiprecision_number& w : wide.weights)
    result.weights.push_back(static_cast<double>(w));
  result.first_corner = wide.first_corner;
  result.input_face = wide.input_face;
  result.flat_face = wide.flat_face;
  result.corner_vertex = wide.corner_vertex;
  for(const std::array<CE::Multiprecision_number, 2>& z : wide.corner_uv)
    result.corner_uv.push_back(rounded(z[0], z[1]));
  result.corner_halfedge = wide.corner_halfedge;
  result.angle_sums = wide.angle_sums;
  result.status = wide.status;
  result.amount = wide.amount;
  return result;
}

inline void use_wide_points(Mesh& mesh, Wide_layout& wide)
{
  wide.is_used = true;
  wide.uv = mesh.add_property_map<Halfedge, Wide_point>("h:wide_uv").first;
}

// What is drawn of a layout.
inline void round_layout(const Mesh& mesh, const Wide_layout& wide, UV_map uv, CE::Common_refinement<double>& refinement)
{
  for(Halfedge h : mesh.halfedges())
  {
    const std::array<double, 2> p = rounded(wide.uv[h].x(), wide.uv[h].y());
    uv[h] = Kernel::Point_2(p[0], p[1]);
  }
  refinement = rounded(wide.refinement);
}

// As `CE::flatten()` with the same parameters.
template <typename NamedParameters>
CE::Flattening_report<Mesh> flatten_precisely(Mesh& mesh, UV_map uv, CE::Common_refinement<double>& refinement, Wide_layout& wide,
                                              const NamedParameters& np)
{
  use_wide_points(mesh, wide);
  const auto report = CE::flatten<CE::Multiprecision_number>(mesh, wide.uv, np.common_refinement(std::ref(wide.refinement)));
  if(report)
    round_layout(mesh, wide, uv, refinement);
  return report;
}

// The points of a mesh made of `parts`, before rounding.
inline void set_wide_points(const Wide_refinement& parts, const CE::Refined_mesh_elements<Mesh>& elements, Mesh& mesh, Wide_layout& wide)
{
  use_wide_points(mesh, wide);
  for(std::size_t c = 0; c < elements.halfedges.size(); ++c)
    wide.uv[elements.halfedges[c]] = Wide_point(parts.corner_uv[c][0], parts.corner_uv[c][1]);
}

} // namespace flattening

#endif // FLATTEN_MESH_PRECISION_H
