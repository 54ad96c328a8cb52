// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_DELAUNAY_FLIPPER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_DELAUNAY_FLIPPER_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/length_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <CGAL/assertions.h>
#include <CGAL/enum.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/number_utils.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

// Delaunay triangulations by flips of edges, for lengths that are scaled by factors s_i = e^{u_i/2} at the vertices
// (Springborn, "Ideal hyperbolic polyhedra and discrete uniformization", 2020; Gu, Luo, Sun and Wu, "A discrete
// uniformization theorem for polyhedral surfaces", 2018; Springborn, Schroeder and Pinkall, 2008, Section 3.2).
//
//              k              The edge ij is Delaunay iff cos(angle at k) + cos(angle at l) >= 0. Written with the scaled
//           b / \ a           lengths, and multiplied out, that is
//            /   \                                                                                       .
//           i--e--j             (a c + b d) (a d + b c)  >=  e^2 (a b + c d),
//            \   /
//           c \ / d           with equality iff the four vertices lie on a circle (Ptolemy's second theorem). All of it
//              l              is positive, so rounding costs a few units in the last place, and no triangle inequality
//                             is needed: for lengths that are merely positive it says "ideal Delaunay" (Penner).
//
// Two ways to find the length f of the other diagonal, kl:
//   Ptolemy     f = (a c + b d) / e: defined for all positive lengths; stays in the discrete conformal class, and is the
//               Euclidean one where the quadrilateral is inscribed in a circle;
//   Euclidean   the distance in the plane, where the two triangles are laid side by side: stays on the same flat surface.
//
// Stopping. Lengths after a flip are rounded, so exact decisions on the stored numbers may go around in circles among
// cocircular vertices. Hence each length has a bound of its relative error, as compared with the exact length that the
// recorded flips make of the lengths at the beginning, and an edge is flipped only if it is not Delaunay whatever the errors
// are. Such a flip is one of the exact flip algorithm, which ends: no edge can come back at the same factors. Ties are left
// alone. New lengths are computed with more digits than they are stored with; where many flips have used these up, again
// from the beginning, with 300 digits.

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// ---- one edge, its two triangles ------------------------------------------------------------------------------------

// The lengths and scale factors around an edge, named as in the picture.
template <typename Real>
struct Quad
{
  Real e, a, b, c, d; // of ij, jk, ki, il, lj, not scaled
  Real i, j, k, l;    // scale factors
};

// the edges of the quadrilateral, in the order of `Quad`: e, a, b, c, d
template <typename NT>
std::array<std::uint32_t, 5> quad_edges(const Intrinsic_triangulation<NT>& t, std::uint32_t e)
{
  const std::uint32_t h = t.edge_halfedge(e), g = t.twin(h);
  return {{e, t.edge(t.next(h)), t.edge(t.previous(h)), t.edge(t.next(g)), t.edge(t.previous(g))}};
}

// their lengths
template <typename NT>
std::array<NT, 5> quad_lengths(const Intrinsic_triangulation<NT>& t, const std::array<std::uint32_t, 5>& x)
{
  return {{t.length(x[0]), t.length(x[1]), t.length(x[2]), t.length(x[3]), t.length(x[4])}};
}

// the quadrilateral around the interior edge `e`, its numbers converted by `convert`; no factors: all are 1
template <typename Real, typename NT, typename Scale, typename Convert>
Quad<Real> quad(const Intrinsic_triangulation<NT>& t, std::uint32_t e, const std::vector<Scale>& s, const Convert& convert)
{
  const std::uint32_t h = t.edge_halfedge(e), g = t.twin(h);
  Quad<Real> q{convert(t.length(e)), convert(t.halfedge_length(t.next(h))), convert(t.halfedge_length(t.previous(h))),
               convert(t.halfedge_length(t.next(g))), convert(t.halfedge_length(t.previous(g))),
               Real(1), Real(1), Real(1), Real(1)};
  if(!s.empty())
  {
    q.i = convert(s[t.origin(h)]);
    q.j = convert(s[t.target(h)]);
    q.k = convert(s[t.apex(h)]);
    q.l = convert(s[t.apex(g)]);
  }
  return q;
}

struct To_double
{
  template <typename NT> double operator()(const NT& x) const { return static_cast<double>(x); }
};

struct To_double_double
{
  Double_double operator()(double x) const { return x; }
  const Double_double& operator()(const Double_double& x) const { return x; }
  template <typename NT>
  Double_double operator()(const NT& x) const
  {
    const double hi = static_cast<double>(x);
    return two_sum(hi, static_cast<double>(NT(x - NT(hi))));
  }
};

// A number for the rare cases, of some 300 digits.
typedef boost::multiprecision::number<boost::multiprecision::cpp_bin_float<1024, boost::multiprecision::digit_base_2>,
                                      boost::multiprecision::et_off> Precise_number;

template <typename NT>
NT square_root(const NT& x)
{
  using std::sqrt;
  return sqrt(x);
}

// By Newton's method, as Boost's own square root takes 50 times as long. The relative error is far below the 1e-300 that all
// bounds of errors in this type count as rounding.
inline Precise_number square_root(const Precise_number& x)
{
  if(!(x > 0))
    return Precise_number(0);
  int exponent = 0;
  (void) frexp(x, &exponent);
  exponent -= exponent % 2;
  const Precise_number z = ldexp(x, -exponent);                    // in [1/4, 2)
  Precise_number y = 1 / std::sqrt(static_cast<double>(z));        // of z^{-1/2}
  for(int digits = 50; digits < 1024; digits *= 2)
    y += y * (1 - z * y * y) / 2;
  return ldexp(Precise_number(z * y), exponent / 2);
}

struct To_precise
{
  Precise_number operator()(const Double_double& x) const { return Precise_number(x.hi) + Precise_number(x.lo); }
  template <typename NT> Precise_number operator()(const NT& x) const { return static_cast<Precise_number>(x); }
};

template <typename NT>
struct From_precise
{
  NT operator()(const Precise_number& x) const { return static_cast<NT>(x); }
};

template <>
struct From_precise<Double_double>
{
  Double_double operator()(const Precise_number& x) const { return To_double_double()(x); }
};

struct To_exact
{
  template <typename NT> Exact_rational operator()(const NT& x) const { return exact_rational(x); }
};

// The two sides of the inequality on top, for the scaled lengths e i j, a j k, ..., divided by i j.
template <typename Real>
std::pair<Real, Real> ptolemy_sides(const Quad<Real>& q)
{
  const Real jj = q.j * q.j, ii = q.i * q.i, kk = q.k * q.k, ll = q.l * q.l;
  const Real ac_bd = q.a * q.c + q.b * q.d, ad_bc = q.a * q.d * jj + q.b * q.c * ii;
  const Real ab_cd = q.a * q.b * kk + q.c * q.d * ll, e = q.e * q.i * q.j;
  return std::make_pair(Real(ac_bd * ad_bc * (kk * ll)), Real(e * e * ab_cd));
}

// ---- filters --------------------------------------------------------------------------------------------------------

// relative errors of both sides, from arguments rounded to the type: below 32 * 2^-53, and below 2^-95
template <typename Real> double filter_error();
template <> inline double filter_error<double>() { return 7.2e-15; }
template <> inline double filter_error<Double_double>() { return 0x1p-90; }

template <typename Real>
bool is_in_range(const Quad<Real>& q, double from)
{
  const To_double value;
  const double least = (std::min)({value(q.e), value(q.a), value(q.b), value(q.c), value(q.d),
                                   value(q.i), value(q.j), value(q.k), value(q.l)}),
               greatest = (std::max)({value(q.e), value(q.a), value(q.b), value(q.c), value(q.d),
                                      value(q.i), value(q.j), value(q.k), value(q.l)});
  return least > from && greatest < 1 / from; // NaN may slip through: then the sides are NaN, and nothing is certain
}

// sides of numbers in this range, which have ten factors, neither over- nor underflow
template <typename Real>
bool is_in_filter_range(const Quad<Real>& q)
{
  return is_in_range(q, 1e-28);
}

// divides the lengths by one power of two, and the factors by another: neither matters
template <typename Real>
void scale_by_powers_of_two(Quad<Real>& q)
{
  using std::ldexp;
  const To_double value;
  int lengths = 0, factors = 0;
  std::frexp((std::max)({value(q.e), value(q.a), value(q.b), value(q.c), value(q.d)}), &lengths);
  std::frexp((std::max)({value(q.i), value(q.j), value(q.k), value(q.l)}), &factors);
  for(Real* x : {&q.e, &q.a, &q.b, &q.c, &q.d})
    *x = ldexp(*x, -lengths);
  for(Real* x : {&q.i, &q.j, &q.k, &q.l})
    *x = ldexp(*x, -factors);
}

// x 2^-exponent in [1/2, 1)
template <typename NT>
NT mantissa(const NT& x, int& exponent)
{
  using std::ldexp;
  std::frexp(static_cast<double>(x), &exponent);
  return ldexp(x, -exponent);
}

// A positive number m 2^n, where numbers are too far apart for one range. The exponents of a few factors are of no size;
// a product of ten mantissas is at least 2^-10; and of a sum, what is 2^-900 times the other is lost at most.
template <typename Real>
struct With_exponent
{
  Real m;
  int n;

  With_exponent(const Real& m, int n) : m(m), n(n) {}
  explicit With_exponent(const Real& x) : n(0) { m = mantissa(x, n); }

  friend With_exponent operator*(const With_exponent& x, const With_exponent& y)
  {
    return With_exponent(Real(x.m * y.m), x.n + y.n);
  }
  friend With_exponent operator+(const With_exponent& x, const With_exponent& y)
  {
    const int larger = (std::max)(x.n, y.n);
    return With_exponent(Real(x.scaled_down(larger) + y.scaled_down(larger)), larger);
  }

  Real scaled_down(int larger) const
  {
    using std::ldexp;
    return ldexp(m, (std::max)(n - larger, -950));
  }
};

// The two sides, divided by a common power of two, of numbers of which the ratio is beyond the range of the filter.
template <typename Real>
std::pair<Real, Real> ptolemy_sides_by_exponents(const Quad<Real>& q)
{
  typedef With_exponent<Real> Number;
  const Quad<Number> x{Number(q.e), Number(q.a), Number(q.b), Number(q.c), Number(q.d),
                       Number(q.i), Number(q.j), Number(q.k), Number(q.l)};
  const std::pair<Number, Number> sides = ptolemy_sides(x);
  const int larger = (std::max)(sides.first.n, sides.second.n);
  return std::make_pair(sides.first.scaled_down(larger), sides.second.scaled_down(larger));
}

// The relative difference (left - right) / (left + right) of the sides, as far as it is known.
struct Relative_difference
{
  double value, error;
};

// \return `false` if a number may have lost digits by underflow (or is no positive number)
template <typename Real>
bool filtered_difference(const Quad<Real>& q, Relative_difference& difference)
{
  Quad<Real> scaled = q;
  if(!is_in_filter_range(q))
    scale_by_powers_of_two(scaled);
  const bool is_near_one = is_in_filter_range(scaled);
  if(!is_near_one && !is_in_range(q, 1e-270))
    return false;
  const std::pair<Real, Real> sides = is_near_one ? ptolemy_sides(scaled) : ptolemy_sides_by_exponents(q);
  difference.value = static_cast<double>(Real((sides.first - sides.second) / (sides.first + sides.second)));
  difference.error = filter_error<Real>() + 1e-15 * std::fabs(difference.value);
  return std::isfinite(difference.value);
}

// the sign is exact, the value is rounded, never to 0
inline Relative_difference exact_difference(const Quad<Exact_rational>& q)
{
  const std::pair<Exact_rational, Exact_rational> sides = ptolemy_sides(q);
  const Exact_rational difference(sides.first - sides.second), sum(sides.first + sides.second);
  const Sign sign = CGAL::sign(difference);
  double value = sign == ZERO ? 0. : CGAL::to_double(Exact_rational(difference / sum));
  if(value == 0 && sign != ZERO)
    value = sign == POSITIVE ? (std::numeric_limits<double>::min)() : -(std::numeric_limits<double>::min)();
  return Relative_difference{value, 0.};
}

// The fast path, some 30 operations: whether the edge is Delaunay beyond doubt.
inline bool is_certainly_delaunay(const Quad<double>& q)
{
  const std::pair<double, double> sides = ptolemy_sides(q);
  return sides.first - sides.second > filter_error<double>() * (sides.first + sides.second)
         && is_in_filter_range(q);
}

template <typename NT>
bool is_positive_number(const NT& x)
{
  using std::isfinite;
  return isfinite(x) && x > 0;
}

template <typename NT, typename Scale>
bool has_positive_numbers(const Intrinsic_triangulation<NT>& t, std::uint32_t e, const std::vector<Scale>& s)
{
  for(const std::uint32_t x : quad_edges(t, e))
    if(!is_positive_number(t.length(x)))
      return false;
  const std::uint32_t h = t.edge_halfedge(e);
  if(!s.empty())
    for(const std::uint32_t v : {t.origin(h), t.target(h), t.apex(h), t.apex(t.twin(h))})
      if(!is_positive_number(s[v]))
        return false;
  return true;
}

/// the exact sign of `cos(angle at k) + cos(angle at l)` for the lengths of `t` and the factors `s` (none: all 1), taken as
/// real numbers: `POSITIVE` or `ZERO` iff the edge is Delaunay, `ZERO` iff the four vertices lie on a circle
/// \pre `e` is an interior edge; lengths and factors are positive and finite
template <typename NT, typename Scale>
Sign delaunay_sign(const Intrinsic_triangulation<NT>& t, std::uint32_t e, const std::vector<Scale>& s,
                   std::size_t* filter_failures = nullptr)
{
  Relative_difference d;
  if(filtered_difference(quad<double>(t, e, s, To_double()), d) && std::fabs(d.value) > d.error)
    return d.value > 0 ? POSITIVE : NEGATIVE;
  count_failure(filter_failures);
  if(filtered_difference(quad<Double_double>(t, e, s, To_double_double()), d) && std::fabs(d.value) > d.error)
    return d.value > 0 ? POSITIVE : NEGATIVE;
  const double value = exact_difference(quad<Exact_rational>(t, e, s, To_exact())).value;
  return value > 0 ? POSITIVE : (value < 0 ? NEGATIVE : ZERO);
}

// ---- lengths of the other diagonal ----------------------------------------------------------------------------------

// whether numbers have the range of `double`
template <typename NT>
constexpr bool has_range_of_double()
{
  return std::numeric_limits<NT>::max_exponent <= std::numeric_limits<double>::max_exponent;
}

// (a c + b d) / e by mantissas and exponents: no intermediate result over- or underflows
template <typename NT>
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
  if(!has_range_of_double<NT>() || (ac > NT(1e-250) && bd > NT(1e-250) && sum < NT(1e250)))
    return sum / e;
  return ptolemy_length_by_exponents(a, b, c, d, e);
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
    const Wide f = square_root(Wide(x * x + (y + z) * (y + z)));
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
    if(has_range_of_double<NT>())
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
    if constexpr(std::is_same<Wide, Precise_number>::value)
    {
      const Wide x = excess(e, a, b), y = excess(a, b, e), z = excess(b, e, a);
      return x > 0 && y > 0 && z > 0 ? Wide(square_root(Wide((e + a + b) * x * y * z)) / (2 * e)) : Wide(0);
    }
    else
    {
      const Incircle_form<Wide> t(e, a, b); // degenerate, or slightly beyond: r = 0
      return 2 * t.r * t.s / e;
    }
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

// Lengths computed from coordinates are rounded: by less than 3.5 * 2^-53 for the square root of a sum of squares of
// differences, so that those of a degenerate triangle can violate its inequality by 7 * 2^-53 of the longest.

/// whether `a`, `b`, `c` are the lengths of a triangle, possibly a degenerate one, up to their rounding: no one is longer
/// than the other two together by more than 4 epsilon (8 * 2^-53) of itself. Decided exactly
template <typename NT>
bool is_triangle_up_to_rounding(const NT& a, const NT& b, const NT& c)
{
  const auto holds = [](const NT& x, const NT& y, const NT& longest)
  {
    if(triangle_inequality_sign(x, y, longest) != NEGATIVE)
      return true;
    const Exact_rational tolerated = exact_rational(NT(4 * (std::numeric_limits<NT>::epsilon)())),
                         rest(exact_rational(x) + exact_rational(y) - exact_rational(longest));
    return CGAL::sign(Exact_rational(rest + tolerated * exact_rational(longest))) != NEGATIVE;
  };
  return holds(a, b, c) && holds(b, c, a) && holds(c, a, b);
}

// ---- what became of the lengths -------------------------------------------------------------------------------------

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

// Every length that an edge has had is a node: first those given, node `e` for edge `e`, then one for each flip, which
// knows the five lengths it was computed from. So a flip that undoes an earlier one gives back what was there, and lengths
// can be computed again from those given, as precisely as it takes.
template <typename NT>
class Length_history
{
public:
  typedef std::uint32_t Index;
  typedef std::conditional_t<std::is_same<NT, double>::value, Double_double, NT> Wide;

  explicit Length_history(const std::vector<NT>& lengths)
    : given_(lengths), node_(lengths.size())
  {
    for(std::size_t e = 0; e < node_.size(); ++e)
      node_[e] = Index(e);
  }

  // bound of the relative error of the length of the edge `e`
  double error(Index e) const { return is_given(node_[e]) ? 0. : flip(node_[e]).error; }

  // flips `edges[0]`, in the order of `quad_edges()`, and writes its new length
  // \return `false`, and nothing has happened, if the length is 0 or out of range
  bool flip(const std::array<Index, 5>& edges, Flip_rule rule, NT& length)
  {
    return restore(edges, rule, length) || compute(edges, rule, length);
  }

  std::size_t number_of_restored_lengths() const { return restored_; }
  std::size_t number_of_renewed_lengths() const { return renewed_; }

private:
  struct Flip
  {
    NT length;
    double error;
    Bounded_length<Wide> wide; // `length` is this one, rounded
    std::array<Index, 5> from; // nodes in the order of `quad_edges()`
    Flip_rule rule;
  };

  bool is_given(Index n) const { return n < given_.size(); }
  Flip& flip(Index n) { return flips_[n - given_.size()]; }
  const Flip& flip(Index n) const { return flips_[n - given_.size()]; }

  Bounded_length<Wide> wide_length(Index n) const
  {
    return is_given(n) ? Bounded_length<Wide>{Wide(given_[n]), 0.} : flip(n).wide;
  }

  // whether the flip undoes the one by which the edge came
  bool restore(const std::array<Index, 5>& edges, Flip_rule rule, NT& length)
  {
    const Index n = node_[edges[0]];
    if(is_given(n) || flip(n).rule != rule || !has_same_sides(flip(n).from, edges))
      return false;
    const Index before = flip(n).from[0];
    length = is_given(before) ? given_[before] : flip(before).length;
    node_[edges[0]] = before;
    ++restored_;
    return true;
  }

  bool compute(const std::array<Index, 5>& edges, Flip_rule rule, NT& length)
  {
    std::array<Index, 5> from;
    std::array<Bounded_length<Wide>, 5> x;
    for(std::size_t n = 0; n < 5; ++n)
    {
      from[n] = node_[edges[n]];
      x[n] = wide_length(from[n]);
    }
    Bounded_length<Wide> f = flipped_length(x, rule);
    if(!(f.error < error_of_worn_length()))
      renew(from, rule, f);
    length = static_cast<NT>(f.value);
    if(!is_usable(length))
      return false;
    const double rounding = std::is_same<NT, Wide>::value ? 0. : epsilon<NT>();
    node_[edges[0]] = Index(given_.size() + flips_.size());
    flips_.push_back({length, f.error + rounding, f, from, rule});
    return true;
  }

  template <typename Real>
  static double epsilon() { return static_cast<double>((std::numeric_limits<Real>::epsilon)()); }

  // from then on the error of the stored length would be more than its rounding
  static double error_of_worn_length()
  {
    return (std::max)(std::is_same<NT, Wide>::value ? 1000 * epsilon<NT>() : epsilon<NT>() / 100, 1e-250);
  }

  // computes the length again, from those given, with 300 digits
  void renew(const std::array<Index, 5>& from, Flip_rule rule, Bounded_length<Wide>& f)
  {
    if(precise_.size() > 300000) // to limit the memory
      precise_.clear();
    std::array<Bounded_length<Precise_number>, 5> x;
    for(std::size_t n = 0; n < 5; ++n)
    {
      if(!evaluate(from[n]))
        return;
      x[n] = precise_.find(from[n])->second;
    }
    const Bounded_length<Precise_number> precise = flipped_length(x, rule);
    const double error = 1.01 * precise.error + (std::max)(epsilon<Wide>(), 1e-300);
    if(!(error < f.error))
      return;
    f.value = From_precise<Wide>()(precise.value);
    f.error = error;
    ++renewed_;
  }

  // so that the bounds of rounding hold
  static bool is_usable(const NT& length)
  {
    return is_positive_number(length)
           && (!has_range_of_double<NT>() || (length > NT(1e-280) && length < NT(1e280)));
  }

  // opposite sides remain opposite
  bool has_same_sides(const std::array<Index, 5>& from, const std::array<Index, 5>& edges) const
  {
    const auto same = [&](std::size_t p, std::size_t q, Index x, Index y)
    {
      return (from[p] == x && from[q] == y) || (from[p] == y && from[q] == x);
    };
    const Index a = node_[edges[1]], b = node_[edges[2]], c = node_[edges[3]], d = node_[edges[4]];
    return (same(1, 3, a, c) && same(2, 4, b, d)) || (same(1, 3, b, d) && same(2, 4, a, c));
  }

  // writes the precise length of the node `last`, and of all that it comes from
  bool evaluate(Index last)
  {
    std::vector<Index> stack(1, last);
    for(std::size_t step = 0; !stack.empty(); ++step)
    {
      const Index n = stack.back();
      if(step > 1000000)
        return false;
      if(precise_.count(n) == 0 && is_given(n))
        precise_.emplace(n, Bounded_length<Precise_number>{To_precise()(given_[n]), error_of_conversion()});
      else if(precise_.count(n) == 0)
      {
        const Flip& f = flip(n);
        if(push_unknown(f.from, stack))
          continue;
        const auto x = [&](std::size_t m) { return precise_.find(f.from[m])->second; };
        precise_.emplace(n, flipped_length<Precise_number>({{x(0), x(1), x(2), x(3), x(4)}}, f.rule));
      }
      stack.pop_back();
    }
    return true;
  }

  bool push_unknown(const std::array<Index, 5>& nodes, std::vector<Index>& stack) const
  {
    const std::size_t size = stack.size();
    for(const Index m : nodes)
      if(precise_.count(m) == 0)
        stack.push_back(m);
    return stack.size() > size;
  }

  static double error_of_conversion()
  {
    return std::is_same<NT, double>::value || std::is_same<NT, Double_double>::value ? 0. : 1e-300;
  }

  std::vector<NT> given_;
  std::vector<Index> node_; // by edge
  std::vector<Flip> flips_;
  std::unordered_map<Index, Bounded_length<Precise_number> > precise_; // by node, as needed
  std::size_t restored_ = 0, renewed_ = 0;
};

// ---- the flip algorithm ---------------------------------------------------------------------------------------------

struct Delaunay_flip_counts
{
  std::size_t flips = 0;             // those undone included
  std::size_t restored = 0;          // of these, flips that undid an earlier one: the earlier length is back, bit by bit
  std::size_t filter_failures = 0;   // decisions for which `double` did not do
  std::size_t exact_decisions = 0;   // of these, decisions by rationals, on the stored numbers
  std::size_t ties = 0;              // edges left as they are, as they are Delaunay within their bounds
  std::size_t renewed = 0;           // lengths computed again from those given, after many flips
};

struct Delaunay_verdict
{
  bool is_exact = true;             // all signs are at least 0, exactly, on the stored numbers
  bool is_within_bounds = true;     // or would be for lengths within the bounds of their errors
  std::vector<std::uint32_t> edges; // of which neither is true
};

/// Makes a triangulation Delaunay by flips, again and again as the scale factors change. As long as it is used no one else
/// changes the triangulation. The lengths at the construction are taken for exact.
template <typename NT>
class Delaunay_flipper
{
public:
  typedef std::uint32_t Index;
  typedef internal::Flip_rule Flip_rule;

  explicit Delaunay_flipper(Intrinsic_triangulation<NT>& t)
    : t_(t), history_(t.lengths()), is_candidate_(t.number_of_edges(), 0),
      flip_budget_(10000 + 100 * std::size_t(t.number_of_edges()))
  {}

  /// limits the number of flips of one call. Default: 100 for each edge, and 10 000
  void set_flip_budget(std::size_t n) { flip_budget_ = n; }

  /// flips edges until none of `candidates`, and of the edges around the flipped ones, is flippable and not Delaunay beyond
  /// the errors of the lengths.
  /// \param s factors `e^{u/2}` by vertex; none: all are 1
  /// \param rule of the new lengths. Euclidean ones are those of the triangles without factors: \pre all factors are 1
  /// \param on_flip `on_flip(e)` is called right before the edge `e` is flipped
  /// \return `false` if the flip budget was exhausted: then `unfinished_edges()` are those to be flipped next
  template <typename Scale, typename OnFlip>
  bool flip_to_delaunay(const std::vector<Scale>& s, std::vector<Index> candidates, Flip_rule rule, OnFlip on_flip)
  {
    CGAL_precondition(s.empty() || s.size() == t_.number_of_vertices());
    candidates_.clear();
    unfinished_.clear();
    for(std::size_t n = candidates.size(); n > 0; --n) // the first comes first
      add_candidate(candidates[n - 1]);
    for(std::size_t flips = 0; !candidates_.empty(); )
    {
      const Index e = candidates_.back();
      candidates_.pop_back();
      is_candidate_[e] = 0;
      if(!is_to_be_flipped(e, s))
        continue;
      if(flips == flip_budget_)
        unfinished_.push_back(e); // and whatever else there is
      else if(flip(e, rule, on_flip))
        ++flips;
    }
    return unfinished_.empty();
  }

  template <typename Scale>
  bool flip_to_delaunay(const std::vector<Scale>& s, std::vector<Index> candidates, Flip_rule rule)
  {
    return flip_to_delaunay(s, std::move(candidates), rule, [](Index) {});
  }

  /// flips until all edges are Delaunay.
  template <typename Scale>
  bool flip_to_delaunay(const std::vector<Scale>& s, Flip_rule rule)
  {
    std::vector<Index> all(t_.number_of_edges());
    for(Index e = 0; e < t_.number_of_edges(); ++e)
      all[e] = e;
    return flip_to_delaunay(s, std::move(all), rule);
  }

  const std::vector<Index>& unfinished_edges() const { return unfinished_; }
  const Delaunay_flip_counts& counts() const { return counts_; }

  /// the bound of the relative error of the length of `e`: 0 if it is the one given
  double length_error(Index e) const { return history_.error(e); }

  /// states whether the triangulation is Delaunay, exactly or within the bounds of errors. Linear time.
  template <typename Scale>
  Delaunay_verdict verdict(const std::vector<Scale>& s)
  {
    const Delaunay_flip_counts before = counts_; // it is not a part of the work
    Delaunay_verdict result;
    for(Index e = 0; e < t_.number_of_edges(); ++e)
    {
      if(!t_.is_flippable(e) || is_certainly_delaunay(quad<double>(t_, e, s, To_double())))
        continue;
      const State exact = state(e, s, 0.);
      if(exact == State::DELAUNAY)
        continue;
      result.is_exact = false;
      if(is_to_be_flipped(e, s))
      {
        result.is_within_bounds = false;
        result.edges.push_back(e);
      }
    }
    counts_ = before;
    return result;
  }

private:
  enum class State { DELAUNAY, WITHIN_BOUND, NOT_DELAUNAY };

  void add_candidate(Index e)
  {
    if(is_candidate_[e])
      return;
    is_candidate_[e] = 1;
    candidates_.push_back(e);
  }

  template <typename Scale>
  bool is_to_be_flipped(Index e, const std::vector<Scale>& s)
  {
    if(!t_.is_flippable(e) || is_certainly_delaunay(quad<double>(t_, e, s, To_double())))
      return false;
    const State result = state(e, s, relative_bound(e));
    if(result == State::WITHIN_BOUND)
      ++counts_.ties;
    return result == State::NOT_DELAUNAY;
  }

  double relative_bound(Index e) const
  {
    const std::array<Index, 5> x = quad_edges(t_, e);
    return error_of_difference({{history_.error(x[0]), history_.error(x[1]), history_.error(x[2]),
                                 history_.error(x[3]), history_.error(x[4])}});
  }

  template <typename Scale>
  State state(Index e, const std::vector<Scale>& s, double bound)
  {
    Relative_difference d;
    State result = State::WITHIN_BOUND;
    if(filtered_difference(quad<double>(t_, e, s, To_double()), d) && is_decided(d, bound, result))
      return result;
    ++counts_.filter_failures;
    if(filtered_difference(quad<Double_double>(t_, e, s, To_double_double()), d) && is_decided(d, bound, result))
      return result;
    if(!has_positive_numbers(t_, e, s))
      return State::NOT_DELAUNAY;
    ++counts_.exact_decisions;
    is_decided(exact_difference(quad<Exact_rational>(t_, e, s, To_exact())), bound, result);
    return result;
  }

  static bool is_decided(const Relative_difference& d, double bound, State& result)
  {
    if(d.value - d.error >= 0)
      result = State::DELAUNAY;
    else if(d.value + d.error < -bound)
      result = State::NOT_DELAUNAY;
    else if(d.value - d.error >= -bound)
      result = State::WITHIN_BOUND;
    else
      return false;
    return true;
  }

  template <typename OnFlip>
  bool flip(Index e, Flip_rule rule, OnFlip& on_flip)
  {
    const std::array<Index, 5> x = quad_edges(t_, e);
    NT length;
    if(!history_.flip(x, rule, length)) // 0 or out of range: the edge stays
      return false;
    on_flip(e);
    t_.flip_edge(e, length);
    ++counts_.flips;
    counts_.restored = history_.number_of_restored_lengths();
    counts_.renewed = history_.number_of_renewed_lengths();
    for(std::size_t n = 1; n < 5; ++n)
      add_candidate(x[n]);
    return true;
  }

  Intrinsic_triangulation<NT>& t_;
  Length_history<NT> history_;
  std::vector<Index> candidates_;  // the last one is looked at next
  std::vector<char> is_candidate_; // by edge
  std::vector<Index> unfinished_;
  std::size_t flip_budget_;
  Delaunay_flip_counts counts_;
};

/// makes `t` the intrinsic Delaunay triangulation of its metric, by Euclidean flips. Triangles may be degenerate, or violate their inequality by
/// the rounding of their lengths: then they count as degenerate.
/// \param broken_faces receives the faces that violate it by more
/// \param on_flip `on_flip(e)` is called right before the edge `e` is flipped
/// \return `false`, and does nothing, if there are any of these
template <typename NT, typename OnFlip>
bool make_intrinsic_delaunay(Intrinsic_triangulation<NT>& t, std::vector<std::uint32_t>& broken_faces, OnFlip on_flip)
{
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); h += 3)
    if(!is_triangle_up_to_rounding(t.halfedge_length(h), t.halfedge_length(h + 1), t.halfedge_length(h + 2)))
      broken_faces.push_back(h / 3);
  if(!broken_faces.empty())
    return false;
  std::vector<std::uint32_t> all(t.number_of_edges());
  std::iota(all.begin(), all.end(), std::uint32_t(0));
  Delaunay_flipper<NT>(t).flip_to_delaunay(std::vector<double>(), std::move(all), Flip_rule::EUCLIDEAN, on_flip);
  return true;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_DELAUNAY_FLIPPER_H
