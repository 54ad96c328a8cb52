// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Part of the compiled library: what is read from surfaces, conditions, metrics and reports, for `double`.

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Cell_verdict.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>

namespace CGAL {
namespace Conformal_equivalence {

template Intrinsic_triangulation<double>::Intrinsic_triangulation(std::uint32_t, std::vector<std::uint32_t>, std::vector<std::uint32_t>);
template Conformal_conditions<double>::Conformal_conditions(const Intrinsic_triangulation<double>&);

template Surface_components connected_components(const Intrinsic_triangulation<double>&);
template Surface_topology surface_topology(const Intrinsic_triangulation<double>&, const Surface_components&);
template std::vector<std::uint32_t> non_manifold_vertices(const Intrinsic_triangulation<double>&);

namespace internal {

template double angle_sum_at(const Conformal_metric<double>&, std::uint32_t);
template Orientation exact_turn(const std::array<double, 2>&, const std::array<double, 2>&, const std::array<double, 2>&);
template std::vector<std::uint32_t> input_faces_lost(const Common_refinement<double>&);
template std::string message_text(Status, double, const Surface_topology&, const std::vector<std::size_t>&,
                                  const std::vector<std::array<std::size_t, 2> >&, const std::vector<std::size_t>&);

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL
