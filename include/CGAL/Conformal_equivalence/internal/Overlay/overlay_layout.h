// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_OVERLAY_LAYOUT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_OVERLAY_LAYOUT_H

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Layout/lay_out_pieces.h>
#include <CGAL/Conformal_equivalence/internal/Layout/layout_frames.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Geodesic_strip.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/pieces.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/wedges.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// What the surface given is in the triangulation of the metric: all of it, or half of the double.
struct Surface_size
{
  std::uint32_t vertices, edges, faces;
};

// Where the vertices of the input, and the crossings on its edges, lie in the plane, not yet rounded: as in `compute_layout()`.
template <typename NT>
class Overlay_layout
{
  typedef std::uint32_t Index;
  typedef Conformal_metric<NT> Metric;

public:
  typedef typename Metric::Wide_number Wide;
  typedef Complex_number<Wide> Complex;
  typedef Overlay_crossing<Wide> Crossing;

  // `input` is what the metric was made of by flips: the surface given, or its double.
  // Linear in its size and the number of crossings; what is kept is linear in its size.
  Overlay_layout(const Intrinsic_triangulation<NT>& input, const Metric& metric, const Cut_graph& cut, const Surface_size& size,
                 const Any_frame& frame)
    : input_(&input), wedges_(find_wedges(input, cut))
  {
    std::vector<Piece> pieces = find_pieces(input, cut, wedges_);
    pieces.erase(std::remove_if(pieces.begin(), pieces.end(), [&](const Piece& p) { return p.faces.front() >= size.faces; }),
                 pieces.end());
    position_ = develop_pieces(input, metric, cut, wedges_, pieces).position;
    move_to_frame(input, wedges_.of_corner, pieces, frame, position_);
  }

  // Where the input halfedge `h` begins, and ends, in its face.
  const Complex& origin(Index h) const { return position_[wedges_.of_corner[input_->previous(h)]]; }
  const Complex& target(Index h) const { return position_[wedges_.of_corner[h]]; }

  // Where the crossing lies in the input face on the left of `side`, one of the two halfedges of its edge.
  Complex place(const Crossing& x, Index side) const
  {
    const bool is_first = side == input_->edge_halfedge(x.input_edge);
    const Complex &p = is_first ? origin(side) : target(side), &q = is_first ? target(side) : origin(side);
    return p + x.ratio * (q - p);
  }

private:
  const Intrinsic_triangulation<NT>* input_;
  Wedges wedges_;
  std::vector<Complex> position_; // by wedge
};

// Rounded.
template <typename NT, typename Wide>
std::array<NT, 2> plane_point(const Complex_number<Wide>& z) { return {{static_cast<NT>(z.re), static_cast<NT>(z.im)}}; }

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_OVERLAY_LAYOUT_H
