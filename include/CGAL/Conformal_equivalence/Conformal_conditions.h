// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Conformal_conditions.h
/// What is prescribed at the vertices: an angle sum or a logarithmic scale factor
/// (Problem in section 2.1, boundary conditions of section 4, cones of section 5
/// of Springborn, Schroeder and Pinkall, 2008). Every kind of border and of cone
/// is a way to fill these arrays.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_CONDITIONS_H
#define CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_CONDITIONS_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/triangle_formulas.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceSolver
///
/// An angle held as a multiple of pi / 2520 and a rest, so that the usual
/// fractions of pi (all with a denominator up to 10, and whole degrees) are exact
/// and the Gauss-Bonnet formula can be checked without rounding.
template <typename NT = double>
struct Exact_angle
{
  static constexpr std::int32_t units_of_pi = 2520; ///< how many units make pi

  std::int32_t units = 0;   ///< multiples of pi / 2520
  NT rest = NT(0);          ///< what is left, in radians

  Exact_angle() = default;

  /// the angle pi * `numerator` / `denominator`. \pre `denominator` divides 2520
  static Exact_angle pi_times(std::int32_t numerator, std::int32_t denominator = 1)
  {
    CGAL_precondition(denominator > 0 && units_of_pi % denominator == 0);
    Exact_angle result;
    result.units = numerator * (units_of_pi / denominator);
    return result;
  }

  /// the angle of `radians`. Where that is a multiple of pi / 2520 up to the
  /// rounding of the expressions by which such multiples are usually written
  /// (4 units in the last place), that multiple is meant.
  explicit Exact_angle(const NT& radians)
  {
    using std::abs;
    const NT pi = internal::Number_constants<NT>::pi();
    const NT multiple = radians * units_of_pi / pi;
    if(abs(multiple) < NT(1e9))
    {
      const std::int32_t nearest = std::int32_t(std::lround(double(multiple)));
      if(abs(radians - pi * nearest / units_of_pi) <= 4 * std::numeric_limits<NT>::epsilon() * abs(radians))
      {
        units = nearest;
        return;
      }
    }
    rest = radians;
  }

  /// is `true` iff the angle is an exact multiple of pi / 2520.
  bool is_exact() const { return rest == NT(0); }

  /// the angle in radians, rounded to `Number`.
  template <typename Number = NT>
  Number radians() const
  {
    return internal::Number_constants<Number>::pi() * units / int(units_of_pi) + Number(rest);
  }
};

/// \ingroup PkgConformalEquivalenceSolver
///
/// The conditions at the vertices of an `Intrinsic_triangulation`: at each vertex
/// either the angle sum is prescribed (radians), and the logarithmic scale factor
/// u is found; or u is fixed, and the angle sum is found.
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
  explicit Conformal_conditions(const Intrinsic_triangulation<Length>& t)
    : is_fixed_(t.number_of_vertices(), 0),
      angle_(t.number_of_vertices(), Exact_angle<NT>::pi_times(2)),
      u_(t.number_of_vertices(), NT(0))
  {
    for(Index v = 0; v < t.number_of_vertices(); ++v)
    {
      if(!t.is_border_vertex(v))
        continue;
      is_fixed_[v] = 1;
      angle_[v] = Exact_angle<NT>::pi_times(1);
    }
  }

  /// the number of vertices.
  std::size_t size() const { return u_.size(); }

  /// prescribes the angle sum at `v`.
  void prescribe_angle_sum(Index v, const Exact_angle<NT>& angle) { is_fixed_[v] = 0; angle_[v] = angle; }
  /// prescribes the angle sum at `v`, in radians; see the constructor of `Exact_angle`.
  void prescribe_angle_sum(Index v, const NT& radians) { prescribe_angle_sum(v, Exact_angle<NT>(radians)); }

  /// fixes the logarithmic scale factor at `v`.
  void fix_log_scale_factor(Index v, const NT& u) { is_fixed_[v] = 1; u_[v] = u; }

  /// is `true` iff u is fixed at `v`, `false` iff the angle sum is prescribed.
  bool is_fixed(Index v) const { return is_fixed_[v] != 0; }
  /// is `true` iff an interior vertex `v` would be a cone: u is fixed there (a free cone), or the angle sum is not 2 pi.
  bool is_cone(Index v) const
  {
    return is_fixed(v) || !angle_[v].is_exact() || angle_[v].units != 2 * Exact_angle<NT>::units_of_pi;
  }
  /// the angle sum prescribed at `v`. \pre `!is_fixed(v)`
  const Exact_angle<NT>& angle_sum(Index v) const { return angle_[v]; }
  /// u as fixed at `v`. \pre `is_fixed(v)`
  const NT& log_scale_factor(Index v) const { return u_[v]; }

private:
  std::vector<char> is_fixed_;
  std::vector<Exact_angle<NT> > angle_;
  std::vector<NT> u_;
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_CONDITIONS_H
