// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The formulas of one triangle and the energy E, its gradient and its Hessian (equations (6) to
// (10), (13), (14)), against wide arithmetic and differences taken in it. And what its values are made of:
// Milnor's Lobachevsky function against the numerical integral of its definition, its
// identities and its known values (Milnor, "Hyperbolic geometry: the first 150 years", 1982).

#define BOOST_TEST_MODULE test_energy
#include "include/boost_test.h"
#include "include/test_meshes.h"
#include "include/tolerances.h"

#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/conformal_energy.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Patchwise_energy.h>
#include <CGAL/Conformal_equivalence/internal/Solver/energy.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_angle_sums.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/Incircle_vectors.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/Lobachevsky.h>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <limits>
#include <set>
#include <vector>

namespace CEi = CGAL::Conformal_equivalence::internal;
namespace mp = boost::multiprecision;

typedef CGAL::Conformal_equivalence::Intrinsic_triangulation<> Triangulation;
using CEi::Double_double;
using CEi::Lobachevsky;
using testing::Index;

// --- the Lobachevsky function -------------------------------------------------------------------

namespace {

typedef mp::cpp_bin_float_100 Wide;

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
  BOOST_CHECK_SMALL(static_cast<double>(Wide(reference(wide_pi / 4) - catalan / 2)), 1e-60); // far more digits than any type below
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
  typedef mp::number<mp::cpp_bin_float<200, mp::digit_base_2> > NT;
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
  BOOST_CHECK_SMALL(Lobachevsky(pi / 3) - 1.0149416064096536 / 3, testing::few_roundings);
  BOOST_CHECK_SMALL(Lobachevsky(pi / 6) - 1.0149416064096536 / 2, testing::few_roundings); // the maximum
  BOOST_CHECK_SMALL(Lobachevsky(pi / 4) - .91596559417721902 / 2, testing::few_roundings);
  BOOST_CHECK_GT(Lobachevsky(pi / 6), Lobachevsky(pi / 6 + 1e-5));
  BOOST_CHECK_GT(Lobachevsky(pi / 6), Lobachevsky(pi / 6 - 1e-5));
  // the value at the double below pi: with pi - x = d, -d (1 - log(2d))
  const double d = 1.2246467991473532e-16;
  BOOST_CHECK_CLOSE_FRACTION(Lobachevsky(pi), -d * (1 - std::log(2 * d)), 10 * testing::few_roundings);
  for(double x = .05; x < 3.1; x += .05)
  {
    const double h = 1e-5, slope = (Lobachevsky(x + h) - Lobachevsky(x - h)) / (2 * h);
    // h^2/6 sup 1/sin^2 and rounding 2^-52 / h
    BOOST_CHECK_SMALL(slope + std::log(2 * std::sin(x)), 1e-10 / 6 / (std::sin(x - h) * std::sin(x - h)) * 4 + 1e-10);
  }
}

// --- one triangle -------------------------------------------------------------------------------

namespace {

typedef mp::number<mp::cpp_bin_float_50::backend_type, mp::et_off> Real;

const double eps = std::numeric_limits<double>::epsilon();
const Real step("1e-16"); // of central differences: their error is step^2 times a third derivative
const double slope_error = 1e-24;  // which is below 10^8 for these triangles
const double slope_error_of_needles = 1e-20;

typedef std::array<double, 3> Sides;

// Triangles with none, one and two small angles; all but the last four moderately so.
const std::vector<Sides> triangles = {{{1, 1, 1}}, {{3, 4, 5}}, {{7, 5, 3}}, {{1, 1, 1.9375}}, {{1, 1, .03125}}, {{1, .75, 1.734375}},
                                      {{1, 1, 1e-12}}, {{1, 1e-12, 1}}, {{1, 1, 2 - 4 * eps}}, {{1, 1.5, 2.5 - 1e-13}}};
const std::vector<Sides> broken_triangles = {{{1, 1, 3}}, {{5, 1, 2}}, {{.25, 8, .5}}, {{1, 3, 2}}, {{1, 2, 3}}}; // the last two exactly degenerate

template <typename NT>
CEi::Incircle_form<NT> incircle(const Sides& s)
{
  return CEi::Incircle_form<NT>(NT(s[0]), NT(s[1]), NT(s[2]));
}

template <typename NT>
CEi::Triangle_angles<NT> angles_of(const Sides& s)
{
  return CEi::triangle_angles<NT>(NT(s[0]), NT(s[1]), NT(s[2]));
}

std::array<Real, 3> logarithmic(const Sides& s)
{
  return {{2 * log(Real(s[0])), 2 * log(Real(s[1])), 2 * log(Real(s[2]))}};
}

std::array<Real, 3> angles_at(const std::array<Real, 3>& lambda)
{
  return CEi::triangle_angles<Real>(exp(lambda[0] / 2), exp(lambda[1] / 2), exp(lambda[2] / 2)).angle;
}

// With u and u + change at the corners; corner k is opposite to side k.
std::array<Real, 3> changed(std::array<Real, 3> lambda, const std::array<Real, 3>& u, const Real& t)
{
  for(int k = 0; k < 3; ++k)
    lambda[k] += t * (u[(k + 1) % 3] + u[(k + 2) % 3]);
  return lambda;
}

BOOST_AUTO_TEST_CASE(angles_and_cotangents_of_any_triangle)
{
  typedef mp::number<mp::cpp_bin_float_100::backend_type, mp::et_off> Exact;
  std::vector<Sides> all = triangles;
  testing::Random random(3);
  for(int i = 0; i < 2000; ++i) // needles and caps to within a rounding of degenerate
  {
    const double a = random(.5, 2), b = std::exp(random(-30, 0)), least = std::abs(a - b), most = a + b;
    const double c = i % 3 == 0 ? random(least, most) : i % 3 == 1 ? most - b * std::exp(random(-36, 0))
                                                                   : least + b * std::exp(random(-36, 0));
    const std::array<Sides, 3> orders = {{{{a, b, c}}, {{c, a, b}}, {{b, c, a}}}};
    all.push_back(orders[i / 3 % 3]);
  }
  std::size_t tested = 0;
  double worst_angle = 0, worst_cotangent = 0;
  for(const Sides& s : all)
  {
    const auto exact = angles_of<Exact>(s);
    const auto got = angles_of<double>(s);
    BOOST_CHECK_EQUAL(got.is_broken, exact.is_broken); // the numbers stored decide
    if(exact.is_broken)
      continue;
    ++tested;
    for(int k = 0; k < 3; ++k)
    {
      // s, s - a, s - b, s - c carry at most 3/2 roundings, r^2 at most 15/2, r at most 5
      const Exact error = abs(Exact(got.angle[k] - exact.angle[k])) / exact.angle[k];
      worst_angle = (std::max)(worst_angle, double(error) / eps);
      // x - 1/x loses digits near a right angle only, absolutely
      const Exact far = abs(Exact(got.cotangent[k] - exact.cotangent[k])) / (1 + abs(exact.cotangent[k]));
      worst_cotangent = (std::max)(worst_cotangent, double(far) / eps);
      BOOST_CHECK_CLOSE_FRACTION(double(1 / tan(exact.angle[k])), double(exact.cotangent[k]), 1e-9 * (1 + 1 / std::abs(double(exact.cotangent[k]))));
    }
    BOOST_CHECK_SMALL(got.angle[0] + got.angle[1] + got.angle[2] - testing::pi, 8 * eps);
  }
  BOOST_TEST_MESSAGE(tested << " triangles; angles within " << worst_angle << " eps, cotangents within "
                     << worst_cotangent << " eps");
  BOOST_CHECK_GT(tested, 1500);
  BOOST_CHECK_LE(worst_angle, 6);
  BOOST_CHECK_LE(worst_cotangent, 8);
}

BOOST_AUTO_TEST_CASE(angles_are_homogeneous)
{
  for(const Sides& s : triangles)
    for(const int exponent : {-500, -300, 300, 490})
    {
      const auto here = angles_of<double>(s);
      const auto far = angles_of<double>({{std::ldexp(s[0], exponent), std::ldexp(s[1], exponent), std::ldexp(s[2], exponent)}});
      for(int k = 0; k < 3; ++k)
        BOOST_CHECK_CLOSE_FRACTION(far.angle[k], here.angle[k], 4 * eps);
    }
}

BOOST_AUTO_TEST_CASE(broken_triangles_have_the_angles_pi_0_0)
{
  for(const Sides& s : broken_triangles)
  {
    const auto t = angles_of<double>(s);
    const auto longest = std::max_element(s.begin(), s.end()) - s.begin();
    BOOST_CHECK(t.is_broken);
    for(int k = 0; k < 3; ++k)
    {
      BOOST_CHECK_EQUAL(t.angle[k], k == longest ? testing::pi : 0);
      BOOST_CHECK_EQUAL(t.cotangent[k], 0);
    }
  }
}

template <typename NT>
void check_rotations(double unit)
{
  for(const Sides& s : triangles)
  {
    const auto exact = incircle<Real>(s);
    const CEi::Incircle_form<NT> t = incircle<NT>(s);
    CEi::Complex_number<NT> product = {NT(1), NT(0)};
    for(int k = 0; k < 3; ++k)
    {
      const Real alpha = CEi::angle(exact, k);
      const CEi::Complex_number<NT> z = CEi::rotation(t, k), w = {t.tangent[k], t.r}, square = w * w;
      const NT size = w.re * w.re + w.im * w.im;
      BOOST_CHECK_SMALL(double(Real(Real(z.re) - cos(alpha))), 12 * unit);
      BOOST_CHECK_SMALL(double(Real(Real(z.im) - sin(alpha))), 12 * unit);
      BOOST_CHECK_SMALL(double(NT(z.re * z.re + z.im * z.im - 1)), 8 * unit);
      BOOST_CHECK_SMALL(double(NT(square.re / size - z.re)), 12 * unit);
      BOOST_CHECK_SMALL(double(NT(square.im / size - z.im)), 12 * unit);
      product = product * z;
    }
    BOOST_CHECK_SMALL(double(NT(product.re + 1)), 40 * unit); // the angles sum to pi
    BOOST_CHECK_SMALL(double(product.im), 40 * unit);
  }
  for(const double x : {0., 1e-20, .5, -1.5, 3.14159, 6.28, -40.})
  {
    const CEi::Complex_number<NT> z = CEi::unit_complex(NT(x));
    BOOST_CHECK_SMALL(double(Real(Real(z.re) - cos(Real(x)))), 4096 * unit); // ten squarings cost ten bits
    BOOST_CHECK_SMALL(double(Real(Real(z.im) - sin(Real(x)))), 4096 * unit);
  }
}

BOOST_AUTO_TEST_CASE(rotations_by_angles)
{
  check_rotations<double>(eps);
  check_rotations<Real>(double(std::numeric_limits<Real>::epsilon()));
}

// (13): df/dlambda_k = alpha_k / 2, in broken triangles too
BOOST_AUTO_TEST_CASE(derivative_of_the_energy_of_a_triangle)
{
  std::vector<Sides> all(triangles.begin(), triangles.begin() + 6);
  all.insert(all.end(), broken_triangles.begin(), broken_triangles.end() - 2);
  for(const Sides& s : all)
  {
    const std::array<Real, 3> lambda = logarithmic(s), alpha = angles_at(lambda);
    for(int k = 0; k < 3; ++k)
    {
      std::array<Real, 3> more = lambda, less = lambda;
      more[k] += step;
      less[k] -= step;
      const Real slope = (CEi::triangle_energy(more) - CEi::triangle_energy(less)) / (2 * step);
      BOOST_CHECK_SMALL(double(Real(slope - alpha[k] / 2)), slope_error);
    }
  }
}

// (14): how the angles follow u
BOOST_AUTO_TEST_CASE(derivatives_of_the_angles)
{
  const std::array<Real, 3> u = {{Real(".7"), Real("-1.1"), Real(".2")}};
  for(std::size_t i = 0; i < 6; ++i)
  {
    const std::array<Real, 3> lambda = logarithmic(triangles[i]);
    const auto cot = angles_of<Real>(triangles[i]).cotangent;
    const auto more = angles_at(changed(lambda, u, step)), less = angles_at(changed(lambda, u, -step));
    for(int a = 0; a < 3; ++a)
    {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      const Real slope = (more[a] - less[a]) / (2 * step);
      const Real expected = (cot[b] * (u[c] - u[a]) + cot[c] * (u[b] - u[a])) / 2;
      BOOST_CHECK_SMALL(double(Real(slope - expected)), slope_error);
    }
  }
}

// C^1: where a triangle breaks, f is continuous and so are its slopes, the angles, with the order 1/2.
BOOST_AUTO_TEST_CASE(energy_of_a_triangle_is_smooth_where_it_breaks)
{
  for(const Sides& s : {Sides{{1, 2, 3}}, Sides{{1.25, 1, .25}}, Sides{{1, 1 + 1. / 1024, 1. / 1024}}})
    for(const char* distance : {"1e-6", "1e-12", "1e-24"})
    {
      const Real t(distance), root = sqrt(t);
      const std::array<Real, 3> lambda = logarithmic(s);
      for(int k = 0; k < 3; ++k)
      {
        std::array<Real, 3> more = lambda, less = lambda;
        more[k] += t;
        less[k] -= t;
        const auto alpha = angles_at(lambda), above = angles_at(more), below = angles_at(less);
        for(int m = 0; m < 3; ++m)
        {
          BOOST_CHECK_LE(abs(Real(above[m] - alpha[m])), 100 * root);
          BOOST_CHECK_LE(abs(Real(below[m] - alpha[m])), 100 * root);
        }
        const Real f = CEi::triangle_energy(lambda);
        const Real slope_above = (CEi::triangle_energy(more) - f) / t, slope_below = (f - CEi::triangle_energy(less)) / t;
        BOOST_CHECK_LE(abs(Real(slope_above - alpha[k] / 2)), 50 * root);
        BOOST_CHECK_LE(abs(Real(slope_below - alpha[k] / 2)), 50 * root);
        BOOST_CHECK_GE(slope_above, slope_below - Real(slope_error)); // convex
      }
    }
}

// --- the energy of a surface ---------------------------------------------------------------------

std::vector<Triangulation> surfaces()
{
  testing::Soup noisy = testing::icosahedron();
  testing::add_noise(noisy, .2, 5);
  return {testing::triangulation(testing::one_triangle({{0, 0, 0}}, {{3, 0, 0}}, {{1, 2, 0}})),
          testing::triangulation(testing::hill(3, .6)), testing::triangulation(noisy),
          testing::triangulation(testing::annulus(1, 5, .3)), testing::triangulation(testing::torus(3, 4)),
          testing::triangulation(testing::together({testing::cone(3, 1), testing::cone(5, .3)}, true)),
          testing::one_vertex_torus(2., 1.5, 1.)};
}

template <typename NT>
std::vector<NT> as(const std::vector<double>& x)
{
  return std::vector<NT>(x.begin(), x.end());
}

template <typename NT>
std::vector<NT> moved(std::vector<NT> u, const std::vector<NT>& d, const NT& t)
{
  for(std::size_t v = 0; v < u.size(); ++v)
    u[v] += t * d[v];
  return u;
}

typedef CEi::Conformal_energy<Real, double> Energy;

// Small u, and u that break triangles.
std::vector<double> some_u(const Triangulation& t, unsigned seed)
{
  return testing::random_numbers(t.number_of_vertices(), seed % 2 == 0 ? .2 : 3, seed);
}

BOOST_AUTO_TEST_CASE(gradient_and_hessian_are_the_derivatives)
{
  std::size_t whole = 0, broken = 0;
  for(const Triangulation& t : surfaces())
    for(unsigned seed = 0; seed < 4; ++seed)
    {
      const std::vector<Real> u = as<Real>(some_u(t, seed)), target = as<Real>(testing::random_numbers(u.size(), 6, 9)),
                              d = as<Real>(testing::random_numbers(u.size(), 1, 17 + seed));
      Energy energy(t);
      energy.evaluate(moved(u, d, step));
      const std::vector<Real> more = energy.angle_sums();
      energy.evaluate(moved(u, d, Real(-step)));
      const std::vector<Real> less = energy.angle_sums();
      BOOST_REQUIRE(energy.evaluate(u));
      (energy.broken_faces().empty() ? whole : broken) += 1;
      const std::vector<Real> hessian = energy.hessian_product(d);
      Real slope(0);
      for(Index v = 0; v < u.size(); ++v)
      {
        if(t.is_isolated_vertex(v))
        {
          BOOST_CHECK_EQUAL(energy.angle_sums()[v], 0);
          continue;
        }
        slope += (target[v] - energy.angle_sums()[v]) / 2 * d[v]; // (9)
        BOOST_CHECK_SMALL(double(Real(-(more[v] - less[v]) / (4 * step) - hessian[v])), slope_error_of_needles); // (10)
      }
      using namespace CGAL::Conformal_equivalence;
      const Real difference = (conformal_energy(t, moved(u, d, step), target) - conformal_energy(t, moved(u, d, Real(-step)), target)) / (2 * step);
      BOOST_CHECK_SMALL(double(Real(difference - slope)), slope_error_of_needles);

      // by the functions at index level
      const std::vector<Real> gradient = conformal_energy_gradient(t, u, target);
      Real product(0);
      for(Index v = 0; v < u.size(); ++v)
        product += gradient[v] * d[v];
      BOOST_CHECK_SMALL(double(Real(difference - product)), slope_error_of_needles);
      BOOST_CHECK(conformal_energy_hessian_product(t, u, d) == hessian);
    }
  BOOST_TEST_MESSAGE(whole << " metrics and " << broken << " with broken triangles");
  BOOST_CHECK(whole >= 8 && broken >= 8);
}

// Angle sums of many turns, of needles and of broken triangles, corner by corner in wide arithmetic.
BOOST_AUTO_TEST_CASE(angle_sums_of_fans)
{
  for(const Index n : {3, 6, 200})
    for(unsigned seed = 0; seed < 30; ++seed)
    {
      Triangulation t = testing::triangulation(testing::cone(n, 1));
      testing::Random random(seed);
      const double small = seed % 3 == 2 ? 1e-100 : 1;
      for(Index e = 0; e < t.number_of_edges(); ++e)
        t.set_length(e, t.is_border_edge(e) ? small * random(.1, seed % 3 == 1 ? 3 : 1.9) : random(1, 1.05));
      std::vector<Real> exact(t.number_of_vertices(), Real(0));
      for(Index h = 0; h < t.number_of_halfedges(); h += 3)
      {
        const auto triangle = angles_of<Real>({{t.halfedge_length(h), t.halfedge_length(h + 1), t.halfedge_length(h + 2)}});
        for(Index k = 0; k < 3; ++k)
          exact[t.apex(h + k)] += triangle.angle[k];
      }
      CEi::Conformal_energy<double> energy(t);
      BOOST_REQUIRE(energy.evaluate(std::vector<double>(n + 1, 0.)));
      for(Index v = 0; v <= n; ++v) // the errors of angles, and one rounding of the sum for each
        BOOST_CHECK_SMALL(double(Real(energy.angle_sums()[v] - exact[v])), (17 + double(exact[v])) * testing::unit_roundoff * t.degree(v));
    }
}

BOOST_AUTO_TEST_CASE(energy_is_convex_and_does_not_see_the_scale)
{
  std::size_t crossings = 0;
  for(const Triangulation& t : surfaces())
    for(unsigned seed = 0; seed < 4; ++seed)
    {
      const std::vector<Real> u = as<Real>(testing::random_numbers(t.number_of_vertices(), 5, 2 * seed)),
                              v = as<Real>(testing::random_numbers(t.number_of_vertices(), 5, 2 * seed + 1));
      const std::vector<Real> d = moved(v, u, Real(-1)), target = as<Real>(std::vector<double>(u.size(), 2));
      Energy energy(t);
      const int n = 24;
      std::vector<Real> value, slope;
      std::size_t last = 0;
      for(int i = 0; i <= n; ++i)
      {
        const std::vector<Real> x = moved(u, d, Real(Real(i) / n));
        value.push_back(CGAL::Conformal_equivalence::conformal_energy(t, x, target));
        energy.evaluate(x);
        crossings += i > 0 && energy.broken_faces().size() != last ? 1 : 0;
        last = energy.broken_faces().size();
        slope.push_back(Real(0));
        for(Index w = 0; w < x.size(); ++w)
          if(!t.is_isolated_vertex(w))
            slope.back() += (target[w] - energy.angle_sums()[w]) / 2 * d[w];
      }
      for(int i = 0; i < n; ++i)
      {
        BOOST_CHECK_GE(slope[i + 1] - slope[i], Real("-1e-40"));
        const Real rise = n * (value[i + 1] - value[i]); // between the slopes at both ends
        BOOST_CHECK(rise >= slope[i] - Real("1e-40") && rise <= slope[i + 1] + Real("1e-40"));
      }
      // adding a constant changes E by half the total defect of the targets only
      Real excess(0);
      for(Index w = 0; w < u.size(); ++w)
        excess += t.is_isolated_vertex(w) ? 0 : target[w] / 2;
      excess -= CEi::Number_constants<Real>::pi() * t.number_of_faces() / 2;
      const std::vector<Real> shifted = moved(u, std::vector<Real>(u.size(), Real(1)), Real(7));
      BOOST_CHECK_SMALL(double(Real(CGAL::Conformal_equivalence::conformal_energy(t, shifted, target) - value[0] - 7 * excess)), 1e-40);
    }
  BOOST_TEST_MESSAGE(crossings << " times a triangle broke or healed between two points");
  BOOST_CHECK_GT(crossings, 50);
}

// The angle sums at u, which are multiples of 2^-20 up to 5, against those at u + w of lengths e^{-(w_i + w_j)/2} l, where w ranges far beyond what
// e^{w/2} can be in `double`. u + w is rounded, and the factor is e^x for an x that is a difference of numbers as large as w / 2: two errors of
// 2^-53 |w| in u at most, and the angles at a vertex move by its sensitivity at most times those of the lengths.
BOOST_AUTO_TEST_CASE(angle_sums_do_not_see_how_far_u_ranges)
{
  const double farthest = 6000;
  for(const Triangulation& t : surfaces())
    for(const bool is_constant : { true, false })
    {
      std::vector<double> u, w = testing::random_numbers(t.number_of_vertices(), farthest, 1);
      for(const double x : testing::random_numbers(t.number_of_vertices(), 5, 2))
        u.push_back(std::ldexp(std::round(std::ldexp(x, 20)), -20));
      if(is_constant)
        w.assign(w.size(), farthest);
      std::vector<Real> lengths;
      for(Index e = 0; e < t.number_of_edges(); ++e)
      {
        const Index i = t.origin(t.edge_halfedge(e)), j = t.target(t.edge_halfedge(e));
        lengths.push_back(Real(exp(Real(-(Real(w[i]) + w[j]) / 2)) * t.length(e)));
      }
      const auto stretched = t.with_lengths(lengths);
      CEi::Conformal_energy<double> here(t);
      CEi::Conformal_energy<double, Real> there(stretched, true);
      std::vector<double> sum;
      for(std::size_t v = 0; v < u.size(); ++v)
        sum.push_back(u[v] + w[v]);
      BOOST_REQUIRE(here.evaluate(u));
      BOOST_REQUIRE(there.evaluate(sum));
      BOOST_CHECK(!here.ranges_far());
      BOOST_CHECK(there.ranges_far());
      BOOST_CHECK(here.broken_faces() == there.broken_faces());
      const std::vector<double> sensitivity = here.sensitivities();
      for(Index v = 0; v < u.size(); ++v)
        BOOST_CHECK_SMALL(here.angle_sums()[v] - there.angle_sums()[v], 4 * farthest * testing::unit_roundoff * (1 + sensitivity[v]));
    }
}

// all but one row and column are positive definite; constants are in the null space
BOOST_AUTO_TEST_CASE(hessian_is_positive_semidefinite)
{
  for(const Triangulation& t : surfaces())
  {
    const std::size_t components = CGAL::Conformal_equivalence::connected_components(t).components.size();
    if(components > 1)
      continue;
    CEi::Conformal_energy<double> energy(t);
    const std::size_t n = t.number_of_vertices();
    energy.evaluate(std::vector<double>(n, 0.));
    double largest = 0;
    for(const double w : energy.weights())
      largest = (std::max)(largest, std::abs(w));
    for(const double x : energy.hessian_product(std::vector<double>(n, 1.)))
      BOOST_CHECK_EQUAL(x, 0);
    std::vector<std::vector<double> > a;
    for(std::size_t i = 0; i < n; ++i)
    {
      std::vector<double> unit(n, 0.);
      unit[i] = 1;
      a.push_back(energy.hessian_product(unit));
    }
    for(std::size_t k = 0; k < n; ++k) // Gauss
    {
      if(k + 1 < n)
        BOOST_CHECK_GT(a[k][k], 1e-3 * largest);
      else
        BOOST_CHECK_SMALL(a[k][k], 1e-13 * largest);
      for(std::size_t i = k + 1; i < n; ++i)
        for(std::size_t j = n; j-- > k;)
          a[i][j] -= a[i][k] / a[k][k] * a[k][j];
    }
    // with broken triangles still semidefinite
    for(unsigned seed = 0; seed < 10; ++seed)
    {
      energy.evaluate(testing::random_numbers(n, 4, seed));
      const std::vector<double> d = testing::random_numbers(n, 1, 31 + seed), h = energy.hessian_product(d);
      double form = 0, size = 0;
      for(std::size_t v = 0; v < n; ++v)
      {
        form += d[v] * h[v];
        size += std::abs(d[v] * h[v]);
      }
      BOOST_CHECK_GE(form, -64 * eps * size);
    }
  }
}

// --- patches of a surface --------------------------------------------------------------------------

// Sides 1, 1 and 3: with u = k at the apex the short ones become e^{k/2}, and 3 is as long as both of them at k = 2 log 1.5.
BOOST_AUTO_TEST_CASE(a_triangle_that_remains_broken)
{
  Triangulation t = testing::triangulation(testing::one_triangle({{0, 0, 0}}, {{3, 0, 0}}, {{1, 2, 0}}));
  const Index h = 0, apex = t.apex(h);
  t.set_length(t.edge(h), 3);
  t.set_length(t.edge(h + 1), 1);
  t.set_length(t.edge(h + 2), 1);
  CEi::Conformal_energy<double> energy(t);
  energy.evaluate(std::vector<double>(3, 0.));
  BOOST_REQUIRE_EQUAL(energy.broken_faces().size(), 1);
  const double mended = 2 * std::log(1.5);
  for(const double size : {1e-3, 1., 40.})
    for(const double sign : {-1., 1.})
    {
      std::vector<double> d(3, 7.); // which is the same for all corners, but for the apex
      d[apex] += sign * size;
      BOOST_CHECK(energy.stays_broken(d, (1 - 1e-9) * mended / size));
      BOOST_CHECK(!energy.stays_broken(d, (1 + 1e-9) * mended / size));
    }
  BOOST_CHECK(energy.stays_broken(std::vector<double>(3, 5.), 1e3)); // nothing changes its shape
}

BOOST_AUTO_TEST_CASE(triangles_that_remain_broken_do_so)
{
  std::size_t lasting = 0, mending = 0;
  for(const Triangulation& t : surfaces())
    for(unsigned seed = 0; seed < 12; ++seed)
    {
      const std::vector<double> u = some_u(t, 2 * seed + 1), d = testing::random_numbers(u.size(), 1, 31 + seed);
      CEi::Conformal_energy<double> energy(t);
      BOOST_REQUIRE(energy.evaluate(u));
      const std::vector<Index> broken = energy.broken_faces();
      for(const double most : {.1, .4, 2.})
      {
        const bool is_said = energy.stays_broken(d, most);
        std::set<Index> remaining(broken.begin(), broken.end()); // at all multiples that are looked at
        CEi::Conformal_energy<double> there(t);
        for(double part = -1; part <= 1; part += 1. / 16)
        {
          BOOST_REQUIRE(there.evaluate(moved(u, d, part * most)));
          const std::set<Index> now(there.broken_faces().begin(), there.broken_faces().end());
          for(auto f = remaining.begin(); f != remaining.end(); )
            f = now.count(*f) == 0 ? remaining.erase(f) : std::next(f);
        }
        BOOST_CHECK(!is_said || !remaining.empty());
        (is_said ? lasting : mending) += 1;
      }
    }
  BOOST_CHECK(lasting >= 20 && mending >= 20);
}

// On patches E is minimized: it falls, nothing else is touched, and the angle sums there are as prescribed.
BOOST_AUTO_TEST_CASE(minimum_on_patches)
{
  const double close = 1e-9; // as patches are solved for
  std::size_t broken = 0;
  for(const Triangulation& t : {testing::triangulation(testing::hill(6, .6)), testing::triangulation(testing::torus(7, 9)),
                                testing::triangulation(testing::annulus(3, 9, .3)),
                                testing::triangulation(testing::together({testing::hill(5, .2), testing::hill(4, .5)}, true))})
    for(unsigned seed = 1; seed <= 8; ++seed)
    {
      const std::size_t n = t.number_of_vertices();
      CEi::Edge_graph graph;
      graph.set_edges(t);
      std::vector<char> is_free(n, 0);
      for(Index v = 0; v < n; ++v)
        is_free[v] = !t.is_isolated_vertex(v) && !t.is_border_vertex(v);
      graph.set_free(is_free);
      const std::vector<double> target(n, 2 * CGAL_PI), u = testing::random_numbers(n, 1.5, seed);
      std::vector<Index> seeds = {Index(seed), Index(2 * seed + 11)};
      if(t.is_isolated_vertex(seeds[1]))
        seeds.pop_back();

      CEi::Patchwise_energy<double> energy(t);
      BOOST_REQUIRE(energy.evaluate(u));
      broken += energy.broken_faces().size();
      std::vector<double> x = u;
      energy.minimize_around(seeds, graph, target, x);

      std::vector<char> is_in_patch(n, 0);
      for(const Index v : seeds)
        for(Index h = 0; h < t.number_of_halfedges(); ++h)
          if(t.origin(h) == v || t.target(h) == v)
            is_in_patch[t.origin(h)] = is_in_patch[t.target(h)] = 1;
      BOOST_REQUIRE(energy.evaluate(x));
      for(Index v = 0; v < n; ++v)
        if(is_in_patch[v] && is_free[v])
          BOOST_CHECK_SMALL(energy.angle_sums()[v] - target[v], close + testing::layout_angle);
        else
          BOOST_CHECK_EQUAL(x[v], u[v]);
      const auto value = [&](const std::vector<double>& y)
      { return CGAL::Conformal_equivalence::conformal_energy(t, as<Real>(y), as<Real>(target)); };
      BOOST_CHECK(value(x) < value(u));
    }
  BOOST_CHECK(broken >= 20);
}

template <typename NT>
void check_against_wide(double unit)
{
  double worst = 0;
  for(const Triangulation& t : surfaces())
    for(unsigned seed = 0; seed < 4; ++seed)
    {
      const std::vector<double> u = some_u(t, seed), target = testing::random_numbers(u.size(), 6, 2);
      const Real exact = CGAL::Conformal_equivalence::conformal_energy(t, as<Real>(u), as<Real>(target));
      const NT got = CGAL::Conformal_equivalence::conformal_energy(t, as<NT>(u), as<NT>(target));
      // each term, of size pi (|lambda| + |u|), with a few roundings
      double size = 0;
      for(Index f = 0; f < t.number_of_faces(); ++f)
        for(Index h = 3 * f; h < 3 * f + 3; ++h)
          size += testing::pi * (1 + std::abs(2 * std::log(t.halfedge_length(h))) + 3 * std::abs(u[t.origin(h)]));
      for(std::size_t v = 0; v < u.size(); ++v)
        size += std::abs(target[v] * u[v]);
      worst = (std::max)(worst, double(Real(abs(Real(Real(got) - exact)) / (size * unit))));
    }
  BOOST_TEST_MESSAGE("energy within " << worst << " units of the last place of its terms");
  BOOST_CHECK_LE(worst, 4);
}

BOOST_AUTO_TEST_CASE(energy_in_all_number_types)
{
  check_against_wide<double>(eps);
  check_against_wide<long double>(double(std::numeric_limits<long double>::epsilon()));
}

// Scaling by powers of two inside changes nothing; ranges beyond double are reported, not computed with.
BOOST_AUTO_TEST_CASE(lengths_of_any_size)
{
  const Triangulation t = surfaces()[1];
  std::vector<double> lengths(t.lengths());
  for(double& l : lengths)
    l = std::ldexp(l, 400);
  const Triangulation far = t.with_lengths(lengths);
  const std::vector<double> u = some_u(t, 0);
  CEi::Conformal_energy<double> here(t, true), there(far, true);
  BOOST_CHECK(here.evaluate(u) && there.evaluate(u));
  BOOST_CHECK(here.angle_sums() == there.angle_sums() && here.weights() == there.weights());
  BOOST_CHECK(!here.evaluate(std::vector<double>(u.size(), 1e9)));
  BOOST_CHECK(!here.evaluate(std::vector<double>(u.size(), -1e9)));
  BOOST_CHECK(!here.evaluate(std::vector<double>(u.size(), std::numeric_limits<double>::quiet_NaN())));
}

// --- vectors of triangles --------------------------------------------------------------------------

// Needles, caps, and right angles, up to a rounding of degenerate.
std::vector<Sides> thin_and_right_triangles()
{
  std::vector<Sides> result = triangles;
  testing::Random random(11);
  for(int i = 0; i < 4000; ++i)
  {
    const double a = random(.5, 2), b = i % 2 == 0 ? random(.5, 2) : std::exp(random(-30, 0)), least = std::abs(a - b), most = a + b;
    const double c = i % 4 == 0 ? random(least, most) : i % 4 == 1 ? most - b * std::exp(random(-36, 0))
                   : i % 4 == 2 ? least + b * std::exp(random(-36, 0)) : std::sqrt(a * a + b * b);
    const std::array<Sides, 3> orders = {{{{a, b, c}}, {{c, a, b}}, {{b, c, a}}}};
    result.push_back(orders[i / 4 % 3]);
  }
  return result;
}

// What vectors of so many bytes make of all triangles, one after the other.
struct Vector_results
{
  std::vector<std::array<double, 3> > angle, cotangent;
  std::vector<char> is_plain;
};

template <int bytes>
CGAL_CONFORMAL_EQUIVALENCE_INLINE inline void compute_by_vectors(const std::vector<Sides>& all, Vector_results& result)
{
  typedef CEi::Incircle_vectors<bytes> Vectors;
  for(std::size_t first = 0; first + Vectors::lanes <= all.size(); first += Vectors::lanes)
  {
    typename Vectors::Vector side[3];
    for(int k = 0; k < 3; ++k)
    {
      double entries[Vectors::lanes];
      for(int i = 0; i < Vectors::lanes; ++i)
        entries[i] = all[first + i][k];
      std::memcpy(&side[k], entries, sizeof(entries));
    }
    Vectors vectors;
    vectors.compute(side[0], side[1], side[2]);
    for(int i = 0; i < Vectors::lanes; ++i)
    {
      result.angle.push_back({{vectors.angle[0][i], vectors.angle[1][i], vectors.angle[2][i]}});
      result.cotangent.push_back({{vectors.cotangent[0][i], vectors.cotangent[1][i], vectors.cotangent[2][i]}});
      result.is_plain.push_back(vectors.is_plain[i] != 0);
    }
  }
}

CGAL_CONFORMAL_EQUIVALENCE_AVX2 void compute_with_avx2(const std::vector<Sides>& all, Vector_results& result) { compute_by_vectors<32>(all, result); }

bool are_same_bits(double x, double y) { return std::memcmp(&x, &y, sizeof(x)) == 0; }

// The bounds are those that Incircle_vectors.h derives.
BOOST_AUTO_TEST_CASE(angles_and_cotangents_by_vectors)
{
  const std::vector<Sides> all = thin_and_right_triangles();
  Vector_results got, other;
  compute_by_vectors<16>(all, got);
  BOOST_REQUIRE(got.angle.size() + 4 > all.size());
  const double u = testing::unit_roundoff;
  double worst_angle = 0, worst_cotangent = 0;
  std::size_t tested = 0;
  for(std::size_t i = 0; i < got.angle.size(); ++i)
  {
    const auto exact = angles_of<Real>(all[i]);
    BOOST_CHECK_EQUAL(got.is_plain[i] != 0, !exact.is_broken);
    if(exact.is_broken)
      continue;
    ++tested;
    for(int k = 0; k < 3; ++k)
    {
      const double sine = double(sin(exact.angle[k]));
      worst_angle = (std::max)(worst_angle, double(abs(Real(got.angle[i][k] - exact.angle[k]))) / (17 * u));
      worst_cotangent = (std::max)(worst_cotangent, double(abs(Real(got.cotangent[i][k] - exact.cotangent[k])))
                                                    / (8 * u / sine + 4 * u * std::abs(double(exact.cotangent[k]))));
    }
  }
  BOOST_TEST_MESSAGE(tested << " triangles; errors of angles at most " << worst_angle << " times their bound, of cotangents " << worst_cotangent);
  BOOST_CHECK_GT(tested, 3500u);
  BOOST_CHECK_LE(worst_angle, 1);
  BOOST_CHECK_LE(worst_cotangent, 1);

  // the same bits by whatever vectors
  compute_by_vectors<32>(all, other);
  if(CEi::has_avx2())
    compute_with_avx2(all, other);
  for(std::size_t i = 0; i < other.angle.size(); ++i)
    for(int k = 0; k < 3; ++k)
    {
      const std::size_t same = i % (other.angle.size() / (CEi::has_avx2() ? 2 : 1));
      BOOST_CHECK_EQUAL(other.is_plain[i], got.is_plain[same]);
      if(got.is_plain[same] == 0)
        continue;
      BOOST_CHECK(are_same_bits(other.angle[i][k], got.angle[same][k]));
      BOOST_CHECK(are_same_bits(other.cotangent[i][k], got.cotangent[same][k]));
    }
}

// Many triangles by themselves, so that the angle sums are their angles.
Triangulation separate_triangles(const std::vector<Sides>& all, double unit)
{
  std::vector<Index> origin(3 * all.size()), twin(origin.size(), Index(Triangulation::null_index));
  for(Index h = 0; h < origin.size(); ++h)
    origin[h] = h;
  Triangulation result(Index(origin.size()), origin, twin);
  for(Index f = 0; f < all.size(); ++f)
    for(Index k = 0; k < 3; ++k)
      result.set_length(result.edge(3 * f + k), unit * all[f][k]);
  return result;
}

// Lengths beyond the middle of the range are left to Incircle_form, which has the same bounds. (Lengths that are scaled by 1 have no error.)
BOOST_AUTO_TEST_CASE(angle_sums_of_lengths_of_any_size)
{
  std::vector<Sides> all = thin_and_right_triangles();
  all.insert(all.end(), broken_triangles.begin(), broken_triangles.end());
  for(const double unit : {1e-150, 1e-60, 1., 1e60, 1e150})
  {
    const Triangulation t = separate_triangles(all, unit);
    CEi::Conformal_energy<double> energy(t);
    BOOST_REQUIRE(energy.evaluate(std::vector<double>(t.number_of_vertices(), 0.)));
    std::size_t broken = 0;
    for(Index f = 0; f < t.number_of_faces(); ++f)
    {
      const auto exact = angles_of<Real>({{t.halfedge_length(3 * f), t.halfedge_length(3 * f + 1), t.halfedge_length(3 * f + 2)}});
      broken += exact.is_broken;
      for(Index k = 0; k < 3; ++k)
      {
        BOOST_CHECK_SMALL(double(Real(energy.angle_sums()[t.apex(3 * f + k)] - exact.angle[k])), 17 * testing::unit_roundoff);
        const double sine = exact.is_broken ? 1 : double(sin(exact.angle[k])), cotangent = double(exact.cotangent[k]);
        BOOST_CHECK_SMALL(double(Real(energy.weights()[t.edge(3 * f + k)] - exact.cotangent[k])),
                          testing::unit_roundoff * (8 / sine + 4 * std::abs(cotangent)));
      }
    }
    BOOST_CHECK_EQUAL(energy.broken_faces().size(), broken);
  }
}

typedef CEi::Wide_angle_sum<CEi::Double_double> Wide_sum;

Real argument(const CEi::Complex_number<CEi::Double_double>& z)
{
  return atan2(Real(Real(z.im.hi) + z.im.lo), Real(Real(z.re.hi) + z.re.lo));
}

// The same bits one by one and by vectors of any width; and the angle sums that they give, against 50 digits. With v = 2^-53 the bound is what
// errors of the scaled lengths of 9 v^2, and as much again in the formulas, make of the angles: a corner moves by 1 + |cot| + |cot| of the
// others at most times that; and each of the products has another 20 v^2.
BOOST_AUTO_TEST_CASE(wide_angle_sums_by_vectors)
{
  typedef CEi::Double_double Wide_number;
  std::vector<Triangulation> all = surfaces();
  for(const double unit : {1e-150, 1., 1e150})
    all.push_back(separate_triangles(thin_and_right_triangles(), unit));
  all.push_back(testing::triangulation(testing::cone(200, 1)));
  double worst = 0;
  for(const Triangulation& t : all)
    for(unsigned seed = 0; seed < 2; ++seed)
    {
      std::vector<Wide_number> s;
      for(const double u : some_u(t, seed))
        s.push_back(t.number_of_faces() > 1000 ? Wide_number(1) : exp(Wide_number(u) / 2.));
      const std::vector<Wide_sum> sums = CEi::wide_angle_sums(t, s);
      std::vector<Real> exact(t.number_of_vertices(), Real(0)), sensitivity = exact;
      for(Index f = 0; f < t.number_of_faces(); ++f)
      {
        std::array<Real, 3> l;
        for(Index k = 0; k < 3; ++k)
        {
          const Wide_number &from = s[t.origin(3 * f + k)], &to = s[t.target(3 * f + k)];
          l[k] = Real((Real(from.hi) + from.lo) * t.halfedge_length(3 * f + k) * (Real(to.hi) + to.lo));
        }
        const auto triangle = CEi::triangle_angles<Real>(l[0], l[1], l[2]);
        for(Index k = 0; k < 3; ++k)
        {
          exact[t.apex(3 * f + k)] += triangle.angle[k];
          sensitivity[t.apex(3 * f + k)] += 1 + abs(triangle.cotangent[(k + 1) % 3]) + abs(triangle.cotangent[(k + 2) % 3]);
        }
      }
      for(Index v = 0; v < t.number_of_vertices(); ++v)
      {
        const CGAL::Conformal_equivalence::Exact_angle<double> target = CGAL::Conformal_equivalence::Exact_angle<double>::pi_times(2);
        Real error = 2 * argument(sums[v].half_difference(target)) - (exact[v] - 2 * CEi::Number_constants<Real>::pi());
        const Real double_turn = 4 * CEi::Number_constants<Real>::pi();
        error -= double_turn * round(Real(error / double_turn));
        const Real unit = Real(testing::unit_roundoff) * testing::unit_roundoff;
        worst = (std::max)(worst, double(Real(abs(error) / (unit * (1 + 38 * sensitivity[v])))));
      }
#if !defined(CGAL_CONFORMAL_EQUIVALENCE_HARDWARE_FMA)
      const auto same = [&](const std::vector<Wide_sum>& other)
      {
        const CGAL::Conformal_equivalence::Exact_angle<double> zero;
        for(Index v = 0; v < t.number_of_vertices(); ++v)
        {
          const auto x = sums[v].half_difference(zero), y = other[v].half_difference(zero);
          if(!(x.re == y.re && x.im == y.im) || sums[v].missing_turns(zero, 0) != other[v].missing_turns(zero, 0))
            return false;
        }
        return true;
      };
      std::vector<Wide_number> length(t.number_of_edges());
      std::vector<Wide_sum> one_by_one(t.number_of_vertices()), by_two(one_by_one), by_four(one_by_one);
      CEi::add_wide_angles<double, Wide_number>(t, s, length, one_by_one, CEi::Concurrency());
      BOOST_CHECK(same(one_by_one));
      CEi::add_wide_angles_by<CEi::Wide_vectors<16> >(t, s, length, by_two, CEi::Concurrency());
      BOOST_CHECK(same(by_two));
      CEi::add_wide_angles_by<CEi::Wide_vectors<32> >(t, s, length, by_four, CEi::Concurrency(2));
      BOOST_CHECK(same(by_four));
#endif
    }
  BOOST_TEST_MESSAGE("wide angle sums within " << worst << " times their bound");
  BOOST_CHECK_LE(worst, 1);
}

} // namespace
