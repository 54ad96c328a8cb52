// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Isometries of the hyperbolic plane and points of the unit disk in rational numbers. An isometry is a matrix of integers without a common factor,
// up to sign, and of positive determinant: an element of PGL(2, Q), as it acts on the upper half plane; on the disk it acts as its conjugate by
// the Cayley map z -> (z - i) / (z + i), which has Gaussian integers.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_EXACT_ISOMETRY_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_EXACT_ISOMETRY_H

#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Isometry.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/words.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Precise_number.h>

#include <CGAL/Exact_rational.h>
#include <CGAL/Fraction_traits.h>
#include <CGAL/number_utils.h>

#include <array>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

typedef Exact_rational Rational;
typedef CGAL::Fraction_traits<Rational>::Numerator_type Rational_numerator;

inline Rational_numerator greatest_common_divisor(const Rational_numerator& x, const Rational_numerator& y)
{
  if(x == 0)
    return CGAL::abs(y);
  return y == 0 ? Rational_numerator(CGAL::abs(x)) : Rational_numerator(CGAL::abs(CGAL::gcd(x, y)));
}

// x / y. \pre y is not 0
inline Rational exact_quotient(const Rational_numerator& x, const Rational_numerator& y)
{
  return CGAL::Fraction_traits<Rational>::Compose()(x, y);
}

// x / y, rounded. \pre y is not 0
inline double rounded_quotient(const Rational_numerator& x, const Rational_numerator& y) { return CGAL::to_double(exact_quotient(x, y)); }

// The sum of integers, all of which are held by numbers of type `double`.
template <typename Numbers>
Rational_numerator sum_of_integers(const Numbers& numbers)
{
  Rational sum(0);
  for(double x : numbers)
    sum += Rational(x);
  Rational_numerator numerator;
  CGAL::Fraction_traits<Rational>::Denominator_type denominator;
  CGAL::Fraction_traits<Rational>::Decompose()(sum, numerator, denominator);
  return numerator;
}

// The integer next to 2^bits x.
inline Rational_numerator scaled_integer(const Double_double& x, int bits)
{
  const Double_double n = floor(ldexp(x, bits) + 0.5);
  return sum_of_integers(std::array<double, 2>{{n.hi, n.lo}});
}

// The same. \pre it is below 2^1024
inline Rational_numerator scaled_integer(const Precise_number& x, int bits) { return sum_of_integers(parts(floor(ldexp(x, bits) + 0.5))); }

// re + i im
struct Gaussian_integer
{
  Rational_numerator re, im;

  friend Gaussian_integer operator+(const Gaussian_integer& x, const Gaussian_integer& y)
  {
    return {Rational_numerator(x.re + y.re), Rational_numerator(x.im + y.im)};
  }
  friend Gaussian_integer operator*(const Gaussian_integer& x, const Gaussian_integer& y)
  {
    return {Rational_numerator(x.re * y.re - x.im * y.im), Rational_numerator(x.re * y.im + x.im * y.re)};
  }
  friend Gaussian_integer operator*(const Rational_numerator& t, const Gaussian_integer& x)
  {
    return {Rational_numerator(t * x.re), Rational_numerator(t * x.im)};
  }
  friend Gaussian_integer operator-(const Gaussian_integer& x) { return {Rational_numerator(-x.re), Rational_numerator(-x.im)}; }
  friend Gaussian_integer conj(const Gaussian_integer& x) { return {x.re, Rational_numerator(-x.im)}; }
  friend Rational_numerator square_norm(const Gaussian_integer& x) { return x.re * x.re + x.im * x.im; }
};

// The point n / d of the unit disk, d > 0.
struct Exact_disk_point
{
  Gaussian_integer n;
  Rational_numerator d;

  std::array<Rational, 2> coordinates() const
  {
    return {{exact_quotient(n.re, d), exact_quotient(n.im, d)}};
  }

  // d^2 - |n|^2, positive
  Rational_numerator depth() const { return d * d - square_norm(n); }
};

// d_p d_q - n_p conj(n_q): a multiple of 1 - p conj(q)
inline Gaussian_integer polar_product(const Exact_disk_point& p, const Exact_disk_point& q)
{
  return Gaussian_integer{Rational_numerator(p.d * q.d), Rational_numerator(0)} + -(p.n * conj(q.n));
}

// The product of (1 - p conj(q)) around a triangle: its argument is half of the signed area. The triangle is counterclockwise iff the imaginary
// part is positive.
inline Gaussian_integer half_area_vector(const Exact_disk_point& p, const Exact_disk_point& q, const Exact_disk_point& r)
{
  return polar_product(p, q) * polar_product(q, r) * polar_product(r, p);
}

// sinh(l/2) of the distance l
inline double half_sinh_of_distance(const Exact_disk_point& p, const Exact_disk_point& q)
{
  const Gaussian_integer difference = q.d * p.n + -(p.d * q.n);
  return std::sqrt(rounded_quotient(square_norm(difference), Rational_numerator(p.depth() * q.depth())));
}

struct Exact_isometry
{
  Rational_numerator p, q, r, s; // z -> (p z + q) / (r z + s)

  static Exact_isometry identity() { return {Rational_numerator(1), Rational_numerator(0), Rational_numerator(0), Rational_numerator(1)}; }

  // Near to an isometry of the disk.
  template <typename Wide>
  static Exact_isometry rounded(const Isometry<Wide>& m, int bits)
  {
    return {scaled_integer(m.a.re + m.b.re, bits), scaled_integer(m.a.im - m.b.im, bits), scaled_integer(-m.a.im - m.b.im, bits),
            scaled_integer(m.a.re - m.b.re, bits)};
  }

  // The product of the matrices as they are.
  friend Exact_isometry matrix_product(const Exact_isometry& x, const Exact_isometry& y)
  {
    return {Rational_numerator(x.p * y.p + x.q * y.r), Rational_numerator(x.p * y.q + x.q * y.s),
            Rational_numerator(x.r * y.p + x.s * y.r), Rational_numerator(x.r * y.q + x.s * y.s)};
  }

  friend Exact_isometry operator*(const Exact_isometry& x, const Exact_isometry& y) { return matrix_product(x, y).reduced(); }

  // The adjugate: the inverse, times the determinant.
  Exact_isometry inverse() const { return {s, Rational_numerator(-q), Rational_numerator(-r), p}; }

  Rational_numerator determinant() const { return p * s - q * r; }
  bool is_identity() const { return p == s && q == 0 && r == 0 && !(p == 0); }

  Exact_isometry reduced() const
  {
    const Rational_numerator common = greatest_common_divisor(greatest_common_divisor(p, q), greatest_common_divisor(r, s));
    if(common == 0 || common == 1)
      return *this;
    return {CGAL::integral_division(p, common), CGAL::integral_division(q, common), CGAL::integral_division(r, common),
            CGAL::integral_division(s, common)};
  }

  // On the disk it is z -> (a z + b) / (conj(b) z + conj(a)).
  Gaussian_integer a() const { return {Rational_numerator(p + s), Rational_numerator(q - r)}; }
  Gaussian_integer b() const { return {Rational_numerator(p - s), Rational_numerator(-q - r)}; }

  Exact_disk_point operator()(const Exact_disk_point& z) const
  {
    const Gaussian_integer a = this->a(), b = this->b();
    const Gaussian_integer divisor = conj(b) * z.n + z.d * conj(a), n = (a * z.n + z.d * b) * conj(divisor);
    const Rational_numerator d = square_norm(divisor), common = greatest_common_divisor(d, greatest_common_divisor(n.re, n.im));
    return {{CGAL::integral_division(n.re, common), CGAL::integral_division(n.im, common)}, CGAL::integral_division(d, common)};
  }
};

// The product of the letters from `first` to `last` as matrices, half by half: so that nearly all factors are short.
inline Exact_isometry matrix_product_of_letters(const Word& w, std::size_t first, std::size_t last, const Letter_values<Exact_isometry>& values)
{
  if(first == last)
    return values.identity();
  if(last - first == 1)
    return values[w[first]];
  const std::size_t middle = first + (last - first) / 2;
  return matrix_product(matrix_product_of_letters(w, first, middle, values), matrix_product_of_letters(w, middle, last, values));
}

// The same as one after the other, with a single search for a common factor.
inline Exact_isometry product_of_letters(const Word& w, const Letter_values<Exact_isometry>& values)
{
  return matrix_product_of_letters(w, 0, w.size(), values).reduced();
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_EXACT_ISOMETRY_H
