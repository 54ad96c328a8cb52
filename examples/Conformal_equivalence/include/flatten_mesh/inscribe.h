// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// With --target sphere or disk: what the maps in double and in more digits share.

#ifndef FLATTEN_MESH_INSCRIBE_H
#define FLATTEN_MESH_INSCRIBE_H

#include "door_parameters.h"
#include "mesh.h"
#include "options.h"
#include "precision.h"
#include "results.h"

#include <CGAL/Conformal_equivalence/map_to_disk.h>
#include <CGAL/Conformal_equivalence/map_to_sphere.h>
#include <boost/property_map/property_map.hpp>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace flattening {

// The vertices that steer the map, as given on the command line; throw a `Failure` if they cannot.
// The vertex to be sent to infinity, or the null vertex.
Vertex given_vertex_at_infinity(const Options& options, const Mesh& mesh);
Vertex given_disk_centre(const Options& options, const Mesh& mesh);
std::array<Vertex, 3> given_disk_points(const Options& options, const Mesh& mesh);

inline CE::Moebius_weights given_moebius_weights(const Options& options)
{
  return options.weighs_areas ? CE::Moebius_weights::AREAS : CE::Moebius_weights::VERTICES;
}

// Receives points of the disk, or of the sphere, by vertex.
template <typename NT>
struct Image_map
{
  typedef boost::writable_property_map_tag category;
  typedef Vertex key_type;
  struct value_type
  {
    std::array<NT, 3> point;
    value_type(const NT& x, const NT& y) : point{{ x, y, NT(0) }} {}
    value_type(const NT& x, const NT& y, const NT& z) : point{{ x, y, z }} {}
  };
  typedef value_type reference;

  std::vector<std::array<NT, 3> >* points;

  friend void put(const Image_map& map, Vertex v, const value_type& p) { (*map.points)[v.idx()] = p.point; }
};

template <typename NT>
Image_map<NT> make_image_map(const Mesh& mesh, std::vector<std::array<NT, 3> >& points)
{
  points.assign(mesh.number_of_vertices(), origin<NT>());
  return { &points };
}

// Faces of the refinement are drawn on the sphere only.
template <typename NT>
CE::Common_refinement<NT> parts_without_layout(CE::Spherical_refinement<NT>& found)
{
  CE::Common_refinement<NT> parts = std::move(found.parts);
  parts.corner_uv.assign(parts.corner_vertex.size(), {{ NT(0), NT(0) }});
  return parts;
}

// The parameters of maps to the sphere and the disk.
inline auto image_parameters(const Options& options, const Results& results, Progress_visitor& visitor)
{
  return common_parameters(options, results, visitor)
           .projective_weight_map(results.given.weight)
           .moebius_weights(given_moebius_weights(options))
           .vertex_at_infinity(given_vertex_at_infinity(options, results.given.mesh));
}

// What `map(np)` returns for the frame of the disk that is given, which it has among its parameters.
template <typename NamedParameters, typename Map>
Report map_with_disk_frame(const Options& options, const Mesh& mesh, const NamedParameters& np, Map map)
{
  if(options.disk_centre)
    return map(np.disk_frame(CE::Centred_disk_frame<Vertex>{given_disk_centre(options, mesh)}));
  if(options.disk_points)
    return map(np.disk_frame(CE::Three_point_disk_frame<Vertex>{given_disk_points(options, mesh)}));
  return map(np);
}

} // namespace flattening

#endif // FLATTEN_MESH_INSCRIBE_H
