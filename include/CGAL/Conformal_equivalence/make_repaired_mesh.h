// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file make_repaired_mesh.h
/// A mesh of a triangulation that `repair_locally()` has changed.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_MAKE_REPAIRED_MESH_H
#define CGAL_CONFORMAL_EQUIVALENCE_MAKE_REPAIRED_MESH_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Repaired_metric.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <array>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// The elements of a mesh that `make_repaired_mesh()` has made, by their numbers in the repaired triangulation.
template <typename RepairedMesh>
struct Repaired_mesh_elements
{
  std::vector<typename boost::graph_traits<RepairedMesh>::vertex_descriptor> vertices;     ///< by vertex: first those of the mesh given
  std::vector<typename boost::graph_traits<RepairedMesh>::halfedge_descriptor> halfedges;  ///< by halfedge
  std::vector<typename boost::graph_traits<RepairedMesh>::face_descriptor> faces;          ///< by face
};

namespace internal {

// The points of the mesh given, and of the new vertices on edges of what was there at the time.
template <typename TriangleMesh, typename NT, typename PointMapIn, typename RepairedMesh, typename PointMapOut>
void add_repaired_vertices(const Imported_mesh<TriangleMesh, NT>& mesh, const Repaired_metric<NT>& repaired, PointMapIn point_in,
                           RepairedMesh& out, PointMapOut point_out, Repaired_mesh_elements<RepairedMesh>& result)
{
  typedef typename boost::property_traits<PointMapOut>::value_type Point_3;
  typedef std::decay_t<decltype(std::declval<Point_3>().x())> FT;
  const auto add = [&](const Point_3& p)
  {
    result.vertices.push_back(add_vertex(out));
    put(point_out, result.vertices.back(), p);
  };
  for(std::uint32_t v = 0; v < mesh.triangulation.number_of_vertices(); ++v)
  {
    const auto& p = get(point_in, mesh.vertex(v));
    add(Point_3(p.x(), p.y(), p.z()));
  }
  for(const Edge_change<NT>& change : repaired.changes)
  {
    if(change.kind != change.SPLIT)
      continue;
    const Point_3 p = get(point_out, result.vertices[change.vertices[0]]), q = get(point_out, result.vertices[change.vertices[1]]);
    const FT b(static_cast<double>(change.parameter)), a = 1 - b;
    add(Point_3(a * p.x() + b * q.x(), a * p.y() + b * q.y(), a * p.z() + b * q.z()));
  }
}

// The faces, if the mesh can hold them.
template <typename NT, typename RepairedMesh>
bool add_repaired_faces(const Intrinsic_triangulation<NT>& t, RepairedMesh& out, Repaired_mesh_elements<RepairedMesh>& result)
{
  typedef boost::graph_traits<RepairedMesh> Traits;
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
  {
    const std::array<typename Traits::vertex_descriptor, 3> corners =
      {{ result.vertices[t.origin(t.halfedge(f))], result.vertices[t.origin(t.halfedge(f, 1))], result.vertices[t.origin(t.halfedge(f, 2))] }};
    const typename Traits::face_descriptor fd = CGAL::Euler::add_face(corners, out);
    if(fd == Traits::null_face())
      return false;
    result.faces.push_back(fd);
    typename Traits::halfedge_descriptor h = halfedge(fd, out);
    while(source(h, out) != corners[0])
      h = next(h, out);
    for(int k = 0; k < 3; ++k, h = next(h, out))
      result.halfedges.push_back(h);
  }
  return true;
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceLayout
///
/// makes a mesh of a triangulation that `repair_locally()` has changed: a copy of the mesh given with the same flips and splits.
/// New vertices lie on the straight line between the ends of the edge that was split; this edge is one of the mesh given, or part
/// of one, unless it was flipped before.
///
/// Vertices and faces are added in the order of their numbers, so the vertices of the mesh given come first, in the order of
/// `vertices(tm)`, isolated ones included.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam RepairedMesh a model of `MutableFaceGraph`
///
/// \param mesh the mesh of which the triangulation was given to `repair_locally()`; all of its faces imported, and not cut
/// \param repaired what `repair_locally()` returned
/// \param out the mesh, to which vertices and faces are added. It has to be empty.
/// \param np_in an optional sequence of \ref bgl_namedparameters "Named Parameters" for the mesh given: `vertex_point_map`
/// \param np_out an optional sequence of \ref bgl_namedparameters "Named Parameters" for the mesh made, among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{receives the points}
///     \cgalParamType{a read-write property map with key type `boost::graph_traits<RepairedMesh>::%vertex_descriptor` and as value type a `Point_3` that can be made from three coordinates}
///     \cgalParamDefault{`get(CGAL::vertex_point, out)`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the elements made; empty, and `out` empty again, if `out` cannot hold them (several edges between the same vertices,
///         which is so only if the mesh given has them). Linear time, but for the degrees of vertices.
template <typename TriangleMesh, typename NT, typename RepairedMesh,
          typename NamedParametersIn = parameters::Default_named_parameters,
          typename NamedParametersOut = parameters::Default_named_parameters>
Repaired_mesh_elements<RepairedMesh> make_repaired_mesh(const Imported_mesh<TriangleMesh, NT>& mesh,
                                                        const Repaired_metric<NT>& repaired,
                                                        RepairedMesh& out,
                                                        const NamedParametersIn& np_in = parameters::default_values(),
                                                        const NamedParametersOut& np_out = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  const auto point_in = choose_parameter(get_parameter(np_in, internal_np::vertex_point), get(CGAL::vertex_point, mesh.mesh()));
  auto point_out = choose_parameter(get_parameter(np_out, internal_np::vertex_point), get(CGAL::vertex_point, out));
  CGAL_precondition(vertices(out).begin() == vertices(out).end());

  Repaired_mesh_elements<RepairedMesh> result;
  internal::add_repaired_vertices(mesh, repaired, point_in, out, point_out, result);
  if(internal::add_repaired_faces(repaired.triangulation(), out, result))
    return result;
  CGAL::clear(out);
  return Repaired_mesh_elements<RepairedMesh>();
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_MAKE_REPAIRED_MESH_H
