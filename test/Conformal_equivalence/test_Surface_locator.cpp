// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Points of the surface and of the plane, without the common refinement: the same answers as with it.

#define BOOST_TEST_MODULE test_Surface_locator
#include "include/boost_test.h"
#include "include/flattened_meshes.h"
#include "include/flipped_metrics.h"

#include <CGAL/Conformal_equivalence/Surface_locator.h>
#include <CGAL/Conformal_equivalence/boundary_conditions.h>
#include <CGAL/Conformal_equivalence/compute_common_refinement.h>
#include <CGAL/Conformal_equivalence/Refinement_locator.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/compute_cut_graph.h>
#include <CGAL/Conformal_equivalence/compute_layout.h>
#include <CGAL/Conformal_equivalence/internal/Stopwatch.h>

#include <boost/multiprecision/mpfr.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;
using namespace testing;
using CE::Retriangulation;
using CE::Status;

namespace {

typedef CE::Common_refinement<double>     Refinement;
typedef CE::Refinement_locator<double>    Refinement_locator;
typedef CE::Surface_locator<double>       Locator;
typedef std::array<double, 3>             Place;
typedef std::pair<Index, Index>           Faces; // of the input, and of the metric's triangulation

const Index null_index = Triangulation::null_index;

// The largest differences found, in units of the diameter of the layout.
struct Figures
{
  std::size_t crossings = 0, points = 0;
  double from_refinement = 0, weight = 0, round_trip = 0, across_edges = 0, across_cuts = 0;

  void add(const Figures& other)
  {
    crossings += other.crossings;
    points += other.points;
    from_refinement = (std::max)(from_refinement, other.from_refinement);
    weight = (std::max)(weight, other.weight);
    round_trip = (std::max)(round_trip, other.round_trip);
    across_edges = (std::max)(across_edges, other.across_edges);
    across_cuts = (std::max)(across_cuts, other.across_cuts);
  }
};

void tell(const char* what, const Figures& f)
{
  BOOST_TEST_MESSAGE(what << ": " << f.crossings << " crossings, " << f.points << " points; from the refinement " << f.from_refinement
                     << ", weights " << f.weight << ", there and back " << f.round_trip << ", across edges " << f.across_edges
                     << ", cuts " << f.across_cuts);
}

Place random_place(Random& random)
{
  Place b = {{random(0, 1), random(0, 1), random(0, 1)}};
  const double sum = b[0] + b[1] + b[2];
  for(double& x : b)
    x /= sum;
  return b;
}

// On the side number k, from the corner with the same number (0) to the next one (1).
Place on_side(Index k, double s)
{
  Place b = {{0, 0, 0}};
  b[k] = 1 - s;
  b[(k + 1) % 3] = s;
  return b;
}

double distance(const std::array<double, 2>& p, const std::array<double, 2>& q) { return std::abs(complex(p) - complex(q)); }

// How fast the image and the weight change with the barycentric coordinates: the factor by which rounding errors of these grow.
struct Condition { double uv, weight; };

Condition condition(const Locator::Face_map& map, const Place& b)
{
  const double step = 1e-9;
  const auto there = map.layout_point(b);
  Condition result = {0, 0};
  for(std::size_t k = 0; k < 3; ++k)
  {
    Place moved = {{ b[0] * (1 - step), b[1] * (1 - step), b[2] * (1 - step) }};
    moved[k] += step;
    const auto nearby = map.layout_point(moved);
    result.uv += distance(nearby.uv, there.uv) / step;
    result.weight += std::abs(nearby.weight / there.weight - 1) / step;
  }
  return result;
}

// Relative: a bound on an error that is larger than that would say nothing.
constexpr double meaningless = 1e-10;

// The same parts, and the same places of all their corners.
void check_parts(const Triangulation& t, const Refinement& r, const Locator& locator, const CE::Layout<double>& layout, Figures& figures)
{
  std::vector<std::vector<Index> > flat_faces(t.number_of_faces());
  for(Index f = 0; f < r.number_of_faces(); ++f)
    flat_faces[r.input_face[f]].push_back(r.flat_face[f]);
  const double size = diameter(r.corner_uv);
  for(Index f = 0; f < t.number_of_faces(); ++f)
  {
    const Locator::Face_map map = locator.face_map(f);
    BOOST_TEST(map.input_face() == f);
    BOOST_TEST(map.number_of_parts() == flat_faces[f].size());
    for(Index k = 0; k < 3; ++k) // vertices lie where the layout has them, bit by bit
    {
      const auto there = map.layout_point(on_side(k, 0));
      BOOST_TEST((there.uv == layout.corner[t.previous(3 * f + k)]));
      BOOST_TEST(there.weight == r.weights[t.origin(3 * f + k)]);
      BOOST_TEST((std::count(flat_faces[f].begin(), flat_faces[f].end(), there.flat_face) > 0));
    }
  }
  for(Index f = 0; f < r.number_of_faces(); ++f)
  {
    const Locator::Face_map map = locator.face_map(r.input_face[f]);
    Place centre = {{0, 0, 0}};
    const std::size_t first = r.first_corner[f], n = r.first_corner[f + 1] - first;
    for(std::size_t c = first; c < first + n; ++c)
    {
      const Place b = CE::input_barycentric(t, r, f, c);
      const auto there = map.layout_point(b);
      const Condition growth = condition(map, b);
      const double apart = distance(there.uv, r.corner_uv[c]) / size,
                   weight_error = std::abs(there.weight / r.weights[r.corner_vertex[c]] - 1);
      figures.from_refinement = (std::max)(figures.from_refinement, apart);
      figures.weight = (std::max)(figures.weight, weight_error);
      BOOST_TEST(apart <= (std::min)(few_roundings * (1 + growth.uv / size), meaningless));
      BOOST_TEST(weight_error <= (std::min)(few_roundings * (1 + growth.weight), meaningless));
      for(std::size_t k = 0; k < 3; ++k)
        centre[k] += b[k] / double(n);
    }
    // inside of a part that is not too thin it is clear which part it is
    const Place p = CE::input_barycentric(t, r, f, first), q = CE::input_barycentric(t, r, f, first + 1),
                s = CE::input_barycentric(t, r, f, first + 2);
    if(CE::internal::determinant(p, q, s) > 1e-9)
      BOOST_TEST(map.layout_point(centre).flat_face == r.flat_face[f]);
  }
}

// Which parts are at a point: the same ones, exactly.
template <typename Points>
std::vector<Faces> faces_of(const Points& points)
{
  std::vector<Faces> result;
  for(const auto& p : points)
    result.emplace_back(p.input_face, p.flat_face);
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<Faces> faces_of(const Refinement& r, const std::vector<Refinement_locator::Surface_point>& points)
{
  std::vector<Faces> result;
  for(const auto& p : points)
    result.emplace_back(p.input_face, r.flat_face[p.face]);
  std::sort(result.begin(), result.end());
  return result;
}

// At random points of the surface, and of the plane around the layout.
void check_points(const Triangulation& t, const Refinement& r, const Locator& locator, Figures& figures)
{
  const Refinement_locator built(t, r);
  Random random(1);
  const double size = diameter(r.corner_uv);
  const auto check_found = [&](const std::array<double, 2>& uv)
  {
    const auto found = locator.surface_points(uv);
    BOOST_TEST((faces_of(found) == faces_of(r, built.surface_points(uv))));
    BOOST_TEST(std::is_sorted(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.input_face < b.input_face; }));
    for(const auto& p : found)
    {
      BOOST_TEST((p.barycentric[0] >= 0 && p.barycentric[1] >= 0 && p.barycentric[2] >= 0));
      BOOST_TEST(std::abs(p.barycentric[0] + p.barycentric[1] + p.barycentric[2] - 1) <= few_roundings);
      const double back = distance(locator.layout_point(p.input_face, p.barycentric).uv, uv) / size;
      figures.round_trip = (std::max)(figures.round_trip, back);
      BOOST_TEST(back <= (std::min)(few_roundings * (1 + condition(locator.face_map(p.input_face), p.barycentric).uv / size), meaningless));
    }
    return found;
  };
  for(int i = 0; i < 200; ++i)
  {
    const Index f = random.below(t.number_of_faces());
    const Place b = random_place(random);
    const auto there = locator.layout_point(f, b);
    const double apart = distance(there.uv, built.layout_point(f, b).uv) / size;
    figures.from_refinement = (std::max)(figures.from_refinement, apart);
    const double bound = few_roundings * (1 + condition(locator.face_map(f), b).uv / size);
    BOOST_TEST(apart <= bound);
    const auto scaled = locator.layout_point(f, {{ 1e300 * b[0], 1e300 * b[1], 1e300 * b[2] }});
    BOOST_TEST(distance(scaled.uv, there.uv) <= bound * size);

    const auto found = check_found(there.uv);
    const auto same = std::find_if(found.begin(), found.end(), [&](const auto& p) { return p.input_face == f; });
    figures.points += same != found.end();
    if(std::min({b[0], b[1], b[2]}) > 1e-10) // otherwise rounding may have moved the point across an edge
      BOOST_TEST((same != found.end()));
    check_found({{ random(-.6, .6) * size, random(-.6, .6) * size }});
  }
  for(std::size_t c = 0; c < r.corner_uv.size(); c += 1 + r.corner_uv.size() / 100) // corners of several parts
    BOOST_TEST(!check_found(r.corner_uv[c]).empty());
  BOOST_TEST(locator.surface_points({{10 * size, 0}}).empty());
  BOOST_TEST(locator.surface_points({{std::nan(""), 0}}).empty());
  BOOST_TEST(locator.surface_points({{HUGE_VAL, 0}}).empty());
}

// On both sides of an edge points are the same, or moved by the motion across the cut.
void check_continuity(const Triangulation& t, const CE::Cut_graph& cut, const CE::Layout<double>& layout, const Locator& locator,
                      Figures& figures)
{
  Random random(2);
  const double size = diameter(layout.corner);
  std::map<Index, std::pair<Complex, Complex> > motion;
  for(const auto& m : layout.transitions)
    motion[m.halfedge] = { complex(m.rotation), complex(m.translation) };
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    const Index h = t.edge_halfedge(e), g = t.twin(h);
    if(g == null_index)
      continue;
    const Locator::Face_map left = locator.face_map(h / 3), right = locator.face_map(g / 3);
    for(double s : { random(0, 1), random(0, 1e-3), 1 - random(0, 1e-3) })
    {
      const Place b = on_side(h % 3, s);
      Place c = {{0, 0, 0}}; // exactly the same place
      c[g % 3] = b[(h + 1) % 3];
      c[(g + 1) % 3] = b[h % 3];
      const auto p = left.layout_point(b), q = right.layout_point(c);
      BOOST_TEST(std::abs(p.weight / q.weight - 1) <= few_roundings);
      if(!cut[e])
      {
        figures.across_edges = (std::max)(figures.across_edges, distance(p.uv, q.uv) / size);
        BOOST_TEST(distance(p.uv, q.uv) <= few_roundings * size);
      }
      else if(motion.count(h) != 0)
      {
        const Complex moved = motion[h].first * complex(p.uv) + motion[h].second;
        figures.across_cuts = (std::max)(figures.across_cuts, std::abs(moved - complex(q.uv)) / size);
        BOOST_TEST(std::abs(moved - complex(q.uv)) <= 2 * few_roundings * size);
      }
    }
  }
}

Figures check_locator(const Triangulation& t, const Metric& metric, const CE::Cut_graph& cut)
{
  Figures figures;
  const Refinement r = CE::compute_common_refinement(t, metric, cut);
  BOOST_TEST_REQUIRE(bool(r));
  const Locator locator(t, metric, cut);
  BOOST_TEST_REQUIRE(bool(locator));
  BOOST_TEST(locator.amount == r.amount);
  figures.crossings = r.crossings.size();
  const CE::Layout<double> layout = CE::compute_layout(t, metric, cut);
  check_parts(t, r, locator, layout, figures);
  check_points(t, r, locator, figures);
  check_continuity(t, cut, layout, locator, figures);
  return figures;
}

Figures solve_and_check(const Triangulation& t, const Conditions& conditions, const std::vector<Index>& cones, Retriangulation mode)
{
  const Metric metric = CE::compute_conformal_metric(t, conditions, params::retriangulation(mode));
  BOOST_TEST_REQUIRE(bool(metric), CE::message(metric.status));
  const CE::Cut_graph cut = CE::compute_cut_graph(t, cones);
  BOOST_TEST_REQUIRE(bool(cut));
  return check_locator(t, metric, cut);
}

// Some flips drawn at random.
std::vector<Index> random_flips(Triangulation t, Index tries, Random& random)
{
  std::vector<Index> result;
  for(Index k = 0; k < tries; ++k)
  {
    const Index e = random.below(t.number_of_edges());
    if(!t.is_flippable(e))
      continue;
    flip(t, e);
    result.push_back(e);
  }
  return result;
}

} // namespace

// --- maps that are known ------------------------------------------------------------------------

// The paper's map of each triangle, which does not know of refinements.
BOOST_AUTO_TEST_CASE(without_flips_it_is_the_map_of_the_triangles)
{
  for(const Soup& soup : { hill(6, .4), annulus(3, 12, .3) })
  {
    const Triangulation t = triangulation(soup);
    const Metric metric = CE::compute_conformal_metric(t, Conditions(t), params::retriangulation(Retriangulation::NEVER));
    const CE::Cut_graph cut = CE::compute_cut_graph(t, {});
    tell("without flips", check_locator(t, metric, cut));

    const Locator locator(t, metric, cut);
    const CE::Layout<double> layout = CE::compute_layout(t, metric, cut);
    const double size = diameter(layout.corner),
                 least = *std::min_element(metric.log_scale_factors.begin(), metric.log_scale_factors.end());
    Random random(4);
    for(Index f = 0; f < t.number_of_faces(); ++f)
    {
      const Place b = random_place(random);
      const auto there = locator.layout_point(f, b);
      Complex sum(0);
      double weight = 0;
      for(Index k = 0; k < 3; ++k)
      {
        const double w = b[k] * std::exp(least - metric.log_scale_factors[t.origin(3 * f + k)]);
        sum += w * complex(layout.corner[t.previous(3 * f + k)]);
        weight += w;
      }
      BOOST_TEST(std::abs(complex(there.uv) - sum / weight) <= 2 * few_roundings * size); // each of the two
      BOOST_TEST(std::abs(there.weight / weight - 1) <= 2 * few_roundings);
      BOOST_TEST(there.flat_face == f);
      BOOST_TEST(locator.face_map(f).number_of_parts() == 1u);
    }
  }
}

// Polygons inscribed in a circle: the map of all triangles is the same projective one, whatever is flipped.
BOOST_AUTO_TEST_CASE(polygons_in_a_circle)
{
  const double rounding = 24 * 4 * few_roundings; // up to 24 triangles in a row, with weights that differ by some units
  Random random(7);
  double largest = 0;
  std::size_t crossings = 0;
  for(Index n = 4; n <= 24; n += 4)
    for(int repeat = 0; repeat < 3; ++repeat)
    {
      const Ideal_polygon p(n, random);
      const Triangulation& t = p.triangulation;
      Metric metric = flipped_metric(t, random_flips(t, 15 * n, random), p.u);
      for(Index d = 0; d < metric.triangulation.number_of_edges(); ++d) // rounding of repeated flips is not the matter here
      {
        const Index h = metric.triangulation.edge_halfedge(d), i = metric.triangulation.origin(h), j = metric.triangulation.target(h);
        metric.triangulation.set_length(d, std::sqrt(p.height[i] * p.height[j]) * std::abs(p.place[i] - p.place[j]));
      }
      const Locator locator(t, metric, CE::Cut_graph(), 1000000,
        params::layout_frame(CE::Pinned_frame<Index>{0, {{p.place[0].real(), p.place[0].imag()}}, n / 2,
                                                     {{p.place[n / 2].real(), p.place[n / 2].imag()}}}));
      BOOST_TEST_REQUIRE(bool(locator));
      crossings += std::size_t(locator.amount);
      for(Index f = 0; f < t.number_of_faces(); ++f)
      {
        const Locator::Face_map map = locator.face_map(f);
        for(int i = 0; i < 10; ++i)
        {
          const Place b = random_place(random);
          Complex sum(0);
          double weight = 0;
          for(Index k = 0; k < 3; ++k)
          {
            const Index v = t.origin(3 * f + k);
            sum += b[k] * p.height[v] * p.place[v];
            weight += b[k] * p.height[v];
          }
          const auto there = map.layout_point(b);
          largest = (std::max)(largest, std::abs(complex(there.uv) - sum / weight));
          BOOST_TEST(std::abs(complex(there.uv) - sum / weight) <= rounding);
          BOOST_TEST(std::abs(there.weight * *std::max_element(p.height.begin(), p.height.end()) / weight - 1) <= rounding);
          const auto found = locator.surface_points(there.uv);
          BOOST_TEST_REQUIRE(!found.empty());
          BOOST_TEST(std::any_of(found.begin(), found.end(), [&](const auto& q)
          {
            double error = 0, bound = 1e-13;
            for(Index k = 0; k < 3; ++k)
            {
              error += std::abs(q.barycentric[k] - b[k]);
              bound /= t.halfedge_length(3 * f + k);
            }
            return q.input_face == f && error <= bound;
          }));
        }
      }
    }
  BOOST_TEST(crossings > 500u);
  BOOST_TEST_MESSAGE(crossings << " crossings; largest distance " << largest);
}

// --- agreement with the refinement --------------------------------------------------------------

BOOST_AUTO_TEST_CASE(random_curvatures)
{
  Soup noisy = icosphere(1);
  add_noise(noisy, .05, 3);
  for(Retriangulation mode : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
  {
    Figures figures;
    for(const Triangulation& t : { triangulation(icosahedron()), triangulation(noisy) })
      for(unsigned seed = 0; int(seed) < testing::number_of_cases(3); ++seed)
        figures.add(solve_and_check(t, random_angles(t, 1, seed), all_vertices(t), mode));
    BOOST_TEST(figures.crossings > 20u);
    tell("random curvatures", figures);
  }
}

// A torus without cones, with two, and with many; and a surface of genus 2 with one.
BOOST_AUTO_TEST_CASE(cones_and_handles)
{
  const Triangulation ring = triangulation(torus(10, 7));
  Triangulation eight = two_tori();
  Random random(11);
  for(Index e = 0; e < eight.number_of_edges(); ++e)
    eight.set_length(e, random(.7, 1.3));
  for(Retriangulation mode : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
  {
    Figures figures = solve_and_check(ring, Conditions(ring), {}, mode);
    Conditions two(ring);
    two.prescribe_angle_sum(3, Angle::pi_times(3));
    two.prescribe_angle_sum(40, Angle::pi_times(1));
    figures.add(solve_and_check(ring, two, {3, 40}, mode));
    Conditions many(ring); // one of 10 pi, and eight
    many.prescribe_angle_sum(3, Angle::pi_times(10));
    std::vector<Index> cones = {3};
    for(Index v = 7; cones.size() < 9; v += 3)
    {
      many.prescribe_angle_sum(v, Angle::pi_times(1));
      cones.push_back(v);
    }
    figures.add(solve_and_check(ring, many, cones, mode));
    Conditions one(eight);
    one.prescribe_angle_sum(5, Angle::pi_times(6));
    figures.add(solve_and_check(eight, one, {5}, mode));
    BOOST_TEST(figures.crossings > 0u);
    BOOST_TEST(figures.points > 500u);
    BOOST_TEST(figures.across_cuts > 0);
    tell("cones and handles", figures);
  }
}

// Both ends of an edge in one vertex, faces glued to themselves by two sides.
BOOST_AUTO_TEST_CASE(torus_with_one_vertex)
{
  Random random(5);
  Figures figures;
  for(int i = 0; i < testing::number_of_cases(10); ++i)
  {
    const double c = random(.8, 1.2), b = random(.8, 1.2), a = random(.8, 1.2); // one after the other, whatever the compiler
    Triangulation t = one_vertex_torus(a, b, c);
    for(int flips = 0; flips < 5; ++flips)
      flip(t, random.below(3));
    figures.add(solve_and_check(t, Conditions(t), {}, Retriangulation::WHEN_NEEDED));
  }
  BOOST_TEST(figures.crossings > 0u);
  tell("torus with one vertex", figures);
}

// Borders that are crossed: half of a metric of the double.
BOOST_AUTO_TEST_CASE(doubled_metrics)
{
  Soup soup = cone(5, .1);
  Figures figures;
  std::size_t doubled = 0;
  for(double slope : { .05, 1., 9. })
    for(bool is_straight : { false, true })
      for(Retriangulation mode : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
      {
        soup.points[0] = {{.9, 0, slope}};
        const Triangulation t = triangulation(soup);
        Conditions conditions(t);
        if(is_straight)
          for(Index v = 1; v <= 5; ++v)
            conditions.prescribe_angle_sum(v, v == 1 ? Angle::pi_times(1, 30) : v == 2 ? Angle::pi_times(29, 30) : Angle::pi_times(2, 3));
        const Metric metric = CE::compute_conformal_metric(t, conditions, params::retriangulation(mode));
        BOOST_TEST_REQUIRE(bool(metric));
        doubled += metric.is_doubled && !metric.flips.empty();
        figures.add(check_locator(t, metric, CE::Cut_graph()));
      }
  BOOST_TEST(doubled > 0u);
  tell("metrics of the double", figures);
}

// Any flips of any surface, with isolated vertices and several components: the parts do not depend on what the metric is.
BOOST_AUTO_TEST_CASE(any_flips)
{
  std::size_t parts = 0;
  for(const Triangulation& t : { triangulation(icosahedron()), triangulation(torus(5, 4)), triangulation(hill(4, .5)),
                                 triangulation(together({annulus(2, 7, .3), icosahedron()}, true)), one_vertex_torus(1., 1.1, .9) })
    for(unsigned seed = 0; seed < 4; ++seed)
    {
      Random random(seed);
      const Metric metric = flipped_metric(t, random_flips(t, (seed + 1) * t.number_of_edges() / 3, random),
                                           std::vector<double>(t.number_of_vertices(), 0));
      const CE::Cut_graph cut = CE::compute_cut_graph(t, {});
      const Refinement r = CE::compute_common_refinement(t, metric, cut);
      const Locator locator(t, metric, cut);
      BOOST_TEST_REQUIRE((bool(r) && bool(locator)));
      std::vector<std::size_t> expected(t.number_of_faces(), 0);
      for(Index f : r.input_face)
        ++expected[f];
      for(Index f = 0; f < t.number_of_faces(); ++f)
        BOOST_TEST(locator.face_map(f).number_of_parts() == expected[f]);
      parts += r.number_of_faces();
    }
  BOOST_TEST(parts > 1000u);
}

// --- limits -------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(many_crossings)
{
  // the edges in turn: the new ones cross the old ones ever more often, exponentially
  const Triangulation t = one_vertex_torus(1., 1.1, .9);
  const auto twisted = [&](Index n)
  {
    std::vector<Index> flips;
    for(Index k = 0; k < n; ++k)
      flips.push_back(k % 3);
    return flipped_metric(t, flips, {0});
  };
  for(Index n : { 60u, 90u })
  {
    const Metric metric = twisted(n);
    const Locator overflowed(t, metric, CE::Cut_graph());
    BOOST_TEST((overflowed.status == Status::TOO_MANY_CROSSINGS));
    BOOST_TEST(!bool(overflowed));
  }

  // the limit is that of one face; here both have all edges
  const Metric metric = twisted(18);
  const CE::Cut_graph cut = CE::compute_cut_graph(t, {});
  const Refinement r = CE::compute_common_refinement(t, metric, cut);
  BOOST_TEST_REQUIRE(r.crossings.size() > 1000u);
  const std::uint64_t n = r.crossings.size();
  BOOST_TEST((Locator(t, metric, cut, n).status == Status::OK));
  const Locator refused(t, metric, cut, n - 1);
  BOOST_TEST((refused.status == Status::TOO_MANY_CROSSINGS));
  BOOST_TEST(refused.amount == double(n));
  BOOST_TEST((Locator(t, metric, cut, 0).status == Status::TOO_MANY_CROSSINGS));
  BOOST_TEST((Locator(t, twisted(0), cut, 0).status == Status::OK));

  // ... of no more: on a larger surface most crossings are elsewhere
  const Triangulation ring = triangulation(torus(6, 5));
  Random random(3);
  const Metric other = flipped_metric(ring, random_flips(ring, 200, random), std::vector<double>(ring.number_of_vertices(), 0));
  const CE::Cut_graph ring_cut = CE::compute_cut_graph(ring, {});
  const Locator whole(ring, other, ring_cut);
  std::size_t most = 0; // on the sides of one face
  const Refinement all = CE::compute_common_refinement(ring, other, ring_cut);
  std::vector<std::size_t> of_edge(ring.number_of_edges(), 0);
  for(const auto& x : all.crossings)
    ++of_edge[x.input_edge];
  for(Index f = 0; f < ring.number_of_faces(); ++f)
    most = (std::max)(most, of_edge[ring.edge(3 * f)] + of_edge[ring.edge(3 * f + 1)] + of_edge[ring.edge(3 * f + 2)]);
  BOOST_TEST_REQUIRE((most > 3 && most + 10 < all.crossings.size()));
  BOOST_TEST((CE::compute_common_refinement(ring, other, ring_cut, most).status == Status::TOO_MANY_CROSSINGS));
  BOOST_TEST((Locator(ring, other, ring_cut, most).status == Status::OK));
  BOOST_TEST((Locator(ring, other, ring_cut, most - 1).status == Status::TOO_MANY_CROSSINGS));

  const Triangulation nothing;
  BOOST_TEST((Locator(nothing, Metric(), CE::Cut_graph()).status == Status::EMPTY_MESH));
}

// Copies answer for themselves; those of a metric of the double keep the double.
BOOST_AUTO_TEST_CASE(copies)
{
  Soup soup = cone(5, .1);
  soup.points[0] = {{.9, 0, 9}};
  const Triangulation t = triangulation(soup);
  const Metric metric = CE::compute_conformal_metric(t, Conditions(t), params::retriangulation(Retriangulation::ALWAYS));
  BOOST_TEST_REQUIRE(bool(metric));
  std::vector<Locator> copies;
  std::array<double, 2> uv;
  {
    const Locator locator(t, metric, CE::Cut_graph());
    uv = locator.layout_point(2, {{.2, .3, .5}}).uv;
    copies.push_back(locator);
  }
  BOOST_TEST((copies[0].layout_point(2, {{.2, .3, .5}}).uv == uv));
  BOOST_TEST(!copies[0].surface_points(uv).empty());
}

// --- other numbers ------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(more_digits)
{
  typedef boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<50>, boost::multiprecision::et_off> Real_50;
  const Triangulation t = triangulation(torus(6, 5));
  const std::vector<Index> cones = {3, 20};
  Conditions conditions(t);
  conditions.prescribe_angle_sum(3, Angle::pi_times(7, 2));
  conditions.prescribe_angle_sum(20, Angle::pi_times(1, 2));
  const Metric metric = CE::compute_conformal_metric(t, conditions, params::retriangulation(Retriangulation::ALWAYS));
  BOOST_TEST_REQUIRE((bool(metric) && !metric.flips.empty()));
  const CE::Cut_graph cut = CE::compute_cut_graph(t, cones);
  Random random(3);
  const auto wide_input = t.with_lengths(std::vector<Real_50>(t.lengths().begin(), t.lengths().end()));
  const auto wide_metric = CE::convert_metric<Real_50>(metric);
  const CE::Surface_locator<Real_50> fine(wide_input, wide_metric, cut);
  const Locator coarse(t, metric, cut);
  BOOST_TEST_REQUIRE((bool(fine) && bool(coarse)));
  const double size = diameter(CE::compute_layout(t, metric, cut).corner);
  for(Index f = 0; f < t.number_of_faces(); f += 7)
  {
    const Place b = random_place(random);
    const auto there = fine.layout_point(f, {{ Real_50(b[0]), Real_50(b[1]), Real_50(b[2]) }});
    const auto roughly = coarse.layout_point(f, b);
    // ten strips long
    BOOST_TEST(distance({{ static_cast<double>(there.uv[0]), static_cast<double>(there.uv[1]) }}, roughly.uv) <= 10 * few_roundings * size);
    BOOST_TEST(there.flat_face == roughly.flat_face);
    double nearest = HUGE_VAL;
    for(const auto& p : fine.surface_points(there.uv))
      if(p.input_face == f)
        for(std::size_t k = 0; k < 3; ++k)
        {
          const double difference = std::abs(static_cast<double>(Real_50(p.barycentric[k] - b[k] / (Real_50(b[0]) + b[1] + b[2]))));
          nearest = k == 0 ? difference : (std::max)(nearest, difference);
        }
    BOOST_TEST(nearest <= wide_rounding);
  }
}

// --- meshes -------------------------------------------------------------------------------------

// The barycentric coordinates of a mesh's faces are those of the triangulation.
BOOST_AUTO_TEST_CASE(face_locations)
{
  const Mesh sm = surface_mesh<Mesh>(hill(5, .5));
  const CE::Imported_mesh<Mesh> mesh = CE::import_mesh(sm);
  const Triangulation& t = mesh.triangulation;
  const Metric metric = CE::compute_conformal_metric(t, Conditions(t), params::retriangulation(Retriangulation::ALWAYS));
  BOOST_TEST_REQUIRE(bool(metric));
  const Locator locator(t, metric, CE::Cut_graph());
  std::map<Vertex, std::array<double, 2> > uv; // a disk without cuts: one place for every vertex
  for(Face fd : faces(sm))
  {
    Halfedge h = halfedge(fd, sm);
    for(Index k = 0; k < 3; ++k, h = next(h, sm))
    {
      const auto there = locator.layout_point(mesh.index_of_face(fd), on_side(k, 0)).uv;
      BOOST_TEST((uv.emplace(source(h, sm), there).first->second == there));
      for(const auto& p : locator.surface_points(there))
      {
        Halfedge g = halfedge(mesh.face(p.input_face), sm);
        for(Index m = 0; m < 3; ++m, g = next(g, sm))
          BOOST_TEST(p.barycentric[m] == (source(g, sm) == source(h, sm) ? 1 : 0));
      }
    }
  }
}

// Disks that the fixed triangulation cannot do, with more parts than faces.
BOOST_AUTO_TEST_CASE(disks_that_need_flips, * needs_mesh("degtri_sliding.off"))
{
  for(const char* name : { "corner_tris_with_hole.off", "degtri_sliding.off", "cylinder_locally_refined.off" })
    BOOST_TEST_CONTEXT(name)
    {
      const Mesh sm = read_mesh(name);
      const CE::Imported_mesh<Mesh> mesh = CE::import_mesh(sm);
      std::vector<Index> missing;
      const Triangulation& t = mesh.triangulation;
      const Metric metric = CE::compute_conformal_metric(t, CE::read_conditions(mesh, missing),
                                                         params::retriangulation(Retriangulation::WHEN_NEEDED));
      BOOST_TEST_REQUIRE(bool(metric));
      const CE::Cut_graph cut = CE::compute_cut_graph(t, {});
      const CE::internal::Stopwatch stopwatch;
      const Refinement r = CE::compute_common_refinement(t, metric, cut);
      const double refined = stopwatch.seconds();
      const Locator locator(t, metric, cut);
      const double prepared = stopwatch.seconds() - refined;
      Figures figures;
      figures.crossings = r.crossings.size();
      check_points(t, r, locator, figures);
      BOOST_TEST(figures.crossings > 0u);
      tell(name, figures);
      BOOST_TEST_MESSAGE("  " << t.number_of_faces() << " faces, refinement " << refined << " s, locator " << prepared << " s");
    }
}
