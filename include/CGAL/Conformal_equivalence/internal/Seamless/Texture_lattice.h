// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The lattices that have rotations by 2 pi / n for their symmetries.
//
// For n = 2 and 4 these are the Gaussian integers, Z + Z theta with theta = i; for n = 3 and 6 the Eisenstein integers, theta = e^{i pi / 3}. There
// are no others. In both
//
//     theta^2 = tau theta - 1,   tau = theta + 1 / theta = 0 or 1,
//
// so that theta (a + b theta) = -b + (a + tau b) theta: in the coordinates (a, b) all rotations are made of additions. They are
// exact for integers, and for `double`s that are multiples of one power of two and not too large.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TEXTURE_LATTICE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TEXTURE_LATTICE_H

#include <array>
#include <cmath>
#include <complex>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// (a, b) stands for a + b theta.
template <typename T>
using Lattice_coordinates = std::array<T, 2>;

class Texture_lattice
{
public:
  typedef std::complex<double> Complex;

  static bool exists(long n) { return n == 2 || n == 3 || n == 4 || n == 6; }

  // \pre exists(n)
  explicit Texture_lattice(int n) : n_(n) {}

  int symmetry() const { return n_; }
  int trace() const { return n_ % 3 == 0 ? 1 : 0; }
  int order() const { return n_ % 3 == 0 ? 6 : 4; }          // of theta
  double area_of_tile() const { return theta().imag(); }

  Complex theta() const { return n_ % 3 == 0 ? Complex(0.5, std::sqrt(0.75)) : Complex(0, 1); }

  // From 0 to n - 1.
  int reduced(int quanta) const { return (quanta % n_ + n_) % n_; }

  // The rotation by quanta times 2 pi / n.
  template <typename T>
  Lattice_coordinates<T> rotated(int quanta, Lattice_coordinates<T> p) const
  {
    for(int k = reduced(quanta) * (order() / n_); k > 0; --k)
      p = times_theta(p);
    return p;
  }

  Complex rotation(int quanta) const { return to_plane(rotated(quanta, Lattice_coordinates<double>{{1, 0}})); }

  template <typename T>
  Lattice_coordinates<T> times_theta(const Lattice_coordinates<T>& p) const
  {
    const T b = -p[1];
    return trace() == 0 ? Lattice_coordinates<T>{{b, p[0]}} : Lattice_coordinates<T>{{b, T(p[0] + p[1])}};
  }

  template <typename T>
  Complex to_plane(const Lattice_coordinates<T>& p) const
  {
    return trace() == 0 ? Complex(double(p[0]), double(p[1])) : Complex(double(p[0]) + double(p[1]) / 2, double(p[1]) * theta().imag());
  }

  Lattice_coordinates<double> from_plane(const Complex& z) const
  {
    const double b = z.imag() / theta().imag();
    return {{trace() == 0 ? z.real() : z.real() - b / 2, b}};
  }

private:
  int n_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TEXTURE_LATTICE_H
