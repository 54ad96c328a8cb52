// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file flatten_refined.h
/// The whole way in one call where edges may be flipped on it (section 3.2 of Springborn, Schroeder and Pinkall, 2008, and the discrete
/// uniformization theorem of Gu, Luo, Sun and Wu, 2018): the result is a mesh of the common refinement, on which the map to the plane is
/// continuous and no triangle is flipped, for every surface and all angles that can occur.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_REFINED_H
#define CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_REFINED_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/internal/Doors/parameters_of_doors.h>
#include <CGAL/Conformal_equivalence/internal/Doors/refined_output.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <boost/property_map/property_map.hpp>

#include <utility>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceDoors
///
/// flattens a triangle mesh of any topology, as `flatten()` does, and makes a mesh of the parts into which the edges of the metric's triangulation
/// cut the given one. Where no edge was flipped that is a copy. The texture coordinates on the new mesh are continuous across all edges but those
/// of the
/// seam; with the projective weights, the map of every triangle is the restriction of the projective maps of section 3.4 of the paper, and
/// preserves the circumcircles of the triangles given.
///
/// Vertices of `tm` come first in `refined`, in the order of `vertices(tm)`, then the crossings of edges, which lie on edges of `tm`. All faces are
/// triangles
/// unless these would make several edges between the same two vertices; then they are convex polygons.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam RefinedMesh a model of `MutableFaceGraph`
/// \tparam HalfedgeUVMap a model of `WritablePropertyMap` with key type `boost::graph_traits<RefinedMesh>::%halfedge_descriptor` and a
///         value type that can be made from two `double`
///
/// \param tm a triangle mesh
/// \param refined the mesh to be made, empty
/// \param uv receives, at every halfedge `h` of `refined`, where `target(h)` lies in `face(h)`; a border halfedge receives what
///        `prev(opposite(h))` does
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of `flatten()`, with maps of `tm`
/// \param np_refined an optional sequence of \ref bgl_namedparameters "Named Parameters" for `refined`: those of
///        `make_refined_mesh()`, and the one listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{input_face_map}
///     \cgalParamDescription{receives the face of `tm` that a face of `refined` is a part of}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<RefinedMesh>::%face_descriptor` and value type `boost::graph_traits<TriangleMesh>::%face_descriptor`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the report of `flatten()`, with `bent_faces`. Meshes and maps are written iff it is a success. Statuses: those of `flatten()`,
///         where `NOT_INJECTIVE` means that rounding has made a triangle of `refined` flat or flipped (faces: those of `tm` that hold such
///         triangles), and
///         `NOT_REPRESENTABLE` if `refined` cannot hold the result.
///
/// Time is that of `flatten()`, and linear in the number of crossings.
template <typename TriangleMesh, typename RefinedMesh, typename HalfedgeUVMap,
          typename NamedParameters = parameters::Default_named_parameters,
          typename NamedParametersRefined = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> flatten_refined(const TriangleMesh& tm,
                                                RefinedMesh& refined,
                                                HalfedgeUVMap uv,
                                                const NamedParameters& np = parameters::default_values(),
                                                const NamedParametersRefined& np_refined = parameters::default_values())
{
  static_assert(internal::Check_halfedge_map<HalfedgeUVMap, RefinedMesh>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_flatten, TriangleMesh, NamedParameters>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_refined_mesh, RefinedMesh, NamedParametersRefined>::value);
  const internal::Stopwatch stopwatch;
  internal::Flattening<TriangleMesh> flattening(internal::import_charts(tm, np), stopwatch);
  flattening.run_with_refinement(np, true);
  if(bool(flattening.report))
  {
    const auto parts = internal::make_mesh_of_parts(flattening, refined, uv, np, np_refined);
    if(bool(flattening.report))
      internal::write_refined_output(flattening, parts, np, np_refined);
  }
  internal::write_report(flattening.report, np);
  return std::move(flattening.report);
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_REFINED_H
