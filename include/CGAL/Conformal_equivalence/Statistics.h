// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Statistics.h
/// Figures of a run of the solver: times, numbers of steps, and what is known of the result.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_STATISTICS_H
#define CGAL_CONFORMAL_EQUIVALENCE_STATISTICS_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <cstddef>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceEnums
/// To which metric the one found is conformally equivalent. These are different problems, with slightly different solutions.
enum class Conformal_class
{
  FIXED_TRIANGULATION,   ///< to the one given, on its triangulation: all length cross ratios are kept
  GIVEN_TRIANGULATION,   ///< to the one given, in the sense of discrete uniformization: with Ptolemy flips of its triangulation
  DELAUNAY_TRIANGULATION, ///< the same, with flips of its intrinsic Delaunay triangulation: depends on the surface alone
  REPAIRED               ///< to the one given, on a triangulation with some edges flipped or split where triangles broke: `repair_locally()`
};

/// \ingroup PkgConformalEquivalenceEnums
/// Whether a triangulation that was flipped is Delaunay, but for edges that cannot be flipped: those of the border, and those of a
/// triangle that is glued to itself.
enum class Delaunay_property
{
  NOT_ASKED,       ///< no edge was to be flipped
  EXACT,           ///< yes, by exact predicates on the numbers that are stored
  WITHIN_ROUNDING, ///< yes, for lengths that differ from those stored by no more than rounding can have done
  NO               ///< no: some edges were left
};

/// \ingroup PkgConformalEquivalenceEnums
/// In which numbers the linear systems of the last steps were solved, which reduce the residual of the wide number type.
enum class Refinement_arithmetic
{
  DOUBLE,       ///< in `double`, by the factor that was there
  WIDE_WEIGHTS, ///< in `double`, by the factor of a matrix computed in the wide type
  WIDE          ///< in the wide type
};

/// \ingroup PkgConformalEquivalenceStatus
/// Figures of one run of the solver.
struct Statistics
{
  /// Wall-clock seconds by stage; zero for stages that did not run.
  struct Seconds
  {
    double import = 0;  ///< from the mesh to arrays
    double solve = 0;   ///< conditions, Newton's method, verdict on the metric
    double discarded = 0; ///< part of `solve`: before flips of edges, or the double, were found to be needed
    double flips = 0;   ///< part of `solve`, after that: finding and flipping edges, and evaluating the gradient again after flips
    double cut = 0;     ///< cutting
    double layout = 0;  ///< laying out
    double verify = 0;  ///< orientations of the triangles

    /// adds the times of another run.
    Seconds& operator+=(const Seconds& other)
    {
      import += other.import;
      solve += other.solve;
      discarded += other.discarded;
      flips += other.flips;
      cut += other.cut;
      layout += other.layout;
      verify += other.verify;
      return *this;
    }
  };

  std::size_t number_of_iterations = 0;        ///< Newton steps: linearizations with an accepted step
  std::size_t number_of_linear_iterations = 0; ///< iterations of the preconditioned conjugate gradient method
  std::size_t number_of_factorizations = 0;    ///< numeric factorizations
  std::size_t number_of_evaluations = 0;       ///< evaluations of the gradient
  Conformal_class conformal_class = Conformal_class::FIXED_TRIANGULATION; ///< which problem was solved
  bool is_doubled = false;                     ///< whether the surface was solved as one half of its double
  std::size_t number_of_flips = 0;             ///< edges flipped
  std::size_t number_of_resolving_flips = 0;   ///< of these, the first ones, by which faces of no area were resolved in the metric given
  std::size_t number_of_filter_failures = 0;   ///< of the decisions whether to flip, those for which `double` did not do
  std::size_t number_of_exact_decisions = 0;   ///< of these, those that needed rational numbers
  Delaunay_property delaunay = Delaunay_property::NOT_ASKED; ///< whether the triangulation found is Delaunay
  std::size_t number_of_discarded_iterations = 0; ///< Newton steps on the fixed triangulation, before flips were found to be needed
  double residual = 0;                         ///< largest difference of an angle sum from its target (radians)

  /// below it a residual cannot be told from rounding (radians): in `double`, or, if only this was reached, in the wide number type
  double residual_floor = 0;
  Refinement_arithmetic refinement_arithmetic = Refinement_arithmetic::DOUBLE; ///< in which the last steps were computed
  double angle_defect_spread = 0;              ///< total angle added to inexact targets to meet Gauss-Bonnet (radians)
  std::size_t number_of_regularized_rows = 0;  ///< zero rows of the Hessian that had to be regularized
  double least_u = 0;                          ///< the least u of the metric found, which no layout may be able to hold
  double largest_u = 0;                        ///< the largest one
  std::vector<double> residuals;               ///< the residual before each Newton step, and at the end
  Seconds seconds;                             ///< time by stage

  /// adds the work of another run: its steps, iterations, factorizations, evaluations, decisions and seconds. What is told of the result,
  /// and of the flips that led to it, stays.
  Statistics& operator+=(const Statistics& other)
  {
    number_of_iterations += other.number_of_iterations;
    number_of_linear_iterations += other.number_of_linear_iterations;
    number_of_factorizations += other.number_of_factorizations;
    number_of_evaluations += other.number_of_evaluations;
    number_of_filter_failures += other.number_of_filter_failures;
    number_of_exact_decisions += other.number_of_exact_decisions;
    number_of_discarded_iterations += other.number_of_discarded_iterations;
    seconds += other.seconds;
    return *this;
  }
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_STATISTICS_H
