// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The map to the sphere: Lorentz vectors and Moebius transformations, conformality at every edge, the verdict, flips and their overlay,
// independence of what is arbitrary, refusals.

#define BOOST_TEST_MODULE test_map_to_sphere
#include "include/boost_test.h"
#include "include/flattened_meshes.h"
#include "include/inscribed_images.h"
#include "include/output_maps.h"
#include "include/solids.h"

#include <CGAL/Conformal_equivalence/map_to_sphere.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace CEi = CGAL::Conformal_equivalence::internal;
namespace params = CGAL::parameters;
using namespace testing;
using CE::Moebius_weights;
using CE::Retriangulation;
using CE::Status;

namespace {

typedef CGAL::Exact_predicates_inexact_constructions_kernel  Exact_predicates;
typedef CE::Flattening_report<Mesh>                          Report;
typedef CE::Spherical_refinement<double>                     Refinement;
typedef CEi::Double_double                                   Double_double;
typedef CEi::Light_vector<double>                            Vector;
typedef std::vector<Point>                                   Points;

// A mesh with all the maps that map_to_sphere() can write.
struct Maps : Image_maps<Point_3>
{
  Mesh::Property_map<Vertex, Point_3> on_sphere = image;

  explicit Maps(const Mesh& mesh) : Image_maps<Point_3>(mesh, Point_3(unwritten, unwritten, unwritten)) {}
  explicit Maps(const Soup& soup) : Maps(surface_mesh<Mesh>(soup)) {}

  template <typename NamedParameters>
  Report map(const NamedParameters& np) { return CE::map_to_sphere(sm, on_sphere, CE::combine_named_parameters(parameters(), np)); }
  Report map(Retriangulation retriangulation) { return map(params::retriangulation(retriangulation)); }

  Points points() const
  {
    Points result;
    for(Vertex v : vertices(sm))
      result.push_back({{on_sphere[v].x(), on_sphere[v].y(), on_sphere[v].z()}});
    return result;
  }
};

Point point(const Point_3& p) { return {{p.x(), p.y(), p.z()}}; }

long double norm(const Point& p)
{
  const long double x = p[0], y = p[1], z = p[2];
  return std::sqrt(x * x + y * y + z * z);
}

Point unit(const Point& p)
{
  const double length = double(norm(p));
  return {{p[0] / length, p[1] / length, p[2] / length}};
}

double chord(const Point_3& p, const Point_3& q) { return distance<double>(point(p), point(q)); }

// How far the points are apart, each from its own.
double largest_distance(const Points& p, const Points& q)
{
  BOOST_REQUIRE(p.size() == q.size());
  double result = 0;
  for(std::size_t i = 0; i < p.size(); ++i)
    result = (std::max)(result, distance<double>(p[i], q[i]));
  return result;
}

// The same configuration up to motions and reflections has the same chords.
double largest_difference_of_chords(const Points& p, const Points& q)
{
  BOOST_REQUIRE(p.size() == q.size());
  double result = 0;
  for(std::size_t i = 0; i < p.size(); ++i)
    for(std::size_t j = 0; j < i; ++j)
      result = (std::max)(result, std::abs(distance<double>(p[i], p[j]) - distance<double>(q[i], q[j])));
  return result;
}

double shortest_chord(const Maps& m)
{
  double result = HUGE_VAL;
  for(Edge e : edges(m.sm))
    result = (std::min)(result, chord(m.on_sphere[m.sm.vertex(e, 0)], m.on_sphere[m.sm.vertex(e, 1)]));
  return result;
}

Exact_predicates::Point_3 exact(const Point& p) { return Exact_predicates::Point_3(p[0], p[1], p[2]); }
Exact_predicates::Point_3 exact(const Point_3& p) { return exact(point(p)); }

// Seen from outside, for the numbers as they are.
template <typename Some_point>
bool is_positive(const Some_point& p, const Some_point& q, const Some_point& r)
{
  return CGAL::orientation(exact(Point{{0, 0, 0}}), exact(p), exact(q), exact(r)) == CGAL::POSITIVE;
}

// --- what holds for every result ----------------------------------------------------------------

void check_radii(const Points& points)
{
  for(const Point& p : points)
    BOOST_TEST(std::abs(norm(p) - 1) <= rounded_place);
}

std::vector<double> vertex_areas(const Mesh& sm)
{
  std::vector<double> result(num_vertices(sm), 0);
  for(Face f : faces(sm))
  {
    const Halfedge h = halfedge(f, sm);
    const double area = std::sqrt(CGAL::squared_area(sm.point(source(h, sm)), sm.point(target(h, sm)), sm.point(target(next(h, sm), sm))));
    for(Halfedge g : halfedges_around_face(h, sm))
      result[target(g, sm)] += area / 3;
  }
  return result;
}

double distance_of_barycentre(const Maps& m, const std::vector<double>& weights)
{
  long double sum[4] = { 0, 0, 0, 0 };
  for(Vertex v : vertices(m.sm))
    if(!m.sm.is_isolated(v))
    {
      for(int i = 0; i < 3; ++i)
        sum[i] += (long double)(weights[v]) * point(m.on_sphere[v])[std::size_t(i)];
      sum[3] += weights[v];
    }
  return double(std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / sum[3]);
}

// Rounding moves every point by sqrt(3) 2^-54 at most, and so changes each of four chords, relatively, by sqrt(3) 2^-53 divided by it; the
// lengths of the mesh are rounded, too.
double tolerance_of_chords(const Maps& m) { return unit_roundoff * (16 / shortest_chord(m) + 64); }

// Chords are conformally equivalent to the edges, around all vertices.
void check_conformality(const Maps& m, const CE::Intrinsic_triangulation<>& surface)
{
  const double tolerance = tolerance_of_chords(m);
  BOOST_TEST(tolerance <= 2e-10); // no chord is so short that the test would say nothing
  check_scaling(m, surface, [&](Vertex i, Vertex j) { return chord(m.on_sphere[i], m.on_sphere[j]); }, tolerance);
}

void check_conformality(const Maps& m) { check_conformality(m, CE::import_mesh(m.sm).triangulation); }

void check_triangles(const Maps& m, const Report& report)
{
  double sum = 0;
  for(Face f : faces(m.sm))
  {
    const Halfedge h = halfedge(f, m.sm);
    const Point_3 p = m.on_sphere[source(h, m.sm)], q = m.on_sphere[target(h, m.sm)], r = m.on_sphere[target(next(h, m.sm), m.sm)];
    BOOST_TEST(is_positive(p, q, r));
    sum += CEi::solid_angle(point(p), point(q), point(r));
  }
  BOOST_TEST(std::abs(sum - 4 * pi) <= sum_of_angles(num_faces(m.sm)));
  BOOST_TEST(std::abs(report.solid_angle - 4 * pi) <= sum_of_angles(num_faces(m.sm)));
}

void check_sphere(const Maps& m, const Report& report)
{
  BOOST_TEST(report.rounded_faces.empty());
  check_radii(m.points());
  BOOST_TEST(distance_of_barycentre(m, std::vector<double>(num_vertices(m.sm), 1)) <= centred);
  check_triangles(m, report);
  check_conformality(m);
}

// --- the overlay --------------------------------------------------------------------------------

// Triangles, closed, of Euler number 2, and positive.
void check_parts(const Refinement& refinement)
{
  const auto& parts = refinement.parts;
  std::map<std::pair<Index, Index>, int> sides;
  std::set<Index> used;
  double sum = 0;
  for(Index f = 0; f < parts.number_of_faces(); ++f)
  {
    const std::size_t c = parts.first_corner[f];
    BOOST_REQUIRE(parts.first_corner[f + 1] == c + 3);
    const Index i = parts.corner_vertex[c], j = parts.corner_vertex[c + 1], k = parts.corner_vertex[c + 2];
    BOOST_TEST(is_positive(refinement.points[i], refinement.points[j], refinement.points[k]));
    sum += CEi::solid_angle(refinement.points[i], refinement.points[j], refinement.points[k]);
    for(const std::pair<Index, Index>& side : { std::make_pair(i, j), std::make_pair(j, k), std::make_pair(k, i) })
    {
      ++sides[side];
      used.insert(side.first);
    }
  }
  BOOST_TEST(std::abs(sum - 4 * pi) <= sum_of_angles(parts.number_of_faces()));
  BOOST_TEST((parts.is_positive() && parts.corner_uv.empty()));
  for(const auto& side : sides)
    BOOST_TEST(sides[std::make_pair(side.first.second, side.first.first)] == side.second);
  BOOST_TEST(refinement.points.size() == parts.number_of_vertices());
  BOOST_TEST(2 * used.size() == parts.number_of_faces() + 4); // V - E + F = 2 with 2 E = 3 F
  for(Index v : used)
    BOOST_TEST(std::abs(norm(refinement.points[v]) - 1) <= rounded_place);
}

// All points in one face of the input and one of the polyhedron are mapped by one projective map: whatever relation holds
// between barycentric coordinates of four of them holds between their homogeneous coordinates w p. Returns in how many cells that was tested well.
std::size_t check_projective_maps(const Refinement& refinement, const CE::Intrinsic_triangulation<>& input)
{
  const auto& parts = refinement.parts;
  std::map<std::pair<Index, Index>, std::set<Index> > cells;
  for(Index f = 0; f < parts.number_of_faces(); ++f)
    for(std::size_t c = parts.first_corner[f]; c < parts.first_corner[f + 1]; ++c)
      cells[std::make_pair(parts.input_face[f], parts.flat_face[f])].insert(parts.corner_vertex[c]);
  std::size_t well_tested = 0;
  for(const auto& cell : cells)
  {
    const std::vector<Index> v(cell.second.begin(), cell.second.end());
    for(std::size_t n = 3; n < v.size(); ++n)
    {
      const std::array<Index, 4> corner = {{v[n - 3], v[n - 2], v[n - 1], v[n]}};
      std::array<Point, 4> b;
      for(std::size_t i = 0; i < 4; ++i)
        b[i] = barycentric(refinement.parts, input, cell.first.first, corner[i]);
      const double relation[4] = { determinant(b[1], b[2], b[3]), -determinant(b[0], b[2], b[3]),
                                   determinant(b[0], b[1], b[3]), -determinant(b[0], b[1], b[2]) };
      double residual[3] = { 0, 0, 0 }, size = 0, largest = 0;
      for(std::size_t i = 0; i < 4; ++i)
      {
        const double w = parts.weights[corner[i]];
        for(std::size_t k = 0; k < 3; ++k)
          residual[k] += relation[i] * w * refinement.points[corner[i]][k];
        size += w;
        largest = (std::max)(largest, std::abs(relation[i]) * w);
      }
      for(double r : residual)
        BOOST_TEST(std::abs(r) <= 64 * unit_roundoff * size);
      well_tested += largest > 1e-3 * size;
    }
  }
  return well_tested;
}

void check_refinement(const Refinement& refinement, const CE::Intrinsic_triangulation<>& input)
{
  check_parts(refinement);
  check_that_parts_fill_faces(refinement.parts, input);
  BOOST_TEST(check_projective_maps(refinement, input) > 0u);
}

// --- surfaces -----------------------------------------------------------------------------------

Soup tetrahedron()
{
  return Soup{{{{1, 1, 1}}, {{1, -1, -1}}, {{-1, 1, -1}}, {{-1, -1, 1}}}, {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 1}}, {{1, 3, 2}}}};
}

Soup octahedron()
{
  return Soup{{{{1, 0, 0}}, {{0, 1, 0}}, {{-1, 0, 0}}, {{0, -1, 0}}, {{0, 0, 1}}, {{0, 0, -1}}},
              {{{0, 1, 4}}, {{1, 2, 4}}, {{2, 3, 4}}, {{3, 0, 4}}, {{1, 0, 5}}, {{2, 1, 5}}, {{3, 2, 5}}, {{0, 3, 5}}}};
}

// A hexahedron with flat quads; bit k of `diagonals` says how the quad k is cut.
Soup hexahedron(const Point& x, const Point& y, const Point& z, unsigned diagonals)
{
  Soup soup;
  for(unsigned v = 0; v < 8; ++v)
  {
    Point p = {{0, 0, 0}};
    for(std::size_t i = 0; i < 3; ++i)
      p[i] = (v & 1 ? x[i] : 0) + (v & 2 ? y[i] : 0) + (v & 4 ? z[i] : 0);
    soup.points.push_back(p);
  }
  const std::array<std::array<Index, 4>, 6> quads = {{
    {{0, 2, 3, 1}}, {{4, 5, 7, 6}}, {{0, 1, 5, 4}}, {{2, 6, 7, 3}}, {{0, 4, 6, 2}}, {{1, 3, 7, 5}} }};
  for(std::size_t k = 0; k < 6; ++k)
  {
    const auto& q = quads[k];
    const std::size_t s = diagonals >> k & 1;
    soup.triangles.push_back({{q[s], q[s + 1], q[s + 2]}});
    soup.triangles.push_back({{q[s], q[s + 2], q[(s + 3) % 4]}});
  }
  return soup;
}

// Preserves length cross ratios, as inversions and reflections do. The orientation stays.
Soup inverted(Soup soup, const Point& centre)
{
  for(Point& p : soup.points)
  {
    const Point d = {{p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]}};
    const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    p = {{-d[0] / square, d[1] / square, d[2] / square}};
  }
  return soup;
}

Points random_points(std::size_t n, unsigned seed)
{
  Random random(seed);
  Points result;
  while(result.size() < n)
  {
    const Point p = {{random(-1, 1), random(-1, 1), random(-1, 1)}};
    if(norm(p) < 1 && norm(p) > .1)
      result.push_back(unit(p));
  }
  return result;
}

template <typename Number = double>
std::vector<CEi::Light_vector<Number> > light_vectors(const Points& points)
{
  std::vector<CEi::Light_vector<Number> > result;
  for(const Point& p : points)
  {
    const Number x(p[0]), y(p[1]), z(p[2]);
    using std::sqrt;
    result.push_back({{x, y, z, sqrt(Number(x * x + y * y + z * z))}});
  }
  return result;
}

template <typename Number>
Points points_of(const std::vector<CEi::Light_vector<Number> >& vectors)
{
  Points result;
  for(const auto& v : vectors)
  {
    const auto p = CEi::sphere_point(v);
    result.push_back({{static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])}});
  }
  return result;
}

// The convex hull of points of the sphere is their Delaunay triangulation. Vertices keep their order.
Mesh hull(const Points& points)
{
  typedef CGAL::Surface_mesh<Exact_predicates::Point_3> Hull;
  std::vector<Exact_predicates::Point_3> exact_points;
  std::map<Exact_predicates::Point_3, Index> number;
  for(const Point& p : points)
  {
    number.emplace(exact(p), Index(exact_points.size()));
    exact_points.push_back(exact(p));
  }
  Hull found;
  CGAL::convex_hull_3(exact_points.begin(), exact_points.end(), found);
  BOOST_REQUIRE(num_vertices(found) == points.size());
  Soup soup;
  soup.points = points;
  for(auto f : faces(found))
  {
    std::array<Index, 3> triangle;
    std::size_t k = 0;
    for(auto v : vertices_around_face(halfedge(f, found), found))
      triangle[k++] = number.at(found.point(v));
    soup.triangles.push_back(triangle);
  }
  return surface_mesh<Mesh>(soup);
}

// --- Lorentz transformations --------------------------------------------------------------------

// A boost by `rapidity`, then a rotation.
template <typename Number>
CEi::Lorentz_matrix<Number> random_transformation(double rapidity, unsigned seed)
{
  Random random(seed);
  const Point d = unit({{random(-1, 1), random(-1, 1), random(-1, 1)}});
  return CEi::rotation_matrix<Number>(random(-1, 1), random(-1, 1), random(-1, 1), random(-1, 1))
       * CEi::boost_matrix<Number>({{rapidity * d[0], rapidity * d[1], rapidity * d[2]}});
}

template <typename Number>
double error_of_light_vectors(unsigned seed)
{
  Random random(seed);
  double worst = 0;
  for(int n = 0; n < 100; ++n)
  {
    const CEi::Complex_number<Number> a{Number(random(-2, 2)), Number(random(-2, 2))}, b{Number(random(-2, 2)), Number(random(-2, 2))};
    const Number s(random(.3, 3)), t(random(.3, 3)), x = a.re - b.re, y = a.im - b.im;
    const CEi::Light_vector<Number> v = CEi::light_vector(a, s), w = CEi::light_vector(b, t);
    const Number square = (x * x + y * y) / (s * s * t * t), product = Number(-2) * CEi::lorentz_product(v, w);
    worst = (std::max)(worst, std::abs(static_cast<double>(Number(product - square)) / static_cast<double>(v[3] * w[3])));
    worst = (std::max)(worst, std::abs(static_cast<double>(CEi::lorentz_product(v, v)) / static_cast<double>(v[3] * v[3])));
  }
  return worst;
}

template <typename Number>
double error_of_transformations(double rapidity, unsigned seed)
{
  double worst = 0;
  const CEi::Lorentz_matrix<Number> m = random_transformation<Number>(rapidity, seed);
  const auto vectors = light_vectors<Number>(random_points(12, seed + 1));
  for(const auto& v : vectors)
    for(const auto& w : vectors)
    {
      const CEi::Light_vector<Number> mv = m * v, mw = m * w;
      const Number difference = CEi::lorentz_product(mv, mw) - CEi::lorentz_product(v, w);
      worst = (std::max)(worst, std::abs(static_cast<double>(difference)) / static_cast<double>(mv[3] * mw[3]));
    }
  return worst;
}

} // namespace

// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_SUITE(light_cone)

BOOST_AUTO_TEST_CASE(lengths_are_products)
{
  BOOST_TEST(error_of_light_vectors<double>(1) <= 32 * unit_roundoff);
  BOOST_TEST(error_of_light_vectors<Double_double>(2) <= 256 * unit_roundoff * unit_roundoff);

  // the pole is the opposite of the point at infinity, and what is counterclockwise in the plane is so on the sphere
  const auto place = [](double x, double y) { return CEi::sphere_point(CEi::light_vector(CEi::Complex_number<double>{x, y}, 2.)); };
  BOOST_TEST((place(0, 0) == Point{{0, 0, 1}}));
  BOOST_TEST(is_positive(place(.3, .1), place(2, .4), place(.7, 3)));
  BOOST_TEST(!is_positive(place(2, .4), place(.3, .1), place(.7, 3)));
}

BOOST_AUTO_TEST_CASE(transformations_keep_products)
{
  for(unsigned seed = 0; seed < 20; ++seed)
  {
    BOOST_TEST(error_of_transformations<double>(1.5, seed) <= 64 * unit_roundoff * std::exp(3.));
    BOOST_TEST(error_of_transformations<Double_double>(10, seed) <= 256 * unit_roundoff * unit_roundoff * std::exp(20.));
  }
  const Vector moved = CEi::boost_matrix<double>({{.6, 0, .8}}) * Vector{{.6 * std::sinh(1.), 0, .8 * std::sinh(1.), std::cosh(1.)}};
  for(std::size_t i = 0; i < 3; ++i)
    BOOST_TEST(std::abs(moved[i]) <= 8 * unit_roundoff);
  BOOST_TEST(std::abs(moved[3] - 1) <= 8 * unit_roundoff);
  const Vector still = CEi::boost_matrix<double>({{0, 0, 0}}) * Vector{{1, 2, 3, 4}};
  BOOST_TEST((still == Vector{{1, 2, 3, 4}}));

  // a quarter turn about the z-axis, by a quaternion of length 2
  const Vector turned = CEi::rotation_matrix<double>(std::sqrt(2.), 0, 0, std::sqrt(2.)) * Vector{{1, 0, 5, 7}};
  BOOST_TEST((std::abs(turned[0]) <= few_roundings && std::abs(turned[1] - 1) <= few_roundings && turned[2] == 5 && turned[3] == 7));
}

BOOST_AUTO_TEST_CASE(centering)
{
  for(unsigned seed = 0; seed < 10; ++seed)
  {
    const Points points = random_points(50, seed);
    const std::vector<double> weights = [&]
    {
      std::vector<double> result = random_numbers(50, 1, seed + 100);
      for(double& w : result)
        w = seed % 2 == 0 ? 1 : 1.1 + w;
      return result;
    }();
    const CEi::Moebius_centering center(weights, false);
    auto vectors = light_vectors<Double_double>(points), moved = vectors;
    BOOST_REQUIRE(center(vectors));
    long double sum[4] = { 0, 0, 0, 0 };
    for(std::size_t v = 0; v < weights.size(); ++v)
    {
      const Point p = points_of(vectors)[v];
      for(std::size_t i = 0; i < 3; ++i)
        sum[i] += (long double)(weights[v]) * p[i];
      sum[3] += weights[v];
    }
    BOOST_TEST(std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / sum[3] <= centring_goal + rounded_place);

    // whatever transformation came before: here the points crowd so that double cannot tell them apart
    CEi::transform(random_transformation<Double_double>(2. * seed, seed), moved);
    BOOST_REQUIRE(center(moved));
    BOOST_TEST(largest_difference_of_chords(points_of(vectors), points_of(moved)) <= centred_place);
    BOOST_TEST(largest_difference_of_chords(points_of(vectors), points) >= 1e-3); // they have moved
  }
}

BOOST_AUTO_TEST_CASE(centering_has_a_limit)
{
  const Points points = random_points(5, 3);
  for(const double heavy : { 1., 3.9, 4., 4.1, 100. })
  {
    std::vector<double> weights(5, 1);
    weights[2] = heavy;
    auto vectors = light_vectors<Double_double>(points);
    BOOST_TEST(CEi::Moebius_centering(weights, false)(vectors) == (heavy < 4));
    if(heavy >= 4)
      BOOST_TEST(largest_distance(points_of(vectors), points) <= few_roundings); // they stay
  }
  std::vector<double> nothing(5, 0);
  auto vectors = light_vectors<Double_double>(points);
  BOOST_TEST(!CEi::Moebius_centering(nothing, false)(vectors));
}

BOOST_AUTO_TEST_CASE(orientation_is_exact)
{
  typedef CGAL::Exact_rational Exact;
  typedef std::array<Double_double, 3> Wide;
  const auto sign = [](const std::array<Exact, 3>& p, const std::array<Exact, 3>& q, const std::array<Exact, 3>& r)
  {
    const Exact d = p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
    return d > 0;
  };
  const auto exact_point = [](const Wide& p)
  {
    std::array<Exact, 3> result;
    for(std::size_t i = 0; i < 3; ++i)
      result[i] = Exact(p[i].hi) + Exact(p[i].lo);
    return result;
  };
  Random random(5);
  std::size_t positive = 0, zero = 0;
  for(int n = 0; n < 300; ++n)
  {
    std::array<Point, 3> p;
    for(std::size_t i = 0; i < 3; ++i)
    {
      p[0][i] = random(-1, 1);
      p[1][i] = random(-1, 1);
    }
    for(std::size_t i = 0; i < 3; ++i)
    {
      p[2][i] = p[0][i] + p[1][i];
      if(n % 3 == 1) // in the same plane but for rounding
        p[2][i] = unit(p[2])[i];
    }
    std::array<Wide, 3> w;
    for(std::size_t k = 0; k < 3; ++k)
      for(std::size_t i = 0; i < 3; ++i)
        w[k][i] = Double_double(p[k][i]);
    const bool expected = sign(exact_point(w[0]), exact_point(w[1]), exact_point(w[2]));
    BOOST_TEST(CEi::is_counterclockwise(p[0], p[1], p[2]) == expected);
    BOOST_TEST(CEi::is_counterclockwise(w[0], w[1], w[2]) == expected);
    w[2][std::size_t(n) % 3].lo = random(-1, 1) * std::ldexp(std::abs(w[2][std::size_t(n) % 3].hi), n % 2 == 0 ? -54 : -107);
    positive += CEi::is_counterclockwise(w[0], w[1], w[2]);
    BOOST_TEST(CEi::is_counterclockwise(w[0], w[1], w[2]) == sign(exact_point(w[0]), exact_point(w[1]), exact_point(w[2])));
    BOOST_TEST(CEi::is_counterclockwise(w[1], w[0], w[2]) == sign(exact_point(w[1]), exact_point(w[0]), exact_point(w[2])));
  }
  BOOST_TEST((positive > 100 && positive < 200));

  // exact ties are not positive, in either order
  const Point a = {{1, 2, 3}}, b = {{3, 1, 2}}, c = {{4, 3, 5}};
  zero += CEi::is_counterclockwise(a, b, c) + CEi::is_counterclockwise(b, a, c);
  const Wide wa = {{1., 2., 3.}}, wb = {{3., 1., 2.}}, wc = {{4., 3., 5.}};
  zero += CEi::is_counterclockwise(wa, wb, wc) + CEi::is_counterclockwise(wb, wa, wc);
  BOOST_TEST(zero == 0u);
  const Wide up = {{4., 3., Double_double(5., 1e-30)}}, down = {{4., 3., Double_double(5., -1e-30)}}; // 1 * 1 - 2 * 3 = -5 times that
  BOOST_TEST((!CEi::is_counterclockwise(wa, wb, up) && CEi::is_counterclockwise(wa, wb, down)));
  BOOST_TEST((CEi::is_counterclockwise(wb, wa, up) && !CEi::is_counterclockwise(wb, wa, down)));

  const double nan = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST((!CEi::is_counterclockwise(a, b, Point{{1, nan, 0}}) && !CEi::is_counterclockwise(b, a, Point{{HUGE_VAL, 0, 0}})));
}

BOOST_AUTO_TEST_CASE(solid_angles)
{
  const Soup o = octahedron();
  double sum = 0;
  for(const auto& t : o.triangles)
  {
    const double angle = CEi::solid_angle(o.points[t[0]], o.points[t[1]], o.points[t[2]]);
    BOOST_TEST(std::abs(angle - pi / 2) <= few_roundings);
    BOOST_TEST(CEi::solid_angle(o.points[t[1]], o.points[t[0]], o.points[t[2]]) == -angle);
    sum += angle;
  }
  BOOST_TEST(std::abs(sum - 4 * pi) <= sum_of_angles(8));

  // a triangle is the sum of its parts, up to a whole sphere
  const Points p = random_points(80, 9);
  for(std::size_t i = 0; i + 3 < p.size(); i += 4)
  {
    const double difference = CEi::solid_angle(p[i], p[i + 1], p[i + 2]) - CEi::solid_angle(p[i], p[i + 1], p[i + 3])
                            - CEi::solid_angle(p[i + 1], p[i + 2], p[i + 3]) - CEi::solid_angle(p[i + 2], p[i], p[i + 3]);
    BOOST_TEST(std::abs(std::remainder(difference, 4 * pi)) <= sum_of_angles(4));
  }
}

namespace {

// Whether the polygon is strictly convex, as one of great arcs, and counterclockwise.
template <typename NT>
bool is_convex_spherical_polygon(const std::vector<std::array<NT, 3> >& p)
{
  const std::size_t n = p.size();
  for(std::size_t i = 0; i < n; ++i)
    if(!CEi::is_counterclockwise(p[i], p[(i + 1) % n], p[(i + 2) % n]))
      return false;
  for(std::size_t i = 2; i + 2 < n; ++i)
    if(!CEi::is_counterclockwise(p[0], p[i], p[i + 1]))
      return false;
  return true;
}

} // namespace

BOOST_AUTO_TEST_CASE(convex_polygons_of_great_arcs)
{
  const std::vector<Point> square = {{{1, 0, 1}}, {{0, 1, 1}}, {{-1, 0, 1}}, {{0, -1, 1}}};
  BOOST_TEST(is_convex_spherical_polygon(square));
  BOOST_TEST(!is_convex_spherical_polygon(std::vector<Point>(square.rbegin(), square.rend())));
  std::vector<Point> dented = square;
  dented[2] = {{.5, 0, 1}};
  BOOST_TEST(!is_convex_spherical_polygon(dented));
  const std::vector<Point> pentagram = {{{1, 0, 1}}, {{-.8, .6, 1}}, {{.3, -.95, 1}}, {{.3, .95, 1}}, {{-.8, -.6, 1}}};
  BOOST_TEST(!is_convex_spherical_polygon(pentagram));
}

BOOST_AUTO_TEST_SUITE_END()

// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_SUITE(on_the_triangulation_given)

BOOST_AUTO_TEST_CASE(regular_polyhedra)
{
  for(const Soup& soup : { tetrahedron(), octahedron(), icosahedron() })
    for(const Retriangulation r : { Retriangulation::NEVER, Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
    {
      Maps m(soup);
      const Report report = m.map(r);
      BOOST_REQUIRE(bool(report));
      check_sphere(m, report);
      Points expected;
      for(const Point& p : soup.points)
        expected.push_back(unit(p));
      BOOST_TEST(largest_distance(m.points(), expected) <= centred_place);
    }
}

BOOST_AUTO_TEST_CASE(inscribed_polyhedra_are_their_own_image)
{
  for(unsigned seed = 0; seed < 4; ++seed)
  {
    Points points = random_points(10 + 30 * seed, 20 + seed);
    for(Point& p : points) // more of them on one side
      p = unit({{p[0], p[1], p[2] + .4}});
    auto vectors = light_vectors(points);
    BOOST_REQUIRE(CEi::Moebius_centering(std::vector<double>(points.size(), 1), false)(vectors));
    const Points centered = points_of(vectors);

    // not centered, it is turned only up to the Moebius transformation; centered, it stays where it is
    Maps m(hull(points)), n(hull(centered));
    for(Maps* x : { &m, &n })
    {
      const Report report = x->map(Retriangulation::NEVER);
      BOOST_REQUIRE(bool(report));
      check_sphere(*x, report);
    }
    BOOST_TEST(largest_difference_of_chords(m.points(), centered) <= rounded_u + centred_place); // the points given are rounded
    BOOST_TEST(largest_distance(n.points(), centered) <= rounded_u + centred_place);
    BOOST_TEST(largest_distance(m.points(), points) >= .1);
  }
}

BOOST_AUTO_TEST_CASE(distorted_spheres)
{
  for(unsigned seed = 0; seed < 3; ++seed)
  {
    Maps m(distorted_sphere(3, .01, seed));
    const Report report = m.map(Retriangulation::NEVER);
    BOOST_REQUIRE(bool(report));
    BOOST_TEST(report.statistics.number_of_flips == 0u);
    check_sphere(m, report);
  }
}

BOOST_AUTO_TEST_CASE(homer, * needs_mesh("homer.off"))
{
  Maps m(read_mesh("homer.off"));
  const Report report = m.map(Retriangulation::WHEN_NEEDED);
  BOOST_REQUIRE(bool(report));
  check_sphere(m, report);
}

BOOST_AUTO_TEST_CASE(blobby, * needs_mesh("blobby.off"))
{
  Maps m(read_mesh("blobby.off"));
  const Report report = m.map(Retriangulation::WHEN_NEEDED);
  BOOST_REQUIRE(bool(report));
  check_sphere(m, report);
}

BOOST_AUTO_TEST_CASE(areas_as_weights)
{
  Soup soup = distorted_sphere(2, .02, 4);
  for(Point& p : soup.points)
    p[0] *= p[0] > 0 ? 2 : 1;
  Maps m(soup), n(soup);
  const Report report = m.map(params::moebius_weights(Moebius_weights::AREAS));
  BOOST_REQUIRE(bool(report));
  BOOST_TEST(distance_of_barycentre(m, vertex_areas(m.sm)) <= centred);
  BOOST_TEST(distance_of_barycentre(m, std::vector<double>(num_vertices(m.sm), 1)) >= 1e-3); // another one: far more than any error
  check_radii(m.points());
  check_triangles(m, report);
  check_conformality(m);
  BOOST_REQUIRE(bool(n.map(Retriangulation::WHEN_NEEDED)));
  BOOST_TEST(distance_of_barycentre(n, vertex_areas(n.sm)) >= 1e-3);
}

BOOST_AUTO_TEST_CASE(the_vertex_at_infinity_does_not_matter)
{
  const Soup soup = distorted_sphere(2, .02, 5);
  Maps m(soup);
  BOOST_REQUIRE(bool(m.map(Retriangulation::NEVER)));
  for(Index v = 0; v < 162; v += 20)
  {
    Maps n(soup);
    const Report report = n.map(params::retriangulation(Retriangulation::NEVER).vertex_at_infinity(Vertex(v)));
    BOOST_REQUIRE(bool(report));
    check_sphere(n, report);
    BOOST_TEST(largest_distance(n.points(), m.points()) <= centred_place);
  }
}

BOOST_AUTO_TEST_CASE(inversions_of_space_do_not_matter)
{
  const Soup soup = distorted_sphere(2, .02, 6);
  Maps m(soup);
  BOOST_REQUIRE(bool(m.map(Retriangulation::NEVER)));
  for(const Point& centre : { Point{{3, 0, 0}}, Point{{1, 1.2, .9}}, Point{{0, 0, -1.1}} })
  {
    Maps n(inverted(soup, centre));
    const Report report = n.map(Retriangulation::NEVER);
    BOOST_REQUIRE(bool(report));
    BOOST_TEST(largest_difference_of_chords(n.points(), m.points()) <= rounded_u + centred_place); // the points given are rounded
  }
}

BOOST_AUTO_TEST_CASE(motions_and_scales)
{
  const Soup soup = distorted_sphere(2, .02, 7);
  Maps m(soup);
  BOOST_REQUIRE(bool(m.map(Retriangulation::WHEN_NEEDED)));
  for(const double scale : { std::ldexp(1., -400), std::ldexp(1., 400) })
  {
    Soup moved = soup;
    for(Point& p : moved.points)
      p = {{scale * p[1], scale * p[2], scale * p[0]}};
    Maps n(moved);
    const Report report = n.map(Retriangulation::WHEN_NEEDED);
    BOOST_REQUIRE(bool(report));
    Points back;
    for(const Point& p : n.points())
      back.push_back({{p[2], p[0], p[1]}});
    BOOST_TEST(largest_distance(back, m.points()) <= rounded_u + centred_place); // lengths are rounded in another way
  }
}

BOOST_AUTO_TEST_CASE(lengths_only)
{
  Maps m(distorted_sphere(2, .02, 8)), n(m.sm);
  const auto lengths = n.sm.add_property_map<Edge, double>("e:lengths").first;
  for(Edge e : edges(n.sm))
    lengths[e] = chord(n.sm.point(n.sm.vertex(e, 0)), n.sm.point(n.sm.vertex(e, 1)));
  for(Vertex v : vertices(n.sm))
    n.sm.point(v) = Point_3(0, 0, 0);
  const Report report = n.map(params::edge_length_map(lengths));
  BOOST_REQUIRE(bool(report));
  check_radii(n.points());
  check_triangles(n, report);
  check_conformality(n, CE::import_mesh(m.sm).triangulation);
  const Points p = n.points();
  BOOST_TEST(distance<double>(p[0], Point{{0, 0, 1}}) <= few_roundings);
  BOOST_TEST((std::abs(p[1][1]) <= few_roundings && p[1][0] > 0));
  BOOST_REQUIRE(bool(m.map(Retriangulation::WHEN_NEEDED)));
  BOOST_TEST(largest_difference_of_chords(p, m.points()) <= rounded_u + centred_place); // the lengths given are rounded
}

BOOST_AUTO_TEST_CASE(isolated_vertices_are_carried_through)
{
  const Soup soup = distorted_sphere(1, .02, 9);
  Maps m(soup), n(together({soup, Soup()}, true));
  BOOST_REQUIRE(bool(m.map(Retriangulation::WHEN_NEEDED)));
  for(const Retriangulation r : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
  {
    const Report report = n.map(r);
    BOOST_REQUIRE(bool(report));
    BOOST_TEST(report.topology.number_of_isolated_vertices == 2u);
    Points p = n.points();
    BOOST_TEST((n.is_untouched(Vertex(0)) && n.is_untouched(Vertex(Index(p.size() - 1)))));
    p.erase(p.begin());
    p.pop_back();
    if(r == Retriangulation::WHEN_NEEDED)
      BOOST_TEST(largest_distance(p, m.points()) <= centred_place);
    check_radii(p);
  }
}

BOOST_AUTO_TEST_CASE(a_polyhedron_with_exact_points)
{
  typedef CGAL::Polyhedron_3<CGAL::Exact_predicates_exact_constructions_kernel> Polyhedron;
  typedef boost::graph_traits<Polyhedron>::vertex_descriptor Polyhedron_vertex;
  Maps m(distorted_sphere(2, .02, 10));
  BOOST_REQUIRE(bool(m.map(Retriangulation::WHEN_NEEDED)));
  Polyhedron polyhedron;
  CGAL::copy_face_graph(m.sm, polyhedron);
  std::map<Polyhedron_vertex, Polyhedron::Point_3> images;
  const boost::associative_property_map<std::map<Polyhedron_vertex, Polyhedron::Point_3> > on_sphere(images);
  const CE::Flattening_report<Polyhedron> report = CE::map_to_sphere(polyhedron, on_sphere);
  BOOST_REQUIRE(bool(report));
  BOOST_REQUIRE(images.size() == num_vertices(m.sm));
  std::map<std::array<double, 3>, Point> expected; // by point of the surface
  for(Vertex v : vertices(m.sm))
    expected[point(m.sm.point(v))] = point(m.on_sphere[v]);
  const auto rounded = [](const auto& p) { return Point{{CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())}}; };
  for(const auto& image : images)
    BOOST_TEST(distance<double>(rounded(image.second), expected.at(rounded(image.first->point()))) <= centred_place);
}

BOOST_AUTO_TEST_SUITE_END()

// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_SUITE(with_flips)

namespace {

void check_with_flips(const Mesh& mesh, Retriangulation retriangulation)
{
  Maps m(mesh);
  Refinement refinement;
  const Report report = m.map(params::retriangulation(retriangulation).spherical_refinement(std::ref(refinement)));
  BOOST_REQUIRE(bool(report));
  BOOST_TEST(report.statistics.number_of_flips > 0u);
  BOOST_TEST(report.rounded_faces.empty());
  BOOST_TEST(refinement.parts.crossings.size() > 0u);
  BOOST_TEST(std::abs(report.solid_angle - 4 * pi) <= sum_of_angles(num_faces(m.sm)));
  check_radii(m.points());
  BOOST_TEST(distance_of_barycentre(m, std::vector<double>(num_vertices(m.sm), 1)) <= centred);
  check_refinement(refinement, CE::import_mesh(m.sm).triangulation);
  for(Vertex v : vertices(m.sm))
    BOOST_TEST((refinement.points[v] == point(m.on_sphere[v])));
  std::set<Face> bent(report.bent_faces.begin(), report.bent_faces.end());
  for(Face f : faces(m.sm))
  {
    const Halfedge h = halfedge(f, m.sm);
    BOOST_TEST(is_positive(m.on_sphere[source(h, m.sm)], m.on_sphere[target(h, m.sm)], m.on_sphere[target(next(h, m.sm), m.sm)])
               == (bent.count(f) == 0));
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(overlays)
{
  for(unsigned seed = 0; seed < 4; ++seed)
    for(const Retriangulation r : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
      check_with_flips(surface_mesh<Mesh>(needles(seed)), r);
}

BOOST_AUTO_TEST_CASE(cow, * needs_mesh("cow.off"))
{
  check_with_flips(read_mesh("cow.off"), Retriangulation::WHEN_NEEDED);
}

BOOST_AUTO_TEST_CASE(triceratops, * needs_mesh("triceratops.off"))
{
  check_with_flips(read_mesh("triceratops.off"), Retriangulation::ALWAYS);
}

// The triangulation found is the convex hull of the points.
BOOST_AUTO_TEST_CASE(the_polyhedron_is_convex)
{
  for(unsigned seed = 0; seed < 4; ++seed)
  {
    const Mesh mesh = surface_mesh<Mesh>(needles(seed));
    const auto np = params::retriangulation(seed % 2 == 0 ? Retriangulation::ALWAYS : Retriangulation::WHEN_NEEDED);
    CEi::Sphere_mapping<Mesh, double> mapping(mesh);
    mapping.run(np, std::true_type());
    BOOST_REQUIRE(bool(mapping.report));
    const auto& t = mapping.polyhedron.triangulation;
    std::set<std::set<Index> > found, expected;
    for(Index f = 0; f < t.number_of_faces(); ++f)
      found.insert({t.origin(3 * f), t.origin(3 * f + 1), t.origin(3 * f + 2)});
    const Mesh convex = hull(mapping.points);
    for(Face f : faces(convex))
    {
      std::set<Index> triangle;
      for(Vertex v : vertices_around_face(halfedge(f, convex), convex))
        triangle.insert(Index(v));
      expected.insert(triangle);
    }
    BOOST_TEST((found == expected));

    // its chords are scaled from lengths that Ptolemy's theorem gives
    auto lengths = mapping.mesh.triangulation;
    std::vector<double> error(lengths.number_of_edges(), 0);
    for(Index e : mapping.polyhedron.flips)
      flip_with_error(lengths, error, e);
    if(mapping.report.statistics.conformal_class == CE::Conformal_class::GIVEN_TRIANGULATION)
      for(Index e = 0; e < t.number_of_edges(); ++e)
      {
        const Index h = t.edge_halfedge(e);
        const auto &v = mapping.polyhedron.vectors[t.origin(h)], &w = mapping.polyhedron.vectors[t.target(h)];
        const double square = -2 * static_cast<double>(CEi::lorentz_product(v, w));
        BOOST_TEST(std::abs(square / (lengths.length(e) * lengths.length(e)) - 1) <= 2 * error[e] + 4 * unit_roundoff);
      }
  }
}

BOOST_AUTO_TEST_CASE(the_vertex_at_infinity_does_not_matter)
{
  const Mesh mesh = surface_mesh<Mesh>(needles(1));
  for(const Retriangulation r : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
  {
    Maps m(mesh);
    Refinement refinement;
    BOOST_REQUIRE(bool(m.map(params::retriangulation(r).spherical_refinement(std::ref(refinement)))));
    for(Index v = 0; v < 162; v += 9)
    {
      Maps n(mesh);
      const Report report = n.map(params::retriangulation(r).spherical_refinement(std::ref(refinement)).vertex_at_infinity(Vertex(v)));
      BOOST_REQUIRE(bool(report));
      BOOST_TEST(largest_distance(n.points(), m.points()) <= centred_place);
    }
  }
}

// Vertices with one or two edges in the Delaunay triangulation, too.
BOOST_AUTO_TEST_CASE(every_vertex_can_be_sent_to_infinity)
{
  const auto given = triangulation(needles(2));
  auto start = given;
  std::vector<Index> flips, all;
  for(Index e = 0; e < given.number_of_edges(); ++e)
    all.push_back(e);
  CEi::Delaunay_flipper<double> flipper(start);
  BOOST_REQUIRE(flipper.flip_to_delaunay(std::vector<double>(), all, CEi::Flip_rule::EUCLIDEAN, [&](Index e) { flips.push_back(e); }));
  const CEi::Ideal_polyhedron_finder<double> find(given, CE::Solver_options(), CEi::factorization_maker<CE::Default_solver_traits>());
  std::size_t small_stars = 0;
  for(Index v = 0; v < given.number_of_vertices(); ++v)
  {
    small_stars += start.degree(v) < 3;
    BOOST_TEST(CE::is_success(find.convex(start, flips, v, CEi::Symmetry_axis()).status));
  }
  BOOST_TEST(small_stars > 0u);
}

BOOST_AUTO_TEST_CASE(inversions_of_space_do_not_matter)
{
  Refinement refinement;
  const Soup soup = needles(2);
  Maps m(soup);
  const auto np = params::spherical_refinement(std::ref(refinement));
  BOOST_REQUIRE(bool(m.map(np)));
  for(const Point& centre : { Point{{9, 0, 0}}, Point{{2, 3, 1}} })
  {
    Maps n(inverted(soup, centre));
    const Report report = n.map(np);
    BOOST_REQUIRE(bool(report));
    BOOST_TEST(report.statistics.number_of_flips > 0u);
    BOOST_TEST(largest_difference_of_chords(n.points(), m.points()) <= rounded_u + centred_place); // the points given are rounded
  }
}

BOOST_AUTO_TEST_CASE(diagonals_of_flat_quads_do_not_matter)
{
  const Point x = {{1, 0, 0}}, y = {{0, 2, 0}}, z = {{0, 0, 3}};
  const Point skew_y = {{.7, 2, 0}}, skew_z = {{-.4, .6, 1.5}};
  for(const bool is_skew : { false, true })
  {
    const auto soup = [&](unsigned diagonals) { return hexahedron(x, is_skew ? skew_y : y, is_skew ? skew_z : z, diagonals); };
    Points first;
    for(unsigned diagonals = 0; diagonals < 64; ++diagonals)
    {
      Maps m(soup(diagonals));
      Refinement refinement;
      const Report report = m.map(params::retriangulation(Retriangulation::ALWAYS).spherical_refinement(std::ref(refinement)));
      BOOST_REQUIRE(bool(report));
      check_radii(m.points());
      check_parts(refinement);
      if(diagonals == 0)
        first = m.points();
      BOOST_TEST(largest_distance(m.points(), first) <= rounded_u + centred_place); // diagonals, and skew points, are rounded
    }
    if(!is_skew) // a box has the symmetries of one
      for(std::size_t v = 0; v < 8; ++v)
        for(std::size_t i = 0; i < 3; ++i)
          BOOST_TEST(std::abs(std::abs(first[v][i]) - std::abs(first[0][i])) <= centred_place);
  }
}

BOOST_AUTO_TEST_CASE(cubes)
{
  for(const Retriangulation r : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
    for(unsigned diagonals = 0; diagonals < 64; ++diagonals)
    {
      Maps m(hexahedron({{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}, diagonals));
      Refinement refinement;
      const Report report = m.map(params::retriangulation(r).spherical_refinement(std::ref(refinement)));
      BOOST_REQUIRE(bool(report));
      check_parts(refinement);
      if(r == Retriangulation::ALWAYS)
        for(unsigned v = 0; v < 8; ++v)
          BOOST_TEST(distance<double>(m.points()[v], unit({{v & 1 ? 1. : -1., v & 2 ? 1. : -1., v & 4 ? 1. : -1.}})) <= centred_place);
    }
}

namespace {

// Exported in single precision, or computed with a different sine: cocircular corners are so up to this.
const double noises[] = { 0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3 };

void check_body(const Named_soup& body, double noise, Retriangulation r)
{
  BOOST_TEST_CONTEXT(body.name << " noise " << noise << (r == Retriangulation::ALWAYS ? " always" : ""))
  {
    Soup soup = body.soup;
    add_noise(soup, noise, 1);
    Maps m(soup);
    Refinement refinement;
    BOOST_REQUIRE(bool(m.map(params::retriangulation(r).spherical_refinement(std::ref(refinement)))));
    check_parts(refinement);
  }
}

} // namespace

// Many corners on one circle, exactly or nearly: rounding decides which triangles of such a face are those of the polyhedron.
BOOST_AUTO_TEST_CASE(bodies_with_cocircular_corners)
{
  std::size_t number = 0;
  for(const Index n : testing::cases<Index>({ 4, 8, 14, 33 }))
    for(const Named_soup& body : bodies_with_ties(n, true))
      for(const int shift : { 0, 3 })
      {
        check_body(body, noises[(number + std::size_t(shift)) % 6], number % 2 == 0 ? Retriangulation::ALWAYS : Retriangulation::WHEN_NEEDED);
        ++number;
      }
}

BOOST_AUTO_TEST_CASE(bodies_with_all_noises, * slow())
{
  for(const Index n : { 5, 12, 17 })
    for(const Named_soup& body : bodies_with_ties(n, true))
      for(const double noise : noises)
        for(const Retriangulation r : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
          check_body(body, noise, r);
}

// A point on an edge that divides only one of both triangles: the surface is that where both are divided.
BOOST_AUTO_TEST_CASE(faces_of_no_area)
{
  Soup given = distorted_sphere(2, .02, 4), divided = given;
  const std::size_t number = divide_at_middles(given, 9, false);
  BOOST_TEST(divide_at_middles(divided, 9, true) == number);
  Maps m(given), n(divided);
  Refinement refinement;
  const Report report = m.map(params::spherical_refinement(std::ref(refinement)));
  BOOST_REQUIRE(bool(report));
  BOOST_REQUIRE(bool(n.map(Retriangulation::WHEN_NEEDED)));
  BOOST_TEST(report.statistics.number_of_resolving_flips == number);
  BOOST_TEST(largest_difference_of_chords(m.points(), n.points()) <= 1e-10); // that of the barycentres is 1e-12, and lengths are rounded
}

// An edge is concave by 1e-5 at most (Ideal_polyhedron_finder.h); points move by the square of that, times the condition of the problem.
BOOST_AUTO_TEST_CASE(bodies_are_the_same_however_they_are_numbered)
{
  const double tolerance = 100 * 1e-5 * 1e-5;
  for(const double noise : { 0., 1e-12, 1e-7 })
    for(const Named_soup& body : bodies_with_ties(8, true))
      BOOST_TEST_CONTEXT(body.name << " noise " << noise)
      {
        Soup soup = body.soup;
        add_noise(soup, noise, 2);
        std::vector<Index> new_number;
        Maps given(soup), other(renumbered(soup, 3, new_number));
        Refinement refinement; // so that triangles may be bent
        const auto np = params::retriangulation(Retriangulation::ALWAYS).spherical_refinement(std::ref(refinement));
        BOOST_REQUIRE(bool(given.map(np)));
        BOOST_REQUIRE(bool(other.map(np)));
        Points p = given.points(), q;
        for(Index v : new_number)
          q.push_back(other.points()[v]);
        BOOST_TEST(largest_difference_of_chords(p, q) <= tolerance);
      }
}

BOOST_AUTO_TEST_CASE(refined_meshes)
{
  for(unsigned seed = 0; seed < 3; ++seed)
  {
    const Soup soup = seed == 2 ? distorted_sphere(2, .02, 1) : needles(seed); // the last one needs no flips
    Maps m(soup);
    Mesh refined;
    const auto on_sphere = refined.add_property_map<Vertex, Point_3>("v:on_sphere").first;
    const auto weight = refined.add_property_map<Vertex, double>("v:weight", -1).first;
    const auto input_face = refined.add_property_map<Face, Face>("f:input").first;
    Refinement refinement;
    const Report report = CE::map_to_sphere_refined(m.sm, refined, on_sphere,
      params::log_scale_factor_map(m.u).spherical_refinement(std::ref(refinement)),
      params::projective_weight_map(weight).input_face_map(input_face));
    BOOST_REQUIRE(bool(report));
    Maps direct(soup);
    Refinement other;
    BOOST_REQUIRE(bool(CE::map_to_sphere(direct.sm, direct.on_sphere, params::log_scale_factor_map(direct.u).spherical_refinement(std::ref(other)))));
    for(Vertex v : vertices(m.sm))
      BOOST_TEST(m.u[v] == direct.u[v]);
    BOOST_TEST(CGAL::is_valid_polygon_mesh(refined));
    BOOST_TEST(CGAL::is_closed(refined));
    BOOST_TEST(num_vertices(refined) + num_faces(refined) == num_edges(refined) + 2);
    BOOST_TEST((num_vertices(refined) > num_vertices(m.sm)) == (seed < 2));
    BOOST_TEST(num_vertices(refined) == refinement.parts.number_of_vertices());
    for(Vertex v : vertices(refined))
    {
      BOOST_TEST(std::abs(norm(point(on_sphere[v])) - 1) <= rounded_place);
      BOOST_TEST((weight[v] > 0 && weight[v] <= 1));
      if(std::size_t(v) < num_vertices(m.sm))
        BOOST_TEST((refined.point(v) == m.sm.point(v)));
    }
    for(Face f : faces(refined))
    {
      const Halfedge h = halfedge(f, refined), k = halfedge(input_face[f], m.sm);
      const Point_3 a = m.sm.point(source(k, m.sm)), b = m.sm.point(target(k, m.sm)), c = m.sm.point(target(next(k, m.sm), m.sm));
      for(Vertex v : vertices_around_face(h, refined)) // the parts of a triangle are as large as the whole
      {
        const Point_3 p = refined.point(v);
        const auto area = [](const Point_3& x, const Point_3& y, const Point_3& z) { return std::sqrt(CGAL::squared_area(x, y, z)); };
        const double whole = area(a, b, c), size = chord(a, b) * chord(a, c) + chord(b, c) * chord(b, c);
        const double sum = area(a, b, p) + area(b, c, p) + area(c, a, p);
        BOOST_TEST(std::abs(sum - whole) <= 4 * std::sqrt(unit_roundoff) * size); // the root of a squared area that is rounded, four times
      }
      if(next(next(next(h, refined), refined), refined) == h)
        BOOST_TEST(is_positive(on_sphere[source(h, refined)], on_sphere[target(h, refined)], on_sphere[target(next(h, refined), refined)]));
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()

// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_SUITE(refusals)

namespace {

Report check_refusal(const Mesh& mesh, Status status, Retriangulation retriangulation = Retriangulation::WHEN_NEEDED)
{
  Maps m(mesh);
  const Report report = m.map(retriangulation);
  BOOST_TEST((report.status == status));
  BOOST_TEST(m.is_untouched());
  Mesh refined;
  const auto on_sphere = refined.add_property_map<Vertex, Point_3>("v:on_sphere").first;
  if(retriangulation != Retriangulation::NEVER)
  {
    BOOST_TEST((CE::map_to_sphere_refined(mesh, refined, on_sphere).status == status));
    BOOST_TEST(num_vertices(refined) == 0u);
  }
  return report;
}

Report check_refusal(const Soup& soup, Status status, Retriangulation retriangulation = Retriangulation::WHEN_NEEDED)
{
  return check_refusal(surface_mesh<Mesh>(soup), status, retriangulation);
}

} // namespace

BOOST_AUTO_TEST_CASE(topology)
{
  Report report = check_refusal(hill(3, .4), Status::WRONG_TOPOLOGY);
  BOOST_TEST((report.topology.number_of_borders == 1 && report.topology.genus == 0));
  report = check_refusal(torus(6, 5), Status::WRONG_TOPOLOGY);
  BOOST_TEST((report.topology.number_of_borders == 0 && report.topology.genus == 1));
  report = check_refusal(together({octahedron(), tetrahedron()}), Status::WRONG_TOPOLOGY);
  BOOST_TEST((report.topology.number_of_components == 2 && report.topology.number_of_borders == 0));
  report = check_refusal(Soup{{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}}, {{{0, 1, 2}}, {{0, 2, 1}}}}, Status::WRONG_TOPOLOGY);
  BOOST_TEST((report.topology.number_of_vertices == 3 && report.topology.number_of_borders == 0 && report.topology.genus == 0));
}

BOOST_AUTO_TEST_CASE(what_is_no_surface)
{
  for(const Soup& soup : { Soup(), Soup{{{{0, 0, 0}}}, {}} })
  {
    const Report report = check_refusal(soup, Status::EMPTY_MESH);
    BOOST_TEST(report.faces.empty());
  }
  Mesh with_quad = surface_mesh<Mesh>(octahedron());
  CGAL::Euler::join_face(halfedge(*edges(with_quad).begin(), with_quad), with_quad);
  const Report report = check_refusal(with_quad, Status::NOT_TRIANGULATED);
  BOOST_TEST(report.faces.size() == 1u);
}

BOOST_AUTO_TEST_CASE(numbers)
{
  for(const double bad : { std::numeric_limits<double>::quiet_NaN(), HUGE_VAL })
  {
    Soup soup = octahedron();
    soup.points[2][1] = bad;
    const Report report = check_refusal(soup, Status::INVALID_NUMBER);
    BOOST_REQUIRE(report.vertices.size() == 1u);
    BOOST_TEST(report.vertices[0] == Vertex(2));
  }
  Soup soup = icosahedron();
  soup.points[5] = soup.points[11];
  const Report report = check_refusal(soup, Status::ZERO_LENGTH_EDGE);
  BOOST_REQUIRE(report.edge_indices.size() == 1u);
  BOOST_TEST(report.edge_indices[0][0] + report.edge_indices[0][1] == 16u);
}

// There is always a minimizer: without the star of a vertex, a triangulated sphere can be drawn in the plane with straight edges (Fary), and the
// angles of that drawing keep the energy from falling for ever. But at the minimizer, triangles of these surfaces are broken. (It is far away; the
// seeds 0 and 4 are left out: there, Newton's method does not come to it.)
BOOST_AUTO_TEST_CASE(without_flips)
{
  for(const unsigned seed : { 1u, 2u, 3u, 5u, 6u, 7u })
  {
    Maps m(needles(seed));
    const Report report = m.map(params::retriangulation(Retriangulation::NEVER).number_of_iterations(1000));
    BOOST_TEST((report.status == Status::DEGENERATE_METRIC), CE::message(report));
    BOOST_TEST(!report.faces.empty());
    BOOST_TEST(m.is_untouched());
  }
}

BOOST_AUTO_TEST_CASE(cow_without_flips, * needs_mesh("cow.off"))
{
  const Report report = check_refusal(read_mesh("cow.off"), Status::DEGENERATE_METRIC, Retriangulation::NEVER);
  BOOST_TEST(!report.faces.empty());
}

// With flips, a triangle of straight arcs may be flipped: then only the refinement is one-to-one.
BOOST_AUTO_TEST_CASE(bent_faces_without_a_refinement)
{
  std::size_t refused = 0;
  for(unsigned seed = 0; seed < 8; ++seed)
  {
    Refinement refinement;
    Maps m(needles(seed)), n(m.sm);
    const Report refined = m.map(params::retriangulation(Retriangulation::ALWAYS).spherical_refinement(std::ref(refinement)));
    const Report report = n.map(Retriangulation::ALWAYS);
    BOOST_REQUIRE(bool(refined));
    BOOST_TEST(bool(report) == refined.bent_faces.empty());
    if(bool(report))
      continue;
    ++refused;
    BOOST_TEST((report.status == Status::NOT_INJECTIVE));
    BOOST_TEST((report.faces == refined.bent_faces));
    BOOST_TEST(n.is_untouched());
  }
  BOOST_TEST(refused > 0u);
}

// Four edges twice as long as the others: all triangles are segments. The polyhedron is a regular octahedron, but there are no areas.
BOOST_AUTO_TEST_CASE(no_weight)
{
  Maps m(octahedron());
  const auto lengths = m.sm.add_property_map<Edge, double>("e:lengths", 1).first;
  for(Edge e : edges(m.sm))
    if(m.sm.vertex(e, 0) < Vertex(4) && m.sm.vertex(e, 1) < Vertex(4))
      lengths[e] = 2;
  const Report report = m.map(params::edge_length_map(lengths).moebius_weights(Moebius_weights::AREAS));
  BOOST_TEST((report.status == Status::SINGULAR_PROBLEM));
  BOOST_TEST(m.is_untouched());
  BOOST_REQUIRE(bool(m.map(params::edge_length_map(lengths))));
  for(Edge e : edges(m.sm))
    BOOST_TEST(std::abs(chord(m.on_sphere[m.sm.vertex(e, 0)], m.on_sphere[m.sm.vertex(e, 1)]) - std::sqrt(2.)) <= centred_place);
}

BOOST_AUTO_TEST_SUITE_END()
