// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file compute_refined_seamless_parameterization.h
/// Seamless textures (section 6 of Springborn, Schroeder and Pinkall, 2008) where edges had to be flipped (section 3.2): on a mesh of the parts into
/// which the edges of the metric's triangulation cut the given one.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_REFINED_SEAMLESS_PARAMETERIZATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_REFINED_SEAMLESS_PARAMETERIZATION_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/compute_seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Refined_seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <utility>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceDoors
///
/// makes a seamless parameterization as `compute_seamless_parameterization()` does, on a mesh of the parts into which the edges of the metric's
/// triangulation cut the given one, as `flatten_refined()` makes it. On such a mesh the flat layout has no inverted triangles to begin with,
/// however many edges were flipped: on surfaces with handles, and on coarse ones with sharp features, it is what succeeds where straight triangles
/// are inverted.
///
/// Vertices of `tm` come first in `refined`, in the order of `vertices(tm)`, then the crossings of edges, which lie on edges of `tm`. All faces are
/// triangles.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam RefinedMesh a model of `MutableFaceGraph`, and of `FaceListGraph`
/// \tparam HalfedgeUVMap as in `flatten_refined()`
///
/// \param tm a triangle mesh of one component
/// \param refined the mesh to be made, empty
/// \param uv receives, at every halfedge `h` of `refined`, where `target(h)` lies in the triangle of `face(h)`, in units of the lattice, see `Tiling`
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of `compute_seamless_parameterization()`
/// \param np_refined an optional sequence of \ref bgl_namedparameters "Named Parameters" for `refined`: `vertex_point_map` and `edge_is_seam_map` as
///        in `make_refined_mesh()`, `input_face_map` as in `flatten_refined()`
///
/// \return the report of `compute_seamless_parameterization()`, with transitions across the edges of `tm`: every part of an edge has that of the
///         edge. Meshes and maps are written iff it is a success, or `BOUND_NOT_MET`. Statuses are the same, with faces of `tm` that have inverted
///         parts, and `NOT_REPRESENTABLE` if `refined` cannot hold the triangles, `TOO_MANY_CROSSINGS`.
///
/// Time: that of `compute_seamless_parameterization()` on the mesh that is made.
///
/// \sa `CGAL::Conformal_equivalence::compute_seamless_parameterization()`
/// \sa `CGAL::Conformal_equivalence::flatten_refined()`
template <typename TriangleMesh, typename RefinedMesh, typename HalfedgeUVMap,
          typename NamedParameters = parameters::Default_named_parameters,
          typename NamedParametersRefined = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> compute_refined_seamless_parameterization(const TriangleMesh& tm,
                                                                          RefinedMesh& refined,
                                                                          HalfedgeUVMap uv,
                                                                          const NamedParameters& np = parameters::default_values(),
                                                                          const NamedParametersRefined& np_refined = parameters::default_values())
{
  static_assert(internal::Check_halfedge_map<HalfedgeUVMap, RefinedMesh>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_seamless_parameterization, TriangleMesh, NamedParameters>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_refined_seamless_mesh, RefinedMesh, NamedParametersRefined>::value);
  const internal::Stopwatch stopwatch;
  internal::Refined_seamless_parameterization<TriangleMesh, RefinedMesh> seamless(internal::import_charts(tm, np), stopwatch,
                                                                                  internal::read_seamless_options(np), refined);
  seamless.run(uv, np, np_refined);
  Flattening_report<TriangleMesh>& report = seamless.report();
  internal::write_report(report, np);
  return std::move(report);
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_REFINED_SEAMLESS_PARAMETERIZATION_H
