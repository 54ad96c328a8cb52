// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Status.h
/// How the functions of this package say what happened. Nothing that depends on the user's data is an exception or an assertion.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_STATUS_H
#define CGAL_CONFORMAL_EQUIVALENCE_STATUS_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Surface_mesh_parameterization/Error_code.h>

#include <string>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceStatus
/// What became of a computation.
enum class Status
{
  OK,                    ///< done: every angle sum is within `gradient_tolerance` of its target
  CONVERGED_TO_ROUNDING, ///< done as far as the number type can tell: `amount` is the residual reached (radians)
  EMPTY_MESH,            ///< the mesh has no face
  NOT_TRIANGULATED,      ///< `faces` are no triangles
  NON_MANIFOLD,          ///< the faces at `vertices` form more than one fan
  INVALID_NUMBER,        ///< a coordinate, length or condition of the elements named is not a finite number, or a length is negative
  ZERO_LENGTH_EDGE,      ///< `edges` have length zero (coincident points)
  WRONG_TOPOLOGY,        ///< the surface is not of the kind that this function takes; see `Flattening_report::topology`
  GAUSS_BONNET_VIOLATED, ///< on a component without fixed u, that of `vertices`, the prescribed angles leave `amount` (radians)
                         ///< too much or too little
  NO_ANGLE_LEFT,         ///< on a component the prescribed angles leave `amount` <= 0 (radians) for `vertices`, where u is fixed
  ANGLE_OUT_OF_RANGE,    ///< the angle prescribed at `vertices` cannot occur there; `amount` is the first one (radians)
  /// `vertices` lack a condition that the function needs; or the closed surfaces of `faces`, of a genus other than 1, lack cones
  MISSING_CONDITION,
  SINGULAR_PROBLEM,      ///< the linear system could not be factorized
  ITERATIONS_EXHAUSTED,  ///< not converged, no metric; `amount` is the residual (radians), `faces` the triangles broken at that point
  /// the metric was found, but u, which ranges over `amount`, leaves the range of the number type, or that of points in it: a number type with more
  /// digits, and a wider range of exponents, holds it
  SCALE_OUT_OF_RANGE,
  DEGENERATE_METRIC,     ///< the minimizer violates the triangle inequality in `faces`; if edges were flipped, in triangles at `vertices`
  NOT_INJECTIVE,         ///< the layout flips `faces`, or its border crosses itself
  SEAM_LEAVES_NO_DISK,   ///< cut along the given seam, `edges`, the surface is no disk; see `Flattening_report::topology`
  SEAM_MISSES_CONE,      ///< the cones at `vertices` are not on the given seam
  STOPPED_BY_VISITOR,    ///< the visitor asked to stop
  OUT_OF_MEMORY,         ///< memory was exhausted
  TOO_MANY_CROSSINGS,    ///< the overlay of two triangulations would have `amount` crossings: more than allowed
  NOT_REPRESENTABLE,     ///< the mesh type cannot hold the result: it would have several edges between the same vertices
  TOO_MANY_CONES,        ///< more cones are asked for than there are vertices for them: `amount`
  BOUND_NOT_MET,         ///< the distortion asked for was not reached, but `amount`: what was found is returned nevertheless
  NOT_QUANTIZABLE,       ///< no such multiples of the angle quantum sum up to what the topology asks for: `amount` (radians)
  /// from one side of the seam at `edges` to the other the surface turns by `amount` (radians): no multiple of the angle quantum
  NOT_SEAMLESS,
  /// whatever its metric, no surface of this topology has the cones at `vertices` and handles that turn like that; or the loops along `edges`,
  /// for which turnings are prescribed, are not closed, or contradict one another
  NOT_REALIZABLE
};

/// \ingroup PkgConformalEquivalenceStatus
/// returns `true` iff `status` stands for a usable result.
constexpr bool is_success(Status status)
{
  return status == Status::OK || status == Status::CONVERGED_TO_ROUNDING;
}

namespace internal {

struct Status_description
{
  const char* text;
  Surface_mesh_parameterization::Error_code error_code;
};

// What a status says, and what CGAL's parameterizers call it. Without `default`, so that compilers warn of a status that is not told of here.
constexpr Status_description description(Status status)
{
  namespace SMP = Surface_mesh_parameterization;
  switch(status)
  {
    case Status::OK:                    return {"success", SMP::OK};
    case Status::CONVERGED_TO_ROUNDING: return {"converged to the rounding of the number type", SMP::OK};
    case Status::EMPTY_MESH:            return {"the mesh has no face", SMP::ERROR_EMPTY_MESH};
    case Status::NOT_TRIANGULATED:      return {"the mesh has faces that are not triangles", SMP::ERROR_NON_TRIANGULAR_MESH};
    case Status::NON_MANIFOLD:          return {"the mesh is not a manifold", SMP::ERROR_WRONG_PARAMETER};
    case Status::INVALID_NUMBER:        return {"the mesh or the conditions hold an invalid number", SMP::ERROR_WRONG_PARAMETER};
    case Status::ZERO_LENGTH_EDGE:      return {"the mesh has edges of length zero", SMP::ERROR_WRONG_PARAMETER};
    case Status::WRONG_TOPOLOGY:        return {"the surface has the wrong topology", SMP::ERROR_NO_TOPOLOGICAL_DISC};
    case Status::GAUSS_BONNET_VIOLATED: return {"the prescribed angles violate the Gauss-Bonnet formula", SMP::ERROR_WRONG_PARAMETER};
    case Status::NO_ANGLE_LEFT:         return {"the prescribed angles leave none for the vertices of fixed scale", SMP::ERROR_WRONG_PARAMETER};
    case Status::ANGLE_OUT_OF_RANGE:    return {"a prescribed angle is out of range", SMP::ERROR_WRONG_PARAMETER};
    case Status::MISSING_CONDITION:     return {"a condition is missing", SMP::ERROR_BORDER_TOO_SHORT};
    case Status::SINGULAR_PROBLEM:      return {"the linear system cannot be factorized", SMP::ERROR_CANNOT_SOLVE_LINEAR_SYSTEM};
    case Status::ITERATIONS_EXHAUSTED:  return {"the iteration did not converge", SMP::ERROR_CANNOT_SOLVE_LINEAR_SYSTEM};
    case Status::SCALE_OUT_OF_RANGE:    return {"there is a metric, but its scale factors leave the range of the number type",
                                                SMP::ERROR_CANNOT_SOLVE_LINEAR_SYSTEM};
    case Status::DEGENERATE_METRIC:     return {"the metric violates the triangle inequality", SMP::ERROR_NO_1_TO_1_MAPPING};
    case Status::NOT_INJECTIVE:         return {"the map is not injective", SMP::ERROR_NO_1_TO_1_MAPPING};
    case Status::SEAM_LEAVES_NO_DISK:   return {"the seam does not cut the surface into a disk", SMP::ERROR_NO_TOPOLOGICAL_DISC};
    case Status::SEAM_MISSES_CONE:      return {"the seam misses a cone", SMP::ERROR_NO_TOPOLOGICAL_DISC};
    case Status::STOPPED_BY_VISITOR:    return {"stopped by the visitor", SMP::ERROR_WRONG_PARAMETER};
    case Status::OUT_OF_MEMORY:         return {"out of memory", SMP::ERROR_CANNOT_SOLVE_LINEAR_SYSTEM};
    case Status::TOO_MANY_CROSSINGS:    return {"the overlay of the triangulations has too many crossings", SMP::ERROR_WRONG_PARAMETER};
    case Status::NOT_REPRESENTABLE:     return {"the mesh cannot hold the result", SMP::ERROR_WRONG_PARAMETER};
    case Status::TOO_MANY_CONES:        return {"there are not enough vertices for the cones", SMP::ERROR_WRONG_PARAMETER};
    case Status::BOUND_NOT_MET:         return {"the bound on the distortion was not met", SMP::ERROR_WRONG_PARAMETER};
    case Status::NOT_QUANTIZABLE:       return {"the cones cannot have multiples of the angle quantum", SMP::ERROR_WRONG_PARAMETER};
    case Status::NOT_SEAMLESS:          return {"the two sides of the seam do not differ by a multiple of the angle quantum",
                                                SMP::ERROR_WRONG_PARAMETER};
    case Status::NOT_REALIZABLE:        return {"there is no flat surface with such cones and turnings of loops", SMP::ERROR_WRONG_PARAMETER};
  }
  return {"", SMP::ERROR_WRONG_PARAMETER}; // no status
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceStatus
/// returns a short English text for `status`.
inline std::string message(Status status) { return internal::description(status).text; }

/// \ingroup PkgConformalEquivalenceStatus
/// returns the error code by which \cgal's parameterizers report `status`.
/// (\cgal's own `get_error_message()` is out of step with these codes: use `message()`.)
inline Surface_mesh_parameterization::Error_code to_error_code(Status status)
{
  return internal::description(status).error_code;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_STATUS_H
