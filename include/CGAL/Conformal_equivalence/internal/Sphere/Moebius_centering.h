// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_MOEBIUS_CENTERING_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_MOEBIUS_CENTERING_H

#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The Moebius transformation after which the weighted barycentre of the points is the origin (B. Springborn, A unique representation of polyhedral
// types. Centering via Moebius transformations, 2005): it takes to the origin the point x of hyperbolic space for which the sum of all w log(-<x,
// v>), the distances from horospheres, is least. That is convex along geodesics; with points p of the sphere, its gradient at the
// origin is -sum w p, its second derivative sum w (1 - p p^T). There is one iff no point has half of the weight. If all points have a mirror image
// with respect to the plane y = 0, which need not be given, the transformation keeps that plane.
class Moebius_centering
{
public:
  // `weight`: by point, 0 for what is no point; if `is_planar`, only transformations that keep the plane y = 0 are allowed, and y does not count: the
  // mirror images are not given
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
    for(std::size_t i = 0; i < points.size(); ++i)
      if(!(weight_[i] < 0.5) && (!is_planar_ || points[i][1] == 0))
        return false;
    double last = 2; // more than any barycentre
    // Each round spreads out what the one before has brought into the range of `double`; beyond all digits of the points nothing is left to spread.
    using std::log;
    const double digits = -static_cast<double>(log(Number(std::numeric_limits<Number>::epsilon())));
    const int most_rounds = few_rounds_ + static_cast<int>(2 * digits / farthest_);
    for(int round = 0; round < most_rounds; ++round)
    {
      std::vector<Light_vector<double> > p;
      p.reserve(points.size());
      for(const Light_vector<Number>& v : points)
        p.push_back(rounded(v));
      const double size = moments(p).first.norm();
      if(size <= centred_ || (size <= nearly_centred_ && size > last / 2))
        return true;
      last = size;
      transform(find<Number>(std::move(p)), points);
    }
    return last <= nearly_centred_;
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
    const double zero = 1e-15, rounding = 1e-13; // of the gradient: what counts as 0, and below what it need not decrease any more
    Lorentz_matrix<Number> result = Lorentz_matrix<Number>::identity();
    Moments here = moments(points);
    double way = 0;
    for(int i = 0; i < most_steps_ && here.first.norm() > zero && way < farthest_; ++i)
    {
      Eigen::Vector3d d = step(here);
      for(int halving = 0; ; ++halving)
      {
        const std::array<double, 3> translation = {{ d[0], d[1], d[2] }};
        std::vector<Light_vector<double> > moved = points;
        transform(boost_matrix<double>(translation), moved);
        const Moments there = moments(moved);
        if(there.first.dot(d) < -0.5 * here.first.dot(d) && halving < most_halvings_)
        {
          d /= 2;
          continue;
        }
        if(!(there.first.norm() < here.first.norm()) && here.first.norm() < rounding)
          return result;
        result = boost_matrix<Number>(translation) * result;
        way += d.norm();
        points.swap(moved);
        here = there;
        break;
      }
    }
    return result;
  }

  // That of Newton's method, or the gradient where that does not lead down; bounded, as second derivatives change by a factor of e per unit.
  static Eigen::Vector3d step(const Moments& here)
  {
    const double longest = 1.5;
    Eigen::Vector3d d = solve(here.second, here.first);
    if(!(d.dot(here.first) > 0))
      d = here.first;
    d *= (std::min)(1., longest / d.norm());
    return d;
  }

  // The solution x of m x = b for a symmetric matrix, by its factors L D L^T with the greatest entries of the diagonal first; where D is 0, x is.
  // This is Eigen::LDLT, operation by operation, which takes longer to compile than all the rest of this class.
  static Eigen::Vector3d solve(const Eigen::Matrix3d& m, const Eigen::Vector3d& b)
  {
    std::array<int, 3> p = {{0, 1, 2}};
    for(std::size_t k = 0; k < 2; ++k)
      std::swap(p[k], *std::max_element(p.begin() + std::ptrdiff_t(k), p.end(),
                                        [&](int i, int j) { return std::abs(m(i, i)) < std::abs(m(j, j)); }));
    const auto ratio = [](double x, double d) { return std::abs(d) > 0 ? x / d : x; };
    const double d0 = m(p[0], p[0]), l10 = ratio(m(p[1], p[0]), d0), l20 = ratio(m(p[2], p[0]), d0);
    const double d1 = m(p[1], p[1]) - l10 * (d0 * l10), l21 = ratio(m(p[2], p[1]) - l20 * (d0 * l10), d1);
    const double d2 = m(p[2], p[2]) - (l20 * (d0 * l20) + l21 * (d1 * l21));
    const double y0 = b[p[0]], y1 = b[p[1]] - l10 * y0, y2 = b[p[2]] - (l20 * y0 + l21 * y1);
    const auto quotient = [](double y, double d) { return std::abs(d) > (std::numeric_limits<double>::min)() ? y / d : 0; };
    const double z2 = quotient(y2, d2), z1 = quotient(y1, d1) - l21 * z2, z0 = quotient(y0, d0) - (l10 * z1 + l20 * z2);
    Eigen::Vector3d x;
    x[p[0]] = z0;
    x[p[1]] = z1;
    x[p[2]] = z2;
    return x;
  }

  static constexpr double centred_ = 1e-14;   // of the barycentre
  static constexpr double nearly_centred_ = 1e-12; // if another round would not halve it
  static constexpr int few_rounds_ = 5;           // more than one for what is lost when points are rounded
  static constexpr double farthest_ = 12;         // in one round: points that are rounded to `double` are known to e^{2 * 12} / 2^53 then, some 1e-6
  static constexpr int most_steps_ = 200;         // some ten are needed, and more where points crowd, as each goes only so far
  static constexpr int most_halvings_ = 50;       // after that, the step is below what `double` can tell

  std::vector<double> weight_;
  bool is_planar_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_MOEBIUS_CENTERING_H
