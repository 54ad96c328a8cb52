// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The maps to the sphere and to the disk, with more digits.

#include "../include/flatten_mesh/doors.h"
#include "../include/flatten_mesh/door_parameters.h"
#include "../include/flatten_mesh/inscribe.h"
#include "../include/flatten_mesh/precision.h"

#include <CGAL/Conformal_equivalence/map_to_disk.h>
#include <CGAL/Conformal_equivalence/map_to_sphere.h>
#include <CGAL/Conformal_equivalence/multiprecision.h>

#include <functional>
#include <utility>

namespace flattening {

Report map_to_sphere_precisely(const Options& options, Results& results, Progress& progress)
{
  Progress_visitor visitor(progress);
  Result& given = results.given;
  CE::Spherical_refinement<CE::Multiprecision_number> found;
  const Report report = CE::map_to_sphere<CE::Multiprecision_number>(given.mesh, make_image_map(given.mesh, given.wide_image),
    image_parameters(options, results, visitor).spherical_refinement(std::ref(found)));
  results.refinement = rounded(parts_without_layout(found));
  results.made.wide_image = std::move(found.points);
  given.image = rounded(given.wide_image);
  results.made.image = rounded(results.made.wide_image);
  if(report.statistics.number_of_flips == 0)
    results.refinement = Refinement(); // it is a copy of the mesh
  return report;
}

Report map_to_disk_precisely(const Options& options, Results& results, Progress& progress)
{
  Progress_visitor visitor(progress);
  Result& given = results.given;
  use_wide_points(given.mesh, given.wide);
  const auto np = image_parameters(options, results, visitor).common_refinement(std::ref(given.wide.refinement));
  const Report report = map_with_disk_frame(options, given.mesh, np, [&](const auto& all)
    { return CE::map_to_disk<CE::Multiprecision_number>(given.mesh, make_image_map(given.mesh, given.wide_image), all); });
  for(Halfedge h : given.mesh.halfedges())
  {
    const Wide_space_point& p = given.wide_image[given.mesh.target(h).idx()];
    given.wide.uv[h] = Wide_point(p[0], p[1]);
  }
  given.image = rounded(given.wide_image);
  round_layout(given.mesh, given.wide, given.uv, results.refinement);
  return report;
}

} // namespace flattening
