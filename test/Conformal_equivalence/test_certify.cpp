// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Certificates: given to layouts that are one-to-one, with as many digits as that takes, and to no others; against exact predicates of
// CGAL where the numbers are of type double, and against known angles. (Needs MPFR, as certify.h does.)

#define BOOST_TEST_MODULE test_certify
#include "include/boost_test.h"
#include "include/index_level.h"

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/certify.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/compute_cut_graph.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;
using namespace testing;
using CE::Retriangulation;
using CE::Status;

namespace {

typedef CE::Layout_certificate  Certificate;
typedef std::vector<Index>      Indices;

// certify.h promises the angles around cones and on the cut up to this.
constexpr double promised_angle_error = 1e-10;

// The digits of the first attempt: pairs of double.
constexpr unsigned int pair = 106;

// A tube with one end closed by a cap: u falls by about 1 over the length of a radius.
Soup rod(Index length)
{
  const Index n = 8;
  Soup soup = tube(2 * length, n, false, [=](Index i, Index j)
  {
    const double x = 2 * pi * (j + .25 * (i % 2)) / n;
    return Point{{std::cos(x), std::sin(x), .5 * i}};
  });
  const Index apex = Index(soup.points.size());
  soup.points.push_back({{0, 0, -.5}});
  for(Index j = 0; j < n; ++j)
    soup.triangles.push_back({{apex, j, (j + 1) % n}});
  return soup;
}

struct Problem
{
  Triangulation t;
  Conditions conditions;
  Metric metric;
  CE::Cut_graph cut;

  explicit Problem(const Soup& soup) : t(triangulation(soup)), conditions(t) {}
  Problem(const Soup& soup, Retriangulation mode) : Problem(soup) { solve(mode, {}); }

  void solve(Retriangulation mode, const Indices& cones)
  {
    metric = CE::compute_conformal_metric(t, conditions, params::retriangulation(mode));
    cut = CE::compute_cut_graph(t, cones);
    BOOST_REQUIRE(bool(metric));
    BOOST_REQUIRE(bool(cut));
  }

  Certificate certify(unsigned int most = 4096) const { return CE::certify_layout(t, metric, cut, conditions, most); }
};

// A vertex of hill(8, ...), in the middle.
constexpr Index inner_vertex = 40;

// The triangles of a metric without flips that are not positive in the plane, by their corners of type double, exactly.
std::size_t number_of_lost_triangles(const Problem& problem)
{
  typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_2 Point_2;
  const CE::Common_refinement<double> r = CE::compute_common_refinement(problem.t, problem.metric, problem.cut);
  BOOST_REQUIRE(bool(r));
  BOOST_REQUIRE(r.number_of_faces() == problem.t.number_of_faces());
  std::size_t result = 0;
  for(Index f = 0; f < r.number_of_faces(); ++f)
  {
    const auto corner = [&](Index k)
    {
      const auto& p = r.corner_uv[r.first_corner[f] + k];
      return Point_2(p[0], p[1]);
    };
    result += CGAL::left_turn(corner(0), corner(1), corner(2)) ? 0 : 1;
  }
  return result;
}

} // namespace

// --- layouts that are one-to-one ----------------------------------------------------------------

BOOST_AUTO_TEST_CASE(without_need_of_digits)
{
  for(const Retriangulation mode : { Retriangulation::NEVER, Retriangulation::ALWAYS })
  {
    const Problem problem(hill(10, .9), mode);
    const Certificate certificate = problem.certify();
    BOOST_TEST(bool(certificate));
    BOOST_TEST((certificate.status == Status::OK));
    BOOST_TEST(certificate.precision_in_bits == pair);
    BOOST_TEST(certificate.number_of_faces >= problem.t.number_of_faces());
    BOOST_TEST((certificate.number_of_faces > problem.t.number_of_faces()) == problem.metric.is_retriangulated());
    BOOST_TEST(certificate.number_of_faces_lost_in_double == 0u);
    // the sum of six angles, each of which a few roundings of coordinates change by some units of their last place times the width of the
    // layout in edges, which is ten
    BOOST_TEST(certificate.angle_error <= 6 * 10 * 16 * std::ldexp(1., -53));
    BOOST_TEST(certificate.residual == problem.metric.statistics.residual);
    BOOST_TEST(certificate.flipped_faces.empty());
    BOOST_TEST(certificate.turning_vertices.empty());
    BOOST_TEST(certificate.exempt_faces.empty());
  }
  const Problem problem(hill(10, .9), Retriangulation::NEVER);
  BOOST_TEST(number_of_lost_triangles(problem) == 0u);
}

// The triangle a, b, c is a segment. Its longest side is flipped, and its parts have area in the plane.
BOOST_AUTO_TEST_CASE(zero_area_faces)
{
  const Soup soup{{{{0, 0, 0}}, {{2, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}, {{1, -1, 0}}},
                  {{{0, 2, 3}}, {{2, 1, 3}}, {{0, 1, 2}}, {{1, 0, 4}}}};
  for(const Retriangulation mode : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
  {
    const Problem problem(soup, mode);
    BOOST_TEST(problem.metric.is_retriangulated());
    const Certificate certificate = problem.certify();
    BOOST_TEST(bool(certificate));
    BOOST_TEST(certificate.exempt_faces.empty());
    BOOST_TEST(certificate.number_of_faces > 4u);
  }
}

// Angles of a rectangle on the border, which flips have to go round: the metric is one of the double of the surface.
BOOST_AUTO_TEST_CASE(borders_with_angles)
{
  Problem problem(hill(8, .7));
  for(Index v = 0; v < problem.t.number_of_vertices(); ++v)
    if(problem.t.is_border_vertex(v))
      problem.conditions.prescribe_angle_sum(v, Angle::pi_times(1, v == 0 || v == 8 || v == 72 || v == 80 ? 2 : 1));
  for(const Retriangulation mode : { Retriangulation::NEVER, Retriangulation::ALWAYS })
  {
    problem.solve(mode, {});
    const Certificate certificate = problem.certify();
    BOOST_TEST(bool(certificate));
    BOOST_TEST(certificate.angle_error <= promised_angle_error);
  }
}

// Beside the open end of the rod, the digits of double hold triangles that are smaller by 2^-53; pairs of them go twice as far. A border that is not
// equally wide on all sides moves the closed end away from the middle of the layout, where the origin is: close to it, there are digits for triangles
// of any size.
BOOST_AUTO_TEST_CASE(triangles_that_are_lost_in_double)
{
  Problem problem(rod(60));
  for(Index v = 0; v < problem.t.number_of_vertices(); ++v)
    if(problem.t.is_border_vertex(v))
      problem.conditions.fix_log_scale_factor(v, v % 8 == 0 ? .3 : 0);
  problem.solve(Retriangulation::NEVER, {});
  const double least = *std::min_element(problem.metric.log_scale_factors.begin(), problem.metric.log_scale_factors.end());
  BOOST_TEST(least < -std::log(2.) * 53);
  BOOST_TEST(least > -std::log(2.) * 100);
  const Certificate certificate = problem.certify();
  BOOST_TEST(bool(certificate));
  BOOST_TEST(certificate.precision_in_bits == pair);
  BOOST_TEST(certificate.number_of_faces_lost_in_double > 0u);
  BOOST_TEST(certificate.number_of_faces_lost_in_double == number_of_lost_triangles(problem));
}

BOOST_AUTO_TEST_CASE(the_precision_is_chosen)
{
  const Problem problem(rod(120), Retriangulation::NEVER);
  const double least = *std::min_element(problem.metric.log_scale_factors.begin(), problem.metric.log_scale_factors.end());
  BOOST_TEST(least < -std::log(2.) * pair); // these digits do not hold both ends
  const Certificate certificate = problem.certify();
  BOOST_TEST(bool(certificate));
  BOOST_TEST(certificate.precision_in_bits >= 2 * pair);
  BOOST_TEST(certificate.residual < std::ldexp(1., 10 - int(certificate.precision_in_bits)));
  BOOST_TEST(certificate.number_of_faces_lost_in_double > 0u);
  BOOST_TEST(certificate.number_of_faces_lost_in_double < certificate.number_of_faces);

  const Certificate cheap = problem.certify(200); // which allows no more than pairs of double
  BOOST_TEST(!cheap);
  BOOST_TEST((cheap.status == Status::NOT_INJECTIVE));
  BOOST_TEST(cheap.precision_in_bits == pair);
  BOOST_TEST(!cheap.flipped_faces.empty());
  // more digits make less
  BOOST_TEST(cheap.number_of_faces_lost_in_double <= cheap.number_of_faces - cheap.flipped_faces.size());
}

// --- layouts that are not -----------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(a_metric_whose_triangles_do_not_fit)
{
  Problem problem(hill(8, .7), Retriangulation::NEVER);
  BOOST_REQUIRE(!problem.t.is_border_vertex(inner_vertex));
  BOOST_TEST(bool(problem.certify(pair)));
  problem.metric.scale_factors[inner_vertex] = problem.metric.scale_factors[inner_vertex] * 2.;
  problem.metric.statistics.residual = 1;
  const Certificate refused = problem.certify(pair);
  BOOST_TEST(!refused);
  BOOST_TEST((refused.status == Status::NOT_INJECTIVE));
  BOOST_TEST(!refused.flipped_faces.empty());
  const Certificate solved_again = problem.certify(); // as the next attempt does first
  BOOST_TEST(bool(solved_again));
  BOOST_TEST(solved_again.precision_in_bits == 2 * pair);
}

BOOST_AUTO_TEST_CASE(conditions_that_were_not_solved_for)
{
  Problem problem(hill(8, .7), Retriangulation::NEVER);
  problem.conditions.prescribe_angle_sum(inner_vertex, Angle::pi_times(3));
  const Certificate certificate = problem.certify(pair);
  BOOST_TEST((certificate.status == Status::NOT_INJECTIVE));
  BOOST_TEST(certificate.turning_vertices == Indices{ inner_vertex });
  BOOST_TEST(certificate.flipped_faces.empty());
  BOOST_TEST(std::abs(certificate.angle_error - pi) <= promised_angle_error); // there are 2 pi
}

// A cone of 4 pi that is not cut open has positive triangles all around it, twice.
BOOST_AUTO_TEST_CASE(a_branch_point)
{
  Problem problem(hill(8, .7));
  problem.conditions.prescribe_angle_sum(inner_vertex, Angle::pi_times(4));
  problem.solve(Retriangulation::WHEN_NEEDED, {});
  const Certificate refused = problem.certify();
  BOOST_TEST((refused.status == Status::NOT_INJECTIVE));
  BOOST_TEST(refused.turning_vertices == Indices{ inner_vertex });
  BOOST_TEST(refused.flipped_faces.empty());
  BOOST_TEST(refused.angle_error <= promised_angle_error);
  problem.solve(Retriangulation::WHEN_NEEDED, { inner_vertex });
  BOOST_TEST(bool(problem.certify()));
}

// Where u is held up by its lower bound there is less than the angle prescribed: a cone, which must lie on the cut.
BOOST_AUTO_TEST_CASE(an_active_bound)
{
  Problem problem(hill(8, .7));
  problem.conditions.prescribe_angle_sum_above(inner_vertex, Angle::pi_times(2), 1.);
  problem.solve(Retriangulation::NEVER, { inner_vertex });
  BOOST_REQUIRE(problem.metric.active_bounds == Indices{ inner_vertex });
  const Certificate certificate = problem.certify();
  BOOST_TEST(bool(certificate));
  BOOST_TEST(certificate.angle_error <= promised_angle_error); // less than the bound is no error
  problem.cut = CE::compute_cut_graph(problem.t, {});
  const Certificate refused = problem.certify(pair);
  BOOST_TEST((refused.status == Status::NOT_INJECTIVE));
  BOOST_TEST(!refused.is_certified);
}

BOOST_AUTO_TEST_CASE(nothing_to_certify)
{
  const Triangulation empty;
  const Certificate certificate = CE::certify_layout(empty, Metric(), CE::Cut_graph(), Conditions(empty));
  BOOST_TEST(!certificate);
  BOOST_TEST((certificate.status == Status::EMPTY_MESH));
}

// --- conditions in another number type ----------------------------------------------------------

BOOST_AUTO_TEST_CASE(conditions_are_converted_exactly)
{
  const Triangulation t = triangulation(hill(3, .5));
  Conditions given(t);
  const double third = 1. / 3;
  given.fix_log_scale_factor(0, third);
  given.prescribe_angle_sum(1, Angle::pi_times(5, 7));
  given.prescribe_angle_sum(2, Angle(third));
  given.prescribe_angle_sum_above(3, Angle::pi_times(2), -third);
  const CE::Working_precision precision(200);
  typedef CE::Multiprecision_number Number;
  const auto wide = CE::internal::convert_conditions<Number>(t, given);
  BOOST_REQUIRE(wide.size() == given.size());
  for(Index v = 0; v < given.size(); ++v)
  {
    BOOST_TEST(wide.is_fixed(v) == given.is_fixed(v));
    BOOST_TEST(wide.is_bounded(v) == given.is_bounded(v));
    if(given.is_fixed(v))
      BOOST_TEST((wide.log_scale_factor(v) == Number(given.log_scale_factor(v))));
    else
    {
      BOOST_TEST(wide.angle_sum(v).units == given.angle_sum(v).units);
      BOOST_TEST((wide.angle_sum(v).rest == Number(given.angle_sum(v).rest)));
    }
    if(given.is_bounded(v))
      BOOST_TEST((wide.lower_bound(v) == Number(given.lower_bound(v))));
  }
}
