// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Meshes of CGAL and their layouts, handed to the checker of check_flattening.h, and some
// surfaces more for the tests of the doors.

#ifndef CGAL_TEST_CONFORMAL_EQUIVALENCE_FLATTENED_MESHES_H
#define CGAL_TEST_CONFORMAL_EQUIVALENCE_FLATTENED_MESHES_H

#include "boost_test.h"
#include "check_flattening.h"
#include "test_meshes.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace testing {

typedef CGAL::Simple_cartesian<double>       Kernel;
typedef Kernel::Point_2                      Point_2;
typedef Kernel::Point_3                      Point_3;
typedef CGAL::Surface_mesh<Point_3>          Mesh;
typedef Mesh::Vertex_index                   Vertex;
typedef Mesh::Halfedge_index                 Halfedge;
typedef Mesh::Edge_index                     Edge;
typedef Mesh::Face_index                     Face;

inline Mesh read_mesh(const std::string& name)
{
  Mesh sm;
  BOOST_REQUIRE(CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(mesh_path(name), sm));
  return sm;
}

// The disks of CGAL on which the fixed triangulation's minimizer is a metric.
inline const std::vector<std::string>& good_disks()
{
  static const std::vector<std::string> names = {
    "lion-head.off", "three_peaks.off", "nefertiti.off", "mushroom.off", "plane.off",
    "patch-01.off", "patch-13.off", "patch-20.off", "patch-21.off", "patch-23.off", "patch-30.off",
    "mesh_with_border.off", "cylinder.off", "poly2x^2+y^2-0.062500.off", "open_cube.off" };
  return names;
}

// --- for the checker ----------------------------------------------------------------------------

template <typename TriangleMesh>
checking::Surface surface_of(const TriangleMesh& tm)
{
  checking::Surface result;
  const auto vpm = get(CGAL::vertex_point, tm);
  std::map<typename boost::graph_traits<TriangleMesh>::vertex_descriptor, std::size_t> index;
  for(auto v : vertices(tm))
  {
    const auto& p = get(vpm, v);
    index.emplace(v, result.points.size());
    result.points.push_back({{CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())}});
  }
  for(auto f : faces(tm))
  {
    auto h = halfedge(f, tm);
    std::array<std::size_t, 3> face;
    for(std::size_t k = 0; k < 3; ++k, h = next(h, tm))
      face[k] = index[target(h, tm)];
    result.faces.push_back(face);
  }
  return result;
}

// `corner(h)` is the point of target(h) in the face of h
template <typename TriangleMesh, typename Corner>
checking::Surface layout_of(const TriangleMesh& tm, const Corner& corner)
{
  checking::Surface result = surface_of(tm);
  for(auto f : faces(tm))
  {
    auto h = halfedge(f, tm);
    std::array<std::size_t, 3> corners;
    for(std::size_t k = 0; k < 3; ++k, h = next(h, tm))
    {
      corners[k] = result.texture.size();
      const auto p = corner(h);
      result.texture.push_back({{CGAL::to_double(p.x()), CGAL::to_double(p.y()), 1}});
    }
    result.corners.push_back(corners);
  }
  return result;
}

template <typename TriangleMesh, typename HalfedgeUVMap>
checking::Verdict judge(const TriangleMesh& tm, HalfedgeUVMap uv, bool border_keeps_its_lengths = true,
                        const checking::Cones& cones = checking::Cones())
{
  checking::Tolerances tolerances;
  tolerances.border_keeps_its_lengths = border_keeps_its_lengths;
  return checking::check_flattening(surface_of(tm), layout_of(tm, [&](auto h) { return get(uv, h); }), tolerances, cones);
}

template <typename TriangleMesh, typename VertexUVMap>
checking::Verdict judge_vertices(const TriangleMesh& tm, VertexUVMap uv)
{
  return checking::check_flattening(surface_of(tm), layout_of(tm, [&](auto h) { return get(uv, target(h, tm)); }));
}

// --- layouts ------------------------------------------------------------------------------------

inline double plane_distance(const Point_2& p, const Point_2& q)
{
  return std::hypot(q.x() - p.x(), q.y() - p.y());
}

template <typename HalfedgeUVMap>
double uv_length(const Mesh& sm, HalfedgeUVMap uv, Halfedge h)
{
  return plane_distance(get(uv, prev(h, sm)), get(uv, h));
}

// Of the box around the layout.
template <typename HalfedgeUVMap>
double uv_diameter(const Mesh& sm, HalfedgeUVMap uv)
{
  double x[2] = { HUGE_VAL, -HUGE_VAL }, y[2] = { HUGE_VAL, -HUGE_VAL };
  for(Halfedge h : halfedges(sm))
    if(!is_border(h, sm))
    {
      const Point_2 p = get(uv, h);
      x[0] = (std::min)(x[0], p.x());
      x[1] = (std::max)(x[1], p.x());
      y[0] = (std::min)(y[0], p.y());
      y[1] = (std::max)(y[1], p.y());
    }
  return std::hypot(x[1] - x[0], y[1] - y[0]);
}

// Diameter of the layout by its shortest edge: rounding of the coordinates changes lengths, relatively, by
// about 2^-53 times that.
template <typename HalfedgeUVMap>
double rounding_of_lengths(const Mesh& sm, HalfedgeUVMap uv)
{
  double shortest = HUGE_VAL;
  for(Halfedge h : halfedges(sm))
    if(!is_border(h, sm))
      shortest = (std::min)(shortest, uv_length(sm, uv, h));
  return std::ldexp(uv_diameter(sm, uv) / shortest, -53);
}

// The angle at target(h) in the face of h.
template <typename HalfedgeUVMap>
double uv_angle(const Mesh& sm, HalfedgeUVMap uv, Halfedge h)
{
  const Point_2 p = get(uv, h), q = get(uv, next(h, sm)), r = get(uv, prev(h, sm));
  const double x = q.x() - p.x(), y = q.y() - p.y(), s = r.x() - p.x(), t = r.y() - p.y();
  return std::atan2(x * t - y * s, x * s + y * t);
}

template <typename HalfedgeUVMap>
double uv_angle_sum(const Mesh& sm, HalfedgeUVMap uv, Vertex v)
{
  double sum = 0;
  for(Halfedge h : CGAL::halfedges_around_target(v, sm))
    if(!is_border(h, sm))
      sum += uv_angle(sm, uv, h);
  return sum;
}

inline Halfedge border_halfedge(const Mesh& sm)
{
  for(Halfedge h : halfedges(sm))
    if(is_border(h, sm))
      return h;
  return Mesh::null_halfedge();
}

inline std::vector<Vertex> border_vertices(const Mesh& sm)
{
  std::vector<Vertex> result;
  for(Halfedge h : CGAL::halfedges_around_face(border_halfedge(sm), sm))
    result.push_back(target(h, sm));
  return result;
}

} // namespace testing

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_FLATTENED_MESHES_H
