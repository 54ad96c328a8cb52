// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Meshes of the common refinement, in one call: continuous, positive, turning once around every vertex.

#define BOOST_TEST_MODULE test_flatten_refined
#include "include/boost_test.h"
#include "include/flattened_meshes.h"

#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/flatten_refined.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;
using namespace testing;
using CE::Retriangulation;
using CE::Status;

namespace {

typedef CE::Flattening_report<Mesh> Report;
template <typename T> using Vertex_map = Mesh::Property_map<Vertex, T>;

// A mesh with conditions, and its refinement.
struct Case
{
  Mesh given, refined;
  Vertex_map<double> cone_angle, border_angle, u, weight;
  Mesh::Property_map<Halfedge, Point_2> uv_given, uv;
  Mesh::Property_map<Edge, bool> seam_given, seam;
  Mesh::Property_map<Face, Face> input_face;
  CE::Common_refinement<> refinement;
  Report report;

  explicit Case(const Mesh& sm)
    : given(sm),
      cone_angle(given.add_property_map<Vertex, double>("v:cone", 2 * CGAL_PI).first),
      u(given.add_property_map<Vertex, double>("v:u", -7).first),
      weight(refined.add_property_map<Vertex, double>("v:weight", -7).first),
      uv_given(given.add_property_map<Halfedge, Point_2>("h:uv", Point_2(7, 7)).first),
      uv(refined.add_property_map<Halfedge, Point_2>("h:uv", Point_2(7, 7)).first),
      seam_given(given.add_property_map<Edge, bool>("e:seam", false).first),
      seam(refined.add_property_map<Edge, bool>("e:seam", false).first),
      input_face(refined.add_property_map<Face, Face>("f:input").first)
  {}

  explicit Case(const Soup& soup) : Case(surface_mesh<Mesh>(soup)) {}

  auto parameters(Retriangulation mode)
  {
    return params::cone_angle_map(cone_angle).log_scale_factor_map(u).edge_is_seam_map(seam_given).retriangulation(mode)
                  .common_refinement(std::ref(refinement));
  }

  template <typename NamedParameters>
  void refine(const NamedParameters& np)
  {
    report = CE::flatten_refined(given, refined, uv, np,
                                 params::projective_weight_map(weight).edge_is_seam_map(seam).input_face_map(input_face));
  }

  void refine(Retriangulation mode) { refine(parameters(mode)); }
};

typedef std::array<double, 3> Vector;

Vector homogeneous(const Case& c, Halfedge h)
{
  const Point_2 p = c.uv[h];
  const double w = c.weight[target(h, c.refined)];
  return {{p.x() * w, p.y() * w, w}};
}

// Where a point lies in a triangle; the residual tells how far it is from its plane, relative to the size of the triangle.
Vector barycentric(const Mesh& sm, Face f, const Point_3& p, double& residual)
{
  const Halfedge h = halfedge(f, sm);
  const Point_3 a = sm.point(source(h, sm)), b = sm.point(target(h, sm)), c = sm.point(target(next(h, sm), sm));
  const auto n = CGAL::cross_product(b - a, c - a);
  const double size = n * n;
  const Vector result = {{ CGAL::cross_product(b - p, c - p) * n / size, CGAL::cross_product(c - p, a - p) * n / size,
                           CGAL::cross_product(a - p, b - p) * n / size }};
  const auto error = p - Point_3(result[0] * a.x() + result[1] * b.x() + result[2] * c.x(),
                                 result[0] * a.y() + result[1] * b.y() + result[2] * c.y(),
                                 result[0] * a.z() + result[1] * b.z() + result[2] * c.z());
  residual = std::sqrt((error * error) / ((b - a) * (b - a) + (c - a) * (c - a)));
  return result;
}

// Everything that a refinement promises.
void check(const Case& c)
{
  BOOST_TEST_REQUIRE(bool(c.report), CE::message(c.report));
  const Mesh& sm = c.refined;
  BOOST_TEST(CGAL::is_triangle_mesh(sm));
  BOOST_TEST(CGAL::is_valid_polygon_mesh(sm));
  BOOST_TEST_REQUIRE(num_vertices(sm) >= num_vertices(c.given));
  for(Vertex v : vertices(c.given))
    BOOST_TEST((c.given.point(v) == sm.point(v)));
  for(Face f : faces(sm)) // exactly positive, and a part of a face given
  {
    const Halfedge h = halfedge(f, sm);
    BOOST_TEST(CGAL::orientation(c.uv[h], c.uv[next(h, sm)], c.uv[prev(h, sm)]) == CGAL::LEFT_TURN);
    for(Vertex v : CGAL::vertices_around_face(h, sm))
    {
      double residual = 0;
      const Vector b = barycentric(c.given, c.input_face[f], sm.point(v), residual);
      BOOST_TEST(residual <= 1e-10);
      BOOST_TEST(*std::min_element(b.begin(), b.end()) >= -1e-10);
    }
  }
  for(Edge e : edges(sm)) // continuous but for the seam, whose sides have equal lengths
  {
    const Halfedge h = halfedge(e, sm), g = opposite(h, sm);
    if(is_border(e, sm))
    {
      BOOST_TEST(!c.seam[e]);
      continue;
    }
    const bool is_continuous = c.uv[h] == c.uv[prev(g, sm)] && c.uv[g] == c.uv[prev(h, sm)];
    BOOST_TEST(c.seam[e] == !is_continuous);
    const double l = uv_length(sm, c.uv, h), k = uv_length(sm, c.uv, g);
    BOOST_TEST(std::abs(l - k) <= 8 * rounding_of_lengths(sm, c.uv) * l);
  }
  for(Vertex v : vertices(sm)) // turning once; cones as prescribed
    if(!sm.is_border(v))
    {
      const double angle = v.idx() < num_vertices(c.given) ? c.cone_angle[v] : 2 * CGAL_PI;
      BOOST_TEST(std::abs(uv_angle_sum(sm, c.uv, v) - angle) <= 1e-10);
    }
}

// The maps of the triangles of one face are one projective map, and it takes the circumcircle to a circle.
void check_circumcircles(const Case& c)
{
  std::vector<std::vector<Halfedge> > corners(num_faces(c.given));
  for(Face f : faces(c.refined))
    for(Halfedge h : CGAL::halfedges_around_face(halfedge(f, c.refined), c.refined))
      corners[c.input_face[f].idx()].push_back(h);
  for(Face f : faces(c.refined))
  {
    // homogeneous coordinates are linear in the barycentric ones: column k is the image of the corner k of the input face
    const Halfedge h = halfedge(f, c.refined);
    const std::array<Halfedge, 3> hs = {{h, next(h, c.refined), prev(h, c.refined)}};
    std::array<Vector, 3> b, z;
    double residual = 0;
    for(int k = 0; k < 3; ++k)
    {
      b[k] = barycentric(c.given, c.input_face[f], c.refined.point(target(hs[k], c.refined)), residual);
      z[k] = homogeneous(c, hs[k]);
    }
    const auto det = [](const Vector& p, const Vector& q, const Vector& r)
    {
      return p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
    };
    const double volume = det(b[0], b[1], b[2]);
    if(std::abs(volume) < 1e-3)
      continue; // too thin to extrapolate from
    const auto image = [&](const Vector& x)
    {
      const double a0 = det(x, b[1], b[2]) / volume, a1 = det(b[0], x, b[2]) / volume, a2 = det(b[0], b[1], x) / volume;
      Vector p;
      for(int i = 0; i < 3; ++i)
        p[i] = a0 * z[0][i] + a1 * z[1][i] + a2 * z[2][i];
      return Point_2(p[0] / p[2], p[1] / p[2]);
    };
    // a fourth point of the circumcircle: with the side lengths l, the circle is the sum of l_k^2 b_i b_j = 0
    const Halfedge g = halfedge(c.input_face[f], c.given);
    const Point_3 q0 = c.given.point(source(g, c.given)), q1 = c.given.point(target(g, c.given)),
                  q2 = c.given.point(target(next(g, c.given), c.given));
    const double l0 = CGAL::squared_distance(q1, q2), l1 = CGAL::squared_distance(q2, q0), l2 = CGAL::squared_distance(q0, q1);
    const double t = .5 * (l0 + l1) / l2; // b = (1, 1, s): l0 s + l1 s + l2 = 0
    const Vector fourth = {{1, 1, -.5 / t}};
    const Point_2 p0 = image({{1, 0, 0}}), p1 = image({{0, 1, 0}}), p2 = image({{0, 0, 1}}), p3 = image(fourth);
    const Point_2 centre = CGAL::circumcenter(p0, p1, p2);
    const double r = plane_distance(centre, p0);
    BOOST_TEST(std::abs(plane_distance(centre, p3) - r) <= 1e-7 * r);
  }
}

// The tip over one corner of the border of a pentagon, with angles for which no metric exists without flips across the border.
Case tip()
{
  Soup soup = cone(5, .3);
  soup.points[0] = {{.9, 0, .3}};
  Case c(soup);
  const std::array<double, 5> degrees = {{ 6, 174, 120, 120, 120 }};
  c.border_angle = c.given.add_property_map<Vertex, double>("v:border", 0).first;
  for(Index i = 0; i < 5; ++i)
    c.border_angle[Vertex(1 + i)] = degrees[i] / 180 * CGAL_PI;
  return c;
}

void spread_cones(Case& c, int n)
{
  const std::size_t step = num_vertices(c.given) / n;
  for(int i = 0; i < n; ++i)
    c.cone_angle[Vertex(static_cast<Index>(i * step))] = 2 * CGAL_PI - 4 * CGAL_PI / n;
}

} // namespace

BOOST_AUTO_TEST_CASE(copy_without_flips)
{
  Case c(hill(6, .5));
  c.refine(Retriangulation::WHEN_NEEDED);
  check(c);
  BOOST_TEST(num_vertices(c.refined) == num_vertices(c.given));
  BOOST_TEST(num_faces(c.refined) == num_faces(c.given));
  BOOST_TEST(c.report.bent_faces.empty());
  BOOST_TEST(bool(CE::flatten(c.given, c.uv_given)));
  for(Face f : faces(c.refined))
    for(Halfedge h : CGAL::halfedges_around_face(halfedge(f, c.refined), c.refined))
    {
      const Halfedge g = halfedge(source(h, c.refined), target(h, c.refined), c.given).first;
      BOOST_TEST((c.uv[h] == c.uv_given[g]));
    }
}

BOOST_AUTO_TEST_CASE(flips_across_the_border)
{
  for(Retriangulation mode : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
  {
    Case c = tip();
    c.refine(c.parameters(mode).border_angle_map(c.border_angle));
    check(c);
    BOOST_TEST(c.report.statistics.number_of_flips > 0u);
    BOOST_TEST(num_vertices(c.refined) == num_vertices(c.given) + c.refinement.crossings.size());
    check_circumcircles(c);
  }
}

BOOST_AUTO_TEST_CASE(closed_with_cones)
{
  for(Retriangulation mode : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
  {
    Soup soup = icosphere(2);
    soup = scaled(soup, 1, 1, 5); // long enough for triangles to break
    Case c(soup);
    spread_cones(c, 4);
    c.refine(mode);
    check(c);
    if(mode == Retriangulation::WHEN_NEEDED)
      check_circumcircles(c);
  }
}

BOOST_AUTO_TEST_CASE(meshes_with_flips, * needs_mesh("cylinder_locally_refined.off"))
{
  for(const char* name : { "cylinder_locally_refined.off", "mannequin-devil.off", "blob.off", "corner_tris_with_hole.off",
                           "degtri_sliding.off", "ALSTOM_TEST4.off", "elk.off", "pig.off" })
    BOOST_TEST_CONTEXT(name)
    {
      Case c(read_mesh(name));
      c.refine(Retriangulation::WHEN_NEEDED);
      BOOST_TEST(bool(c.report), CE::message(c.report));
      BOOST_TEST(c.report.statistics.number_of_flips > 0u);
      const CE::Layout_verdict<Mesh> verdict = CE::verify_layout(c.refined, c.uv);
      BOOST_TEST(verdict.flipped_faces.empty());
      BOOST_TEST(verdict.degenerate_faces.empty());

      // flatten() agrees: straight triangles are what it refuses, or lists if the refinement is asked for
      const auto np = params::retriangulation(Retriangulation::WHEN_NEEDED);
      const Report straight = CE::flatten(c.given, c.uv_given, np);
      BOOST_TEST(bool(straight) == c.report.bent_faces.empty());
      if(!straight)
      {
        BOOST_TEST((straight.status == Status::NOT_INJECTIVE));
        BOOST_TEST((straight.faces == c.report.bent_faces));
      }
      CE::Common_refinement<> refinement;
      const Report both = CE::flatten(c.given, c.uv_given, np.common_refinement(std::ref(refinement)));
      BOOST_TEST_REQUIRE(bool(both), CE::message(both));
      BOOST_TEST((both.bent_faces == c.report.bent_faces));
      BOOST_TEST(refinement.crossings.size() == c.refinement.crossings.size());
      for(Halfedge h : halfedges(c.refined)) // vertices lie where flatten() puts them
        if(!is_border(h, c.refined) && target(h, c.refined).idx() < num_vertices(c.given))
        {
          const Face f = c.input_face[face(h, c.refined)];
          for(Halfedge g : CGAL::halfedges_around_face(halfedge(f, c.given), c.given))
            if(target(g, c.given) == target(h, c.refined))
              BOOST_TEST((c.uv[h] == c.uv_given[g]));
        }
    }
}

BOOST_AUTO_TEST_CASE(refused)
{
  Soup soup = hill(4, .3);
  soup.points[7] = soup.points[8];
  Case c(soup);
  c.refine(Retriangulation::WHEN_NEEDED);
  BOOST_TEST((c.report.status == Status::ZERO_LENGTH_EDGE));
  BOOST_TEST(num_vertices(c.refined) == 0u);
  BOOST_TEST(c.u[Vertex(0)] == -7);

  Case sphere(icosphere(1)); // lacks cones
  sphere.refine(Retriangulation::ALWAYS);
  BOOST_TEST((sphere.report.status == Status::MISSING_CONDITION));
  BOOST_TEST(num_vertices(sphere.refined) == 0u);

  Case kept = tip();
  kept.refine(kept.parameters(Retriangulation::NEVER).border_angle_map(kept.border_angle));
  BOOST_TEST((kept.report.status == Status::DEGENERATE_METRIC), CE::message(kept.report));
  BOOST_TEST(num_vertices(kept.refined) == 0u);
}
