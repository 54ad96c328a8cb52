// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Closed curves on a triangulated surface that go from face to face across edges, carried along when edges are flipped.
//
// A curve is the cyclic list of the halfedges through which it enters faces. In a face that it enters through h it leaves through one of the
// other two sides, and so turns about one corner:
//
//              k                       k
//            /   \                   /   \          through previous(h): about the origin i of h, to the left, +
//      <----/--,  \                 /  ,--\---->    through next(h): about the target j of h, to the right, -
//          /   |   \               /   |   \        .
//         i ---+-h- j             i ---+-h- j
//
// Its turning is the sum of the angles of these corners with their signs: the integral of the geodesic curvature in a flat metric with cones.
// Counterclockwise around a vertex it is the angle sum there. If all angle sums and all turnings are multiples of 2 pi / n,
// the flat metric goes on across any cut by rotations by such multiples.
//
// As all crossings of a quadrilateral's diagonal lie between two crossings of its sides, a flip rewrites a few neighbors in the lists: the crossings
// of the old diagonal go, and the new one is crossed wherever the sides by which a curve comes and goes belong to different triangles. A curve that
// does not turn back stays one that does not.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_DUAL_LOOPS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_DUAL_LOOPS_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Dual_loops
{
public:
  typedef std::uint32_t Index;
  typedef std::vector<Index> Loop; // the halfedges entered, in order
  static constexpr Index null_index = Intrinsic_triangulation<>::null_index;

  Dual_loops() = default;

  // Pieces that go there and back are removed. \pre `is_dual_loop()` of each; none can be contracted along its own crossings
  template <typename NT>
  Dual_loops(const Intrinsic_triangulation<NT>& t, const std::vector<Loop>& loops) : crossings_of_edge_(t.number_of_edges())
  {
    for(const Loop& loop : loops)
      add(t, reduced(t, loop));
  }

  // Without the pieces that go there and back.
  template <typename NT>
  static Loop reduced(const Intrinsic_triangulation<NT>& t, const Loop& loop)
  {
    Loop result;
    for(Index h : loop)
      if(!result.empty() && t.twin(h) == result.back())
        result.pop_back();
      else
        result.push_back(h);
    std::size_t first = 0, last = result.size();
    while(last - first > 1 && t.twin(result[first]) == result[last - 1])
      ++first, --last;
    return Loop(result.begin() + std::ptrdiff_t(first), result.begin() + std::ptrdiff_t(last));
  }

  std::size_t size() const { return first_.size(); }

  // Linear in its length.
  Loop loop(std::size_t i) const
  {
    Loop result;
    for_each_crossing(i, [&](Index c) { result.push_back(crossings_[c].entered); });
    return result;
  }

  // The sum of their lengths.
  std::size_t number_of_crossings() const { return number_of_crossings_; }

  // To be called right before `t.flip_edge(e, ..)`. Linear in the number of times that the quadrilateral of `e` is crossed.
  template <typename NT>
  void flip(const Intrinsic_triangulation<NT>& t, Index e);

  // Calls `visit(corner, sign)` for every corner that the loop turns about: that at the origin of the halfedge `corner`; `sign` is 1 or -1.
  template <typename NT, typename Visit>
  void for_each_turn(const Intrinsic_triangulation<NT>& t, std::size_t i, Visit visit) const
  {
    for_each_crossing(i, [&](Index c)
    {
      const Index h = crossings_[c].entered, left_by = t.twin(crossings_[crossings_[c].next].entered);
      if(left_by == t.next(h))
        visit(t.next(h), -1);
      else
        visit(h, 1);
    });
  }

private:
  // A face is entered.
  struct Crossing
  {
    Index entered;
    Index next, previous; // crossings of the same loop
    Index loop;
  };

  template <typename Visit>
  void for_each_crossing(std::size_t i, Visit visit) const
  {
    Index c = first_[i];
    do
    {
      visit(c);
      c = crossings_[c].next;
    }
    while(c != first_[i]);
  }

  template <typename NT>
  void add(const Intrinsic_triangulation<NT>& t, const Loop& loop)
  {
    CGAL_precondition(!loop.empty());
    const Index begin = Index(crossings_.size()), n = Index(loop.size());
    for(Index k = 0; k < n; ++k)
    {
      crossings_.push_back({loop[k], begin + (k + 1) % n, begin + (k + n - 1) % n, Index(first_.size())});
      crossings_of_edge_[t.edge(loop[k])].push_back(begin + k);
    }
    number_of_crossings_ += n;
    first_.push_back(begin);
  }

  void erase(Index c)
  {
    const Crossing& crossing = crossings_[c];
    crossings_[crossing.next].previous = crossing.previous;
    crossings_[crossing.previous].next = crossing.next;
    if(first_[crossing.loop] == c)
      first_[crossing.loop] = crossing.next;
    unused_.push_back(c);
    --number_of_crossings_;
  }

  Index insert_after(Index c, Index entered)
  {
    Index result = Index(crossings_.size());
    if(unused_.empty())
      crossings_.emplace_back();
    else
    {
      result = unused_.back();
      unused_.pop_back();
    }
    const Index next = crossings_[c].next;
    crossings_[result] = {entered, next, c, crossings_[c].loop};
    crossings_[c].next = result;
    crossings_[next].previous = result;
    ++number_of_crossings_;
    return result;
  }

  std::vector<Crossing> crossings_;
  std::vector<Index> first_;                          // by loop
  std::vector<std::vector<Index> > crossings_of_edge_;
  std::vector<Index> unused_;                         // places in `crossings_`
  std::size_t number_of_crossings_ = 0;
};

template <typename NT>
void Dual_loops::flip(const Intrinsic_triangulation<NT>& t, Index e)
{
  const Index h = t.edge_halfedge(e), g = t.twin(h);
  // `flip_edge()` renumbers the sides of the quadrilateral: the first become the second ones
  const std::array<Index, 4> from = {{t.next(h), t.previous(h), t.next(g), t.previous(g)}},
                             to = {{t.previous(g), t.next(h), t.previous(h), t.next(g)}};
  const auto moved = [&](Index a)
  {
    const auto found = std::find(from.begin(), from.end(), a);
    return found == from.end() ? a : to[std::size_t(found - from.begin())];
  };
  const auto is_side = [&](Index a) { return std::find(from.begin(), from.end(), a) != from.end(); };

  for(Index c : crossings_of_edge_[e])
    erase(c);
  crossings_of_edge_[e].clear();

  std::array<Index, 4> sides = {{t.edge(from[0]), t.edge(from[1]), t.edge(from[2]), t.edge(from[3])}};
  std::sort(sides.begin(), sides.end()); // two sides may be glued to each other
  const auto end_of_sides = std::unique(sides.begin(), sides.end());
  std::vector<Index> crossings;
  for(auto side = sides.begin(); side != end_of_sides; ++side)
    crossings.insert(crossings.end(), crossings_of_edge_[*side].begin(), crossings_of_edge_[*side].end());
  for(Index c : crossings)
  {
    const Index entered = crossings_[c].entered;
    if(!is_side(entered))
      continue;
    const Index comes = t.face(moved(entered)), goes = t.face(moved(t.twin(crossings_[crossings_[c].next].entered)));
    if(comes != goes)
      crossings_of_edge_[e].push_back(insert_after(c, goes == t.face(h) ? h : g));
  }
  for(Index c : crossings)
    crossings_[c].entered = moved(crossings_[c].entered);
}

// Whether the halfedges are entered one after the other by a closed curve that turns back nowhere.
template <typename NT>
bool is_dual_loop(const Intrinsic_triangulation<NT>& t, const std::vector<std::uint32_t>& entered)
{
  for(std::size_t k = 0; k < entered.size(); ++k)
  {
    const std::uint32_t h = entered[k], next = entered[(k + 1) % entered.size()];
    if(h >= t.number_of_halfedges() || next >= t.number_of_halfedges() || t.is_border(next) || t.face(t.twin(next)) != t.face(h)
       || t.twin(next) == h)
      return false;
  }
  return !entered.empty();
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_DUAL_LOOPS_H
