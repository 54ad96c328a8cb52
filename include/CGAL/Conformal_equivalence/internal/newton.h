// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Newton's method for the minimizer of E (section 3.1 of Springborn, Schroeder and
// Pinkall, 2008), in double. With r = Theta~ - Theta^ = -2 grad E, a Newton step d
// solves A d = r, where A = 2 Hess E.
//
// Conformal change barely changes angles, hence barely A: one factor of A, taken
// at the first metric, preconditions all later steps, which are solved only as
// accurately as the step deserves (inexact Newton). The value of E is never
// needed: it is too large to tell small steps apart. What is needed of it along a
// step is its derivative, -r(u + t d).d / 2.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NEWTON_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NEWTON_H

#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/energy.h>
#include <CGAL/Conformal_equivalence/internal/solver/Laplacian_solver.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

struct Newton_options
{
  double tolerance = 1e-12;
  std::size_t number_of_iterations = 100;
  Newton_strategy strategy = Newton_strategy::LINE_SEARCH;
};

template <typename Energy, typename SolverTraits, typename Visitor>
class Newton_method
{
public:
  Newton_method(Energy& energy, Laplacian_solver<SolverTraits>& solver,
                const Vertex_vector& target, const Newton_options& options,
                Statistics& statistics, Visitor& visitor)
    : energy_(energy), solver_(solver), target_(target), options_(options),
      statistics_(statistics), visitor_(visitor)
  {}

  // Improves u until the residual is within the tolerance or the rounding floor.
  // Returns OK, ITERATIONS_EXHAUSTED, SINGULAR_PROBLEM or STOPPED_BY_VISITOR.
  Status operator()(Vertex_vector& u)
  {
    if(!evaluate(u, residual_))
      return Status::ITERATIONS_EXHAUSTED;
    for(std::size_t iteration = 0; ; ++iteration)
    {
      const double size = largest_entry(residual_);
      record(iteration, size);
      if(size <= (std::max)(options_.tolerance, rounding_floor()))
        return Status::OK;
      if(!visitor_.go_further())
        return Status::STOPPED_BY_VISITOR;
      if(iteration == options_.number_of_iterations)
        return Status::ITERATIONS_EXHAUSTED;
      if(!solver_.has_factor() && !solver_.factorize(energy_.weights()))
        return Status::SINGULAR_PROBLEM;
      const bool stepped = options_.strategy == Newton_strategy::LINE_SEARCH ? line_search_step(u)
                                                                            : trust_region_step(u);
      if(!stepped)
        return size <= 10 * rounding_floor() ? Status::OK : Status::ITERATIONS_EXHAUSTED;
      ++statistics_.number_of_iterations;
    }
  }

private:
  // r at u; false if u is out of the range of double.
  bool evaluate(const Vertex_vector& u, Vertex_vector& r)
  {
    ++statistics_.number_of_evaluations;
    const bool is_finite = energy_.evaluate(u);
    r.resize(u.size());
    for(std::size_t v = 0; v < u.size(); ++v)
      r[v] = energy_.angle_sums()[v] - target_[v];
    solver_.graph().clear_fixed(r);
    return is_finite;
  }

  // Below this a residual cannot be told from rounding. It is of interest, and
  // hardly changes any more, when the residual has become small.
  double rounding_floor()
  {
    if(floor_ > 0 || statistics_.residual > 1e-4)
      return floor_;
    double largest = 0;
    const std::vector<double> sensitivity = energy_.sensitivities();
    for(std::size_t v = 0; v < sensitivity.size(); ++v)
      if(solver_.graph().is_free(std::uint32_t(v)))
        largest = (std::max)(largest, sensitivity[v]);
    return floor_ = 4 * std::numeric_limits<double>::epsilon() * largest;
  }

  void record(std::size_t iteration, double size)
  {
    statistics_.residuals.push_back(size);
    statistics_.residual = size;
    statistics_.residual_floor = rounding_floor();
    visitor_.on_iteration(iteration, size);
  }

  // How accurately the next step is solved for: an error of the step shows as an
  // error of the next residual of that relative size, and the quadratic
  // convergence of exact steps is not to be spoiled; nothing beyond the tolerance
  // is of use.
  double forcing_term() const
  {
    const std::vector<double>& history = statistics_.residuals;
    const double size = history.back();
    const double gain = history.size() < 2 ? 1 : size / history[history.size() - 2];
    return (std::min)(1e-2, (std::max)(0.1 * gain * gain, 0.1 * options_.tolerance / size));
  }

  // A step that points downhill: by preconditioned conjugate gradients with the kept factor, or with
  // a new one if the kept one has become a bad approximation.
  bool newton_direction(Vertex_vector& d)
  {
    const std::size_t few = 15, many = 200;
    const double eta = forcing_term();
    bool converged = false;
    std::size_t count = solver_.conjugate_gradients(energy_.weights(), residual_, eta, few, d, converged);
    statistics_.number_of_linear_iterations += count;
    if(!converged)
    {
      if(!solver_.factorize(energy_.weights()))
        return false;
      count = solver_.conjugate_gradients(energy_.weights(), residual_, eta, many, d, converged);
      statistics_.number_of_linear_iterations += count;
    }
    return dot(residual_, d) > 0 || (solver_.precondition(residual_, d) && dot(residual_, d) > 0);
  }

  // Goes along d as far as the derivative of E has not become more than half as
  // large upwards as it was downwards at the start. Where triangles are broken the
  // Hessian may be singular, and d useless; from then on, until no triangle
  // is broken any more, a trust region tells how far to go.
  bool line_search_step(Vertex_vector& u)
  {
    is_lost_ = is_lost_ && !energy_.broken_faces().empty();
    if(is_lost_)
      return trust_region_step(u);
    Vertex_vector d;
    const double far = 10; // in u
    if(!newton_direction(d) || (!energy_.broken_faces().empty() && !(largest_entry(d) <= far)))
      return begin_trust_region(u);
    const double slope = dot(residual_, d);
    Vertex_vector trial(u.size()), r;
    for(double t = 1; t > 1e-6; )
    {
      for(std::size_t v = 0; v < u.size(); ++v)
        trial[v] = u[v] + t * d[v];
      const bool is_finite = evaluate(trial, r);
      const double slope_there = is_finite ? dot(r, d) : -std::numeric_limits<double>::infinity();
      if(slope_there >= -0.5 * slope)
      {
        u.swap(trial);
        residual_.swap(r);
        return true;
      }
      // the zero of the secant through both slopes, safeguarded
      const double secant = is_finite ? slope / (slope - slope_there) : 0.1;
      t *= (std::min)(0.7, (std::max)(0.1, secant));
    }
    return begin_trust_region(u);
  }

  // The factor for the trust region is that of the first metric again: a Hessian at broken triangles makes a
  // bad norm. Where no triangle is broken, it is rounding that keeps the line search from going on.
  bool begin_trust_region(Vertex_vector& u)
  {
    evaluate(u, residual_);
    if(energy_.broken_faces().empty())
      return false;
    is_lost_ = true;
    radius_ = 0;
    energy_.evaluate(Vertex_vector(u.size(), 0.));
    const bool has_factor = solver_.factorize(energy_.weights());
    evaluate(u, residual_);
    return has_factor && trust_region_step(u);
  }

  // Newton-Steihaug (T. Steihaug, 1983): conjugate gradients, left at the boundary
  // of a ball in the norm of the preconditioner. The decrease of 2 E is the
  // integral of r along the step, by the trapezoidal rule.
  bool trust_region_step(Vertex_vector& u)
  {
    Vertex_vector trial(u.size()), r;
    for(int attempt = 0; attempt < 60; ++attempt)
    {
      Vertex_vector d, ad;
      if(!steihaug_direction(d))
        return false;
      ad = solver_.graph().product(energy_.weights(), d);
      const double predicted = dot(residual_, d) - dot(d, ad) / 2;
      for(std::size_t v = 0; v < u.size(); ++v)
        trial[v] = u[v] + d[v];
      const bool is_finite = evaluate(trial, r);
      const double actual = is_finite ? (dot(residual_, d) + dot(r, d)) / 2 : -1;
      const double ratio = actual / predicted;
      if(ratio > 0.75 && at_boundary_)
        radius_ *= 2;
      else if(!(ratio > 0.25))
        radius_ = 0.25 * (std::min)(radius_, step_norm_);
      if(ratio > 0.1)
      {
        u.swap(trial);
        residual_.swap(r);
        return true;
      }
      evaluate(u, residual_);
      if(!(radius_ > 0))
        return false;
    }
    return false;
  }

  bool steihaug_direction(Vertex_vector& d)
  {
    const std::size_t n = residual_.size(), most = 300, few = 15;
    const std::vector<double>& w = energy_.weights();
    for(bool refactored = false; ; refactored = true)
    {
      Vertex_vector r = residual_, z, p;
      d.assign(n, 0.);
      at_boundary_ = false;
      if(!solver_.precondition(r, z))
        return false;
      p = z;
      double rz = dot(r, z);
      if(radius_ == 0)
        radius_ = 2 * std::sqrt(rz);
      const double goal = rz * forcing_term() * forcing_term();
      double dd = 0, dp = 0, pp = rz; // squares and products in the norm of the preconditioner
      for(std::size_t k = 0; k < most; ++k)
      {
        if(k == few && !refactored)
          break;
        ++statistics_.number_of_linear_iterations;
        const Vertex_vector q = solver_.graph().product(w, p);
        const double curvature = dot(p, q);
        const double step = rz / curvature;
        const double dd_next = dd + 2 * step * dp + step * step * pp;
        if(!(curvature > 1e-14 * rz) || dd_next >= radius_ * radius_)
        {
          const double tau = (-dp + std::sqrt((std::max)(0., dp * dp + pp * (radius_ * radius_ - dd)))) / pp;
          for(std::size_t v = 0; v < n; ++v)
            d[v] += tau * p[v];
          at_boundary_ = true;
          step_norm_ = radius_;
          return dot(residual_, d) > 0;
        }
        for(std::size_t v = 0; v < n; ++v)
        {
          d[v] += step * p[v];
          r[v] -= step * q[v];
        }
        if(!solver_.precondition(r, z))
          return false;
        const double rz_next = dot(r, z), beta = rz_next / rz;
        dd = dd_next;
        dp = beta * (dp + step * pp);
        pp = rz_next + beta * beta * pp;
        rz = rz_next;
        step_norm_ = std::sqrt(dd);
        if(rz <= goal || k + 1 == most)
          return dot(residual_, d) > 0;
        for(std::size_t v = 0; v < n; ++v)
          p[v] = z[v] + beta * p[v];
      }
      if(!solver_.factorize(w))
        return false;
      radius_ = (std::max)(radius_, 1e-300);
    }
  }

  Energy& energy_;
  Laplacian_solver<SolverTraits>& solver_;
  const Vertex_vector& target_;
  const Newton_options options_;
  Statistics& statistics_;
  Visitor& visitor_;
  Vertex_vector residual_;
  double floor_ = 0;
  double radius_ = 0, step_norm_ = 0; // of the trust region
  bool at_boundary_ = false;
  bool is_lost_ = false; // line search has failed among broken triangles
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NEWTON_H
