// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Common_refinement.h
/// The map of a surface to a flat metric that needed flips, as a value. Where the triangulation was flipped (section 3.2 of Springborn,
/// Schroeder and Pinkall, 2008; Gillespie, Springborn and Crane, 2021), straight triangles between the images of the vertices are not
/// the image of the surface: an edge of the input becomes a broken line. Cut along the edges of both triangulations, the surface is
/// made of convex polygons, each of which is mapped projectively, as a triangle in section 3.4 of the paper is; together they are
/// a continuous map, one-to-one around every point that is no cone.
///
///           k                          k
///         / | \                      / | \        The edge ij of the input, and the edge kl that has replaced it: their crossing
///       /   |   \                  /   |   \      becomes a vertex x with a place on the input edge, one on the flat edge,
///     i-----x-----j     --->     i-----x-____\    and a weight.
///       \   |   /                  \   |     j    .
///         \ | /                      \ |   /
///           l                          l

#ifndef CGAL_CONFORMAL_EQUIVALENCE_COMMON_REFINEMENT_H
#define CGAL_CONFORMAL_EQUIVALENCE_COMMON_REFINEMENT_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Outcome.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// The overlay of the triangulation that was given to the solver and the triangulation of the metric found, laid out.
///
/// The vertices are those of the input, with their numbers, then the crossings. Every face is a convex polygon of at most six corners, a
/// part of one face of the input and of one of `Conformal_metric::triangulation`; all of its points are mapped by one projective map:
/// with barycentric coordinates b of the corners, as points of the input face, the homogeneous coordinates are the sum
/// of the b w (x, y, 1) with the weight w and the point (x, y) of each corner.
///
/// The status is `OK`, `EMPTY_MESH`, `TOO_MANY_CROSSINGS` (more than allowed), or `OUT_OF_MEMORY`; `amount` is the number of crossings, for a
/// metric of the double that of both halves.
///
/// \tparam NT_ number type of the coordinates: that of the metric
template <typename NT_ = double>
struct Common_refinement : public Outcome
{
  typedef NT_ NT;               ///< number type of the coordinates
  typedef std::uint32_t Index;  ///< of vertices, edges and faces

  /// stands for "no such element".
  static constexpr Index null_index = (std::numeric_limits<Index>::max)();

  /// Where an edge of the input crosses an edge of the metric's triangulation.
  struct Crossing
  {
    Index input_edge;    ///< an edge of the input
    NT input_parameter;  ///< where on it: 0 at the origin, 1 at the target of its `edge_halfedge()`
    Index flat_edge;     ///< an edge of `Conformal_metric::triangulation`

    /// where on it, before it was scaled: 0 at the origin, 1 at the target of its `edge_halfedge()`. With the weights e^{-u} of
    /// the ends, it is the projective parameter in the flat metric.
    NT flat_parameter;
  };

  Index number_of_input_vertices = 0;  ///< isolated ones included
  std::vector<Crossing> crossings;     ///< the crossing `c` is the vertex `number_of_input_vertices + c`
  std::vector<NT> weights;             ///< by vertex: w, scaled to a maximum of 1 among the vertices of the input; 1 for isolated vertices

  /// \name Faces
  /// The corners of the face `f` are those with the numbers `first_corner[f]`, ..., `first_corner[f + 1] - 1`, counterclockwise.
  /// @{
  std::vector<std::size_t> first_corner;      ///< one more than there are faces
  std::vector<Index> input_face;              ///< by face: the face of the input
  std::vector<Index> flat_face;               ///< by face: the face of `Conformal_metric::triangulation`

  /// @}

  /// \name Corners
  /// @{
  std::vector<Index> corner_vertex;           ///< by corner: its vertex
  std::vector<std::array<NT, 2> > corner_uv;  ///< by corner: its point of the plane. Corners of a vertex that no cut separates are equal.

  /// by corner: the halfedge of the input along which the side from this corner to the next one runs, with the face on its left;
  /// `null_index` if the side lies within the input face
  std::vector<Index> corner_halfedge;
  /// @}

  /// \name Verdict
  /// A face is *positive* if it is a strictly convex polygon, counterclockwise. Positive faces whose angles sum up to 2 pi around every vertex
  /// that is no cone make the map one-to-one around every such point.
  /// @{
  std::vector<Index> flipped_faces;  ///< the faces that are not positive, for the coordinates as computed
  std::vector<Index> rounded_faces;  ///< the faces that are, but no longer with the coordinates rounded to `NT`, which are those of `corner_uv`
  std::vector<double> angle_sums;    ///< by vertex of the input: the sum of the angles of the layout there, in radians

  /// @}

  Index number_of_vertices() const { return number_of_input_vertices + Index(crossings.size()); } ///< of the overlay
  Index number_of_faces() const { return Index(input_face.size()); }                             ///< of the overlay

  /// is `true` iff all faces are positive, as rounded.
  bool is_positive() const { return flipped_faces.empty() && rounded_faces.empty(); }
};

/// \ingroup PkgConformalEquivalenceLayout
/// The number of crossings beyond which `compute_common_refinement()` refuses an overlay unless told otherwise: some 3 gigabytes.
constexpr std::uint64_t default_maximum_number_of_crossings = 10000000;

/// \ingroup PkgConformalEquivalenceLayout
///
/// returns the barycentric coordinates, in the input face of the face `f`, of the point of the input surface that is the corner number
/// `corner` of the refinement, one of the corners of `f`; entry `k` belongs to the origin of the halfedge `3 * input_face[f] + k`. O(1).
template <typename NT>
std::array<NT, 3> input_barycentric(const Intrinsic_triangulation<NT>& input, const Common_refinement<NT>& refinement,
                                    std::uint32_t f, std::size_t corner)
{
  typedef std::uint32_t Index;
  const std::size_t first = refinement.first_corner[f], last = refinement.first_corner[f + 1] - 1;
  const Index after = refinement.corner_halfedge[corner],
              before = refinement.corner_halfedge[corner == first ? last : corner - 1],
              beyond = refinement.corner_halfedge[corner == last ? first : corner + 1];
  const Index none = refinement.null_index, face = refinement.input_face[f], v = refinement.corner_vertex[corner];
  std::array<NT, 3> result = {{NT(0), NT(0), NT(0)}};
  if(v < refinement.number_of_input_vertices)
  {
    Index h = after != none ? after : before != none ? input.next(before) : beyond != none ? input.previous(beyond) : input.halfedge(face);
    while(input.origin(h) != v) // at a corner between diagonals of a part no side is known
      h = input.next(h);
    result[h % 3] = NT(1);
    return result;
  }
  const auto& crossing = refinement.crossings[v - refinement.number_of_input_vertices];
  const Index first_side = input.edge_halfedge(crossing.input_edge);
  const Index h = after != none ? after : before != none ? before
                : input.face(first_side) == face ? first_side : input.twin(first_side);
  const bool is_first = h == input.edge_halfedge(crossing.input_edge);
  result[(is_first ? h : input.next(h)) % 3] = 1 - crossing.input_parameter;
  result[(is_first ? input.next(h) : h) % 3] = crossing.input_parameter;
  return result;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_COMMON_REFINEMENT_H
