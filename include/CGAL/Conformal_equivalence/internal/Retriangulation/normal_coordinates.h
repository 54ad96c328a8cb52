// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// How the edges of the input triangulation run over a triangulation that was
// made of it by flips: recorded in integers alone, so that nothing here knows
// lengths or rounding (Gillespie, Sharp and Crane, "Integer Coordinates for
// Intrinsic Geometry Processing", 2021; Gillespie, Springborn and Crane, "Discrete
// Conformal Equivalence of Polyhedral Surfaces", 2021; section 3.2 of Springborn,
// Schroeder and Pinkall, 2008, flips edges).
//
// Both triangulations have the same vertices, and edges are curves up to isotopy
// with the vertices fixed. Pull the input edges tight: then within a triangle
// of the current triangulation every input edge is made of arcs of two kinds,
// and whatever is an edge of both is the same curve:
//
//              k                        k
//            / | \                    /   \           arcs from a vertex, across the opposite side (only one
//          /   | |\                 /___   \          vertex of a triangle can have any), and arcs around a
//        /    |  | \              /      \  \         vertex, across both sides that meet there. Nothing crosses.
//      /     |   |  \           / \       |  \        .
//     i -----|---|--- j        i --|------|-- j       .
//
// It suffices to know, for every current edge, how often it is crossed (its
// normal coordinate), and for every current halfedge, which input edge comes
// first counterclockwise around its origin (its roundabout).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_NORMAL_COORDINATES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_NORMAL_COORDINATES_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The record. What it needs of the input it copies: the input may change or go
// away. Every `current` below is the triangulation made of the input by the flips
// announced so far, of any number type; memory is linear in the size of the surface.
class Normal_coordinates
{
public:
  typedef std::uint32_t Index;
  static constexpr Index null_index = (std::numeric_limits<Index>::max)();

  // Where an input halfedge begins: in the corner counterclockwise from the current halfedge `first`, or along it.
  // `position` counts the input halfedges that begin there, counterclockwise; one that runs along `first` is number 0.
  struct Start
  {
    Index first;
    std::uint32_t position;
  };

  // How an input halfedge runs, from its origin to its target.
  struct Path
  {
    Index first;                        // as in `Start`
    bool is_edge;                       // the path is the edge of `first`, and crosses nothing
    std::vector<Index> crossed;         // the halfedges it crosses: from the face of each to the face of its twin
    std::vector<std::uint32_t> strand;  // by crossing: how many input edges cross the halfedge nearer to its origin
  };

  // The input is the current triangulation.
  // \pre all triangles at a vertex form one fan (`non_manifold_vertices()`). Linear time.
  template <typename NT>
  explicit Normal_coordinates(const Intrinsic_triangulation<NT>& input)
    : crossings_(input.number_of_edges(), 0), roundabout_(input.number_of_halfedges(), 0),
      origin_(input.number_of_halfedges())
  {
    offset_.reserve(std::size_t(input.number_of_vertices()) + 1);
    ends_.reserve(roundabout_.size());
    for(Index v = 0; v < input.number_of_vertices(); ++v)
    {
      offset_.push_back(ends_.size());
      input.for_each_outgoing(v, [&](Index h)
      {
        origin_[h] = v;
        roundabout_[h] = Index(ends_.size() - offset_[v]);
        ends_.push_back(h);
      });
      if(input.is_border_vertex(v))
        ends_.push_back(null_index); // the border edge that ends here: no halfedge begins along it
    }
    offset_.push_back(ends_.size());
    input_roundabout_ = roundabout_;
  }

  // Announces that `e` is about to be flipped by `current.flip_edge(e, ..)`: to be called right before. O(1).
  // \pre `current.is_flippable(e)`
  template <typename NT>
  void flip(const Intrinsic_triangulation<NT>& current, Index e);

  // `true` once a number of crossings was too large for 32 bits: the record stays as it was before that flip, fits the
  // current triangulation no longer, and must not be asked for starts and paths any more.
  bool has_overflowed() const { return has_overflowed_; }

  // The number of times that input edges cross the current edge `e`.
  std::uint32_t crossings(Index e) const { return crossings_[e]; }

  // `true` iff the current edge `e` is an edge of the input. (One that is not crossed lies in an input triangle,
  // and there nothing but a side joins two corners.)
  bool coincides(Index e) const { return crossings_[e] == 0; }

  // The sum of the crossings of all edges, which is the sum of the lengths of the paths of all input edges.
  std::uint64_t total_crossings() const { return total_crossings_; }

  // The input halfedge that runs along the current halfedge `h`.
  // \pre `coincides(current.edge(h))`
  template <typename NT>
  Index input_halfedge(const Intrinsic_triangulation<NT>& current, Index h) const
  {
    CGAL_precondition(!has_overflowed_ && coincides(current.edge(h)));
    return ends_[offset_[current.origin(h)] + roundabout_[h]];
  }

  // Where the input halfedge begins. Linear in the number of current corners at its origin.
  template <typename NT>
  Start start(const Intrinsic_triangulation<NT>& current, Index input_halfedge) const;

  // The same for all input halfedges at once. Linear time.
  template <typename NT>
  std::vector<Start> starts(const Intrinsic_triangulation<NT>& current) const;

  // Its number among the input halfedges that begin in the same current corner.
  template <typename NT>
  std::uint32_t position(const Intrinsic_triangulation<NT>& current, Index input_halfedge) const
  {
    return start(current, input_halfedge).position;
  }

  // How an input halfedge runs; linear in the number of its crossings (at most `total_crossings()`: ask for that before),
  // with the time of `start()` if it is not known where it begins.
  template <typename NT>
  Path path(const Intrinsic_triangulation<NT>& current, Index input_halfedge) const
  {
    return path(current, start(current, input_halfedge));
  }
  template <typename NT>
  Path path(const Intrinsic_triangulation<NT>& current, const Start& start) const;

  // The number of its crossings, or `limit` if there are more. O(min(crossings, limit)), and no memory.
  template <typename NT>
  std::uint64_t length_of_path(const Intrinsic_triangulation<NT>& current, const Start& start, std::uint64_t limit) const;

private:
  typedef std::int64_t Count;

  template <typename NT>
  Count count(const Intrinsic_triangulation<NT>& t, Index h) const { return crossings_[t.edge(h)]; }

  // The number of arcs from the origin of `h`: what crosses the opposite side and neither of the sides that meet there.
  template <typename NT>
  Count arcs_from_origin(const Intrinsic_triangulation<NT>& t, Index h) const
  {
    return (std::max)(Count(0), count(t, t.next(h)) - count(t, h) - count(t, t.previous(h)));
  }

  // The number of arcs around the origin of `h`: half of what the two sides there have more than the opposite one;
  // or, if another vertex has arcs across one of the two, all that cross the other one.
  template <typename NT>
  Count arcs_around_origin(const Intrinsic_triangulation<NT>& t, Index h) const
  {
    const Count a = count(t, h), b = count(t, t.previous(h)), opposite = count(t, t.next(h));
    return (std::max)(Count(0), (std::min)({a, b, (a + b - opposite) / 2}));
  }

  // The number of input halfedges that begin in the corner at the origin of `h`, or along `h`.
  template <typename NT>
  Count number_of_starts(const Intrinsic_triangulation<NT>& t, Index h) const
  {
    return Count(coincides(t.edge(h))) + arcs_from_origin(t, h);
  }

  // Whether the input halfedge that begins there runs along a current one.
  template <typename NT>
  bool is_along(const Intrinsic_triangulation<NT>& t, const Start& start) const
  {
    return start.position == 0 && coincides(t.edge(start.first));
  }

  // Calls `visit(c, strand)` for the crossings of a path, as in `Path`, as long as it returns `true`.
  // \pre !is_along(current, start)
  template <typename NT, typename Visit>
  void follow(const Intrinsic_triangulation<NT>& current, const Start& start, Visit visit) const;

  // The number of input edges that begin or end at `v`.
  Count degree(Index v) const { return Count(offset_[v + 1] - offset_[v]); }

  Count modulo_degree(Count direction, Index v) const { return direction % degree(v); }

  std::vector<std::uint32_t> crossings_;      // by current edge
  std::vector<Index> roundabout_;             // by current halfedge: counted from the first of `ends_` at its origin
  std::vector<Index> origin_;                 // by input halfedge
  std::vector<Index> input_roundabout_;       // by input halfedge
  std::vector<std::size_t> offset_;           // by vertex, into `ends_`
  std::vector<Index> ends_;                   // the input halfedges around each vertex, counterclockwise
  std::uint64_t total_crossings_ = 0;
  bool has_overflowed_ = false;
};

// The input edges that cross `e`, numbered from i to j, pass the upper triangle first around i, then from k, then around
// j; so they do the lower one, with l in the place of k:
//
//                  k                                   k
//               /  :  \                             /  |  \              The new edge is crossed by
//          p  /  / : \  \  n                   p  /    |    \  n          - all that runs around k, or around l;
//           /  /   :   \  \                     /      |      \           - the arcs from i and from j, and e itself
//         i ---|---|----|-- j                 i        |        j           if it is an edge of the input;
//           \   \  |   /  /                     \      |      /           - what crosses e around i above and around
//          m  \   \|  /  /  q                  m  \    |    /  q            j below, or around j above and i below.
//               \  : / /                            \  |  /              What comes from k (or l) across e leaves on
//                  l                                   l                 one side of the new edge, or is that edge.
//
//     above:   |-- around i --|------- from k -------|-- around j --|
//     below:   |-- around i ------|-- from l --|------ around j ----|       All runs are intervals of 0 .. crossings(e):
//                             ^^^^^                                         here these come from k, and pass on the side
//                                                                           of i, between p and the new edge.
//
// The new halfedge from k comes after p and the input halfedges that begin on that side, and the one from l after q
// and those on the side of j. All arcs remain tight: each joins two sides, or a vertex and the opposite side.
template <typename NT>
void Normal_coordinates::flip(const Intrinsic_triangulation<NT>& current, Index e)
{
  CGAL_precondition(current.is_flippable(e));
  if(has_overflowed_)
    return;
  const Index h = current.edge_halfedge(e), g = current.twin(h);
  const Index n = current.next(h), p = current.previous(h), m = current.next(g), q = current.previous(g);

  const Count all = crossings_[e];
  const Count i_above = arcs_around_origin(current, h), i_below = arcs_around_origin(current, m);
  const Count j_above = arcs_around_origin(current, n), j_below = arcs_around_origin(current, g);
  const Count from_k = arcs_from_origin(current, p), from_l = arcs_from_origin(current, q);

  Count crossings = Count(coincides(e)) + (std::max)(Count(0), i_above + j_below - all)
                                        + (std::max)(Count(0), j_above + i_below - all);
  for(Index around : {p, q})
    crossings += arcs_around_origin(current, around);
  for(Index from : {h, n, g, m})
    crossings += arcs_from_origin(current, from);
  if(crossings > Count((std::numeric_limits<std::uint32_t>::max)()))
  {
    has_overflowed_ = true;
    return;
  }

  const auto clamp = [](Count x, Count high) { return (std::max)(Count(0), (std::min)(x, high)); };
  const Count k_on_side_of_i = Count(coincides(current.edge(p))) + clamp(i_below - i_above, from_k);
  const Count l_on_side_of_j = Count(coincides(current.edge(q))) + clamp(j_above - j_below, from_l);
  const Count new_from_k = modulo_degree(roundabout_[p] + k_on_side_of_i, current.origin(p));
  const Count new_from_l = modulo_degree(roundabout_[q] + l_on_side_of_j, current.origin(q));

  // flip_edge() renumbers the halfedges: n, p, m, q become q, n, p, m; h comes from l, and g from k
  const std::array<Index, 4> outer = {{roundabout_[n], roundabout_[p], roundabout_[m], roundabout_[q]}};
  roundabout_[q] = outer[0];
  roundabout_[n] = outer[1];
  roundabout_[p] = outer[2];
  roundabout_[m] = outer[3];
  roundabout_[h] = Index(new_from_l);
  roundabout_[g] = Index(new_from_k);
  total_crossings_ += std::uint64_t(crossings) - std::uint64_t(all);
  crossings_[e] = std::uint32_t(crossings);
}

template <typename NT>
Normal_coordinates::Start
Normal_coordinates::start(const Intrinsic_triangulation<NT>& current, Index input_halfedge) const
{
  CGAL_precondition(!has_overflowed_);
  const Index v = origin_[input_halfedge], first = current.vertex_halfedge(v);
  const Count direction = input_roundabout_[input_halfedge];
  Index h = first;
  do
  {
    const Count position = modulo_degree(direction + degree(v) - roundabout_[h], v);
    if(position < number_of_starts(current, h))
      return { h, std::uint32_t(position) };
    h = current.next_around_origin(h);
  }
  while(h != first && h != null_index);
  CGAL_assertion_msg(false, "the record does not belong to this triangulation");
  return { null_index, 0 };
}

template <typename NT>
std::vector<Normal_coordinates::Start>
Normal_coordinates::starts(const Intrinsic_triangulation<NT>& current) const
{
  CGAL_precondition(!has_overflowed_);
  std::vector<Start> result(origin_.size(), Start{ null_index, 0 });
  for(Index h = 0; h < current.number_of_halfedges(); ++h)
  {
    const Index v = current.origin(h);
    const Count n = number_of_starts(current, h);
    for(Count position = 0; position < n; ++position)
      result[ends_[offset_[v] + std::size_t(modulo_degree(roundabout_[h] + position, v))]]
        = { h, std::uint32_t(position) };
  }
  return result;
}

// A path that enters a face through its side g, as number s of those that cross g, counted from the origin of g:
//
//                k
//              /   \            the first ones go around i, and leave through previous(g) at the same distance from i;
//            / / | \ \          the next ones end at k;
//          / /   |  \  \        the last ones go around j, and leave through next(g) at the same distance from j.
//         i-|----|---|- j       .
//           0 .. g ..           .
template <typename NT, typename Visit>
void Normal_coordinates::follow(const Intrinsic_triangulation<NT>& current, const Start& start, Visit visit) const
{
  CGAL_precondition(!has_overflowed_ && !is_along(current, start));
  Index c = current.next(start.first); // the side opposite to where the path begins
  Count strand = arcs_around_origin(current, c) + start.position - Count(coincides(current.edge(start.first)));
  while(true)
  {
    CGAL_assertion(strand >= 0 && strand < count(current, c));
    if(!visit(c, std::uint32_t(strand)))
      return;

    const Index g = current.twin(c), k = current.previous(g);
    const Count from_i = count(current, g) - 1 - strand, around_i = arcs_around_origin(current, g);
    if(from_i < around_i)
    {
      c = k;
      strand = count(current, c) - 1 - from_i;
    }
    else if(from_i < around_i + arcs_from_origin(current, k))
      return;
    else
      c = current.next(g); // and as far from j as before, where it is counted from j
  }
}

template <typename NT>
Normal_coordinates::Path
Normal_coordinates::path(const Intrinsic_triangulation<NT>& current, const Start& start) const
{
  CGAL_precondition(!has_overflowed_);
  Path result{ start.first, is_along(current, start), {}, {} };
  if(!result.is_edge)
    follow(current, start, [&](Index c, std::uint32_t strand)
    {
      result.crossed.push_back(c);
      result.strand.push_back(strand);
      return true;
    });
  return result;
}

template <typename NT>
std::uint64_t Normal_coordinates::length_of_path(const Intrinsic_triangulation<NT>& current, const Start& start, std::uint64_t limit) const
{
  CGAL_precondition(!has_overflowed_);
  std::uint64_t result = 0;
  if(limit > 0 && !is_along(current, start))
    follow(current, start, [&](Index, std::uint32_t) { return ++result < limit; });
  return result;
}

// The record of the flips of a metric, made by repeating them.
template <typename NT>
Normal_coordinates replay_flips(const Intrinsic_triangulation<NT>& input, const std::vector<std::uint32_t>& flips)
{
  Intrinsic_triangulation<NT> t = input;
  Normal_coordinates result(input);
  for(std::uint32_t e : flips)
  {
    result.flip(t, e);
    t.flip_edge(e, t.length(e));
  }
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_NORMAL_COORDINATES_H
