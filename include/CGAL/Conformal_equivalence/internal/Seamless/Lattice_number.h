// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The points of a texture's lattice (Texture_lattice.h) as numbers of a ring, in which equations are solved exactly.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_LATTICE_NUMBER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_LATTICE_NUMBER_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Integer.h>

#include <utility>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// a + b theta with integers of any size.
struct Lattice_number
{
  Integer a, b;

  Lattice_number() = default;
  Lattice_number(Integer x, Integer y = 0) : a(std::move(x)), b(std::move(y)) {}
  Lattice_number(int x, int y = 0) : a(x), b(y) {}

  bool is_zero() const { return a == 0 && b == 0; }

  friend Lattice_number operator+(const Lattice_number& x, const Lattice_number& y) { return {x.a + y.a, x.b + y.b}; }
  friend Lattice_number operator-(const Lattice_number& x, const Lattice_number& y) { return {x.a - y.a, x.b - y.b}; }
  friend bool operator==(const Lattice_number& x, const Lattice_number& y) { return x.a == y.a && x.b == y.b; }
};

// The ring of these numbers, with division with remainder, as both kinds are Euclidean. (No template on the kind: all would be compiled twice.)
class Lattice_ring
{
public:
  // theta^2 = trace theta - 1: 0 for squares, 1 for triangles
  explicit Lattice_ring(int trace) : trace_(trace) {}

  // theta to the power k >= 0
  Lattice_number unit(int k) const
  {
    Lattice_number result(1);
    for(; k > 0; --k)
      result = product(result, Lattice_number(0, 1));
    return result;
  }

  Integer norm(const Lattice_number& x) const { return x.a * x.a + trace_ * (x.a * x.b) + x.b * x.b; }
  Lattice_number conjugate(const Lattice_number& x) const { return {x.a + trace_ * x.b, -x.b}; }

  Lattice_number product(const Lattice_number& x, const Lattice_number& y) const
  {
    const Integer bd = x.b * y.b;
    return {x.a * y.a - bd, x.a * y.b + x.b * y.a + trace_ * bd};
  }

  // The quotient, rounded so that the norm of the remainder is at most 3/4 of that of the divisor.
  Lattice_number quotient(const Lattice_number& x, const Lattice_number& y) const
  {
    const Lattice_number numerator = product(x, conjugate(y));
    const Integer d = norm(y);
    return {rounded_quotient(numerator.a, d), rounded_quotient(numerator.b, d)};
  }

private:
  // \pre d > 0
  static Integer rounded_quotient(const Integer& x, const Integer& d) { return floor_of_quotient(2 * x + d, 2 * d); }

  const int trace_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_LATTICE_NUMBER_H
