// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Cones that place themselves. Their angles are chosen with their places (Cone_chooser.h); or they have u = 0, and are placed greedily, then all
// of them concurrently, then one after the other (section 5.1 of Springborn, Schroeder and Pinkall, 2008); with angles that are rounded to
// multiples of 2 pi / n (section 6), if that is wanted. What is tried is compared to first order (Cone_model.h, Cone_search.h); the metric with
// the cones that were found is solved for, and decides.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_PLACER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_PLACER_H

#include <CGAL/Conformal_equivalence/Cone_placement.h>
#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Cone_chooser.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Cone_excursion.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Cone_options.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Cone_search.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Cone_surface.h>
#include <CGAL/Conformal_equivalence/internal/Cones/Shared_factorization.h>
#include <CGAL/Conformal_equivalence/internal/Cones/area_distortion.h>
#include <CGAL/Conformal_equivalence/internal/Cones/nearest_integers.h>
#include <CGAL/Conformal_equivalence/internal/Cones/u_measures.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Metric_finder.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/Solver/energy.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename NT>
class Cone_placer
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;
  typedef Cone_search<NT> Search;

public:
  // The search keeps one factor all the time, which must be none of those that are made for metrics meanwhile. Keeps a reference to `t`.
  Cone_placer(const Triangulation& t, const Cone_options& options, const Solver_options& solver_options,
              std::unique_ptr<Factorization> search_factorization, Factorization_maker make_factorization)
    : t_(t), options_(options), solver_options_(solver_options), make_coarse_factorization_(std::move(make_factorization)),
      make_factorization_(shared_factorization_maker(make_coarse_factorization_)),
      search_factorization_(std::move(search_factorization)), pieces_(connected_components(t)), area_(vertex_areas(t))
  {}

  // Can be called once.
  Cone_placement<NT> run();

private:
  static constexpr std::size_t most_cones_for_bound = 256; // as the documentation of place_cones() says
  static constexpr long most_quanta_of_turn = 2520;        // multiples of 2 pi / 2520 are told apart with ease; beyond, nobody means a multiple
  static constexpr int most_additions = 30;                // each costs a solve; the search is seldom wrong by more than a few cones
  static constexpr int steps_of_last_relaxation = 6;         // the steps converge linearly, and fast: more of them change hardly anything
  static constexpr double usable_error = 1e-2;             // radians: Newton's method with the factor of u = 0 is on its way to a metric
  static constexpr double error_worth_starting_at = 0.1;   // radians: up to here u is a better place to begin than 0

  void refuse(Status status, double amount = 0)
  {
    result_.status = status;
    result_.amount = amount;
  }

  const Any_visitor& visitor() const { return solver_options_.visitor; }

  // ---- What can be asked for

  bool check()
  {
    if(t_.number_of_faces() == 0)
      result_.status = Status::EMPTY_MESH;
    else if(pieces_.components.size() != 1)
      result_.status = Status::WRONG_TOPOLOGY;
    else if(options_.number_of_cones == 0 && !options_.has_bound())
      result_.status = Status::MISSING_CONDITION;
    return result_.status == Status::OK;
  }

  bool is_sphere() const { return number_of_borders() == 0 && pieces_.components[0].euler_characteristic() > 0; }
  std::size_t number_of_borders() const { return pieces_.components[0].number_of_borders; }

  bool check_number()
  {
    const std::size_t n = number_of_inner_vertices(t_);
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
    return nearest >= 1 && nearest <= most_quanta_of_turn && std::abs(n - nearest) < 1e-6 ? long(nearest) : 0;
  }

  // ---- Metrics

  Conformal_conditions<NT> natural_conditions() const { return Conformal_conditions<NT>(t_); }

  Conformal_metric<NT> find_metric(const Conformal_conditions<NT>& conditions, const Solver_options& options) const
  {
    Metric_finder<NT> finder(t_, make_factorization_());
    Conformal_metric<NT> result = finder.find(conditions, options);
    if(!result.is_retriangulated())
      result.triangulation = finder.take_triangulation();
    return result;
  }

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
    Solver_options rough = solver_options_;
    rough.gradient_tolerance = 1e-4; // the search goes on from there, with steps of its own
    const Conformal_metric<NT> metric = find_metric(conditions, rough);
    Vertex_vector u(t_.number_of_vertices(), 0.);
    for(std::size_t v = 0; v < u.size() && v < metric.log_scale_factors.size(); ++v)
      u[v] = static_cast<double>(metric.log_scale_factors[v]);
    return u;
  }

  // With the cones of the result: free, or with the angles given. Begins with what the search has found, if it has found something.
  void solve(const Placement& p, const std::vector<Exact_angle<NT> >& angles = std::vector<Exact_angle<NT> >(),
             std::size_t most_iterations = std::size_t(-1))
  {
    Conformal_conditions<NT> conditions = natural_conditions();
    for(std::size_t i = 0; i < result_.cones.size(); ++i)
    {
      if(angles.empty())
        conditions.fix_log_scale_factor(result_.cones[i], NT(0));
      else
        conditions.prescribe_angle_sum(result_.cones[i], angles[i]);
    }
    Solver_options options = solver_options_;
    options.number_of_iterations = (std::min)(options.number_of_iterations, most_iterations);
    options.initial_log_scale_factors = p.error <= error_worth_starting_at ? p.u : Vertex_vector(p.u.size(), 0.);
    result_.metric = find_metric(conditions, options);
    measure();
  }

  void measure()
  {
    result_.maximum_log_scale_factor = 0;
    for(const NT& u : result_.metric.log_scale_factors)
      result_.maximum_log_scale_factor = (std::max)(result_.maximum_log_scale_factor, std::abs(static_cast<double>(u)));
    if(!is_success(result_.metric.status))
      return;
    result_.area_distortion = area_distortion_of_metric(t_, result_.metric);
    result_.root_mean_square = root_mean_square(area_, found_u());
  }

  // u of the metric of the result
  Vertex_vector found_u() const
  {
    Vertex_vector u;
    for(const NT& x : result_.metric.log_scale_factors)
      u.push_back(static_cast<double>(x));
    return u;
  }

  // What is aimed at
  double measured() const
  {
    return options_.measure == Cone_measure::ROOT_MEAN_SQUARE_U ? result_.root_mean_square
         : options_.measure == Cone_measure::AREA_DISTORTION    ? result_.area_distortion
                                                                : result_.maximum_log_scale_factor;
  }

  // ---- Angles of free cones

  std::vector<double> free_angles() const
  {
    std::vector<double> result;
    for(Index c : result_.cones)
      result.push_back(angle_sum_at(result_.metric, c));
    return result;
  }

  void keep_free(const Placement& p)
  {
    solve(p);
    if(!is_success(result_.metric.status))
      return;
    result_.free_angles = free_angles();
    for(double angle : result_.free_angles)
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
    result_.set_outcome(result_.metric.outcome());
    if(!is_success(result_.status))
      return;
    if(misses_maximum_u())
      refuse(Status::BOUND_NOT_MET, result_.maximum_log_scale_factor);
    else if(misses_maximum_area_distortion())
      refuse(Status::BOUND_NOT_MET, result_.area_distortion);
    else if(misses_maximum_root_mean_square())
      refuse(Status::BOUND_NOT_MET, result_.root_mean_square);
  }

  // Does the metric of the result?
  bool misses_maximum_u() const { return options_.maximum_u > 0 && !(result_.maximum_log_scale_factor <= options_.maximum_u); }
  bool misses_maximum_area_distortion() const
  {
    return options_.maximum_area_distortion > 0 && !(result_.area_distortion <= options_.maximum_area_distortion);
  }

  bool misses_a_bound() const { return misses_maximum_u() || misses_maximum_area_distortion() || misses_maximum_root_mean_square(); }
  bool misses_maximum_root_mean_square() const
  {
    return options_.maximum_root_mean_square > 0 && !(result_.root_mean_square <= options_.maximum_root_mean_square);
  }

  // ---- Chosen angles

  bool are_angles_chosen() const
  {
    const bool is_mean = options_.measure == Cone_measure::ROOT_MEAN_SQUARE_U; // to which closest vectors belong
    return options_.angles == Cone_angles::CHOSEN && options_.measure != Cone_measure::DIRICHLET_ENERGY
        && (is_mean || !(options_.angle_quantum > 0) || Cone_chooser<NT>::is_begun_coarsely(t_, options_));
  }

  // Places and angles together. Returns whether there is a metric with these; if there is none, cones with u = 0 may have one.
  bool choose()
  {
    visitor().on_stage(Stage::PLACE);
    Cone_chooser<NT> chooser(t_, pieces_.components[0], options_, make_factorization_, make_coarse_factorization_, visitor());
    if(!chooser.begin())
      return false;
    Curved_cones s;
    if(options_.has_bound() && chooser.without_cones(s) && conclude(chooser, s, 0) && !misses_a_bound())
      return true;
    if(is_stopped())
      return true;
    s = chooser.placed(most_cones_for_bound, !(options_.angle_quantum > 0));
    if(!visitor().go_further())
    {
      refuse(Status::STOPPED_BY_VISITOR);
      return true;
    }
    if(!conclude_and_refine(chooser, s))
      return false;
    for(int round = 0; round < most_additions && is_bound_missed() && s.cones.size() < most_cones_for_bound && chooser.add(s); ++round)
    {
      const Cone_placement<NT> last = result_;
      if(!conclude_and_refine(chooser, s) || is_stopped())
      {
        keep(last);
        break;
      }
    }
    result_.number_of_solves = chooser.number_of_solves();
    return is_success(result_.metric.status) || result_.status == Status::NOT_QUANTIZABLE || is_stopped();
  }

  bool is_stopped() const { return result_.metric.status == Status::STOPPED_BY_VISITOR; }

  // What was found last is not better, or was not found: the one before is the result.
  void keep(const Cone_placement<NT>& last)
  {
    const bool was_stopped = is_stopped();
    result_ = last;
    if(was_stopped)
      refuse(Status::STOPPED_BY_VISITOR);
  }

  // The metric with the cones of `s`, rounded if that is asked for. Returns whether there is one, or it is known why not.
  bool conclude_and_refine(Cone_chooser<NT>& chooser, Curved_cones& s)
  {
    const long n = options_.angle_quantum > 0 ? quanta_of_turn() : 0;
    Curved_cones rounded = s;
    if(n > 0 && !chooser.quantize(rounded, n))
    {
      result_.free_angles.assign(s.cones.size(), 0.);
      refuse(Status::NOT_QUANTIZABLE, double(sum_of_multiples(n)) * quantum(n));
      return true;
    }
    Curved_cones& concluded = n > 0 ? rounded : s;
    if(!conclude(chooser, concluded, n))
      return is_stopped();
    foreseen_ = chooser.measure(concluded);
    has_foreseen_ = true;
    refine(chooser, concluded, n);
    return true;
  }

  // Is the metric much worse than the model of the surface given had foreseen? Then the places of its choice are not to be trusted. Nor are they
  // the best ones for sure where they are good: but on large surfaces it takes as long again to see that.
  bool is_doubtful() const
  {
    const Index few_vertices = 5000;
    // of demo meshes one in ten is beyond; cones with u = 0 were better at some of these only. Multiples cannot make up for what was not foreseen
    const double most_ratio = is_largest_u_rounded() ? 1.05 : 1.25;
    if(is_stopped() || result_.status != Status::OK || !is_success(result_.metric.status))
      return false;
    const bool is_area = options_.measure == Cone_measure::AREA_DISTORTION;
    const double least = 1e-3, now = is_area ? std::log(measured()) : measured(), then = is_area ? std::log(foreseen_) : foreseen_;
    return is_bound_missed() || (now > least && (t_.number_of_vertices() < few_vertices || (has_foreseen_ && now > most_ratio * then)));
  }

  // Multiples for the largest u are chosen where there is a coarse surface; elsewhere angles of cones with u = 0 are rounded, and go on from there.
  bool is_largest_u_rounded() const { return options_.angle_quantum > 0 && options_.measure != Cone_measure::ROOT_MEAN_SQUARE_U; }

  // The better one of what has been chosen and of cones with u = 0 is the result.
  void compare_with_zero_u()
  {
    const Cone_placement<NT> chosen = result_;
    const bool misses = misses_a_bound();
    const double amount = measured();
    place_with_zero_u();
    if(is_largest_u_rounded())
      improve_multiples();
    const bool is_better = misses_a_bound() == misses ? measured() < amount : misses;
    if(!is_success(result_.metric.status) || result_.status != Status::OK || !is_better)
      keep(chosen);
  }

  // The model foresees u to first order. Where that was not good enough, it is made anew at the metric found, and tells how to go on from there; but
  // not where more edges were flipped than there are: then triangles are needles, and little can be foreseen.
  void refine(Cone_chooser<NT>& chooser, Curved_cones& s, long n)
  {
    const int most_rounds = 2; // each costs a factor, some solutions with it, and a metric
    for(int round = 0; round < most_rounds; ++round)
    {
      if(measured() <= 1.02 * chooser.measure(s) || result_.metric.flips.size() > t_.number_of_edges() || !chooser.go_on_from(result_.metric))
        return;
      const double before = measured();
      Curved_cones next = s;
      if(n > 0)
        chooser.improve_quantized(next, n);
      else
        chooser.improve(next, false);
      if(!conclude_if_better(chooser, next, n))
        return;
      s = std::move(next);
      if(!(measured() < 0.99 * before))
        return;
    }
  }

  // Returns whether the metric with these cones is better than the result; else that stays.
  bool conclude_if_better(Cone_chooser<NT>& chooser, const Curved_cones& s, long n)
  {
    const Cone_placement<NT> last = result_;
    const bool misses = misses_a_bound();
    const double before = measured();
    const std::size_t most_iterations = 10 + 2 * result_.metric.statistics.number_of_iterations; // what takes more is far from foreseen
    const bool is_better = conclude(chooser, s, n, most_iterations) && (misses || !misses_a_bound()) && measured() < before;
    if(!is_better)
      keep(last);
    return is_better;
  }

  // Takes these cones for the result, with multiples of 2 pi / n if n is not 0, and finds its metric. Returns whether there is one.
  bool conclude(Cone_chooser<NT>& chooser, const Curved_cones& s, long n, std::size_t most_iterations = std::size_t(-1))
  {
    const double turn = 2 * Number_constants<double>::pi();
    const Eigen::VectorXd free = n > 0 ? chooser.best_curvatures(s) : s.curvatures;
    std::vector<std::pair<Index, Eigen::Index> > order;
    for(std::size_t i = 0; i < s.cones.size(); ++i)
      order.emplace_back(s.cones[i], Eigen::Index(i));
    std::sort(order.begin(), order.end());
    result_.cones.clear();
    result_.free_angles.clear();
    result_.angles.clear();
    for(const auto& cone : order)
    {
      Exact_angle<NT> exact;
      exact.rest = NT(turn - s.curvatures[cone.second]);
      result_.cones.push_back(cone.first);
      result_.angles.push_back(n > 0 ? multiple(n - std::lround(s.curvatures[cone.second] / quantum(n)), n) : exact);
      result_.free_angles.push_back(turn - free[cone.second]);
    }
    result_.is_rounded = n > 0;
    result_.flattened = s.flattened;
    std::sort(result_.flattened.begin(), result_.flattened.end());
    Placement p;
    p.cones = result_.cones;
    p.u = chooser.u_of(s);
    p.error = angle_error(p.u) < angle_error(Vertex_vector(p.u.size(), 0.)) / 2 ? 0 : 1;
    solve(p, result_.angles, most_iterations);
    centre();
    return is_success(result_.metric.status);
  }

  // The largest difference of an angle sum from what it is to be.
  double angle_error(const Vertex_vector& u) const
  {
    Conformal_energy<double, NT> energy(t_, true);
    if(!energy.evaluate(u))
      return std::numeric_limits<double>::infinity();
    Vertex_vector error(u.size(), 0.);
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
      if(!t_.is_isolated_vertex(v) && !t_.is_border_vertex(v))
        error[v] = energy.angle_sums()[v] - 2 * Number_constants<double>::pi();
    for(std::size_t i = 0; i < result_.cones.size(); ++i)
      error[result_.cones[i]] = energy.angle_sums()[result_.cones[i]] - result_.angles[i].template radians<double>();
    return largest_entry(error);
  }

  // Where nothing determines the scale, it is the one with which the largest |u| is least; or the one for which the mean of u is 0.
  void centre()
  {
    if(number_of_borders() > 0 || !is_success(result_.metric.status))
      return;
    const Vertex_vector u = found_u();
    const bool is_mean = options_.measure == Cone_measure::ROOT_MEAN_SQUARE_U;
    double least = std::numeric_limits<double>::infinity(), most = -least, mean = 0;
    for(Index v = 0; v < t_.number_of_vertices(); ++v)
    {
      if(t_.is_isolated_vertex(v))
        continue;
      least = (std::min)(least, u[v]);
      most = (std::max)(most, u[v]);
      mean += area_[v] * u[v];
    }
    typedef typename Conformal_metric<NT>::Wide_number Wide_number;
    const double shift = is_mean ? mean : (least + most) / 2;
    const Wide_number factor(std::exp(-shift / 2));
    for(NT& x : result_.metric.log_scale_factors)
      x = NT(x - NT(shift));
    for(Wide_number& x : result_.metric.scale_factors)
      x = x * factor;
    measure();
  }

  // ---- Placement

  bool is_enough(const Placement& p) const
  {
    if(is_sphere() && p.cones.size() < 3)
      return false;
    if(options_.number_of_cones > 0 && p.cones.size() >= options_.number_of_cones)
      return true;
    return options_.has_bound()
        && (!(options_.maximum_u > 0) || largest_entry(p.u) <= options_.maximum_u)
        && (!(options_.maximum_area_distortion > 0) || area_distortion_of_faces(t_, p.u) <= options_.maximum_area_distortion)
        && (!(options_.maximum_root_mean_square > 0) || root_mean_square(area_, p.u) <= options_.maximum_root_mean_square);
  }

  Placement placed(Search& search)
  {
    Placement p = search.without_cones(Vertex_vector(t_.number_of_vertices(), 0.));
    if(!search.relax(p, 20) || p.error > usable_error)
      p = search.without_cones(first_u());
    place_greedily(search, p);
    return moved(search, optimized(search, std::move(p)));
  }

  // The exact metric misses a bound that the search had met: one more cone, where |u| is largest in the metric. Returns whether there is one.
  bool put_another(Search& search, Placement& p)
  {
    for(std::size_t v = 0; v < p.u.size(); ++v)
      p.u[v] = static_cast<double>(result_.metric.log_scale_factors[v]);
    if(!search.put_cone(p))
      return false;
    search.relax(p, steps_of_last_relaxation);
    return true;
  }

  bool is_bound_missed() const
  {
    return options_.number_of_cones == 0 && is_success(result_.metric.status) && result_.status == Status::OK
        && misses_a_bound();
  }

  // As in section 5.1: free cones have u = 0.
  void place_with_zero_u()
  {
    result_ = Cone_placement<NT>();
    visitor().on_stage(Stage::PLACE);
    Search search(t_, pieces_.components[0], std::move(search_factorization_), options_.measure);
    if(!search.factorize())
      return refuse(Status::SINGULAR_PROBLEM);
    Placement p = placed(search);
    conclude(search, p);
    for(int round = 0; round < most_additions && is_bound_missed() && p.cones.size() < most_cones_for_bound && put_another(search, p); ++round)
      conclude(search, p);
    result_.number_of_solves += search.number_of_solves();
  }

  // Takes the cones of `p` for the result, and finds its metric.
  void conclude(Search& search, Placement p)
  {
    std::sort(p.cones.begin(), p.cones.end());
    result_.cones = p.cones;
    result_.angles.clear();
    result_.free_angles.clear();
    result_.flattened.clear();
    if(options_.angle_quantum > 0)
      quantize(search, std::move(p));
    else
      keep_free(p);
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
      if(!goes_further(p))
        return;
    }
  }

  // Tells the visitor how far the search is. Returns whether it is to go on.
  bool goes_further(const Placement& p) const
  {
    visitor().on_progress(Stage::PLACE, p.cones.size(), p.measure);
    return visitor().go_further();
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
      if(!seen.insert(sorted(p.cones)).second || !goes_further(best))
        break;
    }
    return best;
  }

  static std::vector<Index> sorted(std::vector<Index> cones)
  {
    std::sort(cones.begin(), cones.end());
    return cones;
  }

  // Moves single cones to vertices nearby as long as that makes it better, always the one move that promises most. Promises are exact to first order,
  // but for two things: |u| at vertices that have not been looked at, and u at the new place itself. Where a promise is broken, the vertex at fault
  // is looked at from then on, and shorter moves are tried.
  Placement moved(Search& search, const Placement& first)
  {
    // a surface is about sqrt(n) edges wide, and a cone that the sweeps have placed lies within a fraction of that
    const std::size_t reach = (std::max)(std::size_t(2), std::size_t(std::sqrt(double(search.candidates().size())) / 6));
    const double gain = 5e-4; // a part of the measure: for less a move is not worth its solve
    Placement p = first;
    std::set<std::pair<Index, Index> > tried;
    std::size_t number_of_moves = 0;
    search.watch(p);
    for(int failures = 0; reach >> (failures / 2) > 0 && goes_further(p); )
    {
      const Cone_move move = search.best_move(p, reach >> (failures / 2), tried);
      const double enough = (1 - gain) * p.measure;
      if(!(move.expected < enough))
        break;
      Placement trial = search.moved(p, move.cone, move.curvature, move.to);
      if(trial.measure < enough && search.relax(trial, 2, usable_error, false) && trial.measure < enough)
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
    if(number_of_moves == 0 || !search.relax(p, steps_of_last_relaxation) || !(p.measure < first.measure))
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
    const std::vector<long> k = nearest_multiples(n);
    if(k.empty() && !result_.cones.empty())
      return refuse(Status::NOT_QUANTIZABLE, double(sum_of_multiples(n)) * quantum(n));
    result_.is_rounded = true;
    Placement q;
    q.u = std::move(p.u);
    std::vector<std::size_t> kept; // numbers of the cones of q among those of the result
    for(std::size_t i = 0; i < k.size(); ++i)
    {
      if(k[i] == n)
      {
        result_.flattened.push_back(result_.cones[i]);
        continue;
      }
      q.cones.push_back(result_.cones[i]);
      q.angles.push_back(double(k[i]) * quantum(n));
      kept.push_back(i);
    }
    if(!q.cones.empty() && search.relax(q, steps_of_last_relaxation))
      q = moved(search, q);
    take_rounded(q, kept, k, n);
    solve(q, result_.angles);
  }

  // Angles that were rounded one by one are a place to begin: others may be better for the measure asked for, all together, and at places that suit
  // them. The metric decides.
  void improve_multiples()
  {
    if(options_.angles != Cone_angles::CHOSEN || !result_.is_rounded || options_.measure == Cone_measure::DIRICHLET_ENERGY || result_.cones.empty()
       || result_.status != Status::OK || !is_success(result_.metric.status))
      return;
    visitor().on_stage(Stage::PLACE);
    Cone_chooser<NT> chooser(t_, pieces_.components[0], options_, make_factorization_, make_coarse_factorization_, visitor());
    if(!chooser.go_on_from(result_.metric) && !chooser.begin())
      return;
    const double turn = 2 * Number_constants<double>::pi();
    const std::size_t n_solves = result_.number_of_solves;
    Curved_cones s;
    s.cones = result_.cones;
    s.flattened = result_.flattened;
    s.curvatures.resize(Eigen::Index(s.cones.size()));
    for(std::size_t i = 0; i < s.cones.size(); ++i)
      s.curvatures[Eigen::Index(i)] = turn - result_.angles[i].template radians<double>();
    const Curved_cones first = s;
    chooser.improve_quantized(s, quanta_of_turn());
    if(s.cones != first.cones || s.curvatures != first.curvatures)
      conclude_if_better(chooser, s, quanta_of_turn());
    result_.number_of_solves = n_solves + chooser.number_of_solves();
  }

  static double quantum(long n) { return 2 * Number_constants<double>::pi() / double(n); }

  // What the multiples of the cones must sum up to, by Gauss and Bonnet's formula; 0 if there is a border, which takes the rest.
  long sum_of_multiples(long n) const
  {
    return number_of_borders() > 0 ? 0 : n * (long(result_.free_angles.size()) - long(pieces_.components[0].euler_characteristic()));
  }

  // By cone. Empty if there are none.
  std::vector<long> nearest_multiples(long n) const
  {
    const long sum = sum_of_multiples(n);
    if(number_of_borders() == 0 && sum <= 0)
      return {};
    std::vector<double> x;
    for(double angle : result_.free_angles)
      x.push_back(angle / quantum(n));
    return nearest_integers(x, sum);
  }

  // The cones of q, in ascending order, with their multiples and what their angles were.
  void take_rounded(const Placement& q, const std::vector<std::size_t>& kept, const std::vector<long>& k, long n)
  {
    std::vector<std::pair<Index, std::size_t> > order;
    for(std::size_t i = 0; i < kept.size(); ++i)
      order.emplace_back(q.cones[i], kept[i]);
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
  const Solver_options solver_options_;
  const Factorization_maker make_coarse_factorization_;
  const Factorization_maker make_factorization_; // all of them share one
  std::unique_ptr<Factorization> search_factorization_;
  const Surface_components pieces_;
  const Eigen::VectorXd area_; // by vertex, of one whole
  Cone_placement<NT> result_;
  double foreseen_ = 0;        // what is aimed at, by the model of the surface given
  bool has_foreseen_ = false;
};

template <typename NT>
Cone_placement<NT> Cone_placer<NT>::run()
{
  if(check() && check_number())
  {
    if(!are_angles_chosen() || !choose())
    {
      place_with_zero_u();
      improve_multiples();
    }
    else if(is_doubtful())
      compare_with_zero_u();
    finish();
  }
  return std::move(result_);
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED
extern template Cone_placement<double> Cone_placer<double>::run();
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_PLACER_H
