// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Normal coordinates against three oracles that know nothing of them: straight
// segments in the plane and on flat tori (exact integers), determinants on the
// torus with one vertex, and curves rewritten flip by flip as words of crossed
// edges, on surfaces glued at random.

#define BOOST_TEST_MODULE test_normal_coordinates
#include "include/boost_test.h"
#include "include/test_meshes.h"

#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/normal_coordinates.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

using CGAL::Conformal_equivalence::Intrinsic_triangulation;
using CGAL::Conformal_equivalence::internal::Normal_coordinates;
using testing::Index;
using testing::Random;

namespace {

typedef Intrinsic_triangulation<double> Triangulation;
typedef Normal_coordinates::Path Path;
constexpr Index null_index = Triangulation::null_index;

// ---------------------------------------------------------------- surfaces

// The surface of the triangles glued by `twin`: its vertices are what the gluing identifies.
Triangulation glued(const std::vector<Index>& twin)
{
  std::vector<Index> origin(twin.size(), null_index);
  Index vertices = 0;
  for(Index h = 0; h < twin.size(); ++h)
  {
    if(origin[h] != null_index)
      continue;
    Index first = h; // the last one clockwise
    while(twin[first] != null_index && Triangulation::next(twin[first]) != h)
      first = Triangulation::next(twin[first]);
    for(Index a = first; a != null_index && origin[a] == null_index; a = twin[Triangulation::previous(a)])
      origin[a] = vertices;
    ++vertices;
  }
  return Triangulation(vertices, origin, twin);
}

// Triangles whose sides are glued in random pairs, but for some that are borders.
Triangulation random_surface(Index faces, Index borders, Random& random)
{
  std::vector<Index> sides(3 * faces), twin(3 * faces, null_index);
  std::iota(sides.begin(), sides.end(), Index(0));
  for(Index i = Index(sides.size()); i > 1; --i)
    std::swap(sides[i - 1], sides[random.below(i)]);
  for(std::size_t i = borders; i + 1 < sides.size(); i += 2)
  {
    twin[sides[i]] = sides[i + 1];
    twin[sides[i + 1]] = sides[i];
  }
  return glued(twin);
}

// m x m squares of a torus, each cut along a diagonal
Triangulation torus(Index m)
{
  std::vector<Index> twin(6 * m * m);
  const auto glue = [&](Index a, Index b) { twin[a] = b; twin[b] = a; };
  for(Index j = 0; j < m; ++j)
    for(Index i = 0; i < m; ++i)
    {
      const Index lower = 6 * (j * m + i), upper = lower + 3; // sides: bottom, right, diagonal; diagonal, top, left
      glue(lower + 2, upper);
      glue(upper + 1, 6 * ((j + 1) % m * m + i));
      glue(lower + 1, 6 * (j * m + (i + 1) % m) + 5);
    }
  return glued(twin);
}

std::vector<Index> flippable_edges(const Triangulation& t)
{
  std::vector<Index> result;
  for(Index e = 0; e < t.number_of_edges(); ++e)
    if(t.is_flippable(e))
      result.push_back(e);
  return result;
}

// ---------------------------------------------------------------- what all paths together must be

template <typename NT>
std::vector<Path> all_paths(const Intrinsic_triangulation<NT>& t, const Normal_coordinates& record)
{
  const std::vector<Normal_coordinates::Start> starts = record.starts(t);
  std::vector<Path> result;
  for(const Normal_coordinates::Start& s : starts)
    result.push_back(record.path(t, s));
  return result;
}

// Every path ends where its edge ends, and its twin's path is the reverse.
bool ends_are_right(const Triangulation& input, const Triangulation& t, const std::vector<Path>& paths)
{
  for(Index h = 0; h < input.number_of_halfedges(); ++h)
  {
    const Path& path = paths[h];
    const std::size_t n = path.crossed.size();
    if(path.is_edge != (n == 0) || path.strand.size() != n || t.origin(path.first) != input.origin(h))
      return false;
    const Index last = path.is_edge ? t.next(path.first) : t.previous(t.twin(path.crossed.back()));
    if(t.origin(last) != input.target(h))
      return false;
    if(input.is_border(h))
    {
      if(!path.is_edge || !t.is_border(path.first))
        return false;
      continue;
    }
    const Path& twin = paths[input.twin(h)];
    if(twin.crossed.size() != n || twin.first != (path.is_edge ? t.twin(path.first) : last))
      return false;
    for(std::size_t i = 0; i < n; ++i)
      if(twin.crossed[i] != t.twin(path.crossed[n - 1 - i]))
        return false;
  }
  return true;
}

// The arcs of all paths within every face are disjoint, and every edge is crossed as often as the record says.
bool arcs_are_disjoint(const Triangulation& input, const Triangulation& t, const Normal_coordinates& record,
                       const std::vector<Path>& paths)
{
  // By halfedge and strand: what an arc of the face of the halfedge joins to it.
  struct End { Index halfedge; std::int64_t strand; }; // strand -1: the origin of the halfedge
  std::vector<std::vector<End> > arc(t.number_of_halfedges());
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
    arc[h].assign(record.crossings(t.edge(h)), End{ null_index, 0 });
  std::uint64_t total = 0;
  const auto set = [&](Index h, std::uint64_t strand, const End& end)
  {
    if(strand >= arc[h].size() || arc[h][strand].halfedge != null_index)
      return false;
    arc[h][strand] = end;
    return true;
  };
  for(Index e = 0; e < input.number_of_edges(); ++e)
  {
    const Path& path = paths[input.edge_halfedge(e)];
    End from = { path.first, -1 };
    for(std::size_t i = 0; i < path.crossed.size(); ++i, ++total)
    {
      const Index c = path.crossed[i], g = t.twin(c);
      if(t.face(c) != t.face(from.halfedge) || !set(c, path.strand[i], from))
        return false;
      if(from.strand >= 0)
        set(from.halfedge, std::uint64_t(from.strand), { c, path.strand[i] });
      from = { g, std::int64_t(arc[c].size()) - 1 - path.strand[i] };
    }
    if(!path.is_edge && !set(from.halfedge, std::uint64_t(from.strand), { t.previous(from.halfedge), -1 }))
      return false;
  }
  if(total != record.total_crossings())
    return false;
  for(Index f = 0; f < t.number_of_faces(); ++f)
  {
    // counterclockwise around the face: vertex, strands, vertex, strands, vertex, strands
    std::int64_t place[3];
    place[0] = 0;
    for(int k = 1; k < 3; ++k)
      place[k] = place[k - 1] + 1 + std::int64_t(arc[3 * f + k - 1].size());
    std::vector<std::pair<std::int64_t, std::int64_t> > chords;
    for(Index h = 3 * f; h < 3 * f + 3; ++h)
      for(std::size_t s = 0; s < arc[h].size(); ++s)
      {
        const End& end = arc[h][s];
        if(end.halfedge == null_index || end.halfedge == h)
          return false; // every strand has an arc to elsewhere
        const std::int64_t a = place[h % 3] + 1 + std::int64_t(s), b = place[end.halfedge % 3] + 1 + end.strand;
        if(a < b || end.strand < 0)
          chords.push_back({ (std::min)(a, b), (std::max)(a, b) });
      }
    // chords that begin last, and end first, close first
    std::sort(chords.begin(), chords.end(), [](const auto& x, const auto& y)
              { return x.first != y.first ? x.first < y.first : x.second > y.second; });
    std::vector<std::int64_t> open;
    for(const auto& chord : chords)
    {
      while(!open.empty() && open.back() <= chord.first)
        open.pop_back();
      if(!open.empty() && open.back() < chord.second)
        return false;
      open.push_back(chord.second);
    }
  }
  return true;
}

// Around every vertex, corners and positions sort the input halfedges as the input does.
template <typename Position>
bool order_is_right(const Triangulation& input, const Triangulation& t, const std::vector<Path>& paths,
                    Position position)
{
  std::vector<std::vector<std::pair<std::uint32_t, Index> > > in_corner(t.number_of_halfedges());
  for(Index h = 0; h < input.number_of_halfedges(); ++h)
    in_corner[paths[h].first].push_back({ position(h), h });
  for(Index v = 0; v < input.number_of_vertices(); ++v)
  {
    std::vector<Index> expected, found;
    input.for_each_outgoing(v, [&](Index h) { expected.push_back(h); });
    t.for_each_outgoing(v, [&](Index c)
    {
      std::sort(in_corner[c].begin(), in_corner[c].end());
      for(const auto& p : in_corner[c])
        found.push_back(p.second);
      for(std::size_t i = 0; i < in_corner[c].size(); ++i)
        if(in_corner[c][i].first != i)
          found.push_back(null_index); // positions are 0, 1, ...
    });
    if(found.size() != expected.size())
      return false;
    if(!input.is_border_vertex(v) && !found.empty())
      std::rotate(found.begin(), std::find(found.begin(), found.end(), expected.front()), found.end());
    if(found != expected)
      return false;
  }
  return true;
}

void check_all(const Triangulation& input, const Triangulation& t, const Normal_coordinates& record)
{
  BOOST_REQUIRE(!record.has_overflowed());
  const std::vector<Path> paths = all_paths(t, record);
  BOOST_TEST(ends_are_right(input, t, paths));
  BOOST_TEST(arcs_are_disjoint(input, t, record, paths));
  BOOST_TEST(order_is_right(input, t, paths, [&](Index h) { return record.position(t, h); }));
  for(Index h = 0; h < input.number_of_halfedges(); ++h) // one by one as all at once
  {
    const Path path = record.path(t, h);
    BOOST_REQUIRE(path.first == paths[h].first);
    BOOST_REQUIRE(path.is_edge == paths[h].is_edge);
    BOOST_REQUIRE(path.crossed == paths[h].crossed);
    BOOST_REQUIRE(path.strand == paths[h].strand);
    if(path.is_edge)
      BOOST_REQUIRE(record.input_halfedge(t, path.first) == h);
  }
  std::uint64_t total = 0;
  std::vector<char> is_input_edge(t.number_of_edges(), 0);
  for(const Path& path : paths)
    if(path.is_edge)
      is_input_edge[t.edge(path.first)] = 1;
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    total += record.crossings(e);
    BOOST_REQUIRE(record.coincides(e) == bool(is_input_edge[e]));
    if(t.is_border_edge(e))
      BOOST_REQUIRE(record.coincides(e));
  }
  BOOST_TEST(total == record.total_crossings());
}

// ---------------------------------------------------------------- straight segments

typedef std::int64_t Integer;
struct Vector { Integer x, y; };
Vector operator+(const Vector& a, const Vector& b) { return { a.x + b.x, a.y + b.y }; }
Vector operator-(const Vector& a, const Vector& b) { return { a.x - b.x, a.y - b.y }; }
Vector operator-(const Vector& a) { return { -a.x, -a.y }; }
Integer cross(const Vector& a, const Vector& b) { return a.x * b.y - a.y * b.x; }
Integer dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y; }
Integer orientation(const Vector& a, const Vector& b, const Vector& c) { return cross(b - a, c - a); }

// A triangulation by straight edges, of a set in the plane or (if `period` is not 0) of the torus of that period.
struct Straight
{
  Triangulation t;
  std::vector<Vector> position;   // by vertex
  std::vector<Vector> direction;  // by halfedge, from origin to target
  Integer period = 0;

  // flips `e` if its quadrilateral is strictly convex and the new edge no longer than `bound` in x and y
  bool flip(Index e, Integer bound, Normal_coordinates& record)
  {
    if(!t.is_flippable(e))
      return false;
    const Index h = t.edge_halfedge(e), g = t.twin(h);
    const Index n = t.next(h), p = t.previous(h), m = t.next(g), q = t.previous(g);
    const Vector diagonal = direction[q] + direction[n];
    if(cross(direction[p], direction[m]) <= 0 || cross(direction[q], direction[n]) <= 0
       || std::abs(diagonal.x) > bound || std::abs(diagonal.y) > bound)
      return false;
    record.flip(t, e);
    t.flip_edge(e, 1);
    const Vector old[4] = { direction[n], direction[p], direction[m], direction[q] };
    direction[q] = old[0];
    direction[n] = old[1];
    direction[p] = old[2];
    direction[m] = old[3];
    direction[h] = diagonal;
    direction[g] = -diagonal;
    return true;
  }
};

bool is_straight(const Straight& s)
{
  for(Index h = 0; h < s.t.number_of_halfedges(); ++h)
    if(cross(s.direction[h], s.direction[s.t.next(h)]) <= 0)
      return false;
  return true;
}

struct Fraction { Integer numerator, denominator; }; // positive
bool operator<(const Fraction& a, const Fraction& b)
{
  return a.numerator * b.denominator < b.numerator * a.denominator;
}

struct Crossing { Index halfedge; Fraction on_input, on_current; }; // on_current: from the origin of the halfedge

// The crossings of a segment with all edges, in order.
std::vector<Crossing> crossings(const Straight& s, const Vector& a, const Vector& direction)
{
  const Vector b = a + direction;
  std::vector<Crossing> result;
  for(Index e = 0; e < s.t.number_of_edges(); ++e)
  {
    const Index c = s.t.edge_halfedge(e);
    const Vector base = s.position[s.t.origin(c)];
    const auto meet = [&](const Vector& from)
    {
      const Vector to = from + s.direction[c];
      const Integer a_side = orientation(from, to, a), b_side = orientation(from, to, b),
                    from_side = orientation(a, b, from), to_side = orientation(a, b, to);
      if(!((a_side > 0 && b_side < 0) || (a_side < 0 && b_side > 0))
         || !((from_side > 0 && to_side < 0) || (from_side < 0 && to_side > 0)))
        return;
      const Fraction on_input = { std::abs(a_side), std::abs(a_side - b_side) },
                     on_current = { std::abs(from_side), std::abs(from_side - to_side) },
                     reversed = { std::abs(to_side), std::abs(from_side - to_side) };
      if(a_side > 0)
        result.push_back({ c, on_input, on_current });
      else
        result.push_back({ s.t.twin(c), on_input, reversed });
    };
    if(s.period == 0)
      meet(base);
    else
    {
      const Integer reach_x = std::abs(direction.x) + std::abs(s.direction[c].x),
                    reach_y = std::abs(direction.y) + std::abs(s.direction[c].y);
      const Integer nx = reach_x / s.period + 2, ny = reach_y / s.period + 2;
      for(Integer x = -nx; x <= nx; ++x)
        for(Integer y = -ny; y <= ny; ++y)
          meet(base + Vector{ x * s.period, y * s.period });
    }
  }
  std::sort(result.begin(), result.end(), [](const Crossing& x, const Crossing& y) { return x.on_input < y.on_input; });
  return result;
}

// Every path is exactly what the straight input edge crosses, and the strands are in the order of the points.
void check_straight(const Straight& input, const Straight& current, const Normal_coordinates& record)
{
  const std::vector<Path> paths = all_paths(current.t, record);
  std::vector<std::vector<Fraction> > points(current.t.number_of_halfedges()); // of all input edges, by halfedge
  std::vector<std::vector<Crossing> > expected(paths.size());
  for(Index h = 0; h < input.t.number_of_halfedges(); ++h)
  {
    expected[h] = crossings(current, input.position[input.t.origin(h)], input.direction[h]);
    for(const Crossing& c : expected[h]) // the edge from both of its sides: once from each
      points[c.halfedge].push_back(c.on_current);
  }
  for(std::vector<Fraction>& p : points)
    std::sort(p.begin(), p.end());
  for(Index h = 0; h < input.t.number_of_halfedges(); ++h)
  {
    const Path& path = paths[h];
    const Vector d = input.direction[h], x = current.direction[path.first];
    BOOST_REQUIRE(current.t.origin(path.first) == input.t.origin(h));
    BOOST_REQUIRE(path.is_edge == (cross(x, d) == 0 && dot(x, d) > 0));
    if(path.is_edge)
      BOOST_REQUIRE(x.x == d.x && x.y == d.y);
    else
      BOOST_REQUIRE(cross(x, d) > 0 && cross(d, -current.direction[current.t.previous(path.first)]) > 0);
    BOOST_REQUIRE(path.crossed.size() == expected[h].size());
    for(std::size_t i = 0; i < path.crossed.size(); ++i)
    {
      const Crossing& c = expected[h][i];
      BOOST_REQUIRE(path.crossed[i] == c.halfedge);
      const std::vector<Fraction>& p = points[c.halfedge];
      BOOST_REQUIRE(path.strand[i] == std::lower_bound(p.begin(), p.end(), c.on_current) - p.begin());
    }
  }
}

Straight straight(const Triangulation& t, const std::vector<Vector>& position)
{
  Straight result = { t, position, {}, 0 };
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
    result.direction.push_back(position[t.target(h)] - position[t.origin(h)]);
  return result;
}

// Random points, each joined to the part of the convex hull of the points left of it that it sees.
Straight random_points(Index n, Random& random)
{
  std::vector<Vector> points;
  for(Index i = 0; i < n; ++i)
    points.push_back({ Integer(random.below(1000)), Integer(random.below(1000)) });
  std::sort(points.begin(), points.end(), [](const Vector& a, const Vector& b)
            { return std::make_pair(a.x, a.y) < std::make_pair(b.x, b.y); });
  points.erase(std::unique(points.begin(), points.end(), [](const Vector& a, const Vector& b)
                           { return a.x == b.x && a.y == b.y; }), points.end());
  const Integer first = orientation(points[0], points[1], points[2]);
  if(first == 0)
    return random_points(n, random);
  std::vector<Index> hull = { 0, 1, 2 };
  if(first < 0)
    std::swap(hull[1], hull[2]);
  testing::Soup soup;
  soup.triangles.push_back({{ hull[0], hull[1], hull[2] }});
  for(Index i = 3; i < points.size(); ++i)
  {
    const auto sees = [&](std::size_t k)
    {
      return orientation(points[hull[k]], points[hull[(k + 1) % hull.size()]], points[i]) < 0;
    };
    std::size_t begin = 0;
    while(!sees(begin) || sees((begin + hull.size() - 1) % hull.size()))
      ++begin;
    std::rotate(hull.begin(), hull.begin() + std::ptrdiff_t(begin), hull.end());
    std::size_t last = 0; // of the hull edges that are seen, which are the first ones now
    for(; sees(last); ++last)
      soup.triangles.push_back({{ hull[last + 1], hull[last], i }});
    hull.erase(hull.begin() + 1, hull.begin() + std::ptrdiff_t(last));
    hull.insert(hull.begin() + 1, i);
  }
  for(const Vector& p : points)
    soup.points.push_back({{ double(p.x), double(p.y), 0. }});
  return straight(testing::triangulation(soup), points);
}

Straight integer_grid(Index n)
{
  std::vector<Vector> points;
  for(Index j = 0; j <= n; ++j)
    for(Index i = 0; i <= n; ++i)
      points.push_back({ Integer(i), Integer(j) });
  return straight(testing::triangulation(testing::flat_grid(n)), points);
}

// m x m points of a torus, moved a little off a lattice
Straight straight_torus(Index m, Integer side, Integer jitter, Random& random)
{
  Straight result = { torus(m), {}, std::vector<Vector>(6 * m * m), Integer(m) * side };
  std::vector<Vector> moved(m * m, Vector{ 0, 0 });
  for(Vector& v : moved)
    if(jitter > 0)
      v = { Integer(random.below(Index(2 * jitter))) - jitter, Integer(random.below(Index(2 * jitter))) - jitter };
  result.position.resize(m * m);
  const Vector steps[6] = { { side, 0 }, { 0, side }, { -side, -side }, { side, side }, { -side, 0 }, { 0, -side } };
  for(Index j = 0; j < m; ++j)
    for(Index i = 0; i < m; ++i)
    {
      const Index h = 6 * (j * m + i), v = result.t.origin(h);
      result.position[v] = Vector{ Integer(i) * side, Integer(j) * side } + moved[v];
    }
  for(Index h = 0; h < result.t.number_of_halfedges(); ++h)
    result.direction[h] = steps[h % 6] + moved[result.t.target(h)] - moved[result.t.origin(h)];
  return result;
}

// Random flips of convex quadrilaterals, checked now and then.
std::size_t test_straight(const Straight& input, int flips, int checks, Integer bound, Random& random)
{
  BOOST_REQUIRE(is_straight(input));
  Straight current = input;
  Normal_coordinates record(input.t);
  check_straight(input, current, record);
  std::size_t done = 0;
  for(int check = 0; check < checks; ++check)
  {
    for(int i = 0; i < flips; ++i)
      done += current.flip(random.below(current.t.number_of_edges()), bound, record);
    BOOST_REQUIRE(is_straight(current));
    check_straight(input, current, record);
    check_all(input.t, current.t, record);
  }
  return done;
}

// ---------------------------------------------------------------- curves as words

// An input halfedge as the word of the halfedges it crosses, rewritten at every flip by itself.
struct Curve
{
  Index first;
  bool is_edge;
  std::vector<Index> crossed;
};

class Curves
{
  std::vector<Curve> curves_;

public:
  explicit Curves(const Triangulation& input)
  {
    for(Index h = 0; h < input.number_of_halfedges(); ++h)
      curves_.push_back({ h, true, {} });
  }

  const Curve& operator[](Index h) const { return curves_[h]; }

  void flip(const Triangulation& t, Index e)
  {
    const Index h = t.edge_halfedge(e), g = t.twin(h);
    for(Curve& curve : curves_)
      curve = rewritten(t, h, g, curve);
  }

private:
  enum class Place { I, J, K, L, IL, LJ, JK, KI }; // vertices and sides of the quadrilateral

  static bool is_vertex(Place p) { return p <= Place::L; }
  static bool is_tip(Place p) { return p == Place::K || p == Place::L; }
  static bool is_left(Place p) { return p == Place::I || p == Place::IL || p == Place::KI; }

  static Curve rewritten(const Triangulation& t, Index h, Index g, const Curve& curve)
  {
    const Index n = t.next(h), p = t.previous(h), m = t.next(g), q = t.previous(g);
    const auto renamed = [&](Index a) { return a == n ? q : a == p ? n : a == m ? p : a == q ? m : a; };
    if(curve.is_edge && curve.first == h)
      return { p, false, { h } };
    if(curve.is_edge && curve.first == g)
      return { q, false, { g } };
    if(curve.is_edge)
      return { renamed(curve.first), true, {} };

    const auto corner = [&](Index a)
    {
      return a == h || a == m ? Place::I : a == n || a == g ? Place::J : a == p ? Place::K : Place::L;
    };
    const auto side = [&](Index a) { return a == n ? Place::JK : a == p ? Place::KI : a == m ? Place::IL : Place::LJ; };
    const auto in_quad = [&](Index a) { return t.face(a) == t.face(h) || t.face(a) == t.face(g); };

    Curve result = { renamed(curve.first), false, {} };
    const std::size_t size = curve.crossed.size();
    Index entry = curve.first; // the corner at first, then the side the curve enters through
    for(std::size_t i = 0; i <= size; ++i)
    {
      if(in_quad(entry))
      {
        const Place from = i == 0 ? corner(entry) : side(entry);
        if(i < size && (curve.crossed[i] == h || curve.crossed[i] == g))
        {
          entry = t.twin(curve.crossed[i++]);
          BOOST_REQUIRE(i == size || (curve.crossed[i] != h && curve.crossed[i] != g));
        }
        const Place to = i == size ? corner(t.previous(t.twin(curve.crossed.back()))) : side(curve.crossed[i]);
        if(is_tip(from) && is_tip(to))
          return { from == Place::K ? g : h, true, {} };
        const bool left_from = is_left(is_tip(from) ? to : from), left_to = is_left(is_tip(to) ? from : to);
        if(is_vertex(from))
          result.first = from == Place::I ? p : from == Place::J ? q
                       : from == Place::K ? (left_from ? n : g) : (left_from ? h : m);
        if(left_from != left_to)
          result.crossed.push_back(left_from ? h : g);
      }
      if(i < size)
      {
        result.crossed.push_back(renamed(curve.crossed[i]));
        entry = t.twin(curve.crossed[i]);
      }
    }
    return result;
  }
};

void check_curves(const Triangulation& t, const Normal_coordinates& record, const Curves& curves)
{
  const std::vector<Path> paths = all_paths(t, record);
  for(Index h = 0; h < paths.size(); ++h)
  {
    BOOST_REQUIRE(paths[h].first == curves[h].first);
    BOOST_REQUIRE(paths[h].is_edge == curves[h].is_edge);
    BOOST_REQUIRE(paths[h].crossed == curves[h].crossed);
  }
}

// What random surfaces have been met.
struct Coverage
{
  std::set<std::size_t> closed_genera, bordered_genera;
  bool loop = false, self_glued = false, tip = false, several = false;
  std::size_t flips = 0;
  std::uint64_t largest_total = 0;

  void look_at(const Triangulation& t)
  {
    const auto pieces = CGAL::Conformal_equivalence::connected_components(t);
    several = several || pieces.components.size() > 1;
    for(const auto& c : pieces.components)
      if(c.number_of_faces > 1)
        (c.number_of_borders == 0 ? closed_genera : bordered_genera).insert(c.genus());
    for(Index h = 0; h < t.number_of_halfedges(); ++h)
    {
      loop = loop || t.origin(h) == t.target(h);
      self_glued = self_glued || (!t.is_border(h) && t.face(h) == t.face(t.twin(h)));
    }
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      tip = tip || (t.degree(v) == 1 && !t.is_border_vertex(v));
  }
};

void test_curves(const Triangulation& input, int flips, std::uint64_t bound, Coverage& coverage, Random& random)
{
  Triangulation t = input;
  Normal_coordinates record(input);
  Curves curves(input);
  check_all(input, t, record);
  for(int i = 0; i < flips && record.total_crossings() < bound; ++i)
  {
    const std::vector<Index> edges = flippable_edges(t);
    if(edges.empty())
      return;
    const Index e = edges[random.below(Index(edges.size()))];
    record.flip(t, e);
    curves.flip(t, e);
    t.flip_edge(e, 1);
    ++coverage.flips;
    coverage.look_at(t);
    check_curves(t, record, curves);
    check_all(input, t, record);
  }
  coverage.largest_total = (std::max)(coverage.largest_total, record.total_crossings());
}

} // namespace

BOOST_AUTO_TEST_CASE(the_input_over_itself)
{
  Random random(1);
  for(Index faces : { 1u, 2u, 7u, 40u })
  {
    const Triangulation t = random_surface(faces, faces % 3, random);
    const Normal_coordinates record(t);
    BOOST_TEST(record.total_crossings() == 0u);
    check_all(t, t, record);
    for(Index h = 0; h < t.number_of_halfedges(); ++h)
    {
      BOOST_TEST(record.path(t, h).first == h);
      BOOST_TEST(record.path(t, h).is_edge);
      BOOST_TEST(record.position(t, h) == 0u);
    }
  }
  const Triangulation isolated(2, {}, {}); // two vertices and nothing else
  const Normal_coordinates record(isolated);
  BOOST_TEST(record.starts(isolated).empty());
  BOOST_TEST(record.total_crossings() == 0u);
}

BOOST_AUTO_TEST_CASE(one_flip_of_a_square)
{
  const Triangulation input = testing::triangulation(testing::flat_grid(1)); // triangles 0, 1, 3 and 0, 3, 2
  Triangulation t = input;
  Normal_coordinates record(input);
  const Index e = input.edge(2);
  record.flip(t, e);
  t.flip_edge(e, 1);
  BOOST_TEST(record.crossings(e) == 1u);
  BOOST_TEST(record.total_crossings() == 1u);
  const Path path = record.path(t, 3); // from 0 to 3
  BOOST_TEST(!path.is_edge);
  BOOST_TEST(t.origin(path.first) == 0u);
  BOOST_TEST(t.target(path.first) == 1u);
  BOOST_TEST(path.crossed.size() == 1u);
  BOOST_TEST(t.origin(path.crossed[0]) == 1u);
  BOOST_TEST(t.target(path.crossed[0]) == 2u);
  BOOST_TEST(record.position(t, 3) == 1u); // number 0 is the edge from 0 to 1
  check_all(input, t, record);
}

BOOST_AUTO_TEST_CASE(segments_in_the_plane)
{
  Random random(2);
  std::size_t flips = 0;
  for(Index n : { 4u, 5u, 8u, 15u, 30u, 60u, 120u })
    for(int i = 0; i < (n < 20 ? 20 : 2); ++i)
      flips += test_straight(random_points(n, random), int(8 * n), 4, 2000, random);
  BOOST_TEST(flips > 1000u);
  BOOST_TEST_MESSAGE("flips in the plane: " << flips);
}

BOOST_AUTO_TEST_CASE(segments_between_points_of_a_grid)
{
  Random random(3);
  std::size_t flips = 0;
  for(Index n : { 1u, 2u, 3u, 6u, 10u })
    flips += test_straight(integer_grid(n), int(20 * n * n), 6, 2000, random);
  BOOST_TEST(flips > 300u);
  BOOST_TEST_MESSAGE("flips on grids: " << flips);
}

BOOST_AUTO_TEST_CASE(geodesics_of_flat_tori)
{
  Random random(4);
  std::size_t flips = 0;
  for(Index m : { 1u, 2u, 3u, 4u })
    for(Integer jitter : { 0, 15 })
      for(int i = 0; i < 3; ++i)
        flips += test_straight(straight_torus(m, 100, jitter, random), int(20 * m * m), 4, Integer(700 * m), random);
  BOOST_TEST(flips > 500u);
  BOOST_TEST_MESSAGE("flips on tori: " << flips);
}

// On the torus with one vertex, edges p and q cross |det(p, q)| - 1 times.
BOOST_AUTO_TEST_CASE(determinants_on_the_torus_with_one_vertex)
{
  Random random(5);
  const Straight input = straight_torus(1, 1, 0, random);
  const auto expected = [&](const Vector& d)
  {
    Integer sum = 0;
    for(Index e = 0; e < 3; ++e)
      sum += (std::max)(Integer(0), std::abs(cross(d, input.direction[input.t.edge_halfedge(e)])) - 1);
    return sum;
  };
  Straight current = input;
  Normal_coordinates record(input.t);
  std::size_t flips = 0;
  for(int i = 0; i < 20000; ++i)
  {
    if(!current.flip(random.below(3), 1000000, record))
      continue;
    ++flips;
    std::uint64_t total = 0;
    for(Index e = 0; e < 3; ++e)
    {
      const Integer x = expected(current.direction[current.t.edge_halfedge(e)]);
      BOOST_REQUIRE(Integer(record.crossings(e)) == x);
      total += std::uint64_t(x);
    }
    BOOST_REQUIRE(record.total_crossings() == total);
    if(total < 30000 && i % 20 == 0)
      check_all(input.t, current.t, record);
  }
  BOOST_TEST(flips > 5000u);
  BOOST_TEST_MESSAGE("flips on the torus with one vertex: " << flips);
}

BOOST_AUTO_TEST_CASE(overflow_is_reported)
{
  Random random(6);
  const Integer limit = (std::numeric_limits<std::uint32_t>::max)();
  const Straight input = straight_torus(1, 1, 0, random);
  Straight current = input;
  Normal_coordinates record(input.t);
  int flips = 0;
  Integer expected = 0, largest = 0;
  for(; flips < 200 && !record.has_overflowed(); ++flips)
  {
    const std::uint64_t total = record.total_crossings();
    const Index e = Index(flips % 3); // always the oldest edge
    BOOST_REQUIRE(current.flip(e, Integer(1) << 40, record));
    expected = 0;
    for(Index i = 0; i < 3; ++i)
      expected += (std::max)(Integer(0), std::abs(cross(current.direction[current.t.edge_halfedge(e)],
                                                        input.direction[input.t.edge_halfedge(i)])) - 1);
    if(expected <= limit)
    {
      BOOST_REQUIRE(!record.has_overflowed());
      BOOST_REQUIRE(Integer(record.crossings(e)) == expected);
      largest = expected;
    }
    else
      BOOST_REQUIRE(record.total_crossings() == total);
  }
  BOOST_TEST(record.has_overflowed());
  BOOST_TEST(expected > limit);
  BOOST_TEST(largest > limit / 4);
  const std::uint64_t total = record.total_crossings();
  BOOST_REQUIRE(current.flip(Index(flips % 3), Integer(1) << 40, record)); // it stays overflowed
  BOOST_TEST(record.has_overflowed());
  BOOST_TEST(record.total_crossings() == total);
  BOOST_TEST_MESSAGE("overflow after " << flips << " flips, largest number before " << largest);
}

BOOST_AUTO_TEST_CASE(words_on_random_surfaces)
{
  Random random(7);
  Coverage coverage;
  for(int i = 0; i < 250; ++i)
  {
    const Index faces = 1 + random.below(12);
    Index borders = random.below(3) == 0 ? 0 : random.below(5);
    borders += (3 * faces - borders) % 2; // the others are glued in pairs
    test_curves(random_surface(faces, (std::min)(borders, 3 * faces), random), 60, 4000, coverage, random);
  }
  for(std::size_t genus : { 0u, 1u, 2u, 3u })
  {
    BOOST_TEST(coverage.closed_genera.count(genus) == 1u);
    if(genus < 3)
      BOOST_TEST(coverage.bordered_genera.count(genus) == 1u);
  }
  BOOST_TEST(coverage.loop);
  BOOST_TEST(coverage.self_glued);
  BOOST_TEST(coverage.tip);
  BOOST_TEST(coverage.several);
  BOOST_TEST_MESSAGE("flips of random surfaces: " << coverage.flips << ", largest total " << coverage.largest_total);
}

BOOST_AUTO_TEST_CASE(words_on_meshes)
{
  Random random(8);
  Coverage coverage;
  for(int i = 0; i < 3; ++i)
  {
    test_curves(testing::triangulation(testing::hill(4, 0.5)), 120, 50000, coverage, random);
    test_curves(torus(3), 120, 50000, coverage, random);
    test_curves(random_points(20, random).t, 120, 50000, coverage, random); // not only convex ones
  }
  BOOST_TEST(coverage.flips > 300u);
  BOOST_TEST_MESSAGE("flips of meshes: " << coverage.flips << ", largest total " << coverage.largest_total);
}

BOOST_AUTO_TEST_CASE(flips_of_one_edge_come_back)
{
  Random random(9);
  for(int i = 0; i < 60; ++i)
  {
    const Triangulation input = random_surface(6, 2 * random.below(3), random);
    Triangulation t = input;
    Normal_coordinates record(input);
    const auto flip = [&](Index e) { record.flip(t, e); t.flip_edge(e, 1); };
    for(int k = 0; k < 10; ++k)
    {
      const std::vector<Index> edges = flippable_edges(t);
      if(edges.empty())
        break;
      flip(edges[random.below(Index(edges.size()))]);
    }
    for(Index e : flippable_edges(t))
    {
      const std::vector<Path> before = all_paths(t, record);
      const Index h = t.edge_halfedge(e), g = t.twin(h);
      const std::uint32_t n = record.crossings(e);
      flip(e);
      BOOST_REQUIRE(t.is_flippable(e));
      flip(e); // the same triangulation; h and g, and so the two faces, have changed places
      BOOST_TEST(record.crossings(e) == n);
      std::vector<Path> after = all_paths(t, record);
      const auto other = [&](Index a)
      {
        const Index from = t.face(a) == t.face(h) ? h : g, to = from == h ? g : h;
        return t.face(a) != t.face(h) && t.face(a) != t.face(g) ? a
             : a == from ? to : a == t.next(from) ? t.next(to) : t.previous(to);
      };
      for(Index a = 0; a < before.size(); ++a)
      {
        BOOST_REQUIRE(other(after[a].first) == before[a].first);
        BOOST_REQUIRE(after[a].is_edge == before[a].is_edge);
        for(Index& c : after[a].crossed)
          c = other(c);
        BOOST_REQUIRE(after[a].crossed == before[a].crossed);
        BOOST_REQUIRE(after[a].strand == before[a].strand);
      }
      flip(e);
      flip(e); // everything as it was
      after = all_paths(t, record);
      for(Index a = 0; a < before.size(); ++a)
      {
        BOOST_REQUIRE(after[a].first == before[a].first);
        BOOST_REQUIRE(after[a].crossed == before[a].crossed);
        BOOST_REQUIRE(after[a].strand == before[a].strand);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(many_flips_undone)
{
  Random random(10);
  std::size_t flips = 0;
  std::uint32_t largest = 0;
  for(int i = 0; i < 40; ++i)
  {
    const Index faces = i % 2 == 0 ? 10 : 200;
    const Triangulation input = random_surface(faces, i % 3 == 0 ? 4 : 0, random);
    Triangulation t = input;
    Normal_coordinates record(input);
    std::vector<Index> done;
    std::uint32_t limit = 200000000; // a flip adds no more than the triangles' sides have
    while(done.size() < 20000)
    {
      const std::vector<Index> edges = flippable_edges(t);
      if(edges.empty())
        break;
      const Index e = edges[random.below(Index(edges.size()))];
      record.flip(t, e);
      t.flip_edge(e, 1);
      done.push_back(e);
      largest = (std::max)(largest, record.crossings(e));
      if(record.crossings(e) > limit)
        break;
    }
    flips += done.size();
    BOOST_REQUIRE(!record.has_overflowed());
    for(; !done.empty(); done.pop_back())
    {
      record.flip(t, done.back());
      t.flip_edge(done.back(), 1);
    }
    BOOST_TEST(record.total_crossings() == 0u);
    check_all(input, t, record);
    for(Index h = 0; h < t.number_of_halfedges(); ++h) // each edge is where it was
      BOOST_REQUIRE(t.edge(record.path(t, h).first) == input.edge(h));
  }
  BOOST_TEST(largest > 100000000u);
  BOOST_TEST_MESSAGE("flips done and undone: " << flips << ", largest number " << largest);
}

// The triangulation may change its number type, and the input may go away.
BOOST_AUTO_TEST_CASE(other_number_types)
{
  Random random(11);
  const Triangulation input = random_surface(8, 0, random);
  auto copy = std::make_unique<Triangulation>(input);
  Normal_coordinates record(*copy);
  copy.reset();
  Normal_coordinates same(input);
  Triangulation t = input;
  Intrinsic_triangulation<long double> wide = testing::widened<long double>(input);
  for(int i = 0; i < 30; ++i)
  {
    const std::vector<Index> edges = flippable_edges(t);
    const Index e = edges[random.below(Index(edges.size()))];
    record.flip(wide, e);
    same.flip(t, e);
    wide.flip_edge(e, 1);
    t.flip_edge(e, 1);
  }
  check_all(input, t, same);
  for(Index h = 0; h < input.number_of_halfedges(); ++h)
    BOOST_TEST((record.path(wide, h).crossed == same.path(t, h).crossed));
}

// The checks above notice what is wrong.
BOOST_AUTO_TEST_CASE(wrong_paths_are_noticed)
{
  Random random(12);
  const Straight input = random_points(15, random);
  Straight current = input;
  Normal_coordinates record(input.t);
  for(int i = 0; i < 100; ++i)
    current.flip(random.below(current.t.number_of_edges()), 2000, record);
  const std::vector<Path> paths = all_paths(current.t, record);
  const auto position = [&](Index h) { return record.position(current.t, h); };
  BOOST_TEST(arcs_are_disjoint(input.t, current.t, record, paths));
  BOOST_TEST(ends_are_right(input.t, current.t, paths));
  BOOST_TEST(order_is_right(input.t, current.t, paths, position));

  int exchanged = 0, shortened = 0, moved = 0;
  for(Index h = 0; h < paths.size(); ++h)
  {
    if(paths[h].is_edge)
      continue;
    for(Index g = h + 1; g < paths.size(); ++g) // two edges change places on an edge that both cross
      if(input.t.edge_halfedge(input.t.edge(h)) == h && input.t.edge_halfedge(input.t.edge(g)) == g
         && !paths[g].is_edge && paths[g].crossed[0] == paths[h].crossed[0])
      {
        std::vector<Path> wrong = paths;
        std::swap(wrong[g].strand[0], wrong[h].strand[0]);
        BOOST_TEST(!arcs_are_disjoint(input.t, current.t, record, wrong));
        ++exchanged;
      }
    std::vector<Path> wrong = paths;
    wrong[h].crossed.pop_back();
    wrong[h].strand.pop_back();
    BOOST_TEST(!ends_are_right(input.t, current.t, wrong));
    ++shortened;
    wrong = paths;
    wrong[h].first = current.t.next(wrong[h].first);
    BOOST_TEST(!order_is_right(input.t, current.t, wrong, position));
    ++moved;
  }
  BOOST_TEST(exchanged > 0);
  BOOST_TEST(shortened > 0);
  BOOST_TEST(moved > 0);
}
