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

#ifndef CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_LAYOUT_H
#define CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_LAYOUT_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/internal/layout_frames.h>
#include <CGAL/Conformal_equivalence/internal/wedges.h>
#include <CGAL/Conformal_equivalence/internal/wide_residual.h>
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

// The face that is farthest from all borders and cuts, in steps of the dual graph:
// from there no other is far.
template <typename NT>
std::uint32_t most_central_face(const Intrinsic_triangulation<NT>& t, const Cut_graph& cut)
{
  typedef std::uint32_t Index;
  std::vector<char> seen(t.number_of_faces(), 0);
  std::vector<Index> queue;
  queue.reserve(t.number_of_faces());
  const auto enter = [&](Index f) { if(!seen[f]) { seen[f] = 1; queue.push_back(f); } };
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
    if(t.is_border(h) || cut[t.edge(h)])
      enter(t.face(h));
  if(queue.empty())
    enter(0);
  for(std::size_t i = 0; i < queue.size(); ++i)
    for(Index h = 3 * queue[i]; h < 3 * queue[i] + 3; ++h)
      if(!t.is_border(h))
        enter(t.face(t.twin(h)));
  return queue.back();
}

// The developing map.
template <typename NT>
class Development
{
  typedef std::uint32_t Index;
  typedef Conformal_metric<NT> Metric;

public:
  typedef typename Metric::Wide_number Wide;
  typedef Complex_number<Wide> Complex;

  std::vector<Complex> position; // by wedge

  Development(const Metric& metric, const Cut_graph& cut, const Wedges& wedges)
    : position(wedges.number_of_wedges, Complex{Wide(0), Wide(0)}),
      metric_(metric), t_(metric.triangulation), cut_(cut), wedges_(wedges),
      is_placed_(wedges.number_of_wedges, 0)
  {}

  // Lays out everything that is connected with `root`; returns the number of faces.
  std::size_t operator()(Index root)
  {
    std::vector<char> is_reached(t_.number_of_faces(), 0);
    std::queue<std::pair<Index, Complex> > queue; // a halfedge both ends of which are placed, and its direction
    std::size_t count = 1;

    const Index h = 3 * root;
    const Complex east = {Wide(1), Wide(0)};
    place(origin_wedge(h), Complex{Wide(0), Wide(0)});
    place(wedges_.of_corner[h], Complex{metric_.wide_scaled_length(h), Wide(0)});
    is_reached[root] = 1;
    queue.emplace(h, east);
    while(!queue.empty())
    {
      const Index g = queue.front().first;
      const std::array<Complex, 3> direction = lay_out_triangle(g, queue.front().second);
      queue.pop();
      Index side = g;
      for(int k = 0; k < 3; ++k, side = t_.next(side))
      {
        if(t_.is_border(side) || cut_[t_.edge(side)] || is_reached[t_.face(t_.twin(side))])
          continue;
        is_reached[t_.face(t_.twin(side))] = 1;
        ++count;
        queue.emplace(t_.twin(side), Complex{-direction[k].re, -direction[k].im});
      }
    }
    return count;
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

// Rounds the positions and measures by how much lengths have changed.
template <typename NT, typename Complex>
void round_positions(const Conformal_metric<NT>& metric, const Cut_graph& cut, const Wedges& wedges,
                     const std::vector<Complex>& position, const NT& scale, Layout<NT>& layout)
{
  using std::abs;
  using std::sqrt;
  const Intrinsic_triangulation<NT>& t = metric.triangulation;
  layout.corner.resize(t.number_of_halfedges());
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); ++h)
  {
    const Complex& z = position[wedges.of_corner[h]];
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
    const std::uint32_t h = t.edge_halfedge(e);
    const NT length = metric.scaled_length(h) * scale;
    measure(h, length);
    if(cut[e] && !t.is_border(h))
      measure(t.twin(h), length);
  }
}

// The motions across the cut edges.
template <typename NT>
void find_transitions(const Intrinsic_triangulation<NT>& t, const Cut_graph& cut, Layout<NT>& layout)
{
  typedef Complex_number<NT> Complex;
  using std::sqrt;
  const auto corner = [&](std::uint32_t h) { return Complex{layout.corner[h][0], layout.corner[h][1]}; };
  for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
  {
    const std::uint32_t h = t.edge_halfedge(e), g = t.twin(h);
    if(!cut[e] || t.is_border(h))
      continue;
    const Complex p = corner(t.previous(h)), q = corner(h), p2 = corner(g), q2 = corner(t.previous(g));
    Complex r = Complex{q2.re - p2.re, q2.im - p2.im} * Complex{q.re - p.re, -(q.im - p.im)};
    const NT size = sqrt(NT(r.re * r.re + r.im * r.im));
    r = {r.re / size, r.im / size};
    const Complex moved = r * p;
    layout.transitions.push_back({h, {{r.re, r.im}}, {{p2.re - moved.re, p2.im - moved.im}}});
  }
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceLayout
///
/// lays out the flat surface of `metric`, cut along `cut`, in the plane. Linear time;
/// the work runs in `Conformal_metric::Wide_number`.
///
/// \param input the triangulation that was given to the solver
/// \param metric what the solver returned; its angle sums should be 2 pi at every vertex that is not
///        on the border or a cut
/// \param cut leaves the faces connected; what is cut open need not be a disk, but around whatever
///        is not cut open the layout must close (`Layout::length_error` shows if it does not)
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
/// \return the layout. Its status is `WRONG_TOPOLOGY` if the faces are not connected or there are none.
/// \pre `metric` is a success, with the triangulation `input`.
template <typename NT, typename NamedParameters = parameters::Default_named_parameters>
Layout<NT> compute_layout(const Intrinsic_triangulation<NT>& input,
                          const Conformal_metric<NT>& metric,
                          const Cut_graph& cut,
                          const NamedParameters& np = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  CGAL_precondition(bool(metric));
  CGAL_precondition(input.number_of_halfedges() == metric.triangulation.number_of_halfedges());
  CGAL_USE(input);

  Layout<NT> layout;
  const Intrinsic_triangulation<NT>& t = metric.triangulation;
  if(t.number_of_faces() == 0)
  {
    layout.status = Status::WRONG_TOPOLOGY;
    return layout;
  }
  const internal::Wedges wedges = internal::find_wedges(t, cut);
  internal::Development<NT> development(metric, cut, wedges);
  if(development(internal::most_central_face(t, cut)) != t.number_of_faces())
  {
    layout.status = Status::WRONG_TOPOLOGY;
    return layout;
  }
  const NT scale = internal::move_to_frame(
    t, wedges.of_corner, choose_parameter(get_parameter(np, internal_np::conformal_layout_frame), Layout_frame::CANONICAL),
    development.position);
  internal::round_positions(metric, cut, wedges, development.position, scale, layout);
  internal::find_transitions(t, cut, layout);
  return layout;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_LAYOUT_H
