// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_CONDITIONS_H
#define FLATTEN_MESH_CONDITIONS_H

#include "mesh.h"
#include "messages.h"
#include "options.h"
#include "Scanner.h"

#include <CGAL/Conformal_equivalence/boundary_conditions.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/Status.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace flattening {

// What is prescribed at each border vertex: its angle sum, or u if it is constrained.
struct Conditions
{
  Vertex_map<double> angle, u;
  Vertex_map<bool> is_constrained;

  // u = 0 on the border: it keeps its lengths
  explicit Conditions(Mesh& mesh)
    : angle(mesh.add_property_map<Vertex, double>("v:angle", CGAL_PI).first),
      u(mesh.add_property_map<Vertex, double>("v:prescribed_u", 0.).first),
      is_constrained(mesh.add_property_map<Vertex, bool>("v:is_constrained", false).first)
  {
    for(Halfedge h : mesh.halfedges())
      if(mesh.is_border(h))
        is_constrained[mesh.target(h)] = true;
  }
};

// Calls `use(vertex, value)` for each line "vertex-index value" of the file; # begins
// a comment. Each vertex is on the border and is named once, in `is_named`.
template <typename Use>
void read_condition_file(const std::string& file, const Mesh& mesh, std::vector<bool>& is_named, Use use)
{
  const std::string content = read_file(file);
  Scanner in(content, file, '#');
  for(; ! in.at_end(); in.skip_line())
  {
    const std::int64_t i = in.integer_in_line();
    const double value = in.number_in_line();
    if(! in.at_end_of_line())
      in.error("expected only a vertex and a number");
    if(i < 0 || static_cast<std::size_t>(i) >= mesh.number_of_vertices())
      in.error("there is no vertex ", i, "; the mesh has ", mesh.number_of_vertices(), " vertices");
    const std::size_t v = static_cast<std::size_t>(i);
    if(! is_on_border(mesh, v))
      in.error("vertex ", i, " is not on the border");
    if(is_named[v])
      in.error("vertex ", i, " has a condition already");
    if(! std::isfinite(value))
      in.error("vertex ", i, ": ", value, " is not a finite number");
    is_named[v] = true;
    use(in, Vertex(static_cast<Mesh::size_type>(v)), value);
  }
}

inline void read_conditions(const Options& options, const Mesh& mesh, Conditions& conditions)
{
  std::vector<bool> is_named(mesh.number_of_vertices(), false);
  if(! options.angle_file.empty())
    read_condition_file(options.angle_file, mesh, is_named, [&](const Scanner& in, Vertex v, double degrees)
    {
      if(! (degrees > 0))
        in.error("the angle at vertex ", v.idx(), " must be positive");
      conditions.angle[v] = degrees / 180 * CGAL_PI;
      conditions.is_constrained[v] = false;
    });
  if(! options.scale_file.empty())
    read_condition_file(options.scale_file, mesh, is_named, [&](const Scanner&, Vertex v, double u)
    {
      conditions.u[v] = u;
    });
}

inline std::array<Vertex, 4> given_corners(const std::array<std::size_t, 4>& indices, const Mesh& mesh)
{
  std::array<Vertex, 4> corners;
  for(std::size_t k = 0; k < 4; ++k)
  {
    if(indices[k] >= mesh.number_of_vertices())
      fail("--boundary rectangle: there is no vertex ", indices[k], "; the mesh has ", mesh.number_of_vertices(), " vertices");
    if(! is_on_border(mesh, indices[k]))
      fail("--boundary rectangle: vertex ", indices[k], " is not on the border");
    corners[k] = Vertex(static_cast<Mesh::size_type>(indices[k]));
  }
  return corners;
}

inline std::array<Vertex, 4> chosen_corners(const std::string& file, const Mesh& mesh, Halfedge bhd)
{
  CE::Flattening_report<Mesh> report;
  const std::array<Vertex, 4> corners =
    CE::select_rectangle_corners(mesh, bhd, CGAL::parameters::flattening_report(std::ref(report)));
  if(! report)
    fail(file, ": no corners for a rectangle are found: ", CE::message(report));
  return corners;
}

// The border halfedges in their order.
inline std::vector<Halfedge> border(const Mesh& mesh)
{
  std::vector<Halfedge> cycle;
  for(Halfedge h : mesh.halfedges())
    if(mesh.is_border(h))
    {
      const Halfedge first = h;
      do
      {
        cycle.push_back(h);
        h = mesh.next(h);
      }
      while(h != first);
      break;
    }
  return cycle;
}

inline void prescribe_a_rectangle(const Options& options, const Mesh& mesh, Conditions& conditions)
{
  const std::vector<Halfedge> cycle = border(mesh);
  if(cycle.size() < 4)
    fail(options.input, ": a rectangle needs at least 4 border vertices, there are ", cycle.size());
  const std::array<Vertex, 4> corners = options.corners
    ? given_corners(*options.corners, mesh)
    : chosen_corners(options.input, mesh, cycle.front());
  CE::prescribe_rectangle(mesh, corners, conditions.angle);
  for(Halfedge h : cycle)
    conditions.is_constrained[mesh.target(h)] = false;
}

inline void set_conditions(const Options& options, const Mesh& mesh, Conditions& conditions)
{
  if(options.is_rectangle)
    prescribe_a_rectangle(options, mesh, conditions);
  else
    read_conditions(options, mesh, conditions);
}

} // namespace flattening

#endif // FLATTEN_MESH_CONDITIONS_H
