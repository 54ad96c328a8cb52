// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/doors.h"
#include "../include/flatten_mesh/door_parameters.h"

#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <functional>

namespace flattening {

Report flatten_in_the_plane(const Options& options, const Conditions& conditions, Results& results, Progress& progress)
{
  Progress_visitor visitor(progress);
  return CE::flatten(results.given.mesh, results.given.uv, flattening_parameters(options, conditions, results, visitor)
                                                             .edge_is_constrained_map(conditions.is_diagonal)
                                                             .common_refinement(std::ref(results.refinement)));
}

} // namespace flattening
