// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// In which order the unknowns of a sparse symmetric system are eliminated. The order decides how many entries the factor has, and how much of it
// can be computed at the same time. Large graphs are divided into parts by separators, which come last; the parts, and graphs that
// are not large, are ordered by approximate minimum degree (P. R. Amestoy, T. A. Davis and I. S. Duff, "An approximate minimum degree ordering
// algorithm", 1996), by Eigen.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ELIMINATION_ORDER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ELIMINATION_ORDER_H

#include <CGAL/Conformal_equivalence/internal/Concurrency.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Nested_dissection.h>

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

  // A good one for this matrix. It does not depend on the number of threads.
  explicit Elimination_order(const Lower_half& a, const Concurrency& concurrency = Concurrency())
  {
    int levels = 0;
    while((a.size() >> levels) > size_of_parts)
      ++levels;
    if(levels < 2 || !order_by_parts(a, levels, concurrency))
      unknown_ = order_of_minimum_degree(a.first, a.row);
  }

  const std::vector<int>& unknowns() const { return unknown_; }

private:
  static constexpr int size_of_parts = 8000; // at most

  // Of the matrix of which the lower half has these entries. Unknowns without an entry on the diagonal would come last.
  static std::vector<int> order_of_minimum_degree(const std::vector<int>& first, const std::vector<int>& row)
  {
    typedef Eigen::SparseMatrix<double> Matrix;
    const int n = int(first.size()) - 1;
    std::vector<int> result(static_cast<std::size_t>(n));
    if(n == 0)
      return result;
    const std::vector<double> value(row.size(), 0.); // which does not matter
    const Eigen::Map<const Matrix> lower(n, n, Eigen::Index(row.size()), first.data(), row.data(), value.data());
    Eigen::AMDOrdering<int>::PermutationType order;
    Eigen::AMDOrdering<int>()(lower.selfadjointView<Eigen::Lower>(), order);
    std::copy_n(order.indices().data(), result.size(), result.begin());
    return result;
  }

  // The neighbors of every unknown, by its number: of `first` the numbers where they begin.
  static void find_neighbors(const Lower_half& a, std::vector<int>& first, std::vector<int>& neighbor)
  {
    first.assign(std::size_t(a.size()) + 1, 0);
    const auto for_each = [&](const auto& action)
    {
      for(int column = 0; column < a.size(); ++column)
        for(int k = a.first[column]; k < a.first[column + 1]; ++k)
          if(a.row[k] != column)
            action(a.row[k], column);
    };
    for_each([&](int v, int w) { ++first[v + 1]; ++first[w + 1]; });
    for(int v = 0; v < a.size(); ++v)
      first[v + 1] += first[v];
    neighbor.resize(std::size_t(first.back()));
    std::vector<int> free_place(first.begin(), first.end() - 1);
    for_each([&](int v, int w) { neighbor[free_place[v]++] = w; neighbor[free_place[w]++] = v; });
  }

  // Returns whether the separators are as short as those of surfaces.
  bool order_by_parts(const Lower_half& a, int levels, const Concurrency& concurrency)
  {
    std::vector<int> first, neighbor;
    find_neighbors(a, first, neighbor);
    const Nested_dissection dissection(first, neighbor, levels, concurrency);
    if(dissection.number_of_separating_vertices() > std::size_t(a.size()) / 8)
      return false;
    std::vector<std::vector<int> > sets = dissection.sets();
    std::vector<int> set(std::size_t(a.size())), place(std::size_t(a.size()));
    for(std::size_t s = 0; s < sets.size(); ++s)
      for(std::size_t i = 0; i < sets[s].size(); ++i)
      {
        set[sets[s][i]] = int(s);
        place[sets[s][i]] = int(i);
      }
    concurrency.for_each(int(dissection.number_of_parts()), [&](int s)
    {
      std::vector<int> local_first(1, 0), local_row;
      for(int i = 0; i < int(sets[s].size()); ++i)
      {
        const int v = sets[s][i];
        local_row.push_back(i);
        for(int k = first[v]; k < first[v + 1]; ++k)
          if(set[neighbor[k]] == s && place[neighbor[k]] > i)
            local_row.push_back(place[neighbor[k]]);
        local_first.push_back(int(local_row.size()));
      }
      std::vector<int> ordered;
      for(const int i : order_of_minimum_degree(local_first, local_row))
        ordered.push_back(sets[s][i]);
      sets[s].swap(ordered);
    });
    unknown_.reserve(set.size());
    for(const std::vector<int>& s : sets)
      unknown_.insert(unknown_.end(), s.begin(), s.end());
    return true;
  }

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
