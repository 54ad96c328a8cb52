// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The verdict on the faces of a common refinement, its *cells*, by whatever predicates decide in the plane or elsewhere. A
// cell is positive if it is counterclockwise and strictly convex. It is called *flipped* if it is not positive for the coordinates as they were
// computed, and *rounded* if it is, but no longer for the coordinates rounded to the number type of the result.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_CELL_VERDICT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_CELL_VERDICT_H

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

struct Cell_verdict
{
  std::vector<std::uint32_t> flipped, rounded; // in the order in which they are judged

  // Judges a cell by two predicates without arguments. The second one, which tends to be dear, is evaluated only if the first one fails. Where
  // rounding might make a flipped cell positive, the first predicate has to ask for both.
  template <typename As_rounded, typename As_computed>
  void judge(std::uint32_t cell, As_rounded is_positive_as_rounded, As_computed is_positive_as_computed)
  {
    if(!is_positive_as_rounded())
      (is_positive_as_computed() ? rounded : flipped).push_back(cell);
  }
};

template <typename NT>
void put_verdict(Cell_verdict verdict, Common_refinement<NT>& refinement)
{
  refinement.flipped_faces = std::move(verdict.flipped);
  refinement.rounded_faces = std::move(verdict.rounded);
}

// The faces of the input that cells are parts of, each once, in increasing order.
template <typename NT>
std::vector<std::uint32_t> input_faces(const Common_refinement<NT>& refinement, const std::vector<std::uint32_t>& cells)
{
  std::vector<std::uint32_t> result;
  for(std::uint32_t f : cells)
    result.push_back(refinement.input_face[f]);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

// The faces of the input with a part that is not positive once it is rounded.
template <typename NT>
std::vector<std::uint32_t> input_faces_lost(const Common_refinement<NT>& refinement)
{
  std::vector<std::uint32_t> cells = refinement.flipped_faces;
  cells.insert(cells.end(), refinement.rounded_faces.begin(), refinement.rounded_faces.end());
  return input_faces(refinement, cells);
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template std::vector<std::uint32_t> input_faces_lost(const Common_refinement<double>&);
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_CELL_VERDICT_H
