// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_DISK_NORMALIZATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_DISK_NORMALIZATION_H

#include <CGAL/Conformal_equivalence/internal/Sphere/Moebius_centering.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/sphere_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Which of the maps to the disk, by indices of vertices.
struct Indexed_disk_frame
{
  enum Kind { BARYCENTRE, CENTRE, THREE_POINTS };

  Kind kind = BARYCENTRE;
  std::array<std::uint32_t, 3> vertices = {{0, 0, 0}}; // the first one for CENTRE, all for THREE_POINTS
};

// The Moebius transformation of the disk of which the points are given by vectors with y = 0 on the circle and y > 0 inside.
template <typename Wide>
class Disk_normalization
{
  typedef std::uint32_t Index;
  typedef std::vector<Light_vector<Wide> > Vectors;

public:
  // `weights`: by vertex, those of the border half as large as they count on the double
  Disk_normalization(std::vector<double> weights, Index first_border_vertex) : weights_(std::move(weights)), first_(first_border_vertex) {}

  // Transforms the vectors. Returns whether there is such a transformation.
  bool operator()(const Indexed_disk_frame& frame, Vectors& v) const;

private:
  bool barycentre(Vectors& v) const { return Moebius_centering(weights_, true)(v) && turn(v, first_); }

  bool centre(Vectors& v, Index c) const
  {
    const int most_rounds = 40, few_rounds = 3;   // more than one for the digits, and where the vertex is far away
    const double zero = 1e-16, rounding = 1e-14;  // of the distance from the centre: the latter is good enough after a few rounds
    const double longest = 20;                    // beyond that, boosts lose the digits of the points
    for(int round = 0; round < most_rounds; ++round)
    {
      const Light_vector<double> p = rounded(v[c]);
      const double x = p[0] / p[3], z = p[2] / p[3], y = p[1] / p[3], size = std::hypot(x, z);
      if(!(size > zero) || (round > few_rounds && size < rounding))
        break;
      // sinh of the distance from the axis of the disk, in the plane y = 0 of hyperbolic space above which the vertex lies
      const double rapidity = (std::min)(longest, std::asinh(size / y)), scale = rapidity / size;
      transform(boost_matrix<Wide>({{ x * scale, 0, z * scale }}), v);
    }
    return turn(v, first_);
  }

  // The three vectors are linearly independent, and span the plane y = 0. In it, those of the three places, multiplied by factors so that products
  // are the same, are a basis, too: the linear map of one to the other is a Lorentz transformation.
  bool three_points(Vectors& v, const std::array<Index, 3>& border) const
  {
    std::array<std::array<Wide, 3>, 3> from, to;
    set_bases(v, border, from, to);
    const Wide all = determinant(from[0], from[1], from[2]);
    if(!(all * determinant(to[0], to[1], to[2]) > 0)) // two of them are the same, or in the wrong order
      return false;
    Lorentz_matrix<Wide> m = Lorentz_matrix<Wide>::identity();
    const std::array<std::size_t, 3> at = {{0, 2, 3}};
    for(std::size_t k = 0; k < 3; ++k) // the image of the k-th unit vector
    {
      std::array<Wide, 3> unit = {{Wide(0), Wide(0), Wide(0)}};
      unit[k] = Wide(1);
      const std::array<Wide, 3> b = {{ determinant(unit, from[1], from[2]) / all, determinant(from[0], unit, from[2]) / all,
                                       determinant(from[0], from[1], unit) / all }};
      for(std::size_t i = 0; i < 3; ++i)
        m.row[at[i]][at[k]] = b[0] * to[0][i] + b[1] * to[1][i] + b[2] * to[2][i];
    }
    transform(m, v);
    return turn(v, border[0]);
  }

  // The vectors, and those of the three places with the same products; without y.
  static void set_bases(const Vectors& v, const std::array<Index, 3>& border,
                        std::array<std::array<Wide, 3>, 3>& from, std::array<std::array<Wide, 3>, 3>& to)
  {
    using std::sqrt;
    const std::array<Wide, 3> product = {{ -lorentz_product(v[border[1]], v[border[2]]), -lorentz_product(v[border[2]], v[border[0]]),
                                           -lorentz_product(v[border[0]], v[border[1]]) }};
    const Wide root = Wide(sqrt(Wide(3))) / 2, place = Wide(3) / 2; // minus the product of two of the three places
    const std::array<std::array<Wide, 2>, 3> uv = {{ {{ Wide(1), Wide(0) }}, {{ Wide(-0.5), root }}, {{ Wide(-0.5), -root }} }};
    for(std::size_t i = 0; i < 3; ++i)
    {
      // c_i c_j place = product_k
      const Wide c = sqrt(Wide(product[(i + 1) % 3] / place * (product[(i + 2) % 3] / product[i])));
      from[i] = {{ v[border[i]][0], v[border[i]][2], v[border[i]][3] }};
      to[i] = {{ c * uv[i][1], c * uv[i][0], c }};
    }
  }

  // The point of the disk is (z, x) / (t + y). Turns the border vertex to (1, 0).
  static bool turn(Vectors& v, Index border)
  {
    using std::sqrt;
    const Wide x = v[border][0], z = v[border][2], size = Wide(sqrt(Wide(x * x + z * z)));
    if(!(size > 0))
      return false;
    const Wide c = z / size, s = x / size;
    Lorentz_matrix<Wide> m = Lorentz_matrix<Wide>::identity();
    m.row[0][0] = m.row[2][2] = c;
    m.row[0][2] = -s;
    m.row[2][0] = s;
    transform(m, v);
    return true;
  }

  std::vector<double> weights_;
  Index first_;
};

template <typename Wide>
bool Disk_normalization<Wide>::operator()(const Indexed_disk_frame& frame, Vectors& v) const
{
  switch(frame.kind)
  {
  case Indexed_disk_frame::CENTRE:       return centre(v, frame.vertices[0]);
  case Indexed_disk_frame::THREE_POINTS: return three_points(v, frame.vertices);
  default:                               return barycentre(v);
  }
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template bool Disk_normalization<Double_double>::operator()(const Indexed_disk_frame&, Vectors&) const;
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_DISK_NORMALIZATION_H
