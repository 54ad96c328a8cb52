// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Solver_options.h
/// How the solver is to go about it: what the named parameters of `Conformal_metric_solver::solve()` say, as a value. It is read once, where a
/// chain of named parameters comes in; what is below takes the value, and is compiled once for all chains
/// (section 3.1 of Springborn, Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_SOLVER_OPTIONS_H
#define CGAL_CONFORMAL_EQUIVALENCE_SOLVER_OPTIONS_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceSolver
/// The options of `Conformal_metric_solver::solve()`, each as the named parameter of that name.
struct Solver_options
{
  double gradient_tolerance = 1e-12;      ///< the largest difference of an angle sum from its target, in radians
  std::size_t number_of_iterations = 100; ///< the maximum number of Newton steps
  Newton_strategy newton_strategy = Newton_strategy::LINE_SEARCH;   ///< how steps are kept from going too far
  Retriangulation retriangulation = Retriangulation::WHEN_NEEDED;   ///< whether edges may be flipped
  Border_edges border_edges = Border_edges::FLIPPABLE;              ///< whether border edges may be flipped, too
  unsigned int number_of_threads = 1;     ///< how many threads may be used; one without TBB. Results do not depend on it

  /// Whether the triangulation is one that Ptolemy flips have led to: flips then go on from the beginning, and it is not tried as it is.
  /// (No named parameter says so.)
  bool has_come_from_flips = false;
  /// Whether what Newton's method finds in `double` is enough: angle sums are within the tolerance as it measures them, and no last steps
  /// are made with wider numbers. For problems that only prepare another one. (No named parameter says so.)
  bool is_estimate = false;
  std::vector<double> initial_log_scale_factors; ///< where to begin, by vertex; empty: at the last solution
  internal::Any_visitor visitor;                 ///< is told the progress and may stop it
};

/// \ingroup PkgConformalEquivalenceSolver
///
/// reads the options among the named parameters of `Conformal_metric_solver::solve()`; others are not looked at.
///
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters"
/// \param number_of_vertices of the triangulation, over whose vertices an `initial_log_scale_factor_map` is read. Linear time if there is one.
template <typename NamedParameters>
Solver_options read_solver_options(const NamedParameters& np, std::size_t number_of_vertices)
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  Solver_options result;
  result.gradient_tolerance = choose_parameter(get_parameter(np, internal_np::conformal_gradient_tolerance), result.gradient_tolerance);
  result.number_of_iterations = choose_parameter(get_parameter(np, internal_np::number_of_iterations), result.number_of_iterations);
  result.newton_strategy = choose_parameter(get_parameter(np, internal_np::conformal_newton_strategy), result.newton_strategy);
  result.retriangulation = choose_parameter(get_parameter(np, internal_np::conformal_retriangulation), result.retriangulation);
  result.border_edges = choose_parameter(get_parameter(np, internal_np::conformal_border_edges), result.border_edges);
  result.number_of_threads = choose_parameter(get_parameter(np, internal_np::conformal_number_of_threads), result.number_of_threads);
  if constexpr(internal::is_given<internal_np::conformal_initial_u_t, NamedParameters>)
  {
    const auto map = get_parameter(np, internal_np::conformal_initial_u);
    result.initial_log_scale_factors.resize(number_of_vertices);
    for(std::uint32_t v = 0; v < number_of_vertices; ++v)
      result.initial_log_scale_factors[v] = static_cast<double>(get(map, v));
  }
  else
    CGAL_USE(number_of_vertices);
  result.visitor = internal::visitor_of(np);
  return result;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_SOLVER_OPTIONS_H
