// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Multifrontal_solver_traits.h
/// The sparse Cholesky factorization of this package, which it uses unless told otherwise.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_MULTIFRONTAL_SOLVER_TRAITS_H
#define CGAL_CONFORMAL_EQUIVALENCE_MULTIFRONTAL_SOLVER_TRAITS_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/internal/Solver/Mixed_precision_factor.h>

#include <CGAL/Eigen_solver_traits.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceSolver
///
/// A sparse Cholesky factorization by the multifrontal method, made for the Laplacians of surfaces. Needs no further
/// library, and starts no threads.
///
/// The matrix is symmetric positive definite; its lower half is read. It is ordered by approximate minimum degree, a large one
/// part by part after it was divided by separators. It is scaled, and factorized in single precision, which takes half of the
/// memory and of the time. That factor is what `precondition()` works with. Where single precision is not enough to tell that the
/// matrix is positive definite, it is factorized in double. So it is when `linear_solver()` is called, the results of which are
/// as accurate as those of any factorization in double; and from then on. The last bits of results depend on whether the
/// processor has AVX2.
///
/// \cgalModels{SparseLinearAlgebraWithPatternTraits_d}
class Multifrontal_solver_traits
{
public:
  typedef Eigen_sparse_matrix<double> Matrix; ///< sparse matrix
  typedef Eigen_vector<double>        Vector; ///< vector
  typedef double                      NT;     ///< number type

  /// has nothing analyzed yet.
  Multifrontal_solver_traits() = default;

  /// has nothing analyzed yet, either.
  Multifrontal_solver_traits(const Multifrontal_solver_traits&) {}

  /// forgets everything.
  Multifrontal_solver_traits& operator=(const Multifrontal_solver_traits&)
  {
    factor_ = Factor();
    return *this;
  }

  /// takes what was analyzed and factorized.
  Multifrontal_solver_traits(Multifrontal_solver_traits&&) = default;

  /// takes what was analyzed and factorized.
  Multifrontal_solver_traits& operator=(Multifrontal_solver_traits&&) = default;

  /// orders the rows and analyzes the pattern of `A`. Returns `true`.
  bool analyze_pattern(const Matrix& A)
  {
    factor_.analyze(internal::lower_half(A.eigen_object()));
    return true;
  }

  /// factorizes `A`, of which only the numbers have changed since `analyze_pattern()`.
  /// Returns `true` iff `A` is positive definite as far as rounding tells.
  bool refactor(const Matrix& A, NT& D)
  {
    D = 1;
    return factor_.factorize(internal::lower_half(A.eigen_object()));
  }

  /// analyzes and factorizes `A`. Returns `true` iff it is positive definite.
  bool factor(const Matrix& A, NT& D)
  {
    return analyze_pattern(A) && refactor(A, D);
  }

  /// solves \f$ A \times X = B \f$ for the matrix last factorized, which need not exist any more.
  bool linear_solver(const Vector& B, Vector& X)
  {
    return apply(B, X, [this](std::vector<double>& b) { return factor_.solve(b); });
  }

  /// factorizes `A` and solves \f$ A \times X = B \f$.
  bool linear_solver(const Matrix& A, const Vector& B, Vector& X, NT& D)
  {
    return factor(A, D) && linear_solver(B, X);
  }

  /// computes an approximation of the solution of \f$ A \times X = B \f$ for the matrix last factorized, a good
  /// preconditioner for the conjugate gradient method. The approximation is linear and symmetric positive definite, up to rounding.
  bool precondition(const Vector& B, Vector& X)
  {
    return apply(B, X, [this](std::vector<double>& b) { return factor_.precondition(b); });
  }

  /// allows so many threads, also for the next analysis; only one is used where the program does not link
  /// `Conformal_equivalence::TBB_support`. Results do not depend on their number.
  void set_number_of_threads(unsigned int number_of_threads) { factor_.set_concurrency(internal::Concurrency(number_of_threads)); }

private:
  typedef internal::Mixed_precision_factor<float, double> Factor;

  template <typename Function>
  bool apply(const Vector& B, Vector& X, const Function& replace)
  {
    b_.assign(B.data(), B.data() + B.size());
    const bool is_solved = replace(b_);
    X.resize(B.size());
    for(std::size_t i = 0; i < b_.size(); ++i)
      X[int(i)] = b_[i];
    return is_solved;
  }

  Factor factor_;
  std::vector<double> b_; // right-hand side, then solution
};

/// \ingroup PkgConformalEquivalenceSolver
/// The solver used where none is named.
typedef Multifrontal_solver_traits Default_solver_traits;

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_MULTIFRONTAL_SOLVER_TRAITS_H
