// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Angle sums to more digits than `double`, for the last residual. Even the
// constant 2 pi is off by 2.4e-16 in double, a turn of 2.4e-10 for a million
// vertices. The angle sum at a vertex is twice the argument of the product of the
// numbers (s - a) + i r of its corners (`half_angle()`), so no transcendental
// function is needed:
//
//   Theta~ - Theta^ = 2 arg( e^{-i Theta^ / 2}  prod over corners ((s - a) + i r) ).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_WIDE_RESIDUAL_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_WIDE_RESIDUAL_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/triangle_formulas.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The number type in which residual and layout are computed for lengths of type NT.
template <typename NT> struct Wider_number { typedef NT type; };
template <> struct Wider_number<double> { typedef Double_double type; };

// The scaled length of h for the square roots `s` of the scale factors.
template <typename NT, typename Wide>
Wide wide_length(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s, std::uint32_t h)
{
  return s[t.origin(h)] * t.halfedge_length(h) * s[t.target(h)];
}

// The face f with scaled lengths; its side k is the halfedge 3f + k.
template <typename NT, typename Wide>
Incircle_form<Wide> wide_triangle(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s, std::uint32_t f)
{
  return Incircle_form<Wide>(wide_length(t, s, 3 * f), wide_length(t, s, 3 * f + 1), wide_length(t, s, 3 * f + 2));
}

// z * w, rescaled where it has become small: only the argument counts
template <typename Wide>
void multiply_argument(Complex_number<Wide>& z, const Complex_number<Wide>& w)
{
  z = z * w;
  const double size = std::abs(static_cast<double>(z.re)) + std::abs(static_cast<double>(z.im));
  if(size < 1e-30)
    z = {z.re / size, z.im / size};
}

// Theta~ - Theta^ at every vertex where the angle sum is prescribed, 0 elsewhere.
// Broken triangles count as in the extended energy. `s[v]` = e^{u_v / 2}.
template <typename NT, typename Wide>
std::vector<double> wide_residual(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s,
                                  const Conformal_conditions<NT>& conditions)
{
  typedef Complex_number<Wide> Complex;
  const std::uint32_t n = t.number_of_vertices();
  std::vector<Complex> z(n);
  for(std::uint32_t v = 0; v < n; ++v)
  {
    if(t.is_isolated_vertex(v)) // whatever its condition is
      continue;
    const Exact_angle<NT>& target = conditions.angle_sum(v);
    if(target.is_exact() && target.units == 2 * Exact_angle<NT>::units_of_pi)
      z[v] = {Wide(-1), Wide(0)};
    else if(target.is_exact() && target.units == Exact_angle<NT>::units_of_pi)
      z[v] = {Wide(0), Wide(-1)};
    else
      z[v] = unit_complex(Wide(-target.template radians<Wide>() / 2));
  }

  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
  {
    const Incircle_form<Wide> triangle = wide_triangle(t, s, f);
    const double unit = 1 / static_cast<double>(triangle.s);
    const Wide y = triangle.r * unit;
    for(int k = 0; k < 3; ++k)
    {
      const std::uint32_t apex = t.apex(3 * f + k);
      if(triangle.is_triangle && triangle.r > 0)
        multiply_argument(z[apex], Complex{triangle.tangent[k] * unit, y});
      else if(!(triangle.tangent[k] > 0))
        multiply_argument(z[apex], Complex{Wide(0), Wide(1)});
    }
  }

  std::vector<double> result(n, 0.);
  for(std::uint32_t v = 0; v < n; ++v)
    if(!t.is_isolated_vertex(v) && !conditions.is_fixed(v))
      result[v] = 2 * std::atan2(static_cast<double>(z[v].im), static_cast<double>(z[v].re));
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_WIDE_RESIDUAL_H
