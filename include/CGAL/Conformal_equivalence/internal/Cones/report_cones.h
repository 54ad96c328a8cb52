// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What a placement of cones tells the user of a mesh.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_REPORT_CONES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_REPORT_CONES_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cone_placement.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Status.h>

#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// What the cones of the report, those that were placed, were before their angles were rounded.
template <typename TriangleMesh>
void report_rounding(const Imported_mesh<TriangleMesh, double>& mesh, const Cone_placement<double>& placement,
                     Flattening_report<TriangleMesh>& report)
{
  for(std::size_t i = 0; i < report.cones.size(); ++i)
    report.cones[i].free_angle = placement.free_angles[i];
  for(std::uint32_t v : placement.flattened)
    report.flattened_cones.push_back(mesh.vertex(v));
}

// Whether there are cones, with their metric: those asked for, or the best that were found. A search that was stopped may not have come to a metric.
inline bool has_cones(const Cone_placement<double>& placement)
{
  if(placement.status != Status::STOPPED_BY_VISITOR)
    return bool(placement) || placement.status == Status::BOUND_NOT_MET;
  const std::size_t n = placement.cones.size();
  return n > 0 && placement.angles.size() == n && placement.free_angles.size() == n
      && is_success(placement.metric.status) && !placement.metric.log_scale_factors.empty();
}

// What became of a placement: status, elements at fault, and the cones, if there are any. `report` is that of the import.
template <typename TriangleMesh>
void report_cones(const Imported_mesh<TriangleMesh, double>& mesh, const Cone_placement<double>& placement, Flattening_report<TriangleMesh>& report)
{
  const Conformal_metric<double>& metric = placement.metric;
  report.statistics = metric.statistics;
  report.status = placement.status;
  report.amount = placement.amount;
  if(!metric.is_retriangulated())
    name_elements(mesh, placement.vertices, {}, placement.faces, report);
  if(!has_cones(placement))
    return;
  for(std::size_t i = 0; i < placement.cones.size(); ++i)
  {
    const auto v = mesh.vertex(placement.cones[i]);
    const Exact_angle<double>& angle = placement.angles[i];
    report.cones.push_back({v, mesh.index_of_vertex(v), angle.template radians<double>(), !placement.is_rounded});
  }
  report_rounding(mesh, placement, report);
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_REPORT_CONES_H
