// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The overlay of an input triangulation and the triangulation that flips have made of it.
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

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_OVERLAY_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_OVERLAY_H

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/normal_coordinates.h>
#include <CGAL/Conformal_equivalence/internal/Layout/period_lattice.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <CGAL/assertions.h>

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

// A corner of a cell of the overlay, and the segment from there to the next corner, counterclockwise.
struct Overlay_corner
{
  bool is_crossing;
  std::uint32_t index;          // of the crossing; otherwise of the current halfedge that begins in this corner of its triangle
  std::uint32_t input_halfedge; // along which the segment runs, with the cell on the left; null_index if it runs along a current edge only
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
    Index h = path.first;
    Complex origin{Wide(0), Wide(0)}, direction{Wide(1), Wide(0)};
    Complex apex = apex_of(h, origin, direction);
    for(std::size_t m = 0; m < strip_.size(); ++m)
    {
      const Index c = path.crossed[m], next = t_.next(h);
      if(c == next)
      {
        const Wide l = metric_.wide_scaled_length(h);
        const Complex at_target = rotation(scaled_triangle(next), 1);
        strip_[m].position = {{Complex{origin.re + l * direction.re, origin.im + l * direction.im}, apex}};
        direction = direction * Complex{at_target.re, -at_target.im};
      }
      else
      {
        strip_[m].position = {{apex, origin}};
        direction = direction * rotation(scaled_triangle(h), 1);
      }
      origin = strip_[m].position[1]; // twin(c) begins here
      h = t_.twin(c);
      apex = apex_of(h, origin, direction);
    }
    target_ = apex;
  }

  Incircle_form<Wide> scaled_triangle(Index h) const
  {
    return Incircle_form<Wide>(metric_.wide_scaled_length(h), metric_.wide_scaled_length(t_.next(h)),
                               metric_.wide_scaled_length(t_.previous(h)));
  }

  Complex apex_of(Index h, const Complex& origin, const Complex& direction) const
  {
    const Complex to_apex = direction * rotation(scaled_triangle(h), 1);
    const Wide l = metric_.wide_scaled_length(t_.previous(h));
    return {origin.re + l * to_apex.re, origin.im + l * to_apex.im};
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
    const Complex &zo = side.position[0], &zt = side.position[1];
    const double size = size_of(target_); // without over- and underflow of squares
    result.ratio = quotient(Complex{(r * zo.re + s * zt.re) / size, (r * zo.im + s * zt.im) / size},
                            Complex{target_.re / size, target_.im / size});
    return result;
  }

  const Metric& metric_;
  const Intrinsic_triangulation<NT>& t_;
  const std::vector<Wide>& weights_;
  std::vector<Side> strip_;
  Wide length_;    // of the geodesic
  Complex target_;
};

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
      weights[v] = (std::max)(Wide(r * r), Wide(1e-280));
    }
  return weights;
}

// A triangle of one of the two triangulations, cut into cells by the edges of the other. How often its sides are crossed tells how the
// arcs between the crossings run (normal_coordinates.h). Around the triangle, counterclockwise, there are its corner 0, the
// crossings of its side 0, its corner 1, and so on: the places 0, 1, 2, ...
class Triangle_cells
{
public:
  // From one place to another: along a side of the triangle, or along an arc inside.
  struct Segment
  {
    std::size_t from, to;
    bool is_on_side;
  };

  // \param crossings by side
  void cut(const std::array<std::size_t, 3>& crossings)
  {
    const std::array<std::size_t, 3>& n = crossings;
    std::array<std::size_t, 3> around;
    std::size_t size = 0;
    for(std::size_t k = 0; k < 3; ++k)
    {
      corner_[k] = size;
      size += 1 + n[k];
    }
    other_end_.assign(size, 0);
    is_done_.assign(size, 0);
    for(std::size_t k = 0; k < 3; ++k) // around the corner k, from side k to the previous one
    {
      const std::size_t previous = (k + 2) % 3, a = n[k], b = n[previous], opposite = n[(k + 1) % 3];
      around[k] = (std::min)({a, b, a + b > opposite ? (a + b - opposite) / 2 : 0});
      for(std::size_t s = 0; s < around[k]; ++s)
      {
        const std::size_t p = corner_[k] + 1 + s, q = corner_[previous] + b - s;
        other_end_[p] = q;
        other_end_[q] = p;
      }
    }
    for(std::size_t k = 0; k < 3; ++k) // from the corner k, across the opposite side
    {
      const std::size_t opposite = (k + 1) % 3, sides = n[k] + n[(k + 2) % 3];
      fan_size_[k] = n[opposite] > sides ? n[opposite] - sides : 0;
      fan_begin_[k] = corner_[opposite] + 1 + around[opposite];
      for(std::size_t s = 0; s < fan_size_[k]; ++s)
        other_end_[fan_begin_[k] + s] = corner_[k];
    }
  }

  // Calls `visit(cell)` for every cell, a vector of segments, counterclockwise. Every cell has a part of a side.
  template <typename Visit>
  void for_each(Visit visit)
  {
    for(std::size_t p = 0; p < is_done_.size(); ++p)
      if(!is_done_[p])
      {
        walk_around_cell(p);
        visit(cell_);
      }
  }

  // The side that the place is on; a corner is on the side that begins there.
  std::size_t side(std::size_t place) const { return place >= corner_[2] ? 2 : place >= corner_[1] ? 1 : 0; }

  // How many places of its side come before it: 0 for a corner, 1 for the first crossing.
  std::size_t position(std::size_t place) const { return place - corner_[side(place)]; }

  bool is_corner(std::size_t place) const { return position(place) == 0; }

private:
  // From the place p along the side of the triangle, then always along the leftmost way.
  void walk_around_cell(std::size_t p)
  {
    cell_.clear();
    const std::size_t begin = p, end = is_done_.size();
    bool is_on_side = true;
    do
    {
      const std::size_t q = is_on_side ? (p + 1) % end : next_place_;
      cell_.push_back({p, q, is_on_side});
      if(is_on_side)
        is_done_[p] = 1;
      is_on_side = !find_next(p, q, is_on_side);
      p = q;
    }
    while(p != begin || !is_on_side);
  }

  // Arrived at q from p: is the next segment an arc, to `next_place_`? Around q, counterclockwise, there are the next place, the
  // ends of its arcs, and the previous place.
  bool find_next(std::size_t p, std::size_t q, bool is_on_side)
  {
    const std::size_t k = side(q);
    if(q != corner_[k])
    {
      next_place_ = other_end_[q];
      return is_on_side;
    }
    if(is_on_side && fan_size_[k] > 0)
    {
      next_place_ = fan_begin_[k] + fan_size_[k] - 1;
      return true;
    }
    if(!is_on_side && p > fan_begin_[k])
    {
      next_place_ = p - 1;
      return true;
    }
    return false;
  }

  std::array<std::size_t, 3> corner_, fan_begin_, fan_size_;
  std::vector<std::size_t> other_end_; // by place
  std::vector<char> is_done_;          // by place: whether the cell on the left of the segment to the next place was visited
  std::vector<Segment> cell_;
  std::size_t next_place_ = 0;
};

// All crossings, and the cells between the edges. Cells are convex polygons in each of the two triangles that they belong to.
template <typename NT>
class Overlay
{
  typedef std::uint32_t Index;
  typedef Conformal_metric<NT> Metric;

public:
  typedef typename Metric::Wide_number Wide;
  typedef Overlay_crossing<Wide> Crossing;

  std::vector<Crossing> crossings; // by current edge, and in the order along its first halfedge

  // Linear in the size of both and the number of crossings. \pre `record` is that of the flips of the metric
  Overlay(const Intrinsic_triangulation<NT>& input, const Metric& metric, const Normal_coordinates& record,
          const std::vector<Wide>& weights)
    : input_(input), t_(metric.triangulation), record_(record)
  {
    first_.reserve(std::size_t(t_.number_of_edges()) + 1);
    first_.push_back(0);
    for(Index e = 0; e < t_.number_of_edges(); ++e)
      first_.push_back(first_.back() + record.crossings(e));
    crossings.resize(first_.back());

    Geodesic_strip<NT> strip(metric, weights);
    const std::vector<Normal_coordinates::Start> starts = record.starts(t_);
    for(Index e = 0; e < input.number_of_edges(); ++e)
    {
      const Normal_coordinates::Path path = record.path(t_, starts[input.edge_halfedge(e)]);
      if(!path.is_edge)
        strip(e, path, [&](std::size_t m, const Crossing& crossing)
              { crossings[number_of_crossing(path.crossed[m], path.strand[m])] = crossing; });
    }
  }

  // Calls `visit(f, corners)` for every cell, where `f` is its current face and `corners` a vector of `Overlay_corner`.
  template <typename Visit>
  void for_each_cell(Visit visit)
  {
    for(Index f = 0; f < t_.number_of_faces(); ++f)
    {
      triangle_.cut({{ record_.crossings(t_.edge(3 * f)), record_.crossings(t_.edge(3 * f + 1)), record_.crossings(t_.edge(3 * f + 2)) }});
      triangle_.for_each([&](const std::vector<Triangle_cells::Segment>& segments)
      {
        cell_.clear();
        for(const Triangle_cells::Segment& segment : segments)
          cell_.push_back(corner(f, segment));
        visit(f, cell_);
      });
    }
  }

private:
  // The crossing of `h` that is number s from its origin.
  std::size_t number_of_crossing(Index h, std::size_t s) const
  {
    const Index e = t_.edge(h);
    return h == t_.edge_halfedge(e) ? first_[e] + s : first_[e + 1] - 1 - s;
  }

  // The same for a place on the border of the triangle f.
  std::size_t crossing_at(Index f, std::size_t place) const
  {
    return number_of_crossing(3 * f + Index(triangle_.side(place)), triangle_.position(place) - 1);
  }

  Overlay_corner corner(Index f, const Triangle_cells::Segment& segment) const
  {
    const Index h = 3 * f + Index(triangle_.side(segment.from));
    Overlay_corner result;
    result.is_crossing = !triangle_.is_corner(segment.from);
    result.index = result.is_crossing ? Index(crossing_at(f, segment.from)) : h;
    if(segment.is_on_side)
      result.input_halfedge = record_.coincides(t_.edge(h)) ? record_.input_halfedge(t_, h) : input_.null_index;
    else if(result.is_crossing)
      result.input_halfedge = input_halfedge(result.index, crossings[result.index].halfedge != h); // into the triangle
    else
    {
      const Index g = 3 * f + Index(triangle_.side(segment.to));
      const std::size_t crossing = crossing_at(f, segment.to);
      result.input_halfedge = input_halfedge(crossing, crossings[crossing].halfedge == g); // out of it
    }
    return result;
  }

  Index input_halfedge(std::size_t crossing, bool is_forward) const
  {
    const Index h = input_.edge_halfedge(crossings[crossing].input_edge);
    return is_forward ? h : input_.twin(h);
  }

  const Intrinsic_triangulation<NT>& input_;
  const Intrinsic_triangulation<NT>& t_;
  const Normal_coordinates& record_;
  std::vector<std::size_t> first_; // by current edge: its first crossing
  Triangle_cells triangle_;        // the triangle at hand
  std::vector<Overlay_corner> cell_;
};

// The input face that a cell is a part of.
template <typename NT>
std::uint32_t input_face_of_cell(const Intrinsic_triangulation<NT>& input, const std::vector<Overlay_corner>& cell)
{
  std::uint32_t result = input.null_index;
  for(const Overlay_corner& corner : cell)
    if(corner.input_halfedge != input.null_index)
      result = input.face(corner.input_halfedge);
  CGAL_assertion(result != input.null_index);
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_OVERLAY_H
