// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// From a layout to its drawing.

#ifndef FLATTEN_MESH_SVG_FRAME_H
#define FLATTEN_MESH_SVG_FRAME_H

#include "color_scale.h"
#include "page_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>

namespace flattening {

// From the layout to the drawing: y points down there, and coordinates are
// integers, hundredths of the unit of the drawing.
struct SVG_frame
{
  double left, top, scale, width, height;

  SVG_frame(const Finite_range& x, const Finite_range& y, double size)
    : left(x.empty() ? 0 : x.lower), top(y.empty() ? 0 : y.upper), scale(1), width(size), height(size)
  {
    const double w = x.empty() ? 0 : x.upper - x.lower, h = y.empty() ? 0 : y.upper - y.lower;
    const double longest = (std::max)(w, h);
    if(longest > 0 && std::isfinite(longest))
    {
      scale = size / longest;
      width = w / longest * size;
      height = h / longest * size;
    }
  }

  std::array<double, 2> operator()(const std::array<double, 2>& p) const
  {
    return {{ (p[0] - left) * scale, (top - p[1]) * scale }};
  }

  // the part of the layout that is drawn
  std::array<double, 2> lower_left() const  { return {{ left, top - height / scale }}; }
  std::array<double, 2> upper_right() const { return {{ left + width / scale, top }}; }

  std::array<std::int64_t, 2> in_hundredths(const std::array<double, 2>& p) const
  {
    // numbers too far apart for a frame are drawn at its rim
    const auto rounded = [](double x) { return std::llround((std::min)((std::max)(100 * x, -1e15), 1e15)); };
    const std::array<double, 2> q = (*this)(p);
    return {{ rounded(q[0]), rounded(q[1]) }};
  }
};

typedef std::array<std::int64_t, 2> Grid_point;

inline bool is_finite(const std::array<double, 2>& p) { return std::isfinite(p[0]) && std::isfinite(p[1]); }

inline void write_step(Text_buffer& out, const Grid_point& a, const Grid_point& b)
{
  out << b[0] - a[0] << ' ' << b[1] - a[1];
}

// A number for people.
inline std::string short_text(double x)
{
  char text[32];
  const std::to_chars_result end = std::to_chars(text, text + sizeof text, x, std::chars_format::general, 6);
  return std::string(text, end.ptr);
}

// What makes text readable on any ground.
constexpr const char* text_with_halo = "paint-order=\"stroke\" stroke=\"#fff\" stroke-width=\"3\" stroke-linejoin=\"round\" text-anchor=\"middle\"";

} // namespace flattening

#endif // FLATTEN_MESH_SVG_FRAME_H
