// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Spherical_refinement.h
/// What becomes of the triangles of a closed surface on the sphere where edges were flipped on the way
/// (section 4.3 of Springborn, Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_SPHERICAL_REFINEMENT_H
#define CGAL_CONFORMAL_EQUIVALENCE_SPHERICAL_REFINEMENT_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Common_refinement.h>

#include <array>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// The overlay of a closed surface and the convex polyhedron that is its image on the sphere, when edges were flipped on the way.
///
/// The faces are parts of faces of the input and of faces of the polyhedron. With barycentric coordinates b of the corners of a
/// face, as points of the input face, the image is the point of the sphere in the direction of the sum of the b w p with the weight w and the
/// point p of each corner: continuous, and along every edge of the input the same from both sides.
///
/// \tparam NT_ number type of the coordinates
template <typename NT_ = double>
struct Spherical_refinement
{
  typedef NT_ NT;              ///< number type of the coordinates
  typedef std::uint32_t Index; ///< of vertices and faces

  /// vertices, faces and weights of the overlay, see there; its `corner_uv` is empty. Verdict: its faces as polygons of great arcs
  Common_refinement<NT> parts;
  /// by vertex of `parts`: its point of the unit sphere; the origin for isolated vertices
  std::vector<std::array<NT, 3> > points;
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_SPHERICAL_REFINEMENT_H
