// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// By how much a metric that is conformally equivalent to a given one distorts areas relative to the total area. Areas are known by their logarithms,
// as factors may be of any size.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_AREA_DISTORTION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_AREA_DISTORTION_H

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The logarithm of the area of a triangle; minus infinity if it has none.
template <typename NT>
double log_area(const Incircle_form<NT>& triangle)
{
  return triangle.is_triangle ? std::log(static_cast<double>(triangle.s)) + std::log(static_cast<double>(triangle.r))
                              : -std::numeric_limits<double>::infinity();
}

// log(sum of e^x), for x of any size; minus infinity if there are none.
inline double log_sum(const std::vector<double>& x)
{
  double largest = -std::numeric_limits<double>::infinity(), sum = 0;
  for(double y : x)
    largest = (std::max)(largest, y);
  if(!std::isfinite(largest))
    return largest;
  for(double y : x)
    sum += std::exp(y - largest);
  return largest + std::log(sum);
}

// The largest factor, or its inverse, by which areas grew relative to the mean; areas, and their totals, by their logarithms. What had no area does
// not count.
inline double area_distortion(const std::vector<double>& before, const std::vector<double>& after, double total_before, double total_after)
{
  double result = 0;
  for(std::size_t i = 0; i < before.size(); ++i)
  {
    const double difference = std::abs((after[i] - before[i]) - (total_after - total_before));
    if(std::isfinite(before[i]) && !(difference <= result))
      result = difference;
  }
  return std::isnan(result) ? std::numeric_limits<double>::infinity() : std::exp(result);
}

// By face, of the surface as it was given.
template <typename NT>
std::vector<double> log_areas(const Intrinsic_triangulation<NT>& t)
{
  std::vector<double> result;
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); h += 3)
    result.push_back(log_area(Incircle_form<NT>(t.length(t.edge(h)), t.length(t.edge(h + 1)), t.length(t.edge(h + 2)))));
  return result;
}

// By face of the triangulation of the metric that was found.
template <typename NT>
std::vector<double> scaled_log_areas(const Conformal_metric<NT>& metric)
{
  std::vector<double> result;
  for(std::uint32_t f = 0; f < metric.triangulation.number_of_faces(); ++f)
    result.push_back(log_area(wide_triangle(metric.triangulation, metric.scale_factors, f)));
  return result;
}

// Of the faces of `t`, scaled by e^u, in `double`.
template <typename NT>
double area_distortion_of_faces(const Intrinsic_triangulation<NT>& t, const std::vector<double>& u)
{
  typedef std::uint32_t Index;
  const auto length = [&](Index h) { return std::exp((u[t.origin(h)] + u[t.target(h)]) / 2) * static_cast<double>(t.length(t.edge(h))); };
  const std::vector<double> before = log_areas(t);
  std::vector<double> after;
  for(Index h = 0; h < t.number_of_halfedges(); h += 3)
    after.push_back(log_area(Incircle_form<double>(length(h), length(h + 1), length(h + 2))));
  return area_distortion(before, after, log_sum(before), log_sum(after));
}

// Of the faces of `t`, on which the metric was found.
template <typename NT>
double area_distortion_of_faces(const Intrinsic_triangulation<NT>& t, const Conformal_metric<NT>& metric)
{
  const std::vector<double> before = log_areas(t), after = scaled_log_areas(metric);
  return area_distortion(before, after, log_sum(before), log_sum(after));
}

// Where edges were flipped no triangle of the metric is one of the surface given. Around a vertex the metric is that of the surface, times e^{2u}.
template <typename NT>
double area_distortion_at_vertices(const Intrinsic_triangulation<NT>& t, const Conformal_metric<NT>& metric)
{
  std::vector<double> before, after;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v))
    {
      before.push_back(0);
      after.push_back(2 * static_cast<double>(metric.log_scale_factors[v]));
    }
  const double number_of_copies = metric.is_doubled ? 2 : 1;
  return area_distortion(before, after, log_sum(log_areas(t)), log_sum(scaled_log_areas(metric)) - std::log(number_of_copies));
}

// The one or the other.
template <typename NT>
double area_distortion_of_metric(const Intrinsic_triangulation<NT>& t, const Conformal_metric<NT>& metric)
{
  return metric.is_retriangulated() ? area_distortion_at_vertices(t, metric) : area_distortion_of_faces(t, metric);
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_AREA_DISTORTION_H
