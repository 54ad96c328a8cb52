// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The angle sums of a metric with 50 digits, by nothing of the package's own formulas.

#ifndef CGAL_TEST_CONFORMAL_EQUIVALENCE_WIDE_ANGLE_SUMS_H
#define CGAL_TEST_CONFORMAL_EQUIVALENCE_WIDE_ANGLE_SUMS_H

#include "test_meshes.h"

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <array>
#include <vector>

namespace testing {

typedef boost::multiprecision::number<boost::multiprecision::cpp_bin_float_50::backend_type, boost::multiprecision::et_off> Wide_real;

inline Wide_real wide(const CGAL::Conformal_equivalence::internal::Double_double& x) { return Wide_real(x.hi) + x.lo; }
inline Wide_real wide(const Wide_real& x) { return x; }

// At the vertices of the metric's own triangulation, by the cosine theorem.
template <typename NT>
std::vector<Wide_real> wide_angle_sums(const CGAL::Conformal_equivalence::Conformal_metric<NT>& metric)
{
  const CGAL::Conformal_equivalence::Intrinsic_triangulation<NT>& t = metric.triangulation;
  std::vector<Wide_real> sum(t.number_of_vertices(), Wide_real(0));
  for(Index f = 0; f < t.number_of_faces(); ++f)
  {
    std::array<Wide_real, 3> l;
    for(Index k = 0; k < 3; ++k)
    {
      const Index h = 3 * f + k;
      l[k] = wide(metric.scale_factors[t.origin(h)]) * Wide_real(t.halfedge_length(h)) * wide(metric.scale_factors[t.target(h)]);
    }
    for(Index k = 0; k < 3; ++k)
    {
      const Wide_real &a = l[k], &b = l[(k + 1) % 3], &c = l[(k + 2) % 3];
      sum[t.apex(3 * f + k)] += acos(Wide_real((b * b + c * c - a * a) / (2 * b * c)));
    }
  }
  return sum;
}

} // namespace testing

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_WIDE_ANGLE_SUMS_H
