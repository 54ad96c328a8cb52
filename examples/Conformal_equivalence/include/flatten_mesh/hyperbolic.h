// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_HYPERBOLIC_H
#define FLATTEN_MESH_HYPERBOLIC_H

#include "figures.h"
#include "Given_surface.h"
#include "mesh.h"
#include "options.h"
#include "Output_files.h"
#include "Progress.h"
#include "Stopwatch.h"

namespace flattening {

// With --target hyperbolic: finds the hyperbolic metric of the surface and its group, and writes. Returns names and values for the terminal; the
// seconds among them are those of `watch`. Throws a `Failure` that says what went wrong.
Lines make_hyperbolic_surface(const Options& options, const Given_surface& given, Mesh& mesh, const Stopwatch& watch, Progress& progress,
                              Output_files& files);

} // namespace flattening

#endif // FLATTEN_MESH_HYPERBOLIC_H
