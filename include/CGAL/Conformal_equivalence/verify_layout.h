// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file verify_layout.h
///
/// What a layout of a triangle mesh in the plane is worth, decided by exact predicates on its coordinates:
/// are all triangles positively oriented, and is the layout injective
/// (cf. Springborn, Schroeder, Pinkall 2008, Section 7: "None of our layouts ... have any flipped triangles").
///
/// If all triangles are positive, the number of triangles over a generic point of the plane is the sum of the
/// winding numbers of the layout's border around it (the degree of the map).  So the border alone tells whether
/// some part of the plane is covered twice, whatever the topology of the surface and the number of its pieces,
/// and also if the layout branches at an inner vertex.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_VERIFY_LAYOUT_H
#define CGAL_CONFORMAL_EQUIVALENCE_VERIFY_LAYOUT_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/internal/Layout/Cover_sweep.h>
#include <CGAL/Conformal_equivalence/internal/Layout/layout_border.h>

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceJudging
///
/// Whether the interiors of the triangles of a layout are positively oriented and pairwise disjoint.
enum class Injectivity
{
  YES,         ///< proved. Only border points may share a place: parts of the border may touch, also along edges.
  NO,          ///< disproved; the culprits are in the verdict.
  UNDECIDED    ///< nothing can be said: a face is not a triangle.
};

/// \ingroup PkgConformalEquivalenceJudging
///
/// The verdict of `verify_layout()` on a layout.
template <typename TriangleMesh>
struct Layout_verdict
{
  typedef typename boost::graph_traits<TriangleMesh>::halfedge_descriptor   halfedge_descriptor; ///< of the mesh
  typedef typename boost::graph_traits<TriangleMesh>::face_descriptor       face_descriptor;     ///< of the mesh

  std::size_t number_of_flipped_triangles = 0;      ///< the size of `flipped_faces`
  std::size_t number_of_degenerate_triangles = 0;   ///< the size of `degenerate_faces`

  /// the triangles of negative orientation, in the order of `faces(tm)`.
  std::vector<face_descriptor> flipped_faces;

  /// the triangles whose corners are collinear or not finite numbers, in the order of `faces(tm)`.
  std::vector<face_descriptor> degenerate_faces;

  /// Is the layout injective?
  Injectivity injectivity = Injectivity::UNDECIDED;

  /// the overlaps: all pairs of border halfedges (with a face) that cross properly in the layout, the earlier
  /// in the order of `faces(tm)` first.  If the layout overlaps without such a pair (one piece upon another, or a
  /// crossing at a vertex), one pair: beside the first halfedge the layout lies upon the part above the second.
  /// Empty if `injectivity` is not `NO`, or if a face is flipped or degenerate (the border then was not looked at).
  std::vector<std::pair<halfedge_descriptor, halfedge_descriptor> > crossing_borders;
};

/// \ingroup PkgConformalEquivalenceJudging
///
/// decides by exact predicates whether the triangles of a layout are positively oriented and whether the layout is
/// injective, and names the culprits if not.
///
/// The coordinates are taken as the `double`s they are converted to; nothing is rounded after that.  An edge
/// belongs to the border of the layout if it has one face only or if its two faces give it different places.
/// The layout is injective if all triangles are positive and their interiors disjoint; the layout then is
/// one-to-one on the interior of the surface, while its border may touch itself.  A coordinate that is NaN or
/// infinite makes its triangles degenerate.  A layout without triangles is injective.
///
/// \tparam TriangleMesh a model of `FaceListGraph`; it need not be connected, nor a disk.
/// \tparam HalfedgeUVMap a model of `ReadablePropertyMap` with key
///   `boost::graph_traits<TriangleMesh>::%halfedge_descriptor` and a `Point_2` of a \cgal kernel as value.
///
/// \param tm the mesh.
/// \param uv the layout: `uv[h]` is the corner of `target(h)` in `face(h)`; not read at border halfedges.
/// \return the verdict; in an empty list nothing is wrong.
///
/// Linear in the number of faces, plus O((n + t) log n) for n edges of the layout's border and t vertices that
/// touch it; if it overlaps, plus the time to list the k crossings, O(n log^2 n + k) for short edges.
template <typename TriangleMesh, typename HalfedgeUVMap>
Layout_verdict<TriangleMesh> verify_layout(const TriangleMesh& tm, HalfedgeUVMap uv)
{
  Layout_verdict<TriangleMesh> verdict;
  const internal::Layout_reading<TriangleMesh> layout = internal::read_layout(tm, uv);
  verdict.flipped_faces = layout.flipped_faces;
  verdict.degenerate_faces = layout.degenerate_faces;
  verdict.number_of_flipped_triangles = verdict.flipped_faces.size();
  verdict.number_of_degenerate_triangles = verdict.degenerate_faces.size();
  if(layout.is_positive() && !layout.are_all_triangles)
    return verdict;
  if(layout.is_positive())
    for(const auto& pair : internal::find_overlaps(layout.border))
      verdict.crossing_borders.emplace_back(layout.border_halfedges[pair.first], layout.border_halfedges[pair.second]);
  verdict.injectivity = layout.is_positive() && verdict.crossing_borders.empty() ? Injectivity::YES : Injectivity::NO;
  return verdict;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_VERIFY_LAYOUT_H
