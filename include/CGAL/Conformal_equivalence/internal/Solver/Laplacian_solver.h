// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The linear algebra of the solver: systems with the matrix A of Edge_graph.h, which changes from one to the next. It
// is applied edge by edge, and assembled only to be factorized; the factor of
// one A serves as preconditioner for the conjugate gradient method with later ones. Where some of the free vertices are held, a
// factor keeps its pattern, and one made before still serves.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_LAPLACIAN_SOLVER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_LAPLACIAN_SOLVER_H

#include <CGAL/Conformal_equivalence/internal/Concurrency.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Conjugate_gradients.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Edge_graph.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Sorts the n entries of a column by rows, those in one row as they are; most columns have three or four.
inline void sort_column(int* row, double* value, int n)
{
  const int many = 32;
  if(n > many)
  {
    std::vector<std::pair<int, double> > sorted;
    for(int k = 0; k < n; ++k)
      sorted.emplace_back(row[k], value[k]);
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    for(int k = 0; k < n; ++k)
      std::tie(row[k], value[k]) = sorted[k];
    return;
  }
  for(int k = 1; k < n; ++k)
    for(int i = k; i > 0 && row[i - 1] > row[i]; --i)
    {
      std::swap(row[i - 1], row[i]);
      std::swap(value[i - 1], value[i]);
    }
}

// The lower half of A plus a diagonal, if that is not empty, by columns, in the order of the free vertices.
inline Eigen::SparseMatrix<double> assemble_lower(const Edge_graph& graph, const std::vector<double>& w,
                                                  const Vertex_vector& shift, const Concurrency& concurrency = Concurrency())
{
  typedef Eigen::SparseMatrix<double> Matrix;
  const int n = int(graph.number_of_free);
  Matrix a(n, n);

  // the number of edges below the diagonal in each column, and the diagonal itself
  std::vector<int> first(n + 1, 0);
  const auto entry = [&](std::size_t e, int& row, int& column)
  {
    const auto i = graph.ends[e].first, j = graph.ends[e].second;
    if(i == j || !graph.is_free(i) || !graph.is_free(j))
      return false;
    row = int((std::max)(graph.free_index[i], graph.free_index[j]));
    column = int((std::min)(graph.free_index[i], graph.free_index[j]));
    return true;
  };
  int row, column;
  for(std::size_t e = 0; e < graph.ends.size(); ++e)
    if(entry(e, row, column))
      ++first[column + 1];
  for(int c = 0; c < n; ++c)
    first[c + 1] += first[c] + 1;
  a.resizeNonZeros(first[n]);

  std::vector<int> free_place(first.begin(), first.end() - 1);
  int* rows = a.innerIndexPtr();
  double* values = a.valuePtr();
  const Vertex_vector d = graph.diagonal(w);
  for(std::size_t v = 0; v < d.size(); ++v)
    if(graph.is_free(std::uint32_t(v)))
    {
      const int c = int(graph.free_index[v]);
      rows[free_place[c]] = c;
      values[free_place[c]++] = d[v] + (shift.empty() ? 0 : shift[v]);
    }
  for(std::size_t e = 0; e < graph.ends.size(); ++e)
    if(entry(e, row, column))
    {
      rows[free_place[column]] = row;
      values[free_place[column]++] = graph.is_held(graph.ends[e].first) || graph.is_held(graph.ends[e].second) ? 0 : -w[e] / 2;
    }

  // sort every column, equal rows in the order of the edges, and join multiple edges
  concurrency.for_each_range(std::size_t(n), [&](std::size_t first_column, std::size_t last_column)
  {
    for(std::size_t c = first_column; c < last_column; ++c)
      sort_column(rows + first[c], values + first[c], first[c + 1] - first[c]);
  });
  int end = 0;
  for(int c = 0; c < n; ++c)
  {
    a.outerIndexPtr()[c] = end;
    for(int k = first[c]; k < first[c + 1]; ++k)
    {
      if(end > a.outerIndexPtr()[c] && rows[end - 1] == rows[k])
        values[end - 1] += values[k];
      else
      {
        rows[end] = rows[k];
        values[end++] = values[k];
      }
    }
  }
  a.outerIndexPtr()[n] = end;
  a.resizeNonZeros(end);
  return a;
}

// At free vertices that are not held x is what `replace` makes of the entries of b, by free vertex, of which it returns whether it could; elsewhere
// 0. `free` is room for these.
template <typename Function>
bool replace_free_entries(const Edge_graph& graph, const Vertex_vector& b, std::vector<double>& free, Vertex_vector& x, const Function& replace,
                          const Concurrency& concurrency = Concurrency())
{
  x.assign(b.size(), 0.);
  if(graph.number_of_free == 0)
    return true;
  free.resize(graph.number_of_free);
  concurrency.for_each_range(b.size(), [&](std::size_t first, std::size_t last)
  {
    for(std::size_t v = first; v < last; ++v)
      if(graph.is_free(std::uint32_t(v)))
        free[graph.free_index[v]] = b[v];
  });
  if(!replace(free))
    return false;
  concurrency.for_each_range(b.size(), [&](std::size_t first, std::size_t last)
  {
    for(std::size_t v = first; v < last; ++v)
      if(graph.is_free(std::uint32_t(v)) && !graph.is_held(std::uint32_t(v)))
        x[v] = free[graph.free_index[v]];
  });
  return true;
}

// Systems A x = b for changing A: a kept factor and preconditioned conjugate gradients.
class Laplacian_solver
{
public:
  explicit Laplacian_solver(std::unique_ptr<Factorization> factor) : factor_(std::move(factor)) {}

  const Edge_graph& graph() const { return graph_; }
  bool has_factor() const { return has_factor_; }
  std::size_t number_of_factorizations() const { return number_of_factorizations_; }
  std::size_t number_of_regularized_rows() const { return number_of_regularized_rows_; }

  template <typename Surface>
  void set_edges(const Surface& t)
  {
    graph_.set_edges(t);
    graph_.set_free(std::vector<char>(t.number_of_vertices(), 0));
    has_factor_ = false;
  }

  // The ends of an edge have changed: the kept factor still serves as preconditioner, but the next one has another pattern.
  template <typename Surface>
  void change_edge(const Surface& t, std::uint32_t e)
  {
    graph_.set_edge(t, e);
    factor_->forget_pattern();
  }

  // The same for all edges, whose number may be another one. \pre the vertices are the same
  template <typename Surface>
  void change_edges(const Surface& t)
  {
    graph_.set_edges(t);
    factor_->forget_pattern();
  }

  // The factor is kept if the free vertices are those of the last call. None is held.
  void set_free(const std::vector<char>& free)
  {
    hold_none();
    if(has_factor_ && graph_.free_vertices() == free)
      return;
    graph_.set_free(free);
    factor_->forget_pattern();
    has_factor_ = false;
  }

  void forget_factor() { has_factor_ = false; }

  // How many threads may be used. Results do not depend on it.
  void set_number_of_threads(unsigned number_of_threads)
  {
    factor_->set_number_of_threads(number_of_threads);
    concurrency_ = Concurrency(number_of_threads);
    iteration_.set_concurrency(concurrency_);
  }

  // Holds some of the free vertices. The kept factor still serves.
  void hold(std::vector<char> held) { graph_.held = std::move(held); }
  void hold_none() { graph_.held.clear(); }

  // factorizes A(w), regularized until it is positive definite; if that fails because rounding
  // has spoiled w (there are triangles with cotangents of 1e15), the Laplacian of tame weights
  bool factorize(const std::vector<double>& w)
  {
    has_factor_ = graph_.number_of_free == 0;
    if(has_factor_)
      return true;
    std::size_t rows = 0;
    Vertex_vector shift = regularization(graph_, w, rows);
    number_of_regularized_rows_ = (std::max)(number_of_regularized_rows_, rows);
    for(double relative = 1e-10; relative < 1; relative *= 100)
    {
      ++number_of_factorizations_;
      if(factor_->factor(assemble_lower(graph_, w, shift, concurrency_)))
        return has_factor_ = true;
      const Vertex_vector diagonal = graph_.diagonal(w);
      shift.resize(diagonal.size(), 0.);
      for(std::size_t v = 0; v < shift.size(); ++v)
        shift[v] += relative * (std::max)(diagonal[v], 0.);
    }
    ++number_of_factorizations_;
    const std::vector<double> tame_weights = tame(w);
    return has_factor_ = factor_->factor(assemble_lower(
      graph_, tame_weights, graph_.held.empty() ? Vertex_vector() : regularization(graph_, tame_weights, rows), concurrency_));
  }

  // x = A^-1 b with the matrix last factorized
  bool solve(const Vertex_vector& b, Vertex_vector& x)
  {
    return apply_factor(b, x, [this](std::vector<double>& free) { return factor_->solve(free); });
  }

  // The same approximately, by a factor that need not be one in double: always the same symmetric positive definite matrix, though.
  bool precondition(const Vertex_vector& b, Vertex_vector& x)
  {
    return apply_factor(b, x, [this](std::vector<double>& free) { return factor_->precondition(free); });
  }

  // Conjugate gradients for A(w) x = b from x = 0, preconditioned by the kept
  // factor, until no entry of the residual is larger than `tolerance` times the largest of b, or
  // after `most` iterations, or, if `may_give_up`, as soon as it is foreseen that these do not do; one solution with the factor each.
  // Returns their number.
  std::size_t conjugate_gradients(const std::vector<double>& w, const Vertex_vector& b, double tolerance,
                                  std::size_t most, bool may_give_up, Vertex_vector& x, bool& converged)
  {
    x.assign(b.size(), 0.);
    converged = graph_.number_of_free == 0 || tolerance * largest_entry(b) == 0;
    if(converged || (!has_factor_ && !factorize(w)))
      return 0;
    System system(*this, w);
    return iteration_.solve(system, b, tolerance, most, may_give_up, x, converged);
  }

private:
  // A(w), regularized, and the kept factor.
  class System
  {
  public:
    System(Laplacian_solver& solver, const std::vector<double>& w) : solver_(solver), w_(w), shift_(regularization(solver.graph_, w, rows_)) {}

    bool precondition(const Vertex_vector& r, Vertex_vector& z) { return solver_.precondition(r, z); }

    void multiply(const Vertex_vector& x, Vertex_vector& y) const
    {
      solver_.graph_.multiply(w_, x, y);
      if(rows_ > 0)
        for(std::size_t v = 0; v < y.size(); ++v)
          y[v] += shift_[v] * x[v];
    }

  private:
    Laplacian_solver& solver_;
    const std::vector<double>& w_;
    std::size_t rows_ = 0; // that are regularized
    const Vertex_vector shift_;
  };

  template <typename Function>
  bool apply_factor(const Vertex_vector& b, Vertex_vector& x, const Function& replace)
  {
    return replace_free_entries(graph_, b, free_, x, replace, concurrency_);
  }

  // Positive weights of moderate range.
  static std::vector<double> tame(const std::vector<double>& w)
  {
    std::vector<double> size(w);
    for(double& x : size)
      x = std::isfinite(x) ? std::abs(x) : 0;
    std::vector<double> sorted(size);
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    const double median = sorted[sorted.size() / 2] > 0 ? sorted[sorted.size() / 2] : 1;
    for(double& x : size)
      x = (std::min)((std::max)(x, 1e-3 * median), 1e3 * median);
    return size;
  }

  Edge_graph graph_;
  std::unique_ptr<Factorization> factor_;
  bool has_factor_ = false;
  Conjugate_gradients iteration_;
  Concurrency concurrency_;
  std::vector<double> free_; // by free vertex: what is solved for
  std::size_t number_of_factorizations_ = 0, number_of_regularized_rows_ = 0;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_LAPLACIAN_SOLVER_H
