// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file flatten.h
/// The whole way in one call: from a mesh of any topology and conditions to texture coordinates
/// (sections 3 to 5 of Springborn, Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_H
#define CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/compute_common_refinement.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/compute_cut_graph.h>
#include <CGAL/Conformal_equivalence/compute_layout.h>
#include <CGAL/Conformal_equivalence/internal/Doors/parameters_of_doors.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Cell_verdict.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>
#include <CGAL/Conformal_equivalence/projective_interpolation.h>
#include <CGAL/Conformal_equivalence/read_conditions.h>

#include <CGAL/boost/graph/iterator.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

namespace internal {

// Does some work, with the visitor told, and adds the seconds that it took.
template <typename Visitor, typename Work>
void timed(double& seconds, Stage stage, Visitor& visitor, Work work)
{
  const Stopwatch stopwatch;
  visitor.on_stage(stage);
  work();
  seconds += stopwatch.seconds();
}

// The conditions that the named parameters give for the mesh; `report` names the vertices that lack one.
template <typename TriangleMesh, typename NT, typename NamedParameters>
Conformal_conditions<NT> read_conditions_or_name(const Imported_mesh<TriangleMesh, NT>& mesh, const NamedParameters& np,
                                                 Flattening_report<TriangleMesh>& report)
{
  std::vector<std::uint32_t> missing;
  const Conformal_conditions<NT> result = read_conditions(mesh, missing, np);
  if(!missing.empty())
  {
    report.status = Status::MISSING_CONDITION;
    name_elements(mesh, missing, {}, {}, report);
  }
  return result;
}

// In increasing order.
template <typename NT>
std::vector<std::uint32_t> interior_cones(const Intrinsic_triangulation<NT>& t, const Conformal_conditions<NT>& conditions)
{
  std::vector<std::uint32_t> result;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v) && !t.is_border_vertex(v) && conditions.is_cone(v))
      result.push_back(v);
  return result;
}

// The map of initial u, if there is one, keyed by indices.
template <typename TriangleMesh, typename NT, typename NamedParameters>
auto indexed_initial_guess(const Imported_mesh<TriangleMesh, NT>& mesh, const NamedParameters& np)
{
  CGAL_USE(mesh);
  CGAL_USE(np);
  if constexpr(parameters::is_default_parameter<NamedParameters, internal_np::conformal_initial_u_t>::value)
    return parameters::default_values();
  else
  {
    const auto map = parameters::get_parameter(np, internal_np::conformal_initial_u);
    const auto by_index = [&mesh, map](std::uint32_t v) { return double(get(map, mesh.vertex(v))); };
    return parameters::initial_log_scale_factor_map(boost::make_function_property_map<std::uint32_t, double>(by_index));
  }
}

template <typename TriangleMesh, typename NT>
Layout_frame indexed_frame(const Imported_mesh<TriangleMesh, NT>&, Layout_frame frame) { return frame; }

template <typename TriangleMesh, typename NT, typename Vertex>
Pinned_frame<std::uint32_t> indexed_frame(const Imported_mesh<TriangleMesh, NT>& mesh, const Pinned_frame<Vertex>& frame)
{
  return {mesh.index_of_vertex(frame.first), frame.first_point, mesh.index_of_vertex(frame.second), frame.second_point};
}

// The frame of the layout, by indices.
template <typename TriangleMesh, typename NT, typename NamedParameters>
auto given_frame(const Imported_mesh<TriangleMesh, NT>& mesh, const NamedParameters& np)
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  return indexed_frame(mesh, choose_parameter(get_parameter(np, internal_np::conformal_layout_frame), Layout_frame::CANONICAL));
}

// Exactly for `double`; for other numbers `true` only if that is certain.
template <typename NT>
bool is_positive_triangle(const Layout<NT>& layout, std::uint32_t f)
{
  return is_left_turn(layout.corner[3 * f], layout.corner[3 * f + 1], layout.corner[3 * f + 2]);
}

// One flattening: the stages one after the other, each a value that the next takes.
// What the user gets is written by the caller, from `metric`, `cut` and `layout`.
template <typename TriangleMesh, typename NT = double>
struct Flattening
{
  typedef std::uint32_t Index;

  Imported_mesh<TriangleMesh, NT> mesh;
  Conformal_metric<NT> metric;
  Cut_graph cut;
  Layout<NT> layout;
  Common_refinement<NT> refinement; // empty unless asked for
  Flattening_report<TriangleMesh> report;

  explicit Flattening(Imported_mesh<TriangleMesh, NT> imported) : mesh(std::move(imported)) {}

  // The whole surface: lengths, conditions, metric, cut, layout, verdict; stops where one of them fails.
  template <typename NamedParameters>
  void run(const NamedParameters& np)
  {
    run_with_metric(np, [&] { find_metric(np, [] { return true; }); }, [&] { verify(); });
  }

  // The same, where `find_the_metric()` reads the conditions and solves, by `find_metric()` or `take()`, and `verify_it()` judges the layout.
  template <typename NamedParameters, typename Find_metric, typename Verify>
  void run_with_metric(const NamedParameters& np, Find_metric find_the_metric, Verify verify_it)
  {
    run_stages(np, find_the_metric, [&] { find_cut(np); }, [&] { lay_out(np); }, verify_it);
  }

  // The same with the common refinement, on which the verdict is then. Without flips the mesh is its own refinement, and none is made
  // unless `is_always_made`.
  template <typename NamedParameters>
  void run_with_refinement(const NamedParameters& np, bool is_always_made)
  {
    const auto lay_out_twice = [&]
    {
      lay_out(np);
      if(metric.is_retriangulated() || is_always_made)
        refine(np);
    };
    run_stages(np, [&] { find_metric(np, [] { return true; }); }, [&] { find_cut(np); }, lay_out_twice, [&] { verify_refinement(); });
  }

  // Names the triangles with parts that are not exactly positive, as rounded.
  void judge(const Common_refinement<NT>& parts) { refuse_flipped(input_faces_lost(parts)); }

  // The same where the cut is given, and only the piece to which `face` belongs is laid out. It must be a disk, with all cones
  // on its border; `no_disk` says so if not.
  template <typename NamedParameters>
  void run_along(Cut_graph given_cut, Index face, Status no_disk, const NamedParameters& np)
  {
    cut = std::move(given_cut);
    run_stages(np, [&] { find_metric(np, [&] { return check_cut(face, no_disk); }); }, [] {}, [&] { lay_out_piece(face, np); },
               [&] { verify(); });
  }

  // Reads the conditions, and solves if `check()` has nothing against them.
  template <typename NamedParameters, typename Check>
  void find_metric(const NamedParameters& np, Check check)
  {
    if(read(np) && check())
      solve(np);
  }

  // The metric, found with these conditions.
  void take(Conformal_metric<NT> found, Conformal_conditions<NT> conditions)
  {
    conditions_ = std::move(conditions);
    cones_ = interior_cones(mesh.triangulation, conditions_);
    metric = std::move(found);
    report_metric();
  }

  const Conformal_conditions<NT>& conditions() const { return conditions_; }
  const std::vector<Index>& cones() const { return cones_; }

private:
  template <typename NamedParameters, typename Find_metric, typename Find_cut, typename Lay_out, typename Verify>
  void run_stages(const NamedParameters& np, Find_metric find_the_metric, Find_cut find_the_cut, Lay_out lay_it_out, Verify verify_it)
  {
    using parameters::choose_parameter;
    using parameters::get_parameter;
    auto given_visitor = choose_parameter<Default_visitor>(get_parameter(np, internal_np::visitor));
    auto& visitor = unwrap(given_visitor);
    Statistics::Seconds& seconds = report.statistics.seconds;
    try
    {
      timed(seconds.import, Stage::IMPORT, visitor, [&] { import_lengths(np); });
      if(bool(report))
        find_the_metric();
      if(bool(report))
        timed(seconds.cut, Stage::CUT, visitor, find_the_cut);
      if(bool(report))
        timed(seconds.layout, Stage::LAYOUT, visitor, lay_it_out);
      if(bool(report))
        timed(seconds.verify, Stage::VERIFY, visitor, verify_it);
      if(bool(report))
        tell_what_was_found();
    }
    catch(const std::bad_alloc&)
    {
      report.status = Status::OUT_OF_MEMORY;
    }
  }

  template <typename NamedParameters>
  void import_lengths(const NamedParameters& np)
  {
    set_lengths(mesh, np);
    const Statistics statistics = report.statistics;
    report = import_report(mesh);
    report.statistics = statistics;
  }

  // ---- Conditions and metric

  template <typename NamedParameters>
  bool read(const NamedParameters& np)
  {
    conditions_ = read_conditions_or_name(mesh, np, report);
    if(!bool(report))
      return false;
    cones_ = interior_cones(mesh.triangulation, conditions_);
    return true;
  }

  template <typename NamedParameters>
  void solve(const NamedParameters& np)
  {
    typedef typename internal_np::Lookup_named_param_def<internal_np::sparse_linear_solver_t, NamedParameters,
                                                         Default_solver_traits>::type Solver_traits;
    using parameters::choose_parameter;
    using parameters::get_parameter;
    {
      Conformal_metric_solver<NT, Solver_traits> solver(
        std::move(mesh.triangulation), choose_parameter<Solver_traits>(get_parameter(np, internal_np::sparse_linear_solver)));
      metric = std::move(solver).solve(conditions_, Conformal_equivalence::combine_named_parameters(np, indexed_initial_guess(mesh, np)));
      if(metric.is_retriangulated())
        mesh.triangulation = solver.triangulation();
    }
    if(!metric.is_retriangulated())
      mesh.triangulation = metric.triangulation; // copied only now: the solver has freed its memory
    report_metric();
  }

  void report_metric()
  {
    const Statistics::Seconds seconds = report.statistics.seconds;
    report.statistics = metric.statistics;
    report.statistics.seconds.import = seconds.import;
    report.status = metric.status;
    report.amount = metric.amount;
    if(metric.is_retriangulated()) // its faces are not those of the mesh
      name_elements(mesh, with_vertices_of_faces(mesh.triangulation, metric.vertices, metric.triangulation, metric.faces), {}, {}, report);
    else
      name_elements(mesh, metric.vertices, metric.edges, metric.faces, report);
  }

  // ---- Cut

  template <typename NamedParameters>
  void find_cut(const NamedParameters& np)
  {
    const bool is_prescribed = !parameters::is_default_parameter<NamedParameters, internal_np::conformal_edge_is_seam_t>::value;
    if(report.topology.is_disk() && cones_.empty() && !is_prescribed)
      return; // nothing to do
    cut = compute_cut_graph(mesh.triangulation, cones_, seam_parameters(np));
    if(bool(cut))
      return;
    report.status = cut.status;
    name_elements(mesh, {}, cut.edges, cut.faces, report);
  }

  // The maps are keyed by descriptors here, by indices in compute_cut_graph().
  template <typename NamedParameters>
  auto seam_parameters(const NamedParameters& np) const
  {
    using parameters::get_parameter;
    using parameters::is_default_parameter;
    const auto by_index = [this](auto map)
    {
      typedef typename boost::property_traits<decltype(map)>::value_type Value;
      return boost::make_function_property_map<Index, Value>([this, map](Index e) -> Value { return get(map, mesh.edge(e)); });
    };
    const auto no = boost::make_function_property_map<Index, bool>([](Index) { return false; });
    const auto seam = [&]
    {
      if constexpr(is_default_parameter<NamedParameters, internal_np::conformal_edge_is_seam_t>::value)
        return parameters::edge_is_seam_map(no);
      else
        return parameters::edge_is_seam_map(by_index(get_parameter(np, internal_np::conformal_edge_is_seam)));
    }();
    const auto constrained = [&]
    {
      if constexpr(is_default_parameter<NamedParameters, internal_np::edge_is_constrained_t>::value)
        return seam.edge_is_constrained_map(no);
      else
        return seam.edge_is_constrained_map(by_index(get_parameter(np, internal_np::edge_is_constrained)));
    }();
    if constexpr(is_default_parameter<NamedParameters, internal_np::conformal_seam_weight_t>::value)
      return constrained;
    else
      return constrained.seam_weight_map(by_index(get_parameter(np, internal_np::conformal_seam_weight)));
  }

  // Is the piece that a given cut leaves at `face` a disk with all cones on its border?
  bool check_cut(Index face, Status no_disk)
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    const Intrinsic_triangulation<NT> open = cut_open(t, cut);
    const Surface_components pieces = connected_components(open);
    const Index piece = pieces.component_of_vertex[open.origin(3 * face)];
    if(!pieces.components[piece].is_disk())
    {
      report.status = no_disk;
      report.topology = surface_topology(pieces.components[piece]);
      std::vector<Index> seam; // at the piece
      for(Index e = 0; e < t.number_of_edges(); ++e)
        if(cut[e] && (pieces.component_of_vertex[open.origin(t.edge_halfedge(e))] == piece
                      || pieces.component_of_vertex[open.origin(t.twin(t.edge_halfedge(e)))] == piece))
          seam.push_back(e);
      name_elements(mesh, {}, seam, {}, report);
      return false;
    }
    std::vector<Index> missed;
    for(Index v : cones_)
    {
      const Index copy = open.origin(t.vertex_halfedge(v));
      if(pieces.component_of_vertex[copy] == piece && !open.is_border_vertex(copy))
        missed.push_back(v);
    }
    if(missed.empty())
      return true;
    report.status = Status::SEAM_MISSES_CONE;
    name_elements(mesh, missed, {}, {}, report);
    return false;
  }

  // ---- Layout

  template <typename NamedParameters>
  void lay_out(const NamedParameters& np)
  {
    layout = compute_layout(mesh.triangulation, metric, cut,
                            Conformal_equivalence::combine_named_parameters(np, parameters::layout_frame(given_frame(mesh, np))));
    report.layout_length_error = layout.length_error;
    faces_laid_out_.resize(mesh.triangulation.number_of_faces());
    std::iota(faces_laid_out_.begin(), faces_laid_out_.end(), Index(0));
  }

  template <typename NamedParameters>
  void lay_out_piece(Index face, const NamedParameters& np)
  {
    const auto is_wanted = [&](const Piece& piece)
    {
      const bool result = std::binary_search(piece.faces.begin(), piece.faces.end(), face);
      if(result)
        faces_laid_out_ = piece.faces;
      return result;
    };
    layout = internal::lay_out(mesh.triangulation, metric, cut, given_frame(mesh, np), is_wanted);
    report.layout_length_error = layout.length_error;
  }

  // The overlay, with the corners of the mesh where they are in `layout`.
  template <typename NamedParameters>
  void refine(const NamedParameters& np)
  {
    refinement = compute_common_refinement(mesh.triangulation, metric, cut, default_maximum_number_of_crossings,
                                           parameters::layout_frame(given_frame(mesh, np)));
    report.status = refinement ? report.status : refinement.status;
    report.amount = refinement ? report.amount : refinement.amount;
  }

  // ---- Verdict

  // The straight triangles of the layout that are not exactly positive, as rounded; for other numbers than `double`, not certainly.
  std::vector<Index> flipped_triangles() const
  {
    std::vector<Index> flipped;
    for(Index f : faces_laid_out_)
      if(!is_positive_triangle(layout, f))
        flipped.push_back(f);
    return flipped;
  }

  void refuse_flipped(const std::vector<Index>& flipped)
  {
    if(flipped.empty())
      return;
    report.status = Status::NOT_INJECTIVE;
    name_elements(mesh, {}, {}, flipped, report);
  }

  // Every triangle is positive, or named.
  void verify() { refuse_flipped(flipped_triangles()); }

  // Every part of a triangle is positive, or the triangle is named.
  void verify_refinement()
  {
    if(refinement.number_of_faces() == 0)
      return verify();
    judge(refinement);
    for(Index f : flipped_triangles())
      report.bent_faces.push_back(mesh.face(f));
  }

  void tell_what_was_found()
  {
    for(Index e : metric.lost_border_edges)
      report.lost_border_edges.push_back(mesh.edge(e));
    for(Index v : cones_)
      report.cones.push_back({mesh.vertex(v), mesh.index_of_vertex(mesh.vertex(v)),
                              conditions_.is_fixed(v) ? angle_sum_at(metric, v) : conditions_.angle_sum(v).template radians<double>(),
                              conditions_.is_fixed(v)});
    const auto rounded = [](const std::array<NT, 2>& z) { return std::array<double, 2>{{static_cast<double>(z[0]), static_cast<double>(z[1])}}; };
    for(const Transition<NT>& motion : layout.transitions)
      report.transitions.push_back({mesh.halfedge(motion.halfedge), rounded(motion.rotation), rounded(motion.translation)});
    for(const Period_lattice<NT>& lattice : layout.lattices)
      report.lattices.push_back({mesh.position_of_face(Index(lattice.face)),
                                 {{rounded(lattice.periods[0]), rounded(lattice.periods[1])}}, rounded(lattice.tau)});
  }

  Conformal_conditions<NT> conditions_;
  std::vector<Index> cones_;           // in increasing order
  std::vector<Index> faces_laid_out_;
};

// The faces of `tm`, in charts if there is a map of patches: edges between different patches become borders.
template <typename NT = double, typename TriangleMesh, typename NamedParameters>
Imported_mesh<TriangleMesh, NT> import_charts(const TriangleMesh& tm, const NamedParameters& np)
{
  CGAL_USE(np);
  if constexpr(parameters::is_default_parameter<NamedParameters, internal_np::face_patch_t>::value)
    return Imported_mesh<TriangleMesh, NT>(tm);
  else
  {
    const auto patch = parameters::get_parameter(np, internal_np::face_patch);
    const auto is_between_charts = [&](typename boost::graph_traits<TriangleMesh>::edge_descriptor e)
      { return !(get(patch, face(halfedge(e, tm), tm)) == get(patch, face(opposite(halfedge(e, tm), tm), tm))); };
    return Imported_mesh<TriangleMesh, NT>(tm, faces(tm), is_between_charts);
  }
}

// Writes u, weights and scaled lengths to the maps that were given for them.
template <typename TriangleMesh, typename NT, typename NamedParameters>
void write_metric(const Flattening<TriangleMesh, NT>& flattening, const NamedParameters& np)
{
  using parameters::get_parameter;
  using parameters::is_default_parameter;
  const Imported_mesh<TriangleMesh, NT>& mesh = flattening.mesh;
  const Intrinsic_triangulation<NT>& t = mesh.triangulation;
  const std::vector<NT>& u = flattening.metric.log_scale_factors;
  double least = (std::numeric_limits<double>::max)();
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v))
      least = (std::min)(least, static_cast<double>(u[v]));
  const auto write = [&](auto map, const auto& key, const NT& x)
    { put(map, key, static_cast<typename boost::property_traits<decltype(map)>::value_type>(x)); };

  if constexpr(!is_default_parameter<NamedParameters, internal_np::conformal_u_t>::value)
    for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
      if(!t.is_isolated_vertex(v))
        write(get_parameter(np, internal_np::conformal_u), mesh.vertex(v), u[v]);
  if constexpr(!is_default_parameter<NamedParameters, internal_np::conformal_weight_t>::value)
    for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
      if(!t.is_isolated_vertex(v))
        put(get_parameter(np, internal_np::conformal_weight), mesh.vertex(v), projective_weight(static_cast<double>(u[v]), least));
  if constexpr(!is_default_parameter<NamedParameters, internal_np::conformal_scaled_length_t>::value)
    for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
      write(get_parameter(np, internal_np::conformal_scaled_length), mesh.edge(e),
            flattening.layout.straight_lengths.empty() ? flattening.metric.scaled_length(t.edge_halfedge(e))
                                                       : flattening.layout.straight_lengths[e]);
}

// Writes the corners to all halfedges of imported faces; a halfedge without a face
// gets the corner of the face across. That comes first: on a Seam_mesh both may have the same key.
template <typename TriangleMesh, typename NT, typename HalfedgeUVMap>
void write_corners(const Imported_mesh<TriangleMesh, NT>& mesh, const Layout<NT>& layout, HalfedgeUVMap uv)
{
  typedef typename boost::property_traits<HalfedgeUVMap>::value_type Point_2;
  const Intrinsic_triangulation<NT>& t = mesh.triangulation;
  const auto point = [&](std::uint32_t h) { return Point_2(layout.corner[h][0], layout.corner[h][1]); };
  for(std::uint32_t h = 0; h < t.number_of_halfedges(); ++h)
  {
    if(!t.is_border(h))
      continue;
    const auto across = opposite(mesh.halfedge(h), mesh.mesh());
    if(CGAL::is_border(across, mesh.mesh())) // and not between charts
      put(uv, across, point(t.previous(h)));
  }
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
  {
    auto hd = mesh.halfedge(3 * f);
    for(std::uint32_t h = 3 * f; h < 3 * f + 3; ++h, hd = next(hd, mesh.mesh()))
      put(uv, hd, point(h));
  }
}

// Writes the seam: the edges that were cut, and those between charts.
template <typename TriangleMesh, typename NT, typename NamedParameters>
void write_seam(const Flattening<TriangleMesh, NT>& flattening, const NamedParameters& np)
{
  CGAL_USE(np);
  if constexpr(!parameters::is_default_parameter<NamedParameters, internal_np::conformal_edge_is_seam_t>::value)
  {
    const Imported_mesh<TriangleMesh, NT>& mesh = flattening.mesh;
    for(std::uint32_t e = 0; e < mesh.triangulation.number_of_edges(); ++e)
    {
      const auto ed = mesh.edge(e);
      const bool is_seam = mesh.triangulation.is_border_edge(e) ? !CGAL::is_border(ed, mesh.mesh()) : flattening.cut[e];
      put(parameters::get_parameter(np, internal_np::conformal_edge_is_seam), ed, is_seam);
    }
  }
  else
    CGAL_USE(flattening);
}

template <typename TriangleMesh, typename NamedParameters>
void write_report(const Flattening_report<TriangleMesh>& report, const NamedParameters& np)
{
  if constexpr(!parameters::is_default_parameter<NamedParameters, internal_np::conformal_report_t>::value)
    parameters::get_parameter(np, internal_np::conformal_report).get() = report;
  else
    CGAL_USE(report);
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceDoors
///
/// flattens a triangle mesh of any topology: finds the metric that is conformally equivalent to the mesh's, is flat except at cones, and
/// meets the conditions; cuts the surface open where that is needed, and lays it out in the plane. The result preserves length cross ratios
/// to rounding, the two sides of every seam edge have equal lengths, and no triangle is flipped, decided exactly on the coordinates
/// written.
///
/// The mesh may be closed or have any number of borders, none of which is filled, any number of handles, and any number of
/// components, each of which is a problem of its own. The layouts of the components do not overlap one another. Isolated vertices
/// are carried through untouched.
///
/// The triangulation is kept where it has a solution, see `retriangulation`. If edges were flipped, length cross ratios are not preserved, as
/// it is another triangulation that was scaled; points are written for the corners of the mesh, whose edges are no straight
/// lines in the flat surface, and a straight triangle between these points may be flipped, which is reported (`NOT_INJECTIVE`). The
/// map is continuous and positive on the parts of the triangles that the edges of both triangulations make: with `common_refinement` these
/// are what the verdict is on, and `flatten_refined()` makes a mesh of them.
///
/// *Cones* are interior vertices whose angle sum is prescribed (`cone_angle_map`) and not 2 pi, or where u is prescribed instead
/// (`vertex_is_constrained_map`: a free cone). On a component where no u is prescribed, the curvatures 2 pi - angle at interior vertices
/// and pi - angle on borders sum up to 2 pi chi (Gauss-Bonnet). So a closed surface needs cones, at least three on a sphere,
/// unless it is a torus: that has a flat metric without cones, and a lattice of periods, which the report holds.
///
/// *Charts*: with `face_patch_map` every maximal set of faces of one patch that is connected through edges is a surface of its own, and the edges between
/// patches are borders. Maps of vertices hold for all charts at a vertex; what is written to one is what was found for one of them (for natural
/// borders, u = 0 for all).
///
/// A `Seam_mesh` is taken for the surface that it is, cut open, with maps of its own vertices and edges; to use its seam
/// just for cutting, see `Surface_mesh_parameterization::Conformal_equivalence_parameterizer_3`.
///
/// Lengths, angles and points may have more digits than `double`: `flatten<NT>(tm, uv, np)`, where `NT` is a binary floating-point number of
/// Boost.Multiprecision; for as many digits as it holds with `gradient_tolerance(0.)`, where the status then is `CONVERGED_TO_ROUNDING`. The
/// verdict is on the points of that type.
///
/// \tparam NT number type of lengths, of u, and of the points
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam HalfedgeUVMap a model of `WritablePropertyMap` with key type
///         `boost::graph_traits<TriangleMesh>::%halfedge_descriptor` and a value type that can be made from two `NT`, for `double` such as
///         `Point_2` of any kernel
/// \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
///
/// \param tm a triangle mesh
/// \param uv receives, at every halfedge `h`, where `target(h, tm)` lies in the triangle of `face(h, tm)`; a
///        border halfedge receives what `prev(opposite(h, tm), tm)` does. So `uv[target(hd, seam_mesh)]` is what it should be for the `Seam_mesh`
///        that `make_seam_mesh()` makes of the seam.
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{edge_length_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{mollification} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{face_patch_map}
///     \cgalParamDescription{the patches of the faces}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%face_descriptor` and any value type with `==`}
///     \cgalParamDefault{none: no edge is a border that is not one of the mesh}
///   \cgalParamNEnd
///   \cgalParamNBegin{border_angle_map} \cgalParamDescription{as in `read_conditions()`} \cgalParamNEnd
///   \cgalParamNBegin{cone_angle_map} \cgalParamDescription{as in `read_conditions()`} \cgalParamNEnd
///   \cgalParamNBegin{vertex_is_constrained_map} \cgalParamDescription{as in `read_conditions()`} \cgalParamNEnd
///   \cgalParamNBegin{prescribed_log_scale_factor_map} \cgalParamDescription{as in `read_conditions()`} \cgalParamNEnd
///   \cgalParamNBegin{edge_is_seam_map}
///     \cgalParamDescription{on entry, `true` where the surface is to be cut in any case; receives the whole seam: the edges cut, and those between charts}
///     \cgalParamType{a read-write property map with key type `boost::graph_traits<TriangleMesh>::%edge_descriptor` and value type `bool`, copies of which share their values}
///     \cgalParamDefault{`false` for all edges}
///     \cgalParamExtra{Border edges are never seam edges, whatever is given for them.}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_is_constrained_map}
///     \cgalParamDescription{`true` where the surface must not be cut}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%edge_descriptor` and value type `bool`}
///     \cgalParamDefault{`false` for all edges}
///   \cgalParamNEnd
///   \cgalParamNBegin{seam_weight_map}
///     \cgalParamDescription{what it costs to cut an edge, see `compute_cut_graph()`}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%edge_descriptor` and a value type convertible to `double`}
///     \cgalParamDefault{the lengths}
///   \cgalParamNEnd
///   \cgalParamNBegin{initial_log_scale_factor_map}
///     \cgalParamDescription{where the solver begins}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a value type convertible to `double`}
///     \cgalParamDefault{the discretely harmonic extension of the fixed u}
///   \cgalParamNEnd
///   \cgalParamNBegin{log_scale_factor_map}
///     \cgalParamDescription{receives u}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{projective_weight_map}
///     \cgalParamDescription{receives the weights e^{-u} of projective interpolation (section 3.4), scaled to a maximum of 1}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{scaled_edge_length_map}
///     \cgalParamDescription{receives the lengths of the edges in the flat metric, or, if edges were flipped, of the straight lines that replace them}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%edge_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{layout_frame}
///     \cgalParamDescription{how the layout is placed in the plane}
///     \cgalParamType{`Layout_frame`, or `Pinned_frame<vertex_descriptor>`}
///     \cgalParamDefault{`Layout_frame::CANONICAL`}
///   \cgalParamNEnd
///   \cgalParamNBegin{gradient_tolerance, number_of_iterations, newton_strategy, retriangulation, border_edges, visitor}
///     \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{sparse_linear_solver} \cgalParamDescription{as in `compute_conformal_metric()`} \cgalParamNEnd
///   \cgalParamNBegin{common_refinement}
///     \cgalParamDescription{if edges were flipped, receives the overlay of the mesh with the triangulation of the metric, see `compute_common_refinement()`; otherwise one without faces. Straight triangles that are flipped are then not refused, but listed in the report (`bent_faces`)}
///     \cgalParamType{`std::reference_wrapper<Common_refinement<NT> >`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{flattening_report}
///     \cgalParamDescription{receives a copy of what is returned}
///     \cgalParamType{`std::reference_wrapper<Flattening_report<TriangleMesh> >`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the report, with the cones, the motions across the seam edges, and the lattices of tori. Maps are written iff it is a success.
///         Statuses: those of `import_mesh()` and `Conformal_metric_solver::solve()`, `MISSING_CONDITION` (vertices), those of
///         `compute_cut_graph()` (edges, faces), those of `compute_common_refinement()` if it was asked for, and `NOT_INJECTIVE` (faces: triangles
///         that are flat or flipped: straight triangles where edges were flipped, or, where scale factors range too far for `double`, by rounding).
///
/// Time is that of the solver, see `Conformal_metric_solver::solve()`, and O(n log n) for the cut; all else is linear.
///
/// \sa `CGAL::Conformal_equivalence::make_seam_mesh()`
/// \sa `CGAL::Conformal_equivalence::verify_layout()`
template <typename NT = double, typename TriangleMesh, typename HalfedgeUVMap,
          typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> flatten(const TriangleMesh& tm,
                                        HalfedgeUVMap uv,
                                        const NamedParameters& np = parameters::default_values())
{
  static_assert(internal::Check_halfedge_map<HalfedgeUVMap, TriangleMesh>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_flatten, TriangleMesh, NamedParameters>::value);
  const internal::Stopwatch stopwatch;
  internal::Flattening<TriangleMesh, NT> flattening{internal::import_charts<NT>(tm, np)};
  flattening.report.statistics.seconds.import = stopwatch.seconds();
  if constexpr(parameters::is_default_parameter<NamedParameters, internal_np::conformal_common_refinement_t>::value)
    flattening.run(np);
  else
    flattening.run_with_refinement(np, false);
  if(bool(flattening.report))
  {
    internal::write_corners(flattening.mesh, flattening.layout, uv);
    internal::write_metric(flattening, np);
    internal::write_seam(flattening, np);
    if constexpr(!parameters::is_default_parameter<NamedParameters, internal_np::conformal_common_refinement_t>::value)
      parameters::get_parameter(np, internal_np::conformal_common_refinement).get() = std::move(flattening.refinement);
  }
  internal::write_report(flattening.report, np);
  return flattening.report;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_FLATTEN_H
