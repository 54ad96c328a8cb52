// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The engine of `flatten_repaired()`: as `Flattening`, but the metric is found by `repair_locally()`, and the triangulation that this has
// changed is cut and laid out.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_REPAIRED_FLATTENING_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_REPAIRED_FLATTENING_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/Repaired_metric.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Doors/Flattening.h>
#include <CGAL/Conformal_equivalence/internal/Doors/Stages.h>
#include <CGAL/Conformal_equivalence/internal/Doors/indexed_parameters.h>
#include <CGAL/Conformal_equivalence/internal/Any_visitor.h>
#include <CGAL/Conformal_equivalence/internal/Layout/lay_out_pieces.h>
#include <CGAL/Conformal_equivalence/internal/Layout/layout_frames.h>
#include <CGAL/Conformal_equivalence/internal/Repair/Local_repair.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/pieces.h>
#include <CGAL/Conformal_equivalence/internal/solver_traits_of.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The steps one after the other, each done only if all went well before.
template <typename TriangleMesh>
class Repaired_flattening
{
public:
  typedef std::uint32_t Index;

  Imported_mesh<TriangleMesh> mesh;
  Repaired_metric<double> repaired;
  Cut_graph cut;
  Layout<double> layout;
  Flattening_report<TriangleMesh> report;

  explicit Repaired_flattening(const TriangleMesh& tm) : mesh(tm) {}

  template <typename NamedParameters>
  void run(const NamedParameters& np)
  {
    visitor_ = visitor_of(np);
    read(np);
    repair(np);
    stage(Stage::CUT, [&] { find_cut(); });
    stage(Stage::LAYOUT, [&] { lay_out(); });
    stage(Stage::VERIFY, [&] { verify(); });
    run_step(report, [&] { tell_what_was_found(); });
  }

private:
  template <typename Work>
  void stage(Stage stage, Work work) { run_stage(stage, visitor_, report, work); }

  // Lengths, conditions, and where to cut.
  template <typename NamedParameters>
  void read(const NamedParameters& np)
  {
    const Stopwatch stopwatch;
    run_step(report, [&]
    {
      set_lengths(mesh, np);
      report = import_report(mesh);
      if(!bool(report))
        return;
      conditions_ = read_conditions_or_name(mesh, np, report);
      cones_ = interior_cones(mesh.triangulation, conditions_);
      seam_options_.is_seam = values_at_edges<char>(mesh, internal_np::conformal_edge_is_seam, np);
      seam_options_.is_constrained = values_at_edges<char>(mesh, internal_np::edge_is_constrained, np);
      frame_ = read_frame(mesh, np);
    });
    report.statistics.seconds.import = stopwatch.seconds();
  }

  // ---- Metric

  // Edges that are to be seam edges, or must not be, are not flipped.
  template <typename NamedParameters>
  void repair(const NamedParameters& np)
  {
    const std::size_t budget = parameters::choose_parameter(parameters::get_parameter(np, internal_np::conformal_number_of_changes),
                                                            default_number_of_changes(mesh.triangulation));
    run_step(report, [&]
    {
      std::vector<char> is_kept(mesh.triangulation.number_of_edges(), 0);
      for(const std::vector<char>* marks : {&seam_options_.is_seam, &seam_options_.is_constrained})
        for(std::size_t e = 0; e < marks->size(); ++e)
          is_kept[e] |= (*marks)[e];
      Solver_options options = read_solver_options(mesh, np);
      options.visitor = visitor_;
      repaired = Local_repair<double, Solver_traits_of<NamedParameters> >(
        mesh.triangulation, conditions_, std::move(is_kept), budget, std::move(options), solver_traits_of(np)).run();
      report_metric();
    });
  }

  void report_metric()
  {
    const double seconds = report.statistics.seconds.import;
    report.statistics = repaired.metric.statistics;
    report.statistics.seconds.import = seconds;
    if(repaired.changes.empty())
      report_outcome(mesh, repaired.metric, report);
    else
      report_outcome(mesh, repaired.metric, repaired.triangulation(), report);
  }

  // ---- Cut and layout

  // What is said of edges of the mesh holds for their parts.
  std::vector<char> marks_of_parts(const std::vector<char>& marks) const
  {
    std::vector<char> result;
    if(marks.empty())
      return result;
    for(const Index input : repaired.input_edges)
      result.push_back(input != mesh.triangulation.null_index && marks[input]);
    return result;
  }

  void find_cut()
  {
    if(report.topology.is_disk() && cones_.empty() && !seam_options_.has_seam())
      return; // nothing to do
    const Intrinsic_triangulation<double>& t = repaired.triangulation();
    cut = find_cut_graph(t, cones_, Seam_options<double>{marks_of_parts(seam_options_.is_seam),
                                                         marks_of_parts(seam_options_.is_constrained), {}});
    if(bool(cut))
      return;
    Outcome outcome = cut.outcome(); // the ends of edges, which may be none of the mesh
    for(const Index e : cut.edges)
    {
      outcome.vertices.push_back(t.origin(t.edge_halfedge(e)));
      outcome.vertices.push_back(t.target(t.edge_halfedge(e)));
    }
    report_outcome(mesh, outcome, t, report);
  }

  void lay_out()
  {
    layout = internal::lay_out(repaired.triangulation(), repaired.metric, cut, frame_, [](const Piece&) { return true; });
    report.layout_length_error = layout.length_error;
  }

  // Every triangle of the layout, as rounded, is exactly positive, or its vertices are named.
  void verify()
  {
    Outcome outcome;
    for(Index f = 0; f < repaired.triangulation().number_of_faces(); ++f)
      if(!is_positive_triangle(layout, f))
        outcome.faces.push_back(f);
    if(outcome.faces.empty())
      return;
    outcome.status = Status::NOT_INJECTIVE;
    outcome.amount = report.amount;
    report_outcome(mesh, outcome, repaired.triangulation(), report);
  }

  void tell_what_was_found()
  {
    report_cones_of_metric(mesh, cones_, conditions_, repaired.metric, report);
    report.lattices.assign(layout.lattices.begin(), layout.lattices.end());
  }

  Any_visitor visitor_;
  Seam_options<double> seam_options_;
  Any_frame frame_ = Layout_frame::CANONICAL;
  Conformal_conditions<double> conditions_;
  std::vector<Index> cones_; // in increasing order
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_DOORS_REPAIRED_FLATTENING_H
