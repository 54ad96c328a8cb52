// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The number type of MPFR, precision chosen at run time: everything that takes any number
// type, against computations by other means at higher precision. (The only test that needs MPFR.)

#define BOOST_TEST_MODULE test_multiprecision
#include "include/boost_test.h"
#include "include/test_meshes.h"

#include <CGAL/Conformal_equivalence/internal/Lobachevsky.h>
#include <CGAL/Conformal_equivalence/internal/energy.h>
#include <CGAL/Conformal_equivalence/internal/length_predicates.h>

#include <boost/multiprecision/mpfr.hpp>

#include <cmath>
#include <vector>

namespace CEi = CGAL::Conformal_equivalence::internal;

typedef boost::multiprecision::mpfr_float Real;

namespace {

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
  const Real rise = energy.value(above, target) - energy.value(below, target);
  BOOST_CHECK_LE(abs(Real(rise / (2 * h) - slope)), limit);

  // the same value as at twice the precision, to the last bits
  const Real value = energy.value(u, target);
  Working_precision wider(2 * bits);
  std::vector<Real> wide_u;
  for(const Real& x : u)
    wide_u.push_back(widened(x));
  const Real exact = CEi::Conformal_energy<Real, double>(t).value(wide_u, std::vector<Real>(d.size(), Real(2)));
  BOOST_CHECK_LE(abs(Real(widened(value) - exact)), ldexp(Real(1000), -bits));
}

BOOST_AUTO_TEST_CASE(energy_gradient_and_hessian)
{
  for(const int bits : { 200, 1000 })
    for(const double bound : { .2, 4. })
      check_energy_at(bits, bound);
}
