// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_SPLIT_SURFACE_H
#define FLATTEN_MESH_SPLIT_SURFACE_H

#include "mesh.h"
#include "results.h"

#include <CGAL/Conformal_equivalence/internal/IO/corner_values.h>

#include <CGAL/boost/graph/properties.h>

#include <array>
#include <cstddef>
#include <vector>

namespace flattening {

// The point of vertex `v` on its sphere or disk, beside those of other components.
template <typename NT>
std::array<NT, 3> placed_point(const Result& result, const std::vector<std::array<NT, 3> >& points, std::size_t v)
{
  std::array<NT, 3> p = points[v];
  if(! result.centres.empty())
    for(std::size_t k = 0; k < 2; ++k)
      p[k] += NT(result.centres[v][k]);
  return p;
}

// The surface for files in which a vertex has one place in the layout: its vertices are split along seams, and nowhere else. On the sphere, where
// there is no layout, nothing is split. Vertices without a face are left out.
class Split_surface
{
  typedef boost::property_map<Mesh, CGAL::dynamic_halfedge_property_t<std::size_t> >::const_type Number_map;

  struct One_place { friend Kernel::Point_2 get(const One_place&, Halfedge) { return Kernel::Point_2(0, 0); } };

public:
  Split_surface(const Result& result, bool is_on_sphere)
    : result_(result), is_on_sphere_(is_on_sphere), number_(get(CGAL::dynamic_halfedge_property_t<std::size_t>(), mesh()))
  {
    corners_ = is_on_sphere ? CE::internal::number_corner_values(mesh(), One_place(), number_)
                            : CE::internal::number_corner_values(mesh(), result.uv, number_);
  }

  const Mesh& mesh() const { return result_.mesh; }
  const Result& result() const { return result_; }
  bool is_on_sphere() const { return is_on_sphere_; }

  // One corner of each vertex of the split surface.
  const std::vector<Halfedge>& corners() const { return corners_; }

  // The number, from 0, of the vertex of the split surface at the corner of `target(h)` in `face(h)`.
  std::size_t number(Halfedge h) const { return get(number_, h); }

  // The point in space: that of the surface or, if it was mapped there, of the sphere.
  Space_point point(Halfedge corner) const
  {
    const Vertex v = mesh().target(corner);
    if(is_on_sphere_)
      return placed_point(result_, result_.image, v.idx());
    return {{ mesh().point(v).x(), mesh().point(v).y(), mesh().point(v).z() }};
  }

private:
  const Result& result_;
  bool is_on_sphere_;
  Number_map number_;
  std::vector<Halfedge> corners_;
};

} // namespace flattening

#endif // FLATTEN_MESH_SPLIT_SURFACE_H
