// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Exact_hyperbolic_surface.h
/// A closed hyperbolic surface in rational numbers, near to one that was computed in floating-point numbers. (The surfaces are those of section 6
/// of Bobenko, Pinkall and Springborn, "Discrete conformal maps and ideal hyperbolic polyhedra", 2015.)

#ifndef CGAL_CONFORMAL_EQUIVALENCE_EXACT_HYPERBOLIC_SURFACE_H
#define CGAL_CONFORMAL_EQUIVALENCE_EXACT_HYPERBOLIC_SURFACE_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Hyperbolic_uniformization.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Exact_isometry.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Exact_realization.h>

#include <CGAL/Exact_rational.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceHyperbolic
///
/// A closed hyperbolic surface with a triangulation whose vertices, lifted to the unit disk, have rational coordinates, and whose deck
/// transformations are rational, too. That it is one is certified: the relation of the generators holds exactly, every lifted triangle is
/// counterclockwise, exactly, and the areas of all triangles, which sum up to a multiple of 2 pi, sum up to 4 pi (g - 1); so the triangles turn
/// exactly once around each vertex, the developing map is a local isometry, and the group is discrete. Nothing of this rests on how the numbers
/// were found.
///
/// It is not the surface that was computed, but one near it, whose edges have other lengths by `largest_length_difference` at most.
class Exact_hyperbolic_surface : public Outcome
{
public:
  typedef std::uint32_t Index;                       ///< of vertices, halfedges, edges and faces
  typedef std::array<Exact_rational, 2> Point;       ///< a point of the unit disk

  /// The motion z -> (a z + b) / (conj(b) z + conj(a)) of the disk, in complex numbers whose parts are integers.
  struct Motion
  {
    std::array<Exact_rational, 2> a; ///< real and imaginary part
    std::array<Exact_rational, 2> b; ///< real and imaginary part
  };

  /// constructs no surface.
  Exact_hyperbolic_surface() = default;

  /// finds a surface near `u`. See `realize_exactly()`.
  Exact_hyperbolic_surface(const Hyperbolic_uniformization& u, double tolerance)
    : triangulation_(u.metric.triangulation), realization_(u, tolerance)
  {
    set_outcome(realization_.outcome());
  }

  /// the triangulation: that of the metric that was computed. Its lengths are of no account.
  const Intrinsic_triangulation<double>& triangulation() const { return triangulation_; }

  /// the chosen lift of a vertex.
  Point vertex_point(Index v) const { return realization_.vertex_point(v).coordinates(); }

  /// where the target of the halfedge `h` lies, if `h` is lifted such that it begins at the chosen lift of its origin.
  Point target_point(Index h) const { return realization_.target_point(triangulation_, h).coordinates(); }

  /// where the vertex opposite to `h` in its face lies then.
  Point apex_point(Index h) const { return realization_.apex_point(triangulation_, h).coordinates(); }

  /// canonical generators a_1, b_1, ..., a_g, b_g, of which the product of commutators a b a^-1 b^-1 is 1.
  std::vector<Motion> canonical_generators() const { return motions(realization_.canonical_generators()); }

  /// the generators that the labels of the uniformization speak of.
  std::vector<Motion> generators() const { return motions(realization_.generators()); }

  /// the number of binary digits to which generators were rounded
  int precision() const { return realization_.precision(); }

  /// the largest number of decimal digits of an integer of the generators
  std::size_t number_of_digits() const { return realization_.number_of_digits(); }

  /// by how much, at most, an edge of the triangulation is longer or shorter than in the metric that was computed (rounded)
  double largest_length_difference() const { return realization_.largest_length_difference(); }

private:
  static std::vector<Motion> motions(const std::vector<internal::Exact_isometry>& isometries)
  {
    std::vector<Motion> result;
    for(const internal::Exact_isometry& m : isometries)
    {
      const internal::Gaussian_integer a = m.a(), b = m.b();
      result.push_back({{{Exact_rational(a.re), Exact_rational(a.im)}}, {{Exact_rational(b.re), Exact_rational(b.im)}}});
    }
    return result;
  }

  Intrinsic_triangulation<double> triangulation_;
  internal::Exact_realization realization_;
};

/// \ingroup PkgConformalEquivalenceHyperbolic
///
/// finds a closed hyperbolic surface in rational numbers near to one that `uniformize_hyperbolic()` has found, of any genus. All generators but two
/// are rounded; these two solve linear equations such that the relation holds exactly. More digits are taken until the surface is certified, see
/// `Exact_hyperbolic_surface`, and near enough.
///
/// \param u a uniformization with a group
/// \param tolerance the largest difference of the lengths of an edge
///
/// \return the surface, with a status: `OK`; `WRONG_TOPOLOGY`, if `u` has no group; `NOT_INJECTIVE`, if triangles, `faces`, are not
///         counterclockwise with as many digits as `u` has; `ITERATIONS_EXHAUSTED`, if these do not suffice for the relation (`amount`: by how
///         much `u` misses it); `BOUND_NOT_MET`, if lengths differ by `amount`, more than `tolerance`.
///
/// Linear time, with numbers of a few dozen digits at most vertices, and of as many as the generators have along the loops.
inline Exact_hyperbolic_surface realize_exactly(const Hyperbolic_uniformization& u, double tolerance = 1e-6)
{
  return Exact_hyperbolic_surface(u, tolerance);
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_EXACT_HYPERBOLIC_SURFACE_H
