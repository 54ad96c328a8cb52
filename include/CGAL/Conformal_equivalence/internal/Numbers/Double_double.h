// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_DOUBLE_DOUBLE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_DOUBLE_DOUBLE_H

#include <cmath>
#include <limits>
#include <type_traits>

// A number held as the unevaluated sum hi + lo of two doubles with
// hi = fl(hi + lo): about 106 bits with the exponent range of double. It carries
// the last residual of the solver and the layout (log scale factors, 2 pi).
//
// Algorithms and bounds, relative to the exact result, with u = 2^-53:
//   +, -          3 u^2 (1 + 4u)     with a double  2 u^2
//   *             7 u^2              with a double  2 u^2
//   /            15 u^2 + 56 u^3     with a double  3 u^2
//   sqrt       25/8 u^2
//   exp, log    1e-30 (exp: of the result, for the stored argument)
// Joldes, Muller and Popescu, "Tight and rigorous error bounds for basic building
// blocks of double-word arithmetic", ACM TOMS 44(2), 2017; for sqrt: Lefevre,
// Louvet, Muller, Picot and Rideau, ACM TOMS 49(1), 2023.
//
// They hold in rounding to nearest, without `-ffast-math`, as long as nothing
// overflows and no operand or product is below 2^-969 (about 1e-292). Below, the
// error is absolute, some 2^-1074. A result beyond the range of double, and a
// division by zero, is not finite: it is an infinity or a NaN.
//
// With a hardware fma the compiler may contract a*b + c; the additions below take
// their operands through `opaque()`, so that they are the additions written here.

#if defined(__FMA__) || defined(__FMA4__) || defined(__FP_FAST_FMA) || defined(FP_FAST_FMA) || \
    defined(__aarch64__) || (defined(_MSC_VER) && (defined(__AVX2__) || defined(_M_ARM64)))
#  define CGAL_CONFORMAL_EQUIVALENCE_HARDWARE_FMA
#endif

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {
namespace double_double { // of its own, so that its sqrt, log, ... are found by argument-dependent lookup alone

// The value x, of which the compiler forgets how it was computed.
inline double opaque(double x)
{
#if !defined(CGAL_CONFORMAL_EQUIVALENCE_HARDWARE_FMA)
  return x;
#elif defined(__GNUC__) && defined(__SSE2__)
  __asm__("" : "+x"(x));
  return x;
#elif defined(__GNUC__) && defined(__aarch64__)
  __asm__("" : "+w"(x));
  return x;
#else
  volatile double y = x;
  return y;
#endif
}

struct Double_double
{
  double hi, lo;

  constexpr Double_double() : hi(0), lo(0) {}
  constexpr Double_double(double x) : hi(x), lo(0) {}

  /// \pre `h == fl(h + l)`
  constexpr Double_double(double h, double l) : hi(h), lo(l) {}

  /// exact for every integer type, 64 bits included
  template <typename Integer, typename = std::enable_if_t<std::is_integral<Integer>::value>>
  Double_double(Integer i) : hi(static_cast<double>(i)), lo(0)
  {
    if constexpr(sizeof(Integer) > 4)
    {
      const long long base = 1LL << 32;
      const double upper = static_cast<double>(base) * static_cast<double>(i / static_cast<Integer>(base)),
                   lower = static_cast<double>(i % static_cast<Integer>(base));
      hi = upper + lower;
      lo = lower - (hi - upper);
    }
  }

  /// exact for the 64-bit significand of x87, to 106 bits otherwise
  explicit Double_double(long double x) : hi(static_cast<double>(x)), lo(0)
  {
    if(std::isfinite(hi))
      lo = static_cast<double>(x - static_cast<long double>(hi));
  }

  explicit operator double() const { return hi; }
  explicit operator long double() const
  { return static_cast<long double>(hi) + static_cast<long double>(lo); }

  Double_double& operator+=(const Double_double& y);
  Double_double& operator-=(const Double_double& y);
  Double_double& operator*=(const Double_double& y);
  Double_double& operator/=(const Double_double& y);
};

// Error-free transformations: the pair is the exact sum or product.

inline Double_double two_sum(double a, double b)
{
  a = opaque(a);
  b = opaque(b);
  const double s = a + b;
  const double bb = s - a;
  return Double_double(s, (a - (s - bb)) + (b - bb));
}

/// \pre `a == 0 || |a| >= |b|`, or the exponent of `a` is not below that of `b`
inline Double_double quick_two_sum(double a, double b)
{
  a = opaque(a);
  b = opaque(b);
  const double s = a + b;
  return Double_double(s, b - (s - a));
}

#if defined(CGAL_CONFORMAL_EQUIVALENCE_HARDWARE_FMA)

inline Double_double two_prod(double a, double b)
{
  const double p = opaque(a * b);
  return Double_double(p, std::fma(a, b, -p));
}

#else

// Veltkamp: a as the sum of two numbers of at most 26 bits
inline void split(double a, double& upper, double& lower)
{
  const bool is_huge = std::fabs(a) > 6.696928794914171e299; // 2^996: the product below would overflow
  const double b = is_huge ? a * 3.7252902984619140625e-09 : a; // 2^-28
  const double c = 134217729. * b; // 2^27 + 1
  upper = c - (c - b);
  lower = b - upper;
  if(is_huge)
  {
    upper *= 268435456.; // 2^28
    lower *= 268435456.;
  }
}

// Dekker
inline Double_double two_prod(double a, double b)
{
  const double p = a * b;
  double a1, a2, b1, b2;
  split(a, a1, a2);
  split(b, b1, b2);
  return Double_double(p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2);
}

#endif

inline Double_double operator+(const Double_double& x) { return x; }
inline Double_double operator-(const Double_double& x) { return Double_double(-x.hi, -x.lo); }

inline Double_double operator+(const Double_double& x, const Double_double& y)
{
  const Double_double s = two_sum(x.hi, y.hi), t = two_sum(x.lo, y.lo);
  const Double_double v = quick_two_sum(s.hi, s.lo + t.hi);
  return quick_two_sum(v.hi, t.lo + v.lo);
}

inline Double_double operator+(const Double_double& x, double y)
{
  const Double_double s = two_sum(x.hi, y);
  return quick_two_sum(s.hi, x.lo + s.lo);
}

inline Double_double operator+(double x, const Double_double& y) { return y + x; }
inline Double_double operator-(const Double_double& x, const Double_double& y) { return x + (-y); }
inline Double_double operator-(const Double_double& x, double y) { return x + (-y); }
inline Double_double operator-(double x, const Double_double& y) { return (-y) + x; }

inline Double_double operator*(const Double_double& x, const Double_double& y)
{
  const Double_double p = two_prod(x.hi, y.hi);
  return quick_two_sum(p.hi, p.lo + (x.hi * y.lo + x.lo * y.hi));
}

inline Double_double operator*(const Double_double& x, double y)
{
  const Double_double p = two_prod(x.hi, y);
  const Double_double t = quick_two_sum(p.hi, x.lo * y);
  return quick_two_sum(t.hi, t.lo + p.lo);
}

inline Double_double operator*(double x, const Double_double& y) { return y * x; }

inline Double_double operator/(const Double_double& x, const Double_double& y)
{
  const double q = x.hi / y.hi;
  const Double_double r = y * q;
  const double remainder = (x.hi - r.hi) + (x.lo - r.lo);
  return quick_two_sum(q, remainder / y.hi);
}

inline Double_double operator/(const Double_double& x, double y)
{
  const double q = x.hi / y;
  const Double_double r = two_prod(q, y);
  const double remainder = ((x.hi - r.hi) - r.lo) + x.lo;
  return quick_two_sum(q, remainder / y);
}

inline Double_double operator/(double x, const Double_double& y) { return Double_double(x) / y; }

inline Double_double& Double_double::operator+=(const Double_double& y) { return *this = *this + y; }
inline Double_double& Double_double::operator-=(const Double_double& y) { return *this = *this - y; }
inline Double_double& Double_double::operator*=(const Double_double& y) { return *this = *this * y; }
inline Double_double& Double_double::operator/=(const Double_double& y) { return *this = *this / y; }

// hi = fl(hi + lo) makes the pair unique and the order lexicographic.
inline bool operator==(const Double_double& x, const Double_double& y) { return x.hi == y.hi && x.lo == y.lo; }
inline bool operator!=(const Double_double& x, const Double_double& y) { return !(x == y); }
inline bool operator<(const Double_double& x, const Double_double& y)
{ return x.hi < y.hi || (x.hi == y.hi && x.lo < y.lo); }
inline bool operator<=(const Double_double& x, const Double_double& y)
{ return x.hi < y.hi || (x.hi == y.hi && x.lo <= y.lo); }
inline bool operator>(const Double_double& x, const Double_double& y) { return y < x; }
inline bool operator>=(const Double_double& x, const Double_double& y) { return y <= x; }

inline double to_double(const Double_double& x) { return x.hi; }
inline bool isfinite(const Double_double& x) { return std::isfinite(x.hi) && std::isfinite(x.lo); }
inline bool isnan(const Double_double& x) { return std::isnan(x.hi) || std::isnan(x.lo); }
inline Double_double abs(const Double_double& x) { return x.hi < 0 ? -x : x; }
inline Double_double fabs(const Double_double& x) { return abs(x); }
inline Double_double ldexp(const Double_double& x, int n)
{ return Double_double(std::ldexp(x.hi, n), std::ldexp(x.lo, n)); }

inline Double_double floor(const Double_double& x)
{
  const double f = std::floor(x.hi);
  return f == x.hi ? quick_two_sum(f, std::floor(x.lo)) : Double_double(f);
}

inline Double_double sqrt(const Double_double& x)
{
  if(!(x.hi > 0) || !std::isfinite(x.hi))
    return Double_double(std::sqrt(x.hi)); // 0, NaN, infinity
  const double s = std::sqrt(x.hi);
  const Double_double p = two_prod(s, s);
  const double remainder = ((x.hi - p.hi) - p.lo) + x.lo;
  return quick_two_sum(s, remainder / (2 * s));
}

/// `exp(x) - 1` with relative error below 1e-30 for `|x| <= 0.4`:
/// Taylor's series at `x / 512`, then nine times `(1 + y)^2 - 1 = y (2 + y)`.
inline Double_double expm1_of_small(const Double_double& x)
{
  const Double_double r = ldexp(x, -9); // |r| < 7.9e-4: the first term left out is below 1e-32 r
  Double_double sum(1);
  for(int n = 9; n > 1; --n)
    sum = 1. + sum * r / static_cast<double>(n);
  Double_double y = sum * r;
  for(int i = 0; i < 9; ++i)
    y = y * (2. + y);
  return y;
}

/// `x - k log 2` for an integer `|k| <= 2048`: the first two parts of log 2 have 40 bits, their products are exact.
inline Double_double minus_multiple_of_log_2(const Double_double& x, double k)
{
  return ((x - k * 0x1.62e42fefa4p-1) + k * 0x1.8432a1b0e2p-43) + k * 0x1.8cff81a12a17ep-85;
}

inline Double_double exp(const Double_double& x)
{
  if(!(std::fabs(x.hi) < 744))
    return Double_double(std::exp(x.hi)); // infinity, zero, NaN
  const double k = std::floor(x.hi * 1.4426950408889634 + .5);
  return ldexp(1. + expm1_of_small(minus_multiple_of_log_2(x, k)), static_cast<int>(k));
}

/// relative error below 1e-30, also near 1; one step of Newton's method for `exp(y) = m`, of order 3, from the double
/// logarithm, where `x = 2^k m` and `m` is near 1
inline Double_double log(const Double_double& x)
{
  if(!(x.hi > 0) || !std::isfinite(x.hi))
    return Double_double(std::log(x.hi)); // minus infinity, NaN, infinity
  int k;
  if(std::frexp(x.hi, &k) < .70710678118654752)
    --k;
  const Double_double m_1 = ldexp(x, -k) - 1.;
  const double y = std::log1p(m_1.hi);
  const Double_double e = expm1_of_small(y);
  const Double_double t = (m_1 - e) / (1. + e);
  return minus_multiple_of_log_2(y + t * (1. - t.hi / 2), -k);
}

} // namespace double_double

using double_double::Double_double;
using double_double::two_sum;
using double_double::quick_two_sum;
using double_double::two_prod;

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

namespace std {

template <>
class numeric_limits<CGAL::Conformal_equivalence::internal::Double_double>
{
  typedef CGAL::Conformal_equivalence::internal::Double_double Type;
  typedef numeric_limits<double> Base;

public:
  static constexpr bool is_specialized = true, is_signed = true, is_integer = false, is_exact = false,
                        is_bounded = true, is_modulo = false, is_iec559 = false,
                        has_infinity = true, has_quiet_NaN = true, has_signaling_NaN = false,
                        has_denorm_loss = false, traps = false, tinyness_before = false;
  static constexpr float_denorm_style has_denorm = denorm_absent;
  static constexpr float_round_style round_style = round_indeterminate;
  static constexpr int radix = 2, digits = 105, digits10 = 31, max_digits10 = 33,
                       min_exponent = Base::min_exponent + 53, max_exponent = Base::max_exponent,
                       min_exponent10 = -291, max_exponent10 = Base::max_exponent10;

  static constexpr Type (min)() noexcept { return Type(0x1p-969); } // from here on all 106 bits are there
  static constexpr Type (max)() noexcept { return Type((Base::max)(), 0x1.fffffffffffffp+969); }
  static constexpr Type lowest() noexcept { return Type(Base::lowest(), -0x1.fffffffffffffp+969); }
  static constexpr Type epsilon() noexcept { return Type(0x1p-104); } // 4 u^2
  static constexpr Type round_error() noexcept { return Type(1.); }
  static constexpr Type infinity() noexcept { return Type(Base::infinity()); }
  static constexpr Type quiet_NaN() noexcept { return Type(Base::quiet_NaN()); }
  static constexpr Type signaling_NaN() noexcept { return Type(0.); }
  static constexpr Type denorm_min() noexcept { return (min)(); }
};

} // namespace std

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_DOUBLE_DOUBLE_H
