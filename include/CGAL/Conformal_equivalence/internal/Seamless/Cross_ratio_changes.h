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
// an end of e: sums around the vertices yield kappa, and d_ij = -(kappa_i + kappa_j) / 2. And S S^T, the signless Laplacian, lies between one half
// of the degrees of the vertices and two times these, as x^2 + y^2 + z^2 <= (x + y)^2 + (y + z)^2 + (z + x)^2: a few iterations invert it, without
// a factor.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_CROSS_RATIO_CHANGES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_CROSS_RATIO_CHANGES_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
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
  typedef Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> Rows; // by edge or vertex, a row; every column is by itself
  enum class Vertices { ALL, INSIDE };

  // Isolated vertices have no factors. \pre every edge is a side of a triangle
  Factors_at_vertices(const Intrinsic_triangulation<double>& t, Vertices vertices) : degree_(t.number_of_vertices(), 0.)
  {
    std::vector<char> is_included(t.number_of_vertices(), 0);
    for(Index v = 0; v < t.number_of_vertices(); ++v)
    {
      is_included[v] = vertices == Vertices::ALL || !t.is_border_vertex(v) ? 1 : 0;
      reaches_border_ = reaches_border_ || (is_included[v] && t.is_border_vertex(v));
    }
    for(Index e = 0; e < t.number_of_edges(); ++e)
    {
      const Index h = t.edge_halfedge(e);
      ends_.push_back({{t.origin(h), t.target(h)}});
      for(Index v : ends_.back())
        degree_[v] += is_included[v];
    }
  }

  // S^T u
  Rows changes(const Rows& u) const
  {
    Rows d(Eigen::Index(ends_.size()), u.cols());
    for(Eigen::Index e = 0; e < d.rows(); ++e)
      d.row(e) = u.row(ends_[std::size_t(e)][0]) + u.row(ends_[std::size_t(e)][1]);
    return d;
  }

  // S d
  Rows sums(const Rows& d) const
  {
    Rows result = Rows::Zero(Eigen::Index(degree_.size()), d.cols());
    for(Eigen::Index e = 0; e < d.rows(); ++e)
      for(Index v : ends_[std::size_t(e)])
        if(degree_[v] > 0)
          result.row(v) += d.row(e);
    return result;
  }

  // The u that minimize |d - S^T u|, up to `accuracy` of their size, by the Chebyshev iteration (Golub and Varga, 1961): all that it must be told is
  // in which interval the eigenvalues of S S^T lie, in units of the degrees. At the border a vertex has a triangle less than edges.
  Rows nearest(const Rows& d, double accuracy) const
  {
    const double least = reaches_border_ ? .25 : .5, most = 2, center = (most + least) / 2, radius = (most - least) / 2;
    const double gain = (std::sqrt(most) + std::sqrt(least)) / (std::sqrt(most) - std::sqrt(least));
    Rows residual = sums(d), step = over_degrees(residual) / center, u = Rows::Zero(residual.rows(), residual.cols());
    double rho = radius / center;
    for(int n = int(std::ceil(std::log(2 / accuracy) / std::log(gain))); n > 0; --n)
    {
      u += step;
      subtract_product(step, residual);
      const double next = 1 / (2 * center / radius - rho);
      step = next * rho * step + 2 * next / radius * over_degrees(residual);
      rho = next;
    }
    return u;
  }

  // d - S^T u with these, so that S d = 0.
  Rows rest(const Rows& d, double accuracy) const { return d - changes(nearest(d, accuracy)); }

private:
  Rows over_degrees(Rows x) const
  {
    for(Eigen::Index v = 0; v < x.rows(); ++v)
      x.row(v) /= (std::max)(degree_[std::size_t(v)], 1.);
    return x;
  }

  // y -= S S^T x
  void subtract_product(const Rows& x, Rows& y) const
  {
    for(const auto& e : ends_)
      for(Index v : e)
        if(degree_[v] > 0)
          y.row(v) -= x.row(e[0]) + x.row(e[1]);
  }

  std::vector<std::array<Index, 2> > ends_; // by edge
  std::vector<double> degree_;              // by vertex; 0: it has no factor
  bool reaches_border_ = false;
};

// Length cross ratios of one metric over those of another one on the same triangulation, of which the logarithms of the lengths are given, and the
// factors at vertices that come nearest.
struct Conformal_departure
{
  double mean = 0, largest = 0;   // of |log| of the quotients: root of the mean square, and largest
  std::vector<double> u;          // by vertex: e^{(u_i + u_j) / 2} are, in the mean, the quotients of the lengths

  Conformal_departure(const std::vector<double>& before, const Intrinsic_triangulation<double>& after)
  {
    const double accuracy = 1e-13;
    Eigen::VectorXd change(Eigen::Index(after.number_of_edges()));
    std::size_t number_of_ratios = 0;
    for(std::uint32_t e = 0; e < after.number_of_edges(); ++e)
    {
      change[e] = 2 * (std::log(after.length(e)) - before[e]);
      number_of_ratios += after.is_border_edge(e) ? 0 : 1;
    }
    if(number_of_ratios > 0)
    {
      const Eigen::VectorXd ratios = cross_ratio_changes(after, change);
      mean = std::sqrt(ratios.squaredNorm() / double(number_of_ratios));
      largest = ratios.lpNorm<Eigen::Infinity>();
    }
    const Eigen::VectorXd nearest = Factors_at_vertices(after, Factors_at_vertices::Vertices::ALL).nearest(change, accuracy);
    u.assign(nearest.data(), nearest.data() + nearest.size());
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_CROSS_RATIO_CHANGES_H
