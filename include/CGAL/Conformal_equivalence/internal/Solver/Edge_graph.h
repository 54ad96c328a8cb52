// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The derivative of the angle sums is
//
//   d Theta_i = - 1/2 sum over edges ij of w_ij (d_i - d_j) =: - (A d)_i,
//
// twice the Hessian of E. The matrix A is restricted to the free vertices. Here it is applied, edge by edge, and never assembled.
// Vectors run over all vertices and are zero at those that are not free. Some of the free vertices can be held for a while: the matrix
// is then restricted to the others.
//
// All of this is asked of a `Surface` only: numbers of vertices and edges, and the ends of every edge. It is a
// triangulation, or one that is folded (Folded_double.h), whose mirror images are the same vertices and edges: then A is that
// of one half.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_EDGE_GRAPH_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_EDGE_GRAPH_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

typedef std::vector<double> Vertex_vector;

inline double dot(const Vertex_vector& x, const Vertex_vector& y)
{
  double sum = 0;
  for(std::size_t i = 0; i < x.size(); ++i)
    sum += x[i] * y[i];
  return sum;
}

inline double largest_entry(const Vertex_vector& x)
{
  double result = 0;
  for(double entry : x)
    result = (std::max)(result, std::abs(entry));
  return result;
}

// The edges of the graph, with the vertices that are free, and those of them that are held.
struct Edge_graph
{
  typedef std::uint32_t Index;
  std::vector<std::pair<Index, Index> > ends; // by edge
  std::vector<Index> free_index;              // by vertex; null_index where fixed
  Index number_of_free = 0;
  std::vector<char> held;                     // by vertex, or empty: none

  bool is_free(Index v) const { return free_index[v] != Intrinsic_triangulation<>::null_index; }
  bool is_held(Index v) const { return !held.empty() && held[v] != 0; }

  template <typename Surface>
  void set_edges(const Surface& t)
  {
    ends.resize(t.number_of_edges());
    for(Index e = 0; e < t.number_of_edges(); ++e)
      set_edge(t, e);
  }

  // `e` may be a new one, the next in order.
  template <typename Surface>
  void set_edge(const Surface& t, Index e)
  {
    if(e == ends.size())
      ends.emplace_back();
    ends[e] = std::make_pair(t.origin(t.edge_halfedge(e)), t.target(t.edge_halfedge(e)));
  }

  void set_free(const std::vector<char>& free)
  {
    number_of_free = 0;
    free_index.assign(free.size(), Intrinsic_triangulation<>::null_index);
    for(std::size_t v = 0; v < free.size(); ++v)
      if(free[v])
        free_index[v] = number_of_free++;
  }

  std::vector<char> free_vertices() const
  {
    std::vector<char> result(free_index.size());
    for(std::size_t v = 0; v < result.size(); ++v)
      result[v] = is_free(Index(v)) ? 1 : 0;
    return result;
  }

  // A x for the edge weights w, on the free vertices that are not held; `x` may be nonzero at the others.
  Vertex_vector product(const std::vector<double>& w, const Vertex_vector& x) const
  {
    Vertex_vector y;
    multiply(w, x, y);
    return y;
  }

  void multiply(const std::vector<double>& w, const Vertex_vector& x, Vertex_vector& y) const
  {
    y.assign(x.size(), 0.);
    for(std::size_t e = 0; e < ends.size(); ++e)
    {
      const double flux = w[e] * (x[ends[e].first] - x[ends[e].second]) / 2;
      y[ends[e].first] += flux;
      y[ends[e].second] -= flux;
    }
    clear_fixed(y);
  }

  Vertex_vector diagonal(const std::vector<double>& w) const
  {
    Vertex_vector y(free_index.size(), 0.);
    for(std::size_t e = 0; e < ends.size(); ++e)
    {
      if(ends[e].first == ends[e].second)
        continue;
      y[ends[e].first] += w[e] / 2;
      y[ends[e].second] += w[e] / 2;
    }
    clear_fixed(y);
    return y;
  }

  void clear_fixed(Vertex_vector& y) const
  {
    for(std::size_t v = 0; v < y.size(); ++v)
      if(!is_free(Index(v)) || is_held(Index(v)))
        y[v] = 0;
  }
};

// What is added to the diagonal of A where triangles are broken: rows that have
// lost (nearly) all of their weight get the mean weight. So do those of held vertices, which have none. Empty where there are no such rows.
inline Vertex_vector regularization(const Edge_graph& graph, const std::vector<double>& w, std::size_t& rows)
{
  const Vertex_vector d = graph.diagonal(w);
  Vertex_vector result;
  double sum = 0, largest = 0;
  for(double x : d)
  {
    sum += (std::max)(x, 0.);
    largest = (std::max)(largest, x);
  }
  const double mean = sum > 0 ? sum / (std::max)(graph.number_of_free, 1u) : 1;
  rows = 0;
  for(std::uint32_t v = 0; v < d.size(); ++v)
  {
    if(!graph.is_free(v) || d[v] > 1e-14 * largest)
      continue;
    result.resize(d.size(), 0.);
    result[v] = mean;
    if(!graph.is_held(v))
      ++rows;
  }
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_EDGE_GRAPH_H
