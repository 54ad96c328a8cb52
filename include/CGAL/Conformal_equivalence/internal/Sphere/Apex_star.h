// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_APEX_STAR_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_APEX_STAR_H

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Delaunay_flipper.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Ideal_polyhedron.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Punctured_surface.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// How far the conditions of the link may be violated before it is changed. Vertices that lie on one circle with the apex, as on every face of a
// solid that has more than three corners, meet their conditions with equality, up to rounding on either side.
struct Link_bounds
{
  double short_of_long; // a link edge is taken in if it is longer than the sum of the other two sides but for this part of it
  double reflex;        // a neighbour is let go if the disk has an angle there that is by this larger than pi
  int most_releases;    // of one vertex
};

// The triangles at the apex of a polyhedron that is being looked for, and the flips that change them: see Ideal_polyhedron_finder.h.
template <typename NT>
class Apex_star
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;
  typedef Conformal_metric<NT> Metric;

public:
  // Flips the triangulation of `polyhedron`, and writes the flips down there.
  explicit Apex_star(Ideal_polyhedron<NT>& polyhedron)
    : triangulation_(polyhedron.triangulation), flips_(polyhedron.flips), releases_(polyhedron.number_of_releases), apex_(polyhedron.apex)
  {
    releases_.resize(triangulation_.number_of_vertices(), 0);
  }

  // Makes the triangles ready for what follows: there is one edge from the apex to each of at least three neighbours, where that is possible.
  void prepare()
  {
    tidy();
    widen();
  }

  // Flips of the rest of the surface, as the solver has made them, and the lengths that they have led to.
  void repeat_flips(const Punctured_surface<NT>& rest, const Metric& metric)
  {
    for(Index e : metric.flips)
      flip(rest.original_edge[e]);
    for(Index e = 0; e < rest.original_edge.size(); ++e)
      triangulation_.set_length(rest.original_edge[e], metric.triangulation.length(e));
  }

  // Flips link edges that are too long, and edges of the apex to reflex angles, where no triangle of them has changed before. Returns whether there
  // was anything to do.
  bool exchange(const Punctured_surface<NT>& rest, const Metric& metric, const Link_bounds& bounds)
  {
    std::vector<char> is_touched(metric.triangulation.number_of_vertices(), 0);
    const bool is_wider = take_in_long_edges(rest, metric, bounds, is_touched);
    const bool is_narrower = let_go_reflex_neighbours(metric, bounds, is_touched);
    return is_wider || is_narrower;
  }

private:
  void flip(Index e)
  {
    triangulation_.flip_edge(e, ptolemy_length(triangulation_, e));
    flips_.push_back(e);
  }

  // Flips loops of the apex, and of several edges to the same vertex all but the shortest: these are inactive for certain.
  void tidy()
  {
    // A flip takes an edge from the apex, and hardly ever gives it another one. The bound rules out that this goes on for ever where it does.
    const std::size_t most_flips = 10 * std::size_t(triangulation_.number_of_edges());
    for(std::size_t flips = 0; flips < most_flips; ++flips)
    {
      const Index e = edge_to_tidy();
      if(e == triangulation_.null_index)
        return;
      flip(e);
    }
  }

  Index edge_to_tidy() const
  {
    const Triangulation& t = triangulation_;
    std::vector<std::pair<Index, Index> > ends; // of flippable edges: the vertex, and the edge
    Index loop = t.null_index;
    t.for_each_outgoing(apex_, [&](Index h)
    {
      if(t.target(h) == apex_ && t.is_flippable(t.edge(h)))
        loop = t.edge(h);
      else
        ends.emplace_back(t.target(h), t.edge(h));
    });
    if(loop != t.null_index)
      return loop;
    std::sort(ends.begin(), ends.end(), [&](const auto& a, const auto& b)
      { return a.first != b.first ? a.first < b.first : t.length(a.second) < t.length(b.second); });
    for(std::size_t i = 1; i < ends.size(); ++i)
      if(ends[i].first == ends[i - 1].first && t.is_flippable(ends[i].second))
        return ends[i].second;
    return t.null_index;
  }

  // An apex needs three neighbours. Where it has less, triangles beyond its link are added to its star, the shortest new edges first.
  void widen()
  {
    for(Index e = 0; e != Triangulation::null_index && triangulation_.degree(apex_) < 3; )
    {
      e = edge_to_widen();
      if(e != Triangulation::null_index)
        flip(e);
    }
  }

  Index edge_to_widen() const
  {
    const Triangulation& t = triangulation_;
    std::vector<Index> neighbours(1, apex_), link;
    t.for_each_outgoing(apex_, [&](Index h)
    {
      neighbours.push_back(t.target(h));
      link.push_back(t.next(h));
    });
    Index best = t.null_index;
    for(Index h : link)
    {
      const Index e = t.edge(h);
      if(t.is_flippable(e) && std::find(neighbours.begin(), neighbours.end(), t.apex(t.twin(h))) == neighbours.end()
         && (best == t.null_index || ptolemy_length(t, e) < ptolemy_length(t, best)))
        best = e;
    }
    return best;
  }

  // Link edges jk with a triangle jkm in which they are longer than the other two sides become edges pm.
  bool take_in_long_edges(const Punctured_surface<NT>& rest, const Metric& metric, const Link_bounds& bounds, std::vector<char>& is_touched)
  {
    const double rounding_at_neighbour = 1e-14; // a second edge to a neighbour would be flipped away again: there rounding is not to decide
    const Triangulation& disk = metric.triangulation;
    const std::vector<char> is_neighbour = neighbours(disk.number_of_vertices());
    bool is_changed = false;
    for(Index e = 0; e < disk.number_of_edges(); ++e)
    {
      const Index h = disk.edge_halfedge(e);
      const double tolerance = is_neighbour[disk.apex(h)] ? rounding_at_neighbour : -bounds.short_of_long;
      if(!disk.is_border(h) || !triangulation_.is_flippable(rest.original_edge[e]) || !is_too_long(metric, h, tolerance))
        continue;
      flip(rest.original_edge[e]);
      is_touched[disk.origin(h)] = is_touched[disk.target(h)] = 1;
      is_changed = true;
    }
    return is_changed;
  }

  std::vector<char> neighbours(Index number_of_vertices) const
  {
    std::vector<char> result(number_of_vertices, 0);
    triangulation_.for_each_outgoing(apex_, [&](Index h)
    {
      result[triangulation_.target(h)] = result[triangulation_.apex(h)] = 1;
    });
    return result;
  }

  static bool is_too_long(const Metric& metric, Index h, double tolerance)
  {
    const Triangulation& t = metric.triangulation;
    return metric.wide_scaled_length(t.next(h)) + metric.wide_scaled_length(t.previous(h)) < (1 - tolerance) * metric.wide_scaled_length(h);
  }

  // Edges pi where the disk has an angle above pi at i are flipped away.
  bool let_go_reflex_neighbours(const Metric& metric, const Link_bounds& bounds, std::vector<char>& is_touched)
  {
    const Triangulation& t = triangulation_;
    std::vector<Index> spokes;
    t.for_each_outgoing(apex_, [&](Index h) { spokes.push_back(t.edge(h)); });
    bool is_changed = false;
    for(Index e : spokes)
    {
      const Index h = t.origin(t.edge_halfedge(e)) == apex_ ? t.edge_halfedge(e) : t.twin(t.edge_halfedge(e));
      if(h == t.null_index || !t.is_flippable(e))
        continue;
      const Index i = t.target(h), j = t.apex(h), k = t.apex(t.twin(h));
      if(metric.triangulation.is_isolated_vertex(i) || is_touched[i] || is_touched[j] || is_touched[k]
         || releases_[i] >= bounds.most_releases || !(angle_sum_at(metric, i) > Number_constants<double>::pi() + bounds.reflex))
        continue;
      flip(e);
      ++releases_[i];
      is_touched[i] = is_touched[j] = is_touched[k] = 1;
      is_changed = true;
    }
    return is_changed;
  }

  Triangulation& triangulation_;
  std::vector<Index>& flips_;
  std::vector<int>& releases_; // by vertex
  const Index apex_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_APEX_STAR_H
