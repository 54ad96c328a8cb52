// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Points of the sphere with weights, as vectors of the light cone.
//
// A vector v = w (x, y, z, 1) with (x, y, z) on the unit sphere and w > 0 is lightlike for the product
// <v, v'> = x x' + y y' + z z' - t t', and
//
//     |p - p'|^2 = -2 <v, v'> / (w w')        (p, p' the points, w, w' the weights).
//
// So where -2 <v_i, v_j> = l_ij^2, the chords are l_ij scaled by e^{(u_i + u_j) / 2} with e^{-u} = w. Linear maps that keep the product (Lorentz
// transformations) keep the l_ij: they are the Moebius transformations of the sphere, and change nothing but the weights. The
// plane is in it, too: z = x + i y with the metric l~ = e^{(u_i + u_j) / 2} l is the vector e^{-u} (x, y, (1 - |z|^2) / 2, (1 + |z|^2) / 2), by
// stereographic projection from the pole (0, 0, -1); and the vector (0, 0, -c, c) is the point at infinity.
// Counterclockwise in the plane is counterclockwise on the sphere seen from outside.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_LIGHT_CONE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_LIGHT_CONE_H

#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// x, y, z, t
template <typename Number>
using Light_vector = std::array<Number, 4>;

template <typename Number>
Number lorentz_product(const Light_vector<Number>& a, const Light_vector<Number>& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] - a[3] * b[3];
}

// The point z of the plane at a vertex with e^{u/2} = s.
template <typename Number>
Light_vector<Number> light_vector(const Complex_number<Number>& z, const Number& s)
{
  const Number weight = Number(1) / (s * s), square = z.re * z.re + z.im * z.im;
  return {{ weight * z.re, weight * z.im, weight * (Number(1) - square) / 2, weight * (Number(1) + square) / 2 }};
}

// The point of the sphere, with the length of (x, y, z) for t: the two differ by rounding.
template <typename Number>
std::array<Number, 3> sphere_point(const Light_vector<Number>& v)
{
  using std::sqrt;
  std::array<Number, 3> p = {{ v[0] / v[3], v[1] / v[3], v[2] / v[3] }};
  const Number length = sqrt(Number(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]));
  for(Number& x : p)
    x = x / length;
  return p;
}

// A Lorentz transformation.
template <typename Number>
struct Lorentz_matrix
{
  std::array<std::array<Number, 4>, 4> row;

  static Lorentz_matrix identity()
  {
    Lorentz_matrix m;
    for(std::size_t i = 0; i < 4; ++i)
      for(std::size_t j = 0; j < 4; ++j)
        m.row[i][j] = Number(i == j ? 1 : 0);
    return m;
  }

  Light_vector<Number> operator*(const Light_vector<Number>& v) const
  {
    Light_vector<Number> result;
    for(std::size_t i = 0; i < 4; ++i)
      result[i] = row[i][0] * v[0] + row[i][1] * v[1] + row[i][2] * v[2] + row[i][3] * v[3];
    return result;
  }

  Lorentz_matrix operator*(const Lorentz_matrix& m) const
  {
    Lorentz_matrix result;
    for(std::size_t i = 0; i < 4; ++i)
      for(std::size_t j = 0; j < 4; ++j)
        result.row[i][j] = row[i][0] * m.row[0][j] + row[i][1] * m.row[1][j] + row[i][2] * m.row[2][j] + row[i][3] * m.row[3][j];
    return result;
  }
};

// The transformation that takes the point tanh(|d|) d / |d| of the ball (Klein's model) to the origin: points that crowd in the direction d
// spread out.
template <typename Number>
Lorentz_matrix<Number> boost_matrix(const std::array<double, 3>& d)
{
  using std::sqrt;
  Lorentz_matrix<Number> m = Lorentz_matrix<Number>::identity();
  const double rapidity = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  if(!(rapidity > 0))
    return m;
  std::array<Number, 3> n;
  for(std::size_t i = 0; i < 3; ++i)
    n[i] = Number(d[i]);
  const Number length = sqrt(Number(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
  for(Number& x : n)
    x = x / length;
  const Number sinh = Number(std::sinh(rapidity)), cosh = sqrt(Number(sinh * sinh + 1)), excess = sinh * sinh / (cosh + 1);
  for(std::size_t i = 0; i < 3; ++i)
  {
    for(std::size_t j = 0; j < 3; ++j)
      m.row[i][j] = m.row[i][j] + excess * n[i] * n[j];
    m.row[i][3] = m.row[3][i] = -(sinh * n[i]);
  }
  m.row[3][3] = cosh;
  return m;
}

// The rotation by a quaternion, of any length but 0.
template <typename Number>
Lorentz_matrix<Number> rotation_matrix(double w0, double x0, double y0, double z0)
{
  const Number w(w0), x(x0), y(y0), z(z0), n = w * w + x * x + y * y + z * z;
  Lorentz_matrix<Number> m = Lorentz_matrix<Number>::identity();
  m.row[0] = {{ (w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n, Number(0) }};
  m.row[1] = {{ 2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n, Number(0) }};
  m.row[2] = {{ 2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n, Number(0) }};
  return m;
}

// Of vectors so long or short that `double` could not go on with them only the direction is kept.
template <typename Number>
Light_vector<double> rounded(const Light_vector<Number>& v)
{
  const double size = static_cast<double>(v[3]);
  if(v[3] > 0 && !(size > 1e-150 && size < 1e150))
    return {{ static_cast<double>(Number(v[0] / v[3])), static_cast<double>(Number(v[1] / v[3])), static_cast<double>(Number(v[2] / v[3])), 1. }};
  return {{ static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]), static_cast<double>(v[3]) }};
}

// Points in the number type of the result.
template <typename NT, typename Wide, std::size_t dimension>
std::vector<std::array<NT, dimension> > rounded_points(const std::vector<std::array<Wide, dimension> >& points)
{
  std::vector<std::array<NT, dimension> > result(points.size());
  for(std::size_t v = 0; v < points.size(); ++v)
    for(std::size_t i = 0; i < dimension; ++i)
      result[v][i] = static_cast<NT>(points[v][i]);
  return result;
}

template <typename Number>
void transform(const Lorentz_matrix<Number>& m, std::vector<Light_vector<Number> >& points)
{
  for(Light_vector<Number>& v : points)
    v = m * v;
}

// The rotation that takes a point of the sphere, of any length but 0, to the pole (0, 0, 1): about the axis at right angles to both. Where the point
// is so near to the other pole that the cosine has lost the angle, half of what is missing to half a turn is its distance from the axis of the poles.
template <typename Number>
Lorentz_matrix<Number> rotation_to_pole(const std::array<double, 3>& point)
{
  const Eigen::Vector3d p = Eigen::Vector3d(point[0], point[1], point[2]).normalized();
  if(p.z() >= -1 + 1e-12)
  {
    const double s = std::sqrt((1 + p.z()) * 2), inverse = 1 / s;
    return rotation_matrix<Number>(s * 0.5, p.y() * inverse, -p.x() * inverse, 0);
  }
  const double size = std::hypot(p.x(), p.y()), w = size / 2, rest = std::sqrt(1 - w * w);
  return size > 0 ? rotation_matrix<Number>(w, p.y() / size * rest, -p.x() / size * rest, 0) : rotation_matrix<Number>(0, 1, 0, 0);
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_LIGHT_CONE_H
