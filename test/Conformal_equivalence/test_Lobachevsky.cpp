// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Milnor's Lobachevsky function against the numerical integral of its definition, its
// identities and its known values (Milnor, "Hyperbolic geometry: the first 150 years", 1982).

#define BOOST_TEST_MODULE test_Lobachevsky
#include "include/boost_test.h"

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/Lobachevsky.h>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CEi = CGAL::Conformal_equivalence::internal;
using CEi::Double_double;
using CEi::Lobachevsky;

typedef boost::multiprecision::cpp_bin_float_100 Wide;

namespace {

const Wide wide_pi = boost::math::constants::pi<Wide>();

Wide wide(double x) { return Wide(x); }
Wide wide(long double x) { return Wide(x); }
Wide wide(const Double_double& x) { return Wide(x.hi) + Wide(x.lo); }

template <typename NT>
NT narrow(const Wide& x) { return static_cast<NT>(x); }

template <>
Double_double narrow<Double_double>(const Wide& x)
{
  const double hi = static_cast<double>(x);
  return CEi::quick_two_sum(hi, static_cast<double>(Wide(x - hi)));
}

// Tanh-sinh quadrature on [0, 1] of step 1/32: nodes q / (1 + q), q = exp(pi sinh s), and weights.
struct Quadrature
{
  std::vector<Wide> nodes, weights;

  Quadrature()
  {
    const Wide h = Wide(1) / 32;
    for(int i = -32 * 5; i <= 32 * 5; ++i) // exp(-pi sinh 5) is 1e-101
    {
      const Wide s = i * h, q = exp(Wide(wide_pi * sinh(s))), q_1 = 1 + q;
      nodes.push_back(q / q_1);
      weights.push_back(h * wide_pi * cosh(s) * q / (q_1 * q_1));
    }
  }
};

// -int_0^x log(2 sin t) dt for 0 < x <= pi/2
Wide integral(const Wide& x)
{
  static const Quadrature quadrature;
  Wide sum(0);
  for(std::size_t i = 0; i < quadrature.nodes.size(); ++i)
    sum -= quadrature.weights[i] * log(Wide(2 * sin(Wide(x * quadrature.nodes[i]))));
  return x * sum;
}

// by symmetry about pi/2, for 0 <= x <= pi and a little more
Wide reference(const Wide& x)
{
  if(x == 0)
    return x;
  if(x < 0)
    return -reference(-x);
  if(x > wide_pi / 2)
    return -reference(wide_pi - x);
  return integral(x);
}

// all of [0, pi], dense near the zeros 0, pi/2 and pi, and at the places where the series change
std::vector<double> arguments()
{
  std::vector<double> result;
  for(int i = 1; i < 32; ++i)
    result.push_back(i * .0981);
  for(const double d : { 1e-300, 1e-100, 1e-20, 1e-10, 1e-5, 1e-3 })
    result.push_back(d);
  for(const double d : { 1e-15, 1e-10, 1e-5, 1e-3, .523, .524 })
  {
    result.push_back(1.5707963267948966 - d);
    result.push_back(1.5707963267948966 + d);
  }
  for(const double d : { 0., 4.4e-16, 1e-10, 1e-3 })
    result.push_back(3.1415926535897931 - d);
  result.push_back(3.1415926535897936); // just above pi
  result.push_back(1.5707963267948966);
  for(const double d : { .78, .7801, .785398163, .78540 })
    result.push_back(d);
  return result;
}

struct Errors
{
  double absolute = 0, relative = 0;
};

template <typename NT>
Errors errors_at(const std::vector<double>& xs)
{
  Errors result;
  for(const double d : xs)
  {
    const NT x = NT(d) * (1 + std::numeric_limits<NT>::epsilon()); // uses the last bits of NT
    const Wide exact = reference(wide(x));
    const double error = static_cast<double>(Wide(abs(wide(Lobachevsky(x)) - exact)));
    result.absolute = (std::max)(result.absolute, error);
    result.relative = (std::max)(result.relative, static_cast<double>(Wide(error / abs(exact))));
    BOOST_REQUIRE(error <= 1e-14); // a NaN is caught here
  }
  return result;
}

template <typename NT>
NT pi_of() { return narrow<NT>(wide_pi); }

// Lobachevsky(n x) = n sum_k Lobachevsky(x + k pi / n): Milnor 1982, Lemma 3.
// The arguments are rounded; the slope is -log |2 sin x|.
template <typename NT>
double defect_of_multiplication_formula(int n, const NT& x)
{
  NT sum(0);
  for(int k = 0; k < n; ++k)
    sum += Lobachevsky(NT(x + pi_of<NT>() * k / n));
  return std::fabs(static_cast<double>(NT(Lobachevsky(NT(x * n)) - sum * n)));
}

} // namespace

BOOST_AUTO_TEST_CASE(the_reference_is_right)
{
  // Catalan's constant / 2 and a third of Gieseking's constant
  const Wide catalan("0.915965594177219015054603514932384110774149374281672134266498119621763019776254769");
  const Wide gieseking("1.01494160640965362502120255427452028594168930753029979");
  BOOST_CHECK_SMALL(static_cast<double>(Wide(reference(wide_pi / 4) - catalan / 2)), 1e-60);
  BOOST_CHECK_SMALL(static_cast<double>(Wide(reference(wide_pi / 3) - gieseking / 3)), 1e-50);
  BOOST_CHECK_SMALL(static_cast<double>(reference(wide_pi / 2)), 1e-60);
}

BOOST_AUTO_TEST_CASE(double_precision)
{
  const Errors e = errors_at<double>(arguments());
  BOOST_CHECK_LE(e.absolute, 4 * 0x1p-53);
  BOOST_CHECK_LE(e.relative, 16 * 0x1p-53);
}

BOOST_AUTO_TEST_CASE(long_double_precision)
{
  const double u = static_cast<double>(std::numeric_limits<long double>::epsilon()) / 2;
  const Errors e = errors_at<long double>(arguments());
  BOOST_CHECK_LE(e.absolute, 4 * u);
  BOOST_CHECK_LE(e.relative, 16 * u);
}

BOOST_AUTO_TEST_CASE(double_double_precision)
{
  std::vector<double> xs;
  for(const double x : arguments())
    if(x > 1e-250)
      xs.push_back(x);
  const Errors e = errors_at<Double_double>(xs);
  BOOST_CHECK_LE(e.absolute, 16 * 0x1p-106);
  BOOST_CHECK_LE(e.relative, 64 * 0x1p-106);
}

BOOST_AUTO_TEST_CASE(fixed_multiprecision)
{
  typedef boost::multiprecision::number<boost::multiprecision::cpp_bin_float<200, boost::multiprecision::digit_base_2> > NT;
  for(const double x : { 1e-30, .3, 1., 1.2, 1.5707963267948966, 2.5, 3.14159 })
  {
    const Wide exact = reference(Wide(x));
    const Wide error = abs(Wide(Lobachevsky(NT(x))) - exact);
    BOOST_CHECK(error <= ldexp(Wide(1), -198));
    BOOST_CHECK(error <= ldexp(Wide(abs(exact)), -196));
  }
  BOOST_CHECK_EQUAL(Lobachevsky(1.f), static_cast<float>(Lobachevsky(1.)));
}

BOOST_AUTO_TEST_CASE(odd_and_periodic)
{
  for(const double x : arguments())
  {
    BOOST_CHECK_EQUAL(Lobachevsky(-x), -Lobachevsky(x));
    BOOST_CHECK_EQUAL(Lobachevsky(-static_cast<long double>(x)), -Lobachevsky(static_cast<long double>(x)));
  }
  BOOST_CHECK_EQUAL(Lobachevsky(0.), 0.);
  BOOST_CHECK(std::isnan(Lobachevsky(std::numeric_limits<double>::infinity())));
  BOOST_CHECK(std::isnan(Lobachevsky(std::numeric_limits<double>::quiet_NaN())));
  // any double is folded with pi to 120 bits, close to multiples of pi/2 too
  for(const double x : { 3.5, 5., 6.283185307179586, 7.8539816339744828, 22., 355., 1e4, 104348., 9e5, 5e5 * 3.1415926535897931 })
  {
    const Wide periods = floor(Wide(x) / wide_pi);
    const Wide exact = reference(Wide(x) - periods * wide_pi);
    BOOST_CHECK_LE(static_cast<double>(Wide(abs(Lobachevsky(x) - exact))), 4 * 0x1p-53);
    BOOST_CHECK_LE(static_cast<double>(Wide(abs((Lobachevsky(x) - exact) / exact))), 16 * 0x1p-53);
    BOOST_CHECK_EQUAL(Lobachevsky(-x), -Lobachevsky(x));
  }
}

BOOST_AUTO_TEST_CASE(multiplication_formulas)
{
  for(int i = 1; i < 300; ++i)
  {
    // n values of error 4u and an argument error of n ulp(pi) times the slope, below 8 on these x
    const double x = i * .01037;
    for(const int n : { 2, 3, 5 })
    {
      const double units = n * n * 4 + n * n * 8 * 8;
      BOOST_CHECK_LE(defect_of_multiplication_formula(n, x), units * 0x1p-53);
      BOOST_CHECK_LE(defect_of_multiplication_formula(n, static_cast<long double>(x)),
                     units / 2 * static_cast<double>(std::numeric_limits<long double>::epsilon()));
      if(i % 10 == 0)
        BOOST_CHECK_LE(defect_of_multiplication_formula(n, Double_double(x)), 4 * units * 0x1p-106);
    }
  }
}

BOOST_AUTO_TEST_CASE(known_values_and_slope)
{
  const double pi = 3.1415926535897931;
  BOOST_CHECK_SMALL(Lobachevsky(pi / 3) - 1.0149416064096536 / 3, 1e-15);
  BOOST_CHECK_SMALL(Lobachevsky(pi / 6) - 1.0149416064096536 / 2, 1e-15); // the maximum
  BOOST_CHECK_SMALL(Lobachevsky(pi / 4) - .91596559417721902 / 2, 1e-15);
  BOOST_CHECK_GT(Lobachevsky(pi / 6), Lobachevsky(pi / 6 + 1e-5));
  BOOST_CHECK_GT(Lobachevsky(pi / 6), Lobachevsky(pi / 6 - 1e-5));
  // the value at the double below pi: with pi - x = d, -d (1 - log(2d))
  const double d = 1.2246467991473532e-16;
  BOOST_CHECK_CLOSE_FRACTION(Lobachevsky(pi), -d * (1 - std::log(2 * d)), 1e-14);
  for(double x = .05; x < 3.1; x += .05)
  {
    const double h = 1e-5, slope = (Lobachevsky(x + h) - Lobachevsky(x - h)) / (2 * h);
    // h^2/6 sup 1/sin^2 and rounding 2^-52 / h
    BOOST_CHECK_SMALL(slope + std::log(2 * std::sin(x)), 1e-10 / 6 / (std::sin(x - h) * std::sin(x - h)) * 4 + 1e-10);
  }
}
