// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Layout_certificate.h
/// The verdict of `certify_layout()` on the map that a metric gives.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_LAYOUT_CERTIFICATE_H
#define CGAL_CONFORMAL_EQUIVALENCE_LAYOUT_CERTIFICATE_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Status.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceJudging
///
/// What `certify_layout()` has found out.
struct Layout_certificate
{
  typedef std::uint32_t Index; ///< of vertices and faces

  /// `true` iff the map is one-to-one around every point of the surface that is no cone and not on the border: all faces of
  /// the common refinement that are not exempt are positive, and they turn once around every vertex.
  bool is_certified = false;

  /// of the numbers that the last attempt was made with: 106 for pairs of `double`, more for `Multiprecision_number`
  unsigned int precision_in_bits = 0;

  std::vector<Index> flipped_faces;    ///< faces of the refinement that are not positive, and not exempt
  std::vector<Index> exempt_faces;     ///< faces of the input without area, parts of which are not positive
  std::vector<Index> turning_vertices; ///< vertices of the input where the angles of the layout do not add up to what they must

  /// the largest difference, in radians, of the sum of the angles of the layout around a vertex from the prescribed one
  double angle_error = 0;

  std::size_t number_of_faces = 0;     ///< of the refinement

  /// faces that are positive, but no longer so when their corners are rounded to `double`
  std::size_t number_of_faces_lost_in_double = 0;

  double residual = 0;                 ///< of the metric that was laid out (radians)

  /// `OK`; `NOT_INJECTIVE`: not certified; or why there is no common refinement
  Status status = Status::OK;

  /// is `true` iff the map is certified.
  explicit operator bool() const { return is_certified; }
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_LAYOUT_CERTIFICATE_H
