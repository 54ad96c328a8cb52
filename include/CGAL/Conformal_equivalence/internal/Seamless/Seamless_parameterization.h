// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// One seamless parameterization of a mesh (section 6 of Springborn, Schroeder and Pinkall, 2008): the metric with its cones, its layout, and the
// layout rectified.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_SEAMLESS_PARAMETERIZATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_SEAMLESS_PARAMETERIZATION_H

#include <CGAL/Conformal_equivalence/Cone_placement.h>
#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Cones/report_cones.h>
#include <CGAL/Conformal_equivalence/internal/Doors/Flattening.h>
#include <CGAL/Conformal_equivalence/internal/Doors/Stages.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Dual_loops.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Handle_turner.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Quantized_cone.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Rectification.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Rectified_layout.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Texture_lattice.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/internal/solver_traits_of.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/place_cones.h>

#include <CGAL/number_utils.h>
#include <CGAL/use.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// What is asked of a seamless parameterization.
struct Seamless_options
{
  double angle_quantum = CGAL_PI / 2; // radians
  Rectification_options rectification;
};

// The turnings that are prescribed for closed chains of halfedges; those on a border, which have no number, make a chain that is refused.
template <typename TriangleMesh, typename NamedParameters>
std::vector<Prescribed_turning> read_loop_turnings(const Imported_mesh<TriangleMesh>& mesh, const NamedParameters& np)
{
  CGAL_USE(mesh);
  CGAL_USE(np);
  std::vector<Prescribed_turning> result;
  if constexpr(is_given<internal_np::conformal_loop_turnings_t, NamedParameters>)
    for(const auto& loop : parameters::get_parameter(np, internal_np::conformal_loop_turnings))
    {
      result.push_back({{}, long(loop.quanta)});
      for(const auto& h : loop.halfedges)
        result.back().chain.push_back(mesh.is_imported(h) ? mesh.index_of_halfedge(h) : Dual_loops::null_index);
    }
  return result;
}

// One seamless parameterization: the metric with its cones, its layout, and the layout rectified.
template <typename TriangleMesh>
class Seamless_parameterization
{
  typedef std::uint32_t Index;
  typedef Flattening_report<TriangleMesh> Report;

public:
  Flattening<TriangleMesh> flattening;

  // `since`: begun before the mesh was imported
  Seamless_parameterization(Imported_mesh<TriangleMesh> mesh, const Stopwatch& since, const Seamless_options& options)
    : flattening(std::move(mesh), since), options_(options)
  {}

  template <typename NamedParameters>
  void run(const NamedParameters& np)
  {
    find_cut_metric(np);
    flattening.lay_out(); // what is judged is the layout that is rectified
    flattening.tell_what_was_found();
    if(!bool(flattening.report))
      return;
    const std::vector<Quantized_cone> cones = quantized_cones();
    take(rectified(flattening.mesh.triangulation, flattening.cut, flattening.layout, cones, np));
    finish();
  }

  // ---- Steps

  // The metric, and the cut.
  template <typename NamedParameters>
  void find_cut_metric(const NamedParameters& np)
  {
    flattening.import_lengths(np);
    run_step(flattening.report, [&]
    {
      if(check())
        find_metric(np);
    });
    run_step(flattening.report, [&] { turn_handles(np); });
    flattening.find_cut();
  }

  std::vector<Quantized_cone> quantized_cones() const
  {
    const long unit = 2 * Exact_angle<double>::units_of_pi / symmetry();
    std::vector<Quantized_cone> result;
    for(Index v : flattening.cones())
      result.push_back({v, flattening.conditions().angle_sum(v).units / unit});
    return result;
  }

  // What becomes of a layout, of the mesh or of a refinement of it.
  template <typename NamedParameters>
  Rectified_layout rectified(const Intrinsic_triangulation<double>& t, const Cut_graph& cut, const Layout<double>& layout,
                             const std::vector<Quantized_cone>& cones, const NamedParameters& np)
  {
    Rectified_layout result;
    const Stopwatch stopwatch;
    try
    {
      Rectification<double> rectification(t, cut, layout, cones, Texture_lattice(symmetry()), options_.rectification,
                                          make_factorization(solver_traits_of(np)));
      result = std::move(rectification.run());
    }
    catch(const std::bad_alloc&)
    {
      result = Rectified_layout();
      result.status = Status::OUT_OF_MEMORY;
    }
    flattening.report.statistics.seconds.layout += stopwatch.seconds();
    return result;
  }

  // Tells what became of the placement of cones.
  void finish()
  {
    Report& report = flattening.report;
    if(are_cones_placed_)
      report_rounding(flattening.mesh, placement_, report);
    if(bool(report) && placement_.status == Status::BOUND_NOT_MET)
    {
      report.status = placement_.status;
      report.amount = placement_.amount;
    }
  }

private:
  // Cones place themselves unless they, or the angles of borders, are given.
  template <typename NamedParameters>
  static constexpr bool do_cones_place_themselves()
  {
    return !is_given<internal_np::conformal_cone_angle_t, NamedParameters>
        && !is_given<internal_np::conformal_border_angle_t, NamedParameters>
        && (is_given<internal_np::conformal_number_of_cones_t, NamedParameters>
            || is_given<internal_np::conformal_maximum_u_t, NamedParameters>
            || is_given<internal_np::conformal_maximum_area_distortion_t, NamedParameters>);
  }

  // ---- What can be asked for

  // n of the quantum 2 pi / n; 0 if there is no such lattice
  int symmetry() const
  {
    const double n = 2 * CGAL_PI / options_.angle_quantum, nearest = std::round(n);
    return std::abs(n - nearest) < 1e-6 && nearest < 10 && Texture_lattice::exists(long(nearest)) ? int(nearest) : 0;
  }

  bool check()
  {
    Report& report = flattening.report;
    if(report.topology.number_of_components != 1)
      report.status = Status::WRONG_TOPOLOGY;
    else if(symmetry() == 0)
    {
      report.status = Status::ANGLE_OUT_OF_RANGE;
      report.amount = options_.angle_quantum;
    }
    else if(!(options_.rectification.maximum_distortion >= 1))
      report.status = Status::INVALID_NUMBER;
    return bool(report);
  }

  // ---- Metric

  template <typename NamedParameters>
  void find_metric(const NamedParameters& np)
  {
    if constexpr(do_cones_place_themselves<NamedParameters>())
    {
      // where u is even, tiles fit nearly everywhere: fewer triangles are turned over
      Cone_options options = read_cone_options(np, Cone_measure::ROOT_MEAN_SQUARE_U);
      options.angle_quantum = options_.angle_quantum;
      take(place_cones_with(flattening.mesh.triangulation, options, np));
    }
    else
    {
      flattening.read_conditions(np);
      if(bool(flattening.report) && check_cones())
        flattening.solve(np);
    }
  }

  void take(Cone_placement<double> placement)
  {
    placement_ = std::move(placement);
    Conformal_conditions<double> conditions(flattening.mesh.triangulation);
    Conformal_metric<double> metric = std::move(placement_.metric);
    if(bool(placement_) || placement_.status == Status::BOUND_NOT_MET)
      for(std::size_t i = 0; i < placement_.cones.size(); ++i)
        conditions.prescribe_angle_sum(placement_.cones[i], placement_.angles[i]);
    else
    {
      metric.status = placement_.status;
      metric.amount = placement_.amount;
    }
    are_cones_placed_ = true;
    flattening.take_metric(std::move(metric), std::move(conditions));
  }

  // The cones given must have multiples of the quantum; those of free angle have none that is known.
  bool check_cones()
  {
    std::vector<Index> wrong;
    for(Index v : flattening.cones())
      if(flattening.conditions().is_fixed(v) || !is_multiple(flattening.conditions().angle_sum(v)))
        wrong.push_back(v);
    if(wrong.empty())
      return true;
    Report& report = flattening.report;
    report.status = Status::ANGLE_OUT_OF_RANGE;
    const Index v = wrong.front();
    report.amount = flattening.conditions().is_fixed(v) ? 0 : flattening.conditions().angle_sum(v).template radians<double>();
    name_elements(flattening.mesh, wrong, {}, {}, report);
    return false;
  }

  bool is_multiple(const Exact_angle<double>& angle) const
  {
    return angle.is_exact() && angle.units % (2 * Exact_angle<double>::units_of_pi / symmetry()) == 0;
  }

  // ---- Handles

  // In a conformal class the cones determine by how much handles turn, and all borders but one: where that is no multiple of the quantum, the class
  // is left.
  template <typename NamedParameters>
  void turn_handles(const NamedParameters& np)
  {
    Report& report = flattening.report;
    const std::vector<Prescribed_turning> prescribed = read_loop_turnings(flattening.mesh, np);
    if(report.topology.number_of_borders != 0 && !prescribed.empty())
      report.status = Status::WRONG_TOPOLOGY;
    const bool has_loops = report.topology.genus != 0 || report.topology.number_of_borders > 1 || !prescribed.empty();
    if(!bool(report) || !has_loops || !can_borders_turn())
      return;
    const Stopwatch stopwatch;
    try
    {
      const std::vector<Quantized_cone> cones = quantized_cones();
      const Handle_turner<double> turner(flattening.mesh.triangulation, flattening.metric, flattening.conditions(), cones, symmetry(), prescribed,
                                         read_solver_options(flattening.mesh, np), [&] { return make_factorization(solver_traits_of(np)); });
      Turned_handles handles = turner.choose();
      if(bool(handles))
        take(turner.turn(handles));
      report_handles(handles);
    }
    catch(const std::bad_alloc&)
    {
      report.status = Status::OUT_OF_MEMORY;
    }
    report.statistics.seconds.solve += stopwatch.seconds();
  }

  // Not where the metric is one of the double, or has vertices with bounds; nor where the angles prescribed make a border turn by no multiple: then
  // the layout is refused for that.
  bool can_borders_turn() const
  {
    const Intrinsic_triangulation<double>& t = flattening.mesh.triangulation;
    std::vector<char> is_visited(t.number_of_halfedges(), 0);
    bool result = !flattening.metric.is_doubled && !flattening.conditions().has_bounds();
    for(Index h = 0; h < t.number_of_halfedges() && result; ++h)
      if(t.is_border(h) && !is_visited[h])
        result = can_border_turn(h, is_visited);
    return result;
  }

  // Of the border that begins with a halfedge: vertices where u is prescribed are free to bend.
  bool can_border_turn(Index first, std::vector<char>& is_visited) const
  {
    const Intrinsic_triangulation<double>& t = flattening.mesh.triangulation;
    const Conformal_conditions<double>& conditions = flattening.conditions();
    const double quantum = 2 * CGAL_PI / symmetry(), rounding = 1e-9;
    double turning = 0;
    bool is_free = false;
    for(Index h = first; !is_visited[h]; h = t.next_on_border(h))
    {
      is_visited[h] = 1;
      const Index v = t.target(h);
      if(conditions.is_fixed(v))
        is_free = true;
      else
        turning += CGAL_PI - conditions.angle_sum(v).template radians<double>();
    }
    return is_free || std::abs(std::remainder(turning, quantum)) < rounding;
  }

  void take(Conformal_metric<double> turned)
  {
    if(!bool(turned))
      return;
    const Statistics before = flattening.metric.statistics;
    turned.statistics += before;
    turned.statistics.number_of_flips = turned.flips.size();
    flattening.metric = std::move(turned);
    flattening.report.statistics = flattening.metric.statistics;
  }

  void report_handles(const Turned_handles& handles)
  {
    Report& report = flattening.report;
    if(!bool(handles))
      report_outcome(flattening.mesh, handles, report);
    Handle_turning<TriangleMesh>& result = report.handles;
    for(std::size_t i = 0; i < handles.loops.size(); ++i)
    {
      result.loops.push_back({{}, handles.conformal_turnings[i], handles.quanta.empty() ? 0 : handles.quanta[i]});
      for(Index h : handles.loops[i])
        result.loops.back().halfedges.push_back(flattening.mesh.halfedge(h));
    }
    result.is_nearest = handles.is_nearest;
    result.existence = handles.existence;
    result.mean_departure = handles.mean_departure;
    result.maximum_departure = handles.largest_departure;
    result.residual = handles.residual;
    result.number_of_steps = handles.number_of_steps;
    result.number_of_flips = handles.number_of_flips;
  }

  // ---- Rectification

  void take(Rectified_layout rectified)
  {
    Report& report = flattening.report;
    if(rectified.status != Status::OK)
    {
      report.status = rectified.status;
      report.amount = rectified.amount;
      name_elements(flattening.mesh, {}, rectified.edges, rectified.faces, report);
      if(rectified.status != Status::BOUND_NOT_MET)
        return;
    }
    report.tiling = rectified.tiling;
    for(std::size_t i = 0; i < report.cones.size(); ++i)
      report.cones[i].lattice_point = rectified.cone_positions[i];
    for(std::size_t i = 0; i < report.transitions.size(); ++i)
    {
      const Transition<double>& exact = rectified.layout.transitions[i];
      report.transitions[i].rotation = exact.rotation;
      report.transitions[i].translation = exact.translation;
      report.transitions[i].quanta = rectified.quanta[i];
      report.transitions[i].lattice_translation = rectified.translations[i];
    }
    report.lattices.clear();
    flattening.layout = std::move(rectified.layout);
  }

  const Seamless_options options_;
  Cone_placement<double> placement_;
  bool are_cones_placed_ = false;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_SEAMLESS_PARAMETERIZATION_H
