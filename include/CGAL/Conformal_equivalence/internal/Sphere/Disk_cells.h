// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_DISK_CELLS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_DISK_CELLS_H

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Cell_verdict.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Ideal_polyhedron.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/disk_points.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/ideal_refinement.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>
#include <CGAL/Conformal_equivalence/triangulate_refinement.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The overlay of a disk and the polyhedron that flips have made of it, or of its double, in triangles, and the verdict on these.
template <typename NT>
class Disk_cells
{
  typedef std::uint32_t Index;
  typedef typename Ideal_polyhedron<NT>::Wide Wide;
  typedef std::array<Wide, 2> Wide_point;

public:
  Common_refinement<NT> refinement;         // has the status
  std::vector<Light_vector<Wide> > vectors; // by vertex of the refinement

  // `whole`: what was flipped, the surface or its double
  Disk_cells(const Intrinsic_triangulation<NT>& surface, const Intrinsic_triangulation<NT>& whole, const Ideal_polyhedron<NT>& polyhedron);

private:
  // Those that are not positive when rounded are known already.
  void judge(const std::vector<Wide_point>& wide)
  {
    std::vector<Index> suspects = refinement.flipped_faces;
    suspects.insert(suspects.end(), refinement.rounded_faces.begin(), refinement.rounded_faces.end());
    std::sort(suspects.begin(), suspects.end());
    Cell_verdict verdict;
    for(Index f : suspects)
    {
      const auto corner = [&](std::size_t k) { return wide[refinement.corner_vertex[refinement.first_corner[f] + k]]; };
      verdict.judge(f, [] { return false; }, [&] { return is_positive_in_disk(corner(0), corner(1), corner(2)); });
    }
    put_verdict(std::move(verdict), refinement);
  }
};

template <typename NT>
Disk_cells<NT>::Disk_cells(const Intrinsic_triangulation<NT>& surface, const Intrinsic_triangulation<NT>& whole,
                           const Ideal_polyhedron<NT>& polyhedron)
{
  const Surface_size size = { surface.number_of_vertices(), surface.number_of_edges(), surface.number_of_faces() };
  Ideal_refinement<NT> overlay = Ideal_refinement_builder<NT>(whole, polyhedron, size)(default_maximum_number_of_crossings, weight_in_disk<Wide>);
  if(!bool(overlay.parts))
  {
    refinement = std::move(overlay.parts);
    return;
  }
  const std::vector<Wide_point> wide = disk_points(overlay.vectors);
  const std::vector<std::array<NT, 2> > points = rounded_points<NT>(wide);
  for(Index v : overlay.parts.corner_vertex)
    overlay.parts.corner_uv.push_back(points[v]);
  refinement = triangulate_refinement(overlay.parts);
  vectors = std::move(overlay.vectors);
  judge(wide);
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template Disk_cells<double>::Disk_cells(const Intrinsic_triangulation<double>&, const Intrinsic_triangulation<double>&,
                                               const Ideal_polyhedron<double>&);
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_DISK_CELLS_H
