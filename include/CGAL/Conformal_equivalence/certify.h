// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file certify.h
/// Is the map that a metric gives locally one-to-one? Decided by exact predicates on coordinates with as many digits as it
/// takes ("None of our layouts ... have any flipped triangles", section 7 of Springborn, Schroeder and Pinkall, 2008): where
/// scale factors range far, triangles are so small that `double` cannot tell their corners apart, while the metric is as good
/// as anywhere.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_CERTIFY_H
#define CGAL_CONFORMAL_EQUIVALENCE_CERTIFY_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout_certificate.h>
#include <CGAL/Conformal_equivalence/internal/Doors/layout_certification.h>

#include <CGAL/assertions.h>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceJudging
///
/// certifies that the map from the surface to the plane, projective on the faces of the common refinement, is one-to-one
/// around every point: all faces are strictly convex polygons, counterclockwise, by exact predicates on the coordinates as
/// computed, and they turn once around every vertex (around cones, and vertices on the cut, by the angle prescribed up to
/// 1e-10). Without flips the faces are the triangles of the input.
///
/// The coordinates are pairs of `double` first. If something then is wrong, the metric is refined, for the same
/// triangulation, and laid out with twice the number of bits, and so on: triangles that are too small for 106 bits are seen
/// with more. What is wrong because the metric is, remains wrong. Zero-area faces of the input may have no area in the plane:
/// they are exempt, and listed.
///
/// \param input the triangulation that was given to the solver
/// \param metric what the solver returned
/// \param cut what it leaves should be disks, with all cones on their borders, as `compute_cut_graph()` provides
/// \param conditions the conditions that were given to the solver
/// \param maximum_precision the largest number of bits to try
///
/// \return the certificate of the first attempt that succeeded, or of the last one. Status: `OK`, `NOT_INJECTIVE`, or one of
/// `compute_common_refinement()`.
///         Time of the first attempt is linear in the sizes of the triangulations and the number of crossings; each of the
///         others also solves for the metric again, in `Multiprecision_number`.
/// \pre `metric` is a success; its triangulation is `input`, or was made from it by `Conformal_metric::flips`.
///
/// \sa `CGAL::Conformal_equivalence::verify_layout()`
/// \sa `CGAL::Conformal_equivalence::compute_common_refinement()`
inline Layout_certificate certify_layout(const Intrinsic_triangulation<double>& input,
                                         const Conformal_metric<double>& metric,
                                         const Cut_graph& cut,
                                         const Conformal_conditions<double>& conditions,
                                         unsigned int maximum_precision = 4096)
{
  CGAL_precondition(bool(metric) && conditions.size() == input.number_of_vertices());
  return internal::certify_with_enough_bits(input, metric, cut, conditions, maximum_precision);
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_CERTIFY_H
