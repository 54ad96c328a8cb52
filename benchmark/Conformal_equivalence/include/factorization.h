// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What a linear method must do at least: analyse and factorize the Laplacian of the mesh.

#ifndef CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_FACTORIZATION_H
#define CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_FACTORIZATION_H

#include "methods.h"

#include <CGAL/Conformal_equivalence/internal/Solver/energy.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Laplacian_solver.h>

#include <cstdint>
#include <vector>

namespace benchmarks {

// The lower half of the Laplacian (the Hessian at u = 0) of the vertices that are not on the border; on a closed
// surface, of all but the first vertex.
inline Eigen::SparseMatrix<double> laplacian(const CE::Intrinsic_triangulation<double>& t)
{
  CE::internal::Conformal_energy<double> energy(t, true);
  energy.evaluate(std::vector<double>(t.number_of_vertices(), 0.));
  std::vector<char> free(t.number_of_vertices(), 1);
  bool is_closed = true;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
  {
    is_closed = is_closed && !t.is_border_vertex(v);
    free[v] = t.is_isolated_vertex(v) || t.is_border_vertex(v) ? 0 : 1;
  }
  if(is_closed)
    free[0] = 0;
  CE::internal::Edge_graph graph;
  graph.set_edges(t);
  graph.set_free(free);
  return CE::internal::assemble_lower(graph, energy.weights(), std::vector<double>(t.number_of_vertices(), 0.));
}

// Processor seconds, negative if there are none.
struct Factorization_seconds
{
  double analysis = -1, factorization = -1;
};

template <typename Solver>
Factorization_seconds time_factorization(Solver& solver, const Eigen::SparseMatrix<double>& a)
{
  const Processor_stopwatch stopwatch;
  solver.analyzePattern(a);
  const double analysis = stopwatch.seconds();
  solver.factorize(a);
  const double both = stopwatch.seconds();
  return solver.info() == Eigen::Success ? Factorization_seconds{ analysis, both - analysis } : Factorization_seconds();
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_CHOLMOD

// By CHOLMOD, with one of its orderings.
inline Factorization_seconds time_factorization(const Eigen::SparseMatrix<double>& a, int ordering = CHOLMOD_AMD)
{
  Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double> > solver;
  solver.cholmod().nmethods = 1;
  solver.cholmod().method[0].ordering = ordering;
  solver.cholmod().postorder = true;
  solver.cholmod().print = 0;
  return time_factorization(solver, a);
}

#else

// By Eigen's simplicial factorization, ordered by AMD.
inline Factorization_seconds time_factorization(const Eigen::SparseMatrix<double>& a)
{
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double> > solver;
  return time_factorization(solver, a);
}

#endif

} // namespace benchmarks

#endif // CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_FACTORIZATION_H
