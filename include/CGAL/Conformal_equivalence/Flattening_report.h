// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Flattening_report.h
/// What the functions of this package report about a mesh: what happened, the elements at fault, what was found, and one line of English
/// that tells it.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_FLATTENING_REPORT_H
#define CGAL_CONFORMAL_EQUIVALENCE_FLATTENING_REPORT_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

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
/// How a seamless layout fits the lattice of a texture. The lattice is Z + Z theta in the complex plane: for n = 2 and 4 the Gaussian
/// integers, theta = i, and the tiles are unit squares with the integers in their centres; for n = 3 and 6 the Eisenstein integers,
/// theta = e^{i pi / 3}, and the tiles are regular hexagons about them. A point a + b theta of the lattice is given as the pair of
/// integers (a, b).
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
  std::size_t number_of_wound_vertices = 0; ///< vertices around which triangles, all of them positive, go a full turn too often, or not
                                ///< often enough, as a coarse mesh has no room for some cones. Layouts without such vertices are preferred
  bool is_closest = true;       ///< whether the positions of the cones are proven to be those of least distortion for scale and rotation
};

/// \ingroup PkgConformalEquivalenceStatus
/// Whether there is a flat surface of a given genus with given cones and given rotations of its handles, on any triangulation.
enum class Surface_existence
{
  PROVEN,    ///< there is one
  EXPECTED,  ///< there is no theorem that was relied upon, and no reason why not
  IMPOSSIBLE ///< there is none
};

/// \ingroup PkgConformalEquivalenceStatus
/// How a closed curve on a surface with handles turns in the flat metric: the integral of its geodesic curvature.
template <typename TriangleMesh>
struct Turned_loop
{
  /// the halfedges through which the curve enters faces, in order
  std::vector<typename boost::graph_traits<TriangleMesh>::halfedge_descriptor> halfedges;
  double conformal_turning; ///< in the conformally equivalent metric with the same cones (radians)
  long quanta;              ///< in the metric found, in multiples of 2 pi / n
};

/// \ingroup PkgConformalEquivalenceStatus
/// How the handles of a surface, and all its borders but one, were turned, so that it has a seamless parameterization, and how far that led out of
/// the conformal class.
template <typename TriangleMesh>
struct Handle_turning
{
  std::vector<Turned_loop<TriangleMesh> > loops; ///< a basis of the first homology; empty unless there are handles, or several borders
  bool is_nearest = true;          ///< whether the turnings are proven to be those that take the least deformation, to first order
  Surface_existence existence = Surface_existence::PROVEN; ///< what is known of surfaces with these cones and turnings
  double mean_departure = 0;       ///< root of the mean square of the changes of the logarithms of the length cross ratios; 0: conformal
  double maximum_departure = 0;    ///< the largest of their absolute values
  double residual = 0;             ///< largest difference of a turning from its multiple (radians)
  std::size_t number_of_steps = 0; ///< Newton steps from the conformally equivalent metric
  std::size_t number_of_flips = 0; ///< of edges, on the way
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
  Handle_turning<TriangleMesh> handles;                      ///< of a seamless layout of a surface with handles

  /// cones that were placed, but became flat when their angles were rounded
  std::vector<vertex_descriptor> flattened_cones;

  /// border edges that were flipped away: with fixed u at both ends these need not be as long as that makes them
  std::vector<edge_descriptor> lost_border_edges;

  /// faces whose images are positive in the common refinement, while the straight triangles between the images of their corners are
  /// flipped or flat; none unless a refinement was asked for
  std::vector<face_descriptor> bent_faces;

  /// faces of no area in the surface given that flips have resolved (`Statistics::number_of_resolving_flips`): their images are segments up to
  /// rounding, or, where the surface is curved, as good as segments, so that it does not count if they are not positive
  std::vector<face_descriptor> flat_faces;

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

// A number with six significant digits, as streams print it.
inline std::string number_text(double x)
{
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%g", x);
  return text.data();
}

// "; vertices 1, 2, 3": the first ten elements, each as `text_of_element` tells it.
template <typename Range, typename Text>
CGAL_CONFORMAL_EQUIVALENCE_COLD
std::string elements_text(const char* singular, const char* plural, const Range& elements, Text text_of_element)
{
  if(elements.empty())
    return std::string();
  const std::size_t shown = (std::min)(elements.size(), std::size_t(10));
  std::string result = std::string("; ") + (elements.size() == 1 ? singular : plural);
  for(std::size_t i = 0; i < shown; ++i)
    result += (i == 0 ? " " : ", ") + text_of_element(elements[i]);
  if(shown < elements.size())
    result += ", ... (" + std::to_string(elements.size()) + " in all)";
  return result;
}

template <typename Index>
CGAL_CONFORMAL_EQUIVALENCE_COLD
std::string elements_text(const std::vector<Index>& vertices, const std::vector<std::array<Index, 2> >& edges,
                          const std::vector<Index>& faces)
{
  const auto number = [](Index i) { return std::to_string(i); };
  const auto ends = [](const std::array<Index, 2>& e) { return std::to_string(e[0]) + '-' + std::to_string(e[1]); };
  return elements_text("vertex", "vertices", vertices, number) + elements_text("edge", "edges", edges, ends)
         + elements_text("face", "faces", faces, number);
}

CGAL_CONFORMAL_EQUIVALENCE_COLD
inline std::string topology_text(const Surface_topology& topology)
{
  const auto count = [](std::size_t n, const char* what) { return std::to_string(n) + ' ' + what + (n == 1 ? "" : "s"); };
  return ": found " + count(topology.number_of_components, "component") + ", " + count(topology.number_of_borders, "border")
         + ", genus " + std::to_string(topology.genus);
}

// What `amount` is, for the statuses that have one.
CGAL_CONFORMAL_EQUIVALENCE_COLD
inline std::string amount_text(Status status, double amount)
{
  const std::string number = number_text(amount);
  switch(status)
  {
    case Status::CONVERGED_TO_ROUNDING:
    case Status::ITERATIONS_EXHAUSTED:  return ": residual " + number + " radians";
    case Status::GAUSS_BONNET_VIOLATED: return " by " + number + " radians";
    case Status::NO_ANGLE_LEFT:
    case Status::ANGLE_OUT_OF_RANGE:    return ": " + number + " radians";
    case Status::MISSING_CONDITION:
      return amount == 0 ? std::string()
                         : ": a closed surface of genus other than 1 needs cones, whose curvatures (2 pi - angle) sum up to "
                           + number + " radians";
    case Status::SCALE_OUT_OF_RANGE:    return ": u ranges over " + number;
    case Status::TOO_MANY_CROSSINGS:
    case Status::TOO_MANY_CONES:
    case Status::BOUND_NOT_MET:         return ": " + number;
    case Status::NOT_QUANTIZABLE:       return ": they must sum up to " + number + " radians";
    case Status::NOT_SEAMLESS:          return ": they differ by a rotation by " + number + " radians";
    default:                            return std::string();
  }
}

// The line of English for a report; elements by their positions, of type `Index`.
template <typename Index>
std::string message_text(Status status, double amount, const Surface_topology& topology, const std::vector<Index>& vertices,
                         const std::vector<std::array<Index, 2> >& edges, const std::vector<Index>& faces)
{
  const bool is_about_topology = status == Status::WRONG_TOPOLOGY || status == Status::SEAM_LEAVES_NO_DISK;
  return message(status) + amount_text(status, amount) + (is_about_topology ? topology_text(topology) : std::string())
         + elements_text(vertices, edges, faces);
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template std::string message_text(Status, double, const Surface_topology&, const std::vector<std::size_t>&,
                                         const std::vector<std::array<std::size_t, 2> >&, const std::vector<std::size_t>&);
#endif

} // namespace internal

/// \ingroup PkgConformalEquivalenceStatus
/// returns one line of English that says what happened, by how much, and where
/// (elements by position, the first ten of each kind).
template <typename TriangleMesh>
std::string message(const Flattening_report<TriangleMesh>& report)
{
  return internal::message_text(report.status, report.amount, report.topology, report.vertex_indices, report.edge_indices,
                                report.face_indices);
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_FLATTENING_REPORT_H
