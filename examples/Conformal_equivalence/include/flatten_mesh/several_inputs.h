// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Several inputs on one command line: each is flattened by itself, with files of its own. In the names of outputs, % stands for the name of the input
// without folder and extension, and %% for %.

#ifndef FLATTEN_MESH_SEVERAL_INPUTS_H
#define FLATTEN_MESH_SEVERAL_INPUTS_H

#include "options.h"
#include "Output_files.h"

#include <cstddef>
#include <functional>
#include <ostream>
#include <string>

namespace flattening {

// Whether the name has a % for that of the input.
bool names_input(const std::string& file);

// The name, so that no % in it is replaced.
std::string literal_name(const std::string& file);

// The options for the i-th input, with the names of its files.
Options options_of_input(const Options& all, std::size_t i);

// Calls `run` for each input. What is wrong with one of them is said on `err` and does not keep others from being flattened. Returns whether
// all were. Throws a `Usage_error`, before anything is computed, if two outputs have the same name or one would overwrite an input.
bool run_each(const Options& all, const std::function<void(const Options&, Output_files&)>& run, std::ostream& out, std::ostream& err);

} // namespace flattening

#endif // FLATTEN_MESH_SEVERAL_INPUTS_H
