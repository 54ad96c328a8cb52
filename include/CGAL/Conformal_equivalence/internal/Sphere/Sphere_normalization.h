// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_SPHERE_NORMALIZATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_SPHERE_NORMALIZATION_H

#include <CGAL/Conformal_equivalence/internal/Sphere/Moebius_centering.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The Moebius transformation of the sphere that is chosen: it puts the barycentre of the vertices in the centre, and turns them.
template <typename Wide>
class Sphere_normalization
{
  typedef std::uint32_t Index;
  typedef std::vector<Light_vector<Wide> > Vectors;

public:
  // `weights`: by vertex, 0 for isolated ones; `given`: the points to which those of the sphere are turned, by vertex, or none; `first`, `second`:
  // the vertices that tell the rotation where these do not
  Sphere_normalization(std::vector<double> weights, std::vector<std::array<double, 3> > given, Index first, Index second)
    : weights_(std::move(weights)), given_(std::move(given)), first_(first), second_(second)
  {}

  // Transforms the vectors. Returns whether there is such a transformation.
  bool operator()(Vectors& vectors) const;

private:
  // The rotation that brings the points nearest to those given (W. Kabsch, 1976). Returns whether there is one that is better than all others.
  bool turn_to_points(Vectors& vectors) const
  {
    const double tie = 1e-9; // of the singular values of the covariance: below that, rounding would choose the rotation
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    if(!set_covariance(vectors, covariance))
      return false;
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
    if(!(svd.singularValues()[1] + sign * svd.singularValues()[2] > tie * svd.singularValues()[0]))
      return false;
    const Eigen::Matrix3d rotation = svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
    const Eigen::Quaterniond q(rotation);
    transform(rotation_matrix<Wide>(q.w(), q.x(), q.y(), q.z()), vectors);
    return true;
  }

  // That of the points given, in units of the greatest coordinate, and the points of the sphere. Returns whether any is not the origin.
  bool set_covariance(const Vectors& vectors, Eigen::Matrix3d& covariance) const
  {
    std::vector<Eigen::Vector3d> given(vectors.size(), Eigen::Vector3d::Zero());
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double sum = 0, size = 0;
    for(Index v = 0; v < vectors.size(); ++v)
    {
      if(!(weights_[v] > 0))
        continue;
      given[v] = Eigen::Vector3d(given_[v][0], given_[v][1], given_[v][2]);
      size = (std::max)(size, given[v].cwiseAbs().maxCoeff());
      sum += weights_[v];
    }
    if(!(size > 0))
      return false;
    for(Index v = 0; v < vectors.size(); ++v)
      centre += weights_[v] / sum * (given[v] /= size);
    for(Index v = 0; v < vectors.size(); ++v)
    {
      if(!(weights_[v] > 0))
        continue;
      const std::array<double, 3> p = point(vectors[v]);
      covariance += weights_[v] / sum * (given[v] - centre) * Eigen::RowVector3d(p[0], p[1], p[2]);
    }
    return true;
  }

  // The first vertex goes to the pole (0, 0, 1), and the second one to the half of the plane y = 0 with x > 0.
  void turn_to_first(Vectors& vectors) const
  {
    transform(rotation_to_pole<Wide>(point(vectors[first_])), vectors);
    const std::array<double, 3> p = point(vectors[second_]);
    const double half = -std::atan2(p[1], p[0]) / 2;
    transform(rotation_matrix<Wide>(std::cos(half), 0, 0, std::sin(half)), vectors);
  }

  static std::array<double, 3> point(const Light_vector<Wide>& vector)
  {
    const Light_vector<double> p = rounded(vector);
    return {{ p[0] / p[3], p[1] / p[3], p[2] / p[3] }};
  }

  std::vector<double> weights_;
  std::vector<std::array<double, 3> > given_;
  Index first_, second_;
};

template <typename Wide>
bool Sphere_normalization<Wide>::operator()(Vectors& vectors) const
{
  if(!Moebius_centering(weights_, false)(vectors))
    return false;
  if(given_.empty() || !turn_to_points(vectors))
    turn_to_first(vectors);
  return true;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template bool Sphere_normalization<Double_double>::operator()(Vectors&) const;
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_SPHERE_NORMALIZATION_H
