// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Lower bounds on u, as for the map to the sphere (section 4.3 of Springborn, Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_LOWER_BOUNDS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_LOWER_BOUNDS_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Edge_graph.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The bounds u >= b. In what rests on its bounds, nothing else keeps u from going down to minus infinity,
// where E decreases steadily; so at least one bound is active there.
struct Lower_bounds
{
  typedef std::uint32_t Index;
  Vertex_vector bound;               // by vertex, minus infinity where there is none; empty if there is none at all
  std::vector<Index> resting;        // by vertex: the component if that rests on its bounds, else null_index
  Index number_of_components = 0;

  bool empty() const { return bound.empty(); }
  bool has(Index v) const { return bound[v] > -std::numeric_limits<double>::infinity(); }
  bool is_resting(Index v) const { return resting[v] != Intrinsic_triangulation<>::null_index; }

  // Moves every component that rests on its bounds down or up to them. Returns whether anything was moved.
  bool settle(Vertex_vector& u) const
  {
    const double infinity = std::numeric_limits<double>::infinity();
    Vertex_vector rise(number_of_components, -infinity);
    for(Index v = 0; v < u.size(); ++v)
      if(is_resting(v))
        rise[resting[v]] = (std::max)(rise[resting[v]], bound[v] - u[v]);
    bool is_moved = false;
    for(Index v = 0; v < u.size(); ++v)
      if(is_resting(v) && rise[resting[v]] != 0 && std::isfinite(rise[resting[v]]))
      {
        const double moved = u[v] + rise[resting[v]];
        const double rounding = 4 * std::numeric_limits<double>::epsilon() * (std::abs(u[v]) + std::abs(moved));
        u[v] = moved - bound[v] <= rounding ? bound[v] : moved;
        is_moved = true;
      }
    return is_moved;
  }

  // Of every component that rests on its bounds, the bounded vertex with the largest value.
  template <typename Value>
  std::vector<Index> largest(Value value) const
  {
    const Index none = Intrinsic_triangulation<>::null_index;
    std::vector<Index> result(number_of_components, none);
    for(Index v = 0; v < bound.size(); ++v)
      if(is_resting(v) && has(v) && (result[resting[v]] == none || value(v) > value(result[resting[v]])))
        result[resting[v]] = v;
    result.erase(std::remove(result.begin(), result.end(), none), result.end());
    return result;
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_LOWER_BOUNDS_H
