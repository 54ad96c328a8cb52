// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/doors.h"
#include "../include/flatten_mesh/door_parameters.h"
#include "../include/flatten_mesh/seamless.h"
#include "../include/flatten_mesh/Stopwatch.h"

#include <CGAL/Conformal_equivalence/compute_seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/Statistics.h>

#include <algorithm>
#include <cmath>

namespace flattening {

namespace {

// The layout was found in coordinates (a, b) of the lattice: these are written, Cartesian ones are drawn.
void keep_lattice_coordinates(int symmetry, Result& result)
{
  result.lattice_uv = add_lattice_coordinates(result.mesh);
  for(Halfedge h : result.mesh.halfedges())
    (*result.lattice_uv)[h] = result.uv[h];
  draw_lattice_coordinates(symmetry, result);
}

} // namespace

UV_map add_lattice_coordinates(Mesh& mesh)
{
  return mesh.add_property_map<Halfedge, Kernel::Point_2>("h:lattice_uv").first;
}

void draw_lattice_coordinates(int symmetry, Result& result)
{
  for(Halfedge h : result.mesh.halfedges())
  {
    const Kernel::Point_2 p = (*result.lattice_uv)[h];
    result.uv[h] = has_hexagons(symmetry) ? Kernel::Point_2(p.x() + p.y() / 2, p.y() * (std::sqrt(3.) / 2)) : p;
  }
}

Report flatten_seamlessly(const Options& options, const Conditions& conditions, Results& results, Progress& progress)
{
  Progress_visitor visitor(progress);
  const Stopwatch watch;
  Result& given = results.given;
  const auto tiling = tiling_parameters(options, results, visitor).edge_is_constrained_map(conditions.is_diagonal)
                                                                            .loop_turnings(conditions.loops);
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
    keep_lattice_coordinates(static_cast<int>(options.quanta_of_turn), given);
  return report;
}

} // namespace flattening
