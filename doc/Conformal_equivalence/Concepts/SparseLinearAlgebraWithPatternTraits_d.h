// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgConformalEquivalenceConcepts
\cgalConcept

The concept `SparseLinearAlgebraWithPatternTraits_d` describes a direct solver that can keep the
analysis of a matrix's pattern (ordering and symbolic factorization) and factorize again when only
the numbers have changed. Newton's method solves many systems of one pattern: the analysis, which
costs about as much as the factorization, is then done once.

Models of `SparseLinearAlgebraWithFactorTraits_d` that do not have this split are accepted by every
function of the package too; they analyze the matrix in each call of `factor()`.

\cgalRefines{SparseLinearAlgebraWithFactorTraits_d}

\cgalHasModelsBegin
\cgalHasModels{CGAL::Conformal_equivalence::Multifrontal_solver_traits}
\cgalHasModels{CGAL::Conformal_equivalence::Eigen_pattern_solver_traits<EigenSolver>}
\cgalHasModelsEnd
*/
class SparseLinearAlgebraWithPatternTraits_d
{
public:
  /// type of a sparse matrix
  typedef unspecified_type Matrix;

  /// number type of the matrix
  typedef unspecified_type NT;

  /// orders the rows of `A` and analyzes the positions of its entries; the numbers are not read.
  /// Returns `true` on success.
  bool analyze_pattern(const Matrix& A);

  /// factorizes `A` with the kept analysis. `D` is set to 1, as by `factor()`.
  /// Returns `true` on success; a matrix that is not positive definite is a failure.
  /// \pre `analyze_pattern()` was called with a matrix that has its entries at the same positions
  bool refactor(const Matrix& A, NT& D);
};
