// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_INCIRCLE_VECTORS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_INCIRCLE_VECTORS_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Vector_of.h>

#include <cmath>
#include <cstring>
#include <utility>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// What the formulas of a few triangles at once have in common.
template <int bytes>
struct Triangle_vectors
{
  typedef typename Vector_of<double, bytes>::type Vector;
  static constexpr int lanes = Vector_of<double, bytes>::lanes;
  typedef std::make_integer_sequence<int, lanes> Lanes;

  // b + c - a, as excess() has it
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void set_excess(const Vector& a, const Vector& b, const Vector& c, Vector& result)
  {
    const auto is_longer = b > c;
    const Vector longer = is_longer ? b : c, shorter = is_longer ? c : b;
    result = (longer - a) + shorter;
  }

  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void set_root(const Vector& square, Vector& result) { set_root(square, result, Lanes()); }

  // The radius of the inscribed circle, by the tangents from the corners to it and half of the circumference s. `is_plain` becomes 1, or 0 where
  // the triangle needs care; then the radius is without meaning.
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void set_radius(const Vector (&tangent)[3], const Vector& s, Vector& r, Vector& is_plain)
  {
    const Vector zero = {}, one = zero + 1., square = tangent[0] * tangent[1] * tangent[2] / s;
    const auto is_safe = (tangent[0] > 0.) & (tangent[1] > 0.) & (tangent[2] > 0.) & (square > 1e-200) & (square < 1e200);
    is_plain = is_safe ? one : zero;
    set_root(is_safe ? square : one, r);
  }

  // The cotangent of alpha, by tan(alpha / 2).
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void set_cotangent(const Vector& q, Vector& result) { result = (1. - q) * (1. + q) / (q + q); }

  // The argument of x + i y in the first quadrant. With q <= 1 the smaller of x and y, divided by the larger, its arc tangent is that of t = q,
  // or, beyond tan(pi/8), pi/4 and that of t = (q - 1) / (q + 1). The polynomial, which interpolates (atan(t)/t - 1)/t^2 at the zeros of a
  // Chebyshev polynomial in t^2, has an error below 2^-56 of atan(t) for |t| <= tan(pi/8). With the roundings of t, which move it by 1.2u at
  // most, those of the polynomial, of two constants and of two sums below pi/2, the error is at most 5u.
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void set_arc_tangent(const Vector& y, const Vector& x, Vector& result)
  {
    const double c[] = {-0x1.5555555555555p-2, 0x1.999999999934ap-3, -0x1.24924924360cbp-3, 0x1.c71c7185314cbp-4,
                        -0x1.745d0b26b83e7p-4, 0x1.3b1262d95579ep-4, -0x1.10fa75382537fp-4, 0x1.dfe61e80903d2p-5,
                        -0x1.a098bb6ba4941p-5, 0x1.41603647c7a7cp-5, -0x1.3a2b7a07caea9p-6};
    const double tan_pi_8 = 0.41421356237309503, pi_4 = 0.78539816339744828, pi_2 = 1.5707963267948966;
    const Vector zero = {};
    const auto is_steep = y > x;
    const Vector greater = is_steep ? y : x, lesser = is_steep ? x : y;
    const auto is_wide = lesser > greater * tan_pi_8;
    const Vector t = (is_wide ? lesser - greater : lesser) / (is_wide ? lesser + greater : greater), z = t * t;
    Vector sum = zero + c[10];
    for(int k = 9; k >= 0; --k)
      sum = sum * z + c[k];
    const Vector angle = (is_wide ? zero + pi_4 : zero) + (t + t * (z * sum));
    result = is_steep ? pi_2 - angle : angle;
  }

  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void store(const Vector& v, double* p) { std::memcpy(p, &v, sizeof(v)); }

private:
  template <int... i>
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void set_root(const Vector& square, Vector& result, std::integer_sequence<int, i...>)
  {
    double entries[lanes];
    store(square, entries);
    result = Vector{std::sqrt(entries[i])...};
  }
};

// Angles and cotangents of a few triangles at once, by the formulas of `Incircle_form`. Triangles that need care, as they are broken, or sides differ
// by some seventy orders of magnitude, are left to it.
//
// Errors, with u = 2^-53: the tangents s - a, ... have relative errors of 2u as functions of the sides, and s of 2u. So tan(alpha/2), the root
// of three of these divided by the fourth, is off by 6.5u, or 7.5u where it is divided out. That moves alpha by 6.5u sin(alpha), and its
// cotangent by 7.5u / sin(alpha). The arc tangent adds 5u, which is doubled, and the cotangent is rounded four times more. So errors of
// angles are at most 17u, those of cotangents 8u / sin(alpha) + 4u |cot(alpha)|.
template <int bytes>
struct Incircle_vectors : public Triangle_vectors<bytes>
{
  typedef Triangle_vectors<bytes> Base;
  using typename Base::Vector;
  using Base::lanes;

  // Opposite to side k of triangle i.
  double angle[3][lanes], cotangent[3][lanes];
  double is_plain[lanes]; // 1, or 0 where the triangle needs care; then the other numbers are without meaning

  // Triangles by their sides.
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void compute(const Vector& a, const Vector& b, const Vector& c)
  {
    Vector tangent[3], r, plain, half, cotangent_of_it;
    Base::set_excess(a, b, c, tangent[0]);
    Base::set_excess(b, c, a, tangent[1]);
    Base::set_excess(c, a, b, tangent[2]);
    for(int k = 0; k < 3; ++k)
      tangent[k] *= 0.5;
    Base::set_radius(tangent, (a + b + c) * 0.5, r, plain);
    Base::store(plain, is_plain);
    for(int k = 0; k < 3; ++k)
    {
      Base::set_arc_tangent(r, tangent[k], half);
      Base::store(half + half, angle[k]);
      Base::set_cotangent(r / tangent[k], cotangent_of_it); // r / (s - a) = tan(alpha / 2)
      Base::store(cotangent_of_it, cotangent[k]);
    }
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_INCIRCLE_VECTORS_H
