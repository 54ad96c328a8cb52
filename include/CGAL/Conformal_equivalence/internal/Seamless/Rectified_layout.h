// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A layout without seams, and what is told of it (section 6 of Springborn, Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_RECTIFIED_LAYOUT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_RECTIFIED_LAYOUT_H

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Texture_lattice.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// With the status BOUND_NOT_MET there is a layout nevertheless.
struct Rectified_layout : public Outcome
{
  typedef Lattice_coordinates<std::int64_t> Lattice_point;

  Layout<double> layout;                           // its transitions are exact
  Tiling tiling;
  std::vector<Lattice_point> cone_positions;       // by cone, in the first corners
  std::vector<int> quanta;                         // by transition of `layout`: it turns by that many times 2 pi / n
  std::vector<Lattice_point> translations;         // by transition of `layout`
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_RECTIFIED_LAYOUT_H
