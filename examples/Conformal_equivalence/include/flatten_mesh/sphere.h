// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The sphere, as a file, as a drawing, and as triangles that have a distortion.

#ifndef FLATTEN_MESH_SPHERE_H
#define FLATTEN_MESH_SPHERE_H

#include "image_figures.h"
#include "inscribe.h"
#include "mesh.h"
#include "results.h"
#include "write_SVG.h"

#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>

#include <cmath>
#include <ostream>
#include <vector>

namespace flattening {

// The mesh with these points; numbers with as many digits as it takes to read them back.
template <typename Point>
bool write_sphere_OBJ(std::ostream& out, const Mesh& mesh, const std::vector<Point>& points)
{
  {
    Text_buffer buffer(out);
    for(Vertex v : mesh.vertices())
    {
      buffer << 'v';
      for(const auto& x : points[v.idx()])
        CE::internal::write_obj_number(buffer << ' ', x);
      buffer << '\n';
    }
    for(Face f : mesh.faces())
    {
      buffer << 'f';
      for(Vertex v : mesh.vertices_around_face(mesh.halfedge(f)))
        buffer << ' ' << v.idx() + 1;
      buffer << '\n';
    }
  }
  out.flush();
  return out.good();
}

// Every triangle of chords, laid out in the plane by itself.
inline void lay_out_chords(Result& result)
{
  const auto point = [&](Vertex v)
  {
    const Space_point& p = result.image[v.idx()];
    return Kernel::Point_3(p[0], p[1], p[2]);
  };
  for(Face f : result.mesh.faces())
  {
    const Halfedge h = result.mesh.halfedge(f), n = result.mesh.next(h), p = result.mesh.next(n);
    const Kernel::Point_3 a = point(result.mesh.target(h));
    const Kernel::Vector_3 x = point(result.mesh.target(n)) - a, y = point(result.mesh.target(p)) - a;
    const double length = std::hypot(x.x(), x.y(), x.z());
    const Kernel::Vector_3 normal = CGAL::cross_product(x, y);
    result.uv[h] = Kernel::Point_2(0, 0);
    result.uv[n] = Kernel::Point_2(length, 0);
    result.uv[p] = length > 0 ? Kernel::Point_2(x * y / length, std::hypot(normal.x(), normal.y(), normal.z()) / length)
                              : Kernel::Point_2(0, 0);
  }
}

const double distance_of_hemispheres = 2.2;

// Both sides of the sphere, side by side: as seen from the z-axis, and from its other end.
inline UV_map hemispheres(Result& result)
{
  UV_map uv = result.mesh.add_property_map<Halfedge, Kernel::Point_2>("h:hemispheres").first;
  for(Face f : result.mesh.faces())
  {
    const auto v = vertices_of_face(result.mesh, f);
    const auto plane = [&](Vertex w) { return Kernel::Point_2(result.image[w.idx()][0], result.image[w.idx()][1]); };
    const bool is_front = CGAL::orientation(plane(v[0]), plane(v[1]), plane(v[2])) == CGAL::LEFT_TURN;
    for(Halfedge h : result.mesh.halfedges_around_face(result.mesh.halfedge(f)))
    {
      const Kernel::Point_2 p = plane(result.mesh.target(h));
      uv[h] = is_front ? p : Kernel::Point_2(distance_of_hemispheres - p.x(), p.y());
    }
  }
  return uv;
}

// For a layout that has nothing to do with that of the surface.
inline SVG_options hemisphere_options(SVG_options options)
{
  options.checkerboard = options.seams = options.cones = false;
  options.circles = { {{0, 0, 1}}, {{distance_of_hemispheres, 0, 1}} };
  return options;
}

} // namespace flattening

#endif // FLATTEN_MESH_SPHERE_H
