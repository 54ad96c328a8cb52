// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// projective_interpolation.h: the circumcircle goes to the circumcircle (exactly, in rational arithmetic), the
// maps of neighbors agree on their edge for equivalent metrics and only for them, inverses are inverses.

#define BOOST_TEST_MODULE test_projective_interpolation
#include "include/boost_test.h"
#include "include/tolerances.h"

#include <CGAL/Conformal_equivalence/projective_interpolation.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
using testing::few_roundings;

typedef CGAL::Exact_rational                                  Rational;
typedef CGAL::Simple_cartesian<Rational>                      Rational_kernel;
typedef CGAL::Exact_predicates_inexact_constructions_kernel   Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3>                   Mesh;
typedef Mesh::Vertex_index                                    vertex_descriptor;
typedef Mesh::Halfedge_index                                  halfedge_descriptor;
typedef Mesh::Face_index                                      face_descriptor;

template <typename NT> using Point = std::array<NT, 2>;
template <typename NT> using Triangle = std::array<Point<NT>, 3>;
template <typename NT> using Triple = std::array<NT, 3>;

const double eps = std::numeric_limits<double>::epsilon();

std::mt19937 generator(2008);

double uniform(double from, double to)
{
  return std::uniform_real_distribution<double>(from, to)(generator);
}

double distance(const Point<double>& p, const Point<double>& q)
{
  return std::hypot(q[0] - p[0], q[1] - p[1]);
}

Triple<double> edge_lengths(const Triangle<double>& p)
{
  return {{ distance(p[1], p[2]), distance(p[2], p[0]), distance(p[0], p[1]) }};
}

double area(const Triangle<double>& p)
{
  return 0.5 * std::fabs((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]));
}

// How badly a triangle is shaped: (longest edge)^2 / area, the condition of what is computed from coordinates.
double shape(const Triangle<double>& p)
{
  const Triple<double> l = edge_lengths(p);
  const double longest = (std::max)({l[0], l[1], l[2]});
  return longest * longest / area(p);
}

Triangle<double> random_triangle()
{
  Triangle<double> p;
  do
    for(Point<double>& q : p)
      q = {{ uniform(-1, 1), uniform(-1, 1) }};
  while(shape(p) > 100);
  return p;
}

Triple<double> random_barycentric()
{
  const double a = uniform(0, 1), b = uniform(0, 1 - a);
  return {{ a, b, 1 - a - b }};
}

// ---------------------------------------------------------------------------------------------------
// One triangle
// ---------------------------------------------------------------------------------------------------

// An inversion of the plane; |f(x) - f(y)| = rho(x) rho(y) |x - y| with rho(x) = r / |x - c|.
template <typename NT>
struct Inversion
{
  Point<NT> c;
  NT squared_radius;

  NT squared_distance(const Point<NT>& p) const
  {
    return (p[0] - c[0]) * (p[0] - c[0]) + (p[1] - c[1]) * (p[1] - c[1]);
  }
  Point<NT> operator()(const Point<NT>& p) const
  {
    const NT factor = squared_radius / squared_distance(p);
    return {{ c[0] + factor * (p[0] - c[0]), c[1] + factor * (p[1] - c[1]) }};
  }
  NT weight(const Point<NT>& p) const { return squared_distance(p) / squared_radius; }     // e^-u = 1 / rho^2
};

Rational_kernel::Point_2 to_point(const Point<Rational>& p) { return Rational_kernel::Point_2(p[0], p[1]); }

// The second point of the line through p[0] with direction d on the circumcircle, which has the center m.
Point<Rational> point_of_circumcircle(const Triangle<Rational>& p, const Point<Rational>& d)
{
  const Rational_kernel::Point_2 m = CGAL::circumcenter(to_point(p[0]), to_point(p[1]), to_point(p[2]));
  const Rational dm = d[0] * (m.x() - p[0][0]) + d[1] * (m.y() - p[0][1]);
  const Rational t = 2 * dm / (d[0] * d[0] + d[1] * d[1]);
  return {{ Rational(p[0][0] + t * d[0]), Rational(p[0][1] + t * d[1]) }};
}

Rational random_rational() { return Rational(int(generator() % 2001) - 1000) / Rational(1000); }

// Exact, so also for needles: the projective image of every point of the circumcircle lies on the image's one.
BOOST_AUTO_TEST_CASE(circumcircle_to_circumcircle_exactly)
{
  for(int trial = 0; trial < 200; ++trial)
  {
    const bool needle = trial % 2 == 1;
    Triangle<Rational> p;
    for(Point<Rational>& q : p)
      q = {{ random_rational(), needle ? Rational(random_rational() / Rational(1e12)) : random_rational() }};
    if(CGAL::collinear(to_point(p[0]), to_point(p[1]), to_point(p[2])))
      continue;

    const Inversion<Rational> f = { {{ random_rational(), Rational(1) / Rational(7) }}, 1 };
    const Triangle<Rational> image = {{ f(p[0]), f(p[1]), f(p[2]) }};
    const Triple<Rational> w = {{ f.weight(p[0]), f.weight(p[1]), f.weight(p[2]) }};
    for(int i = 0; i < 10; ++i)
    {
      const Point<Rational> q = point_of_circumcircle(p, {{ random_rational(), Rational(1) / Rational(3) }});
      const auto circle_side = [](const Triangle<Rational>& t, const Point<Rational>& x)
      {
        return CGAL::side_of_bounded_circle(to_point(t[0]), to_point(t[1]), to_point(t[2]), to_point(x));
      };
      BOOST_REQUIRE(circle_side(p, q) == CGAL::ON_BOUNDARY);
      const Triple<Rational> b = CE::inverse_linear_map(p, q);
      const Point<Rational> projective = CE::projective_map(image, w, b);
      BOOST_REQUIRE(circle_side(image, projective) == CGAL::ON_BOUNDARY);
      BOOST_REQUIRE((CE::inverse_projective_map(image, w, projective) == b));

      // The linear map and wrong weights do not do this, except at the vertices.
      if(std::all_of(b.begin(), b.end(), [](const Rational& b_i) { return b_i != 0; }) && (w[0] != w[1] || w[1] != w[2]))
      {
        BOOST_TEST((circle_side(image, CE::linear_map(image, b)) != CGAL::ON_BOUNDARY));
        BOOST_TEST((circle_side(image, CE::projective_map<Rational>(image, {{ w[0] * 2, w[1], w[2] }}, b))
                    != CGAL::ON_BOUNDARY));
      }
    }
  }
}

// The proof in Appendix D: a map is circumcircle preserving iff a_i a_j L_ij^2 / l_ij^2 is the same for all edges.
// Only products and quotients, so the bound holds for needles, caps, and all sizes.
BOOST_AUTO_TEST_CASE(weights_from_lengths)
{
  for(int trial = 0; trial < 10000; ++trial)
  {
    Triple<double> l, image_l;
    const double size = std::pow(10, uniform(-150, 150)), spread = trial % 3 == 0 ? 30 : 1;
    for(int i = 0; i < 3; ++i)
    {
      l[i] = size * std::exp(uniform(-spread, spread));
      image_l[i] = std::exp(uniform(-spread, spread)) / size;
    }
    const Triple<double> w = CE::circumcircle_preserving_weights(l, image_l);
    BOOST_REQUIRE((std::max)({w[0], w[1], w[2]}) == 1);
    Triple<double> mu;
    for(int i = 0; i < 3; ++i)
      mu[i] = 2 * (std::log(image_l[i]) - std::log(l[i])) + std::log(w[(i + 1) % 3]) + std::log(w[(i + 2) % 3]);
    const double bound = 8 * eps * (4 * std::fabs(std::log(size)) + 16 * spread + 8);     // of the logarithms
    BOOST_REQUIRE(std::fabs(mu[0] - mu[1]) <= bound);
    BOOST_REQUIRE(std::fabs(mu[1] - mu[2]) <= bound);
  }
}

// Two arbitrary triangles in double.
BOOST_AUTO_TEST_CASE(circumcircle_to_circumcircle_in_double)
{
  for(int trial = 0; trial < 1000; ++trial)
  {
    const Triangle<double> p = random_triangle(), image = random_triangle();
    const Triple<double> w = CE::circumcircle_preserving_weights(edge_lengths(p), edge_lengths(image));
    const auto circle = [](const Triangle<double>& t)
    {
      return Kernel::Circle_2(Kernel::Point_2(t[0][0], t[0][1]), Kernel::Point_2(t[1][0], t[1][1]),
                              Kernel::Point_2(t[2][0], t[2][1]));
    };
    const Kernel::Circle_2 c = circle(p), image_c = circle(image);
    const double r = std::sqrt(c.squared_radius()), image_r = std::sqrt(image_c.squared_radius());
    for(int i = 0; i < 16; ++i)
    {
      const double angle = uniform(0, 2 * CGAL_PI);
      const Point<double> q = {{ c.center().x() + r * std::cos(angle), c.center().y() + r * std::sin(angle) }};
      const Triple<double> b = CE::inverse_linear_map(p, q);
      const Point<double> x = CE::projective_map(image, w, b);
      // rounding of b relative to the sum of the terms, and how that moves the point of the circle
      const double sum = std::fabs(b[0] * w[0] + b[1] * w[1] + b[2] * w[2]);
      const double terms = std::fabs(b[0] * w[0]) + std::fabs(b[1] * w[1]) + std::fabs(b[2] * w[2]);
      const double bound = 64 * eps * shape(p) * shape(p) * shape(image) * (terms / sum) * (1 + 1 / sum);
      const double off = distance(x, {{ image_c.center().x(), image_c.center().y() }}) - image_r;
      BOOST_TEST(std::fabs(off) <= bound * (1 + image_r));
    }
  }
}

BOOST_AUTO_TEST_CASE(inverses_in_double)
{
  for(int trial = 0; trial < 1000; ++trial)
  {
    Triangle<double> p = random_triangle();
    const double condition = shape(p), scale = std::pow(10, uniform(-150, 150));
    for(Point<double>& q : p)
      q = {{ q[0] * scale, q[1] * scale }};
    Triple<double> w = {{ uniform(0.1, 1), uniform(0.1, 1), 1 }};
    const double weight_scale = std::pow(10, uniform(-150, 150));
    for(double& w_i : w)
      w_i *= weight_scale;

    const Triple<double> b = random_barycentric();
    const Triple<double> linear = CE::inverse_linear_map(p, CE::linear_map(p, b));
    const Triple<double> projective = CE::inverse_projective_map(p, w, CE::projective_map(p, w, b));
    const Triple<double> only = CE::inverse_projective_barycentric(CE::projective_barycentric(b, w), w);
    for(int i = 0; i < 3; ++i)
    {
      BOOST_TEST(std::fabs(linear[i] - b[i]) <= 16 * eps * condition);
      BOOST_TEST(std::fabs(projective[i] - b[i]) <= 16 * eps * condition * 10);
      BOOST_TEST(std::fabs(only[i] - b[i]) <= 16 * eps);
    }
  }
}

BOOST_AUTO_TEST_CASE(vertices_are_exact)
{
  const Triangle<double> p = {{ {{ 0.1, 0.7 }}, {{ 1. / 3, 0.2 }}, {{ 17.1, 1e-20 }} }};
  const Triple<double> w = {{ 1. / 3, 1e-30, 0.7 }};
  for(int i = 0; i < 3; ++i)
  {
    Triple<double> b = {{ 0, 0, 0 }};
    b[i] = 1;
    BOOST_TEST((CE::linear_map(p, b) == p[i]));
    BOOST_TEST((CE::projective_map(p, w, b) == p[i]));
    BOOST_TEST((CE::inverse_linear_map(p, p[i]) == b));
    BOOST_TEST((CE::inverse_projective_map(p, w, p[i]) == b));
  }
}

BOOST_AUTO_TEST_CASE(degenerate_triangles)
{
  const Triangle<double> segment = {{ {{ 0, 0 }}, {{ 4, 4 }}, {{ 1, 1 }} }}, point = {{ {{ 2, 3 }}, {{ 2, 3 }}, {{ 2, 3 }} }};
  BOOST_TEST((CE::inverse_linear_map<double>(segment, {{ 3, 3 }}) == Triple<double>{{ 0.25, 0.75, 0 }}));
  BOOST_TEST((CE::inverse_linear_map<double>(segment, {{ 4, 2 }}) == Triple<double>{{ 0.25, 0.75, 0 }}));
  BOOST_TEST((CE::inverse_linear_map<double>(point, {{ 3, 3 }}) == Triple<double>{{ 1, 0, 0 }}));
}

// ---------------------------------------------------------------------------------------------------
// On a mesh: a jittered grid of the plane
// ---------------------------------------------------------------------------------------------------

struct Grid
{
  Mesh mesh;
  std::vector<vertex_descriptor> v;

  explicit Grid(int n)
  {
    for(int j = 0; j <= n; ++j)
      for(int i = 0; i <= n; ++i)
        v.push_back(mesh.add_vertex({ i + uniform(-0.2, 0.2), j + uniform(-0.2, 0.2), 0 }));
    const auto at = [&](int i, int j) { return v[j * (n + 1) + i]; };
    for(int j = 0; j < n; ++j)
      for(int i = 0; i < n; ++i)
      {
        mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
        mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
      }
  }

  Point<double> point(vertex_descriptor v) const { return {{ mesh.point(v).x(), mesh.point(v).y() }}; }

  // i: the source of the i-th halfedge of the face
  Triangle<double> triangle(face_descriptor f) const
  {
    const halfedge_descriptor h = mesh.halfedge(f);
    return {{ point(mesh.source(h)), point(mesh.target(h)), point(mesh.target(mesh.next(h))) }};
  }
};

const Inversion<double> inversion = { {{ -1.5, -2.25 }}, 4. };

template <typename OtherKernel, typename Map>
auto lay_out(Grid& grid, Map map)
{
  typedef typename OtherKernel::Point_2 Point_2;
  auto uv = grid.mesh.template add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  for(halfedge_descriptor h : grid.mesh.halfedges())
  {
    const Point<double> q = map(grid.point(grid.mesh.target(h)));
    uv[h] = Point_2(q[0], q[1]);
  }
  return uv;
}

// The point with parameter t on the halfedge h of a face, in the barycentric coordinates of the face.
Triple<double> barycentric_on_edge(const Mesh& mesh, halfedge_descriptor h, double t)
{
  Triple<double> b = {{ 0, 0, 0 }};
  halfedge_descriptor g = mesh.halfedge(mesh.face(h));
  for(int i = 0; i < 3; ++i, g = mesh.next(g))
    if(g == h)
    {
      b[i] = 1 - t;
      b[(i + 1) % 3] = t;
    }
  return b;
}

// The largest jump of the circumcircle preserving maps of two neighbors on their edge.
template <typename UVMap>
double largest_jump(const Grid& grid, UVMap uv)
{
  double largest = 0;
  for(halfedge_descriptor h : grid.mesh.halfedges())
  {
    const halfedge_descriptor o = grid.mesh.opposite(h);
    if(grid.mesh.is_border(h) || grid.mesh.is_border(o))
      continue;
    for(double t : {0.25, 0.5, 0.8})
    {
      Point<double> x[2];
      for(int side = 0; side < 2; ++side)
      {
        const face_descriptor f = grid.mesh.face(side == 0 ? h : o);
        const Triangle<double> image = CE::internal::uv_corners(grid.mesh, uv, f);
        const Triple<double> w = CE::circumcircle_preserving_weights(edge_lengths(grid.triangle(f)), edge_lengths(image));
        x[side] = CE::projective_map(image, w, barycentric_on_edge(grid.mesh, side == 0 ? h : o, side == 0 ? t : 1 - t));
      }
      largest = (std::max)(largest, distance(x[0], x[1]));
    }
  }
  return largest;
}

BOOST_AUTO_TEST_CASE(continuity_across_edges)
{
  Grid grid(12);
  auto uv = lay_out<Kernel>(grid, inversion);
  BOOST_TEST(largest_jump(grid, uv) <= 1000 * few_roundings); // layouts are rounded in units of the whole

  // Not equivalent: another map, and an equivalent layout with one vertex moved by 1e-6.
  for(halfedge_descriptor h : grid.mesh.halfedges())
    if(grid.mesh.target(h) == grid.v[6 * 13 + 6])
      uv[h] = Kernel::Point_2(uv[h].x() + 1e-6, uv[h].y());
  BOOST_TEST(largest_jump(grid, uv) >= 1e-8); // about as much as that
  auto sheared = lay_out<Kernel>(grid, [](const Point<double>& p) { return Point<double>{{ p[0] + 0.5 * p[1], p[1] }}; });
  BOOST_TEST(largest_jump(grid, sheared) >= 1e-3);
}

BOOST_AUTO_TEST_CASE(weights_on_a_mesh)
{
  Grid grid(3);
  const vertex_descriptor isolated = grid.mesh.add_vertex({ 0, 0, 0 });
  auto u = grid.mesh.add_property_map<vertex_descriptor, double>("v:u", 2.).first;
  auto w = grid.mesh.add_property_map<vertex_descriptor, double>("v:w", -1.).first;
  u[grid.v[0]] = -3.5;
  u[grid.v[1]] = 5000;
  u[isolated] = -1000;
  CE::projective_weights(grid.mesh, u, w);
  BOOST_TEST(w[grid.v[0]] == 1);
  BOOST_TEST(w[grid.v[1]] == (std::numeric_limits<double>::min)());
  BOOST_TEST(w[isolated] == 1);
  BOOST_TEST(std::fabs(w[grid.v[2]] - std::exp(-5.5)) <= 2 * eps * std::exp(-5.5));
}

template <typename OtherKernel>
void check_maps_on_a_mesh(double precision)
{
  typedef typename OtherKernel::FT FT;
  typedef typename OtherKernel::Point_2 Point_2;
  Grid grid(6);
  const auto uv = lay_out<OtherKernel>(grid, inversion);
  auto u = grid.mesh.add_property_map<vertex_descriptor, double>("v:u").first;
  auto w = grid.mesh.add_property_map<vertex_descriptor, double>("v:w").first;
  for(vertex_descriptor v : grid.mesh.vertices())
    u[v] = -std::log(inversion.weight(grid.point(v)));
  CE::projective_weights(grid.mesh, u, w);

  for(face_descriptor f : grid.mesh.faces())
  {
    const Triangle<double> p = grid.triangle(f), image = {{ inversion(p[0]), inversion(p[1]), inversion(p[2]) }};
    const Triple<double> weights = CE::circumcircle_preserving_weights(edge_lengths(p), edge_lengths(image));
    const Triple<double> b = random_barycentric();
    const Triple<FT> bary = {{ FT(b[0]), FT(b[1]), FT(b[2]) }};

    const Point_2 linear = CE::linear_map(grid.mesh, uv, f, bary);
    const Point_2 projective = CE::projective_map(grid.mesh, uv, w, f, bary);
    const auto to_array = [](const Point_2& q)
    { return Point<double>{{ CGAL::to_double(q.x()), CGAL::to_double(q.y()) }}; };
    BOOST_TEST(distance(to_array(linear), CE::linear_map(image, b)) <= 64 * precision);
    BOOST_TEST(distance(to_array(projective), CE::projective_map(image, weights, b)) <= 64 * precision);

    const Triple<FT> linear_back = CE::inverse_linear_map(grid.mesh, uv, f, linear);
    const Triple<FT> projective_back = CE::inverse_projective_map(grid.mesh, uv, w, f, projective);
    const double largest = (std::max)({ std::fabs(image[0][0]), std::fabs(image[0][1]), 1. });
    const Triple<double> l = edge_lengths(image);
    const double condition = shape(image) * largest / (std::min)({ l[0], l[1], l[2] });
    for(int i = 0; i < 3; ++i)
    {
      BOOST_TEST(std::fabs(CGAL::to_double(linear_back[i]) - b[i]) <= 16 * precision * condition);
      BOOST_TEST(std::fabs(CGAL::to_double(projective_back[i]) - b[i]) <= 64 * precision * condition);
    }
  }
}

BOOST_AUTO_TEST_CASE(maps_on_a_mesh)
{
  check_maps_on_a_mesh<Kernel>(eps);
  check_maps_on_a_mesh<CGAL::Exact_predicates_exact_constructions_kernel>(eps);
  check_maps_on_a_mesh<CGAL::Simple_cartesian<float> >(std::numeric_limits<float>::epsilon());
}
