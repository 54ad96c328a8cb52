// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Flips and splits of an edge that leave the surface as it is (paper, Section 3.2): the two triangles are laid side by side
// in the plane, and what is new is measured there.
//
//              k
//           b / \ a           c is the length of the edge ij; k = (x, y), l = (x', -y'), i = (0, 0), j = (c, 0):
//            /   \                                                                                      .
//           i--c--j               x = (c^2 + b^2 - a^2) / (2 c),    y = 2 area / c.
//            \   /
//           a'\ / b'          The quadrilateral is strictly convex iff its angles at i and at j are less than pi.
//              l

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_REPAIR_EDGE_CHANGES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_REPAIR_EDGE_CHANGES_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Exact_number.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>

#include <CGAL/enum.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// 16 times the squared area of the triangle with these squared sides; 0 where there is no such triangle.
inline Exact_number sixteen_squared_areas(const Exact_number& aa, const Exact_number& bb, const Exact_number& cc)
{
  const Exact_number d = aa + bb - cc, result = 4 * aa * bb - d * d;
  return result.sign() == POSITIVE ? result : Exact_number();
}

// The sign of p sqrt(x) + q sqrt(y), x, y >= 0.
inline Sign sign_of_sum(const Exact_number& p, const Exact_number& x, const Exact_number& q, const Exact_number& y)
{
  const Sign first = x.sign() == ZERO ? ZERO : p.sign(), second = y.sign() == ZERO ? ZERO : q.sign();
  if(first == second || second == ZERO)
    return first;
  if(first == ZERO)
    return second;
  return first * (p * p * x - q * q * y).sign();
}

// Is the sum of two angles less than pi, if 4 areas times their cotangents are p and q, with the areas of `x` and `y`? If both triangles have
// one, iff the cotangents have a positive sum. An angle of a degenerate triangle is 0 (p > 0) or pi.
inline bool is_less_than_pi(const Exact_number& p, const Exact_number& x, const Exact_number& q, const Exact_number& y)
{
  if(x.sign() == ZERO && y.sign() == ZERO)
    return p.sign() == POSITIVE && q.sign() == POSITIVE;
  return sign_of_sum(p, y, q, x) == POSITIVE;
}

// Is the quadrilateral made of the two faces of `e` strictly convex at i and at j? (At k and l it is in any case.) Exact on the
// lengths stored; a triangle that violates the triangle inequality counts as degenerate.
// \pre `e` is not a border edge
template <typename NT>
bool is_strictly_convex(const Intrinsic_triangulation<NT>& t, std::uint32_t e)
{
  const std::uint32_t h = t.edge_halfedge(e), g = t.twin(h);
  const auto square = [&](std::uint32_t side)
  {
    const Exact_number l = exact_number(t.halfedge_length(side));
    return l * l;
  };
  const Exact_number cc = square(h), jk = square(t.next(h)), ki = square(t.previous(h)),
                       il = square(t.next(g)), lj = square(t.previous(g));
  const Exact_number above = sixteen_squared_areas(cc, jk, ki), below = sixteen_squared_areas(cc, il, lj);
  return is_less_than_pi(cc + ki - jk, above, cc + il - lj, below)
      && is_less_than_pi(cc + jk - ki, above, cc + lj - il, below);
}

// The vertex k of a triangle with the base ij in the plane, as in the picture. Degenerate triangles, and lengths that
// violate the triangle inequality, have the height 0.
template <typename NT>
class Unfolded_apex
{
  typedef typename Wider_number<NT>::type Wide;

  int exponent_ = 0; // of the unit of length
  Wide x_, y_;

  NT rounded(const Wide& length) const
  {
    using std::ldexp;
    return ldexp(static_cast<NT>(length), exponent_);
  }

public:
  // the lengths of ij, jk and ki
  Unfolded_apex(const NT& ij, const NT& jk, const NT& ki)
  {
    using std::frexp;
    using std::ldexp;
    frexp((std::max)((std::max)(ij, jk), ki), &exponent_);
    const Wide c(ldexp(ij, -exponent_)), a(ldexp(jk, -exponent_)), b(ldexp(ki, -exponent_));
    const Incircle_form<Wide> triangle(c, a, b);
    x_ = (c * c + (b - a) * (b + a)) / (2 * c);
    y_ = 2 * triangle.r * triangle.s / c;
  }

  // x: how far the foot of the perpendicular on the base is from i, towards j
  NT foot() const { return rounded(x_); }
  // y
  NT height() const { return rounded(y_); }
  // the distance from the point (p, 0)
  NT distance(const NT& p) const
  {
    using std::ldexp;
    using std::sqrt;
    const Wide d = x_ - Wide(ldexp(p, -exponent_));
    return rounded(sqrt(Wide(d * d + y_ * y_)));
  }
};

// Is there an edge between the vertices `v` and `w`? O(degree of v).
template <typename NT>
bool are_joined(const Intrinsic_triangulation<NT>& t, std::uint32_t v, std::uint32_t w)
{
  bool result = false;
  t.for_each_outgoing(v, [&](std::uint32_t h)
  {
    result = result || t.target(h) == w || t.apex(h) == w;
  });
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_REPAIR_EDGE_CHANGES_H
