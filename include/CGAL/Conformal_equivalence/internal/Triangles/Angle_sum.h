// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_ANGLE_SUM_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_ANGLE_SUM_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Complex_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Number_constants.h>

#include <cmath>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A sum of triangle corners, as the product of their half angles: one arc tangent at
// the end instead of one for each. Every factor turns by less than pi / 2, so the
// half turns can be counted.
template <typename NT>
class Angle_sum
{
public:
  // adds the angle alpha, given by (x, y) = const * (cos alpha/2, sin alpha/2) with
  // 0 < alpha < pi. The constant should not be far above 1.
  void add(const NT& x, const NT& y)
  {
    z_ = z_ * Complex_number<NT>{x, y};
    count_half_turn();
    const NT size = (z_.re < 0 ? NT(-z_.re) : z_.re) + z_.im;
    if(size < tiny())
      z_ = {z_.re / size, z_.im / size};
  }

  // adds the angle pi of a broken triangle
  void add_straight()
  {
    z_ = {-z_.im, z_.re};
    count_half_turn();
  }

  NT radians() const
  {
    using std::atan2;
    return 2 * (half_turns_ * Number_constants<NT>::pi() + atan2(z_.im, z_.re));
  }

private:
  static NT tiny() { return NT(1e-30); }

  // keeps the argument in [0, pi)
  void count_half_turn()
  {
    if(z_.im < 0 || (z_.im == 0 && z_.re < 0))
    {
      z_ = -z_;
      ++half_turns_;
    }
  }

  Complex_number<NT> z_{NT(1), NT(0)};
  int half_turns_ = 0;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_ANGLE_SUM_H
