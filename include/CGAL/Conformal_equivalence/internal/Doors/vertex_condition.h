// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What named parameters say of one vertex: whether its scale factor is fixed, and which angle sum it gets.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_VERTEX_CONDITION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_VERTEX_CONDITION_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/use.h>

#include <boost/property_map/property_map.hpp>

#include <cstdint>
#include <type_traits>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The angle that the user gave, in whatever precision: multiples of pi / 2520 are recognized in its own.
template <typename NT, typename Given>
Exact_angle<NT> given_angle(const Given& radians)
{
  if constexpr(std::is_arithmetic<Given>::value && !std::is_same<NT, double>::value)
  {
    const Exact_angle<double> rounded(static_cast<double>(radians));
    Exact_angle<NT> result;
    result.units = rounded.units;
    result.rest = NT(rounded.rest);
    return result;
  }
  else
    return Exact_angle<NT>(NT(radians));
}

// By the maps `border_angle_map` and `vertex_is_constrained_map`; without them borders are natural, and their scale factors fixed.
template <typename Vertex, typename NamedParameters>
bool has_fixed_scale_factor(const Vertex& vd, bool is_border, const NamedParameters& np)
{
  CGAL_USE(vd);
  CGAL_USE(is_border);
  if constexpr(is_given<internal_np::vertex_is_constrained_t, NamedParameters>)
    return get(parameters::get_parameter(np, internal_np::vertex_is_constrained), vd);
  else
    return is_border && !is_given<internal_np::conformal_border_angle_t, NamedParameters>;
}

// The number that a map holds, if it was given.
template <typename NT, typename Tag, typename Vertex, typename NamedParameters>
NT given_number(const Vertex& vd, Tag tag, const NamedParameters& np, const NT& default_value)
{
  CGAL_USE(vd);
  CGAL_USE(tag);
  if constexpr(is_given<Tag, NamedParameters>)
    return NT(get(parameters::get_parameter(np, tag), vd));
  else
    return default_value;
}

// Likewise an angle.
template <typename NT, typename Tag, typename Vertex, typename NamedParameters>
Exact_angle<NT> given_angle_sum(const Vertex& vd, Tag tag, const NamedParameters& np, const Exact_angle<NT>& default_value)
{
  CGAL_USE(vd);
  CGAL_USE(tag);
  if constexpr(is_given<Tag, NamedParameters>)
    return given_angle<NT>(get(parameters::get_parameter(np, tag), vd));
  else
    return default_value;
}

// Sets the condition at `v`, which has faces; returns `false` if there is none.
template <typename TriangleMesh, typename NT, typename NamedParameters>
bool set_condition(const Imported_mesh<TriangleMesh, NT>& mesh, std::uint32_t v, const NamedParameters& np, Conformal_conditions<NT>& conditions)
{
  const auto vd = mesh.vertex(v);
  const bool is_border = mesh.triangulation.is_border_vertex(v);
  const Exact_angle<NT> flat = Exact_angle<NT>::pi_times(2);
  if(has_fixed_scale_factor(vd, is_border, np))
    conditions.fix_log_scale_factor(v, given_number<NT>(vd, internal_np::conformal_prescribed_u, np, NT(0)));
  else if(!is_border)
    conditions.prescribe_angle_sum(v, given_angle_sum<NT>(vd, internal_np::conformal_cone_angle, np, flat));
  else if(is_given<internal_np::conformal_border_angle_t, NamedParameters>)
    conditions.prescribe_angle_sum(v, given_angle_sum<NT>(vd, internal_np::conformal_border_angle, np, flat));
  else
    return false;
  return true;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_VERTEX_CONDITION_H
