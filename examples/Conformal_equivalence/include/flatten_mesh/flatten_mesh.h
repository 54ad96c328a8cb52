// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The program flatten_mesh as a function, to be run also within another program.

#ifndef FLATTEN_MESH_FLATTEN_MESH_H
#define FLATTEN_MESH_FLATTEN_MESH_H

#include "conditions.h"
#include "figures.h"
#include "mesh.h"
#include "messages.h"
#include "options.h"
#include "Output_files.h"
#include "refine.h"
#include "results.h"
#include "seamless.h"
#include "solve.h"
#include "sphere.h"
#include "Stopwatch.h"
#include "write_HTML.h"
#include "write_material.h"
#include "write_SVG.h"

#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <new>
#include <ostream>
#include <string>
#include <vector>

namespace flattening {

// The files beside an OBJ file.
struct Material_files
{
  std::string material, texture;

  explicit Material_files(const std::string& obj)
  {
    const std::filesystem::path path(obj);
    std::error_code ignored;
    if(path.extension().empty() || (std::filesystem::exists(path, ignored) && ! std::filesystem::is_regular_file(path, ignored)))
      return; // a device, for example
    material = std::filesystem::path(path).replace_extension(".mtl").string();
    texture = std::filesystem::path(path).replace_extension(".checker.png").string();
  }
};

inline std::string name_without_folder(const std::string& file)
{
  return std::filesystem::path(file).filename().string();
}

inline void announce_outputs(const Options& options, const Material_files& beside, Output_files& files)
{
  const std::vector<std::string> outputs = { options.obj, options.obj.empty() ? "" : beside.material,
                                             options.obj.empty() ? "" : beside.texture, options.svg, options.html, options.report };
  for(const std::string& file : outputs)
    for(const std::string& input : {options.input, options.cone_file, options.angle_file, options.scale_file})
    {
      std::error_code ignored;
      if(! file.empty() && ! input.empty() && std::filesystem::equivalent(file, input, ignored))
        throw Usage_error("the output " + file + " would overwrite the input");
    }
  for(const std::string& file : outputs)
    if(! file.empty())
      files.announce(file);
}

// What may help.
inline const char* advice(const Options& options, const Report& report)
{
  const char* flips = " (--retriangulate never; other values flip edges)";
  const bool keeps_triangulation = ! options.local_repair && options.retriangulation == CE::Retriangulation::NEVER;
  if(options.target != Target::PLANE && keeps_triangulation && report.status == CE::Status::NOT_INJECTIVE)
    return flips;
  switch(report.status)
  {
    case CE::Status::ANGLE_OUT_OF_RANGE:
      return keeps_triangulation && report.amount > 0 ? flips : "";
    case CE::Status::DEGENERATE_METRIC:
    case CE::Status::ITERATIONS_EXHAUSTED:
      return keeps_triangulation ? flips : "";
    case CE::Status::WRONG_TOPOLOGY:
      return options.target == Target::SPHERE ? "; --target sphere takes closed surfaces of genus 0, of one component"
           : options.target == Target::DISK ? "; --target disk takes surfaces of genus 0 with one border, of one component" : "";
    case CE::Status::MISSING_CONDITION:
      return options.places_cones ? " (a sphere: at least three)" : options.cone_file.empty() ? " (--cones FILE or --cones auto=N)" : "";
    case CE::Status::BOUND_NOT_MET:
      return " (more cones, or a looser bound, may help)";
    case CE::Status::NOT_INJECTIVE: // by rounding: the metric is one; or by a deformation
      if(options.seamless || options.places_cones)
        return options.seamless ? " (more --tiles or other --cones may help)" : "";
      return options.precision_in_bits == bits_of_double && ! options.local_repair ? " (--precision BITS has more digits)" : "";
    default:
      return "";
  }
}

// Says why there is no result.
[[noreturn]] inline void fail_to_flatten(const Options& options, const Report& report)
{
  fail(options.input, ": ", CE::message(report), advice(options, report));
}

inline std::string list_of_faces(const std::vector<Face>& faces)
{
  std::string list;
  for(std::size_t i = 0; i < faces.size() && i < 10; ++i)
    list += text(i == 0 ? " " : ", ", faces[i].idx());
  return faces.size() > 10 ? list + ", ..." : list;
}

// On the sphere and the disk: how many triangles rounding has cost.
inline std::string lost_triangles(const Options& options, const Figures& figures)
{
  const std::vector<Face>& faces = figures.image.lost_faces;
  return text(options.input, ": ", count(faces.size(), "triangle is", "triangles are"), " not positive, because points were rounded: ",
              faces.size() == 1 ? "face" : "faces", list_of_faces(faces), figures.is_refined ? " of the refined mesh" : "",
              " (--precision BITS has more digits)");
}

inline void require_verdict(const Options& options, const Figures& figures)
{
  const CE::Layout_verdict<Mesh>& verdict = figures.verdict;
  if(! figures.image.lost_faces.empty())
  {
    if(options.require_injective)
      fail(lost_triangles(options, figures));
    return;
  }
  if(verdict.number_of_flipped_triangles != 0)
    fail(options.input, ": the layout flips ", verdict.number_of_flipped_triangles, " triangles: faces",
         list_of_faces(verdict.flipped_faces));
  if(options.require_injective && verdict.injectivity != CE::Injectivity::YES)
    fail(options.input, ": the layout is ", verdict.injectivity == CE::Injectivity::NO ? "not" : "not known to be", " injective",
         verdict.number_of_degenerate_triangles != 0 ? text(": degenerate faces", list_of_faces(verdict.degenerate_faces))
                                                     : text(": its border overlaps in ", verdict.crossing_borders.size(), " places"));
}

// What gives a triangle its colour in the drawing.
inline Face_map<double> face_colors(const Options& options, const Result& result)
{
  Mesh& mesh = result.mesh;
  Face_map<double> value = mesh.add_property_map<Face, double>("f:color", 0.).first;
  for(Face f : mesh.faces())
  {
    const Halfedge h = mesh.halfedge(f);
    value[f] = options.color_by_quasi_conformal_factor
      ? CE::quasi_conformal_factor(mesh, result.uv, f)
      : (result.u[mesh.target(h)] + result.u[mesh.source(h)] + result.u[mesh.target(mesh.next(h))]) / 3;
  }
  return value;
}

inline HTML_options drawing_options(const Options& options, const Mesh& mesh, const Figures& figures)
{
  HTML_options drawing;
  drawing.title = name_without_folder(options.input);
  drawing.figures = summary(options, mesh, figures);
  if(options.seamless)
  {
    drawing.svg.tiles = figures.report.tiling.symmetry;
    drawing.svg.checkerboard = false;
  }
  drawing.svg.legend = options.color_by_quasi_conformal_factor ? "quasi-conformal factor" : "u";
  if(options.target == Target::SPHERE)
    drawing.svg = hemisphere_options(drawing.svg);
  else if(options.target == Target::DISK)
    drawing.svg.circles = { {{0, 0, 1}} };
  return drawing;
}

// The checkerboard of the material: about 20 squares along the layout.
inline double texture_repetitions(const Result& result)
{
  Finite_range x, y;
  for(Halfedge h : result.mesh.halfedges())
  {
    x.insert(result.uv[h].x());
    y.insert(result.uv[h].y());
  }
  const double longest = (std::max)(x.upper - x.lower, y.upper - y.lower);
  return longest > 0 && std::isfinite(longest) ? 0.5 / round_number_below(longest / 14) : 1;
}

// What fits across the seams of a layout of square tiles: a checkerboard of squares half as wide, one of them in the centre of each tile. That
// of pages has a corner at the origin.
inline HTML_options page_options(HTML_options drawing, const Figures& figures)
{
  if(has_squares(figures.report.tiling.symmetry))
  {
    drawing.svg.tiles = 0;
    drawing.svg.checkerboard = true;
    drawing.svg.square = .5;
  }
  return drawing;
}

inline UV_map page_layout(const Figures& figures, const Result& result)
{
  if(! has_squares(figures.report.tiling.symmetry))
    return result.uv;
  UV_map uv = result.mesh.add_property_map<Halfedge, Kernel::Point_2>("h:page_uv").first;
  for(Halfedge h : result.mesh.halfedges())
    uv[h] = Kernel::Point_2(result.uv[h].x() + .25, result.uv[h].y() + .25);
  return uv;
}

inline void write_sphere(const Options& options, const Result& result, Output_files& files)
{
  files.write(options.obj, [&](std::ostream& out)
  {
    return result.wide_image.empty() ? write_sphere_OBJ(out, result.mesh, result.image) : write_sphere_OBJ(out, result.mesh, result.wide_image);
  });
}

inline void write_obj(const Options& options, const Result& result, const Material_files& beside, Output_files& files)
{
  if(options.target == Target::SPHERE)
    return write_sphere(options, result, files);
  CE::IO::OBJ_material material;
  material.file = name_without_folder(beside.material);
  files.write(options.obj, [&](std::ostream& out)
  {
    const auto write = [&](const auto& uv)
    {
      return options.projective
        ? CE::IO::write_OBJ(out, result.mesh, uv, CGAL::parameters::projective_weight_map(result.weight), material)
        : CE::IO::write_OBJ(out, result.mesh, uv, CGAL::parameters::default_values(), material);
    };
    return result.wide.is_used ? write(result.wide.uv) : write(result.lattice_uv ? *result.lattice_uv : result.uv);
  });
  if(beside.material.empty())
    return;
  files.write(beside.material, [&](std::ostream& out)
  {
    if(options.seamless && has_squares(static_cast<int>(options.quanta_of_turn)))
    {
      write_tile_material(out, material.name, name_without_folder(beside.texture));
      return out.good();
    }
    return write_MTL(out, material.name, name_without_folder(beside.texture), texture_repetitions(result));
  });
  files.write(beside.texture, [](std::ostream& out) { return write_checkerboard_PNG(out); });
}

// `mesh` is what was given; `result` is drawn, of that mesh or of its refinement.
inline void write_outputs(const Options& options, const Mesh& mesh, Result& result, const Material_files& beside,
                          Figures& figures, Output_files& files)
{
  const Stopwatch watch;
  if(! options.obj.empty())
    write_obj(options, result, beside, files);
  if(! options.svg.empty() || ! options.html.empty())
  {
    const Face_map<double> colors = face_colors(options, result);
    const HTML_options drawing = drawing_options(options, mesh, figures);
    const UV_map layout = options.target == Target::SPHERE ? hemispheres(result) : result.uv;
    if(! options.svg.empty())
      files.write(options.svg, [&](std::ostream& out) { return write_SVG(out, result.mesh, layout, colors, drawing.svg); });
    if(! options.html.empty())
      files.write(options.html, [&](std::ostream& out)
      {
        return write_HTML(out, result.mesh, page_layout(figures, result), colors, page_options(drawing, figures),
                                  CGAL::parameters::projective_weight_map(result.weight));
      });
  }
  figures.writing_seconds = watch.seconds();
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  if(! options.report.empty())
    files.write(options.report, [&](std::ostream& out) { return (out << json_report(options, mesh, figures)).good(); });
#endif
  files.commit();
}

// Reads, solves, judges, writes; throws a `Failure` that says what went wrong.
inline void run(const Options& options, std::ostream& out, std::ostream& err)
{
  const Material_files beside(options.target == Target::SPHERE ? "" : options.obj); // there is no texture on the sphere
  Output_files files;
  announce_outputs(options, beside, files);

  const CE::Working_precision precision(options.precision_in_bits);
  const Stopwatch watch;
  Mesh mesh;
  read_mesh(options.input, mesh);
  Figures figures;
  figures.reading_seconds = watch.seconds();

  Conditions conditions(mesh);
  set_conditions(options, mesh, conditions);
  Results results(mesh);
  {
    Progress progress(err, ! options.quiet && is_terminal(err));
    figures.report = flatten(options, conditions, results, progress);
  }
  if(! figures.report)
    fail_to_flatten(options, figures.report);
  find_range_of_u(results.given, figures);

  const bool is_refined = is_refinement_needed(options, figures.report, results.refinement);
  if(is_refined)
    make_refined_mesh(options, results.given, results.refinement, results.made);
  Result& drawn = is_refined || options.local_repair ? results.made : results.given;
  describe_made_mesh(results, is_refined, figures);
  judge(options, results.given, drawn, figures);
  require_verdict(options, figures);
  write_outputs(options, mesh, drawn, beside, figures, files);
  if(options.quiet)
    return;
  print_summary(out, options, mesh, figures);
  if(! figures.image.lost_faces.empty())
    err << "flatten_mesh: " << one_line(lost_triangles(options, figures)) << std::endl;
}

} // namespace flattening

// The whole program: returns its exit status, 0 (done), 1 (failed, nothing is written) or 2 (wrong usage).
inline int flatten_mesh(int argc, const char* const argv[], std::ostream& out, std::ostream& err)
{
  using namespace flattening;
  try
  {
    const Options options = parse_options(argc, argv);
    if(options.is_help)
      out << help_text();
    else if(options.is_version)
      out << "flatten_mesh " << CGAL_CONFORMAL_EQUIVALENCE_VERSION << " (CGAL " << CGAL_VERSION_STR << ")\n";
    else
    {
      check_solver(options.solver);
      run(options, out, err);
    }
    return 0;
  }
  catch(const Usage_error& e)
  {
    err << "flatten_mesh: " << one_line(e.what()) << " (see flatten_mesh --help)" << std::endl;
    return 2;
  }
  catch(const std::bad_alloc&)
  {
    err << "flatten_mesh: out of memory" << std::endl;
  }
  catch(const std::exception& e)
  {
    err << "flatten_mesh: " << one_line(e.what()) << std::endl;
  }
  return 1;
}

#endif // FLATTEN_MESH_FLATTEN_MESH_H
