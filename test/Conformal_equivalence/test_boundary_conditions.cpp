// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Conditions read from property maps, and the functions that fill such maps: the angles of a rectangle, and the choice of its corners. The
// rectangles are judged by the checker of check_flattening.h, which shares no code with the package.

#define BOOST_TEST_MODULE test_boundary_conditions
#include "include/boost_test.h"
#include "include/border_maps.h"
#include "include/flattened_meshes.h"

#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/boundary_conditions.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/discrete_metric.h>
#include <CGAL/Conformal_equivalence/edge_lengths.h>
#include <CGAL/Conformal_equivalence/flatten.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <set>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;
using namespace testing;
using CE::Status;

namespace {

typedef CE::Flattening_report<Mesh>     Report;
typedef CE::Conformal_conditions<double> Conditions;
typedef CE::Exact_angle<double>         Angle;
typedef Border_maps                     Maps;

const double infinity = std::numeric_limits<double>::infinity();

template <typename Range>
std::set<std::size_t> set_of(const Range& range) { return std::set<std::size_t>(range.begin(), range.end()); }

} // namespace

// --- conditions ---------------------------------------------------------------------------------

namespace {

// An annulus, and a vertex that belongs to nothing.
struct Annulus : Maps
{
  CE::Imported_mesh<Mesh> mesh;
  Mesh::Property_map<Vertex, double> cone_angle;
  std::vector<Index> missing;

  Annulus() : Maps(together({annulus(2, 8, .3)}, true)), mesh(CE::import_mesh(sm))
  {
    cone_angle = sm.add_property_map<Vertex, double>("v:cone_angle", 2 * CGAL_PI).first;
    BOOST_REQUIRE((mesh.status == Status::OK));
  }

  template <typename NamedParameters>
  Conditions read(const NamedParameters& np)
  {
    missing.clear();
    return CE::read_conditions(mesh, missing, np);
  }

  // What is expected of the vertices that belong to faces: a fixed u, or an angle.
  template <typename FixedU, typename AngleSum, typename IsFixed>
  void check(const Conditions& conditions, IsFixed is_fixed, FixedU fixed_u, AngleSum angle_sum) const
  {
    BOOST_REQUIRE(conditions.size() == mesh.triangulation.number_of_vertices());
    for(Vertex v : vertices(sm))
    {
      if(sm.is_isolated(v))
        continue;
      const Index i = mesh.index_of_vertex(v);
      BOOST_TEST(conditions.is_fixed(i) == is_fixed(v));
      BOOST_TEST(!conditions.is_bounded(i));
      if(conditions.is_fixed(i))
        BOOST_TEST(conditions.log_scale_factor(i) == fixed_u(v));
      else
        BOOST_TEST(conditions.angle_sum(i).radians() == angle_sum(v));
    }
  }
};

} // namespace

BOOST_AUTO_TEST_CASE(a_natural_border)
{
  Annulus a;
  const auto is_border = [&](Vertex v) { return a.sm.is_border(v); };
  const auto flat = [](Vertex) { return 2 * CGAL_PI; };
  a.check(a.read(params::default_values()), is_border, [](Vertex) { return 0.; }, flat);
  BOOST_TEST(a.missing.empty());
  for(Vertex v : vertices(a.sm))
    a.fixed_u[v] = 1. / (1 + double(v.idx()));
  a.check(a.read(params::prescribed_log_scale_factor_map(a.fixed_u)), is_border, [&](Vertex v) { return a.fixed_u[v]; }, flat);
  BOOST_TEST(a.missing.empty());
}

// Angles alone: nothing is fixed. What is a multiple of pi / 2520 is known as that.
BOOST_AUTO_TEST_CASE(angles)
{
  Annulus a;
  for(Vertex v : vertices(a.sm))
  {
    a.angle[v] = 1 + double(v.idx()) / 64;
    a.cone_angle[v] = 5 + double(v.idx()) / 64;
  }
  const auto none = [](Vertex) { return false; };
  const auto no_u = [](Vertex) { return infinity; };
  a.check(a.read(params::border_angle_map(a.angle)), none, no_u,
          [&](Vertex v) { return a.sm.is_border(v) ? a.angle[v] : 2 * CGAL_PI; });
  a.check(a.read(params::border_angle_map(a.angle).cone_angle_map(a.cone_angle)), none, no_u,
          [&](Vertex v) { return a.sm.is_border(v) ? a.angle[v] : a.cone_angle[v]; });
  a.check(a.read(params::cone_angle_map(a.cone_angle)), [&](Vertex v) { return a.sm.is_border(v); }, [](Vertex) { return 0.; },
          [&](Vertex v) { return a.cone_angle[v]; });
  BOOST_TEST(a.missing.empty());

  for(Vertex v : vertices(a.sm))
    a.cone_angle[v] = CGAL_PI * double(v.idx() + 1) / 12;
  const Conditions conditions = a.read(params::cone_angle_map(a.cone_angle));
  for(Vertex v : vertices(a.sm))
    if(!a.sm.is_isolated(v) && !a.sm.is_border(v))
    {
      BOOST_TEST(conditions.angle_sum(a.mesh.index_of_vertex(v)).is_exact());
      BOOST_TEST(conditions.angle_sum(a.mesh.index_of_vertex(v)).units == Angle::pi_times(std::int32_t(v.idx()) + 1, 12).units);
    }
}

// The map of constraints alone decides what is fixed, inside and on the border. A border vertex that it leaves free has to have an angle.
BOOST_AUTO_TEST_CASE(constraints)
{
  Annulus a;
  for(Vertex v : vertices(a.sm))
  {
    a.is_fixed[v] = v.idx() % 3 == 0;
    a.fixed_u[v] = -double(v.idx());
    a.angle[v] = 1;
  }
  const auto is_fixed = [&](Vertex v) { return a.is_fixed[v]; };
  const auto fixed_u = [&](Vertex v) { return a.fixed_u[v]; };
  const auto np = params::prescribed_log_scale_factor_map(a.fixed_u).vertex_is_constrained_map(a.is_fixed);
  a.check(a.read(np.border_angle_map(a.angle)), is_fixed, fixed_u, [&](Vertex v) { return a.sm.is_border(v) ? 1. : 2 * CGAL_PI; });
  BOOST_TEST(a.missing.empty());

  a.read(np);
  std::vector<Index> expected;
  for(Index i = 0; i < a.mesh.triangulation.number_of_vertices(); ++i)
    if(a.mesh.triangulation.is_border_vertex(i) && !a.is_fixed[a.mesh.vertex(i)])
      expected.push_back(i);
  BOOST_TEST(!expected.empty());
  BOOST_TEST(a.missing == expected);
}

// Angles of type double are read as what they mean, whatever the numbers of the solver are: 2 pi in double is 2 pi with more digits, too.
BOOST_AUTO_TEST_CASE(conditions_for_other_numbers)
{
  typedef long double Real;
  Maps m(flat_grid(2));
  for(Vertex v : vertices(m.sm))
    m.angle[v] = v.idx() == 0 ? 1.25 : CGAL_PI / 7;
  const CE::Imported_mesh<Mesh, Real> mesh = CE::import_mesh<Real>(m.sm);
  std::vector<Index> missing;
  const CE::Conformal_conditions<Real> conditions = CE::read_conditions(mesh, missing, params::border_angle_map(m.angle));
  for(Vertex v : vertices(m.sm))
  {
    const CE::Exact_angle<Real> angle = conditions.angle_sum(mesh.index_of_vertex(v));
    if(v.idx() == 0)
      BOOST_TEST(((angle.units == 0 && angle.rest == Real(1.25))));
    else
      BOOST_TEST(((angle.is_exact() && angle.units == (m.sm.is_border(v) ? Angle::pi_times(1, 7) : Angle::pi_times(2)).units)));
  }
}

// --- rectangle ----------------------------------------------------------------------------------

namespace {

typedef std::array<Vertex, 4> Corners;

void check_rectangle(Maps& m, const Corners& corners)
{
  CE::prescribe_rectangle(m.sm, corners, m.angle);
  const Report report = m.flatten(params::border_angle_map(m.angle));
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  const checking::Verdict verdict = judge(m.sm, m.uv, false);
  BOOST_TEST(verdict.is_good(), verdict);

  // every border edge lies along one of two directions, at right angles; the corners are where they meet
  const double rounding = rounding_of_lengths(m.sm, m.uv);
  std::size_t right_angles = 0, in_order = 0;
  for(Halfedge h : CGAL::halfedges_around_face(border_halfedge(m.sm), m.sm))
  {
    const Point_2 p = m.uv[prev(h, m.sm)], q = m.uv[h], r = m.uv[next(h, m.sm)];
    const double x = q.x() - p.x(), y = q.y() - p.y(), s = r.x() - q.x(), t = r.y() - q.y();
    const double size = std::hypot(x, y) * std::hypot(s, t);
    const double sine = (x * t - y * s) / size, cosine = (x * s + y * t) / size; // clockwise along the border
    if(std::find(corners.begin(), corners.end(), target(h, m.sm)) != corners.end())
    {
      ++right_angles;
      BOOST_TEST(sine < 0);
      BOOST_TEST(std::abs(cosine) <= (std::max)(1e-10, 32 * rounding));
    }
    else
    {
      BOOST_TEST(cosine > 0);
      BOOST_TEST(std::abs(sine) <= (std::max)(1e-10, 32 * rounding));
    }
  }
  BOOST_TEST(right_angles == 4u);
  // in the order of the border
  Halfedge h = border_halfedge(m.sm);
  while(target(h, m.sm) != corners[0])
    h = next(h, m.sm);
  for(const Halfedge first = h; in_order < 4; )
  {
    if(target(h, m.sm) == corners[in_order])
      ++in_order;
    h = next(h, m.sm);
    if(h == first)
      break;
  }
  BOOST_TEST(in_order == 4u);
}

// The Dirichlet energy of u for the corners; infinite if there is no such rectangle.
double rectangle_energy(const Maps& m, const Corners& corners)
{
  const auto mesh = CE::import_mesh(m.sm);
  CE::Conformal_conditions<double> conditions(mesh.triangulation);
  for(Vertex v : border_vertices(m.sm))
  {
    const bool is_corner = std::find(corners.begin(), corners.end(), v) != corners.end();
    conditions.prescribe_angle_sum(mesh.index_of_vertex(v), CE::Exact_angle<double>::pi_times(1, is_corner ? 2 : 1));
  }
  const auto metric = CE::compute_conformal_metric(mesh.triangulation, conditions);
  return metric ? CE::dirichlet_energy(mesh.triangulation, metric.log_scale_factors) : infinity;
}

Corners select_corners(const Mesh& sm, Report& report, CE::Retriangulation retriangulation = CE::Retriangulation::WHEN_NEEDED)
{
  return CE::select_rectangle_corners(sm, border_halfedge(sm), params::flattening_report(std::ref(report)).retriangulation(retriangulation));
}

} // namespace

BOOST_AUTO_TEST_CASE(rectangles)
{
  for(const Soup& soup : { flat_grid(4), hill(8, .5), random_height_field(6, .5, 2), cone(8, .6),
                           scaled(hill(5, .4), 1e-150), scaled(hill(5, .4), 1e150),
                           rings(5, [](double x, double y) { return .4 * std::exp(-3 * (x * x + y * y)); }) })
  {
    Maps m(soup);
    check_rectangle(m, CE::select_rectangle_corners(m.sm, border_halfedge(m.sm)));
  }
}

BOOST_AUTO_TEST_CASE(rectangles_of_CGAL, * needs_mesh("lion-head.off"))
{
  for(const char* name : { "lion-head.off", "nefertiti.off" })
    BOOST_TEST_CONTEXT(name)
    {
      Maps m(read_mesh(name));
      check_rectangle(m, CE::select_rectangle_corners(m.sm, border_halfedge(m.sm)));
    }
}

BOOST_AUTO_TEST_CASE(corners_of_a_square_are_its_corners)
{
  const auto bump = [](double x, double y) { return .2 * std::exp(-9 * ((x - .5) * (x - .5) + (y - .5) * (y - .5))); };
  for(const Soup& soup : { flat_grid(5), symmetric_grid(4, bump), symmetric_grid(5, [](double, double) { return 0.; }) })
  {
    Maps m(soup);
    Report report;
    const Corners corners = select_corners(m.sm, report);
    BOOST_TEST((report.status == Status::OK));
    for(Vertex v : corners)
    {
      const Point_3 p = m.sm.point(v);
      BOOST_TEST(((p.x() == 0 || p.x() == 1) && (p.y() == 0 || p.y() == 1)), p);
    }
    BOOST_TEST(std::set<Vertex>(corners.begin(), corners.end()).size() == 4u);
  }
}

BOOST_AUTO_TEST_CASE(forced_corners)
{
  Report report;
  const Mesh four = surface_mesh<Mesh>(star(4)); // the tips of the star
  const Corners tips = select_corners(four, report);
  BOOST_TEST((report.status == Status::OK));
  for(Vertex v : tips)
    BOOST_TEST(v.idx() >= 5u);

  const Mesh two = surface_mesh<Mesh>(hill(4, .3)); // two corners of the grid
  const Corners corners = select_corners(two, report);
  for(Vertex v : vertices(two))
    if(degree(v, two) == 2)
      BOOST_TEST((std::find(corners.begin(), corners.end(), v) != corners.end()));

  Maps six(star(6));
  const Corners none = select_corners(six.sm, report, CE::Retriangulation::NEVER);
  BOOST_TEST((report.status == Status::ANGLE_OUT_OF_RANGE));
  BOOST_TEST(report.amount == CGAL_PI);
  BOOST_TEST((set_of(report.vertex_indices) == std::set<std::size_t>{ 7, 8, 9, 10, 11, 12 }));
  BOOST_TEST((none[0] == Mesh::null_vertex()));
  CE::prescribe_rectangle(six.sm, none, six.angle);
  const auto kept = params::border_angle_map(six.angle).retriangulation(CE::Retriangulation::NEVER);
  BOOST_TEST((six.flatten(kept).status == Status::ANGLE_OUT_OF_RANGE));
  CE::prescribe_rectangle(six.sm, {{Vertex(7), Vertex(8), Vertex(9), Vertex(10)}}, six.angle);
  const Report refused = six.flatten(kept);
  BOOST_TEST((refused.status == Status::ANGLE_OUT_OF_RANGE));
  BOOST_TEST((set_of(refused.vertex_indices) == std::set<std::size_t>{ 11, 12 }));
  BOOST_TEST(six.is_untouched());
}

// More border vertices with a single triangle than a rectangle has corners: with flips, each of them can be straight.
BOOST_AUTO_TEST_CASE(more_single_triangles_than_corners)
{
  for(const Index n : { 5, 6, 9 })
  {
    Maps m(star(n));
    Report report;
    const Corners corners = select_corners(m.sm, report);
    BOOST_REQUIRE((report.status == Status::OK));
    BOOST_TEST(std::set<Vertex>(corners.begin(), corners.end()).size() == 4u);
    CE::prescribe_rectangle(m.sm, corners, m.angle);
    CE::Common_refinement<double> refinement; // so that triangles may be bent
    const Report flat = m.flatten(params::border_angle_map(m.angle).common_refinement(std::ref(refinement)));
    BOOST_TEST(bool(flat), CE::message(flat));
    BOOST_TEST(flat.statistics.number_of_flips > 0u);
    for(Vertex v : border_vertices(m.sm)) // the angle of the refined map, up to what the solver leaves of it and the rounding of coordinates
    {
      const bool is_corner = std::find(corners.begin(), corners.end(), v) != corners.end();
      BOOST_TEST(std::abs(refinement.angle_sums[v] - CGAL_PI / (is_corner ? 2 : 1)) <= 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(no_corners)
{
  Report report;
  for(const Soup& soup : { one_triangle({{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}), cone(3, .5) })
  {
    const Mesh sm = surface_mesh<Mesh>(soup);
    const Corners corners = select_corners(sm, report);
    BOOST_TEST((report.status == Status::MISSING_CONDITION));
    for(Vertex v : corners)
      BOOST_TEST((v == Mesh::null_vertex()));
  }
  const Mesh ring = surface_mesh<Mesh>(annulus(2, 8));
  BOOST_TEST((select_corners(ring, report)[0] == Mesh::null_vertex()));
  BOOST_TEST((report.status == Status::WRONG_TOPOLOGY));
}

// Where candidates are looked for on the double, too, and models are made there. No exchange with a neighbour on the border is better.
BOOST_AUTO_TEST_CASE(corners_where_the_natural_map_needs_the_double, * needs_mesh("cylinder_locally_refined.off"))
{
  const Maps m(read_mesh("cylinder_locally_refined.off"));
  const auto mesh = CE::import_mesh(m.sm);
  BOOST_TEST_REQUIRE(CE::compute_conformal_metric(mesh.triangulation, CE::Conformal_conditions<double>(mesh.triangulation)).is_doubled);
  Report report;
  const Corners corners = select_corners(m.sm, report);
  BOOST_TEST((report.status == Status::OK));
  BOOST_TEST(std::set<Vertex>(corners.begin(), corners.end()).size() == 4u);
  const double chosen = rectangle_energy(m, corners);
  BOOST_TEST(std::isfinite(chosen));
  const std::vector<Vertex> border = border_vertices(m.sm);
  const auto place = std::find(border.begin(), border.end(), corners[0]);
  BOOST_TEST_REQUIRE((place != border.end()));
  Corners other = corners;
  other[0] = place + 1 == border.end() ? border.front() : place[1];
  BOOST_TEST(rectangle_energy(m, other) >= chosen);
}

BOOST_AUTO_TEST_CASE(no_exchange_of_a_corner_is_better)
{
  const auto bump = [](double x, double y) { return .6 * std::exp(-5 * ((x - .3) * (x - .3) + y * y)); };
  for(const Soup& soup : { hill(4, .5), random_height_field(5, .7, 11), rings(3, bump), cone(9, .5) })
  {
    const Maps m(soup);
    Report report;
    const Corners corners = select_corners(m.sm, report);
    BOOST_TEST_REQUIRE((report.status == Status::OK));
    const double chosen = rectangle_energy(m, corners);
    BOOST_TEST(std::isfinite(chosen));
    std::size_t exchanges = 0;
    for(int k = 0; k < 4; ++k)
      for(Vertex v : border_vertices(m.sm))
      {
        if(degree(corners[k], m.sm) == 2 || std::find(corners.begin(), corners.end(), v) != corners.end())
          continue; // must be a corner, or is one
        Corners other = corners;
        other[k] = v;
        BOOST_TEST(rectangle_energy(m, other) >= chosen * (1 - 1e-6));
        ++exchanges;
      }
    BOOST_TEST(exchanges > 0u);
  }
}

// Solves for metrics are a part of the search, and none of the visitor's business; but they stop when it says so.
BOOST_AUTO_TEST_CASE(a_visitor_is_told_of_the_search_for_corners_and_may_stop_it)
{
  struct Listener : public CE::Default_visitor
  {
    int left;
    std::vector<CE::Stage> stages;
    std::vector<std::size_t> numbers;

    explicit Listener(int left) : left(left) {}
    void on_stage(CE::Stage stage) { stages.push_back(stage); }
    void on_progress(CE::Stage stage, std::size_t number, double)
    {
      if(stage == CE::Stage::CORNERS)
        numbers.push_back(number);
    }
    bool go_further() { return left-- > 0; }
  };
  const Maps m(hill(4, .5));
  Report report;
  const Corners corners = select_corners(m.sm, report);
  BOOST_TEST_REQUIRE(bool(report));
  const auto select = [&](Listener& listener)
  {
    return CE::select_rectangle_corners(m.sm, border_halfedge(m.sm), params::flattening_report(std::ref(report)).visitor(std::ref(listener)));
  };
  Listener patient(1000000);
  BOOST_TEST((select(patient) == corners));
  BOOST_TEST((patient.stages == std::vector<CE::Stage>{ CE::Stage::CORNERS }));
  BOOST_TEST_REQUIRE(!patient.numbers.empty());
  for(std::size_t i = 0; i < patient.numbers.size(); ++i)
    BOOST_TEST(patient.numbers[i] == i + 1);
  const int asked = 1000000 - patient.left;
  BOOST_TEST(asked > 1);
  for(const int n : { 0, 1, asked / 2, asked - 1 })
  {
    Listener impatient(n);
    const Corners none = select(impatient);
    BOOST_TEST((report.status == Status::STOPPED_BY_VISITOR));
    BOOST_TEST((none[0] == Mesh::null_vertex()));
    BOOST_TEST(impatient.left >= -3); // it is hardly asked again
  }
  Listener just_patient_enough(asked);
  BOOST_TEST((select(just_patient_enough) == corners));
}

// --- what is prescribed, and what is refused ----------------------------------------------------

// On one border only, and nowhere else.
BOOST_AUTO_TEST_CASE(a_rectangle_is_written_on_one_border)
{
  Maps m(annulus(2, 8));
  for(double& x : m.angle)
    x = unwritten;
  const std::vector<Vertex> border = border_vertices(m.sm);
  const Corners corners = {{border[1], border[2], border[5], border[7]}};
  CE::prescribe_rectangle(m.sm, corners, m.angle);
  double turning = 0;
  for(Vertex v : vertices(m.sm))
    if(std::find(border.begin(), border.end(), v) == border.end())
      BOOST_TEST(m.angle[v] == unwritten);
    else
    {
      BOOST_TEST(m.angle[v] == (std::find(corners.begin(), corners.end(), v) != corners.end() ? CGAL_PI / 2 : CGAL_PI));
      turning += CGAL_PI - m.angle[v];
    }
  BOOST_TEST(turning == 2 * CGAL_PI);

  for(double& x : m.angle)
    x = unwritten;
  Corners none;
  none.fill(Mesh::null_vertex());
  CE::prescribe_rectangle(m.sm, none, m.angle);
  BOOST_TEST(std::all_of(m.angle.begin(), m.angle.end(), [](double x) { return x == unwritten; }));
}

// It does not matter where the border begins, nor in which unit of length, nor whether lengths are given or points.
BOOST_AUTO_TEST_CASE(the_same_corners_however_they_are_asked_for)
{
  const Soup soup = random_height_field(5, .7, 11);
  Maps m(soup);
  Report report;
  const std::set<std::size_t> corners = set_of(select_corners(m.sm, report));
  BOOST_TEST_REQUIRE((report.status == Status::OK));
  BOOST_TEST(corners.size() == 4u);
  Halfedge h = border_halfedge(m.sm);
  for(int k = 0; k < 5; ++k, h = next(next(next(h, m.sm), m.sm), m.sm))
    BOOST_TEST((set_of(CE::select_rectangle_corners(m.sm, h)) == corners));
  BOOST_TEST((set_of(select_corners(surface_mesh<Mesh>(scaled(soup, std::ldexp(1., 300))), report)) == corners));

  const auto length = m.sm.add_property_map<Edge, double>("e:length").first;
  BOOST_TEST_REQUIRE(bool(CE::compute_edge_lengths(m.sm, length)));
  for(Vertex v : vertices(m.sm))
    m.sm.point(v) = Point_3(0, 0, 0);
  BOOST_TEST((set_of(CE::select_rectangle_corners(m.sm, h, params::edge_length_map(length))) == corners));
}

BOOST_AUTO_TEST_CASE(corners_of_what_cannot_be_imported)
{
  const auto check = [](const Mesh& sm, Status status)
  {
    Report report;
    const Corners corners = select_corners(sm, report);
    BOOST_TEST((report.status == status), CE::message(report) << ", expected: " << CE::message(status));
    for(Vertex v : corners)
      BOOST_TEST((v == Mesh::null_vertex()));
    return report;
  };
  Soup soup = hill(3, .3);
  soup.points[5][1] = infinity;
  BOOST_TEST((check(surface_mesh<Mesh>(soup), Status::INVALID_NUMBER).vertex_indices == std::vector<std::size_t>(1, 5)));
  soup.points[5] = soup.points[6];
  BOOST_TEST((check(surface_mesh<Mesh>(soup), Status::ZERO_LENGTH_EDGE).edges.size() == 1u));
  Mesh with_quad = surface_mesh<Mesh>(hill(3, .3));
  for(Edge e : edges(with_quad))
    if(!is_border(e, with_quad))
    {
      CGAL::Euler::join_face(halfedge(e, with_quad), with_quad);
      break;
    }
  BOOST_TEST((check(with_quad, Status::NOT_TRIANGULATED).faces.size() == 1u));
  BOOST_TEST(check(surface_mesh<Mesh>(together({flat_grid(3), flat_grid(3)})), Status::WRONG_TOPOLOGY).faces.empty());
}
