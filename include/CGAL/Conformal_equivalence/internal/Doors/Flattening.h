// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The engine of `flatten()` and of the doors beside it: lengths, conditions, metric, cut, layout, verdict, one after the other
// (sections 3 to 5 of Springborn, Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_FLATTENING_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_FLATTENING_H

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/compute_common_refinement.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/internal/Doors/Stages.h>
#include <CGAL/Conformal_equivalence/internal/Doors/indexed_parameters.h>
#include <CGAL/Conformal_equivalence/internal/Layout/cut_open.h>
#include <CGAL/Conformal_equivalence/internal/Layout/lay_out_pieces.h>
#include <CGAL/Conformal_equivalence/internal/Layout/layout_frames.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Cell_verdict.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/resolve_degenerate_faces.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/pieces.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>
#include <CGAL/Conformal_equivalence/internal/solver_traits_of.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <CGAL/use.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Is the straight triangle `f` positive as it was rounded? Exactly for `double`; for other numbers `true` only if that is certain.
template <typename NT>
bool is_positive_triangle(const Layout<NT>& layout, std::uint32_t f)
{
  return is_left_turn(layout.corner[3 * f], layout.corner[3 * f + 1], layout.corner[3 * f + 2]);
}

// Tells the report the cones of a metric that was found, in the order of their numbers.
template <typename TriangleMesh, typename NT>
void report_cones_of_metric(const Imported_mesh<TriangleMesh, NT>& mesh, const std::vector<std::uint32_t>& cones,
                            const Conformal_conditions<NT>& conditions, const Conformal_metric<NT>& metric,
                            Flattening_report<TriangleMesh>& report)
{
  for(std::uint32_t v : cones)
  {
    const bool is_free = conditions.is_fixed(v);
    report.cones.push_back({mesh.vertex(v), mesh.index_of_vertex(mesh.vertex(v)),
                            is_free ? angle_sum_at(metric, v) : conditions.angle_sum(v).template radians<double>(), is_free});
  }
}

// One flattening. The steps can be done one by one, too: each finds a value that the next one takes, and is done only if all
// went well before; what the user gets is written by the caller from `metric`, `cut` and `layout`.
template <typename TriangleMesh, typename NT = double>
class Flattening
{
public:
  typedef std::uint32_t Index;

  Imported_mesh<TriangleMesh, NT> mesh;
  Conformal_metric<NT> metric;
  Cut_graph cut;
  Layout<NT> layout;
  Common_refinement<NT> refinement; // empty unless asked for
  Flattening_report<TriangleMesh> report;

  // `since`: begun before the mesh was imported
  Flattening(Imported_mesh<TriangleMesh, NT> imported, const Stopwatch& since) : mesh(std::move(imported))
  {
    report.statistics.seconds.import = since.seconds();
  }

  const Conformal_conditions<NT>& conditions() const { return conditions_; }
  const std::vector<Index>& cones() const { return cones_; }

  // ---- The whole way

  // The whole surface, each triangle of which is to be positive.
  template <typename NamedParameters>
  void run(const NamedParameters& np)
  {
    import_lengths(np);
    read_conditions(np);
    solve(np);
    find_cut();
    lay_out();
    verify();
    tell_what_was_found();
  }

  // The same with the common refinement, on which the verdict is then. Without flips the mesh is its own refinement, and none is made
  // unless `is_always_made`.
  template <typename NamedParameters>
  void run_with_refinement(const NamedParameters& np, bool is_always_made)
  {
    import_lengths(np);
    read_conditions(np);
    solve(np);
    find_cut();
    lay_out_with_refinement(is_always_made);
    verify();
    tell_what_was_found();
  }

  // The same where the cut is given, and only the piece to which `face` belongs is laid out. It must be a disk, with all cones
  // on its border; `no_disk` says so if not.
  template <typename NamedParameters>
  void run_along(Cut_graph given_cut, Index face, Status no_disk, const NamedParameters& np)
  {
    import_lengths(np);
    read_conditions(np);
    take_cut(std::move(given_cut), face, no_disk);
    solve(np);
    find_cut();
    lay_out_piece(face);
    verify();
    tell_what_was_found();
  }

  // ---- Steps

  // Lengths, and options for what follows.
  template <typename NamedParameters>
  void import_lengths(const NamedParameters& np)
  {
    options_.visitor = visitor_of(np);
    stage(Stage::IMPORT, [&]
    {
      set_lengths(mesh, np);
      const Statistics statistics = report.statistics;
      report = import_report(mesh);
      report.statistics = statistics;
      if(!bool(report))
        return;
      seam_options_ = read_seam_options(mesh, np);
      frame_ = read_frame(mesh, np);
    });
  }

  template <typename NamedParameters>
  void read_conditions(const NamedParameters& np)
  {
    step([&]
    {
      conditions_ = read_conditions_or_name(mesh, np, report);
      cones_ = interior_cones(mesh.triangulation, conditions_);
    });
  }

  // The metric with these conditions.
  template <typename NamedParameters>
  void solve(const NamedParameters& np)
  {
    step([&]
    {
      const Any_visitor visitor = options_.visitor;
      options_ = read_solver_options(mesh, np);
      options_.visitor = visitor;
      solve(solver_traits_of(np), options_);
    });
  }

  // The metric, found with these conditions.
  void take_metric(Conformal_metric<NT> found, Conformal_conditions<NT> conditions)
  {
    step([&]
    {
      conditions_ = std::move(conditions);
      cones_ = interior_cones(mesh.triangulation, conditions_);
      metric = std::move(found);
      report_metric();
    });
  }

  // The cut that is given, if the piece that it leaves at `face` is a disk with all cones on its border.
  void take_cut(Cut_graph given, Index face, Status no_disk)
  {
    step([&]
    {
      cut = std::move(given);
      has_given_cut_ = true;
      check_cut(face, no_disk);
    });
  }

  void find_cut()
  {
    stage(Stage::CUT, [&]
    {
      const bool is_uncut = report.topology.is_disk() && cones_.empty() && !seam_options_.has_seam();
      if(has_given_cut_ || is_uncut)
        return; // nothing to do
      cut = find_cut_graph(mesh.triangulation, cones_, std::move(seam_options_));
      if(!bool(cut))
        report_outcome(mesh, cut, report);
    });
  }

  void lay_out() { stage(Stage::LAYOUT, [&] { lay_out_all_pieces(); }); }

  void lay_out_with_refinement(bool is_always_made)
  {
    stage(Stage::LAYOUT, [&]
    {
      lay_out_all_pieces();
      if(metric.is_retriangulated() || is_always_made)
        refine();
    });
  }

  // Only the piece to which `face` belongs.
  void lay_out_piece(Index face)
  {
    stage(Stage::LAYOUT, [&]
    {
      lay_out_pieces([&](const Piece& piece)
      {
        const bool is_wanted = std::binary_search(piece.faces.begin(), piece.faces.end(), face);
        if(is_wanted)
          faces_laid_out_ = piece.faces;
        return is_wanted;
      });
    });
  }

  // Every triangle is positive, or named; if there is a refinement, every part of a triangle.
  void verify()
  {
    stage(Stage::VERIFY, [&]
    {
      std::vector<Index> flipped = flipped_triangles();
      if(metric.statistics.number_of_resolving_flips != 0)
        for(Index f : take_degenerate_faces(mesh.triangulation, flipped))
          report.flat_faces.push_back(mesh.face(f));
      if(refinement.number_of_faces() == 0)
        return refuse_flipped(flipped);
      judge(refinement);
      for(Index f : flipped)
        report.bent_faces.push_back(mesh.face(f));
    });
  }

  // Names the triangles with parts that are not exactly positive, as rounded.
  void judge(const Common_refinement<NT>& parts) { refuse_flipped(input_faces_lost(parts)); }

  // Cones, motions across the seam, lattices, border edges that were lost.
  void tell_what_was_found()
  {
    step([&]
    {
      for(Index e : metric.lost_border_edges)
        report.lost_border_edges.push_back(mesh.edge(e));
      report_cones_of_metric(mesh, cones_, conditions_, metric, report);
      for(const Transition<NT>& motion : layout.transitions)
        report.transitions.push_back({mesh.halfedge(motion.halfedge), rounded(motion.rotation), rounded(motion.translation)});
      for(const Period_lattice<NT>& lattice : layout.lattices)
        report.lattices.push_back({mesh.position_of_face(Index(lattice.face)),
                                   {{rounded(lattice.periods[0]), rounded(lattice.periods[1])}}, rounded(lattice.tau)});
    });
  }

private:
  template <typename Work>
  void step(Work work) { run_step(report, work); }

  template <typename Work>
  void stage(Stage stage, Work work) { run_stage(stage, options_.visitor, report, work); }

  // ---- Metric

  template <typename SolverTraits>
  void solve(const SolverTraits& traits, const Solver_options& options)
  {
    {
      Conformal_metric_solver<NT, SolverTraits> solver(std::move(mesh.triangulation), traits);
      metric = std::move(solver).solve(conditions_, options);
      if(metric.is_retriangulated())
        mesh.triangulation = solver.triangulation();
    }
    if(!metric.is_retriangulated())
      mesh.triangulation = metric.triangulation; // copied only now: the solver has freed its memory
    report_metric();
  }

  void report_metric()
  {
    const double seconds = report.statistics.seconds.import;
    report.statistics = metric.statistics;
    report.statistics.seconds.import = seconds;
    if(metric.is_retriangulated()) // its faces are not those of the mesh
      report_outcome(mesh, metric, metric.triangulation, report);
    else
      report_outcome(mesh, metric, report);
  }

  // ---- Cut

  void check_cut(Index face, Status no_disk)
  {
    const Intrinsic_triangulation<NT> open = cut_open(mesh.triangulation, cut);
    const Surface_components pieces = connected_components(open);
    const Index piece = pieces.component_of_vertex[open.origin(open.halfedge(face))];
    if(!pieces.components[piece].is_disk())
      refuse_cut(open, pieces, piece, no_disk);
    else
      refuse_missed_cones(open, pieces, piece);
  }

  // Names the seam at a piece that is no disk.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  void refuse_cut(const Intrinsic_triangulation<NT>& open, const Surface_components& pieces, Index piece, Status no_disk)
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    const auto is_at_piece = [&](Index h) { return pieces.component_of_vertex[open.origin(h)] == piece; };
    std::vector<Index> seam;
    for(Index e = 0; e < t.number_of_edges(); ++e)
      if(cut[e] && (is_at_piece(t.edge_halfedge(e)) || is_at_piece(t.twin(t.edge_halfedge(e)))))
        seam.push_back(e);
    report.status = no_disk;
    report.topology = surface_topology(pieces.components[piece]);
    name_elements(mesh, {}, seam, {}, report);
  }

  // Names the cones inside of a piece.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  void refuse_missed_cones(const Intrinsic_triangulation<NT>& open, const Surface_components& pieces, Index piece)
  {
    std::vector<Index> missed;
    for(Index v : cones_)
    {
      const Index copy = open.origin(mesh.triangulation.vertex_halfedge(v));
      if(pieces.component_of_vertex[copy] == piece && !open.is_border_vertex(copy))
        missed.push_back(v);
    }
    if(missed.empty())
      return;
    report.status = Status::SEAM_MISSES_CONE;
    name_elements(mesh, missed, {}, {}, report);
  }

  // ---- Layout

  void lay_out_pieces(const Is_wanted& is_wanted)
  {
    layout = internal::lay_out(mesh.triangulation, metric, cut, frame_, is_wanted);
    report.layout_length_error = layout.length_error;
  }

  void lay_out_all_pieces()
  {
    lay_out_pieces([](const Piece&) { return true; });
    faces_laid_out_.resize(mesh.triangulation.number_of_faces());
    std::iota(faces_laid_out_.begin(), faces_laid_out_.end(), Index(0));
  }

  // The overlay, with the corners of the mesh where they are in `layout`.
  void refine()
  {
    refinement = compute_common_refinement(mesh.triangulation, metric, cut, default_maximum_number_of_crossings,
                                           parameters::layout_frame(frame_));
    if(!bool(refinement))
      report_outcome(mesh, refinement, report);
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

  static std::array<double, 2> rounded(const std::array<NT, 2>& z) { return {{static_cast<double>(z[0]), static_cast<double>(z[1])}}; }

  Solver_options options_;
  Seam_options<NT> seam_options_;
  Any_frame frame_ = Layout_frame::CANONICAL;
  Conformal_conditions<NT> conditions_;
  std::vector<Index> cones_;           // in increasing order
  std::vector<Index> faces_laid_out_;
  bool has_given_cut_ = false;
};

// The faces of `tm`, in charts if there is a map of patches: edges between different patches become borders.
template <typename NT = double, typename TriangleMesh, typename NamedParameters>
Imported_mesh<TriangleMesh, NT> import_charts(const TriangleMesh& tm, const NamedParameters& np)
{
  CGAL_USE(np);
  if constexpr(!is_given<internal_np::face_patch_t, NamedParameters>)
    return Imported_mesh<TriangleMesh, NT>(tm);
  else
  {
    const auto patch = parameters::get_parameter(np, internal_np::face_patch);
    const auto is_between_charts = [&](typename boost::graph_traits<TriangleMesh>::edge_descriptor e)
      { return !(get(patch, face(halfedge(e, tm), tm)) == get(patch, face(opposite(halfedge(e, tm), tm), tm))); };
    return Imported_mesh<TriangleMesh, NT>(tm, faces(tm), is_between_charts);
  }
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_FLATTENING_H
