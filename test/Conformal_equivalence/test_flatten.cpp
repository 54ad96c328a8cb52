// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// flatten(), with the conditions that it reads and the layout that it writes. What is written is judged
// by the checker of check_flattening.h, which shares no code with the package.

#define BOOST_TEST_MODULE test_flatten
#include "include/boost_test.h"
#include "include/border_maps.h"
#include "include/flattened_meshes.h"
#include "include/tolerances.h"

#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/compute_layout.h>
#include <CGAL/Conformal_equivalence/discrete_metric.h>
#include <CGAL/Conformal_equivalence/edge_lengths.h>
#include <CGAL/Conformal_equivalence/flatten.h>

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/Face_filtered_graph.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <set>
#include <string>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;
using namespace testing;
using CE::Status;

namespace {

typedef CE::Flattening_report<Mesh> Report;
typedef Border_maps                 Maps;

// The figures known have so many digits.
constexpr double printed = 1e-6;

// Radians: what is left of Gauss and Bonnet's formula, by a sum of some hundred angles.
constexpr double angle_sum_rounding = 300 * few_roundings;

const double infinity = std::numeric_limits<double>::infinity();
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

// The border turns equally everywhere.
void prescribe_circle(Maps& m)
{
  const std::vector<Vertex> border = border_vertices(m.sm);
  for(Vertex v : border)
    m.angle[v] = CGAL_PI - 2 * CGAL_PI / double(border.size());
}

double least(const Mesh::Property_map<Vertex, double>& map) { return *std::min_element(map.begin(), map.end()); }
double largest(const Mesh::Property_map<Vertex, double>& map) { return *std::max_element(map.begin(), map.end()); }

// Everything that a flattening with natural border promises.
void check_natural(Maps& m, const Report& report)
{
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  BOOST_TEST((report.status == Status::OK), CE::message(report));
  BOOST_TEST(report.statistics.residual <= solver_tolerance);
  BOOST_TEST(report.layout_length_error <= 4 * rounding_of_lengths(m.sm, m.uv));
  BOOST_TEST(report.topology.is_disk());
  const checking::Verdict verdict = judge(m.sm, m.uv);
  BOOST_TEST(verdict.is_good(), verdict);

  for(Halfedge h : halfedges(m.sm))
  {
    if(is_border(h, m.sm))
    {
      BOOST_TEST((m.uv[h] == m.uv[prev(opposite(h, m.sm), m.sm)]));
      BOOST_TEST(m.u[target(h, m.sm)] == 0);
    }
    BOOST_TEST((m.uv[h] == m.uv[opposite(next(h, m.sm), m.sm)])); // one corner a vertex: nothing is cut
  }
  const double tolerance = (std::max)(solved_u, 16 * rounding_of_lengths(m.sm, m.uv));
  const double least_u = (std::min)(0., least(m.u));
  for(Edge e : edges(m.sm))
  {
    const Halfedge h = halfedge(e, m.sm);
    BOOST_TEST(std::abs(uv_length(m.sm, m.uv, is_border(h, m.sm) ? opposite(h, m.sm) : h) / m.scaled[e] - 1) <= tolerance);
  }
  for(Vertex v : vertices(m.sm))
    if(!m.sm.is_isolated(v))
      BOOST_TEST(std::abs(std::log(m.weight[v]) - (least_u - m.u[v])) <= solved_u);
}

template <typename Range>
std::set<std::size_t> set_of(const Range& range) { return std::set<std::size_t>(range.begin(), range.end()); }

} // namespace

// --- natural border -----------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(generated_disks)
{
  const std::vector<Soup> soups = {
    flat_grid(6), hill(10, .5), random_height_field(8, .8, 7), cone(7, .8), cone(3, .2), star(6),
    rings(6, [](double x, double y) { return .5 * std::exp(-3 * (x * x + y * y)); }),
    symmetric_grid(4, [](double x, double y) { return .3 * x * y; }),
    one_triangle({{0, 0, 0}}, {{1, 0, 0}}, {{.3, 2, 1}}),
    Soup{{{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, .5}}, {{0, 1, -.5}}}, {{{0, 1, 2}}, {{0, 2, 3}}}} };
  for(const Soup& soup : soups)
    for(double factor : { 1., 1e-150, 1e150 })
    {
      Maps m(scaled(soup, factor));
      check_natural(m, m.flatten());
    }
}

BOOST_AUTO_TEST_CASE(size_does_not_matter)
{
  Maps one(hill(8, .5)), small(scaled(hill(8, .5), std::ldexp(1., -500))), large(scaled(hill(8, .5), 1e150));
  check_natural(one, one.flatten());
  check_natural(small, small.flatten());
  check_natural(large, large.flatten());
  for(Vertex v : vertices(one.sm))
  {
    BOOST_TEST(std::abs(one.u[v] - small.u[v]) <= unmoved_u);
    BOOST_TEST(std::abs(one.u[v] - large.u[v]) <= solved_u);
  }
}

BOOST_AUTO_TEST_CASE(needles)
{
  const std::vector<Soup> soups = {
    one_triangle({{0, 0, 0}}, {{1, 0, 0}}, {{.5, 1e-7, 0}}),
    one_triangle({{0, 0, 0}}, {{1e-12, 0, 0}}, {{0, 1, 0}}),
    scaled(flat_grid(5), 1, 1e-6, 1), scaled(hill(5, .01), 1, 1e-3, 1e-3) };
  for(const Soup& soup : soups)
  {
    Maps m(soup);
    check_natural(m, m.flatten());
  }
  // so flat that its lengths are those of a segment
  Maps m(one_triangle({{0, 0, 0}}, {{1, 0, 0}}, {{.5, 1e-12, 0}}));
  const Report report = m.flatten(params::retriangulation(CE::Retriangulation::NEVER));
  BOOST_TEST((report.status == Status::DEGENERATE_METRIC), CE::message(report));
  BOOST_TEST(report.faces.size() == 1u);
  BOOST_TEST(m.is_untouched());

  // So thin that most places of the plane have no coordinates for it. But the border keeps its lengths, so that u is 0 and the layout is the
  // triangle as it is; and its frame puts the long direction into the first axis, so that the second coordinates of the short side are close
  // to 0, where numbers of any size have all of their digits.
  for(const Point& p : { Point{{1e-300, 0, 0}}, Point{{1e-17, 0, 0}}, Point{{1e-17, 1e-17, 0}} })
  {
    Maps thin(one_triangle({{0, 0, 0}}, p, {{-.4, 1, .3}}));
    const Report verdict = thin.flatten();
    BOOST_TEST((verdict.status == Status::OK), CE::message(verdict));
    BOOST_TEST(judge(thin.sm, thin.uv).not_positive_triangles == 0u);
    for(Halfedge h : halfedges(thin.sm))
      if(!is_border(h, thin.sm))
        BOOST_TEST(std::abs(uv_length(thin.sm, thin.uv, h) / thin.scaled[edge(h, thin.sm)] - 1) <= 16 * std::ldexp(1., -53));
  }
}

BOOST_AUTO_TEST_CASE(disks_of_CGAL, * needs_mesh("lion-head.off"))
{
  for(const std::string& name : good_disks())
    BOOST_TEST_CONTEXT(name)
    {
      Maps m(read_mesh(name));
      check_natural(m, m.flatten());
    }
}

BOOST_AUTO_TEST_CASE(figures_of_lion_head, * needs_mesh("lion-head.off"))
{
  Maps m(read_mesh("lion-head.off"));
  const Report report = m.flatten();
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  BOOST_TEST(report.statistics.number_of_iterations == 5u); // in `double`, until the steps in wide numbers follow
  BOOST_TEST(std::abs(least(m.u) + 4.468335) <= printed);
  BOOST_TEST(std::abs(largest(m.u)) <= printed);
  BOOST_TEST(report.topology.number_of_vertices == num_vertices(m.sm));
}

BOOST_AUTO_TEST_CASE(figures_of_three_peaks, * needs_mesh("three_peaks.off"))
{
  Maps m(read_mesh("three_peaks.off"));
  const Report report = m.flatten();
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  BOOST_TEST(std::abs(least(m.u) + 4.942533) <= printed);
  BOOST_TEST(std::abs(largest(m.u) - .075819) <= printed);
}

BOOST_AUTO_TEST_CASE(what_the_fixed_triangulation_cannot_do, * needs_mesh("cylinder_locally_refined.off"))
{
  for(const char* name : { "cylinder_locally_refined.off", "mannequin-devil.off", "blob.off",
                           "corner_tris_with_hole.off", "degtri_sliding.off" })
    BOOST_TEST_CONTEXT(name)
    {
      Maps m(read_mesh(name));
      const Report report = m.flatten(params::retriangulation(CE::Retriangulation::NEVER));
      // There is a minimizer: each of these surfaces can be drawn in the plane with straight edges (Fary), and the angles of that drawing keep
      // the energy from falling for ever. It is found; but there, some triangles are broken.
      BOOST_TEST((report.status == Status::DEGENERATE_METRIC), CE::message(report));
      BOOST_TEST(!report.faces.empty());
      BOOST_TEST(report.faces.size() == report.face_indices.size());
      BOOST_TEST(m.is_untouched());
      if(std::string(name) == "cylinder_locally_refined.off")
        BOOST_TEST(set_of(report.face_indices).size() == 6u);
    }
}

// A checker that accepts everything would prove nothing.
BOOST_AUTO_TEST_CASE(checker_refuses_what_is_perturbed)
{
  Maps m(hill(10, .5));
  BOOST_TEST_REQUIRE(bool(m.flatten()));
  BOOST_TEST(judge(m.sm, m.uv).is_good());
  const auto uv = m.sm.add_property_map<Halfedge, Point_2>("h:perturbed").first;

  // one vertex, by 1e-6 of an edge
  const auto original = [&] { for(Halfedge h : halfedges(m.sm)) uv[h] = m.uv[h]; };
  original();
  Vertex inner = *vertices(m.sm).begin();
  for(Vertex v : vertices(m.sm))
    if(!CGAL::is_border(v, m.sm))
      inner = v;
  for(Halfedge h : CGAL::halfedges_around_target(inner, m.sm))
    uv[h] = Point_2(m.uv[h].x() + 1e-6 * .1, m.uv[h].y());
  BOOST_TEST(!judge(m.sm, uv).cross_ratio.is_good());

  // all vertices, as one piece: the two sides of edges still agree
  original();
  for(Vertex v : vertices(m.sm))
  {
    Random random(v.idx());
    const double dx = random(-1e-7, 1e-7), dy = random(-1e-7, 1e-7);
    for(Halfedge h : CGAL::halfedges_around_target(v, m.sm))
      uv[h] = Point_2(m.uv[h].x() + dx, m.uv[h].y() + dy);
  }
  const checking::Verdict verdict = judge(m.sm, uv);
  BOOST_TEST(verdict.two_sides.is_good());
  BOOST_TEST(!verdict.cross_ratio.is_good());
  BOOST_TEST(!verdict.border_scale.is_good());

  // a mirror image
  for(Halfedge h : halfedges(m.sm))
    uv[h] = Point_2(-m.uv[h].x(), m.uv[h].y());
  BOOST_TEST(judge(m.sm, uv).not_positive_triangles == num_faces(m.sm));
}

BOOST_AUTO_TEST_CASE(numbering_does_not_matter)
{
  const Soup soup = hill(9, .7);
  Random random(5);
  std::vector<Index> vertex(soup.points.size()), face(soup.triangles.size());
  const auto shuffle = [&](std::vector<Index>& order)
  {
    std::iota(order.begin(), order.end(), 0u);
    for(Index i = Index(order.size()); i > 1; --i)
      std::swap(order[i - 1], order[random.below(i)]);
  };
  shuffle(vertex);
  shuffle(face);
  Soup other = soup;
  for(Index v = 0; v < vertex.size(); ++v)
    other.points[vertex[v]] = soup.points[v];
  for(Index f = 0; f < face.size(); ++f)
  {
    auto t = soup.triangles[f];
    std::rotate(t.begin(), t.begin() + random.below(3), t.end());
    other.triangles[face[f]] = {{vertex[t[0]], vertex[t[1]], vertex[t[2]]}};
  }
  Maps a(soup), b(other);
  BOOST_TEST_REQUIRE(bool(a.flatten()));
  BOOST_TEST_REQUIRE(bool(b.flatten()));
  for(Index v = 0; v < vertex.size(); ++v)
  {
    const Vertex va(v), vb(vertex[v]);
    BOOST_TEST(std::abs(a.u[va] - b.u[vb]) <= rounded_u);
    BOOST_TEST(plane_distance(a.uv[halfedge(va, a.sm)], b.uv[halfedge(vb, b.sm)]) <= rounded_layout);
  }
}

BOOST_AUTO_TEST_CASE(isolated_vertices_are_carried_through)
{
  Soup soup = together({hill(6, .4)}, true);
  soup.points.push_back({{not_a_number, not_a_number, not_a_number}});
  Maps m(soup), plain(hill(6, .4));
  const Report report = m.flatten();
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  BOOST_TEST(report.topology.number_of_isolated_vertices == 2u);
  BOOST_TEST_REQUIRE(bool(plain.flatten()));
  for(Vertex v : vertices(m.sm))
    if(m.sm.is_isolated(v))
    {
      BOOST_TEST(m.u[v] == unwritten);
      BOOST_TEST(m.weight[v] == unwritten);
    }
    else
      BOOST_TEST(m.u[v] == plain.u[Vertex(v.idx() - 1)]);
}

// --- other conditions ---------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(border_angles)
{
  for(const Soup& soup : { hill(8, .5), cone(7, .8), star(6), random_height_field(7, .5, 3) })
  {
    Maps m(soup);
    prescribe_circle(m);
    const Report report = m.flatten(params::border_angle_map(m.angle));
    BOOST_TEST_REQUIRE(bool(report), CE::message(report));
    BOOST_TEST(report.statistics.angle_defect_spread <= solver_tolerance);
    const checking::Verdict verdict = judge(m.sm, m.uv, false);
    BOOST_TEST(verdict.is_good(), verdict);
    const double tolerance = (std::max)(layout_angle, 64 * rounding_of_lengths(m.sm, m.uv));
    for(Vertex v : border_vertices(m.sm))
      BOOST_TEST(std::abs(uv_angle_sum(m.sm, m.uv, v) - m.angle[v]) <= tolerance);
    double sum = 0;
    for(Vertex v : vertices(m.sm))
      sum += m.u[v];
    BOOST_TEST(std::abs(sum) <= rounded_u * double(num_vertices(m.sm)));
  }
}

BOOST_AUTO_TEST_CASE(border_scale_factors)
{
  Maps m(hill(8, .5));
  for(Vertex v : border_vertices(m.sm))
    m.fixed_u[v] = .5 * std::sin(5 * m.sm.point(v).x()) + .2 * m.sm.point(v).y();
  const Report report = m.flatten(params::prescribed_log_scale_factor_map(m.fixed_u));
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  const checking::Verdict verdict = judge(m.sm, m.uv, false);
  BOOST_TEST(verdict.is_good(), verdict);
  for(Halfedge h : CGAL::halfedges_around_face(border_halfedge(m.sm), m.sm))
  {
    const Vertex v = source(h, m.sm), w = target(h, m.sm);
    BOOST_TEST(m.u[w] == m.fixed_u[w]);
    const double l = std::sqrt(CGAL::squared_distance(m.sm.point(v), m.sm.point(w)));
    BOOST_TEST(std::abs(uv_length(m.sm, m.uv, opposite(h, m.sm)) / (l * std::exp((m.fixed_u[v] + m.fixed_u[w]) / 2)) - 1) <= solved_u);
  }
}

BOOST_AUTO_TEST_CASE(angles_here_and_scale_factors_there)
{
  Maps m(hill(8, .5));
  for(Vertex v : border_vertices(m.sm))
  {
    const Point_3 p = m.sm.point(v);
    m.is_fixed[v] = p.y() > .5;
    m.fixed_u[v] = .3 * p.x();
    m.angle[v] = p.y() == 0 && (p.x() == 0 || p.x() == 1) ? CGAL_PI / 2 : CGAL_PI;
  }
  // two orders of one chain, and a chain of two halves, mean the same
  const auto a = params::border_angle_map(m.angle).prescribed_log_scale_factor_map(m.fixed_u).vertex_is_constrained_map(m.is_fixed);
  const Report report = m.flatten(a);
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  const checking::Verdict verdict = judge(m.sm, m.uv, false);
  BOOST_TEST(verdict.is_good(), verdict);
  for(Vertex v : border_vertices(m.sm))
  {
    if(m.is_fixed[v])
      BOOST_TEST(m.u[v] == m.fixed_u[v]);
    else
      BOOST_TEST(std::abs(uv_angle_sum(m.sm, m.uv, v) - m.angle[v]) <= layout_angle);
  }

  const auto same_as_before = [&](const auto& np)
  {
    const auto uv = m.sm.add_property_map<Halfedge, Point_2>("h:again", Point_2(0, 0)).first;
    BOOST_TEST(bool(CE::flatten(m.sm, uv, np)));
    BOOST_TEST(std::equal(uv.begin(), uv.end(), m.uv.begin()));
  };
  same_as_before(params::prescribed_log_scale_factor_map(m.fixed_u).vertex_is_constrained_map(m.is_fixed).border_angle_map(m.angle));
  const auto halves = CE::combine_named_parameters(params::vertex_is_constrained_map(m.is_fixed),
                                                   params::border_angle_map(m.angle).prescribed_log_scale_factor_map(m.fixed_u));
  same_as_before(halves);
  same_as_before(halves.gradient_tolerance(solver_tolerance).number_of_iterations(99));
  // of two values the last counts
  same_as_before(CE::combine_named_parameters(params::border_angle_map(m.fixed_u), halves));
}

BOOST_AUTO_TEST_CASE(metrics_of_an_annulus)
{
  const Soup soup = annulus(4, 24, .4);
  Maps m(soup);
  const auto t = CE::import_mesh(m.sm).triangulation;
  CE::Conformal_conditions<double> conditions(t);
  for(Index v = 0; v < t.number_of_vertices(); ++v) // outer border: u; inner border: angles
    if(t.is_border_vertex(v) && v < 24)
      conditions.prescribe_angle_sum(v, CE::Exact_angle<double>::pi_times(13, 12));
  for(const auto& c : { CE::Conformal_conditions<double>(t), conditions })
  {
    const auto metric = CE::compute_conformal_metric(t, c);
    BOOST_TEST_REQUIRE(bool(metric), CE::message(metric.status));
    BOOST_TEST(metric.statistics.residual <= solver_tolerance);
    const std::vector<double> sums = CE::angle_sums(CE::apply_log_scale_factors(t, metric.log_scale_factors));
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      if(c.is_fixed(v))
        BOOST_TEST(metric.log_scale_factors[v] == 0);
      else
        BOOST_TEST(std::abs(sums[v] - c.angle_sum(v).radians()) <= layout_angle);
  }

}

// An inversion of space changes the metric conformally, with u = -2 log of the distance from its center.
BOOST_AUTO_TEST_CASE(moebius_transformations)
{
  const Soup soup = hill(8, .6);
  const Point center = {{.3, -.4, 1.5}};
  const double shift = .7; // a similarity on top
  Soup inverted = soup;
  for(Point& p : inverted.points)
  {
    const double d = distance<double>(p, center);
    for(int k = 0; k < 3; ++k)
      p[k] = (p[k] - center[k]) / (d * d);
  }
  Maps m(soup), n(inverted);
  for(Vertex v : vertices(n.sm))
    n.fixed_u[v] = shift + 2 * std::log(distance<double>(soup.points[v], center));

  const auto before = m.sm.add_property_map<Edge, double>("e:before").first;
  const auto after = m.sm.add_property_map<Edge, double>("e:after").first;
  BOOST_TEST(bool(CE::compute_edge_lengths(m.sm, before)));
  for(Edge e : edges(m.sm))
    after[e] = std::sqrt(CGAL::squared_distance(n.sm.point(source(e, m.sm)), n.sm.point(target(e, m.sm))));
  BOOST_TEST(CE::are_conformally_equivalent(m.sm, before, after, solved_u)); // points of both are rounded in units of the whole surface

  BOOST_TEST_REQUIRE(bool(m.flatten()));
  const Report report = n.flatten(params::prescribed_log_scale_factor_map(n.fixed_u));
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  for(Halfedge h : halfedges(m.sm))
    if(!is_border(h, m.sm))
      // edges are a tenth of the layout
      BOOST_TEST(std::abs(uv_length(n.sm, n.uv, h) / (std::exp(shift) * uv_length(m.sm, m.uv, h)) - 1) <= 10 * solved_u);
  for(Vertex v : vertices(m.sm))
    BOOST_TEST(std::abs(n.u[v] - m.u[v] - n.fixed_u[v]) <= 10 * solved_u); // lengths are rounded in units of the whole surface

  // with u = 0 at its border it is another problem
  Maps other(inverted);
  BOOST_TEST_REQUIRE(bool(other.flatten()));
  double difference = 0;
  for(Halfedge h : halfedges(m.sm))
    if(!is_border(h, m.sm))
      difference = (std::max)(difference, std::abs(uv_angle(m.sm, m.uv, h) - uv_angle(other.sm, other.uv, h)));
  BOOST_TEST(difference > 1e-3); // by far more than any error
}

BOOST_AUTO_TEST_CASE(lengths_without_coordinates)
{
  Maps m(hill(7, .5)), bare(hill(7, .5));
  const auto length = bare.sm.add_property_map<Edge, double>("e:length").first;
  BOOST_TEST(bool(CE::compute_edge_lengths(m.sm, length)));
  for(Vertex v : vertices(bare.sm))
    bare.sm.point(v) = Point_3(not_a_number, 0, 0);
  BOOST_TEST_REQUIRE(bool(m.flatten()));
  BOOST_TEST((bare.flatten().status == Status::INVALID_NUMBER));
  BOOST_TEST(bare.is_untouched());
  BOOST_TEST_REQUIRE(bool(bare.flatten(params::edge_length_map(length))));
  BOOST_TEST(std::equal(m.uv.begin(), m.uv.end(), bare.uv.begin()));
}

// --- frames -------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(canonical_frame)
{
  for(double factor : { 1., 1e-150, 1e150 })
  {
    Maps m(scaled(hill(8, .5), factor, 2 * factor, factor));
    BOOST_TEST_REQUIRE(bool(m.flatten(params::layout_frame(CE::Layout_frame::CANONICAL))));
    double area = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    for(Face f : faces(m.sm))
    {
      const Halfedge h = halfedge(f, m.sm);
      Point_2 p[3] = { m.uv[h], m.uv[next(h, m.sm)], m.uv[prev(h, m.sm)] };
      for(Point_2& q : p)
        q = Point_2(q.x() / factor, q.y() / factor);
      const double a = CGAL::area(p[0], p[1], p[2]);
      area += a;
      for(int i = 0; i < 3; ++i)
      {
        x += a * p[i].x() / 3;
        y += a * p[i].y() / 3;
        const Point_2 c((p[i].x() + p[(i + 1) % 3].x()) / 2, (p[i].y() + p[(i + 1) % 3].y()) / 2);
        xx += a * c.x() * c.x() / 3; // exact for quadratic functions
        xy += a * c.x() * c.y() / 3;
        yy += a * c.y() * c.y() / 3;
      }
    }
    BOOST_TEST(std::abs(x / area) <= rounded_layout);
    BOOST_TEST(std::abs(y / area) <= rounded_layout);
    BOOST_TEST(std::abs(xy) <= rounded_layout * (xx + yy));
    BOOST_TEST(xx > 1.5 * yy);
    for(Halfedge h : CGAL::halfedges_around_face(border_halfedge(m.sm), m.sm)) // not scaled
      BOOST_TEST(std::abs(uv_length(m.sm, m.uv, opposite(h, m.sm)) // edges are a tenth of the layout
                          / std::sqrt(CGAL::squared_distance(m.sm.point(source(h, m.sm)), m.sm.point(target(h, m.sm)))) - 1) <= 10 * rounded_layout);
  }
}

BOOST_AUTO_TEST_CASE(unit_square)
{
  for(double factor : { 1., 1e-150, 1e150 })
  {
    Maps m(scaled(hill(8, .5), factor));
    BOOST_TEST_REQUIRE(bool(m.flatten(params::layout_frame(CE::Layout_frame::UNIT_SQUARE))));
    double low[2] = { 1, 1 }, high[2] = { 0, 0 };
    for(Halfedge h : halfedges(m.sm))
      for(int k = 0; k < 2; ++k)
      {
        low[k] = (std::min)(low[k], m.uv[h][k]);
        high[k] = (std::max)(high[k], m.uv[h][k]);
      }
    BOOST_TEST((low[0] >= 0 && low[1] >= 0 && low[0] <= few_roundings && low[1] <= few_roundings));
    BOOST_TEST((high[0] <= 1 && high[1] <= 1 && (std::max)(high[0], high[1]) >= 1 - 10 * few_roundings)); // rather smaller, so that nothing is larger
    const checking::Verdict verdict = judge(m.sm, m.uv);
    BOOST_TEST(verdict.is_good(), verdict);
  }
}

BOOST_AUTO_TEST_CASE(pinned_frame)
{
  for(double factor : { 1., 1e-150, 1e150 })
  {
    Maps m(scaled(hill(8, .5), factor));
    const std::vector<Vertex> border = border_vertices(m.sm);
    const Vertex first = border[3], second = border[17];
    const std::array<double, 2> p{{.1, -7}}, q{{12.3, 1. / 3}};
    BOOST_TEST_REQUIRE(bool(m.flatten(params::layout_frame(CE::Pinned_frame<Vertex>{first, p, second, q}))));
    for(Halfedge h : halfedges(m.sm))
    {
      if(target(h, m.sm) == first)
        BOOST_TEST((m.uv[h] == Point_2(p[0], p[1])));
      if(target(h, m.sm) == second)
        BOOST_TEST((m.uv[h] == Point_2(q[0], q[1])));
    }
    const checking::Verdict verdict = judge(m.sm, m.uv);
    BOOST_TEST(verdict.is_good(), verdict);
  }
}

// --- meshes and kernels -------------------------------------------------------------------------

namespace {

template <typename K>
void check_kernel(double tolerance)
{
  typedef CGAL::Surface_mesh<typename K::Point_3> Other_mesh;
  typedef typename Other_mesh::Halfedge_index Other_halfedge;
  Maps m(hill(6, .5));
  BOOST_TEST_REQUIRE(bool(m.flatten()));
  Other_mesh sm = surface_mesh<Other_mesh>(hill(6, .5));
  auto uv = sm.template add_property_map<Other_halfedge, typename K::Point_2>("h:uv").first;
  const auto report = CE::flatten(sm, uv);
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  for(Halfedge h : halfedges(m.sm))
  {
    const auto p = uv[Other_halfedge(h.idx())];
    BOOST_TEST(std::abs(CGAL::to_double(p.x()) - m.uv[h].x()) <= tolerance);
    BOOST_TEST(std::abs(CGAL::to_double(p.y()) - m.uv[h].y()) <= tolerance);
  }
}

} // namespace

BOOST_AUTO_TEST_CASE(kernels)
{
  check_kernel<CGAL::Exact_predicates_inexact_constructions_kernel>(0);
  check_kernel<CGAL::Exact_predicates_exact_constructions_kernel>(rounded_layout);
  check_kernel<CGAL::Simple_cartesian<float> >(1e-4); // 2^-24 times a condition number below 1000
}

BOOST_AUTO_TEST_CASE(polyhedron)
{
  typedef CGAL::Polyhedron_3<Kernel> Polyhedron;
  Maps m(hill(6, .5));
  BOOST_TEST_REQUIRE(bool(m.flatten()));
  Polyhedron p;
  CGAL::copy_face_graph(m.sm, p);
  auto uv = get(CGAL::dynamic_halfedge_property_t<Point_2>(), p);
  const auto report = CE::flatten(p, uv);
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  const checking::Verdict verdict = judge(p, uv);
  BOOST_TEST(verdict.is_good(), verdict);
}

BOOST_AUTO_TEST_CASE(selected_faces)
{
  Maps m(icosphere(2));
  std::vector<Face> selection;
  for(Face f : faces(m.sm))
  {
    const Halfedge h = halfedge(f, m.sm);
    if(m.sm.point(source(h, m.sm)).z() + m.sm.point(target(h, m.sm)).z() + m.sm.point(target(next(h, m.sm), m.sm)).z() > 1)
      selection.push_back(f);
  }
  const CGAL::Face_filtered_graph<Mesh> patch(m.sm, selection);
  const auto report = CE::flatten(patch, m.uv, params::log_scale_factor_map(m.u));
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  BOOST_TEST(report.topology.number_of_faces == selection.size());
  const checking::Verdict verdict = judge(patch, m.uv);
  BOOST_TEST(verdict.is_good(), verdict);
  for(Halfedge h : halfedges(m.sm))
  {
    const Halfedge g = opposite(h, m.sm);
    if(!patch.is_in_cc(face(h, m.sm)) && patch.is_in_cc(face(g, m.sm))) // the border of the patch
      BOOST_TEST((m.uv[h] == m.uv[prev(g, m.sm)]));
    else
      BOOST_TEST(((m.uv[h] == Point_2(unwritten, unwritten)) == !patch.is_in_cc(face(h, m.sm))));
  }
  for(Vertex v : vertices(m.sm))
    BOOST_TEST((m.u[v] == unwritten) == !patch.is_in_cc(v));
}

// --- the solver's parameters --------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(parameters_of_the_solver)
{
  Maps m(hill(8, .7)), other(hill(8, .7));
  const Report natural = m.flatten();
  BOOST_TEST_REQUIRE(bool(natural));
  const auto is_same = [&](double tolerance)
  {
    for(Vertex v : vertices(m.sm))
      BOOST_TEST(std::abs(m.u[v] - other.u[v]) <= tolerance);
  };
  BOOST_TEST(bool(other.flatten(params::newton_strategy(CE::Newton_strategy::TRUST_REGION))));
  is_same(solved_u);

  const auto start = other.sm.add_property_map<Vertex, double>("v:start", 0).first;
  const std::vector<double> numbers = random_numbers(num_vertices(m.sm), .2, 9);
  for(Vertex v : vertices(other.sm))
    start[v] = numbers[v];
  BOOST_TEST(bool(other.flatten(params::initial_log_scale_factor_map(start))));
  is_same(solved_u);
  const Report again = other.flatten(params::initial_log_scale_factor_map(m.u));
  BOOST_TEST(bool(again));
  BOOST_TEST(again.statistics.number_of_iterations == 0u);

  typedef CGAL::Eigen_sparse_matrix<double>::EigenType Matrix;
  const CGAL::Eigen_solver_traits<Eigen::SimplicialLLT<Matrix> > solver;
  BOOST_TEST(bool(other.flatten(params::gradient_tolerance(solver_tolerance).sparse_linear_solver(solver))));
  is_same(rounded_u);

  const auto point = other.sm.add_property_map<Vertex, Point_3>("v:other_point").first;
  for(Vertex v : vertices(other.sm))
    std::swap(point[v], other.sm.point(v)); // now all at the origin
  BOOST_TEST((other.flatten().status == Status::ZERO_LENGTH_EDGE));
  BOOST_TEST(bool(other.flatten(params::gradient_tolerance(solver_tolerance).vertex_point_map(point).number_of_iterations(50))));
  is_same(0);

  Maps poor(hill(8, .7));
  const Report few = poor.flatten(params::gradient_tolerance(solver_tolerance).number_of_iterations(1));
  BOOST_TEST((few.status == Status::ITERATIONS_EXHAUSTED));
  BOOST_TEST(few.amount > solver_tolerance);
  BOOST_TEST(few.statistics.number_of_iterations == 1u);
  BOOST_TEST(poor.is_untouched());
  const Report rounded = poor.flatten(params::gradient_tolerance(1e-60));
  BOOST_TEST((rounded.status == Status::CONVERGED_TO_ROUNDING), CE::message(rounded));
  BOOST_TEST(rounded.amount > 0);
  BOOST_TEST(rounded.amount < few_roundings);
  BOOST_TEST(!poor.is_untouched());
}

namespace {

struct Counting_visitor
{
  std::vector<CE::Stage> stages;
  std::vector<double> residuals;
  std::size_t patience = 1000;

  void on_stage(CE::Stage stage) { stages.push_back(stage); }
  void on_iteration(std::size_t iteration, double residual)
  {
    BOOST_TEST(iteration == residuals.size());
    residuals.push_back(residual);
  }
  bool go_further() { return residuals.size() < patience; }
};

} // namespace

BOOST_AUTO_TEST_CASE(visitors)
{
  Maps m(hill(8, .7));
  Counting_visitor visitor;
  visitor.patience = 2;
  const Report stopped = m.flatten(params::gradient_tolerance(solver_tolerance).visitor(std::ref(visitor)));
  BOOST_TEST((stopped.status == Status::STOPPED_BY_VISITOR));
  BOOST_TEST(visitor.residuals.size() == 2u);
  BOOST_TEST(stopped.statistics.number_of_iterations == 1u);
  BOOST_TEST(m.is_untouched());

  Counting_visitor impatient;
  impatient.patience = 0;
  BOOST_TEST((m.flatten(params::gradient_tolerance(solver_tolerance).visitor(impatient)).status == Status::STOPPED_BY_VISITOR));
  BOOST_TEST(impatient.stages.empty()); // given by value: the copy has seen them
  BOOST_TEST(m.is_untouched());

  Counting_visitor patient;
  const Report report = m.flatten(params::gradient_tolerance(solver_tolerance).visitor(std::ref(patient)));
  BOOST_TEST_REQUIRE(bool(report));
  BOOST_TEST((patient.stages == std::vector<CE::Stage>{ CE::Stage::IMPORT, CE::Stage::SOLVE, CE::Stage::CUT, CE::Stage::LAYOUT, CE::Stage::VERIFY }));
  BOOST_TEST(patient.residuals.size() == report.statistics.number_of_iterations + 1);
  BOOST_TEST(patient.residuals.back() <= 1e-7); // where the steps in wide numbers, of which it is not told, begin
  BOOST_TEST(report.statistics.residual <= solver_tolerance);
}

// --- bad input ----------------------------------------------------------------------------------

namespace {

struct Refusal : Report // which may be discarded
{
  explicit Refusal(const Report& report) : Report(report) {}
};

template <typename NamedParameters = decltype(params::gradient_tolerance(solver_tolerance))>
Refusal check_refused(Maps& m, Status status, const NamedParameters& np = params::gradient_tolerance(solver_tolerance))
{
  Report copy;
  const Report report = m.flatten(CE::combine_named_parameters(np, params::flattening_report(std::ref(copy))));
  BOOST_TEST((report.status == status), CE::message(report) << ", expected: " << CE::message(status));
  BOOST_TEST((copy.status == status));
  BOOST_TEST(m.is_untouched());
  BOOST_TEST(CE::message(report).find(CE::message(status)) == 0u);
  return Refusal(report);
}

Refusal check_refused(const Soup& soup, Status status)
{
  Maps m(soup);
  return check_refused(m, status);
}

} // namespace

BOOST_AUTO_TEST_CASE(meshes_that_are_no_triangulated_surfaces)
{
  check_refused(Soup(), Status::EMPTY_MESH);
  check_refused(Soup{{{{0, 0, 0}}, {{1, 0, 0}}}, {}}, Status::EMPTY_MESH);

  Mesh quad;
  std::vector<Vertex> corners;
  for(const Point_3& p : { Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(1, 1, 0), Point_3(0, 1, 0) })
    corners.push_back(quad.add_vertex(p));
  quad.add_face(corners);
  Maps m(quad);
  BOOST_TEST((check_refused(m, Status::NOT_TRIANGULATED).face_indices == std::vector<std::size_t>(1, 0)));

  const Soup bow_tie{{{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}, {{-1, 0, 0}}, {{-1, -1, 0}}}, {{{0, 1, 2}}, {{0, 3, 4}}}};
  BOOST_TEST((check_refused(bow_tie, Status::NON_MANIFOLD).vertex_indices == std::vector<std::size_t>(1, 0)));
}

BOOST_AUTO_TEST_CASE(numbers_that_are_no_lengths)
{
  for(double bad : { not_a_number, infinity, -infinity })
  {
    Soup soup = hill(3, .3);
    soup.points[5][1] = bad;
    BOOST_TEST((check_refused(soup, Status::INVALID_NUMBER).vertex_indices == std::vector<std::size_t>(1, 5)));
  }
  // finite, but too far apart
  BOOST_TEST(check_refused(one_triangle({{-1.7e308, 0, 0}}, {{1.7e308, 0, 0}}, {{0, 1, 0}}), Status::INVALID_NUMBER).edges.size() == 1u);

  Soup soup = hill(3, .3);
  soup.points[6] = soup.points[5];
  const Report zero = check_refused(soup, Status::ZERO_LENGTH_EDGE);
  BOOST_TEST_REQUIRE(zero.edge_indices.size() == 1u);
  BOOST_TEST((set_of(zero.edge_indices[0]) == std::set<std::size_t>{ 5, 6 }));

  for(double bad : { not_a_number, infinity, -1. })
  {
    Maps m(hill(3, .3));
    const auto length = m.sm.add_property_map<Edge, double>("e:length", 1.).first;
    length[Edge(4)] = bad;
    const Report report = check_refused(m, Status::INVALID_NUMBER, params::edge_length_map(length));
    BOOST_TEST((report.edges == std::vector<Edge>(1, Edge(4))));
    length[Edge(4)] = 0;
    BOOST_TEST((check_refused(m, Status::ZERO_LENGTH_EDGE, params::edge_length_map(length)).edges == std::vector<Edge>(1, Edge(4))));
  }
}

BOOST_AUTO_TEST_CASE(conditions_that_cannot_be_met)
{
  Maps m(hill(4, .3));
  const Vertex corner(4); // with one triangle
  BOOST_TEST_REQUIRE(degree(corner, m.sm) == 2u);

  // 2 pi is no cone
  Maps flat(hill(4, .3));
  const auto no_cone = flat.sm.add_property_map<Vertex, double>("v:cone_angle", 2 * CGAL_PI).first;
  BOOST_TEST(bool(flat.flatten(params::cone_angle_map(no_cone))));
  for(Vertex v : border_vertices(m.sm))
    m.is_fixed[v] = true;

  m.is_fixed[corner] = false;
  const Report missing = check_refused(m, Status::MISSING_CONDITION, params::prescribed_log_scale_factor_map(m.fixed_u)
                                                                            .vertex_is_constrained_map(m.is_fixed));
  BOOST_TEST((missing.vertices == std::vector<Vertex>(1, corner)));

  // the border as a whole turns too much, or too little
  prescribe_circle(m);
  const Vertex other = border_vertices(m.sm)[0] == corner ? border_vertices(m.sm)[1] : border_vertices(m.sm)[0];
  const double good = m.angle[other];
  for(double wrong : { -1e-3, 1e-3, 1e-8 })
  {
    m.angle[other] = good + wrong;
    const Report report = check_refused(m, Status::GAUSS_BONNET_VIOLATED, params::border_angle_map(m.angle));
    BOOST_TEST(std::abs(std::abs(report.amount) - std::abs(wrong)) <= angle_sum_rounding);
  }
  m.angle[other] = good;

  const double at_corner = m.angle[corner];
  for(double wrong : { 0., -1., CGAL_PI, 4. })
  {
    m.angle[corner] = wrong;
    const Report report = check_refused(m, Status::ANGLE_OUT_OF_RANGE,
                                        params::border_angle_map(m.angle).retriangulation(CE::Retriangulation::NEVER));
    BOOST_TEST((report.vertices == std::vector<Vertex>(1, corner)));
    BOOST_TEST(std::abs(report.amount - wrong) <= angle_sum_rounding);
  }
  for(double wrong : { not_a_number, infinity })
  {
    m.angle[corner] = wrong;
    BOOST_TEST((check_refused(m, Status::INVALID_NUMBER, params::border_angle_map(m.angle)).vertices == std::vector<Vertex>(1, corner)));
    m.fixed_u[corner] = wrong;
    BOOST_TEST((check_refused(m, Status::INVALID_NUMBER, params::prescribed_log_scale_factor_map(m.fixed_u)).vertices
                == std::vector<Vertex>(1, corner)));
  }
  m.angle[corner] = at_corner;
  BOOST_TEST(bool(m.flatten(params::border_angle_map(m.angle)))); // and now it goes

  // one vertex of fixed u has to take all the turning: pi - 2 pi is no angle
  Maps straight(hill(4, .3));
  for(Vertex v : border_vertices(straight.sm))
    straight.angle[v] = degree(v, straight.sm) == 2 ? CGAL_PI / 2 : CGAL_PI;
  straight.is_fixed[border_vertices(straight.sm)[0]] = true;
  straight.is_fixed[corner] = false;
  for(Vertex v : border_vertices(straight.sm))
    if(degree(v, straight.sm) == 2 && straight.is_fixed[v])
      straight.angle[v] = CGAL_PI;
  const Report none_left = check_refused(straight, Status::NO_ANGLE_LEFT, params::border_angle_map(straight.angle)
                                                                                 .vertex_is_constrained_map(straight.is_fixed));
  BOOST_TEST((none_left.vertices == std::vector<Vertex>(1, border_vertices(straight.sm)[0])));
}

BOOST_AUTO_TEST_CASE(modes_of_retriangulation)
{
  Maps never(hill(6, .5)), when_needed(hill(6, .5)), always(hill(6, .5));
  BOOST_TEST(bool(never.flatten(params::retriangulation(CE::Retriangulation::NEVER))));
  const Report report = when_needed.flatten(params::retriangulation(CE::Retriangulation::WHEN_NEEDED));
  BOOST_TEST((report.statistics.conformal_class == CE::Conformal_class::FIXED_TRIANGULATION));
  BOOST_TEST(std::equal(never.uv.begin(), never.uv.end(), when_needed.uv.begin()));
  const Report delaunay = always.flatten(params::retriangulation(CE::Retriangulation::ALWAYS));
  BOOST_TEST_REQUIRE(bool(delaunay), CE::message(delaunay));
  BOOST_TEST((delaunay.statistics.conformal_class == CE::Conformal_class::DELAUNAY_TRIANGULATION));
  for(Vertex v : vertices(always.sm))
    BOOST_TEST(std::abs(always.u[v] - never.u[v]) <= .05);
}

// --- statuses -----------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(every_status_has_a_text_and_an_error_code)
{
  namespace SMP = CGAL::Surface_mesh_parameterization;
  const std::vector<Status> all = {
    Status::OK, Status::CONVERGED_TO_ROUNDING, Status::EMPTY_MESH, Status::NOT_TRIANGULATED, Status::NON_MANIFOLD,
    Status::INVALID_NUMBER, Status::ZERO_LENGTH_EDGE, Status::WRONG_TOPOLOGY, Status::GAUSS_BONNET_VIOLATED,
    Status::NO_ANGLE_LEFT, Status::ANGLE_OUT_OF_RANGE, Status::MISSING_CONDITION, Status::SINGULAR_PROBLEM, Status::ITERATIONS_EXHAUSTED,
    Status::SCALE_OUT_OF_RANGE,
    Status::DEGENERATE_METRIC, Status::NOT_INJECTIVE, Status::SEAM_LEAVES_NO_DISK, Status::SEAM_MISSES_CONE, Status::STOPPED_BY_VISITOR,
    Status::OUT_OF_MEMORY,
    Status::TOO_MANY_CROSSINGS, Status::NOT_REPRESENTABLE, Status::TOO_MANY_CONES, Status::BOUND_NOT_MET, Status::NOT_QUANTIZABLE,
    Status::NOT_SEAMLESS, Status::NOT_REALIZABLE };
  BOOST_TEST(CE::message(static_cast<Status>(all.size())).empty()); // these are all
  std::set<std::string> texts;
  for(std::size_t i = 0; i < all.size(); ++i)
  {
    BOOST_TEST(static_cast<std::size_t>(all[i]) == i);
    texts.insert(CE::message(all[i]));
    BOOST_TEST(CE::is_success(all[i]) == (CE::to_error_code(all[i]) == SMP::OK));
    Report report;
    report.status = all[i];
    BOOST_TEST(bool(report) == CE::is_success(all[i]));
    BOOST_TEST(CE::message(report).find(CE::message(all[i])) == 0u);
  }
  BOOST_TEST(texts.size() == all.size());
  BOOST_TEST(texts.count("") == 0u);
  BOOST_TEST((CE::to_error_code(Status::EMPTY_MESH) == SMP::ERROR_EMPTY_MESH));
  BOOST_TEST((CE::to_error_code(Status::NOT_TRIANGULATED) == SMP::ERROR_NON_TRIANGULAR_MESH));
  BOOST_TEST((CE::to_error_code(Status::WRONG_TOPOLOGY) == SMP::ERROR_NO_TOPOLOGICAL_DISC));
}

BOOST_AUTO_TEST_CASE(messages_say_where)
{
  Report report;
  report.status = Status::DEGENERATE_METRIC;
  for(std::size_t f = 0; f < 12; ++f)
    report.face_indices.push_back(100 + f);
  const std::string text = CE::message(report);
  BOOST_TEST(text.find("faces 100, 101") != std::string::npos, text);
  BOOST_TEST(text.find("109, ... (12 in all)") != std::string::npos, text);
  BOOST_TEST(text.find("110") == std::string::npos, text);
  BOOST_TEST(text.find('\n') == std::string::npos);

  report = Report();
  report.status = Status::ZERO_LENGTH_EDGE;
  report.edge_indices.push_back({{3, 8}});
  BOOST_TEST(CE::message(report).find("edge 3-8") != std::string::npos);
}
