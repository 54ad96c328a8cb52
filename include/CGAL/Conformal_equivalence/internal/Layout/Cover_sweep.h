// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Whether a layout covers some part of the plane twice, decided exactly from its border alone. Only `verify_layout()` needs this header, which
// brings kernels of CGAL along.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_COVER_SWEEP_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_COVER_SWEEP_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

typedef Exact_predicates_inexact_constructions_kernel    Exact_predicates;
typedef Exact_predicates::Point_2                        Plane_point;

// A directed segment of the border of a layout; the layout is on its left.
struct Border_segment
{
  Plane_point source, target;
};

// Do the interiors of two segments intersect in one point that is not an end of either?
inline bool cross_properly(const Plane_point& p, const Plane_point& q, const Plane_point& r, const Plane_point& s)
{
  const Orientation pqr = orientation(p, q, r);
  if(pqr == COLLINEAR || pqr != opposite(orientation(p, q, s)))
    return false;
  const Orientation rsp = orientation(r, s, p);
  return rsp != COLLINEAR && rsp == opposite(orientation(r, s, q));
}

// Decides whether a layout whose triangles are all positive covers some part of the plane twice.
//
// The number of triangles over a generic point is the sum of the winding numbers of the border around it.
// A plane sweep from left to right keeps the border segments above the current point in order, each with the
// number of triangles just above it.  As long as no two segments cross properly, they can touch at given points
// only; segments are split there, so all predicates are evaluated on given points, exactly.  A proper crossing
// ends the sweep: there the two triangles along the segments overlap.
//
//        ---------- 0 above           Sum of +1 for a segment from left to right, -1 for one from right
//        <--------- 1 above           to left, taken upwards from below.
//        ---------> 0 below
//
// O((n + t) log n) for n segments and t points in the interior of segments.
class Cover_sweep
{
  typedef std::uint32_t Index;

  // A part of a segment between two given points, left before right in lexicographic order.
  struct Piece
  {
    Index left, right;
    int winding;                  // triangles above minus triangles below
    Index segment;                // one of the segments that contain it
    mutable int cover = 0;        // triangles just above; known once the piece is in the status
  };

  // The order of the status from below to above; also of a point against a piece.
  struct Is_below
  {
    typedef void is_transparent;
    const std::vector<Plane_point>* points;

    const Plane_point& point(Index i) const { return (*points)[i]; }

    Orientation side(const Piece& a, Index p) const { return orientation(point(a.left), point(a.right), point(p)); }

    bool operator()(const Piece& a, Index p) const { return side(a, p) == LEFT_TURN; }
    bool operator()(Index p, const Piece& a) const { return side(a, p) == RIGHT_TURN; }
    bool operator()(const Piece& a, const Piece& b) const
    {
      if(a.left == b.left)
        return side(a, b.right) == LEFT_TURN;
      return a.left < b.left ? side(a, b.left) == LEFT_TURN : side(b, a.left) == RIGHT_TURN;
    }
  };

  typedef std::set<Piece, Is_below> Status;

public:
  // The coordinates must be finite and no segment a point.
  explicit Cover_sweep(const std::vector<Border_segment>& segments)
    : status_(Is_below{&points_})
  {
    collect_pieces(segments);
    for(Index p = 0; p < points_.size() && !is_covered_twice_; ++p)
      process(p);
  }

  Cover_sweep(const Cover_sweep&) = delete;
  Cover_sweep& operator=(const Cover_sweep&) = delete;

  bool is_covered_twice() const { return is_covered_twice_; }

  // If so, two segments at the place: they cross properly, or the layout beside the first lies upon the one
  // above the second.
  std::size_t first_witness() const { return witness_[0]; }
  std::size_t second_witness() const { return witness_[1]; }

private:
  // Sorts and identifies the end points, and turns each segment into a piece.
  void collect_pieces(const std::vector<Border_segment>& segments)
  {
    const auto end_point = [&](Index e) -> const Plane_point&
    { return e % 2 == 0 ? segments[e / 2].source : segments[e / 2].target; };

    std::vector<Index> order(2 * segments.size());
    for(Index e = 0; e < order.size(); ++e)
      order[e] = e;
    std::sort(order.begin(), order.end(), [&](Index e, Index f)
              { return compare_xy(end_point(e), end_point(f)) == SMALLER; });

    std::vector<Index> id(order.size());
    for(Index e : order)
    {
      if(points_.empty() || points_.back() != end_point(e))
        points_.push_back(end_point(e));
      id[e] = static_cast<Index>(points_.size() - 1);
    }
    pieces_.reserve(segments.size());
    for(Index s = 0; s < segments.size(); ++s)
    {
      const Index from = id[2 * s], to = id[2 * s + 1];
      pieces_.push_back(from < to ? Piece{from, to, 1, s} : Piece{to, from, -1, s});
    }
    std::sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) { return a.left < b.left; });
  }

  // Event at the point p: everything that ends at p, passes through p, or starts at p.
  void process(Index p)
  {
    outgoing_.clear();
    const auto through = status_.equal_range(p);
    for(auto it = through.first; it != through.second; ++it)
      if(it->right != p)
        outgoing_.push_back({p, it->right, it->winding, it->segment});
    const auto above = status_.erase(through.first, through.second);

    collect_starting(p);
    sort_by_direction(p);
    insert(above);
  }

  void collect_starting(Index p)
  {
    while(next_piece_ < pieces_.size() && pieces_[next_piece_].left == p)
      outgoing_.push_back(pieces_[next_piece_++]);
    const auto later = remainders_.find(p);
    if(later == remainders_.end())
      return;
    outgoing_.insert(outgoing_.end(), later->second.begin(), later->second.end());
    remainders_.erase(later);
  }

  // Orders the pieces that leave p from below to above and unites those of equal direction: the shortest carries
  // the windings of all, the rest of each longer one starts where the shortest ends.
  void sort_by_direction(Index p)
  {
    const auto turn = [&](const Piece& a, const Piece& b)
    { return orientation(points_[p], points_[a.right], points_[b.right]); };
    std::sort(outgoing_.begin(), outgoing_.end(), [&](const Piece& a, const Piece& b)
              {
                const Orientation o = turn(a, b);
                return o != COLLINEAR ? o == LEFT_TURN
                                      : a.right != b.right ? a.right < b.right : a.segment < b.segment;
              });

    std::size_t n = 0;
    for(const Piece& piece : outgoing_)
    {
      if(n == 0 || turn(outgoing_[n - 1], piece) != COLLINEAR)
      {
        outgoing_[n++] = piece;
        continue;
      }
      Piece& shortest = outgoing_[n - 1];
      shortest.winding += piece.winding;
      if(shortest.winding > 1)
        set_witness(shortest.segment, piece.segment);
      if(piece.right != shortest.right)
        remainders_[shortest.right].push_back({shortest.right, piece.right, piece.winding, piece.segment});
    }
    outgoing_.resize(n);
  }

  // Puts the outgoing pieces into the status, below `above`, and looks at what has become adjacent.
  void insert(Status::const_iterator above)
  {
    const bool has_lower = above != status_.begin();
    const Status::const_iterator lower = has_lower ? std::prev(above) : above;
    if(outgoing_.empty())
    {
      if(has_lower && above != status_.end())
        check_crossing(*lower, *above);
      return;
    }

    Status::const_iterator last = lower;
    int cover = has_lower ? lower->cover : 0;
    for(const Piece& piece : outgoing_)
    {
      cover += piece.winding;
      if(cover > 1)
        set_witness(piece.segment, has_lower || last != lower ? last->segment : piece.segment);
      last = status_.insert(above, piece);
      last->cover = cover;
    }
    if(has_lower)
      check_crossing(*lower, *std::next(lower));
    if(above != status_.end())
      check_crossing(*last, *above);
  }

  void check_crossing(const Piece& a, const Piece& b)
  {
    if(cross_properly(points_[a.left], points_[a.right], points_[b.left], points_[b.right]))
      set_witness(a.segment, b.segment);
  }

  void set_witness(Index a, Index b)
  {
    if(is_covered_twice_)
      return;
    is_covered_twice_ = true;
    witness_[0] = a;
    witness_[1] = b;
  }

  std::vector<Plane_point> points_;                                 // in lexicographic order
  std::vector<Piece> pieces_;                                       // by left end
  std::size_t next_piece_ = 0;
  std::unordered_map<Index, std::vector<Piece> > remainders_;       // by left end, from splitting
  std::vector<Piece> outgoing_;
  Status status_;
  bool is_covered_twice_ = false;
  std::size_t witness_[2] = {0, 0};
};

// All pairs of segments that cross properly, in lexicographic order.
inline std::vector<std::pair<std::size_t, std::size_t> >
properly_crossing_pairs(const std::vector<Border_segment>& segments)
{
  typedef Box_intersection_d::Box_with_info_d<double, 2, std::size_t> Box;

  std::vector<Box> boxes;
  boxes.reserve(segments.size());
  for(std::size_t s = 0; s < segments.size(); ++s)
    boxes.emplace_back(segments[s].source.bbox() + segments[s].target.bbox(), s);

  std::vector<std::pair<std::size_t, std::size_t> > pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b)
  {
    const Border_segment &s = segments[a.info()], &t = segments[b.info()];
    if(cross_properly(s.source, s.target, t.source, t.target))
      pairs.push_back(std::minmax({a.info(), b.info()}));
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// The pairs of segments that prove that the layout covers something twice; empty if it does not.
inline std::vector<std::pair<std::size_t, std::size_t> >
find_overlaps(const std::vector<Border_segment>& segments)
{
  const Cover_sweep sweep(segments);
  if(!sweep.is_covered_twice())
    return {};
  auto pairs = properly_crossing_pairs(segments);
  if(pairs.empty())
    pairs.emplace_back(sweep.first_witness(), sweep.second_witness());
  return pairs;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_COVER_SWEEP_H
