// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Layouts of triangulations that know no mesh: the motions across cuts, lattices of tori, several pieces.

#define BOOST_TEST_MODULE test_compute_layout
#include "include/boost_test.h"
#include "include/flipped_metrics.h"
#include "include/test_meshes.h"
#include "include/tolerances.h"

#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/compute_cut_graph.h>
#include <CGAL/Conformal_equivalence/compute_layout.h>
#include <CGAL/Conformal_equivalence/discrete_metric.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <random>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;
using testing::complex;
using testing::few_roundings;
using testing::Complex;
using testing::Conditions;
using testing::Index;
using testing::Metric;
using testing::pi;
using testing::rounded_layout;
using testing::solved_u;
using testing::Triangulation;
using CE::Status;

namespace {

typedef CE::Layout<double>                Layout;

Metric solved(const Triangulation& t, const Conditions& conditions)
{
  const Metric metric = CE::compute_conformal_metric(t, conditions);
  BOOST_TEST_REQUIRE(bool(metric), CE::message(metric.status));
  return metric;
}

CE::Cut_graph cut_everywhere(const Triangulation& t)
{
  CE::Cut_graph cut;
  cut.is_cut.assign(t.number_of_edges(), 0);
  for(Index e = 0; e < t.number_of_edges(); ++e)
    cut.is_cut[e] = !t.is_border_edge(e);
  return cut;
}

double diameter(const Layout& layout) { return testing::diameter(layout.corner); }

// Every motion takes its side of the cut to the other side, and turns by no more than it should.
void check_transitions(const Triangulation& t, const CE::Cut_graph& cut, const Layout& layout)
{
  const double tolerance = 8 * std::ldexp(diameter(layout), -53);
  std::vector<char> has_motion(t.number_of_edges(), 0);
  for(const auto& motion : layout.transitions)
  {
    const Index h = motion.halfedge, g = t.twin(h);
    has_motion[t.edge(h)] = 1;
    BOOST_TEST(h < g);
    const Complex r = complex(motion.rotation), s = complex(motion.translation);
    BOOST_TEST(std::abs(std::abs(r) - 1) <= few_roundings);
    BOOST_TEST(std::abs(r * complex(layout.corner[h]) + s - complex(layout.corner[t.previous(g)])) <= tolerance);
    BOOST_TEST(std::abs(r * complex(layout.corner[t.previous(h)]) + s - complex(layout.corner[g])) <= tolerance);
  }
  for(Index e = 0; e < t.number_of_edges(); ++e)
    BOOST_TEST((has_motion[e] != 0) == (cut[e] && !t.is_border_edge(e)));
}

// A grid of m x n parallelograms, each cut into two triangles, closed to the torus with periods m a and n b.
Triangulation flat_torus(Index m, Index n, Complex a, Complex b)
{
  testing::Soup soup = testing::torus(m, n);
  Triangulation t = testing::triangulation(soup);
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    const Index h = t.edge_halfedge(e), i = t.origin(h), j = t.target(h);
    const bool along_a = i / n != j / n, along_b = i % n != j % n;
    t.set_length(e, std::abs((along_a ? a : 0.) + (along_b ? b : 0.)));
  }
  return t;
}

Complex in_fundamental_domain(Complex tau)
{
  for(int step = 0; step < 10000; ++step)
  {
    tau -= std::round(tau.real());
    if(std::abs(tau) >= 1)
      break;
    tau = -1. / tau;
  }
  return tau;
}

// The same point, on the left or the right side of the domain.
bool are_equivalent(Complex tau, Complex expected, double tolerance)
{
  for(const Complex& z : { tau, tau + 1., tau - 1., -1. / tau })
    if(std::abs(z - expected) <= tolerance)
      return true;
  return false;
}

} // namespace

// --- motions ------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(annulus_cut_open)
{
  const Index m = 4, n = 24;
  const Triangulation t = testing::triangulation(testing::annulus(m, n, .4));
  const Metric metric = solved(t, Conditions(t));

  CE::Cut_graph cut;
  cut.is_cut.assign(t.number_of_edges(), 0);
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    const Index i = t.origin(t.edge_halfedge(e)), j = t.target(t.edge_halfedge(e));
    if(i % n == 0 && j % n == 0)
      cut.is_cut[e] = 1;
  }
  const Layout layout = CE::compute_layout(t, metric, cut);
  BOOST_TEST((layout.status == Status::OK));
  BOOST_TEST(layout.length_error <= rounded_layout);
  BOOST_TEST(layout.transitions.size() == m);
  BOOST_TEST(layout.lattices.empty());
  check_transitions(t, cut, layout);
  for(const auto& motion : layout.transitions) // one motion for the whole cut
  {
    BOOST_TEST(std::abs(complex(motion.rotation) - complex(layout.transitions[0].rotation)) <= rounded_layout);
    BOOST_TEST(std::abs(complex(motion.translation) - complex(layout.transitions[0].translation)) <= rounded_layout);
  }
  // an annulus that is not cut does not close
  BOOST_TEST(CE::compute_layout(t, metric, CE::Cut_graph()).length_error > 1e-3);
}

// The lateral surface of a frustum of a pyramid is flat already, and turns by the angles at its apex.
BOOST_AUTO_TEST_CASE(frustum_of_a_pyramid)
{
  const Index n = 7;
  const double height = .6;
  const Triangulation t = testing::triangulation(testing::tube(3, n, false, [&](Index i, Index j)
  {
    const double r = 1 + i / 3., phi = 2 * pi * j / n;
    return testing::Point{{r * std::cos(phi), r * std::sin(phi), height * r}};
  }));
  const Metric metric = solved(t, Conditions(t));
  for(double u : metric.log_scale_factors)
    BOOST_TEST(std::abs(u) <= testing::unmoved_u);
  const CE::Cut_graph cut = CE::compute_cut_graph(t, {});
  const Layout layout = CE::compute_layout(t, metric, cut);
  check_transitions(t, cut, layout);
  const double at_apex = 2 * std::asin(std::sin(pi / n) / std::hypot(1, height));
  for(const auto& motion : layout.transitions)
    BOOST_TEST(std::abs(motion.rotation[0] - std::cos(n * at_apex)) <= rounded_layout);
}

// Around cones of angle pi everything turns by multiples of pi, around such of 3 pi / 2 by multiples of pi / 2.
BOOST_AUTO_TEST_CASE(rotations_are_those_of_the_cones)
{
  testing::Soup soup = testing::icosphere(2);
  testing::add_noise(soup, .02, 5);
  const Triangulation t = testing::triangulation(soup);
  for(Index n : { 4, 8, 12 })
  {
    std::vector<Index> cones;
    Conditions conditions(t);
    for(Index i = 0; i < n; ++i)
    {
      cones.push_back(i); // vertices of the icosahedron
      conditions.prescribe_angle_sum(i, CE::Exact_angle<double>::pi_times(std::int32_t(2 * n - 4), std::int32_t(n)));
    }
    const Metric metric = solved(t, conditions);
    const CE::Cut_graph cut = CE::compute_cut_graph(t, cones);
    const Layout layout = CE::compute_layout(t, metric, cut);
    BOOST_TEST(layout.length_error <= rounded_layout);
    check_transitions(t, cut, layout);
    bool turns = false;
    for(const auto& motion : layout.transitions)
    {
      const Complex power = std::pow(complex(motion.rotation), double(n) / 2); // cones of curvature 4 pi / n
      BOOST_TEST(std::abs(power - Complex(1)) <= rounded_layout);
      turns = turns || std::abs(complex(motion.rotation) - Complex(1)) > .1;
    }
    BOOST_TEST(turns);
  }
}

// Every triangle a piece of its own.
BOOST_AUTO_TEST_CASE(motions_between_pieces)
{
  const Triangulation t = testing::triangulation(testing::annulus(3, 12, .3));
  const Metric metric = solved(t, Conditions(t));
  const CE::Cut_graph cut = cut_everywhere(t);
  const Layout layout = CE::compute_layout(t, metric, cut);
  BOOST_TEST((layout.status == Status::OK));
  BOOST_TEST(layout.length_error <= rounded_layout);
  check_transitions(t, cut, layout);
}

// --- tori ---------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(lattices_of_flat_tori)
{
  const Index m = 9, n = 7;
  const std::vector<Complex> taus = { {0, 1}, {.5, std::sqrt(.75)}, {.3, 1.7}, {-.2, 1.1}, {-.5, 3}, {.5, 3}, {0, 12}, {.1, std::sqrt(.99)} };
  for(const Complex& tau : taus)
  {
    const Triangulation flat = flat_torus(m, n, Complex(1. / m), tau / double(n));
    std::vector<double> u = testing::random_numbers(flat.number_of_vertices(), .2, 3);
    const Triangulation t = CE::apply_log_scale_factors(flat, u);
    const Metric metric = solved(t, Conditions(t));
    // u is found, up to a constant
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      BOOST_TEST(std::abs(metric.log_scale_factors[v] + u[v] - metric.log_scale_factors[0] - u[0]) <= solved_u);

    std::vector<CE::Cut_graph> cuts = { CE::compute_cut_graph(t, {}), CE::compute_cut_graph(t, {5, 20}), cut_everywhere(t) };
    CE::Cut_graph ring = cuts[0]; // and one around the torus
    for(Index e = 0; e < t.number_of_edges(); ++e)
      if(t.origin(t.edge_halfedge(e)) / n == 4 && t.target(t.edge_halfedge(e)) / n == 4)
        ring.is_cut[e] = 1;
    cuts.push_back(ring);
    for(const CE::Cut_graph& cut : cuts)
    {
      const Layout layout = CE::compute_layout(t, metric, cut);
      check_transitions(t, cut, layout);
      BOOST_TEST_REQUIRE(layout.lattices.size() == 1u);
      const Complex found = complex(layout.lattices[0].tau);
      const double error = solved_u * std::abs(tau);
      BOOST_TEST(std::abs(found.real()) <= .5 + error);
      BOOST_TEST(std::abs(found) >= 1 - error);
      BOOST_TEST(are_equivalent(found, tau, error), found << " instead of " << tau);
      if(std::abs(std::abs(tau.real()) - .5) <= error || std::abs(std::abs(tau) - 1) <= error)
        BOOST_TEST(found.real() >= -error); // on the boundary: the right side
      const Complex a = complex(layout.lattices[0].periods[0]), b = complex(layout.lattices[0].periods[1]);
      BOOST_TEST(std::abs(b / a - found) <= rounded_layout * std::abs(found));
      // the area of the torus is that of the layout
      double area = 0;
      for(Index h = 0; h < t.number_of_halfedges(); h += 3)
      {
        const Complex p = complex(layout.corner[h]), q = complex(layout.corner[h + 1]), r = complex(layout.corner[h + 2]);
        area += std::imag(std::conj(q - p) * (r - p)) / 2;
      }
      BOOST_TEST(std::abs(std::imag(std::conj(a) * b) / area - 1) <= 2 * rounded_layout);
    }
  }
}

// Translations across the cut are sums of multiples of the periods.
BOOST_AUTO_TEST_CASE(translations_belong_to_the_lattice)
{
  const Triangulation t = testing::triangulation(testing::torus(12, 8, 3, 1.2));
  const Metric metric = solved(t, Conditions(t));
  const CE::Cut_graph cut = CE::compute_cut_graph(t, {});
  const Layout layout = CE::compute_layout(t, metric, cut, params::layout_frame(CE::Layout_frame::UNIT_SQUARE));
  BOOST_TEST_REQUIRE(layout.lattices.size() == 1u);
  const Complex a = complex(layout.lattices[0].periods[0]), b = complex(layout.lattices[0].periods[1]);
  for(const auto& motion : layout.transitions)
  {
    const Complex z = complex(motion.translation);
    const double area = std::imag(std::conj(a) * b);
    const double x = std::imag(std::conj(z) * b) / area, y = std::imag(std::conj(a) * z) / area;
    BOOST_TEST(std::abs(motion.rotation[0] - 1) <= rounded_layout);
    BOOST_TEST(std::abs(x - std::round(x)) <= 2 * rounded_layout);
    BOOST_TEST(std::abs(y - std::round(y)) <= 2 * rounded_layout);
  }
}

// Two triangles glued to a torus with one vertex: their sides are the periods.
BOOST_AUTO_TEST_CASE(torus_with_one_vertex)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for(int i = 0; i < 50; ++i)
  {
    const Complex a(1), b(uniform(random) * 4 - 2, .2 + uniform(random) * 2);
    const Triangulation t = testing::one_vertex_torus(std::abs(a), std::abs(b), std::abs(a + b));
    const Metric metric = solved(t, Conditions(t));
    const CE::Cut_graph cut = CE::compute_cut_graph(t, {});
    BOOST_TEST_REQUIRE(bool(cut));
    const Layout layout = CE::compute_layout(t, metric, cut);
    BOOST_TEST_REQUIRE(layout.lattices.size() == 1u);
    const Complex found = complex(layout.lattices[0].tau), tau = in_fundamental_domain(b / a);
    BOOST_TEST(are_equivalent(found, tau, 2 * solved_u * std::abs(tau)), found << " instead of " << tau);
  }
}

// A torus of revolution is conformally the rectangle with sides 1 and sqrt((R / r)^2 - 1); meshes come closer to
// it with the square of the size of their triangles.
BOOST_AUTO_TEST_CASE(tori_of_revolution)
{
  for(double ratio : { 3., 2., 1.2 })
  {
    const double expected = (std::max)(std::sqrt(ratio * ratio - 1), 1 / std::sqrt(ratio * ratio - 1));
    double errors[3];
    for(int level = 0; level < 3; ++level)
    {
      const Index n = 12 << level;
      const Triangulation t = testing::triangulation(testing::torus(2 * n, n, ratio, 1));
      const Metric metric = solved(t, Conditions(t));
      const Layout layout = CE::compute_layout(t, metric, CE::compute_cut_graph(t, {}));
      BOOST_TEST_REQUIRE(layout.lattices.size() == 1u);
      errors[level] = std::abs(complex(layout.lattices[0].tau) - Complex(0, expected));
    }
    BOOST_TEST(errors[0] <= .1 * expected);
    BOOST_TEST(errors[1] <= errors[0] / 3);
    BOOST_TEST(errors[2] <= errors[1] / 3);
  }
}

// Each torus among others, cut into disks or into single triangles, has the lattice that it has alone.
BOOST_AUTO_TEST_CASE(lattices_of_many_tori)
{
  const std::vector<testing::Soup> shapes = { testing::torus(6, 5), testing::hill(3, .2), testing::torus(8, 6, 3, .7), testing::torus(5, 7, 2, 1) };
  const auto lattices = [](const Triangulation& t, bool is_cut_everywhere)
  {
    const Metric metric = solved(t, Conditions(t));
    return CE::compute_layout(t, metric, is_cut_everywhere ? cut_everywhere(t) : CE::compute_cut_graph(t, {})).lattices;
  };
  for(const bool is_cut_everywhere : { false, true })
  {
    std::vector<Complex> alone, together;
    std::vector<testing::Soup> many;
    for(int repetition = 0; repetition < 20; ++repetition)
      many.insert(many.end(), shapes.begin(), shapes.end());
    for(const testing::Soup& shape : shapes)
      for(const auto& lattice : lattices(testing::triangulation(shape), is_cut_everywhere))
        alone.push_back(complex(lattice.tau));
    BOOST_TEST(alone.size() == 3u);
    for(const auto& lattice : lattices(testing::triangulation(testing::together(many)), is_cut_everywhere))
      together.push_back(complex(lattice.tau));
    BOOST_TEST_REQUIRE(together.size() == 20 * alone.size());
    for(std::size_t i = 0; i < together.size(); ++i) // angle sums are right to 1e-16, and a period is the sum of some dozen edges
      BOOST_TEST(std::abs(together[i] - alone[i % 3]) <= 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(tori_with_cones_have_no_lattice)
{
  const Triangulation t = testing::triangulation(testing::torus(12, 8));
  Conditions conditions(t);
  conditions.prescribe_angle_sum(0, CE::Exact_angle<double>::pi_times(3, 2));
  conditions.prescribe_angle_sum(50, CE::Exact_angle<double>::pi_times(5, 2));
  const Metric metric = solved(t, conditions);
  const CE::Cut_graph cut = CE::compute_cut_graph(t, {0, 50});
  const Layout layout = CE::compute_layout(t, metric, cut);
  check_transitions(t, cut, layout);
  BOOST_TEST(layout.lattices.empty());
}

// Any generators of a lattice, with errors, and in any number.
BOOST_AUTO_TEST_CASE(reduced_basis)
{
  typedef CE::internal::Complex_number<double> Number;
  std::mt19937 random(11);
  std::uniform_int_distribution<int> integer(-9, 9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const double noise = 1e-13, zero = 1e-9; // relative to the lattice: what it is far from being, and what is taken for nothing else
  int complete = 0;
  for(int i = 0; i < 300; ++i)
  {
    const Complex a = std::polar(std::exp(3 * uniform(random)), 4 * uniform(random));
    const Complex b = a * Complex(uniform(random) / 2, 1 + std::abs(uniform(random)));
    CE::internal::Reduced_basis<double> basis(zero * std::abs(a));
    int divisor = 0; // of the determinants of all pairs: 1 iff they generate the lattice
    std::vector<std::array<int, 2> > vectors;
    for(int k = 0; k < 5; ++k)
    {
      vectors.push_back({{integer(random), integer(random)}});
      const Complex error = noise * std::abs(a) * Complex(uniform(random), uniform(random));
      const Complex z = double(vectors[k][0]) * a + double(vectors[k][1]) * b + error;
      basis.insert(Number{z.real(), z.imag()});
      for(int l = 0; l < k; ++l)
      {
        int x = divisor, y = std::abs(vectors[k][0] * vectors[l][1] - vectors[k][1] * vectors[l][0]);
        while(y != 0)
          std::swap(x %= y, y);
        divisor = x;
      }
    }
    BOOST_TEST(basis.is_complete() == (divisor != 0));
    if(divisor == 0)
      continue;
    ++complete;
    const auto found = basis.standard_basis();
    const Complex p(found.first.re, found.first.im), q(found.second.re, found.second.im);
    BOOST_TEST(std::abs(std::imag(std::conj(p) * q) / std::imag(std::conj(a) * b) - divisor) <= zero);
    if(divisor == 1)
      BOOST_TEST(are_equivalent(q / p, in_fundamental_domain(b / a), zero), q / p << " instead of " << b / a);
  }
  BOOST_TEST(complete > 250);
}

// --- several pieces -----------------------------------------------------------------------------

namespace {

struct Box { double low[2] = { HUGE_VAL, HUGE_VAL }, high[2] = { -HUGE_VAL, -HUGE_VAL }; };

std::vector<Box> boxes_of_components(const Triangulation& t, const Layout& layout)
{
  const CE::Surface_components surface = CE::connected_components(t);
  std::vector<Box> boxes(surface.components.size());
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    Box& box = boxes[surface.component_of_vertex[t.target(h)]];
    for(int k = 0; k < 2; ++k)
    {
      box.low[k] = (std::min)(box.low[k], layout.corner[h][k]);
      box.high[k] = (std::max)(box.high[k], layout.corner[h][k]);
    }
  }
  return boxes;
}

bool are_disjoint(const Box& a, const Box& b)
{
  return a.high[0] < b.low[0] || b.high[0] < a.low[0] || a.high[1] < b.low[1] || b.high[1] < a.low[1];
}

} // namespace

BOOST_AUTO_TEST_CASE(pieces_do_not_overlap)
{
  std::vector<testing::Soup> soups;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  for(int i = 0; i < 60; ++i)
  {
    testing::Soup soup = i % 2 == 0 ? testing::hill(1 + i % 5, .3) : testing::cone(3 + i % 7, .4);
    const double x = std::exp(3 * uniform(random)), y = std::exp(2 * uniform(random));
    for(testing::Point& p : soup.points)
      p = {{p[0] * x, p[1] * y, p[2]}};
    soups.push_back(soup);
  }
  const Triangulation t = testing::triangulation(testing::together(soups, true));
  const Metric metric = solved(t, Conditions(t));
  for(CE::Layout_frame frame : { CE::Layout_frame::CANONICAL, CE::Layout_frame::UNIT_SQUARE })
  {
    const Layout layout = CE::compute_layout(t, metric, CE::Cut_graph(), params::layout_frame(frame));
    BOOST_TEST(layout.length_error <= 10 * rounded_layout); // relative to the smallest of the components
    const std::vector<Box> boxes = boxes_of_components(t, layout);
    double area = 0, high[2] = { 0, 0 };
    for(std::size_t i = 0; i < boxes.size(); ++i)
    {
      for(std::size_t j = 0; j < i; ++j)
        BOOST_TEST(are_disjoint(boxes[i], boxes[j]));
      area += (boxes[i].high[0] - boxes[i].low[0]) * (boxes[i].high[1] - boxes[i].low[1]);
      for(int k = 0; k < 2; ++k)
      {
        BOOST_TEST(boxes[i].low[k] >= -few_roundings * boxes[i].high[k]);
        high[k] = (std::max)(high[k], boxes[i].high[k]);
      }
    }
    BOOST_TEST(area > .3 * high[0] * high[1]); // and not much is wasted
    if(frame == CE::Layout_frame::UNIT_SQUARE)
      BOOST_TEST((std::max)(high[0], high[1]) <= 1);
  }
}

// Small pieces beside large ones keep their digits.
BOOST_AUTO_TEST_CASE(pieces_of_all_sizes)
{
  std::vector<testing::Soup> soups;
  for(int i = 0; i < 24; ++i)
  {
    testing::Soup soup = testing::hill(4, .4);
    const double size = std::pow(10., (i * 7) % 24 * 12 - 140);
    for(testing::Point& p : soup.points)
      p = {{p[0] * size, p[1] * size, p[2] * size}};
    soups.push_back(soup);
  }
  const Triangulation t = testing::triangulation(testing::together(soups));
  const Metric metric = solved(t, Conditions(t));
  const Layout layout = CE::compute_layout(t, metric, CE::Cut_graph());
  BOOST_TEST(layout.length_error <= rounded_layout);
  const std::vector<Box> boxes = boxes_of_components(t, layout);
  for(std::size_t i = 0; i < boxes.size(); ++i)
    for(std::size_t j = 0; j < i; ++j)
      BOOST_TEST(are_disjoint(boxes[i], boxes[j]));
}

// A piece lies as it would alone, but for where it is put.
BOOST_AUTO_TEST_CASE(pieces_are_turned_as_if_alone)
{
  const testing::Soup left = testing::hill(5, .5), right = testing::random_height_field(6, .7, 4);
  const Triangulation both = testing::triangulation(testing::together({left, right})), alone = testing::triangulation(right);
  const Metric metric = solved(both, Conditions(both)), metric_alone = solved(alone, Conditions(alone));
  const Layout layout = CE::compute_layout(both, metric, CE::Cut_graph()), expected = CE::compute_layout(alone, metric_alone, CE::Cut_graph());
  const Index first = Index(3 * left.triangles.size());
  const Complex offset = complex(layout.corner[first]) - complex(expected.corner[0]);
  for(Index h = 0; h < alone.number_of_halfedges(); ++h)
    BOOST_TEST(std::abs(complex(layout.corner[first + h]) - complex(expected.corner[h]) - offset) <= rounded_layout);
}

// Triangles are laid out by vectors as they are one by one, whatever their shapes and sizes, up to the error of a few operations on pairs of
// `double`.
BOOST_AUTO_TEST_CASE(vectors_lay_out_as_numbers_do)
{
  typedef CE::internal::Double_double Wide;
  typedef CE::internal::Development_front<Wide> Front;
  const std::vector<double> random = testing::random_numbers(4096, 1, 3);
  std::size_t next = 0;
  const auto number = [&]
  {
    next = (next + 2) % random.size();
    return CE::internal::two_sum(1.5 + random[next], 1e-17 * random[next + 1]);
  };
  for(const double size : {1., 1e-290, 1e-100, 1e100, 1e290})
    for(const double flatness : {1., 1e-3, 1e-14, 1e-25, 0.})
    {
      Front front;
      front.position.push_back({Wide(size), Wide(-size)});
      for(Index i = 0; i < 7; ++i) // less than two whole vectors
      {
        const Wide b = number(), c = number();
        const Wide longest = b + c - flatness * (b < c ? b : c) / 2.;
        const Wide side[] = {longest, b, c};
        for(Index k = 0; k < 3; ++k)
          front.length.push_back(size * side[(i + k) % 3]);
        front.sides.push_back({0, CE::internal::unit_complex(number())});
        front.position.push_back({Wide(0), Wide(0)});
        front.next_sides.insert(front.next_sides.end(), 2, {0, {Wide(0), Wide(0)}});
        front.steps.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, i, 0, i + 1, 2 * i, 2 * i + 1});
      }
      front.steps[3].apex = front.steps[4].beyond_next = front.steps[5].beyond_previous = CE::internal::Development_step::none;
      Front one_by_one = front;
      for(const CE::internal::Development_step& step : one_by_one.steps)
        one_by_one.lay_out(step);
      CE::internal::lay_out_steps(front);
      const auto check = [](const Wide& x, const Wide& y, double unit)
      {
        BOOST_CHECK_EQUAL(isnan(x), isnan(y));
        if(!isnan(x))
          BOOST_CHECK_LE(static_cast<double>(abs(x - y)) / unit, 1e-29);
      };
      for(std::size_t i = 0; i < front.position.size(); ++i)
      {
        check(front.position[i].re, one_by_one.position[i].re, size);
        check(front.position[i].im, one_by_one.position[i].im, size);
      }
      for(std::size_t i = 0; i < front.next_sides.size(); ++i)
      {
        check(front.next_sides[i].direction.re, one_by_one.next_sides[i].direction.re, 1);
        check(front.next_sides[i].direction.im, one_by_one.next_sides[i].direction.im, 1);
      }
    }
}

BOOST_AUTO_TEST_CASE(nothing_to_lay_out)
{
  const Triangulation empty;
  BOOST_TEST((CE::compute_layout(empty, Metric(), CE::Cut_graph()).status == Status::EMPTY_MESH));
}
