// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Points of the sphere, by vertex, and triangles of great arcs between them.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_SPHERE_POINTS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_SPHERE_POINTS_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/sphere_predicates.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The origin for isolated vertices.
template <typename Wide>
std::vector<std::array<Wide, 3> > sphere_points(const std::vector<Light_vector<Wide> >& vectors)
{
  std::vector<std::array<Wide, 3> > result;
  result.reserve(vectors.size());
  for(const Light_vector<Wide>& v : vectors)
    result.push_back(v[3] > 0 ? sphere_point(v) : std::array<Wide, 3>{{Wide(0), Wide(0), Wide(0)}});
  return result;
}

// The triangles that are not positive.
template <typename NT, typename Number>
std::vector<std::uint32_t> flipped_faces(const Intrinsic_triangulation<NT>& t, const std::vector<std::array<Number, 3> >& p)
{
  std::vector<std::uint32_t> result;
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
    if(!is_counterclockwise(p[t.origin(t.halfedge(f))], p[t.origin(t.halfedge(f, 1))], p[t.origin(t.halfedge(f, 2))]))
      result.push_back(f);
  return result;
}

template <typename NT, typename Number>
double sum_of_solid_angles(const Intrinsic_triangulation<NT>& t, const std::vector<std::array<Number, 3> >& p)
{
  double result = 0;
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
    result += solid_angle(p[t.origin(t.halfedge(f))], p[t.origin(t.halfedge(f, 1))], p[t.origin(t.halfedge(f, 2))]);
  return result;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template std::vector<std::uint32_t> flipped_faces(const Intrinsic_triangulation<double>&, const std::vector<std::array<Double_double, 3> >&);
extern template std::vector<std::uint32_t> flipped_faces(const Intrinsic_triangulation<double>&, const std::vector<std::array<double, 3> >&);
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_SPHERE_POINTS_H
