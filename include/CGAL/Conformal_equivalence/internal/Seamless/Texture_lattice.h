// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The lattices that have rotations by 2 pi / n for their symmetries, and exact arithmetic with their points.
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

#include <boost/multiprecision/cpp_int.hpp>

#include <array>
#include <cmath>
#include <complex>
#include <cstdint>

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

// a + b theta with integers of any size: a ring with division with remainder, as both kinds are Euclidean.
template <int Trace>
struct Lattice_number
{
  typedef boost::multiprecision::cpp_int Integer;

  Integer a = 0, b = 0;

  Lattice_number() = default;
  Lattice_number(Integer x, Integer y = 0) : a(std::move(x)), b(std::move(y)) {}

  // theta to the power k >= 0
  static Lattice_number unit(int k)
  {
    Lattice_number result(1);
    for(; k > 0; --k)
      result = result * Lattice_number(0, 1);
    return result;
  }

  bool is_zero() const { return a == 0 && b == 0; }
  Integer norm() const { return a * a + Trace * (a * b) + b * b; }
  Lattice_number conjugate() const { return {Integer(a + Trace * b), Integer(-b)}; }

  friend Lattice_number operator+(const Lattice_number& x, const Lattice_number& y) { return {Integer(x.a + y.a), Integer(x.b + y.b)}; }
  friend Lattice_number operator-(const Lattice_number& x, const Lattice_number& y) { return {Integer(x.a - y.a), Integer(x.b - y.b)}; }
  friend Lattice_number operator*(const Lattice_number& x, const Lattice_number& y)
  {
    const Integer bd = x.b * y.b;
    return {Integer(x.a * y.a - bd), Integer(x.a * y.b + x.b * y.a + Trace * bd)};
  }
  friend bool operator==(const Lattice_number& x, const Lattice_number& y) { return x.a == y.a && x.b == y.b; }

  // The quotient, rounded so that the norm of the remainder is at most 3/4 of that of the divisor.
  friend Lattice_number operator/(const Lattice_number& x, const Lattice_number& y)
  {
    const Lattice_number numerator = x * y.conjugate();
    const Integer d = y.norm();
    return {rounded_quotient(numerator.a, d), rounded_quotient(numerator.b, d)};
  }

private:
  // \pre d > 0
  static Integer rounded_quotient(const Integer& x, const Integer& d)
  {
    const Integer doubled = 2 * x + d, divisor = 2 * d;
    Integer result = doubled / divisor; // towards zero
    if(result * divisor > doubled)
      --result;
    return result;
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TEXTURE_LATTICE_H
