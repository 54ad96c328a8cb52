// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The solver: known solutions, the conditions it takes and refuses, its figures.

#define BOOST_TEST_MODULE test_compute_conformal_metric
#include "include/boost_test.h"
#include "include/index_level.h"
#include "include/wide_angle_sums.h"

#include <CGAL/Conformal_equivalence/Multifrontal_solver_traits.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/discrete_metric.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <new>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace CEi = CE::internal;
namespace params = CGAL::parameters;

using namespace testing;
typedef Wide_real Real;
using CE::Status;

namespace {

const double infinity = std::numeric_limits<double>::infinity();
const double nan = std::numeric_limits<double>::quiet_NaN();

Triangulation wild(unsigned seed) // a rough disk
{
  return testing::triangulation(testing::random_height_field(8, .6, seed));
}

// The largest difference of an angle sum from its target, in 50 digits: nothing of the package's own formulas.
double residual(const Metric& metric, const Conditions& conditions)
{
  const Triangulation& t = metric.triangulation;
  const std::vector<Real> sum = testing::wide_angle_sums(metric);
  Real worst(0);
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v) && !conditions.is_fixed(v))
      worst = (std::max)(worst, Real(abs(Real(sum[v] - conditions.angle_sum(v).radians<Real>()))));
  return static_cast<double>(worst);
}

double largest_difference(const std::vector<double>& u, const std::vector<double>& v)
{
  BOOST_REQUIRE_EQUAL(u.size(), v.size());
  double result = 0;
  for(std::size_t i = 0; i < u.size(); ++i)
    result = (std::max)(result, std::abs(u[i] - v[i]));
  return result;
}

// solved, and what the status promises is true
void check_solution(const Metric& metric, const Conditions& conditions)
{
  BOOST_REQUIRE_MESSAGE(metric.status == Status::OK, CE::message(metric.status) << ' ' << metric.amount);
  BOOST_CHECK_LE(residual(metric, conditions), solver_tolerance);
  BOOST_CHECK_LE(metric.statistics.residual, solver_tolerance);
  for(Index v = 0; v < conditions.size(); ++v)
  {
    BOOST_CHECK_SMALL(static_cast<double>(Real(2 * log(testing::wide(metric.scale_factors[v])) - metric.log_scale_factors[v])),
                      4e-16 * (1 + std::abs(metric.log_scale_factors[v])));
    if(conditions.is_fixed(v) && !metric.triangulation.is_isolated_vertex(v))
      BOOST_CHECK_CLOSE_FRACTION(metric.log_scale_factors[v], conditions.log_scale_factor(v), few_roundings);
  }
  // what is returned are the given lengths, and the scaled ones are equivalent
  Triangulation scaled = metric.triangulation;
  for(Index e = 0; e < scaled.number_of_edges(); ++e)
    scaled.set_length(e, metric.scaled_length(scaled.edge_halfedge(e)));
  BOOST_CHECK(CE::is_valid_metric(scaled));
  BOOST_CHECK(CE::are_conformally_equivalent(metric.triangulation, scaled, 10 * few_roundings));
}

template <typename NamedParameters>
Metric solved(const Triangulation& t, const Conditions& conditions, const NamedParameters& np)
{
  const Metric metric = CE::compute_conformal_metric(t, conditions, np);
  check_solution(metric, conditions);
  return metric;
}

Metric solved(const Triangulation& t, const Conditions& conditions)
{
  return solved(t, conditions, params::default_values());
}

std::vector<double> centered(std::vector<double> u)
{
  double sum = 0;
  for(const double x : u)
    sum += x;
  for(double& x : u)
    x -= sum / double(u.size());
  return u;
}

// ---- known solutions

BOOST_AUTO_TEST_CASE(cones_over_regular_polygons)
{
  for(const Index n : {3, 4, 7, 30})
    for(const double height : {1e-3, .5, 20.})
    {
      const Triangulation t = testing::triangulation(testing::cone(n, height));
      const Conditions conditions(t);
      const Metric metric = solved(t, conditions);
      BOOST_CHECK_SMALL(metric.log_scale_factors[0] + std::log1p(height * height), rounded_u); // e^{u/2} sqrt(1 + h^2) = 1
    }
}

BOOST_AUTO_TEST_CASE(what_is_flat_stays)
{
  for(const testing::Soup& soup : {testing::flat_grid(6), testing::annulus(3, 9), testing::one_triangle({{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}})})
  {
    const Triangulation t = testing::triangulation(soup);
    const Metric metric = solved(t, Conditions(t));
    BOOST_CHECK_EQUAL(metric.statistics.number_of_iterations, 0);
    for(const double u : metric.log_scale_factors)
      BOOST_CHECK_SMALL(u, unmoved_u);
  }
  const Triangulation torus = testing::one_vertex_torus(3., 4., 4.5);
  BOOST_CHECK_EQUAL(solved(torus, Conditions(torus)).log_scale_factors[0], 0);
}

BOOST_AUTO_TEST_CASE(one_triangle_takes_any_angles)
{
  const Triangulation t = testing::triangulation(testing::one_triangle({{0, 0, 0}}, {{3, 0, 0}}, {{1, 2, 1}}));
  Conditions conditions(t);
  for(Index v = 0; v < 3; ++v)
    conditions.prescribe_angle_sum(v, Angle::pi_times(Index(v + 1), 6)); // 30, 60, 90 degrees
  const Metric metric = solved(t, conditions);
  const double scale = metric.scaled_length(1); // opposite to vertex 0
  BOOST_CHECK_CLOSE_FRACTION(metric.scaled_length(2), std::sqrt(3.) * scale, rounded_u); // relative errors of lengths are errors of u
  BOOST_CHECK_CLOSE_FRACTION(metric.scaled_length(0), 2 * scale, rounded_u);
  BOOST_CHECK_SMALL(metric.log_scale_factors[0] + metric.log_scale_factors[1] + metric.log_scale_factors[2], unmoved_u);

  // by fixed factors: nothing is left to find
  Conditions fixed(t);
  for(Index v = 0; v < 3; ++v)
    fixed.fix_log_scale_factor(v, .1 * v);
  const Metric scaled = solved(t, fixed);
  BOOST_CHECK_CLOSE_FRACTION(scaled.scaled_length(2), std::exp(.1) * t.length(2), few_roundings);
}

// Scale a metric, prescribe its curvature, and find the factors again.
BOOST_AUTO_TEST_CASE(curved_and_flat_metrics_on_closed_surfaces)
{
  const Triangulation sphere = testing::triangulation(testing::icosahedron());
  std::vector<double> u = testing::random_numbers(12, .3, 8);
  Conditions conditions(sphere);
  for(Index v = 0; v < 12; ++v)
    conditions.prescribe_angle_sum(v, Angle::pi_times(5, 3));
  Metric metric = solved(CE::apply_log_scale_factors(sphere, u), conditions);
  for(double& x : u)
    x = -x;
  BOOST_CHECK_LE(largest_difference(metric.log_scale_factors, centered(u)), rounded_u);

  // a flat torus of squares with diagonals, in no space; scaled
  const testing::Soup soup = testing::torus(5, 6);
  Triangulation torus = testing::triangulation(soup);
  for(Index h = 0; h < torus.number_of_halfedges(); ++h)
    torus.set_length(torus.edge(h), h % 6 == 2 || h % 6 == 3 ? std::sqrt(2.) : 1.);
  BOOST_CHECK_LE(largest_difference(CE::discrete_curvatures(torus), std::vector<double>(30, 0.)), unmoved_u);
  BOOST_CHECK_LE(largest_difference(solved(torus, Conditions(torus)).log_scale_factors, std::vector<double>(30, 0.)), unmoved_u);
  u = testing::random_numbers(30, .2, 9);
  metric = solved(CE::apply_log_scale_factors(torus, u), Conditions(torus));
  for(double& x : u)
    x = -x;
  BOOST_CHECK_LE(largest_difference(metric.log_scale_factors, centered(u)), rounded_u);
}

BOOST_AUTO_TEST_CASE(fixed_factors_are_met)
{
  const Triangulation t = wild(1);
  Conditions conditions(t);
  const std::vector<double> natural = solved(t, conditions).log_scale_factors;
  const double c = -1.7;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(t.is_border_vertex(v))
      conditions.fix_log_scale_factor(v, c);
  std::vector<double> shifted = solved(t, conditions).log_scale_factors;
  for(double& x : shifted)
    x -= c;
  BOOST_CHECK_LE(largest_difference(shifted, natural), rounded_u);
  // on a flat metric, u is the constant
  const Triangulation flat = testing::triangulation(testing::flat_grid(5));
  Conditions constant(flat);
  for(Index v = 0; v < flat.number_of_vertices(); ++v)
    if(flat.is_border_vertex(v))
      constant.fix_log_scale_factor(v, c);
  BOOST_CHECK_LE(largest_difference(solved(flat, constant).log_scale_factors, std::vector<double>(36, c)), rounded_u);
}

// At every vertex, interior or border, either the factor or the angle sum of a known metric.
BOOST_AUTO_TEST_CASE(any_mixture_of_conditions)
{
  for(const testing::Soup& soup : {testing::hill(7, .5), testing::annulus(3, 10, .4), testing::torus(6, 7), testing::icosphere(1)})
    for(unsigned seed = 0; seed < 3; ++seed)
    {
      const Triangulation t = testing::triangulation(soup);
      const std::vector<double> u = testing::random_numbers(t.number_of_vertices(), .15, seed);
      const Triangulation target = CE::apply_log_scale_factors(t, u);
      BOOST_REQUIRE(CE::is_valid_metric(target));
      const std::vector<double> angle = CE::angle_sums(target);
      testing::Random random(seed);
      Conditions conditions(t);
      for(Index v = 0; v < t.number_of_vertices(); ++v)
      {
        if(v == 0 || random.below(5) == 0)
          conditions.fix_log_scale_factor(v, u[v]);
        else
          conditions.prescribe_angle_sum(v, angle[v]);
      }
      BOOST_CHECK_LE(largest_difference(solved(t, conditions).log_scale_factors, u), solved_u);
    }
}

BOOST_AUTO_TEST_CASE(several_components_and_borders)
{
  const testing::Soup disk = testing::hill(5, .6), ring = testing::annulus(4, 12, .8), torus = testing::torus(7, 6);
  const Triangulation all = testing::triangulation(testing::together({disk, ring, torus}, true));
  const Metric metric = solved(all, Conditions(all));
  std::vector<double> expected;
  for(const testing::Soup& soup : {disk, ring, torus})
  {
    const Triangulation t = testing::triangulation(soup);
    const std::vector<double> u = solved(t, Conditions(t)).log_scale_factors;
    expected.push_back(0); // an isolated vertex
    expected.insert(expected.end(), u.begin(), u.end());
  }
  BOOST_CHECK_LE(largest_difference(metric.log_scale_factors, expected), solved_u);
  for(Index h = 0; h < all.number_of_halfedges(); ++h) // both borders of the annulus are isometric
    if(all.is_border(h))
      BOOST_CHECK_CLOSE_FRACTION(metric.scaled_length(h), all.halfedge_length(h), few_roundings);
}

Conditions rectangle(const Triangulation& t, Index n) // on a grid of n x n squares
{
  Conditions conditions(t);
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(t.is_border_vertex(v))
      conditions.prescribe_angle_sum(v, Angle::pi_times(1));
  for(const Index v : {Index(0), n, n * (n + 1), n * (n + 1) + n})
    conditions.prescribe_angle_sum(v, Angle::pi_times(1, 2));
  return conditions;
}

BOOST_AUTO_TEST_CASE(rectangles)
{
  const Index n = 9;
  const Triangulation t = testing::triangulation(testing::hill(n, .7));
  const Metric metric = solved(t, rectangle(t, n));
  double sum = 0;
  for(const double u : metric.log_scale_factors)
    sum += u;
  BOOST_CHECK_SMALL(sum, solved_u);
  BOOST_CHECK_EQUAL(metric.statistics.angle_defect_spread, 0);
  std::array<double, 4> side = {{0, 0, 0, 0}}; // opposite sides agree
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    const Index v = t.origin(h), w = t.target(h);
    if(t.is_border(h))
      side[v <= n && w <= n ? 0 : v >= n * (n + 1) && w >= n * (n + 1) ? 2 : v % (n + 1) == n ? 1 : 3] += metric.scaled_length(h);
  }
  BOOST_CHECK_CLOSE_FRACTION(side[0], side[2], solved_u);
  BOOST_CHECK_CLOSE_FRACTION(side[1], side[3], solved_u);
}

BOOST_AUTO_TEST_CASE(lengths_of_any_size)
{
  const Triangulation t = wild(2);
  const std::vector<double> u = solved(t, Conditions(t)).log_scale_factors;
  for(const double scale : {1e-150, 1e150})
  {
    std::vector<double> lengths(t.lengths());
    for(double& l : lengths)
      l *= scale;
    const Triangulation far = t.with_lengths(lengths);
    BOOST_CHECK_LE(largest_difference(solved(far, Conditions(far)).log_scale_factors, u), rounded_u);
  }
}

// ---- the method

BOOST_AUTO_TEST_CASE(warm_start_needs_no_new_factor)
{
  const Index n = 10;
  const Triangulation t = testing::triangulation(testing::hill(n, .5));
  CE::Conformal_metric_solver<> solver(t);
  Conditions conditions = rectangle(t, n);
  const Metric first = solver.solve(conditions);
  check_solution(first, conditions);
  BOOST_CHECK_EQUAL(first.statistics.number_of_factorizations, 1);
  BOOST_CHECK_GE(first.statistics.number_of_iterations, 2);

  const Metric again = solver.solve(conditions);
  BOOST_CHECK_EQUAL(again.statistics.number_of_factorizations, 0);
  BOOST_CHECK_EQUAL(again.statistics.number_of_iterations, 0);
  BOOST_CHECK_LE(largest_difference(again.log_scale_factors, first.log_scale_factors), unmoved_u);

  conditions.prescribe_angle_sum(3, Angle::pi_times(11, 12));
  conditions.prescribe_angle_sum(5, Angle::pi_times(13, 12));
  const Metric changed = solver.solve(conditions);
  check_solution(changed, conditions);
  BOOST_CHECK_EQUAL(changed.statistics.number_of_factorizations, 0);
  BOOST_CHECK_LE(largest_difference(changed.log_scale_factors, solved(t, conditions).log_scale_factors), solved_u);

  // other free vertices: a new factor; changed fixed factors: none
  Conditions natural(t);
  check_solution(solver.solve(natural), natural);
  for(Index v = 0; v <= n; ++v)
    natural.fix_log_scale_factor(v, .02 * v);
  const Metric moved = solver.solve(natural);
  check_solution(moved, natural);
  BOOST_CHECK_EQUAL(moved.statistics.number_of_factorizations, 0);
  BOOST_CHECK_LE(largest_difference(moved.log_scale_factors, solved(t, natural).log_scale_factors), solved_u);

  // begin at the solution
  typedef boost::typed_identity_property_map<std::uint32_t> Id;
  const auto initial = boost::make_iterator_property_map(moved.log_scale_factors.begin(), Id());
  BOOST_CHECK_EQUAL(solved(t, natural, params::initial_log_scale_factor_map(initial)).statistics.number_of_iterations, 0);
}

typedef std::vector<std::vector<double> > Dense_matrix;

// Solves A x = b, dense.
std::vector<double> solution(Dense_matrix a, std::vector<double> b)
{
  const std::size_t n = b.size();
  for(std::size_t k = 0; k < n; ++k)
    for(std::size_t i = k + 1; i < n; ++i)
    {
      const double factor = a[i][k] / a[k][k];
      for(std::size_t j = k; j < n; ++j)
        a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  for(std::size_t k = n; k-- > 0; b[k] /= a[k][k])
    for(std::size_t j = k + 1; j < n; ++j)
      b[k] -= a[k][j] * b[j];
  return b;
}

// The cot-Laplace operator 1/2 sum w_ij (u_i - u_j) of all vertices.
Dense_matrix laplace_matrix(const Triangulation& t)
{
  const std::size_t n = t.number_of_vertices();
  Dense_matrix a(n, std::vector<double>(n, 0.));
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    const double x = t.halfedge_length(h), y = t.halfedge_length(t.next(h)), z = t.halfedge_length(t.previous(h));
    const double s = (x + y + z) / 2, area = std::sqrt(s * (s - x) * (s - y) * (s - z));
    const double half_cotangent = (y * y + z * z - x * x) / (8 * area);
    const Index i = t.origin(h), j = t.target(h);
    a[i][i] += half_cotangent;
    a[j][j] += half_cotangent;
    a[i][j] -= half_cotangent;
    a[j][i] -= half_cotangent;
  }
  return a;
}

// The solution of the Poisson equation (12), Delta u = -K, u = 0 on the border.
std::vector<double> poisson_solution(const Triangulation& t)
{
  Dense_matrix a = laplace_matrix(t);
  std::vector<double> b = CE::discrete_curvatures(t);
  for(Index v = 0; v < b.size(); ++v)
  {
    b[v] = t.is_border_vertex(v) ? 0 : -b[v];
    if(t.is_border_vertex(v))
    {
      a[v].assign(b.size(), 0.);
      a[v][v] = 1;
    }
  }
  return solution(a, b);
}

BOOST_AUTO_TEST_CASE(first_newton_step_solves_the_poisson_equation)
{
  for(const testing::Soup& soup : {testing::hill(8, .4), testing::annulus(3, 9, .3), testing::random_height_field(6, .3, 4)})
  {
    const Triangulation t = testing::triangulation(soup);
    const Conditions conditions(t);
    std::vector<char> free;
    std::vector<double> target;
    for(Index v = 0; v < t.number_of_vertices(); ++v)
    {
      free.push_back(conditions.is_fixed(v) ? 0 : 1);
      target.push_back(conditions.is_fixed(v) ? 0 : 2 * CGAL_PI);
    }
    CEi::Fixed_energy<double> energy(t);
    CEi::Laplacian_solver linear(CEi::make_factorization<CE::Simplicial_solver_traits>());
    linear.set_edges(t);
    linear.set_free(free);
    CEi::Newton_options options;
    options.number_of_iterations = 1;
    CE::Statistics statistics;
    const CEi::Any_visitor visitor;
    CEi::Newton_method newton(energy, linear, target, options, statistics, visitor);
    std::vector<double> u(t.number_of_vertices(), 0.);
    BOOST_CHECK(newton(u) == Status::ITERATIONS_EXHAUSTED); // one step is not enough
    BOOST_CHECK_EQUAL(statistics.number_of_iterations, 1);
    BOOST_CHECK_EQUAL(statistics.number_of_factorizations + linear.number_of_factorizations(), 1);
    const std::vector<double> poisson = poisson_solution(t);
    BOOST_CHECK_LE(largest_difference(u, poisson), rounded_u);
    BOOST_CHECK_GT(largest_difference(u, std::vector<double>(u.size(), 0.)), 1e-2);
    // but it is not the flat metric
    BOOST_CHECK_GT(largest_difference(solved(t, conditions).log_scale_factors, poisson), 1e-4);
  }
}

// A factor that is that of other weights is given up as soon as it is seen that it does not do within the iterations allowed, and not before
// that can be seen.
BOOST_AUTO_TEST_CASE(bad_factors_are_given_up)
{
  const Triangulation t = testing::triangulation(testing::hill(12, 1.2));
  const Conditions conditions(t);
  std::vector<char> free;
  std::vector<double> right = testing::random_numbers(t.number_of_vertices(), 1, 3), x;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    free.push_back(conditions.is_fixed(v) ? 0 : 1);
  CEi::Laplacian_solver linear(CEi::make_factorization<CE::Default_solver_traits>());
  linear.set_edges(t);
  linear.set_free(free);
  linear.graph().clear_fixed(right);
  const std::vector<double> good(t.number_of_edges(), 1.);
  std::vector<double> bad = testing::random_numbers(t.number_of_edges(), 6, 5);
  for(double& w : bad)
    w = std::exp(w);
  const std::size_t most = 20;
  const double accuracy = 1e-12;
  bool converged = false;
  BOOST_REQUIRE(linear.factorize(bad));
  const std::size_t number = linear.conjugate_gradients(good, right, accuracy, most, true, x, converged);
  BOOST_CHECK(!converged && number >= 5 && number < most);
  BOOST_CHECK_EQUAL(linear.conjugate_gradients(good, right, accuracy, most, false, x, converged), most);
  BOOST_CHECK(!converged);

  // one that is nearly right serves to the end
  std::vector<double> nearly = good;
  for(std::size_t e = 0; e < nearly.size(); e += 3)
    nearly[e] = 1.2;
  BOOST_REQUIRE(linear.factorize(nearly));
  for(const bool may_give_up : {true, false})
  {
    BOOST_CHECK_LE(linear.conjugate_gradients(good, right, accuracy, most, may_give_up, x, converged), most);
    BOOST_CHECK(converged);
    const std::vector<double> product = linear.graph().product(good, x);
    BOOST_CHECK_LE(largest_difference(product, right), 2 * accuracy); // the entries of `right` are at most 1
  }
}

BOOST_AUTO_TEST_CASE(both_strategies_find_the_same)
{
  for(unsigned seed = 0; seed < 4; ++seed)
  {
    const Triangulation t = seed == 0 ? testing::triangulation(testing::hill(12, 1.2)) : wild(seed);
    const Conditions conditions(t);
    const Metric a = solved(t, conditions, params::newton_strategy(CE::Newton_strategy::LINE_SEARCH));
    const Metric b = solved(t, conditions, params::newton_strategy(CE::Newton_strategy::TRUST_REGION));
    BOOST_CHECK_LE(largest_difference(a.log_scale_factors, b.log_scale_factors), solved_u);
    BOOST_CHECK_LE(a.statistics.number_of_iterations, 10);
    BOOST_CHECK_LE(b.statistics.number_of_iterations, 20);
  }
}

// Far away from the solution, across broken triangles.
BOOST_AUTO_TEST_CASE(both_strategies_come_back_from_afar)
{
  const Triangulation t = testing::triangulation(testing::hill(8, .5));
  const Conditions conditions(t);
  const std::vector<double> u = solved(t, conditions).log_scale_factors;
  for(const double distance : {1., 4., 16., 64.})
    for(unsigned int seed = 1; seed <= 8; ++seed)
    {
      const std::vector<double> far = testing::random_numbers(u.size(), distance, seed);
      const auto initial = boost::make_iterator_property_map(far.begin(), boost::typed_identity_property_map<std::uint32_t>());
      for(const CE::Newton_strategy strategy : {CE::Newton_strategy::LINE_SEARCH, CE::Newton_strategy::TRUST_REGION})
      {
        const Metric metric = solved(t, conditions, params::newton_strategy(strategy).initial_log_scale_factor_map(initial));
        BOOST_CHECK_LE(largest_difference(metric.log_scale_factors, u), solved_u);
      }
    }
}

// A tolerance that no number type here can meet: what can be reached is reported, not promised.
BOOST_AUTO_TEST_CASE(rounding_is_admitted)
{
  const Triangulation t = testing::triangulation(testing::hill(8, .5));
  const Conditions conditions(t);
  const Metric metric = CE::compute_conformal_metric(t, conditions, params::gradient_tolerance(1e-40));
  BOOST_REQUIRE(metric.status == Status::CONVERGED_TO_ROUNDING);
  BOOST_CHECK(bool(metric));
  BOOST_CHECK_GT(metric.amount, 1e-40);
  BOOST_CHECK_LE(metric.amount, 1e-28); // the residual of a pair of doubles
  BOOST_CHECK_LE(metric.amount, metric.statistics.residual_floor);
  BOOST_CHECK_LE(largest_difference(metric.log_scale_factors, solved(t, conditions).log_scale_factors), solved_u);
}

// ---- the factorization of the package

CEi::Lower_half sparse(const Dense_matrix& a)
{
  CEi::Lower_half result;
  for(std::size_t j = 0; j < a.size(); ++j)
  {
    for(std::size_t i = j; i < a.size(); ++i)
      if(a[i][j] != 0 || i == j)
      {
        result.row.push_back(int(i));
        result.value.push_back(a[i][j]);
      }
    result.first.push_back(int(result.row.size()));
  }
  return result;
}

// About so many entries in a row, some of them in rows of their own blocks only; positive definite, as its diagonal dominates.
Dense_matrix random_matrix(std::size_t n, double entries_in_a_row, unsigned seed)
{
  testing::Random random(seed);
  Dense_matrix a(n, std::vector<double>(n, 0.));
  for(std::size_t i = 0; i < n; ++i)
    a[i][i] = random(1e-3, 1);
  for(std::size_t i = 0; i < n; ++i)
    for(std::size_t j = 0; j < i; ++j)
      if(random(0, double(n)) < entries_in_a_row && (seed % 2 == 0 || i % 3 == j % 3))
      {
        a[i][j] = a[j][i] = random(-1, 1);
        a[i][i] += std::abs(a[i][j]);
        a[j][j] += std::abs(a[i][j]);
      }
  return a;
}

// The matrix of all inner vertices.
Dense_matrix laplacian(const Triangulation& t)
{
  std::vector<Index> inner;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_border_vertex(v))
      inner.push_back(v);
  const Dense_matrix all = laplace_matrix(t);
  Dense_matrix result;
  for(const Index i : inner)
  {
    result.emplace_back();
    for(const Index j : inner)
      result.back().push_back(all[i][j]);
  }
  return result;
}

CEi::Elimination_order random_order(std::size_t n, unsigned seed)
{
  std::vector<int> unknowns(n);
  std::iota(unknowns.begin(), unknowns.end(), 0);
  std::shuffle(unknowns.begin(), unknowns.end(), std::mt19937(seed));
  return CEi::Elimination_order(unknowns);
}

// What is computed solves (A + D) x = b with |D_ij| <= (3 n + 1) u sqrt(A_ii A_jj), where u is the unit roundoff (N. J. Higham, Accuracy and
// Stability of Numerical Algorithms, 2002, theorem 10.4 with |R^T| |R| bounded by Cauchy and Schwarz); in single precision the entries of A and b
// and those of x are rounded, too.
template <typename Number>
void check_backward_error(const Dense_matrix& a, const CEi::Elimination_order& order, int least_size_of_groups)
{
  const CEi::Lower_half lower = sparse(a);
  CEi::Multifrontal_factor<Number> factor(std::make_shared<CEi::Symbolic_factor>(lower, order, least_size_of_groups), CEi::Concurrency(2));
  for(int repetition = 0; repetition < 2; ++repetition) // memory is used again
    BOOST_REQUIRE(factor.factorize(lower));
  const double roundoff = double(std::numeric_limits<Number>::epsilon()) / 2, n = double(a.size());
  for(unsigned seed = 0; seed < 4; ++seed)
  {
    std::vector<double> b = testing::random_numbers(a.size(), 1, seed), x;
    for(std::size_t i = 0; i < a.size(); ++i)
      b[i] *= seed < 3 || i == a.size() / 2 ? std::sqrt(a[i][i]) : 0; // the last right side has a single entry
    x = b;
    factor.solve(x);
    double size = 0, largest_b = 0;
    for(std::size_t j = 0; j < a.size(); ++j)
    {
      size += std::sqrt(a[j][j]) * std::abs(x[j]);
      largest_b = (std::max)(largest_b, std::abs(b[j]) / std::sqrt(a[j][j]));
    }
    for(std::size_t i = 0; i < a.size(); ++i)
    {
      double difference = b[i] / std::sqrt(a[i][i]);
      for(std::size_t j = 0; j < a.size(); ++j)
        difference -= a[i][j] / std::sqrt(a[i][i]) * x[j];
      BOOST_CHECK_LE(std::abs(difference), (3 * n + 5) * roundoff * (size + largest_b));
    }
  }
}

void check_backward_errors(const Dense_matrix& a)
{
  for(const int least_size_of_groups : {0, 1000})
  {
    check_backward_error<double>(a, CEi::Elimination_order(sparse(a)), least_size_of_groups);
    check_backward_error<float>(a, CEi::Elimination_order(sparse(a)), least_size_of_groups);
    check_backward_error<double>(a, random_order(a.size(), 1), least_size_of_groups);
    check_backward_error<float>(a, random_order(a.size(), 2), least_size_of_groups);
  }
}

BOOST_AUTO_TEST_CASE(factor_of_random_matrices)
{
  for(const std::size_t n : {0, 1, 2, 3, 5, 9, 20, 50, 130})
    for(const double entries : {0., 1., 3., 10., 1000.}) // diagonal ... dense, which makes fronts of several blocks
      for(unsigned seed = 0; seed < 3; ++seed)
        check_backward_errors(random_matrix(n, entries, seed));
}

BOOST_AUTO_TEST_CASE(factor_of_laplacians)
{
  for(const testing::Soup& soup : {testing::hill(14, .8), testing::annulus(5, 40, .3), testing::random_height_field(16, .5, 3)})
    check_backward_errors(laplacian(testing::triangulation(soup)));
}

// Scaling by powers of two changes nothing but exponents.
BOOST_AUTO_TEST_CASE(factor_of_numbers_of_any_size)
{
  const Dense_matrix a = random_matrix(30, 4, 6);
  testing::Random random(1);
  std::vector<double> scale(a.size());
  for(double& s : scale)
    s = std::ldexp(1., int(random(-240, 240)));
  Dense_matrix scaled = a;
  for(std::size_t i = 0; i < a.size(); ++i)
    for(std::size_t j = 0; j < a.size(); ++j)
      scaled[i][j] *= scale[i] * scale[j];
  CEi::Mixed_precision_factor<float, double> factor, factor_of_scaled;
  factor.analyze(sparse(a));
  factor_of_scaled.analyze(sparse(a));
  BOOST_REQUIRE(factor.factorize(sparse(a)));
  BOOST_REQUIRE(factor_of_scaled.factorize(sparse(scaled)));
  for(const bool is_precise : {false, true})
  {
    std::vector<double> x = testing::random_numbers(a.size(), 1, 3), y = x;
    for(std::size_t i = 0; i < a.size(); ++i)
      y[i] *= scale[i];
    BOOST_CHECK(is_precise ? factor.solve(x) : factor.precondition(x));
    BOOST_CHECK(is_precise ? factor_of_scaled.solve(y) : factor_of_scaled.precondition(y));
    for(std::size_t i = 0; i < a.size(); ++i)
      BOOST_CHECK_EQUAL(y[i] * scale[i], x[i]);
  }
}

BOOST_AUTO_TEST_CASE(no_factor_of_what_is_not_positive_definite)
{
  const auto has_factor = [](const Dense_matrix& a)
  {
    CEi::Mixed_precision_factor<float, double> factor;
    factor.analyze(sparse(a));
    std::vector<double> x(a.size(), 1.);
    const bool result = factor.factorize(sparse(a));
    BOOST_CHECK_EQUAL(factor.precondition(x), result);
    BOOST_CHECK_EQUAL(factor.solve(x), result);
    return result;
  };
  BOOST_CHECK(has_factor(Dense_matrix()));
  BOOST_CHECK(has_factor({{1e-150}}));
  for(const double x : {0., -1., nan, infinity, -infinity})
    BOOST_CHECK(!has_factor({{x}}));
  BOOST_CHECK(!has_factor({{1, 1}, {1, 1}}));
  BOOST_CHECK(!has_factor({{1, 2}, {2, 1}}));
  BOOST_CHECK(!has_factor({{1, nan}, {nan, 1}}));
  BOOST_CHECK(!has_factor({{1, infinity}, {infinity, 1}}));
  BOOST_CHECK(has_factor({{1, 1 - 1e-12}, {1 - 1e-12, 1}})); // in double
  for(std::size_t n = 2; n < 60; n += 7)
    for(std::size_t i = 0; i < n; i += 5)
    {
      Dense_matrix a = random_matrix(n, 3, unsigned(n));
      BOOST_CHECK(has_factor(a));
      a[i][i] = -a[i][i];
      BOOST_CHECK(!has_factor(a));
      a[i][i] = nan;
      BOOST_CHECK(!has_factor(a));
    }
}

// Dense, by the definition: the structure of column j is that of the matrix and those of the columns for which j is the first row below the diagonal.
BOOST_AUTO_TEST_CASE(structure_of_the_factor)
{
  for(unsigned seed = 0; seed < 40; ++seed)
  {
    const std::size_t n = 1 + seed * 3 % 41;
    const CEi::Lower_half a = sparse(random_matrix(n, 1 + seed % 4, seed));
    const CEi::Symbolic_factor symbolic(a, seed % 2 == 0 ? CEi::Elimination_order(a) : random_order(n, seed));
    const std::vector<int> position = CEi::inverse_permutation(symbolic.unknowns);
    std::vector<std::set<int> > column(n);
    for(std::size_t j = 0; j < n; ++j)
      for(int k = a.first[j]; k < a.first[j + 1]; ++k)
        if(a.row[k] != int(j))
          column[(std::min)(position[j], position[a.row[k]])].insert((std::max)(position[j], position[a.row[k]]));
    std::vector<int> parent(n, -1), count(n);
    for(std::size_t j = 0; j < n; ++j)
    {
      count[j] = 1 + int(column[j].size());
      if(column[j].empty())
        continue;
      parent[j] = *column[j].begin();
      column[parent[j]].insert(std::next(column[j].begin()), column[j].end());
    }
    namespace tree = CEi::elimination_tree;
    BOOST_CHECK(tree::parents(tree::ordered_pattern(a, position, false)) == parent);
    BOOST_CHECK(tree::column_counts(tree::ordered_pattern(a, position, true), parent) == count);
    std::size_t columns = 0;
    for(const CEi::Symbolic_factor::Supernode& node : symbolic.supernodes)
    {
      BOOST_CHECK_EQUAL(node.first_column, int(columns));
      std::set<int> rows(symbolic.rows.begin() + node.first_row, symbolic.rows.begin() + node.first_row + node.number_of_rows);
      for(; int(columns) < node.end_column(); ++columns)
        for(const int row : column[columns])
          BOOST_CHECK(row < node.end_column() || rows.count(row) == 1);
    }
    BOOST_CHECK_EQUAL(columns, n);
  }
}

// Subtrees and top make up all supernodes, each once; nothing but the top is above a subtree; and no vector reaches from the panels of one
// group to those of another.
BOOST_AUTO_TEST_CASE(groups_of_subtrees)
{
  std::size_t in_top = 0;
  for(const testing::Soup& soup : {testing::hill(14, .8), testing::annulus(5, 40, .3), testing::random_height_field(24, .5, 3)})
  {
    const CEi::Lower_half a = sparse(laplacian(testing::triangulation(soup)));
    const CEi::Symbolic_factor symbolic(a, CEi::Elimination_order(a), 0);
    std::vector<int> group(symbolic.supernodes.size(), -1);
    for(std::size_t g = 0; g < symbolic.groups.size(); ++g)
      for(const CEi::Symbolic_factor::Subtree& subtree : symbolic.groups[g])
        for(int s = subtree.first; s < subtree.end; ++s)
        {
          BOOST_CHECK_EQUAL(group[s], -1);
          group[s] = int(g);
          const CEi::Symbolic_factor::Supernode& node = symbolic.supernodes[s];
          for(int i = 0; i < node.number_of_rows; ++i)
          {
            const int row = symbolic.rows[node.first_row + i];
            BOOST_CHECK((row < symbolic.supernodes[subtree.end - 1].end_column()) == (symbolic.place_in_top[row] == CEi::Symbolic_factor::none));
          }
        }
    for(const int s : symbolic.top)
    {
      BOOST_CHECK_EQUAL(group[s], -1);
      group[s] = 100;
    }
    in_top += symbolic.top.size();
    BOOST_CHECK(std::count(group.begin(), group.end(), -1) == 0);
    for(std::size_t s = 0; s + 1 < group.size(); ++s)
    {
      const std::size_t end = symbolic.supernodes[s].panel + symbolic.supernodes[s].panel_size();
      BOOST_CHECK(symbolic.supernodes[s + 1].panel >= end + (group[s] == group[s + 1] ? 0 : CEi::Symbolic_factor::gap));
    }
  }
  BOOST_CHECK(in_top > 0);
}

// The lower half of a matrix with ones where unknowns are adjacent.
CEi::Lower_half adjacency(std::size_t n, std::vector<std::pair<Index, Index> > edges)
{
  for(std::pair<Index, Index>& edge : edges)
    edge = std::minmax(Index(edge.first), Index(edge.second));
  for(Index v = 0; v < n; ++v)
    edges.emplace_back(v, v);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  CEi::Lower_half result;
  for(const std::pair<Index, Index>& edge : edges)
  {
    while(result.first.size() <= edge.first)
      result.first.push_back(int(result.row.size()));
    result.row.push_back(int(edge.second));
    result.value.push_back(edge.first == edge.second ? 7 : -1);
  }
  result.first.push_back(int(result.row.size()));
  return result;
}

std::vector<std::pair<Index, Index> > edges_of(const Triangulation& t)
{
  std::vector<std::pair<Index, Index> > result;
  for(Index e = 0; e < t.number_of_edges(); ++e)
    result.emplace_back(t.origin(t.edge_halfedge(e)), t.target(t.edge_halfedge(e)));
  return result;
}

// Every vertex is in one set; vertices of two sets are adjacent only if one set is a separator of the other: above it in the tree.
BOOST_AUTO_TEST_CASE(separators_separate)
{
  std::vector<std::vector<std::pair<Index, Index> > > graphs;
  std::vector<std::size_t> numbers_of_vertices;
  const auto add = [&](std::size_t n, const std::vector<std::pair<Index, Index> >& edges)
  {
    numbers_of_vertices.push_back(n);
    graphs.push_back(edges);
  };
  for(const testing::Soup& soup : {testing::flat_grid(40), testing::torus(30, 50, 2, .8),
                                   testing::together({testing::hill(20, .3), testing::flat_grid(15)}, true)})
  {
    const Triangulation t = testing::triangulation(soup);
    add(t.number_of_vertices(), edges_of(t));
  }
  const std::size_t surfaces = graphs.size();
  add(500, {});
  std::vector<std::pair<Index, Index> > star;
  for(Index v = 1; v < 500; ++v)
    star.emplace_back(0, v);
  add(500, star);
  for(std::size_t g = 0; g < graphs.size(); ++g)
    for(const int levels : {1, 2, 4})
    {
      const std::size_t n = numbers_of_vertices[g];
      std::vector<int> first(n + 1, 0), neighbor;
      std::vector<std::vector<int> > neighbors(n);
      for(const std::pair<Index, Index>& edge : graphs[g])
      {
        neighbors[edge.first].push_back(int(edge.second));
        neighbors[edge.second].push_back(int(edge.first));
      }
      for(std::size_t v = 0; v < n; ++v)
      {
        neighbor.insert(neighbor.end(), neighbors[v].begin(), neighbors[v].end());
        first[v + 1] = int(neighbor.size());
      }
      const CEi::Nested_dissection dissection(first, neighbor, levels);
      const std::vector<std::vector<int> > sets = dissection.sets();
      BOOST_REQUIRE_EQUAL(sets.size(), (std::size_t(2) << levels) - 1);
      std::vector<std::size_t> node(n, 0); // of the tree, in which the root is 1
      std::size_t separating = 0;
      for(std::size_t s = 0; s < sets.size(); ++s)
        for(const int v : sets[s])
        {
          BOOST_CHECK_EQUAL(node[v], 0);
          node[v] = sets.size() - s;
          separating += s >= dissection.number_of_parts() ? 1 : 0;
        }
      BOOST_CHECK_EQUAL(std::count(node.begin(), node.end(), std::size_t(0)), 0);
      BOOST_CHECK_EQUAL(separating, dissection.number_of_separating_vertices());
      for(const std::pair<Index, Index>& edge : graphs[g])
      {
        std::size_t lower = (std::max)(node[edge.first], node[edge.second]);
        const std::size_t upper = (std::min)(node[edge.first], node[edge.second]);
        while(lower > upper)
          lower /= 2;
        BOOST_CHECK_EQUAL(lower, upper);
      }
      if(g < surfaces) // 2^k separators, each not much longer than the side of a square of its part
        BOOST_CHECK_LE(double(separating), 2 * std::sqrt(double(n)) * (std::pow(2., levels / 2.) - 1) / (std::sqrt(2.) - 1));
    }
}

// An order by parts is a permutation, is the same with any number of threads, and makes no worse factor than that of minimum degree alone.
BOOST_AUTO_TEST_CASE(order_of_large_systems)
{
  const Triangulation t = testing::triangulation(testing::flat_grid(190));
  const CEi::Lower_half a = adjacency(t.number_of_vertices(), edges_of(t));
  const CEi::Elimination_order order(a), by_two(a, CEi::Concurrency(2));
  BOOST_CHECK(order.unknowns() == by_two.unknowns());
  std::vector<int> sorted = order.unknowns();
  std::sort(sorted.begin(), sorted.end());
  for(int i = 0; i < int(t.number_of_vertices()); ++i)
    BOOST_REQUIRE_EQUAL(sorted[i], i);
  const CEi::Symbolic_factor symbolic(a, order);
  const double n = double(t.number_of_vertices());
  BOOST_CHECK_LE(double(symbolic.number_of_values), 31 / 4. * n * std::log2(n)); // of a square grid (A. George, 1973)
  const CEi::Symbolic_factor symbolic_by_two(a, order, int(CEi::Symbolic_factor::usual_size_of_groups), CEi::Concurrency(2));
  BOOST_CHECK(symbolic.rows == symbolic_by_two.rows);
  BOOST_CHECK(symbolic.rows_in_parent == symbolic_by_two.rows_in_parent);
  BOOST_CHECK(std::equal(symbolic.entries.begin(), symbolic.entries.end(), symbolic_by_two.entries.begin(), symbolic_by_two.entries.end(),
                         [](const auto& x, const auto& y) { return x.row == y.row && x.source == y.source; }));

  // one vertex that is adjacent to all others: no surface, but a matrix
  std::vector<std::pair<Index, Index> > star;
  for(Index v = 1; v < 40000; ++v)
    star.emplace_back(0, v);
  sorted = CEi::Elimination_order(adjacency(40000, star)).unknowns();
  std::sort(sorted.begin(), sorted.end());
  for(int i = 0; i < 40000; ++i)
    BOOST_REQUIRE_EQUAL(sorted[i], i);
}

// A front that several threads eliminate, block by block, is the same: what counts of it, its lower half.
BOOST_AUTO_TEST_CASE(fronts_do_not_depend_on_the_number_of_threads)
{
  typedef CEi::Dense_front<float> Front;
  for(const std::pair<int, int>& shape : {std::make_pair(150, 201), std::make_pair(64, 3), std::make_pair(131, 0)})
  {
    const int columns = shape.first, rows = shape.second, size = columns + rows;
    std::vector<float> panel(std::size_t(columns * size + Front::overhang)), update(std::size_t(rows * rows + Front::overhang), 0.f);
    const std::vector<double> random = testing::random_numbers(panel.size(), 1, 7);
    for(int j = 0; j < columns; ++j)
      for(int i = j; i < size; ++i)
        panel[std::size_t(j * size + i)] = i == j ? float(size) : float(random[std::size_t(j * size + i)]); // diagonally dominant
    std::vector<float> panel_by_two(panel), update_by_two(update);
    float pivot = 1e30f, pivot_by_two = 1e30f;
    BOOST_REQUIRE(Front::eliminate(panel.data(), update.data(), columns, rows, pivot));
    BOOST_REQUIRE(Front::eliminate(panel_by_two.data(), update_by_two.data(), columns, rows, pivot_by_two, CEi::Concurrency(2)));
    BOOST_CHECK_EQUAL(pivot, pivot_by_two);
    int different = 0;
    for(int j = 0; j < size; ++j)
      for(int i = j; i < size; ++i)
      {
        const bool is_in_panel = j < columns;
        const std::size_t k = std::size_t(is_in_panel ? j * size + i : (j - columns) * rows + i - columns);
        different += is_in_panel ? panel[k] != panel_by_two[k] : update[k] != update_by_two[k];
      }
    BOOST_CHECK_EQUAL(different, 0);
  }
}

// Of surfaces large enough that there is something to share.
BOOST_AUTO_TEST_CASE(results_do_not_depend_on_the_number_of_threads)
{
  for(const bool is_flipped : {false, true})
  {
    const Triangulation t = testing::triangulation(is_flipped ? testing::random_height_field(110, 4, 3) : testing::hill(190, .6));
    const CE::Conformal_conditions<double> conditions(t);
    const CE::Retriangulation retriangulation = is_flipped ? CE::Retriangulation::ALWAYS : CE::Retriangulation::NEVER;
    CE::Conformal_metric<double> first;
    for(const unsigned number : {1u, 2u, 3u})
    {
      const auto metric = CE::compute_conformal_metric(t, conditions, CGAL::parameters::number_of_threads(number).retriangulation(retriangulation));
      BOOST_CHECK(metric.status == Status::OK);
      BOOST_CHECK_EQUAL(metric.flips.empty(), !is_flipped);
      if(number == 1)
        first = metric;
      BOOST_CHECK(metric.log_scale_factors == first.log_scale_factors);
      BOOST_CHECK(metric.scale_factors == first.scale_factors);
      BOOST_CHECK(metric.flips == first.flips);
      BOOST_CHECK(metric.statistics.residuals == first.statistics.residuals);
    }
  }
}

// The factor in single precision of one Laplacian is all that conjugate gradients need to get twelve digits in a few steps.
BOOST_AUTO_TEST_CASE(single_precision_preconditions)
{
  const Triangulation t = testing::triangulation(testing::random_height_field(60, .5, 3));
  CEi::Fixed_energy<double> energy(t);
  energy.evaluate(std::vector<double>(t.number_of_vertices(), 0.));
  std::vector<char> free;
  std::vector<double> b = testing::random_numbers(t.number_of_vertices(), 1, 3), x, y;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
  {
    free.push_back(t.is_border_vertex(v) ? 0 : 1);
    b[v] *= free[v];
  }
  CEi::Laplacian_solver linear(CEi::make_factorization<CE::Multifrontal_solver_traits>());
  linear.set_edges(t);
  linear.set_free(free);
  BOOST_REQUIRE(linear.factorize(energy.weights()));
  bool converged = false;
  BOOST_CHECK_LE(linear.conjugate_gradients(energy.weights(), b, 1e-12, 10, false, x, converged), 4);
  BOOST_CHECK(converged);
  BOOST_REQUIRE(linear.solve(b, y));
  double largest = 0;
  for(const double entry : y)
    largest = (std::max)(largest, std::abs(entry));
  BOOST_CHECK_LE(largest_difference(x, y), 1e-10 * largest);
}

// ---- linear solvers of others

BOOST_AUTO_TEST_CASE(solvers_of_the_user)
{
  typedef CGAL::Eigen_sparse_matrix<double>::EigenType Matrix;
  const Triangulation t = wild(5);
  const Conditions conditions(t);
  const std::vector<double> u = solved(t, conditions).log_scale_factors;
  const auto check = [&](const auto& traits)
  {
    BOOST_CHECK_LE(largest_difference(solved(t, conditions, params::gradient_tolerance(solver_tolerance).sparse_linear_solver(traits))
                                      .log_scale_factors, u), solved_u);
  };
  check(CE::Multifrontal_solver_traits());
  check(CE::Simplicial_solver_traits());
  check(CGAL::Eigen_solver_traits<Eigen::SparseLU<Matrix> >());
  check(CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT<Matrix> >());
  check(CGAL::Eigen_solver_traits<Eigen::ConjugateGradient<CGAL::Eigen_sparse_symmetric_matrix<double>::EigenType> >());
}

typedef CGAL::Eigen_solver_traits<Eigen::SimplicialLDLT<CGAL::Eigen_sparse_matrix<double>::EigenType> > Plain_traits;

struct Failing_traits : Plain_traits
{
  bool factor(const Matrix&, NT&) { return false; }
};

struct Greedy_traits : Plain_traits
{
  bool factor(const Matrix&, NT&) { throw std::bad_alloc(); }
};

BOOST_AUTO_TEST_CASE(failures_of_the_linear_solver)
{
  const Triangulation t = testing::triangulation(testing::hill(8, .5));
  const Conditions conditions(t);
  const auto np = params::gradient_tolerance(solver_tolerance);
  const Metric singular = CE::compute_conformal_metric(t, conditions, np.sparse_linear_solver(Failing_traits()));
  BOOST_CHECK(singular.status == Status::SINGULAR_PROBLEM);
  BOOST_CHECK(singular.log_scale_factors.empty());
  const Metric greedy = CE::compute_conformal_metric(t, conditions, np.sparse_linear_solver(Greedy_traits()));
  BOOST_CHECK(greedy.status == Status::OUT_OF_MEMORY);
  BOOST_CHECK(greedy.log_scale_factors.empty());
  BOOST_CHECK_EQUAL(greedy.triangulation.number_of_faces(), t.number_of_faces());
}

struct Watch
{
  std::size_t stages = 0, iterations = 0, most = 1000;
  std::vector<double> residuals;
  void on_stage(CE::Stage stage) { stages += stage == CE::Stage::SOLVE ? 1 : 0; }
  void on_iteration(std::size_t iteration, double r)
  {
    BOOST_CHECK_EQUAL(iteration, iterations++);
    residuals.push_back(r);
  }
  bool go_further() { return iterations < most; }
};

BOOST_AUTO_TEST_CASE(visitors_watch_and_stop)
{
  const Triangulation t = wild(6);
  const Conditions conditions(t);
  Watch watch;
  const Metric metric = solved(t, conditions, params::gradient_tolerance(solver_tolerance).visitor(std::ref(watch)));
  BOOST_CHECK_EQUAL(watch.stages, 1);
  BOOST_CHECK_EQUAL(watch.iterations, metric.statistics.number_of_iterations + 1);
  BOOST_CHECK_GT(watch.residuals.front(), 1e-2); // there is something to do
  Watch stop;
  stop.most = 2;
  const Metric stopped = CE::compute_conformal_metric(t, conditions, params::gradient_tolerance(solver_tolerance).visitor(std::ref(stop)));
  BOOST_CHECK(stopped.status == Status::STOPPED_BY_VISITOR && !stopped);
  BOOST_CHECK_EQUAL(stop.iterations, 2);
  BOOST_CHECK(stopped.log_scale_factors.empty() && stopped.scale_factors.empty());
}

BOOST_AUTO_TEST_CASE(few_iterations_are_said_to_be_too_few)
{
  const Triangulation t = wild(6);
  const Metric metric = CE::compute_conformal_metric(t, Conditions(t), params::gradient_tolerance(solver_tolerance).number_of_iterations(1));
  BOOST_CHECK(metric.status == Status::ITERATIONS_EXHAUSTED);
  BOOST_CHECK_GT(metric.amount, solver_tolerance);
  BOOST_CHECK(metric.log_scale_factors.empty());
}

// Conditions at vertices without faces mean nothing.
BOOST_AUTO_TEST_CASE(conditions_at_isolated_vertices_are_not_read)
{
  const Triangulation t = testing::triangulation(testing::together({testing::hill(3, .2)}, true));
  Conditions conditions(t);
  BOOST_REQUIRE(t.is_isolated_vertex(0));
  const std::vector<double> expected = solved(t, conditions).log_scale_factors;
  for(bool is_fixed : {false, true})
  {
    if(is_fixed)
      conditions.fix_log_scale_factor(0, std::numeric_limits<double>::quiet_NaN());
    else
      conditions.prescribe_angle_sum(0, std::numeric_limits<double>::quiet_NaN());
    const Metric metric = CE::compute_conformal_metric(t, conditions);
    BOOST_CHECK(metric.status == Status::OK);
    for(Index v = 1; v < t.number_of_vertices(); ++v)
      BOOST_CHECK_EQUAL(metric.log_scale_factors[v], expected[v]);
  }
}

// du/dt = K^ - K~ (section 2.2), by Euler's method, ends at the minimizer.
BOOST_AUTO_TEST_CASE(curvature_flow_reaches_the_same_factors)
{
  const Triangulation t = testing::triangulation(testing::torus(5, 5, 2, .8));
  const std::vector<double> u = solved(t, Conditions(t)).log_scale_factors;
  std::vector<double> flow(u.size(), 0.);
  CEi::Conformal_energy<double> energy(t);
  for(int i = 0; i < 2000; ++i)
  {
    energy.evaluate(flow);
    for(Index v = 0; v < flow.size(); ++v)
      flow[v] += .1 * (energy.angle_sums()[v] - 2 * CGAL_PI);
  }
  BOOST_CHECK_GT(largest_difference(u, std::vector<double>(u.size(), 0.)), .1);
  BOOST_CHECK_LE(largest_difference(centered(flow), u), solved_u);
}

BOOST_AUTO_TEST_CASE(fifty_digits)
{
  typedef CE::Intrinsic_triangulation<Real> Wide_triangulation;
  const Wide_triangulation t = testing::triangulation<Real>(testing::random_height_field(5, .5, 7));
  const auto metric = CE::compute_conformal_metric(t, CE::Conformal_conditions<Real>(t), params::gradient_tolerance(1e-45));
  BOOST_REQUIRE(metric.status == Status::OK);
  const std::vector<Real> k = CE::discrete_curvatures(CE::apply_log_scale_factors(t, metric.log_scale_factors));
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_border_vertex(v))
      BOOST_CHECK_LE(abs(k[v]), Real("1e-44")); // what was asked for, and rounding
}

// ---- what has no solution

Metric refused(const Triangulation& t, const Conditions& conditions, Status status)
{
  const Metric metric = CE::compute_conformal_metric(t, conditions, params::retriangulation(CE::Retriangulation::NEVER));
  BOOST_CHECK_MESSAGE(metric.status == status, CE::message(metric.status) << " instead of " << CE::message(status));
  BOOST_CHECK(metric.log_scale_factors.empty() && metric.scale_factors.empty());
  BOOST_CHECK_EQUAL(metric.statistics.number_of_iterations, 0);
  return metric;
}

BOOST_AUTO_TEST_CASE(impossible_conditions_are_refused)
{
  refused(Triangulation(), Conditions(Triangulation()), Status::EMPTY_MESH);
  refused(Triangulation(3, {}, {}), Conditions(Triangulation(3, {}, {})), Status::EMPTY_MESH);

  const Index n = 4, inner = 2 * (n + 1) + 2;
  const Triangulation t = testing::triangulation(testing::hill(n, .3));
  for(const double bad : {nan, infinity, -infinity})
  {
    Conditions conditions(t);
    conditions.fix_log_scale_factor(3, bad);
    BOOST_CHECK(refused(t, conditions, Status::INVALID_NUMBER).vertices == std::vector<Index>{3});
    conditions = Conditions(t);
    conditions.prescribe_angle_sum(inner, bad);
    BOOST_CHECK(refused(t, conditions, Status::INVALID_NUMBER).vertices == std::vector<Index>{inner});
  }
  for(const double bad : {0., -1., double(t.degree(inner)) * CGAL_PI, 100.})
  {
    Conditions conditions(t);
    conditions.prescribe_angle_sum(inner, bad);
    const Metric metric = refused(t, conditions, Status::ANGLE_OUT_OF_RANGE);
    BOOST_CHECK(metric.vertices == std::vector<Index>{inner});
    BOOST_CHECK_CLOSE_FRACTION(metric.amount + 1, bad + 1, few_roundings);
  }
  // corner 0 of two triangles and corner n of one: pi there is too much
  Conditions straight = rectangle(t, n);
  straight.prescribe_angle_sum(n, Angle::pi_times(1));
  BOOST_CHECK(refused(t, straight, Status::ANGLE_OUT_OF_RANGE).vertices == std::vector<Index>{n});
}

BOOST_AUTO_TEST_CASE(gauss_bonnet_is_demanded)
{
  const Index n = 4;
  const Triangulation t = testing::triangulation(testing::hill(n, .3));
  Conditions conditions = rectangle(t, n);
  conditions.prescribe_angle_sum(2, Angle::pi_times(5, 6)); // pi / 6 less
  BOOST_CHECK_CLOSE_FRACTION(refused(t, conditions, Status::GAUSS_BONNET_VIOLATED).amount, CGAL_PI / 6, 10 * few_roundings);
  conditions.prescribe_angle_sum(2, Angle::pi_times(7, 6));
  BOOST_CHECK_CLOSE_FRACTION(refused(t, conditions, Status::GAUSS_BONNET_VIOLATED).amount, -CGAL_PI / 6, 10 * few_roundings);
  // written with few digits: the defect is spread over what is not exact
  conditions.prescribe_angle_sum(2, 2.6179938780 + .01);
  conditions.prescribe_angle_sum(7, 2 * CGAL_PI + CGAL_PI / 6 - .01);
  const Metric metric = CE::compute_conformal_metric(t, conditions);
  BOOST_CHECK(metric.status == Status::OK);
  BOOST_CHECK_GT(metric.statistics.angle_defect_spread, 1e-13); // of the angle that is written with ten digits after the point
  BOOST_CHECK_LE(metric.statistics.angle_defect_spread, 1e-10);
  conditions.prescribe_angle_sum(2, 2.617993 + .01);
  refused(t, conditions, Status::GAUSS_BONNET_VIOLATED);

  const Triangulation sphere = testing::triangulation(testing::icosphere(1)); // a sphere is not flat
  const Metric without_cones = refused(sphere, Conditions(sphere), Status::MISSING_CONDITION);
  BOOST_CHECK_CLOSE_FRACTION(without_cones.amount, 4 * CGAL_PI, 10 * few_roundings);
  BOOST_CHECK(without_cones.faces == std::vector<Index>{0});
  Conditions one_cone(sphere);
  one_cone.prescribe_angle_sum(5, Angle::pi_times(1));
  const Metric one = refused(sphere, one_cone, Status::GAUSS_BONNET_VIOLATED);
  BOOST_CHECK_CLOSE_FRACTION(one.amount, -3 * CGAL_PI, 10 * few_roundings);
  BOOST_CHECK(one.vertices == std::vector<Index>{5});
  // two free cones have a total angle of 2 pi (2 - 2) = 0
  Conditions free_cones(sphere);
  free_cones.fix_log_scale_factor(3, 0);
  free_cones.fix_log_scale_factor(8, 0);
  const Metric two = refused(sphere, free_cones, Status::NO_ANGLE_LEFT);
  BOOST_CHECK_EQUAL(two.amount, 0);
  BOOST_CHECK((two.vertices == std::vector<Index>{3, 8}));
  free_cones.fix_log_scale_factor(11, 0);
  solved(sphere, free_cones);
  // the second of two components
  const testing::Soup hill = testing::hill(3, .2);
  const Triangulation both = testing::triangulation(testing::together({hill, testing::icosahedron()}));
  BOOST_CHECK(refused(both, Conditions(both), Status::MISSING_CONDITION).faces == std::vector<Index>{Index(hill.triangles.size())});

  // a flat disk with a straight border needs three fixed vertices: one or two are left no angle
  for(Index fixed = 1; fixed <= 4; ++fixed)
  {
    Conditions mixed(t);
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      if(t.is_border_vertex(v))
        mixed.prescribe_angle_sum(v, Angle::pi_times(1));
    const std::array<Index, 4> corners = {{n, n * (n + 1), 0, n * (n + 1) + n}}; // the first two have one triangle each
    for(Index i = 0; i < fixed; ++i)
      mixed.fix_log_scale_factor(corners[i], 0);
    if(fixed == 1)
      refused(t, mixed, Status::ANGLE_OUT_OF_RANGE);
    else if(fixed == 2)
      BOOST_CHECK((refused(t, mixed, Status::NO_ANGLE_LEFT).vertices == std::vector<Index>{corners[0], corners[1]}));
    else
      solved(t, mixed);
  }
}

// Also a defect that is less than half a unit in the last place for each of the angles over which it is spread.
BOOST_AUTO_TEST_CASE(small_defects_are_spread_to_the_last_bit)
{
  const Triangulation t = testing::triangulation(testing::icosphere(3));
  const CE::Surface_components pieces = CE::connected_components(t);
  const std::vector<double> noise = testing::random_numbers(t.number_of_vertices(), .01, 9);
  for(double defect : {1e-10, 3e-12, 2e-13, -1e-13, 4e-15})
  {
    Conditions conditions(t);
    double sum = 0;
    for(Index v = 0; v + 1 < t.number_of_vertices(); ++v)
    {
      const double angle = 2 * CGAL_PI * (1 - 2. / t.number_of_vertices()) + noise[v];
      conditions.prescribe_angle_sum(v, angle);
      sum += noise[v];
    }
    conditions.prescribe_angle_sum(t.number_of_vertices() - 1, 2 * CGAL_PI * (1 - 2. / t.number_of_vertices()) - sum);
    const double rounded = CE::internal::angle_balances(t, pieces, conditions)[0].radians(); // of the sum above
    const double last = conditions.angle_sum(t.number_of_vertices() - 1).radians();
    conditions.prescribe_angle_sum(t.number_of_vertices() - 1, last + rounded + defect);
    const CE::internal::Feasibility feasibility = CE::internal::make_feasible(t, pieces, conditions);
    BOOST_CHECK(feasibility.status == Status::OK);
    BOOST_CHECK_LE(std::abs(feasibility.angle_defect_spread - std::abs(defect)), 2 * few_roundings);
    BOOST_CHECK_LE(std::abs(CE::internal::angle_balances(t, pieces, conditions)[0].radians()), 2 * few_roundings);
  }
}

// Three triangles around an apex, with a border edge too long for the others.
BOOST_AUTO_TEST_CASE(degenerate_minimizers_are_named)
{
  for(const double longest : {3., 1.1})
  {
    Triangulation t = testing::triangulation(testing::cone(3, 1));
    for(Index e = 0; e < t.number_of_edges(); ++e)
      t.set_length(e, t.is_border_edge(e) ? 1 : 2);
    t.set_length(t.edge(1), longest);
    BOOST_REQUIRE(CE::is_valid_metric(t));
    const Metric metric = CE::compute_conformal_metric(t, Conditions(t), params::retriangulation(CE::Retriangulation::NEVER));
    if(longest < 2) // the three border lengths are those of a triangle
    {
      check_solution(metric, Conditions(t));
      continue;
    }
    BOOST_CHECK(metric.status == Status::DEGENERATE_METRIC && !metric);
    BOOST_CHECK(metric.faces == std::vector<Index>{0});
    // the minimizer: angle pi in face 0, a right angle in the others
    BOOST_REQUIRE_EQUAL(metric.log_scale_factors.size(), 4);
    BOOST_CHECK_SMALL(metric.log_scale_factors[0] - 2 * std::log(std::sqrt(.5) / 2), solved_u);
    // unless told otherwise, edges are flipped then
    const Metric flipped = CE::compute_conformal_metric(t, Conditions(t));
    BOOST_CHECK(bool(flipped) && flipped.is_retriangulated());
  }
}

// b A^-1 b, or a negative number if A is not positive definite.
double inverse_form(Dense_matrix a, std::vector<double> b)
{
  double result = 0;
  for(std::size_t k = 0; k < a.size(); ++k)
  {
    if(!(a[k][k] > 0))
      return -1;
    for(std::size_t i = k + 1; i < a.size(); ++i)
      if(a[i][k] != 0)
      {
        const double factor = a[i][k] / a[k][k];
        for(std::size_t j = k + 1; j <= i; ++j)
          a[i][j] -= factor * a[j][k];
        b[i] -= factor * b[k];
      }
    result += b[k] * b[k] / a[k][k];
  }
  return result;
}

// Whether it can be proved that there is no metric with these conditions on this triangulation: that in the minimizer of the extended energy, of
// which u is an approximation, some triangle inequality fails. All solutions are minimizers, as the energy is convex, and one at which its Hessian
// is positive definite is the only one.
//
// Where u differs by d from the one given, and differences d_i - d_j are within bounds for which no angle of a triangle changes much, the Hessian
// of that triangle is at least one half of what it is at u. Let M be the sum of those of such triangles, N = M / 2, and g the gradient at u. If
// g N^-1 g < rho^2, the minimizer is in the ball d N d <= rho^2, since E increases at its border. There (d_i - d_j)^2 <= 2 rho^2 / c, where c is
// the sum of 1 / (2 (cot a + cot b)) over these triangles at the edge ij, with their angles a and b at i and j: what is left of their forms
// when they are least over the third vertex.
class Certificate
{
  const Triangulation& t_;
  std::vector<std::array<Real, 3> > length_;                   // by face and side
  std::vector<CEi::Triangle_angles<Real> > angles_;
  std::vector<char> is_counted_;                               // in M
  std::vector<int> free_index_;
  std::vector<double> gradient_, bound_;                       // by free vertex; by edge

  static double cotangent(const CEi::Triangle_angles<Real>& angles, Index k) { return static_cast<double>(angles.cotangent[k % 3]); }

  // Bounds the differences along the edges, if M is positive definite.
  bool find_bounds()
  {
    Dense_matrix m(gradient_.size(), std::vector<double>(gradient_.size(), 0.));
    std::vector<double> conductance(t_.number_of_edges(), 0.);
    for(Index h = 0; h < t_.number_of_halfedges(); ++h)
    {
      if(!is_counted_[h / 3])
        continue;
      const CEi::Triangle_angles<Real>& angles = angles_[h / 3];
      const double half = cotangent(angles, h % 3) / 2;
      conductance[t_.edge(h)] += 1 / (2 * (cotangent(angles, h % 3 + 1) + cotangent(angles, h % 3 + 2)));
      const int i = free_index_[t_.origin(h)], j = free_index_[t_.target(h)];
      if(i >= 0)
        m[i][i] += half;
      if(j >= 0)
        m[j][j] += half;
      if(i >= 0 && j >= 0)
      {
        m[i][j] -= half;
        m[j][i] -= half;
      }
    }
    const double form = inverse_form(m, gradient_);
    for(Index e = 0; e < t_.number_of_edges(); ++e)
      bound_[e] = conductance[e] > 0 ? std::sqrt(2 * 1.01 * 2 * form / conductance[e]) : infinity;
    return form >= 0;
  }

  // The cotangents of a triangle change by less than a tenth, and so its form relative to what it was by less than one half: with differences of
  // at most b, angles change by c b at most, where c > 1 bounds the cotangents, cotangents by (1 + c^2) c b, and the trace of the one form
  // relative to the other, which are of the same determinant, by 6 (1 + c^2) c^2 b.
  bool drop_unsafe()
  {
    bool is_dropped = false;
    for(Index f = 0; f < t_.number_of_faces(); ++f)
    {
      double b = 0, c = 1;
      for(Index k = 0; k < 3; ++k)
      {
        b = (std::max)(b, bound_[t_.edge(3 * f + k)]);
        c = (std::max)(c, 1.1 * std::abs(cotangent(angles_[f], k)));
      }
      if(!is_counted_[f] || 6 * b * c * c * (1 + c * c) < .05)
        continue;
      is_counted_[f] = 0;
      is_dropped = true;
    }
    return is_dropped;
  }

  // Does the face remain broken? Relative to the longest side, another one becomes longer by e^{(d_i - d_j)/2}, where i is the corner opposite to
  // the longest side, and j the end of that which the other side does not have.
  bool remains_broken(Index f) const
  {
    const std::array<Real, 3>& l = length_[f];
    const int k = CEi::longest_side(l[0], l[1], l[2]);
    const double b = (std::max)(bound_[t_.edge(3 * f + (k + 1) % 3)], bound_[t_.edge(3 * f + (k + 2) % 3)]);
    return static_cast<double>((l[(k + 1) % 3] + l[(k + 2) % 3]) / l[k]) * std::exp(b / 2) < 1 - 1e-14;
  }

public:
  Certificate(const Triangulation& t, const Conditions& conditions, const std::vector<double>& u)
    : t_(t), free_index_(t.number_of_vertices(), -1), bound_(t.number_of_edges(), infinity)
  {
    std::vector<Real> gradient;
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      if(!conditions.is_fixed(v) && !t.is_isolated_vertex(v))
      {
        free_index_[v] = int(gradient.size());
        gradient.push_back(conditions.angle_sum(v).radians<Real>());
      }
    for(Index f = 0; f < t.number_of_faces(); ++f)
    {
      std::array<Real, 3> l;
      for(Index k = 0; k < 3; ++k)
        l[k] = t.halfedge_length(3 * f + k) * exp((Real(u[t.origin(3 * f + k)]) + u[t.target(3 * f + k)]) / 2);
      length_.push_back(l);
      angles_.push_back(CEi::triangle_angles<Real>(l[0], l[1], l[2]));
      is_counted_.push_back(angles_.back().is_broken ? 0 : 1);
      for(Index k = 0; k < 3; ++k)
        if(free_index_[t.apex(3 * f + k)] >= 0)
          gradient[free_index_[t.apex(3 * f + k)]] -= angles_.back().angle[k];
    }
    for(const Real& x : gradient)
      gradient_.push_back(static_cast<double>(x));
  }

  bool proves_that_there_is_none()
  {
    do
      if(!find_bounds())
        return false;
    while(drop_unsafe());
    for(Index f = 0; f < t_.number_of_faces(); ++f)
      if(angles_[f].is_broken && remains_broken(f))
        return true;
    return false;
  }
};

// One of CGAL's meshes, of triangles.
Triangulation mesh_of_CGAL(const std::string& name)
{
  std::ifstream in(mesh_path(name));
  std::string format;
  std::size_t vertices = 0, faces = 0, edges = 0, corners = 0;
  in >> format >> vertices >> faces >> edges;
  testing::Soup soup;
  soup.points.resize(vertices);
  soup.triangles.resize(faces);
  for(auto& point : soup.points)
    in >> point[0] >> point[1] >> point[2];
  for(auto& triangle : soup.triangles)
    in >> corners >> triangle[0] >> triangle[1] >> triangle[2];
  BOOST_REQUIRE(in && format == "OFF" && corners == 3);
  return testing::triangulation(soup);
}

// Where the solver says that there is a metric on the fixed triangulation, it is one, and no edge is flipped unasked; where it says that there is
// none, there is a proof.
BOOST_AUTO_TEST_CASE(there_is_no_metric_where_none_is_found, * needs_mesh("blob.off"))
{
  std::vector<Triangulation> surfaces;
  for(const std::string name : {"blob.off", "corner_tris_with_hole.off", "mesh_with_border.off", "nefertiti.off"})
    surfaces.push_back(mesh_of_CGAL(name));
  for(const double amplitude : {1., 3., 5., 9.})
    for(unsigned seed = 0; seed < 3; ++seed)
      surfaces.push_back(testing::triangulation(testing::random_height_field(17, amplitude, seed)));
  std::size_t number_with = 0, number_without = 0;
  for(const Triangulation& t : surfaces)
  {
    const Conditions conditions(t);
    const Metric fixed = CE::compute_conformal_metric(t, conditions, params::retriangulation(CE::Retriangulation::NEVER));
    const Metric metric = CE::compute_conformal_metric(t, conditions);
    BOOST_CHECK_EQUAL(bool(fixed), !metric.is_retriangulated());
    if(fixed)
    {
      ++number_with;
      check_solution(fixed, conditions);
      BOOST_CHECK(CE::is_valid_metric(CE::apply_log_scale_factors(t, fixed.log_scale_factors)));
      BOOST_CHECK(!Certificate(t, conditions, fixed.log_scale_factors).proves_that_there_is_none());
      continue;
    }
    ++number_without;
    BOOST_CHECK(fixed.status == Status::DEGENERATE_METRIC);
    BOOST_REQUIRE_EQUAL(fixed.log_scale_factors.size(), t.number_of_vertices());
    BOOST_CHECK(Certificate(t, conditions, fixed.log_scale_factors).proves_that_there_is_none());
  }
  BOOST_CHECK_GT(number_with, 3);
  BOOST_CHECK_GE(number_without, 3);
}

// ---- Appendix E

// While a direct solver works, libraries beneath it use one thread, however many users there are; then what was set before.
BOOST_AUTO_TEST_CASE(threads_are_held_and_given_back)
{
  typedef CE::internal::One_linear_algebra_thread One_thread;
  const CE::internal::Thread_setting settings[] = {
    CE::internal::find_thread_setting("openblas_get_num_threads", "openblas_set_num_threads", 1),
    CE::internal::find_thread_setting("omp_get_max_active_levels", "omp_set_max_active_levels", 0) };
  for(const CE::internal::Thread_setting& setting : settings)
    if(setting.is_there()) // that library is loaded
    {
      const int given = setting.get();
      setting.set(2);
      const int before = setting.get();
      {
        const One_thread outer;
        BOOST_TEST(setting.get() == setting.single);
        {
          const One_thread inner;
          BOOST_TEST(setting.get() == setting.single);
        }
        BOOST_TEST(setting.get() == setting.single);
      }
      BOOST_TEST(setting.get() == before);
      setting.set(given);
    }
}

// Among the flat metrics, u = 0 on the border has the least Dirichlet energy, better and better so as the
// mesh is refined: for border data s phi, D(s) - D(0) becomes a multiple of s^2.
BOOST_AUTO_TEST_CASE(natural_border_has_the_least_dirichlet_energy)
{
  const std::vector<std::function<double(double, double)> > data = {
    [](double x, double) { return x; }, [](double x, double y) { return std::sin(4 * x - 3 * y); }, [](double x, double y) { return x * x - y * y; }};
  const auto dirichlet = [](const Triangulation& t, const testing::Soup& soup, const std::function<double(double, double)>& phi, double s)
  {
    Conditions conditions(t);
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      if(t.is_border_vertex(v))
        conditions.fix_log_scale_factor(v, s * phi(soup.points[v][0], soup.points[v][1]));
    return CE::dirichlet_energy(t, solved(t, conditions).log_scale_factors);
  };
  std::vector<double> last(data.size() + 1, 1.);
  for(const Index n : {6, 12, 24})
  {
    const testing::Soup soup = testing::hill(n, .5);
    const Triangulation t = testing::triangulation(soup);
    const double least = dirichlet(t, soup, data[0], 0);
    for(std::size_t i = 0; i < data.size(); ++i)
    {
      const double s = .25, more = dirichlet(t, soup, data[i], s), less = dirichlet(t, soup, data[i], -s);
      BOOST_CHECK_GT(more, least);
      BOOST_CHECK_GT(less, least);
      const double skew = std::abs(more - less) / (more + less - 2 * least); // 0 at a critical point
      BOOST_TEST_MESSAGE("n = " << n << ", border data " << i << ": D = " << less << ' ' << least << ' ' << more << ", skew " << skew);
      BOOST_CHECK_LT(skew, last[i]);
      last[i] = skew;
    }
    BOOST_CHECK_GT(CE::dirichlet_energy(t, solved(t, rectangle(t, n)).log_scale_factors), least);
  }
  for(std::size_t i = 0; i < data.size(); ++i)
    BOOST_CHECK_LT(last[i], .1);
}

} // namespace
