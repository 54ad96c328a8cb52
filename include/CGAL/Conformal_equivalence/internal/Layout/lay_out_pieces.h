// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The pieces that the cuts leave of a surface, laid out one by one and put beside one another: whether the triangulation was flipped or not,
// and whether the metric is one of the surface given or of its double.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_LAY_OUT_PIECES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_LAY_OUT_PIECES_H

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/internal/Layout/Development.h>
#include <CGAL/Conformal_equivalence/internal/Layout/Flipped_development.h>
#include <CGAL/Conformal_equivalence/internal/Layout/cut_motions.h>
#include <CGAL/Conformal_equivalence/internal/Layout/layout_frames.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Surface_double.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/pieces.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/wedges.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Which pieces are to be laid out.
typedef std::function<bool(const Piece&)> Is_wanted;

// The given pieces, developed one by one.
template <typename NT>
Developed_surface<NT> develop_pieces(const Intrinsic_triangulation<NT>& input, const Conformal_metric<NT>& metric, const Cut_graph& cut,
                                     const Wedges& wedges, const std::vector<Piece>& pieces)
{
  std::vector<std::uint32_t> roots;
  for(const Piece& piece : pieces)
    roots.push_back(piece.central_face);
  if(metric.is_retriangulated())
    return develop(input, roots, Flipped_development<NT>(input, metric, cut, wedges));
  return develop(input, roots, Development<NT>(metric, cut, wedges));
}

// Lays out the given pieces only.
template <typename NT>
Layout<NT> lay_out_pieces(const Intrinsic_triangulation<NT>& input, const Conformal_metric<NT>& metric, const Cut_graph& cut,
                          const Wedges& wedges, const std::vector<Piece>& pieces, const Any_frame& frame)
{
  Developed_surface<NT> development = develop_pieces(input, metric, cut, wedges, pieces);
  Layout<NT> layout;
  const NT scale = move_to_frame(input, wedges.of_corner, pieces, frame, development.position);
  round_positions(input, cut, wedges, development, scale, layout);
  if(!cut.is_cut.empty())
    find_transitions(input, cut, wedges, development, layout);
  if(metric.is_retriangulated())
    layout.straight_lengths = std::move(development.length);
  return layout;
}

template <typename NT>
Layout<NT> lay_out_whole(const Intrinsic_triangulation<NT>& input, const Conformal_metric<NT>& metric, const Cut_graph& cut,
                         const Any_frame& frame, const Is_wanted& is_wanted)
{
  const Wedges wedges = find_wedges(input, cut);
  std::vector<Piece> pieces = find_pieces(input, cut, wedges);
  pieces.erase(std::remove_if(pieces.begin(), pieces.end(), [&](const Piece& piece) { return !is_wanted(piece); }), pieces.end());
  return lay_out_pieces(input, metric, cut, wedges, pieces, frame);
}

// Lays out the pieces for which is_wanted(piece). Of a metric of the double, cut along the border, only those of the surface itself.
template <typename NT>
Layout<NT> lay_out(const Intrinsic_triangulation<NT>& input, const Conformal_metric<NT>& metric, const Cut_graph& cut,
                   const Any_frame& frame, const Is_wanted& is_wanted)
{
  if(!metric.is_doubled)
    return lay_out_whole(input, metric, cut, frame, is_wanted);
  const Surface_double<NT> twofold(input);
  Layout<NT> layout = lay_out_whole(twofold.triangulation, metric, twofold.cut(input, cut), frame, [&](const Piece& piece)
    { return piece.faces.front() < input.number_of_faces() && is_wanted(piece); });
  layout.corner.resize(input.number_of_halfedges());
  layout.straight_lengths.resize(input.number_of_edges());
  return layout;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template Layout<double> lay_out(const Intrinsic_triangulation<double>&, const Conformal_metric<double>&, const Cut_graph&,
                                       const Any_frame&, const Is_wanted&);
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_LAY_OUT_PIECES_H
