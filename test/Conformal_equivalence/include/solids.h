// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Shapes as CAD programs make them: many vertices on one circle, faces of many corners cut into triangles in one way or another.

#ifndef CGAL_TEST_CONFORMAL_EQUIVALENCE_SOLIDS_H
#define CGAL_TEST_CONFORMAL_EQUIVALENCE_SOLIDS_H

#include "test_meshes.h"

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace testing {

// How the polygon at the end of a body is cut into triangles.
enum class Cap { OPEN, CENTRE, CORNER, HALVED };

// A body of revolution with n sides: rings of radius r at height z, from below, where r > 0.
typedef std::vector<std::pair<double, double> > Profile; // r, z

namespace bodies {

inline void add_ring(Soup& soup, Index n, double r, double z)
{
  for(Index i = 0; i < n; ++i)
    soup.points.push_back({{r * std::cos(2 * CGAL_PI * i / n), r * std::sin(2 * CGAL_PI * i / n), z}});
}

inline void add_band(Soup& soup, Index n, Index below, Index above)
{
  for(Index i = 0; i < n; ++i)
  {
    const Index j = (i + 1) % n;
    soup.triangles.push_back({{below + i, below + j, above + j}});
    soup.triangles.push_back({{below + i, above + j, above + i}});
  }
}

inline void add_triangle(Soup& soup, Index a, Index b, Index c, bool is_upper)
{
  soup.triangles.push_back({{a, is_upper ? b : c, is_upper ? c : b}});
}

// Every second corner is cut off, again and again.
inline void add_halved_polygon(Soup& soup, std::vector<Index> polygon, bool is_upper)
{
  while(polygon.size() > 3)
  {
    std::vector<Index> rest;
    const std::size_t n = polygon.size();
    for(std::size_t i = 0; i + 1 < n; i += 2)
    {
      add_triangle(soup, polygon[i], polygon[i + 1], polygon[(i + 2) % n], is_upper);
      rest.push_back(polygon[i]);
    }
    if(n % 2 == 1)
      rest.push_back(polygon[n - 1]);
    polygon.swap(rest);
  }
  if(polygon.size() == 3)
    add_triangle(soup, polygon[0], polygon[1], polygon[2], is_upper);
}

// The ring that begins at `first` becomes a face.
inline void add_cap(Soup& soup, Index n, Index first, Cap cap, bool is_upper)
{
  std::vector<Index> polygon;
  for(Index i = 0; i < n; ++i)
    polygon.push_back(first + i);
  if(cap == Cap::CENTRE)
  {
    const Index c = Index(soup.points.size());
    soup.points.push_back({{0, 0, soup.points[first][2]}});
    for(Index i = 0; i < n; ++i)
      add_triangle(soup, first + i, first + (i + 1) % n, c, is_upper);
  }
  else if(cap == Cap::CORNER)
    for(Index i = 1; i + 1 < n; ++i)
      add_triangle(soup, first, first + i, first + i + 1, is_upper);
  else if(cap == Cap::HALVED)
    add_halved_polygon(soup, polygon, is_upper);
}

} // namespace bodies

inline Soup body_of_revolution(Index n, const Profile& profile, Cap lower, Cap upper)
{
  Soup soup;
  for(const auto& ring : profile)
    bodies::add_ring(soup, n, ring.first, ring.second);
  for(Index k = 0; k + 1 < profile.size(); ++k)
    bodies::add_band(soup, n, k * n, (k + 1) * n);
  bodies::add_cap(soup, n, 0, lower, false);
  bodies::add_cap(soup, n, Index(profile.size() - 1) * n, upper, true);
  return soup;
}

// With `rings` bands of triangles.
inline Soup prism(Index n, double height, Index rings, Cap lower, Cap upper)
{
  Profile profile;
  for(Index k = 0; k <= rings; ++k)
    profile.emplace_back(1, height * k / rings);
  return body_of_revolution(n, profile, lower, upper);
}

inline Soup ring_cone(Index n, double height, Index rings, Cap lower)
{
  Profile profile;
  for(Index k = 0; k < rings; ++k)
    profile.emplace_back(1 - double(k) / rings, height * k / rings);
  Soup soup = body_of_revolution(n, profile, lower, Cap::CENTRE);
  soup.points.back()[2] = height;
  return soup;
}

// Parallels and meridians; a dome is the half of it above the equator.
inline Soup uv_sphere(Index n, Index parallels, bool is_dome)
{
  Profile profile;
  const double least = is_dome ? 0 : -CGAL_PI / 2 + CGAL_PI / (parallels + 1), step = is_dome ? CGAL_PI / 2 / parallels : CGAL_PI / (parallels + 1);
  for(Index k = 0; k < parallels; ++k)
    profile.emplace_back(std::cos(least + step * k), std::sin(least + step * k));
  Soup soup = body_of_revolution(n, profile, is_dome ? Cap::OPEN : Cap::CENTRE, Cap::CENTRE);
  soup.points.back()[2] = 1;
  if(!is_dome)
    soup.points[soup.points.size() - 2][2] = -1;
  return soup;
}

// The same surface with vertices and faces in another order.
inline Soup renumbered(const Soup& soup, unsigned seed, std::vector<Index>& new_number)
{
  Random random(seed);
  const auto shuffled = [&](std::size_t n)
  {
    std::vector<Index> order(n);
    for(std::size_t i = 0; i < n; ++i)
    {
      order[i] = Index(i);
      std::swap(order[i], order[(std::min)(i, std::size_t(random(0, double(i + 1))))]);
    }
    return order;
  };
  new_number = shuffled(soup.points.size());
  Soup result = soup;
  for(std::size_t v = 0; v < soup.points.size(); ++v)
    result.points[new_number[v]] = soup.points[v];
  const std::vector<Index> order = shuffled(soup.triangles.size());
  for(std::size_t f = 0; f < soup.triangles.size(); ++f)
    for(std::size_t k = 0; k < 3; ++k)
      result.triangles[order[f]][(k + f) % 3] = new_number[soup.triangles[f][k]];
  return result;
}

// Every so many of the triangles are divided at the middle of their first side, if the triangle beyond that side is not divided as well. That one is
// either divided at the same point, or left as it is, with a triangle of no area between both. Returns the number of these.
inline std::size_t divide_at_middles(Soup& soup, std::size_t step, bool is_beyond_divided)
{
  std::map<std::pair<Index, Index>, std::size_t> triangle_of; // by side
  for(std::size_t f = 0; f < soup.triangles.size(); ++f)
    for(std::size_t k = 0; k < 3; ++k)
      triangle_of[{soup.triangles[f][k], soup.triangles[f][(k + 1) % 3]}] = f;
  std::vector<char> is_taken(soup.triangles.size(), 0);
  std::size_t number = 0;
  for(std::size_t f = 0, n = soup.triangles.size(); f < n; f += step)
  {
    const auto [a, b, c] = soup.triangles[f];
    const auto beyond = triangle_of.find({b, a});
    if(beyond == triangle_of.end() || is_taken[f] || is_taken[beyond->second])
      continue;
    const std::size_t g = beyond->second;
    is_taken[f] = is_taken[g] = 1;
    ++number;
    const Index m = Index(soup.points.size());
    const Point &p = soup.points[a], &q = soup.points[b];
    soup.points.push_back({{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2}});
    soup.triangles[f] = {{a, m, c}};
    soup.triangles.push_back({{m, b, c}});
    if(!is_beyond_divided)
    {
      soup.triangles.push_back({{a, b, m}});
      continue;
    }
    const Index d = soup.triangles[g][0] + soup.triangles[g][1] + soup.triangles[g][2] - a - b;
    soup.triangles[g] = {{b, m, d}};
    soup.triangles.push_back({{m, a, d}});
  }
  return number;
}

struct Named_soup
{
  std::string name;
  Soup soup;
};

// Bodies of n sides: closed ones, or, with lower caps that are open, disks.
inline std::vector<Named_soup> bodies_with_ties(Index n, bool is_closed)
{
  std::vector<Named_soup> result;
  const auto add = [&](std::string name, Soup soup) { result.push_back({name + " of " + std::to_string(n) + " sides", std::move(soup)}); };
  for(const double height : { .1, 1., 8. })
    for(const Cap cap : { Cap::CENTRE, Cap::CORNER, Cap::HALVED })
      for(const Index rings : { 1, 4 })
      {
        const std::string kind = " with cap " + std::to_string(int(cap)) + ", height " + std::to_string(height) + ", "
                               + std::to_string(rings) + " rings,";
        add("prism" + kind, prism(n, height, rings, is_closed ? cap : Cap::OPEN, cap));
        if(is_closed)
          add("cone" + kind, ring_cone(n, height, rings, cap));
      }
  for(const Index parallels : { 2, 5, 15 })
    add("sphere with " + std::to_string(parallels) + " parallels", uv_sphere(n, parallels, !is_closed));
  add("vase", body_of_revolution(n, {{1, 0}, {1.5, .5}, {.5, 1}, {.5, 2}, {1, 2.2}}, is_closed ? Cap::CENTRE : Cap::OPEN, Cap::CENTRE));
  add("reel", body_of_revolution(n, {{1, 0}, {1, 1}, {.2, 1}, {.2, 5}, {1, 5}, {1, 6}}, is_closed ? Cap::HALVED : Cap::OPEN, Cap::HALVED));
  return result;
}

} // namespace testing

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_SOLIDS_H
