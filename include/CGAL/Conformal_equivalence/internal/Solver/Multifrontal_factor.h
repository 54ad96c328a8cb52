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

#include <CGAL/Conformal_equivalence/internal/Concurrency.h>
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
  explicit Multifrontal_factor(std::shared_ptr<const Symbolic_factor> symbolic, const Concurrency& concurrency = Concurrency())
    : symbolic_(std::move(symbolic)), concurrency_(concurrency)
  {}

  // Returns whether the matrix is positive definite as far as rounding tells; one with numbers that are not finite is not.
  // \pre its entries are at the positions that were analyzed
  bool factorize(const Lower_half& a);

  // Replaces b by A^-1 b. \pre the last factorization was a success
  void solve(std::vector<double>& b);

  // What is done with the factor may use several threads. Results do not depend on their number.
  void set_concurrency(const Concurrency& concurrency) { concurrency_ = concurrency; }

  // The smallest pivot, of the matrix that is scaled to a diagonal of about 1: an upper bound of its smallest eigenvalue.
  double least_pivot() const { return double(least_pivot_); }

private:
  typedef Symbolic_factor::Supernode Supernode;
  typedef Dense_front<Number> Front;
  static_assert(std::size_t(Front::overhang) <= Symbolic_factor::gap, "groups must not write to each other");

  // Room for numbers, which are not set before they are used: by the thread that uses them, as its pages come to be at the first use.
  class Room
  {
  public:
    void resize(std::size_t size)
    {
      if(size == size_)
        return;
      free();
      numbers_.reset(new Number[size]);
      size_ = size;
    }

    void free()
    {
      numbers_.reset();
      size_ = 0;
    }

    Number* data() { return numbers_.get(); }
    const Number* data() const { return numbers_.get(); }

  private:
    std::unique_ptr<Number[]> numbers_;
    std::size_t size_ = 0;
  };

  // What one group of subtrees, or the top, needs for itself.
  struct Workspace
  {
    Room stack[2];                // updates, while there are any
    Number* end[2];               // of what is on the stacks
    std::vector<Number> front;    // a vector on one front
    std::vector<Number> on_top;   // what vectors of the group add to the columns of the top
    Number least_pivot;
    bool is_eliminated;
  };

  bool scale(const Lower_half& a);
  void prepare();
  void make_stacks(std::size_t g);
  void free_stacks(std::size_t g);
  void eliminate_group(std::size_t g);
  void eliminate_top();
  bool eliminate(int s, Number* update, Workspace& space, const Concurrency& concurrency = Concurrency());
  void assemble(int s, Number* panel, Number* update, Workspace& space);
  void add_update(const Supernode& child, const Number* from, const Supernode& node, Number* panel, Number* update) const;
  void forward();
  void forward(const Supernode& node, int end_column, Workspace& space);
  void backward();
  void backward(const Supernode& node, Number* front);

  std::shared_ptr<const Symbolic_factor> symbolic_;
  std::vector<double> scale_;      // by unknown
  std::vector<Number> entries_;    // of the scaled matrix, while it is factorized
  Room values_;                    // of L, panel by panel
  Room kept_;                      // updates of the roots of subtrees, as long
  std::vector<std::size_t> place_of_kept_; // by supernode, if it is such a root
  std::vector<Workspace> spaces_;  // by group, and of the top
  std::vector<Number> x_;
  Number least_pivot_ = 0;
  Concurrency concurrency_;
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
  if(!scale(a))
    return false;
  prepare();
  concurrency_.for_each(int(symbolic_->groups.size()), [this](int g) { eliminate_group(std::size_t(g)); });
  eliminate_top();
  std::vector<Number>().swap(entries_);
  kept_.free();
  least_pivot_ = (std::numeric_limits<Number>::max)();
  bool is_eliminated = true;
  for(const Workspace& space : spaces_)
  {
    least_pivot_ = (std::min)(least_pivot_, space.least_pivot);
    is_eliminated = is_eliminated && space.is_eliminated;
  }
  return is_eliminated && least_pivot_ > std::numeric_limits<Number>::epsilon(); // smaller ones have not a single digit
}

// Makes room. That for L is kept for the next factorization.
template <typename Number>
void Multifrontal_factor<Number>::prepare()
{
  const Symbolic_factor& symbolic = *symbolic_;
  values_.resize(symbolic.number_of_values + Front::overhang);
  kept_.resize(symbolic.size_of_kept_updates + Front::overhang);
  place_of_kept_.resize(symbolic.supernodes.size());
  for(const std::vector<Symbolic_factor::Subtree>& group : symbolic.groups)
    for(const Symbolic_factor::Subtree& subtree : group)
      place_of_kept_[std::size_t(subtree.end) - 1] = subtree.update;
  spaces_.resize(symbolic.stacks.size());
  for(Workspace& space : spaces_)
  {
    space.least_pivot = (std::numeric_limits<Number>::max)();
    space.is_eliminated = true;
  }
}

template <typename Number>
void Multifrontal_factor<Number>::make_stacks(std::size_t g)
{
  for(int i = 0; i < 2; ++i)
  {
    spaces_[g].stack[i].resize(symbolic_->stacks[g].of_parity[i] + Front::overhang);
    spaces_[g].end[i] = spaces_[g].stack[i].data();
  }
}

// So the stacks of the next group, or what comes after the factorization, may be in the same place.
template <typename Number>
void Multifrontal_factor<Number>::free_stacks(std::size_t g)
{
  for(Room& stack : spaces_[g].stack)
    stack.free();
}

template <typename Number>
void Multifrontal_factor<Number>::eliminate_group(std::size_t g)
{
  Workspace& space = spaces_[g];
  make_stacks(g);
  for(const Symbolic_factor::Subtree& subtree : symbolic_->groups[g])
    for(int s = subtree.first; s < subtree.end && space.is_eliminated; ++s)
      space.is_eliminated = eliminate(s, s == subtree.end - 1 ? kept_.data() + subtree.update : nullptr, space);
  free_stacks(g);
}

template <typename Number>
void Multifrontal_factor<Number>::eliminate_top()
{
  const std::size_t last = spaces_.size() - 1;
  Workspace& space = spaces_[last];
  make_stacks(last);
  for(std::size_t g = 0; g < last; ++g)
    space.is_eliminated = space.is_eliminated && spaces_[g].is_eliminated;
  for(std::size_t i = 0; i < symbolic_->top.size() && space.is_eliminated; ++i)
    space.is_eliminated = eliminate(symbolic_->top[i], nullptr, space, concurrency_);
  free_stacks(last);
}

// The front of the supernode s, whose update goes to the stack, unless another place is given.
template <typename Number>
bool Multifrontal_factor<Number>::eliminate(int s, Number* update, Workspace& space, const Concurrency& concurrency)
{
  const Supernode& node = symbolic_->supernodes[s];
  Number* const panel = values_.data() + node.panel;
  Number* const to = update != nullptr ? update : space.end[node.depth % 2];
  assemble(s, panel, to, space);
  const int least_size_for_threads = 256;
  const bool is_eliminated = concurrency.is_sequential() || node.front_size() < least_size_for_threads
    ? Front::eliminate(panel, to, node.number_of_columns, node.number_of_rows, space.least_pivot)
    : Front::eliminate(panel, to, node.number_of_columns, node.number_of_rows, space.least_pivot, concurrency);
  if(!is_eliminated)
    return false;
  if(update == nullptr)
    space.end[node.depth % 2] += node.update_size();
  return true;
}

// Makes the front of a supernode of its entries and of the updates of its children, which it takes from their stack. What vectors read beyond
// the end is set, too: it belongs to the same group, and not to anything that is there already.
template <typename Number>
void Multifrontal_factor<Number>::assemble(int s, Number* panel, Number* update, Workspace& space)
{
  const Symbolic_factor& symbolic = *symbolic_;
  const Supernode& node = symbolic.supernodes[s];
  std::fill_n(panel, node.panel_size() + Front::overhang, Number(0));
  std::fill_n(update, node.update_size() + Front::overhang, Number(0));
  for(int j = 0; j < node.number_of_columns; ++j)
    for(int k = symbolic.first_entry[node.first_column + j]; k < symbolic.first_entry[node.first_column + j + 1]; ++k)
      panel[std::ptrdiff_t(j) * node.front_size() + symbolic.entries[k].row] = entries_[symbolic.entries[k].source];
  Number*& children_end = space.end[1 - node.depth % 2];
  for(int child = node.first_child; child != Symbolic_factor::none; child = symbolic.supernodes[child].next_sibling)
  {
    const bool is_kept = symbolic.is_in_top(s) && !symbolic.is_in_top(child);
    if(!is_kept)
      children_end -= symbolic.supernodes[child].update_size();
    add_update(symbolic.supernodes[child], is_kept ? kept_.data() + place_of_kept_[child] : children_end, node, panel, update);
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
  const std::size_t n = std::size_t(symbolic.size());
  const double largest = concurrency_.largest(n, [&](std::size_t j) { return std::abs(b[j] * scale_[j]); });
  int exponent = 0;
  std::frexp(largest, &exponent);
  const double shrink = std::ldexp(1., -exponent), grow = std::ldexp(1., exponent);
  x_.resize(b.size());
  for(Workspace& space : spaces_)
  {
    space.front.assign(std::size_t(symbolic.largest_front) + Front::overhang, Number(0));
    space.on_top.resize(symbolic.top_columns.size());
  }
  concurrency_.for_each_range(n, [&](std::size_t first, std::size_t last)
  {
    for(std::size_t j = first; j < last; ++j)
      x_[j] = Number(b[symbolic.unknowns[j]] * scale_[symbolic.unknowns[j]] * shrink);
  });
  forward();
  backward();
  concurrency_.for_each_range(n, [&](std::size_t first, std::size_t last)
  {
    for(std::size_t j = first; j < last; ++j)
      b[symbolic.unknowns[j]] = double(x_[j]) * scale_[symbolic.unknowns[j]] * grow;
  });
}

template <typename Number>
void Multifrontal_factor<Number>::forward()
{
  const Symbolic_factor& symbolic = *symbolic_;
  concurrency_.for_each(int(symbolic.groups.size()), [&](int g)
  {
    std::fill(spaces_[g].on_top.begin(), spaces_[g].on_top.end(), Number(0));
    for(const Symbolic_factor::Subtree& subtree : symbolic.groups[g])
      for(int s = subtree.first; s < subtree.end; ++s)
        forward(symbolic.supernodes[s], symbolic.supernodes[subtree.end - 1].end_column(), spaces_[g]);
  });
  for(std::size_t g = 0; g < symbolic.groups.size(); ++g)
    for(std::size_t i = 0; i < symbolic.top_columns.size(); ++i)
      x_[symbolic.top_columns[i]] += spaces_[g].on_top[i];
  for(const int s : symbolic.top)
    forward(symbolic.supernodes[s], symbolic.size(), spaces_.back());
}

// One supernode. Rows from `end_column` on are in the top, which groups do not touch. Where the right side is zero but for one entry, all but the
// way from there to the root stays zero, and is left out.
template <typename Number>
void Multifrontal_factor<Number>::forward(const Supernode& node, int end_column, Workspace& space)
{
  const int* const rows = symbolic_->rows.data() + node.first_row;
  const int columns = node.number_of_columns;
  const auto right_side = x_.begin() + node.first_column;
  if(std::all_of(right_side, right_side + columns, [](Number entry) { return entry == 0; }))
    return;
  Number* const x = space.front.data();
  std::copy_n(x_.data() + node.first_column, columns, x);
  std::fill_n(x + columns, node.number_of_rows + Front::overhang, Number(0));
  Front::solve_forward(values_.data() + node.panel, columns, node.number_of_rows, x);
  std::copy_n(x, columns, x_.data() + node.first_column);
  for(int i = 0; i < node.number_of_rows; ++i)
    (rows[i] < end_column ? x_[rows[i]] : space.on_top[symbolic_->place_in_top[rows[i]]]) += x[columns + i];
}

template <typename Number>
void Multifrontal_factor<Number>::backward()
{
  const Symbolic_factor& symbolic = *symbolic_;
  for(auto s = symbolic.top.rbegin(); s != symbolic.top.rend(); ++s)
    backward(symbolic.supernodes[*s], spaces_.back().front.data());
  concurrency_.for_each(int(symbolic.groups.size()), [&](int g)
  {
    for(auto subtree = symbolic.groups[g].rbegin(); subtree != symbolic.groups[g].rend(); ++subtree)
      for(int s = subtree->end - 1; s >= subtree->first; --s)
        backward(symbolic.supernodes[s], spaces_[g].front.data());
  });
}

template <typename Number>
void Multifrontal_factor<Number>::backward(const Supernode& node, Number* x)
{
  const int* const rows = symbolic_->rows.data() + node.first_row;
  const int columns = node.number_of_columns;
  std::copy_n(x_.data() + node.first_column, columns, x);
  for(int i = 0; i < node.number_of_rows; ++i)
    x[columns + i] = x_[rows[i]];
  std::fill_n(x + node.front_size(), Front::overhang, Number(0));
  Front::solve_backward(values_.data() + node.panel, columns, node.number_of_rows, x);
  std::copy_n(x, columns, x_.data() + node.first_column);
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_MULTIFRONTAL_FACTOR_H
