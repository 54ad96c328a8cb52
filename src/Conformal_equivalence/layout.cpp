// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Part of the compiled library: cuts, layouts and common refinements, for `double`.

#include <CGAL/Conformal_equivalence/internal/Doors/indexed_parameters.h>
#include <CGAL/Conformal_equivalence/internal/Layout/Cut_finder.h>
#include <CGAL/Conformal_equivalence/internal/Layout/lay_out_pieces.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Refinement_builder.h>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template std::vector<std::uint32_t> interior_cones(const Intrinsic_triangulation<double>&, const Conformal_conditions<double>&);
template Cut_graph find_cut_graph(const Intrinsic_triangulation<double>&, const std::vector<std::uint32_t>&, Seam_options<double>);
template Cut_graph find_cut(const Intrinsic_triangulation<double>&, const std::vector<std::uint32_t>&, Seam_conditions<double>);

template Layout<double> lay_out(const Intrinsic_triangulation<double>&, const Conformal_metric<double>&, const Cut_graph&,
                                const Any_frame&, const Is_wanted&);

template Common_refinement<double> build_refinement(const Intrinsic_triangulation<double>&, const Conformal_metric<double>&,
                                                    const Cut_graph&, std::uint64_t, const Any_frame&);

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL
