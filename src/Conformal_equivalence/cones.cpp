// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Part of the compiled library: the placement of cones, for `double`.

#include <CGAL/Conformal_equivalence/internal/Cones/Cone_placer.h>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template Cone_placement<double> Cone_placer<double>::run();

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL
