// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Where cones go if their angles are unknowns, too: a search for sparse measures of curvature.
//
// With w_v |u_v|^{p-2} u_v for a load, the response p = G load is the derivative of |u|_p^p / p by curvature, anywhere on the surface: the *dual
// potential*. At the best curvatures it has the same value at all cones (0 if their sum is free). So it tells
//
//  - where another cone gains most: where the potential differs most from that value;
//  - where to move a cone of curvature k: downhill in k p. How far, a quadratic term tells: a cone that moves by d changes u like a dipole, d / (2
//    pi r) at the distance r, which adds the mean weight per area times k^2 d^2 / (4 pi) log(R / d), about (d in widths of the surface); the
//    factor is learnt on the way.
//
// What the potential foresees is judged by the best curvatures at the new places. So a round costs one solution with the factor for the potential,
// and one for each cone that moves.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_SPARSE_CONES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_SPARSE_CONES_H

#include <CGAL/Conformal_equivalence/internal/Cones/Cone_fit.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Cone_model.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Sparse_cones
{
  typedef std::uint32_t Index;

public:
  static constexpr Index null_index = Intrinsic_triangulation<>::null_index;

  // Keeps references. `width`: the square root of the area of the surface
  Sparse_cones(Cone_model& model, Cone_fit& fit, double width) : model_(model), fit_(fit), width_(width) {}

  // Whether cones move with the curvatures that they have.
  void keep_angles(bool are_kept) { are_angles_kept_ = are_kept; }

  // Puts one more cone where it gains most. Returns whether there is a place.
  bool add(Curved_cones& s)
  {
    const Eigen::VectorXd p = potential(s);
    const double level = potential_at_cones(s, p);
    const std::pair<Index, Index> places = extremes(s, p);
    const Index lowest = places.first, highest = places.second;
    if(lowest == null_index)
      return false;
    Curved_cones best = with(s, lowest);
    if(highest != lowest && 4 * (p[highest] - level) > level - p[lowest])
    {
      Curved_cones other = with(s, highest, best.value);
      if(other.value < best.value)
        best = std::move(other);
    }
    s = std::move(best);
    return true;
  }

  // Where the potential is lowest and highest, cones left out; null_index if there are no such vertices.
  std::pair<Index, Index> extremes(const Curved_cones& s, const Eigen::VectorXd& p) const
  {
    Index lowest = null_index, highest = null_index;
    for(Index v : model_.places())
    {
      if(s.has(v) || !std::isfinite(p[v]))
        continue;
      if(lowest == null_index || p[v] < p[lowest])
        lowest = v;
      if(highest == null_index || p[v] > p[highest])
        highest = v;
    }
    return std::make_pair(lowest, highest);
  }

  // Moves cones as long as that makes it better, at most so many rounds, or until it is seen that |u|_p will not be less than `worth`. Returns
  // whether any was moved.
  bool slide(Curved_cones& s, int most_rounds, double worth = std::numeric_limits<double>::infinity())
  {
    // where |u| is large cones do not move, as a rule
    std::vector<double> stiffness(s.cones.size(), fit_.exponent() > 2 ? 1. / 16 : 1.);
    bool has_moved = false;
    for(int round = 0; round < most_rounds; ++round)
    {
      const double before = s.value;
      const Slope slope = slope_of(s);
      if(!move_all(s, slope, stiffness) && !move_one(s, slope, stiffness))
        break;
      has_moved = true;
      const double gained = before - s.value;
      if(!(gained > before * gain_of_round) || s.value - (most_rounds - 1 - round) * gained > worth) // rounds gain less and less
        break;
    }
    return has_moved;
  }

  // Takes out the cone that is missed least, and puts one elsewhere, as long as that makes it better. Returns whether it did.
  bool exchange(Curved_cones& s, int most)
  {
    bool has_gained = false;
    // all of them are tried where that costs little
    const int most_failures = model_.places().size() < 20000 ? (std::min)(int(s.cones.size()), 8) : 2;
    for(int failures = 0, i = 0; i < most && failures < most_failures && s.cones.size() > 1; ++i)
    {
      Curved_cones trial = s;
      if(!take_out(trial, std::size_t(failures)) || !add(trial))
        return has_gained;
      slide(trial, 4, s.value);
      if(trial.value < s.value * (1 - gain_of_round))
      {
        s = std::move(trial);
        has_gained = true;
        failures = 0;
      }
      else
        ++failures;
    }
    return has_gained;
  }

  // Takes out the cone that is missed least but for `rank` others. Returns whether that is possible.
  bool take_out(Curved_cones& s, std::size_t rank)
  {
    if(s.cones.size() <= rank || fit_.are_too_few(s.cones.size() - 1))
      return false;
    const Cone_fit::Losses losses = fit_.losses(s);
    const Eigen::VectorXd& loss = losses.growth;
    std::vector<std::size_t> order(s.cones.size());
    for(std::size_t i = 0; i < order.size(); ++i)
      order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j)
              { return std::make_pair(loss[Eigen::Index(i)], s.cones[i]) < std::make_pair(loss[Eigen::Index(j)], s.cones[j]); });
    const Eigen::Index i = Eigen::Index(order[rank]), n_after = s.curvatures.size() - i - 1;
    s.cones.erase(s.cones.begin() + std::ptrdiff_t(i));
    s.curvatures.resize(losses.curvatures.rows() - 1);
    s.curvatures << losses.curvatures.col(i).head(i), losses.curvatures.col(i).tail(n_after);
    fit_.fit(s);
    return true;
  }

  // The derivative by curvature.
  Eigen::VectorXd potential(const Curved_cones& s) { return model_.response(fit_.load_weights(s.u).cwiseProduct(s.u)); }

  double potential_at_cones(const Curved_cones& s, const Eigen::VectorXd& p) const
  {
    if(!model_.is_closed() || s.cones.empty() || fit_.are_too_few(s.cones.size()))
      return 0;
    double sum = 0;
    for(Index c : s.cones)
      sum += p[c];
    return sum / double(s.cones.size());
  }

private:
  static constexpr double gain_of_round = 5e-4; // a part of |u|_p; for less, a round is not worth its solutions

  struct Proposal { Index to; double gain; };

  Curved_cones with(const Curved_cones& s, Index v, double worth = std::numeric_limits<double>::infinity())
  {
    Curved_cones result = s;
    result.cones.push_back(v);
    if(s.curvatures.size() > 0 && s.spread == 0)
    {
      result.curvatures.conservativeResize(result.curvatures.size() + 1);
      result.curvatures[result.curvatures.size() - 1] = 0;
    }
    else
      result.curvatures.resize(0);
    judge(result, worth);
    return result;
  }

  // `worth`: what is no better may be judged roughly
  void judge(Curved_cones& s, double worth)
  {
    if(are_angles_kept_)
      fit_.apply(s);
    else
      fit_.fit(s, worth);
  }

  // Where cones want to go
  struct Slope
  {
    double weight; // the sum of the weights of the load
    double size;   // the sum of w u^2: a part of it is what |u|_p falls by, if |u|_p^p / p falls by that
    Eigen::VectorXd potential;
  };

  Slope slope_of(const Curved_cones& s)
  {
    const Eigen::VectorXd w = fit_.load_weights(s.u), load = w.cwiseProduct(s.u);
    return {w.sum(), load.dot(s.u), model_.response(load)};
  }

  // Where each cone is to go.
  std::vector<Proposal> proposals(const Curved_cones& s, const Slope& slope, const std::vector<double>& stiffness) const
  {
    std::vector<Proposal> result;
    std::vector<Index> taken = s.cones;
    for(std::size_t i = 0; i < s.cones.size(); ++i)
    {
      result.push_back(walk(s, i, slope.potential, stiffness[i] * slope.weight, taken));
      taken.push_back(result.back().to);
    }
    return result;
  }

  // Downhill from vertex to vertex, as long as the gain grows.
  Proposal walk(const Curved_cones& s, std::size_t i, const Eigen::VectorXd& p, double stiffness, const std::vector<Index>& taken) const
  {
    const double four_pi = 4 * Number_constants<double>::pi(), k = s.curvatures[Eigen::Index(i)];
    const Index c = s.cones[i];
    const auto gain = [&](Index v, double d)
    {
      return k * (p[c] - p[v]) - (fit_.exponent() - 1) * k * k * stiffness * d * d / four_pi * (0.5 + std::log(1 + 1 / (2 * d)));
    };
    const Cone_surface& surface = model_.surface();
    Proposal best = {c, 0};
    double distance = 0;
    for(bool goes_on = true; goes_on; )
    {
      goes_on = false;
      const Index v = best.to;
      double next_distance = distance;
      surface.for_each_neighbour(v, [&](Index w, double length)
      {
        const double d = distance + length / width_, g = gain(w, d);
        if(g > best.gain && !surface.is_border_vertex(w) && std::find(taken.begin(), taken.end(), w) == taken.end())
        {
          best = {w, g};
          next_distance = d;
          goes_on = true;
        }
      });
      distance = next_distance;
    }
    return best;
  }

  bool move_all(Curved_cones& s, const Slope& slope, std::vector<double>& stiffness)
  {
    for(int attempt = 0; attempt < 4; ++attempt)
    {
      const std::vector<Proposal> to = proposals(s, slope, stiffness);
      Curved_cones trial = s;
      for(std::size_t i = 0; i < to.size(); ++i)
        trial.cones[i] = to[i].to;
      if(trial.cones == s.cones)
        return false;
      judge(trial, s.value);
      if(trial.value < s.value)
      {
        s = std::move(trial);
        for(double& x : stiffness)
          x = (std::max)(x / 2, 1. / 64);
        return true;
      }
      for(double& x : stiffness)
        x *= 4;
    }
    return false;
  }

  // The most promising first; what promises next to nothing is not tried.
  bool move_one(Curved_cones& s, const Slope& slope, std::vector<double>& stiffness)
  {
    for(double& x : stiffness)
      x = (std::max)(x / 64, 1. / 64); // where all together did not do
    const std::vector<Proposal> to = proposals(s, slope, stiffness);
    std::vector<std::size_t> order;
    for(std::size_t i = 0; i < to.size(); ++i)
      if(to[i].to != s.cones[i] && to[i].gain > gain_of_round * slope.size)
        order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return to[i].gain > to[j].gain; });
    for(std::size_t i : order)
    {
      Index last = s.cones[i];
      for(int attempt = 0; attempt < 3; ++attempt, stiffness[i] *= 4)
      {
        const Index next = walk(s, i, slope.potential, stiffness[i] * slope.weight, s.cones).to;
        if(next == s.cones[i])
          break;
        if(next == last)
          continue;
        last = next;
        Curved_cones trial = s;
        trial.cones[i] = next;
        judge(trial, s.value);
        if(trial.value < s.value)
        {
          s = std::move(trial);
          return true;
        }
      }
    }
    return false;
  }

  Cone_model& model_;
  Cone_fit& fit_;
  const double width_;
  bool are_angles_kept_ = false;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_SPARSE_CONES_H
