// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_THREE_POINT_TRANSFORMATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_THREE_POINT_TRANSFORMATION_H

#include <CGAL/Conformal_equivalence/internal/Sphere/Projective_atlas.h>

#include <array>
#include <cstddef>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The Moebius transformation of the unit sphere that takes three points p to three points q. In the light cone (light_cone.h) the
// vectors (p_i, 1) go to multiples s_i (q_i, 1) with the same products, -|p_i - p_j|^2 / 2, and what is orthogonal to them, the
// normal (m, t) of the plane m x = t through them, to a multiple of the other normal:
//
//     (x, 1) = c_1 (p_1, 1) + c_2 (p_2, 1) + c_3 (p_3, 1) + c (m, t)
//
// Products are formed from differences of points, which is accurate where points are close to each other.
class Three_point_transformation
{
public:
  typedef std::array<Wide_vector, 3> Three_points;

  // Points of the unit sphere.
  Three_point_transformation(const Three_points& from, const Three_points& to)
    : from_({{ unit_vector(from[0]), unit_vector(from[1]), unit_vector(from[2]) }}), to_(to), side_(sides(from))
  {
    const std::array<Wide_number, 3> other = sides(to);
    is_valid_ = true;
    for(std::size_t i = 0; i < 3; ++i)
      is_valid_ = is_valid_ && side_[i] > Wide_number(0) && other[i] > Wide_number(0);
    if(!is_valid_)
      return;
    std::array<Wide_number, 3> ratio;
    for(std::size_t i = 0; i < 3; ++i)
      ratio[i] = sqrt(Wide_number(side_[i] / other[i]));
    for(std::size_t i = 0; i < 3; ++i)
      scale_[i] = ratio[(i + 1) % 3] * (ratio[(i + 2) % 3] / ratio[i]);
    normal_ = normal(from);
    to_normal_ = normal(to);
    // the square of a normal is a quarter of the product of the squared sides
    square_ = side_[0] * side_[1] * side_[2] / 4;
    normal_scale_ = ratio[0] * ratio[1] * ratio[2];
  }

  // Are there three different points on either side?
  bool is_valid() const { return is_valid_; }

  // The image of a point of the unit sphere, a `unit_vector()`, up to a positive factor: the points given, bit by bit.
  Wide_vector operator()(const Wide_vector& x) const
  {
    std::array<Wide_number, 3> square; // of the distances from the points
    for(std::size_t i = 0; i < 3; ++i)
    {
      const Wide_vector d = difference(x, from_[i]);
      square[i] = dot_product(d, d);
      if(square[i] == Wide_number(0))
        return to_[i];
    }
    const Wide_number along = normal_scale_ * (dot_product(normal_, difference(x, from_[0])) / square_);
    Wide_vector result;
    for(std::size_t k = 0; k < 3; ++k)
      result[k] = along * to_normal_[k];
    for(std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      const Wide_number c = scale_[i] * (square[j] / side_[k] + square[k] / side_[j] - square[i] / side_[j] * (side_[i] / side_[k])) / 2;
      for(std::size_t l = 0; l < 3; ++l)
        result[l] += c * to_[i][l];
    }
    return result;
  }

private:
  // The squared side opposite to each point.
  static std::array<Wide_number, 3> sides(const Three_points& p)
  {
    std::array<Wide_number, 3> result;
    for(std::size_t i = 0; i < 3; ++i)
    {
      const Wide_vector d = difference(p[(i + 2) % 3], p[(i + 1) % 3]);
      result[i] = dot_product(d, d);
    }
    return result;
  }

  static Wide_vector normal(const Three_points& p)
  {
    const Wide_vector d = difference(p[1], p[0]), e = difference(p[2], p[0]);
    return {{ d[1] * e[2] - d[2] * e[1], d[2] * e[0] - d[0] * e[2], d[0] * e[1] - d[1] * e[0] }};
  }

  Three_points from_, to_;
  std::array<Wide_number, 3> side_, scale_;
  Wide_vector normal_, to_normal_;
  Wide_number square_, normal_scale_;
  bool is_valid_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_THREE_POINT_TRANSFORMATION_H
