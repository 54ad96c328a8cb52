// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_VERSION_H
#define CGAL_CONFORMAL_EQUIVALENCE_VERSION_H

#include <CGAL/license/Surface_mesh_parameterization.h>

/// \file version.h
/// The version of this package, which is independent of the version of \cgal.
/// The build system reads it from here.

/// \ingroup PkgConformalEquivalenceRef
/// the version as text, `"major.minor.patch"`
#define CGAL_CONFORMAL_EQUIVALENCE_VERSION "0.2.0"

/// \ingroup PkgConformalEquivalenceRef
/// the version as a number that can be compared: `10000 * major + 100 * minor + patch`
#define CGAL_CONFORMAL_EQUIVALENCE_VERSION_NR 200

#endif // CGAL_CONFORMAL_EQUIVALENCE_VERSION_H
