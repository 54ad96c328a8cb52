// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Prescribed angle sums and turnings of loops as equations for the lengths of all edges, and their linearization.
//
// In Penner coordinates lambda = 2 log l (Penner, "The decorated Teichmueller space of punctured surfaces", 1987) the angle opposite to the edge
// i of a triangle ijk has the derivatives
//
//     d alpha_i / d lambda_i = (cot alpha_j + cot alpha_k) / 2,
//     d alpha_i / d lambda_j = -cot alpha_k / 2,    d alpha_i / d lambda_k = -cot alpha_j / 2.
//
// On a closed surface there are |V| - 1 + 2 g equations and |E| = 3 (|V| - 2 + 2 g) unknowns; on others, vertices of the border need have no
// equations. Of all changes of lambda that solve the linearized equations J d = -c we want the one that leaves the discrete conformal class the
// least: it minimizes
//
//     |Z d|^2 + epsilon |d|^2,
//
// where Z d are the changes of the logarithms of the length cross ratios. Z vanishes exactly on changes by factors at the vertices (section 2.2 of
// Springborn, Schroeder and Pinkall, 2008): these cost next to nothing. The least norm |d| itself, which suggests itself and is found
// in the literature (Capouellez and Zorin, "Metric optimization in Penner coordinates", 2023), is a poor guide on irregular meshes.
//
// The minimum is found with its multipliers, by the quasi-definite matrix [W J^T; J -delta], which has an L D L^T factor for any ordering
// (Vanderbei, "Symmetric quasi-definite matrices", 1995); what delta spoils is mended by iterative refinement.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TURNING_EQUATIONS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TURNING_EQUATIONS_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Dual_loops.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// What is prescribed, in radians.
struct Turning_targets
{
  std::vector<double> angle_sum; // by vertex
  std::vector<double> turning;   // by loop
  std::vector<char> is_free = {}; // by vertex: whether its angle sum may be any; empty: none is
};

// The angles of all corners, and their cotangents: by halfedge, at its origin.
struct Corner_angles
{
  std::vector<double> angle, cotangent;
  bool are_triangles = true; // no triangle inequality is violated

  explicit Corner_angles(const Intrinsic_triangulation<double>& t) : angle(t.number_of_halfedges()), cotangent(t.number_of_halfedges())
  {
    for(std::uint32_t h = 0; h < t.number_of_halfedges(); h += 3)
    {
      const auto triangle = triangle_angles(t.halfedge_length(h), t.halfedge_length(h + 1), t.halfedge_length(h + 2));
      are_triangles = are_triangles && !triangle.is_broken;
      for(std::uint32_t k = 0; k < 3; ++k)
      {
        angle[h + (k + 2) % 3] = triangle.angle[k]; // opposite to the side k
        cotangent[h + (k + 2) % 3] = triangle.cotangent[k];
      }
    }
  }
};

// The angle by which each loop turns, in radians.
inline std::vector<double> turnings(const Intrinsic_triangulation<double>& t, const Dual_loops& loops, const Corner_angles& corners)
{
  std::vector<double> result(loops.size(), 0.);
  for(std::size_t i = 0; i < loops.size(); ++i)
    loops.for_each_turn(t, i, [&](std::uint32_t corner, int sign) { result[i] += sign * corners.angle[corner]; });
  return result;
}

// The rows of the equations: those of the vertices that are not free, but one if none is, as the angle sums have a fixed sum; then those of the
// loops.
class Turning_rows
{
public:
  typedef std::uint32_t Index;

  // \pre `t` is connected
  explicit Turning_rows(const Intrinsic_triangulation<double>& t, const std::vector<char>& is_free = std::vector<char>())
    : row_of_vertex_(t.number_of_vertices(), t.null_index)
  {
    const bool is_any_free = std::find(is_free.begin(), is_free.end(), char(1)) != is_free.end();
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      if(!t.is_isolated_vertex(v) && (is_free.empty() || !is_free[v]))
        vertices_.push_back(v);
    if(!vertices_.empty() && !is_any_free)
      vertices_.pop_back();
    for(Index r = 0; r < vertices_.size(); ++r)
      row_of_vertex_[vertices_[r]] = r;
  }

  Index number_of_vertices() const { return Index(vertices_.size()); }
  Index vertex(Index row) const { return vertices_[row]; }
  Index row(Index v) const { return row_of_vertex_[v]; } // null_index: none

private:
  std::vector<Index> vertices_, row_of_vertex_;
};

// By how much the angle sums and turnings exceed their targets.
inline Eigen::VectorXd turning_residual(const Intrinsic_triangulation<double>& t, const Dual_loops& loops, const Turning_targets& targets,
                                        const Turning_rows& rows, const Corner_angles& corners)
{
  const std::uint32_t n = rows.number_of_vertices();
  std::vector<double> sum(t.number_of_vertices(), 0.);
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); ++h)
    sum[t.origin(h)] += corners.angle[h];
  Eigen::VectorXd result(Eigen::Index(n + loops.size()));
  for(std::uint32_t r = 0; r < n; ++r)
    result[r] = sum[rows.vertex(r)] - targets.angle_sum[rows.vertex(r)];
  const std::vector<double> turned = turnings(t, loops, corners);
  for(std::size_t i = 0; i < loops.size(); ++i)
    result[Eigen::Index(n + i)] = turned[i] - targets.turning[i];
  return result;
}

// The equations at one metric, linearized and factorized.
class Turning_equations
{
  typedef std::uint32_t Index;
  typedef Eigen::SparseMatrix<double> Matrix;

public:
  // the part of the norm in the square that is minimized
  static constexpr double default_epsilon = 0.1;

  Turning_equations(const Intrinsic_triangulation<double>& t, const Dual_loops& loops, const Turning_rows& rows,
                    const Corner_angles& corners, double epsilon = default_epsilon)
    : edges_(t.number_of_edges()), rows_(Eigen::Index(rows.number_of_vertices() + loops.size()))
  {
    Triplets entries;
    add_constraints(t, loops, rows, corners, entries);
    add_weights(t, epsilon, entries);
    matrix_.resize(edges_ + rows_, edges_ + rows_);
    matrix_.setFromTriplets(entries.begin(), entries.end());
  }

  // \return `false` if rounding has spoiled the matrix
  bool factorize()
  {
    const double delta = 1e-10;
    Matrix shifted = matrix_;
    for(Eigen::Index i = 0; i < edges_ + rows_; ++i)
      shifted.coeffRef(i, i) += i < edges_ ? 0 : -delta;
    factor_.compute(shifted);
    return factor_.info() == Eigen::Success;
  }

  // The least d with J d = right.
  Eigen::VectorXd least_change(const Eigen::VectorXd& right) const { return solve(right).head(edges_); }

  // Its multipliers mu, by equation: |Z d|^2 + epsilon |d|^2 = -mu^T right.
  Eigen::VectorXd multipliers(const Eigen::VectorXd& right) const { return solve(right).tail(rows_); }

  // Both, one after the other.
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const
  {
    const int refinements = 3;
    Eigen::VectorXd b = Eigen::VectorXd::Zero(edges_ + rows_);
    b.tail(rows_) = right;
    Eigen::VectorXd x = factor_.solve(b);
    for(int n = 0; n < refinements; ++n)
      x += factor_.solve(b - matrix_.selfadjointView<Eigen::Lower>() * x);
    return x;
  }

private:
  typedef std::vector<Eigen::Triplet<double> > Triplets;

  // The rows of J, below the square of the edges.
  void add_constraints(const Intrinsic_triangulation<double>& t, const Dual_loops& loops, const Turning_rows& rows,
                       const Corner_angles& corners, Triplets& entries) const
  {
    const auto add = [&](Index row, Index corner, double sign) // of the angle at the origin of a halfedge
    {
      const Index opposite = t.next(corner), previous = t.previous(corner);
      const double at_target = corners.cotangent[opposite], at_apex = corners.cotangent[previous];
      const int r = int(edges_ + row);
      entries.emplace_back(r, int(t.edge(opposite)), sign * (at_target + at_apex) / 2);
      entries.emplace_back(r, int(t.edge(corner)), -sign * at_target / 2);  // opposite to the apex: the other cotangent
      entries.emplace_back(r, int(t.edge(previous)), -sign * at_apex / 2);
    };
    for(Index h = 0; h < t.number_of_halfedges(); ++h)
      if(rows.row(t.origin(h)) != t.null_index)
        add(rows.row(t.origin(h)), h, 1);
    for(Index i = 0; i < loops.size(); ++i)
      loops.for_each_turn(t, i, [&](Index corner, int sign) { add(rows.number_of_vertices() + i, corner, sign); });
    for(Eigen::Index r = 0; r < rows_; ++r)
      entries.emplace_back(int(edges_ + r), int(edges_ + r), 0.);
  }

  // The lower half of Z^T Z + epsilon.
  void add_weights(const Intrinsic_triangulation<double>& t, double epsilon, Triplets& entries) const
  {
    for(Index e = 0; e < t.number_of_edges(); ++e)
    {
      entries.emplace_back(int(e), int(e), epsilon);
      if(t.is_border_edge(e))
        continue;
      const Index h = t.edge_halfedge(e), g = t.twin(h);
      const std::array<Index, 4> side = {{t.edge(t.next(h)), t.edge(t.previous(h)), t.edge(t.next(g)), t.edge(t.previous(g))}};
      for(std::size_t i = 0; i < 4; ++i)
        for(std::size_t j = 0; j < 4; ++j)
          if(side[i] >= side[j]) // both orders of a pair of sides that are one edge count on the diagonal
            entries.emplace_back(int(side[i]), int(side[j]), (i + j) % 2 == 0 ? 1. : -1.);
    }
  }

  Eigen::Index edges_, rows_;
  Matrix matrix_; // the lower half
  Eigen::SimplicialLDLT<Matrix> factor_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TURNING_EQUATIONS_H
