// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Dense linear systems with as many unknowns as there are cones. They are symmetric, but not definite where curvatures have a given sum, so that a
// factorization without exchanges of rows will not do. Exchanges of columns, too, tell what is singular; they cost ten times as much and more where
// matrices are large, and are done there only if there is no good solution without.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_DENSE_SYSTEMS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_DENSE_SYSTEMS_H

#include <Eigen/Core>
#include <Eigen/LU>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

constexpr Eigen::Index many_dense_unknowns = 64; // fewer cost next to nothing in any case

// x with m x = b, as well as that is possible.
inline Eigen::MatrixXd dense_solution(const Eigen::MatrixXd& m, const Eigen::MatrixXd& b)
{
  const double accuracy = 1e-8; // of residuals: far less than first order is good for
  if(m.rows() >= many_dense_unknowns)
  {
    const Eigen::MatrixXd x = m.partialPivLu().solve(b);
    if(x.allFinite() && (m * x - b).cwiseAbs().maxCoeff() <= accuracy * b.cwiseAbs().maxCoeff())
      return x;
  }
  return m.fullPivLu().solve(b);
}

inline Eigen::MatrixXd dense_inverse(const Eigen::MatrixXd& m)
{
  return m.rows() >= many_dense_unknowns ? dense_solution(m, Eigen::MatrixXd::Identity(m.rows(), m.cols()))
                                         : Eigen::MatrixXd(m.fullPivLu().inverse());
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_DENSE_SYSTEMS_H
