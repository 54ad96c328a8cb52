// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Where to put cones (section 5.1 of Springborn, Schroeder and Pinkall, 2008).
//
// All placements share one factor of the Hessian, that of the first metric. A free cone at c is a force at c, of the unknown
// strength x_c, that brings u_c to 0: with the response G_c = A^{-1} e_c of u to a unit force at c,
//
//     u + d,   d = A^{-1} r + sum of the x_c G_c,   (u + d)_c = 0 at all cones,
//
// is a Newton step for the residual r: one solution with the factor, and a dense system with as many unknowns as there are cones. On a
// closed surface A has the constants for its kernel: one vertex is grounded, the constant is one more unknown, and forces and residuals sum up to
// zero. With the same factor all the time the steps converge linearly, which does where cones are only compared.
//
// Responses are kept, so that what becomes of u if cones are put, taken out or moved costs nothing, to first order, but the response of a new place.
// Where a cone is best moved to is found without even these: G is symmetric, so the responses of the few vertices at which |u| is large
// tell what becomes of u there, wherever the cone is put (Cone_excursion). Only what looks best is computed, and what |u| was overlooked is looked at
// from then on: constraints are generated as they are violated.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_SEARCH_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_SEARCH_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Cone_excursion.h>
#include <CGAL/Conformal_equivalence/internal/Cones/dense_systems.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>
#include <CGAL/Conformal_equivalence/internal/Solver/energy.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A cone, a vertex for it, its curvature, and what the placement is expected to measure then.
struct Cone_move
{
  std::size_t cone = 0;
  std::uint32_t to = Intrinsic_triangulation<>::null_index;
  double curvature = 0;
  double expected = std::numeric_limits<double>::infinity();
};

template <typename NT>
class Cone_search
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;

public:
  // One component, with natural borders (u = 0) or closed. Keeps a reference.
  Cone_search(const Triangulation& t, const Surface_components::Component& component, std::unique_ptr<Factorization> factorization,
              Cone_measure measure)
    : t_(t), energy_(t, true), linear_(std::move(factorization)), kind_(measure),
      is_closed_(component.number_of_borders == 0), euler_characteristic_(double(component.euler_characteristic()))
  {
    std::vector<char> free(t.number_of_vertices(), 0);
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      if(!t.is_isolated_vertex(v) && !t.is_border_vertex(v))
      {
        free[v] = 1;
        inner_.push_back(v);
      }
    if(is_closed_)
    {
      ground_ = inner_.front();
      free[ground_] = 0;
    }
    linear_.set_edges(t);
    linear_.set_free(free);
    energy_.evaluate(Vertex_vector(t.number_of_vertices(), 0.));
    first_weights_ = energy_.weights();
  }

  bool factorize() { return linear_.factorize(first_weights_); }

  std::size_t number_of_solves() const { return number_of_solves_; }
  const std::vector<Index>& candidates() const { return inner_; }
  bool is_closed() const { return is_closed_; }

  // The u to begin with: without any cone, the curvature of a closed surface spread equally.
  Placement without_cones(Vertex_vector u)
  {
    Placement p;
    p.u = std::move(u);
    judge(p);
    return p;
  }

  // The angle sum at a vertex that is no cone. On a sphere fewer than three cones cannot be free: then all vertices bear an equal part
  // of the curvature.
  double flat_angle(const Placement& p) const
  {
    const double turn = 2 * Number_constants<double>::pi();
    const bool is_spread = is_closed_ && p.cones.size() < (euler_characteristic_ > 0 ? 3u : 1u);
    return is_spread ? turn - turn * euler_characteristic_ / double(inner_.size()) : turn;
  }

  // The vertex with the largest |u| that is no cone, the first of equals; null_index if there is none.
  Index worst_vertex(const Placement& p) const
  {
    return largest(p.u, [&](Index v) { return !p.is_cone(v); });
  }

  // Puts a cone; u is as it was. `follow()` and `relax()` make it follow.
  static void add(Placement& p, Index v) { p.cones.push_back(v); }

  // Puts a cone where |u| is largest, and changes u to first order. Returns whether there was such a vertex.
  bool put_cone(Placement& p)
  {
    const Index v = worst_vertex(p);
    if(v == t_.null_index)
      return false;
    const double flat = flat_angle(p);
    add(p, v);
    follow(p, flat, {});
    return true;
  }

  // Takes out the cone number i, which has that curvature, and changes u to first order.
  void take_cone(Placement& p, std::size_t i, double curvature)
  {
    const double flat = flat_angle(p);
    const Index c = p.cones[i];
    p.cones.erase(p.cones.begin() + std::ptrdiff_t(i));
    follow(p, flat, {{c, -curvature}});
  }

  // The same with the cone number i at v instead.
  Placement moved(const Placement& p, std::size_t i, double curvature, Index v)
  {
    Placement result = p;
    std::vector<std::pair<Index, double> > forces(1, std::make_pair(p.cones[i], -curvature));
    if(!p.angles.empty())
      forces.emplace_back(v, curvature);
    result.cones[i] = v;
    if(!follow(result, flat_angle(p), forces))
      result.measure = std::numeric_limits<double>::infinity();
    return result;
  }

  // Some steps of Newton's method with the factor that there is, until angles, and u at free cones, are right up to `close`. Where that comes to
  // little, the factor is renewed, if that is wanted, which costs as much as many steps. Returns false if steps came to nothing.
  bool relax(Placement& p, int most, double close = 1e-3, bool may_renew = true)
  {
    const double infinity = std::numeric_limits<double>::infinity();
    centre(p);
    Vertex_vector r;
    double size = error(p, p.u, r);
    int number_of_slow_steps = 0;
    for(int i = 0; i < most && size > close && size < infinity; ++i)
    {
      const double last = size;
      if(!step(p, r, size))
        size = infinity;
      number_of_slow_steps = size > 0.3 * last ? number_of_slow_steps + 1 : 0;
      if(may_renew && number_of_slow_steps == 2 && !renew_factor(p.u))
        size = infinity;
    }
    judge(p);
    p.error = std::isnan(size) ? infinity : size;
    return p.error < infinity;
  }

  // The curvatures at the cones, which are the forces that act on u there.
  std::vector<double> curvatures(const Placement& p)
  {
    std::vector<double> result;
    if(p.angles.empty())
      energy_.evaluate(p.u);
    for(std::size_t i = 0; i < p.cones.size(); ++i)
      result.push_back(flat_angle(p) - (p.angles.empty() ? energy_.angle_sums()[p.cones[i]] : p.angles[i]));
    return result;
  }

  // Has the vertex where |u| is largest looked at when moves are foreseen.
  void watch(const Placement& p)
  {
    const Index v = largest(p.u, [](Index) { return true; });
    if(kind_ == Cone_measure::MAXIMUM_U && v != t_.null_index && std::find(watched_.begin(), watched_.end(), v) == watched_.end())
      watched_.push_back(v);
  }

  // The move of one cone to a vertex within `reach` edges from which most is expected, as far as it can be foreseen. Those of `tried` are not.
  Cone_move best_move(const Placement& p, std::size_t reach, const std::set<std::pair<Index, Index> >& tried)
  {
    Cone_move best;
    const std::vector<double> curvature = curvatures(p);
    for(std::size_t i = 0; i < p.cones.size(); ++i)
    {
      const Cone_excursion x = excursion(p, i, curvature[i]);
      for(Index v : vertices_around(p.cones[i], reach))
      {
        if(t_.is_border_vertex(v) || p.is_cone(v) || tried.count(std::make_pair(p.cones[i], v)) != 0)
          continue;
        const double g = diagonal(v, p.cones[i]);
        const double expected = kind_ == Cone_measure::DIRICHLET_ENERGY ? p.measure + x.energy_change(v, g)
                                                                        : x.largest_u(v, g, best.expected);
        if(expected < best.expected)
          best = {i, v, curvature[i], expected};
      }
    }
    return best;
  }

  // What `p` measures, from its u.
  void judge(Placement& p) const
  {
    p.measure = 0;
    if(kind_ == Cone_measure::DIRICHLET_ENERGY)
    {
      for(std::size_t e = 0; e < first_weights_.size(); ++e)
      {
        const Index h = t_.edge_halfedge(Index(e));
        const double d = p.u[t_.origin(h)] - p.u[t_.target(h)];
        p.measure += first_weights_[e] * d * d / 4;
      }
      return;
    }
    const Index v = largest(p.u, [](Index) { return true; });
    p.measure = v == t_.null_index ? 0 : std::abs(p.u[v]);
  }

private:
  typedef Cone_excursion::Response Response;

  // The vertex with the largest |u|, the first of equals, among those admitted, borders not; NaN counts as larger than anything. null_index if there
  // is none.
  template <typename Admits>
  Index largest(const Vertex_vector& u, Admits admits) const
  {
    Index result = t_.null_index;
    double most = -1;
    for(Index v : inner_)
    {
      const double size = std::isnan(u[v]) ? std::numeric_limits<double>::infinity() : std::abs(u[v]);
      if(size > most && admits(v))
      {
        most = size;
        result = v;
      }
    }
    return result;
  }

  // The cones of `p` have changed, the angle of flat vertices was `flat`, and there are these further forces: u to first order.
  bool follow(Placement& p, double flat, const std::vector<std::pair<Index, double> >& forces)
  {
    Vertex_vector d(p.u.size(), 0.);
    double total = 0;
    const auto act = [&](const Response& g, double force, double sum)
    {
      for(std::size_t v = 0; v < d.size(); ++v)
        d[v] += force * (*g)[v];
      total += sum;
    };
    for(const auto& force : forces)
      act(response(force.first), force.second, force.second);
    const double turned = (flat - flat_angle(p)) * double(inner_.size());
    if(turned != 0)
      act(uniform_response(), turned, turned);
    if(!p.angles.empty())
      centre_change(p.u, d);
    else if(!correct(p, total, d))
      return false;
    const double longest_step = 2; // beyond it, first order means little
    if(!(largest_entry(d) <= longest_step))
      return relax(p, 1);
    for(std::size_t v = 0; v < d.size(); ++v)
      p.u[v] += d[v];
    judge(p);
    return true;
  }

  // What can be foreseen of moves of the cone number i, which has that curvature.
  Cone_excursion excursion(const Placement& p, std::size_t i, double curvature)
  {
    Cone_excursion result(p, p.cones[i], response(p.cones[i]), curvature, is_closed_);
    if(is_closed_ && (!p.angles.empty() || p.cones.size() == 1))
      result.balance(uniform_response());
    else
    {
      std::vector<Response> responses;
      if(p.angles.empty())
        for(Index c : p.cones)
          responses.push_back(response(c));
      result.keep_others(responses);
    }
    for(Index w : watched_)
      if(w != p.cones[i])
        result.watch(w, response(w));
    return result;
  }

  // G(v, v); if it is not known, that of c changed by what is different nearby.
  double diagonal(Index v, Index c)
  {
    const auto known = response_.find(v);
    if(known != response_.end())
      return (*known->second)[v];
    const double difference = local_response(v) - local_response(c);
    return (*response(c))[c] + (std::isfinite(difference) ? difference : 0);
  }

  // G(v, v) up to what does not depend on the triangulation near v: by A G_v = e_v it is 1 / A_vv and the mean, weighted by the weights of edges, of
  // G_v at the neighbours, about -log(distance) / (2 pi).
  double local_response(Index v) const
  {
    double weight = 0, sum = 0;
    t_.for_each_outgoing(v, [&](Index h)
    {
      const double w = first_weights_[t_.edge(h)] / 2;
      weight += w;
      sum += w * std::log(static_cast<double>(t_.length(t_.edge(h))));
    });
    return (1 - sum / (2 * Number_constants<double>::pi())) / weight;
  }

  // The vertices within that distance in edges.
  std::vector<Index> vertices_around(Index v, std::size_t distance) const
  {
    std::vector<char> is_seen(t_.number_of_vertices(), 0);
    std::vector<Index> result(1, v);
    is_seen[v] = 1;
    std::size_t begin = 0;
    for(std::size_t d = 0; d < distance; ++d)
      for(const std::size_t end = result.size(); begin < end; ++begin)
        t_.for_each_outgoing(result[begin], [&](Index h)
        {
          for(Index w : {t_.target(h), t_.apex(h)})
            if(!is_seen[w])
            {
              is_seen[w] = 1;
              result.push_back(w);
            }
        });
    return result;
  }

  // The response of u to equal forces everywhere, with the sum 1.
  Response uniform_response()
  {
    if(!uniform_response_)
    {
      Vertex_vector force(t_.number_of_vertices(), 0.), g(t_.number_of_vertices(), 0.);
      for(Index v : inner_)
        force[v] = v == ground_ ? 0 : 1 / double(inner_.size());
      linear_.solve(force, g);
      ++number_of_solves_;
      uniform_response_ = std::make_shared<const Vertex_vector>(std::move(g));
    }
    return uniform_response_;
  }

  // The response of u to a unit force; kept, as long as memory is modest.
  Response response(Index c)
  {
    const auto known = response_.find(c);
    if(known != response_.end())
      return known->second;
    if(response_.size() >= (std::max)(std::size_t(16), std::size_t(30000000) / (std::max)(std::size_t(1), std::size_t(t_.number_of_vertices()))))
      response_.clear();
    Vertex_vector force(t_.number_of_vertices(), 0.), g(t_.number_of_vertices(), 0.);
    if(c != ground_)
    {
      force[c] = 1;
      linear_.solve(force, g);
      ++number_of_solves_;
    }
    return response_.emplace(c, std::make_shared<const Vertex_vector>(std::move(g))).first->second;
  }

  // d += forces at the cones and a constant, so that u + d is 0 at the cones. `total`: the sum of all forces that have made d
  bool correct(const Placement& p, double total, Vertex_vector& d)
  {
    const std::size_t k = p.cones.size(), n = k + (is_closed_ ? 1 : 0);
    if(k == 0)
    {
      centre_change(p.u, d);
      return true;
    }
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(Eigen::Index(n), Eigen::Index(n));
    Eigen::VectorXd b = Eigen::VectorXd::Zero(Eigen::Index(n));
    std::vector<Response> g;
    for(Index c : p.cones)
      g.push_back(response(c));
    for(std::size_t i = 0; i < k; ++i)
    {
      for(std::size_t j = 0; j < k; ++j)
        m(Eigen::Index(i), Eigen::Index(j)) = (*g[j])[p.cones[i]];
      b[Eigen::Index(i)] = -p.u[p.cones[i]] - d[p.cones[i]];
    }
    if(is_closed_)
    {
      for(std::size_t i = 0; i < k; ++i)
        m(Eigen::Index(i), Eigen::Index(k)) = m(Eigen::Index(k), Eigen::Index(i)) = 1;
      b[Eigen::Index(k)] = -total;
    }
    const Eigen::VectorXd x = dense_solution(m, b);
    if(!x.allFinite())
      return false;
    for(std::size_t j = 0; j < k; ++j)
    {
      const Vertex_vector& g_j = *g[j];
      const double x_j = x[Eigen::Index(j)];
      for(std::size_t v = 0; v < d.size(); ++v)
        d[v] += x_j * g_j[v];
    }
    if(is_closed_)
      for(double& y : d)
        y += x[Eigen::Index(k)];
    return true;
  }

  // Without a free cone nothing determines the scale of a closed surface: the mean of u + d is to be 0.
  void centre_change(const Vertex_vector& u, Vertex_vector& d) const
  {
    if(!is_closed_)
      return;
    double sum = 0;
    for(Index v : inner_)
      sum += u[v] + d[v];
    for(Index v : inner_)
      d[v] -= sum / double(inner_.size());
  }

  void centre(Placement& p) const
  {
    if(p.angles.empty())
      return;
    Vertex_vector d(p.u.size(), 0.);
    centre_change(p.u, d);
    for(std::size_t v = 0; v < d.size(); ++v)
      p.u[v] += d[v];
  }

  // The residual of the angles at u, 0 at free cones; and how much is wrong: angles, in radians, and u at free cones.
  double error(const Placement& p, const Vertex_vector& u, Vertex_vector& r)
  {
    if(!energy_.evaluate(u))
      return std::numeric_limits<double>::infinity();
    const double flat = flat_angle(p);
    double result = 0;
    r.assign(u.size(), 0.);
    for(Index v : inner_)
      r[v] = energy_.angle_sums()[v] - flat;
    for(std::size_t i = 0; i < p.cones.size(); ++i)
    {
      const Index c = p.cones[i];
      r[c] = p.angles.empty() ? 0 : energy_.angle_sums()[c] - p.angles[i];
      if(p.angles.empty())
        result = (std::max)(result, std::abs(u[c]));
    }
    return (std::max)(result, largest_entry(r));
  }

  // A step, shortened if it is of no use; `r` and `size` are of p.u, before and after.
  bool step(Placement& p, Vertex_vector& r, double& size)
  {
    Vertex_vector d;
    double total = 0;
    for(Index v : inner_)
      total += r[v];
    if(!std::isfinite(total) || !linear_.solve(r, d))
      return false;
    ++number_of_solves_;
    if(!p.angles.empty())
      centre_change(p.u, d);
    else if(!correct(p, total, d))
      return false;
    const double least = 0.1;
    for(double t = 1; ; t /= 2)
    {
      Vertex_vector u = p.u, next;
      for(std::size_t v = 0; v < d.size(); ++v)
        u[v] += t * d[v];
      const double next_size = error(p, u, next);
      if(!(next_size < size) && t > least)
        continue;
      if(!std::isfinite(next_size))
        return false;
      p.u.swap(u);
      r.swap(next);
      size = next_size;
      return true;
    }
  }

  bool renew_factor(const Vertex_vector& u)
  {
    response_.clear();
    uniform_response_.reset();
    return energy_.evaluate(u) && linear_.factorize(energy_.weights());
  }

  const Triangulation& t_;
  Conformal_energy<double, NT> energy_;
  Laplacian_solver linear_;
  const Cone_measure kind_;
  const bool is_closed_;
  const double euler_characteristic_;
  std::vector<Index> inner_;
  Index ground_ = Triangulation::null_index;
  std::vector<double> first_weights_;
  std::map<Index, Response> response_;
  Response uniform_response_;
  std::vector<Index> watched_; // where |u| was largest
  std::size_t number_of_solves_ = 0;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_SEARCH_H
