// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Double_double against 400 bits with the bounds of its header, and the predicates on
// lengths and on points of the plane against rationals of another library.

#define BOOST_TEST_MODULE test_length_predicates
#include "include/boost_test.h"

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Exact_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Precise_number.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/length_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>

#include <array>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace mp = boost::multiprecision;
namespace CEi = CGAL::Conformal_equivalence::internal;

typedef mp::number<mp::cpp_bin_float<400, mp::digit_base_2> > Wide;
typedef mp::cpp_rational Rational;
using CEi::Double_double;

namespace {

std::mt19937_64 generator(2008);

double random_double(double a, double b)
{
  return std::uniform_real_distribution<double>(a, b)(generator);
}

// a significand of 53 random bits, a sign, and an exponent in [-range, range]
double random_with_exponent(int range)
{
  const double x = std::ldexp(random_double(.5, 1), std::uniform_int_distribution<int>(-range, range)(generator));
  return generator() % 2 ? x : -x;
}

Double_double random_double_double(int range)
{
  const double hi = random_with_exponent(range);
  const int gap = generator() % 4 == 0 ? 60 : 0;
  return CEi::two_sum(hi, std::ldexp(hi * random_double(-.5, .5), -53 - gap));
}

Wide wide(const Double_double& x)
{
  return Wide(x.hi) + Wide(x.lo);
}

bool is_normalized(const Double_double& x)
{
  const double hi = CEi::double_double::opaque(x.hi), lo = CEi::double_double::opaque(x.lo);
  return hi + lo == hi;
}

// |got - exact| / |exact|, in units of u^2 = 2^-106
double error_in_u2(const Double_double& got, const Wide& exact)
{
  if(exact == 0)
    return wide(got) == 0 ? 0 : std::numeric_limits<double>::infinity();
  return std::ldexp(static_cast<double>(abs((wide(got) - exact) / exact)), 106);
}

struct Largest
{
  double value = 0;
  bool normalized = true;

  void add(const Double_double& got, const Wide& exact)
  {
    const double e = error_in_u2(got, exact);
    value = e <= value ? value : e; // keeps a NaN
    normalized = normalized && is_normalized(got);
  }
};

Rational rational(double x) { return Rational(x); }
Rational rational(long double x) { return Rational(x); }
Rational rational(const Double_double& x) { return Rational(x.hi) + Rational(x.lo); }

template <typename NT>
CGAL::Sign reference_sign(const NT& a, const NT& b, const NT& c)
{
  const Rational d = rational(a) + rational(b) - rational(c);
  return static_cast<CGAL::Sign>(d.sign());
}

template <typename NT>
CGAL::Sign reference_scaled_sign(const NT& s_i, const NT& s_j, const NT& s_k,
                                 const NT& l_ij, const NT& l_jk, const NT& l_ki)
{
  const Rational d = rational(s_i) * rational(s_j) * rational(l_ij) + rational(s_k) * rational(s_i) * rational(l_ki)
                   - rational(s_j) * rational(s_k) * rational(l_jk);
  return static_cast<CGAL::Sign>(d.sign());
}

double up(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }
double down(double x) { return std::nextafter(x, 0.); }

} // namespace

BOOST_AUTO_TEST_CASE(error_free_transformations)
{
  for(int i = 0; i < 20000; ++i)
  {
    const double a = random_with_exponent(400), b = i % 2 ? random_with_exponent(400) : -a * random_double(.4, 2.1);
    const Double_double s = CEi::two_sum(a, b);
    BOOST_REQUIRE_EQUAL(s.hi, a + b);
    BOOST_REQUIRE(wide(s) == Wide(a) + Wide(b) || std::fabs(a / b) > 1e50 || std::fabs(b / a) > 1e50);
    BOOST_REQUIRE(rational(s) == rational(a) + rational(b));

    const Double_double q = std::fabs(a) > std::fabs(b) ? CEi::quick_two_sum(a, b) : CEi::quick_two_sum(b, a);
    BOOST_REQUIRE(q == s);

    const Double_double p = CEi::two_prod(a, b);
    BOOST_REQUIRE_EQUAL(p.hi, CEi::double_double::opaque(a * b));
    BOOST_REQUIRE(wide(p) == Wide(a) * Wide(b));
  }
  // where Veltkamp's factor 2^27 + 1 would overflow
  for(int i = 0; i < 1000; ++i)
  {
    const double a = std::ldexp(random_double(.5, 1), 1023), b = random_double(.5, 1);
    BOOST_REQUIRE(wide(CEi::two_prod(a, b)) == Wide(a) * Wide(b));
    BOOST_REQUIRE(wide(CEi::two_prod(b, -a)) == -Wide(a) * Wide(b));
  }
}

// A product handed to an addition must not be contracted into a fused operation.
BOOST_AUTO_TEST_CASE(sum_of_a_product_is_the_sum_of_the_rounded_product)
{
  for(int i = 0; i < 20000; ++i)
  {
    const double a = random_double(.5, 1), b = random_double(.5, 1);
    volatile double same_a = a, rounded = same_a * b; // not the product below, for the compiler
    const double p = rounded, c = -p * (i % 2 ? random_double(.99, 1.01) : 1.);
    const Double_double s = CEi::two_sum(a * b, c);
    BOOST_REQUIRE(rational(s) == rational(p) + rational(c));
    BOOST_REQUIRE(i % 2 || s == 0);
  }
}

BOOST_AUTO_TEST_CASE(double_double_operations_keep_their_bounds)
{
  Largest add, add_double, multiply, multiply_double, divide, divide_double, root;
  for(int i = 0; i < 30000; ++i)
  {
    const int range = i % 3 == 0 ? 2 : 120;
    const Double_double x = random_double_double(range);
    Double_double y = random_double_double(range);
    if(i % 4 == 0) // cancellation
      y = -x * (1. + std::ldexp(random_double(-1, 1), -static_cast<int>(generator() % 100)));
    const double d = i % 4 == 1 ? -x.hi : y.hi;
    add.add(x + y, wide(x) + wide(y));
    add.add(x - y, wide(x) - wide(y));
    add_double.add(x + d, wide(x) + d);
    add_double.add(d - x, d - wide(x));
    multiply.add(x * y, wide(x) * wide(y));
    multiply_double.add(d * x, wide(x) * d);
    divide.add(x / y, wide(x) / wide(y));
    divide_double.add(x / d, wide(x) / d);
    root.add(sqrt(abs(x)), sqrt(abs(wide(x))));
    Double_double z(x);
    BOOST_REQUIRE((z += y) == x + y);
    BOOST_REQUIRE((z = x, z -= y) == x - y);
    BOOST_REQUIRE((z = x, z *= y) == x * y);
    BOOST_REQUIRE((z = x, z /= y) == x / y);
  }
  BOOST_CHECK_LE(add.value, 3 + 1e-12);
  BOOST_CHECK_LE(add_double.value, 2);
  BOOST_CHECK_LE(multiply.value, 7);
  BOOST_CHECK_LE(multiply_double.value, 2);
  BOOST_CHECK_LE(divide.value, 15 + 1e-12);
  BOOST_CHECK_LE(divide_double.value, 3);
  BOOST_CHECK_LE(root.value, 3.125);
  for(const Largest& l : { add, add_double, multiply, multiply_double, divide, divide_double, root })
  {
    BOOST_CHECK(l.normalized);
    BOOST_CHECK_GT(l.value, .5); // not exact by accident: these are random numbers
  }
}

BOOST_AUTO_TEST_CASE(double_double_exponential_and_logarithm)
{
  const double bound = 1e-30 * 0x1p106;
  Largest e, l;
  for(int i = 0; i < 3000; ++i)
  {
    const Double_double x = i % 2 ? Double_double(random_double(-660, 700)) / 3 : random_double_double(4);
    e.add(exp(x), exp(wide(x)));
    const Double_double y = i % 3 == 0 ? 1. + random_double_double(4) * 1e-3
                          : i % 3 == 1 ? Double_double(1, random_double(-1, 1) * 1e-17) : abs(random_double_double(900));
    l.add(log(y), log(wide(y)));
  }
  BOOST_CHECK_LE(e.value, bound);
  BOOST_CHECK_LE(l.value, bound);
  BOOST_CHECK(exp(Double_double(0)) == 1);
  BOOST_CHECK(log(Double_double(1)) == 0);
  BOOST_CHECK(exp(Double_double(-1e4)) == 0);
  BOOST_CHECK(!isfinite(exp(Double_double(710))));
  BOOST_CHECK(!isfinite(log(Double_double(0))));
  BOOST_CHECK(isnan(log(Double_double(-1))));
}

BOOST_AUTO_TEST_CASE(double_double_conversions_and_order)
{
  // integers
  for(const std::int64_t i : { INT64_MIN, INT64_MIN + 1, INT64_MAX, INT64_MAX - 1, std::int64_t(0), std::int64_t(-1),
                               (std::int64_t(1) << 53) + 1, -(std::int64_t(1) << 53) - 1 })
  {
    BOOST_CHECK(wide(Double_double(i)) == Wide(i));
    BOOST_CHECK(is_normalized(Double_double(i)));
  }
  BOOST_CHECK(wide(Double_double(UINT64_MAX)) == Wide(UINT64_MAX));
  BOOST_CHECK(Double_double(7) == 7.);
  BOOST_CHECK(Double_double(true) == 1);
  // to and from long double
  const long double third = 1.L / 3;
  BOOST_CHECK(static_cast<long double>(Double_double(third)) == third);
  BOOST_CHECK(Wide(third) == wide(Double_double(third)));
  BOOST_CHECK_EQUAL(static_cast<double>(Double_double(1, 1e-20)), 1.);
  BOOST_CHECK_EQUAL(to_double(Double_double(1, 1e-20)), 1.);
  // order: by lo if hi is equal
  const Double_double one(1), above(1, 1e-30), below(1, -1e-30);
  BOOST_CHECK(below < one && one < above && above > below && above >= one && one <= one && one != above);
  BOOST_CHECK(!(one < one) && !(above <= one) && !(below >= one) && below < 1. && 1 < above);
  BOOST_CHECK(abs(-above) == above && fabs(above) == above && -below > -1.);
  BOOST_CHECK(floor(Double_double(3, -1e-17)) == 2 && floor(Double_double(-2.5)) == -3 && floor(above) == 1);
  BOOST_CHECK(ldexp(above, 3) == 8. * above);
  const Double_double nan(std::numeric_limits<double>::quiet_NaN());
  BOOST_CHECK(!(nan < one) && !(nan > one) && !(nan == nan) && nan != nan && isnan(nan) && !isfinite(nan));
}

BOOST_AUTO_TEST_CASE(double_double_limits)
{
  typedef std::numeric_limits<Double_double> Limits;
  BOOST_CHECK(isfinite((Limits::max)()) && is_normalized((Limits::max)()));
  BOOST_CHECK(!isfinite((Limits::max)() * 2.));
  BOOST_CHECK(!isfinite(Double_double(1) / 0.) && !isfinite(Double_double(0) / 0.));
  BOOST_CHECK((Limits::lowest)() == -(Limits::max)());
  BOOST_CHECK(1. + Limits::epsilon() > 1.);
  BOOST_CHECK(!isfinite(Limits::infinity()) && isnan(Limits::quiet_NaN()));
  // at min() the bounds still hold
  const Double_double third = Double_double(1) / 3., small = (Limits::min)() * third * 3.;
  BOOST_CHECK_LE(error_in_u2(small, Wide((Limits::min)().hi)), 6);
  BOOST_CHECK(sqrt(Double_double(0)) == 0 && isnan(sqrt(Double_double(-1))));
  for(const double s : { 1e-280, 1e-150, 1e150, 1e300 })
  {
    const Double_double x = third * s;
    BOOST_CHECK_LE(error_in_u2(sqrt(x), sqrt(wide(x))), 3.125);
    BOOST_CHECK_LE(error_in_u2(x / 7., wide(x) / 7), 3);
  }
}

BOOST_AUTO_TEST_CASE(exact_number_is_exact)
{
  using CEi::Exact_number;
  using CEi::exact_number;
  const auto agrees = [](const Wide& x)
  {
    const Exact_number r = exact_number(x), q = exact_number(Wide(1 / x));
    // rounded as `double` both; the product of both is 1 up to their rounding
    return std::fabs(quotient(r, Exact_number(1)) - static_cast<double>(x)) <= 0x1p-52 * std::fabs(static_cast<double>(x))
           && (r * q).sign() == CGAL::POSITIVE;
  };
  BOOST_CHECK(agrees(Wide(1) / 3));
  const Wide third = Wide(1) / 3, ulp = ldexp(Wide(1), -401); // third has 400 bits and lies in [1/4, 1/2)
  Exact_number two_to_401(1);
  for(int i = 0; i < 401; ++i)
    two_to_401 *= 2;
  BOOST_CHECK(exact_number(ulp) * two_to_401 == Exact_number(1));
  BOOST_CHECK(exact_number(Wide(third + ulp)) == exact_number(third) + exact_number(ulp));
  BOOST_CHECK(exact_number(Wide(-third)) + exact_number(third) == Exact_number(0));
  BOOST_CHECK(exact_number(Wide(0)) == Exact_number(0));
  BOOST_CHECK(exact_number(Double_double(1, 0x1p-200)) - Exact_number(0x1p-200) == Exact_number(1));
  BOOST_CHECK(exact_number(0x1.8p-5f) == Exact_number(0x1.8p-5));
  // far outside the range of double, both ways
  const Exact_number huge = exact_number(Wide(ldexp(Wide(3), 5000))),
                     tiny = exact_number(Wide(ldexp(Wide(1), -5000)));
  BOOST_CHECK(huge * tiny == Exact_number(3));
  for(int i = 0; i < 200; ++i)
  {
    const long double x = static_cast<long double>(random_with_exponent(1000)) * (1 + 1e-17L);
    const Rational r(x);
    const Double_double d(x); // a long double of 64 bits is a Double_double
    BOOST_CHECK(rational(d) == r);
    BOOST_CHECK(exact_number(x) == exact_number(d));
  }
}

// Sums, differences, products, signs and quotients against rationals, zero and cancellation among them.
BOOST_AUTO_TEST_CASE(exact_numbers_against_rationals)
{
  using CEi::Exact_number;
  const auto same = [](const Exact_number& x, const Rational& r)
    { return quotient(x, Exact_number(1)) == 0 ? r == 0 : x.sign() == (r > 0 ? 1 : -1); };
  for(int i = 0; i < 2000; ++i)
  {
    const double a = i % 7 == 0 ? 0. : random_with_exponent(500) * (i % 2 == 0 ? 1 : -1), b = i % 11 == 0 ? 0. : random_with_exponent(500),
                 c = i % 3 == 0 ? a : random_with_exponent(500);
    const Exact_number x(a), y(b), z(c);
    const Rational p(a), q(b), r(c);
    BOOST_CHECK(same(x + y, p + q) && same(x - y, p - q) && same(x * y, p * q) && same(x * y - z, p * q - r));
    BOOST_CHECK(same((x + y) * z - x * z - y * z, Rational(0)));
    BOOST_CHECK((x < y) == (p < q) && (x == z) == (p == r) && (x >= z) == (p >= r));
    if(b > 0)
    {
      const Rational exact = p / q;
      const double rounded = quotient(x, y);
      BOOST_CHECK(abs(Rational(rounded) - exact) <= abs(exact) * Rational(0x1p-52));
    }
  }
}

// What 300 digits can hold is the same after a conversion there and back, and operations are rounded to 1024 bits.
BOOST_AUTO_TEST_CASE(precise_numbers)
{
  using CEi::Precise_number;
  const auto round_trip = [](const auto& x) { return CEi::From_precise<std::decay_t<decltype(x)> >()(CEi::To_precise()(x)); };
  for(int i = 0; i < 200; ++i)
  {
    const double x = std::fabs(random_with_exponent(500));
    BOOST_CHECK(round_trip(x) == x && round_trip(-x) == -x);
    const Double_double d = sqrt(Double_double(x));
    BOOST_CHECK(round_trip(d) == d);
    const Wide w = sqrt(Wide(x)), huge = ldexp(w, 100000);
    BOOST_CHECK(round_trip(w) == w && round_trip(huge) == huge);
    const Precise_number p = sqrt(Precise_number(x)), error = p * p / x - 1;
    BOOST_CHECK(error < 1e-307 && error > -1e-307);
  }
  BOOST_CHECK(round_trip(0.) == 0 && round_trip(Wide(0)) == 0);
}

BOOST_AUTO_TEST_CASE(triangle_inequality_of_doubles)
{
  for(int i = 0; i < 20000; ++i)
  {
    const int range = i % 3 == 0 ? 2 : (i % 3 == 1 ? 60 : 500);
    const double a = std::fabs(random_with_exponent(range)), b = std::fabs(random_with_exponent(range));
    const double c = CEi::double_double::opaque(a + b);
    for(const double d : { c, up(c), down(c), up(up(c)), random_double(0, 2) * c })
    {
      const CGAL::Sign expected = reference_sign(a, b, d);
      BOOST_REQUIRE_EQUAL(CEi::triangle_inequality_sign(a, b, d), expected);
      BOOST_REQUIRE_EQUAL(CEi::triangle_inequality_sign(b, a, d), expected);
    }
  }
}

BOOST_AUTO_TEST_CASE(triangle_inequality_in_every_rounding_mode)
{
  for(const int mode : { FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO, FE_TONEAREST })
    for(int i = 0; i < 5000; ++i)
    {
      const int range = i % 2 ? 2 : 40;
      const double a = std::fabs(random_with_exponent(range)), b = std::fabs(random_with_exponent(range));
      const double c = CEi::double_double::opaque(a + b), cs[3] = { c, up(c), down(c) };
      CGAL::Sign got[3];
      std::fesetround(mode);
      for(int k = 0; k < 3; ++k)
        got[k] = CEi::triangle_inequality_sign(a, b, cs[k]);
      std::fesetround(FE_TONEAREST);
      for(int k = 0; k < 3; ++k)
        BOOST_REQUIRE_EQUAL(got[k], reference_sign(a, b, cs[k]));
    }
}

BOOST_AUTO_TEST_CASE(triangles_at_the_ends_of_the_range)
{
  const double largest = (std::numeric_limits<double>::max)(), smallest = std::numeric_limits<double>::denorm_min();
  BOOST_CHECK_EQUAL(CEi::triangle_inequality_sign(largest, largest, largest), CGAL::POSITIVE); // the sum overflows
  BOOST_CHECK_EQUAL(CEi::triangle_inequality_sign(largest, smallest, largest), CGAL::POSITIVE);
  BOOST_CHECK_EQUAL(CEi::triangle_inequality_sign(smallest, smallest, 2 * smallest), CGAL::ZERO);
  BOOST_CHECK_EQUAL(CEi::triangle_inequality_sign(smallest, smallest, 3 * smallest), CGAL::NEGATIVE);
  for(const double s : { 1e-150, 1., 1e150 })
  {
    BOOST_CHECK(CEi::is_triangle(3 * s, 4 * s, 5 * s));
    BOOST_CHECK(!CEi::is_degenerate_triangle(3 * s, 4 * s, 5 * s));
    BOOST_CHECK(CEi::is_degenerate_triangle(s, s, 2 * s) && CEi::is_degenerate_triangle(2 * s, s, s) &&
                CEi::is_degenerate_triangle(s, 2 * s, s));
    BOOST_CHECK(!CEi::is_triangle(s, s, 2 * s) && CEi::is_triangle(s, s, down(2 * s)) && !CEi::is_triangle(s, s, up(2 * s)));
    BOOST_CHECK(!CEi::is_degenerate_triangle(s, s, down(2 * s)) && !CEi::is_degenerate_triangle(s, s, up(2 * s)));
  }
  BOOST_CHECK(CEi::is_triangle(1e-150, 1e150, 1e150)); // needle
  BOOST_CHECK(!CEi::is_triangle(1e-150, 1e150, up(1e150)));
  BOOST_CHECK(CEi::is_degenerate_triangle(0., 1., 1.) && CEi::is_degenerate_triangle(0., 0., 0.));
  BOOST_CHECK(!CEi::is_triangle(0., 1., 1.) && !CEi::is_degenerate_triangle(0., 1., 2.));
}

BOOST_AUTO_TEST_CASE(triangle_inequality_of_other_number_types)
{
  std::size_t failures = 0;
  for(int i = 0; i < 2000; ++i)
  {
    const int range = i % 2 ? 2 : 200; // the filter is for ratios up to 1e150
    const Double_double a = abs(random_double_double(range)), b = abs(random_double_double(range)), c = a + b;
    for(const Double_double& d : { c, c * (1. + 0x1p-104), c * (1. - 0x1p-104), c * 1.5, c * .7 })
      BOOST_REQUIRE_EQUAL(CEi::triangle_inequality_sign(a, b, d, &failures), reference_sign(a, b, d));
    const long double e = static_cast<long double>(a), f = static_cast<long double>(b), g = e + f;
    for(const long double d : { g, std::nextafter(g, 0.L), std::nextafter(g, 2 * g) })
      BOOST_REQUIRE_EQUAL(CEi::triangle_inequality_sign(e, f, d, &failures), reference_sign(e, f, d));
  }
  BOOST_CHECK_GT(failures, 2000u * 5);
  BOOST_CHECK_LE(failures, 2000u * 6); // the clear cases never came to the rationals
  const Wide one(1), ulp = ldexp(one, -399);
  BOOST_CHECK(CEi::is_degenerate_triangle(one, one, Wide(2 * one)));
  BOOST_CHECK(CEi::is_triangle(one, one, Wide(2 * one - ulp)) && !CEi::is_triangle(one, one, Wide(2 * one + 2 * ulp)));
  const Wide huge = ldexp(one, 3000); // beyond double
  BOOST_CHECK(CEi::is_degenerate_triangle(huge, huge, Wide(2 * huge)) && CEi::is_triangle(huge, huge, huge));
  BOOST_CHECK(CEi::is_triangle(3.f, 4.f, 5.f) && CEi::is_degenerate_triangle(1.f, 2.f, 3.f));
}

BOOST_AUTO_TEST_CASE(scaled_triangle_inequality)
{
  std::size_t failures = 0, failures_far = 0, zeros = 0;
  for(int i = 0; i < 6000; ++i)
  {
    const int range = i % 2 ? 3 : 60;
    double x[6];
    for(double& y : x)
      y = std::fabs(random_with_exponent(range));
    const double tie = (x[0] * x[1] * x[3] + x[2] * x[0] * x[5]) / (x[1] * x[2]);
    for(const double l_jk : { tie, up(tie), down(tie), up(up(tie)), down(down(tie)) })
      BOOST_REQUIRE_EQUAL(CEi::scaled_triangle_inequality_sign(x[0], x[1], x[2], x[3], l_jk, x[5], &failures),
                          reference_scaled_sign(x[0], x[1], x[2], x[3], l_jk, x[5]));
    for(const double factor : { 1 + 1e-13, 1 - 1e-13, .5, 7. })
      BOOST_REQUIRE_EQUAL(CEi::scaled_triangle_inequality_sign(x[0], x[1], x[2], x[3], tie * factor, x[5], &failures_far),
                          reference_scaled_sign(x[0], x[1], x[2], x[3], tie * factor, x[5]));
    // exact ties: small integers
    const double s = 1 + i % 5, t = 1 + i % 7, r = 1 + i % 3, l = 1 + i % 11;
    const double l_ij = t * r * l * r, l_ki = t * t * l * r, exact = s * l * r * (t + t); // s t l_ij + r s l_ki = t r l_jk
    const CGAL::Sign sign = CEi::scaled_triangle_inequality_sign(s, t, r, l_ij, exact * t, l_ki);
    BOOST_REQUIRE_EQUAL(sign, reference_scaled_sign(s, t, r, l_ij, exact * t, l_ki));
    zeros += sign == CGAL::ZERO ? 1 : 0;
  }
  BOOST_CHECK_GT(failures, 0u);
  BOOST_CHECK_EQUAL(failures_far, 0u); // the filter decides whatever is 1e-13 from a tie
  BOOST_CHECK_GT(zeros, 0u);
}

BOOST_AUTO_TEST_CASE(scaled_triangle_inequality_where_products_leave_the_range)
{
  std::size_t failures = 0, failures_far = 0;
  const double magnitudes[] = { 1e-300, 1e-200, 1e-150, 1e-110, 1., 1e110, 1e150, 1e200, 1e300 };
  for(const double s : magnitudes)
    for(const double l : magnitudes)
      for(int i = 0; i < 20; ++i)
      {
        const double s_i = s * random_double(1, 4), s_j = s * random_double(1, 4), s_k = s * random_double(1, 4),
                     l_ij = l * random_double(1, 4), l_ki = l * random_double(1, 4);
        const double tie = s_i / s_k * l_ij + s_i / s_j * l_ki;
        for(const double l_jk : { tie, up(tie), down(tie) })
          BOOST_REQUIRE_EQUAL(CEi::scaled_triangle_inequality_sign(s_i, s_j, s_k, l_ij, l_jk, l_ki, &failures),
                              reference_scaled_sign(s_i, s_j, s_k, l_ij, l_jk, l_ki));
        for(const double l_jk : { .9 * tie, 1.1 * tie })
          BOOST_REQUIRE_EQUAL(CEi::scaled_triangle_inequality_sign(s_i, s_j, s_k, l_ij, l_jk, l_ki, &failures_far),
                              reference_scaled_sign(s_i, s_j, s_k, l_ij, l_jk, l_ki));
        const Double_double d_i(s_i), d_j = Double_double(s_j) * (1. + 0x1p-80), d_k(s_k), d_ij(l_ij), d_ki(l_ki), d_jk(tie);
        if(l > 1e-290 && s > 1e-290)
          BOOST_REQUIRE_EQUAL(CEi::scaled_triangle_inequality_sign(d_i, d_j, d_k, d_ij, d_jk, d_ki),
                              reference_scaled_sign(d_i, d_j, d_k, d_ij, d_jk, d_ki));
      }
  BOOST_CHECK_GT(failures, 0u);
  BOOST_CHECK_EQUAL(failures_far, 0u); // common factors, however large, are no reason for rationals
  // factors that differ by more than double's range squared
  BOOST_CHECK_EQUAL(CEi::scaled_triangle_inequality_sign(1e-300, 1e300, 1e300, 1., 1., 1.), CGAL::NEGATIVE);
  BOOST_CHECK_EQUAL(CEi::scaled_triangle_inequality_sign(1e300, 1e-300, 1e-300, 1., 1e300, 1.), CGAL::POSITIVE);
  BOOST_CHECK_EQUAL(CEi::scaled_triangle_inequality_sign(0x1p-1000, 0x1p+500, 1., 0x1p+500, 0x1p-501, 0.), CGAL::POSITIVE);
  BOOST_CHECK_EQUAL(CEi::scaled_triangle_inequality_sign(0x1p-1000, 0x1p+500, 1., 0x1p+500, 0x1p-500, 0.), CGAL::ZERO);
  BOOST_CHECK_EQUAL(CEi::scaled_triangle_inequality_sign(0x1p-600, 0x1p-600, 0x1p-600, 1., 2., 1.), CGAL::ZERO);
  BOOST_CHECK_EQUAL(CEi::scaled_triangle_inequality_sign(0x1p-600, 0x1p-600, 0x1p-600, 1., up(2.), 1.), CGAL::NEGATIVE);
  BOOST_CHECK_EQUAL(CEi::scaled_triangle_inequality_sign(0x1p+600, 0x1p+600, 0x1p+600, 1., down(2.), 1.), CGAL::POSITIVE);
  BOOST_CHECK(CEi::is_scaled_triangle(1., 1., 1., 3., 4., 5.) && !CEi::is_scaled_triangle(1., 1., 1., 3., 4., 7.));
  BOOST_CHECK(!CEi::is_scaled_triangle(1., 1., 1., 7., 4., 3.) && !CEi::is_scaled_triangle(1., 1., 1., 4., 7., 3.));
  BOOST_CHECK(CEi::is_scaled_triangle(2., 1., 1., 3., 7., 4.)); // scaled: 6, 7, 8
}

// Points of a few kinds: on a small grid, random in the whole range of `double`, subnormal, near 1, near overflow, and of exponents that
// have nothing to do with each other; a quarter of the triples is collinear but for rounding.
BOOST_AUTO_TEST_CASE(turns_are_those_of_rational_points)
{
  const auto few = [](int n) { return double(int(generator() % std::uint64_t(2 * n + 1)) - n); };
  const auto coordinate = [&](int kind)
  {
    switch(kind)
    {
      case 0: return few(3);
      case 1: return random_with_exponent(1000);
      case 2: return std::ldexp(few(2), -1074);
      case 3: return 1 + std::ldexp(few(4), -52);
      case 4: return std::ldexp(few(4), 1020);
      default: return std::ldexp(few(4), int(generator() % 2090) - 1074);
    }
  };
  const auto sign = [](const auto& p, const auto& q, const auto& r)
  {
    const Rational x = rational(p[0]), y = rational(p[1]);
    return CGAL::sign(((rational(q[0]) - x) * (rational(r[1]) - y)).compare((rational(q[1]) - y) * (rational(r[0]) - x)));
  };
  for(int i = 0; i < 20000; ++i)
  {
    const int kind = int(generator() % 6);
    std::array<std::array<double, 2>, 3> p;
    for(std::array<double, 2>& z : p)
      z = {{ coordinate(kind), coordinate(kind) }};
    if(generator() % 4 == 0 && std::isfinite(2 * p[1][0] - p[0][0]) && std::isfinite(2 * p[1][1] - p[0][1]))
      p[2] = {{ 2 * p[1][0] - p[0][0], 2 * p[1][1] - p[0][1] }};
    const CGAL::Sign expected = sign(p[0], p[1], p[2]);
    BOOST_REQUIRE_EQUAL(int(CEi::turn(p[0], p[1], p[2])), int(expected));
    BOOST_REQUIRE_EQUAL(CEi::is_left_turn(p[0], p[1], p[2]), expected == CGAL::POSITIVE);
  }
  const auto pair = [&] { return Double_double(1 + std::ldexp(few(2), -52), std::ldexp(few(2), generator() % 2 ? -105 : -900)); };
  for(int i = 0; i < 5000; ++i)
  {
    std::array<std::array<Double_double, 2>, 3> p;
    for(std::array<Double_double, 2>& z : p)
      z = {{ pair(), pair() }};
    BOOST_REQUIRE_EQUAL(CEi::is_left_turn(p[0], p[1], p[2]), sign(p[0], p[1], p[2]) == CGAL::POSITIVE);
  }
  const double infinity = std::numeric_limits<double>::infinity();
  BOOST_TEST(!CEi::is_left_turn(std::array<double, 2>{{0, 0}}, {{infinity, 0}}, {{0, 1}}));
}
