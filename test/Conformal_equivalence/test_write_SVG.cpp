// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Seams and cones in drawings, of surfaces unfolded by hand; and what the checker of check_flattening.h
// says about seams, cones and pieces of the same layouts.

#define BOOST_TEST_MODULE test_write_SVG
#include "include/check_seams.h"
#include "include/flattened_meshes.h"
#include "include/tolerances.h"

#include "../../examples/Conformal_equivalence/include/flatten_mesh/page_data.h"
#include "../../examples/Conformal_equivalence/include/flatten_mesh/write_SVG.h"

#include <CGAL/Polyhedron_3.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
using testing::Edge;
using testing::Face;
using testing::Halfedge;
using testing::Index;
using testing::Kernel;
using testing::Mesh;
using testing::Point_2;
using testing::Point_3;
using testing::Soup;
using testing::Vertex;

namespace {

// --- surfaces and their layouts -------------------------------------------------------------------------

typedef Mesh::Property_map<Halfedge, Point_2> UV;

struct Unfolded
{
  Mesh mesh;
  UV uv;
};

typedef std::array<Point_2, 3> Place; // of the corners of a triangle, in the order of the soup

Unfolded unfolded(const Soup& soup, const std::function<Place(Index)>& place)
{
  Unfolded result;
  result.mesh = testing::surface_mesh<Mesh>(soup);
  result.uv = result.mesh.add_property_map<Halfedge, Point_2>("h:uv").first;
  for(Index f = 0; f < soup.triangles.size(); ++f)
    for(Halfedge h : CGAL::halfedges_around_face(result.mesh.halfedge(Face(f)), result.mesh))
      for(std::size_t k = 0; k < 3; ++k)
        if(Index(result.mesh.target(h)) == soup.triangles[f][k])
          result.uv[h] = place(f)[k];
  return result;
}

// Quads, each cut along a diagonal, at given places.
Unfolded unfolded_quads(const std::vector<testing::Point>& points, const std::vector<std::array<Index, 4> >& quads,
                        const std::vector<std::array<Point_2, 4> >& places)
{
  Soup soup;
  soup.points = points;
  for(const auto& q : quads)
  {
    soup.triangles.push_back({{q[0], q[1], q[2]}});
    soup.triangles.push_back({{q[0], q[2], q[3]}});
  }
  return unfolded(soup, [&](Index f)
  {
    const auto& p = places[f / 2];
    return f % 2 == 0 ? Place{{p[0], p[1], p[2]}} : Place{{p[0], p[2], p[3]}};
  });
}

std::array<Point_2, 4> square(double x, double y)
{
  return {{Point_2(x, y), Point_2(x + 1, y), Point_2(x + 1, y + 1), Point_2(x, y + 1)}};
}

// A cube as a cross: four squares in a row, and one above and below the first.
Unfolded cube()
{
  std::vector<testing::Point> points;
  for(int i = 0; i < 8; ++i)
    points.push_back({{double(i & 1), double(i >> 1 & 1), double(i >> 2)}});
  return unfolded_quads(points,
    {{{0, 1, 5, 4}}, {{1, 3, 7, 5}}, {{3, 2, 6, 7}}, {{2, 0, 4, 6}}, {{4, 5, 7, 6}}, {{2, 3, 1, 0}}},
    {square(0, 0), square(1, 0), square(2, 0), square(3, 0), square(0, 1), square(0, -1)});
}

// An octahedron's surface as a strip of six triangles, and one more on either side.
Unfolded octahedron()
{
  Soup soup{{{{1, 0, 0}}, {{-1, 0, 0}}, {{0, 1, 0}}, {{0, -1, 0}}, {{0, 0, 1}}, {{0, 0, -1}}},
            {{{0, 2, 4}}, {{2, 0, 5}}, {{2, 1, 4}}, {{1, 2, 5}}, {{1, 3, 4}}, {{3, 1, 5}}, {{3, 0, 4}}, {{0, 3, 5}}}};
  const double s = std::sqrt(2.), t = std::sqrt(1.5);
  // the equator is 0, 2, 1, 3: a comb of four triangles above it and four below it
  return unfolded(soup, [=](Index f)
  {
    const double x = (f / 2) * s;
    return f % 2 == 0 ? Place{{Point_2(x, 0), Point_2(x + s, 0), Point_2(x + s / 2, t)}}
                      : Place{{Point_2(x + s, 0), Point_2(x, 0), Point_2(x + s / 2, -t)}};
  });
}

// m x n squares side by side; columns, and rows if `closes_up`, are counted modulo m and n.
Unfolded squares(Index m, Index n, bool closes_up)
{
  const Index rows = closes_up ? n : n + 1;
  std::vector<testing::Point> points;
  for(Index j = 0; j < rows; ++j)
    for(Index i = 0; i < m; ++i)
      points.push_back({{double(i), double(j), double((i * j) % 3)}}); // only to tell them apart
  std::vector<std::array<Index, 4> > quads;
  std::vector<std::array<Point_2, 4> > places;
  for(Index j = 0; j < n; ++j)
    for(Index i = 0; i < m; ++i)
    {
      const Index r = (i + 1) % m, u = (j + 1) % rows;
      quads.push_back({{j * m + i, j * m + r, u * m + r, u * m + i}});
      places.push_back(square(i, j));
    }
  return unfolded_quads(points, quads, places);
}

Unfolded torus(Index m, Index n) { return squares(m, n, true); }
Unfolded ring(Index m, Index n) { return squares(m, n, false); }

// Two pyramids base to base, each laid flat by itself, apart from the other.
Unfolded two_pieces()
{
  Soup soup{{{{1, 0, 0}}, {{0, 1, 0}}, {{-1, 0, 0}}, {{0, -1, 0}}, {{0, 0, 1}}, {{0, 0, -1}}}, {}};
  for(Index i = 0; i < 4; ++i)
    soup.triangles.push_back({{4, i, (i + 1) % 4}});
  for(Index i = 0; i < 4; ++i)
    soup.triangles.push_back({{5, (i + 1) % 4, i}});
  return unfolded(soup, [](Index f)
  {
    const std::array<Point_2, 4> p = {{Point_2(1, 0), Point_2(0, 1), Point_2(-1, 0), Point_2(0, -1)}};
    if(f < 4)
      return Place{{Point_2(0, 0), p[f], p[(f + 1) % 4]}};
    const Point_2 q = p[f - 4], r = p[(f - 3) % 4]; // in a mirror
    return Place{{Point_2(5, 0), Point_2(5 - r.x(), r.y()), Point_2(5 - q.x(), q.y())}};
  });
}

// --- drawings -------------------------------------------------------------------------------------------

typedef std::pair<double, double> Dot;
typedef std::vector<Dot> Polyline;

struct Drawn_seam
{
  std::string color;
  std::vector<Polyline> sides;
};

template <typename TriangleMesh, typename UVMap>
std::string drawing(const TriangleMesh& tm, UVMap uv, const flattening::SVG_options& options = flattening::SVG_options())
{
  std::ostringstream out;
  const boost::static_property_map<double, Face> colors(1.);
  BOOST_TEST(flattening::write_SVG(out, tm, uv, colors, options));
  return out.str();
}

std::string group(const std::string& svg, const std::string& id)
{
  const std::size_t begin = svg.find("<g id=\"" + id + "\"");
  return begin == std::string::npos ? "" : svg.substr(begin, svg.find("</g>", begin) - begin);
}

std::string attribute(const std::string& text, const std::string& name, std::size_t position)
{
  const std::size_t begin = text.find(' ' + name + "=\"", position) + name.size() + 3;
  return text.substr(begin, text.find('"', begin) - begin);
}

template <typename Read>
void for_each_element(const std::string& text, const std::string& tag, const Read& read)
{
  for(std::size_t i = text.find("<" + tag + " "); i != std::string::npos; i = text.find("<" + tag + " ", i + 1))
    read(i);
}

// M x y l x y l x y ..., in hundredths
std::vector<Polyline> read_path(const std::string& d)
{
  std::vector<Polyline> result;
  std::istringstream in(d);
  char command;
  double x, y;
  while(in >> command >> x >> y)
    if(command == 'M')
      result.push_back({Dot(x, y)});
    else
      result.back().push_back(Dot(result.back().back().first + x, result.back().back().second + y));
  return result;
}

std::vector<Drawn_seam> drawn_seams(const std::string& svg)
{
  const std::string seams = group(svg, "seams");
  std::vector<Drawn_seam> result;
  for_each_element(seams, "path", [&](std::size_t i)
    { result.push_back({attribute(seams, "stroke", i), read_path(attribute(seams, "d", i))}); });
  return result;
}

// how often each text from `begin` to `end` is in the elements of a group
std::map<std::string, int> counted_texts(const std::string& svg, const std::string& id, const std::string& tag, const std::string& begin,
                                         const std::string& end)
{
  const std::string elements = group(svg, id);
  std::map<std::string, int> result;
  for_each_element(elements, tag, [&](std::size_t i)
  {
    const std::size_t from = elements.find(begin, i) + begin.size();
    ++result[elements.substr(from, elements.find(end, from) - from)];
  });
  return result;
}

// how many dots there are of each title
std::map<std::string, int> drawn_cones(const std::string& svg) { return counted_texts(svg, "cones", "circle", "<title>", "</title>"); }

std::vector<double> lengths(const Polyline& line)
{
  std::vector<double> result;
  for(std::size_t i = 1; i < line.size(); ++i)
    result.push_back(std::hypot(line[i].first - line[i - 1].first, line[i].second - line[i - 1].second));
  return result;
}

// Each has two sides of `edges` edges; these are equally long but for the rounding to a grid.
void check_sides(const std::vector<Drawn_seam>& seams, std::size_t edges)
{
  for(const Drawn_seam& seam : seams)
  {
    BOOST_TEST_REQUIRE(seam.sides.size() == 2u);
    const std::vector<double> a = lengths(seam.sides[0]), b = lengths(seam.sides[1]);
    BOOST_TEST_REQUIRE(a.size() == edges);
    BOOST_TEST_REQUIRE(b.size() == edges);
    for(std::size_t i = 0; i < edges; ++i)
      BOOST_TEST(std::abs(a[i] - b[i]) <= 3.);
    BOOST_TEST((seam.sides[0] != seam.sides[1]));
  }
}

std::size_t number_of_colors(const std::vector<Drawn_seam>& seams)
{
  std::set<std::string> colors;
  for(const Drawn_seam& seam : seams)
    colors.insert(seam.color);
  return colors.size();
}

flattening::SVG_options without_cones()
{
  flattening::SVG_options options;
  options.cones = false;
  return options;
}

} // namespace

// ------------------------------------------------------------------------------------------------
// Seams and cones of solids
// ------------------------------------------------------------------------------------------------

// The edges of a cube that the cross cuts are 12 - 5; each joins two cones.
BOOST_AUTO_TEST_CASE(a_cube_as_a_cross)
{
  const Unfolded surface = cube();
  const std::string svg = drawing(surface.mesh, surface.uv);
  const std::vector<Drawn_seam> seams = drawn_seams(svg);
  BOOST_TEST(seams.size() == 7u);
  check_sides(seams, 1);
  for(const Drawn_seam& seam : seams)
    BOOST_TEST(lengths(seam.sides[0])[0] == 100 * 250.); // the drawing is 1000 wide
  BOOST_TEST(number_of_colors(seams) == 7u);

  const std::map<std::string, int> cones = drawn_cones(svg);
  BOOST_TEST(cones.size() == 8u);
  int dots = 0;
  for(std::size_t v = 0; v < 8; ++v)
  {
    const auto cone = cones.find("vertex " + std::to_string(v) + ", angle: 270 degrees");
    BOOST_TEST_REQUIRE((cone != cones.end()));
    dots += cone->second;
  }
  BOOST_TEST(dots == 14); // the corners of the cross
  BOOST_TEST(svg.find("id=\"outline\"") < svg.find("id=\"seams\""));
  BOOST_TEST(svg.find("id=\"seams\"") < svg.find("id=\"cones\""));
}

BOOST_AUTO_TEST_CASE(an_octahedron_as_a_comb)
{
  const Unfolded surface = octahedron();
  const std::string svg = drawing(surface.mesh, surface.uv);
  const std::vector<Drawn_seam> seams = drawn_seams(svg);
  BOOST_TEST(seams.size() == 8u); // 12 edges, four of them along the comb
  check_sides(seams, 1);
  const std::map<std::string, int> cones = drawn_cones(svg);
  BOOST_TEST(cones.size() == 6u);
  for(std::size_t v = 0; v < 6; ++v)
    BOOST_TEST(cones.count("vertex " + std::to_string(v) + ", angle: 240 degrees") == 1u);
  // an apex of each tooth; the ends of the comb, and of the three vertices between them one place each
  const std::vector<int> dots = {2, 1, 1, 1, 4, 4};
  for(std::size_t v = 0; v < 6; ++v)
    BOOST_TEST(cones.at("vertex " + std::to_string(v) + ", angle: 240 degrees") == dots[v]);
}

BOOST_AUTO_TEST_CASE(seams_and_cones_can_be_left_out)
{
  const Unfolded surface = cube();
  flattening::SVG_options options;
  options.seams = false;
  std::string svg = drawing(surface.mesh, surface.uv, options);
  BOOST_TEST(drawn_seams(svg).empty());
  BOOST_TEST(drawn_cones(svg).size() == 8u);

  svg = drawing(surface.mesh, surface.uv, without_cones());
  BOOST_TEST(drawn_cones(svg).empty());
  // paths end only where not two seam edges meet
  std::map<Vertex, int> degree;
  for(Edge e : surface.mesh.edges())
    if(flattening::is_outline(surface.mesh, surface.uv, surface.mesh.halfedge(e)))
      for(int i : {0, 1})
        ++degree[surface.mesh.vertex(e, i)];
  int ends = 0;
  for(const auto& entry : degree)
    ends += entry.second == 2 ? 0 : entry.second;
  BOOST_TEST(int(drawn_seams(svg).size()) == ends / 2);
}

// ------------------------------------------------------------------------------------------------
// Flat surfaces
// ------------------------------------------------------------------------------------------------

// Two closed paths that meet at a vertex.
BOOST_AUTO_TEST_CASE(a_torus_as_a_rectangle)
{
  const Unfolded surface = torus(5, 5);
  const std::string svg = drawing(surface.mesh, surface.uv);
  const std::vector<Drawn_seam> seams = drawn_seams(svg);
  BOOST_TEST(seams.size() == 2u);
  check_sides(seams, 5);
  BOOST_TEST(number_of_colors(seams) == 2u);
  BOOST_TEST(svg.find("id=\"cones\"") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_ring_as_a_rectangle)
{
  const Unfolded surface = ring(6, 4);
  const std::string svg = drawing(surface.mesh, surface.uv);
  const std::vector<Drawn_seam> seams = drawn_seams(svg);
  BOOST_TEST(seams.size() == 1u);
  check_sides(seams, 4);
  BOOST_TEST(svg.find("id=\"cones\"") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_disk_has_neither)
{
  Mesh mesh = testing::surface_mesh<Mesh>(testing::hill(6, .3));
  UV uv = mesh.add_property_map<Halfedge, Point_2>("h:uv").first;
  for(Halfedge h : mesh.halfedges())
    uv[h] = Point_2(mesh.point(mesh.target(h)).x(), mesh.point(mesh.target(h)).y());
  flattening::SVG_options neither;
  neither.seams = neither.cones = false;
  const std::string svg = drawing(mesh, uv);
  BOOST_TEST(svg == drawing(mesh, uv, neither));
  BOOST_TEST(svg.find("<circle") == std::string::npos);

  // not even if a vertex is drawn outside of its neighbours
  const Vertex inside(24);
  BOOST_TEST_REQUIRE(! CGAL::is_border(inside, mesh));
  for(Halfedge h : CGAL::halfedges_around_target(inside, mesh))
    uv[h] = Point_2(7, 5);
  BOOST_TEST(drawing(mesh, uv) == drawing(mesh, uv, neither));
}

BOOST_AUTO_TEST_CASE(pieces)
{
  const Unfolded surface = two_pieces();
  std::vector<Drawn_seam> seams = drawn_seams(drawing(surface.mesh, surface.uv, without_cones()));
  BOOST_TEST(seams.size() == 1u); // a closed path: the equator
  check_sides(seams, 4);
  BOOST_TEST((seams[0].sides[0].front() == seams[0].sides[0].back()));

  const std::string svg = drawing(surface.mesh, surface.uv);
  seams = drawn_seams(svg);
  BOOST_TEST(seams.size() == 4u);
  check_sides(seams, 1);
  BOOST_TEST(drawn_cones(svg).size() == 4u);
  for(const auto& cone : drawn_cones(svg))
  {
    BOOST_TEST(cone.first.substr(cone.first.find(',')) == ", angle: 180 degrees");
    BOOST_TEST(cone.second == 2);
  }
}

// Around a cone of 4 pi the layout closes up: no seam is seen there, but the cone is.
BOOST_AUTO_TEST_CASE(a_branch_point)
{
  const Index n = 8;
  const Unfolded surface = unfolded(testing::cone(n, 1), [](Index f)
  {
    const std::array<Point_2, 4> p = {{Point_2(1, 0), Point_2(0, 1), Point_2(-1, 0), Point_2(0, -1)}};
    return Place{{Point_2(0, 0), p[f % 4], p[(f + 1) % 4]}};
  });
  const std::string svg = drawing(surface.mesh, surface.uv);
  BOOST_TEST(drawn_seams(svg).empty());
  BOOST_TEST((drawn_cones(svg) == std::map<std::string, int>{{"vertex 0, angle: 720 degrees", 1}}));
}

// ------------------------------------------------------------------------------------------------
// Many paths, other types, bad numbers
// ------------------------------------------------------------------------------------------------

// Every triangle by itself: each edge is a path, and six paths at a vertex have six colours.
BOOST_AUTO_TEST_CASE(neighbouring_paths_have_different_colors)
{
  Unfolded surface = torus(12, 12);
  std::map<Vertex, std::set<std::string> > colors;
  std::map<Dot, Vertex> vertex_at;
  flattening::SVG_options options;
  options.size = 12 + 17 * 12;
  for(Face f : surface.mesh.faces())
    for(Halfedge h : CGAL::halfedges_around_face(surface.mesh.halfedge(f), surface.mesh))
    {
      const Point_2 p = surface.uv[h];
      const Index column = Index(f) % 17, row = Index(f) / 17;
      surface.uv[h] = Point_2(p.x() + 13 * column, p.y() + 13 * row);
    }
  flattening::Finite_range x, y;
  for(Halfedge h : surface.mesh.halfedges())
  {
    x.insert(surface.uv[h].x());
    y.insert(surface.uv[h].y());
  }
  options.size = (std::max)(x.upper - x.lower, y.upper - y.lower); // a unit of the layout is one of the drawing
  for(Halfedge h : surface.mesh.halfedges())
    vertex_at[Dot(100 * (surface.uv[h].x() - x.lower), 100 * (y.upper - surface.uv[h].y()))] = surface.mesh.target(h);

  const std::string svg = drawing(surface.mesh, surface.uv, options);
  const std::vector<Drawn_seam> seams = drawn_seams(svg);
  BOOST_TEST(seams.size() == surface.mesh.number_of_edges());
  check_sides(seams, 1);
  for(const Drawn_seam& seam : seams)
  {
    const Vertex a = vertex_at.at(seam.sides[0].front()), b = vertex_at.at(seam.sides[0].back());
    BOOST_TEST((vertex_at.at(seam.sides[1].front()) == a)); // the other side, in the same direction
    BOOST_TEST((vertex_at.at(seam.sides[1].back()) == b));
    colors[a].insert(seam.color);
    colors[b].insert(seam.color);
  }
  for(const auto& entry : colors)
    BOOST_TEST(entry.second.size() == 6u);
  BOOST_TEST(number_of_colors(seams) == seams.size()); // 432 of them
  BOOST_TEST(drawn_cones(svg).empty());
}

// Points that fill a square evenly are about 1 / sqrt(n) apart; here that is some part of the 255 steps of a channel.
BOOST_AUTO_TEST_CASE(colors_are_told_apart)
{
  const auto distance = [](const flattening::RGB& a, const flattening::RGB& b)
    { return std::hypot(double(a[0]) - b[0], double(a[1]) - b[1], double(a[2]) - b[2]); };
  for(const std::size_t n : {17, 40, 100})
    for(std::size_t i = 0; i < n; ++i)
      for(std::size_t j = 0; j < i; ++j)
        BOOST_TEST(distance(flattening::distinct_color(i), flattening::distinct_color(j)) > 60 / std::sqrt(double(n)));
}

// ------------------------------------------------------------------------------------------------
// Tiles of seamless layouts
// ------------------------------------------------------------------------------------------------

namespace {

std::string tiles_path(const std::string& svg)
{
  const std::size_t begin = svg.find("<path id=\"tiles\"");
  return begin == std::string::npos ? "" : attribute(svg, "d", begin);
}

// The layout of a unit square with its lower left corner at (x, y), `side` wide.
std::string drawing_of_square(double x, double y, double side, int tiles, double size)
{
  const Unfolded surface = unfolded_quads({{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}, {{0, 1, 0}}}, {{{0, 1, 2, 3}}},
    {{{Point_2(x, y), Point_2(x + side, y), Point_2(x + side, y + side), Point_2(x, y + side)}}});
  flattening::SVG_options options;
  options.checkerboard = false;
  options.tiles = tiles;
  options.size = size;
  return drawing(surface.mesh, surface.uv, options);
}

} // namespace

BOOST_AUTO_TEST_CASE(squares_have_integers_in_their_centres)
{
  for(int n : {2, 4})
  {
    // [-3.2, 6.8]^2, a unit is one of the drawing: in hundredths x lies at 100 (x + 3.2), y at 100 (6.8 - y)
    const std::string svg = drawing_of_square(-3.2, -3.2, 10, n, 10);
    const std::vector<Polyline> lines = read_path(tiles_path(svg));
    std::set<double> x, y;
    for(const Polyline& line : lines)
    {
      BOOST_TEST_REQUIRE(line.size() == 2u);
      const bool is_vertical = line[0].first == line[1].first;
      BOOST_TEST((is_vertical || line[0].second == line[1].second));
      BOOST_TEST(lengths(line)[0] == 1000.);
      if(is_vertical)
        x.insert(line[0].first);
      else
        y.insert(line[0].second);
    }
    std::set<double> expected_x, expected_y;
    for(int k = -3; k <= 6; ++k)
    {
      expected_x.insert(std::round(100 * (k + .5 + 3.2)));
      expected_y.insert(std::round(100 * (6.8 - k - .5)));
    }
    BOOST_TEST(x == expected_x, boost::test_tools::per_element());
    BOOST_TEST(y == expected_y, boost::test_tools::per_element());
    BOOST_TEST(lines.size() == 20u);
    BOOST_TEST(svg.find("id=\"triangles\"") < svg.find("id=\"tiles\""));
    BOOST_TEST(svg.find("id=\"tiles\"") < svg.find("id=\"edges\""));
  }
  for(int n : {0, 1, 5, -4})
    BOOST_TEST(tiles_path(drawing_of_square(-3.2, -3.2, 10, n, 10)).empty());
}

// Where there are very many, squares of an odd number of tiles.
BOOST_AUTO_TEST_CASE(the_number_of_lines_is_bounded)
{
  for(const double side : {490., 600., 5e4, 1e7})
  {
    const std::vector<Polyline> lines = read_path(tiles_path(drawing_of_square(.25, .25, side, 4, 1e6)));
    BOOST_TEST(lines.size() <= 1002u);
    BOOST_TEST(lines.size() >= 300u);
    std::vector<double> x;
    for(const Polyline& line : lines)
      if(line[0].first == line[1].first)
        x.push_back(line[0].first * side / 1e8 + .25);
    std::sort(x.begin(), x.end());
    BOOST_TEST_REQUIRE(x.size() > 1u);
    const double tiles = (x.back() - x.front()) / double(x.size() - 1);
    const double dot = side / 1e8; // coordinates are rounded to whole ones, so that two lines may be one dot nearer or farther
    BOOST_TEST(std::abs(tiles - std::round(tiles)) <= dot / double(x.size() - 1));
    BOOST_TEST(std::fmod(std::round(tiles), 2) == 1);
    BOOST_TEST(std::abs(x.front() / tiles - std::round(x.front() / tiles - .5) - .5) <= dot / tiles); // half a dot, and what `tiles` is off
  }
  BOOST_TEST(read_path(tiles_path(drawing_of_square(.25, .25, 1e14, 4, 1000))).size() <= 1002u);
  for(const double side : {1e16, 1e300})
    BOOST_TEST(tiles_path(drawing_of_square(.25, .25, side, 4, 1000)).empty());
  BOOST_TEST(tiles_path(drawing_of_square(1e16, 1e16, 1e3, 4, 1000)).empty()); // the integers are not to be told apart there
  BOOST_TEST(tiles_path(drawing_of_square(0, 0, 1e3, 6, 1000)).empty());
  BOOST_TEST(tiles_path(drawing_of_square(0, 0, 1e300, 3, 1000)).empty());
}

// All edges are 1 / sqrt(3) long; the corners are as far from the nearest points of the lattice, three of them each.
BOOST_AUTO_TEST_CASE(hexagons_have_points_of_the_lattice_in_their_centres)
{
  for(int n : {3, 6})
  {
    const double scale = 1e4; // hundredths in a unit
    const double rounding = std::sqrt(2.) / scale; // of an edge: either end is off by half a hundredth in x and in y. Of a corner it is half of that
    const std::vector<Polyline> lines = read_path(tiles_path(drawing_of_square(-3.2, -2.1, 10, n, 1000)));
    BOOST_TEST(lines.size() > 110u); // 100 / area of a hexagon, and those at the rim
    BOOST_TEST(lines.size() < 170u);
    std::set<std::pair<int, int> > corners; // seen in the inner part
    for(const Polyline& line : lines)
    {
      BOOST_TEST_REQUIRE(line.size() == 4u);
      for(double l : lengths(line))
        BOOST_TEST(std::abs(l / scale - 1 / std::sqrt(3.)) <= rounding);
      for(const Dot& dot : line)
      {
        const double x = dot.first / scale - 3.2, y = 10 - 2.1 - dot.second / scale;
        int nearest = 0;
        for(int b = -9; b <= 12; ++b)
          for(int a = -12; a <= 18; ++a)
          {
            const double d = std::hypot(a + b / 2. - x, b * std::sqrt(.75) - y) - 1 / std::sqrt(3.);
            BOOST_TEST_REQUIRE(d >= -rounding);
            nearest += d <= rounding;
          }
        BOOST_TEST(nearest == 3);
        if(x > -2 && x < 6 && y > -1 && y < 7)
          corners.insert({int(std::round(x * 10)), int(std::round(y * 10))});
      }
    }
    // two corners for each hexagon, of area sqrt(3) / 2, within 8 by 8
    BOOST_TEST(std::abs(double(corners.size()) - 2 * 64 / std::sqrt(.75)) < 20);
  }
}

// Coordinates rounded to single precision, far from the origin, are no cones.
BOOST_AUTO_TEST_CASE(rounding_makes_no_cones)
{
  typedef CGAL::Simple_cartesian<float>::Point_2 Float_point;
  Unfolded surface = torus(7, 6);
  const auto uv = surface.mesh.add_property_map<Halfedge, Float_point>("h:float").first;
  for(double shift : {0., 1e4})
  {
    for(Halfedge h : surface.mesh.halfedges())
      uv[h] = Float_point(float(surface.uv[h].x() / 3 + shift), float(surface.uv[h].y() / 3 - shift));
    const std::string svg = drawing(surface.mesh, uv);
    BOOST_TEST(drawn_cones(svg).empty());
    BOOST_TEST(drawn_seams(svg).size() == 2u);
  }

  for(Halfedge h : surface.mesh.halfedges()) // in double precision
    surface.uv[h] = Point_2(surface.uv[h].x() / 3 + 1e13, surface.uv[h].y() / 3 - 1e13);
  BOOST_TEST(drawn_cones(drawing(surface.mesh, surface.uv)).empty());

  // an angle that is off by 1e-4 is more than rounding
  surface = torus(7, 6);
  for(Halfedge h : surface.mesh.halfedges())
    surface.uv[h] = Point_2(surface.uv[h].x(), surface.uv[h].y() + (surface.uv[h].x() == 7 ? 1e-4 * surface.uv[h].y() : 0));
  BOOST_TEST(! drawn_cones(drawing(surface.mesh, surface.uv)).empty());
}

BOOST_AUTO_TEST_CASE(numbers_of_any_kind)
{
  for(double bad : {HUGE_VAL, -HUGE_VAL, std::numeric_limits<double>::quiet_NaN(), 1e308, -1e308, 1e-320})
  {
    Unfolded surface = cube();
    int i = 0;
    for(Halfedge h : surface.mesh.halfedges())
      if(++i % 7 == 0)
        surface.uv[h] = Point_2(i % 2 == 0 ? -bad : bad, bad);
    const std::string svg = drawing(surface.mesh, surface.uv);
    BOOST_TEST(svg.find("nan") == std::string::npos);
    BOOST_TEST(svg.find("inf") == std::string::npos);
  }

  // all at one place: no angle is known
  Unfolded point = cube();
  for(Halfedge h : point.mesh.halfedges())
    point.uv[h] = Point_2(3, 4);
  BOOST_TEST(drawn_cones(drawing(point.mesh, point.uv)).empty());
  BOOST_TEST(drawn_seams(drawing(point.mesh, point.uv)).empty());
}

BOOST_AUTO_TEST_CASE(isolated_vertices_and_empty_meshes)
{
  Unfolded surface = cube();
  const std::string svg = drawing(surface.mesh, surface.uv);
  surface.mesh.add_vertex(Point_3(0, 0, 7));
  BOOST_TEST(drawing(surface.mesh, surface.uv) == svg);

  Mesh empty;
  const UV uv = empty.add_property_map<Halfedge, Point_2>("h:uv").first;
  BOOST_TEST(drawing(empty, uv).find("id=\"seams\"") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(another_model_of_a_mesh)
{
  typedef CGAL::Polyhedron_3<Kernel> Polyhedron;
  typedef boost::graph_traits<Polyhedron> Traits;
  Polyhedron tetrahedron;
  tetrahedron.make_tetrahedron(Point_3(1, 1, 1), Point_3(-1, 1, -1), Point_3(1, -1, -1), Point_3(-1, -1, 1));
  std::map<Traits::halfedge_descriptor, Point_2> corner;
  int column = 0;
  for(auto f : faces(tetrahedron))
  {
    auto h = halfedge(f, tetrahedron);
    for(const Point_2& p : {Point_2(0, 0), Point_2(1, 0), Point_2(.5, std::sqrt(.75))})
    {
      corner[h] = Point_2(p.x() + 2 * column, p.y());
      h = next(h, tetrahedron);
    }
    ++column;
  }
  std::ostringstream out;
  BOOST_TEST(flattening::write_SVG(out, tetrahedron, boost::make_assoc_property_map(corner),
                               boost::static_property_map<double, Traits::face_descriptor>(1.)));
  BOOST_TEST(drawn_seams(out.str()).size() == 6u);
  check_sides(drawn_seams(out.str()), 1);
  BOOST_TEST(drawn_cones(out.str()).size() == 4u);
  for(const auto& cone : drawn_cones(out.str()))
  {
    BOOST_TEST(cone.first.substr(cone.first.find(',')) == ", angle: 180 degrees");
    BOOST_TEST(cone.second == 3);
  }
}

// ------------------------------------------------------------------------------------------------
// The page: every place of a vertex in the layout has texture coordinates of its own
// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(the_page_of_a_cube)
{
  const Unfolded surface = cube();
  const flattening::Page_data page(surface.mesh, surface.uv, boost::static_property_map<double, Mesh::Vertex_index>(.5), surface.mesh.points(),
                                   CGAL::internal_np::Param_not_found(), std::vector<bool>());
  BOOST_TEST(page.points.size() == 3u * 14u);
  BOOST_TEST(page.u.size() == 14u);
  BOOST_TEST(page.seams.size() == 5u * 7u);
  BOOST_TEST(page.border.empty());
  BOOST_TEST(page.weights.empty());
  BOOST_TEST_REQUIRE(page.layout.size() == 2u * 14u);
  BOOST_TEST_REQUIRE(page.triangles.size() == 3u * 12u);

  const double rounding = std::numeric_limits<float>::epsilon() * page.layout_radius; // of coordinates in [-1, 1]
  const auto is_place = [&](std::uint32_t corner, const auto& p)
  {
    const double x = page.layout_centre[0] + page.layout_radius * double(page.layout[2 * corner]);
    const double y = page.layout_centre[1] + page.layout_radius * double(page.layout[2 * corner + 1]);
    return std::abs(x - p.x()) <= rounding && std::abs(y - p.y()) <= rounding;
  };
  std::size_t i = 0;
  for(Face f : surface.mesh.faces()) // each triangle has the layout of its own side of a seam
    for(Halfedge h : CGAL::halfedges_around_face(surface.mesh.halfedge(f), surface.mesh))
      BOOST_TEST(is_place(page.triangles[i++], surface.uv[h]));

  BOOST_TEST_REQUIRE(page.cones.size() == 8u);
  for(const flattening::Page_data::Cone& cone : page.cones)
    BOOST_TEST(std::abs(cone.angle - 1.5 * CGAL_PI) < 1e-12); // three right angles
  for(double factor : page.quasi_conformal_factor.range()) // the layout is isometric
    BOOST_TEST(std::abs(factor) < 1e-12);
  for(double factor : page.area_factor.range())
    BOOST_TEST(std::abs(factor - page.area_factor.range()[0]) < 1e-12);
}

// ------------------------------------------------------------------------------------------------
// What stands beside and in a drawing
// ------------------------------------------------------------------------------------------------

namespace {

// The numbers beside seams, and how often each is there.
std::map<std::string, int> seam_numbers(const std::string& svg) { return counted_texts(svg, "seam-numbers", "text", ">", "<"); }

} // namespace

// Each side has the number of its path in its middle, which the title has, too; and what lines and dots are is said.
BOOST_AUTO_TEST_CASE(seams_have_numbers)
{
  const Unfolded surface = cube();
  const std::string svg = drawing(surface.mesh, surface.uv);
  std::map<std::string, int> expected;
  for(int i = 1; i <= 7; ++i)
    expected[std::to_string(i)] = 2;
  BOOST_TEST((seam_numbers(svg) == expected));
  const std::vector<Drawn_seam> seams = drawn_seams(svg);
  const std::string numbers = group(svg, "seam-numbers");
  std::size_t n = 0;
  for_each_element(numbers, "text", [&](std::size_t i)
  {
    const Polyline& side = seams[n / 2].sides[n % 2];
    ++n;
    const double x = (side[0].first + side[1].first) / 200, y = (side[0].second + side[1].second) / 200;
    BOOST_TEST(std::abs(std::stod(attribute(numbers, "x", i)) - x) <= 0.1);
    BOOST_TEST(std::abs(std::stod(attribute(numbers, "y", i)) - 5 - y) <= 0.1);
  });
  BOOST_TEST(svg.find("both sides of a seam") != std::string::npos);
  BOOST_TEST(svg.find("a cone") != std::string::npos);

  // where there is no room, there is none
  flattening::SVG_options tiny;
  tiny.size = 100; // sides of 25
  BOOST_TEST(seam_numbers(drawing(surface.mesh, surface.uv, tiny)).empty());
  tiny.seams = tiny.cones = false;
  const std::string plain = drawing(surface.mesh, surface.uv, tiny);
  BOOST_TEST(plain.find("both sides of a seam") == std::string::npos);
  BOOST_TEST(plain.find("a cone") == std::string::npos);
}

// From percentiles to percentiles, rounded outwards to two digits of the width; what is beyond is counted.
BOOST_AUTO_TEST_CASE(colours_are_for_most_values)
{
  typedef flattening::Robust_range Range;
  std::vector<double> values;
  for(int i = 0; i <= 1000; ++i)
    values.push_back(1 + i / 1000. * .377); // percentiles: 1.00377, 1.37323
  const Range even(values);
  BOOST_TEST(std::abs(even.lower - 1) < 1e-15);
  BOOST_TEST(std::abs(even.upper - 1.38) < 1e-15);
  BOOST_TEST(even.number_below + even.number_above == 0u);

  const double infinity = std::numeric_limits<double>::infinity();
  for(double extreme : {1e6, infinity})
  {
    std::vector<double> with_extremes = values;
    with_extremes.insert(with_extremes.end(), 5, extreme);
    with_extremes.insert(with_extremes.end(), 3, -extreme);
    with_extremes.push_back(std::numeric_limits<double>::quiet_NaN());
    const Range range(with_extremes);
    BOOST_TEST(std::abs(range.lower - 1) < 1e-15);
    BOOST_TEST(std::abs(range.upper - 1.38) < 1e-15);
    BOOST_TEST(range.number_above == 5u);
    BOOST_TEST(range.number_below == 3u);
    BOOST_TEST(range.parameter(extreme) == 1.);
    BOOST_TEST(range.parameter(-extreme) == 0.);
  }

  // of few values all; of one the value itself; and of none nothing
  const Range few({0, 3.14159, 7.5});
  BOOST_TEST(few.lower == 0.);
  BOOST_TEST(few.upper == 7.5);
  BOOST_TEST(! std::signbit(Range({-7.5, -.01}).upper)); // zero, which is written without a sign
  const Range one({.123456789});
  BOOST_TEST((one.lower == .123456789 && one.upper == .123456789));
  BOOST_TEST(one.parameter(.123456789) == .5);
  BOOST_TEST(Range({infinity}).empty());
  const double most = (std::numeric_limits<double>::max)();
  const Range widest({-most, most});
  BOOST_TEST((widest.lower == -most && widest.upper == most));
}

// Tiles end where the frame does; the sphere has names.
BOOST_AUTO_TEST_CASE(frames_and_spheres)
{
  const std::string hexagons = drawing_of_square(-3.2, -3.2, 10, 6, 10);
  const std::size_t clip = hexagons.find("<clipPath id=\"drawing-frame\"><rect width=\"10\" height=\"10\"/>"),
                    tiles = hexagons.find("<g clip-path=\"url(#drawing-frame)\"><path id=\"tiles\"");
  BOOST_TEST(clip != std::string::npos);
  BOOST_TEST(tiles != std::string::npos);

  const Unfolded surface = cube();
  flattening::SVG_options options;
  options.circles = { {{0, 0, 1}}, {{2.2, 0, 1}} };
  options.hemispheres = { {{{0, 0}}, false}, {{{2.2, 0}}, true} };
  const std::string svg = drawing(surface.mesh, surface.uv, options), axes = group(svg, "axes"), lines = group(svg, "graticule");
  BOOST_TEST(axes.find("front, seen from z") != std::string::npos);
  BOOST_TEST(axes.find("back, seen from \u2212z") != std::string::npos);
  // the x-axis points to the right in front, and to the left on the back
  std::vector<double> x;
  for_each_element(axes, "text", [&](std::size_t i)
  {
    if(axes[axes.find('>', i) + 1] == 'x')
      x.push_back(std::stod(attribute(axes, "x", i)));
  });
  std::vector<double> centre;
  for_each_element(lines, "circle", [&](std::size_t i) { centre.push_back(std::stod(attribute(lines, "cx", i))); });
  BOOST_TEST_REQUIRE(x.size() == 2u);
  BOOST_TEST_REQUIRE(centre.size() == 4u); // two circles of latitude on each side
  BOOST_TEST(x[0] > centre[0]);
  BOOST_TEST(x[1] < centre[3]);
}

// ------------------------------------------------------------------------------------------------
// The checker on these layouts
// ------------------------------------------------------------------------------------------------

namespace {

checking::Verdict judge(const Unfolded& surface, const checking::Cones& cones = checking::Cones())
{
  return checking::check_flattening(testing::surface_of(surface.mesh),
    testing::layout_of(surface.mesh, [&](Halfedge h) { return surface.uv[h]; }), checking::Tolerances(), cones);
}

checking::Cones read_cones(const std::string& text)
{
  std::istringstream in(text);
  return checking::read_cones(in);
}

checking::Cones cones_of_cube(const std::string& last)
{
  std::string text = "# a cube\n";
  for(int v = 0; v < 7; ++v)
    text += std::to_string(v) + " 270 # degrees\n";
  return read_cones(text + last + "\n\n");
}

} // namespace

BOOST_AUTO_TEST_CASE(checker_and_cones)
{
  const Unfolded surface = cube();
  for(const char* last : {"7 270", "7 free"})
  {
    const checking::Verdict verdict = judge(surface, cones_of_cube(last));
    BOOST_TEST(verdict.is_good(), verdict);
    BOOST_TEST(verdict.cones == 8u);
    BOOST_TEST(verdict.pieces == 1u);
    BOOST_TEST(verdict.interior_vertices == 8u);
    BOOST_TEST(double(verdict.cone_angle.value) <= testing::few_roundings); // of three right angles, and of the 270 degrees
  }
  BOOST_TEST(judge(surface, cones_of_cube("7 free")).free_cones == 1u);

  // missing, of another angle, twice, nowhere, not a number
  BOOST_TEST(! judge(surface).angle.is_good());
  BOOST_TEST(! judge(surface, cones_of_cube("")).is_good());
  BOOST_TEST(! judge(surface, cones_of_cube("7 270.00001")).cone_angle.is_good());
  BOOST_TEST(judge(surface, cones_of_cube("7 270.0000001")).is_good()); // 2e-9 radians
  BOOST_TEST(judge(surface, cones_of_cube("7 270\n8 free")).cones_not_inside == 1u);
  BOOST_TEST(! judge(surface, cones_of_cube("7 270\n8 free")).is_good());
  BOOST_CHECK_THROW(cones_of_cube("6 270"), std::runtime_error);
  BOOST_CHECK_THROW(cones_of_cube("7"), std::runtime_error);
  BOOST_CHECK_THROW(cones_of_cube("7 270 1"), std::runtime_error);
  BOOST_CHECK_THROW(cones_of_cube("7 x"), std::exception);

  // not on the border
  const Unfolded band = unfolded(testing::flat_grid(2), [&](Index f)
  {
    const Soup grid = testing::flat_grid(2);
    Place place;
    for(std::size_t k = 0; k < 3; ++k)
      place[k] = Point_2(grid.points[grid.triangles[f][k]][0], grid.points[grid.triangles[f][k]][1]);
    return place;
  });
  BOOST_TEST(judge(band).is_good());
  BOOST_TEST(judge(band, read_cones("4 360")).is_good());
  BOOST_TEST(! judge(band, read_cones("0 free")).is_good());
}

BOOST_AUTO_TEST_CASE(checker_and_two_sides)
{
  for(double stretch : {1e-11, 1e-9})
  {
    Unfolded surface = cube();
    for(Halfedge h : surface.mesh.halfedges())
      if(surface.uv[h].x() == 4)
        surface.uv[h] = Point_2(4, surface.uv[h].y() * (1 + stretch));
    const checking::Verdict verdict = judge(surface, cones_of_cube("7 270"));
    BOOST_TEST(verdict.two_sides.is_good() == (stretch < 1e-10));
    BOOST_TEST(double(verdict.two_sides.value) > stretch / 2);
    BOOST_TEST(double(verdict.two_sides.value) < stretch * 2);
  }
}

BOOST_AUTO_TEST_CASE(checker_and_pieces)
{
  // two cubes: one shifted by `shift`
  const auto two_cubes = [](double x, double y)
  {
    const Unfolded one = cube();
    Unfolded two;
    two.mesh = one.mesh;
    two.mesh += one.mesh;
    two.uv = two.mesh.add_property_map<Halfedge, Point_2>("h:places").first;
    const std::size_t n = one.mesh.number_of_halfedges();
    for(Halfedge h : two.mesh.halfedges())
    {
      const Point_2 p = one.uv[Halfedge(Index(h % n))];
      two.uv[h] = Index(h) < n ? p : Point_2(p.x() + x, p.y() + y);
    }
    return two;
  };
  checking::Cones cones;
  for(std::size_t v = 0; v < 16; ++v)
    cones[v] = checking::pi * 3 / 2;

  for(const auto& shift : {std::make_pair(4., 0.), std::make_pair(0., -3.), std::make_pair(17., 1.)})
  {
    const checking::Verdict verdict = judge(two_cubes(shift.first, shift.second), cones);
    BOOST_TEST(verdict.is_good(), verdict);
    BOOST_TEST(verdict.pieces == 2u);
    BOOST_TEST(verdict.overlapping_pieces == 0u);
  }
  for(const auto& shift : {std::make_pair(3.75, 0.), std::make_pair(0., 2.5), std::make_pair(0., 0.)})
  {
    const checking::Verdict verdict = judge(two_cubes(shift.first, shift.second), cones);
    BOOST_TEST(! verdict.is_good());
    BOOST_TEST(verdict.overlapping_pieces == 1u);
  }
}

// ------------------------------------------------------------------------------------------------
// The checker of seams, bit for bit
// ------------------------------------------------------------------------------------------------

namespace {

checking::Seam_verdict judge_seams(const Unfolded& surface, int symmetry)
{
  const checking::Seam_verdict verdict = checking::check_seams(testing::surface_of(surface.mesh),
    testing::layout_of(surface.mesh, [&](Halfedge h) { return surface.uv[h]; }), symmetry);
  BOOST_TEST_MESSAGE(verdict);
  return verdict;
}

// Every place of the layout moved.
template <typename Map>
Unfolded moved(const Unfolded& surface, const Map& map)
{
  Unfolded result;
  result.mesh = surface.mesh;
  result.uv = result.mesh.add_property_map<Halfedge, Point_2>("h:moved").first;
  for(Halfedge h : result.mesh.halfedges())
    result.uv[h] = map(surface.uv[h]);
  return result;
}

Unfolded shifted(const Unfolded& surface, double x, double y)
{
  return moved(surface, [=](const Point_2& p) { return Point_2(p.x() + x, p.y() + y); });
}

// The octahedron in the coordinates of the lattice of hexagons: four pieces that differ by rotations by 60 degrees; or, if each is turned
// by 60 degrees more than the one before, by multiples of 120.
Unfolded octahedron_in_lattice(bool is_turned)
{
  Unfolded result = octahedron();
  const double s = std::sqrt(2.), t = std::sqrt(1.5);
  for(Face f : result.mesh.faces())
    for(Halfedge h : CGAL::halfedges_around_face(result.mesh.halfedge(f), result.mesh))
    {
      double b = std::round(result.uv[h].y() / t), a = std::round(result.uv[h].x() / s - b / 2);
      for(Index k = is_turned ? Index(f) / 2 : 0; k > 0; --k)
      {
        const double sum = a + b;
        a = -b;
        b = sum;
      }
      result.uv[h] = Point_2(a, b);
    }
  return result;
}

// A corner on a seam, and its coordinate x moved to the next number.
Unfolded with_one_bit_changed(const Unfolded& surface, std::size_t n)
{
  Unfolded result = shifted(surface, 0, 0);
  for(Halfedge h : result.mesh.halfedges())
    if(! result.mesh.is_border(result.mesh.edge(h)) && flattening::is_outline(result.mesh, surface.uv, h) && n-- == 0)
    {
      const Point_2 p = surface.uv[h];
      for(Halfedge g : CGAL::halfedges_around_target(h, result.mesh)) // all corners at this place
        if(surface.uv[g] == p)
          result.uv[g] = Point_2(std::nextafter(p.x(), HUGE_VAL), p.y());
      break;
    }
  return result;
}

} // namespace

BOOST_AUTO_TEST_CASE(seams_of_a_cube)
{
  const checking::Seam_verdict verdict = judge_seams(cube(), 4);
  BOOST_TEST(verdict.is_good(), verdict);
  BOOST_TEST(verdict.seam_edges == 7u);
  BOOST_TEST(verdict.paths == 7u);
  BOOST_TEST(verdict.cones == 8u);
  BOOST_TEST(judge_seams(shifted(cube(), -3, 1e6), 4).is_good());

  BOOST_TEST(judge_seams(cube(), 2).edges_without_motion > 0u); // there are right angles
  BOOST_TEST(judge_seams(cube(), 2).wrong_angles == 8u);
  BOOST_TEST(judge_seams(cube(), 6).is_good()); // of rhombi, in coordinates of the other lattice
  BOOST_TEST(! judge_seams(cube(), 3).is_good());
  BOOST_CHECK_THROW(judge_seams(cube(), 5), std::runtime_error);
  BOOST_CHECK_THROW(judge_seams(cube(), 0), std::runtime_error);

  // cones in the corners of tiles: rotations about them by 90 degrees still take integers to integers, but they lie beside the lattice
  const checking::Seam_verdict corners = judge_seams(shifted(cube(), .5, .5), 4);
  BOOST_TEST(corners.edges_without_motion == 0u);
  BOOST_TEST(corners.cones_off_lattice == 8u);
  BOOST_TEST(! corners.is_good());
  // on the sides of tiles: translations are half-integers
  BOOST_TEST(judge_seams(shifted(cube(), .5, 0), 4).edges_without_motion > 0u);
  // other sizes of tiles
  BOOST_TEST(judge_seams(moved(cube(), [](const Point_2& p) { return Point_2(3 * p.x(), 3 * p.y()); }), 4).is_good());
  BOOST_TEST(! judge_seams(moved(cube(), [](const Point_2& p) { return Point_2(p.x() / 2, p.y() / 2); }), 4).is_good());
  BOOST_TEST(! judge_seams(moved(cube(), [](const Point_2& p) { return Point_2(2 * p.x(), p.y()); }), 4).is_good());
}

BOOST_AUTO_TEST_CASE(every_bit_counts)
{
  const auto check = [](const Unfolded& surface, int symmetry)
  {
    BOOST_TEST(judge_seams(surface, symmetry).is_good());
    for(std::size_t n = 0; n < 8; ++n)
    {
      const checking::Seam_verdict verdict = judge_seams(with_one_bit_changed(surface, n), symmetry);
      BOOST_TEST(! verdict.is_good());
      BOOST_TEST(verdict.edges_without_motion > 0u);
    }
  };
  check(cube(), 4);
  for(int n : {2, 3, 4, 6})
    check(torus(5, 5), n);
  check(ring(6, 4), 4);
  check(octahedron_in_lattice(false), 6);
  check(octahedron_in_lattice(true), 3);
}

BOOST_AUTO_TEST_CASE(seams_of_a_torus)
{
  const checking::Seam_verdict verdict = judge_seams(torus(5, 5), 4);
  BOOST_TEST(verdict.is_good());
  BOOST_TEST(verdict.seam_edges == 10u);
  BOOST_TEST(verdict.cones == 0u);
  BOOST_TEST(verdict.paths == 2u);
  const auto scaled = [](double factor) { return moved(torus(5, 5), [=](const Point_2& p) { return Point_2(factor * p.x(), factor * p.y()); }); };
  BOOST_TEST(judge_seams(scaled(.2), 4).is_good()); // one tile
  BOOST_TEST(judge_seams(scaled(2), 4).is_good());
  BOOST_TEST(judge_seams(scaled(.3), 4).edges_without_motion == 10u);
  BOOST_TEST(judge_seams(scaled(.5), 4).edges_without_motion == 10u); // translations by 2.5
  BOOST_TEST(judge_seams(shifted(torus(5, 5), .25, 1. / 1024), 4).is_good()); // without cones any place will do, if it is exact

  // a vertex inside drawn where it flips triangles: there is nothing wrong with the seams
  Unfolded flipped = torus(5, 5);
  for(Halfedge h : flipped.mesh.halfedges())
    if(flipped.uv[h] == Point_2(2, 2))
      flipped.uv[h] = Point_2(4, 2);
  BOOST_TEST(judge_seams(flipped, 4).edges_without_motion == 0u);
  BOOST_TEST(judge_seams(flipped, 4).not_positive_triangles > 0u);
  BOOST_TEST(! judge_seams(flipped, 4).is_good());
  // and moved a little: still a seamless layout
  Unfolded bent = torus(5, 5);
  for(Halfedge h : bent.mesh.halfedges())
    if(bent.uv[h] == Point_2(2, 2))
      bent.uv[h] = Point_2(2.1, 1.9);
  BOOST_TEST(judge_seams(bent, 4).is_good());

  for(double bad : {HUGE_VAL, std::numeric_limits<double>::quiet_NaN()})
    BOOST_TEST(! judge_seams(shifted(torus(5, 5), bad, 0), 4).is_good());
}

BOOST_AUTO_TEST_CASE(seams_of_an_octahedron)
{
  for(int n : {3, 6})
  {
    const Unfolded surface = octahedron_in_lattice(n == 3);
    const checking::Seam_verdict verdict = judge_seams(surface, n);
    BOOST_TEST(verdict.is_good(), verdict);
    BOOST_TEST(verdict.cones == 6u);
    BOOST_TEST(verdict.paths == 8u);
    BOOST_TEST(! judge_seams(octahedron(), n).is_good()); // in Cartesian coordinates
    BOOST_TEST(! judge_seams(shifted(surface, 1. / 3, 1. / 3), n).is_good());
    BOOST_TEST(judge_seams(shifted(surface, 7, -2), n).is_good());
  }
  BOOST_TEST(judge_seams(octahedron_in_lattice(true), 6).is_good());
  BOOST_TEST(judge_seams(octahedron_in_lattice(false), 3).edges_without_motion == 8u);
  BOOST_TEST(! judge_seams(octahedron_in_lattice(false), 4).is_good());
}
