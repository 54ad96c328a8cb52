// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What `verify_layout()` reads from a mesh and its texture coordinates: the orientations of the triangles, and the border of the layout.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_LAYOUT_BORDER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_LAYOUT_BORDER_H

#include <CGAL/Conformal_equivalence/internal/Layout/Cover_sweep.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The orientation, COLLINEAR also if some coordinate is not a finite number.
inline Orientation triangle_orientation(const std::array<Plane_point, 3>& t)
{
  std::array<std::array<double, 2>, 3> p;
  for(std::size_t i = 0; i < 3; ++i)
    p[i] = {{ t[i].x(), t[i].y() }};
  return has_finite_coordinates(p[0]) && has_finite_coordinates(p[1]) && has_finite_coordinates(p[2]) ? turn(p[0], p[1], p[2]) : COLLINEAR;
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

// The triangles that are not positive, and the border of the layout: directed segments, and the halfedges that they are the places of.
template <typename TriangleMesh>
struct Layout_reading
{
  typedef typename boost::graph_traits<TriangleMesh>::halfedge_descriptor halfedge_descriptor;
  typedef typename boost::graph_traits<TriangleMesh>::face_descriptor face_descriptor;

  std::vector<face_descriptor> flipped_faces, degenerate_faces;
  std::vector<Border_segment> border;
  std::vector<halfedge_descriptor> border_halfedges;
  bool are_all_triangles = true;

  bool is_positive() const { return flipped_faces.empty() && degenerate_faces.empty(); }
};

template <typename TriangleMesh, typename HalfedgeUVMap>
Layout_reading<TriangleMesh> read_layout(const TriangleMesh& tm, HalfedgeUVMap uv)
{
  Layout_reading<TriangleMesh> result;
  for(auto f : faces(tm))
  {
    const auto h0 = halfedge(f, tm);
    const auto h1 = next(h0, tm), h2 = next(h1, tm);
    if(next(h2, tm) != h0)
    {
      result.are_all_triangles = false;
      continue;
    }
    const std::array<decltype(next(h0, tm)), 3> h = {{ h0, h1, h2 }};
    const std::array<Plane_point, 3> t = {{ plane_point(uv, h0), plane_point(uv, h1), plane_point(uv, h2) }};
    const Orientation o = triangle_orientation(t);
    if(o == RIGHT_TURN)
      result.flipped_faces.push_back(f);
    else if(o == COLLINEAR)
      result.degenerate_faces.push_back(f);

    for(std::size_t i = 0; i < 3; ++i)
    {
      const Plane_point &from = t[(i + 2) % 3], &to = t[i];
      if(is_glued_to_neighbor(tm, uv, h[i], from, to))
        continue;
      result.border.push_back({ from, to });
      result.border_halfedges.push_back(h[i]);
    }
  }
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_LAYOUT_BORDER_H
