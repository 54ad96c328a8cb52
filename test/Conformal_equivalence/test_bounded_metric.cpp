// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Lower bounds on u: the solution satisfies the Karush-Kuhn-Tucker conditions, in 50 digits, and is the one that
// brute force finds: of all sets of bounds, made equalities, exactly one gives a metric that satisfies them.

#define BOOST_TEST_MODULE test_bounded_metric
#include "include/boost_test.h"
#include "include/index_level.h"
#include "include/wide_angle_sums.h"

#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;
using namespace testing;
typedef Wide_real Real;
using CE::Retriangulation;
using CE::Status;

namespace {

const double infinity = std::numeric_limits<double>::infinity();
const double nan = std::numeric_limits<double>::quiet_NaN();

// The angle sums; of the surface, if the metric is one of its double.
template <typename NT>
std::vector<Real> angle_sums(const CE::Conformal_metric<NT>& metric, const Triangulation& given)
{
  std::vector<Real> sum = testing::wide_angle_sums(metric);
  sum.resize(given.number_of_vertices());
  for(Index v = 0; metric.is_doubled && v < sum.size(); ++v)
    if(given.is_border_vertex(v))
      sum[v] /= 2;
  return sum;
}

// How far the metric is from satisfying the conditions: in angles (radians), and in u.
template <typename NT>
struct Violation
{
  double angle = 0, u = 0;

  Violation(const Triangulation& given, const CE::Conformal_conditions<NT>& conditions, const CE::Conformal_metric<NT>& metric,
            const std::vector<Index>& active)
  {
    const std::vector<Real> sum = angle_sums(metric, given);
    for(Index v = 0; v < given.number_of_vertices(); ++v)
    {
      if(given.is_isolated_vertex(v))
        continue;
      const double x = static_cast<double>(metric.log_scale_factors[v]);
      if(conditions.is_fixed(v))
      {
        u = (std::max)(u, std::abs(x - static_cast<double>(conditions.log_scale_factor(v))));
        continue;
      }
      const double difference = static_cast<double>(Real(sum[v] - conditions.angle_sum(v).template radians<Real>()));
      const bool is_active = std::find(active.begin(), active.end(), v) != active.end();
      angle = (std::max)(angle, is_active ? difference : std::abs(difference));
      if(conditions.is_bounded(v))
      {
        const double excess = static_cast<double>(NT(metric.log_scale_factors[v] - conditions.lower_bound(v)));
        u = (std::max)(u, is_active ? std::abs(excess) : -excess);
      }
    }
  }
};

double largest_difference(const std::vector<double>& u, const std::vector<double>& v)
{
  BOOST_REQUIRE_EQUAL(u.size(), v.size());
  double result = 0;
  for(std::size_t i = 0; i < u.size(); ++i)
    result = (std::max)(result, std::abs(u[i] - v[i]));
  return result;
}

void check_solution(const Triangulation& t, const Conditions& conditions, const Metric& metric)
{
  BOOST_REQUIRE_MESSAGE(metric.status == Status::OK, CE::message(metric.status) << ' ' << metric.amount);
  const Violation<double> violation(t, conditions, metric, metric.active_bounds);
  BOOST_CHECK_LE(violation.angle, testing::solver_tolerance);
  BOOST_CHECK_LE(violation.u, testing::unmoved_u); // of the u fixed, up to rounding
  BOOST_CHECK(std::is_sorted(metric.active_bounds.begin(), metric.active_bounds.end()));
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(conditions.is_bounded(v) && !t.is_isolated_vertex(v))
    {
      const bool is_active = std::binary_search(metric.active_bounds.begin(), metric.active_bounds.end(), v);
      BOOST_CHECK_GE(metric.log_scale_factors[v], conditions.lower_bound(v));
      BOOST_CHECK_EQUAL(is_active, metric.log_scale_factors[v] == conditions.lower_bound(v));
    }
}

Metric solved(const Triangulation& t, const Conditions& conditions, Retriangulation mode = Retriangulation::NEVER)
{
  const Metric metric = CE::compute_conformal_metric(t, conditions, params::retriangulation(mode));
  check_solution(t, conditions, metric);
  return metric;
}

std::vector<Index> bounded_vertices(const Conditions& conditions)
{
  std::vector<Index> result;
  for(Index v = 0; v < conditions.size(); ++v)
    if(conditions.is_bounded(v))
      result.push_back(v);
  return result;
}

// Tries all sets of bounds. Returns how many of them are solutions, and sets `metric` to one.
int brute_force(const Triangulation& t, const Conditions& conditions, Retriangulation mode, Metric& metric, std::vector<Index>& active)
{
  const std::vector<Index> bounded = bounded_vertices(conditions);
  int count = 0;
  for(unsigned subset = 0; subset < (1u << bounded.size()); ++subset)
  {
    Conditions equalities = conditions;
    std::vector<Index> held;
    for(std::size_t i = 0; i < bounded.size(); ++i)
    {
      const Index v = bounded[i];
      if(subset >> i & 1)
      {
        equalities.fix_log_scale_factor(v, conditions.lower_bound(v));
        held.push_back(v);
      }
      else
        equalities.prescribe_angle_sum(v, conditions.angle_sum(v));
    }
    const Metric trial = CE::compute_conformal_metric(t, equalities, params::retriangulation(mode));
    if(!trial)
      continue;
    const Violation<double> violation(t, conditions, trial, held);
    if(violation.angle > 10 * testing::solver_tolerance || violation.u > 10 * testing::solved_u) // what is no solution is far from being one
      continue;
    ++count;
    metric = trial;
    active = held;
  }
  return count;
}

struct Tally
{
  int solved = 0, degenerate = 0, none = 0, some = 0, all = 0;
  std::size_t most_iterations = 0;
};

// The bounded problem against brute force. Where its minimizer is no metric on the fixed triangulation, there is
// none to be found by brute force either.
void compare(const Triangulation& t, const Conditions& conditions, Retriangulation mode, Tally& tally)
{
  const Metric metric = CE::compute_conformal_metric(t, conditions, params::retriangulation(mode));
  Metric expected;
  std::vector<Index> active;
  const int count = brute_force(t, conditions, mode, expected, active);
  if(metric.status == Status::DEGENERATE_METRIC && mode == Retriangulation::NEVER)
  {
    BOOST_CHECK_EQUAL(count, 0);
    ++tally.degenerate;
    return;
  }
  check_solution(t, conditions, metric);
  BOOST_CHECK_EQUAL(count, 1);
  BOOST_CHECK_EQUAL_COLLECTIONS(metric.active_bounds.begin(), metric.active_bounds.end(), active.begin(), active.end());
  if(count == 1)
    BOOST_CHECK_SMALL(largest_difference(metric.log_scale_factors, expected.log_scale_factors), 2 * testing::solved_u);
  ++tally.solved;
  const std::size_t bounded = bounded_vertices(conditions).size();
  ++(active.empty() ? tally.none : active.size() == bounded ? tally.all : tally.some);
  tally.most_iterations = (std::max)(tally.most_iterations, metric.statistics.number_of_iterations);
}

void report(const char* what, const Tally& tally)
{
  BOOST_TEST_MESSAGE(what << ": " << tally.solved << " solved (active: none " << tally.none << ", some " << tally.some
                          << ", all " << tally.all << "), degenerate " << tally.degenerate << ", most Newton steps "
                          << tally.most_iterations);
}

// `n` different vertices of those that satisfy the predicate
template <typename Predicate>
std::vector<Index> choose(Index n, Index of, testing::Random& random, Predicate predicate)
{
  std::vector<Index> candidates, result;
  for(Index v = 0; v < of; ++v)
    if(predicate(v))
      candidates.push_back(v);
  BOOST_REQUIRE_GE(candidates.size(), n);
  while(result.size() < n)
  {
    const Index i = random.below(Index(candidates.size()));
    result.push_back(candidates[i]);
    candidates.erase(candidates.begin() + i);
  }
  return result;
}

Triangulation rough_sphere(unsigned seed, int levels = 0, double amplitude = .15)
{
  testing::Soup soup = testing::icosphere(levels);
  testing::add_noise(soup, amplitude, seed);
  return testing::triangulation(soup);
}

Triangulation rough_torus(unsigned seed)
{
  testing::Soup soup = testing::torus(6, 5);
  testing::add_noise(soup, .2, seed);
  return testing::triangulation(soup);
}

// ---- against brute force

// u = 0 on the border; bounds about the unbounded solution
void disk(Retriangulation mode, unsigned seeds, Tally& tally)
{
  for(unsigned seed = 1; seed <= seeds; ++seed)
  {
    const Triangulation t = testing::triangulation(testing::random_height_field(5, .5, seed));
    Conditions conditions(t);
    const Metric unbounded = CE::compute_conformal_metric(t, conditions);
    BOOST_REQUIRE(unbounded);
    testing::Random random(seed);
    for(const Index v : choose(3 + seed % 6, t.number_of_vertices(), random, [&](Index w) { return !t.is_border_vertex(w); }))
      conditions.prescribe_angle_sum_above(v, Angle::pi_times(2), unbounded.log_scale_factors[v] + random(-.15, .15));
    compare(t, conditions, mode, tally);
  }
}

// The border straight but at some of its vertices: nothing is fixed, all rests on bounds.
void polygon(Retriangulation mode, unsigned seeds, Tally& tally)
{
  for(unsigned seed = 1; seed <= seeds; ++seed)
  {
    const Triangulation t = testing::triangulation(testing::random_height_field(4, .3, seed));
    Conditions conditions(t);
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      if(t.is_border_vertex(v))
        conditions.prescribe_angle_sum(v, Angle::pi_times(1));
    testing::Random random(seed);
    for(const Index v : choose(3 + seed % 4, t.number_of_vertices(), random,
                               [&](Index w) { return t.is_border_vertex(w) && t.degree(w) > 1; }))
      conditions.prescribe_angle_sum_above(v, Angle::pi_times(1), random(2.8, 3.2));
    for(const Index v : {0u, 4u, 20u, 24u}) // the corners
      if(!conditions.is_bounded(v))
        conditions.prescribe_angle_sum(v, Angle::pi_times(1, 2));
    compare(t, conditions, mode, tally);
  }
}

// Flat but at the active ones.
void sphere(Retriangulation mode, unsigned seeds, Tally& tally)
{
  for(unsigned seed = 1; seed <= seeds; ++seed)
  {
    const Triangulation t = rough_sphere(seed);
    Conditions conditions(t);
    testing::Random random(seed);
    for(const Index v : choose(3 + seed % 6, t.number_of_vertices(), random, [](Index) { return true; }))
      conditions.prescribe_angle_sum_above(v, Angle::pi_times(2), random(-2, 2));
    compare(t, conditions, mode, tally);
  }
}

// Somewhat more angle than a torus has; on some of them, one vertex of fixed u.
void torus(Retriangulation mode, unsigned seeds, Tally& tally)
{
  for(unsigned seed = 1; seed <= seeds; ++seed)
  {
    const Triangulation t = rough_torus(seed);
    Conditions conditions(t);
    testing::Random random(seed);
    const std::vector<Index> chosen = choose(4 + seed % 5, t.number_of_vertices(), random, [](Index) { return true; });
    for(const Index v : chosen)
      conditions.prescribe_angle_sum_above(v, 2 * pi + random(0, .5), random(-.3, .3));
    if(seed % 2)
      conditions.fix_log_scale_factor(chosen[0], .1);
    compare(t, conditions, mode, tally);
  }
}

BOOST_AUTO_TEST_CASE(disks_against_brute_force)
{
  Tally tally;
  disk(Retriangulation::NEVER, 24, tally);
  report("disks", tally);
  BOOST_CHECK_EQUAL(tally.solved, 24);
  BOOST_CHECK_GE(tally.some, 10);
}

BOOST_AUTO_TEST_CASE(polygons_against_brute_force)
{
  Tally tally;
  polygon(Retriangulation::NEVER, 24, tally);
  report("polygons", tally);
  BOOST_CHECK_EQUAL(tally.solved, 24);
}

BOOST_AUTO_TEST_CASE(spheres_against_brute_force)
{
  Tally tally;
  sphere(Retriangulation::NEVER, 24, tally);
  report("spheres", tally);
  BOOST_CHECK_EQUAL(tally.solved, 16);
  BOOST_CHECK_EQUAL(tally.degenerate, 8); // bounds that are by 4 apart break triangles
}

BOOST_AUTO_TEST_CASE(tori_against_brute_force)
{
  Tally tally;
  torus(Retriangulation::NEVER, 24, tally);
  report("tori", tally);
  BOOST_CHECK_EQUAL(tally.solved, 24);
}

BOOST_AUTO_TEST_CASE(flipped_surfaces_against_brute_force)
{
  Tally tally;
  disk(Retriangulation::ALWAYS, 6, tally);
  polygon(Retriangulation::ALWAYS, 6, tally);
  sphere(Retriangulation::ALWAYS, 12, tally);
  torus(Retriangulation::ALWAYS, 6, tally);
  report("flipped", tally);
  BOOST_CHECK_EQUAL(tally.solved, 30);
}

// ---- special cases

BOOST_AUTO_TEST_CASE(no_bound_active)
{
  for(unsigned seed = 1; seed <= 5; ++seed)
  {
    const Triangulation t = testing::triangulation(testing::random_height_field(8, .5, seed));
    Conditions conditions(t);
    const Metric unbounded = solved(t, conditions);
    testing::Random random(seed);
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      if(!t.is_border_vertex(v))
        conditions.prescribe_angle_sum_above(v, Angle::pi_times(2), unbounded.log_scale_factors[v] - random(.01, 3));
    const Metric metric = solved(t, conditions);
    BOOST_CHECK(metric.active_bounds.empty());
    BOOST_CHECK_SMALL(largest_difference(metric.log_scale_factors, unbounded.log_scale_factors), testing::solved_u);
  }
}

BOOST_AUTO_TEST_CASE(all_bounds_active)
{
  for(unsigned seed = 1; seed <= 5; ++seed)
  {
    const Triangulation t = rough_sphere(seed, 1, .02);
    Conditions conditions(t), equalities(t);
    testing::Random random(seed);
    for(const Index v : choose(12, t.number_of_vertices(), random, [](Index) { return true; }))
    {
      const double u = random(-.5, .5);
      conditions.prescribe_angle_sum_above(v, 1000., u); // more than there is
      equalities.fix_log_scale_factor(v, u);
    }
    const Metric expected = CE::compute_conformal_metric(t, equalities);
    BOOST_REQUIRE(expected);
    const Metric metric = solved(t, conditions);
    BOOST_CHECK_EQUAL(metric.active_bounds.size(), 12u);
    BOOST_CHECK_SMALL(largest_difference(metric.log_scale_factors, expected.log_scale_factors), testing::solved_u);
  }
}

BOOST_AUTO_TEST_CASE(all_vertices_bounded)
{
  // at equal bounds nothing happens where the curvature is not negative
  const Triangulation t = testing::triangulation(testing::icosahedron());
  Conditions conditions(t);
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    conditions.prescribe_angle_sum_above(v, Angle::pi_times(2), .25);
  const Metric metric = solved(t, conditions);
  BOOST_CHECK_EQUAL(metric.active_bounds.size(), 12u);

  // one lower than the others, and free to fall until its angle sum, of pi, is reached
  conditions.prescribe_angle_sum_above(0, Angle::pi_times(1), -100.);
  const Metric cone = solved(t, conditions);
  BOOST_CHECK_EQUAL(cone.active_bounds.size(), 11u);
  BOOST_CHECK_GT(cone.log_scale_factors[0], .25); // a sharper cone has longer sides
}

BOOST_AUTO_TEST_CASE(tight_bounds)
{
  for(unsigned seed = 1; seed <= 10; ++seed)
    for(const double off : {0., 1e-16, -1e-16, 1e-14, -1e-14, 1e-12, -1e-12, 1e-9, -1e-9})
    {
      const Triangulation t = testing::triangulation(testing::random_height_field(6, .5, seed));
      Conditions conditions(t);
      const Metric unbounded = solved(t, conditions);
      for(Index v = 0; v < t.number_of_vertices(); ++v)
        if(!t.is_border_vertex(v) && v % 2)
          conditions.prescribe_angle_sum_above(v, Angle::pi_times(2), unbounded.log_scale_factors[v] + off);
      const Metric metric = solved(t, conditions);
      BOOST_CHECK_SMALL(largest_difference(metric.log_scale_factors, unbounded.log_scale_factors), 3 * testing::solved_u + 2 * (std::max)(0., off));
    }
}

BOOST_AUTO_TEST_CASE(angles_that_add_up_leave_bounds_the_scale)
{
  for(const Retriangulation mode : {Retriangulation::NEVER, Retriangulation::WHEN_NEEDED})
    for(unsigned seed = 1; seed <= 5; ++seed)
    {
      const Triangulation t = rough_torus(seed);
      Conditions conditions(t);
      const Metric unbounded = CE::compute_conformal_metric(t, conditions, params::retriangulation(mode));
      BOOST_REQUIRE(unbounded);
      testing::Random random(seed);
      double rise = -infinity;
      for(const Index v : choose(7, t.number_of_vertices(), random, [](Index) { return true; }))
      {
        const double bound = random(-3, 3);
        conditions.prescribe_angle_sum_above(v, Angle::pi_times(2), bound);
        rise = (std::max)(rise, bound - unbounded.log_scale_factors[v]);
      }
      const Metric metric = solved(t, conditions, mode);
      BOOST_CHECK_EQUAL(metric.active_bounds.size(), 1u);
      for(Index v = 0; v < t.number_of_vertices(); ++v)
        BOOST_CHECK_SMALL(metric.log_scale_factors[v] - unbounded.log_scale_factors[v] - rise, testing::solved_u);

      // the same with angles written with few digits
      const Index v = metric.active_bounds[0];
      conditions.prescribe_angle_sum_above(v, 2 * pi + 1e-11, conditions.lower_bound(v));
      const Metric rounded = CE::compute_conformal_metric(t, conditions, params::retriangulation(mode));
      BOOST_CHECK(rounded);
      BOOST_CHECK_CLOSE_FRACTION(rounded.statistics.angle_defect_spread, 1e-11, 1e-3); // 2 pi is rounded by 1e-3 of that
      BOOST_CHECK_SMALL(largest_difference(rounded.log_scale_factors, metric.log_scale_factors), 10 * 1e-11); // the least eigenvalue is above 1/10
    }
}

BOOST_AUTO_TEST_CASE(components_of_all_kinds)
{
  const testing::Soup soup = testing::together({testing::hill(5, .5), testing::icosahedron(), testing::torus(6, 5), testing::torus(5, 5),
                                                testing::hill(4, .5)}, true);
  const Triangulation t = testing::triangulation(soup);
  const CE::Surface_components pieces = CE::connected_components(t);
  Conditions conditions(t);
  std::vector<std::vector<Index> > vertices(pieces.components.size());
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v))
      vertices[pieces.component_of_vertex[v]].push_back(v);
    else
      conditions.prescribe_angle_sum_above(v, Angle::pi_times(2), nan); // of no interest
  BOOST_REQUIRE_EQUAL(vertices.size(), 5u);
  for(const Index v : vertices[0])
    if(!t.is_border_vertex(v))
      conditions.prescribe_angle_sum_above(v, Angle::pi_times(2), .01); // some bounds
  for(std::size_t i : {0, 3, 7, 9})
    conditions.prescribe_angle_sum_above(vertices[1][i], Angle::pi_times(2), .1 * double(i)); // rests on bounds
  conditions.prescribe_angle_sum_above(vertices[2][3], Angle::pi_times(2), -5.); // scale only
  const Metric metric = solved(t, conditions); // nothing at all on the fourth, natural border on the fifth
  double sum = 0;
  for(const Index v : vertices[3])
    sum += metric.log_scale_factors[v];
  BOOST_CHECK_SMALL(sum, testing::solved_u);
  BOOST_CHECK_EQUAL(metric.log_scale_factors[vertices[2][3]], -5.);
}

// ---- what is refused

BOOST_AUTO_TEST_CASE(invalid_numbers)
{
  const Triangulation t = testing::triangulation(testing::hill(4, .5));
  for(const double bound : {nan, infinity, -infinity})
  {
    Conditions conditions(t);
    conditions.prescribe_angle_sum_above(7, Angle::pi_times(2), bound);
    const Metric metric = CE::compute_conformal_metric(t, conditions);
    BOOST_CHECK(metric.status == Status::INVALID_NUMBER);
    BOOST_CHECK(metric.vertices == std::vector<Index>{7});
    BOOST_CHECK(metric.active_bounds.empty() && metric.log_scale_factors.empty());
  }
  for(const double angle : {nan, infinity})
  {
    Conditions conditions(t);
    conditions.prescribe_angle_sum_above(7, angle, 0.);
    BOOST_CHECK(CE::compute_conformal_metric(t, conditions).status == Status::INVALID_NUMBER);
  }
  for(const double angle : {0., -1.})
  {
    Conditions conditions(t);
    conditions.prescribe_angle_sum_above(7, angle, 0.);
    const Metric metric = CE::compute_conformal_metric(t, conditions);
    BOOST_CHECK(metric.status == Status::ANGLE_OUT_OF_RANGE);
    BOOST_CHECK(metric.vertices == std::vector<Index>{7});
  }
}

BOOST_AUTO_TEST_CASE(too_little_angle)
{
  for(const Retriangulation mode : {Retriangulation::NEVER, Retriangulation::WHEN_NEEDED})
  {
    // E would decrease forever as u grows
    const Triangulation torus = testing::triangulation(testing::torus(6, 5));
    Conditions conditions(torus);
    conditions.prescribe_angle_sum_above(3, Angle::pi_times(3, 2), 0.);
    const Metric falling = CE::compute_conformal_metric(torus, conditions, params::retriangulation(mode));
    BOOST_CHECK(falling.status == Status::GAUSS_BONNET_VIOLATED);
    BOOST_CHECK_CLOSE_FRACTION(falling.amount, pi / 2, testing::few_roundings * torus.number_of_vertices()); // a sum over all vertices
    BOOST_CHECK(falling.vertices == std::vector<Index>{3});
    conditions.prescribe_angle_sum_above(3, 2 * pi - 1e-8, 0.);
    BOOST_CHECK(CE::compute_conformal_metric(torus, conditions, params::retriangulation(mode)).status == Status::GAUSS_BONNET_VIOLATED);
    conditions.prescribe_angle_sum_above(3, 2 * pi + 1e-8, 0.);
    BOOST_CHECK(CE::compute_conformal_metric(torus, conditions, params::retriangulation(mode)));

    // E would decrease forever as u falls outside of the bounds
    const Triangulation ball = testing::triangulation(testing::icosahedron());
    Conditions two(ball);
    two.prescribe_angle_sum_above(2, Angle::pi_times(2), 0.);
    two.prescribe_angle_sum_above(11, Angle::pi_times(2), 0.);
    const Metric exhausted = CE::compute_conformal_metric(ball, two, params::retriangulation(mode));
    BOOST_CHECK(exhausted.status == Status::NO_ANGLE_LEFT);
    BOOST_CHECK_EQUAL(exhausted.amount, 0.);
    BOOST_CHECK((exhausted.vertices == std::vector<Index>{2, 11}));
    two.prescribe_angle_sum_above(5, Angle::pi_times(2), 0.);
    check_solution(ball, two, CE::compute_conformal_metric(ball, two, params::retriangulation(mode)));
    // a fixed vertex is as good as a bounded one
    two.fix_log_scale_factor(5, 0.);
    check_solution(ball, two, CE::compute_conformal_metric(ball, two, params::retriangulation(mode)));
  }
}

// ---- the solver

BOOST_AUTO_TEST_CASE(when_needed_is_never_where_nothing_is_needed)
{
  for(unsigned seed = 1; seed <= 10; ++seed)
  {
    const Triangulation t = rough_sphere(seed, 1, .06);
    Conditions conditions(t);
    testing::Random random(seed);
    for(const Index v : choose(10, t.number_of_vertices(), random, [](Index) { return true; }))
      conditions.prescribe_angle_sum_above(v, Angle::pi_times(2), random(-.5, .5));
    const Metric fixed = CE::compute_conformal_metric(t, conditions, params::retriangulation(Retriangulation::NEVER));
    const Metric metric = solved(t, conditions, Retriangulation::WHEN_NEEDED);
    check_solution(t, conditions, fixed);
    BOOST_CHECK(fixed.log_scale_factors == metric.log_scale_factors);
    BOOST_CHECK(fixed.active_bounds == metric.active_bounds);
  }
}

BOOST_AUTO_TEST_CASE(borders_on_the_double)
{
  // a border edge nearly as long as the three others: its triangle is broken however the inner edges are flipped
  Triangulation t = testing::triangulation(testing::cone(4, 1.));
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    const Index v = t.origin(t.edge_halfedge(e)), w = t.target(t.edge_halfedge(e));
    t.set_length(e, v == 0 || w == 0 ? 1.5 : v + w == 3 ? 2.9 : 1);
  }
  testing::Random random(1);
  for(int k = 0; k < 6; ++k)
  {
    Conditions conditions(t);
    for(const Index v : {1u, 2u, 3u, 4u})
      conditions.prescribe_angle_sum_above(v, Angle::pi_times(v < 3 && k % 2 ? 1 : 4), k == 0 ? 0. : random(-.02, .02));
    const Metric metric = solved(t, conditions, Retriangulation::WHEN_NEEDED);
    BOOST_CHECK(metric.is_doubled);
    for(const Index v : metric.active_bounds)
      BOOST_CHECK_LT(v, t.number_of_vertices());
  }
}

BOOST_AUTO_TEST_CASE(strategies_and_warm_starts)
{
  for(unsigned seed = 1; seed <= 6; ++seed)
  {
    const Triangulation t = testing::triangulation(testing::random_height_field(7, .5, seed));
    CE::Conformal_metric_solver<> solver(t);
    testing::Random random(seed);
    for(int k = 0; k < 4; ++k)
    {
      Conditions conditions(t);
      if(k != 2) // without any bounds
        for(const Index v : choose(15, t.number_of_vertices(), random, [&](Index w) { return !t.is_border_vertex(w); }))
          conditions.prescribe_angle_sum_above(v, Angle::pi_times(2), random(-.2, .2));
      const Metric fresh = solved(t, conditions);
      const Metric warm = solver.solve(conditions);
      check_solution(t, conditions, warm);
      BOOST_CHECK_SMALL(largest_difference(fresh.log_scale_factors, warm.log_scale_factors), 2 * testing::solved_u);
      const Metric trusting = CE::compute_conformal_metric(t, conditions, params::newton_strategy(CE::Newton_strategy::TRUST_REGION));
      check_solution(t, conditions, trusting);
      BOOST_CHECK_SMALL(largest_difference(fresh.log_scale_factors, trusting.log_scale_factors), 2 * testing::solved_u);
    }
  }
}

BOOST_AUTO_TEST_CASE(lengths_of_any_size)
{
  const Triangulation t = testing::triangulation(testing::random_height_field(6, .5, 3));
  Conditions conditions(t);
  testing::Random random(3);
  for(const Index v : choose(10, t.number_of_vertices(), random, [&](Index w) { return !t.is_border_vertex(w); }))
    conditions.prescribe_angle_sum_above(v, Angle::pi_times(2), random(-.1, .1));
  const Metric expected = solved(t, conditions);
  for(const double size : {1e-150, 1e150})
  {
    Triangulation scaled = t;
    for(Index e = 0; e < t.number_of_edges(); ++e)
      scaled.set_length(e, t.length(e) * size);
    const Metric metric = solved(scaled, conditions);
    BOOST_CHECK_SMALL(largest_difference(metric.log_scale_factors, expected.log_scale_factors), testing::solved_u);
    BOOST_CHECK(metric.active_bounds == expected.active_bounds);
  }
}

BOOST_AUTO_TEST_CASE(many_digits)
{
  const Triangulation t = testing::triangulation(testing::random_height_field(6, .5, 4));
  const CE::Intrinsic_triangulation<Real> wide_t = testing::widened<Real>(t);
  Conditions conditions(t);
  CE::Conformal_conditions<Real> wide_conditions(wide_t);
  testing::Random random(4);
  for(const Index v : choose(10, t.number_of_vertices(), random, [&](Index w) { return !t.is_border_vertex(w); }))
  {
    const double bound = random(-.1, .1);
    conditions.prescribe_angle_sum_above(v, Angle::pi_times(2), bound);
    wide_conditions.prescribe_angle_sum_above(v, CE::Exact_angle<Real>::pi_times(2), Real(bound) + Real(1e-30));
  }
  const Metric rounded = solved(t, conditions);
  const CE::Conformal_metric<Real> metric = CE::compute_conformal_metric(wide_t, wide_conditions, params::gradient_tolerance(1e-13));
  BOOST_REQUIRE_MESSAGE(metric, CE::message(metric.status) << ' ' << metric.amount);
  BOOST_CHECK(metric.active_bounds == rounded.active_bounds);
  BOOST_CHECK(!metric.active_bounds.empty());
  const Violation<Real> violation(t, wide_conditions, metric, metric.active_bounds);
  BOOST_CHECK_LE(violation.angle, 1e-13); // as asked for
  BOOST_CHECK_LE(violation.u, testing::wide_rounding);
}

BOOST_AUTO_TEST_CASE(many_bounds)
{
  const Triangulation t = rough_sphere(1, 4, .003); // 2562 vertices
  testing::Random random(1);
  for(const Index n : {4u, 100u, 1000u, 2562u})
  {
    Conditions conditions(t);
    for(const Index v : choose(n, t.number_of_vertices(), random, [](Index) { return true; }))
      conditions.prescribe_angle_sum_above(v, Angle::pi_times(2), random(-.1, .1));
    const Metric metric = solved(t, conditions, Retriangulation::WHEN_NEEDED);
    const CE::Statistics& figures = metric.statistics;
    BOOST_TEST_MESSAGE(n << " bounds: " << metric.active_bounds.size() << " active, " << figures.number_of_iterations << " Newton steps ("
                         << figures.number_of_discarded_iterations << " discarded), " << figures.number_of_linear_iterations
                         << " linear iterations, " << figures.number_of_factorizations << " factorizations, "
                         << figures.number_of_flips << " flips, " << figures.seconds.solve << " s");
    BOOST_CHECK_LE(figures.number_of_iterations, 30u);
  }
}

} // namespace
