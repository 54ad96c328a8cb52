// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Rational matrices near given ones of which the product of commutators [A_1, B_1] ... [A_g, B_g] is exactly 1, for any genus. All but the last
// pair are merely rounded. With C the inverse of the product of their commutators, X = A_g^-1 and B = B_g, what is left is [A_g, B_g] = C, that
// is B X B^-1 = X C. There is such a B iff tr(X C) = tr(X), one linear equation for X, which is met by the change of one entry; and then B X = X C B is linear in
// B: for every N,  B = X C N - N adj(X)  solves it, and N = B_g (2 X - tr X)^-1 would be the N of the B_g given, if that solved it, too.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_EXACT_GROUP_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_EXACT_GROUP_H

#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Exact_isometry.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Isometry.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

inline Exact_isometry product_of_commutators(const std::vector<Exact_isometry>& generators)
{
  Exact_isometry result = Exact_isometry::identity();
  for(std::size_t n = 0; n + 1 < generators.size(); n += 2)
  {
    const Exact_isometry &a = generators[n], &b = generators[n + 1];
    result = result * (a * b * a.inverse() * b.inverse());
  }
  return result;
}

// Changes the entry of X that matters most such that tr(X M) = k tr(X), and scales X.
inline Exact_isometry with_equal_traces(const Exact_isometry& x, const Exact_isometry& m, const Rational_numerator& k)
{
  typedef Rational_numerator Integer;
  const std::array<Integer, 4> c = {{Integer(m.p - k), m.r, m.q, Integer(m.s - k)}};
  std::array<Integer, 4> entry = {{x.p, x.q, x.r, x.s}};
  std::size_t most = 0;
  for(std::size_t n = 1; n < 4; ++n)
    if(CGAL::abs(c[n]) > CGAL::abs(c[most]))
      most = n;
  Integer others(0);
  for(std::size_t n = 0; n < 4; ++n)
    if(n != most)
      others += c[n] * entry[n];
  for(std::size_t n = 0; n < 4; ++n)
    entry[n] = n == most ? Integer(-others) : Integer(c[most] * entry[n]);
  return Exact_isometry{entry[0], entry[1], entry[2], entry[3]}.reduced();
}

// B (2 X - tr X)^-1 for the matrices of B and X = A^-1, up to a positive or negative factor, rounded.
inline Exact_isometry rounded_quotient_by_twist(const Isometry<Double_double>& a, const Isometry<Double_double>& b, int bits)
{
  typedef Double_double Wide;
  // 2 X - tr X has the entries of X off the diagonal, twice, and no trace: in the disk it is 2 (i Im a, b), and its inverse is a multiple of itself
  const Isometry<Wide> x = a.inverse();
  const Complex_number<Wide> c{Wide(0), x.a.im}, d = x.b;
  Wide size = sqrt(Wide(x.a.im * x.a.im + square_norm(d)));
  const Wide unit = 1 / size;
  const Isometry<Wide> n{unit * (b.a * c + b.b * conj(d)), unit * (b.a * d + b.b * conj(c))};
  return Exact_isometry::rounded(n, bits);
}

// The exact matrices; none if rounding was too coarse.
inline std::vector<Exact_isometry> exact_generators(const std::vector<Isometry<Double_double> >& given, int bits)
{
  typedef Rational_numerator Integer;
  std::vector<Exact_isometry> result;
  const std::size_t n = given.size();
  if(n < 4)
    return result;
  for(std::size_t i = 0; i + 2 < n; ++i)
    result.push_back(Exact_isometry::rounded(given[i], bits).reduced());

  // M = k C, for the inverse C of the product of the commutators, whose determinant is 1
  Exact_isometry m = Exact_isometry::identity();
  Integer k(1);
  for(std::size_t i = n - 2; i > 0; i -= 2)
  {
    const Exact_isometry &a = result[i - 2], &b = result[i - 1];
    m = matrix_product(m, matrix_product(matrix_product(b, a), matrix_product(b.inverse(), a.inverse())));
    k = k * a.determinant() * b.determinant();
  }
  const Exact_isometry x = with_equal_traces(Exact_isometry::rounded(given[n - 2].inverse(), bits), m, k);
  const Exact_isometry twist = rounded_quotient_by_twist(given[n - 2], given[n - 1], bits);
  const Exact_isometry left = matrix_product(matrix_product(x, m), twist), right = matrix_product(twist, x.inverse());
  result.push_back(x.inverse());
  result.push_back(Exact_isometry{Integer(left.p - k * right.p), Integer(left.q - k * right.q), Integer(left.r - k * right.r),
                                  Integer(left.s - k * right.s)}.reduced());
  for(const Exact_isometry& g : result)
    if(!(g.determinant() > 0))
      return std::vector<Exact_isometry>();
  return product_of_commutators(result).is_identity() ? result : std::vector<Exact_isometry>();
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_EXACT_GROUP_H
