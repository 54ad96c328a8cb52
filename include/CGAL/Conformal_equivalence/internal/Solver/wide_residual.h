// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Residuals to more digits than `double`. Even the constant 2 pi is off by 2.4e-16 in double, a turn of 2.4e-10 for a million
// vertices. What is left of an angle sum is found by one product more:
//
//   Theta~ - Theta^ = 2 arg( e^{-i Theta^ / 2}  prod over corners ((s - a) + i r) ).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_RESIDUAL_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_RESIDUAL_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_angle_sums.h>
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

// e^{(u + d) / 2} for s = e^{u / 2} and a small step d of Newton's method: with an error of d^3, as good as any.
template <typename Wide>
Wide factor_after_step(const Wide& s, const Wide& d) { return Wide(s + s * (d / 2 + d * d / 8)); }

// Are there so tiny numbers of this type that their differences need an exponent apart in `double`?
template <typename Wide>
constexpr bool ranges_farther_than_double() { return std::numeric_limits<Wide>::max_exponent > 2 * std::numeric_limits<double>::max_exponent; }

// 2 arg z by vertex, for z of which all or none are nearly real, and which range farther than `double`.
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
  return result;
}

// Theta~ - Theta^ at every vertex where the angle sum is prescribed, 0 elsewhere, for the angle sums Theta~.
template <typename NT, typename Wide>
Scaled_vector differences_from_targets(const Intrinsic_triangulation<NT>& t, const std::vector<Wide_angle_sum<Wide> >& sum,
                                       const Conformal_conditions<NT>& conditions, const Concurrency& concurrency = Concurrency())
{
  typedef Complex_number<Wide> Complex;
  const std::uint32_t n = t.number_of_vertices();
  const auto is_prescribed = [&](std::uint32_t v) { return !t.is_isolated_vertex(v) && !conditions.is_fixed(v); };
  Scaled_vector result;
  if constexpr(ranges_farther_than_double<Wide>())
  {
    std::vector<Complex> z(n, Complex{Wide(1), Wide(0)});
    for(std::uint32_t v = 0; v < n; ++v)
      if(is_prescribed(v))
        z[v] = sum[v].half_difference(conditions.angle_sum(v));
    result = twice_the_arguments(z);
    for(std::uint32_t v = 0; v < n; ++v)
    {
      if(!is_prescribed(v))
        continue;
      const double turns = sum[v].missing_turns(conditions.angle_sum(v), std::ldexp(result.entries[v], result.exponent));
      if(turns == 0)
        continue;
      if(result.exponent != 0)
        result.scale_to_one();
      result.entries[v] += turns;
    }
  }
  else
  {
    result.entries.resize(n, 0.);
    concurrency.for_each_range(n, [&](std::size_t first, std::size_t last)
    {
      for(std::uint32_t v = std::uint32_t(first); v < last; ++v)
      {
        if(!is_prescribed(v))
          continue;
        const Complex z = sum[v].half_difference(conditions.angle_sum(v));
        const double difference = 2 * std::atan2(static_cast<double>(z.im), static_cast<double>(z.re));
        const double turns = sum[v].missing_turns(conditions.angle_sum(v), difference);
        result.entries[v] = turns == 0 ? difference : difference + turns;
      }
    });
  }
  (void) concurrency;
  return result;
}

// The same for the metric with the scale factors s_v^2 = e^{u_v}. Broken triangles count as in the extended energy.
template <typename NT, typename Wide>
Scaled_vector scaled_wide_residual(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s,
                                   const Conformal_conditions<NT>& conditions, const Concurrency& concurrency = Concurrency())
{
  return differences_from_targets(t, wide_angle_sums(t, s, concurrency), conditions, concurrency);
}

// The cotangent weights by edge, rounded to `Number` only at the end: those of the energy, for badly shaped triangles, too.
template <typename Number = double, typename NT, typename Wide>
std::vector<Number> wide_weights(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s)
{
  std::vector<Wide> weight(t.number_of_edges(), Wide(0));
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
  {
    const Incircle_form<Wide> triangle = wide_triangle(t, s, f);
    if(triangle.is_broken())
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
