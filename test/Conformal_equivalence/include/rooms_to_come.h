// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Functions whose shape is fixed and which the package does not have yet, so that
// the programs of `test_signatures.cpp` compile; each leaves this file for a public
// header when it is written. None is ever called.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_TEST_ROOMS_TO_COME_H
#define CGAL_CONFORMAL_EQUIVALENCE_TEST_ROOMS_TO_COME_H

#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <cstdlib>

namespace CGAL {
namespace Conformal_equivalence {

template <typename TriangleMesh, typename HalfedgeUVMap, typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> compute_seamless_parameterization(const TriangleMesh&, HalfedgeUVMap,
                                                                  const NamedParameters& = parameters::default_values())
{
  std::abort();
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_TEST_ROOMS_TO_COME_H
