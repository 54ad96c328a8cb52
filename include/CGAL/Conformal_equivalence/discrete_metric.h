// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file discrete_metric.h
/// What can be said of a triangulated surface from the lengths of its edges alone:
/// angles, curvatures, length cross ratios, and how two metrics are related
/// (section 2 of Springborn, Schroeder and Pinkall, 2008; the Dirichlet energy is
/// that of its Appendix E).
///
/// All functions are about an `Intrinsic_triangulation`, with results by index; for
/// meshes of \cgal there are versions with property maps in `edge_lengths.h`. Angles are in radians.
/// Where the lengths violate a triangle inequality, angles are those of section 3.1:
/// pi opposite to the edge that is too long, 0 at its ends.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_DISCRETE_METRIC_H
#define CGAL_CONFORMAL_EQUIVALENCE_DISCRETE_METRIC_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/length_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <CGAL/assertions.h>

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

// Positive and finite.
template <typename NT>
bool is_length(const NT& l)
{
  return l > NT(0) && l - l == NT(0);
}

// calls visit(h, angles) for the first halfedge of every face
template <typename NT, typename Visit>
void for_each_triangle(const Intrinsic_triangulation<NT>& t, Visit visit)
{
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); h += 3)
    visit(h, triangle_angles<NT>(t.halfedge_length(h), t.halfedge_length(h + 1), t.halfedge_length(h + 2)));
}

} // namespace internal

/// \name Lengths and Angles
/// @{

/// \ingroup PkgConformalEquivalenceMetric
///
/// returns `true` iff the lengths of `t` are a discrete metric (Definition 2.1): all are
/// positive and finite, and in every face the triangle inequalities hold strictly. Decided
/// exactly on the numbers stored. Linear time.
///
/// \param t a surface
/// \param violating_faces if given, the faces that violate this are appended, in increasing order
template <typename NT>
bool is_valid_metric(const Intrinsic_triangulation<NT>& t, std::vector<std::uint32_t>* violating_faces = nullptr)
{
  bool result = true;
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
  {
    const NT &a = t.halfedge_length(t.halfedge(f)), &b = t.halfedge_length(t.halfedge(f, 1)), &c = t.halfedge_length(t.halfedge(f, 2));
    if(internal::is_length(a) && internal::is_length(b) && internal::is_length(c) && internal::is_triangle(a, b, c))
      continue;
    result = false;
    if(violating_faces == nullptr)
      break;
    violating_faces->push_back(f);
  }
  return result;
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// returns the angles of the triangles, by the half-angle formula (6), evaluated so that even
/// those of needles are accurate (W. Kahan, "Miscalculating area and angles of a needle-like
/// triangle", 2014). Linear time.
/// \return by halfedge: the angle opposite to the halfedge `h`, at `t.apex(h)`
/// \pre all lengths are positive and finite
template <typename NT>
std::vector<NT> angles(const Intrinsic_triangulation<NT>& t)
{
  std::vector<NT> result(t.number_of_halfedges());
  internal::for_each_triangle(t, [&](std::uint32_t h, const internal::Triangle_angles<NT>& triangle)
  {
    std::copy(triangle.angle.begin(), triangle.angle.end(), result.begin() + h);
  });
  return result;
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// returns the angle sums Theta_i, the sums of the angles at every vertex (section 2.1). Linear time.
/// \return by vertex; 0 for isolated vertices
/// \pre all lengths are positive and finite
template <typename NT>
std::vector<NT> angle_sums(const Intrinsic_triangulation<NT>& t)
{
  std::vector<NT> result(t.number_of_vertices(), NT(0));
  internal::for_each_triangle(t, [&](std::uint32_t h, const internal::Triangle_angles<NT>& triangle)
  {
    for(std::uint32_t k = 0; k < 3; ++k)
      result[t.apex(h + k)] += triangle.angle[k];
  });
  return result;
}

/// @}
/// \name Curvature
/// @{

/// \ingroup PkgConformalEquivalenceMetric
///
/// returns the discrete curvatures (section 2.1): K_i = 2 pi - Theta_i at interior vertices,
/// the boundary curvature kappa_i = pi - Theta_i at border vertices. Linear time.
/// \return by vertex; 0 for isolated vertices
/// \pre all lengths are positive and finite
template <typename NT>
std::vector<NT> discrete_curvatures(const Intrinsic_triangulation<NT>& t)
{
  const NT pi = internal::Number_constants<NT>::pi();
  std::vector<NT> result = angle_sums(t);
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v))
      result[v] = (t.is_border_vertex(v) ? pi : NT(2 * pi)) - result[v];
  return result;
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// returns the sum of all discrete curvatures less 2 pi times the Euler characteristic. By the
/// Gauss-Bonnet formula (section 2.1) it is zero for every metric; what is returned shows the
/// rounding of the angles, about one unit in the last place for each triangle at most. Linear time.
/// \pre all lengths are positive and finite; no vertex is in `non_manifold_vertices(t)`
template <typename NT>
NT gauss_bonnet_defect(const Intrinsic_triangulation<NT>& t)
{
  std::ptrdiff_t euler_characteristic = std::ptrdiff_t(t.number_of_faces()) - std::ptrdiff_t(t.number_of_edges());
  NT sum(0);
  const std::vector<NT> curvature = discrete_curvatures(t);
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
  {
    sum += curvature[v];
    euler_characteristic += t.is_isolated_vertex(v) ? 0 : 1;
  }
  return sum - 2 * internal::Number_constants<NT>::pi() * NT(double(euler_characteristic));
}

/// @}
/// \name Conformal Equivalence
/// @{

namespace internal {

// Multiplies by the length cross ratio (4) of the interior edge e, or divides by it.
//
//            k                   h runs from i to j;
//          /   \                 c_ij = l_im / l_mj . l_jk / l_ki
//        i --h-- j
//          \   /
//            m
template <typename NT>
void append_length_cross_ratio(const Intrinsic_triangulation<NT>& t, std::uint32_t e, bool divide,
                               Scaled_number<NT>& product)
{
  const std::uint32_t h = t.edge_halfedge(e), g = t.twin(h);
  const NT &jk = t.halfedge_length(t.next(h)), &ki = t.halfedge_length(t.previous(h)),
           &im = t.halfedge_length(t.next(g)), &mj = t.halfedge_length(t.previous(g));
  if(divide)
    ((((product /= im) *= mj) /= jk) *= ki);
  else
    ((((product *= im) /= mj) *= jk) /= ki);
}

template <typename NT>
bool have_equal_triangulations(const Intrinsic_triangulation<NT>& t0, const Intrinsic_triangulation<NT>& t1)
{
  if(t0.number_of_vertices() != t1.number_of_vertices() || t0.number_of_halfedges() != t1.number_of_halfedges())
    return false;
  for(std::uint32_t h = 0; h < t0.number_of_halfedges(); ++h)
    if(t0.origin(h) != t1.origin(h) || t0.twin(h) != t1.twin(h))
      return false;
  return true;
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceMetric
///
/// returns the length cross ratio (4) of the edge `e` between the triangles ijk and jim,
/// c_ij = (l_im / l_mj) (l_jk / l_ki): positive, the same for both directions of the edge, and not
/// changed by conformal changes of the metric. Accurate to a few units in the last place, also
/// where terms leave the range of `NT` (the value itself may). Constant time.
/// \pre `e` is not on the border (there are no cross ratios of border edges, and nothing that
///      conformal changes would leave unchanged there); the four lengths are positive and finite
template <typename NT>
NT length_cross_ratio(const Intrinsic_triangulation<NT>& t, std::uint32_t e)
{
  CGAL_precondition(!t.is_border_edge(e));
  internal::Scaled_number<NT> result(NT(1), 0);
  internal::append_length_cross_ratio(t, e, false, result);
  return result.value();
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// returns the length cross ratios (4). Linear time.
/// \return by edge; 1 for border edges, which have none
/// \pre all lengths are positive and finite
template <typename NT>
std::vector<NT> length_cross_ratios(const Intrinsic_triangulation<NT>& t)
{
  std::vector<NT> result(t.number_of_edges(), NT(1));
  for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
    if(!t.is_border_edge(e))
      result[e] = length_cross_ratio(t, e);
  return result;
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// returns the largest relative difference |c1 / c0 - 1| of the length cross ratios c0 of `t0` and c1
/// of `t1`: zero iff the metrics are discretely conformally equivalent (Proposition in section 2).
/// Rounding of lengths contributes some four times their relative error. Nothing over- or
/// underflows on the way. Linear time.
/// \return a number >= 0; NaN if a length is not positive and finite
/// \pre both have the same triangulation
template <typename NT>
NT largest_cross_ratio_difference(const Intrinsic_triangulation<NT>& t0, const Intrinsic_triangulation<NT>& t1)
{
  using std::abs;
  CGAL_precondition(internal::have_equal_triangulations(t0, t1));
  NT result(0);
  for(std::uint32_t e = 0; e < t0.number_of_edges(); ++e)
  {
    if(!internal::is_length(t0.length(e)) || !internal::is_length(t1.length(e)))
      return std::numeric_limits<NT>::quiet_NaN();
    if(t0.is_border_edge(e))
      continue;
    internal::Scaled_number<NT> quotient(NT(1), 0);
    internal::append_length_cross_ratio(t1, e, false, quotient);
    internal::append_length_cross_ratio(t0, e, true, quotient);
    const NT difference = abs(NT(quotient.value() - 1));
    if(difference > result)
      result = difference;
  }
  return result;
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// returns `true` iff the two metrics are discretely conformally equivalent (Definition 2.2) within
/// `tolerance`: if they live on the same triangulation, index by index, and their length cross
/// ratios differ by at most that, relatively. `false` if a length is not positive and finite. Linear time.
///
/// Lengths computed from coordinates carry the rounding of these: an edge of length l between points of
/// absolute value D contributes 2^-52 D / l.
template <typename NT>
bool are_conformally_equivalent(const Intrinsic_triangulation<NT>& t0, const Intrinsic_triangulation<NT>& t1,
                                double tolerance = 1e-8)
{
  return internal::have_equal_triangulations(t0, t1)
      && largest_cross_ratio_difference(t0, t1) <= NT(tolerance);
}

/// \ingroup PkgConformalEquivalenceMetric
/// What `log_scale_factors_between()` returns.
template <typename NT>
struct Log_scale_factors
{
  std::vector<NT> log_scale_factors;  ///< u, by vertex; 0 for isolated vertices

  /// the largest |log(l1 / l0) - (u_i + u_j) / 2| of an edge, that is, relative difference of
  /// lengths: zero, up to rounding, iff the metrics are conformally equivalent
  NT residual = NT(0);
};

/// \ingroup PkgConformalEquivalenceMetric
///
/// recovers the logarithmic scale factors u that lead from the metric of `t0` to that of `t1`: at every
/// corner of a triangle by (5); at a vertex, the mean of its corners. If the metrics are conformally
/// equivalent, all corners agree and (2) holds with this u; otherwise the `residual` tells by how much
/// it fails. Nothing over- or underflows on the way. Linear time.
/// \pre both have the same triangulation; all lengths are positive and finite
template <typename NT>
Log_scale_factors<NT> log_scale_factors_between(const Intrinsic_triangulation<NT>& t0,
                                                const Intrinsic_triangulation<NT>& t1)
{
  using std::abs;
  CGAL_precondition(internal::have_equal_triangulations(t0, t1));
  Log_scale_factors<NT> result;
  std::vector<NT>& u = result.log_scale_factors;
  u.assign(t0.number_of_vertices(), NT(0));
  std::vector<std::uint32_t> corners(u.size(), 0);
  for(std::uint32_t h = 0; h < t0.number_of_halfedges(); ++h)
  {
    const std::uint32_t jk = t0.next(h), ki = t0.previous(h), i = t0.origin(h);
    internal::Scaled_number<NT> factor(NT(1), 0); // e^{u_i}
    ((factor *= t1.halfedge_length(h)) /= t0.halfedge_length(h));
    ((factor *= t1.halfedge_length(ki)) /= t0.halfedge_length(ki));
    ((factor *= t0.halfedge_length(jk)) /= t1.halfedge_length(jk));
    u[i] += factor.logarithm();
    ++corners[i];
  }
  for(std::size_t v = 0; v < u.size(); ++v)
    if(corners[v] > 0)
      u[v] /= NT(corners[v]);

  for(std::uint32_t e = 0; e < t0.number_of_edges(); ++e)
  {
    const std::uint32_t h = t0.edge_halfedge(e);
    internal::Scaled_number<NT> ratio(NT(1), 0);
    ((ratio *= t1.length(e)) /= t0.length(e));
    const NT difference = abs(NT(ratio.logarithm() - (u[t0.origin(h)] + u[t0.target(h)]) / 2));
    if(!(difference <= result.residual))
      result.residual = difference;
  }
  return result;
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// returns the surface with the lengths e^{(u_i + u_j) / 2} l_ij, equation (2). They need not
/// satisfy the triangle inequality. Linear time.
/// \pre `u.size() == t.number_of_vertices()`; lengths and u are finite
template <typename NT>
Intrinsic_triangulation<NT> apply_log_scale_factors(const Intrinsic_triangulation<NT>& t, const std::vector<NT>& u)
{
  using std::exp;
  CGAL_precondition(u.size() == t.number_of_vertices());
  std::vector<NT> lengths(t.lengths());
  for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
  {
    const std::uint32_t h = t.edge_halfedge(e);
    const NT half = exp(NT((u[t.origin(h)] + u[t.target(h)]) / 4)); // in two steps: lies between l and the result
    lengths[e] = half * lengths[e] * half;
  }
  return t.template with_lengths<NT>(std::move(lengths));
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// returns the Dirichlet energy D(u) = 1/2 int |grad u|^2 of the function that is linear on every triangle of
/// `t` and takes the values `u` at the vertices: 1/4 sum over edges of w_ij (u_i - u_j)^2, with
/// the weights w_ij = cot + cot of the angles opposite to the edge (one cotangent on the border; R. Duffin, 1959;
/// U. Pinkall and K. Polthier, 1993). With u the logarithmic scale factors of a conformally
/// equivalent metric it measures the distortion (Appendix E), lowest for flat metrics with u constant
/// on the border. Linear time.
/// \return a number >= 0, but for rounding; triangles that violate their inequality count as 0
/// \pre `u.size() == t.number_of_vertices()`; all lengths are positive and finite
template <typename NT>
NT dirichlet_energy(const Intrinsic_triangulation<NT>& t, const std::vector<NT>& u)
{
  CGAL_precondition(u.size() == t.number_of_vertices());
  NT sum(0);
  internal::for_each_triangle(t, [&](std::uint32_t h, const internal::Triangle_angles<NT>& triangle)
  {
    for(std::uint32_t k = 0; k < 3; ++k)
    {
      const NT difference = u[t.origin(h + k)] - u[t.target(h + k)];
      sum += triangle.cotangent[k] * difference * difference;
    }
  });
  return sum / 4;
}

/// @}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_DISCRETE_METRIC_H
