// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_EXPLAIN_H
#define FLATTEN_MESH_EXPLAIN_H

#include "conditions.h"
#include "Given_surface.h"
#include "mesh.h"
#include "options.h"
#include "results.h"

#include <string>

namespace flattening {

// Why there is no result, where, and what may help: in degrees, as angles are given to the program. If the report is about one component only, `face`
// is one of its faces.
std::string explanation(const Options& options, const Given_surface& given, const Mesh& mesh, const Conditions& conditions, const Report& report,
                        Face face);

} // namespace flattening

#endif // FLATTEN_MESH_EXPLAIN_H
