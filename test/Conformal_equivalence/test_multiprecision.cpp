// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The number type of MPFR, precision chosen at run time: everything that takes any number
// type, against computations by other means at higher precision.

#define BOOST_TEST_MODULE test_multiprecision
#include "include/boost_test.h"
#include "include/test_meshes.h"
#include "include/tolerances.h"

#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/conformal_energy.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/Lobachevsky.h>
#include <CGAL/Conformal_equivalence/internal/Solver/energy.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/length_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Wide_factorization.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_newton_step.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>
#include <CGAL/Conformal_equivalence/map_to_sphere.h>
#include <CGAL/Conformal_equivalence/multiprecision.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <boost/multiprecision/mpfr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace CEi = CGAL::Conformal_equivalence::internal;

typedef boost::multiprecision::mpfr_float Real;

namespace {

// 2^-200 is 6e-61; residuals, lengths and points are sums and products of some hundred numbers with that error.
const double rounded_to_200_bits = 1e-57;

int bits_of(const Real& x)
{
  return static_cast<int>(mpfr_get_prec(x.backend().data()));
}

// Sets the precision of new numbers, at least `bits`, for its lifetime.
class Working_precision
{
  unsigned before;

public:
  explicit Working_precision(int bits) : before(Real::default_precision())
  {
    Real::default_precision(static_cast<unsigned>(std::ceil(bits * .30103)));
  }
  Working_precision(const Working_precision&) = delete;
  Working_precision& operator=(const Working_precision&) = delete;
  ~Working_precision() { Real::default_precision(before); }
};

Real pi()
{
  Real result(0);
  mpfr_const_pi(result.backend().data(), MPFR_RNDN);
  return result;
}

// x at the working precision, which is wider
Real widened(const Real& x)
{
  Real result(0);
  mpfr_set(result.backend().data(), x.backend().data(), MPFR_RNDN);
  return result;
}

// -int_0^x log(2 sin t) dt, 0 < x <= pi/2, by tanh-sinh quadrature of step 2^-level:
// t = x q / (1 + q), q = exp(pi sinh s)
Real integral(const Real& x, int level)
{
  const int p = bits_of(x);
  const Real h = ldexp(Real(1), -level), constant = pi();
  const long n = static_cast<long>(std::ldexp(std::asinh((p + 20) * .6931 / 3.1415) + .1, level));
  Real sum(0);
  for(long i = -n; i <= n; ++i)
  {
    const Real e = exp(Real(i * h)), e_inverse = 1 / e;
    const Real q = exp(Real(constant * (e - e_inverse) / 2)), q_1 = 1 + q;
    const Real t = x * q / q_1;
    const Real weight = constant * (e + e_inverse) / 2 * q / (q_1 * q_1);
    sum += weight * log(Real(2 * sin(t)));
  }
  return -x * h * sum;
}

Real reference(const Real& x, int level)
{
  const Real constant = pi();
  const Real reflected = constant - x;
  if(reflected < x)
    return -integral(reflected, level);
  return integral(x, level);
}

void check_Lobachevsky(int bits, int level)
{
  Working_precision precision(bits);
  const CEi::Lobachevsky_function<Real> Lobachevsky{Real(1)};
  for(const char* text : { "1e-40", "0.4", "1.04", "1.05", "1.5", "1.5707963267948966192313216916397", "2.2", "3.1415926535" })
  {
    const Real x(text), got = Lobachevsky(x);
    BOOST_CHECK_EQUAL(bits_of(got), bits_of(x));
    const int p = bits_of(x);
    Working_precision wider(bits + 192); // relative to values down to 1e-32
    const Real exact = reference(widened(x), level), error = abs(Real(widened(got) - exact));
    BOOST_CHECK_LE(error, ldexp(Real(1), 2 - p));
    BOOST_CHECK_LE(error, ldexp(Real(abs(exact)), 4 - p));
  }
}

} // namespace

// A grid of the plane with weights that differ by 40 orders of magnitude, and some edges twice.
BOOST_AUTO_TEST_CASE(factorization_of_a_matrix_that_double_cannot_hold)
{
  const Working_precision precision(500);
  const std::uint32_t width = 12, n = width * width;
  std::vector<CEi::Matrix_position> lower;
  std::vector<Real> values, diagonal(n, Real(1e-30)), right(n), product(n, Real(0));
  const auto join = [&](std::uint32_t i, std::uint32_t j)
  {
    const Real weight = Real(std::pow(10., int((i * 37 + j * 11) % 41) - 20)) / 3;
    lower.emplace_back(j, i);
    values.push_back(-weight);
    diagonal[i] += weight;
    diagonal[j] += weight;
  };
  for(std::uint32_t i = 0; i < n; ++i)
  {
    if(i % width + 1 < width)
      join(i, i + 1);
    if(i + width < n)
      join(i, i + width);
    if(i % 5 == 0 && i + 1 < n && i % width + 1 < width)
      join(i, i + 1);
    right[i] = Real(int(i % 7) - 3);
  }
  for(std::uint32_t i = 0; i < n; ++i)
  {
    lower.emplace_back(i, i);
    values.push_back(diagonal[i]);
  }
  const CEi::Wide_factorization<Real> factor(n, lower, values);
  BOOST_TEST_REQUIRE(factor.is_regular());
  const std::vector<Real> x = factor.solve(right);
  for(std::size_t k = 0; k < lower.size(); ++k)
  {
    product[lower[k].first] += values[k] * x[lower[k].second];
    if(lower[k].first != lower[k].second)
      product[lower[k].second] += values[k] * x[lower[k].first];
  }
  Real largest(0);
  for(const Real& x_i : x)
    largest = (std::max)(largest, Real(abs(x_i)));
  for(std::uint32_t i = 0; i < n; ++i) // rounding, of a backward stable method
    BOOST_CHECK(abs(product[i] - right[i]) <= ldexp(Real(1), -480) * largest * diagonal[i]);

  // a row without anything on the diagonal
  const CEi::Wide_factorization<Real> singular(2, {{0, 0}, {1, 1}}, {Real(1), Real(0)});
  BOOST_TEST(!singular.is_regular());
}

BOOST_AUTO_TEST_CASE(precision_is_found)
{
  for(const int bits : { 60, 200, 1000 })
  {
    Working_precision precision(bits);
    const Real x(1.5);
    BOOST_CHECK_GE(bits_of(x), bits);
    BOOST_CHECK_EQUAL(CEi::precision_in_bits(x), bits_of(x));
  }
}

BOOST_AUTO_TEST_CASE(the_reference_is_right)
{
  Working_precision precision(1064);
  const Real x("1.3");
  BOOST_CHECK_LE(abs(Real(reference(x, 7) - reference(x, 8))), ldexp(Real(1), -1050));
}

BOOST_AUTO_TEST_CASE(Lobachevsky_at_200_bits)
{
  check_Lobachevsky(200, 6);
}

BOOST_AUTO_TEST_CASE(Lobachevsky_at_1000_bits)
{
  check_Lobachevsky(1000, 7);
}

BOOST_AUTO_TEST_CASE(Lobachevsky_at_1000_bits_identities)
{
  Working_precision precision(1000);
  const Real constant = pi();
  const CEi::Lobachevsky_function<Real> Lobachevsky{constant};
  Real catalan(0);
  mpfr_const_catalan(catalan.backend().data(), MPFR_RNDN);
  const Real unit = ldexp(Real(1), 1 - bits_of(constant));
  BOOST_CHECK_LE(abs(Real(Lobachevsky(Real(constant / 4)) - catalan / 2)), 4 * unit);
  BOOST_CHECK_LE(abs(Real(2 * Lobachevsky(Real(constant / 6)) - 3 * Lobachevsky(Real(constant / 3)))), 16 * unit);
  for(const double d : { .1, .7, 1.3, 2.9, 100. })
  {
    const Real x(d), shifted = x + constant / 2, doubled = 2 * x;
    BOOST_CHECK_EQUAL(Lobachevsky(Real(-x)), Real(-Lobachevsky(x)));
    // the argument is off by an ulp of x, the slope is below 5 here
    BOOST_CHECK_LE(abs(Real(Lobachevsky(doubled) - 2 * Lobachevsky(x) - 2 * Lobachevsky(shifted))), (16 + 20 * d) * unit);
  }
}

// A number keeps its own precision when that of new numbers is lower.
BOOST_AUTO_TEST_CASE(Lobachevsky_takes_the_precision_of_its_argument)
{
  Real x, exact;
  {
    Working_precision precision(500);
    x = Real("0.8");
    exact = CEi::Lobachevsky(x);
  }
  Working_precision precision(60);
  const Real got = CEi::Lobachevsky(x);
  BOOST_CHECK_EQUAL(bits_of(got), bits_of(x));
  BOOST_CHECK_EQUAL(got, exact);
}

BOOST_AUTO_TEST_CASE(predicates)
{
  Working_precision precision(1000);
  const Real one(1), ulp = ldexp(one, 2 - bits_of(one)), two(2), above = two + ulp, below = two - ulp / 2;
  BOOST_CHECK_LT(two, above);
  BOOST_CHECK_LT(below, two);
  BOOST_CHECK_EQUAL(CEi::triangle_inequality_sign(one, one, two), CGAL::ZERO);
  BOOST_CHECK_EQUAL(CEi::triangle_inequality_sign(one, one, above), CGAL::NEGATIVE);
  BOOST_CHECK_EQUAL(CEi::triangle_inequality_sign(one, one, below), CGAL::POSITIVE);
  BOOST_CHECK(CEi::is_degenerate_triangle(one, one, two) && CEi::is_triangle(one, below, one));
  const Real s = exp(Real(2000)); // beyond double
  BOOST_CHECK_EQUAL(CEi::scaled_triangle_inequality_sign(s, s, s, one, two, one), CGAL::ZERO);
  BOOST_CHECK_EQUAL(CEi::scaled_triangle_inequality_sign(s, s, s, one, above, one), CGAL::NEGATIVE);
  BOOST_CHECK_EQUAL(CEi::scaled_triangle_inequality_sign(s, s, s, one, below, one), CGAL::POSITIVE);
  Real wide;
  {
    Working_precision wider(2000);
    wide = Real(2) + ldexp(Real(1), -1900);
  }
  BOOST_CHECK_EQUAL(CEi::triangle_inequality_sign(one, one, wide), CGAL::NEGATIVE); // precisions may differ
}

// ---------------------------------------------------------------------------
// The energy, its gradient and its Hessian at 200 and 1000 bits, by central
// differences of step h = 2^(-p/3): these are off by h^2 and 2^-p / h.
// ---------------------------------------------------------------------------

std::vector<Real> moved(const std::vector<Real>& u, const std::vector<double>& d, const Real& h)
{
  std::vector<Real> result;
  for(std::size_t v = 0; v < u.size(); ++v)
    result.push_back(Real(u[v] + h * d[v]));
  return result;
}

// Small u, and u that break triangles.
void check_energy_at(int bits, double bound)
{
  Working_precision precision(bits);
  const auto t = testing::triangulation(testing::hill(2, .7));
  const std::vector<double> d = testing::random_numbers(t.number_of_vertices(), 1, 1);
  const std::vector<Real> target(d.size(), Real(2));
  const Real h = ldexp(Real(1), -bits / 3), limit = ldexp(Real(1000), -2 * (bits / 3));
  std::vector<Real> u;
  for(const double x : testing::random_numbers(d.size(), bound, 2))
    u.push_back(Real(x));

  CEi::Conformal_energy<Real, double> energy(t);
  const std::vector<Real> above = moved(u, d, h), below = moved(u, d, Real(-h));
  BOOST_REQUIRE(energy.evaluate(above));
  const std::vector<Real> more = energy.angle_sums();
  BOOST_REQUIRE(energy.evaluate(below));
  const std::vector<Real> less = energy.angle_sums();
  BOOST_REQUIRE(energy.evaluate(u));
  BOOST_CHECK_EQUAL(energy.broken_faces().empty(), bound < 1);

  std::vector<Real> direction;
  for(const double x : d)
    direction.push_back(Real(x));
  const std::vector<Real> hessian = energy.hessian_product(direction);
  Real slope(0), angles(0);
  for(std::size_t v = 0; v < d.size(); ++v)
  {
    angles += energy.angle_sums()[v];
    slope += (target[v] - energy.angle_sums()[v]) / 2 * d[v]; // (9)
    BOOST_CHECK_LE(abs(Real((less[v] - more[v]) / (4 * h) - hessian[v])), limit); // (10)
  }
  BOOST_CHECK_LE(abs(Real(angles - pi() * t.number_of_faces())), ldexp(Real(100), -bits));
  const Real rise = CE::conformal_energy(t, above, target) - CE::conformal_energy(t, below, target);
  BOOST_CHECK_LE(abs(Real(rise / (2 * h) - slope)), limit);

  // the same value as at twice the precision, to the last bits
  const Real value = CE::conformal_energy(t, u, target);
  Working_precision wider(2 * bits);
  std::vector<Real> wide_u;
  for(const Real& x : u)
    wide_u.push_back(widened(x));
  const Real exact = CE::conformal_energy(t, wide_u, std::vector<Real>(d.size(), Real(2)));
  BOOST_CHECK_LE(abs(Real(widened(value) - exact)), ldexp(Real(1000), -bits));
}

BOOST_AUTO_TEST_CASE(energy_gradient_and_hessian)
{
  for(const int bits : { 200, 1000 })
    for(const double bound : { .2, 4. })
      check_energy_at(bits, bound);
}

// ---------------------------------------------------------------------------
// The solver. Residuals are measured by something else: angles by atan2 with many more digits.
// ---------------------------------------------------------------------------

namespace {

typedef CE::Multiprecision_number Number; // the above, without expression templates
typedef CE::Retriangulation Retriangulation;

// The largest difference of an angle sum from its target, in the metric as it is; counted, not modulo anything.
template <typename NT>
Number measured_residual(const CE::Conformal_metric<NT>& metric, const CE::Conformal_conditions<NT>& conditions)
{
  const CE::Intrinsic_triangulation<NT>& t = metric.triangulation;
  std::vector<Number> s, sum(t.number_of_vertices(), Number(0));
  for(const auto& x : metric.scale_factors)
    s.push_back(CEi::convert_number<Number>(x));
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); h += 3)
  {
    std::array<Number, 3> l;
    for(std::uint32_t k = 0; k < 3; ++k)
      l[k] = s[t.origin(h + k)] * Number(t.halfedge_length(h + k)) * s[t.target(h + k)];
    const Number half = (l[0] + l[1] + l[2]) / 2, area = sqrt(Number(half * (half - l[0]) * (half - l[1]) * (half - l[2])));
    for(std::uint32_t k = 0; k < 3; ++k)
      sum[t.apex(h + k)] += 2 * atan2(area, Number(half * (half - l[k])));
  }
  Number result(0);
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!conditions.is_fixed(v))
      result = (std::max)(result, Number(abs(Number(sum[v] - conditions.angle_sum(v).template radians<Number>()))));
  return result;
}

template <typename NT>
CE::Conformal_metric<NT> solve(const CE::Intrinsic_triangulation<NT>& t, double tolerance)
{
  return CE::compute_conformal_metric(t, CE::Conformal_conditions<NT>(t), CGAL::parameters::gradient_tolerance(tolerance));
}

} // namespace

BOOST_AUTO_TEST_CASE(thirty_digits_by_pairs_of_double)
{
  const CE::Working_precision precision(300);
  for(const testing::Soup& soup : { testing::hill(20, .7), testing::random_height_field(15, .5, 3) })
  {
    const auto t = testing::triangulation(soup);
    const CE::Conformal_conditions<double> conditions(t);
    const auto metric = solve(t, 1e-30);
    BOOST_TEST((metric.status == CE::Status::OK));
    BOOST_TEST(metric.statistics.residual <= 1e-30); // as asked for
    // the residual itself is computed with errors of some 1e-31
    BOOST_TEST(static_cast<double>(measured_residual(metric, conditions)) <= 2e-30);

    const auto coarse = solve(t, 1e-12);
    BOOST_TEST(static_cast<double>(measured_residual(coarse, conditions)) <= 1e-12);
    BOOST_TEST(metric.statistics.number_of_iterations <= coarse.statistics.number_of_iterations + 1);

    auto spoiled = metric;
    spoiled.scale_factors[t.number_of_vertices() / 2 + 7] += CEi::Double_double(1e-28);
    BOOST_TEST(static_cast<double>(measured_residual(spoiled, conditions)) > 2e-30);

    // what pairs cannot do is said, with what they can
    const auto best = solve(t, 1e-40);
    BOOST_TEST((best.status == CE::Status::CONVERGED_TO_ROUNDING));
    BOOST_TEST(best.statistics.residual <= best.statistics.residual_floor);
    BOOST_TEST(best.statistics.residual_floor < 1e-28);
    BOOST_TEST(best.amount == best.statistics.residual);
  }
}

BOOST_AUTO_TEST_CASE(as_many_digits_as_there_are)
{
  for(const unsigned int bits : { 64u, 200u, 1500u })
  {
    const auto t = testing::triangulation(testing::hill(6, .7));
    CE::Conformal_metric<Number> metric;
    {
      const CE::Working_precision precision(bits);
      metric = solve(testing::widened<Number>(t), 0);
    }
    BOOST_TEST((metric.status == CE::Status::CONVERGED_TO_ROUNDING));
    BOOST_TEST(metric.statistics.residual > 0); // also where it is below the range of double
    const CE::Working_precision precision(2 * bits);
    const CE::Conformal_conditions<Number> conditions(metric.triangulation);
    const Number measured = measured_residual(metric, conditions), unit = ldexp(Number(1), -int(bits));
    BOOST_TEST((measured < 256 * unit)); // 8 epsilon times the sum of 1 + cot + cot around a vertex
  }
}

BOOST_AUTO_TEST_CASE(targets_that_were_rounded)
{
  // rounded targets meet the Gauss-Bonnet formula only after their defect was spread, with all digits
  const CE::Working_precision precision(200);
  const auto t = testing::widened<Number>(testing::triangulation(testing::hill(4, .5)));
  CE::Conformal_conditions<Number> conditions(t);
  std::vector<std::uint32_t> border;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(t.is_border_vertex(v))
      border.push_back(v);
  const Number pi = CEi::Number_constants<Number>::pi();
  for(std::size_t i = 0; i < border.size(); ++i)
    conditions.prescribe_angle_sum(border[i], Number(static_cast<double>(pi - 2 * pi / int(border.size()) + (i % 2 == 0 ? .01 : -.01))));
  const auto metric = CE::compute_conformal_metric(t, conditions, CGAL::parameters::gradient_tolerance(0.));
  BOOST_TEST((metric.status == CE::Status::CONVERGED_TO_ROUNDING));
  BOOST_TEST(metric.statistics.residual <= rounded_to_200_bits);
}

// The argument of a product tells an angle up to 4 pi only; the turns are counted.
BOOST_AUTO_TEST_CASE(turns_are_counted)
{
  const CE::Working_precision precision(200);
  for(const int n : { 6, 12, 18, 24, 30 }) // equilateral triangles around the vertex 0
  {
    auto t = testing::triangulation(testing::cone(testing::Index(n), 1));
    for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
      t.set_length(e, 1);
    const CE::Conformal_conditions<double> conditions(t);
    const double expected = testing::pi * (n / 3 - 2);
    const std::vector<CEi::Double_double> s(t.number_of_vertices(), CEi::Double_double(1));
    BOOST_TEST(std::abs(CEi::wide_residual(t, s, conditions)[0] - expected) <= 2 * testing::pi * testing::few_roundings);

    const auto wide = testing::widened<Number>(t);
    const CE::Conformal_conditions<Number> wide_conditions(wide);
    const std::vector<Number> wide_s(t.number_of_vertices(), Number(1));
    const CEi::Scaled_vector residual = CEi::scaled_wide_residual(wide, wide_s, wide_conditions);
    BOOST_TEST(std::abs(std::ldexp(residual.entries[0], residual.exponent) - expected) <= 2 * testing::pi * testing::few_roundings);
  }
}

BOOST_AUTO_TEST_CASE(residuals_below_the_range_of_double)
{
  const CE::Working_precision precision(2000);
  const auto t = testing::widened<Number>(testing::triangulation(testing::cone(6, 0))); // flat, up to the rounding of the points
  auto metric = solve(t, 0);
  const CE::Conformal_conditions<Number> conditions(t);
  const Number epsilon = ldexp(Number(1), -1500);
  metric.scale_factors[0] *= 1 + epsilon;
  const CEi::Scaled_vector residual = CEi::scaled_wide_residual(t, metric.scale_factors, conditions);
  BOOST_TEST(residual.exponent < -1400);
  const Number measured = measured_residual(metric, conditions), size = residual.largest<Number>();
  BOOST_TEST((abs(Number(size - measured)) <= measured * 10 * testing::few_roundings)); // its digits are those of double
}

// A strip of squares, two abreast, straightened along both of its sides and open at its end, is a fan whose scale shrinks by
// 2 + sqrt(3) = e^{acosh 2} from each pair to the next.
template <typename NT>
CE::Conformal_metric<NT> opened_strip(std::uint32_t n, CE::Intrinsic_triangulation<NT> t, double tolerance)
{
  CE::Conformal_conditions<NT> conditions(t);
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(t.is_border_vertex(v) && v / 3 != 0)
      conditions.prescribe_angle_sum(v, CE::Exact_angle<NT>::pi_times(1));
  CGAL_precondition(t.number_of_vertices() == 3 * (n + 1));
  return CE::compute_conformal_metric(t, conditions, CGAL::parameters::gradient_tolerance(tolerance));
}

const double close_in_double = 1e-6; // radians: what `SCALE_OUT_OF_RANGE` promises of u

// Where e^{u/2} is in the range of `double`, and far beyond it. There `double` says so, and tells u; more digits, and exponents, find the whole
// metric.
BOOST_AUTO_TEST_CASE(u_beyond_the_range_of_double)
{
  const CE::Working_precision precision(200);
  for(const std::uint32_t n : { 100u, 1200u })
  {
    const auto t = testing::triangulation(testing::strip(n, 2));
    const auto metric = opened_strip(n, t, 1e-12);
    BOOST_CHECK(metric.status == (n == 100 ? CE::Status::OK : CE::Status::SCALE_OUT_OF_RANGE));
    BOOST_REQUIRE_EQUAL(metric.log_scale_factors.size(), t.number_of_vertices());
    BOOST_TEST(metric.statistics.residual <= close_in_double);
    const auto wide = opened_strip(n, testing::widened<Number>(t), 1e-40);
    BOOST_REQUIRE(wide.status == CE::Status::OK);
    CE::Conformal_conditions<Number> conditions(wide.triangulation);
    for(std::uint32_t v = 3; v < t.number_of_vertices(); ++v)
      if(t.is_border_vertex(v))
        conditions.prescribe_angle_sum(v, CE::Exact_angle<Number>::pi_times(1));
    BOOST_TEST(measured_residual(wide, conditions) <= Number(1e-40));
    const double range = wide.statistics.largest_u - wide.statistics.least_u;
    BOOST_TEST(std::abs(range - n * std::acosh(2.)) <= 5);
    if(n == 1200)
    {
      BOOST_TEST(metric.scale_factors.empty());
      BOOST_TEST(std::abs(metric.amount - range) <= 1e-9 * range);
    }
    // At angle sums that are right to 1e-12, the squares, one after the other, are right to 1e-11 each: their errors add up.
    for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
      BOOST_TEST(std::abs(static_cast<double>(Number(wide.log_scale_factors[v] - metric.log_scale_factors[v]))) <= 1e-11 * n);
  }
}

// Is d inside of the circle through a, b and c, which are counterclockwise, seen from above?
bool is_in_circle(const testing::Point& a, const testing::Point& b, const testing::Point& c, const testing::Point& d)
{
  typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_2 From_above;
  return CGAL::side_of_oriented_circle(From_above(a[0], a[1]), From_above(b[0], b[1]), From_above(c[0], c[1]), From_above(d[0], d[1]))
      == CGAL::ON_POSITIVE_SIDE;
}

// Hills over n x n vertices that are not quite on a grid.
testing::Soup terrain(std::uint32_t n, double height)
{
  testing::Random random(1);
  const double step = 1. / (n - 1);
  testing::Soup soup;
  for(std::uint32_t j = 0; j < n; ++j)
    for(std::uint32_t i = 0; i < n; ++i)
    {
      const double dx = random(-0.3, 0.3), dy = random(-0.3, 0.3), x = step * (i + (i == 0 || i + 1 == n ? 0 : dx)),
                   y = step * (j + (j == 0 || j + 1 == n ? 0 : dy));
      double z = 0;
      for(int octave = 0; octave < 5; ++octave)
        z += 0.12 * std::ldexp(std::sin(std::ldexp(7., octave) * x + 1.3 * octave) * std::cos(std::ldexp(6.3, octave) * y - 0.7 * octave), -octave);
      soup.points.push_back({{ x, y, height * z }});
    }
  for(std::uint32_t j = 0; j + 1 < n; ++j)
    for(std::uint32_t i = 0; i + 1 < n; ++i)
    {
      const std::uint32_t a = j * n + i, b = a + 1, c = b + n, d = a + n;
      const bool bd = is_in_circle(soup.points[a], soup.points[b], soup.points[c], soup.points[d]);
      soup.triangles.push_back(bd ? std::array<std::uint32_t, 3>{{ a, b, d }} : std::array<std::uint32_t, 3>{{ a, b, c }});
      soup.triangles.push_back(bd ? std::array<std::uint32_t, 3>{{ b, c, d }} : std::array<std::uint32_t, 3>{{ a, c, d }});
    }
  return soup;
}

// On its intrinsic Delaunay triangulation, a terrain a thousand times steeper consists of needles of which the angles are not to be told in
// `double`, with u on the way or with the lengths after flips.
BOOST_AUTO_TEST_CASE(needles_of_a_steep_terrain)
{
  const CE::Working_precision precision(200);
  const auto t = testing::widened<Number>(testing::triangulation(terrain(10, 1e3)));
  const CE::Conformal_conditions<Number> conditions(t);
  const auto metric = CE::compute_conformal_metric(t, conditions, CGAL::parameters::retriangulation(Retriangulation::ALWAYS));
  BOOST_REQUIRE(metric.status == CE::Status::OK);
  BOOST_TEST(metric.amount == 0);
  BOOST_TEST(metric.faces.empty());
  BOOST_CHECK(metric.statistics.delaunay == CE::Delaunay_property::EXACT || metric.statistics.delaunay == CE::Delaunay_property::WITHIN_ROUNDING);
  CE::Conformal_conditions<Number> on_double(metric.triangulation);
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(t.is_border_vertex(v))
      on_double.fix_log_scale_factor(v, Number(0));
  BOOST_TEST(measured_residual(metric, on_double) <= Number(1e-12));
  BOOST_TEST(metric.statistics.largest_u - metric.statistics.least_u > 50); // e^50 between the lengths of neighbors and the farthest
}

// Much steeper ones have needles that leave `double` no metric at all, which is not the same as one that is out of its range: there is no u, and the
// status says so, with what is left to do, and how far u has come to range. On the triangles given there is a metric.
BOOST_AUTO_TEST_CASE(no_metric_is_not_one_out_of_range)
{
  const auto t = testing::triangulation(terrain(14, 1e5));
  const CE::Conformal_conditions<double> conditions(t);
  const auto none = CE::compute_conformal_metric(t, conditions, CGAL::parameters::retriangulation(Retriangulation::ALWAYS));
  BOOST_CHECK(none.status == CE::Status::ITERATIONS_EXHAUSTED);
  BOOST_TEST(none.log_scale_factors.empty());
  BOOST_TEST(none.scale_factors.empty());
  BOOST_TEST(none.amount > close_in_double);
  BOOST_TEST(none.statistics.largest_u - none.statistics.least_u > 100); // what the message of the program takes for far
  const auto metric = CE::compute_conformal_metric(t, conditions, CGAL::parameters::retriangulation(Retriangulation::WHEN_NEEDED));
  BOOST_CHECK(CE::is_success(metric.status));
}

// Newton's method with all of its linear algebra in the wide type.
template <typename Wide, typename NT>
void check_wide_steps(const CE::Intrinsic_triangulation<NT>& t, double limit, int steps)
{
  const CE::Conformal_conditions<NT> conditions(t);
  const auto metric = solve(t, 1e-12);
  CEi::Edge_graph graph;
  graph.set_edges(t);
  std::vector<char> free;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    free.push_back(conditions.is_fixed(v) ? 0 : 1);
  graph.set_free(free);
  std::vector<Wide> s = metric.scale_factors;
  for(std::size_t v = 0; v < s.size(); ++v)
    if(free[v])
      s[v] = s[v] * Wide(1 + 1e-3 * std::sin(double(v)));
  double size = CEi::scaled_wide_residual(t, s, conditions).largest_entry();
  for(int step = 0; step < steps; ++step)
  {
    BOOST_REQUIRE(CEi::add_wide_newton_step(t, graph, CEi::scaled_wide_residual(t, s, conditions), s));
    CEi::Scaled_vector residual = CEi::scaled_wide_residual(t, s, conditions);
    residual.scale_to_one();
    BOOST_TEST(residual.largest_entry() <= (std::max)({limit, 100 * size * size, 1e-13 * size})); // (residuals have the digits of double)
    size = residual.largest_entry();
  }
  BOOST_TEST(size <= limit);
}

BOOST_AUTO_TEST_CASE(wide_linear_algebra)
{
  const auto t = testing::triangulation(testing::hill(6, .7));
  check_wide_steps<CEi::Double_double>(t, 1e-30, 5);
  const CE::Working_precision precision(500);
  check_wide_steps<Number>(testing::widened<Number>(t), 1e-145, 12);
}

// ---------------------------------------------------------------------------
// The door
// ---------------------------------------------------------------------------

namespace {

typedef CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3> Mesh;

struct Wide_point
{
  Number x_, y_;
  Wide_point() = default;
  Wide_point(const Number& x, const Number& y) : x_(x), y_(y) {}
  const Number& x() const { return x_; }
  const Number& y() const { return y_; }
};

} // namespace

BOOST_AUTO_TEST_CASE(flatten_with_many_digits)
{
  const CE::Working_precision precision(200);
  Mesh mesh = testing::surface_mesh<Mesh>(testing::hill(6, .7));
  const auto uv = mesh.add_property_map<Mesh::Halfedge_index, Wide_point>("uv").first;
  const auto rounded_uv = mesh.add_property_map<Mesh::Halfedge_index, CGAL::Simple_cartesian<double>::Point_2>("r").first;
  const auto u = mesh.add_property_map<Mesh::Vertex_index, Number>("u").first;
  const auto report = CE::flatten<Number>(mesh, uv, CGAL::parameters::gradient_tolerance(0.).log_scale_factor_map(u));
  BOOST_REQUIRE(bool(report));
  BOOST_TEST(report.statistics.residual <= rounded_to_200_bits);
  BOOST_TEST(report.layout_length_error <= 10 * rounded_to_200_bits);
  BOOST_REQUIRE(bool(CE::flatten(mesh, rounded_uv, CGAL::parameters::gradient_tolerance(1e-12))));
  for(const Mesh::Halfedge_index h : mesh.halfedges())
    BOOST_TEST(std::hypot(static_cast<double>(uv[h].x()) - rounded_uv[h].x(), static_cast<double>(uv[h].y()) - rounded_uv[h].y())
               <= testing::rounded_layout);

  // equation (2), for the lengths of the points themselves
  for(const Mesh::Edge_index e : mesh.edges())
  {
    const Mesh::Halfedge_index first = mesh.halfedge(e);
    const Mesh::Halfedge_index h = first.idx() % 2 == 0 && !mesh.is_border(first) ? first : mesh.opposite(first);
    if(mesh.is_border(h))
      continue;
    const auto &p = mesh.point(mesh.source(h)), &q = mesh.point(mesh.target(h));
    const Number dx = Number(p.x()) - Number(q.x()), dy = Number(p.y()) - Number(q.y()), dz = Number(p.z()) - Number(q.z());
    const Wide_point &a = uv[mesh.prev(h)], &b = uv[h];
    const Number x = a.x() - b.x(), y = a.y() - b.y();
    const Number scale = exp(Number(u[mesh.source(h)] + u[mesh.target(h)]));
    BOOST_TEST((abs(Number((x * x + y * y) / (scale * (dx * dx + dy * dy + dz * dz)) - 1)) <= 10 * rounded_to_200_bits));
  }

  // written with all of their digits
  std::ostringstream out, rounded_out;
  BOOST_REQUIRE(CE::IO::write_OBJ(out, mesh, uv) && CE::IO::write_OBJ(rounded_out, mesh, rounded_uv));
  std::istringstream in(out.str());
  std::size_t found = 0;
  for(std::string line; std::getline(in, line); )
  {
    if(line.compare(0, 3, "vt ") != 0)
      continue;
    const std::size_t space = line.find(' ', 3);
    const Number x(line.substr(3, space - 3)), y(line.substr(space + 1));
    bool is_there = false;
    for(const Mesh::Halfedge_index h : mesh.halfedges())
      is_there = is_there || (uv[h].x() == x && uv[h].y() == y);
    BOOST_TEST(is_there);
    ++found;
  }
  BOOST_TEST(found == mesh.number_of_vertices());
  std::istringstream rounded_in(rounded_out.str());
  for(std::string line; std::getline(rounded_in, line); )
    BOOST_TEST(line.size() <= 3 + 2 * 24 + 26u);
}

namespace {

struct Wide_point_3
{
  std::array<Number, 3> coordinate;
  Wide_point_3() = default;
  Wide_point_3(const Number& x, const Number& y, const Number& z) : coordinate{{x, y, z}} {}
};

Number squared_distance(const Wide_point_3& p, const Wide_point_3& q)
{
  Number result(0);
  for(std::size_t i = 0; i < 3; ++i)
    result += (p.coordinate[i] - q.coordinate[i]) * (p.coordinate[i] - q.coordinate[i]);
  return result;
}

} // namespace

BOOST_AUTO_TEST_CASE(a_sphere_with_many_digits)
{
  const CE::Working_precision precision(200);
  testing::Soup soup = testing::icosphere(1);
  testing::add_noise(soup, .05, 1);
  Mesh mesh = testing::surface_mesh<Mesh>(soup);
  const auto on_sphere = mesh.add_property_map<Mesh::Vertex_index, Wide_point_3>("sphere").first;
  const auto rounded = mesh.add_property_map<Mesh::Vertex_index, Mesh::Point>("rounded").first;
  const auto report = CE::map_to_sphere<Number>(mesh, on_sphere, CGAL::parameters::gradient_tolerance(0.));
  BOOST_REQUIRE(bool(report));
  BOOST_TEST(report.rounded_faces.empty());
  BOOST_REQUIRE(bool(CE::map_to_sphere(mesh, rounded)));
  for(const Mesh::Vertex_index v : mesh.vertices())
  {
    const auto& p = on_sphere[v].coordinate;
    BOOST_TEST((abs(Number(squared_distance(on_sphere[v], Wide_point_3(0, 0, 0)) - 1)) <= rounded_to_200_bits));
    BOOST_TEST(std::hypot(static_cast<double>(p[0]) - rounded[v].x(), static_cast<double>(p[1]) - rounded[v].y(),
                          static_cast<double>(p[2]) - rounded[v].z()) <= testing::rounded_u);
  }

  // at every edge, for the lengths of the points themselves: squares of length cross ratios
  const auto point = [&](Mesh::Vertex_index v)
  {
    const auto& p = mesh.point(v);
    return Wide_point_3(Number(p.x()), Number(p.y()), Number(p.z()));
  };
  for(const Mesh::Edge_index e : mesh.edges())
  {
    const Mesh::Halfedge_index h = mesh.halfedge(e), g = mesh.opposite(h);
    const Mesh::Vertex_index i = mesh.source(h), j = mesh.target(h), k = mesh.target(mesh.next(h)), l = mesh.target(mesh.next(g));
    const auto cross_ratio = [&](const auto& place)
    {
      return Number(squared_distance(place(i), place(l)) * squared_distance(place(j), place(k))
                  / (squared_distance(place(l), place(j)) * squared_distance(place(k), place(i))));
    };
    const Number surface = cross_ratio(point), sphere = cross_ratio([&](Mesh::Vertex_index v) { return on_sphere[v]; });
    BOOST_TEST((abs(Number(sphere / surface - 1)) <= 1e-40)); // far more digits than those of double-double, in which parts are computed
  }
}
