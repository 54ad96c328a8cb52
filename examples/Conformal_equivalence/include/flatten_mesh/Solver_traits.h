// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_SOLVER_TRAITS_H
#define FLATTEN_MESH_SOLVER_TRAITS_H

#include <CGAL/Conformal_equivalence/Eigen_pattern_solver_traits.h>

namespace flattening {

// The linear solver that --solver names. It is chosen while the program runs, so that all that stands on it is compiled for one
// type. A copy is a solver of the same kind that has nothing to solve yet.
class Solver_traits
{
  typedef CGAL::Conformal_equivalence::Default_solver_traits    Default;
  typedef CGAL::Conformal_equivalence::Simplicial_solver_traits Simplicial;

public:
  typedef Default::Matrix Matrix;
  typedef Default::Vector Vector;
  typedef Default::NT     NT;

  explicit Solver_traits(bool is_simplicial) : is_simplicial_(is_simplicial) {}
  Solver_traits(const Solver_traits& other) : is_simplicial_(other.is_simplicial_) {}
  Solver_traits(Solver_traits&&) = default;
  Solver_traits& operator=(const Solver_traits&) = delete;
  Solver_traits& operator=(Solver_traits&&) = default;

  bool analyze_pattern(const Matrix& A)
  {
    return is_simplicial_ ? simplicial_.analyze_pattern(A) : default_.analyze_pattern(A);
  }
  bool refactor(const Matrix& A, NT& D) { return is_simplicial_ ? simplicial_.refactor(A, D) : default_.refactor(A, D); }
  bool factor(const Matrix& A, NT& D)   { return is_simplicial_ ? simplicial_.factor(A, D) : default_.factor(A, D); }

  bool linear_solver(const Vector& B, Vector& X)
  {
    return is_simplicial_ ? simplicial_.linear_solver(B, X) : default_.linear_solver(B, X);
  }
  bool linear_solver(const Matrix& A, const Vector& B, Vector& X, NT& D)
  {
    return is_simplicial_ ? simplicial_.linear_solver(A, B, X, D) : default_.linear_solver(A, B, X, D);
  }

private:
  bool is_simplicial_;
  Default default_;
  Simplicial simplicial_;
};

} // namespace flattening

#endif // FLATTEN_MESH_SOLVER_TRAITS_H
