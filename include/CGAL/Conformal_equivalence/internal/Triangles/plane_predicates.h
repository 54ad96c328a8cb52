// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_PLANE_PREDICATES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_PLANE_PREDICATES_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

inline Exact_rational exact_number(const Double_double& x) { return Exact_rational(x.hi) + Exact_rational(x.lo); }

template <typename NT>
bool is_finite_point(const std::array<NT, 2>& z)
{
  return std::isfinite(static_cast<double>(z[0])) && std::isfinite(static_cast<double>(z[1]));
}

// Whether p, q, r turn left: exactly for `double` ...
inline bool is_left_turn(const std::array<double, 2>& p, const std::array<double, 2>& q, const std::array<double, 2>& r)
{
  return triangle_orientation({{Plane_point(p[0], p[1]), Plane_point(q[0], q[1]), Plane_point(r[0], r[1])}}) == LEFT_TURN;
}

// ... and for pairs of them;
inline bool is_left_turn(const std::array<Double_double, 2>& p, const std::array<Double_double, 2>& q, const std::array<Double_double, 2>& r)
{
  if(!is_finite_point(p) || !is_finite_point(q) || !is_finite_point(r))
    return false;
  const Exact_rational x = exact_number(p[0]), y = exact_number(p[1]);
  return (exact_number(q[0]) - x) * (exact_number(r[1]) - y) > (exact_number(q[1]) - y) * (exact_number(r[0]) - x);
}

// for other numbers `true` only if that is certain: the two differences and the product have an error of one unit each.
template <typename NT>
bool is_left_turn(const std::array<NT, 2>& p, const std::array<NT, 2>& q, const std::array<NT, 2>& r)
{
  using std::abs;
  if(!is_finite_point(p) || !is_finite_point(q) || !is_finite_point(r))
    return false;
  const NT left = (q[0] - p[0]) * (r[1] - p[1]), right = (q[1] - p[1]) * (r[0] - p[0]);
  const NT bound = 8 * std::numeric_limits<NT>::epsilon() * (abs(left) + abs(right));
  return left - right > bound;
}

// Left turns at all corners, and only one turn in all.
template <typename NT>
bool is_convex_polygon(const std::vector<std::array<NT, 2> >& p)
{
  const std::size_t n = p.size();
  for(std::size_t i = 0; i < n; ++i)
    if(!is_left_turn(p[i], p[(i + 1) % n], p[(i + 2) % n]))
      return false;
  for(std::size_t i = 2; i + 2 < n; ++i)
    if(!is_left_turn(p[0], p[i], p[i + 1]))
      return false;
  return true;
}

// The angle from p to r around q.
template <typename Wide>
double angle_between(const std::array<Wide, 2>& p, const std::array<Wide, 2>& q, const std::array<Wide, 2>& r)
{
  std::array<double, 2> a, b;
  for(std::size_t k = 0; k < 2; ++k)
  {
    a[k] = static_cast<double>(Wide(p[k] - q[k]));
    b[k] = static_cast<double>(Wide(r[k] - q[k]));
  }
  const double scale_a = (std::max)(std::abs(a[0]), std::abs(a[1])), scale_b = (std::max)(std::abs(b[0]), std::abs(b[1]));
  if(!(scale_a > 0) || !(scale_b > 0))
    return 0;
  for(std::size_t k = 0; k < 2; ++k)
  {
    a[k] /= scale_a;
    b[k] /= scale_b;
  }
  return std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_PLANE_PREDICATES_H
