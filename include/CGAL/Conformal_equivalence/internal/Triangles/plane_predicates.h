// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_PLANE_PREDICATES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_PLANE_PREDICATES_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Exact_number.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename NT, std::size_t dimension>
bool has_finite_coordinates(const std::array<NT, dimension>& p)
{
  return std::all_of(p.begin(), p.end(), [](const NT& x) { return std::isfinite(static_cast<double>(x)); });
}

// Which way one turns at q on the way from p over q to r: exactly. \pre the coordinates are finite
template <typename NT>
Orientation exact_turn(const std::array<NT, 2>& p, const std::array<NT, 2>& q, const std::array<NT, 2>& r)
{
  const Exact_number x = exact_number(p[0]), y = exact_number(p[1]);
  return ((exact_number(q[0]) - x) * (exact_number(r[1]) - y) - (exact_number(q[1]) - y) * (exact_number(r[0]) - x)).sign();
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template Orientation exact_turn(const std::array<double, 2>&, const std::array<double, 2>&, const std::array<double, 2>&);
#endif

// The same for `double`, where the determinant as computed nearly always tells: its error is less than two units in the last
// place of the sum of its two products, in whatever way numbers are rounded, if none of them has underflowed.
inline Orientation turn(const std::array<double, 2>& p, const std::array<double, 2>& q, const std::array<double, 2>& r)
{
  const double left = (q[0] - p[0]) * (r[1] - p[1]), right = (q[1] - p[1]) * (r[0] - p[0]);
  const double size = std::abs(left) + std::abs(right), error = 4 * std::numeric_limits<double>::epsilon() * size;
  const double least_size = 1e-290, largest_size = 1e300; // outside of them the bound may not hold, for underflow or overflow
  if(size > least_size && size < largest_size && std::abs(left - right) > error)
    return left > right ? LEFT_TURN : RIGHT_TURN;
  return exact_turn(p, q, r);
}

// Whether p, q, r turn left: exactly for `double` ...
inline bool is_left_turn(const std::array<double, 2>& p, const std::array<double, 2>& q, const std::array<double, 2>& r)
{
  return has_finite_coordinates(p) && has_finite_coordinates(q) && has_finite_coordinates(r) && turn(p, q, r) == LEFT_TURN;
}

// ... and for pairs of them;
inline bool is_left_turn(const std::array<Double_double, 2>& p, const std::array<Double_double, 2>& q, const std::array<Double_double, 2>& r)
{
  return has_finite_coordinates(p) && has_finite_coordinates(q) && has_finite_coordinates(r) && exact_turn(p, q, r) == LEFT_TURN;
}

// for other numbers `true` only if that is certain: the two differences and the product of each of the two terms have an error of one unit each,
// and the bound is twice as large, for numbers that are rounded in other ways than to the nearest.
template <typename NT>
bool is_left_turn(const std::array<NT, 2>& p, const std::array<NT, 2>& q, const std::array<NT, 2>& r)
{
  using std::abs;
  if(!has_finite_coordinates(p) || !has_finite_coordinates(q) || !has_finite_coordinates(r))
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
