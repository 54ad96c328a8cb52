// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_SPHERE_PREDICATES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_SPHERE_PREDICATES_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Exact_number.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename NT>
NT determinant(const std::array<NT, 3>& p, const std::array<NT, 3>& q, const std::array<NT, 3>& r)
{
  return p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
}

// Six times as large as any sum of products in the determinant.
template <typename NT>
double determinant_bound(const std::array<NT, 3>& p, const std::array<NT, 3>& q, const std::array<NT, 3>& r)
{
  double result = 6;
  for(const std::array<NT, 3>* x : {&p, &q, &r})
    result *= (std::max)({std::abs(static_cast<double>((*x)[0])), std::abs(static_cast<double>((*x)[1])), std::abs(static_cast<double>((*x)[2]))});
  return result;
}

// The sign of the determinant: exactly, by the filter as far as it goes. Its error is at most `unit` times the bound above: the
// errors of its five roundings, in whatever way numbers are rounded. \pre the coordinates are finite
template <typename NT>
Sign exact_determinant_sign(const std::array<NT, 3>& p, const std::array<NT, 3>& q, const std::array<NT, 3>& r, double unit)
{
  const double value = static_cast<double>(determinant(p, q, r)), bound = unit * determinant_bound(p, q, r);
  if(std::abs(value) > bound && bound > 1e-250)
    return value > 0 ? POSITIVE : NEGATIVE;
  const auto exact = [](const std::array<NT, 3>& x)
    { return std::array<Exact_number, 3>{{ exact_number(x[0]), exact_number(x[1]), exact_number(x[2]) }}; };
  return determinant(exact(p), exact(q), exact(r)).sign();
}

// Whether p, q, r are counterclockwise on a sphere around the origin, seen from outside: exactly for `double` ...
inline bool is_counterclockwise(const std::array<double, 3>& p, const std::array<double, 3>& q, const std::array<double, 3>& r)
{
  return has_finite_coordinates(p) && has_finite_coordinates(q) && has_finite_coordinates(r)
         && exact_determinant_sign(p, q, r, 2e-15) == POSITIVE;
}

// ... and for pairs of them;
inline bool is_counterclockwise(const std::array<Double_double, 3>& p, const std::array<Double_double, 3>& q, const std::array<Double_double, 3>& r)
{
  return has_finite_coordinates(p) && has_finite_coordinates(q) && has_finite_coordinates(r)
         && exact_determinant_sign(p, q, r, 1e-29) == POSITIVE;
}

// for other numbers `true` only if that is certain.
template <typename NT>
bool is_counterclockwise(const std::array<NT, 3>& p, const std::array<NT, 3>& q, const std::array<NT, 3>& r)
{
  if(!has_finite_coordinates(p) || !has_finite_coordinates(q) || !has_finite_coordinates(r))
    return false;
  return determinant(p, q, r) > NT(16 * std::numeric_limits<NT>::epsilon() * determinant_bound(p, q, r));
}

// The area of a spherical triangle, negative if it is clockwise (A. van Oosterom and J. Strackee, 1983).
template <typename NT>
double solid_angle(const std::array<NT, 3>& p, const std::array<NT, 3>& q, const std::array<NT, 3>& r)
{
  const auto dot = [](const std::array<NT, 3>& a, const std::array<NT, 3>& b)
    { return static_cast<double>(NT(a[0] * b[0] + a[1] * b[1] + a[2] * b[2])); };
  return 2 * std::atan2(static_cast<double>(determinant(p, q, r)), 1 + dot(p, q) + dot(q, r) + dot(r, p));
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_SPHERE_PREDICATES_H
