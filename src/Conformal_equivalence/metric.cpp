// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Part of the compiled library: the solver, for `double`.

#include <CGAL/Conformal_equivalence/internal/Retriangulation/Metric_finder.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Factorization.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Mixed_precision_factor.h>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template std::unique_ptr<Factorization> make_factorization(const Multifrontal_solver_traits&);
template std::unique_ptr<Factorization> make_factorization(const Simplicial_solver_traits&);
template void Mixed_precision_factor<float, double>::analyze(const Lower_half&);
template bool Mixed_precision_factor<float, double>::factorize(Lower_half);
template bool Mixed_precision_factor<float, double>::precondition(std::vector<double>&);
template bool Mixed_precision_factor<float, double>::solve(std::vector<double>&);

template Metric_finder<double>::Metric_finder(Intrinsic_triangulation<double>, std::unique_ptr<Factorization>);
template Metric_finder<double>::~Metric_finder();
template Intrinsic_triangulation<double> Metric_finder<double>::take_triangulation();
template Conformal_metric<double> Metric_finder<double>::find(const Conformal_conditions<double>&, const Solver_options&);

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL
