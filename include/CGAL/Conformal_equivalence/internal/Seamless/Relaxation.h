// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Some vertices of a layout are moved, around triangles that are inverted: each to the mean value of its neighbors (Floater, 2003), with the weights
// (tan(alpha / 2) + tan(beta / 2)) / length of the angles of the mesh beside an edge. These weights are positive, so that in a
// region with a convex border no triangle is left inverted (Tutte, 1963); other regions have to be tried. What is left then may go away if
// each vertex is put where it is farthest from the lines of the opposite sides of its triangles, on their left: at the centre of a largest circle in
// the kernel of its star, if there is one.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_RELAXATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_RELAXATION_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Texture_lattice.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Meta_polygon.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
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
  typedef std::complex<double> Complex;

public:
  // The vertices of the faces and of some rings of faces around these are free, unless they are fixed; on borders only to be centred. Keeps
  // references.
  Relaxation(const Triangulation& t, const Meta_polygon& polygon, const Texture_lattice& lattice, const std::vector<Motion>& motion,
             const std::vector<char>& is_fixed, const std::vector<Index>& faces, int rings)
    : t_(t), polygon_(polygon), lattice_(lattice), motion_(motion)
  {
    std::set<Index> reached;
    for(Index f : faces)
      for(const Index h : t.halfedges(f))
        reached.insert(t.target(h));
    for(int ring = 0; ring < rings; ++ring)
      for(Index v : std::vector<Index>(reached.begin(), reached.end()))
        t.for_each_outgoing(v, [&](Index h) { reached.insert({t.target(h), t.apex(h)}); });
    for(Index v : reached)
      if(!is_fixed[v])
        vertices_.push_back({v, neighbors(v)});
  }

  // To mean values of neighbors.
  void average(std::vector<Point>& z) const
  {
    // the mean values converge in about as many rounds as there are vertices; large regions do with fewer, so that the work stays bounded
    const std::size_t enough = 20 + 10 * vertices_.size(), most = 20 + 200000 / (vertices_.size() + 1);
    for(std::size_t i = 0; i < (std::min)(enough, most); ++i)
      for(const Free_vertex& v : vertices_)
        if(!t_.is_border_vertex(v.vertex))
          z[v.vertex] = mean(v, z);
  }

  // Towards the centres of largest circles, one vertex after the other.
  void centre(std::vector<Point>& z) const
  {
    const int number_of_rounds = 20; // vertices settle after a few
    for(int i = 0; i < number_of_rounds; ++i)
      for(const Free_vertex& v : vertices_)
        move_to_centre(v, z);
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

  // ---- Largest circles

  // A line of the plane, with its left unit normal.
  struct Line
  {
    Complex point, normal;
    double distance(const Complex& z) const { return std::real(std::conj(normal) * (z - point)); }
  };

  // The sides opposite to the vertex, in its first corner; `radius` is the largest distance of their ends from it.
  std::vector<Line> opposite_sides(Index v, const std::vector<Point>& z, double& radius) const
  {
    std::vector<Line> result;
    const Complex here = lattice_.to_plane(z[v]);
    radius = 0;
    t_.for_each_outgoing(v, [&](Index h)
    {
      const Index corner = t_.previous(h);
      const auto place = [&](Index other)
      {
        return lattice_.to_plane(polygon_.apply_inverse(motion_of(corner), polygon_.apply(motion_of(other), z[t_.target(other)])));
      };
      const Complex p = place(h), q = place(t_.next(h)), d = q - p;
      radius = (std::max)({radius, std::abs(p - here), std::abs(q - here)});
      if(std::abs(d) > 0)
        result.push_back({p, Complex(-d.imag(), d.real()) / std::abs(d)});
    });
    return result;
  }

  // Away from the nearest line, or the one that is farthest on the wrong side, with shorter and shorter steps; keeps the best place.
  void move_to_centre(const Free_vertex& v, std::vector<Point>& z) const
  {
    double radius = 0;
    const std::vector<Line> lines = opposite_sides(v.vertex, z, radius);
    if(lines.empty())
      return;
    const Line* nearest = nullptr;
    const auto distance_to_nearest = [&](const Complex& w)
    {
      double least = std::numeric_limits<double>::infinity();
      for(const Line& line : lines)
        if(line.distance(w) < least)
        {
          least = line.distance(w);
          nearest = &line;
        }
      return least;
    };
    Complex w = lattice_.to_plane(z[v.vertex]), best = w;
    double largest = distance_to_nearest(w);
    const double far_enough = 0.05 * radius; // from all sides: the trouble is not here
    if(nearest == nullptr || largest > far_enough)
      return;
    const int number_of_steps = 50; // the last is a fiftieth of the radius
    for(int k = 0; k < number_of_steps; ++k)
    {
      w += radius / (k + 4.) * nearest->normal;
      const double distance = distance_to_nearest(w);
      if(distance > largest)
      {
        largest = distance;
        best = w;
      }
    }
    z[v.vertex] = lattice_.from_plane(best);
  }

  const Motion& motion_of(Index corner) const { return motion_[polygon_.motion_of_corner[corner]]; }

  const Triangulation& t_;
  const Meta_polygon& polygon_;
  const Texture_lattice& lattice_;
  const std::vector<Motion>& motion_;
  std::vector<Free_vertex> vertices_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_RELAXATION_H
