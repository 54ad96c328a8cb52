// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file compute_common_refinement.h
/// From a flat metric that needed flips to the map of the surface: the overlay of the two triangulations, laid out in the plane (section 3.2
/// of Springborn, Schroeder and Pinkall, 2008; Gillespie, Springborn and Crane, 2021). `Common_refinement.h` says what it is made of.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_COMMON_REFINEMENT_H
#define CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_COMMON_REFINEMENT_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Refinement_builder.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// overlays the triangulation that was given to the solver and that of the metric found, and lays the overlay out in the plane.
///
/// How edges run over one another is known in integers, from the flips alone. Where they cross follows from the lengths of the metric's
/// triangulation, in `Conformal_metric::Wide_number`: both triangulations are geodesic in one hyperbolic metric. The vertices of the input
/// lie where `compute_layout()` puts them, bit by bit. Along uncut edges the corners on both sides are equal bit by bit, and the sides of a cut
/// differ by the motion that `compute_layout()` reports. Seams run along input edges.
///
/// If no edge was flipped, the result is the input. After Ptolemy flips (`Retriangulation::WHEN_NEEDED`) the map preserves the circumcircles of the
/// input triangles; flips of the Euclidean metric that come before (`Retriangulation::ALWAYS`) are treated in the same way: the input
/// edges which they replace then cross the others as the geodesics of the hyperbolic metric do, not as straight lines of the surface.
///
/// \param input the triangulation that was given to the solver
/// \param metric what the solver returned
/// \param cut what it leaves should be disks, with all cones on their borders, as `compute_cut_graph()` provides
/// \param maximum_number_of_crossings the limit for both halves together if the metric is one of the double; it is checked before memory is allocated
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{layout_frame} \cgalParamDescription{as in `compute_layout()`} \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the refinement, with the verdict on its faces (exact for `double`; for other numbers a face counts as positive if that is certain), or
///        `EMPTY_MESH`, `TOO_MANY_CROSSINGS`, `OUT_OF_MEMORY`.
///         Time and memory are linear in the sizes of the triangulations and the number of crossings.
/// \pre `metric` is a success; its triangulation is `input`, or was made from it by `Conformal_metric::flips`.
///
/// \sa `CGAL::Conformal_equivalence::make_refined_mesh()`
template <typename NT, typename NamedParameters = parameters::Default_named_parameters>
Common_refinement<NT> compute_common_refinement(const Intrinsic_triangulation<NT>& input,
                                                const Conformal_metric<NT>& metric,
                                                const Cut_graph& cut,
                                                std::uint64_t maximum_number_of_crossings = default_maximum_number_of_crossings,
                                                const NamedParameters& np = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  CGAL_precondition(bool(metric));
  CGAL_precondition(metric.triangulation.number_of_halfedges() == (metric.is_doubled ? 2 : 1) * input.number_of_halfedges());
  const auto frame = choose_parameter(get_parameter(np, internal_np::conformal_layout_frame), Layout_frame::CANONICAL);
  return internal::build_refinement(input, metric, cut, maximum_number_of_crossings, frame);
}

/// \ingroup PkgConformalEquivalenceLayout
///
/// returns the largest difference, in radians, of the angle sum that the refinement has at a vertex from the one that `conditions` prescribe there;
/// vertices of fixed u, and isolated ones, are left out. Below 1e-10, say, the faces around each vertex that is no cone turn once. Linear time.
/// \param input the triangulation that was given to the solver
/// \param refinement what `compute_common_refinement()` returned for it
/// \param conditions the conditions that were given to the solver
template <typename NT>
double angle_sum_error(const Intrinsic_triangulation<NT>& input, const Common_refinement<NT>& refinement,
                       const Conformal_conditions<NT>& conditions)
{
  double result = 0;
  for(std::uint32_t v = 0; v < refinement.number_of_input_vertices; ++v)
    if(!input.is_isolated_vertex(v) && !conditions.is_fixed(v))
    {
      const double error = std::abs(refinement.angle_sums[v] - static_cast<double>(conditions.angle_sum(v).radians()));
      result = std::isfinite(error) ? (std::max)(result, error) : std::numeric_limits<double>::infinity();
    }
  return result;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_COMMON_REFINEMENT_H
