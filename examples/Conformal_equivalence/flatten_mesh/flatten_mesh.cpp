// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/flatten_mesh.h"
#include "../include/flatten_mesh/conditions.h"
#include "../include/flatten_mesh/doors.h"
#include "../include/flatten_mesh/figures.h"
#include "../include/flatten_mesh/mesh.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/options.h"
#include "../include/flatten_mesh/Output_files.h"
#include "../include/flatten_mesh/Polygon_soup.h"
#include "../include/flatten_mesh/solve.h"
#include "../include/flatten_mesh/Stopwatch.h"
#include "../include/flatten_mesh/write_outputs.h"

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/multiprecision.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>
#include <CGAL/Conformal_equivalence/version.h>
#include <CGAL/version.h>

#include <cstddef>
#include <exception>
#include <new>
#include <ostream>
#include <string>
#include <vector>

namespace flattening {

namespace {

// What may help.
const char* advice(const Options& options, const Report& report)
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
[[noreturn]] void fail_to_flatten(const Options& options, const Report& report)
{
  fail(options.input, ": ", CE::message(report), advice(options, report));
}

std::string list_of_faces(const std::vector<Face>& faces)
{
  std::string list;
  for(std::size_t i = 0; i < faces.size() && i < 10; ++i)
    list += text(i == 0 ? " " : ", ", faces[i].idx());
  return faces.size() > 10 ? list + ", ..." : list;
}

// On the sphere and the disk: how many triangles rounding has cost.
std::string lost_triangles(const Options& options, const Figures& figures)
{
  const std::vector<Face>& faces = figures.image.lost_faces;
  return text(options.input, ": ", count(faces.size(), "triangle is", "triangles are"), " not positive, because points were rounded: ",
              faces.size() == 1 ? "face" : "faces", list_of_faces(faces), figures.is_refined ? " of the refined mesh" : "",
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
         list_of_faces(verdict.flipped_faces));
  if(options.require_injective && verdict.injectivity != CE::Injectivity::YES)
    fail(options.input, ": the layout is ", verdict.injectivity == CE::Injectivity::NO ? "not" : "not known to be", " injective",
         verdict.number_of_degenerate_triangles != 0 ? text(": degenerate faces", list_of_faces(verdict.degenerate_faces))
                                                     : text(": its border overlaps in ", verdict.crossing_borders.size(), " places"));
}

// Reads, solves, judges, writes; throws a `Failure` that says what went wrong.
void run(const Options& options, std::ostream& out, std::ostream& err)
{
  const Material_files beside(options.target == Target::SPHERE ? "" : options.obj); // there is no texture on the sphere
  Output_files files;
  announce_outputs(options, beside, files);

  const CE::Working_precision precision(options.precision_in_bits);
  const Stopwatch watch;
  Mesh mesh;
  const Polygon_soup soup = read_mesh(options.input, mesh);
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
  for(const std::string& notice : soup.notices)
    err << "flatten_mesh: " << one_line(text(options.input, ": ", notice)) << std::endl;
  print_summary(out, options, mesh, figures);
  if(! figures.image.lost_faces.empty())
    err << "flatten_mesh: " << one_line(lost_triangles(options, figures)) << std::endl;
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
