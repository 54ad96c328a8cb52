// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Part of the compiled library: the rectification of seamless layouts, for `double`.

#include <CGAL/Conformal_equivalence/internal/Seamless/Rectification.h>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template Rectified_layout& Rectification<double>::run();

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL
