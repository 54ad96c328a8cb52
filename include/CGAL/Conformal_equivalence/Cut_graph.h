// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Cut_graph.h
/// Where a surface is cut before it is laid out (section 3.3 of Springborn, Schroeder
/// and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_CUT_GRAPH_H
#define CGAL_CONFORMAL_EQUIVALENCE_CUT_GRAPH_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Status.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// The interior edges along which a surface is cut.
struct Cut_graph
{
  std::vector<char> is_cut;           ///< by edge of the input triangulation; empty: nothing is cut
  Status status = Status::OK;         ///< whether the surface could be cut
  std::vector<std::uint32_t> edges;   ///< at fault

  /// is `true` iff the edge `e` is cut.
  bool operator[](std::uint32_t e) const { return !is_cut.empty() && is_cut[e] != 0; }
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_CUT_GRAPH_H
