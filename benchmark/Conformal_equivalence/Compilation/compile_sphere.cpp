// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What a program costs to compile that maps a surface to the sphere.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Conformal_equivalence/map_to_sphere.h>

#include <iostream>

typedef CGAL::Simple_cartesian<double>                         Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3>                    Mesh;
namespace CE = CGAL::Conformal_equivalence;

int main(int argc, char* argv[])
{
  Mesh sm;
  if(argc < 3 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], sm)) return 1;
  auto on_sphere = sm.add_property_map<Mesh::Vertex_index, Kernel::Point_3>("v:sphere").first;
  const auto report = CE::map_to_sphere(sm, on_sphere);
  if(!report) { std::cerr << CE::message(report) << "\n"; return 1; }
  return CGAL::IO::write_polygon_mesh(argv[2], sm, CGAL::parameters::vertex_point_map(on_sphere)) ? 0 : 1;
}
