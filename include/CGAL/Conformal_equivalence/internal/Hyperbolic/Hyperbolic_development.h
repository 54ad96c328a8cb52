// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A hyperbolic surface with cones or borders in the hyperbolic plane, face by face.
//
// Every face has a *placement*: lifts of its three corners. Of every halfedge h one knows the motion D(h) that takes the placement of the face beyond
// h to where it shares the side with that of the face of h. Around a vertex the product of these is the identity, or, at a cone, a rotation about
// it by the angle of the cone. All of that outlives flips: for the edge of h, the face beyond it is moved by D(h), the quadrilateral gets its
// other diagonal. So flips are taken back, and the faces of the triangulation given are joined to a disk; where that is cut open one must not
// turn around a cone.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_DEVELOPMENT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_DEVELOPMENT_H

#include <CGAL/Conformal_equivalence/Hyperbolic_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Hyperbolic_layout.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/Isometry.h>
#include <CGAL/Conformal_equivalence/internal/Hyperbolic/hyperbolic_triangle.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Complex_number.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename NT>
class Hyperbolic_development
{
public:
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;
  typedef typename Hyperbolic_metric<NT>::Wide_number Wide;
  typedef Isometry<Wide> Motion;
  typedef Complex_number<Wide> Complex;

  std::vector<Complex> corner;   // by halfedge of the triangulation given: where its origin lies in the domain
  std::vector<char> is_seam;     // by edge of it: whether it has two places there
  std::vector<Motion> side_pairings; // one for each path of seams between vertices where the number of seams is not 2, and cones
  double closing_error = 0;      // how far the products around vertices are from what they are to be

  // `half_angle_cosine` by vertex: of half the prescribed angle at cones; above 1 where none is. \pre the surface is connected
  Hyperbolic_development(const Hyperbolic_metric<NT>& metric, const std::vector<char>& is_cone, const std::vector<Wide>& half_angle_cosine)
    : t_(metric.triangulation), is_cone_(is_cone), frame_(t_.number_of_halfedges(), Motion::identity()),
      beyond_(t_.number_of_halfedges(), Motion::identity())
  {
    place_faces(metric);
    for(std::size_t n = metric.flips.size(); n > 0; --n)
      for(int quarter = 0; quarter < 3; ++quarter) // four flips are none
        flip(metric.flips[n - 1]);
    measure(half_angle_cosine);
    join_faces();
    find_seams();
    find_side_pairings();
  }

  // The triangulation given.
  const Triangulation& triangulation() const { return t_; }

private:
  static Motion half_turn() { return Motion::rotation(Complex{Wide(0), Wide(1)}); }

  // From face to face, those next whose corners come closest to the center. The frame of a corner looks along its halfedge.
  void place_faces(const Hyperbolic_metric<NT>& metric)
  {
    const std::vector<Complex> half_corner = half_corners(metric.triangulation, metric.scale_factors);
    const auto along = [&](Index h)
    {
      const Wide x = metric.wide_half_sinh(h);
      return Motion::translation(x, hyperbolic_cosine(x));
    };
    visit_faces([&](Index h, Index g)
    {
      if(h != t_.null_index)
        frame_[g] = frame_[h] * along(h) * half_turn();
      for(Index k = g, next = t_.next(g); next != g; k = next, next = t_.next(next))
        frame_[next] = frame_[k] * along(k) * Motion::rotation(Complex{Wide(0), Wide(1)} * conj(half_corner[next]));
      return distance(frame_[g]);
    });
    for(Index h = 0; h < t_.number_of_halfedges(); ++h)
    {
      const Index g = t_.twin(h);
      if(g != t_.null_index && !is_crossed_[t_.edge(h)])
        beyond_[h] = frame_[h] * (frame_[g] * along(g) * half_turn()).inverse();
    }
  }

  // |b| is the hyperbolic sine of half the distance from the center.
  static double distance(const Motion& m) { return size_of(m.b); }

  // All faces, from the first one on, across edges, which are marked; `enter(h, g)` enters the face of g from that of h, its twin, and returns its
  // distance.
  template <typename Enter>
  void visit_faces(const Enter& enter)
  {
    typedef std::pair<double, Index> Entry; // distance of the face before it, and its side
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry> > queue;
    std::vector<char> is_entered(t_.number_of_faces(), 0);
    is_crossed_.assign(t_.number_of_edges(), 0);
    const auto go_on_from = [&](Index h, Index g)
    {
      is_entered[t_.face(g)] = 1;
      const double d = enter(h, g);
      for(Index k = 3 * t_.face(g); k < 3 * t_.face(g) + 3; ++k)
        if(!t_.is_border(k) && !is_entered[t_.face(t_.twin(k))])
          queue.emplace(d, k);
    };
    go_on_from(t_.null_index, 0);
    while(!queue.empty())
    {
      const Index h = queue.top().second, g = t_.twin(h);
      queue.pop();
      if(is_entered[t_.face(g)])
        continue;
      is_crossed_[t_.edge(h)] = 1;
      go_on_from(h, g);
    }
  }

  // Moves the placement of the face of g by D(twin(g)).
  void move_beside(Index g)
  {
    const Motion motion = beyond_[t_.twin(g)], back = motion.inverse();
    for(Index h = 3 * t_.face(g); h < 3 * t_.face(g) + 3; ++h)
    {
      frame_[h] = motion * frame_[h];
      beyond_[h] = motion * beyond_[h];
    }
    for(Index h = 3 * t_.face(g); h < 3 * t_.face(g) + 3; ++h)
      if(!t_.is_border(h))
        beyond_[t_.twin(h)] = beyond_[t_.twin(h)] * back;
  }

  void flip(Index e)
  {
    const Index h = t_.edge_halfedge(e), g = t_.twin(h), next_h = t_.next(h), previous_h = t_.previous(h), next_g = t_.next(g),
                previous_g = t_.previous(g);
    if(distance(beyond_[h]) > 0 || beyond_[h].a.im != 0)
      move_beside(g);
    beyond_[h] = beyond_[g] = Motion::identity();
    // what was next(h), previous(h), next(g), previous(g) becomes previous(g), next(h), previous(h), next(g)
    const Motion of_next_h = beyond_[next_h];
    beyond_[next_h] = beyond_[previous_h];
    beyond_[previous_h] = beyond_[next_g];
    beyond_[next_g] = beyond_[previous_g];
    beyond_[previous_g] = of_next_h;
    const Motion i = frame_[h], j = frame_[g], k = frame_[previous_h], l = frame_[previous_g];
    frame_[h] = frame_[next_g] = l;
    frame_[g] = frame_[next_h] = k;
    frame_[previous_h] = i;
    frame_[previous_g] = j;
    t_.flip_edge(e, t_.length(e));
  }

  // Around every vertex inside, seen from there.
  void measure(const std::vector<Wide>& half_angle_cosine)
  {
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
    {
      if(t_.is_isolated_vertex(v) || t_.is_border_vertex(v))
        continue;
      Motion turn = Motion::identity();
      Index h = t_.vertex_halfedge(v);
      const Motion frame = frame_[h];
      do // clockwise: across h, to the face where twin(h) ends at v
      {
        turn = turn * beyond_[h];
        h = t_.next(t_.twin(h));
      }
      while(h != t_.vertex_halfedge(v));
      turn = frame.inverse() * turn * frame;
      double error = is_cone_[v] ? size_of(turn.b) : turn.distance_from_identity();
      if(is_cone_[v] && half_angle_cosine[v] <= 1)
        error = (std::max)(error, (std::min)(std::abs(static_cast<double>(Wide(turn.a.re - half_angle_cosine[v]))),
                                             std::abs(static_cast<double>(Wide(turn.a.re + half_angle_cosine[v])))));
      closing_error = (std::max)(closing_error, error);
    }
  }

  void join_faces()
  {
    motion_.assign(t_.number_of_faces(), Motion::identity());
    visit_faces([&](Index h, Index g)
    {
      const Index f = t_.face(g);
      if(h != t_.null_index)
        motion_[f] = motion_[t_.face(h)] * beyond_[h];
      double result = 0;
      for(Index k = 3 * f; k < 3 * f + 3; ++k)
        result = (std::max)(result, distance(motion_[f] * frame_[k]));
      return result;
    });
    for(Index h = 0; h < t_.number_of_halfedges(); ++h)
      corner.push_back((motion_[t_.face(h)] * frame_[h]).center());
  }

  // The edges that were not crossed, but for those of paths that end at a vertex inside that is no cone.
  void find_seams()
  {
    is_seam.assign(t_.number_of_edges(), 0);
    degree_.assign(t_.number_of_vertices(), 0);
    for(Index e = 0; e < t_.number_of_edges(); ++e)
      if(!is_crossed_[e] && !t_.is_border_edge(e))
      {
        is_seam[e] = 1;
        ++degree_[t_.origin(t_.edge_halfedge(e))];
        ++degree_[t_.target(t_.edge_halfedge(e))];
      }
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      for(Index w = v; degree_[w] == 1 && !is_cone_[w] && !t_.is_border_vertex(w); )
      {
        Index last = t_.null_index;
        t_.for_each_outgoing(w, [&](Index h) { last = is_seam[t_.edge(h)] ? h : last; });
        is_seam[t_.edge(last)] = 0;
        --degree_[w];
        w = t_.target(last);
        --degree_[w];
      }
  }

  // Does a path of seams end at v?
  bool is_node(Index v) const { return degree_[v] != 2 || is_cone_[v] || t_.is_border_vertex(v); }

  // Along a path all edges are glued by the same motion.
  void find_side_pairings()
  {
    std::vector<char> is_done(t_.number_of_edges(), 0);
    for(Index first = 0; first < t_.number_of_halfedges(); ++first)
    {
      if(!is_seam[t_.edge(first)] || is_done[t_.edge(first)] || !is_node(t_.origin(first)))
        continue;
      side_pairings.push_back(motion_[t_.face(first)] * beyond_[first] * motion_[t_.face(t_.twin(first))].inverse());
      for(Index h = first; ; )
      {
        is_done[t_.edge(h)] = 1;
        const Index v = t_.target(h), from = t_.edge(h);
        if(is_node(v))
          break;
        t_.for_each_outgoing(v, [&](Index g) { h = is_seam[t_.edge(g)] && t_.edge(g) != from ? g : h; });
      }
    }
  }

  Triangulation t_;
  const std::vector<char>& is_cone_; // by vertex
  std::vector<Motion> frame_;        // by halfedge: takes the center to the place of its origin
  std::vector<Motion> beyond_;       // by halfedge: D
  std::vector<Motion> motion_;       // by face: from its placement to the domain
  std::vector<char> is_crossed_;     // by edge, on the last visit
  std::vector<std::size_t> degree_;  // by vertex: how many seams end there
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_DEVELOPMENT_H
