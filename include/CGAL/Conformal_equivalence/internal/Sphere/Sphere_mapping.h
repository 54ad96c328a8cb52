// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_SPHERE_MAPPING_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_SPHERE_MAPPING_H

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Spherical_refinement.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Ideal_polyhedron.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Inscribed_mapping.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Sphere_cells.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Sphere_normalization.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/moebius_weights.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/sphere_points.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/internal/solver_traits_of.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <boost/property_map/property_map.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// One map to the sphere: what the user gets is written by the caller.
template <typename TriangleMesh, typename NT>
struct Sphere_mapping
{
  typedef std::uint32_t Index;
  typedef typename Ideal_polyhedron<NT>::Wide Wide;
  typedef std::array<Wide, 3> Wide_point;

  Imported_mesh<TriangleMesh, NT> mesh;
  Ideal_polyhedron<NT> polyhedron;
  std::vector<std::array<NT, 3> > points;
  Spherical_refinement<NT> refinement; // without faces unless asked for
  std::vector<Light_vector<Wide> > refined_vectors; // by vertex of the refinement
  Flattening_report<TriangleMesh> report;

  explicit Sphere_mapping(const TriangleMesh& tm) : mesh(tm) {}

  // `is_refined` is a type, so that who asks for no refinement need not compile it.
  template <typename NamedParameters, bool is_refined>
  void run(const NamedParameters& np, std::bool_constant<is_refined>)
  {
    run_mapping(mesh, report, np, is_sphere, [&] { find(np); }, [&] { judge<is_refined>(); });
  }

private:
  static bool is_sphere(const Surface_topology& t)
  {
    return t.number_of_components == 1 && t.number_of_borders == 0 && t.genus == 0 && t.number_of_vertices - t.number_of_isolated_vertices > 3;
  }

  template <typename NamedParameters>
  void find(const NamedParameters& np)
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    const Index apex = given_apex(mesh, np);
    CGAL_precondition(apex == t.null_index || !t.is_isolated_vertex(apex));
    const Sphere_normalization<Wide> normalize = normalization(np);
    const Solver_options options = Conformal_equivalence::read_solver_options(np, 0);
    const Inscribed_mapping<NT> mapping(t, t, options, factorization_maker(solver_traits_of(np)));
    polyhedron = mapping(apex, [&](Ideal_polyhedron<NT>& found)
    {
      if(!normalize(found.vectors))
        found.status = Status::SINGULAR_PROBLEM;
      return flipped_faces(found.triangulation, sphere_points(found.vectors));
    });
    take_over(mesh, polyhedron, report);
  }

  template <typename NamedParameters>
  Sphere_normalization<Wide> normalization(const NamedParameters& np) const
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    std::vector<Index> used;
    for(Index v = 0; v < t.number_of_vertices() && used.size() < 2; ++v)
      if(!t.is_isolated_vertex(v))
        used.push_back(v);
    return { moebius_weights(t, given_moebius_weights(np)), given_points(np), used[0], used[1] };
  }

  // None if lengths are given instead.
  template <typename NamedParameters>
  std::vector<std::array<double, 3> > given_points(const NamedParameters& np) const
  {
    std::vector<std::array<double, 3> > result;
    if constexpr(!is_given<internal_np::conformal_edge_length_t, NamedParameters>)
    {
      const auto point = parameters::choose_parameter(parameters::get_parameter(np, internal_np::vertex_point),
                                                      get(CGAL::vertex_point, mesh.mesh()));
      result.resize(mesh.triangulation.number_of_vertices());
      for(Index v = 0; v < result.size(); ++v)
        if(!mesh.triangulation.is_isolated_vertex(v))
        {
          const auto& p = get(point, mesh.vertex(v));
          result[v] = {{ CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()) }};
        }
    }
    return result;
  }

  // ---- Verdict

  template <bool is_refined>
  void judge()
  {
    const double rounding = 1e-6; // of the sum of solid angles, which is a multiple of that of the sphere
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    const std::vector<Wide_point> wide = sphere_points(polyhedron.vectors);
    points = rounded_points<NT>(wide);
    std::vector<Index> flipped;
    if(!polyhedron.flips.empty())
      flipped = flipped_faces(t, wide);
    report.solid_angle = sum_of_solid_angles(polyhedron.triangulation, wide);
    if(!(std::abs(report.solid_angle - 4 * Number_constants<double>::pi()) < rounding))
      report.status = Status::NOT_INJECTIVE;
    else if constexpr(is_refined)
      refine(flipped);
    else
      tell_verdict(mesh, flipped, flipped.empty() ? flipped_faces(t, points) : std::vector<Index>(), report);
  }

  // The verdict is on the parts; triangles that are flipped when they are straight are only told.
  void refine(const std::vector<Index>& bent)
  {
    Sphere_cells<NT> cells(mesh.triangulation, polyhedron);
    if(!bool(cells.refinement.parts))
    {
      report.status = cells.refinement.parts.status;
      report.amount = cells.refinement.parts.amount;
      return;
    }
    refinement = std::move(cells.refinement);
    refined_vectors = std::move(cells.vectors);
    tell_verdict(mesh, input_faces(refinement.parts, refinement.parts.flipped_faces),
                 input_faces(refinement.parts, refinement.parts.rounded_faces), report);
    for(Index f : bent)
      report.bent_faces.push_back(mesh.face(f));
  }
};

// Writes what the vertices of the mesh are scaled by.
template <typename TriangleMesh, typename NT, typename NamedParameters>
void write_weights_of_sphere(const Sphere_mapping<TriangleMesh, NT>& mapping, const NamedParameters& np)
{
  std::vector<typename Ideal_polyhedron<NT>::Wide> weights;
  for(const auto& v : mapping.polyhedron.vectors)
    weights.push_back(v[3]);
  write_weights(mapping.mesh, weights, np);
}

template <typename TriangleMesh, typename NT, typename VertexPointMap, typename NamedParameters>
void write_sphere(const Sphere_mapping<TriangleMesh, NT>& mapping, VertexPointMap sphere_map, const NamedParameters& np)
{
  typedef typename boost::property_traits<VertexPointMap>::value_type Point_3;
  const Intrinsic_triangulation<NT>& t = mapping.mesh.triangulation;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v))
      put(sphere_map, mapping.mesh.vertex(v), Point_3(mapping.points[v][0], mapping.points[v][1], mapping.points[v][2]));
  write_weights_of_sphere(mapping, np);
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_SPHERE_MAPPING_H
