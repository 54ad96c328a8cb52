// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Delaunay triangulations by flips of edges, for lengths that are scaled by factors s_i = e^{u_i/2} at the vertices
// (Springborn, "Ideal hyperbolic polyhedra and discrete uniformization", 2020; Gu, Luo, Sun and Wu, "A discrete
// uniformization theorem for polyhedral surfaces", 2018; Springborn, Schroeder and Pinkall, 2008, Section 3.2).
//
//              k              The edge ij is Delaunay iff cos(angle at k) + cos(angle at l) >= 0. Written with the scaled
//           b / \ a           lengths, and multiplied out, that is
//            /   \                                                                                       .
//           i--e--j             (a c + b d) (a d + b c)  >=  e^2 (a b + c d),
//            \   /
//           c \ / d           with equality iff the four vertices lie on a circle (Ptolemy's second theorem). All of it
//              l              is positive, so rounding costs a few units in the last place, and no triangle inequality
//                             is needed: for lengths that are merely positive it says "ideal Delaunay" (Penner).
//
// Two ways to find the length f of the other diagonal, kl:
//   Ptolemy     f = (a c + b d) / e: defined for all positive lengths; stays in the discrete conformal class, and is the
//               Euclidean one where the quadrilateral is inscribed in a circle;
//   Euclidean   the distance in the plane, where the two triangles are laid side by side: stays on the same flat surface.
//
// Stopping. Lengths after a flip are rounded, so exact decisions on the stored numbers may go around in circles among
// cocircular vertices. Hence each length has a bound of its relative error, as compared with the exact length that the
// recorded flips make of the lengths at the beginning, and an edge is flipped only if it is not Delaunay whatever the errors
// are. Such a flip is one of the exact flip algorithm, which ends: no edge can come back at the same factors. Ties are left
// alone. New lengths are computed with more digits than they are stored with; where many flips have used these up, again
// from the beginning, with 300 digits.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_DELAUNAY_FLIPPER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_DELAUNAY_FLIPPER_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Exact_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/number_conversions.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Length_history.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/delaunay_predicate.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/flipped_length.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/length_predicates.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

struct Delaunay_flip_counts
{
  std::size_t flips = 0;             // those undone included
  std::size_t restored = 0;          // of these, flips that undid an earlier one: the earlier length is back, bit by bit
  std::size_t filter_failures = 0;   // decisions for which `double` did not do
  std::size_t exact_decisions = 0;   // of these, decisions by exact numbers, on the stored numbers
  std::size_t ties = 0;              // edges left as they are, as they are Delaunay within their bounds
  std::size_t renewed = 0;           // lengths computed again from those given, after many flips
};

struct Delaunay_verdict
{
  bool is_exact = true;             // all signs are at least 0, exactly, on the stored numbers
  bool is_within_bounds = true;     // or would be for lengths within the bounds of their errors
  std::vector<std::uint32_t> edges; // of which neither is true
};

/// The numbers of all edges of `t`.
template <typename NT>
std::vector<std::uint32_t> all_edges(const Intrinsic_triangulation<NT>& t)
{
  std::vector<std::uint32_t> result(t.number_of_edges());
  std::iota(result.begin(), result.end(), std::uint32_t(0));
  return result;
}

/// Makes a triangulation Delaunay by flips, again and again as the scale factors change. As long as it is used no one else
/// changes the triangulation. The lengths at the construction are taken for exact.
template <typename NT>
class Delaunay_flipper
{
public:
  typedef std::uint32_t Index;
  typedef internal::Flip_rule Flip_rule;

  explicit Delaunay_flipper(Intrinsic_triangulation<NT>& t) : Delaunay_flipper(t, 10000 + 100 * std::size_t(t.number_of_edges())) {}

  /// \param flip_budget how many flips one call may make, at most
  Delaunay_flipper(Intrinsic_triangulation<NT>& t, std::size_t flip_budget)
    : t_(t), history_(t.lengths()), is_candidate_(t.number_of_edges(), 0), flip_budget_(flip_budget)
  {}

  /// flips edges until none of `candidates`, and of the edges around the flipped ones, is flippable and not Delaunay beyond
  /// the errors of the lengths.
  /// \param s factors `e^{u/2}` by vertex; none: all are 1
  /// \param rule of the new lengths. Euclidean ones are those of the triangles without factors: \pre all factors are 1
  /// \param on_flip `on_flip(e)` is called right before the edge `e` is flipped
  /// \param visitor is told how far it is, and may stop it, where it takes long
  /// \return `false` if the flip budget was exhausted, or the visitor stopped it: then `unfinished_edges()` are those to be flipped next
  template <typename Scale, typename OnFlip>
  bool flip_to_delaunay(const std::vector<Scale>& s, std::vector<Index> candidates, Flip_rule rule, OnFlip on_flip,
                        const Any_visitor& visitor = Any_visitor())
  {
    CGAL_precondition(s.empty() || s.size() == t_.number_of_vertices());
    candidates_.clear();
    unfinished_.clear();
    const Stopwatch stopwatch;
    double next_question = is_stopped_ ? 0 : seconds_between_questions_;
    is_stopped_ = false;
    std::size_t looks = 0;
    for(std::size_t n = candidates.size(); n > 0; --n) // the first comes first
      add_candidate(candidates[n - 1]);
    for(std::size_t flips = 0; !candidates_.empty(); )
    {
      const Index e = candidates_.back();
      candidates_.pop_back();
      is_candidate_[e] = 0;
      if(looks++ % looks_between_questions_ == 0 && stopwatch.seconds() >= next_question && !is_stopped_)
      {
        visitor.on_progress(Stage::FLIP, flips, double(candidates_.size() + 1));
        is_stopped_ = !visitor.go_further();
        next_question = stopwatch.seconds() + seconds_between_questions_;
      }
      if(is_stopped_)
      {
        unfinished_.push_back(e);
        continue;
      }
      if(!is_to_be_flipped(e, s))
        continue;
      if(flips == flip_budget_)
        unfinished_.push_back(e); // and whatever else there is
      else if(flip(e, rule, on_flip))
        ++flips;
    }
    return unfinished_.empty();
  }

  template <typename Scale>
  bool flip_to_delaunay(const std::vector<Scale>& s, std::vector<Index> candidates, Flip_rule rule)
  {
    return flip_to_delaunay(s, std::move(candidates), rule, [](Index) {});
  }

  /// flips until all edges are Delaunay.
  template <typename Scale>
  bool flip_to_delaunay(const std::vector<Scale>& s, Flip_rule rule)
  {
    return flip_to_delaunay(s, all_edges(t_), rule);
  }

  const std::vector<Index>& unfinished_edges() const { return unfinished_; }
  bool is_stopped() const { return is_stopped_; } // by the visitor, in the last call
  const Delaunay_flip_counts& counts() const { return counts_; }

  /// the bound of the relative error of the length of `e`: 0 if it is the one given
  double length_error(Index e) const { return history_.error(e); }

  /// states whether the triangulation is Delaunay, exactly or within the bounds of errors. Linear time.
  template <typename Scale>
  Delaunay_verdict verdict(const std::vector<Scale>& s)
  {
    const Delaunay_flip_counts before = counts_; // it is not a part of the work
    Delaunay_verdict result;
    for(Index e = 0; e < t_.number_of_edges(); ++e)
    {
      if(!t_.is_flippable(e) || is_certainly_delaunay(quad<double>(t_, e, s, To_double())))
        continue;
      const State exact = state(e, s, 0.);
      if(exact == State::DELAUNAY)
        continue;
      result.is_exact = false;
      if(is_to_be_flipped(e, s))
      {
        result.is_within_bounds = false;
        result.edges.push_back(e);
      }
    }
    counts_ = before;
    return result;
  }

private:
  // A look takes a microsecond as a rule, and a hundredth of a second if it takes hundreds of digits: so a visitor is asked every second at least.
  static constexpr std::size_t looks_between_questions_ = 64;
  static constexpr double seconds_between_questions_ = 0.25;

  enum class State { DELAUNAY, WITHIN_BOUND, NOT_DELAUNAY };

  void add_candidate(Index e)
  {
    if(is_candidate_[e])
      return;
    is_candidate_[e] = 1;
    candidates_.push_back(e);
  }

  template <typename Scale>
  bool is_to_be_flipped(Index e, const std::vector<Scale>& s)
  {
    if(!t_.is_flippable(e) || is_certainly_delaunay(quad<double>(t_, e, s, To_double())))
      return false;
    const State result = state(e, s, relative_bound(e));
    if(result == State::WITHIN_BOUND)
      ++counts_.ties;
    return result == State::NOT_DELAUNAY;
  }

  double relative_bound(Index e) const
  {
    const std::array<Index, 5> x = quad_edges(t_, e);
    return error_of_difference({{history_.error(x[0]), history_.error(x[1]), history_.error(x[2]),
                                 history_.error(x[3]), history_.error(x[4])}});
  }

  template <typename Scale>
  State state(Index e, const std::vector<Scale>& s, double bound)
  {
    Relative_difference d;
    State result = State::WITHIN_BOUND;
    if(filtered_difference(quad<double>(t_, e, s, To_double()), d) && is_decided(d, bound, result))
      return result;
    return state_by_more_digits(e, s, bound);
  }

  template <typename Scale>
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  State state_by_more_digits(Index e, const std::vector<Scale>& s, double bound)
  {
    Relative_difference d;
    State result = State::WITHIN_BOUND;
    ++counts_.filter_failures;
    const bool has_all_digits = filtered_difference(quad<Double_double>(t_, e, s, To_double_double()), d);
    if(has_all_digits && is_decided(d, bound, result))
      return result;
    if(!has_positive_numbers(t_, e, s))
      return State::NOT_DELAUNAY;
    if(!has_all_digits && filtered_difference(converted_quad<Scaled_number<Double_double> >(t_, e, s, To_scaled(), To_scaled()), d)
       && is_decided(d, bound, result))
      return result;
    ++counts_.exact_decisions;
    is_decided(exact_difference(quad<Exact_number>(t_, e, s, To_exact())), bound, result);
    return result;
  }

  static bool is_decided(const Relative_difference& d, double bound, State& result)
  {
    if(d.value - d.error >= 0)
      result = State::DELAUNAY;
    else if(d.value + d.error < -bound)
      result = State::NOT_DELAUNAY;
    else if(d.value - d.error >= -bound)
      result = State::WITHIN_BOUND;
    else
      return false;
    return true;
  }

  template <typename OnFlip>
  bool flip(Index e, Flip_rule rule, OnFlip& on_flip)
  {
    const std::array<Index, 5> x = quad_edges(t_, e);
    NT length;
    if(!history_.flip(x, rule, length)) // 0 or out of range: the edge stays
      return false;
    on_flip(e);
    t_.flip_edge(e, length);
    ++counts_.flips;
    counts_.restored = history_.number_of_restored_lengths();
    counts_.renewed = history_.number_of_renewed_lengths();
    for(std::size_t n = 1; n < 5; ++n)
      add_candidate(x[n]);
    return true;
  }

  Intrinsic_triangulation<NT>& t_;
  Length_history<NT> history_;
  std::vector<Index> candidates_;  // the last one is looked at next
  std::vector<char> is_candidate_; // by edge
  std::vector<Index> unfinished_;
  std::size_t flip_budget_;
  bool is_stopped_ = false;
  Delaunay_flip_counts counts_;
};

/// makes `t` the intrinsic Delaunay triangulation of its metric, by Euclidean flips. Triangles may be degenerate, or violate their inequality by
/// the rounding of their lengths: then they count as degenerate.
/// \param broken_faces receives the faces that violate it by more
/// \param on_flip `on_flip(e)` is called right before the edge `e` is flipped
/// \param visitor is told how far it is, and may stop it, where it takes long
/// \return `false` if there are any of these, which nothing is done about, or if the visitor stopped it
template <typename NT, typename OnFlip>
bool make_intrinsic_delaunay(Intrinsic_triangulation<NT>& t, std::vector<std::uint32_t>& broken_faces, OnFlip on_flip,
                             const Any_visitor& visitor = Any_visitor())
{
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); h += 3)
    if(!is_triangle_up_to_rounding(t.halfedge_length(h), t.halfedge_length(h + 1), t.halfedge_length(h + 2)))
      broken_faces.push_back(h / 3);
  if(!broken_faces.empty())
    return false;
  Delaunay_flipper<NT> flipper(t);
  flipper.flip_to_delaunay(std::vector<double>(), all_edges(t), Flip_rule::EUCLIDEAN, on_flip, visitor);
  return !flipper.is_stopped();
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_DELAUNAY_FLIPPER_H
