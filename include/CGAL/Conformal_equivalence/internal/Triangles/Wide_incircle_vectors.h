// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// `Incircle_form<Double_double>` of a few triangles at once, to the same bits, unless the program is compiled for fused multiplications.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_WIDE_INCIRCLE_VECTORS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_WIDE_INCIRCLE_VECTORS_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double_vector.h>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <int bytes>
struct Wide_incircle_vectors
{
  typedef Double_double_vector<bytes> Numbers;
  typedef typename Numbers::Vector    Vector;

  Numbers tangent[3]; // from the corner opposite to each side to the inscribed circle
  Numbers s;          // half of the circumference
  Numbers square;     // of the radius of that circle

  CGAL_CONFORMAL_EQUIVALENCE_INLINE explicit Wide_incircle_vectors(const Numbers (&side)[3])
  {
    set_tangent(side[0], side[1], side[2], tangent[0]);
    set_tangent(side[1], side[2], side[0], tangent[1]);
    set_tangent(side[2], side[0], side[1], tangent[2]);
    s.set_sum(side[0], side[1]);
    s.set_sum(s, side[2]);
    s.halve();
    square.set_product(tangent[0], tangent[1]);
    square.set_product(square, tangent[2]);
    square.set_quotient(square, s);
  }

  // 1 for triangles of which these numbers can be relied on, 0 for those that need care.
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void set_plain(Vector& result) const
  {
    const Vector zero = {}, one = zero + 1.;
    const auto is_safe = (tangent[0].hi > 0.) & (tangent[1].hi > 0.) & (tangent[2].hi > 0.) & (square.hi > 1e-200) & (square.hi < 1e200);
    result = is_safe ? one : zero;
  }

  // The radii, where `plain` is not 0.
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void set_radius(const Vector& plain, Numbers& r) const
  {
    const Vector zero = {}, one = zero + 1.;
    r = square;
    r.hi = plain != zero ? r.hi : one;
    r.set_root(r);
  }

private:
  // half of b + c - a, as excess() has it
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void set_tangent(const Numbers& a, const Numbers& b, const Numbers& c, Numbers& result)
  {
    const auto is_longer = (b.hi > c.hi) | ((b.hi == c.hi) & (b.lo > c.lo));
    Numbers longer, shorter;
    longer.select(is_longer, b, c);
    shorter.select(is_longer, c, b);
    result.set_difference(longer, a);
    result.set_sum(result, shorter);
    result.halve();
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_WIDE_INCIRCLE_VECTORS_H
