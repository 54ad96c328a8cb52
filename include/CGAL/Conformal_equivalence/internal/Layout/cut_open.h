// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A surface cut open along some of its edges, as a surface of its own.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_CUT_OPEN_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_CUT_OPEN_H

#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/wedges.h>

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// By wedge: its number if wedges are counted in the order of their vertices.
template <typename NT>
std::vector<std::uint32_t> order_of_wedges(const Intrinsic_triangulation<NT>& t, const Wedges& wedges)
{
  typedef std::uint32_t Index;
  std::vector<Index> vertex(wedges.number_of_wedges), next(t.number_of_vertices() + 1, 0), result(wedges.number_of_wedges);
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
    vertex[wedges.of_corner[h]] = t.target(h);
  for(Index v : vertex)
    ++next[v + 1];
  std::partial_sum(next.begin(), next.end(), next.begin()); // now the number of the first wedge of each vertex
  for(Index w = 0; w < wedges.number_of_wedges; ++w)
    result[w] = next[vertex[w]]++;
  return result;
}

// The surface `t` cut open along `cut`. Its vertices are the wedges, in the order of the vertices of `t`.
// Faces and halfedges keep their numbers, edges do not; all lengths are 1.
template <typename NT>
Intrinsic_triangulation<NT> cut_open(const Intrinsic_triangulation<NT>& t, const Cut_graph& cut)
{
  typedef std::uint32_t Index;
  const Wedges wedges = find_wedges(t, cut);
  const std::vector<Index> number = order_of_wedges(t, wedges);
  std::vector<Index> origin(t.number_of_halfedges()), twin(t.number_of_halfedges());
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    origin[h] = number[wedges.of_corner[t.previous(h)]];
    twin[h] = cut[t.edge(h)] ? t.null_index : t.twin(h);
  }
  return Intrinsic_triangulation<NT>(wedges.number_of_wedges, std::move(origin), std::move(twin));
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_CUT_OPEN_H
