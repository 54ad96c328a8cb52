// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// In which order the unknowns of a sparse symmetric system are eliminated. The order decides how many entries the factor has: here it is that of
// approximate minimum degree (P. R. Amestoy, T. A. Davis and I. S. Duff, "An approximate minimum degree ordering algorithm", 1996), by Eigen.
// For the Laplacian of a surface of a hundred thousand vertices METIS's nested dissection saves a third of the factorization, and takes ten
// times longer to find.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ELIMINATION_ORDER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ELIMINATION_ORDER_H

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The lower half of a sparse symmetric matrix, with the diagonal, by columns; rows ascend within a column.
struct Lower_half
{
  std::vector<int> first = std::vector<int>(1, 0); // by column, and the end: its first entry
  std::vector<int> row;
  std::vector<double> value;

  int size() const { return int(first.size()) - 1; }
};

// The lower half of a matrix of which both halves, or only the lower one, are given.
template <typename EigenMatrix>
Lower_half lower_half(const EigenMatrix& a)
{
  Lower_half result;
  result.first.reserve(std::size_t(a.cols()) + 1);
  result.row.reserve(std::size_t(a.nonZeros()));
  result.value.reserve(std::size_t(a.nonZeros()));
  for(int column = 0; column < int(a.cols()); ++column)
  {
    for(typename EigenMatrix::InnerIterator entry(a, column); entry; ++entry)
      if(entry.row() >= column)
      {
        result.row.push_back(int(entry.row()));
        result.value.push_back(entry.value());
      }
    result.first.push_back(int(result.row.size()));
  }
  return result;
}

// Which unknown is eliminated first, second, ...
class Elimination_order
{
public:
  // Any order that is given.
  explicit Elimination_order(std::vector<int> unknowns) : unknown_(std::move(unknowns)) {}

  // A good one for this matrix.
  explicit Elimination_order(const Lower_half& a) : unknown_(std::size_t(a.size()))
  {
    typedef Eigen::SparseMatrix<double> Matrix;
    if(unknown_.empty())
      return;
    const Eigen::Map<const Matrix> lower(a.size(), a.size(), Eigen::Index(a.row.size()), a.first.data(), a.row.data(), a.value.data());
    Eigen::AMDOrdering<int>::PermutationType order;
    Eigen::AMDOrdering<int>()(lower.selfadjointView<Eigen::Lower>(), order);
    std::copy_n(order.indices().data(), unknown_.size(), unknown_.begin());
  }

  const std::vector<int>& unknowns() const { return unknown_; }

private:
  std::vector<int> unknown_;
};

// The inverse of a permutation.
inline std::vector<int> inverse_permutation(const std::vector<int>& p)
{
  std::vector<int> result(p.size());
  for(std::size_t i = 0; i < p.size(); ++i)
    result[std::size_t(p[i])] = int(i);
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ELIMINATION_ORDER_H
