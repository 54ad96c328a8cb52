// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_WRITE_REFINED_SPHERE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_WRITE_REFINED_SPHERE_H

#include <CGAL/Conformal_equivalence/Refined_mesh_elements.h>
#include <CGAL/Conformal_equivalence/Spherical_refinement.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/refined_mesh.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Sphere_mapping.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/property_map/property_map.hpp>

#include <cstddef>
#include <cstdint>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Makes a mesh of the refinement, and writes its maps. Returns whether the mesh can hold it: if not, the mesh is empty.
template <typename TriangleMesh, typename RefinedMesh, typename VertexPointMap, typename NamedParameters, typename NamedParametersRefined>
bool write_refined_sphere(const Sphere_mapping<TriangleMesh, double>& mapping, RefinedMesh& refined, VertexPointMap sphere_map,
                          const NamedParameters& np, const NamedParametersRefined& np_refined)
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  typedef typename boost::property_traits<VertexPointMap>::value_type Point_3;
  const Spherical_refinement<double>& result = mapping.refinement;
  Refined_mesh_elements<RefinedMesh> elements;
  add_refined_vertices(mapping.mesh, result.parts,
    choose_parameter(get_parameter(np, internal_np::vertex_point), get(CGAL::vertex_point, mapping.mesh.mesh())), refined,
    choose_parameter(get_parameter(np_refined, internal_np::vertex_point), get(CGAL::vertex_point, refined)), elements);
  if(!add_refined_faces(result.parts, refined, elements))
  {
    CGAL::clear(refined);
    return false;
  }
  for(std::size_t v = 0; v < elements.vertices.size(); ++v)
  {
    put(sphere_map, elements.vertices[v], Point_3(result.points[v][0], result.points[v][1], result.points[v][2]));
    put_if_given(np_refined, internal_np::conformal_weight, elements.vertices[v], result.parts.weights[v]);
  }
  for(std::uint32_t f = 0; f < result.parts.number_of_faces(); ++f)
    put_if_given(np_refined, internal_np::conformal_input_face, elements.faces[f], mapping.mesh.face(result.parts.input_face[f]));
  return true;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_WRITE_REFINED_SPHERE_H
