// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/doors.h"
#include "../include/flatten_mesh/door_parameters.h"

#include <CGAL/Conformal_equivalence/place_cones.h>
#include <CGAL/number_utils.h>

namespace flattening {

bool is_best_so_far(const Report& placement)
{
  return placement.status == CE::Status::STOPPED_BY_VISITOR && ! placement.cones.empty();
}

Report place_cones(const Options& options, const Conditions& conditions, Results& results, Progress& progress)
{
  Progress_visitor visitor(progress);
  const Report report = CE::place_cones(results.given.mesh, conditions.cone_angle,
                                        placement_parameters(options, results, visitor));
  if((report || is_best_so_far(report)) && options.quanta_of_turn == 0)
    for(const auto& cone : report.cones)
    {
      conditions.cone_angle[cone.vertex] = 2 * CGAL_PI;
      conditions.is_constrained[cone.vertex] = true;
      conditions.u[cone.vertex] = results.given.u[cone.vertex]; // which has the angle found
    }
  return report;
}

} // namespace flattening
