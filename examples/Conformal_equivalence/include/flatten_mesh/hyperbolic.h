// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_HYPERBOLIC_H
#define FLATTEN_MESH_HYPERBOLIC_H

#include "options.h"
#include "Output_files.h"

#include <ostream>

namespace flattening {

// With --target hyperbolic: reads the surface, finds its hyperbolic metric and group, writes. Throws a `Failure` that says what went wrong.
void run_hyperbolic(const Options& options, Output_files& files, std::ostream& out, std::ostream& err);

} // namespace flattening

#endif // FLATTEN_MESH_HYPERBOLIC_H
