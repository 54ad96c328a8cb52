// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What determines the scale of each component of a surface: vertices of fixed u, lower bounds on u of which some must be active, or nothing.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_COMPONENT_SCALES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_COMPONENT_SCALES_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Edge_graph.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Lower_bounds.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// e^{b/2} for the bound b at v
template <typename NT>
typename Wider_number<NT>::type least_factor(const Conformal_conditions<NT>& conditions, std::uint32_t v)
{
  using std::exp;
  typedef typename Wider_number<NT>::type Wide;
  return Wide(exp(Wide(conditions.lower_bound(v)) / 2));
}

// u of s = e^{u/2}
template <typename NT>
NT logarithm_of_factor(const typename Wider_number<NT>::type& s)
{
  using std::log;
  if constexpr(std::is_same<NT, double>::value)
    return 2 * (std::log(s.hi) + s.lo / s.hi);
  else
    return static_cast<NT>(2 * log(s));
}

template <typename NT>
class Component_scales
{
public:
  typedef typename Wider_number<NT>::type Wide_number;

  // Keeps references.
  Component_scales(const Intrinsic_triangulation<NT>& t, const Surface_components& pieces) : t_(t), pieces_(pieces) {}

  // The components without a fixed u where some bounds are active, by number.
  void set_resting(std::vector<char> rests_on_bounds) { rests_on_bounds_ = std::move(rests_on_bounds); }

  // The vertices at which u is unknown. Where a component has no fixed u and no active bound, its first vertex is held,
  // which changes nothing but the scale.
  std::vector<char> free_vertices(const Conformal_conditions<NT>& conditions)
  {
    std::vector<char> free(t_.number_of_vertices(), 0);
    std::vector<char> has_fixed = rests_on_bounds_;
    for(std::uint32_t v = 0; v < t_.number_of_vertices(); ++v)
    {
      if(t_.is_isolated_vertex(v))
        continue;
      free[v] = conditions.is_fixed(v) ? 0 : 1;
      if(conditions.is_fixed(v))
        has_fixed[pieces_.component_of_vertex[v]] = 1;
    }
    for(std::size_t c = 0; c < has_fixed.size(); ++c)
      if(!has_fixed[c])
        free[t_.origin(3 * pieces_.components[c].first_face)] = 0;
    floating_.assign(has_fixed.size(), 0);
    for(std::size_t c = 0; c < has_fixed.size(); ++c)
      floating_[c] = has_fixed[c] ? 0 : 1;
    return free;
  }


  // Those of the components whose scale they determine.
  Lower_bounds lower_bounds(const Conformal_conditions<NT>& conditions) const
  {
    Lower_bounds result;
    if(!conditions.has_bounds())
      return result;
    const std::uint32_t n = t_.number_of_vertices();
    result.bound.assign(n, -std::numeric_limits<double>::infinity());
    result.resting.assign(n, Intrinsic_triangulation<NT>::null_index);
    result.number_of_components = std::uint32_t(pieces_.components.size());
    bool is_empty = true;
    for(std::uint32_t v = 0; v < n; ++v)
    {
      if(t_.is_isolated_vertex(v))
        continue;
      const std::uint32_t c = pieces_.component_of_vertex[v];
      if(rests_on_bounds_[c])
        result.resting[v] = c;
      if(!conditions.is_bounded(v) || floating_[c])
        continue;
      result.bound[v] = static_cast<double>(conditions.lower_bound(v));
      is_empty = false;
    }
    return is_empty ? Lower_bounds() : result;
  }

  // Moves u on every component without a fixed vertex so that its sum is zero.
  void center(Vertex_vector& u) const
  {
    Vertex_vector sum(pieces_.components.size(), 0.);
    for(std::uint32_t v = 0; v < u.size(); ++v)
      if(!t_.is_isolated_vertex(v))
        sum[pieces_.component_of_vertex[v]] += u[v];
    for(std::uint32_t v = 0; v < u.size(); ++v)
    {
      const std::uint32_t c = pieces_.component_of_vertex[v];
      if(!t_.is_isolated_vertex(v) && floating_[c])
        u[v] -= sum[c] / double(pieces_.components[c].number_of_vertices);
    }
  }

  // Scales the components where the bounds determine nothing but the scale: the least that they allow.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  void settle(const Conformal_conditions<NT>& conditions, std::vector<Wide_number>& s) const
  {
    std::vector<Wide_number> factor(pieces_.components.size(), Wide_number(0));
    for(std::uint32_t v = 0; v < s.size(); ++v)
    {
      if(t_.is_isolated_vertex(v) || !conditions.is_bounded(v) || !floating_[pieces_.component_of_vertex[v]])
        continue;
      const Wide_number needed = least_factor<NT>(conditions, v) / s[v];
      Wide_number& largest = factor[pieces_.component_of_vertex[v]];
      if(largest < needed)
        largest = needed;
    }
    for(std::uint32_t v = 0; v < s.size(); ++v)
      if(!t_.is_isolated_vertex(v) && Wide_number(0) < factor[pieces_.component_of_vertex[v]])
        s[v] = s[v] * factor[pieces_.component_of_vertex[v]];
  }

private:
  const Intrinsic_triangulation<NT>& t_;
  const Surface_components& pieces_;
  std::vector<char> rests_on_bounds_; // components without a fixed u where some bounds are active
  std::vector<char> floating_;        // components whose scale nothing determines
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_COMPONENT_SCALES_H
