// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Points of the sphere and of the disk, found on the surface; two surfaces, point by point: there and back, identity, Moebius
// transformations, landmarks, edges and vertices, flips.

#define BOOST_TEST_MODULE test_Surface_correspondence
#include "include/boost_test.h"
#include "include/flattened_meshes.h"
#include "include/inscribed_images.h"

#include <CGAL/Conformal_equivalence/Surface_correspondence.h>

#include <CGAL/Polygon_mesh_processing/locate.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace CEi = CGAL::Conformal_equivalence::internal;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;
using namespace testing;
using CE::Retriangulation;
using CE::Status;

namespace {

typedef CE::Sphere_locator<Mesh>              Sphere_locator;
typedef CE::Disk_locator<Mesh>                Disk_locator;
typedef Sphere_locator::Face_location         Location;
typedef CE::Three_landmarks<Vertex, Vertex>   Landmarks;
typedef std::array<double, 2>                 Point_of_disk;

// --- bounds on errors ---------------------------------------------------------------------------

// Distances on the image, and from a surface to itself by way of it: some roundings, and a map that stretches lengths up to a hundred times, or, in
// two steps, up to a hundred times and back.
constexpr double there_and_back_again = 1e3 * unit_roundoff;

// The same where the maps stretch a surface up to a thousand times.
constexpr double stretched = 1e4 * unit_roundoff;

// The same of surfaces with needles, parts of which are a hundred thousand times smaller on the one side than on the other.
constexpr double flipped = 1e6 * unit_roundoff;

// And where the landmarks, or a surface with limbs, leave for the rest only a spot.
constexpr double crowded = 1e8 * unit_roundoff;

// --- points of a mesh ---------------------------------------------------------------------------

Location random_location(const Mesh& sm, Random& random)
{
  double a = random(0, 1), b = random(0, 1);
  if(a + b > 1)
  {
    a = 1 - a;
    b = 1 - b;
  }
  return Location(Face(random.below(Index(num_faces(sm)))), {{ 1 - a - b, a, b }});
}

Point point(const Point_3& p) { return {{ p.x(), p.y(), p.z() }}; }
Point place(const Mesh& sm, const Location& l) { return point(PMP::construct_point(l, sm)); }

double distance_on(const Mesh& sm, const Location& l, const Location& m) { return distance<double>(place(sm, l), place(sm, m)); }
double distance_on(const Mesh& sm, const Location& l, Vertex v) { return distance<double>(place(sm, l), point(sm.point(v))); }

bool is_barycentric(const Location& l)
{
  double sum = 0;
  for(double x : l.second)
  {
    if(!(x >= 0))
      return false;
    sum += x;
  }
  return std::abs(sum - 1) <= 4 * unit_roundoff;
}

// A point of the edge of h, in the two faces.
std::array<Location, 2> on_edge(const Mesh& sm, Halfedge h, double t)
{
  std::array<Location, 2> result;
  for(std::size_t side = 0; side < 2; ++side)
  {
    const Face f = face(h, sm);
    result[side] = Location(f, {{ 0, 0, 0 }});
    Halfedge g = halfedge(f, sm);
    for(std::size_t k = 0; k < 3; ++k, g = next(g, sm))
      if(g == h)
      {
        result[side].second[k] = 1 - t;
        result[side].second[(k + 1) % 3] = t;
      }
    h = opposite(h, sm);
    t = 1 - t;
  }
  return result;
}

double distance_of(const Point& p, const Point& q) { return distance<double>(p, q); }
double distance_of(const Point_of_disk& p, const Point_of_disk& q) { return std::hypot(p[0] - q[0], p[1] - q[1]); }

// --- error bounds -------------------------------------------------------------------------------

// How far points of a triangle move on the surface, at most, when their images move by one: barycentric coordinates of the image
// move by 1 / (least height), those of the surface by the range of the weights times that, and these by the longest side.
struct Stretch
{
  double to_surface = 0, to_image = 0;
};

template <typename Locator>
Stretch stretch(const Mesh& sm, const Locator& locator, const std::vector<double>& weight)
{
  Stretch result;
  for(Face f : faces(sm))
  {
    double sides[3], images[3], w_min = HUGE_VAL, w_max = 0;
    std::size_t k = 0;
    for(Halfedge h : halfedges_around_face(halfedge(f, sm), sm))
    {
      sides[k] = distance<double>(point(sm.point(source(h, sm))), point(sm.point(target(h, sm))));
      images[k++] = distance_of(locator.image_point(locator.vertex_location(source(h, sm))),
                                locator.image_point(locator.vertex_location(target(h, sm))));
      w_min = (std::min)(w_min, weight[source(h, sm)]);
      w_max = (std::max)(w_max, weight[source(h, sm)]);
    }
    const auto area = [](const double* l)
    {
      const CEi::Incircle_form<double> triangle(l[0], l[1], l[2]);
      return triangle.r * triangle.s;
    };
    const auto least_height = [&](const double* l) { return 2 * area(l) / *std::max_element(l, l + 3); };
    result.to_surface = (std::max)(result.to_surface, 2 * *std::max_element(sides, sides + 3) * w_max / w_min / least_height(images));
    result.to_image = (std::max)(result.to_image, 2 * *std::max_element(images, images + 3) * w_max / w_min / least_height(sides));
  }
  return result;
}

} // namespace

// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_SUITE(spheres)

namespace {

// An inversion and a reflection: the orientation stays.
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

Point random_direction(Random& random)
{
  Point p;
  do
    p = {{ random(-1, 1), random(-1, 1), random(-1, 1) }};
  while(!(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] < 1));
  return p;
}

Point unit(const Point& p)
{
  const double length = std::hypot(p[0], p[1], p[2]);
  return {{ p[0] / length, p[1] / length, p[2] / length }};
}

// Every direction is found, and goes back to itself.
void check_directions(const Sphere_locator& locator, const std::vector<Point>& directions, double tolerance)
{
  for(const Point& d : directions)
  {
    const Location l = locator.surface_point(d);
    BOOST_TEST(is_barycentric(l));
    BOOST_TEST(distance_of(locator.image_point(l), unit(d)) <= tolerance);
  }
}

std::vector<Point> random_directions(std::size_t n, unsigned seed)
{
  Random random(seed);
  std::vector<Point> result;
  for(std::size_t i = 0; i < n; ++i)
    result.push_back(random_direction(random));
  return result;
}

// Vertices, midpoints of great arcs, axes: where predicates are 0, or nearly so.
std::vector<Point> special_directions(const Mesh& sm, const Sphere_locator& locator)
{
  std::vector<Point> result = { {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}, {{-1, 0, 0}}, {{0, -1, 0}}, {{0, 0, -1}}, {{1, 1, 0}},
                                {{1e-200, 0, 1e-210}}, {{0, -1e300, 1e300}} };
  const auto at = [&](Vertex v) { return locator.image_point(locator.vertex_location(v)); };
  for(Vertex v : vertices(sm))
    result.push_back(at(v));
  for(Edge e : edges(sm))
  {
    const Point p = at(sm.vertex(e, 0)), q = at(sm.vertex(e, 1));
    for(double t : { .5, .25, .3, 1e-9 })
      result.push_back({{ (1 - t) * p[0] + t * q[0], (1 - t) * p[1] + t * q[1], (1 - t) * p[2] + t * q[2] }});
  }
  return result;
}

void check_edges(const Mesh& sm, const Sphere_locator& locator)
{
  for(Edge e : edges(sm))
    for(double t : { .5, .125, .9375 })
    {
      const std::array<Location, 2> l = on_edge(sm, halfedge(e, sm), t);
      BOOST_TEST(distance_of(locator.image_point(l[0]), locator.image_point(l[1])) <= 8 * unit_roundoff);
    }
}

template <typename Correspondence>
double error_there_and_back(const Mesh& a, const Mesh& b, const Correspondence& correspondence, std::size_t n, unsigned seed)
{
  Random random(seed);
  double result = 0;
  for(std::size_t i = 0; i < n; ++i)
  {
    const Location x = random_location(a, random), y = correspondence(x);
    BOOST_TEST(is_barycentric(y));
    result = (std::max)(result, distance_on(a, correspondence.inverse(y), x));
    const Location z = random_location(b, random);
    result = (std::max)(result, distance_on(b, correspondence(correspondence.inverse(z)), z));
  }
  return result;
}

std::vector<double> weights_of_sphere(const Mesh& sm)
{
  std::vector<Point_3> on_sphere(num_vertices(sm));
  std::vector<double> weight(num_vertices(sm));
  const auto index = get(boost::vertex_index, sm);
  BOOST_REQUIRE(bool(CE::map_to_sphere(sm, boost::make_iterator_property_map(on_sphere.begin(), index),
    params::projective_weight_map(boost::make_iterator_property_map(weight.begin(), index)))));
  return weight;
}

} // namespace

BOOST_AUTO_TEST_CASE(vertices_lie_where_the_map_puts_them)
{
  for(const Soup& soup : { distorted_sphere(2, .05, 1), needles(3) })
  {
    Mesh sm = surface_mesh<Mesh>(soup);
    const auto on_sphere = sm.add_property_map<Vertex, Point_3>("v:on_sphere").first;
    CE::Spherical_refinement<double> refinement;
    BOOST_REQUIRE(bool(CE::map_to_sphere(sm, on_sphere, params::spherical_refinement(std::ref(refinement)))));
    const Sphere_locator locator(sm);
    BOOST_REQUIRE(bool(locator));
    for(Vertex v : vertices(sm))
    {
      const Location l = locator.vertex_location(v);
      BOOST_TEST(distance_on(sm, l, v) == 0);
      BOOST_TEST(distance_of(locator.image_point(l), point(on_sphere[v])) <= 4 * unit_roundoff);
    }
  }
}

// The middle of every part of a face goes to the sum of the w p of its corners, of the refinement as map_to_sphere() gives it.
BOOST_AUTO_TEST_CASE(parts_are_mapped_projectively)
{
  for(const Soup& soup : { distorted_sphere(2, .05, 1), needles(3) })
  {
    Mesh sm = surface_mesh<Mesh>(soup);
    const auto on_sphere = sm.add_property_map<Vertex, Point_3>("v:on_sphere").first;
    CE::Spherical_refinement<double> refinement;
    BOOST_REQUIRE(bool(CE::map_to_sphere(sm, on_sphere, params::spherical_refinement(std::ref(refinement)))));
    const Sphere_locator locator(sm);
    BOOST_REQUIRE(bool(locator));
    const auto input = CE::import_mesh(sm).triangulation;
    const auto& parts = refinement.parts;
    double range = 0; // of weights within a part
    for(Index f = 0; f < parts.number_of_faces(); ++f)
    {
      Point b = {{ 0, 0, 0 }}, image = {{ 0, 0, 0 }};
      double least = HUGE_VAL, greatest = 0;
      for(std::size_t c = parts.first_corner[f]; c < parts.first_corner[f + 1]; ++c)
      {
        const Index v = parts.corner_vertex[c];
        Index from = v, to = v; // the ends of the input edge it lies on
        double t = 0;
        if(v >= parts.number_of_input_vertices)
        {
          const auto& x = parts.crossings[v - parts.number_of_input_vertices];
          from = input.origin(input.edge_halfedge(x.input_edge));
          to = input.target(input.edge_halfedge(x.input_edge));
          t = x.input_parameter;
        }
        for(Index k = 0; k < 3; ++k)
        {
          const Index corner = input.origin(3 * parts.input_face[f] + k);
          b[k] += (corner == from ? (1 - t) / 3 : 0) + (corner == to ? t / 3 : 0);
          image[k] += parts.weights[v] * refinement.points[v][k];
        }
        least = (std::min)(least, parts.weights[v]);
        greatest = (std::max)(greatest, parts.weights[v]);
      }
      BOOST_TEST(distance_of(locator.image_point(Location(Face(parts.input_face[f]), b)), unit(image)) <= stretched);
      range = (std::max)(range, greatest / least);
    }
    BOOST_TEST(range > 1.2);
  }
}

// Of the triangle of great arcs of an octahedron: without weights, the map is the central projection.
BOOST_AUTO_TEST_CASE(central_projection)
{
  const Soup octahedron{{{{1, 0, 0}}, {{0, 1, 0}}, {{-1, 0, 0}}, {{0, -1, 0}}, {{0, 0, 1}}, {{0, 0, -1}}},
                        {{{0, 1, 4}}, {{1, 2, 4}}, {{2, 3, 4}}, {{3, 0, 4}}, {{1, 0, 5}}, {{2, 1, 5}}, {{3, 2, 5}}, {{0, 3, 5}}}};
  const Mesh sm = surface_mesh<Mesh>(octahedron);
  const Sphere_locator locator(sm);
  BOOST_REQUIRE(bool(locator));
  Random random(5);
  for(int i = 0; i < 200; ++i)
  {
    const Location l = random_location(sm, random);
    const Point p = place(sm, l);
    BOOST_TEST(distance_of(locator.image_point(l), unit(p)) <= 8 * unit_roundoff);
    BOOST_TEST(distance_on(sm, locator.surface_point(p), l) <= 8 * unit_roundoff);
  }
}

BOOST_AUTO_TEST_CASE(all_directions_are_found)
{
  const Mesh sm = surface_mesh<Mesh>(distorted_sphere(2, .05, 1));
  const Sphere_locator locator(sm);
  BOOST_REQUIRE(bool(locator));
  BOOST_TEST(locator.report().statistics.number_of_flips == 0u);
  const double tolerance = 16 * unit_roundoff * (1 + stretch(sm, locator, weights_of_sphere(sm)).to_image);
  BOOST_TEST(tolerance <= 1e-13); // otherwise the test would say little
  check_directions(locator, random_directions(2000, 1), tolerance);
  check_directions(locator, special_directions(sm, locator), tolerance);
  check_edges(sm, locator);
}

BOOST_AUTO_TEST_CASE(all_directions_are_found_with_flips)
{
  for(unsigned seed : {3u, 4u})
    for(Retriangulation retriangulation : {Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS})
    {
      const Mesh sm = surface_mesh<Mesh>(needles(seed));
      const Sphere_locator locator(sm, params::retriangulation(retriangulation));
      BOOST_REQUIRE(bool(locator));
      BOOST_TEST(locator.report().statistics.number_of_flips > 0u);
      check_directions(locator, random_directions(500, seed), flipped);
      check_directions(locator, special_directions(sm, locator), flipped);
      check_edges(sm, locator);
    }
}

BOOST_AUTO_TEST_CASE(a_mesh_and_itself)
{
  for(const Soup& soup : { distorted_sphere(2, .05, 1), needles(3) })
  {
    const Mesh sm = surface_mesh<Mesh>(soup);
    const auto identity = CE::make_sphere_correspondence(sm, sm);
    BOOST_REQUIRE(bool(identity));
    Random random(2);
    for(int i = 0; i < 300; ++i)
    {
      const Location l = random_location(sm, random);
      BOOST_TEST(distance_on(sm, identity(l), l) <= there_and_back_again);
      BOOST_TEST(distance_on(sm, identity.inverse(l), l) <= there_and_back_again);
    }
    for(Vertex v : vertices(sm))
    {
      const Location l = identity(v);
      BOOST_TEST(distance_on(sm, l, v) == 0);
      BOOST_TEST(distance_on(sm, identity.inverse(v), v) == 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(there_and_back)
{
  const Mesh a = surface_mesh<Mesh>(distorted_sphere(2, .05, 1)), b = surface_mesh<Mesh>(scaled(distorted_sphere(3, .02, 7), .9, 1, 1.4));
  const auto correspondence = CE::make_sphere_correspondence(a, b);
  BOOST_REQUIRE(bool(correspondence));
  // a location of one has errors of some units in its coordinates, which go to the sphere, and then to the surface
  const Stretch stretch_a = stretch(a, correspondence.first(), weights_of_sphere(a));
  const Stretch stretch_b = stretch(b, correspondence.second(), weights_of_sphere(b));
  const double bound = 16 * unit_roundoff * (1 + (std::max)(stretch_a.to_surface * stretch_b.to_image, stretch_b.to_surface * stretch_a.to_image));
  BOOST_TEST(bound <= 1e-11); // otherwise the test would say little
  BOOST_TEST(error_there_and_back(a, b, correspondence, 1000, 3) <= bound);
}

BOOST_AUTO_TEST_CASE(there_and_back_with_flips)
{
  const Mesh a = surface_mesh<Mesh>(needles(3)), b = surface_mesh<Mesh>(distorted_sphere(2, .05, 1));
  const auto correspondence = CE::make_sphere_correspondence(a, b, params::retriangulation(Retriangulation::ALWAYS));
  BOOST_REQUIRE(bool(correspondence));
  BOOST_TEST(correspondence.first().report().statistics.number_of_flips > 0u);
  BOOST_TEST(error_there_and_back(a, b, correspondence, 500, 4) <= flipped);
}

// Of two halves of a path, the one with the longer image is halved again: where there is a jump, that ends at it.
template <typename Map>
double jump(const Map& map, const Location& from, const Location& to)
{
  const auto at = [&](double t)
  {
    Location l = from;
    for(std::size_t k = 0; k < 3; ++k)
      l.second[k] += t * (to.second[k] - from.second[k]);
    return map(l);
  };
  double low = 0, high = 1;
  for(int i = 0; i < 50; ++i)
  {
    const double middle = (low + high) / 2;
    const Point p = at(low), q = at(middle), r = at(high);
    (distance<double>(p, q) < distance<double>(q, r) ? low : high) = middle;
  }
  return distance<double>(at(low), at(high));
}

// Points on both sides of an edge are the same, and no path within a face jumps.
BOOST_AUTO_TEST_CASE(continuity)
{
  const Mesh a = surface_mesh<Mesh>(needles(4)), b = surface_mesh<Mesh>(distorted_sphere(2, .05, 1));
  const auto correspondence = CE::make_sphere_correspondence(a, b);
  BOOST_REQUIRE(bool(correspondence));
  for(Edge e : edges(a))
    for(double t : {.1, .5, .8})
    {
      const std::array<Location, 2> l = on_edge(a, halfedge(e, a), t);
      BOOST_TEST(distance_on(b, correspondence(l[0]), correspondence(l[1])) <= stretched);
    }
  Random random(1);
  for(Face f : faces(a))
  {
    const double t = random(0, 1), s = random(0, 1);
    const Location from(f, {{ 1 - t, t, 0 }}), to(f, {{ 0, 1 - s, s }});
    BOOST_TEST(jump([&](const Location& l) { return place(b, correspondence(l)); }, from, to) <= flipped);
  }
  for(Face f : faces(b))
  {
    const double t = random(0, 1), s = random(0, 1);
    const Location from(f, {{ 1 - t, t, 0 }}), to(f, {{ 0, 1 - s, s }});
    BOOST_TEST(jump([&](const Location& l) { return place(a, correspondence.inverse(l)); }, from, to) <= flipped);
  }
}

// A map of numbers that jumps is found out.
BOOST_AUTO_TEST_CASE(jumps_are_found)
{
  const auto step = [](const Location& l) { return Point{{ l.second[0] + (l.second[1] < .3 ? 1e-6 : 0.), 0, 0 }}; };
  BOOST_TEST(jump(step, Location(Face(0), {{ 1, 0, 0 }}), Location(Face(0), {{ 0, 1, 0 }})) >= 9e-7);
}

// Moebius transformations keep cross ratios of distances and the orientation; the points given go to each other, bit by bit.
BOOST_AUTO_TEST_CASE(three_points)
{
  typedef CEi::Wide_vector Wide_vector;
  Random random(4);
  const auto wide = [](const Point& p) { return CEi::unit_vector({{ p[0], p[1], p[2] }}); };
  const auto chord = [](const Wide_vector& p, const Wide_vector& q)
  {
    const Wide_vector d = CEi::difference(p, q);
    return std::sqrt(double(CEi::dot_product(d, d)));
  };
  for(const double size : {1., 1e-3, 1e-9}) // of the triangle of the first three points
    for(int i = 0; i < 20; ++i)
    {
      std::array<Wide_vector, 3> p, q;
      const Point centre = random_direction(random);
      for(std::size_t k = 0; k < 3; ++k)
      {
        Point d = random_direction(random);
        for(std::size_t j = 0; j < 3; ++j)
          d[j] = size == 1. ? d[j] : centre[j] + size * d[j];
        p[k] = wide(d);
        q[k] = wide(random_direction(random));
      }
      const CEi::Three_point_transformation there(p, q), back(q, p);
      BOOST_REQUIRE(there.is_valid());
      for(std::size_t k = 0; k < 3; ++k)
        BOOST_TEST((there(CEi::unit_vector(p[k])) == q[k]));
      Wide_vector x[2], y[2];
      for(std::size_t k = 0; k < 2; ++k)
      {
        Point d = random_direction(random);
        for(std::size_t j = 0; j < 3; ++j)
          d[j] = size == 1. ? d[j] : centre[j] + 2 * size * d[j];
        x[k] = wide(d);
        y[k] = CEi::unit_vector(there(x[k]));
        // of some ten chords, of which the shortest are a thousandth of the others
        BOOST_TEST(chord(CEi::unit_vector(back(y[k])), x[k]) <= 1e5 * unit_roundoff * size);
      }
      const double before = chord(p[0], x[0]) * chord(p[1], x[1]) / chord(p[0], x[1]) / chord(p[1], x[0]),
                   after = chord(q[0], y[0]) * chord(q[1], y[1]) / chord(q[0], y[1]) / chord(q[1], y[0]);
      BOOST_TEST(std::abs(after / before - 1) <= 1e5 * unit_roundoff);
      const auto side = [](const std::array<Wide_vector, 3>& t, const Wide_vector& z)
        { return double(CEi::determinant(CEi::difference(t[1], t[0]), CEi::difference(t[2], t[0]), CEi::difference(z, t[0]))); };
      BOOST_TEST((side(p, x[0]) > 0) == (side(q, y[0]) > 0));
    }
  const std::array<Wide_vector, 3> p = {{ wide({{1, 0, 0}}), wide({{0, 1, 0}}), wide({{0, 0, 1}}) }}, q = {{ p[0], p[0], p[1] }};
  BOOST_TEST(!CEi::Three_point_transformation(p, q).is_valid());
  BOOST_TEST(!CEi::Three_point_transformation(q, p).is_valid());
}

// The same conformal class and the same triangulation: the three landmarks bring all vertices together.
BOOST_AUTO_TEST_CASE(inversions_of_space)
{
  for(const bool is_flipped : {false, true})
  {
    const Soup soup = is_flipped ? needles(3) : distorted_sphere(2, .05, 1);
    const Mesh a = surface_mesh<Mesh>(soup), b = surface_mesh<Mesh>(inverted(soup, is_flipped ? Point{{9, 4, 5}} : Point{{.9, 1.4, 1.2}}));
    const Landmarks landmarks = { {{ Vertex(0), Vertex(5), Vertex(17) }}, {{ Vertex(0), Vertex(5), Vertex(17) }} };
    const auto correspondence = CE::make_sphere_correspondence(a, b, landmarks);
    BOOST_REQUIRE(bool(correspondence));
    BOOST_TEST((correspondence.first().report().statistics.number_of_flips > 0) == is_flipped);
    double largest = 0;
    for(Vertex v : vertices(a))
    {
      largest = (std::max)(largest, distance_on(b, correspondence(v), v));
      largest = (std::max)(largest, distance_on(a, correspondence.inverse(v), v));
    }
    BOOST_TEST(largest <= flipped);
  }
}

// Landmarks far from where they would go, close to each other, and in the mirrored order.
BOOST_AUTO_TEST_CASE(landmarks_are_met)
{
  const Mesh a = surface_mesh<Mesh>(distorted_sphere(2, .05, 1)), b = surface_mesh<Mesh>(distorted_sphere(3, .02, 7));
  const std::vector<std::array<Vertex, 3> > triples = { {{ Vertex(0), Vertex(1), Vertex(2) }}, {{ Vertex(2), Vertex(1), Vertex(0) }},
    {{ Vertex(40), Vertex(100), Vertex(161) }}, {{ Vertex(30), Vertex(70), Vertex(11) }} };
  for(const auto& t : triples)
    for(const auto& u : triples)
    {
      const auto correspondence = CE::make_sphere_correspondence(a, b, Landmarks{ t, u });
      BOOST_REQUIRE(bool(correspondence));
      for(std::size_t i = 0; i < 3; ++i)
      {
        BOOST_TEST(distance_on(b, correspondence(t[i]), u[i]) == 0);
        BOOST_TEST(distance_on(a, correspondence.inverse(u[i]), t[i]) == 0);
      }
      BOOST_TEST(error_there_and_back(a, b, correspondence, 50, 6) <= crowded);
    }
}

BOOST_AUTO_TEST_CASE(landmarks_that_coincide)
{
  const Mesh a = surface_mesh<Mesh>(distorted_sphere(1, .05, 1));
  const Landmarks landmarks{ {{ Vertex(0), Vertex(1), Vertex(0) }}, {{ Vertex(0), Vertex(1), Vertex(2) }} };
  const auto correspondence = CE::make_sphere_correspondence(a, a, landmarks);
  BOOST_TEST(!bool(correspondence));
  BOOST_TEST((correspondence.status() == Status::SINGULAR_PROBLEM));
}

BOOST_AUTO_TEST_CASE(refusals)
{
  const Mesh sphere = surface_mesh<Mesh>(icosahedron()), doughnut = surface_mesh<Mesh>(torus(6, 5));
  BOOST_TEST((CE::make_sphere_correspondence(sphere, doughnut).status() == Status::WRONG_TOPOLOGY));
  BOOST_TEST((CE::make_sphere_correspondence(doughnut, sphere).status() == Status::WRONG_TOPOLOGY));
  BOOST_TEST((CE::make_disk_correspondence(sphere, sphere).status() == Status::WRONG_TOPOLOGY));
  BOOST_TEST(!bool(Sphere_locator(Mesh())));
}

BOOST_AUTO_TEST_CASE(meshes_of_different_types)
{
  const Mesh a = surface_mesh<Mesh>(distorted_sphere(1, .05, 1));
  CGAL::Polyhedron_3<Kernel> b;
  CGAL::copy_face_graph(a, b);
  const auto correspondence = CE::make_sphere_correspondence(a, b);
  BOOST_REQUIRE(bool(correspondence));
  Random random(2);
  for(int i = 0; i < 100; ++i)
  {
    const Location l = random_location(a, random);
    BOOST_TEST(distance<double>(place(a, l), point(PMP::construct_point(correspondence(l), b))) <= there_and_back_again);
  }
}

BOOST_AUTO_TEST_CASE(cow, * needs_mesh("cow.off"))
{
  const Mesh a = read_mesh("cow.off"), b = surface_mesh<Mesh>(icosphere(3));
  const auto correspondence = CE::make_sphere_correspondence(a, b);
  BOOST_REQUIRE(bool(correspondence));
  BOOST_TEST(correspondence.first().report().statistics.number_of_flips > 0u);
  check_directions(correspondence.first(), random_directions(1000, 8), crowded);
  check_edges(a, correspondence.first());
  Random random(9);
  for(int i = 0; i < 300; ++i)
  {
    const Location l = random_location(b, random);
    BOOST_TEST(distance_on(b, correspondence(correspondence.inverse(l)), l) <= crowded);
  }
}

BOOST_AUTO_TEST_SUITE_END()

// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_SUITE(disks)

namespace {

Soup bumpy_disk(Index n) { return rings(n, [](double x, double y) { return .4 * std::sin(2 * x + 1) * std::cos(3 * y) + .2 * x * y; }); }

// Thin triangles that need flips.
Soup thorns(unsigned seed)
{
  Soup soup = flat_grid(8);
  Random random(seed);
  for(Point& p : soup.points)
    p = {{3 * p[0] + random(-.1, .1), p[1] + random(-.05, .05), random(-.25, .25)}};
  return soup;
}

Soup sphere_without_a_triangle(int levels)
{
  Soup soup = icosphere(levels);
  soup.triangles.erase(soup.triangles.begin());
  return soup;
}

Landmarks border_landmarks(const Mesh& a, const Mesh& b)
{
  const auto three = [](const Mesh& sm)
  {
    std::vector<Vertex> border = border_vertices(sm);
    std::reverse(border.begin(), border.end()); // the surface on the left
    return std::array<Vertex, 3>{{ border[0], border[border.size() / 3], border[2 * border.size() / 3] }};
  };
  return { three(a), three(b) };
}

double norm(const Point_of_disk& p) { return std::hypot(p[0], p[1]); }

} // namespace

BOOST_AUTO_TEST_CASE(vertices_lie_where_the_map_puts_them)
{
  for(const Soup& soup : { bumpy_disk(5), thorns(1), one_triangle({{0, 0, 0}}, {{2, 0, 0}}, {{0, 1, 0}}) })
  {
    Mesh sm = surface_mesh<Mesh>(soup);
    const auto on_disk = sm.add_property_map<Vertex, Point_2>("v:on_disk").first;
    CE::Common_refinement<double> refinement;
    BOOST_REQUIRE(bool(CE::map_to_disk(sm, on_disk, params::common_refinement(std::ref(refinement)))));
    const Disk_locator locator(sm);
    BOOST_REQUIRE(bool(locator));
    for(Vertex v : vertices(sm))
    {
      const Location l = locator.vertex_location(v);
      BOOST_TEST(distance_on(sm, l, v) == 0);
      BOOST_TEST(distance_of(locator.image_point(l), Point_of_disk{{ on_disk[v].x(), on_disk[v].y() }}) <= 4 * unit_roundoff);
      BOOST_TEST(distance_on(sm, locator.surface_point(locator.image_point(l)), v) <= stretched);
    }
  }
}

// All points of the plane have a nearest point of the image: itself, or one of the border.
BOOST_AUTO_TEST_CASE(all_points_are_found)
{
  bool is_any_border_edge_lost = false;
  for(const Soup& soup : { bumpy_disk(5), thorns(1), thorns(2), sphere_without_a_triangle(2), one_triangle({{0, 0, 0}}, {{2, 0, 0}}, {{0, 1, 0}}) })
  {
    const Mesh sm = surface_mesh<Mesh>(soup);
    const Disk_locator locator(sm, params::retriangulation(soup.triangles.size() == 319 ? Retriangulation::ALWAYS : Retriangulation::WHEN_NEEDED));
    BOOST_REQUIRE(bool(locator));
    is_any_border_edge_lost = is_any_border_edge_lost || !locator.report().lost_border_edges.empty();
    // the border of the image
    std::vector<Point_of_disk> border;
    const bool is_flipped = locator.report().statistics.number_of_flips > 0;
    for(Vertex v : border_vertices(sm))
      border.push_back(locator.image_point(locator.vertex_location(v)));
    Random random(1);
    std::size_t outside = 0;
    for(int i = 0; i < 1000; ++i)
    {
      const Point_of_disk p = {{ random(-1.2, 1.2), random(-1.2, 1.2) }};
      const Location l = locator.surface_point(p);
      BOOST_TEST(is_barycentric(l));
      const Point_of_disk q = locator.image_point(l);
      double nearest = HUGE_VAL;
      bool is_inside = true;
      for(std::size_t k = 0; k < border.size(); ++k)
      {
        const Point_of_disk r = border[(k + 1) % border.size()], s = border[k]; // counterclockwise
        const double x = s[0] - r[0], y = s[1] - r[1], square = x * x + y * y;
        is_inside = is_inside && x * (p[1] - r[1]) - y * (p[0] - r[0]) >= 0;
        const double t = (std::min)(1., (std::max)(0., (x * (p[0] - r[0]) + y * (p[1] - r[1])) / square));
        nearest = (std::min)(nearest, std::hypot(r[0] + t * x - p[0], r[1] + t * y - p[1]));
      }
      if(is_inside)
        BOOST_TEST(distance_of(p, q) <= stretched);
      else
      {
        ++outside;
        // a border edge that was flipped is nearer to the circle
        BOOST_TEST(distance_of(p, q) <= nearest + stretched);
        if(!is_flipped)
          BOOST_TEST(distance_of(p, q) >= nearest - stretched);
        BOOST_TEST(norm(q) <= 1 + 4 * unit_roundoff);
      }
    }
    BOOST_TEST((outside > 100 && outside < 900));
  }
  BOOST_TEST(is_any_border_edge_lost);
}

BOOST_AUTO_TEST_CASE(identity_and_continuity)
{
  for(const Soup& soup : { bumpy_disk(5), thorns(1) })
  {
    const Mesh sm = surface_mesh<Mesh>(soup);
    const auto identity = CE::make_disk_correspondence(sm, sm);
    BOOST_REQUIRE(bool(identity));
    Random random(2);
    for(int i = 0; i < 300; ++i)
    {
      const Location l = random_location(sm, random);
      BOOST_TEST(distance_on(sm, identity(l), l) <= there_and_back_again);
    }
    for(Vertex v : vertices(sm))
      BOOST_TEST(distance_on(sm, identity(v), v) == 0);
    for(Edge e : edges(sm))
      if(!is_border(e, sm))
      {
        const std::array<Location, 2> l = on_edge(sm, halfedge(e, sm), .375);
        BOOST_TEST(distance_of(identity.first().image_point(l[0]), identity.first().image_point(l[1])) <= 8 * unit_roundoff);
        BOOST_TEST(distance_on(sm, identity(l[1]), l[0]) <= there_and_back_again);
      }
  }
}

// Points whose images are not near the circle come back.
BOOST_AUTO_TEST_CASE(there_and_back)
{
  for(const bool is_flipped : {false, true})
  {
    const Mesh a = surface_mesh<Mesh>(is_flipped ? thorns(1) : bumpy_disk(4));
    const Mesh b = surface_mesh<Mesh>(rings(6, [](double x, double y) { return .5 * x * x - .3 * y; }));
    const Landmarks landmarks = border_landmarks(a, b);
    const auto correspondence = CE::make_disk_correspondence(a, b, landmarks);
    BOOST_REQUIRE(bool(correspondence));
    BOOST_TEST((correspondence.first().report().statistics.number_of_flips > 0) == is_flipped);
    for(std::size_t i = 0; i < 3; ++i)
    {
      BOOST_TEST(distance_on(b, correspondence(landmarks.a[i]), landmarks.b[i]) <= few_roundings);
      BOOST_TEST(distance_on(a, correspondence.inverse(landmarks.b[i]), landmarks.a[i]) <= few_roundings);
    }
    Random random(3);
    double largest = 0, farthest = 0;
    for(int i = 0; i < 500; ++i)
    {
      const Location x = random_location(a, random), y = correspondence(x), z = correspondence.inverse(y);
      const double d = distance_of(correspondence.first().image_point(x), correspondence.second().image_point(y));
      if(norm(correspondence.first().image_point(x)) < .7)
        largest = (std::max)(largest, distance_on(a, x, z));
      farthest = (std::max)(farthest, d);
    }
    BOOST_TEST(largest <= flipped);
    BOOST_TEST(farthest <= .3); // the slivers between the polygons and the circle
  }
}

// Inversions keep the conformal class: all vertices correspond.
BOOST_AUTO_TEST_CASE(inversions_of_space)
{
  const Soup soup = bumpy_disk(4);
  Soup other = soup;
  for(Point& p : other.points)
  {
    const Point d = {{ p[0] - 1.5, p[1] - .5, p[2] - 2 }};
    const double square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    p = {{ -d[0] / square, d[1] / square, d[2] / square }};
  }
  const Mesh a = surface_mesh<Mesh>(soup), b = surface_mesh<Mesh>(other);
  const auto correspondence = CE::make_disk_correspondence(a, b, border_landmarks(a, a));
  BOOST_REQUIRE(bool(correspondence));
  double largest = 0;
  for(Vertex v : vertices(a))
    largest = (std::max)(largest, distance_on(b, correspondence(v), v));
  BOOST_TEST(largest <= stretched);
}

BOOST_AUTO_TEST_CASE(landmarks_in_the_other_order)
{
  const Mesh a = surface_mesh<Mesh>(bumpy_disk(3));
  Landmarks landmarks = border_landmarks(a, a);
  BOOST_TEST(bool(CE::make_disk_correspondence(a, a, landmarks)));
  std::swap(landmarks.b[0], landmarks.b[1]);
  BOOST_TEST((CE::make_disk_correspondence(a, a, landmarks).status() == Status::SINGULAR_PROBLEM));
}

BOOST_AUTO_TEST_CASE(lion, * needs_mesh("lion-head.off"))
{
  const Mesh a = read_mesh("lion-head.off"), b = read_mesh("nefertiti.off");
  const auto correspondence = CE::make_disk_correspondence(a, b);
  BOOST_REQUIRE(bool(correspondence));
  Random random(3);
  for(int i = 0; i < 500; ++i)
  {
    const Location x = random_location(a, random);
    const Point_of_disk p = correspondence.first().image_point(x);
    if(norm(p) < .99)
      BOOST_TEST(distance_of(correspondence.second().image_point(correspondence(x)), p) <= flipped);
  }
}

BOOST_AUTO_TEST_SUITE_END()
