// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Exact_angle.h
/// Angles of which fractions of pi are exact.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_EXACT_ANGLE_H
#define CGAL_CONFORMAL_EQUIVALENCE_EXACT_ANGLE_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/internal/Numbers/Number_constants.h>

#include <CGAL/assertions.h>

#include <cmath>
#include <cstdint>
#include <limits>

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

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_EXACT_ANGLE_H
