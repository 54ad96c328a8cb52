// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The best curvatures of cones at given places: those that make
//
//     |u|_p = (sum of w_v |u_v|^p)^{1/p},   u = u_flat + sum of k_c G_c + spread G_spread - shift,   sum of w_v = 1
//
// least (Cone_model.h). For p = 2 this is a quadratic function of as many unknowns as there are cones; on a closed surface the curvatures have a
// given sum, and where the scale of u does not matter `shift` is an unknown. For larger p it is done by Newton's method for |u|_p^p, whose Hessian
// is p - 1 times the Gram matrix of the columns with the weights w |u|^{p-2}. The largest |u| is approached by powers of two, p = 4, 8, ... (n
// vertices: n^{-1/p} max |u| <= |u|_p <= max |u| for equal weights).
// Where p is large only the few vertices with a large |u| have a weight, and may leave some of the unknowns undetermined: where steps do not make it
// better, something of the Gram matrix for p = 2 is added, which determines all of them (Levenberg and Marquardt's method).
// Curvatures are kept within bounds, with their sum (bounded_minimum.h).
// At cones u is not linear in the curvature: there the columns of the Hessian are those of the derivatives.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_FIT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_FIT_H

#include <CGAL/Conformal_equivalence/internal/Cones/Cone_model.h>
#include <CGAL/Conformal_equivalence/internal/Cones/bounded_minimum.h>
#include <CGAL/Conformal_equivalence/internal/Cones/dense_systems.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Cones with their curvatures, and the u that these lead to in the model.
struct Curved_cones
{
  std::vector<std::uint32_t> cones;
  Eigen::VectorXd curvatures;  // by cone, radians
  double spread = 0;           // the curvature that is spread equally over a closed surface that has too few cones
  double shift = 0;
  Eigen::VectorXd u;           // less `shift`
  double value = std::numeric_limits<double>::infinity(); // |u|_p
  std::vector<std::uint32_t> flattened; // where cones were whose curvatures were rounded to zero

  bool has(std::uint32_t v) const { return std::find(cones.begin(), cones.end(), v) != cones.end(); }
  double largest() const { return u.size() > 0 ? u.cwiseAbs().maxCoeff() : std::numeric_limits<double>::infinity(); }
};

class Cone_fit
{
  typedef std::uint32_t Index;
  typedef Cone_model Model;

public:
  // `weights`: by vertex, with the sum 1. `has_shift`: whether the scale of u does not matter; on closed surfaces it never does. Keeps a reference.
  Cone_fit(Model& model, Eigen::VectorXd weights, bool has_shift)
    : model_(model), weights_(std::move(weights)), root_weights_(weights_.cwiseSqrt()), has_shift_(has_shift || model.is_closed())
  {}

  // p, a power of two
  void set_exponent(int p) { exponent_ = p; }
  int exponent() const { return exponent_; }

  const Eigen::VectorXd& vertex_weights() const { return weights_; }
  bool has_shift() const { return has_shift_; }

  // Angles are to be positive, and more than two turns hardly help, and cost flips.
  double largest_curvature() const { return 7 * pi() / 4; }
  double least_curvature(std::size_t number_of_cones) const
  {
    const double turns = -2 * pi();
    return model_.is_closed() && number_of_cones > 0 ? (std::min)(turns, 2 * model_.total_curvature() / double(number_of_cones)) : turns;
  }

  // Are there so few cones on a closed surface that they cannot bear the curvature?
  bool are_too_few(std::size_t number_of_cones) const
  {
    const double total = model_.total_curvature();
    return model_.is_closed() && (total > largest_curvature() * double(number_of_cones) || (total < 0 && number_of_cones == 0));
  }

  // The best curvatures. Begins with those of `s`, if these are as many as there are cones, and within bounds. Ends as soon as it is seen that |u|_p
  // will not be less than `worth`.
  void fit(Curved_cones& s, double worth = std::numeric_limits<double>::infinity())
  {
    const Columns x = columns(s);
    Guess y;
    if(exponent_ > 2 && can_go_on(s))
      start(unknowns(s), exponent_, x, y);
    else
    {
      start(least_squares(x), exponent_ > 2 ? 4 : 2, x, y);
      for(int p = 4; p < exponent_; p *= 2)
      {
        improve(p, 0.1, std::numeric_limits<double>::infinity(), x, y); // only a place to begin
        judge(2 * p, y);
      }
    }
    if(exponent_ > 2)
      improve(exponent_, 1e-4, worth, x, y);
    take(y, s);
  }

  // u and |u|_p for the curvatures that there are; the best shift, if it is free.
  void apply(Curved_cones& s)
  {
    const Columns x = columns(s);
    if(!has_shift_)
      s.shift = 0;
    Guess y;
    start(unknowns(s), exponent_, x, y);
    for(int i = 0; has_shift_ && i < (exponent_ > 2 ? 8 : 1); ++i)
    {
      const Eigen::VectorXd w = load_weights(y);
      const double by = w.dot(y.u) / w.sum() / (exponent_ - 1);
      y.unknowns[y.unknowns.size() - 1] += by;
      y.linear.array() -= by;
      y.u.array() -= by;
      judge(exponent_, y);
    }
    take(y, s);
  }

  // w_v |u_v|^{p-2}, up to a factor: times u_v, the derivative of |u|_p^p, up to a factor.
  Eigen::VectorXd load_weights(const Eigen::VectorXd& u) const
  {
    Guess y;
    y.u = u;
    judge(exponent_, y);
    return load_weights(y);
  }

  // What becomes of |u|_p^p without one of the cones, to second order.
  struct Losses
  {
    Eigen::VectorXd growth;    // by cone: of half of it, in the units of `load_weights()`
    Eigen::MatrixXd curvatures; // by cone: the column of the curvatures of all cones then
  };

  Losses losses(const Curved_cones& s)
  {
    const Columns x = columns(s);
    Guess y;
    start(unknowns(s), exponent_, x, y);
    const Eigen::Index n = Eigen::Index(s.cones.size()), m = x.values.cols(), size = m + (model_.is_closed() ? 1 : 0);
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(size, size);
    k.topLeftCorner(m, m) = hessian(x, y).gram + 1e-8 * mean_gram(x);
    if(model_.is_closed())
      k.row(m).head(number_of_curvatures(x)).setOnes();
    k.col(size - 1).head(m) = k.row(size - 1).head(m);
    const Eigen::MatrixXd inverse = dense_inverse(k);
    Losses result;
    result.growth = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity());
    result.curvatures = s.curvatures.replicate(1, n);
    for(Eigen::Index i = 0; i < n; ++i)
    {
      if(!(inverse(i, i) > 0))
        continue;
      result.growth[i] = s.curvatures[i] * s.curvatures[i] / inverse(i, i);
      result.curvatures.col(i) -= s.curvatures[i] / inverse(i, i) * inverse.col(i).head(n);
    }
    return result;
  }

  // The Gram matrix of the columns of the cones with the weights of `s`, less what the best shift takes away.
  Eigen::MatrixXd gram(const Curved_cones& s)
  {
    const Eigen::Index n = Eigen::Index(s.cones.size());
    const Columns x = columns(s);
    Guess y;
    start(unknowns(s), exponent_, x, y);
    const Eigen::MatrixXd k = hessian(x, y).gram;
    Eigen::MatrixXd result = k.topLeftCorner(n, n);
    if(has_shift_)
    {
      const Eigen::Index shift = k.cols() - 1;
      result -= k.col(shift).head(n) * k.row(shift).head(n) / k(shift, shift);
    }
    return result;
  }

private:
  static double pi() { return Number_constants<double>::pi(); }

  // u as it depends on the unknowns: the curvatures of the cones, the spread one, if there is one, and the shift, if it is unknown.
  struct Columns
  {
    std::vector<Index> cones;
    std::vector<Cone_apex> apexes; // of the cones
    Eigen::VectorXd excess_at_zero; // of the cones, which is in u_flat
    Eigen::MatrixXd values;        // what is linear, by unknown
    std::vector<Model::Column> kept; // the same as the model keeps it; nothing for the shift
  };

  // Unknowns, with u and what is known of its powers.
  struct Guess
  {
    Eigen::VectorXd unknowns;
    Eigen::VectorXd linear; // u without what it has more at cones
    Eigen::VectorXd u;
    double largest = 0;     // |u|
    Eigen::ArrayXd powers;  // |u / largest|^p
    double value = std::numeric_limits<double>::infinity(); // |u|_p
  };

  // The Gram matrix of the derivatives with the weights |u / largest|^{p-2}, and the derivative by the unknowns in the same units.
  struct Hessian
  {
    Eigen::MatrixXd gram;
    Eigen::VectorXd slope;
  };

  bool is_spread(const Curved_cones& s) const { return are_too_few(s.cones.size()); }
  Eigen::Index number_of_curvatures(const Columns& x) const { return x.values.cols() - (has_shift_ ? 1 : 0); }

  Columns columns(const Curved_cones& s)
  {
    Columns result;
    const Eigen::Index n = Eigen::Index(s.cones.size()), n_curvatures = n + (is_spread(s) ? 1 : 0);
    result.cones = s.cones;
    result.values.resize(weights_.size(), n_curvatures + (has_shift_ ? 1 : 0));
    result.excess_at_zero.resize(n);
    for(Eigen::Index i = 0; i < n; ++i)
    {
      const Index c = s.cones[std::size_t(i)];
      result.apexes.push_back(model_.apex(c));
      result.excess_at_zero[i] = result.apexes.back().excess(0).first;
      result.kept.push_back(model_.column(c));
      result.values.col(i) = *result.kept.back();
    }
    if(n_curvatures > n)
    {
      result.kept.push_back(model_.spread_column());
      result.values.col(n) = *result.kept.back();
    }
    if(has_shift_)
    {
      result.kept.emplace_back();
      result.values.col(n_curvatures).setConstant(-1);
    }
    return result;
  }

  // The Gram matrix for p = 2
  Eigen::MatrixXd mean_gram(const Columns& x)
  {
    if(x.values.cols() < many_dense_unknowns)
      return gram_of(root_weights_.asDiagonal() * x.values);
    kept_gram_ = changed_gram(x);
    gram_columns_ = x.kept;
    return kept_gram_;
  }

  // Of the last columns for which this was asked most are here again, as a rule, where there are many: products of these are known.
  Eigen::MatrixXd changed_gram(const Columns& x) const
  {
    std::map<const Eigen::VectorXd*, Eigen::Index> place;
    for(std::size_t i = 0; i < gram_columns_.size(); ++i)
      place[gram_columns_[i].get()] = Eigen::Index(i);
    const Eigen::Index m = x.values.cols();
    std::vector<Eigen::Index> before, changed; // by column: where it was, or -1; and those that were not
    for(Eigen::Index i = 0; i < m; ++i)
    {
      const auto known = place.find(x.kept[std::size_t(i)].get());
      before.push_back(known == place.end() ? -1 : known->second);
      if(before.back() < 0)
        changed.push_back(i);
    }
    if(2 * Eigen::Index(changed.size()) > m)
      return gram_of(root_weights_.asDiagonal() * x.values);
    Eigen::MatrixXd result(m, m), fresh(x.values.rows(), Eigen::Index(changed.size()));
    for(Eigen::Index j = 0; j < m; ++j)
      for(Eigen::Index i = 0; i < m; ++i)
        result(i, j) = before[std::size_t(i)] < 0 || before[std::size_t(j)] < 0 ? 0. : kept_gram_(before[std::size_t(i)], before[std::size_t(j)]);
    for(std::size_t j = 0; j < changed.size(); ++j)
      fresh.col(Eigen::Index(j)) = weights_.cwiseProduct(x.values.col(changed[j]));
    const Eigen::MatrixXd products = x.values.transpose() * fresh;
    for(std::size_t j = 0; j < changed.size(); ++j)
    {
      result.col(changed[j]) = products.col(Eigen::Index(j));
      result.row(changed[j]) = products.col(Eigen::Index(j)).transpose();
    }
    return result;
  }

  static Eigen::MatrixXd gram_of(const Eigen::MatrixXd& x)
  {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(x.cols(), x.cols());
    if(x.cols() > 0) // Eigen's rankUpdate() refers to the first entry
      result.template selfadjointView<Eigen::Lower>().rankUpdate(x.transpose());
    return result.template selfadjointView<Eigen::Lower>();
  }

  Eigen::VectorXd unknowns(const Curved_cones& s) const
  {
    const Eigen::Index n = s.curvatures.size();
    Eigen::VectorXd y(n + (is_spread(s) ? 1 : 0) + (has_shift_ ? 1 : 0));
    y.head(n) = s.curvatures;
    if(is_spread(s))
      y[n] = s.spread;
    if(has_shift_)
      y[y.size() - 1] = s.shift;
    return y;
  }

  void take(Guess& y, Curved_cones& s) const
  {
    const Eigen::Index n = Eigen::Index(s.cones.size());
    s.curvatures = y.unknowns.head(n);
    s.spread = is_spread(s) ? y.unknowns[n] : 0;
    s.shift = has_shift_ ? y.unknowns[y.unknowns.size() - 1] : 0;
    s.u.swap(y.u);
    s.value = y.value;
  }

  // Are there curvatures to begin with?
  bool can_go_on(const Curved_cones& s) const
  {
    if(std::size_t(s.curvatures.size()) != s.cones.size() || !s.curvatures.allFinite() || (is_spread(s) && s.spread == 0))
      return false;
    const double rounding = 1e-9, total = s.curvatures.sum() + (is_spread(s) ? s.spread : 0);
    return (s.cones.empty() || (s.curvatures.maxCoeff() <= largest_curvature() && s.curvatures.minCoeff() >= least_curvature(s.cones.size())))
        && (!model_.is_closed() || std::abs(total - model_.total_curvature()) <= rounding);
  }

  void start(const Eigen::VectorXd& unknowns, int p, const Columns& x, Guess& y) const
  {
    y.unknowns = unknowns;
    y.linear = model_.flat() + x.values * unknowns;
    find_u(x, y);
    judge(p, y);
  }

  // u from what is linear in it
  void find_u(const Columns& x, Guess& y) const
  {
    y.u = y.linear;
    for(std::size_t i = 0; i < x.cones.size(); ++i)
      y.u[x.cones[i]] += x.apexes[i].excess(y.unknowns[Eigen::Index(i)]).first - x.excess_at_zero[Eigen::Index(i)];
  }

  // |u|_p
  void judge(int p, Guess& y) const
  {
    y.largest = y.u.cwiseAbs().maxCoeff();
    y.value = y.largest;
    if(!(y.largest > 0) || !std::isfinite(y.largest))
    {
      y.powers = Eigen::ArrayXd::Ones(y.u.size());
      return;
    }
    y.powers = (y.u.array() / y.largest).square();
    for(int q = 2; q < p; q *= 2)
      y.powers *= y.powers;
    y.value *= std::pow(weights_.dot(y.powers.matrix()), 1. / p);
  }

  Eigen::VectorXd load_weights(const Guess& y) const
  {
    if(exponent_ == 2 || !(y.largest > 0))
      return weights_;
    const double tiny = 1e-30;
    return weights_.array() * y.powers / ((y.u.array() / y.largest).square() + tiny);
  }

  // Vertices whose weights are next to nothing are left out: of large powers nearly all.
  Hessian hessian(const Columns& x, const Guess& y) const
  {
    const Eigen::VectorXd w = load_weights(y);
    const double tiny = 1e-5 / double(w.size()) * w.sum(); // all in all they are less than steps are accurate
    std::vector<Eigen::Index> rows;
    for(Eigen::Index v = 0; v < w.size(); ++v)
      if(w[v] > tiny)
        rows.push_back(v);
    const Eigen::Index n = Eigen::Index(rows.size()), m = x.values.cols();
    Eigen::VectorXd root(n), load(n);
    for(Eigen::Index i = 0; i < n; ++i)
    {
      root[i] = std::sqrt(w[rows[std::size_t(i)]]);
      load[i] = root[i] * y.u[rows[std::size_t(i)]];
    }
    Eigen::MatrixXd values(n, m);
    for(Eigen::Index j = 0; j < m; ++j)
    {
      const double* const column = x.values.data() + j * x.values.rows();
      for(Eigen::Index i = 0; i < n; ++i)
        values(i, j) = root[i] * column[rows[std::size_t(i)]];
    }
    Hessian result = {gram_of(values), values.transpose() * load};
    for(std::size_t i = 0; i < x.cones.size(); ++i)
    {
      const Eigen::Index c = x.cones[i], k = Eigen::Index(i);
      const double more = x.apexes[i].excess(y.unknowns[k]).second;
      const Eigen::VectorXd row = w[c] * more * x.values.row(c).transpose();
      result.gram.row(k) += row.transpose();
      result.gram.col(k) += row;
      result.gram(k, k) += w[c] * more * more;
      result.slope[k] += w[c] * more * y.u[c];
    }
    return result;
  }

  // The least value of x^T k x / 2 + b^T x with admitted curvatures, from `y`, which has such.
  Eigen::VectorXd best_admitted(const Columns& x, const Eigen::MatrixXd& k, const Eigen::VectorXd& b, const Eigen::VectorXd& y) const
  {
    const double infinity = std::numeric_limits<double>::infinity();
    const Eigen::Index n = Eigen::Index(x.cones.size());
    Eigen::VectorXd least = Eigen::VectorXd::Constant(b.size(), -infinity), most = -least;
    least.head(n).setConstant(least_curvature(x.cones.size()));
    most.head(n).setConstant(largest_curvature());
    std::vector<char> is_in_sum;
    if(model_.is_closed())
      is_in_sum.assign(std::size_t(number_of_curvatures(x)), 1);
    return Bounded_minimum(k, b, least, most, is_in_sum).from(y);
  }

  // The solution for p = 2, as if u were linear at cones, too: there one vertex does not matter.
  Eigen::VectorXd least_squares(const Columns& x)
  {
    Eigen::VectorXd flat = model_.flat(), y = Eigen::VectorXd::Zero(x.values.cols());
    for(std::size_t i = 0; i < x.cones.size(); ++i)
      flat[x.cones[i]] -= x.excess_at_zero[Eigen::Index(i)];
    const Eigen::Index n = Eigen::Index(x.cones.size()), n_curvatures = number_of_curvatures(x);
    if(model_.is_closed() && n_curvatures > 0)
    {
      if(n_curvatures > n)
        y[n] = model_.total_curvature();
      else
        y.head(n).setConstant(model_.total_curvature() / double(n));
    }
    return best_admitted(x, mean_gram(x), x.values.transpose() * weights_.cwiseProduct(flat), y);
  }

  // Newton's method for |u|_p^p, until a step gains no more than a part of `gain`.
  void improve(int p, double gain, double worth, const Columns& x, Guess& y)
  {
    const int most_steps = 12;
    const double longer = 1.5; // where |u|^p still grows by a factor, steps are too short
    double damping = 0;        // the part that the Gram matrix for p = 2 has
    Eigen::MatrixXd mean;      // that matrix
    Guess trial;
    for(int i = 0; i < most_steps && y.value > 0; ++i)
    {
      const Hessian h = hessian(x, y);
      const double before = y.value;
      while(!(trial.value < before) && damping < 1)
      {
        Eigen::MatrixXd k = (p - 1) / longer * h.gram;
        if(damping > 0)
          k += (p - 1) / longer * damping * mean;
        const Eigen::VectorXd to = best_admitted(x, k, h.slope - k * y.unknowns, y.unknowns) - y.unknowns, by = x.values * to;
        for(double step = 1; step > 0.1 && !(trial.value < before); step /= 2)
        {
          trial.unknowns = y.unknowns + step * to;
          trial.linear = y.linear + step * by;
          find_u(x, trial);
          judge(p, trial);
        }
        if(trial.value < before)
          break;
        if(damping == 0)
          mean = mean_gram(x);
        damping = damping == 0 ? 1e-8 : 1000 * damping;
      }
      if(!(trial.value < before))
        return;
      std::swap(y, trial);
      trial.value = std::numeric_limits<double>::infinity();
      const double gained = before - y.value;
      if(!(gained > gain * before) || y.value - 4 * gained > worth) // steps gain less and less
        return;
    }
  }

  Model& model_;
  const Eigen::VectorXd weights_, root_weights_;
  const bool has_shift_;
  int exponent_ = 2;
  std::vector<Model::Column> gram_columns_; // of which products are kept
  Eigen::MatrixXd kept_gram_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_FIT_H
