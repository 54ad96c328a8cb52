// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The lengths that edges have had, by flips, each with a bound of its error.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_LENGTH_HISTORY_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_LENGTH_HISTORY_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Precise_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/number_conversions.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/delaunay_predicate.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/flipped_length.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <unordered_map>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Every length that an edge has had is a node: first those given, node `e` for edge `e`, then one for each flip, which
// knows the five lengths it was computed from. So a flip that undoes an earlier one gives back what was there, and lengths
// can be computed again from those given, as precisely as it takes.
template <typename NT>
class Length_history
{
public:
  typedef std::uint32_t Index;
  typedef std::conditional_t<std::is_same<NT, double>::value, Double_double, NT> Wide;

  explicit Length_history(const std::vector<NT>& lengths)
    : given_(lengths), node_(lengths.size())
  {
    for(std::size_t e = 0; e < node_.size(); ++e)
      node_[e] = Index(e);
  }

  // bound of the relative error of the length of the edge `e`
  double error(Index e) const { return is_given(node_[e]) ? 0. : flip(node_[e]).error; }

  // flips `edges[0]`, in the order of `quad_edges()`, and writes its new length
  // \return `false`, and nothing has happened, if the length is 0 or out of range
  bool flip(const std::array<Index, 5>& edges, Flip_rule rule, NT& length)
  {
    return restore(edges, rule, length) || compute(edges, rule, length);
  }

  std::size_t number_of_restored_lengths() const { return restored_; }
  std::size_t number_of_renewed_lengths() const { return renewed_; }

private:
  struct Flip
  {
    NT length;
    double error;
    Bounded_length<Wide> wide; // `length` is this one, rounded
    std::array<Index, 5> from; // nodes in the order of `quad_edges()`
    Flip_rule rule;
  };

  bool is_given(Index n) const { return n < given_.size(); }
  Flip& flip(Index n) { return flips_[n - given_.size()]; }
  const Flip& flip(Index n) const { return flips_[n - given_.size()]; }

  Bounded_length<Wide> wide_length(Index n) const
  {
    return is_given(n) ? Bounded_length<Wide>{Wide(given_[n]), 0.} : flip(n).wide;
  }

  // whether the flip undoes the one by which the edge came
  bool restore(const std::array<Index, 5>& edges, Flip_rule rule, NT& length)
  {
    const Index n = node_[edges[0]];
    if(is_given(n) || flip(n).rule != rule || !has_same_sides(flip(n).from, edges))
      return false;
    const Index before = flip(n).from[0];
    length = is_given(before) ? given_[before] : flip(before).length;
    node_[edges[0]] = before;
    ++restored_;
    return true;
  }

  bool compute(const std::array<Index, 5>& edges, Flip_rule rule, NT& length)
  {
    std::array<Index, 5> from;
    std::array<Bounded_length<Wide>, 5> x;
    for(std::size_t n = 0; n < 5; ++n)
    {
      from[n] = node_[edges[n]];
      x[n] = wide_length(from[n]);
    }
    Bounded_length<Wide> f = flipped_length(x, rule);
    if(!(f.error < error_of_worn_length()))
      renew(from, rule, f);
    length = static_cast<NT>(f.value);
    if(!is_usable(length))
      return false;
    const double rounding = std::is_same<NT, Wide>::value ? 0. : epsilon<NT>();
    node_[edges[0]] = Index(given_.size() + flips_.size());
    flips_.push_back({length, f.error + rounding, f, from, rule});
    return true;
  }

  template <typename Real>
  static double epsilon() { return static_cast<double>((std::numeric_limits<Real>::epsilon)()); }

  // from then on the error of the stored length would be more than its rounding
  static double error_of_worn_length()
  {
    return (std::max)(std::is_same<NT, Wide>::value ? 1000 * epsilon<NT>() : epsilon<NT>() / 100, 1e-250);
  }

  // computes the length again, from those given, with 300 digits
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  void renew(const std::array<Index, 5>& from, Flip_rule rule, Bounded_length<Wide>& f)
  {
    if(precise_.size() > 300000) // to limit the memory
      precise_.clear();
    std::array<Bounded_length<Precise_number>, 5> x;
    for(std::size_t n = 0; n < 5; ++n)
    {
      if(!evaluate(from[n]))
        return;
      x[n] = precise_.find(from[n])->second;
    }
    const Bounded_length<Precise_number> precise = flipped_length(x, rule);
    const double error = 1.01 * precise.error + (std::max)(epsilon<Wide>(), 1e-300);
    if(!(error < f.error))
      return;
    f.value = From_precise<Wide>()(precise.value);
    f.error = error;
    ++renewed_;
  }

  // so that the bounds of rounding hold
  static bool is_usable(const NT& length)
  {
    return is_positive_number(length)
           && (!has_range_of_double<NT>() || (length > NT(1e-280) && length < NT(1e280)));
  }

  // opposite sides remain opposite
  bool has_same_sides(const std::array<Index, 5>& from, const std::array<Index, 5>& edges) const
  {
    const auto same = [&](std::size_t p, std::size_t q, Index x, Index y)
    {
      return (from[p] == x && from[q] == y) || (from[p] == y && from[q] == x);
    };
    const Index a = node_[edges[1]], b = node_[edges[2]], c = node_[edges[3]], d = node_[edges[4]];
    return (same(1, 3, a, c) && same(2, 4, b, d)) || (same(1, 3, b, d) && same(2, 4, a, c));
  }

  // writes the precise length of the node `last`, and of all that it comes from
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  bool evaluate(Index last)
  {
    std::vector<Index> stack(1, last);
    for(std::size_t step = 0; !stack.empty(); ++step)
    {
      const Index n = stack.back();
      if(step > 1000000)
        return false;
      if(precise_.count(n) == 0 && is_given(n))
        precise_.emplace(n, Bounded_length<Precise_number>{To_precise()(given_[n]), error_of_conversion()});
      else if(precise_.count(n) == 0)
      {
        const Flip& f = flip(n);
        if(push_unknown(f.from, stack))
          continue;
        const auto x = [&](std::size_t m) { return precise_.find(f.from[m])->second; };
        precise_.emplace(n, flipped_length<Precise_number>({{x(0), x(1), x(2), x(3), x(4)}}, f.rule));
      }
      stack.pop_back();
    }
    return true;
  }

  bool push_unknown(const std::array<Index, 5>& nodes, std::vector<Index>& stack) const
  {
    const std::size_t size = stack.size();
    for(const Index m : nodes)
      if(precise_.count(m) == 0)
        stack.push_back(m);
    return stack.size() > size;
  }

  static double error_of_conversion()
  {
    return std::is_same<NT, double>::value || std::is_same<NT, Double_double>::value ? 0. : 1e-300;
  }

  std::vector<NT> given_;
  std::vector<Index> node_; // by edge
  std::vector<Flip> flips_;
  std::unordered_map<Index, Bounded_length<Precise_number> > precise_; // by node, as needed
  std::size_t restored_ = 0, renewed_ = 0;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_LENGTH_HISTORY_H
