// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The formats of files, beside OBJ, that other programs read. Each function returns `true` iff the stream is good after writing, and takes linear
// time.

#ifndef FLATTEN_MESH_LAYOUT_FILES_H
#define FLATTEN_MESH_LAYOUT_FILES_H

#include "Given_surface.h"
#include "options.h"
#include "Output_files.h"
#include "results.h"
#include "Split_surface.h"
#include "texture.h"

#include <cstddef>
#include <ostream>
#include <string>

namespace flattening {

// How the texture of a GLB file lies on the layout.
struct Texture_of_layout
{
  Pattern pattern = Pattern::CHECKERBOARD;
  double repetitions = 1; // of the checkerboard, in a unit of the layout
};

// glTF 2.0 (Khronos 2021) in one binary file: the triangles in single precision, with the layout as texture coordinates that fit the texture, which
// is in the file. TEXCOORD_0 is `repetitions` times (u, v), or the coordinates (a, b) of the hexagonal lattice, with 1 less the second one, as glTF
// counts from the top. If `has_weights`, the weight of each vertex is the attribute _WEIGHT. Colours of the vertices of the file, if there are any,
// are COLOR_0, in linear light. Throws a `Failure` that names `name` if a number is not finite in single precision, or the file is too large.
bool write_GLB(std::ostream& out, const Given_surface& given, const Split_surface& surface, const Texture_of_layout& texture, bool has_weights,
               const std::string& name);

// PLY, binary and in double precision: the faces that the OBJ file has, with a property `chart`, and the vertices with the properties x, y, z; s and
// t, the layout; log_scale_factor, which is u (programs take a property of that name for a texture coordinate); weight, e^-u, the largest 1; and
// vertex, the number that the vertex has in the OBJ file, from 0. A chart is a piece of the layout that is connected by edges. There is no layout on
// the sphere.
bool write_PLY(std::ostream& out, const Given_surface& given, const Split_surface& surface);

// The layout as a surface in the plane z = 0, as OBJ: the faces that the OBJ file has, in their order.
bool write_flat_OBJ(std::ostream& out, const Given_surface& given, const Result& result);

// The outline of the layout as DXF of AutoCAD's release 12, as polylines, `scale` times as large: borders of the surface in the layer OUTLINE, both
// sides of each seam in the layer CUTS. What is a closed curve is a closed polyline if it is in one layer. Throws a `Failure` that names `name`
// if a number is not finite then.
bool write_DXF(std::ostream& out, const Result& result, double scale, const std::string& name);

// The texture that fits across the seams of the layout, or a checkerboard.
Pattern texture_pattern(const Options& options);

// The checkerboard in a unit of the layout: about 20 squares along the layout.
double texture_repetitions(const Result& result);

// Writes those of these files that are wanted.
void write_layout_files(const Options& options, const Given_surface& given, const Result& result, Output_files& files);

} // namespace flattening

#endif // FLATTEN_MESH_LAYOUT_FILES_H
