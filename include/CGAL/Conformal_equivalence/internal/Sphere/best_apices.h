// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_BEST_APICES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_BEST_APICES_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The vertices that suit best for the apex, the best one first: those with the thickest triangles around them, and around their neighbours. On
// a surface with a border only vertices there with more than one triangle.
template <typename NT>
std::vector<std::uint32_t> best_apices(const Intrinsic_triangulation<NT>& t, std::size_t number)
{
  typedef std::uint32_t Index;
  std::vector<double> thickness(t.number_of_vertices(), 1), around = thickness;
  bool has_border = false;
  for(Index h = 0; h < t.number_of_halfedges(); h += 3)
  {
    const Incircle_form<double> triangle(static_cast<double>(t.halfedge_length(h)), static_cast<double>(t.halfedge_length(h + 1)),
                                         static_cast<double>(t.halfedge_length(h + 2)));
    const double q = triangle.is_triangle ? triangle.r / triangle.s : 0; // at most 1 / sqrt(27)
    for(Index k = h; k < h + 3; ++k)
    {
      thickness[t.origin(k)] = (std::min)(thickness[t.origin(k)], std::isfinite(q) ? q : 0);
      has_border = has_border || t.is_border(k);
    }
  }
  around = thickness;
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    around[t.origin(h)] = (std::min)(around[t.origin(h)], thickness[t.target(h)]);
    around[t.target(h)] = (std::min)(around[t.target(h)], thickness[t.origin(h)]);
  }
  std::vector<Index> result;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v) && (has_border ? t.is_border_vertex(v) && t.degree(v) > 1 : t.degree(v) > 2))
      result.push_back(v);
  const std::size_t n = (std::min)(number, result.size());
  std::partial_sort(result.begin(), result.begin() + std::ptrdiff_t(n), result.end(), [&](Index v, Index w)
    { return around[v] != around[w] ? around[v] > around[w] : thickness[v] != thickness[w] ? thickness[v] > thickness[w] : v < w; });
  result.resize(n);
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_BEST_APICES_H
