// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Repaired_metric.h
/// A metric on a triangulation that was changed where triangles broke, and how it was changed (section 3.2 of Springborn, Schroeder and
/// Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_REPAIRED_METRIC_H
#define CGAL_CONFORMAL_EQUIVALENCE_REPAIRED_METRIC_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceSolver
///
/// One change of a triangulation that leaves the surface as it is: an edge was flipped, or split by a new vertex. Numbers are
/// those at the time of the change, see `Intrinsic_triangulation::flip_edge()` and `Intrinsic_triangulation::split_edge()`.
template <typename NT_ = double>
struct Edge_change
{
  typedef NT_ NT;               ///< number type of the lengths
  typedef std::uint32_t Index;  ///< of vertices and edges

  /// the kinds of changes
  enum Kind
  {
    FLIP, ///< the edge became the other diagonal of its two triangles
    SPLIT ///< the edge was cut in two by a new vertex, which was joined with the vertices opposite to the edge
  };

  Kind kind;                      ///< what was done
  Index edge;                     ///< to which edge
  std::array<Index, 2> vertices;  ///< the ends of the edge before: origin and target of its `edge_halfedge()`
  Index new_vertex;               ///< of a split; `null_index` for a flip
  NT parameter;                   ///< where on the edge the new vertex is: 0 at the origin, 1 at the target; 0 for a flip
};

/// \ingroup PkgConformalEquivalenceSolver
///
/// What `repair_locally()` returns.
template <typename NT_ = double>
struct Repaired_metric
{
  typedef NT_ NT;               ///< number type of lengths and of u
  typedef std::uint32_t Index;  ///< of vertices, edges and faces

  /// the metric, or why there is none, as `Conformal_metric_solver::solve()` tells for the triangulation as it was changed
  Conformal_metric<NT> metric;
  Conformal_conditions<NT> conditions;      ///< those given, and those of the new vertices, which have the last numbers
  std::vector<Edge_change<NT> > changes;    ///< in order
  std::vector<Index> input_edges;           ///< by edge: the edge given that it is, or is a part of; `null_index` if none

  /// the triangulation as it was changed, with the lengths on the surface given.
  const Intrinsic_triangulation<NT>& triangulation() const { return metric.triangulation; }

  /// the number of changes that are flips.
  std::size_t number_of_flips() const
  {
    return std::size_t(std::count_if(changes.begin(), changes.end(), [](const Edge_change<NT>& c) { return c.kind == c.FLIP; }));
  }
  /// the number of changes that are splits.
  std::size_t number_of_splits() const { return changes.size() - number_of_flips(); }

  /// is `true` iff the metric is usable.
  explicit operator bool() const { return bool(metric); }
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_REPAIRED_METRIC_H
