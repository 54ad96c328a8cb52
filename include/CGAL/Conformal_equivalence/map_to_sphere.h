// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file map_to_sphere.h
/// A closed surface without handles as the unit sphere (section 4.3 of Springborn, Schroeder and Pinkall, 2008): one vertex is sent to infinity, what
/// is left is laid out in the plane, projected to the sphere, and the vertex comes back where the pole is. With flips there is a map for every
/// such surface, and it is one-to-one (Rivin, 1996; Springborn, 2020, section 7). A Moebius transformation then puts the barycentre
/// of the vertices in the centre (Springborn, 2005), so that the result does not depend on the vertex chosen.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_MAP_TO_SPHERE_H
#define CGAL_CONFORMAL_EQUIVALENCE_MAP_TO_SPHERE_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/make_refined_mesh.h>
#include <CGAL/Conformal_equivalence/triangulate_refinement.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/internal/Doors/parameters_of_doors.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/ideal_refinement.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Inscribed_mapping.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Moebius_centering.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/sphere_predicates.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// The overlay of a closed surface and the convex polyhedron that is its image on the sphere, when edges were flipped on the way.
///
/// The faces are parts of faces of the input and of faces of the polyhedron. With barycentric coordinates b of the corners of a
/// face, as points of the input face, the image is the point of the sphere in the direction of the sum of the b w p with the weight w and the
/// point p of each corner: continuous, and along every edge of the input the same from both sides.
///
/// \tparam NT_ number type of the coordinates
template <typename NT_ = double>
struct Spherical_refinement
{
  typedef NT_ NT;              ///< number type of the coordinates
  typedef std::uint32_t Index; ///< of vertices and faces

  /// vertices, faces and weights of the overlay, see there; its `corner_uv` is empty. Verdict: its faces as polygons of great arcs
  Common_refinement<NT> parts;
  /// by vertex of `parts`: its point of the unit sphere; the origin for isolated vertices
  std::vector<std::array<NT, 3> > points;
};

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

  template <typename NamedParameters>
  void run(const NamedParameters& np, bool is_refined)
  {
    run_mapping(mesh, report, np, is_sphere, [&] { find(np); }, [&] { judge(is_refined); });
  }

private:
  static bool is_sphere(const Surface_topology& t)
  {
    return t.number_of_components == 1 && t.number_of_borders == 0 && t.genus == 0 && t.number_of_vertices - t.number_of_isolated_vertices > 3;
  }

  template <typename NamedParameters>
  void find(const NamedParameters& np)
  {
    using parameters::choose_parameter;
    using parameters::get_parameter;
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    const Index apex = given_apex(mesh, np);
    CGAL_precondition(apex == t.null_index || !t.is_isolated_vertex(apex));
    const std::vector<double> weights = moebius_weights(
      t, choose_parameter(get_parameter(np, internal_np::conformal_moebius_weights), Moebius_weights::VERTICES));
    const Moebius_centering center(weights, false);

    const Inscribed_mapping<NT, NamedParameters> mapping(t, t, np);
    polyhedron = mapping(apex, given_retriangulation(np), [&](Ideal_polyhedron<NT>& found)
    {
      if(!center(found.vectors))
        found.status = Status::SINGULAR_PROBLEM;
      else
        turn(found.vectors, weights, np);
      return flipped_faces(found.triangulation, wide_points(found.vectors));
    });
    take_over(mesh, polyhedron, report);
  }

  // The rotation that brings the points nearest to those given (W. Kabsch, 1976); if there are none, or several rotations are as good, the first vertex
  // goes to the pole (0, 0, 1), and the second one to the half of the plane y = 0 with x > 0.
  template <typename NamedParameters>
  void turn(std::vector<Light_vector<Wide> >& vectors, const std::vector<double>& weights, const NamedParameters& np) const
  {
    if constexpr(parameters::is_default_parameter<NamedParameters, internal_np::conformal_edge_length_t>::value)
    {
      const auto point = parameters::choose_parameter(parameters::get_parameter(np, internal_np::vertex_point),
                                                      get(CGAL::vertex_point, mesh.mesh()));
      if(turn_to_points(vectors, weights, point))
        return;
    }
    turn_to_first(vectors);
  }

  template <typename PointMap>
  bool turn_to_points(std::vector<Light_vector<Wide> >& vectors, const std::vector<double>& weights, PointMap point) const
  {
    std::vector<Eigen::Vector3d> given(vectors.size(), Eigen::Vector3d::Zero());
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double sum = 0, size = 0;
    for(Index v = 0; v < vectors.size(); ++v)
    {
      if(!(weights[v] > 0))
        continue;
      const auto& p = get(point, mesh.vertex(v));
      given[v] = Eigen::Vector3d(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
      size = (std::max)(size, given[v].cwiseAbs().maxCoeff());
      sum += weights[v];
    }
    if(!(size > 0))
      return false;
    for(Index v = 0; v < vectors.size(); ++v)
      centre += weights[v] / sum * (given[v] /= size);
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for(Index v = 0; v < vectors.size(); ++v)
    {
      if(!(weights[v] > 0))
        continue;
      const Light_vector<double> p = rounded(vectors[v]);
      covariance += weights[v] / sum * (given[v] - centre) * Eigen::RowVector3d(p[0] / p[3], p[1] / p[3], p[2] / p[3]);
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1, tie = 1e-9;
    if(!(svd.singularValues()[1] + sign * svd.singularValues()[2] > tie * svd.singularValues()[0]))
      return false;
    const Eigen::Matrix3d rotation = svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
    const Eigen::Quaterniond q(rotation);
    transform(rotation_matrix<Wide>(q.w(), q.x(), q.y(), q.z()), vectors);
    return true;
  }

  void turn_to_first(std::vector<Light_vector<Wide> >& vectors) const
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    std::vector<Index> used;
    for(Index v = 0; v < t.number_of_vertices() && used.size() < 2; ++v)
      if(!t.is_isolated_vertex(v))
        used.push_back(v);
    const auto at = [&](Index v)
    {
      const Light_vector<double> p = rounded(vectors[v]);
      return std::array<double, 3>{{ p[0] / p[3], p[1] / p[3], p[2] / p[3] }};
    };
    transform(rotation_to_pole<Wide>(at(used[0])), vectors);
    const std::array<double, 3> p = at(used[1]);
    const double half = -std::atan2(p[1], p[0]) / 2;
    transform(rotation_matrix<Wide>(std::cos(half), 0, 0, std::sin(half)), vectors);
  }

  std::vector<Wide_point> wide_points(const std::vector<Light_vector<Wide> >& vectors) const
  {
    std::vector<Wide_point> result;
    result.reserve(vectors.size());
    for(const Light_vector<Wide>& v : vectors)
      result.push_back(v[3] > 0 ? sphere_point(v) : Wide_point{{Wide(0), Wide(0), Wide(0)}});
    return result;
  }

  template <typename Number>
  static std::vector<Index> flipped_faces(const Intrinsic_triangulation<NT>& t, const std::vector<std::array<Number, 3> >& p)
  {
    std::vector<Index> result;
    for(Index f = 0; f < t.number_of_faces(); ++f)
      if(!is_counterclockwise(p[t.origin(3 * f)], p[t.origin(3 * f + 1)], p[t.origin(3 * f + 2)]))
        result.push_back(f);
    return result;
  }

  // ---- Verdict

  static std::vector<std::array<NT, 3> > rounded_points(const std::vector<Wide_point>& p)
  {
    std::vector<std::array<NT, 3> > result;
    result.reserve(p.size());
    for(const Wide_point& x : p)
      result.push_back({{ static_cast<NT>(x[0]), static_cast<NT>(x[1]), static_cast<NT>(x[2]) }});
    return result;
  }

  void judge(bool is_refined)
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    const std::vector<Wide_point> wide = wide_points(polyhedron.vectors);
    points = rounded_points(wide);
    std::vector<Index> flipped;
    if(!polyhedron.flips.empty())
      flipped = flipped_faces(t, wide);
    report.solid_angle = sum_of_solid_angles(polyhedron.triangulation, wide);
    const double sphere = 4 * Number_constants<double>::pi();
    if(!(std::abs(report.solid_angle - sphere) < 1e-6))
      report.status = Status::NOT_INJECTIVE;
    else if(is_refined)
      refine(flipped);
    else if(!flipped.empty())
    {
      report.status = Status::NOT_INJECTIVE;
      name_elements(mesh, {}, {}, flipped, report);
    }
    else
      for(Index f : flipped_faces(t, points))
        report.rounded_faces.push_back(mesh.face(f));
  }

  static double sum_of_solid_angles(const Intrinsic_triangulation<NT>& t, const std::vector<Wide_point>& p)
  {
    double result = 0;
    for(Index f = 0; f < t.number_of_faces(); ++f)
      result += solid_angle(p[t.origin(3 * f)], p[t.origin(3 * f + 1)], p[t.origin(3 * f + 2)]);
    return result;
  }

  // The overlay, in triangles; the verdict is on these.
  void refine(const std::vector<Index>& bent)
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    const Surface_size size = { t.number_of_vertices(), t.number_of_edges(), t.number_of_faces() };
    Ideal_refinement<NT> overlay = Ideal_refinement_builder<NT>(t, polyhedron, size)(
      default_maximum_number_of_crossings, [](const Light_vector<Wide>& v) { return v[3]; });
    if(!bool(overlay.parts))
    {
      report.status = overlay.parts.status;
      report.amount = overlay.parts.amount;
      return;
    }
    const std::vector<Wide_point> wide = wide_points(overlay.vectors);
    set_weights(overlay);
    project_faces(wide, overlay.parts);
    refinement.parts = triangulate_refinement(overlay.parts);
    refinement.parts.corner_uv.clear();
    refinement.points = rounded_points(wide);
    refined_vectors = std::move(overlay.vectors);
    judge_parts(wide);
    for(Index f : bent)
      report.bent_faces.push_back(mesh.face(f));
  }

  // Points of edges of the polyhedron lie within the sphere, and go from there to it: for these points of the sphere w is not the
  // weight of the vector, but the length of its part in space.
  void set_weights(Ideal_refinement<NT>& overlay) const
  {
    using std::sqrt;
    for(std::size_t v = mesh.triangulation.number_of_vertices(); v < overlay.vectors.size(); ++v)
    {
      const Light_vector<Wide>& x = overlay.vectors[v];
      const Wide length = sqrt(Wide(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]));
      overlay.parts.weights[v] = static_cast<NT>(Wide(overlay.parts.weights[v] * length / x[3]));
    }
  }

  // Every face from the centre to a plane in front of it, so that it can be cut into triangles.
  static void project_faces(const std::vector<Wide_point>& p, Common_refinement<NT>& parts)
  {
    parts.corner_uv.resize(parts.corner_vertex.size());
    for(Index f = 0; f < parts.number_of_faces(); ++f)
    {
      const std::size_t first = parts.first_corner[f], last = parts.first_corner[f + 1];
      Wide_point n = {{Wide(0), Wide(0), Wide(0)}};
      for(std::size_t c = first; c < last; ++c)
        for(std::size_t i = 0; i < 3; ++i)
          n[i] = n[i] + p[parts.corner_vertex[c]][i];
      const Eigen::Vector3d normal = Eigen::Vector3d(static_cast<double>(n[0]), static_cast<double>(n[1]), static_cast<double>(n[2])).normalized();
      const Eigen::Vector3d x = normal.unitOrthogonal(), y = normal.cross(x);
      const Wide_point& o = p[parts.corner_vertex[first]];
      for(std::size_t c = first; c < last; ++c)
      {
        const Wide_point& q = p[parts.corner_vertex[c]];
        Eigen::Vector3d d; // exact enough for tiny faces
        for(int i = 0; i < 3; ++i)
          d[i] = static_cast<double>(Wide(q[std::size_t(i)] - o[std::size_t(i)]));
        parts.corner_uv[c] = {{ NT(x.dot(d)), NT(y.dot(d)) }};
      }
    }
  }

  void judge_parts(const std::vector<Wide_point>& wide)
  {
    Common_refinement<NT>& parts = refinement.parts;
    parts.flipped_faces.clear();
    parts.rounded_faces.clear();
    std::vector<Index> flipped;
    for(Index f = 0; f < parts.number_of_faces(); ++f)
    {
      const std::size_t c = parts.first_corner[f];
      const Index i = parts.corner_vertex[c], j = parts.corner_vertex[c + 1], k = parts.corner_vertex[c + 2];
      if(!is_counterclockwise(wide[i], wide[j], wide[k]))
      {
        parts.flipped_faces.push_back(f);
        flipped.push_back(parts.input_face[f]);
      }
      else if(!is_counterclockwise(refinement.points[i], refinement.points[j], refinement.points[k]))
        parts.rounded_faces.push_back(f);
    }
    if(!flipped.empty())
    {
      report.status = Status::NOT_INJECTIVE;
      name_elements(mesh, {}, {}, flipped, report);
      return;
    }
    std::vector<Index> faces;
    for(Index f : parts.rounded_faces)
      faces.push_back(parts.input_face[f]);
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    for(Index f : faces)
      report.rounded_faces.push_back(mesh.face(f));
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

/// \ingroup PkgConformalEquivalenceDoors
///
/// maps a closed triangle mesh of genus 0 to the unit sphere: the chords between the images of the vertices are discretely conformally equivalent to the
/// edges of the mesh, all around every vertex. The barycentre of the vertices is the centre of the sphere.
///
/// On the triangulation of the mesh (`Retriangulation::NEVER`, or `WHEN_NEEDED` if that is possible) every triangle becomes a triangle of great arcs, and
/// length cross ratios are preserved. The result is kept only if all of these triangles are positive. Otherwise edges are flipped, as by `flatten()`; the images of the vertices are then the corners of a convex polyhedron
/// that exists for every mesh, and triangles become the parts of `spherical_refinement`; straight triangles between the images may be flipped, which is
/// an error (`NOT_INJECTIVE`) unless the refinement is asked for. `map_to_sphere_refined()` makes a mesh of it.
///
/// Triangles are judged by exact predicates on the coordinates as they were computed, in pairs of `double`. If all are positive, and the solid angles
/// sum up to 4 pi (`Flattening_report::solid_angle`), the map is one-to-one. Where parts of the mesh become so small on the sphere that
/// `double` cannot tell their points apart, triangles may be lost when the points are rounded: these are counted exactly, and listed (`Flattening_report::rounded_faces`);
/// `map_to_sphere<NT>()` with more digits keeps them.
///
/// \tparam NT number type of lengths, and of the points: `double`, or a binary floating-point number of Boost.Multiprecision
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam VertexPointMap a model of `WritablePropertyMap` with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a value type that
///         can be made from three `NT`, such as `Point_3`
///
/// \param tm a triangle mesh: one component, without border and handles, with at least four vertices, apart from isolated ones
/// \param sphere_map receives the points; isolated vertices get none
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map} \cgalParamDescription{as in `import_mesh()`; the result is turned so that it is as near to these points as it can be} \cgalParamNEnd
///   \cgalParamNBegin{edge_length_map} \cgalParamDescription{as in `import_mesh()`; then the first vertex becomes (0, 0, 1), and the second one has y = 0 and x > 0} \cgalParamNEnd
///   \cgalParamNBegin{mollification} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{vertex_at_infinity}
///     \cgalParamDescription{the vertex that is sent to infinity on the way; the result depends on it by rounding only. Another one is taken where this one gives no result, but that does}
///     \cgalParamType{`boost::graph_traits<TriangleMesh>::%vertex_descriptor`}
///     \cgalParamDefault{the null vertex: one with well-shaped triangles around it is taken}
///   \cgalParamNEnd
///   \cgalParamNBegin{moebius_weights}
///     \cgalParamDescription{what has its barycentre in the centre}
///     \cgalParamType{`Moebius_weights`}
///     \cgalParamDefault{`Moebius_weights::VERTICES`}
///   \cgalParamNEnd
///   \cgalParamNBegin{log_scale_factor_map}
///     \cgalParamDescription{receives u: chords are e^{(u_i + u_j) / 2} times as long as edges}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{projective_weight_map}
///     \cgalParamDescription{receives the weights e^{-u} of projective interpolation, scaled to a maximum of 1}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{spherical_refinement}
///     \cgalParamDescription{receives the overlay of the mesh with the polyhedron, in triangles. Straight triangles that are flipped are then not refused, but listed in the report (`bent_faces`)}
///     \cgalParamType{`std::reference_wrapper<Spherical_refinement<NT> >`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{gradient_tolerance, number_of_iterations, newton_strategy, retriangulation, visitor}
///     \cgalParamDescription{as in `Conformal_metric_solver::solve()`; the solution is refined as far as the number type allows} \cgalParamNEnd
///   \cgalParamNBegin{sparse_linear_solver} \cgalParamDescription{as in `compute_conformal_metric()`} \cgalParamNEnd
///   \cgalParamNBegin{flattening_report}
///     \cgalParamDescription{receives a copy of what is returned}
///     \cgalParamType{`std::reference_wrapper<Flattening_report<TriangleMesh> >`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the report. Maps are written iff it is a success. Statuses: those of `import_mesh()`; `WRONG_TOPOLOGY`, with what was found
///         (`Flattening_report::topology`); those of `Conformal_metric_solver::solve()`; `SINGULAR_PROBLEM` if no Moebius transformation centres the barycentre: with `Moebius_weights::AREAS` where no triangle has an area; `NOT_INJECTIVE` (faces); those of `compute_common_refinement()` if the refinement was asked for.
///
/// Time is that of `flatten()` for a disk of that size; with flips that of a few of them.
///
/// \sa `CGAL::Conformal_equivalence::map_to_disk()`
template <typename NT = double, typename TriangleMesh, typename VertexPointMap, typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> map_to_sphere(const TriangleMesh& tm,
                                              VertexPointMap sphere_map,
                                              const NamedParameters& np = parameters::default_values())
{
  static_assert(internal::Check_vertex_map<VertexPointMap, TriangleMesh>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_map_to_sphere, TriangleMesh, NamedParameters>::value);
  constexpr bool is_refined = !parameters::is_default_parameter<NamedParameters, internal_np::conformal_spherical_refinement_t>::value;
  internal::Sphere_mapping<TriangleMesh, NT> mapping(tm);
  mapping.run(np, is_refined);
  if(bool(mapping.report))
  {
    internal::write_sphere(mapping, sphere_map, np);
    if constexpr(is_refined)
      parameters::get_parameter(np, internal_np::conformal_spherical_refinement).get() = std::move(mapping.refinement);
  }
  internal::write_report(mapping.report, np);
  return mapping.report;
}

/// \ingroup PkgConformalEquivalenceDoors
///
/// maps a closed triangle mesh of genus 0 to the unit sphere, as `map_to_sphere()` does, and makes a mesh of the parts into which the edges of the convex
/// polyhedron on the sphere cut the given one. Where no edge was flipped that is a copy.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam RefinedMesh a model of `MutableFaceGraph`
/// \tparam VertexPointMap a model of `WritablePropertyMap` with key type `boost::graph_traits<RefinedMesh>::%vertex_descriptor` and a value type that
///         can be made from three `double`
///
/// \param tm a triangle mesh
/// \param refined the mesh to be made, empty: vertices of `tm` come first, in the order of `vertices(tm)`, then the crossings of edges, which lie on edges
///        of `tm`. Its faces are triangles unless these would make several edges between the same two vertices.
/// \param sphere_map receives the points of the sphere
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of `map_to_sphere()`, with maps of `tm`
/// \param np_refined an optional sequence of \ref bgl_namedparameters "Named Parameters" for `refined`, among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{receives the points of the surface}
///     \cgalParamType{a read-write property map with key type `boost::graph_traits<RefinedMesh>::%vertex_descriptor` and as value type a `Point_3` that can be made from three coordinates}
///     \cgalParamDefault{`get(CGAL::vertex_point, refined)`}
///   \cgalParamNEnd
///   \cgalParamNBegin{projective_weight_map}
///     \cgalParamDescription{receives the weights w, see `Spherical_refinement`}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<RefinedMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{input_face_map}
///     \cgalParamDescription{receives the face of `tm` that a face of `refined` is a part of}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<RefinedMesh>::%face_descriptor` and value type `boost::graph_traits<TriangleMesh>::%face_descriptor`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the report of `map_to_sphere()`, with `bent_faces`; `NOT_REPRESENTABLE` if `refined` cannot hold the result. Meshes and maps are written iff it is a success.
template <typename TriangleMesh, typename RefinedMesh, typename VertexPointMap,
          typename NamedParameters = parameters::Default_named_parameters,
          typename NamedParametersRefined = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> map_to_sphere_refined(const TriangleMesh& tm,
                                                      RefinedMesh& refined,
                                                      VertexPointMap sphere_map,
                                                      const NamedParameters& np = parameters::default_values(),
                                                      const NamedParametersRefined& np_refined = parameters::default_values())
{
  static_assert(internal::Check_vertex_map<VertexPointMap, RefinedMesh>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_map_to_sphere, TriangleMesh, NamedParameters>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_refined_sphere, RefinedMesh, NamedParametersRefined>::value);
  using parameters::choose_parameter;
  using parameters::get_parameter;
  using parameters::is_default_parameter;
  typedef typename boost::property_traits<VertexPointMap>::value_type Point_3;
  CGAL_precondition(vertices(refined).begin() == vertices(refined).end());
  internal::Sphere_mapping<TriangleMesh, double> mapping(tm);
  mapping.run(np, true);
  const Spherical_refinement<double>& result = mapping.refinement;
  Refined_mesh_elements<RefinedMesh> elements;
  if(bool(mapping.report))
  {
    internal::add_refined_vertices(mapping.mesh, result.parts,
      choose_parameter(get_parameter(np, internal_np::vertex_point), get(CGAL::vertex_point, tm)), refined,
      choose_parameter(get_parameter(np_refined, internal_np::vertex_point), get(CGAL::vertex_point, refined)), elements);
    if(!internal::add_refined_faces(result.parts, refined, elements))
    {
      CGAL::clear(refined);
      mapping.report.status = Status::NOT_REPRESENTABLE;
    }
  }
  if(bool(mapping.report))
  {
    for(std::size_t v = 0; v < elements.vertices.size(); ++v)
    {
      put(sphere_map, elements.vertices[v], Point_3(result.points[v][0], result.points[v][1], result.points[v][2]));
      if constexpr(!is_default_parameter<NamedParametersRefined, internal_np::conformal_weight_t>::value)
        put(get_parameter(np_refined, internal_np::conformal_weight), elements.vertices[v], result.parts.weights[v]);
    }
    if constexpr(!is_default_parameter<NamedParametersRefined, internal_np::conformal_input_face_t>::value)
      for(std::uint32_t f = 0; f < result.parts.number_of_faces(); ++f)
        put(get_parameter(np_refined, internal_np::conformal_input_face), elements.faces[f], mapping.mesh.face(result.parts.input_face[f]));
    if constexpr(!is_default_parameter<NamedParameters, internal_np::conformal_spherical_refinement_t>::value)
      get_parameter(np, internal_np::conformal_spherical_refinement).get() = mapping.refinement;
    internal::write_weights_of_sphere(mapping, np);
  }
  internal::write_report(mapping.report, np);
  return mapping.report;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_MAP_TO_SPHERE_H
