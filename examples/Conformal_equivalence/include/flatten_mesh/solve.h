// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_SOLVE_H
#define FLATTEN_MESH_SOLVE_H

#include "conditions.h"
#include "options.h"
#include "Progress.h"
#include "results.h"

namespace flattening {

// Makes the layout, or the image on the sphere or the disk, that the options ask for.
Report flatten(const Options& options, const Conditions& conditions, Results& results, Progress& progress);

// Is the common refinement to be written, instead of the mesh? It has to be where edges were flipped and straight triangles will not do, or
// where the map in them is wanted, which is projective only on the parts; for the disk, also where the border is no polygon of border edges.
// Seamless layouts of refinements, which are other ones, are made as such.
bool is_refinement_needed(const Options& options, const Report& report, const Refinement& refinement);

} // namespace flattening

#endif // FLATTEN_MESH_SOLVE_H
