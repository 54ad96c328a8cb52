// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Calls that must not compile. run.cmake hands this file to the compiler, and looks in what it
// says for the message in the comment before each call.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Conformal_equivalence/compute_seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/flatten_refined.h>
#include <CGAL/Conformal_equivalence/flatten_repaired.h>
#include <CGAL/Conformal_equivalence/map_to_disk.h>
#include <CGAL/Conformal_equivalence/map_to_sphere.h>
#include <CGAL/Conformal_equivalence/place_cones.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_equivalence_parameterizer_3.h>

#include <map>

typedef CGAL::Simple_cartesian<double>                Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3>           Mesh;
typedef Mesh::Vertex_index                            Vertex;
typedef Mesh::Halfedge_index                          Halfedge;
typedef Mesh::Edge_index                              Edge;

namespace CE = CGAL::Conformal_equivalence;
namespace SMP = CGAL::Surface_mesh_parameterization;
namespace params = CGAL::parameters;

int main()
{
  Mesh mesh, made;
  const auto uv = mesh.add_property_map<Halfedge, Kernel::Point_2>("h:uv").first;
  const auto vertex_uv = mesh.add_property_map<Vertex, Kernel::Point_2>("v:uv").first;
  const auto vertex_point = mesh.add_property_map<Vertex, Kernel::Point_3>("v:image").first;
  const auto number = mesh.add_property_map<Vertex, double>("v:number").first;
  const auto mark = mesh.add_property_map<Edge, bool>("e:mark").first;

  // ---- Maps that results are written to

  // refused: coordinates are written to a property map; for a std::map, see boost::make_assoc_property_map()
  CE::flatten(mesh, std::map<Halfedge, Kernel::Point_2>());
  // refused: coordinates are written by corner: the keys of the property map must be the halfedges of the mesh, not its vertices
  CE::flatten(mesh, vertex_uv);
  // refused: results are written by vertex: the keys of the property map must be the vertices of the mesh
  CE::map_to_disk(mesh, uv);

  // ---- What is no map, or one of other elements; what is to be a reference

  // refused: cone_angle_map() takes a property map, by value; for a std::map, see boost::make_assoc_property_map()
  CE::flatten(mesh, uv, params::cone_angle_map(3.14));
  // refused: border_angle_map() takes a property map, by value; for a std::map, see boost::make_assoc_property_map()
  CE::flatten(mesh, uv, params::border_angle_map(std::map<Vertex, double>()));
  // refused: log_scale_factor_map() takes a property map whose keys are the vertices of the mesh
  CE::flatten(mesh, uv, params::log_scale_factor_map(uv));
  // refused: edge_length_map() takes a property map whose keys are the edges of the mesh
  CE::flatten(mesh, uv, params::edge_length_map(number));
  // refused: flattening_report() is written to: hand the object over by std::ref()
  CE::flatten(mesh, uv, params::flattening_report(CE::Flattening_report<Mesh>()));
  // refused: spherical_refinement() is written to: hand the object over by std::ref()
  CE::map_to_sphere(mesh, vertex_point, params::spherical_refinement(CE::Spherical_refinement<double>()));

  // ---- What a door does not read

  // refused: the named parameter number_of_cones() is not read by this function
  CE::flatten(mesh, uv, params::number_of_cones(3));
  // refused: the named parameter maximum_log_scale_factor() is not read by this function
  CE::flatten_refined(mesh, made, uv, params::maximum_log_scale_factor(1.));
  // refused: the named parameter angle_quantum() is not read by this function
  CE::flatten_repaired(mesh, made, uv, params::angle_quantum(1.));
  // refused: the named parameter number_of_tiles() is not read by this function
  CE::map_to_sphere(mesh, vertex_point, params::number_of_tiles(3));
  // refused: the named parameter border_edges() is not read by this function
  CE::map_to_disk(mesh, vertex_uv, params::border_edges(CE::Border_edges::KEPT));
  // refused: the named parameter cone_angle_map() is not read by this function
  CE::place_cones(mesh, number, params::number_of_cones(3).cone_angle_map(number));
  // refused: the named parameter layout_frame() is not read by this function
  CE::compute_seamless_parameterization(mesh, uv, params::layout_frame(CE::Layout_frame::CANONICAL));
  // refused: the named parameter edge_is_seam_map() is not read by this function
  SMP::Conformal_equivalence_parameterizer_3<Mesh> parameterizer(params::edge_is_seam_map(mark));
}
