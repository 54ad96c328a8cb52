// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_CONJUGATE_GRADIENTS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_CONJUGATE_GRADIENTS_H

#include <CGAL/Conformal_equivalence/internal/Concurrency.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Edge_graph.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The preconditioned conjugate gradient method, with the vectors it needs, which are allocated once. A `System` is a symmetric matrix A and a
// positive definite one M that is near to it:
//
//   bool precondition(const Vertex_vector& r, Vertex_vector& z)   z = M^-1 r; false if that cannot be had
//   void multiply(const Vertex_vector& x, Vertex_vector& y)       y = A x
class Conjugate_gradients
{
public:
  // How many threads may be used. Results do not depend on it.
  void set_concurrency(const Concurrency& concurrency) { concurrency_ = concurrency; }

  // A x = b from x = 0, until no entry of the residual is larger than `tolerance` times the largest of b, or
  // after `most` iterations, or, if `may_give_up`, as soon as it is foreseen that these do not do; one solution with M each.
  // Returns their number.
  template <typename System>
  std::size_t solve(System& system, const Vertex_vector& b, double tolerance, std::size_t most, bool may_give_up, Vertex_vector& x, bool& converged)
  {
    const double goal = tolerance * largest_entry(b);
    r_ = b;
    Vertex_vector sizes; // of the residual
    double rz = 0;
    x.assign(b.size(), 0.);
    converged = goal == 0;
    std::size_t iteration = 0;
    for(; !converged && iteration < most; ++iteration)
    {
      if(!system.precondition(r_, z_))
        break;
      const double rz_new = dot(r_, z_);
      if(iteration == 0)
        p_ = z_;
      else
        concurrency_.for_each_range(p_.size(), [&, ratio = rz_new / rz](std::size_t first, std::size_t last)
        {
          for(std::size_t v = first; v < last; ++v)
            p_[v] = z_[v] + ratio * p_[v];
        });
      rz = rz_new;

      system.multiply(p_, q_);
      const double curvature = dot(p_, q_);
      if(!(curvature > 1e-14 * std::abs(rz))) // flat: nothing is known about this direction
      {
        if(iteration == 0)
          x = p_;
        return iteration + 1;
      }
      const double step = rz / curvature;
      concurrency_.for_each_range(x.size(), [&](std::size_t first, std::size_t last)
      {
        for(std::size_t v = first; v < last; ++v)
        {
          x[v] += step * p_[v];
          r_[v] -= step * q_[v];
        }
      });
      sizes.push_back(concurrency_.largest(r_.size(), [this](std::size_t v) { return std::abs(r_[v]); }));
      converged = sizes.back() <= goal;
      if(may_give_up && is_too_slow(sizes, goal, most))
        return iteration + 1;
    }
    return iteration;
  }

private:
  // Would more than `most` iterations be needed, if each gained as much as the last three have done? (The first ones gain otherwise.)
  static bool is_too_slow(const std::vector<double>& sizes, double goal, std::size_t most)
  {
    const std::size_t n = sizes.size(), first_judged = 5, span = 3;
    if(n < first_judged || sizes.back() <= goal)
      return false;
    const double gain = std::log(sizes[n - 1 - span] / sizes.back()) / double(span);
    return !(double(n) + std::log(sizes.back() / goal) / gain <= double(most)) || !(gain > 0);
  }

  Vertex_vector r_, z_, p_, q_;
  Concurrency concurrency_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_CONJUGATE_GRADIENTS_H
