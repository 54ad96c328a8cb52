// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/explain.h"
#include "../include/flatten_mesh/Components.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/precision.h"

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>

#include <CGAL/number_utils.h>
#include <CGAL/squared_distance_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace flattening {

namespace {

std::string elements_text(const Report& report)
{
  return CE::internal::elements_text(report.vertex_indices, report.edge_indices, report.face_indices);
}

// Of angles that leave so many radians for others.
std::string angles_left(double radians)
{
  return text("the prescribed angles sum up to ", std::abs(in_degrees(radians)), " degrees too ", radians > 0 ? "little" : "much",
              ": on a component without fixed u they have to fit the Gauss-Bonnet formula");
}

// The message of the package, but in degrees. Residuals are in radians, as is --tolerance.
std::string message_in_degrees(const Report& report)
{
  const double amount = report.amount;
  switch(report.status)
  {
    case CE::Status::GAUSS_BONNET_VIOLATED:
      return angles_left(amount) + elements_text(report);
    case CE::Status::NO_ANGLE_LEFT:
    case CE::Status::ANGLE_OUT_OF_RANGE:
      return text(CE::message(report.status), ": ", in_degrees(amount), " degrees", elements_text(report));
    case CE::Status::MISSING_CONDITION:
      return amount == 0 ? CE::message(report)
                         : text(CE::message(report.status), ": a closed surface of genus other than 1 needs cones, whose curvatures "
                                "(360 - angle) sum up to ", in_degrees(amount), " degrees", elements_text(report));
    case CE::Status::NOT_QUANTIZABLE:
      return text(CE::message(report.status), ": they must sum up to ", in_degrees(amount), " degrees", elements_text(report));
    case CE::Status::NOT_SEAMLESS:
      return text(CE::message(report.status), ": they differ by a rotation by ", in_degrees(amount), " degrees", elements_text(report));
    default:
      return CE::message(report);
  }
}

// ---- Sums of angles

// The radians that the prescribed angles leave on one component: 0 if u is fixed somewhere.
struct Component_balance
{
  double left = 0;
  bool has_fixed_vertex = false;
};

// By component, from the Gauss-Bonnet formula.
std::vector<Component_balance> balances(const Mesh& mesh, const Conditions& conditions)
{
  const auto imported = CE::import_mesh(mesh);
  const auto& t = imported.triangulation;
  const CE::Surface_components pieces = CE::connected_components(t);
  std::vector<Component_balance> result(pieces.components.size());
  for(std::size_t c = 0; c < result.size(); ++c)
    result[c].left = -2 * CGAL_PI * double(pieces.components[c].euler_characteristic());
  for(std::uint32_t i = 0; i < t.number_of_vertices(); ++i)
  {
    if(t.is_isolated_vertex(i))
      continue;
    const Vertex v = imported.vertex(i);
    Component_balance& balance = result[pieces.component_of_vertex[i]];
    balance.has_fixed_vertex = balance.has_fixed_vertex || conditions.is_constrained[v];
    balance.left += t.is_border_vertex(i) ? CGAL_PI - conditions.border_angle[v] : 2 * CGAL_PI - conditions.cone_angle[v];
  }
  return result;
}

// An angle out of its range may be the reason why the angles do not sum up, or just one of those that do not: that they do not is said first. If
// `face` is one, only its component counts.
std::string wrong_sum_of_angles(const Mesh& mesh, const Conditions& conditions, Face face)
{
  const double rounding = 1e-9;
  const std::vector<Component_balance> all = balances(mesh, conditions);
  const std::size_t one = face == Mesh::null_face() ? all.size() : Components(mesh).of_face(face);
  for(std::size_t c = 0; c < all.size(); ++c)
  {
    const Component_balance& balance = all[c];
    if((one == all.size() || one == c) && ! balance.has_fixed_vertex && ! (std::abs(balance.left) <= rounding))
      return angles_left(balance.left);
  }
  return "";
}

// ---- Lengths

// Where u is fixed at all vertices of a triangle that is broken, the conditions alone break it: the edge that is too long.
std::string edge_too_long(const Given_surface& given, const Mesh& mesh, const Conditions& conditions, const Report& report)
{
  for(Face f : report.faces)
  {
    const auto v = vertices_of_face(mesh, f);
    if(! std::all_of(v.begin(), v.end(), [&](Vertex w) { return conditions.is_constrained[w]; }))
      continue;
    std::array<double, 3> length;
    for(std::size_t k = 0; k < 3; ++k)
      length[k] = std::sqrt(CGAL::squared_distance(mesh.point(v[k]), mesh.point(v[(k + 1) % 3])))
                * std::exp((conditions.u[v[k]] + conditions.u[v[(k + 1) % 3]]) / 2);
    const std::size_t k = static_cast<std::size_t>(std::max_element(length.begin(), length.end()) - length.begin());
    const double others = length[(k + 1) % 3] + length[(k + 2) % 3];
    if(length[k] >= others)
      return text(": the prescribed u give the edge ", given.vertex(v[k]), "-", given.vertex(v[(k + 1) % 3]), " the length ", length[k],
                  ", and the other edges of face ", given.face(f), " only ", others, " together");
  }
  return "";
}

// ---- What may help

bool keeps_triangulation(const Options& options)
{
  return ! options.local_repair && options.retriangulation == CE::Retriangulation::NEVER;
}

bool is_computed_in_double_only(const Options& options)
{
  return options.local_repair || options.seamless || options.places_cones;
}

const char* const flips = " (--retriangulate never; other values flip edges)";

std::string list_of(const std::vector<std::string>& words)
{
  std::string list;
  for(std::size_t i = 0; i < words.size(); ++i)
    list += (i == 0 ? "" : i + 1 == words.size() ? " or " : ", ") + words[i];
  return list;
}

// Where the iteration does not converge, or its linear system has no solution.
std::string advice_to_converge(const Options& options, const Report& report)
{
  std::vector<std::string> options_that_help;
  const bool is_stopped = report.statistics.number_of_iterations >= options.maximum_number_of_iterations;
  if(is_stopped && report.status == CE::Status::ITERATIONS_EXHAUSTED)
    options_that_help.push_back("--max-iterations above " + std::to_string(options.maximum_number_of_iterations));
  if(! options.local_repair && options.retriangulation == CE::Retriangulation::WHEN_NEEDED)
    options_that_help.push_back("--retriangulate always");
  const double range_of_u = report.statistics.largest_u - report.statistics.least_u, far_range = 100;
  const bool has_gone_far = report.status == CE::Status::ITERATIONS_EXHAUSTED && range_of_u > far_range;
  if(has_gone_far && ! options.local_repair && options.retriangulation == CE::Retriangulation::ALWAYS)
    options_that_help.push_back("--retriangulate when-needed, which keeps the triangles of steep surfaces,");
  if(! is_computed_in_double_only(options))
    options_that_help.push_back(options.precision_in_bits == bits_of_double
                                ? "--precision 200" : "--precision above " + std::to_string(options.precision_in_bits));
  if(options.mollification == 0)
    options_that_help.push_back("--mollify 1e-4");
  const std::string flipping = has_gone_far ? text("u has come to range over ", range_of_u)
                             : keeps_triangulation(options) ? "--retriangulate never; other values flip edges" : "",
                    others = options_that_help.empty() ? "" : list_of(options_that_help) + " may help";
  return flipping.empty() && others.empty() ? "" : " (" + flipping + (flipping.empty() || others.empty() ? "" : "; ") + others + ")";
}

std::string advice_on_topology(const Options& options)
{
  return options.target == Target::SPHERE ? "; --target sphere takes closed surfaces of genus 0"
       : options.target == Target::DISK ? "; --target disk takes surfaces of genus 0 with one border" : "";
}

// Lengths are scaled by e^u: where that ranges further than the digits of a number do, points that differ are rounded to the same one. With
// some more digits they are not.
std::string precision_for(const Options& options, double range_of_u)
{
  const double range = range_of_u / std::log(2.), digits_that_triangles_need = 64;
  const double certain = options.target == Target::PLANE ? range : 2 * range; // there the areas of triangles are beside coordinates of about 1
  const double bits = std::ceil((certain + digits_that_triangles_need) / 64) * 64;
  return bits <= most_bits ? text("--precision ", bits) : "";
}

std::string advice_on_range(const Options& options, const CE::Statistics& statistics)
{
  const double range = statistics.largest_u - statistics.least_u;
  if(! (range > std::log(2.) * (options.precision_in_bits - 20)))
    return "";
  const std::string precision = precision_for(options, range);
  if(precision.empty())
    return text(" (u ranges from ", statistics.least_u, " to ", statistics.largest_u, ", further than coordinates of ", most_bits, " bits)");
  return text(" (u ranges from ", statistics.least_u, " to ", statistics.largest_u, ", further than the ", options.precision_in_bits,
              " bits of coordinates: ", precision, options.target != Target::PLANE ? " or more helps)" :
              ", or cones where triangles are lost, help)");
}

// Where not even the factors are in range.
std::string advice_on_scale(const Options& options, double range_of_u)
{
  if(is_computed_in_double_only(options))
    return "";
  const std::string precision = precision_for(options, range_of_u);
  return precision.empty() ? text(" (further than coordinates of ", most_bits, " bits)") : " (" + precision + " or more helps)";
}

// Where edges were flipped, the parts of triangles can be laid out although straight triangles cannot; `is_one_of_several`: components.
std::string advice_on_seamless(const Options& options, const CE::Statistics& statistics, bool is_one_of_several)
{
  return statistics.number_of_flips != 0 && ! options.refine && ! is_one_of_several
       ? " (edges were flipped: --refine lays out the parts into which they cut the triangles; more --tiles or other --cones may help, too)"
       : " (more --tiles or other --cones may help)";
}

std::string advice_on_injectivity(const Options& options, const CE::Statistics& statistics, bool is_one_of_several)
{
  if(options.target != Target::PLANE && keeps_triangulation(options))
    return flips;
  if(options.seamless || options.places_cones) // not by rounding
    return options.seamless ? advice_on_seamless(options, statistics, is_one_of_several) : "";
  const std::string on_range = options.local_repair ? "" : advice_on_range(options, statistics);
  if(! on_range.empty())
    return on_range;
  return options.precision_in_bits == bits_of_double && ! options.local_repair ? " (--precision BITS has more digits)" : "";
}

std::string advice(const Options& options, const Report& report, bool is_one_of_several)
{
  switch(report.status)
  {
    case CE::Status::ANGLE_OUT_OF_RANGE:
      return keeps_triangulation(options) && report.amount > 0 ? flips : "";
    case CE::Status::DEGENERATE_METRIC:
      return keeps_triangulation(options) ? flips : "";
    case CE::Status::ITERATIONS_EXHAUSTED:
    case CE::Status::SINGULAR_PROBLEM:
      return advice_to_converge(options, report);
    case CE::Status::SCALE_OUT_OF_RANGE:
      return advice_on_scale(options, report.amount);
    case CE::Status::WRONG_TOPOLOGY:
      return advice_on_topology(options);
    case CE::Status::NO_ANGLE_LEFT:
      return report.topology.genus == 0 && report.topology.number_of_borders == 0 ? " (a sphere needs three cones, at least)" : "";
    case CE::Status::MISSING_CONDITION:
      return options.places_cones ? " (a sphere needs three cones, at least)" : options.cone_file.empty() ? " (--cones FILE or --cones auto=N)" : "";
    case CE::Status::ZERO_LENGTH_EDGE:
      return options.repair ? " (--mollify gives them a length)" : " (--repair merges equal points; --mollify gives such edges a length)";
    case CE::Status::BOUND_NOT_MET:
      return " (more cones, or a looser bound, may help)";
    case CE::Status::NOT_INJECTIVE:
      return advice_on_injectivity(options, report.statistics, is_one_of_several);
    default:
      return "";
  }
}

} // namespace

std::string explanation(const Options& options, const Given_surface& given, const Mesh& mesh, const Conditions& conditions, const Report& report,
                        Face face)
{
  const std::string its_advice = advice(options, report, face != Mesh::null_face());
  if(report.status == CE::Status::ANGLE_OUT_OF_RANGE && report.amount > 0)
  {
    const std::string sum = wrong_sum_of_angles(mesh, conditions, face);
    if(! sum.empty())
      return sum;
  }
  if(report.status == CE::Status::DEGENERATE_METRIC)
  {
    const std::string edge = edge_too_long(given, mesh, conditions, report);
    if(! edge.empty())
      return CE::message(report.status) + edge + its_advice;
  }
  return message_in_degrees(report) + its_advice;
}

} // namespace flattening
