// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file triangulate_refinement.h
/// The common refinement of a surface and a flat metric, in triangles, for meshes and files that hold nothing else.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_TRIANGULATE_REFINEMENT_H
#define CGAL_CONFORMAL_EQUIVALENCE_TRIANGULATE_REFINEMENT_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Cell_verdict.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/fan_triangulation.h>

#include <cstdint>
#include <utility>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// returns the same refinement with every face cut into triangles, from one of its corners: from the one that leaves the thickest triangles in
/// the layout. All parts of a face are mapped by the same projective map as before. The verdict is renewed for the triangles. Linear time.
template <typename NT>
Common_refinement<NT> triangulate_refinement(const Common_refinement<NT>& refinement)
{
  internal::Cell_verdict verdict;
  Common_refinement<NT> result = internal::without_faces(refinement);
  for(std::uint32_t f = 0; f < refinement.number_of_faces(); ++f)
    internal::append_fan(refinement, f, result, verdict);
  internal::put_verdict(std::move(verdict), result);
  return result;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_TRIANGULATE_REFINEMENT_H
