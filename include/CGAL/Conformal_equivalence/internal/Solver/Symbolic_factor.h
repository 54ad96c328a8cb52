// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What the factorization A = L L^T of a sparse symmetric positive definite matrix needs to know of the positions of the entries: the elimination
// tree (J. W. H. Liu, "The role of elimination trees in sparse factorization", 1990), the number of entries of every column of L (J. R. Gilbert,
// E. G. Ng and B. W. Peyton, "An efficient algorithm to compute row and column counts for sparse Cholesky factorization", 1994), and the
// supernodes: successive columns whose entries are in the same rows, or nearly so (J. W. H. Liu, "The multifrontal method for sparse matrix
// solution", 1992). Small supernodes are merged with their parents at the price of a few zeros, as in CHOLMOD.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_SYMBOLIC_FACTOR_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_SYMBOLIC_FACTOR_H

#include <CGAL/Conformal_equivalence/internal/Concurrency.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Elimination_order.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The parent of column j in the elimination tree is the first row below the diagonal in which column j of L has an entry.
namespace elimination_tree {

constexpr int none = -1;

// Entries off the diagonal, in the order of elimination, by columns (the rows below the diagonal) or by rows (the columns left of it). With each
// of them goes its number in the matrix.
struct Ordered_pattern
{
  std::vector<int> first, index, source;
};

inline Ordered_pattern ordered_pattern(const Lower_half& a, const std::vector<int>& position, bool by_columns)
{
  const auto line = [&](int row, int column)
  {
    const std::pair<int, int> p = std::minmax(int(position[std::size_t(row)]), int(position[std::size_t(column)]));
    return by_columns ? p : std::make_pair(p.second, p.first);
  };
  Ordered_pattern result;
  result.first.assign(std::size_t(a.size()) + 1, 0);
  const auto for_each = [&](const auto& action)
  {
    for(int column = 0; column < a.size(); ++column)
      for(int k = a.first[column]; k < a.first[column + 1]; ++k)
        if(a.row[k] != column)
          action(line(a.row[k], column), k);
  };
  for_each([&](const std::pair<int, int>& p, int) { ++result.first[p.first + 1]; });
  for(int j = 0; j < a.size(); ++j)
    result.first[j + 1] += result.first[j];
  result.index.resize(std::size_t(result.first.back()));
  result.source.resize(std::size_t(result.first.back()));
  std::vector<int> free_place(result.first.begin(), result.first.end() - 1);
  for_each([&](const std::pair<int, int>& p, int k)
           {
             result.index[free_place[p.first]] = p.second;
             result.source[free_place[p.first]++] = k;
           });
  return result;
}

// The parents, from the entries by rows. From every entry upwards in the forest of the rows before, the root gets a parent; shortcuts are kept.
inline std::vector<int> parents(const Ordered_pattern& by_rows)
{
  const int n = int(by_rows.first.size()) - 1;
  std::vector<int> result(n, none), shortcut(n, none);
  for(int row = 0; row < n; ++row)
    for(int k = by_rows.first[row]; k < by_rows.first[row + 1]; ++k)
      for(int j = by_rows.index[k]; j != none && j != row; )
      {
        const int next = shortcut[j];
        shortcut[j] = row;
        if(next == none)
          result[j] = row;
        j = next;
      }
  return result;
}

// The columns such that children come right before their parents.
inline std::vector<int> postorder(const std::vector<int>& parent)
{
  const int n = int(parent.size());
  std::vector<int> first_child(n, none), sibling(n, none), result, path;
  result.reserve(parent.size());
  for(int j = n - 1; j >= 0; --j)
    if(parent[j] != none)
    {
      sibling[j] = first_child[parent[j]];
      first_child[parent[j]] = j;
    }
  for(int root = 0; root < n; ++root)
  {
    if(parent[root] != none)
      continue;
    path.assign(1, root);
    while(!path.empty())
    {
      const int j = path.back(), child = first_child[j];
      if(child != none)
      {
        first_child[j] = sibling[child];
        path.push_back(child);
        continue;
      }
      result.push_back(j);
      path.pop_back();
    }
  }
  return result;
}

// A forest whose nodes get other numbers: `order` tells which one is the first, second, ...
inline std::vector<int> renumbered(const std::vector<int>& parent, const std::vector<int>& order)
{
  const std::vector<int> number = inverse_permutation(order);
  std::vector<int> result(parent.size(), none);
  for(std::size_t j = 0; j < order.size(); ++j)
    if(parent[order[j]] != none)
      result[j] = number[parent[order[j]]];
  return result;
}

// The root of a tree of shortcuts, which are made shorter.
inline int root_of(std::vector<int>& shortcut, int j)
{
  int root = j;
  while(shortcut[root] != root)
    root = shortcut[root];
  while(shortcut[j] != root)
    j = std::exchange(shortcut[j], root);
  return root;
}

// The number of entries of every column of L, with the diagonal; the columns are in postorder. Row i of L is a subtree with the root i; a column
// has one entry more than all its children together for each row subtree that has a leaf there, and one less for each two
// branches of one that meet there, and for each child.
inline std::vector<int> column_counts(const Ordered_pattern& by_columns, const std::vector<int>& parent)
{
  const int n = int(parent.size());
  std::vector<int> count(n, 0), first_descendant(n, none), last_leaf(n, none), last_neighbor(n, none), shortcut(n);
  for(int j = 0; j < n; ++j)
  {
    shortcut[j] = j;
    if(first_descendant[j] == none)
      count[j] = 1; // a leaf of the tree
    for(int i = j; i != none && first_descendant[i] == none; i = parent[i])
      first_descendant[i] = j;
  }
  for(int j = 0; j < n; ++j)
  {
    for(int k = by_columns.first[j]; k < by_columns.first[j + 1]; ++k)
    {
      const int row = by_columns.index[k];
      if(first_descendant[j] > last_neighbor[row]) // j is a leaf of that row's subtree
      {
        ++count[j];
        if(last_leaf[row] != none)
          --count[root_of(shortcut, last_leaf[row])];
        last_leaf[row] = j;
      }
      last_neighbor[row] = j;
    }
    if(parent[j] != none)
    {
      --count[parent[j]];
      shortcut[j] = parent[j];
    }
  }
  for(int j = 0; j < n; ++j)
    if(parent[j] != none)
      count[parent[j]] += count[j];
  return count;
}

} // namespace elimination_tree

// The columns of L in supernodes. The front of a supernode is a dense symmetric matrix: its rows are the columns of the supernode, then rows below
// these. The supernode's part of L is the first columns of the front, its panel; what is left then, the update, is added to the parent's front.
class Symbolic_factor
{
public:
  static constexpr int none = elimination_tree::none;

  struct Supernode
  {
    int first_column = 0, number_of_columns = 0, number_of_rows = 0; // rows below the columns
    int parent = none, first_child = none, next_sibling = none;      // supernodes; the last child comes first
    int depth = 0;                                                   // 0 without a parent
    std::size_t first_row = 0, panel = 0;                            // where its rows, and its part of L, begin

    int end_column() const { return first_column + number_of_columns; }
    int front_size() const { return number_of_columns + number_of_rows; }
    std::size_t panel_size() const { return std::size_t(front_size()) * std::size_t(number_of_columns); }
    std::size_t update_size() const { return std::size_t(number_of_rows) * std::size_t(number_of_rows); }
  };

  // An entry of the matrix, and the row of the front that it is in.
  struct Entry
  {
    int row, source;
  };

  static constexpr int usual_size_of_groups = 5000;

  // Problems of at least `least_size_of_groups` unknowns are divided into groups. The number of threads does not matter.
  Symbolic_factor(const Lower_half& a, const Elimination_order& order, int least_size_of_groups = usual_size_of_groups,
                  const Concurrency& concurrency = Concurrency())
  {
    const std::vector<int> parent = elimination_tree::parents(
      elimination_tree::ordered_pattern(a, inverse_permutation(order.unknowns()), false));
    const std::vector<int> post = elimination_tree::postorder(parent);
    const std::vector<int> tree = elimination_tree::renumbered(parent, post);
    unknowns.reserve(post.size());
    for(int j : post)
      unknowns.push_back(order.unknowns()[j]);
    const elimination_tree::Ordered_pattern by_columns = elimination_tree::ordered_pattern(a, inverse_permutation(unknowns), true);
    find_supernodes(tree, elimination_tree::column_counts(by_columns, tree));
    find_forest(tree);
    find_groups(size() < least_size_of_groups ? 1 : 4);
    separate_groups();
    find_stacks();
    find_fronts(by_columns, diagonal_entries(a), concurrency);
  }

  int size() const { return int(unknowns.size()); }

  std::vector<int> unknowns;               // in the order of elimination
  std::vector<Supernode> supernodes;       // in postorder
  std::vector<int> rows;                   // of the fronts below the columns, ascending
  std::vector<int> rows_in_parent;         // the same, as rows of the parent's front
  std::vector<Entry> entries;              // by column
  std::vector<int> first_entry;            // by column, and the end
  std::size_t number_of_values = 0;        // of L, with the zeros
  int largest_front = 0;

  // A supernode with all below it: successive ones, the last of which is the root. Its update is kept for the front of its parent.
  struct Subtree
  {
    int first, end;
    std::size_t update; // where the update is kept
  };

  // The updates that wait for their parents are on two stacks in turn, of even and odd depth: when a front is formed, its children are on top
  // of one, and its own update goes to the other one.
  struct Stack_sizes
  {
    std::size_t of_parity[2] = {0, 0};
  };

  // Subtrees in groups, which can be worked on at the same time, and the supernodes above them, the top. The groups depend on nothing but the matrix.
  std::vector<std::vector<Subtree> > groups;
  std::vector<Stack_sizes> stacks;         // by group, and of the top
  std::vector<int> top;                    // supernodes, ascending
  std::vector<int> top_columns;            // ascending
  std::vector<int> place_in_top;           // by column: its number there, or none
  std::size_t size_of_kept_updates = 0;

  // Numbers between the panels, and the updates that are kept, of one group and those of another: vectors that reach over the end of one must
  // not write to the other.
  static constexpr std::size_t gap = 16;

  bool is_in_top(int s) const { return place_in_top[supernodes[s].first_column] != none; }

private:
  // Columns that follow each other and are merged; `count` entries in the first column, `zeros` of them all that would not be there otherwise.
  struct Columns
  {
    int first, number, count;
    double zeros;
  };

  // Columns with the same rows, the parent having no other child.
  static std::vector<Columns> fundamental_supernodes(const std::vector<int>& parent, const std::vector<int>& count)
  {
    std::vector<int> number_of_children(parent.size(), 0);
    for(int p : parent)
      if(p != none)
        ++number_of_children[p];
    std::vector<Columns> result;
    for(int j = 0; j < int(parent.size()); ++j)
      if(j > 0 && parent[j - 1] == j && count[j - 1] == count[j] + 1 && number_of_children[j] == 1)
        ++result.back().number;
      else
        result.push_back({j, 1, count[j], 0.});
    return result;
  }

  // Is it worth the zeros to have one front instead of two? \pre `upper` is the parent of `lower` and comes right after it
  static bool is_worth_merging(const Columns& lower, const Columns& upper, Columns& both)
  {
    both = {lower.first, lower.number + upper.number, lower.number + upper.count, 0.};
    both.zeros = lower.zeros + upper.zeros + double(lower.number) * (both.count - lower.count);
    const double n = both.number, entries = n * (n + 1) / 2 + n * (both.count - n), share = both.zeros / entries;
    return both.number <= 4 || share < (both.number <= 16 ? 0.8 : both.number <= 48 ? 0.1 : 0.05);
  }

  void find_supernodes(const std::vector<int>& parent, const std::vector<int>& count)
  {
    std::vector<Columns> columns = fundamental_supernodes(parent, count);
    std::vector<int> of_column(parent.size()), merged_into(columns.size());
    for(int s = 0; s < int(columns.size()); ++s)
    {
      merged_into[s] = s;
      std::fill_n(of_column.begin() + columns[s].first, columns[s].number, s);
    }
    for(int s = int(columns.size()) - 2; s >= 0; --s)
    {
      const int p = parent[columns[s + 1].first - 1];
      Columns both;
      if(p == none || elimination_tree::root_of(merged_into, of_column[p]) != s + 1 || !is_worth_merging(columns[s], columns[s + 1], both))
        continue;
      columns[s] = both;
      merged_into[s + 1] = s;
    }
    for(int s = 0; s < int(columns.size()); ++s)
      if(merged_into[s] == s)
      {
        supernodes.emplace_back();
        supernodes.back().first_column = columns[s].first;
        supernodes.back().number_of_columns = columns[s].number;
        supernodes.back().number_of_rows = columns[s].count - columns[s].number;
      }
  }

  // Which supernode hangs on which, and where their rows and panels are.
  void find_forest(const std::vector<int>& parent)
  {
    std::vector<int> supernode_of(unknowns.size());
    for(int s = 0; s < int(supernodes.size()); ++s)
      std::fill_n(supernode_of.begin() + supernodes[s].first_column, supernodes[s].number_of_columns, s);
    std::size_t number_of_rows = 0;
    for(int s = 0; s < int(supernodes.size()); ++s)
    {
      Supernode& node = supernodes[s];
      node.first_row = number_of_rows;
      number_of_rows += std::size_t(node.number_of_rows);
      node.panel = number_of_values;
      number_of_values += node.panel_size();
      largest_front = (std::max)(largest_front, node.front_size());
      if(node.number_of_rows == 0)
        continue;
      node.parent = supernode_of[parent[node.end_column() - 1]];
      node.next_sibling = std::exchange(supernodes[node.parent].first_child, s);
    }
    rows.resize(number_of_rows);
    rows_in_parent.resize(number_of_rows);
    for(int s = int(supernodes.size()) - 1; s >= 0; --s)
      if(supernodes[s].parent != none)
        supernodes[s].depth = supernodes[supernodes[s].parent].depth + 1;
  }

  // The rows of every front, and where the entries of the matrix and the rows of its children are in it.
  void find_fronts(const elimination_tree::Ordered_pattern& by_columns, const std::vector<int>& diagonal, const Concurrency& concurrency)
  {
    first_entry.assign(1, 0);
    first_entry.reserve(unknowns.size() + 1);
    for(int j = 0; j < size(); ++j)
      first_entry.push_back(first_entry[j] + by_columns.first[j + 1] - by_columns.first[j] + (diagonal[unknowns[j]] != none ? 1 : 0));
    entries.resize(std::size_t(first_entry.back()));
    concurrency.for_each(int(groups.size()), [&](int g)
    {
      Marks marks(unknowns.size());
      for(const Subtree& subtree : groups[g])
        for(int s = subtree.first; s < subtree.end; ++s)
          find_front(s, by_columns, diagonal, marks);
    });
    Marks marks(top.empty() ? 0 : unknowns.size());
    for(const int s : top)
      find_front(s, by_columns, diagonal, marks);
  }

  // By row: where it is in the front, and the last front that has it.
  struct Marks
  {
    explicit Marks(std::size_t n) : place(n), seen_by(n, none) {}
    std::vector<int> place, seen_by;
  };

  void find_front(int s, const elimination_tree::Ordered_pattern& by_columns, const std::vector<int>& diagonal, Marks& marks)
  {
    find_rows(s, by_columns, marks.seen_by);
    const Supernode& node = supernodes[s];
    for(int i = 0; i < node.number_of_columns; ++i)
      marks.place[node.first_column + i] = i;
    for(int i = 0; i < node.number_of_rows; ++i)
      marks.place[rows[node.first_row + i]] = node.number_of_columns + i;
    for(int child = node.first_child; child != none; child = supernodes[child].next_sibling)
      for(std::size_t k = supernodes[child].first_row; k < supernodes[child].first_row + supernodes[child].number_of_rows; ++k)
        rows_in_parent[k] = marks.place[rows[k]];
    for(int j = node.first_column; j < node.end_column(); ++j)
    {
      Entry* entry = entries.data() + first_entry[j];
      if(diagonal[unknowns[j]] != none)
        *entry++ = {marks.place[j], diagonal[unknowns[j]]};
      for(int k = by_columns.first[j]; k < by_columns.first[j + 1]; ++k)
        *entry++ = {marks.place[by_columns.index[k]], by_columns.source[k]};
    }
  }

  // The rows below the columns of a supernode: those of the matrix and those of the children. As many as were counted.
  void find_rows(int s, const elimination_tree::Ordered_pattern& by_columns, std::vector<int>& seen_by)
  {
    const Supernode& node = supernodes[s];
    int* const first = rows.data() + node.first_row;
    int* end = first;
    const auto add = [&](int row)
    {
      if(row >= node.end_column() && seen_by[row] != s)
      {
        seen_by[row] = s;
        *end++ = row;
      }
    };
    for(int k = by_columns.first[node.first_column]; k < by_columns.first[node.end_column()]; ++k)
      add(by_columns.index[k]);
    for(int child = node.first_child; child != none; child = supernodes[child].next_sibling)
      for(std::size_t i = supernodes[child].first_row; i < supernodes[child].first_row + supernodes[child].number_of_rows; ++i)
        add(rows[i]);
    CGAL_assertion(end == first + node.number_of_rows);
    std::sort(first, end);
  }

  static std::vector<int> diagonal_entries(const Lower_half& a)
  {
    std::vector<int> result(std::size_t(a.size()), none);
    for(int j = 0; j < a.size(); ++j)
      for(int k = a.first[j]; k < a.first[j + 1]; ++k)
        if(a.row[k] == j)
          result[j] = k;
    return result;
  }

  // About the operations that a front takes, with what it takes to make it.
  static double work(const Supernode& node)
  {
    double result = 2000;
    for(int k = 0; k < node.number_of_columns; ++k)
      result += double(node.front_size() - k) * double(node.front_size() - k);
    return result;
  }

  // Subtrees that are more than a sixteenth of all the work are taken apart: their roots are in the top. What hangs on it is dealt out, the
  // largest first, always to the group that has least. Small problems, for which it is not worth while, are one group.
  void find_groups(std::size_t number_of_groups)
  {
    const int n = int(supernodes.size());
    std::vector<double> work_below(supernodes.size(), 0.);
    std::vector<int> first(supernodes.size()); // of its subtree
    std::iota(first.begin(), first.end(), 0);
    double all = 0;
    for(int s = 0; s < n; ++s)
    {
      const double own = work(supernodes[s]);
      const int parent = supernodes[s].parent;
      all += own;
      work_below[s] += own;
      if(parent == none)
        continue;
      work_below[parent] += work_below[s];
      first[parent] = (std::min)(first[parent], first[s]);
    }
    place_in_top.assign(unknowns.size(), none);
    std::vector<int> roots;
    for(int s = n - 1; s >= 0; --s)
    {
      const bool hangs_on_top = supernodes[s].parent == none || is_in_top(supernodes[s].parent);
      if(hangs_on_top && number_of_groups > 1 && work_below[s] > all / double(4 * number_of_groups))
      {
        top.push_back(s);
        std::fill_n(place_in_top.begin() + supernodes[s].first_column, supernodes[s].number_of_columns, 0);
      }
      else if(hangs_on_top)
        roots.push_back(s);
    }
    std::reverse(top.begin(), top.end());
    for(const int s : top)
      for(int j = supernodes[s].first_column; j < supernodes[s].end_column(); ++j)
      {
        place_in_top[j] = int(top_columns.size());
        top_columns.push_back(j);
      }
    deal_out(roots, first, work_below, number_of_groups);
  }

  void deal_out(std::vector<int> roots, const std::vector<int>& first, const std::vector<double>& work_below, std::size_t number_of_groups)
  {
    std::sort(roots.begin(), roots.end(), [&](int s, int t) { return work_below[s] > work_below[t] || (work_below[s] == work_below[t] && s < t); });
    groups.resize(number_of_groups);
    std::vector<double> load(number_of_groups, 0.);
    for(const int s : roots)
    {
      const std::size_t least = std::size_t(std::min_element(load.begin(), load.end()) - load.begin());
      groups[least].push_back({first[s], s + 1, 0});
      load[least] += work_below[s];
    }
    for(std::vector<Subtree>& group : groups)
    {
      std::sort(group.begin(), group.end(), [](const Subtree& s, const Subtree& t) { return s.first < t.first; });
      for(Subtree& subtree : group)
      {
        subtree.update = size_of_kept_updates;
        size_of_kept_updates += supernodes[subtree.end - 1].update_size() + gap;
      }
    }
  }

  // Moves panels apart, behind the roots of subtrees and the supernodes of the top.
  void separate_groups()
  {
    std::vector<char> is_last(supernodes.size(), 0);
    for(const std::vector<Subtree>& group : groups)
      for(const Subtree& subtree : group)
        is_last[subtree.end - 1] = 1;
    for(const int s : top)
      is_last[s] = 1;
    std::size_t shift = 0;
    for(std::size_t s = 0; s < supernodes.size(); ++s)
    {
      supernodes[s].panel += shift;
      if(is_last[s])
        shift += gap;
    }
    number_of_values += shift;
  }

  void find_stacks()
  {
    stacks.resize(groups.size() + 1);
    for(std::size_t g = 0; g < groups.size(); ++g)
      for(const Subtree& subtree : groups[g])
      {
        Stack_sizes height;
        for(int s = subtree.first; s < subtree.end - 1; ++s)
          put_on_stack(s, true, height, stacks[g]);
      }
    Stack_sizes height;
    for(const int s : top)
      put_on_stack(s, false, height, stacks.back());
  }

  // The stacks grow by the update of s, and lose those of its children, as far as they are there.
  void put_on_stack(int s, bool has_all_children, Stack_sizes& height, Stack_sizes& largest) const
  {
    const int parity = supernodes[s].depth % 2;
    height.of_parity[parity] += supernodes[s].update_size();
    largest.of_parity[parity] = (std::max)(largest.of_parity[parity], height.of_parity[parity]);
    for(int child = supernodes[s].first_child; child != none; child = supernodes[child].next_sibling)
      if(has_all_children || is_in_top(child))
        height.of_parity[1 - parity] -= supernodes[child].update_size();
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_SYMBOLIC_FACTOR_H
