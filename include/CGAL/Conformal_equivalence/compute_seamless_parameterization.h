// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file compute_seamless_parameterization.h
/// Seamless textures (section 6 of Springborn, Schroeder and Pinkall, 2008): cones with multiples of 2 pi / n are moved to the points of a
/// lattice, so that a pattern with the symmetries of the lattice covers the surface without a visible seam.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_SEAMLESS_PARAMETERIZATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_SEAMLESS_PARAMETERIZATION_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/internal/Doors/parameters_of_doors.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <boost/graph/graph_traits.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

namespace internal {

template <typename NamedParameters>
Seamless_options read_seamless_options(const NamedParameters& np)
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  Seamless_options result;
  result.angle_quantum = choose_parameter(get_parameter(np, internal_np::conformal_angle_quantum), result.angle_quantum);
  Rectification_options& options = result.rectification;
  options.number_of_tiles = double(choose_parameter(get_parameter(np, internal_np::conformal_number_of_tiles), std::size_t(0)));
  options.maximum_distortion = choose_parameter(get_parameter(np, internal_np::conformal_maximum_distortion), options.maximum_distortion);
  options.is_lattice_coordinates = choose_parameter(get_parameter(np, internal_np::conformal_seamless_coordinates),
                                                    Seamless_coordinates::CARTESIAN) == Seamless_coordinates::LATTICE;
  options.visitor = visitor_of(np);
  return result;
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceDoors
///
/// How a closed curve along the edges of a surface with handles is to turn, for `compute_seamless_parameterization()`.
template <typename TriangleMesh>
struct Loop_turning
{
  /// the edges in order: each halfedge begins where the one before it ends, and the first one where the last one does. The curve
  /// meant is the one right beside them, on the left.
  std::vector<typename boost::graph_traits<TriangleMesh>::halfedge_descriptor> halfedges;

  /// by how many times 2 pi / n it turns to the left, modulo n. (The angle by which a vector turns that is carried along the curve is minus that.)
  int quanta = 0;
};

/// \ingroup PkgConformalEquivalenceDoors
///
/// makes a seamless parameterization of a surface of any topology: a layout with cones at points of a lattice, in which the two sides of
/// every seam edge differ by a symmetry of the lattice. A checkerboard pattern, or any other texture with the symmetries of the lattice, then
/// covers the surface without a visible seam; so do the tiles of a quadrangulation.
///
///  - *Cones* have multiples of the `angle_quantum` 2 pi / n for their angle sums. They place themselves, see `place_cones()`, or are given.
///  - The conformally equivalent flat metric is laid out, as by `flatten()`. The motions across the seam are rotations by multiples of 2 pi / n, with
///    some translations; the cones lie where they happen to.
///  - *Rectification*: of all positions of the cones in the lattice, and translations that go with them, those are chosen which take the least
///    conformal energy to deform the layout to. They are found among lattice points by enumeration (proven to be the closest ones for scale and
///    rotation if `Tiling::is_closest`; up to about 30 cones), else by rounding to nearest planes. Scale and rotation follow from `number_of_tiles`
///    or `maximum_distortion`.
///  - The layout with these positions is the one of least conformal energy (the *generalized Laplace layout*). It is no longer conformally equivalent
///    to the mesh exactly; `Tiling` has the figures. If nothing has to be deformed, as with at most two cones on a disk or three on a sphere, it
///    still is.
///
/// With n = 2 and 4 seams are exact in the numbers written: for every seam edge a motion z -> i^k z + a + b i with integers a and b takes the
/// coordinates of one side to those of the other, without any rounding. With n = 3 and 6 this holds for `Seamless_coordinates::LATTICE`. All
/// triangles are positive, decided exactly on the numbers written.
///
/// On surfaces with handles cones do not determine alone what is seamless: loops around the handles, too, must turn by multiples of 2 pi / n,
/// and in a conformal class the cones leave no choice. There the conformally equivalent metric is deformed first, as little as it takes
/// (of all edge lengths in Penner coordinates, by Newton's method, with flips, whatever `retriangulation` says): to the multiples next to what is
/// there, chosen together, or to `loop_turnings`. `Flattening_report::handles` tells by how much, and whether it is proven that there is such a
/// surface; if there is none, whatever the mesh, the status is `NOT_REALIZABLE`.
///
/// On a surface with borders handles, and all borders but one, can be gone around, and are turned in the same way, while natural borders bend as they
/// like. A border with prescribed angles at all its vertices must turn by a multiple of 2 pi / n by itself; otherwise, and where borders took
/// flips on the double, the status is `NOT_SEAMLESS`.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam HalfedgeUVMap as in `flatten()`
/// \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
///
/// \param tm a triangle mesh of one component
/// \param uv receives, at every halfedge `h`, where `target(h, tm)` lies in the triangle of `face(h, tm)`, in units of the lattice, see `Tiling`
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{number_of_cones} \cgalParamDescription{as in `place_cones()`. If neither this nor a bound is given, the cones are those of `cone_angle_map`} \cgalParamNEnd
///   \cgalParamNBegin{maximum_log_scale_factor} \cgalParamDescription{as in `place_cones()`} \cgalParamNEnd
///   \cgalParamNBegin{maximum_area_distortion} \cgalParamDescription{as in `place_cones()`} \cgalParamNEnd
///   \cgalParamNBegin{maximum_root_mean_square} \cgalParamDescription{as in `place_cones()`} \cgalParamNEnd
///   \cgalParamNBegin{cone_angles} \cgalParamDescription{as in `place_cones()`} \cgalParamNEnd
///   \cgalParamNBegin{cone_measure} \cgalParamDescription{as in `place_cones()`}
///     \cgalParamDefault{that of the bound given; without any, `Cone_measure::ROOT_MEAN_SQUARE_U`, with which more layouts are injective}
///   \cgalParamNEnd
///   \cgalParamNBegin{number_of_sweeps} \cgalParamDescription{as in `place_cones()`} \cgalParamNEnd
///   \cgalParamNBegin{cone_angle_map}
///     \cgalParamDescription{the angle sums of the inner vertices, if cones are not to place themselves: multiples of the quantum}
///     \cgalParamType{as in `read_conditions()`}
///     \cgalParamDefault{no cones, unless they place themselves}
///   \cgalParamNEnd
///   \cgalParamNBegin{border_angle_map} \cgalParamDescription{as in `read_conditions()`. With border angles cones do not place themselves} \cgalParamNEnd
///   \cgalParamNBegin{vertex_is_constrained_map} \cgalParamDescription{as in `read_conditions()`. With border angles cones do not place themselves} \cgalParamNEnd
///   \cgalParamNBegin{prescribed_log_scale_factor_map} \cgalParamDescription{as in `read_conditions()`. With border angles cones do not place themselves} \cgalParamNEnd
///   \cgalParamNBegin{angle_quantum}
///     \cgalParamDescription{2 pi / n (radians), n = 2, 3, 4 or 6}
///     \cgalParamType{`double`}
///     \cgalParamDefault{`CGAL_PI / 2`}
///   \cgalParamNEnd
///   \cgalParamNBegin{loop_turnings}
///     \cgalParamDescription{how loops are to turn; all others are chosen, as they are without any}
///     \cgalParamType{a range of `Loop_turning<TriangleMesh>`; for closed surfaces}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{number_of_tiles}
///     \cgalParamDescription{the area of the layout, about: of the nearby sizes and all rotations those with the least distortion are taken. If triangles are inverted by the deformation, there will be twice as many, or more}
///     \cgalParamType{`std::size_t`}
///     \cgalParamDefault{as few as `maximum_distortion` allows}
///   \cgalParamNEnd
///   \cgalParamNBegin{maximum_distortion}
///     \cgalParamDescription{a bound on the mean quasi-conformal factor of the deformation, if there is no `number_of_tiles`}
///     \cgalParamType{`double`}
///     \cgalParamDefault{`1.02`}
///   \cgalParamNEnd
///   \cgalParamNBegin{seamless_coordinates}
///     \cgalParamDescription{those in which the layout is written}
///     \cgalParamType{`Seamless_coordinates`}
///     \cgalParamDefault{`Seamless_coordinates::CARTESIAN`}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map} \cgalParamDescription{as in `flatten()`} \cgalParamNEnd
///   \cgalParamNBegin{edge_length_map} \cgalParamDescription{as in `flatten()`} \cgalParamNEnd
///   \cgalParamNBegin{mollification} \cgalParamDescription{as in `flatten()`} \cgalParamNEnd
///   \cgalParamNBegin{edge_is_seam_map} \cgalParamDescription{as in `flatten()`} \cgalParamNEnd
///   \cgalParamNBegin{edge_is_constrained_map} \cgalParamDescription{as in `flatten()`} \cgalParamNEnd
///   \cgalParamNBegin{seam_weight_map} \cgalParamDescription{as in `flatten()`} \cgalParamNEnd
///   \cgalParamNBegin{log_scale_factor_map} \cgalParamDescription{as in `flatten()`: of the flat metric before cones are moved; where handles were turned, the factors that come nearest to it} \cgalParamNEnd
///   \cgalParamNBegin{scaled_edge_length_map} \cgalParamDescription{as in `flatten()`: of the flat metric before cones are moved; where handles were turned, the factors that come nearest to it} \cgalParamNEnd
///   \cgalParamNBegin{gradient_tolerance} \cgalParamDescription{as in `flatten()`} \cgalParamNEnd
///   \cgalParamNBegin{number_of_iterations} \cgalParamDescription{as in `flatten()`} \cgalParamNEnd
///   \cgalParamNBegin{number_of_threads} \cgalParamDescription{as in `flatten()`} \cgalParamNEnd
///   \cgalParamNBegin{newton_strategy} \cgalParamDescription{as in `flatten()`} \cgalParamNEnd
///   \cgalParamNBegin{retriangulation} \cgalParamDescription{as in `flatten()`} \cgalParamNEnd
///   \cgalParamNBegin{border_edges} \cgalParamDescription{as in `flatten()`} \cgalParamNEnd
///   \cgalParamNBegin{sparse_linear_solver} \cgalParamDescription{as in `flatten()`} \cgalParamNEnd
///   \cgalParamNBegin{visitor} \cgalParamDescription{as in `flatten()`} \cgalParamNEnd
///   \cgalParamNBegin{flattening_report}
///     \cgalParamDescription{receives a copy of what is returned}
///     \cgalParamType{`std::reference_wrapper<Flattening_report<TriangleMesh> >`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the report, with the cones and their lattice points, exact transitions, and the `Tiling`. Maps are written iff it is a success, or
///         `BOUND_NOT_MET`: then of the best that was found. Statuses: those of `place_cones()` and `flatten()`; `WRONG_TOPOLOGY` (several
///         components); `INVALID_NUMBER` (a bound below 1); `ANGLE_OUT_OF_RANGE` (no lattice has this quantum, or vertices: cones with other angles,
///         or free ones); `NOT_SEAMLESS` (edges; cones are reported all the same); `NOT_REALIZABLE` (vertices: the cones; edges: loops);
///         `ITERATIONS_EXHAUSTED` (no metric was found in which handles turn like that); `NOT_INJECTIVE` (faces: inverted on every grid that was
///         tried); `SINGULAR_PROBLEM`.
///
/// Time: that of `place_cones()` and `flatten()`, the factorization of a matrix of twice the size, a solution with it for each cone, and a search
/// among lattice points that is bounded; with handles one factorization, or a few, of a matrix of four times the size, and some conformal metrics.
///
/// A `visitor` that stops the search among lattice points is told so by `STOPPED_BY_VISITOR`, unless a layout has been found by then that
/// is only to be proven the closest one: that is kept. Cones and handles are reported in any case.
///
/// \sa `CGAL::Conformal_equivalence::place_cones()`
/// \sa `CGAL::Conformal_equivalence::flatten()`
template <typename TriangleMesh, typename HalfedgeUVMap, typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> compute_seamless_parameterization(const TriangleMesh& tm,
                                                                  HalfedgeUVMap uv,
                                                                  const NamedParameters& np = parameters::default_values())
{
  static_assert(internal::Check_halfedge_map<HalfedgeUVMap, TriangleMesh>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_seamless_parameterization, TriangleMesh, NamedParameters>::value);
  const internal::Stopwatch stopwatch;
  internal::Seamless_parameterization<TriangleMesh> seamless(internal::import_charts(tm, np), stopwatch, internal::read_seamless_options(np));
  seamless.run(np);
  Flattening_report<TriangleMesh>& report = seamless.flattening.report;
  if(bool(report) || report.status == Status::BOUND_NOT_MET)
  {
    internal::write_corners(seamless.flattening.mesh, seamless.flattening.layout, uv);
    internal::write_metric(seamless.flattening, np);
    internal::write_seam(seamless.flattening, np);
  }
  internal::write_report(report, np);
  return std::move(report);
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_SEAMLESS_PARAMETERIZATION_H
