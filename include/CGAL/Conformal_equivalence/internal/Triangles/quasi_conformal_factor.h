// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// How far the affine map from a triangle to a triangle of the plane is from a similarity, and both areas.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_QUASI_CONFORMAL_FACTOR_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_QUASI_CONFORMAL_FACTOR_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// ad - bc with a small relative error also where the products cancel (Kahan).
inline double difference_of_products(double a, double d, double b, double c)
{
  const double bc = b * c;
  return std::fma(a, d, -bc) + std::fma(-b, c, bc);
}

// A triangle, up to scale and motion: the vertex opposite the longest edge is the origin and the longer of its
// two edges goes along the x-axis.
//
//            (x, y)                 scaled by 2^-exponent such that 1/2 <= length < 1
//             /  `-.                y = 0 iff the triangle is degenerate
//            /      `-.
//     origin ----------- (length, 0)
//
struct Triangle_frame
{
  std::size_t origin = 0;      // the index of the vertex at the origin
  std::size_t first = 1;       // the index of the vertex on the x-axis; the third vertex is at (x, y)
  double length = 0, x = 0, y = 0;
  int exponent = 0;

  bool is_degenerate() const { return !(length > 0 && y > 0); }
  std::size_t second() const { return 3 - origin - first; }
  Scaled_number<double> area() const { return { 0.5 * length * y, 2 * std::int64_t(exponent) }; }
};

// Vertices at the ends of the longest edge are chosen so that first is opposite the shortest edge.
inline void choose_frame_vertices(const std::array<double, 3>& l, Triangle_frame& frame)
{
  const std::size_t longest = std::max_element(l.begin(), l.end()) - l.begin();
  const std::size_t j = (longest + 1) % 3, k = (longest + 2) % 3;
  frame.origin = longest;
  frame.first = l[k] >= l[j] ? j : k;          // the edge from the origin to j is opposite k
}

// The frame from the three edge lengths (l[i] is opposite vertex i): Heron's formula in Kahan's stable form.
inline Triangle_frame frame_from_lengths(std::array<double, 3> l)
{
  Triangle_frame frame;
  choose_frame_vertices(l, frame);
  const double longest = l[frame.origin];
  if(!(longest > 0) || !std::isfinite(longest) || !(l[frame.second()] > 0) || !(l[frame.first] > 0))
    return frame;

  frame.exponent = binary_exponent(l[frame.second()]);
  for(double& l_i : l)
    l_i = std::scalbn(l_i, -frame.exponent);
  const double a = l[frame.origin], b = l[frame.second()], c = l[frame.first];     // a >= b >= c
  const double least_excess = excess(a, b, c);     // <= 0: the triangle inequality fails
  frame.length = b;
  frame.x = (c * c - (a - b) * (a + b)) / (2 * b);
  if(least_excess > 0)
    frame.y = std::sqrt(least_excess) * std::sqrt(excess(b, c, a)) * (std::sqrt(a + (b + c)) * std::sqrt(a + (b - c)) / (2 * b));
  return frame;
}

typedef std::array<double, 3> Space_vector;

inline double largest_coordinate(const Space_vector& v)
{
  return (std::max)(std::fabs(v[0]), (std::max)(std::fabs(v[1]), std::fabs(v[2])));
}

inline double euclidean_norm(const Space_vector& v)
{
  return std::hypot(v[0], v[1], v[2]);
}

// The frame from the edge vectors of a triangle in space (e[i] goes from vertex i+1 to vertex i+2): exact in
// the angles of caps and needles as far as the vectors are.
inline Triangle_frame frame_from_edge_vectors(std::array<Space_vector, 3> e)
{
  Triangle_frame frame;
  const double largest = (std::max)(largest_coordinate(e[0]),
                                    (std::max)(largest_coordinate(e[1]), largest_coordinate(e[2])));
  if(!(largest > 0) || !std::isfinite(largest))
    return frame;
  frame.exponent = binary_exponent(largest);
  for(Space_vector& e_i : e)
    for(double& coordinate : e_i)
      coordinate = std::scalbn(coordinate, -frame.exponent);

  const std::array<double, 3> l = {{ euclidean_norm(e[0]), euclidean_norm(e[1]), euclidean_norm(e[2]) }};
  choose_frame_vertices(l, frame);
  const Space_vector& b = e[frame.second()];
  const Space_vector& c = e[frame.first];           // one of the two ends, the other begins at the origin
  const Space_vector cross = {{ difference_of_products(b[1], c[2], b[2], c[1]),
                          difference_of_products(b[2], c[0], b[0], c[2]),
                          difference_of_products(b[0], c[1], b[1], c[0]) }};
  frame.length = l[frame.second()];
  if(!(frame.length > 0))
    return frame;
  frame.x = -(b[0] * c[0] + b[1] * c[1] + b[2] * c[2]) / frame.length;
  frame.y = euclidean_norm(cross) / frame.length;
  return frame;
}

typedef std::array<double, 2>   UV_point;
typedef std::array<UV_point, 3> UV_corners;

inline bool is_finite(const UV_corners& w)
{
  return has_finite_coordinates(w[0]) && has_finite_coordinates(w[1]) && has_finite_coordinates(w[2]);
}

// The two edges of the image that start at the origin of the frame, scaled by 2^-exponent to at most 1.
struct Image_edges
{
  std::complex<double> first, second;
  int exponent = 0;
  bool is_point = true;

  double cross_product() const
  {
    return difference_of_products(first.real(), second.imag(), first.imag(), second.real());
  }
};

inline Image_edges image_edges(const UV_corners& w, const Triangle_frame& frame)
{
  const UV_point &o = w[frame.origin], &p = w[frame.first], &q = w[frame.second()];
  const double d[4] = { p[0] - o[0], p[1] - o[1], q[0] - o[0], q[1] - o[1] };
  double largest = 0;
  for(double coordinate : d)
    largest = (std::max)(largest, std::fabs(coordinate));

  Image_edges image;
  image.is_point = !(largest > 0 && std::isfinite(largest));
  if(image.is_point)
    return image;
  image.exponent = binary_exponent(largest);
  image.first  = { std::scalbn(d[0], -image.exponent), std::scalbn(d[1], -image.exponent) };
  image.second = { std::scalbn(d[2], -image.exponent), std::scalbn(d[3], -image.exponent) };
  return image;
}

// The quasi-conformal factor of the affine map from the frame to the corners `w`.
//
// With the columns J_x, J_y of the Jacobian as complex numbers, 2 f_z = J_x - i J_y, 2 f_zbar = J_x + i J_y.
// Near a similarity one of the two is tiny and the quotient keeps its accuracy; elsewhere the small singular
// value comes from the determinant.
inline double quasi_conformal_factor(const Triangle_frame& frame, const UV_corners& w)
{
  const double infinity = (std::numeric_limits<double>::infinity)();
  if(frame.is_degenerate())
    return std::numeric_limits<double>::quiet_NaN();
  if(!is_finite(w) || turn(w[0], w[1], w[2]) == COLLINEAR)
    return infinity;
  const Image_edges image = image_edges(w, frame);
  if(image.is_point)
    return infinity;

  const std::complex<double> i(0, 1);
  const std::complex<double> j_x = image.first * (frame.y / frame.length);                        // times y
  const std::complex<double> j_y = image.second - image.first * (frame.x / frame.length);         // times y
  const double f_z = std::abs(j_x - i * j_y), f_zbar = std::abs(j_x + i * j_y);
  const double larger = (std::max)(f_z, f_zbar), smaller = (std::min)(f_z, f_zbar);
  if(smaller < 0.5 * larger)
    return 1 + 2 * smaller / (larger - smaller);

  const double determinant = std::fabs(image.cross_product()) * (frame.y / frame.length);
  const double s = f_z + f_zbar;                                   // determinant = (f_z - f_zbar)(f_z + f_zbar) / 4
  return determinant > 0 ? (std::max)(1., 0.25 * s * s / determinant) : infinity;
}

inline Scaled_number<double> layout_area(const UV_corners& w, const Triangle_frame& frame)
{
  if(!is_finite(w))
    return Scaled_number<double>();
  const Image_edges image = image_edges(w, frame);
  return image.is_point ? Scaled_number<double>()
                        : Scaled_number<double>{ 0.5 * std::fabs(image.cross_product()), 2 * std::int64_t(image.exponent) };
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_QUASI_CONFORMAL_FACTOR_H
