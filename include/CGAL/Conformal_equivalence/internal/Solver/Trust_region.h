// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The trust region of Newton-Steihaug (T. Steihaug, 1983): a ball, in the norm of the preconditioner, where the quadratic model is trusted.
// Conjugate gradients go towards the minimizer of the model, and are left where they leave the ball.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_TRUST_REGION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_TRUST_REGION_H

#include <CGAL/Conformal_equivalence/internal/Solver/Quadratic_model.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Trust_region
{
public:
  // Keeps a reference.
  explicit Trust_region(Quadratic_model& model) : model_(model) {}

  // The next step gives the region its size.
  void reset() { radius_ = 0; }

  bool is_empty() const { return !(radius_ > 0); }

  // A step for the residual r, solved for up to `eta`. Returns whether it goes downhill; one of length zero is as good where r is zero
  // at all vertices that are not held.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  bool find_step(const Vertex_vector& r, double eta, Vertex_vector& d)
  {
    Vertex_vector right = r;
    model_.graph().clear_fixed(right);
    if(largest_entry(right) == 0)
    {
      d.assign(r.size(), 0.);
      return true;
    }
    End end = search(right, eta, iterations_worth_a_factorization, d);
    if(end == End::TOO_LATE)
    {
      if(!model_.factorize())
        return false;
      radius_ = (std::max)(radius_, 1e-300);
      const std::size_t most_with_new_factor = 300; // only ends what rounding keeps from converging: every iteration goes further downhill
      end = search(right, eta, most_with_new_factor, d);
    }
    return end != End::NO_FACTOR && dot(r, d) > 0;
  }

  // Adapts the region to the decrease of E, relative to the one of the model, that the last step has brought.
  void adapt(double ratio)
  {
    if(ratio > 0.75 && at_boundary_)
      radius_ *= 2;
    else if(!(ratio > 0.25))
      radius_ = 0.25 * (std::min)(radius_, step_norm_);
  }

private:
  enum class End { INSIDE, AT_BOUNDARY, TOO_LATE, NO_FACTOR };

  // Conjugate gradients from d = 0, until the residual, in the norm of the preconditioner, is `eta` times the first, or until d leaves the
  // region, where the curvature is not positive, too, or for `most` iterations. The norms of d and p are carried along: dd, dp and pp are
  // their squares and product.
  End search(Vertex_vector r, double eta, std::size_t most, Vertex_vector& d)
  {
    Vertex_vector z, p;
    d.assign(r.size(), 0.);
    at_boundary_ = false;
    if(!model_.solver().precondition(r, z))
      return End::NO_FACTOR;
    p = z;
    double rz = dot(r, z);
    if(radius_ == 0)
      radius_ = 2 * std::sqrt(rz);
    const double goal = rz * eta * eta;
    double dd = 0, dp = 0, pp = rz;
    for(std::size_t k = 0; k < most; ++k)
    {
      model_.count_linear_iteration();
      const Vertex_vector q = model_.product(p);
      const double curvature = dot(p, q);
      const double step = rz / curvature;
      const double dd_next = dd + 2 * step * dp + step * step * pp;
      if(!(curvature > 1e-14 * rz) || dd_next >= radius_ * radius_)
      {
        add((-dp + std::sqrt((std::max)(0., dp * dp + pp * (radius_ * radius_ - dd)))) / pp, p, d);
        at_boundary_ = true;
        step_norm_ = radius_;
        return End::AT_BOUNDARY;
      }
      add(step, p, d);
      for(std::size_t v = 0; v < r.size(); ++v)
        r[v] -= step * q[v];
      if(!model_.solver().precondition(r, z))
        return End::NO_FACTOR;
      const double rz_next = dot(r, z), beta = rz_next / rz;
      dd = dd_next;
      dp = beta * (dp + step * pp);
      pp = rz_next + beta * beta * pp;
      rz = rz_next;
      step_norm_ = std::sqrt(dd);
      if(rz <= goal)
        return End::INSIDE;
      for(std::size_t v = 0; v < p.size(); ++v)
        p[v] = z[v] + beta * p[v];
    }
    return End::TOO_LATE;
  }

  // d + t p
  static void add(double t, const Vertex_vector& p, Vertex_vector& d)
  {
    for(std::size_t v = 0; v < d.size(); ++v)
      d[v] += t * p[v];
  }

  Quadratic_model& model_;
  double radius_ = 0, step_norm_ = 0;
  bool at_boundary_ = false;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_TRUST_REGION_H
