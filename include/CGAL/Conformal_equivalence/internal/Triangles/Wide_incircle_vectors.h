// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// `Incircle_form<Double_double>` of a few triangles at once, to the same bits, unless the program is compiled for fused multiplications.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_WIDE_INCIRCLE_VECTORS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_WIDE_INCIRCLE_VECTORS_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double_vector.h>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// What is known of triangles, flat or hyperbolic (with hyperbolic sines in the place of lengths).
template <int bytes>
struct Wide_incircle_results
{
  typedef Double_double_vector<bytes> Numbers;
  typedef typename Numbers::Vector    Vector;

  Numbers tangent[3]; // from the corner opposite to each side to the inscribed circle
  Numbers s;          // half of the circumference
  Numbers square;     // of the radius of that circle

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

protected:
  // by `tangent` and `s`
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void set_square()
  {
    square.set_product(tangent[0], tangent[1]);
    square.set_product(square, tangent[2]);
    square.set_quotient(square, s);
  }

  // b + c - a, as excess() has it
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void set_excess(const Numbers& a, const Numbers& b, const Numbers& c, Numbers& result)
  {
    const auto is_longer = (b.hi > c.hi) | ((b.hi == c.hi) & (b.lo > c.lo));
    Numbers longer, shorter;
    longer.select(is_longer, b, c);
    shorter.select(is_longer, c, b);
    result.set_difference(longer, a);
    result.set_sum(result, shorter);
  }
};

template <int bytes>
struct Wide_incircle_vectors : public Wide_incircle_results<bytes>
{
  typedef Wide_incircle_results<bytes> Base;
  using typename Base::Numbers;
  using Base::s;
  using Base::tangent;

  CGAL_CONFORMAL_EQUIVALENCE_INLINE explicit Wide_incircle_vectors(const Numbers (&side)[3])
  {
    for(int k = 0; k < 3; ++k)
    {
      Base::set_excess(side[k], side[(k + 1) % 3], side[(k + 2) % 3], tangent[k]);
      tangent[k].halve();
    }
    s.set_sum(side[0], side[1]);
    s.set_sum(s, side[2]);
    s.halve();
    Base::set_square();
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGLES_WIDE_INCIRCLE_VECTORS_H
