// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Angle sums to more digits than `double`, for the last residual. Even the
// constant 2 pi is off by 2.4e-16 in double, a turn of 2.4e-10 for a million
// vertices. The angle sum at a vertex is twice the argument of the product of the
// numbers (s - a) + i r of its corners, so no transcendental function is needed:
//
//   Theta~ - Theta^ = 2 arg( e^{-i Theta^ / 2}  prod over corners ((s - a) + i r) ).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_RESIDUAL_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_RESIDUAL_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
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

// A sum of triangle corners, as in `Angle_sum`: the half angles as a product, of which the half turns are counted.
template <typename Wide>
class Wide_angle_sum
{
  Complex_number<Wide> z_{Wide(1), Wide(0)};
  int half_turns_ = 0;

public:
  // 0 <= arg w <= pi / 2
  void add(const Complex_number<Wide>& w)
  {
    multiply_argument(z_, w);
    if(z_.im < 0 || (z_.im == 0 && z_.re < 0))
    {
      z_ = {-z_.re, -z_.im};
      ++half_turns_;
    }
  }

  // e^{i (sum - target) / 2}, up to a positive factor
  template <typename NT>
  Complex_number<Wide> half_difference(const Exact_angle<NT>& target) const
  {
    const Complex_number<Wide> z = half_turns_ % 2 == 0 ? z_ : Complex_number<Wide>{-z_.re, -z_.im};
    if(target.is_exact() && target.units == 2 * Exact_angle<NT>::units_of_pi)
      return {-z.re, -z.im};
    if(target.is_exact() && target.units == Exact_angle<NT>::units_of_pi)
      return {z.im, -z.re};
    return z * unit_complex(Wide(-target.template radians<Wide>() / 2));
  }

  // The multiple of 4 pi by which sum - target differs from `remainder`, twice the argument of `half_difference()`.
  template <typename NT>
  double missing_turns(const Exact_angle<NT>& target, double remainder) const
  {
    const double double_turn = 4 * Number_constants<double>::pi();
    const double sum = 2 * (half_turns_ * Number_constants<double>::pi()
                            + std::atan2(static_cast<double>(z_.im), static_cast<double>(z_.re)));
    return double_turn * std::round((sum - static_cast<double>(target.template radians<Wide>()) - remainder) / double_turn);
  }
};

// 2 arg z by vertex, for z of which all or none are nearly real.
template <typename Wide>
Scaled_vector twice_the_arguments(const std::vector<Complex_number<Wide> >& z)
{
  using std::abs;
  using std::frexp;
  using std::ldexp;
  Scaled_vector result;
  result.entries.resize(z.size());
  for(std::size_t v = 0; v < z.size(); ++v)
    result.entries[v] = 2 * std::atan2(static_cast<double>(z[v].im), static_cast<double>(z[v].re));
  if constexpr(std::numeric_limits<Wide>::max_exponent > 2 * std::numeric_limits<double>::max_exponent)
  {
    if(result.largest_entry() > 1e-150)
      return result;
    Wide largest(0);
    for(const Complex_number<Wide>& x : z)
      largest = (std::max)(largest, Wide(abs(Wide(x.im / x.re))));
    if(largest == 0)
      return result;
    (void) frexp(largest, &result.exponent);
    for(std::size_t v = 0; v < z.size(); ++v)
      result.entries[v] = 2 * static_cast<double>(Wide(ldexp(Wide(z[v].im / z[v].re), -result.exponent)));
  }
  return result;
}

// By edge: its scaled length.
template <typename NT, typename Wide>
std::vector<Wide> wide_lengths(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s)
{
  std::vector<Wide> result;
  result.reserve(t.number_of_edges());
  for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
    result.push_back(wide_length(t, s, t.edge_halfedge(e)));
  return result;
}

// Theta~ - Theta^ at every vertex where the angle sum is prescribed, 0 elsewhere.
// Broken triangles count as in the extended energy. `s[v]` = e^{u_v / 2}.
template <typename NT, typename Wide>
Scaled_vector scaled_wide_residual(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s,
                                   const Conformal_conditions<NT>& conditions)
{
  typedef Complex_number<Wide> Complex;
  const std::uint32_t n = t.number_of_vertices();
  std::vector<Wide_angle_sum<Wide> > sum(n);
  const std::vector<Wide> length = wide_lengths(t, s);
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); h += 3)
  {
    const Incircle_form<Wide> triangle(length[t.edge(h)], length[t.edge(h + 1)], length[t.edge(h + 2)]);
    const double unit = 1 / static_cast<double>(triangle.s);
    const Wide y = triangle.r * unit;
    for(std::uint32_t k = 0; k < 3; ++k)
    {
      if(triangle.is_triangle && triangle.r > 0)
        sum[t.apex(h + k)].add(Complex{triangle.tangent[k] * unit, y});
      else if(!(triangle.tangent[k] > 0))
        sum[t.apex(h + k)].add(Complex{Wide(0), Wide(1)});
    }
  }

  std::vector<Complex> z(n, Complex{Wide(1), Wide(0)});
  const auto is_prescribed = [&](std::uint32_t v) { return !t.is_isolated_vertex(v) && !conditions.is_fixed(v); };
  for(std::uint32_t v = 0; v < n; ++v)
    if(is_prescribed(v))
      z[v] = sum[v].half_difference(conditions.angle_sum(v));
  Scaled_vector result = twice_the_arguments(z);
  for(std::uint32_t v = 0; v < n; ++v)
  {
    if(!is_prescribed(v))
      continue;
    const double turns = sum[v].missing_turns(conditions.angle_sum(v), std::ldexp(result.entries[v], result.exponent));
    if(turns == 0)
      continue;
    result.scale_to_one();
    result.entries[v] += turns;
  }
  return result;
}

// The cotangent weights by edge, rounded to `Number` only at the end: those of the energy, for badly shaped triangles, too.
template <typename Number = double, typename NT, typename Wide>
std::vector<Number> wide_weights(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s)
{
  std::vector<Wide> weight(t.number_of_edges(), Wide(0));
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
  {
    const Incircle_form<Wide> triangle = wide_triangle(t, s, f);
    if(!triangle.is_triangle || !(triangle.r > 0))
      continue;
    for(int k = 0; k < 3; ++k)
      weight[t.edge(3 * f + std::uint32_t(k))] += cotangent(triangle, k);
  }
  if constexpr(std::is_same<Number, Wide>::value)
    return weight;
  else
  {
    std::vector<Number> result;
    result.reserve(weight.size());
    for(const Wide& w : weight)
      result.push_back(static_cast<Number>(w));
    return result;
  }
}

// The residual as it is, not scaled.
template <typename Surface, typename Wide, typename NT>
std::vector<double> wide_residual(const Surface& t, const std::vector<Wide>& s, const Conformal_conditions<NT>& conditions)
{
  Scaled_vector result = scaled_wide_residual(t, s, conditions);
  result.scale_to_one();
  return std::move(result.entries);
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_RESIDUAL_H
