// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// conformal_distortion.h: affine maps with known singular values, of triangles of all shapes and sizes.

#define BOOST_TEST_MODULE test_conformal_distortion
#include "include/boost_test.h"

#include <CGAL/Conformal_equivalence/conformal_distortion.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;

typedef CGAL::Exact_predicates_inexact_constructions_kernel   Kernel;
typedef Kernel::Point_2                                       Point_2;
typedef Kernel::Point_3                                       Point_3;
typedef CGAL::Surface_mesh<Point_3>                           Mesh;
typedef Mesh::Vertex_index                                    vertex_descriptor;
typedef Mesh::Halfedge_index                                  halfedge_descriptor;
typedef Mesh::Edge_index                                      edge_descriptor;
typedef Mesh::Face_index                                      face_descriptor;
typedef Mesh::Property_map<halfedge_descriptor, Point_2>      UV_map;

typedef std::array<double, 2>        Point;
typedef std::array<Point, 3>         Triangle;

const double eps = std::numeric_limits<double>::epsilon();
const double infinity = std::numeric_limits<double>::infinity();
const double nan_value = std::numeric_limits<double>::quiet_NaN();

std::mt19937 generator(71);

double uniform(double from, double to)
{
  return std::uniform_real_distribution<double>(from, to)(generator);
}

double distance(const Point& p, const Point& q) { return std::hypot(q[0] - p[0], q[1] - p[1]); }

std::array<double, 3> edge_lengths(const Triangle& p)
{
  return {{ distance(p[1], p[2]), distance(p[2], p[0]), distance(p[0], p[1]) }};
}

// (longest edge)^2 / area: the condition of an affine map between triangles given by coordinates; its square is
// that of a map from lengths.
double shape(const Triangle& p)
{
  const std::array<double, 3> l = edge_lengths(p);
  const double longest = (std::max)({ l[0], l[1], l[2] });
  return 2 * longest * longest
    / std::fabs((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]));
}

Triangle random_triangle()
{
  Triangle p;
  do
    for(Point& q : p)
      q = {{ uniform(-1, 1), uniform(-1, 1) }};
  while(shape(p) > 100);
  return p;
}

// rotation * diag(s, 1) * rotation * scale
struct Affine_map
{
  double a, b, c, d;

  Affine_map(double angle, double s, double angle2, double scale)
  {
    const double x = std::cos(angle), y = std::sin(angle), z = std::cos(angle2), w = std::sin(angle2);
    a = scale * (x * s * z - y * w);
    b = scale * (-x * s * w - y * z);
    c = scale * (y * s * z + x * w);
    d = scale * (-y * s * w + x * z);
  }
  Point operator()(const Point& p) const { return {{ a * p[0] + b * p[1], c * p[0] + d * p[1] }}; }
  Triangle operator()(const Triangle& p) const { return {{ (*this)(p[0]), (*this)(p[1]), (*this)(p[2]) }}; }
};

// ---------------------------------------------------------------------------------------------------
// One triangle
// ---------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(known_singular_values)
{
  for(int trial = 0; trial < 5000; ++trial)
  {
    const Triangle p = random_triangle();
    const double s = std::pow(10, uniform(0, 3)), scale = std::pow(10, uniform(-140, 140));
    const double reflection = trial % 2 == 0 ? 1 : -1;
    const Affine_map map(uniform(0, 7), reflection * s, uniform(0, 7), 1);
    const Triangle unscaled = map(p);
    Triangle image = unscaled;
    for(Point& q : image)
      q = {{ scale * q[0], scale * q[1] }};
    std::array<double, 3> l = edge_lengths(p);
    for(double& l_i : l)
      l_i /= scale;
    const double factor = CE::quasi_conformal_factor(l, image);
    BOOST_TEST(factor >= 1);
    BOOST_TEST(std::fabs(factor - s) <= 32 * eps * s * (shape(p) * shape(p) + shape(unscaled)));
  }
}

// A similarity must not show a distortion of the size sqrt(eps), nor a needle one of the size of its shape.
BOOST_AUTO_TEST_CASE(similarities)
{
  for(int trial = 0; trial < 5000; ++trial)
  {
    const Triangle p = random_triangle();
    const double factor = CE::quasi_conformal_factor(edge_lengths(p), Affine_map(uniform(0, 7), 1, 0, 3)(p));
    BOOST_TEST(factor - 1 <= 32 * eps * shape(p) * shape(p));
  }
  for(const double t : {1e-8, 1e-100, 1e-150})
  {
    const Triangle needle = {{ {{ 0, 0 }}, {{ 1, 0 }}, {{ 0, t }} }};
    BOOST_TEST(CE::quasi_conformal_factor({{ 1, t, 1 }}, needle) - 1 <= 1e-7 + eps);
    const double quarter = CE::quasi_conformal_factor({{ 1, t, 1 }}, {{ {{ 0, 0 }}, {{ 1, 0 }}, {{ 0, t / 4 }} }});
    BOOST_TEST(std::fabs(quarter - 4) <= 1e-7);
  }
}

BOOST_AUTO_TEST_CASE(degenerate_triangles)
{
  const std::array<double, 3> unit = {{ 1, 1, 1 }};
  const Triangle good = {{ {{ 0, 0 }}, {{ 1, 0 }}, {{ 0.5, 0.8 }} }};
  BOOST_TEST(CE::quasi_conformal_factor(unit, {{ {{ 0, 0 }}, {{ 1, 0 }}, {{ 0.3, 0 }} }}) == infinity);
  BOOST_TEST(CE::quasi_conformal_factor(unit, {{ {{ 0.1, 0.1 }}, {{ 0.7, 0.7 }}, {{ 12.3, 12.3 }} }}) == infinity);
  BOOST_TEST(CE::quasi_conformal_factor(unit, {{ {{ 1, 2 }}, {{ 1, 2 }}, {{ 1, 2 }} }}) == infinity);
  BOOST_TEST(CE::quasi_conformal_factor(unit, {{ {{ 1, 2 }}, {{ nan_value, 2 }}, {{ 1, 3 }} }}) == infinity);
  BOOST_TEST(std::isnan(CE::quasi_conformal_factor({{ 1, 1, 2 }}, good)));
  BOOST_TEST(std::isnan(CE::quasi_conformal_factor({{ 1, 1, 2.5 }}, good)));
  BOOST_TEST(std::isnan(CE::quasi_conformal_factor({{ 0, 1, 1 }}, good)));
  BOOST_TEST(std::isnan(CE::quasi_conformal_factor({{ 0, 0, 0 }}, good)));
  for(int i = 0; i < 3; ++i)
    for(double bad : {nan_value, infinity, -1.})
    {
      std::array<double, 3> l = unit;
      l[i] = bad;
      BOOST_TEST(std::isnan(CE::quasi_conformal_factor(l, good)));
    }
}

// ---------------------------------------------------------------------------------------------------
// Meshes
// ---------------------------------------------------------------------------------------------------

Mesh grid(int n, double jitter, double scale = 1)
{
  Mesh mesh;
  for(int j = 0; j <= n; ++j)
    for(int i = 0; i <= n; ++i)
      mesh.add_vertex({ scale * (i + uniform(-jitter, jitter)), scale * (j + uniform(-jitter, jitter)), 0 });
  const auto at = [&](int i, int j) { return vertex_descriptor(j * (n + 1) + i); };
  for(int j = 0; j < n; ++j)
    for(int i = 0; i < n; ++i)
    {
      mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return mesh;
}

template <typename Map>
UV_map lay_out(Mesh& mesh, Map map)
{
  UV_map uv = mesh.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  for(halfedge_descriptor h : mesh.halfedges())
  {
    const Point_3& p = mesh.point(mesh.target(h));
    const Point q = map(Point{{ p.x(), p.y() }});
    uv[h] = Point_2(q[0], q[1]);
  }
  return uv;
}

BOOST_AUTO_TEST_CASE(stretched_grid_at_all_sizes)
{
  for(const double scale : {1., 1e-150, 1e150})
  {
    Mesh mesh = grid(10, 0.2, scale);
    const UV_map uv = lay_out(mesh, [=](const Point& p) { return Point{{ 2.5 * p[0], -p[1] }}; });
    const CE::Conformal_distortion<Mesh> d = CE::compute_conformal_distortion(mesh, uv);
    BOOST_TEST(std::fabs(d.mean_quasi_conformal_factor - 2.5) <= 1e-12);
    BOOST_TEST(std::fabs(d.maximum_quasi_conformal_factor - 2.5) <= 1e-12);
    BOOST_TEST(d.maximum_quasi_conformal_factor == CE::quasi_conformal_factor(mesh, uv, d.face_of_maximum));
    BOOST_TEST(std::fabs(d.minimum_log_area_ratio) <= 1e-12);
    BOOST_TEST(std::fabs(d.maximum_log_area_ratio) <= 1e-12);
    BOOST_TEST(d.root_mean_square_log_area_ratio <= 1e-12);
    BOOST_TEST(d.number_of_skipped_faces == 0u);
    BOOST_TEST(d.number_of_collapsed_faces == 0u);
  }
}

// Two triangles of areas 1/2 and 3/2 with factors 1 and 2, laid out with areas 1/2 and 3.
BOOST_AUTO_TEST_CASE(area_weights)
{
  Mesh mesh;
  const vertex_descriptor o = mesh.add_vertex({ 0, 0, 0 }), a = mesh.add_vertex({ 1, 0, 0 }),
                          b = mesh.add_vertex({ 0, 1, 0 }), c = mesh.add_vertex({ 0, 0, 3 });
  const face_descriptor f = mesh.add_face(o, a, b), g = mesh.add_face(o, b, c);
  BOOST_REQUIRE(g != Mesh::null_face());
  UV_map uv = mesh.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  const auto corner = [&](vertex_descriptor v)
  { return v == o ? Point_2(0, 0) : v == a ? Point_2(1, 0) : v == b ? Point_2(0, 1) : Point_2(-6, 0); };
  for(halfedge_descriptor h : mesh.halfedges())
    uv[h] = corner(mesh.target(h));

  const CE::Conformal_distortion<Mesh> d = CE::compute_conformal_distortion(mesh, uv);
  BOOST_TEST(CE::quasi_conformal_factor(mesh, uv, f) == 1);
  BOOST_TEST(std::fabs(CE::quasi_conformal_factor(mesh, uv, g) - 2) <= 4 * eps);
  BOOST_TEST(std::fabs(d.mean_quasi_conformal_factor - 1.75) <= 8 * eps);
  BOOST_TEST((d.face_of_maximum == g));
  const double low = std::log(1 / 1.75), high = std::log(2 / 1.75);        // totals 2 and 3.5
  BOOST_TEST(std::fabs(d.minimum_log_area_ratio - low) <= 8 * eps);
  BOOST_TEST(std::fabs(d.maximum_log_area_ratio - high) <= 8 * eps);
  BOOST_TEST(std::fabs(d.root_mean_square_log_area_ratio - std::sqrt(0.25 * low * low + 0.75 * high * high)) <= 8 * eps);
}

// Needles and caps with points: the error is at most eps * length / height, where lengths would give its square.
BOOST_AUTO_TEST_CASE(needles_and_caps_from_points)
{
  for(const double height : {1e-5, 1e-9, 1e-12, 1e-150})
    for(const double x : {0.5, 0., 0.9375, 0.3})
    {
      Mesh mesh;
      mesh.add_face(mesh.add_vertex({ 0, 0, 0 }), mesh.add_vertex({ 1, 0, 0 }), mesh.add_vertex({ x, 0, height }));
      UV_map uv = mesh.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
      for(const double stretch : {1., 4., 0.25})
      {
        for(halfedge_descriptor h : mesh.halfedges())
          uv[h] = Point_2(mesh.point(mesh.target(h)).x(), stretch * mesh.point(mesh.target(h)).z());
        const double expected = (std::max)(stretch, 1 / stretch);
        const double condition = x == 0 ? 1 : 1 + 1 / height;
        BOOST_TEST(std::fabs(CE::quasi_conformal_factor(mesh, uv, face_descriptor(0)) - expected)
                   <= 16 * eps * expected * condition);
      }
    }
}

BOOST_AUTO_TEST_CASE(degenerate_faces_are_counted)
{
  Mesh mesh = grid(4, 0);
  const UV_map uv = lay_out(mesh, [](const Point& p) { return p; });
  mesh.point(vertex_descriptor(0)) = mesh.point(vertex_descriptor(6));          // collapses (0,0) into (1,1)
  CE::Conformal_distortion<Mesh> d = CE::compute_conformal_distortion(mesh, uv);
  BOOST_TEST(d.number_of_skipped_faces == 2u);
  BOOST_TEST(d.mean_quasi_conformal_factor == 1);

  Mesh other = grid(4, 0);
  UV_map collapsed = lay_out(other, [](const Point& p) { return p; });
  for(halfedge_descriptor h : CGAL::halfedges_around_face(other.halfedge(face_descriptor(3)), other))
    collapsed[h] = Point_2(1, 1);
  d = CE::compute_conformal_distortion(other, collapsed);
  BOOST_TEST(d.number_of_collapsed_faces == 1u);
  BOOST_TEST((d.face_of_maximum == face_descriptor(3)));
  BOOST_TEST(d.mean_quasi_conformal_factor == infinity);
  BOOST_TEST(d.minimum_log_area_ratio == -infinity);
  BOOST_TEST(std::isfinite(d.maximum_log_area_ratio));

  const Mesh empty;
  Mesh no_face;
  BOOST_TEST(CE::compute_conformal_distortion(no_face, lay_out(no_face, [](const Point& p) { return p; }))
             .mean_quasi_conformal_factor == 1);
}

// An inversion: conformally equivalent, u = -2 log |x - c|.
BOOST_AUTO_TEST_CASE(named_parameters_and_scale_factors)
{
  Mesh mesh = grid(8, 0.2);
  const UV_map uv = lay_out(mesh, [](const Point& p)
                            {
                              const double x = p[0] + 2, y = p[1] + 3, r = x * x + y * y;
                              return Point{{ x / r, -y / r }};
                            });
  auto u = mesh.add_property_map<vertex_descriptor, double>("v:u").first;
  auto length = mesh.add_property_map<edge_descriptor, double>("e:length").first;
  double smallest = infinity, largest = -infinity;
  for(vertex_descriptor v : mesh.vertices())
  {
    u[v] = -2 * std::log(std::hypot(mesh.point(v).x() + 2, mesh.point(v).y() + 3));
    smallest = (std::min)(smallest, u[v]);
    largest = (std::max)(largest, u[v]);
  }
  for(edge_descriptor e : mesh.edges())
    length[e] = std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));

  const auto from_points = CE::compute_conformal_distortion(mesh, uv);
  const auto with_u = CE::compute_conformal_distortion(mesh, uv, params::log_scale_factor_map(u));
  const auto from_lengths = CE::compute_conformal_distortion(mesh, uv, params::edge_length_map(length));
  const auto both = CE::compute_conformal_distortion(mesh, uv, params::log_scale_factor_map(u).edge_length_map(length));
  const auto vpm = CE::compute_conformal_distortion(mesh, uv, params::vertex_point_map(mesh.points()));

  BOOST_TEST(with_u.minimum_log_scale_factor == smallest);
  BOOST_TEST(with_u.maximum_log_scale_factor == largest);
  BOOST_TEST(both.maximum_log_scale_factor == largest);
  for(const auto& d : { from_points, from_lengths, vpm })
  {
    BOOST_TEST(std::fabs(d.minimum_log_scale_factor - smallest) <= 1e-12);
    BOOST_TEST(std::fabs(d.maximum_log_scale_factor - largest) <= 1e-12);
    BOOST_TEST(std::fabs(d.mean_quasi_conformal_factor - from_points.mean_quasi_conformal_factor) <= 1e-12);
    BOOST_TEST(std::fabs(d.maximum_quasi_conformal_factor - from_points.maximum_quasi_conformal_factor) <= 1e-11);
    BOOST_TEST(std::fabs(d.root_mean_square_log_area_ratio - from_points.root_mean_square_log_area_ratio) <= 1e-12);
  }
  BOOST_TEST(from_points.mean_quasi_conformal_factor > 1.01);
  BOOST_TEST(from_points.maximum_quasi_conformal_factor < 2);

  for(edge_descriptor e : mesh.edges())                     // other lengths must be seen
    length[e] = 1;
  BOOST_TEST(std::fabs(CE::compute_conformal_distortion(mesh, uv, params::edge_length_map(length)).mean_quasi_conformal_factor
                       - from_points.mean_quasi_conformal_factor) > 0.1);
}

template <typename OtherKernel>
void check_value_type()
{
  Mesh mesh = grid(3, 0);
  auto uv = mesh.add_property_map<halfedge_descriptor, typename OtherKernel::Point_2>("h:other_uv").first;
  for(halfedge_descriptor h : mesh.halfedges())
    uv[h] = typename OtherKernel::Point_2(2 * mesh.point(mesh.target(h)).x(), mesh.point(mesh.target(h)).y());
  BOOST_TEST(std::fabs(CE::compute_conformal_distortion(mesh, uv).mean_quasi_conformal_factor - 2) <= 8 * eps);
}

BOOST_AUTO_TEST_CASE(value_types)
{
  check_value_type<CGAL::Simple_cartesian<float> >();
  check_value_type<CGAL::Simple_cartesian<double> >();
}
