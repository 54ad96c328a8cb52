// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Similarities of the plane that bring a layout into a frame, and the arrangement of
// several pieces. They are found in double and applied in the wide type, so that they do
// not disturb the layout.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_LAYOUT_FRAMES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_LAYOUT_FRAMES_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/pieces.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/internal/stable_order.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

typedef std::array<double, 2> Double_point;

// The value of the named parameter `layout_frame`, of whichever of its two types.
struct Any_frame
{
  bool is_pinned;
  Layout_frame frame;                  // unless it is pinned
  Pinned_frame<std::uint32_t> pinned;

  Any_frame(Layout_frame f) : is_pinned(false), frame(f), pinned() {}
  Any_frame(const Pinned_frame<std::uint32_t>& p) : is_pinned(true), frame(Layout_frame::CANONICAL), pinned(p) {}
};

template <typename Wide>
Double_point to_double_point(const Complex_number<Wide>& z)
{
  return {{static_cast<double>(z.re), static_cast<double>(z.im)}};
}

// z -> a (z - center) + b at all positions of a piece
template <typename Wide>
void apply_similarity(const Complex_number<Wide>& a, const Double_point& center, const Double_point& b,
                      const Piece& piece, std::vector<Complex_number<Wide> >& position)
{
  const Complex_number<Wide> from{Wide(center[0]), Wide(center[1])}, to{Wide(b[0]), Wide(b[1])};
  for(std::uint32_t w : piece.wedges)
    position[w] = a * (position[w] - from) + to;
}

// A power of two of the size of the largest coordinate of a piece.
template <typename Wide>
double power_of_two_near(const Piece& piece, const std::vector<Complex_number<Wide> >& position)
{
  double largest = 0;
  for(std::uint32_t w : piece.wedges)
  {
    const Double_point p = to_double_point(position[w]);
    largest = (std::max)(largest, (std::max)(std::abs(p[0]), std::abs(p[1])));
  }
  int exponent = 0;
  if(largest > 0 && std::isfinite(largest))
    std::frexp(largest, &exponent);
  const int most = 1000; // a unit whose inverse is in the range of `double`, too
  return std::ldexp(1., (std::max)(-most, (std::min)(most, exponent)));
}

// The number of absolute value 1 in the direction of (x, y), to all digits.
template <typename Wide>
Complex_number<Wide> unit_direction(double x, double y)
{
  using std::sqrt;
  const double largest = (std::max)(std::abs(x), std::abs(y));
  if(!(largest > 0))
    return {Wide(1), Wide(0)};
  const Wide re = Wide(x / largest), im = Wide(y / largest);
  const Wide length = sqrt(Wide(re * re + im * im));
  return {re / length, im / length};
}

// Area, barycentre and second moments about it of a union of triangles.
struct Area_moments
{
  double area = 0;
  Double_point barycentre = {{0, 0}};
  double xx = 0, xy = 0, yy = 0;
};

template <typename Corner>
Area_moments area_moments(const std::vector<std::uint32_t>& faces, const Corner& corner)
{
  Area_moments m;
  const auto signed_area = [&](std::uint32_t h)
  {
    const Double_point p = corner(h), q = corner(h + 1), r = corner(h + 2);
    return ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2;
  };
  for(std::uint32_t f : faces)
  {
    const std::uint32_t h = 3 * f;
    const double area = signed_area(h);
    m.area += area;
    for(int k = 0; k < 2; ++k)
      m.barycentre[k] += area * (corner(h)[k] + corner(h + 1)[k] + corner(h + 2)[k]) / 3;
  }
  if(!(m.area > 0))
    return m;
  for(int k = 0; k < 2; ++k)
    m.barycentre[k] /= m.area;
  for(std::uint32_t f : faces)
  {
    const std::uint32_t h = 3 * f;
    const double area = signed_area(h) / m.area;
    double x[4], y[4]; // corners and their sum, relative to the barycentre
    x[3] = y[3] = 0;
    for(std::uint32_t k = 0; k < 3; ++k)
    {
      x[3] += x[k] = corner(h + k)[0] - m.barycentre[0];
      y[3] += y[k] = corner(h + k)[1] - m.barycentre[1];
    }
    for(int k = 0; k < 4; ++k)
    {
      m.xx += area * x[k] * x[k] / 12;
      m.xy += area * x[k] * y[k] / 12;
      m.yy += area * y[k] * y[k] / 12;
    }
  }
  return m;
}

// The halfedge that is made horizontal where no principal axis is longer: the first one on the border, else the first.
template <typename NT>
std::uint32_t reference_halfedge(const Intrinsic_triangulation<NT>& t, const Piece& piece)
{
  for(std::uint32_t f : piece.faces)
    for(const std::uint32_t h : t.halfedges(f))
      if(t.is_border(h))
        return h;
  return t.halfedge(piece.faces.front());
}

// A shape has a longest principal axis if its two second moments differ by this much, relative to their sum: less may be rounding, and
// the axis of a square or a disk would then be left to chance.
constexpr double least_elongation = 1e-6;

// Likewise the third moment, relative to that of the absolute distances, of a shape that is not symmetric.
constexpr double least_skewness = 1e-9;

// Barycentre in the origin, the longer principal axis horizontal. Of the two ways left, the one with the larger third
// moment to the right.
template <typename NT, typename Wide>
void move_to_canonical_frame(const Intrinsic_triangulation<NT>& t, const std::vector<std::uint32_t>& wedge,
                             const Piece& piece, std::vector<Complex_number<Wide> >& position)
{
  const double unit = power_of_two_near(piece, position); // areas and third moments must not leave the range of double
  const double inverse = 1 / unit; // a power of two, too
  const auto scaled = [&](const Complex_number<Wide>& z)
  {
    const Double_point p = to_double_point(z);
    return Double_point{{p[0] * inverse, p[1] * inverse}};
  };
  const auto corner = [&](std::uint32_t h) { return scaled(position[wedge[h]]); };
  const Area_moments m = area_moments(piece.faces, corner);
  double x = m.xx - m.yy, y = 2 * m.xy; // (cos, sin) of twice the angle of the axis
  if(std::hypot(x, y) > least_elongation * (m.xx + m.yy))
  {
    const double length = std::hypot(x, y);
    x = std::sqrt((std::max)(0., (1 + x / length) / 2));
    y = x > 0.5 ? y / (2 * x * length) : std::copysign(std::sqrt((std::max)(0., 1 - x * x)), y);
  }
  else
  {
    const std::uint32_t h = reference_halfedge(t, piece);
    x = corner(h)[0] - corner(t.previous(h))[0];
    y = corner(h)[1] - corner(t.previous(h))[1];
  }

  double third = 0, absolute_third = 0;
  for(std::uint32_t w : piece.wedges)
  {
    const Double_point p = scaled(position[w]);
    const double along = (p[0] - m.barycentre[0]) * x + (p[1] - m.barycentre[1]) * y;
    third += along * along * along;
    absolute_third += std::abs(along * along * along);
  }
  const double turn = third < -least_skewness * absolute_third ? -1 : 1;
  apply_similarity(unit_direction<Wide>(turn * x, -turn * y),
                   Double_point{{m.barycentre[0] * unit, m.barycentre[1] * unit}}, Double_point{{0, 0}}, piece, position);
}

// The smallest rectangle with sides along the axes that holds a piece.
struct Bounding_box
{
  Double_point low = {{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}};
  Double_point high = {{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}};

  double width() const { return high[0] - low[0]; }
  double height() const { return high[1] - low[1]; }
  double size() const { return (std::max)(width(), height()); }
};

template <typename Wide>
void insert(const Piece& piece, const std::vector<Complex_number<Wide> >& position, Bounding_box& box)
{
  for(std::uint32_t w : piece.wedges)
    for(int k = 0; k < 2; ++k)
    {
      box.low[k] = (std::min)(box.low[k], to_double_point(position[w])[k]);
      box.high[k] = (std::max)(box.high[k], to_double_point(position[w])[k]);
    }
}

// Where rectangles of similar size come to lie, in rows above one another.
struct Rows
{
  std::vector<Double_point> low;  // by rectangle
  double width = 0, height = 0;   // of all of them, with the gaps

  explicit Rows(const std::vector<Bounding_box>& boxes) : low(boxes.size())
  {
    double area = 0, widest = 0, largest = 0;
    for(const Bounding_box& box : boxes)
      largest = (std::max)(largest, box.size());
    const double relative_gap = 1. / 32, gap = largest * relative_gap; // enough to see, and no waste of space
    for(const Bounding_box& box : boxes)
    {
      area += (box.width() / largest + relative_gap) * (box.height() / largest + relative_gap);
      widest = (std::max)(widest, box.width() + gap);
    }
    const std::vector<std::uint32_t> order =
      stable_order(boxes.size(), [&](std::uint32_t i, std::uint32_t j) { return boxes[i].height() > boxes[j].height(); });

    const double slack = 1.1; // rows are not filled to their ends: a square of just the area would become too high
    const double bound = (std::max)(widest, slack * std::sqrt(area) * largest);
    double x = 0, y = 0, row = 0; // of the current row
    for(std::uint32_t i : order)
    {
      if(x > 0 && x + boxes[i].width() + gap > bound)
      {
        y += row;
        x = row = 0;
      }
      low[i] = {{x, y}};
      x += boxes[i].width() + gap;
      row = (std::max)(row, boxes[i].height() + gap);
      width = (std::max)(width, x);
    }
    height = y + row;
  }
};

// Where rectangles come to lie beside one another: the lower left corner of each. Those of similar size form a block of rows; the blocks follow one
// another from the smallest, at the origin, to the largest: so none comes to lie farther out than some multiple of its own size, and rounding
// there does not spoil what it holds.
inline std::vector<Double_point> places_beside_one_another(const std::vector<Bounding_box>& boxes)
{
  std::vector<int> magnitude(boxes.size()); // those of one magnitude form a block
  for(std::size_t i = 0; i < boxes.size(); ++i)
  {
    int exponent = 0;
    if(boxes[i].size() > 0 && std::isfinite(boxes[i].size()))
      std::frexp(boxes[i].size(), &exponent);
    const int per_block = 4, positive = 4000; // sizes of a block differ by at most 2^4; the shift makes division round down
    magnitude[i] = (exponent + positive) / per_block;
  }
  std::vector<Double_point> places(boxes.size());
  double width = 0, height = 0;
  const std::vector<std::uint32_t> order =
    stable_order(boxes.size(), [&](std::uint32_t i, std::uint32_t j) { return magnitude[i] < magnitude[j]; });
  for(std::size_t first = 0, last; first < order.size(); first = last)
  {
    std::vector<Bounding_box> its_boxes;
    for(last = first; last < order.size() && magnitude[order[last]] == magnitude[order[first]]; ++last)
      its_boxes.push_back(boxes[order[last]]);
    const Rows rows(its_boxes);
    const bool is_right = width <= height; // of the blocks before it, else above them
    for(std::size_t k = 0; k < last - first; ++k)
      places[order[first + k]] = {{rows.low[k][0] + (is_right ? width : 0), rows.low[k][1] + (is_right ? 0 : height)}};
    (is_right ? width : height) += is_right ? rows.width : rows.height;
    (is_right ? height : width) = (std::max)(is_right ? height : width, is_right ? rows.height : rows.width);
  }
  return places;
}

// Puts the pieces beside one another.
template <typename Wide>
void arrange_pieces(const std::vector<Piece>& pieces, std::vector<Complex_number<Wide> >& position)
{
  std::vector<Bounding_box> boxes(pieces.size());
  for(std::size_t i = 0; i < pieces.size(); ++i)
    insert(pieces[i], position, boxes[i]);
  const std::vector<Double_point> places = places_beside_one_another(boxes);
  for(std::size_t i = 0; i < pieces.size(); ++i)
    apply_similarity(Complex_number<Wide>{Wide(1), Wide(0)}, boxes[i].low, places[i], pieces[i], position);
}

// Brings the layout into the frame; returns the factor by which lengths were scaled.
template <typename NT, typename Wide>
NT move_to_frame(const Intrinsic_triangulation<NT>& t, const std::vector<std::uint32_t>& wedge,
                 const std::vector<Piece>& pieces, Layout_frame frame, std::vector<Complex_number<Wide> >& position)
{
  for(const Piece& piece : pieces)
    move_to_canonical_frame(t, wedge, piece, position);
  if(pieces.size() > 1)
    arrange_pieces(pieces, position);
  if(frame == Layout_frame::CANONICAL)
    return NT(1);

  Bounding_box box;
  for(const Piece& piece : pieces)
    insert(piece, position, box);
  for(int k = 0; k < 2; ++k) // below all wide coordinates, too
    box.low[k] = std::nextafter(box.low[k], -std::numeric_limits<double>::infinity());
  const double scale = box.size() > 0 ? (1 - 4 * std::numeric_limits<double>::epsilon()) / box.size() : 1;
  for(const Piece& piece : pieces)
    apply_similarity(Complex_number<Wide>{Wide(scale), Wide(0)}, box.low, Double_point{{0, 0}}, piece, position);
  return NT(scale);
}

// A vertex on the cut is pinned where the first of its corners lies.
template <typename NT, typename Wide>
NT move_to_frame(const Intrinsic_triangulation<NT>& t, const std::vector<std::uint32_t>& wedge,
                 const std::vector<Piece>& pieces, const Pinned_frame<std::uint32_t>& frame,
                 std::vector<Complex_number<Wide> >& position)
{
  using std::sqrt;
  if(pieces.size() > 1)
    move_to_frame(t, wedge, pieces, Layout_frame::CANONICAL, position);
  Complex_number<Wide> first{Wide(0), Wide(0)}, second = first;
  for(auto piece = pieces.rbegin(); piece != pieces.rend(); ++piece)
    for(auto f = piece->faces.rbegin(); f != piece->faces.rend(); ++f)
      for(std::uint32_t h = 3 * *f + 3; h-- > 3 * *f; )
      {
        if(t.target(h) == frame.first)
          first = position[wedge[h]];
        if(t.target(h) == frame.second)
          second = position[wedge[h]];
      }
  const Wide x = second.re - first.re, y = second.im - first.im, square = x * x + y * y;
  const Wide dx = Wide(frame.second_point[0]) - Wide(frame.first_point[0]),
             dy = Wide(frame.second_point[1]) - Wide(frame.first_point[1]);
  if(!(square > 0))
    return NT(1);
  const Complex_number<Wide> a{(dx * x + dy * y) / square, (dy * x - dx * y) / square};
  const Complex_number<Wide> to{Wide(frame.first_point[0]), Wide(frame.first_point[1])};
  for(const Piece& piece : pieces)
    for(std::uint32_t w : piece.wedges)
      position[w] = a * (position[w] - first) + to;
  return static_cast<NT>(sqrt(square_norm(a)));
}

template <typename NT, typename Wide>
NT move_to_frame(const Intrinsic_triangulation<NT>& t, const std::vector<std::uint32_t>& wedge,
                 const std::vector<Piece>& pieces, const Any_frame& frame, std::vector<Complex_number<Wide> >& position)
{
  return frame.is_pinned ? move_to_frame(t, wedge, pieces, frame.pinned, position)
                         : move_to_frame(t, wedge, pieces, frame.frame, position);
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_LAYOUT_FRAMES_H
