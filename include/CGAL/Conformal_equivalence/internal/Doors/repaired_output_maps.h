// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What `flatten_repaired()` has found is written to property maps of the mesh that was made.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_REPAIRED_OUTPUT_MAPS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_REPAIRED_OUTPUT_MAPS_H

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/internal/Doors/Repaired_flattening.h>
#include <CGAL/Conformal_equivalence/internal/Doors/output_maps.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/make_repaired_mesh.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/use.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Writes the corners to all halfedges; a border halfedge gets the corner of the face across.
template <typename TriangleMesh, typename RepairedMesh, typename HalfedgeUVMap>
void write_repaired_corners(const Repaired_flattening<TriangleMesh>& flattening, const Repaired_mesh_elements<RepairedMesh>& elements,
                            const RepairedMesh& out, HalfedgeUVMap uv)
{
  typedef typename boost::property_traits<HalfedgeUVMap>::value_type Point_2;
  const Intrinsic_triangulation<double>& t = flattening.repaired.triangulation();
  const Layout<double>& layout = flattening.layout;
  const auto point = [&](std::uint32_t h) { return Point_2(layout.corner[h][0], layout.corner[h][1]); };
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); ++h)
  {
    put(uv, elements.halfedges[h], point(h));
    if(t.is_border(h))
      put(uv, opposite(elements.halfedges[h], out), point(t.previous(h)));
  }
}

// Writes what was asked for at the vertices and edges of the mesh made.
template <typename TriangleMesh, typename RepairedMesh, typename NamedParameters>
void write_repaired_maps(const Repaired_flattening<TriangleMesh>& flattening, const Repaired_mesh_elements<RepairedMesh>& elements,
                         const RepairedMesh& out, const NamedParameters& np)
{
  CGAL_USE(out);
  const Intrinsic_triangulation<double>& t = flattening.repaired.triangulation();
  write_scale_factors(t, flattening.repaired.metric.log_scale_factors, [&](std::uint32_t v) { return elements.vertices[v]; }, np);
  if constexpr(is_given<internal_np::conformal_edge_is_seam_t, NamedParameters>)
    for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
      put(parameters::get_parameter(np, internal_np::conformal_edge_is_seam), edge(elements.halfedges[t.edge_halfedge(e)], out),
          bool(flattening.cut[e]));
}

// The motions across the seam, by halfedges of the mesh made.
template <typename RepairedMesh>
std::vector<Seam_transition<RepairedMesh> > repaired_transitions(const Layout<double>& layout,
                                                                 const Repaired_mesh_elements<RepairedMesh>& elements)
{
  std::vector<Seam_transition<RepairedMesh> > result;
  for(const Transition<double>& motion : layout.transitions)
    result.push_back({elements.halfedges[motion.halfedge], motion.rotation, motion.translation});
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_REPAIRED_OUTPUT_MAPS_H
