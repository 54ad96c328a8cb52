// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Disk_frame.h
/// The values of the named parameter `disk_frame` of `map_to_disk()`: maps to the unit disk differ by a Moebius transformation of the disk
/// (section 4.2 of Springborn, Schroeder and Pinkall, 2008), and one of these tells which of them is wanted.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_DISK_FRAME_H
#define CGAL_CONFORMAL_EQUIVALENCE_DISK_FRAME_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <array>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// The frame in which the barycentre of the vertices of the double, on the sphere of which the disk is a half, is the centre, and the first border
/// vertex lies at (1, 0): the default of the named parameter `disk_frame`.
struct Barycentre_disk_frame {};

/// \ingroup PkgConformalEquivalenceLayout
///
/// The frame in which an inner vertex lies in the centre, and the first border vertex at (1, 0): a value of the named parameter `disk_frame`.
/// \tparam Vertex a vertex descriptor
template <typename Vertex>
struct Centred_disk_frame
{
  Vertex centre; ///< a vertex that is not on the border
};

/// \ingroup PkgConformalEquivalenceLayout
///
/// The frame in which three border vertices lie at (1, 0), e^{2 pi i / 3} and e^{4 pi i / 3}: a value of the named parameter `disk_frame`.
/// \tparam Vertex a vertex descriptor
template <typename Vertex>
struct Three_point_disk_frame
{
  std::array<Vertex, 3> border; ///< different border vertices, in the order in which they follow each other with the surface on the left
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_DISK_FRAME_H
