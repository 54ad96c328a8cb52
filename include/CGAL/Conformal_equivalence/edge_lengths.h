// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file edge_lengths.h
/// What can be said of a triangle mesh from the lengths of its edges alone: angles, curvatures, length cross ratios, and how two metrics are
/// related (section 2 of Springborn, Schroeder and Pinkall, 2008). The same as in `discrete_metric.h`, for meshes of \cgal, with
/// property maps.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_EDGE_LENGTHS_H
#define CGAL_CONFORMAL_EQUIVALENCE_EDGE_LENGTHS_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/discrete_metric.h>
#include <CGAL/Conformal_equivalence/internal/Doors/values_of_mesh.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <boost/graph/graph_traits.hpp>

#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \name Functions for Meshes
/// Every one takes the named parameters of `import_mesh()` and returns its report: status
/// `OK`, `EMPTY_MESH`, `NOT_TRIANGULATED`, `NON_MANIFOLD`, `INVALID_NUMBER` or `ZERO_LENGTH_EDGE`, with the elements
/// at fault. Maps are written on success only. Linear time.
/// @{

/// \ingroup PkgConformalEquivalenceMetric
///
/// writes the lengths of the edges of `tm`, the distances of the points, to `edge_length_map`. Edges
/// without a face are left out.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam EdgeLengthMap a model of `WritablePropertyMap` with key type
///         `boost::graph_traits<TriangleMesh>::%edge_descriptor` and a value type constructible from `double`
/// \param tm a mesh, all of whose faces should be triangles
/// \param edge_length_map the lengths
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of `import_mesh()`
template <typename TriangleMesh, typename EdgeLengthMap,
          typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> compute_edge_lengths(const TriangleMesh& tm, EdgeLengthMap edge_length_map,
                                                     const NamedParameters& np = parameters::default_values())
{
  return internal::with_imported_mesh(tm, np, [&](const Imported_mesh<TriangleMesh>& mesh)
  {
    internal::put_at_edges(mesh, mesh.triangulation.lengths(), edge_length_map);
  });
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// decides whether the lengths of `tm` are a discrete metric (Definition 2.1): `OK` if the triangle inequalities
/// hold strictly in all faces, decided exactly; else `DEGENERATE_METRIC` with the `faces` that violate them.
///
/// \param tm a mesh, all of whose faces should be triangles
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of `import_mesh()`
template <typename TriangleMesh, typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> check_metric(const TriangleMesh& tm,
                                             const NamedParameters& np = parameters::default_values())
{
  const Imported_mesh<TriangleMesh> mesh = import_mesh(tm, np);
  Flattening_report<TriangleMesh> report = internal::import_report(mesh);
  std::vector<std::uint32_t> faces;
  if(mesh.status == Status::OK && !is_valid_metric(mesh.triangulation, &faces))
  {
    report.status = Status::DEGENERATE_METRIC;
    internal::name_elements(mesh, {}, {}, faces, report);
  }
  return report;
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// writes the angle sums of the vertices of `tm`, in radians, to `angle_sum_map`.
///
/// \tparam VertexAngleMap a model of `WritablePropertyMap` with key type
///         `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a value type constructible from `double`
/// \param tm a mesh, all of whose faces should be triangles
/// \param angle_sum_map the angle sums; 0 at isolated vertices
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of `import_mesh()`
template <typename TriangleMesh, typename VertexAngleMap,
          typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> compute_angle_sums(const TriangleMesh& tm, VertexAngleMap angle_sum_map,
                                                   const NamedParameters& np = parameters::default_values())
{
  return internal::with_imported_mesh(tm, np, [&](const Imported_mesh<TriangleMesh>& mesh)
  {
    internal::put_at_vertices(mesh, angle_sums(mesh.triangulation), angle_sum_map);
  });
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// writes the discrete curvatures of the vertices of `tm`, in radians (see `discrete_curvatures()`), to
/// `curvature_map`.
///
/// \tparam VertexCurvatureMap a model of `WritablePropertyMap` with key type
///         `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a value type constructible from `double`
/// \param tm a mesh, all of whose faces should be triangles
/// \param curvature_map the curvatures; 0 at isolated vertices
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of `import_mesh()`
template <typename TriangleMesh, typename VertexCurvatureMap,
          typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> compute_discrete_curvatures(const TriangleMesh& tm, VertexCurvatureMap curvature_map,
                                                            const NamedParameters& np = parameters::default_values())
{
  return internal::with_imported_mesh(tm, np, [&](const Imported_mesh<TriangleMesh>& mesh)
  {
    internal::put_at_vertices(mesh, discrete_curvatures(mesh.triangulation), curvature_map);
  });
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// writes the length cross ratios (4) of the edges of `tm` to `cross_ratio_map`.
///
/// \tparam EdgeCrossRatioMap a model of `WritablePropertyMap` with key type
///         `boost::graph_traits<TriangleMesh>::%edge_descriptor` and a value type constructible from `double`
/// \param tm a mesh, all of whose faces should be triangles
/// \param cross_ratio_map the cross ratios; 1 at border edges, which have none
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of `import_mesh()`
template <typename TriangleMesh, typename EdgeCrossRatioMap,
          typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> compute_length_cross_ratios(const TriangleMesh& tm, EdgeCrossRatioMap cross_ratio_map,
                                                            const NamedParameters& np = parameters::default_values())
{
  return internal::with_imported_mesh(tm, np, [&](const Imported_mesh<TriangleMesh>& mesh)
  {
    internal::put_at_edges(mesh, length_cross_ratios(mesh.triangulation), cross_ratio_map);
  });
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// writes the lengths e^{(u_i + u_j) / 2} l_ij, equation (2), to `scaled_edge_length_map`.
///
/// \tparam LogScaleFactorMap a model of `ReadablePropertyMap` with key type
///         `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a value type convertible to `double`
/// \tparam EdgeLengthMap a model of `WritablePropertyMap` with key type
///         `boost::graph_traits<TriangleMesh>::%edge_descriptor` and a value type constructible from `double`
/// \param tm a mesh, all of whose faces should be triangles
/// \param log_scale_factor_map u; a value that is not finite at a vertex with a face: `INVALID_NUMBER`
/// \param scaled_edge_length_map the new lengths; may be the map of the old ones
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of `import_mesh()`
template <typename TriangleMesh, typename LogScaleFactorMap, typename EdgeLengthMap,
          typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> scale_edge_lengths(const TriangleMesh& tm, LogScaleFactorMap log_scale_factor_map,
                                                   EdgeLengthMap scaled_edge_length_map,
                                                   const NamedParameters& np = parameters::default_values())
{
  const Imported_mesh<TriangleMesh> mesh = import_mesh(tm, np);
  Flattening_report<TriangleMesh> report = internal::import_report(mesh);
  if(!report)
    return report;
  const std::vector<double> u = internal::values_at_vertices(mesh, log_scale_factor_map);
  std::vector<std::uint32_t> faulty;
  for(std::uint32_t v = 0; v < u.size(); ++v)
    if(!std::isfinite(u[v]) && !mesh.triangulation.is_isolated_vertex(v))
      faulty.push_back(v);
  if(faulty.empty())
    internal::put_at_edges(mesh, apply_log_scale_factors(mesh.triangulation, u).lengths(), scaled_edge_length_map);
  else
  {
    report.status = Status::INVALID_NUMBER;
    internal::name_elements(mesh, faulty, {}, {}, report);
  }
  return report;
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// returns `true` iff both maps hold positive lengths of the edges of `tm` and these are discretely conformally
/// equivalent (Definition 2.2): the length cross ratios (4) differ by at most `tolerance`, relatively.
///
/// \tparam EdgeLengthMap0 a model of `ReadablePropertyMap` with key type
///         `boost::graph_traits<TriangleMesh>::%edge_descriptor` and a value type convertible to `double`
/// \tparam EdgeLengthMap1 as `EdgeLengthMap0`
/// \param tm a mesh, all of whose faces should be triangles
/// \param edge_length_map_0 the one metric
/// \param edge_length_map_1 the other metric
/// \param tolerance the relative difference allowed
template <typename TriangleMesh, typename EdgeLengthMap0, typename EdgeLengthMap1
#ifndef DOXYGEN_RUNNING
          , std::enable_if_t<!std::is_arithmetic<EdgeLengthMap1>::value, int> = 0 // that is a tolerance
#endif
          >
bool are_conformally_equivalent(const TriangleMesh& tm, EdgeLengthMap0 edge_length_map_0,
                                EdgeLengthMap1 edge_length_map_1, double tolerance = 1e-8)
{
  bool result = false;
  (void) internal::with_two_metrics(tm, edge_length_map_0, edge_length_map_1, [&](const auto& mesh_0, const auto& mesh_1, auto&)
  {
    result = are_conformally_equivalent(mesh_0.triangulation, mesh_1.triangulation, tolerance);
  });
  return result;
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// recovers the logarithmic scale factors u between two metrics on `tm` (see
/// `log_scale_factors_between()`) and writes them to `log_scale_factor_map`. The `amount` of the report is
/// the residual, by which equation (2) fails: as large as rounding iff the metrics are conformally equivalent.
///
/// \tparam LogScaleFactorMap a model of `WritablePropertyMap` with key type
///         `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a value type constructible from `double`
/// \param tm a mesh, all of whose faces should be triangles
/// \param edge_length_map_0 the lengths l; type as for `are_conformally_equivalent()`
/// \param edge_length_map_1 the lengths e^{(u_i + u_j) / 2} l
/// \param log_scale_factor_map u; 0 at isolated vertices
template <typename TriangleMesh, typename EdgeLengthMap0, typename EdgeLengthMap1, typename LogScaleFactorMap>
Flattening_report<TriangleMesh> compute_log_scale_factors(const TriangleMesh& tm, EdgeLengthMap0 edge_length_map_0,
                                                          EdgeLengthMap1 edge_length_map_1,
                                                          LogScaleFactorMap log_scale_factor_map)
{
  return internal::with_two_metrics(tm, edge_length_map_0, edge_length_map_1,
                                    [&](const auto& mesh_0, const auto& mesh_1, auto& report)
  {
    const Log_scale_factors<double> found = log_scale_factors_between(mesh_0.triangulation, mesh_1.triangulation);
    report.amount = found.residual;
    internal::put_at_vertices(mesh_0, found.log_scale_factors, log_scale_factor_map);
  });
}

/// @}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_EDGE_LENGTHS_H
