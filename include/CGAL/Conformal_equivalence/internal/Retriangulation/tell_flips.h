// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What a result tells of the flips that led to it.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_TELL_FLIPS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_TELL_FLIPS_H

#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Delaunay_flipper.h>
#include <CGAL/Conformal_equivalence/options.h>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Tells a result that flips have led to how many there were, and to what surface it is conformally equivalent.
template <typename Result>
void tell_flips(Retriangulation retriangulation, Result& result)
{
  result.statistics.number_of_flips = result.flips.size();
  result.statistics.conformal_class = retriangulation == Retriangulation::ALWAYS ? Conformal_class::DELAUNAY_TRIANGULATION
                                                                                 : Conformal_class::GIVEN_TRIANGULATION;
}

// The same of a metric; also how its flips were decided, and, if it is a success, whether its triangulation is Delaunay.
template <typename NT, typename Metric>
void tell_flips(Retriangulation retriangulation, Delaunay_flipper<NT>& flipper, Metric& result)
{
  tell_flips(retriangulation, result);
  result.statistics.number_of_filter_failures = flipper.counts().filter_failures;
  result.statistics.number_of_exact_decisions = flipper.counts().exact_decisions;
  if(!is_success(result.status))
    return;
  const Delaunay_verdict verdict = flipper.verdict(result.scale_factors);
  result.statistics.delaunay = verdict.is_exact         ? Delaunay_property::EXACT
                             : verdict.is_within_bounds ? Delaunay_property::WITHIN_ROUNDING
                                                        : Delaunay_property::NO;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_TELL_FLIPS_H
