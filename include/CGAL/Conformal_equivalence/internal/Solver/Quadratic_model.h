// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The quadratic model of E at one u, as Newton's method sees it: with the residual r = Theta~ - Theta^ = -2 grad E and A = 2 Hess E, its
// minimizer d solves A d = r. The factor that is kept preconditions conjugate gradients.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_QUADRATIC_MODEL_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_QUADRATIC_MODEL_H

#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Abstract_energy.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>

#include <cstddef>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The iterations of conjugate gradients after which the kept factor counts as a bad approximation: a new one of the same pattern costs about as
// much as eight iterations (with the multifrontal factor, of 1e4 to 1e6 vertices).
constexpr std::size_t iterations_worth_a_factorization = 8;

class Quadratic_model
{
public:
  // Keeps references.
  Quadratic_model(const Abstract_energy& energy, Laplacian_solver& solver, Statistics& statistics)
    : energy_(energy), solver_(solver), statistics_(statistics)
  {}

  // A d, on the free vertices that are not held
  Vertex_vector product(const Vertex_vector& d) const { return solver_.graph().product(energy_.weights(), d); }

  // A d = b up to `eta` times the largest entry of b: with the kept factor, or with a new one if that takes too long. With a new factor the
  // limit is only there to end a solve that rounding keeps from converging; what was found points downhill nevertheless.
  // Returns whether there was a factor.
  bool solve(const Vertex_vector& b, double eta, Vertex_vector& d)
  {
    return solve_by_kept_factor(b, eta, d) || solve_by_new_factor(b, eta, d);
  }

  // Returns whether the kept factor does. If it does not, d is not what was asked for, but points there.
  bool solve_by_kept_factor(const Vertex_vector& b, double eta, Vertex_vector& d)
  {
    return is_solved_within(iterations_worth_a_factorization, true, b, eta, d);
  }

  bool solve_by_new_factor(const Vertex_vector& b, double eta, Vertex_vector& d)
  {
    const std::size_t most_with_new_factor = 200;
    if(!solver_.factorize(energy_.weights()))
      return false;
    is_solved_within(most_with_new_factor, false, b, eta, d);
    return true;
  }

  Laplacian_solver& solver() { return solver_; }
  const Edge_graph& graph() const { return solver_.graph(); }
  bool factorize() { return solver_.factorize(energy_.weights()); }
  void count_linear_iteration() { ++statistics_.number_of_linear_iterations; }

private:
  bool is_solved_within(std::size_t most, bool may_give_up, const Vertex_vector& b, double eta, Vertex_vector& d)
  {
    bool converged = false;
    statistics_.number_of_linear_iterations += solver_.conjugate_gradients(energy_.weights(), b, eta, most, may_give_up, d, converged);
    return converged;
  }

  const Abstract_energy& energy_;
  Laplacian_solver& solver_;
  Statistics& statistics_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_QUADRATIC_MODEL_H
