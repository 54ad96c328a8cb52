// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Numbers with an exponent of their own, where products, quotients or areas may leave the range of a number type.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_SCALED_NUMBER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_SCALED_NUMBER_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The exponent of a number that is finite and not 0.
template <typename NT>
int binary_exponent(const NT& x)
{
  using std::frexp;
  int exponent = 0;
  if constexpr(std::numeric_limits<NT>::max_exponent > std::numeric_limits<double>::max_exponent)
    (void) frexp(x, &exponent);
  else
    (void) std::frexp(static_cast<double>(x), &exponent);
  return exponent;
}

// x 2^-exponent in [1/2, 1)
template <typename NT>
NT mantissa(const NT& x, int& exponent)
{
  using std::ldexp;
  exponent = binary_exponent(x);
  return ldexp(x, -exponent);
}

// The number `mantissa` 2^`exponent`. The mantissa is anything in the middle of its range, not always near 1.
template <typename NT>
struct Scaled_number
{
  NT mantissa;
  std::int64_t exponent;

  Scaled_number() : mantissa(0), exponent(0) {}
  Scaled_number(const NT& m, std::int64_t e) : mantissa(m), exponent(e) {}
  explicit Scaled_number(const NT& x)
  {
    int e = 0;
    mantissa = internal::mantissa(x, e);
    exponent = e;
  }

  // A product of ten mantissas in [1/2, 1) is at least 2^-10.
  friend Scaled_number operator*(const Scaled_number& x, const Scaled_number& y)
  {
    return Scaled_number(NT(x.mantissa * y.mantissa), x.exponent + y.exponent);
  }
  // For positive numbers: of the smaller one, what is below 2^-900 times the other is lost at most.
  friend Scaled_number operator+(const Scaled_number& x, const Scaled_number& y)
  {
    const std::int64_t larger = (std::max)(x.exponent, y.exponent);
    return Scaled_number(NT(x.scaled_down(larger) + y.scaled_down(larger)), larger);
  }

  // Products and quotients of any length: the mantissa remains near 1.
  Scaled_number& operator*=(const NT& x) { return append(x, 1); }
  Scaled_number& operator/=(const NT& x) { return append(x, -1); }

  /// the number, or what it over- or underflows to
  NT value() const { return scaled_to(0); }

  NT logarithm() const
  {
    using std::log;
    return log(mantissa) + NT(exponent) * log(NT(2));
  }

  /// the number, divided by 2^`e`
  NT scaled_to(std::int64_t e) const
  {
    using std::ldexp;
    const std::int64_t most = 1000000000;
    return ldexp(mantissa, int((std::max)(-most, (std::min)(most, exponent - e))));
  }

  /// the same for an `e` that is not less than the exponent; not quite down to zero
  NT scaled_down(std::int64_t e) const
  {
    using std::ldexp;
    return ldexp(mantissa, int((std::max)(exponent - e, std::int64_t(-950))));
  }

private:
  Scaled_number& append(const NT& x, int sign)
  {
    int e = 0;
    const NT m = internal::mantissa(x, e);
    if(sign > 0)
      mantissa *= m;
    else
      mantissa /= m;
    exponent += sign * e;
    normalize();
    return *this;
  }

  // brings the mantissa to [0.7, 1.4): powers of two alone
  void normalize()
  {
    for(; mantissa < NT(0.7) && mantissa > NT(0); --exponent)
      mantissa *= 2;
    for(; mantissa >= NT(1.4) && mantissa < NT(100); ++exponent)
      mantissa /= 2;
  }
};

// The vector 2^exponent * entries. (Residuals may be far below the range of `double`.)
struct Scaled_vector
{
  std::vector<double> entries;
  int exponent = 0;

  // infinity if there is anything that is no number
  double largest_entry() const
  {
    double result = 0;
    for(double x : entries)
      result = std::abs(x) <= (std::numeric_limits<double>::max)() ? (std::max)(result, std::abs(x))
                                                                  : std::numeric_limits<double>::infinity();
    return result;
  }

  void scale_to_one()
  {
    for(double& x : entries)
      x = std::ldexp(x, exponent);
    exponent = 0;
  }

  template <typename Wide>
  Wide largest() const
  {
    using std::ldexp;
    return Wide(ldexp(Wide(largest_entry()), exponent));
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_SCALED_NUMBER_H
