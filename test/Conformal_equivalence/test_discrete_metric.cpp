// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What lengths alone tell of a surface, the import of meshes, and lengths that are made a metric.

#define BOOST_TEST_MODULE test_discrete_metric
#include "include/boost_test.h"
#include "include/test_meshes.h"
#include "include/tolerances.h"

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/discrete_metric.h>
#include <CGAL/Conformal_equivalence/edge_lengths.h>
#include <CGAL/Conformal_equivalence/mollify.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/Face_filtered_graph.h>
#include <CGAL/boost/graph/Seam_mesh.h>

#include <boost/range/iterator_range.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;
typedef CE::Intrinsic_triangulation<> Triangulation;
using CE::Status;
using testing::Index;

namespace {

const double eps = std::numeric_limits<double>::epsilon();
const double infinity = std::numeric_limits<double>::infinity();
const double nan = std::numeric_limits<double>::quiet_NaN();

// Relative, of cross ratios and sums of some hundred products of lengths, each of which is rounded some times.
const double rounded_ratio = 100 * testing::few_roundings;
const Index null_index = Triangulation::null_index;

Triangulation triangle(double a, double b, double c)
{
  Triangulation t(3, {0, 1, 2}, {null_index, null_index, null_index});
  t.set_length(0, a);
  t.set_length(1, b);
  t.set_length(2, c);
  return t;
}

// Everything that the constructor promises.
void check_invariants(const Triangulation& t)
{
  std::vector<Index> corners(t.number_of_vertices(), 0), sides(t.number_of_edges(), 0);
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    BOOST_REQUIRE_EQUAL(t.next(t.next(t.next(h))), h);
    BOOST_REQUIRE_EQUAL(t.previous(t.next(h)), h);
    BOOST_REQUIRE_EQUAL(t.face(t.next(h)), t.face(h));
    BOOST_REQUIRE_EQUAL(t.target(h), t.origin(t.next(h)));
    BOOST_REQUIRE_EQUAL(t.apex(h), t.target(t.next(h)));
    ++corners[t.origin(h)];
    ++sides[t.edge(h)];
    BOOST_REQUIRE_LE(t.edge_halfedge(t.edge(h)), h);
    if(t.is_border(h))
    {
      BOOST_REQUIRE(t.is_border_edge(t.edge(h)));
      BOOST_REQUIRE_EQUAL(t.vertex_halfedge(t.origin(h)), h);
      BOOST_REQUIRE(t.is_border(t.next_on_border(h)));
      BOOST_REQUIRE_EQUAL(t.origin(t.next_on_border(h)), t.target(h));
      continue;
    }
    BOOST_REQUIRE_NE(t.twin(h), h);
    BOOST_REQUIRE_EQUAL(t.twin(t.twin(h)), h);
    BOOST_REQUIRE_EQUAL(t.edge(t.twin(h)), t.edge(h));
    BOOST_REQUIRE_EQUAL(t.origin(t.twin(h)), t.target(h));
    BOOST_REQUIRE(!t.is_border_edge(t.edge(h)));
  }
  for(Index e = 0; e < t.number_of_edges(); ++e)
    BOOST_REQUIRE_EQUAL(sides[e], t.is_border_edge(e) ? 1 : 2);
  for(Index v = 0; v < t.number_of_vertices(); ++v)
  {
    BOOST_REQUIRE_EQUAL(t.degree(v), corners[v]);
    BOOST_REQUIRE_EQUAL(t.is_isolated_vertex(v), corners[v] == 0);
    t.for_each_outgoing(v, [&](Index h) { BOOST_REQUIRE_EQUAL(t.origin(h), v); });
  }
  BOOST_CHECK(CE::non_manifold_vertices(t).empty());
}

struct Expected { testing::Soup soup; std::size_t components, borders, genus; };

std::vector<Expected> surfaces()
{
  testing::Soup noisy = testing::icosphere(2);
  testing::add_noise(noisy, .05, 7);
  return {{testing::icosphere(1), 1, 0, 0}, {noisy, 1, 0, 0}, {testing::torus(5, 4), 1, 0, 1}, {testing::hill(6, .5), 1, 1, 0},
          {testing::annulus(2, 7, .4), 1, 2, 0}, {testing::one_triangle({{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}), 1, 1, 0},
          {testing::together({testing::torus(6, 5), testing::annulus(1, 3), testing::icosahedron()}, true), 3, 2, 1}};
}

// ---- angles and curvature

BOOST_AUTO_TEST_CASE(triangulations_keep_their_promises)
{
  for(const Expected& x : surfaces())
  {
    const Triangulation t = testing::triangulation(x.soup);
    check_invariants(t);
    const CE::Surface_topology topology = CE::surface_topology(t, CE::connected_components(t));
    BOOST_CHECK_EQUAL(topology.number_of_components, x.components);
    BOOST_CHECK_EQUAL(topology.number_of_borders, x.borders);
    BOOST_CHECK_EQUAL(topology.genus, x.genus);
    BOOST_CHECK_EQUAL(topology.number_of_isolated_vertices, x.components == 3 ? 3 : 0);
    BOOST_CHECK_EQUAL(topology.is_disk(), x.components == 1 && x.borders == 1 && x.genus == 0);
  }
  check_invariants(testing::one_vertex_torus(3., 4., 5.));
  check_invariants(Triangulation());
}

BOOST_AUTO_TEST_CASE(gluing_names_what_is_no_manifold)
{
  std::vector<Index> bad;
  BOOST_CHECK(CE::glue_triangles({{{0, 1, 2}}, {{0, 1, 3}}}, &bad) == std::vector<Index>(6, null_index)); // same direction
  BOOST_CHECK(bad == (std::vector<Index>{0, 3}));
  bad.clear();
  CE::glue_triangles({{{0, 1, 2}}, {{1, 0, 3}}, {{1, 0, 4}}}, &bad); // three at an edge
  BOOST_CHECK_EQUAL(bad.size(), 3);
  bad.clear();
  const std::vector<std::array<Index, 3> > bowtie = {{{0, 1, 2}}, {{0, 3, 4}}};
  const Triangulation t(5, {0, 1, 2, 0, 3, 4}, CE::glue_triangles(bowtie, &bad));
  BOOST_CHECK(bad.empty());
  BOOST_CHECK(CE::non_manifold_vertices(t) == std::vector<Index>{0});
}

BOOST_AUTO_TEST_CASE(angles_of_known_triangles)
{
  const std::vector<double> a = CE::angles(triangle(3, 4, 5)); // opposite to the sides
  BOOST_CHECK_SMALL(a[0] - std::atan2(3, 4), 2 * eps);
  BOOST_CHECK_SMALL(a[1] - std::atan2(4, 3), 2 * eps);
  BOOST_CHECK_SMALL(a[2] - CGAL_PI / 2, 2 * eps);
  const std::vector<double> sums = CE::angle_sums(triangle(3, 4, 5)); // side 0 runs from vertex 0 to 1
  BOOST_CHECK_EQUAL(sums[2], a[0]);
  BOOST_CHECK_EQUAL(sums[0], a[1]);
  BOOST_CHECK_EQUAL(sums[1], a[2]);
  for(const double scale : {1e-150, 1e150})
    for(const double x : CE::angles(triangle(scale, scale, scale)))
      BOOST_CHECK_SMALL(x - CGAL_PI / 3, 2 * eps);
  BOOST_CHECK(CE::angles(triangle(1, 3, 1)) == (std::vector<double>{0, CGAL_PI, 0})); // broken
}

BOOST_AUTO_TEST_CASE(validity_is_exact)
{
  BOOST_CHECK(CE::is_valid_metric(triangle(1, 2, std::nextafter(3., 0))));
  BOOST_CHECK(!CE::is_valid_metric(triangle(1, 2, 3)));
  BOOST_CHECK(CE::is_valid_metric(triangle(.1, .2, .3)));     // as doubles, .1 + .2 > .3
  BOOST_CHECK(!CE::is_valid_metric(triangle(.1, .2, .1 + .2))); // rounded upwards
  BOOST_CHECK(CE::is_valid_metric(triangle(1e-150, 1e150, 1e150)));
  BOOST_CHECK(!CE::is_valid_metric(triangle(1e-150, 1e150, std::nextafter(1e150, infinity))));
  for(const double bad : {0., -1., nan, infinity})
    BOOST_CHECK(!CE::is_valid_metric(triangle(1, bad, 1)));

  Triangulation t = testing::triangulation(testing::flat_grid(3));
  std::vector<Index> faces;
  BOOST_CHECK(CE::is_valid_metric(t, &faces) && faces.empty());
  const Index e = t.edge(3 * 4 + 2); // a diagonal
  t.set_length(e, 10);
  const Index f = t.face(t.edge_halfedge(e)), g = t.face(t.twin(t.edge_halfedge(e)));
  BOOST_CHECK(!CE::is_valid_metric(t, &faces));
  BOOST_CHECK(faces == (std::vector<Index>{(std::min)(f, g), (std::max)(f, g)}));
}

BOOST_AUTO_TEST_CASE(curvatures_of_a_cube_and_a_square)
{
  const testing::Soup cube{{{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}, {{0, 1, 0}}, {{0, 0, 1}}, {{1, 0, 1}}, {{1, 1, 1}}, {{0, 1, 1}}},
                           {{{0, 2, 1}}, {{0, 3, 2}}, {{4, 5, 6}}, {{4, 6, 7}}, {{0, 1, 5}}, {{0, 5, 4}},
                            {{1, 2, 6}}, {{1, 6, 5}}, {{2, 3, 7}}, {{2, 7, 6}}, {{3, 0, 4}}, {{3, 4, 7}}}};
  for(const double k : CE::discrete_curvatures(testing::triangulation(cube)))
    BOOST_CHECK_SMALL(k - CGAL_PI / 2, 16 * eps);

  const Index n = 4;
  const std::vector<double> k = CE::discrete_curvatures(testing::triangulation(testing::flat_grid(n)));
  for(Index v = 0; v < k.size(); ++v)
  {
    const Index i = v % (n + 1), j = v / (n + 1);
    const bool is_corner = (i == 0 || i == n) && (j == 0 || j == n);
    BOOST_CHECK_SMALL(k[v] - (is_corner ? CGAL_PI / 2 : 0), 16 * eps);
  }
}

BOOST_AUTO_TEST_CASE(gauss_bonnet)
{
  for(const Expected& x : surfaces())
  {
    const Triangulation t = testing::triangulation(x.soup);
    BOOST_CHECK_SMALL(CE::gauss_bonnet_defect(t), 16 * eps * t.number_of_faces());
    Triangulation any = t; // also for lengths that break triangles
    const std::vector<double> u = testing::random_numbers(t.number_of_vertices(), 4, 3);
    any = CE::apply_log_scale_factors(any, u);
    BOOST_CHECK_SMALL(CE::gauss_bonnet_defect(any), 16 * eps * t.number_of_faces());
  }
}

BOOST_AUTO_TEST_CASE(torus_with_one_vertex)
{
  const Triangulation t = testing::one_vertex_torus(3., 4., 5.);
  BOOST_CHECK_EQUAL(t.degree(0), 6);
  BOOST_CHECK_EQUAL(t.number_of_edges(), 3);
  BOOST_CHECK_SMALL(CE::angle_sums(t)[0] - 2 * CGAL_PI, 8 * eps);
  BOOST_CHECK_SMALL(CE::discrete_curvatures(t)[0], 8 * eps);
  BOOST_CHECK_SMALL(CE::gauss_bonnet_defect(t), 8 * eps);
  BOOST_CHECK_CLOSE_FRACTION(CE::length_cross_ratio(t, 0), 16. / 25, 4 * eps); // (b / c) (b / c)
  BOOST_CHECK_CLOSE_FRACTION(CE::length_cross_ratio(t, 1), 25. / 9, 4 * eps);
  const Triangulation larger = CE::apply_log_scale_factors(t, {std::log(2.)});
  BOOST_CHECK_CLOSE_FRACTION(larger.length(2), 10, 4 * eps);
  BOOST_CHECK_SMALL(CE::log_scale_factors_between(t, larger).log_scale_factors[0] - std::log(2.), 4 * eps);
  BOOST_CHECK(!CE::are_conformally_equivalent(t, testing::one_vertex_torus(3., 4., 5.1)));
  BOOST_CHECK_EQUAL(CE::dirichlet_energy(t, {7.}), 0);
}

// ---- conformal equivalence

BOOST_AUTO_TEST_CASE(length_cross_ratios_of_two_triangles)
{
  // triangles (i j k) = (0 1 2) and (j i m) = (1 0 3), in both orders
  for(const bool swapped : {false, true})
  {
    const testing::Soup soup{{{{0, 0, 0}}, {{4, 0, 0}}, {{0, 3, 0}}, {{4, -3, 0}}},
                             swapped ? std::vector<std::array<Index, 3> >{{{0, 3, 1}}, {{0, 1, 2}}}
                                     : std::vector<std::array<Index, 3> >{{{0, 1, 2}}, {{0, 3, 1}}}};
    Triangulation t = testing::triangulation(soup);
    const std::vector<double> c = CE::length_cross_ratios(t);
    double im = 5, mj = 3, jk = 5, ki = 3;
    for(Index e = 0; e < 5; ++e)
      BOOST_CHECK_CLOSE_FRACTION(c[e], t.is_border_edge(e) ? 1 : im / mj * (jk / ki), 4 * eps);
    // far out of range on the way
    for(Index e = 0; e < 5; ++e)
    {
      const Index h = t.edge_halfedge(e);
      const bool at_i = t.origin(h) == 0 || t.target(h) == 0, at_k = t.origin(h) == 2 || t.target(h) == 2;
      t.set_length(e, t.is_border_edge(e) ? (at_i == at_k ? 1e150 : 7e-150) : 1);
    }
    for(Index e = 0; e < 5; ++e) // l_ki = l_mj = 1e150, l_jk = l_im = 7e-150
      if(!t.is_border_edge(e))
        BOOST_CHECK_EQUAL(CE::length_cross_ratio(t, e), 0); // 49e-600
    Triangulation scaled = t.with_lengths(std::vector<double>(t.lengths()));
    for(Index e = 0; e < 5; ++e)
      scaled.set_length(e, t.length(e) < 1 ? 14e-150 : (t.length(e) > 1 ? 2e150 : 1));
    BOOST_CHECK(CE::are_conformally_equivalent(t, scaled, testing::few_roundings));
    scaled.set_length(scaled.edge(0), 1.1e150);
    scaled.set_length(scaled.edge(2), 1.2e-150);
    BOOST_CHECK(!CE::are_conformally_equivalent(t, scaled));
  }
}

BOOST_AUTO_TEST_CASE(equivalent_metrics_are_recognized_and_others_are_not)
{
  for(const Expected& x : surfaces())
  {
    const Triangulation t = testing::triangulation(x.soup);
    const std::vector<double> u = testing::random_numbers(t.number_of_vertices(), 3, 5);
    const Triangulation scaled = CE::apply_log_scale_factors(t, u);
    BOOST_CHECK_LE(CE::largest_cross_ratio_difference(t, scaled), 40 * eps);
    BOOST_CHECK(CE::are_conformally_equivalent(t, scaled, rounded_ratio));
    const CE::Log_scale_factors<double> found = CE::log_scale_factors_between(t, scaled);
    BOOST_CHECK_LE(found.residual, 40 * eps);
    for(Index v = 0; v < u.size(); ++v)
      BOOST_CHECK_SMALL(found.log_scale_factors[v] - (t.is_isolated_vertex(v) ? 0 : u[v]), 40 * eps);

    if(x.soup.triangles.size() == 1)
      continue; // all triangles are equivalent
    Triangulation changed = scaled;
    const Index e = t.number_of_edges() / 2; // a length enters the cross ratios of its triangles' other edges
    changed.set_length(e, scaled.length(e) * (1 + 1e-7));
    BOOST_CHECK(!CE::are_conformally_equivalent(t, changed));
    BOOST_CHECK(CE::are_conformally_equivalent(t, changed, 3e-7)); // that edge is one of four of a cross ratio, or two of them
    BOOST_CHECK_GT(CE::log_scale_factors_between(t, changed).residual, 1e-9);
    changed.set_length(e, nan);
    BOOST_CHECK(!CE::are_conformally_equivalent(t, changed, 1e300));
  }
}

BOOST_AUTO_TEST_CASE(all_triangles_are_equivalent_and_different_triangulations_never)
{
  BOOST_CHECK(CE::are_conformally_equivalent(triangle(3, 4, 5), triangle(1e-150, 1e150, 1e150), 0));
  BOOST_CHECK(!CE::are_conformally_equivalent(testing::triangulation(testing::flat_grid(2)),
                                              testing::triangulation(testing::flat_grid(3))));
  BOOST_CHECK(!CE::are_conformally_equivalent(testing::triangulation(testing::cone(4, 1)),
                                              testing::triangulation(testing::cone(5, 1))));
}

BOOST_AUTO_TEST_CASE(scale_factors_of_any_size)
{
  const Triangulation t = testing::triangulation(testing::random_height_field(4, 1, 2));
  std::vector<double> tiny(t.lengths()), huge(t.lengths());
  for(double& l : tiny)
    l *= 1e-150;
  for(double& l : huge)
    l *= 1e150;
  const Triangulation t0 = t.with_lengths(tiny), t1 = t.with_lengths(huge);
  BOOST_CHECK(CE::are_conformally_equivalent(t0, t1, testing::few_roundings));
  const CE::Log_scale_factors<double> found = CE::log_scale_factors_between(t0, t1);
  BOOST_CHECK_LE(found.residual, 1000 * testing::few_roundings);
  for(const double u : found.log_scale_factors)
    BOOST_CHECK_SMALL(u - 300 * std::log(10.), 1000 * testing::few_roundings); // u is about 700
  const Triangulation back = CE::apply_log_scale_factors(t0, found.log_scale_factors);
  for(Index e = 0; e < t.number_of_edges(); ++e)
    BOOST_CHECK_CLOSE_FRACTION(back.length(e), t1.length(e), 1000 * testing::few_roundings); // exp loses the digits of u before the point
  // e^{u/2} itself out of range
  Triangulation two = triangle(1e100, 1e-100, 1e100);
  const Triangulation scaled = CE::apply_log_scale_factors(two, {1600., -1600., 1600.});
  BOOST_CHECK_CLOSE_FRACTION(scaled.length(0), 1e100, 4 * eps);
  BOOST_CHECK_EQUAL(scaled.length(2), infinity);
}

BOOST_AUTO_TEST_CASE(inversions_of_space_are_recognized)
{
  testing::Soup soup = testing::hill(12, .6), sphere = testing::icosphere(3);
  for(testing::Soup surface : {soup, sphere})
  {
    for(testing::Point& p : surface.points)
    {
      p[0] += 1.5;
      p[1] -= .3;
      p[2] += .8;
    }
    testing::Soup image = surface;
    for(testing::Point& p : image.points) // x -> x / |x|^2 changes distances by 1 / (|x| |y|)
    {
      const double square = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
      p = {{p[0] / square, p[1] / square, p[2] / square}};
    }
    for(Index i = 0; i < Index(image.triangles.size()); ++i) // it turns the surface inside out
      BOOST_REQUIRE(image.triangles[i] == surface.triangles[i]);
    const Triangulation t0 = testing::triangulation(surface), t1 = testing::triangulation(image);
    BOOST_CHECK(CE::are_conformally_equivalent(t0, t1, testing::solved_u));
    const CE::Log_scale_factors<double> found = CE::log_scale_factors_between(t0, t1);
    BOOST_CHECK_LE(found.residual, testing::solved_u);
    for(Index v = 0; v < t0.number_of_vertices(); ++v)
      BOOST_CHECK_SMALL(found.log_scale_factors[v]
                        + 2 * std::log(testing::distance<double>(surface.points[v], {{0, 0, 0}})), testing::solved_u);
    BOOST_TEST_MESSAGE("inversion: cross ratios within " << CE::largest_cross_ratio_difference(t0, t1)
                       << ", residual of u " << found.residual);

    testing::add_noise(image, 1e-7, 1);
    BOOST_CHECK(!CE::are_conformally_equivalent(t0, testing::triangulation(image)));
    // distances to the fourth power instead: no Moebius transformation
    for(std::size_t i = 0; i < image.points.size(); ++i)
      for(int k = 0; k < 3; ++k)
        image.points[i][k] = surface.points[i][k] / std::pow(testing::distance<double>(surface.points[i], {{0, 0, 0}}), 4);
    BOOST_CHECK(!CE::are_conformally_equivalent(t0, testing::triangulation(image), 1e-3));
  }
}

BOOST_AUTO_TEST_CASE(dirichlet_energy_of_linear_functions)
{
  testing::Soup soup = testing::flat_grid(7);
  testing::Random random(11);
  for(testing::Point& p : soup.points)
    if(p[0] > 0 && p[0] < 1 && p[1] > 0 && p[1] < 1)
    {
      p[0] += random(-.04, .04);
      p[1] += random(-.04, .04);
    }
  const Triangulation t = testing::triangulation(soup);
  std::vector<double> u;
  for(const testing::Point& p : soup.points)
    u.push_back(3 * p[0] - 2 * p[1] + 5);
  BOOST_CHECK_CLOSE_FRACTION(CE::dirichlet_energy(t, u), (9 + 4) / 2., rounded_ratio); // area 1
  BOOST_CHECK_SMALL(CE::dirichlet_energy(t, std::vector<double>(u.size(), 5.)), eps);
  // invariant when all lengths are scaled
  const Triangulation tiny = CE::apply_log_scale_factors(t, std::vector<double>(u.size(), -300.));
  BOOST_CHECK_CLOSE_FRACTION(CE::dirichlet_energy(tiny, u), 6.5, rounded_ratio);
}

// ---- import

template <typename TriangleMesh>
void check_correspondence(const CE::Imported_mesh<TriangleMesh>& mesh)
{
  const TriangleMesh& tm = mesh.mesh();
  const Triangulation& t = mesh.triangulation;
  BOOST_REQUIRE(mesh.status == Status::OK);
  check_invariants(t);
  Index i = 0;
  for(auto v : CGAL::make_range(vertices(tm)))
  {
    BOOST_REQUIRE(mesh.vertex(i) == v);
    BOOST_REQUIRE_EQUAL(mesh.index_of_vertex(v), i++);
  }
  BOOST_CHECK_EQUAL(t.number_of_vertices(), i);
  i = 0;
  const auto point = get(CGAL::vertex_point, tm);
  for(auto f : CGAL::make_range(faces(tm)))
  {
    BOOST_REQUIRE(mesh.face(i) == f);
    BOOST_REQUIRE_EQUAL(mesh.index_of_face(f), i);
    auto hd = halfedge(f, tm);
    for(Index h = 3 * i; h < 3 * i + 3; ++h, hd = next(hd, tm))
    {
      BOOST_REQUIRE(mesh.halfedge(h) == hd);
      BOOST_REQUIRE_EQUAL(mesh.index_of_halfedge(hd), h);
      BOOST_REQUIRE_EQUAL(t.origin(h), mesh.index_of_vertex(source(hd, tm)));
      BOOST_REQUIRE_EQUAL(t.target(h), mesh.index_of_vertex(target(hd, tm)));
      BOOST_REQUIRE_EQUAL(t.is_border(h), is_border(opposite(hd, tm), tm));
      if(!t.is_border(h))
        BOOST_REQUIRE_EQUAL(t.twin(h), mesh.index_of_halfedge(opposite(hd, tm)));
      BOOST_REQUIRE_EQUAL(mesh.index_of_edge(edge(hd, tm)), t.edge(h));
      BOOST_REQUIRE_CLOSE_FRACTION(t.halfedge_length(h), std::sqrt(CGAL::to_double(CGAL::squared_distance(
        get(point, source(hd, tm)), get(point, target(hd, tm))))), 4 * eps);
    }
    ++i;
  }
  BOOST_CHECK_EQUAL(t.number_of_faces(), i);
}

BOOST_AUTO_TEST_CASE(import_of_a_surface_mesh_with_removed_elements)
{
  Mesh mesh = testing::surface_mesh<Mesh>(testing::hill(4, .3));
  check_correspondence(CE::import_mesh(mesh));
  mesh.add_vertex({nan, 0, 0}); // isolated: nobody looks at it
  for(const int f : {13, 0, 1}) // a hole, and the corner
    CGAL::Euler::remove_face(mesh.halfedge(Mesh::Face_index(f)), mesh);
  BOOST_REQUIRE(mesh.has_garbage());
  const auto imported = CE::import_mesh(mesh);
  check_correspondence(imported);
  BOOST_CHECK_EQUAL(imported.triangulation.number_of_faces(), 29);
  BOOST_CHECK_EQUAL(imported.triangulation.number_of_vertices(), 25);
  const auto topology = CE::surface_topology(imported.triangulation, CE::connected_components(imported.triangulation));
  BOOST_CHECK_EQUAL(topology.number_of_isolated_vertices, 1);
  BOOST_CHECK_EQUAL(topology.number_of_borders, 2);
}

BOOST_AUTO_TEST_CASE(import_of_a_polyhedron)
{
  typedef CGAL::Polyhedron_3<Kernel> Polyhedron;
  Polyhedron open, closed;
  CGAL::copy_face_graph(testing::surface_mesh<Mesh>(testing::annulus(2, 6, .5)), open);
  CGAL::copy_face_graph(testing::surface_mesh<Mesh>(testing::torus(4, 5)), closed);
  check_correspondence(CE::import_mesh(open));
  check_correspondence(CE::import_mesh(closed));
  std::map<boost::graph_traits<Polyhedron>::vertex_descriptor, double> sums;
  const auto report = CE::compute_angle_sums(open, boost::make_assoc_property_map(sums));
  BOOST_CHECK(report && sums.size() == num_vertices(open) && report.topology.number_of_borders == 2);
}

BOOST_AUTO_TEST_CASE(import_of_a_seam_mesh)
{
  Mesh mesh = testing::surface_mesh<Mesh>(testing::icosphere(1));
  auto is_seam_edge = mesh.add_property_map<Mesh::Edge_index, bool>("e:seam", false).first;
  auto is_seam_vertex = mesh.add_property_map<Mesh::Vertex_index, bool>("v:seam", false).first;
  CGAL::Seam_mesh<Mesh, decltype(is_seam_edge), decltype(is_seam_vertex)> cut(mesh, is_seam_edge, is_seam_vertex);
  Mesh::Halfedge_index h = halfedge(Mesh::Vertex_index(0), mesh);
  for(int k = 0; k < 3; ++k) // three edges straight on
  {
    cut.add_seam(source(h, mesh), target(h, mesh));
    h = next(opposite(next(opposite(next(h, mesh), mesh), mesh), mesh), mesh);
  }
  const auto imported = CE::import_mesh(cut);
  check_correspondence(imported);
  BOOST_CHECK_EQUAL(imported.triangulation.number_of_faces(), num_faces(mesh));
  BOOST_CHECK_EQUAL(imported.triangulation.number_of_vertices(), num_vertices(mesh) + 2);
  BOOST_CHECK(CE::surface_topology(imported.triangulation, CE::connected_components(imported.triangulation)).is_disk());
}

BOOST_AUTO_TEST_CASE(import_of_a_patch)
{
  Mesh mesh = testing::surface_mesh<Mesh>(testing::icosphere(2));
  std::vector<Mesh::Face_index> patch;
  for(Mesh::Face_index f : faces(mesh))
  {
    const Mesh::Halfedge_index h = mesh.halfedge(f);
    if(mesh.point(source(h, mesh)).z() > .2 && mesh.point(target(h, mesh)).z() > .2
       && mesh.point(target(next(h, mesh), mesh)).z() > .2)
      patch.push_back(f);
  }
  const CGAL::Face_filtered_graph<Mesh> filtered(mesh, patch);
  const auto imported = CE::import_mesh(filtered);
  check_correspondence(imported);
  BOOST_CHECK_EQUAL(imported.triangulation.number_of_faces(), patch.size());
  BOOST_CHECK(CE::surface_topology(imported.triangulation, CE::connected_components(imported.triangulation)).is_disk());

  // the same by a range of faces; now the other vertices are there, isolated
  const CE::Imported_mesh<Mesh> part(mesh, patch);
  check_invariants(part.triangulation);
  BOOST_CHECK_EQUAL(part.triangulation.number_of_vertices(), num_vertices(mesh));
  BOOST_CHECK_EQUAL(part.triangulation.number_of_edges(), imported.triangulation.number_of_edges());
  BOOST_CHECK_EQUAL(part.index_of_edge(imported.edge(3)), 3);
}

BOOST_AUTO_TEST_CASE(import_of_lengths_alone)
{
  Mesh mesh = testing::surface_mesh<Mesh>(testing::flat_grid(3));
  for(Mesh::Vertex_index v : vertices(mesh))
    mesh.point(v) = {nan, nan, nan}; // nobody looks at points
  auto length = mesh.add_property_map<Mesh::Edge_index, float>("e:length", 1.f).first;
  Mesh::Edge_index inner(0);
  while(mesh.is_border(inner))
    inner = Mesh::Edge_index(inner + 1);
  length[inner] = 7; // may violate the inequality
  const auto imported = CE::import_mesh(mesh, params::edge_length_map(length));
  BOOST_REQUIRE(imported.status == Status::OK);
  for(Mesh::Edge_index e : edges(mesh))
    BOOST_CHECK_EQUAL(imported.triangulation.length(imported.index_of_edge(e)), length[e]);
  const auto report = CE::check_metric(mesh, params::edge_length_map(length));
  BOOST_CHECK(report.status == Status::DEGENERATE_METRIC);
  BOOST_CHECK_EQUAL(report.faces.size(), 2);
  for(Mesh::Face_index f : report.faces)
    BOOST_CHECK(f == mesh.face(mesh.halfedge(inner)) || f == mesh.face(mesh.halfedge(inner, 1)));
  const auto bare = CE::import_mesh<long double>(mesh, params::edge_length_map(length));
  BOOST_CHECK(bare.triangulation.length(0) == 1.L);
}

template <typename NamedParameters>
CE::Flattening_report<Mesh> refused(const Mesh& mesh, const NamedParameters& np)
{
  std::map<Mesh::Vertex_index, double> written;
  const auto report = CE::compute_discrete_curvatures(mesh, boost::make_assoc_property_map(written), np);
  BOOST_CHECK(!report && written.empty());
  BOOST_CHECK(!message(report).empty());
  return report;
}

BOOST_AUTO_TEST_CASE(what_cannot_be_imported_is_named)
{
  const auto points = params::default_values();
  Mesh mesh;
  BOOST_CHECK(refused(mesh, points).status == Status::EMPTY_MESH);
  mesh.add_vertex({0, 0, 0});
  BOOST_CHECK(refused(mesh, points).status == Status::EMPTY_MESH);

  mesh = testing::surface_mesh<Mesh>(testing::cone(5, 1));
  const auto p = [&](double x, double y) { return mesh.add_vertex({x, y, 0}); };
  const Mesh::Face_index quad = mesh.add_face(p(3, 0), p(4, 0), p(4, 1), p(3, 1));
  auto report = refused(mesh, points);
  BOOST_CHECK(report.status == Status::NOT_TRIANGULATED && report.faces == std::vector<Mesh::Face_index>{quad});

  mesh = Mesh();
  const Mesh::Vertex_index middle = p(0, 0);
  mesh.add_face(middle, p(1, 0), p(1, 1));
  mesh.add_face(middle, p(-1, 0), p(-1, -1));
  report = refused(mesh, points);
  BOOST_CHECK(report.status == Status::NON_MANIFOLD && report.vertices == std::vector<Mesh::Vertex_index>{middle});

  for(const double bad : {nan, infinity, -infinity})
  {
    mesh = testing::surface_mesh<Mesh>(testing::cone(5, 1));
    mesh.point(Mesh::Vertex_index(3)) = {0, bad, 0};
    report = refused(mesh, points);
    BOOST_CHECK(report.status == Status::INVALID_NUMBER && report.vertex_indices == std::vector<std::size_t>{3});
  }
  mesh = testing::surface_mesh<Mesh>(testing::cone(5, 1));
  mesh.point(Mesh::Vertex_index(3)) = mesh.point(Mesh::Vertex_index(2));
  report = refused(mesh, points);
  BOOST_CHECK(report.status == Status::ZERO_LENGTH_EDGE && report.edges.size() == 1);
  BOOST_CHECK((std::set<std::size_t>(report.edge_indices[0].begin(), report.edge_indices[0].end()) == std::set<std::size_t>{2, 3}));

  auto length = mesh.add_property_map<Mesh::Edge_index, double>("e:length", 1.).first;
  for(const double bad : {nan, infinity, -1., 0.})
  {
    length[Mesh::Edge_index(2)] = bad;
    report = refused(mesh, params::edge_length_map(length));
    BOOST_CHECK(report.status == (bad == 0 ? Status::ZERO_LENGTH_EDGE : Status::INVALID_NUMBER));
    BOOST_CHECK(report.edges == std::vector<Mesh::Edge_index>{Mesh::Edge_index(2)});
  }
}

BOOST_AUTO_TEST_CASE(points_far_out)
{
  for(const double scale : {1e-200, 1e-150, 1e150})
  {
    testing::Soup soup = testing::cone(6, 1);
    for(testing::Point& p : soup.points)
      for(double& x : p)
        x *= scale;
    const auto imported = CE::import_mesh(testing::surface_mesh<Mesh>(soup));
    BOOST_REQUIRE(imported.status == Status::OK);
    BOOST_CHECK_CLOSE_FRACTION(imported.triangulation.length(0), std::sqrt(2.) * scale, 8 * eps);
  }
}

BOOST_AUTO_TEST_CASE(functions_for_meshes)
{
  Mesh mesh = testing::surface_mesh<Mesh>(testing::hill(5, .4));
  auto l = mesh.add_property_map<Mesh::Edge_index, double>("e:l").first;
  auto scaled = mesh.add_property_map<Mesh::Edge_index, double>("e:scaled", -1.).first;
  auto c = mesh.add_property_map<Mesh::Edge_index, double>("e:c").first;
  auto u = mesh.add_property_map<Mesh::Vertex_index, double>("v:u").first;
  auto found = mesh.add_property_map<Mesh::Vertex_index, double>("v:found").first;
  auto k = mesh.add_property_map<Mesh::Vertex_index, double>("v:k").first;
  const std::vector<double> numbers = testing::random_numbers(num_vertices(mesh), 1, 4);
  for(Mesh::Vertex_index v : vertices(mesh))
    u[v] = numbers[v];
  BOOST_CHECK(bool(CE::compute_edge_lengths(mesh, l)));
  BOOST_CHECK(bool(CE::check_metric(mesh)) && bool(CE::check_metric(mesh, params::edge_length_map(l))));
  const auto imported = CE::import_mesh(mesh);
  BOOST_CHECK(bool(CE::compute_discrete_curvatures(mesh, k)));
  BOOST_CHECK_EQUAL(k[Mesh::Vertex_index(9)], CE::discrete_curvatures(imported.triangulation)[9]);
  BOOST_CHECK(bool(CE::compute_length_cross_ratios(mesh, c)));
  for(Mesh::Edge_index e : edges(mesh))
  {
    BOOST_CHECK_EQUAL(l[e], imported.triangulation.length(imported.index_of_edge(e)));
    BOOST_CHECK_EQUAL(c[e], CE::length_cross_ratios(imported.triangulation)[imported.index_of_edge(e)]);
  }
  BOOST_CHECK(bool(CE::scale_edge_lengths(mesh, u, scaled)));
  BOOST_CHECK(CE::are_conformally_equivalent(mesh, l, scaled, rounded_ratio));
  const auto report = CE::compute_log_scale_factors(mesh, l, scaled, found);
  BOOST_CHECK(report && report.amount <= testing::unmoved_u);
  for(Mesh::Vertex_index v : vertices(mesh))
    BOOST_CHECK_SMALL(found[v] - u[v], testing::unmoved_u);

  u[Mesh::Vertex_index(4)] = infinity;
  const auto refused = CE::scale_edge_lengths(mesh, u, c);
  BOOST_CHECK(refused.status == Status::INVALID_NUMBER && refused.vertex_indices == std::vector<std::size_t>{4});
  scaled[Mesh::Edge_index(7)] *= 1 + 1e-6;
  BOOST_CHECK(!CE::are_conformally_equivalent(mesh, l, scaled));
  scaled[Mesh::Edge_index(7)] = 0;
  BOOST_CHECK(!CE::are_conformally_equivalent(mesh, l, scaled));
  BOOST_CHECK(CE::compute_log_scale_factors(mesh, l, scaled, found).status == Status::ZERO_LENGTH_EDGE);
}

} // namespace

// ---- Mollified metrics: the least constant that makes triangles of all faces

BOOST_AUTO_TEST_SUITE(mollified)

namespace CEi = CGAL::Conformal_equivalence::internal;
using namespace testing;

namespace {

typedef CE::Mollified_metric<double>  Mollified;

// a + b - c - slack, exactly, of the worst corner of all triangles of component `c`
CEi::Exact_number least_slack(const Triangulation& t, const std::vector<std::uint32_t>& component, std::uint32_t c)
{
  CEi::Exact_number least(1e300);
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
    if(component[t.origin(h)] == c)
    {
      const CEi::Exact_number d = CEi::exact_number(t.halfedge_length(t.next(h))) + CEi::exact_number(t.halfedge_length(t.previous(h)))
                                  - CEi::exact_number(t.halfedge_length(h));
      least = (std::min)(least, d);
    }
  return least;
}

// Every inequality holds with its slack, exactly; not much less would do; and all lengths of a component have grown by the same.
Mollified checked(const Triangulation& t, double slack)
{
  const Mollified m = CE::mollify(t, slack);
  BOOST_TEST_REQUIRE(bool(m));
  const CE::Surface_components pieces = CE::connected_components(t);
  BOOST_TEST_REQUIRE(m.added.size() == pieces.components.size());
  std::vector<double> sum(pieces.components.size(), 0), longest(pieces.components.size(), 0);
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    const Index c = pieces.component_of_vertex[t.origin(t.edge_halfedge(e))];
    BOOST_TEST(m.triangulation.length(e) == t.length(e) + m.added[c]);
    sum[c] += t.length(e) / double(pieces.components[c].number_of_edges);
    longest[c] = (std::max)(longest[c], m.triangulation.length(e));
  }
  for(Index c = 0; c < sum.size(); ++c)
  {
    const CEi::Exact_number least = least_slack(m.triangulation, pieces.component_of_vertex, c);
    const double wanted = slack * sum[c], rounding = rounded_ratio * wanted;
    BOOST_TEST((least >= CEi::exact_number(wanted - rounding)));
    if(m.added[c] > 0)
      BOOST_TEST((least <= CEi::exact_number(wanted + rounding + 16 * eps * longest[c])));
    BOOST_TEST(m.added[c] >= 0);
  }
  if(slack > 16 * eps)
    BOOST_TEST(CE::is_valid_metric(m.triangulation));
  return m;
}

} // namespace

BOOST_AUTO_TEST_CASE(what_is_good_is_left_alone)
{
  const Triangulation t = triangulation(icosahedron());
  const Mollified m = checked(t, .5); // equilateral: the slack is 1
  BOOST_TEST(m.added.front() == 0);
  BOOST_TEST(m.triangulation.lengths() == t.lengths());
  BOOST_TEST(checked(t, 2.).added.front() > .99 * t.length(0)); // and not enough for 2
}

BOOST_AUTO_TEST_CASE(known_triangles)
{
  Triangulation t = triangulation(one_triangle({{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}));
  const auto lengths = [&](double a, double b, double c) { return t.with_lengths(std::vector<double>{a, b, c}); };
  const auto added = [&](double a, double b, double c, double slack) { return checked(lengths(a, b, c), slack).added.front(); };
  BOOST_TEST(added(3, 4, 5, 1e-3) == 0);
  BOOST_TEST(std::abs(added(1, 2, 3, .25) - .5) <= 8 * eps);         // no area: the slack
  BOOST_TEST(std::abs(added(1, 1, 4, .125) - 2.25) <= 16 * eps);     // no triangle: what is missing, and the slack
  BOOST_TEST(std::abs(added(0, 3, 3, .25) - .5) <= 8 * eps);         // coincident points
  BOOST_TEST(std::abs(added(0, 1, 3, .75) - 3) <= 16 * eps);
  BOOST_TEST(CE::mollify(lengths(0, 0, 0), .1).added.front() == 0);  // nothing to measure with
}

BOOST_AUTO_TEST_CASE(components_are_mollified_one_by_one)
{
  Soup flat = flat_grid(3);
  flat.points[5] = flat.points[6];
  Soup bad = flat_grid(4);
  for(Point& p : bad.points)
    p[1] = 0;
  const Triangulation t = triangulation(together({flat, icosahedron(), bad}, true));
  const Mollified m = checked(t, 1e-5);
  BOOST_TEST_REQUIRE(m.added.size() == 3u);
  BOOST_TEST(m.added[0] > 0);
  BOOST_TEST(m.added[1] == 0);
  BOOST_TEST(m.added[2] > 0);
  BOOST_TEST(m.added[0] != m.added[2]);
}

BOOST_AUTO_TEST_CASE(random_lengths)
{
  Random random(1);
  int more = 0, none = 0;
  for(int n = 0; n < 200; ++n)
  {
    Triangulation t = triangulation(n % 2 == 0 ? icosahedron() : hill(3, .5));
    const double range = random(0, 20);
    for(Index e = 0; e < t.number_of_edges(); ++e)
      t.set_length(e, n % 5 == 0 ? t.length(e) : random.below(10) == 0 ? 0 : std::exp(random(-range, range)));
    for(const double slack : {1e-17, 1e-12, 1e-5, .1})
      ++(checked(t, slack).added.front() > 0 ? more : none);
  }
  BOOST_TEST(more > 100);
  BOOST_TEST(none > 100);
}

BOOST_AUTO_TEST_CASE(lengths_of_any_size)
{
  Triangulation t = triangulation(flat_grid(4));
  t.set_length(7, 0);
  t.set_length(9, 3);
  const double added = checked(t, 1e-4).added.front();
  for(const int exponent : {-500, -80, 80, 500})
  {
    std::vector<double> lengths = t.lengths();
    for(double& l : lengths)
      l = std::ldexp(l, exponent);
    BOOST_TEST(CE::mollify(t.with_lengths(lengths), 1e-4).added.front() == std::ldexp(added, exponent));
  }
}

BOOST_AUTO_TEST_CASE(longer_numbers)
{
  Triangulation t = triangulation(flat_grid(4));
  t.set_length(7, 0);
  const CE::Mollified_metric<long double> m = CE::mollify(widened<long double>(t), 1e-6);
  BOOST_TEST(bool(m));
  BOOST_TEST(CE::is_valid_metric(m.triangulation));
  // what is added is a difference of lengths
  BOOST_TEST(std::abs(double(m.added.front()) / CE::mollify(t, 1e-6).added.front() - 1) <= rounded_ratio / 1e-6);
}

BOOST_AUTO_TEST_CASE(invalid_lengths_are_named)
{
  Triangulation t = triangulation(flat_grid(2));
  t.set_length(3, -1);
  t.set_length(5, std::numeric_limits<double>::quiet_NaN());
  t.set_length(6, std::numeric_limits<double>::infinity());
  const Mollified m = CE::mollify(t, 1e-5);
  BOOST_TEST((m.status == Status::INVALID_NUMBER));
  BOOST_TEST(m.edges == (std::vector<std::uint32_t>{3, 5, 6}));
  BOOST_TEST(m.triangulation.length(0) == t.length(0));
  BOOST_TEST(bool(CE::mollify(Triangulation(), 1e-5)));
}

// Coincident points become a problem that can be solved.
BOOST_AUTO_TEST_CASE(coincident_points)
{
  Soup soup = hill(6, .5);
  soup.points[16] = soup.points[17];
  soup.points[31] = soup.points[32];
  const Triangulation t = triangulation(soup);
  BOOST_TEST_REQUIRE(!CE::is_valid_metric(t));
  for(const double slack : {1e-8, 1e-5, 1e-2})
  {
    const Mollified m = checked(t, slack);
    const CE::Conformal_conditions<double> conditions(m.triangulation);
    BOOST_TEST(bool(CE::compute_conformal_metric(m.triangulation, conditions)));
  }
}

BOOST_AUTO_TEST_SUITE_END()
