// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Layout.h
/// A flat surface laid out in the plane (section 3.3 of Springborn, Schroeder and
/// Pinkall, 2008), and how the result is placed there.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_LAYOUT_H
#define CGAL_CONFORMAL_EQUIVALENCE_LAYOUT_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Outcome.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// The motion z -> rotation * z + translation, in complex numbers, that takes one
/// side of a cut edge to the other: `halfedge`, as laid out with its face, to its
/// twin, as laid out with the other face.
template <typename NT = double>
struct Transition
{
  std::uint32_t halfedge;            ///< the one with the smaller index
  std::array<NT, 2> rotation;        ///< of absolute value 1
  std::array<NT, 2> translation;     ///< a point of the plane
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

/// \ingroup PkgConformalEquivalenceLayout
///
/// A point of the plane for every corner of a triangulation. Its status is `OK`, or `EMPTY_MESH` if there is no face.
template <typename NT_ = double>
struct Layout : public Outcome
{
  typedef NT_ NT; ///< number type of the coordinates

  /// by halfedge `h` of the input triangulation: where `target(h)` lies in the
  /// triangle of `h`. Corners of a vertex that no cut separates are equal.
  std::vector<std::array<NT, 2> > corner;
  /// largest relative difference of an edge's length, as laid out and rounded, from its length in the metric
  double length_error = 0;
  /// by edge, if the triangulation was flipped: the length in the flat surface of the straight line that replaces it.
  /// Empty if not: edges then are straight lines, of the scaled lengths.
  std::vector<NT> straight_lengths;
  std::vector<Transition<NT> > transitions;  ///< one for every cut edge, by index
  std::vector<Period_lattice<NT> > lattices; ///< of the flat tori, by their first face
};

/// \ingroup PkgConformalEquivalenceEnums
/// How a layout is placed in the plane. Orientation is always kept.
/// If there are several pieces, each is turned so that its longest principal axis is horizontal, and they are put beside one
/// another in rows, apart from each other.
enum class Layout_frame
{
  CANONICAL,   ///< not scaled; barycentre of the area in the origin, longest principal axis horizontal
  UNIT_SQUARE  ///< as `CANONICAL`, then scaled and moved to fit into [0, 1] x [0, 1], touching both axes
};

/// \ingroup PkgConformalEquivalenceLayout
///
/// The frame in which two vertices lie at given points: the value of the named
/// parameter `layout_frame` instead of a `Layout_frame`.
/// \tparam Vertex a vertex descriptor, or `std::uint32_t` for an `Intrinsic_triangulation`
template <typename Vertex>
struct Pinned_frame
{
  Vertex first;                        ///< one vertex
  std::array<double, 2> first_point;   ///< where it lies
  Vertex second;                       ///< another vertex
  std::array<double, 2> second_point;  ///< where that lies
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_LAYOUT_H
