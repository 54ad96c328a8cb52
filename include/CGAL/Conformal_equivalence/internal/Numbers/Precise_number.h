// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Numbers of 1024 bits, some 300 digits, for the rare cases where lengths have to be computed again from the beginning. All
// operations are those of MPFR, rounded to nearest, by its interface for C: it costs next to nothing to compile.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_PRECISE_NUMBER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_PRECISE_NUMBER_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Exact_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Number_constants.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/number_conversions.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>

#include <mpfr.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Precise_number
{
public:
  static constexpr int number_of_bits = 1024;

  CGAL_CONFORMAL_EQUIVALENCE_COLD
  Precise_number(double x = 0)
  {
    mpfr_init2(x_, number_of_bits);
    mpfr_set_d(x_, x, MPFR_RNDN);
  }
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  explicit Precise_number(const Exact_number& x)
  {
    mpfr_init2(x_, number_of_bits);
    x.apply([this](mpz_srcptr m, long e) { mpfr_set_z_2exp(x_, m, e, MPFR_RNDN); });
  }
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  Precise_number(const Precise_number& x)
  {
    mpfr_init2(x_, number_of_bits);
    mpfr_set(x_, x.x_, MPFR_RNDN);
  }
  Precise_number& operator=(const Precise_number& x)
  {
    mpfr_set(x_, x.x_, MPFR_RNDN);
    return *this;
  }
  ~Precise_number() { mpfr_clear(x_); }

  explicit operator double() const { return mpfr_get_d(x_, MPFR_RNDN); }

  /// n such that the number is m 2^n with m in [1/2, 1); 0 for 0
  int exponent() const { return mpfr_zero_p(x_) != 0 ? 0 : static_cast<int>(mpfr_get_exp(x_)); }

  static Precise_number pi()
  {
    Precise_number result;
    mpfr_const_pi(result.x_, MPFR_RNDN);
    return result;
  }

  friend Precise_number operator-(const Precise_number& x)
  {
    Precise_number result(x);
    mpfr_neg(result.x_, result.x_, MPFR_RNDN);
    return result;
  }
  friend Precise_number operator+(const Precise_number& x, const Precise_number& y) { return result_of(mpfr_add, x, y); }
  friend Precise_number operator-(const Precise_number& x, const Precise_number& y) { return result_of(mpfr_sub, x, y); }
  friend Precise_number operator*(const Precise_number& x, const Precise_number& y) { return result_of(mpfr_mul, x, y); }
  friend Precise_number operator/(const Precise_number& x, const Precise_number& y) { return result_of(mpfr_div, x, y); }

  friend bool operator<(const Precise_number& x, const Precise_number& y) { return mpfr_less_p(x.x_, y.x_) != 0; }
  friend bool operator>(const Precise_number& x, const Precise_number& y) { return y < x; }
  friend bool operator==(const Precise_number& x, const Precise_number& y) { return mpfr_equal_p(x.x_, y.x_) != 0; }

  friend Precise_number abs(const Precise_number& x) { return mpfr_signbit(x.x_) != 0 ? -x : x; }
  friend Precise_number floor(const Precise_number& x)
  {
    Precise_number result;
    mpfr_floor(result.x_, x.x_);
    return result;
  }

  friend Precise_number sqrt(const Precise_number& x)
  {
    Precise_number result;
    mpfr_sqrt(result.x_, x.x_, MPFR_RNDN);
    return result;
  }
  friend Precise_number ldexp(const Precise_number& x, int n)
  {
    Precise_number result;
    mpfr_mul_2si(result.x_, x.x_, n, MPFR_RNDN);
    return result;
  }
  friend Precise_number frexp(const Precise_number& x, int* n)
  {
    *n = x.exponent();
    return ldexp(x, -*n);
  }

private:
  typedef int (*Operation)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

  CGAL_CONFORMAL_EQUIVALENCE_COLD
  static Precise_number result_of(Operation operation, const Precise_number& x, const Precise_number& y)
  {
    Precise_number result;
    operation(result.x_, x.x_, y.x_, MPFR_RNDN);
    return result;
  }

  mpfr_t x_;
};

template <>
struct Number_constants<Precise_number>
{
  static Precise_number pi() { return Precise_number::pi(); }
};

struct To_precise
{
  template <typename NT> Precise_number operator()(const NT& x) const { return Precise_number(exact_number(x)); }
};

// Doubles of which the sum is x, exactly, the largest first. \pre 1/2 <= |x| < 1
CGAL_CONFORMAL_EQUIVALENCE_COLD
inline std::vector<double> parts(Precise_number x)
{
  std::vector<double> result;
  for(double part = static_cast<double>(x); part != 0; part = static_cast<double>(x))
  {
    result.push_back(part);
    x = x - part;
  }
  return result;
}

template <typename NT>
struct From_precise
{
  // The smallest part comes first, so that only the last addition rounds by as much as half a unit.
  NT operator()(const Precise_number& x) const
  {
    using std::ldexp;
    const int exponent = x.exponent();
    NT result(0);
    const std::vector<double> p = parts(ldexp(x, -exponent));
    for(std::size_t n = p.size(); n > 0; --n)
      result += NT(p[n - 1]);
    return ldexp(result, exponent);
  }
};

template <>
struct From_precise<Double_double>
{
  Double_double operator()(const Precise_number& x) const { return To_double_double()(x); }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

namespace std {

template <>
class numeric_limits<CGAL::Conformal_equivalence::internal::Precise_number>
{
  typedef CGAL::Conformal_equivalence::internal::Precise_number Type;

public:
  static constexpr bool is_specialized = true, is_signed = true, is_integer = false, is_exact = false;
  static constexpr int radix = 2, digits = Type::number_of_bits, max_exponent = (numeric_limits<int>::max)();

  static Type epsilon() noexcept { return Type(0x1p-1023); }
};

} // namespace std

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_PRECISE_NUMBER_H
