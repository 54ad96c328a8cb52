// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/flatten_mesh.h"
#include "../include/flatten_mesh/conditions.h"
#include "../include/flatten_mesh/doors.h"
#include "../include/flatten_mesh/explain.h"
#include "../include/flatten_mesh/figures.h"
#include "../include/flatten_mesh/Given_surface.h"
#include "../include/flatten_mesh/hyperbolic.h"
#include "../include/flatten_mesh/layout_files.h"
#include "../include/flatten_mesh/mesh.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/OBJ_attribute_writer.h"
#include "../include/flatten_mesh/option_table.h"
#include "../include/flatten_mesh/options.h"
#include "../include/flatten_mesh/Output_files.h"
#include "../include/flatten_mesh/Progress.h"
#include "../include/flatten_mesh/several_inputs.h"
#include "../include/flatten_mesh/side_by_side.h"
#include "../include/flatten_mesh/solve.h"
#include "../include/flatten_mesh/Stopwatch.h"
#include "../include/flatten_mesh/write_outputs.h"

#include <CGAL/Conformal_equivalence/multiprecision.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>
#include <CGAL/Conformal_equivalence/version.h>
#include <CGAL/version.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <new>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace flattening {

namespace {

// Faces of the mesh that is written.
std::string list_of_faces(const std::vector<Face>& faces, const Figures& figures)
{
  std::string list;
  for(std::size_t i = 0; i < faces.size() && i < 10; ++i)
    list += text(i == 0 ? " " : ", ", figures.number_of_made_faces != 0 ? faces[i].idx() : figures.given->face(faces[i]));
  return faces.size() > 10 ? list + ", ..." : list;
}

// On the sphere and the disk: how many triangles rounding has cost.
std::string lost_triangles(const Options& options, const Figures& figures)
{
  const std::vector<Face>& faces = figures.image.lost_faces;
  return text(options.input, ": ", count(faces.size(), "triangle is", "triangles are"), " not positive, because points were rounded: ",
              faces.size() == 1 ? "face" : "faces", list_of_faces(faces, figures), figures.is_refined ? " of the refined mesh" : "",
              " (--precision BITS has more digits)");
}

void require_verdict(const Options& options, const Figures& figures)
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
         list_of_faces(verdict.flipped_faces, figures));
  if(options.require_injective && verdict.injectivity != CE::Injectivity::YES)
    fail(options.input, ": the layout is ", verdict.injectivity == CE::Injectivity::NO ? "not" : "not known to be", " injective",
         verdict.number_of_degenerate_triangles != 0 ? text(": degenerate faces", list_of_faces(verdict.degenerate_faces, figures))
                                                     : text(": its border overlaps in ", verdict.crossing_borders.size(), " places"));
}

// What of the file was skipped.
std::vector<std::string> notices_of_input(const Options& options, const Given_surface& given)
{
  std::vector<std::string> result;
  for(const std::string& notice : given.notices)
    result.push_back(one_line(text(options.input, ": ", notice)));
  return result;
}

// What is said beside the figures: what of the file was skipped, or is not written.
std::vector<std::string> notices(const Options& options, const Given_surface& given, const Result& drawn, const Material_files& beside,
                                 const Figures& figures)
{
  std::vector<std::string> result;
  const auto say = [&](const auto&... parts) { result.push_back(one_line(text(options.input, ": ", parts...))); };
  if(figures.is_search_stopped)
    say("interrupted: the cones are the best that were found by then");
  for(const std::string& notice : notices_of_input(options, given))
    result.push_back(notice);
  if(! options.obj.empty() && ! given.attributes.face_normals.empty() && (options.target == Target::SPHERE || ! drawn.given_face.empty()))
    say("its normals are not written: they are not those of the mesh that is written");
  if(! options.obj.empty() && ! given.attributes.colors.empty() && ! drawn.given_face.empty())
    say("the colours of its vertices are not written: they are not those of the mesh that is written");
  if(options.projective && ! options.obj.empty())
    say("texture coordinates of the OBJ file are homogeneous, u w, v w, w: programs that do not divide by w show them wrong "
        "(-o *.glb and -o *.ply have u, v and w)");
  if(! beside.material.empty() && texture_pattern(options) == Pattern::HEXAGON_TILES && ! options.lattice_coordinates)
    say("the checkerboard beside the OBJ file does not fit hexagons: the hexagons of --lattice-coordinates do, and those of -o *.glb");
  if(! beside.foreign_material.empty())
    result.push_back(one_line(text("the material is in ", beside.material, ": ", beside.foreign_material,
                                   " was not written by this program, and is kept")));
  if(! figures.image.lost_faces.empty())
    result.push_back(one_line(lost_triangles(options, figures)));
  return result;
}

// Why there is no result, and for which component if each was mapped by itself.
std::string reason_of_failure(const Options& options, const Given_surface& given, const Results& results, const Conditions& conditions,
                              const Report& report)
{
  if(is_interrupted())
    return results.is_search_futile ? "interrupted before a metric was found for any of the cones placed by then, so that there is nothing to keep"
                                    : "interrupted";
  const Mesh& mesh = results.given.mesh;
  if(results.components.empty() || CE::is_success(results.components.back().status))
    return explanation(options, given, mesh, conditions, report, Mesh::null_face());
  const Mapped_component& component = results.components.back();
  return name_of_component(given, component.first_face, component.number_of_faces)
       + explanation(options, given, mesh, conditions, report, component.first_face);
}

// Whether it is the refinement that is written.
bool make_refinement_if_needed(const Options& options, const Report& report, Results& results)
{
  if(options.seamless) // it was made together with its layout
    return results.made.mesh.number_of_faces() != 0;
  const bool is_needed = is_refinement_needed(options, report, results.refinement);
  if(is_needed)
    make_refined_mesh(options, results.given, results.refinement, results.made);
  return is_needed;
}

// Solves, judges, writes. Returns names and values for the terminal.
Lines flatten_and_write(const Options& options, const Given_surface& given, Mesh& mesh, Material_files& beside, Progress& progress, Figures& figures,
                        Output_files& files)
{
  Conditions conditions(given, mesh);
  set_conditions(options, mesh, given, progress, conditions);
  Results results(mesh);
  figures.report = flatten(options, conditions, results, progress);
  name_as_given(given, figures.report);
  if(! figures.report)
    fail(options.input, ": ", reason_of_failure(options, given, results, conditions, figures.report));
  progress.begin("judging");
  find_range_of_u(results.given, figures);
  describe_components(results.given, figures);

  const bool is_refined = make_refinement_if_needed(options, figures.report, results);
  Result& drawn = is_refined || options.local_repair ? results.made : results.given;
  if(options.target != Target::PLANE && ! results.components.empty())
    place_images_side_by_side(options.target, results);
  describe_made_mesh(results, is_refined, figures);
  judge(options, results.given, drawn, figures);
  require_verdict(options, figures);
  figures.notices = notices(options, given, drawn, beside, figures);
  progress.begin("writing");
  write_outputs(options, mesh, drawn, beside, figures, files);
  return summary(options, mesh, figures);
}

// Reads, maps, writes, tells; throws a `Failure` that says what went wrong.
void run(const Options& given_options, Output_files& files, std::ostream& out, std::ostream& err)
{
  Options options = given_options;
  Material_files beside = material_files(options);
  announce_outputs(options, beside, files);

  const CE::Working_precision precision(options.precision_in_bits);
  const Stopwatch watch;
  std::optional<Progress> progress(std::in_place, err, kind_of_progress(err, options.quiet));
  progress->begin("reading");
  Mesh mesh;
  const Given_surface given = read_surface(options.input, options.repair, mesh, options.format);
  options = with_vertices_of_mesh(options, given);
  if(all_faces_have_a_material(given.attributes))
    withdraw_material(beside, files);
  Figures figures;
  figures.given = &given;
  figures.reading_seconds = watch.seconds();

  if(options.target == Target::HYPERBOLIC)
    figures.notices = notices_of_input(options, given);
  const Lines lines = options.target == Target::HYPERBOLIC ? make_hyperbolic_surface(options, given, mesh, watch, *progress, files)
                                                           : flatten_and_write(options, given, mesh, beside, *progress, figures, files);
  progress.reset();
  if(options.quiet)
    return;
  print_summary(is_output_in_stream(options) ? err : out, options, lines);
  for(const std::string& notice : figures.notices)
    err << "flatten_mesh: " << notice << std::endl;
}

// Returns whether each input was flattened; of one alone, throws what went wrong.
bool run_all(const Options& all, std::ostream& out, std::ostream& err)
{
  check_solver(all.solver);
  if(all.inputs.size() > 1)
    return run_each(all, [&](const Options& options, Output_files& files) { run(options, files, out, err); }, out, err);
  Output_files files(out);
  run(options_of_input(all, 0), files, out, err);
  return true;
}

} // namespace

} // namespace flattening

int flatten_mesh(int argc, const char* const argv[], std::ostream& out, std::ostream& err)
{
  using namespace flattening;
  try
  {
    const Options options = parse_options(argc, argv);
    if(options.is_help)
      out << help_text();
    else if(options.is_version)
      out << "flatten_mesh " << CGAL_CONFORMAL_EQUIVALENCE_VERSION << " (CGAL " << CGAL_VERSION_STR << ")\n";
    else if(! options.printed.empty())
      out << printed_text(options.printed);
    else
      return ! run_all(options, out, err) ? 1 : is_interrupt_heeded() ? 3 : 0;
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
