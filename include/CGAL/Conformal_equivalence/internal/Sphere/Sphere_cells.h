// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_SPHERE_CELLS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_SPHERE_CELLS_H

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Spherical_refinement.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Cell_verdict.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Ideal_polyhedron.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/ideal_refinement.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/sphere_points.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/sphere_predicates.h>
#include <CGAL/Conformal_equivalence/triangulate_refinement.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The overlay of a closed surface and the polyhedron that flips have made of it, in triangles, and the verdict on these.
template <typename NT>
class Sphere_cells
{
  typedef std::uint32_t Index;
  typedef typename Ideal_polyhedron<NT>::Wide Wide;
  typedef std::array<Wide, 3> Wide_point;

public:
  Spherical_refinement<NT> refinement;      // its parts have the status
  std::vector<Light_vector<Wide> > vectors; // by vertex of the refinement

  Sphere_cells(const Intrinsic_triangulation<NT>& t, const Ideal_polyhedron<NT>& polyhedron);

private:
  // Points of edges of the polyhedron lie within the sphere, and go from there to it: for these points of the sphere w is not the
  // weight of the vector, but the length of its part in space.
  static void set_weights(Index number_of_input_vertices, Ideal_refinement<NT>& overlay)
  {
    using std::sqrt;
    for(std::size_t v = number_of_input_vertices; v < overlay.vectors.size(); ++v)
    {
      const Light_vector<Wide>& x = overlay.vectors[v];
      const Wide length = sqrt(Wide(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]));
      overlay.parts.weights[v] = static_cast<NT>(Wide(overlay.parts.weights[v] * length / x[3]));
    }
  }

  // Every face from the centre to a plane in front of it, so that it can be cut into triangles.
  static void project_faces(const std::vector<Wide_point>& p, Common_refinement<NT>& parts)
  {
    parts.corner_uv.resize(parts.corner_vertex.size());
    for(Index f = 0; f < parts.number_of_faces(); ++f)
    {
      const std::size_t first = parts.first_corner[f], last = parts.first_corner[f + 1];
      Wide_point n = {{Wide(0), Wide(0), Wide(0)}};
      for(std::size_t c = first; c < last; ++c)
        for(std::size_t i = 0; i < 3; ++i)
          n[i] = n[i] + p[parts.corner_vertex[c]][i];
      const Eigen::Vector3d normal = Eigen::Vector3d(static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])).normalized();
      const Eigen::Vector3d x = normal.unitOrthogonal(), y = normal.cross(x);
      const Wide_point& o = p[parts.corner_vertex[first]];
      for(std::size_t c = first; c < last; ++c)
      {
        const Wide_point& q = p[parts.corner_vertex[c]];
        Eigen::Vector3d d; // exact enough for tiny faces
        for(int i = 0; i < 3; ++i)
          d[i] = static_cast<double>(Wide(q[std::size_t(i)] - o[std::size_t(i)]));
        parts.corner_uv[c] = {{ NT(x.dot(d)), NT(y.dot(d)) }};
      }
    }
  }

  // By the orientations seen from the centre.
  void judge(const std::vector<Wide_point>& wide)
  {
    Common_refinement<NT>& parts = refinement.parts;
    const std::vector<std::array<NT, 3> >& points = refinement.points;
    Cell_verdict verdict;
    for(Index f = 0; f < parts.number_of_faces(); ++f)
    {
      const std::size_t c = parts.first_corner[f];
      const Index i = parts.corner_vertex[c], j = parts.corner_vertex[c + 1], k = parts.corner_vertex[c + 2];
      const auto is_positive = [&] { return is_counterclockwise(wide[i], wide[j], wide[k]); };
      verdict.judge(f, [&] { return is_positive() && is_counterclockwise(points[i], points[j], points[k]); }, is_positive);
    }
    put_verdict(std::move(verdict), parts);
  }
};

template <typename NT>
Sphere_cells<NT>::Sphere_cells(const Intrinsic_triangulation<NT>& t, const Ideal_polyhedron<NT>& polyhedron)
{
  const Surface_size size = { t.number_of_vertices(), t.number_of_edges(), t.number_of_faces() };
  Ideal_refinement<NT> overlay = Ideal_refinement_builder<NT>(t, polyhedron, size)(
    default_maximum_number_of_crossings, [](const Light_vector<Wide>& v) { return v[3]; });
  if(!bool(overlay.parts))
  {
    refinement.parts = std::move(overlay.parts);
    return;
  }
  const std::vector<Wide_point> wide = sphere_points(overlay.vectors);
  set_weights(t.number_of_vertices(), overlay);
  project_faces(wide, overlay.parts);
  refinement.parts = triangulate_refinement(overlay.parts);
  refinement.parts.corner_uv.clear();
  refinement.points = rounded_points<NT>(wide);
  vectors = std::move(overlay.vectors);
  judge(wide);
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template Sphere_cells<double>::Sphere_cells(const Intrinsic_triangulation<double>&, const Ideal_polyhedron<double>&);
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_SPHERE_CELLS_H
