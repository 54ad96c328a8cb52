// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Whether an edge is Delaunay, for lengths that are scaled by factors s_i = e^{u_i/2} at the vertices.
//
//              k              The edge ij is Delaunay iff cos(angle at k) + cos(angle at l) >= 0. Written with the scaled
//           b / \ a           lengths, and multiplied out, that is
//            /   \                                                                                       .
//           i--e--j             (a c + b d) (a d + b c)  >=  e^2 (a b + c d),
//            \   /
//           c \ / d           with equality iff the four vertices lie on a circle (Ptolemy's second theorem). All of it
//              l              is positive, so rounding costs a few units in the last place, and no triangle inequality
//                             is needed: for lengths that are merely positive it says "ideal Delaunay" (Penner).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_DELAUNAY_PREDICATE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_DELAUNAY_PREDICATE_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Exact_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/number_conversions.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

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

// Numbers are divided by 2^`exponent` and converted.
template <typename Convert>
struct Shifted_conversion
{
  const Convert& convert;
  int exponent;

  template <typename NT>
  auto operator()(const NT& x) const
  {
    using std::ldexp;
    return convert(NT(ldexp(x, -exponent)));
  }

  template <typename NT>
  auto operator()(const Scaled_number<NT>& x) const { return convert(Scaled_number<NT>(x.mantissa, x.exponent - exponent)); }
};

// The quadrilateral around the interior edge `e`, its lengths and factors converted; no factors: all are 1.
template <typename Real, typename NT, typename Scale, typename Convert_length, typename Convert_factor>
Quad<Real> converted_quad(const Intrinsic_triangulation<NT>& t, std::uint32_t e, const std::vector<Scale>& s,
                          const Convert_length& length, const Convert_factor& factor)
{
  const std::uint32_t h = t.edge_halfedge(e), g = t.twin(h);
  Quad<Real> q{length(t.length(e)), length(t.halfedge_length(t.next(h))), length(t.halfedge_length(t.previous(h))),
               length(t.halfedge_length(t.next(g))), length(t.halfedge_length(t.previous(g))),
               Real(1), Real(1), Real(1), Real(1)};
  if(!s.empty())
  {
    q.i = factor(s[t.origin(h)]);
    q.j = factor(s[t.target(h)]);
    q.k = factor(s[t.apex(h)]);
    q.l = factor(s[t.apex(g)]);
  }
  return q;
}

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

template <typename NT>
int binary_exponent(const Scaled_number<NT>& x) { return int(x.exponent); }

// The same with numbers out of the range of `Real`: of lengths, and of factors, the largest is brought near 1. Neither matters.
template <typename Real, typename NT, typename Scale, typename Convert>
CGAL_CONFORMAL_EQUIVALENCE_COLD
Quad<Real> shifted_quad(const Intrinsic_triangulation<NT>& t, std::uint32_t e, const std::vector<Scale>& s, const Convert& convert)
{
  int length = (std::numeric_limits<int>::min)(), factor = length;
  for(const std::uint32_t x : quad_edges(t, e))
    length = (std::max)(length, binary_exponent(t.length(x)));
  const std::uint32_t h = t.edge_halfedge(e);
  if(!s.empty())
    for(const std::uint32_t v : {t.origin(h), t.target(h), t.apex(h), t.apex(t.twin(h))})
      factor = (std::max)(factor, binary_exponent(s[v]));
  return converted_quad<Real>(t, e, s, Shifted_conversion<Convert>{convert, length}, Shifted_conversion<Convert>{convert, factor});
}

// The quadrilateral around the interior edge `e`, its numbers converted by `convert`; no factors: all are 1.
template <typename Real, typename NT, typename Scale, typename Convert>
Quad<Real> quad(const Intrinsic_triangulation<NT>& t, std::uint32_t e, const std::vector<Scale>& s, const Convert& convert)
{
  const Quad<Real> result = converted_quad<Real>(t, e, s, convert, convert);
  constexpr bool may_leave_range = !has_range_of_double<NT>() || !has_range_of_double<Scale>();
  if constexpr(may_leave_range && !std::is_same<Real, Exact_number>::value)
    return is_in_range(result, 1e-90) ? result : shifted_quad<Real>(t, e, s, convert);
  else
    return result;
}

// sides of numbers in this range, which have ten factors, neither over- nor underflow
template <typename Real>
bool is_in_filter_range(const Quad<Real>& q)
{
  return is_in_range(q, 1e-28);
}

// divides the lengths by one power of two, and the factors by another: neither matters
template <typename Real>
CGAL_CONFORMAL_EQUIVALENCE_COLD
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

// The two sides, divided by a common power of two, of numbers of which the ratio is beyond the range of the filter.
template <typename Real>
CGAL_CONFORMAL_EQUIVALENCE_COLD
std::pair<Real, Real> ptolemy_sides_by_exponents(const Quad<Scaled_number<Real> >& q)
{
  const std::pair<Scaled_number<Real>, Scaled_number<Real> > sides = ptolemy_sides(q);
  const std::int64_t larger = (std::max)(sides.first.exponent, sides.second.exponent);
  return std::make_pair(sides.first.scaled_down(larger), sides.second.scaled_down(larger));
}

template <typename Real>
CGAL_CONFORMAL_EQUIVALENCE_COLD
std::pair<Real, Real> ptolemy_sides_by_exponents(const Quad<Real>& q)
{
  typedef Scaled_number<Real> Number;
  return ptolemy_sides_by_exponents(Quad<Number>{Number(q.e), Number(q.a), Number(q.b), Number(q.c), Number(q.d),
                                                 Number(q.i), Number(q.j), Number(q.k), Number(q.l)});
}

// The relative difference (left - right) / (left + right) of the sides, as far as it is known.
struct Relative_difference
{
  double value, error;
};

// \return `false` if a number is none
template <typename Real>
bool filtered_difference(const std::pair<Real, Real>& sides, Relative_difference& difference)
{
  difference.value = static_cast<double>(Real((sides.first - sides.second) / (sides.first + sides.second)));
  difference.error = filter_error<Real>() + 1e-15 * std::fabs(difference.value);
  return std::isfinite(difference.value);
}

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
  return filtered_difference(is_near_one ? ptolemy_sides(scaled) : ptolemy_sides_by_exponents(q), difference);
}

// The same where no shift brings all numbers into the range of `double`: exact numbers that are so far apart would be long.
// \pre All numbers are positive.
inline bool filtered_difference(const Quad<Scaled_number<Double_double> >& q, Relative_difference& difference)
{
  return filtered_difference(ptolemy_sides_by_exponents(q), difference);
}

// the sign is exact, the value is rounded, never to 0
CGAL_CONFORMAL_EQUIVALENCE_COLD
inline Relative_difference exact_difference(const Quad<Exact_number>& q)
{
  const std::pair<Exact_number, Exact_number> sides = ptolemy_sides(q);
  const Exact_number difference = sides.first - sides.second;
  const Sign sign = difference.sign();
  double value = sign == ZERO ? 0. : quotient(difference, sides.first + sides.second);
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

template <typename NT>
bool is_positive_number(const Scaled_number<NT>& x) { return is_positive_number(x.mantissa); }

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

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_DELAUNAY_PREDICATE_H
