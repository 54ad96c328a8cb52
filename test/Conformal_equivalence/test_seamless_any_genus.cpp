// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Seamless surfaces with handles: loops through flips, the linearized equations against differences, square-tiled surfaces, which have a
// solution by construction, what does not exist, and the door.

#define BOOST_TEST_MODULE test_seamless_any_genus
#include "include/boost_test.h"

#include "include/flattened_meshes.h"
#include "include/index_level.h"
#include "include/test_meshes.h"
#include "include/tolerances.h"

#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/compute_refined_seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/compute_seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/place_cones.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;
using namespace testing;

namespace {

using CE::internal::Corner_angles;
using CE::internal::Dual_loops;
using CE::internal::Prescribed_turning;
using CE::internal::Quantized_cone;
using CE::internal::Seamless_signature;
using CE::internal::Turning_metric;
using CE::internal::Turning_targets;
typedef CE::internal::Handle_turner<double>  Handle_turner;
typedef CE::internal::Turning_newton<double> Turning_newton;
typedef CE::Surface_existence                Existence;
typedef CE::Flattening_report<Mesh>          Report;
typedef std::vector<Index>                   Loop;

// Radians: a turning, as a sum of some hundred angles of triangles that are not too sharp, with a few roundings each.
constexpr double rounded_turning = 1e-11;

// ---- Surfaces

// Squares whose sides are glued in pairs, at random: the surface is flat but for cones with multiples of a right angle, and turns by such multiples.
// Each square is cut into four triangles around its centre, the last of its vertices; triangle 4 q + s has the side s of the square q. The
// surface may have several components.
Triangulation square_tiled(Index n, unsigned seed)
{
  Random random(seed);
  std::vector<Index> sides(4 * n), twin(12 * n);
  std::iota(sides.begin(), sides.end(), Index(0));
  for(Index i = 4 * n; i > 1; --i)
    std::swap(sides[i - 1], sides[random.below(i)]);
  for(Index i = 0; i < 4 * n; i += 2)
  {
    twin[3 * sides[i]] = 3 * sides[i + 1];
    twin[3 * sides[i + 1]] = 3 * sides[i];
  }
  for(Index f = 0; f < 4 * n; ++f) // halfedge 3 f + 1 runs to the centre, 3 f + 2 back
  {
    const Index left = f % 4 == 3 ? f - 3 : f + 1;
    twin[3 * f + 1] = 3 * left + 2;
    twin[3 * left + 2] = 3 * f + 1;
  }
  const Index none = Triangulation::null_index;
  std::vector<Index> origin(12 * n, none);
  Index vertices = 0;
  for(Index first = 0; first < 12 * n; ++first)
  {
    if(origin[first] != none)
      continue;
    Index h = first;
    do
    {
      origin[h] = vertices;
      h = twin[Triangulation::previous(h)];
    }
    while(h != first);
    ++vertices;
  }
  Triangulation t(vertices, origin, twin);
  for(Index e = 0; e < t.number_of_edges(); ++e)
    t.set_length(e, t.edge_halfedge(e) % 3 == 0 ? 1 : std::sqrt(.5));
  return t;
}

// The first of these that is connected and has handles.
Triangulation connected_square_tiled(Index n, unsigned seed)
{
  for(;; seed += 1000)
  {
    Triangulation t = square_tiled(n, seed);
    const auto pieces = CE::connected_components(t);
    if(pieces.components.size() == 1 && pieces.components[0].genus() > 0)
      return t;
  }
}

// Without the faces around some vertices.
Mesh punctured(Mesh sm, const std::vector<Index>& vertices)
{
  for(Index v : vertices)
    for(Face f : std::vector<Face>(sm.faces_around_target(sm.halfedge(Vertex(v))).begin(), sm.faces_around_target(sm.halfedge(Vertex(v))).end()))
      CGAL::Euler::remove_face(sm.halfedge(f), sm);
  sm.collect_garbage();
  return sm;
}

std::size_t genus(const Triangulation& t) { return CE::connected_components(t).components[0].genus(); }

std::vector<double> angle_sums(const Triangulation& t)
{
  const Corner_angles corners(t);
  std::vector<double> result(t.number_of_vertices(), 0.);
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
    result[t.origin(h)] += corners.angle[h];
  return result;
}

std::vector<double> turnings(const Triangulation& t, const Dual_loops& loops) { return CE::internal::turnings(t, loops, Corner_angles(t)); }

void check_equal(const std::vector<double>& a, const std::vector<double>& b, double tolerance)
{
  BOOST_REQUIRE(a.size() == b.size());
  for(std::size_t i = 0; i < a.size(); ++i)
    BOOST_TEST(std::abs(a[i] - b[i]) <= tolerance);
}

void flip_at_random(Triangulation& t, Dual_loops& loops, std::size_t times, Random& random)
{
  for(std::size_t i = 0; i < times; ++i)
  {
    const Index e = random.below(t.number_of_edges());
    const double length = CE::internal::ptolemy_length(t, e);
    if(!t.is_flippable(e))
      continue;
    loops.flip(t, e);
    t.flip_edge(e, length);
  }
}

// A surface with cones, whose angles are multiples of a right angle, and its conformally equivalent metric.
struct Coned
{
  Triangulation t;
  Conditions conditions;
  std::vector<Quantized_cone> cones;
  Metric metric;
};

Coned coned(Triangulation t, const std::vector<std::pair<Index, long> >& cones)
{
  Coned result{t, Conditions(t), {}, {}};
  for(const auto& cone : cones)
  {
    result.conditions.prescribe_angle_sum(cone.first, Angle::pi_times(std::int32_t(cone.second), 2));
    result.cones.push_back({cone.first, cone.second});
  }
  result.metric = CE::compute_conformal_metric(t, result.conditions);
  BOOST_REQUIRE(bool(result.metric));
  return result;
}

std::vector<double> angle_sums_of(const Coned& c)
{
  std::vector<double> result;
  for(Index v = 0; v < c.t.number_of_vertices(); ++v)
    result.push_back(c.conditions.angle_sum(v).radians<double>());
  return result;
}

CE::internal::Turned_handles choose(const Coned& c, const std::vector<Prescribed_turning>& prescribed, int n = 4)
{
  return Handle_turner(c.t, c.metric, c.conditions, c.cones, n, prescribed, CE::Solver_options()).choose();
}

} // namespace

// ---- Loops

BOOST_AUTO_TEST_CASE(a_loop_around_a_vertex_turns_by_its_angle_sum)
{
  const Triangulation t = triangulation(torus(12, 9));
  const std::vector<double> sum = angle_sums(t);
  for(Index v : {Index(0), Index(17), Index(60)})
  {
    Loop around;
    t.for_each_outgoing(v, [&](Index h) { around.push_back(h); }); // each enters the face on its left
    BOOST_TEST(CE::internal::is_dual_loop(t, around));
    BOOST_TEST(std::abs(turnings(t, Dual_loops(t, {around}))[0] - sum[v]) <= rounded_turning);
    std::reverse(around.begin(), around.end());
    for(Index& h : around)
      h = t.twin(h);
    BOOST_TEST(std::abs(turnings(t, Dual_loops(t, {around}))[0] + sum[v]) <= rounded_turning);
  }
}

// Flips that leave the surface as it is leave the turning of a loop as it is, too.
BOOST_AUTO_TEST_CASE(loops_are_carried_through_flips)
{
  for(unsigned seed = 0; seed < 6; ++seed)
  {
    Triangulation t = seed == 0 ? triangulation(torus(14, 9)) : connected_square_tiled(3 + 4 * seed, seed);
    if(seed != 0)
      for(Index e = 0; e < t.number_of_edges(); ++e)
        t.set_length(e, t.length(e) * (1 + 0.1 * std::sin(7. * e))); // 2 sqrt(1/2) 0.9 > 1.1: triangles remain triangles
    Dual_loops loops(t, CE::internal::homology_basis(t));
    BOOST_TEST(loops.size() == 2 * genus(t));
    const std::vector<double> before = turnings(t, loops);
    Loop broken;
    BOOST_REQUIRE(CE::internal::make_intrinsic_delaunay(t, broken, [&](Index e) { loops.flip(t, e); }));
    check_equal(turnings(t, loops), before, rounded_turning);
    for(std::size_t i = 0; i < loops.size(); ++i)
      BOOST_TEST(CE::internal::is_dual_loop(t, loops.loop(i)));
  }
}

// There and back again: Ptolemy flips undone in reverse give the metric and the loops.
BOOST_AUTO_TEST_CASE(flips_undone_leave_loops_as_they_were)
{
  Random random(5);
  Triangulation t = connected_square_tiled(9, 2);
  Dual_loops loops(t, CE::internal::homology_basis(t));
  const std::vector<double> before = turnings(t, loops);
  const std::size_t crossings = loops.number_of_crossings();
  Loop flipped;
  while(flipped.size() < 300)
  {
    const Index e = random.below(t.number_of_edges());
    if(!t.is_flippable(e))
      continue;
    const double length = CE::internal::ptolemy_length(t, e);
    loops.flip(t, e);
    t.flip_edge(e, length);
    flipped.push_back(e);
  }
  BOOST_TEST(loops.number_of_crossings() > crossings);
  std::reverse(flipped.begin(), flipped.end());
  for(Index e : flipped)
  {
    const double length = CE::internal::ptolemy_length(t, e);
    loops.flip(t, e);
    t.flip_edge(e, length);
  }
  BOOST_TEST(loops.number_of_crossings() == crossings);
  check_equal(turnings(t, loops), before, 1e-9); // lengths have been rounded 600 times, after growing by some powers of ten
}

// ---- Homology

BOOST_AUTO_TEST_CASE(classes_of_chains_are_found)
{
  for(unsigned seed = 0; seed < 4; ++seed)
  {
    const Triangulation t = connected_square_tiled(8 + seed, seed);
    const std::vector<Loop> basis = CE::internal::homology_basis(t);
    const CE::internal::Homology_coordinates<double> coordinates(t, basis);
    for(std::size_t i = 0; i < basis.size(); ++i)
    {
      const Loop chain = CE::internal::chain_on_the_left(t, basis[i]);
      BOOST_TEST(CE::internal::is_closed_chain(t, chain));
      std::vector<std::int64_t> unit(basis.size(), 0);
      unit[i] = 1;
      BOOST_TEST(coordinates(chain) == unit, boost::test_tools::per_element());
      // on a flat surface with such cones all loops turn by multiples of a right angle; so does the loop beside the chain
      const Loop beside = Dual_loops::reduced(t, CE::internal::loop_on_the_left(t, chain));
      if(beside.empty())
        continue;
      const double quarters = turnings(t, Dual_loops(t, {beside}))[0] / (pi / 2);
      BOOST_TEST(std::abs(quarters - std::round(quarters)) <= rounded_turning);
    }
    const Index f = 5;
    BOOST_TEST(coordinates({3 * f, 3 * f + 1, 3 * f + 2}) == std::vector<std::int64_t>(basis.size(), 0), boost::test_tools::per_element());
  }
}

// Against all vectors modulo n.
BOOST_AUTO_TEST_CASE(congruent_vectors_are_all_solutions)
{
  Random random(1);
  for(std::int64_t n : {2, 3, 4, 6})
    for(int trial = 0; trial < 40; ++trial)
    {
      std::vector<CE::internal::Congruence> conditions(1 + random.below(3));
      for(auto& c : conditions)
      {
        for(int i = 0; i < 3; ++i)
          c.factors.push_back(std::int64_t(random.below(7)) - 3);
        c.value = std::int64_t(random.below(9)) - 4;
      }
      const auto is_solution = [&](const std::vector<std::int64_t>& m)
      {
        return std::all_of(conditions.begin(), conditions.end(), [&](const CE::internal::Congruence& c)
          { return (std::inner_product(m.begin(), m.end(), c.factors.begin(), -c.value)) % n == 0; });
      };
      std::size_t number = 0;
      for(std::int64_t i = 0; i < n * n * n; ++i)
        number += is_solution({i % n, i / n % n, i / n / n}) ? 1 : 0;
      const CE::internal::Congruent_vectors found(3, conditions, n);
      BOOST_TEST(found.is_empty == (number == 0));
      if(found.is_empty)
        continue;
      BOOST_TEST(is_solution(found.origin));
      Eigen::Matrix3d basis;
      for(int j = 0; j < 3; ++j)
        for(int i = 0; i < 3; ++i)
          basis(i, j) = double(found.basis[std::size_t(j)][std::size_t(i)]);
      for(const auto& v : found.basis)
        BOOST_TEST(is_solution({found.origin[0] + v[0], found.origin[1] + v[1], found.origin[2] + v[2]}));
      // the index of the lattice is one over the part of all vectors that are solutions
      BOOST_TEST(std::lround(std::abs(basis.determinant())) * long(number) == long(n * n * n));
    }
}

// ---- Equations

namespace {

Eigen::VectorXd random_vector(Eigen::Index n, Random& random)
{
  Eigen::VectorXd result(n);
  for(Eigen::Index i = 0; i < n; ++i)
    result[i] = random(-1, 1);
  return result;
}

// Closed, with edges from a vertex to itself; and with borders, where angle sums may be any.
std::vector<Triangulation> deformed_surfaces()
{
  Random random(3);
  std::vector<Triangulation> result = {connected_square_tiled(10, 4),
                                       CE::import_mesh(punctured(surface_mesh<Mesh>(torus(14, 9)), {0, 40})).triangulation};
  for(Triangulation& t : result)
    for(Index e = 0; e < t.number_of_edges(); ++e)
      t.set_length(e, t.length(e) * random(.9, 1.1));
  return result;
}

std::vector<char> border_vertices_of(const Triangulation& t)
{
  std::vector<char> result(t.number_of_vertices(), 0);
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    result[v] = t.is_border_vertex(v) ? 1 : 0;
  return result;
}

} // namespace

BOOST_AUTO_TEST_CASE(changes_of_lengths_and_of_cross_ratios)
{
  typedef CE::internal::Factors_at_vertices Factors;
  const double rounding = 1e-12; // of sums around vertices of some tens of numbers below 10
  Random random(8);
  for(Triangulation t : deformed_surfaces())
  {
    Dual_loops loops(t, CE::internal::homology_basis(t));
    flip_at_random(t, loops, 40, random);
    const auto ratios = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd { return CE::internal::cross_ratio_changes(t, d); };
    const Eigen::Index edges = t.number_of_edges();
    const Factors all(t, Factors::Vertices::ALL), inside(t, Factors::Vertices::INSIDE);
    const Eigen::VectorXd d = random_vector(edges, random), c = ratios(d);

    // those of factors at vertices are conformal, and the sums around vertices inside vanish
    BOOST_TEST(ratios(all.changes(random_vector(t.number_of_vertices(), random))).norm() <= rounding);
    BOOST_TEST(inside.sums(c).norm() <= rounding);

    // there and back: up to factors at vertices, which the nearest ones take away
    const Eigen::VectorXd back = CE::internal::changes_with_cross_ratios(t, c);
    BOOST_TEST((ratios(back) - c).norm() <= rounding);
    BOOST_TEST((all.rest(back, 1e-14) - all.rest(d, 1e-14)).norm() <= 10 * rounding);
    BOOST_TEST(all.sums(all.rest(d, 1e-14)).norm() <= rounding);

    // the matrix is skew-symmetric where both edges have a cross ratio
    Eigen::VectorXd x = random_vector(edges, random), y = random_vector(edges, random);
    for(Index e = 0; e < t.number_of_edges(); ++e)
      if(t.is_border_edge(e))
        x[e] = y[e] = 0;
    BOOST_TEST(std::abs(x.dot(ratios(y)) + y.dot(ratios(x))) <= rounding);

    // with the entries that one triangle gives to edges of the border, changes that vanish there are had back, but for factors inside
    Eigen::VectorXd product = ratios(x);
    for(Index e = 0; e < t.number_of_edges(); ++e)
      if(t.is_border_edge(e))
        product[e] = x[t.edge(t.next(t.edge_halfedge(e)))] - x[t.edge(t.previous(t.edge_halfedge(e)))];
    const Eigen::VectorXd same = CE::internal::changes_with_cross_ratios(t, product);
    BOOST_TEST((inside.rest(same, 1e-14) - inside.rest(x, 1e-14)).norm() <= 10 * rounding);
  }
}

BOOST_AUTO_TEST_CASE(the_linearized_equations_are_those_of_differences)
{
  Random random(5);
  for(const Triangulation& t : deformed_surfaces())
  {
    const Dual_loops loops(t, CE::internal::homology_basis(t));
    const CE::internal::Turning_rows rows(t, border_vertices_of(t));
    const Turning_targets zero{std::vector<double>(t.number_of_vertices(), 0.), std::vector<double>(loops.size(), 0.)};
    CE::internal::Turning_equations equations(t, loops, rows, CE::internal::Turning_newton_options().make_factorization());
    BOOST_REQUIRE(equations.factorize());
    const auto change_of_all = [&](const Eigen::VectorXd& change) -> Eigen::VectorXd // of angle sums and turnings, to first order
    {
      const double step = 1e-6 / change.norm();
      const auto residual = [&](double step)
      {
        Triangulation moved = t;
        for(Index e = 0; e < t.number_of_edges(); ++e)
          moved.set_length(e, t.length(e) * std::exp(step * change[e] / 2));
        return CE::internal::turning_residual(moved, loops, zero, rows, Corner_angles(moved));
      };
      return (residual(step) - residual(-step)) / (2 * step);
    };
    const Eigen::Index n = rows.number_of_vertices();
    const Eigen::VectorXd right = random_vector(n + Eigen::Index(loops.size()), random), change = equations.least_change(right);
    // central differences: rounding over the step, and the square of the step; the equations are solved more exactly
    const double differences = 1e-6 * (1 + right.norm()) * (1 + change.norm());
    BOOST_TEST((change_of_all(change) - right).norm() <= differences);

    // No other change that does the same leaves the class less: orthogonal to all that do nothing. Such are the differences of any change and the one
    // that does the same. (At borders, scales that change count as well.)
    const auto ratios = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd { return CE::internal::cross_ratio_changes(t, d); };
    if(!rows.is_any_free())
      for(int k = 0; k < 3; ++k)
      {
        const Eigen::VectorXd any = random_vector(t.number_of_edges(), random), same = equations.least_change(change_of_all(any));
        BOOST_TEST(std::abs(ratios(same).dot(ratios(any - same))) <= differences * ratios(any).norm());
      }

    // what it costs is what the form tells of the turnings
    Eigen::VectorXd turned = Eigen::VectorXd::Zero(right.size());
    turned.tail(right.size() - n) = right.tail(right.size() - n);
    const double cost = turned.tail(right.size() - n).dot(equations.form() * turned.tail(right.size() - n));
    const double left = ratios(equations.least_change(turned)).squaredNorm();
    if(rows.is_any_free())
      BOOST_TEST(left <= cost * (1 + 1e-6));
    else
      BOOST_TEST(left == cost, boost::test_tools::tolerance(1e-6));

    // what has been done to the class already is undone with the same effect
    const Eigen::VectorXd before = random_vector(t.number_of_edges(), random), undone = equations.change_to_departure(right, ratios(before));
    BOOST_TEST((change_of_all(undone) - right).norm() <= differences * (1 + ratios(before).norm()));
    BOOST_TEST(ratios(before + undone).norm() < ratios(before + change).norm());
  }
}

// The metric of squares is deformed, and scrambled by flips: there is a solution.
BOOST_AUTO_TEST_CASE(square_tiled_surfaces_are_found_again)
{
  for(unsigned seed = 0; seed < 12; ++seed)
  {
    Random random(seed);
    Triangulation t = connected_square_tiled(3 + 2 * seed, seed);
    Dual_loops loops(t, CE::internal::homology_basis(t));
    const Turning_targets target{angle_sums(t), turnings(t, loops)};
    for(double turned : target.turning)
      BOOST_TEST(std::abs(turned / (pi / 2) - std::round(turned / (pi / 2))) <= rounded_turning);
    const std::vector<double> u = random_numbers(t.number_of_vertices(), .4, seed);
    for(Index e = 0; e < t.number_of_edges(); ++e)
    {
      const Index h = t.edge_halfedge(e);
      t.set_length(e, t.length(e) * std::exp((u[t.origin(h)] + u[t.target(h)]) / 2 + random(-.2, .2)));
    }
    flip_at_random(t, loops, 3 * t.number_of_edges(), random);
    const Turning_metric found = Turning_newton(t, loops, target, {}).run();
    BOOST_TEST_REQUIRE(bool(found), "seed " << seed << ": residual " << found.residual());
    BOOST_TEST(found.residual() <= solver_tolerance);
    check_equal(angle_sums(found.triangulation), target.angle_sum, 10 * solver_tolerance);
    check_equal(turnings(found.triangulation, found.loops), target.turning, 10 * solver_tolerance);
  }
}

// Loops that are homologous, on the other side of some cones, pose the same equations; so the steps are the same.
BOOST_AUTO_TEST_CASE(another_basis_gives_the_same_metric)
{
  Triangulation t = connected_square_tiled(15, 7);
  const std::vector<Loop> basis = CE::internal::homology_basis(t);
  std::vector<Loop> beside;
  for(const Loop& loop : basis)
    beside.push_back(Dual_loops::reduced(t, CE::internal::loop_on_the_left(t, CE::internal::chain_on_the_left(t, loop))));
  BOOST_REQUIRE(std::none_of(beside.begin(), beside.end(), [](const Loop& loop) { return loop.empty(); }));
  const Dual_loops one(t, basis), other(t, beside);
  const Turning_targets target{angle_sums(t), turnings(t, one)}, other_target{target.angle_sum, turnings(t, other)};
  Random random(2);
  for(Index e = 0; e < t.number_of_edges(); ++e)
    t.set_length(e, t.length(e) * random(.8, 1.2));
  const Turning_metric a = Turning_newton(t, one, target, {}).run(), b = Turning_newton(t, other, other_target, {}).run();
  BOOST_REQUIRE((bool(a) && bool(b)));
  // in the numbers of edges, if ties were not decided differently
  const auto length_of = [](const Turning_metric& m)
    { return std::accumulate(m.triangulation.lengths().begin(), m.triangulation.lengths().end(), 0.); };
  BOOST_TEST(length_of(a) == length_of(b), boost::test_tools::tolerance(1e-9));
}

namespace {

// With eight cones for each handle, which place themselves.
Coned placed(const Triangulation& t)
{
  const auto placement = CE::place_cones(t, params::number_of_cones(8 * genus(t)).angle_quantum(pi / 2));
  BOOST_REQUIRE(bool(placement));
  std::vector<std::pair<Index, long> > cones;
  for(std::size_t i = 0; i < placement.cones.size(); ++i)
    cones.push_back({placement.cones[i], long(placement.angles[i].units / (Angle::units_of_pi / 2))});
  return coned(t, cones);
}

} // namespace

// Long thin handles, sharp triangles, and a metric on a triangulation that is not Delaunay, on which it is another one.
BOOST_AUTO_TEST_CASE(handles_turn_in_a_few_steps)
{
  const std::size_t few = 12; // five to nine, and some more where rounding decides for other flips
  for(const char* name : {"knot.off", "mpi_triang.off", "pinion.off", "joint.off"})
  {
    const Coned c = placed(CE::import_mesh(read_mesh(name)).triangulation);
    const std::vector<Prescribed_turning> none;
    const Handle_turner turner(c.t, c.metric, c.conditions, c.cones, 4, none, CE::Solver_options());
    CE::internal::Turned_handles handles = turner.choose();
    BOOST_TEST_REQUIRE(bool(handles), name);
    const auto metric = turner.turn(handles);
    BOOST_TEST_REQUIRE(bool(metric), name << ": " << CE::message(metric.status));
    BOOST_TEST(handles.number_of_steps <= few, name << ": " << handles.number_of_steps << " steps");
    BOOST_TEST(handles.is_nearest, name);
    const Triangulation flat = CE::internal::scaled_triangulation(metric);
    check_equal(angle_sums(flat), angle_sums_of(c), 1e-9); // of lengths that are rounded, of triangles that may be sharp
    Dual_loops loops(c.t, handles.loops);
    CE::internal::carry_through_flips(metric.flips, c.t, loops);
    for(double turned : turnings(flat, loops))
      BOOST_TEST(std::abs(turned / (pi / 2) - std::round(turned / (pi / 2))) <= 1e-9, name);
  }
}

// A tube around which everything turns by a right angle more is a cone, whose ends differ by a large factor.
BOOST_AUTO_TEST_CASE(thin_tubes_turn_by_right_angles)
{
  const Coned c = placed(CE::import_mesh(read_mesh("pipe.off")).triangulation);
  const std::vector<Prescribed_turning> none;
  const Handle_turner turner(c.t, c.metric, c.conditions, c.cones, 4, none, CE::Solver_options());
  const CE::internal::Turned_handles chosen = turner.choose();
  BOOST_TEST_REQUIRE(bool(chosen));
  const std::vector<std::array<long, 2> > turns = {{{1, 0}}, {{0, 1}}, {{-1, 0}}, {{0, -1}}};
  for(const auto& turn : cases(turns))
  {
    CE::internal::Turned_handles handles = chosen;
    handles.others.clear();
    for(std::size_t k = 0; k < 2; ++k)
      handles.quanta[k] += turn[k];
    const auto metric = turner.turn(handles);
    BOOST_TEST_REQUIRE(bool(metric), turn[0] << " and " << turn[1] << ": " << CE::message(metric.status));
    BOOST_TEST(handles.residual <= 1e-9); // of lengths that are rounded, of triangles that may be sharp
    BOOST_TEST(handles.mean_departure > 0);
  }
}

// ---- What exists

BOOST_AUTO_TEST_CASE(existence_is_decided_first)
{
  const auto existence = [](std::size_t genus, std::vector<long> cones, std::vector<long> loops, long n = 4)
    { return CE::internal::existence(Seamless_signature{genus, n, std::move(cones), std::move(loops)}); };
  // tori
  BOOST_TEST((existence(1, {}, {0, 0}) == Existence::PROVEN));
  BOOST_TEST((existence(1, {}, {0, 4}) == Existence::PROVEN));
  BOOST_TEST((existence(1, {}, {1, 0}) == Existence::IMPOSSIBLE));
  BOOST_TEST((existence(1, {3, 5}, {0, 0}) == Existence::IMPOSSIBLE));
  BOOST_TEST((existence(1, {3, 5}, {1, 2}) == Existence::IMPOSSIBLE));
  BOOST_TEST((existence(1, {5, 4, 3}, {1, 2}) == Existence::IMPOSSIBLE)); // 2 pi is no cone
  BOOST_TEST((existence(1, {2, 6}, {0, 2}) == Existence::IMPOSSIBLE));
  BOOST_TEST((existence(1, {2, 6}, {1, 2}) == Existence::PROVEN));
  BOOST_TEST((existence(1, {1, 7}, {0, 0}) == Existence::PROVEN));
  BOOST_TEST((existence(1, {3, 3, 6}, {0, 0}) == Existence::PROVEN));
  BOOST_TEST((existence(1, {2, 4}, {0, 0}, 3) == Existence::IMPOSSIBLE));
  BOOST_TEST((existence(1, {5, 7}, {0, 0}, 6) == Existence::IMPOSSIBLE)); // no triangulation with one vertex of degree 5, one of 7
  // genus 2
  BOOST_TEST((existence(2, {12}, {0, 0, 0, 0}) == Existence::PROVEN));
  BOOST_TEST((existence(2, {12}, {0, 2, 0, 0}) == Existence::IMPOSSIBLE));
  BOOST_TEST((existence(2, {12}, {0, 1, 0, 0}) == Existence::EXPECTED));
  BOOST_TEST((existence(2, {6, 10}, {0, 2, 0, 0}) == Existence::IMPOSSIBLE));
  BOOST_TEST((existence(2, {6, 10}, {1, 2, 0, 0}) == Existence::EXPECTED));
  BOOST_TEST((existence(2, {8, 8}, {0, 2, 0, 0}) == Existence::PROVEN));
  BOOST_TEST((existence(3, {20}, {2, 0, 0, 0, 0, 0}) == Existence::PROVEN));
}

BOOST_AUTO_TEST_CASE(what_does_not_exist_is_refused_at_once)
{
  const Triangulation t = triangulation(torus(16, 10));
  std::vector<Prescribed_turning> prescribed;
  for(const Loop& loop : CE::internal::homology_basis(t))
    prescribed.push_back({CE::internal::chain_on_the_left(t, loop), 0});

  const Coned flat = coned(t, {});
  BOOST_TEST(bool(choose(flat, prescribed)));
  prescribed[0].quanta = 1;
  const auto turned = choose(flat, prescribed);
  BOOST_TEST((turned.status == CE::Status::NOT_REALIZABLE));
  BOOST_TEST((turned.existence == Existence::IMPOSSIBLE));
  BOOST_TEST(!turned.edges.empty());

  const auto five_and_seven = choose(coned(t, {{5, 3}, {90, 5}}), {});
  BOOST_TEST((five_and_seven.status == CE::Status::NOT_REALIZABLE));
  BOOST_TEST(five_and_seven.vertices == (std::vector<Index>{5, 90}), boost::test_tools::per_element());

  // with all loops even there is none; left to itself, one turns by a right angle
  const Coned even = coned(t, {{5, 2}, {90, 6}});
  const auto chosen = choose(even, {});
  BOOST_REQUIRE(bool(chosen));
  BOOST_TEST((chosen.quanta[0] % 2 != 0 || chosen.quanta[1] % 2 != 0));
  prescribed[0].quanta = 0;
  BOOST_TEST((choose(even, prescribed).status == CE::Status::NOT_REALIZABLE));
  prescribed[0].quanta = 1;
  const auto odd = choose(even, prescribed);
  BOOST_TEST(bool(odd));

  prescribed[0].chain.pop_back(); // no loop any more
  BOOST_TEST((choose(even, prescribed).status == CE::Status::NOT_REALIZABLE));
}

BOOST_AUTO_TEST_CASE(one_cone_on_two_handles)
{
  // three squares in an L: one cone of 6 pi, and nothing turns
  for(unsigned seed = 0; seed < 400; ++seed)
  {
    const Triangulation t = square_tiled(3, seed);
    const auto pieces = CE::connected_components(t);
    if(pieces.components.size() != 1 || pieces.components[0].genus() != 2)
      continue;
    const std::vector<double> sum = angle_sums(t);
    const auto cone = std::find_if(sum.begin(), sum.end(), [](double x) { return std::abs(x - 6 * pi) < 1e-6; });
    if(cone == sum.end())
      continue;
    const auto loops = CE::internal::homology_basis(t);
    std::vector<long> quanta;
    for(double turned : turnings(t, Dual_loops(t, loops)))
      quanta.push_back(std::lround(turned / (pi / 2)));
    const Seamless_signature signature{2, 4, {12}, quanta};
    BOOST_TEST((CE::internal::existence(signature) != Existence::IMPOSSIBLE)); // there it is
    BOOST_TEST(signature.order() != 2);
  }
}

// ---- The door

namespace {

struct Result
{
  Mesh sm;
  Mesh::Property_map<Halfedge, Point_2> uv;
  Report report;

  explicit Result(Mesh mesh) : sm(std::move(mesh)), uv(sm.add_property_map<Halfedge, Point_2>("h:uv", Point_2(7, 7)).first) {}

  template <typename NamedParameters>
  void operator()(const NamedParameters& np) { report = CE::compute_seamless_parameterization(sm, uv, np); }
};

// Each seam edge is moved to its other side by the motion that is reported, in lattice coordinates, without any rounding; all triangles are positive.
void check_seamless(const Result& r, int n)
{
  BOOST_TEST_REQUIRE(bool(r.report), CE::message(r.report));
  const auto moved = [&](Point_2 p, int quanta, const std::array<std::int64_t, 2>& by)
  {
    for(int k = quanta * ((n % 3 == 0 ? 6 : 4) / n); k > 0; --k)
      p = Point_2(-p.y(), n % 3 == 0 ? p.x() + p.y() : p.x());
    return Point_2(p.x() + double(by[0]), p.y() + double(by[1]));
  };
  std::size_t number_of_wrong = 0;
  std::set<Edge> seen;
  for(const auto& t : r.report.transitions)
  {
    const Halfedge h = t.halfedge, g = r.sm.opposite(h);
    seen.insert(r.sm.edge(h));
    number_of_wrong += moved(r.uv[h], t.quanta, t.lattice_translation) != r.uv[r.sm.prev(g)] ? 1 : 0;
    number_of_wrong += moved(r.uv[r.sm.prev(h)], t.quanta, t.lattice_translation) != r.uv[g] ? 1 : 0;
  }
  for(Edge e : r.sm.edges())
    if(seen.count(e) == 0 && !r.sm.is_border(e))
      number_of_wrong += r.uv[r.sm.halfedge(e)] != r.uv[r.sm.prev(r.sm.opposite(r.sm.halfedge(e)))] ? 1 : 0;
  BOOST_TEST(number_of_wrong == 0u);
  const auto verdict = CE::verify_layout(r.sm, r.uv);
  BOOST_TEST(verdict.number_of_flipped_triangles == 0u);
  BOOST_TEST(verdict.number_of_degenerate_triangles == 0u);
  BOOST_TEST(r.report.handles.residual <= 1e-9);
}

} // namespace

BOOST_AUTO_TEST_CASE(handles_turn_by_multiples)
{
  for(int n : {2, 3, 4, 6})
  {
    Result r(surface_mesh<Mesh>(torus(30, 16)));
    r(params::number_of_cones(8).angle_quantum(2 * pi / n).number_of_tiles(2000).seamless_coordinates(CE::Seamless_coordinates::LATTICE));
    check_seamless(r, n);
    BOOST_TEST(r.report.handles.loops.size() == 2u);
  }
  Result eight(read_mesh("eight.off"));
  eight(params::number_of_cones(16).number_of_tiles(3000));
  check_seamless(eight, 4);
  BOOST_TEST(eight.report.handles.loops.size() == 4u);
  BOOST_TEST(eight.report.handles.mean_departure > 0);
  BOOST_TEST(eight.report.handles.mean_departure <= eight.report.handles.maximum_departure);
  BOOST_TEST(eight.report.handles.number_of_steps > 0u);
}

// ---- Borders

namespace {
// The loops that are reported turn by what the seams that they cross make of it.
void check_loops(const Result& r)
{
  const int n = r.report.tiling.symmetry;
  std::vector<int> turn(r.sm.num_halfedges(), 0);
  for(const auto& t : r.report.transitions)
  {
    turn[t.halfedge] = t.quanta;
    turn[r.sm.opposite(t.halfedge)] = -t.quanta;
  }
  for(const auto& loop : r.report.handles.loops)
  {
    long sum = loop.quanta;
    for(Halfedge h : loop.halfedges)
      sum += turn[r.sm.opposite(h)]; // out of the face on the other side
    BOOST_TEST(sum % n == 0);
  }
}

} // namespace

// A basis has 2 g + b - 1 loops, and flips that leave the surface as it is leave their turnings.
BOOST_AUTO_TEST_CASE(loops_of_surfaces_with_borders)
{
  const Mesh whole = surface_mesh<Mesh>(torus(14, 9));
  const std::vector<std::vector<Index> > holes = {{}, {0}, {0, 40}, {0, 40, 70}};
  for(const auto& vertices : holes)
  {
    Triangulation t = CE::import_mesh(punctured(whole, vertices)).triangulation;
    Dual_loops loops(t, CE::internal::homology_basis(t));
    BOOST_TEST(loops.size() == (vertices.empty() ? 2 : vertices.size() + 1));
    for(std::size_t i = 0; i < loops.size(); ++i)
      BOOST_TEST(CE::internal::is_dual_loop(t, loops.loop(i)));
    const std::vector<double> before = turnings(t, loops);
    Loop broken;
    BOOST_REQUIRE(CE::internal::make_intrinsic_delaunay(t, broken, [&](Index e) { loops.flip(t, e); }));
    check_equal(turnings(t, loops), before, rounded_turning);
  }
}

BOOST_AUTO_TEST_CASE(handles_and_borders_turn_by_multiples)
{
  for(int n : {4, 6})
  {
    Result r(punctured(surface_mesh<Mesh>(torus(30, 16)), {0, 250}));
    r(params::number_of_cones(8).angle_quantum(2 * pi / n).number_of_tiles(2000).seamless_coordinates(CE::Seamless_coordinates::LATTICE));
    check_seamless(r, n);
    check_loops(r);
    BOOST_TEST(r.report.handles.loops.size() == 3u);
    BOOST_TEST((r.report.handles.existence == Existence::EXPECTED));
  }
  Soup bent = annulus(6, 40, 0.4); // with natural borders it turns by some angle
  for(Point& p : bent.points)
    p[2] += 0.3 * p[0] * p[0];
  Result r(surface_mesh<Mesh>(bent));
  r(params::number_of_tiles(100));
  check_seamless(r, 4);
  check_loops(r);
  BOOST_TEST_REQUIRE(r.report.handles.loops.size() == 1u);
  const double quarters = r.report.handles.loops[0].conformal_turning / (pi / 2);
  BOOST_TEST(std::abs(quarters - std::round(quarters)) > 1e-6); // far more than rounding
  BOOST_TEST(r.report.handles.loops[0].quanta == std::lround(quarters));
}

// Whenever it is stopped, it says so, and writes nothing; what is told goes on from stage to stage.
BOOST_AUTO_TEST_CASE(a_seamless_parameterization_can_be_stopped)
{
  struct Visitor
  {
    std::size_t questions = 0, allowed = 0, choices = 0, steps = 0;
    std::vector<CE::Stage> stages;

    void on_stage(CE::Stage stage) { stages.push_back(stage); }
    void on_iteration(std::size_t, double residual)
    {
      ++steps;
      BOOST_TEST(residual >= 0);
    }
    void on_progress(CE::Stage stage, std::size_t number, double measure)
    {
      if(stage != CE::Stage::POSITIONS)
        return;
      BOOST_TEST(number == ++choices);
      BOOST_TEST(measure > 0);
    }
    bool go_further() { return questions++ < allowed; }
  };
  const Mesh eight = read_mesh("eight.off");
  Visitor patient;
  patient.allowed = std::numeric_limits<std::size_t>::max();
  Result whole(eight);
  whole(params::number_of_cones(16).number_of_tiles(3000).visitor(std::ref(patient)));
  check_seamless(whole, 4);
  BOOST_TEST(patient.choices > 0u);
  BOOST_TEST((patient.stages.back() == CE::Stage::POSITIONS));
  BOOST_TEST(patient.steps > whole.report.handles.number_of_steps);

  for(std::size_t part = 0; part < 12; ++part)
  {
    Visitor visitor;
    // the last questions are those of the choice of lattice points
    visitor.allowed = part < 6 ? patient.questions * part / 6 : patient.questions - 1 - (part - 6);
    Result r(eight);
    r(params::number_of_cones(16).number_of_tiles(3000).visitor(std::ref(visitor)));
    if(bool(r.report)) // what was found by then is kept without a proof
      check_seamless(r, 4);
    else
    {
      BOOST_TEST((r.report.status == CE::Status::STOPPED_BY_VISITOR), CE::message(r.report));
      BOOST_TEST((r.uv[*r.sm.halfedges().begin()] == Point_2(7, 7)));
    }
    if(visitor.choices > 0)
      BOOST_TEST(r.report.handles.loops.size() == 4u); // nothing is lost of what was found before
  }
}

// The joint has sharp edges and few triangles, and edges are flipped: whether or not straight triangles can be laid out, their parts are.
BOOST_AUTO_TEST_CASE(parts_are_laid_out_whatever_becomes_of_triangles)
{
  const Mesh joint = read_mesh("joint.off");
  const auto np = params::number_of_cones(16).number_of_tiles(20000);
  Result straight(joint);
  straight(np);
  BOOST_TEST((bool(straight.report) || straight.report.status == CE::Status::NOT_INJECTIVE), CE::message(straight.report));
  BOOST_TEST(straight.report.statistics.number_of_flips > 0u);

  Mesh refined;
  auto uv = refined.add_property_map<Halfedge, Point_2>("h:uv").first;
  auto input_face = refined.add_property_map<Face, Face>("f:input_face").first;
  const Report report = CE::compute_refined_seamless_parameterization(joint, refined, uv, np, params::input_face_map(input_face));
  BOOST_TEST_REQUIRE(bool(report), CE::message(report));
  const auto verdict = CE::verify_layout(refined, uv);
  BOOST_TEST(verdict.number_of_flipped_triangles == 0u);
  BOOST_TEST(verdict.number_of_degenerate_triangles == 0u);
  BOOST_TEST(refined.number_of_vertices() > joint.number_of_vertices());

  // Along the seam, the parts of the edge h are moved to their other sides by the motion of h.
  std::map<Halfedge, std::pair<int, std::array<std::int64_t, 2> > > motion;
  for(const auto& t : report.transitions)
    motion[t.halfedge] = {t.quanta, t.lattice_translation};
  std::size_t number_on_seam = 0, number_of_wrong = 0;
  for(Halfedge h : refined.halfedges())
  {
    const Halfedge g = refined.opposite(h);
    if(uv[h] == uv[refined.prev(g)] && uv[g] == uv[refined.prev(h)])
      continue;
    ++number_on_seam;
    const Face f = input_face[refined.face(h)], other = input_face[refined.face(g)];
    bool is_moved = false;
    for(Halfedge i : joint.halfedges_around_face(joint.halfedge(f)))
      if(joint.face(joint.opposite(i)) == other && motion.count(i) != 0)
      {
        Point_2 p = uv[h], q = uv[refined.prev(h)];
        for(int k = motion[i].first; k > 0; --k)
          p = Point_2(-p.y(), p.x()), q = Point_2(-q.y(), q.x());
        const auto& by = motion[i].second;
        is_moved = is_moved || (Point_2(p.x() + double(by[0]), p.y() + double(by[1])) == uv[refined.prev(g)]
                             && Point_2(q.x() + double(by[0]), q.y() + double(by[1])) == uv[g]);
      }
    number_of_wrong += is_moved || motion.empty() ? 0 : 1;
  }
  BOOST_TEST(number_on_seam > 0u);
  // each part is met from both sides, and its edge has a motion in one direction
  BOOST_TEST(2 * number_of_wrong == number_on_seam);
}

BOOST_AUTO_TEST_CASE(a_flat_torus_stays_conformal)
{
  Result r(surface_mesh<Mesh>(torus(24, 12)));
  r(params::number_of_tiles(100));
  check_seamless(r, 4);
  BOOST_TEST(r.report.handles.number_of_steps == 0u);
  BOOST_TEST(r.report.handles.mean_departure == 0);
}

namespace {

// A closed curve along edges: straight ahead, three edges to the right at each vertex, of six.
CE::Loop_turning<Mesh> straight_loop(const Mesh& sm)
{
  CE::Loop_turning<Mesh> result;
  const Halfedge first = sm.halfedge(Vertex(0));
  Halfedge h = first;
  do
  {
    result.halfedges.push_back(h);
    h = sm.next(h);
    for(int k = 0; k < 2; ++k)
      h = sm.next(sm.opposite(h));
  }
  while(h != first && result.halfedges.size() < 1000);
  BOOST_REQUIRE(h == first);
  return result;
}

// By how many right angles the curve on the left of the chain turns, modulo 4: by as many as the rotations of the seam edges that it crosses, back.
int quarters_of(const Result& r, const std::vector<Halfedge>& chain)
{
  std::vector<int> turn(r.sm.num_halfedges(), 0);
  for(const auto& t : r.report.transitions)
  {
    turn[t.halfedge] = t.quanta;
    turn[r.sm.opposite(t.halfedge)] = -t.quanta;
  }
  int sum = 0;
  for(std::size_t k = 0; k < chain.size(); ++k)
    for(Halfedge x = r.sm.next(chain[k]); x != chain[(k + 1) % chain.size()]; x = r.sm.next(r.sm.opposite(x)))
      sum += turn[x];
  return ((-sum) % 4 + 4) % 4;
}

} // namespace

// A loop along edges is made to turn as prescribed, modulo 4: as it is chosen to turn otherwise, and, on one side or the other, by one right angle
// more or less.
BOOST_AUTO_TEST_CASE(prescribed_turnings_are_found)
{
  Result r(surface_mesh<Mesh>(torus(30, 20, 1.8, 1)));
  auto angle = r.sm.add_property_map<Vertex, double>("v:angle", 2 * pi).first;
  for(Index i = 0; i < 12; ++i)
    angle[Vertex(37 + 44 * i)] = i % 2 == 0 ? 3 * pi / 2 : 5 * pi / 2;
  std::vector<CE::Loop_turning<Mesh> > loops(1, straight_loop(r.sm));
  const auto np = params::cone_angle_map(angle).number_of_tiles(3000);
  r(np);
  check_seamless(r, 4);
  const int chosen = quarters_of(r, loops[0].halfedges);
  int number_of_found = 0;
  for(int more : {4, 1, -1})
  {
    loops[0].quanta = chosen + more;
    r(np.loop_turnings(loops));
    if(more != 4 && r.report.status == CE::Status::ITERATIONS_EXHAUSTED)
      continue;
    ++number_of_found;
    check_seamless(r, 4);
    BOOST_TEST(quarters_of(r, loops[0].halfedges) == (chosen + more + 4) % 4);
  }
  BOOST_TEST(number_of_found >= 2);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_is_refused_with_a_status)
{
  Result r(surface_mesh<Mesh>(torus(30, 16)));
  auto angle = r.sm.add_property_map<Vertex, double>("v:angle", 2 * pi).first;
  angle[Vertex(3)] = 3 * pi / 2;
  angle[Vertex(200)] = 5 * pi / 2;
  r(params::cone_angle_map(angle));
  BOOST_TEST((r.report.status == CE::Status::NOT_REALIZABLE));
  BOOST_TEST(r.report.vertex_indices == (std::vector<std::size_t>{3, 200}), boost::test_tools::per_element());
  BOOST_TEST(r.uv[Halfedge(0)] == Point_2(7, 7)); // nothing was written

  Result open(surface_mesh<Mesh>(annulus(12, 4)));
  open(params::loop_turnings(std::vector<CE::Loop_turning<Mesh> >(1)));
  BOOST_TEST((open.report.status == CE::Status::WRONG_TOPOLOGY));

  Result none(surface_mesh<Mesh>(torus(12, 8)));
  none(params::loop_turnings(std::vector<CE::Loop_turning<Mesh> >(1))); // no halfedges
  BOOST_TEST((none.report.status == CE::Status::NOT_REALIZABLE));
}
