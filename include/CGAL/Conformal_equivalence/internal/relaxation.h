// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Some vertices of a layout are moved, around triangles that are inverted: each to the mean value of its neighbors (Floater, 2003), with the weights
// (tan(alpha / 2) + tan(beta / 2)) / length of the angles of the mesh beside an edge. These weights are positive, so that in a
// region with a convex border no triangle is left inverted (Tutte, 1963); other regions have to be tried.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RELAXATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RELAXATION_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Texture_lattice.h>
#include <CGAL/Conformal_equivalence/internal/meta_polygon.h>
#include <CGAL/Conformal_equivalence/internal/triangle_formulas.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Relaxation
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<double> Triangulation;
  typedef Lattice_coordinates<double> Point;
  typedef Meta_polygon::Values<double> Motion;

public:
  // The vertices of the faces and of some rings of faces around these are free, unless they are fixed or on the border. Keeps references.
  Relaxation(const Triangulation& t, const Meta_polygon& polygon, const std::vector<Motion>& motion, const std::vector<char>& is_fixed,
             const std::vector<Index>& faces, int rings)
    : t_(t), polygon_(polygon), motion_(motion)
  {
    std::set<Index> reached;
    for(Index f : faces)
      for(Index h = 3 * f; h < 3 * f + 3; ++h)
        reached.insert(t.target(h));
    for(int ring = 0; ring < rings; ++ring)
      for(Index v : std::vector<Index>(reached.begin(), reached.end()))
        t.for_each_outgoing(v, [&](Index h) { reached.insert({t.target(h), t.apex(h)}); });
    for(Index v : reached)
      if(!is_fixed[v] && !t.is_border_vertex(v))
        vertices_.push_back({v, neighbors(v)});
  }

  void operator()(std::vector<Point>& z) const
  {
    const std::size_t n = 20 + 10 * vertices_.size(), most = 2000;
    for(std::size_t i = 0; i < (std::min)(n, most); ++i)
      for(const Free_vertex& v : vertices_)
        z[v.vertex] = mean(v, z);
  }

private:
  struct Neighbor
  {
    Index from, to;  // corners in one face: of the vertex, and of the neighbor
    double weight;
  };

  struct Free_vertex
  {
    Index vertex;
    std::vector<Neighbor> neighbors;
  };

  // Each edge counts once for each of its faces.
  std::vector<Neighbor> neighbors(Index v) const
  {
    std::vector<Neighbor> result;
    t_.for_each_outgoing(v, [&](Index h)
    {
      const Index corner = t_.previous(h);
      const double weight = tangent_of_half_angle(h);
      result.push_back({corner, h, weight / t_.halfedge_length(h)});
      result.push_back({corner, t_.next(h), weight / t_.halfedge_length(corner)});
    });
    if(std::any_of(result.begin(), result.end(), [](const Neighbor& n) { return !(n.weight > 0 && std::isfinite(n.weight)); }))
      for(Neighbor& n : result) // degenerate triangles
        n.weight = 1;
    return result;
  }

  // Of the angle where h begins.
  double tangent_of_half_angle(Index h) const
  {
    const Incircle_form<double> triangle(t_.halfedge_length(h), t_.halfedge_length(t_.next(h)), t_.halfedge_length(t_.previous(h)));
    return triangle.r / triangle.tangent[1];
  }

  Point mean(const Free_vertex& v, const std::vector<Point>& z) const
  {
    double sum = 0;
    Point result{{0, 0}};
    for(const Neighbor& n : v.neighbors)
    {
      const Point p = polygon_.apply_inverse(motion_of(n.from), polygon_.apply(motion_of(n.to), z[t_.target(n.to)]));
      sum += n.weight;
      for(int k = 0; k < 2; ++k)
        result[k] += n.weight * p[k];
    }
    return {{result[0] / sum, result[1] / sum}};
  }

  const Motion& motion_of(Index corner) const { return motion_[polygon_.motion_of_corner[corner]]; }

  const Triangulation& t_;
  const Meta_polygon& polygon_;
  const std::vector<Motion>& motion_;
  std::vector<Free_vertex> vertices_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RELAXATION_H
