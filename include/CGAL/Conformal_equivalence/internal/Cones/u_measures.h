// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// How much u varies over a surface, with the areas of the vertices for weights.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_U_MEASURES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_U_MEASURES_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Cones/area_distortion.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A third of the areas of the triangles at each vertex, all in all 1. A surface without area counts all vertices alike.
template <typename NT>
Eigen::VectorXd vertex_areas(const Intrinsic_triangulation<NT>& t)
{
  Eigen::VectorXd result = Eigen::VectorXd::Zero(Eigen::Index(t.number_of_vertices()));
  const std::vector<double> areas = log_areas(t);
  const double total = log_sum(areas);
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); ++h)
    result[t.origin(h)] += std::isfinite(total) ? std::exp(areas[h / 3] - total) / 3 : 1 / double(t.number_of_halfedges());
  return result;
}

// The square root of the mean of the squares of u less its mean; `area`: by vertex, with the sum 1.
inline double root_mean_square(const Eigen::VectorXd& area, const std::vector<double>& u)
{
  const auto x = Eigen::VectorXd::Map(u.data(), Eigen::Index(u.size()));
  const double mean = area.dot(x);
  return std::sqrt((std::max)(area.dot((x.array() - mean).square().matrix()), 0.));
}

// The largest factor, or its inverse, by which areas at vertices, e^{2u}, are scaled relative to the mean.
inline double area_distortion_of_vertices(const Eigen::VectorXd& area, const std::vector<double>& u)
{
  double least = 0, most = 0;
  bool is_first = true;
  for(std::size_t v = 0; v < u.size(); ++v)
    if(area[Eigen::Index(v)] > 0)
    {
      least = is_first ? u[v] : (std::min)(least, u[v]);
      most = is_first ? u[v] : (std::max)(most, u[v]);
      is_first = false;
    }
  double sum = 0;
  for(std::size_t v = 0; v < u.size(); ++v)
    sum += area[Eigen::Index(v)] * std::exp(2 * (u[v] - most));
  const double log_mean = 2 * most + std::log(sum);
  return std::exp((std::max)(2 * most - log_mean, log_mean - 2 * least));
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_U_MEASURES_H
