// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Angles of cones that are multiples of 2 pi / n: the integers nearest to given numbers, with a given sum.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_NEAREST_INTEGERS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_NEAREST_INTEGERS_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Positive integers k_i with the sum `sum` for which the largest |x_i - k_i| is least, and then as near to the x_i as can be. Empty if there are
// none. `sum` = 0: any sum. O(n^2 log n).
//
// The largest difference is one of |x_i - k| for an integer k: all of these, up to what is needed, are sorted, and the least that allows the sum is
// found by bisection: with a bound b, each k_i lies between max(1, ceil(x_i - b)) and floor(x_i + b).
inline std::vector<long> nearest_integers(const std::vector<double>& x, long sum)
{
  const std::size_t n = x.size();
  std::vector<long> result(n);
  const auto lower = [](double y, double b) { return (std::max)(1l, long(std::ceil(y - b - 1e-12))); };
  const auto upper = [](double y, double b) { return long(std::floor(y + b + 1e-12)); };
  if(sum == 0)
  {
    for(std::size_t i = 0; i < n; ++i)
      result[i] = (std::max)(1l, std::lround(x[i]));
    return result;
  }
  if(n == 0 || sum < long(n))
    return {};
  const auto is_possible = [&](double b)
  {
    long least = 0, most = 0;
    for(double y : x)
    {
      if(upper(y, b) < lower(y, b))
        return false;
      least += lower(y, b);
      most += upper(y, b);
    }
    return least <= sum && sum <= most;
  };
  double reach = 1;
  while(!is_possible(reach))
    reach *= 2;
  std::vector<double> bounds;
  for(double y : x)
    for(long k = (std::max)(1l, long(std::floor(y - reach))); double(k) <= y + reach; ++k)
      bounds.push_back(std::abs(y - double(k)));
  std::sort(bounds.begin(), bounds.end());
  std::size_t begin = 0, end = bounds.size(); // the first one that is possible
  while(begin < end)
  {
    const std::size_t middle = (begin + end) / 2;
    if(is_possible(bounds[middle]))
      end = middle;
    else
      begin = middle + 1;
  }
  const double b = begin < bounds.size() ? bounds[begin] : reach;

  // from the nearest ones, those that cost least are moved by one until the sum is right
  long missing = sum;
  for(std::size_t i = 0; i < n; ++i)
  {
    result[i] = (std::min)((std::max)(std::lround(x[i]), lower(x[i], b)), upper(x[i], b));
    missing -= result[i];
  }
  for(; missing != 0; missing += missing > 0 ? -1 : 1)
  {
    const long by = missing > 0 ? 1 : -1;
    std::size_t best = n;
    const auto cost = [&](std::size_t i) { return std::abs(double(result[i] + by) - x[i]) - std::abs(double(result[i]) - x[i]); };
    for(std::size_t i = 0; i < n; ++i)
      if(result[i] + by >= lower(x[i], b) && result[i] + by <= upper(x[i], b) && (best == n || cost(i) < cost(best)))
        best = i;
    if(best == n)
      return {};
    result[best] += by;
  }
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_NEAREST_INTEGERS_H
