// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_WRITE_OUTPUTS_H
#define FLATTEN_MESH_WRITE_OUTPUTS_H

#include "figures.h"
#include "mesh.h"
#include "options.h"
#include "Output_files.h"
#include "results.h"

#include <string>

namespace flattening {

// The files beside an OBJ file.
struct Material_files
{
  std::string material, texture;
  std::string foreign_material; // is in the place of the material, and is kept: it was not written by this program

  // Throws a `Failure` if there is no place for the material.
  explicit Material_files(const std::string& obj);
};

// Those of an output. There is no texture on the sphere and in the hyperbolic plane.
Material_files material_files(const Options& options);

// Whether an output goes to the standard output, which is then for nothing else.
bool is_output_in_stream(const Options& options);

// Announces the files that will be written. Throws a `Usage_error` if one would overwrite the input.
void announce_outputs(const Options& options, const Material_files& beside, Output_files& files);

// For surfaces that have materials of their own.
void withdraw_material(Material_files& beside, Output_files& files);

// `mesh` is what was given; `result` is drawn, of that mesh or of its refinement.
void write_outputs(const Options& options, const Mesh& mesh, Result& result, const Material_files& beside,
                   Figures& figures, Output_files& files);

} // namespace flattening

#endif // FLATTEN_MESH_WRITE_OUTPUTS_H
