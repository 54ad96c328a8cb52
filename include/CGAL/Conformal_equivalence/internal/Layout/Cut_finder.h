// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The cut along which a surface of any topology becomes a disk with all cones on its border: a system of loops opens the handles (Erickson
// and Whittlesey, 2005), and a tree connects the cones and the borders with it (section 3.3 of Springborn, Schroeder and Pinkall, 2008).
//
// A border is one node of every tree: going along it costs nothing, and it is never cut.
// Think of each border as shrunk to a point. What remains is a closed surface, with some
// vertices that the cut has to visit: the cones and the shrunk borders.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_CUT_FINDER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_CUT_FINDER_H

#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Layout/Seam_conditions.h>
#include <CGAL/Conformal_equivalence/internal/Layout/Shortest_path_forest.h>
#include <CGAL/Conformal_equivalence/internal/Layout/cut_open.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/triangulation_graph.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <CGAL/assertions.h>

#include <CGAL/Union_find.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Disjoint sets of indices, each at first on its own. (Boost's sets do not compile after some of its graphs have been included.)
class Partition
{
  typedef std::uint32_t Index;
  typedef CGAL::Union_find<Index> Sets;
  Sets sets_;
  std::vector<Sets::handle> handle_; // by index

public:
  explicit Partition(std::size_t n)
  {
    handle_.reserve(n);
    for(std::size_t i = 0; i < n; ++i)
      handle_.push_back(sets_.make_set(Index(i)));
  }

  // A member of the set of `i`, the same for all of its members.
  Index find(Index i) { return *sets_.find(handle_[i]); }

  // Returns `false` iff they were one set before.
  bool unite(Index i, Index j)
  {
    const bool are_two = !sets_.same_set(handle_[i], handle_[j]);
    if(are_two)
      sets_.unify_sets(handle_[i], handle_[j]);
    return are_two;
  }
};

// The cut of a surface none of whose edges is cut yet.
template <typename NT>
class Cut_finder
{
  typedef std::uint32_t Index;
  typedef Path_length<NT> Length;
  typedef std::pair<Length, Index> Weighted_edge;
  typedef std::vector<Index> Chain; // of halfedges

  const Intrinsic_triangulation<NT>& t_;
  const std::vector<Length>& weight_;   // by edge; zero on borders
  const std::vector<char>& is_cone_;    // by vertex
  const Surface_components pieces_;
  Partition nodes_;                     // of the vertices: what is connected without cutting more

public:
  std::vector<char> is_cut;             // by edge
  std::vector<Chain> loops;
  std::vector<Index> faces_of_spheres;  // with nothing to cut to: one face each

  Cut_finder(const Intrinsic_triangulation<NT>& t, const std::vector<Length>& weight, const std::vector<char>& is_cone)
    : t_(t), weight_(weight), is_cone_(is_cone), pieces_(connected_components(t)),
      nodes_(t.number_of_vertices()), is_cut(t.number_of_edges(), 0)
  {
    for(Index h = 0; h < t_.number_of_halfedges(); ++h)
      if(t_.is_border(h))
        nodes_.unite(t_.origin(h), t_.target(h));
    open_handles();
    connect_nodes();
  }

private:
  const Surface_components::Component& component(Index c) const { return pieces_.components[c]; }
  Index component_of_vertex(Index v) const { return pieces_.component_of_vertex[v]; }
  Index component_of_edge(Index e) const { return component_of_vertex(t_.origin(t_.edge_halfedge(e))); }

  std::vector<Index> nodes()
  {
    std::vector<Index> node(t_.number_of_vertices());
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      node[v] = nodes_.find(v);
    return node;
  }

  // ---- Handles: a greedy system of loops in every component that has some.

  void open_handles()
  {
    const std::vector<Index> node = nodes(), base = base_nodes(node);
    std::vector<Index> sources;
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      if(base[component_of_vertex(v)] == node[v])
        sources.push_back(v);
    if(sources.empty())
      return;
    const Shortest_path_forest<NT> forest = shortest_path_forest(t_, weight_, node, sources);
    std::vector<std::vector<Chain> > loops_of_component(pieces_.components.size());
    for(Index e : generators(node, forest))
      loops_of_component[component_of_edge(e)].push_back(loop(t_.edge_halfedge(e), node, forest));

    for(Index c = 0; c < pieces_.components.size(); ++c)
    {
      if(base[c] != t_.null_index && component(c).number_of_borders == 0 && !is_cone_[base[c]])
        remove_common_stem(loops_of_component[c]);
      for(Chain& chain : loops_of_component[c])
        cut_loop(std::move(chain));
    }
  }

  // For a component with handles a border, else the first cone, else the first vertex.
  std::vector<Index> base_nodes(const std::vector<Index>& node) const
  {
    std::vector<Index> base(pieces_.components.size(), t_.null_index);
    std::vector<int> rank(base.size(), -1);
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
    {
      const Index c = component_of_vertex(v);
      const int rank_of_v = t_.is_border_vertex(v) ? 2 : is_cone_[v] ? 1 : 0;
      if(component(c).genus() == 0 || rank_of_v <= rank[c])
        continue;
      rank[c] = rank_of_v;
      base[c] = node[v];
    }
    return base;
  }

  // The edges that neither the tree of shortest paths nor the spanning tree of the dual holds which crosses
  // the longest loops: 2g of them.
  std::vector<Index> generators(const std::vector<Index>& node, const Shortest_path_forest<NT>& forest) const
  {
    std::vector<char> is_in_tree(t_.number_of_edges(), 0);
    for(const Graph_edge& e : forest.to_parent)
      if(e.index != t_.null_index)
        is_in_tree[e.index] = 1;

    std::vector<Weighted_edge> candidates;
    for(Index e = 0; e < t_.number_of_edges(); ++e)
      if(!t_.is_border_edge(e) && !is_in_tree[e] && forest.root[node[t_.origin(t_.edge_halfedge(e))]] != t_.null_index)
        candidates.emplace_back(length_through(e, forest), e);
    std::sort(candidates.begin(), candidates.end(), [](const Weighted_edge& a, const Weighted_edge& b) { return b < a; });

    Partition faces(t_.number_of_faces());
    std::vector<Index> result;
    for(const Weighted_edge& candidate : candidates)
    {
      const Index h = t_.edge_halfedge(candidate.second);
      if(!faces.unite(t_.face(h), t_.face(t_.twin(h))))
        result.push_back(candidate.second);
    }
    std::reverse(result.begin(), result.end()); // the shortest loop first
    return result;
  }

  // The length of the shortest path between roots that ends with `e` from both sides.
  Length length_through(Index e, const Shortest_path_forest<NT>& forest) const
  {
    const Index h = t_.edge_halfedge(e);
    return forest.distance[t_.origin(h)] + weight_[e] + forest.distance[t_.target(h)];
  }

  // From the root to `h`, across it and back to the root.
  Chain loop(Index h, const std::vector<Index>& node, const Shortest_path_forest<NT>& forest) const
  {
    Chain result = path_to_root(node[t_.origin(h)], node, forest);
    std::reverse(result.begin(), result.end());
    for(Index& g : result)
      g = t_.twin(g);
    result.push_back(h);
    const Chain back = path_to_root(node[t_.target(h)], node, forest);
    result.insert(result.end(), back.begin(), back.end());
    return result;
  }

  Chain path_to_root(Index n, const std::vector<Index>& node, const Shortest_path_forest<NT>& forest) const
  {
    Chain result;
    for(Graph_edge e = forest.to_parent[n]; e.index != t_.null_index; e = forest.to_parent[node[e.source]])
    {
      const Index h = t_.edge_halfedge(e.index);
      result.push_back(t_.origin(h) == e.target ? h : t_.twin(h));
    }
    return result;
  }

  // A base vertex that need not be on the cut moves to where the loops part.
  void remove_common_stem(std::vector<Chain>& chains) const
  {
    const Chain& first = chains.front();
    std::size_t stem = 0;
    const auto begins_and_ends_with_stem = [&](const Chain& chain)
    {
      return 2 * stem + 2 < chain.size() && chain[stem] == first[stem]
          && chain[chain.size() - 1 - stem] == t_.twin(first[stem]);
    };
    while(std::all_of(chains.begin(), chains.end(), begins_and_ends_with_stem))
      ++stem;
    for(Chain& chain : chains)
      chain = Chain(chain.begin() + std::ptrdiff_t(stem), chain.end() - std::ptrdiff_t(stem));
  }

  void cut_loop(Chain chain)
  {
    for(Index h : chain)
    {
      is_cut[t_.edge(h)] = 1;
      nodes_.unite(t_.origin(h), t_.target(h));
    }
    loops.push_back(std::move(chain));
  }

  // ---- Cones and borders: a short tree that connects them with each other and with the loops. From all of
  // them at once paths are grown; where two meet is a bridge, and the shortest bridges that close no
  // circle make a spanning tree of minimal length among those of the terminals (Mehlhorn, 1988).

  void connect_nodes()
  {
    const std::vector<Index> node = nodes(), sources = terminals_to_connect(node);
    if(sources.empty())
      return;
    const Shortest_path_forest<NT> forest = shortest_path_forest(t_, weight_, node, sources);
    const auto root_of_vertex = [&](Index v) { return forest.root[node[v]]; };
    std::vector<Weighted_edge> bridges;
    for(Index e = 0; e < t_.number_of_edges(); ++e)
    {
      const Index h = t_.edge_halfedge(e);
      if(root_of_vertex(t_.origin(h)) != root_of_vertex(t_.target(h)))
        bridges.emplace_back(length_through(e, forest), e);
    }
    std::sort(bridges.begin(), bridges.end());
    for(const Weighted_edge& bridge : bridges)
    {
      const Index h = t_.edge_halfedge(bridge.second);
      if(!nodes_.unite(root_of_vertex(t_.origin(h)), root_of_vertex(t_.target(h))))
        continue;
      is_cut[bridge.second] = 1;
      cut_to_root(node[t_.origin(h)], node, forest);
      cut_to_root(node[t_.target(h)], node, forest);
    }
  }

  // The vertices of cones, borders and loops, in components that have more than one of these.
  std::vector<Index> terminals_to_connect(const std::vector<Index>& node)
  {
    const std::vector<char> is_terminal = terminal_nodes(node);
    std::vector<std::size_t> number_of_terminals(pieces_.components.size(), 0);
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      if(is_terminal[v])
        ++number_of_terminals[component_of_vertex(v)];

    for(Index c = 0; c < pieces_.components.size(); ++c)
      if(component(c).genus() == 0 && component(c).number_of_borders == 0 && number_of_terminals[c] < 2)
        faces_of_spheres.push_back(component(c).first_face);

    std::vector<Index> result;
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      if(is_terminal[node[v]] && number_of_terminals[component_of_vertex(v)] > 1)
        result.push_back(v);
    return result;
  }

  // By node, which is the index of one of its vertices.
  std::vector<char> terminal_nodes(const std::vector<Index>& node) const
  {
    std::vector<char> result(t_.number_of_vertices(), 0);
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      if(is_cone_[v] || t_.is_border_vertex(v))
        result[node[v]] = 1;
    for(const Chain& chain : loops)
      result[node[t_.origin(chain.front())]] = 1;
    return result;
  }

  void cut_to_root(Index n, const std::vector<Index>& node, const Shortest_path_forest<NT>& forest)
  {
    for(Graph_edge e = forest.to_parent[n]; e.index != t_.null_index && !is_cut[e.index];
        e = forest.to_parent[node[e.source]])
      is_cut[e.index] = 1;
  }
};

// What it costs to cut an edge of `t`, which is `input` cut open; nothing on borders.
template <typename NT>
std::vector<Path_length<NT> > cutting_weights(const Intrinsic_triangulation<NT>& input, const Intrinsic_triangulation<NT>& t,
                                              const Seam_conditions<NT>& conditions)
{
  std::vector<Path_length<NT> > weight(t.number_of_edges(), Path_length<NT>::zero());
  for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
  {
    const std::uint32_t given = input.edge(t.edge_halfedge(e));
    if(!t.is_border_edge(e))
      weight[e] = {conditions.is_constrained[given] ? 1u : 0u, conditions.weight[given]};
  }
  return weight;
}

// By vertex of `t`, which is `input` cut open: whether it is one of the cones, or of several copies of a cone the one that stands for it.
template <typename NT>
std::vector<char> cones_of_open_surface(const Intrinsic_triangulation<NT>& input, const Intrinsic_triangulation<NT>& t,
                                        const std::vector<std::uint32_t>& cones)
{
  std::vector<char> is_cone(t.number_of_vertices(), 0);
  for(std::uint32_t v : cones)
  {
    CGAL_precondition(v < input.number_of_vertices());
    if(!input.is_isolated_vertex(v))
      is_cone[t.origin(input.vertex_halfedge(v))] = 1;
  }
  return is_cone;
}

// The edges that are cut under these conditions, which must make sense.
template <typename NT>
Cut_graph find_cut(const Intrinsic_triangulation<NT>& input, const std::vector<std::uint32_t>& cones, Seam_conditions<NT> conditions)
{
  typedef std::uint32_t Index;
  Cut_graph& cut = conditions.prescribed;
  // From here on, what is prescribed is a border.
  const Intrinsic_triangulation<NT> t = cut_open(input, cut);
  const std::vector<Path_length<NT> > weight = cutting_weights(input, t, conditions);
  const std::vector<char> is_cone = cones_of_open_surface(input, t, cones);

  Cut_finder<NT> finder(t, weight, is_cone);
  if(!finder.faces_of_spheres.empty())
    return failed_cut(Status::WRONG_TOPOLOGY, {}, std::move(finder.faces_of_spheres));
  std::vector<Index> forbidden;
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    if(!finder.is_cut[e])
      continue;
    cut.is_cut[input.edge(t.edge_halfedge(e))] = 1;
    if(weight[e].number_of_constrained_edges > 0)
      forbidden.push_back(input.edge(t.edge_halfedge(e)));
  }
  if(!forbidden.empty())
    return failed_cut(Status::WRONG_TOPOLOGY, std::move(forbidden), {});
  cut.loops = std::move(finder.loops);
  return std::move(cut);
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template Cut_graph find_cut(const Intrinsic_triangulation<double>&, const std::vector<std::uint32_t>&, Seam_conditions<double>);
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_CUT_FINDER_H
