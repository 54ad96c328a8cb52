// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Cones with curvatures that are multiples of q = 2 pi / n. At given places
//
//     |u|^2 = |u(k)|^2 + (q m - k)^T M (q m - k)
//
// for the integers m, with the best curvatures k and the Gram matrix M of the columns (Cone_fit.h): the integers wanted are the coordinates of a
// closest lattice vector, on a closed surface in the sublattice of those with the right sum. For larger p this holds to second order, so that the
// closest vectors are candidates, and so are those of k rounded one by one; the measure decides. Then the cones move with these curvatures, and
// integers are found anew; where cones have come to nothing, others are born where the dual potential is extreme (Sparse_cones.h), on closed
// surfaces in pairs.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_QUANTIZED_CONES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_QUANTIZED_CONES_H

#include <CGAL/Conformal_equivalence/internal/Cones/Cone_fit.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Cone_model.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Sparse_cones.h>
#include <CGAL/Conformal_equivalence/internal/Cones/nearest_integers.h>
#include <CGAL/Conformal_equivalence/internal/Lattices/closest_vector.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Quantized_cones
{
  typedef std::uint32_t Index;
  typedef std::vector<long> Multiples;

public:
  typedef std::function<double(const Curved_cones&)> Measure;

  // Keeps references. `largest_exponent`: of the norms by which cones are moved; 2 for the root mean square
  Quantized_cones(Cone_model& model, Cone_fit& fit, Sparse_cones& search, Measure measure, long quanta_of_turn, int largest_exponent)
    : model_(model), fit_(fit), search_(search), measure_(std::move(measure)), n_(quanta_of_turn), largest_exponent_(largest_exponent)
  {}

  // Rounds the curvatures of `s`, and goes on from there. No more than `most` cones. Returns whether there are such curvatures.
  bool quantize(Curved_cones& s, std::size_t most)
  {
    if(!round(s))
      return false;
    improve(s, most);
    return true;
  }

  // The same with curvatures that are multiples already.
  void improve(Curved_cones& s, std::size_t most)
  {
    fit_.apply(s);
    move(s);
    for(int i = 0; i < most_rounds; ++i)
    {
      Curved_cones trial = s;
      const bool has_changed = round_again(trial);
      if(has_changed)
        move(trial);
      const bool is_born = give_birth(trial, most);
      if(!(has_changed || is_born) || !(measure_(trial) < (1 - least_gain) * measure_(s)))
        break;
      s = std::move(trial);
    }
  }

  // Moves the cones with the curvatures that they have; for some powers, the least and the factor from one to the next of which are given.
  void move(Curved_cones& s, int first = 16, int factor = 2, int most_rounds_of_power = 20)
  {
    search_.keep_angles(true);
    Curved_cones best = s;
    for(int p = (std::min)(first, largest_exponent_); p <= largest_exponent_; p *= factor)
    {
      fit_.set_exponent(p);
      fit_.apply(s);
      search_.slide(s, most_rounds_of_power);
      if(measure_(s) < measure_(best))
        best = s;
    }
    s = std::move(best);
    search_.keep_angles(false);
    fit_.apply(s);
  }

private:
  static constexpr int most_rounds = 4;            // the second seldom changes anything
  static constexpr double least_gain = 1e-3;       // a part of the measure
  static constexpr std::size_t most_candidates = 12; // by each of the norms
  static constexpr std::size_t most_nodes = 20000; // of the search for closest vectors: some milliseconds

  double quantum() const { return 2 * Number_constants<double>::pi() / double(n_); }

  // What the multiples of a closed surface sum up to
  long sum() const { return std::lround(model_.total_curvature() / quantum()); }

  // An angle is a quantum at least.
  bool is_admitted(const Multiples& m) const
  {
    const long least = std::lround(std::floor(fit_.least_curvature(m.size()) / quantum() + 1e-9));
    return std::all_of(m.begin(), m.end(), [&](long k) { return least <= k && k < n_; });
  }

  // The best multiples for the places of `s`. Cones that come to nothing are left out.
  bool round(Curved_cones& s)
  {
    Curved_cones best;
    double least = std::numeric_limits<double>::infinity();
    for(const Multiples& m : candidates(s))
    {
      Curved_cones trial = s;
      for(std::size_t i = 0; i < m.size(); ++i)
        trial.curvatures[Eigen::Index(i)] = double(m[i]) * quantum();
      fit_.apply(trial);
      const double now = measure_(trial);
      if(now < least || best.u.size() == 0)
      {
        least = now;
        best = std::move(trial);
      }
    }
    if(best.u.size() == 0)
      return false;
    s = without_flat_ones(best);
    return true;
  }

  static Curved_cones without_flat_ones(const Curved_cones& s)
  {
    Curved_cones result = s;
    result.cones.clear();
    std::vector<double> curvatures;
    for(std::size_t i = 0; i < s.cones.size(); ++i)
      if(s.curvatures[Eigen::Index(i)] != 0)
      {
        result.cones.push_back(s.cones[i]);
        curvatures.push_back(s.curvatures[Eigen::Index(i)]);
      }
      else
        result.flattened.push_back(s.cones[i]);
    result.curvatures = Eigen::VectorXd::Map(curvatures.data(), Eigen::Index(curvatures.size()));
    return result;
  }

  // Begins with the best curvatures at the places of now. Returns whether others are better.
  bool round_again(Curved_cones& s)
  {
    const Curved_cones before = s;
    fit_.set_exponent(largest_exponent_);
    fit_.fit(s);
    if(!round(s) || !(measure_(s) < measure_(before)))
    {
      s = before;
      return false;
    }
    return true;
  }

  // Integers that are worth a look.
  std::vector<Multiples> candidates(Curved_cones& s)
  {
    std::vector<Multiples> result;
    const std::size_t k = s.cones.size();
    const auto add = [&](const Multiples& m)
    {
      if(m.size() == k && is_admitted(m) && std::find(result.begin(), result.end(), m) == result.end())
        result.push_back(m);
    };
    if(k == 0)
    {
      if(!model_.is_closed() || sum() == 0)
        add(Multiples());
      return result;
    }
    add(rounded(s));
    for(int p = 2; p <= largest_exponent_; p *= 4)
    {
      Curved_cones best = s;
      fit_.set_exponent(p);
      best.curvatures.resize(0);
      fit_.fit(best);
      for(const Multiples& m : closest(best))
        add(m);
    }
    fit_.set_exponent(largest_exponent_);
    return result;
  }

  // The curvatures rounded one by one, with the right sum.
  Multiples rounded(const Curved_cones& s) const
  {
    std::vector<double> angles;
    for(double k : s.curvatures)
      angles.push_back(double(n_) - k / quantum());
    Multiples result = nearest_integers(angles, model_.is_closed() ? n_ * long(angles.size()) - sum() : 0);
    for(long& k : result)
      k = n_ - k;
    return result;
  }

  // By the Gram matrix; on a closed surface of the differences from the last cone.
  std::vector<Multiples> closest(const Curved_cones& s)
  {
    const Eigen::Index k = s.curvatures.size(), d = model_.is_closed() ? k - 1 : k;
    const Eigen::MatrixXd all = fit_.gram(s);
    Eigen::MatrixXd gram = all.topLeftCorner(d, d);
    if(model_.is_closed())
      gram += -all.col(d).head(d) * Eigen::RowVectorXd::Ones(d) - Eigen::VectorXd::Ones(d) * all.row(d).head(d)
              + Eigen::MatrixXd::Constant(d, d, all(d, d));
    std::vector<Multiples> result;
    for(const Lattice_vector& x : Reduced_lattice(gram).nearest_vectors(s.curvatures.head(d) / quantum(), most_candidates, most_nodes))
    {
      Multiples m(x.coefficients.begin(), x.coefficients.end());
      if(model_.is_closed())
      {
        long last = sum();
        for(long y : m)
          last -= y;
        m.push_back(last);
      }
      result.push_back(m);
    }
    return result;
  }

  // Where there may be more cones: one of a quantum, or two of opposite ones. Returns whether that makes it better.
  bool give_birth(Curved_cones& s, std::size_t most)
  {
    bool has_gained = false;
    while(n_ > 1 && s.cones.size() + (model_.is_closed() ? 2 : 1) <= most)
    {
      fit_.set_exponent((std::min)(8, largest_exponent_));
      fit_.apply(s);
      const std::pair<Index, Index> extremes = search_.extremes(s, search_.potential(s));
      if(extremes.first == Sparse_cones::null_index || extremes.first == extremes.second)
        break;
      Curved_cones best;
      double least = (1 - least_gain) * measure_(s);
      for(int signs = 0; signs < (model_.is_closed() ? 1 : 2); ++signs)
      {
        Curved_cones trial = s;
        if(signs == 0)
          put(trial, extremes.first, quantum());
        if(signs == 1 || model_.is_closed())
          put(trial, extremes.second, -quantum());
        move(trial);
        if(measure_(trial) < least)
        {
          least = measure_(trial);
          best = std::move(trial);
        }
      }
      if(best.u.size() == 0)
        break;
      s = std::move(best);
      has_gained = true;
    }
    return has_gained;
  }

  static void put(Curved_cones& s, Index v, double curvature)
  {
    s.cones.push_back(v);
    s.curvatures.conservativeResize(s.curvatures.size() + 1);
    s.curvatures[s.curvatures.size() - 1] = curvature;
    if(!s.flattened.empty())
      s.flattened.pop_back();
  }

  Cone_model& model_;
  Cone_fit& fit_;
  Sparse_cones& search_;
  const Measure measure_;
  const long n_;
  const int largest_exponent_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_QUANTIZED_CONES_H
