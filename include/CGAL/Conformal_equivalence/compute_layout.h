// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file compute_layout.h
/// From a flat metric to points of the plane: the triangles are laid out one after
/// the other in breadth-first order of the dual graph (section 3.3 of Springborn,
/// Schroeder and Pinkall, 2008).
///
/// Across a cut edge the layout goes on after a motion of the plane, which is part of the result.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_LAYOUT_H
#define CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_LAYOUT_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/internal/Layout/lay_out_pieces.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/assertions.h>

#include <cstdint>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// lays out the flat surface of `metric`, cut along `cut`, in the plane: a point for every corner of the triangulation that was given to the
/// solver, whether it has been flipped or not. After flips the edges of that triangulation are no straight lines in the
/// flat surface; `Layout::length_error` then is about the straight lines between their ends. Linear time, and the
/// number of crossings of the two triangulations; the work runs in `Conformal_metric::Wide_number`. The surface may have any number of components,
/// and the cuts may leave it in any number of
/// pieces: they are put beside one another and do not overlap each other (one by itself may).
///
/// \param input the triangulation that was given to the solver
/// \param metric what the solver returned; its angle sums should be 2 pi at every vertex that is not
///        on the border or a cut
/// \param cut what it leaves need not be disks, but around whatever is not cut open the layout must close
///        (`Layout::length_error` shows if it does not)
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{layout_frame}
///     \cgalParamDescription{how the layout is placed in the plane}
///     \cgalParamType{`Layout_frame`, or `Pinned_frame<std::uint32_t>`}
///     \cgalParamDefault{`Layout_frame::CANONICAL`}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the layout, with the motions across the cuts and the lattices of flat tori. Its status is `EMPTY_MESH` if there is no face.
/// \pre `metric` is a success; its triangulation is `input`, or was made from it by `Conformal_metric::flips`.
template <typename NT, typename NamedParameters = parameters::Default_named_parameters>
Layout<NT> compute_layout(const Intrinsic_triangulation<NT>& input,
                          const Conformal_metric<NT>& metric,
                          const Cut_graph& cut,
                          const NamedParameters& np = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  CGAL_precondition(bool(metric));
  CGAL_precondition(metric.triangulation.number_of_halfedges() == (metric.is_doubled ? 2 : 1) * input.number_of_halfedges());
  if(input.number_of_faces() == 0)
  {
    Layout<NT> nothing;
    nothing.status = Status::EMPTY_MESH;
    return nothing;
  }
  const auto frame = choose_parameter(get_parameter(np, internal_np::conformal_layout_frame), Layout_frame::CANONICAL);
  const auto all = [](const internal::Piece&) { return true; };
  return internal::lay_out(input, metric, cut, frame, all);
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_LAYOUT_H
