// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Seamless layouts with --refine.

#include "../include/flatten_mesh/doors.h"
#include "../include/flatten_mesh/seamless.h"
#include "../include/flatten_mesh/seamless_door.h"

#include <CGAL/Conformal_equivalence/compute_refined_seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/squared_distance_3.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace flattening {

namespace {

// ---- u of crossings

// Whether the halfedge lies on an edge of the mesh given.
bool is_on_given_edge(const Result& refined, Halfedge h)
{
  const Halfedge o = refined.mesh.opposite(h);
  return refined.mesh.is_border(o) || refined.given_face[refined.mesh.face(h).idx()] != refined.given_face[refined.mesh.face(o).idx()];
}

// The next one around the triangle of which the face of `h`, on whose border `h` is, is part.
Halfedge next_around_given_face(const Result& refined, Halfedge h)
{
  for(h = refined.mesh.next(h); ! is_on_given_edge(refined, h);)
    h = refined.mesh.next(refined.mesh.opposite(h));
  return h;
}

double distance(const Mesh& mesh, Vertex v, Vertex w) { return std::sqrt(CGAL::squared_distance(mesh.point(v), mesh.point(w))); }

// Of the crossings on an edge given, which begins with `h`. A seamless layout is not conformal, and crossings have no scale factor of their own.
void interpolate_u_along_edge(std::size_t number_of_given_vertices, Halfedge h, Result& refined)
{
  const Mesh& mesh = refined.mesh;
  const Vertex from = mesh.source(h);
  std::vector<Vertex> crossings;
  for(; mesh.target(h).idx() >= number_of_given_vertices; h = next_around_given_face(refined, h)) // until a corner of the triangle
    crossings.push_back(mesh.target(h));
  const Vertex to = mesh.target(h);
  const double length = distance(mesh, from, to);
  for(Vertex v : crossings)
  {
    const double t = length > 0 ? distance(mesh, from, v) / length : 0.5;
    refined.u[v] = (1 - t) * refined.u[from] + t * refined.u[to];
  }
}

void find_u_of_refined_mesh(const Result& given, Result& refined)
{
  for(Vertex v : given.mesh.vertices())
    refined.u[v] = given.u[v];
  const std::size_t n = given.mesh.number_of_vertices();
  for(Halfedge h : refined.mesh.halfedges())
    if(! refined.mesh.is_border(h) && refined.mesh.source(h).idx() < n && is_on_given_edge(refined, h))
      interpolate_u_along_edge(n, h, refined);
}

// ---- Without crossings

Halfedge halfedge_to(const Mesh& mesh, Face f, Vertex v)
{
  Halfedge h = mesh.halfedge(f);
  for(std::size_t k = 0; k < 2 && mesh.target(h) != v; ++k)
    h = mesh.next(h);
  return h;
}

// The faces made are those given, in another order: the layout is taken over, and nothing was made.
void take_over_layout(Results& results)
{
  Result &given = results.given, &made = results.made;
  for(Halfedge h : made.mesh.halfedges())
    if(! made.mesh.is_border(h))
    {
      const Face f(static_cast<Mesh::size_type>(made.given_face[made.mesh.face(h).idx()]));
      given.uv[halfedge_to(given.mesh, f, made.mesh.target(h))] = made.uv[h];
    }
  for(Halfedge h : given.mesh.halfedges())
    if(given.mesh.is_border(h))
      given.uv[h] = given.uv[given.mesh.prev(given.mesh.opposite(h))];
  made.given_face.clear();
  made.mesh.clear_without_removing_property_maps();
}

} // namespace

Report flatten_refined_seamlessly(const Options& options, const Conditions& conditions, Results& results, Progress& progress)
{
  Result &given = results.given, &made = results.made;
  const auto input_face = made.mesh.add_property_map<Face, Face>("f:input_face").first;
  const Report report = call_seamless_door(options, conditions, results, progress, [&](const auto& np)
  {
    return CE::compute_refined_seamless_parameterization(given.mesh, made.mesh, made.uv, np, CGAL::parameters::input_face_map(input_face));
  });
  if(! report)
    return report;
  for(Face f : made.mesh.faces())
    made.given_face.push_back(input_face[f].idx());
  const bool has_crossings = made.mesh.number_of_vertices() != given.mesh.number_of_vertices();
  if(has_crossings)
    find_u_of_refined_mesh(given, made);
  else
    take_over_layout(results);
  if(options.lattice_coordinates)
    keep_lattice_coordinates(static_cast<int>(options.quanta_of_turn), has_crossings ? made : given);
  return report;
}

} // namespace flattening
