// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Shortest paths in a triangulation from the nearest of several roots, by Boost's algorithm of Dijkstra.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_SHORTEST_PATH_FOREST_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_SHORTEST_PATH_FOREST_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/triangulation_graph.h>

#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <tuple>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The length of a path. Edges that must not be cut come before everything else: a path
// has one only if there is no other way, which is an error that can then be named.
template <typename NT>
struct Path_length
{
  std::uint32_t number_of_constrained_edges;
  NT length;

  static Path_length zero() { return {0, NT(0)}; }
  static Path_length infinity() { return {(std::numeric_limits<std::uint32_t>::max)(), NT(0)}; }

  friend Path_length operator+(const Path_length& a, const Path_length& b)
  {
    return {a.number_of_constrained_edges + b.number_of_constrained_edges, NT(a.length + b.length)};
  }
  friend bool operator<(const Path_length& a, const Path_length& b)
  {
    return std::tie(a.number_of_constrained_edges, a.length) < std::tie(b.number_of_constrained_edges, b.length);
  }
};

// Shortest paths from the nearest root. A node is a set of vertices in which going costs nothing.
template <typename NT>
struct Shortest_path_forest
{
  std::vector<Path_length<NT> > distance;  // by vertex
  std::vector<Graph_edge> to_parent;       // by node: the last edge of the path, which ends in the node
  std::vector<std::uint32_t> root;         // by node; null_index if there is no path
};

template <typename NT>
class Forest_visitor : public boost::dijkstra_visitor<>
{
  typedef std::uint32_t Index;

public:
  Forest_visitor(const std::vector<Index>& node, std::vector<Graph_edge>& last_edge, Shortest_path_forest<NT>& forest)
    : node_(&node), last_edge_(&last_edge), forest_(&forest)
  {}

  void edge_relaxed(const Graph_edge& e, const Triangulation_graph<NT>&) { (*last_edge_)[e.target] = e; }

  // A node hangs on the path to whichever of its vertices is reached first.
  void examine_vertex(Index v, const Triangulation_graph<NT>&)
  {
    const Index null_index = Intrinsic_triangulation<NT>::null_index, node = (*node_)[v];
    if(forest_->root[node] != null_index)
      return;
    const Graph_edge& last = (*last_edge_)[v];
    forest_->to_parent[node] = last;
    forest_->root[node] = last.index == null_index ? node : forest_->root[(*node_)[last.source]];
  }

private:
  const std::vector<Index>* node_;
  std::vector<Graph_edge>* last_edge_;
  Shortest_path_forest<NT>* forest_;
};

// `node` is by vertex; `sources` holds all vertices of the nodes that are to be roots.
template <typename NT>
Shortest_path_forest<NT> shortest_path_forest(const Intrinsic_triangulation<NT>& t,
                                              const std::vector<Path_length<NT> >& weight,
                                              const std::vector<std::uint32_t>& node,
                                              const std::vector<std::uint32_t>& sources)
{
  typedef std::uint32_t Index;
  typedef Path_length<NT> Length;
  const std::size_t n = t.number_of_vertices();

  Shortest_path_forest<NT> forest;
  forest.distance.resize(n, Length::infinity());
  forest.to_parent.resize(n);
  forest.root.assign(n, t.null_index);
  std::vector<Graph_edge> last_edge(n);

  const auto weight_of_edge = [&](Index e) { return weight[e]; };
  const boost::typed_identity_property_map<Index> vertex_index;
  boost::dijkstra_shortest_paths(
    Triangulation_graph<NT>(t), sources.begin(), sources.end(), boost::dummy_property_map(),
    boost::make_iterator_property_map(forest.distance.begin(), vertex_index),
    make_edge_function_map<Length>(weight_of_edge), vertex_index,
    std::less<Length>(), std::plus<Length>(), Length::infinity(), Length::zero(),
    Forest_visitor<NT>(node, last_edge, forest));
  return forest;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_SHORTEST_PATH_FOREST_H
