// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Meshes with all the maps that flatten(), map_to_sphere() or map_to_disk() can write, so filled that they show whether these did.

#ifndef CGAL_TEST_CONFORMAL_EQUIVALENCE_OUTPUT_MAPS_H
#define CGAL_TEST_CONFORMAL_EQUIVALENCE_OUTPUT_MAPS_H

#include "flattened_meshes.h"

#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <algorithm>

namespace testing {

/// what no result is
constexpr double unwritten = 77;

// For layouts.
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

// For images of the vertices, on a sphere or in a disk.
template <typename Image_point>
struct Image_maps
{
  Mesh sm;
  Image_point unwritten_image;
  Mesh::Property_map<Vertex, Image_point> image;
  Mesh::Property_map<Vertex, double> u, weight;

  Image_maps(const Mesh& mesh, const Image_point& unwritten_image) : sm(mesh), unwritten_image(unwritten_image)
  {
    image = sm.add_property_map<Vertex, Image_point>("v:image", unwritten_image).first;
    u = sm.add_property_map<Vertex, double>("v:u", unwritten).first;
    weight = sm.add_property_map<Vertex, double>("v:weight", unwritten).first;
  }
  Image_maps(const Image_maps&) = delete;

  auto parameters() const { return CGAL::parameters::log_scale_factor_map(u).projective_weight_map(weight); }

  bool is_untouched(Vertex v) const { return image[v] == unwritten_image && u[v] == unwritten && weight[v] == unwritten; }
  bool is_untouched() const
  {
    const auto range = vertices(sm);
    return std::all_of(range.begin(), range.end(), [&](Vertex v) { return is_untouched(v); });
  }
};

} // namespace testing

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_OUTPUT_MAPS_H
