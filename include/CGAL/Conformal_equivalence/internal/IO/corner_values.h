// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_IO_CORNER_VALUES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_IO_CORNER_VALUES_H

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Whether FT is a number of Boost.Multiprecision, which has a backend; so asked, no header of that is needed here.
template <typename FT, typename = void>
struct Has_backend : std::false_type {};

template <typename FT>
struct Has_backend<FT, std::void_t<decltype(std::declval<const FT&>().backend())> > : std::true_type {};

// The numbers in which coordinates of type FT are read and written: `double`, unless FT is `long double` or a floating-point number of
// Boost.Multiprecision. (There are no limits of those whose precision is chosen at run time.)
template <typename FT>
struct Corner_number
{
  typedef std::numeric_limits<FT> Limits;
  static constexpr bool is_wide = std::is_same<FT, long double>::value || (Has_backend<FT>::value && !Limits::is_integer && !Limits::is_exact);
  typedef std::conditional_t<is_wide, FT, double> type;

  static type from(const FT& x)
  {
    if constexpr(is_wide)
      return x;
    else
      return CGAL::to_double(x);
  }
};

// A point of the layout, as numbers.
template <typename HalfedgeUVMap, typename Halfedge>
auto corner_value(const HalfedgeUVMap& uv, Halfedge h)
{
  const auto& p = get(uv, h);
  typedef Corner_number<std::decay_t<decltype(p.x())> > Number;
  return std::array<typename Number::type, 2>{{ Number::from(p.x()), Number::from(p.y()) }};
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
      const auto value = corner_value(uv, h);
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

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_IO_CORNER_VALUES_H
