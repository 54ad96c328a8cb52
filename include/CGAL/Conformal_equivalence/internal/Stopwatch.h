// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_STOPWATCH_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_STOPWATCH_H

#include <chrono>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Wall-clock seconds since its construction.
class Stopwatch
{
  typedef std::chrono::steady_clock Clock;

public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

private:
  Clock::time_point start_ = Clock::now();
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_STOPWATCH_H
