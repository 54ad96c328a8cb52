// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Hyperbolic_metric.h
/// A hyperbolic metric within the conformal class of a surface: a triangulation with hyperbolic lengths and a scale factor at every vertex
/// (section 6 of Bobenko, Pinkall and Springborn, "Discrete conformal maps and ideal hyperbolic polyhedra", 2015).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_HYPERBOLIC_METRIC_H
#define CGAL_CONFORMAL_EQUIVALENCE_HYPERBOLIC_METRIC_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceHyperbolic
///
/// A metric of curvature -1, with cones where they were asked for, that is discretely conformally equivalent to a surface with Euclidean lengths
/// l: its lengths l~ are given by sinh(l~_ij / 2) = e^{(u_i + u_j) / 2} l_ij / 2, on the triangulation that is Delaunay for them; so where u is 0 and
/// triangles are much smaller than 1 it is about the metric given. If the status says that there is none, the elements at fault are named.
///
/// \tparam NT_ number type of lengths and of u
template <typename NT_ = double>
struct Hyperbolic_metric : public Outcome
{
  typedef NT_ NT;               ///< number type of lengths and of u
  typedef std::uint32_t Index;  ///< of vertices, edges and faces

  /// at least as wide as `NT`: for `double` a pair of two
  typedef typename internal::Wider_number<NT>::type Wide_number;

  /// the triangulation of the metric. What it holds for lengths are the numbers sinh(l/2) at u = 0.
  Intrinsic_triangulation<NT> triangulation;
  std::vector<Index> flips;                   ///< the edges that were flipped, in order: how `triangulation` came from the one given
  std::vector<NT> log_scale_factors;          ///< u, by vertex, rounded to `NT`
  std::vector<Wide_number> scale_factors;     ///< e^{u/2}, by vertex, to all the digits that the solver knows
  double area = 0;                            ///< the sum of the areas of all triangles
  Statistics statistics;                      ///< figures of the run

  /// sinh(l~/2) for the length l~ of the edge of the halfedge `h`.
  Wide_number wide_half_sinh(Index h) const { return internal::wide_length(triangulation, scale_factors, h); }

  /// the length l~ of the edge of the halfedge `h`, rounded to `double`.
  double length(Index h) const { return 2 * std::asinh(static_cast<double>(wide_half_sinh(h))); }
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_HYPERBOLIC_METRIC_H
