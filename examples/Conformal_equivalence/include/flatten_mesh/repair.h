// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// With --local-repair a copy of the mesh is flattened, with edges flipped or split where triangles break.

#ifndef FLATTEN_MESH_REPAIR_H
#define FLATTEN_MESH_REPAIR_H

#include "mesh.h"
#include "results.h"

#include <CGAL/Conformal_equivalence/flatten_repaired.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <algorithm>

namespace flattening {

// As `CE::flatten()` with the same parameters; the mesh of `repaired` is made.
template <typename NamedParameters>
Report flatten_repaired(Result& given, Result& repaired, Repair_figures& figures, const NamedParameters& np)
{
  const auto report = CE::flatten_repaired(given.mesh, repaired.mesh, repaired.uv, np,
                                           CGAL::parameters::log_scale_factor_map(repaired.u).projective_weight_map(repaired.weight));
  for(const auto& change : report.changes)
    ++(change.kind == change.FLIP ? figures.number_of_flips : figures.number_of_splits);
  if(report)
    for(Vertex v : given.mesh.vertices())
      given.u[v] = repaired.u[v]; // the vertices given come first
  Report result = report;
  for(const auto& transition : report.repaired_transitions) // counted only
    result.transitions.push_back({transition.halfedge, transition.rotation, transition.translation});
  return result;
}

} // namespace flattening

#endif // FLATTEN_MESH_REPAIR_H
