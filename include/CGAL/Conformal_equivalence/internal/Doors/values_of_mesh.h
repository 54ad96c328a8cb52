// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// From a mesh with maps of its vertices and edges to an `Intrinsic_triangulation` with values by index, and back.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_VALUES_OF_MESH_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_VALUES_OF_MESH_H

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <boost/property_map/property_map.hpp>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Imports `tm` and hands it to `use` if nothing is wrong with it.
template <typename TriangleMesh, typename NamedParameters, typename Use>
Flattening_report<TriangleMesh> with_imported_mesh(const TriangleMesh& tm, const NamedParameters& np, Use use)
{
  const Imported_mesh<TriangleMesh> mesh = import_mesh(tm, np);
  if(mesh.status == Status::OK)
    use(mesh);
  return import_report(mesh);
}

template <typename TriangleMesh, typename VertexMap>
void put_at_vertices(const Imported_mesh<TriangleMesh>& mesh, const std::vector<double>& values, VertexMap map)
{
  typedef typename boost::property_traits<VertexMap>::value_type Value;
  for(std::uint32_t v = 0; v < values.size(); ++v)
    put(map, mesh.vertex(v), Value(values[v]));
}

template <typename TriangleMesh, typename EdgeMap>
void put_at_edges(const Imported_mesh<TriangleMesh>& mesh, const std::vector<double>& values, EdgeMap map)
{
  typedef typename boost::property_traits<EdgeMap>::value_type Value;
  for(std::uint32_t e = 0; e < values.size(); ++e)
    put(map, mesh.edge(e), Value(values[e]));
}

template <typename TriangleMesh, typename VertexMap>
std::vector<double> values_at_vertices(const Imported_mesh<TriangleMesh>& mesh, VertexMap map)
{
  std::vector<double> result(mesh.triangulation.number_of_vertices());
  for(std::uint32_t v = 0; v < result.size(); ++v)
    result[v] = static_cast<double>(get(map, mesh.vertex(v)));
  return result;
}

// Both metrics on `tm`, if they can be imported.
template <typename TriangleMesh, typename EdgeLengthMap0, typename EdgeLengthMap1, typename Use>
Flattening_report<TriangleMesh> with_two_metrics(const TriangleMesh& tm, EdgeLengthMap0 length_map_0,
                                                 EdgeLengthMap1 length_map_1, Use use)
{
  const Imported_mesh<TriangleMesh> mesh_0 = import_mesh(tm, parameters::edge_length_map(length_map_0));
  if(mesh_0.status != Status::OK)
    return import_report(mesh_0);
  const Imported_mesh<TriangleMesh> mesh_1 = import_mesh(tm, parameters::edge_length_map(length_map_1));
  Flattening_report<TriangleMesh> report = import_report(mesh_1);
  if(report)
    use(mesh_0, mesh_1, report);
  return report;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_VALUES_OF_MESH_H
