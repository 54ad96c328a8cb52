// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What conditions must satisfy for a solution to exist (section 2.1 of Springborn,
// Schroeder and Pinkall, 2008), decided before anything is computed and without
// rounding where the angles are rational multiples of pi.
//
// On each component, with F the vertices of fixed u and B those of bounded u:
//   F and B empty:   sum (2 pi - Theta^) + sum over border (pi - Theta^) = 2 pi chi (Gauss-Bonnet);
//   F or B nonempty: the angles prescribed outside of F and B leave these a total angle, which must be positive: else E
//                    decreases forever if u does outside of F and B;
//   F empty, B not:  also, the left side of the formula is at most the right one: else E decreases forever if u grows. If
//                    the sides are equal, E does not change then: the bounds only settle the scale.
// A closed surface without cones other than a torus is told apart from a mere violation.
// And 0 < Theta^ at every vertex; on a fixed triangulation also Theta^ < pi * (number of triangles), unless u is bounded.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_FEASIBILITY_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_FEASIBILITY_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Whether there can be a metric; if closed surfaces lack cones, `faces` has one face of each.
struct Feasibility : public Outcome
{
  double angle_defect_spread = 0;
  std::vector<char> rests_on_bounds; // by component: nothing is fixed, and some bounds are active with an angle sum below their target
};

// Defects below this come from angles that were written with few digits.
inline double negligible_angle_defect() { return 1e-9; }

// A sum of many angles.
template <typename NT>
struct Total_angle
{
  typedef typename Wider_number<NT>::type Wide;
  std::int64_t units = 0;      // of pi / 2520
  Wide rest = Wide(0);         // radians

  void add(const Exact_angle<NT>& angle)
  {
    units += angle.units;
    rest += Wide(angle.rest);
  }
  void subtract(const Exact_angle<NT>& angle)
  {
    units -= angle.units;
    rest -= Wide(angle.rest);
  }
  Wide wide_radians() const
  {
    const Wide unit = Number_constants<Wide>::pi() / int(Exact_angle<NT>::units_of_pi);
    return unit * Wide(units) + rest;
  }
  double radians() const { return static_cast<double>(wide_radians()); }
  bool is_zero() const { return units == 0 && rest == Wide(0); }
};

// The total angle of one component that the prescribed angles do not use up.
template <typename NT>
struct Angle_balance
{
  Total_angle<NT> left;               // by all that are prescribed
  Total_angle<NT> left_for_bounds;    // by those where u is not bounded
  std::vector<std::uint32_t> fixed;   // vertices of fixed u
  std::vector<std::uint32_t> bounded; // vertices of bounded u
  std::vector<std::uint32_t> curved;  // vertices whose target is neither 2 pi, inside, nor pi, on the border
  std::vector<std::uint32_t> inexact; // vertices whose target is no exact multiple

  double radians() const { return left.radians(); }
};

// Gauss-Bonnet says: the sum of all angle sums is 2 pi |V| - pi |V of the border| - 2 pi chi.
template <typename NT>
std::vector<Angle_balance<NT> > angle_balances(const Intrinsic_triangulation<NT>& t,
                                               const Surface_components& pieces,
                                               const Conformal_conditions<NT>& conditions)
{
  const std::int64_t pi = Exact_angle<NT>::units_of_pi;
  std::vector<Angle_balance<NT> > balance(pieces.components.size());
  for(std::size_t c = 0; c < balance.size(); ++c)
    balance[c].left.units = balance[c].left_for_bounds.units = -2 * pi * pieces.components[c].euler_characteristic();
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
  {
    if(t.is_isolated_vertex(v))
      continue;
    Angle_balance<NT>& b = balance[pieces.component_of_vertex[v]];
    const std::int64_t flat = t.is_border_vertex(v) ? pi : 2 * pi;
    b.left.units += flat;
    b.left_for_bounds.units += flat;
    if(conditions.is_fixed(v))
    {
      b.fixed.push_back(v);
      continue;
    }
    const Exact_angle<NT>& angle = conditions.angle_sum(v);
    b.left.subtract(angle);
    if(conditions.is_bounded(v))
      b.bounded.push_back(v);
    else
      b.left_for_bounds.subtract(angle);
    if(angle.units != flat || !angle.is_exact())
      b.curved.push_back(v);
    if(!angle.is_exact())
      b.inexact.push_back(v);
  }
  return balance;
}

template <typename NT>
Feasibility check_numbers(const Intrinsic_triangulation<NT>& t, const Conformal_conditions<NT>& conditions)
{
  Feasibility result;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
  {
    if(t.is_isolated_vertex(v))
      continue;
    const double x = conditions.is_fixed(v) ? static_cast<double>(conditions.log_scale_factor(v))
                                            : conditions.angle_sum(v).template radians<double>();
    const double bound = conditions.is_bounded(v) ? static_cast<double>(conditions.lower_bound(v)) : 0;
    if(!std::isfinite(x) || !std::isfinite(bound))
      result.vertices.push_back(v);
  }
  if(!result.vertices.empty())
    result.status = Status::INVALID_NUMBER;
  return result;
}

template <typename NT>
Feasibility check_angle_ranges(const Intrinsic_triangulation<NT>& t, const Conformal_conditions<NT>& conditions,
                               bool triangulation_is_fixed)
{
  Feasibility result;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
  {
    if(t.is_isolated_vertex(v) || conditions.is_fixed(v))
      continue;
    const Exact_angle<NT>& angle = conditions.angle_sum(v);
    const std::int64_t most = std::int64_t(Exact_angle<NT>::units_of_pi) * t.degree(v);
    const double radians = angle.template radians<double>();
    const bool is_below = angle.is_exact() ? angle.units < most
                                           : radians < Number_constants<double>::pi() * t.degree(v);
    if(radians > 0 && (is_below || !triangulation_is_fixed || conditions.is_bounded(v)))
      continue;
    if(result.vertices.empty())
      result.amount = radians;
    result.vertices.push_back(v);
    result.status = Status::ANGLE_OUT_OF_RANGE;
  }
  return result;
}

// A closed surface without any cone, which is flat only if it is a torus.
template <typename NT>
bool lacks_cones(const Surface_components::Component& component, const Angle_balance<NT>& balance)
{
  return component.number_of_borders == 0 && balance.fixed.empty() && balance.bounded.empty() && balance.curved.empty()
      && component.euler_characteristic() != 0;
}

template <typename NT>
Feasibility check_for_cones(const Surface_components& pieces, const std::vector<Angle_balance<NT> >& balances)
{
  Feasibility result;
  for(std::size_t c = 0; c < balances.size(); ++c)
  {
    const Surface_components::Component& component = pieces.components[c];
    if(!lacks_cones(component, balances[c]))
      continue;
    if(result.faces.empty())
      result.amount = 2 * Number_constants<double>::pi() * double(component.euler_characteristic());
    result.status = Status::MISSING_CONDITION;
    result.faces.push_back(component.first_face);
  }
  return result;
}

// The error of a component whose angles do not fit: the vertices that could be given others.
template <typename NT>
CGAL_CONFORMAL_EQUIVALENCE_COLD
Feasibility unbalanced(const Intrinsic_triangulation<NT>& t, const Surface_components& pieces,
                       std::size_t c, const Angle_balance<NT>& balance)
{
  Feasibility result;
  result.status = Status::GAUSS_BONNET_VIOLATED;
  result.amount = balance.radians();
  result.vertices = balance.curved.empty() ? balance.bounded : balance.curved;
  if(result.vertices.empty())
    for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
      if(t.is_border_vertex(v) && pieces.component_of_vertex[v] == c)
        result.vertices.push_back(v);
  return result;
}

// The error of a component whose angles leave nothing for the vertices where u is fixed or bounded.
template <typename NT>
CGAL_CONFORMAL_EQUIVALENCE_COLD
Feasibility exhausted(const Angle_balance<NT>& balance)
{
  Feasibility result;
  result.status = Status::NO_ANGLE_LEFT;
  result.amount = balance.left_for_bounds.radians();
  result.vertices = balance.fixed;
  result.vertices.insert(result.vertices.end(), balance.bounded.begin(), balance.bounded.end());
  std::sort(result.vertices.begin(), result.vertices.end());
  return result;
}

// Adds `left` to the targets of `vertices`, evenly; what rounding takes from one is added to the next ones.
template <typename NT>
CGAL_CONFORMAL_EQUIVALENCE_COLD
void spread(const NT& left, const std::vector<std::uint32_t>& vertices, Conformal_conditions<NT>& conditions)
{
  NT rest_left = left;
  for(std::size_t i = 0; i < vertices.size(); ++i)
  {
    Exact_angle<NT> angle = conditions.angle_sum(vertices[i]);
    const NT before = angle.rest;
    angle.rest += rest_left / NT(double(vertices.size() - i));
    rest_left -= angle.rest - before;
    if(conditions.is_bounded(vertices[i]))
      conditions.prescribe_angle_sum_above(vertices[i], angle, NT(conditions.lower_bound(vertices[i])));
    else
      conditions.prescribe_angle_sum(vertices[i], angle);
  }
}

// Checks all of the above; adds negligible defects to the targets that are not
// exact multiples of pi / 2520.
template <typename NT>
Feasibility make_feasible(const Intrinsic_triangulation<NT>& t, const Surface_components& pieces,
                          Conformal_conditions<NT>& conditions, bool triangulation_is_fixed = true)
{
  Feasibility result = check_numbers(t, conditions);
  if(result.status == Status::OK)
    result = check_angle_ranges(t, conditions, triangulation_is_fixed);
  if(result.status != Status::OK)
    return result;
  const std::vector<Angle_balance<NT> > balances = angle_balances(t, pieces, conditions);
  result = check_for_cones(pieces, balances);
  if(result.status != Status::OK)
    return result;

  result.rests_on_bounds.assign(balances.size(), 0);
  for(std::size_t c = 0; c < balances.size(); ++c)
  {
    const Angle_balance<NT>& balance = balances[c];
    const bool is_free = balance.fixed.empty() && balance.bounded.empty();
    if(!is_free && !(balance.left_for_bounds.radians() > 0))
      return exhausted(balance);
    if(!balance.fixed.empty() || balance.left.is_zero())
      continue;
    const double left = balance.radians();
    const bool is_negligible = std::abs(left) <= negligible_angle_defect() && !balance.inexact.empty();
    if(is_negligible)
    {
      spread(static_cast<NT>(balance.left.wide_radians()), balance.inexact, conditions);
      result.angle_defect_spread += std::abs(left);
    }
    else if(!balance.bounded.empty() && left < 0)
      result.rests_on_bounds[c] = 1;
    else
      return unbalanced(t, pieces, c, balance);
  }
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_FEASIBILITY_H
