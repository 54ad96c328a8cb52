// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Part of the compiled library: handles that turn by multiples of an angle, for `double`.

#include <CGAL/Conformal_equivalence/internal/Seamless/Handle_turner.h>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template Turning_newton<double>::Turning_newton(Intrinsic_triangulation<double>, Dual_loops, Turning_targets, const Turning_newton_options&,
                                                std::shared_ptr<Turning_equations>);
template Turning_metric Turning_newton<double>::run();
template Handle_turner<double>::Handle_turner(const Intrinsic_triangulation<double>&, const Conformal_metric<double>&,
                                              const Conformal_conditions<double>&, const std::vector<Quantized_cone>&, int,
                                              const std::vector<Prescribed_turning>&, const Solver_options&, const Factorization_maker&);
template Turned_handles Handle_turner<double>::choose() const;
template Conformal_metric<double> Handle_turner<double>::turn(Turned_handles&) const;

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL
