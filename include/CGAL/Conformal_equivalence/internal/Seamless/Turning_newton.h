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
// While the angle sums are had by themselves there is one unknown for each loop: how far to go in the direction that turns it. These directions
// serve for several steps, with derivatives that are corrected by what steps have done (Broyden, "A class of methods for solving nonlinear simultaneous
// equations", 1965); new ones are found where that is not enough.

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
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

struct Turning_newton_options
{
  double tolerance = 1e-12;           // radians
  std::size_t maximum_number_of_steps = 200;
  std::size_t maximum_number_of_trials = 1000; // each of which takes about as long as a conformal solve; a good step takes one
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
  // `directions`: as in a `Turning_metric`, if they are known. \pre the triangulation is connected, and its lengths are positive
  Turning_newton(Intrinsic_triangulation<NT> t, Dual_loops loops, Turning_targets targets, const Turning_newton_options& options,
                 Turning_metric::Directions directions = Turning_metric::Directions());

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
      if(projection_.make_conformal(conformal))
        metric_ = std::move(conformal);
      else if(!bool(conformal))
        metric_.status = conformal.status;
      measure(metric_, residual_, is_valid);
    }
    metric_.residuals.push_back(largest(residual_));
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
      if(metric_.number_of_steps == options_.maximum_number_of_steps || has_no_trials_left() || is_slow())
        return give_up();
      if(step_in_known_directions() || !bool(metric_))
        continue;
      const Corner_angles corners(metric_.triangulation);
      Turning_equations equations(metric_.triangulation, metric_.loops, rows_, corners, options_.make_factorization());
      if(!equations.factorize())
        metric_.status = Status::SINGULAR_PROBLEM;
      else if(!step_in_new_directions(equations) && bool(metric_))
        return give_up();
    }
  }

  bool has_no_trials_left() const { return number_of_trials_ >= options_.maximum_number_of_trials; }

  // Steps so long decide by how much the conformal class is left: for these it pays to find the best directions anew.
  bool is_far_away() const
  {
    const double far_away = 0.02; // radians
    return residual_.norm() > far_away;
  }

  Eigen::Index number_of_loops() const { return residual_.size() - rows_.number_of_vertices(); }

  bool step_in_known_directions()
  {
    if(are_directions_stale_ || metric_.directions.size() == 0)
      return false;
    if(jacobian_.size() == 0)
      jacobian_.setIdentity(number_of_loops(), number_of_loops());
    const Eigen::VectorXd extent = -jacobian_.partialPivLu().solve(residual_.tail(number_of_loops()));
    return step(metric_.directions * extent, extent, false);
  }

  bool step_in_new_directions(Turning_equations& equations)
  {
    const Eigen::Index n = number_of_loops(), first = rows_.number_of_vertices(), edges = metric_.triangulation.number_of_edges();
    const double near_enough = 0.3; // radians: from here a step comes so near that these directions serve once more
    metric_.directions.resize(0, 0);
    if(n > 0 && residual_.norm() < near_enough && Turning_metric::can_keep_directions(n, metric_.triangulation))
    {
      metric_.directions.resize(edges, n);
      for(Eigen::Index j = 0; j < n; ++j)
        metric_.directions.col(j) = equations.least_change(Eigen::VectorXd::Unit(first + n, first + j));
      jacobian_.setIdentity(n, n);
    }
    return step(equations.least_change(-residual_), -residual_.tail(n), true);
  }

  // Whether it takes too long, if that matters: in some steps the residual should have become a half at least.
  bool is_slow() const
  {
    const std::size_t some = 6, n = metric_.residuals.size();
    return options_.may_give_up && n > some && metric_.residuals[n - 1] > metric_.residuals[n - 1 - some] / 2;
  }

  // As far along the way as reduces the residual. `extent`: how far that is in the directions; `is_complete`: the change is one for the angle sums,
  // too. \return `false` if there is no such step, or if it was stopped
  bool step(const Eigen::VectorXd& change, const Eigen::VectorXd& extent, bool is_complete)
  {
    const double farthest = 20;      // of a logarithm of a squared length in one step: beyond, there is nothing but flips
    const double long_enough = 0.2;  // shorter parts tell that the way is not straight
    const double least = is_complete ? 1e-5 : long_enough; // below this part of a step nothing is won but time lost
    const double size = largest(change);
    if(!std::isfinite(size))
      return false;
    const Eigen::VectorXd before = residual_;
    for(double part = (std::min)(1., farthest / size); part >= least && bool(metric_) && !has_no_trials_left(); part /= 2)
    {
      if(!try_step(part, change, is_complete))
        continue;
      ++metric_.number_of_steps;
      metric_.least_step = (std::min)(metric_.least_step, part);
      metric_.residuals.push_back(largest(residual_));
      learn(part * extent, before);
      return true;
    }
    return false;
  }

  // Corrects the derivatives, or says that the directions have done what they could.
  void learn(const Eigen::VectorXd& extent, const Eigen::VectorXd& before)
  {
    const double enough = 0.3; // of the residual, at most, is to be left by a step
    are_directions_stale_ = is_far_away() || residual_.norm() > enough * before.norm();
    if(jacobian_.size() != 0 && extent.squaredNorm() > 0)
    {
      const Eigen::VectorXd turned = residual_.tail(number_of_loops()) - before.tail(number_of_loops());
      jacobian_ += (turned - jacobian_ * extent) * extent.transpose() / extent.squaredNorm();
    }
  }

  // The step as it is if it is the last one, else with angle sums had again, as steps in known directions take for granted.
  bool try_step(double part, const Eigen::VectorXd& change, bool is_complete)
  {
    ++number_of_trials_;
    Turning_metric trial = metric_;
    if(stretch(trial.triangulation, part * change) && projection_.make_delaunay(trial))
    {
      if(is_complete && take_if_below(options_.tolerance, trial))
        return true;
      if(projection_.make_conformal(trial) && take_if_below((1 - 1e-4 * part) * residual_.norm(), trial))
        return true;
    }
    if(trial.status == Status::STOPPED_BY_VISITOR)
      metric_.status = trial.status;
    return false;
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
    const double roundings = 1e-9; // far more than rounding leaves of a residual, far less than Newton's method would stop at otherwise
    metric_.status = metric_.residual() < roundings ? Status::CONVERGED_TO_ROUNDING : Status::ITERATIONS_EXHAUSTED;
    metric_.amount = metric_.residual();
  }

  Turning_metric metric_;
  Eigen::VectorXd residual_;
  std::size_t number_of_trials_ = 0;
  Eigen::MatrixXd jacobian_; // of the turnings, for steps in the directions; empty: as these were made for
  bool are_directions_stale_ = false, is_begun_ = false;
  const Turning_targets targets_;
  const Turning_newton_options options_;
  Turning_rows rows_;
  Turning_projection projection_;
};

template <typename NT>
Turning_newton<NT>::Turning_newton(Intrinsic_triangulation<NT> t, Dual_loops loops, Turning_targets targets,
                                   const Turning_newton_options& options, Turning_metric::Directions directions)
  : targets_(std::move(targets)), options_(options), rows_(t, targets_.is_free),
    projection_(t, targets_, options.tolerance, options.make_factorization, options.visitor)
{
  metric_.triangulation = std::move(t);
  metric_.loops = std::move(loops);
  metric_.directions = std::move(directions);
}

template <typename NT>
Turning_metric Turning_newton<NT>::run()
{
  find();
  return std::move(metric_);
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template Turning_newton<double>::Turning_newton(Intrinsic_triangulation<double>, Dual_loops, Turning_targets,
                                                       const Turning_newton_options&, Turning_metric::Directions);
extern template Turning_metric Turning_newton<double>::run();
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TURNING_NEWTON_H
