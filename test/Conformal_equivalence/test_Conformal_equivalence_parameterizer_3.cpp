// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The parameterizer behind CGAL's own parameterize(), beside LSCM and ARAP.

#define BOOST_TEST_MODULE test_Conformal_equivalence_parameterizer_3
#include "include/boost_test.h"
#include "include/flattened_meshes.h"

#include <CGAL/Surface_mesh_parameterization/Conformal_equivalence_parameterizer_3.h>

#include <CGAL/Conformal_equivalence/boundary_conditions.h>
#include <CGAL/Conformal_equivalence/flatten.h>

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

#include <algorithm>
#include <cmath>
#include <functional>
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
  BOOST_TEST(report.statistics.residual <= 1e-12);
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
                                               .flattening_report(std::ref(report)));
      const SMP::Error_code error = SMP::parameterize(m.sm, parameterizer, m.bhd, m.uv);
      BOOST_TEST((error != SMP::OK));
      BOOST_TEST((error == CE::to_error_code(report.status)));
      BOOST_TEST(!report.faces.empty());
      BOOST_TEST(m.is_untouched());
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
      BOOST_TEST(plane_distance(m.uv[v], alone.uv[Vertex(v.idx() - 1)]) <= 1e-13);
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
  const Parameterizer parameterizer(params::flattening_report(std::ref(report)));
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

  Maps m(hill(4, .3));
  Report report;
  const auto angle = m.sm.add_property_map<Vertex, double>("v:angle", CGAL_PI).first;
  BOOST_TEST((SMP::parameterize(m.sm, Parameterizer(params::border_angle_map(angle).flattening_report(std::ref(report))),
                                m.bhd, m.uv) == SMP::ERROR_WRONG_PARAMETER));
  BOOST_TEST((report.status == CE::Status::ANGLE_OUT_OF_RANGE));
  BOOST_TEST(m.is_untouched());
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
  double low = 1, high = 0, least = 1e300, largest = 0;
  for(Vertex v : vertices(m.sm))
  {
    low = (std::min)({low, m.uv[v].x(), m.uv[v].y()});
    high = (std::max)({high, m.uv[v].x(), m.uv[v].y()});
  }
  BOOST_TEST(low >= 0);
  BOOST_TEST(high <= 1);
  for(Edge e : edges(m.sm))
  {
    const double scale = plane_distance(m.uv[source(e, m.sm)], m.uv[target(e, m.sm)]) / scaled_length[e];
    least = (std::min)(least, scale);
    largest = (std::max)(largest, scale);
  }
  BOOST_TEST(largest / least - 1 <= 1e-12);

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
    BOOST_TEST(plane_distance(m.uv[v], own.uv[v]) <= 1e-13);
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

// A sphere, cut along a path of edges: the disk that it is then.
BOOST_AUTO_TEST_CASE(seam_mesh)
{
  Mesh sm = surface_mesh<Mesh>(icosphere(2));
  auto is_seam = sm.add_property_map<Edge, bool>("e:is_seam", false).first;
  auto is_on_seam = sm.add_property_map<Vertex, bool>("v:is_on_seam", false).first;
  typedef CGAL::Seam_mesh<Mesh, Mesh::Property_map<Edge, bool>, Mesh::Property_map<Vertex, bool> > Seam_mesh;
  Seam_mesh seam_mesh(sm, is_seam, is_on_seam);
  Halfedge h = *halfedges(sm).begin();
  for(int i = 0; i < 5; ++i)
  {
    BOOST_TEST(seam_mesh.add_seam(source(h, sm), target(h, sm)));
    h = next(opposite(next(opposite(next(h, sm), sm), sm), sm), sm); // straight on
  }
  boost::graph_traits<Seam_mesh>::halfedge_descriptor bhd = boost::graph_traits<Seam_mesh>::null_halfedge();
  for(auto s : halfedges(seam_mesh))
    if(is_border(s, seam_mesh))
      bhd = s;
  auto uv = sm.add_property_map<Halfedge, Point_2>("h:uv").first;
  Report report;
  const SMP::Conformal_equivalence_parameterizer_3<Seam_mesh> parameterizer(params::seam_is_border(true).flattening_report(std::ref(report)));
  const SMP::Error_code error = SMP::parameterize(seam_mesh, parameterizer, bhd, uv);
  BOOST_TEST((error == SMP::OK), CE::message(report));
}
