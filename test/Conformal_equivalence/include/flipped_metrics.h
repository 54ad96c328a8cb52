// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Metrics made by flips, for the tests of what is done with them.

#ifndef CGAL_TEST_CONFORMAL_EQUIVALENCE_FLIPPED_METRICS_H
#define CGAL_TEST_CONFORMAL_EQUIVALENCE_FLIPPED_METRICS_H

#include "index_level.h"

#include <CGAL/Conformal_equivalence/Surface_topology.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

namespace testing {

typedef std::complex<double> Complex;

inline Complex complex(const std::array<double, 2>& z) { return Complex(z[0], z[1]); }

inline double diameter(const std::vector<std::array<double, 2> >& corners)
{
  double low[2] = { HUGE_VAL, HUGE_VAL }, high[2] = { -HUGE_VAL, -HUGE_VAL };
  for(const auto& p : corners)
    for(int k = 0; k < 2; ++k)
    {
      low[k] = (std::min)(low[k], p[k]);
      high[k] = (std::max)(high[k], p[k]);
    }
  return std::hypot(high[0] - low[0], high[1] - low[1]);
}

// Ptolemy's theorem: flips that stay in the conformal class
inline void flip(Triangulation& t, Index e)
{
  const Index h = t.edge_halfedge(e), g = t.twin(h);
  t.flip_edge(e, (t.halfedge_length(t.next(h)) * t.halfedge_length(t.next(g))
                + t.halfedge_length(t.previous(h)) * t.halfedge_length(t.previous(g))) / t.length(e));
}

// The metric that flips of the edges have made of t, with the factors u.
inline Metric flipped_metric(const Triangulation& t, const std::vector<Index>& flips, const std::vector<double>& u)
{
  Metric metric;
  metric.triangulation = t;
  for(Index e : flips)
    flip(metric.triangulation, e);
  metric.flips = flips;
  metric.log_scale_factors = u;
  for(double x : u)
    metric.scale_factors.push_back(exp(Metric::Wide_number(x) / 2));
  return metric;
}

inline Conditions random_angles(const Triangulation& t, double spread, unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, spread);
  Conditions conditions(t);
  const double total = 2 * pi * (double(t.number_of_vertices()) - double(CE::connected_components(t).components[0].euler_characteristic()));
  std::vector<double> angle(t.number_of_vertices());
  double sum = 0;
  for(double& a : angle)
    sum += a = std::exp(normal(random));
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    conditions.prescribe_angle_sum(v, angle[v] / sum * total);
  return conditions;
}

inline std::vector<Index> all_vertices(const Triangulation& t)
{
  std::vector<Index> result(t.number_of_vertices());
  for(Index v = 0; v < result.size(); ++v)
    result[v] = v;
  return result;
}

// Two tori without a triangle each, glued along it; all lengths are 1.
inline Triangulation two_tori()
{
  const Soup half = torus(6, 5);
  const Index n = Index(half.points.size());
  const std::array<Index, 3> hole = half.triangles[0];
  std::vector<std::array<Index, 3> > triangles(half.triangles.begin() + 1, half.triangles.end());
  std::vector<Index> image(n);
  Index next = n;
  for(Index v = 0; v < n; ++v)
    image[v] = v == hole[0] || v == hole[1] || v == hole[2] ? v : next++;
  for(std::size_t i = 1; i < half.triangles.size(); ++i)
    triangles.push_back({{image[half.triangles[i][0]], image[half.triangles[i][2]], image[half.triangles[i][1]]}});
  std::vector<Index> origin;
  for(const auto& t : triangles)
    origin.insert(origin.end(), t.begin(), t.end());
  return Triangulation(next, origin, CE::glue_triangles(triangles));
}

// A polygon inscribed in the unit circle, cut into triangles in a random way. With u = -log of random heights it is scaled to the
// polygon: its vertices are the light-cone vectors height * (cos, sin, 1), and Klein's model is the plane of the layout.
struct Ideal_polygon
{
  std::vector<double> height, u;
  std::vector<Complex> place;
  Triangulation triangulation;

  Ideal_polygon(Index n, Random& random)
  {
    std::vector<double> angle(n);
    for(Index i = 0; i < n; ++i)
      angle[i] = 2 * pi * (i + random(-.4, .4)) / n;
    for(Index i = 0; i < n; ++i)
    {
      height.push_back(std::exp(random(-1, 1)));
      u.push_back(-std::log(height[i]));
      place.push_back(std::polar(1., angle[i]));
    }
    std::vector<std::array<Index, 3> > triangles;
    for(Index i = 1; i + 1 < n; ++i)
      triangles.push_back({{0, i, i + 1}});
    std::vector<Index> origin;
    for(const auto& t : triangles)
      origin.insert(origin.end(), t.begin(), t.end());
    triangulation = Triangulation(n, origin, CE::glue_triangles(triangles));
    for(Index k = 0; k < 20 * n; ++k)
    {
      const Index e = random.below(triangulation.number_of_edges());
      if(triangulation.is_flippable(e))
        triangulation.flip_edge(e, 1);
    }
    for(Index e = 0; e < triangulation.number_of_edges(); ++e)
    {
      const Index h = triangulation.edge_halfedge(e), i = triangulation.origin(h), j = triangulation.target(h);
      triangulation.set_length(e, std::sqrt(height[i] * height[j]) * std::abs(place[i] - place[j]));
    }
  }
};

} // namespace testing

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_FLIPPED_METRICS_H
