// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_DOUBLE_DOUBLE_VECTOR_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_DOUBLE_DOUBLE_VECTOR_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Vector_of.h>

#include <cmath>
#include <cstring>
#include <utility>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A few numbers of type `Double_double`, lane by lane: with the operations of that type, in their order, and so with its bounds and, unless the
// program is compiled for fused multiplications, its bits. Products are Dekker's, whatever the processor has; of factors beyond 2^996 they
// are NaN.
template <int bytes>
struct Double_double_vector
{
  typedef typename Vector_of<double, bytes>::type Vector;
  static constexpr int lanes = Vector_of<double, bytes>::lanes;
  typedef std::make_integer_sequence<int, lanes> Lanes;

  Vector hi, lo;

  // Entries from wherever they were gathered. (Vectors made of single entries make g++ take them for uninitialized.)
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void load(const double (&high)[lanes], const double (&low)[lanes])
  {
    std::memcpy(&hi, high, sizeof(hi));
    std::memcpy(&lo, low, sizeof(lo));
  }

  // *this = x + y
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void set_sum(const Double_double_vector& x, const Double_double_vector& y)
  {
    Double_double_vector s, t;
    s.set_exact_sum(x.hi, y.hi);
    t.set_exact_sum(x.lo, y.lo);
    s.set_quick_sum(s.hi, s.lo + t.hi);
    set_quick_sum(s.hi, t.lo + s.lo);
  }

  // x - y
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void set_difference(const Double_double_vector& x, const Double_double_vector& y)
  {
    const Double_double_vector negative = {-y.hi, -y.lo};
    set_sum(x, negative);
  }

  // x y
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void set_product(const Double_double_vector& x, const Double_double_vector& y)
  {
    Double_double_vector p;
    p.set_exact_product(x.hi, y.hi);
    set_quick_sum(p.hi, p.lo + (x.hi * y.lo + x.lo * y.hi));
  }

  CGAL_CONFORMAL_EQUIVALENCE_INLINE void set_product(const Double_double_vector& x, const Vector& y)
  {
    Double_double_vector p, t;
    p.set_exact_product(x.hi, y);
    t.set_quick_sum(p.hi, x.lo * y);
    set_quick_sum(t.hi, t.lo + p.lo);
  }

  // x / y
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void set_quotient(const Double_double_vector& x, const Double_double_vector& y)
  {
    const Vector q = x.hi / y.hi;
    Double_double_vector r;
    r.set_product(y, q);
    set_quick_sum(q, ((x.hi - r.hi) + (x.lo - r.lo)) / y.hi);
  }

  // The square root. \pre x > 0
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void set_root(const Double_double_vector& x)
  {
    Vector s;
    set_root(x.hi, s, Lanes());
    Double_double_vector p;
    p.set_exact_product(s, s);
    set_quick_sum(s, (((x.hi - p.hi) - p.lo) + x.lo) / (s + s));
  }

  // x where the mask is set, else y
  template <typename Mask>
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void select(const Mask& mask, const Double_double_vector& x, const Double_double_vector& y)
  {
    hi = mask ? x.hi : y.hi;
    lo = mask ? x.lo : y.lo;
  }

  CGAL_CONFORMAL_EQUIVALENCE_INLINE void halve()
  {
    hi *= 0.5;
    lo *= 0.5;
  }

  CGAL_CONFORMAL_EQUIVALENCE_INLINE void store(double* p_hi, double* p_lo) const
  {
    std::memcpy(p_hi, &hi, sizeof(hi));
    std::memcpy(p_lo, &lo, sizeof(lo));
  }

private:
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void set_exact_sum(const Vector& a, const Vector& b)
  {
    const Vector s = a + b, part = s - a;
    lo = (a - (s - part)) + (b - part);
    hi = s;
  }

  // \pre |a| >= |b|, or a is 0
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void set_quick_sum(const Vector& a, const Vector& b)
  {
    const Vector s = a + b;
    lo = b - (s - a);
    hi = s;
  }

  CGAL_CONFORMAL_EQUIVALENCE_INLINE void set_exact_product(const Vector& a, const Vector& b)
  {
    Double_double_vector x, y;
    x.split(a);
    y.split(b);
    const Vector p = a * b;
    lo = ((x.hi * y.hi - p) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo;
    hi = p;
  }

  // Two halves of at most 26 bits.
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void split(const Vector& a)
  {
    const Vector c = a * 134217729.; // 2^27 + 1
    hi = c - (c - a);
    lo = a - hi;
  }

  template <int... i>
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void set_root(const Vector& square, Vector& result, std::integer_sequence<int, i...>)
  {
    double entries[lanes];
    std::memcpy(entries, &square, sizeof(square));
    result = Vector{std::sqrt(entries[i])...};
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_DOUBLE_DOUBLE_VECTOR_H
