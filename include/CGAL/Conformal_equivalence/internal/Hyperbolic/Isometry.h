// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Isometries of the hyperbolic plane that keep its orientation, as they act on the unit disk: z -> (a z + b) / (conj(b) z + conj(a)), of
// determinant |a|^2 - |b|^2 = 1 (the group SU(1,1)). A point at distance d from the center has 1 - |z| = 2 e^{-d} or so, which few digits can hold;
// a and b have the size of e^{d/2}, and lose nothing.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_ISOMETRY_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_ISOMETRY_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Complex_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>

#include <algorithm>
#include <cmath>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename NT>
struct Isometry
{
  typedef Complex_number<NT> Complex;
  Complex a, b;

  static Isometry identity() { return {Complex{NT(1), NT(0)}, Complex{NT(0), NT(0)}}; }

  // about the center by the angle alpha, given by e^{i alpha / 2}
  static Isometry rotation(const Complex& half) { return {half, Complex{NT(0), NT(0)}}; }

  // from the center to the right by the length l, given by sinh(l/2) and cosh(l/2)
  static Isometry translation(const NT& half_sinh, const NT& half_cosh) { return {Complex{half_cosh, NT(0)}, Complex{half_sinh, NT(0)}}; }

  // the product, with its determinant made 1 again
  friend Isometry operator*(const Isometry& x, const Isometry& y)
  {
    return Isometry{x.a * y.a + x.b * conj(y.b), x.a * y.b + x.b * conj(y.a)}.normalized();
  }

  Isometry inverse() const { return {conj(a), -b}; }

  // where the center comes to lie
  Complex center() const { return b / conj(a); }

  Complex operator()(const Complex& z) const { return (a * z + b) / (conj(b) * z + conj(a)); }

  // The largest difference of an entry from that of 1 or -1, which are the same motion.
  double distance_from_identity() const
  {
    const double s = static_cast<double>(a.re) < 0 ? -1 : 1;
    return (std::max)({std::abs(static_cast<double>(NT(s * a.re - 1))), std::abs(static_cast<double>(a.im)), size_of(b)});
  }

  // With numbers of another type, as `convert` makes them of these.
  template <typename Other, typename Function>
  Isometry<Other> converted(const Function& convert) const
  {
    return Isometry<Other>{{convert(a.re), convert(a.im)}, {convert(b.re), convert(b.im)}};
  }

private:
  Isometry normalized() const
  {
    using std::sqrt;
    // |a|^2 - |b|^2 is a difference of large numbers far from the center: there it says nothing, and is 1 already as well as can be known
    const NT determinant = square_norm(a) - square_norm(b);
    if(!(determinant > NT(0.99) && determinant < NT(1.01)))
      return *this;
    const NT unit = 1 / sqrt(determinant);
    return {unit * a, unit * b};
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_ISOMETRY_H
