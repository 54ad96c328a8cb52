// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IDEAL_POLYHEDRON_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IDEAL_POLYHEDRON_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The points, not normalized, as vectors of the light cone with -2 <v_i, v_j> = l_ij^2.
template <typename NT>
struct Ideal_polyhedron
{
  typedef std::uint32_t Index;
  typedef typename Wider_number<NT>::type Wide;

  Index apex = Intrinsic_triangulation<NT>::null_index;
  double unit = 1;                            // how long edges of the apex are whose other ends have u = 0
  Intrinsic_triangulation<NT> triangulation;  // of the whole surface, flipped
  std::vector<Index> flips;                   // how it came from the one given
  std::vector<Light_vector<Wide> > vectors;   // by vertex; 0 for isolated ones
  std::size_t number_of_exchanges = 0;        // how often the link of the apex was changed
  std::vector<int> number_of_releases;        // by vertex: how often it was let go from the link
  Status status = Status::OK;
  double amount = 0;
  std::vector<Index> vertices, faces;         // at fault; faces of the triangulation given, if it was not flipped
  Statistics statistics;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IDEAL_POLYHEDRON_H
