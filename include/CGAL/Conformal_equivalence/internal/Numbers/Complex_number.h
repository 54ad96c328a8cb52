// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_COMPLEX_NUMBER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_COMPLEX_NUMBER_H

#include <CGAL/Conformal_equivalence/internal/cold_code.h>

#include <cmath>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A complex number; unlike std::complex defined for every number type, and without its care for infinite parts.
template <typename NT>
struct Complex_number
{
  NT re, im;

  friend Complex_number operator-(const Complex_number& x) { return {-x.re, -x.im}; }
  friend Complex_number operator+(const Complex_number& x, const Complex_number& y) { return {x.re + y.re, x.im + y.im}; }
  friend Complex_number operator-(const Complex_number& x, const Complex_number& y) { return {x.re - y.re, x.im - y.im}; }
  friend Complex_number operator*(const NT& t, const Complex_number& x) { return {t * x.re, t * x.im}; }
  friend Complex_number operator*(const Complex_number& x, const Complex_number& y)
  {
    return {x.re * y.re - x.im * y.im, x.re * y.im + x.im * y.re};
  }
  friend Complex_number operator/(const Complex_number& x, const Complex_number& y)
  {
    const NT square = square_norm(y);
    return {NT(dot_product(x, y) / square), NT((x.im * y.re - x.re * y.im) / square)};
  }
  friend Complex_number conj(const Complex_number& x) { return {x.re, -x.im}; }

  // Re conj(x) y and Im conj(x) y: of x and y as vectors of the plane.
  friend NT dot_product(const Complex_number& x, const Complex_number& y) { return x.re * y.re + x.im * y.im; }
  friend NT cross_product(const Complex_number& x, const Complex_number& y) { return x.re * y.im - x.im * y.re; }
  friend NT square_norm(const Complex_number& x) { return dot_product(x, x); }
};

// |z|, rounded.
template <typename NT>
double size_of(const Complex_number<NT>& z) { return std::hypot(static_cast<double>(z.re), static_cast<double>(z.im)); }

// e^{i x}, by the Taylor series at x / 2^10 and ten squarings, which cost ten bits; for finite |x| < 1000 or so.
template <typename NT>
CGAL_CONFORMAL_EQUIVALENCE_COLD
Complex_number<NT> unit_complex(const NT& x)
{
  const NT z = x / 1024;
  Complex_number<NT> term{NT(1), NT(0)}, sum = term;
  for(int n = 1; ; ++n)
  {
    term = {-term.im * z / n, term.re * z / n};
    const Complex_number<NT> longer = sum + term;
    if(longer.re == sum.re && longer.im == sum.im)
      break;
    sum = longer;
  }
  for(int k = 0; k < 10; ++k)
    sum = sum * sum;
  return sum;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_COMPLEX_NUMBER_H
