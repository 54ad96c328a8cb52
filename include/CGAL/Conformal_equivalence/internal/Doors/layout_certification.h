// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The engine of `certify_layout()`: the common refinement in ever more digits, until its faces are seen to be positive, or are not.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_LAYOUT_CERTIFICATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_LAYOUT_CERTIFICATION_H

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout_certificate.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/compute_common_refinement.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Surface_double.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/length_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>
#include <CGAL/Conformal_equivalence/multiprecision.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The same conditions in another number type, exactly.
template <typename To, typename From>
Conformal_conditions<To> convert_conditions(const Intrinsic_triangulation<From>& t, const Conformal_conditions<From>& conditions)
{
  Conformal_conditions<To> result(t);
  for(std::uint32_t v = 0; v < conditions.size(); ++v)
  {
    if(conditions.is_fixed(v))
    {
      result.fix_log_scale_factor(v, To(conditions.log_scale_factor(v)));
      continue;
    }
    Exact_angle<To> angle;
    angle.units = conditions.angle_sum(v).units;
    angle.rest = To(conditions.angle_sum(v).rest);
    if(conditions.is_bounded(v))
      result.prescribe_angle_sum_above(v, angle, To(conditions.lower_bound(v)));
    else
      result.prescribe_angle_sum(v, angle);
  }
  return result;
}

// The metric with the digits of `Multiprecision_number`: for the same triangulation, which is not flipped any more. If it
// cannot be had, the one that is there.
inline Conformal_metric<Multiprecision_number>
refine_metric(const Intrinsic_triangulation<double>& input, const Conformal_metric<double>& metric,
              const Conformal_conditions<double>& conditions)
{
  typedef Multiprecision_number Real;
  typedef std::uint32_t Index;
  Conformal_metric<Real> result = convert_metric<Real>(metric);
  const std::vector<Double_double>& s = metric.scale_factors;
  const auto u = [&s](Index v) { return 2 * std::log(s[v].hi); };
  const auto np = parameters::gradient_tolerance(0.)
                    .initial_log_scale_factor_map(boost::make_function_property_map<Index, double>(u));
  Conformal_conditions<Real> wide_conditions = convert_conditions<Real>(input, conditions);
  if(metric.is_doubled)
    wide_conditions = Surface_double<double>(input).conditions(wide_conditions);
  Conformal_metric<Real> refined = compute_conformal_metric(result.triangulation, wide_conditions, np);
  if(!bool(refined) || !(refined.statistics.residual < metric.statistics.residual))
    return result;
  result.scale_factors = std::move(refined.scale_factors);
  result.log_scale_factors = std::move(refined.log_scale_factors);
  result.log_scale_factors.resize(input.number_of_vertices());
  result.statistics.residual = refined.statistics.residual;
  return result;
}

// By vertex: whether its faces are all around it, and nothing is cut there.
template <typename NT>
std::vector<char> uncut_interior_vertices(const Intrinsic_triangulation<NT>& t, const Cut_graph& cut)
{
  std::vector<char> result(t.number_of_vertices(), 1);
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(t.is_isolated_vertex(v) || t.is_border_vertex(v))
      result[v] = 0;
  for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
    if(cut[e])
      result[t.origin(t.edge_halfedge(e))] = result[t.target(t.edge_halfedge(e))] = 0;
  return result;
}

// How far the sum of the angles of the layout around a vertex may be from what it must be, in radians. It is far above the rounding of
// the angles, which are summed up in `double`, and far below 2 pi, by which the sum is wrong if the faces turn once too often.
constexpr double angle_tolerance = 1e-10;

// The faces turn as they must: once around whatever is not cut, and by the angle prescribed elsewhere. The sum of angles of
// positive faces that are glued together is a multiple of 2 pi, so that rounding cannot hide another one.
template <typename NT>
void judge_turning(const Intrinsic_triangulation<double>& input, const Common_refinement<NT>& refinement, const Cut_graph& cut,
                   const Conformal_conditions<double>& conditions, Layout_certificate& certificate)
{
  const std::vector<char> is_uncut = uncut_interior_vertices(input, cut);
  const double turn = 2 * Number_constants<double>::pi();
  for(std::uint32_t v = 0; v < input.number_of_vertices(); ++v)
  {
    if(input.is_isolated_vertex(v))
      continue;
    const double sum = refinement.angle_sums[v];
    double error = 0;
    if(!conditions.is_fixed(v))
    {
      error = sum - conditions.angle_sum(v).radians();
      error = conditions.is_bounded(v) ? (std::max)(error, 0.) : std::abs(error);
    }
    certificate.angle_error = error <= certificate.angle_error ? certificate.angle_error : error;
    if(!(error <= angle_tolerance) || (is_uncut[v] && !(std::abs(sum - turn) <= angle_tolerance)))
      certificate.turning_vertices.push_back(v);
  }
}

template <typename NT>
bool is_positive_in_double(const Common_refinement<NT>& refinement, std::uint32_t f)
{
  std::vector<std::array<double, 2> > polygon;
  for(std::size_t c = refinement.first_corner[f]; c < refinement.first_corner[f + 1]; ++c)
    polygon.push_back({{static_cast<double>(refinement.corner_uv[c][0]), static_cast<double>(refinement.corner_uv[c][1])}});
  return is_convex_polygon(polygon);
}

// The faces are positive, or named.
template <typename NT>
void judge_faces(const Intrinsic_triangulation<double>& input, const Common_refinement<NT>& refinement,
                 Layout_certificate& certificate)
{
  std::vector<char> is_flipped(refinement.number_of_faces(), 0);
  for(std::uint32_t f : refinement.flipped_faces)
  {
    is_flipped[f] = 1;
    const std::uint32_t g = refinement.input_face[f];
    if(is_degenerate_triangle(input.halfedge_length(input.halfedge(g)), input.halfedge_length(input.halfedge(g, 1)),
                              input.halfedge_length(input.halfedge(g, 2))))
      certificate.exempt_faces.push_back(g);
    else
      certificate.flipped_faces.push_back(f);
  }
  std::sort(certificate.exempt_faces.begin(), certificate.exempt_faces.end());
  certificate.exempt_faces.erase(std::unique(certificate.exempt_faces.begin(), certificate.exempt_faces.end()),
                                 certificate.exempt_faces.end());
  for(std::uint32_t f = 0; f < refinement.number_of_faces(); ++f)
    if(!is_flipped[f] && !is_positive_in_double(refinement, f))
      ++certificate.number_of_faces_lost_in_double;
}

// The verdict on the metric as it is.
template <typename NT>
Layout_certificate certify(const Intrinsic_triangulation<double>& input, const Intrinsic_triangulation<NT>& wide_input,
                           const Conformal_metric<NT>& metric, const Cut_graph& cut, const Conformal_conditions<double>& conditions,
                           unsigned int bits)
{
  Layout_certificate result;
  result.precision_in_bits = bits;
  result.residual = metric.statistics.residual;
  const Common_refinement<NT> refinement = compute_common_refinement(wide_input, metric, cut);
  result.status = refinement.status;
  if(!bool(refinement))
    return result;
  result.number_of_faces = refinement.number_of_faces();
  judge_faces(input, refinement, result);
  judge_turning(input, refinement, cut, conditions, result);
  result.is_certified = result.flipped_faces.empty() && result.turning_vertices.empty();
  result.status = result.is_certified ? Status::OK : Status::NOT_INJECTIVE;
  return result;
}

inline Layout_certificate certify_with(unsigned int bits, const Intrinsic_triangulation<double>& input,
                                       const Conformal_metric<double>& metric, const Cut_graph& cut,
                                       const Conformal_conditions<double>& conditions)
{
  typedef Multiprecision_number Real;
  const Working_precision precision(bits);
  const Intrinsic_triangulation<Real> wide_input =
    input.with_lengths(std::vector<Real>(input.lengths().begin(), input.lengths().end()));
  return certify(input, wide_input, refine_metric(input, metric, conditions), cut, conditions, bits);
}

// The first attempt in pairs of `double`, then with ever more bits, until one succeeds or `maximum_precision` is reached.
inline Layout_certificate certify_with_enough_bits(const Intrinsic_triangulation<double>& input, const Conformal_metric<double>& metric,
                                                   const Cut_graph& cut, const Conformal_conditions<double>& conditions,
                                                   unsigned int maximum_precision)
{
  const unsigned int pair = 106; // bits
  Layout_certificate result;
  try
  {
    result = certify(input, input, metric, cut, conditions, pair);
    const auto is_wrong = [&] { return result.status == Status::NOT_INJECTIVE; };
    for(unsigned int bits = 2 * pair; is_wrong() && bits <= maximum_precision; bits *= 2)
      result = certify_with(bits, input, metric, cut, conditions);
  }
  catch(const std::bad_alloc&)
  {
    result = Layout_certificate();
    result.status = Status::OUT_OF_MEMORY;
  }
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_LAYOUT_CERTIFICATION_H
