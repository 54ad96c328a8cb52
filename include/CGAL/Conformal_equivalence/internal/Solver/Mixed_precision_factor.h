// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A sparse Cholesky factorization for conjugate gradients: in single precision, which is all that a preconditioner needs, and in double where
// that is not enough, or where more is asked for.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_MIXED_PRECISION_FACTOR_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_MIXED_PRECISION_FACTOR_H

#include <CGAL/Conformal_equivalence/internal/Solver/Elimination_order.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Multifrontal_factor.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Symbolic_factor.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename Single, typename Double>
class Mixed_precision_factor
{
public:
  // Matrices of this pattern come next.
  void analyze(const Lower_half& a);

  // Returns whether the matrix is positive definite as far as rounding tells. \pre its pattern was analyzed
  bool factorize(Lower_half a);

  // How many threads may be used. Results do not depend on it.
  void set_concurrency(const Concurrency& concurrency);

  // Replaces b by approximately A^-1 b: the product with one symmetric positive definite matrix, up to rounding. Returns whether there is a factor.
  bool precondition(std::vector<double>& b);

  // Replaces b by A^-1 b, as accurately as a factor in double does it. The first call after a factorization may have to make that factor; from then
  // on it is the only one to be made. Returns whether there is one.
  bool solve(std::vector<double>& b);

private:
  bool make_double_factor(); // instead of the one in single precision, if there is any

  Lower_half a_;
  std::shared_ptr<const Symbolic_factor> symbolic_;
  std::unique_ptr<Multifrontal_factor<Single> > single_; // at most one of both is there
  std::unique_ptr<Multifrontal_factor<Double> > double_;
  bool is_solving_ = false;
  Concurrency concurrency_;
};

template <typename Single, typename Double>
void Mixed_precision_factor<Single, Double>::set_concurrency(const Concurrency& concurrency)
{
  concurrency_ = concurrency;
  if(single_)
    single_->set_concurrency(concurrency);
  if(double_)
    double_->set_concurrency(concurrency);
}

template <typename Single, typename Double>
void Mixed_precision_factor<Single, Double>::analyze(const Lower_half& a)
{
  single_.reset(); // before there is another one
  double_.reset();
  symbolic_.reset();
  symbolic_ = std::make_shared<Symbolic_factor>(a, Elimination_order(a, concurrency_), int(Symbolic_factor::usual_size_of_groups), concurrency_);
}

// A pivot bounds the smallest eigenvalue of the scaled matrix from above. Where one is as tiny as its rounding errors, or not much larger, so may be
// that eigenvalue, and the factor is none of A.
template <typename Single, typename Double>
bool Mixed_precision_factor<Single, Double>::factorize(Lower_half a)
{
  a_ = std::move(a);
  if(!symbolic_)
    return false;
  if(!is_solving_)
  {
    double_.reset();
    if(!single_)
      single_ = std::make_unique<Multifrontal_factor<Single> >(symbolic_, concurrency_);
    const double least_pivot = 100 * double(std::numeric_limits<Single>::epsilon());
    if(single_->factorize(a_) && single_->least_pivot() > least_pivot)
      return true;
  }
  single_.reset();
  return make_double_factor();
}

template <typename Single, typename Double>
bool Mixed_precision_factor<Single, Double>::make_double_factor()
{
  if(!double_)
    double_ = std::make_unique<Multifrontal_factor<Double> >(symbolic_, concurrency_);
  const bool is_made = double_->factorize(a_);
  if(is_made)
    single_.reset();
  else
    double_.reset();
  return is_made;
}

template <typename Single, typename Double>
bool Mixed_precision_factor<Single, Double>::precondition(std::vector<double>& b)
{
  if(single_)
    single_->solve(b);
  else if(double_)
    double_->solve(b);
  return single_ || double_;
}

template <typename Single, typename Double>
bool Mixed_precision_factor<Single, Double>::solve(std::vector<double>& b)
{
  is_solving_ = true;
  if(single_)
    make_double_factor();
  if(double_)
    double_->solve(b);
  return bool(double_);
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template void Mixed_precision_factor<float, double>::analyze(const Lower_half&);
extern template bool Mixed_precision_factor<float, double>::factorize(Lower_half);
extern template bool Mixed_precision_factor<float, double>::precondition(std::vector<double>&);
extern template bool Mixed_precision_factor<float, double>::solve(std::vector<double>&);
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_MIXED_PRECISION_FACTOR_H
