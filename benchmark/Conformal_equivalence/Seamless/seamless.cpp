// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Metrics of surfaces with handles in which all loops turn by right angles:
//
//   seamless [--cones N] [--signatures S] MESH
//   seamless --header
//
// The first prints a row of a Markdown table for MESH, the second the head of the table. MESH as for `performance`: closed, connected, with handles.
// N cones for each handle (default 8) place themselves, with multiples of a right angle; then the handles turn as they are chosen to,
// and in S random ways (default 20): each loop of the basis by the nearest multiple, or one more or less. Seconds are those of the processors, with
// the choice of the turnings.

#include "../include/Processor_stopwatch.h"
#include "../include/benchmark_meshes.h"

#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Handle_turner.h>
#include <CGAL/Conformal_equivalence/place_cones.h>

#include <CGAL/number_type_config.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace CE = CGAL::Conformal_equivalence;
using namespace benchmarks;

typedef CE::Intrinsic_triangulation<double>           Triangulation;
typedef CE::internal::Handle_turner<double>           Handle_turner;

struct Problem
{
  Triangulation t;
  std::size_t genus;
  CE::Conformal_conditions<double> conditions;
  std::vector<CE::internal::Quantized_cone> cones;
  CE::Conformal_metric<double> metric;
  double seconds; // of the conformal solve
};

Problem problem(const std::string& name, std::size_t cones_of_handle)
{
  const Mesh mesh = make_mesh(name);
  CE::Imported_mesh<Mesh> imported(mesh);
  CE::internal::set_lengths(imported, CGAL::parameters::default_values());
  const Triangulation& t = imported.triangulation;
  const auto pieces = CE::connected_components(t);
  if(pieces.components.size() != 1 || pieces.components[0].number_of_borders != 0 || pieces.components[0].genus() == 0)
    throw std::runtime_error("is no closed connected surface with handles");
  Problem result{t, pieces.components[0].genus(), CE::Conformal_conditions<double>(t), {}, {}, 0};
  const auto placement = CE::place_cones(t, CGAL::parameters::number_of_cones(cones_of_handle * result.genus).angle_quantum(CGAL_PI / 2));
  if(!placement)
    throw std::runtime_error("cones cannot be placed");
  for(std::size_t i = 0; i < placement.cones.size(); ++i)
  {
    result.conditions.prescribe_angle_sum(placement.cones[i], placement.angles[i]);
    result.cones.push_back({placement.cones[i], long(placement.angles[i].units / (CE::Exact_angle<double>::units_of_pi / 2))});
  }
  const Processor_stopwatch watch;
  result.metric = CE::compute_conformal_metric(t, result.conditions);
  result.seconds = watch.seconds();
  if(!result.metric)
    throw std::runtime_error("has no conformal metric with these cones");
  return result;
}

std::size_t median(std::vector<std::size_t> numbers)
{
  std::sort(numbers.begin(), numbers.end());
  return numbers.empty() ? 0 : numbers[numbers.size() / 2];
}

void print_row(const std::string& name, std::size_t cones_of_handle, std::size_t signatures)
{
  const Problem p = problem(name, cones_of_handle);
  const std::vector<CE::internal::Prescribed_turning> none;
  const Handle_turner turner(p.t, p.metric, p.conditions, p.cones, 4, none, CE::Solver_options());
  const Processor_stopwatch watch;
  CE::internal::Turned_handles chosen = turner.choose();
  const CE::internal::Turned_handles given = chosen;
  const bool is_found = bool(chosen) && bool(turner.turn(chosen));
  const double seconds = watch.seconds();
  std::cout << "| " << name.substr(name.find_last_of('/') + 1) << " | " << p.t.number_of_vertices() << " | " << p.genus << " | "
            << p.cones.size() << " | " << p.metric.statistics.number_of_iterations << " | " << p.seconds << " | "
            << (is_found ? "yes" : "no") << " | "
            << chosen.number_of_steps << " | " << chosen.number_of_flips << " | " << seconds << " | " << seconds / p.seconds << " | "
            << chosen.residual << " | " << chosen.mean_departure << " | " << chosen.largest_departure << " | ";

  Random_numbers random(1);
  std::vector<std::size_t> steps;
  std::size_t number_of_tried = 0;
  for(std::size_t i = 0; i < signatures && bool(given); ++i)
  {
    CE::internal::Turned_handles handles = given;
    handles.others.clear();
    for(std::size_t k = 0; k < handles.quanta.size(); ++k)
      handles.quanta[k] = std::lround(handles.conformal_turnings[k] / (CGAL_PI / 2)) + std::lround(random(-1.5, 1.5));
    CE::internal::Seamless_signature signature{p.genus, 4, {}, handles.quanta};
    for(const auto& cone : p.cones)
      signature.cones.push_back(cone.quanta);
    if(CE::internal::existence(signature) == CE::Surface_existence::IMPOSSIBLE)
      continue;
    ++number_of_tried;
    if(bool(turner.turn(handles)))
      steps.push_back(handles.number_of_steps);
  }
  std::cout << steps.size() << " of " << number_of_tried << " | " << median(steps) << " | "
            << (steps.empty() ? 0 : *std::max_element(steps.begin(), steps.end())) << " |" << std::endl;
}

} // namespace

int main(int argc, char* argv[])
{
  std::size_t cones = 8, signatures = 20;
  std::string name;
  for(int i = 1; i < argc; ++i)
  {
    const std::string word = argv[i];
    if(word == "--header")
    {
      std::cout << "| mesh | vertices | genus | cones | conformal steps | seconds | found | steps | flips | seconds | of the conformal | residual "
                   "| departure | largest | random | median steps | most |\n"
                   "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
      return EXIT_SUCCESS;
    }
    if(word == "--cones" && i + 1 < argc)
      cones = std::size_t(std::atol(argv[++i]));
    else if(word == "--signatures" && i + 1 < argc)
      signatures = std::size_t(std::atol(argv[++i]));
    else
      name = word;
  }
  try
  {
    print_row(name, cones, signatures);
  }
  catch(const std::exception& e)
  {
    std::cerr << name << " " << e.what() << std::endl;
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
