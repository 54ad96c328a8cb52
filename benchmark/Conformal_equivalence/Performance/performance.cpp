// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Time, memory and quality of one method on one mesh:
//
//   performance MESH METHOD
//
// MESH is a file, `terrain:N` (a generated height field of about N vertices) or
// `loop:K:NOISE:FILE` (K times subdivided after Loop, then moved by NOISE edge lengths).
// METHOD is `ours`, `ours-2` (two threads, if there is TBB), `ours-simplicial`, `ours-cholmod`, `lscm`, `arap`, `dcm`, `baseline`, or `check`
// (is MESH a disk?). One method per process, so that the peak of memory is its own. Prints a
// line `key value` for each figure.
//
// Seconds are those of the processors, which other work on the machine does not change; let
// OMP_NUM_THREADS and OPENBLAS_NUM_THREADS be 1 for them to be what passes on an idle machine.
//
// `ours` and `baseline` also measure what a linear method must do at least: one
// analysis and factorization of the Laplacian (the Hessian at u = 0, natural border) by
// CHOLMOD, ordered by AMD; `baseline` and `ours-beside` by METIS too. `ours-beside` measures nothing
// but speed, with it right before: that is what run_figures.sh needs.

#include "../include/factorization.h"
#include "../include/methods.h"

#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include <sys/resource.h>

namespace {

using namespace benchmarks;

// in bytes; Linux counts in units of 1024, macOS in bytes
double peak_memory()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  return double(usage.ru_maxrss);
#else
  return 1024. * double(usage.ru_maxrss);
#endif
}

// Of the process until now.
struct Processor_seconds
{
  double user, system;

  Processor_seconds()
  {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    user = double(usage.ru_utime.tv_sec) + 1e-6 * double(usage.ru_utime.tv_usec);
    system = double(usage.ru_stime.tv_sec) + 1e-6 * double(usage.ru_stime.tv_usec);
  }
};

template <typename Value>
void print(const char* key, const Value& value)
{
  std::cout << key << ' ' << value << std::endl;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_CHOLMOD

void measure_factorization(const Eigen::SparseMatrix<double>& a, const std::string& name, int ordering)
{
  const Factorization_seconds seconds = time_factorization(a, ordering);
  if(seconds.analysis < 0)
    return; // not positive definite: no figure
  print((name + "_analyze_seconds").c_str(), seconds.analysis);
  print((name + "_factorize_seconds").c_str(), seconds.factorization);
  print((name + "_seconds").c_str(), seconds.analysis + seconds.factorization);
}

void measure_baseline(const Mesh& mesh, bool with_metis)
{
  const Eigen::SparseMatrix<double> a = laplacian(CE::import_mesh(mesh).triangulation);
  measure_factorization(a, "amd", CHOLMOD_AMD);
  if(with_metis)
    measure_factorization(a, "metis", CHOLMOD_METIS);
}

#else

void measure_baseline(const Mesh&, bool) {}

#endif

void print_statistics(const Result& result)
{
  const CE::Statistics& s = result.statistics;
  print("import_seconds", result.stage_seconds[CE::Stage::IMPORT]);
  print("solve_seconds", result.stage_seconds[CE::Stage::SOLVE]);
  print("solve_elapsed_seconds", result.stage_seconds.elapsed(CE::Stage::SOLVE));
  print("discarded_seconds", s.seconds.discarded);
  print("edges_flipped", s.number_of_flips);
  print("layout_seconds", result.stage_seconds[CE::Stage::LAYOUT]);
  print("verify_seconds", result.stage_seconds[CE::Stage::VERIFY]);
  print("newton_steps", s.number_of_iterations);
  print("pcg_iterations", s.number_of_linear_iterations);
  print("factorizations", s.number_of_factorizations);
  print("evaluations", s.number_of_evaluations);
  print("residual", s.residual);
}

void print_quality(const Mesh& mesh, UV_map uv)
{
  const Quality quality = measure(mesh, uv);
  print("qc_mean", quality.mean_qc);
  print("qc_max", quality.max_qc);
  print("flips", quality.flips);
  print("injective", to_string(quality.injectivity));
  print("border_error", quality.border_error);
}

int run(const std::string& specification, const std::string& method)
{
  const bool is_ours = method.compare(0, 4, "ours") == 0;
  Mesh mesh = make_mesh(specification);
  print("vertices", num_vertices(mesh));
  print("faces", num_faces(mesh));
  if(method == "check")
    return is_disk(mesh) ? EXIT_SUCCESS : EXIT_FAILURE;
  if(method == "baseline")
  {
    measure_baseline(mesh, true);
    return EXIT_SUCCESS;
  }

  const UV_map uv = mesh.add_property_map<halfedge_descriptor, Point_2>("h:uv", Point_2(0, 0)).first;
  const bool is_beside = method == "ours-beside";
  if(is_beside)
    measure_baseline(mesh, true);
  print("memory_before", peak_memory());
  const Processor_seconds before;
  const Result result = run_method(is_beside ? "ours" : method, mesh, uv);
  const Processor_seconds after;
  print("user_seconds", after.user - before.user);
  print("system_seconds", after.system - before.system);
  print("memory", peak_memory());
  print("status", result.is_success ? "ok" : "failed: " + result.message);
  print("total_seconds", result.seconds);
  print("elapsed_seconds", result.elapsed_seconds);
  if(is_ours)
    print_statistics(result);
  if(method == "ours")
    measure_baseline(mesh, false); // right after, for the ratio
  if(is_beside || !result.is_success)
    return result.is_success ? EXIT_SUCCESS : EXIT_FAILURE;
  if(is_ours)
  {
    print("max_u", result.largest_u);
    print("layout_length_error", result.layout_length_error);
  }
  print_quality(mesh, uv);
  return EXIT_SUCCESS;
}

} // namespace

int main(int argc, char* argv[])
{
  std::cout.precision(8);
  try
  {
    return run(argc > 1 ? argv[1] : "terrain:10000", argc > 2 ? argv[2] : "ours");
  }
  catch(const std::bad_alloc&)
  {
    print("status", "out of memory");
    return EXIT_FAILURE;
  }
  catch(const std::exception& error)
  {
    print("status", "exception");
    std::cerr << "performance: " << error.what() << std::endl;
    return EXIT_FAILURE;
  }
}
