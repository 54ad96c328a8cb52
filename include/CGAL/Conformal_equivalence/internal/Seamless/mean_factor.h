// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// How far maps of triangles are from being conformal: mean and largest quasi-conformal factors.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_MEAN_FACTOR_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_MEAN_FACTOR_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/quasi_conformal_factor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Of one triangle, with its area in the mesh.
struct Face_factor
{
  Scaled_number<double> area;
  double factor;
};

// The sum of the areas as a multiple of 2^(exponent of the largest).
inline Scaled_number<double> total_area(const std::vector<Face_factor>& faces)
{
  Scaled_number<double> total;
  bool is_first = true;
  for(const Face_factor& f : faces)
    if(f.area.mantissa > 0 && (is_first || f.area.exponent > total.exponent))
    {
      total.exponent = f.area.exponent;
      is_first = false;
    }
  for(const Face_factor& f : faces)
    total.mantissa += f.area.scaled_to(total.exponent);
  return total;
}

struct Mean_factor
{
  double mean = 1, largest = 1;
};

// Of the triangle of the mesh.
inline Triangle_frame given_frame(const Intrinsic_triangulation<double>& t, std::uint32_t f)
{
  return frame_from_lengths({{t.halfedge_length(t.halfedge(f, 2)), t.halfedge_length(t.halfedge(f)), t.halfedge_length(t.halfedge(f, 1))}});
}

// Of the triangle of a flat layout, which is given by the corners at halfedges.
inline Triangle_frame plane_frame(const std::vector<std::complex<double> >& corner, std::uint32_t f)
{
  std::array<Space_vector, 3> e;
  for(std::uint32_t k = 0; k < 3; ++k)
  {
    const std::complex<double> d = corner[3 * f + (k + 2) % 3] - corner[3 * f + (k + 1) % 3];
    e[k] = {{d.real(), d.imag(), 0}};
  }
  return frame_from_edge_vectors(e);
}

// The corners of a face, as numbers of the plane that `corner(h)` gives.
template <typename Corner>
UV_corners uv_corners(Corner corner, std::uint32_t f)
{
  const std::complex<double> p = corner(3 * f), q = corner(3 * f + 1), r = corner(3 * f + 2);
  return {{ {{p.real(), p.imag()}}, {{q.real(), q.imag()}}, {{r.real(), r.imag()}} }};
}

// Weighted by the areas in the mesh. Needles whose images have no area in the plane do not count.
inline Mean_factor mean_factor(const std::vector<Face_factor>& faces)
{
  Mean_factor result;
  if(faces.empty())
    return result;
  const Scaled_number<double> total = total_area(faces);
  double excess = 0;
  for(const Face_factor& f : faces)
  {
    const double weight = f.area.scaled_to(total.exponent) / total.mantissa;
    if(!(weight > 0) || std::isnan(f.factor))
      continue;
    excess += weight * (f.factor - 1);
    result.largest = (std::max)(result.largest, f.factor);
  }
  result.mean = 1 + excess;
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_MEAN_FACTOR_H
