// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The factorization A = L L^T of a sparse symmetric positive definite matrix by the multifrontal method (I. S. Duff and J. K. Reid, 1983;
// J. W. H. Liu, "The multifrontal method for sparse matrix solution: theory and practice", 1992): front by front in postorder of the elimination
// tree. A front gathers its entries of A and the updates of its children, its columns are eliminated, and what remains is its own update.
//
// In single precision it takes half of the memory, and hence half of the time where memory is what is waited for; it is then good for a
// preconditioner. The matrix is scaled by powers of two such that its diagonal is between 1/2 and 2. Thus no number is too large or too tiny for
// single precision, and the condition is nearly the best that scaling can give (A. van der Sluis, 1969).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_MULTIFRONTAL_FACTOR_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_MULTIFRONTAL_FACTOR_H

#include <CGAL/Conformal_equivalence/internal/Solver/Dense_front.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Symbolic_factor.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename Number>
class Multifrontal_factor
{
public:
  explicit Multifrontal_factor(std::shared_ptr<const Symbolic_factor> symbolic) : symbolic_(std::move(symbolic)) {}

  // Returns whether the matrix is positive definite as far as rounding tells; one with numbers that are not finite is not.
  // \pre its entries are at the positions that were analyzed
  bool factorize(const Lower_half& a);

  // Replaces b by A^-1 b. \pre the last factorization was a success
  void solve(std::vector<double>& b);

  // The smallest pivot, of the matrix that is scaled to a diagonal of about 1: an upper bound of its smallest eigenvalue.
  double least_pivot() const { return double(least_pivot_); }

private:
  typedef Symbolic_factor::Supernode Supernode;
  typedef Dense_front<Number> Front;

  bool scale(const Lower_half& a);
  void assemble(std::size_t s, Number* panel, Number* update, Number*& children_end);
  void add_update(const Supernode& child, const Number* from, const Supernode& node, Number* panel, Number* update) const;
  void forward();
  void backward();

  std::shared_ptr<const Symbolic_factor> symbolic_;
  std::vector<double> scale_;      // by unknown
  std::vector<Number> entries_;    // of the scaled matrix
  std::vector<Number> values_;     // of L, panel by panel
  std::vector<Number> stack_[2];   // updates
  std::vector<Number> x_, front_x_;
  Number least_pivot_ = 0;
};

// The entries of the scaled matrix. Returns whether all of them are finite and the diagonal is positive.
template <typename Number>
bool Multifrontal_factor<Number>::scale(const Lower_half& a)
{
  scale_.assign(std::size_t(a.size()), 0.);
  for(int j = 0; j < a.size(); ++j)
    for(int k = a.first[j]; k < a.first[j + 1]; ++k)
      if(a.row[k] == j)
      {
        if(!(a.value[k] > 0 && std::isfinite(a.value[k])))
          return false;
        int exponent;
        std::frexp(a.value[k], &exponent);
        scale_[j] = std::ldexp(1., -int(std::floor(exponent / 2.)));
      }
  entries_.resize(a.row.size());
  for(int j = 0; j < a.size(); ++j)
    for(int k = a.first[j]; k < a.first[j + 1]; ++k)
    {
      const double entry = a.value[k] * scale_[j] * scale_[a.row[k]], most = 2;
      if(!(std::abs(entry) <= most)) // in a positive definite matrix the largest entry is on the diagonal
        return false;
      entries_[k] = Number(entry);
    }
  return true;
}

template <typename Number>
bool Multifrontal_factor<Number>::factorize(const Lower_half& a)
{
  const Symbolic_factor& symbolic = *symbolic_;
  if(!scale(a))
    return false;
  values_.resize(symbolic.number_of_values + Front::overhang);
  Number* top[2];
  for(int i = 0; i < 2; ++i)
  {
    stack_[i].resize(symbolic.stack_size[i] + Front::overhang);
    top[i] = stack_[i].data();
  }
  least_pivot_ = (std::numeric_limits<Number>::max)();
  for(std::size_t s = 0; s < symbolic.supernodes.size(); ++s)
  {
    const Supernode& node = symbolic.supernodes[s];
    Number *const panel = values_.data() + node.panel, *const update = top[node.depth % 2];
    assemble(s, panel, update, top[1 - node.depth % 2]);
    if(!Front::eliminate(panel, update, node.number_of_columns, node.number_of_rows, least_pivot_))
      return false;
    top[node.depth % 2] += node.update_size();
  }
  return least_pivot_ > std::numeric_limits<Number>::epsilon(); // smaller ones have not a single digit
}

// Makes the front of a supernode of its entries and of the updates of its children, which it takes from their stack.
template <typename Number>
void Multifrontal_factor<Number>::assemble(std::size_t s, Number* panel, Number* update, Number*& children_end)
{
  const Symbolic_factor& symbolic = *symbolic_;
  const Supernode& node = symbolic.supernodes[s];
  std::fill_n(panel, node.panel_size(), Number(0));
  std::fill_n(update, node.update_size(), Number(0));
  for(std::size_t k = symbolic.first_entry[s]; k < symbolic.first_entry[s + 1]; ++k)
    values_[symbolic.entries[k].place] = entries_[symbolic.entries[k].source];
  for(int child = node.first_child; child != Symbolic_factor::none; child = symbolic.supernodes[child].next_sibling)
  {
    children_end -= symbolic.supernodes[child].update_size();
    add_update(symbolic.supernodes[child], children_end, node, panel, update);
  }
}

// Adds the update of a child to the front of its parent.
template <typename Number>
void Multifrontal_factor<Number>::add_update(const Supernode& child, const Number* from, const Supernode& node, Number* panel, Number* update) const
{
  const int* const place = symbolic_->rows_in_parent.data() + child.first_row;
  const int n = child.number_of_rows, size = node.front_size(), columns = node.number_of_columns, rows = node.number_of_rows;
  for(int j = 0; j < n; ++j, from += n)
  {
    const int first_row = place[j] < columns ? 0 : columns;
    Number* const to = place[j] < columns ? panel + std::ptrdiff_t(place[j]) * size : update + std::ptrdiff_t(place[j] - columns) * rows;
    for(int i = j; i < n; ++i)
      to[place[i] - first_row] += from[i];
  }
}

template <typename Number>
void Multifrontal_factor<Number>::solve(std::vector<double>& b)
{
  const Symbolic_factor& symbolic = *symbolic_;
  double largest = 0;
  for(int j = 0; j < symbolic.size(); ++j)
    largest = (std::max)(largest, std::abs(b[j] * scale_[j]));
  int exponent = 0;
  std::frexp(largest, &exponent);
  const double shrink = std::ldexp(1., -exponent), grow = std::ldexp(1., exponent);
  x_.resize(b.size());
  front_x_.assign(std::size_t(symbolic.largest_front) + Front::overhang, Number(0));
  for(int j = 0; j < symbolic.size(); ++j)
    x_[j] = Number(b[symbolic.unknowns[j]] * scale_[symbolic.unknowns[j]] * shrink);
  forward();
  backward();
  for(int j = 0; j < symbolic.size(); ++j)
    b[symbolic.unknowns[j]] = double(x_[j]) * scale_[symbolic.unknowns[j]] * grow;
}

template <typename Number>
void Multifrontal_factor<Number>::forward()
{
  Number* const x = front_x_.data();
  for(const Supernode& node : symbolic_->supernodes)
  {
    const int* const rows = symbolic_->rows.data() + node.first_row;
    const int columns = node.number_of_columns;
    std::copy_n(x_.data() + node.first_column, columns, x);
    std::fill_n(x + columns, node.number_of_rows + Front::overhang, Number(0));
    Front::solve_forward(values_.data() + node.panel, columns, node.number_of_rows, x);
    std::copy_n(x, columns, x_.data() + node.first_column);
    for(int i = 0; i < node.number_of_rows; ++i)
      x_[rows[i]] += x[columns + i];
  }
}

template <typename Number>
void Multifrontal_factor<Number>::backward()
{
  Number* const x = front_x_.data();
  for(auto node = symbolic_->supernodes.rbegin(); node != symbolic_->supernodes.rend(); ++node)
  {
    const int* const rows = symbolic_->rows.data() + node->first_row;
    const int columns = node->number_of_columns;
    std::copy_n(x_.data() + node->first_column, columns, x);
    for(int i = 0; i < node->number_of_rows; ++i)
      x[columns + i] = x_[rows[i]];
    std::fill_n(x + node->front_size(), Front::overhang, Number(0));
    Front::solve_backward(values_.data() + node->panel, columns, node->number_of_rows, x);
    std::copy_n(x, columns, x_.data() + node->first_column);
  }
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_MULTIFRONTAL_FACTOR_H
