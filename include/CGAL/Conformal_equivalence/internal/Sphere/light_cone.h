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

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
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

template <typename Number>
Light_vector<double> rounded(const Light_vector<Number>& v)
{
  return {{ static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2]), static_cast<double>(v[3]) }};
}

template <typename Number>
void transform(const Lorentz_matrix<Number>& m, std::vector<Light_vector<Number> >& points)
{
  for(Light_vector<Number>& v : points)
    v = m * v;
}

// The Moebius transformation after which the weighted barycentre of the points is the origin (B. Springborn, A unique representation of polyhedral types.
// Centering via Moebius transformations, 2005): it takes to the origin the point x of hyperbolic space for which the sum of all w log(-<x, v>),
// the distances from horospheres, is least. That is convex along geodesics; with points p of the sphere, its gradient at the
// origin is -sum w p, its second derivative sum w (1 - p p^T). There is one iff no point has half of the weight. If all points have a mirror image with
// respect to the plane y = 0, which need not be given, the transformation keeps that plane.
class Moebius_centering
{
public:
  // `weight`: by point, 0 for what is no point; if `is_planar`, only transformations that keep the plane y = 0 are allowed, and y does not count: the mirror images are not given
  Moebius_centering(std::vector<double> weight, bool is_planar) : weight_(std::move(weight)), is_planar_(is_planar)
  {
    double sum = 0;
    for(double w : weight_)
      sum += w;
    for(double& w : weight_)
      w /= sum;
  }

  // Transforms the points. Returns whether there is such a transformation.
  template <typename Number>
  bool operator()(std::vector<Light_vector<Number> >& points) const
  {
    const double centred = 1e-14, nearly_centred = 1e-12;
    for(std::size_t i = 0; i < points.size(); ++i)
      if(!(weight_[i] < 0.5) && (!is_planar_ || points[i][1] == 0))
        return false;
    double last = 2;
    for(int round = 0; round < 5; ++round) // more than one for what is lost when points are rounded
    {
      std::vector<Light_vector<double> > p;
      p.reserve(points.size());
      for(const Light_vector<Number>& v : points)
        p.push_back(rounded(v));
      const double size = moments(p).first.norm();
      if(size <= centred || (size <= nearly_centred && size > last / 2))
        return true;
      last = size;
      transform(find<Number>(std::move(p)), points);
    }
    return last <= nearly_centred;
  }

private:
  typedef std::pair<Eigen::Vector3d, Eigen::Matrix3d> Moments;

  // The weighted sums of p and of 1 - p p^T.
  Moments moments(const std::vector<Light_vector<double> >& points) const
  {
    Moments result(Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero());
    for(std::size_t i = 0; i < points.size(); ++i)
    {
      if(!(weight_[i] > 0))
        continue;
      const Light_vector<double>& v = points[i];
      const Eigen::Vector3d p(v[0] / v[3], is_planar_ ? 0 : v[1] / v[3], v[2] / v[3]);
      result.first += weight_[i] * p;
      result.second += weight_[i] * (Eigen::Matrix3d::Identity() - p * p.transpose());
    }
    return result;
  }

  // Newton's method; steps are bounded, and halved where the derivative at their end says that they were too long.
  template <typename Number>
  Lorentz_matrix<Number> find(std::vector<Light_vector<double> > points) const
  {
    Lorentz_matrix<Number> result = Lorentz_matrix<Number>::identity();
    Moments here = moments(points);
    for(int i = 0; i < 200 && here.first.norm() > 1e-15; ++i)
    {
      Eigen::Vector3d d = here.second.ldlt().solve(here.first);
      if(!(d.dot(here.first) > 0))
        d = here.first;
      d *= (std::min)(1., 1.5 / d.norm());
      for(int halving = 0; ; ++halving)
      {
        const std::array<double, 3> step = {{ d[0], d[1], d[2] }};
        std::vector<Light_vector<double> > moved = points;
        transform(boost_matrix<double>(step), moved);
        const Moments there = moments(moved);
        if(there.first.dot(d) < -0.5 * here.first.dot(d) && halving < 50)
        {
          d /= 2;
          continue;
        }
        if(!(there.first.norm() < here.first.norm()) && here.first.norm() < 1e-13)
          return result;
        result = boost_matrix<Number>(step) * result;
        points.swap(moved);
        here = there;
        break;
      }
    }
    return result;
  }

  std::vector<double> weight_;
  bool is_planar_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_LIGHT_CONE_H
