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

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONE_SEARCH_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONE_SEARCH_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/energy.h>
#include <CGAL/Conformal_equivalence/internal/solver/Laplacian_solver.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceEnums
/// By what placements of cones are compared: the less the better.
enum class Cone_measure
{
  MAXIMUM_U,       ///< the largest |u|
  DIRICHLET_ENERGY ///< the Dirichlet energy of u: how much the scale varies, over the whole surface
};

namespace internal {

// Cones, with the angles that they are to have; where there are none they are free.
struct Placement
{
  typedef std::uint32_t Index;
  std::vector<Index> cones;
  std::vector<double> angles; // radians; empty: all are free
  Vertex_vector u;
  double measure = std::numeric_limits<double>::infinity();

  bool is_cone(Index v) const { return std::find(cones.begin(), cones.end(), v) != cones.end(); }
};

template <typename NT, typename SolverTraits>
class Cone_search
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;

public:
  // One component, with natural borders (u = 0) or closed. Keeps a reference.
  Cone_search(const Triangulation& t, const Surface_components::Component& component, const SolverTraits& traits, Cone_measure measure)
    : t_(t), energy_(t, true), linear_(traits), kind_(measure),
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

  // The vertex with the largest measure of distortion that is no cone; null_index if there is none.
  Index worst_vertex(const Placement& p) const
  {
    Index worst = t_.null_index;
    for(Index v : inner_)
      if(!p.is_cone(v) && (worst == t_.null_index || std::abs(p.u[v]) > std::abs(p.u[worst])))
        worst = v;
    return worst;
  }

  static void add(Placement& p, Index v) { p.cones.push_back(v); }
  static void remove(Placement& p, std::size_t i) { p.cones.erase(p.cones.begin() + std::ptrdiff_t(i)); }

  // Some steps of Newton's method with the factor that there is, until angles, and u at free cones, are right up to `close`. Where that comes to nothing, the
  // factor is renewed. Returns whether they came nearer.
  bool relax(Placement& p, int most, double close = 1e-3)
  {
    Vertex_vector r;
    double size = error(p, p.u, r);
    int number_of_slow_steps = 0;
    for(int i = 0; i < most && size > close; ++i)
    {
      const double last = size;
      if(!step(p, r, size))
        return false;
      number_of_slow_steps = size > 0.3 * last ? number_of_slow_steps + 1 : 0;
      if(number_of_slow_steps == 2 && !renew_factor(p.u))
        return false;
    }
    judge(p);
    return std::isfinite(size);
  }

  // The curvature at the cone number i, which is the force that acts on u there.
  double curvature(const Placement& p, std::size_t i)
  {
    if(!p.angles.empty())
      return flat_angle(p) - p.angles[i];
    energy_.evaluate(p.u);
    return flat_angle(p) - energy_.angle_sums()[p.cones[i]];
  }

  // The measure after the cone number i, which has that curvature, has moved to v, as far as u depends linearly on forces.
  double measure_if_moved(const Placement& p, std::size_t i, double curvature, Index v)
  {
    Placement moved = p;
    moved.cones[i] = v;
    const Response from = response(p.cones[i]), to = response(v);
    Vertex_vector d(p.u.size());
    for(std::size_t w = 0; w < d.size(); ++w)
      d[w] = -curvature * (*from)[w];
    if(p.angles.empty())
    {
      if(!correct(moved, -curvature, d))
        return std::numeric_limits<double>::infinity();
    }
    else
    {
      for(std::size_t w = 0; w < d.size(); ++w)
        d[w] += curvature * (*to)[w];
      centre_change(p.u, d);
    }
    for(std::size_t w = 0; w < d.size(); ++w)
      moved.u[w] += d[w];
    judge(moved);
    return moved.measure;
  }

  // The numbers of the cones, beginning with the one that has most influence on u where |u| is largest.
  std::vector<std::size_t> by_influence(const Placement& p)
  {
    std::vector<std::pair<double, std::size_t> > influence;
    const Index worst = worst_vertex(p);
    for(std::size_t i = 0; i < p.cones.size(); ++i)
      influence.emplace_back(worst == t_.null_index ? 0 : -std::abs((*response(p.cones[i]))[worst]), i);
    std::sort(influence.begin(), influence.end());
    std::vector<std::size_t> result;
    for(const auto& x : influence)
      result.push_back(x.second);
    return result;
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
    for(Index v : inner_)
      p.measure = (std::max)(p.measure, std::abs(p.u[v]));
  }

private:
  typedef std::shared_ptr<const Vertex_vector> Response;

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
      linear_.precondition(force, g);
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
    const Eigen::VectorXd x = m.fullPivLu().solve(b);
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
    if(!std::isfinite(total) || !linear_.precondition(r, d))
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
    return energy_.evaluate(u) && linear_.factorize(energy_.weights());
  }

  const Triangulation& t_;
  Conformal_energy<double, NT> energy_;
  Laplacian_solver<SolverTraits> linear_;
  const Cone_measure kind_;
  const bool is_closed_;
  const double euler_characteristic_;
  std::vector<Index> inner_;
  Index ground_ = Triangulation::null_index;
  std::vector<double> first_weights_;
  std::map<Index, Response> response_;
  std::size_t number_of_solves_ = 0;
};

// ---- Angles that are multiples of 2 pi / n

// Positive integers k_i with the sum `sum` for which the largest |x_i - k_i| is least, and then as near to the x_i as can be. Empty if there are
// none. `sum` = 0: any sum. O(n^2 log n).
//
// The largest difference is one of |x_i - k| for an integer k: all of these, up to what is needed, are sorted, and the least that allows the sum is
// found by bisection: with a bound b, each k_i lies between max(1, ceil(x_i - b)) and floor(x_i + b).
inline std::vector<long> nearest_integers(const std::vector<double>& x, long sum)
{
  const std::size_t n = x.size();
  std::vector<long> result(n);
  const auto lower = [](double y, double b) { return (std::max)(1l, long(std::ceil(y - b - 1e-12))); };
  const auto upper = [](double y, double b) { return long(std::floor(y + b + 1e-12)); };
  if(sum == 0)
  {
    for(std::size_t i = 0; i < n; ++i)
      result[i] = (std::max)(1l, std::lround(x[i]));
    return result;
  }
  if(n == 0 || sum < long(n))
    return {};
  const auto is_possible = [&](double b)
  {
    long least = 0, most = 0;
    for(double y : x)
    {
      if(upper(y, b) < lower(y, b))
        return false;
      least += lower(y, b);
      most += upper(y, b);
    }
    return least <= sum && sum <= most;
  };
  double far = 1;
  while(!is_possible(far))
    far *= 2;
  std::vector<double> bounds;
  for(double y : x)
    for(long k = (std::max)(1l, long(std::floor(y - far))); double(k) <= y + far; ++k)
      bounds.push_back(std::abs(y - double(k)));
  std::sort(bounds.begin(), bounds.end());
  std::size_t begin = 0, end = bounds.size(); // the first one that is possible
  while(begin < end)
  {
    const std::size_t middle = (begin + end) / 2;
    if(is_possible(bounds[middle]))
      end = middle;
    else
      begin = middle + 1;
  }
  const double b = begin < bounds.size() ? bounds[begin] : far;

  // from the nearest ones, those that cost least are moved by one until the sum is right
  long missing = sum;
  for(std::size_t i = 0; i < n; ++i)
  {
    result[i] = (std::min)((std::max)(std::lround(x[i]), lower(x[i], b)), upper(x[i], b));
    missing -= result[i];
  }
  for(; missing != 0; missing += missing > 0 ? -1 : 1)
  {
    const long by = missing > 0 ? 1 : -1;
    std::size_t best = n;
    const auto cost = [&](std::size_t i) { return std::abs(double(result[i] + by) - x[i]) - std::abs(double(result[i]) - x[i]); };
    for(std::size_t i = 0; i < n; ++i)
      if(result[i] + by >= lower(x[i], b) && result[i] + by <= upper(x[i], b) && (best == n || cost(i) < cost(best)))
        best = i;
    if(best == n)
      return {};
    result[best] += by;
  }
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONE_SEARCH_H
