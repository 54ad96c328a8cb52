// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/doors.h"
#include "../include/flatten_mesh/door_parameters.h"
#include "../include/flatten_mesh/precision.h"

#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/multiprecision.h>

#include <functional>

namespace flattening {

Report flatten_precisely(const Options& options, const Conditions& conditions, Results& results, Progress& progress)
{
  Progress_visitor visitor(progress);
  Result& given = results.given;
  use_wide_points(given.mesh, given.wide);
  const Report report = CE::flatten<CE::Multiprecision_number>(given.mesh, given.wide.uv,
    flattening_parameters(options, conditions, results, visitor)
      .edge_is_constrained_map(conditions.is_diagonal)
      .common_refinement(std::ref(given.wide.refinement)));
  if(report)
    round_layout(given.mesh, given.wide, given.uv, results.refinement);
  return report;
}

} // namespace flattening
