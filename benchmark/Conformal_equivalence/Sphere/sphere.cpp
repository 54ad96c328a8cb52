// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Measures the maps to the sphere and to the disk:
//
//   sphere MESH            a row of a table in Markdown: MESH, a closed surface of genus 0, on the sphere, or, a disk, in the disk
//   sphere --time N        a closed surface of about N vertices on the sphere, and a terrain of as many flattened, in one process
//   sphere --header        the head of the table of rows
//
// MESH is the name of a file or a specification of benchmark_meshes.h. A surface of another kind gives no row.

#include "../include/benchmark_meshes.h"
#include "../include/methods.h"

#include <CGAL/Conformal_equivalence/conformal_distortion.h>
#include <CGAL/Conformal_equivalence/map_to_disk.h>
#include <CGAL/Conformal_equivalence/map_to_sphere.h>

#include <CGAL/boost/graph/generators.h>

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace benchmarks;
namespace CEi = CGAL::Conformal_equivalence::internal;

typedef std::uint32_t                       Index;
typedef std::vector<std::string>            Row;
typedef CE::Intrinsic_triangulation<double> Triangulation;
typedef CE::Common_refinement<double>       Refinement;
typedef CEi::Ideal_polyhedron<double>       Polyhedron;
typedef Polyhedron::Wide                    Wide;
typedef std::array<double, 3>               Point;
typedef std::array<Wide, 3>                 Wide_point;
typedef CE::Flattening_report<Mesh>         Report;

const Row columns = { "mesh", "vertices", "target", "flips", "steps", "seconds", "residual", "range of u", "shortest chord", "cross ratios",
                      "rounded", "bound", "inverted", "lost", "bent", "radius", "barycentre", "independence", "mean qc", "max qc", "verdict" };

// What is measured of both maps. Points of the disk have z = 0.
struct Result
{
  Report report;
  Polyhedron polyhedron;
  std::vector<Wide_point> wide;     // by vertex of the mesh
  std::vector<Point> points;        // the same, rounded
  std::vector<Wide> log_weights;    // -u, by vertex of the mesh
  Refinement parts;                 // without faces if no edge was flipped
  std::vector<Point> part_points;   // by vertex of `parts`
  double barycentre = 0, radius = 0;
  double seconds = 0;
};

template <typename Number>
Number distance(const std::array<Number, 3>& p, const std::array<Number, 3>& q)
{
  using std::sqrt;
  const Number x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
  return Number(sqrt(Number(x * x + y * y + z * z)));
}

Wide_point widened(const Point& p) { return {{Wide(p[0]), Wide(p[1]), Wide(p[2])}}; }

double norm(const Point& p)
{
  const long double x = p[0], y = p[1], z = p[2];
  return double(std::sqrt(x * x + y * y + z * z) - 1);
}

// --- the two maps -------------------------------------------------------------------------------

const Index none = Triangulation::null_index;

template <typename Mapping, typename Run>
void run(Mapping& mapping, Index vertex, Run run_with, Result& result)
{
  const Processor_stopwatch stopwatch;
  if(vertex == none)
    run_with(CGAL::parameters::gradient_tolerance(1e-12));
  else
    run_with(CGAL::parameters::gradient_tolerance(1e-12).vertex_at_infinity(vertex_descriptor(vertex)));
  result.seconds = stopwatch.seconds();
  result.report = mapping.report;
  result.polyhedron = mapping.polyhedron;
}

Result on_sphere(const Mesh& mesh, Index vertex = none)
{
  Result result;
  CEi::Sphere_mapping<Mesh, double> mapping(mesh);
  run(mapping, vertex, [&](const auto& np) { mapping.run(np, true); }, result);
  if(!bool(result.report))
    return result;
  const Triangulation& t = mapping.mesh.triangulation;
  Point sum = {{0, 0, 0}};
  for(Index v = 0; v < t.number_of_vertices(); ++v)
  {
    using std::log;
    const bool is_used = !t.is_isolated_vertex(v);
    result.wide.push_back(is_used ? CEi::sphere_point(mapping.polyhedron.vectors[v]) : Wide_point());
    result.points.push_back(mapping.points[v]);
    result.log_weights.push_back(is_used ? Wide(log(mapping.polyhedron.vectors[v][3])) : Wide(0));
    for(std::size_t i = 0; is_used && i < 3; ++i)
      sum[i] += mapping.points[v][i];
    result.radius = is_used ? (std::max)(result.radius, std::abs(norm(mapping.points[v]))) : result.radius;
  }
  result.barycentre = (norm(sum) + 1) / double(t.number_of_vertices());
  if(!mapping.polyhedron.flips.empty())
  {
    result.parts = mapping.refinement.parts;
    result.part_points = mapping.refinement.points;
  }
  return result;
}

Result in_disk(const Mesh& mesh, Index vertex = none)
{
  Result result;
  CEi::Disk_mapping<Mesh, double> mapping(mesh);
  run(mapping, vertex, [&](const auto& np) { mapping.run(np, true, false); }, result);
  if(!bool(result.report))
    return result;
  const Triangulation& t = mapping.mesh.triangulation;
  double sum[3] = { 0, 0, 0 };
  for(Index v = 0; v < t.number_of_vertices(); ++v)
  {
    using std::log;
    using std::sqrt;
    const bool is_used = !t.is_isolated_vertex(v), is_border = is_used && t.is_border_vertex(v);
    const auto& x = mapping.polyhedron.vectors[v];
    const Wide size = is_border ? Wide(sqrt(Wide(x[0] * x[0] + x[2] * x[2]))) : Wide(x[3] + x[1]);
    result.wide.push_back(is_used ? Wide_point{{x[2] / size, x[0] / size, Wide(0)}} : Wide_point());
    result.points.push_back({{mapping.points[v][0], mapping.points[v][1], 0}});
    result.log_weights.push_back(is_used ? Wide(log(mapping.weights[v])) : Wide(0));
    if(!is_used)
      continue;
    const Point& p = result.points.back();
    const double weight = is_border ? .5 : 1, to_sphere = 2 / (1 + p[0] * p[0] + p[1] * p[1]);
    sum[0] += weight * to_sphere * p[0];
    sum[1] += weight * to_sphere * p[1];
    sum[2] += weight;
    result.radius = is_border ? (std::max)(result.radius, std::abs(norm(p))) : result.radius;
  }
  result.barycentre = std::hypot(sum[0], sum[1]) / sum[2];
  result.parts = mapping.refinement;
  result.part_points.resize(result.parts.number_of_vertices());
  for(std::size_t c = 0; c < result.parts.corner_vertex.size(); ++c)
    result.part_points[result.parts.corner_vertex[c]] = {{result.parts.corner_uv[c][0], result.parts.corner_uv[c][1], 0}};
  return result;
}

// --- figures ------------------------------------------------------------------------------------

// Lengths of the edges of the polyhedron, in pairs of `double`: those of the mesh, or of its double, and Ptolemy's theorem at every flip.
std::vector<Wide> lengths_of(const Mesh& mesh, const Polyhedron& polyhedron)
{
  Triangulation t = CE::import_mesh(mesh).triangulation;
  if(polyhedron.triangulation.number_of_faces() != t.number_of_faces())
    t = CEi::Surface_double<double>(t).triangulation;
  std::vector<Wide> length(t.lengths().begin(), t.lengths().end());
  for(Index e : polyhedron.flips)
  {
    const Index h = t.edge_halfedge(e), g = t.twin(h);
    const Wide flipped = (length[t.edge(t.next(h))] * length[t.edge(t.next(g))] + length[t.edge(t.previous(h))] * length[t.edge(t.previous(g))])
                       / length[e];
    t.flip_edge(e, double(flipped));
    length[e] = flipped;
  }
  return length;
}

struct Chord_figures
{
  double shortest = HUGE_VAL, cross_ratio = 0, rounded_cross_ratio = 0;
};

// Those of the edges of the polyhedron between vertices of the mesh.
Chord_figures chord_figures(const Mesh& mesh, const Result& result)
{
  const Triangulation& t = result.polyhedron.triangulation;
  const std::vector<Wide> length = lengths_of(mesh, result.polyhedron);
  const std::size_t n = result.points.size();
  Chord_figures figures;
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    const Index h = t.edge_halfedge(e), g = t.twin(h);
    if(t.origin(h) >= n || t.target(h) >= n)
      continue;
    figures.shortest = (std::min)(figures.shortest, distance(result.points[t.origin(h)], result.points[t.target(h)]));
    if(g == none || t.apex(h) >= n || t.apex(g) >= n)
      continue;
    const auto error = [&](const auto& chord)
    {
      const auto ratio = [&](Index k) { return chord(t.origin(k), t.target(k)) / length[t.edge(k)]; };
      const Wide quotient = ratio(t.next(h)) * ratio(t.next(g)) / (ratio(t.previous(h)) * ratio(t.previous(g)));
      return std::abs(double(Wide(quotient - Wide(1))));
    };
    figures.cross_ratio = (std::max)(figures.cross_ratio, error([&](Index i, Index j) { return distance(result.wide[i], result.wide[j]); }));
    figures.rounded_cross_ratio = (std::max)(figures.rounded_cross_ratio, error([&](Index i, Index j)
      { return distance(widened(result.points[i]), widened(result.points[j])); }));
  }
  return figures;
}

bool is_positive(const Wide_point& p, const Wide_point& q, const Wide_point& r, bool is_sphere)
{
  const auto plane = [](const Wide_point& x) { return std::array<Wide, 2>{{x[0], x[1]}}; };
  return is_sphere ? CEi::is_counterclockwise(p, q, r) : CEi::is_left_turn(plane(p), plane(q), plane(r));
}

bool is_positive(const Point& p, const Point& q, const Point& r, bool is_sphere)
{
  const auto plane = [](const Point& x) { return std::array<double, 2>{{x[0], x[1]}}; };
  return is_sphere ? CEi::is_counterclockwise(p, q, r) : CEi::is_left_turn(plane(p), plane(q), plane(r));
}

// Of the triangles, or of their parts: how many are not positive, as computed and only when rounded.
std::pair<std::size_t, std::size_t> inverted(const Triangulation& t, const Result& result, bool is_sphere)
{
  if(result.parts.number_of_faces() > 0)
    return std::make_pair(result.parts.flipped_faces.size(), result.parts.rounded_faces.size());
  std::pair<std::size_t, std::size_t> count(0, 0);
  for(Index f = 0; f < t.number_of_faces(); ++f)
  {
    const Index i = t.origin(3 * f), j = t.origin(3 * f + 1), k = t.origin(3 * f + 2);
    if(!is_positive(result.wide[i], result.wide[j], result.wide[k], is_sphere))
      ++count.first;
    else if(!is_positive(result.points[i], result.points[j], result.points[k], is_sphere))
      ++count.second;
  }
  return count;
}

struct Quasi_conformal_factors
{
  double sum = 0, area = 0, largest = 1;
  double mean() const { return sum / area; }
};

// A triangle with its corners in the plane.
std::array<std::array<double, 2>, 3> in_plane(const Point& p, const Point& q, const Point& r)
{
  const Eigen::Vector3d a(q[0] - p[0], q[1] - p[1], q[2] - p[2]), b(r[0] - p[0], r[1] - p[1], r[2] - p[2]);
  const double length = a.norm();
  return {{ {{0, 0}}, {{length, 0}}, {{a.dot(b) / length, a.cross(b).norm() / length}} }};
}

// `least`: parts smaller than that, and their images, are not told from rounding.
void add_factor(const std::array<Point, 3>& p, const std::array<Point, 3>& image, double least, Quasi_conformal_factors& factors)
{
  const auto w = in_plane(image[0], image[1], image[2]), s = in_plane(p[0], p[1], p[2]);
  const double area = s[1][0] * s[2][1] / 2;
  const double factor = CE::quasi_conformal_factor({{distance(p[1], p[2]), distance(p[2], p[0]), distance(p[0], p[1])}}, w);
  if(!(area > least) || !std::isfinite(factor))
    return;
  factors.sum += area * factor;
  factors.area += area;
  factors.largest = (std::max)(factors.largest, factor);
}

// Of triangles between the points: those of the mesh, or their parts.
Quasi_conformal_factors quasi_conformal_factors(const Mesh& mesh, const Triangulation& t, const Result& result)
{
  std::vector<Point> surface;
  for(vertex_descriptor v : vertices(mesh))
    surface.push_back({{mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z()}});
  const auto corner = [&](Index f, Index k) { return t.origin(3 * f + k); };
  double area = 0;
  for(Index f = 0; f < t.number_of_faces(); ++f)
  {
    const auto w = in_plane(surface[corner(f, 0)], surface[corner(f, 1)], surface[corner(f, 2)]);
    area += w[1][0] * w[2][1] / 2;
  }
  const double least = 1e-9 * area / double(t.number_of_faces());

  Quasi_conformal_factors factors;
  if(result.parts.number_of_faces() == 0)
  {
    for(Index f = 0; f < t.number_of_faces(); ++f)
      add_factor({{surface[corner(f, 0)], surface[corner(f, 1)], surface[corner(f, 2)]}},
                 {{result.points[corner(f, 0)], result.points[corner(f, 1)], result.points[corner(f, 2)]}}, 0, factors);
    return factors;
  }
  for(const Refinement::Crossing& x : result.parts.crossings)
  {
    const Index h = t.edge_halfedge(x.input_edge);
    const Point &p = surface[t.origin(h)], &q = surface[t.target(h)];
    const double s = x.input_parameter;
    surface.push_back({{(1 - s) * p[0] + s * q[0], (1 - s) * p[1] + s * q[1], (1 - s) * p[2] + s * q[2]}});
  }
  for(Index f = 0; f < result.parts.number_of_faces(); ++f)
  {
    const std::size_t c = result.parts.first_corner[f];
    std::array<Point, 3> p, image;
    for(std::size_t k = 0; k < 3; ++k)
    {
      const Index v = result.parts.corner_vertex[c + k];
      p[k] = surface[v];
      image[k] = result.part_points[v];
    }
    add_factor(p, image, least, factors);
  }
  return factors;
}

// The largest difference of points after the rotation that makes the mean of their squares least.
double difference_up_to_rotation(const std::vector<Point>& p, const std::vector<Point>& q)
{
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  const auto vector = [](const Point& x) { return Eigen::Vector3d(x[0], x[1], x[2]); };
  for(std::size_t v = 0; v < p.size(); ++v)
    covariance += vector(p[v]) * vector(q[v]).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Eigen::Matrix3d rotation = svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  double result = 0;
  for(std::size_t v = 0; v < p.size(); ++v)
    result = (std::max)(result, (vector(p[v]) - rotation * vector(q[v])).norm());
  return result;
}

// Two vertices, or border vertices, far from each other in the order of the mesh.
std::vector<Index> other_vertices(const Triangulation& t, bool is_sphere)
{
  std::vector<Index> candidates;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v) && (is_sphere || t.is_border_vertex(v)))
      candidates.push_back(v);
  return { candidates[candidates.size() / 3], candidates[2 * candidates.size() / 3] };
}

// --- rows ---------------------------------------------------------------------------------------

template <typename Number>
std::string text(const Number& x, int digits = 2)
{
  std::ostringstream out;
  out << std::setprecision(digits) << x;
  return out.str();
}

void print_row(const Row& cells)
{
  for(const std::string& cell : cells)
    std::cout << "| " << cell << ' ';
  std::cout << '|' << std::endl;
}

std::string name_of(const std::string& specification)
{
  const std::string name = specification.substr(specification.find_last_of('/') + 1);
  return name.substr(0, name.rfind(".off"));
}

// With each of two other vertices; empty if there is nothing to compare.
std::string independence(const Mesh& mesh, const Triangulation& t, const Result& result, bool is_sphere, double& worst)
{
  std::size_t refused = 0, others = 0, compared = 0;
  worst = 0;
  for(Index v : other_vertices(t, is_sphere))
  {
    const Result other = is_sphere ? on_sphere(mesh, v) : in_disk(mesh, v);
    if(!bool(other.report))
      ++refused;
    else if(other.polyhedron.flips.empty() != result.polyhedron.flips.empty())
      ++others;
    else
    {
      worst = (std::max)(worst, difference_up_to_rotation(result.points, other.points));
      ++compared;
    }
  }
  return (compared > 0 ? text(worst) : "") + (refused > 0 ? " (" + std::to_string(refused) + " refused)" : "")
       + (others > 0 ? " (" + std::to_string(others) + (result.polyhedron.flips.empty() ? " with flips)" : " without flips)") : "");
}

Row row_of(const std::string& specification, const Mesh& mesh, const Triangulation& t, bool is_sphere)
{
  const Result result = is_sphere ? on_sphere(mesh) : in_disk(mesh);
  const CE::Statistics& s = result.report.statistics;
  Row row = { name_of(specification), std::to_string(num_vertices(mesh)), is_sphere ? "sphere" : "disk" };
  if(!bool(result.report))
  {
    row.resize(columns.size() - 1);
    row[5] = text(result.seconds, 3);
    row.push_back(message(result.report));
    return row;
  }
  const Chord_figures chords = chord_figures(mesh, result);
  const auto count = inverted(t, result, is_sphere);
  const Quasi_conformal_factors factors = quasi_conformal_factors(mesh, t, result);
  double least = HUGE_VAL, most = -HUGE_VAL, worst = 0;
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v))
    {
      least = (std::min)(least, double(result.log_weights[v]));
      most = (std::max)(most, double(result.log_weights[v]));
    }
  const double bound = 1e-8 + std::ldexp(16, -53) / chords.shortest;
  const std::string difference = independence(mesh, t, result, is_sphere, worst);
  std::string misses;
  const auto check = [&](bool holds, const std::string& what) { misses += holds ? "" : (misses.empty() ? "" : ", ") + what; };
  check(count.first == 0, "inverted");
  check(chords.cross_ratio <= 1e-8, "cross ratios");
  check(chords.rounded_cross_ratio <= bound, "rounded");
  check(result.radius <= (is_sphere ? 2e-16 : 4e-16), "radius");
  check(result.barycentre <= 1e-12, "barycentre");
  check(most - least >= 20 || worst <= 1e-9, "independence");
  for(const std::string& cell : { std::to_string(result.polyhedron.flips.size()),
                                  std::to_string(s.number_of_iterations + s.number_of_discarded_iterations),
                                  text(result.seconds, 3), text(s.residual), text(most - least, 3), text(chords.shortest), text(chords.cross_ratio),
                                  text(chords.rounded_cross_ratio), text(bound), std::to_string(count.first), std::to_string(count.second),
                                  std::to_string(result.report.bent_faces.size()), text(result.radius), text(result.barycentre), difference,
                                  text(factors.mean(), 5), text(factors.largest, 4), misses.empty() ? "good" : "misses " + misses })
    row.push_back(cell);
  return row;
}

void measure(const std::string& specification)
{
  const Mesh mesh = make_mesh(specification);
  const auto imported = CE::import_mesh(mesh);
  if(imported.status != CE::Status::OK)
    return;
  const Triangulation& t = imported.triangulation;
  const CE::Surface_topology topology = CE::surface_topology(t, CE::connected_components(t));
  if(topology.is_disk())
    print_row(row_of(specification, mesh, t, false));
  else if(topology.number_of_components == 1 && topology.number_of_borders == 0 && topology.genus == 0)
    print_row(row_of(specification, mesh, t, true));
}

// --- a million vertices -------------------------------------------------------------------------

// The faces of an icosahedron, cut into n^2 triangles each, on a sphere with hills.
Mesh bumpy_sphere(std::size_t number_of_vertices)
{
  const Index n = (std::max)(Index(1), Index(std::lround(std::sqrt(double(number_of_vertices) / 10))));
  Mesh corners;
  CGAL::make_icosahedron(corners, Point_3(0, 0, 0), 1.);
  Mesh mesh;
  Random_numbers random(3);
  std::map<std::array<Index, 6>, vertex_descriptor> known; // by the weights of the corners, at the border of a face
  const auto add = [&](const std::array<vertex_descriptor, 3>& c, const std::array<Index, 3>& weight)
  {
    std::array<std::pair<Index, Index>, 3> key;
    bool is_border = false;
    for(std::size_t i = 0; i < 3; ++i)
    {
      key[i] = std::make_pair(weight[i] == 0 ? Index(-1) : Index(c[i]), weight[i]);
      is_border = is_border || weight[i] == 0;
    }
    std::sort(key.begin(), key.end());
    const std::array<Index, 6> flat = {{key[0].first, key[0].second, key[1].first, key[1].second, key[2].first, key[2].second}};
    if(is_border && known.count(flat) != 0)
      return known[flat];
    double x[3] = { 0, 0, 0 }, length = 0;
    for(std::size_t i = 0; i < 3; ++i)
    {
      x[0] += weight[i] * corners.point(c[i]).x();
      x[1] += weight[i] * corners.point(c[i]).y();
      x[2] += weight[i] * corners.point(c[i]).z();
    }
    length = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for(double& y : x)
      y = y / length + random(-.15, .15) / n;
    const double r = 1 + terrain_height(x[0] + .3 * x[2], x[1] - .2 * x[2]);
    const vertex_descriptor v = mesh.add_vertex(Point_3(r * x[0], r * x[1], r * x[2]));
    if(is_border)
      known[flat] = v;
    return v;
  };
  for(face_descriptor f : faces(corners))
  {
    std::array<vertex_descriptor, 3> c;
    std::size_t k = 0;
    for(vertex_descriptor v : CGAL::vertices_around_face(halfedge(f, corners), corners))
      c[k++] = v;
    std::vector<vertex_descriptor> below, row;
    for(Index j = 0; j <= n; ++j, below.swap(row))
    {
      row.clear();
      for(Index i = 0; i + j <= n; ++i)
        row.push_back(add(c, {{n - i - j, i, j}}));
      for(Index i = 0; j > 0 && i + j <= n; ++i)
      {
        mesh.add_face(below[i], below[i + 1], row[i]);
        if(i + j < n)
          mesh.add_face(below[i + 1], row[i + 1], row[i]);
      }
    }
  }
  return mesh;
}

void compare_times(std::size_t n)
{
  print_row({ "map", "vertices", "flips", "steps", "PCG", "factorizations", "seconds", "/ flatten" });
  print_row(Row(8, "---"));
  double first = 0;
  const auto print = [&](const std::string& name, const Mesh& mesh, const Report& report, double seconds)
  {
    if(!bool(report))
      throw std::runtime_error(name + ": " + message(report));
    const CE::Statistics& s = report.statistics;
    first = first > 0 ? first : seconds;
    print_row({ name, std::to_string(num_vertices(mesh)), std::to_string(s.number_of_flips), std::to_string(s.number_of_iterations),
                std::to_string(s.number_of_linear_iterations), std::to_string(s.number_of_factorizations), text(seconds, 4),
                text(seconds / first, 3) });
  };
  {
    Mesh mesh = terrain(n);
    const UV_map uv = mesh.add_property_map<halfedge_descriptor, Point_2>("h:uv", Point_2(0, 0)).first;
    const Processor_stopwatch stopwatch;
    const auto report = CE::flatten(mesh, uv);
    print("terrain, flatten()", mesh, report, stopwatch.seconds());
  }
  {
    Mesh mesh = bumpy_sphere(n);
    const auto points = mesh.add_property_map<vertex_descriptor, Point_3>("v:sphere", Point_3(0, 0, 0)).first;
    const Processor_stopwatch stopwatch;
    const auto report = CE::map_to_sphere(mesh, points);
    print("bumpy sphere, map_to_sphere()", mesh, report, stopwatch.seconds());
  }
  {
    Mesh mesh = terrain(n);
    const auto points = mesh.add_property_map<vertex_descriptor, Point_2>("v:disk", Point_2(0, 0)).first;
    CE::Common_refinement<double> refinement;
    const Processor_stopwatch stopwatch;
    const auto report = CE::map_to_disk(mesh, points, CGAL::parameters::common_refinement(std::ref(refinement)));
    print("terrain, map_to_disk()", mesh, report, stopwatch.seconds());
  }
}

} // namespace

int main(int argc, char* argv[])
{
  const Row arguments(argv + 1, argv + argc);
  try
  {
    if(arguments.size() == 1 && arguments[0] == "--header")
    {
      print_row(columns);
      print_row(Row(columns.size(), "---"));
    }
    else if(arguments.size() == 2 && arguments[0] == "--time")
      compare_times(std::stoul(arguments[1]));
    else if(arguments.size() == 1)
      measure(arguments[0]);
    else
      throw std::runtime_error("expected MESH, --time N or --header");
    return EXIT_SUCCESS;
  }
  catch(const std::exception& error)
  {
    std::cerr << "sphere: " << error.what() << std::endl;
    return EXIT_FAILURE;
  }
}
