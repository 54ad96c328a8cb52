// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// With --repair, and where it has to be said why a soup is refused: CGAL's functions for soups of polygons.

#include "../include/flatten_mesh/repair_soup.h"
#include "../include/flatten_mesh/mesh.h"
#include "../include/flatten_mesh/messages.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Union_find.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace flattening {

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

typedef std::uint32_t Index;

// A polygon as CGAL takes it, which keeps the number of its face when CGAL changes their order.
struct Numbered_polygon : std::vector<std::size_t>
{
  Index number = 0;

  Numbered_polygon() = default;
  template <typename Iterator>
  Numbered_polygon(Iterator begin, Iterator end, Index number) : std::vector<std::size_t>(begin, end), number(number) {}
};

typedef std::vector<Numbered_polygon> Polygons;

std::vector<Kernel::Point_3> points_of(const Polygon_soup& soup)
{
  std::vector<Kernel::Point_3> points;
  points.reserve(soup.points.size());
  for(const auto& p : soup.points)
    points.emplace_back(p[0], p[1], p[2]);
  return points;
}

Polygons polygons_of(const Polygon_soup& soup)
{
  Polygons polygons;
  polygons.reserve(soup.faces.size());
  for(std::size_t f = 0; f < soup.faces.size(); ++f)
    polygons.emplace_back(soup.faces[f].begin(), soup.faces[f].end(), static_cast<Index>(f));
  return polygons;
}

// ---- Edges

// One side of an edge: the face that passes it, in the direction from its first vertex or not.
struct Side
{
  std::array<std::size_t, 2> edge; // its vertices, the smaller one first
  Index face;
  bool is_forward;
  std::array<Index, 2> given_edge; // the same vertices as the file has them

  bool operator<(const Side& other) const { return edge < other.edge; }
};

// All sides, those of the same edge one after another. `given(i, k)` is the vertex of corner k of the polygon i as the file has it.
template <typename Given>
std::vector<Side> sides_of(const Polygons& polygons, Given given)
{
  std::vector<Side> sides;
  for(std::size_t i = 0; i < polygons.size(); ++i)
    for(std::size_t k = 0, n = polygons[i].size(); k < n; ++k)
    {
      const std::size_t l = (k + 1) % n, v = polygons[i][k], w = polygons[i][l];
      const Index a = given(i, k), b = given(i, l);
      sides.push_back({ {{ (std::min)(v, w), (std::max)(v, w) }}, polygons[i].number, v < w, {{ (std::min)(a, b), (std::max)(a, b) }} });
    }
  std::stable_sort(sides.begin(), sides.end());
  return sides;
}

// Calls `use(first, last)` for the sides of each edge.
template <typename Use>
void for_each_edge(const std::vector<Side>& sides, Use use)
{
  for(auto first = sides.begin(); first != sides.end(); )
  {
    const auto last = std::upper_bound(first, sides.end(), *first);
    use(first, last);
    first = last;
  }
}

// ---- Merging and dropping

// For each vertex that has a face the first of those with the same point, as CGAL finds them; for all others themselves.
std::vector<Index> find_representatives(const Polygon_soup& soup)
{
  std::vector<Kernel::Point_3> points = points_of(soup);
  Polygons polygons = polygons_of(soup);
  PMP::merge_duplicate_points_in_polygon_soup(points, polygons);
  const Index none = static_cast<Index>(soup.points.size());
  std::vector<Index> first(points.size(), none), representative(soup.points.size());
  std::iota(representative.begin(), representative.end(), Index(0));
  for(std::size_t f = 0; f < polygons.size(); ++f)
    for(std::size_t k = 0; k < polygons[f].size(); ++k)
      first[polygons[f][k]] = (std::min)(first[polygons[f][k]], soup.faces[f][k]);
  for(std::size_t f = 0; f < polygons.size(); ++f)
    for(std::size_t k = 0; k < polygons[f].size(); ++k)
      representative[soup.faces[f][k]] = first[polygons[f][k]];
  return representative;
}

// Corners one after another that are the same vertex become one corner.
void remove_repetitions(Numbered_polygon& polygon)
{
  polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
  while(polygon.size() > 1 && polygon.back() == polygon.front())
    polygon.pop_back();
}

// Divides a polygon that passes a vertex more than once into some that do not, of at least three vertices each.
void add_simple_parts(Numbered_polygon polygon, Polygons& parts)
{
  std::vector<std::size_t> path;
  for(std::size_t v : polygon)
  {
    const auto before = std::find(path.begin(), path.end(), v);
    if(path.end() - before >= 3)
      parts.emplace_back(before, path.end(), polygon.number);
    path.erase(before, path.end());
    path.push_back(v);
  }
  if(path.size() >= 3)
    parts.emplace_back(path.begin(), path.end(), polygon.number);
}

bool passes_a_vertex_twice(const Numbered_polygon& polygon)
{
  std::vector<std::size_t> sorted(polygon);
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

// What is left of the faces that have three different points or more.
Polygons without_degenerate_faces(Polygons polygons, Repair_counts& counts)
{
  Polygons kept;
  kept.reserve(polygons.size());
  for(Numbered_polygon& polygon : polygons)
  {
    remove_repetitions(polygon);
    const std::size_t before = kept.size();
    if(passes_a_vertex_twice(polygon))
      add_simple_parts(std::move(polygon), kept);
    else if(polygon.size() >= 3)
      kept.push_back(std::move(polygon));
    counts.degenerate_faces += kept.size() == before;
  }
  return kept;
}

// Of faces with the same points the first is kept.
void drop_duplicates(const std::vector<Kernel::Point_3>& points, Polygons& polygons, Repair_counts& counts)
{
  counts.duplicate_faces = PMP::merge_duplicate_polygons_in_polygon_soup(points, polygons);
  std::stable_sort(polygons.begin(), polygons.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
}

// The vertex of a corner of `polygon` as the face that it was has it.
Index given_vertex(const Polygon_soup& given, const std::vector<Index>& representative, const Numbered_polygon& polygon, std::size_t corner)
{
  const Polygon& face = given.faces[polygon.number];
  if(face.size() == polygon.size())
    return face[corner];
  return *std::find_if(face.begin(), face.end(), [&](Index v) { return representative[v] == polygon[corner]; });
}

// Edges of two faces that named them by different vertices.
std::size_t number_of_stitched_edges(const Polygon_soup& given, const std::vector<Index>& representative, const Polygons& polygons)
{
  const auto corner = [&](std::size_t i, std::size_t k) { return given_vertex(given, representative, polygons[i], k); };
  std::size_t number = 0;
  for_each_edge(sides_of(polygons, corner), [&](auto first, auto last)
  {
    number += last - first == 2 && first->given_edge != (first + 1)->given_edge;
  });
  return number;
}

// ---- Orientation

// What CGAL did when it oriented a soup. (CGAL copies it.)
struct Orientation_visitor : PMP::Default_orientation_visitor
{
  std::vector<std::size_t>* original; // by point: the one that it is a copy of
  std::vector<bool>* is_turned;       // by polygon

  Orientation_visitor(std::vector<std::size_t>& original, std::vector<bool>& is_turned) : original(&original), is_turned(&is_turned) {}

  void duplicated_vertex(std::size_t of, std::size_t copy)
  {
    original->resize((std::max)(original->size(), copy + 1));
    (*original)[copy] = (*original)[of];
  }
  void polygon_orientation_reversed(std::size_t i) { (*is_turned)[i] = ! (*is_turned)[i]; }
};

// A soup of polygons that CGAL has oriented, and taken apart where it was no manifold.
struct Oriented_polygons
{
  std::vector<Kernel::Point_3> points;
  Polygons polygons;
  std::vector<std::size_t> original;
  std::vector<bool> is_turned;

  Oriented_polygons(std::vector<Kernel::Point_3> given_points, Polygons given)
    : points(std::move(given_points)), polygons(std::move(given)), original(points.size()), is_turned(polygons.size(), false)
  {
    std::iota(original.begin(), original.end(), std::size_t(0));
    PMP::orient_polygon_soup(points, polygons, CGAL::parameters::visitor(Orientation_visitor(original, is_turned)));
  }

  Polygons before_copies() const
  {
    Polygons result = polygons;
    for(Numbered_polygon& polygon : result)
      for(std::size_t& v : polygon)
        v = original[v];
    return result;
  }
};

std::vector<Side> sides_before_copies(const Oriented_polygons& oriented)
{
  return sides_of(oriented.before_copies(), [](std::size_t, std::size_t) { return Index(0); });
}

// CGAL takes an edge of two faces apart if it finds no orientation of these with which the edge is passed in both directions.
std::optional<Orientation_conflict> find_conflict(const std::vector<Side>& sides)
{
  std::optional<Orientation_conflict> conflict;
  for_each_edge(sides, [&](auto first, auto last)
  {
    if(conflict || last - first != 2 || first->is_forward != (first + 1)->is_forward)
      return;
    const auto faces = std::minmax(first->face, (first + 1)->face);
    conflict = Orientation_conflict{ {{ faces.first, faces.second }},
                                     {{ static_cast<Index>(first->edge[0]), static_cast<Index>(first->edge[1]) }} };
  });
  return conflict;
}

std::size_t number_of_edges_of_many_faces(const std::vector<Side>& sides)
{
  std::size_t number = 0;
  for_each_edge(sides, [&](auto first, auto last) { number += last - first > 2; });
  return number;
}

// In every component the orientation that more of its faces had is kept.
void turn_the_fewer(Oriented_polygons& oriented)
{
  CGAL::Union_find<std::size_t> components;
  std::vector<CGAL::Union_find<std::size_t>::handle> handle;
  for(std::size_t v = 0; v < oriented.points.size(); ++v)
    handle.push_back(components.make_set(v));
  for(const Numbered_polygon& polygon : oriented.polygons)
    for(std::size_t v : polygon)
      components.unify_sets(handle[polygon.front()], handle[v]);

  const auto component = [&](const Numbered_polygon& polygon) { return *components.find(handle[polygon.front()]); };
  std::vector<std::ptrdiff_t> balance(oriented.points.size(), 0); // faces turned less faces kept
  for(std::size_t i = 0; i < oriented.polygons.size(); ++i)
    balance[component(oriented.polygons[i])] += oriented.is_turned[i] ? 1 : -1;
  for(std::size_t i = 0; i < oriented.polygons.size(); ++i)
    if(balance[component(oriented.polygons[i])] > 0)
    {
      std::reverse(oriented.polygons[i].begin(), oriented.polygons[i].end());
      oriented.is_turned[i] = ! oriented.is_turned[i];
    }
}

Polygon_soup soup_of(const Oriented_polygons& oriented)
{
  Polygon_soup soup;
  for(const Kernel::Point_3& p : oriented.points)
    soup.points.push_back({{ p.x(), p.y(), p.z() }});
  for(const Numbered_polygon& polygon : oriented.polygons)
  {
    soup.faces.emplace_back();
    for(std::size_t v : polygon)
      soup.faces.back().push_back(static_cast<Index>(v));
  }
  return soup;
}

} // namespace

std::string text_of(const Orientation_conflict& conflict)
{
  return text("the surface cannot be oriented, however its faces are turned: a way over it, as on a Moebius strip, returns with left and right "
              "exchanged (the faces ", conflict.faces[0], " and ", conflict.faces[1], " do not fit at the edge ", conflict.edge[0], "-",
              conflict.edge[1], ")");
}

std::optional<Orientation_conflict> find_orientation_conflict(const Polygon_soup& soup)
{
  return find_conflict(sides_before_copies(Oriented_polygons(points_of(soup), polygons_of(soup))));
}

Repaired_soup repair_soup(const Polygon_soup& given, const std::string& file)
{
  Repaired_soup result;
  result.representative = find_representatives(given);
  for(std::size_t v = 0; v < given.points.size(); ++v)
    result.counts.merged_vertices += result.representative[v] != v;

  Polygons polygons = polygons_of(given);
  for(Numbered_polygon& polygon : polygons)
    for(std::size_t& v : polygon)
      v = result.representative[v];
  polygons = without_degenerate_faces(std::move(polygons), result.counts);
  const std::vector<Kernel::Point_3> points = points_of(given);
  drop_duplicates(points, polygons, result.counts);
  result.counts.stitched_edges = number_of_stitched_edges(given, result.representative, polygons);

  Oriented_polygons oriented(points, std::move(polygons));
  const std::vector<Side> sides = sides_before_copies(oriented);
  if(const auto conflict = find_conflict(sides))
    fail(file, ": ", text_of(*conflict));
  turn_the_fewer(oriented);

  result.soup = soup_of(oriented);
  for(const Numbered_polygon& polygon : oriented.polygons)
    result.given_face.push_back(polygon.number);
  result.is_turned = oriented.is_turned;
  result.given_vertex.assign(oriented.original.begin(), oriented.original.end());
  result.counts.turned_faces = static_cast<std::size_t>(std::count(oriented.is_turned.begin(), oriented.is_turned.end(), true));
  result.counts.non_manifold_edges = number_of_edges_of_many_faces(sides);
  result.counts.copied_vertices = oriented.points.size() - points.size();
  return result;
}

} // namespace flattening
