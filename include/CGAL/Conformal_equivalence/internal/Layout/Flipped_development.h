// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The developing map of a metric whose triangulation was flipped, for the corners of
// the triangulation that was given. An edge of the latter crosses some triangles of
// the former; laid out one behind the other (Unfolded_strip.h), they tell where the edge leads: its vector
// is measured in the frame of the halfedge of the flipped triangulation with which the strip begins, which has the direction 1.
// The angle between two such vectors at a vertex is the sum of the angles of the triangles
// between their frames.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_FLIPPED_DEVELOPMENT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_FLIPPED_DEVELOPMENT_H

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Layout/Unfolded_strip.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/normal_coordinates.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/wedges.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename NT>
class Flipped_development
{
  typedef std::uint32_t Index;
  typedef Conformal_metric<NT> Metric;

public:
  typedef typename Metric::Wide_number Wide;
  typedef Complex_number<Wide> Complex;

  std::vector<Complex> position;   // by wedge of the input
  std::vector<char> is_laid_out;   // by face of the input

  Flipped_development(const Intrinsic_triangulation<NT>& input, const Metric& metric, const Cut_graph& cut, const Wedges& wedges)
    : position(wedges.number_of_wedges, Complex{Wide(0), Wide(0)}),
      is_laid_out(input.number_of_faces(), 0),
      input_(input), metric_(metric), t_(metric.triangulation), cut_(cut), wedges_(wedges),
      is_placed_(wedges.number_of_wedges, 0)
  {
    const Normal_coordinates record = replay_flips(input, metric.flips);
    vectors_.reserve(input.number_of_halfedges());
    const std::vector<Normal_coordinates::Start> starts = record.starts(t_);
    for(Index h = 0; h < input.number_of_halfedges(); ++h)
      vectors_.push_back({unfold(record.path(t_, starts[h])), starts[h].first, starts[h].position});
  }

  std::vector<Complex> take_positions() { return std::move(position); }

  // the length of the straight line that the input halfedge becomes
  Wide length(Index h) const { return size(vectors_[h].to_target); }

  // Lays out everything that is connected with `root`, a face of the input.
  void operator()(Index root)
  {
    std::queue<std::pair<Index, Complex> > queue; // a halfedge, the origin of which is placed, and the frame of its face
    const Index first = input_.halfedge(root);
    place(origin_wedge(first), Complex{Wide(0), Wide(0)});
    queue.emplace(first, unit(conj(vectors_[first].to_target)));
    is_laid_out[root] = 1;
    for(; !queue.empty(); queue.pop())
    {
      const Index h = queue.front().first;
      const Complex frame = queue.front().second;
      const std::array<Complex, 3> corner = triangle(h); // origin, target and apex, in the frame of the halfedge h
      const Complex origin = position[origin_wedge(h)];
      Index side = h;
      for(int k = 0; k < 3; ++k, side = input_.next(side))
      {
        const Complex& p = corner[k];
        const Complex& q = corner[(k + 1) % 3];
        place(wedges_.of_corner[side], origin + frame * q);
        if(input_.is_border(side) || cut_[input_.edge(side)] || is_laid_out[input_.face(input_.twin(side))])
          continue;
        const Index g = input_.twin(side);
        is_laid_out[input_.face(g)] = 1;
        // g runs from q to p; its own vector has this direction
        const Complex back = frame * unit(p - q), own = unit(vectors_[g].to_target);
        queue.emplace(g, unit(back * conj(own)));
      }
    }
  }

private:
  struct Vector
  {
    Complex to_target;
    Index first;        // the halfedge of the flipped triangulation that has the direction 1
    std::uint32_t rank; // among those with the same `first`
  };

  Index origin_wedge(Index h) const { return wedges_.of_corner[input_.previous(h)]; }

  void place(Index wedge, const Complex& z)
  {
    if(is_placed_[wedge])
      return;
    is_placed_[wedge] = 1;
    position[wedge] = z;
  }

  static Wide size(const Complex& z)
  {
    using std::sqrt;
    const double largest = (std::max)(std::abs(static_cast<double>(z.re)), std::abs(static_cast<double>(z.im)));
    if(!(largest > 0))
      return Wide(0);
    const Wide x = z.re / largest, y = z.im / largest; // without over- or underflow
    return sqrt(Wide(x * x + y * y)) * largest;
  }

  static Complex unit(const Complex& z)
  {
    const Wide length = size(z);
    return {Wide(z.re / length), Wide(z.im / length)};
  }

  // The vector from the origin of a path to its target, in the frame of its first halfedge.
  Complex unfold(const Normal_coordinates::Path& path) const
  {
    if(path.is_edge)
      return {metric_.wide_scaled_length(path.first), Wide(0)};
    Unfolded_strip<NT> strip(metric_, path.first, true);
    for(Index c : path.crossed)
      strip.cross(c);
    return strip.apex();
  }

  // Origin, target and apex of the input halfedge h, in its frame.
  std::array<Complex, 3> triangle(Index h) const
  {
    const Vector& along = vectors_[h];
    const Complex zero{Wide(0), Wide(0)};
    const Index back = input_.previous(h);
    Complex turn{Wide(1), Wide(0)};
    if(input_.is_border(back))
    {
      // to the border, where the flipped triangulation has the same edge
      Index g = along.first;
      for(Index next = t_.next_around_origin(g); ; next = t_.next_around_origin(g))
      {
        turn = turn * turn_at_origin(metric_, g);
        if(next == t_.null_index)
          break;
        g = next;
      }
      const Wide l = metric_.wide_scaled_length(t_.previous(g));
      return {{zero, along.to_target, Complex{l * turn.re, l * turn.im}}};
    }
    const Vector& other = vectors_[input_.twin(back)];
    if(along.first != other.first || along.rank >= other.rank)
    {
      Index g = along.first;
      do
      {
        turn = turn * turn_at_origin(metric_, g);
        g = t_.next_around_origin(g);
      }
      while(g != other.first);
    }
    return {{zero, along.to_target, turn * other.to_target}};
  }

  const Intrinsic_triangulation<NT>& input_;
  const Metric& metric_;
  const Intrinsic_triangulation<NT>& t_;
  const Cut_graph& cut_;
  const Wedges& wedges_;
  std::vector<Vector> vectors_; // by halfedge of the input
  std::vector<char> is_placed_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_FLIPPED_DEVELOPMENT_H
