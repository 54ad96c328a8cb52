// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Conformal_metric.h
/// A metric within its conformal class: a triangulation with lengths and a scale
/// factor at every vertex (Definition 2.2 of Springborn, Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_METRIC_H
#define CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_METRIC_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceSolver
///
/// What the solver returns: the metric l~_ij = e^{(u_i + u_j) / 2} l_ij (equation (2)), or
/// the reason why there is none, and the elements at fault.
template <typename NT_ = double>
struct Conformal_metric : public Outcome
{
  typedef NT_ NT;               ///< number type of lengths and of u
  typedef std::uint32_t Index;  ///< of vertices, edges and faces

  /// at least as wide as `NT`: for `double` a pair of two
  typedef typename internal::Wider_number<NT>::type Wide_number;

  /// with the lengths l, at u = 0: the triangulation given, or what has become of it by flips
  Intrinsic_triangulation<NT> triangulation;
  /// whether `triangulation` is one of the double: of the surface and its mirror image, glued along the border. Elements of the
  /// surface have the same numbers there.
  bool is_doubled = false;
  /// the edges that were flipped, in order: the record of how `triangulation` came from the one given, or its double
  std::vector<Index> flips;
  /// the border edges of the surface given that are no edges of the double any more, in ascending order: the border runs there as
  /// straight as anywhere, but the distance of their ends along it is not e^{(u_i + u_j) / 2} l. Empty unless `is_doubled`.
  std::vector<Index> lost_border_edges;
  std::vector<NT> log_scale_factors;          ///< u, by vertex of the surface given, rounded to `NT`

  /// the vertices at which u is equal to its lower bound, in ascending order; see `Conformal_conditions`
  std::vector<Index> active_bounds;

  /// e^{u/2}, by vertex of `triangulation`, to all the digits that the solver knows: the scaled lengths
  /// made with these are exactly conformally equivalent to the given ones.
  std::vector<Wide_number> scale_factors;

  Statistics statistics;                      ///< figures of the run

  /// is `true` iff `triangulation` is not the one given.
  bool is_retriangulated() const { return is_doubled || !flips.empty(); }

  /// the scaled length of the edge of halfedge `h`, rounded to `NT`.
  NT scaled_length(Index h) const { return static_cast<NT>(wide_scaled_length(h)); }

  /// the same as wide as it is known.
  Wide_number wide_scaled_length(Index h) const { return internal::wide_length(triangulation, scale_factors, h); }
};

namespace internal {

// The angle sum at `v` in the metric found.
template <typename NT>
double angle_sum_at(const Conformal_metric<NT>& metric, std::uint32_t v)
{
  double result = 0;
  metric.triangulation.for_each_outgoing(v, [&](std::uint32_t h)
  {
    const auto triangle = wide_triangle(metric.triangulation, metric.scale_factors, h / 3);
    result += 2 * std::atan2(static_cast<double>(triangle.r), static_cast<double>(triangle.tangent[(h + 1) % 3]));
  });
  return result;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template double angle_sum_at(const Conformal_metric<double>&, std::uint32_t);
#endif

template <typename To, typename From> To convert_number(const From& x) { return To(x); }
template <typename To> To convert_number(const Double_double& x) { return To(x.hi) + To(x.lo); }

} // namespace internal

/// \ingroup PkgConformalEquivalenceLayout
///
/// returns the same metric held in numbers of another, wider type, nothing being rounded: where scale factors range too far for the
/// points of a layout to differ in `double`, `compute_common_refinement()` of the converted metric and `input.with_lengths()` lays it out with more
/// digits.
///
/// \tparam Other_NT a number type wider than `Conformal_metric::Wide_number`, such as a Boost.Multiprecision number; not `double`
template <typename Other_NT, typename NT>
Conformal_metric<Other_NT> convert_metric(const Conformal_metric<NT>& metric)
{
  const Intrinsic_triangulation<NT>& t = metric.triangulation;
  Conformal_metric<Other_NT> result;
  std::vector<Other_NT> lengths;
  for(const NT& l : t.lengths())
    lengths.push_back(Other_NT(l));
  result.triangulation = t.with_lengths(std::move(lengths));
  result.is_doubled = metric.is_doubled;
  result.flips = metric.flips;
  for(const NT& u : metric.log_scale_factors)
    result.log_scale_factors.push_back(Other_NT(u));
  for(const auto& s : metric.scale_factors)
    result.scale_factors.push_back(internal::convert_number<Other_NT>(s));
  result.lost_border_edges = metric.lost_border_edges;
  result.active_bounds = metric.active_bounds;
  result.set_outcome(metric);
  result.statistics = metric.statistics;
  return result;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_METRIC_H
