// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A triangulation as the Boost Graph Library sees it: vertices are indices, and an
// edge knows its index, so that several edges may join the same vertices and an edge
// may join a vertex to itself.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGULATION_TRIANGULATION_GRAPH_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGULATION_TRIANGULATION_GRAPH_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/iterator/counting_iterator.hpp>
#include <boost/iterator/iterator_facade.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <cstdint>
#include <utility>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// An edge, seen from one of its ends. Both views are the same edge.
struct Graph_edge
{
  std::uint32_t index = Intrinsic_triangulation<>::null_index;
  std::uint32_t source = Intrinsic_triangulation<>::null_index;
  std::uint32_t target = Intrinsic_triangulation<>::null_index;

  friend bool operator==(const Graph_edge& a, const Graph_edge& b) { return a.index == b.index; }
  friend bool operator!=(const Graph_edge& a, const Graph_edge& b) { return !(a == b); }
};

// Counterclockwise around a vertex, along the halfedges that begin there. A border
// vertex has one edge more, of which only the halfedge that ends there exists.
template <typename NT>
class Out_edge_iterator
  : public boost::iterator_facade<Out_edge_iterator<NT>, Graph_edge, std::forward_iterator_tag, Graph_edge>
{
  typedef std::uint32_t Index;
  static constexpr Index null_index = Intrinsic_triangulation<NT>::null_index;

public:
  Out_edge_iterator() = default;

  Out_edge_iterator(const Intrinsic_triangulation<NT>& t, Index v)
    : t_(&t), first_(t.vertex_halfedge(v)), h_(first_)
  {}

  static Out_edge_iterator past_the_end() { return Out_edge_iterator(); }

private:
  friend class boost::iterator_core_access;

  Graph_edge dereference() const
  {
    if(is_incoming_)
      return Graph_edge{t_->edge(h_), t_->target(h_), t_->origin(h_)};
    return Graph_edge{t_->edge(h_), t_->origin(h_), t_->target(h_)};
  }

  void increment()
  {
    const Index next = is_incoming_ ? first_ : t_->next_around_origin(h_);
    if(next == first_)
    {
      h_ = null_index;
      is_incoming_ = false;
    }
    else if(next == null_index)
    {
      h_ = t_->previous(h_);
      is_incoming_ = true;
    }
    else
      h_ = next;
  }

  bool equal(const Out_edge_iterator& other) const { return h_ == other.h_ && is_incoming_ == other.is_incoming_; }

  const Intrinsic_triangulation<NT>* t_ = nullptr;
  Index first_ = null_index, h_ = null_index;
  bool is_incoming_ = false;
};

// Every edge once, from the origin of `edge_halfedge(e)`.
template <typename NT>
class Edge_iterator
  : public boost::iterator_facade<Edge_iterator<NT>, Graph_edge, std::forward_iterator_tag, Graph_edge>
{
  typedef std::uint32_t Index;

public:
  Edge_iterator() = default;
  Edge_iterator(const Intrinsic_triangulation<NT>& t, Index e) : t_(&t), e_(e) {}

private:
  friend class boost::iterator_core_access;

  Graph_edge dereference() const
  {
    const Index h = t_->edge_halfedge(e_);
    return Graph_edge{e_, t_->origin(h), t_->target(h)};
  }
  void increment() { ++e_; }
  bool equal(const Edge_iterator& other) const { return e_ == other.e_; }

  const Intrinsic_triangulation<NT>* t_ = nullptr;
  Index e_ = 0;
};

struct Triangulation_graph_category
  : public virtual boost::incidence_graph_tag,
    public virtual boost::vertex_list_graph_tag,
    public virtual boost::edge_list_graph_tag
{};

// Model of `IncidenceGraph`, `VertexListGraph` and `EdgeListGraph`. Refers to the
// triangulation.
template <typename NT>
class Triangulation_graph
{
public:
  typedef std::uint32_t                           vertex_descriptor;
  typedef Graph_edge                              edge_descriptor;
  typedef boost::undirected_tag                   directed_category;
  typedef boost::allow_parallel_edge_tag          edge_parallel_category;
  typedef Triangulation_graph_category            traversal_category;
  typedef boost::counting_iterator<std::uint32_t> vertex_iterator;
  typedef Edge_iterator<NT>                       edge_iterator;
  typedef Out_edge_iterator<NT>                   out_edge_iterator;
  typedef void                                    adjacency_iterator;
  typedef void                                    in_edge_iterator;
  typedef std::size_t                             vertices_size_type;
  typedef std::size_t                             edges_size_type;
  typedef std::size_t                             degree_size_type;

  static vertex_descriptor null_vertex() { return Intrinsic_triangulation<NT>::null_index; }

  explicit Triangulation_graph(const Intrinsic_triangulation<NT>& t) : t_(&t) {}

  const Intrinsic_triangulation<NT>& triangulation() const { return *t_; }

  friend std::size_t num_vertices(const Triangulation_graph& g) { return g.t_->number_of_vertices(); }
  friend std::size_t num_edges(const Triangulation_graph& g) { return g.t_->number_of_edges(); }

  friend std::pair<vertex_iterator, vertex_iterator> vertices(const Triangulation_graph& g)
  {
    return std::make_pair(vertex_iterator(0), vertex_iterator(g.t_->number_of_vertices()));
  }
  friend std::pair<edge_iterator, edge_iterator> edges(const Triangulation_graph& g)
  {
    return std::make_pair(edge_iterator(*g.t_, 0), edge_iterator(*g.t_, g.t_->number_of_edges()));
  }
  friend std::pair<out_edge_iterator, out_edge_iterator> out_edges(std::uint32_t v, const Triangulation_graph& g)
  {
    return std::make_pair(out_edge_iterator(*g.t_, v), out_edge_iterator::past_the_end());
  }
  friend std::size_t out_degree(std::uint32_t v, const Triangulation_graph& g)
  {
    return g.t_->degree(v) + (g.t_->is_border_vertex(v) ? 1 : 0);
  }
  friend std::uint32_t source(const Graph_edge& e, const Triangulation_graph&) { return e.source; }
  friend std::uint32_t target(const Graph_edge& e, const Triangulation_graph&) { return e.target; }

private:
  const Intrinsic_triangulation<NT>* t_;
};

// A function of the edge index as a readable property map of graph edges.
template <typename Value, typename Function>
class Edge_function_map
{
public:
  typedef Graph_edge                       key_type;
  typedef Value                            value_type;
  typedef Value                            reference;
  typedef boost::readable_property_map_tag category;

  explicit Edge_function_map(Function f) : f_(std::move(f)) {}

  friend Value get(const Edge_function_map& map, const Graph_edge& e) { return map.f_(e.index); }

private:
  Function f_;
};

template <typename Value, typename Function>
Edge_function_map<Value, Function> make_edge_function_map(Function f)
{
  return Edge_function_map<Value, Function>(std::move(f));
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGULATION_TRIANGULATION_GRAPH_H
