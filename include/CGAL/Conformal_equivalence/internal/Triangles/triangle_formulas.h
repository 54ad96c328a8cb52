// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The formulas of one triangle with side lengths a, b, c, written once for every
// number type (sections 2 and 3.1 of Springborn, Schroeder and Pinkall, 2008).
//
//                  C
//                 / \            alpha is the angle at A, opposite to side a,
//              b /   \ a         and so on; s = (a + b + c) / 2;
//               / (r) \          r is the radius of the incircle,
//              /       \         r^2 = (s-a)(s-b)(s-c) / s
//             A ------- B
//                  c
//
// The half-angle formula (6) reads tan(alpha / 2) = r / (s - a). All of it is
// homogeneous: scaling the triangle first changes nothing.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_TRIANGLE_FORMULAS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_TRIANGLE_FORMULAS_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Complex_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Number_constants.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/Angle_sum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// b + c - a, in an order in which only one rounding is left wherever the result
// is small (W. Kahan, "Miscalculating area and angles of a needle-like triangle").
// For lengths stored as `double` the sign of the result is exact.
template <typename NT>
NT excess(const NT& a, const NT& b, const NT& c)
{
  const NT &longer = (std::max)(b, c), &shorter = (std::min)(b, c);
  return (longer - a) + shorter;
}

// sqrt(x y z / s), for x, y, z = `tangent`: by powers where the products neither over- nor underflow, which is always but for triangles
// whose sides differ by some seventy orders of magnitude.
template <typename NT>
NT incircle_radius(const std::array<NT, 3>& tangent, const NT& s)
{
  using std::sqrt;
  const NT product = tangent[0] * tangent[1] * tangent[2] / s, least_safe(1e-200), greatest_safe(1e200);
  if(product > least_safe && product < greatest_safe)
    return sqrt(product);
  return sqrt(tangent[0]) * sqrt(tangent[1]) * (sqrt(tangent[2]) / sqrt(s));
}

// The incircle form of a triangle: its semiperimeter, r, and s-a, s-b, s-c.
template <typename NT>
struct Incircle_form
{
  NT s, r;
  std::array<NT, 3> tangent; // s-a, s-b, s-c: the lengths from the corners to where the incircle touches
  bool is_triangle;          // the strict triangle inequalities hold

  Incircle_form(const NT& a, const NT& b, const NT& c)
    : s((a + b + c) / 2), r(0), tangent{{excess(a, b, c) / 2, excess(b, c, a) / 2, excess(c, a, b) / 2}}
  {
    is_triangle = tangent[0] > 0 && tangent[1] > 0 && tangent[2] > 0;
    if(is_triangle)
      r = incircle_radius(tangent, s);
  }

  // Are its angles pi, 0 and 0? (So they are, too, where r comes to nothing by rounding.)
  bool is_broken() const { return !is_triangle || !(r > 0); }
};

// The angle opposite to side `side` of a triangle, half-angle formula (6).
template <typename NT>
NT angle(const Incircle_form<NT>& t, int side)
{
  using std::atan2;
  return 2 * atan2(t.r, t.tangent[side]);
}

// Its cotangent: cot(2x) = (cot x - tan x) / 2.
template <typename NT>
NT cotangent(const Incircle_form<NT>& t, int side)
{
  const NT& x = t.tangent[side];
  const NT q = t.r / x; // tan(alpha / 2)
  return (1 - q) * (1 + q) / (2 * q);
}

// Angles and cotangents opposite to the sides a, b, c, extended to all positive
// lengths as in section 3.1: where a triangle inequality fails, the angle
// opposite to the too long side is pi, the others are 0, and so are all three
// cotangents.
template <typename NT>
struct Triangle_angles
{
  std::array<NT, 3> angle, cotangent;
  bool is_broken;
};

template <typename NT>
int longest_side(const NT& a, const NT& b, const NT& c)
{
  return a > b ? (a > c ? 0 : 2) : (b > c ? 1 : 2);
}

template <typename NT>
Triangle_angles<NT> triangle_angles(const NT& a, const NT& b, const NT& c)
{
  const Incircle_form<NT> t(a, b, c);
  Triangle_angles<NT> result;
  result.is_broken = t.is_broken();
  for(int k = 0; k < 3; ++k)
  {
    result.angle[k] = result.is_broken ? NT(0) : internal::angle(t, k);
    result.cotangent[k] = result.is_broken ? NT(0) : internal::cotangent(t, k);
  }
  if(result.is_broken)
    result.angle[longest_side(a, b, c)] = Number_constants<NT>::pi();
  return result;
}

// e^{i alpha}, the square of (s - a) + i r, divided by its absolute value.
template <typename NT>
Complex_number<NT> rotation(const Incircle_form<NT>& t, int side)
{
  const NT &x = t.tangent[side], &y = t.r;
  const NT q = x < y ? NT(x / y) : NT(y / x); // without over- or underflow
  const NT d = 1 + q * q;
  const NT cosine = (1 - q * q) / d, sine = 2 * q / d;
  return {x < y ? NT(-cosine) : cosine, sine};
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_TRIANGLE_FORMULAS_H
