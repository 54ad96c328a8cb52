// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Where the solver begins.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_STARTING_POINT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_STARTING_POINT_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Abstract_energy.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

struct Starting_point
{
  bool has_factor = true;    // if one was needed
  bool is_evaluated = false; // is the energy at u?
};

// Gives the fixed vertices their u, and moves the others along, by the harmonic extension of these steps. The factor, if there is none
// yet, is that of the Hessian at u = 0, unless u need not be moved and no triangle is broken there: then the first Newton step
// will factorize.
template <typename NT>
Starting_point move_to_fixed_factors(Abstract_energy& energy, Laplacian_solver& linear, const Intrinsic_triangulation<NT>& t,
                                     const Conformal_conditions<NT>& conditions, Vertex_vector& u)
{
  Vertex_vector step(u.size(), 0.); // at the fixed vertices
  for(std::uint32_t v = 0; v < u.size(); ++v)
    if(conditions.is_fixed(v) && !t.is_isolated_vertex(v))
      step[v] = static_cast<double>(conditions.log_scale_factor(v)) - u[v];
  Starting_point result;
  const bool is_moved = largest_entry(step) > 0;
  if(!is_moved && (linear.has_factor() || largest_entry(u) == 0))
    return result;
  result.is_evaluated = !is_moved && energy.evaluate(u) && energy.broken_faces().empty();
  if(result.is_evaluated)
    return result;
  if(!linear.has_factor())
  {
    energy.evaluate(Vertex_vector(u.size(), 0.));
    result.has_factor = linear.factorize(energy.weights());
  }
  if(!result.has_factor || !is_moved)
    return result;

  Vertex_vector pull, extension;
  energy.evaluate(Vertex_vector(u.size(), 0.));
  pull = linear.graph().product(energy.weights(), step);
  for(double& x : pull)
    x = -x;
  result.has_factor = linear.precondition(pull, extension);
  if(result.has_factor)
    for(std::uint32_t v = 0; v < u.size(); ++v)
      u[v] += step[v] + extension[v];
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_STARTING_POINT_H
