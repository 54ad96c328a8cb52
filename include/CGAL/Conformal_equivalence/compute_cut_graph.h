// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file compute_cut_graph.h
/// Where to cut a surface so that it can be laid out: a system of loops opens the handles
/// (Erickson and Whittlesey, 2005), and a tree connects the cones and the borders with it
/// (section 3.3 of Springborn, Schroeder and Pinkall, 2008).
///
/// A border is one node of every tree: going along it costs nothing, and it is never cut.
/// Think of each border as shrunk to a point. What remains is a closed surface, with some
/// vertices that the cut has to visit: the cones and the shrunk borders.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_CUT_GRAPH_H
#define CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_CUT_GRAPH_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/triangulation_graph.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/wedges.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/assertions.h>

#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>
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

// Disjoint sets of indices.
class Partition
{
  typedef std::uint32_t Index;
  std::vector<Index> parent_;

public:
  explicit Partition(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Index(0)); }

  Index find(Index i)
  {
    for(; parent_[i] != i; i = parent_[i])
      parent_[i] = parent_[parent_[i]];
    return i;
  }

  // Returns `false` iff they were one set before.
  bool unite(Index i, Index j)
  {
    i = find(i);
    j = find(j);
    parent_[(std::max)(i, j)] = (std::min)(i, j);
    return i != j;
  }
};

// By wedge: its number if wedges are counted in the order of their vertices.
template <typename NT>
std::vector<std::uint32_t> order_of_wedges(const Intrinsic_triangulation<NT>& t, const Wedges& wedges)
{
  typedef std::uint32_t Index;
  std::vector<Index> vertex(wedges.number_of_wedges), sorted(wedges.number_of_wedges), result(wedges.number_of_wedges);
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
    vertex[wedges.of_corner[h]] = t.target(h);
  std::iota(sorted.begin(), sorted.end(), Index(0));
  std::stable_sort(sorted.begin(), sorted.end(), [&](Index a, Index b) { return vertex[a] < vertex[b]; });
  for(Index i = 0; i < sorted.size(); ++i)
    result[sorted[i]] = i;
  return result;
}

// The surface `t` cut open along `cut`. Its vertices are the wedges, in the order of the vertices of `t`.
// Faces and halfedges keep their numbers, edges do not; all lengths are 1.
template <typename NT>
Intrinsic_triangulation<NT> cut_open(const Intrinsic_triangulation<NT>& t, const Cut_graph& cut)
{
  typedef std::uint32_t Index;
  const Wedges wedges = find_wedges(t, cut);
  const std::vector<Index> number = order_of_wedges(t, wedges);
  std::vector<Index> origin(t.number_of_halfedges()), twin(t.number_of_halfedges());
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    origin[h] = number[wedges.of_corner[t.previous(h)]];
    twin[h] = cut[t.edge(h)] ? t.null_index : t.twin(h);
  }
  return Intrinsic_triangulation<NT>(wedges.number_of_wedges, std::move(origin), std::move(twin));
}

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

// The conditions on the edges, read from the property maps.
template <typename NT>
struct Seam_conditions
{
  Cut_graph prescribed;             // edges that are cut in any case
  std::vector<char> is_constrained; // by edge of the input
  std::vector<NT> weight;           // by edge of the input
};

template <typename Value, typename Tag, typename NamedParameters, typename Default_value>
std::vector<Value> read_interior_edges(std::uint32_t number_of_edges, Tag tag, const NamedParameters& np, Default_value default_value)
{
  CGAL_USE(tag);
  CGAL_USE(np);
  std::vector<Value> result;
  result.reserve(number_of_edges);
  for(std::uint32_t e = 0; e < number_of_edges; ++e)
  {
    if constexpr(parameters::is_default_parameter<NamedParameters, Tag>::value)
      result.push_back(default_value(e));
    else
      result.push_back(static_cast<Value>(get(parameters::get_parameter(np, tag), e)));
  }
  return result;
}

// Reads the maps; the status of `prescribed` tells whether they make sense.
template <typename NT, typename NamedParameters>
Seam_conditions<NT> read_seam_conditions(const Intrinsic_triangulation<NT>& t, const NamedParameters& np)
{
  const std::uint32_t n = t.number_of_edges();
  const auto no = [](std::uint32_t) { return char(0); };
  Seam_conditions<NT> result;
  result.prescribed.is_cut = read_interior_edges<char>(n, internal_np::conformal_edge_is_seam, np, no);
  result.is_constrained = read_interior_edges<char>(n, internal_np::edge_is_constrained, np, no);
  result.weight = read_interior_edges<NT>(n, internal_np::conformal_seam_weight, np,
                                          [&](std::uint32_t e) { return t.length(e); });

  std::vector<std::uint32_t> invalid, contradictory;
  for(std::uint32_t e = 0; e < n; ++e)
  {
    const NT& w = result.weight[e];
    if(t.is_border_edge(e))
      result.prescribed.is_cut[e] = 0;
    else if(!(w >= NT(0)) || !(w - w == NT(0)))
      invalid.push_back(e);
    else if(result.prescribed.is_cut[e] && result.is_constrained[e])
      contradictory.push_back(e);
  }
  if(!invalid.empty())
    result.prescribed.status = Status::INVALID_NUMBER;
  else if(!contradictory.empty())
    result.prescribed.status = Status::WRONG_TOPOLOGY;
  result.prescribed.edges = invalid.empty() ? std::move(contradictory) : std::move(invalid);
  return result;
}

// A cut that could not be made.
inline Cut_graph failed_cut(Status status, std::vector<std::uint32_t> edges, std::vector<std::uint32_t> faces)
{
  Cut_graph result;
  result.status = status;
  result.edges = std::move(edges);
  result.faces = std::move(faces);
  return result;
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceLayout
///
/// finds edges along which `input` is to be cut so that every component becomes a disk with all cones
/// on its border: it has Euler characteristic 1 and one border, and can be laid out once its metric is flat
/// except at the cones.
///
/// In every component of genus g > 0, first a *system of loops* is found: 2g loops with a common base, the shortest ones
/// for this base, by the greedy algorithm of Erickson and Whittlesey (2005), a tree of shortest paths from the base and
/// a maximum spanning tree of the dual graph that does not cross it. The base is a border if there is
/// one (that of the first border vertex; loops then begin and end anywhere on it), else the cone with the smallest index, else the vertex
/// with the smallest index; in the last case, where nothing requires the base to be on the cut, it moves to the nearest
/// vertex where the loops part. Then a *cone spanning tree* connects cones, borders and the system of loops, of which each border and the
/// system count as one node (section 3.3 of Springborn, Schroeder and Pinkall, 2008). It is a minimum spanning tree for
/// the distances between these nodes, at most twice as long as the shortest tree there is.
///
/// The cut ends nowhere but at cones and borders, and none of its paths can be left out. This does not hold
/// for edges that are prescribed by `edge_is_seam_map`: they are cut as they are, and each of the pieces that they leave is treated as
/// a component.
///
/// O(n log n), plus the length of the loops.
///
/// \tparam NT number type of the lengths
/// \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
///
/// \param input a surface of any topology, with any number of components; isolated vertices are ignored
/// \param cones the vertices that must come to lie on the border, by index. Cones on a border or a prescribed seam lie there
///        already; one that is listed twice counts once.
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below.
///        Keys are indices of edges of `input`.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{seam_weight_map}
///     \cgalParamDescription{what it costs to cut an edge: finite and not negative. Seams prefer edges of small weight.}
///     \cgalParamType{a readable property map with key type `std::uint32_t` and a value type convertible to `NT`}
///     \cgalParamDefault{the lengths}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_is_seam_map}
///     \cgalParamDescription{`true` for edges that are cut in any case. Border edges are ignored.}
///     \cgalParamType{a readable property map with key type `std::uint32_t` and value type `bool`}
///     \cgalParamDefault{`false` for all edges}
///     \cgalParamExtra{Not written; the result holds all edges that are cut.}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_is_constrained_map}
///     \cgalParamDescription{`true` for edges that must not be cut. Paths may cross them at a vertex. Border edges are ignored.}
///     \cgalParamType{a readable property map with key type `std::uint32_t` and value type `bool`}
///     \cgalParamDefault{`false` for all edges}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the edges to cut, prescribed ones included, and the system of loops. `Cut_graph::is_cut` is empty unless the status is `OK`. It is
///         - `EMPTY_MESH` if there is no face;
///         - `INVALID_NUMBER` if `Cut_graph::edges` have a weight that is negative or not finite;
///         - `WRONG_TOPOLOGY` with edges if these are prescribed as well as constrained; or if no cut can do without
///           constrained edges, `Cut_graph::edges` being those that are in the way of the best one;
///         - `WRONG_TOPOLOGY` with faces if they lie on spheres with fewer than two cones. Nothing of such a sphere could be
///           cut that ends at cones; with one cone or none there is no flat metric on it either (Gauss-Bonnet).
///           A prescribed edge makes it a disk.
///
/// \pre `cones` are less than `input.number_of_vertices()`; no vertex is in `non_manifold_vertices(input)`.
/// \sa `CGAL::Conformal_equivalence::compute_layout()`
/// \sa `CGAL::Conformal_equivalence::make_seam_mesh()`
template <typename NT, typename NamedParameters = parameters::Default_named_parameters>
Cut_graph compute_cut_graph(const Intrinsic_triangulation<NT>& input,
                            const std::vector<std::uint32_t>& cones,
                            const NamedParameters& np = parameters::default_values())
{
  typedef std::uint32_t Index;
  if(input.number_of_faces() == 0)
    return internal::failed_cut(Status::EMPTY_MESH, {}, {});
  internal::Seam_conditions<NT> conditions = internal::read_seam_conditions(input, np);
  Cut_graph& cut = conditions.prescribed;
  if(cut.status != Status::OK)
    return internal::failed_cut(cut.status, cut.edges, {});

  // From here on, what is prescribed is a border.
  const Intrinsic_triangulation<NT> t = internal::cut_open(input, cut);
  const auto edge_of_input = [&](Index e) { return input.edge(t.edge_halfedge(e)); };
  std::vector<internal::Path_length<NT> > weight(t.number_of_edges(), internal::Path_length<NT>::zero());
  for(Index e = 0; e < t.number_of_edges(); ++e)
    if(!t.is_border_edge(e))
      weight[e] = {conditions.is_constrained[edge_of_input(e)] ? 1u : 0u, conditions.weight[edge_of_input(e)]};
  std::vector<char> is_cone(t.number_of_vertices(), 0);
  for(Index v : cones)
  {
    CGAL_precondition(v < input.number_of_vertices());
    if(!input.is_isolated_vertex(v))
      is_cone[t.origin(input.vertex_halfedge(v))] = 1;
  }

  internal::Cut_finder<NT> finder(t, weight, is_cone);
  if(!finder.faces_of_spheres.empty())
    return internal::failed_cut(Status::WRONG_TOPOLOGY, {}, std::move(finder.faces_of_spheres));
  std::vector<Index> forbidden;
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    if(!finder.is_cut[e])
      continue;
    cut.is_cut[edge_of_input(e)] = 1;
    if(weight[e].number_of_constrained_edges > 0)
      forbidden.push_back(edge_of_input(e));
  }
  if(!forbidden.empty())
    return internal::failed_cut(Status::WRONG_TOPOLOGY, std::move(forbidden), {});
  cut.loops = std::move(finder.loops);
  return std::move(cut);
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_CUT_GRAPH_H
