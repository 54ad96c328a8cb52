// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The fundamental group of a closed connected surface, read off a triangulation: a tree of shortest paths from a base vertex, a maximum spanning
// tree of the dual graph that does not cross it, and the 2g edges that are in neither, each of which closes a loop through the base: the shortest
// ones there are for this base (Erickson and Whittlesey, "Greedy optimal homotopy and homology generators", 2005). These loops are the generators.
//
// Of every vertex one lift to the universal cover is chosen, such that the tree is lifted, too. Then every halfedge, from i to j, has a *label*: the
// word of the deck transformation for which the lift of the halfedge that begins at the lift of i ends at that of j, transformed. Labels of
// the edges of the tree are empty, those of the other 2g edges are letters, and the product of the three labels around a face is empty.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_LOOP_SYSTEM_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_LOOP_SYSTEM_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/words.h>
#include <CGAL/Conformal_equivalence/internal/Layout/Shortest_path_forest.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/triangulation_graph.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Loop_system
{
public:
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<double> Triangulation;

  std::vector<Word> label;           // by halfedge
  std::vector<Index> tree;           // the halfedges of the tree, away from the base, each after the one before it on its path
  std::vector<Index> generator_edge; // by generator: its direction is that of `edge_halfedge()`
  Word relation;                     // empty in the group: the border of the surface cut along tree and loops
  double length = 0;                 // of all loops together

  // `t` with the lengths of the metric. \pre it is closed and connected
  Loop_system(const Triangulation& t, Index base)
  {
    const std::vector<double> distance = find_tree(t, base);
    find_cotree(t, distance);
    label_edges(t);
    find_relation(t);
  }

  // The best of a few bases, evenly spread over the numbers of the vertices.
  static Loop_system shortest_of(const Triangulation& t, Index number_of_bases)
  {
    Loop_system result(t, 0);
    const Index n = t.number_of_vertices();
    for(Index k = 1; k < (std::min)(number_of_bases, n); ++k)
    {
      Loop_system other(t, Index(std::uint64_t(k) * n / (std::min)(number_of_bases, n)));
      if(other.length < result.length)
        result = std::move(other);
    }
    return result;
  }

private:
  // Marks the edges of the tree. Returns the distances from the base, by vertex.
  std::vector<double> find_tree(const Triangulation& t, Index base)
  {
    std::vector<Path_length<double> > weight;
    for(const double l : t.lengths())
      weight.push_back({0, l});
    std::vector<Index> vertices(t.number_of_vertices());
    std::iota(vertices.begin(), vertices.end(), Index(0));
    const Shortest_path_forest<double> forest = shortest_path_forest(t, weight, vertices, {base});

    std::vector<double> distance;
    for(const Path_length<double>& d : forest.distance)
      distance.push_back(d.length);
    kind_.assign(t.number_of_edges(), Kind::LOOP);
    std::vector<std::vector<Index> > children(t.number_of_vertices());
    for(const Index v : vertices)
    {
      const Graph_edge& last = forest.to_parent[v];
      if(v == base || last.index == t.null_index)
        continue;
      const Index h = t.edge_halfedge(last.index);
      children[last.source].push_back(t.origin(h) == last.source ? h : t.twin(h));
      kind_[last.index] = Kind::TREE;
    }
    std::vector<Index> stack(1, base); // by depth: paths may have equal lengths where edges are shorter than rounding
    while(!stack.empty())
    {
      const Index v = stack.back();
      stack.pop_back();
      for(const Index h : children[v])
      {
        tree.push_back(h);
        stack.push_back(t.target(h));
      }
    }
    return distance;
  }

  // Marks the edges that the dual tree crosses: those with the longest loops first.
  void find_cotree(const Triangulation& t, const std::vector<double>& distance)
  {
    std::vector<Index> edges;
    std::vector<double> loop(t.number_of_edges());
    for(Index e = 0; e < t.number_of_edges(); ++e)
    {
      const Index h = t.edge_halfedge(e);
      loop[e] = distance[t.origin(h)] + t.length(e) + distance[t.target(h)];
      if(kind_[e] != Kind::TREE)
        edges.push_back(e);
    }
    std::sort(edges.begin(), edges.end(), [&](Index x, Index y) { return loop[x] > loop[y] || (loop[x] == loop[y] && x < y); });
    boost::disjoint_sets_with_storage<> pieces(t.number_of_faces());
    for(Index f = 0; f < t.number_of_faces(); ++f)
      pieces.make_set(f);
    for(const Index e : edges)
    {
      const Index f = t.face(t.edge_halfedge(e)), g = t.face(t.twin(t.edge_halfedge(e)));
      if(pieces.find_set(f) == pieces.find_set(g))
        continue;
      pieces.union_set(f, g);
      kind_[e] = Kind::COTREE;
    }
    for(Index e = 0; e < t.number_of_edges(); ++e)
      if(kind_[e] == Kind::LOOP)
      {
        generator_edge.push_back(e);
        length += loop[e];
      }
  }

  // From the leaves of the dual tree to its root: where two sides of a face are known, so is the third.
  void label_edges(const Triangulation& t)
  {
    label.assign(t.number_of_halfedges(), Word());
    for(std::size_t n = 0; n < generator_edge.size(); ++n)
    {
      const Index h = t.edge_halfedge(generator_edge[n]);
      label[h] = Word{std::int32_t(n + 1)};
      label[t.twin(h)] = Word{-std::int32_t(n + 1)};
    }
    std::vector<Index> order; // sides by which faces hang on the dual tree
    std::vector<char> is_seen(t.number_of_faces(), 0);
    std::queue<Index> queue;
    queue.push(0);
    is_seen[0] = 1;
    for(; !queue.empty(); queue.pop())
      for(Index h = 3 * queue.front(); h < 3 * queue.front() + 3; ++h)
      {
        const Index g = t.twin(h);
        if(kind_[t.edge(h)] != Kind::COTREE || is_seen[t.face(g)])
          continue;
        is_seen[t.face(g)] = 1;
        order.push_back(g);
        queue.push(t.face(g));
      }
    for(std::size_t n = order.size(); n > 0; --n)
    {
      const Index h = order[n - 1];
      label[t.twin(h)] = product(label[t.next(h)], label[t.previous(h)]);
      label[h] = inverse(label[t.twin(h)]);
    }
  }

  // Once around the border of the disk that the cut leaves, with the disk on the left.
  void find_relation(const Triangulation& t)
  {
    if(generator_edge.empty())
      return;
    const Index first = t.edge_halfedge(generator_edge.front());
    Index h = first;
    do
    {
      relation = product(relation, label[h]);
      h = t.next(h);
      while(kind_[t.edge(h)] == Kind::COTREE)
        h = t.next(t.twin(h));
    }
    while(h != first);
  }

  enum class Kind : char { TREE, COTREE, LOOP };
  std::vector<Kind> kind_; // by edge
};

// Takes flips back, the last first, and labels the triangulation that they came from: the label of the other diagonal is the product of those of two
// sides of the quadrilateral.
template <typename NT>
void undo_flips(Intrinsic_triangulation<NT>& t, const std::vector<std::uint32_t>& flips, std::vector<Word>& label)
{
  typedef std::uint32_t Index;
  for(std::size_t n = flips.size(); n > 0; --n)
    for(int quarter = 0; quarter < 3; ++quarter) // four flips are none
    {
      const Index e = flips[n - 1], h = t.edge_halfedge(e), g = t.twin(h);
      Word &next_h = label[t.next(h)], &previous_h = label[t.previous(h)], &next_g = label[t.next(g)], &previous_g = label[t.previous(g)];
      label[h] = product(previous_g, next_h); // from l to j, and on to k
      label[g] = inverse(label[h]);
      Word of_next_h = std::move(next_h), of_previous_h = std::move(previous_h), of_next_g = std::move(next_g), of_previous_g = std::move(previous_g);
      // what was next(h), previous(h), next(g), previous(g) becomes previous(g), next(h), previous(h), next(g)
      previous_g = std::move(of_next_h);
      next_h = std::move(of_previous_h);
      previous_h = std::move(of_next_g);
      next_g = std::move(of_previous_g);
      t.flip_edge(e, t.length(e));
    }
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_LOOP_SYSTEM_H
