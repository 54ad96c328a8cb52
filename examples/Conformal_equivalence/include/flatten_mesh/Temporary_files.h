// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_TEMPORARY_FILES_H
#define FLATTEN_MESH_TEMPORARY_FILES_H

#include <string>

namespace flattening {

// Files that do not outlive the program: from when it is told of one until it is told to forget it, the file is removed if the program ends by one of
// the signals INT, TERM and HUP, unless these are ignored. (On other systems than POSIX nothing is done.)
void remove_if_interrupted(const std::string& file);
void forget_temporary_file(const std::string& file);

} // namespace flattening

#endif // FLATTEN_MESH_TEMPORARY_FILES_H
