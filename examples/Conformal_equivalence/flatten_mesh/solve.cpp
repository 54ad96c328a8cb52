// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/solve.h"
#include "../include/flatten_mesh/Components.h"
#include "../include/flatten_mesh/doors.h"
#include "../include/flatten_mesh/each_component.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/side_by_side.h"
#include "../include/flatten_mesh/Stopwatch.h"

#include <cstddef>
#include <string>
#include <unordered_map>

namespace flattening {

namespace {

// What is known of the cones since they were placed.
void take_over_placement(const Report& placement, Report& report)
{
  report.flattened_cones = placement.flattened_cones;
  std::unordered_map<std::size_t, double> free_angle;
  for(const auto& placed : placement.cones)
    free_angle.emplace(placed.vertex.idx(), placed.free_angle);
  for(auto& cone : report.cones)
  {
    const auto found = free_angle.find(cone.vertex.idx());
    if(found != free_angle.end())
      cone.free_angle = found->second;
  }
}

bool is_precise(const Options& options) { return options.precision_in_bits > bits_of_double; }

// What there is for one component only.
Report map_component(const Options& options, const Conditions& conditions, Results& results, Progress& progress)
{
  if(options.target == Target::SPHERE)
    return is_precise(options) ? map_to_sphere_precisely(options, results, progress) : map_to_sphere(options, results, progress);
  if(options.target == Target::DISK)
    return is_precise(options) ? map_to_disk_precisely(options, results, progress) : map_to_disk(options, results, progress);
  return options.refine ? flatten_refined_seamlessly(options, conditions, results, progress)
                        : flatten_seamlessly(options, conditions, results, progress);
}

Report place_cones_on_component(const Options& options, const Conditions& conditions, Results& results, Progress& progress)
{
  return options.places_cones ? place_cones(options, conditions, results, progress) : Report(); // there may be no place for a cone
}

// If there are several components, each is mapped by itself, and they are put beside one another.
Report for_each_component(const Options& options, const Conditions& conditions, Results& results, Progress& progress, const Door& door)
{
  const Components components(results.given.mesh);
  if(components.size() < 2)
    return door(options, conditions, results, progress);
  if(options.seamless && options.refine)
    fail(options.input, ": --seamless --refine takes a surface of one component, and this one has ", components.size());
  check_vertices_of_image(options, results.given.mesh, components);
  Report report = map_each_component(components, options, conditions, results, progress, door);
  if(report && options.seamless)
    place_tilings_side_by_side(components, results, report);
  return report;
}

} // namespace

Report flatten(const Options& options, const Conditions& conditions, Results& results, Progress& progress)
{
  if(options.target != Target::PLANE || options.seamless)
    return for_each_component(options, conditions, results, progress, map_component);
  Report placement;
  if(options.places_cones)
  {
    const Stopwatch watch;
    placement = for_each_component(options, conditions, results, progress, place_cones_on_component);
    results.placing_seconds = watch.seconds();
    results.is_search_stopped = is_best_so_far(placement);
    results.is_search_futile = placement.status == CE::Status::STOPPED_BY_VISITOR && ! results.is_search_stopped;
    if(results.is_search_stopped)
      heed_interrupt(); // what is left to do is done with these cones
    else if(! placement)
      return placement;
  }
  if(options.local_repair)
    return flatten_repaired(options, conditions, results, progress);
  if(is_precise(options))
    return flatten_precisely(options, conditions, results, progress);
  Report report = flatten_in_the_plane(options, conditions, results, progress);
  take_over_placement(placement, report);
  return report;
}

bool is_refinement_needed(const Options& options, const Report& report, const Refinement& refinement)
{
  return refinement.number_of_faces() != 0
      && (options.refine || options.projective || ! report.bent_faces.empty() || ! report.flat_faces.empty()
          || (options.target == Target::DISK && ! report.lost_border_edges.empty()));
}

} // namespace flattening
