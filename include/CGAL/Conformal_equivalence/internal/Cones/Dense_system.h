// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Systems with as many unknowns as there are cones: Gaussian elimination with complete pivoting, as Eigen::FullPivLU does it. That one works by
// blocks, for large matrices, which costs a program seconds to compile.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_DENSE_SYSTEM_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_DENSE_SYSTEM_H

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Dense_system
{
  typedef Eigen::Index Index;

public:
  explicit Dense_system(Eigen::MatrixXd matrix) : lu_(std::move(matrix)), n_(lu_.rows()), rows_(numbered(n_)), columns_(numbered(n_))
  {
    double largest = 0;
    for(; rank_ < n_; ++rank_)
    {
      take_pivot();
      const double pivot = std::abs(lu_(rank_, rank_));
      largest = (std::max)(largest, pivot);
      if(pivot <= largest * double(n_) * std::numeric_limits<double>::epsilon()) // what is left are rounding errors
        break;
      eliminate();
    }
  }

  // A solution; what is not determined is zero. A NaN in the matrix makes it NaN.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const
  {
    std::vector<double> y(rows_.size());
    for(Index i = 0; i < n_; ++i)
      y[i] = b[rows_[i]];
    for(Index begin = 0; begin < rank_; begin += panel_)
    {
      const Index end = (std::min)(begin + panel_, rank_);
      for(Index k = begin; k < end; ++k)
        for(Index i = k + 1; i < end; ++i)
          y[i] -= y[k] * lu_(i, k);
      take_off(y, begin, end, end, rank_);
    }
    for(Index begin, end = rank_; end > 0; end = begin)
    {
      begin = (std::max)(end - panel_, Index(0));
      for(Index k = end; k-- > begin;)
      {
        y[k] /= lu_(k, k);
        for(Index i = begin; i < k; ++i)
          y[i] -= y[k] * lu_(i, k);
      }
      take_off(y, begin, end, 0, begin);
    }
    Eigen::VectorXd result = Eigen::VectorXd::Zero(n_);
    for(Index k = 0; k < rank_; ++k)
      result[columns_[k]] = y[k];
    return result;
  }

  Eigen::MatrixXd inverse() const
  {
    Eigen::MatrixXd result(n_, n_);
    for(Index j = 0; j < n_; ++j)
    {
      Eigen::VectorXd unit = Eigen::VectorXd::Zero(n_);
      unit[j] = 1;
      const Eigen::VectorXd x = solve(unit);
      for(Index i = 0; i < n_; ++i)
        result(i, j) = x[i];
    }
    return result;
  }

private:
  static std::vector<Index> numbered(Index n)
  {
    std::vector<Index> result(static_cast<std::size_t>(n));
    std::iota(result.begin(), result.end(), Index(0));
    return result;
  }

  // Exchanges rows and columns so that the largest number of those left comes first. A NaN is taken for the largest: it must spoil the result.
  void take_pivot()
  {
    Index r = rank_, c = rank_;
    double largest = 0;
    for(Index j = rank_; j < n_; ++j)
      for(Index i = rank_; i < n_; ++i)
      {
        const double x = std::abs(lu_(i, j));
        if(x > largest || std::isnan(x))
          r = i, c = j, largest = x;
      }
    for(Index j = 0; j < n_; ++j)
      std::swap(lu_(rank_, j), lu_(r, j));
    for(Index i = 0; i < n_; ++i)
      std::swap(lu_(i, rank_), lu_(i, c));
    std::swap(rows_[rank_], rows_[r]);
    std::swap(columns_[rank_], columns_[c]);
  }

  void eliminate()
  {
    const Index k = rank_;
    for(Index i = k + 1; i < n_; ++i)
      lu_(i, k) /= lu_(k, k);
    for(Index j = k + 1; j < n_; ++j)
      for(Index i = k + 1; i < n_; ++i)
        lu_(i, j) -= lu_(i, k) * lu_(k, j);
  }

  // Takes what the unknowns of a panel contribute to other rows off from their right sides.
  void take_off(std::vector<double>& y, Index panel_begin, Index panel_end, Index begin, Index end) const
  {
    for(Index i = begin; i < end; ++i)
    {
      double sum = 0;
      for(Index k = panel_begin; k < panel_end; ++k)
        sum += lu_(i, k) * y[k];
      y[i] -= sum;
    }
  }

  static constexpr Index panel_ = 8; // columns, as Eigen takes them: so rounding errors are the same

  Eigen::MatrixXd lu_;                // the factors, without the ones on the diagonal of the lower
  const Index n_;
  std::vector<Index> rows_, columns_; // of the matrix, in the order of the factors
  Index rank_ = 0;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_DENSE_SYSTEM_H
