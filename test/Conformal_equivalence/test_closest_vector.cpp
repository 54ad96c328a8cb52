// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Closest lattice vectors: reduced bases, exact transformations, and all that is near, against brute force and lattices
// that are known.

#define BOOST_TEST_MODULE test_closest_vector
#include "include/boost_test.h"
#include "include/tolerances.h"

#include <CGAL/Conformal_equivalence/internal/Lattices/closest_vector.h>

#include <Eigen/LU>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
using testing::few_roundings;

namespace {

// Relative, of square lengths: 2^-53 times the condition number of the Gram matrices, which is up to 10^4.
constexpr double rounded_square = 1e4 * testing::unit_roundoff;

typedef CE::internal::Reduced_lattice     Reduced_lattice;
typedef CE::internal::Lattice_reduction   Lattice_reduction;
typedef CE::internal::Lattice_vector      Lattice_vector;
typedef boost::multiprecision::cpp_int    Integer;
typedef boost::multiprecision::cpp_bin_float_100 Real;
typedef std::vector<std::int64_t>         Integer_vector;
typedef std::vector<Integer_vector>       Integer_matrix; // by rows
typedef std::mt19937                      Random;

double uniform(Random& random, double a, double b) { return a + (b - a) * (double(random()) / 4294967296.); }
int uniform_integer(Random& random, int a, int b) { return a + int(random() % std::uint32_t(b - a + 1)); }

Eigen::VectorXd random_target(int d, Random& random, double size = 20)
{
  Eigen::VectorXd x(d);
  for(int i = 0; i < d; ++i)
    x[i] = uniform(random, -size, size);
  return x;
}

// A random rotation of a diagonal matrix, the entries of which go from 1 to 1 / condition.
Eigen::MatrixXd random_gram(int d, double condition, Random& random)
{
  Eigen::MatrixXd a(d, d);
  for(int i = 0; i < d; ++i)
    for(int j = 0; j < d; ++j)
      a(i, j) = uniform(random, -1, 1) + uniform(random, -1, 1) + uniform(random, -1, 1);
  const Eigen::MatrixXd q = Eigen::HouseholderQR<Eigen::MatrixXd>(a).householderQ();
  Eigen::VectorXd values(d);
  for(int i = 0; i < d; ++i)
    values[i] = d == 1 ? 1 : std::pow(condition, -double(i) / (d - 1));
  const Eigen::MatrixXd g = q * values.asDiagonal() * q.transpose();
  return (g + g.transpose()) / 2;
}

// That of the rows (1, 0, ..., 0, a_1), (0, 1, ..., 0, a_2), ...: exact integers.
Eigen::MatrixXd knapsack_gram(int d, int bits, Random& random)
{
  Eigen::VectorXd a(d);
  for(int i = 0; i < d; ++i)
    a[i] = std::floor(uniform(random, 1, std::ldexp(1., bits)));
  return Eigen::MatrixXd::Identity(d, d) + a * a.transpose();
}

// An integer matrix of determinant 1, and its inverse.
std::pair<Eigen::MatrixXd, Eigen::MatrixXd> random_unimodular(int d, int number_of_steps, Random& random)
{
  Eigen::MatrixXd t = Eigen::MatrixXd::Identity(d, d), inverse = t;
  for(int step = 0; step < number_of_steps; ++step)
  {
    const int i = uniform_integer(random, 0, d - 1), j = uniform_integer(random, 0, d - 1), q = uniform_integer(random, -2, 2);
    if(i == j)
      continue;
    t.col(i) += q * t.col(j);
    inverse.row(j) -= q * inverse.row(i);
  }
  return std::make_pair(t, inverse);
}

// A positive definite matrix of small integers.
Eigen::MatrixXd random_integer_gram(int d, Random& random)
{
  Eigen::MatrixXd a(d, d);
  for(int i = 0; i < d; ++i)
    for(int j = 0; j < d; ++j)
      a(i, j) = uniform_integer(random, -5, 5);
  return a.transpose() * a + Eigen::MatrixXd::Identity(d, d);
}

// Bareiss' algorithm, without fractions.
Integer determinant(std::vector<std::vector<Integer> > a)
{
  const std::size_t d = a.size();
  Integer previous = 1;
  int sign = 1;
  for(std::size_t k = 0; k + 1 < d; ++k)
  {
    std::size_t pivot = k;
    while(pivot < d && a[pivot][k] == 0)
      ++pivot;
    if(pivot == d)
      return 0;
    if(pivot != k)
    {
      std::swap(a[pivot], a[k]);
      sign = -sign;
    }
    for(std::size_t i = k + 1; i < d; ++i)
      for(std::size_t j = k + 1; j < d; ++j)
        a[i][j] = (a[i][j] * a[k][k] - a[i][k] * a[k][j]) / previous;
    previous = a[k][k];
  }
  return sign * a[d - 1][d - 1];
}

// The transformation has determinant 1 or -1, and its inverse is its inverse.
void check_unimodular(const Lattice_reduction& basis)
{
  const std::size_t d = basis.dimension();
  std::vector<std::vector<Integer> > u(d);
  for(std::size_t k = 0; k < d; ++k)
    u[k].assign(basis[k].coefficients.begin(), basis[k].coefficients.end());
  const Integer det = determinant(u);
  BOOST_TEST((det == 1 || det == -1));
  bool is_inverse = true;
  for(std::size_t i = 0; i < d; ++i)
    for(std::size_t j = 0; j < d; ++j)
    {
      Integer sum = 0;
      for(std::size_t l = 0; l < d; ++l)
        sum += Integer(basis[i].dual[l]) * u[j][l];
      is_inverse = is_inverse && sum == (i == j ? 1 : 0);
    }
  BOOST_TEST(is_inverse);
}

struct Reduction_measure
{
  double largest_mu = 0;
  double least_lovasz = 2; // the least |b_k less components along b_0 .. b_{i-1}|^2 / |b*_i|^2, for i = k - 1
  double least_deep = 2;   // for all i < k
};

// The Gram-Schmidt process with 100 digits, on the exact Gram matrix of the vectors with these coefficients.
Reduction_measure measure(const Eigen::MatrixXd& gram, const Integer_matrix& vectors)
{
  const std::size_t d = vectors.size();
  std::vector<std::vector<Real> > image(d, std::vector<Real>(d)), mu = image, r = image;
  for(std::size_t k = 0; k < d; ++k)
    for(std::size_t i = 0; i < d; ++i)
      for(std::size_t j = 0; j < d; ++j)
        image[k][i] += Real(vectors[k][j]) * Real(gram(Eigen::Index(i), Eigen::Index(j)));
  Reduction_measure result;
  for(std::size_t k = 0; k < d; ++k)
  {
    for(std::size_t j = 0; j <= k; ++j)
    {
      Real sum = 0;
      for(std::size_t i = 0; i < d; ++i)
        sum += Real(vectors[j][i]) * image[k][i];
      for(std::size_t l = 0; l < j; ++l)
        sum -= mu[j][l] * r[k][l];
      r[k][j] = sum;
      if(j < k)
      {
        mu[k][j] = sum / r[j][j];
        result.largest_mu = (std::max)(result.largest_mu, std::abs(static_cast<double>(mu[k][j])));
      }
    }
    Real rest = r[k][k];
    for(std::size_t i = k; i-- > 0; )
    {
      rest += mu[k][i] * r[k][i];
      const double quotient = static_cast<double>(Real(rest / r[i][i]));
      result.least_deep = (std::min)(result.least_deep, quotient);
      if(i + 1 == k)
        result.least_lovasz = (std::min)(result.least_lovasz, quotient);
    }
  }
  return result;
}

Integer_matrix unit_vectors(std::size_t d)
{
  Integer_matrix result(d, Integer_vector(d, 0));
  for(std::size_t k = 0; k < d; ++k)
    result[k][k] = 1;
  return result;
}

void check_reduced(const Eigen::MatrixXd& gram)
{
  const Reduced_lattice lattice(gram);
  BOOST_TEST_REQUIRE(lattice.is_valid());
  check_unimodular(lattice.basis());
  Integer_matrix vectors;
  for(std::size_t k = 0; k < lattice.dimension(); ++k)
    vectors.push_back(lattice.basis()[k].coefficients);
  const Reduction_measure after = measure(gram, vectors);
  const double rounding = 1e-8; // of the coefficients, by a condition number of the Gram matrix of up to 10^8
  BOOST_TEST(after.largest_mu <= .5 + rounding);
  BOOST_TEST(after.least_lovasz >= .99 - rounding);
  BOOST_TEST(after.least_deep >= .99 - rounding);
  const Reduction_measure before = measure(gram, unit_vectors(lattice.dimension()));
  BOOST_TEST((before.largest_mu > .5 + rounding || before.least_lovasz < .99 - rounding)); // there was something to do
}

long double square_distance(const Eigen::MatrixXd& gram, const std::vector<long>& k, const Eigen::VectorXd& x)
{
  long double result = 0;
  for(int i = 0; i < x.size(); ++i)
  {
    long double sum = 0;
    for(int j = 0; j < x.size(); ++j)
      sum += (long double)(gram(i, j)) * ((long double)(k[std::size_t(j)]) - (long double)(x[j]));
    result += sum * ((long double)(k[std::size_t(i)]) - (long double)(x[i]));
  }
  return result;
}

// All square distances at most `bound`, in ascending order, of all points in the box in which they must be: |k_i - x_i|^2 is at
// most bound * (G^-1)_ii.
std::vector<double> brute_force(const Eigen::MatrixXd& gram, const Eigen::VectorXd& x, double bound)
{
  const int d = int(x.size());
  const Eigen::MatrixXd inverse = gram.inverse();
  std::vector<long> low, high;
  double volume = 1;
  for(int i = 0; i < d; ++i)
  {
    const double size = std::sqrt(bound * inverse(i, i)) * (1 + 1e-6);
    low.push_back(long(std::ceil(x[i] - size)));
    high.push_back(long(std::floor(x[i] + size)));
    volume *= double(high.back() - low.back() + 1);
  }
  BOOST_TEST_REQUIRE(volume < 3e6);
  std::vector<double> result;
  for(std::vector<long> k = low; ; )
  {
    const double distance = double(square_distance(gram, k, x));
    if(distance <= bound)
      result.push_back(distance);
    int i = 0;
    while(i < d && k[std::size_t(i)] == high[std::size_t(i)])
    {
      k[std::size_t(i)] = low[std::size_t(i)];
      ++i;
    }
    if(i == d)
      break;
    ++k[std::size_t(i)];
  }
  std::sort(result.begin(), result.end());
  return result;
}

bool is_close(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance * (std::max)(std::abs(a), std::abs(b)); }

} // namespace

BOOST_AUTO_TEST_CASE(reduced_bases)
{
  Random random(1);
  for(int d : {2, 3, 5, 10, 20})
    for(double condition : {1e2, 1e5, 1e8})
      check_reduced(random_gram(d, condition, random));
  for(int d : {4, 8, 16})
    for(int bits : {10, 20})
      check_reduced(knapsack_gram(d, bits, random));
}

BOOST_AUTO_TEST_CASE(reduced_basis_of_an_integer_relation)
{
  // rows (1, 0, 0, C), (0, 1, 0, C phi), (0, 0, 1, C phi^2), with 1 + phi - phi^2 = 0: the shortest vector is (1, 1, -1)
  const double phi = (1 + std::sqrt(5.)) / 2, c = 1e5;
  const Eigen::Vector3d a(c, std::round(c * phi), std::round(c * phi) + c);
  const Reduced_lattice lattice(Eigen::MatrixXd::Identity(3, 3) + a * a.transpose());
  Integer_vector v = lattice.basis()[0].coefficients;
  if(v[0] < 0)
    for(std::int64_t& x : v)
      x = -x;
  BOOST_TEST((v == Integer_vector{1, 1, -1}));
}

BOOST_AUTO_TEST_CASE(closest_against_brute_force)
{
  Random random(2);
  int number_improved = 0, number_of_cases = 0;
  for(int d = 2; d <= 5; ++d)
    for(double condition : {1., 30., 1e3, 1e6})
    {
      if(d == 5 && condition > 1e3)
        condition = 1e4;
      for(int i = 0; i < (d < 5 ? 40 : 10); ++i)
      {
        const Eigen::MatrixXd gram = random_gram(d, condition, random);
        const Eigen::VectorXd x = random_target(d, random);
        const Reduced_lattice lattice(gram);
        BOOST_TEST_REQUIRE(lattice.is_valid());
        const Lattice_vector v = lattice.closest(x, 100000), b = lattice.babai(x);
        BOOST_TEST(v.is_closest);
        BOOST_TEST(v.square_distance <= b.square_distance);
        if(b.is_closest)
          BOOST_TEST((v.coefficients == b.coefficients));
        const std::vector<double> all = brute_force(gram, x, v.square_distance * (1 + 1e-9));
        BOOST_TEST_REQUIRE(!all.empty());
        BOOST_TEST(is_close(v.square_distance, all.front(), rounded_square));
        const std::vector<long> k(v.coefficients.begin(), v.coefficients.end());
        BOOST_TEST(is_close(v.square_distance, double(square_distance(gram, k, x)), rounded_square));
        number_improved += v.square_distance < b.square_distance;
        ++number_of_cases;
      }
    }
  BOOST_TEST(number_improved > number_of_cases / 50); // Babai's point is not always the closest
}

BOOST_AUTO_TEST_CASE(near_against_brute_force)
{
  Random random(3);
  for(int d = 1; d <= 4; ++d)
    for(double condition : {1., 100., 1e4})
      for(std::size_t most : {1, 2, 7, 40})
      {
        const Eigen::MatrixXd gram = random_gram(d, condition, random);
        const Eigen::VectorXd x = random_target(d, random);
        const Reduced_lattice lattice(gram);
        const std::vector<Lattice_vector> list = lattice.nearest_vectors(x, most, 1000000);
        BOOST_TEST_REQUIRE(list.size() == most);
        const std::vector<double> all = brute_force(gram, x, list.back().square_distance * (1 + 1e-9));
        BOOST_TEST_REQUIRE(all.size() >= most);
        for(std::size_t i = 0; i < most; ++i)
        {
          BOOST_TEST(list[i].is_closest);
          BOOST_TEST(is_close(list[i].square_distance, all[i], rounded_square));
          BOOST_TEST((i == 0 || CE::internal::is_nearer(list[i - 1], list[i]))); // strictly: no point twice
        }
        BOOST_TEST((list.front().coefficients == lattice.closest(x, 1000000).coefficients));
      }
}

BOOST_AUTO_TEST_CASE(the_basis_does_not_matter)
{
  // All numbers are exact: the problem is the same, and so are the answers.
  Random random(4);
  for(int d : {2, 3, 5, 8, 12})
    for(int i = 0; i < 5; ++i)
    {
      const Eigen::MatrixXd gram = random_integer_gram(d, random);
      const std::pair<Eigen::MatrixXd, Eigen::MatrixXd> t = random_unimodular(d, 5 * d, random);
      Eigen::VectorXd x(d);
      for(int j = 0; j < d; ++j)
        x[j] = std::ldexp(double(uniform_integer(random, -20000000, 20000000)), -20);
      const Eigen::MatrixXd changed_gram = t.first.transpose() * gram * t.first;
      BOOST_TEST_REQUIRE(changed_gram.cwiseAbs().maxCoeff() < 9e15);
      const Lattice_vector v = Reduced_lattice(gram).closest(x, 1000000),
                           w = Reduced_lattice(changed_gram).closest(t.second * x, 1000000);
      BOOST_TEST_REQUIRE((v.is_closest && w.is_closest));
      BOOST_TEST(v.square_distance == w.square_distance);
      for(int j = 0; j < d; ++j)
      {
        double sum = 0;
        for(int l = 0; l < d; ++l)
          sum += t.first(j, l) * double(w.coefficients[std::size_t(l)]);
        BOOST_TEST(sum == double(v.coefficients[std::size_t(j)]));
      }
    }
}

BOOST_AUTO_TEST_CASE(integer_lattice)
{
  Random random(5);
  for(int d : {1, 2, 10, 60})
  {
    const Eigen::VectorXd x = random_target(d, random, 1e6);
    const std::pair<Eigen::MatrixXd, Eigen::MatrixXd> t = random_unimodular(d, 3 * d, random);
    const Reduced_lattice plain(Eigen::MatrixXd::Identity(d, d)), hidden(t.first.transpose() * t.first);
    for(const Lattice_vector& v : {plain.babai(x), plain.closest(x, 1000)})
    {
      BOOST_TEST(v.is_closest);
      for(int i = 0; i < d; ++i)
        BOOST_TEST(double(v.coefficients[std::size_t(i)]) == std::round(x[i]));
      BOOST_TEST(is_close(v.square_distance, (x - x.array().round().matrix()).squaredNorm(), rounded_square));
    }
    const Lattice_vector w = hidden.closest(t.second * x, 1000);
    BOOST_TEST(w.is_closest);
    for(int i = 0; i < d; ++i)
    {
      double sum = 0;
      for(int j = 0; j < d; ++j)
        sum += t.first(i, j) * double(w.coefficients[std::size_t(j)]);
      BOOST_TEST(sum == std::round(x[i]));
    }
  }
}

BOOST_AUTO_TEST_CASE(hexagonal_lattice)
{
  Eigen::MatrixXd gram(2, 2);
  gram << 2, -1, -1, 2;
  const Reduced_lattice lattice(gram);
  // the origin, six vectors of square length 2, six of 6
  const std::vector<Lattice_vector> shells = lattice.nearest_vectors(Eigen::VectorXd::Zero(2), 14, 100000);
  BOOST_TEST_REQUIRE(shells.size() == 14u);
  for(std::size_t i = 0; i < shells.size(); ++i)
    BOOST_TEST(shells[i].square_distance == (i == 0 ? 0 : i < 7 ? 2 : i < 13 ? 6 : 8));
  BOOST_TEST((shells[1].coefficients == Integer_vector{-1, -1})); // ties: by coefficients
  BOOST_TEST((shells[6].coefficients == Integer_vector{1, 1}));
  // the deep holes, at a distance of sqrt(2/3) from three points
  Eigen::VectorXd hole(2);
  hole << 2. / 3, 1. / 3;
  const std::vector<Lattice_vector> corners = lattice.nearest_vectors(hole, 4, 100000);
  for(std::size_t i = 0; i < 3; ++i)
    BOOST_TEST(is_close(corners[i].square_distance, 2. / 3, few_roundings));
  BOOST_TEST(is_close(corners[3].square_distance, 8. / 3, few_roundings));
}

BOOST_AUTO_TEST_CASE(lattice_E8)
{
  Eigen::MatrixXd gram = 2 * Eigen::MatrixXd::Identity(8, 8); // the Cartan matrix
  for(const std::pair<int, int>& edge : {std::make_pair(0, 1), std::make_pair(1, 2), std::make_pair(2, 3), std::make_pair(3, 4),
                                         std::make_pair(4, 5), std::make_pair(5, 6), std::make_pair(4, 7)})
    gram(edge.first, edge.second) = gram(edge.second, edge.first) = -1;
  BOOST_TEST(is_close(gram.determinant(), 1, 100 * few_roundings));
  const Reduced_lattice lattice(gram);
  // the origin, 240 vectors of square length 2, then those of 4
  const std::vector<Lattice_vector> shells = lattice.nearest_vectors(Eigen::VectorXd::Zero(8), 243, 1000000);
  BOOST_TEST_REQUIRE(shells.size() == 243u);
  for(std::size_t i = 0; i < shells.size(); ++i)
    BOOST_TEST(shells[i].square_distance == (i == 0 ? 0 : i < 241 ? 2 : 4));
  BOOST_TEST(shells.front().is_closest);
  // the deep holes are the halves of vectors of square length 4: 16 points at a distance of 1
  Eigen::VectorXd hole(8);
  for(int i = 0; i < 8; ++i)
    hole[i] = double(shells.back().coefficients[std::size_t(i)]) / 2;
  const std::vector<Lattice_vector> corners = lattice.nearest_vectors(hole, 17, 1000000);
  BOOST_TEST_REQUIRE(corners.size() == 17u);
  for(std::size_t i = 0; i < 17; ++i)
    BOOST_TEST(corners[i].square_distance == (i < 16 ? 1 : 2));
  // nowhere else is it farther to the lattice
  Random random(6);
  for(int i = 0; i < 100; ++i)
  {
    const Lattice_vector v = lattice.closest(random_target(8, random), 100000);
    BOOST_TEST(v.is_closest);
    BOOST_TEST(v.square_distance <= 1);
  }
}

BOOST_AUTO_TEST_CASE(bound_of_Babai)
{
  Random random(7);
  int number_improved = 0;
  for(int d : {4, 8, 16, 24})
    for(double condition : {1e2, 1e4, 1e6})
      for(int i = 0; i < 5; ++i)
      {
        const Reduced_lattice lattice(random_gram(d, condition, random));
        const Eigen::VectorXd x = random_target(d, random);
        const Lattice_vector b = lattice.babai(x), v = lattice.closest(x, 1000000);
        double box = 0; // half of the b*_i
        for(std::size_t k = 0; k < lattice.dimension(); ++k)
          box += lattice.square_length(k) / 4;
        BOOST_TEST(b.square_distance <= box * (1 + rounded_square));
        BOOST_TEST(v.is_closest);
        BOOST_TEST(v.square_distance <= b.square_distance);
        BOOST_TEST(b.square_distance <= std::pow(2., d) * v.square_distance);
        number_improved += v.square_distance < b.square_distance;
      }
  BOOST_TEST(number_improved > 5);
}

BOOST_AUTO_TEST_CASE(close_targets_are_proven_without_search)
{
  Random random(8);
  for(int d : {10, 56})
  {
    const Reduced_lattice lattice(random_gram(d, 1e6, random));
    double shortest = std::numeric_limits<double>::infinity();
    for(std::size_t k = 0; k < lattice.dimension(); ++k)
      shortest = (std::min)(shortest, lattice.square_length(k));
    const Eigen::VectorXd point = random_target(d, random, 1000).array().round(), noise = random_target(d, random, 1);
    for(double size : {0., 0.4, 30.}) // of the noise, in units of the shortest |b*_i|; its Euclidean norm bounds the distance
    {
      const Eigen::VectorXd x = point + noise * (size * std::sqrt(shortest) / noise.norm());
      const Lattice_vector b = lattice.babai(x), v = lattice.closest(x, 1000);
      BOOST_TEST(b.is_closest == (4 * b.square_distance < shortest));
      if(size < .5)
        for(int i = 0; i < d; ++i)
        {
          BOOST_TEST(double(b.coefficients[std::size_t(i)]) == point[i]);
          BOOST_TEST(v.coefficients[std::size_t(i)] == b.coefficients[std::size_t(i)]);
          BOOST_TEST((b.is_closest && v.is_closest));
        }
    }
  }
}

BOOST_AUTO_TEST_CASE(too_few_nodes)
{
  Random random(9);
  const Reduced_lattice lattice(random_gram(40, 1e4, random));
  for(int i = 0; i < 3; ++i)
  {
    const Eigen::VectorXd x = random_target(40, random);
    const Lattice_vector b = lattice.babai(x);
    BOOST_TEST_REQUIRE(!b.is_closest);
    double last = b.square_distance;
    for(std::size_t most_nodes : {0, 1, 39, 100, 3000, 100000})
    {
      const Lattice_vector v = lattice.closest(x, most_nodes);
      BOOST_TEST(!v.is_closest);
      BOOST_TEST(v.number_of_nodes <= most_nodes);
      BOOST_TEST(v.square_distance <= last);
      last = v.square_distance;
      for(const Lattice_vector& w : lattice.nearest_vectors(x, 5, most_nodes))
        BOOST_TEST(!w.is_closest);
    }
    BOOST_TEST((lattice.closest(x, 0).coefficients == b.coefficients));
  }
}

BOOST_AUTO_TEST_CASE(many_dimensions)
{
  Random random(10);
  const int d = 200;
  const Reduced_lattice lattice(random_gram(d, 1e4, random));
  BOOST_TEST_REQUIRE(lattice.is_valid());
  const Eigen::VectorXd x = random_target(d, random);
  const Lattice_vector b = lattice.babai(x);
  BOOST_TEST_REQUIRE(b.coefficients.size() == std::size_t(d));
  double box = 0;
  for(std::size_t k = 0; k < lattice.dimension(); ++k)
    box += lattice.square_length(k) / 4;
  BOOST_TEST(b.square_distance <= box * (1 + rounded_square));
  BOOST_TEST(!b.is_closest);
}

BOOST_AUTO_TEST_CASE(scale_does_not_matter)
{
  Random random(11);
  const Eigen::MatrixXd gram = random_gram(6, 1e3, random);
  const Eigen::VectorXd x = random_target(6, random);
  const Lattice_vector v = Reduced_lattice(gram).closest(x, 100000);
  for(int e : {-900, -500, 500, 1000})
  {
    const Eigen::MatrixXd scaled_gram = gram.unaryExpr([e](double g) { return std::ldexp(g, e); });
    const Lattice_vector w = Reduced_lattice(scaled_gram).closest(x, 100000);
    BOOST_TEST(w.is_closest);
    BOOST_TEST((w.coefficients == v.coefficients));
    BOOST_TEST(w.square_distance == std::ldexp(v.square_distance, e));
  }
  Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(3, 3);
  wide.diagonal() << 1e200, 1, 1e-200;
  Eigen::VectorXd y(3);
  y << .25, 7.75, -3.5;
  const Lattice_vector w = Reduced_lattice(wide).closest(y, 1000);
  BOOST_TEST((w.is_closest && w.coefficients[0] == 0 && w.coefficients[1] == 8 && std::abs(double(w.coefficients[2]) + 3.5) == .5));
  BOOST_TEST(is_close(w.square_distance, 1e200 / 16, few_roundings));
  wide.diagonal() << 1e-300, 1e300, 1; // squares would leave the range of double
  BOOST_TEST(!Reduced_lattice(wide).is_valid());
}

BOOST_AUTO_TEST_CASE(degenerate_sizes)
{
  const Reduced_lattice point(Eigen::MatrixXd(0, 0));
  BOOST_TEST(point.is_valid());
  BOOST_TEST(point.dimension() == 0u);
  BOOST_TEST(point.closest(Eigen::VectorXd(0), 10).is_closest);
  BOOST_TEST(point.closest(Eigen::VectorXd(0), 10).square_distance == 0);
  BOOST_TEST(point.nearest_vectors(Eigen::VectorXd(0), 3, 10).size() == 1u);

  const Reduced_lattice line(Eigen::MatrixXd::Constant(1, 1, 4));
  const std::vector<Lattice_vector> list = line.nearest_vectors(Eigen::VectorXd::Constant(1, 2.25), 4, 100);
  BOOST_TEST_REQUIRE(list.size() == 4u);
  const std::int64_t expected[] = {2, 3, 1, 4};
  for(std::size_t i = 0; i < 4; ++i)
    BOOST_TEST(list[i].coefficients[0] == expected[i]);
  BOOST_TEST(list[0].square_distance == 0.25);
  BOOST_TEST(list[3].square_distance == 12.25);
  BOOST_TEST(line.nearest_vectors(Eigen::VectorXd::Constant(1, 2.25), 0, 100).empty());
}

BOOST_AUTO_TEST_CASE(bad_input)
{
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  Eigen::MatrixXd good(2, 2);
  good << 2, 1, 1, 3;
  BOOST_TEST(Reduced_lattice(good).is_valid());

  std::vector<Eigen::MatrixXd> bad;
  for(double x : {nan, infinity, -infinity})
  {
    bad.push_back(good);
    bad.back()(1, 1) = x;
    bad.push_back(good);
    bad.back()(0, 1) = bad.back()(1, 0) = x;
  }
  bad.push_back(Eigen::MatrixXd::Zero(2, 2));
  bad.push_back(-good);
  bad.push_back(good);
  bad.back() << 1, 2, 2, 1; // indefinite
  bad.push_back(good);
  bad.back() << 1, 1, 1, 1; // singular
  bad.push_back(good);
  bad.back() << 0, 0, 0, 1;
  bad.push_back(good);
  bad.back() << 2, 1, 1.5, 2; // not symmetric
  bad.push_back(Eigen::MatrixXd::Ones(2, 3));
  Random random(12);
  const Eigen::MatrixXd thin = Eigen::MatrixXd::NullaryExpr(6, 4, [&] { return uniform(random, -1, 1); });
  bad.push_back(thin * thin.transpose()); // singular but for rounding
  for(const Eigen::MatrixXd& gram : bad)
  {
    const Reduced_lattice lattice(gram);
    BOOST_TEST(!lattice.is_valid());
    const Eigen::VectorXd x = Eigen::VectorXd::Constant(gram.rows(), .3);
    BOOST_TEST(lattice.babai(x).coefficients.empty());
    BOOST_TEST(!lattice.closest(x, 100).is_closest);
    BOOST_TEST(lattice.nearest_vectors(x, 3, 100).empty());
  }

  const Reduced_lattice lattice(good);
  for(const Eigen::VectorXd& x : {Eigen::VectorXd(Eigen::Vector2d(nan, 0)), Eigen::VectorXd(Eigen::Vector2d(0, infinity)),
                                  Eigen::VectorXd(Eigen::Vector2d(1e17, 0)), Eigen::VectorXd(Eigen::Vector3d(0, 0, 0))})
  {
    const Lattice_vector v = lattice.closest(x, 100);
    BOOST_TEST((v.coefficients.empty() && !v.is_closest && v.square_distance == infinity));
    BOOST_TEST(lattice.nearest_vectors(x, 3, 100).empty());
  }
  BOOST_TEST(lattice.closest(Eigen::Vector2d(4e15, -4e15), 100).is_closest);
}

BOOST_AUTO_TEST_CASE(integers_do_not_overflow)
{
  const std::int64_t large = std::int64_t(1) << 60;
  Integer_vector a = {1, large, 5};
  BOOST_TEST(!CE::internal::add_multiple(a, 4, Integer_vector{1, large, 1}));
  BOOST_TEST((a == Integer_vector{1, large, 5})); // left alone
  BOOST_TEST(!CE::internal::add_multiple(a, large, Integer_vector{0, 0, 7}));
  BOOST_TEST(CE::internal::add_multiple(a, -2, Integer_vector{3, large / 2, 1}));
  BOOST_TEST((a == Integer_vector{-5, 0, 3}));
}
