// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_SOLVE_H
#define FLATTEN_MESH_SOLVE_H

#include "conditions.h"
#include "inscribe.h"
#include "mesh.h"
#include "messages.h"
#include "options.h"
#include "precision.h"
#include "repair.h"
#include "results.h"
#include "seamless.h"
#include "Stopwatch.h"

#include <CGAL/Conformal_equivalence/Eigen_pattern_solver_traits.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>
#include <CGAL/Conformal_equivalence/place_cones.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#  include <unistd.h>
#endif

namespace flattening {

// Shows on a terminal how far the computation is, in one line that is wiped out at the end.
class Progress
{
public:
  Progress(std::ostream& err, bool is_shown) : err_(err), is_shown_(is_shown) {}
  ~Progress() { show(""); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(const std::string& line)
  {
    if(is_shown_)
      err_ << "\r\033[K" << line << std::flush;
  }

private:
  std::ostream& err_;
  bool is_shown_;
};

inline bool is_terminal(const std::ostream& err)
{
#if defined(__unix__) || defined(__APPLE__)
  return &err == &std::cerr && isatty(STDERR_FILENO);
#else
  return false;
#endif
}

struct Progress_visitor : CE::Default_visitor
{
  Progress* progress;

  explicit Progress_visitor(Progress& progress) : progress(&progress) {}

  void on_stage(CE::Stage stage)
  {
    static const char* names[] = { "importing", "solving", "cutting", "laying out", "verifying" };
    progress->show(names[static_cast<int>(stage)]);
  }

  void on_iteration(std::size_t iteration, double residual)
  {
    progress->show(text("solving: Newton step ", iteration, ", residual ", residual));
  }
};

// The parameters of the search for cones.
template <typename NamedParameters>
auto placement_parameters(const Options& options, const NamedParameters& np)
{
  return np.number_of_cones(options.number_of_cones)
           .maximum_log_scale_factor(options.maximum_log_scale_factor)
           .maximum_area_distortion(options.maximum_area_distortion)
           .angle_quantum(options.quanta_of_turn == 0 ? 0. : 2 * CGAL_PI / options.quanta_of_turn);
}

// Looks for the cones, and makes them conditions: angle sums if these were rounded, u = 0 otherwise.
template <typename NamedParameters>
Report place_cones(const Options& options, const Mesh& mesh, const Conditions& conditions, const NamedParameters& np)
{
  const Report report = CE::place_cones(mesh, conditions.cone_angle, placement_parameters(options, np));
  if(report && options.quanta_of_turn == 0)
    for(const auto& cone : report.cones)
    {
      conditions.cone_angle[cone.vertex] = 2 * CGAL_PI;
      conditions.is_constrained[cone.vertex] = true;
    }
  return report;
}

// What is known of the cones since they were placed.
inline void take_over_placement(const Report& placement, Report& report)
{
  report.flattened_cones = placement.flattened_cones;
  for(auto& cone : report.cones)
    for(const auto& placed : placement.cones)
      if(cone.vertex == placed.vertex)
        cone.free_angle = placed.free_angle;
}

// A seamless layout, with cones that are given or to be placed.
template <typename NamedParameters>
Report flatten_seamlessly(const Options& options, const Conditions& conditions, Results& results, const NamedParameters& np)
{
  const Stopwatch watch;
  Result& given = results.given;
  const auto tiling = placement_parameters(options, np)
                        .number_of_tiles(options.number_of_tiles)
                        .maximum_distortion(options.maximum_distortion)
                        .seamless_coordinates(options.lattice_coordinates ? CE::Seamless_coordinates::LATTICE
                                                                          : CE::Seamless_coordinates::CARTESIAN);
  const Report report = options.places_cones
    ? CE::compute_seamless_parameterization(given.mesh, given.uv, tiling)
    : CE::compute_seamless_parameterization(given.mesh, given.uv,
                                            tiling.cone_angle_map(conditions.cone_angle)
                                                  .border_angle_map(conditions.border_angle)
                                                  .vertex_is_constrained_map(conditions.is_constrained)
                                                  .prescribed_log_scale_factor_map(conditions.u));
  const CE::Statistics::Seconds& s = report.statistics.seconds;
  if(options.places_cones) // what is counted nowhere else
    results.placing_seconds = (std::max)(0., watch.seconds() - (s.import + s.solve + s.cut + s.layout + s.verify));
  if(report && options.lattice_coordinates)
    keep_lattice_coordinates(options.quanta_of_turn, given);
  return report;
}

// `common`: the parameters of all doors.
template <typename NamedParameters>
Report flatten_with(const NamedParameters& common, const Options& options, const Conditions& conditions,
                    Results& results, Progress& progress)
{
  Result& given = results.given;
  if(options.target != Target::PLANE)
    return inscribe(options, results, common.projective_weight_map(given.weight));
  const auto in_the_plane = common.border_edges(options.keep_border ? CE::Border_edges::KEPT : CE::Border_edges::FLIPPABLE);
  if(options.seamless)
    return flatten_seamlessly(options, conditions, results, in_the_plane.projective_weight_map(given.weight));
  Report placement;
  if(options.places_cones)
  {
    const Stopwatch watch;
    progress.show("placing cones");
    placement = place_cones(options, given.mesh, conditions, in_the_plane);
    results.placing_seconds = watch.seconds();
    if(! placement)
      return placement;
  }
  const auto np =
    in_the_plane
          .projective_weight_map(given.weight)
          .border_angle_map(conditions.border_angle)
          .cone_angle_map(conditions.cone_angle)
          .vertex_is_constrained_map(conditions.is_constrained)
          .prescribed_log_scale_factor_map(conditions.u)
          .layout_frame(options.unit_square ? CE::Layout_frame::UNIT_SQUARE : CE::Layout_frame::CANONICAL);
  if(options.local_repair)
    return flatten_repaired(given, results.made, results.repair, np);
  if(options.precision_in_bits > bits_of_double)
    return flatten_precisely(given.mesh, given.uv, results.refinement, given.wide, np);
  Report report = CE::flatten(given.mesh, given.uv, np.common_refinement(std::ref(results.refinement)));
  take_over_placement(placement, report);
  return report;
}

// The linear solvers compiled in, the default first.
inline std::vector<std::string> solver_names()
{
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_CHOLMOD
  return { "cholmod", "simplicial" };
#else
  return { "simplicial" };
#endif
}

inline void check_solver(const std::string& name)
{
  std::string known;
  for(const std::string& s : solver_names())
  {
    if(name.empty() || name == s)
      return;
    known += (known.empty() ? "" : ", ") + s;
  }
  throw Usage_error(text("unknown solver '", name, "'; this program has: ", known));
}

inline Report flatten(const Options& options, const Conditions& conditions, Results& results, Progress& progress)
{
  Progress_visitor visitor(progress);
  const auto common =
    CGAL::parameters::log_scale_factor_map(results.given.u)
                     .mollification(options.mollification)
                     .gradient_tolerance(options.precision_in_bits > bits_of_double ? 0. : options.tolerance)
                     .number_of_iterations(options.maximum_number_of_iterations)
                     .retriangulation(options.retriangulation)
                     .visitor(std::ref(visitor));
  if constexpr(! std::is_same<CE::Default_solver_traits, CE::Simplicial_solver_traits>::value)
    if(options.solver == "simplicial")
      return flatten_with(common.sparse_linear_solver(CE::Simplicial_solver_traits()), options, conditions, results, progress);
  return flatten_with(common, options, conditions, results, progress);
}

} // namespace flattening

#endif // FLATTEN_MESH_SOLVE_H
