// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// hyperbolic [--header] MESH...
//
// Hyperbolic surfaces of closed meshes; those that are not connected or have a genus below 2 are passed over. `plate:N:G` is a thin plate of about
// N vertices with G handles. Beside the seconds of the hyperbolic metric those of a Euclidean one of the same mesh, also with flips, whose
// curvature is spread evenly over the vertices: processor seconds, the least of several runs, which take turns. --header: the head of
// the table of rows.

#include "../include/Processor_stopwatch.h"
#include "../include/benchmark_meshes.h"
#include "../include/plates.h"
#include "../include/table.h"

#include <CGAL/Conformal_equivalence/Exact_hyperbolic_surface.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/compute_hyperbolic_metric.h>
#include <CGAL/Conformal_equivalence/uniformize_hyperbolic.h>

#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <limits>
#include <string>

namespace {

using namespace benchmarks;
namespace CE = CGAL::Conformal_equivalence;

Mesh mesh_of(const std::string& specification)
{
  if(specification.compare(0, 6, "plate:") != 0)
    return make_mesh(specification);
  const std::size_t colon = specification.find(':', 6);
  return Plate(std::strtoul(specification.c_str() + 6, nullptr, 10), std::strtoul(specification.c_str() + colon + 1, nullptr, 10), true).mesh();
}

double seconds_of_euclidean_metric(const CE::Intrinsic_triangulation<double>& t, double euler_characteristic)
{
  CE::Conformal_conditions<double> conditions(t);
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    conditions.prescribe_angle_sum(v, 2 * CGAL_PI * (1 - euler_characteristic / t.number_of_vertices()));
  const Processor_stopwatch watch;
  CE::Solver_options options;
  options.has_come_from_flips = true; // it is not tried without any
  const auto metric = CE::Conformal_metric_solver<double>(t).solve(conditions, options);
  return metric ? watch.seconds() : std::nan("");
}

void print(const std::string& specification)
{
  const Mesh mesh = mesh_of(specification);
  const auto imported = CE::import_mesh(mesh);
  if(imported.status != CE::Status::OK)
    return;
  const auto& t = imported.triangulation;
  const CE::Surface_components pieces = CE::connected_components(t);
  if(pieces.components.size() != 1 || pieces.components[0].number_of_borders != 0 || pieces.components[0].genus() < 2
     || pieces.number_of_isolated_vertices != 0)
    return;
  double seconds = std::numeric_limits<double>::infinity(), euclidean = seconds;
  CE::Hyperbolic_metric<double> metric;
  for(std::uint32_t n = 0; n < 1 + 20000 / t.number_of_vertices() && n < 5; ++n)
  {
    const Processor_stopwatch watch;
    metric = CE::compute_hyperbolic_metric(t, CE::Conformal_conditions<double>(t));
    seconds = (std::min)(seconds, watch.seconds());
    euclidean = (std::min)(euclidean, seconds_of_euclidean_metric(t, double(pieces.components[0].euler_characteristic())));
  }
  const Processor_stopwatch watch_of_all;
  const auto u = CE::uniformize_hyperbolic(mesh);
  const double seconds_of_all = watch_of_all.seconds();
  const Processor_stopwatch watch_of_exact;
  const auto exact = CE::realize_exactly(u);
  const double genus = double(pieces.components[0].genus());
  print_row({ name_of(specification), to_text(t.number_of_vertices(), 9), to_text(genus, 9), CE::message(metric.status),
              to_text(metric.statistics.number_of_iterations, 9), to_text(metric.statistics.number_of_factorizations, 9),
              to_text(metric.flips.size(), 9), to_text(metric.statistics.residual, 2), to_text(metric.area / (4 * CGAL_PI * (genus - 1)) - 1, 2),
              to_text(seconds, 3), to_text(euclidean, 3), to_text(seconds / euclidean, 3), to_text(seconds_of_all, 3),
              to_text(u.relation_error, 2), CE::message(exact.status), to_text(exact.number_of_digits(), 9),
              to_text(exact.largest_length_difference(), 2), to_text(watch_of_exact.seconds(), 3) });
}

} // namespace

int main(int argc, char* argv[])
{
  for(int i = 1; i < argc; ++i)
    try
    {
      if(std::string(argv[i]) == "--header")
        print_head({ "mesh", "vertices", "genus", "metric", "steps", "factors", "flips", "residual", "area error", "s", "s Euclidean", "ratio",
                     "s with layout", "relation error", "exact", "digits", "length difference", "s exact" });
      else
        print(argv[i]);
    }
    catch(const std::exception& e)
    {
      std::cerr << argv[i] << ": " << e.what() << std::endl;
    }
  return EXIT_SUCCESS;
}
