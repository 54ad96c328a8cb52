// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Metrics with flips under conditions that are as hard as can be, all seeded:
//
//   robustness --header
//   robustness GROUP [MODE]
//   robustness GROUP MODE CASE
//   robustness --list
//   robustness --flip-cost
//
// The first prints the head of a Markdown table, the second a row for each mode (`when-needed` and `always`) and, on
// the standard error stream, a line for each failure, which begins with GROUP, MODE and CASE; these run it alone, and print its residuals.
// The fourth prints the names of the groups, the fifth a table of the share of the solve that flips take, for all meshes where less than 5 % of the
// edges are flipped. `meshes` are those of the folder named by CGAL_DATA_DIR; `layouts` are the same,
// laid out with straight images of the triangles given, where success means that none is flipped, too.
//
// A case is a success if the solver says so, no triangle violates its inequality, and the angle sums of the metric, evaluated
// again in `long double`, or if that is not enough with 50 digits, differ from their targets by no more than 1e-12, or the floor of
// rounding that the solver reports. Lengths that violate the triangle inequality must be refused by `always`.

#include "../include/benchmark_meshes.h"
#include "../include/farthest_points.h"
#include "../include/plates.h"

#include <CGAL/Conformal_equivalence/certify.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/compute_cut_graph.h>
#include <CGAL/Conformal_equivalence/discrete_metric.h>
#include <CGAL/Conformal_equivalence/flatten.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/number_type_config.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <iomanip>
#include <iostream>
#include <map>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;
using namespace benchmarks;
using CE::Retriangulation;
using CE::Status;

typedef CE::Intrinsic_triangulation<double>  Triangulation;
typedef CE::Conformal_conditions<double>     Conditions;
typedef CE::Conformal_metric<double>         Metric;
typedef std::uint32_t                        Index;
typedef std::vector<std::string>             Row;

const double pi = CGAL_PI, seconds_allowed = 20; // of one case

// ---- What is solved

struct Problem
{
  Triangulation triangulation;
  Conditions conditions;
};

struct Outcome
{
  bool is_case = true; // and not refused as no surface
  bool is_to_be_refused = false;
  std::size_t vertices = 0, edges = 0;
  Status status = Status::OK;
  double residual = 0; // as evaluated again
  CE::Statistics statistics;
  CE::Layout_certificate certificate;
  std::string text;

  // what conditions miss the Gauss-Bonnet formula by is added to them
  double most() const { return (std::max)(1e-12, statistics.residual_floor) + statistics.angle_defect_spread; }
  bool is_success() const { return !is_to_be_refused && CE::is_success(status) && residual <= most(); }
  bool is_refused_rightly() const { return is_to_be_refused && status == Status::DEGENERATE_METRIC && statistics.number_of_flips == 0; }
};

struct Case
{
  std::string name; // what is needed to make it again
  std::function<Outcome(Retriangulation)> run;
};

// Stops what does not end.
class Deadline : public CE::Default_visitor
{
  std::chrono::steady_clock::time_point end_;

public:
  Deadline() : end_(std::chrono::steady_clock::now() + std::chrono::milliseconds(long(1000 * seconds_allowed))) {}
  bool go_further() { return std::chrono::steady_clock::now() < end_; }
};

// The largest difference of an angle sum from its target.
template <typename NT>
double residual(const Triangulation& t, const Conditions& conditions, const Metric& metric)
{
  using std::abs;
  const Triangulation& final = metric.triangulation;
  std::vector<NT> lengths;
  for(Index e = 0; e < final.number_of_edges(); ++e)
  {
    const auto length = metric.wide_scaled_length(final.edge_halfedge(e));
    lengths.push_back(NT(NT(length.hi) + length.lo));
  }
  const std::vector<NT> sums = CE::angle_sums(final.with_lengths(std::move(lengths)));
  NT result = 0;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
  {
    if(t.is_isolated_vertex(v) || conditions.is_fixed(v))
      continue;
    const int halves = metric.is_doubled && t.is_border_vertex(v) ? 2 : 1;
    result = (std::max)(result, NT(abs(NT(sums[v] - halves * conditions.angle_sum(v).radians<NT>()))));
  }
  return static_cast<double>(result);
}

double measured_residual(const Triangulation& t, const Conditions& conditions, const Metric& metric)
{
  typedef boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off> Precise;
  const double result = residual<long double>(t, conditions, metric);
  return result <= 1e-12 ? result : residual<Precise>(t, conditions, metric);
}

// Do lengths violate the triangle inequality, beyond rounding?
bool has_violations(const Triangulation& t)
{
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    const long double a = t.halfedge_length(h), b = t.halfedge_length(t.next(h)), c = t.halfedge_length(t.previous(h));
    if(a + b - c < -1e-15L * c)
      return true;
  }
  return false;
}

// Is the map to the plane one-to-one around every point that is no cone?
CE::Layout_certificate certify(const Problem& problem, const Metric& metric)
{
  const Triangulation& t = problem.triangulation;
  std::vector<Index> cones;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v) && !t.is_border_vertex(v) && problem.conditions.is_cone(v))
      cones.push_back(v);
  const unsigned int most_bits = 1700;
  return CE::certify_layout(t, metric, CE::compute_cut_graph(t, cones), problem.conditions, most_bits);
}

Outcome solve(const Problem& problem, Retriangulation mode)
{
  Deadline deadline;
  const Metric metric = CE::compute_conformal_metric(problem.triangulation, problem.conditions,
                                                     params::retriangulation(mode).visitor(std::ref(deadline)));
  Outcome result;
  result.is_to_be_refused = mode == Retriangulation::ALWAYS && has_violations(problem.triangulation);
  result.vertices = problem.triangulation.number_of_vertices();
  result.edges = problem.triangulation.number_of_edges();
  result.status = metric.status;
  result.statistics = metric.statistics;
  result.text = message(metric.status);
  result.residual = metric ? measured_residual(problem.triangulation, problem.conditions, metric) : metric.statistics.residual;
  if(metric)
    result.certificate = certify(problem, metric);
  return result;
}

Case make_case(const std::string& name, std::function<Problem()> make)
{
  return {name, [make](Retriangulation mode) { return solve(make(), mode); }};
}

template <typename... Parts>
std::string to_name(const Parts&... parts)
{
  std::ostringstream out;
  (void) std::initializer_list<int>{(out << parts, 0)...};
  return out.str();
}

// ---- Random numbers

double normal(Random_numbers& random)
{
  const double r = std::sqrt(-2 * std::log(1 - random(0, 1)));
  return r * std::cos(random(0, 2 * pi));
}

Index random_index(Random_numbers& random, std::size_t n) { return (std::min)(Index(random(0, double(n))), Index(n - 1)); }

std::vector<Index> random_vertices(Random_numbers& random, std::size_t n, std::size_t most)
{
  std::vector<Index> all(most);
  std::iota(all.begin(), all.end(), Index(0));
  for(std::size_t i = 0; i < n; ++i)
    std::swap(all[i], all[i + random_index(random, most - i)]);
  all.resize(n);
  return all;
}

// ---- Surfaces

Triangulation triangulation(const Mesh& mesh) { return CE::import_mesh(mesh).triangulation; }

// The triangles of the convex hull, in an order that depends on nothing but the points.
template <typename Point>
std::vector<std::array<Index, 3> > hull_triangles(const std::vector<Point>& points)
{
  CGAL::Surface_mesh<Point> hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  std::map<Point, Index> number;
  for(Index i = 0; i < points.size(); ++i)
    number.emplace(points[i], i);
  std::vector<std::array<Index, 3> > triangles;
  for(const auto f : faces(hull))
  {
    std::array<Index, 3> corners;
    auto h = halfedge(f, hull);
    for(Index& corner : corners)
    {
      corner = number.at(hull.point(target(h, hull)));
      h = next(h, hull);
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    triangles.push_back(corners);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

// The convex hull of random points on the sphere.
Triangulation sphere(std::size_t n, unsigned seed)
{
  typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_3 Exact_point;
  Random_numbers random(seed);
  std::vector<Exact_point> points;
  for(std::size_t i = 0; i < n; ++i)
  {
    const double z = random(-1, 1), angle = random(0, 2 * pi), r = std::sqrt(1 - z * z);
    points.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  const std::vector<std::array<Index, 3> > triangles = hull_triangles(points);
  std::vector<Index> origin;
  for(const std::array<Index, 3>& corners : triangles)
    origin.insert(origin.end(), corners.begin(), corners.end());
  Triangulation t(Index(n), std::move(origin), CE::glue_triangles(triangles));
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
    t.set_length(t.edge(h), std::sqrt(CGAL::squared_distance(points[t.origin(h)], points[t.target(h)])));
  return t;
}

// A closed surface of genus g.
Triangulation handles(std::size_t g)
{
  const std::size_t blocks = std::size_t(std::ceil(std::sqrt(double(g))));
  return triangulation(Plate(600 * blocks * blocks, g, true).mesh());
}

// A terrain, drawn out in the direction of `axis`.
Triangulation stretched_terrain(std::size_t n, int axis, double factor)
{
  Mesh mesh = terrain(n);
  for(vertex_descriptor v : vertices(mesh))
  {
    std::array<double, 3> p = {{mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()}};
    p[axis] *= factor;
    mesh.point(v) = Point_3(p[0], p[1], p[2]);
  }
  return triangulation(mesh);
}

// The closed oriented surface of triangles whose sides are glued in pairs drawn at random; it may have several components.
Triangulation random_gluing(std::size_t triangles, Random_numbers& random)
{
  const Index none = Triangulation::null_index;
  const std::vector<Index> order = random_vertices(random, 3 * triangles, 3 * triangles);
  std::vector<Index> twin(3 * triangles), origin(3 * triangles, none);
  for(std::size_t i = 0; i < order.size(); i += 2)
  {
    twin[order[i]] = order[i + 1];
    twin[order[i + 1]] = order[i];
  }
  Index vertices = 0;
  for(Index h = 0; h < origin.size(); ++h)
  {
    if(origin[h] != none)
      continue;
    for(Index g = h; origin[g] == none; g = twin[Triangulation::previous(g)])
      origin[g] = vertices;
    ++vertices;
  }
  return Triangulation(vertices, std::move(origin), std::move(twin));
}

Triangulation connected_random_gluing(std::size_t triangles, bool has_one_vertex, Random_numbers& random)
{
  for(;;)
  {
    Triangulation t = random_gluing(triangles, random);
    if(CE::connected_components(t).components.size() == 1 && (!has_one_vertex || t.number_of_vertices() == 1))
      return t;
  }
}

void flip_at_random(Triangulation& t, std::size_t times, Random_numbers& random)
{
  for(std::size_t i = 0; i < times; ++i)
  {
    const Index e = random_index(random, t.number_of_edges());
    if(t.is_flippable(e))
      t.flip_edge(e, 1);
  }
}

// Lengths that are triangles' if `spread` is zero, any Penner coordinates otherwise.
void set_random_lengths(Triangulation& t, double spread, Random_numbers& random)
{
  for(Index e = 0; e < t.number_of_edges(); ++e)
    t.set_length(e, spread == 0 ? random(1, 1.99) : std::exp(spread * normal(random)));
}

// ---- Conditions

std::ptrdiff_t euler_characteristic(const Triangulation& t)
{
  return CE::connected_components(t).components[0].euler_characteristic();
}

// Curvatures by vertex; they must add up to 2 pi times the Euler characteristic.
Conditions prescribe_curvatures(const Triangulation& t, const std::vector<double>& curvature)
{
  Conditions conditions(t);
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(curvature[v] != 0)
      conditions.prescribe_angle_sum(v, 2 * pi - curvature[v]);
  return conditions;
}

// Angles in random proportions to each other.
Conditions random_angles(const Triangulation& t, double spread, Random_numbers& random)
{
  std::vector<double> angle(t.number_of_vertices());
  for(double& a : angle)
    a = std::exp(spread * normal(random));
  const double factor = pi * t.number_of_faces() / std::accumulate(angle.begin(), angle.end(), 0.);
  Conditions conditions(t);
  for(Index v = 0; v < angle.size(); ++v)
    conditions.prescribe_angle_sum(v, factor * angle[v]);
  return conditions;
}

// All curvature at some vertices: as given at the first of them, the rest evenly at the others.
Conditions few_cones(const Triangulation& t, const std::vector<double>& curvatures, std::size_t others, Random_numbers& random)
{
  const std::vector<Index> vertices = random_vertices(random, curvatures.size() + others, t.number_of_vertices());
  std::vector<double> curvature(t.number_of_vertices(), 0);
  double left = 2 * pi * double(euler_characteristic(t));
  for(std::size_t i = 0; i < vertices.size(); ++i)
  {
    const double k = i < curvatures.size() ? curvatures[i] : left / double(vertices.size() - i);
    curvature[vertices[i]] = k;
    left -= k;
  }
  return prescribe_curvatures(t, curvature);
}

// The curvature that the surface has, a share of it moved to one vertex.
Conditions move_curvature(const Triangulation& t, double share, Random_numbers& random)
{
  const double all = 2 * pi * double(euler_characteristic(t)), moved = share * (all > 0 ? 2 * pi : all);
  std::vector<double> curvature = CE::angle_sums(t);
  for(double& k : curvature)
    k = (1 - moved / all) * (2 * pi - k);
  curvature[random_index(random, curvature.size())] += moved;
  return prescribe_curvatures(t, curvature);
}

// Turning angles of the one border, which is flat inside, drawn from (-most, most).
Conditions random_border(const Triangulation& t, double most, Random_numbers& random)
{
  std::vector<Index> border;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(t.is_border_vertex(v))
      border.push_back(v);
  std::vector<double> turning(border.size());
  for(;;)
  {
    for(double& k : turning)
      k = random(-most, most);
    const double defect = (2 * pi - std::accumulate(turning.begin(), turning.end(), 0.)) / double(turning.size());
    for(double& k : turning)
      k += defect;
    const auto range = std::minmax_element(turning.begin(), turning.end());
    if(*range.first > -pi && *range.second < pi)
      break;
  }
  Conditions conditions(t);
  for(std::size_t i = 0; i < border.size(); ++i)
    conditions.prescribe_angle_sum(border[i], pi - turning[i]);
  return conditions;
}

// ---- Groups

std::vector<Case> random_curvatures(std::size_t n, const std::vector<double>& spreads, unsigned seeds)
{
  std::vector<Case> cases;
  for(double spread : spreads)
    for(unsigned seed = 1; seed <= seeds; ++seed)
      cases.push_back(make_case(to_name("spread ", spread, ", seed ", seed), [=]
      {
        Random_numbers random(1000 + seed);
        const Triangulation t = sphere(n, seed);
        return Problem{t, random_angles(t, spread, random)};
      }));
  return cases;
}

// One cone with all curvature; a torus has none, or as much positive as negative.
std::vector<Case> one_cone()
{
  std::vector<Case> cases;
  for(double curvature : { 0., .5, 1., 1.9, 1.99 })
    for(unsigned seed = 1; seed <= 2; ++seed)
      cases.push_back(make_case(to_name("genus 1, cones of +-", curvature, " pi, seed ", seed), [=]
      {
        Random_numbers random(seed);
        const Triangulation t = handles(1);
        return Problem{t, few_cones(t, {curvature * pi, -curvature * pi}, 0, random)};
      }));
  for(std::size_t genus = 2; genus <= 13; ++genus)
    for(unsigned seed = 1; seed <= 2; ++seed)
      cases.push_back(make_case(to_name("genus ", genus, ", seed ", seed), [=]
      {
        Random_numbers random(seed);
        const Triangulation t = handles(genus);
        return Problem{t, few_cones(t, {}, 1, random)};
      }));
  return cases;
}

std::vector<Case> moved_curvature()
{
  std::vector<Case> cases;
  for(std::size_t genus : { 0, 1, 3 })
    for(double percent : { 1., 10., 25., 50., 75., 90., 99. })
      for(unsigned seed = 1; genus != 1 && seed <= 3; ++seed)
        cases.push_back(make_case(to_name("genus ", genus, ", ", percent, " %, seed ", seed), [=]
        {
          Random_numbers random(seed);
          const Triangulation t = genus == 0 ? sphere(1000, seed) : handles(genus);
          return Problem{t, move_curvature(t, percent / 100, random)};
        }));
  return cases;
}

std::vector<Case> borders()
{
  std::vector<Case> cases;
  for(std::size_t n : { 100, 1000 })
    for(double most : { .1, .3, .6, .9 })
      for(unsigned seed = 1; seed <= 3; ++seed)
        cases.push_back(make_case(to_name(n, " vertices, up to ", most, " pi, seed ", seed), [=]
        {
          Random_numbers random(seed);
          const Triangulation t = triangulation(terrain(n));
          return Problem{t, random_border(t, most * pi, random)};
        }));
  return cases;
}

std::vector<Case> extreme_cones()
{
  std::vector<Case> cases;
  const auto add = [&](const std::string& name, std::size_t genus, const std::vector<double>& curvatures, std::size_t others)
  {
    for(unsigned seed = 1; seed <= 3; ++seed)
      cases.push_back(make_case(to_name(name, ", genus ", genus, ", seed ", seed), [=]
      {
        Random_numbers random(seed);
        const Triangulation t = genus == 0 ? sphere(1000, seed) : handles(genus);
        return Problem{t, few_cones(t, curvatures, others, random)};
      }));
  };
  for(double angle : { 1e-1, 1e-2, 1e-3, 1e-4 })
    add(to_name("an angle of ", angle), 0, {2 * pi - angle}, 3);
  for(double angle : { 1e-1, 1e-2, 1e-3 })
  {
    add(to_name("two angles of ", angle), 0, {2 * pi - angle, 2 * pi - angle}, 3);
    add(to_name("an angle of ", angle), 1, {2 * pi - angle}, 3);
  }
  for(double angle : { 10., 20., 40. })
  {
    add(to_name("an angle of ", angle, " pi"), 0, {(2 - angle) * pi}, 30);
    add(to_name("an angle of ", angle, " pi"), 1, {(2 - angle) * pi}, 30);
  }
  return cases;
}

std::vector<Case> stretched()
{
  std::vector<Case> cases;
  for(int axis : { 0, 2 })
    for(int exponent = 0; exponent <= 8; ++exponent)
      cases.push_back(make_case(to_name(axis == 0 ? "x" : "z", " times 1e", exponent), [=]
      {
        const Triangulation t = stretched_terrain(2500, axis, std::pow(10., exponent));
        return Problem{t, Conditions(t)};
      }));
  return cases;
}

// Random gluings, also with one vertex; and spheres and surfaces with handles after random flips.
std::vector<Case> delta_complexes()
{
  std::vector<Case> cases;
  for(double spread : { 0., .3, 1., 3. })
    for(unsigned seed = 1; seed <= 10; ++seed)
    {
      for(bool has_one_vertex : { false, true })
        for(std::size_t triangles : { 10, 100 })
          if(!has_one_vertex || triangles == 10)
            cases.push_back(make_case(to_name(triangles, " triangles", has_one_vertex ? ", one vertex" : "", ", lengths ", spread,
                                              ", seed ", seed), [=]
            {
              Random_numbers random(seed);
              Triangulation t = connected_random_gluing(triangles, has_one_vertex, random);
              set_random_lengths(t, spread, random);
              return Problem{t, random_angles(t, .5, random)};
            }));
      if(seed <= 2)
        for(std::size_t genus : { 0, 2 })
          cases.push_back(make_case(to_name("flipped, genus ", genus, ", lengths ", spread, ", seed ", seed), [=]
          {
            Random_numbers random(seed);
            Triangulation t = genus == 0 ? sphere(200, seed) : handles(genus);
            flip_at_random(t, 10 * t.number_of_edges(), random);
            set_random_lengths(t, spread, random);
            return Problem{t, random_angles(t, .5, random)};
          }));
    }
  return cases;
}

// ---- Meshes

// Closed components, but for tori, have eight cones of equal angle that are far from each other, or as many as vertices.
template <typename Angle_map>
void place_cones(const Mesh& mesh, Angle_map angle)
{
  const auto imported = CE::import_mesh(mesh);
  const Triangulation& t = imported.triangulation;
  if(!CE::is_success(imported.status))
    return;
  for(const auto& component : CE::connected_components(t).components)
  {
    if(component.number_of_borders > 0 || component.is_torus())
      continue;
    const std::vector<Index> cones = farthest_points(t, 8, t.origin(3 * component.first_face), [](Index) { return true; });
    for(Index v : cones)
      put(angle, vertex_descriptor(v), 2 * pi * (1 - double(component.euler_characteristic()) / double(cones.size())));
  }
}

bool read(const std::string& file, Mesh& mesh)
{
  return CGAL::IO::read_polygon_mesh(file, mesh) && num_faces(mesh) > 0
      && (CGAL::is_triangle_mesh(mesh) || CGAL::Polygon_mesh_processing::triangulate_faces(mesh));
}

// The metric, and, if it is to be laid out, straight images of the triangles given.
Outcome solve_file(const std::string& file, bool is_laid_out, Retriangulation mode)
{
  Outcome result;
  Mesh mesh;
  result.is_case = read(file, mesh);
  if(!result.is_case)
    return result;
  const auto uv = mesh.add_property_map<halfedge_descriptor, Point_2>("h:uv", Point_2(0, 0)).first;
  const auto angle = mesh.add_property_map<vertex_descriptor, double>("v:angle", 2 * pi).first;
  place_cones(mesh, angle);
  const auto imported = CE::import_mesh(mesh);
  result.is_case = CE::is_success(imported.status);
  if(!result.is_case)
    return result;
  if(!is_laid_out)
  {
    Problem problem = { imported.triangulation, Conditions(imported.triangulation) };
    for(vertex_descriptor v : vertices(mesh))
      if(get(angle, v) != 2 * pi)
        problem.conditions.prescribe_angle_sum(Index(v), get(angle, v));
    return solve(problem, mode);
  }
  Deadline deadline;
  const auto report = CE::flatten(mesh, uv, params::retriangulation(mode).cone_angle_map(angle).visitor(std::ref(deadline)));
  result.status = report.status;
  result.statistics = report.statistics;
  result.residual = report.statistics.residual;
  result.text = message(report);
  return result;
}

std::vector<Case> meshes(bool are_laid_out)
{
  namespace fs = std::filesystem;
  const char* const folder = std::getenv("CGAL_DATA_DIR");
  if(folder == nullptr)
    throw std::runtime_error("CGAL_DATA_DIR is not set");
  std::vector<std::string> files;
  for(const fs::directory_entry& entry : fs::directory_iterator(fs::path(folder) / "meshes"))
    if(entry.path().extension() == ".off")
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  std::vector<Case> cases;
  for(const std::string& file : files)
    cases.push_back({fs::path(file).stem().string(), [=](Retriangulation mode) { return solve_file(file, are_laid_out, mode); }});
  return cases;
}

struct Group
{
  std::string name, title;
  std::function<std::vector<Case>()> cases;
};

const std::vector<Group>& groups()
{
  static const std::vector<Group> result = {
    { "curvatures-1000", "random angles, spheres of 1 000", [] { return random_curvatures(1000, {.2, .5, 1, 2}, 5); } },
    { "curvatures-10000", "random angles, spheres of 10 000", [] { return random_curvatures(10000, {.2, .5, 1}, 1); } },
    { "one-cone", "one cone, genus 1 to 13", one_cone },
    { "moved", "curvature moved to one vertex", moved_curvature },
    { "borders", "random border angles", borders },
    { "cones", "extreme cones", extreme_cones },
    { "stretched", "stretched terrain", stretched },
    { "complexes", "random Delta-complexes", delta_complexes },
    { "meshes", "meshes", [] { return meshes(false); } },
    { "layouts", "meshes, laid out", [] { return meshes(true); } } };
  return result;
}

const Group& find_group(const std::string& name)
{
  for(const Group& group : groups())
    if(group.name == name)
      return group;
  throw std::runtime_error("there is no group " + name);
}

// ---- Tables

const Row columns = { "group", "mode", "cases", "refused", "success", "flips: median", "max", "Newton steps: median", "max",
                      "discarded: median", "max", "seconds", "longest", "worst residual", "floor",
                      "Delaunay: exact", "within bounds", "no", "certified", "most bits", "lost in double" };

void print_row(const Row& cells)
{
  for(const std::string& cell : cells)
    std::cout << "| " << cell << ' ';
  std::cout << '|' << std::endl;
}

template <typename Number>
std::string to_text(Number x)
{
  std::ostringstream out;
  out << std::setprecision(2) << x;
  return out.str();
}

std::string seconds_to_text(double seconds)
{
  std::ostringstream out;
  out << std::fixed << std::setprecision(2) << seconds;
  return out.str();
}

const char* to_text(Retriangulation mode) { return mode == Retriangulation::ALWAYS ? "always" : "when-needed"; }

// Median and largest.
void add_distribution(std::vector<std::size_t> values, Row& row)
{
  std::sort(values.begin(), values.end());
  row.push_back(values.empty() ? "" : std::to_string(values[values.size() / 2]));
  row.push_back(values.empty() ? "" : std::to_string(values.back()));
}

double seconds_of(const CE::Statistics& s)
{
  return s.seconds.import + s.seconds.solve + s.seconds.cut + s.seconds.layout + s.seconds.verify;
}

// One row; where the solver failed, residual and floor are not part of it.
Row row_of(const Group& group, Retriangulation mode, const std::vector<Outcome>& outcomes)
{
  std::vector<std::size_t> flips, steps, discarded;
  std::size_t successes = 0, refused = 0, delaunay[4] = { 0, 0, 0, 0 }, certified = 0, lost = 0;
  unsigned int bits = 0;
  double seconds = 0, longest = 0, residual = 0, floor = 0;
  for(const Outcome& outcome : outcomes)
  {
    const CE::Statistics& s = outcome.statistics;
    seconds += seconds_of(s);
    longest = (std::max)(longest, seconds_of(s));
    refused += outcome.is_refused_rightly();
    if(!outcome.is_success())
      continue;
    ++successes;
    flips.push_back(s.number_of_flips);
    steps.push_back(s.number_of_iterations);
    discarded.push_back(s.number_of_discarded_iterations);
    ++delaunay[std::size_t(s.delaunay)];
    certified += bool(outcome.certificate);
    bits = (std::max)(bits, outcome.certificate.precision_in_bits);
    lost += outcome.certificate.number_of_faces_lost_in_double != 0;
    residual = (std::max)(residual, outcome.residual);
    floor = (std::max)(floor, s.residual_floor);
  }
  Row row = { group.title, to_text(mode), std::to_string(outcomes.size()), refused == 0 ? "" : std::to_string(refused),
          std::to_string(successes) };
  add_distribution(flips, row);
  add_distribution(steps, row);
  add_distribution(discarded, row);
  for(double x : { seconds, longest })
    row.push_back(seconds_to_text(x));
  for(double x : { residual, floor })
    row.push_back(to_text(x));
  for(CE::Delaunay_property property : { CE::Delaunay_property::EXACT, CE::Delaunay_property::WITHIN_ROUNDING, CE::Delaunay_property::NO })
    row.push_back(std::to_string(delaunay[std::size_t(property)]));
  for(std::size_t x : { certified, std::size_t(bits), lost })
    row.push_back(bits == 0 ? "" : std::to_string(x));
  return row;
}

// In one line, with the arguments that run it again.
void describe(std::ostream& out, const Group& group, Retriangulation mode, std::size_t i, const Case& c, const Outcome& outcome)
{
  const CE::Statistics& s = outcome.statistics;
  out << group.name << ' ' << to_text(mode) << ' ' << i << " (" << c.name << "): " << outcome.text
      << "; residual " << to_text(outcome.residual) << ", floor " << to_text(s.residual_floor)
      << ", steps " << s.number_of_iterations << " (" << s.number_of_discarded_iterations << " discarded), flips " << s.number_of_flips
      << (s.is_doubled ? " of the double" : "") << ", Delaunay " << int(s.delaunay)
      << ", " << seconds_to_text(seconds_of(s)) << " s" << std::endl;
}

void run_group(const Group& group, Retriangulation mode)
{
  const std::vector<Case> cases = group.cases();
  std::vector<Outcome> outcomes;
  for(std::size_t i = 0; i < cases.size(); ++i)
  {
    const Outcome outcome = cases[i].run(mode);
    if(!outcome.is_case)
      continue;
    outcomes.push_back(outcome);
    if(!outcome.is_success() && !outcome.is_refused_rightly())
      describe(std::cerr, group, mode, i, cases[i], outcome);
  }
  print_row(row_of(group, mode, outcomes));
}

// For all meshes of at least 500 vertices of which few edges are flipped: what flips cost, in the fastest of five runs.
void print_flip_costs()
{
  print_row({ "mesh", "mode", "vertices", "edges", "flips", "Newton steps", "ms: discarded", "rest of the solve", "of which flips", "%" });
  print_row(Row(10, "---"));
  double of_few = 0, flips_of_few = 0; // where less than 1 % are flipped
  for(const Case& c : find_group("meshes").cases())
    for(Retriangulation mode : { Retriangulation::WHEN_NEEDED, Retriangulation::ALWAYS })
    {
      Outcome best;
      double least = HUGE_VAL;
      for(int run = 0; run < 5; ++run)
      {
        Outcome outcome = c.run(mode);
        const CE::Statistics& s = outcome.statistics;
        const bool is_case = outcome.is_case && outcome.is_success() && s.number_of_flips > 0
          && 20 * s.number_of_flips < outcome.edges && outcome.vertices >= 500;
        if(!is_case)
          break;
        if(s.seconds.solve - s.seconds.discarded >= least)
          continue;
        least = s.seconds.solve - s.seconds.discarded;
        best = std::move(outcome);
      }
      if(least == HUGE_VAL)
        continue;
      const CE::Statistics::Seconds& seconds = best.statistics.seconds;
      const bool are_few = 100 * best.statistics.number_of_flips < best.edges;
      of_few += are_few ? least : 0;
      flips_of_few += are_few ? seconds.flips : 0;
      print_row({ c.name, to_text(mode), std::to_string(best.vertices), std::to_string(best.edges), std::to_string(best.statistics.number_of_flips),
                  std::to_string(best.statistics.number_of_iterations),
                  mode == Retriangulation::ALWAYS ? "" : to_text(1000 * seconds.discarded), to_text(1000 * least),
                  to_text(1000 * seconds.flips), to_text(100 * seconds.flips / least) });
    }
  print_row({ "all below 1 %", "", "", "", "", "", "", to_text(1000 * of_few), to_text(1000 * flips_of_few),
              to_text(100 * flips_of_few / of_few) });
}

Retriangulation mode_of(const std::string& name)
{
  if(name != "when-needed" && name != "always")
    throw std::runtime_error("the mode is when-needed or always, not " + name);
  return name == "always" ? Retriangulation::ALWAYS : Retriangulation::WHEN_NEEDED;
}

void run(const Row& arguments)
{
  if(arguments.empty())
    throw std::runtime_error("a group is missing");
  const Group& group = find_group(arguments[0]);
  if(arguments.size() < 2)
  {
    run_group(group, Retriangulation::WHEN_NEEDED);
    run_group(group, Retriangulation::ALWAYS);
  }
  else if(arguments.size() < 3)
    run_group(group, mode_of(arguments[1]));
  else
  {
    const Retriangulation mode = mode_of(arguments[1]);
    const std::size_t i = std::stoul(arguments[2]);
    const Case c = group.cases().at(i);
    const Outcome outcome = c.run(mode);
    describe(std::cout, group, mode, i, c, outcome);
    for(double residual : outcome.statistics.residuals)
      std::cout << to_text(residual) << ' ';
    std::cout << std::endl;
  }
}

} // namespace

int main(int argc, char* argv[])
{
  const Row arguments(argv + 1, argv + argc);
  try
  {
    if(!arguments.empty() && arguments[0] == "--header")
    {
      print_row(columns);
      print_row(Row(columns.size(), "---"));
    }
    else if(!arguments.empty() && arguments[0] == "--list")
      for(const Group& group : groups())
        std::cout << group.name << '\n';
    else if(!arguments.empty() && arguments[0] == "--flip-cost")
      print_flip_costs();
    else
      run(arguments);
    return EXIT_SUCCESS;
  }
  catch(const std::exception& error)
  {
    std::cerr << "robustness: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
