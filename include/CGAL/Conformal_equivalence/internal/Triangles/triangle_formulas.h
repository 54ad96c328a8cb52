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

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>

#include <boost/math/constants/constants.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename NT>
struct Number_constants
{
  static NT pi() { return boost::math::constants::pi<NT>(); }
};

template <>
struct Number_constants<Double_double>
{
  static Double_double pi() { return quick_two_sum(3.141592653589793116, 1.2246467991473531772e-16); }
};

// b + c - a, in an order in which only one rounding is left wherever the result
// is small (W. Kahan, "Miscalculating area and angles of a needle-like triangle").
// For lengths stored as `double` the sign of the result is exact.
template <typename NT>
NT excess(const NT& a, const NT& b, const NT& c)
{
  const NT &longer = (std::max)(b, c), &shorter = (std::min)(b, c);
  return (longer - a) + shorter;
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
      r = radius();
  }

private:
  // By powers where the products neither over- nor underflow, which is always
  // but for triangles whose sides differ by some seventy orders of magnitude.
  NT radius() const
  {
    using std::sqrt;
    const NT product = tangent[0] * tangent[1] * tangent[2] / s;
    if(product > least_safe() && product < greatest_safe())
      return sqrt(product);
    return sqrt(tangent[0]) * sqrt(tangent[1]) * (sqrt(tangent[2]) / sqrt(s));
  }

  static NT least_safe() { return NT(1e-200); }
  static NT greatest_safe() { return NT(1e200); }
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
  result.is_broken = !t.is_triangle || !(t.r > 0);
  for(int k = 0; k < 3; ++k)
  {
    result.angle[k] = result.is_broken ? NT(0) : internal::angle(t, k);
    result.cotangent[k] = result.is_broken ? NT(0) : internal::cotangent(t, k);
  }
  if(result.is_broken)
    result.angle[longest_side(a, b, c)] = Number_constants<NT>::pi();
  return result;
}

// A complex number; unlike std::complex defined for every number type.
template <typename NT>
struct Complex_number
{
  NT re, im;
  friend Complex_number operator*(const Complex_number& x, const Complex_number& y)
  {
    return {x.re * y.re - x.im * y.im, x.re * y.im + x.im * y.re};
  }
};

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
    if(z_.im < 0 || (z_.im == 0 && z_.re < 0))
    {
      z_ = {-z_.re, -z_.im};
      ++half_turns_;
    }
    const NT size = (z_.re < 0 ? NT(-z_.re) : z_.re) + z_.im;
    if(size < tiny())
      z_ = {z_.re / size, z_.im / size};
  }

  // adds the angle pi of a broken triangle
  void add_straight()
  {
    z_ = {-z_.im, z_.re};
    if(z_.im < 0 || (z_.im == 0 && z_.re < 0))
    {
      z_ = {-z_.re, -z_.im};
      ++half_turns_;
    }
  }

  NT radians() const
  {
    using std::atan2;
    return 2 * (half_turns_ * Number_constants<NT>::pi() + atan2(z_.im, z_.re));
  }

private:
  static NT tiny() { return NT(1e-30); }

  Complex_number<NT> z_{NT(1), NT(0)};
  int half_turns_ = 0;
};

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

// e^{i x}, by the Taylor series at x / 2^10 and ten squarings, which cost ten bits;
// for finite |x| < 1000 or so.
template <typename NT>
Complex_number<NT> unit_complex(const NT& x)
{
  const NT z = x / 1024;
  Complex_number<NT> term{NT(1), NT(0)}, sum = term;
  for(int n = 1; ; ++n)
  {
    term = {-term.im * z / n, term.re * z / n};
    const Complex_number<NT> longer{sum.re + term.re, sum.im + term.im};
    if(longer.re == sum.re && longer.im == sum.im)
      break;
    sum = longer;
  }
  for(int k = 0; k < 10; ++k)
    sum = sum * sum;
  return sum;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_TRIANGLE_FORMULAS_H
