// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// With --target sphere or disk: what the points that are written are worth.

#ifndef FLATTEN_MESH_IMAGE_FIGURES_H
#define FLATTEN_MESH_IMAGE_FIGURES_H

#include "mesh.h"
#include "options.h"
#include "precision.h"
#include "results.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace flattening {

const double not_a_number = std::numeric_limits<double>::quiet_NaN();

// Figures of a map to the sphere or the disk; NaN: has no meaning.
struct Image_figures
{
  std::vector<Face> lost_faces;                          // not exactly positive at the points written; before they were rounded all were
  std::size_t number_of_flat_faces = 0;                  // of these; counted for points in double
  double solid_angle = not_a_number;                     // of all triangles, for the sphere
  double barycentre = not_a_number;                      // for the sphere: largest coordinate
  double distance_from_sphere = 0;                       // of points of the sphere, or of the border from the circle
  double cross_ratio_error = not_a_number, length_error = not_a_number; // if no edge was flipped
};

// The triangles that are not positive: on the sphere seen from outside, on the disk from above. Exactly for `double`.
std::vector<Face> lost_faces(const Mesh& mesh, const std::vector<Space_point>& p, bool is_sphere);

// `drawn` is what is written: of the mesh given, or of its refinement, the vertices of which begin with those of the mesh. `components`: those that
// were mapped by themselves. Figures are the largest of all of these, the solid angle is the sum.
Image_figures judge_image(const Options& options, const Report& report, const std::vector<Mapped_component>& components, const Result& given,
                          const Result& drawn);

} // namespace flattening

#endif // FLATTEN_MESH_IMAGE_FIGURES_H
