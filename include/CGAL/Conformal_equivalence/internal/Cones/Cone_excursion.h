// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What can be foreseen of moves of one cone, without solving anything: u is known to first order wherever the cone may go (see Cone_search.h).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_EXCURSION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_EXCURSION_H

#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>
#include <CGAL/Conformal_equivalence/internal/Cones/dense_systems.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Cones, with the angles that they are to have; where there are none they are free.
struct Placement
{
  typedef std::uint32_t Index;
  std::vector<Index> cones;
  std::vector<double> angles; // radians; empty: all are free
  Vertex_vector u;
  double measure = std::numeric_limits<double>::infinity();
  double error = std::numeric_limits<double>::infinity(); // of the angles, and of u at free cones, when they were last relaxed

  bool is_cone(Index v) const { return std::find(cones.begin(), cones.end(), v) != cones.end(); }
};

// What can be foreseen, to first order, of moves of one cone while all others stay; free ones keep u = 0. The responses are then
//
//     P(w, v) = G(w, v) - z(w) . K^{-1} z(v),
//
// where z(v) are the responses at v to the other free cones or, where angles are prescribed on a closed surface, to equal forces everywhere, and 1
// for a constant; P is symmetric. Without the cone at c, where the force f acts, u would be u - f P_c. With it at v there is x P_v more: x = f where
// its angle is prescribed, else what brings u_v to 0. That is known for all v at a few vertices w, those of the rows: only P(v, v) has to be
// guessed, from that of the cone, where G_v is not known.
class Cone_excursion
{
  typedef std::uint32_t Index;

public:
  typedef std::shared_ptr<const Vertex_vector> Response;

  // The cone is at c, which has the response g. Keeps a reference to the placement.
  Cone_excursion(const Placement& p, Index c, const Response& g, double force, bool is_closed)
    : p_(p), cone_(c), force_(force), is_free_(p.angles.empty()), has_constant_(is_closed)
  { own_.g = g; }

  // The other cones are free, and have these responses.
  void keep_others(const std::vector<Response>& responses)
  {
    std::vector<Index> others;
    for(std::size_t j = 0; j < responses.size(); ++j)
      if(p_.cones[j] != cone_)
      {
        others.push_back(p_.cones[j]);
        basis_.push_back(responses[j]);
      }
    const Eigen::Index n = Eigen::Index(others.size());
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n + (has_constant_ ? 1 : 0), n + (has_constant_ ? 1 : 0));
    for(Eigen::Index j = 0; j < n; ++j)
      k.row(j) = z(others[std::size_t(j)]).transpose();
    if(has_constant_)
      k.row(n).head(n).setOnes();
    if(k.size() > 0)
      inverse_ = dense_inverse(k);
    set_own();
  }

  // On a closed surface forces are balanced by equal ones everywhere. Where the cone is the only one and free, its curvature is known, too, and u is
  // 0 there.
  void balance(const Response& uniform)
  {
    is_alone_ = is_free_;
    is_free_ = false;
    basis_.assign(1, uniform);
    inverse_ = Eigen::MatrixXd::Zero(2, 2);
    inverse_(0, 1) = inverse_(1, 0) = 1;
    set_own();
  }

  void watch(Index w, const Response& g) { rows_.push_back(row(w, g)); }

  // The largest |u| in the rows and at the cone if that is at v; `diagonal`: G(v, v). May return early with anything above `bound`.
  double largest_u(Index v, double diagonal, double bound) const
  {
    const At a = at(v, diagonal);
    const double self = a.u + a.force * a.p, shift = is_alone_ ? self : 0;
    double result = std::isfinite(self) ? std::abs(self - shift) : std::numeric_limits<double>::infinity();
    for(std::size_t k = 0; k < rows_.size() && result <= bound; ++k)
      result = (std::max)(result, std::abs(rows_[k].u + a.force * ((*rows_[k].g)[v] - dot(rows_[k].z, a.projected)) - shift));
    return result;
  }

  // By what the Dirichlet energy changes: without the cone and its force it does not depend on v.
  double energy_change(Index v, double diagonal) const
  {
    const At a = at(v, diagonal);
    const double now = force_ * own_.u + force_ * force_ * own_p_ / 2;
    const double result = a.force * a.u + a.force * a.force * a.p / 2 - now;
    return std::isfinite(result) ? result : std::numeric_limits<double>::infinity();
  }

private:
  void set_own()
  {
    own_ = row(cone_, own_.g);
    own_p_ = (*own_.g)[cone_] - dot(own_.z, projected(own_.z));
    rows_.assign(1, own_);
  }

  struct Row { Response g; Eigen::VectorXd z; double u; }; // u without the cone
  struct At { Eigen::VectorXd projected; double u, p, force; };

  static double dot(const Eigen::VectorXd& x, const Eigen::VectorXd& y) { return x.size() > 0 ? x.dot(y) : 0; }

  Eigen::VectorXd z(Index v) const
  {
    const Eigen::Index n = Eigen::Index(basis_.size());
    Eigen::VectorXd result = Eigen::VectorXd::Ones(n + (has_constant_ ? 1 : 0));
    for(Eigen::Index j = 0; j < n; ++j)
      result[j] = (*basis_[std::size_t(j)])[v];
    return result;
  }

  Eigen::VectorXd projected(const Eigen::VectorXd& z) const { return z.size() > 0 ? Eigen::VectorXd(inverse_ * z) : z; }

  Row row(Index w, const Response& g) const
  {
    const Eigen::VectorXd z_w = z(w);
    return {g, z_w, p_.u[w] - force_ * ((*g)[cone_] - dot(z_w, projected(z(cone_))))};
  }

  At at(Index v, double diagonal) const
  {
    const Eigen::VectorXd z_v = z(v);
    At a;
    a.projected = projected(z_v);
    a.p = diagonal - dot(z_v, a.projected);
    a.u = p_.u[v] - force_ * ((*own_.g)[v] - dot(own_.z, a.projected));
    a.force = !is_free_ ? force_ : a.p > 0 ? -a.u / a.p : std::numeric_limits<double>::quiet_NaN();
    return a;
  }

  const Placement& p_;
  const Index cone_;
  const double force_;
  bool is_free_, is_alone_ = false;
  const bool has_constant_;
  std::vector<Response> basis_;
  Eigen::MatrixXd inverse_;
  Row own_;
  double own_p_ = 0;
  std::vector<Row> rows_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_EXCURSION_H
