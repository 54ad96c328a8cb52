// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/Polygon_soup.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/repair_soup.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <string>
#include <utility>
#include <vector>

namespace flattening {

void require_faces(const Polygon_soup& soup, const std::string& file)
{
  if(soup.faces.empty())
    fail(file, ": there are no faces", soup.notices.empty() ? "" : text(" (", soup.notices.front(), ")"));
}

void check_points(const Polygon_soup& soup, const std::string& file)
{
  for(std::size_t v = 0; v < soup.points.size(); ++v)
    for(double x : soup.points[v])
      if(! std::isfinite(x))
        fail(file, ": vertex ", v, " has the coordinate ", x, ", which is not a finite number");
}

namespace {

// The corners of the faces at each vertex: for a face (..., b, v, a, ...), in this cyclic order, `next` is a and `previous` is b.
class Vertex_stars
{
public:
  struct Corner
  {
    std::uint32_t next, previous, face;
    bool operator<(const Corner& c) const { return next < c.next; }
  };

  explicit Vertex_stars(const Polygon_soup& soup)
    : first_(soup.points.size() + 1, 0)
  {
    for(const Polygon& face : soup.faces)
      for(std::uint32_t v : face)
        ++first_[v + 1];
    for(std::size_t v = 0; v + 1 < first_.size(); ++v)
      first_[v + 1] += first_[v];
    corners_.resize(first_.back());
    std::vector<std::size_t> free = first_;
    for(std::size_t f = 0; f < soup.faces.size(); ++f)
    {
      const Polygon& face = soup.faces[f];
      const std::size_t n = face.size();
      for(std::size_t k = 0; k < n; ++k)
        corners_[free[face[k]]++] = { face[(k + 1) % n], face[(k + n - 1) % n], static_cast<std::uint32_t>(f) };
    }
    for(std::size_t v = 0; v + 1 < first_.size(); ++v)
      std::sort(corners_.begin() + std::ptrdiff_t(first_[v]), corners_.begin() + std::ptrdiff_t(first_[v + 1]));
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

// The vertex `v` is at two corners of the face `f`.
[[noreturn]] void fail_repeated_vertex(const Polygon_soup& soup, std::size_t f, std::uint32_t v, const std::string& file)
{
  const char* help = " twice (--repair drops or divides such faces)";
  if(! soup.vertices_are_points)
    fail(file, ": face ", f, " has the vertex ", v, help);
  const auto& p = soup.points[v];
  fail(file, ": points of face ", f, " coincide", soup.has_single_precision ? " in single precision, that of the file" : "",
       std::setprecision(soup.has_single_precision ? 9 : 17), ": it has (", p[0], ", ", p[1], ", ", p[2], ')', help);
}

void check_faces(const Polygon_soup& soup, const std::string& file)
{
  for(std::size_t f = 0; f < soup.faces.size(); ++f)
  {
    Polygon face = soup.faces[f];
    if(face.size() < 3)
      fail(file, ": face ", f, " has only ", face.size(), face.size() == 1 ? " vertex" : " vertices", " (--repair drops such faces)");
    std::sort(face.begin(), face.end());
    const auto twice = std::adjacent_find(face.begin(), face.end());
    if(twice != face.end())
      fail_repeated_vertex(soup, f, *twice, file);
  }
}

// The same face, beginning with its smallest vertex, and in the direction of the smaller one of its neighbours.
Polygon canonical(Polygon face)
{
  std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
  if(face.back() < face[1])
    std::reverse(face.begin() + 1, face.end());
  return face;
}

// Fails if two of these faces, sorted, are the same, up to orientation.
void refuse_duplicates(const Polygon_soup& soup, const std::vector<std::uint32_t>& faces, const std::string& file)
{
  for(std::size_t j = 1; j < faces.size() && j < 10; ++j)
    for(std::size_t i = 0; i < j; ++i)
      if(canonical(soup.faces[faces[i]]) == canonical(soup.faces[faces[j]]))
        fail(file, ": the faces ", faces[i], " and ", faces[j], " have the same vertices (--repair drops all but one of such faces)");
}

// Says why two faces that pass an edge v-w in the same direction cannot stay as they are.
[[noreturn]] void fail_to_orient(const Polygon_soup& soup, std::uint32_t f, std::uint32_t g, std::size_t v, std::size_t w, const std::string& file)
{
  if(const auto conflict = find_orientation_conflict(soup))
    fail(file, ": ", text_of(*conflict));
  fail(file, ": the faces ", f, " and ", g, " have opposite orientations at the edge ", v, "-", w, " (--repair turns faces)");
}

// No edge in more than two faces, nor passed twice in the same direction. Returns the number of edges.
std::size_t check_edges(const Polygon_soup& soup, const Vertex_stars& stars, const std::string& file)
{
  std::size_t number_of_edges = 0;
  for(std::size_t v = 0; v < stars.number_of_vertices(); ++v)
    for(auto c = stars.begin(v); c != stars.end(v); )
    {
      const std::uint32_t w = c->next;
      const auto there = stars.towards(v, w), back = stars.towards(w, static_cast<std::uint32_t>(v));
      const std::ptrdiff_t n = there.second - there.first, m = back.second - back.first;
      if(n + m > 2 || n == 2)
      {
        std::vector<std::uint32_t> faces;
        for(const auto& range : {there, back})
          for(auto d = range.first; d != range.second; ++d)
            faces.push_back(d->face);
        std::sort(faces.begin(), faces.end());
        refuse_duplicates(soup, faces, file);
        if(n + m > 2)
          fail(file, ": not a manifold: the edge ", v, "-", w, " lies in ", n + m, " faces (", faces[0], ", ", faces[1],
               ", ...) (--repair takes them apart)");
        fail_to_orient(soup, faces[0], faces[1], v, w, file);
      }
      number_of_edges += (m == 0 || v < w);
      c = there.second;
    }
  return number_of_edges;
}

// The faces at a vertex, one after the other around it: returns how many
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

// The faces at each vertex form one fan.
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
      fail(file, ": not a manifold: the faces at the vertex ", v, " form more than one fan (--repair takes them apart)");
  }
}

} // namespace

void check_soup(Polygon_soup& soup, const std::string& file)
{
  require_faces(soup, file);
  check_points(soup, file);
  check_faces(soup, file);
  const Vertex_stars stars(soup);
  soup.number_of_edges = check_edges(soup, stars, file);
  check_vertices(stars, file);
}

} // namespace flattening
