// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file compute_layout.h
/// From a flat metric to points of the plane: the triangles are laid out one after
/// the other in breadth-first order of the dual graph (section 3.3 of Springborn,
/// Schroeder and Pinkall, 2008).
///
/// The direction of an edge is the sum of the corner angles on the way to it, a
/// length is that of the metric itself: errors of one triangle are not multiplied
/// by the next. All of it runs in a wider number type and is rounded once, at the end.
///
/// Across a cut edge the layout goes on after a motion of the plane, which is part of the result.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_LAYOUT_H
#define CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_LAYOUT_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Surface_double.h>
#include <CGAL/Conformal_equivalence/internal/Layout/Flipped_development.h>
#include <CGAL/Conformal_equivalence/internal/Layout/layout_frames.h>
#include <CGAL/Conformal_equivalence/internal/Layout/period_lattice.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/pieces.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/wedges.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <queue>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

namespace internal {

// The developing map.
template <typename NT>
class Development
{
  typedef std::uint32_t Index;
  typedef Conformal_metric<NT> Metric;

public:
  typedef typename Metric::Wide_number Wide;
  typedef Complex_number<Wide> Complex;

  std::vector<Complex> position;   // by wedge
  std::vector<char> is_laid_out;   // by face

  Development(const Metric& metric, const Cut_graph& cut, const Wedges& wedges)
    : position(wedges.number_of_wedges, Complex{Wide(0), Wide(0)}),
      is_laid_out(metric.triangulation.number_of_faces(), 0),
      metric_(metric), t_(metric.triangulation), cut_(cut), wedges_(wedges),
      is_placed_(wedges.number_of_wedges, 0)
  {}

  Wide length(Index h) const { return metric_.wide_scaled_length(h); }

  // Lays out everything that is connected with `root`.
  void operator()(Index root)
  {
    std::queue<std::pair<Index, Complex> > queue; // a halfedge both ends of which are placed, and its direction

    const Index h = 3 * root;
    const Complex east = {Wide(1), Wide(0)};
    place(origin_wedge(h), Complex{Wide(0), Wide(0)});
    place(wedges_.of_corner[h], Complex{metric_.wide_scaled_length(h), Wide(0)});
    is_laid_out[root] = 1;
    queue.emplace(h, east);
    while(!queue.empty())
    {
      const Index g = queue.front().first;
      const std::array<Complex, 3> direction = lay_out_triangle(g, queue.front().second);
      queue.pop();
      Index side = g;
      for(int k = 0; k < 3; ++k, side = t_.next(side))
      {
        if(t_.is_border(side) || cut_[t_.edge(side)] || is_laid_out[t_.face(t_.twin(side))])
          continue;
        is_laid_out[t_.face(t_.twin(side))] = 1;
        queue.emplace(t_.twin(side), Complex{-direction[k].re, -direction[k].im});
      }
    }
  }

private:
  Index origin_wedge(Index h) const { return wedges_.of_corner[t_.previous(h)]; }

  void place(Index wedge, const Complex& z)
  {
    if(is_placed_[wedge])
      return;
    is_placed_[wedge] = 1;
    position[wedge] = z;
  }

  // Places the apex of the triangle of h, where h lies already, in the given
  // direction. Returns the directions of h, next(h) and previous(h).
  std::array<Complex, 3> lay_out_triangle(Index h, const Complex& direction)
  {
    const Index next = t_.next(h), previous = t_.previous(h);
    const Wide length = metric_.wide_scaled_length(previous);
    const Incircle_form<Wide> triangle(metric_.wide_scaled_length(h), metric_.wide_scaled_length(next), length);
    const Complex at_origin = rotation(triangle, 1), at_target = rotation(triangle, 2);

    const Complex to_apex = direction * at_origin;
    const Complex along_next = direction * Complex{-at_target.re, at_target.im};
    const Complex& origin = position[origin_wedge(h)];
    place(wedges_.of_corner[next], Complex{origin.re + length * to_apex.re, origin.im + length * to_apex.im});
    return {{direction, along_next, Complex{-to_apex.re, -to_apex.im}}};
  }

  const Metric& metric_;
  const Intrinsic_triangulation<NT>& t_;
  const Cut_graph& cut_;
  const Wedges& wedges_;
  std::vector<char> is_placed_;
};

// Rounds the positions and measures by how much lengths have changed, in the faces that are laid out.
template <typename NT, typename Developed>
void round_positions(const Intrinsic_triangulation<NT>& t, const Cut_graph& cut, const Wedges& wedges,
                     const Developed& development, const NT& scale, Layout<NT>& layout)
{
  using std::abs;
  using std::sqrt;
  layout.corner.resize(t.number_of_halfedges(), std::array<NT, 2>{{NT(0), NT(0)}});
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); ++h)
  {
    const auto& z = development.position[wedges.of_corner[h]];
    if(development.is_laid_out[t.face(h)])
      layout.corner[h] = {{static_cast<NT>(z.re), static_cast<NT>(z.im)}};
  }

  const auto measure = [&](std::uint32_t h, const NT& length)
  {
    const std::array<NT, 2> &p = layout.corner[t.previous(h)], &q = layout.corner[h];
    const NT x = (q[0] - p[0]) / length, y = (q[1] - p[1]) / length;
    const double error = static_cast<double>(abs(NT(sqrt(NT(x * x + y * y)) - 1)));
    layout.length_error = (std::max)(layout.length_error, std::isfinite(error) ? error : 1);
  };
  for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
  {
    const std::uint32_t h = t.edge_halfedge(e), g = t.twin(h);
    const NT length = static_cast<NT>(development.length(h)) * scale;
    if(development.is_laid_out[t.face(h)])
      measure(h, length);
    if(cut[e] && !t.is_border(h) && development.is_laid_out[t.face(g)])
      measure(g, length);
  }
}

// The motion across the cut edge of h.
template <typename NT, typename Developed>
Cut_motion<typename Developed::Wide>
find_motion(const Intrinsic_triangulation<NT>& t, const Wedges& wedges, const std::vector<std::uint32_t>& piece_of_face,
            const Developed& development, std::uint32_t h)
{
  typedef typename Developed::Wide Wide;
  typedef typename Developed::Complex Complex;
  using std::sqrt;
  const std::uint32_t g = t.twin(h);
  const auto corner = [&](std::uint32_t i) -> const Complex& { return development.position[wedges.of_corner[i]]; };
  const Complex &p = corner(t.previous(h)), &q = corner(h), &p2 = corner(g), &q2 = corner(t.previous(g));
  const double length = size_of(Complex{Wide(q.re - p.re), Wide(q.im - p.im)});
  const Complex side{Wide((q.re - p.re) / length), Wide((q.im - p.im) / length)},
                side2{Wide((q2.re - p2.re) / length), Wide((q2.im - p2.im) / length)};
  Complex r = quotient(side2, side);
  const Wide size = sqrt(Wide(r.re * r.re + r.im * r.im));
  r = {Wide(r.re / size), Wide(r.im / size)};
  const Complex moved = r * p;
  return {piece_of_face[t.face(h)], piece_of_face[t.face(g)], r,
          Complex{Wide(p2.re - moved.re), Wide(p2.im - moved.im)}, length};
}

// The motions across the cut edges between faces that are laid out, and the lattices of the flat tori.
template <typename NT, typename Developed>
void find_transitions(const Intrinsic_triangulation<NT>& t, const Cut_graph& cut, const Wedges& wedges,
                      const Developed& development, Layout<NT>& layout)
{
  typedef Cut_motion<typename Developed::Wide> Motion;
  const auto rounded = [](const auto& z) { return std::array<NT, 2>{{static_cast<NT>(z.re), static_cast<NT>(z.im)}}; };
  std::uint32_t number_of_pieces = 0;
  const std::vector<std::uint32_t> piece_of_face = pieces_of_faces(t, cut, number_of_pieces);
  const Surface_components surface = connected_components(t);
  std::vector<std::vector<Motion> > motions_of_torus(surface.components.size());

  for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
  {
    const std::uint32_t h = t.edge_halfedge(e), c = surface.component_of_vertex[t.origin(h)];
    if(!cut[e] || t.is_border(h) || !development.is_laid_out[t.face(h)] || !development.is_laid_out[t.face(t.twin(h))])
      continue;
    const Motion motion = find_motion(t, wedges, piece_of_face, development, h);
    layout.transitions.push_back({h, rounded(motion.rotation), rounded(motion.translation)});
    if(surface.components[c].is_torus())
      motions_of_torus[c].push_back(motion);
  }
  for(std::size_t c = 0; c < motions_of_torus.size(); ++c)
  {
    const std::uint32_t first = surface.components[c].first_face;
    const auto basis = period_basis(std::move(motions_of_torus[c]), piece_of_face[first], number_of_pieces);
    if(!basis.is_complete())
      continue;
    const auto periods = basis.standard_basis();
    layout.lattices.push_back({first, {{rounded(periods.first), rounded(periods.second)}},
                               rounded(quotient(periods.second, periods.first))});
  }
}

// Lays out the given pieces only.
template <typename NT, typename Developed, typename Frame>
Layout<NT> lay_out_pieces(const Intrinsic_triangulation<NT>& input, const Cut_graph& cut, const Wedges& wedges,
                          const std::vector<Piece>& pieces, const Frame& frame, Developed development)
{
  Layout<NT> layout;
  for(const Piece& piece : pieces)
    development(piece.central_face);
  const NT scale = move_to_frame(input, wedges.of_corner, pieces, frame, development.position);
  round_positions(input, cut, wedges, development, scale, layout);
  if(!cut.is_cut.empty())
    find_transitions(input, cut, wedges, development, layout);
  return layout;
}

template <typename NT, typename Frame>
Layout<NT> lay_out_pieces(const Intrinsic_triangulation<NT>& input, const Conformal_metric<NT>& metric, const Cut_graph& cut,
                          const Wedges& wedges, const std::vector<Piece>& pieces, const Frame& frame)
{
  if(!metric.is_retriangulated())
    return lay_out_pieces(input, cut, wedges, pieces, frame, Development<NT>(metric, cut, wedges));
  Flipped_development<NT> development(input, metric, cut, wedges);
  std::vector<NT> lengths;
  lengths.reserve(input.number_of_edges());
  for(std::uint32_t e = 0; e < input.number_of_edges(); ++e)
    lengths.push_back(static_cast<NT>(development.length(input.edge_halfedge(e))));
  Layout<NT> layout = lay_out_pieces(input, cut, wedges, pieces, frame, std::move(development));
  layout.straight_lengths = std::move(lengths);
  return layout;
}

template <typename NT, typename Frame, typename Is_wanted>
Layout<NT> lay_out_whole(const Intrinsic_triangulation<NT>& input, const Conformal_metric<NT>& metric, const Cut_graph& cut,
                         const Frame& frame, Is_wanted is_wanted)
{
  const Wedges wedges = find_wedges(input, cut);
  std::vector<Piece> pieces = find_pieces(input, cut, wedges);
  pieces.erase(std::remove_if(pieces.begin(), pieces.end(), [&](const Piece& piece) { return !is_wanted(piece); }), pieces.end());
  return lay_out_pieces(input, metric, cut, wedges, pieces, frame);
}

// Lays out the pieces for which is_wanted(piece). Of a metric of the double, cut along the border, only those of the surface itself.
template <typename NT, typename Frame, typename Is_wanted>
Layout<NT> lay_out(const Intrinsic_triangulation<NT>& input, const Conformal_metric<NT>& metric, const Cut_graph& cut,
                   const Frame& frame, Is_wanted is_wanted)
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

} // namespace internal

/// \ingroup PkgConformalEquivalenceLayout
///
/// lays out the flat surface of `metric`, cut along `cut`, in the plane: a point for every corner of the triangulation that was given to the
/// solver, whether it has been flipped or not. After flips the edges of that triangulation are no straight lines in the
/// flat surface; `Layout::length_error` then is about the straight lines between their ends. Linear time, and the
/// number of crossings of the two triangulations; the work runs in `Conformal_metric::Wide_number`. The surface may have any number of components, and the cuts may leave it in any number of
/// pieces: they are put beside one another and do not overlap each other (one by itself may).
///
/// \param input the triangulation that was given to the solver
/// \param metric what the solver returned; its angle sums should be 2 pi at every vertex that is not
///        on the border or a cut
/// \param cut what it leaves need not be disks, but around whatever is not cut open the layout must close
///        (`Layout::length_error` shows if it does not)
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{layout_frame}
///     \cgalParamDescription{how the layout is placed in the plane}
///     \cgalParamType{`Layout_frame`, or `Pinned_frame<std::uint32_t>`}
///     \cgalParamDefault{`Layout_frame::CANONICAL`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the layout, with the motions across the cuts and the lattices of flat tori. Its status is `EMPTY_MESH` if there is no face.
/// \pre `metric` is a success; its triangulation is `input`, or was made from it by `Conformal_metric::flips`.
template <typename NT, typename NamedParameters = parameters::Default_named_parameters>
Layout<NT> compute_layout(const Intrinsic_triangulation<NT>& input,
                          const Conformal_metric<NT>& metric,
                          const Cut_graph& cut,
                          const NamedParameters& np = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  CGAL_precondition(bool(metric));
  CGAL_precondition(metric.triangulation.number_of_halfedges() == (metric.is_doubled ? 2 : 1) * input.number_of_halfedges());
  if(input.number_of_faces() == 0)
  {
    Layout<NT> nothing;
    nothing.status = Status::EMPTY_MESH;
    return nothing;
  }
  const auto frame = choose_parameter(get_parameter(np, internal_np::conformal_layout_frame), Layout_frame::CANONICAL);
  const auto all = [](const internal::Piece&) { return true; };
  return internal::lay_out(input, metric, cut, frame, all);
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_LAYOUT_H
