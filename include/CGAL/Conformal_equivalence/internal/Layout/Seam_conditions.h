// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What the user asks of a cut: edges that are cut in any case, edges that must not be cut, and what it costs to cut the others.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_SEAM_CONDITIONS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_SEAM_CONDITIONS_H

#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/use.h>

#include <boost/property_map/property_map.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The conditions on the edges, read from the property maps.
template <typename NT>
struct Seam_conditions
{
  Cut_graph prescribed;             // edges that are cut in any case
  std::vector<char> is_constrained; // by edge of the input
  std::vector<NT> weight;           // by edge of the input
};

// The values of the property map that a named parameter holds, by edge; without the parameter those of `default_value(e)`.
template <typename Value, typename Tag, typename NamedParameters, typename Default_value>
std::vector<Value> read_edges(std::uint32_t number_of_edges, Tag tag, const NamedParameters& np, Default_value default_value)
{
  CGAL_USE(tag);
  CGAL_USE(np);
  std::vector<Value> result;
  result.reserve(number_of_edges);
  for(std::uint32_t e = 0; e < number_of_edges; ++e)
  {
    if constexpr(is_given<Tag, NamedParameters>)
      result.push_back(static_cast<Value>(get(parameters::get_parameter(np, tag), e)));
    else
      result.push_back(default_value(e));
  }
  return result;
}

// Nothing is prescribed on borders. The status of `prescribed` tells whether the rest makes sense.
template <typename NT>
void check_seam_conditions(const Intrinsic_triangulation<NT>& t, Seam_conditions<NT>& conditions)
{
  Cut_graph& prescribed = conditions.prescribed;
  std::vector<std::uint32_t> invalid, contradictory;
  for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
  {
    const NT& w = conditions.weight[e];
    if(t.is_border_edge(e))
      prescribed.is_cut[e] = 0;
    else if(!(w >= NT(0)) || !(w - w == NT(0)))
      invalid.push_back(e);
    else if(prescribed.is_cut[e] && conditions.is_constrained[e])
      contradictory.push_back(e);
  }
  if(!invalid.empty())
    prescribed.status = Status::INVALID_NUMBER;
  else if(!contradictory.empty())
    prescribed.status = Status::WRONG_TOPOLOGY;
  prescribed.edges = invalid.empty() ? std::move(contradictory) : std::move(invalid);
}

template <typename NT, typename NamedParameters>
Seam_conditions<NT> read_seam_conditions(const Intrinsic_triangulation<NT>& t, const NamedParameters& np)
{
  const std::uint32_t n = t.number_of_edges();
  const auto no = [](std::uint32_t) { return char(0); };
  Seam_conditions<NT> result;
  result.prescribed.is_cut = read_edges<char>(n, internal_np::conformal_edge_is_seam, np, no);
  result.is_constrained = read_edges<char>(n, internal_np::edge_is_constrained, np, no);
  result.weight = read_edges<NT>(n, internal_np::conformal_seam_weight, np, [&](std::uint32_t e) { return t.length(e); });
  check_seam_conditions(t, result);
  return result;
}

// A cut that could not be made.
inline Cut_graph failed_cut(Status status, std::vector<std::uint32_t> edges, std::vector<std::uint32_t> faces)
{
  Cut_graph result;
  result.status = status;
  result.edges = std::move(edges);
  result.faces = std::move(faces);
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_SEAM_CONDITIONS_H
