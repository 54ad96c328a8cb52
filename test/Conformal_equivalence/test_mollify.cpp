// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The least constant that makes triangles of all faces.

#define BOOST_TEST_MODULE test_mollify
#include "include/boost_test.h"
#include "include/test_meshes.h"

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/discrete_metric.h>
#include <CGAL/Conformal_equivalence/mollify.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace CEi = CGAL::Conformal_equivalence::internal;
using namespace testing;
using CE::Status;

namespace {

typedef CE::Intrinsic_triangulation<> Triangulation;
typedef CE::Mollified_metric<double>  Mollified;

constexpr double eps = std::numeric_limits<double>::epsilon();

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
    const double wanted = slack * sum[c], rounding = 1e-13 * sum[c] * slack;
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
  BOOST_TEST(std::abs(double(m.added.front()) / CE::mollify(t, 1e-6).added.front() - 1) <= 1e-9);
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
