// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file uniformize_hyperbolic.h
/// From a mesh to the hyperbolic surface that it is conformally equivalent to, laid out in the unit disk, with its group (section 6 of Bobenko,
/// Pinkall and Springborn, "Discrete conformal maps and ideal hyperbolic polyhedra", 2015).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_UNIFORMIZE_HYPERBOLIC_H
#define CGAL_CONFORMAL_EQUIVALENCE_UNIFORMIZE_HYPERBOLIC_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Hyperbolic_uniformization.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Doors/indexed_parameters.h>
#include <CGAL/Conformal_equivalence/internal/Doors/parameters_of_doors.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Uniformization.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/internal/parameter_checks.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/internal/solver_traits_of.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/read_conditions.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

typedef Parameters_of<Length_parameters, Condition_parameters,
                      Parameter_list<internal_np::conformal_gradient_tolerance_t, internal_np::conformal_retriangulation_t,
                                     internal_np::conformal_u_t> > Parameters_of_uniformize_hyperbolic;

// The conditions among the named parameters; if nothing is said of the border it is a geodesic.
template <typename TriangleMesh, typename NamedParameters>
Conformal_conditions<double> read_hyperbolic_conditions(const Imported_mesh<TriangleMesh>& mesh, std::vector<std::uint32_t>& missing,
                                                        const NamedParameters& np)
{
  Conformal_conditions<double> result = read_conditions(mesh, missing, np);
  if constexpr(!is_given<internal_np::conformal_border_angle_t, NamedParameters> && !is_given<internal_np::conformal_prescribed_u_t, NamedParameters>
               && !is_given<CGAL::internal_np::vertex_is_constrained_t, NamedParameters>)
    for(std::uint32_t v = 0; v < mesh.triangulation.number_of_vertices(); ++v)
      if(mesh.triangulation.is_border_vertex(v))
        result.prescribe_angle_sum(v, Exact_angle<double>::pi_times(1));
  return result;
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceHyperbolic
///
/// finds the hyperbolic surface that a triangle mesh is discretely conformally equivalent to: the one metric of curvature -1 within its conformal
/// class. If the mesh is connected, it is also laid out in the unit disk, Poincaré's model of the hyperbolic plane, cut open along seams that join
/// its cones. If it is closed and has no cones, the layout is around a vertex in the center, and its group is found, by which its copies tile the
/// disk: generators of 2g loops with their relation, and canonical ones. `realize_exactly()` makes of this a surface in rational numbers, and
/// `make_triangulation_on_hyperbolic_surface()` a `CGAL::Triangulation_on_hyperbolic_surface_2`.
///
/// A closed mesh of genus 2 or more needs no conditions. A closed mesh of genus 0 or 1 needs cones (`cone_angle_map`) whose curvatures 2 pi -
/// angle sum up to more than 4 pi or 0. Borders are geodesics unless conditions say otherwise: the double of the surface is uniformized. If u is
/// fixed somewhere on the border, borders keep their edges, and the surface itself is laid out.
///
/// Edges are flipped on the way, see `compute_hyperbolic_metric()`. The straight triangles of the mesh, between the places of its corners, may
/// then be flipped, as they are not those of the metric; its own triangulation is in the result, too.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
///
/// \param tm a triangle mesh
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{edge_length_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{mollification} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{cone_angle_map} \cgalParamDescription{as in `read_conditions()`} \cgalParamNEnd
///   \cgalParamNBegin{border_angle_map} \cgalParamDescription{as in `read_conditions()`} \cgalParamDefault{pi: borders are geodesics} \cgalParamNEnd
///   \cgalParamNBegin{vertex_is_constrained_map} \cgalParamDescription{as in `read_conditions()`} \cgalParamNEnd
///   \cgalParamNBegin{prescribed_log_scale_factor_map} \cgalParamDescription{as in `read_conditions()`: sinh(l/2) becomes e^{(u_i + u_j) / 2} times half the length given} \cgalParamNEnd
///   \cgalParamNBegin{gradient_tolerance} \cgalParamDescription{as in `compute_hyperbolic_metric()`} \cgalParamNEnd
///   \cgalParamNBegin{number_of_iterations} \cgalParamDescription{as in `compute_hyperbolic_metric()`} \cgalParamNEnd
///   \cgalParamNBegin{retriangulation} \cgalParamDescription{as in `compute_hyperbolic_metric()`} \cgalParamNEnd
///   \cgalParamNBegin{initial_log_scale_factor_map} \cgalParamDescription{as in `compute_hyperbolic_metric()`} \cgalParamNEnd
///   \cgalParamNBegin{sparse_linear_solver} \cgalParamDescription{as in `compute_hyperbolic_metric()`} \cgalParamNEnd
///   \cgalParamNBegin{visitor} \cgalParamDescription{as in `compute_hyperbolic_metric()`} \cgalParamNEnd
///   \cgalParamNBegin{log_scale_factor_map}
///     \cgalParamDescription{receives u, if there is a metric}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return what was found. Vertices and faces are numbered as in `vertices(tm)` and `faces(tm)`, the halfedge `3f + k` is the `k`-th after
///         `halfedge(f, tm)`, and edges are numbered in the order of their first halfedge (see `Imported_mesh`). Statuses:
///         those of `import_mesh()`, `MISSING_CONDITION` (vertices), and those of `compute_hyperbolic_metric()`.
///
/// Time is that of `compute_hyperbolic_metric()`, and O(n log n) for loops and layout.
///
/// \sa `CGAL::Conformal_equivalence::realize_exactly()`
template <typename TriangleMesh, typename NamedParameters = parameters::Default_named_parameters>
Hyperbolic_uniformization uniformize_hyperbolic(const TriangleMesh& tm, const NamedParameters& np = parameters::default_values())
{
  static_assert(internal::Check_pack<internal::Parameters_of_uniformize_hyperbolic, TriangleMesh, NamedParameters>::value);
  Hyperbolic_uniformization result;
  const internal::Stopwatch stopwatch;
  const Imported_mesh<TriangleMesh> mesh = import_mesh(tm, np);
  const double seconds = stopwatch.seconds();
  result.status = mesh.status;
  result.vertices = mesh.faulty_vertices;
  result.edges = mesh.faulty_edges;
  result.faces = mesh.faulty_faces;
  if(!bool(result))
    return result;
  const Conformal_conditions<double> conditions = internal::read_hyperbolic_conditions(mesh, result.vertices, np);
  if(!result.vertices.empty())
  {
    result.status = Status::MISSING_CONDITION;
    return result;
  }
  result = internal::Uniformization::run(mesh.triangulation, conditions, internal::read_solver_options(mesh, np),
                                         internal::make_factorization(internal::solver_traits_of(np)));
  result.metric.statistics.seconds.import = seconds;
  if(bool(result))
    for(std::uint32_t v = 0; v < mesh.triangulation.number_of_vertices(); ++v)
      internal::put_if_given(np, internal_np::conformal_u, mesh.vertex(v), result.metric.log_scale_factors[v]);
  return result;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_UNIFORMIZE_HYPERBOLIC_H
