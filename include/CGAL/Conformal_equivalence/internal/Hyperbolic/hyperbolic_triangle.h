// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The formulas of one triangle of the hyperbolic plane, written in x = sinh(l/2) for each side l. In the hyperboloid 2x is the chord
// between the ends of a side, and the three chords form a Euclidean triangle, in the plane through the three corners: so Ptolemy's relation and
// the predicate of Delaunay are those of Euclidean triangles with sides x (B. Springborn, "Ideal hyperbolic polyhedra and discrete
// uniformization", 2020; Bobenko, Pinkall and Springborn, "Discrete conformal maps and ideal hyperbolic polyhedra", 2015, section 6).
//
// With lengths a, b, c, s = (a + b + c) / 2 and angle alpha opposite to a:
//
//   tan(alpha / 2) = r / sinh(s - a),   r^2 = sinh(s - a) sinh(s - b) sinh(s - c) / sinh(s)
//
// For a triangle much smaller than 1 the s - a are differences of lengths. They are not found from rounded lengths, but from x:
// with p = sinh((b + c) / 2) = x_b y_c + y_b x_c and y = cosh(l/2) = sqrt(1 + x^2),
//
//   sinh(s - a) = (p - x_a) (p + x_a) / sinh(s),
//   p - x_a = (x_b + x_c - x_a) + x_b (y_c - 1) + x_c (y_b - 1),   y - 1 = x^2 / (1 + y),
//
// where nothing but the first bracket is a difference, and that one is as exact as for Euclidean triangles.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_TRIANGLE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_TRIANGLE_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Complex_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <array>
#include <cmath>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// cosh(l/2) for x = sinh(l/2).
template <typename NT>
NT hyperbolic_cosine(const NT& x)
{
  using std::sqrt;
  return sqrt(NT(1 + x * x));
}

// cosh(l/2) - 1 to all digits, given cosh(l/2), too.
template <typename NT>
NT hyperbolic_cosine_minus_one(const NT& x, const NT& y)
{
  return x * x / (1 + y);
}

// As `Incircle_form`, with hyperbolic sines in the place of lengths: of a side that is seen under the angle alpha from the opposite corner
// `(tangent, r)` is a multiple of (cos alpha/2, sin alpha/2).
template <typename NT>
struct Hyperbolic_incircle_form
{
  NT s, r;
  std::array<NT, 3> tangent; // sinh of s - a, s - b, s - c
  bool is_triangle;          // the strict triangle inequalities hold

  // x, y = cosh(l/2), and m = y - 1 of the three sides
  Hyperbolic_incircle_form(const std::array<NT, 3>& x, const std::array<NT, 3>& y, const std::array<NT, 3>& m) : r(0)
  {
    const NT p = sine_of_sum(x, y, 0);
    s = p * y[0] + x[0] * (y[1] * y[2] + x[1] * x[2]);
    const NT unit = 1 / s;
    tangent = {{difference(x, m, 0) * ((p + x[0]) * unit), difference(x, m, 1) * ((sine_of_sum(x, y, 1) + x[1]) * unit),
                difference(x, m, 2) * ((sine_of_sum(x, y, 2) + x[2]) * unit)}};
    is_triangle = tangent[0] > 0 && tangent[1] > 0 && tangent[2] > 0;
    if(is_triangle)
      r = incircle_radius(tangent, s);
  }

  // Are its angles pi, 0 and 0?
  bool is_broken() const { return !is_triangle || !(r > 0); }

private:
  // p = sinh((b + c) / 2)
  static NT sine_of_sum(const std::array<NT, 3>& x, const std::array<NT, 3>& y, int k)
  {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    return x[i] * y[j] + y[i] * x[j];
  }

  // p - x_a
  static NT difference(const std::array<NT, 3>& x, const std::array<NT, 3>& m, int k)
  {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    return excess(x[k], x[i], x[j]) + x[i] * m[j] + x[j] * m[i];
  }
};

// The weights w_k of the sides in the Hessian: where u changes by d at the corners, the angle sums change such that
//
//   sum over corners of (change of the angle) d = - sum over sides w_k ( (d_i - d_j)^2 + tanh^2(l_k/2) (d_i + d_j)^2 ),   w_k = tan((alpha_i +
//   alpha_j - alpha_k) / 2) / 2.
//
// A triangle has a circumscribed circle iff the chords form a triangle. With R its radius, sinh R = 2 (radius of the circle around the
// triangle with sides x), and gamma_k the angle of that triangle opposite to the side,  w_k = cot(gamma_k) / (2 cosh R): both triangles at
// a side whose four vertices lie on a circle have the same R, and the weights cancel just as the cotangents do.
template <typename NT>
std::array<NT, 3> hyperbolic_weights(const std::array<NT, 3>& x, const Hyperbolic_incircle_form<NT>& triangle)
{
  using std::sqrt;
  std::array<NT, 3> result;
  const Incircle_form<NT> chords(x[0], x[1], x[2]);
  if(!chords.is_broken())
  {
    const NT sinh_radius = x[0] / chords.r * (x[1] / chords.s) * x[2] / 2;
    const NT unit = 1 / (2 * sqrt(NT(1 + sinh_radius * sinh_radius)));
    for(int k = 0; k < 3; ++k)
      result[k] = unit * cotangent(chords, k);
    return result;
  }
  std::array<NT, 3> t; // tan(alpha / 2)
  for(int k = 0; k < 3; ++k)
    t[k] = triangle.r / triangle.tangent[k];
  for(int k = 0; k < 3; ++k)
  {
    const NT &ti = t[(k + 1) % 3], &tj = t[(k + 2) % 3];
    const Complex_number<NT> z = Complex_number<NT>{NT(1), ti} * Complex_number<NT>{NT(1), tj} * Complex_number<NT>{NT(1), NT(-t[k])};
    result[k] = z.im / (2 * z.re);
  }
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_TRIANGLE_H
