// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What all reports begin with, whatever they are about.

#ifndef FLATTEN_MESH_REPORT_ENTRIES_H
#define FLATTEN_MESH_REPORT_ENTRIES_H

#include "options.h"

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
#  include <nlohmann/json_fwd.hpp>
#endif

#include <string>
#include <vector>

namespace flattening {

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
// The program, its version, the input, and the options as they were given, by their long names: `true` for a switch, and an array for what was
// given several times.
void begin_report(const Options& options, nlohmann::ordered_json& report);
#endif

// Of an input that could not be flattened. (Reports are empty if the program was built without nlohmann-json.)
std::string report_of_failure(const Options& options, const std::string& message);

// Those of all inputs as one array.
std::string joint_report(const std::vector<std::string>& reports);

} // namespace flattening

#endif // FLATTEN_MESH_REPORT_ENTRIES_H
