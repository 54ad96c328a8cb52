// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file flatten.h
/// The whole way in one call: from a mesh and conditions to texture coordinates
/// (sections 3 and 4 of Springborn, Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_H
#define CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/boundary_conditions.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/compute_layout.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/projective_interpolation.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>

#include <CGAL/boost/graph/iterator.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

namespace internal {

// One flattening: the stages one after the other, each a value that the next takes.
// What the user gets is written by the caller, from `metric` and `layout`.
template <typename TriangleMesh>
struct Flattening
{
  Imported_mesh<TriangleMesh> mesh;
  Conformal_metric<double> metric;
  Layout<double> layout;
  Flattening_report<TriangleMesh> report;

  explicit Flattening(Imported_mesh<TriangleMesh> imported) : mesh(std::move(imported)) {}

  // lengths, conditions, metric, layout, verdict; stops where one of them fails
  template <typename NamedParameters>
  void run(const NamedParameters& np)
  {
    using parameters::choose_parameter;
    using parameters::get_parameter;
    auto given_visitor = choose_parameter<Default_visitor>(get_parameter(np, internal_np::visitor));
    auto& visitor = unwrap(given_visitor);
    try
    {
      timed(report.statistics.seconds.import, Stage::IMPORT, visitor, [&] { import_lengths(np); });
      if(bool(report))
        solve(np);
      if(bool(report))
        timed(report.statistics.seconds.layout, Stage::LAYOUT, visitor, [&] { lay_out(np); });
      if(bool(report))
        timed(report.statistics.seconds.verify, Stage::VERIFY, visitor, [&] { verify(); });
    }
    catch(const std::bad_alloc&)
    {
      report.status = Status::OUT_OF_MEMORY;
    }
  }

private:
  template <typename Visitor, typename Work>
  static void timed(double& seconds, Stage stage, Visitor& visitor, Work work)
  {
    const Stopwatch stopwatch;
    visitor.on_stage(stage);
    work();
    seconds += stopwatch.seconds();
  }

  template <typename NamedParameters>
  void import_lengths(const NamedParameters& np)
  {
    set_lengths(mesh, np);
    const Statistics statistics = report.statistics;
    report = import_report(mesh);
    report.statistics = statistics;
    if(bool(report) && !report.topology.is_disk())
      report.status = Status::WRONG_TOPOLOGY;
  }

  template <typename NamedParameters>
  void solve(const NamedParameters& np)
  {
    using parameters::get_parameter;
    using parameters::is_default_parameter;
    std::vector<std::uint32_t> missing;
    const Conformal_conditions<double> conditions = read_conditions(mesh, missing, np);
    if(!missing.empty())
    {
      report.status = Status::MISSING_CONDITION;
      name_elements(mesh, missing, {}, {}, report);
      return;
    }
    if(refuse_cones(conditions))
      return;
    const auto own_np = Conformal_equivalence::combine_named_parameters(np, initial_guess(np));
    metric = compute_conformal_metric(std::move(mesh.triangulation), conditions, own_np);
    mesh.triangulation = metric.triangulation; // copied only now: the solver has freed its memory

    const Statistics::Seconds seconds = report.statistics.seconds;
    report.statistics = metric.statistics;
    report.statistics.seconds.import = seconds.import;
    report.status = metric.status;
    report.amount = metric.amount;
    name_elements(mesh, metric.vertices, metric.edges, metric.faces, report);
  }

  // A disk with a cone inside has no layout without a cut.
  bool refuse_cones(const Conformal_conditions<double>& conditions)
  {
    std::vector<std::uint32_t> cones;
    const Intrinsic_triangulation<double>& t = mesh.triangulation;
    for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    {
      if(t.is_isolated_vertex(v) || t.is_border_vertex(v))
        continue;
      const bool is_flat = !conditions.is_fixed(v) && conditions.angle_sum(v).is_exact()
                        && conditions.angle_sum(v).units == 2 * Exact_angle<double>::units_of_pi;
      if(!is_flat)
        cones.push_back(v);
    }
    if(cones.empty())
      return false;
    report.status = Status::NOT_AVAILABLE;
    name_elements(mesh, cones, {}, {}, report);
    return true;
  }

  // The map of initial u is keyed by descriptors here, by indices in the solver.
  template <typename NamedParameters>
  auto initial_guess(const NamedParameters& np) const
  {
    using parameters::get_parameter;
    if constexpr(parameters::is_default_parameter<NamedParameters, internal_np::conformal_initial_u_t>::value)
      return parameters::default_values();
    else
    {
      const auto map = get_parameter(np, internal_np::conformal_initial_u);
      const auto by_index = [this, map](std::uint32_t v) { return double(get(map, mesh.vertex(v))); };
      return parameters::initial_log_scale_factor_map(boost::make_function_property_map<std::uint32_t, double>(by_index));
    }
  }

  template <typename NamedParameters>
  void lay_out(const NamedParameters& np)
  {
    layout = compute_layout(mesh.triangulation, metric, Cut_graph(),
                            Conformal_equivalence::combine_named_parameters(np, parameters::layout_frame(frame(np))));
    report.status = layout.status == Status::OK ? report.status : layout.status;
    report.layout_length_error = layout.length_error;
  }

  template <typename NamedParameters>
  auto frame(const NamedParameters& np) const
  {
    using parameters::choose_parameter;
    using parameters::get_parameter;
    return by_index(choose_parameter(get_parameter(np, internal_np::conformal_layout_frame), Layout_frame::CANONICAL));
  }

  Layout_frame by_index(Layout_frame frame) const { return frame; }

  template <typename Vertex>
  Pinned_frame<std::uint32_t> by_index(const Pinned_frame<Vertex>& frame) const
  {
    return {mesh.index_of_vertex(frame.first), frame.first_point, mesh.index_of_vertex(frame.second), frame.second_point};
  }

  // Every triangle of the layout, as rounded, is exactly positive, or named.
  void verify()
  {
    std::vector<std::uint32_t> flipped;
    const auto point = [&](std::uint32_t h) { return Plane_point(layout.corner[h][0], layout.corner[h][1]); };
    for(std::uint32_t f = 0; f < mesh.triangulation.number_of_faces(); ++f)
      if(triangle_orientation({{point(3 * f), point(3 * f + 1), point(3 * f + 2)}}) != CGAL::LEFT_TURN)
        flipped.push_back(f);
    if(flipped.empty())
      return;
    report.status = Status::NOT_INJECTIVE;
    name_elements(mesh, {}, {}, flipped, report);
  }
};

// Writes u, weights and scaled lengths to the maps that were given for them.
template <typename TriangleMesh, typename NamedParameters>
void write_metric(const Flattening<TriangleMesh>& flattening, const NamedParameters& np)
{
  using parameters::get_parameter;
  using parameters::is_default_parameter;
  const Imported_mesh<TriangleMesh>& mesh = flattening.mesh;
  const Intrinsic_triangulation<double>& t = mesh.triangulation;
  const std::vector<double>& u = flattening.metric.log_scale_factors;
  double least = (std::numeric_limits<double>::max)();
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v))
      least = (std::min)(least, u[v]);

  if constexpr(!is_default_parameter<NamedParameters, internal_np::conformal_u_t>::value)
    for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
      if(!t.is_isolated_vertex(v))
        put(get_parameter(np, internal_np::conformal_u), mesh.vertex(v), u[v]);
  if constexpr(!is_default_parameter<NamedParameters, internal_np::conformal_weight_t>::value)
    for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
      if(!t.is_isolated_vertex(v))
        put(get_parameter(np, internal_np::conformal_weight), mesh.vertex(v), projective_weight(u[v], least));
  if constexpr(!is_default_parameter<NamedParameters, internal_np::conformal_scaled_length_t>::value)
    for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
      put(get_parameter(np, internal_np::conformal_scaled_length), mesh.edge(e),
          flattening.metric.scaled_length(t.edge_halfedge(e)));
}

// Writes the corners to all halfedges of imported faces; a halfedge without a face
// gets the corner of the face across.
template <typename TriangleMesh, typename HalfedgeUVMap>
void write_corners(const Imported_mesh<TriangleMesh>& mesh, const Layout<double>& layout, HalfedgeUVMap uv)
{
  typedef typename boost::property_traits<HalfedgeUVMap>::value_type Point_2;
  const Intrinsic_triangulation<double>& t = mesh.triangulation;
  const auto point = [&](std::uint32_t h) { return Point_2(layout.corner[h][0], layout.corner[h][1]); };
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
  {
    auto hd = mesh.halfedge(3 * f);
    for(std::uint32_t h = 3 * f; h < 3 * f + 3; ++h, hd = next(hd, mesh.mesh()))
    {
      put(uv, hd, point(h));
      if(t.is_border(h))
        put(uv, opposite(hd, mesh.mesh()), point(t.previous(h)));
    }
  }
}

template <typename TriangleMesh, typename NamedParameters>
void write_report(const Flattening_report<TriangleMesh>& report, const NamedParameters& np)
{
  if constexpr(!parameters::is_default_parameter<NamedParameters, internal_np::conformal_report_t>::value)
    parameters::get_parameter(np, internal_np::conformal_report).get() = report;
  else
    CGAL_USE(report);
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceDoors
///
/// flattens a triangle mesh: finds the flat metric that is conformally equivalent to the mesh's and
/// meets the conditions, and lays it out in the plane. The result preserves length cross ratios
/// to rounding, and no triangle is flipped, decided exactly on the coordinates written.
///
/// This version takes topological disks (isolated vertices are carried through untouched)
/// without interior cones, and keeps the triangulation.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam HalfedgeUVMap a model of `WritablePropertyMap` with key type
///         `boost::graph_traits<TriangleMesh>::%halfedge_descriptor` and a value type that can be made from two `double`, such as
///         `Point_2` of any kernel
/// \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
///
/// \param tm a triangle mesh
/// \param uv receives, at every halfedge `h`, where `target(h, tm)` lies in the triangle of `face(h, tm)`; a
///        border halfedge receives what `prev(opposite(h, tm), tm)` does
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below,
///        beginning with one of this package
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{edge_length_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{border_angle_map} \cgalParamDescription{as in `read_conditions()`} \cgalParamNEnd
///   \cgalParamNBegin{cone_angle_map} \cgalParamDescription{as in `read_conditions()`} \cgalParamNEnd
///   \cgalParamNBegin{vertex_is_constrained_map} \cgalParamDescription{as in `read_conditions()`} \cgalParamNEnd
///   \cgalParamNBegin{prescribed_log_scale_factor_map} \cgalParamDescription{as in `read_conditions()`} \cgalParamNEnd
///   \cgalParamNBegin{initial_log_scale_factor_map}
///     \cgalParamDescription{where the solver begins}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a value type convertible to `double`}
///     \cgalParamDefault{the discretely harmonic extension of the fixed u}
///   \cgalParamNEnd
///   \cgalParamNBegin{log_scale_factor_map}
///     \cgalParamDescription{receives u}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{projective_weight_map}
///     \cgalParamDescription{receives the weights e^{-u} of projective interpolation (section 3.4), scaled to a maximum of 1}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{scaled_edge_length_map}
///     \cgalParamDescription{receives the lengths of the flat metric}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%edge_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{layout_frame}
///     \cgalParamDescription{how the layout is placed in the plane}
///     \cgalParamType{`Layout_frame`, or `Pinned_frame<vertex_descriptor>`}
///     \cgalParamDefault{`Layout_frame::CANONICAL`}
///   \cgalParamNEnd
///   \cgalParamNBegin{gradient_tolerance, number_of_iterations, newton_strategy, retriangulation, visitor}
///     \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{sparse_linear_solver} \cgalParamDescription{as in `compute_conformal_metric()`} \cgalParamNEnd
///   \cgalParamNBegin{flattening_report}
///     \cgalParamDescription{receives a copy of what is returned}
///     \cgalParamType{`std::reference_wrapper<Flattening_report<TriangleMesh> >`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the report. Maps are written iff it is a success. Statuses: those of `import_mesh()` and
///         `Conformal_metric_solver::solve()`, `WRONG_TOPOLOGY`, `MISSING_CONDITION` (vertices), `NOT_AVAILABLE` (vertices:
///         interior cones), and `NOT_INJECTIVE` (faces: triangles that rounding has made flat or flipped, where
///         scale factors range too far for `double`).
template <typename TriangleMesh, typename HalfedgeUVMap,
          typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> flatten(const TriangleMesh& tm,
                                        HalfedgeUVMap uv,
                                        const NamedParameters& np = parameters::default_values())
{
  const internal::Stopwatch stopwatch;
  internal::Flattening<TriangleMesh> flattening{Imported_mesh<TriangleMesh>(tm)};
  flattening.report.statistics.seconds.import = stopwatch.seconds();
  flattening.run(np);
  if(bool(flattening.report))
  {
    internal::write_corners(flattening.mesh, flattening.layout, uv);
    internal::write_metric(flattening, np);
  }
  internal::write_report(flattening.report, np);
  return flattening.report;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_H
