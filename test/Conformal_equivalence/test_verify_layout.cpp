// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What judges a layout. verify_layout.h: verdicts on layouts made by hand, and against brute force in exact arithmetic;
// conformal_distortion.h: affine maps with known singular values.

#define BOOST_TEST_MODULE test_verify_layout
#include "include/boost_test.h"
#include "include/tolerances.h"

#include <CGAL/Conformal_equivalence/conformal_distortion.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Face_filtered_graph.h>

#ifdef CGAL_EIGEN3_ENABLED
#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#endif

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
using testing::few_roundings;

typedef CGAL::Exact_predicates_inexact_constructions_kernel   Kernel;
typedef Kernel::Point_2                                       Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                   Mesh;
typedef Mesh::Vertex_index                                    vertex_descriptor;
typedef Mesh::Halfedge_index                                  halfedge_descriptor;
typedef Mesh::Face_index                                      face_descriptor;
typedef Mesh::Property_map<halfedge_descriptor, Point_2>      UV_map;
typedef CE::Layout_verdict<Mesh>                              Verdict;
typedef CE::Injectivity                                       Injectivity;

// ---------------------------------------------------------------------------------------------------
// Layouts made by hand: the points of the mesh are (u, v, 0), and uv is taken from them
// ---------------------------------------------------------------------------------------------------

struct Laid_out_mesh
{
  Mesh mesh;
  UV_map uv;

  vertex_descriptor add_vertex(double x, double y) { return mesh.add_vertex({x, y, 0}); }

  void copy_points_to_uv()
  {
    uv = mesh.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
    for(halfedge_descriptor h : mesh.halfedges())
    {
      const Kernel::Point_3& p = mesh.point(mesh.target(h));
      uv[h] = Point_2(p.x(), p.y());
    }
  }

  Verdict verdict()
  {
    copy_points_to_uv();
    return CE::verify_layout(mesh, uv);
  }
};

typedef std::function<Point_2(double, double)> Plane_map;

// m x n squares, cut into two triangles each, at map(i, j); closed in the first direction if asked for.
std::vector<vertex_descriptor> add_grid(Laid_out_mesh& l, int m, int n, const Plane_map& map, bool closed = false)
{
  std::vector<vertex_descriptor> v;
  for(int j = 0; j <= n; ++j)
    for(int i = 0; i < m + (closed ? 0 : 1); ++i)
    {
      const Point_2 p = map(i, j);
      v.push_back(l.add_vertex(p.x(), p.y()));
    }
  const int row = m + (closed ? 0 : 1);
  const auto at = [&](int i, int j) { return v[j * row + i % row]; };
  for(int j = 0; j < n; ++j)
    for(int i = 0; i < m; ++i)
    {
      l.mesh.add_face(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      l.mesh.add_face(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  return v;
}

Plane_map shifted(double x, double y, double scale = 1)
{
  return [=](double i, double j) { return Point_2(x + scale * i, y + scale * j); };
}

// Polar coordinates: i is the angle in steps of which `turn` make a full turn, j + r0 the radius, counterclockwise
// and with positive triangles (the radius decreases with j).
Plane_map polar(double turn, double r0, double growth = 0)
{
  return [=](double i, double j)
  {
    const double a = 2 * CGAL_PI * std::fmod(i, turn) / turn, r = r0 - j + growth * i;
    return Point_2(r * std::cos(a), r * std::sin(a));
  };
}

// ---------------------------------------------------------------------------------------------------
// Brute force in exact arithmetic
// ---------------------------------------------------------------------------------------------------

typedef std::array<Point_2, 3> Triangle;

std::vector<Triangle> triangles(const Laid_out_mesh& l)
{
  std::vector<Triangle> result;
  for(face_descriptor f : l.mesh.faces())
  {
    const halfedge_descriptor h = l.mesh.halfedge(f);
    result.push_back({{ l.uv[h], l.uv[l.mesh.next(h)], l.uv[l.mesh.prev(h)] }});
  }
  return result;
}

CGAL::Sign exact_orientation(const Triangle& t)
{
  typedef CGAL::Exact_predicates_exact_constructions_kernel::FT FT;
  const FT ax = FT(t[1].x()) - FT(t[0].x()), ay = FT(t[1].y()) - FT(t[0].y());
  const FT bx = FT(t[2].x()) - FT(t[0].x()), by = FT(t[2].y()) - FT(t[0].y());
  return CGAL::sign(ax * by - ay * bx);
}

// Is the interior of b on the other side of an edge of a? Both positive.
bool is_separated_by_an_edge_of(const Triangle& a, const Triangle& b)
{
  for(int i = 0; i < 3; ++i)
  {
    bool separated = true;
    for(const Point_2& p : b)
      separated = separated && exact_orientation({{ a[i], a[(i + 1) % 3], p }}) != CGAL::POSITIVE;
    if(separated)
      return true;
  }
  return false;
}

bool interiors_are_disjoint(const std::vector<Triangle>& t)
{
  for(std::size_t i = 0; i < t.size(); ++i)
    for(std::size_t j = i + 1; j < t.size(); ++j)
      if(!is_separated_by_an_edge_of(t[i], t[j]) && !is_separated_by_an_edge_of(t[j], t[i]))
        return false;
  return true;
}

Kernel::Segment_2 segment(const Laid_out_mesh& l, halfedge_descriptor h)
{
  return Kernel::Segment_2(l.uv[l.mesh.prev(h)], l.uv[h]);
}

void check_overlap_with_crossings(const Laid_out_mesh& l, const Verdict& verdict)
{
  BOOST_TEST(int(verdict.injectivity) == int(Injectivity::NO));
  BOOST_TEST(verdict.number_of_flipped_triangles == 0u);
  BOOST_TEST(!verdict.crossing_borders.empty());
  for(const auto& pair : verdict.crossing_borders)
  {
    BOOST_TEST(pair.first != pair.second);
    BOOST_TEST(CGAL::do_intersect(segment(l, pair.first), segment(l, pair.second)));
  }
}

void check_injective(const Verdict& verdict)
{
  BOOST_TEST(int(verdict.injectivity) == int(Injectivity::YES));
  BOOST_TEST(verdict.flipped_faces.empty());
  BOOST_TEST(verdict.degenerate_faces.empty());
  BOOST_TEST(verdict.crossing_borders.empty());
}

void check_overlap_without_crossing(const Verdict& verdict)
{
  BOOST_TEST(int(verdict.injectivity) == int(Injectivity::NO));
  BOOST_TEST(verdict.number_of_flipped_triangles == 0u);
  BOOST_REQUIRE(verdict.crossing_borders.size() == 1u);
  BOOST_TEST(verdict.crossing_borders[0].first != verdict.crossing_borders[0].second);
}

// ---------------------------------------------------------------------------------------------------
// Orientation of triangles
// ---------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(identity_grid)
{
  Laid_out_mesh l;
  add_grid(l, 20, 30, shifted(0, 0, 0.1));
  check_injective(l.verdict());
}

BOOST_AUTO_TEST_CASE(empty_mesh_and_single_triangle)
{
  Laid_out_mesh empty, one;
  check_injective(empty.verdict());
  one.mesh.add_face(one.add_vertex(0, 0), one.add_vertex(1e-300, 0), one.add_vertex(0, 1e-300));
  one.add_vertex(7, 7);                                                    // isolated
  check_injective(one.verdict());
}

BOOST_AUTO_TEST_CASE(one_vertex_moved_across)
{
  Laid_out_mesh l;
  const auto v = add_grid(l, 10, 10, shifted(0, 0));
  l.mesh.point(v[5 * 11 + 5]) = Kernel::Point_3(6.5, 5.25, 0);
  const Verdict verdict = l.verdict();

  std::vector<face_descriptor> flipped;
  const std::vector<Triangle> t = triangles(l);
  for(std::size_t f = 0; f < t.size(); ++f)
    if(exact_orientation(t[f]) == CGAL::NEGATIVE)
      flipped.push_back(face_descriptor(CGAL::SM_Index<face_descriptor>::size_type(f)));

  BOOST_TEST(int(verdict.injectivity) == int(Injectivity::NO));
  BOOST_TEST(flipped.size() >= 1u);
  BOOST_TEST((verdict.flipped_faces == flipped));
  BOOST_TEST(verdict.number_of_flipped_triangles == flipped.size());
}

BOOST_AUTO_TEST_CASE(one_ulp)
{
  // The point (x, x) and its neighbors in double against the line from (0.1, 0.1) to (12.3, 12.3).
  const double x = 0.7, up = std::nextafter(x, 1.), down = std::nextafter(x, 0.);
  for(const double y : {up, x, down})
  {
    Laid_out_mesh l;
    l.mesh.add_face(l.add_vertex(0.1, 0.1), l.add_vertex(12.3, 12.3), l.add_vertex(x, y));
    const Verdict verdict = l.verdict();
    BOOST_TEST(verdict.number_of_flipped_triangles == (y == down ? 1u : 0u));
    BOOST_TEST(verdict.number_of_degenerate_triangles == (y == x ? 1u : 0u));
    BOOST_TEST(int(verdict.injectivity) == int(y == up ? Injectivity::YES : Injectivity::NO));
  }
}

BOOST_AUTO_TEST_CASE(coordinates_that_are_no_numbers)
{
  for(const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
  {
    Laid_out_mesh l;
    const auto v = add_grid(l, 4, 4, shifted(0, 0));
    l.mesh.point(v[2 * 5 + 2]) = Kernel::Point_3(2, bad, 0);
    const Verdict verdict = l.verdict();
    BOOST_TEST(int(verdict.injectivity) == int(Injectivity::NO));
    BOOST_TEST(verdict.number_of_degenerate_triangles == 6u);
    BOOST_TEST(verdict.number_of_flipped_triangles == 0u);
    for(face_descriptor f : verdict.degenerate_faces)
    {
      const auto around = CGAL::vertices_around_face(l.mesh.halfedge(f), l.mesh);
      BOOST_TEST((std::find(around.begin(), around.end(), v[2 * 5 + 2]) != around.end()));
    }
  }
}

BOOST_AUTO_TEST_CASE(face_that_is_no_triangle)
{
  Laid_out_mesh l;
  l.mesh.add_face(l.add_vertex(0, 0), l.add_vertex(1, 0), l.add_vertex(1, 1), l.add_vertex(0, 1));
  BOOST_TEST(int(l.verdict().injectivity) == int(Injectivity::UNDECIDED));
}

// ---------------------------------------------------------------------------------------------------
// Overlaps
// ---------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(spiral_strips)
{
  Laid_out_mesh apart, overlapping;
  add_grid(apart, 200, 1, polar(60, 3, 0.03));             // 1.8 further out a turn, 1 wide
  check_injective(apart.verdict());

  add_grid(overlapping, 200, 1, polar(61.3, 3, 0.01));     // 0.6 further out a turn, 1 wide
  Verdict verdict = overlapping.verdict();
  check_overlap_with_crossings(overlapping, verdict);

  // All crossings and no other pair, by brute force.
  std::set<std::pair<halfedge_descriptor, halfedge_descriptor> > listed(verdict.crossing_borders.begin(),
                                                                        verdict.crossing_borders.end());
  std::size_t number = 0;
  std::vector<halfedge_descriptor> border;
  for(halfedge_descriptor h : overlapping.mesh.halfedges())
    if(!overlapping.mesh.is_border(h) && overlapping.mesh.is_border(overlapping.mesh.opposite(h)))
      border.push_back(h);
  for(halfedge_descriptor g : border)
    for(halfedge_descriptor h : border)
      if(g < h && CGAL::do_intersect(segment(overlapping, g), segment(overlapping, h))
         && overlapping.mesh.target(g) != overlapping.mesh.source(h)
         && overlapping.mesh.target(h) != overlapping.mesh.source(g))
      {
        ++number;
        BOOST_TEST((listed.count({g, h}) + listed.count({h, g}) == 1));
      }
  BOOST_TEST(number == verdict.crossing_borders.size());
}

BOOST_AUTO_TEST_CASE(annuli)
{
  Laid_out_mesh once, stacked, crossing;
  add_grid(once, 24, 3, polar(24, 5), true);
  check_injective(once.verdict());
  add_grid(stacked, 24, 3, polar(12, 5), true);            // twice around, sheet upon sheet
  check_overlap_without_crossing(stacked.verdict());
  add_grid(crossing, 25, 3, polar(12.5, 5), true);         // twice around, the sheets half a step apart
  check_overlap_with_crossings(crossing, crossing.verdict());
}

BOOST_AUTO_TEST_CASE(branch_point)
{
  for(const int n : {6, 7})
  {
    Laid_out_mesh once, twice;
    for(int turns : {1, 2})
    {
      Laid_out_mesh& l = turns == 1 ? once : twice;
      const Plane_map map = polar(double(n) / turns, 1);
      const vertex_descriptor center = l.add_vertex(0, 0);
      std::vector<vertex_descriptor> rim;
      for(int i = 0; i < n; ++i)
      {
        const Point_2 p = map(i, 0);
        rim.push_back(l.add_vertex(p.x(), p.y()));
      }
      for(int i = 0; i < n; ++i)
        l.mesh.add_face(center, rim[i], rim[(i + 1) % n]);
    }
    check_injective(once.verdict());
    const Verdict verdict = twice.verdict();
    BOOST_TEST(verdict.number_of_flipped_triangles == 0u);
    BOOST_TEST(int(verdict.injectivity) == int(Injectivity::NO));
    BOOST_TEST(!verdict.crossing_borders.empty());
  }
}

BOOST_AUTO_TEST_CASE(several_components)
{
  struct Second { double x, y, scale; int size; bool injective; };
  const Second seconds[] = {
    { 7, 0, 1, 3, true },              // apart
    { 4, 0, 1, 4, true },              // along a whole side
    { 4, 0.5, 1, 2, true },            // along parts of edges
    { 4, 4, 1, 4, true },              // at a corner
    { 4, 0.5, 0.1, 2, true },          // within one edge
    { std::nextafter(4., 0.), 0, 1, 4, false },
    { 2, 2, 1, 4, false },
    { 0, 0, 1, 4, false },             // the same place
    { 1.25, 1.25, 0.1, 2, false },     // inside, without any contact
    { 1, 1, 1, 2, false },             // inside, along inner edges
    { -3, -3, 2, 5, false },           // around
    { 0, 0, 0.5, 8, false }            // the same place, other edges
  };
  for(const Second& s : seconds)
  {
    Laid_out_mesh l;
    add_grid(l, 4, 4, shifted(0, 0));
    add_grid(l, s.size, s.size, shifted(s.x, s.y, s.scale));
    const Verdict verdict = l.verdict();
    BOOST_TEST(verdict.number_of_flipped_triangles == 0u);
    BOOST_TEST(int(verdict.injectivity) == int(s.injective ? Injectivity::YES : Injectivity::NO),
               "second component at " << s.x << ", " << s.y << " scaled by " << s.scale);
    BOOST_TEST(verdict.crossing_borders.empty() == s.injective);
    BOOST_TEST(interiors_are_disjoint(triangles(l)) == s.injective);
  }
}

// An island that fills the hole of an annulus, exactly or not.
BOOST_AUTO_TEST_CASE(island_in_a_hole)
{
  for(const double size : {1., 0.5, std::nextafter(1., 2.)})
  {
    Laid_out_mesh l;
    const Plane_map ring = [](double i, double j)
    {
      static const double x[] = {-1, 1, 1, -1}, y[] = {-1, -1, 1, 1};
      return Point_2((3 - j) * x[int(i) % 4], (3 - j) * y[int(i) % 4]);
    };
    add_grid(l, 4, 2, ring, true);
    add_grid(l, 1, 1, [=](double i, double j) { return Point_2(size * (2 * i - 1), size * (2 * j - 1)); });
    const Verdict verdict = l.verdict();
    BOOST_TEST(int(verdict.injectivity) == int(size <= 1 ? Injectivity::YES : Injectivity::NO));
    BOOST_TEST(interiors_are_disjoint(triangles(l)) == (size <= 1));
  }
}

// A closed ring unrolled: uv differs on the two sides of one edge, which is a seam without being marked as such.
BOOST_AUTO_TEST_CASE(unrolled_cylinder)
{
  for(const double shift : {8., 1.})
  {
    Laid_out_mesh l;
    add_grid(l, 8, 2, shifted(0, 0), true);
    l.copy_points_to_uv();
    for(face_descriptor f : l.mesh.faces())
    {
      bool is_last = false;
      for(halfedge_descriptor h : CGAL::halfedges_around_face(l.mesh.halfedge(f), l.mesh))
        is_last = is_last || l.uv[h].x() == 7;
      if(!is_last)
        continue;
      for(halfedge_descriptor h : CGAL::halfedges_around_face(l.mesh.halfedge(f), l.mesh))
        if(l.uv[h].x() == 0)
          l.uv[h] = Point_2(shift + 0., l.uv[h].y());
    }
    const Verdict verdict = CE::verify_layout(l.mesh, l.uv);
    if(shift == 8)
      check_injective(verdict);
    else
      BOOST_TEST(verdict.number_of_flipped_triangles == 4u);
  }
}

BOOST_AUTO_TEST_CASE(selected_patch)
{
  Laid_out_mesh l;
  add_grid(l, 200, 1, polar(60, 3, 0.01));
  l.copy_points_to_uv();
  std::vector<face_descriptor> one_turn(l.mesh.faces().begin(), std::next(l.mesh.faces().begin(), 110));
  const CGAL::Face_filtered_graph<Mesh> patch(l.mesh, one_turn);
  BOOST_TEST(int(CE::verify_layout(patch, l.uv).injectivity) == int(Injectivity::YES));
}

// ---------------------------------------------------------------------------------------------------
// Random layouts on a small grid of integers, where contacts of all kinds are frequent
// ---------------------------------------------------------------------------------------------------

std::mt19937 generator(20081);

Point_2 random_point(int n)
{
  std::uniform_int_distribution<int> coordinate(0, n);
  const int x = coordinate(generator);
  return Point_2(x, coordinate(generator));
}

BOOST_AUTO_TEST_CASE(random_triangles)
{
  std::size_t injective = 0, overlapping = 0;
  for(int trial = 0; trial < 20000; ++trial)
  {
    Laid_out_mesh l;
    const int number = 2 + trial % 4, size = 2 + trial % 5;
    while(int(l.mesh.number_of_faces()) < number)
    {
      const Triangle t = {{ random_point(size), random_point(size), random_point(size) }};
      if(exact_orientation(t) == CGAL::POSITIVE)
        l.mesh.add_face(l.add_vertex(t[0].x(), t[0].y()), l.add_vertex(t[1].x(), t[1].y()),
                        l.add_vertex(t[2].x(), t[2].y()));
    }
    const Verdict verdict = l.verdict();
    const bool expected = interiors_are_disjoint(triangles(l));
    BOOST_REQUIRE(int(verdict.injectivity) == int(expected ? Injectivity::YES : Injectivity::NO));
    BOOST_REQUIRE(verdict.crossing_borders.empty() == expected);
    for(const auto& pair : verdict.crossing_borders)
      BOOST_REQUIRE(pair.first != pair.second);
    ++(expected ? injective : overlapping);
  }
  BOOST_TEST_MESSAGE(injective << " injective, " << overlapping << " overlapping");
  BOOST_TEST(injective > 500u);
  BOOST_TEST(overlapping > 500u);
}

// A disk grown triangle by triangle over random border edges.
void grow_disk(Laid_out_mesh& l, int number, int size)
{
  l.mesh.add_face(l.add_vertex(0, 0), l.add_vertex(1 + size / 2, 0), l.add_vertex(0, 1 + size / 2));
  for(int attempt = 0; attempt < 100 && int(l.mesh.number_of_faces()) < number; ++attempt)
  {
    std::vector<halfedge_descriptor> border;
    for(halfedge_descriptor h : l.mesh.halfedges())
      if(l.mesh.is_border(h))
        border.push_back(h);
    const halfedge_descriptor h = border[generator() % border.size()];
    const auto p = l.mesh.point(l.mesh.source(h)), q = l.mesh.point(l.mesh.target(h));
    const Point_2 apex = random_point(size);
    if(exact_orientation({{ Point_2(p.x(), p.y()), Point_2(q.x(), q.y()), apex }}) == CGAL::POSITIVE)
      l.mesh.add_face(l.mesh.source(h), l.mesh.target(h), l.add_vertex(apex.x(), apex.y()));
  }
}

BOOST_AUTO_TEST_CASE(random_disks_against_brute_force_and_simplicity)
{
  std::size_t simple = 0, touching = 0, overlapping = 0;
  for(int trial = 0; trial < 4000; ++trial)
  {
    Laid_out_mesh l;
    grow_disk(l, 2 + trial % 9, 3 + trial % 12);
    const Verdict verdict = l.verdict();
    const bool expected = interiors_are_disjoint(triangles(l));
    BOOST_REQUIRE(int(verdict.injectivity) == int(expected ? Injectivity::YES : Injectivity::NO));

    std::vector<Point_2> polygon;
    halfedge_descriptor bhd;
    for(halfedge_descriptor h : l.mesh.halfedges())
      if(l.mesh.is_border(h))
        bhd = h;
    for(halfedge_descriptor h : CGAL::halfedges_around_face(bhd, l.mesh))
      polygon.push_back(Point_2(l.mesh.point(l.mesh.target(h)).x(), l.mesh.point(l.mesh.target(h)).y()));
    const bool is_simple = CGAL::is_simple_2(polygon.begin(), polygon.end(), Kernel());
    BOOST_REQUIRE((!is_simple || expected));
    ++(is_simple ? simple : expected ? touching : overlapping);
  }
  BOOST_TEST_MESSAGE(simple << " simple, " << touching << " touching, " << overlapping << " overlapping");
  BOOST_TEST(simple > 200u);
  BOOST_TEST(touching > 50u);
  BOOST_TEST(overlapping > 200u);
}

// ---------------------------------------------------------------------------------------------------
// Value types; a layout by another method
// ---------------------------------------------------------------------------------------------------

template <typename OtherKernel>
void check_value_type()
{
  Laid_out_mesh l;
  add_grid(l, 5, 5, shifted(0, 0));
  typedef typename OtherKernel::Point_2 Point;
  auto uv = l.mesh.add_property_map<halfedge_descriptor, Point>("h:other_uv").first;
  const auto write = [&]()
  {
    for(halfedge_descriptor h : l.mesh.halfedges())
      uv[h] = Point(l.mesh.point(l.mesh.target(h)).x(), l.mesh.point(l.mesh.target(h)).y());
  };
  write();
  check_injective(CE::verify_layout(l.mesh, uv));
  l.mesh.point(vertex_descriptor(14)) = Kernel::Point_3(0.25, 0.25, 0);
  write();
  BOOST_TEST(CE::verify_layout(l.mesh, uv).number_of_flipped_triangles > 0u);
}

BOOST_AUTO_TEST_CASE(value_types)
{
  check_value_type<Kernel>();
  check_value_type<CGAL::Exact_predicates_exact_constructions_kernel>();
  check_value_type<CGAL::Simple_cartesian<float> >();
}

#ifdef CGAL_EIGEN3_ENABLED
BOOST_AUTO_TEST_CASE(least_squares_conformal_map, * testing::needs_mesh("three_peaks.off"))
{
  namespace SMP = CGAL::Surface_mesh_parameterization;
  typedef CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT<CGAL::Eigen_sparse_matrix<double>::EigenType> > Solver;

  Laid_out_mesh l;
  std::ifstream in(testing::mesh_path("three_peaks.off"));
  BOOST_REQUIRE((in >> l.mesh));
  halfedge_descriptor bhd;
  for(halfedge_descriptor h : l.mesh.halfedges())
    if(l.mesh.is_border(h))
      bhd = h;
  auto vertex_uv = l.mesh.add_property_map<vertex_descriptor, Point_2>("v:uv").first;
  typedef SMP::Two_vertices_parameterizer_3<Mesh> Border;
  SMP::LSCM_parameterizer_3<Mesh, Border, Solver> lscm;
  BOOST_REQUIRE(SMP::parameterize(l.mesh, lscm, bhd, vertex_uv) == SMP::OK);

  l.copy_points_to_uv();
  for(halfedge_descriptor h : l.mesh.halfedges())
    l.uv[h] = vertex_uv[l.mesh.target(h)];
  const Verdict verdict = CE::verify_layout(l.mesh, l.uv);
  BOOST_TEST(verdict.number_of_flipped_triangles == 60u);     // counted independently
  BOOST_TEST(int(verdict.injectivity) == int(Injectivity::NO));
}
#endif

// ---------------------------------------------------------------------------------------------------
// conformal_distortion.h: affine maps with known singular values, of triangles of all shapes and sizes
// ---------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_SUITE(distortion)

namespace params = CGAL::parameters;

typedef Kernel::Point_3        Point_3;
typedef Mesh::Edge_index       edge_descriptor;
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
  const double rounding = 1000 * few_roundings; // points are rounded in units of the grid, of which triangles are down to a hundredth as high
  for(const double scale : {1., 1e-150, 1e150})
  {
    Mesh mesh = grid(10, 0.2, scale);
    const UV_map uv = lay_out(mesh, [=](const Point& p) { return Point{{ 2.5 * p[0], -p[1] }}; });
    const CE::Conformal_distortion<Mesh> d = CE::compute_conformal_distortion(mesh, uv);
    BOOST_TEST(std::fabs(d.mean_quasi_conformal_factor - 2.5) <= rounding);
    BOOST_TEST(std::fabs(d.maximum_quasi_conformal_factor - 2.5) <= rounding);
    BOOST_TEST(d.maximum_quasi_conformal_factor == CE::quasi_conformal_factor(mesh, uv, d.face_of_maximum));
    BOOST_TEST(std::fabs(d.minimum_log_area_ratio) <= rounding);
    BOOST_TEST(std::fabs(d.maximum_log_area_ratio) <= rounding);
    BOOST_TEST(d.root_mean_square_log_area_ratio <= rounding);
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
  const double rounding = 1000 * few_roundings; // of points and lengths, of triangles that are down to a hundredth as high as the grid is wide
  for(const auto& d : { from_points, from_lengths, vpm })
  {
    BOOST_TEST(std::fabs(d.minimum_log_scale_factor - smallest) <= rounding);
    BOOST_TEST(std::fabs(d.maximum_log_scale_factor - largest) <= rounding);
    BOOST_TEST(std::fabs(d.mean_quasi_conformal_factor - from_points.mean_quasi_conformal_factor) <= rounding);
    BOOST_TEST(std::fabs(d.maximum_quasi_conformal_factor - from_points.maximum_quasi_conformal_factor) <= rounding);
    BOOST_TEST(std::fabs(d.root_mean_square_log_area_ratio - from_points.root_mean_square_log_area_ratio) <= rounding);
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

BOOST_AUTO_TEST_SUITE_END()
