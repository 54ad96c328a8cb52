// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Newton's method for a flat metric with prescribed angle sums and prescribed turnings of loops (Turning_equations.h).
//
// Every metric is held by the lengths of a Delaunay triangulation of its own. A step is made in the lengths, then the triangulation is made
// Delaunay by Ptolemy flips: these change the coordinates of a point of one and the same space, that of all decorated hyperbolic metrics, and
// so they spoil nothing of what the step has won (Penner, 1987; Springborn, 2020). On a fixed triangulation the method
// gets stuck.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TURNING_NEWTON_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TURNING_NEWTON_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Delaunay_flipper.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Dual_loops.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Turning_equations.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A metric whose triangulation is on its way, with the loops on it. The status is `OK`, `CONVERGED_TO_ROUNDING`, `ITERATIONS_EXHAUSTED`,
// `SINGULAR_PROBLEM`, `STOPPED_BY_VISITOR`.
struct Turning_metric : public Outcome
{
  typedef std::uint32_t Index;

  Intrinsic_triangulation<double> triangulation;
  Dual_loops loops;
  std::vector<Index> flips;           // of the triangulation given, in order
  std::size_t number_of_steps = 0;
  double least_step = 1;              // the least part of a Newton step that was taken
  std::vector<double> residuals;      // largest differences from the targets (radians): before each step, and at the end

  double residual() const { return residuals.empty() ? 0 : residuals.back(); }
};

struct Turning_newton_options
{
  double tolerance = 1e-12;           // radians
  std::size_t maximum_number_of_steps = 200;
  double epsilon = Turning_equations::default_epsilon;
  Any_visitor visitor;                // is told the steps and may stop them
};

// `NT` is `double`: it is a template so that it can be compiled once (compiled.h).
template <typename NT>
class Turning_newton
{
  typedef std::uint32_t Index;

public:
  // \pre the triangulation is connected, and its lengths are positive
  Turning_newton(Intrinsic_triangulation<NT> t, Dual_loops loops, Turning_targets targets, const Turning_newton_options& options);

  Turning_metric run();

private:
  void make_delaunay()
  {
    if(!flip_to_delaunay(metric_))
      metric_.status = Status::ITERATIONS_EXHAUSTED;
  }

  bool flip_to_delaunay(Turning_metric& metric) const
  {
    Delaunay_flipper<NT> flipper(metric.triangulation);
    return flipper.flip_to_delaunay(std::vector<double>(), all_edges(metric.triangulation), Flip_rule::PTOLEMY, [&](Index e)
    {
      metric.loops.flip(metric.triangulation, e);
      metric.flips.push_back(e);
    });
  }

  void measure(const Turning_metric& metric, Eigen::VectorXd& residual, bool& is_valid) const
  {
    const Corner_angles corners(metric.triangulation);
    is_valid = corners.are_triangles;
    residual = turning_residual(metric.triangulation, metric.loops, targets_, rows_, corners);
  }

  static double largest(const Eigen::VectorXd& residual) { return residual.size() == 0 ? 0 : residual.lpNorm<Eigen::Infinity>(); }

  void find()
  {
    make_delaunay();
    bool is_valid = true;
    Eigen::VectorXd residual;
    measure(metric_, residual, is_valid);
    metric_.residuals.push_back(largest(residual));
    while(metric_.status == Status::OK && metric_.residual() > options_.tolerance)
    {
      options_.visitor.on_iteration(metric_.number_of_steps, metric_.residual());
      if(!options_.visitor.go_further())
      {
        metric_.status = Status::STOPPED_BY_VISITOR;
        return;
      }
      if(metric_.number_of_steps == options_.maximum_number_of_steps)
        return give_up();
      Turning_equations equations(metric_.triangulation, metric_.loops, rows_, Corner_angles(metric_.triangulation), options_.epsilon);
      if(!equations.factorize())
        metric_.status = Status::SINGULAR_PROBLEM;
      else if(!step(equations.least_change(-residual), residual))
        return give_up();
    }
  }

  // As far along the way as reduces the residual. \return `false` if there is no such step
  bool step(const Eigen::VectorXd& change, Eigen::VectorXd& residual)
  {
    const double farthest = 20;  // of a logarithm of a squared length in one step: beyond, there is nothing but flips
    const double least = 1e-9;   // below this part of a step nothing is won but time lost
    const double size = largest(change), before = residual.norm();
    if(!std::isfinite(size))
      return false;
    double part = (std::min)(1., farthest / size);
    for(; part >= least; part /= 2)
    {
      Turning_metric trial = metric_;
      if(!stretch(trial.triangulation, part * change) || !flip_to_delaunay(trial))
        continue;
      Eigen::VectorXd after;
      bool is_valid = true;
      measure(trial, after, is_valid);
      if(!is_valid || !(after.norm() <= (1 - 1e-4 * part) * before))
        continue;
      metric_ = std::move(trial);
      residual = std::move(after);
      ++metric_.number_of_steps;
      metric_.least_step = (std::min)(metric_.least_step, part);
      metric_.residuals.push_back(largest(residual));
      return true;
    }
    return false;
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
  const Turning_targets targets_;
  const Turning_newton_options options_;
  Turning_rows rows_;
};

template <typename NT>
Turning_newton<NT>::Turning_newton(Intrinsic_triangulation<NT> t, Dual_loops loops, Turning_targets targets,
                                   const Turning_newton_options& options)
  : targets_(std::move(targets)), options_(options), rows_(t, targets_.is_free)
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
                                                       const Turning_newton_options&);
extern template Turning_metric Turning_newton<double>::run();
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_TURNING_NEWTON_H
