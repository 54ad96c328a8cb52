// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Eigen_pattern_solver_traits.h
/// The direct solvers of Eigen with the analysis of a matrix's pattern split from
/// the factorization of its numbers.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_EIGEN_PATTERN_SOLVER_TRAITS_H
#define CGAL_CONFORMAL_EQUIVALENCE_EIGEN_PATTERN_SOLVER_TRAITS_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/internal/Solver/One_linear_algebra_thread.h>

#include <CGAL/Eigen_solver_traits.h>

#include <Eigen/SparseCholesky>
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_CHOLMOD
#  include <Eigen/CholmodSupport>
#endif

#include <type_traits>
#include <utility>

namespace CGAL {
namespace Conformal_equivalence {

namespace internal {

template <typename Solver, typename = void>
struct Is_cholmod_solver : std::false_type {};

template <typename Solver>
struct Is_cholmod_solver<Solver, std::void_t<decltype(std::declval<Solver&>().cholmod().method[0].ordering)> >
  : std::true_type {};

template <typename Solver, typename = void>
struct Has_diagonal : std::false_type {};

template <typename Solver>
struct Has_diagonal<Solver, std::void_t<decltype(std::declval<const Solver&>().vectorD())> >
  : std::true_type {};

} // namespace internal

/// \ingroup PkgConformalEquivalenceSolver
///
/// Gives the symmetric direct solvers of \ref thirdpartyEigen "Eigen" the three
/// steps analyze, factorize, solve, so that matrices of the same pattern share one
/// analysis. The matrix is symmetric positive definite; its lower half is read.
///
/// CHOLMOD is told to order by minimum degree (AMD): its own choice, METIS, takes
/// several times longer than the factorization that it helps, for surfaces of up to
/// a million vertices. It prints nothing.
///
/// \tparam EigenSolver `Eigen::SimplicialLDLT`, `Eigen::SimplicialLLT`,
///         `Eigen::CholmodSupernodalLLT` or another direct solver with `analyzePattern()` and
///         `factorize()` that reads the lower half of the matrix.
///
/// While CHOLMOD works, OpenBLAS and OpenMP are held to one thread, and left as they were afterwards.
///
/// \cgalModels{SparseLinearAlgebraWithPatternTraits_d}
template <typename EigenSolver>
class Eigen_pattern_solver_traits
  : public CGAL::Eigen_solver_traits<EigenSolver>
{
  typedef CGAL::Eigen_solver_traits<EigenSolver> Base;
  typedef std::conditional_t<internal::Is_cholmod_solver<EigenSolver>::value, internal::One_linear_algebra_thread, internal::Any_number_of_threads>
    Threads;

public:
  typedef typename Base::Matrix Matrix; ///< sparse matrix
  typedef typename Base::Vector Vector; ///< vector
  typedef typename Base::NT     NT;     ///< number type

  /// has nothing analyzed yet.
  Eigen_pattern_solver_traits()
  {
    if constexpr(internal::Is_cholmod_solver<EigenSolver>::value)
    {
      auto& common = this->solver().cholmod();
      const int amd = 2; // CHOLMOD_AMD
      common.nmethods = 1;
      common.method[0].ordering = amd;
      common.postorder = true;
      common.print = 0;
    }
  }

  /// orders the rows and analyzes the pattern of `A`. Returns `true` on success.
  bool analyze_pattern(const Matrix& A)
  {
    [[maybe_unused]] const Threads threads;
    this->solver().analyzePattern(A.eigen_object());
    return true;
  }

  /// factorizes `A`, of which only the numbers have changed since `analyze_pattern()`.
  /// Returns `true` iff `A` is positive definite as far as rounding tells.
  bool refactor(const Matrix& A, NT& D)
  {
    [[maybe_unused]] const Threads threads;
    D = NT(1);
    this->solver().factorize(A.eigen_object());
    return is_positive_definite();
  }

  /// analyzes and factorizes `A`. Returns `true` iff it is positive definite.
  bool factor(const Matrix& A, NT& D)
  {
    return analyze_pattern(A) && refactor(A, D);
  }

  /// solves \f$ A \times X = B \f$ for the matrix last factorized, which need not exist any more.
  bool linear_solver(const Vector& B, Vector& X)
  {
    [[maybe_unused]] const Threads threads;
    X = this->solver().solve(B);
    return this->solver().info() == Eigen::Success;
  }

  using Base::linear_solver;

private:
  bool is_positive_definite()
  {
    if(this->solver().info() != Eigen::Success)
      return false;
    if constexpr(internal::Has_diagonal<EigenSolver>::value)
      return this->solver().vectorD().minCoeff() > NT(0);
    return true;
  }
};

/// \ingroup PkgConformalEquivalenceSolver
/// Eigen's own sparse Cholesky factorization. Needs no further library.
typedef Eigen_pattern_solver_traits<Eigen::SimplicialLDLT<Eigen_sparse_matrix<double>::EigenType> > Simplicial_solver_traits;

#if defined(CGAL_CONFORMAL_EQUIVALENCE_USE_CHOLMOD) || defined(DOXYGEN_RUNNING)
/// \ingroup PkgConformalEquivalenceSolver
/// CHOLMOD's supernodal Cholesky factorization. It is there where the macro `CGAL_CONFORMAL_EQUIVALENCE_USE_CHOLMOD` is defined
/// (by the CMake target `Conformal_equivalence::CHOLMOD_support`).
typedef Eigen_pattern_solver_traits<Eigen::CholmodSupernodalLLT<Eigen_sparse_matrix<double>::EigenType> > Cholmod_solver_traits;
#endif

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_EIGEN_PATTERN_SOLVER_TRAITS_H
