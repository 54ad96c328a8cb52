// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A step of Newton's method with all of its linear algebra in the wide number type, for matrices that
// double cannot hold: where triangles are so thin that their cotangents differ by more than its digits.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_NEWTON_STEP_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_NEWTON_STEP_H

#include <CGAL/Conformal_equivalence/internal/Solver/Edge_graph.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Wide_factorization.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A (see Edge_graph.h) for the weights `w` by edge, factorized; rows without weight, and those of held vertices, are those of the identity.
template <typename Wide>
CGAL_CONFORMAL_EQUIVALENCE_COLD
Wide_factorization<Wide> factorize_wide_matrix(const Edge_graph& graph, const std::vector<Wide>& w)
{
  typedef std::uint32_t Index;
  std::vector<Wide> diagonal(graph.number_of_free, Wide(0)), values;
  std::vector<Matrix_position> lower;
  const auto is_unknown = [&](Index v) { return graph.is_free(v) && !graph.is_held(v); };
  for(std::size_t e = 0; e < graph.ends.size(); ++e)
  {
    const Index i = graph.ends[e].first, j = graph.ends[e].second;
    if(i == j)
      continue;
    const Wide half = w[e] / 2;
    for(const Index v : {i, j})
      if(is_unknown(v))
        diagonal[graph.free_index[v]] += half;
    if(!is_unknown(i) || !is_unknown(j))
      continue;
    lower.emplace_back((std::max)(graph.free_index[i], graph.free_index[j]), (std::min)(graph.free_index[i], graph.free_index[j]));
    values.push_back(-half);
  }
  for(Index i = 0; i < diagonal.size(); ++i)
  {
    lower.emplace_back(i, i);
    values.push_back(diagonal[i] > 0 ? diagonal[i] : Wide(1));
  }
  return Wide_factorization<Wide>(Index(graph.number_of_free), lower, values);
}

// Multiplies `s` by e^{d / 2} for the step d, where the edges have the given weights. Returns whether the matrix could be factorized.
template <typename Wide>
CGAL_CONFORMAL_EQUIVALENCE_COLD
bool add_wide_newton_step(const Edge_graph& graph, const std::vector<Wide>& weights, const Scaled_vector& residual, std::vector<Wide>& s)
{
  using std::ldexp;
  const Wide_factorization<Wide> factor = factorize_wide_matrix(graph, weights);
  if(!factor.is_regular())
    return false;
  std::vector<Wide> right(graph.number_of_free, Wide(0));
  for(std::uint32_t v = 0; v < s.size(); ++v)
    if(graph.is_free(v) && !graph.is_held(v))
      right[graph.free_index[v]] = Wide(residual.entries[v]);
  const std::vector<Wide> solution = factor.solve(right);
  for(std::uint32_t v = 0; v < s.size(); ++v)
    if(graph.is_free(v) && !graph.is_held(v))
    {
      const Wide step = ldexp(solution[graph.free_index[v]], residual.exponent);
      s[v] = factor_after_step(s[v], step);
    }
  return true;
}

// The same, with the weights of the surface `t` for the factors `s`.
template <typename Surface, typename Wide>
CGAL_CONFORMAL_EQUIVALENCE_COLD
bool add_wide_newton_step(const Surface& t, const Edge_graph& graph, const Scaled_vector& residual, std::vector<Wide>& s)
{
  return add_wide_newton_step(graph, wide_weights<Wide>(t, s), residual, s);
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_NEWTON_STEP_H
