// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What cones do to u, to first order.
//
// Curvature K (2 pi less the angle sum) changes by A du, A the Laplacian of the cotangents (Edge_graph.h). So the metric with the curvatures k_c
// at the cones c, and none elsewhere, has
//
//     u = u_flat + sum of k_c G_c,   G_c = A^{-1} e_c,   u_flat = u_0 - A^{-1} K(u_0).
//
// For smooth surfaces this is exact, as the Laplacian of a scaled metric is the scaled Laplacian: only the triangulation makes it an
// approximation. It is made on the Delaunay triangulation, whose weights are not negative. One factor does for all places and all angles; the columns
// G_c are kept.
//
// At a vertex where curvature changes by much, a cone above all, u is not linear in it, while around it hardly anything else changes. A fan of m
// equal triangles with the angle a at its apex, whose rim stays as it is, has u = -2 log sin(a / 2) + constant at its apex. What that differs from
// its tangent at the first angle is added there: the *excess*.
//
// Where u is given on a border, A is restricted to the vertices inside. On a closed surface A has the constants for its kernel: one vertex is
// grounded, u is determined up to a constant, and is right if the curvatures sum up to 2 pi times the Euler characteristic.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_MODEL_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_MODEL_H

#include <CGAL/Conformal_equivalence/internal/Cones/Cone_surface.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A vertex with the curvature that it has at first: an apex of equal triangles.
class Cone_apex
{
public:
  Cone_apex(double degree, double curvature, double blur)
    : degree_(degree), curvature_(curvature), blur_(blur), angle_(admitted((2 * Number_constants<double>::pi() - curvature) / degree)),
      sine_(std::sin(angle_ / 2)), slope_(1 / (degree * std::tan(angle_ / 2)))
  {}

  // What is to be added to u, where the curvature becomes k, and its derivative by k.
  std::pair<double, double> excess(double k) const
  {
    const double half = admitted(angle_ - (k - curvature_) / degree_) / 2, sine = std::sin(half);
    return std::make_pair(2 * std::log(sine_ / sine) - (k - curvature_) * (slope_ - blur_), std::cos(half) / (sine * degree_) - slope_ + blur_);
  }

private:
  // Beyond, edges are flipped.
  static double admitted(double angle) { return (std::min)((std::max)(angle, 1e-3), Number_constants<double>::pi()); }

  double degree_, curvature_, blur_;
  double angle_; // of each of the triangles
  double sine_, slope_;
};

class Cone_model
{
public:
  typedef std::uint32_t Index;
  typedef std::shared_ptr<const Eigen::VectorXd> Column;

  // One component with u = 0 on its borders, if there are any, or closed. Takes linear time; `factorize()` takes more.
  Cone_model(Cone_surface surface, double euler_characteristic, std::unique_ptr<Factorization> factorization)
    : surface_(std::move(surface)), linear_(std::move(factorization)), euler_characteristic_(euler_characteristic)
  {
    std::vector<char> free(surface_.number_of_vertices(), 0);
    for(Index v = 0; v < surface_.number_of_vertices(); ++v)
    {
      if(surface_.is_border_vertex(v))
        is_closed_ = false;
      else if(surface_.is_inner_vertex(v))
        inner_.push_back(v);
    }
    for(Index v : inner_)
      free[v] = 1;
    if(is_closed_ && !inner_.empty())
      free[surface_.ground] = 0;
    linear_.set_edges(surface_);
    linear_.set_free(free);
  }

  Cone_model(const Cone_model&) = delete;
  Cone_model& operator=(const Cone_model&) = delete;

  // Once, before the rest is asked. Returns whether it is possible.
  bool factorize()
  {
    if(!linear_.factorize(surface_.weights))
      return false;
    const Vertex_vector d = accurate_solution(surface_.curvature);
    flat_.resize(Eigen::Index(d.size()));
    for(std::size_t v = 0; v < d.size(); ++v)
      flat_[Eigen::Index(v)] = surface_.u[v] - d[v];
    for(Index v : inner_)
      flat_[v] += excess(v, 0).first;
    return flat_.allFinite();
  }

  const Cone_surface& surface() const { return surface_; }
  const std::vector<Index>& places() const { return inner_; } // where cones can be
  bool is_closed() const { return is_closed_; }
  std::size_t number_of_solves() const { return number_of_solves_; }

  // Of what is accurate: the largest residual, as a part of the largest force
  void set_accuracy(double accuracy) { accuracy_ = accuracy; }

  // What the curvatures of the cones of a closed surface sum up to.
  double total_curvature() const { return 2 * Number_constants<double>::pi() * euler_characteristic_; }

  // u where there are no cones; of a closed surface, as if the curvature missing were at the grounded vertex
  const Eigen::VectorXd& flat() const { return flat_; }

  Cone_apex apex(Index v) const { return Cone_apex(surface_.degree[v], surface_.own_curvature[v], surface_.blur[v]); }

  // What is to be added to u at v, where the curvature becomes k, and its derivative by k.
  std::pair<double, double> excess(Index v, double k) const { return apex(v).excess(k); }

  // G_c, as accurate as the preconditioner. Kept, as long as memory is modest.
  Column column(Index c)
  {
    const auto known = columns_.find(c);
    if(known != columns_.end())
      return known->second;
    if(columns_.size() >= (std::max)(std::size_t(32), std::size_t(30000000) / (std::max)(std::size_t(1), surface_.number_of_vertices())))
      columns_.clear();
    Vertex_vector force(surface_.number_of_vertices(), 0.);
    force[c] = 1;
    return columns_.emplace(c, std::make_shared<const Eigen::VectorXd>(solution(force))).first->second;
  }

  // The same to all digits that matter to angles; from now on.
  void sharpen(const std::vector<Index>& cones)
  {
    for(Index c : cones)
    {
      Vertex_vector force(surface_.number_of_vertices(), 0.);
      force[c] = 1;
      const Vertex_vector g = accurate_solution(force);
      columns_[c] = std::make_shared<const Eigen::VectorXd>(Eigen::VectorXd::Map(g.data(), Eigen::Index(g.size())));
    }
  }

  // The response to equal forces everywhere, with the sum 1.
  Column spread_column()
  {
    if(!spread_)
    {
      Vertex_vector force(surface_.number_of_vertices(), 0.);
      for(Index v : inner_)
        force[v] = 1 / double(inner_.size());
      spread_ = std::make_shared<const Eigen::VectorXd>(solution(force));
    }
    return spread_;
  }

  // G times a load
  Eigen::VectorXd response(const Eigen::VectorXd& load) { return solution(Vertex_vector(load.data(), load.data() + load.size())); }

private:
  Eigen::VectorXd solution(const Vertex_vector& force)
  {
    Vertex_vector x;
    linear_.precondition(force, x);
    ++number_of_solves_;
    return Eigen::VectorXd::Map(x.data(), Eigen::Index(x.size()));
  }

  Vertex_vector accurate_solution(const Vertex_vector& force)
  {
    Vertex_vector x;
    bool converged = false;
    number_of_solves_ += linear_.conjugate_gradients(surface_.weights, force, accuracy_, 30, false, x, converged);
    return x;
  }

  const Cone_surface surface_;
  Laplacian_solver linear_;
  const double euler_characteristic_;
  bool is_closed_ = true;
  std::vector<Index> inner_;
  Eigen::VectorXd flat_;
  std::map<Index, Column> columns_;
  Column spread_;
  std::size_t number_of_solves_ = 0;
  double accuracy_ = 1e-10;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_MODEL_H
