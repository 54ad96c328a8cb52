// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file repair_locally.h
/// The remedy of section 3.2 of Springborn, Schroeder and Pinkall, 2008, for triangulations on which the minimizer violates
/// triangle inequalities: the edges opposite to angles of pi are flipped or split, on the surface given, and the problem is
/// solved again. (What always helps, with fewer triangles, are the Ptolemy flips of `Retriangulation`.)

#ifndef CGAL_CONFORMAL_EQUIVALENCE_REPAIR_LOCALLY_H
#define CGAL_CONFORMAL_EQUIVALENCE_REPAIR_LOCALLY_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Repaired_metric.h>
#include <CGAL/Conformal_equivalence/Solver_options.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Repair/Local_repair.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/internal/solver_traits_of.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/use.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceSolver
///
/// finds the metric conformally equivalent to that of `t` with the given conditions, as `compute_conformal_metric()` does; where
/// the minimizer breaks triangles, changes the triangulation there, and solves again (section 3.2).
///
/// For each broken triangle, the worst first, the edge opposite to the angle of pi is replaced. The lengths are those on the
/// surface given, whose geometry is not changed:
///  - the edge is flipped if the quadrilateral of its two triangles is strictly convex, decided exactly, the new edge is no loop
///    and no second edge between its ends (so that a mesh can hold the result), and there was no edge between them before;
///  - otherwise it is split: at the foot of the perpendicular from the vertex opposite that is closer, if that is in the inner
///    eight tenths of the edge, else at the midpoint; but not where this vertex is closer than 1e-9 of the length of the edge;
///  - if it cannot be split either, it may be flipped back.
///
/// No two edges of adjacent triangles are changed before the next solve, which begins at the last u. A vertex where the angle is
/// larger than its triangles can have is treated in the same way: the edges opposite to it are replaced.
///
/// New vertices are no cones. On the border u is interpolated if it is fixed at both ends of the edge split (so a natural border
/// keeps its lengths); otherwise the angle there is pi.
///
/// The result is conformally equivalent to `t` on another triangulation: `Statistics::conformal_class` is `REPAIRED` if anything
/// was changed. `Statistics::number_of_discarded_iterations` counts the Newton steps of all solves but the last. The method is a
/// heuristic: there are surfaces for which no number of changes suffices (a border edge whose triangle has no area, and keeps its
/// lengths).
///
/// \param t the surface. It is not modified: changes are made on a copy.
/// \param conditions one per vertex of `t`
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of `compute_conformal_metric()` but
///        `retriangulation`, and the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{maximum_number_of_changes}
///     \cgalParamDescription{how many edges may be flipped or split}
///     \cgalParamType{`std::size_t`}
///     \cgalParamDefault{one tenth of the number of edges, and 100}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_is_constrained_map}
///     \cgalParamDescription{`true` for edges that may be split, but not flipped}
///     \cgalParamType{a readable property map with key type `std::uint32_t` and value type `bool`}
///     \cgalParamDefault{`false` for all edges}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the metric, the conditions and the changes. The status, `metric.status`, is that of the last solve, see
///         `Conformal_metric_solver::solve()`. `DEGENERATE_METRIC`, `ITERATIONS_EXHAUSTED` and `ANGLE_OUT_OF_RANGE` with a
///         positive amount mean that the number of changes was exhausted, or that nothing could be changed: lengths of `t`
///         violate the triangle inequality there.
///
/// \pre as for `Conformal_metric_solver`
///
/// Time is that of one solve for each round of changes, seldom more than a few.
template <typename NT, typename NamedParameters = parameters::Default_named_parameters>
Repaired_metric<NT> repair_locally(Intrinsic_triangulation<NT> t,
                                   Conformal_conditions<NT> conditions,
                                   const NamedParameters& np = parameters::default_values())
{
  const std::size_t budget = parameters::choose_parameter(parameters::get_parameter(np, internal_np::conformal_number_of_changes),
                                                          internal::default_number_of_changes(t));
  try
  {
    std::vector<char> is_kept(t.number_of_edges(), 0);
    if constexpr(internal::is_given<internal_np::edge_is_constrained_t, NamedParameters>)
      for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
        is_kept[e] = get(parameters::get_parameter(np, internal_np::edge_is_constrained), e) ? 1 : 0;
    Solver_options options = read_solver_options(np, t.number_of_vertices());
    return internal::Local_repair<NT, internal::Solver_traits_of<NamedParameters> >(
      std::move(t), std::move(conditions), std::move(is_kept), budget, std::move(options), internal::solver_traits_of(np)).run();
  }
  catch(const std::bad_alloc&)
  {
    Repaired_metric<NT> nothing;
    nothing.metric.status = Status::OUT_OF_MEMORY;
    return nothing;
  }
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_REPAIR_LOCALLY_H
