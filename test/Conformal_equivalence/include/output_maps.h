// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Meshes with all the maps that flatten() can write, so filled that they show whether it did; for the tests of the doors.

#ifndef CGAL_TEST_CONFORMAL_EQUIVALENCE_OUTPUT_MAPS_H
#define CGAL_TEST_CONFORMAL_EQUIVALENCE_OUTPUT_MAPS_H

#include "flattened_meshes.h"

#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <algorithm>

namespace testing {

/// what no result is
constexpr double unwritten = 77;

struct Output_maps
{
  Mesh sm;
  Mesh::Property_map<Halfedge, Point_2> uv;
  Mesh::Property_map<Vertex, double> u, weight;
  Mesh::Property_map<Edge, double> scaled;

  explicit Output_maps(const Mesh& mesh) : sm(mesh)
  {
    uv = sm.add_property_map<Halfedge, Point_2>("h:uv", Point_2(unwritten, unwritten)).first;
    u = sm.add_property_map<Vertex, double>("v:u", unwritten).first;
    weight = sm.add_property_map<Vertex, double>("v:weight", unwritten).first;
    scaled = sm.add_property_map<Edge, double>("e:scaled", unwritten).first;
  }
  explicit Output_maps(const Soup& soup) : Output_maps(surface_mesh<Mesh>(soup)) {}
  Output_maps(const Output_maps&) = delete; // its maps would be those of the other mesh

  auto parameters() const
  {
    return CGAL::parameters::log_scale_factor_map(u).projective_weight_map(weight).scaled_edge_length_map(scaled);
  }

  bool is_untouched() const
  {
    return std::all_of(uv.begin(), uv.end(), [](const Point_2& p) { return p == Point_2(unwritten, unwritten); })
        && std::all_of(u.begin(), u.end(), [](double x) { return x == unwritten; })
        && std::all_of(weight.begin(), weight.end(), [](double x) { return x == unwritten; })
        && std::all_of(scaled.begin(), scaled.end(), [](double x) { return x == unwritten; });
  }
};

// And those with which a border is prescribed.
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

  template <typename NamedParameters = decltype(CGAL::parameters::gradient_tolerance(1e-12))>
  CGAL::Conformal_equivalence::Flattening_report<Mesh>
  flatten(const NamedParameters& np = CGAL::parameters::gradient_tolerance(1e-12))
  {
    return CGAL::Conformal_equivalence::flatten(sm, uv, CGAL::Conformal_equivalence::combine_named_parameters(np, parameters()));
  }
};

} // namespace testing

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_OUTPUT_MAPS_H
