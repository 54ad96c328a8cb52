// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Flattens a small pyramid without its base.

#include <CGAL/Surface_mesh_parameterization/Conformal_equivalence_parameterizer_3.h>
#include <CGAL/Conformal_equivalence/version.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <array>
#include <cmath>
#include <iostream>

typedef CGAL::Simple_cartesian<double> Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3> Mesh;

namespace SMP = CGAL::Surface_mesh_parameterization;

int main()
{
  Mesh mesh;
  const auto apex = mesh.add_vertex(Kernel::Point_3(0, 0, 1));
  std::array<Mesh::Vertex_index, 4> base;
  for(int i = 0; i < 4; ++i)
    base[i] = mesh.add_vertex(Kernel::Point_3(i == 0 ? 1 : i == 2 ? -1 : 0, i == 1 ? 1 : i == 3 ? -1 : 0, 0));
  for(int i = 0; i < 4; ++i)
    mesh.add_face(apex, base[i], base[(i + 1) % 4]);

  Mesh::Halfedge_index border;
  for(const auto h : mesh.halfedges())
    if(mesh.is_border(h))
      border = h;

  auto uv = mesh.add_property_map<Mesh::Vertex_index, Kernel::Point_2>("v:uv").first;
  const SMP::Error_code error =
    SMP::parameterize(mesh, SMP::Conformal_equivalence_parameterizer_3<Mesh>(), border, uv);

  // By symmetry it becomes the square of the same border, with the apex in the middle.
  const double diagonal = std::sqrt(CGAL::squared_distance(uv[base[0]], uv[base[2]]));
  const double off_center = std::sqrt(CGAL::squared_distance(uv[apex], CGAL::midpoint(uv[base[0]], uv[base[2]])));

  std::cout << "application with Conformal_equivalence " << CGAL_CONFORMAL_EQUIVALENCE_VERSION
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_CHOLMOD
            << " and CHOLMOD"
#endif
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED
            << ", the engines compiled before"
#endif
            << ": error code " << error << ", diagonal " << diagonal << ", off center by " << off_center << std::endl;
  return error == SMP::OK && std::fabs(diagonal - 2) < 1e-9 && off_center < 1e-9 ? 0 : 1;
}
