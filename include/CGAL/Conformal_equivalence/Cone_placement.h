// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Cone_placement.h
/// Cones that were placed, with the metric that has them (section 5.1 of Springborn, Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_CONE_PLACEMENT_H
#define CGAL_CONFORMAL_EQUIVALENCE_CONE_PLACEMENT_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Outcome.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceSolver
///
/// The cones that were placed, and the metric with them. Its `status` tells whether the cones could be placed, or why not; with `BOUND_NOT_MET`, and
/// `STOPPED_BY_VISITOR` where `metric` is a success, the rest is the best that was found.
template <typename NT_ = double>
struct Cone_placement : public Outcome
{
  typedef NT_ NT;              ///< number type of the lengths
  typedef std::uint32_t Index; ///< of vertices

  std::vector<Index> cones;                ///< in ascending order
  std::vector<Exact_angle<NT> > angles;    ///< by cone: the angle sum, exactly if it was rounded to a multiple
  std::vector<double> free_angles;         ///< by cone: what it was before it was rounded, when all angles were free (radians, up to 1e-6)
  bool is_rounded = false;                 ///< whether angles were rounded
  std::vector<Index> flattened;            ///< cones whose angles were rounded to 2 pi: they are none any more

  Conformal_metric<NT> metric;             ///< with these angle sums, and u = 0 on borders
  double maximum_log_scale_factor = 0;     ///< the largest |u| of `metric`

  /// the largest factor, or its inverse, by which `metric` scales areas relative to the total area: of its triangles; where edges were flipped, of
  /// the surroundings of vertices, e^{2u}. 1 if there is no metric
  double area_distortion = 1;

  /// the area-weighted root mean square of u of `metric`, less its mean: the square root of the sum of A (u - m)^2, A a third of the areas of the
  /// triangles at a vertex of the surface given, all in all 1, and m the mean of u with these weights
  double root_mean_square = 0;
  std::size_t number_of_sweeps = 0;        ///< of the concurrent optimization
  std::size_t number_of_moves = 0;         ///< of single cones to vertices nearby that made it better
  std::size_t number_of_solves = 0;        ///< linear systems solved with the one factor
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_CONE_PLACEMENT_H
