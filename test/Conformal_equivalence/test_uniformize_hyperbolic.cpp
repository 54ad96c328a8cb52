// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Hyperbolic metrics, their layouts and groups, in floating-point and in rational numbers.

#define BOOST_TEST_MODULE test_uniformize_hyperbolic
#include "include/boost_test.h"
#include "include/test_meshes.h"
#include "include/tolerances.h"

#include <CGAL/Conformal_equivalence/Exact_hyperbolic_surface.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/compute_hyperbolic_metric.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Hyperbolic_energy.h>
#include <CGAL/Conformal_equivalence/make_triangulation_on_hyperbolic_surface.h>
#include <CGAL/Conformal_equivalence/multiprecision.h>
#include <CGAL/Conformal_equivalence/uniformize_hyperbolic.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;

typedef std::uint32_t                                                Index;
typedef CE::Intrinsic_triangulation<double>                          Triangulation;
typedef CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>  Mesh;
using testing::pi;

namespace {

// ---- Surfaces

// The surface with these gluings, its vertices found by turning around them; all lengths are 1.
Triangulation glued(const std::vector<Index>& twin)
{
  const Index none = Triangulation::null_index;
  std::vector<Index> origin(twin.size(), none);
  Index n = 0;
  for(Index first = 0; first < twin.size(); ++first)
  {
    if(origin[first] != none)
      continue;
    for(Index h = first; origin[h] == none; h = twin[Triangulation::previous(h)])
      origin[h] = n;
    ++n;
  }
  return Triangulation(n, origin, twin);
}

// Matrices modulo p up to a factor: the first entry that is not 0 is 1.
typedef std::array<int, 4> Matrix;

Matrix product(const Matrix& x, const Matrix& y, int p)
{
  Matrix m = {{(x[0] * y[0] + x[1] * y[2]) % p, (x[0] * y[1] + x[1] * y[3]) % p, (x[2] * y[0] + x[3] * y[2]) % p, (x[2] * y[1] + x[3] * y[3]) % p}};
  int lead = 0;
  for(int k = 3; k >= 0; --k)
    lead = m[k] != 0 ? m[k] : lead;
  int inverse = 1;
  while(lead * inverse % p != 1)
    ++inverse;
  for(int& x_k : m)
    x_k = x_k * inverse % p;
  return m;
}

int order(const Matrix& m, int p)
{
  Matrix power = m;
  int n = 1;
  for(; !(power[1] == 0 && power[2] == 0 && power[0] == power[3]); ++n)
    power = product(power, m, p);
  return n;
}

// A regular map: k triangles around every vertex. Its halfedges are the elements of a group of matrices modulo p; the twin is the product with an
// element of order 2, the next one that with an element of order 3, and the product of these has the order k. For k = p = 7 it is that of Klein's
// quartic.
Triangulation regular_map(int p, int k)
{
  const Matrix one = {{1, 0, 0, 1}};
  Matrix s = one, t = one;
  for(int n = p - 1; n > 0 && t == one; --n)
  {
    s = product({{0, n, 1, 0}}, one, p);
    for(int code = 0; code < p * p * p * p && t == one; ++code)
    {
      const Matrix m = {{code % p, code / p % p, code / (p * p) % p, code / (p * p * p)}};
      if((m[0] * m[3] - m[1] * m[2]) % p != 0 && product(m, one, p) == m && order(m, p) == 3 && order(product(s, m, p), p) == k)
        t = m;
    }
  }
  BOOST_REQUIRE(t != one);
  std::map<Matrix, Index> number;
  std::vector<Matrix> first; // of each face
  const auto add_face = [&](const Matrix& m)
  {
    if(number.count(m))
      return;
    first.push_back(m);
    Matrix x = m;
    for(int i = 0; i < 3; ++i, x = product(x, t, p))
      number.emplace(x, Index(3 * (first.size() - 1) + i));
  };
  add_face(one);
  std::vector<Index> twin;
  for(std::size_t f = 0; f < first.size(); ++f)
  {
    Matrix x = first[f];
    for(int i = 0; i < 3; ++i, x = product(x, t, p))
    {
      const Matrix y = product(x, s, p);
      add_face(y);
      twin.push_back(number.at(y));
    }
  }
  return glued(twin);
}

// The polygon with 4g sides, opposite ones glued, as a fan about its center, which is a vertex. Face i has its side 0 on the polygon.
Triangulation polygon(Index g)
{
  const Index n = 4 * g;
  std::vector<Index> twin(3 * n);
  for(Index i = 0; i < n; ++i)
  {
    twin[3 * i] = 3 * ((i + n / 2) % n);
    twin[3 * i + 1] = 3 * ((i + 1) % n) + 2;
    twin[3 * ((i + 1) % n) + 2] = 3 * i + 1;
  }
  return glued(twin);
}

// With the lengths of the regular polygon of angles 2 pi / 4g: of its sides and from the center to the corners.
Triangulation regular_polygon(Index g)
{
  Triangulation t = polygon(g);
  const double a = pi / (4 * g), cot = 1 / std::tan(a), radius = std::acosh(cot * cot), side = 2 * std::acosh(std::cos(a) / std::sin(a));
  for(Index e = 0; e < t.number_of_edges(); ++e)
    t.set_length(e, 2 * std::sinh((t.edge_halfedge(e) % 3 == 0 ? side : radius) / 2));
  return t;
}

// The surface of a set of unit cubes, its squares divided along one diagonal or the other.
typedef std::set<std::array<int, 3> > Cubes;

testing::Soup surface(const Cubes& cubes, unsigned seed)
{
  testing::Soup soup;
  std::map<std::array<int, 3>, Index> number;
  testing::Random random(seed);
  const auto vertex = [&](const std::array<int, 3>& p)
  {
    const auto found = number.emplace(p, Index(soup.points.size()));
    if(found.second)
      soup.points.push_back({{double(p[0]), double(p[1]), double(p[2])}});
    return found.first->second;
  };
  for(const std::array<int, 3>& c : cubes)
    for(int k = 0; k < 3; ++k)
      for(int side = 0; side < 2; ++side)
      {
        std::array<int, 3> beyond = c;
        beyond[k] += side == 0 ? -1 : 1;
        if(cubes.count(beyond))
          continue;
        std::array<Index, 4> q;
        for(int i = 0; i < 4; ++i)
        {
          std::array<int, 3> p = c;
          const int j = side == 0 ? 3 - i : i; // seen from outside
          p[k] += side;
          p[(k + 1) % 3] += j == 1 || j == 2;
          p[(k + 2) % 3] += j >= 2;
          q[i] = vertex(p);
        }
        const Index first = seed == 0 ? 0 : random.below(2);
        soup.triangles.push_back({{q[first], q[first + 1], q[first + 2]}});
        soup.triangles.push_back({{q[first], q[first + 2], q[(first + 3) % 4]}});
      }
  return soup;
}

// A plate with g holes.
Cubes plate(int g)
{
  Cubes result;
  for(int x = 0; x < 2 * g + 1; ++x)
    for(int y = 0; y < 3; ++y)
      if(y != 1 || x % 2 == 0)
        result.insert({{x, y, 0}});
  return result;
}

// ---- Lengths

// The lengths of the same class with these u.
Triangulation scaled(Triangulation t, const std::vector<double>& u)
{
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    const Index h = t.edge_halfedge(e);
    t.set_length(e, t.length(e) * std::exp((u[t.origin(h)] + u[t.target(h)]) / 2));
  }
  return t;
}

// No condition but angle sums of 2 pi.
CE::Conformal_conditions<double> without_conditions(const Triangulation& t) { return CE::Conformal_conditions<double>(t); }

CE::Hyperbolic_metric<double> metric_of(const Triangulation& t) { return CE::compute_hyperbolic_metric(t, without_conditions(t)); }

CE::Hyperbolic_uniformization uniformization_of(const Triangulation& t)
{
  return CE::internal::Uniformization::run(t, without_conditions(t), CE::Solver_options(),
                                           CE::internal::make_factorization<CE::Default_solver_traits>());
}

double edge_of_degree(double k) { return 2 * std::acosh(1 / (2 * std::sin(pi / k))); }

// What rounding leaves of lengths that were found in `double` and are given in it.
const double rounding = 1e-12;

void check_lengths(const CE::Hyperbolic_metric<double>& metric, double length)
{
  BOOST_TEST(CE::message(metric.status) == "success");
  double worst = 0;
  for(Index e = 0; e < metric.triangulation.number_of_edges(); ++e)
    worst = (std::max)(worst, std::abs(metric.length(metric.triangulation.edge_halfedge(e)) - length));
  BOOST_TEST(worst < rounding);
}

Mesh read_mesh(const std::string& name)
{
  Mesh mesh;
  BOOST_REQUIRE(CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(testing::mesh_path(name), mesh));
  return mesh;
}

Mesh make_mesh(const testing::Soup& soup)
{
  Mesh mesh;
  for(const testing::Point& p : soup.points)
    mesh.add_vertex({p[0], p[1], p[2]});
  for(const std::array<Index, 3>& t : soup.triangles)
    BOOST_REQUIRE(mesh.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]), Mesh::Vertex_index(t[2])) != Mesh::null_face());
  return mesh;
}

// ---- Exact complex numbers and motions, independent of those of the package

typedef CGAL::Exact_rational Rational;
typedef std::array<Rational, 2> Complex;

Complex times(const Complex& x, const Complex& y) { return {{Rational(x[0] * y[0] - x[1] * y[1]), Rational(x[0] * y[1] + x[1] * y[0])}}; }
Complex plus(const Complex& x, const Complex& y) { return {{Rational(x[0] + y[0]), Rational(x[1] + y[1])}}; }
Complex conjugate(const Complex& x) { return {{x[0], Rational(-x[1])}}; }
Complex negative(const Complex& x) { return {{Rational(-x[0]), Rational(-x[1])}}; }

typedef CE::Exact_hyperbolic_surface::Motion Exact_motion;

Exact_motion product(const Exact_motion& x, const Exact_motion& y)
{
  Exact_motion m = {plus(times(x.a, y.a), times(x.b, conjugate(y.b))), plus(times(x.a, y.b), times(x.b, conjugate(y.a)))};
  const Rational unit = Rational(m.a[0] * m.a[0] + m.a[1] * m.a[1]);
  const Rational scale = Rational(1) / (CGAL::abs(m.a[0]) + CGAL::abs(m.a[1]));
  BOOST_TEST_REQUIRE((unit > 0));
  for(Complex* z : {&m.a, &m.b})
    *z = {{Rational((*z)[0] * scale), Rational((*z)[1] * scale)}};
  return m;
}

Exact_motion inverse(const Exact_motion& x) { return {conjugate(x.a), negative(x.b)}; }

bool has_trivial_product_of_commutators(const std::vector<Exact_motion>& generators)
{
  Exact_motion m = {{{Rational(1), Rational(0)}}, {{Rational(0), Rational(0)}}};
  for(std::size_t i = 0; i + 1 < generators.size(); i += 2)
    m = product(m, product(product(generators[i], generators[i + 1]), product(inverse(generators[i]), inverse(generators[i + 1]))));
  return m.a[1] == 0 && m.b[0] == 0 && m.b[1] == 0;
}

} // namespace

// ---- One triangle

BOOST_AUTO_TEST_CASE(angles_follow_from_the_law_of_cosines)
{
  testing::Random random(1);
  for(int n = 0; n < 1000; ++n)
  {
    std::array<double, 3> l = {{random(0.5, 3), random(0.5, 3), 0}};
    l[2] = random(std::abs(l[0] - l[1]) + 0.1, l[0] + l[1] - 0.1);
    const CE::internal::Hyperbolic_sides<double> sides(std::sinh(l[0] / 2), std::sinh(l[1] / 2), std::sinh(l[2] / 2));
    const auto triangle = sides.triangle();
    BOOST_TEST_REQUIRE(triangle.is_triangle);
    double sum = 0;
    for(int k = 0; k < 3; ++k)
    {
      const double a = l[k], b = l[(k + 1) % 3], c = l[(k + 2) % 3], angle = 2 * std::atan2(triangle.r, triangle.tangent[k]);
      BOOST_TEST(std::abs(std::cos(angle) - (std::cosh(b) * std::cosh(c) - std::cosh(a)) / (std::sinh(b) * std::sinh(c))) < 1e-11);
      sum += angle;
    }
    BOOST_TEST(std::abs(pi - sum - CE::internal::hyperbolic_area(sides)) < 1e-13);
  }
}

BOOST_AUTO_TEST_CASE(small_triangles_lose_no_digits)
{
  testing::Random random(2);
  for(int n = 0; n < 1000; ++n)
  {
    const double size = std::pow(10, random(-150, -9));
    const std::array<double, 3> x = {{size * random(1, 2), size * random(1, 2), size * random(1, 2)}};
    const auto hyperbolic = CE::internal::Hyperbolic_sides<double>(x[0], x[1], x[2]).triangle();
    const CE::internal::Incircle_form<double> euclidean(x[0], x[1], x[2]);
    if(!euclidean.is_triangle || euclidean.tangent[0] < 1e-3 * size || euclidean.tangent[1] < 1e-3 * size || euclidean.tangent[2] < 1e-3 * size)
      continue;
    for(int k = 0; k < 3; ++k) // they differ by terms of the size of the area
      BOOST_TEST(std::abs(std::atan2(hyperbolic.r, hyperbolic.tangent[k]) - std::atan2(euclidean.r, euclidean.tangent[k])) < 1e-14);
  }
}

// ---- Triangles by vectors

// Angle sums of one triangle after the other and by vectors of either width: with pairs of `double` to the same bits, and those in `double` within
// the rounding of both. Some triangles are broken at these factors.
BOOST_AUTO_TEST_CASE(angles_by_vectors)
{
  namespace CEi = CE::internal;
  typedef CEi::Double_double             Wide;
  typedef CEi::Wide_angle_sum<Wide>      Sum;
  typedef CE::Exact_angle<double>        Angle;
  for(const double size : {1e-3, 1., 30.})
    for(const double spread : {0.3, 3.})
    {
      Triangulation t = testing::triangulation(surface(plate(2), 3));
      for(Index e = 0; e < t.number_of_edges(); ++e)
        t.set_length(e, size * t.length(e));
      const Index n = t.number_of_vertices();
      const std::vector<double> u = testing::random_numbers(n, spread, 6);
      std::vector<Wide> s;
      for(Index v = 0; v < n; ++v)
        s.push_back(exp(Wide(u[v] / 2)));
#if !defined(CGAL_CONFORMAL_EQUIVALENCE_HARDWARE_FMA)
      const std::vector<Wide> x = CEi::wide_lengths(t, s), sides = CEi::hyperbolic_sides(x), same_sides = CEi::hyperbolic_sides<Wide>(x);
      BOOST_TEST((sides == same_sides));
      std::vector<Sum> one_by_one(n), by_two(n), by_four(n);
      CEi::add_hyperbolic_angles<double, Wide>(t, sides, one_by_one);
      CEi::add_wide_corners_by<CEi::Wide_vectors<16, CEi::Hyperbolic_triangles> >(t, sides, by_two, CEi::Concurrency());
      CEi::add_wide_corners_by<CEi::Wide_vectors<32, CEi::Hyperbolic_triangles> >(t, sides, by_four, CEi::Concurrency(2));
      const std::vector<Sum> as_used = CEi::hyperbolic_angle_sums(t, s);
      for(const std::vector<Sum>* other : {&std::as_const(by_two), &std::as_const(by_four), &as_used})
        for(Index v = 0; v < n; ++v)
        {
          const auto a = one_by_one[v].half_difference(Angle()), b = (*other)[v].half_difference(Angle());
          BOOST_TEST((a.re == b.re && a.im == b.im));
          BOOST_TEST(one_by_one[v].missing_turns(Angle(), 0) == (*other)[v].missing_turns(Angle(), 0));
        }
#endif
      CEi::Hyperbolic_energy<double> energy(t);
      BOOST_TEST_REQUIRE(energy.evaluate(u)); // and flips
      const CEi::Scaled_vector exact = CEi::hyperbolic_residual(t, s, CE::Conformal_conditions<double>(t)); // less 2 pi
      const std::vector<double> sensitivity = energy.sensitivities();
      for(Index v = 0; v < n; ++v)
      {
        const double roundings = 20; // of the formula of one angle, and in the sum
        BOOST_TEST(std::abs(energy.angle_sums()[v] - 2 * pi - exact.entries[v]) < roundings * testing::unit_roundoff * sensitivity[v]);
      }
    }
}

// ---- The energy

// Differences of the angle sums against the Hessian, across flips, too.
BOOST_AUTO_TEST_CASE(hessian_is_the_derivative_of_the_gradient)
{
  for(const double size : {0.01, 1., 30.})
  {
    Triangulation t = testing::triangulation(surface(plate(2), 3));
    for(Index e = 0; e < t.number_of_edges(); ++e)
      t.set_length(e, size * t.length(e));
    CE::internal::Hyperbolic_energy<double> energy(t);
    const Index n = t.number_of_vertices();
    const std::vector<double> u = testing::random_numbers(n, 0.3, 4), d = testing::random_numbers(n, 1, 5);
    BOOST_REQUIRE(energy.evaluate(u));
    CE::internal::Edge_graph graph;
    graph.set_free(std::vector<char>(n, 1));
    const auto hessian = energy.hessian(graph);
    const Eigen::VectorXd product = hessian.selfadjointView<Eigen::Lower>() * Eigen::Map<const Eigen::VectorXd>(d.data(), n);
    const double step = 1e-5; // errors: step^2 and 1e-16 / step, times the size of derivatives
    std::array<std::vector<double>, 2> sums;
    for(int side = 0; side < 2; ++side)
    {
      std::vector<double> moved = u;
      for(Index v = 0; v < n; ++v)
        moved[v] += (side == 0 ? -step : step) * d[v];
      BOOST_REQUIRE(energy.evaluate(moved));
      sums[side] = energy.angle_sums();
    }
    double worst = 0;
    for(Index v = 0; v < n; ++v)
      worst = (std::max)(worst, std::abs((sums[0][v] - sums[1][v]) / (2 * step) - product[v]));
    BOOST_TEST(worst < 1e-8);
    double curvature = 0;
    for(Index v = 0; v < n; ++v)
      curvature += d[v] * product[v];
    BOOST_TEST(curvature > 0);
  }
}

// ---- Metrics that are known

BOOST_AUTO_TEST_CASE(regular_maps_come_back_from_random_factors)
{
  struct Case { int p, k; std::size_t vertices; double length; };
  for(const Case& c : {Case{7, 7, 24, 1.0905496635}, Case{7, 8, 42, 1.5285709195}, Case{17, 9, 272, 1.8550771353}, Case{11, 12, 110, 2.5533737368}})
  {
    const Triangulation t = regular_map(c.p, c.k);
    BOOST_TEST_REQUIRE(t.number_of_vertices() == c.vertices);
    BOOST_TEST(std::abs(edge_of_degree(c.k) - c.length) < 1e-10);
    for(unsigned seed : {1, 2})
      check_lengths(metric_of(scaled(t, testing::random_numbers(t.number_of_vertices(), seed, seed))), edge_of_degree(c.k));
  }
}

// The polygon with 18 sides as one fan.
BOOST_AUTO_TEST_CASE(one_vertex_is_enough)
{
  // a fan of six triangles in an octagon whose opposite sides are glued
  std::vector<Index> twin(18);
  const std::array<Index, 8> side = {{0, 1, 4, 7, 10, 13, 16, 17}}; // halfedges of the octagon, in order
  for(Index i = 0; i < 8; ++i)
    twin[side[i]] = side[(i + 4) % 8];
  for(Index f = 0; f + 1 < 6; ++f)
  {
    twin[3 * f + 2] = 3 * (f + 1);
    twin[3 * (f + 1)] = 3 * f + 2;
  }
  const Triangulation t = glued(twin);
  BOOST_TEST_REQUIRE(t.number_of_vertices() == 1u);
  BOOST_TEST(std::abs(edge_of_degree(18) - 3.438214241) < 1e-8);
  check_lengths(metric_of(scaled(t, {5.})), edge_of_degree(18));
}

BOOST_AUTO_TEST_CASE(regular_polygons)
{
  for(Index g = 2; g <= 5; ++g)
  {
    const Triangulation t = regular_polygon(g);
    const auto metric = metric_of(scaled(t, {0.7, -0.4}));
    BOOST_TEST_REQUIRE(bool(metric));
    // all corners of two polygons side by side lie on a circle with their centers: any of its diagonals may be there, but the radii stay
    const double cot = 1 / std::tan(pi / (4 * g));
    for(Index h = 0; h < metric.triangulation.number_of_halfedges(); ++h)
      if(metric.triangulation.origin(h) != metric.triangulation.target(h))
        BOOST_TEST(std::abs(metric.length(h) - std::acosh(cot * cot)) < 10 * rounding);
  }
}

// The shortest closed geodesic of Bolza's surface, among the words of up to four letters.
BOOST_AUTO_TEST_CASE(systole_of_Bolza)
{
  const auto u = uniformization_of(scaled(regular_polygon(2), {0.3, -0.3}));
  BOOST_TEST_REQUIRE(u.is_laid_out());
  BOOST_TEST(u.relation_error < 1e-24);
  typedef CE::internal::Isometry<double> Motion;
  std::vector<Motion> letters;
  for(const auto& m : u.generators)
  {
    letters.push_back({{m.a[0], m.a[1]}, {m.b[0], m.b[1]}});
    letters.push_back(letters.back().inverse());
  }
  double least = 100;
  std::vector<Motion> words = {Motion::identity()};
  for(int length = 0; length < 4; ++length)
  {
    std::vector<Motion> longer;
    for(const Motion& w : words)
      for(const Motion& x : letters)
      {
        longer.push_back(w * x);
        if(longer.back().distance_from_identity() > 1e-6)
          least = (std::min)(least, 2 * std::acosh(std::abs(longer.back().a.re)));
      }
    words.swap(longer);
  }
  BOOST_TEST(std::abs(least - 3.0571418390) < 1e-9);
}

// Where angles leave nearly no area the metric is the Euclidean one, up to terms of the size of the area.
BOOST_AUTO_TEST_CASE(euclidean_limit)
{
  testing::Soup soup = testing::torus(9, 7);
  testing::add_noise(soup, 0.1, 6);
  const Triangulation t = testing::triangulation(soup);
  const double area = 1e-6;
  CE::Conformal_conditions<double> conditions(t);
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    conditions.prescribe_angle_sum(v, 2 * pi - area / t.number_of_vertices());
  // the conformal class is that of the triangulation: both begin with the same one, and flip
  const auto always = CGAL::parameters::retriangulation(CE::Retriangulation::ALWAYS);
  const auto hyperbolic = CE::compute_hyperbolic_metric(t, conditions, always);
  const auto euclidean = CE::compute_conformal_metric(t, CE::Conformal_conditions<double>(t), always);
  BOOST_TEST_REQUIRE(bool(hyperbolic));
  BOOST_TEST_REQUIRE(bool(euclidean));
  BOOST_TEST(std::abs(hyperbolic.area - area) < 1e-13);
  double mean = 0, worst = 0;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    mean += (hyperbolic.log_scale_factors[v] - euclidean.log_scale_factors[v]) / t.number_of_vertices();
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    worst = (std::max)(worst, std::abs(hyperbolic.log_scale_factors[v] - euclidean.log_scale_factors[v] - mean));
  BOOST_TEST(worst < 10 * area);
}

// Flat squares may be divided along either diagonal.
BOOST_AUTO_TEST_CASE(diagonals_of_flat_quadrilaterals_do_not_matter)
{
  for(int g : {2, 4})
  {
    const Triangulation t = testing::triangulation(surface(plate(g), 0));
    const auto first = CE::compute_hyperbolic_metric(t, without_conditions(t), CGAL::parameters::retriangulation(CE::Retriangulation::ALWAYS));
    BOOST_TEST_REQUIRE(bool(first));
    for(unsigned seed : {7, 8})
    {
      const testing::Soup soup = surface(plate(g), seed);
      const Triangulation other = testing::triangulation(soup);
      const auto second =
        CE::compute_hyperbolic_metric(other, without_conditions(other), CGAL::parameters::retriangulation(CE::Retriangulation::ALWAYS));
      BOOST_TEST_REQUIRE(bool(second));
      double worst = 0;
      for(Index v = 0; v < t.number_of_vertices(); ++v)
        worst = (std::max)(worst, std::abs(first.log_scale_factors[v] - second.log_scale_factors[v]));
      BOOST_TEST(worst < 1e-10);
    }
  }
}

// ---- Conditions

// An icosahedron with angle sums of pi: the angles are pi / 5.
BOOST_AUTO_TEST_CASE(cones_on_a_sphere)
{
  const Triangulation t = testing::triangulation(testing::icosahedron());
  CE::Conformal_conditions<double> conditions(t);
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    conditions.prescribe_angle_sum(v, CE::Exact_angle<double>::pi_times(1));
  const auto metric = CE::compute_hyperbolic_metric(scaled(t, testing::random_numbers(12, 1, 9)), conditions);
  check_lengths(metric, 2 * std::acosh(1 / (2 * std::sin(pi / 10))));
  BOOST_TEST(std::abs(metric.area - 8 * pi) < 1e-12);
}

// A border with u = 0 keeps sinh(l/2) = half of its Euclidean lengths.
BOOST_AUTO_TEST_CASE(borders_with_given_factors)
{
  const Triangulation t = testing::triangulation(testing::hill(8, 0.3));
  const auto metric = CE::compute_hyperbolic_metric(t, CE::Conformal_conditions<double>(t));
  BOOST_TEST_REQUIRE(bool(metric));
  BOOST_TEST(metric.statistics.residual < 1e-24);
  for(Index h = 0; h < metric.triangulation.number_of_halfedges(); ++h)
    if(metric.triangulation.is_border(h))
      BOOST_TEST(std::abs(double(metric.wide_half_sinh(h)) - metric.triangulation.halfedge_length(h)) < 1e-16);
}

BOOST_AUTO_TEST_CASE(borders_become_geodesics)
{
  // a plane with two holes: a pair of pants, of which the double has genus 2
  testing::Soup soup = testing::flat_grid(8);
  const auto is_in_hole = [&](const std::array<Index, 3>& t)
  {
    const testing::Point &a = soup.points[t[0]], &b = soup.points[t[1]], &c = soup.points[t[2]];
    const testing::Point &o = soup.points.front(), &z = soup.points.back();
    const double x = ((a[0] + b[0] + c[0]) / 3 - o[0]) / (z[0] - o[0]), y = ((a[1] + b[1] + c[1]) / 3 - o[1]) / (z[1] - o[1]);
    return y > 0.375 && y < 0.625 && ((x > 0.125 && x < 0.375) || (x > 0.625 && x < 0.875));
  };
  soup.triangles.erase(std::remove_if(soup.triangles.begin(), soup.triangles.end(), is_in_hole), soup.triangles.end());
  std::vector<char> is_used(soup.points.size(), 0);
  for(const auto& t : soup.triangles)
    for(Index v : t)
      is_used[v] = 1;
  std::vector<Index> number(soup.points.size());
  testing::Soup pants;
  for(Index v = 0; v < is_used.size(); ++v)
    if(is_used[v])
    {
      number[v] = Index(pants.points.size());
      pants.points.push_back(soup.points[v]);
    }
  for(auto t : soup.triangles)
  {
    for(Index& v : t)
      v = number[v];
    pants.triangles.push_back(t);
  }
  const Mesh mesh = make_mesh(pants);
  const auto u = CE::uniformize_hyperbolic(mesh);
  BOOST_TEST_REQUIRE(bool(u));
  BOOST_TEST(u.is_doubled);
  BOOST_TEST(u.genus == 2u);
  BOOST_TEST(std::abs(u.metric.area - 4 * pi) < 1e-12);
  BOOST_TEST_REQUIRE(u.is_laid_out());
  // the image of the halfedge 3 f + k is the side 2 - k of a face as much later as there are faces: u is the same at both
  const Index n = Index(3 * num_faces(mesh));
  const auto imported = CE::import_mesh(mesh);
  const CE::internal::Surface_double<double> twofold(imported.triangulation);
  double worst = 0;
  for(Index h = 0; h < n; ++h)
    worst = (std::max)(worst, std::abs(u.metric.log_scale_factors[twofold.triangulation.origin(h)]
                                     - u.metric.log_scale_factors[twofold.triangulation.target(twofold.image(h))]));
  BOOST_TEST(worst < 1e-12);
}

BOOST_AUTO_TEST_CASE(what_has_no_metric_is_refused)
{
  const auto status = [](const Triangulation& t, const CE::Conformal_conditions<double>& conditions)
  {
    const auto metric = CE::compute_hyperbolic_metric(t, conditions);
    BOOST_TEST(metric.statistics.number_of_evaluations == 0u);
    return metric.status;
  };
  const Triangulation sphere = testing::triangulation(testing::icosahedron()), torus = testing::triangulation(testing::torus(5, 5));
  BOOST_TEST((status(sphere, without_conditions(sphere)) == CE::Status::WRONG_TOPOLOGY));
  BOOST_TEST((status(torus, without_conditions(torus)) == CE::Status::WRONG_TOPOLOGY));
  CE::Conformal_conditions<double> saddle(torus);
  saddle.prescribe_angle_sum(3, CE::Exact_angle<double>::pi_times(3));
  const auto refused = CE::compute_hyperbolic_metric(torus, saddle);
  BOOST_TEST((refused.status == CE::Status::GAUSS_BONNET_VIOLATED));
  BOOST_TEST(std::abs(refused.amount + pi) < 1e-14);
  BOOST_TEST((refused.vertices == std::vector<Index>{3}));
  saddle.prescribe_angle_sum(3, -1.);
  BOOST_TEST((status(torus, saddle) == CE::Status::ANGLE_OUT_OF_RANGE));
  saddle.prescribe_angle_sum(3, CE::Exact_angle<double>::pi_times(4));
  saddle.fix_log_scale_factor(4, 0.);
  BOOST_TEST((status(torus, saddle) == CE::Status::NO_ANGLE_LEFT));
  BOOST_TEST((CE::compute_hyperbolic_metric(Triangulation(), CE::Conformal_conditions<double>(Triangulation())).status == CE::Status::EMPTY_MESH));

  const auto annulus = CE::uniformize_hyperbolic(make_mesh(testing::annulus(3, 9)));
  BOOST_TEST((annulus.status == CE::Status::WRONG_TOPOLOGY));
  BOOST_TEST(annulus.faces.size() == 1u);
  BOOST_TEST((CE::realize_exactly(annulus).status == CE::Status::WRONG_TOPOLOGY));
}

// ---- Cones and borders

// The double of the triangle with angles pi / p, pi / q, pi / r: three vertices, two faces.
BOOST_AUTO_TEST_CASE(triangle_groups)
{
  const Triangulation t = glued({5, 4, 3, 2, 1, 0});
  BOOST_TEST_REQUIRE(t.number_of_vertices() == 3u);
  for(const std::array<int, 3>& k : {std::array<int, 3>{{3, 3, 4}}, std::array<int, 3>{{3, 4, 5}}, std::array<int, 3>{{100, 100, 100}}})
  {
    CE::Conformal_conditions<double> conditions(t);
    double area = pi;
    for(Index v = 0; v < 3; ++v)
    {
      conditions.prescribe_angle_sum(v, 2 * pi / k[v]);
      area -= pi / k[v];
    }
    const auto metric = CE::compute_hyperbolic_metric(scaled(t, {1, -2, 0.5}), conditions);
    BOOST_TEST_REQUIRE(CE::message(metric.status) == "success");
    BOOST_TEST(metric.statistics.residual < 1e-24);
    BOOST_TEST(std::abs(metric.area - 2 * area) < rounding);
    const Triangulation& found = metric.triangulation; // the same up to numbers, as the chords form acute triangles
    for(Index h = 0; h < 3; ++h) // the law of cosines for angles, in cosh(l) - 1 = 2 sinh^2(l/2)
    {
      const double a = pi / k[found.apex(h)], b = pi / k[found.origin(h)], c = pi / k[found.target(h)], x = double(metric.wide_half_sinh(h));
      const double expected = (std::cos(a) + std::cos(b) * std::cos(c)) / (std::sin(b) * std::sin(c));
      BOOST_TEST(std::abs(1 + 2 * x * x - expected) < rounding * expected);
    }
  }
}

// sinh(d/2) for the distance d of two points of the disk.
double half_sinh(const std::array<double, 2>& z, const std::array<double, 2>& w)
{
  const auto depth = [](const std::array<double, 2>& p) { return 1 - p[0] * p[0] - p[1] * p[1]; };
  return std::hypot(z[0] - w[0], z[1] - w[1]) / std::sqrt(depth(z) * depth(w));
}

// Edges that were not flipped are as long in the layout as in the metric, on both sides; all edges are as long on one side as on the other; other
// sides than seams have one place.
void check_development(const Triangulation& given, const CE::Hyperbolic_uniformization& u)
{
  BOOST_TEST_REQUIRE(u.is_laid_out());
  BOOST_TEST(!u.has_group());
  BOOST_TEST(u.relation_error < 1e-20);
  const std::set<Index> flipped(u.metric.flips.begin(), u.metric.flips.end());
  double worst = 0, apart = 0;
  for(Index h = 0; h < given.number_of_halfedges(); ++h)
  {
    const Index e = given.edge(h), g = given.twin(h);
    const std::array<double, 2> from = u.corner_points[given.previous(h)], to = u.corner_points[h];
    if(!flipped.count(e))
      worst = (std::max)(worst, std::abs(half_sinh(from, to) / double(u.metric.wide_half_sinh(u.metric.triangulation.edge_halfedge(e))) - 1));
    if(g == given.null_index)
      continue;
    worst = (std::max)(worst, std::abs(half_sinh(from, to) / half_sinh(u.corner_points[given.previous(g)], u.corner_points[g]) - 1));
    const double distance = half_sinh(from, u.corner_points[g]) + half_sinh(to, u.corner_points[given.previous(g)]);
    if(!u.is_seam[e])
      apart = (std::max)(apart, distance);
  }
  BOOST_TEST(worst < 1e-9); // of points near the border of the disk
  BOOST_TEST(apart < 1e-9);
}

BOOST_AUTO_TEST_CASE(spheres_with_three_cones_are_laid_out)
{
  const Triangulation t = testing::triangulation(surface(Cubes{{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}}, 1));
  const std::array<int, 3> k = {{2, 3, 7}};
  CE::Conformal_conditions<double> conditions(t);
  for(Index i = 0; i < 3; ++i)
    conditions.prescribe_angle_sum(5 * i, 2 * pi / k[i]);
  const auto u = CE::internal::Uniformization::run(t, conditions, CE::Solver_options(),
                                                   CE::internal::make_factorization<CE::Default_solver_traits>());
  BOOST_TEST_REQUIRE(bool(u));
  BOOST_TEST(std::abs(u.metric.area - pi / 21) < rounding); // 2 pi (1 - 1/2 - 1/3 - 1/7)
  check_development(t, u);
  // seams are a tree whose ends are cones: either each has its rotation, or two have theirs, and the product of both is that of the third
  BOOST_TEST((u.generators.size() == 2 || u.generators.size() == 3));
  std::set<int> orders;
  for(const auto& g : u.generators)
    for(const int n : k)
      if(std::abs(std::abs(g.a[0]) - std::cos(pi / n)) < 1e-9)
        orders.insert(n);
  BOOST_TEST(orders.size() == u.generators.size());
  BOOST_TEST((CE::realize_exactly(u).status == CE::Status::WRONG_TOPOLOGY));
}

BOOST_AUTO_TEST_CASE(tori_and_handles_with_cones_are_laid_out)
{
  for(const int genus : {1, 2})
  {
    const Triangulation t = testing::triangulation(surface(plate(genus), 2));
    CE::Conformal_conditions<double> conditions(t);
    conditions.prescribe_angle_sum(0, CE::Exact_angle<double>::pi_times(1));
    conditions.prescribe_angle_sum(9, CE::Exact_angle<double>::pi_times(genus == 1 ? 1 : 3));
    const auto u = CE::internal::Uniformization::run(t, conditions, CE::Solver_options(),
                                                     CE::internal::make_factorization<CE::Default_solver_traits>());
    BOOST_TEST_REQUIRE(bool(u));
    BOOST_TEST(std::abs(u.metric.area - (genus == 1 ? 2 * pi : 4 * pi)) < rounding);
    check_development(t, u);
  }
}

// Shorter than it is.
BOOST_AUTO_TEST_CASE(borders_of_given_u_are_laid_out)
{
  const Triangulation t = testing::triangulation(testing::annulus(3, 9));
  CE::Conformal_conditions<double> conditions(t);
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(t.is_border_vertex(v))
      conditions.fix_log_scale_factor(v, -1.);
  const auto u = CE::internal::Uniformization::run(t, conditions, CE::Solver_options(),
                                                   CE::internal::make_factorization<CE::Default_solver_traits>());
  BOOST_TEST_REQUIRE(bool(u));
  BOOST_TEST(!u.is_doubled);
  check_development(t, u);
}

// As many digits as are asked for.
BOOST_AUTO_TEST_CASE(residuals_of_two_hundred_bits)
{
  typedef CE::Multiprecision_number Number;
  const CE::Working_precision precision(200);
  const Triangulation rounded = testing::triangulation(surface(plate(2), 3));
  CE::Intrinsic_triangulation<Number> t = rounded.with_lengths(std::vector<Number>(rounded.lengths().begin(), rounded.lengths().end()));
  CE::Conformal_conditions<Number> conditions(t);
  conditions.prescribe_angle_sum(3, CE::Exact_angle<Number>::pi_times(1));
  const auto metric = CE::compute_hyperbolic_metric(t, conditions, CGAL::parameters::gradient_tolerance(1e-50));
  BOOST_TEST(CE::message(metric.status) == "success");
  BOOST_TEST(metric.statistics.residual < 1e-50);
  BOOST_TEST(std::abs(metric.area - 5 * pi) < rounding);
}

// ---- Groups

BOOST_AUTO_TEST_CASE(exact_groups_of_any_genus)
{
  for(Index g : {2, 3, 5, 10, 20})
  {
    const auto u = uniformization_of(scaled(regular_polygon(g), {0.2, 0.1}));
    BOOST_TEST_REQUIRE(u.is_laid_out());
    BOOST_TEST(u.genus == g);
    BOOST_TEST(u.generators.size() == 2 * g);
    BOOST_TEST(u.relation.size() == 4 * g);
    const auto exact = CE::realize_exactly(u);
    BOOST_TEST((exact.status == CE::Status::OK));
    BOOST_TEST(exact.largest_length_difference() < 1e-6);
    BOOST_TEST(exact.canonical_generators().size() == 2 * g);
    BOOST_TEST(has_trivial_product_of_commutators(exact.canonical_generators()));
  }
}

// What the layout says of a mesh: corners of faces have the distances of the metric, both sides of a seam differ by a deck transformation, and
// labels have the product 1.
BOOST_AUTO_TEST_CASE(layouts_are_consistent)
{
  const Triangulation given = testing::triangulation(surface(plate(3), 5));
  const auto u = uniformization_of(given);
  BOOST_TEST_REQUIRE(u.is_laid_out());
  const Triangulation& t = u.metric.triangulation;
  typedef CE::internal::Isometry<CE::Hyperbolic_uniformization::Wide_number> Motion;
  CE::internal::Word_values<Motion> deck(u.wide_generators, Motion::identity());
  for(const std::vector<std::int32_t>* label : {&u.labels[0], &u.input_labels[0]})
    for(Index h = 0; h < given.number_of_halfedges(); h += 3)
      BOOST_TEST(deck(CE::internal::product(label[h], label[h + 1], label[h + 2])).distance_from_identity() < 1e-22);
  double worst = 0;
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    const Motion to = u.wide_frames[t.origin(h)].inverse() * deck(u.labels[h]) * u.wide_frames[t.target(h)];
    worst = (std::max)(worst, std::abs(size_of(to.b) - double(u.metric.wide_half_sinh(h))));
  }
  BOOST_TEST(worst < 1e-13);
  // the domain is a disk: seams are a connected graph with 2g loops, which ends nowhere
  std::vector<int> degree(given.number_of_vertices(), 0);
  int excess = 0;
  for(Index e = 0; e < given.number_of_edges(); ++e)
    if(u.is_seam[e])
    {
      ++excess;
      ++degree[given.origin(given.edge_halfedge(e))];
      ++degree[given.target(given.edge_halfedge(e))];
    }
  for(int d : degree)
  {
    excess -= d > 0;
    BOOST_TEST(d != 1);
  }
  BOOST_TEST(excess == 2 * 3 - 1);
}

// ---- Meshes

BOOST_AUTO_TEST_CASE(meshes, * testing::needs_mesh("elephant.off"))
{
  for(const char* name : {"joint.off", "eight.off", "helmet.off", "anchor.off", "couplingdown.off", "elephant.off", "boeing.off"})
  {
    if(!testing::has_mesh(name))
      continue;
    const Mesh mesh = read_mesh(name);
    const auto u = CE::uniformize_hyperbolic(mesh);
    BOOST_TEST_CONTEXT(name)
    {
      BOOST_TEST_REQUIRE(bool(u));
      BOOST_TEST(u.metric.statistics.residual < 1e-24);
      if(u.is_doubled)
        continue;
      BOOST_TEST_REQUIRE(u.is_laid_out());
      BOOST_TEST(std::abs(u.metric.area - 4 * pi * (double(u.genus) - 1)) < 1e-12 * double(u.genus));
      BOOST_TEST(u.relation_error < 1e-18);
      const auto exact = CE::realize_exactly(u);
      BOOST_TEST((exact.status == CE::Status::OK));
      BOOST_TEST(exact.largest_length_difference() < 1e-6);
      if(u.genus < 5)
        BOOST_TEST(has_trivial_product_of_commutators(exact.canonical_generators()));
    }
  }
}

// With 133 handles the relation has 532 letters, and two `double` are too few digits.
BOOST_AUTO_TEST_CASE(groups_of_a_hundred_handles, * testing::needs_mesh("cheese.off"))
{
  const auto u = CE::uniformize_hyperbolic(read_mesh("cheese.off"));
  BOOST_TEST_REQUIRE(u.is_laid_out());
  BOOST_TEST(u.genus == 133u);
  BOOST_TEST(u.precise_generators.size() == 2 * u.genus);
  BOOST_TEST(u.relation_error < 1e-12);
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_HAS_HYPERBOLIC_SURFACES // CGAL 6.1 and later
#include <CGAL/Triangulation_on_hyperbolic_surface_2_IO.h>

BOOST_AUTO_TEST_CASE(triangulations_of_CGAL)
{
  for(int g : {2, 3})
  {
    const auto u = uniformization_of(testing::triangulation(surface(plate(g), 1)));
    const auto exact = CE::realize_exactly(u);
    BOOST_TEST_REQUIRE((exact.status == CE::Status::OK));
    auto t = CE::make_triangulation_on_hyperbolic_surface(exact);
    BOOST_TEST(t.is_valid());
    BOOST_TEST(t.combinatorial_map().number_of_darts() == exact.triangulation().number_of_halfedges());
    std::stringstream stream, again;
    stream << t;
    CGAL::Triangulation_on_hyperbolic_surface_2<CE::Default_hyperbolic_surface_traits> read;
    stream >> read;
    BOOST_TEST(read.is_valid());
    again << read;
    BOOST_TEST(again.str().size() == stream.str().size());
    t.make_Delaunay();
    BOOST_TEST(t.is_Delaunay());
    BOOST_TEST(t.lift().size() == exact.triangulation().number_of_faces());
  }
}
#endif
