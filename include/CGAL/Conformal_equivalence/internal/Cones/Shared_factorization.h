// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The search for cones and the metrics with them factorize matrices of nearly the same pattern, one after the other. What is known of a pattern, the
// order of elimination above all, takes longer to find than a factor; so it is kept from the one to the other.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_SHARED_FACTORIZATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_SHARED_FACTORIZATION_H

#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// One of several users of a factorization. Each has its own matrix. Where another one has factorized since, that is done again before a solution.
class Shared_factorization final : public Factorization
{
  typedef Eigen::SparseMatrix<double> Matrix;

public:
  // What the users share.
  class Core
  {
  public:
    explicit Core(std::unique_ptr<Factorization> factorization) : factorization_(std::move(factorization)) {}

  private:
    friend class Shared_factorization;

    bool factor(const Matrix& lower)
    {
      if(embed(lower))
        return factorization_->factor(pattern_);
      factorization_->forget_pattern();
      pattern_ = lower;
      return factorization_->factor(lower);
    }

    // Writes the matrix into the pattern that is known, with zeros elsewhere. Returns whether it fits.
    bool embed(const Matrix& lower)
    {
      if(pattern_.outerSize() != lower.outerSize() || pattern_.nonZeros() > most_zeros * double(lower.nonZeros()))
        return false;
      std::fill_n(pattern_.valuePtr(), pattern_.nonZeros(), 0.);
      const int* const row = pattern_.innerIndexPtr();
      for(int c = 0; c < lower.outerSize(); ++c)
      {
        int place = pattern_.outerIndexPtr()[c];
        const int end = pattern_.outerIndexPtr()[c + 1];
        for(Matrix::InnerIterator entry(lower, c); entry; ++entry)
        {
          while(place < end && row[place] < entry.row())
            ++place;
          if(place == end || row[place] != entry.row())
            return false;
          pattern_.valuePtr()[place] = entry.value();
        }
      }
      return true;
    }

    static constexpr double most_zeros = 1.25; // the factor of what may be in the pattern: zeros cost time, too

    std::unique_ptr<Factorization> factorization_;
    Matrix pattern_;               // that is known, with the last matrix in it
    std::size_t number_of_users_ = 0;
    std::size_t last_user_ = 0;    // whose factor it is; 0 if there is none
  };

  explicit Shared_factorization(std::shared_ptr<Core> core) : core_(std::move(core)), user_(++core_->number_of_users_) {}

  void forget_pattern() override {} // patterns are compared

  void set_number_of_threads(unsigned number_of_threads) override { core_->factorization_->set_number_of_threads(number_of_threads); }

  bool factor(Matrix lower) override
  {
    lower.makeCompressed();
    matrix_ = std::move(lower);
    return factor_again();
  }

  bool solve(std::vector<double>& b) override { return has_factor() && core_->factorization_->solve(b); }
  bool precondition(std::vector<double>& b) override { return has_factor() && core_->factorization_->precondition(b); }

private:
  bool has_factor() { return core_->last_user_ == user_ || factor_again(); }

  bool factor_again()
  {
    const bool is_factorized = core_->factor(matrix_);
    core_->last_user_ = is_factorized ? user_ : 0;
    return is_factorized;
  }

  std::shared_ptr<Core> core_;
  const std::size_t user_;
  Matrix matrix_;
};

// Makes the users of a factorization.
inline Factorization_maker shared_factorization_maker(const Factorization_maker& make_factorization)
{
  const auto core = std::make_shared<Shared_factorization::Core>(make_factorization());
  return [core] { return std::make_unique<Shared_factorization>(core); };
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_SHARED_FACTORIZATION_H
