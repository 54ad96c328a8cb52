// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The maps to the sphere and to the disk, in double.

#include "../include/flatten_mesh/doors.h"
#include "../include/flatten_mesh/door_parameters.h"
#include "../include/flatten_mesh/inscribe.h"
#include "../include/flatten_mesh/messages.h"

#include <CGAL/Conformal_equivalence/map_to_disk.h>
#include <CGAL/Conformal_equivalence/map_to_sphere.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace flattening {

namespace {

// The vertex number `i`, which has a face.
Vertex given_vertex(const char* option, std::size_t i, const Mesh& mesh)
{
  if(i >= mesh.number_of_vertices())
    fail(option, ": there is no vertex ", i, "; the mesh has ", mesh.number_of_vertices(), " vertices");
  const Vertex v(static_cast<Mesh::size_type>(i));
  if(mesh.is_isolated(v))
    fail(option, ": vertex ", i, " is isolated");
  return v;
}

Vertex given_vertex(const char* option, std::size_t i, bool is_for_border, const Mesh& mesh)
{
  const Vertex v = given_vertex(option, i, mesh);
  if(is_on_border(mesh, v) != is_for_border)
    fail(option, ": vertex ", i, is_for_border ? " is not on the border" : " is on the border");
  return v;
}

} // namespace

Vertex given_vertex_at_infinity(const Options& options, const Mesh& mesh)
{
  const char* name = "--vertex-at-infinity";
  if(! options.vertex_at_infinity)
    return Mesh::null_vertex();
  return options.target == Target::DISK ? given_vertex(name, *options.vertex_at_infinity, true, mesh)
                                        : given_vertex(name, *options.vertex_at_infinity, mesh);
}

Vertex given_disk_centre(const Options& options, const Mesh& mesh)
{
  return given_vertex("--disk-centre", *options.disk_centre, false, mesh);
}

// Three border vertices, counterclockwise.
std::array<Vertex, 3> given_disk_points(const Options& options, const Mesh& mesh)
{
  const std::array<std::size_t, 3>& indices = *options.disk_points;
  std::array<Vertex, 3> points;
  for(std::size_t k = 0; k < 3; ++k)
    points[k] = given_vertex("--disk-points", indices[k], true, mesh);
  const std::vector<Halfedge> border = border_cycle(mesh, border_halfedge_to(mesh, points[0])); // which is clockwise
  const auto place = [&](Vertex v)
    { return std::find_if(border.begin(), border.end(), [&](Halfedge h) { return mesh.target(h) == v; }) - border.begin(); };
  for(std::size_t k = 1; k < 3; ++k)
    if(place(points[k]) == std::ptrdiff_t(border.size()))
      fail("--disk-points: vertex ", indices[k], " is not on the same border as vertex ", indices[0]);
  if(place(points[1]) < place(points[2]))
    fail("--disk-points: the vertices are given clockwise; counterclockwise: ", indices[0], ',', indices[2], ',', indices[1]);
  return points;
}

void check_vertices_of_image(const Options& options, const Mesh& mesh, const Components& components)
{
  given_vertex_at_infinity(options, mesh);
  if(options.disk_centre)
    given_disk_centre(options, mesh);
  if(! options.disk_points)
    return;
  for(std::size_t k = 0; k < 3; ++k)
    given_vertex("--disk-points", (*options.disk_points)[k], true, mesh);
  const auto component = [&](std::size_t k) { return components.of_vertex(Vertex(static_cast<Mesh::size_type>((*options.disk_points)[k]))); };
  for(std::size_t k = 1; k < 3; ++k)
    if(component(k) != component(0))
      fail("--disk-points: vertex ", (*options.disk_points)[k], " is not on the component of vertex ", (*options.disk_points)[0]);
  given_disk_points(options, mesh);
}

Report map_to_sphere(const Options& options, Results& results, Progress& progress)
{
  Progress_visitor visitor(progress);
  Result& given = results.given;
  CE::Spherical_refinement<double> found;
  const Report report = CE::map_to_sphere(given.mesh, make_image_map(given.mesh, given.image),
    image_parameters(options, results, visitor).spherical_refinement(std::ref(found)));
  results.refinement = parts_without_layout(found);
  results.made.image = std::move(found.points);
  if(report.statistics.number_of_flips == 0)
    results.refinement = Refinement(); // it is a copy of the mesh
  return report;
}

Report map_to_disk(const Options& options, Results& results, Progress& progress)
{
  Progress_visitor visitor(progress);
  Result& given = results.given;
  const auto np = image_parameters(options, results, visitor).common_refinement(std::ref(results.refinement));
  const Report report = map_with_disk_frame(options, given.mesh, np, [&](const auto& all)
    { return CE::map_to_disk(given.mesh, make_image_map(given.mesh, given.image), all); });
  for(Halfedge h : given.mesh.halfedges())
  {
    const Space_point& p = given.image[given.mesh.target(h).idx()];
    given.uv[h] = Kernel::Point_2(p[0], p[1]);
  }
  return report;
}

} // namespace flattening
