// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file repair_locally.h
/// The remedy of section 3.2 of Springborn, Schroeder and Pinkall, 2008, for triangulations on which the minimizer violates
/// triangle inequalities: the edges opposite to angles of pi are flipped or split, on the surface given, and the problem is
/// solved again. (What always helps, with fewer triangles, are the Ptolemy flips of `Retriangulation`.)

#ifndef CGAL_CONFORMAL_EQUIVALENCE_REPAIR_LOCALLY_H
#define CGAL_CONFORMAL_EQUIVALENCE_REPAIR_LOCALLY_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Delaunay_flipper.h>
#include <CGAL/Conformal_equivalence/internal/Repair/edge_changes.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <CGAL/use.h>

#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceSolver
///
/// One change of a triangulation that leaves the surface as it is: an edge was flipped, or split by a new vertex. Numbers are
/// those at the time of the change, see `Intrinsic_triangulation::flip_edge()` and `Intrinsic_triangulation::split_edge()`.
template <typename NT_ = double>
struct Edge_change
{
  typedef NT_ NT;               ///< number type of the lengths
  typedef std::uint32_t Index;  ///< of vertices and edges

  /// the kinds of changes
  enum Kind
  {
    FLIP, ///< the edge became the other diagonal of its two triangles
    SPLIT ///< the edge was cut in two by a new vertex, which was joined with the vertices opposite to the edge
  };

  Kind kind;                      ///< what was done
  Index edge;                     ///< to which edge
  std::array<Index, 2> vertices;  ///< the ends of the edge before: origin and target of its `edge_halfedge()`
  Index new_vertex;               ///< of a split; `null_index` for a flip
  NT parameter;                   ///< where on the edge the new vertex is: 0 at the origin, 1 at the target; 0 for a flip
};

/// \ingroup PkgConformalEquivalenceSolver
///
/// What `repair_locally()` returns.
template <typename NT_ = double>
struct Repaired_metric
{
  typedef NT_ NT;               ///< number type of lengths and of u
  typedef std::uint32_t Index;  ///< of vertices, edges and faces

  /// the metric, or why there is none, as `Conformal_metric_solver::solve()` tells for the triangulation as it was changed
  Conformal_metric<NT> metric;
  Conformal_conditions<NT> conditions;      ///< those given, and those of the new vertices, which have the last numbers
  std::vector<Edge_change<NT> > changes;    ///< in order
  std::vector<Index> input_edges;           ///< by edge: the edge given that it is, or is a part of; `null_index` if none

  /// the triangulation as it was changed, with the lengths on the surface given.
  const Intrinsic_triangulation<NT>& triangulation() const { return metric.triangulation; }

  /// the number of changes that are flips.
  std::size_t number_of_flips() const
  {
    return std::size_t(std::count_if(changes.begin(), changes.end(), [](const Edge_change<NT>& c) { return c.kind == c.FLIP; }));
  }
  /// the number of changes that are splits.
  std::size_t number_of_splits() const { return changes.size() - number_of_flips(); }

  /// is `true` iff the metric is usable.
  explicit operator bool() const { return bool(metric); }
};

namespace internal {

// Solves and repairs in turns.
template <typename NT>
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
  std::size_t budget_;
  std::vector<char> is_kept_;   // by edge: not to be flipped
  std::vector<char> is_taken_;  // by face: changed in this round, or beside such a face
  std::vector<double> u_;       // where the next solve begins; empty: anywhere
  std::set<std::pair<Index, Index> > flipped_away_; // ends of edges
  Repaired_metric<NT> result_;

public:
  Local_repair(Triangulation t, Conformal_conditions<NT> conditions, std::vector<char> is_kept, std::size_t budget)
    : t_(std::move(t)), budget_(budget), is_kept_(std::move(is_kept))
  {
    result_.conditions = std::move(conditions);
    result_.input_edges.resize(t_.number_of_edges());
    std::iota(result_.input_edges.begin(), result_.input_edges.end(), Index(0));
  }

  template <typename NamedParameters>
  Repaired_metric<NT> run(const NamedParameters& given_np)
  {
    const auto np = Conformal_equivalence::combine_named_parameters(given_np, parameters::retriangulation(Retriangulation::NEVER));
    std::size_t iterations = 0;
    double seconds = 0;
    read_initial_guess(given_np);
    for(;;)
    {
      result_.metric = u_.empty() ? compute_conformal_metric(t_, result_.conditions, np) : solve_from_guess(np);
      Statistics& statistics = result_.metric.statistics;
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
  template <typename NamedParameters>
  void read_initial_guess(const NamedParameters& np)
  {
    CGAL_USE(np);
    if constexpr(!parameters::is_default_parameter<NamedParameters, internal_np::conformal_initial_u_t>::value)
      for(Index v = 0; v < t_.number_of_vertices(); ++v)
        u_.push_back(static_cast<double>(get(parameters::get_parameter(np, internal_np::conformal_initial_u), v)));
  }

  template <typename NamedParameters>
  Conformal_metric<NT> solve_from_guess(const NamedParameters& np) const
  {
    const auto guess = boost::make_function_property_map<Index, double>([this](Index v) { return u_[v]; });
    return compute_conformal_metric(t_, result_.conditions,
      Conformal_equivalence::combine_named_parameters(np, parameters::initial_log_scale_factor_map(guess)));
  }

  // ---- One round

  // Changes an edge for every straight angle, the worst first, but no two in adjacent triangles. Returns whether there was any.
  bool change_some()
  {
    const std::size_t before = result_.changes.size();
    const std::vector<Straight_angle> angles = straight_angles();
    const std::vector<NT>& u = result_.metric.log_scale_factors;
    if(!u.empty())
    {
      u_.clear();
      for(const NT& x : u)
        u_.push_back(static_cast<double>(x));
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
      const Index h = 3 * f + k;
      l[k] = Wide(t_.halfedge_length(h));
      if(!metric.scale_factors.empty())
        l[k] = wide_length(t_, metric.scale_factors, h);
      else if(!metric.log_scale_factors.empty())
        l[k] = l[k] * Wide(exp((metric.log_scale_factors[t_.origin(h)] + metric.log_scale_factors[t_.target(h)]) / 2));
    }
    const int k = longest_side(l[0], l[1], l[2]);
    return {static_cast<double>(Wide(-excess(l[k], l[(k + 1) % 3], l[(k + 2) % 3]) / l[k])), 3 * f + Index(k)};
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
    const NT &a = t_.halfedge_length(3 * f), &b = t_.halfedge_length(3 * f + 1), &c = t_.halfedge_length(3 * f + 2);
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
    if(!u_.empty())
      u_.push_back(static_cast<double>((1 - parameter) * u_[i] + parameter * u_[j]));
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

/// \ingroup PkgConformalEquivalenceSolver
///
/// finds the metric conformally equivalent to that of `t` with the given conditions, as `compute_conformal_metric()` does; where
/// the minimizer breaks triangles, changes the triangulation there, and solves again (section 3.2).
///
/// For each broken triangle, the worst first, the edge opposite to the angle of pi is replaced. The lengths are those on the
/// surface given, whose geometry is not changed:
///  - the edge is flipped if the quadrilateral of its two triangles is strictly convex, decided exactly, the new edge is no loop
///    and no second edge between its ends (so that a mesh can hold the result), and there was no edge between them before;
///  - otherwise it is split: at the foot of the perpendicular from the vertex opposite that is closer, if that is in the inner
///    eight tenths of the edge, else at the midpoint; but not where this vertex is closer than 1e-9 of the length of the edge;
///  - if it cannot be split either, it may be flipped back.
///
/// No two edges of adjacent triangles are changed before the next solve, which begins at the last u. A vertex where the angle is
/// larger than its triangles can have is treated in the same way: the edges opposite to it are replaced.
///
/// New vertices are no cones. On the border u is interpolated if it is fixed at both ends of the edge split (so a natural border
/// keeps its lengths); otherwise the angle there is pi.
///
/// The result is conformally equivalent to `t` on another triangulation: `Statistics::conformal_class` is `REPAIRED` if anything
/// was changed. `Statistics::number_of_discarded_iterations` counts the Newton steps of all solves but the last. The method is a
/// heuristic: there are surfaces for which no number of changes suffices (a border edge whose triangle has no area, and keeps its
/// lengths).
///
/// \param t the surface. It is not modified: changes are made on a copy.
/// \param conditions one per vertex of `t`
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of `compute_conformal_metric()` but
///        `retriangulation`, and the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{maximum_number_of_changes}
///     \cgalParamDescription{how many edges may be flipped or split}
///     \cgalParamType{`std::size_t`}
///     \cgalParamDefault{one tenth of the number of edges, and 100}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_is_constrained_map}
///     \cgalParamDescription{`true` for edges that may be split, but not flipped}
///     \cgalParamType{a readable property map with key type `std::uint32_t` and value type `bool`}
///     \cgalParamDefault{`false` for all edges}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the metric, the conditions and the changes. The status, `metric.status`, is that of the last solve, see
///         `Conformal_metric_solver::solve()`. `DEGENERATE_METRIC`, `ITERATIONS_EXHAUSTED` and `ANGLE_OUT_OF_RANGE` with a
///         positive amount mean that the number of changes was exhausted, or that nothing could be changed: lengths of `t`
///         violate the triangle inequality there.
///
/// \pre as for `Conformal_metric_solver`
///
/// Time is that of one solve for each round of changes, seldom more than a few.
template <typename NT, typename NamedParameters = parameters::Default_named_parameters>
Repaired_metric<NT> repair_locally(Intrinsic_triangulation<NT> t,
                                   Conformal_conditions<NT> conditions,
                                   const NamedParameters& np = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  const std::size_t budget = choose_parameter(get_parameter(np, internal_np::conformal_number_of_changes),
                                              std::size_t(t.number_of_edges() / 10) + 100);
  try
  {
    std::vector<char> is_kept(t.number_of_edges(), 0);
    if constexpr(!parameters::is_default_parameter<NamedParameters, internal_np::edge_is_constrained_t>::value)
      for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
        is_kept[e] = get(get_parameter(np, internal_np::edge_is_constrained), e) ? 1 : 0;
    return internal::Local_repair<NT>(std::move(t), std::move(conditions), std::move(is_kept), budget).run(np);
  }
  catch(const std::bad_alloc&)
  {
    Repaired_metric<NT> nothing;
    nothing.metric.status = Status::OUT_OF_MEMORY;
    return nothing;
  }
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_REPAIR_LOCALLY_H
