// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file make_refined_mesh.h
/// A mesh of the common refinement of a surface and a flat metric, with texture coordinates that are continuous across all edges but those
/// of the seam (section 3.2 of Springborn, Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_MAKE_REFINED_MESH_H
#define CGAL_CONFORMAL_EQUIVALENCE_MAKE_REFINED_MESH_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Refined_mesh_elements.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/refined_mesh.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstdint>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// makes a mesh of a refinement: with the polygons (or triangles) of the refinement for faces, which are parts of the input faces, the
/// points on the input surface, and texture coordinates.
///
/// The vertex `v` of the refinement becomes `vertices[v]` of the result; so it lies on the edge
/// `mesh.edge(refinement.crossings[c].input_edge)` if it is the crossing `c`; the face `f` is a part of `mesh.face(refinement.input_face[f])`.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam RefinedMesh a model of `MutableFaceGraph`
/// \tparam HalfedgeUVMap a model of `WritablePropertyMap` with key type `boost::graph_traits<RefinedMesh>::%halfedge_descriptor` and a
///         value type that can be made from two `double`
///
/// \param mesh the mesh of which the triangulation was given to the solver
/// \param refinement what `compute_common_refinement()`, or `triangulate_refinement()`, returned for it. \pre it is a success
/// \param out the mesh, to which vertices and faces are added. It has to be empty.
/// \param uv receives, at every halfedge `h` of `out`, where `target(h, out)` lies in `face(h, out)`; a border halfedge receives what
///        `prev(opposite(h, out), out)` does
/// \param np_in an optional sequence of \ref bgl_namedparameters "Named Parameters" for the mesh given: `vertex_point_map`
/// \param np_out an optional sequence of \ref bgl_namedparameters "Named Parameters" for the mesh made, among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{receives the points}
///     \cgalParamType{a read-write property map with key type `boost::graph_traits<RefinedMesh>::%vertex_descriptor` and as value type a `Point_3` that can be made from three coordinates}
///     \cgalParamDefault{`get(CGAL::vertex_point, out)`}
///   \cgalParamNEnd
///   \cgalParamNBegin{projective_weight_map}
///     \cgalParamDescription{receives the weights: homogeneous texture coordinates are w times (x, y, 1)}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<RefinedMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_is_seam_map}
///     \cgalParamDescription{receives whether the two sides of an edge lie in different places; `false` on borders}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<RefinedMesh>::%edge_descriptor` and value type `bool`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the elements made; without faces, and with `out` empty again, if `out` cannot hold them (several faces with the same corners: two
///        triangles glued along
///         all sides). Linear time, but for the degrees of vertices.
template <typename TriangleMesh, typename NT, typename RefinedMesh, typename HalfedgeUVMap,
          typename NamedParametersIn = parameters::Default_named_parameters,
          typename NamedParametersOut = parameters::Default_named_parameters>
Refined_mesh_elements<RefinedMesh> make_refined_mesh(const Imported_mesh<TriangleMesh, NT>& mesh,
                                                     const Common_refinement<NT>& refinement,
                                                     RefinedMesh& out,
                                                     HalfedgeUVMap uv,
                                                     const NamedParametersIn& np_in = parameters::default_values(),
                                                     const NamedParametersOut& np_out = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  const auto point_in = choose_parameter(get_parameter(np_in, internal_np::vertex_point), get(CGAL::vertex_point, mesh.mesh()));
  auto point_out = choose_parameter(get_parameter(np_out, internal_np::vertex_point), get(CGAL::vertex_point, out));
  CGAL_precondition(bool(refinement) && vertices(out).begin() == vertices(out).end());

  Refined_mesh_elements<RefinedMesh> result;
  internal::add_refined_vertices(mesh, refinement, point_in, out, point_out, result);
  if(!internal::add_refined_faces(refinement, out, result))
  {
    CGAL::clear(out);
    return Refined_mesh_elements<RefinedMesh>();
  }
  internal::write_refined_maps(refinement, result, out, uv, np_out);
  return result;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_MAKE_REFINED_MESH_H
