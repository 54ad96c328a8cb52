// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CORNER_VALUES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CORNER_VALUES_H

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A point of the layout, as numbers.
template <typename HalfedgeUVMap, typename Halfedge>
std::array<double, 2> corner_value(const HalfedgeUVMap& uv, Halfedge h)
{
  const auto& p = get(uv, h);
  return {{ CGAL::to_double(p.x()), CGAL::to_double(p.y()) }};
}

// Numbers the distinct values of `uv` at the corners of each vertex, vertex by
// vertex: `number[h]` becomes the one of the corner of `target(h)` in `face(h)`.
// Equal values at a vertex share a number. Returns a halfedge for each number.
template <typename TriangleMesh, typename HalfedgeUVMap, typename HalfedgeNumberMap>
std::vector<typename boost::graph_traits<TriangleMesh>::halfedge_descriptor>
number_corner_values(const TriangleMesh& tm, const HalfedgeUVMap& uv, HalfedgeNumberMap number)
{
  typedef boost::graph_traits<TriangleMesh>            Graph_traits;
  typedef typename Graph_traits::halfedge_descriptor   halfedge_descriptor;

  std::vector<halfedge_descriptor> representatives;
  for(auto v : vertices(tm))
  {
    if(halfedge(v, tm) == Graph_traits::null_halfedge())
      continue;
    const std::size_t first = representatives.size();
    for(halfedge_descriptor h : CGAL::halfedges_around_target(v, tm))
    {
      if(is_border(h, tm))
        continue;
      const std::array<double, 2> value = corner_value(uv, h);
      std::size_t i = first;
      while(i < representatives.size() && corner_value(uv, representatives[i]) != value)
        ++i;
      if(i == representatives.size())
        representatives.push_back(h);
      put(number, h, i);
    }
  }
  return representatives;
}

// Edges at which the layout ends: borders, and edges whose two sides lie apart.
// To be asked of a halfedge that has a face.
template <typename TriangleMesh, typename HalfedgeUVMap, typename Halfedge>
bool is_outline(const TriangleMesh& tm, const HalfedgeUVMap& uv, Halfedge h)
{
  const Halfedge o = opposite(h, tm);
  return is_border(o, tm)
      || corner_value(uv, h) != corner_value(uv, prev(o, tm))
      || corner_value(uv, prev(h, tm)) != corner_value(uv, o);
}

// The halfedge of the outline that follows `h` along it, the layout on the left.
template <typename TriangleMesh, typename HalfedgeUVMap, typename Halfedge>
Halfedge next_on_outline(const TriangleMesh& tm, const HalfedgeUVMap& uv, Halfedge h)
{
  Halfedge n = next(h, tm);
  while(! is_outline(tm, uv, n))
    n = next(opposite(n, tm), tm);
  return n;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CORNER_VALUES_H
