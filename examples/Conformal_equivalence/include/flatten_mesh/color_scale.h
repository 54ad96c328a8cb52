// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_COLOR_SCALE_H
#define FLATTEN_MESH_COLOR_SCALE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace flattening {

typedef std::array<unsigned char, 3> RGB;

// A sequential scale from dark blue to yellow with even steps of lightness
// (nine colours of "viridis", van der Walt and Smith 2015). `t` in [0,1].
inline RGB sequential_color(double t)
{
  static const std::array<RGB, 9> stops = {{
    {{68, 1, 84}}, {{71, 44, 122}}, {{59, 81, 139}}, {{44, 113, 142}}, {{33, 144, 141}},
    {{39, 173, 129}}, {{92, 200, 99}}, {{170, 220, 50}}, {{253, 231, 37}} }};
  const double x = (std::min)((std::max)(t, 0.), 1.) * 8;
  const std::size_t i = (std::min)(static_cast<std::size_t>(x), std::size_t(7));
  RGB result;
  for(std::size_t k = 0; k < 3; ++k)
    result[k] = static_cast<unsigned char>(std::lround(stops[i][k] + (x - double(i)) * (stops[i+1][k] - stops[i][k])));
  return result;
}

inline std::string hexadecimal(const RGB& color)
{
  static const char digits[] = "0123456789abcdef";
  std::string text = "#";
  for(unsigned char c : color)
  {
    text += digits[c >> 4];
    text += digits[c & 15];
  }
  return text;
}

// Colours that are told apart easily, in an order that keeps neighbours far from each other.
constexpr std::size_t number_of_categorical_colors = 16;

inline const char* categorical_color(std::size_t i)
{
  static const char* const colors[number_of_categorical_colors] = {
    "e6194b", "4363d8", "f58231", "911eb4", "42d4f4", "f032e6", "9a6324", "bfef45",
    "800000", "469990", "ffb6c8", "000075", "ffe119", "3cb44b", "808000", "a9a9a9" };
  return colors[i % number_of_categorical_colors];
}

// The range of the finite values among those seen.
struct Finite_range
{
  double lower =  std::numeric_limits<double>::infinity();
  double upper = -std::numeric_limits<double>::infinity();

  void insert(double x)
  {
    if(std::isfinite(x))
    {
      lower = (std::min)(lower, x);
      upper = (std::max)(upper, x);
    }
  }
  bool empty() const { return ! (lower <= upper); }

  // where `x` lies in the range, in [0,1]
  double parameter(double x) const
  {
    if(empty() || lower == upper || std::isnan(x))
      return 0.5;
    return (std::min)((std::max)((x/2 - lower/2) / (upper/2 - lower/2), 0.), 1.);
  }
};

// The largest of ..., 1, 2, 5, 10, 20, ... that is at most `x`.
inline double round_number_below(double x)
{
  if(! (x > 0) || ! std::isfinite(x))
    return 1;
  const double power = std::pow(10., std::floor(std::log10(x)));
  for(double factor : {5., 2.})
    if(factor * power <= x)
      return factor * power;
  return power;
}

} // namespace flattening

#endif // FLATTEN_MESH_COLOR_SCALE_H
