// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/doors.h"
#include "../include/flatten_mesh/seamless.h"
#include "../include/flatten_mesh/seamless_door.h"

#include <CGAL/Conformal_equivalence/compute_seamless_parameterization.h>

#include <cmath>

namespace flattening {

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

void keep_lattice_coordinates(int symmetry, Result& result)
{
  result.lattice_uv = add_lattice_coordinates(result.mesh);
  for(Halfedge h : result.mesh.halfedges())
    (*result.lattice_uv)[h] = result.uv[h];
  draw_lattice_coordinates(symmetry, result);
}

Report flatten_seamlessly(const Options& options, const Conditions& conditions, Results& results, Progress& progress)
{
  Result& given = results.given;
  const Report report = call_seamless_door(options, conditions, results, progress,
                                           [&](const auto& np) { return CE::compute_seamless_parameterization(given.mesh, given.uv, np); });
  if(report && options.lattice_coordinates)
    keep_lattice_coordinates(static_cast<int>(options.quanta_of_turn), given);
  return report;
}

} // namespace flattening
