// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_DOOR_PARAMETERS_H
#define FLATTEN_MESH_DOOR_PARAMETERS_H

#include "conditions.h"
#include "options.h"
#include "Progress.h"
#include "results.h"
#include "Solver_traits.h"

#include <CGAL/Conformal_equivalence/internal/Cones/Cone_options.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>
#include <CGAL/number_utils.h>

#include <functional>

namespace flattening {

// The parameters of all functions that make maps, and of the search for cones.
inline auto common_parameters(const Options& options, const Results& results, Progress_visitor& visitor)
{
  return CGAL::parameters::log_scale_factor_map(results.given.u)
                          .mollification(options.mollification)
                          .gradient_tolerance(options.precision_in_bits > bits_of_double ? 0. : options.tolerance)
                          .number_of_iterations(options.maximum_number_of_iterations)
                          .number_of_threads(options.number_of_threads)
                          .retriangulation(options.retriangulation)
                          .visitor(std::ref(visitor))
                          .sparse_linear_solver(Solver_traits(options.solver));
}

// Of those to the plane.
inline auto plane_parameters(const Options& options, const Results& results, Progress_visitor& visitor)
{
  return common_parameters(options, results, visitor)
           .border_edges(options.keep_border ? CE::Border_edges::KEPT : CE::Border_edges::FLIPPABLE);
}

// With what is prescribed.
inline auto flattening_parameters(const Options& options, const Conditions& conditions, const Results& results, Progress_visitor& visitor)
{
  return plane_parameters(options, results, visitor)
           .projective_weight_map(results.given.weight)
           .border_angle_map(conditions.border_angle)
           .cone_angle_map(conditions.cone_angle)
           .vertex_is_constrained_map(conditions.is_constrained)
           .prescribed_log_scale_factor_map(conditions.u)
           .layout_frame(options.unit_square ? CE::Layout_frame::UNIT_SQUARE : CE::Layout_frame::CANONICAL);
}

// What cones are placed for if nothing is said: as if the parameter were not there.
inline CE::Cone_measure default_cone_measure(const Options& options)
{
  CE::internal::Cone_options bounds;
  bounds.maximum_u = options.maximum_log_scale_factor;
  bounds.maximum_area_distortion = options.maximum_area_distortion;
  bounds.maximum_root_mean_square = options.maximum_root_mean_square;
  return bounds.measure_of_bounds(options.seamless ? CE::Cone_measure::ROOT_MEAN_SQUARE_U : CE::Cone_measure::MAXIMUM_U);
}

// The parameters of the search for cones.
inline auto placement_parameters(const Options& options, const Results& results, Progress_visitor& visitor)
{
  return plane_parameters(options, results, visitor)
           .number_of_cones(options.number_of_cones)
           .maximum_log_scale_factor(options.maximum_log_scale_factor)
           .maximum_area_distortion(options.maximum_area_distortion)
           .maximum_root_mean_square(options.maximum_root_mean_square)
           .cone_measure(options.cone_measure ? *options.cone_measure : default_cone_measure(options))
           .angle_quantum(options.quanta_of_turn == 0 ? 0. : 2 * CGAL_PI / options.quanta_of_turn);
}

// Those of a seamless layout.
inline auto tiling_parameters(const Options& options, const Results& results, Progress_visitor& visitor)
{
  return placement_parameters(options, results, visitor)
           .projective_weight_map(results.given.weight)
           .number_of_tiles(options.number_of_tiles)
           .maximum_distortion(options.maximum_distortion)
           .seamless_coordinates(options.lattice_coordinates ? CE::Seamless_coordinates::LATTICE : CE::Seamless_coordinates::CARTESIAN);
}

} // namespace flattening

#endif // FLATTEN_MESH_DOOR_PARAMETERS_H
