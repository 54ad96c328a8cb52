// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Metrics that need flips (discrete uniformization), and layouts of the given triangulation in them.

#define BOOST_TEST_MODULE test_flatten_retriangulated
#include "include/boost_test.h"
#include "include/flattened_meshes.h"
#include "include/flipped_metrics.h"
#include "include/solids.h"

#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/compute_cut_graph.h>
#include <CGAL/Conformal_equivalence/compute_layout.h>
#include <CGAL/Conformal_equivalence/discrete_metric.h>
#include <CGAL/Conformal_equivalence/flatten.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;
using namespace testing;
using CE::Retriangulation;
using CE::Status;

namespace {

typedef CE::Flattening_report<Mesh>       Report;

// The metric is what it should be: triangles, angle sums, Delaunay, on the triangulation that it has.
Metric solved(const Triangulation& t, const Conditions& conditions, Retriangulation mode)
{
  const Metric metric = CE::compute_conformal_metric(t, conditions, params::retriangulation(mode));
  BOOST_TEST_REQUIRE(bool(metric), CE::message(metric.status) << ", residual " << metric.statistics.residual);
  BOOST_TEST(metric.statistics.residual <= (std::max)(solver_tolerance, metric.statistics.residual_floor));
  const Triangulation& r = metric.triangulation;
  const auto length = [&](Index h) { return metric.scaled_length(h); };
  std::vector<double> sum(r.number_of_vertices(), 0), cotangents(r.number_of_edges(), 0), size(r.number_of_edges(), 0);
  double thinnest = 1;
  for(Index h = 0; h < r.number_of_halfedges(); ++h)
  {
    const double a = length(h), b = length(r.next(h)), c = length(r.previous(h)); // c and a meet at the origin
    const double s = (a + b + c) / 2, area = std::sqrt(s * (s - a) * (s - b) * (s - c));
    sum[r.origin(h)] += 2 * std::atan2(std::sqrt((s - a) * (s - c)), std::sqrt(s * (s - b)));
    cotangents[r.edge(h)] += (b * b + c * c - a * a) / (4 * area);
    size[r.edge(h)] += (b * b + c * c + a * a) / (4 * area);
    thinnest = (std::min)(thinnest, area / (s * s));
    BOOST_TEST(area > 0);
  }
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v) && !conditions.is_fixed(v))
      BOOST_TEST(std::abs(sum[v] - (metric.is_doubled && t.is_border_vertex(v) ? 2 : 1) * conditions.angle_sum(v).radians())
                 <= (std::max)(layout_angle, 100 * few_roundings / thinnest)); // of up to a hundred angles
    else if(!t.is_isolated_vertex(v))
      BOOST_TEST(metric.log_scale_factors[v] == conditions.log_scale_factor(v));
  const bool is_asked = metric.is_retriangulated() || mode == Retriangulation::ALWAYS;
  bool is_tie = false; // within rounding: areas of needles lose as many digits as the square of size says
  for(Index e = 0; is_asked && e < r.number_of_edges(); ++e)
    if(r.is_flippable(e))
    {
      const double rounding = few_roundings * std::pow(1 + size[e], 3);
      BOOST_TEST(cotangents[e] >= -rounding);
      is_tie = is_tie || cotangents[e] <= rounding;
    }
  const CE::Delaunay_property delaunay = metric.statistics.delaunay, within_rounding = CE::Delaunay_property::WITHIN_ROUNDING,
                              yes = is_tie && delaunay == within_rounding ? within_rounding : CE::Delaunay_property::EXACT;
  BOOST_TEST((delaunay == (is_asked ? yes : CE::Delaunay_property::NOT_ASKED)));
  return metric;
}

// The layout of the given triangulation: it closes around every vertex, and the two sides of each cut are congruent.
CE::Layout<double> checked_layout(const Triangulation& t, const Metric& metric, const std::vector<Index>& cones)
{
  const CE::Cut_graph cut = CE::compute_cut_graph(t, cones);
  BOOST_TEST_REQUIRE(bool(cut));
  const CE::Layout<double> layout = CE::compute_layout(t, metric, cut);
  const double unit = std::ldexp(diameter(layout.corner), -53);
  BOOST_TEST(layout.corner.size() == t.number_of_halfedges());
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    const Complex p = complex(layout.corner[t.previous(h)]), q = complex(layout.corner[h]);
    const double length = metric.is_retriangulated() ? layout.straight_lengths[t.edge(h)] : metric.scaled_length(h);
    BOOST_TEST(std::abs(std::abs(q - p) - length) <= 16 * unit + few_roundings * length);
  }
  for(const auto& motion : layout.transitions)
  {
    const Index h = motion.halfedge, g = t.twin(h);
    const Complex r = complex(motion.rotation), s = complex(motion.translation);
    BOOST_TEST(std::abs(r * complex(layout.corner[h]) + s - complex(layout.corner[t.previous(g)])) <= 16 * unit);
    BOOST_TEST(std::abs(r * complex(layout.corner[t.previous(h)]) + s - complex(layout.corner[g])) <= 16 * unit);
  }
  // angles around interior vertices, up to whole turns
  const std::vector<double> sums = CE::angle_sums(CE::apply_log_scale_factors(t, std::vector<double>(t.number_of_vertices(), 0)));
  std::vector<double> turned(t.number_of_vertices(), 0), shortest(t.number_of_vertices(), HUGE_VAL);
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    const Complex o = complex(layout.corner[t.previous(h)]), p = complex(layout.corner[h]), q = complex(layout.corner[t.next(h)]);
    turned[t.origin(h)] += std::arg((q - o) / (p - o));
    shortest[t.origin(h)] = (std::min)({shortest[t.origin(h)], std::abs(p - o), std::abs(q - o)});
  }
  std::vector<char> is_cone(t.number_of_vertices(), 0);
  for(Index v : cones)
    is_cone[v] = 1;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v) && !t.is_border_vertex(v) && !is_cone[v])
      BOOST_TEST(std::abs(std::remainder(turned[v], 2 * pi)) <= layout_angle + 64 * unit / shortest[v]);
  return layout;
}

} // namespace

// --- the energy ---------------------------------------------------------------------------------

namespace {

struct Silent_observer : public CE::internal::Flip_observer<double>
{
  std::size_t flips = 0;
  void before_flip(const Triangulation&, Index) override { ++flips; }
  void after_flip(const Triangulation&, Index) override {}
  void begin_anew(const Triangulation&) override {}
};

} // namespace

// A point on an edge that divides only one of both triangles leaves a triangle of no area. The metric found is that of the surface where both are
// divided, which is the same surface; a flat one is its own image.
BOOST_AUTO_TEST_CASE(faces_of_no_area)
{
  for(const double height : { 0., .3 })
    for(const std::size_t step : { 1, 2, 7, 50 })
    {
      Soup given = hill(8, height), divided = given;
      const std::size_t number = divide_at_middles(given, step, false);
      BOOST_TEST(divide_at_middles(divided, step, true) == number);
      const Triangulation t = triangulation(given), s = triangulation(divided);
      BOOST_TEST(CE::internal::degenerate_faces(t).size() == number);
      Conditions conditions(t), conditions_of_divided(s);
      const Metric metric = CE::compute_conformal_metric(t, conditions), expected = CE::compute_conformal_metric(s, conditions_of_divided);
      BOOST_REQUIRE(bool(metric));
      BOOST_REQUIRE(bool(expected));
      BOOST_TEST(metric.statistics.number_of_resolving_flips == number);
      BOOST_TEST(metric.flips.size() >= number);
      BOOST_TEST(CE::internal::degenerate_faces(metric.triangulation).empty());
      for(Index v = 0; v < t.number_of_vertices(); ++v) // up to the rounding of lengths and of angles, times the condition of a small grid
        BOOST_TEST(std::abs(metric.log_scale_factors[v] - expected.log_scale_factors[v]) <= 1e-12);
      if(height == 0)
        for(Index v = 0; v < t.number_of_vertices(); ++v)
          BOOST_TEST(std::abs(metric.log_scale_factors[v]) <= 1e-13);
      const Metric fixed = CE::compute_conformal_metric(t, conditions, params::retriangulation(CE::Retriangulation::NEVER));
      BOOST_TEST(fixed.flips.empty());
      BOOST_TEST(fixed.statistics.number_of_resolving_flips == 0u);
    }
}

// Many on one line, handed on from one to the next, and on the border, where they stay.
BOOST_AUTO_TEST_CASE(rows_of_faces_of_no_area)
{
  for(const Index n : { 2, 3, 10, 50 })
  {
    Soup soup; // a fan of triangles over a line from the first point to the last, and two triangles beyond it
    for(Index i = 0; i <= n; ++i)
      soup.points.push_back({{double(i) / n, 0, 0}});
    const Index top = n + 1, bottom = n + 2;
    soup.points.push_back({{.5, 1, 0}});
    soup.points.push_back({{.5, -1, 0}});
    for(Index i = 0; i < n; ++i)
      soup.triangles.push_back({{i, i + 1, top}});
    for(Index i = 1; i < n; ++i)
      soup.triangles.push_back({{i, 0, i + 1}}); // of no area
    soup.triangles.push_back({{n, 0, bottom}});
    const Triangulation t = triangulation(soup);
    Triangulation resolved = t;
    const std::vector<Index> flips = CE::internal::resolve_degenerate_faces(resolved);
    BOOST_TEST(flips.size() >= n - 1);
    BOOST_TEST(CE::internal::degenerate_faces(resolved).empty());
    const std::vector<double> sums = CE::angle_sums(resolved);
    for(Index v = 1; v < n; ++v)
      BOOST_TEST(std::abs(sums[v] - 2 * pi) <= 1e-6); // flat triangles turn a unit roundoff of a length into its root
  }
  const Soup border = {{{{0, 0, 0}}, {{2, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}}, {{{0, 1, 2}}, {{0, 2, 3}}, {{2, 1, 3}}}};
  Triangulation t = triangulation(border);
  BOOST_TEST(CE::internal::degenerate_faces(t).size() == 1u);
  BOOST_TEST(CE::internal::resolve_degenerate_faces(t).empty());
}

// Continued by flips, the energy is twice continuously differentiable: the derivative of the angle sums along a line, which crosses
// many cells, is that by the weights of the triangulation at each point, and their integral is the difference of the ends.
BOOST_AUTO_TEST_CASE(energy_across_flips)
{
  for(const Soup& soup : { icosphere(1), torus(7, 5) })
  {
    Triangulation t = triangulation(soup);
    Silent_observer observer;
    CE::internal::Ideal_delaunay_energy<double> energy(t, observer);
    const Index n = t.number_of_vertices();
    const std::vector<double> direction = random_numbers(n, 3, 17);
    const auto at = [&](double x)
    {
      std::vector<double> u(n);
      for(Index v = 0; v < n; ++v)
        u[v] = x * direction[v];
      BOOST_TEST_REQUIRE(energy.evaluate(u));
      BOOST_TEST(energy.broken_faces().empty());
      return energy.angle_sums();
    };
    const auto derivative = [&](double x) // of the angle sums, along the line
    {
      at(x);
      std::vector<double> result(n, 0);
      for(Index e = 0; e < t.number_of_edges(); ++e)
      {
        const Index i = t.origin(t.edge_halfedge(e)), j = t.target(t.edge_halfedge(e));
        const double flux = energy.weights()[e] * (direction[i] - direction[j]) / 2;
        result[i] -= flux;
        result[j] += flux;
      }
      return result;
    };
    const std::vector<double> first = at(0), last = at(1);
    BOOST_TEST(observer.flips > 30u);
    std::vector<double> integral(n, 0);
    const int steps = 4000; // Simpson's rule; the third derivatives jump where edges are flipped
    for(int k = 0; k <= steps; ++k)
    {
      const std::vector<double> d = derivative(double(k) / steps);
      for(Index v = 0; v < n; ++v)
        integral[v] += d[v] * (k == 0 || k == steps ? 1 : k % 2 == 1 ? 4 : 2) / (3. * steps);
    }
    for(Index v = 0; v < n; ++v)
      BOOST_TEST(std::abs(last[v] - first[v] - integral[v]) <= 1000 / (12. * steps * steps)); // h^2 / 12 times the jumps, of 1000 in all

    const double h = 1e-5;
    for(double x : { .1, .35, .7 })
    {
      const std::vector<double> d = derivative(x), right = at(x + h), left = at(x - h);
      for(Index v = 0; v < n; ++v)
        BOOST_TEST(std::abs((right[v] - left[v]) / (2 * h) - d[v]) <= h * (1 + std::abs(d[v]))); // where a jump lies between
      // and back: the triangulation at a point does not depend on the way
      const std::vector<double> again = at(x);
      at(0);
      const std::vector<double> once_more = at(x);
      for(Index v = 0; v < n; ++v)
        BOOST_TEST(std::abs(again[v] - once_more[v]) <= 1000 * few_roundings); // lengths are rounded by flips, and angles of needles move farther
    }
  }
}

// A vertex alone is moved to where its angle sum is as asked for, and no farther than allowed.
BOOST_AUTO_TEST_CASE(relaxing_a_vertex)
{
  Triangulation t = triangulation(icosphere(2));
  Silent_observer observer;
  CE::internal::Ideal_delaunay_energy<double> energy(t, observer);
  const Index n = t.number_of_vertices();
  std::vector<double> u = random_numbers(n, .3, 23);
  for(Index v : { 0, 20, 77 })
    for(double target : { .01, .5, 3., 6., 9., 30. })
      for(double close : { .01, 1e-6 })
      {
        BOOST_TEST_REQUIRE(energy.evaluate(u));
        const double given = u[v], residual = energy.angle_sums()[v] - target;
        std::vector<double> moved = u;
        moved[v] = energy.relax(v, target, given, 1.5, close);
        BOOST_TEST_REQUIRE(energy.evaluate(moved));
        const double left = energy.angle_sums()[v] - target;
        if(std::abs(moved[v] - given) == 1.5)
          BOOST_TEST(left * residual > 0); // it is still on the same side
        else
          BOOST_TEST(std::abs(left) <= 1.01 * close);
        BOOST_TEST(std::abs(moved[v] - given) <= 1.5);
        BOOST_TEST((moved[v] == given || (moved[v] > given) == (residual > 0)));
        BOOST_TEST(energy.relax(v, target, moved[v], 0, close) == moved[v]);
      }
}

// --- closed surfaces ----------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(random_curvatures)
{
  Soup noisy = icosphere(2);
  add_noise(noisy, .05, 3);
  const std::vector<Triangulation> surfaces = { triangulation(icosahedron()), triangulation(noisy), triangulation(torus(9, 6)) };
  std::size_t flipped = 0;
  for(const Triangulation& t : surfaces)
    for(unsigned seed = 0; seed < 4; ++seed)
      for(double spread : { .2, 1., 2. })
        for(Retriangulation mode : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
        {
          const Metric metric = solved(t, random_angles(t, spread, seed), mode);
          flipped += metric.is_retriangulated();
          checked_layout(t, metric, all_vertices(t));
        }
  BOOST_TEST(flipped > 40u);
}

// All curvature at few vertices, and angles far beyond what the triangles at a vertex could have.
BOOST_AUTO_TEST_CASE(extreme_cones)
{
  const Triangulation sphere = triangulation(icosphere(2)), ring = triangulation(torus(10, 7));
  for(double most : { .5, .9, .99, 1.5, 1.999 }) // of 2 pi, at two of three cones
  {
    Conditions conditions(sphere);
    conditions.prescribe_angle_sum(0, 2 * pi * (1 - most / 2));
    conditions.prescribe_angle_sum(5, 2 * pi * (1 - most / 2));
    conditions.prescribe_angle_sum(100, 2 * pi * (1 - (2 - most)) + 0.);
    if(2 - most >= 1)
      continue;
    const Metric metric = solved(sphere, conditions, Retriangulation::WHEN_NEEDED);
    checked_layout(sphere, metric, {0, 5, 100});
  }
  for(int extra : { 1, 4, 9 }) // a cone of 2 pi (1 + extra), on a vertex with six triangles
  {
    Conditions conditions(ring);
    conditions.prescribe_angle_sum(3, Angle::pi_times(2 + 2 * extra));
    std::vector<Index> cones(1, 3);
    for(Index v = 7; cones.size() < std::size_t(2 * extra) + 1; v += 3)
    {
      conditions.prescribe_angle_sum(v, Angle::pi_times(1));
      cones.push_back(v);
    }
    BOOST_TEST((CE::compute_conformal_metric(ring, conditions, params::retriangulation(Retriangulation::NEVER)).status != Status::OK));
    const Metric metric = solved(ring, conditions, Retriangulation::WHEN_NEEDED);
    BOOST_TEST(metric.is_retriangulated());
    checked_layout(ring, metric, cones);
  }
}

// With angles of all sizes there are needles, whose angles go from 0 to pi within a change of u by 1e-8 and less. Newton's method
// takes two to three times as many steps, unless vertices at their ends are moved by themselves.
BOOST_AUTO_TEST_CASE(needles_do_not_hold_up)
{
  const Triangulation sphere = triangulation(icosphere(3));
  for(unsigned seed : testing::cases<unsigned>({ 0, 1, 3 }))
    for(double spread : { 2., 3. })
    {
      const Metric metric = solved(sphere, random_angles(sphere, spread, seed), Retriangulation::WHEN_NEEDED);
      BOOST_TEST(metric.is_retriangulated());
      BOOST_TEST(metric.statistics.number_of_iterations <= 28u);
    }
  const Triangulation ring = triangulation(torus(40, 24));
  Conditions conditions(ring); // the angle of 40 pi
  conditions.prescribe_angle_sum(3, Angle::pi_times(40));
  for(Index i = 0; i < 38; ++i)
    conditions.prescribe_angle_sum(7 + 23 * i, Angle::pi_times(1));
  for(Retriangulation mode : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
    BOOST_TEST(solved(ring, conditions, mode).is_retriangulated());
}

// Lengths that violate a triangle inequality by no more than their rounding are those of degenerate triangles.
BOOST_AUTO_TEST_CASE(inequalities_violated_by_rounding)
{
  const double eps = std::numeric_limits<double>::epsilon();
  using CE::internal::is_triangle_up_to_rounding;
  BOOST_TEST(is_triangle_up_to_rounding(1., 1., 2.));
  BOOST_TEST(is_triangle_up_to_rounding(1., 2 + 6 * eps, 1.));
  BOOST_TEST(is_triangle_up_to_rounding(2 + 8 * eps, 1., 1.));
  BOOST_TEST(!is_triangle_up_to_rounding(2 + 10 * eps, 1., 1.));
  BOOST_TEST(!is_triangle_up_to_rounding(1., 1., 2 + 10 * eps));
  BOOST_TEST(is_triangle_up_to_rounding(1e-300, 1., 1 + eps));
  BOOST_TEST(!is_triangle_up_to_rounding(1., 1e-300, 1 + 5 * eps));

  // a triangle from both sides, with the midpoint of a side on one of them
  Soup soup;
  soup.points = {{{0, 0, 0}}, {{1, 0, 0}}, {{.5, std::sqrt(.75), 0}}, {{.5, 0, 0}}};
  soup.triangles = {{{0, 1, 2}}, {{1, 0, 3}}, {{2, 1, 3}}, {{0, 2, 3}}};
  for(double excess : { 0., eps, 4 * eps, 1e-12 })
  {
    Triangulation t = triangulation(soup);
    for(Index h = 0; h < t.number_of_halfedges(); ++h)
      if(t.origin(h) == 0 && t.target(h) == 1)
        t.set_length(t.edge(h), 1 + excess);
    Conditions conditions(t);
    for(Index v = 0; v < 4; ++v)
      conditions.prescribe_angle_sum(v, Angle::pi_times(1));
    if(excess < 1e-14)
    {
      const Metric metric = solved(t, conditions, Retriangulation::ALWAYS);
      BOOST_TEST((metric.statistics.conformal_class == CE::Conformal_class::DELAUNAY_TRIANGULATION));
    }
    else
    {
      const Metric metric = CE::compute_conformal_metric(t, conditions, params::retriangulation(Retriangulation::ALWAYS));
      BOOST_TEST((metric.status == Status::DEGENERATE_METRIC));
      BOOST_TEST((metric.faces == std::vector<Index>{1}));
    }
  }
}

// Ptolemy flips do not leave the conformal class: of the torus with one vertex, whatever its lengths look like.
BOOST_AUTO_TEST_CASE(torus_with_one_vertex_after_flips)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(.8, 1.2);
  for(int i = 0; i < 20; ++i)
  {
    Triangulation t = one_vertex_torus(uniform(random), uniform(random), uniform(random));
    const Metric straight = solved(t, Conditions(t), Retriangulation::NEVER);
    const CE::Layout<double> expected = CE::compute_layout(t, straight, CE::compute_cut_graph(t, {}));
    for(int flips = 0; flips < 6; ++flips)
    {
      const Index e = Index(random() % 3), h = t.edge_halfedge(e), g = t.twin(h);
      const double l = (t.halfedge_length(t.next(h)) * t.halfedge_length(t.next(g))
                      + t.halfedge_length(t.previous(h)) * t.halfedge_length(t.previous(g))) / t.length(e);
      t.flip_edge(e, l);
    }
    const Metric metric = solved(t, Conditions(t), Retriangulation::WHEN_NEEDED);
    const CE::Layout<double> layout = checked_layout(t, metric, {});
    BOOST_TEST_REQUIRE(layout.lattices.size() == 1u);
    // six flips, each of which may lengthen an edge
    BOOST_TEST(std::abs(complex(layout.lattices[0].tau) - complex(expected.lattices[0].tau)) <= 10 * solved_u);
  }
}

// ALWAYS depends on the surface alone: not on the diagonals of its flat parts.
BOOST_AUTO_TEST_CASE(diagonals_of_planar_quads)
{
  const auto box = [](unsigned seed)
  {
    std::mt19937 random(seed);
    Soup soup;
    const Index n = 4;
    std::map<std::array<Index, 3>, Index> number;
    const auto vertex = [&](std::array<Index, 3> p)
    {
      const auto found = number.emplace(p, Index(soup.points.size()));
      if(found.second)
        soup.points.push_back({{double(p[0]), 1.5 * p[1], .7 * p[2]}});
      return found.first->second;
    };
    for(int axis = 0; axis < 3; ++axis)
      for(Index side : { Index(0), n })
        for(Index i = 0; i < n; ++i)
          for(Index j = 0; j < n; ++j)
          {
            const auto at = [&](Index x, Index y)
            {
              std::array<Index, 3> p;
              p[axis] = side;
              p[(axis + 1) % 3] = x;
              p[(axis + 2) % 3] = y;
              return vertex(p);
            };
            Index a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
            if(side == 0)
              std::swap(b, d);
            if(seed != 0 && random() % 2 == 0)
              soup.triangles.insert(soup.triangles.end(), {{{a, b, c}}, {{a, c, d}}});
            else
              soup.triangles.insert(soup.triangles.end(), {{{a, b, d}}, {{b, c, d}}});
          }
    return triangulation(soup);
  };
  std::vector<double> expected;
  for(unsigned seed = 0; seed < 4; ++seed)
  {
    const Triangulation t = box(seed);
    Conditions conditions(t);
    for(Index v : { 0, 7, 31, 60 })
      conditions.prescribe_angle_sum(v, Angle::pi_times(1));
    const Metric metric = solved(t, conditions, Retriangulation::ALWAYS);
    checked_layout(t, metric, { 0, 7, 31, 60 });
    if(seed == 0)
      expected = metric.log_scale_factors;
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      BOOST_TEST(std::abs(metric.log_scale_factors[v] - expected[v]) <= solved_u);
  }
}

// The same for a disk of parallelograms, no two of which lie in one plane, with its border: their diagonals do not matter.
BOOST_AUTO_TEST_CASE(diagonals_of_a_disk_of_parallelograms)
{
  const Index n = 12;
  const auto surface = [&](unsigned seed)
  {
    std::mt19937 random(seed);
    Soup soup;
    for(Index j = 0; j <= n; ++j)
      for(Index i = 0; i <= n; ++i)
        soup.points.push_back({{double(i), j + .3 * std::sin(2. * i), 1.5 * std::sin(.7 * i) + 2 * std::cos(.9 * j)}});
    for(Index j = 0; j < n; ++j)
      for(Index i = 0; i < n; ++i)
      {
        const Index a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
        if(seed == 0 || (seed > 1 && random() % 2 == 0))
          soup.triangles.insert(soup.triangles.end(), {{{a, b, c}}, {{a, c, d}}});
        else
          soup.triangles.insert(soup.triangles.end(), {{{a, b, d}}, {{b, c, d}}});
      }
    return triangulation(soup);
  };
  std::vector<double> expected;
  std::vector<Complex> expected_points;
  std::size_t differing = 0;
  for(unsigned seed = 0; seed < 5; ++seed)
  {
    const Triangulation t = surface(seed);
    const Conditions conditions(t);
    const Metric metric = solved(t, conditions, Retriangulation::ALWAYS), given = solved(t, conditions, Retriangulation::WHEN_NEEDED);
    const CE::Layout<double> layout = checked_layout(t, metric, {});
    std::vector<Complex> points(t.number_of_vertices());
    for(Index h = 0; h < t.number_of_halfedges(); ++h)
      points[t.target(h)] = complex(layout.corner[h]);
    if(seed == 0)
    {
      expected = metric.log_scale_factors;
      expected_points = points;
    }
    for(Index v = 0; v < t.number_of_vertices(); ++v)
    {
      BOOST_TEST(std::abs(metric.log_scale_factors[v] - expected[v]) <= solved_u);
      const double length = std::abs(points[v] - points[0]), expected_length = std::abs(expected_points[v] - expected_points[0]);
      BOOST_TEST(std::abs(length - expected_length) <= solved_u * n); // across up to n parallelograms
      differing += std::abs(given.log_scale_factors[v] - expected[v]) > 1e-4;
    }
  }
  BOOST_TEST(differing > 0u); // without it, diagonals matter
}

// --- borders ------------------------------------------------------------------------------------

// On the double of a surface the solution is that of the surface, twice.
BOOST_AUTO_TEST_CASE(double_of_a_surface)
{
  for(const Soup& soup : { hill(6, .4), annulus(3, 12, .3) })
  {
    const Triangulation t = triangulation(soup);
    const CE::internal::Surface_double<double> twofold(t);
    const Triangulation& d = twofold.triangulation;
    BOOST_TEST(CE::non_manifold_vertices(d).empty());
    const CE::Surface_components pieces = CE::connected_components(d);
    BOOST_TEST(pieces.components.size() == 1u);
    BOOST_TEST(pieces.components[0].number_of_borders == 0u);
    for(Index e = 0; e < t.number_of_edges(); ++e)
      BOOST_TEST(d.length(e) == t.length(e));
    for(Index h = 0; h < d.number_of_halfedges(); ++h)
    {
      BOOST_TEST(d.origin(d.twin(h)) == d.target(h));
      BOOST_TEST(d.halfedge_length(d.twin(h)) == d.halfedge_length(h));
    }
    const Conditions conditions(t);
    const Metric one = solved(t, conditions, Retriangulation::NEVER), two = solved(d, twofold.conditions(conditions), Retriangulation::NEVER);
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      BOOST_TEST(std::abs(one.log_scale_factors[v] - two.log_scale_factors[v]) <= solved_u);
  }
}

namespace {

// Border edges are as long as u says, but for those that were flipped away; if none may be, there is no metric.
void check_border_edges(const Triangulation& t, const Conditions& conditions, const Metric& metric, const CE::Layout<double>& layout)
{
  const Metric kept = CE::compute_conformal_metric(t, conditions, params::retriangulation(Retriangulation::WHEN_NEEDED)
                                                                           .border_edges(CE::Border_edges::KEPT));
  BOOST_TEST(!kept.is_doubled);
  BOOST_TEST(kept.lost_border_edges.empty());
  BOOST_TEST(metric.lost_border_edges.empty() == !metric.is_doubled);
  if(metric.is_doubled)
  {
    BOOST_TEST((kept.status == Status::DEGENERATE_METRIC));
    BOOST_TEST(!kept.faces.empty());
    for(Index f : kept.faces)
      BOOST_TEST((kept.triangulation.is_border(3 * f) || kept.triangulation.is_border(3 * f + 1) || kept.triangulation.is_border(3 * f + 2)));
  }
  else
    BOOST_TEST(kept.log_scale_factors == metric.log_scale_factors);
  std::vector<char> is_lost(t.number_of_edges(), 0);
  for(Index e : metric.lost_border_edges)
  {
    BOOST_TEST(t.is_border_edge(e));
    is_lost[e] = 1;
  }
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    if(!t.is_border(h))
      continue;
    const double length = std::abs(complex(layout.corner[h]) - complex(layout.corner[t.previous(h)]));
    const double said = t.halfedge_length(h) * std::exp((metric.log_scale_factors[t.origin(h)] + metric.log_scale_factors[t.target(h)]) / 2);
    BOOST_TEST((std::abs(length - said) <= few_roundings * (said + diameter(layout.corner))) == !is_lost[t.edge(h)]);
  }
}

} // namespace

// Obtuse triangles along the border, which flips inside cannot help.
BOOST_AUTO_TEST_CASE(borders_that_need_the_double)
{
  Soup soup = cone(5, .1); // a very sharp tip over one side of the border
  soup.points[0] = {{.9, 0, .05}};
  const Triangulation t = triangulation(soup);
  std::size_t doubled = 0;
  for(double slope : { .3, 1., 3., 9. })
  {
    Soup steep = soup;
    steep.points[0][2] = slope;
    const Triangulation s = triangulation(steep);
    for(bool is_straight : { false, true })
    {
      Conditions conditions(s);
      if(is_straight)
        for(Index v = 1; v <= 5; ++v)
          conditions.prescribe_angle_sum(v, v == 1 ? Angle::pi_times(1, 30) : v == 2 ? Angle::pi_times(29, 30) : Angle::pi_times(2, 3));
      const Metric metric = solved(s, conditions, Retriangulation::WHEN_NEEDED);
      doubled += metric.is_doubled;
      const CE::Layout<double> layout = checked_layout(s, metric, {});
      check_border_edges(s, conditions, metric, layout);
      // the border is a polygon of straight sides; its turning is that of the angles
      std::vector<Complex> side;
      for(Index h = 0; h < s.number_of_halfedges(); ++h)
        if(s.is_border(h))
          side.push_back(complex(layout.corner[h]) - complex(layout.corner[s.previous(h)]));
      Complex sum = 0;
      for(const Complex& z : side)
        sum += z;
      BOOST_TEST(std::abs(sum) <= few_roundings * double(side.size()) * diameter(layout.corner));
    }
  }
  BOOST_TEST(doubled > 0u);
}

// --- the double, folded -------------------------------------------------------------------------

namespace {

typedef CE::internal::Surface_double<double>  Surface_double;
typedef CE::internal::Folded_double<double>   Folded_double;
typedef CE::internal::Edge_graph              Edge_graph;

// Flat inside, with turning angles of the one border that are drawn at random.
Conditions random_border_angles(const Triangulation& t, double most, unsigned seed)
{
  std::vector<Index> border;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(t.is_border_vertex(v))
      border.push_back(v);
  std::vector<double> turning = random_numbers(border.size(), most, seed);
  double mean = 0;
  for(double k : turning)
    mean += k / double(turning.size());
  Conditions conditions(t);
  for(std::size_t i = 0; i < border.size(); ++i)
    conditions.prescribe_angle_sum(border[i], pi - (turning[i] - mean + 2 * pi / double(border.size())));
  return conditions;
}

Edge_graph graph_of_all(const Triangulation& t)
{
  Edge_graph graph;
  graph.set_edges(t);
  graph.set_free(std::vector<char>(t.number_of_vertices(), 1));
  return graph;
}

// Flips of edges of the double that are drawn at random, mostly not in pairs of mirror images.
std::size_t flip_at_random(Triangulation& d, Folded_double& folded, Edge_graph& graph, std::size_t times, unsigned seed)
{
  std::mt19937 random(seed);
  std::size_t flips = 0;
  for(std::size_t i = 0; i < times; ++i)
  {
    const Index e = Index(random() % d.number_of_edges());
    if(!d.is_flippable(e))
      continue;
    d.flip_edge(e, CE::internal::ptolemy_length(d, e));
    folded.part(e);
    for(Index f : { e, folded.mirror(e) })
      graph.set_edge(folded, folded.link(f));
    ++flips;
  }
  return flips;
}

// A wheel with one border edge nearly as long as the two spokes at its ends.
Triangulation kite(Index n, double spoke)
{
  Triangulation t = triangulation(cone(n, 1.));
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    const Index v = t.origin(t.edge_halfedge(e)), w = t.target(t.edge_halfedge(e));
    t.set_length(e, v == 0 || w == 0 ? spoke : v + w == 3 ? 1.93 * spoke : 1);
  }
  return t;
}

// What metrics on the double there are to test: triangles that flips inside cannot help.
struct Doubled_problem
{
  Triangulation t;
  Conditions conditions;
};

std::vector<Doubled_problem> doubled_problems()
{
  std::vector<Doubled_problem> result;
  for(Index n : { 4, 5 })
    result.push_back({kite(n, 1.5), Conditions(kite(n, 1.5))});
  result.push_back({kite(4, 1.5), random_border_angles(kite(4, 1.5), 2.6, 1)});
  const Triangulation land = triangulation(random_height_field(16, .2, 5));
  result.push_back({land, random_border_angles(land, 2.8, 5)});
  Triangulation two = triangulation(together({ cone(4, 1.), torus(4, 5) })); // a closed surface beside one with a border
  const Triangulation first = kite(4, 1.5);
  for(Index e = 0; e < first.number_of_edges(); ++e)
    two.set_length(e, first.length(e));
  result.push_back({two, Conditions(two)});
  return result;
}

} // namespace

// The matrix is P^T A P / 2 for the A of the double, before flips that of the surface itself, whatever is flipped.
BOOST_AUTO_TEST_CASE(matrix_of_the_folded_double)
{
  for(const Soup& soup : { hill(3, .4), annulus(2, 7, .3) })
  {
    const Triangulation t = triangulation(soup);
    const Index n = t.number_of_vertices();
    const Surface_double twofold(t);
    Triangulation d = twofold.triangulation;
    Folded_double folded(t, twofold, d);
    BOOST_TEST(folded.number_of_vertices() == n);
    BOOST_TEST(folded.number_of_edges() == t.number_of_edges());
    Edge_graph graph;
    graph.set_edges(folded);
    graph.set_free(std::vector<char>(n, 1));
    const std::vector<double> u = random_numbers(n, .3, 5);
    CE::internal::Conformal_energy<double> on_surface(t);
    on_surface.evaluate(u);
    std::size_t flips = 0;
    for(std::size_t times : { 0, 3, 40, 400 })
    {
      flips += flip_at_random(d, folded, graph, times, unsigned(times));
      CE::internal::Conformal_energy<double> on_double(d);
      on_double.evaluate(folded.spread(u));
      const Edge_graph whole = graph_of_all(d);
      BOOST_TEST(graph.ends.size() == folded.number_of_edges());
      const std::vector<double> w = on_double.weights(), folded_w = folded.fold_weights(w);
      const auto lower = CE::internal::assemble_lower(graph, folded_w, std::vector<double>(n, 0));
      double size = 0;
      for(double x : w)
        size = (std::max)(size, std::abs(x));
      const double tolerance = 100 * few_roundings * size; // a hundred products
      for(Index v = 0; v < n; ++v)
      {
        std::vector<double> x(n, 0);
        x[v] = 1;
        const std::vector<double> column = graph.product(folded_w, x), expected = folded.fold(whole.product(w, folded.spread(x)));
        const std::vector<double> of_surface = graph_of_all(t).product(on_surface.weights(), x);
        for(Index i = 0; i < n; ++i)
        {
          BOOST_TEST(std::abs(column[i] - expected[i]) <= tolerance);
          if(i >= v)
            BOOST_TEST(std::abs(lower.coeff(int(i), int(v)) - expected[i]) <= tolerance);
          if(times == 0)
            BOOST_TEST(std::abs(of_surface[i] - expected[i]) <= tolerance);
        }
      }
      const std::vector<double> sums = folded.fold(on_double.angle_sums());
      for(Index v = 0; times == 0 && v < n; ++v)
        BOOST_TEST(std::abs(sums[v] - on_surface.angle_sums()[v]) <= 100 * unit_roundoff * 2 * pi); // of up to a hundred angles
    }
    BOOST_TEST(flips > 100u);
    BOOST_TEST(folded.number_of_edges() > t.number_of_edges() + t.number_of_edges() / 2);
    folded.join();
    BOOST_TEST(folded.number_of_edges() == t.number_of_edges());
  }
}

// On the double, vertex and image have the same u, bit by bit, in all digits; it is the solution on the double taken as any closed surface.
BOOST_AUTO_TEST_CASE(symmetry_on_the_double)
{
  std::size_t doubled = 0;
  for(const Doubled_problem& p : doubled_problems())
    for(Retriangulation mode : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
      for(CE::Newton_strategy strategy : { CE::Newton_strategy::LINE_SEARCH, CE::Newton_strategy::TRUST_REGION })
      {
        const Index n = p.t.number_of_vertices();
        const Metric metric = CE::compute_conformal_metric(p.t, p.conditions, params::retriangulation(mode).newton_strategy(strategy));
        BOOST_TEST_REQUIRE(bool(metric), CE::message(metric.status));
        BOOST_TEST(metric.statistics.residual <= (std::max)(solver_tolerance, metric.statistics.residual_floor));
        if(!metric.is_doubled)
          continue;
        ++doubled;
        const Surface_double twofold(p.t);
        const Folded_double folded(p.t, twofold, metric.triangulation);
        const Conditions conditions = twofold.conditions(p.conditions);
        BOOST_TEST_REQUIRE(metric.log_scale_factors.size() == n);
        BOOST_TEST_REQUIRE(metric.scale_factors.size() == twofold.triangulation.number_of_vertices());
        const std::vector<double> residual = CE::internal::wide_residual(metric.triangulation, metric.scale_factors, conditions);
        const double rounding = 4 * few_roundings + metric.statistics.angle_defect_spread; // of the angles given, which are made to fit
        double sum = 0;
        bool is_scaled = false;
        for(Index v = 0; v < n; ++v)
        {
          const Index w = folded.image(v);
          BOOST_TEST(metric.scale_factors[w].hi == metric.scale_factors[v].hi);
          BOOST_TEST(metric.scale_factors[w].lo == metric.scale_factors[v].lo);
          for(Index x : { v, w })
            BOOST_TEST(std::abs(residual[x]) <= (folded.is_on_axis(v) ? 2 : 1) * (metric.statistics.residual + rounding));
          sum += metric.log_scale_factors[v];
          is_scaled = is_scaled || p.conditions.is_fixed(v);
        }
        if(!is_scaled)
          BOOST_TEST(std::abs(sum) <= solved_u * n);

        const Metric literal = CE::compute_conformal_metric(twofold.triangulation, conditions, params::retriangulation(mode));
        BOOST_TEST_REQUIRE(bool(literal), CE::message(literal.status));
        // components without a fixed u have their own scale on the double
        const CE::Surface_components pieces = CE::connected_components(p.t);
        std::vector<double> shift(pieces.components.size(), 0);
        std::vector<char> is_known(shift.size(), 0);
        for(Index v = 0; v < n; ++v)
        {
          const std::size_t c = pieces.component_of_vertex[v];
          const double difference = literal.log_scale_factors[v] - metric.log_scale_factors[v];
          if(!is_known[c])
            shift[c] = is_scaled && pieces.components[c].number_of_borders > 0 ? 0 : difference;
          is_known[c] = 1;
          BOOST_TEST(std::abs(difference - shift[c]) <= 2 * solved_u);
        }
      }
  BOOST_TEST(doubled >= 10u);
}

// Newton's method in the wide type, too, has one unknown for both, and gains digits quadratically.
BOOST_AUTO_TEST_CASE(wide_steps_on_the_folded_double)
{
  const Doubled_problem p = doubled_problems()[3];
  const Metric metric = CE::compute_conformal_metric(p.t, p.conditions);
  BOOST_TEST_REQUIRE(bool(metric));
  BOOST_TEST_REQUIRE(metric.is_doubled);
  const Surface_double twofold(p.t);
  Folded_double folded(p.t, twofold, metric.triangulation);
  for(Index e : metric.flips)
    folded.part(e);
  const Index n = p.t.number_of_vertices();
  Edge_graph graph;
  graph.set_edges(folded);
  std::vector<char> free(n, 1);
  free[0] = 0;
  graph.set_free(free);
  std::vector<CE::internal::Double_double> s(metric.scale_factors.begin(), metric.scale_factors.begin() + n);
  for(Index v = 1; v < n; ++v)
    s[v] = s[v] * (1 + 1e-5 * std::sin(double(v)));
  const double rounding = 1e-27; // of pairs of `double`, 2^-104, times the ratio of the longest edge to the shortest
  double size = 1;
  for(int step = 0; step < 5; ++step)
  {
    BOOST_TEST_REQUIRE(CE::internal::add_wide_newton_step(folded, graph, CE::internal::scaled_wide_residual(folded, s, p.conditions), s));
    const double before = size;
    size = 0;
    const std::vector<double> residual = CE::internal::wide_residual(folded, s, p.conditions);
    for(Index v = 1; v < n; ++v) // what the angles miss Gauss and Bonnet's formula by is left at the vertex held
      size = (std::max)(size, std::abs(residual[v]));
    if(step > 0)
      BOOST_TEST(size <= (std::max)(rounding, 1e6 * before * before)); // quadratic convergence
  }
  BOOST_TEST(size <= rounding);
}

// One solver, conditions that need the double and such that do not: each result is that of a new solver.
BOOST_AUTO_TEST_CASE(again_after_the_double)
{
  const Triangulation t = triangulation(random_height_field(16, .2, 5));
  CE::Conformal_metric_solver<> solver(t);
  std::size_t doubled = 0;
  for(double most : { 2.8, 0., 2.8, 1., 2.8 })
  {
    const Conditions conditions = most == 0 ? Conditions(t) : random_border_angles(t, most, 5);
    const Metric metric = solver.solve(conditions), fresh = CE::compute_conformal_metric(t, conditions);
    BOOST_TEST_REQUIRE(bool(metric));
    BOOST_TEST_REQUIRE(bool(fresh));
    BOOST_TEST(metric.is_doubled == fresh.is_doubled);
    BOOST_TEST(metric.lost_border_edges == fresh.lost_border_edges);
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      BOOST_TEST(std::abs(metric.log_scale_factors[v] - fresh.log_scale_factors[v]) <= 2 * solved_u);
    doubled += metric.is_doubled;
  }
  BOOST_TEST(doubled >= 2u);
  BOOST_TEST(doubled < 5u);
}

// --- meshes -------------------------------------------------------------------------------------

namespace {

struct Flattened
{
  Mesh sm;
  Mesh::Property_map<Halfedge, Point_2> uv;
  Mesh::Property_map<Vertex, double> u;
  Mesh::Property_map<Edge, double> scaled;
  Report report;

  Flattened(const Mesh& mesh, Retriangulation mode) : sm(mesh)
  {
    uv = sm.add_property_map<Halfedge, Point_2>("h:uv").first;
    u = sm.add_property_map<Vertex, double>("v:u", 0).first;
    scaled = sm.add_property_map<Edge, double>("e:scaled", 0).first;
    report = CE::flatten(sm, uv, params::retriangulation(mode).log_scale_factor_map(u).scaled_edge_length_map(scaled));
  }
  Flattened(const Flattened&) = delete;
};

} // namespace

// The border's turning of 2 pi, spread evenly by length.
Conditions turning_border(const Triangulation& t)
{
  double length = 0;
  std::vector<double> share(t.number_of_vertices(), 0);
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
    if(t.is_border(h))
    {
      length += t.halfedge_length(h);
      share[t.origin(h)] += t.halfedge_length(h) / 2;
      share[t.target(h)] += t.halfedge_length(h) / 2;
    }
  Conditions result(t);
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(t.is_border_vertex(v))
      result.prescribe_angle_sum(v, CGAL_PI - 2 * CGAL_PI * share[v] / length);
  return result;
}

// A solution on the triangulation as it is is found, and is the same bit for bit, whether or not edges might be flipped; and where it is given up
// before its end, the end would have been none. (three_peaks with a turning border was given up once.)
BOOST_AUTO_TEST_CASE(what_has_a_solution_as_it_is_is_not_flipped)
{
  std::vector<std::string> names = good_disks();
  for(const char* name : {"mannequin-devil.off", "cylinder_locally_refined.off", "mech-holes-shark.off"})
    names.push_back(name);
  std::size_t fixed = 0, flipped = 0;
  for(const std::string& name : testing::cases(names))
  {
    if(!has_mesh(name))
      continue;
    const Triangulation t = CE::import_mesh(read_mesh(name)).triangulation;
    const bool is_disk = CE::connected_components(t).components[0].is_disk();
    for(const bool is_natural : {true, false})
    {
      if(!is_natural && !is_disk)
        continue; // its border turns otherwise
      const Conditions conditions = is_natural ? Conditions(t) : turning_border(t);
      const Metric never = CE::compute_conformal_metric(t, conditions, params::retriangulation(Retriangulation::NEVER));
      const Metric when_needed = CE::compute_conformal_metric(t, conditions, params::retriangulation(Retriangulation::WHEN_NEEDED));
      BOOST_TEST_INFO(name << (is_natural ? ", natural border" : ", turning border") << ": " << CE::message(never.status));
      BOOST_TEST(bool(never) == !when_needed.is_retriangulated());
      BOOST_TEST(bool(when_needed));
      if(name == "three_peaks.off")
        BOOST_TEST(bool(never));
      if(never)
        BOOST_TEST(when_needed.log_scale_factors == never.log_scale_factors);
      else
        BOOST_TEST(when_needed.statistics.number_of_discarded_iterations <= never.statistics.number_of_iterations);
      (never ? fixed : flipped) += 1;
    }
  }
  BOOST_TEST_MESSAGE(fixed << " as they are, " << flipped << " flipped");
}

// Asks an energy, and how long a triangle would have remained broken along the steps that are about to be made.
class Watched_energy final : public CE::internal::Abstract_energy
{
public:
  explicit Watched_energy(const Triangulation& t) : energy_(t, true) {}

  double longest() const { return longest_; }

  bool evaluate(const std::vector<double>& u) override { return energy_.evaluate(u); }
  const std::vector<double>& angle_sums() const override { return energy_.angle_sums(); }
  const std::vector<double>& weights() const override { return energy_.weights(); }
  const std::vector<Index>& broken_faces() const override { return energy_.broken_faces(); }
  std::vector<double> sensitivities() const override { return energy_.sensitivities(); }
  bool has_flips() const override { return false; }
  std::vector<Index> broken_corners() const override { return energy_.broken_corners(); }
  void minimize_around(const std::vector<Index>& seeds, const CE::internal::Edge_graph& graph, const std::vector<double>& target,
                       std::vector<double>& u) override
  {
    energy_.minimize_around(seeds, graph, target, u);
  }

  bool stays_broken(const std::vector<double>& d, double most) const override
  {
    for(double multiple = most; multiple >= .1 && multiple > longest_; multiple *= .9)
      if(energy_.stays_broken(d, multiple))
        longest_ = multiple;
    return false; // so that the search goes on
  }

private:
  CE::internal::Fixed_energy<double> energy_;
  mutable double longest_ = 0;
};

// The multiple at which a search is given up, 30, is ten times what was ever seen where there is a solution.
BOOST_AUTO_TEST_CASE(what_is_broken_on_the_way_to_a_solution_is_soon_mended)
{
  std::size_t meshes = 0, searches = 0;
  for(const std::string& name : good_disks())
  {
    if(!has_mesh(name))
      continue;
    ++meshes;
    const Triangulation t = CE::import_mesh(read_mesh(name)).triangulation;
    for(const bool is_natural : {true, false})
    {
      const Conditions conditions = is_natural ? Conditions(t) : turning_border(t);
      std::vector<char> is_free(t.number_of_vertices());
      std::vector<double> target(t.number_of_vertices(), 0), u(target);
      for(Index v = 0; v < t.number_of_vertices(); ++v)
      {
        is_free[v] = !t.is_isolated_vertex(v) && !conditions.is_fixed(v);
        target[v] = is_free[v] ? conditions.angle_sum(v).radians() : 0;
      }
      Watched_energy energy(t);
      CE::internal::Laplacian_solver linear(CE::internal::make_factorization<CE::Default_solver_traits>());
      linear.set_edges(t);
      linear.set_free(is_free);
      CE::internal::Newton_options options;
      options.may_give_up = true;
      CE::Statistics statistics;
      const CE::internal::Any_visitor visitor;
      if(CE::internal::Newton_method(energy, linear, target, options, statistics, visitor)(u) != Status::OK || !energy.broken_faces().empty())
        continue;
      BOOST_TEST_INFO(name << (is_natural ? ", natural border" : ", turning border"));
      BOOST_TEST(energy.longest() < 3);
      ++searches;
    }
  }
  BOOST_TEST(searches >= meshes); // both borders of most, and one at least on the average
}

BOOST_AUTO_TEST_CASE(without_need_nothing_changes, * needs_mesh("lion-head.off"))
{
  for(const char* name : { "lion-head.off", "knot1.off", "head.off" })
  {
    const Flattened never(read_mesh(name), Retriangulation::NEVER), when_needed(read_mesh(name), Retriangulation::WHEN_NEEDED);
    BOOST_TEST(bool(never.report));
    BOOST_TEST(when_needed.report.statistics.number_of_flips == 0u);
    BOOST_TEST(std::equal(never.uv.begin(), never.uv.end(), when_needed.uv.begin()));
    BOOST_TEST(std::equal(never.u.begin(), never.u.end(), when_needed.u.begin()));
  }
}

// The disks that the fixed triangulation cannot do.
BOOST_AUTO_TEST_CASE(disks_that_need_flips, * needs_mesh("cylinder_locally_refined.off"))
{
  for(const char* name : testing::cases<const char*>(
        { "blob.off", "degtri_sliding.off", "corner_tris_with_hole.off", "mannequin-devil.off", "cylinder_locally_refined.off" }))
    BOOST_TEST_CONTEXT(name)
    {
      const Flattened never(read_mesh(name), Retriangulation::NEVER);
      BOOST_TEST(!never.report);
      const Flattened m(read_mesh(name), Retriangulation::WHEN_NEEDED);
      BOOST_TEST_REQUIRE(bool(m.report), CE::message(m.report));
      BOOST_TEST(m.report.statistics.number_of_flips > 0u);
      BOOST_TEST(m.report.statistics.residual <= solver_tolerance);
      std::set<Face> flat; // of no area from the beginning: images of segments
      for(Index f : CE::internal::degenerate_faces(CE::import_mesh(m.sm).triangulation))
        flat.insert(Face(f));
      BOOST_TEST(flat.empty() == (m.report.statistics.number_of_resolving_flips == 0));
      for(Face f : m.report.flat_faces)
        BOOST_TEST(flat.count(f) == 1u);
      std::set<Vertex> around_flat_faces;
      for(Face f : faces(m.sm))
      {
        const Halfedge h = halfedge(f, m.sm);
        if(flat.count(f) == 0)
          BOOST_TEST((CGAL::orientation(m.uv[h], m.uv[next(h, m.sm)], m.uv[prev(h, m.sm)]) == CGAL::LEFT_TURN));
        else
          for(Vertex v : vertices_around_face(h, m.sm))
            around_flat_faces.insert(v);
      }
      const double tolerance = (std::max)(few_roundings, 16 * rounding_of_lengths(m.sm, m.uv));
      for(Halfedge h : halfedges(m.sm))
        if(!is_border(h, m.sm))
          BOOST_TEST(std::abs(uv_length(m.sm, m.uv, h) / m.scaled[edge(h, m.sm)] - 1) <= tolerance);
      for(Vertex v : vertices(m.sm)) // with positive triangles around them, all vertices inside are flat
        if(!m.sm.is_isolated(v) && !CGAL::is_border(v, m.sm) && around_flat_faces.count(v) == 0)
          BOOST_TEST(std::abs(uv_angle_sum(m.sm, m.uv, v) - 2 * pi) <= 100 * layout_angle); // edges are up to a hundred times shorter than others
    }
}
