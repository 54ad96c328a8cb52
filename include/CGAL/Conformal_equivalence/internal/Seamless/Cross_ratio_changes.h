// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Changes of the logarithms of lengths, and what they do to the length cross ratios.
//
// Let d be changes of lambda = 2 log l, by edge. Those of the logarithms of the length cross ratios are, with the sides of the quadrilateral of e,
//
//     (Z d)_e = (d_jk - d_ki) + (d_il - d_lj).                          k
//                                                                     /   \                         .
// Within a triangle every side comes after one and before the other,  i -e- j
// so that the matrix Z is skew-symmetric (it is the Poisson structure of   \   /
// the decorated Teichmueller space). Changes by factors at the vertices,    l
// d_ij = u_i + u_j, or d = S^T u, are conformal: Z S^T = 0, and nothing else has Z d = 0 (section 2.2 of Springborn, Schroeder and Pinkall, 2008). So
// c is a change of cross ratios iff its sum over the edges around each vertex inside the surface vanishes, S c = 0.
//
// Both ways are short. With kappa_i = d_jk - d_ij - d_ki for the corner at i of a triangle ijk, c_e is the difference of kappa in the two corners at
// an end of e: sums around the vertices yield kappa, and d_ij = -(kappa_i + kappa_j) / 2. And S S^T, the signless Laplacian, lies between one half of
// its diagonal D and 2 D, as x^2 + y^2 + z^2 <= (x + y)^2 + (y + z)^2 + (z + x)^2: conjugate gradients need no factor.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_CROSS_RATIO_CHANGES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_CROSS_RATIO_CHANGES_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Conjugate_gradients.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Edge_graph.h>

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Z d; 0 at the border, where edges have no cross ratio.
inline Eigen::VectorXd cross_ratio_changes(const Intrinsic_triangulation<double>& t, const Eigen::VectorXd& d)
{
  typedef std::uint32_t Index;
  Eigen::VectorXd c = Eigen::VectorXd::Zero(d.size());
  for(Index e = 0; e < t.number_of_edges(); ++e)
    if(!t.is_border_edge(e))
    {
      const Index h = t.edge_halfedge(e), g = t.twin(h);
      c[e] = (d[t.edge(t.next(h))] - d[t.edge(t.previous(h))]) + (d[t.edge(t.next(g))] - d[t.edge(t.previous(g))]);
    }
  return c;
}

// One d with Z d = c. At the border c may have entries, too: those of the matrix that sums over the one triangle there; and d is zero there if
// these, and the sums around the vertices of the border, vanish. \pre the sums around the vertices inside vanish
inline Eigen::VectorXd changes_with_cross_ratios(const Intrinsic_triangulation<double>& t, const Eigen::VectorXd& c)
{
  typedef std::uint32_t Index;
  std::vector<double> kappa(t.number_of_halfedges(), 0.); // of the corner at the origin
  std::vector<char> is_visited(t.number_of_halfedges(), 0);
  // clockwise around the origin of h
  const auto sum_from = [&](Index h)
  {
    while(!is_visited[h])
    {
      is_visited[h] = 1;
      if(t.is_border(h))
        return;
      const Index next = t.next(t.twin(h));
      if(!is_visited[next])
        kappa[next] = kappa[h] - c[t.edge(h)];
      h = next;
    }
  };
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
    if(t.is_border(h)) // the first corner at its target
    {
      kappa[t.next(h)] = -c[t.edge(h)];
      sum_from(t.next(h));
    }
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
    sum_from(h);
  Eigen::VectorXd d(c.size());
  for(Index e = 0; e < t.number_of_edges(); ++e)
    d[e] = -(kappa[t.edge_halfedge(e)] + kappa[t.next(t.edge_halfedge(e))]) / 2;
  return d;
}

// What factors at some of the vertices do to edges, d = S^T u, and the best of them: least squares.
class Factors_at_vertices
{
  typedef std::uint32_t Index;

public:
  enum class Vertices { ALL, INSIDE };

  // Isolated vertices have no factors. \pre every edge is a side of a triangle
  Factors_at_vertices(const Intrinsic_triangulation<double>& t, Vertices vertices) : diagonal_(t.number_of_vertices(), 0.)
  {
    graph_.set_edges(t);
    std::vector<char> is_free(t.number_of_vertices(), 0);
    for(Index v = 0; v < is_free.size(); ++v)
      is_free[v] = !t.is_isolated_vertex(v) && (vertices == Vertices::ALL || !t.is_border_vertex(v)) ? 1 : 0;
    graph_.set_free(is_free);
    for(const auto& e : graph_.ends)
      for(Index v : {e.first, e.second})
        diagonal_[v] += e.first == e.second ? 2 : 1;
  }

  // S^T u
  Eigen::VectorXd changes(const Vertex_vector& u) const
  {
    Eigen::VectorXd d(Eigen::Index(graph_.ends.size()));
    for(Eigen::Index e = 0; e < d.size(); ++e)
      d[e] = u[graph_.ends[std::size_t(e)].first] + u[graph_.ends[std::size_t(e)].second];
    return d;
  }

  // S d
  Vertex_vector sums(const Eigen::VectorXd& d) const
  {
    Vertex_vector result(diagonal_.size(), 0.);
    for(Eigen::Index e = 0; e < d.size(); ++e)
      for(Index v : {graph_.ends[std::size_t(e)].first, graph_.ends[std::size_t(e)].second})
        result[v] += d[e];
    graph_.clear_fixed(result);
    return result;
  }

  // The u that minimize |d - S^T u|.
  Vertex_vector nearest(const Eigen::VectorXd& d) const
  {
    const double tolerance = 1e-14;
    const std::size_t most = 200; // each divides the error by two at least: (sqrt(8) + 1) / (sqrt(8) - 1) at the border, 3 inside
    Vertex_vector u;
    bool is_converged = false;
    System system{*this};
    Conjugate_gradients().solve(system, sums(d), tolerance, most, false, u, is_converged);
    return u;
  }

  // d - S^T u with these, so that S d = 0. Twice, for the digits that rounding takes when d is nearly that of factors.
  Eigen::VectorXd rest(Eigen::VectorXd d) const
  {
    for(int n = 0; n < 2; ++n)
      d -= changes(nearest(d));
    return d;
  }

private:
  // S S^T and its diagonal.
  struct System
  {
    const Factors_at_vertices& factors;

    bool precondition(const Vertex_vector& r, Vertex_vector& z) const
    {
      z.resize(r.size());
      for(std::size_t v = 0; v < r.size(); ++v)
        z[v] = r[v] == 0 ? 0 : r[v] / factors.diagonal_[v];
      return true;
    }

    void multiply(const Vertex_vector& x, Vertex_vector& y) const { y = factors.sums(factors.changes(x)); }
  };

  Edge_graph graph_;
  Vertex_vector diagonal_; // of S S^T
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_CROSS_RATIO_CHANGES_H
