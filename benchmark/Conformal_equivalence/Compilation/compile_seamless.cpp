// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What a program costs to compile that makes a seamless texture with automatic cones.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Conformal_equivalence/compute_seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>

#include <iostream>

typedef CGAL::Simple_cartesian<double>                         Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3>                    Mesh;
namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;

int main(int argc, char* argv[])
{
  Mesh sm;
  if(argc < 3 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], sm)) return 1;
  auto uv = sm.add_property_map<Mesh::Halfedge_index, Kernel::Point_2>("h:uv").first;
  auto seam = sm.add_property_map<Mesh::Edge_index, bool>("e:seam", false).first;
  const auto report = CE::compute_seamless_parameterization(sm, uv, params::number_of_cones(8).number_of_tiles(40).edge_is_seam_map(seam));
  if(!report) { std::cerr << CE::message(report) << "\n"; return 1; }
  return CE::IO::write_OBJ(argv[2], sm, uv) ? 0 : 1;
}
