// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_SVG_TILES_H
#define FLATTEN_MESH_SVG_TILES_H

#include "page_text.h"
#include "SVG_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace flattening {

// The tiles of a seamless layout (see `SVG_options::tiles`), within the frame.
class SVG_tiles
{
  typedef std::array<double, 2> Point;

  static constexpr double most_lines_of_squares = 1000, most_hexagons = 10000;

public:
  SVG_tiles(const SVG_frame& frame, int symmetry) : frame_(frame), symmetry_(symmetry) {}

  void write(Text_buffer& out) const
  {
    const Point lower = frame_.lower_left(), upper = frame_.upper_right();
    const double squares = side_of_squares(), hexagons = (upper[0] - lower[0] + 1) * (upper[1] - lower[1] + 1) * 2 / std::sqrt(3.);
    if(has_square_tiles() ? ! (squares > 0) : ! has_hexagonal_tiles() || ! (hexagons <= most_hexagons))
      return;
    out << "<defs><clipPath id=\"drawing-frame\"><rect width=\"" << frame_.width << "\" height=\"" << frame_.height << "\"/></clipPath></defs>\n"
        << "<g clip-path=\"url(#drawing-frame)\">"
           "<path id=\"tiles\" transform=\"scale(.01)\" fill=\"none\" stroke=\"#000\" stroke-opacity=\".5\" stroke-width=\"80\" d=\"";
    if(has_square_tiles())
      write_squares(out, squares);
    else
      write_hexagons(out);
    out << "\"/></g>\n";
  }

  // What the legend says of them; empty if there is nothing to say.
  std::string note() const
  {
    return has_square_tiles() && side_of_squares() > 1 ? "tiles in a square, along a side: " + short_text(side_of_squares()) : "";
  }

private:
  bool has_square_tiles() const    { return symmetry_ == 2 || symmetry_ == 4; }
  bool has_hexagonal_tiles() const { return symmetry_ == 3 || symmetry_ == 6; }

  // An odd number of tiles, so that the squares have integers in their centres; zero where numbers fail.
  double side_of_squares() const
  {
    const Point lower = frame_.lower_left(), upper = frame_.upper_right();
    const double lines = upper[0] - lower[0] + (upper[1] - lower[1]) + 2;
    if(! (lines < 1e15) || ! ((std::max)({std::abs(lower[0]), std::abs(lower[1]), std::abs(upper[0]), std::abs(upper[1])}) < 1e15))
      return 0;
    return 2 * std::floor((std::ceil(lines / most_lines_of_squares)) / 2) + 1;
  }

  // The lines (k + 1/2) side.
  void write_squares(Text_buffer& out, double side) const
  {
    const Point lower = frame_.lower_left(), upper = frame_.upper_right();
    for(std::size_t axis = 0; axis < 2; ++axis)
      for(double k = std::ceil(lower[axis] / side - 0.5); (k + 0.5) * side <= upper[axis]; ++k)
      {
        Point p = lower, q = upper;
        p[axis] = q[axis] = (k + 0.5) * side;
        const Grid_point a = frame_.in_hundredths(p), b = frame_.in_hundredths(q);
        out << 'M' << a[0] << ' ' << a[1];
        write_step(out << 'l', a, b);
      }
  }

  // Of each hexagon four corners, from the left to the right; the other edges are those of its neighbours below.
  void write_hexagons(Text_buffer& out) const
  {
    const Point lower = frame_.lower_left(), upper = frame_.upper_right();
    const double row = std::sqrt(3.) / 2, h = row / 3;
    for(double b = std::ceil(lower[1] / row) - 1; b * row <= upper[1] + h; ++b)
      for(double a = std::ceil(lower[0] - b / 2 - 0.5); a + b / 2 <= upper[0] + 0.5; ++a)
      {
        const double x = a + b / 2, y = b * row;
        const std::array<Point, 4> corners = {{ {{x - 0.5, y + h}}, {{x, y + 2 * h}}, {{x + 0.5, y + h}}, {{x + 0.5, y - h}} }};
        Grid_point previous = frame_.in_hundredths(corners[0]);
        out << 'M' << previous[0] << ' ' << previous[1];
        for(std::size_t k = 1; k < 4; ++k)
        {
          const Grid_point next = frame_.in_hundredths(corners[k]);
          write_step(out << 'l', previous, next);
          previous = next;
        }
      }
  }

  const SVG_frame& frame_;
  int symmetry_;
};

} // namespace flattening

#endif // FLATTEN_MESH_SVG_TILES_H
