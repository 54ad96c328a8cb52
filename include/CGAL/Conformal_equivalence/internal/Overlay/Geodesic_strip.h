// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Where the edges of an input triangulation cross those of the triangulation that flips have made of it.
//
// Both are geodesic triangulations of one hyperbolic surface with cusps: every triangle is ideal, and the length l_ij of an edge
// tells where it leaves the horocycles around its ends (Penner coordinates, lambda = 2 log l; section 5 of Bobenko, Pinkall and
// Springborn, 2015; Springborn, 2020). In the hyperboloid model a cusp with its horocycle is a vector v_i of the light
// cone, with
//
//     B(v_i, v_i) = 0,   B(v_i, v_j) = l_ij^2     (B: minus twice the Lorentz product),
//
// and the point sum b_i v_i of an ideal triangle is, in Klein's model with the Euclidean triangle l_ij inscribed to the circle, the point with
// barycentric coordinates b. (B(x, x) = 0 is the equation of the circumcircle.) So the points of an input triangle
// are linear in these vectors; and so are homogeneous coordinates in the scaled triangles, which have the vectors e^{u_i} v_i.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_GEODESIC_STRIP_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_GEODESIC_STRIP_H

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Layout/Unfolded_strip.h>
#include <CGAL/Conformal_equivalence/internal/Layout/period_lattice.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/normal_coordinates.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Where an edge of the input crosses one of the current triangulation.
template <typename Wide>
struct Overlay_crossing
{
  std::uint32_t input_edge;
  std::uint32_t halfedge;       // the current one that is crossed by the first halfedge of the input edge, from its face to that of its twin
  Wide parameter;               // from the origin (0) to the target (1) of the first halfedge of the input edge, in the Euclidean input triangle
  Wide current_parameter;       // along `halfedge`, in the unscaled current triangle
  Wide weight;                  // e^{-u}, linear in the input triangle
  Complex_number<Wide> ratio;   // laid out, the point is z_origin + ratio * (z_target - z_origin), of the first halfedge
};

// The geodesic of one input edge, through the strip of current triangles that it crosses:
//
//          o2 = p1        p2
//         /  \ g2 = twin(c2)
//       /  c1  \  /                Each side c that is crossed runs from o to t. The distances D from the origin i and E
//     i ----|---\/---|--- j        from the target j to the vertices of the strip follow from Ptolemy's
//       \   |   /\   | /           theorem, one triangle after the other: all terms are positive.
//         \ |  /   \ /
//          \| /t1
template <typename NT>
class Geodesic_strip
{
  typedef std::uint32_t Index;
  typedef Conformal_metric<NT> Metric;
  typedef Normal_coordinates::Path Path;

public:
  typedef typename Metric::Wide_number Wide;
  typedef Complex_number<Wide> Complex;
  typedef Overlay_crossing<Wide> Crossing;

  // `weights`: e^{-u}, by vertex of the current triangulation
  Geodesic_strip(const Metric& metric, const std::vector<Wide>& weights)
    : metric_(metric), t_(metric.triangulation), weights_(weights)
  {}

  // Calls `visit(m, crossing)` for all crossings of the input edge `e` along the path of its first halfedge.
  template <typename Visit>
  void operator()(Index e, const Path& path, Visit visit)
  {
    const std::size_t n = path.crossed.size();
    strip_.resize(n);
    measure_from_origin(path);
    measure_from_target(path);
    lay_out(path);
    for(std::size_t m = 0; m < n; ++m)
      visit(m, crossing(e, path.crossed[m], strip_[m]));
  }

private:
  // The two ends of a crossed side: its origin, and its target.
  struct Side
  {
    std::array<Wide, 2> from_origin, from_target;
    std::array<Complex, 2> position;
  };

  Wide length(Index h) const { return Wide(t_.halfedge_length(h)); }

  void measure_from_origin(const Path& path)
  {
    strip_[0].from_origin = {{length(path.first), length(t_.previous(path.first))}};
    for(std::size_t m = 0; m < strip_.size(); ++m)
    {
      const Index c = path.crossed[m], g = t_.twin(c);
      const Wide to_o = strip_[m].from_origin[0], to_t = strip_[m].from_origin[1];
      const Wide to_p = to_o * (length(t_.previous(g)) / length(c)) + to_t * (length(t_.next(g)) / length(c));
      if(m + 1 == strip_.size())
        length_ = to_p;
      else if(path.crossed[m + 1] == t_.next(g)) // from o to p
        strip_[m + 1].from_origin = {{to_o, to_p}};
      else
        strip_[m + 1].from_origin = {{to_p, to_t}};
    }
  }

  void measure_from_target(const Path& path)
  {
    const Index last = t_.twin(path.crossed.back());
    strip_.back().from_target = {{length(t_.next(last)), length(t_.previous(last))}};
    for(std::size_t m = strip_.size() - 1; m-- > 0; )
    {
      const Index c = path.crossed[m + 1], g = t_.twin(path.crossed[m]); // c is a side of the face of g
      const std::array<Wide, 2>& to = strip_[m + 1].from_target;
      if(c == t_.next(g))
        strip_[m].from_target = {{to[0], to[0] * (length(t_.previous(g)) / length(c)) + to[1] * (length(g) / length(c))}};
      else
        strip_[m].from_target = {{to[0] * (length(g) / length(c)) + to[1] * (length(t_.next(g)) / length(c)), to[1]}};
    }
  }

  // The scaled triangles, side by side in the plane; the geodesic begins in 0.
  void lay_out(const Path& path)
  {
    Unfolded_strip<NT> unfolded(metric_, path.first);
    for(std::size_t m = 0; m < strip_.size(); ++m)
    {
      strip_[m].position = unfolded.ends(path.crossed[m]);
      unfolded.cross(path.crossed[m]);
    }
    target_ = unfolded.apex();
  }

  // The diagonals of the ideal quadrilateral i, t, j, o meet in  a v_i + b v_j = c v_o + d v_t  with
  //
  //     a : b = jo jt : io it,     c : d = it jt : io jo,     c = it jt / (jo jt + io it) * ij / ot   where a + b = 1;
  //
  // B with each of the four vectors, and Ptolemy's theorem io jt + it jo = ij ot, show it.
  Crossing crossing(Index e, Index halfedge, const Side& side) const
  {
    const Wide &io = side.from_origin[0], &it = side.from_origin[1], &jo = side.from_target[0], &jt = side.from_target[1];
    const Wide one(1);
    Crossing result;
    result.input_edge = e;
    result.halfedge = halfedge;
    result.parameter = one / (one + (jo / io) * (jt / it));
    result.current_parameter = one / (one + (it / io) * (jt / jo));
    const Wide longer = length_ / length(halfedge);
    const Wide at_o = weights_[t_.origin(halfedge)] * (longer / (jo / it + io / jt)),
               at_t = weights_[t_.target(halfedge)] * (longer / (jt / io + it / jo));
    result.weight = at_o + at_t;
    const Wide s = at_t / result.weight, r = at_o / result.weight;
    const double size = size_of(target_); // without over- and underflow of squares
    const Complex z = r * side.position[0] + s * side.position[1];
    result.ratio = Complex{z.re / size, z.im / size} / Complex{target_.re / size, target_.im / size};
    return result;
  }

  const Metric& metric_;
  const Intrinsic_triangulation<NT>& t_;
  const std::vector<Wide>& weights_;
  std::vector<Side> strip_;
  Wide length_;    // of the geodesic
  Complex target_;
};

// Quotients of weights that are not less than this, and sums and products of a few of these, stay in the range of `double`, with full
// precision also as pairs.
constexpr double least_weight = 1e-280;

// The weights e^{-u} of the vertices, scaled to a maximum of 1, and not below what can be divided by; 1 for isolated vertices.
template <typename NT>
std::vector<typename Conformal_metric<NT>::Wide_number> vertex_weights(const Conformal_metric<NT>& metric)
{
  typedef typename Conformal_metric<NT>::Wide_number Wide;
  const Intrinsic_triangulation<NT>& t = metric.triangulation;
  const std::vector<Wide>& s = metric.scale_factors;
  bool is_first = true;
  Wide least(1);
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v) && (is_first || s[v] < least))
    {
      least = s[v];
      is_first = false;
    }
  std::vector<Wide> weights(t.number_of_vertices(), Wide(1));
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v))
    {
      const Wide r = least / s[v];
      weights[v] = (std::max)(Wide(r * r), Wide(least_weight));
    }
  return weights;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_GEODESIC_STRIP_H
