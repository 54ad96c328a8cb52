// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// How small the root mean square |u| can be at all, to first order, if the sizes of the curvatures of all cones, wherever and however many they
// are, sum up to no more than M.
//
// With the weights W and p = G W u for the u of any curvatures (Cone_model.h), others k' make u', and, as W is positive semidefinite,
//
//     |u'| |u| >= u' W u = flat W u + sum of k' p >= flat W u + level (sum of k') - max |p - level| M
//
// for any level, as the sum of k' is what it is on closed surfaces; on others level = 0. This is best for the least u: a convex problem. Its
// curvatures are measures on the vertices, positive and negative ones, of given total masses. They are found by conditional gradients (M. Frank,
// P. Wolfe, 1956), with all masses corrected after every vertex that is added: mass goes from where the derivative is largest to where it is least.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_BOUND_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_BOUND_H

#include <CGAL/Conformal_equivalence/internal/Cones/Cone_fit.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Cone_model.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename NT>
class Cone_bound
{
  typedef std::uint32_t Index;
  typedef typename Cone_model<NT>::Column Column;

public:
  // Keeps a reference. `area`: the weights, with the sum 1
  Cone_bound(Cone_model<NT>& model, const Eigen::VectorXd& area) : model_(model), area_(area) {}

  // For the M of these cones, which have the curvature that a closed surface has to have.
  double operator()(const Curved_cones& s)
  {
    u_ = model_.flat();
    for(std::size_t i = 0; i < s.cones.size(); ++i)
      add(s.cones[i], s.curvatures[Eigen::Index(i)] < 0 ? -1 : 1, std::abs(s.curvatures[Eigen::Index(i)]));
    const double total_mass = s.curvatures.cwiseAbs().sum();
    double result = 0;
    for(int round = 0; round < most_rounds && !atoms_.empty(); ++round)
    {
      correct();
      const Eigen::VectorXd load = area_.cwiseProduct(u_), p = model_.response(load);
      const auto extremes = std::minmax_element(model_.places().begin(), model_.places().end(), [&](Index v, Index w) { return p[v] < p[w]; });
      const Index lowest = *extremes.first, highest = *extremes.second;
      const double square = load.dot(u_), level = model_.is_closed() ? (p[lowest] + p[highest]) / 2 : 0,
                   total = model_.is_closed() ? model_.total_curvature() : 0, reach = (std::max)(p[highest] - level, level - p[lowest]);
      if(!(square > 0))
        break;
      result = (std::max)(result, (load.dot(model_.flat()) + level * total - reach * total_mass) / std::sqrt(square));
      if(result > good_enough * std::sqrt(square))
        break;
      add(lowest, 1, 0);
      add(highest, -1, 0);
    }
    return result;
  }

private:
  static constexpr int most_rounds = 16;
  static constexpr double good_enough = 0.98; // of what has been reached

  // Curvature of one sign at a vertex
  struct Atom
  {
    Index vertex;
    int sign;
    double mass;
    Column column; // times the sign, less its mean
  };

  void add(Index v, int sign, double mass)
  {
    for(const Atom& a : atoms_)
      if(a.vertex == v && a.sign == sign)
        return;
    Eigen::VectorXd g = sign * *model_.column(v);
    g.array() -= area_.dot(g);
    u_ += mass * g;
    u_.array() -= area_.dot(u_);
    const Eigen::Index n = Eigen::Index(atoms_.size());
    gram_.conservativeResize(n + 1, n + 1);
    const Eigen::VectorXd wg = area_.cwiseProduct(g);
    for(Eigen::Index i = 0; i < n; ++i)
      gram_(i, n) = gram_(n, i) = wg.dot(*atoms_[std::size_t(i)].column);
    gram_(n, n) = wg.dot(g);
    atoms_.push_back({v, sign, mass, std::make_shared<const Eigen::VectorXd>(std::move(g))});
  }

  // On a closed surface the masses of each sign are what they are; else mass may go from one sign to the other.
  bool may_exchange(const Atom& a, const Atom& b) const { return !model_.is_closed() || a.sign == b.sign; }

  // The best masses for the vertices that there are.
  void correct()
  {
    const std::size_t n = atoms_.size();
    Eigen::VectorXd slope(static_cast<Eigen::Index>(n));
    for(std::size_t i = 0; i < n; ++i)
      slope[Eigen::Index(i)] = area_.cwiseProduct(u_).dot(*atoms_[i].column);
    const Eigen::VectorXd before = masses();
    const int most_steps = 200 * int(n);
    for(int step = 0; step < most_steps; ++step)
    {
      std::size_t from = n, to = n;
      double best = 1e-12 * slope.cwiseAbs().maxCoeff();
      for(std::size_t i = 0; i < n; ++i)
        for(std::size_t j = 0; j < n; ++j)
          if(atoms_[i].mass > 0 && may_exchange(atoms_[i], atoms_[j]) && slope[Eigen::Index(i)] - slope[Eigen::Index(j)] > best)
          {
            best = slope[Eigen::Index(i)] - slope[Eigen::Index(j)];
            from = i;
            to = j;
          }
      if(from == n)
        break;
      const Eigen::Index i = Eigen::Index(from), j = Eigen::Index(to);
      const double bend = gram_(i, i) + gram_(j, j) - 2 * gram_(i, j), most = atoms_[from].mass,
                   moved = bend > 0 ? (std::min)(most, best / bend) : most;
      atoms_[from].mass -= moved;
      atoms_[to].mass += moved;
      slope += moved * (gram_.col(j) - gram_.col(i));
    }
    const Eigen::VectorXd after = masses();
    for(std::size_t i = 0; i < n; ++i)
      u_ += (after[Eigen::Index(i)] - before[Eigen::Index(i)]) * *atoms_[i].column;
  }

  Eigen::VectorXd masses() const
  {
    Eigen::VectorXd result(static_cast<Eigen::Index>(atoms_.size()));
    for(std::size_t i = 0; i < atoms_.size(); ++i)
      result[Eigen::Index(i)] = atoms_[i].mass;
    return result;
  }

  Cone_model<NT>& model_;
  const Eigen::VectorXd area_;
  std::vector<Atom> atoms_;
  Eigen::MatrixXd gram_;
  Eigen::VectorXd u_; // less its mean
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_BOUND_H
