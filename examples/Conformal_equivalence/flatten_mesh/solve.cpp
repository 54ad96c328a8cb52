// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/solve.h"
#include "../include/flatten_mesh/doors.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/Stopwatch.h"

#include <iostream>
#include <ostream>
#include <string>

#if defined(__unix__) || defined(__APPLE__)
#  include <unistd.h>
#endif

namespace flattening {

namespace {

// What is known of the cones since they were placed.
void take_over_placement(const Report& placement, Report& report)
{
  report.flattened_cones = placement.flattened_cones;
  for(auto& cone : report.cones)
    for(const auto& placed : placement.cones)
      if(cone.vertex == placed.vertex)
        cone.free_angle = placed.free_angle;
}

} // namespace

bool is_terminal(const std::ostream& err)
{
#if defined(__unix__) || defined(__APPLE__)
  return &err == &std::cerr && isatty(STDERR_FILENO);
#else
  return false;
#endif
}

void Progress_visitor::on_stage(CE::Stage stage)
{
  static const char* names[] = { "importing", "solving", "cutting", "laying out", "verifying" };
  progress->show(names[static_cast<int>(stage)]);
}

void Progress_visitor::on_iteration(std::size_t iteration, double residual)
{
  progress->show(text("solving: Newton step ", iteration, ", residual ", residual));
}

Report flatten(const Options& options, const Conditions& conditions, Results& results, Progress& progress)
{
  const bool is_precise = options.precision_in_bits > bits_of_double;
  if(options.target == Target::SPHERE)
    return is_precise ? map_to_sphere_precisely(options, results, progress) : map_to_sphere(options, results, progress);
  if(options.target == Target::DISK)
    return is_precise ? map_to_disk_precisely(options, results, progress) : map_to_disk(options, results, progress);
  if(options.seamless)
    return flatten_seamlessly(options, conditions, results, progress);
  Report placement;
  if(options.places_cones)
  {
    const Stopwatch watch;
    progress.show("placing cones");
    placement = place_cones(options, conditions, results, progress);
    results.placing_seconds = watch.seconds();
    if(! placement)
      return placement;
  }
  if(options.local_repair)
    return flatten_repaired(options, conditions, results, progress);
  if(is_precise)
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
