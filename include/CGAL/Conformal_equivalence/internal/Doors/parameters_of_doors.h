// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Which named parameters of this package each door reads; others are refused when a program is
// compiled.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_PARAMETERS_OF_DOORS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_PARAMETERS_OF_DOORS_H

#include <CGAL/Conformal_equivalence/internal/parameter_checks.h>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The parameters of several lists.
template <typename... Lists>
struct Parameters_of
{
  template <typename Tag>
  static constexpr bool contains = (Lists::template contains<Tag> || ...);
};

typedef Parameter_list<internal_np::conformal_edge_length_t, internal_np::conformal_mollification_t> Length_parameters;

typedef Parameter_list<internal_np::conformal_gradient_tolerance_t, internal_np::conformal_newton_strategy_t,
                       internal_np::conformal_retriangulation_t, internal_np::conformal_number_of_threads_t> Solver_parameters;

typedef Parameter_list<internal_np::conformal_cone_angle_t, internal_np::conformal_border_angle_t,
                       internal_np::conformal_prescribed_u_t, internal_np::conformal_initial_u_t> Condition_parameters;

typedef Parameter_list<internal_np::conformal_edge_is_seam_t, internal_np::conformal_seam_weight_t> Cut_parameters;

// What every door reads: lengths, the solver, and where to write the report.
typedef Parameters_of<Length_parameters, Solver_parameters, Parameter_list<internal_np::conformal_report_t> > Common_parameters;

// What is scaled, of the mesh: u, weights, lengths.
typedef Parameter_list<internal_np::conformal_u_t, internal_np::conformal_weight_t,
                       internal_np::conformal_scaled_length_t> Scaled_parameters;

typedef Parameters_of<Common_parameters, Condition_parameters, Scaled_parameters,
                      Parameter_list<internal_np::conformal_border_edges_t, internal_np::conformal_layout_frame_t> > Layout_parameters;

typedef Parameters_of<Layout_parameters, Cut_parameters,
                      Parameter_list<internal_np::conformal_common_refinement_t> > Parameters_of_flatten;

typedef Parameters_of<Layout_parameters, Parameter_list<internal_np::conformal_seam_is_border_t> > Parameters_of_parameterizer;

// It takes a pack that was made for flatten(): what this writes for `tm`, and what it says of flips, is of no use there.
typedef Parameters_of<Parameters_of_flatten,
                      Parameter_list<internal_np::conformal_number_of_changes_t> > Parameters_of_flatten_repaired;

typedef Parameters_of<Common_parameters,
                      Parameter_list<internal_np::conformal_vertex_at_infinity_t, internal_np::conformal_moebius_weights_t,
                                     internal_np::conformal_u_t, internal_np::conformal_weight_t> > Inscribed_parameters;

typedef Parameters_of<Inscribed_parameters,
                      Parameter_list<internal_np::conformal_spherical_refinement_t> > Parameters_of_map_to_sphere;

typedef Parameters_of<Inscribed_parameters,
                      Parameter_list<internal_np::conformal_disk_frame_t,
                                     internal_np::conformal_common_refinement_t> > Parameters_of_map_to_disk;

typedef Parameters_of<Common_parameters,
                      Parameter_list<internal_np::conformal_number_of_cones_t, internal_np::conformal_maximum_u_t,
                                     internal_np::conformal_maximum_area_distortion_t, internal_np::conformal_angle_quantum_t,
                                     internal_np::conformal_cone_measure_t, internal_np::conformal_number_of_sweeps_t,
                                     internal_np::conformal_cone_angles_t, internal_np::conformal_maximum_root_mean_square_t,
                                     internal_np::conformal_border_edges_t,
                                     internal_np::conformal_u_t> > Parameters_of_place_cones;

typedef Parameters_of<Parameters_of_place_cones, Condition_parameters, Cut_parameters, Scaled_parameters,
                      Parameter_list<internal_np::conformal_number_of_tiles_t, internal_np::conformal_maximum_distortion_t,
                                     internal_np::conformal_seamless_coordinates_t,
                                     internal_np::conformal_loop_turnings_t> > Parameters_of_seamless_parameterization;

// Those of the mesh that is made, in the doors that make one.
typedef Parameter_list<internal_np::conformal_weight_t, internal_np::conformal_edge_is_seam_t,
                       internal_np::conformal_input_face_t> Parameters_of_refined_mesh;

typedef Parameter_list<internal_np::conformal_edge_is_seam_t, internal_np::conformal_input_face_t> Parameters_of_refined_seamless_mesh;

typedef Parameter_list<internal_np::conformal_weight_t, internal_np::conformal_input_face_t> Parameters_of_refined_sphere;

typedef Parameter_list<internal_np::conformal_weight_t, internal_np::conformal_edge_is_seam_t,
                       internal_np::conformal_u_t> Parameters_of_repaired_mesh;

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_PARAMETERS_OF_DOORS_H
