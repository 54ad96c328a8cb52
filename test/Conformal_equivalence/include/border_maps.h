// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Meshes to be flattened, with the maps by which their borders are prescribed.

#ifndef CGAL_TEST_CONFORMAL_EQUIVALENCE_BORDER_MAPS_H
#define CGAL_TEST_CONFORMAL_EQUIVALENCE_BORDER_MAPS_H

#include "output_maps.h"
#include "tolerances.h"

#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

namespace testing {

struct Border_maps : Output_maps
{
  Mesh::Property_map<Vertex, double> angle, fixed_u;
  Mesh::Property_map<Vertex, bool> is_fixed;

  explicit Border_maps(const Mesh& mesh) : Output_maps(mesh)
  {
    angle = sm.add_property_map<Vertex, double>("v:angle", 0).first;
    fixed_u = sm.add_property_map<Vertex, double>("v:fixed_u", 0).first;
    is_fixed = sm.add_property_map<Vertex, bool>("v:is_fixed", false).first;
  }
  explicit Border_maps(const Soup& soup) : Border_maps(surface_mesh<Mesh>(soup)) {}

  template <typename NamedParameters = decltype(CGAL::parameters::gradient_tolerance(solver_tolerance))>
  CGAL::Conformal_equivalence::Flattening_report<Mesh>
  flatten(const NamedParameters& np = CGAL::parameters::gradient_tolerance(solver_tolerance))
  {
    return CGAL::Conformal_equivalence::flatten(sm, uv, CGAL::Conformal_equivalence::combine_named_parameters(np, parameters()));
  }
};

} // namespace testing

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_BORDER_MAPS_H
