// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The exact sign of a sum of products of two `double`. It is all that predicates on points of the plane need where rounding
// cannot be excluded, and costs no number type of arbitrary length to compile.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_EXACT_PRODUCT_SUM_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_EXACT_PRODUCT_SUM_H

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A sum of products as a fixed-point number that is wide enough for all of them, subnormal numbers included: the digit d, of
// 32 bits, counts 2^(32 d - 2148) (U. Kulisch, "Computer Arithmetic and Validity", 2008, calls it a long accumulator). A digit may
// be negative or exceed its 32 bits before the carries are propagated, so that a billion products may be added.
class Exact_product_sum
{
  static constexpr int bits_of_digit_ = 32;
  static constexpr int least_exponent_ = -2 * 1074;  // a `double` is an integer times 2^-1074
  static constexpr std::size_t number_of_digits_ = 136; // the largest product is less than 2^2048, and there is room for sums
  static constexpr std::uint64_t digit_mask_ = (std::uint64_t(1) << bits_of_digit_) - 1;

  std::array<std::int64_t, number_of_digits_> digit_{};

public:
  // adds a * b; both must be finite
  void add_product(double a, double b)
  {
    int a_exponent = 0, b_exponent = 0;
    const std::int64_t sign = std::signbit(a) == std::signbit(b) ? 1 : -1;
    const std::uint64_t x = integer_mantissa(a, a_exponent), y = integer_mantissa(b, b_exponent);
    const int place = a_exponent + b_exponent - least_exponent_;
    const std::size_t first = std::size_t(place / bits_of_digit_);
    const int shift = place % bits_of_digit_;
    const std::uint64_t x_parts[2] = {x & digit_mask_, x >> bits_of_digit_}, y_parts[2] = {y & digit_mask_, y >> bits_of_digit_};
    for(std::size_t i = 0; i < 2; ++i)
      for(std::size_t j = 0; j < 2; ++j)
        add_shifted(x_parts[i] * y_parts[j], shift, first + i + j, sign);
  }

  void subtract_product(double a, double b) { add_product(-a, b); }

  // -1, 0 or 1
  int sign() const
  {
    std::array<std::int64_t, number_of_digits_> d = digit_;
    for(std::size_t i = 0; i + 1 < number_of_digits_; ++i)
    {
      const std::int64_t rest = std::int64_t(std::uint64_t(d[i]) & digit_mask_); // not negative
      d[i + 1] += (d[i] - rest) / (std::int64_t(1) << bits_of_digit_);
      d[i] = rest;
    }
    if(d.back() < 0)
      return -1;
    for(const std::int64_t digit : d)
      if(digit != 0)
        return 1;
    return 0;
  }

private:
  // |x| = result * 2^exponent, where the exponent is at least -1074
  static std::uint64_t integer_mantissa(double x, int& exponent)
  {
    const int digits = 53;
    const double fraction = std::frexp(std::abs(x), &exponent);
    exponent = exponent - digits < -1074 ? -1074 : exponent - digits;
    if(fraction == 0)
    {
      exponent = 0;
      return 0;
    }
    return std::uint64_t(std::ldexp(std::abs(x), -exponent));
  }

  // adds sign * value * 2^shift, counted in units of the given digit
  void add_shifted(std::uint64_t value, int shift, std::size_t digit, std::int64_t sign)
  {
    const std::uint64_t low = (value & digit_mask_) << shift, high = (value >> bits_of_digit_) << shift;
    digit_[digit] += sign * std::int64_t(low & digit_mask_);
    digit_[digit + 1] += sign * std::int64_t((low >> bits_of_digit_) + (high & digit_mask_));
    digit_[digit + 2] += sign * std::int64_t(high >> bits_of_digit_);
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_EXACT_PRODUCT_SUM_H
