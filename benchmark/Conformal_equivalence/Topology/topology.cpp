// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Surfaces of any topology, flattened with cones:
//
//   topology [--cones N] [--degree D] [--margin M] [--features K] MESH
//   topology --header
//   topology --cut N [HANDLES]
//
// The first prints a row of a Markdown table for MESH, the second the head of the table. MESH as for
// `performance`. Borders keep their lengths. Every closed component has cones that are far from each other, where M (default 0.9)
// times half of pi times the degree of the vertex is at least the angle:
//  - N (default 8) of equal angle if it is a sphere;
//  - none if it is a torus, unless N is given: then half of them with 3/2 pi, half with 5/2 pi;
//  - of higher genus, of equal angle, as few as vertices of degree D (default 6) allow, or N if that is given.
// With --features these are instead the vertices where the mesh itself has a curvature (2 pi - angle sum) of more than K
// radians, positive or negative; each keeps its angle, up to an equal share of what the other vertices give up.
// What a layout is worth is measured from its coordinates alone, by the code with which the tests check files.
//
// The third compares compute_cut_graph() with one factorization, on a closed surface with HANDLES handles (default 16) and eight
// cones, and on a terrain with as many holes, both of about N vertices.

#include "../include/factorization.h"
#include "../include/farthest_points.h"
#include "../include/methods.h"
#include "../include/plates.h"
#include "../../../test/Conformal_equivalence/include/check_flattening.h"

#include <CGAL/Conformal_equivalence/compute_cut_graph.h>

#include <CGAL/number_type_config.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace benchmarks;

typedef CE::Intrinsic_triangulation<double>     Triangulation;
typedef std::uint32_t                           Index;
typedef std::pair<Index, double>                Cone; // vertex and angle
typedef std::vector<std::string>                Row;

struct Options
{
  std::size_t number_of_cones = 0; // 0: none was given
  unsigned degree = 6;
  double margin = 0.9;
  double features = 0; // 0: not asked for
};

// ---- Cones

// The least number of equal cones that fit vertices of the degree given, on a closed surface of this negative characteristic:
// 2 pi (1 - chi / n) <= margin * degree * pi / 2.
std::size_t least_number_of_cones(std::ptrdiff_t characteristic, const Options& options)
{
  const double most = options.margin * options.degree / 2 - 2; // of a cone, in units of pi
  if(most <= 0)
    throw std::runtime_error("cones need a larger degree");
  return std::size_t(std::ceil(-2. * double(characteristic) / most - 1e-9));
}

// Angles whose curvatures 2 pi - angle sum up to 2 pi times the characteristic.
std::vector<double> cone_angles(std::ptrdiff_t characteristic, const Options& options)
{
  std::size_t n = options.number_of_cones;
  if(characteristic == 0)
  {
    std::vector<double> angles;
    for(std::size_t i = 0; i < n / 2 * 2; ++i)
      angles.push_back((i % 2 == 0 ? 1.5 : 2.5) * CGAL_PI);
    return angles;
  }
  if(n == 0)
    n = characteristic > 0 ? 8 : least_number_of_cones(characteristic, options);
  return std::vector<double>(n, 2 * CGAL_PI * (1 - double(characteristic) / double(n)));
}

typedef CE::Surface_components::Component Component;

std::vector<Cone> distant_cones(const Triangulation& t, const Component& component, const Options& options)
{
  std::vector<Cone> cones;
  const std::vector<double> angles = cone_angles(component.euler_characteristic(), options);
  if(angles.empty())
    return cones;
  const double largest = *std::max_element(angles.begin(), angles.end());
  const auto is_admissible = [&](Index v) { return largest < options.margin * CGAL_PI / 2 * t.degree(v) + 1e-9; };
  const std::vector<Index> points = farthest_points(t, angles.size(), t.origin(3 * component.first_face), is_admissible);
  if(points.size() < angles.size())
    throw std::runtime_error("there are not enough vertices of sufficient degree for cones");
  for(std::size_t i = 0; i < points.size(); ++i)
    cones.emplace_back(points[i], angles[i]);
  return cones;
}

// `angle_sum` is by vertex, of the mesh as it is.
std::vector<Cone> feature_cones(const std::vector<Index>& vertices, std::ptrdiff_t characteristic,
                                const std::vector<double>& angle_sum, const Options& options)
{
  const long double pi = checking::pi;
  std::vector<Cone> cones;
  long double curvature = 2 * pi * characteristic; // of all other vertices
  for(Index v : vertices)
  {
    if(std::abs(2 * CGAL_PI - angle_sum[v]) <= options.features)
      continue;
    cones.emplace_back(v, angle_sum[v]);
    curvature -= 2 * pi - angle_sum[v];
  }
  for(std::size_t i = 0; i < cones.size(); ++i) // each takes its share of what is left, what rounding left of others included
  {
    const double angle = double(cones[i].second - curvature / (cones.size() - i));
    curvature += angle - cones[i].second;
    cones[i].second = angle;
  }
  return cones;
}

std::vector<double> angle_sums(const Triangulation& t)
{
  CE::internal::Conformal_energy<double> energy(t, false);
  energy.evaluate(std::vector<double>(t.number_of_vertices(), 0.));
  return energy.angle_sums();
}

std::vector<Cone> place_cones(const Triangulation& t, const Options& options)
{
  const CE::Surface_components pieces = CE::connected_components(t);
  std::vector<std::vector<Index> > vertices(pieces.components.size());
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v))
      vertices[pieces.component_of_vertex[v]].push_back(v);

  std::vector<Cone> result;
  for(std::size_t c = 0; c < vertices.size(); ++c)
  {
    const Component& component = pieces.components[c];
    if(component.number_of_borders > 0)
      continue;
    const std::vector<Cone> cones = options.features > 0
                                  ? feature_cones(vertices[c], component.euler_characteristic(), angle_sums(t), options)
                                  : distant_cones(t, component, options);
    result.insert(result.end(), cones.begin(), cones.end());
  }
  return result;
}

// The largest angle of a cone as a multiple of half of pi times the degree; zero without cones.
double largest_relative_angle(const Triangulation& t, const std::vector<Cone>& cones)
{
  double result = 0;
  for(const Cone& cone : cones)
    result = (std::max)(result, cone.second / (CGAL_PI / 2 * t.degree(cone.first)));
  return result;
}

// ---- Layouts

template <typename Points>
std::array<double, 3> coordinates(const Points& p) { return {{ p.x(), p.y(), p.z() }}; }

// The mesh with its layout, as the checking code knows it.
checking::Surface to_surface(const Mesh& mesh, UV_map uv)
{
  checking::Surface s;
  for(vertex_descriptor v : vertices(mesh))
    s.points.push_back(coordinates(mesh.point(v)));
  for(face_descriptor f : faces(mesh))
  {
    std::array<std::size_t, 3> face, corner;
    halfedge_descriptor h = halfedge(f, mesh);
    for(std::size_t k = 0; k < 3; ++k, h = next(h, mesh))
    {
      const Point_2& p = get(uv, h);
      face[k] = std::size_t(target(h, mesh));
      corner[k] = s.texture.size();
      s.texture.push_back({{ p.x(), p.y(), 1 }});
    }
    s.faces.push_back(face);
    s.corners.push_back(corner);
  }
  return s;
}

checking::Verdict check(const Mesh& mesh, UV_map uv, const std::vector<Cone>& cones)
{
  checking::Cones prescribed;
  for(const Cone& cone : cones)
    prescribed[cone.first] = cone.second;
  const checking::Surface surface = to_surface(mesh, uv);
  return checking::check_flattening(surface, surface, checking::Tolerances(), prescribed);
}

// The tolerances hold, or they hold up to what coordinates of type double allow, or they do not.
std::string judge(const checking::Verdict& verdict, double residual)
{
  const checking::Tolerances tolerances;
  if(!verdict.is_good() || residual > 1e-12)
    return "bad";
  const bool holds = verdict.cross_ratio.value <= tolerances.cross_ratio && verdict.two_sides.value <= tolerances.two_sides
                  && verdict.border_scale.value <= tolerances.border_scale
                  && (std::max)(verdict.angle.value, verdict.cone_angle.value) <= tolerances.angle;
  return holds ? "good" : "good up to rounding";
}

// The largest relative difference of a length cross ratio (equation (4) of the paper) in the metric found, whose
// lengths are those of `scaled`, from that in space.
template <typename LengthMap>
double cross_ratio_error(const Mesh& mesh, const LengthMap& scaled)
{
  typedef checking::Real Real;
  const auto ratio = [&](halfedge_descriptor h) // of scaled length to length
  {
    const auto p = coordinates(mesh.point(source(h, mesh))), q = coordinates(mesh.point(target(h, mesh)));
    return Real(get(scaled, edge(h, mesh))) / std::hypot(Real(q[0]) - p[0], Real(q[1]) - p[1], Real(q[2]) - p[2]);
  };
  Real result = 0;
  for(edge_descriptor e : edges(mesh))
  {
    if(is_border(e, mesh))
      continue;
    const halfedge_descriptor h = halfedge(e, mesh), g = opposite(h, mesh);
    const Real quotient = ratio(next(h, mesh)) / ratio(prev(h, mesh)) * ratio(next(g, mesh)) / ratio(prev(g, mesh));
    result = (std::max)(result, std::abs(quotient - 1));
  }
  return double(result);
}

// ---- Rows

const Row columns = {
  "mesh", "vertices", "components", "borders", "genus", "cones", "largest angle", "seam edges", "Newton steps", "residual",
  "range of u", "metric", "cross ratios", "two sides", "angles", "flips", "length error", "solve", "cut", "layout", "verdict" };

void print_row(const Row& cells)
{
  for(const std::string& cell : cells)
    std::cout << "| " << cell << ' ';
  std::cout << '|' << std::endl;
}

template <typename Number>
std::string to_text(Number x, int digits = 2)
{
  std::ostringstream out;
  out << std::setprecision(digits) << x;
  return out.str();
}

std::string seconds_to_text(double seconds)
{
  std::ostringstream out;
  out << std::fixed << std::setprecision(3) << seconds;
  return out.str();
}

std::string name_of(const std::string& specification)
{
  std::string name = specification.substr(specification.find_last_of('/') + 1);
  return name.substr(0, name.rfind(".off"));
}

template <typename Report>
Row describe(const std::string& specification, const Report& report, const std::string& cones, double largest_angle)
{
  const CE::Surface_topology& topology = report.topology;
  return { name_of(specification), std::to_string(topology.number_of_vertices), std::to_string(topology.number_of_components),
           std::to_string(topology.number_of_borders), std::to_string(topology.genus), cones, largest_angle == 0 ? "" : to_text(largest_angle) };
}

// Without a layout: steps, residual, seconds and the reason with the first ten triangles.
template <typename Report>
Row failure(Row row, const Report& report)
{
  const CE::Statistics& s = report.statistics;
  row.push_back(""); // seam
  row.push_back(std::to_string(s.number_of_iterations));
  row.push_back(to_text(s.residual));
  row.resize(columns.size() - 4);
  row.push_back(seconds_to_text(s.seconds.solve));
  row.resize(columns.size() - 1);
  row.push_back(message(report));
  return row;
}

Row row_of(const std::string& specification, const Options& options)
{
  Mesh mesh = make_mesh(specification);
  const UV_map uv = mesh.add_property_map<halfedge_descriptor, Point_2>("h:uv", Point_2(0, 0)).first;
  auto angle = mesh.add_property_map<vertex_descriptor, double>("v:angle", 2 * CGAL_PI).first;
  auto u = mesh.add_property_map<vertex_descriptor, double>("v:u", 0).first;
  auto length = mesh.add_property_map<edge_descriptor, double>("e:scaled_length", 0).first;
  auto is_seam = mesh.add_property_map<edge_descriptor, bool>("e:is_seam", false).first;
  const auto imported = CE::import_mesh(mesh);
  const std::vector<Cone> cones = place_cones(imported.triangulation, options);
  for(const Cone& cone : cones)
    put(angle, vertex_descriptor(cone.first), cone.second);

  const auto report = CE::flatten(mesh, uv, CGAL::parameters::cone_angle_map(angle)
                                              .log_scale_factor_map(u)
                                              .scaled_edge_length_map(length)
                                              .edge_is_seam_map(is_seam));
  Row row = describe(specification, report, std::to_string(cones.size()) + (options.features > 0 ? " features" : ""),
                     largest_relative_angle(imported.triangulation, cones));
  if(!report)
    return failure(row, report);

  const auto range = std::minmax_element(u.begin(), u.end());
  const checking::Verdict verdict = check(mesh, uv, cones);
  const CE::Statistics& s = report.statistics;
  row.push_back(std::to_string(std::count(is_seam.begin(), is_seam.end(), true)));
  row.push_back(std::to_string(s.number_of_iterations));
  row.push_back(to_text(s.residual));
  row.push_back(to_text(*range.second - *range.first, 3));
  row.push_back(to_text(cross_ratio_error(mesh, length)));
  row.push_back(to_text(double(verdict.cross_ratio.value)));
  row.push_back(to_text(double(verdict.two_sides.value)));
  row.push_back(to_text(double((std::max)(verdict.angle.value, verdict.cone_angle.value))));
  row.push_back(std::to_string(verdict.not_positive_triangles));
  row.push_back(to_text(report.layout_length_error));
  for(double seconds : { s.seconds.solve, s.seconds.cut, s.seconds.layout })
    row.push_back(seconds_to_text(seconds));
  row.push_back(judge(verdict, s.residual));
  return row;
}

// ---- The cut

void compare_with_factorization(const std::string& name, const Mesh& mesh, std::size_t number_of_cones)
{
  const auto imported = CE::import_mesh(mesh);
  const Triangulation& t = imported.triangulation;
  const CE::Surface_topology topology = CE::surface_topology(t, CE::connected_components(t));
  const std::vector<Index> cones = farthest_points(t, number_of_cones, 0, [](Index) { return true; });
  const Processor_stopwatch stopwatch;
  const CE::Cut_graph cut = CE::compute_cut_graph(t, cones);
  const double seconds = stopwatch.seconds();
  if(!cut)
    throw std::runtime_error("no cut of the " + name + ": " + message(cut.status));
  const Factorization_seconds baseline = time_factorization(laplacian(t));
  print_row({ name, std::to_string(topology.number_of_vertices), std::to_string(topology.number_of_borders),
              std::to_string(topology.genus), std::to_string(cones.size()),
              std::to_string(std::count(cut.is_cut.begin(), cut.is_cut.end(), 1)),
              seconds_to_text(seconds), seconds_to_text(baseline.analysis), seconds_to_text(baseline.factorization),
              to_text(seconds / baseline.factorization), to_text(seconds / (baseline.analysis + baseline.factorization)) });
}

void time_cuts(std::size_t n, std::size_t handles)
{
  const Row head = { "surface", "vertices", "borders", "genus", "cones", "seam edges", "cut", "analysis",
                     "factorization", "/ factorization", "/ both" };
  print_row(head);
  print_row(Row(head.size(), "---"));
  compare_with_factorization("plate", Plate(n, handles, true).mesh(), 8);
  compare_with_factorization("terrain with holes", Plate(n, handles, false).mesh(), 0);
}

int run(const Row& arguments)
{
  Options options;
  std::string mesh;
  for(std::size_t i = 0; i < arguments.size(); ++i)
  {
    const auto next_argument = [&]() -> const std::string&
    {
      if(++i == arguments.size())
        throw std::runtime_error("a value is missing after " + arguments[i - 1]);
      return arguments[i];
    };
    if(arguments[i] == "--cones")
      options.number_of_cones = std::stoul(next_argument());
    else if(arguments[i] == "--degree")
      options.degree = unsigned(std::stoul(next_argument()));
    else if(arguments[i] == "--margin")
      options.margin = std::stod(next_argument());
    else if(arguments[i] == "--features")
      options.features = std::stod(next_argument());
    else
      mesh = arguments[i];
  }
  print_row(row_of(mesh.empty() ? "terrain:10000" : mesh, options));
  return EXIT_SUCCESS;
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
    else if(arguments.size() > 1 && arguments[0] == "--cut")
      time_cuts(std::stoul(arguments[1]), arguments.size() > 2 ? std::stoul(arguments[2]) : 16);
    else
      return run(arguments);
    return EXIT_SUCCESS;
  }
  catch(const std::exception& error)
  {
    std::cerr << "topology: " << error.what() << std::endl;
    return EXIT_FAILURE;
  }
}
