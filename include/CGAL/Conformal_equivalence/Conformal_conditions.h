// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Conformal_conditions.h
/// What is prescribed at the vertices: an angle sum, a logarithmic scale factor or a lower bound on it
/// (Problem in section 2.1, boundary conditions of section 4, cones of section 5
/// of Springborn, Schroeder and Pinkall, 2008). Every kind of border and of cone
/// is a way to fill these arrays.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_CONDITIONS_H
#define CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_CONDITIONS_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Exact_angle.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceSolver
///
/// The conditions at the vertices of an `Intrinsic_triangulation`: at each vertex v
///  - either the angle sum Theta^ is prescribed (radians), and the logarithmic scale factor u is found;
///  - or u is fixed, and the angle sum Theta~ is found;
///  - or the angle sum is prescribed subject to a lower bound b on u, and the one that gives way to the other is found:
///    u >= b, Theta~ <= Theta^, and one of the two is an equality. A bound is *active* where u = b.
///
/// The metric is the minimizer of the convex energy E (equation (7)) among all u that are as fixed and not below their
/// bounds. As dE/du_v = (Theta^_v - Theta~_v) / 2, the above are the Karush-Kuhn-Tucker conditions of this
/// minimum: a bound holds u up, and E would decrease if u were smaller (B. Springborn, 2020, section 7, has the
/// uniformization of the sphere as a problem of this kind).
///
/// Conditions have a solution only if, on each component, with chi its Euler characteristic and
/// A = 2 pi (inner vertices) + pi (border vertices) - 2 pi chi the sum of all angle sums (Gauss-Bonnet):
///  - without fixed or bounded vertices, the prescribed angle sums add up to A;
///  - otherwise those of the vertices neither fixed nor bounded leave some of A to the others;
///  - with bounded and no fixed vertices, all prescribed angle sums add up to at least A. If to A itself, no bound gives way:
///    the metric is that without bounds, scaled by the least factor at which it is within them.
template <typename NT_ = double>
struct Conformal_conditions
{
  typedef NT_ NT;               ///< number type of angles and of u
  typedef std::uint32_t Index;  ///< of vertices

  /// no condition at all, for no vertex.
  Conformal_conditions() = default;

  /// no condition but the natural ones: angle sum 2 pi at interior vertices, u = 0 at border
  /// vertices (the border keeps its lengths). Isolated vertices are ignored.
  template <typename Length>
  explicit Conformal_conditions(const Intrinsic_triangulation<Length>& t);

  /// the number of vertices.
  std::size_t size() const { return u_.size(); }

  /// prescribes the angle sum at `v`.
  void prescribe_angle_sum(Index v, const Exact_angle<NT>& angle) { kind_[v] = ANGLE_SUM; angle_[v] = angle; }
  /// prescribes the angle sum at `v`, in radians; see the constructor of `Exact_angle`.
  void prescribe_angle_sum(Index v, const NT& radians) { prescribe_angle_sum(v, Exact_angle<NT>(radians)); }

  /// fixes the logarithmic scale factor at `v`.
  void fix_log_scale_factor(Index v, const NT& u) { kind_[v] = FIXED; u_[v] = u; }

  /// prescribes the angle sum at `v` where the logarithmic scale factor is above `lower_bound`; where it is equal to
  /// `lower_bound`, the angle sum may be less, but not more.
  void prescribe_angle_sum_above(Index v, const Exact_angle<NT>& angle, const NT& lower_bound)
  {
    kind_[v] = BOUNDED;
    angle_[v] = angle;
    u_[v] = lower_bound;
  }
  /// the same, with the angle sum in radians; see the constructor of `Exact_angle`.
  void prescribe_angle_sum_above(Index v, const NT& radians, const NT& lower_bound)
  {
    prescribe_angle_sum_above(v, Exact_angle<NT>(radians), lower_bound);
  }

  /// is `true` iff u is fixed at `v`, `false` iff the angle sum is prescribed.
  bool is_fixed(Index v) const { return kind_[v] == FIXED; }
  /// is `true` iff the angle sum is prescribed at `v`, subject to a lower bound on u.
  bool is_bounded(Index v) const { return kind_[v] == BOUNDED; }
  /// is `true` iff there is a lower bound at any vertex.
  bool has_bounds() const { return std::find(kind_.begin(), kind_.end(), BOUNDED) != kind_.end(); }
  /// is `true` iff an interior vertex `v` would be a cone: u is fixed there (a free cone) or bounded (one if the bound is
  /// active), or the angle sum is not 2 pi.
  bool is_cone(Index v) const
  {
    return kind_[v] != ANGLE_SUM || !angle_[v].is_exact() || angle_[v].units != 2 * Exact_angle<NT>::units_of_pi;
  }
  /// the angle sum prescribed at `v`. \pre `!is_fixed(v)`
  const Exact_angle<NT>& angle_sum(Index v) const { return angle_[v]; }
  /// u as fixed at `v`. \pre `is_fixed(v)`
  const NT& log_scale_factor(Index v) const { return u_[v]; }
  /// the lower bound on u at `v`. \pre `is_bounded(v)`
  const NT& lower_bound(Index v) const { return u_[v]; }

private:
  enum Kind : char { ANGLE_SUM, FIXED, BOUNDED };

  std::vector<Kind> kind_;
  std::vector<Exact_angle<NT> > angle_;
  std::vector<NT> u_; // as fixed, or its lower bound
};

template <typename NT>
template <typename Length>
Conformal_conditions<NT>::Conformal_conditions(const Intrinsic_triangulation<Length>& t)
  : kind_(t.number_of_vertices(), ANGLE_SUM),
    angle_(t.number_of_vertices(), Exact_angle<NT>::pi_times(2)),
    u_(t.number_of_vertices(), NT(0))
{
  for(Index v = 0; v < t.number_of_vertices(); ++v)
  {
    if(!t.is_border_vertex(v))
      continue;
    kind_[v] = FIXED;
    angle_[v] = Exact_angle<NT>::pi_times(1);
  }
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template Conformal_conditions<double>::Conformal_conditions(const Intrinsic_triangulation<double>&);
#endif

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_CONDITIONS_H
