// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A step of Newton's method with all of its linear algebra in the wide number type, for matrices that
// double cannot hold: where triangles are so thin that their cotangents differ by more than its digits.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_NEWTON_STEP_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_NEWTON_STEP_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The lower half of A (see Laplacian_solver.h) for the scale factors s^2; rows without weight, and those of held vertices, are
// those of the identity.
template <typename Surface, typename Wide>
Eigen::SparseMatrix<Wide> wide_matrix(const Surface& t, const Edge_graph& graph, const std::vector<Wide>& s)
{
  typedef std::uint32_t Index;
  const std::vector<Wide> w = wide_weights<Wide>(t, s);
  std::vector<Wide> diagonal(graph.number_of_free, Wide(0));
  std::vector<Eigen::Triplet<Wide> > entries;
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
    if(is_unknown(i) && is_unknown(j))
      entries.emplace_back(int((std::max)(graph.free_index[i], graph.free_index[j])),
                           int((std::min)(graph.free_index[i], graph.free_index[j])), Wide(-half));
  }
  for(Index i = 0; i < diagonal.size(); ++i)
    entries.emplace_back(int(i), int(i), diagonal[i] > 0 ? diagonal[i] : Wide(1));
  Eigen::SparseMatrix<Wide> a(int(graph.number_of_free), int(graph.number_of_free));
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

// Multiplies `s` by e^{d / 2} for the step d. Returns whether the matrix could be factorized.
template <typename Surface, typename Wide>
bool add_wide_newton_step(const Surface& t, const Edge_graph& graph, const Scaled_vector& residual, std::vector<Wide>& s)
{
  using std::ldexp;
  typedef Eigen::SparseMatrix<Wide> Matrix;
  typedef Eigen::Matrix<Wide, Eigen::Dynamic, 1> Vector;
  const Eigen::SimplicialLDLT<Matrix> factor(wide_matrix(t, graph, s));
  if(factor.info() != Eigen::Success)
    return false;
  Vector right(graph.number_of_free);
  for(std::uint32_t v = 0; v < s.size(); ++v)
    if(graph.is_free(v))
      right[graph.free_index[v]] = graph.is_held(v) ? Wide(0) : Wide(residual.entries[v]);
  const Vector solution = factor.solve(right);
  for(std::uint32_t v = 0; v < s.size(); ++v)
    if(graph.is_free(v) && !graph.is_held(v))
    {
      const Wide step = ldexp(solution[graph.free_index[v]], residual.exponent);
      s[v] = s[v] + s[v] * (step / 2 + step * step / 8);
    }
  return true;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

namespace Eigen {

template <>
struct NumTraits<CGAL::Conformal_equivalence::internal::Double_double>
  : GenericNumTraits<CGAL::Conformal_equivalence::internal::Double_double>
{
  typedef CGAL::Conformal_equivalence::internal::Double_double Real, NonInteger, Nested, Literal;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1, ReadCost = 2, AddCost = 20, MulCost = 10 };
};

} // namespace Eigen

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_NEWTON_STEP_H
