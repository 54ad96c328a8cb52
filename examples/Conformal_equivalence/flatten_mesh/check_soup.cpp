// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/Triangle_soup.h"
#include "../include/flatten_mesh/messages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace flattening {

void check_points(const Triangle_soup& soup, const std::string& file)
{
  for(std::size_t v = 0; v < soup.points.size(); ++v)
    for(double x : soup.points[v])
      if(! std::isfinite(x))
        fail(file, ": vertex ", v, " has the coordinate ", x, ", which is not a finite number");
}

namespace {

// The corners of the triangles at each vertex: for the triangle (v, a, b), in
// this cyclic order, `next` is a and `previous` is b.
class Vertex_stars
{
public:
  struct Corner
  {
    std::uint32_t next, previous, face;
    bool operator<(const Corner& c) const { return next < c.next; }
  };

  explicit Vertex_stars(const Triangle_soup& soup)
    : first_(soup.points.size() + 1, 0), corners_(3 * soup.triangles.size())
  {
    for(const auto& t : soup.triangles)
      for(std::uint32_t v : t)
        ++first_[v + 1];
    for(std::size_t v = 0; v + 1 < first_.size(); ++v)
      first_[v + 1] += first_[v];
    std::vector<std::size_t> free = first_;
    for(std::size_t f = 0; f < soup.triangles.size(); ++f)
    {
      const auto& t = soup.triangles[f];
      for(std::size_t k = 0; k < 3; ++k)
        corners_[free[t[k]]++] = { t[(k + 1) % 3], t[(k + 2) % 3], static_cast<std::uint32_t>(f) };
    }
    for(std::size_t v = 0; v + 1 < first_.size(); ++v)
      std::sort(corners_.begin() + first_[v], corners_.begin() + first_[v + 1]);
  }

  std::size_t number_of_vertices() const { return first_.size() - 1; }
  const Corner* begin(std::size_t v) const { return corners_.data() + first_[v]; }
  const Corner* end(std::size_t v) const { return corners_.data() + first_[v + 1]; }

  // the corners at v whose edge towards `next` leads to w
  std::pair<const Corner*, const Corner*> towards(std::size_t v, std::uint32_t w) const
  {
    return std::equal_range(begin(v), end(v), Corner{w, 0, 0});
  }

private:
  std::vector<std::size_t> first_;
  std::vector<Corner> corners_;
};

void check_triangles(const Triangle_soup& soup, const std::string& file)
{
  for(std::size_t f = 0; f < soup.triangles.size(); ++f)
  {
    const auto& t = soup.triangles[f];
    for(std::size_t k = 0; k < 3; ++k)
      if(t[k] == t[(k + 1) % 3])
        fail(file, ": face ", f, " has the vertex ", t[k], " twice");
  }
}

// No edge in more than two triangles, nor passed twice in the same direction.
// Returns the number of edges.
std::size_t check_edges(const Vertex_stars& stars, const std::string& file)
{
  std::size_t number_of_edges = 0;
  for(std::size_t v = 0; v < stars.number_of_vertices(); ++v)
    for(auto c = stars.begin(v); c != stars.end(v); )
    {
      const std::uint32_t w = c->next;
      const auto there = stars.towards(v, w), back = stars.towards(w, static_cast<std::uint32_t>(v));
      const std::ptrdiff_t n = there.second - there.first, m = back.second - back.first;
      if(n + m > 2)
        fail(file, ": not a manifold: the edge ", v, "-", w, " lies in ", n + m, " faces (",
             c->face, ", ", (c + 1 < there.second ? c + 1 : back.first)->face, ", ...)");
      if(n == 2)
        fail(file, ": the faces ", c->face, " and ", (c + 1)->face, " have opposite orientations at the edge ", v, "-", w);
      number_of_edges += (m == 0 || v < w);
      c = there.second;
    }
  return number_of_edges;
}

// The triangles at a vertex, one after the other around it: returns how many
// are reached from `c`. `first` is set where the fan has a beginning.
std::size_t size_of_fan(const Vertex_stars& stars, std::size_t v, const Vertex_stars::Corner* c)
{
  std::size_t n = 0;
  const auto first = c;
  do
  {
    ++n;
    const auto range = stars.towards(v, c->previous);
    c = range.first == range.second ? first : range.first;
  }
  while(c != first);
  return n;
}

// The triangles at each vertex form one fan.
void check_vertices(const Vertex_stars& stars, const std::string& file)
{
  for(std::size_t v = 0; v < stars.number_of_vertices(); ++v)
  {
    const std::size_t degree = static_cast<std::size_t>(stars.end(v) - stars.begin(v));
    if(degree == 0)
      continue;
    auto first = stars.begin(v);
    for(auto c = stars.begin(v); c != stars.end(v); ++c)
    {
      const auto before = stars.towards(c->next, static_cast<std::uint32_t>(v));
      if(before.first == before.second) // the edge v-next is a border: a fan begins here
        first = c;
    }
    if(size_of_fan(stars, v, first) != degree)
      fail(file, ": not a manifold: the faces at the vertex ", v, " form more than one fan");
  }
}

} // namespace

void check_soup(Triangle_soup& soup, const std::string& file)
{
  if(soup.triangles.empty())
    fail(file, ": there are no faces");
  check_points(soup, file);
  check_triangles(soup, file);
  const Vertex_stars stars(soup);
  soup.number_of_edges = check_edges(stars, file);
  check_vertices(stars, file);
}

} // namespace flattening
