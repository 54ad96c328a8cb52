// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A surface of genus 0 as an inscribed polyhedron: points of the sphere at its vertices, whose chords are discretely conformally equivalent to the
// edges (section 4.3 of Springborn, Schroeder and Pinkall, 2008).
//
// One vertex, the apex p, is sent to infinity. The edges l_ip become infinitely long parallels; u_i = -2 log l_ip at the link of p says that they
// begin at the same height (up to a constant for all: their typical length is the unit, so that u does not depend on scale). What remains of the surface is a disk, flat where it is inside:
//
//            p                            |   |     |   |
//          / | \ .                        |   |     |   |          the disk is laid out in the plane, and
//        /   |   \                        i---j-----k---l          projected to the sphere from the pole,
//       i----j----k     ---> infinity      \  | \  / \ /           where p is.
//        \  / \  /                          \ |  \/   /
//          .....                              . . . .
//
// On the triangulation as it is, triangles of the result may be flipped. With flips, the polyhedron is convex for every surface
// (I. Rivin, 1996; Springborn, 2020, section 7): u minimizes the energy of the rest of the surface subject to u_i + 2 log l_ip >= 0 for the edges ip of
// the current triangulation, and the active conditions make the link. Here the link is found by exchange: it is kept while
// the disk is made flat, then
//  - a link edge jk on which the triangle jkm has become longer than its other two sides is flipped to pm: m would violate its condition;
//  - an edge ip where the disk has an angle above pi is flipped, too: i is not held any more.
// The link of a vertex with well-shaped triangles hardly ever changes.
//
// A surface with one border is treated in the same way with an apex on the border, where all other angles but those of the link are to be pi: the
// disk is then the part above a straight line of one that is symmetric about it, and the border becomes a circle.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IDEAL_POLYHEDRON_FINDER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IDEAL_POLYHEDRON_FINDER_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/compute_layout.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Delaunay_flipper.h>
#include <CGAL/Conformal_equivalence/internal/solver_traits_of.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/length_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/pieces.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/wedges.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <boost/property_map/function_property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The surface without the triangles at one vertex. Vertices keep their numbers; the apex becomes isolated.
template <typename NT>
struct Punctured_surface
{
  typedef std::uint32_t Index;

  Intrinsic_triangulation<NT> triangulation;
  std::vector<Index> original_edge; // by edge
  std::vector<Index> original_face; // by face

  Punctured_surface(const Intrinsic_triangulation<NT>& t, Index apex)
  {
    std::vector<Index> new_face(t.number_of_faces(), t.null_index);
    for(Index f = 0; f < t.number_of_faces(); ++f)
      if(t.origin(3 * f) != apex && t.origin(3 * f + 1) != apex && t.origin(3 * f + 2) != apex)
      {
        new_face[f] = Index(original_face.size());
        original_face.push_back(f);
      }
    std::vector<Index> origin, twin;
    for(Index f : original_face)
      for(Index h = 3 * f; h < 3 * f + 3; ++h)
      {
        const Index g = t.twin(h);
        origin.push_back(t.origin(h));
        twin.push_back(g == t.null_index || new_face[g / 3] == t.null_index ? t.null_index : 3 * new_face[g / 3] + g % 3);
      }
    triangulation = Intrinsic_triangulation<NT>(t.number_of_vertices(), std::move(origin), std::move(twin));
    original_edge.resize(triangulation.number_of_edges());
    for(Index e = 0; e < triangulation.number_of_edges(); ++e)
    {
      const Index h = triangulation.edge_halfedge(e);
      original_edge[e] = t.edge(3 * original_face[h / 3] + h % 3);
      triangulation.set_length(e, t.length(original_edge[e]));
    }
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      has_all_others_ = has_all_others_ && (v == apex || t.is_isolated_vertex(v) || !triangulation.is_isolated_vertex(v));
  }

  // Is it one disk that has all vertices but the apex?
  bool is_disk() const
  {
    if(triangulation.number_of_faces() == 0 || !has_all_others_ || !non_manifold_vertices(triangulation).empty())
      return false;
    const Surface_components pieces = connected_components(triangulation);
    return pieces.components.size() == 1 && pieces.components[0].is_disk();
  }

private:
  bool has_all_others_ = true; // vertices
};

// The points, not normalized, as vectors of the light cone with -2 <v_i, v_j> = l_ij^2.
template <typename NT>
struct Ideal_polyhedron
{
  typedef std::uint32_t Index;
  typedef typename Wider_number<NT>::type Wide;

  Index apex = Intrinsic_triangulation<NT>::null_index;
  double unit = 1;                            // how long edges of the apex are whose other ends have u = 0
  Intrinsic_triangulation<NT> triangulation;  // of the whole surface, flipped
  std::vector<Index> flips;                   // how it came from the one given
  std::vector<Light_vector<Wide> > vectors;   // by vertex; 0 for isolated ones
  std::size_t number_of_exchanges = 0;        // how often the link of the apex was changed
  Status status = Status::OK;
  double amount = 0;
  std::vector<Index> vertices, faces;         // at fault; faces of the triangulation given, if it was not flipped
  Statistics statistics;
};

// The vertices that are to lie on one circle, the image of a line of symmetry or of a straight border: the apex, and others. From `first` to
// `last`, its neighbours there, the surface, or the half of it that counts, is on the left.
struct Symmetry_axis
{
  std::vector<char> contains; // by vertex; empty: there is no axis
  std::uint32_t first = 0, last = 0;

  bool empty() const { return contains.empty(); }
};

// The border of `t`, with an apex on it.
template <typename NT>
Symmetry_axis border_axis(const Intrinsic_triangulation<NT>& t, std::uint32_t apex)
{
  Symmetry_axis axis;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    axis.contains.push_back(t.is_border_vertex(v));
  std::uint32_t last = t.vertex_halfedge(apex);
  axis.first = t.target(last); // along the border
  t.for_each_outgoing(apex, [&](std::uint32_t h) { last = h; });
  axis.last = t.apex(last);
  return axis;
}

template <typename NT, typename NamedParameters>
class Ideal_polyhedron_finder
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;
  typedef Conformal_metric<NT> Metric;
  typedef Ideal_polyhedron<NT> Polyhedron;
  typedef typename Polyhedron::Wide Wide;
  typedef Solver_traits_of<NamedParameters> Solver_traits;

public:
  // `np`: those of the solver
  Ideal_polyhedron_finder(const Triangulation& t, const NamedParameters& np) : given_(t), np_(np) {}

  // On the triangulation as it is.
  Polyhedron on_fixed_triangulation(Index apex, const Symmetry_axis& axis) const
  {
    Polyhedron result;
    result.apex = apex;
    result.triangulation = given_;
    result.unit = typical_spoke(given_, apex);
    const Punctured_surface<NT> rest(given_, apex);
    if(!rest.is_disk())
      return refused(std::move(result), Status::SINGULAR_PROBLEM);
    const Metric metric = compute_conformal_metric(rest.triangulation, conditions(result, rest.triangulation),
                                                   Conformal_equivalence::combine_named_parameters(solver_parameters(), parameters::retriangulation(Retriangulation::NEVER)));
    take_over(metric, result);
    for(Index f : metric.faces)
      result.faces.push_back(rest.original_face[f]);
    if(is_success(result.status))
      place(metric, axis, result);
    return result;
  }

  // With flips: the convex polyhedron. `start` is a triangulation that `flips` have made of the one given.
  Polyhedron convex(Triangulation start, std::vector<Index> flips, Index apex, const Symmetry_axis& axis) const
  {
    Polyhedron result;
    result.apex = apex;
    result.triangulation = std::move(start);
    result.flips = std::move(flips);
    std::vector<double> u;
    const int most = 100;
    for(int round = 0; round < most; ++round)
    {
      tidy_star(result);
      widen_star(result);
      if(round == 0)
        result.unit = typical_spoke(result.triangulation, apex);
      const Punctured_surface<NT> rest(result.triangulation, apex);
      if(!rest.is_disk())
        return refused(std::move(result), Status::SINGULAR_PROBLEM);
      const Metric metric = solve(rest.triangulation, conditions(result, rest.triangulation), u);
      take_over(metric, result);
      if(!is_success(metric.status) && metric.status != Status::DEGENERATE_METRIC)
        return result;
      repeat_flips(rest, metric, result);
      if(!exchange(rest, metric, result))
      {
        if(is_success(result.status))
          place(metric, axis, result);
        return result;
      }
      ++result.number_of_exchanges;
      u.resize(metric.log_scale_factors.size());
      for(std::size_t v = 0; v < u.size(); ++v)
        u[v] = static_cast<double>(metric.log_scale_factors[v]);
    }
    return refused(std::move(result), Status::ITERATIONS_EXHAUSTED);
  }

private:
  static Polyhedron refused(Polyhedron result, Status status)
  {
    result.status = status;
    result.vertices.assign(1, result.apex);
    return result;
  }

  // Points are to be right relative to the smallest chords; what the user asks for is judged at the end.
  auto solver_parameters() const
  {
    return Conformal_equivalence::combine_named_parameters(np_, parameters::gradient_tolerance(
      (std::min)(wanted_tolerance(), std::is_same<NT, double>::value ? 1e-24 : 0.)));
  }

  double wanted_tolerance() const
  {
    return parameters::choose_parameter(parameters::get_parameter(np_, internal_np::conformal_gradient_tolerance), 1e-12);
  }

  // The geometric mean of the lengths of the edges at the apex, to a power of two.
  static double typical_spoke(const Triangulation& t, Index apex)
  {
    double sum = 0, number = 0;
    t.for_each_outgoing(apex, [&](Index h)
    {
      sum += std::log2(static_cast<double>(t.halfedge_length(h)));
      number += 1;
    });
    return std::isfinite(sum) && number > 0 ? std::exp2(std::round(sum / number)) : 1;
  }

  // What is left of the surface is flat, with a straight border but for the link of the apex.
  Conformal_conditions<NT> conditions(const Polyhedron& polyhedron, const Triangulation& rest) const
  {
    using std::log;
    const Triangulation& t = polyhedron.triangulation;
    const Index apex = polyhedron.apex;
    Conformal_conditions<NT> result(rest);
    for(Index v = 0; v < rest.number_of_vertices(); ++v)
      if(!rest.is_isolated_vertex(v) && rest.is_border_vertex(v))
        result.prescribe_angle_sum(v, Exact_angle<NT>::pi_times(1));
    t.for_each_outgoing(apex, [&](Index h)
    {
      for(Index e : {t.edge(h), t.edge(t.previous(h))})
        result.fix_log_scale_factor(t.origin(t.edge_halfedge(e)) == apex ? t.target(t.edge_halfedge(e)) : t.origin(t.edge_halfedge(e)),
                                    NT(-2 * log(NT(t.length(e) / polyhedron.unit))));
    });
    return result;
  }

  Metric solve(Triangulation rest, const Conformal_conditions<NT>& conditions, const std::vector<double>& u) const
  {
    Conformal_metric_solver<NT, Solver_traits> solver(std::move(rest), solver_traits_of(np_));
    Solver_options options = read_solver_options(solver_parameters(), solver.triangulation().number_of_vertices());
    options.retriangulation = Retriangulation::WHEN_NEEDED;
    options.border_edges = Border_edges::KEPT;
    options.has_come_from_flips = true;
    if(!u.empty())
      options.initial_log_scale_factors = u;
    return std::move(solver).solve(conditions, options);
  }

  void take_over(const Metric& metric, Polyhedron& result) const
  {
    const Statistics before = result.statistics;
    result.statistics = metric.statistics;
    result.statistics.number_of_iterations += before.number_of_iterations;
    result.statistics.number_of_linear_iterations += before.number_of_linear_iterations;
    result.statistics.number_of_factorizations += before.number_of_factorizations;
    result.statistics.number_of_evaluations += before.number_of_evaluations;
    result.statistics.number_of_filter_failures += before.number_of_filter_failures;
    result.statistics.number_of_exact_decisions += before.number_of_exact_decisions;
    result.statistics.seconds.flips += before.seconds.flips;
    result.status = metric.status;
    result.amount = metric.amount;
    result.vertices = metric.vertices;
    if(metric.status == Status::CONVERGED_TO_ROUNDING && metric.statistics.residual <= wanted_tolerance())
    {
      result.status = Status::OK;
      result.amount = 0;
    }
  }

  // ---- Flips of the whole surface

  static void flip(Index e, Polyhedron& result)
  {
    Triangulation& t = result.triangulation;
    t.flip_edge(e, ptolemy_length(t, e));
    result.flips.push_back(e);
  }

  static void repeat_flips(const Punctured_surface<NT>& rest, const Metric& metric, Polyhedron& result)
  {
    for(Index e : metric.flips)
      flip(rest.original_edge[e], result);
    for(Index e = 0; e < rest.original_edge.size(); ++e)
      result.triangulation.set_length(rest.original_edge[e], metric.triangulation.length(e));
  }

  // Flips loops of the apex, and of several edges to the same vertex all but the shortest: these are inactive for certain.
  static void tidy_star(Polyhedron& result)
  {
    const Triangulation& t = result.triangulation;
    for(std::size_t flips = 0; flips < 10 * std::size_t(t.number_of_edges()); ++flips)
    {
      const Index e = edge_to_tidy(t, result.apex);
      if(e == t.null_index)
        return;
      flip(e, result);
    }
  }

  static Index edge_to_tidy(const Triangulation& t, Index apex)
  {
    std::vector<std::pair<Index, Index> > ends; // of flippable edges: the vertex, and the edge
    Index loop = t.null_index;
    t.for_each_outgoing(apex, [&](Index h)
    {
      if(t.target(h) == apex && t.is_flippable(t.edge(h)))
        loop = t.edge(h);
      else
        ends.emplace_back(t.target(h), t.edge(h));
    });
    if(loop != t.null_index)
      return loop;
    std::sort(ends.begin(), ends.end(), [&](const auto& a, const auto& b)
      { return a.first != b.first ? a.first < b.first : t.length(a.second) < t.length(b.second); });
    for(std::size_t i = 1; i < ends.size(); ++i)
      if(ends[i].first == ends[i - 1].first && t.is_flippable(ends[i].second))
        return ends[i].second;
    return t.null_index;
  }

  // An apex needs three neighbours. Where it has less, triangles beyond its link are added to its star, the shortest new edges first.
  static void widen_star(Polyhedron& result)
  {
    for(Index e = 0; e != Triangulation::null_index && result.triangulation.degree(result.apex) < 3; )
    {
      e = edge_to_widen(result.triangulation, result.apex);
      if(e != Triangulation::null_index)
        flip(e, result);
    }
  }

  static Index edge_to_widen(const Triangulation& t, Index apex)
  {
    std::vector<Index> neighbours(1, apex), link;
    t.for_each_outgoing(apex, [&](Index h)
    {
      neighbours.push_back(t.target(h));
      link.push_back(t.next(h));
    });
    Index best = t.null_index;
    for(Index h : link)
    {
      const Index e = t.edge(h);
      if(t.is_flippable(e) && std::find(neighbours.begin(), neighbours.end(), t.apex(t.twin(h))) == neighbours.end()
         && (best == t.null_index || ptolemy_length(t, e) < ptolemy_length(t, best)))
        best = e;
    }
    return best;
  }

  // The exchange described above. Returns whether there was anything to do.
  static bool exchange(const Punctured_surface<NT>& rest, const Metric& metric, Polyhedron& result)
  {
    const Triangulation& disk = metric.triangulation;
    std::vector<char> is_touched(disk.number_of_vertices(), 0);
    bool is_changed = false;
    std::vector<char> is_neighbour(disk.number_of_vertices(), 0); // a second edge to these would be flipped away again
    result.triangulation.for_each_outgoing(result.apex, [&](Index h)
    {
      is_neighbour[result.triangulation.target(h)] = is_neighbour[result.triangulation.apex(h)] = 1;
    });
    for(Index e = 0; e < disk.number_of_edges(); ++e)
    {
      const Index h = disk.edge_halfedge(e);
      const double rounding = is_neighbour[disk.apex(h)] ? 1e-14 : 0;
      if(!disk.is_border(h) || !result.triangulation.is_flippable(rest.original_edge[e]) || !is_too_long(metric, h, rounding))
        continue;
      flip(rest.original_edge[e], result);
      is_touched[disk.origin(h)] = is_touched[disk.target(h)] = 1;
      is_changed = true;
    }
    std::vector<Index> spokes;
    result.triangulation.for_each_outgoing(result.apex, [&](Index h) { spokes.push_back(result.triangulation.edge(h)); });
    for(Index e : spokes)
    {
      const Triangulation& t = result.triangulation;
      const Index h = t.origin(t.edge_halfedge(e)) == result.apex ? t.edge_halfedge(e) : t.twin(t.edge_halfedge(e));
      if(h == t.null_index || !t.is_flippable(e))
        continue;
      const Index i = t.target(h), j = t.apex(h), k = t.apex(t.twin(h));
      if(disk.is_isolated_vertex(i) || is_touched[i] || is_touched[j] || is_touched[k] || !is_reflex(metric, i))
        continue;
      flip(e, result);
      is_touched[i] = is_touched[j] = is_touched[k] = 1;
      is_changed = true;
    }
    return is_changed;
  }

  static bool is_too_long(const Metric& metric, Index h, double rounding)
  {
    const Triangulation& t = metric.triangulation;
    return metric.wide_scaled_length(t.next(h)) + metric.wide_scaled_length(t.previous(h)) < (1 - rounding) * metric.wide_scaled_length(h);
  }

  // Is the angle of the disk above pi, by more than the residual lets it be?
  static bool is_reflex(const Metric& metric, Index v)
  {
    const double rounding = 1e-13;
    return angle_sum_at(metric, v) > Number_constants<double>::pi() + rounding;
  }

  // ---- From the metric to points

  static void place(const Metric& metric, const Symmetry_axis& axis, Polyhedron& result)
  {
    typedef Complex_number<Wide> Complex;
    const Triangulation& disk = metric.triangulation;
    const Cut_graph nothing;
    const Wedges wedges = find_wedges(disk, nothing);
    Development<NT> development(metric, nothing, wedges);
    development(find_pieces(disk, nothing, wedges).front().central_face);
    std::vector<Complex> position(disk.number_of_vertices(), Complex{Wide(0), Wide(0)});
    for(Index h = 0; h < disk.number_of_halfedges(); ++h)
      position[disk.target(h)] = development.position[wedges.of_corner[h]];

    const double size = axis.empty() ? put_in_the_middle(disk, position) : put_on_axis(disk, axis, position);
    result.vectors.assign(disk.number_of_vertices(), Light_vector<Wide>{{Wide(0), Wide(0), Wide(0), Wide(0)}});
    const Wide root = sqrt_of(Wide(size));
    for(Index v = 0; v < disk.number_of_vertices(); ++v)
      if(!disk.is_isolated_vertex(v))
        result.vectors[v] = light_vector(Complex{position[v].re / size, position[v].im / size}, Wide(metric.scale_factors[v] / root));
    const Wide weight = Wide(result.unit) * result.unit / (2 * Wide(size));
    result.vectors[result.apex] = {{Wide(0), Wide(0), -weight, weight}};
  }

  static Wide sqrt_of(const Wide& x)
  {
    using std::sqrt;
    return Wide(sqrt(x));
  }

  // Half of the vertices lie on each side of the median.
  static double median(std::vector<double>& x)
  {
    const auto middle = x.begin() + std::ptrdiff_t(x.size() / 2);
    std::nth_element(x.begin(), middle, x.end());
    return *middle;
  }

  // Moves the median vertex to the origin, and returns the median distance: with that for a unit, half of the vertices lie on
  // each hemisphere.
  static double put_in_the_middle(const Triangulation& disk, std::vector<Complex_number<Wide> >& position)
  {
    std::vector<double> x, y, r;
    for(Index v = 0; v < disk.number_of_vertices(); ++v)
      if(!disk.is_isolated_vertex(v))
      {
        x.push_back(static_cast<double>(position[v].re));
        y.push_back(static_cast<double>(position[v].im));
      }
    const Wide cx(median(x)), cy(median(y));
    for(Index v = 0; v < disk.number_of_vertices(); ++v)
      if(!disk.is_isolated_vertex(v))
      {
        position[v] = {position[v].re - cx, position[v].im - cy};
        r.push_back(size_of(position[v]));
      }
    return positive(median(r));
  }

  static double positive(double x) { return x > 0 && std::isfinite(x) ? x : 1; }

  // Turns the axis to the real one, with what counts above, and returns the median distance from the middle.
  static double put_on_axis(const Triangulation& disk, const Symmetry_axis& axis, std::vector<Complex_number<Wide> >& position)
  {
    typedef Complex_number<Wide> Complex;
    const Complex a = position[axis.first], b = position[axis.last];
    Complex direction{b.re - a.re, b.im - a.im};
    const Wide length = Wide(positive(size_of(direction)));
    direction = {direction.re / length, direction.im / length};
    const Wide unit = sqrt_of(Wide(direction.re * direction.re + direction.im * direction.im));
    direction = {direction.re / unit, -(direction.im / unit)};
    std::vector<double> x, r;
    for(Index v = 0; v < disk.number_of_vertices(); ++v)
      if(!disk.is_isolated_vertex(v))
      {
        position[v] = direction * Complex{position[v].re - a.re, position[v].im - a.im};
        if(axis.contains[v])
          position[v].im = Wide(0);
        x.push_back(static_cast<double>(position[v].re));
      }
    const Wide middle(median(x));
    for(Index v = 0; v < disk.number_of_vertices(); ++v)
      if(!disk.is_isolated_vertex(v))
      {
        position[v].re = position[v].re - middle;
        r.push_back(size_of(position[v]));
      }
    return positive(median(r));
  }

  const Triangulation& given_;
  const NamedParameters& np_;
};

// The vertices that suit best for the apex, the best one first: those with the thickest triangles around them, and around their neighbours. On
// a surface with a border only vertices there with more than one triangle.
template <typename NT>
std::vector<std::uint32_t> best_apices(const Intrinsic_triangulation<NT>& t, std::size_t number)
{
  typedef std::uint32_t Index;
  std::vector<double> thickness(t.number_of_vertices(), 1), around = thickness;
  bool has_border = false;
  for(Index h = 0; h < t.number_of_halfedges(); h += 3)
  {
    const Incircle_form<double> triangle(static_cast<double>(t.halfedge_length(h)), static_cast<double>(t.halfedge_length(h + 1)),
                                         static_cast<double>(t.halfedge_length(h + 2)));
    const double q = triangle.is_triangle ? triangle.r / triangle.s : 0; // at most 1 / sqrt(27)
    for(Index k = h; k < h + 3; ++k)
    {
      thickness[t.origin(k)] = (std::min)(thickness[t.origin(k)], std::isfinite(q) ? q : 0);
      has_border = has_border || t.is_border(k);
    }
  }
  around = thickness;
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    around[t.origin(h)] = (std::min)(around[t.origin(h)], thickness[t.target(h)]);
    around[t.target(h)] = (std::min)(around[t.target(h)], thickness[t.origin(h)]);
  }
  std::vector<Index> result;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v) && (has_border ? t.is_border_vertex(v) && t.degree(v) > 1 : t.degree(v) > 2))
      result.push_back(v);
  const std::size_t n = (std::min)(number, result.size());
  std::partial_sort(result.begin(), result.begin() + std::ptrdiff_t(n), result.end(), [&](Index v, Index w)
    { return around[v] != around[w] ? around[v] > around[w] : thickness[v] != thickness[w] ? thickness[v] > thickness[w] : v < w; });
  result.resize(n);
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IDEAL_POLYHEDRON_FINDER_H
