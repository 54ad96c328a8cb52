// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The best curvatures of cones at given places: those that make
//
//     |u|_p = (sum of w_v |u_v|^p)^{1/p},   u = u_flat + sum of k_c G_c + spread G_spread - shift,   sum of w_v = 1
//
// least (Cone_model.h). For p = 2 these are normal equations, with as many unknowns as there are cones; on a closed surface the curvatures have a
// given sum, and where the scale of u does not matter `shift` is an unknown. For larger p the normal equations are weighted by |u|^{p-2} and solved
// again and again: these are Newton's method for |u|_p^p, as its Hessian is p - 1 times their matrix. The largest |u| is approached by powers of
// two, p = 4, 8, ... (n vertices: n^{-1/p} max |u| <= |u|_p <= max |u| for equal weights).
// At cones u is not linear in the curvature: there the columns are those of the derivatives, and what is left of u counts as u_flat.
// Curvatures are kept within bounds: one that violates them most is held at its bound, and the rest is solved again.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_FIT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_FIT_H

#include <CGAL/Conformal_equivalence/internal/Cones/Cone_model.h>

#include <Eigen/Dense>

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

template <typename NT>
class Cone_fit
{
  typedef std::uint32_t Index;
  typedef Cone_model<NT> Model;

public:
  // `weights`: by vertex, with the sum 1. `has_shift`: whether the scale of u does not matter; on closed surfaces it never does. Keeps a reference.
  Cone_fit(Model& model, Eigen::VectorXd weights, bool has_shift)
    : model_(model), weights_(std::move(weights)), has_shift_(has_shift || model.is_closed())
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

  // The best curvatures. Begins with those of `s` if there are as many as cones, which are within bounds.
  void fit(Curved_cones& s)
  {
    const std::vector<Column> x = columns(s);
    Eigen::VectorXd y;
    const bool goes_on = std::size_t(s.curvatures.size()) == s.cones.size() && exponent_ > 2 && (!is_spread(s) || s.spread != 0);
    if(goes_on)
      y = unknowns(s);
    for(int p = goes_on ? exponent_ : 2; p <= exponent_; p *= 2)
      improve(p, x, s, y);
    take(y, s);
    evaluate(x, y, s);
  }

  // u and |u|_p for the curvatures that there are; the best shift, if it is free.
  void apply(Curved_cones& s)
  {
    const std::vector<Column> x = columns(s);
    if(!has_shift_)
      s.shift = 0;
    Eigen::VectorXd y = unknowns(s);
    evaluate(x, y, s);
    if(!has_shift_)
      return;
    for(int i = 0; i < (exponent_ > 2 ? 8 : 1); ++i)
    {
      const Eigen::VectorXd w = load_weights(s.u, exponent_);
      const double by = w.dot(s.u) / w.sum() / (exponent_ - 1);
      s.shift += by;
      s.u.array() -= by;
    }
    s.value = value(s.u, exponent_);
  }

  // w_v |u_v|^{p-2}, up to a factor: times u_v, the derivative of |u|_p^p, up to a factor.
  Eigen::VectorXd load_weights(const Eigen::VectorXd& u) const { return load_weights(u, exponent_); }

  // By how much half of |u|_p^p, in the units of `load_weights()`, would grow without each of the cones, to second order.
  Eigen::VectorXd losses(const Curved_cones& s)
  {
    const std::vector<Column> x = columns(s);
    const Eigen::MatrixXd inverse = system(tangent(x, unknowns(s), s), load_weights(s.u, exponent_)).first.fullPivLu().inverse();
    Eigen::VectorXd result(Eigen::Index(s.cones.size()));
    for(Eigen::Index i = 0; i < result.size(); ++i)
      result[i] = inverse(i, i) > 0 ? s.curvatures[i] * s.curvatures[i] / inverse(i, i) : std::numeric_limits<double>::infinity();
    return result;
  }

  // The Gram matrix of the columns of the cones with the weights of `s`, less what the best shift takes away.
  Eigen::MatrixXd gram(const Curved_cones& s)
  {
    const Eigen::Index n = Eigen::Index(s.cones.size());
    const Eigen::MatrixXd k = system(tangent(columns(s), unknowns(s), s), load_weights(s.u, exponent_)).first;
    Eigen::MatrixXd result = k.topLeftCorner(n, n);
    if(has_shift_)
      result -= k.col(n).head(n) * k.row(n).head(n) / k(n, n);
    return result;
  }

private:
  typedef typename Model::Column Column;

  static constexpr double pi() { return Number_constants<double>::pi(); }

  bool is_spread(const Curved_cones& s) const { return are_too_few(s.cones.size()); }

  std::vector<Column> columns(const Curved_cones& s)
  {
    std::vector<Column> result;
    for(Index c : s.cones)
      result.push_back(model_.column(c));
    if(is_spread(s))
      result.push_back(model_.spread_column());
    return result;
  }

  // Curvatures, the spread one if there is one, and the shift if it is unknown.
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

  void take(const Eigen::VectorXd& y, Curved_cones& s) const
  {
    const Eigen::Index n = Eigen::Index(s.cones.size());
    s.curvatures = y.head(n);
    s.spread = is_spread(s) ? y[n] : 0;
    s.shift = has_shift_ ? y[y.size() - 1] : 0;
  }

  void evaluate(const std::vector<Column>& x, const Eigen::VectorXd& y, Curved_cones& s) const
  {
    s.u = model_.flat();
    for(std::size_t i = 0; i < x.size(); ++i)
      s.u += y[Eigen::Index(i)] * *x[i];
    if(has_shift_)
      s.u.array() -= y[y.size() - 1];
    for(std::size_t i = 0; i < s.cones.size(); ++i)
      s.u[s.cones[i]] += model_.excess(s.cones[i], y[Eigen::Index(i)]).first - model_.excess(s.cones[i], 0).first;
    s.value = value(s.u, exponent_);
  }

  double value(const Eigen::VectorXd& u, int p) const
  {
    const double largest = u.cwiseAbs().maxCoeff();
    if(!(largest > 0) || !std::isfinite(largest))
      return largest;
    return largest * std::pow(weights_.dot(powers(u / largest, p).matrix()), 1. / p);
  }

  // u^p
  static Eigen::ArrayXd powers(const Eigen::VectorXd& u, int p)
  {
    Eigen::ArrayXd result = u.array().square();
    for(int q = 2; q < p; q *= 2)
      result = result.square().eval();
    return result;
  }

  Eigen::VectorXd load_weights(const Eigen::VectorXd& u, int p) const
  {
    const double largest = u.cwiseAbs().maxCoeff(), tiny = 1e-30;
    if(p == 2 || !(largest > 0))
      return weights_;
    const Eigen::VectorXd x = u / largest;
    return weights_.array() * powers(x, p) / (x.array().square() + tiny);
  }

  // u near y: `rest` and the columns, each but the spread one with something more at its cone.
  struct Tangent
  {
    std::vector<Column> columns;
    std::vector<Index> cones;
    std::vector<double> more;
    Eigen::VectorXd rest;
  };

  Tangent tangent(const std::vector<Column>& x, const Eigen::VectorXd& y, const Curved_cones& s) const
  {
    Tangent result = {x, s.cones, {}, model_.flat()};
    for(std::size_t i = 0; i < s.cones.size(); ++i)
    {
      const Index c = s.cones[i];
      const std::pair<double, double> excess = model_.excess(c, y[Eigen::Index(i)]);
      result.more.push_back(excess.second);
      result.rest[c] += excess.first - excess.second * y[Eigen::Index(i)] - model_.excess(c, 0).first;
    }
    return result;
  }

  // For p = 2, where one vertex does not matter
  Tangent linear(const std::vector<Column>& x, const Curved_cones& s) const
  {
    Tangent result = {x, s.cones, std::vector<double>(s.cones.size(), 0.), model_.flat()};
    for(Index c : s.cones)
      result.rest[c] -= model_.excess(c, 0).first;
    return result;
  }

  // The matrix and the right side of the normal equations with these weights, with the condition on the sum of the curvatures.
  std::pair<Eigen::MatrixXd, Eigen::VectorXd> system(const Tangent& x, const Eigen::VectorXd& w) const
  {
    const Eigen::Index n = Eigen::Index(x.columns.size()), m = n + (has_shift_ ? 1 : 0), size = m + (model_.is_closed() ? 1 : 0);
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(size);
    for(Eigen::Index i = 0; i < n; ++i)
    {
      Eigen::VectorXd wx = w.cwiseProduct(*x.columns[std::size_t(i)]);
      add_more(x, std::size_t(i), w, wx);
      for(Eigen::Index j = 0; j <= i; ++j)
      {
        const std::size_t column = std::size_t(j);
        k(i, j) = k(j, i) = wx.dot(*x.columns[column]) + (column < x.cones.size() ? wx[x.cones[column]] * x.more[column] : 0);
      }
      if(has_shift_)
        k(i, n) = k(n, i) = -wx.sum();
      b[i] = -wx.dot(x.rest);
    }
    if(has_shift_)
    {
      k(n, n) = w.sum();
      b[n] = w.dot(x.rest);
    }
    if(model_.is_closed())
    {
      k.row(m).head(n).setOnes();
      k.col(m).head(n).setOnes();
      b[m] = model_.total_curvature();
    }
    return std::make_pair(k, b);
  }

  static void add_more(const Tangent& x, std::size_t i, const Eigen::VectorXd& w, Eigen::VectorXd& wx)
  {
    if(i < x.cones.size())
      wx[x.cones[i]] += w[x.cones[i]] * x.more[i];
  }

  // The solution of the normal equations with these weights, within the bounds.
  Eigen::VectorXd solution(const Tangent& x, const Curved_cones& s, const Eigen::VectorXd& w) const
  {
    const auto equations = system(x, w);
    const Eigen::Index n = Eigen::Index(s.cones.size()), m = Eigen::Index(x.columns.size()) + (has_shift_ ? 1 : 0);
    const double most = largest_curvature(), least = least_curvature(s.cones.size());
    std::vector<Eigen::Index> open(std::size_t(equations.first.rows()));
    for(std::size_t i = 0; i < open.size(); ++i)
      open[i] = Eigen::Index(i);
    Eigen::VectorXd y = Eigen::VectorXd::Zero(equations.first.rows());
    for(;;)
    {
      const Eigen::Index size = Eigen::Index(open.size());
      Eigen::MatrixXd k(size, size);
      Eigen::VectorXd b(size), held = y;
      for(Eigen::Index i : open)
        held[i] = 0;
      const Eigen::VectorXd known = equations.first * held;
      for(Eigen::Index i = 0; i < size; ++i)
      {
        b[i] = equations.second[open[std::size_t(i)]] - known[open[std::size_t(i)]];
        for(Eigen::Index j = 0; j < size; ++j)
          k(i, j) = equations.first(open[std::size_t(i)], open[std::size_t(j)]);
      }
      const Eigen::VectorXd z = size == 0 ? b : Eigen::VectorXd(k.fullPivLu().solve(b));
      std::size_t worst = open.size();
      double violation = 1e-9;
      for(std::size_t i = 0; i < open.size(); ++i)
      {
        y[open[i]] = z[Eigen::Index(i)];
        if(open[i] >= n)
          continue;
        const double v = (std::max)(y[open[i]] - most, least - y[open[i]]);
        if(v > violation)
        {
          violation = v;
          worst = i;
        }
      }
      if(worst == open.size() || !z.allFinite())
        return y.head(m);
      y[open[worst]] = y[open[worst]] > most ? most : least;
      open.erase(open.begin() + std::ptrdiff_t(worst));
    }
  }

  // Newton's method for |u|_p^p from y, or from the solution for p = 2 if y is empty.
  void improve(int p, const std::vector<Column>& x, const Curved_cones& s, Eigen::VectorXd& y)
  {
    if(y.size() == 0)
      y = solution(linear(x, s), s, weights_);
    if(p == 2)
      return;
    Curved_cones now;
    now.cones = s.cones;
    const int most_steps = 12;
    for(int i = 0; i < most_steps; ++i)
    {
      evaluate(x, y, now);
      const double before = value(now.u, p);
      const Eigen::VectorXd to = solution(tangent(x, y, s), s, load_weights(now.u, p)) - y;
      double after = before;
      for(double step = 1.5 / (p - 1); step > 0.1 / (p - 1); step /= 2)
      {
        evaluate(x, y + step * to, now);
        after = value(now.u, p);
        if(after < before)
        {
          y += step * to;
          break;
        }
      }
      if(!(after < before * (1 - 1e-4)))
        return;
    }
  }

  Model& model_;
  const Eigen::VectorXd weights_;
  const bool has_shift_;
  int exponent_ = 2;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_FIT_H
