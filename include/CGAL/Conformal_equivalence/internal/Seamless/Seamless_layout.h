// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The last step of a seamless layout: from positions of the vertices to corners whose seams are exact, and triangles that are positive.
//
// Positions of vertices on the cut are rounded to a grid so coarse that the motions across it, rotations of lattice coordinates and integers, are
// free of rounding. Orientations are decided after that. Triangles that are inverted, if they are few, are mended by moving vertices nearby.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_SEAMLESS_LAYOUT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_SEAMLESS_LAYOUT_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Number_constants.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Texture_lattice.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Meta_polygon.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Relaxation.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Seamless_layout
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<double> Triangulation;
  typedef std::complex<double> Complex;

public:
  typedef Lattice_coordinates<std::int64_t> Lattice_point;
  typedef std::vector<Meta_polygon::Values<double> > Motions;      // by number of the motion
  typedef std::vector<Lattice_coordinates<double> > Positions;     // by vertex, in its first corner

  // Cones are never moved. Keeps references.
  Seamless_layout(const Triangulation& t, const Meta_polygon& polygon, const Texture_lattice& lattice, const std::vector<Quantized_cone>& cones,
                  bool is_lattice_coordinates)
    : t_(t), polygon_(polygon), lattice_(lattice), cones_(cones), is_lattice_coordinates_(is_lattice_coordinates)
  {}

  // Is a layout refused in which positive triangles go around a vertex once too often, or not often enough? (Those around it then count as inverted.)
  void set_strict(bool is_strict)
  {
    is_strict_ = is_strict;
    has_refused_wound_ = false;
  }

  // Was anything refused since for that reason alone?
  bool has_refused_wound() const { return has_refused_wound_; }

  // Those vertices inside the surface: angles around them do not add up to what they should, but differ by full turns.
  std::vector<Index> wound_vertices(const Layout<double>& layout) const
  {
    const double turn = 2 * Number_constants<double>::pi();
    std::vector<double> excess(t_.number_of_vertices(), -turn);
    for(const Quantized_cone& cone : cones_)
      excess[cone.vertex] = -turn * double(cone.quanta) / double(lattice_.symmetry());
    for(Index h = 0; h < t_.number_of_halfedges(); ++h)
      excess[t_.target(h)] += angle(layout, h);
    std::vector<Index> result;
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      if(!t_.is_isolated_vertex(v) && !t_.is_border_vertex(v) && std::abs(excess[v]) > turn / 2)
        result.push_back(v);
    return result;
  }

  // The triangles that were not positive when something was last laid out in vain, some of them twice.
  const std::vector<Index>& inverted() const { return inverted_; }

  // The corners; the positions are what has become of them. Returns whether all triangles are positive.
  bool operator()(const Motions& motion, Positions& z, Layout<double>& result)
  {
    return lay_out(motion, z, result) || untangle(motion, z, result);
  }

  // Whether the motions take each side of the cut exactly to the other; in lattice coordinates.
  bool is_seamless(const Motions& motions, const Positions& z, const std::vector<Lattice_point>& translation) const
  {
    const auto corner = [&](Index h) { return polygon_.apply(motions[polygon_.motion_of_corner[h]], z[t_.target(h)]); };
    std::vector<Lattice_coordinates<double> > by;
    for(const Lattice_point& p : translation)
      by.push_back({{double(p[0]), double(p[1])}});
    for(std::size_t p = 0; p < polygon_.paths.size(); ++p)
      for(Index h : polygon_.paths[p].halfedges)
      {
        const auto motion = polygon_.after(Meta_polygon::Values<double>(), Meta_polygon::Crossing{Index(p), true}, by);
        const Index g = t_.twin(h);
        if(polygon_.apply(motion, corner(h)) != corner(t_.previous(g)) || polygon_.apply(motion, corner(t_.previous(h))) != corner(g))
          return false;
      }
    return true;
  }

private:
  // Makes the corners, with positions rounded. Returns whether all triangles are positive.
  bool lay_out(const Motions& motion, Positions& z, Layout<double>& result)
  {
    snap(motion, z);
    result.corner.resize(t_.number_of_halfedges());
    for(Index h = 0; h < result.corner.size(); ++h)
    {
      result.corner[h] = polygon_.apply(motion[polygon_.motion_of_corner[h]], z[t_.target(h)]);
      if(is_lattice_coordinates_)
        continue;
      const Complex w = lattice_.to_plane(result.corner[h]);
      result.corner[h] = {{w.real(), w.imag()}};
    }
    find_inverted(result);
    if(inverted_.empty() && is_strict_)
    {
      add_triangles_around(wound_vertices(result));
      has_refused_wound_ = has_refused_wound_ || !inverted_.empty();
    }
    return inverted_.empty();
  }

  // Moves vertices around triangles that are inverted, few of them, until none is.
  bool untangle(const Motions& motion, Positions& z, Layout<double>& result)
  {
    // If there are more, the deformation is too coarse, and nothing local helps: of some 900 attempts none with more than 131 has succeeded.
    const std::size_t few = (std::min)(10 + std::size_t(t_.number_of_faces()) / 100, std::size_t(140));
    if(inverted_.size() > few)
      return false;
    const std::vector<Index> first_inverted = inverted_;
    std::vector<char> is_fixed(t_.number_of_vertices(), 0);
    for(const Quantized_cone& cone : cones_)
      is_fixed[cone.vertex] = 1;
    for(int rings = 0; rings <= most_rings; ++rings)
    {
      Positions relaxed = z;
      const Relaxation relaxation(t_, polygon_, lattice_, motion, is_fixed, inverted_, rings);
      for(int centred = 0; centred < 3; ++centred) // averaged, then centred twice
      {
        centred == 0 ? relaxation.average(relaxed) : relaxation.centre(relaxed);
        if(!lay_out(motion, relaxed, result))
          continue;
        z = std::move(relaxed);
        return true;
      }
      inverted_.insert(inverted_.end(), first_inverted.begin(), first_inverted.end());
    }
    return false;
  }

  // To multiples of a power of two, so coarse that there and in the images all coordinates have a few bits to spare.
  void snap(const Motions& motion, Positions& z) const
  {
    std::vector<char> is_on_seam(z.size(), 0);
    double largest = 1;
    for(Index h = 0; h < t_.number_of_halfedges(); ++h)
    {
      const Index m = polygon_.motion_of_corner[h], v = t_.target(h);
      if(m == 0)
        continue;
      is_on_seam[v] = 1;
      for(const Lattice_coordinates<double>& p : {z[v], motion[m].translation, polygon_.apply(motion[m], z[v])})
        largest = (std::max)(largest, (std::max)(std::abs(p[0]), std::abs(p[1])));
    }
    const int bits = std::numeric_limits<double>::digits - 3 - (std::ilogb(largest) + 1);
    for(Index v = 0; v < z.size(); ++v)
      if(is_on_seam[v])
        for(double& x : z[v])
          x = std::scalbn(std::nearbyint(std::scalbn(x, bits)), -bits);
  }

  void find_inverted(const Layout<double>& result)
  {
    inverted_.clear();
    for(Index f = 0; f < t_.number_of_faces(); ++f)
      if(!is_left_turn(result.corner[3 * f], result.corner[3 * f + 1], result.corner[3 * f + 2]))
        inverted_.push_back(f);
  }

  void add_triangles_around(const std::vector<Index>& vertices)
  {
    std::vector<char> is_there(t_.number_of_vertices(), 0);
    for(Index v : vertices)
      is_there[v] = 1;
    for(Index h = 0; h < t_.number_of_halfedges(); ++h)
      if(is_there[t_.target(h)])
        inverted_.push_back(h / 3);
  }

  // At the target of h, of a triangle that is positive.
  double angle(const Layout<double>& result, Index h) const
  {
    const auto place = [&](Index corner)
    {
      const auto& p = result.corner[corner];
      return is_lattice_coordinates_ ? lattice_.to_plane(p) : Complex(p[0], p[1]);
    };
    const Complex apex = place(h);
    return std::abs(std::arg((place(t_.previous(h)) - apex) * std::conj(place(t_.next(h)) - apex)));
  }

  // Around triangles that are inverted. Where more are needed, another choice of positions is as good a layout, and found sooner.
  static constexpr int most_rings = 1;

  const Triangulation& t_;
  const Meta_polygon& polygon_;
  const Texture_lattice& lattice_;
  const std::vector<Quantized_cone>& cones_;
  const bool is_lattice_coordinates_;
  bool is_strict_ = false, has_refused_wound_ = false;
  std::vector<Index> inverted_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_SEAMLESS_LAYOUT_H
