// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What more digits of the metric cost:
//
//   precision [REPETITIONS MESH...]
//
// MESH is a file, or `terrain:N` (see benchmark_meshes.h); natural borders. For each one: the processor seconds of the
// solve to 1e-12 in double, to 1e-30 in pairs of double (the least of all repetitions), and as far as MPFR numbers of 256
// bits go, all in one process; and their ratios to the first one. A table in Markdown.

#include "../include/benchmark_meshes.h"

#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/multiprecision.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <iomanip>
#include <iostream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace {

namespace CE = CGAL::Conformal_equivalence;

struct Run
{
  double seconds = std::numeric_limits<double>::infinity();
  CE::Status status = CE::Status::OK;
  CE::Statistics statistics;
};

template <typename NT>
Run solve(const CE::Intrinsic_triangulation<NT>& t, double tolerance, int repetitions)
{
  Run run;
  const CE::Conformal_conditions<NT> conditions(t);
  for(int i = 0; i < repetitions; ++i)
  {
    CE::Intrinsic_triangulation<NT> copy = t;
    const std::clock_t begin = std::clock();
    const CE::Conformal_metric<NT> metric =
      CE::compute_conformal_metric(std::move(copy), conditions, CGAL::parameters::gradient_tolerance(tolerance));
    run.seconds = (std::min)(run.seconds, double(std::clock() - begin) / CLOCKS_PER_SEC);
    run.status = metric.status;
    run.statistics = metric.statistics;
  }
  return run;
}

typedef CE::Multiprecision_number Real;

Run solve_with(unsigned int bits, const CE::Intrinsic_triangulation<double>& t, int repetitions)
{
  const CE::Working_precision precision(bits);
  return solve(t.with_lengths(std::vector<Real>(t.lengths().begin(), t.lengths().end())), 0, repetitions);
}

std::string remark(const Run& run)
{
  return run.status == CE::Status::OK ? "" : run.status == CE::Status::CONVERGED_TO_ROUNDING ? " (floor)" : " (" + CE::message(run.status) + ")";
}

void print(const std::string& mesh, std::size_t n, const Run& coarse, const Run& fine, const Run& finest)
{
  std::cout << "| " << mesh << " | " << n << " | " << std::fixed << std::setprecision(3) << coarse.seconds << " | "
            << coarse.statistics.number_of_linear_iterations << remark(coarse);
  for(const Run* run : {&fine, &finest})
    std::cout << " | " << std::setprecision(3) << std::fixed << run->seconds << " | " << std::setprecision(2) << run->seconds / coarse.seconds
              << " | " << run->statistics.number_of_linear_iterations << " | " << std::scientific << std::setprecision(1)
              << run->statistics.residual << remark(*run);
  std::cout << " |" << std::endl;
}

} // namespace

int main(int argc, char* argv[])
{
  const int repetitions = argc > 1 ? std::atoi(argv[1]) : 3;
  std::vector<std::string> meshes(argv + (std::min)(argc, 2), argv + argc);
  if(meshes.empty())
    meshes.push_back("terrain:10000");
  try
  {
    std::cout << "| mesh | vertices | 1e-12: seconds | PCG | 1e-30: seconds | / 1e-12 | PCG | residual "
                 "| 256 bits: seconds | / 1e-12 | PCG | residual |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|" << std::endl;
    for(const std::string& name : meshes)
    {
      const benchmarks::Mesh mesh = benchmarks::make_mesh(name);
      const auto t = CE::import_mesh(mesh).triangulation;
      const Run coarse = solve(t, 1e-12, repetitions), fine = solve(t, 1e-30, repetitions);
      print(name.substr(name.rfind('/') + 1), t.number_of_vertices(), coarse, fine, solve_with(256, t, 1));
    }
  }
  catch(const std::exception& error)
  {
    std::cerr << "precision: " << error.what() << std::endl;
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
