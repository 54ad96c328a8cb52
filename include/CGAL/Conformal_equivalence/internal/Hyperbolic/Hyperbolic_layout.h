// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A closed hyperbolic surface in the hyperbolic plane: lifts of its vertices, and the deck transformations that are its group.
//
// Of every vertex the chosen lift (see Loop_system.h) has a frame: the isometry that takes the center to the lift, and the direction to the right to
// that of the first halfedge of the vertex. From the frame of i that of j follows along a halfedge: a turn, a translation, a turn; with
// half angles and sinh(l/2) all of that is algebraic. Along the tree of shortest paths this defines the frames; along any other halfedge what
// comes out is the frame of j, moved by the deck transformation of its label.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_LAYOUT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_LAYOUT_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Hyperbolic_energy.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Isometry.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Loop_system.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/hyperbolic_triangle.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/words.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Complex_number.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_angle_sums.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// By halfedge: e^{i alpha / 2} for the angle alpha of its face at its origin, at the factors s = e^{u/2}.
template <typename NT, typename Wide>
std::vector<Complex_number<Wide> > half_corners(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s)
{
  using std::sqrt;
  std::vector<Complex_number<Wide> > result(t.number_of_halfedges());
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
  {
    const Hyperbolic_incircle_form<Wide> triangle = scaled_sides(t, s, f).triangle();
    for(std::uint32_t k = 0; k < 3; ++k)
    {
      const Complex_number<Wide> z{triangle.tangent[(k + 1) % 3], triangle.r};
      const Wide size = sqrt(square_norm(z));
      result[3 * f + k] = {z.re / size, z.im / size};
    }
  }
  return result;
}

template <typename NT, typename Wide>
class Hyperbolic_layout
{
public:
  typedef std::uint32_t Index;
  typedef Isometry<Wide> Motion;
  typedef Complex_number<Wide> Complex;

  std::vector<Motion> frame;      // by vertex
  std::vector<Motion> generator;  // of the loops

  // The metric with the factors s = e^{u/2}, to which references are kept. \pre the surface is closed and connected
  Hyperbolic_layout(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s, const Loop_system& loops)
    : t_(t), s_(s), half_turn_(t.number_of_halfedges()), frame_(t.number_of_vertices(), Motion::identity())
  {
    find_directions();
    for(const Index h : loops.tree)
      frame_[t_.target(h)] = frame_[t_.origin(h)] * along(h);
    for(const Index e : loops.generator_edge)
    {
      const Index h = t_.edge_halfedge(e);
      generator.push_back(frame_[t_.origin(h)] * along(h) * frame_[t_.target(h)].inverse());
    }
    frame.swap(frame_);
  }

private:
  // The halves of the angles from the first halfedge of a vertex to the others, counterclockwise.
  void find_directions()
  {
    const std::vector<Complex> half_corner = half_corners(t_, s_);
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
    {
      Complex turn{Wide(1), Wide(0)};
      t_.for_each_outgoing(v, [&](Index h)
      {
        half_turn_[h] = turn;
        turn = turn * half_corner[h];
      });
    }
  }

  // From the frame of the origin of h to that of its target.
  Motion along(Index h) const
  {
    const Wide x = wide_length(t_, s_, h);
    const Complex back = half_turn_[t_.twin(h)] * Complex{Wide(0), Wide(1)}; // by pi more than the direction of the twin
    return Motion::rotation(half_turn_[h]) * Motion::translation(x, hyperbolic_cosine(x)) * Motion::rotation(conj(back));
  }

  const Intrinsic_triangulation<NT>& t_;
  const std::vector<Wide>& s_;
  std::vector<Complex> half_turn_; // by halfedge: e^{i theta / 2}
  std::vector<Motion> frame_;
};

// A connected set of one lift of every face. It grows from a face at `base`, next by the lift that comes closest to the center: nearly a Dirichlet
// domain. By halfedge: the word that takes the chosen lift of its origin to the corner.
template <typename NT, typename Wide>
std::vector<Word> fundamental_domain(const Intrinsic_triangulation<NT>& t, const std::vector<Word>& label, const std::vector<Isometry<Wide> >& frame,
                                     Word_values<Isometry<Wide> >& deck, std::uint32_t base)
{
  typedef std::uint32_t Index;
  typedef std::tuple<double, Index, Word> Entry; // distance, side of a face not entered yet, the word of its origin
  std::vector<Word> corner(t.number_of_halfedges());
  std::vector<char> is_entered(t.number_of_faces(), 0);
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry> > queue;
  queue.emplace(0., t.vertex_halfedge(base), Word());
  while(!queue.empty())
  {
    const Index first = std::get<1>(queue.top());
    Word word = std::get<2>(queue.top());
    queue.pop();
    if(is_entered[t.face(first)])
      continue;
    is_entered[t.face(first)] = 1;
    Index h = first;
    for(int k = 0; k < 3; ++k, h = t.next(h))
    {
      corner[h] = word;
      word = product(word, label[h]);
      const Index g = t.twin(h);
      if(g == t.null_index || is_entered[t.face(g)])
        continue;
      const Index apex = t.previous(g);
      const Word to_apex = product(word, inverse(label[apex]));
      // |b| of a frame is the hyperbolic sine of half the distance from the center
      const Isometry<Wide>& motion = deck(to_apex);
      queue.emplace(size_of((motion * frame[t.origin(apex)]).b), g, word);
    }
  }
  return corner;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_LAYOUT_H
