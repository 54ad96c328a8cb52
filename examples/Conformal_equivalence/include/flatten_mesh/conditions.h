// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_CONDITIONS_H
#define FLATTEN_MESH_CONDITIONS_H

#include "cones.h"
#include "mesh.h"
#include "messages.h"
#include "options.h"
#include "Scanner.h"

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/boundary_conditions.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/Status.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace flattening {

// What is prescribed at each vertex: its angle sum, or u if it is constrained.
struct Conditions
{
  Vertex_map<double> border_angle, cone_angle, u;
  Vertex_map<bool> is_constrained;

  // u = 0 on all borders: they keep their lengths; no cones
  explicit Conditions(Mesh& mesh)
    : border_angle(mesh.add_property_map<Vertex, double>("v:border_angle", CGAL_PI).first),
      cone_angle(mesh.add_property_map<Vertex, double>("v:cone_angle", 2 * CGAL_PI).first),
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
    const Vertex v = read_vertex(in, mesh);
    const double value = in.number_in_line();
    if(! in.at_end_of_line())
      in.error("expected only a vertex and a number");
    if(! is_on_border(mesh, v))
      in.error("vertex ", v.idx(), " is not on the border");
    if(is_named[v])
      in.error("vertex ", v.idx(), " has a condition already");
    if(! std::isfinite(value))
      in.error("vertex ", v.idx(), ": ", value, " is not a finite number");
    is_named[v] = true;
    use(in, v, value);
  }
}

inline void read_border_conditions(const Options& options, const Mesh& mesh, Conditions& conditions)
{
  std::vector<bool> is_named(mesh.number_of_vertices(), false);
  if(! options.angle_file.empty())
    read_condition_file(options.angle_file, mesh, is_named, [&](const Scanner& in, Vertex v, double degrees)
    {
      if(! (degrees > 0))
        in.error("the angle at vertex ", v.idx(), " must be positive");
      conditions.border_angle[v] = degrees / 180 * CGAL_PI;
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
    corners[k] = Vertex(static_cast<Mesh::size_type>(indices[k]));
    if(! is_on_border(mesh, corners[k]))
      fail("--boundary rectangle: vertex ", indices[k], " is not on the border");
  }
  return corners;
}

// All corners are on the border of the first.
inline void require_one_border(const std::array<Vertex, 4>& corners, const Mesh& mesh, const std::vector<Halfedge>& border)
{
  for(Vertex v : corners)
    if(std::none_of(border.begin(), border.end(), [&](Halfedge h) { return mesh.target(h) == v; }))
      fail("--boundary rectangle: vertex ", v.idx(), " is not on the same border as vertex ", corners[0].idx());
}

// Corners are chosen for disks only.
inline std::array<Vertex, 4> chosen_corners(const std::string& file, const Mesh& mesh)
{
  const Halfedge bhd = first_border_halfedge(mesh);
  if(bhd == Mesh::null_halfedge())
    fail(file, ": a rectangle needs a border, the mesh is closed");
  CE::Flattening_report<Mesh> report;
  const std::array<Vertex, 4> corners =
    CE::select_rectangle_corners(mesh, bhd, CGAL::parameters::flattening_report(std::ref(report)));
  if(report.status == CE::Status::MISSING_CONDITION)
    fail(file, ": a rectangle needs at least 4 border vertices, there are ", border_cycle(mesh, bhd).size());
  if(! report)
    fail(file, ": no corners for a rectangle are found: ", CE::message(report),
         report.status == CE::Status::WRONG_TOPOLOGY ? " (give them: --boundary rectangle=i,j,k,l)" : "");
  return corners;
}

// On the border of the corners; the others stay natural.
inline void prescribe_a_rectangle(const Options& options, const Mesh& mesh, Conditions& conditions)
{
  const std::array<Vertex, 4> corners = options.corners ? given_corners(*options.corners, mesh)
                                                        : chosen_corners(options.input, mesh);
  const std::vector<Halfedge> border = border_cycle(mesh, border_halfedge_to(mesh, corners[0]));
  require_one_border(corners, mesh, border);
  CE::prescribe_rectangle(mesh, corners, conditions.border_angle);
  for(Halfedge h : border)
    conditions.is_constrained[mesh.target(h)] = false;
}

inline void set_cones(const Options& options, const Mesh& mesh, Conditions& conditions)
{
  read_cone_file(options.cone_file, mesh, options.quanta_of_turn,
                 [&](Vertex v) { conditions.is_constrained[v] = true; },
                 [&](Vertex v, double angle) { conditions.cone_angle[v] = angle; });
}

inline void set_conditions(const Options& options, const Mesh& mesh, Conditions& conditions)
{
  if(! options.cone_file.empty())
    set_cones(options, mesh, conditions);
  if(options.is_rectangle)
    prescribe_a_rectangle(options, mesh, conditions);
  else
    read_border_conditions(options, mesh, conditions);
}

} // namespace flattening

#endif // FLATTEN_MESH_CONDITIONS_H
