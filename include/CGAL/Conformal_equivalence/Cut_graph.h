// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Cut_graph.h
/// Where a surface is cut before it is laid out (section 3.3 of Springborn, Schroeder
/// and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_CUT_GRAPH_H
#define CGAL_CONFORMAL_EQUIVALENCE_CUT_GRAPH_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Outcome.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// The interior edges along which a surface is cut, as found by `compute_cut_graph()` or set by the user. Elements at fault: `edges`, and
/// in `faces` one face of every component at fault.
struct Cut_graph : public Outcome
{
  std::vector<char> is_cut;           ///< by edge of the input triangulation; empty: nothing is cut

  /// The system of loops: 2g of them for a surface of genus g, each a chain of halfedges of the input triangulation
  /// in order. The loops of one component begin and end at one base vertex, or on one border; a
  /// loop that meets a border elsewhere goes on from any vertex of it. Empty if nothing had to be cut for handles, or
  /// if the user set the cut.
  std::vector<std::vector<std::uint32_t> > loops;

  /// is `true` iff the edge `e` is cut.
  bool operator[](std::uint32_t e) const { return !is_cut.empty() && is_cut[e] != 0; }
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_CUT_GRAPH_H
