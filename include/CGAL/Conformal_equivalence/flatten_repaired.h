// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file flatten_repaired.h
/// The whole way in one call with the remedy of section 3.2 of Springborn, Schroeder and Pinkall, 2008: where the metric found
/// breaks triangles, edges are flipped or split, on a copy of the mesh, which is laid out.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_REPAIRED_H
#define CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_REPAIRED_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/compute_cut_graph.h>
#include <CGAL/Conformal_equivalence/compute_layout.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/internal/Doors/parameters_of_doors.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>
#include <CGAL/Conformal_equivalence/projective_interpolation.h>
#include <CGAL/Conformal_equivalence/repair_locally.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
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
      {{ result.vertices[t.origin(3 * f)], result.vertices[t.origin(3 * f + 1)], result.vertices[t.origin(3 * f + 2)] }};
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

/// \ingroup PkgConformalEquivalenceDoors
///
/// What `flatten_repaired()` reports: about the mesh given, with its elements, and about the mesh made. (In
/// `Flattening_report::transitions` there is nothing, and `Period_lattice::face` is the position of a face in `faces(repaired)`.)
template <typename TriangleMesh, typename RepairedMesh>
struct [[nodiscard]] Repair_report : public Flattening_report<TriangleMesh>
{
  std::vector<Edge_change<double> > changes;                             ///< how the triangulation was changed, in order
  std::vector<Seam_transition<RepairedMesh> > repaired_transitions;      ///< one for every edge of the seam
  Repaired_mesh_elements<RepairedMesh> elements;                         ///< the mesh made, by numbers of the triangulation
};

namespace internal {

// The stages one after the other, on indices.
template <typename TriangleMesh>
struct Repaired_flattening
{
  typedef std::uint32_t Index;

  Imported_mesh<TriangleMesh> mesh;
  Repaired_metric<double> repaired;
  Cut_graph cut;
  Layout<double> layout;

  explicit Repaired_flattening(Imported_mesh<TriangleMesh> imported) : mesh(std::move(imported)) {}

  template <typename NamedParameters>
  void run(const NamedParameters& np, Flattening_report<TriangleMesh>& report)
  {
    using parameters::choose_parameter;
    using parameters::get_parameter;
    auto given_visitor = choose_parameter<Default_visitor>(get_parameter(np, internal_np::visitor));
    auto& visitor = unwrap(given_visitor);
    try
    {
      read_conditions_of_mesh(np, report);
      if(bool(report))
        repair(np, report);
      Statistics::Seconds& seconds = report.statistics.seconds;
      if(bool(report))
        timed(seconds.cut, Stage::CUT, visitor, [&] { find_cut(np, report); });
      if(bool(report))
        timed(seconds.layout, Stage::LAYOUT, visitor, [&] { lay_out(np, report); });
      if(bool(report))
        timed(seconds.verify, Stage::VERIFY, visitor, [&] { verify(report); });
      if(bool(report))
        tell_what_was_found(report);
    }
    catch(const std::bad_alloc&)
    {
      report.status = Status::OUT_OF_MEMORY;
    }
  }

private:
  template <typename NamedParameters>
  void read_conditions_of_mesh(const NamedParameters& np, Flattening_report<TriangleMesh>& report)
  {
    const Stopwatch stopwatch;
    set_lengths(mesh, np);
    report = import_report(mesh);
    if(!bool(report))
      return;
    conditions_ = read_conditions_or_name(mesh, np, report);
    cones_ = interior_cones(mesh.triangulation, conditions_);
    report.statistics.seconds.import = stopwatch.seconds();
  }

  // ---- The metric

  template <typename NamedParameters>
  void repair(const NamedParameters& np, Flattening_report<TriangleMesh>& report)
  {
    const auto is_kept = [&](Index e) { return is_marked_edge(internal_np::conformal_edge_is_seam, np, e)
                                            || is_marked_edge(internal_np::edge_is_constrained, np, e); };
    const auto kept = parameters::retriangulation(Retriangulation::NEVER)
                                 .edge_is_constrained_map(boost::make_function_property_map<Index, bool>(is_kept));
    repaired = repair_locally(mesh.triangulation, conditions_, Conformal_equivalence::combine_named_parameters(
                                Conformal_equivalence::combine_named_parameters(np, kept), indexed_initial_guess(mesh, np)));
    const double seconds = report.statistics.seconds.import;
    report.statistics = repaired.metric.statistics;
    report.statistics.seconds.import = seconds;
    report.status = repaired.metric.status;
    report.amount = repaired.metric.amount;
    if(repaired.changes.empty())
      name_elements(mesh, repaired.metric.vertices, repaired.metric.edges, repaired.metric.faces, report);
    else
      name_vertices_of_faces(repaired.metric.faces, repaired.metric.vertices, report);
  }

  // Is an edge of the mesh marked in the map, if there is one?
  template <typename Tag, typename NamedParameters>
  bool is_marked_edge(Tag tag, const NamedParameters& np, Index e) const
  {
    CGAL_USE(tag);
    CGAL_USE(np);
    CGAL_USE(e);
    if constexpr(parameters::is_default_parameter<NamedParameters, Tag>::value)
      return false;
    else
      return get(parameters::get_parameter(np, tag), mesh.edge(e));
  }

  // The same for an edge of the repaired triangulation.
  template <typename Tag, typename NamedParameters>
  bool is_marked_part(Tag tag, const NamedParameters& np, Index e) const
  {
    const Index input = repaired.input_edges[e];
    return input != Intrinsic_triangulation<double>::null_index && is_marked_edge(tag, np, input);
  }

  // Names vertices of the mesh: those given, and those of faces that may be none of the mesh.
  void name_vertices_of_faces(const std::vector<Index>& faces, std::vector<Index> vertices, Flattening_report<TriangleMesh>& report) const
  {
    name_elements(mesh, with_vertices_of_faces(mesh.triangulation, std::move(vertices), repaired.triangulation(), faces), {}, {}, report);
  }

  // ---- Cut and layout

  template <typename NamedParameters>
  void find_cut(const NamedParameters& np, Flattening_report<TriangleMesh>& report)
  {
    const bool is_prescribed = !parameters::is_default_parameter<NamedParameters, internal_np::conformal_edge_is_seam_t>::value;
    if(report.topology.is_disk() && cones_.empty() && !is_prescribed)
      return; // nothing to do
    const auto seam = [&](Index e) { return is_marked_part(internal_np::conformal_edge_is_seam, np, e); };
    const auto constrained = [&](Index e) { return is_marked_part(internal_np::edge_is_constrained, np, e); };
    cut = compute_cut_graph(repaired.triangulation(), cones_,
                            parameters::edge_is_seam_map(boost::make_function_property_map<Index, bool>(seam))
                                       .edge_is_constrained_map(boost::make_function_property_map<Index, bool>(constrained)));
    if(bool(cut))
      return;
    report.status = cut.status;
    std::vector<Index> ends;
    for(const Index e : cut.edges)
    {
      const Index h = repaired.triangulation().edge_halfedge(e);
      ends.push_back(repaired.triangulation().origin(h));
      ends.push_back(repaired.triangulation().target(h));
    }
    name_vertices_of_faces(cut.faces, ends, report);
  }

  template <typename NamedParameters>
  void lay_out(const NamedParameters& np, Flattening_report<TriangleMesh>& report)
  {
    layout = compute_layout(repaired.triangulation(), repaired.metric, cut, parameters::layout_frame(given_frame(mesh, np)));
    report.layout_length_error = layout.length_error;
  }

  // Every triangle of the layout, as rounded, is exactly positive, or its vertices are named.
  void verify(Flattening_report<TriangleMesh>& report) const
  {
    std::vector<Index> flipped;
    for(Index f = 0; f < repaired.triangulation().number_of_faces(); ++f)
      if(!is_positive_triangle(layout, f))
        flipped.push_back(f);
    if(flipped.empty())
      return;
    report.status = Status::NOT_INJECTIVE;
    name_vertices_of_faces(flipped, {}, report);
  }

  void tell_what_was_found(Flattening_report<TriangleMesh>& report) const
  {
    for(const Index v : cones_)
      report.cones.push_back({mesh.vertex(v), v, conditions_.is_fixed(v) ? angle_sum_at(repaired.metric, v) : conditions_.angle_sum(v).radians(),
                              conditions_.is_fixed(v)});
    report.lattices.assign(layout.lattices.begin(), layout.lattices.end());
  }

  Conformal_conditions<double> conditions_;
  std::vector<Index> cones_; // in increasing order
};

// Writes the corners to all halfedges; a border halfedge gets the corner of the face across.
template <typename RepairedMesh, typename HalfedgeUVMap>
void write_repaired_corners(const Intrinsic_triangulation<double>& t, const Layout<double>& layout,
                            const Repaired_mesh_elements<RepairedMesh>& elements, const RepairedMesh& out, HalfedgeUVMap uv)
{
  typedef typename boost::property_traits<HalfedgeUVMap>::value_type Point_2;
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
  using parameters::get_parameter;
  using parameters::is_default_parameter;
  CGAL_USE(out);
  CGAL_USE(np);
  const Intrinsic_triangulation<double>& t = flattening.repaired.triangulation();
  const std::vector<double>& u = flattening.repaired.metric.log_scale_factors;
  double least = (std::numeric_limits<double>::max)();
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v))
      least = (std::min)(least, u[v]);
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
  {
    if(t.is_isolated_vertex(v))
      continue;
    if constexpr(!is_default_parameter<NamedParameters, internal_np::conformal_u_t>::value)
      put(get_parameter(np, internal_np::conformal_u), elements.vertices[v], u[v]);
    if constexpr(!is_default_parameter<NamedParameters, internal_np::conformal_weight_t>::value)
      put(get_parameter(np, internal_np::conformal_weight), elements.vertices[v], projective_weight(u[v], least));
  }
  if constexpr(!is_default_parameter<NamedParameters, internal_np::conformal_edge_is_seam_t>::value)
    for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
      put(get_parameter(np, internal_np::conformal_edge_is_seam), edge(elements.halfedges[t.edge_halfedge(e)], out),
          bool(flattening.cut[e]));
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceDoors
///
/// flattens a triangle mesh of any topology, as `flatten()` does on a fixed triangulation; where the metric found breaks
/// triangles, edges are flipped or split, see `repair_locally()`, on a copy of the mesh, for which the texture coordinates are.
/// Where nothing had to be changed it is just a copy. On the copy, length cross ratios are those of the surface given: distances
/// across flipped edges are measured on it, not in space.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam RepairedMesh a model of `MutableFaceGraph`
/// \tparam HalfedgeUVMap a model of `WritablePropertyMap` with key type `boost::graph_traits<RepairedMesh>::%halfedge_descriptor`
///         and a value type that can be made from two `double`
///
/// \param tm a triangle mesh. It is not modified.
/// \param repaired the mesh to be made, empty; see `make_repaired_mesh()`
/// \param uv receives, at every halfedge `h` of `repaired`, where `target(h)` lies in `face(h)`; a border halfedge receives what
///        `prev(opposite(h))` does
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" with maps of `tm`, as in `flatten()`:
///        `vertex_point_map`, `edge_length_map`, `border_angle_map`, `cone_angle_map`, `vertex_is_constrained_map`,
///        `prescribed_log_scale_factor_map`, `initial_log_scale_factor_map`, `gradient_tolerance`, `number_of_iterations`,
///        `newton_strategy`, `sparse_linear_solver`, `layout_frame`, `visitor`, `flattening_report`; `maximum_number_of_changes`
///        as in `repair_locally()`; and the ones listed below. The others of `flatten()` are not read.
/// \param np_repaired an optional sequence of \ref bgl_namedparameters "Named Parameters" with maps of `repaired`, which are
///        written: `vertex_point_map`, as in `make_repaired_mesh()`; `log_scale_factor_map`, `projective_weight_map` and
///        `edge_is_seam_map`, as in `flatten()`
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{edge_is_seam_map}
///     \cgalParamDescription{`true` where the surface is to be cut in any case; such edges are not flipped, but may be split}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%edge_descriptor` and value type `bool`}
///     \cgalParamDefault{`false` for all edges}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_is_constrained_map}
///     \cgalParamDescription{`true` where the surface must not be cut; such edges are not flipped, but may be split}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%edge_descriptor` and value type `bool`}
///     \cgalParamDefault{`false` for all edges}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the report, with the changes. Meshes and maps are written iff it is a success. Statuses: those of `flatten()` and
///         `repair_locally()`, and `NOT_REPRESENTABLE` if `repaired` cannot hold the result. After changes, faces at fault are
///         told by those of their vertices that are vertices of `tm`.
///
/// Time is that of `repair_locally()`, and O(n log n) for the cut; all else is linear.
///
/// \sa `CGAL::Conformal_equivalence::flatten()`
template <typename TriangleMesh, typename RepairedMesh, typename HalfedgeUVMap,
          typename NamedParameters = parameters::Default_named_parameters,
          typename NamedParametersRepaired = parameters::Default_named_parameters>
Repair_report<TriangleMesh, RepairedMesh>
flatten_repaired(const TriangleMesh& tm,
                 RepairedMesh& repaired,
                 HalfedgeUVMap uv,
                 const NamedParameters& np = parameters::default_values(),
                 const NamedParametersRepaired& np_repaired = parameters::default_values())
{
  static_assert(internal::Check_halfedge_map<HalfedgeUVMap, RepairedMesh>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_flatten_repaired, TriangleMesh, NamedParameters>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_repaired_mesh, RepairedMesh, NamedParametersRepaired>::value);
  Repair_report<TriangleMesh, RepairedMesh> report;
  internal::Repaired_flattening<TriangleMesh> flattening{Imported_mesh<TriangleMesh>(tm)};
  flattening.run(np, report);
  report.changes = flattening.repaired.changes;
  if(bool(report))
  {
    report.elements = make_repaired_mesh(flattening.mesh, flattening.repaired, repaired, np, np_repaired);
    if(report.elements.faces.empty())
      report.status = Status::NOT_REPRESENTABLE;
  }
  if(bool(report))
  {
    internal::write_repaired_corners(flattening.repaired.triangulation(), flattening.layout, report.elements, repaired, uv);
    internal::write_repaired_maps(flattening, report.elements, repaired, np_repaired);
    for(const Transition<double>& motion : flattening.layout.transitions)
      report.repaired_transitions.push_back({report.elements.halfedges[motion.halfedge], motion.rotation, motion.translation});
  }
  internal::write_report<TriangleMesh>(report, np);
  return report;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_REPAIRED_H
