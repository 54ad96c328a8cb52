// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Which classes of the first homology closed curves belong to: curves along edges, given as chains of halfedges, and curves across edges
// (Dual_loops.h). Where a chain c and a curve b across edges cross, transversally, their signed crossings add up to the intersection number c.b.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_LOOP_CLASSES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_LOOP_CLASSES_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Whether each halfedge begins where the one before ends, all the way around, and none is on a border.
template <typename NT>
bool is_closed_chain(const Intrinsic_triangulation<NT>& t, const std::vector<std::uint32_t>& chain)
{
  for(std::size_t k = 0; k < chain.size(); ++k)
    if(chain[k] >= t.number_of_halfedges() || t.is_border(chain[k]) || t.target(chain[k]) != t.origin(chain[(k + 1) % chain.size()]))
      return false;
  return !chain.empty();
}

// The curve that runs beside a closed chain, on its left: the halfedges entered, in order. Around every vertex of the chain it crosses the edges
// between the one by which the chain comes and the one by which it goes. Empty if there is none: the curve then stays in one face.
// \pre is_closed_chain(t, chain); the surface is closed
template <typename NT>
std::vector<std::uint32_t> loop_on_the_left(const Intrinsic_triangulation<NT>& t, const std::vector<std::uint32_t>& chain)
{
  std::vector<std::uint32_t> result;
  for(std::size_t k = 0; k < chain.size(); ++k)
    for(std::uint32_t x = t.next(chain[k]); x != chain[(k + 1) % chain.size()]; x = t.next(t.twin(x)))
      result.push_back(t.twin(x));
  return result;
}

// The other way round: the chain along which a curve across edges runs, on its left. It may go there and back.
template <typename NT>
std::vector<std::uint32_t> chain_on_the_left(const Intrinsic_triangulation<NT>& t, const std::vector<std::uint32_t>& loop)
{
  std::vector<std::uint32_t> result;
  for(std::size_t k = 0; k < loop.size(); ++k)
    if(t.twin(loop[(k + 1) % loop.size()]) == t.next(loop[k])) // the curve turns to the right, and the chain goes on
      result.push_back(t.twin(t.previous(loop[k])));
  return result;
}

// By basis curve: the signed number of times that it crosses the chain.
template <typename NT>
Eigen::VectorXd intersection_numbers(const Intrinsic_triangulation<NT>& t, const std::vector<std::uint32_t>& chain,
                                     const std::vector<std::vector<std::uint32_t> >& basis)
{
  const auto sign = [&](std::uint32_t h) { return h == t.edge_halfedge(t.edge(h)) ? 1 : -1; };
  std::vector<int> times(t.number_of_edges(), 0);
  for(std::uint32_t h : chain)
    times[t.edge(h)] += sign(h);
  Eigen::VectorXd result = Eigen::VectorXd::Zero(Eigen::Index(basis.size()));
  for(std::size_t j = 0; j < basis.size(); ++j)
    for(std::uint32_t h : basis[j])
      result[Eigen::Index(j)] += sign(h) * times[t.edge(h)];
  return result;
}

// Coefficients of classes in a basis of the first homology of a closed surface: from intersection numbers with its curves.
template <typename NT>
class Homology_coordinates
{
  typedef std::vector<std::uint32_t> Loop;

public:
  // `basis`: curves across edges. Keeps references.
  Homology_coordinates(const Intrinsic_triangulation<NT>& t, const std::vector<Loop>& basis) : t_(t), basis_(basis)
  {
    Eigen::MatrixXd form(Eigen::Index(basis.size()), Eigen::Index(basis.size())); // column i: b_i . b_j
    for(std::size_t i = 0; i < basis.size(); ++i)
      form.col(Eigen::Index(i)) = intersection_numbers(t, chain_on_the_left(t, basis[i]), basis);
    if(!basis.empty())
      form_.compute(form);
  }

  // Integers: those x with sum x_i b_i homologous to the closed chain. (The form is unimodular.)
  std::vector<std::int64_t> operator()(const Loop& chain) const
  {
    std::vector<std::int64_t> result;
    if(basis_.empty())
      return result;
    const Eigen::VectorXd x = form_.solve(intersection_numbers(t_, chain, basis_));
    for(Eigen::Index i = 0; i < x.size(); ++i)
      result.push_back(std::int64_t(std::llround(x[i])));
    return result;
  }

private:
  const Intrinsic_triangulation<NT>& t_;
  const std::vector<Loop>& basis_;
  Eigen::PartialPivLU<Eigen::MatrixXd> form_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_LOOP_CLASSES_H
