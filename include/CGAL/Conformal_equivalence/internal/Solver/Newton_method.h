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

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_NEWTON_METHOD_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_NEWTON_METHOD_H

#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Abstract_energy.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Active_set.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Lower_bounds.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Nonlinear_elimination.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Quadratic_model.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Trust_region.h>
#include <CGAL/Conformal_equivalence/internal/Solver/line_search.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

struct Newton_options
{
  double tolerance = 1e-12;
  std::size_t number_of_iterations = 100;
  Newton_strategy strategy = Newton_strategy::LINE_SEARCH;
  bool may_give_up = false; // as soon as it is foreseen that triangles remain broken: there is another way
  double largest_u = std::numeric_limits<double>::infinity(); // beyond which there are no last steps in a wider type
};

class Newton_method
{
public:
  Newton_method(Abstract_energy& energy, Laplacian_solver& solver,
                const Vertex_vector& target, const Newton_options& options,
                Statistics& statistics, const Any_visitor& visitor, const Lower_bounds& bounds = Lower_bounds())
    : energy_(energy), solver_(solver), options_(options), statistics_(statistics), visitor_(visitor),
      residual_at_(energy, solver.graph(), target, statistics), eliminate_(residual_at_, options.number_of_iterations),
      model_(energy, solver, statistics), active_set_(bounds, model_, options.tolerance), region_(model_)
  {}

  // Improves u until the residual is within the tolerance or the rounding floor.
  // Returns OK, ITERATIONS_EXHAUSTED, SINGULAR_PROBLEM or STOPPED_BY_VISITOR. If `is_evaluated`, the energy is at u already.
  Status operator()(Vertex_vector& u, bool is_evaluated = false)
  {
    if(is_evaluated && active_set_.empty())
      residual_at_.get(residual_);
    else if(!lift(u) || !evaluate(u, residual_))
      return Status::ITERATIONS_EXHAUSTED;
    active_set_.hold_active(u, residual_, 0);
    for(std::size_t iteration = 0; ; ++iteration)
    {
      const double size = active_set_.violation(u, residual_);
      record(iteration, size);
      if(size <= (std::max)(options_.tolerance, rounding_floor()))
        return Status::OK;
      if(is_careful() && is_stuck_at_floor(iteration, size, u))
        return Status::OK;
      if(is_dazzled_by_needles(iteration, size, u))
        return leave_to_needles();
      if(!visitor_.go_further())
        return Status::STOPPED_BY_VISITOR;
      if(iteration == options_.number_of_iterations || (is_careful() && (has_stopped() || eliminate_.is_in_vain())))
        return is_left_to_needles(size, u) ? leave_to_needles() : Status::ITERATIONS_EXHAUSTED;
      if(is_crawling(iteration, u))
        return Status::ITERATIONS_EXHAUSTED;
      if(!solver_.has_factor() && !solver_.factorize(energy_.weights()))
        return Status::SINGULAR_PROBLEM;
      const bool stepped = options_.strategy == Newton_strategy::LINE_SEARCH ? line_search_step(u)
                                                                            : trust_region_step(u);
      if(has_given_up_)
        return Status::ITERATIONS_EXHAUSTED;
      if(!stepped && size <= 10 * rounding_floor())
        return Status::OK;
      if(!stepped)
        return is_left_to_needles(size, u) ? leave_to_needles() : Status::ITERATIONS_EXHAUSTED;
      ++statistics_.number_of_iterations;
      if(active_set_.settle(u))
        evaluate(u, residual_);
    }
  }

  // Was the end foreseen? It is that triangles remain broken.
  bool has_given_up() const { return has_given_up_; }

  // Was it foreseen, and is u on the way to it, not astray? Then another way can go on from there.
  bool has_come_near() const { return has_given_up_ && statistics_.residual < 0.5 * statistics_.residuals.front(); }

  // Is u no solution yet, as it is up to the wider type to tell the angles of needles?
  bool has_left_needles() const { return has_left_needles_; }

private:
  // Where edges are flipped on the way steps are bounded. (Where bounds are active, residuals may grow on the way.)
  bool is_careful() const { return energy_.has_flips() && active_set_.empty(); }

  // Has the residual been the same for a while? Where triangles are not broken it is not, unless steps come to nothing by rounding.
  bool has_stopped() const
  {
    const std::vector<double>& history = statistics_.residuals;
    const std::size_t a_while = 10;
    if(history.size() <= a_while)
      return false;
    const auto extremes = std::minmax_element(history.end() - a_while - 1, history.end());
    return *extremes.second - *extremes.first <= 1e-6 * *extremes.second;
  }

  // Near the rounding floor, however high that is, and without gain for a while: what is left to do is up to the wider type.
  bool is_stuck_at_floor(std::size_t iteration, double size, const Vertex_vector& u)
  {
    if(size <= least_ / 2)
    {
      least_ = size;
      last_gain_ = iteration;
    }
    return iteration >= last_gain_ + 5 && is_at_floor(size, u, 1);
  }

  // Is what is left no more than rounding may have done? (Of more than `most` it is not to be believed.)
  bool is_at_floor(double size, const Vertex_vector& u, double most)
  {
    if(size > most)
      return false;
    statistics_.residual_floor = floor_ = measured_floor();
    return size <= (std::max)(10., 4 * largest_entry(u)) * floor_; // (u itself is rounded)
  }

  // At the end, is it up to the wider type to tell the angles of needles? (There is none where numbers range too far for the last steps.)
  bool is_left_to_needles(double size, const Vertex_vector& u)
  {
    const double most = 4; // radians: pi, at a needle of which the angles are not to be told, and a little more
    return is_careful() && largest_entry(u) <= options_.largest_u && is_at_floor(size, u, most);
  }

  // Where lengths range far, needles may be so thin that steps go to and fro among angles that cannot be told: then the end is near.
  bool is_dazzled_by_needles(std::size_t iteration, double size, const Vertex_vector& u)
  {
    const double dazzling = 0.01; // radians
    return energy_.ranges_far() && iteration >= last_gain_ + 5 && is_left_to_needles(size, u) && floor_ >= dazzling;
  }

  Status leave_to_needles()
  {
    has_left_needles_ = true;
    return Status::OK;
  }

  // r at u; false if u is out of the range of double.
  bool evaluate(const Vertex_vector& u, Vertex_vector& r) { return residual_at_.evaluate(u, r); }

  // Makes u satisfy the bounds. Returns whether that was possible.
  bool lift(Vertex_vector& u)
  {
    return active_set_.is_feasible(u) || (evaluate(u, residual_) && active_set_.lift(u));
  }

  // Below this a residual cannot be told from rounding. It is of interest, and
  // hardly changes any more, when the residual has become small.
  double rounding_floor()
  {
    if(floor_ == 0 && statistics_.residual <= 1e-4)
      floor_ = measured_floor();
    return floor_;
  }

  double measured_floor() const
  {
    double largest = 0;
    const std::vector<double> sensitivity = energy_.sensitivities();
    for(std::size_t v = 0; v < sensitivity.size(); ++v)
      if(solver_.graph().is_free(std::uint32_t(v)))
        largest = (std::max)(largest, sensitivity[v]);
    return 4 * std::numeric_limits<double>::epsilon() * largest;
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
  bool newton_direction(const Vertex_vector& u, Vertex_vector& d)
  {
    const double eta = forcing_term();
    if(!active_set_.empty())
      return (active_set_.step(u, residual_, eta, d) && dot(residual_, d) > 0)
          || (active_set_.step(u, residual_, 1e-6 * eta, d) && dot(residual_, d) > 0);
    if(!model_.solve_by_kept_factor(residual_, eta, d))
    {
      const double as_solved_for_roughly = 10;
      has_given_up_ = is_hopeless(d, as_solved_for_roughly);
      if(has_given_up_)
        return true;
      if(!model_.solve_by_new_factor(residual_, eta, d))
        return false;
    }
    return dot(residual_, d) > 0 || (solver_.precondition(residual_, d) && dot(residual_, d) > 0);
  }

  // Will a triangle that is broken now remain so? The step d that comes next tells about how far u still has to go. Where there is a minimum
  // without broken triangles, and the patches around those that are broken are at their minimum already, no triangle was ever seen to
  // remain broken for more than 2.2 times d (of 362 problems); without such patches, for more than 160 times. Where there is none, d soon
  // is so short that a multiple of a hundred thousand does not mend it.
  bool is_hopeless(const Vertex_vector& d, double caution = 1) const
  {
    const double safe_multiple = energy_.has_flips() ? 1000 : 30;
    return options_.may_give_up && active_set_.empty() && statistics_.residuals.size() > 1
        && energy_.stays_broken(d, caution * safe_multiple);
  }

  // The same in a trust region, where a step may be short just because the region is: will a triangle remain broken at the pace of the last
  // steps?
  bool is_crawling(std::size_t iteration, const Vertex_vector& u)
  {
    const std::size_t a_while = 10;
    const double safe_multiple = 30;
    if(!options_.may_give_up || energy_.has_flips() || !is_lost_)
      return false;
    if(landmark_.empty())
      set_landmark(iteration, u);
    if(iteration < landmark_iteration_ + a_while)
      return false;
    Vertex_vector moved(u);
    for(std::size_t v = 0; v < u.size(); ++v)
      moved[v] -= landmark_[v];
    set_landmark(iteration, u);
    return energy_.stays_broken(moved, safe_multiple);
  }

  void set_landmark(std::size_t iteration, const Vertex_vector& u)
  {
    landmark_ = u;
    landmark_iteration_ = iteration;
  }

  // How steeply E may rise at the end of a step, relative to its fall at the start. Where nothing was gained for a while, not
  // at all: then E, which is convex, is lower than at the start for certain.
  double tolerable_rise() const
  {
    if(!is_careful())
      return 0.5;
    return statistics_.residuals.size() > last_gain_ + 10 && statistics_.residual > 0.1 ? 0 : 0.1;
  }

  // Is a step so long as the Hessian is singular? Where edges are flipped on the way steps are bounded, and long where u has far to go; what is
  // broken there are needles that rounding has broken, or triangles at a border that is kept, and a trust region would be lost among them.
  bool is_useless(const Vertex_vector& d) const
  {
    const double longest_step = 10; // in u
    return !is_careful() && !energy_.broken_faces().empty() && !(largest_entry(d) <= longest_step);
  }

  // Goes along d as far as the derivative of E has not become so much as half as
  // large upwards as it was downwards at the start. Where triangles are broken the
  // Hessian may be singular, and d useless; from then on, until no triangle
  // is broken any more, a trust region tells how far to go.
  bool line_search_step(Vertex_vector& u)
  {
    is_lost_ = is_lost_ && !energy_.broken_faces().empty();
    if(is_lost_)
      return trust_region_step(u);
    Vertex_vector d;
    if(!newton_direction(u, d) || is_useless(d))
      return begin_trust_region(u);
    has_given_up_ = has_given_up_ || is_hopeless(d);
    if(has_given_up_)
      return false;
    const double slope = dot(residual_, d);
    Vertex_vector trial(u.size()), r;
    // far away, triangulations are flipped in vain
    const double longest = is_careful() ? reach_ : std::numeric_limits<double>::infinity(); // in u
    const double first = (std::min)(1., longest / largest_entry(d));
    for(double t = first; t > 1e-6 * first; )
    {
      active_set_.move(u, t, d, trial);
      const bool is_finite = evaluate(trial, r);
      double slope_there = is_finite ? dot(r, d) : -std::numeric_limits<double>::infinity();
      if(is_finite && active_set_.empty() && eliminate_(t, residual_, trial, r))
        slope_there = (dot(r, trial) - dot(r, u)) / t;
      if(slope_there >= -tolerable_rise() * slope)
      {
        adapt_reach(first, t < first, slope_there / slope);
        u.swap(trial);
        residual_.swap(r);
        return true;
      }
      t = shorter_step(t, slope, slope_there);
    }
    return begin_trust_region(u);
  }

  // Where u is to go very far, as on a long strip, steps that are cut short leave E falling at nearly the same pace. If that is seen
  // for a while, or if they are but a hundredth of what they were, the next one may be longer.
  void adapt_reach(double part, bool is_cut_further, double remaining_slope)
  {
    const int a_while = 3;
    const bool is_far_from_end = part < 1 && !is_cut_further && remaining_slope > 0.25;
    short_steps_ = is_far_from_end ? short_steps_ + 1 : 0;
    if(is_far_from_end && (short_steps_ > a_while || (part <= 0.01 && remaining_slope > 0.5)))
      reach_ = (std::min)(2 * reach_, longest_reach());
    else if(part == 1 || is_cut_further || remaining_slope <= 0)
      reach_ = least_reach;
  }

  // Where there is no minimum E may fall for ever. On strips and the like u ranges over one or two a vertex, and over what lengths range.
  double longest_reach() const { return 1500 + 2. * double(solver_.graph().number_of_free); }

  // The factor for the trust region is that of the first metric again: a Hessian at broken triangles makes a
  // bad norm. Where no triangle is broken and little is left to do, it is rounding that keeps the line search from going on.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  bool begin_trust_region(Vertex_vector& u)
  {
    evaluate(u, residual_);
    if(energy_.broken_faces().empty() && largest_entry(residual_) < 1e-6)
      return false;
    is_lost_ = true;
    region_.reset();
    energy_.evaluate(Vertex_vector(u.size(), 0.));
    const bool has_factor = solver_.factorize(energy_.weights());
    evaluate(u, residual_);
    return has_factor && trust_region_step(u);
  }

  // A step of Newton-Steihaug. The decrease of 2 E is the integral of r along the step, by the trapezoidal rule. Every attempt that fails makes
  // the region at least four times smaller, which after `most_attempts` is less than u can be told apart.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  bool trust_region_step(Vertex_vector& u)
  {
    const int most_attempts = 60;
    Vertex_vector trial(u.size()), r;
    double distance = active_set_.empty() ? 0 : (std::min)(1e-3, active_set_.violation(u, residual_)); // of bounds that count as active
    for(int attempt = 0; attempt < most_attempts; ++attempt, distance /= 4)
    {
      Vertex_vector d;
      active_set_.hold_active(u, residual_, distance);
      if(!region_.find_step(residual_, forcing_term(), d))
        return false;
      active_set_.project(u, d);
      const double predicted = dot(residual_, d) - dot(d, model_.product(d)) / 2;
      active_set_.move(u, 1, d, trial);
      const bool is_finite = evaluate(trial, r);
      const double actual = is_finite && predicted > 0 ? (dot(residual_, d) + dot(r, d)) / 2 : -1;
      const double ratio = predicted > 0 ? actual / predicted : -1;
      region_.adapt(ratio);
      if(ratio > 0.1)
      {
        u.swap(trial);
        residual_.swap(r);
        return true;
      }
      evaluate(u, residual_);
      if(region_.is_empty())
        return false;
    }
    return false;
  }

  Abstract_energy& energy_;
  Laplacian_solver& solver_;
  const Newton_options options_;
  Statistics& statistics_;
  const Any_visitor& visitor_;
  Angle_residual residual_at_;
  Nonlinear_elimination eliminate_;
  Quadratic_model model_;
  Active_set active_set_;
  Trust_region region_;
  Vertex_vector residual_;
  double floor_ = 0;
  double least_ = std::numeric_limits<double>::infinity(); // residual, in steps of at least one half
  std::size_t last_gain_ = 0;                              // the iteration when it was found
  static constexpr double least_reach = 5;
  double reach_ = least_reach;        // of a step in u, where it is bounded
  int short_steps_ = 0;               // that were cut to the reach, one after the other
  Vertex_vector landmark_;  // u where the trust region was some steps ago
  std::size_t landmark_iteration_ = 0;
  bool has_given_up_ = false, has_left_needles_ = false;
  bool is_lost_ = false; // line search has failed among broken triangles
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_NEWTON_METHOD_H
