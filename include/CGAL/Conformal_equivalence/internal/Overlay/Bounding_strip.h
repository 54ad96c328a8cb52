// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_BOUNDING_STRIP_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_BOUNDING_STRIP_H

#include <CGAL/Conformal_equivalence/internal/Overlay/Box.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A part of the plane that holds some points: that of their bounding box between two parallels, which leave a long and thin shape
// little room. It holds them for certain: the distances from the parallels are not trusted beyond their rounding errors.
class Bounding_strip
{
  static constexpr double infinity_ = std::numeric_limits<double>::infinity();

  Box<2> box_ = Box<2>::empty();
  std::array<double, 2> normal_ = {{ 0, 0 }};         // of the parallels; 0 if there are none
  double low_ = infinity_, high_ = -infinity_;

  double height(double x, double y) const { return normal_[0] * x + normal_[1] * y; }
  // More than the rounding errors of the height of a point, of the normal, and of the sum of the two, in all eight operations.
  static double error(double x, double y) { return 8 * std::numeric_limits<double>::epsilon() * (std::abs(x) + std::abs(y)); }

public:
  // The parallels get the direction of the longest side of the triangle.
  explicit Bounding_strip(const std::array<std::array<double, 2>, 3>& triangle)
  {
    double longest = 0;
    for(std::size_t k = 0; k < 3; ++k)
    {
      const std::array<double, 2> &p = triangle[k], &q = triangle[(k + 1) % 3];
      const double x = q[0] - p[0], y = q[1] - p[1], length = std::hypot(x, y);
      if(longest < length && std::isfinite(length))
      {
        longest = length;
        normal_ = {{ -y / length, x / length }};
      }
    }
    for(const std::array<double, 2>& p : triangle)
      insert(p);
  }

  // Points that are not finite are left out.
  void insert(const std::array<double, 2>& p)
  {
    if(!std::isfinite(p[0]) || !std::isfinite(p[1]))
      return;
    box_.insert(p);
    low_ = (std::min)(low_, height(p[0], p[1]) - error(p[0], p[1]));
    high_ = (std::max)(high_, height(p[0], p[1]) + error(p[0], p[1]));
  }

  const Box<2>& box() const { return box_; }

  // Is the point between the parallels?
  bool is_between(double x, double y) const
  {
    return height(x, y) + error(x, y) >= low_ && height(x, y) - error(x, y) <= high_;
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_BOUNDING_STRIP_H
