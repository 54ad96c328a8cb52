// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What named parameters say about the vertices and edges of a mesh, as values by index. It is read once, where a door begins, so that what
// is below is compiled once for all parameters.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_INDEXED_PARAMETERS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_INDEXED_PARAMETERS_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Layout/Cut_finder.h>
#include <CGAL/Conformal_equivalence/internal/Layout/Seam_conditions.h>
#include <CGAL/Conformal_equivalence/internal/Layout/layout_frames.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/read_conditions.h>

#include <CGAL/property_map.h>
#include <CGAL/use.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// ---- Edges

// The values of a property map of edges, by index; empty if the parameter is not given.
template <typename Value, typename TriangleMesh, typename NT, typename Tag, typename NamedParameters>
std::vector<Value> values_at_edges(const Imported_mesh<TriangleMesh, NT>& mesh, Tag tag, const NamedParameters& np)
{
  CGAL_USE(mesh);
  CGAL_USE(tag);
  CGAL_USE(np);
  std::vector<Value> result;
  if constexpr(is_given<Tag, NamedParameters>)
  {
    const auto map = parameters::get_parameter(np, tag);
    result.reserve(mesh.triangulation.number_of_edges());
    for(std::uint32_t e = 0; e < mesh.triangulation.number_of_edges(); ++e)
      result.push_back(static_cast<Value>(get(map, mesh.edge(e))));
  }
  return result;
}

// Where a surface is to be cut, and where not. Each by edge, and empty if nothing is said.
template <typename NT>
struct Seam_options
{
  std::vector<char> is_seam;        // cut in any case
  std::vector<char> is_constrained; // not to be cut
  std::vector<NT> weight;           // what it costs to cut

  bool has_seam() const { return !is_seam.empty(); }
};

template <typename TriangleMesh, typename NT, typename NamedParameters>
Seam_options<NT> read_seam_options(const Imported_mesh<TriangleMesh, NT>& mesh, const NamedParameters& np)
{
  return {values_at_edges<char>(mesh, internal_np::conformal_edge_is_seam, np),
          values_at_edges<char>(mesh, internal_np::edge_is_constrained, np),
          values_at_edges<NT>(mesh, internal_np::conformal_seam_weight, np)};
}

// The cut of a surface with faces.
template <typename NT>
Cut_graph find_cut_graph(const Intrinsic_triangulation<NT>& t, const std::vector<std::uint32_t>& cones, Seam_options<NT> options)
{
  Seam_conditions<NT> conditions;
  conditions.prescribed.is_cut = std::move(options.is_seam);
  conditions.prescribed.is_cut.resize(t.number_of_edges(), 0);
  conditions.is_constrained = std::move(options.is_constrained);
  conditions.is_constrained.resize(t.number_of_edges(), 0);
  conditions.weight = options.weight.empty() ? t.lengths() : std::move(options.weight);
  check_seam_conditions(t, conditions);
  if(conditions.prescribed.status != Status::OK)
    return failed_cut(conditions.prescribed.status, conditions.prescribed.edges, {});
  return find_cut(t, cones, std::move(conditions));
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template Cut_graph find_cut_graph(const Intrinsic_triangulation<double>&, const std::vector<std::uint32_t>&, Seam_options<double>);
#endif

// ---- Vertices

// The conditions that the named parameters give for the mesh; `report` names the vertices that lack one.
template <typename TriangleMesh, typename NT, typename NamedParameters>
Conformal_conditions<NT> read_conditions_or_name(const Imported_mesh<TriangleMesh, NT>& mesh, const NamedParameters& np,
                                                 Flattening_report<TriangleMesh>& report)
{
  std::vector<std::uint32_t> missing;
  Conformal_conditions<NT> result = read_conditions(mesh, missing, np);
  if(!missing.empty())
  {
    report.status = Status::MISSING_CONDITION;
    name_elements(mesh, missing, {}, {}, report);
  }
  return result;
}

// The cones inside the surface, in increasing order.
template <typename NT>
std::vector<std::uint32_t> interior_cones(const Intrinsic_triangulation<NT>& t, const Conformal_conditions<NT>& conditions)
{
  std::vector<std::uint32_t> result;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v) && !t.is_border_vertex(v) && conditions.is_cone(v))
      result.push_back(v);
  return result;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template std::vector<std::uint32_t> interior_cones(const Intrinsic_triangulation<double>&, const Conformal_conditions<double>&);
#endif

// The map of the initial u has vertices of the mesh for keys here.
template <typename TriangleMesh, typename NT, typename NamedParameters>
Solver_options read_solver_options(const Imported_mesh<TriangleMesh, NT>& mesh, const NamedParameters& np)
{
  if constexpr(is_given<internal_np::conformal_initial_u_t, NamedParameters>)
  {
    const auto map = parameters::get_parameter(np, internal_np::conformal_initial_u);
    std::vector<double> u;
    for(std::uint32_t v = 0; v < mesh.triangulation.number_of_vertices(); ++v)
      u.push_back(static_cast<double>(get(map, mesh.vertex(v))));
    const auto initial = parameters::initial_log_scale_factor_map(CGAL::make_property_map(u));
    return Conformal_equivalence::read_solver_options(Conformal_equivalence::combine_named_parameters(np, initial), u.size());
  }
  else
    return Conformal_equivalence::read_solver_options(np, mesh.triangulation.number_of_vertices());
}

// ---- The frame

template <typename TriangleMesh, typename NT>
Any_frame indexed_frame(const Imported_mesh<TriangleMesh, NT>&, Layout_frame frame) { return frame; }

template <typename TriangleMesh, typename NT, typename Vertex>
Any_frame indexed_frame(const Imported_mesh<TriangleMesh, NT>& mesh, const Pinned_frame<Vertex>& frame)
{
  return Pinned_frame<std::uint32_t>{mesh.index_of_vertex(frame.first), frame.first_point,
                                     mesh.index_of_vertex(frame.second), frame.second_point};
}

// The frame among the named parameters, with vertices by index.
template <typename TriangleMesh, typename NT, typename NamedParameters>
Any_frame read_frame(const Imported_mesh<TriangleMesh, NT>& mesh, const NamedParameters& np)
{
  return indexed_frame(mesh, parameters::choose_parameter(parameters::get_parameter(np, internal_np::conformal_layout_frame),
                                                          Layout_frame::CANONICAL));
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_INDEXED_PARAMETERS_H
