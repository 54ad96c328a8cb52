// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Corners for a rectangle: the choice with the least Dirichlet energy of u
// (Appendix E of Springborn, Schroeder and Pinkall, 2008).
//
// To first order u solves A u = Theta - Theta^ (the Poisson equation (12)), and
// its energy is u.A u / 2. Moving a corner changes the right-hand side at two
// vertices: one back-solve for each candidate gives the energies of all choices.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_RECTANGLE_CORNERS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_RECTANGLE_CORNERS_H

#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/discrete_metric.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

struct Rectangle_corners : public Outcome
{
  std::array<std::uint32_t, 4> corners{};     // in their order along the border
};

class Rectangle_corner_selection
{
  typedef std::uint32_t Index;
  typedef std::array<Index, 4> Choice; // positions in `candidates_`, increasing

  // Some 10 000 choices of four, all of which the linearized problem tries: no time beside one factorization.
  static constexpr std::size_t maximum_number_of_candidates_ = 24;

  // Newton's method takes some ten steps where a choice is good; one that needs more than this is none of the best.
  static constexpr unsigned int maximum_number_of_iterations_ = 30;

  // Energies need a few digits to be compared, residuals in radians no more than these.
  static constexpr double gradient_tolerance_ = 1e-8;

  // By how much the linearized energy may call an exchange worse and it is tried nevertheless: a quarter.
  static constexpr double hopeful_ratio_ = 1.25;

  // What improves the energy by less, relatively, is the error of the solution.
  static constexpr double least_improvement_ = 1e-9;

public:
  // `border` are the vertices of the border of the disk `t`, in order; `retriangulation` is that of the map for which the corners are
  Rectangle_corner_selection(const Intrinsic_triangulation<double>& t, const std::vector<Index>& border, Retriangulation retriangulation)
    : t_(t), border_(border), retriangulation_(retriangulation), solver_(t)
  {}

  Rectangle_corners operator()()
  {
    Rectangle_corners result;
    result.status = Status::MISSING_CONDITION;
    if(border_.size() < 4)
      return result;
    std::vector<Index> forced;
    for(Index v : border_)
      if(t_.degree(v) == 1)
        forced.push_back(v);
    // Where border edges are flipped on the double, a vertex with a single triangle may be straight. That takes longer, so that it is not done where
    // there is no need.
    is_any_free_ = forced.size() > 4 && retriangulation_ != Retriangulation::NEVER;
    if(forced.size() > 4 && !is_any_free_)
    {
      result.status = Status::ANGLE_OUT_OF_RANGE;
      result.amount = CGAL_PI;
      result.vertices = forced;
      return result;
    }
    find_candidates();
    prepare_linear_energy();
    Choice best = best_linear_choice();
    improve(best);
    result.status = Status::OK;
    for(int k = 0; k < 4; ++k)
      result.corners[k] = border_[candidates_[best[k]]];
    return result;
  }

private:
  bool is_forced_vertex(Index v) const { return !is_any_free_ && t_.degree(v) == 1; }
  bool is_forced(Index candidate) const { return is_forced_vertex(border_[candidates_[candidate]]); }

  // The border vertices (as positions in `border_`) where the natural map turns most: its local
  // maxima first, at most `most_candidates` of them; all forced ones.
  void find_candidates()
  {
    const std::size_t most_candidates = (std::min)(maximum_number_of_candidates_, border_.size());
    const std::vector<double> turning = natural_turning();
    const std::size_t n = border_.size();
    const auto rank = [&](Index i)
    {
      if(is_forced_vertex(border_[i]))
        return 2;
      return turning[i] >= turning[(i + 1) % n] && turning[i] >= turning[(i + n - 1) % n] ? 1 : 0;
    };
    std::vector<Index> order(n);
    for(Index i = 0; i < n; ++i)
      order[i] = i;
    std::sort(order.begin(), order.end(), [&](Index a, Index b)
    {
      if(rank(a) != rank(b))
        return rank(a) > rank(b);
      return turning[a] != turning[b] ? turning[a] > turning[b] : a < b;
    });
    candidates_.assign(order.begin(), order.begin() + most_candidates);
    std::sort(candidates_.begin(), candidates_.end());
  }

  // There are many maps to compare. What is not found soon, or not on this triangulation if there may be one on it, is none of the best.
  Solver_options quickly() const
  {
    Solver_options result;
    result.retriangulation = is_any_free_ ? retriangulation_ : Retriangulation::NEVER;
    result.number_of_iterations = maximum_number_of_iterations_;
    return result;
  }

  // pi - angle sum at the border of the natural map; of the surface itself if there is no such map
  std::vector<double> natural_turning() const
  {
    const Conformal_metric<double> metric = Conformal_metric_solver<double>(t_).solve(Conformal_conditions<double>(t_), quickly());
    const std::vector<double> sums = angle_sums(metric ? apply_log_scale_factors(t_, metric.log_scale_factors) : t_);
    std::vector<double> turning;
    for(Index v : border_)
      turning.push_back(CGAL_PI - sums[v]);
    return turning;
  }

  // G[a][b] = e_a . A^-1 e_b and g[a] = e_a . A^-1 b for the straight border b, on the
  // graph with one vertex held
  void prepare_linear_energy()
  {
    Conformal_energy<double> energy(t_, true);
    energy.evaluate(Vertex_vector(t_.number_of_vertices(), 0.));
    Laplacian_solver linear(make_factorization<Default_solver_traits>());
    linear.set_edges(t_);
    std::vector<char> free(t_.number_of_vertices(), 1);
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      if(t_.is_isolated_vertex(v))
        free[v] = 0;
    free[border_[0]] = 0;
    linear.set_free(free);
    const std::size_t m = candidates_.size();
    g_.assign(m, 0.);
    G_.assign(m, std::vector<double>(m, 0.));
    if(!linear.factorize(energy.weights()))
      return;

    Vertex_vector straight(t_.number_of_vertices(), 0.), x;
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      if(free[v])
        straight[v] = energy.angle_sums()[v] - (t_.is_border_vertex(v) ? CGAL_PI : 2 * CGAL_PI);
    linear.solve(straight, x);
    straight_energy_ = dot(straight, x);
    for(std::size_t a = 0; a < m; ++a)
      g_[a] = x[border_[candidates_[a]]];
    for(std::size_t b = 0; b < m; ++b)
    {
      Vertex_vector unit(t_.number_of_vertices(), 0.);
      if(free[border_[candidates_[b]]])
        unit[border_[candidates_[b]]] = 1;
      linear.solve(unit, x);
      for(std::size_t a = 0; a < m; ++a)
        G_[a][b] = x[border_[candidates_[a]]];
    }
  }

  // of the linearized u for the right-hand side straight + pi/2 sum e_a
  double linear_energy(const Choice& c) const
  {
    double sum = straight_energy_;
    for(Index a : c)
    {
      sum += CGAL_PI * g_[a];
      for(Index b : c)
        sum += CGAL_PI * CGAL_PI / 4 * G_[a][b];
    }
    return sum;
  }

  bool contains_forced(const Choice& c) const
  {
    for(Index a = 0; a < candidates_.size(); ++a)
      if(is_forced(a) && std::find(c.begin(), c.end(), a) == c.end())
        return false;
    return true;
  }

  Choice best_linear_choice() const
  {
    const Index m = Index(candidates_.size());
    Choice best{{0, 1, 2, 3}};
    double least = std::numeric_limits<double>::infinity();
    Choice c;
    for(c[0] = 0; c[0] < m; ++c[0])
      for(c[1] = c[0] + 1; c[1] < m; ++c[1])
        for(c[2] = c[1] + 1; c[2] < m; ++c[2])
          for(c[3] = c[2] + 1; c[3] < m; ++c[3])
          {
            const double e = contains_forced(c) ? linear_energy(c) : std::numeric_limits<double>::infinity();
            if(e < least)
            {
              least = e;
              best = c;
            }
          }
    return best;
  }

  // Dirichlet energy of the u that solves; infinite if there is none.
  double energy(const Choice& c)
  {
    Conformal_conditions<double> conditions(t_);
    for(Index v : border_)
      conditions.prescribe_angle_sum(v, Exact_angle<double>::pi_times(1));
    for(Index a : c)
      conditions.prescribe_angle_sum(border_[candidates_[a]], Exact_angle<double>::pi_times(1, 2));
    Solver_options options = quickly();
    options.gradient_tolerance = gradient_tolerance_;
    const Conformal_metric<double> metric = solver_.solve(conditions, options);
    return metric ? dirichlet_energy(t_, metric.log_scale_factors) : std::numeric_limits<double>::infinity();
  }

  // Exchanges single corners as long as that improves. An exchange is tried if the
  // linearized energy calls it at most a quarter worse than the present choice.
  void improve(Choice& best)
  {
    double least = energy(best);
    for(bool improved = true; improved; )
    {
      improved = false;
      std::vector<std::pair<double, Choice> > moves;
      for(int k = 0; k < 4; ++k)
        for(Index a = 0; a < candidates_.size(); ++a)
        {
          Choice c = best;
          if(is_forced(c[k]) || std::find(c.begin(), c.end(), a) != c.end())
            continue;
          c[k] = a;
          std::sort(c.begin(), c.end());
          if(linear_energy(c) < hopeful_ratio_ * linear_energy(best))
            moves.emplace_back(linear_energy(c), c);
        }
      std::sort(moves.begin(), moves.end());
      for(const auto& move : moves)
      {
        const double e = energy(move.second);
        if(e < least * (1 - least_improvement_))
        {
          least = e;
          best = move.second;
          improved = true;
          break;
        }
      }
    }
  }

  const Intrinsic_triangulation<double>& t_;
  const std::vector<Index>& border_;
  const Retriangulation retriangulation_;
  bool is_any_free_ = false; // although there are more vertices with a single triangle than corners
  std::vector<Index> candidates_;
  double straight_energy_ = 0;
  std::vector<double> g_;
  std::vector<std::vector<double> > G_;
  Conformal_metric_solver<double> solver_;
};

// `first` is a halfedge on the border of the disk `t`.
inline Rectangle_corners select_rectangle_corners(const Intrinsic_triangulation<double>& t, std::uint32_t first, Retriangulation retriangulation)
{
  std::vector<std::uint32_t> border;
  std::uint32_t h = first;
  do
  {
    border.push_back(t.origin(h));
    h = t.next_on_border(h);
  }
  while(h != first);
  return Rectangle_corner_selection(t, border, retriangulation)();
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_RECTANGLE_CORNERS_H
