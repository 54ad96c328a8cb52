// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What tests of functions at index level name in nearly every line.

#ifndef CGAL_TEST_CONFORMAL_EQUIVALENCE_INDEX_LEVEL_H
#define CGAL_TEST_CONFORMAL_EQUIVALENCE_INDEX_LEVEL_H

#include "test_meshes.h"
#include "tolerances.h"

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>

namespace testing {

namespace CE = CGAL::Conformal_equivalence;

typedef CE::Intrinsic_triangulation<double>  Triangulation;
typedef CE::Conformal_conditions<double>     Conditions;
typedef CE::Conformal_metric<double>         Metric;
typedef CE::Exact_angle<double>              Angle;

} // namespace testing

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_INDEX_LEVEL_H
