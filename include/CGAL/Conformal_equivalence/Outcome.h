// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Outcome.h
/// What every result at index level has in common: what happened, by how much, and the elements at fault.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_OUTCOME_H
#define CGAL_CONFORMAL_EQUIVALENCE_OUTCOME_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Status.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceStatus
///
/// What became of a computation on an `Intrinsic_triangulation`: results derive from it. See `Status` for what the members mean
/// with each status. (What functions on meshes return is a `Flattening_report`.)
struct Outcome
{
  typedef std::uint32_t Index;  ///< of vertices, edges and faces

  Status status = Status::OK;   ///< whether there is a result, or why not
  double amount = 0;            ///< by how much, see `Status`
  std::vector<Index> vertices;  ///< vertices at fault
  std::vector<Index> edges;     ///< edges at fault
  std::vector<Index> faces;     ///< faces at fault

  /// is `true` iff the result is usable.
  explicit operator bool() const { return is_success(status); }

  /// this part of a result alone.
  const Outcome& outcome() const { return *this; }

  /// takes over what became of another computation.
  void set_outcome(const Outcome& other) { *this = other; }
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_OUTCOME_H
