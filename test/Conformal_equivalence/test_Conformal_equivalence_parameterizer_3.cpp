// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The parameterizer behind CGAL's own parameterize(), beside LSCM and ARAP.

#define BOOST_TEST_MODULE test_Conformal_equivalence_parameterizer_3
#include "include/boost_test.h"
#include "include/flattened_meshes.h"

#include <CGAL/Surface_mesh_parameterization/Conformal_equivalence_parameterizer_3.h>

#include <CGAL/Conformal_equivalence/boundary_conditions.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/make_seam_mesh.h>

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh_parameterization/ARAP_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <CGAL/boost/graph/Seam_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>

#include <Eigen/SparseCholesky>

#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace SMP = CGAL::Surface_mesh_parameterization;
namespace params = CGAL::parameters;
using namespace testing;

namespace {

typedef CE::Flattening_report<Mesh>                            Report;
typedef SMP::Conformal_equivalence_parameterizer_3<Mesh>       Parameterizer;

const double unwritten = 77;
const double epsilon = std::numeric_limits<double>::epsilon();

// How far two layouts of about size 1 may be apart whose metrics differ by rounding: each triangle on the way from the first one
// adds a step whose two coordinates are rounded.
template <typename Any_mesh>
double layout_rounding(const Any_mesh& mesh) { return 2 * epsilon * double(num_faces(mesh)); }

// A mesh with the maps that parameterize() writes.
struct Maps
{
  Mesh sm;
  Mesh::Property_map<Vertex, Point_2> uv;
  Mesh::Property_map<Vertex, double> u, weight;
  Halfedge bhd;

  explicit Maps(const Mesh& mesh) : sm(mesh)
  {
    uv = sm.add_property_map<Vertex, Point_2>("v:uv", Point_2(unwritten, unwritten)).first;
    u = sm.add_property_map<Vertex, double>("v:u", unwritten).first;
    weight = sm.add_property_map<Vertex, double>("v:weight", unwritten).first;
    bhd = CGAL::Polygon_mesh_processing::longest_border(sm).first;
  }
  explicit Maps(const Soup& soup) : Maps(surface_mesh<Mesh>(soup)) {}
  Maps(const Maps&) = delete;

  bool is_untouched() const
  {
    return std::all_of(uv.begin(), uv.end(), [](const Point_2& p) { return p == Point_2(unwritten, unwritten); })
        && std::all_of(u.begin(), u.end(), [](double x) { return x == unwritten; })
        && std::all_of(weight.begin(), weight.end(), [](double x) { return x == unwritten; });
  }
};

// parameterize() says the same as flatten(), to the last bit
void check_same_as_flatten(Maps& m)
{
  const auto corner = m.sm.add_property_map<Halfedge, Point_2>("h:uv").first;
  const auto u = m.sm.add_property_map<Vertex, double>("v:u_of_flatten").first;
  const Report expected = CE::flatten(m.sm, corner, params::log_scale_factor_map(u));
  Report report;
  const Parameterizer parameterizer(params::log_scale_factor_map(m.u).projective_weight_map(m.weight)
                                           .flattening_report(std::ref(report)));
  const SMP::Error_code error = SMP::parameterize(m.sm, parameterizer, m.bhd, m.uv);
  BOOST_TEST((error == CE::to_error_code(expected.status)));
  BOOST_TEST((report.status == expected.status));
  BOOST_TEST_REQUIRE((error == SMP::OK), CE::message(report));
  BOOST_TEST(report.statistics.number_of_iterations == expected.statistics.number_of_iterations);
  BOOST_TEST(report.statistics.residual <= 1e-12); // the default of gradient_tolerance
  for(Halfedge h : halfedges(m.sm))
    BOOST_TEST((corner[h] == m.uv[target(h, m.sm)]));
  BOOST_TEST(std::equal(u.begin(), u.end(), m.u.begin()));
  const checking::Verdict verdict = judge_vertices(m.sm, m.uv);
  BOOST_TEST(verdict.is_good(), verdict);
}

} // namespace

BOOST_AUTO_TEST_CASE(generated_disks)
{
  for(const Soup& soup : { hill(8, .5), cone(7, .8), random_height_field(7, .7, 4), scaled(hill(5, .5), 1e-150),
                           one_triangle({{0, 0, 0}}, {{1, 0, 0}}, {{.3, 2, 1}}) })
  {
    Maps m(soup);
    check_same_as_flatten(m);
  }
}

BOOST_AUTO_TEST_CASE(disks_of_CGAL, * needs_mesh("lion-head.off"))
{
  for(const std::string& name : good_disks())
    BOOST_TEST_CONTEXT(name)
    {
      Maps m(read_mesh(name));
      check_same_as_flatten(m);
    }
}

BOOST_AUTO_TEST_CASE(what_the_fixed_triangulation_cannot_do, * needs_mesh("cylinder_locally_refined.off"))
{
  for(const char* name : { "cylinder_locally_refined.off", "mannequin-devil.off", "blob.off",
                           "corner_tris_with_hole.off", "degtri_sliding.off" })
    BOOST_TEST_CONTEXT(name)
    {
      Maps m(read_mesh(name));
      Report report;
      const Parameterizer parameterizer(params::log_scale_factor_map(m.u).projective_weight_map(m.weight)
                                               .flattening_report(std::ref(report))
                                               .retriangulation(CE::Retriangulation::NEVER));
      const SMP::Error_code error = SMP::parameterize(m.sm, parameterizer, m.bhd, m.uv);
      BOOST_TEST((error != SMP::OK));
      BOOST_TEST((error == CE::to_error_code(report.status)));
      BOOST_TEST(!report.faces.empty());
      BOOST_TEST(m.is_untouched());

      // by default edges are flipped; on all of these, straight triangles will do then
      const SMP::Error_code flipped = SMP::parameterize(m.sm, Parameterizer(params::flattening_report(std::ref(report))), m.bhd, m.uv);
      BOOST_TEST((flipped == SMP::OK));
      BOOST_TEST((report.status == CE::Status::OK), CE::message(report));
      BOOST_TEST(report.statistics.number_of_flips > 0u);
      BOOST_TEST(report.faces.empty());
    }
}

// What CGAL has had so far is refused by the checker that accepts the maps above.
BOOST_AUTO_TEST_CASE(LSCM_and_ARAP_are_not_conformally_equivalent, * needs_mesh("three_peaks.off"))
{
  const std::vector<Mesh> meshes = { surface_mesh<Mesh>(hill(8, .5)), read_mesh("three_peaks.off"), read_mesh("nefertiti.off") };
  for(std::size_t i = 0; i < meshes.size(); ++i)
  {
    Maps m(meshes[i]);
    BOOST_TEST((SMP::parameterize(m.sm, SMP::LSCM_parameterizer_3<Mesh>(), m.bhd, m.uv) == SMP::OK));
    const checking::Verdict lscm = judge_vertices(m.sm, m.uv);
    BOOST_TEST(!lscm.cross_ratio.is_good());
    BOOST_TEST(!lscm.border_scale.is_good());
    if(i == 1)
      BOOST_TEST(lscm.not_positive_triangles == 60u);
    BOOST_TEST((SMP::parameterize(m.sm, SMP::ARAP_parameterizer_3<Mesh>(), m.bhd, m.uv) == SMP::OK));
    BOOST_TEST(!judge_vertices(m.sm, m.uv).cross_ratio.is_good());
  }
}

BOOST_AUTO_TEST_CASE(one_of_two_components)
{
  const Soup left = hill(6, .5), right = cone(7, .5);
  Maps m(together({left, right}, true));
  const Vertex first_of_left(1), first_of_right(Index(left.points.size()) + 2);
  const auto is_left = [&](Vertex v) { return v >= first_of_left && v.idx() + 1 < first_of_right.idx(); };
  for(Halfedge h : halfedges(m.sm))
    if(is_border(h, m.sm) && is_left(target(h, m.sm)))
      m.bhd = h;

  Report report;
  const Parameterizer parameterizer(params::log_scale_factor_map(m.u).projective_weight_map(m.weight)
                                           .flattening_report(std::ref(report)));
  // called as parameterize() does; that itself asks for a mesh without isolated vertices
  auto is_parameterized = m.sm.add_property_map<Vertex, bool>("v:is_parameterized", false).first;
  auto index = m.sm.add_property_map<Vertex, int>("v:own_index", 0).first;
  Parameterizer copy(parameterizer);
  BOOST_TEST((copy.parameterize(m.sm, m.bhd, m.uv, index, is_parameterized) == SMP::OK), CE::message(report));
  BOOST_TEST(report.topology.is_disk());
  BOOST_TEST(report.topology.number_of_faces == left.triangles.size());
  Maps alone(left);
  BOOST_TEST((SMP::parameterize(alone.sm, Parameterizer(), alone.bhd, alone.uv) == SMP::OK));
  for(Vertex v : vertices(m.sm))
  {
    BOOST_TEST(is_parameterized[v] == is_left(v));
    BOOST_TEST((m.u[v] == unwritten) == !is_left(v));
    if(is_left(v))
      BOOST_TEST(plane_distance(m.uv[v], alone.uv[Vertex(v.idx() - 1)]) <= layout_rounding(alone.sm));
    else
      BOOST_TEST((m.uv[v] == Point_2(unwritten, unwritten)));
  }

  Maps two(together({left, right}));
  for(Halfedge h : halfedges(two.sm)) // now the other one
    if(is_border(h, two.sm) && target(h, two.sm).idx() >= left.points.size())
      two.bhd = h;
  BOOST_TEST((SMP::parameterize(two.sm, Parameterizer(), two.bhd, two.uv) == SMP::OK));
  for(Vertex v : vertices(two.sm))
    BOOST_TEST((two.uv[v] == Point_2(unwritten, unwritten)) == (v.idx() < left.points.size()));
}

// Elements at fault are named by their positions in the whole mesh.
BOOST_AUTO_TEST_CASE(faults_in_one_of_two_components)
{
  const Soup left = hill(3, .5), right = one_triangle({{0, 0, 0}}, {{1, 0, 0}}, {{.5, 1e-12, 0}}); // as flat as a segment
  Maps m(together({left, right}));
  const Face last(Index(left.triangles.size()));
  m.bhd = opposite(halfedge(last, m.sm), m.sm);
  Report report;
  const Parameterizer parameterizer(params::flattening_report(std::ref(report)).retriangulation(CE::Retriangulation::NEVER));
  BOOST_TEST((SMP::parameterize(m.sm, parameterizer, m.bhd, m.uv) != SMP::OK));
  BOOST_TEST((report.status == CE::Status::DEGENERATE_METRIC));
  BOOST_TEST((report.faces == std::vector<Face>(1, last)));
  BOOST_TEST((report.face_indices == std::vector<std::size_t>(1, left.triangles.size())));
  BOOST_TEST(m.is_untouched());
}

BOOST_AUTO_TEST_CASE(errors)
{
  const auto refused = [](const Soup& soup, CE::Status status)
  {
    Maps m(soup);
    Report report;
    const Parameterizer parameterizer(params::log_scale_factor_map(m.u).projective_weight_map(m.weight)
                                             .flattening_report(std::ref(report)));
    const SMP::Error_code error = SMP::parameterize(m.sm, parameterizer, m.bhd, m.uv);
    BOOST_TEST((report.status == status), CE::message(report));
    BOOST_TEST((error == CE::to_error_code(status)));
    BOOST_TEST(m.is_untouched());
  };
  refused(annulus(3, 9), CE::Status::WRONG_TOPOLOGY);
  Soup soup = hill(4, .3);
  soup.points[7] = soup.points[8];
  refused(soup, CE::Status::ZERO_LENGTH_EDGE);
  soup.points[7][2] = std::numeric_limits<double>::quiet_NaN();
  refused(soup, CE::Status::INVALID_NUMBER);

  for(const Soup& closed : { icosphere(1), torus(8, 6) }) // which have no border: longest_border() returns none
  {
    Maps m(closed);
    BOOST_TEST((m.bhd == Mesh::null_halfedge()));
    refused(closed, CE::Status::WRONG_TOPOLOGY);
    BOOST_TEST((Parameterizer().parameterize(m.sm, m.bhd, m.uv, boost::dummy_property_map(), boost::dummy_property_map())
                == SMP::ERROR_NO_TOPOLOGICAL_DISC));
  }

  Maps m(hill(4, .3));
  BOOST_TEST((SMP::parameterize(m.sm, Parameterizer(), Mesh::null_halfedge(), m.uv) == SMP::ERROR_NO_TOPOLOGICAL_DISC));
  BOOST_TEST(m.is_untouched());
  Report report;
  const auto angle = m.sm.add_property_map<Vertex, double>("v:angle", CGAL_PI).first;
  BOOST_TEST((SMP::parameterize(m.sm, Parameterizer(params::border_angle_map(angle).flattening_report(std::ref(report))
                                                                   .retriangulation(CE::Retriangulation::NEVER)),
                                m.bhd, m.uv) == SMP::ERROR_WRONG_PARAMETER));
  BOOST_TEST((report.status == CE::Status::ANGLE_OUT_OF_RANGE));
  BOOST_TEST(m.is_untouched());
}

// A chain may begin with any parameter of the package's own namespace, CGAL's and ours may be joined, and a pack
// of CGAL's alone will do.
BOOST_AUTO_TEST_CASE(chains_that_begin_with_parameters_of_CGAL)
{
  Maps m(hill(5, .5)), own(hill(5, .5));
  Report report;
  for(Vertex v : vertices(m.sm)) // half as large, but not by the points that are given
    m.sm.point(v) = CGAL::ORIGIN + .5 * (m.sm.point(v) - CGAL::ORIGIN);
  BOOST_TEST_REQUIRE((SMP::parameterize(m.sm, Parameterizer(params::vertex_point_map(own.sm.points())), m.bhd, m.uv) == SMP::OK));
  BOOST_TEST_REQUIRE((SMP::parameterize(own.sm, Parameterizer(), own.bhd, own.uv) == SMP::OK));
  BOOST_TEST(std::equal(own.uv.begin(), own.uv.end(), m.uv.begin()));

  const auto begun = CE::named_parameters::vertex_point_map(own.sm.points()).log_scale_factor_map(m.u).number_of_iterations(50)
                                          .flattening_report(std::ref(report));
  BOOST_TEST_REQUIRE((SMP::parameterize(m.sm, Parameterizer(begun), m.bhd, m.uv) == SMP::OK));
  BOOST_TEST(std::equal(own.uv.begin(), own.uv.end(), m.uv.begin()));
  BOOST_TEST(report.topology.is_disk());
  const std::vector<double> u(m.u.begin(), m.u.end());
  BOOST_TEST(*std::min_element(u.begin(), u.end()) < 0);

  const auto joined = CE::combine_named_parameters(params::vertex_point_map(own.sm.points()), params::number_of_iterations(50),
                                                   params::log_scale_factor_map(own.u)).projective_weight_map(m.weight);
  BOOST_TEST_REQUIRE((SMP::parameterize(m.sm, Parameterizer(joined), m.bhd, m.uv) == SMP::OK));
  BOOST_TEST(std::equal(own.uv.begin(), own.uv.end(), m.uv.begin()));
  BOOST_TEST(std::equal(u.begin(), u.end(), own.u.begin()));
  BOOST_TEST(*std::max_element(m.weight.begin(), m.weight.end()) == 1);
}

// Maps go into the parameterizer whose types its class does not know; it can be used again and again.
BOOST_AUTO_TEST_CASE(conditions_and_results_through_the_constructor)
{
  Maps m(hill(6, .5));
  const auto angle = m.sm.add_property_map<Vertex, double>("v:angle", 0).first;
  const auto scaled_length = m.sm.add_property_map<Edge, double>("e:scaled", 0).first;
  CE::prescribe_rectangle(m.sm, CE::select_rectangle_corners(m.sm, m.bhd), angle);
  Report report;
  const Parameterizer parameterizer(params::border_angle_map(angle).scaled_edge_length_map(scaled_length)
                                           .layout_frame(CE::Layout_frame::UNIT_SQUARE)
                                           .flattening_report(std::ref(report)).number_of_iterations(50));
  BOOST_TEST_REQUIRE((SMP::parameterize(m.sm, parameterizer, m.bhd, m.uv) == SMP::OK), CE::message(report));
  double low = 1, high = 0, least = 1e300, largest = 0, shortest = 1e300;
  for(Vertex v : vertices(m.sm))
  {
    low = (std::min)({low, m.uv[v].x(), m.uv[v].y()});
    high = (std::max)({high, m.uv[v].x(), m.uv[v].y()});
  }
  BOOST_TEST(low >= 0);
  BOOST_TEST(high <= 1);
  for(Edge e : edges(m.sm))
  {
    const double length = plane_distance(m.uv[source(e, m.sm)], m.uv[target(e, m.sm)]), scale = length / scaled_length[e];
    shortest = (std::min)(shortest, length);
    least = (std::min)(least, scale);
    largest = (std::max)(largest, scale);
  }
  // of an edge longer than a twelfth, the ends, each rounded in two coordinates by epsilon at most, change the length by 34 epsilon
  // relatively, and the quotient of two by twice that
  BOOST_TEST(shortest > 1. / 12);
  BOOST_TEST(largest / least - 1 <= 68 * epsilon);

  const std::vector<Point_2> before(m.uv.begin(), m.uv.end());
  Parameterizer copy(parameterizer);
  BOOST_TEST((SMP::parameterize(m.sm, copy, m.bhd, m.uv) == SMP::OK));
  BOOST_TEST(std::equal(before.begin(), before.end(), m.uv.begin()));
}

namespace {

typedef CGAL::Eigen_sparse_matrix<double>::EigenType Eigen_matrix;

// A model of CGAL's SparseLinearAlgebraWithFactorTraits_d, without a word of this package.
struct Own_solver_traits : public CGAL::Eigen_solver_traits<Eigen::SimplicialLLT<Eigen_matrix> >
{
};

struct Stopping_visitor : public CE::Default_visitor
{
  std::size_t steps = 0;
  void on_iteration(std::size_t step, double) { steps = step; }
  bool go_further() { return steps < 2; }
};

} // namespace

BOOST_AUTO_TEST_CASE(own_solver)
{
  Maps m(hill(8, .5)), own(hill(8, .5));
  BOOST_TEST((SMP::parameterize(m.sm, Parameterizer(), m.bhd, m.uv) == SMP::OK));
  const SMP::Conformal_equivalence_parameterizer_3<Mesh, Own_solver_traits> parameterizer;
  BOOST_TEST((SMP::parameterize(own.sm, parameterizer, own.bhd, own.uv) == SMP::OK));
  for(Vertex v : vertices(m.sm))
    BOOST_TEST(plane_distance(m.uv[v], own.uv[v]) <= layout_rounding(m.sm));
}

BOOST_AUTO_TEST_CASE(visitor_stops)
{
  Maps m(hill(8, .5));
  Report report;
  Stopping_visitor visitor;
  const auto np = params::log_scale_factor_map(m.u).flattening_report(std::ref(report));
  BOOST_TEST((SMP::parameterize(m.sm, Parameterizer(np.visitor(std::ref(visitor))), m.bhd, m.uv) != SMP::OK));
  BOOST_TEST((report.status == CE::Status::STOPPED_BY_VISITOR));
  BOOST_TEST(visitor.steps == 2u);
  BOOST_TEST((SMP::parameterize(m.sm, Parameterizer(np.visitor(Stopping_visitor())), m.bhd, m.uv) != SMP::OK));
  BOOST_TEST((report.status == CE::Status::STOPPED_BY_VISITOR));
  BOOST_TEST(m.is_untouched());
  BOOST_TEST((SMP::parameterize(m.sm, Parameterizer(np), m.bhd, m.uv) == SMP::OK));
}

BOOST_AUTO_TEST_CASE(exact_kernel)
{
  typedef CGAL::Exact_predicates_exact_constructions_kernel Exact_kernel;
  typedef CGAL::Surface_mesh<Exact_kernel::Point_3> Exact_mesh;
  Exact_mesh sm = surface_mesh<Exact_mesh>(hill(5, .5));
  auto uv = sm.add_property_map<Exact_mesh::Vertex_index, Exact_kernel::Point_2>("v:uv").first;
  const auto bhd = CGAL::Polygon_mesh_processing::longest_border(sm).first;
  BOOST_TEST((SMP::parameterize(sm, SMP::Conformal_equivalence_parameterizer_3<Exact_mesh>(), bhd, uv) == SMP::OK));
  const checking::Verdict verdict = judge_vertices(sm, uv);
  BOOST_TEST(verdict.is_good(), verdict);
}

BOOST_AUTO_TEST_CASE(polyhedron)
{
  typedef CGAL::Polyhedron_3<Kernel> Polyhedron;
  Polyhedron p;
  CGAL::copy_face_graph(surface_mesh<Mesh>(hill(5, .5)), p);
  auto uv = get(CGAL::dynamic_vertex_property_t<Point_2>(), p);
  const auto bhd = CGAL::Polygon_mesh_processing::longest_border(p).first;
  BOOST_TEST((SMP::parameterize(p, SMP::Conformal_equivalence_parameterizer_3<Polyhedron>(), bhd, uv) == SMP::OK));
  const checking::Verdict verdict = judge_vertices(p, uv);
  BOOST_TEST(verdict.is_good(), verdict);
}

// --- seam meshes --------------------------------------------------------------------------------

namespace {

typedef Mesh::Property_map<Edge, bool>                                   Edge_mark;
typedef Mesh::Property_map<Vertex, bool>                                 Vertex_mark;
typedef CGAL::Seam_mesh<Mesh, Edge_mark, Vertex_mark>                    Seam_mesh;
typedef boost::graph_traits<Seam_mesh>::halfedge_descriptor              Seam_halfedge;
typedef SMP::Conformal_equivalence_parameterizer_3<Seam_mesh>            Seam_parameterizer;

// A mesh with a seam, and what a parameterization along it writes.
struct Seamed
{
  Mesh sm;
  Edge_mark seam;
  Vertex_mark on_seam;
  Mesh::Property_map<Halfedge, Point_2> uv; // at the canonical halfedges of the seam mesh
  Mesh::Property_map<Vertex, double> u, angle;
  Report report;

  explicit Seamed(const Mesh& mesh) : sm(mesh)
  {
    seam = sm.add_property_map<Edge, bool>("e:seam", false).first;
    on_seam = sm.add_property_map<Vertex, bool>("v:on_seam", false).first;
    uv = sm.add_property_map<Halfedge, Point_2>("h:seam_uv", Point_2(unwritten, unwritten)).first;
    u = sm.add_property_map<Vertex, double>("v:u", unwritten).first;
    angle = sm.add_property_map<Vertex, double>("v:cone_angle", 2 * CGAL_PI).first;
  }
  explicit Seamed(const Soup& soup) : Seamed(surface_mesh<Mesh>(soup)) {}
  Seamed(const Seamed&) = delete;

  Seam_mesh seam_mesh() { return CE::make_seam_mesh(sm, seam, on_seam); }

  // beginning at a border halfedge of the seam mesh with the face f
  template <typename NamedParameters = decltype(params::seam_is_border(false))>
  SMP::Error_code parameterize(Face f = Face(0), const NamedParameters& np = params::seam_is_border(false))
  {
    const Seam_mesh cut_open = seam_mesh();
    std::vector<Face> piece;
    CGAL::Polygon_mesh_processing::connected_component(f, cut_open, std::back_inserter(piece));
    Seam_halfedge bhd = boost::graph_traits<Seam_mesh>::null_halfedge();
    for(Seam_halfedge h : halfedges(cut_open))
      if(is_border(h, cut_open) && std::find(piece.begin(), piece.end(), face(opposite(h, cut_open), cut_open)) != piece.end())
        bhd = h;
    const Seam_parameterizer parameterizer(CE::combine_named_parameters(
      params::cone_angle_map(angle).log_scale_factor_map(u).flattening_report(std::ref(report)), np));
    return SMP::parameterize(cut_open, parameterizer, bhd, uv);
  }

  // by corner, as CGAL's users read it
  template <typename Corners>
  void read_corners(Corners corners)
  {
    const Seam_mesh cut_open = seam_mesh();
    for(Halfedge h : halfedges(sm))
      if(!is_border(h, sm))
        corners[h] = uv[target(Seam_halfedge(h), cut_open)];
  }

  bool is_untouched() const
  {
    return std::all_of(uv.begin(), uv.end(), [](const Point_2& p) { return p == Point_2(unwritten, unwritten); })
        && std::all_of(u.begin(), u.end(), [](double x) { return x == unwritten; });
  }
};

// The vertices of the icosahedron, all of them cones.
void twelve_cones(Seamed& m)
{
  for(Index i = 0; i < 12; ++i)
    m.angle[Vertex(i)] = 5 * CGAL_PI / 3;
}

checking::Cones cones_of(const Report& report)
{
  checking::Cones result;
  for(const auto& cone : report.cones)
    result[cone.vertex_index] = cone.angle;
  return result;
}

// Marks the shortest chain of edges from a to b, in steps.
void draw_seam(Seamed& m, Vertex a, Vertex b)
{
  auto distance = get(CGAL::dynamic_vertex_property_t<int>(), m.sm);
  for(Vertex v : vertices(m.sm))
    put(distance, v, -1);
  std::vector<Vertex> queue(1, b);
  put(distance, b, 0);
  for(std::size_t i = 0; i < queue.size(); ++i)
    for(Halfedge h : CGAL::halfedges_around_target(queue[i], m.sm))
      if(get(distance, source(h, m.sm)) < 0)
      {
        put(distance, source(h, m.sm), get(distance, queue[i]) + 1);
        queue.push_back(source(h, m.sm));
      }
  while(a != b)
    for(Halfedge h : CGAL::halfedges_around_target(a, m.sm))
      if(get(distance, source(h, m.sm)) == get(distance, a) - 1)
      {
        m.seam[edge(h, m.sm)] = true;
        a = source(h, m.sm);
        break;
      }
}

} // namespace

// The same metric as that of flatten(), and along the same seam the same layout.
BOOST_AUTO_TEST_CASE(closed_mesh_along_a_seam)
{
  Soup soup = icosphere(3);
  add_noise(soup, .01, 2);
  Seamed m(soup);
  twelve_cones(m);
  const auto expected_uv = m.sm.add_property_map<Halfedge, Point_2>("h:uv").first;
  const auto corners = m.sm.add_property_map<Halfedge, Point_2>("h:corners").first;
  const auto expected_u = m.sm.add_property_map<Vertex, double>("v:expected_u").first;
  const Report expected = CE::flatten(m.sm, expected_uv,
                                      params::cone_angle_map(m.angle).edge_is_seam_map(m.seam).log_scale_factor_map(expected_u));
  BOOST_TEST_REQUIRE(bool(expected), CE::message(expected));
  BOOST_TEST_REQUIRE((m.parameterize() == SMP::OK), CE::message(m.report));
  BOOST_TEST(std::equal(m.u.begin(), m.u.end(), expected_u.begin()));
  BOOST_TEST(m.report.cones.size() == 12u);
  BOOST_TEST(m.report.transitions.size() == expected.transitions.size());
  m.read_corners(corners);
  for(Halfedge h : halfedges(m.sm))
    BOOST_TEST((corners[h] == expected_uv[h]));

  // another seam: the same metric, so the same lengths
  Seamed other(soup);
  twelve_cones(other);
  for(Index i = 0; i < 11; ++i)
    draw_seam(other, Vertex(i), Vertex(11));
  BOOST_TEST_REQUIRE((other.parameterize() == SMP::OK), CE::message(other.report));
  BOOST_TEST(std::equal(other.u.begin(), other.u.end(), expected_u.begin()));
  const auto other_corners = other.sm.add_property_map<Halfedge, Point_2>("h:corners").first;
  other.read_corners(other_corners);
  const checking::Verdict verdict = judge(other.sm, other_corners, true, cones_of(other.report));
  BOOST_TEST(verdict.is_good(), verdict);
}

// Solved as the disk that it is when it is cut open, with u = 0 on the seam; no cone is needed then.
BOOST_AUTO_TEST_CASE(the_seam_as_border)
{
  Seamed m(icosphere(2));
  draw_seam(m, Vertex(0), Vertex(3));
  draw_seam(m, Vertex(3), Vertex(7));
  draw_seam(m, Vertex(3), Vertex(9));
  BOOST_TEST((m.parameterize() == CE::to_error_code(CE::Status::MISSING_CONDITION)));
  BOOST_TEST((m.report.status == CE::Status::MISSING_CONDITION));
  BOOST_TEST(m.is_untouched());

  BOOST_TEST_REQUIRE((m.parameterize(Face(0), params::seam_is_border(true)) == SMP::OK), CE::message(m.report));
  const Seam_mesh cut_open = m.seam_mesh();
  const auto corner = m.sm.add_property_map<Halfedge, Point_2>("h:corner").first;
  const auto whole = CE::flatten(cut_open, corner); // the seam mesh as the surface that it is
  BOOST_TEST_REQUIRE(bool(whole), CE::message(whole));
  for(Seam_halfedge h : halfedges(cut_open))
    if(!is_border(h, cut_open))
      BOOST_TEST(plane_distance(m.uv[target(h, cut_open)], corner[h]) <= layout_rounding(m.sm));
  for(Edge e : edges(m.sm))
    if(m.seam[e])
    {
      BOOST_TEST(m.u[source(e, m.sm)] == 0);
      for(Halfedge h : { halfedge(e, m.sm), opposite(halfedge(e, m.sm), m.sm) })
      {
        // u is 0: the length of the input, but for the rounding of two points, whose coordinates are below 4
        const double length = std::sqrt(CGAL::squared_distance(m.sm.point(source(h, m.sm)), m.sm.point(target(h, m.sm))));
        BOOST_TEST(std::abs(uv_length(m.sm, corner, h) - length) <= 4 * 4 * epsilon);
      }
    }
}

BOOST_AUTO_TEST_CASE(seams_that_miss_something)
{
  Seamed m(icosphere(2));
  twelve_cones(m);
  for(Index i = 0; i < 11; ++i)
    if(i != 4)
      draw_seam(m, Vertex(i), Vertex(11));
  const bool is_passed = m.seam_mesh().has_on_seam(Vertex(4)); // on the way from another one
  BOOST_TEST_REQUIRE(!is_passed);
  BOOST_TEST((m.parameterize() == SMP::ERROR_NO_TOPOLOGICAL_DISC));
  BOOST_TEST((m.report.status == CE::Status::SEAM_MISSES_CONE));
  BOOST_TEST((m.report.vertices == std::vector<Vertex>(1, Vertex(4))));
  BOOST_TEST(CE::message(m.report).find("vertex 4") != std::string::npos);
  BOOST_TEST(m.is_untouched());

  Seamed ring(torus(8, 6)); // one loop alone leaves a cylinder
  for(Edge e : edges(ring.sm))
    ring.seam[e] = source(e, ring.sm).idx() / 6 == 2 && target(e, ring.sm).idx() / 6 == 2;
  for(bool is_border : { false, true })
  {
    BOOST_TEST((ring.parameterize(Face(0), params::seam_is_border(is_border)) == SMP::ERROR_NO_TOPOLOGICAL_DISC));
    BOOST_TEST((ring.report.status == CE::Status::SEAM_LEAVES_NO_DISK));
    BOOST_TEST(CE::message(ring.report).find("1 component, 2 borders, genus 0") != std::string::npos, CE::message(ring.report));
    if(!is_border)
      BOOST_TEST(ring.report.edges.size() == 6u);
    for(Edge e : ring.report.edges)
      BOOST_TEST(ring.seam[e]);
    BOOST_TEST(ring.is_untouched());
  }
  for(Edge e : edges(ring.sm)) // with a second one it is a disk
    ring.seam[e] = ring.seam[e] || (source(e, ring.sm).idx() % 6 == 1 && target(e, ring.sm).idx() % 6 == 1);
  BOOST_TEST((ring.parameterize() == SMP::OK), CE::message(ring.report));
  BOOST_TEST(ring.report.lattices.size() == 1u);

  Maps disk(hill(5, .4)); // a cone in a disk without a seam
  const auto angle = disk.sm.add_property_map<Vertex, double>("v:angle", 2 * CGAL_PI).first;
  angle[Vertex(14)] = 5;
  Report report;
  BOOST_TEST((SMP::parameterize(disk.sm, Parameterizer(params::cone_angle_map(angle).flattening_report(std::ref(report))), disk.bhd, disk.uv)
              == SMP::ERROR_NO_TOPOLOGICAL_DISC));
  BOOST_TEST((report.status == CE::Status::SEAM_MISSES_CONE));
  BOOST_TEST((report.vertices == std::vector<Vertex>(1, Vertex(14))));
}

// A seam of one edge, from the border to a cone; and one that passes through border vertices.
BOOST_AUTO_TEST_CASE(short_seams_and_seams_at_the_border)
{
  const Index n = 6;
  const auto at = [n](Index i, Index j) { return Vertex(j * (n + 1) + i); };
  Seamed m(hill(n, .4));
  m.angle[at(1, 3)] = 5.5;
  draw_seam(m, at(0, 3), at(1, 3));
  BOOST_TEST_REQUIRE(std::count(m.seam.begin(), m.seam.end(), true) == 1);
  BOOST_TEST_REQUIRE((m.parameterize() == SMP::OK), CE::message(m.report));
  const auto corners = m.sm.add_property_map<Halfedge, Point_2>("h:corners").first;
  m.read_corners(corners);
  const checking::Verdict verdict = judge(m.sm, corners, true, cones_of(m.report));
  BOOST_TEST(verdict.is_good(), verdict);
  BOOST_TEST(m.report.transitions.size() == 1u);

  // from the left border inwards, down to the lower border, and up again to the right one: three pieces, of which each is a disk
  Seamed pieces(hill(n, .4));
  draw_seam(pieces, at(0, 3), at(3, 3));
  draw_seam(pieces, at(3, 3), at(3, 0));
  draw_seam(pieces, at(3, 0), at(n, 3));
  const Seam_mesh cut_open = pieces.seam_mesh();
  std::size_t laid_out = 0;
  for(Face f : { *faces(pieces.sm).begin(), face(opposite(halfedge(at(3, n), pieces.sm), pieces.sm), pieces.sm) })
  {
    std::vector<Face> piece;
    CGAL::Polygon_mesh_processing::connected_component(f, cut_open, std::back_inserter(piece));
    for(Halfedge h : halfedges(pieces.sm))
      pieces.uv[h] = Point_2(unwritten, unwritten);
    BOOST_TEST_REQUIRE((pieces.parameterize(f) == SMP::OK), CE::message(pieces.report));
    for(Face g : faces(pieces.sm))
    {
      const bool is_inside = std::find(piece.begin(), piece.end(), g) != piece.end();
      laid_out += is_inside;
      for(Halfedge h : CGAL::halfedges_around_face(halfedge(g, pieces.sm), pieces.sm))
      {
        const Point_2 p = pieces.uv[target(Seam_halfedge(h), cut_open)];
        BOOST_TEST((p == Point_2(unwritten, unwritten)) == !is_inside);
      }
    }
  }
  BOOST_TEST(laid_out > num_faces(pieces.sm) / 2);
  BOOST_TEST(laid_out < num_faces(pieces.sm));

  // the metric is that of the whole disk, wherever the seam runs
  Maps whole(hill(n, .4));
  Parameterizer parameterizer(params::log_scale_factor_map(whole.u));
  BOOST_TEST_REQUIRE((SMP::parameterize(whole.sm, parameterizer, whole.bhd, whole.uv) == SMP::OK));
  BOOST_TEST(std::equal(whole.u.begin(), whole.u.end(), pieces.u.begin()));
}

// What CGAL's users draw: a file of the selection plugin.
BOOST_AUTO_TEST_CASE(seam_from_a_selection_file)
{
  const std::string file = "seam_of_test.selection.txt";
  Seamed drawn(icosphere(2));
  twelve_cones(drawn);
  for(Index i = 0; i < 11; ++i)
    draw_seam(drawn, Vertex(i), Vertex(11));
  {
    std::ofstream out(file);
    out << "\n\n"; // no vertices, no faces; pairs of vertices are edges
    for(Edge e : edges(drawn.sm))
      if(drawn.seam[e])
        out << source(e, drawn.sm).idx() << ' ' << target(e, drawn.sm).idx() << ' ';
    out << '\n';
  }
  Seamed m(icosphere(2));
  twelve_cones(m);
  Seam_mesh cut_open(m.sm, m.seam, m.on_seam);
  const auto bhd_of_mesh = cut_open.add_seams(file.c_str());
  std::remove(file.c_str());
  BOOST_TEST_REQUIRE((bhd_of_mesh != Mesh::null_halfedge()));
  const Seam_halfedge bhd(bhd_of_mesh, true);
  BOOST_TEST_REQUIRE(is_border(bhd, cut_open));
  const Seam_parameterizer parameterizer(params::cone_angle_map(m.angle).log_scale_factor_map(m.u).flattening_report(std::ref(m.report)));
  BOOST_TEST((SMP::parameterize(cut_open, parameterizer, bhd, m.uv) == SMP::OK), CE::message(m.report));
  BOOST_TEST((drawn.parameterize() == SMP::OK));
  BOOST_TEST(std::equal(m.u.begin(), m.u.end(), drawn.u.begin()));
  BOOST_TEST(std::equal(m.uv.begin(), m.uv.end(), drawn.uv.begin()));
}
