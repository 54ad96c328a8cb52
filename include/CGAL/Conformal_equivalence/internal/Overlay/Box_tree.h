// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_BOX_TREE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_BOX_TREE_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The boxes that hold a point of the plane: a binary tree over boxes, each half as many as above.
class Box_tree
{
  typedef std::array<double, 4> Box; // least x and y, greatest x and y
  std::vector<Box> boxes_;           // by element
  std::vector<Box> node_;            // the range [begin, end) has the node (begin + end) / 2: no two ranges have the same
  std::vector<std::uint32_t> order_;

public:
  explicit Box_tree(std::vector<Box> boxes) : boxes_(std::move(boxes)), node_(boxes_.size()), order_(boxes_.size())
  {
    for(std::uint32_t i = 0; i < order_.size(); ++i)
      order_[i] = i;
    if(!order_.empty())
      build(0, order_.size());
  }

  template <typename Visit>
  void for_each_around(double x, double y, Visit visit) const
  {
    if(!order_.empty())
      find(0, order_.size(), x, y, visit);
  }

private:
  Box build(std::size_t begin, std::size_t end)
  {
    Box all = boxes_[order_[begin]];
    for(std::size_t i = begin + 1; i < end; ++i)
      all = united(all, boxes_[order_[i]]);
    const std::size_t middle = (begin + end) / 2, axis = all[2] - all[0] < all[3] - all[1] ? 1 : 0;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](std::uint32_t i, std::uint32_t j)
      { return boxes_[i][axis] + boxes_[i][axis + 2] < boxes_[j][axis] + boxes_[j][axis + 2]; });
    node_[middle] = all;
    if(begin < middle)
      build(begin, middle);
    if(middle + 1 < end)
      build(middle + 1, end);
    return all;
  }

  template <typename Visit>
  void find(std::size_t begin, std::size_t end, double x, double y, Visit& visit) const
  {
    const std::size_t middle = (begin + end) / 2;
    if(begin == end || !contains(node_[middle], x, y))
      return;
    if(contains(boxes_[order_[middle]], x, y))
      visit(order_[middle]);
    find(begin, middle, x, y, visit);
    find(middle + 1, end, x, y, visit);
  }

  static Box united(const Box& a, const Box& b)
  {
    return {{ (std::min)(a[0], b[0]), (std::min)(a[1], b[1]), (std::max)(a[2], b[2]), (std::max)(a[3], b[3]) }};
  }

  static bool contains(const Box& b, double x, double y) { return b[0] <= x && x <= b[2] && b[1] <= y && y <= b[3]; }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_BOX_TREE_H
