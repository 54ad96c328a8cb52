// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Corners for a rectangle: the choice with the least Dirichlet energy of u
// (Appendix E of Springborn, Schroeder and Pinkall, 2008).
//
// To first order u solves A u = Theta - Theta^ (the Poisson equation (12)), so that moving a corner adds to u the difference of two columns of
// A^-1, and the energy of all choices is one quadratic form in the corners. Its best choice is solved for; the model is made again at the
// metric found, where it is exact for that choice, and names those that promise less: a few solves, instead of one for every exchange.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_RECTANGLE_CORNERS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_RECTANGLE_CORNERS_H

#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/discrete_metric.h>
#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

struct Rectangle_corners : public Outcome
{
  std::array<std::uint32_t, 4> corners{};     // in their order along the border
};

typedef std::array<std::uint32_t, 4> Corner_choice; // positions among the candidates, increasing

// The Dirichlet energy of u, as a function of the corners, for an u that depends on them linearly.
class Corner_energy_model
{
  typedef std::uint32_t Index;

public:
  Corner_energy_model() = default;

  // u is `straight` if there are no corners, and each corner a adds `added[a]`. `surface` has the weights of the energy.
  Corner_energy_model(const Intrinsic_triangulation<double>& surface, const std::vector<double>& weights, const Vertex_vector& straight,
                      const std::vector<Vertex_vector>& added)
    : linear_(added.size()), quadratic_(added.size(), std::vector<double>(added.size()))
  {
    Edge_graph graph;
    graph.set_edges(surface);
    graph.set_free(std::vector<char>(surface.number_of_vertices(), 1));
    const Vertex_vector product = graph.product(weights, straight);
    constant_ = dot(straight, product) / 2;
    for(std::size_t a = 0; a < added.size(); ++a)
    {
      linear_[a] = dot(added[a], product);
      const Vertex_vector product_a = graph.product(weights, added[a]);
      for(std::size_t b = 0; b < added.size(); ++b)
        quadratic_[a][b] = dot(added[b], product_a) / 2;
    }
  }

  double operator()(const Corner_choice& c) const
  {
    double sum = constant_;
    for(const Index a : c)
    {
      sum += linear_[a];
      for(const Index b : c)
        sum += quadratic_[a][b];
    }
    return sum;
  }

private:
  double constant_ = 0;
  std::vector<double> linear_;
  std::vector<std::vector<double> > quadratic_;
};

class Rectangle_corner_selection
{
  typedef std::uint32_t Index;
  typedef Corner_choice Choice;
  typedef Intrinsic_triangulation<double> Triangulation;
  typedef Conformal_metric<double> Metric;

  // Some 10 000 choices of four, all of which a model tries: no time beside one factorization.
  static constexpr std::size_t maximum_number_of_candidates_ = 24;

  // Newton's method takes some ten steps where a choice is good; one that needs more than this is none of the best.
  static constexpr std::size_t maximum_number_of_iterations_ = 40;

  // Energies need a few digits to be compared, residuals in radians no more than these.
  static constexpr double gradient_tolerance_ = 1e-6;

  // A model that promises less than this, relatively, promises nothing: it errs by more.
  static constexpr double least_promise_ = 1e-3;

  // How much is tried, after the first choice. A few solves do, and of the choices that one model names, two: what is wrong with the
  // first is as a rule wrong with those after the second. Where the mesh is so small that solves cost nothing, all is tried that may be better.
  struct Effort
  {
    int trials;
    int trials_of_model;
    double error_of_exchange; // by how much a model may err, relatively, for an exchange of one corner
  };

  Effort effort() const { return t_.number_of_vertices() < 200 ? Effort{200, 200, 0.25} : Effort{5, 2, 0.05}; }

public:
  // `border` are the vertices of the border of the disk `t`, in order; `retriangulation` is that of the map for which the corners are
  Rectangle_corner_selection(const Triangulation& t, const std::vector<Index>& border, Retriangulation retriangulation, const Any_visitor& visitor)
    : t_(t), border_(border), may_flip_(retriangulation != Retriangulation::NEVER), visitor_(visitor), energy_(t, true), solver_(t)
  {
    energy_.evaluate(Vertex_vector(t.number_of_vertices(), 0.));
  }

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
    is_any_free_ = forced.size() > 4 && may_flip_;
    if(forced.size() > 4 && !is_any_free_)
    {
      result.status = Status::ANGLE_OUT_OF_RANGE;
      result.amount = CGAL_PI;
      result.vertices = forced;
      return result;
    }
    visitor_.on_stage(Stage::CORNERS);
    find_candidates();
    const Choice best = best_choice();
    result.status = is_stopped_ ? Status::STOPPED_BY_VISITOR : Status::OK;
    for(int k = 0; k < 4; ++k)
      result.corners[k] = border_[candidates_[best[k]]];
    return result;
  }

private:
  bool is_forced_vertex(Index v) const { return !is_any_free_ && t_.degree(v) == 1; }

  // ---- Candidates

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

  Solver_options quickly() const
  {
    Solver_options result;
    result.retriangulation = may_flip_ ? Retriangulation::WHEN_NEEDED : Retriangulation::NEVER;
    result.number_of_iterations = maximum_number_of_iterations_;
    result.gradient_tolerance = gradient_tolerance_;
    result.is_estimate = true;
    result.visitor = Any_visitor::of(Asking_visitor(visitor_));
    return result;
  }

  // By vertex of its triangulation, which may be that of the double: those of images come after those of the surface.
  static Vertex_vector log_scale_factors(const Metric& metric)
  {
    Vertex_vector result;
    for(const auto& s : metric.scale_factors)
      result.push_back(logarithm_of_factor<double>(s));
    return result;
  }

  // pi - angle sum at the border of the natural map; of the surface itself if there is no such map
  std::vector<double> natural_turning()
  {
    const Metric metric = solver_.solve(Conformal_conditions<double>(t_), quickly());
    const std::vector<double> sums = angle_sums(metric ? apply_log_scale_factors(metric.triangulation, log_scale_factors(metric)) : t_);
    std::vector<double> turning;
    for(Index v : border_)
      turning.push_back(CGAL_PI - sums[v] / (metric && metric.is_doubled ? 2 : 1));
    return turning;
  }

  // ---- Models

  // For the u of first order, at u = 0.
  Corner_energy_model model_at_start() const
  {
    Laplacian_solver linear(make_factorization<Default_solver_traits>());
    Vertex_vector straight(t_.number_of_vertices(), 0.);
    if(!factorize(t_, energy_.weights(), linear))
      return model(straight, std::vector<Vertex_vector>(candidates_.size(), straight));
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      if(linear.graph().is_free(v))
        straight[v] = energy_.angle_sums()[v] - (t_.is_border_vertex(v) ? CGAL_PI : 2 * CGAL_PI);
    Vertex_vector u;
    linear.solve(straight, u);
    return model(u, columns(linear, 1));
  }

  // At the metric found for a choice.
  Corner_energy_model model_at(const Metric& metric, const Choice& choice) const
  {
    const Triangulation& t = metric.triangulation;
    Conformal_energy<double> energy(t, true);
    energy.evaluate(log_scale_factors(metric));
    Laplacian_solver linear(make_factorization<Default_solver_traits>());
    Vertex_vector straight(metric.log_scale_factors);
    if(!factorize(t, energy.weights(), linear))
      return model(straight, std::vector<Vertex_vector>(candidates_.size(), Vertex_vector(straight.size(), 0.)));
    const std::vector<Vertex_vector> added = columns(linear, metric.is_doubled ? 2 : 1);
    for(const Index a : choice)
      for(std::size_t v = 0; v < straight.size(); ++v)
        straight[v] -= added[a][v];
    return model(straight, added);
  }

  // The energy is that of the surface as it is given.
  Corner_energy_model model(const Vertex_vector& straight, const std::vector<Vertex_vector>& added) const
  {
    return Corner_energy_model(t_, energy_.weights(), straight, added);
  }

  // A, with one vertex held, as the energy does not see a constant.
  bool factorize(const Triangulation& t, const std::vector<double>& weights, Laplacian_solver& linear) const
  {
    std::vector<char> free(t.number_of_vertices(), 1);
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      if(t.is_isolated_vertex(v))
        free[v] = 0;
    free[border_[0]] = 0;
    linear.set_edges(t);
    linear.set_free(free);
    return linear.factorize(weights);
  }

  // What each candidate adds to u if it becomes a corner, where its angle is smaller by pi / 2; on a surface of two `halves` in each of them.
  std::vector<Vertex_vector> columns(Laplacian_solver& linear, int halves) const
  {
    std::vector<Vertex_vector> result;
    for(const Index a : candidates_)
    {
      Vertex_vector right(linear.graph().free_index.size(), 0.), x(right);
      if(linear.graph().is_free(border_[a]))
      {
        right[border_[a]] = halves * CGAL_PI / 2;
        linear.solve(right, x);
      }
      x.resize(t_.number_of_vertices());
      result.push_back(std::move(x));
    }
    return result;
  }

  // ---- Choices

  bool contains_forced(const Choice& c) const
  {
    for(Index a = 0; a < candidates_.size(); ++a)
      if(is_forced_vertex(border_[candidates_[a]]) && std::find(c.begin(), c.end(), a) == c.end())
        return false;
    return true;
  }

  // All that are possible, those of the least energy first.
  std::vector<std::pair<double, Choice> > ranked(const Corner_energy_model& energy) const
  {
    const Index m = Index(candidates_.size());
    std::vector<std::pair<double, Choice> > result;
    Choice c;
    for(c[0] = 0; c[0] < m; ++c[0])
      for(c[1] = c[0] + 1; c[1] < m; ++c[1])
        for(c[2] = c[1] + 1; c[2] < m; ++c[2])
          for(c[3] = c[2] + 1; c[3] < m; ++c[3])
            if(contains_forced(c))
              result.emplace_back(energy(c), c);
    std::sort(result.begin(), result.end());
    return result;
  }

  // Metrics are what takes long.
  Metric solve(const Choice& c)
  {
    is_stopped_ = is_stopped_ || !visitor_.go_further();
    if(is_stopped_)
      return Metric();
    Conformal_conditions<double> conditions(t_);
    for(Index v : border_)
      conditions.prescribe_angle_sum(v, Exact_angle<double>::pi_times(1));
    for(Index a : c)
      conditions.prescribe_angle_sum(border_[candidates_[a]], Exact_angle<double>::pi_times(1, 2));
    const Metric result = solver_.solve(conditions, quickly());
    is_stopped_ = result.status == Status::STOPPED_BY_VISITOR;
    visitor_.on_progress(Stage::CORNERS, ++number_of_solves_, energy(result));
    return result;
  }

  // Dirichlet energy of the u of a metric; infinite if there is none.
  double energy(const Metric& metric) const
  {
    if(!metric || metric.log_scale_factors.empty())
      return std::numeric_limits<double>::infinity();
    return dirichlet_energy(t_, metric.log_scale_factors);
  }

  // The best of the choices that are solved for: the best one by the first model, and those that are named after that.
  Choice best_choice()
  {
    std::vector<std::pair<double, Choice> > named = ranked(model_at_start());
    Choice best = named.front().second;
    Metric metric = solve(best);
    double least = energy(metric);
    std::set<Choice> known = {best};
    for(Effort left = effort(); !is_stopped_ && left.trials > 0 && improve(named, known, left, best, metric, least); )
      continue;
    return best;
  }

  // Tries what a model at the best choice so far names; where there is no metric yet, what was `named` before. Then exchanges of one corner, of
  // which a model knows best, even if it promises a little more than there is. Returns whether there is a better choice now.
  bool improve(std::vector<std::pair<double, Choice> >& named, std::set<Choice>& known, Effort& left, Choice& best, Metric& metric, double& least)
  {
    if(metric)
      named = ranked(model_at(metric, best));
    const auto try_those = [&](double most, std::size_t most_exchanged)
    {
      int trials_of_model = left.trials_of_model;
      for(const auto& candidate : named)
      {
        if(is_stopped_ || left.trials == 0 || trials_of_model == 0 || candidate.first >= most)
          return false;
        if(number_of_exchanged(best, candidate.second) > most_exchanged || !known.insert(candidate.second).second)
          continue;
        --left.trials;
        --trials_of_model;
        Metric found = solve(candidate.second);
        const double e = energy(found);
        if(e < least)
        {
          least = e;
          best = candidate.second;
          metric = std::move(found);
          return true;
        }
      }
      return false;
    };
    if(!metric)
      return try_those(least, 4);
    return try_those((1 - least_promise_) * least, 4) || try_those((1 + left.error_of_exchange) * least, 1);
  }

  static std::size_t number_of_exchanged(const Choice& a, const Choice& b)
  {
    std::vector<Index> remaining;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(remaining));
    return a.size() - remaining.size();
  }

  const Triangulation& t_;
  const std::vector<Index>& border_;
  const bool may_flip_;
  bool is_any_free_ = false; // although there are more vertices with a single triangle than corners
  const Any_visitor visitor_;
  bool is_stopped_ = false;
  std::size_t number_of_solves_ = 0;
  std::vector<Index> candidates_;
  Conformal_energy<double> energy_; // of the surface, at u = 0
  Conformal_metric_solver<double> solver_;
};

// `first` is a halfedge on the border of the disk `t`.
inline Rectangle_corners select_rectangle_corners(const Intrinsic_triangulation<double>& t, std::uint32_t first, Retriangulation retriangulation,
                                                  const Any_visitor& visitor)
{
  std::vector<std::uint32_t> border;
  std::uint32_t h = first;
  do
  {
    border.push_back(t.origin(h));
    h = t.next_on_border(h);
  }
  while(h != first);
  return Rectangle_corner_selection(t, border, retriangulation, visitor)();
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_RECTANGLE_CORNERS_H
