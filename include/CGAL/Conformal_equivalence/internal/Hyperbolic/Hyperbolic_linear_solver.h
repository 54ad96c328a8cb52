// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The linear systems of Newton's method for hyperbolic metrics. As in the plane the Hessian barely changes from one step to the next: one factor
// preconditions the conjugate gradients of several, for flipped triangulations, too, and a new one is made where that takes too long.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_LINEAR_SOLVER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_LINEAR_SOLVER_H

#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Conjugate_gradients.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Edge_graph.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Quadratic_model.h>

#include <Eigen/SparseCore>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The quadratic form  sum over edges c_ij (d_i - d_j)^2 / 2 + sum over vertices m_i d_i^2.
struct Coupled_vertices
{
  std::vector<double> coupling; // c, by edge
  Vertex_vector own;            // m, by vertex
};

class Hyperbolic_linear_solver
{
public:
  Hyperbolic_linear_solver(std::unique_ptr<Factorization> factorization, Statistics& statistics)
    : factorization_(std::move(factorization)), statistics_(statistics)
  {}

  Edge_graph& graph() { return graph_; }
  const Edge_graph& graph() const { return graph_; }

  // The matrix of the systems to come, which is kept by reference. `number_of_flips` tells whether edges are still where they were.
  template <typename Triangulation>
  void set_matrix(const Triangulation& t, std::size_t number_of_flips, const Coupled_vertices& matrix)
  {
    matrix_ = &matrix;
    if(graph_.ends.empty() || number_of_flips != number_of_flips_)
    {
      graph_.set_edges(t);
      is_pattern_known_ = false;
    }
    number_of_flips_ = number_of_flips;
  }

  // H d = r on the free vertices, up to `tolerance` times the largest entry of r, or as well as rounding allows. Returns whether there is a factor.
  bool solve(const Vertex_vector& r, double tolerance, Vertex_vector& d)
  {
    if(graph_.number_of_free == 0)
    {
      d.assign(r.size(), 0.);
      return true;
    }
    const std::size_t most_with_new_factor = 50; // only ends what rounding keeps from converging
    return (has_factor_ && conjugate_gradients(r, tolerance, iterations_worth_a_factorization, true, d))
        || (factorize() && (conjugate_gradients(r, tolerance, most_with_new_factor, false, d) || has_factor_));
  }

private:
  // Where there is nearly no area the Hessian is nearly that of a flat metric, singular up to rounding: then its diagonal gets a little more.
  bool factorize()
  {
    const Eigen::SparseMatrix<double> hessian = assemble_lower(graph_, matrix_->coupling, matrix_->own);
    if(!is_pattern_known_)
      factorization_->forget_pattern();
    is_pattern_known_ = true;
    has_factor_ = false;
    for(const double more : {0., 1e-13, 1e-11, 1e-9})
    {
      ++statistics_.number_of_factorizations;
      if(factorization_->factor(with_larger_diagonal(hessian, more)))
        return has_factor_ = true;
    }
    return false;
  }

  // The diagonal times 1 + `more`, of the lower half of a matrix.
  static Eigen::SparseMatrix<double> with_larger_diagonal(Eigen::SparseMatrix<double> lower, double more)
  {
    for(int c = 0; more > 0 && c < lower.outerSize(); ++c)
      lower.valuePtr()[lower.outerIndexPtr()[c]] *= 1 + more;
    return lower;
  }

  // From d = 0. Returns whether the tolerance was met. If `may_give_up` they end as soon as it is foreseen that `most` iterations do not do.
  bool conjugate_gradients(const Vertex_vector& b, double tolerance, std::size_t most, bool may_give_up, Vertex_vector& d)
  {
    bool converged;
    statistics_.number_of_linear_iterations += iteration_.solve(*this, b, tolerance, most, may_give_up, d, converged);
    return converged;
  }

  friend class Conjugate_gradients;

  void multiply(const Vertex_vector& x, Vertex_vector& y) const
  {
    graph_.multiply(matrix_->coupling, x, y);
    for(std::size_t v = 0; v < x.size(); ++v)
      y[v] += matrix_->own[v] * x[v]; // which is 0 where it is fixed
  }

  bool precondition(const Vertex_vector& r, Vertex_vector& z)
  {
    return replace_free_entries(graph_, r, free_, z, [this](std::vector<double>& free) { return factorization_->precondition(free); });
  }

  std::unique_ptr<Factorization> factorization_;
  Statistics& statistics_;
  Edge_graph graph_;
  const Coupled_vertices* matrix_ = nullptr;
  std::size_t number_of_flips_ = 0;
  bool is_pattern_known_ = false, has_factor_ = false;
  Conjugate_gradients iteration_;
  std::vector<double> free_; // by free vertex: what is solved for
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_LINEAR_SOLVER_H
