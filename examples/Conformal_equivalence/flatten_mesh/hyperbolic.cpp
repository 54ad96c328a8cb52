// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The hyperbolic surface that a mesh is conformally equivalent to: its picture, its group, its figures.

#include "../include/flatten_mesh/hyperbolic.h"
#include "../include/flatten_mesh/conditions.h"
#include "../include/flatten_mesh/Disk_drawing.h"
#include "../include/flatten_mesh/figures.h"
#include "../include/flatten_mesh/Given_surface.h"
#include "../include/flatten_mesh/mesh.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/Output_files.h"
#include "../include/flatten_mesh/page_text.h"
#include "../include/flatten_mesh/precision.h"
#include "../include/flatten_mesh/Progress.h"
#include "../include/flatten_mesh/report_entries.h"
#include "../include/flatten_mesh/Solver_traits.h"
#include "../include/flatten_mesh/Stopwatch.h"

#include <CGAL/Conformal_equivalence/Exact_hyperbolic_surface.h>
#include <CGAL/Conformal_equivalence/compute_hyperbolic_metric.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Surface_double.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>
#include <CGAL/Conformal_equivalence/multiprecision.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/read_conditions.h>
#include <CGAL/Conformal_equivalence/uniformize_hyperbolic.h>

#include <CGAL/number_utils.h>

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
#  include <nlohmann/json.hpp>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace flattening {

namespace {

typedef CE::Hyperbolic_uniformization Uniformization;
typedef CE::Exact_hyperbolic_surface  Exact_surface;

// Up to ten of them, as the file numbers them.
template <typename Number>
std::string list_of_elements(const char* one, const char* several, const std::vector<std::uint32_t>& elements, const Number& number)
{
  std::set<std::size_t> numbers;
  for(std::uint32_t x : elements)
    numbers.insert(number(x));
  if(numbers.empty())
    return "";
  std::string list = text(": ", numbers.size() == 1 ? one : several);
  std::size_t n = 0;
  for(std::size_t x : numbers)
    if(n++ < 10)
      list += text(n == 1 ? " " : ", ", x);
  return numbers.size() > 10 ? list + ", ..." : list;
}

std::string explanation(const Given_surface& given, const Uniformization& u)
{
  const std::string faces = list_of_elements("face", "faces", u.faces, [&](std::uint32_t f) { return given.face(Face(f)); }),
                    vertices = list_of_elements("vertex", "vertices", u.vertices, [&](std::uint32_t v) { return given.vertex(Vertex(v)); });
  const double amount = u.is_doubled ? u.amount / 2 : u.amount; // of areas and curvatures: those of the mesh
  switch(u.status)
  {
    case CE::Status::WRONG_TOPOLOGY:
      return "a surface whose Euler characteristic is not negative has no hyperbolic metric without cones (borders become geodesics), whose "
             "curvatures (360 - angle) must sum up to more than " + text(in_degrees(amount), " degrees (--cones FILE)") + faces;
    case CE::Status::GAUSS_BONNET_VIOLATED:
    case CE::Status::NO_ANGLE_LEFT:
      return text("there is no hyperbolic metric with these angles, which leave it no area: by the Gauss-Bonnet formula they must be smaller by more "
                  "than ", in_degrees(0 - amount), " degrees in all") + vertices;
    case CE::Status::ANGLE_OUT_OF_RANGE:
      return text(CE::message(u.status), ": ", in_degrees(u.amount), " degrees", vertices);
    case CE::Status::ITERATIONS_EXHAUSTED:
      return text(CE::message(u.status), ": the residual is ", u.amount);
    case CE::Status::DEGENERATE_METRIC: // its faces are not those of the file
      return CE::message(u.status);
    default:
      return CE::message(u.status) + vertices + faces;
  }
}

Lines summary_of(const Given_surface& given, const Mesh& mesh, const Uniformization& u, const Exact_surface& exact, double seconds)
{
  const CE::Statistics& s = u.metric.statistics;
  Lines lines;
  lines.emplace_back("mesh", text(mesh.number_of_vertices(), " vertices, ", mesh.number_of_faces(), " triangles",
                                  given.is_mesh() ? "" : text(", of ", given.number_of_faces, " faces")));
  lines.emplace_back("hyperbolic surface", text("genus ", u.genus, u.is_doubled ? ", the double of the mesh" : "", ", area ", u.metric.area));
  lines.emplace_back("Newton steps", text(s.number_of_iterations, ", edges flipped ", u.metric.flips.size()));
  lines.emplace_back("residual", text(s.residual));
  lines.emplace_back("u", text(s.least_u, " to ", s.largest_u));
  lines.emplace_back(u.has_group() ? "error of the relation" : "error around vertices", text(u.relation_error));
  if(! u.has_group())
    lines.emplace_back("group", "none: the surface has cones or borders");
  else if(bool(exact))
    lines.emplace_back("exact group", text(exact.number_of_digits(), " digits, lengths of edges differ by ", exact.largest_length_difference()));
  else
    lines.emplace_back("exact group", text("none: ", CE::message(exact.status)));
  lines.emplace_back("seconds", text(seconds));
  return lines;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
nlohmann::ordered_json json_of(const std::vector<Uniformization::Motion>& motions)
{
  nlohmann::ordered_json result = nlohmann::ordered_json::array();
  for(const Uniformization::Motion& m : motions)
    result.push_back({ {"a", m.a}, {"b", m.b} });
  return result;
}

// Integers of any length, as text.
nlohmann::ordered_json json_of(const std::vector<Exact_surface::Motion>& motions)
{
  const auto parts = [](const std::array<CGAL::Exact_rational, 2>& z)
  {
    nlohmann::ordered_json result = nlohmann::ordered_json::array();
    for(const CGAL::Exact_rational& x : z)
    {
      std::ostringstream digits;
      digits << x;
      result.push_back(digits.str());
    }
    return result;
  };
  nlohmann::ordered_json result = nlohmann::ordered_json::array();
  for(const Exact_surface::Motion& m : motions)
    result.push_back({ {"a", parts(m.a)}, {"b", parts(m.b)} });
  return result;
}

std::string json_report(const Options& options, const Mesh& mesh, const Uniformization& u, const std::vector<CE::Multiprecision_number>& precise_u,
                        const Exact_surface& exact, double seconds)
{
  const CE::Statistics& s = u.metric.statistics;
  nlohmann::ordered_json report;
  begin_report(options, report);
  report["status"] = "OK";
  report["target"] = "hyperbolic";
  report["vertices"] = mesh.number_of_vertices();
  report["faces"] = mesh.number_of_faces();
  report["genus"] = u.genus;
  report["is_doubled"] = u.is_doubled;
  report["newton_steps"] = s.number_of_iterations;
  report["flips"] = u.metric.flips.size();
  report["residual"] = s.residual;
  report["u"] = { s.least_u, s.largest_u };
  if(! precise_u.empty())
  {
    report["precision_bits"] = options.precision_in_bits;
    for(const CE::Multiprecision_number& x : precise_u)
      report["log_scale_factors"].push_back(x.str());
  }
  report["area"] = u.metric.area;
  report["has_group"] = u.has_group();
  report["relation_error"] = u.relation_error;
  report["motions"] = "z -> (a z + b) / (conj(b) z + conj(a))";
  report["generators"] = json_of(u.generators);
  report["relation"] = u.relation;
  report["canonical_words"] = u.canonical_words;
  report["canonical_generators"] = json_of(u.canonical_generators);
  if(u.has_group() && bool(exact))
    report["exact"] = { {"largest_length_difference", exact.largest_length_difference()}, {"digits", exact.number_of_digits()},
                        {"generators", json_of(exact.generators())}, {"canonical_generators", json_of(exact.canonical_generators())} };
  report["seconds"] = seconds;
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}
#endif

bool write_page(std::ostream& out, const std::string& title, const Lines& lines, Disk_drawing& drawing)
{
  out << "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" << escaped_for_xml(title) << "</title>\n"
      << "<style>body { font-family: sans-serif; margin: 1.5em; color: #222; } svg { width: 90vmin; height: 90vmin; }\n"
      << "td { padding: .15em 1em .15em 0; }</style></head><body>\n<h1>" << escaped_for_xml(title) << "</h1>\n";
  drawing.write(out);
  out << "<table>\n";
  for(const auto& line : lines)
    out << "<tr><td>" << escaped_for_xml(line.first) << "</td><td>" << escaped_for_xml(line.second) << "</td></tr>\n";
  out << "</table></body></html>\n";
  return out.good();
}

// The disk coordinates of the corners.
UV_map corner_map(Mesh& mesh, const CE::Imported_mesh<Mesh>& imported, const Uniformization& u)
{
  UV_map uv = mesh.add_property_map<Halfedge, Kernel::Point_2>("h:disk").first;
  for(std::uint32_t h = 0; h < imported.triangulation.number_of_halfedges(); ++h)
    uv[imported.halfedge(h)] = Kernel::Point_2(u.corner_points[h][0], u.corner_points[h][1]);
  return uv;
}

// What is prescribed. Borders are geodesics if nothing is said of them: their angles are those of a straight line.
Conditions hyperbolic_conditions(const Options& options, const Given_surface& given, Progress& progress, Mesh& mesh)
{
  Conditions conditions(given, mesh);
  set_conditions(options, mesh, given, progress, conditions);
  if(std::none_of(options.given.begin(), options.given.end(), [](const Given_option& o) { return o.name == "boundary"; }))
    for(Vertex v : mesh.vertices())
      if(is_on_border(mesh, v))
        conditions.is_constrained[v] = false;
  return conditions;
}

auto condition_parameters(const Options& options, const Conditions& conditions)
{
  return CGAL::parameters::mollification(options.mollification)
                          .cone_angle_map(conditions.cone_angle)
                          .border_angle_map(conditions.border_angle)
                          .vertex_is_constrained_map(conditions.is_constrained)
                          .prescribed_log_scale_factor_map(conditions.u);
}

Uniformization uniformization(const Options& options, const Conditions& conditions, const Mesh& mesh, Progress& progress)
{
  Progress_visitor visitor(progress);
  return CE::uniformize_hyperbolic(mesh, condition_parameters(options, conditions).gradient_tolerance(options.tolerance)
                                                                                  .number_of_iterations(options.maximum_number_of_iterations)
                                                                                  .retriangulation(options.retriangulation)
                                                                                  .visitor(std::ref(visitor))
                                                                                  .sparse_linear_solver(Solver_traits(options.solver)));
}

// The same metric with more digits.
CE::Hyperbolic_metric<CE::Multiprecision_number> precise_metric(const Options& options, const Conditions& given, const Mesh& mesh, bool is_doubled,
                                                                Progress& progress)
{
  typedef CE::Multiprecision_number Number;
  const unsigned int most = 1000; // so that the tolerance is a `double`
  Progress_visitor visitor(progress);
  const CE::Imported_mesh<Mesh, Number> imported = CE::import_mesh<Number>(mesh, CGAL::parameters::mollification(options.mollification));
  std::vector<std::uint32_t> missing; // none: there is a condition at each vertex
  const CE::Conformal_conditions<Number> conditions = CE::read_conditions(imported, missing, condition_parameters(options, given));
  const auto find = [&](const CE::Intrinsic_triangulation<Number>& t, const CE::Conformal_conditions<Number>& c)
  {
    return CE::compute_hyperbolic_metric(
      t, c, CGAL::parameters::gradient_tolerance(std::ldexp(1., -int((std::min)(most, options.precision_in_bits / 5 * 4))))
                             .number_of_iterations(options.maximum_number_of_iterations)
                             .retriangulation(options.retriangulation)
                             .visitor(std::ref(visitor))
                             .sparse_linear_solver(Solver_traits(options.solver)));
  };
  if(! is_doubled)
    return find(imported.triangulation, conditions);
  const CE::internal::Surface_double<Number> twofold(imported.triangulation);
  return find(twofold.triangulation, twofold.conditions(conditions));
}

// Everything but the report.
void write_files(const Options& options, const Uniformization& u, const Lines& lines, Mesh& mesh, Output_files& files)
{
  const CE::Imported_mesh<Mesh> imported(mesh);
  const CE::Intrinsic_triangulation<double> drawn =
    u.is_doubled ? CE::internal::Surface_double<double>(imported.triangulation).triangulation : imported.triangulation;
  Disk_drawing drawing(drawn, u);
  if(! options.obj.empty())
  {
    const UV_map uv = corner_map(mesh, imported, u);
    files.write(options.obj, [&](std::ostream& o) { return CE::IO::write_OBJ(o, mesh, uv); });
  }
  if(! options.svg.empty())
    files.write(options.svg, [&](std::ostream& o) { return drawing.write(o); });
  if(! options.html.empty())
  {
    const std::string title = std::filesystem::path(options.input).filename().string();
    files.write(options.html, [&](std::ostream& o) { return write_page(o, title, lines, drawing); });
  }
}

} // namespace

Lines make_hyperbolic_surface(const Options& options, const Given_surface& given, Mesh& mesh, const Stopwatch& watch, Progress& progress,
                              Output_files& files)
{
  const Conditions conditions = hyperbolic_conditions(options, given, progress, mesh);
  Uniformization u = uniformization(options, conditions, mesh, progress);
  if(! u)
    fail(options.input, ": ", is_interrupted() ? std::string("interrupted") : explanation(given, u));
  if(! u.is_laid_out())
    fail(options.input, ": only connected surfaces are laid out, without vertices that have no face");
  std::vector<CE::Multiprecision_number> precise_u;
  if(options.precision_in_bits > bits_of_double)
  {
    CE::Hyperbolic_metric<CE::Multiprecision_number> metric = precise_metric(options, conditions, mesh, u.is_doubled, progress);
    if(! metric)
      fail(options.input, ": ", CE::message(metric.status), ": the residual is ", metric.amount);
    u.metric.statistics = metric.statistics;
    precise_u = std::move(metric.log_scale_factors);
    precise_u.resize(mesh.number_of_vertices()); // without those of the other half of a double
  }
  const Exact_surface exact = u.has_group() ? CE::realize_exactly(u) : Exact_surface();
  const double seconds = watch.seconds();
  const Lines lines = summary_of(given, mesh, u, exact, seconds);
  progress.begin("writing");
  write_files(options, u, lines, mesh, files);
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  if(! options.report.empty())
    files.write(options.report, [&](std::ostream& o) { return (o << json_report(options, mesh, u, precise_u, exact, seconds)).good(); });
#endif
  files.commit();
  return lines;
}

} // namespace flattening
