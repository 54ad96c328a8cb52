// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// An order of things by their indices. Every call of `std::stable_sort()` with a comparison of its own costs a program about 4 kB of code
// and the time to compile them; this is compiled once.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_STABLE_ORDER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_STABLE_ORDER_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The indices 0 ... n - 1 sorted by `is_less`; of equal ones the smaller index comes first.
inline std::vector<std::uint32_t> stable_order(std::size_t n, const std::function<bool(std::uint32_t, std::uint32_t)>& is_less)
{
  std::vector<std::uint32_t> result(n);
  std::iota(result.begin(), result.end(), std::uint32_t(0));
  std::stable_sort(result.begin(), result.end(), [&](std::uint32_t i, std::uint32_t j) { return is_less(i, j); });
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_STABLE_ORDER_H
