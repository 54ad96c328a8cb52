// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_STEREOGRAPHIC_PLACEMENT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_STEREOGRAPHIC_PLACEMENT_H

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/compute_layout.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Ideal_polyhedron.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Punctured_surface.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/pieces.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/wedges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// From the flat metric of a surface without its apex to points of the sphere: the disk is laid out in the plane, moved so that the vertices spread
// over both hemispheres, and projected from the pole, where the apex is.
template <typename NT>
class Stereographic_placement
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;
  typedef Conformal_metric<NT> Metric;
  typedef typename Ideal_polyhedron<NT>::Wide Wide;
  typedef Complex_number<Wide> Complex;

public:
  // The metric is kept as a reference.
  explicit Stereographic_placement(const Metric& metric) : metric_(metric), disk_(metric.triangulation) {}

  // Writes the vectors of the polyhedron.
  void operator()(const Symmetry_axis& axis, Ideal_polyhedron<NT>& polyhedron)
  {
    lay_out();
    const double size = axis.empty() ? put_in_the_middle() : put_on_axis(axis);
    polyhedron.vectors.assign(disk_.number_of_vertices(), Light_vector<Wide>{{Wide(0), Wide(0), Wide(0), Wide(0)}});
    const Wide root = sqrt_of(Wide(size));
    for(Index v = 0; v < disk_.number_of_vertices(); ++v)
      if(!disk_.is_isolated_vertex(v))
        polyhedron.vectors[v] = light_vector(Complex{position_[v].re / size, position_[v].im / size}, Wide(metric_.scale_factors[v] / root));
    const Wide weight = Wide(polyhedron.unit) * polyhedron.unit / (2 * Wide(size));
    polyhedron.vectors[polyhedron.apex] = {{Wide(0), Wide(0), -weight, weight}};
  }

private:
  void lay_out()
  {
    const Cut_graph nothing;
    const Wedges wedges = find_wedges(disk_, nothing);
    Development<NT> development(metric_, nothing, wedges);
    development(find_pieces(disk_, nothing, wedges).front().central_face);
    position_.assign(disk_.number_of_vertices(), Complex{Wide(0), Wide(0)});
    for(Index h = 0; h < disk_.number_of_halfedges(); ++h)
      position_[disk_.target(h)] = development.positions()[wedges.of_corner[h]];
  }

  static Wide sqrt_of(const Wide& x)
  {
    using std::sqrt;
    return Wide(sqrt(x));
  }

  // Half of the vertices lie on each side of the median.
  static double median(std::vector<double>& x)
  {
    const auto middle = x.begin() + std::ptrdiff_t(x.size() / 2);
    std::nth_element(x.begin(), middle, x.end());
    return *middle;
  }

  static double positive(double x) { return x > 0 && std::isfinite(x) ? x : 1; }

  // Moves the median vertex to the origin, and returns the median distance: with that for a unit, half of the vertices lie on
  // each hemisphere.
  double put_in_the_middle()
  {
    std::vector<double> x, y, r;
    for(Index v = 0; v < disk_.number_of_vertices(); ++v)
      if(!disk_.is_isolated_vertex(v))
      {
        x.push_back(static_cast<double>(position_[v].re));
        y.push_back(static_cast<double>(position_[v].im));
      }
    const Wide cx(median(x)), cy(median(y));
    for(Index v = 0; v < disk_.number_of_vertices(); ++v)
      if(!disk_.is_isolated_vertex(v))
      {
        position_[v] = {position_[v].re - cx, position_[v].im - cy};
        r.push_back(size_of(position_[v]));
      }
    return positive(median(r));
  }

  // Turns the axis to the real one, with what counts above, and returns the median distance from the middle.
  double put_on_axis(const Symmetry_axis& axis)
  {
    const Complex a = position_[axis.first], direction = conjugate_direction(axis);
    std::vector<double> x, r;
    for(Index v = 0; v < disk_.number_of_vertices(); ++v)
      if(!disk_.is_isolated_vertex(v))
      {
        position_[v] = direction * Complex{position_[v].re - a.re, position_[v].im - a.im};
        if(axis.contains[v])
          position_[v].im = Wide(0);
        x.push_back(static_cast<double>(position_[v].re));
      }
    const Wide middle(median(x));
    for(Index v = 0; v < disk_.number_of_vertices(); ++v)
      if(!disk_.is_isolated_vertex(v))
      {
        position_[v].re = position_[v].re - middle;
        r.push_back(size_of(position_[v]));
      }
    return positive(median(r));
  }

  // The unit number by which the direction of the axis is multiplied to become real.
  Complex conjugate_direction(const Symmetry_axis& axis) const
  {
    const Complex a = position_[axis.first], b = position_[axis.last];
    Complex direction{b.re - a.re, b.im - a.im};
    const Wide length = Wide(positive(size_of(direction)));
    direction = {direction.re / length, direction.im / length};
    const Wide unit = sqrt_of(Wide(direction.re * direction.re + direction.im * direction.im));
    return {direction.re / unit, -(direction.im / unit)};
  }

  const Metric& metric_;
  const Triangulation& disk_;
  std::vector<Complex> position_; // by vertex
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_STEREOGRAPHIC_PLACEMENT_H
