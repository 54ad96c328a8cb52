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
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/internal/cone_search.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>
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
  std::vector<double> free_angles;         ///< by cone: what it was before it was rounded, when all cones were free (radians)
  std::vector<Index> flattened;            ///< cones whose angles were rounded to 2 pi: they are none any more

  Conformal_metric<NT> metric;             ///< with these angle sums, and u = 0 on borders
  double maximum_log_scale_factor = 0;     ///< the largest |u| of `metric`
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
      return refused(Status::SINGULAR_PROBLEM);
    Placement p = search.without_cones(first_u());
    place_greedily(search, p);
    p = optimized(search, std::move(p));
    p = moved(search, std::move(p));
    std::sort(p.cones.begin(), p.cones.end());
    result_.cones = p.cones;
    solve();
    if(is_success(result_.metric.status))
    {
      take_angles();
      if(options_.angle_quantum > 0)
        quantize(search, std::move(p));
    }
    result_.number_of_solves = search.number_of_solves();
    finish();
    return std::move(result_);
  }

private:
  static constexpr std::size_t most_cones_for_bound = 256;

  Solver_traits traits() const
  {
    return parameters::choose_parameter<Solver_traits>(parameters::get_parameter(np_, internal_np::sparse_linear_solver));
  }

  Cone_placement<NT> refused(Status status, double amount = 0)
  {
    result_.status = status;
    result_.amount = amount;
    return std::move(result_);
  }

  // ---- What can be asked for

  bool check()
  {
    if(t_.number_of_faces() == 0)
      result_.status = Status::EMPTY_MESH;
    else if(pieces_.components.size() != 1)
      result_.status = Status::WRONG_TOPOLOGY;
    else if(options_.number_of_cones == 0 && !(options_.maximum_u > 0))
      result_.status = Status::MISSING_CONDITION;
    return result_.status == Status::OK;
  }

  bool is_sphere() const { return number_of_borders() == 0 && pieces_.components[0].euler_characteristic() > 0; }
  std::size_t number_of_borders() const { return pieces_.components[0].number_of_borders; }

  bool check_number(const Search& search)
  {
    const std::size_t n = search.candidates().size();
    if(options_.number_of_cones > n || (is_sphere() && n < 3))
      refused(Status::TOO_MANY_CONES, double(n));
    else if(is_sphere() && options_.number_of_cones > 0 && options_.number_of_cones < 3)
      refused(Status::MISSING_CONDITION, 4 * Number_constants<double>::pi());
    else if(options_.angle_quantum > 0 && quanta_of_turn() == 0)
      refused(Status::ANGLE_OUT_OF_RANGE, options_.angle_quantum);
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

  // With the cones of the result: free, or with the angles given.
  void solve(const std::vector<Exact_angle<NT> >& angles = std::vector<Exact_angle<NT> >())
  {
    Conformal_conditions<NT> conditions = natural_conditions();
    for(std::size_t i = 0; i < result_.cones.size(); ++i)
    {
      if(angles.empty())
        conditions.fix_log_scale_factor(result_.cones[i], NT(0));
      else
        conditions.prescribe_angle_sum(result_.cones[i], angles[i]);
    }
    result_.metric = compute_conformal_metric(t_, conditions, np_);
    measure();
  }

  void measure()
  {
    result_.maximum_log_scale_factor = 0;
    for(const NT& u : result_.metric.log_scale_factors)
      result_.maximum_log_scale_factor = (std::max)(result_.maximum_log_scale_factor, std::abs(static_cast<double>(u)));
  }

  // As found, with free cones.
  void take_angles()
  {
    for(Index c : result_.cones)
    {
      const double angle = angle_sum_at(result_.metric, c);
      result_.free_angles.push_back(angle);
      Exact_angle<NT> exact;
      exact.rest = NT(angle);
      result_.angles.push_back(exact);
    }
  }

  void finish()
  {
    if(result_.status != Status::OK)
      return;
    result_.status = result_.metric.status;
    result_.amount = result_.metric.amount;
    if(is_success(result_.status) && options_.maximum_u > 0 && result_.maximum_log_scale_factor > options_.maximum_u)
    {
      result_.status = Status::BOUND_NOT_MET;
      result_.amount = result_.maximum_log_scale_factor;
    }
  }

  // ---- Placement

  bool is_enough(const Placement& p) const
  {
    if(is_sphere() && p.cones.size() < 3)
      return false;
    if(options_.number_of_cones > 0 && p.cones.size() >= options_.number_of_cones)
      return true;
    if(!(options_.maximum_u > 0))
      return false;
    double largest = 0;
    for(double u : p.u)
      largest = (std::max)(largest, std::abs(u));
    return largest <= options_.maximum_u;
  }

  // A cone where |u| is largest, again and again.
  void place_greedily(Search& search, Placement& p) const
  {
    const int steps = 3;
    while(!is_enough(p) && p.cones.size() < (std::min)(search.candidates().size(), options_.number_of_cones > 0 ? options_.number_of_cones
                                                                                                                : most_cones_for_bound))
    {
      Search::add(p, search.worst_vertex(p));
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
        Search::remove(p, 0); // the cone that has been there longest
        search.relax(p, 1);
        Search::add(p, search.worst_vertex(p));
        search.relax(p, 1);
      }
      search.relax(p, 2);
      if(p.measure < best.measure)
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

  // Moves single cones to vertices nearby, as long as that makes it better: farther ones first, and only the cones that have most influence; in the end each to
  // its neighbours.
  Placement moved(Search& search, Placement p)
  {
    const std::size_t few = 2;
    std::size_t reach = (std::max)(std::size_t(1), std::size_t(std::sqrt(double(search.candidates().size())) / 12));
    for(; reach > 0; reach /= 2)
      for(bool is_better = true; is_better; )
      {
        is_better = false;
        const std::vector<std::size_t> order = search.by_influence(p);
        for(std::size_t k = 0; k < order.size() && !is_better && (k < few || reach == 1); ++k)
          is_better = improve(search, p, order[k], reach);
      }
    return p;
  }

  bool improve(Search& search, Placement& p, std::size_t i, std::size_t reach)
  {
    const double gain = reach == 1 ? 1e-4 : 1e-3, curvature = search.curvature(p, i);
    std::vector<std::pair<double, Index> > trials; // by what is expected
    for(Index v : ring(p.cones[i], reach))
      if(!t_.is_border_vertex(v) && !p.is_cone(v))
        trials.emplace_back(search.measure_if_moved(p, i, curvature, v), v);
    std::sort(trials.begin(), trials.end());
    const std::size_t most = 1;
    for(std::size_t k = 0; k < trials.size() && k < most && trials[k].first < (1 - gain) * p.measure; ++k)
    {
      Placement trial = p;
      trial.cones[i] = trials[k].second;
      if(search.relax(trial, 4) && trial.measure < (1 - gain) * p.measure)
      {
        p = std::move(trial);
        ++result_.number_of_moves;
        return true;
      }
    }
    return false;
  }

  // Some vertices at that distance in edges, all around.
  std::vector<Index> ring(Index v, std::size_t distance) const
  {
    std::set<Index> seen = {v};
    std::vector<Index> front(1, v);
    for(std::size_t d = 0; d < distance && !front.empty(); ++d)
    {
      std::vector<Index> next;
      for(Index w : front)
        t_.for_each_outgoing(w, [&](Index h)
        {
          for(Index x : {t_.target(h), t_.apex(h)})
            if(seen.insert(x).second)
              next.push_back(x);
        });
      front.swap(next);
    }
    const std::size_t most = 6;
    if(front.size() <= most || distance == 1)
      return front;
    std::vector<Index> result;
    for(std::size_t k = 0; k < most; ++k)
      result.push_back(front[k * front.size() / most]);
    return result;
  }

  // ---- Multiples of an angle

  // Rounds the angles, takes out the cones that have become flat, and moves the others again.
  void quantize(Search& search, Placement p)
  {
    const long n = quanta_of_turn();
    const double quantum = 2 * Number_constants<double>::pi() / double(n);
    std::vector<double> x;
    for(double angle : result_.free_angles)
      x.push_back(angle / quantum);
    const long sum = number_of_borders() > 0 ? 0 : n * (long(x.size()) - long(pieces_.components[0].euler_characteristic()));
    const std::vector<long> k = number_of_borders() == 0 && sum <= 0 ? std::vector<long>() : nearest_integers(x, sum);
    if(k.empty() && !x.empty())
    {
      refused(Status::NOT_QUANTIZABLE, double(sum) * quantum);
      return;
    }
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
      q = moved(search, std::move(q));
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
    solve(result_.angles);
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
  options.maximum_u = choose_parameter(get_parameter(np, internal_np::conformal_maximum_u), 0.);
  options.angle_quantum = choose_parameter(get_parameter(np, internal_np::conformal_angle_quantum), 0.);
  options.measure = choose_parameter(get_parameter(np, internal_np::conformal_cone_measure), Cone_measure::MAXIMUM_U);
  options.number_of_sweeps = choose_parameter(get_parameter(np, internal_np::conformal_number_of_sweeps), std::size_t(10));
  return options;
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
///  - *Locally*: each cone is moved to vertices nearby, as long as that makes it better.
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
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below. The number of cones or the bound must be given; if
///        both are, cones are placed until the first of the two is reached.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{number_of_cones}
///     \cgalParamDescription{how many cones}
///     \cgalParamType{`std::size_t`}
///     \cgalParamDefault{as many as it takes to meet the bound, at most 256}
///   \cgalParamNEnd
///   \cgalParamNBegin{maximum_log_scale_factor}
///     \cgalParamDescription{the bound on |u|}
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
/// \return the report, with the cones. Maps are written iff it is a success, or `BOUND_NOT_MET`: then with the best placement found, `amount` is its largest |u|. Statuses: those of `import_mesh()`;
///         `WRONG_TOPOLOGY` (several components); `MISSING_CONDITION` (neither number nor bound; or fewer than three cones on a sphere); `TOO_MANY_CONES` (more than vertices);
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
    report.statistics = placement.metric.statistics;
    report.status = placement.status;
    report.amount = placement.amount;
    internal::name_elements(mesh, placement.metric.is_retriangulated() ? std::vector<std::uint32_t>() : placement.metric.vertices, {},
                            placement.metric.is_retriangulated() ? std::vector<std::uint32_t>() : placement.metric.faces, report);
    if(bool(report) || report.status == Status::BOUND_NOT_MET)
    {
      for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
        if(!t.is_isolated_vertex(v) && !t.is_border_vertex(v))
          put(cone_angle_map, mesh.vertex(v), 2 * CGAL_PI);
      for(std::size_t i = 0; i < placement.cones.size(); ++i)
      {
        const double angle = placement.angles[i].template radians<double>();
        put(cone_angle_map, mesh.vertex(placement.cones[i]), angle);
        report.cones.push_back({mesh.vertex(placement.cones[i]), placement.cones[i], angle, !placement.angles[i].is_exact()});
      }
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
