// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What is asked of a placement of cones.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_OPTIONS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_OPTIONS_H

#include <CGAL/Conformal_equivalence/options.h>

#include <cstddef>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// 0 stands for what is not asked.
struct Cone_options
{
  std::size_t number_of_cones = 0;
  double maximum_u = 0;
  double maximum_area_distortion = 0;
  double maximum_root_mean_square = 0;
  double angle_quantum = 0; // radians
  Cone_measure measure = Cone_measure::MAXIMUM_U;
  Cone_angles angles = Cone_angles::CHOSEN;
  std::size_t number_of_sweeps = 10;

  bool has_bound() const { return maximum_u > 0 || maximum_area_distortion > 0 || maximum_root_mean_square > 0; }

  // What is bounded is what cones are placed for, if nothing else is said.
  Cone_measure measure_of_bounds(Cone_measure without_bounds) const
  {
    return maximum_u > 0                ? Cone_measure::MAXIMUM_U
         : maximum_area_distortion > 0  ? Cone_measure::AREA_DISTORTION
         : maximum_root_mean_square > 0 ? Cone_measure::ROOT_MEAN_SQUARE_U
                                        : without_bounds;
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_OPTIONS_H
