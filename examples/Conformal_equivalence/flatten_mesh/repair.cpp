// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// With --local-repair a copy of the mesh is flattened, with edges flipped or split where triangles break.

#include "../include/flatten_mesh/doors.h"
#include "../include/flatten_mesh/door_parameters.h"

#include <CGAL/Conformal_equivalence/flatten_repaired.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <cstddef>
#include <vector>

namespace flattening {

namespace {

// Flips and splits keep the faces that were there, and add others, each beside the one that it was cut off from: along the
// edge from the face's third vertex to the new one (`Intrinsic_triangulation::split_edge()`), which is the last of its vertices.
std::vector<std::size_t> given_faces(const Mesh& given, const Mesh& repaired)
{
  std::vector<std::size_t> result;
  for(Face f : repaired.faces())
  {
    result.push_back(f.idx());
    if(f.idx() < given.number_of_faces())
      continue;
    Halfedge to_new = repaired.halfedge(f);
    for(Halfedge h : repaired.halfedges_around_face(to_new))
      if(repaired.target(h) > repaired.target(to_new))
        to_new = h;
    const Face beside = repaired.face(repaired.opposite(to_new));
    result.back() = beside != Mesh::null_face() && beside < f ? result[beside.idx()] : 0; // the latter after further changes only
  }
  return result;
}

} // namespace

Report flatten_repaired(const Options& options, const Conditions& conditions, Results& results, Progress& progress)
{
  Progress_visitor visitor(progress);
  Result &given = results.given, &repaired = results.made;
  const auto report = CE::flatten_repaired(given.mesh, repaired.mesh, repaired.uv,
                                           flattening_parameters(options, conditions, results, visitor),
                                           CGAL::parameters::log_scale_factor_map(repaired.u).projective_weight_map(repaired.weight));
  for(const auto& change : report.changes)
    ++(change.kind == change.FLIP ? results.repair.number_of_flips : results.repair.number_of_splits);
  if(report)
  {
    for(Vertex v : given.mesh.vertices())
      given.u[v] = repaired.u[v]; // the vertices given come first
    repaired.given_face = given_faces(given.mesh, repaired.mesh);
  }
  Report result = report;
  for(const auto& transition : report.repaired_transitions) // counted only
    result.transitions.push_back({transition.halfedge, transition.rotation, transition.translation});
  return result;
}

} // namespace flattening
