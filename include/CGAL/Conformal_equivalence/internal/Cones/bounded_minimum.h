// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The least value of a convex quadratic function within bounds, where some of the unknowns keep their sum: a primal active set method (Nocedal and
// Wright, Numerical optimization, 2006, algorithm 16.3). From unknowns within bounds it goes to the least value among those that are not held at a
// bound; the first bound that is met on the way holds. Where none is met, one that would rather leave its bound is let go. The value never grows,
// and the sum is kept whatever happens.
//
// The sum is kept by elimination: one of its unknowns is minus the sum of the others. What is left is scaled to the diagonal 1, so that unknowns
// whose sizes differ by much do no harm.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_BOUNDED_MINIMUM_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_BOUNDED_MINIMUM_H

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Bounded_minimum
{
  typedef Eigen::Index Index;

public:
  // The function is x^T k x / 2 + b^T x, k positive semidefinite. Bounds may be infinite. `is_in_sum`: empty if no sum is kept
  Bounded_minimum(const Eigen::MatrixXd& k, const Eigen::VectorXd& b, const Eigen::VectorXd& least, const Eigen::VectorXd& most,
                  std::vector<char> is_in_sum)
    : k_(k), b_(b), least_(least), most_(most), is_in_sum_(std::move(is_in_sum))
  {
    is_in_sum_.resize(std::size_t(b.size()), 0);
  }

  // \pre x is within the bounds
  Eigen::VectorXd from(Eigen::VectorXd x)
  {
    if(x.size() == 0)
      return x;
    is_held_.assign(std::size_t(x.size()), 0);
    Eigen::VectorXd slope = k_ * x + b_;
    const int most_steps = 20 + 4 * int(x.size()); // all that matters is done in about as many steps as bounds are met
    for(int i = 0; i < most_steps; ++i)
    {
      const Eigen::VectorXd to = step(slope);
      if(!to.allFinite())
        break;
      const bool is_free = go(to, x);
      slope = k_ * x + b_;
      if(is_free && !let_go(slope, x))
        break;
    }
    return x;
  }

private:
  // To the least value among the unknowns that are not held.
  Eigen::VectorXd step(const Eigen::VectorXd& slope) const
  {
    Index pivot = -1; // is minus the sum of the others
    std::vector<Index> open;
    for(Index i = 0; i < slope.size(); ++i)
    {
      if(is_held_[std::size_t(i)])
        continue;
      open.push_back(i);
      if(is_in_sum_[std::size_t(i)] && (pivot < 0 || k_(i, i) < k_(pivot, pivot)))
        pivot = i;
    }
    open.erase(std::remove(open.begin(), open.end(), pivot), open.end());
    const Index n = Index(open.size());
    const auto part = [&](Index i) { return pivot >= 0 && is_in_sum_[std::size_t(i)] ? 1. : 0.; };
    Eigen::MatrixXd k(n, n);
    Eigen::VectorXd b(n), size(n); // of what the diagonal is a difference of
    for(Index i = 0; i < n; ++i)
    {
      const Index v = open[std::size_t(i)];
      size[i] = k_(v, v) + (pivot < 0 ? 0 : part(v) * k_(pivot, pivot));
      b[i] = pivot < 0 ? slope[v] : slope[v] - part(v) * slope[pivot];
      for(Index j = 0; j <= i; ++j)
      {
        const Index w = open[std::size_t(j)];
        k(i, j) = k(j, i) = pivot < 0 ? k_(v, w)
          : k_(v, w) - part(v) * k_(pivot, w) - part(w) * k_(v, pivot) + part(v) * part(w) * k_(pivot, pivot);
      }
    }
    const Eigen::VectorXd d = -scaled_solution(k, b, size);
    Eigen::VectorXd result = Eigen::VectorXd::Zero(slope.size());
    for(Index i = 0; i < n; ++i)
    {
      result[open[std::size_t(i)]] = d[i];
      if(pivot >= 0)
        result[pivot] -= part(open[std::size_t(i)]) * d[i];
    }
    return result;
  }

  // Of k x = b. What k does not determine up to its roundings is very long: a bound will be met.
  static Eigen::VectorXd scaled_solution(Eigen::MatrixXd k, const Eigen::VectorXd& b, const Eigen::VectorXd& size)
  {
    if(b.size() == 0)
      return b;
    const double rounding = 4 * double(b.size()) * std::numeric_limits<double>::epsilon();
    const Eigen::VectorXd least = (size.array() + rounding * size.maxCoeff() + (std::numeric_limits<double>::min)()) * rounding;
    k.diagonal() = k.diagonal().cwiseMax(0.) + least;
    const Eigen::VectorXd scale = k.diagonal().cwiseSqrt().cwiseInverse();
    return scale.asDiagonal() * (scale.asDiagonal() * k * scale.asDiagonal()).ldlt().solve(scale.asDiagonal() * b);
  }

  // As far as the bounds allow. Returns whether they allow all.
  bool go(const Eigen::VectorXd& to, Eigen::VectorXd& x)
  {
    double part = 1;
    Index first = -1;
    for(Index i = 0; i < x.size(); ++i)
    {
      const double room = to[i] > 0 ? most_[i] - x[i] : x[i] - least_[i];
      if(std::abs(to[i]) * part > room)
      {
        part = (std::max)(room, 0.) / std::abs(to[i]);
        first = i;
      }
    }
    x += part * to;
    if(first < 0)
      return true;
    x[first] = to[first] > 0 ? most_[first] : least_[first];
    is_held_[std::size_t(first)] = 1;
    return false;
  }

  // Frees the unknown that gains most by leaving its bound, or the two that gain most by exchanging something. Returns whether there are such.
  bool let_go(const Eigen::VectorXd& slope, const Eigen::VectorXd& x)
  {
    const double largest = k_.diagonal().maxCoeff(), rounding = std::numeric_limits<double>::epsilon();
    const Eigen::VectorXd size = k_.diagonal().cwiseMax(rounding * rounding * largest + (std::numeric_limits<double>::min)()).cwiseSqrt();
    const double tiny = 1e-9 * slope.cwiseQuotient(size).cwiseAbs().maxCoeff();
    Index up = -1, down = -1, open = -1; // of the sum: at the least value with the least slope, at the most with the largest; one that is free
    for(Index i = 0; i < x.size(); ++i)
    {
      if(!is_in_sum_[std::size_t(i)])
        continue;
      if(!is_held_[std::size_t(i)])
        open = i;
      else if(x[i] == least_[i])
        up = up < 0 || slope[i] < slope[up] ? i : up;
      else
        down = down < 0 || slope[i] > slope[down] ? i : down;
    }
    if(open < 0 && up >= 0 && down >= 0 && slope[up] + tiny * size[up] < slope[down])
    {
      is_held_[std::size_t(up)] = is_held_[std::size_t(down)] = 0;
      return true;
    }
    Index best = -1;
    double most = tiny;
    for(Index i = 0; i < x.size(); ++i)
    {
      const bool is_bound_to_sum = is_in_sum_[std::size_t(i)] != 0;
      if(!is_held_[std::size_t(i)] || (is_bound_to_sum && open < 0))
        continue;
      const double s = (is_bound_to_sum ? slope[i] - slope[open] : slope[i]) / size[i], gain = x[i] == least_[i] ? -s : s;
      if(gain > most)
      {
        most = gain;
        best = i;
      }
    }
    if(best >= 0)
      is_held_[std::size_t(best)] = 0;
    return best >= 0;
  }

  const Eigen::MatrixXd& k_;
  const Eigen::VectorXd& b_;
  const Eigen::VectorXd& least_;
  const Eigen::VectorXd& most_;
  std::vector<char> is_in_sum_;
  std::vector<char> is_held_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_BOUNDED_MINIMUM_H
