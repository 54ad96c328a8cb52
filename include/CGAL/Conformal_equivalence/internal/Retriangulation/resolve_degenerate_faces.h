// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Faces of no area, as collinear points make them, are resolved before anything else: a flip of the longest edge leaves the surface as it is,
// and no conformal class changes, as a triangulation with such a face has no metric whose class it would be.
//
//           k                       k
//         /   \                   / | \                   .
//       j-------l     --->      j---m---l         The face jml has no area, as m lies on jl.
//         \-m-/

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_RESOLVE_DEGENERATE_FACES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_RESOLVE_DEGENERATE_FACES_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/tell_flips.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/delaunay_predicate.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/length_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The longest side of the face f.
template <typename NT>
std::uint32_t longest_halfedge(const Intrinsic_triangulation<NT>& t, std::uint32_t f)
{
  const std::uint32_t h = t.halfedge(f);
  return h + std::uint32_t(longest_side(t.halfedge_length(h), t.halfedge_length(h + 1), t.halfedge_length(h + 2)));
}

// Is it a triangle without area, as far as rounded lengths can tell?
template <typename NT>
bool is_degenerate_face(const Intrinsic_triangulation<NT>& t, std::uint32_t f)
{
  const std::uint32_t h = longest_halfedge(t, f);
  return is_degenerate_up_to_rounding(t.halfedge_length(t.next(h)), t.halfedge_length(t.previous(h)), t.halfedge_length(h));
}

template <typename NT>
std::vector<std::uint32_t> degenerate_faces(const Intrinsic_triangulation<NT>& t)
{
  std::vector<std::uint32_t> result;
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
    if(is_degenerate_face(t, f))
      result.push_back(f);
  return result;
}

// The distance of k from the point m of the side jl, which divides it as the lengths jm and ml say (M. Stewart, 1746). That of two triangles laid
// side by side would make a height of some 1e-8 of what rounding leaves of a flat one.
template <typename NT>
NT distance_from_point_of_side(const NT& jm, const NT& ml, const NT& jk, const NT& lk, const NT& jl)
{
  using std::sqrt;
  typedef typename Wider_number<NT>::type Wide;
  const Wide unit = Wide(jl), t = Wide(jm) / (Wide(jm) + Wide(ml)), s = Wide(1) - t, x = Wide(jk) / unit, y = Wide(lk) / unit;
  const Wide square = s * x * x + t * y * y - s * t;
  return square > Wide(0) ? static_cast<NT>(Wide(unit * Wide(sqrt(square)))) : NT(0);
}

// Flips the longest edges of faces of no area until there are no such faces, but for those whose longest edge cannot be flipped, as on the border.
// Returns the flips in order. Linear time if there are few.
template <typename NT>
CGAL_CONFORMAL_EQUIVALENCE_COLD
std::vector<std::uint32_t> resolve_degenerate_faces(Intrinsic_triangulation<NT>& t)
{
  std::vector<std::uint32_t> flips, suspects = degenerate_faces(t);
  // Each flip makes way for a shorter edge, or hands the face on to a neighbour: where many lie on one line, they could be handed to and fro.
  const std::size_t most_flips = 10 * suspects.size() + std::size_t(t.number_of_faces());
  while(!suspects.empty() && flips.size() < most_flips)
  {
    const std::uint32_t f = suspects.back();
    suspects.pop_back();
    const std::uint32_t h = longest_halfedge(t, f), g = t.twin(h);
    if(!is_degenerate_face(t, f) || !t.is_flippable(t.edge(h)))
      continue;
    const NT length = distance_from_point_of_side(t.halfedge_length(t.previous(h)), t.halfedge_length(t.next(h)), t.halfedge_length(t.next(g)),
                                                  t.halfedge_length(t.previous(g)), t.halfedge_length(h));
    if(!is_positive_number(length))
      continue; // points that are equal
    flips.push_back(t.edge(h));
    t.flip_edge(t.edge(h), length);
    suspects.push_back(f);
    suspects.push_back(g / 3);
  }
  return flips;
}

// Tells a result, found on the triangulation that these flips have led to, that they came before all others.
template <typename Result>
CGAL_CONFORMAL_EQUIVALENCE_COLD
void put_resolving_flips_first(const std::vector<std::uint32_t>& flips, Result& result)
{
  result.flips.insert(result.flips.begin(), flips.begin(), flips.end());
  result.statistics.number_of_resolving_flips = flips.size();
  tell_flips(Retriangulation::WHEN_NEEDED, result); // only then are faces resolved
}

// Takes those out of `faces` that have no area, and returns them.
template <typename NT>
std::vector<std::uint32_t> take_degenerate_faces(const Intrinsic_triangulation<NT>& t, std::vector<std::uint32_t>& faces)
{
  const auto middle = std::stable_partition(faces.begin(), faces.end(), [&](std::uint32_t f) { return !is_degenerate_face(t, f); });
  const std::vector<std::uint32_t> result(middle, faces.end());
  faces.erase(middle, faces.end());
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_RESOLVE_DEGENERATE_FACES_H
