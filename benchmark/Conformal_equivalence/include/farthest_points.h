// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Cones for closed surfaces: vertices that are far from each other, in such number that
// their angles fit.

#ifndef CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_FARTHEST_POINTS_H
#define CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_FARTHEST_POINTS_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace benchmarks {

// Vertices, each as far as can be from those before it. Distances are along edges.
class Farthest_points
{
  typedef CGAL::Conformal_equivalence::Intrinsic_triangulation<double> Triangulation;
  typedef std::uint32_t Index;
  typedef std::pair<double, Index> Reached;

  const Triangulation& t_;
  std::vector<double> distance_; // by vertex, from the nearest of the vertices so far

public:
  explicit Farthest_points(const Triangulation& t)
    : t_(t), distance_(t.number_of_vertices(), (std::numeric_limits<double>::max)())
  {}

  // Dijkstra's algorithm, as far as `v` is nearer than what there was.
  void add(Index v)
  {
    std::priority_queue<Reached, std::vector<Reached>, std::greater<Reached> > queue;
    const auto reach = [&](Index w, double d)
    {
      if(d >= distance_[w])
        return;
      distance_[w] = d;
      queue.emplace(d, w);
    };
    reach(v, 0);
    while(!queue.empty())
    {
      const Reached nearest = queue.top();
      queue.pop();
      if(nearest.first > distance_[nearest.second])
        continue;
      t_.for_each_outgoing(nearest.second, [&](Index h)
      {
        reach(t_.target(h), nearest.first + t_.halfedge_length(h));
        reach(t_.apex(h), nearest.first + t_.halfedge_length(t_.previous(h)));
      });
    }
  }

  // Whether `v` is connected with one of the vertices so far.
  bool is_reached(Index v) const { return distance_[v] < (std::numeric_limits<double>::max)(); }

  // The farthest vertex that is admissible and not chosen yet, the first one of several;
  // `null_index` if there is none.
  template <typename Is_admissible>
  Index farthest(Is_admissible is_admissible) const
  {
    Index result = Triangulation::null_index;
    for(Index v = 0; v < distance_.size(); ++v)
      if(distance_[v] > 0 && (result == Triangulation::null_index || distance_[v] > distance_[result]) && is_admissible(v))
        result = v;
    return result;
  }
};

// At most n admissible vertices of the component of `start`: the first is the farthest from
// `start`, each of the others from all before it. `is_admissible` decides on vertices.
template <typename Is_admissible>
std::vector<std::uint32_t> farthest_points(const CGAL::Conformal_equivalence::Intrinsic_triangulation<double>& t,
                                           std::size_t n, std::uint32_t start, Is_admissible is_admissible)
{
  typedef std::uint32_t Index;
  Farthest_points from_start(t), points(t);
  from_start.add(start);
  const auto is_candidate = [&](Index v) { return from_start.is_reached(v) && is_admissible(v); };
  std::vector<Index> result;
  for(Index v = from_start.farthest(is_candidate); result.size() < n && v != t.null_index; v = points.farthest(is_candidate))
  {
    result.push_back(v);
    points.add(v);
  }
  return result;
}

} // namespace benchmarks

#endif // CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_FARTHEST_POINTS_H
