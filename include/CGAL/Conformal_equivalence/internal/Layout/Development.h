// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The developing map of a flat metric: the triangles are laid out in the plane, one after the other in breadth-first order of the dual graph
// (section 3.3 of Springborn, Schroeder and Pinkall, 2008).
//
// The direction of an edge is the sum of the corner angles on the way to it, a
// length is that of the metric itself: errors of one triangle are not multiplied
// by the next. All of it runs in a wider number type and is rounded once, at the end.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_DEVELOPMENT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_DEVELOPMENT_H

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/internal/Layout/Development_steps.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/wedges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename NT>
class Development
{
  typedef std::uint32_t Index;
  typedef Conformal_metric<NT> Metric;

public:
  typedef typename Metric::Wide_number Wide;
  typedef Complex_number<Wide> Complex;

  std::vector<char> is_laid_out;   // by face

  Development(const Metric& metric, const Cut_graph& cut, const Wedges& wedges)
    : is_laid_out(metric.triangulation.number_of_faces(), 0),
      t_(metric.triangulation), cut_(cut), wedges_(wedges),
      is_placed_(wedges.number_of_wedges, 0)
  {
    front_.length = wide_lengths(t_, metric.scale_factors);
    front_.position.assign(wedges.number_of_wedges, Complex{Wide(0), Wide(0)});
  }

  const Wide& length(Index h) const { return front_.length[t_.edge(h)]; }

  // By wedge.
  const std::vector<Complex>& positions() const { return front_.position; }
  std::vector<Complex> take_positions() { return std::move(front_.position); }

  // Lays out everything that is connected with `root`.
  void operator()(Index root)
  {
    const Index h = t_.halfedge(root);
    const Complex zero = {Wide(0), Wide(0)}, east = {Wide(1), Wide(0)};
    place(origin_wedge(h), zero);
    place(wedges_.of_corner[h], Complex{length(h), Wide(0)});
    is_laid_out[root] = 1;
    front_.sides.assign(1, {h, east});
    front_.next_sides.clear();
    if(goes_on_beyond(h))
      front_.next_sides.push_back({t_.twin(h), -east});
    while(!front_.sides.empty())
    {
      find_steps();
      lay_out_steps(front_);
      front_.sides.swap(front_.next_sides);
      front_.next_sides.clear();
    }
  }

private:
  Index origin_wedge(Index h) const { return wedges_.of_corner[t_.previous(h)]; }

  void place(Index wedge, const Complex& z)
  {
    if(claim(wedge))
      front_.position[wedge] = z;
  }

  // Is the wedge still to be placed? From now on it counts as placed.
  bool claim(Index wedge) { return !std::exchange(is_placed_[wedge], char(1)); }

  // What the triangles of this front are wanted for. Nothing is computed that is not needed: every second apex has been placed before, and many
  // triangles have none beyond.
  void find_steps()
  {
    front_.steps.clear();
    for(Index i = 0; i < front_.sides.size(); ++i)
    {
      const Index h = front_.sides[i].halfedge, next = t_.next(h), previous = t_.previous(h), apex = wedges_.of_corner[next];
      const Index beyond_next = enter_beyond(next), beyond_previous = enter_beyond(previous);
      const bool is_new = claim(apex);
      if(is_new || beyond_next != none || beyond_previous != none)
        front_.steps.push_back({{t_.edge(h), t_.edge(next), t_.edge(previous)}, i, origin_wedge(h), is_new ? apex : none,
                                beyond_next, beyond_previous});
    }
  }

  // Adds what is beyond the side h to the next front, if that is still to be laid out, and returns its number there.
  Index enter_beyond(Index h)
  {
    if(!goes_on_beyond(h))
      return none;
    front_.next_sides.push_back({t_.twin(h), Complex()});
    return Index(front_.next_sides.size() - 1);
  }

  // Is the triangle beyond the side h still to be laid out? From now on it counts as laid out.
  bool goes_on_beyond(Index h)
  {
    if(t_.is_border(h) || cut_[t_.edge(h)])
      return false;
    return !std::exchange(is_laid_out[t_.face(t_.twin(h))], char(1));
  }

  static constexpr Index none = Development_step::none;

  const Intrinsic_triangulation<NT>& t_;
  const Cut_graph& cut_;
  const Wedges& wedges_;
  std::vector<char> is_placed_;
  Development_front<Wide> front_;
};

// What a development has found, whether edges were flipped or not.
template <typename NT>
struct Developed_surface
{
  typedef typename Conformal_metric<NT>::Wide_number Wide;
  typedef Complex_number<Wide> Complex;

  std::vector<Complex> position; // by wedge of the input
  std::vector<char> is_laid_out; // by face of the input
  std::vector<NT> length;        // by edge of the input, of the straight line that it becomes
};

// Develops what is connected with `roots`, faces of the surface `t`. \pre `development` is one of `t`, at its beginning
template <typename NT, typename Development>
Developed_surface<NT> develop(const Intrinsic_triangulation<NT>& t, const std::vector<std::uint32_t>& roots, Development development)
{
  for(std::uint32_t root : roots)
    development(root);
  Developed_surface<NT> result;
  result.length.reserve(t.number_of_edges());
  for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
    result.length.push_back(static_cast<NT>(development.length(t.edge_halfedge(e))));
  result.position = development.take_positions();
  result.is_laid_out = std::move(development.is_laid_out);
  return result;
}

// Rounds the positions and measures by how much lengths have changed, in the faces that are laid out.
template <typename NT>
void round_positions(const Intrinsic_triangulation<NT>& t, const Cut_graph& cut, const Wedges& wedges,
                     const Developed_surface<NT>& development, const NT& scale, Layout<NT>& layout)
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
    const NT length = development.length[e] * scale;
    if(development.is_laid_out[t.face(h)])
      measure(h, length);
    if(cut[e] && !t.is_border(h) && development.is_laid_out[t.face(g)])
      measure(g, length);
  }
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_DEVELOPMENT_H
