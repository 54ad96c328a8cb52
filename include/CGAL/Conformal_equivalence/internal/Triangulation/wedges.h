// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGULATION_WEDGES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGULATION_WEDGES_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The wedges of the triangulation: maximal fans of corners around a vertex that no
// cut and no border divides. A wedge becomes one point.
struct Wedges
{
  std::vector<std::uint32_t> of_corner;   // by halfedge h: the wedge of its target in its face
  std::uint32_t number_of_wedges = 0;
};

// For surfaces of which no edge is cut.
struct Nothing_is_cut
{
  bool operator[](std::uint32_t) const { return false; }
};

// `cut[e]` tells whether the edge `e` is cut.
template <typename NT, typename Edge_set>
Wedges find_wedges(const Intrinsic_triangulation<NT>& t, const Edge_set& cut)
{
  typedef std::uint32_t Index;
  const Index null_index = t.null_index;
  const auto is_divided = [&](Index h) { return t.is_border(h) || cut[t.edge(h)]; };

  Wedges wedges;
  wedges.of_corner.assign(t.number_of_halfedges(), null_index);
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    if(wedges.of_corner[t.previous(h)] != null_index)
      continue;
    Index first = h; // clockwise to where the wedge of origin(h) begins
    while(!is_divided(first) && t.next(t.twin(first)) != h)
      first = t.next(t.twin(first));
    for(Index g = first; ; g = t.next_around_origin(g))
    {
      wedges.of_corner[t.previous(g)] = wedges.number_of_wedges;
      if(is_divided(t.previous(g)) || t.next_around_origin(g) == first)
        break;
    }
    ++wedges.number_of_wedges;
  }
  return wedges;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGULATION_WEDGES_H
