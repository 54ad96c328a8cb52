// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The figures as text and as JSON.

#include "../include/flatten_mesh/figures.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/report_entries.h"

#include <CGAL/number_utils.h>

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
#  include <nlohmann/json.hpp>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <string>
#include <utility>

#if defined(__unix__) || defined(__APPLE__)
#  include <sys/resource.h>
#endif

namespace flattening {

std::string count(std::size_t n, const char* singular, const char* plural)
{
  return text(n, ' ', n == 1 ? singular : plural);
}

namespace {

const char* injective_text(const Figures& figures)
{
  switch(figures.verdict.injectivity)
  {
    case CE::Injectivity::YES: return "yes";
    case CE::Injectivity::NO:  return "no";
    default:                   return "undecided";
  }
}

std::string mesh_text(const Mesh& mesh, const Given_surface& given)
{
  return given.is_mesh() ? text(mesh.number_of_vertices(), " vertices, ", mesh.number_of_faces(), " triangles")
                         : text(given.number_of_vertices, " vertices, ", given.number_of_faces, " faces, as ", mesh.number_of_faces(), " triangles");
}

// What was done to the surface before it was flattened, by --repair.
std::vector<std::pair<const char*, std::size_t> > repairs(const Repair_counts& counts)
{
  return { {"merged vertices", counts.merged_vertices}, {"stitched edges", counts.stitched_edges},
           {"degenerate faces", counts.degenerate_faces}, {"duplicate faces", counts.duplicate_faces},
           {"turned faces", counts.turned_faces}, {"non-manifold edges", counts.non_manifold_edges},
           {"copied vertices", counts.copied_vertices} };
}

// Of the triangles that have an area.
std::string quasi_conformal_text(const Mesh& mesh, const Figures& figures)
{
  const std::size_t without_area = figures.distortion.number_of_skipped_faces;
  const bool is_refined = figures.number_of_made_faces != 0;
  if(without_area == (is_refined ? figures.number_of_made_faces : mesh.number_of_faces()))
    return "none: no triangle of the mesh has an area";
  return text("mean ", figures.distortion.mean_quasi_conformal_factor, ", max ", figures.distortion.maximum_quasi_conformal_factor,
              without_area == 0 ? "" : text(", without ", count(without_area, "triangle", "triangles"), " of no area"));
}

// Edges that are not as long as u at their ends makes them, and by how much.
std::string lost_border_text(const Figures& figures)
{
  const std::size_t n = figures.report.lost_border_edges.size();
  return std::isnan(figures.border_length_error) ? text(n)
         : text(n, ", up to ", 100 * figures.border_length_error, " % longer or shorter than u makes them (--keep-border)");
}

void add_repair(const Given_surface& given, Lines& lines)
{
  if(! given.repair)
    return;
  std::string done;
  for(const auto& [name, number] : repairs(*given.repair))
    if(number != 0)
      done += text(done.empty() ? "" : ", ", name, ": ", number);
  lines.emplace_back("repair", done.empty() ? "nothing to do" : done);
}

// What a disk without cones does not have.
void add_topology(const Report& report, Lines& lines)
{
  const CE::Surface_topology& t = report.topology;
  if(! t.is_disk())
    lines.emplace_back("surface", text(count(t.number_of_components, "component", "components"), ", ",
                                       count(t.number_of_borders, "border", "borders"), ", genus ", t.genus));
  const std::size_t n = report.cones.size();
  const auto free = static_cast<std::size_t>(
    std::count_if(report.cones.begin(), report.cones.end(), [](const auto& cone) { return cone.is_free; }));
  if(n != 0)
    lines.emplace_back("cones", text(n, free == 0 ? "" : free == n ? " free" : text(", ", free, " of them free")));
  if(! report.flattened_cones.empty())
    lines.emplace_back("cones made flat", text(report.flattened_cones.size()));
  if(! report.transitions.empty())
    lines.emplace_back("seam edges", text(report.transitions.size()));
  for(const auto& lattice : report.lattices)
    lines.emplace_back(report.lattices.size() == 1 ? "tau" : text("tau at face ", lattice.face),
                       text(lattice.tau[0], " + ", lattice.tau[1], " i"));
}

// Triangles whose values are not among those over which colours are spread.
std::string beyond_text(const Robust_range& range)
{
  const std::size_t n = range.number_below + range.number_above;
  return n == 0 ? "" : text(", ", count(n, "triangle", "triangles"), " beyond");
}

const char* class_text(const CE::Statistics& s)
{
  switch(s.conformal_class)
  {
    case CE::Conformal_class::GIVEN_TRIANGULATION:    return "given triangulation, flipped";
    case CE::Conformal_class::REPAIRED:               return "given triangulation, repaired locally";
    case CE::Conformal_class::DELAUNAY_TRIANGULATION: return "intrinsic Delaunay triangulation, flipped";
    default:                                          return "fixed triangulation";
  }
}

const char* target_text(Target target)
{
  return target == Target::SPHERE ? "sphere" : target == Target::DISK ? "disk" : "plane";
}

// What only seamless layouts have.
void add_tiling(const Figures& figures, Lines& lines)
{
  const CE::Tiling& t = figures.report.tiling;
  if(t.symmetry == 0)
    return;
  lines.emplace_back("seam paths", text(figures.seams.size()));
  lines.emplace_back("tiles", text(t.number_of_tiles, has_hexagons(t.symmetry) ? " hexagons" : " squares"));
  if(! std::isnan(t.scale)) // otherwise each component has its own
    lines.emplace_back("scale and rotation", text(t.scale, ", ", in_degrees(t.rotation), " degrees"));
  lines.emplace_back("deformation", text("mean ", t.mean_distortion, ", max ", t.maximum_distortion,
                                         t.is_closest ? "" : " (a smaller one may exist)"));
  if(t.number_of_wound_vertices != 0)
    lines.emplace_back("wound vertices", text(t.number_of_wound_vertices, " (triangles go around them by full turns more or less than they should)"));
}

// What only maps to the sphere and the disk have.
void add_image(Target target, const Figures& figures, Lines& lines)
{
  const Image_figures& image = figures.image;
  const auto add = [&](const char* name, double x) { if(! std::isnan(x)) lines.emplace_back(name, text(x)); };
  if(! figures.components.empty())
    lines.emplace_back("side by side", text(figures.components.size(), target == Target::SPHERE ? " spheres" : " disks"));
  add(target == Target::SPHERE ? "distance from sphere" : "distance from circle", image.distance_from_sphere);
  add("solid angle / (4 pi)", image.solid_angle / (4 * CGAL_PI));
  add("barycentre", image.barycentre);
  add("cross ratio error", image.cross_ratio_error);
}

} // namespace

Lines summary(const Options& options, const Mesh& mesh, const Figures& figures)
{
  const CE::Statistics& s = figures.report.statistics;
  Lines lines;
  lines.emplace_back("mesh", mesh_text(mesh, *figures.given));
  add_repair(*figures.given, lines);
  add_topology(figures.report, lines);
  add_tiling(figures, lines);
  if(options.target != Target::PLANE)
    lines.emplace_back("target", target_text(options.target));
  if(figures.number_of_isolated_vertices != 0)
    lines.emplace_back("isolated vertices", text(figures.number_of_isolated_vertices, ", carried through"));
  lines.emplace_back("solver", text(s.number_of_iterations, " Newton steps, residual ", s.residual, " radians",
    figures.report.status == CE::Status::CONVERGED_TO_ROUNDING ? " (the limit of rounding)" : ""));
  if(s.conformal_class != CE::Conformal_class::FIXED_TRIANGULATION && s.conformal_class != CE::Conformal_class::REPAIRED)
    lines.emplace_back("triangulation", text(class_text(s), ": ", count(s.number_of_flips, "flip", "flips"), s.is_doubled ? ", on the double" : "",
                                               s.number_of_resolving_flips == 0 ? "" : text(", ", s.number_of_resolving_flips,
                                                                                            " of them to resolve faces of no area")));
  if(! figures.report.lost_border_edges.empty())
    lines.emplace_back("border edges flipped", lost_border_text(figures));
  if(figures.repair.number_of_flips + figures.repair.number_of_splits != 0)
    lines.emplace_back("local repair", text(count(figures.repair.number_of_flips, "flip", "flips"), ", ",
                                            count(figures.repair.number_of_splits, "split", "splits")));
  if(figures.number_of_made_faces != 0)
    lines.emplace_back(figures.is_refined ? "refined mesh" : "repaired mesh",
                       text(figures.number_of_made_vertices, " vertices, ", figures.number_of_made_faces, " triangles"));
  lines.emplace_back("log scale factor u", text("from ", figures.u_min, " to ", figures.u_max));
  lines.emplace_back("quasi-conformal factor", quasi_conformal_text(mesh, figures));
  if(figures.color_range && ! figures.color_range->empty())
    lines.emplace_back("colours", text(options.color_by_quasi_conformal_factor ? "quasi-conformal factor" : "u", " from ", figures.color_range->lower,
                                       " to ", figures.color_range->upper, beyond_text(*figures.color_range)));
  lines.emplace_back("flipped triangles", text(figures.verdict.number_of_flipped_triangles, " (exact)",
    options.target != Target::PLANE && figures.verdict.number_of_flipped_triangles != 0 ? ", by rounding" : ""));
  if(figures.verdict.number_of_degenerate_triangles != 0)
    lines.emplace_back("degenerate triangles", text(figures.verdict.number_of_degenerate_triangles, " (exact)"));
  if(figures.number_of_rounded_triangles != 0)
    lines.emplace_back("triangles too small", text(figures.number_of_rounded_triangles, " for double"));
  lines.emplace_back("injective", injective_text(figures));
  if(! std::isnan(figures.cross_ratio_error))
    lines.emplace_back("cross ratio error", text(figures.cross_ratio_error, ", of the straight triangles (--refine has none)"));
  if(! std::isnan(figures.report.layout_length_error))
    lines.emplace_back("largest length error", text(figures.report.layout_length_error));
  if(options.target != Target::PLANE)
    add_image(options.target, figures, lines);
  const std::string placing = figures.placing_seconds > 0 ? text(", place ", figures.placing_seconds) : "";
  lines.emplace_back("seconds", text("read ", figures.reading_seconds, ", import ", s.seconds.import, placing, ", solve ", s.seconds.solve,
                                     ", cut ", s.seconds.cut, ", lay out ", s.seconds.layout,
                                     ", verify ", s.seconds.verify + figures.verifying_seconds));
  return lines;
}

void print_summary(std::ostream& out, const Options& options, const Lines& lines)
{
  out << options.input << '\n';
  for(const auto& line : lines)
    out << "  " << line.first << std::string(line.first.size() < 24 ? 24 - line.first.size() : 1, ' ') << line.second << '\n';
  for(const std::string& file : outputs(options))
    if(! file.empty() && file != "-" && ! (options.is_report_joint && file == options.report))
      out << "  wrote " << file << '\n';
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
namespace {

// The largest amount of memory that the program has had, 0 if unknown.
std::size_t peak_memory_bytes()
{
#if defined(__APPLE__)
  rusage usage;
  return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<std::size_t>(usage.ru_maxrss) : 0;
#elif defined(__unix__)
  rusage usage;
  return getrusage(RUSAGE_SELF, &usage) == 0 ? std::size_t(1024) * static_cast<std::size_t>(usage.ru_maxrss) : 0;
#else
  return 0;
#endif
}

std::string status_text(const Figures& figures)
{
  return figures.is_search_stopped ? "STOPPED"
       : figures.report.status == CE::Status::CONVERGED_TO_ROUNDING ? "CONVERGED_TO_ROUNDING" : "OK";
}

const char* mode_text(const Options& options)
{
  if(options.local_repair)
    return "local repair";
  switch(options.retriangulation)
  {
    case CE::Retriangulation::WHEN_NEEDED: return "when-needed";
    case CE::Retriangulation::ALWAYS:      return "always";
    default:                               return "never";
  }
}

// By kind, with underscores for spaces; null without --repair.
nlohmann::ordered_json json_repair(const Given_surface& given)
{
  if(! given.repair)
    return nullptr;
  auto json = nlohmann::ordered_json::object();
  for(const auto& [name, number] : repairs(*given.repair))
  {
    std::string key = name;
    std::replace_if(key.begin(), key.end(), [](char c) { return c == ' ' || c == '-'; }, '_');
    json[key] = number;
  }
  return json;
}

nlohmann::ordered_json json_cones(const Report& report)
{
  auto cones = nlohmann::ordered_json::array();
  for(const auto& cone : report.cones)
  {
    cones.push_back({ {"vertex", cone.vertex_index}, {"angle_degrees", in_degrees(cone.angle)}, {"prescribed", ! cone.is_free} });
    if(cone.free_angle != 0 && ! cone.is_free)
      cones.back()["angle_before_degrees"] = in_degrees(cone.free_angle);
    if(report.tiling.symmetry != 0)
      cones.back()["lattice"] = cone.lattice_point;
  }
  return cones;
}

nlohmann::ordered_json json_flattened_cones(const Figures& figures)
{
  auto vertices = nlohmann::ordered_json::array();
  for(Vertex v : figures.report.flattened_cones)
    vertices.push_back(figures.given->vertex(v));
  return vertices;
}

// How the loops around handles turned in the conformal metric, and turn; and how far that is from conformal.
template <typename Handle_turning>
nlohmann::ordered_json json_handles(const Handle_turning& handles)
{
  auto loops = nlohmann::ordered_json::array();
  for(const auto& loop : handles.loops)
    loops.push_back({ {"edges", loop.halfedges.size()}, {"conformal_degrees", in_degrees(loop.conformal_turning)}, {"quanta", loop.quanta} });
  return { {"loops", std::move(loops)}, {"proven_to_exist", handles.existence == CE::Surface_existence::PROVEN}, {"nearest", handles.is_nearest},
           {"departure", { {"mean", handles.mean_departure}, {"max", handles.maximum_departure} }}, {"residual", handles.residual},
           {"newton_steps", handles.number_of_steps}, {"flips", handles.number_of_flips} };
}

nlohmann::ordered_json json_seamless(const Figures& figures)
{
  const CE::Tiling& t = figures.report.tiling;
  if(t.symmetry == 0)
    return nullptr;
  auto seams = nlohmann::ordered_json::array();
  for(const Seam_path& path : figures.seams)
    seams.push_back({ {"from", figures.given->vertex(path.from)}, {"to", figures.given->vertex(path.to)}, {"edges", path.number_of_edges},
                      {"rotation", path.quanta}, {"translation", path.translation} });
  nlohmann::ordered_json json = { {"symmetry", t.symmetry}, {"tiles", t.number_of_tiles}, {"scale", t.scale},
                                  {"rotation_degrees", in_degrees(t.rotation)},
                                  {"distortion", { {"mean", t.mean_distortion}, {"max", t.maximum_distortion} }}, {"closest", t.is_closest},
                                  {"wound_vertices", t.number_of_wound_vertices},
                                  {"quasi_conformal_mean", { {"before", t.mean_factor_before}, {"after", t.mean_factor} }} };
  json["seams"] = std::move(seams);
  if(! figures.report.handles.loops.empty())
    json["handles"] = json_handles(figures.report.handles);
  return json;
}

nlohmann::ordered_json json_lattices(const Report& report)
{
  auto lattices = nlohmann::ordered_json::array();
  for(const auto& lattice : report.lattices)
    lattices.push_back({ {"face", lattice.face}, {"periods", lattice.periods}, {"tau", lattice.tau} });
  return lattices;
}

// How one component was mapped by itself.
void add_json_mapping(const Options& options, const Mapped_component& component, nlohmann::ordered_json& json)
{
  const CE::Statistics& s = component.statistics;
  const CE::Tiling& t = component.tiling;
  json["newton_steps"] = s.number_of_iterations;
  json["flips"] = s.number_of_flips;
  json["residual"] = s.residual;
  if(options.target != Target::PLANE)
    json["centre"] = component.centre;
  if(t.symmetry != 0)
    json["seamless"] = { {"tiles", t.number_of_tiles}, {"scale", t.scale}, {"rotation_degrees", in_degrees(t.rotation)},
                         {"distortion", { {"mean", t.mean_distortion}, {"max", t.maximum_distortion} }}, {"closest", t.is_closest},
                         {"wound_vertices", t.number_of_wound_vertices} };
}

// Null if there is only one.
nlohmann::ordered_json json_components(const Options& options, const Figures& figures)
{
  if(figures.component_figures.empty())
    return nullptr;
  auto components = nlohmann::ordered_json::array();
  for(std::size_t c = 0; c < figures.component_figures.size(); ++c)
  {
    const Component_figures& component = figures.component_figures[c];
    components.push_back({ {"face", figures.given->face(component.first_face)}, {"triangles", component.topology.number_of_faces},
                           {"borders", component.topology.number_of_borders}, {"genus", component.topology.genus},
                           {"u_min", component.u_min}, {"u_max", component.u_max}, {"cones", component.number_of_cones} });
    if(! figures.components.empty() && (options.target != Target::PLANE || options.seamless))
      add_json_mapping(options, figures.components[c], components.back());
  }
  return components;
}

// NaN becomes null.
void add_json_image(const Options& options, const Figures& figures, nlohmann::ordered_json& json)
{
  const Image_figures& image = figures.image;
  json["flipped_by_rounding"] = image.lost_faces.size();
  json["cross_ratio_error"] = image.cross_ratio_error;
  if(options.target == Target::DISK)
    json["unit_circle_error"] = image.distance_from_sphere;
  else
  {
    json["unit_sphere_error"] = image.distance_from_sphere;
    json["solid_angle"] = image.solid_angle;
    json["barycentre"] = image.barycentre;
  }
}

} // namespace

std::string json_report(const Options& options, const Mesh& mesh, const Figures& figures)
{
  const CE::Statistics& s = figures.report.statistics;
  const CE::Surface_topology& t = figures.report.topology;
  nlohmann::ordered_json json;
  begin_report(options, json);
  json["status"] = status_text(figures);
  json["target"] = target_text(options.target);
  json["vertices"] = figures.given->number_of_vertices;
  json["faces"] = figures.given->number_of_faces;
  json["triangles"] = mesh.number_of_faces();
  json["repair"] = json_repair(*figures.given);
  json["isolated_vertices"] = figures.number_of_isolated_vertices;
  json["genus"] = t.genus;
  json["borders"] = t.number_of_borders;
  json["components"] = t.number_of_components;
  json["component_figures"] = json_components(options, figures);
  json["retriangulation"] = { {"mode", mode_text(options)}, {"class", class_text(s)}, {"flips", s.number_of_flips},
                              {"resolving_flips", s.number_of_resolving_flips}, {"doubled", s.is_doubled},
                              {"lost_border_edges", figures.report.lost_border_edges.size()},
                              {"lost_border_length_error", figures.border_length_error},
                              {"straight_cross_ratio_error", figures.cross_ratio_error} };
  json["refinement"] = nullptr;
  if(figures.is_refined)
    json["refinement"] = { {"crossings", figures.number_of_crossings}, {"vertices", figures.number_of_made_vertices},
                           {"faces", figures.number_of_made_faces} };
  json["local_repair"] = nullptr;
  if(options.local_repair)
    json["local_repair"] = { {"flips", figures.repair.number_of_flips}, {"splits", figures.repair.number_of_splits},
                             {"vertices", figures.number_of_made_vertices}, {"faces", figures.number_of_made_faces} };
  json["newton_steps"] = s.number_of_iterations;
  json["pcg_iterations"] = s.number_of_linear_iterations;
  json["factorizations"] = s.number_of_factorizations;
  json["precision_bits"] = options.precision_in_bits;
  json["residual"] = s.residual;
  json["residual_floor"] = s.residual_floor;
  json["tolerance"] = options.tolerance;
  json["u_min"] = figures.u_min;
  json["u_max"] = figures.u_max;
  json["cones"] = json_cones(figures.report);
  json["flattened_cones"] = json_flattened_cones(figures);
  json["seamless"] = json_seamless(figures);
  json["seam_edges"] = figures.report.transitions.size();
  json["lattices"] = json_lattices(figures.report);
  const bool has_factor = figures.distortion.number_of_skipped_faces
                          != (figures.number_of_made_faces != 0 ? figures.number_of_made_faces : mesh.number_of_faces());
  json["quasi_conformal"] = { {"mean", has_factor ? figures.distortion.mean_quasi_conformal_factor : not_a_number},
                              {"max", has_factor ? figures.distortion.maximum_quasi_conformal_factor : not_a_number},
                              {"triangles_without_area", figures.distortion.number_of_skipped_faces} };
  json["flipped_triangles"] = figures.verdict.number_of_flipped_triangles;
  json["degenerate_triangles"] = figures.verdict.number_of_degenerate_triangles;
  json["triangles_lost_in_double"] = figures.number_of_rounded_triangles;
  json["injective"] = injective_text(figures);
  json["layout_length_error"] = figures.report.layout_length_error;
  if(options.target != Target::PLANE)
    add_json_image(options, figures, json);
  json["seconds"] = { {"import", figures.reading_seconds + s.seconds.import}, {"place", figures.placing_seconds}, {"solve", s.seconds.solve},
                      {"cut", s.seconds.cut}, {"layout", s.seconds.layout},
                      {"verify", s.seconds.verify + figures.verifying_seconds}, {"write", figures.writing_seconds} };
  json["notices"] = figures.notices;
  json["peak_memory_bytes"] = peak_memory_bytes();
  json["seed"] = nullptr;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}
#endif

} // namespace flattening
