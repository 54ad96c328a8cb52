// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_MOEBIUS_WEIGHTS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_MOEBIUS_WEIGHTS_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// By vertex, 0 for isolated ones.
template <typename NT>
std::vector<double> moebius_weights(const Intrinsic_triangulation<NT>& t, Moebius_weights kind)
{
  std::vector<double> result(t.number_of_vertices(), 0.);
  double unit = 0;
  for(const NT& l : t.lengths())
    unit = (std::max)(unit, static_cast<double>(l));
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); ++h)
  {
    double& weight = result[t.origin(h)];
    if(kind == Moebius_weights::VERTICES)
      weight = 1;
    else
    {
      const Incircle_form<double> triangle(static_cast<double>(t.halfedge_length(t.next(h))) / unit,
        static_cast<double>(t.halfedge_length(t.previous(h))) / unit, static_cast<double>(t.halfedge_length(h)) / unit);
      weight += triangle.r * triangle.s;
    }
  }
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_MOEBIUS_WEIGHTS_H
