// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_BOX_TREE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_BOX_TREE_H

#include <CGAL/Conformal_equivalence/internal/Overlay/Box.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The boxes that hold a point: a binary tree over boxes, each half as many as above. One that is not finite holds none.
template <std::size_t dimension>
class Box_tree
{
  typedef internal::Box<dimension> Box;
  typedef typename Box::Point Point;

public:
  explicit Box_tree(std::vector<Box> boxes = std::vector<Box>()) : boxes_(std::move(boxes)), node_(boxes_.size()), order_(boxes_.size())
  {
    for(Box& box : boxes_)
      if(!box.is_finite()) // could not be compared
      {
        box.low.fill(0);
        box.high.fill(-1);
      }
    std::iota(order_.begin(), order_.end(), 0);
    if(!order_.empty())
      build(0, order_.size());
  }

  template <typename Visit>
  void for_each_around(const Point& p, Visit visit) const
  {
    find(0, order_.size(), p, visit);
  }

private:
  Box build(std::size_t begin, std::size_t end)
  {
    Box all = boxes_[order_[begin]];
    for(std::size_t i = begin + 1; i < end; ++i)
      all.unite(boxes_[order_[i]]);
    const std::size_t middle = (begin + end) / 2, axis = all.longest_axis();
    const auto at = [&](std::size_t i) { return order_.begin() + std::ptrdiff_t(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t i, std::uint32_t j)
      { return boxes_[i].low[axis] + boxes_[i].high[axis] < boxes_[j].low[axis] + boxes_[j].high[axis]; });
    node_[middle] = all;
    if(begin < middle)
      build(begin, middle);
    if(middle + 1 < end)
      build(middle + 1, end);
    return all;
  }

  template <typename Visit>
  void find(std::size_t begin, std::size_t end, const Point& p, Visit& visit) const
  {
    const std::size_t middle = (begin + end) / 2;
    if(begin == end || !node_[middle].contains(p))
      return;
    if(boxes_[order_[middle]].contains(p))
      visit(order_[middle]);
    find(begin, middle, p, visit);
    find(middle + 1, end, p, visit);
  }

  std::vector<Box> boxes_;           // by element
  std::vector<Box> node_;            // the range [begin, end) has the node (begin + end) / 2: no two ranges have the same
  std::vector<std::uint32_t> order_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_BOX_TREE_H
