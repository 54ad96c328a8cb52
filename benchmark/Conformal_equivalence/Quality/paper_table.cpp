// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The table of section 7 of Springborn, Schroeder and Pinkall (2008) for this package:
//
//   paper_table MESH N          the rows of MESH in Markdown: natural border, rectangle, or sphere, and N cones
//   paper_table --seamless MESH [DISK SPHERE]
//                               only the row of the seamless map: 4 cones for a disk and 8 for a sphere, unless others are given
//   paper_table --place N [CONES]
//                               the time to place cones, 8 of them, on a terrain of N vertices, and that of one plain solve
//   paper_table --cones MESH... what 4, 8 and 16 cones leave of u, and how long it takes to place them: with u = 0 at the cones, as in the paper,
//                               and with angles that are chosen with the places, for the largest |u| and for the root mean square of u
//   paper_table --header        the head of the table of rows
//
// MESH is the name of a file or a specification of benchmark_meshes.h. Ends with status 2, without a row, if it cannot be read as a
// mesh, or is neither a disk nor a sphere.

#include "../include/Processor_stopwatch.h"
#include "../include/benchmark_meshes.h"
#include "../include/table.h"

#include <CGAL/Conformal_equivalence/boundary_conditions.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/compute_seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/conformal_distortion.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/flatten_refined.h>
#include <CGAL/Conformal_equivalence/map_to_sphere.h>
#include <CGAL/Conformal_equivalence/place_cones.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace benchmarks;
namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;

typedef Mesh::Property_map<halfedge_descriptor, Point_2>  UV_map;
typedef Mesh::Property_map<vertex_descriptor, double>     Number_map;
typedef CE::Flattening_report<Mesh>                       Report;
typedef std::map<std::string, std::string>                Row; // by column; cells that are missing are empty

const Cells columns = {
  "model", "mode", "vertices", "edges flipped", "Newton steps", "from 0", "max &#124;u&#124;", "mean qc", "max qc", "cones",
  "angles", "tiles", "deformation", "closest", "/ before", "seconds", "flipped", "seam edges", "unequal", "status" };

Cells cells_of(const Row& row)
{
  Cells cells;
  for(const std::string& column : columns)
  {
    const auto cell = row.find(column);
    cells.push_back(cell == row.end() ? "" : cell->second);
  }
  return cells;
}

// A mesh with the maps that the package writes.
struct Surface
{
  Mesh mesh;
  UV_map uv;
  Number_map u, angle;
  Mesh::Property_map<vertex_descriptor, bool> is_fixed;

  explicit Surface(const Mesh& m)
    : mesh(m), uv(mesh.add_property_map<halfedge_descriptor, Point_2>("h:uv", Point_2(0, 0)).first),
      u(mesh.add_property_map<vertex_descriptor, double>("v:u", 0).first),
      angle(mesh.add_property_map<vertex_descriptor, double>("v:angle", CGAL_PI).first),
      is_fixed(mesh.add_property_map<vertex_descriptor, bool>("v:is_fixed", false).first)
  {}
};

// ---- Cells

// Without the elements at fault.
std::string reason(const Report& report)
{
  const std::string text = message(report);
  return text.substr(0, text.find(';'));
}

std::string seconds_text(double seconds) { return to_text(seconds, 3); }

// Steps on the given triangulation that showed that flips are needed are in parentheses.
std::string steps_text(const CE::Statistics& s)
{
  const std::string steps = std::to_string(s.number_of_iterations);
  return s.number_of_discarded_iterations == 0 ? steps : steps + " (+ " + std::to_string(s.number_of_discarded_iterations) + ")";
}

void describe_solve(const CE::Statistics& s, Row& row)
{
  row["edges flipped"] = std::to_string(s.number_of_flips);
  row["Newton steps"] = steps_text(s);
}

std::string largest_text(const Mesh& mesh, Number_map u)
{
  double largest = 0;
  for(vertex_descriptor v : vertices(mesh))
    if(!mesh.is_isolated(v))
      largest = (std::max)(largest, std::abs(u[v]));
  return to_text(largest, 4);
}

// How many cones have which angle, in units of pi / 2; the angles of free ones one by one.
void describe_cones(const Report& report, Row& row)
{
  std::map<long, std::size_t> number;
  std::vector<double> free;
  for(const auto& cone : report.cones)
  {
    const double quarters = cone.angle / (CGAL_PI / 2);
    if(cone.is_free)
      free.push_back(quarters);
    else
      ++number[std::lround(quarters)];
  }
  std::sort(free.begin(), free.end());
  std::string text;
  for(double quarters : free)
    text += (text.empty() ? "" : ", ") + to_text(quarters, 3);
  for(const auto& angle : number)
    text += (text.empty() ? "" : ", ") + std::to_string(angle.second) + " x " + std::to_string(angle.first);
  row["cones"] = std::to_string(report.cones.size());
  if(!report.flattened_cones.empty())
    row["cones"] += " + " + std::to_string(report.flattened_cones.size()) + " flat";
  row["angles"] = text;
}

// Returns the mean quasi-conformal factor.
double describe_distortion(const Mesh& mesh, UV_map uv, Row& row)
{
  const auto distortion = CE::compute_conformal_distortion(mesh, uv);
  row["mean qc"] = to_text(distortion.mean_quasi_conformal_factor, 6);
  row["max qc"] = to_text(distortion.maximum_quasi_conformal_factor, 4);
  return distortion.mean_quasi_conformal_factor;
}

void describe_flipped(std::size_t flipped, Row& row)
{
  row["flipped"] = std::to_string(flipped);
  row["status"] = flipped == 0 ? "ok" : "bad: flipped triangles";
}

// What is measured of a layout, whoever made it. Returns the mean quasi-conformal factor.
double describe_layout(const Mesh& mesh, UV_map uv, Row& row)
{
  const auto verdict = CE::verify_layout(mesh, uv);
  describe_flipped(verdict.number_of_flipped_triangles + verdict.number_of_degenerate_triangles, row);
  return describe_distortion(mesh, uv, row);
}

// ---- Flattening

// With the common refinement, if straight triangles would be flipped. Returns the report of what is described.
template <typename NamedParameters>
Report lay_out(Surface& s, const NamedParameters& np, Row& row)
{
  Report report = CE::flatten(s.mesh, s.uv, np);
  if(bool(report))
    describe_layout(s.mesh, s.uv, row);
  else if(report.status == CE::Status::NOT_INJECTIVE)
  {
    Mesh refined;
    const UV_map uv = refined.add_property_map<halfedge_descriptor, Point_2>("h:uv", Point_2(0, 0)).first;
    report = CE::flatten_refined(s.mesh, refined, uv, np);
    if(bool(report))
    {
      describe_layout(refined, uv, row);
      row["status"] += ", refined";
    }
  }
  if(!bool(report))
    row["status"] = reason(report);
  return report;
}

Row natural_border(const Mesh& mesh)
{
  Row row = {{"mode", "free"}};
  Surface s(mesh);
  const Processor_stopwatch stopwatch;
  const Report report = lay_out(s, params::log_scale_factor_map(s.u), row);
  row["seconds"] = seconds_text(stopwatch.seconds());
  describe_solve(report.statistics, row);
  if(bool(report))
    row["max &#124;u&#124;"] = largest_text(s.mesh, s.u);
  return row;
}

halfedge_descriptor border_halfedge(const Mesh& mesh)
{
  for(halfedge_descriptor h : halfedges(mesh))
    if(is_border(h, mesh))
      return h;
  throw std::runtime_error("the mesh has no border");
}

Row rectangle(const Mesh& mesh)
{
  Row row = {{"mode", "rectangle"}};
  Surface s(mesh);
  const Processor_stopwatch stopwatch;
  Report report;
  const auto corners = CE::select_rectangle_corners(s.mesh, border_halfedge(s.mesh), params::flattening_report(std::ref(report)));
  if(!bool(report))
    row["status"] = reason(report);
  else
  {
    CE::prescribe_rectangle(s.mesh, corners, s.angle);
    report = lay_out(s, params::log_scale_factor_map(s.u).border_angle_map(s.angle), row);
  }
  row["seconds"] = seconds_text(stopwatch.seconds());
  describe_solve(report.statistics, row);
  if(bool(report))
    row["max &#124;u&#124;"] = largest_text(s.mesh, s.u);
  return row;
}

// ---- The sphere

// Every face on its own in the plane, with the points of the sphere for corners.
void lay_out_chords(const Mesh& mesh, Mesh::Property_map<vertex_descriptor, Point_3> point, UV_map uv)
{
  for(face_descriptor f : faces(mesh))
  {
    const halfedge_descriptor h = halfedge(f, mesh), g = next(h, mesh), k = next(g, mesh);
    const Kernel::Vector_3 a = point[target(g, mesh)] - point[target(h, mesh)], b = point[target(k, mesh)] - point[target(h, mesh)];
    const double length = std::sqrt(a.squared_length());
    uv[h] = Point_2(0, 0);
    uv[g] = Point_2(length, 0);
    uv[k] = Point_2(a * b / length, std::sqrt(cross_product(a, b).squared_length()) / length);
  }
}

// Triangles of great arcs that do not run counterclockwise seen from outside, decided exactly.
std::size_t number_of_inverted_arcs(const Mesh& mesh, Mesh::Property_map<vertex_descriptor, Point_3> point)
{
  typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_3 Exact_point;
  std::size_t result = 0;
  for(face_descriptor f : faces(mesh))
  {
    std::vector<Exact_point> p;
    for(vertex_descriptor v : vertices_around_face(halfedge(f, mesh), mesh))
      p.emplace_back(point[v].x(), point[v].y(), point[v].z());
    result += CGAL::orientation(p[0], p[1], p[2], Exact_point(0, 0, 0)) == CGAL::NEGATIVE ? 0 : 1;
  }
  return result;
}

// Nothing fixes the size of u there: its mean is to be 0, as the solver has it where it is free.
void center(const Mesh& mesh, Number_map u)
{
  double sum = 0, number = 0;
  for(vertex_descriptor v : vertices(mesh))
    if(!mesh.is_isolated(v))
    {
      sum += u[v];
      ++number;
    }
  for(vertex_descriptor v : vertices(mesh))
    u[v] -= sum / number;
}

// Of the mesh of the parts into which the edges of the polyhedron cut the faces; a copy of the mesh where no edge was flipped.
Report describe_sphere(const Mesh& mesh, Row& row)
{
  Mesh refined;
  const auto image = refined.add_property_map<vertex_descriptor, Point_3>("v:sphere", Point_3(0, 0, 0)).first;
  const UV_map uv = refined.add_property_map<halfedge_descriptor, Point_2>("h:uv", Point_2(0, 0)).first;
  const Report report = CE::map_to_sphere_refined(mesh, refined, image);
  if(bool(report))
  {
    lay_out_chords(refined, image, uv);
    describe_distortion(refined, uv, row);
    describe_flipped(number_of_inverted_arcs(refined, image), row);
    row["status"] += report.bent_faces.empty() ? "" : ", refined";
  }
  return report;
}

Row sphere(const Mesh& mesh)
{
  Row row = {{"mode", "sphere"}};
  Surface s(mesh);
  const auto image = s.mesh.add_property_map<vertex_descriptor, Point_3>("v:sphere", Point_3(0, 0, 0)).first;
  CE::Spherical_refinement<> refinement;
  const Processor_stopwatch stopwatch;
  Report report = CE::map_to_sphere(s.mesh, image, params::log_scale_factor_map(s.u).spherical_refinement(std::ref(refinement)));
  row["seconds"] = seconds_text(stopwatch.seconds());
  describe_solve(report.statistics, row);
  if(bool(report))
  {
    center(s.mesh, s.u);
    row["max &#124;u&#124;"] = largest_text(s.mesh, s.u);
    report = describe_sphere(s.mesh, row);
  }
  if(!bool(report))
    row["status"] = reason(report);
  return row;
}

// ---- Cones

// Where u = 0 if cones are free: there, and on the border.
void fix_cones(Surface& s, const Report& report)
{
  for(vertex_descriptor v : vertices(s.mesh))
    s.is_fixed[v] = bool(CGAL::is_border(v, s.mesh));
  for(const auto& cone : report.cones)
    s.is_fixed[cone.vertex] = true;
}

// `o` and `oq`: the metric of place_cones(), and the layout of the same one found from u = 0.
Row placed_cones(const Mesh& mesh, std::size_t n, bool is_rounded)
{
  Row row = {{"mode", is_rounded ? "oq" : "o"}};
  Surface s(mesh);
  const Processor_stopwatch stopwatch;
  const Report placed = CE::place_cones(s.mesh, s.angle, params::number_of_cones(n).angle_quantum(is_rounded ? CGAL_PI / 2 : 0.)
                                                               .log_scale_factor_map(s.u));
  const double seconds = stopwatch.seconds();
  row["seconds"] = seconds_text(seconds);
  describe_solve(placed.statistics, row);
  describe_cones(placed, row);
  if(!bool(placed))
  {
    row["status"] = reason(placed);
    return row;
  }
  row["max &#124;u&#124;"] = largest_text(s.mesh, s.u);
  fix_cones(s, placed);
  const Report report = is_rounded ? lay_out(s, params::cone_angle_map(s.angle), row)
                                   : lay_out(s, params::vertex_is_constrained_map(s.is_fixed), row);
  row["from 0"] = steps_text(report.statistics);
  return row;
}

// ---- Seamless maps

const double maximum_distortion = 1.02; // of the deformation, in the mean

// i^quanta p + translation
Point_2 moved(const Point_2& p, int quanta, const std::array<std::int64_t, 2>& translation)
{
  double x = p.x(), y = p.y();
  for(int k = 0; k < quanta; ++k)
  {
    const double turned = -y;
    y = x;
    x = turned;
  }
  return Point_2(x + double(translation[0]), y + double(translation[1]));
}

// Edges whose two sides are not equal as numbers: at the seam after the motion that is reported, elsewhere as they are.
std::size_t number_of_unequal_edges(const Surface& s, const Report& report)
{
  const Mesh& mesh = s.mesh;
  std::set<edge_descriptor> seam;
  std::size_t result = 0;
  for(const auto& t : report.transitions)
  {
    const halfedge_descriptor h = t.halfedge, g = opposite(h, mesh);
    seam.insert(edge(h, mesh));
    const bool is_equal = moved(s.uv[h], t.quanta, t.lattice_translation) == s.uv[prev(g, mesh)]
                       && moved(s.uv[prev(h, mesh)], t.quanta, t.lattice_translation) == s.uv[g];
    result += is_equal ? 0 : 1;
  }
  for(edge_descriptor e : edges(mesh))
  {
    const halfedge_descriptor h = halfedge(e, mesh), g = opposite(h, mesh);
    if(!CGAL::is_border(e, mesh) && seam.count(e) == 0)
      result += s.uv[h] == s.uv[prev(g, mesh)] && s.uv[g] == s.uv[prev(h, mesh)] ? 0 : 1;
  }
  return result;
}

// Of cones: corners that are not at integers.
std::size_t number_of_corners_off_the_lattice(const Surface& s, const Report& report)
{
  std::size_t result = 0;
  for(const auto& cone : report.cones)
    for(halfedge_descriptor h : CGAL::halfedges_around_target(cone.vertex, s.mesh))
      result += s.uv[h].x() == std::round(s.uv[h].x()) && s.uv[h].y() == std::round(s.uv[h].y()) ? 0 : 1;
  return result;
}

void judge_seams(const Surface& s, const Report& report, double mean_factor, Row& row)
{
  const std::size_t unequal = number_of_unequal_edges(s, report);
  row["seam edges"] = std::to_string(report.transitions.size());
  row["unequal"] = std::to_string(unequal);
  if(unequal > 0)
    row["status"] = "bad: seams are not exact";
  else if(number_of_corners_off_the_lattice(s, report) > 0)
    row["status"] = "bad: cones off the lattice";
  else if(bool(report) && !(report.tiling.mean_distortion <= maximum_distortion + 1e-9))
    row["status"] = "bad: the deformation is beyond the bound";
  else if(!(std::abs(mean_factor - report.tiling.mean_factor) <= 1e-9 * mean_factor))
    row["status"] = "bad: reported mean qc " + to_text(report.tiling.mean_factor, 6);
}

// `oqr`
Row seamless(const Mesh& mesh, std::size_t n)
{
  Row row = {{"mode", "oqr"}};
  Surface s(mesh);
  const Processor_stopwatch stopwatch;
  const Report report = CE::compute_seamless_parameterization(
    s.mesh, s.uv, params::number_of_cones(n).maximum_distortion(maximum_distortion).log_scale_factor_map(s.u));
  row["seconds"] = seconds_text(stopwatch.seconds());
  describe_solve(report.statistics, row);
  describe_cones(report, row);
  const bool is_written = bool(report) || report.status == CE::Status::BOUND_NOT_MET;
  if(is_written)
  {
    const CE::Tiling& tiling = report.tiling;
    row["max &#124;u&#124;"] = largest_text(s.mesh, s.u);
    row["tiles"] = to_text(tiling.number_of_tiles, 6);
    row["deformation"] = to_text(tiling.mean_distortion, 5);
    row["closest"] = tiling.is_closest ? "yes" : "no";
    row["/ before"] = to_text(tiling.mean_factor / tiling.mean_factor_before, 5);
    judge_seams(s, report, describe_layout(s.mesh, s.uv, row), row);
  }
  if(!bool(report))
    row["status"] = reason(report);
  return row;
}

// ---- Meshes

struct Model
{
  std::string name;
  Mesh mesh;
  bool is_disk = false, is_sphere = false;

  explicit Model(const std::string& specification) : name(name_of(specification))
  {
    if(!read(specification))
      return;
    CGAL::Polygon_mesh_processing::triangulate_faces(mesh);
    const auto imported = CE::import_mesh(mesh);
    if(imported.status != CE::Status::OK)
      return;
    const auto& t = imported.triangulation;
    const CE::Surface_topology topology = CE::surface_topology(t, CE::connected_components(t));
    is_disk = topology.is_disk();
    is_sphere = topology.number_of_components == 1 && topology.number_of_borders == 0 && topology.genus == 0;
  }

  bool read(const std::string& specification)
  {
    try
    {
      mesh = make_mesh(specification);
    }
    catch(const std::exception& error)
    {
      std::cerr << error.what() << std::endl;
      return false;
    }
    return true;
  }

  void print(Row row) const
  {
    row["model"] = name;
    row["vertices"] = std::to_string(num_vertices(mesh));
    print_row(cells_of(row));
  }
};

int print_all_rows(const std::string& specification, std::size_t n)
{
  const Model model(specification);
  if(!model.is_disk && !model.is_sphere)
    return 2;
  if(model.is_disk)
  {
    model.print(natural_border(model.mesh));
    model.print(rectangle(model.mesh));
  }
  else
    model.print(sphere(model.mesh));
  model.print(placed_cones(model.mesh, n, false));
  model.print(placed_cones(model.mesh, n, true));
  model.print(seamless(model.mesh, n));
  return EXIT_SUCCESS;
}

int print_seamless_row(const std::string& specification, std::size_t cones_of_disk, std::size_t cones_of_sphere)
{
  const Model model(specification);
  if(!model.is_disk && !model.is_sphere)
    return 2;
  model.print(seamless(model.mesh, model.is_disk ? cones_of_disk : cones_of_sphere));
  return EXIT_SUCCESS;
}

// ---- Time

double median(std::array<double, 3> x)
{
  std::sort(x.begin(), x.end());
  return x[1];
}

struct Placement_times
{
  std::array<double, 3> plain, placing, ratio;
  CE::Cone_placement<double> placement;
};

// One after the other, so that both meet the same state of the machine.
Placement_times time_placing(const CE::Intrinsic_triangulation<double>& t, std::size_t n, bool is_rounded)
{
  Placement_times result;
  for(std::size_t i = 0; i < 3; ++i)
  {
    const Processor_stopwatch plain;
    const auto metric = CE::compute_conformal_metric(t, CE::Conformal_conditions<double>(t));
    result.plain[i] = plain.seconds();
    if(!CE::is_success(metric.status))
      throw std::runtime_error("no plain solve: " + message(metric.status));
    const Processor_stopwatch placing;
    result.placement = CE::place_cones(t, params::number_of_cones(n).angle_quantum(is_rounded ? CGAL_PI / 2 : 0.));
    result.placing[i] = placing.seconds();
    result.ratio[i] = result.placing[i] / result.plain[i];
  }
  return result;
}

void time_placing(std::size_t number_of_vertices, std::size_t n)
{
  print_head({ "vertices", "cones", "mode", "plain solve", "placing", "/ plain solve", "sweeps", "moves", "linear systems",
               "Newton steps", "max &#124;u&#124;", "status" });
  const Mesh mesh = terrain(number_of_vertices);
  const auto imported = CE::import_mesh(mesh);
  for(const bool is_rounded : { false, true })
  {
    const Placement_times times = time_placing(imported.triangulation, n, is_rounded);
    const CE::Cone_placement<double>& p = times.placement;
    print_row({ std::to_string(num_vertices(mesh)), std::to_string(n), is_rounded ? "oq" : "o", seconds_text(median(times.plain)),
                seconds_text(median(times.placing)), to_text(median(times.ratio), 3), std::to_string(p.number_of_sweeps),
                std::to_string(p.number_of_moves), std::to_string(p.number_of_solves), steps_text(p.metric.statistics),
                to_text(p.maximum_log_scale_factor, 4), message(p.status) });
  }
}

// Time, largest |u|, root mean square of u of one way to place cones.
void add_cells(const CE::Cone_placement<double>& p, double seconds, Cells& row)
{
  const bool has_metric = CE::is_success(p.metric.status) && CE::is_success(p.status);
  row.push_back(seconds_text(seconds));
  row.push_back(has_metric ? to_text(p.maximum_log_scale_factor, 4) : message(p.status));
  row.push_back(has_metric ? to_text(p.root_mean_square, 4) : "");
}

// One after the other, so that all meet the same state of the machine.
void compare_angles(const Cells& meshes)
{
  print_head({ "mesh", "vertices", "cones", "u = 0: seconds", "max &#124;u&#124;", "rms", "chosen: seconds", "max &#124;u&#124;", "rms",
               "for the rms: seconds", "max &#124;u&#124;", "rms", "chosen / u = 0: seconds", "max &#124;u&#124;" });
  for(const std::string& name : meshes)
  {
    const Mesh mesh = make_mesh(name);
    const auto imported = CE::import_mesh(mesh);
    for(const std::size_t n : { 4, 8, 16 })
    {
      Cells row = { name_of(name), std::to_string(num_vertices(mesh)), std::to_string(n) };
      std::array<double, 3> seconds;
      std::array<double, 3> largest;
      for(std::size_t i = 0; i < 3; ++i)
      {
        const Processor_stopwatch stopwatch;
        const auto placement = CE::place_cones(imported.triangulation, params::number_of_cones(n)
          .cone_angles(i == 0 ? CE::Cone_angles::ZERO_U : CE::Cone_angles::CHOSEN)
          .cone_measure(i == 2 ? CE::Cone_measure::ROOT_MEAN_SQUARE_U : CE::Cone_measure::MAXIMUM_U));
        seconds[i] = stopwatch.seconds();
        largest[i] = placement.maximum_log_scale_factor;
        add_cells(placement, seconds[i], row);
      }
      row.push_back(to_text(seconds[1] / seconds[0], 3));
      row.push_back(to_text(largest[1] / largest[0], 3));
      print_row(row);
    }
  }
}

std::size_t number(const Cells& arguments, std::size_t i, std::size_t otherwise)
{
  return i < arguments.size() ? std::stoul(arguments[i]) : otherwise;
}

int run(const Cells& arguments)
{
  if(arguments.size() > 1 && arguments[0] == "--seamless")
    return print_seamless_row(arguments[1], number(arguments, 2, 4), number(arguments, 3, 8));
  if(!arguments.empty() && arguments[0] == "--cones")
    compare_angles(Cells(arguments.begin() + 1, arguments.end()));
  else if(!arguments.empty() && arguments[0] == "--header")
    print_head(columns);
  else if(!arguments.empty() && arguments[0] == "--place")
    time_placing(number(arguments, 1, 100000), number(arguments, 2, 8));
  else
    return print_all_rows(arguments.empty() ? "terrain:10000" : arguments[0], number(arguments, 1, 4));
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  try
  {
    return run(Cells(argv + 1, argv + argc));
  }
  catch(const std::exception& error)
  {
    std::cerr << "paper_table: " << error.what() << std::endl;
    return EXIT_FAILURE;
  }
}
