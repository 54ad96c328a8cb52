// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Conversions of numbers, as function objects, and what number types are like.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_NUMBER_CONVERSIONS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_NUMBER_CONVERSIONS_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>

#include <limits>
#include <type_traits>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

struct To_double
{
  template <typename NT> double operator()(const NT& x) const { return static_cast<double>(x); }
  double operator()(const Scaled_number<double>& x) const { return x.value(); }
};

struct To_double_double
{
  Double_double operator()(double x) const { return x; }
  const Double_double& operator()(const Double_double& x) const { return x; }
  Double_double operator()(const Scaled_number<double>& x) const { return x.value(); }
  template <typename NT>
  Double_double operator()(const NT& x) const
  {
    const double hi = static_cast<double>(x);
    return two_sum(hi, static_cast<double>(NT(x - NT(hi))));
  }
};

// A number of any range, with its exponent apart.
struct To_scaled
{
  template <typename NT>
  Scaled_number<Double_double> operator()(const NT& x) const
  {
    int exponent = 0;
    const NT m = mantissa(x, exponent);
    return Scaled_number<Double_double>(To_double_double()(m), exponent);
  }
  Scaled_number<Double_double> operator()(const Scaled_number<double>& x) const
  {
    return Scaled_number<Double_double>(Double_double(x.mantissa), x.exponent);
  }
};

template <typename NT> struct has_exponent_apart : std::false_type {};
template <typename NT> struct has_exponent_apart<Scaled_number<NT> > : std::true_type {};

// whether numbers have the range of `double`
template <typename NT>
constexpr bool has_range_of_double()
{
  return std::numeric_limits<NT>::max_exponent <= std::numeric_limits<double>::max_exponent && !has_exponent_apart<NT>::value;
}

// The bits of the significand of NT; found by trial where the type does not tell (precision chosen at run time).
template <typename NT>
int precision_in_bits(const NT& prototype)
{
  if constexpr(std::numeric_limits<NT>::is_specialized)
    return std::numeric_limits<NT>::digits;
  else
  {
    NT one(prototype), ulp(prototype), sum(prototype);
    one = 1;
    ulp = 1;
    int bits = 0;
    do
    {
      ++bits;
      ulp /= 2;
      sum = one + ulp;
    }
    while(sum != one);
    return bits;
  }
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_NUMBER_CONVERSIONS_H
