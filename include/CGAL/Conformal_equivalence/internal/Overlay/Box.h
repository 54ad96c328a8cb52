// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_BOX_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_BOX_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A box with sides parallel to the axes, of the plane or of space.
template <std::size_t dimension>
struct Box
{
  typedef std::array<double, dimension> Point;

  Point low, high;

  static Box empty()
  {
    Box result;
    result.low.fill(std::numeric_limits<double>::infinity());
    result.high.fill(-std::numeric_limits<double>::infinity());
    return result;
  }

  bool is_finite() const
  {
    const auto is_finite = [](double x) { return std::isfinite(x); };
    return std::all_of(low.begin(), low.end(), is_finite) && std::all_of(high.begin(), high.end(), is_finite);
  }

  bool contains(const Point& p) const
  {
    for(std::size_t i = 0; i < dimension; ++i)
      if(!(low[i] <= p[i] && p[i] <= high[i]))
        return false;
    return true;
  }

  void unite(const Box& b)
  {
    for(std::size_t i = 0; i < dimension; ++i)
    {
      low[i] = (std::min)(low[i], b.low[i]);
      high[i] = (std::max)(high[i], b.high[i]);
    }
  }

  void insert(const Point& p) { unite(Box{p, p}); }

  std::size_t longest_axis() const
  {
    std::size_t axis = 0;
    for(std::size_t i = 1; i < dimension; ++i)
      if(high[i] - low[i] > high[axis] - low[axis])
        axis = i;
    return axis;
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_BOX_H
