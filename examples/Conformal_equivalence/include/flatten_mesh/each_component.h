// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Maps that there are for one component only: each component of the mesh is mapped by itself, and what is found is put together.

#ifndef FLATTEN_MESH_EACH_COMPONENT_H
#define FLATTEN_MESH_EACH_COMPONENT_H

#include "Components.h"
#include "conditions.h"
#include "mesh.h"
#include "options.h"
#include "Progress.h"
#include "results.h"

#include <functional>

namespace flattening {

// One of the functions of doors.h.
typedef std::function<Report(const Options&, const Conditions&, Results&, Progress&)> Door;

// Calls `door` for one component after another, as if it were alone, until one fails: then the report is about that one, the last of
// `results.components`. Vertices that options name are those of their component, the others have none; components with fewer inner vertices than
// there are cones to be placed get as many as they have, unless none has enough. Conditions and results are those of the whole afterwards; images
// and layouts lie over one another.
Report map_each_component(const Components& components, const Options& options, const Conditions& conditions, Results& results,
                          Progress& progress, const Door& door);

// The report about a component that has failed, with the elements of the whole.
Report failure_in_whole(const Component_mesh& part, const Report& found);

} // namespace flattening

#endif // FLATTEN_MESH_EACH_COMPONENT_H
