// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/Components.h"
#include "../include/flatten_mesh/doors.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/precision.h"

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/make_refined_mesh.h>
#include <CGAL/Conformal_equivalence/multiprecision.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/triangulate_refinement.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace flattening {

namespace {

// The weights of all vertices follow from the scale factors, and the scale factors of crossings from their weights, up to a constant on each
// component that was mapped by itself.
void find_scale_factors(const Result& given, Result& refined)
{
  const Components components(given.mesh);
  std::vector<double> least(components.size(), std::numeric_limits<double>::infinity()), largest_weight(components.size(), 0.);
  for(Vertex v : given.mesh.vertices())
    if(! given.mesh.is_isolated(v))
    {
      const std::uint32_t c = components.of_vertex(v);
      if(refined.weight[v] > largest_weight[c])
      {
        largest_weight[c] = refined.weight[v];
        least[c] = given.u[v] + std::log(refined.weight[v]);
      }
    }
  for(Vertex v : given.mesh.vertices())
    refined.u[v] = given.u[v];
  for(Face f : refined.mesh.faces())
    for(Vertex v : vertices_of_face(refined.mesh, f))
      if(v.idx() >= given.mesh.number_of_vertices())
        refined.u[v] = least[components.of_face(Face(static_cast<Mesh::size_type>(refined.given_face[f.idx()])))] - std::log(refined.weight[v]);
}

// Of a refinement, which knows points by corners.
void find_image_of_corners(Result& refined)
{
  refined.image.assign(refined.mesh.number_of_vertices(), origin<double>());
  if(refined.wide.is_used)
    refined.wide_image.assign(refined.mesh.number_of_vertices(), origin<CE::Multiprecision_number>());
  for(Halfedge h : refined.mesh.halfedges())
  {
    if(refined.mesh.is_border(h))
      continue;
    const std::size_t v = refined.mesh.target(h).idx();
    refined.image[v] = {{ refined.uv[h].x(), refined.uv[h].y(), 0 }};
    if(refined.wide.is_used)
      refined.wide_image[v] = {{ refined.wide.uv[h].x(), refined.wide.uv[h].y(), CE::Multiprecision_number(0) }};
  }
}

// The points of a mesh made of `parts`, before rounding.
void set_wide_points(const Wide_refinement& parts, const CE::Refined_mesh_elements<Mesh>& elements, Mesh& mesh, Wide_layout& wide)
{
  use_wide_points(mesh, wide);
  for(std::size_t c = 0; c < elements.halfedges.size(); ++c)
    wide.uv[elements.halfedges[c]] = Wide_point(parts.corner_uv[c][0], parts.corner_uv[c][1]);
}

} // namespace

// ---- Rounding (precision.h)

std::array<double, 2> rounded(const CE::Multiprecision_number& x, const CE::Multiprecision_number& y)
{
  return {{ static_cast<double>(x), static_cast<double>(y) }};
}

CE::Common_refinement<double> rounded(const Wide_refinement& wide)
{
  CE::Common_refinement<double> result;
  result.number_of_input_vertices = wide.number_of_input_vertices;
  for(const Wide_refinement::Crossing& x : wide.crossings)
    result.crossings.push_back({x.input_edge, static_cast<double>(x.input_parameter), x.flat_edge, static_cast<double>(x.flat_parameter)});
  for(const CE::Multiprecision_number& w : wide.weights)
    result.weights.push_back(static_cast<double>(w));
  result.first_corner = wide.first_corner;
  result.input_face = wide.input_face;
  result.flat_face = wide.flat_face;
  result.corner_vertex = wide.corner_vertex;
  for(const std::array<CE::Multiprecision_number, 2>& z : wide.corner_uv)
    result.corner_uv.push_back(rounded(z[0], z[1]));
  result.corner_halfedge = wide.corner_halfedge;
  result.angle_sums = wide.angle_sums;
  result.status = wide.status;
  result.amount = wide.amount;
  return result;
}

void use_wide_points(Mesh& mesh, Wide_layout& wide)
{
  wide.is_used = true;
  wide.uv = mesh.add_property_map<Halfedge, Wide_point>("h:wide_uv").first;
}

void round_layout(const Mesh& mesh, const Wide_layout& wide, UV_map uv, CE::Common_refinement<double>& refinement)
{
  for(Halfedge h : mesh.halfedges())
  {
    const std::array<double, 2> p = rounded(wide.uv[h].x(), wide.uv[h].y());
    uv[h] = Kernel::Point_2(p[0], p[1]);
  }
  refinement = rounded(wide.refinement);
}

Space_point rounded(const Wide_space_point& p)
{
  return {{ static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]) }};
}

std::vector<Space_point> rounded(const std::vector<Wide_space_point>& points)
{
  std::vector<Space_point> result;
  for(const Wide_space_point& p : points)
    result.push_back(rounded(p));
  return result;
}

// ---- The mesh of the refinement

void make_refined_mesh(const Options& options, const Result& given, const Refinement& refinement, Result& refined)
{
  const auto make = [&](const auto& mesh, const auto& parts)
  {
    const auto elements = CE::make_refined_mesh(mesh, parts, refined.mesh, refined.uv, CGAL::parameters::default_values(),
                                                CGAL::parameters::projective_weight_map(refined.weight));
    if(elements.faces.empty())
      fail(options.input, ": ", CE::message(CE::Status::NOT_REPRESENTABLE));
    refined.given_face.assign(parts.input_face.begin(), parts.input_face.end());
    return elements;
  };
  if(given.wide.is_used)
  {
    const Wide_refinement parts = CE::triangulate_refinement(given.wide.refinement);
    set_wide_points(parts, make(CE::import_mesh<CE::Multiprecision_number>(given.mesh), parts), refined.mesh, refined.wide);
  }
  else
    make(CE::import_mesh(given.mesh), CE::triangulate_refinement(refinement));
  find_scale_factors(given, refined);
  if(options.target == Target::DISK)
    find_image_of_corners(refined);
}

} // namespace flattening
