// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Part of the compiled library: the solver, for `double`.

#include <CGAL/Conformal_equivalence/internal/Retriangulation/Metric_finder.h>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template Conformal_metric<double> Metric_finder<double>::find(const Conformal_conditions<double>&, const Solver_options&);

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL
