// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The faces of a refinement cut into triangles, all from one of their corners.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_FAN_TRIANGULATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_FAN_TRIANGULATION_H

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Cell_verdict.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The corner of the face, counted from its first one, from which triangles to all other sides are thickest in the layout.
template <typename NT>
std::size_t best_fan_centre(const Common_refinement<NT>& refinement, std::uint32_t f)
{
  const std::size_t first = refinement.first_corner[f], n = refinement.first_corner[f + 1] - first;
  const auto doubled_area = [&](std::size_t i, std::size_t j, std::size_t k)
  {
    const std::array<NT, 2> &p = refinement.corner_uv[first + i % n], &q = refinement.corner_uv[first + j % n],
                            &r = refinement.corner_uv[first + k % n];
    return NT((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
  };
  std::size_t best = 0;
  NT largest(0);
  for(std::size_t a = 0; a < n; ++a)
  {
    NT least = doubled_area(a, a + 1, a + 2);
    for(std::size_t i = 2; i + 1 < n; ++i)
      least = (std::min)(least, doubled_area(a, a + i, a + i + 1));
    if(a == 0 || largest < least)
    {
      largest = least;
      best = a;
    }
  }
  return best;
}

// Appends the triangles of the face `f` of a refinement to another refinement, and to the verdict on it.
template <typename NT>
void append_fan(const Common_refinement<NT>& refinement, std::uint32_t f, Common_refinement<NT>& result, Cell_verdict& verdict)
{
  const std::size_t first = refinement.first_corner[f], n = refinement.first_corner[f + 1] - first, centre = best_fan_centre(refinement, f);
  const bool is_flipped = std::binary_search(refinement.flipped_faces.begin(), refinement.flipped_faces.end(), f);
  for(std::size_t i = 1; i + 1 < n; ++i)
  {
    const std::array<std::size_t, 3> corner = {{first + centre, first + (centre + i) % n, first + (centre + i + 1) % n}};
    const std::array<bool, 3> is_side = {{i == 1, true, i + 2 == n}};
    for(std::size_t k = 0; k < 3; ++k)
    {
      result.corner_vertex.push_back(refinement.corner_vertex[corner[k]]);
      result.corner_uv.push_back(refinement.corner_uv[corner[k]]);
      result.corner_halfedge.push_back(is_side[k] ? refinement.corner_halfedge[corner[k]] : result.null_index);
    }
    const auto uv = [&](std::size_t k) -> const std::array<NT, 2>& { return refinement.corner_uv[corner[k]]; };
    verdict.judge(result.number_of_faces(), [&] { return is_left_turn(uv(0), uv(1), uv(2)); }, [&] { return !is_flipped; });
    result.input_face.push_back(refinement.input_face[f]);
    result.flat_face.push_back(refinement.flat_face[f]);
    result.first_corner.push_back(result.corner_vertex.size());
  }
}

// The refinement without its faces, corners and verdict.
template <typename NT>
Common_refinement<NT> without_faces(const Common_refinement<NT>& refinement)
{
  Common_refinement<NT> result;
  result.number_of_input_vertices = refinement.number_of_input_vertices;
  result.crossings = refinement.crossings;
  result.weights = refinement.weights;
  result.angle_sums = refinement.angle_sums;
  result.set_outcome(refinement);
  result.first_corner.push_back(0);
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_FAN_TRIANGULATION_H
