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
// equations. Of all changes d of lambda that solve the linearized equations we want the one that leaves the discrete conformal class the least: it
// minimizes |Z d|, where c = Z d are the changes of the logarithms of the length cross ratios (Cross_ratio_changes.h). The least norm |d| itself,
// which suggests itself and is found in the literature (Capouellez and Zorin, "Metric optimization in Penner coordinates", 2023), is a
// poor guide on irregular meshes.
//
// No matrix of the size of the edges is factorized for that. Let w be any changes with Z w = c, and d = w + S^T u. The angle sums fix u, by the
// cotangent Laplacian A: A u = (their changes by w) - (those wanted). What is left is one equation for each loop, and the changes of turnings, with
// angle sums kept, depend on c alone: they are N c. Least is c = N^T mu, if the rows of N are such c themselves. So with one factor of A there is one
// solution for each loop, and a matrix N N^T of the size of their number.
//
// Where u is prescribed, at natural borders, so that angle sums may be any, scales at the border may change as well; they count as c does.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TURNING_EQUATIONS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TURNING_EQUATIONS_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Cross_ratio_changes.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Dual_loops.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
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
    : row_of_vertex_(t.number_of_vertices(), t.null_index), is_any_free_(std::find(is_free.begin(), is_free.end(), char(1)) != is_free.end())
  {
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      if(!t.is_isolated_vertex(v) && (is_free.empty() || !is_free[v]))
        vertices_.push_back(v);
    if(!vertices_.empty() && !is_any_free_)
      vertices_.pop_back();
    for(Index r = 0; r < vertices_.size(); ++r)
      row_of_vertex_[vertices_[r]] = r;
  }

  Index number_of_vertices() const { return Index(vertices_.size()); }
  Index vertex(Index row) const { return vertices_[row]; }
  Index row(Index v) const { return row_of_vertex_[v]; } // null_index: none
  bool is_any_free() const { return is_any_free_; }

private:
  std::vector<Index> vertices_, row_of_vertex_;
  bool is_any_free_;
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

// The equations at one metric, linearized.
class Turning_equations
{
  typedef std::uint32_t Index;
  typedef Factors_at_vertices::Rows Rows;

public:
  typedef Eigen::VectorXd Vector;

  Turning_equations(const Intrinsic_triangulation<double>& t, const Dual_loops& loops, const Turning_rows& rows,
                    std::unique_ptr<Factorization> factorization)
    : t_(t), rows_(rows), corners_(t), number_of_loops_(Eigen::Index(loops.size())),
      inside_(t, Factors_at_vertices::Vertices::INSIDE), all_(t, Factors_at_vertices::Vertices::ALL), laplacian_(std::move(factorization)),
      weights_(t.number_of_edges(), 0.)
  {
    for(Index h = 0; h < t.number_of_halfedges(); ++h)
      weights_[t.edge(h)] += corners_.cotangent[t.previous(h)];
    std::vector<char> is_unknown(t.number_of_vertices(), 0);
    for(Index r = 0; r < rows.number_of_vertices(); ++r)
      is_unknown[rows.vertex(r)] = 1;
    laplacian_.set_edges(t);
    laplacian_.set_free(is_unknown);
    add_loops(loops);
  }

  // \return `false` if rounding has spoiled the equations
  bool factorize()
  {
    factor_.compute(changes_.transpose() * changes_ + scales_.transpose() * scales_);
    return changes_.allFinite() && factor_.info() == Eigen::Success && (number_of_loops_ == 0 || factor_.rcond() > 0);
  }

  // The d that changes angle sums and turnings by `right` and leaves the conformal class the least. \pre `factorize()`
  Vector least_change(const Vector& right) { return change_to_departure(right, Vector::Zero(Eigen::Index(weights_.size()))); }

  // The same where the class has been left already, by the cross ratios `departure`: the least is what is left of it with the change.
  Vector change_to_departure(const Vector& right, const Vector& departure)
  {
    const Eigen::Index n = rows_.number_of_vertices();
    const Vector mu = factor_.solve(right.tail(number_of_loops_) + fluxes_.transpose() * by_vertex(right.head(n)) + changes_.transpose() * departure);
    Vector w = changes_with_cross_ratios(t_, changes_ * mu - departure);
    if(rows_.is_any_free())
      w = all_.rest(w, accuracy); // elsewhere the angle sums tell all factors
    return w + all_.changes(factors_for(w, right.head(n), scales_ * mu));
  }

  // x^T F x = |Z d|^2, the least with which the loops turn by x more, and angle sums stay. \pre `factorize()`
  Eigen::MatrixXd form() const { return factor_.solve(Eigen::MatrixXd::Identity(number_of_loops_, number_of_loops_)); }

private:
  // Calls `visit(edge, derivative)` for the angle at the origin of a halfedge.
  template <typename Visit>
  void for_each_derivative(Index corner, Visit visit) const
  {
    const Index opposite = t_.next(corner), previous = t_.previous(corner);
    const double at_target = corners_.cotangent[opposite], at_apex = corners_.cotangent[previous];
    visit(t_.edge(opposite), (at_target + at_apex) / 2);
    visit(t_.edge(corner), -at_target / 2); // opposite to the apex: the other cotangent
    visit(t_.edge(previous), -at_apex / 2);
  }

  // By how much the angle sums of all vertices change, to first order.
  Vector angle_changes(const Vector& d) const
  {
    Vector result = Vector::Zero(Eigen::Index(t_.number_of_vertices()));
    for(Index h = 0; h < t_.number_of_halfedges(); ++h)
      for_each_derivative(h, [&](Index e, double derivative) { result[t_.origin(h)] += derivative * d[e]; });
    return result;
  }

  // The transpose of that.
  Vector transposed_angle_changes(const Vector& y) const
  {
    Vector result = Vector::Zero(Eigen::Index(weights_.size()));
    for(Index h = 0; h < t_.number_of_halfedges(); ++h)
      for_each_derivative(h, [&](Index e, double derivative) { result[e] += derivative * y[t_.origin(h)]; });
    return result;
  }

  // The derivatives of its turning, by edge.
  Vector derivatives_of_loop(const Dual_loops& loops, std::size_t i) const
  {
    Vector result = Vector::Zero(Eigen::Index(weights_.size()));
    loops.for_each_turn(t_, i, [&](Index corner, int sign)
      { for_each_derivative(corner, [&](Index e, double derivative) { result[e] += sign * derivative; }); });
    return result;
  }

  // With the angle sums kept by factors at the vertices, a loop turns by m d more; and m d = n (Z d) + k u with the scales u of the border. As Z is
  // skew-symmetric, n is had from m as changes of lengths are from those of cross ratios.
  void add_loops(const Dual_loops& loops)
  {
    const Eigen::Index vertices = Eigen::Index(t_.number_of_vertices());
    changes_.resize(Eigen::Index(weights_.size()), number_of_loops_);
    scales_.setZero(vertices, number_of_loops_);
    fluxes_.resize(vertices, number_of_loops_);
    for(Eigen::Index i = 0; i < number_of_loops_; ++i)
    {
      const Vector a = derivatives_of_loop(loops, std::size_t(i));
      fluxes_.col(i) = solution(all_.sums(a));
      changes_.col(i) = a + transposed_angle_changes(fluxes_.col(i));
    }
    if(rows_.is_any_free())
    {
      scales_ = of_border(all_.sums(changes_));
      changes_ = all_.rest(changes_, accuracy);
    }
    for(Eigen::Index i = 0; i < number_of_loops_; ++i)
      changes_.col(i) = without_border(changes_with_cross_ratios(t_, -changes_.col(i)));
    changes_ = inside_.rest(changes_, accuracy);
  }

  Rows of_border(Rows by_vertex) const
  {
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      if(rows_.row(v) != t_.null_index)
        by_vertex.row(v).setZero();
    return by_vertex;
  }

  Vector without_border(Vector c) const
  {
    for(Index e = 0; e < t_.number_of_edges(); ++e)
      if(t_.is_border_edge(e))
        c[e] = 0;
    return c;
  }

  // The u for which, with the changes w, angle sums change as is wanted, by row; `scales`: where they are given.
  Vector factors_for(const Vector& w, const Vector& wanted, const Vector& scales)
  {
    const Vertex_vector by_scales = laplacian_.graph().product(weights_, Vertex_vector(scales.data(), scales.data() + scales.size()));
    const Vector b = angle_changes(w) - by_vertex(wanted) - Vector::Map(by_scales.data(), scales.size());
    return solution(b) + scales;
  }

  // A^-1 b for the vertices that have rows, 0 at the others.
  Vector solution(const Vector& b)
  {
    const std::size_t most = 50; // iterations: one to three are usual
    Vertex_vector right(b.data(), b.data() + b.size()), x;
    laplacian_.graph().clear_fixed(right);
    bool is_converged = false;
    laplacian_.conjugate_gradients(weights_, right, accuracy, most, false, x, is_converged);
    return Vector::Map(x.data(), b.size());
  }

  Vector by_vertex(const Vector& by_row) const
  {
    Vector result = Vector::Zero(Eigen::Index(t_.number_of_vertices()));
    for(Eigen::Index r = 0; r < by_row.size(); ++r)
      result[rows_.vertex(Index(r))] = by_row[r];
    return result;
  }

  // More than that is won by the next step.
  static constexpr double accuracy = 1e-11;

  const Intrinsic_triangulation<double> t_;
  const Turning_rows rows_;
  const Corner_angles corners_;
  const Eigen::Index number_of_loops_;
  const Factors_at_vertices inside_, all_;
  Laplacian_solver laplacian_;
  std::vector<double> weights_; // by edge: the sum of the cotangents of the angles opposite to it
  Rows changes_;                // by loop, a column: the transpose of N
  Rows scales_;                 // by loop: the changes of its turning by those of u where angle sums may be any
  Rows fluxes_;                 // by loop: how much less it turns by what angle sums grow
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TURNING_EQUATIONS_H
