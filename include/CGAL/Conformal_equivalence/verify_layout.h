// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_VERIFY_LAYOUT_H
#define CGAL_CONFORMAL_EQUIVALENCE_VERIFY_LAYOUT_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/internal/Layout/Cover_sweep.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

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

namespace internal {

typedef std::array<Plane_point, 3> Plane_triangle;

inline bool is_finite(const Plane_point& p)
{
  return std::isfinite(p.x()) && std::isfinite(p.y());
}

// The orientation, COLLINEAR also if some coordinate is not a finite number.
inline Orientation triangle_orientation(const Plane_triangle& t)
{
  if(!is_finite(t[0]) || !is_finite(t[1]) || !is_finite(t[2]))
    return COLLINEAR;
  return orientation(t[0], t[1], t[2]);
}

// All pairs of segments that cross properly, in lexicographic order.
inline std::vector<std::pair<std::size_t, std::size_t> >
properly_crossing_pairs(const std::vector<Border_segment>& segments)
{
  typedef Box_intersection_d::Box_with_info_d<double, 2, std::size_t> Box;

  std::vector<Box> boxes;
  boxes.reserve(segments.size());
  for(std::size_t s = 0; s < segments.size(); ++s)
    boxes.emplace_back(segments[s].source.bbox() + segments[s].target.bbox(), s);

  std::vector<std::pair<std::size_t, std::size_t> > pairs;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b)
  {
    const Border_segment &s = segments[a.info()], &t = segments[b.info()];
    if(cross_properly(s.source, s.target, t.source, t.target))
      pairs.push_back(std::minmax({a.info(), b.info()}));
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

// The pairs of segments that prove that the layout covers something twice; empty if it does not.
inline std::vector<std::pair<std::size_t, std::size_t> >
find_overlaps(const std::vector<Border_segment>& segments)
{
  const Cover_sweep sweep(segments);
  if(!sweep.is_covered_twice())
    return {};
  auto pairs = properly_crossing_pairs(segments);
  if(pairs.empty())
    pairs.emplace_back(sweep.first_witness(), sweep.second_witness());
  return pairs;
}

template <typename HalfedgeUVMap, typename Halfedge>
Plane_point plane_point(HalfedgeUVMap uv, Halfedge h)
{
  const typename boost::property_traits<HalfedgeUVMap>::value_type p = get(uv, h);
  return Plane_point(CGAL::to_double(p.x()), CGAL::to_double(p.y()));
}

// Has h, which has a face and runs from `from` to `to` there, the same place in the layout of its neighbor?
template <typename TriangleMesh, typename HalfedgeUVMap>
bool is_glued_to_neighbor(const TriangleMesh& tm, HalfedgeUVMap uv,
                          typename boost::graph_traits<TriangleMesh>::halfedge_descriptor h,
                          const Plane_point& from, const Plane_point& to)
{
  const auto o = opposite(h, tm);
  return !is_border(o, tm) && plane_point(uv, o) == from && plane_point(uv, prev(o, tm)) == to;
}

// Sorts the triangles into positive, flipped and degenerate ones and collects the border of the layout; returns
// false if some face is not a triangle.
template <typename TriangleMesh, typename HalfedgeUVMap>
bool read_layout(const TriangleMesh& tm, HalfedgeUVMap uv,
                 Layout_verdict<TriangleMesh>& verdict,
                 std::vector<Border_segment>& border,
                 std::vector<typename boost::graph_traits<TriangleMesh>::halfedge_descriptor>& border_halfedges)
{
  bool all_triangles = true;
  for(auto f : faces(tm))
  {
    const auto h0 = halfedge(f, tm);
    const auto h1 = next(h0, tm), h2 = next(h1, tm);
    if(next(h2, tm) != h0)
    {
      all_triangles = false;
      continue;
    }
    const std::array<decltype(next(h0, tm)), 3> h = {{ h0, h1, h2 }};
    const Plane_triangle t = {{ plane_point(uv, h0), plane_point(uv, h1), plane_point(uv, h2) }};
    const Orientation o = triangle_orientation(t);
    if(o == RIGHT_TURN)
      verdict.flipped_faces.push_back(f);
    else if(o == COLLINEAR)
      verdict.degenerate_faces.push_back(f);

    for(std::size_t i = 0; i < 3; ++i)
    {
      const Plane_point &from = t[(i + 2) % 3], &to = t[i];
      if(is_glued_to_neighbor(tm, uv, h[i], from, to))
        continue;
      border.push_back({ from, to });
      border_halfedges.push_back(h[i]);
    }
  }
  return all_triangles;
}

} // namespace internal

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
/// \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
///
/// \param tm the mesh.
/// \param uv the layout: `uv[h]` is the corner of `target(h)` in `face(h)`; not read at border halfedges.
/// \return the verdict; in an empty list nothing is wrong.
///
/// The last parameter accepts the named parameters of a whole computation; none of them is read here.
///
/// Linear in the number of faces, plus O((n + t) log n) for n edges of the layout's border and t vertices that
/// touch it; if it overlaps, plus the time to list the k crossings, O(n log^2 n + k) for short edges.
template <typename TriangleMesh, typename HalfedgeUVMap,
          typename NamedParameters = parameters::Default_named_parameters>
Layout_verdict<TriangleMesh>
verify_layout(const TriangleMesh& tm,
              HalfedgeUVMap uv,
              const NamedParameters& = parameters::default_values())
{
  Layout_verdict<TriangleMesh> verdict;
  std::vector<internal::Border_segment> border;
  std::vector<typename boost::graph_traits<TriangleMesh>::halfedge_descriptor> border_halfedges;

  const bool all_triangles = internal::read_layout(tm, uv, verdict, border, border_halfedges);
  verdict.number_of_flipped_triangles = verdict.flipped_faces.size();
  verdict.number_of_degenerate_triangles = verdict.degenerate_faces.size();
  if(!verdict.flipped_faces.empty() || !verdict.degenerate_faces.empty())
  {
    verdict.injectivity = Injectivity::NO;
    return verdict;
  }
  if(!all_triangles)
    return verdict;

  for(const auto& pair : internal::find_overlaps(border))
    verdict.crossing_borders.emplace_back(border_halfedges[pair.first], border_halfedges[pair.second]);
  verdict.injectivity = verdict.crossing_borders.empty() ? Injectivity::YES : Injectivity::NO;
  return verdict;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_VERIFY_LAYOUT_H
