// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Hyperbolic_uniformization.h
/// A surface as the quotient of the hyperbolic plane by a group: what `uniformize_hyperbolic()` returns (section 6 of Bobenko, Pinkall and
/// Springborn, "Discrete conformal maps and ideal hyperbolic polyhedra", 2015; Springborn, "Ideal hyperbolic polyhedra and discrete
/// uniformization", 2020).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_HYPERBOLIC_UNIFORMIZATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_HYPERBOLIC_UNIFORMIZATION_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Hyperbolic_metric.h>
#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Isometry.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Precise_number.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceHyperbolic
///
/// The hyperbolic metric of a surface, and, if the surface is connected, its layout in the unit disk (Poincaré's model). A surface with border that
/// was solved by its double, of which the border is a geodesic, is laid out as this double: what belongs to the surface has the same numbers there.
///
/// Without cones and borders there is a group. Every vertex has one chosen *lift* in the disk. A halfedge from i to j, lifted such that it begins at
/// the lift of i, ends at the lift of j moved by a deck transformation, whose word is the *label* of the halfedge: the letter k > 0 stands for
/// `generators[k - 1]`, and -k for its inverse; a word means the product of its letters.
struct Hyperbolic_uniformization : public Outcome
{
  typedef std::uint32_t Index;  ///< of vertices, halfedges, edges and faces
  typedef Hyperbolic_metric<double>::Wide_number Wide_number; ///< a number with the digits of two `double`

  /// The motion z -> (a z + b) / (conj(b) z + conj(a)) of the disk, with |a|^2 - |b|^2 = 1, in complex numbers.
  struct Motion
  {
    std::array<double, 2> a; ///< real and imaginary part
    std::array<double, 2> b; ///< real and imaginary part
  };

  Hyperbolic_metric<double> metric;   ///< lengths and scale factors; its `triangulation` is the one that is Delaunay
  std::size_t genus = 0;              ///< of what is laid out
  bool is_doubled = false;            ///< whether `metric`, and all that follows, is that of the double of a surface with border

  /// \name Layout
  /// Empty if nothing was laid out: if the surface is not connected, or has vertices without a face. With cones, or a border where u is
  /// prescribed, there are `vertex_points`, `corner_points`, `is_seam`, `generators` and `relation_error` only: the surface is cut along seams that
  /// join the cones, and end there or at the border.
  /// @{

  std::vector<std::array<double, 2> > vertex_points; ///< the chosen lifts, by vertex

  /// by halfedge of the triangulation *given*: where its target lies in the domain that is laid out
  std::vector<std::array<double, 2> > corner_points;
  std::vector<char> is_seam;                         ///< by edge of the triangulation given: whether its sides lie at different places

  /// labels of the halfedges of `metric.triangulation`
  std::vector<std::vector<std::int32_t> > labels;
  /// labels of the halfedges of the triangulation given
  std::vector<std::vector<std::int32_t> > input_labels;
  /// the lift of the target of a halfedge of the triangulation given that lies at its `corner_points`: the chosen one, moved by this word
  std::vector<std::vector<std::int32_t> > corner_words;

  /// of 2g loops through one vertex, the shortest ones. With cones or borders: one for each path of seams, from the place of one side to that of
  /// the other
  std::vector<Motion> generators;
  std::vector<std::int32_t> relation;                ///< the relation of the generators, a word of 4g letters

  /// canonical generators a_1, b_1, ..., a_g, b_g, for which the product of commutators a_1 b_1 a_1^-1 b_1^-1 ... is 1, as words in `generators`
  std::vector<std::vector<std::int32_t> > canonical_words;
  std::vector<Motion> canonical_generators;          ///< the canonical generators

  /// how far the relation, computed from generators with twice the digits of `double`, or more if these do not do, is from the identity. With cones
  /// or borders: the largest such error of the motion once around a vertex, which is the identity, or at a cone the rotation by its angle
  double relation_error = 0;

  /// @}

  /// the generators, to twice the digits of `double`
  std::vector<internal::Isometry<Wide_number> > wide_generators;
  /// the same with more digits, if for the relation twice those of `double` do not do; else empty
  std::vector<internal::Isometry<internal::Precise_number> > precise_generators;
  /// by vertex: the motion that takes the center to the chosen lift, to all the digits that are known
  std::vector<internal::Isometry<Wide_number> > wide_frames;

  /// is `true` iff there is a layout.
  bool is_laid_out() const { return !vertex_points.empty(); }

  /// is `true` iff there is a group: for closed connected surfaces without cones.
  bool has_group() const { return !wide_generators.empty(); }
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_HYPERBOLIC_UNIFORMIZATION_H
