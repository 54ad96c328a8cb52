// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// How the functions of the package are called that make seamless layouts.

#ifndef FLATTEN_MESH_SEAMLESS_DOOR_H
#define FLATTEN_MESH_SEAMLESS_DOOR_H

#include "conditions.h"
#include "door_parameters.h"
#include "options.h"
#include "Progress.h"
#include "results.h"
#include "Stopwatch.h"

#include <CGAL/Conformal_equivalence/Statistics.h>

#include <algorithm>

namespace flattening {

// Calls `door(np)`, with the named parameters for cones that are given, or to be placed.
template <typename SeamlessDoor>
Report call_seamless_door(const Options& options, const Conditions& conditions, Results& results, Progress& progress, const SeamlessDoor& door)
{
  Progress_visitor visitor(progress);
  const Stopwatch watch;
  const auto tiling = tiling_parameters(options, results, visitor).edge_is_constrained_map(conditions.is_diagonal)
                                                                            .loop_turnings(conditions.loops);
  const Report report = options.places_cones ? door(tiling)
                                             : door(tiling.cone_angle_map(conditions.cone_angle)
                                                          .border_angle_map(conditions.border_angle)
                                                          .vertex_is_constrained_map(conditions.is_constrained)
                                                          .prescribed_log_scale_factor_map(conditions.u));
  const CE::Statistics::Seconds& s = report.statistics.seconds;
  if(options.places_cones) // what is counted nowhere else
    results.placing_seconds = (std::max)(0., watch.seconds() - (s.import + s.solve + s.cut + s.layout + s.verify));
  return report;
}

} // namespace flattening

#endif // FLATTEN_MESH_SEAMLESS_DOOR_H
