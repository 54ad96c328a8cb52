// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The length f of the diagonal kl of two triangles that share the edge ij.
//
//              k              Two ways to find it:
//           b / \ a             Ptolemy     f = (a c + b d) / e: defined for all positive lengths; stays in the discrete
//            /   \                          conformal class, and is the Euclidean one where the quadrilateral is inscribed
//           i--e--j                         in a circle;
//            \   /              Euclidean   the distance in the plane, where the two triangles are laid side by side: stays
//           c \ / d                         on the same flat surface.
//              l

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_FLIPPED_LENGTH_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_FLIPPED_LENGTH_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/number_conversions.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/delaunay_predicate.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// (a c + b d) / e by mantissas and exponents: no intermediate result over- or underflows
template <typename NT>
CGAL_CONFORMAL_EQUIVALENCE_COLD
NT ptolemy_length_by_exponents(const NT& a, const NT& b, const NT& c, const NT& d, const NT& e)
{
  using std::ldexp;
  std::array<int, 5> x;
  NT ac = mantissa(a, x[0]) * mantissa(c, x[2]), bd = mantissa(b, x[1]) * mantissa(d, x[3]);
  const int of_ac = x[0] + x[2], of_bd = x[1] + x[3], larger = (std::max)(of_ac, of_bd);
  ac = ldexp(ac, (std::max)(of_ac - larger, -1000));
  bd = ldexp(bd, (std::max)(of_bd - larger, -1000));
  const NT mantissa_of_e = mantissa(e, x[4]);
  return ldexp((ac + bd) / mantissa_of_e, larger - x[4]);
}

/// `(a c + b d) / e`, as in the picture on top
/// \return relative error of at most `ptolemy_error<NT>()`, unless the length itself is out of range
template <typename NT>
NT ptolemy_length(const NT& a, const NT& b, const NT& c, const NT& d, const NT& e)
{
  const NT ac = a * c, bd = b * d, sum = ac + bd;
  if constexpr(has_range_of_double<NT>())
    if(!(ac > NT(1e-250) && bd > NT(1e-250) && sum < NT(1e250)))
      return ptolemy_length_by_exponents(a, b, c, d, e);
  return sum / e;
}

/// bound of its relative error: 3 units of rounding, (7 + 3 + 15) 2^-106 for `Double_double`
template <typename NT>
double ptolemy_error()
{
  const double eps = static_cast<double>((std::numeric_limits<NT>::epsilon)());
  return (std::max)((std::is_same<NT, Double_double>::value ? 7 : 2) * eps, 1e-300);
}

/// the length of the other diagonal of the quadrilateral around `e` by Ptolemy's theorem (conformal scaling commutes with
/// it). \pre `t.is_flippable(e)`; lengths are positive
template <typename NT>
NT ptolemy_length(const Intrinsic_triangulation<NT>& t, std::uint32_t e)
{
  const std::array<std::uint32_t, 5> x = quad_edges(t, e);
  return ptolemy_length(t.length(x[1]), t.length(x[2]), t.length(x[3]), t.length(x[4]), t.length(x[0]));
}

// The other diagonal in the plane. With i = (0, 0) and j = (e, 0) the third vertices lie at k = (x, y), l = (x', -y'):
//   x - x' = ((b - a)(b + a) - (c - d)(c + d)) / (2 e),   y = 2 area / e,
// the area by the incircle form, whose errors are relative. `Wide` holds twice the digits where the lengths are `double`.
template <typename NT>
class Euclidean_diagonal
{
  typedef std::conditional_t<std::is_same<NT, double>::value, Double_double, NT> Wide;

public:
  // lengths in the order of `quad_edges()`
  explicit Euclidean_diagonal(std::array<NT, 5> lengths)
  {
    const int exponent = scale(lengths);
    const Wide e(lengths[0]), a(lengths[1]), b(lengths[2]), c(lengths[3]), d(lengths[4]);
    const Wide x = ((b - a) * (b + a) - (c - d) * (c + d)) / (2 * e), y = height(e, a, b), z = height(e, c, d);
    using std::ldexp;
    using std::sqrt;
    const Wide f = sqrt(Wide(x * x + (y + z) * (y + z)));
    const To_double value;
    for(std::size_t n = 0; n < 5; ++n)
      l_[n] = value(lengths[n]);
    x_ = value(x);
    height_ = {{value(y), value(z)}};
    f_ = value(f);
    length_ = ldexp(static_cast<NT>(f), exponent);
  }

  const NT& length() const { return length_; }

  // a bound of the relative error of the length, where those of the five lengths are at most `errors` (first-order terms,
  // and the square root of the error where a triangle is degenerate)
  double error(const std::array<double, 5>& errors) const
  {
    const double eps = static_cast<double>((std::numeric_limits<NT>::epsilon)()),
                 eps_of_wide = static_cast<double>((std::numeric_limits<Wide>::epsilon)());
    const double rounding = 2 * eps + 16 * eps_of_wide * (l_[1] + l_[2] + l_[3] + l_[4]) / f_;
    double dx = std::fabs(x_) * errors[0];
    for(std::size_t n = 1; n < 5; ++n)
      dx += l_[n] * l_[n] * errors[n] / l_[0];
    const double dy = error_of_height(0, {{errors[0], errors[1], errors[2]}})
                    + error_of_height(1, {{errors[0], errors[3], errors[4]}});
    const double df = std::fabs(x_) * dx + (height_[0] + height_[1]) * dy + dx * dx + dy * dy;
    const double result = (std::max)(rounding, 1e-300) + 1.5 * df / (f_ * f_);
    return result >= 0 ? result : std::numeric_limits<double>::infinity(); // NaN, where f is 0
  }

private:
  static int scale(std::array<NT, 5>& lengths)
  {
    int exponent = 0;
    if constexpr(has_range_of_double<NT>())
    {
      using std::ldexp;
      mantissa(*std::max_element(lengths.begin(), lengths.end()), exponent);
      for(NT& x : lengths)
        x = ldexp(x, -exponent);
    }
    return exponent;
  }

  static Wide height(const Wide& e, const Wide& a, const Wide& b)
  {
    const Incircle_form<Wide> t(e, a, b); // degenerate, or slightly beyond: r = 0
    return 2 * t.r * t.s / e;
  }

  // of triangle 0, (e, a, b), or 1, (e, c, d), from 16 area^2 = 4 e^2 b^2 - (e^2 + b^2 - a^2)^2, whose derivative by the
  // square of a side is twice the sum of the other two squares less its own
  double error_of_height(std::size_t triangle, const std::array<double, 3>& errors) const
  {
    const std::array<double, 3> square = {{l_[0] * l_[0], l_[1 + 2 * triangle] * l_[1 + 2 * triangle],
                                           l_[2 + 2 * triangle] * l_[2 + 2 * triangle]}};
    const double sum = square[0] + square[1] + square[2], h = height_[triangle];
    double d = 2 * h * h * errors[0];
    for(std::size_t n = 0; n < 3; ++n)
      d += square[n] * std::fabs(sum - 2 * square[n]) * errors[n] / square[0]
         + square[n] * square[n] * errors[n] * errors[n] / square[0];
    const double of_degenerate = std::sqrt(d);
    return h > of_degenerate ? d / h : of_degenerate;
  }

  NT length_;
  std::array<double, 5> l_;  // scaled, as the following
  double x_, f_;
  std::array<double, 2> height_;
};

/// the distance of the vertices opposite to `e` when its two triangles are laid side by side in the plane
/// \pre `t.is_flippable(e)`; the triangles' lengths satisfy the triangle inequality (equality allowed)
template <typename NT>
NT euclidean_length(const Intrinsic_triangulation<NT>& t, std::uint32_t e)
{
  return Euclidean_diagonal<NT>(quad_lengths(t, quad_edges(t, e))).length();
}

enum class Flip_rule { PTOLEMY, EUCLIDEAN };

// A length with a bound of its relative error.
template <typename Real>
struct Bounded_length
{
  Real value;
  double error;
};

// the length of the other diagonal; lengths in the order of `quad_edges()`
template <typename Real>
Bounded_length<Real> flipped_length(const std::array<Bounded_length<Real>, 5>& x, Flip_rule rule)
{
  Bounded_length<Real> f;
  if(rule == Flip_rule::PTOLEMY)
  {
    f.value = ptolemy_length(x[1].value, x[2].value, x[3].value, x[4].value, x[0].value);
    f.error = ptolemy_error<Real>() + x[0].error + (std::max)(x[1].error + x[3].error, x[2].error + x[4].error);
  }
  else
  {
    const std::array<Real, 5> lengths = {{x[0].value, x[1].value, x[2].value, x[3].value, x[4].value}};
    const Euclidean_diagonal<Real> diagonal(lengths);
    f.value = diagonal.length();
    f.error = diagonal.error({{x[0].error, x[1].error, x[2].error, x[3].error, x[4].error}});
  }
  f.error = f.error < .01 ? 1.02 * f.error : 1; // terms of second order
  return f;
}

// How far the relative difference of the two sides may be off, owing to the errors of the five lengths.
inline double error_of_difference(const std::array<double, 5>& x)
{
  const double left = (std::max)(x[1] + x[3], x[2] + x[4]) + (std::max)(x[1] + x[4], x[2] + x[3]),
               right = 2 * x[0] + (std::max)(x[1] + x[2], x[3] + x[4]), sum = 1.1 * (std::max)(left, right);
  return sum < .1 ? sum : 2; // (1 + x)^n < 1 + 1.1 n x for n x < .1; differences are at most 1: with 2 nothing is certain
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_FLIPPED_LENGTH_H
