// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Integers of any size, by GMP's interface for C, which costs next to nothing to compile.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_INTEGER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_INTEGER_H

#include <gmp.h>

#include <utility>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Integer
{
public:
  Integer(int x = 0) { mpz_init_set_si(value_, x); }
  Integer(const Integer& x) { mpz_init_set(value_, x.value_); }
  Integer(Integer&& x) noexcept
  {
    mpz_init(value_);
    mpz_swap(value_, x.value_);
  }
  Integer& operator=(Integer x)
  {
    mpz_swap(value_, x.value_);
    return *this;
  }
  ~Integer() { mpz_clear(value_); }

  friend Integer operator+(const Integer& x, const Integer& y) { return apply(mpz_add, x, y); }
  friend Integer operator-(const Integer& x, const Integer& y) { return apply(mpz_sub, x, y); }
  friend Integer operator*(const Integer& x, const Integer& y) { return apply(mpz_mul, x, y); }
  friend Integer operator-(const Integer& x) { return Integer() - x; }

  // The largest integer that is at most x / y. \pre y is not 0
  friend Integer floor_of_quotient(const Integer& x, const Integer& y) { return apply(mpz_fdiv_q, x, y); }

  friend bool operator==(const Integer& x, const Integer& y) { return mpz_cmp(x.value_, y.value_) == 0; }
  friend bool operator!=(const Integer& x, const Integer& y) { return mpz_cmp(x.value_, y.value_) != 0; }
  friend bool operator<(const Integer& x, const Integer& y) { return mpz_cmp(x.value_, y.value_) < 0; }
  friend bool operator<=(const Integer& x, const Integer& y) { return mpz_cmp(x.value_, y.value_) <= 0; }

  // Exact up to 2^53, else truncated.
  explicit operator double() const { return mpz_get_d(value_); }

private:
  typedef void (*Operation)(mpz_ptr, mpz_srcptr, mpz_srcptr);

  static Integer apply(Operation operation, const Integer& x, const Integer& y)
  {
    Integer result;
    operation(result.value_, x.value_, y.value_);
    return result;
  }

  mpz_t value_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_INTEGER_H
