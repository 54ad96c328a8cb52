// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The package is header-only. What works on arrays, though, is the same in every program that computes in `double`, and can be compiled once: by
// the CMake target Conformal_equivalence::compiled, a static library (src/Conformal_equivalence). That target defines
// CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED for those that link it. The doors of the engines, which are function templates on the number
// type, are then declared as `extern template` for `double`, at the end of the headers that define them, and instantiated by the library.
//
// Such a door must be no inline function, and be defined outside of its class: compilers may look into inline ones even if they are
// declared so. What it calls needs nothing: nobody else instantiates it.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_COMPILED_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_COMPILED_H

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_COMPILED_H
