// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file options.h
/// The choices that named parameters take: enumerations, and the visitor that does nothing.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_OPTIONS_H
#define CGAL_CONFORMAL_EQUIVALENCE_OPTIONS_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <cstddef>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceEnums
/// Whether the triangulation may be changed on the way to the metric.
enum class Retriangulation
{
  NEVER,       ///< the fixed triangulation of the paper; the minimizer may be no metric
  /// the fixed triangulation first, Ptolemy flips only if it has no solution. Faces of no area, which no metric has, are resolved before by
  /// flips of their longest edges, which leave the surface as it is
  WHEN_NEEDED,
  ALWAYS       ///< intrinsic Delaunay triangulation first: the result depends on the surface alone
};

/// \ingroup PkgConformalEquivalenceEnums
/// Whether edges of the border may be flipped, too, where the triangulation may be changed.
enum class Border_edges
{
  KEPT,     ///< no: all of them keep the length e^{(u_i + u_j) / 2} l; where that leaves triangles at the border broken, there is no metric
  /// only where there is no metric with all border edges kept: then on the double of the surface. The border consists of straight lines
  /// then, too
  FLIPPABLE
};

/// \ingroup PkgConformalEquivalenceEnums
/// How Newton's method is made globally convergent.
enum class Newton_strategy
{
  LINE_SEARCH,  ///< inexact Newton steps, line search on the directional derivative; a trust region where triangles are broken
  TRUST_REGION  ///< Newton-Steihaug: truncated conjugate gradients in a trust region
};

/// \ingroup PkgConformalEquivalenceEnums
/// By what placements of cones are compared: the less the better.
enum class Cone_measure
{
  MAXIMUM_U,          ///< the largest |u|, as in section 5.1 of Springborn, Schroeder and Pinkall, 2008
  /// the area-weighted root mean square of u, less its mean: the measure of Soliman, Slepcev and Crane, "Optimal Cone Singularities for Conformal
  /// Flattening", 2018. It has one best choice of angles
  ROOT_MEAN_SQUARE_U,
  AREA_DISTORTION,    ///< the largest factor, or its inverse, by which areas are scaled relative to the mean
  /// the Dirichlet energy of u: how much the scale varies, over the whole surface. Cones are placed with u = 0, as by `Cone_angles::ZERO_U`
  DIRICHLET_ENERGY
};

/// \ingroup PkgConformalEquivalenceEnums
/// What determines the angles of cones that are placed.
enum class Cone_angles
{
  CHOSEN, ///< they are chosen with the places, so that the measure is small
  ZERO_U  ///< u = 0 at the cones, as in section 5.1 of Springborn, Schroeder and Pinkall, 2008; multiples of a quantum are the nearest ones to these
};

/// \ingroup PkgConformalEquivalenceEnums
/// The coordinates in which a seamless layout is given.
enum class Seamless_coordinates
{
  CARTESIAN, ///< of the plane, a tile having the side 1 (squares), or its neighbors at the distance 1 (hexagons)
  LATTICE    ///< (a, b) for a + b theta, see `Tiling`: for n = 2 and 4 the same; for n = 3 and 6 the coordinates in which seams are exact
};

/// \ingroup PkgConformalEquivalenceEnums
/// What has its barycentre in the centre of the sphere, or of the disk, when a Moebius transformation is chosen.
enum class Moebius_weights
{
  VERTICES, ///< the vertices
  AREAS     ///< the vertices, each with a third of the area of its triangles on the surface given
};

/// \ingroup PkgConformalEquivalenceEnums
/// What a visitor is told that begins.
enum class Stage
{
  IMPORT, ///< from the mesh to arrays
  SOLVE,  ///< Newton's method
  CUT,    ///< cutting the surface open
  LAYOUT, ///< from lengths to points of the plane
  VERIFY, ///< orientations of the triangles
  PLACE,  ///< the search for places of cones
  CORNERS, ///< the search for the corners of a rectangle
  FLIP,   ///< flips of edges, as a part of `SOLVE`: told of by `on_progress()` only, where they take long
  POSITIONS ///< the search for the lattice points of the cones of a seamless layout
};

/// \ingroup PkgConformalEquivalenceStatus
/// What is done in a stage, in one word or two: "solving", for example.
inline const char* stage_name(Stage stage)
{
  switch(stage)
  {
    case Stage::IMPORT: return "importing";
    case Stage::SOLVE:  return "solving";
    case Stage::CUT:    return "cutting";
    case Stage::LAYOUT: return "laying out";
    case Stage::VERIFY: return "verifying";
    case Stage::PLACE:  return "placing cones";
    case Stage::CORNERS: return "choosing corners";
    case Stage::FLIP:   return "flipping edges";
    case Stage::POSITIONS: return "choosing lattice points";
  }
  return "";
}

/// \ingroup PkgConformalEquivalenceStatus
/// The visitor that does nothing: model of `ConformalEquivalenceVisitor`.
struct Default_visitor
{
  /// does nothing.
  void on_stage(Stage) {}
  /// does nothing.
  void on_iteration(std::size_t /* iteration */, double /* residual */) {}
  /// does nothing.
  void on_progress(Stage, std::size_t /* number */, double /* measure */) {}
  /// returns `true`.
  bool go_further() { return true; }
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_OPTIONS_H
