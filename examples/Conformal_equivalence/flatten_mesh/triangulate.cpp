// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/triangulate.h"

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>

#include <boost/property_map/function_property_map.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace flattening {

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

typedef CGAL::Exact_predicates_inexact_constructions_kernel Predicates;
typedef Mesh::Property_map<Face, std::uint32_t>             Origin_map;

// CGAL decides how to divide by exact predicates if the points are those of such a kernel.
auto points_of(const Mesh& mesh)
{
  const auto point = [&mesh](Vertex v)
  {
    const Kernel::Point_3& p = mesh.point(v);
    return Predicates::Point_3(p.x(), p.y(), p.z());
  };
  return boost::make_function_property_map<Vertex, Predicates::Point_3>(point);
}

// Tells the new faces where they come from.
struct Origin_visitor : PMP::Triangulate_faces::Default_visitor<Mesh>
{
  Origin_map* origin;
  std::uint32_t current = 0;

  explicit Origin_visitor(Origin_map& origin) : origin(&origin) {}
  void before_subface_creations(Face f) { current = (*origin)[f]; }
  void after_subface_created(Face f) { (*origin)[f] = current; }
};

// The face as seen along the coordinate axis that is closest to its normal: a polygon that does not cross itself?
bool is_simple_in_projection(const Mesh& mesh, Face f, const Predicates::Vector_3& normal)
{
  const double x = std::abs(normal.x()), y = std::abs(normal.y()), z = std::abs(normal.z());
  std::vector<Predicates::Point_2> polygon;
  for(Vertex v : mesh.vertices_around_face(mesh.halfedge(f)))
  {
    const Kernel::Point_3& p = mesh.point(v);
    polygon.push_back(z >= x && z >= y ? Predicates::Point_2(p.x(), p.y())
                      : y >= x ? Predicates::Point_2(p.z(), p.x()) : Predicates::Point_2(p.y(), p.z()));
  }
  return CGAL::is_simple_2(polygon.begin(), polygon.end(), Predicates());
}

// A face that CGAL does not divide, because it has no normal: all ways to divide it are as good.
void divide_into_fan(Mesh& mesh, Face f, Origin_visitor visitor)
{
  visitor.before_subface_creations(f);
  const Halfedge h = mesh.halfedge(f);
  while(! CGAL::is_triangle(h, mesh))
  {
    const Halfedge last = mesh.next(mesh.next(h));
    CGAL::Euler::split_face(h, last, mesh);
    visitor.after_subface_created(mesh.face(last));
  }
  visitor.after_subface_created(mesh.face(h));
}

// The constrained Delaunay triangulation where the face is a simple polygon, as seen along its normal; otherwise one that is as flat as possible.
void triangulate(Mesh& mesh, Face f, Origin_visitor visitor)
{
  const auto points = points_of(mesh);
  const auto np = CGAL::parameters::vertex_point_map(points).geom_traits(Predicates()).visitor(visitor);
  const bool is_simple = mesh.degree(f) == 4 || is_simple_in_projection(mesh, f,
    PMP::compute_face_normal(f, mesh, CGAL::parameters::vertex_point_map(points).geom_traits(Predicates())));
  if(is_simple && PMP::triangulate_face(f, mesh, np))
    return;
  if(! PMP::triangulate_face(f, mesh, np.use_delaunay_triangulation(false)))
    divide_into_fan(mesh, f, visitor);
}

} // namespace

std::vector<std::uint32_t> triangulate_faces(Mesh& mesh)
{
  Origin_map origin = mesh.add_property_map<Face, std::uint32_t>("f:origin").first;
  std::vector<Face> polygons;
  for(Face f : mesh.faces())
  {
    origin[f] = static_cast<std::uint32_t>(f.idx());
    if(mesh.degree(f) > 3)
      polygons.push_back(f);
  }
  for(Face f : polygons)
    triangulate(mesh, f, Origin_visitor(origin));
  mesh.collect_garbage();

  std::vector<std::uint32_t> result;
  for(Face f : mesh.faces())
    result.push_back(origin[f]);
  mesh.remove_property_map(origin);
  return result;
}

} // namespace flattening
