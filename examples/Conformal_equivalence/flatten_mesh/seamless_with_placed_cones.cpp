// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/doors.h"
#include "../include/flatten_mesh/door_parameters.h"

#include <CGAL/Conformal_equivalence/compute_seamless_parameterization.h>

namespace flattening {

Report flatten_seamlessly_with_placed_cones(const Options& options, Results& results, Progress& progress)
{
  Progress_visitor visitor(progress);
  return CE::compute_seamless_parameterization(results.given.mesh, results.given.uv,
                                               tiling_parameters(options, results, visitor));
}

} // namespace flattening
