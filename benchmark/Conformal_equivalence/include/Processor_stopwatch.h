// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_PROCESSOR_STOPWATCH_H
#define CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_PROCESSOR_STOPWATCH_H

#include <ctime>

namespace benchmarks {

// Processor seconds of all threads: what a busy machine does not change. With one
// thread, on an idle machine, they are the seconds that pass.
class Processor_stopwatch
{
public:
  double seconds() const { return double(std::clock() - start_) / CLOCKS_PER_SEC; }

private:
  std::clock_t start_ = std::clock();
};

} // namespace benchmarks

#endif // CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_PROCESSOR_STOPWATCH_H
