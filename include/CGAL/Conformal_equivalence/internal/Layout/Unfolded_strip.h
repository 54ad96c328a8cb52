// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A strip of triangles of a flat metric, laid out in the plane one behind the other:
//
//             c0        .
//          B------D           The halfedge h0 runs from O, the point 0, to A in the direction 1. The strip begins with the
//         / \    / \          triangle OAB on the left of it, goes on across the side c0 = AB, to the triangle ADB, then
//        /   \  /c1 \         across c1 = AD, and so on. The corner opposite to the side by which a triangle was entered is
//       O-----A------E        its apex: B, D, E.
//         h0

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_UNFOLDED_STRIP_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_UNFOLDED_STRIP_H

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <array>
#include <cstdint>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// e^{i alpha} for the angle of the metric at the origin of the halfedge h, in its face.
template <typename NT>
Complex_number<typename Conformal_metric<NT>::Wide_number> turn_at_origin(const Conformal_metric<NT>& metric, std::uint32_t h)
{
  typedef typename Conformal_metric<NT>::Wide_number Wide;
  const Intrinsic_triangulation<NT>& t = metric.triangulation;
  return rotation(Incircle_form<Wide>(metric.wide_scaled_length(h), metric.wide_scaled_length(t.next(h)),
                                      metric.wide_scaled_length(t.previous(h))), 1);
}

template <typename NT>
class Unfolded_strip
{
  typedef std::uint32_t Index;
  typedef Conformal_metric<NT> Metric;

public:
  typedef typename Metric::Wide_number Wide;
  typedef Complex_number<Wide> Complex;

  // A side that is crossed has its target where it was laid out before, or, with `measures_sides`, where its length leads from its origin:
  // the same but for rounding, of which a layout shows the last digits where coordinates vanish.
  Unfolded_strip(const Metric& metric, Index h, bool measures_sides = false)
    : metric_(metric), t_(metric.triangulation), measures_sides_(measures_sides),
      h_(h), origin_{Wide(0), Wide(0)}, direction_{Wide(1), Wide(0)}
  {
    lay_out_apex();
  }

  // of the last triangle
  const Complex& apex() const { return apex_; }

  // Origin and target of `side`, one of the two sides of the last triangle by which it was not entered.
  std::array<Complex, 2> ends(Index side) const
  {
    if(side != t_.next(h_))
      return {{apex_, origin_}};
    return {{origin_ + metric_.wide_scaled_length(h_) * direction_, apex_}};
  }

  // Leaves the last triangle across `side`, and lays out the one behind it.
  void cross(Index side)
  {
    const std::array<Complex, 2> end = ends(side);
    if(side == t_.next(h_))
      direction_ = direction_ * conj(turn_at_origin(metric_, side));
    else
      direction_ = direction_ * turn_at_origin(metric_, h_);
    origin_ = measures_sides_ ? end[0] - metric_.wide_scaled_length(side) * direction_ : end[1];
    h_ = t_.twin(side);
    lay_out_apex();
  }

private:
  void lay_out_apex()
  {
    const Complex to_apex = direction_ * turn_at_origin(metric_, h_);
    apex_ = origin_ + metric_.wide_scaled_length(t_.previous(h_)) * to_apex;
  }

  const Metric& metric_;
  const Intrinsic_triangulation<NT>& t_;
  const bool measures_sides_;
  Index h_;                           // the side by which the last triangle was entered, which is on its left
  Complex origin_, direction_, apex_; // where h_ begins, and its direction; the third corner
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_UNFOLDED_STRIP_H
