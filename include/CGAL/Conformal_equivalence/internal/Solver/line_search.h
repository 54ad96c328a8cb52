// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_LINE_SEARCH_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_LINE_SEARCH_H

#include <algorithm>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Where a step of length t goes too far, how far to go instead: to the zero of the secant through both slopes, the descent at its start and
// at its end, safeguarded: to between 0.1 and 0.7 of it. What is no number, or more descent than at the start, is too far, too.
inline double shorter_step(double t, double slope, double slope_there)
{
  const double secant = slope_there < slope ? slope / (slope - slope_there) : 0.1;
  return t * (std::min)(0.7, (std::max)(0.1, secant));
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_LINE_SEARCH_H
