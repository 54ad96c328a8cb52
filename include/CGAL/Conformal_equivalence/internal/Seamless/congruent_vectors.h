// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Vectors of integers that satisfy linear congruences.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_CONGRUENT_VECTORS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_CONGRUENT_VECTORS_H

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// factors . m = value modulo n
struct Congruence
{
  std::vector<std::int64_t> factors;
  std::int64_t value;
};

// The vectors m of the given dimension that satisfy all congruences modulo n: `origin`, and all its sums with combinations of the basis.
struct Congruent_vectors
{
  typedef std::vector<std::int64_t> Vector;

  bool is_empty = false;
  Vector origin;
  std::vector<Vector> basis;

  // By Euclid's algorithm on the columns (m, s), for the homogeneous congruences factors . m - value s = 0; then s = 1 is asked for.
  Congruent_vectors(std::size_t dimension, const std::vector<Congruence>& congruences, std::int64_t n)
  {
    std::vector<Vector> columns(dimension + 1, Vector(dimension + 1, 0));
    for(std::size_t i = 0; i <= dimension; ++i)
      columns[i][i] = 1;
    for(const Congruence& c : congruences)
    {
      const auto value = [&](const Vector& v)
      {
        std::int64_t sum = -(c.value % n) * (v[dimension] % n);
        for(std::size_t i = 0; i < dimension; ++i)
          sum += (c.factors[i] % n) * (v[i] % n);
        return ((sum % n) + n) % n;
      };
      const std::size_t pivot = reduce(columns, value);
      const std::int64_t d = value(columns[pivot]);
      for(std::int64_t& x : columns[pivot])
        x *= n / std::gcd(d, n);
    }
    const std::size_t pivot = reduce(columns, [&](const Vector& v) { return v[dimension]; });
    is_empty = columns[pivot][dimension] != 1 && columns[pivot][dimension] != -1;
    if(is_empty)
      return;
    const std::int64_t sign = columns[pivot][dimension];
    for(std::int64_t& x : columns[pivot])
      x *= sign;
    for(Vector& v : columns)
      v.pop_back();
    origin = std::move(columns[pivot]);
    columns.erase(columns.begin() + std::ptrdiff_t(pivot));
    basis = std::move(columns);
  }

private:
  // Combines columns until the value is zero for all but one of them, whose number is returned.
  template <typename Value>
  static std::size_t reduce(std::vector<Vector>& columns, Value value)
  {
    for(;;)
    {
      std::size_t pivot = columns.size();
      std::size_t number_of_nonzero = 0;
      for(std::size_t i = 0; i < columns.size(); ++i)
      {
        const std::int64_t x = value(columns[i]);
        if(x == 0)
          continue;
        ++number_of_nonzero;
        if(pivot == columns.size() || std::abs(x) < std::abs(value(columns[pivot])))
          pivot = i;
      }
      if(number_of_nonzero <= 1)
        return number_of_nonzero == 0 ? 0 : pivot;
      const std::int64_t d = value(columns[pivot]);
      for(std::size_t i = 0; i < columns.size(); ++i)
      {
        const std::int64_t q = i == pivot ? 0 : value(columns[i]) / d;
        for(std::size_t k = 0; q != 0 && k < columns[i].size(); ++k)
          columns[i][k] -= q * columns[pivot][k];
      }
    }
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_CONGRUENT_VECTORS_H
