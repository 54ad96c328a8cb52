// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// flatten() on surfaces that are no disks: closed ones, with handles, with several borders, in several components, in charts. What is
// written is judged by the checker of check_flattening.h, which shares no code with the package.

#define BOOST_TEST_MODULE test_flatten_any_topology
#include "include/boost_test.h"
#include "include/flattened_meshes.h"
#include "include/flipped_metrics.h"
#include "include/output_maps.h"
#include "include/tolerances.h"

#include <CGAL/Conformal_equivalence/boundary_conditions.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/make_seam_mesh.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>

#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/Face_filtered_graph.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <queue>
#include <set>
#include <string>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;
using namespace testing;
using CE::Status;

namespace {

typedef CE::Flattening_report<Mesh>  Report;

// With cones, angles at borders, and a seam.
struct Maps : Output_maps
{
  Mesh::Property_map<Vertex, double> cone_angle, border_angle;
  Mesh::Property_map<Vertex, bool> is_fixed;
  Mesh::Property_map<Edge, bool> seam;

  explicit Maps(const Mesh& mesh) : Output_maps(mesh)
  {
    seam = sm.add_property_map<Edge, bool>("e:seam", false).first;
    cone_angle = sm.add_property_map<Vertex, double>("v:cone_angle", 2 * CGAL_PI).first;
    border_angle = sm.add_property_map<Vertex, double>("v:border_angle", CGAL_PI).first;
    is_fixed = sm.add_property_map<Vertex, bool>("v:is_fixed", false).first;
    for(Vertex v : vertices(sm)) // natural borders
      is_fixed[v] = !sm.is_isolated(v) && CGAL::is_border(v, sm).has_value();
  }
  explicit Maps(const Soup& soup) : Maps(surface_mesh<Mesh>(soup)) {}

  template <typename NamedParameters = decltype(params::gradient_tolerance(solver_tolerance))>
  Report flatten(const NamedParameters& np = params::gradient_tolerance(solver_tolerance))
  {
    return CE::flatten(sm, uv, CE::combine_named_parameters(
      parameters().cone_angle_map(cone_angle).vertex_is_constrained_map(is_fixed).edge_is_seam_map(seam), np));
  }

  bool is_untouched() const
  {
    return Output_maps::is_untouched() && std::none_of(seam.begin(), seam.end(), [](bool b) { return b; });
  }
};

using testing::complex; // of a pair of numbers
Complex complex(const Point_2& p) { return Complex(p.x(), p.y()); }

double diameter(const Maps& m) { return uv_diameter(m.sm, m.uv); }

// The seam is exactly where the layout is torn, and the motions in the report take one side to the other.
void check_seam(Maps& m, const Report& report)
{
  const double tolerance = 16 * std::ldexp(diameter(m), -53);
  std::set<Edge> with_motion;
  for(const auto& motion : report.transitions)
  {
    const Halfedge h = motion.halfedge, g = opposite(h, m.sm);
    with_motion.insert(edge(h, m.sm));
    const Complex r = complex(motion.rotation), t = complex(motion.translation);
    BOOST_TEST(std::abs(std::abs(r) - 1) <= few_roundings);
    BOOST_TEST(std::abs(r * complex(m.uv[h]) + t - complex(m.uv[prev(g, m.sm)])) <= tolerance);
    BOOST_TEST(std::abs(r * complex(m.uv[prev(h, m.sm)]) + t - complex(m.uv[g])) <= tolerance);
  }
  for(Edge e : edges(m.sm))
  {
    const Halfedge h = halfedge(e, m.sm), g = opposite(h, m.sm);
    BOOST_TEST(m.seam[e] == (with_motion.count(e) != 0));
    if(m.seam[e])
      BOOST_TEST(!is_border(e, m.sm));
    else if(!is_border(e, m.sm))
      BOOST_TEST((m.uv[h] == m.uv[prev(g, m.sm)] && m.uv[g] == m.uv[prev(h, m.sm)]));
  }
}

// Every piece that the seam leaves is a disk: by the Seam_mesh that is made of it.
void check_disks(Maps& m, std::size_t number_of_pieces)
{
  auto seam = m.sm.add_property_map<Edge, bool>("e:seam_of_seam_mesh", false).first;
  auto on_seam = m.sm.add_property_map<Vertex, bool>("v:on_seam", false).first;
  for(Edge e : edges(m.sm))
    seam[e] = m.seam[e];
  const auto seam_mesh = CE::make_seam_mesh(m.sm, seam, on_seam);
  const auto imported = CE::import_mesh(seam_mesh);
  const CE::Surface_components pieces = CE::connected_components(imported.triangulation);
  BOOST_TEST(pieces.components.size() == number_of_pieces);
  for(const auto& piece : pieces.components)
    BOOST_TEST(piece.is_disk());
  for(auto hd : halfedges(seam_mesh)) // what the documentation promises to users of Seam_mesh
    if(!is_border(hd, seam_mesh))
      BOOST_TEST((m.uv[target(hd, seam_mesh)] == m.uv[hd]));
}

// For the checker: what was prescribed.
checking::Cones cones_of(const Maps& m)
{
  checking::Cones result;
  for(Vertex v : vertices(m.sm))
  {
    if(m.sm.is_isolated(v) || CGAL::is_border(v, m.sm))
      continue;
    if(m.is_fixed[v])
      result[v.idx()] = std::nullopt;
    else if(m.cone_angle[v] != 2 * CGAL_PI)
      result[v.idx()] = m.cone_angle[v];
  }
  return result;
}

// Everything that a flattening of any surface promises.
void check_flat(Maps& m, const Report& report, bool border_keeps_its_lengths = true)
{
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  BOOST_TEST(report.statistics.residual <= solver_tolerance);
  BOOST_TEST(report.layout_length_error <= 4 * rounding_of_lengths(m.sm, m.uv));
  const checking::Verdict verdict = judge(m.sm, m.uv, border_keeps_its_lengths, cones_of(m));
  BOOST_TEST(verdict.is_good(), verdict);
  check_seam(m, report);
  check_disks(m, report.topology.number_of_components);

  const double rounding = 32 * rounding_of_lengths(m.sm, m.uv);
  std::size_t cones = 0;
  for(Vertex v : vertices(m.sm))
  {
    if(m.sm.is_isolated(v) || CGAL::is_border(v, m.sm))
      continue;
    double angle = 2 * CGAL_PI;
    if(cones < report.cones.size() && report.cones[cones].vertex == v)
    {
      BOOST_TEST(report.cones[cones].vertex_index == v.idx());
      BOOST_TEST(report.cones[cones].is_free == m.is_fixed[v]);
      angle = report.cones[cones++].angle;
      if(m.is_fixed[v])
        BOOST_TEST(m.u[v] == 0);
      else
        BOOST_TEST(angle == m.cone_angle[v]);
    }
    else
      BOOST_TEST((!m.is_fixed[v] && m.cone_angle[v] == 2 * CGAL_PI));
    BOOST_TEST(std::abs(uv_angle_sum(m.sm, m.uv, v) - angle) <= (std::max)(layout_angle, rounding * degree(v, m.sm)));
  }
  BOOST_TEST(cones == report.cones.size());
  for(Edge e : edges(m.sm))
  {
    const Halfedge h = halfedge(e, m.sm);
    BOOST_TEST(std::abs(uv_length(m.sm, m.uv, is_border(h, m.sm) ? opposite(h, m.sm) : h) / m.scaled[e] - 1)
               <= (std::max)(few_roundings, rounding));
  }
}

// n vertices of the interior that are far from each other in steps along edges.
std::vector<Vertex> far_vertices(const Mesh& sm, std::size_t n, std::size_t least_degree = 3)
{
  std::vector<Vertex> result;
  auto distance = get(CGAL::dynamic_vertex_property_t<int>(), sm);
  Vertex next = *vertices(sm).begin();
  for(std::size_t i = 0; i <= n; ++i)
  {
    for(Vertex v : vertices(sm))
      put(distance, v, -1);
    std::queue<Vertex> queue;
    for(Vertex v : i == 0 ? std::vector<Vertex>(1, next) : result)
    {
      put(distance, v, 0);
      queue.push(v);
    }
    for(; !queue.empty(); queue.pop())
    {
      const Vertex v = queue.front();
      if(!CGAL::is_border(v, sm) && degree(v, sm) >= least_degree && get(distance, v) > 0)
        next = v; // the last one is the farthest
      for(Vertex w : CGAL::vertices_around_target(halfedge(v, sm), sm))
        if(get(distance, w) < 0)
        {
          put(distance, w, get(distance, v) + 1);
          queue.push(w);
        }
    }
    if(result.size() < n)
      result.push_back(next);
  }
  return result;
}

void equal_cones(Maps& m, std::size_t n, double euler_characteristic, std::size_t least_degree = 3)
{
  for(Vertex v : far_vertices(m.sm, n, least_degree))
    m.cone_angle[v] = 2 * CGAL_PI - 2 * CGAL_PI * euler_characteristic / double(n);
}

} // namespace

// --- closed surfaces ----------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(spheres_with_cones)
{
  Soup noisy = icosphere(2);
  add_noise(noisy, .03, 8);
  for(const Soup& soup : { icosahedron(), icosphere(2), noisy, scaled(icosphere(2), 2, 1, 1), scaled(noisy, 1e-150), scaled(noisy, 1e150) })
    for(std::size_t n : { 3, 4, 6, 8, 12 })
      BOOST_TEST_CONTEXT(soup.points.size() << " vertices, " << n << " cones")
      {
        Maps m(soup);
        equal_cones(m, n, 2);
        const Report report = m.flatten();
        check_flat(m, report);
        BOOST_TEST(report.cones.size() == n);
        BOOST_TEST(report.topology.number_of_borders == 0u);
        BOOST_TEST(CE::verify_layout(m.sm, m.uv).number_of_flipped_triangles == 0u);
      }
}

// All vertices of a tetrahedron cones of pi: any tetrahedron is conformally equivalent to one with opposite edges equal,
// with cross ratios as they are. A regular one keeps its lengths.
BOOST_AUTO_TEST_CASE(tetrahedra)
{
  const Soup regular = { {{{1, 1, 1}}, {{1, -1, -1}}, {{-1, 1, -1}}, {{-1, -1, 1}}}, {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 1}}, {{1, 3, 2}}} };
  Soup other = regular;
  add_noise(other, .2, 3);
  for(const Soup& soup : { regular, other })
  {
    Maps m(soup);
    for(Vertex v : vertices(m.sm))
      m.cone_angle[v] = CGAL_PI;
    const Report report = m.flatten();
    check_flat(m, report);
    for(Edge e : edges(m.sm))
      for(Edge f : edges(m.sm))
        if(!m.sm.is_valid(e) || (source(e, m.sm) != source(f, m.sm) && source(e, m.sm) != target(f, m.sm)
                              && target(e, m.sm) != source(f, m.sm) && target(e, m.sm) != target(f, m.sm)))
          BOOST_TEST(std::abs(m.scaled[e] / m.scaled[f] - 1) <= rounded_u);
    if(soup.points == regular.points)
      for(Vertex v : vertices(m.sm))
        BOOST_TEST(std::abs(m.u[v]) <= unmoved_u);
  }
}

BOOST_AUTO_TEST_CASE(free_cones)
{
  Soup soup = icosphere(2);
  add_noise(soup, .03, 8);
  for(std::size_t n : { 3, 4, 9 })
  {
    Maps m(soup);
    for(Vertex v : far_vertices(m.sm, n))
      m.is_fixed[v] = true;
    const Report report = m.flatten();
    check_flat(m, report);
    double sum = 0;
    for(const auto& cone : report.cones)
      sum += cone.angle;
    // Gauss and Bonnet: the cones get what all the others have left
    BOOST_TEST(std::abs(sum - 2 * CGAL_PI * (double(n) - 2)) <= solver_tolerance * double(num_vertices(m.sm)));

    Maps mixed(soup); // one of them prescribed
    for(Vertex v : far_vertices(mixed.sm, n))
      mixed.is_fixed[v] = true;
    const Vertex first = far_vertices(mixed.sm, n)[0];
    mixed.is_fixed[first] = false;
    mixed.cone_angle[first] = 1.2345;
    const Report mixed_report = mixed.flatten();
    if(n == 3) // two free cones, with a total angle of 2 pi (3 - 2) - 1.2345
      BOOST_TEST(bool(mixed_report), CE::message(mixed_report));
    check_flat(mixed, mixed_report);
  }
}

BOOST_AUTO_TEST_CASE(tori)
{
  Soup noisy = torus(14, 9);
  add_noise(noisy, .1, 6);
  for(const Soup& soup : { torus(3, 3), torus(20, 10), noisy })
  {
    Maps m(soup);
    const Report report = m.flatten();
    check_flat(m, report);
    BOOST_TEST(report.cones.empty());
    BOOST_TEST_REQUIRE(report.lattices.size() == 1u);
    BOOST_TEST(report.lattices[0].face == 0u);
    for(const auto& motion : report.transitions)
      BOOST_TEST(std::abs(motion.rotation[0] - 1) <= rounded_layout);

    Maps with_cones(soup);
    const std::vector<Vertex> far = far_vertices(with_cones.sm, 2, 6);
    with_cones.cone_angle[far[0]] = 3 * CGAL_PI / 2;
    with_cones.cone_angle[far[1]] = 5 * CGAL_PI / 2;
    const Report cone_report = with_cones.flatten();
    check_flat(with_cones, cone_report);
    BOOST_TEST(cone_report.lattices.empty());
  }
}

BOOST_AUTO_TEST_CASE(polyhedron)
{
  typedef CGAL::Polyhedron_3<Kernel> Polyhedron;
  Polyhedron p;
  CGAL::copy_face_graph(surface_mesh<Mesh>(torus(8, 6)), p);
  auto uv = get(CGAL::dynamic_halfedge_property_t<Point_2>(), p);
  auto seam = get(CGAL::dynamic_edge_property_t<bool>(), p);
  for(auto e : edges(p))
    put(seam, e, false);
  const auto report = CE::flatten(p, uv, params::edge_is_seam_map(seam));
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  const checking::Verdict verdict = judge(p, uv);
  BOOST_TEST(verdict.is_good(), verdict);
  std::size_t length = 0;
  for(auto e : edges(p))
    length += get(seam, e);
  BOOST_TEST(length == report.transitions.size());
  BOOST_TEST(length >= 8u);
}

// --- borders ------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(annuli)
{
  for(const Soup& soup : { annulus(4, 24, .4), annulus(1, 3), annulus(6, 40) })
  {
    Maps m(soup);
    const Report report = m.flatten();
    check_flat(m, report);
    BOOST_TEST(report.topology.number_of_borders == 2u);

    // the outer border straight: a strip of a cylinder
    Maps straight(soup);
    std::vector<Vertex> border = border_vertices(straight.sm);
    for(Vertex v : border)
      straight.is_fixed[v] = false;
    const Report straight_report = straight.flatten(params::border_angle_map(straight.border_angle));
    check_flat(straight, straight_report, false);
    for(const auto& motion : straight_report.transitions)
      BOOST_TEST(std::abs(motion.rotation[0] - 1) <= rounded_layout);
  }
  Maps flat(annulus(3, 12)); // it is flat already, and goes together again
  const Report report = flat.flatten();
  for(Vertex v : vertices(flat.sm))
    BOOST_TEST(std::abs(flat.u[v]) <= unmoved_u);
  for(const auto& motion : report.transitions)
  {
    BOOST_TEST(std::abs(motion.rotation[0] - 1) <= rounded_layout);
    BOOST_TEST(std::abs(complex(motion.translation)) <= rounded_layout);
  }
}

// A disk with a rectangle as border, and cones inside.
BOOST_AUTO_TEST_CASE(cones_in_a_disk)
{
  Maps m(hill(10, .5));
  const std::array<Vertex, 4> corners = CE::select_rectangle_corners(m.sm, border_halfedge(m.sm));
  CE::prescribe_rectangle(m.sm, corners, m.border_angle);
  const std::vector<Vertex> far = far_vertices(m.sm, 2, 6);
  m.cone_angle[far[0]] = 3 * CGAL_PI / 2;
  m.cone_angle[far[1]] = 5 * CGAL_PI / 2;
  for(Vertex v : vertices(m.sm))
    m.is_fixed[v] = false;
  check_flat(m, m.flatten(params::border_angle_map(m.border_angle)), false);

  Maps natural(hill(10, .5)); // natural border, one free cone and one prescribed
  natural.cone_angle[far[0]] = 5;
  natural.is_fixed[far[1]] = true;
  check_flat(natural, natural.flatten());

  Maps one(hill(10, .5)); // no other condition: one path to the border
  one.cone_angle[far[0]] = 5;
  const Report report = one.flatten();
  check_flat(one, report);
  for(const auto& motion : report.transitions)
    BOOST_TEST(std::abs(motion.rotation[0] - std::cos(5.)) <= rounded_layout); // by 5 or -5, as the cone is on the one side or the other
}

// --- components and charts ----------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(components)
{
  const std::vector<Soup> soups = { hill(6, .5), icosphere(2), torus(9, 6), annulus(3, 12, .2) };
  Maps m(together(soups, true));
  std::size_t first = 0;
  for(const Soup& soup : soups)
  {
    ++first; // an isolated vertex
    if(soup.points == soups[1].points)
    {
      Maps alone(soup);
      for(Vertex v : far_vertices(alone.sm, 5))
        m.cone_angle[Vertex(Index(first + v.idx()))] = 2 * CGAL_PI - 4 * CGAL_PI / 5;
    }
    first += soup.points.size();
  }
  const Report report = m.flatten();
  check_flat(m, report);
  BOOST_TEST(report.topology.number_of_components == 4u);
  BOOST_TEST(report.topology.genus == 1u);
  BOOST_TEST(report.topology.number_of_borders == 3u);
  BOOST_TEST_REQUIRE(report.lattices.size() == 1u);
  BOOST_TEST(report.lattices[0].face == soups[0].triangles.size() + soups[1].triangles.size());

  // each as it would be alone
  first = 0;
  for(const Soup& soup : soups)
  {
    BOOST_TEST(m.u[Vertex(Index(first))] == unwritten);
    ++first;
    Maps alone(soup);
    for(Vertex v : vertices(alone.sm))
      alone.cone_angle[v] = m.cone_angle[Vertex(Index(first + v.idx()))];
    check_flat(alone, alone.flatten());
    for(Vertex v : vertices(alone.sm))
      BOOST_TEST(std::abs(alone.u[v] - m.u[Vertex(Index(first + v.idx()))]) <= rounded_u);
    first += soup.points.size();
  }
}

namespace {

// One chart alone, by the copy of it as a mesh.
void check_chart(Maps& m, const std::vector<Face>& chart)
{
  const CGAL::Face_filtered_graph<Mesh> patch(m.sm, chart);
  Mesh copy;
  std::vector<std::pair<Halfedge, Halfedge> > h2h;
  CGAL::copy_face_graph(patch, copy, params::halfedge_to_halfedge_output_iterator(std::back_inserter(h2h)));
  auto uv = copy.add_property_map<Halfedge, Point_2>("h:uv").first;
  for(const auto& pair : h2h)
    uv[pair.second] = m.uv[pair.first];
  const checking::Verdict verdict = judge(copy, uv);
  BOOST_TEST(verdict.is_good(), verdict);
}

} // namespace

BOOST_AUTO_TEST_CASE(charts)
{
  Soup soup = icosphere(3);
  add_noise(soup, .01, 4);
  Maps m(soup);
  auto patch = m.sm.add_property_map<Face, int>("f:patch").first;
  std::vector<std::vector<Face> > charts(3);
  for(Face f : faces(m.sm)) // two caps and the ring between them
  {
    double z = 0;
    for(Halfedge h : CGAL::halfedges_around_face(halfedge(f, m.sm), m.sm))
      z += m.sm.point(target(h, m.sm)).z() / 3;
    patch[f] = z > .4 ? 1 : z < -.4 ? 1 : 2; // both caps have the same number
    charts[z > .4 ? 0 : z < -.4 ? 1 : 2].push_back(f);
  }
  for(Vertex v : vertices(m.sm)) // natural borders
    for(Face f : CGAL::faces_around_target(halfedge(v, m.sm), m.sm))
      if(patch[f] != patch[face(halfedge(v, m.sm), m.sm)])
        m.is_fixed[v] = true;
  const Report report = CE::flatten(m.sm, m.uv, params::log_scale_factor_map(m.u).edge_is_seam_map(m.seam).face_patch_map(patch));
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  BOOST_TEST(report.topology.number_of_components == 3u);
  BOOST_TEST(report.topology.number_of_borders == 4u);
  for(const auto& chart : charts)
    check_chart(m, chart);
  std::size_t between = 0, within = 0;
  for(Edge e : edges(m.sm))
  {
    const bool is_between = patch[face(halfedge(e, m.sm), m.sm)] != patch[face(opposite(halfedge(e, m.sm), m.sm), m.sm)];
    between += is_between;
    within += m.seam[e] && !is_between;
    if(is_between)
    {
      BOOST_TEST(m.seam[e]);
      BOOST_TEST(m.u[source(e, m.sm)] == 0);
    }
  }
  BOOST_TEST(between > 20u);
  BOOST_TEST(within == report.transitions.size()); // the ring is cut
  BOOST_TEST(within > 0u);
  check_disks(m, 3);
}

// Every triangle a chart of its own: the layout is a set of congruent triangles.
BOOST_AUTO_TEST_CASE(charts_of_one_triangle)
{
  Maps m(icosphere(1));
  auto patch = m.sm.add_property_map<Face, std::size_t>("f:patch").first;
  for(Face f : faces(m.sm))
    patch[f] = f.idx();
  const Report report = CE::flatten(m.sm, m.uv, params::log_scale_factor_map(m.u).edge_is_seam_map(m.seam).face_patch_map(patch));
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  BOOST_TEST(report.topology.number_of_components == num_faces(m.sm));
  for(Halfedge h : halfedges(m.sm))
  {
    const double length = std::sqrt(CGAL::squared_distance(m.sm.point(source(h, m.sm)), m.sm.point(target(h, m.sm))));
    BOOST_TEST(std::abs(uv_length(m.sm, m.uv, h) - length) <= 4 * unit_roundoff * diameter(m)); // triangles side by side, each rounded in that unit
  }
  for(Edge e : edges(m.sm))
    BOOST_TEST(m.seam[e]);
  BOOST_TEST((CE::verify_layout(m.sm, m.uv).injectivity == CE::Injectivity::YES));
}

// --- seams --------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(seams_that_the_user_wants)
{
  Maps m(icosphere(2));
  equal_cones(m, 6, 2);
  const Report first = m.flatten();
  check_flat(m, first);
  const std::vector<bool> automatic(m.seam.begin(), m.seam.end());

  // what was found is accepted as it is
  const Report again = m.flatten();
  check_flat(m, again);
  BOOST_TEST(std::equal(automatic.begin(), automatic.end(), m.seam.begin()));

  // what was found is forbidden: another way is taken
  auto is_constrained = m.sm.add_property_map<Edge, bool>("e:is_constrained", false).first;
  for(Edge e : edges(m.sm))
  {
    is_constrained[e] = automatic[e.idx()];
    m.seam[e] = false;
  }
  const Report other = m.flatten(params::edge_is_constrained_map(is_constrained));
  check_flat(m, other);
  for(Edge e : edges(m.sm))
    BOOST_TEST(!(m.seam[e] && is_constrained[e]));

  // edges of weight zero are taken
  auto weight = m.sm.add_property_map<Edge, double>("e:weight", 1).first;
  std::size_t free_edges = 0;
  for(Edge e : edges(m.sm))
  {
    weight[e] = automatic[e.idx()] ? 0 : 1;
    free_edges += automatic[e.idx()];
    m.seam[e] = false;
  }
  check_flat(m, m.flatten(params::seam_weight_map(weight)));
  BOOST_TEST(std::equal(automatic.begin(), automatic.end(), m.seam.begin()));
  BOOST_TEST(free_edges > 0u);

  // a ring cuts the sphere in two, which are cut on
  for(Edge e : edges(m.sm))
    m.seam[e] = std::abs(m.sm.point(source(e, m.sm)).z()) <= few_roundings && std::abs(m.sm.point(target(e, m.sm)).z()) <= few_roundings;
  const Report ring = m.flatten();
  BOOST_TEST_REQUIRE(bool(ring), CE::message(ring));
  const checking::Verdict verdict = judge(m.sm, m.uv, true, cones_of(m));
  BOOST_TEST(verdict.is_good(), verdict);
  check_seam(m, ring);
}

BOOST_AUTO_TEST_CASE(seams_that_cannot_be)
{
  Maps m(icosphere(1));
  equal_cones(m, 4, 2);
  auto is_constrained = m.sm.add_property_map<Edge, bool>("e:is_constrained", true).first;
  const Report report = m.flatten(params::edge_is_constrained_map(is_constrained));
  BOOST_TEST((report.status == Status::WRONG_TOPOLOGY));
  BOOST_TEST(!report.edges.empty());
  BOOST_TEST(report.edges.size() == report.edge_indices.size());
  BOOST_TEST(m.is_untouched());

  auto weight = m.sm.add_property_map<Edge, double>("e:weight", 1).first;
  weight[Edge(5)] = -1;
  const Report negative = m.flatten(params::seam_weight_map(weight));
  BOOST_TEST((negative.status == Status::INVALID_NUMBER));
  BOOST_TEST((negative.edges == std::vector<Edge>(1, Edge(5))));
  BOOST_TEST(m.is_untouched());

  m.seam[Edge(3)] = true;
  const Report both = m.flatten(params::edge_is_constrained_map(is_constrained));
  BOOST_TEST((both.status == Status::WRONG_TOPOLOGY));
  BOOST_TEST((both.edges == std::vector<Edge>(1, Edge(3))));
}

// --- conditions that cannot be met --------------------------------------------------------------

BOOST_AUTO_TEST_CASE(refused)
{
  Maps none(together({torus(4, 4), icosphere(1)}));
  const Report without_cones = none.flatten();
  BOOST_TEST((without_cones.status == Status::MISSING_CONDITION));
  BOOST_TEST(std::abs(without_cones.amount - 4 * CGAL_PI) <= 4 * CGAL_PI * few_roundings);
  BOOST_TEST((without_cones.face_indices == std::vector<std::size_t>(1, 32)));
  BOOST_TEST(CE::message(without_cones).find("needs cones") != std::string::npos, CE::message(without_cones));
  BOOST_TEST(none.is_untouched());

  Maps one(icosphere(1));
  one.cone_angle[Vertex(7)] = CGAL_PI;
  const Report one_cone = one.flatten();
  BOOST_TEST((one_cone.status == Status::GAUSS_BONNET_VIOLATED));
  BOOST_TEST((one_cone.vertex_indices == std::vector<std::size_t>(1, 7)));
  BOOST_TEST(std::abs(one_cone.amount + 3 * CGAL_PI) <= 4 * CGAL_PI * few_roundings);
  BOOST_TEST(one.is_untouched());

  Maps two(icosphere(1));
  two.is_fixed[Vertex(7)] = two.is_fixed[Vertex(9)] = true;
  const Report two_free = two.flatten();
  BOOST_TEST((two_free.status == Status::NO_ANGLE_LEFT));
  BOOST_TEST((two_free.vertex_indices == std::vector<std::size_t>{ 7, 9 }));
  BOOST_TEST(two.is_untouched());

  for(double angle : { 0., -1., 5 * CGAL_PI, 6 * CGAL_PI })
  {
    Maps m(icosphere(1));
    equal_cones(m, 4, 2);
    m.cone_angle[Vertex(3)] = angle; // of degree 5
    const Report report = m.flatten(params::retriangulation(CE::Retriangulation::NEVER));
    BOOST_TEST((report.status == Status::ANGLE_OUT_OF_RANGE));
    BOOST_TEST((report.vertex_indices == std::vector<std::size_t>(1, 3)));
    BOOST_TEST(std::abs(report.amount - angle) <= 4 * CGAL_PI * few_roundings);
    BOOST_TEST(m.is_untouched());
  }
}

// --- meshes of CGAL -----------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(closed_meshes_of_CGAL, * needs_mesh("blobby.off"))
{
  for(const char* name : { "blobby.off", "fandisk.off", "homer.off" })
    BOOST_TEST_CONTEXT(name)
    {
      Maps m(read_mesh(name));
      equal_cones(m, 8, 2, 5);
      check_flat(m, m.flatten());
    }
}

BOOST_AUTO_TEST_CASE(tori_of_CGAL, * needs_mesh("knot1.off"))
{
  for(const char* name : { "knot1.off", "pinion.off" })
    BOOST_TEST_CONTEXT(name)
    {
      Maps m(read_mesh(name));
      const Report report = m.flatten();
      check_flat(m, report);
      BOOST_TEST(report.lattices.size() == 1u);
    }
}

BOOST_AUTO_TEST_CASE(surfaces_with_handles_of_CGAL, * needs_mesh("elephant.off"))
{
  Maps m(read_mesh("elephant.off"));
  equal_cones(m, 16, -4, 7);
  const Report report = m.flatten();
  check_flat(m, report);
  BOOST_TEST(report.topology.genus == 3u);
}

BOOST_AUTO_TEST_CASE(surfaces_with_borders_of_CGAL, * needs_mesh("head.off"))
{
  for(const char* name : { "head.off", "holes.off", "lion.off" })
    BOOST_TEST_CONTEXT(name)
    {
      Maps m(read_mesh(name));
      check_flat(m, m.flatten());
    }
}
