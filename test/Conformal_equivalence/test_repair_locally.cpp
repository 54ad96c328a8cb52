// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Flips and splits of edges where the metric of a fixed triangulation breaks triangles, and the meshes made of the result.

#define BOOST_TEST_MODULE test_repair_locally
#include "include/boost_test.h"
#include "include/flattened_meshes.h"

#include <CGAL/Conformal_equivalence/discrete_metric.h>
#include <CGAL/Conformal_equivalence/edge_lengths.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/flatten_repaired.h>
#include <CGAL/Conformal_equivalence/repair_locally.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>

#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace CEi = CGAL::Conformal_equivalence::internal;
namespace params = CGAL::parameters;
using namespace testing;
using CE::Retriangulation;
using CE::Status;

namespace {

typedef CE::Intrinsic_triangulation<>     Triangulation;
typedef CE::Conformal_conditions<double>  Conditions;
typedef CE::Repaired_metric<double>       Repaired;
typedef CE::Edge_change<double>           Change;
typedef CE::Exact_angle<double>           Angle;

constexpr Index null_index = Triangulation::null_index;
constexpr double eps = std::numeric_limits<double>::epsilon();

Status status_without_repair(const Triangulation& t, const Conditions& conditions)
{
  return CE::compute_conformal_metric(t, conditions, params::retriangulation(Retriangulation::NEVER)).status;
}

// A plane of irregular, slanted triangles.
Soup slanted_grid(Index n, double shear)
{
  Soup soup = flat_grid(n);
  Random random(7);
  for(Point& p : soup.points)
  {
    const double x = p[0] + random(-.15, .15) / n, y = p[1] + random(-.15, .15) / n; // no triangle is turned over
    p = {{x + shear * y, y, 0}};
  }
  return soup;
}

// Corners of a rectangle for grid(n): not where those of the grid are.
bool is_corner(Index n, Index v)
{
  return v == n / 2 || v == n * (n + 1) + n / 2 || v == (n / 2) * (n + 1) || v == (n / 2) * (n + 1) + n;
}

Conditions rectangle(const Triangulation& t, Index n)
{
  Conditions conditions(t);
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(t.is_border_vertex(v))
      conditions.prescribe_angle_sum(v, is_corner(n, v) ? Angle::pi_times(1, 2) : Angle::pi_times(1));
  return conditions;
}

// A border stretched and shrunk at random.
Conditions stretched(const Triangulation& t, double amplitude)
{
  Conditions conditions(t);
  const std::vector<double> u = random_numbers(t.number_of_vertices(), amplitude, 3);
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(t.is_border_vertex(v))
      conditions.fix_log_scale_factor(v, u[v]);
  return conditions;
}

std::vector<Point> points_of(const Soup& soup, const Repaired& repaired)
{
  std::vector<Point> result = soup.points;
  for(const Change& c : repaired.changes)
    if(c.kind == Change::SPLIT)
    {
      const Point p = result[c.vertices[0]], q = result[c.vertices[1]];
      BOOST_REQUIRE_EQUAL(c.new_vertex, result.size());
      result.push_back({{p[0] + c.parameter * (q[0] - p[0]), p[1] + c.parameter * (q[1] - p[1]), p[2] + c.parameter * (q[2] - p[2])}});
    }
  return result;
}

// The metric is one, is conformally equivalent to the repaired triangulation, and meets the conditions.
void check_metric(const Triangulation& given, const Repaired& r)
{
  BOOST_TEST_REQUIRE(bool(r), CE::message(r.metric.status) << ", residual " << r.metric.statistics.residual);
  const Triangulation& t = r.triangulation();
  BOOST_TEST(t.number_of_vertices() == given.number_of_vertices() + r.number_of_splits());
  BOOST_TEST(r.conditions.size() == t.number_of_vertices());
  BOOST_TEST(r.input_edges.size() == t.number_of_edges());
  BOOST_TEST(r.metric.statistics.residual <= 1e-12);
  std::vector<double> lengths;
  for(Index e = 0; e < t.number_of_edges(); ++e)
    lengths.push_back(r.metric.scaled_length(t.edge_halfedge(e)));
  const Triangulation scaled = t.with_lengths(lengths);
  BOOST_TEST(CE::is_valid_metric(scaled));
  BOOST_TEST(CE::largest_cross_ratio_difference(t, scaled) <= 16 * eps); // eight roundings
  const std::vector<double> sums = CE::angle_sums(scaled);
  for(Index v = 0; v < t.number_of_vertices(); ++v)
  {
    if(t.is_isolated_vertex(v))
      continue;
    if(r.conditions.is_fixed(v))
      BOOST_TEST(std::abs(r.metric.log_scale_factors[v] - r.conditions.log_scale_factor(v)) <= 4 * eps);
    else
      BOOST_TEST(std::abs(sums[v] - r.conditions.angle_sum(v).radians()) <= 1e-7); // of lengths rounded: triangles may be thin
  }
}

// Edges are as given, or their parts sum up to what was given, unless some of it was flipped.
void check_edges(const Triangulation& given, const Repaired& r)
{
  const Triangulation& t = r.triangulation();
  std::vector<double> sum(given.number_of_edges(), 0);
  for(Index e = 0; e < t.number_of_edges(); ++e)
    if(r.input_edges[e] != null_index)
    {
      sum[r.input_edges[e]] += t.length(e);
      BOOST_TEST(t.is_border_edge(e) == given.is_border_edge(r.input_edges[e]));
    }
    else
      BOOST_TEST(!t.is_border_edge(e));
  std::size_t flipped = 0;
  for(Index e = 0; e < given.number_of_edges(); ++e)
    if(sum[e] < given.length(e) * (1 - 16 * eps)) // rounding of at most a few splits
    {
      ++flipped;
      BOOST_TEST(!given.is_border_edge(e));
    }
    else
      BOOST_TEST(sum[e] <= given.length(e) * (1 + 16 * eps));
  BOOST_TEST(flipped <= r.number_of_flips());
}

// Can a mesh hold it?
bool has_simple_edges(const Triangulation& t)
{
  std::vector<std::pair<Index, Index> > ends;
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    const Index h = t.edge_halfedge(e);
    ends.push_back(std::minmax({t.origin(h), t.target(h)}));
    if(t.origin(h) == t.target(h))
      return false;
  }
  std::sort(ends.begin(), ends.end());
  return std::adjacent_find(ends.begin(), ends.end()) == ends.end();
}

// The layout that the mesh has, against the triangulation: positive triangles, and edges as long as the metric says.
template <typename Report, typename HalfedgeUVMap>
void check_layout(const Repaired& r, const Report& report, const Mesh& repaired, HalfedgeUVMap uv)
{
  const Triangulation& t = r.triangulation();
  BOOST_TEST_REQUIRE(report.elements.halfedges.size() == t.number_of_halfedges());
  BOOST_TEST(repaired.number_of_vertices() == t.number_of_vertices());
  BOOST_TEST(repaired.number_of_edges() == t.number_of_edges());
  BOOST_TEST(repaired.is_valid(false));
  const auto verdict = CE::verify_layout(repaired, uv);
  BOOST_TEST(verdict.number_of_flipped_triangles == 0u);
  BOOST_TEST(verdict.number_of_degenerate_triangles == 0u);
  const double rounding = 16 * rounding_of_lengths(repaired, uv);
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    const Halfedge hd = report.elements.halfedges[h];
    BOOST_TEST(source(hd, repaired) == report.elements.vertices[t.origin(h)]);
    BOOST_TEST(target(hd, repaired) == report.elements.vertices[t.target(h)]);
    BOOST_TEST(face(hd, repaired) == report.elements.faces[t.face(h)]);
    const double length = r.metric.scaled_length(h);
    BOOST_TEST(std::abs(uv_length(repaired, uv, hd) - length) <= (1e-12 + rounding) * length);
    if(t.is_border(h) && r.conditions.is_fixed(t.origin(h)) && r.conditions.is_fixed(t.target(h)))
      BOOST_TEST(std::abs(uv_length(repaired, uv, hd) - t.halfedge_length(h)) <= (1e-12 + rounding) * t.halfedge_length(h));
    if(report.repaired_transitions.empty()) // border halfedges have the values of the triangle across, too
      BOOST_TEST((get(uv, opposite(hd, repaired)) == get(uv, prev(hd, repaired))));
  }
}

} // namespace

// ---- one edge

BOOST_AUTO_TEST_CASE(convexity_is_exact)
{
  // two triangles 3, 4, 5 side by side along their sides of length 3: the angle at the origin is pi, exactly
  const auto quad = [](double hypotenuse, double leg = 4)
  {
    Triangulation t(4, {0, 1, 2, 1, 0, 3}, {3, null_index, null_index, 0, null_index, null_index});
    // the edges in the order of their halfedges: 01, 12, 20, 03, 31
    const double lengths[] = {3, hypotenuse, leg, 4, 5};
    for(Index e = 0; e < 5; ++e)
      t.set_length(e, lengths[e]);
    return t;
  };
  BOOST_TEST(!CEi::is_strictly_convex(quad(5), 0));
  BOOST_TEST(!CEi::is_strictly_convex(quad(std::nextafter(5., 6.)), 0));
  BOOST_TEST(CEi::is_strictly_convex(quad(std::nextafter(5., 4.)), 0));
  BOOST_TEST(!CEi::is_strictly_convex(quad(7), 0));     // degenerate, the angle at the origin is pi
  BOOST_TEST(!CEi::is_strictly_convex(quad(1), 0));     // degenerate, the angle at the other end is pi
  BOOST_TEST(CEi::is_strictly_convex(quad(1, 2), 0));   // degenerate, both are 0
  BOOST_TEST(CEi::is_strictly_convex(quad(.5, 1), 0));  // no triangle: counts as degenerate
}

// Both triangles without area: the angles are sums of 0 and pi.
BOOST_AUTO_TEST_CASE(convexity_of_what_has_no_area)
{
  const auto quad = [](double a, double b, double c, double d)
  {
    Triangulation t(4, {0, 1, 2, 1, 0, 3}, {3, null_index, null_index, 0, null_index, null_index});
    const double lengths[] = {3, a, b, c, d}; // 01, 12, 20, 03, 31
    for(Index e = 0; e < 5; ++e)
      t.set_length(e, lengths[e]);
    return t;
  };
  BOOST_TEST(CEi::is_strictly_convex(quad(1, 2, 1, 2), 0));
  BOOST_TEST(CEi::is_strictly_convex(quad(1, 2, 2, 1), 0));
  BOOST_TEST(!CEi::is_strictly_convex(quad(1, 2, 4, 1), 0));
  BOOST_TEST(!CEi::is_strictly_convex(quad(5, 2, 2, 1), 0));
}

BOOST_AUTO_TEST_CASE(convexity_of_quadrilaterals_in_the_plane)
{
  Random random(1);
  const auto turn = [](const Point& p, const Point& q, const Point& r)
    { return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]); };
  int convex = 0, other = 0;
  for(int n = 0; n < 2000; ++n)
  {
    const Point i = {{random(-1, 1), random(-1, 1), 0}}, j = {{random(-1, 1), random(-1, 1), 0}},
                k = {{random(-1, 1), random(-1, 1), 0}}, l = {{random(-1, 1), random(-1, 1), 0}};
    if(turn(i, j, k) < 1e-6 || turn(j, i, l) < 1e-6)
      continue;
    const double at_i = turn(k, i, l), at_j = turn(l, j, k);
    if(std::min(std::abs(at_i), std::abs(at_j)) < 1e-6) // rounding of the lengths may decide
      continue;
    const Triangulation t = triangulation(Soup{{i, j, k, l}, {{{0, 1, 2}}, {{1, 0, 3}}}});
    BOOST_TEST(CEi::is_strictly_convex(t, 0) == (at_i > 0 && at_j > 0));
    ++(at_i > 0 && at_j > 0 ? convex : other);

    const double foot = CEi::Unfolded_apex<double>(t.length(0), distance<double>(j, k), distance<double>(k, i)).foot();
    const double c = distance<double>(i, j), exact = ((k[0] - i[0]) * (j[0] - i[0]) + (k[1] - i[1]) * (j[1] - i[1])) / c;
    BOOST_TEST(std::abs(foot - exact) <= 1e-14 * 8 / c);
  }
  BOOST_TEST(convex > 100);
  BOOST_TEST(other > 100);
}

BOOST_AUTO_TEST_CASE(feet_of_perpendiculars_at_any_scale)
{
  for(const double scale : {1e-150, 1., 1e150})
  {
    const CEi::Unfolded_apex<double> apex(14 * scale, 15 * scale, 13 * scale); // 5 + 9, height 12
    BOOST_TEST(std::abs(apex.foot() / scale - 5) <= 16 * eps);
    BOOST_TEST(std::abs(apex.height() / scale - 12) <= 24 * eps);
    BOOST_TEST(std::abs(apex.distance(14 * scale) / scale - 15) <= 32 * eps);
    BOOST_TEST(std::abs(apex.distance(0) / scale - 13) <= 32 * eps);
  }
  const CEi::Unfolded_apex<double> degenerate(3, 2, 1);
  BOOST_TEST(degenerate.foot() == 1);
  BOOST_TEST(degenerate.height() == 0);
  BOOST_TEST(degenerate.distance(1) == 0);
}

// ---- lengths only

BOOST_AUTO_TEST_CASE(nothing_is_changed_where_nothing_is_broken)
{
  const Triangulation t = triangulation(hill(8, .5));
  const Conditions conditions(t);
  const Repaired r = CE::repair_locally(t, conditions);
  check_metric(t, r);
  BOOST_TEST(r.changes.empty());
  BOOST_TEST((r.metric.statistics.conformal_class == CE::Conformal_class::FIXED_TRIANGULATION));
  const auto fixed = CE::compute_conformal_metric(t, conditions, params::retriangulation(Retriangulation::NEVER));
  BOOST_TEST(r.metric.log_scale_factors == fixed.log_scale_factors);
  BOOST_TEST(CE::internal::have_equal_triangulations(r.triangulation(), t));
}

namespace {

// A plane: flips and splits can be followed by points.
void check_changes_in_the_plane(const Soup& soup, const Triangulation& t, const Conditions& conditions)
{
  const Status before = status_without_repair(t, conditions);
  const Repaired r = CE::repair_locally(t, conditions, params::maximum_number_of_changes(1000));
  BOOST_TEST_MESSAGE(CE::message(before) << ": " << r.number_of_flips() << " flips, " << r.number_of_splits() << " splits, "
                     << r.metric.statistics.number_of_discarded_iterations << " steps discarded");
  check_metric(t, r);
  check_edges(t, r);
  BOOST_TEST(r.changes.empty() == CE::is_success(before));
  BOOST_TEST((r.metric.statistics.conformal_class == CE::Conformal_class::REPAIRED) == !r.changes.empty());
  BOOST_TEST(r.metric.statistics.number_of_flips == r.number_of_flips());
  const std::vector<Point> points = points_of(soup, r);
  const Triangulation& repaired = r.triangulation();
  BOOST_TEST(has_simple_edges(repaired));
  const double longest = *std::max_element(t.lengths().begin(), t.lengths().end());
  for(Index e = 0; e < repaired.number_of_edges(); ++e)
  {
    const Index h = repaired.edge_halfedge(e);
    BOOST_TEST(std::abs(distance<double>(points[repaired.origin(h)], points[repaired.target(h)]) - repaired.length(e)) <= 1e-10 * longest);
  }
  for(const Change& c : r.changes) // new vertices are flat, the border is as beside them
  {
    if(c.kind != Change::SPLIT)
      continue;
    const Index v = c.new_vertex, i = c.vertices[0], j = c.vertices[1];
    if(!repaired.is_border_vertex(v))
      BOOST_TEST((!r.conditions.is_fixed(v) && !r.conditions.is_cone(v)));
    else if(conditions.is_fixed(repaired.origin(repaired.vertex_halfedge(0))))
      BOOST_TEST(std::abs(r.conditions.log_scale_factor(v) - (1 - c.parameter) * r.conditions.log_scale_factor(i)
                                                           - c.parameter * r.conditions.log_scale_factor(j)) <= 16 * eps);
    else
      BOOST_TEST((!r.conditions.is_fixed(v) && r.conditions.angle_sum(v).units == Angle::units_of_pi));
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(changes_leave_the_surface_as_it_is)
{
  const Index n = 8;
  for(const double shear : {0., 2.})
    BOOST_TEST_CONTEXT("shear " << shear)
    {
      const Soup soup = slanted_grid(n, shear);
      const Triangulation t = triangulation(soup);
      check_changes_in_the_plane(soup, t, rectangle(t, n));
      for(const double amplitude : {1., 2.})
        BOOST_TEST_CONTEXT("amplitude " << amplitude)
          check_changes_in_the_plane(soup, t, stretched(t, amplitude));
    }
}

// The result does not depend on the unit of length.
BOOST_AUTO_TEST_CASE(lengths_of_any_size)
{
  const Index n = 6;
  const Triangulation t = triangulation(slanted_grid(n, 2));
  const Repaired r = CE::repair_locally(t, stretched(t, 2));
  BOOST_TEST_REQUIRE(r.changes.size() > 2u);
  for(const int exponent : {-480, 480})
  {
    std::vector<double> lengths = t.lengths();
    for(double& l : lengths)
      l = std::ldexp(l, exponent);
    const Repaired s = CE::repair_locally(t.with_lengths(lengths), stretched(t, 2));
    BOOST_TEST(bool(s));
    BOOST_TEST_REQUIRE(s.changes.size() == r.changes.size());
    for(std::size_t c = 0; c < r.changes.size(); ++c)
    {
      BOOST_TEST(s.changes[c].edge == r.changes[c].edge);
      BOOST_TEST(s.changes[c].kind == r.changes[c].kind);
      BOOST_TEST(s.changes[c].parameter == r.changes[c].parameter);
    }
    for(Index e = 0; e < s.triangulation().number_of_edges(); ++e)
      BOOST_TEST(s.triangulation().length(e) == std::ldexp(r.triangulation().length(e), exponent));
  }
}

BOOST_AUTO_TEST_CASE(longer_numbers)
{
  const Index n = 6;
  const CE::Intrinsic_triangulation<long double> t = triangulation<long double>(slanted_grid(n, 6));
  CE::Conformal_conditions<long double> conditions(t);
  const Conditions given = rectangle(triangulation(slanted_grid(n, 6)), n);
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    conditions.prescribe_angle_sum(v, given.angle_sum(v).radians<long double>());
  const CE::Repaired_metric<long double> r = CE::repair_locally(t, conditions);
  BOOST_TEST(bool(r));
  BOOST_TEST(!r.changes.empty());
}

BOOST_AUTO_TEST_CASE(budget)
{
  const Index n = 8;
  const Triangulation t = triangulation(slanted_grid(n, 2));
  const Conditions conditions = stretched(t, 2);
  const std::size_t needed = CE::repair_locally(t, conditions).changes.size();
  BOOST_TEST_REQUIRE(needed > 2u);
  for(const std::size_t budget : {std::size_t(0), std::size_t(1), std::size_t(2), needed - 1, needed})
  {
    const Repaired r = CE::repair_locally(t, conditions, params::maximum_number_of_changes(budget));
    BOOST_TEST(r.changes.size() == budget);
    BOOST_TEST(bool(r) == (budget == needed));
    BOOST_TEST(r.triangulation().number_of_vertices() == t.number_of_vertices() + r.number_of_splits()); // told on failure, too
    // The surface is drawn in the plane with straight edges, and remains so: angles like those keep the energy from falling for ever, so that
    // there is a minimizer, and what is not repaired is broken there.
    BOOST_TEST((r.metric.status == (budget == needed ? Status::OK : Status::DEGENERATE_METRIC)), CE::message(r.metric.status));
  }
}

BOOST_AUTO_TEST_CASE(constrained_edges_are_split)
{
  const Index n = 8;
  const Triangulation t = triangulation(slanted_grid(n, 2));
  const Conditions conditions = stretched(t, 2);
  const Repaired free = CE::repair_locally(t, conditions);
  BOOST_TEST_REQUIRE(free.number_of_flips() > 0u);
  const auto all = boost::make_function_property_map<Index, bool>([](Index) { return true; });
  const Repaired kept = CE::repair_locally(t, conditions, params::maximum_number_of_changes(40).edge_is_constrained_map(all));
  BOOST_TEST(kept.number_of_splits() > 0u);
  check_edges(t, kept);
  std::vector<char> is_kept(t.number_of_edges(), 1);
  for(const Change& c : kept.changes)
    if(c.kind == Change::FLIP)
      BOOST_TEST(!is_kept[c.edge]);
    else // by 2 or 3 edges, the first of which is a part of this one
    {
      is_kept.push_back(is_kept[c.edge]);
      is_kept.insert(is_kept.end(), kept.triangulation().is_border_vertex(c.new_vertex) ? 1 : 2, 0);
    }
}

// A guess for the vertices given is enough.
BOOST_AUTO_TEST_CASE(initial_scale_factors)
{
  const Index n = 8;
  const Triangulation t = triangulation(slanted_grid(n, 2));
  const auto guess = boost::make_function_property_map<Index, double>([&](Index v)
  {
    BOOST_REQUIRE(v < t.number_of_vertices());
    return .1 * v / t.number_of_vertices();
  });
  for(const Conditions& conditions : {stretched(t, 2), rectangle(t, n)})
  {
    const Repaired r = CE::repair_locally(t, conditions, params::initial_log_scale_factor_map(guess));
    check_metric(t, r);
    BOOST_TEST(!r.changes.empty());
  }
}

// Every flip of an edge of a tetrahedron would be a second edge between the same vertices.
BOOST_AUTO_TEST_CASE(no_double_edges)
{
  // a flat tetrahedron, with cones that its vertices cannot have: one vertex takes nearly nothing, one nearly all it can
  const Soup soup{{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{.3, .3, .05}}}, {{{0, 2, 1}}, {{0, 1, 3}}, {{1, 2, 3}}, {{2, 0, 3}}}};
  const Triangulation t = triangulation(soup);
  Conditions conditions(t);
  conditions.prescribe_angle_sum(0, Angle::pi_times(1, 10));
  conditions.prescribe_angle_sum(1, Angle::pi_times(1, 10));
  conditions.prescribe_angle_sum(2, Angle::pi_times(9, 5));
  conditions.prescribe_angle_sum(3, Angle::pi_times(2));
  BOOST_TEST_REQUIRE(!CE::is_success(status_without_repair(t, conditions)));
  const Repaired r = CE::repair_locally(t, conditions);
  check_metric(t, r);
  check_edges(t, r);
  BOOST_TEST((r.changes.front().kind == Change::SPLIT));
  BOOST_TEST(has_simple_edges(r.triangulation()));
}

BOOST_AUTO_TEST_CASE(conditions_of_new_vertices_on_the_border)
{
  // a triangle without area, but for a height of 1e-3, at a natural border; scale factors that pull it apart
  const Soup soup{{{{0, 0, 0}}, {{4, 0, 0}}, {{2, .001, 0}}, {{2, 3, 0}}}, {{{0, 1, 2}}, {{1, 3, 2}}, {{3, 0, 2}}}};
  const Triangulation t = triangulation(soup);
  Conditions conditions(t);
  conditions.fix_log_scale_factor(0, .5);
  conditions.fix_log_scale_factor(1, 1);
  conditions.fix_log_scale_factor(3, -1);
  BOOST_TEST_REQUIRE((status_without_repair(t, conditions) == Status::DEGENERATE_METRIC));
  const Repaired r = CE::repair_locally(t, conditions);
  check_metric(t, r);
  check_edges(t, r);
  std::size_t on_border = 0;
  std::vector<double> place(t.number_of_vertices(), -1);
  place[0] = 0;
  place[1] = 1;
  for(const Change& c : r.changes)
  {
    place.push_back(-1);
    if(c.kind == Change::FLIP)
    {
      place.pop_back();
      continue;
    }
    if(!r.triangulation().is_border_vertex(c.new_vertex))
      continue;
    const double a = place[c.vertices[0]], b = place[c.vertices[1]];
    if(a < 0 || b < 0)
      continue; // another side
    ++on_border;
    place.back() = a + c.parameter * (b - a);
    BOOST_TEST(r.conditions.is_fixed(c.new_vertex));
    BOOST_TEST(std::abs(r.conditions.log_scale_factor(c.new_vertex) - (.5 + .5 * place.back())) <= 8 * eps);
  }
  BOOST_TEST(on_border > 0u);
}

BOOST_AUTO_TEST_CASE(new_vertices_on_a_border_with_angles_are_straight)
{
  const Soup soup{{{{0, 0, 0}}, {{4, 0, 0}}, {{2, .001, 0}}, {{2, 3, 0}}}, {{{0, 1, 2}}, {{1, 3, 2}}, {{3, 0, 2}}}};
  const Triangulation t = triangulation(soup);
  Conditions conditions(t);
  conditions.prescribe_angle_sum(0, Angle::pi_times(1, 4)); // the inner vertex does not fit into such a triangle
  conditions.prescribe_angle_sum(1, Angle::pi_times(1, 4));
  conditions.prescribe_angle_sum(3, Angle::pi_times(1, 2));
  BOOST_TEST_REQUIRE((status_without_repair(t, conditions) == Status::DEGENERATE_METRIC));
  const Repaired r = CE::repair_locally(t, conditions);
  check_metric(t, r);
  check_edges(t, r);
  std::size_t on_border = 0;
  for(const Change& c : r.changes)
    if(c.kind == Change::SPLIT && r.triangulation().is_border_vertex(c.new_vertex))
    {
      ++on_border;
      BOOST_TEST(!r.conditions.is_fixed(c.new_vertex));
      BOOST_TEST(r.conditions.angle_sum(c.new_vertex).units == Angle::units_of_pi);
    }
  BOOST_TEST(on_border > 0u);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_repaired)
{
  { // no surface: a length violates the triangle inequality
    Triangulation t = triangulation(one_triangle({{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}));
    t.set_length(0, 3);
    const Repaired r = CE::repair_locally(t, Conditions(t));
    BOOST_TEST((r.metric.status == Status::DEGENERATE_METRIC));
    BOOST_TEST(r.changes.empty());
    BOOST_TEST(r.metric.faces == std::vector<Index>{0});
  }
  { // conditions without a solution
    const Triangulation t = triangulation(icosahedron());
    const Repaired r = CE::repair_locally(t, Conditions(t));
    BOOST_TEST((r.metric.status == Status::MISSING_CONDITION));
    BOOST_TEST(r.changes.empty());
  }
  { // an angle that no triangulation has
    const Triangulation t = triangulation(flat_grid(2));
    Conditions conditions(t);
    conditions.prescribe_angle_sum(4, -1.);
    const Repaired r = CE::repair_locally(t, conditions);
    BOOST_TEST((r.metric.status == Status::ANGLE_OUT_OF_RANGE));
    BOOST_TEST(r.changes.empty());
  }
  { // no triangle
    const Repaired r = CE::repair_locally(Triangulation(), Conditions());
    BOOST_TEST((r.metric.status == Status::EMPTY_MESH));
  }
}

namespace {

// Stops the second solve.
struct Stop_at_second_solve : public CE::Default_visitor
{
  int solves = 0;
  void on_stage(CE::Stage stage) { solves += stage == CE::Stage::SOLVE; }
  bool go_further() { return solves < 2; }
};

} // namespace

BOOST_AUTO_TEST_CASE(the_visitor_is_asked)
{
  const Index n = 8;
  const Triangulation t = triangulation(slanted_grid(n, 6));
  Stop_at_second_solve visitor;
  const Repaired r = CE::repair_locally(t, rectangle(t, n), params::retriangulation(Retriangulation::ALWAYS).visitor(std::ref(visitor)));
  BOOST_TEST((r.metric.status == Status::STOPPED_BY_VISITOR));
  BOOST_TEST(visitor.solves == 2);
}

// ---- meshes

BOOST_AUTO_TEST_CASE(a_plane_becomes_a_rectangle)
{
  const Index n = 8;
  const Soup soup = slanted_grid(n, 6);
  const Mesh sm = surface_mesh<Mesh>(soup);
  const auto border_angle = boost::make_function_property_map<Vertex, double>([&](Vertex v) { return is_corner(n, v) ? pi / 2 : pi; });
  Mesh repaired;
  auto uv = repaired.add_property_map<Halfedge, Point_2>("h:uv").first;
  auto u = repaired.add_property_map<Vertex, double>("v:u", 77.).first;
  auto w = repaired.add_property_map<Vertex, double>("v:w", 77.).first;
  CE::Flattening_report<Mesh> copy;
  const auto report = CE::flatten_repaired(sm, repaired, uv, params::border_angle_map(border_angle).flattening_report(std::ref(copy)),
                                           params::log_scale_factor_map(u).projective_weight_map(w));
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  BOOST_TEST(!report.changes.empty());
  BOOST_TEST((copy.statistics.conformal_class == CE::Conformal_class::REPAIRED));
  const Triangulation t = CE::import_mesh(sm).triangulation;
  const Repaired r = CE::repair_locally(t, rectangle(t, n));
  check_layout(r, report, repaired, uv);
  BOOST_TEST(judge(repaired, uv, false).is_good()); // in the plane, edges of the copy are straight: cross ratios are those of its points
  for(const Vertex v : vertices(sm))
    if(is_corner(n, v))
      BOOST_TEST(std::abs(uv_angle_sum(repaired, uv, v) - pi / 2) <= 1e-9);
  double most = 0;
  for(const Vertex v : vertices(repaired))
  {
    BOOST_TEST(u[v] == r.metric.log_scale_factors[v]);
    most = (std::max)(most, w[v]);
  }
  BOOST_TEST(most == 1);
}

BOOST_AUTO_TEST_CASE(a_plane_with_a_stretched_border)
{
  const Soup soup = slanted_grid(8, 2);
  const Mesh sm = surface_mesh<Mesh>(soup);
  const Triangulation t = CE::import_mesh(sm).triangulation;
  const std::vector<double> u = random_numbers(soup.points.size(), 2, 3); // as in stretched()
  Mesh repaired;
  auto uv = repaired.add_property_map<Halfedge, Point_2>("h:uv").first;
  const auto prescribed = boost::make_function_property_map<Vertex, double>([&](Vertex v) { return u[v]; });
  const auto report = CE::flatten_repaired(sm, repaired, uv, params::prescribed_log_scale_factor_map(prescribed));
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  const Repaired r = CE::repair_locally(t, stretched(t, 2));
  BOOST_TEST(r.number_of_flips() > 0u);
  BOOST_TEST(r.number_of_splits() > 0u);
  BOOST_TEST(report.changes.size() == r.changes.size());
  const std::vector<Point> points = points_of(soup, r);
  for(const Vertex v : vertices(repaired))
  {
    const Point_3& p = repaired.point(v);
    BOOST_TEST(std::hypot(p.x() - points[v][0], p.y() - points[v][1]) <= 1e-14);
  }
  BOOST_TEST(judge(repaired, uv, false).is_good());
  const Triangulation& result = r.triangulation();
  for(Index e = 0; e < result.number_of_edges(); ++e)
    BOOST_TEST(std::abs(uv_length(repaired, uv, report.elements.halfedges[result.edge_halfedge(e)])
                        - r.metric.scaled_length(result.edge_halfedge(e))) <= 1e-10);
}

BOOST_AUTO_TEST_CASE(without_changes_it_is_a_copy)
{
  const Mesh sm = surface_mesh<Mesh>(together({hill(5, .5), annulus(2, 9, 1)}, true));
  Mesh repaired;
  auto uv = repaired.add_property_map<Halfedge, Point_2>("h:uv").first;
  const auto report = CE::flatten_repaired(sm, repaired, uv);
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  BOOST_TEST(report.changes.empty());
  BOOST_TEST(repaired.number_of_vertices() == sm.number_of_vertices());
  BOOST_TEST(repaired.number_of_faces() == sm.number_of_faces());
  for(const Vertex v : vertices(sm))
    BOOST_TEST((repaired.point(v) == sm.point(v)));
  BOOST_TEST(judge(repaired, uv).is_good());

  Mesh other = sm;
  auto other_uv = other.add_property_map<Halfedge, Point_2>("h:uv").first;
  BOOST_TEST(bool(CE::flatten(sm, other_uv)));
  for(const Face f : faces(sm))
    for(const Halfedge h : CGAL::halfedges_around_face(halfedge(f, sm), sm))
      BOOST_TEST((other_uv[h] == uv[repaired.halfedge(source(h, sm), target(h, sm))]));
}

BOOST_AUTO_TEST_CASE(nothing_is_written_without_success)
{
  const Mesh sm = surface_mesh<Mesh>(icosahedron());
  Mesh repaired;
  auto uv = repaired.add_property_map<Halfedge, Point_2>("h:uv").first;
  const auto report = CE::flatten_repaired(sm, repaired, uv);
  BOOST_TEST((report.status == Status::MISSING_CONDITION));
  BOOST_TEST(repaired.is_empty());

  const Soup soup = slanted_grid(8, 6);
  const Mesh plane = surface_mesh<Mesh>(soup);
  const auto straight = boost::make_function_property_map<Vertex, double>([](Vertex v) { return is_corner(8, v) ? pi / 2 : pi; });
  const auto stopped = CE::flatten_repaired(plane, repaired, uv, params::border_angle_map(straight).maximum_number_of_changes(1));
  BOOST_TEST(!bool(stopped));
  BOOST_TEST(stopped.changes.size() == 1u);
  BOOST_TEST(!stopped.vertices.empty());
  for(const std::size_t v : stopped.vertex_indices)
    BOOST_TEST(v < soup.points.size());
  BOOST_TEST(repaired.is_empty());
}

// The disks of CGAL on which the fixed triangulation breaks, with a natural border.
BOOST_AUTO_TEST_CASE(broken_disks, * needs_mesh("blob.off"))
{
  for(const std::string name : {"cylinder_locally_refined.off", "mannequin-devil.off", "blob.off", "corner_tris_with_hole.off",
                                "degtri_sliding.off"})
  {
    BOOST_TEST_CONTEXT(name)
    {
      const Mesh sm = read_mesh(name);
      const auto mesh = CE::import_mesh(sm);
      const Triangulation& t = mesh.triangulation;
      const Conditions conditions(t);
      BOOST_TEST((status_without_repair(t, conditions) == Status::DEGENERATE_METRIC));
      const Repaired r = CE::repair_locally(t, conditions);
      check_metric(t, r);
      check_edges(t, r);
      BOOST_TEST(has_simple_edges(r.triangulation()));
      Mesh repaired;
      auto uv = repaired.add_property_map<Halfedge, Point_2>("h:uv").first;
      const auto report = CE::flatten_repaired(sm, repaired, uv);
      BOOST_TEST_REQUIRE(bool(report), CE::message(report));
      check_layout(r, report, repaired, uv);
      BOOST_TEST_MESSAGE(name << ": " << r.number_of_flips() << " flips, " << r.number_of_splits() << " splits, "
                         << r.metric.statistics.number_of_iterations << " Newton steps and "
                         << r.metric.statistics.number_of_discarded_iterations << " before, residual " << r.metric.statistics.residual
                         << ", length error " << report.layout_length_error);
    }
  }
}

// Cones on a surface with handles: the cut is one of the repaired triangulation.
BOOST_AUTO_TEST_CASE(closed_surface_with_cones, * needs_mesh("eight.off"))
{
  const Mesh sm = read_mesh("eight.off");
  const std::size_t n = num_vertices(sm), number_of_cones = 8;
  std::vector<Vertex> cones;
  for(std::size_t k = 0; k < number_of_cones; ++k)
    cones.push_back(Vertex(Index(n * k / number_of_cones)));
  const auto angle = boost::make_function_property_map<Vertex, double>([&](Vertex v)
    { return std::find(cones.begin(), cones.end(), v) != cones.end() ? 5 * pi / 2 : 2 * pi; });
  const auto given_seam = boost::make_function_property_map<Edge, bool>([](Edge e) { return Index(e) == 17; });
  const auto mesh = CE::import_mesh(sm);
  Conditions conditions(mesh.triangulation);
  for(const Vertex v : cones)
    conditions.prescribe_angle_sum(v, Angle::pi_times(5, 2));
  BOOST_TEST_REQUIRE((status_without_repair(mesh.triangulation, conditions) == Status::DEGENERATE_METRIC));

  Mesh repaired;
  auto uv = repaired.add_property_map<Halfedge, Point_2>("h:uv").first;
  auto seam = repaired.add_property_map<Edge, bool>("e:seam", false).first;
  const auto report = CE::flatten_repaired(sm, repaired, uv, params::cone_angle_map(angle).edge_is_seam_map(given_seam),
                                           params::edge_is_seam_map(seam));
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  BOOST_TEST(!report.changes.empty());
  BOOST_TEST(report.cones.size() == number_of_cones);
  const auto verdict = CE::verify_layout(repaired, uv);
  BOOST_TEST(verdict.number_of_flipped_triangles + verdict.number_of_degenerate_triangles == 0u);
  std::size_t seam_edges = 0;
  for(const Edge e : edges(repaired))
  {
    seam_edges += seam[e];
    const Halfedge h = halfedge(e, repaired), g = opposite(h, repaired);
    const bool is_continuous = uv[h] == uv[prev(g, repaired)] && uv[g] == uv[prev(h, repaired)];
    if(!seam[e])
      BOOST_TEST(is_continuous);
    const double length = uv_length(repaired, uv, h);
    BOOST_TEST(std::abs(uv_length(repaired, uv, g) - length) <= (1e-12 + 16 * rounding_of_lengths(repaired, uv)) * length);
  }
  BOOST_TEST(seam[edge(report.elements.halfedges[mesh.triangulation.edge_halfedge(mesh.index_of_edge(Edge(17)))], repaired)]);
  BOOST_TEST(report.repaired_transitions.size() == seam_edges);
  for(const auto& motion : report.repaired_transitions) // across the seam, onto what is there
  {
    const Halfedge h = motion.halfedge, g = opposite(h, repaired);
    const auto moved = [&](const Point_2& p)
    {
      return Point_2(motion.rotation[0] * p.x() - motion.rotation[1] * p.y() + motion.translation[0],
                     motion.rotation[1] * p.x() + motion.rotation[0] * p.y() + motion.translation[1]);
    };
    const double scale = rounding_of_lengths(repaired, uv) * uv_length(repaired, uv, h) + 1e-9;
    BOOST_TEST(plane_distance(moved(uv[h]), uv[prev(g, repaired)]) <= scale);
    BOOST_TEST(plane_distance(moved(uv[prev(h, repaired)]), uv[g]) <= scale);
  }
  for(const Vertex v : vertices(repaired))
    BOOST_TEST(std::abs(uv_angle_sum(repaired, uv, v) - (std::find(cones.begin(), cones.end(), v) != cones.end() ? 5 * pi / 2 : 2 * pi)) <= 1e-6);
}
