// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Status.h
/// How the functions of this package say what happened: a status, the amount by
/// which something failed, the elements at fault, and statistics of the run.
/// Nothing that depends on the user's data is an exception or an assertion.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_STATUS_H
#define CGAL_CONFORMAL_EQUIVALENCE_STATUS_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Surface_mesh_parameterization/Error_code.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceStatus
/// What became of a computation.
enum class Status
{
  OK,                    ///< done: every angle sum is within `gradient_tolerance` of its target
  CONVERGED_TO_ROUNDING, ///< done as far as the number type can tell: `amount` is the residual reached (radians)
  EMPTY_MESH,            ///< the mesh has no face
  NOT_TRIANGULATED,      ///< `faces` are no triangles
  NON_MANIFOLD,          ///< the faces at `vertices` form more than one fan
  INVALID_NUMBER,        ///< a coordinate, length or condition of the elements named is not a finite number, or a length is negative
  ZERO_LENGTH_EDGE,      ///< `edges` have length zero (coincident points)
  WRONG_TOPOLOGY,        ///< the surface is not of the kind that this function takes; see `Flattening_report::topology`
  GAUSS_BONNET_VIOLATED, ///< on a component without fixed u, that of `vertices`, the prescribed angles leave `amount` (radians) too much or too little
  NO_ANGLE_LEFT,         ///< on a component the prescribed angles leave `amount` <= 0 (radians) for `vertices`, where u is fixed
  ANGLE_OUT_OF_RANGE,    ///< the angle prescribed at `vertices` cannot occur there; `amount` is the first one (radians)
  MISSING_CONDITION,     ///< `vertices` lack a condition that the function needs; or the closed surfaces of `faces`, of a genus other than 1, lack cones
  SINGULAR_PROBLEM,      ///< the linear system could not be factorized
  ITERATIONS_EXHAUSTED,  ///< not converged; `amount` is the residual (radians), `faces` the triangles broken at that point
  DEGENERATE_METRIC,     ///< the minimizer violates the triangle inequality in `faces`; if edges were flipped, in triangles at `vertices`
  NOT_INJECTIVE,         ///< the layout flips `faces`, or its border crosses itself
  SEAM_LEAVES_NO_DISK,   ///< cut along the given seam, `edges`, the surface is no disk; see `Flattening_report::topology`
  SEAM_MISSES_CONE,      ///< the cones at `vertices` are not on the given seam
  STOPPED_BY_VISITOR,    ///< the visitor asked to stop
  OUT_OF_MEMORY,         ///< memory was exhausted
  TOO_MANY_CROSSINGS,    ///< the overlay of two triangulations would have `amount` crossings: more than allowed
  NOT_REPRESENTABLE,     ///< the mesh type cannot hold the result: it would have several edges between the same vertices
  TOO_MANY_CONES,        ///< more cones are asked for than there are vertices for them: `amount`
  BOUND_NOT_MET,         ///< the distortion asked for was not reached, but `amount`: what was found is returned nevertheless
  NOT_QUANTIZABLE,       ///< no such multiples of the angle quantum sum up to what the topology asks for: `amount` (radians)
  NOT_SEAMLESS           ///< from one side of the seam at `edges` to the other the surface turns by `amount` (radians): no multiple of the angle quantum
};

/// \ingroup PkgConformalEquivalenceStatus
/// returns `true` iff `status` stands for a usable result.
constexpr bool is_success(Status status)
{
  return status == Status::OK || status == Status::CONVERGED_TO_ROUNDING;
}

namespace internal {

struct Status_entry
{
  Status status;
  const char* text;
  Surface_mesh_parameterization::Error_code error_code;
};

// The one table of statuses: what they say, and what CGAL's parameterizers call
// them. In the order of the enumeration.
inline const std::array<Status_entry, 26>& status_table()
{
  namespace SMP = Surface_mesh_parameterization;
  static const std::array<Status_entry, 26> table = {{
    { Status::OK, "success", SMP::OK },
    { Status::CONVERGED_TO_ROUNDING, "converged to the rounding of the number type", SMP::OK },
    { Status::EMPTY_MESH, "the mesh has no face", SMP::ERROR_EMPTY_MESH },
    { Status::NOT_TRIANGULATED, "the mesh has faces that are not triangles", SMP::ERROR_NON_TRIANGULAR_MESH },
    { Status::NON_MANIFOLD, "the mesh is not a manifold", SMP::ERROR_WRONG_PARAMETER },
    { Status::INVALID_NUMBER, "the mesh or the conditions hold an invalid number", SMP::ERROR_WRONG_PARAMETER },
    { Status::ZERO_LENGTH_EDGE, "the mesh has edges of length zero", SMP::ERROR_WRONG_PARAMETER },
    { Status::WRONG_TOPOLOGY, "the surface has the wrong topology", SMP::ERROR_NO_TOPOLOGICAL_DISC },
    { Status::GAUSS_BONNET_VIOLATED, "the prescribed angles violate the Gauss-Bonnet formula", SMP::ERROR_WRONG_PARAMETER },
    { Status::NO_ANGLE_LEFT, "the prescribed angles leave none for the vertices of fixed scale", SMP::ERROR_WRONG_PARAMETER },
    { Status::ANGLE_OUT_OF_RANGE, "a prescribed angle is out of range", SMP::ERROR_WRONG_PARAMETER },
    { Status::MISSING_CONDITION, "a condition is missing", SMP::ERROR_BORDER_TOO_SHORT },
    { Status::SINGULAR_PROBLEM, "the linear system cannot be factorized", SMP::ERROR_CANNOT_SOLVE_LINEAR_SYSTEM },
    { Status::ITERATIONS_EXHAUSTED, "the iteration did not converge", SMP::ERROR_CANNOT_SOLVE_LINEAR_SYSTEM },
    { Status::DEGENERATE_METRIC, "the metric violates the triangle inequality", SMP::ERROR_NO_1_TO_1_MAPPING },
    { Status::NOT_INJECTIVE, "the map is not injective", SMP::ERROR_NO_1_TO_1_MAPPING },
    { Status::SEAM_LEAVES_NO_DISK, "the seam does not cut the surface into a disk", SMP::ERROR_NO_TOPOLOGICAL_DISC },
    { Status::SEAM_MISSES_CONE, "the seam misses a cone", SMP::ERROR_NO_TOPOLOGICAL_DISC },
    { Status::STOPPED_BY_VISITOR, "stopped by the visitor", SMP::ERROR_WRONG_PARAMETER },
    { Status::OUT_OF_MEMORY, "out of memory", SMP::ERROR_CANNOT_SOLVE_LINEAR_SYSTEM },
    { Status::TOO_MANY_CROSSINGS, "the overlay of the triangulations has too many crossings", SMP::ERROR_WRONG_PARAMETER },
    { Status::NOT_REPRESENTABLE, "the mesh cannot hold the result", SMP::ERROR_WRONG_PARAMETER },
    { Status::TOO_MANY_CONES, "there are not enough vertices for the cones", SMP::ERROR_WRONG_PARAMETER },
    { Status::BOUND_NOT_MET, "the bound on the distortion was not met", SMP::ERROR_WRONG_PARAMETER },
    { Status::NOT_QUANTIZABLE, "the cones cannot have multiples of the angle quantum", SMP::ERROR_WRONG_PARAMETER },
    { Status::NOT_SEAMLESS, "the two sides of the seam do not differ by a multiple of the angle quantum", SMP::ERROR_WRONG_PARAMETER }
  }};
  return table;
}

inline const Status_entry& status_entry(Status status)
{
  return status_table()[static_cast<std::size_t>(status)];
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceStatus
/// returns a short English text for `status`.
inline std::string message(Status status) { return internal::status_entry(status).text; }

/// \ingroup PkgConformalEquivalenceStatus
/// returns the error code by which \cgal's parameterizers report `status`.
/// (\cgal's own `get_error_message()` is out of step with these codes: use `message()`.)
inline Surface_mesh_parameterization::Error_code to_error_code(Status status)
{
  return internal::status_entry(status).error_code;
}

/// \ingroup PkgConformalEquivalenceStatus
/// What a surface is made of, as found on import.
struct Surface_topology
{
  std::size_t number_of_vertices = 0;          ///< isolated ones included
  std::size_t number_of_edges = 0;             ///< edges with a face
  std::size_t number_of_faces = 0;             ///< triangles
  std::size_t number_of_isolated_vertices = 0; ///< vertices without a face: carried through untouched
  std::size_t number_of_components = 0;        ///< of the faces
  std::size_t number_of_borders = 0;           ///< border cycles
  std::size_t genus = 0;                       ///< sum over the components

  /// returns `true` iff the surface is one topological disk, apart from isolated vertices.
  bool is_disk() const
  {
    return number_of_components == 1 && number_of_borders == 1 && genus == 0;
  }
};

/// \ingroup PkgConformalEquivalenceEnums
/// To which metric the one found is conformally equivalent. These are different problems, with slightly different solutions.
enum class Conformal_class
{
  FIXED_TRIANGULATION,   ///< to the one given, on its triangulation: all length cross ratios are kept
  GIVEN_TRIANGULATION,   ///< to the one given, in the sense of discrete uniformization: with Ptolemy flips of its triangulation
  DELAUNAY_TRIANGULATION, ///< the same, with flips of its intrinsic Delaunay triangulation: depends on the surface alone
  REPAIRED               ///< to the one given, on a triangulation with some edges flipped or split where triangles broke: `repair_locally()`
};

/// \ingroup PkgConformalEquivalenceEnums
/// Whether a triangulation that was flipped is Delaunay, but for edges that cannot be flipped: those of the border, and those of a
/// triangle that is glued to itself.
enum class Delaunay_property
{
  NOT_ASKED,       ///< no edge was to be flipped
  EXACT,           ///< yes, by exact predicates on the numbers that are stored
  WITHIN_ROUNDING, ///< yes, for lengths that differ from those stored by no more than rounding can have done
  NO               ///< no: some edges were left
};

/// \ingroup PkgConformalEquivalenceEnums
/// In which numbers the linear systems of the last steps were solved, which reduce the residual of the wide number type.
enum class Refinement_arithmetic
{
  DOUBLE,       ///< in `double`, by the factor that was there
  WIDE_WEIGHTS, ///< in `double`, by the factor of a matrix computed in the wide type
  WIDE          ///< in the wide type
};

/// \ingroup PkgConformalEquivalenceStatus
/// Figures of one run of the solver.
struct Statistics
{
  /// Wall-clock seconds by stage; zero for stages that did not run.
  struct Seconds
  {
    double import = 0;  ///< from the mesh to arrays
    double solve = 0;   ///< conditions, Newton's method, verdict on the metric
    double discarded = 0; ///< part of `solve`: before flips of edges, or the double, were found to be needed
    double flips = 0;   ///< part of `solve`, after that: finding and flipping edges, and evaluating the gradient again after flips
    double cut = 0;     ///< cutting
    double layout = 0;  ///< laying out
    double verify = 0;  ///< orientations of the triangles
  };

  std::size_t number_of_iterations = 0;        ///< Newton steps: linearizations with an accepted step
  std::size_t number_of_linear_iterations = 0; ///< iterations of the preconditioned conjugate gradient method
  std::size_t number_of_factorizations = 0;    ///< numeric factorizations
  std::size_t number_of_evaluations = 0;       ///< evaluations of the gradient
  Conformal_class conformal_class = Conformal_class::FIXED_TRIANGULATION; ///< which problem was solved
  bool is_doubled = false;                     ///< whether the surface was solved as one half of its double
  std::size_t number_of_flips = 0;             ///< edges flipped
  std::size_t number_of_filter_failures = 0;   ///< of the decisions whether to flip, those for which `double` did not do
  std::size_t number_of_exact_decisions = 0;   ///< of these, those that needed rational numbers
  Delaunay_property delaunay = Delaunay_property::NOT_ASKED; ///< whether the triangulation found is Delaunay
  std::size_t number_of_discarded_iterations = 0; ///< Newton steps on the fixed triangulation, before flips were found to be needed
  double residual = 0;                         ///< largest difference of an angle sum from its target (radians)

  /// below it a residual cannot be told from rounding (radians): in `double`, or, if only this was reached, in the wide number type
  double residual_floor = 0;
  Refinement_arithmetic refinement_arithmetic = Refinement_arithmetic::DOUBLE; ///< in which the last steps were computed
  double angle_defect_spread = 0;              ///< total angle added to inexact targets to meet Gauss-Bonnet (radians)
  std::size_t number_of_regularized_rows = 0;  ///< zero rows of the Hessian that had to be regularized
  std::vector<double> residuals;               ///< the residual before each Newton step, and at the end
  Seconds seconds;                             ///< time by stage
};

/// \ingroup PkgConformalEquivalenceStatus
///
/// The lattice of a flat torus, the closed surface of genus 1 that needs no cone: laid out again and again, moved by all
/// sums of multiples of the periods, the torus covers the plane once.
template <typename NT = double>
struct Period_lattice
{
  /// a face of the torus: its index in an `Intrinsic_triangulation`, its position in `faces(tm)` for a mesh
  std::size_t face = 0;
  /// The two periods, in the coordinates of the layout. The basis is reduced: the first is a shortest period, the
  /// second a shortest one of the others; the second lies to the left of the first.
  std::array<std::array<NT, 2>, 2> periods = {{ {{NT(0), NT(0)}}, {{NT(0), NT(0)}} }};
  /// The second period divided by the first, in complex numbers: the point of the standard fundamental domain,
  /// |Re tau| <= 1/2, |tau| >= 1, that tells the conformal type of the torus. Of two such points on the boundary of the
  /// domain it is the right one (Re tau >= 0); what is on the boundary is decided up to 1e-10.
  std::array<NT, 2> tau = {{NT(0), NT(1)}};
};

/// \ingroup PkgConformalEquivalenceStatus
/// A cone of the flat metric that was found: an interior vertex with an angle sum other than 2 pi, or of fixed u.
template <typename TriangleMesh>
struct Cone
{
  typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex; ///< where it is
  std::size_t vertex_index; ///< position of `vertex` in `vertices(tm)`
  double angle;             ///< its angle sum, in radians: as prescribed, or as found for a free cone
  bool is_free;             ///< whether u was fixed, and the angle found
  double free_angle = 0;    ///< of a cone that was placed and rounded: its angle sum before, in radians; zero otherwise
  std::array<std::int64_t, 2> lattice_point = {{0, 0}}; ///< of a seamless layout: where it lies, see `Tiling`
};

/// \ingroup PkgConformalEquivalenceStatus
/// The motion z -> rotation * z + translation of the plane, in complex numbers, that takes one side of a
/// seam edge to the other: `halfedge`, as laid out with its face, to its opposite, as laid out with the other face.
template <typename TriangleMesh>
struct Seam_transition
{
  typename boost::graph_traits<TriangleMesh>::halfedge_descriptor halfedge; ///< one side
  std::array<double, 2> rotation;    ///< of absolute value 1
  std::array<double, 2> translation; ///< a point of the plane
  int quanta = 0;                    ///< of a seamless layout: the rotation, exactly, in multiples of 2 pi / n, from 0 to n - 1
  std::array<std::int64_t, 2> lattice_translation = {{0, 0}}; ///< of a seamless layout: the translation, exactly, see `Tiling`
};

/// \ingroup PkgConformalEquivalenceStatus
///
/// How a seamless layout fits the lattice of a texture. The lattice is Z + Z theta in the complex plane: for n = 2 and 4 the Gaussian integers,
/// theta = i, and the tiles are unit squares with the integers in their centres; for n = 3 and 6 the Eisenstein integers, theta = e^{i pi / 3}, and the tiles
/// are regular hexagons about them. A point a + b theta of the lattice is given as the pair of integers (a, b).
struct Tiling
{
  int symmetry = 0;             ///< n: motions across seams turn by multiples of 2 pi / n. Zero: the layout is not seamless
  double number_of_tiles = 0;   ///< the area of the layout over that of a tile
  double scale = 0;             ///< by which lengths of the flat metric were multiplied
  double rotation = 0;          ///< by which the canonical layout was turned (radians)
  double mean_distortion = 1;   ///< mean quasi-conformal factor of the deformation, from the flat surface to the layout; 1 if none was needed
  double maximum_distortion = 1; ///< the largest one
  double mean_factor_before = 1; ///< mean quasi-conformal factor, from the mesh, of the conformal layout that was deformed
  double mean_factor = 1;       ///< the same of the result. Means are weighted by the areas of the faces of the mesh
  bool is_closest = true;       ///< whether the positions of the cones are proven to be those of least distortion for scale and rotation
};

/// \ingroup PkgConformalEquivalenceStatus
/// What a function of this package reports about a mesh.
template <typename TriangleMesh>
struct [[nodiscard]] Flattening_report
{
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor vertex_descriptor; ///< a vertex of the mesh
  typedef typename boost::graph_traits<TriangleMesh>::edge_descriptor   edge_descriptor;   ///< an edge of the mesh
  typedef typename boost::graph_traits<TriangleMesh>::face_descriptor   face_descriptor;   ///< a face of the mesh

  Status status = Status::OK; ///< what happened

  /// How much: see the documentation of the status.
  double amount = 0;

  /// \name Elements at fault
  /// Each with its position in `vertices(tm)` and `faces(tm)`; an edge is named
  /// by the positions of its two vertices.
  /// @{
  std::vector<vertex_descriptor> vertices;                 ///< vertices at fault
  std::vector<edge_descriptor> edges;                      ///< edges at fault
  std::vector<face_descriptor> faces;                      ///< faces at fault
  std::vector<std::size_t> vertex_indices;                 ///< positions of `vertices`
  std::vector<std::array<std::size_t, 2> > edge_indices;   ///< positions of the ends of `edges`
  std::vector<std::size_t> face_indices;                   ///< positions of `faces`
  /// @}

  Surface_topology topology; ///< what the surface was found to be
  Statistics statistics;     ///< figures of the run

  /// Largest relative difference of an edge length in the layout from the length
  /// that the metric gives it; zero if nothing was laid out.
  double layout_length_error = 0;

  /// \name What was found
  /// Empty unless there is a layout.
  /// @{
  std::vector<Cone<TriangleMesh> > cones;                    ///< in the order of `vertices(tm)`
  std::vector<Seam_transition<TriangleMesh> > transitions;   ///< one for every edge of the seam; none across the borders of charts
  std::vector<Period_lattice<> > lattices;                   ///< of the tori, in the order of their first faces

  Tiling tiling;                                             ///< of a seamless layout

  /// cones that were placed, but became flat when their angles were rounded
  std::vector<vertex_descriptor> flattened_cones;

  /// border edges that were flipped away: with fixed u at both ends these need not be as long as that makes them
  std::vector<edge_descriptor> lost_border_edges;

  /// faces whose images are positive in the common refinement, while the straight triangles between the images of their corners are
  /// flipped or flat; none unless a refinement was asked for
  std::vector<face_descriptor> bent_faces;

  /// on the sphere and the disk: faces whose images, or parts of them, are positive as they were computed, but not with the points
  /// rounded to the number type of the result
  std::vector<face_descriptor> rounded_faces;

  /// on the sphere: the sum of the solid angles of all triangles of the polyhedron, 4 pi
  double solid_angle = 0;

  /// @}

  /// is `true` iff the result is usable.
  explicit operator bool() const { return is_success(status); }
};

namespace internal {

template <typename Range, typename Print>
void print_elements(std::ostream& out, const char* singular, const char* plural,
                    const Range& elements, Print print)
{
  if(elements.empty())
    return;
  const std::size_t shown = (std::min)(elements.size(), std::size_t(10));
  out << "; " << (elements.size() == 1 ? singular : plural);
  for(std::size_t i = 0; i < shown; ++i)
    print(out << (i == 0 ? " " : ", "), elements[i]);
  if(shown < elements.size())
    out << ", ... (" << elements.size() << " in all)";
}

inline void print_topology(std::ostream& out, const Surface_topology& topology)
{
  const auto count = [&](std::size_t n, const char* what) { out << n << ' ' << what << (n == 1 ? "" : "s"); };
  out << ": found ";
  count(topology.number_of_components, "component");
  out << ", ";
  count(topology.number_of_borders, "border");
  out << ", genus " << topology.genus;
}

inline void print_amount(std::ostream& out, Status status, double amount)
{
  switch(status)
  {
    case Status::CONVERGED_TO_ROUNDING:
    case Status::ITERATIONS_EXHAUSTED:  out << ": residual " << amount << " radians"; break;
    case Status::GAUSS_BONNET_VIOLATED: out << " by " << amount << " radians"; break;
    case Status::NO_ANGLE_LEFT:         out << ": " << amount << " radians"; break;
    case Status::MISSING_CONDITION:
      if(amount != 0)
        out << ": a closed surface of genus other than 1 needs cones, whose curvatures (2 pi - angle) sum up to "
            << amount << " radians";
      break;
    case Status::ANGLE_OUT_OF_RANGE:    out << ": " << amount << " radians"; break;
    case Status::TOO_MANY_CROSSINGS:
    case Status::TOO_MANY_CONES:
    case Status::BOUND_NOT_MET:         out << ": " << amount; break;
    case Status::NOT_QUANTIZABLE:       out << ": they must sum up to " << amount << " radians"; break;
    case Status::NOT_SEAMLESS:          out << ": they differ by a rotation by " << amount << " radians"; break;
    default: break;
  }
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceStatus
/// returns one line of English that says what happened, by how much, and where
/// (elements by position, the first ten of each kind).
template <typename TriangleMesh>
std::string message(const Flattening_report<TriangleMesh>& report)
{
  std::ostringstream out;
  out << message(report.status);
  internal::print_amount(out, report.status, report.amount);
  if(report.status == Status::WRONG_TOPOLOGY || report.status == Status::SEAM_LEAVES_NO_DISK)
    internal::print_topology(out, report.topology);
  internal::print_elements(out, "vertex", "vertices", report.vertex_indices,
                           [](std::ostream& o, std::size_t v) { o << v; });
  internal::print_elements(out, "edge", "edges", report.edge_indices,
                           [](std::ostream& o, const std::array<std::size_t, 2>& e) { o << e[0] << '-' << e[1]; });
  internal::print_elements(out, "face", "faces", report.face_indices,
                           [](std::ostream& o, std::size_t f) { o << f; });
  return out.str();
}

/// \ingroup PkgConformalEquivalenceEnums
/// Whether the triangulation may be changed on the way to the metric.
enum class Retriangulation
{
  NEVER,       ///< the fixed triangulation of the paper; the minimizer may be no metric
  WHEN_NEEDED, ///< the fixed triangulation first, Ptolemy flips only if it has no solution
  ALWAYS       ///< intrinsic Delaunay triangulation first: the result depends on the surface alone
};

/// \ingroup PkgConformalEquivalenceEnums
/// Whether edges of the border may be flipped, too, where the triangulation may be changed.
enum class Border_edges
{
  KEPT,     ///< no: all of them keep the length e^{(u_i + u_j) / 2} l; where that leaves triangles at the border broken, there is no metric
  FLIPPABLE ///< only where there is no metric with all border edges kept: then on the double of the surface. The border consists of straight lines then, too
};

/// \ingroup PkgConformalEquivalenceEnums
/// How Newton's method is made globally convergent.
enum class Newton_strategy
{
  LINE_SEARCH,  ///< inexact Newton steps, line search on the directional derivative; a trust region where triangles are broken
  TRUST_REGION  ///< Newton-Steihaug: truncated conjugate gradients in a trust region
};

/// \ingroup PkgConformalEquivalenceEnums
/// What a visitor is told that begins.
enum class Stage
{
  IMPORT, ///< from the mesh to arrays
  SOLVE,  ///< Newton's method
  CUT,    ///< cutting the surface open
  LAYOUT, ///< from lengths to points of the plane
  VERIFY  ///< orientations of the triangles
};

/// \ingroup PkgConformalEquivalenceStatus
/// The visitor that does nothing: model of `ConformalEquivalenceVisitor`.
struct Default_visitor
{
  /// does nothing.
  void on_stage(Stage) {}
  /// does nothing.
  void on_iteration(std::size_t /* iteration */, double /* residual */) {}
  /// returns `true`.
  bool go_further() { return true; }
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_STATUS_H
