// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// CHOLMOD hands its dense fronts to a BLAS library, and some of its loops to OpenMP. Both start a thread on each core without being asked, for
// fronts of a few rows, too, and let these wait in circles: several times the processor time for the same factor, and where other
// programs run, more time. No thread is to be started that the user has not asked for.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ONE_LINEAR_ALGEBRA_THREAD_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ONE_LINEAR_ALGEBRA_THREAD_H

#if defined(__unix__) || defined(__APPLE__)
#  include <dlfcn.h>
#endif

#include <cstddef>
#include <mutex>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The functions by which a library that happens to be loaded is told how many threads it may use: OpenBLAS, or OpenMP, whose parallel regions
// are run by one thread if no level of them may be active. Null where there is none, or no way to find out.
struct Thread_setting
{
  int (*get)() = nullptr;
  void (*set)(int) = nullptr;
  int single = 1; // the value that means one thread

  bool is_there() const { return get != nullptr && set != nullptr; }
};

template <typename Function>
Function loaded_function(const char* name)
{
#if defined(__unix__) || defined(__APPLE__)
  return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
#else
  static_cast<void>(name);
  return nullptr;
#endif
}

inline Thread_setting find_thread_setting(const char* get, const char* set, int single)
{
  return {loaded_function<int (*)()>(get), loaded_function<void (*)(int)>(set), single};
}

// As long as any object of this class exists, in whichever thread, these libraries use one thread each; the last one restores what was set before.
class One_linear_algebra_thread
{
  static constexpr std::size_t number_ = 2;

  struct Shared
  {
    std::mutex mutex;
    std::size_t users = 0;
    const Thread_setting settings[number_] = {
      find_thread_setting("openblas_get_num_threads", "openblas_set_num_threads", 1),
      find_thread_setting("omp_get_max_active_levels", "omp_set_max_active_levels", 0) };
    int before[number_] = {};
  };

  static Shared& shared()
  {
    static Shared result;
    return result;
  }

public:
  One_linear_algebra_thread()
  {
    Shared& s = shared();
    const std::lock_guard<std::mutex> lock(s.mutex);
    if(s.users++ != 0)
      return;
    for(std::size_t i = 0; i < number_; ++i)
      if(s.settings[i].is_there())
      {
        s.before[i] = s.settings[i].get();
        s.settings[i].set(s.settings[i].single);
      }
  }

  ~One_linear_algebra_thread()
  {
    Shared& s = shared();
    const std::lock_guard<std::mutex> lock(s.mutex);
    if(--s.users != 0)
      return;
    for(std::size_t i = 0; i < number_; ++i)
      if(s.settings[i].is_there())
        s.settings[i].set(s.before[i]);
  }

  One_linear_algebra_thread(const One_linear_algebra_thread&) = delete;
  One_linear_algebra_thread& operator=(const One_linear_algebra_thread&) = delete;
};

// For other solvers, which start no threads.
struct Any_number_of_threads
{};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ONE_LINEAR_ALGEBRA_THREAD_H
