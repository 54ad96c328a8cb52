// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The engine of `repair_locally()`: edges opposite to angles of pi are flipped or split, and the problem is solved again, until it has a
// solution (section 3.2 of Springborn, Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_REPAIR_LOCAL_REPAIR_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_REPAIR_LOCAL_REPAIR_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Repaired_metric.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/internal/Repair/edge_changes.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Delaunay_flipper.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// How many edges may be changed unless told otherwise.
template <typename NT>
std::size_t default_number_of_changes(const Intrinsic_triangulation<NT>& t) { return std::size_t(t.number_of_edges() / 10) + 100; }

// Solves and repairs in turns.
template <typename NT, typename SolverTraits>
class Local_repair
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;

  static constexpr Index null_index = Triangulation::null_index;

  // A side opposite to an angle of pi, and by how much, relatively, it is longer than the other two together.
  struct Straight_angle
  {
    double violation;
    Index halfedge;

    bool operator<(const Straight_angle& other) const
    {
      return violation != other.violation ? violation > other.violation : halfedge < other.halfedge;
    }
  };

  Triangulation t_;
  Solver_options options_;      // of the next solve, which begins at the last u, if there is one
  SolverTraits traits_;
  std::size_t budget_;
  std::vector<char> is_kept_;   // by edge: not to be flipped
  std::vector<char> is_taken_;  // by face: changed in this round, or beside such a face
  std::set<std::pair<Index, Index> > flipped_away_; // ends of edges
  Repaired_metric<NT> result_;

public:
  // `is_kept`: by edge, those that must not be flipped; `budget`: how many changes there may be
  Local_repair(Triangulation t, Conformal_conditions<NT> conditions, std::vector<char> is_kept, std::size_t budget,
               Solver_options options, const SolverTraits& traits)
    : t_(std::move(t)), options_(std::move(options)), traits_(traits), budget_(budget), is_kept_(std::move(is_kept))
  {
    options_.retriangulation = Retriangulation::NEVER;
    result_.conditions = std::move(conditions);
    result_.input_edges.resize(t_.number_of_edges());
    std::iota(result_.input_edges.begin(), result_.input_edges.end(), Index(0));
  }

  Repaired_metric<NT> run()
  {
    std::size_t iterations = 0;
    double seconds = 0;
    for(;;)
    {
      result_.metric = Conformal_metric_solver<NT, SolverTraits>(t_, traits_).solve(result_.conditions, options_);
      const Statistics& statistics = result_.metric.statistics;
      seconds += statistics.seconds.solve;
      if(is_success(result_.metric.status) || result_.changes.size() >= budget_ || !change_some())
        break;
      iterations += statistics.number_of_iterations;
    }
    result_.metric.triangulation = std::move(t_);
    Statistics& statistics = result_.metric.statistics;
    statistics.seconds.solve = seconds;
    statistics.number_of_discarded_iterations = iterations;
    statistics.number_of_flips = result_.number_of_flips();
    if(!result_.changes.empty())
      statistics.conformal_class = Conformal_class::REPAIRED;
    return std::move(result_);
  }

private:
  // ---- One round

  // Changes an edge for every straight angle, the worst first, but no two in adjacent triangles. Returns whether there was any.
  bool change_some()
  {
    const std::size_t before = result_.changes.size();
    const std::vector<Straight_angle> angles = straight_angles();
    const std::vector<NT>& u = result_.metric.log_scale_factors;
    if(!u.empty())
    {
      next_u().clear();
      for(const NT& x : u)
        next_u().push_back(static_cast<double>(x));
    }
    is_taken_.assign(t_.number_of_faces(), 0);
    for(const Straight_angle& angle : angles)
      if(result_.changes.size() < budget_ && !is_taken_[t_.face(angle.halfedge)] && is_changeable(t_.edge(angle.halfedge)))
        change(t_.edge(angle.halfedge));
    if(result_.changes.size() == before)
      return false;
    add_conditions(before);
    return true;
  }

  // Where the next solve begins; empty: anywhere.
  std::vector<double>& next_u() { return options_.initial_log_scale_factors; }

  std::vector<Straight_angle> straight_angles() const
  {
    const Conformal_metric<NT>& metric = result_.metric;
    std::vector<Straight_angle> result;
    if(metric.status == Status::DEGENERATE_METRIC || metric.status == Status::ITERATIONS_EXHAUSTED)
      for(const Index f : metric.faces)
        result.push_back(straight_angle(f));
    else if(metric.status == Status::ANGLE_OUT_OF_RANGE && metric.amount > 0) // too few triangles: all angles were to be pi
      for(const Index v : metric.vertices)
        t_.for_each_outgoing(v, [&](Index h) { result.push_back({1., t_.next(h)}); });
    std::sort(result.begin(), result.end());
    return result;
  }

  // The largest angle of a broken face, in the metric found as far as it is known.
  Straight_angle straight_angle(Index f) const
  {
    typedef typename Conformal_metric<NT>::Wide_number Wide;
    const Conformal_metric<NT>& metric = result_.metric;
    std::array<Wide, 3> l;
    for(Index k = 0; k < 3; ++k)
    {
      using std::exp;
      const Index h = t_.halfedge(f, k);
      l[k] = Wide(t_.halfedge_length(h));
      if(!metric.scale_factors.empty())
        l[k] = wide_length(t_, metric.scale_factors, h);
      else if(!metric.log_scale_factors.empty())
        l[k] = l[k] * Wide(exp((metric.log_scale_factors[t_.origin(h)] + metric.log_scale_factors[t_.target(h)]) / 2));
    }
    const int k = longest_side(l[0], l[1], l[2]);
    return {static_cast<double>(Wide(-excess(l[k], l[(k + 1) % 3], l[(k + 2) % 3]) / l[k])), t_.halfedge(f, Index(k))};
  }

  // ---- One edge

  // Are its faces triangles, on which something can be measured, and is nothing beside them changed in this round?
  bool is_changeable(Index e) const
  {
    const Index h = t_.edge_halfedge(e);
    if(!t_.is_border(h) && (t_.face(h) == t_.face(t_.twin(h)) || !is_free_triangle(t_.face(t_.twin(h)))))
      return false;
    return is_free_triangle(t_.face(h));
  }

  bool is_free_triangle(Index f) const
  {
    const NT &a = t_.halfedge_length(t_.halfedge(f)), &b = t_.halfedge_length(t_.halfedge(f, 1)), &c = t_.halfedge_length(t_.halfedge(f, 2));
    const NT rounding = -8 * std::numeric_limits<NT>::epsilon() * (std::max)((std::max)(a, b), c);
    return !is_taken_[f] && excess(a, b, c) >= rounding && excess(b, c, a) >= rounding && excess(c, a, b) >= rounding;
  }

  // Flips the edge, but not back to what was flipped away before; otherwise splits it; if neither can be done, flips it back.
  void change(Index e)
  {
    const std::vector<Index> around = faces_around(e);
    const bool may_flip = may_be_flipped(e);
    if(may_flip && !was_flipped_away(e))
      flip(e);
    else if(!split(e))
    {
      if(!may_flip)
        return;
      flip(e);
    }
    for(const Index f : around)
      is_taken_[f] = 1;
    is_taken_.resize(t_.number_of_faces(), 1);
  }

  // The faces of the edge, and those beside them.
  std::vector<Index> faces_around(Index e) const
  {
    std::vector<Index> result;
    for(Index h = t_.edge_halfedge(e); h != null_index; h = h == t_.edge_halfedge(e) ? t_.twin(h) : null_index)
    {
      result.push_back(t_.face(h));
      for(const Index side : {t_.next(h), t_.previous(h)})
        if(!t_.is_border(side))
          result.push_back(t_.face(t_.twin(side)));
    }
    return result;
  }

  // Flips make no loops and no double edges: the result is a mesh if what was given is one.
  bool may_be_flipped(Index e) const
  {
    if(is_kept_[e] || t_.is_border_edge(e))
      return false;
    const Index h = t_.edge_halfedge(e), k = t_.apex(h), l = t_.apex(t_.twin(h));
    return k != l && !are_joined(t_, k, l) && is_strictly_convex(t_, e) && euclidean_length(t_, e) > NT(0);
  }

  // Was there an edge before between the vertices opposite to this one?
  bool was_flipped_away(Index e) const
  {
    const Index h = t_.edge_halfedge(e);
    return flipped_away_.count(std::minmax({t_.apex(h), t_.apex(t_.twin(h))})) != 0;
  }

  void flip(Index e)
  {
    const Index h = t_.edge_halfedge(e);
    result_.changes.push_back({Edge_change<NT>::FLIP, e, {{t_.origin(h), t_.target(h)}}, null_index, NT(0)});
    flipped_away_.insert(std::minmax({t_.origin(h), t_.target(h)}));
    t_.flip_edge(e, euclidean_length(t_, e));
    result_.input_edges[e] = null_index;
  }

  // Not if a vertex opposite lies right there, or nearly so.
  bool split(Index e)
  {
    const Index h = t_.edge_halfedge(e), i = t_.origin(h), j = t_.target(h);
    const NT whole = t_.length(e), part = place_of_split(e);
    std::array<NT, 4> lengths = {{part, NT(whole - part), unfolded(h).distance(part), whole}};
    if(!t_.is_border(h))
      lengths[3] = unfolded(t_.twin(h)).distance(NT(whole - part));
    if(!(*std::min_element(lengths.begin(), lengths.end()) > whole * NT(1e-9)))
      return false;
    const NT parameter = part / whole;
    const Index m = t_.split_edge(e, lengths);
    result_.changes.push_back({Edge_change<NT>::SPLIT, e, {{i, j}}, m, parameter});
    result_.input_edges.push_back(result_.input_edges[e]);
    is_kept_.push_back(is_kept_[e]);
    result_.input_edges.resize(t_.number_of_edges(), null_index);
    is_kept_.resize(t_.number_of_edges(), 0);
    if(!next_u().empty())
      next_u().push_back(static_cast<double>((1 - parameter) * next_u()[i] + parameter * next_u()[j]));
    return true;
  }

  Unfolded_apex<NT> unfolded(Index h) const
  {
    return Unfolded_apex<NT>(t_.halfedge_length(h), t_.halfedge_length(t_.next(h)), t_.halfedge_length(t_.previous(h)));
  }

  // The foot of the perpendicular from the closer one of the vertices opposite to `e`, if it is well inside; else the midpoint.
  // Told as the distance from the origin of `edge_halfedge(e)`.
  NT place_of_split(Index e) const
  {
    const Index h = t_.edge_halfedge(e);
    const NT& whole = t_.length(e);
    Unfolded_apex<NT> apex = unfolded(h);
    NT foot = apex.foot();
    if(!t_.is_border(h))
    {
      const Unfolded_apex<NT> other = unfolded(t_.twin(h));
      if(other.height() < apex.height())
      {
        apex = other;
        foot = whole - other.foot();
      }
    }
    const bool is_well_inside = foot > whole / 10 && whole - foot > whole / 10;
    return is_well_inside ? foot : NT(whole / 2);
  }

  // ---- Conditions

  // New vertices are flat. On the border u is interpolated where it is fixed at both ends of the edge; otherwise the border is
  // straight there.
  void add_conditions(std::size_t first_change)
  {
    const Conformal_conditions<NT> given = std::move(result_.conditions);
    Conformal_conditions<NT>& c = result_.conditions;
    c = Conformal_conditions<NT>(t_);
    for(Index v = 0; v < given.size(); ++v)
      if(given.is_fixed(v))
        c.fix_log_scale_factor(v, given.log_scale_factor(v));
      else if(given.is_bounded(v))
        c.prescribe_angle_sum_above(v, given.angle_sum(v), given.lower_bound(v));
      else
        c.prescribe_angle_sum(v, given.angle_sum(v));
    for(std::size_t n = first_change; n < result_.changes.size(); ++n)
    {
      const Edge_change<NT>& x = result_.changes[n];
      if(x.kind != x.SPLIT || !t_.is_border_vertex(x.new_vertex))
        continue;
      const Index i = x.vertices[0], j = x.vertices[1];
      if(c.is_fixed(i) && c.is_fixed(j))
        c.fix_log_scale_factor(x.new_vertex, NT((1 - x.parameter) * c.log_scale_factor(i) + x.parameter * c.log_scale_factor(j)));
      else
        c.prescribe_angle_sum(x.new_vertex, Exact_angle<NT>::pi_times(1));
    }
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_REPAIR_LOCAL_REPAIR_H
