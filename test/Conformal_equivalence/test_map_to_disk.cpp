// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The map to the disk: the border on the circle, conformality at every edge, frames, known solutions, flips of the double and their overlay,
// refusals.

#define BOOST_TEST_MODULE test_map_to_disk
#include "include/boost_test.h"
#include "include/flattened_meshes.h"
#include "include/inscribed_images.h"
#include "include/output_maps.h"
#include "include/solids.h"

#include <CGAL/Conformal_equivalence/map_to_disk.h>
#include <CGAL/Conformal_equivalence/multiprecision.h>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
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
typedef CE::Common_refinement<double>                        Refinement;
typedef CE::Centred_disk_frame<Vertex>                       Centred_frame;
typedef CE::Three_point_disk_frame<Vertex>                   Three_point_frame;
typedef std::complex<double>                                 Complex;
typedef std::vector<Complex>                                 Complexes;

// A mesh with all the maps that map_to_disk() can write.
struct Maps : Image_maps<Point_2>
{
  Mesh::Property_map<Vertex, Point_2> in_disk = image;

  explicit Maps(const Mesh& mesh) : Image_maps<Point_2>(mesh, Point_2(unwritten, unwritten)) {}
  explicit Maps(const Soup& soup) : Maps(surface_mesh<Mesh>(soup)) {}

  template <typename NamedParameters>
  Report map(const NamedParameters& np) { return CE::map_to_disk(sm, in_disk, CE::combine_named_parameters(parameters(), np)); }
  Report map(Retriangulation retriangulation = Retriangulation::WHEN_NEEDED) { return map(params::retriangulation(retriangulation)); }

  Complex operator[](Vertex v) const { return Complex(in_disk[v].x(), in_disk[v].y()); }

  Complexes points() const
  {
    Complexes result;
    for(Vertex v : vertices(sm))
      result.push_back((*this)[v]);
    return result;
  }

  // counterclockwise: with the surface on the left
  std::vector<Vertex> border() const
  {
    std::vector<Vertex> result = border_vertices(sm);
    std::reverse(result.begin(), result.end());
    return result;
  }
};

double largest_distance(const Complexes& p, const Complexes& q)
{
  BOOST_REQUIRE(p.size() == q.size());
  double result = 0;
  for(std::size_t i = 0; i < p.size(); ++i)
    result = (std::max)(result, std::abs(p[i] - q[i]));
  return result;
}

double shortest_chord(const Maps& m)
{
  double result = HUGE_VAL;
  for(Edge e : edges(m.sm))
    result = (std::min)(result, std::abs(m[m.sm.vertex(e, 0)] - m[m.sm.vertex(e, 1)]));
  return result;
}

bool is_positive(const Point_2& p, const Point_2& q, const Point_2& r)
{
  const auto exact = [](const Point_2& x) { return Exact_predicates::Point_2(x.x(), x.y()); };
  return CGAL::orientation(exact(p), exact(q), exact(r)) == CGAL::POSITIVE;
}

bool is_positive(const Maps& m, Face f)
{
  const Halfedge h = halfedge(f, m.sm);
  return is_positive(m.in_disk[source(h, m.sm)], m.in_disk[target(h, m.sm)], m.in_disk[target(next(h, m.sm), m.sm)]);
}

long double norm(const Point_2& p) { return std::sqrt((long double)(p.x()) * p.x() + (long double)(p.y()) * p.y()); }

// Multiplies z = e^{i phi} r by the inverse of its direction.
Complex turned(const Complex& z, const Complex& direction) { return z * std::conj(direction) / std::abs(direction); }

// --- what holds for every result ----------------------------------------------------------------

// All border vertices lie on the circle, in the order of the border, and the others inside.
void check_border(const Maps& m)
{
  const std::vector<Vertex> border = m.border();
  double sum = 0;
  for(std::size_t i = 0; i < border.size(); ++i)
  {
    BOOST_TEST(std::abs(norm(m.in_disk[border[i]]) - 1) <= rounded_place);
    const double angle = std::arg(turned(m[border[(i + 1) % border.size()]], m[border[i]]));
    sum += angle < 0 ? angle + 2 * pi : angle;
  }
  BOOST_TEST(std::abs(sum - 2 * pi) <= sum_of_angles(border.size()));
  for(Vertex v : vertices(m.sm))
    if(!m.sm.is_isolated(v) && !m.sm.is_border(v))
      BOOST_TEST(norm(m.in_disk[v]) < 1);
}

// The sum over the vertices of the double, on the sphere: that of the image of a vertex inside has the same x and z.
double distance_of_barycentre(const Maps& m, const std::vector<double>& weights)
{
  std::complex<long double> sum = 0;
  double all = 0;
  for(Vertex v : vertices(m.sm))
    if(!m.sm.is_isolated(v))
    {
      sum += std::complex<long double>(weights[v] * (2 / (1 + std::norm(m[v]))) * m[v]);
      all += weights[v];
    }
  return double(std::abs(sum)) / all;
}

std::vector<double> weights_of_vertices(const Mesh& sm)
{
  std::vector<double> result;
  for(Vertex v : vertices(sm))
    result.push_back(sm.is_border(v) ? .5 : 1);
  return result;
}

// Rounding moves every point by sqrt(2) 2^-54 at most, and so changes each of four lengths, relatively, by
// sqrt(2) 2^-53 divided by it; the lengths of the mesh are rounded, too.
double tolerance_of_lengths(const Maps& m) { return unit_roundoff * (16 / shortest_chord(m) + 64); }

void check_conformality(const Maps& m, const CE::Intrinsic_triangulation<>& surface)
{
  const double tolerance = tolerance_of_lengths(m);
  BOOST_TEST(tolerance <= 1e-9); // no chord is so short that the test would say nothing
  check_scaling(m, surface, [&](Vertex i, Vertex j) { return std::abs(m[i] - m[j]); }, tolerance);
}

void check_conformality(const Maps& m) { check_conformality(m, CE::import_mesh(m.sm).triangulation); }

void check_triangles(const Maps& m)
{
  for(Face f : faces(m.sm))
    BOOST_TEST(is_positive(m, f));
}

// A result on the triangulation given.
void check_disk(const Maps& m, const Report& report)
{
  BOOST_REQUIRE(bool(report));
  BOOST_TEST((report.rounded_faces.empty() && report.bent_faces.empty() && report.lost_border_edges.empty()));
  BOOST_TEST(report.statistics.number_of_flips == 0u);
  BOOST_TEST(!report.statistics.is_doubled);
  check_border(m);
  check_triangles(m);
  check_conformality(m);
}

// In the default frame.
void check_frame(const Maps& m)
{
  BOOST_TEST(distance_of_barycentre(m, weights_of_vertices(m.sm)) <= centred);
  for(Vertex v : vertices(m.sm))
    if(m.sm.is_border(v) && !m.sm.is_isolated(v))
    {
      BOOST_TEST(std::abs(m[v] - 1.) <= rounded_place);
      return;
    }
}

// --- the overlay --------------------------------------------------------------------------------

// Triangles, positive, of Euler number 1, with one point for each vertex, and no overlap: the areas sum up to what the border surrounds.
void check_parts(const Refinement& parts)
{
  std::map<std::pair<Index, Index>, int> sides;
  std::map<Index, std::array<double, 2> > point;
  long double area = 0, around = 0;
  for(Index f = 0; f < parts.number_of_faces(); ++f)
  {
    const std::size_t c = parts.first_corner[f];
    BOOST_REQUIRE(parts.first_corner[f + 1] == c + 3);
    std::array<Point_2, 3> p;
    for(std::size_t k = 0; k < 3; ++k)
    {
      const std::array<double, 2> uv = parts.corner_uv[c + k];
      BOOST_TEST((point.emplace(parts.corner_vertex[c + k], uv).first->second == uv));
      p[k] = Point_2(uv[0], uv[1]);
      BOOST_TEST(norm(p[k]) - 1 <= rounded_place);
      ++sides[std::make_pair(parts.corner_vertex[c + k], parts.corner_vertex[c + (k + 1) % 3])];
    }
    BOOST_TEST(is_positive(p[0], p[1], p[2]));
    area += CGAL::area(p[0], p[1], p[2]);
  }
  BOOST_TEST(parts.is_positive());
  std::size_t inner = 0, border = 0;
  for(const auto& side : sides)
  {
    BOOST_TEST(side.second == 1);
    if(sides.count(std::make_pair(side.first.second, side.first.first)) != 0)
      ++inner;
    else
    {
      const auto p = point.at(side.first.first), q = point.at(side.first.second);
      around += (p[0] * q[1] - p[1] * q[0]) / 2;
      ++border;
    }
  }
  BOOST_TEST(double(std::abs(area - around)) <= 8 * unit_roundoff * double(parts.number_of_faces())); // determinants of numbers up to 1
  BOOST_TEST(point.size() + parts.number_of_faces() == inner / 2 + border + 1);
}

// Border edges that were lost are the broken ones: all of their crossings lie inside of the circle. The others are straight.
void check_border_edges(const Maps& m, const Report& report, const Refinement& parts, const CE::Intrinsic_triangulation<>& input)
{
  std::set<std::pair<Index, Index> > lost, broken;
  for(Edge e : report.lost_border_edges)
  {
    BOOST_TEST(m.sm.is_border(e));
    lost.insert(std::minmax(Index(m.sm.vertex(e, 0)), Index(m.sm.vertex(e, 1))));
  }
  BOOST_TEST(lost.size() == report.lost_border_edges.size());
  for(const auto& x : parts.crossings)
    if(input.is_border(input.edge_halfedge(x.input_edge)))
      broken.insert(std::minmax(input.origin(input.edge_halfedge(x.input_edge)), input.target(input.edge_halfedge(x.input_edge))));
  BOOST_TEST((lost == broken));
}

// The polyhedron: the double of the surface, on the sphere, is the convex hull of its vertices, and its edges are scaled from the lengths that
// Ptolemy's theorem gives.
template <typename Mapping>
void check_polyhedron(const Mapping& mapping)
{
  typedef std::array<double, 3> Place;
  const auto& t = mapping.polyhedron.triangulation;
  CEi::Surface_double<double> twofold(mapping.mesh.triangulation);
  auto lengths = twofold.triangulation;
  std::vector<double> error(lengths.number_of_edges(), 0);
  for(Index e : mapping.polyhedron.flips)
    flip_with_error(lengths, error, e);
  std::vector<Place> place;
  for(const auto& v : mapping.polyhedron.vectors)
  {
    const double w = static_cast<double>(v[3]);
    place.push_back({{static_cast<double>(v[0]) / w, static_cast<double>(v[1]) / w, static_cast<double>(v[2]) / w}});
  }
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    const Index h = t.edge_halfedge(e), i = t.origin(h), j = t.target(h), k = t.apex(h), l = t.apex(t.twin(h));
    const double square = -2 * static_cast<double>(CEi::lorentz_product(mapping.polyhedron.vectors[i], mapping.polyhedron.vectors[j]));
    const double rounded_u = 16 * unit_roundoff; // of the link, where |u| < 8
    BOOST_TEST(std::abs(square / (lengths.length(e) * lengths.length(e)) - 1) <= 2 * error[e] + rounded_u);
    std::array<Place, 3> edge = {{place[j], place[k], place[l]}};
    std::array<double, 3> size;
    for(std::size_t n = 0; n < 3; ++n)
    {
      for(std::size_t x = 0; x < 3; ++x)
        edge[n][x] -= place[i][x];
      size[n] = std::sqrt(edge[n][0] * edge[n][0] + edge[n][1] * edge[n][1] + edge[n][2] * edge[n][2]);
    }
    // each edge is off by two places of three roundings a coordinate, and multiplied by the other two
    BOOST_TEST(determinant(edge[0], edge[1], edge[2]) <= 16 * unit_roundoff * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]));
  }
}

// --- surfaces -----------------------------------------------------------------------------------

Soup bumpy_disk(Index n) { return rings(n, [](double x, double y) { return .4 * std::sin(2 * x + 1) * std::cos(3 * y) + .2 * x * y; }); }

// Its mirror image with respect to x is the same.
Soup symmetric_disk(Index n) { return symmetric_grid(n, [](double x, double y) { return x * (1 - x) * (1 + y) + .3 * y * y; }); }

// A sphere without its first triangle: two borders are far from each other on the way around, on the surface.
Soup sphere_without_a_triangle(int levels)
{
  Soup soup = icosphere(levels);
  soup.triangles.erase(soup.triangles.begin());
  return soup;
}

// Thin triangles that need flips, without those around one vertex.
Soup thorns(unsigned seed)
{
  const Soup soup = needles(seed);
  Soup result;
  std::map<Index, Index> number; // without the vertex
  for(std::array<Index, 3> t : soup.triangles)
  {
    if(t[0] == 0 || t[1] == 0 || t[2] == 0)
      continue;
    for(Index& v : t)
    {
      const auto found = number.emplace(v, Index(result.points.size()));
      if(found.second)
        result.points.push_back(soup.points[v]);
      v = found.first->second;
    }
    result.triangles.push_back(t);
  }
  return result;
}

// Points of the disk, every third one on the circle, the others away from it, and their Delaunay triangulation.
Soup triangulated_disk(std::size_t n, unsigned seed)
{
  typedef CGAL::Triangulation_vertex_base_with_info_2<Index, Exact_predicates>                                Vertex_base;
  typedef CGAL::Delaunay_triangulation_2<Exact_predicates, CGAL::Triangulation_data_structure_2<Vertex_base> > Delaunay;
  Random random(seed);
  Soup soup;
  Delaunay delaunay;
  for(Index i = 0; i < n; ++i)
  {
    const double angle = i % 3 == 0 ? 2 * pi * (i + random(0, 1)) / double(n) : random(0, 2 * pi), r = i % 3 == 0 ? 1 : .7 * std::sqrt(random(0, 1));
    soup.points.push_back({{r * std::cos(angle), r * std::sin(angle), 0}});
    delaunay.insert(Exact_predicates::Point_2(soup.points[i][0], soup.points[i][1]))->info() = i;
  }
  for(auto f = delaunay.finite_faces_begin(); f != delaunay.finite_faces_end(); ++f)
  {
    const std::array<Index, 3> corner = {{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()}};
    soup.triangles.push_back(corner);
  }
  return soup;
}

// The Moebius transformation that takes a, b, c to 1, e^{2 pi i / 3}, e^{4 pi i / 3}, of z.
Complex to_three_points(const Complex& z, const Complex& a, const Complex& b, const Complex& c)
{
  const Complex p = 1, q(-.5, std::sqrt(.75)), r = std::conj(q);
  // (z, a; b, c) = (w, p; q, r)
  const Complex ratio = (z - b) * (a - c) / ((z - c) * (a - b)), k = ratio * (p - q) / (p - r); // (w - q) / (w - r) = k
  return (q - k * r) / (1. - k);
}

// Its error, where all points are rounded. The derivative by each of them is at most a few times the inverse of the shortest chord between a, b, c.
double to_three_points_error(const Complex& a, const Complex& b, const Complex& c)
{
  return 64 * unit_roundoff / (std::min)({std::abs(a - b), std::abs(b - c), std::abs(c - a)});
}

} // namespace

// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_SUITE(on_the_triangulation_given)

BOOST_AUTO_TEST_CASE(generated)
{
  std::vector<Soup> soups = { cone(3, .3), cone(7, 2), rings(3, [](double, double) { return 0.; }), bumpy_disk(2), bumpy_disk(6),
                              triangulated_disk(60, 1) };
  for(const Soup& soup : soups)
    for(const Retriangulation r : { Retriangulation::NEVER, Retriangulation::WHEN_NEEDED })
    {
      Maps m(soup);
      const Report report = m.map(r);
      check_disk(m, report);
      check_frame(m);
    }
}

BOOST_AUTO_TEST_CASE(conformally_equivalent_metrics)
{
  const Mesh mesh = surface_mesh<Mesh>(bumpy_disk(5));
  Maps m(mesh), n(mesh);
  check_disk(m, m.map());
  const auto lengths = n.sm.add_property_map<Edge, double>("e:lengths", 0).first;
  Random random(5);
  std::vector<double> u;
  for(std::size_t v = 0; v < num_vertices(mesh); ++v)
    u.push_back(random(-.5, .5));
  for(Edge e : edges(mesh))
    lengths[e] = std::exp((u[mesh.vertex(e, 0)] + u[mesh.vertex(e, 1)]) / 2)
               * std::sqrt(CGAL::squared_distance(mesh.point(mesh.vertex(e, 0)), mesh.point(mesh.vertex(e, 1))));
  BOOST_REQUIRE(bool(n.map(params::edge_length_map(lengths).retriangulation(Retriangulation::NEVER))));
  BOOST_TEST(largest_distance(n.points(), m.points()) <= centred_place);
  for(Vertex v : vertices(mesh))
    BOOST_TEST(std::abs(n.u[v] + u[v] - m.u[v]) <= centred_place);
}

BOOST_AUTO_TEST_CASE(the_vertex_at_infinity_does_not_matter)
{
  const Mesh mesh = surface_mesh<Mesh>(bumpy_disk(4));
  Maps m(mesh);
  BOOST_REQUIRE(bool(m.map(Retriangulation::NEVER)));
  for(Vertex v : border_vertices(mesh))
  {
    Maps n(mesh);
    const Report report = n.map(params::vertex_at_infinity(v).retriangulation(Retriangulation::NEVER));
    check_disk(n, report);
    BOOST_TEST(largest_distance(n.points(), m.points()) <= centred_place);
  }
}

BOOST_AUTO_TEST_CASE(isolated_vertices)
{
  const Soup soup = bumpy_disk(3);
  Maps m(soup), n(together({soup, Soup()}, true));
  BOOST_REQUIRE(bool(m.map()));
  for(const Retriangulation r : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
  {
    const Report report = n.map(r);
    BOOST_REQUIRE(bool(report));
    BOOST_TEST(report.topology.number_of_isolated_vertices == 2u);
    Complexes p = n.points();
    BOOST_TEST((n.is_untouched(Vertex(0)) && n.is_untouched(Vertex(Index(p.size() - 1)))));
    p.erase(p.begin());
    p.pop_back();
    if(r == Retriangulation::WHEN_NEEDED)
      BOOST_TEST(largest_distance(p, m.points()) <= centred_place);
    check_border(n);
  }
}

BOOST_AUTO_TEST_CASE(a_polyhedron_with_exact_points)
{
  typedef CGAL::Exact_predicates_exact_constructions_kernel Exact_kernel;
  typedef CGAL::Polyhedron_3<Exact_kernel> Polyhedron;
  typedef boost::graph_traits<Polyhedron>::vertex_descriptor Polyhedron_vertex;
  const Soup soup = bumpy_disk(3);
  Maps m(soup);
  BOOST_REQUIRE(bool(m.map()));
  Polyhedron polyhedron;
  CGAL::copy_face_graph(m.sm, polyhedron);
  std::map<Polyhedron_vertex, Exact_kernel::Point_2> images;
  const boost::associative_property_map<std::map<Polyhedron_vertex, Exact_kernel::Point_2> > in_disk(images);
  const CE::Flattening_report<Polyhedron> report = CE::map_to_disk(polyhedron, in_disk);
  BOOST_REQUIRE(bool(report));
  BOOST_REQUIRE(images.size() == num_vertices(m.sm));
  std::map<std::array<double, 3>, Complex> expected; // by point of the surface
  for(Vertex v : vertices(m.sm))
    expected[{{m.sm.point(v).x(), m.sm.point(v).y(), m.sm.point(v).z()}}] = m[v];
  Complex turn = 0; // the first border vertex may be another one
  for(const auto& image : images)
  {
    const auto& p = image.first->point();
    const Complex here(CGAL::to_double(image.second.x()), CGAL::to_double(image.second.y()));
    const Complex there = expected.at({{CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())}});
    if(turn == 0. && std::abs(here) > .5)
      turn = here / there;
  }
  for(const auto& image : images)
  {
    const auto& p = image.first->point();
    const Complex here(CGAL::to_double(image.second.x()), CGAL::to_double(image.second.y()));
    BOOST_TEST(std::abs(here - turn * expected.at({{CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())}})) <= centred_place);
  }
}

BOOST_AUTO_TEST_CASE(more_digits)
{
  typedef CE::Multiprecision_number Number;
  typedef std::array<Number, 2> Wide_point;
  const CE::Working_precision precision(128);
  struct Place // what map_to_disk() makes a point of
  {
    Wide_point p;
    Place() = default;
    Place(const Number& x, const Number& y) : p{{x, y}} {}
  };
  Maps m(bumpy_disk(2));
  BOOST_REQUIRE(bool(m.map()));
  std::map<Vertex, Place> places;
  const boost::associative_property_map<std::map<Vertex, Place> > in_disk(places);
  BOOST_REQUIRE(bool(CE::map_to_disk<Number>(m.sm, in_disk)));
  for(Vertex v : vertices(m.sm))
  {
    const Wide_point& p = places.at(v).p;
    BOOST_TEST(std::abs(Complex(static_cast<double>(p[0]), static_cast<double>(p[1])) - m[v]) <= centred_place);
    if(m.sm.is_border(v))
      BOOST_TEST(std::abs(static_cast<double>(Number(p[0] * p[0] + p[1] * p[1] - 1))) <= std::ldexp(1., -120)); // of 128 bits
  }
}

BOOST_AUTO_TEST_SUITE_END()

// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_SUITE(frames)

namespace {

// The distance of the vertex that is to be in the centre from there, with which the search for the transformation is content after some rounds.
constexpr double in_the_centre = 1e-14;

} // namespace

BOOST_AUTO_TEST_CASE(a_vertex_in_the_centre)
{
  for(const Retriangulation r : { Retriangulation::NEVER, Retriangulation::ALWAYS })
    for(const Index v : { 0u, 3u, 20u, 36u })
    {
      Maps m(bumpy_disk(4));
      const Report report = m.map(params::disk_frame(Centred_frame{Vertex(v)}).retriangulation(r));
      BOOST_REQUIRE(bool(report));
      BOOST_TEST(std::abs(m[Vertex(v)]) <= in_the_centre);
      BOOST_TEST(std::abs(m[Vertex(37)] - 1.) <= rounded_place); // the first one of the border
      check_border(m);
      if(r == Retriangulation::NEVER)
        check_disk(m, report);
    }
}

// Where crowds of vertices are far away from it.
BOOST_AUTO_TEST_CASE(a_vertex_near_the_border_in_the_centre)
{
  for(const double height : { 1., 4., 8. })
  {
    Maps m(rings(6, [=](double x, double y) { return height * std::exp(-4 * (x * x + y * y)); }));
    for(const Index v : { 0u, 61u, 75u })
    {
      const Report report = m.map(params::disk_frame(Centred_frame{Vertex(v)}));
      check_disk(m, report);
      BOOST_TEST(std::abs(m[Vertex(v)]) <= in_the_centre);
    }
  }
}

BOOST_AUTO_TEST_CASE(three_points)
{
  const Mesh mesh = surface_mesh<Mesh>(bumpy_disk(3));
  const Complex third(-.5, std::sqrt(.75));
  Maps m(mesh);
  BOOST_REQUIRE(bool(m.map()));
  const std::vector<Vertex> border = m.border();
  for(const auto& at : { std::array<std::size_t, 3>{{0, 6, 12}}, std::array<std::size_t, 3>{{4, 5, 6}}, std::array<std::size_t, 3>{{10, 17, 2}} })
    for(const Retriangulation r : { Retriangulation::NEVER, Retriangulation::ALWAYS })
    {
      const Three_point_frame frame = {{{border[at[0]], border[at[1]], border[at[2]]}}};
      Maps n(mesh);
      const Report report = n.map(params::disk_frame(frame).retriangulation(r));
      BOOST_REQUIRE(bool(report));
      check_border(n);
      const std::array<Complex, 3> places = {{ 1, third, std::conj(third) }};
      for(std::size_t i = 0; i < 3; ++i)
        BOOST_TEST(std::abs(n[frame.border[i]] - places[i]) <= 2 * rounded_place); // the place expected is rounded, too
      if(r == Retriangulation::ALWAYS)
        continue;
      check_disk(n, report);
      for(Vertex v : vertices(mesh)) // it is a Moebius transformation
        BOOST_TEST(std::abs(n[v] - (v == frame.border[2] ? places[2]
          : to_three_points(m[v], m[frame.border[0]], m[frame.border[1]], m[frame.border[2]])))
            <= to_three_points_error(m[frame.border[0]], m[frame.border[1]], m[frame.border[2]]));
    }
}

BOOST_AUTO_TEST_CASE(three_points_that_cannot_be_mapped)
{
  for(const Soup& soup : { bumpy_disk(3), star(5), one_triangle({{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}) })
  {
    Maps m(soup);
    const std::vector<Vertex> b = m.border();
    for(const Three_point_frame& frame : { Three_point_frame{{{b[1], b[0], b[2]}}}, Three_point_frame{{{b[0], b[0], b[2]}}},
                                           Three_point_frame{{{b[1], b[2], b[2]}}}, Three_point_frame{{{b[0], b[1], b[0]}}},
                                           Three_point_frame{{{b[1], b[1], b[1]}}} })
      for(const Retriangulation r : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
      {
        const Report report = m.map(params::disk_frame(frame).retriangulation(r));
        BOOST_TEST((report.status == Status::SINGULAR_PROBLEM));
        BOOST_TEST(m.is_untouched());
      }
  }
}

BOOST_AUTO_TEST_CASE(barycentre_of_areas)
{
  for(const Retriangulation r : { Retriangulation::NEVER, Retriangulation::ALWAYS })
  {
    Maps m(bumpy_disk(4));
    BOOST_REQUIRE(bool(m.map(params::moebius_weights(Moebius_weights::AREAS).retriangulation(r))));
    std::vector<double> areas(num_vertices(m.sm), 0);
    for(Face f : faces(m.sm))
    {
      const Halfedge h = halfedge(f, m.sm);
      const auto &p = m.sm.point(source(h, m.sm)), &q = m.sm.point(target(h, m.sm)), &r = m.sm.point(target(next(h, m.sm), m.sm));
      for(Halfedge g : halfedges_around_face(h, m.sm))
        areas[target(g, m.sm)] += std::sqrt(CGAL::squared_area(p, q, r));
    }
    BOOST_TEST(distance_of_barycentre(m, areas) <= centred);
    BOOST_TEST(distance_of_barycentre(m, weights_of_vertices(m.sm)) > 1e-4); // another one: far more than any error
    check_border(m);
  }
}

BOOST_AUTO_TEST_SUITE_END()

// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_SUITE(known_solutions)

BOOST_AUTO_TEST_CASE(regular_polygons)
{
  for(Index n = 3; n < 20; n += 4)
    for(const double height : { 0., .1, 30. })
      for(const Retriangulation r : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
      {
        Maps m(cone(n, height));
        BOOST_REQUIRE(bool(m.map(r)));
        check_border(m);
        BOOST_TEST(std::abs(m[Vertex(0)]) <= centred_place);
        for(Index i = 0; i < n; ++i)
          BOOST_TEST(std::abs(m[Vertex(1 + i)] - std::polar(1., 2 * pi * i / n)) <= centred_place);
      }
}

BOOST_AUTO_TEST_CASE(one_triangle_is_regular)
{
  for(const double size : { 1., 1e-150, 1e150 })
    for(const double flatness : { 1., 1e-3, 1e-12 })
    {
      Maps m(scaled(one_triangle({{0, 0, 0}}, {{1, 0, 0}}, {{.3, flatness, 0}}), size));
      const Report report = m.map();
      BOOST_REQUIRE(bool(report));
      check_border(m);
      check_triangles(m);
      check_conformality(m);
      for(Index i = 0; i < 3; ++i)
        BOOST_TEST(std::abs(m[Vertex(i)] - std::polar(1., 2 * pi * i / 3)) <= few_roundings);
      BOOST_TEST(report.statistics.number_of_flips == 0u);
    }
}

// Four points of the circle with their barycentre in the centre are the corners of a rectangle, which the cross ratio tells.
BOOST_AUTO_TEST_CASE(rectangles)
{
  for(const double a : { 1., 2., .01, 1e3 })
    for(const Retriangulation r : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
    {
      const Soup soup = {{{{0, 0, 0}}, {{a, 0, 0}}, {{a, 1, 0}}, {{0, 1, 0}}}, {{{0, 1, 2}}, {{0, 2, 3}}}};
      Maps m(soup);
      BOOST_REQUIRE(bool(m.map(r)));
      check_border(m);
      check_triangles(m);
      check_frame(m);
      const double half = std::atan2(1., a); // half of the angle of the side a at the centre is what is opposite to it
      // of thin rectangles, the mean of 1 - p p^T is sin^2 of the smaller one of half the angles along them, and points move by that sine only
      const double moved = 2 * centring_goal / (std::min)(std::sin(half), std::cos(half));
      BOOST_TEST(std::abs(m[Vertex(1)] - std::polar(1., pi - 2 * half)) <= moved);
      BOOST_TEST(std::abs(m[Vertex(2)] + 1.) <= moved);
      BOOST_TEST(std::abs(m[Vertex(3)] - std::polar(1., -2 * half)) <= moved);
      if(r == Retriangulation::WHEN_NEEDED)
        check_conformality(m);
    }
}

// Without inner vertices there is nothing to solve.
BOOST_AUTO_TEST_CASE(polygons)
{
  for(Index n = 4; n < 12; ++n)
    for(unsigned seed = 0; seed < 4; ++seed)
    {
      Soup soup;
      Random random(seed);
      for(Index i = 0; i < n; ++i)
        soup.points.push_back({{std::cos(2 * pi * i / n), std::sin(2 * pi * i / n), random(-1, 1)}});
      for(Index i = 0; i + 2 < n; ++i) // a zigzag
      {
        const Index a = (n - i / 2) % n, b = 1 + (i + 1) / 2;
        soup.triangles.push_back(i % 2 == 0 ? std::array<Index, 3>{{a, b, b + 1}} : std::array<Index, 3>{{a, b, a - 1 + (a == 0 ? n : 0)}});
      }
      for(const double size : { 1., 1e-100, 1e100 })
        for(const Retriangulation r : { Retriangulation::NEVER, Retriangulation::WHEN_NEEDED })
        {
          Maps m(scaled(soup, size));
          const Report report = m.map(r);
          check_disk(m, report);
          check_frame(m);
        }
    }
}

// The squares of a strip have the cross ratio -1: from each to the next, seen from one end, lengths shrink by the square of
// 1 + sqrt(2) = e^{asinh 1}.
BOOST_AUTO_TEST_CASE(long_strips)
{
  const double rate = std::asinh(1.);
  {
    Maps m(testing::strip(1000, 1));
    const Report report = m.map();
    BOOST_CHECK(report.status == CE::Status::SCALE_OUT_OF_RANGE);
    BOOST_TEST(std::abs(report.amount - 2000 * rate) <= 5); // the ends, and exponents for logarithms
  }
  typedef CE::Multiprecision_number Number;
  typedef std::array<Number, 2> Wide_point;
  struct Place
  {
    Wide_point p;
    Place() = default;
    Place(const Number& x, const Number& y) : p{{x, y}} {}
  };
  // From the middle to both ends lengths shrink by e^{-n asinh 1} = 2^-254. Seen from one end they range over the square of that: so much is lost
  // when the middle comes to the centre, and as much as neighbors are near to each other.
  const Index n = 200;
  const int bits = 800;
  const double square_error = std::ldexp(1., 3 * 254 - bits);
  const CE::Working_precision precision(bits);
  Maps m(testing::strip(n, 1));
  std::map<Vertex, Place> places;
  const boost::associative_property_map<std::map<Vertex, Place> > in_disk(places);
  const Report report = CE::map_to_disk<Number>(m.sm, in_disk);
  BOOST_TEST_CONTEXT(CE::message(report))
  BOOST_REQUIRE(bool(report)); // the verdict is exact
  // all squares keep their cross ratio
  const auto difference = [&](Index v, Index w)
  {
    const Wide_point &p = places.at(Vertex(v)).p, &q = places.at(Vertex(w)).p;
    return std::array<Number, 2>{{p[0] - q[0], p[1] - q[1]}};
  };
  for(Index i = 0; i < n; ++i)
  {
    const Index v = 2 * i;
    const auto a = difference(v, v + 2), b = difference(v + 2, v + 3), c = difference(v + 3, v + 1), d = difference(v + 1, v);
    const auto square = [](const std::array<Number, 2>& z) { return Number(z[0] * z[0] + z[1] * z[1]); };
    BOOST_TEST(std::abs(static_cast<double>(Number(square(a) * square(c) / (square(b) * square(d)) - 1))) <= square_error);
  }
}

// One point of a terrain is as far away as it may be by a slip of the pen. Some conditions that are tried on the way have no solution, and u
// falls for ever: that takes no time either.
BOOST_AUTO_TEST_CASE(a_point_far_above_the_others)
{
  const double quarter = 0.3; // heights of 16 points
  const int heights[] = {0, 3, 2, 0, 1, 1, 1, 1, 2, 3, 0, 0, 3, 1, 3, 1};
  for(const double top : {1e3, 1e6, 1366114304., 1e12})
  {
    Soup soup = testing::flat_grid(3);
    for(std::size_t v = 0; v < soup.points.size(); ++v)
      soup.points[v] = {{3 * soup.points[v][0], 3 * soup.points[v][1], quarter * heights[v % 16]}};
    soup.points[11][2] = top;
    for(const Retriangulation retriangulation : {Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS})
    {
      Maps m(soup);
      const Report report = m.map(params::retriangulation(retriangulation).number_of_iterations(20));
      BOOST_TEST_CONTEXT(top << ": " << CE::message(report))
      BOOST_TEST(bool(report)); // every triangle has its orientation, exactly
    }
  }
}

// Points of the disk, with the border on the circle, are their own image, up to a Moebius transformation.
BOOST_AUTO_TEST_CASE(disks)
{
  for(unsigned seed = 0; seed < 4; ++seed)
  {
    const Soup soup = triangulated_disk(50 + 20 * seed, seed);
    for(const Retriangulation r : { Retriangulation::NEVER, Retriangulation::ALWAYS })
    {
      Maps m(soup);
      const std::vector<Vertex> border = m.border();
      const std::size_t n = border.size();
      const Three_point_frame frame = {{{border[0], border[n / 3], border[2 * n / 3]}}};
      const auto given = [&](Vertex v) { return Complex(soup.points[v][0], soup.points[v][1]); };
      const Report report = m.map(params::disk_frame(frame).retriangulation(r));
      BOOST_REQUIRE(bool(report));
      BOOST_TEST(report.lost_border_edges.empty());
      check_border(m);
      check_triangles(m);
      const Complex a = given(frame.border[0]), b = given(frame.border[1]), c = given(frame.border[2]);
      const double error = rounded_u + to_three_points_error(a, b, c); // the points given, and so the lengths, are rounded
      for(Vertex v : vertices(m.sm))
        if(v != frame.border[2])
          BOOST_TEST(std::abs(m[v] - to_three_points(given(v), a, b, c)) <= error);
    }
  }
}

// What is symmetric remains so.
BOOST_AUTO_TEST_CASE(mirror_images)
{
  const Index n = 6;
  const Soup soup = symmetric_disk(n);
  const double rounding = 4 * unit_roundoff; // of coordinates, which are at most 1
  const auto mirrored = [&](Vertex v)
  {
    for(Index w = 0; w < soup.points.size(); ++w)
      if(std::abs(soup.points[w][0] + soup.points[v][0] - 1) <= rounding && std::abs(soup.points[w][1] - soup.points[v][1]) <= rounding)
        return Vertex(w);
    return Vertex();
  };
  for(const Retriangulation r : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
  {
    Maps m(soup);
    Refinement refinement;
    BOOST_REQUIRE(bool(m.map(params::retriangulation(r).common_refinement(std::ref(refinement)))));
    check_border(m);
    const Complex axis = m[Vertex(0)] * m[mirrored(Vertex(0))]; // the reflection is z -> axis conj(z)
    BOOST_TEST(std::abs(axis + 1.) > .1);
    for(Vertex v : vertices(m.sm))
      BOOST_TEST(std::abs(m[mirrored(v)] - axis * std::conj(m[v])) <= centred_place);
  }
}

BOOST_AUTO_TEST_SUITE_END()

// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_SUITE(with_flips)

namespace {

void check_with_flips(const Mesh& mesh, Retriangulation retriangulation, bool is_polyhedron_checked = true)
{
  Maps m(mesh);
  Refinement refinement;
  const Report report = m.map(params::retriangulation(retriangulation).common_refinement(std::ref(refinement)));
  BOOST_REQUIRE(bool(report));
  BOOST_TEST(report.statistics.is_doubled);
  BOOST_TEST(report.statistics.number_of_flips > 0u);
  BOOST_TEST(report.rounded_faces.empty());
  check_border(m);
  check_frame(m);
  const auto input = CE::import_mesh(mesh).triangulation;
  check_parts(refinement);
  check_that_parts_fill_faces(refinement, input);
  check_border_edges(m, report, refinement, input);
  const std::set<Face> bent(report.bent_faces.begin(), report.bent_faces.end());
  for(Face f : faces(m.sm))
    BOOST_TEST(is_positive(m, f) == (bent.count(f) == 0));
  if(is_polyhedron_checked && retriangulation != Retriangulation::ALWAYS)
  {
    CEi::Disk_mapping<Mesh, double> mapping(mesh);
    mapping.run(params::retriangulation(retriangulation), true, false);
    BOOST_REQUIRE(bool(mapping.report));
    check_polyhedron(mapping);
  }
}

void check_with_flips(const Soup& soup, Retriangulation retriangulation) { check_with_flips(surface_mesh<Mesh>(soup), retriangulation); }

} // namespace

// Border vertices with a single triangle cannot have the angle pi.
BOOST_AUTO_TEST_CASE(single_triangles_at_the_border)
{
  for(const Soup& soup : { star(4), star(9), hill(3, .4), hill(8, 1) })
    for(const Retriangulation r : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
      check_with_flips(soup, r);
  for(Index n = 3; n < 20; ++n) // of which all border points lie on lines, within rounding
  {
    Maps m(star(n));
    BOOST_REQUIRE(bool(m.map()));
    BOOST_TEST(std::abs(m[Vertex(0)]) <= centred_place);
    for(Index i = 0; i < n; ++i)
      BOOST_TEST(std::abs(m[Vertex(1 + n + i)] / m[Vertex(1 + i)] - std::polar(1., pi / n)) <= centred_place);
  }
}

// Many corners on one circle or line, exactly or nearly: rounding decides which triangles of such a face are those of the polyhedron.
BOOST_AUTO_TEST_CASE(bodies_with_cocircular_corners)
{
  const double noises[] = { 0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3 };
  std::size_t number = 0;
  for(const Index n : testing::cases<Index>({ 4, 8, 14, 33 }))
    for(const Named_soup& body : bodies_with_ties(n, false))
      for(const int shift : { 0, 3 })
      {
        const double noise = noises[(number + std::size_t(shift)) % 6];
        const Retriangulation r = number++ % 2 == 0 ? Retriangulation::ALWAYS : Retriangulation::WHEN_NEEDED;
        BOOST_TEST_CONTEXT(body.name << " noise " << noise << (r == Retriangulation::ALWAYS ? " always" : ""))
        {
          Soup soup = body.soup;
          add_noise(soup, noise, 1);
          Maps m(soup);
          Refinement refinement;
          const Report report = m.map(params::retriangulation(r).common_refinement(std::ref(refinement)));
          BOOST_REQUIRE(bool(report));
          BOOST_TEST(refinement.flipped_faces.empty());
        }
      }
}

// More digits are not to break what works in `double`.
BOOST_AUTO_TEST_CASE(bodies_with_more_digits)
{
  typedef CE::Multiprecision_number Number;
  const CE::Working_precision precision(200);
  struct Place // what map_to_disk() makes a point of
  {
    std::array<Number, 2> p;
    Place() = default;
    Place(const Number& x, const Number& y) : p{{x, y}} {}
  };
  for(const double noise : { 0., 1e-9 })
    for(const Named_soup& body : bodies_with_ties(6, false))
      if(body.soup.points.size() < 24)
        BOOST_TEST_CONTEXT(body.name << " noise " << noise)
        {
          Soup soup = body.soup;
          add_noise(soup, noise, 1);
          const Mesh mesh = surface_mesh<Mesh>(soup);
          std::map<Vertex, Place> places;
          const boost::associative_property_map<std::map<Vertex, Place> > in_disk(places);
          BOOST_TEST(bool(CE::map_to_disk<Number>(mesh, in_disk)));
        }
}

BOOST_AUTO_TEST_CASE(overlays)
{
  std::size_t bent = 0;
  for(unsigned seed = 0; seed < 6; ++seed)
    for(const Retriangulation r : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
    {
      const Mesh mesh = surface_mesh<Mesh>(thorns(seed));
      check_with_flips(mesh, r);
      Maps m(mesh), n(mesh); // bent faces are refused without a refinement
      Refinement refinement;
      const Report refined = m.map(params::retriangulation(r).common_refinement(std::ref(refinement))), report = n.map(r);
      BOOST_TEST(bool(report) == refined.bent_faces.empty());
      if(!bool(report))
      {
        BOOST_TEST((report.status == Status::NOT_INJECTIVE));
        BOOST_TEST((report.faces == refined.bent_faces));
        BOOST_TEST(n.is_untouched());
        ++bent;
      }
    }
  BOOST_TEST(bent > 0u);
}

// Three long border edges, each with vertices close to it.
BOOST_AUTO_TEST_CASE(lost_border_edges)
{
  const Mesh mesh = surface_mesh<Mesh>(sphere_without_a_triangle(2));
  Maps m(mesh);
  Refinement refinement;
  const Report report = m.map(params::retriangulation(Retriangulation::ALWAYS).common_refinement(std::ref(refinement)));
  BOOST_REQUIRE(bool(report));
  BOOST_TEST(report.lost_border_edges.size() == 3u);
  check_with_flips(mesh, Retriangulation::ALWAYS);
  check_with_flips(mesh, Retriangulation::WHEN_NEEDED);
}

BOOST_AUTO_TEST_CASE(the_vertex_at_infinity_does_not_matter)
{
  for(const Soup& soup : { thorns(1), hill(5, .7), star(6) })
    for(const Retriangulation r : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
    {
      const Mesh mesh = surface_mesh<Mesh>(soup);
      Maps m(mesh);
      Refinement refinement;
      BOOST_REQUIRE(bool(m.map(params::retriangulation(r).common_refinement(std::ref(refinement)))));
      for(Vertex v : border_vertices(mesh))
      {
        Maps n(mesh);
        BOOST_REQUIRE(bool(n.map(params::retriangulation(r).common_refinement(std::ref(refinement)).vertex_at_infinity(v))));
        check_border(n);
        BOOST_TEST(largest_distance(n.points(), m.points()) <= centred_place);
      }
    }
}

BOOST_AUTO_TEST_CASE(refined_meshes)
{
  for(const Soup& soup : { thorns(0), sphere_without_a_triangle(1), bumpy_disk(3) }) // the last one needs no flips
  {
    Maps m(soup), n(soup);
    Mesh refined;
    const auto uv = refined.add_property_map<Halfedge, Point_2>("h:uv", Point_2(unwritten, unwritten)).first;
    Refinement refinement;
    const Report report = CE::map_to_disk_refined(m.sm, refined, uv, params::log_scale_factor_map(m.u).common_refinement(std::ref(refinement)));
    BOOST_REQUIRE(bool(report));
    BOOST_TEST(CGAL::is_valid_polygon_mesh(refined));
    BOOST_TEST(CGAL::is_triangle_mesh(refined));
    BOOST_TEST(num_vertices(refined) + num_faces(refined) == num_edges(refined) + 1);
    BOOST_TEST((num_vertices(refined) > num_vertices(m.sm)) == (report.statistics.number_of_flips > 0));
    BOOST_TEST(num_vertices(refined) == refinement.number_of_vertices());
    check_parts(refinement);
    Refinement other;
    BOOST_REQUIRE(bool(n.map(params::common_refinement(std::ref(other)).log_scale_factor_map(n.u))));
    for(Vertex v : vertices(m.sm))
      BOOST_TEST(m.u[v] == n.u[v]);
    for(Halfedge h : halfedges(refined))
    {
      const Vertex v = target(h, refined);
      if(std::size_t(v) < num_vertices(m.sm))
      {
        BOOST_TEST((refined.point(v) == m.sm.point(v)));
        if(!is_border(h, refined))
          BOOST_TEST((uv[h] == n.in_disk[v]));
      }
      if(!is_border(h, refined))
        BOOST_TEST(is_positive(uv[prev(h, refined)], uv[h], uv[next(h, refined)]));
    }
    if(report.statistics.number_of_flips == 0)
      BOOST_TEST((other.number_of_faces() == 0 && num_faces(refined) == num_faces(m.sm)));
  }
}

BOOST_AUTO_TEST_CASE(mannequin_devil, * needs_mesh("mannequin-devil.off"))
{
  check_with_flips(read_mesh("mannequin-devil.off"), Retriangulation::WHEN_NEEDED, false);
}

BOOST_AUTO_TEST_CASE(cylinder_locally_refined, * needs_mesh("cylinder_locally_refined.off"))
{
  check_with_flips(read_mesh("cylinder_locally_refined.off"), Retriangulation::ALWAYS, false);
}

BOOST_AUTO_TEST_SUITE_END()

// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_SUITE(refusals)

namespace {

Report check_refusal(const Mesh& mesh, Status status, Retriangulation retriangulation = Retriangulation::WHEN_NEEDED)
{
  Maps m(mesh);
  Refinement refinement;
  refinement.number_of_input_vertices = 77;
  const Report report = m.map(params::retriangulation(retriangulation).common_refinement(std::ref(refinement)));
  BOOST_TEST((report.status == status));
  BOOST_TEST(m.is_untouched());
  BOOST_TEST(refinement.number_of_input_vertices == 77u);
  Mesh refined;
  const auto uv = refined.add_property_map<Halfedge, Point_2>("h:uv").first;
  BOOST_TEST((CE::map_to_disk_refined(mesh, refined, uv, params::retriangulation(retriangulation)).status == status));
  BOOST_TEST(num_vertices(refined) == 0u);
  return report;
}

Report check_refusal(const Soup& soup, Status status, Retriangulation retriangulation = Retriangulation::WHEN_NEEDED)
{
  return check_refusal(surface_mesh<Mesh>(soup), status, retriangulation);
}

} // namespace

BOOST_AUTO_TEST_CASE(topology)
{
  Report report = check_refusal(icosahedron(), Status::WRONG_TOPOLOGY);
  BOOST_TEST((report.topology.number_of_borders == 0 && report.topology.genus == 0));
  report = check_refusal(torus(6, 5), Status::WRONG_TOPOLOGY);
  BOOST_TEST(report.topology.genus == 1);
  report = check_refusal(annulus(6, 3), Status::WRONG_TOPOLOGY);
  BOOST_TEST((report.topology.number_of_borders == 2 && report.topology.number_of_components == 1));
  report = check_refusal(together({hill(3, .4), cone(5, 1)}), Status::WRONG_TOPOLOGY);
  BOOST_TEST((report.topology.number_of_components == 2 && report.topology.number_of_borders == 2));
  Soup punctured = torus(6, 5);
  punctured.triangles.pop_back();
  report = check_refusal(punctured, Status::WRONG_TOPOLOGY);
  BOOST_TEST((report.topology.genus == 1 && report.topology.number_of_borders == 1));
}

BOOST_AUTO_TEST_CASE(what_is_no_surface)
{
  for(const Soup& soup : { Soup(), Soup{{{{0, 0, 0}}}, {}} })
    BOOST_TEST(!bool(check_refusal(soup, Status::EMPTY_MESH)));
  Mesh square = surface_mesh<Mesh>(cone(6, 1));
  CGAL::Euler::join_face(halfedge(Vertex(0), square), square);
  BOOST_TEST(check_refusal(square, Status::NOT_TRIANGULATED).faces.size() == 1u);
}

BOOST_AUTO_TEST_CASE(numbers)
{
  for(const double bad : { std::numeric_limits<double>::quiet_NaN(), HUGE_VAL })
    for(Soup soup : { bumpy_disk(2), one_triangle({{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}) })
    {
      soup.points[2][1] = bad;
      const Report report = check_refusal(soup, Status::INVALID_NUMBER);
      BOOST_REQUIRE(report.vertices.size() == 1u);
      BOOST_TEST(report.vertices[0] == Vertex(2));
    }
  for(Soup soup : { bumpy_disk(2), one_triangle({{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}) })
  {
    soup.points[1] = soup.points[2];
    const Report report = check_refusal(soup, Status::ZERO_LENGTH_EDGE);
    BOOST_REQUIRE(report.edge_indices.size() == 1u);
    BOOST_TEST(report.edge_indices[0][0] + report.edge_indices[0][1] == 3u);
  }
}

BOOST_AUTO_TEST_CASE(without_flips)
{
  BOOST_TEST(!bool(check_refusal(star(6), Status::SINGULAR_PROBLEM, Retriangulation::NEVER)));
  const Report report = check_refusal(hill(6, .5), Status::ANGLE_OUT_OF_RANGE, Retriangulation::NEVER); // two vertices with one triangle
  BOOST_TEST((report.vertices == std::vector<Vertex>{Vertex(6), Vertex(42)}));
}

// A side longer than the other two: there is no intrinsic Delaunay triangulation of the lengths, but there is a conformal class.
BOOST_AUTO_TEST_CASE(lengths_that_are_no_metric)
{
  const Mesh mesh = surface_mesh<Mesh>(bumpy_disk(2));
  Maps m(mesh);
  const auto lengths = m.sm.add_property_map<Edge, double>("e:lengths", 1).first;
  lengths[*edges(m.sm).begin()] = 5;
  const Report report = m.map(params::edge_length_map(lengths).retriangulation(Retriangulation::ALWAYS));
  BOOST_TEST((report.status == Status::DEGENERATE_METRIC));
  BOOST_TEST(!report.faces.empty());
  BOOST_TEST(report.faces.size() <= 2u); // those of the edge, not their images on the double
  BOOST_TEST(m.is_untouched());
  Refinement refinement;
  BOOST_REQUIRE(bool(m.map(params::edge_length_map(lengths).common_refinement(std::ref(refinement)))));
  check_border(m);
}

BOOST_AUTO_TEST_SUITE_END()
