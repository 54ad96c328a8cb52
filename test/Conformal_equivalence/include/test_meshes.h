// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Generated surfaces for the tests: points and triangles, of which an
// `Intrinsic_triangulation` of any number type or a mesh of CGAL is made.

#ifndef CGAL_TEST_CONFORMAL_EQUIVALENCE_TEST_MESHES_H
#define CGAL_TEST_CONFORMAL_EQUIVALENCE_TEST_MESHES_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace testing {

typedef std::uint32_t Index;
typedef std::array<double, 3> Point;

constexpr double pi = 3.14159265358979323846;

struct Soup
{
  std::vector<Point> points;
  std::vector<std::array<Index, 3> > triangles;
};

// The same numbers on every platform.
class Random
{
  std::mt19937 engine_;

public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) { return low + (high - low) * (engine_() / 4294967296.); }
  Index below(Index n) { return Index(std::uint64_t(engine_()) * n >> 32); }
};

inline std::vector<double> random_numbers(std::size_t n, double bound, unsigned seed)
{
  Random random(seed);
  std::vector<double> result(n);
  for(double& x : result)
    x = random(-bound, bound);
  return result;
}

template <typename NT>
NT distance(const Point& p, const Point& q)
{
  using std::sqrt;
  const NT x = NT(p[0]) - q[0], y = NT(p[1]) - q[1], z = NT(p[2]) - q[2];
  return sqrt(NT(x * x + y * y + z * z));
}

template <typename NT = double>
CGAL::Conformal_equivalence::Intrinsic_triangulation<NT> triangulation(const Soup& soup)
{
  std::vector<Index> origin;
  for(const std::array<Index, 3>& t : soup.triangles)
    origin.insert(origin.end(), t.begin(), t.end());
  CGAL::Conformal_equivalence::Intrinsic_triangulation<NT>
    result(Index(soup.points.size()), origin, CGAL::Conformal_equivalence::glue_triangles(soup.triangles));
  for(Index e = 0; e < result.number_of_edges(); ++e)
  {
    const Index h = result.edge_halfedge(e);
    result.set_length(e, distance<NT>(soup.points[result.origin(h)], soup.points[result.target(h)]));
  }
  return result;
}

// The same lengths, widened to NT exactly.
template <typename NT>
CGAL::Conformal_equivalence::Intrinsic_triangulation<NT>
widened(const CGAL::Conformal_equivalence::Intrinsic_triangulation<double>& t)
{
  return t.template with_lengths<NT>(std::vector<NT>(t.lengths().begin(), t.lengths().end()));
}

template <typename Mesh>
Mesh surface_mesh(const Soup& soup)
{
  Mesh mesh;
  typedef typename Mesh::Vertex_index Vertex_index;
  for(const Point& p : soup.points)
    mesh.add_vertex(typename Mesh::Point(p[0], p[1], p[2]));
  for(const std::array<Index, 3>& t : soup.triangles)
    mesh.add_face(Vertex_index(t[0]), Vertex_index(t[1]), Vertex_index(t[2]));
  return mesh;
}

// n x n squares over [0,1]^2, each cut along a diagonal, at the height z(x, y).
template <typename Height>
Soup grid(Index n, Height z)
{
  Soup soup;
  for(Index j = 0; j <= n; ++j)
    for(Index i = 0; i <= n; ++i)
      soup.points.push_back({{double(i) / n, double(j) / n, z(double(i) / n, double(j) / n)}});
  for(Index j = 0; j < n; ++j)
    for(Index i = 0; i < n; ++i)
    {
      const Index a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      soup.triangles.push_back({{a, b, d}});
      soup.triangles.push_back({{a, d, c}});
    }
  return soup;
}

// n x m unit squares in the plane, each cut along a diagonal; vertex (i, j) is number (m + 1) i + j.
inline Soup strip(Index n, Index m)
{
  Soup soup;
  for(Index i = 0; i <= n; ++i)
    for(Index j = 0; j <= m; ++j)
      soup.points.push_back({{double(i), double(j), 0}});
  for(Index i = 0; i < n; ++i)
    for(Index j = 0; j < m; ++j)
    {
      const Index a = (m + 1) * i + j, b = a + m + 1;
      soup.triangles.push_back({{a, b, b + 1}});
      soup.triangles.push_back({{a, b + 1, a + 1}});
    }
  return soup;
}

inline Soup flat_grid(Index n)
{
  return grid(n, [](double, double) { return 0.; });
}

inline Soup hill(Index n, double height)
{
  return grid(n, [=](double x, double y)
              { return height * std::exp(-8 * ((x - .4) * (x - .4) + (y - .6) * (y - .6))) + .3 * height * x * y; });
}

inline void add_noise(Soup& soup, double amplitude, unsigned seed)
{
  Random random(seed);
  for(Point& p : soup.points)
    for(double& x : p)
      x += random(-amplitude, amplitude);
}

inline Soup random_height_field(Index n, double amplitude, unsigned seed)
{
  Soup soup = flat_grid(n);
  Random random(seed);
  for(Point& p : soup.points)
    p[2] = random(0, amplitude / n);
  return soup;
}

// An apex, vertex 0, over a regular polygon of n vertices on the unit circle.
inline Soup cone(Index n, double height)
{
  Soup soup;
  soup.points.push_back({{0, 0, height}});
  for(Index i = 0; i < n; ++i)
  {
    soup.points.push_back({{std::cos(2 * pi * i / n), std::sin(2 * pi * i / n), 0}});
    soup.triangles.push_back({{0, 1 + i, 1 + (i + 1) % n}});
  }
  return soup;
}

inline Soup one_triangle(const Point& a, const Point& b, const Point& c)
{
  return Soup{{a, b, c}, {{{0, 1, 2}}}};
}

inline Soup icosahedron()
{
  const double g = (1 + std::sqrt(5.)) / 2;
  return Soup{{{{-1, g, 0}}, {{1, g, 0}}, {{-1, -g, 0}}, {{1, -g, 0}}, {{0, -1, g}}, {{0, 1, g}},
               {{0, -1, -g}}, {{0, 1, -g}}, {{g, 0, -1}}, {{g, 0, 1}}, {{-g, 0, -1}}, {{-g, 0, 1}}},
              {{{0, 11, 5}}, {{0, 5, 1}}, {{0, 1, 7}}, {{0, 7, 10}}, {{0, 10, 11}}, {{1, 5, 9}}, {{5, 11, 4}},
               {{11, 10, 2}}, {{10, 7, 6}}, {{7, 1, 8}}, {{3, 9, 4}}, {{3, 4, 2}}, {{3, 2, 6}}, {{3, 6, 8}},
               {{3, 8, 9}}, {{4, 9, 5}}, {{2, 4, 11}}, {{6, 2, 10}}, {{8, 6, 7}}, {{9, 8, 1}}}};
}

// An icosahedron with each triangle cut into four `levels` times, on the unit sphere.
inline Soup icosphere(int levels)
{
  Soup soup = icosahedron();
  const auto project = [](Point p)
  {
    const double d = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    return Point{{p[0] / d, p[1] / d, p[2] / d}};
  };
  for(Point& p : soup.points)
    p = project(p);
  for(; levels > 0; --levels)
  {
    std::map<std::pair<Index, Index>, Index> middle;
    const auto middle_of = [&](Index a, Index b)
    {
      const auto entry = middle.emplace(std::minmax(a, b), Index(soup.points.size()));
      if(entry.second)
      {
        const Point p = soup.points[a], q = soup.points[b];
        soup.points.push_back(project({{p[0] + q[0], p[1] + q[1], p[2] + q[2]}}));
      }
      return entry.first->second;
    };
    std::vector<std::array<Index, 3> > finer;
    for(const std::array<Index, 3>& t : soup.triangles)
    {
      const Index a = middle_of(t[0], t[1]), b = middle_of(t[1], t[2]), c = middle_of(t[2], t[0]);
      finer.insert(finer.end(), {{{t[0], a, c}}, {{a, t[1], b}}, {{c, b, t[2]}}, {{a, b, c}}});
    }
    soup.triangles.swap(finer);
  }
  return soup;
}

// An m x n grid, closed around in the second direction, and in the first if `closed`; `place(i, j)` is the point.
template <typename Place>
Soup tube(Index m, Index n, bool closed, Place place)
{
  Soup soup;
  const Index rows = closed ? m : m + 1;
  for(Index i = 0; i < rows; ++i)
    for(Index j = 0; j < n; ++j)
      soup.points.push_back(place(i, j));
  for(Index i = 0; i < m; ++i)
    for(Index j = 0; j < n; ++j)
    {
      const Index k = (i + 1) % rows, l = (j + 1) % n;
      soup.triangles.push_back({{i * n + j, k * n + j, k * n + l}});
      soup.triangles.push_back({{i * n + j, k * n + l, i * n + l}});
    }
  return soup;
}

inline Soup torus(Index m, Index n, double radius = 3, double inner_radius = 1)
{
  return tube(m, n, true, [=](Index i, Index j)
  {
    const double x = 2 * pi * i / m, y = 2 * pi * j / n, r = radius + inner_radius * std::cos(y);
    return Point{{r * std::cos(x), r * std::sin(x), inner_radius * std::sin(y)}};
  });
}

// The part between two concentric circles, raised by height.
inline Soup annulus(Index m, Index n, double height = 0)
{
  return tube(m, n, false, [=](Index i, Index j)
  {
    const double r = 1 + double(i) / m, phi = 2 * pi * j / n;
    return Point{{r * std::cos(phi), r * std::sin(phi), height * std::sin(pi * i / m) * (1 + .3 * std::cos(phi))}};
  });
}

// Several surfaces side by side, with isolated vertices between them.
inline Soup together(const std::vector<Soup>& soups, bool isolated_vertices = false)
{
  Soup result;
  for(const Soup& soup : soups)
  {
    if(isolated_vertices)
      result.points.push_back({{0, 0, 0}});
    const Index first = Index(result.points.size());
    result.points.insert(result.points.end(), soup.points.begin(), soup.points.end());
    for(const std::array<Index, 3>& t : soup.triangles)
      result.triangles.push_back({{first + t[0], first + t[1], first + t[2]}});
  }
  return result;
}

// Two triangles with sides a, b, c each, glued to a torus with a single vertex: a Delta-complex
// that no halfedge data structure can hold.
template <typename NT = double>
CGAL::Conformal_equivalence::Intrinsic_triangulation<NT> one_vertex_torus(NT a, NT b, NT c)
{
  CGAL::Conformal_equivalence::Intrinsic_triangulation<NT> result(1, std::vector<Index>(6, 0), {3, 4, 5, 0, 1, 2});
  result.set_length(0, a);
  result.set_length(1, b);
  result.set_length(2, c);
  return result;
}

// Six triangles around the origin, and rings around them, at the height z(x, y).
template <typename Height>
Soup rings(Index number_of_rings, Height z)
{
  Soup soup;
  const auto add = [&](double r, double phi)
  {
    const double x = r * std::cos(phi), y = r * std::sin(phi);
    soup.points.push_back({{x, y, z(x, y)}});
  };
  add(0, 0);
  Index inner = 0, outer = 1; // the first vertices of two rings
  for(Index k = 1; k <= number_of_rings; ++k)
  {
    for(Index i = 0; i < 6 * k; ++i)
      add(double(k) / number_of_rings, 2 * pi * i / (6 * k));
    const Index n = (std::max)(6 * (k - 1), Index(1));
    for(Index s = 0; s < 6; ++s)
      for(Index i = 0; i < k; ++i)
      {
        const Index a = outer + s * k + i, b = outer + (s * k + i + 1) % (6 * k), c = inner + (s * (k - 1) + i) % n;
        soup.triangles.push_back({{a, b, c}});
        if(i + 1 < k)
          soup.triangles.push_back({{b, inner + (s * (k - 1) + i + 1) % n, c}});
      }
    inner = outer;
    outer += 6 * k;
  }
  return soup;
}

// Squares cut into four triangles each: as symmetric as a square.
template <typename Height>
Soup symmetric_grid(Index n, Height z)
{
  Soup soup = grid(n, z);
  soup.triangles.clear();
  for(Index j = 0; j < n; ++j)
    for(Index i = 0; i < n; ++i)
    {
      const Index a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1, m = Index(soup.points.size());
      const double x = (i + .5) / n, y = (j + .5) / n;
      soup.points.push_back({{x, y, z(x, y)}});
      soup.triangles.insert(soup.triangles.end(), {{{a, b, m}}, {{b, d, m}}, {{d, c, m}}, {{c, a, m}}});
    }
  return soup;
}

// A disk with bumps: the place x, y of each, its height, and its width.
inline Soup disk_with_bumps(Index n, const std::vector<std::array<double, 4> >& bumps)
{
  return symmetric_grid(n, [&](double x, double y)
  {
    double z = 0;
    for(const std::array<double, 4>& b : bumps)
      z += b[2] * std::exp(-((x - b[0]) * (x - b[0]) + (y - b[1]) * (y - b[1])) / (b[3] * b[3]));
    return z;
  });
}

// A sphere with four arms, each longer than the last one by `growth`.
inline Soup arms(int levels, double growth)
{
  Soup soup = icosphere(levels);
  for(Point& p : soup.points)
  {
    double r = 1, length = 0.8;
    for(const Point& d : {Point{{1, 0, 0}}, Point{{-0.5, 0.8, 0.1}}, Point{{-0.4, -0.6, 0.7}}, Point{{0, -0.2, -1}}})
    {
      const double norm = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), c = (p[0] * d[0] + p[1] * d[1] + p[2] * d[2]) / norm;
      r += length * std::exp(7 * (c - 1));
      length += growth;
    }
    for(double& x : p)
      x *= r;
  }
  return soup;
}

// A pyramid over a regular polygon, with a triangle on each of its sides.
inline Soup star(Index n)
{
  Soup soup = cone(n, .5);
  for(Index i = 0; i < n; ++i)
  {
    soup.points.push_back({{2 * std::cos(2 * pi * (i + .5) / n), 2 * std::sin(2 * pi * (i + .5) / n), 0}});
    soup.triangles.push_back({{1 + (i + 1) % n, 1 + i, 1 + n + i}});
  }
  return soup;
}

inline Soup scaled(Soup soup, double x, double y, double z)
{
  for(Point& p : soup.points)
    p = {{p[0] * x, p[1] * y, p[2] * z}};
  return soup;
}

inline Soup scaled(const Soup& soup, double factor) { return scaled(soup, factor, factor, factor); }

} // namespace testing

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_TEST_MESHES_H
