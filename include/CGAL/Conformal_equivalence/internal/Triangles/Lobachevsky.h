// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_LOBACHEVSKY_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_LOBACHEVSKY_H

#include <CGAL/Conformal_equivalence/internal/Numbers/number_conversions.h>

#include <gmp.h>
#include <mpfr.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <type_traits>
#include <vector>

// Milnor's Lobachevsky function (paper, Appendix A),
//
//   L(x) = - int_0^x log |2 sin t| dt = Cl_2(2 x) / 2,
//
// odd and pi-periodic, needed for the value of the energy (paper, Eq. (7)).
// Integrating the product formula of the sine gives, with a_n = zeta(2n) / (n (2n+1)),
//
//   L(x)          = x (1 - log(2x) + sum_{n>=1} a_n (x/pi)^{2n}),               0 <= x < pi,
//   L(pi/2 - y)   = y (log 2       - sum_{n>=1} a_n (1 - 4^{-n}) (2y/pi)^{2n}),  |y| < pi/2.
//
// The first serves for x <= pi/3, the second for |y| <= pi/6: in both the terms fall by 1/9,
// and each factor x or y carries a zero of L, so that the error is relative near 0, pi/2 and pi.
// The argument is folded by x - k pi/2 with pi/2 in three parts, exactly as far as
// |x| < 2^20; beyond, the error of the fold is |x| times the unit of rounding.

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// pi / 2 in words of 32 bits, the integer part first, truncated.
inline std::vector<std::uint32_t> half_pi_in_words(std::size_t size)
{
  const mpfr_prec_t bits = 32 * static_cast<mpfr_prec_t>(size);
  mpfr_t pi;
  mpz_t integer; // pi / 2 times 2^(32 (size - 1))
  mpfr_init2(pi, bits + 64);
  mpz_init(integer);
  mpfr_const_pi(pi, MPFR_RNDN);
  mpfr_mul_2si(pi, pi, static_cast<long>(bits) - 33, MPFR_RNDN);
  mpfr_get_z(integer, pi, MPFR_RNDZ);
  std::vector<std::uint32_t> words(size, 0);
  mpz_export(words.data(), nullptr, 1, sizeof(std::uint32_t), 0, 0, integer); // the first word is 1: there are as many as there should be
  mpz_clear(integer);
  mpfr_clear(pi);
  return words;
}

// What the two series need, at the precision of a prototype: a number whose value does not matter.
template <typename NT>
struct Lobachevsky_constants
{
  NT log_2, two_over_pi;
  NT half_pi[3];                  // the sum is pi/2; the first two leave 20 bits or so for the factor k
  std::vector<NT> at_0, at_half_pi; // coefficients, [n-1] for n

  explicit Lobachevsky_constants(const NT& prototype)
    : log_2(prototype), two_over_pi(prototype), half_pi{prototype, prototype, prototype}
  {
    using std::log;
    const int p = precision_in_bits(prototype);
    log_2 = 2;
    log_2 = log(log_2);
    set_half_pi(p);
    two_over_pi = half_pi[1] + half_pi[2];
    two_over_pi += half_pi[0];
    two_over_pi = 1 / two_over_pi;
    set_coefficients(prototype, 3 + static_cast<std::size_t>(p * 0.31547)); // 1 / log_2(9)
  }

private:
  void set_half_pi(int p)
  {
    const std::size_t part = p < 84 ? 1 : static_cast<std::size_t>((p - 20) / 32),
                      rest = static_cast<std::size_t>(p / 32 + 2);
    const std::vector<std::uint32_t> words = half_pi_in_words(2 * part + rest + 2);
    set_to_words(half_pi[0], words, 0, part + 1);
    set_to_words(half_pi[1], words, part + 1, 2 * part + 1);
    set_to_words(half_pi[2], words, 2 * part + 1, 2 * part + 1 + rest);
  }

  static void set_to_words(NT& x, const std::vector<std::uint32_t>& words, std::size_t begin, std::size_t end)
  {
    using std::ldexp;
    x = 0;
    for(std::size_t i = begin; i < end; ++i)
    {
      x *= 4294967296.; // 2^32
      x += static_cast<double>(words[i]);
    }
    x = ldexp(x, -32 * static_cast<int>(end - 1));
  }

  // (n + 1/2) zeta(2n) = sum_{0<k<n} zeta(2k) zeta(2n-2k): Euler; all terms positive, hence stable
  void set_coefficients(const NT& prototype, std::size_t size)
  {
    using std::ldexp;
    std::vector<NT> zeta(size + 1, prototype); // [n] is zeta(2n)
    zeta[1] = 2 / (3 * two_over_pi * two_over_pi);
    for(std::size_t n = 2; n <= size; ++n)
    {
      NT& sum = zeta[n];
      sum = 0;
      for(std::size_t k = 1; 2 * k < n; ++k)
        sum += zeta[k] * zeta[n - k];
      sum *= 2;
      if(n % 2 == 0)
        sum += zeta[n / 2] * zeta[n / 2];
      sum *= 2;
      sum /= static_cast<int>(2 * n + 1);
    }
    at_0.assign(size, prototype);
    at_half_pi.assign(size, prototype);
    for(std::size_t n = 1; n <= size; ++n)
    {
      at_0[n - 1] = zeta[n] / static_cast<int>(n * (2 * n + 1));
      zeta[n] = ldexp(at_0[n - 1], -2 * static_cast<int>(n));
      at_half_pi[n - 1] = at_0[n - 1] - zeta[n];
    }
  }
};

template <>
struct Lobachevsky_constants<double>
{
  static constexpr double log_2 = 0x1.62e42fefa39efp-1, two_over_pi = 0x1.45f306dc9c883p-1;
  static constexpr double half_pi[3] = { 0x1.921fb544p+0, 0x1.0b4611a4p-34, 0x1.13198a2e03707p-65 };
  static constexpr double at_0[16] = {
    0x1.18bc4418cafe2p-1, 0x1.bb51d113fc074p-4, 0x1.8cdc55c932807p-5, 0x1.c8f77da9d22d3p-6,
    0x1.2a2feb4a0ffaep-6, 0x1.a434b8db670f1p-7, 0x1.381865e134066p-7, 0x1.e1e3c481839c8p-8,
    0x1.7f40bfb0e10ecp-8, 0x1.381394bacd39ap-8, 0x1.03091f5e3dd33p-8, 0x1.b4e81d037076dp-9,
    0x1.756cac7d73237p-9, 0x1.42d662717f6e2p-9, 0x1.19e011a2689bap-9, 0x1.f07c1f09b26cep-10 };
  static constexpr double at_half_pi[16] = {
    0x1.a51a6625307d3p-2, 0x1.9f9cb402bc46cp-4, 0x1.86a8e4720db67p-5, 0x1.c72e862c285b1p-6,
    0x1.29e55f4f3d76ep-6, 0x1.a41a758fd958ap-7, 0x1.3813857f9c819p-7, 0x1.e1e1e29dbf1b0p-8,
    0x1.7f405fe0b1229p-8, 0x1.3813813993edfp-8, 0x1.03091b521955bp-8, 0x1.b4e81b4e8859dp-9,
    0x1.756cac2017f85p-9, 0x1.42d6625d5207fp-9, 0x1.19e0119e011b6p-9, 0x1.f07c1f07c1f0cp-10 };
};

// sum_{n>=1} c_n t^n
template <typename NT, typename Coefficients>
NT series_without_constant(const Coefficients& c, const NT& t)
{
  auto i = std::end(c);
  NT sum(*--i);
  while(i != std::begin(c))
  {
    sum *= t;
    sum += *--i;
  }
  sum *= t;
  return sum;
}

// L(x) for 0 <= x <= pi/3
template <typename NT, typename Constants>
NT lobachevsky_near_0(const NT& x, const Constants& c)
{
  using std::log;
  if(x == 0)
    return x;
  NT t = x * c.two_over_pi;
  t *= t;
  t /= 4;
  NT result = x + x;
  result = log(result);
  result = 1 - result;
  result += series_without_constant(c.at_0, t);
  result *= x;
  return result;
}

// L(pi/2 - y) for |y| <= pi/6
template <typename NT, typename Constants>
NT lobachevsky_near_half_pi(const NT& y, const Constants& c)
{
  NT t = y * c.two_over_pi;
  t *= t;
  NT result = c.log_2 - series_without_constant(c.at_half_pi, t);
  result *= y;
  return result;
}

// L(x) for x >= 0
template <typename NT, typename Constants>
NT lobachevsky_of_nonnegative(const NT& x, const Constants& c)
{
  using std::abs;
  using std::floor;
  if(static_cast<double>(x) <= 0.78) // below pi/4: nothing to fold
    return lobachevsky_near_0(x, c);
  NT k = x * c.two_over_pi;
  k += 0.5;
  k = floor(k);
  NT r = x; // becomes x - k pi/2, in [-pi/4, pi/4]
  for(int i = 0; i < 3; ++i)
    r -= k * c.half_pi[i];
  k /= 2;
  const bool is_even = k == floor(k);
  const bool is_negative = r < 0;
  NT y = abs(r);
  if(is_even)
    y = lobachevsky_near_0(y, c);
  else
  {
    if(static_cast<double>(y) < 0.5236) // pi/6
      y = lobachevsky_near_half_pi(y, c);
    else
    {
      r = c.half_pi[0] - y;
      r += c.half_pi[1];
      r += c.half_pi[2];
      y = lobachevsky_near_0(r, c);
    }
  }
  if(is_even == is_negative)
    y = -y; // L(r - pi/2) = L(r + pi/2) = -L(pi/2 - r)
  return y;
}

/// Milnor's Lobachevsky function at a fixed precision: the constants are computed once, in
/// `O(p^2)` operations for `p` bits (at 1000 bits some milliseconds, then some hundredths of one a value).
/// For `double` there is nothing to compute.
///
/// \tparam NT `double`, `long double`, `Double_double` or a binary floating-point number of Boost.Multiprecision
///   of 53 bits or more, with fixed precision or one chosen at run time (`mpfr_float`: that of the prototype)
template <typename NT>
class Lobachevsky_function
{
  Lobachevsky_constants<NT> constants;

public:
  explicit Lobachevsky_function(const NT& prototype) : constants(make_constants(prototype)) {}

  /// \return the value at `x` (radians), with an error of a few units of rounding; NaN if `x` is not finite
  NT operator()(const NT& x) const
  {
    if(x < 0)
    {
      NT y = -x;
      y = lobachevsky_of_nonnegative(y, constants);
      return -y;
    }
    return lobachevsky_of_nonnegative(x, constants);
  }

private:
  static Lobachevsky_constants<NT> make_constants(const NT& prototype)
  {
    if constexpr(std::is_same<NT, double>::value)
      return Lobachevsky_constants<double>();
    else
      return Lobachevsky_constants<NT>(prototype);
  }
};

/// Milnor's Lobachevsky function of `x` (radians). For a type whose precision is chosen at run time
/// the constants are computed in every call: there, keep a `Lobachevsky_function`.
template <typename NT>
NT Lobachevsky(const NT& x)
{
  if constexpr(std::is_same<NT, float>::value)
    return static_cast<float>(Lobachevsky(static_cast<double>(x)));
  else if constexpr(std::is_same<NT, double>::value)
    return Lobachevsky_function<double>(x)(x);
  else if constexpr(std::numeric_limits<NT>::is_specialized)
  {
    static const Lobachevsky_function<NT> function(NT(1));
    return function(x);
  }
  else
    return Lobachevsky_function<NT>(x)(x);
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_LOBACHEVSKY_H
