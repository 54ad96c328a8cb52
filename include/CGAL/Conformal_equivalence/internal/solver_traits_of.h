// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The linear solver among the named parameters.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_TRAITS_OF_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_TRAITS_OF_H

#include <CGAL/Conformal_equivalence/Multifrontal_solver_traits.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename NamedParameters>
using Solver_traits_of =
  typename CGAL::internal_np::Lookup_named_param_def<CGAL::internal_np::sparse_linear_solver_t, NamedParameters, Default_solver_traits>::type;

template <typename NamedParameters>
Solver_traits_of<NamedParameters> solver_traits_of(const NamedParameters& np)
{
  return CGAL::parameters::choose_parameter<Solver_traits_of<NamedParameters> >(
    CGAL::parameters::get_parameter(np, CGAL::internal_np::sparse_linear_solver));
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_TRAITS_OF_H
