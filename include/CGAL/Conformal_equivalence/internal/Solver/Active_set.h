// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The lower bounds on u in Newton's method. A step is the minimizer of the quadratic model of E among the d >= b - u (sequential
// quadratic programming): what is minimized is convex, so that such a step goes downhill, and the active bounds are soon those
// of the solution. The quadratic program is solved by block principal pivoting (J. J. Judice and F. M. Pires, 1994): the primal-dual
// active-set method, which ends after a few rounds, made finite for every positive definite matrix.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ACTIVE_SET_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ACTIVE_SET_H

#include <CGAL/Conformal_equivalence/internal/Solver/Lower_bounds.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Quadratic_model.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Active_set
{
public:
  typedef std::uint32_t Index;

  // Keeps a reference to the model. An error of a step that shows in residuals less than `tolerance` counts as none.
  Active_set(const Lower_bounds& bounds, Quadratic_model& model, double tolerance)
    : bounds_(bounds), model_(model), tolerance_(tolerance)
  {}

  // Whether there are no bounds at all.
  bool empty() const { return bounds_.empty(); }

  // How far u is from the minimum: the largest entry of r, of which only positive ones count where a bound is active.
  double violation(const Vertex_vector& u, const Vertex_vector& r) const
  {
    if(bounds_.empty())
      return largest_entry(r);
    double result = 0;
    for(Index v = 0; v < u.size(); ++v)
      result = (std::max)(result, is_at_bound(u, v, 0) ? r[v] : std::abs(r[v]));
    return result;
  }

  // Holds the vertices at their bounds, or as near to them, that r does not pull off, and at least one of each component
  // that rests on its bounds.
  void hold_active(const Vertex_vector& u, const Vertex_vector& r, double distance)
  {
    if(bounds_.empty())
      return;
    const double infinity = std::numeric_limits<double>::infinity();
    active_.assign(u.size(), 0);
    for(Index v = 0; v < u.size(); ++v)
      active_[v] = is_at_bound(u, v, distance) && r[v] <= 0;
    for(const Index v : bounds_.largest([&](Index w) { return active_[w] ? infinity : bounds_.bound[w] - u[w]; }))
      active_[v] = 1;
    model_.solver().hold(active_);
  }

  // Does u satisfy the bounds? If a component rests on its bounds, it is moved to them first.
  bool is_feasible(Vertex_vector& u) const
  {
    if(bounds_.empty())
      return true;
    bounds_.settle(u);
    bool result = true;
    for(std::size_t v = 0; v < u.size(); ++v)
      result = result && u[v] >= bounds_.bound[v];
    return result;
  }

  // Moves every component that rests on its bounds down or up to them. Returns whether anything was moved.
  bool settle(Vertex_vector& u) const { return !bounds_.empty() && bounds_.settle(u); }

  // Makes u satisfy the bounds, by a change that is as harmonic as can be. \pre the energy was evaluated at u
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  bool lift(Vertex_vector& u)
  {
    const Vertex_vector no_residual(u.size(), 0.);
    hold_active(u, no_residual, 0);
    Vertex_vector d;
    if(!step(u, no_residual, 1e-3, d))
      return false;
    for(std::size_t v = 0; v < u.size(); ++v)
      u[v] = (std::max)(u[v] + d[v], bounds_.bound[v]);
    return true;
  }

  // The minimizer of d.A d / 2 - r.d among the d >= b - u: with f = A d - r, the solution of f = 0 where d > b - u, and f >= 0
  // where d = b - u. Beginning with the vertices held, those that violate one or the other change sides: all at once, as long as their number
  // reaches a new minimum within `patience` rounds, then one at a time, which cannot go round in circles. The limit on the rounds only
  // bounds the time: a step that has not reached its minimum still has to go downhill to be taken.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  bool step(const Vertex_vector& u, const Vertex_vector& r, double eta, Vertex_vector& d)
  {
    const int most_rounds = 200, patience = 10;
    std::size_t least = (std::numeric_limits<std::size_t>::max)();
    int rounds_left = patience;
    for(int round = 0; round < most_rounds; ++round)
    {
      Vertex_vector f;
      double error = 0;
      if(!solve_held(u, r, eta, d, f, error))
        return false;
      const std::vector<Index> wrong = on_wrong_side(u, d, f, error);
      if(wrong.empty())
        break;
      rounds_left = wrong.size() < least ? patience : rounds_left - 1;
      least = (std::min)(least, wrong.size());
      for(std::size_t i = rounds_left >= 0 ? 0 : wrong.size() - 1; i < wrong.size(); ++i)
        active_[wrong[i]] = !active_[wrong[i]];
    }
    for(std::size_t v = 0; v < u.size(); ++v)
      d[v] = (std::max)(d[v], bounds_.bound[v] - u[v]);
    model_.solver().hold(active_);
    return true;
  }

  // Ends the step d at the bounds, and moves the vertices held to theirs (D. P. Bertsekas, 1982).
  void project(const Vertex_vector& u, Vertex_vector& d)
  {
    if(bounds_.empty())
      return;
    for(std::size_t v = 0; v < u.size(); ++v)
      d[v] = active_[v] ? bounds_.bound[v] - u[v] : (std::max)(d[v], bounds_.bound[v] - u[v]);
    model_.solver().hold_none();
  }

  // u + t d, not below the bounds.
  void move(const Vertex_vector& u, double t, const Vertex_vector& d, Vertex_vector& moved) const
  {
    for(std::size_t v = 0; v < u.size(); ++v)
      moved[v] = u[v] + t * d[v];
    if(bounds_.empty())
      return;
    for(std::size_t v = 0; v < u.size(); ++v)
      moved[v] = active_[v] && t == 1 ? bounds_.bound[v] : (std::max)(moved[v], bounds_.bound[v]);
  }

private:
  bool is_at_bound(const Vertex_vector& u, Index v, double distance) const
  {
    return u[v] - bounds_.bound[v] <= distance;
  }

  // d = b - u where held, f = 0 elsewhere up to `error`.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  bool solve_held(const Vertex_vector& u, const Vertex_vector& r, double eta, Vertex_vector& d, Vertex_vector& f, double& error)
  {
    Vertex_vector held_step(u.size(), 0.);
    for(std::size_t v = 0; v < u.size(); ++v)
      if(active_[v])
        held_step[v] = bounds_.bound[v] - u[v];
    model_.solver().hold(active_);
    Vertex_vector b = model_.product(held_step);
    for(std::size_t v = 0; v < u.size(); ++v)
      b[v] = r[v] - b[v];
    model_.graph().clear_fixed(b);
    if(!model_.solve(b, eta, d))
      return false;
    for(std::size_t v = 0; v < u.size(); ++v)
      d[v] += held_step[v];
    model_.solver().hold_none();
    f = model_.product(d);
    for(std::size_t v = 0; v < u.size(); ++v)
      f[v] -= r[v];
    error = 2 * eta * largest_entry(b) + 0.1 * tolerance_;
    return true;
  }

  // In a component that rests on its bounds, the f of the vertices held have a positive sum: the largest one is right.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  std::vector<Index> on_wrong_side(const Vertex_vector& u, const Vertex_vector& d, const Vertex_vector& f, double error) const
  {
    std::vector<char> is_right(u.size(), 0);
    const double infinity = std::numeric_limits<double>::infinity();
    for(const Index v : bounds_.largest([&](Index w) { return active_[w] ? f[w] : -infinity; }))
      is_right[v] = active_[v];
    std::vector<Index> result;
    for(Index v = 0; v < u.size(); ++v)
      if(bounds_.has(v) && !is_right[v] && (active_[v] ? f[v] < -error : d[v] < bounds_.bound[v] - u[v]))
        result.push_back(v);
    return result;
  }

  const Lower_bounds bounds_;
  Quadratic_model& model_;
  const double tolerance_;
  std::vector<char> active_; // the vertices whose bounds are thought to be active
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ACTIVE_SET_H
