// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Cones that place themselves: the linear algebra of their search, their angles, and what is gained.

#define BOOST_TEST_MODULE test_place_cones
#include "include/boost_test.h"

#include "include/flattened_meshes.h"
#include "include/index_level.h"

#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/place_cones.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;
using namespace testing;

namespace {

typedef CE::internal::Cone_search<double>  Search;
typedef CE::internal::Placement            Placement;

// A disk with three bumps, one of them larger.
Soup bumps(Index n) { return disk_with_bumps(n, {{{0.3, 0.3, 0.3, 0.13}}, {{0.7, 0.35, 0.22, 0.13}}, {{0.5, 0.75, 0.25, 0.15}}}); }

Soup arms(int levels) { return testing::arms(levels, 0); }

CE::Surface_components::Component only_component(const Triangulation& t) { return CE::connected_components(t).components[0]; }

double largest(const std::vector<double>& u)
{
  double result = 0;
  for(double x : u)
    result = (std::max)(result, std::abs(x));
  return result;
}

double u_without_cones(const Triangulation& t)
{
  return largest(CE::compute_conformal_metric(t, CE::Conformal_conditions<double>(t)).log_scale_factors);
}

// All assignments of positive integers near the x with the given sum: the least possible largest difference.
double least_error(const std::vector<double>& x, long sum)
{
  double best = std::numeric_limits<double>::infinity();
  std::vector<long> k(x.size(), 1);
  std::function<void(std::size_t, long, double)> assign = [&](std::size_t i, long rest, double error)
  {
    if(error >= best)
      return;
    if(i + 1 == x.size())
    {
      if(rest >= 1)
        best = (std::min)(best, (std::max)(error, std::abs(x[i] - double(rest))));
      return;
    }
    for(long n = 1; n < rest; ++n)
      assign(i + 1, rest - n, (std::max)(error, std::abs(x[i] - double(n))));
  };
  assign(0, sum, 0);
  return best;
}

// Each triangle cut into four, as it lies in its plane.
Soup divided(Soup soup, int levels)
{
  for(int level = 0; level < levels; ++level)
  {
    std::map<std::pair<Index, Index>, Index> middle;
    const auto middle_of = [&](Index a, Index b)
    {
      const auto known = middle.emplace(std::make_pair((std::min)(a, b), (std::max)(a, b)), Index(soup.points.size()));
      if(known.second)
      {
        Point p;
        for(std::size_t i = 0; i < 3; ++i)
          p[i] = (soup.points[a][i] + soup.points[b][i]) / 2;
        soup.points.push_back(p);
      }
      return known.first->second;
    };
    decltype(soup.triangles) triangles;
    for(const auto& t : soup.triangles)
    {
      const Index a = middle_of(t[0], t[1]), b = middle_of(t[1], t[2]), c = middle_of(t[2], t[0]);
      triangles.push_back({{t[0], a, c}});
      triangles.push_back({{a, t[1], b}});
      triangles.push_back({{c, b, t[2]}});
      triangles.push_back({{a, b, c}});
    }
    soup.triangles.swap(triangles);
  }
  return soup;
}

Soup tetrahedron()
{
  Soup soup;
  soup.points = {{{1, 1, 1}}, {{1, -1, -1}}, {{-1, 1, -1}}, {{-1, -1, 1}}};
  soup.triangles = {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 1}}, {{1, 3, 2}}};
  return soup;
}

Soup octahedron()
{
  Soup soup;
  soup.points = {{{1, 0, 0}}, {{-1, 0, 0}}, {{0, 1, 0}}, {{0, -1, 0}}, {{0, 0, 1}}, {{0, 0, -1}}};
  soup.triangles = {{{0, 2, 4}}, {{2, 1, 4}}, {{1, 3, 4}}, {{3, 0, 4}}, {{2, 0, 5}}, {{1, 2, 5}}, {{3, 1, 5}}, {{0, 3, 5}}};
  return soup;
}

Soup cube()
{
  Soup soup;
  for(int i = 0; i < 8; ++i)
    soup.points.push_back({{double(i & 1), double(i / 2 & 1), double(i / 4)}});
  soup.triangles = {{{0, 2, 1}}, {{1, 2, 3}}, {{4, 5, 6}}, {{5, 7, 6}}, {{0, 1, 4}}, {{1, 5, 4}},
                    {{2, 6, 3}}, {{3, 6, 7}}, {{0, 4, 2}}, {{2, 4, 6}}, {{1, 3, 5}}, {{3, 7, 5}}};
  return soup;
}

// At a, between b and c.
double angle_at(const Soup& soup, Index a, Index b, Index c)
{
  double dot = 0, square_b = 0, square_c = 0;
  for(std::size_t i = 0; i < 3; ++i)
  {
    const double x = soup.points[b][i] - soup.points[a][i], y = soup.points[c][i] - soup.points[a][i];
    dot += x * y;
    square_b += x * x;
    square_c += y * y;
  }
  return std::acos(dot / std::sqrt(square_b * square_c));
}

typedef CE::internal::Cone_model           Model;
typedef CE::internal::Cone_fit             Fit;
typedef CE::internal::Curved_cones         Curved_cones;

std::unique_ptr<Model> model_of(const Triangulation& t)
{
  CE::internal::Cone_surface surface;
  BOOST_REQUIRE(CE::internal::make_cone_surface(t, std::vector<double>(t.number_of_vertices(), 0.), surface));
  auto result = std::make_unique<Model>(std::move(surface), double(only_component(t).euler_characteristic()),
                                        CE::internal::make_factorization<CE::Default_solver_traits>());
  BOOST_REQUIRE(result->factorize());
  return result;
}

// Some cones, not where they should be, as exactly as the model knows them.
Curved_cones some_cones(Model& model, std::size_t n)
{
  Curved_cones s;
  for(std::size_t i = 0; i < n; ++i)
    s.cones.push_back(model.places()[(2 * i + 1) * model.places().size() / (2 * n)]);
  model.sharpen(s.cones);
  return s;
}

} // namespace

// ---- Rounding of angles

BOOST_AUTO_TEST_CASE(the_largest_error_of_rounding_is_as_small_as_can_be)
{
  Random random(7);
  int n_failed = 0, n_unlike_nearest = 0;
  for(int trial = 0; trial < 3000; ++trial)
  {
    const std::size_t n = 1 + random.below(6);
    std::vector<double> x(n);
    for(double& y : x)
      y = random(0.05, 5);
    const long exact = std::lround(std::accumulate(x.begin(), x.end(), 0.)), sum = (std::max)(long(n), exact + long(random.below(5)) - 2);
    const std::vector<long> k = CE::internal::nearest_integers(x, sum);
    BOOST_REQUIRE_EQUAL(k.size(), n);
    BOOST_TEST(std::accumulate(k.begin(), k.end(), 0l) == sum);
    double error = 0;
    for(std::size_t i = 0; i < n; ++i)
    {
      BOOST_TEST(k[i] >= 1);
      error = (std::max)(error, std::abs(x[i] - double(k[i])));
      n_unlike_nearest += k[i] != (std::max)(1l, std::lround(x[i])) ? 1 : 0;
    }
    n_failed += std::abs(error - least_error(x, sum)) > 2e-12 ? 1 : 0; // 1e-12, up and down, is what counts as a tie
  }
  BOOST_TEST(n_failed == 0);
  BOOST_TEST(n_unlike_nearest > 1000); // it was not too easy
}

BOOST_AUTO_TEST_CASE(sums_that_positive_integers_cannot_have_are_refused)
{
  BOOST_TEST(CE::internal::nearest_integers({1.2, 2.3, 0.4}, 2).empty());
  BOOST_TEST(CE::internal::nearest_integers({}, 3).empty());
  BOOST_TEST((CE::internal::nearest_integers({1.2, 2.7, 0.1}, 0) == std::vector<long>{1, 3, 1}));
}

// ---- The search

// Multiples of 2 pi / 11 are none of pi / 2520, but prescribed all the same.
BOOST_AUTO_TEST_CASE(rounded_cones_are_not_free_whatever_the_quantum)
{
  Mesh sm = surface_mesh<Mesh>(arms(2));
  const auto angle = sm.add_property_map<Vertex, double>("v:angle", 0).first;
  for(const double quantum : {2 * pi / 11, pi / 2, 0.})
  {
    const auto report = CE::place_cones(sm, angle, params::number_of_cones(5).angle_quantum(quantum));
    BOOST_TEST_REQUIRE(bool(report));
    BOOST_TEST(!report.cones.empty());
    for(const auto& cone : report.cones)
    {
      BOOST_TEST(cone.is_free == (quantum == 0));
      if(quantum > 0)
        BOOST_TEST(std::abs(std::remainder(cone.angle, quantum)) <= 4 * pi * unit_roundoff); // the angle, below 4 pi, is rounded
    }
  }
}

// A solver that is given is copied, and copies may share one factor.
BOOST_AUTO_TEST_CASE(a_given_solver_finds_the_same)
{
  for(const Soup& soup : {arms(2), bumps(16)})
  {
    const Triangulation t = triangulation(soup);
    const auto np = params::number_of_cones(4).angle_quantum(pi / 2);
    const auto expected = CE::place_cones(t, params::number_of_cones(4).angle_quantum(pi / 2).sparse_linear_solver(CE::Default_solver_traits()));
    const auto placement = CE::place_cones(t, np);
    BOOST_TEST_REQUIRE(bool(placement));
    BOOST_TEST_REQUIRE(bool(expected));
    BOOST_TEST((placement.cones == expected.cones));
    BOOST_TEST((placement.metric.log_scale_factors == expected.metric.log_scale_factors));
  }
}

// Radians: the residual at which the search is told to end.
constexpr double search_tolerance = 1e-11;

// What that leaves of u: it times the largest sum of a row of the inverse of the Laplacian, which is below 100 for the some hundred vertices of the
// surfaces and their cones.
constexpr double searched_u = 100 * search_tolerance;

BOOST_AUTO_TEST_CASE(free_cones_have_u_zero_and_all_other_angles_are_flat)
{
  for(const Soup& soup : {bumps(16), arms(3), torus(20, 12)})
  {
    const Triangulation t = triangulation(soup);
    Search search(t, only_component(t), CE::internal::make_factorization<CE::Default_solver_traits>(), CE::Cone_measure::MAXIMUM_U);
    BOOST_REQUIRE(search.factorize());
    Placement p = search.without_cones(std::vector<double>(t.number_of_vertices(), 0.));
    for(Index i = 0; i < 4; ++i)
      Search::add(p, search.candidates()[(2 * i + 1) * search.candidates().size() / 8]);
    BOOST_REQUIRE(search.relax(p, 60, search_tolerance));
    for(Index c : p.cones)
      BOOST_TEST(std::abs(p.u[c]) <= rounded_u);

    // the same by the solver
    CE::Conformal_conditions<double> conditions(t);
    for(Index c : p.cones)
      conditions.fix_log_scale_factor(c, 0.);
    const auto metric = CE::compute_conformal_metric(t, conditions, params::retriangulation(CE::Retriangulation::NEVER));
    BOOST_REQUIRE(bool(metric));
    double difference = 0;
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      difference = (std::max)(difference, std::abs(p.u[v] - metric.log_scale_factors[v]));
    BOOST_TEST(difference <= searched_u);
    BOOST_TEST(std::abs(p.measure - largest(metric.log_scale_factors)) <= searched_u);
  }
}

BOOST_AUTO_TEST_CASE(prescribed_angles_are_found_by_the_search_as_by_the_solver)
{
  const Triangulation t = triangulation(bumps(16));
  Search search(t, only_component(t), CE::internal::make_factorization<CE::Default_solver_traits>(), CE::Cone_measure::MAXIMUM_U);
  BOOST_REQUIRE(search.factorize());
  Placement p = search.without_cones(std::vector<double>(t.number_of_vertices(), 0.));
  p.cones = {search.candidates()[40], search.candidates()[111]};
  p.angles = {3 * pi / 2, 5 * pi / 2};
  BOOST_REQUIRE(search.relax(p, 60, search_tolerance));
  CE::Conformal_conditions<double> conditions(t);
  conditions.prescribe_angle_sum(p.cones[0], 3 * pi / 2);
  conditions.prescribe_angle_sum(p.cones[1], 5 * pi / 2);
  const auto metric = CE::compute_conformal_metric(t, conditions, params::retriangulation(CE::Retriangulation::NEVER));
  BOOST_REQUIRE(bool(metric));
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    BOOST_TEST(std::abs(p.u[v] - metric.log_scale_factors[v]) <= searched_u);
}

// What is expected of a move is exact to first order: for a surface that is nearly flat, the error is of second order.
BOOST_AUTO_TEST_CASE(moves_are_foreseen_to_first_order)
{
  for(const bool is_free : {true, false})
  {
    std::array<double, 2> error;
    for(int k = 0; k < 2; ++k)
    {
      const double height = k == 0 ? 0.05 : 0.025;
      const Triangulation t = triangulation(grid(14, [&](double x, double y)
        { return height * std::sin(5 * x + 1) * std::cos(4 * y) + 0.3 * height * std::sin(11 * x * y); }));
      Search search(t, only_component(t), CE::internal::make_factorization<CE::Default_solver_traits>(), CE::Cone_measure::DIRICHLET_ENERGY);
      BOOST_REQUIRE(search.factorize());
      Placement p = search.without_cones(std::vector<double>(t.number_of_vertices(), 0.));
      p.cones = {search.candidates()[30], search.candidates()[100]};
      if(!is_free)
        p.angles = {2 * pi - height * height, 2 * pi + 2 * height * height};
      BOOST_REQUIRE(search.relax(p, 60, 1e-13));
      const double expected = search.moved(p, 1, search.curvatures(p)[1], search.candidates()[120]).measure;
      Placement moved = p;
      moved.cones[1] = search.candidates()[120];
      BOOST_REQUIRE(search.relax(moved, 60, 1e-13));
      BOOST_TEST(std::abs(moved.measure - p.measure) > 1e-4 * p.measure); // it is a move
      error[std::size_t(k)] = std::abs(expected - moved.measure) / moved.measure;
    }
    BOOST_TEST(error[0] < 0.2); // of first order
    BOOST_TEST(error[1] < 0.4 * error[0]); // curvature is of second order in the height: a quarter, asymptotically
  }
}

// The same where everything is known that was guessed: what is foreseen from a few rows is what comes out if u is computed.
BOOST_AUTO_TEST_CASE(moves_are_foreseen_as_they_are_computed_to_first_order)
{
  const Soup hill = grid(14, [](double x, double y) { return 0.05 * std::sin(5 * x + 1) * std::cos(4 * y) + 0.02 * std::sin(11 * x * y); });
  Soup ring = torus(20, 12), ball = icosphere(3);
  add_noise(ring, 0.004, 3);
  add_noise(ball, 0.004, 3);
  for(const Soup& soup : {hill, ring, ball})
    for(const CE::Cone_measure measure : {CE::Cone_measure::MAXIMUM_U, CE::Cone_measure::DIRICHLET_ENERGY})
      for(const std::size_t n_cones : {1u, 3u, 8u})
        for(const bool is_free : {true, false})
        {
          const Triangulation t = triangulation(soup);
          const bool is_sphere = only_component(t).euler_characteristic() > 0 && only_component(t).number_of_borders == 0;
          if(is_sphere && n_cones < 8)
            continue; // u would change by more than can be foreseen
          Search search(t, only_component(t), CE::internal::make_factorization<CE::Default_solver_traits>(), measure);
          BOOST_REQUIRE(search.factorize());
          Placement p = search.without_cones(std::vector<double>(t.number_of_vertices(), 0.));
          for(std::size_t i = 0; i < n_cones; ++i)
            Search::add(p, search.candidates()[(2 * i + 1) * search.candidates().size() / (2 * n_cones)]);
          BOOST_REQUIRE(search.relax(p, 300, 1e-12, false));
          if(!is_free)
            for(double curvature : search.curvatures(p))
              p.angles.push_back(2 * pi - curvature);
          BOOST_REQUIRE(search.relax(p, 300, 1e-12, false));
          search.watch(p);
          const CE::internal::Cone_move move = search.best_move(p, 3, {});
          BOOST_REQUIRE(move.to < t.number_of_vertices());
          const Placement moved = search.moved(p, move.cone, move.curvature, move.to);
          if(measure == CE::Cone_measure::MAXIMUM_U && is_free)
            for(Index c : moved.cones)
              BOOST_TEST(std::abs(moved.u[c]) <= rounded_u);
          search.watch(moved);
          std::set<std::pair<Index, Index> > others;
          for(Index c : p.cones)
            for(Index v : search.candidates())
              if(c != p.cones[move.cone] || v != move.to)
                others.insert({c, v});
          const CE::internal::Cone_move again = search.best_move(p, 3, others);
          BOOST_REQUIRE(again.to == move.to);
          BOOST_TEST(std::abs(again.expected - moved.measure) <= rounded_u * (1 + moved.measure));
          if(n_cones > 1)
            BOOST_TEST(std::abs(moved.measure - p.measure) > 1e-6 * p.measure); // it is a move
        }
}

BOOST_AUTO_TEST_CASE(the_vertex_with_the_largest_u_is_found_whatever_u_is)
{
  const Triangulation t = triangulation(bumps(6));
  Search search(t, only_component(t), CE::internal::make_factorization<CE::Default_solver_traits>(), CE::Cone_measure::MAXIMUM_U);
  Placement p = search.without_cones(std::vector<double>(t.number_of_vertices(), 0.));
  BOOST_TEST(p.measure == 0);
  const std::vector<Index>& inner = search.candidates();
  BOOST_TEST(search.worst_vertex(p) == inner[0]); // of equals the first
  p.u[inner[3]] = -2;
  p.u[inner[5]] = 2;
  BOOST_TEST(search.worst_vertex(p) == inner[3]);
  Search::add(p, inner[3]);
  BOOST_TEST(search.worst_vertex(p) == inner[5]);
  p.u[inner[7]] = std::numeric_limits<double>::quiet_NaN();
  BOOST_TEST(search.worst_vertex(p) == inner[7]);
  search.judge(p);
  BOOST_TEST(!(p.measure < 1e300)); // never the better one
  p.cones = inner;
  BOOST_TEST(search.worst_vertex(p) == t.null_index);
  BOOST_TEST(!search.put_cone(p));
}

// ---- Chosen angles

// Optimal by what makes a convex function least: no unknown that is free to move, and no exchange between two of the sum, leads downhill. With
// unknowns whose units differ by a factor of up to 1e6, dependent ones among them, and bounds that hold many of them.
BOOST_AUTO_TEST_CASE(quadratic_functions_are_least_within_bounds)
{
  Random random(11);
  const double infinity = std::numeric_limits<double>::infinity();
  int n_held = 0;
  for(int trial = 0; trial < 400; ++trial)
  {
    const Eigen::Index n = 1 + Eigen::Index(random.below(9)), n_in_sum = trial % 2 == 0 ? 0 : n - Eigen::Index(trial % 4 == 1 ? 0 : 1);
    Eigen::MatrixXd a(n + 2, n);
    Eigen::VectorXd b(n), least(n), most(n), x(n), unit(n);
    for(Eigen::Index j = 0; j < n; ++j)
    {
      unit[j] = j < n_in_sum ? 1 : std::pow(10., random(-3., 3.));
      for(Eigen::Index i = 0; i < a.rows(); ++i)
        a(i, j) = random(-1., 1.) / unit[j];
      if(j > 0 && trial % 5 == 0)
        a.col(j) = a.col(j - 1) * unit[j - 1] / unit[j];
      b[j] = random(-3., 3.) / unit[j];
      least[j] = j + 1 == n && n_in_sum < n && trial % 5 != 0 ? -infinity : random(-2., 0.) * unit[j];
      most[j] = random(0., 2.) * unit[j];
      x[j] = random(0., 1.) * most[j];
    }
    const Eigen::MatrixXd k = a.transpose() * a;
    std::vector<char> is_in_sum(std::size_t(n_in_sum), 1);
    const double sum = x.head(n_in_sum).sum();
    const Eigen::VectorXd y = CE::internal::Bounded_minimum(k, b, least, most, is_in_sum).from(x);
    BOOST_TEST(std::abs(y.head(n_in_sum).sum() - sum) <= few_roundings * 20);
    const Eigen::VectorXd slope = (k * y + b).cwiseProduct(unit);
    const double size = 1e-8 * (1 + slope.cwiseAbs().maxCoeff()); // what is let go of a bound gains 1e-9 of the slope at least
    for(Eigen::Index i = 0; i < n; ++i)
    {
      BOOST_TEST((least[i] <= y[i] && y[i] <= most[i]));
      n_held += y[i] == least[i] || y[i] == most[i] ? 1 : 0;
      if(i >= n_in_sum)
      {
        BOOST_TEST((y[i] == most[i] || slope[i] >= -size));
        BOOST_TEST((y[i] == least[i] || slope[i] <= size));
        continue;
      }
      for(Eigen::Index j = 0; j < n_in_sum; ++j)
        BOOST_TEST((y[i] == most[i] || y[j] == least[j] || slope[i] - slope[j] >= -size));
    }
  }
  BOOST_TEST(n_held > 400);
}

// u of the model is that of the metric to first order: for a surface that is nearly flat, the error is of second order in the curvature.
BOOST_AUTO_TEST_CASE(the_model_foresees_u_to_first_order)
{
  std::array<double, 2> error;
  for(int k = 0; k < 2; ++k)
  {
    const double height = k == 0 ? 0.05 : 0.025;
    const Triangulation t = triangulation(grid(14, [&](double x, double y) { return height * std::sin(5 * x + 1) * std::cos(4 * y); }));
    const auto model = model_of(t);
    Curved_cones s = some_cones(*model, 2);
    s.curvatures.resize(2);
    s.curvatures << height * height, -2 * height * height;
    Fit fit(*model, CE::internal::vertex_areas(t), false);
    fit.apply(s);
    CE::Conformal_conditions<double> conditions(t);
    for(std::size_t i = 0; i < 2; ++i)
      conditions.prescribe_angle_sum(s.cones[i], 2 * pi - s.curvatures[Eigen::Index(i)]);
    const auto metric = CE::compute_conformal_metric(t, conditions, params::retriangulation(CE::Retriangulation::NEVER));
    BOOST_REQUIRE(bool(metric));
    double difference = 0;
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      difference = (std::max)(difference, std::abs(s.u[v] - metric.log_scale_factors[v]));
    error[std::size_t(k)] = difference / largest(metric.log_scale_factors);
  }
  BOOST_TEST(error[0] < 0.1);
  BOOST_TEST(error[1] < 0.4 * error[0]); // curvature is of second order in the height: a quarter, asymptotically
}

// |u|_p is convex in the curvatures: nothing near is better, so nothing is. That of the mean is the largest |u| from below.
BOOST_AUTO_TEST_CASE(curvatures_are_the_best_ones_for_their_places)
{
  Soup ball = icosphere(3);
  add_noise(ball, 0.05, 3);
  Soup needle = arms(3); // where curvatures are kept from what they would like to be
  for(Point& p : needle.points)
    p[2] *= 8;
  int n_held = 0;
  for(const Soup& soup : {bumps(16), ball, needle})
    for(const int exponent : {2, 8, 64})
    {
      const Triangulation t = triangulation(soup);
      const auto model = model_of(t);
      Fit fit(*model, CE::internal::vertex_areas(t), false);
      fit.set_exponent(exponent);
      Curved_cones s = some_cones(*model, 5);
      fit.fit(s);
      BOOST_TEST(s.value <= s.largest());
      if(model->is_closed())
        BOOST_TEST(std::abs(s.curvatures.sum() - 4 * pi) <= few_roundings * 4 * pi);
      const double least = fit.least_curvature(5), most = fit.largest_curvature();
      for(Eigen::Index i = 0; i < 5; ++i)
      {
        BOOST_TEST((least <= s.curvatures[i] && s.curvatures[i] <= most));
        n_held += s.curvatures[i] == least || s.curvatures[i] == most ? 1 : 0;
      }
      for(Eigen::Index i = 0; i < 5; ++i)
        for(const double by : {-0.05, 0.05})
        {
          Curved_cones other = s;
          other.curvatures[i] += by;
          if(model->is_closed())
            other.curvatures[(i + 1) % 5] -= by;
          if(other.curvatures.minCoeff() < least || other.curvatures.maxCoeff() > most)
            continue;
          fit.apply(other);
          // Newton's method ends where it gains less than 1e-4; means are taken as if u were linear at cones, too
          BOOST_TEST(other.value >= s.value * (1 - (exponent == 2 ? 1e-2 : 1e-3)));
        }
    }
  BOOST_TEST(n_held > 0);
}

// The coarse surface bears the same curvature and the same area, and the response to a cone is nearly the same away from it: up to a factor, as its
// weights are those of finite volumes whose normals are not known.
BOOST_AUTO_TEST_CASE(a_coarse_surface_responds_to_cones_as_the_surface_does)
{
  const Triangulation t = triangulation(bumps(48));
  const auto fine = model_of(t);
  const CE::internal::Coarse_surface coarse(fine->surface(), 2, true);
  const auto& surface = coarse.surface();
  BOOST_TEST(8 * surface.number_of_vertices() < t.number_of_vertices() * 2);
  const double rounding = 1e-12;
  BOOST_TEST(std::abs(coarse.sums(CE::internal::vertex_areas(t)).sum() - 1) < rounding);
  for(double w : surface.weights)
    BOOST_TEST(w >= 0);
  Model model(surface, double(only_component(t).euler_characteristic()), CE::internal::make_factorization<CE::Default_solver_traits>());
  BOOST_REQUIRE(model.factorize());
  const Index c = model.places()[model.places().size() / 2];
  const auto g = model.column(c), exact = fine->column(coarse.vertex(c));
  double product = 0, square = 0, exact_square = 0;
  for(Index v : model.places())
    if(v != c)
    {
      const double x = (*g)[v], y = (*exact)[coarse.vertex(v)];
      product += x * y;
      square += x * x;
      exact_square += y * y;
    }
  const double least_cosine = 0.99; // of the angle between the responses: what cells do not resolve is a few parts in a hundred
  BOOST_TEST(product > least_cosine * std::sqrt(square * exact_square));
}

// ... and the dual potential at the cones is the derivative, by differences.
BOOST_AUTO_TEST_CASE(the_dual_potential_is_the_derivative_by_curvature)
{
  for(const int exponent : {2, 8})
  {
    const Triangulation t = triangulation(bumps(16));
    const auto model = model_of(t);
    Fit fit(*model, CE::internal::vertex_areas(t), false);
    fit.set_exponent(exponent);
    Curved_cones s = some_cones(*model, 3);
    s.curvatures.resize(3);
    s.curvatures << 1, -0.5, 0.7;
    fit.apply(s);
    CE::internal::Sparse_cones search(*model, fit, 1.);
    const Eigen::VectorXd p = search.potential(s);
    const double h = 1e-4, largest_u = s.largest();
    const Eigen::VectorXd load = fit.load_weights(s.u).cwiseProduct(s.u);
    for(Eigen::Index i = 0; i < 3; ++i)
    {
      std::array<double, 2> value;
      for(int k = 0; k < 2; ++k)
      {
        Curved_cones other = s;
        other.curvatures[i] += k == 0 ? -h : h;
        fit.apply(other);
        value[std::size_t(k)] = std::pow(other.value / largest_u, exponent) / exponent;
      }
      const Index c = s.cones[std::size_t(i)];
      const double found = p[c] + load[c] * model->excess(c, s.curvatures[i]).second; // where u is not linear in the curvature
      const double expected = (value[1] - value[0]) / (2 * h) * largest_u * largest_u; // weights are relative to the largest |u|
      BOOST_TEST(std::abs(found - expected) <= 1e-3 * p.cwiseAbs().maxCoeff()); // the preconditioner is one in single precision
    }
  }
}

// Surfaces that are flat but for their corners need nothing else, and have u = 0.
BOOST_AUTO_TEST_CASE(corners_of_regular_solids_are_found)
{
  for(const Soup& soup : {divided(tetrahedron(), 3), divided(octahedron(), 3), divided(cube(), 3)})
    for(const CE::Cone_measure measure : {CE::Cone_measure::ROOT_MEAN_SQUARE_U, CE::Cone_measure::MAXIMUM_U})
    {
      const Triangulation t = triangulation(soup);
      std::vector<Index> corners;
      std::vector<double> angles;
      for(Index v = 0; v < t.number_of_vertices(); ++v)
      {
        double angle = 0;
        t.for_each_outgoing(v, [&](Index h) { angle += angle_at(soup, t.origin(h), t.target(h), t.apex(h)); });
        if(std::abs(angle - 2 * pi) > 0.1)
        {
          corners.push_back(v);
          angles.push_back(angle);
        }
      }
      const auto placement = CE::place_cones(t, params::number_of_cones(corners.size()).cone_measure(measure));
      BOOST_REQUIRE(bool(placement));
      BOOST_TEST((placement.cones == corners));
      BOOST_TEST(placement.root_mean_square <= 1e-6); // angles are found up to the 1e-10 of the columns, and again at the metric
      for(std::size_t i = 0; i < angles.size() && placement.cones == corners; ++i)
        BOOST_TEST(std::abs(placement.angles[i].radians() - angles[i]) <= 1e-6);
    }
}

// Each measure is the least where it is aimed at.
BOOST_AUTO_TEST_CASE(what_is_aimed_at_is_best, * slow())
{
  for(const Soup& soup : {bumps(24), arms(3), scaled(icosphere(3), 1, 1, 3)})
    for(const std::size_t n : {4u, 8u})
    {
      const Triangulation t = triangulation(soup);
      const auto aimed_at = [&](CE::Cone_measure measure) { return CE::place_cones(t, params::number_of_cones(n).cone_measure(measure)); };
      const auto most = aimed_at(CE::Cone_measure::MAXIMUM_U), mean = aimed_at(CE::Cone_measure::ROOT_MEAN_SQUARE_U),
                 area = aimed_at(CE::Cone_measure::AREA_DISTORTION);
      const auto zero = CE::place_cones(t, params::number_of_cones(n).cone_angles(CE::Cone_angles::ZERO_U));
      for(const auto& placement : {most, mean, area, zero})
      {
        BOOST_REQUIRE(bool(placement));
        BOOST_TEST(placement.cones.size() == n);
        BOOST_TEST(most.maximum_log_scale_factor <= 1.2 * placement.maximum_log_scale_factor); // places are those of a search
        BOOST_TEST(mean.root_mean_square <= 1.1 * placement.root_mean_square);
        BOOST_TEST(std::log(area.area_distortion) <= 1.2 * std::log(placement.area_distortion)); // aimed at by the range of u
        for(const auto& angle : placement.angles)
          BOOST_TEST(angle.radians() > 0);
      }
    }
}

// Chosen angles are no worse than u = 0 at the cones where the model foresees the metric badly (pinion), nor where few vertices with a large |u|
// determine the angles (elephant, femur: curvatures at their bounds, which have to keep their sum).
BOOST_AUTO_TEST_CASE(chosen_angles_are_no_worse_than_zero_u, * needs_mesh("pinion.off") * slow())
{
  for(const char* name : {"pinion.off", "elephant.off", "femur.off", "pig.off", "anchor.off", "rotor.off", "eight.off"})
  {
    const auto imported = CE::import_mesh(read_mesh(name));
    const auto placed = [&](CE::Cone_angles angles)
    { return CE::place_cones(imported.triangulation, params::number_of_cones(std::size_t(8)).cone_angles(angles)); };
    const auto chosen = placed(CE::Cone_angles::CHOSEN), zero = placed(CE::Cone_angles::ZERO_U);
    BOOST_TEST_INFO(name);
    BOOST_TEST_REQUIRE(bool(chosen));
    BOOST_TEST_REQUIRE(bool(zero));
    BOOST_TEST(chosen.maximum_log_scale_factor <= zero.maximum_log_scale_factor);
    double curvature = 0;
    for(const auto& angle : chosen.angles)
      curvature += 2 * pi - angle.radians();
    if(only_component(imported.triangulation).number_of_borders == 0)
      BOOST_TEST(std::abs(curvature - 2 * pi * double(only_component(imported.triangulation).euler_characteristic())) <= 1e-6);
    const bool is_needle = name == std::string("elephant.off") || name == std::string("femur.off");
    if(is_needle)
      BOOST_TEST(chosen.maximum_log_scale_factor <= 0.5 * zero.maximum_log_scale_factor);
  }
}

// Multiples by closest vectors, at places that suit them: no worse than angles rounded afterwards, but for what the search leaves.
BOOST_AUTO_TEST_CASE(multiples_are_chosen_for_the_root_mean_square)
{
  for(const Soup& soup : testing::cases<Soup>({bumps(20), arms(3), torus(24, 12), scaled(icosphere(3), 1, 1, 3)}))
    for(const int n : {3, 4})
    {
      const Triangulation t = triangulation(soup);
      const auto np = params::number_of_cones(std::size_t(8)).angle_quantum(2 * pi / n);
      const auto chosen = CE::place_cones(t, np.cone_measure(CE::Cone_measure::ROOT_MEAN_SQUARE_U));
      const auto rounded = CE::place_cones(t, np.cone_angles(CE::Cone_angles::ZERO_U));
      BOOST_REQUIRE_MESSAGE(bool(chosen), CE::message(chosen.status));
      BOOST_REQUIRE(bool(rounded));
      BOOST_TEST(chosen.is_rounded);
      BOOST_TEST(chosen.cones.size() + chosen.flattened.size() == 8);
      BOOST_TEST(chosen.free_angles.size() == chosen.cones.size());
      BOOST_TEST(chosen.root_mean_square <= 1.02 * rounded.root_mean_square);
      const long quantum = 2 * CE::Exact_angle<double>::units_of_pi / n;
      long curvature = 0;
      for(const auto& angle : chosen.angles)
      {
        BOOST_TEST(angle.is_exact());
        BOOST_TEST(angle.units > 0);
        BOOST_TEST(angle.units % quantum == 0);
        BOOST_TEST(angle.units != n * quantum);
        curvature += n * quantum - angle.units;
      }
      if(only_component(t).number_of_borders == 0)
        BOOST_TEST(curvature == long(only_component(t).euler_characteristic()) * n * quantum);
    }
  const auto cubic = CE::place_cones(triangulation(divided(cube(), 3)), params::number_of_cones(std::size_t(8)).angle_quantum(pi / 2)
                                                                            .cone_measure(CE::Cone_measure::ROOT_MEAN_SQUARE_U));
  BOOST_REQUIRE(bool(cubic));
  BOOST_TEST((cubic.cones == std::vector<Index>{0, 1, 2, 3, 4, 5, 6, 7}));
  BOOST_TEST(cubic.root_mean_square <= unmoved_u);
}

BOOST_AUTO_TEST_CASE(a_bound_on_the_root_mean_square_is_met_or_the_best_is_returned)
{
  const Triangulation t = triangulation(arms(3));
  const auto two = CE::place_cones(t, params::number_of_cones(std::size_t(3)).cone_measure(CE::Cone_measure::ROOT_MEAN_SQUARE_U));
  BOOST_REQUIRE(bool(two));
  const double bound = two.root_mean_square / 2;
  const auto met = CE::place_cones(t, params::maximum_root_mean_square(bound));
  BOOST_REQUIRE(bool(met));
  BOOST_TEST(met.root_mean_square <= bound);
  BOOST_TEST(met.cones.size() > 3);
  const auto missed = CE::place_cones(t, params::maximum_root_mean_square(bound / 1000).number_of_cones(std::size_t(4)));
  BOOST_TEST((missed.status == CE::Status::BOUND_NOT_MET));
  BOOST_TEST(missed.cones.size() == 4);
  BOOST_TEST(missed.amount == missed.root_mean_square);
}

// ---- Placements

BOOST_AUTO_TEST_CASE(cones_make_it_better_and_optimization_no_worse_than_the_greedy_placement)
{
  for(const Soup& soup : {bumps(24), arms(3)})
  {
    const Triangulation t = triangulation(soup);
    Search search(t, only_component(t), CE::internal::make_factorization<CE::Default_solver_traits>(), CE::Cone_measure::MAXIMUM_U);
    BOOST_REQUIRE(search.factorize());
    for(std::size_t n : {3u, 5u})
    {
      Placement greedy = search.without_cones(std::vector<double>(t.number_of_vertices(), 0.));
      BOOST_REQUIRE(search.relax(greedy, 20));
      while(greedy.cones.size() < n)
      {
        Search::add(greedy, search.worst_vertex(greedy));
        BOOST_REQUIRE(search.relax(greedy, 20, search_tolerance));
      }
      const auto placement = CE::place_cones(t, params::number_of_cones(n).cone_angles(CE::Cone_angles::ZERO_U));
      BOOST_REQUIRE(bool(placement));
      BOOST_TEST(placement.cones.size() == n);
      BOOST_TEST(std::is_sorted(placement.cones.begin(), placement.cones.end()));
      BOOST_TEST(placement.maximum_log_scale_factor <= greedy.measure + searched_u);
      for(Index c : placement.cones)
        BOOST_TEST(std::abs(placement.metric.log_scale_factors[c]) == 0);
      for(std::size_t i = 0; i < n; ++i)
        BOOST_TEST(placement.angles[i].radians() == placement.free_angles[i]);
    }
  }
  const Triangulation t = triangulation(bumps(24));
  BOOST_TEST(CE::place_cones(t, params::number_of_cones(3)).maximum_log_scale_factor < 0.6 * u_without_cones(t));
}

BOOST_AUTO_TEST_CASE(a_bound_is_met_or_the_best_is_returned)
{
  const Triangulation t = triangulation(bumps(24));
  const double before = u_without_cones(t);
  const auto met = CE::place_cones(t, params::maximum_log_scale_factor(before / 2));
  BOOST_REQUIRE(bool(met));
  BOOST_TEST(met.maximum_log_scale_factor <= before / 2);
  BOOST_TEST(met.cones.size() >= 1);
  const auto none = CE::place_cones(t, params::maximum_log_scale_factor(before + 1));
  BOOST_TEST(bool(none));
  BOOST_TEST(none.cones.empty());
  const auto missed = CE::place_cones(t, params::maximum_log_scale_factor(before / 100).number_of_cones(std::size_t(2)));
  BOOST_TEST((missed.status == CE::Status::BOUND_NOT_MET));
  BOOST_TEST(missed.cones.size() == 2);
  BOOST_TEST(missed.amount == missed.maximum_log_scale_factor);
  BOOST_TEST(missed.amount > before / 100);
}

// The search measures u to first order; what counts is the exact metric. For smaller bounds, too, if one is met.
BOOST_AUTO_TEST_CASE(the_exact_metric_meets_the_bound, * slow())
{
  for(const Soup& soup : {icosphere(2), icosphere(3), scaled(icosahedron(), 100, 1, 1), scaled(icosphere(2), 1, 1, 8), arms(2)})
    for(const double bound : {.5, 1., 1.5, 2., 3., 4.})
    {
      const Triangulation t = triangulation(soup);
      const auto placement = CE::place_cones(t, params::maximum_log_scale_factor(bound));
      BOOST_TEST_INFO(t.number_of_vertices() << " vertices, bound " << bound);
      BOOST_TEST((placement.status == CE::Status::OK));
      BOOST_TEST(largest(placement.metric.log_scale_factors) <= bound);
    }
}

// The areas of the triangles, computed otherwise: by Heron's formula from scaled lengths.
BOOST_AUTO_TEST_CASE(a_bound_on_areas_is_met_or_the_best_is_returned)
{
  const auto distortion = [](const Triangulation& t, const std::vector<double>& u)
  {
    const auto areas = [&](double factor)
    {
      std::vector<double> result;
      for(Index f = 0; f < t.number_of_faces(); ++f)
      {
        std::array<double, 3> l;
        for(Index k = 0; k < 3; ++k)
        {
          const Index h = 3 * f + k;
          l[k] = t.length(t.edge(h)) * std::exp(factor * (u[t.origin(h)] + u[t.target(h)]) / 2);
        }
        const double s = (l[0] + l[1] + l[2]) / 2;
        result.push_back(std::sqrt(s * (s - l[0]) * (s - l[1]) * (s - l[2])));
      }
      return result;
    };
    const std::vector<double> before = areas(0), after = areas(1);
    const double mean = std::accumulate(after.begin(), after.end(), 0.) / std::accumulate(before.begin(), before.end(), 0.);
    double largest = 1;
    for(std::size_t f = 0; f < before.size(); ++f)
    {
      const double a = after[f] / before[f] / mean;
      largest = (std::max)(largest, (std::max)(a, 1 / a));
    }
    return largest;
  };
  const Triangulation t = triangulation(bumps(24));
  const double before = distortion(t, CE::compute_conformal_metric(t, CE::Conformal_conditions<double>(t)).log_scale_factors);
  const auto met = CE::place_cones(t, params::maximum_area_distortion(0.7 * before));
  BOOST_REQUIRE(bool(met));
  BOOST_TEST(!met.metric.is_retriangulated());
  BOOST_TEST(met.area_distortion <= 0.7 * before);
  // Heron's formula loses the digits of the ratio of the perimeter and the least of s - l, which is below 1000 here
  BOOST_TEST(std::abs(met.area_distortion - distortion(t, met.metric.log_scale_factors)) <= 1000 * few_roundings * before);
  BOOST_TEST(met.cones.size() >= 1);
  const auto none = CE::place_cones(t, params::maximum_area_distortion(before * 1.01));
  BOOST_TEST(bool(none));
  BOOST_TEST(none.cones.empty());
  const auto missed = CE::place_cones(t, params::maximum_area_distortion(1.001).number_of_cones(std::size_t(2)));
  BOOST_TEST((missed.status == CE::Status::BOUND_NOT_MET));
  BOOST_TEST(missed.cones.size() == 2);
  BOOST_TEST(missed.amount == missed.area_distortion);
  BOOST_TEST(missed.amount > 1.001);

  // of two bounds that are not met, |u| is named; one that is met is not
  const auto both = CE::place_cones(t, params::maximum_area_distortion(1.001).maximum_log_scale_factor(1e-3).number_of_cones(std::size_t(2)));
  BOOST_TEST(both.amount == both.maximum_log_scale_factor);
  const auto one = CE::place_cones(t, params::maximum_area_distortion(1.001).maximum_log_scale_factor(10.).number_of_cones(std::size_t(2)));
  BOOST_TEST(one.amount == one.area_distortion);

  // lengths far from 1
  Soup small = bumps(24);
  for(Point& p : small.points)
    for(double& x : p)
      x *= std::ldexp(1., -450);
  const auto there = CE::place_cones(triangulation(small), params::number_of_cones(std::size_t(2)).cone_measure(CE::Cone_measure::AREA_DISTORTION));
  // angles are chosen by iterations that end at 1e-4 of the measure; these differ by roundings only
  BOOST_TEST(std::abs(there.area_distortion - missed.area_distortion) <= 1e-4 * missed.area_distortion);
}

// Where edges are flipped, no triangle of the metric is one of the surface.
BOOST_AUTO_TEST_CASE(areas_of_flipped_metrics_are_judged_at_vertices)
{
  const Triangulation t = triangulation(arms(2));
  const auto placement = CE::place_cones(t, params::number_of_cones(std::size_t(4)).retriangulation(CE::Retriangulation::ALWAYS));
  BOOST_REQUIRE(bool(placement));
  BOOST_REQUIRE(placement.metric.is_retriangulated());
  const auto extremes = std::minmax_element(placement.metric.log_scale_factors.begin(), placement.metric.log_scale_factors.end());
  const double range = *extremes.second - *extremes.first;
  BOOST_TEST(std::log(placement.area_distortion) >= range - few_roundings * (1 + range)); // the mean is in the middle
  BOOST_TEST(std::log(placement.area_distortion) <= 2 * range);           // or at one end
}

// A flat surface has nothing to gain: cones are anywhere, and none.
BOOST_AUTO_TEST_CASE(cones_of_flat_surfaces_have_the_angle_2_pi)
{
  const Triangulation t = triangulation(flat_grid(8));
  const auto placement = CE::place_cones(t, params::number_of_cones(std::size_t(3)));
  BOOST_REQUIRE(bool(placement));
  BOOST_TEST(placement.cones.size() == 3);
  for(double angle : placement.free_angles)
    BOOST_TEST(std::abs(angle - 2 * pi) <= solver_tolerance);
  BOOST_TEST(placement.maximum_log_scale_factor <= unmoved_u);
  BOOST_TEST(std::abs(placement.area_distortion - 1) <= 4 * unmoved_u);
  const auto rounded = CE::place_cones(t, params::number_of_cones(std::size_t(3)).angle_quantum(pi / 2));
  BOOST_REQUIRE(bool(rounded));
  BOOST_TEST(rounded.cones.empty());
  BOOST_TEST(rounded.flattened.size() == 3);
  BOOST_TEST(bool(CE::place_cones(t, params::maximum_area_distortion(1.0001))));
}

// What is asked of the factor grows with the cones, not with the places that they could have.
BOOST_AUTO_TEST_CASE(few_systems_are_solved)
{
  for(const Index n : {16u, 32u})
  {
    const Triangulation t = triangulation(bumps(n));
    for(const std::size_t n_cones : {2u, 6u})
    {
      const auto placement = CE::place_cones(t, params::number_of_cones(n_cones).angle_quantum(pi / 2));
      BOOST_REQUIRE(bool(placement));
      BOOST_TEST(placement.number_of_solves > n_cones);
      BOOST_TEST(placement.number_of_solves <= 300 + 150 * n_cones);
      BOOST_TEST(placement.metric.statistics.number_of_iterations <= 6); // the search was near
    }
  }
}

BOOST_AUTO_TEST_CASE(quantized_angles_are_multiples_and_satisfy_gauss_and_bonnet_exactly)
{
  for(const int n : {2, 3, 4, 6})
    for(const Soup& soup : {arms(3), torus(24, 12), bumps(20)})
    {
      const Triangulation t = triangulation(soup);
      const auto component = only_component(t);
      const auto placement = CE::place_cones(t, params::number_of_cones(std::size_t(6)).angle_quantum(2 * pi / n));
      BOOST_REQUIRE_MESSAGE(bool(placement), CE::message(placement.status));
      BOOST_TEST(placement.cones.size() + placement.flattened.size() == 6);
      const long quantum = 2 * CE::Exact_angle<double>::units_of_pi / n;
      long curvature = 0;
      for(const auto& angle : placement.angles)
      {
        BOOST_TEST(angle.is_exact());
        BOOST_TEST(angle.units > 0);
        BOOST_TEST(angle.units % quantum == 0);
        BOOST_TEST(angle.units != n * quantum); // those are no cones
        curvature += n * quantum - angle.units;
      }
      if(component.number_of_borders == 0)
        BOOST_TEST(curvature == long(component.euler_characteristic()) * n * quantum);
      BOOST_TEST(placement.metric.statistics.residual <= solver_tolerance);
      for(std::size_t i = 0; i < placement.cones.size(); ++i)
        BOOST_TEST(std::abs(CE::internal::angle_sum_at(placement.metric, placement.cones[i]) - placement.angles[i].radians()) <= layout_angle);
    }
}

// Vertices in another order: the same cones, on a surface without symmetries.
BOOST_AUTO_TEST_CASE(the_numbers_of_vertices_do_not_matter)
{
  Soup soup = bumps(20);
  add_noise(soup, 0.004, 3);
  const Index n = Index(soup.points.size());
  std::vector<Index> number(n);
  std::iota(number.begin(), number.end(), 0);
  Random random(5);
  for(Index i = n; i > 1; --i)
    std::swap(number[i - 1], number[random.below(i)]);
  Soup other = soup;
  for(Index v = 0; v < n; ++v)
    other.points[number[v]] = soup.points[v];
  for(auto& triangle : other.triangles)
    for(Index& v : triangle)
      v = number[v];
  const auto first = CE::place_cones(triangulation(soup), params::number_of_cones(std::size_t(4)));
  const auto second = CE::place_cones(triangulation(other), params::number_of_cones(std::size_t(4)));
  BOOST_REQUIRE(bool(first));
  BOOST_REQUIRE(bool(second));
  std::set<Index> expected, found(second.cones.begin(), second.cones.end());
  for(Index c : first.cones)
    expected.insert(number[c]);
  BOOST_TEST((expected == found));
}

// Whenever it is stopped: what has been found by then is a metric, or there is none.
// Agrees so many times to go on.
struct Impatient : public CE::Default_visitor
{
  int left;
  explicit Impatient(int n) : left(n) {}
  bool go_further() { return left-- > 0; }
};

// Returns how often a search that was stopped, at moments ever further apart, had found something by then.
template <typename NamedParameters>
int number_of_best_so_far(const Soup& soup, const NamedParameters& np)
{
  const Triangulation t = triangulation(soup);
  int n_best = 0;
  for(int n = 0; n < 10000; n += 1 + n / 16)
  {
    const auto placement = CE::place_cones(t, np.visitor(Impatient(n)));
    if(bool(placement))
      return n_best;
    BOOST_TEST((placement.status == CE::Status::STOPPED_BY_VISITOR));
    const bool is_found = bool(placement.metric) && !placement.metric.log_scale_factors.empty();
    if(is_found)
    {
      BOOST_TEST(placement.maximum_log_scale_factor == largest(placement.metric.log_scale_factors));
      ++n_best;
    }
    if(n % 8 != 0 && !(is_found && n_best == 1)) // a mesh gets the same
      continue;
    Mesh mesh = surface_mesh<Mesh>(soup);
    auto angle = mesh.add_property_map<Vertex, double>("v:angle", -1).first;
    const auto report = CE::place_cones(mesh, angle, np.visitor(Impatient(n)));
    BOOST_TEST((report.status == CE::Status::STOPPED_BY_VISITOR));
    BOOST_TEST(report.cones.size() == (is_found ? placement.cones.size() : 0));
    for(const auto& cone : report.cones)
      BOOST_TEST(cone.angle == angle[cone.vertex]);
    if(!is_found)
      BOOST_TEST(angle[Vertex(0)] == -1); // as it was
  }
  BOOST_ERROR("the search does not end");
  return n_best;
}

BOOST_AUTO_TEST_CASE(the_best_so_far_is_returned_when_the_visitor_stops)
{
  number_of_best_so_far(arms(3), params::number_of_cones(std::size_t(5)));
  // here cones are added one by one, each with a metric, until the bound is met
  for(const Soup& soup : testing::cases<Soup>({scaled(icosahedron(), 100, 1, 1), bumps(12)}))
    BOOST_TEST(number_of_best_so_far(soup, params::maximum_log_scale_factor(.5)) > 0);
}

BOOST_AUTO_TEST_CASE(the_visitor_is_told_of_each_cone)
{
  struct Listener : public CE::Default_visitor
  {
    std::vector<CE::Stage> stages;
    std::vector<std::pair<std::size_t, double> > told;
    void on_stage(CE::Stage stage) { stages.push_back(stage); }
    void on_progress(CE::Stage stage, std::size_t number, double measure)
    {
      if(stage == CE::Stage::FLIP) // told of where the machine is slow
        return;
      BOOST_TEST((stage == CE::Stage::PLACE));
      told.emplace_back(number, measure);
    }
  };
  struct Silent // has what the concept asks for, and no more
  {
    void on_stage(CE::Stage) {}
    void on_iteration(std::size_t, double) {}
    bool go_further() { return true; }
  };
  const Triangulation t = triangulation(arms(3));
  const std::size_t n = 6;
  for(const CE::Cone_angles angles : {CE::Cone_angles::CHOSEN, CE::Cone_angles::ZERO_U})
  {
    const auto np = params::number_of_cones(n).cone_angles(angles);
    Listener listener;
    const auto placement = CE::place_cones(t, params::number_of_cones(n).cone_angles(angles).visitor(std::ref(listener)));
    BOOST_REQUIRE(bool(placement));
    BOOST_TEST((std::find(listener.stages.begin(), listener.stages.end(), CE::Stage::PLACE) != listener.stages.end()));
    std::size_t most = 0;
    for(const auto& x : listener.told)
    {
      BOOST_TEST(x.first <= most + 1); // no cone is left out
      BOOST_TEST((std::isfinite(x.second) && x.second > 0));
      most = (std::max)(most, x.first);
    }
    BOOST_TEST(most == n);
    // being told changes nothing
    BOOST_TEST((CE::place_cones(t, np).cones == placement.cones));
    BOOST_TEST((CE::place_cones(t, params::number_of_cones(n).cone_angles(angles).visitor(Silent())).cones == placement.cones));
  }
  BOOST_TEST(std::string(CE::stage_name(CE::Stage::PLACE)) == "placing cones");
}

BOOST_AUTO_TEST_CASE(what_cannot_be_is_refused)
{
  using CE::Status;
  const auto status = [](const Soup& soup, const auto& np) { return CE::place_cones(triangulation(soup), np).status; };
  const Soup disk = bumps(6), sphere = icosphere(1);
  const std::size_t one = 1, two = 2, three = 3, many = 100000;
  BOOST_TEST((status(disk, params::number_of_sweeps(two)) == Status::MISSING_CONDITION)); // neither number nor bound
  BOOST_TEST((status(disk, params::maximum_area_distortion(0.).maximum_log_scale_factor(0.)) == Status::MISSING_CONDITION)); // no bounds
  BOOST_TEST((status(disk, params::maximum_area_distortion(100.)) == Status::OK));
  BOOST_TEST((status(sphere, params::number_of_cones(one)) == Status::MISSING_CONDITION));
  BOOST_TEST((status(sphere, params::number_of_cones(two)) == Status::MISSING_CONDITION));
  BOOST_TEST((status(sphere, params::number_of_cones(three)) == Status::OK));
  BOOST_TEST((status(disk, params::number_of_cones(many)) == Status::TOO_MANY_CONES));
  BOOST_TEST((status(flat_grid(1), params::number_of_cones(one)) == Status::TOO_MANY_CONES)); // no vertex inside
  BOOST_TEST((status(disk, params::number_of_cones(one).angle_quantum(1.)) == Status::ANGLE_OUT_OF_RANGE));
  BOOST_TEST((status(disk, params::number_of_cones(one).angle_quantum(-1.)) == Status::OK)); // none
  BOOST_TEST((status(sphere, params::number_of_cones(three).angle_quantum(pi)) == Status::NOT_QUANTIZABLE)); // three times pi at least
  BOOST_TEST((status(together({disk, disk}), params::number_of_cones(one)) == Status::WRONG_TOPOLOGY));
  BOOST_TEST((status(Soup(), params::number_of_cones(one)) == Status::EMPTY_MESH));
}

// ---- Meshes

BOOST_AUTO_TEST_CASE(a_mesh_is_flattened_with_the_angles_written)
{
  Mesh mesh = surface_mesh<Mesh>(arms(3));
  auto angle = mesh.add_property_map<Vertex, double>("v:angle", -1).first;
  auto u = mesh.add_property_map<Vertex, double>("v:u", -1).first;
  auto uv = mesh.add_property_map<Halfedge, Point_2>("h:uv").first;
  const auto report = CE::place_cones(mesh, angle, params::number_of_cones(std::size_t(6)).angle_quantum(pi / 2).log_scale_factor_map(u));
  BOOST_REQUIRE(bool(report));
  BOOST_TEST(!report.cones.empty());
  BOOST_TEST(report.cones.size() + report.flattened_cones.size() == 6);
  double free_curvature = 0;
  for(const auto& cone : report.cones)
  {
    BOOST_TEST(cone.vertex_index == cone.vertex.idx());
    BOOST_TEST(cone.angle == angle[cone.vertex]);
    BOOST_TEST(!cone.is_free);
    BOOST_TEST(std::abs(cone.free_angle - cone.angle) < pi); // (by more than a quarter of a turn only where the sum asks for it)
    free_curvature += 2 * pi - cone.free_angle;
  }
  for(Vertex v : report.flattened_cones)
    BOOST_TEST(angle[v] == 2 * pi);
  if(report.flattened_cones.empty())
    BOOST_TEST(std::abs(free_curvature - 4 * pi) <= 1e-6 * double(num_vertices(mesh))); // where residuals are 1e-6, the search ends
  double curvature = 0, most = 0;
  for(Vertex v : vertices(mesh))
  {
    curvature += 2 * pi - angle[v];
    most = (std::max)(most, std::abs(u[v]));
  }
  BOOST_TEST(std::abs(curvature - 4 * pi) <= 2 * pi * unit_roundoff * double(num_vertices(mesh))); // a sum of rounded angles
  const auto flat = CE::flatten(mesh, uv, params::cone_angle_map(angle));
  BOOST_REQUIRE_MESSAGE(bool(flat), CE::message(flat));
  BOOST_TEST(flat.cones.size() == report.cones.size());
  BOOST_TEST(most < 5); // arms without cones have more

  // bad input leaves the map alone
  std::fill(angle.begin(), angle.end(), -1);
  const auto refused = CE::place_cones(mesh, angle, params::number_of_cones(std::size_t(2)));
  BOOST_TEST((refused.status == CE::Status::MISSING_CONDITION));
  for(Vertex v : vertices(mesh))
    BOOST_TEST(angle[v] == -1);
}

// The five cones of the paper's Lion: all become 3 pi / 2.
BOOST_AUTO_TEST_CASE(five_cones_on_the_lion, *needs_mesh("lion-head.off"))
{
  const Mesh mesh = read_mesh("lion-head.off");
  const auto imported = CE::import_mesh(mesh);
  const auto placement = CE::place_cones(imported.triangulation, params::number_of_cones(std::size_t(5)).angle_quantum(pi / 2));
  BOOST_REQUIRE(bool(placement));
  BOOST_TEST(placement.cones.size() == 5);
  for(const auto& angle : placement.angles)
    BOOST_TEST(angle.units == 3 * CE::Exact_angle<double>::units_of_pi / 2);
  BOOST_TEST(placement.maximum_log_scale_factor <= 1.14);
  BOOST_TEST(placement.metric.statistics.number_of_iterations <= 6);
}
