// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The named parameters of this package, one a line, in the form of
// CGAL/STL_Extension/internal/parameters_interface.h. Included several times on
// purpose, hence no include guard.

// the metric and its conditions
CGAL_add_named_parameter(conformal_edge_length_t, conformal_edge_length, edge_length_map)
CGAL_add_named_parameter(conformal_cone_angle_t, conformal_cone_angle, cone_angle_map)
CGAL_add_named_parameter(conformal_border_angle_t, conformal_border_angle, border_angle_map)
CGAL_add_named_parameter(conformal_prescribed_u_t, conformal_prescribed_u, prescribed_log_scale_factor_map)
CGAL_add_named_parameter(conformal_initial_u_t, conformal_initial_u, initial_log_scale_factor_map)

// results
CGAL_add_named_parameter(conformal_u_t, conformal_u, log_scale_factor_map)
CGAL_add_named_parameter(conformal_weight_t, conformal_weight, projective_weight_map)
CGAL_add_named_parameter(conformal_scaled_length_t, conformal_scaled_length, scaled_edge_length_map)
CGAL_add_named_parameter(conformal_report_t, conformal_report, flattening_report)

// the solver
CGAL_add_named_parameter(conformal_gradient_tolerance_t, conformal_gradient_tolerance, gradient_tolerance)
CGAL_add_named_parameter(conformal_newton_strategy_t, conformal_newton_strategy, newton_strategy)
CGAL_add_named_parameter(conformal_retriangulation_t, conformal_retriangulation, retriangulation)

// cutting and laying out
CGAL_add_named_parameter(conformal_edge_is_seam_t, conformal_edge_is_seam, edge_is_seam_map)
CGAL_add_named_parameter(conformal_seam_weight_t, conformal_seam_weight, seam_weight_map)
CGAL_add_named_parameter(conformal_seam_is_border_t, conformal_seam_is_border, seam_is_border)
CGAL_add_named_parameter(conformal_layout_frame_t, conformal_layout_frame, layout_frame)

// cones that place themselves, seamless textures
CGAL_add_named_parameter(conformal_number_of_cones_t, conformal_number_of_cones, number_of_cones)
CGAL_add_named_parameter(conformal_maximum_u_t, conformal_maximum_u, maximum_log_scale_factor)
CGAL_add_named_parameter(conformal_angle_quantum_t, conformal_angle_quantum, angle_quantum)
CGAL_add_named_parameter(conformal_number_of_tiles_t, conformal_number_of_tiles, number_of_tiles)
CGAL_add_named_parameter(conformal_maximum_distortion_t, conformal_maximum_distortion, maximum_distortion)
