// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Points of the disk, by stereographic projection of the half of the sphere with y > 0 from (0, -1, 0), and triangles between them.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_DISK_POINTS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_DISK_POINTS_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename Wide>
Wide weight_in_disk(const Light_vector<Wide>& v)
{
  return v[3] + v[1];
}

template <typename Wide>
std::array<Wide, 2> disk_point(const Light_vector<Wide>& v)
{
  using std::sqrt;
  if(v[1] == Wide(0))
  {
    const double rounding = 1e-20; // of t, in pairs of `double`
    const Wide size = Wide(sqrt(Wide(v[2] * v[2] + v[0] * v[0])));
    if(v[3] - size < rounding * v[3]) // on the circle, and no crossing on the axis: what rounding has done to t does not count
      return {{ v[2] / size, v[0] / size }};
  }
  return {{ v[2] / weight_in_disk(v), v[0] / weight_in_disk(v) }};
}

// By vertex; the origin for isolated ones.
template <typename Wide>
std::vector<std::array<Wide, 2> > disk_points(const std::vector<Light_vector<Wide> >& vectors)
{
  std::vector<std::array<Wide, 2> > result;
  result.reserve(vectors.size());
  for(const Light_vector<Wide>& v : vectors)
    result.push_back(v[3] > 0 ? disk_point(v) : std::array<Wide, 2>{{Wide(0), Wide(0)}});
  return result;
}

// A triangle of the disk.
template <typename Number>
bool is_positive_in_disk(const std::array<Number, 2>& p, const std::array<Number, 2>& q, const std::array<Number, 2>& r)
{
  return is_left_turn(p, q, r);
}

// Exact numbers only where they are needed: coordinates are at most 1, and the error of the determinant below 2^-100.
inline bool is_positive_in_disk(const std::array<Double_double, 2>& p, const std::array<Double_double, 2>& q, const std::array<Double_double, 2>& r)
{
  const double bound = 1e-29;
  const double determinant = static_cast<double>((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
  return std::abs(determinant) > bound ? determinant > 0 : is_left_turn(p, q, r);
}

// The triangles that are not positive.
template <typename NT, typename Number>
std::vector<std::uint32_t> flipped_faces(const Intrinsic_triangulation<NT>& t, const std::vector<std::array<Number, 2> >& p)
{
  std::vector<std::uint32_t> result;
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
    if(!is_positive_in_disk(p[t.origin(t.halfedge(f))], p[t.origin(t.halfedge(f, 1))], p[t.origin(t.halfedge(f, 2))]))
      result.push_back(f);
  return result;
}

// Does the border go once around, always counterclockwise? Then, with positive triangles, the map is one-to-one.
template <typename NT, typename Wide>
bool turns_once(const Intrinsic_triangulation<NT>& t, const std::vector<std::array<Wide, 2> >& p)
{
  const double turn = 2 * Number_constants<double>::pi(), rounding = 1e-6; // of the sum, which is a multiple of a turn
  std::uint32_t first = 0;
  while(!t.is_border(first))
    ++first;
  double sum = 0;
  std::uint32_t h = first;
  do
  {
    const std::array<Wide, 2> &a = p[t.origin(h)], &b = p[t.target(h)];
    const double angle = std::atan2(static_cast<double>(Wide(a[0] * b[1] - a[1] * b[0])), static_cast<double>(Wide(a[0] * b[0] + a[1] * b[1])));
    sum += angle < 0 ? angle + turn : angle;
    h = t.next_on_border(h);
  }
  while(h != first);
  return std::abs(sum - turn) < rounding;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template std::vector<std::uint32_t> flipped_faces(const Intrinsic_triangulation<double>&, const std::vector<std::array<Double_double, 2> >&);
extern template std::vector<std::uint32_t> flipped_faces(const Intrinsic_triangulation<double>&, const std::vector<std::array<double, 2> >&);
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_DISK_POINTS_H
