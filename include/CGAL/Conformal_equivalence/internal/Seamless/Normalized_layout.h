// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A flat layout of a size and at a place that suit computations with it: its area is 1, and the first cone lies in the origin.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_NORMALIZED_LAYOUT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_NORMALIZED_LAYOUT_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Meta_polygon.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Quantized_cone.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Texture_lattice.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Normalized_layout
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<double> Triangulation;

public:
  typedef std::complex<double> Complex;

  // `polygon` is that of the layout `flat`; its translations follow. Without a cone the origin is the point around which the first path that
  // turns does so.
  Normalized_layout(const Triangulation& t, const Layout<double>& flat, const std::vector<Quantized_cone>& cones, const Texture_lattice& lattice,
                    Meta_polygon& polygon)
  {
    const int exponent = take_corners(flat);
    const double side = std::sqrt(area(t));
    unit_ = std::scalbn(side, exponent);
    for(Complex& z : corner_)
      z /= side;
    for(auto& path : polygon.paths)
      path.translation = Complex(std::scalbn(path.translation.real(), -exponent), std::scalbn(path.translation.imag(), -exponent)) / side;
    move_origin(origin(cones, lattice, polygon), lattice, polygon);
  }

  // By halfedge: where it ends, in its face.
  const std::vector<Complex>& corners() const { return corner_; }

  const Complex& operator[](Index h) const { return corner_[h]; }

  // The length that is 1 now.
  double unit() const { return unit_; }

private:
  // Divided by a power of two, whose exponent is returned, so that squares do not overflow.
  int take_corners(const Layout<double>& flat)
  {
    double largest = 0;
    for(const auto& p : flat.corner)
      largest = (std::max)(largest, (std::max)(std::abs(p[0]), std::abs(p[1])));
    int exponent = 0;
    std::frexp(largest, &exponent);
    for(const auto& p : flat.corner)
      corner_.emplace_back(std::scalbn(p[0], -exponent), std::scalbn(p[1], -exponent));
    return exponent;
  }

  double area(const Triangulation& t) const
  {
    double result = 0;
    for(Index f = 0; f < t.number_of_faces(); ++f)
      result += std::imag(std::conj(corner_[3 * f + 1] - corner_[3 * f]) * (corner_[3 * f + 2] - corner_[3 * f])) / 2;
    return result;
  }

  Complex origin(const std::vector<Quantized_cone>& cones, const Texture_lattice& lattice, const Meta_polygon& polygon) const
  {
    if(!cones.empty())
      return corner_[polygon.first_corner[cones.front().vertex]];
    for(const auto& path : polygon.paths)
      if(path.quanta != 0)
        return path.translation / (1. - lattice.rotation(path.quanta));
    return 0;
  }

  void move_origin(const Complex& origin, const Texture_lattice& lattice, Meta_polygon& polygon)
  {
    for(Complex& z : corner_)
      z -= origin;
    for(auto& path : polygon.paths)
      path.translation += (lattice.rotation(path.quanta) - 1.) * origin;
  }

  std::vector<Complex> corner_;
  double unit_ = 1;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_NORMALIZED_LAYOUT_H
