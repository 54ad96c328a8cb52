// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Rational matrices near given generators of the group of a closed surface, for which the relation holds exactly, for any genus. A pair of letters
// that interleave is split off: the relation becomes [a, b] W = 1, with a word W in the other generators, which are merely rounded. With C = W^-1
// and X = a^-1 what is left is [a, b] = C, that is b X b^-1 = X C. There is such a b iff tr(X C) = tr(X), one linear equation for X, which is met
// by the change of one entry; and then b X = X C b is linear in b: for every N,  b = X C N - N adj(X)  solves it, and N = b (2 X - tr X)^-1 would be
// the N of the b given, if that solved it, too.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_EXACT_GROUP_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_EXACT_GROUP_H

#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Exact_isometry.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Isometry.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/words.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

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
template <typename Wide>
Exact_isometry rounded_quotient_by_twist(const Isometry<Wide>& a, const Isometry<Wide>& b, int bits)
{
  using std::sqrt;
  // 2 X - tr X has the entries of X off the diagonal, twice, and no trace: in the disk it is 2 (i Im a, b), and its inverse is a multiple of itself
  const Isometry<Wide> x = a.inverse();
  const Complex_number<Wide> c{Wide(0), x.a.im}, d = x.b;
  const Wide size = sqrt(Wide(x.a.im * x.a.im + square_norm(d)));
  const Wide unit = 1 / size;
  const Isometry<Wide> n{unit * (b.a * c + b.b * conj(d)), unit * (b.a * d + b.b * conj(c))};
  return Exact_isometry::rounded(n, bits);
}

// Splits off the pair with the shortest motions a and b: by how much C is larger than 1 is what rounding is magnified by. The relation may begin
// anywhere.
inline bool split_off_best(Word& relation, Interleaved_pair& pair, const Letter_values<Isometry<Double_double> >& values)
{
  double least = std::numeric_limits<double>::infinity();
  const Word whole = relation;
  for(std::size_t n = 0; n < whole.size(); ++n)
  {
    Word rest = rotated(whole, n);
    Interleaved_pair found;
    if(!split_off_first(rest, found))
      continue;
    const double size = size_of(values(found.a()).a) * size_of(values(found.b()).a);
    if(!(size < least))
      continue;
    least = size;
    pair = std::move(found);
    relation = std::move(rest);
  }
  return least < std::numeric_limits<double>::infinity();
}

// The exact matrices; none if rounding was too coarse. `rough` are the generators, and `given` the same with as many digits as are known.
template <typename Wide>
std::vector<Exact_isometry> exact_generators(const std::vector<Isometry<Double_double> >& rough, const std::vector<Isometry<Wide> >& given,
                                             Word relation, int bits)
{
  typedef Rational_numerator Integer;
  const std::vector<Exact_isometry> none;
  const Word whole = relation;
  Letter_values<Isometry<Double_double> > rough_values(given.size(), Isometry<Double_double>::identity());
  Letter_values<Isometry<Wide> > given_values(given.size(), Isometry<Wide>::identity());
  Letter_values<Exact_isometry> values(given.size(), Exact_isometry::identity());
  for(std::size_t n = 0; n < given.size(); ++n)
  {
    rough_values.set(std::int32_t(n + 1), rough[n]);
    given_values.set(std::int32_t(n + 1), given[n]);
    values.set(std::int32_t(n + 1), Exact_isometry::rounded(given[n], bits).reduced());
  }

  Interleaved_pair pair;
  if(!split_off_best(relation, pair, rough_values))
    return none;
  // M = k C: every other letter occurs twice in W, with both signs, so that the determinant of M is a square
  Exact_isometry m = Exact_isometry::identity();
  Integer k(1);
  for(const std::int32_t letter : inverse(relation))
  {
    m = matrix_product(m, values[letter]);
    if(letter > 0)
      k = k * values[letter].determinant();
  }
  const Isometry<Wide> a = given_values(pair.a()), b = given_values(pair.b());
  const Exact_isometry x = with_equal_traces(Exact_isometry::rounded(a.inverse(), bits), m, k);
  const Exact_isometry twist = rounded_quotient_by_twist(a, b, bits);
  const Exact_isometry left = matrix_product(matrix_product(x, m), twist), right = matrix_product(twist, x.inverse());
  const Exact_isometry exact_b = Exact_isometry{Integer(left.p - k * right.p), Integer(left.q - k * right.q), Integer(left.r - k * right.r),
                                                Integer(left.s - k * right.s)}.reduced();
  pair.set(x.inverse(), exact_b, values);
  for(const Exact_isometry& g : values.generators())
    if(!(g.determinant() > 0))
      return none;
  return values(whole).is_identity() ? values.generators() : none;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_EXACT_GROUP_H
