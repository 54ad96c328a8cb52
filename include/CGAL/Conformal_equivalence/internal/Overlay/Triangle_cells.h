// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_TRIANGLE_CELLS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_TRIANGLE_CELLS_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A triangle of one of the two triangulations, cut into cells by the edges of the other. How often its sides are crossed tells how the
// arcs between the crossings run (normal_coordinates.h). Around the triangle, counterclockwise, there are its corner 0, the
// crossings of its side 0, its corner 1, and so on: the places 0, 1, 2, ...
class Triangle_cells
{
public:
  // From one place to another: along a side of the triangle, or along an arc inside.
  struct Segment
  {
    std::size_t from, to;
    bool is_on_side;
  };

  // \param crossings by side
  void cut(const std::array<std::size_t, 3>& crossings)
  {
    const std::array<std::size_t, 3>& n = crossings;
    std::array<std::size_t, 3> around;
    std::size_t size = 0;
    for(std::size_t k = 0; k < 3; ++k)
    {
      corner_[k] = size;
      size += 1 + n[k];
    }
    other_end_.assign(size, 0);
    is_done_.assign(size, 0);
    for(std::size_t k = 0; k < 3; ++k) // around the corner k, from side k to the previous one
    {
      const std::size_t previous = (k + 2) % 3, a = n[k], b = n[previous], opposite = n[(k + 1) % 3];
      around[k] = (std::min)({a, b, a + b > opposite ? (a + b - opposite) / 2 : 0});
      for(std::size_t s = 0; s < around[k]; ++s)
      {
        const std::size_t p = corner_[k] + 1 + s, q = corner_[previous] + b - s;
        other_end_[p] = q;
        other_end_[q] = p;
      }
    }
    for(std::size_t k = 0; k < 3; ++k) // from the corner k, across the opposite side
    {
      const std::size_t opposite = (k + 1) % 3, sides = n[k] + n[(k + 2) % 3];
      fan_size_[k] = n[opposite] > sides ? n[opposite] - sides : 0;
      fan_begin_[k] = corner_[opposite] + 1 + around[opposite];
      for(std::size_t s = 0; s < fan_size_[k]; ++s)
        other_end_[fan_begin_[k] + s] = corner_[k];
    }
  }

  // Calls `visit(cell)` for every cell, a vector of segments, counterclockwise. Every cell has a part of a side.
  template <typename Visit>
  void for_each(Visit visit)
  {
    for(std::size_t p = 0; p < is_done_.size(); ++p)
      if(!is_done_[p])
      {
        walk_around_cell(p);
        visit(cell_);
      }
  }

  // The side that the place is on; a corner is on the side that begins there.
  std::size_t side(std::size_t place) const { return place >= corner_[2] ? 2 : place >= corner_[1] ? 1 : 0; }

  // How many places of its side come before it: 0 for a corner, 1 for the first crossing.
  std::size_t position(std::size_t place) const { return place - corner_[side(place)]; }

  bool is_corner(std::size_t place) const { return position(place) == 0; }

private:
  // From the place p along the side of the triangle, then always along the leftmost way.
  void walk_around_cell(std::size_t p)
  {
    cell_.clear();
    const std::size_t begin = p, end = is_done_.size();
    bool is_on_side = true;
    do
    {
      const std::size_t q = is_on_side ? (p + 1) % end : next_place_;
      cell_.push_back({p, q, is_on_side});
      if(is_on_side)
        is_done_[p] = 1;
      is_on_side = !find_next(p, q, is_on_side);
      p = q;
    }
    while(p != begin || !is_on_side);
  }

  // Arrived at q from p: is the next segment an arc, to `next_place_`? Around q, counterclockwise, there are the next place, the
  // ends of its arcs, and the previous place.
  bool find_next(std::size_t p, std::size_t q, bool is_on_side)
  {
    const std::size_t k = side(q);
    if(q != corner_[k])
    {
      next_place_ = other_end_[q];
      return is_on_side;
    }
    if(is_on_side && fan_size_[k] > 0)
    {
      next_place_ = fan_begin_[k] + fan_size_[k] - 1;
      return true;
    }
    if(!is_on_side && p > fan_begin_[k])
    {
      next_place_ = p - 1;
      return true;
    }
    return false;
  }

  std::array<std::size_t, 3> corner_, fan_begin_, fan_size_;
  std::vector<std::size_t> other_end_; // by place
  std::vector<char> is_done_;          // by place: whether the cell on the left of the segment to the next place was visited
  std::vector<Segment> cell_;
  std::size_t next_place_ = 0;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_TRIANGLE_CELLS_H
