// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file place_cones.h
/// Cones that place themselves (section 5.1 of Springborn, Schroeder and Pinkall, 2008): where the scale is most distorted, a vertex is
/// given up to have any angle; then all cones are moved until that helps no more. Their angles may be rounded to multiples of 2 pi / n (section 6), as
/// textures and meshes of quadrangles ask for.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_PLACE_CONES_H
#define CGAL_CONFORMAL_EQUIVALENCE_PLACE_CONES_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Cone_search.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceSolver
///
/// The cones that were placed, and the metric with them.
template <typename NT_ = double>
struct Cone_placement
{
  typedef NT_ NT;              ///< number type of the lengths
  typedef std::uint32_t Index; ///< of vertices

  std::vector<Index> cones;                ///< in ascending order
  std::vector<Exact_angle<NT> > angles;    ///< by cone: the angle sum, exactly if it was rounded to a multiple
  std::vector<double> free_angles;         ///< by cone: what it was before it was rounded, when all cones were free (radians, up to 1e-6)
  bool is_rounded = false;                 ///< whether angles were rounded
  std::vector<Index> flattened;            ///< cones whose angles were rounded to 2 pi: they are none any more

  Conformal_metric<NT> metric;             ///< with these angle sums, and u = 0 on borders
  double maximum_log_scale_factor = 0;     ///< the largest |u| of `metric`

  /// the largest factor, or its inverse, by which `metric` scales areas relative to the total area: of its triangles; where edges were flipped, of the
  /// surroundings of vertices, e^{2u}. 1 if there is no metric
  double area_distortion = 1;
  std::size_t number_of_sweeps = 0;        ///< of the concurrent optimization
  std::size_t number_of_moves = 0;         ///< of single cones to vertices nearby that made it better
  std::size_t number_of_solves = 0;        ///< linear systems solved with the one factor

  Status status = Status::OK;              ///< whether the cones could be placed, or why not
  double amount = 0;                       ///< see `Status`

  /// is `true` iff there is a placement that is as asked for.
  explicit operator bool() const { return is_success(status); }
};

namespace internal {

struct Cone_options
{
  std::size_t number_of_cones = 0; // 0: not given
  double maximum_u = 0;            // 0: not given
  double maximum_area_distortion = 0; // 0: not given
  double angle_quantum = 0;        // 0: none
  Cone_measure measure = Cone_measure::MAXIMUM_U;
  std::size_t number_of_sweeps = 10;
};

template <typename NT, typename NamedParameters>
class Cone_placer
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;
  typedef typename internal_np::Lookup_named_param_def<internal_np::sparse_linear_solver_t, NamedParameters,
                                                       Default_solver_traits>::type Solver_traits;
  typedef Cone_search<NT, Solver_traits> Search;

public:
  Cone_placer(const Triangulation& t, const Cone_options& options, const NamedParameters& np)
    : t_(t), options_(options), np_(np), pieces_(connected_components(t))
  {}

  Cone_placement<NT> operator()()
  {
    if(!check())
      return std::move(result_);
    Search search(t_, pieces_.components[0], traits(), options_.measure);
    if(!check_number(search))
      return std::move(result_);
    if(!search.factorize())
    {
      refuse(Status::SINGULAR_PROBLEM);
      return std::move(result_);
    }
    Placement p = search.without_cones(Vertex_vector(t_.number_of_vertices(), 0.));
    if(!search.relax(p, 20) || p.error > 1e-2)
      p = search.without_cones(first_u());
    place_greedily(search, p);
    p = optimized(search, std::move(p));
    p = moved(search, p);
    std::sort(p.cones.begin(), p.cones.end());
    result_.cones = p.cones;
    if(options_.angle_quantum > 0)
      quantize(search, std::move(p));
    else
    {
      solve(p);
      if(is_success(result_.metric.status))
        take_angles(free_angles());
    }
    result_.number_of_solves = search.number_of_solves();
    finish();
    return std::move(result_);
  }

private:
  static constexpr std::size_t most_cones_for_bound = 256;

  // Copies of solver traits may share one factor (those of Eigen_solver_traits do). The factor of the search must not be replaced by those of the
  // metrics that are solved for meanwhile.
  Solver_traits traits() const
  {
    if constexpr(std::is_default_constructible<Solver_traits>::value)
      return Solver_traits();
    else
      return parameters::get_parameter(np_, internal_np::sparse_linear_solver);
  }

  void refuse(Status status, double amount = 0)
  {
    result_.status = status;
    result_.amount = amount;
  }

  // ---- What can be asked for

  bool check()
  {
    if(t_.number_of_faces() == 0)
      result_.status = Status::EMPTY_MESH;
    else if(pieces_.components.size() != 1)
      result_.status = Status::WRONG_TOPOLOGY;
    else if(options_.number_of_cones == 0 && !has_bound())
      result_.status = Status::MISSING_CONDITION;
    return result_.status == Status::OK;
  }

  bool has_bound() const { return options_.maximum_u > 0 || options_.maximum_area_distortion > 0; }
  bool is_sphere() const { return number_of_borders() == 0 && pieces_.components[0].euler_characteristic() > 0; }
  std::size_t number_of_borders() const { return pieces_.components[0].number_of_borders; }

  bool check_number(const Search& search)
  {
    const std::size_t n = search.candidates().size();
    if(options_.number_of_cones > n || (is_sphere() && n < 3))
      refuse(Status::TOO_MANY_CONES, double(n));
    else if(is_sphere() && options_.number_of_cones > 0 && options_.number_of_cones < 3)
      refuse(Status::MISSING_CONDITION, 4 * Number_constants<double>::pi());
    else if(options_.angle_quantum > 0 && quanta_of_turn() == 0)
      refuse(Status::ANGLE_OUT_OF_RANGE, options_.angle_quantum);
    else
      return true;
    return false;
  }

  // n of the quantum 2 pi / n; 0 if it is none
  long quanta_of_turn() const
  {
    const double n = 2 * Number_constants<double>::pi() / options_.angle_quantum, nearest = std::round(n);
    return nearest >= 1 && nearest <= 2520 && std::abs(n - nearest) < 1e-6 ? long(nearest) : 0;
  }

  // ---- Metrics

  Conformal_conditions<NT> natural_conditions() const { return Conformal_conditions<NT>(t_); }

  // Without a cone; the curvature of a closed surface is spread equally.
  Vertex_vector first_u() const
  {
    Conformal_conditions<NT> conditions = natural_conditions();
    if(number_of_borders() == 0)
    {
      const Surface_components::Component& c = pieces_.components[0];
      const double pi = Number_constants<double>::pi(), angle = 2 * pi - 2 * pi * double(c.euler_characteristic()) / double(c.number_of_vertices);
      for(Index v = 0; v < t_.number_of_vertices(); ++v)
        if(!t_.is_isolated_vertex(v))
          conditions.prescribe_angle_sum(v, NT(angle));
    }
    const Conformal_metric<NT> metric = compute_conformal_metric(t_, conditions, Conformal_equivalence::combine_named_parameters(
      np_, parameters::gradient_tolerance(1e-4)));
    Vertex_vector u(t_.number_of_vertices(), 0.);
    for(std::size_t v = 0; v < u.size() && v < metric.log_scale_factors.size(); ++v)
      u[v] = static_cast<double>(metric.log_scale_factors[v]);
    return u;
  }

  // With the cones of the result: free, or with the angles given. Begins with what the search has found, if it has found something.
  void solve(const Placement& p, const std::vector<Exact_angle<NT> >& angles = std::vector<Exact_angle<NT> >())
  {
    Conformal_conditions<NT> conditions = natural_conditions();
    for(std::size_t i = 0; i < result_.cones.size(); ++i)
    {
      if(angles.empty())
        conditions.fix_log_scale_factor(result_.cones[i], NT(0));
      else
        conditions.prescribe_angle_sum(result_.cones[i], angles[i]);
    }
    const Vertex_vector u = p.error <= 0.1 ? p.u : Vertex_vector(p.u.size(), 0.);
    const auto initial_u = boost::make_iterator_property_map(u.begin(), boost::typed_identity_property_map<Index>());
    result_.metric = compute_conformal_metric(t_, conditions, Conformal_equivalence::combine_named_parameters(
      np_, parameters::initial_log_scale_factor_map(initial_u)));
    measure();
  }

  void measure()
  {
    result_.maximum_log_scale_factor = 0;
    for(const NT& u : result_.metric.log_scale_factors)
      result_.maximum_log_scale_factor = (std::max)(result_.maximum_log_scale_factor, std::abs(static_cast<double>(u)));
    if(is_success(result_.metric.status))
      result_.area_distortion = result_.metric.is_retriangulated() ? area_distortion_at_vertices() : area_distortion_of_faces();
  }

  // ---- Areas

  std::vector<double> log_areas() const
  {
    std::vector<double> result;
    for(Index h = 0; h < t_.number_of_halfedges(); h += 3)
      result.push_back(log_area(Incircle_form<NT>(t_.length(t_.edge(h)), t_.length(t_.edge(h + 1)), t_.length(t_.edge(h + 2)))));
    return result;
  }

  // of the triangles of the metric found
  std::vector<double> scaled_log_areas() const
  {
    const Conformal_metric<NT>& m = result_.metric;
    std::vector<double> result;
    for(Index f = 0; f < m.triangulation.number_of_faces(); ++f)
      result.push_back(log_area(wide_triangle(m.triangulation, m.scale_factors, f)));
    return result;
  }

  double area_distortion_of_faces() const
  {
    const std::vector<double> before = log_areas(), after = scaled_log_areas();
    return area_distortion(before, after, log_sum(before), log_sum(after));
  }

  // Where edges were flipped no triangle of the metric is one of the surface given. Near a vertex the metric is that of the surface, times e^{2u}.
  double area_distortion_at_vertices() const
  {
    std::vector<double> before, after;
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      if(!t_.is_isolated_vertex(v))
      {
        before.push_back(0);
        after.push_back(2 * static_cast<double>(result_.metric.log_scale_factors[v]));
      }
    const double number_of_copies = result_.metric.is_doubled ? 2 : 1;
    return area_distortion(before, after, log_sum(log_areas()), log_sum(scaled_log_areas()) - std::log(number_of_copies));
  }

  // The same for triangles scaled by these u, in `double`.
  double area_distortion_at(const Vertex_vector& u) const
  {
    const auto length = [&](Index h) { return std::exp((u[t_.origin(h)] + u[t_.target(h)]) / 2) * static_cast<double>(t_.length(t_.edge(h))); };
    const std::vector<double> before = log_areas();
    std::vector<double> after;
    for(Index h = 0; h < t_.number_of_halfedges(); h += 3)
      after.push_back(log_area(Incircle_form<double>(length(h), length(h + 1), length(h + 2))));
    return area_distortion(before, after, log_sum(before), log_sum(after));
  }

  // ---- Angles of free cones

  std::vector<double> free_angles() const
  {
    std::vector<double> result;
    for(Index c : result_.cones)
      result.push_back(angle_sum_at(result_.metric, c));
    return result;
  }

  void take_angles(const std::vector<double>& angles)
  {
    result_.free_angles = angles;
    for(double angle : angles)
    {
      Exact_angle<NT> exact;
      exact.rest = NT(angle);
      result_.angles.push_back(exact);
    }
  }

  // Before they are rounded: from the search, or, where that finds no metric, from the metric with free cones. Returns whether there are any.
  bool find_free_angles(Search& search, Placement& p)
  {
    const double close = 1e-6;
    if(search.relax(p, 30, close) && p.error <= close)
    {
      for(double curvature : search.curvatures(p))
        result_.free_angles.push_back(search.flat_angle(p) - curvature);
      return true;
    }
    solve(p);
    if(is_success(result_.metric.status))
      result_.free_angles = free_angles();
    return is_success(result_.metric.status);
  }

  void finish()
  {
    if(result_.status != Status::OK)
      return;
    result_.status = result_.metric.status;
    result_.amount = result_.metric.amount;
    if(!is_success(result_.status))
      return;
    if(options_.maximum_u > 0 && !(result_.maximum_log_scale_factor <= options_.maximum_u))
      refuse(Status::BOUND_NOT_MET, result_.maximum_log_scale_factor);
    else if(options_.maximum_area_distortion > 0 && !(result_.area_distortion <= options_.maximum_area_distortion))
      refuse(Status::BOUND_NOT_MET, result_.area_distortion);
  }

  // ---- Placement

  bool is_enough(const Placement& p) const
  {
    if(is_sphere() && p.cones.size() < 3)
      return false;
    if(options_.number_of_cones > 0 && p.cones.size() >= options_.number_of_cones)
      return true;
    return has_bound() && (!(options_.maximum_u > 0) || largest_entry(p.u) <= options_.maximum_u)
                       && (!(options_.maximum_area_distortion > 0) || area_distortion_at(p.u) <= options_.maximum_area_distortion);
  }

  // A cone where |u| is largest, again and again.
  void place_greedily(Search& search, Placement& p) const
  {
    const int steps = 3;
    while(!is_enough(p) && p.cones.size() < (std::min)(search.candidates().size(), options_.number_of_cones > 0 ? options_.number_of_cones
                                                                                                                : most_cones_for_bound))
    {
      if(!search.put_cone(p))
        return;
      search.relax(p, steps);
    }
  }

  // Nonlinear Gauss-Seidel: each cone in turn is taken out, and put where |u| is largest then. Keeps the best.
  Placement optimized(Search& search, Placement p)
  {
    Placement best = p;
    std::set<std::vector<Index> > seen = {sorted(p.cones)};
    for(std::size_t sweep = 0; sweep < options_.number_of_sweeps && p.cones.size() > 1; ++sweep)
    {
      ++result_.number_of_sweeps;
      const std::vector<Index> before = sorted(p.cones);
      for(std::size_t i = 0; i < before.size(); ++i)
      {
        search.take_cone(p, 0, search.curvatures(p)[0]); // the cone that has been there longest
        if(!search.put_cone(p))
          return best;
      }
      search.relax(p, 2);
      if(p.measure < best.measure && p.error <= (std::max)(best.error, 0.1))
        best = p;
      if(!seen.insert(sorted(p.cones)).second)
        break;
    }
    return best;
  }

  static std::vector<Index> sorted(std::vector<Index> cones)
  {
    std::sort(cones.begin(), cones.end());
    return cones;
  }

  // Moves single cones to vertices nearby, as long as that makes it better: always that which promises most. What is promised is exact to first order, but for vertices with a
  // large |u| that have not been looked at, and but for the new place itself: vertices that break a promise are looked at from then on,
  // and shorter moves are tried.
  Placement moved(Search& search, const Placement& first)
  {
    const std::size_t reach = (std::max)(std::size_t(2), std::size_t(std::sqrt(double(search.candidates().size())) / 6));
    const double gain = 5e-4;
    Placement p = first;
    std::set<std::pair<Index, Index> > tried;
    std::size_t number_of_moves = 0;
    search.watch(p);
    for(int failures = 0; reach >> (failures / 2) > 0; )
    {
      const Cone_move move = search.best_move(p, reach >> (failures / 2), tried);
      const double enough = (1 - gain) * p.measure;
      if(!(move.expected < enough))
        break;
      Placement trial = search.moved(p, move.cone, move.curvature, move.to);
      if(trial.measure < enough && search.relax(trial, 2, 1e-2, false) && trial.measure < enough)
      {
        p = std::move(trial);
        ++number_of_moves;
        tried.clear();
        failures = 0;
        search.watch(p);
      }
      else
      {
        tried.insert(std::make_pair(p.cones[move.cone], move.to));
        ++failures;
        search.watch(trial);
      }
    }
    if(number_of_moves == 0 || !search.relax(p, 6) || !(p.measure < first.measure))
      return first;
    result_.number_of_moves += number_of_moves;
    return p;
  }

  // ---- Multiples of an angle

  // Rounds the angles, takes out the cones that have become flat, and moves the others again.
  void quantize(Search& search, Placement p)
  {
    if(!find_free_angles(search, p))
      return;
    const long n = quanta_of_turn();
    const double quantum = 2 * Number_constants<double>::pi() / double(n);
    std::vector<double> x;
    for(double angle : result_.free_angles)
      x.push_back(angle / quantum);
    const long sum = number_of_borders() > 0 ? 0 : n * (long(x.size()) - long(pieces_.components[0].euler_characteristic()));
    const std::vector<long> k = number_of_borders() == 0 && sum <= 0 ? std::vector<long>() : nearest_integers(x, sum);
    if(k.empty() && !x.empty())
    {
      refuse(Status::NOT_QUANTIZABLE, double(sum) * quantum);
      return;
    }
    result_.is_rounded = true;
    Placement q;
    q.u = std::move(p.u);
    std::vector<std::pair<Index, std::size_t> > kept;
    for(std::size_t i = 0; i < k.size(); ++i)
    {
      if(k[i] == n)
        result_.flattened.push_back(result_.cones[i]);
      else
      {
        q.cones.push_back(result_.cones[i]);
        q.angles.push_back(double(k[i]) * quantum);
        kept.emplace_back(result_.cones[i], i);
      }
    }
    if(!q.cones.empty() && search.relax(q, 6))
      q = moved(search, q);
    std::vector<std::pair<Index, std::size_t> > order;
    for(std::size_t i = 0; i < kept.size(); ++i)
      order.emplace_back(q.cones[i], kept[i].second);
    std::sort(order.begin(), order.end());
    const std::vector<double> free_angles = std::move(result_.free_angles);
    result_.cones.clear();
    result_.angles.clear();
    result_.free_angles.clear();
    for(const auto& cone : order)
    {
      result_.cones.push_back(cone.first);
      result_.angles.push_back(multiple(k[cone.second], n));
      result_.free_angles.push_back(free_angles[cone.second]);
    }
    solve(q, result_.angles);
  }

  static Exact_angle<NT> multiple(long k, long n)
  {
    if(2 * Exact_angle<NT>::units_of_pi % n == 0)
    {
      Exact_angle<NT> result;
      result.units = std::int32_t(k * (2 * Exact_angle<NT>::units_of_pi / n));
      return result;
    }
    return Exact_angle<NT>(Number_constants<NT>::pi() * int(2 * k) / int(n));
  }

  const Triangulation& t_;
  const Cone_options options_;
  const NamedParameters& np_;
  const Surface_components pieces_;
  Cone_placement<NT> result_;
};

template <typename NamedParameters>
Cone_options cone_options(const NamedParameters& np)
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  Cone_options options;
  options.number_of_cones = choose_parameter(get_parameter(np, internal_np::conformal_number_of_cones), std::size_t(0));
  options.maximum_area_distortion = choose_parameter(get_parameter(np, internal_np::conformal_maximum_area_distortion), 0.);
  options.maximum_u = choose_parameter(get_parameter(np, internal_np::conformal_maximum_u), 0.);
  options.angle_quantum = choose_parameter(get_parameter(np, internal_np::conformal_angle_quantum), 0.);
  options.measure = choose_parameter(get_parameter(np, internal_np::conformal_cone_measure), Cone_measure::MAXIMUM_U);
  options.number_of_sweeps = choose_parameter(get_parameter(np, internal_np::conformal_number_of_sweeps), std::size_t(10));
  return options;
}

// What the cones of the report, those that were placed, were before their angles were rounded.
template <typename TriangleMesh>
void report_rounding(const Imported_mesh<TriangleMesh, double>& mesh, const Cone_placement<double>& placement, Flattening_report<TriangleMesh>& report)
{
  for(std::size_t i = 0; i < report.cones.size(); ++i)
    report.cones[i].free_angle = placement.free_angles[i];
  for(std::uint32_t v : placement.flattened)
    report.flattened_cones.push_back(mesh.vertex(v));
}

// What became of a placement: status, elements at fault, and the cones, if there are any. `report` is that of the import.
template <typename TriangleMesh>
void report_cones(const Imported_mesh<TriangleMesh, double>& mesh, const Cone_placement<double>& placement, Flattening_report<TriangleMesh>& report)
{
  const Conformal_metric<double>& metric = placement.metric;
  report.statistics = metric.statistics;
  report.status = placement.status;
  report.amount = placement.amount;
  if(!metric.is_retriangulated())
    name_elements(mesh, metric.vertices, {}, metric.faces, report);
  if(!bool(report) && report.status != Status::BOUND_NOT_MET)
    return;
  for(std::size_t i = 0; i < placement.cones.size(); ++i)
  {
    const auto v = mesh.vertex(placement.cones[i]);
    const Exact_angle<double>& angle = placement.angles[i];
    report.cones.push_back({v, mesh.index_of_vertex(v), angle.template radians<double>(), !placement.is_rounded});
  }
  report_rounding(mesh, placement, report);
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceSolver
///
/// places cones on a connected surface, and finds the metric with them. See `place_cones(tm, cone_angle_map, np)` for the method, the named parameters and statuses.
/// \pre no vertex is in `non_manifold_vertices(t)`
template <typename NT, typename NamedParameters = parameters::Default_named_parameters>
Cone_placement<NT> place_cones(const Intrinsic_triangulation<NT>& t, const NamedParameters& np = parameters::default_values())
{
  try
  {
    return internal::Cone_placer<NT, NamedParameters>(t, internal::cone_options(np), np)();
  }
  catch(const std::bad_alloc&)
  {
    Cone_placement<NT> nothing;
    nothing.status = Status::OUT_OF_MEMORY;
    return nothing;
  }
}

/// \ingroup PkgConformalEquivalenceDoors
///
/// places cones on a mesh, so that the flat metric with these cones distorts the scale less: |u| is to be small.
///
///  - *Greedily*: the vertex with the largest |u| becomes a free cone (u = 0, any angle), one after the other. On borders u = 0. A closed surface of a genus
///    other than 1 begins with its curvature spread equally over the vertices, a sphere until it has three cones.
///  - *Concurrently*: each cone in turn is taken out, and put where |u| is largest then, until the cones settle or come back to where they were; the
///    best placement seen is kept.
///  - *Locally*: single cones are moved to vertices nearby, always where most is gained, as long as that makes it better.
///  - *Rounded*, if there is an `angle_quantum`: the angles become positive multiples of it, with the least possible largest error among those which Gauss and Bonnet's formula
///    allows. A cone with the angle 2 pi is none any more. The others are moved locally again, now with these angles.
///
/// All of this uses one factorization; the metric with the cones found is then solved for to full precision.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam VertexAngleMap a model of `WritablePropertyMap` with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`
///
/// \param tm a triangle mesh: one component, of any topology
/// \param cone_angle_map receives the angle sums, in radians, of all vertices that are not on the border: those of the cones, and 2 pi
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below. The number of cones or a bound must be given; cones are
///        placed until there are as many, or all bounds that are given are met.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{number_of_cones}
///     \cgalParamDescription{how many cones}
///     \cgalParamType{`std::size_t`}
///     \cgalParamDefault{as many as it takes to meet the bounds, at most 256}
///   \cgalParamNEnd
///   \cgalParamNBegin{maximum_log_scale_factor}
///     \cgalParamDescription{the bound on |u|}
///     \cgalParamType{`double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{maximum_area_distortion}
///     \cgalParamDescription{the bound on the factor by which areas are scaled relative to the mean: on the largest max(a, 1 / a) of all faces, a = (scaled area / area) / (total scaled area / total area); faces without area do not count. Where edges were flipped, a is that of vertices, with e^{2u} for the first quotient}
///     \cgalParamType{`double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{angle_quantum}
///     \cgalParamDescription{2 pi / n: angles are rounded to multiples of it (radians)}
///     \cgalParamType{`double`}
///     \cgalParamDefault{`0`: they are not}
///   \cgalParamNEnd
///   \cgalParamNBegin{cone_measure}
///     \cgalParamDescription{by what placements are compared}
///     \cgalParamType{`Cone_measure`}
///     \cgalParamDefault{`Cone_measure::MAXIMUM_U`}
///   \cgalParamNEnd
///   \cgalParamNBegin{number_of_sweeps}
///     \cgalParamDescription{of the concurrent optimization, at most}
///     \cgalParamType{`std::size_t`}
///     \cgalParamDefault{`10`}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{edge_length_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{mollification} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{log_scale_factor_map}
///     \cgalParamDescription{receives u of the metric with the cones}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{gradient_tolerance, number_of_iterations, newton_strategy, retriangulation, border_edges, visitor}
///     \cgalParamDescription{as in `Conformal_metric_solver::solve()`} \cgalParamNEnd
///   \cgalParamNBegin{sparse_linear_solver} \cgalParamDescription{as in `compute_conformal_metric()`} \cgalParamNEnd
///   \cgalParamNBegin{flattening_report}
///     \cgalParamDescription{receives a copy of what is returned}
///     \cgalParamType{`std::reference_wrapper<Flattening_report<TriangleMesh> >`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the report, with the cones. Maps are written iff it is a success, or `BOUND_NOT_MET`: then with the best placement found, `amount` is its largest |u| if that is too large, else its area distortion. Statuses: those of `import_mesh()`;
///         `WRONG_TOPOLOGY` (several components); `MISSING_CONDITION` (neither number nor bounds; or fewer than three cones on a sphere); `TOO_MANY_CONES` (more than vertices);
///         `ANGLE_OUT_OF_RANGE` (the quantum is not 2 pi / n); `NOT_QUANTIZABLE`; those of `Conformal_metric_solver::solve()`.
///
/// Time: a few solves of a linear system with the one factor for each cone and sweep, and for each local move.
template <typename TriangleMesh, typename VertexAngleMap, typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> place_cones(const TriangleMesh& tm,
                                            VertexAngleMap cone_angle_map,
                                            const NamedParameters& np = parameters::default_values())
{
  using parameters::get_parameter;
  using parameters::is_default_parameter;
  const internal::Stopwatch stopwatch;
  Imported_mesh<TriangleMesh, double> mesh = import_mesh(tm, np);
  Flattening_report<TriangleMesh> report = internal::import_report(mesh);
  const double seconds = stopwatch.seconds();
  if(bool(report))
  {
    const Intrinsic_triangulation<double>& t = mesh.triangulation;
    const Cone_placement<double> placement = place_cones(t, np);
    internal::report_cones(mesh, placement, report);
    if(bool(report) || report.status == Status::BOUND_NOT_MET)
    {
      for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
        if(!t.is_isolated_vertex(v) && !t.is_border_vertex(v))
          put(cone_angle_map, mesh.vertex(v), 2 * CGAL_PI);
      for(const auto& cone : report.cones)
        put(cone_angle_map, cone.vertex, cone.angle);
      if constexpr(!is_default_parameter<NamedParameters, internal_np::conformal_u_t>::value)
        for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
          if(!t.is_isolated_vertex(v))
            put(get_parameter(np, internal_np::conformal_u), mesh.vertex(v), placement.metric.log_scale_factors[v]);
    }
  }
  report.statistics.seconds.import = seconds;
  if constexpr(!is_default_parameter<NamedParameters, internal_np::conformal_report_t>::value)
    get_parameter(np, internal_np::conformal_report).get() = report;
  return report;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_PLACE_CONES_H
