// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_LENGTH_PREDICATES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_LENGTH_PREDICATES_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Exact_number.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

// Exact predicates on lengths (paper, Section 2: the triangle inequalities, Definition 2.1),
// and on scaled lengths, where the factors s_i = e^{u_i/2} are numbers too (paper, Eq. (2)):
//
//            k                        k
//           / \                      / \                     .
//        b /   \ a     s_k s_i l_ki /   \ s_j s_k l_jk       .
//         /     \                  /     \                   .
//        i-------j                i-------j
//            c                 s_i s_j l_ij
//
// All decide on the stored numbers, as real numbers: nothing is rounded, and nothing overflows or underflows.
//
// Number types: double, and those of which each value is a finite sum of doubles times a power of two:
// float, long double, Double_double, the binary floating-point numbers of Boost.Multiprecision, at any precision.
// Precondition of every function: the arguments are finite and not negative (NaN included: a
// caller refuses such input with a status, before).

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

/// certifies the sign of `a + b - c` from products `a, b, c >= 0` with relative errors of at most `16 * 2^-53`;
/// with those of the two additions the difference is off by less than `24 * 2^-53 (a + b + c)`, in any rounding mode.
/// \pre nothing in `a`, `b`, `c` has underflowed
/// \return whether the sign is certain, then written to `sign`
inline bool filtered_sign(double a, double b, double c, Sign& sign)
{
  const double difference = (a + b) - c, bound = 3.6e-15 * ((a + b) + c); // 3.6e-15 > 32 * 2^-53
  if(difference > bound)
    sign = POSITIVE;
  else if(difference < -bound)
    sign = NEGATIVE;
  else
    return false;
  return true;
}

// products of two such numbers are normal numbers
inline bool are_in_safe_range(double x, double y, double z)
{
  return x > 1e-150 && x < 1e150 && y > 1e-150 && y < 1e150 && z > 1e-150 && z < 1e150;
}

// divides all three by one power of two: the largest comes to lie in [1/2, 1)
inline void scale_by_power_of_two(double& x, double& y, double& z)
{
  int exponent = 0;
  std::frexp((std::max)(x, (std::max)(y, z)), &exponent);
  x = std::ldexp(x, -exponent);
  y = std::ldexp(y, -exponent);
  z = std::ldexp(z, -exponent);
}

// The sign of s_i s_j l_ij + s_k s_i l_ki - s_j s_k l_jk from arguments rounded to double
// (relative error at most 2^-52), if certain. Common powers of two do not matter. What is rounded to less than the
// normal range has lost digits.
inline bool filtered_scaled_sign(double s_i, double s_j, double s_k, double l_ij, double l_jk, double l_ki, Sign& sign)
{
  if(!((std::min)({s_i, s_j, s_k, l_ij, l_jk, l_ki}) >= (std::numeric_limits<double>::min)()))
    return false;
  for(int attempt = 0; attempt < 2; ++attempt)
  {
    const double ij = s_i * s_j, jk = s_j * s_k, ki = s_k * s_i;
    if(are_in_safe_range(ij, jk, ki) && are_in_safe_range(l_ij, l_jk, l_ki))
      return filtered_sign(ij * l_ij, ki * l_ki, jk * l_jk, sign);
    scale_by_power_of_two(s_i, s_j, s_k);
    scale_by_power_of_two(l_ij, l_jk, l_ki);
  }
  return false;
}

inline void count_failure(std::size_t* filter_failures)
{
  if(filter_failures != nullptr)
    ++*filter_failures;
}

/// the exact sign of `a + b - c`, for lengths or any numbers that are not negative;
/// for `double` without a single exact number, in every rounding mode
inline Sign triangle_inequality_sign(double a, double b, double c, std::size_t* = nullptr)
{
  a = double_double::opaque(a);
  b = double_double::opaque(b);
  c = double_double::opaque(c);
  if(a < b)
    std::swap(a, b);
  const double sum = a + b; // rounding is monotonic: a + b on one side of c stays there, or falls on c
  if(sum > c)
    return POSITIVE;
  if(sum < c)
    return NEGATIVE;
  const double rest = c - a; // exact, as c is a + b rounded and a >= b
  return b > rest ? POSITIVE : (b < rest ? NEGATIVE : ZERO);
}

/// the exact sign of `a + b - c`
/// \param filter_failures if given, is incremented when exact numbers were needed
template <typename NT>
Sign triangle_inequality_sign(const NT& a, const NT& b, const NT& c, std::size_t* filter_failures = nullptr)
{
  Sign sign;
  if(filtered_scaled_sign(1, 1, 1, static_cast<double>(a), static_cast<double>(c), static_cast<double>(b), sign))
    return sign;
  count_failure(filter_failures);
  return (exact_number(a) + exact_number(b) - exact_number(c)).sign();
}

/// whether `a`, `b`, `c` are the edge lengths of a triangle: all three inequalities hold strictly
template <typename NT>
bool is_triangle(const NT& a, const NT& b, const NT& c)
{
  return triangle_inequality_sign(a, b, c) == POSITIVE &&
         triangle_inequality_sign(b, c, a) == POSITIVE &&
         triangle_inequality_sign(c, a, b) == POSITIVE;
}

/// whether `a`, `b`, `c` are the edge lengths of a degenerate triangle: all three inequalities
/// hold, at least one with equality
template <typename NT>
bool is_degenerate_triangle(const NT& a, const NT& b, const NT& c)
{
  const Sign s = triangle_inequality_sign(a, b, c),
             t = triangle_inequality_sign(b, c, a),
             r = triangle_inequality_sign(c, a, b);
  return s != NEGATIVE && t != NEGATIVE && r != NEGATIVE && (s == ZERO || t == ZERO || r == ZERO);
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
    const Exact_number tolerated = exact_number(NT(4 * (std::numeric_limits<NT>::epsilon)())),
                       rest = exact_number(x) + exact_number(y) - exact_number(longest);
    return (rest + tolerated * exact_number(longest)).sign() != NEGATIVE;
  };
  return holds(a, b, c) && holds(b, c, a) && holds(c, a, b);
}

/// whether `c` is as long as `a` and `b` together, up to the rounding of lengths: by no more than 4 epsilon (8 * 2^-53) of itself shorter or
/// longer. Decided exactly
template <typename NT>
bool is_degenerate_up_to_rounding(const NT& a, const NT& b, const NT& c)
{
  const double sum = static_cast<double>(a) + static_cast<double>(b), longest = static_cast<double>(c);
  if(sum > (1 + 1e-14) * longest && sum < (std::numeric_limits<double>::max)())
    return false; // 1e-14 is more than 4 epsilon, and the rounding of both sides
  const Exact_number tolerated = exact_number(NT(4 * (std::numeric_limits<NT>::epsilon)())) * exact_number(c),
                     rest = exact_number(a) + exact_number(b) - exact_number(c);
  return (rest + tolerated).sign() != NEGATIVE && (tolerated - rest).sign() != NEGATIVE;
}

/// the exact sign of `s_i s_j l_ij + s_k s_i l_ki - s_j s_k l_jk`: whether the scaled edge opposite to vertex `i` is
/// shorter than (`POSITIVE`), as long as (`ZERO`) or longer than (`NEGATIVE`) the other two together
/// \param filter_failures if given, is incremented when exact numbers were needed
template <typename NT>
Sign scaled_triangle_inequality_sign(const NT& s_i, const NT& s_j, const NT& s_k,
                                     const NT& l_ij, const NT& l_jk, const NT& l_ki,
                                     std::size_t* filter_failures = nullptr)
{
  Sign sign;
  if(filtered_scaled_sign(static_cast<double>(s_i), static_cast<double>(s_j), static_cast<double>(s_k),
                          static_cast<double>(l_ij), static_cast<double>(l_jk), static_cast<double>(l_ki), sign))
    return sign;
  count_failure(filter_failures);
  const Exact_number i = exact_number(s_i), j = exact_number(s_j), k = exact_number(s_k);
  return (i * (j * exact_number(l_ij) + k * exact_number(l_ki)) - j * k * exact_number(l_jk)).sign();
}

/// whether the scaled lengths `s_i s_j l_ij`, `s_j s_k l_jk`, `s_k s_i l_ki` are those of a triangle
/// \param filter_failures if given, is increased by the number of signs for which exact numbers were needed
template <typename NT>
bool is_scaled_triangle(const NT& s_i, const NT& s_j, const NT& s_k,
                        const NT& l_ij, const NT& l_jk, const NT& l_ki,
                        std::size_t* filter_failures = nullptr)
{
  return scaled_triangle_inequality_sign(s_i, s_j, s_k, l_ij, l_jk, l_ki, filter_failures) == POSITIVE &&
         scaled_triangle_inequality_sign(s_j, s_k, s_i, l_jk, l_ki, l_ij, filter_failures) == POSITIVE &&
         scaled_triangle_inequality_sign(s_k, s_i, s_j, l_ki, l_ij, l_jk, filter_failures) == POSITIVE;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_LENGTH_PREDICATES_H
