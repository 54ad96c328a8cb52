// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The inner loops, measured one by one: Google Benchmark. Every figure is for a generated
// terrain; `items_per_second` counts triangles, edges or numbers as the name says.

#include "../include/benchmark_meshes.h"

#include <CGAL/Conformal_equivalence/boundary_conditions.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/compute_layout.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/internal/Solver/energy.h>
#include <CGAL/Conformal_equivalence/conformal_energy.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/Lobachevsky.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace {

namespace CE = CGAL::Conformal_equivalence;
typedef CE::Intrinsic_triangulation<double>                       Triangulation;
typedef CE::Conformal_metric<double>                              Metric;
typedef CE::internal::Conformal_energy<double>                    Energy;
typedef CE::internal::Laplacian_solver                            Solver;

// A terrain with its natural border, at scale factors that are not trivial.
struct Problem
{
  benchmarks::Mesh mesh;
  CE::Imported_mesh<benchmarks::Mesh> imported;
  CE::Conformal_conditions<double> conditions;
  std::vector<double> u;

  explicit Problem(const benchmark::State& state)
    : mesh(benchmarks::terrain(std::size_t(state.range(0)))),
      imported(CE::import_mesh(mesh)),
      conditions(natural_border()),
      u(mesh.number_of_vertices())
  {
    benchmarks::Random_numbers random(3);
    for(double& x : u)
      x = random(-0.05, 0.05);
  }

  const Triangulation& triangulation() const { return imported.triangulation; }

  std::vector<char> free_vertices() const
  {
    std::vector<char> free(u.size());
    for(std::uint32_t v = 0; v < free.size(); ++v)
      free[v] = conditions.is_fixed(v) ? 0 : 1;
    return free;
  }

private:
  CE::Conformal_conditions<double> natural_border() const
  {
    std::vector<std::uint32_t> missing;
    return CE::read_conditions(imported, missing, CGAL::parameters::default_values());
  }
};

void count(benchmark::State& state, std::size_t items)
{
  state.SetItemsProcessed(state.iterations() * std::int64_t(items));
}

void import_per_triangle(benchmark::State& state)
{
  const Problem problem(state);
  for(auto _ : state)
    benchmark::DoNotOptimize(CE::import_mesh(problem.mesh).triangulation.number_of_edges());
  count(state, problem.triangulation().number_of_faces());
}

void angles_and_cotangents_per_triangle(benchmark::State& state)
{
  const Problem problem(state);
  Energy energy(problem.triangulation(), true);
  for(auto _ : state)
    benchmark::DoNotOptimize(energy.evaluate(problem.u));
  count(state, problem.triangulation().number_of_faces());
}

void energy_value_per_triangle(benchmark::State& state)
{
  const Problem problem(state);
  const std::vector<double> target(problem.u.size(), 2 * CGAL_PI);
  for(auto _ : state)
    benchmark::DoNotOptimize(CE::conformal_energy(problem.triangulation(), problem.u, target));
  count(state, problem.triangulation().number_of_faces());
}

void wide_residual_per_triangle(benchmark::State& state)
{
  const Problem problem(state);
  std::vector<Metric::Wide_number> s;
  for(double x : problem.u)
    s.push_back(exp(Metric::Wide_number(x / 2)));
  for(auto _ : state)
    benchmark::DoNotOptimize(CE::internal::wide_residual(problem.triangulation(), s, problem.conditions).data());
  count(state, problem.triangulation().number_of_faces());
}

// A solver with the factor of the Hessian at `energy`.
void factorize(const Problem& problem, Energy& energy, Solver& solver)
{
  energy.evaluate(std::vector<double>(problem.u.size(), 0.));
  solver.set_edges(problem.triangulation());
  solver.set_free(problem.free_vertices());
  solver.factorize(energy.weights());
}

void laplacian_product_per_edge(benchmark::State& state)
{
  const Problem problem(state);
  Energy energy(problem.triangulation(), true);
  energy.evaluate(problem.u);
  CE::internal::Edge_graph graph;
  graph.set_edges(problem.triangulation());
  graph.set_free(problem.free_vertices());
  for(auto _ : state)
    benchmark::DoNotOptimize(graph.product(energy.weights(), problem.u).data());
  count(state, problem.triangulation().number_of_edges());
}

void factorization_per_vertex(benchmark::State& state)
{
  const Problem problem(state);
  Energy energy(problem.triangulation(), true);
  for(auto _ : state)
  {
    Solver solver(CE::internal::make_factorization<CE::Default_solver_traits>());
    factorize(problem, energy, solver);
  }
  count(state, problem.u.size());
}

void back_solve_per_vertex(benchmark::State& state)
{
  const Problem problem(state);
  Energy energy(problem.triangulation(), true);
  Solver solver(CE::internal::make_factorization<CE::Default_solver_traits>());
  factorize(problem, energy, solver);
  std::vector<double> x;
  for(auto _ : state)
    benchmark::DoNotOptimize(solver.precondition(problem.u, x));
  count(state, problem.u.size());
}

void layout_per_triangle(benchmark::State& state)
{
  const Problem problem(state);
  const Metric metric = CE::compute_conformal_metric(problem.triangulation(), problem.conditions);
  for(auto _ : state)
    benchmark::DoNotOptimize(CE::compute_layout(problem.triangulation(), metric, CE::Cut_graph()).corner.data());
  count(state, problem.triangulation().number_of_faces());
}

void lobachevsky_per_number(benchmark::State& state)
{
  std::vector<double> angles(1000);
  benchmarks::Random_numbers random(4);
  for(double& x : angles)
    x = random(0, CGAL_PI);
  for(auto _ : state)
    for(double x : angles)
      benchmark::DoNotOptimize(CE::internal::Lobachevsky(x));
  count(state, angles.size());
}

#define CGAL_BENCHMARK_TERRAIN(name) BENCHMARK(name)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond)

CGAL_BENCHMARK_TERRAIN(import_per_triangle);
CGAL_BENCHMARK_TERRAIN(angles_and_cotangents_per_triangle);
CGAL_BENCHMARK_TERRAIN(energy_value_per_triangle);
CGAL_BENCHMARK_TERRAIN(wide_residual_per_triangle);
CGAL_BENCHMARK_TERRAIN(laplacian_product_per_edge);
CGAL_BENCHMARK_TERRAIN(factorization_per_vertex);
CGAL_BENCHMARK_TERRAIN(back_solve_per_vertex);
CGAL_BENCHMARK_TERRAIN(layout_per_triangle);
BENCHMARK(lobachevsky_per_number)->Unit(benchmark::kMillisecond);

#undef CGAL_BENCHMARK_TERRAIN

} // namespace

BENCHMARK_MAIN();
