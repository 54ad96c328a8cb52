// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// With --target sphere or disk: the map, by the library, and the vertices that steer it.

#ifndef FLATTEN_MESH_INSCRIBE_H
#define FLATTEN_MESH_INSCRIBE_H

#include "mesh.h"
#include "messages.h"
#include "options.h"
#include "precision.h"
#include "results.h"

#include <CGAL/Conformal_equivalence/map_to_disk.h>
#include <CGAL/Conformal_equivalence/map_to_sphere.h>
#include <CGAL/Conformal_equivalence/multiprecision.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace flattening {

// ---- The vertices given

// The vertex number `i`, which has a face.
inline Vertex given_vertex(const char* option, std::size_t i, const Mesh& mesh)
{
  if(i >= mesh.number_of_vertices())
    fail(option, ": there is no vertex ", i, "; the mesh has ", mesh.number_of_vertices(), " vertices");
  const Vertex v(static_cast<Mesh::size_type>(i));
  if(mesh.is_isolated(v))
    fail(option, ": vertex ", i, " is isolated");
  return v;
}

inline Vertex given_vertex(const char* option, std::size_t i, bool is_for_border, const Mesh& mesh)
{
  const Vertex v = given_vertex(option, i, mesh);
  if(is_on_border(mesh, v) != is_for_border)
    fail(option, ": vertex ", i, is_for_border ? " is not on the border" : " is on the border");
  return v;
}

// Three border vertices, counterclockwise.
inline std::array<Vertex, 3> given_disk_points(const std::array<std::size_t, 3>& indices, const Mesh& mesh)
{
  std::array<Vertex, 3> points;
  for(std::size_t k = 0; k < 3; ++k)
    points[k] = given_vertex("--disk-points", indices[k], true, mesh);
  const std::vector<Halfedge> border = border_cycle(mesh, border_halfedge_to(mesh, points[0])); // which is clockwise
  const auto place = [&](Vertex v)
    { return std::find_if(border.begin(), border.end(), [&](Halfedge h) { return mesh.target(h) == v; }) - border.begin(); };
  if(place(points[1]) < place(points[2]))
    fail("--disk-points: the vertices are given clockwise; counterclockwise: ", indices[0], ',', indices[2], ',', indices[1]);
  return points;
}

// ---- Points

typedef std::array<double, 3>                      Space_point;
typedef std::array<CE::Multiprecision_number, 3>   Wide_space_point;

inline Space_point rounded(const Wide_space_point& p)
{
  return {{ static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]) }};
}

template <typename NT>
std::array<NT, 3> origin() { return {{ NT(0), NT(0), NT(0) }}; }

// Receives points of the disk, or of the sphere, by vertex.
template <typename NT>
struct Image_map
{
  typedef boost::writable_property_map_tag category;
  typedef Vertex key_type;
  struct value_type
  {
    std::array<NT, 3> point;
    value_type(const NT& x, const NT& y) : point{{ x, y, NT(0) }} {}
    value_type(const NT& x, const NT& y, const NT& z) : point{{ x, y, z }} {}
  };
  typedef value_type reference;

  std::vector<std::array<NT, 3> >* points;

  friend void put(const Image_map& map, Vertex v, const value_type& p) { (*map.points)[v.idx()] = p.point; }
};

template <typename NT>
Image_map<NT> make_image_map(const Mesh& mesh, std::vector<std::array<NT, 3> >& points)
{
  points.assign(mesh.number_of_vertices(), origin<NT>());
  return { &points };
}

inline std::vector<Space_point> rounded(const std::vector<Wide_space_point>& points)
{
  std::vector<Space_point> result;
  for(const Wide_space_point& p : points)
    result.push_back(rounded(p));
  return result;
}

// ---- The sphere

// Faces of the refinement are drawn on the sphere only.
template <typename NT>
CE::Common_refinement<NT> parts_without_layout(CE::Spherical_refinement<NT>& found)
{
  CE::Common_refinement<NT> parts = std::move(found.parts);
  parts.corner_uv.assign(parts.corner_vertex.size(), {{ NT(0), NT(0) }});
  return parts;
}

template <typename NamedParameters>
Report inscribe_in_sphere(const Options& options, Results& results, const NamedParameters& np)
{
  Result& given = results.given;
  Report report;
  if(options.precision_in_bits == bits_of_double)
  {
    CE::Spherical_refinement<double> found;
    report = CE::map_to_sphere(given.mesh, make_image_map(given.mesh, given.image), np.spherical_refinement(std::ref(found)));
    results.refinement = parts_without_layout(found);
    results.made.image = std::move(found.points);
  }
  else
  {
    CE::Spherical_refinement<CE::Multiprecision_number> found;
    report = CE::map_to_sphere<CE::Multiprecision_number>(given.mesh, make_image_map(given.mesh, given.wide_image),
                                                          np.spherical_refinement(std::ref(found)));
    results.refinement = rounded(parts_without_layout(found));
    results.made.wide_image = std::move(found.points);
    given.image = rounded(given.wide_image);
    results.made.image = rounded(results.made.wide_image);
  }
  if(report.statistics.number_of_flips == 0)
    results.refinement = Refinement(); // it is a copy of the mesh
  return report;
}

// ---- The disk

inline Kernel::Point_2 plane_point(const Space_point& p) { return Kernel::Point_2(p[0], p[1]); }
inline Wide_point plane_point(const Wide_space_point& p) { return Wide_point(p[0], p[1]); }

template <typename Points, typename UVMap>
void copy_to_corners(const Mesh& mesh, const Points& points, UVMap uv)
{
  for(Halfedge h : mesh.halfedges())
    uv[h] = plane_point(points[mesh.target(h).idx()]);
}

template <typename NamedParameters>
Report inscribe_in_disk(const Options& options, Results& results, const NamedParameters& np)
{
  Result& given = results.given;
  if(options.precision_in_bits == bits_of_double)
  {
    const Report report = CE::map_to_disk(given.mesh, make_image_map(given.mesh, given.image),
                                          np.common_refinement(std::ref(results.refinement)));
    copy_to_corners(given.mesh, given.image, given.uv);
    return report;
  }
  use_wide_points(given.mesh, given.wide);
  const Report report = CE::map_to_disk<CE::Multiprecision_number>(given.mesh, make_image_map(given.mesh, given.wide_image),
                                                                   np.common_refinement(std::ref(given.wide.refinement)));
  copy_to_corners(given.mesh, given.wide_image, given.wide.uv);
  given.image = rounded(given.wide_image);
  round_layout(given.mesh, given.wide, given.uv, results.refinement);
  return report;
}

// Of a refinement, which knows points by corners.
inline void find_image_of_corners(Result& refined)
{
  refined.image.assign(refined.mesh.number_of_vertices(), origin<double>());
  if(refined.wide.is_used)
    refined.wide_image.assign(refined.mesh.number_of_vertices(), origin<CE::Multiprecision_number>());
  for(Halfedge h : refined.mesh.halfedges())
  {
    if(refined.mesh.is_border(h))
      continue;
    const std::size_t v = refined.mesh.target(h).idx();
    refined.image[v] = {{ refined.uv[h].x(), refined.uv[h].y(), 0 }};
    if(refined.wide.is_used)
      refined.wide_image[v] = {{ refined.wide.uv[h].x(), refined.wide.uv[h].y(), CE::Multiprecision_number(0) }};
  }
}

// ---- Both

template <typename NamedParameters>
Report inscribe_in_frame(const Options& options, Results& results, const NamedParameters& np)
{
  const Mesh& mesh = results.given.mesh;
  if(options.target == Target::SPHERE)
    return inscribe_in_sphere(options, results, np);
  if(options.disk_centre)
    return inscribe_in_disk(options, results, np.disk_frame(
      CE::Centred_disk_frame<Vertex>{given_vertex("--disk-centre", *options.disk_centre, false, mesh)}));
  if(options.disk_points)
    return inscribe_in_disk(options, results, np.disk_frame(
      CE::Three_point_disk_frame<Vertex>{given_disk_points(*options.disk_points, mesh)}));
  return inscribe_in_disk(options, results, np);
}

// The map to the sphere or to the disk. Parameters: those that all maps have.
template <typename NamedParameters>
Report inscribe(const Options& options, Results& results, const NamedParameters& np)
{
  const auto all = np.moebius_weights(options.moebius_weights);
  if(! options.vertex_at_infinity)
    return inscribe_in_frame(options, results, all);
  const char* name = "--vertex-at-infinity";
  const Mesh& mesh = results.given.mesh;
  return inscribe_in_frame(options, results, all.vertex_at_infinity(options.target == Target::DISK
    ? given_vertex(name, *options.vertex_at_infinity, true, mesh) : given_vertex(name, *options.vertex_at_infinity, mesh)));
}

} // namespace flattening

#endif // FLATTEN_MESH_INSCRIBE_H
