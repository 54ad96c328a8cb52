// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The last steps of the solver, in the wide number type: they reduce the residual until it is within the tolerance as measured there, with
// as many digits of the factors as that takes.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_REFINEMENT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_REFINEMENT_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/number_conversions.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Abstract_energy.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Component_scales.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Lower_bounds.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Quadratic_model.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>

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

// By how many units of epsilon rounding may move the angle sums, at most.
inline double largest_sensitivity(const Abstract_energy& energy, const Edge_graph& graph)
{
  double result = 1;
  const Vertex_vector sensitivity = energy.sensitivities();
  for(std::uint32_t v = 0; v < sensitivity.size(); ++v)
    if(graph.is_free(v))
      result = (std::max)(result, sensitivity[v]);
  return result;
}

template <typename NT>
class Wide_refinement
{
public:
  typedef Conformal_metric<NT> Metric;
  typedef typename Metric::Wide_number Wide_number;

  // Keeps references.
  Wide_refinement(Refinable_energy<NT>& energy, Laplacian_solver& linear, const Component_scales<NT>& scales,
                  const Conformal_conditions<NT>& conditions, const Lower_bounds& bounds, double tolerance)
    : energy_(energy), linear_(linear), scales_(scales), conditions_(conditions), bounds_(bounds), tolerance_(tolerance)
  {}

  // It may stop steps with flips, which take long.
  void set_visitor(const Any_visitor& visitor) { visitor_ = visitor; }

  // The factors that Newton's method has found.
  void begin(Vertex_vector& u, Metric& result) const
  {
    scales_.center(u);
    begin_at(conditions_, u, result.scale_factors);
  }

  // The last steps; then edges are flipped that are not Delaunay by so little that rounding has hidden it on the way.
  // Angle sums hardly differ between both triangulations, but as there may be needles they are made right again.
  // A round flips what the one before has uncovered: one or two are usual. Among cocircular vertices the least step flips some edge; therefore, after
  // `most_careful_rounds`, angle sums within the tolerance are not touched any more. Where there are flips after `most_rounds`, lengths are so
  // inaccurate that the triangulation is not to be had, and the angle sums are those of another one.
  void run(Vertex_vector& u, Metric& result)
  {
    const std::size_t steps = result.statistics.residuals.size();
    const int most_careful_rounds = 3, most_rounds = 10;
    begin(u, result);
    for(int round = 0; round < most_rounds; ++round)
    {
      const double goal = round < most_careful_rounds ? careful_goal() : tolerance_;
      result.statistics.residuals.resize(steps);
      result.status = Status::OK;
      const std::vector<Wide_number> start = result.scale_factors;
      if(bounds_.empty())
        refine(conditions_, goal, result);
      else
        refine_within_bounds(goal, u, result);
      if(may_be_resolved_by_flips(result) && resolve_by_flips(u, start, result))
      {
        result.statistics.residuals.resize(steps);
        result.status = Status::OK;
        result.amount = 0;
        refine(conditions_, goal, result);
      }
      if(!is_success(result.status) || !energy_.make_delaunay(result.scale_factors, u))
        return;
    }
    result.amount = result.statistics.residual;
    result.status = Status::ITERATIONS_EXHAUSTED;
  }

  // e^{u/2}, rounded to `double` where u is unknown, as it is still to be refined, and as exactly as can be where it is fixed.
  static void begin_at(const Conformal_conditions<NT>& conditions, const Vertex_vector& u, std::vector<Wide_number>& s)
  {
    s.resize(u.size());
    for(std::uint32_t v = 0; v < u.size(); ++v)
    {
      const double rounded = std::exp(u[v] / 2);
      s[v] = conditions.is_fixed(v) ? half_exponential(Wide_number(conditions.log_scale_factor(v)))
           : std::isnormal(rounded) ? Wide_number(rounded) : half_exponential(Wide_number(u[v]));
    }
  }

private:
  // The last steps, with the residual in the wide type and the linear systems in double: each step gains as many digits as the
  // linear system is solved for, up to the rounding of its matrix. As a residual costs more than an iteration of conjugate
  // gradients, every system is solved for as many digits as can be gained. Where that comes to nothing before the tolerance_ is
  // reached, the matrix is that of the wide metric, factorized anew; then all of the linear algebra runs in the wide type.
  // A step with error e^3 in s is as good as any: what counts is the s that comes out.
  void refine(const Conformal_conditions<NT>& conditions, double goal, Metric& result)
  {
    std::vector<Wide_number>& s = result.scale_factors;
    Wide_number known_floor(0);
    const auto floor = [&]
    {
      if(known_floor == 0)
        known_floor = 8 * std::numeric_limits<Wide_number>::epsilon() * largest_sensitivity(energy_, linear_.graph());
      return known_floor;
    };
    Scaled_vector residual = energy_.residual_at(s, conditions), next;
    Wide_number size = residual.template largest<Wide_number>();
    Refinement_arithmetic& arithmetic = result.statistics.refinement_arithmetic;
    arithmetic = Refinement_arithmetic::DOUBLE;
    std::vector<double> wide_weights; // empty: those of the energy
    double gain = (std::max)(1e-12, (std::min)(1e-3, static_cast<double>(size))); // of a step: the next residual relative to the last
    while(size > goal && !(size <= tolerance_ && size <= floor()) && std::isfinite(static_cast<double>(size)))
    {
      const double wanted = (std::max)({gain / 10, 1e-14, 0.3 * static_cast<double>(Wide_number(goal / size))});
      std::vector<Wide_number> moved = s;
      const bool has_moved = arithmetic == Refinement_arithmetic::WIDE
        ? energy_.add_newton_step(linear_.graph(), residual, moved)
        : add_newton_step(wide_weights.empty() ? energy_.weights() : wide_weights, residual, (std::min)(1e-3, wanted), result, moved);
      Wide_number next_size = size;
      if(has_moved)
      {
        next = energy_.residual_at(moved, conditions);
        next_size = next.template largest<Wide_number>();
      }
      if(next_size < size)
      {
        gain = static_cast<double>(Wide_number(next_size / size));
        s.swap(moved);
        std::swap(residual, next);
        size = next_size;
        if(gain < (size > tolerance_ ? 0.1 : 0.5))
          continue;
      }
      // nothing much is gained any more; what cannot be gained is the rounding of the targets, which then do not add up to what they must
      if(size <= tolerance_ || solvable(residual) <= floor() || arithmetic == Refinement_arithmetic::WIDE)
        break;
      gain = 1e-12;
      if(arithmetic == Refinement_arithmetic::DOUBLE)
      {
        arithmetic = Refinement_arithmetic::WIDE_WEIGHTS;
        wide_weights = energy_.weights_at(s);
        if(linear_.factorize(wide_weights))
          continue;
      }
      if(size <= known_rounding(result) && tolerance_ >= std::numeric_limits<double>::epsilon())
        break;
      arithmetic = Refinement_arithmetic::WIDE;
    }

    result.statistics.residual = rounded_up(size);
    result.statistics.residuals.push_back(result.statistics.residual);
    if(size <= tolerance_)
      return;
    if(size <= floor())
      result.statistics.residual_floor = rounded_up(floor());
    result.amount = result.statistics.residual;
    result.status = result.statistics.residual <= known_rounding(result) ? Status::CONVERGED_TO_ROUNDING : Status::ITERATIONS_EXHAUSTED;
  }

  // What rounding may leave. Among needles it may be any angle: then it says nothing about what is left.
  static double known_rounding(const Metric& result) { return (std::min)(result.statistics.residual_floor, close_in_double); }

  // Was `double` too short to come near to the solution? Then angles of needles are known too little in it to tell which edges are to be flipped.
  bool may_be_resolved_by_flips(const Metric& result) const
  {
    return result.status == Status::ITERATIONS_EXHAUSTED && result.statistics.residual > close_in_double && bounds_.empty() && energy_.has_flips()
        && !(has_range_of_double<NT>() && energy_.ranges_far());
  }

  // Newton's method in the wide type, with flips, from the factors `start` on: for metrics with needles of which the angles go from 0 to pi while
  // u changes by less than `double` can tell. Returns whether it has come near to the solution.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  bool resolve_by_flips(const Vertex_vector& u, const std::vector<Wide_number>& start, Metric& result)
  {
    const int most_steps = 100, a_while = 20; // steps
    const double worth_going_on = 0.9;        // of the residual a while ago
    const Wide_number close(close_in_double);
    std::vector<Wide_number>& s = result.scale_factors;
    s = start;
    flip_at(s, u);
    Scaled_vector residual = energy_.residual_at(s, conditions_);
    Wide_number size = residual.template largest<Wide_number>(), size_before = 2 * size;
    for(int step = 0; size > close; ++step)
    {
      if(step == most_steps || (step % a_while == 0 && size > worth_going_on * size_before))
        return false;
      if(step % a_while == 0)
        size_before = size;
      if(!visitor_.go_further())
      {
        result.status = Status::STOPPED_BY_VISITOR;
        return false;
      }
      if(!make_damped_step(u, s, residual, size))
        return false;
    }
    return true;
  }

  // A step, halved until the residual becomes less.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  bool make_damped_step(const Vertex_vector& u, std::vector<Wide_number>& s, Scaled_vector& residual, Wide_number& size)
  {
    const int most_halvings = 60;
    std::vector<Wide_number> moved;
    if(!make_short_step(residual, s, moved))
      return false;
    for(int halving = 0; halving < most_halvings; ++halving)
    {
      flip_at(moved, u);
      Scaled_vector next = energy_.residual_at(moved, conditions_);
      const Wide_number next_size = next.template largest<Wide_number>();
      if(next_size < size)
      {
        s.swap(moved);
        residual = std::move(next);
        size = next_size;
        return true;
      }
      for(std::size_t v = 0; v < s.size(); ++v)
        moved[v] = s[v] + (moved[v] - s[v]) / 2;
    }
    return false;
  }

  // To the Delaunay triangulation, if need be from the one given on.
  void flip_at(const std::vector<Wide_number>& s, const Vertex_vector& u)
  {
    energy_.make_delaunay(s, u);
    if(energy_.faces_violated_at(s).empty())
      return;
    energy_.take_flips_back();
    energy_.make_delaunay(s, u);
  }

  // A step of Newton's, or as much of it as changes no factor by more than about itself: where angles hardly change steps are much too long.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  bool make_short_step(Scaled_vector residual, const std::vector<Wide_number>& s, std::vector<Wide_number>& moved) const
  {
    const int most_attempts = 5;
    double change = 2;
    for(int attempt = 0; attempt < most_attempts && change > 1; ++attempt)
    {
      moved = s;
      if(!energy_.add_newton_step(linear_.graph(), residual, moved))
        return false;
      change = 0;
      for(std::size_t v = 0; v < s.size(); ++v)
        change = (std::max)(change, std::abs(static_cast<double>(Wide_number(moved[v] / s[v])) - 1));
      residual.exponent -= change < 1e300 ? 2 + std::ilogb(std::sqrt((std::max)(1., change))) : 500; // which is d^2 / 8 for a large step d
    }
    return change <= 1;
  }

  // Smaller than asked for, so that layouts are not spoiled by the sum of all residuals.
  double careful_goal() const { return 1e-4 * tolerance_; }

  // Multiplies `s` by e^{d / 2} for the d of a step of Newton's method with the weights `w`. Returns whether there was a factor for it.
  bool add_newton_step(const std::vector<double>& w, const Scaled_vector& residual, double accuracy,
                       Metric& result, std::vector<Wide_number>& s)
  {
    using std::ldexp;
    Vertex_vector right = residual.entries, d;
    linear_.graph().clear_fixed(right);
    bool converged;
    // more than in Newton's method: there are many digits to gain, and a residual in the wide type saved is worth a few iterations
    const std::size_t worth_a_factorization = 2 * iterations_worth_a_factorization;
    const std::size_t most_with_new_factor = 200; // only ends what rounding keeps from converging
    result.statistics.number_of_linear_iterations +=
      linear_.conjugate_gradients(w, right, accuracy, worth_a_factorization, true, d, converged);
    if(!converged && linear_.factorize(w))
      result.statistics.number_of_linear_iterations += linear_.conjugate_gradients(w, right, accuracy, most_with_new_factor, false, d, converged);
    scales_.center(d);
    for(std::uint32_t v = 0; v < d.size(); ++v)
      if(d[v] != 0)
      {
        const Wide_number step = ldexp(Wide_number(d[v]), residual.exponent);
        s[v] = factor_after_step(s[v], step);
      }
    return linear_.has_factor();
  }

  // The largest entry at a vertex where u is unknown.
  Wide_number solvable(Scaled_vector residual) const
  {
    linear_.graph().clear_fixed(residual.entries);
    return residual.template largest<Wide_number>();
  }

  // e^{u/2}
  static Wide_number half_exponential(const Wide_number& u)
  {
    using std::exp;
    return Wide_number(exp(Wide_number(u / 2)));
  }

  // As a double that is not 0 unless x is.
  static double rounded_up(const Wide_number& x)
  {
    return x == 0 ? 0 : (std::max)(static_cast<double>(x), std::numeric_limits<double>::denorm_min());
  }

  // The same with some of the bounds active, as the solution has them: where Newton's method could not tell by
  // rounding, the wide type does.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  void refine_within_bounds(double goal, Vertex_vector& u, Metric& result)
  {
    std::vector<char> active(u.size(), 0);
    for(std::uint32_t v = 0; v < u.size(); ++v)
      active[v] = u[v] <= bounds_.bound[v];
    // Newton's method has left only bounds open that double cannot decide, which one or two attempts settle; more are made only where
    // bounds change sides in circles.
    const int most_attempts = 20;
    for(int attempt = 0; attempt < most_attempts; ++attempt)
    {
      Conformal_conditions<NT> equalities = conditions_;
      for(std::uint32_t v = 0; v < u.size(); ++v)
        if(active[v])
          equalities.fix_log_scale_factor(v, NT(conditions_.lower_bound(v)));
      linear_.hold(active);
      result.status = Status::OK;
      begin_at(equalities, u, result.scale_factors);
      refine(equalities, goal, result);
      if(!is_success(result.status) || !exchange_bounds(result, active))
        return;
      for(std::uint32_t v = 0; v < u.size(); ++v)
        u[v] = active[v] ? bounds_.bound[v] : static_cast<double>(logarithm_of_factor<NT>(result.scale_factors[v]));
    }
    result.status = Status::ITERATIONS_EXHAUSTED;
  }

  // Activates the bounds that are violated, and releases those where the angle sum is too large. Returns whether there were any.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  bool exchange_bounds(const Metric& result, std::vector<char>& active) const
  {
    const double most = (std::max)(tolerance_, result.statistics.residual);
    Scaled_vector residual = energy_.residual_at(result.scale_factors, conditions_);
    residual.scale_to_one();
    bool is_changed = false;
    for(std::uint32_t v = 0; v < active.size(); ++v)
    {
      if(!bounds_.has(v) || (active[v] ? !(residual.entries[v] > most) : !(result.scale_factors[v] < least_factor<NT>(conditions_, v))))
        continue;
      active[v] = !active[v];
      is_changed = true;
    }
    return is_changed;
  }

  static constexpr double close_in_double = 1e-6; // radians: what `double` leaves where there are no such needles

  Refinable_energy<NT>& energy_;
  Laplacian_solver& linear_;
  const Component_scales<NT>& scales_;
  const Conformal_conditions<NT>& conditions_;
  const Lower_bounds& bounds_;
  const double tolerance_;
  Any_visitor visitor_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_REFINEMENT_H
