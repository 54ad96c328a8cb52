// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Numbers m 2^e with an integer m of any size: every finite floating-point number is one, and so are sums, differences and
// products, without any rounding. Exact predicates need no more, and GMP's interface for C costs next to nothing to compile,
// unlike a whole type of rational numbers.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_EXACT_NUMBER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_EXACT_NUMBER_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>

#include <CGAL/enum.h>

#include <gmp.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Exact_number
{
public:
  Exact_number() { mpz_init(mantissa_); }
  /// the value of `x`, exactly. \pre `x` is finite
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  Exact_number(double x);
  /// `m` 2^`exponent`. \pre `m` is an integer
  Exact_number(double m, long exponent) : exponent_(exponent) { mpz_init_set_d(mantissa_, m); }
  Exact_number(const Exact_number& x) : exponent_(x.exponent_) { mpz_init_set(mantissa_, x.mantissa_); }
  Exact_number(Exact_number&& x) : exponent_(x.exponent_)
  {
    mpz_init(mantissa_);
    mpz_swap(mantissa_, x.mantissa_);
  }
  Exact_number& operator=(Exact_number x)
  {
    mpz_swap(mantissa_, x.mantissa_);
    exponent_ = x.exponent_;
    return *this;
  }
  ~Exact_number() { mpz_clear(mantissa_); }

  Sign sign() const { return static_cast<Sign>(mpz_sgn(mantissa_)); }

  friend Exact_number operator+(const Exact_number& x, const Exact_number& y) { return sum(x, y, mpz_add); }
  friend Exact_number operator-(const Exact_number& x, const Exact_number& y) { return sum(x, y, mpz_sub); }
  friend Exact_number operator*(const Exact_number& x, const Exact_number& y);
  friend Exact_number operator-(const Exact_number& x) { return Exact_number() - x; }

  Exact_number& operator+=(const Exact_number& y) { return *this = *this + y; }
  Exact_number& operator*=(const Exact_number& y) { return *this = *this * y; }

  friend bool operator==(const Exact_number& x, const Exact_number& y) { return (x - y).sign() == ZERO; }
  friend bool operator!=(const Exact_number& x, const Exact_number& y) { return !(x == y); }
  friend bool operator<(const Exact_number& x, const Exact_number& y) { return (x - y).sign() == NEGATIVE; }
  friend bool operator>(const Exact_number& x, const Exact_number& y) { return y < x; }
  friend bool operator<=(const Exact_number& x, const Exact_number& y) { return !(y < x); }
  friend bool operator>=(const Exact_number& x, const Exact_number& y) { return !(x < y); }

  /// `x / y`, truncated to 53 bits. \pre `y` is positive
  friend double quotient(const Exact_number& x, const Exact_number& y);

  /// gives `use(m, e)` the integer m, as `mpz_srcptr`, and the exponent.
  template <typename Use>
  void apply(const Use& use) const { use(mpz_srcptr(mantissa_), exponent_); }

private:
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  static Exact_number sum(const Exact_number& x, const Exact_number& y, void (*operation)(mpz_ptr, mpz_srcptr, mpz_srcptr));

  mpz_t mantissa_;
  long exponent_ = 0;
};

inline Exact_number::Exact_number(double x)
{
  int exponent = 0;
  mpz_init_set_d(mantissa_, std::ldexp(std::frexp(x, &exponent), 53));
  exponent_ = long(exponent) - 53;
}

// The operand with the larger exponent is shifted to the exponent of the other.
inline Exact_number Exact_number::sum(const Exact_number& x, const Exact_number& y, void (*operation)(mpz_ptr, mpz_srcptr, mpz_srcptr))
{
  if(mpz_sgn(y.mantissa_) == 0)
    return x;
  Exact_number result;
  const bool x_is_coarser = x.exponent_ > y.exponent_ && mpz_sgn(x.mantissa_) != 0;
  const Exact_number& coarser = x_is_coarser ? x : y;
  result.exponent_ = mpz_sgn(x.mantissa_) == 0 ? y.exponent_ : (std::min)(x.exponent_, y.exponent_);
  mpz_mul_2exp(result.mantissa_, coarser.mantissa_, static_cast<mp_bitcnt_t>(coarser.exponent_ - result.exponent_));
  if(x_is_coarser)
    operation(result.mantissa_, result.mantissa_, y.mantissa_);
  else
    operation(result.mantissa_, x.mantissa_, result.mantissa_);
  return result;
}

CGAL_CONFORMAL_EQUIVALENCE_COLD
inline Exact_number operator*(const Exact_number& x, const Exact_number& y)
{
  Exact_number result;
  mpz_mul(result.mantissa_, x.mantissa_, y.mantissa_);
  result.exponent_ = x.exponent_ + y.exponent_;
  return result;
}

CGAL_CONFORMAL_EQUIVALENCE_COLD
inline double quotient(const Exact_number& x, const Exact_number& y)
{
  // the numerator is shifted such that the integer quotient has 64 bits or more, of which 53 remain
  const long shift = 64 + static_cast<long>(mpz_sizeinbase(y.mantissa_, 2)) - static_cast<long>(mpz_sizeinbase(x.mantissa_, 2));
  Exact_number ratio(x);
  if(shift > 0)
    mpz_mul_2exp(ratio.mantissa_, x.mantissa_, static_cast<mp_bitcnt_t>(shift));
  mpz_tdiv_q(ratio.mantissa_, ratio.mantissa_, y.mantissa_);
  long exponent = 0;
  const double m = mpz_get_d_2exp(&exponent, ratio.mantissa_);
  exponent += x.exponent_ - y.exponent_ - (std::max)(shift, 0L);
  return std::ldexp(m, static_cast<int>((std::max)(-5000L, (std::min)(5000L, exponent))));
}

/// the value of `x`, exactly. \pre `x` is finite
inline Exact_number exact_number(double x) { return Exact_number(x); }
inline Exact_number exact_number(const Double_double& x) { return Exact_number(x.hi) + Exact_number(x.lo); }

/// the value of `x`, exactly: `x = 2^e (d_1 + d_2 + ...)` with doubles `d_i`. \pre `x` is finite
template <typename NT>
Exact_number exact_number(const NT& x)
{
  static_assert(!std::is_integral<NT>::value, "lengths are floating-point numbers");
  using std::frexp;
  using std::ldexp;
  int exponent = 0;
  NT rest = frexp(x, &exponent);
  Exact_number result;
  for(long e = long(exponent) - 32; rest != 0; e -= 32)
  {
    const NT scaled = ldexp(rest, 32);
    const double piece = std::trunc(static_cast<double>(scaled)); // below 2^33: taken off without error
    rest = scaled - piece;
    result += Exact_number(piece, e);
  }
  return result;
}

template <typename NT>
Exact_number exact_number(const Scaled_number<NT>& x) { return exact_number(x.mantissa) * Exact_number(1, long(x.exponent)); }

struct To_exact
{
  template <typename NT> Exact_number operator()(const NT& x) const { return exact_number(x); }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_EXACT_NUMBER_H
