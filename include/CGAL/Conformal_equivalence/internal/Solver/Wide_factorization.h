// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The factorization L D L^T of a sparse symmetric matrix of wide numbers, row by row (T. A. Davis, "Algorithm 849: a concise sparse
// Cholesky factorization package", 2005): the method of Eigen's `SimplicialLDLT`. It serves the last resort of the solver alone, and
// Eigen's own for another number type would be among the dearest parts of every program to compile. The order of the unknowns comes
// from Eigen, on the pattern, as for `double`.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_FACTORIZATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_FACTORIZATION_H

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

typedef std::pair<std::uint32_t, std::uint32_t> Matrix_position; // row and column

// The pattern of a symmetric matrix of n rows, given by that of its lower half.
inline Eigen::SparseMatrix<double> symmetric_pattern(std::uint32_t n, const std::vector<Matrix_position>& lower)
{
  std::vector<std::vector<int> > column(n);
  for(const Matrix_position& p : lower)
  {
    column[p.first].push_back(int(p.second));
    column[p.second].push_back(int(p.first));
  }
  Eigen::SparseMatrix<double> result{Eigen::Index(n), Eigen::Index(n)};
  result.resizeNonZeros(Eigen::Index(2 * lower.size()));
  int* outer = result.outerIndexPtr();
  for(std::vector<int>& rows : column)
  {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    std::copy(rows.begin(), rows.end(), result.innerIndexPtr() + *outer);
    std::fill_n(result.valuePtr() + *outer, rows.size(), 1.);
    outer[1] = *outer + int(rows.size());
    ++outer;
  }
  result.resizeNonZeros(*outer);
  return result;
}

// The order in which the unknowns of a symmetric matrix of n rows should be eliminated: the new number of each one.
inline std::vector<std::uint32_t> elimination_order(std::uint32_t n, const std::vector<Matrix_position>& lower)
{
  Eigen::AMDOrdering<int>::PermutationType from; // which unknown comes k-th
  Eigen::AMDOrdering<int>()(symmetric_pattern(n, lower), from);
  std::vector<std::uint32_t> result(n);
  for(std::uint32_t k = 0; k < n; ++k)
    result[std::uint32_t(from.indices()[int(k)])] = k;
  return result;
}

template <typename Number>
class Wide_factorization
{
public:
  typedef std::uint32_t Index;
  typedef std::vector<std::vector<std::pair<Index, Number> > > Entries; // (row or column, value), of each column or row

  // The entries of the lower half: those of equal positions are added. All of the diagonal must be there.
  Wide_factorization(Index n, const std::vector<Matrix_position>& lower, const std::vector<Number>& values)
    : position_(elimination_order(n, lower)), column_(n), diagonal_(n, Number(0))
  {
    Entries row(n);
    for(std::size_t k = 0; k < lower.size(); ++k)
    {
      const std::pair<Index, Index> p = std::minmax(Index(position_[lower[k].first]), Index(position_[lower[k].second]));
      row[p.second].emplace_back(p.first, values[k]);
    }
    factorize(row);
  }

  // Were all pivots different from 0?
  bool is_regular() const { return is_regular_; }

  // \pre `is_regular()`
  std::vector<Number> solve(const std::vector<Number>& right) const
  {
    const Index n = Index(position_.size());
    std::vector<Number> x(right), result(right);
    for(Index i = 0; i < n; ++i)
      x[position_[i]] = right[i];
    for(Index j = 0; j < n; ++j)
      for(const auto& l : column_[j])
        x[l.first] -= l.second * x[j];
    for(Index j = 0; j < n; ++j)
      x[j] /= diagonal_[j];
    for(Index j = n; j-- > 0; )
      for(const auto& l : column_[j])
        x[j] -= l.second * x[l.first];
    for(Index i = 0; i < n; ++i)
      result[i] = x[position_[i]];
    return result;
  }

private:
  // Row k of L solves a triangular system with the rows before it. Its pattern: from every entry of the row of the matrix upwards in
  // the elimination tree, where the parent of a column is the row of its first entry below the diagonal.
  void factorize(const Entries& row)
  {
    const Index n = Index(row.size()), none = (std::numeric_limits<Index>::max)();
    std::vector<Index> parent(n, none), visited(n, none), pattern(n), path;
    std::vector<Number> y(n, Number(0));
    for(Index k = 0; k < n && is_regular_; ++k)
    {
      visited[k] = k;
      Index top = n;
      for(const auto& entry : row[k])
      {
        y[entry.first] += entry.second;
        path.clear();
        for(Index i = entry.first; visited[i] != k; i = parent[i])
        {
          if(parent[i] == none)
            parent[i] = k;
          visited[i] = k;
          path.push_back(i);
        }
        for(; !path.empty(); path.pop_back())
          pattern[--top] = path.back();
      }
      for(; top < n; ++top)
        eliminate(pattern[top], k, y);
      diagonal_[k] = y[k];
      y[k] = Number(0);
      is_regular_ = diagonal_[k] != Number(0);
    }
  }

  // Adds the entry of row k and column i to L.
  void eliminate(Index i, Index k, std::vector<Number>& y)
  {
    const Number y_i = y[i];
    y[i] = Number(0);
    for(const auto& l : column_[i])
      y[l.first] -= l.second * y_i;
    const Number l = y_i / diagonal_[i];
    y[k] -= l * y_i;
    column_[i].emplace_back(k, l);
  }

  std::vector<Index> position_; // of the unknowns, in the order of elimination
  Entries column_;              // of L, below the diagonal
  std::vector<Number> diagonal_;
  bool is_regular_ = true;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_FACTORIZATION_H
