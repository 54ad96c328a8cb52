// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONCURRENCY_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONCURRENCY_H

#include <algorithm>
#include <cstddef>
#include <vector>

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_TBB
#  include <tbb/global_control.h>
#  include <tbb/parallel_for.h>
#  include <tbb/task_arena.h>
#endif

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// How many threads may be used; one without TBB. What is computed must not depend on it: work is split into tasks none of which writes where another
// one reads or writes, and sums are formed in an order that is always the same.
class Concurrency
{
public:
  explicit Concurrency(unsigned number_of_threads = 1) : number_of_threads_(number_of_threads) {}

  bool is_sequential() const { return number_of_threads_ <= 1; }

  // Calls `task(0)`, ..., `task(n - 1)`, in any order.
  template <typename Task>
  void for_each(int n, const Task& task) const
  {
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_TBB
    if(number_of_threads_ > 1 && n > 1)
    {
      const std::size_t most = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism); // as the processor has, as a rule
      tbb::task_arena arena(int((std::min)(std::size_t(number_of_threads_), most)));
      arena.execute([&] { tbb::parallel_for(0, n, [&](int i) { task(i); }); });
      return;
    }
#endif
    for(int i = 0; i < n; ++i)
      task(i);
  }

  // Calls `task(first, last)` for successive ranges of 0, ..., n - 1.
  template <typename Task>
  void for_each_range(std::size_t n, const Task& task) const
  {
    for_each(number_of_ranges(n), [&](int i) { task(i * length_of_ranges, (std::min)(n, (i + 1) * length_of_ranges)); });
  }

  // The largest of `value(0)`, ..., `value(n - 1)`, or 0.
  template <typename Value>
  double largest(std::size_t n, const Value& value) const
  {
    std::vector<double> result(std::size_t(number_of_ranges(n)) + 1, 0.);
    for_each_range(n, [&](std::size_t first, std::size_t last)
    {
      double largest_here = 0;
      for(std::size_t i = first; i < last; ++i)
        largest_here = (std::max)(largest_here, double(value(i)));
      result[first / length_of_ranges] = largest_here;
    });
    return *std::max_element(result.begin(), result.end());
  }

private:
  static constexpr std::size_t length_of_ranges = 8192; // takes longer than to begin a task
  static int number_of_ranges(std::size_t n) { return int((n + length_of_ranges - 1) / length_of_ranges); }

  unsigned number_of_threads_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONCURRENCY_H
