// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_ROBUST_RANGE_H
#define FLATTEN_MESH_ROBUST_RANGE_H

#include "color_scale.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

namespace flattening {

// The range of nearly all values, over which colours are spread: from their 1st to their 99th percentile, rounded outwards to two digits of its
// width. A few triangles of extreme values would leave the others with one colour.
struct Robust_range : Finite_range
{
  std::size_t number_below = 0, number_above = 0; // of the values beyond, be they infinite

  Robust_range() = default;

  explicit Robust_range(const std::vector<double>& values)
  {
    std::vector<double> finite;
    std::copy_if(values.begin(), values.end(), std::back_inserter(finite), [](double x) { return std::isfinite(x); });
    if(finite.empty())
      return;
    const std::size_t n = finite.size(), rank = (n - 1) / 100;
    lower = element(finite, rank);
    upper = element(finite, n - 1 - rank);
    round_outwards();
    for(double x : values)
    {
      number_below += x < lower;
      number_above += x > upper;
    }
  }

private:
  static double element(std::vector<double>& values, std::size_t rank)
  {
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
  }

  void round_outwards()
  {
    const double width = upper - lower;
    if(! (width > 0) || ! std::isfinite(width))
      return;
    const double power = std::pow(10., std::floor(std::log10(width)) - 1);
    const double low = std::floor(lower / power) * power + 0., high = std::ceil(upper / power) * power + 0.; // no -0
    if(std::isfinite(low) && low <= lower && std::isfinite(high) && high >= upper) // otherwise numbers are too far apart, or too near
    {
      lower = low;
      upper = high;
    }
  }
};

} // namespace flattening

#endif // FLATTEN_MESH_ROBUST_RANGE_H
