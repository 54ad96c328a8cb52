// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Similarities of the plane that bring a layout into a frame. They are found in
// double and applied in the wide type, so that they do not disturb the layout.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_FRAMES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_FRAMES_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/internal/triangle_formulas.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

typedef std::array<double, 2> Double_point;

template <typename Wide>
Double_point to_double_point(const Complex_number<Wide>& z)
{
  return {{static_cast<double>(z.re), static_cast<double>(z.im)}};
}

// z -> a (z - center) + b at all positions
template <typename Wide>
void apply_similarity(const Complex_number<Wide>& a, const Double_point& center, const Double_point& b,
                      std::vector<Complex_number<Wide> >& position)
{
  for(Complex_number<Wide>& z : position)
  {
    z = a * Complex_number<Wide>{z.re - Wide(center[0]), z.im - Wide(center[1])};
    z = {z.re + Wide(b[0]), z.im + Wide(b[1])};
  }
}

// A power of two of the size of the largest coordinate.
template <typename Wide>
double power_of_two_near(const std::vector<Complex_number<Wide> >& position)
{
  double largest = 0;
  for(const Complex_number<Wide>& z : position)
  {
    const Double_point p = to_double_point(z);
    largest = (std::max)(largest, (std::max)(std::abs(p[0]), std::abs(p[1])));
  }
  int exponent = 0;
  if(largest > 0 && std::isfinite(largest))
    std::frexp(largest, &exponent);
  return std::ldexp(1., (std::max)(-1000, (std::min)(1000, exponent)));
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

template <typename NT, typename Corner>
Area_moments area_moments(const Intrinsic_triangulation<NT>& t, const Corner& corner)
{
  Area_moments m;
  const auto signed_area = [&](std::uint32_t h)
  {
    const Double_point p = corner(h), q = corner(h + 1), r = corner(h + 2);
    return ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2;
  };
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); h += 3)
  {
    const double area = signed_area(h);
    m.area += area;
    for(int k = 0; k < 2; ++k)
      m.barycentre[k] += area * (corner(h)[k] + corner(h + 1)[k] + corner(h + 2)[k]) / 3;
  }
  if(!(m.area > 0))
    return m;
  for(int k = 0; k < 2; ++k)
    m.barycentre[k] /= m.area;
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); h += 3)
  {
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

// Barycentre in the origin, the longer principal axis horizontal. Where no axis is
// longer, the first border halfedge (or halfedge 0) is horizontal instead. Of the
// two ways left, the one with the larger third moment to the right.
template <typename NT, typename Wide>
void move_to_canonical_frame(const Intrinsic_triangulation<NT>& t, const std::vector<std::uint32_t>& wedge,
                             std::vector<Complex_number<Wide> >& position)
{
  const double unit = power_of_two_near(position); // areas and third moments must not leave the range of double
  const auto scaled = [&](const Complex_number<Wide>& z)
  {
    const Double_point p = to_double_point(z);
    return Double_point{{p[0] / unit, p[1] / unit}};
  };
  const auto corner = [&](std::uint32_t h) { return scaled(position[wedge[h]]); };
  const Area_moments m = area_moments(t, corner);
  double x = m.xx - m.yy, y = 2 * m.xy; // (cos, sin) of twice the angle of the axis
  if(std::hypot(x, y) > 1e-6 * (m.xx + m.yy))
  {
    const double length = std::hypot(x, y);
    x = std::sqrt((std::max)(0., (1 + x / length) / 2));
    y = x > 0.5 ? y / (2 * x * length) : std::copysign(std::sqrt((std::max)(0., 1 - x * x)), y);
  }
  else
  {
    std::uint32_t h = 0;
    while(h + 1 < t.number_of_halfedges() && !t.is_border(h))
      ++h;
    if(!t.is_border(h))
      h = 0;
    x = corner(h)[0] - corner(t.previous(h))[0];
    y = corner(h)[1] - corner(t.previous(h))[1];
  }

  double third = 0, absolute_third = 0;
  for(const Complex_number<Wide>& z : position)
  {
    const Double_point p = scaled(z);
    const double along = (p[0] - m.barycentre[0]) * x + (p[1] - m.barycentre[1]) * y;
    third += along * along * along;
    absolute_third += std::abs(along * along * along);
  }
  const double turn = third < -1e-9 * absolute_third ? -1 : 1;
  apply_similarity(unit_direction<Wide>(turn * x, -turn * y),
                   Double_point{{m.barycentre[0] * unit, m.barycentre[1] * unit}}, Double_point{{0, 0}}, position);
}

// Brings the layout into the frame; returns the factor by which lengths were scaled.
template <typename NT, typename Wide>
NT move_to_frame(const Intrinsic_triangulation<NT>& t, const std::vector<std::uint32_t>& wedge,
                 Layout_frame frame, std::vector<Complex_number<Wide> >& position)
{
  move_to_canonical_frame(t, wedge, position);
  if(frame == Layout_frame::CANONICAL)
    return NT(1);

  const double infinity = std::numeric_limits<double>::infinity();
  Double_point low = {{infinity, infinity}}, high = {{-infinity, -infinity}};
  for(const Complex_number<Wide>& z : position)
    for(int k = 0; k < 2; ++k)
    {
      low[k] = (std::min)(low[k], to_double_point(z)[k]);
      high[k] = (std::max)(high[k], to_double_point(z)[k]);
    }
  for(int k = 0; k < 2; ++k)
    low[k] = std::nextafter(low[k], -infinity); // below all wide coordinates, too
  const double extent = (std::max)(high[0] - low[0], high[1] - low[1]);
  const double scale = extent > 0 ? (1 - 4 * std::numeric_limits<double>::epsilon()) / extent : 1;
  apply_similarity(Complex_number<Wide>{Wide(scale), Wide(0)}, low, Double_point{{0, 0}}, position);
  return NT(scale);
}

template <typename NT, typename Wide>
NT move_to_frame(const Intrinsic_triangulation<NT>& t, const std::vector<std::uint32_t>& wedge,
                 const Pinned_frame<std::uint32_t>& frame, std::vector<Complex_number<Wide> >& position)
{
  using std::sqrt;
  Complex_number<Wide> first{Wide(0), Wide(0)}, second = first;
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); ++h)
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
  for(Complex_number<Wide>& z : position)
  {
    z = a * Complex_number<Wide>{z.re - first.re, z.im - first.im};
    z = {z.re + Wide(frame.first_point[0]), z.im + Wide(frame.first_point[1])};
  }
  return static_cast<NT>(sqrt(Wide(a.re * a.re + a.im * a.im)));
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_FRAMES_H
