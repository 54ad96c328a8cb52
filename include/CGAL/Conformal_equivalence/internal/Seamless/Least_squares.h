// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Small linear problems of least squares with complex numbers. This is Eigen::ColPivHouseholderQR, operation by operation, so that rounding errors
// are the same. That one needs Eigen's products of complex matrices, which cost a program seconds to compile.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_LEAST_SQUARES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_LEAST_SQUARES_H

#include <Eigen/Core>
#include <Eigen/Householder>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The factors a = Q R, by reflections, of the longest column that is left first.
class Least_squares
{
  typedef std::complex<double> Complex;
  typedef Eigen::VectorXcd Vector;
  typedef Eigen::Index Index;

public:
  explicit Least_squares(const Eigen::MatrixXcd& a) : number_of_rows_(a.rows())
  {
    for(Index j = 0; j < a.cols(); ++j)
    {
      columns_.push_back({a.col(j), j, 0, 0});
      columns_.back().norm = columns_.back().computed_norm = columns_.back().x.norm();
    }
    factorize();
  }

  // The x for which a x is closest to b; coefficients of columns that depend on others are zero.
  Vector solve(Vector b) const
  {
    for(Index k = 0; k < rank_; ++k)
      reflect(k, b, true);
    solve_upper(b);
    Vector result = Vector::Zero(Index(columns_.size()));
    for(Index k = 0; k < rank_; ++k)
      result(columns_[k].number) = b(k);
    return result;
  }

private:
  // Of R down to the diagonal, of the reflector below it. `norm`: of what is not yet in R, as it was at last computed or brought down from that.
  struct Column { Vector x; Index number; double norm, computed_norm; };

  void factorize()
  {
    const Index size = (std::min)(number_of_rows_, Index(columns_.size()));
    rank_ = size;
    double longest = 0;
    for(const Column& c : columns_)
      longest = (std::max)(longest, c.norm);
    const double rounding = longest * std::numeric_limits<double>::epsilon();
    for(Index k = 0; k < size; ++k)
    {
      const auto pivot = std::max_element(columns_.begin() + k, columns_.end(), [](const Column& c, const Column& d) { return c.norm < d.norm; });
      if(rank_ == size && pivot->norm * pivot->norm < rounding * rounding / double(number_of_rows_) * double(number_of_rows_ - k))
        rank_ = k;
      std::iter_swap(columns_.begin() + k, pivot);
      Complex tau;
      double diagonal;
      columns_[k].x.tail(number_of_rows_ - k).makeHouseholderInPlace(tau, diagonal);
      columns_[k].x(k) = diagonal;
      tau_.push_back(tau);
      for(std::size_t j = std::size_t(k) + 1; j < columns_.size(); ++j)
      {
        reflect(k, columns_[j].x, std::size_t(k) + 2 == columns_.size());
        bring_down_norm(k, columns_[j]);
      }
    }
  }

  // `is_alone`: if no other vector is reflected at the same time; Eigen then sums up in another order.
  void reflect(Index k, Vector& y, bool is_alone) const
  {
    const Index n = number_of_rows_ - k - 1;
    const auto reflector = columns_[k].x.tail(n);
    if(n == 0)
      y(k) *= 1. - tau_[k];
    else if(tau_[k] != 0.)
    {
      Complex product = 0;
      if(is_alone)
        product = reflector.dot(y.tail(n));
      else
        for(Index i = 0; i < n; ++i)
          product += std::conj(reflector(i)) * y(k + 1 + i);
      product += y(k);
      y(k) -= tau_[k] * product;
      y.tail(n) -= product * (tau_[k] * reflector);
    }
  }

  // Of a column after the reflection. (LAPACK working note 176.)
  void bring_down_norm(Index k, Column& c) const
  {
    if(c.norm == 0)
      return;
    const double taken = std::abs(c.x(k)) / c.norm, left = (std::max)((1 + taken) * (1 - taken), 0.), of_computed = c.norm / c.computed_norm;
    if(left * (of_computed * of_computed) <= std::sqrt(std::numeric_limits<double>::epsilon())) // too little is left of it
      c.norm = c.computed_norm = c.x.tail(number_of_rows_ - k - 1).norm();
    else
      c.norm *= std::sqrt(left);
  }

  // By columns, in panels: what the unknowns of one contribute to the rows above is summed up first.
  void solve_upper(Vector& y) const
  {
    const Index panel = 8;
    for(Index begin, end = rank_; end > 0; end = begin)
    {
      begin = (std::max)(end - panel, Index(0));
      for(Index k = end; k-- > begin;)
      {
        y(k) /= columns_[k].x(k);
        for(Index i = begin; i < k; ++i)
          y(i) -= y(k) * columns_[k].x(i);
      }
      for(Index i = 0; i < begin; ++i)
      {
        Complex sum = 0;
        for(Index k = begin; k < end; ++k)
          sum += columns_[k].x(i) * y(k);
        y(i) -= sum;
      }
    }
  }

  const Index number_of_rows_;
  std::vector<Column> columns_; // in the order of R
  std::vector<Complex> tau_;
  Index rank_ = 0;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_LEAST_SQUARES_H
