// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What `flatten_refined()` makes of a flattening: a mesh of the common refinement, and the maps of both meshes.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_REFINED_OUTPUT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_REFINED_OUTPUT_H

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/Refined_mesh_elements.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/make_refined_mesh.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/triangulate_refinement.h>

#include <boost/property_map/property_map.hpp>

#include <cstdint>
#include <utility>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A refined mesh, and which parts of the surface its faces are.
template <typename RefinedMesh>
struct Refined_mesh_parts
{
  Refined_mesh_elements<RefinedMesh> elements;
  Common_refinement<double> faces;
};

// Makes the mesh, of triangles if it can hold them, else of polygons; the report of the flattening tells if it holds neither.
template <typename Flattening, typename RefinedMesh, typename HalfedgeUVMap, typename NamedParameters, typename NamedParametersRefined>
Refined_mesh_parts<RefinedMesh> make_mesh_of_parts(Flattening& flattening, RefinedMesh& refined, HalfedgeUVMap uv, const NamedParameters& np,
                                                   const NamedParametersRefined& np_refined)
{
  Refined_mesh_parts<RefinedMesh> result;
  result.faces = triangulate_refinement(flattening.refinement);
  flattening.judge(result.faces);
  if(!bool(flattening.report))
    return result;
  result.elements = make_refined_mesh(flattening.mesh, result.faces, refined, uv, np, np_refined);
  if(!result.elements.faces.empty())
    return result;
  result.faces = flattening.refinement;
  result.elements = make_refined_mesh(flattening.mesh, result.faces, refined, uv, np, np_refined);
  if(result.elements.faces.empty())
    flattening.report.status = Status::NOT_REPRESENTABLE;
  return result;
}

template <typename Flattening, typename RefinedMesh, typename NamedParameters, typename NamedParametersRefined>
void write_refined_output(Flattening& flattening, const Refined_mesh_parts<RefinedMesh>& parts, const NamedParameters& np,
                          const NamedParametersRefined& np_refined)
{
  write_metric(flattening, np);
  write_seam(flattening, np);
  for(std::uint32_t f = 0; f < parts.faces.number_of_faces(); ++f)
    put_if_given(np_refined, internal_np::conformal_input_face, parts.elements.faces[f], flattening.mesh.face(parts.faces.input_face[f]));
  write_if_given(np, internal_np::conformal_common_refinement, std::move(flattening.refinement));
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_REFINED_OUTPUT_H
