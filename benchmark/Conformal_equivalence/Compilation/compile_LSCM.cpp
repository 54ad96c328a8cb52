// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What a program costs to compile that calls CGAL's LSCM: the measure of the others in this folder.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh_parameterization/IO/File_off.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <fstream>

typedef CGAL::Simple_cartesian<double>                         Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3>                    Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor           vertex_descriptor;
namespace SMP = CGAL::Surface_mesh_parameterization;

int main(int argc, char* argv[])
{
  Mesh sm;
  if(argc < 3 || !CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(argv[1], sm)) return 1;
  const auto bhd = CGAL::Polygon_mesh_processing::longest_border(sm).first;
  if(bhd == boost::graph_traits<Mesh>::null_halfedge()) return 1;
  auto uv = sm.add_property_map<vertex_descriptor, Kernel::Point_2>("v:uv").first;
  typedef SMP::LSCM_parameterizer_3<Mesh, SMP::Two_vertices_parameterizer_3<Mesh> > Parameterizer;
  if(SMP::parameterize(sm, Parameterizer(), bhd, uv) != SMP::OK) return 1;
  std::ofstream out(argv[2]);
  SMP::IO::output_uvmap_to_off(sm, bhd, uv, out);
  return out.good() ? 0 : 1;
}
