// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What the solver asks of a sparse Cholesky factorization, and how it is made of solver traits.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_FACTORIZATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_FACTORIZATION_H

#include <CGAL/Conformal_equivalence/Eigen_pattern_solver_traits.h>
#include <CGAL/Conformal_equivalence/Multifrontal_solver_traits.h>
#include <CGAL/Conformal_equivalence/internal/Concurrency.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Elimination_order.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Mixed_precision_factor.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <Eigen/SparseCore>

#include <cstddef>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// One factor of A. It hides the type of the solver traits, so that what works with it is compiled once for all of them.
class Factorization
{
public:
  virtual ~Factorization() = default;

  // The next matrix has another pattern.
  virtual void forget_pattern() = 0;

  // How many threads may be used, if the solver traits have any use for it.
  virtual void set_number_of_threads(unsigned number_of_threads) = 0;

  // factorizes the symmetric matrix of which `lower` is the lower half
  virtual bool factor(Eigen::SparseMatrix<double> lower) = 0;

  // replaces b by A^-1 b, with the matrix last factorized
  virtual bool solve(std::vector<double>& b) = 0;

  // replaces b by an approximation of A^-1 b that is good enough for a preconditioner; takes no longer
  virtual bool precondition(std::vector<double>& b) = 0;
};

template <typename Traits, typename = void>
struct Has_pattern_analysis : std::false_type {};

template <typename Traits>
struct Has_pattern_analysis<Traits, std::void_t<decltype(std::declval<Traits&>().analyze_pattern(
    std::declval<const typename Traits::Matrix&>()))> > : std::true_type {};

template <typename Traits, typename = void>
struct Has_preconditioner : std::false_type {};

template <typename Traits>
struct Has_preconditioner<Traits, std::void_t<decltype(std::declval<Traits&>().precondition(
    std::declval<const typename Traits::Vector&>(), std::declval<typename Traits::Vector&>()))> > : std::true_type {};

template <typename Traits, typename = void>
struct Has_threads : std::false_type {};

template <typename Traits>
struct Has_threads<Traits, std::void_t<decltype(std::declval<Traits&>().set_number_of_threads(1u))> > : std::true_type {};

// The factor that solver traits make. Traits without the split of analysis
// and factorization (any model of CGAL's `SparseLinearAlgebraWithFactorTraits_d`)
// get the whole matrix through `set_coef()`.
template <typename SolverTraits>
class Factorization_by final : public Factorization
{
  typedef typename SolverTraits::Matrix Matrix;
  typedef typename SolverTraits::Vector Vector;

public:
  explicit Factorization_by(const SolverTraits& traits) : traits_(traits) {}

  void forget_pattern() override { is_analyzed_ = false; }

  void set_number_of_threads([[maybe_unused]] unsigned number_of_threads) override
  {
    if constexpr(Has_threads<SolverTraits>::value)
      traits_.set_number_of_threads(number_of_threads);
  }

  bool factor(Eigen::SparseMatrix<double> lower) override
  {
    typename SolverTraits::NT denominator;
    if constexpr(Has_pattern_analysis<SolverTraits>::value)
    {
      Matrix matrix{typename Matrix::EigenType()};
      matrix.eigen_object().swap(lower);
      if(!is_analyzed_ && !traits_.analyze_pattern(matrix))
        return false;
      is_analyzed_ = true;
      return traits_.refactor(matrix, denominator);
    }
    else
    {
      matrix_ = std::make_unique<Matrix>(int(lower.rows()), int(lower.rows()));
      for(int c = 0; c < lower.outerSize(); ++c)
        for(Eigen::SparseMatrix<double>::InnerIterator entry(lower, c); entry; ++entry)
        {
          matrix_->set_coef(entry.row(), c, entry.value(), true);
          if(entry.row() != c)
            matrix_->set_coef(c, entry.row(), entry.value(), true);
        }
      return traits_.factor(*matrix_, denominator);
    }
  }

  bool solve(std::vector<double>& b) override
  {
    return replace(b, [this](const Vector& right, Vector& solution) { return traits_.linear_solver(right, solution); });
  }

  bool precondition(std::vector<double>& b) override
  {
    if constexpr(Has_preconditioner<SolverTraits>::value)
      return replace(b, [this](const Vector& right, Vector& solution) { return traits_.precondition(right, solution); });
    else
      return solve(b);
  }

private:
  template <typename Function>
  bool replace(std::vector<double>& b, const Function& solve)
  {
    if(!right_ || size_ != b.size())
    {
      right_ = std::make_unique<Vector>(int(b.size()));
      solution_ = std::make_unique<Vector>(int(b.size()));
      size_ = b.size();
    }
    for(std::size_t i = 0; i < b.size(); ++i)
      (*right_)[int(i)] = b[i];
    if(!solve(*right_, *solution_))
      return false;
    for(std::size_t i = 0; i < b.size(); ++i)
      b[i] = (*solution_)[int(i)];
    return true;
  }

  SolverTraits traits_;
  std::unique_ptr<Matrix> matrix_; // such traits may refer to it
  bool is_analyzed_ = false;
  std::unique_ptr<Vector> right_, solution_; // allocated once for all systems of `size_` unknowns
  std::size_t size_ = 0;
};

// The factor of this package works with vectors and matrices of its own, of which there is then but one copy each.
template <>
class Factorization_by<Multifrontal_solver_traits> final : public Factorization
{
public:
  explicit Factorization_by(const Multifrontal_solver_traits&) {} // copies of which know nothing

  void forget_pattern() override { is_analyzed_ = false; }
  void set_number_of_threads(unsigned number_of_threads) override { factor_.set_concurrency(Concurrency(number_of_threads)); }

  bool factor(Eigen::SparseMatrix<double> lower) override
  {
    Lower_half a = lower_half(lower);
    Eigen::SparseMatrix<double>().swap(lower); // its memory is needed for the factor
    if(!is_analyzed_)
      factor_.analyze(a);
    is_analyzed_ = true;
    return factor_.factorize(std::move(a));
  }

  bool solve(std::vector<double>& b) override { return factor_.solve(b); }
  bool precondition(std::vector<double>& b) override { return factor_.precondition(b); }

private:
  Mixed_precision_factor<float, double> factor_;
  bool is_analyzed_ = false;
};

template <typename SolverTraits>
std::unique_ptr<Factorization> make_factorization(const SolverTraits& traits = SolverTraits())
{
  return std::make_unique<Factorization_by<SolverTraits> >(traits);
}

// Makes one after the other, for engines that solve several problems and are no templates on the solver traits.
typedef std::function<std::unique_ptr<Factorization>()> Factorization_maker;

template <typename SolverTraits>
Factorization_maker factorization_maker(SolverTraits traits = SolverTraits())
{
  return [traits] { return make_factorization(traits); };
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template std::unique_ptr<Factorization> make_factorization(const Multifrontal_solver_traits&);
extern template std::unique_ptr<Factorization> make_factorization(const Simplicial_solver_traits&);
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_FACTORIZATION_H
