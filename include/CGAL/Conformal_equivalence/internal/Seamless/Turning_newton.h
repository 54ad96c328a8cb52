// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Newton's method for a flat metric with prescribed angle sums and prescribed turnings of loops (Turning_equations.h).
//
// Every metric is held by the lengths of a Delaunay triangulation of its own. A step is made in the lengths, then the triangulation is made
// Delaunay by Ptolemy flips: these change the coordinates of a point of one and the same space, that of all decorated hyperbolic metrics, and
// so they spoil nothing of what the step has won (Penner, 1987; Springborn, 2020). On a fixed triangulation the method
// gets stuck. Where a step has not brought what it should, the angle sums are had again by a conformal change (Turning_metric.h), and the step
// is judged by what it has done to the turnings. So on long thin handles a few steps do what hundreds do not when all equations are
// judged together.
//
// Most of the time goes into the linearized equations, which have a solution for each loop: they serve for further steps as long as these bring
// enough and no edge is flipped. As long as the turnings are far from their targets, a step also leads back towards the class given: so what
// has been done to it in all, along a way that bends, is close to the least.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TURNING_NEWTON_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TURNING_NEWTON_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Multifrontal_solver_traits.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Dual_loops.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Turning_equations.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Turning_metric.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

struct Turning_newton_options
{
  double tolerance = 1e-12;           // radians
  std::size_t maximum_number_of_steps = 200;
  std::size_t maximum_number_of_trials = 1000; // each of which takes about as long as a conformal solve; a good step takes one
  double growth_on_return = 1.02;     // of the residual, at most, on the way back towards the conformal class given
  bool may_give_up = false;           // as soon as steps have become so small that another target is the better choice
  Any_visitor visitor;                // is told the steps and may stop them
  Factorization_maker make_factorization = [] { return internal::make_factorization<Default_solver_traits>(); };
};

// `NT` is `double`: it is a template so that it can be compiled once (compiled.h).
template <typename NT>
class Turning_newton
{
  typedef std::uint32_t Index;

public:
  // `equations`: those at the metric given, if they are there, factorized. \pre the triangulation is connected, and its lengths are positive
  Turning_newton(Intrinsic_triangulation<NT> t, Dual_loops loops, Turning_targets targets, const Turning_newton_options& options,
                 std::shared_ptr<Turning_equations> equations = nullptr);

  Turning_metric run();

  // The metric given, Delaunay and with the angle sums: where `run()` begins. Can be called before it.
  const Turning_metric& begin()
  {
    if(!is_begun_)
      prepare();
    is_begun_ = true;
    return metric_;
  }

private:
  // The angle sums are left as they are if there is no metric that has them.
  void prepare()
  {
    if(!projection_.make_delaunay(metric_))
    {
      if(bool(metric_))
        metric_.status = Status::ITERATIONS_EXHAUSTED;
      return;
    }
    bool is_valid = true;
    measure(metric_, residual_, is_valid);
    if(!is_valid || angle_residual(residual_) > options_.tolerance)
    {
      Turning_metric conformal = metric_;
      if(projection_.make_conformal(conformal, options_.tolerance))
        metric_ = std::move(conformal);
      else if(!bool(conformal))
        metric_.status = conformal.status;
      measure(metric_, residual_, is_valid);
    }
    metric_.residuals.push_back(largest(residual_));
    metric_.follow_departure();
  }

  void measure(const Turning_metric& metric, Eigen::VectorXd& residual, bool& is_valid) const
  {
    const Corner_angles corners(metric.triangulation);
    is_valid = corners.are_triangles;
    residual = turning_residual(metric.triangulation, metric.loops, targets_, rows_, corners);
  }

  static double largest(const Eigen::VectorXd& residual) { return residual.size() == 0 ? 0 : residual.lpNorm<Eigen::Infinity>(); }

  double angle_residual(const Eigen::VectorXd& residual) const { return largest(residual.head(rows_.number_of_vertices())); }

  void find()
  {
    begin();
    while(bool(metric_) && metric_.residual() > options_.tolerance)
    {
      options_.visitor.on_iteration(metric_.number_of_steps, metric_.residual());
      if(!options_.visitor.go_further())
      {
        metric_.status = Status::STOPPED_BY_VISITOR;
        return;
      }
      if(metric_.number_of_steps == options_.maximum_number_of_steps || has_no_trials_left() || is_slow() || is_rounded())
        return give_up();
      if(!step() && bool(metric_))
        return give_up();
    }
  }

  bool has_no_trials_left() const { return number_of_trials_ >= options_.maximum_number_of_trials; }

  // Steps so long decide by how much the conformal class is left.
  bool is_far_away() const
  {
    const double far_away = 0.1; // radians
    return residual_.norm() > far_away;
  }

  Eigen::Index number_of_loops() const { return residual_.size() - rows_.number_of_vertices(); }

  // In the equations that are there, if they serve still, else in new ones. \return `false` if there is none, or if it was stopped
  bool step()
  {
    if(equations_ && flips_of_equations_ == metric_.flips.size() && (step_along(equations_->least_change(-residual_), true) || !bool(metric_)))
      return bool(metric_);
    if(!linearize())
      metric_.status = Status::SINGULAR_PROBLEM;
    if(bool(metric_) && is_far_away()
       && (step_along(equations_->change_to_departure(-residual_, metric_.departure()), true) || !bool(metric_)))
      return bool(metric_);
    return bool(metric_) && step_along(equations_->least_change(-residual_), false);
  }

  bool linearize()
  {
    equations_ = std::make_shared<Turning_equations>(metric_.triangulation, metric_.loops, rows_, options_.make_factorization());
    flips_of_equations_ = metric_.flips.size();
    return equations_->factorize();
  }

  // Whether it takes too long, if that matters: in some steps the residual should have become a half at least.
  bool is_slow() const
  {
    const std::size_t some = 6, n = metric_.residuals.size();
    return options_.may_give_up && n > some && metric_.residuals[n - 1] > metric_.residuals[n - 1 - some] / 2;
  }

  // Newton's method would make more of such a residual, if it were not for rounding.
  bool is_rounded() const
  {
    const std::size_t n = metric_.residuals.size();
    return n > 1 && metric_.residuals[n - 1] < roundings && metric_.residuals[n - 1] > metric_.residuals[n - 2] / 2;
  }

  // As far along the way as reduces the residual; `is_trial`: all the way, and well, or not at all, as there is another one. \return `false` if
  // there is no such step, or if it was stopped
  bool step_along(const Eigen::VectorXd& change, bool is_trial)
  {
    const double farthest = 20;  // of a logarithm of a squared length in one step: beyond, there is nothing but flips
    const double least = 1e-5;   // below this part of a step nothing is won but time lost
    const double well = 0.3;     // of the residual is to be left at most; or other equations do better
    const double size = largest(change), before = residual_.norm(), longest = (std::min)(1., farthest / size);
    if(!std::isfinite(size))
      return false;
    for(double part = longest; part >= (is_trial ? 1. : least) && bool(metric_) && !has_no_trials_left(); part /= 2)
    {
      if(!try_step(part, change, is_trial ? well : 1 - 1e-4 * part))
        continue;
      ++metric_.number_of_steps;
      metric_.least_step = (std::min)(metric_.least_step, part);
      if(residual_.norm() > well * before)
        equations_.reset();
      if(part < 1)
        return_towards_class();
      metric_.residuals.push_back(largest(residual_));
      return true;
    }
    return false;
  }

  // Where only parts of steps can be taken the way bends, and what is done to the conformal class grows beyond what it takes, until there is no
  // way from there: so it is undone, as far as the turnings are kept.
  void return_towards_class()
  {
    const std::size_t most = 3; // changes, of which the first does most
    for(std::size_t n = 0; n < most && bool(metric_) && !has_no_trials_left(); ++n)
      if(!linearize() || !return_along(equations_->change_to_departure(Eigen::VectorXd::Zero(residual_.size()), metric_.departure())))
        return;
    equations_.reset();
  }

  // \return `false` if nothing is won
  bool return_along(const Eigen::VectorXd& change)
  {
    const double least = 0.1, less = 0.95;
    for(double part = 1; part >= least && bool(metric_) && !has_no_trials_left(); part /= 2)
    {
      ++number_of_trials_;
      Turning_metric trial = metric_;
      if(change_lengths(trial, part * change) && restore_angles(trial) && trial.departure().norm() < less * metric_.departure().norm()
         && take_if_below(options_.growth_on_return * residual_.norm(), trial))
        return true;
    }
    return false;
  }

  // The step as it is if it does what it should, else with the angle sums had again, if that leaves no more than `most` of the residual.
  bool try_step(double part, const Eigen::VectorXd& change, double most)
  {
    const double little = 0.1;          // of the residual: nothing has to be done about what is left
    ++number_of_trials_;
    const double before = residual_.norm();
    Turning_metric trial = metric_;
    if(!change_lengths(trial, part * change))
      return false;
    return take_if_below((std::max)(options_.tolerance, little * before), trial)
        || (restore_angles(trial) && take_if_below(most * before, trial));
  }

  // \return `false` if it cannot be done, or is stopped
  bool change_lengths(Turning_metric& trial, const Eigen::VectorXd& change)
  {
    return note_stop(trial, stretch(trial.triangulation, change) && projection_.make_delaunay(trial));
  }

  bool restore_angles(Turning_metric& trial)
  {
    const double part = 1e-5; // of the residual, at most, is left of them
    return note_stop(trial, projection_.make_conformal(trial, part * residual_.norm()));
  }

  bool note_stop(const Turning_metric& trial, bool is_done)
  {
    if(trial.status == Status::STOPPED_BY_VISITOR)
      metric_.status = trial.status;
    return is_done;
  }

  bool take_if_below(double most, Turning_metric& trial)
  {
    Eigen::VectorXd after;
    bool is_valid = true;
    measure(trial, after, is_valid);
    if(!is_valid || !(after.norm() <= most))
      return false;
    metric_ = std::move(trial);
    residual_ = std::move(after);
    return true;
  }

  // Adds `change` to the logarithms of the squared lengths. \return `false` if one leaves the range in which flips are computed
  static bool stretch(Intrinsic_triangulation<NT>& t, const Eigen::VectorXd& change)
  {
    for(Index e = 0; e < t.number_of_edges(); ++e)
    {
      const double length = t.length(e) * std::exp(change[e] / 2);
      if(!(length > 1e-250 && length < 1e250))
        return false;
      t.set_length(e, length);
    }
    return true;
  }

  // Rounding may have made further steps impossible: then the metric found is as good as it gets.
  void give_up()
  {
    metric_.status = metric_.residual() < roundings ? Status::CONVERGED_TO_ROUNDING : Status::ITERATIONS_EXHAUSTED;
    metric_.amount = metric_.residual();
  }

  // Far more than rounding leaves of a residual (radians), far less than the method would stop at otherwise.
  static constexpr double roundings = 1e-9;

  Turning_metric metric_;
  Eigen::VectorXd residual_;
  std::size_t number_of_trials_ = 0;
  bool is_begun_ = false;
  std::shared_ptr<Turning_equations> equations_; // at some metric before
  std::size_t flips_of_equations_ = 0;           // how many there were then: they are those of a triangulation
  const Turning_targets targets_;
  const Turning_newton_options options_;
  Turning_rows rows_;
  Turning_projection projection_;
};

template <typename NT>
Turning_newton<NT>::Turning_newton(Intrinsic_triangulation<NT> t, Dual_loops loops, Turning_targets targets,
                                   const Turning_newton_options& options, std::shared_ptr<Turning_equations> equations)
  : equations_(std::move(equations)), targets_(std::move(targets)), options_(options), rows_(t, targets_.is_free),
    projection_(t, targets_, options.tolerance, options.make_factorization, options.visitor)
{
  metric_.triangulation = std::move(t);
  metric_.loops = std::move(loops);
}

template <typename NT>
Turning_metric Turning_newton<NT>::run()
{
  find();
  return std::move(metric_);
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template Turning_newton<double>::Turning_newton(Intrinsic_triangulation<double>, Dual_loops, Turning_targets,
                                                       const Turning_newton_options&, std::shared_ptr<Turning_equations>);
extern template Turning_metric Turning_newton<double>::run();
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TURNING_NEWTON_H
