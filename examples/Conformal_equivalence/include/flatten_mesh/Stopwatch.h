// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_STOPWATCH_H
#define FLATTEN_MESH_STOPWATCH_H

#include <chrono>

namespace flattening {

class Stopwatch
{
public:
  double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

} // namespace flattening

#endif // FLATTEN_MESH_STOPWATCH_H
