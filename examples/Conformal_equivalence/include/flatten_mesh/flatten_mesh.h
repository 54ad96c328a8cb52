// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The program flatten_mesh as a function, to be run also within another program.

#ifndef FLATTEN_MESH_FLATTEN_MESH_H
#define FLATTEN_MESH_FLATTEN_MESH_H

#include <iosfwd>

// The whole program: returns its exit status, 0 (done), 1 (an input failed, and nothing is written of it) 2 (wrong usage), or 3 (interrupted: what is
// written is the best that a search had found by then).
int flatten_mesh(int argc, const char* const argv[], std::ostream& out, std::ostream& err);

#endif // FLATTEN_MESH_FLATTEN_MESH_H
