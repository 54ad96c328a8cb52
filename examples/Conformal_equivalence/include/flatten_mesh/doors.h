// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The functions of the package that make maps and meshes, as the program calls them. Each has a file of its own in the folder
// flatten_mesh/, because it takes long to compile.

#ifndef FLATTEN_MESH_DOORS_H
#define FLATTEN_MESH_DOORS_H

#include "Components.h"
#include "conditions.h"
#include "options.h"
#include "Progress.h"
#include "results.h"

namespace flattening {

// Each of them leaves what it has found in `results`, and returns a report that says whether it has found it.

// The layout, with the angle sums and scale factors that `conditions` prescribe.
Report flatten_in_the_plane(const Options& options, const Conditions& conditions, Results& results, Progress& progress);

// The same with --precision.
Report flatten_precisely(const Options& options, const Conditions& conditions, Results& results, Progress& progress);

// The same with --local-repair: the mesh of `results.made` is made.
Report flatten_repaired(const Options& options, const Conditions& conditions, Results& results, Progress& progress);

// Looks for the cones, and makes them conditions: angle sums if these were rounded, u = 0 otherwise.
Report place_cones(const Options& options, const Conditions& conditions, Results& results, Progress& progress);

// Whether that was interrupted, after cones had been found.
bool is_best_so_far(const Report& placement);

// A seamless layout, with cones that are given or to be placed.
Report flatten_seamlessly(const Options& options, const Conditions& conditions, Results& results, Progress& progress);

// The same with --refine: where flipped edges cut triangles, the mesh of `results.made` is made of the parts; else it stays empty.
Report flatten_refined_seamlessly(const Options& options, const Conditions& conditions, Results& results, Progress& progress);

// The map to the sphere or to the disk, in double or with --precision.
Report map_to_sphere(const Options& options, Results& results, Progress& progress);
Report map_to_sphere_precisely(const Options& options, Results& results, Progress& progress);
Report map_to_disk(const Options& options, Results& results, Progress& progress);
Report map_to_disk_precisely(const Options& options, Results& results, Progress& progress);

// Throws a `Failure` unless the vertices that steer the map to the sphere or the disk are on one component.
void check_vertices_of_image(const Options& options, const Mesh& mesh, const Components& components);

// Makes the mesh of the refinement, of triangles if it can hold them.
void make_refined_mesh(const Options& options, const Result& given, const Refinement& refinement, Result& refined);

} // namespace flattening

#endif // FLATTEN_MESH_DOORS_H
