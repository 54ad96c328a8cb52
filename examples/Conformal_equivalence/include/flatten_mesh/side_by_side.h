// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Components that were mapped by themselves are put beside one another.

#ifndef FLATTEN_MESH_SIDE_BY_SIDE_H
#define FLATTEN_MESH_SIDE_BY_SIDE_H

#include "Components.h"
#include "options.h"
#include "results.h"

namespace flattening {

// Seamless layouts: each is moved by a point of the lattice, so that its seams stay exact. Where it comes to lie so far out that its coordinates
// have too many digits, places on the seam are rounded again.
void place_tilings_side_by_side(const Components& components, Results& results, Report& report);

// Between the centres of spheres, or disks, of which each is of one component; they have few digits.
const double distance_of_centres = 2.25;

// Spheres and disks: each gets a centre. Images are rounded to what is left of them in what is written, point + centre.
void place_images_side_by_side(Target target, Results& results);

} // namespace flattening

#endif // FLATTEN_MESH_SIDE_BY_SIDE_H
