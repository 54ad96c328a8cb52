// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A basis of the first homology of a surface: 2 g closed curves across edges (Dual_loops.h), and b - 1 more if there are b borders.
//
// By a tree and a cotree (Eppstein, "Dynamic generators of topologically embedded graphs", 2003; Erickson and Whittlesey, "Greedy optimal homotopy
// and homology generators", 2005): a spanning tree of the vertices, a spanning tree of the faces that crosses none of its edges; 2 g edges
// are left, each of which closes one curve in the tree of the faces. Trees of vertices begin at all border vertices at once, as if these were one.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_HOMOLOGY_BASIS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_HOMOLOGY_BASIS_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The edges of a spanning tree of the vertices of each component, by breadth, where all border vertices count as one.
template <typename NT>
std::vector<char> vertex_tree(const Intrinsic_triangulation<NT>& t)
{
  typedef std::uint32_t Index;
  std::vector<char> is_in_tree(t.number_of_edges(), 0), is_reached(t.number_of_vertices(), 0);
  const auto grow = [&](std::vector<Index> reached)
  {
    for(Index root : reached)
      is_reached[root] = 1;
    for(std::size_t k = 0; k < reached.size(); ++k)
      t.for_each_outgoing(reached[k], [&](Index h)
      {
        if(is_reached[t.target(h)])
          return;
        is_reached[t.target(h)] = 1;
        is_in_tree[t.edge(h)] = 1;
        reached.push_back(t.target(h));
      });
  };
  std::vector<Index> border;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(t.is_border_vertex(v))
      border.push_back(v);
  grow(std::move(border));
  for(Index root = 0; root < t.number_of_vertices(); ++root)
    if(!is_reached[root])
      grow(std::vector<Index>(1, root));
  return is_in_tree;
}

// A spanning tree of the faces of each component, by breadth, that crosses no edge of another tree.
template <typename NT>
class Face_tree
{
  typedef std::uint32_t Index;

public:
  // `is_forbidden`: the edges that are not crossed
  Face_tree(const Intrinsic_triangulation<NT>& t, const std::vector<char>& is_forbidden)
    : t_(t), entered_(t.number_of_faces(), t.null_index), depth_(t.number_of_faces(), 0), is_crossed_(t.number_of_edges(), 0)
  {
    std::vector<char> is_reached(t.number_of_faces(), 0);
    std::vector<Index> reached;
    for(Index root = 0; root < t.number_of_faces(); ++root)
    {
      if(is_reached[root])
        continue;
      is_reached[root] = 1;
      reached.assign(1, root);
      for(std::size_t k = 0; k < reached.size(); ++k)
        for(Index h = 3 * reached[k]; h < 3 * reached[k] + 3; ++h)
        {
          const Index g = t.twin(h);
          if(t.is_border(h) || is_forbidden[t.edge(h)] || is_reached[t.face(g)])
            continue;
          is_reached[t.face(g)] = 1;
          is_crossed_[t.edge(h)] = 1;
          entered_[t.face(g)] = g;
          depth_[t.face(g)] = depth_[reached[k]] + 1;
          reached.push_back(t.face(g));
        }
    }
  }

  bool is_crossed(Index e) const { return is_crossed_[e] != 0; }

  // The curve across `h`, from its face to that of its twin, and back through the tree.
  std::vector<Index> loop(Index h) const
  {
    std::vector<Index> up(1, t_.twin(h)), down;
    Index from = t_.face(t_.twin(h)), to = t_.face(h);
    while(from != to)
      if(depth_[from] >= depth_[to])
      {
        up.push_back(t_.twin(entered_[from]));
        from = t_.face(up.back());
      }
      else
      {
        down.push_back(entered_[to]);
        to = t_.face(t_.twin(entered_[to]));
      }
    up.insert(up.end(), down.rbegin(), down.rend());
    return up;
  }

private:
  const Intrinsic_triangulation<NT>& t_;
  std::vector<Index> entered_; // by face: through which side, from its parent
  std::vector<Index> depth_;
  std::vector<char> is_crossed_;
};

// Linear time, and the sum of the lengths. \pre `t` is closed, or connected
template <typename NT>
std::vector<std::vector<std::uint32_t> > homology_basis(const Intrinsic_triangulation<NT>& t)
{
  const std::vector<char> is_in_tree = vertex_tree(t);
  const Face_tree<NT> faces(t, is_in_tree);
  std::vector<std::vector<std::uint32_t> > result;
  for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
    if(!is_in_tree[e] && !faces.is_crossed(e) && !t.is_border_edge(e))
      result.push_back(faces.loop(t.edge_halfedge(e)));
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_HOMOLOGY_BASIS_H
