// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The linear solvers side by side, in one process, so that whatever else the machine does concerns all of them:
//
//   linear_solvers MESH...
//
// MESH is as for `performance`. Prints a row of a table for each mesh and solver: processor seconds of the analysis of the Laplacian (the Hessian
// at u = 0, natural border), of a first factorization and of a second one, which finds its memory ready, of one application as preconditioner,
// and of the whole metric; the least of three.

#include "../include/factorization.h"
#include "../include/table.h"

#include <CGAL/Conformal_equivalence/Multifrontal_solver_traits.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace benchmarks;

typedef CE::Intrinsic_triangulation<double> Triangulation;

// The least time of three.
template <typename Function>
double seconds_of(const Function& function)
{
  double result = std::numeric_limits<double>::infinity();
  for(int i = 0; i < 3; ++i)
  {
    const Processor_stopwatch stopwatch;
    function();
    result = (std::min)(result, stopwatch.seconds());
  }
  return result;
}

template <typename Traits>
void measure(const std::string& mesh, const std::string& name, const Triangulation& t)
{
  typename Traits::Matrix a{typename Traits::Matrix::EigenType(laplacian(t))};
  const int n = a.row_dimension();
  double first = std::numeric_limits<double>::infinity(), d;
  const double analysis = seconds_of([&] { Traits().analyze_pattern(a); });
  Traits solver;
  for(int i = 0; i < 3; ++i)
  {
    solver.analyze_pattern(a);
    const Processor_stopwatch stopwatch;
    if(!solver.refactor(a, d))
      throw std::runtime_error("the Laplacian is not positive definite");
    first = (std::min)(first, stopwatch.seconds());
  }
  const double second = seconds_of([&] { solver.refactor(a, d); });
  typename Traits::Vector b(n), x(n);
  for(int i = 0; i < n; ++i)
    b[i] = i % 7 - 3;
  const double application = seconds_of([&]
  {
    if constexpr(CE::internal::Has_preconditioner<Traits>::value)
      solver.precondition(b, x);
    else
      solver.linear_solver(b, x);
  });
  CE::Conformal_metric<double> metric;
  const double whole = seconds_of([&]
  {
    metric = CE::compute_conformal_metric(t, CE::Conformal_conditions<double>(t), CGAL::parameters::sparse_linear_solver(Traits()));
  });
  Cells row = {mesh, std::to_string(t.number_of_vertices()), name};
  for(const double seconds : {analysis, first, second, application, whole})
    row.push_back(to_text(seconds, 3));
  row.push_back(metric ? std::to_string(metric.statistics.number_of_linear_iterations) : CE::message(metric.status));
  print_row(row);
}

void measure_all(const std::string& specification)
{
  const std::string name = name_of(specification);
  const Triangulation t = CE::import_mesh(make_mesh(specification)).triangulation;
  measure<CE::Multifrontal_solver_traits>(name, "multifrontal", t);
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_CHOLMOD
  measure<CE::Cholmod_solver_traits>(name, "CHOLMOD", t);
#endif
  measure<CE::Simplicial_solver_traits>(name, "Eigen", t);
}

} // namespace

int main(int argc, char* argv[])
{
  try
  {
    print_head({"mesh", "vertices", "solver", "analysis", "factorization", "again", "application", "whole metric", "PCG"});
    for(int i = 1; i < argc; ++i)
      measure_all(argv[i]);
    return EXIT_SUCCESS;
  }
  catch(const std::exception& error)
  {
    std::cerr << "linear_solvers: " << error.what() << std::endl;
    return EXIT_FAILURE;
  }
}
