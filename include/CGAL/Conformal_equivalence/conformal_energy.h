// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file conformal_energy.h
/// The convex energy whose minimum is the conformally equivalent metric, with its derivatives, at index level (sections 2.1 and 3.1,
/// equations (7) to (10), and appendix A of Springborn, Schroeder and Pinkall, 2008). The solver needs no more than the gradient and the
/// Hessian, which have no transcendental function but the arc tangent; the value is there for whoever wants to see it, to plot it, or to
/// minimize it by other means.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_ENERGY_H
#define CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_ENERGY_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Solver/energy.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/Lobachevsky.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <CGAL/assertions.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

namespace internal {

// f of one triangle, equation (8): `lambda[k]` = 2 log of the length opposite to `angle[k]`.
template <typename NT>
NT triangle_energy(const std::array<NT, 3>& lambda, const std::array<NT, 3>& angle)
{
  NT result(0);
  for(int k = 0; k < 3; ++k)
    result += angle[k] * lambda[k] / 2 + Lobachevsky(angle[k]);
  return result;
}

// f as a function of the logarithmic lengths alone.
template <typename NT>
NT triangle_energy(const std::array<NT, 3>& lambda)
{
  using std::exp;
  return triangle_energy(lambda, triangle_angles<NT>(exp(lambda[0] / 2), exp(lambda[1] / 2), exp(lambda[2] / 2)).angle);
}

// The term of the face f in equation (7).
template <typename NT, typename Length>
NT energy_of_face(const Intrinsic_triangulation<Length>& t, std::uint32_t f, const std::vector<NT>& u)
{
  using std::log;
  std::array<NT, 3> lambda;
  NT u_sum(0);
  for(std::uint32_t k = 0; k < 3; ++k)
  {
    const std::uint32_t h = t.halfedge(f, k);
    lambda[k] = 2 * log(static_cast<NT>(t.halfedge_length(h))) + u[t.origin(h)] + u[t.target(h)];
    u_sum += u[t.origin(h)];
  }
  return triangle_energy(lambda) - Number_constants<NT>::pi() / 2 * u_sum;
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceSolver
///
/// returns the value of the energy
///
/// \f[ E(u) = \sum_{ijk} \left( f_{ijk}(\tilde\lambda) - \frac{\pi}{2} (u_i + u_j + u_k) \right) + \frac12 \sum_i \hat\Theta_i u_i, \f]
///
/// equation (7), where \f$ \tilde\lambda_{ij} = 2 \log l_{ij} + u_i + u_j \f$ are the logarithmic lengths of the metric
/// \f$ e^{(u_i + u_j)/2} l_{ij} \f$, and, with the angles of the triangle and Milnor's Lobachevsky function L, equation (8),
///
/// \f[ f_{ijk} = \frac12 (\alpha \tilde\lambda_{jk} + \beta \tilde\lambda_{ki} + \gamma \tilde\lambda_{ij}) + L(\alpha) + L(\beta) + L(\gamma). \f]
///
/// A triangle that violates its inequality has the angles pi, 0 and 0: so E is defined for all u, convex and continuously differentiable
/// (section 3.1).
///
/// \tparam NT the number type of the computation: `double`, `long double`, or a binary floating-point number of Boost.Multiprecision
/// \param t the surface, with positive lengths
/// \param u the logarithmic scale factors, by vertex
/// \param angle_sums the prescribed angle sums \f$ \hat\Theta \f$ in radians, by vertex; those of isolated vertices do not count
template <typename NT, typename Length>
NT conformal_energy(const Intrinsic_triangulation<Length>& t, const std::vector<NT>& u, const std::vector<NT>& angle_sums)
{
  CGAL_precondition(u.size() == t.number_of_vertices() && angle_sums.size() == u.size());
  NT sum(0);
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
    sum += internal::energy_of_face(t, f, u);
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v))
      sum += angle_sums[v] * u[v] / 2;
  return sum;
}

/// \ingroup PkgConformalEquivalenceSolver
///
/// returns the gradient of the energy, by vertex: \f$ \partial E / \partial u_i = \frac12 (\hat\Theta_i - \tilde\Theta_i) \f$, equation (9),
/// with the angle sums \f$ \tilde\Theta \f$ of the metric at u; 0 at isolated vertices. Parameters as for `conformal_energy()`.
template <typename NT, typename Length>
std::vector<NT> conformal_energy_gradient(const Intrinsic_triangulation<Length>& t, const std::vector<NT>& u,
                                          const std::vector<NT>& angle_sums)
{
  CGAL_precondition(u.size() == t.number_of_vertices() && angle_sums.size() == u.size());
  internal::Conformal_energy<NT, Length> energy(t);
  energy.evaluate(u);
  std::vector<NT> result(u.size(), NT(0));
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v))
      result[v] = (angle_sums[v] - energy.angle_sums()[v]) / 2;
  return result;
}

/// \ingroup PkgConformalEquivalenceSolver
///
/// returns the product of the Hessian of the energy at u with the vector `d`, by vertex:
/// \f$ \frac14 \sum_j (\cot\alpha_{ij} + \cot\beta_{ij}) (d_i - d_j) \f$, the sum over the edges at i with the angles opposite to them in the
/// metric at u, equation (10). The matrix is positive semidefinite; constants are in its kernel. A triangle that violates its inequality
/// contributes nothing. Parameters as for `conformal_energy()`.
template <typename NT, typename Length>
std::vector<NT> conformal_energy_hessian_product(const Intrinsic_triangulation<Length>& t, const std::vector<NT>& u,
                                                 const std::vector<NT>& d)
{
  CGAL_precondition(u.size() == t.number_of_vertices() && d.size() == u.size());
  internal::Conformal_energy<NT, Length> energy(t);
  energy.evaluate(u);
  return energy.hessian_product(d);
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_ENERGY_H
