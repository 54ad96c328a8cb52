// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_DISK_MAPPING_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_DISK_MAPPING_H

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/Disk_frame.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Surface_double.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Disk_cells.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Disk_normalization.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Ideal_polyhedron.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Inscribed_mapping.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Inscribed_polygon.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/disk_points.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/moebius_weights.h>
#include <CGAL/Conformal_equivalence/internal/solver_traits_of.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <CGAL/assertions.h>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename TriangleMesh, typename NT>
Indexed_disk_frame indexed_frame(const Imported_mesh<TriangleMesh, NT>&, Barycentre_disk_frame) { return {}; }

template <typename TriangleMesh, typename NT, typename Vertex>
Indexed_disk_frame indexed_frame(const Imported_mesh<TriangleMesh, NT>& mesh, const Centred_disk_frame<Vertex>& frame)
{
  const std::uint32_t c = mesh.index_of_vertex(frame.centre);
  CGAL_precondition(!mesh.triangulation.is_isolated_vertex(c) && !mesh.triangulation.is_border_vertex(c));
  return { Indexed_disk_frame::CENTRE, {{c, c, c}} };
}

template <typename TriangleMesh, typename NT, typename Vertex>
Indexed_disk_frame indexed_frame(const Imported_mesh<TriangleMesh, NT>& mesh, const Three_point_disk_frame<Vertex>& frame)
{
  Indexed_disk_frame result;
  result.kind = Indexed_disk_frame::THREE_POINTS;
  for(std::size_t i = 0; i < 3; ++i)
  {
    result.vertices[i] = mesh.index_of_vertex(frame.border[i]);
    CGAL_precondition(mesh.triangulation.is_border_vertex(result.vertices[i]));
  }
  return result;
}

// One map to the disk: what the user gets is written by the caller.
template <typename TriangleMesh, typename NT>
struct Disk_mapping
{
  typedef std::uint32_t Index;
  typedef typename Ideal_polyhedron<NT>::Wide Wide;
  typedef std::array<Wide, 2> Wide_point;

  Imported_mesh<TriangleMesh, NT> mesh;
  Ideal_polyhedron<NT> polyhedron;             // of the surface, or, with flips, of its double
  std::vector<std::array<NT, 2> > points;      // by vertex of the mesh
  std::vector<Wide> weights;                   // e^{-u} in the disk, the same
  Common_refinement<NT> refinement;            // empty unless asked for
  std::vector<Light_vector<Wide> > refined_vectors; // by vertex of the refinement
  Flattening_report<TriangleMesh> report;

  explicit Disk_mapping(const TriangleMesh& tm) : mesh(tm) {}

  template <typename NamedParameters>
  void run(const NamedParameters& np, bool is_refined, bool is_always_made)
  {
    run_mapping(mesh, report, np, [](const Surface_topology& t) { return t.is_disk(); }, [&] { find(np); },
                [&] { judge(is_refined && (is_always_made || is_doubled(polyhedron))); });
  }

private:
  bool is_doubled(const Ideal_polyhedron<NT>& p) const { return p.triangulation.number_of_faces() != mesh.triangulation.number_of_faces(); }

  template <typename NamedParameters>
  void find(const NamedParameters& np)
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    const Index apex = given_apex(mesh, np);
    CGAL_precondition(apex == t.null_index || t.is_border_vertex(apex));
    const auto given_frame = parameters::get_parameter(np, internal_np::conformal_disk_frame);
    frame_ = indexed_frame(mesh, parameters::choose_parameter(given_frame, Barycentre_disk_frame()));
    if(!is_possible())
      return;
    twofold_ = std::make_unique<Surface_double<NT> >(t);
    const Moebius_weights kind = given_moebius_weights(np);
    Inscribed_polygon<NT> polygon(t, *twofold_);
    const Solver_options options = Conformal_equivalence::read_solver_options(np, 0);
    if(polygon(options.retriangulation))
    {
      polyhedron = std::move(polygon.polyhedron);
      if(is_success(polyhedron.status))
        normalize(polyhedron, kind);
    }
    else
    {
      const Inscribed_mapping<NT> mapping(t, twofold_->triangulation, options, factorization_maker(solver_traits_of(np)));
      polyhedron = mapping(apex, [&](Ideal_polyhedron<NT>& found)
      {
        normalize(found, kind);
        return flipped_faces_in_disk(found);
      });
    }
    take_over(mesh, polyhedron, report);
    report.statistics.is_doubled = is_doubled(polyhedron);
  }

  // Is there a map in that frame? Border points need to be different, and in the order in which they are on the circle.
  bool is_possible()
  {
    if(frame_.kind != Indexed_disk_frame::THREE_POINTS)
      return true;
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    const std::array<Index, 3>& border = frame_.vertices;
    Index v = t.target(t.vertex_halfedge(border[0]));
    while(v != border[0] && v != border[1] && v != border[2])
      v = t.target(t.vertex_halfedge(v));
    if(v == border[1] && border[0] != border[1] && border[0] != border[2] && border[1] != border[2])
      return true;
    report.status = Status::SINGULAR_PROBLEM;
    name_elements(mesh, std::vector<Index>(border.begin(), border.end()), {}, {}, report);
    return false;
  }

  void normalize(Ideal_polyhedron<NT>& found, Moebius_weights kind) const
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    std::vector<double> vertex_weights = moebius_weights(t, kind);
    Index first = t.null_index;
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      if(t.is_border_vertex(v))
      {
        first = (std::min)(first, v);
        vertex_weights[v] /= kind == Moebius_weights::VERTICES ? 2 : 1; // the others are on the double twice
      }
    vertex_weights.resize(found.vectors.size(), 0);
    if(!Disk_normalization<Wide>(std::move(vertex_weights), first)(frame_, found.vectors))
    {
      found.status = Status::SINGULAR_PROBLEM;
      found.vertices.assign(1, found.apex == t.null_index ? first : found.apex);
    }
  }

  // Those of the surface that are not positive; of the double not those of the mirror image, and those across the axis.
  std::vector<Index> flipped_faces_in_disk(const Ideal_polyhedron<NT>& found) const
  {
    const Intrinsic_triangulation<NT>& t = found.triangulation;
    const Index n = mesh.triangulation.number_of_vertices();
    const std::vector<Wide_point> p = disk_points(found.vectors);
    std::vector<Index> result;
    for(Index f = 0; f < t.number_of_faces(); ++f)
    {
      const Index i = t.origin(t.halfedge(f)), j = t.origin(t.halfedge(f, 1)), k = t.origin(t.halfedge(f, 2));
      if(i >= n || j >= n || k >= n)
        continue;
      const Intrinsic_triangulation<NT>& surface = mesh.triangulation;
      const bool is_at_axis = surface.is_border_vertex(i) && surface.is_border_vertex(j) && surface.is_border_vertex(k);
      if(!(is_doubled(found) && is_at_axis) && !is_positive_in_disk(p[i], p[j], p[k])) // at the axis it may belong to the image
        result.push_back(f);
    }
    return result;
  }

  // ---- Verdict

  void judge(bool is_refined)
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    std::vector<Wide_point> wide = disk_points(polyhedron.vectors);
    wide.resize(t.number_of_vertices());
    points = rounded_points<NT>(wide);
    for(const Light_vector<Wide>& v : polyhedron.vectors)
      weights.push_back(weight_in_disk(v));
    weights.resize(t.number_of_vertices());
    if(is_doubled(polyhedron))
      for(Index e : twofold_->lost_border_edges(t, polyhedron.triangulation, polyhedron.flips))
        report.lost_border_edges.push_back(mesh.edge(e));
    const std::vector<Index> flipped = flipped_faces(t, wide);
    if(!turns_once(t, wide))
      report.status = Status::NOT_INJECTIVE;
    else if(is_refined)
      refine(flipped);
    else
      tell_verdict(mesh, flipped, flipped.empty() ? flipped_faces(t, points) : std::vector<Index>(), report);
  }

  // The verdict is on the parts; triangles that are flipped when they are straight are only told.
  void refine(const std::vector<Index>& bent)
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    Disk_cells<NT> cells(t, is_doubled(polyhedron) ? twofold_->triangulation : t, polyhedron);
    if(!bool(cells.refinement))
    {
      report.status = cells.refinement.status;
      report.amount = cells.refinement.amount;
      return;
    }
    refinement = std::move(cells.refinement);
    refined_vectors = std::move(cells.vectors);
    tell_verdict(mesh, input_faces(refinement, refinement.flipped_faces), input_faces(refinement, refinement.rounded_faces), report);
    for(Index f : bent)
      report.bent_faces.push_back(mesh.face(f));
  }

  Indexed_disk_frame frame_;
  std::unique_ptr<Surface_double<NT> > twofold_;
};

template <typename TriangleMesh, typename NT, typename VertexUVMap, typename NamedParameters>
void write_disk(const Disk_mapping<TriangleMesh, NT>& mapping, VertexUVMap disk_map, const NamedParameters& np)
{
  typedef typename boost::property_traits<VertexUVMap>::value_type Point_2;
  const Intrinsic_triangulation<NT>& t = mapping.mesh.triangulation;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v))
      put(disk_map, mapping.mesh.vertex(v), Point_2(mapping.points[v][0], mapping.points[v][1]));
  write_weights(mapping.mesh, mapping.weights, np);
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_DISK_MAPPING_H
