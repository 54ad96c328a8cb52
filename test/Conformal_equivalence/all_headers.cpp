// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Every public header in one translation unit, and the main functions instantiated: this
// is what is compiled with every version of CGAL and every compiler. The build lists the
// headers in all_public_headers.h, and compiles them once more in a second unit.

#include "all_public_headers.h"

#include <CGAL/boost/graph/graph_traits_Polyhedron_3.h>
#include <CGAL/boost/graph/IO/OFF.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>
#include <CGAL/version.h>

#include <Eigen/Core>

#include <boost/property_map/property_map.hpp>
#include <boost/version.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace CE = CGAL::Conformal_equivalence;
namespace SMP = CGAL::Surface_mesh_parameterization;

typedef CGAL::Exact_predicates_inexact_constructions_kernel Kernel;
typedef Kernel::Point_2 Point_2;

// a pyramid without its base, which flattens to a square with diagonal 2
const char* const pyramid = "OFF\n5 4 0\n0 0 1\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n"
                            "3 0 1 2\n3 0 2 3\n3 0 3 4\n3 0 4 1\n";

bool failed(const std::string& what)
{
  std::cout << "failed: " << what << std::endl;
  return false;
}

template <typename Mesh>
bool all_is_well(const std::string& type)
{
  typedef typename boost::graph_traits<Mesh>::halfedge_descriptor halfedge_descriptor;
  typedef typename boost::graph_traits<Mesh>::vertex_descriptor vertex_descriptor;

  Mesh mesh;
  std::istringstream in(pyramid);
  if(!CGAL::IO::read_OFF(in, mesh))
    return failed("read_OFF of " + type);

  std::map<halfedge_descriptor, Point_2> corners;
  const boost::associative_property_map<std::map<halfedge_descriptor, Point_2> > uv(corners);
  const auto report = CE::flatten(mesh, uv);
  if(!report)
    return failed("flatten of " + type + ": " + CE::message(report));

  std::map<vertex_descriptor, double> angles;
  const boost::associative_property_map<std::map<vertex_descriptor, double> > angle(angles);
  const halfedge_descriptor border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  CE::prescribe_rectangle(mesh, CE::select_rectangle_corners(mesh, border), angle);
  if(!CE::flatten(mesh, uv, CGAL::parameters::border_angle_map(angle)))
    return failed("rectangle of " + type);
  if(CE::verify_layout(mesh, uv).injectivity != CE::Injectivity::YES)
    return failed("verify_layout of " + type);
  if(!(CE::compute_conformal_distortion(mesh, uv).mean_quasi_conformal_factor >= 1))
    return failed("compute_conformal_distortion of " + type);

  std::map<vertex_descriptor, Point_2> points;
  const boost::associative_property_map<std::map<vertex_descriptor, Point_2> > vertex_uv(points);
  if(SMP::parameterize(mesh, SMP::Conformal_equivalence_parameterizer_3<Mesh>(), border, vertex_uv) != SMP::OK)
    return failed("parameterize of " + type);

  double diagonal = 0;
  for(const auto& a : points)
    for(const auto& b : points)
      diagonal = (std::max)(diagonal, std::sqrt(CGAL::squared_distance(a.second, b.second)));
  if(!(std::fabs(diagonal - 2) < 1e-9))
    return failed("the size of " + type);
  if(!CE::map_to_disk(mesh, vertex_uv))
    return failed("map_to_disk of " + type);
  if(CE::uniformize_hyperbolic(mesh).status != CE::Status::WRONG_TOPOLOGY)
    return failed("uniformize_hyperbolic of " + type);

  std::ostringstream out;
  return CE::IO::write_OBJ(out, mesh, uv) || failed("write_OBJ of " + type);
}

// An octagon of which opposite sides are glued, as a fan of six triangles: a surface of genus 2 with one vertex.
bool hyperbolic_surface_is_well()
{
  const std::vector<std::uint32_t> twin = {10, 13, 3, 2, 16, 6, 5, 17, 9, 8, 0, 12, 11, 1, 15, 14, 4, 7};
  const CE::Intrinsic_triangulation<> octagon(1, std::vector<std::uint32_t>(twin.size(), 0), twin);
  const auto u = CE::internal::Uniformization::run(octagon, CE::Conformal_conditions<>(octagon), CE::Solver_options(),
                                                   CE::internal::make_factorization<CE::Default_solver_traits>());
  if(!u.is_laid_out() || !(std::fabs(u.metric.length(0) - 2 * std::acosh(1 / (2 * std::sin(CGAL_PI / 18)))) < 1e-12))
    return failed("the metric of an octagon");
  const auto exact = CE::realize_exactly(u);
  if(exact.status != CE::Status::OK)
    return failed("realize_exactly");
#ifdef CGAL_CONFORMAL_EQUIVALENCE_HAS_HYPERBOLIC_SURFACES
  if(!CE::make_triangulation_on_hyperbolic_surface(exact).is_valid())
    return failed("make_triangulation_on_hyperbolic_surface");
#endif
  return true;
}

// 3.4.0, and from 5 on without the world version
std::string Eigen_version()
{
  const std::string version = std::to_string(EIGEN_MAJOR_VERSION) + '.' + std::to_string(EIGEN_MINOR_VERSION);
  return EIGEN_MAJOR_VERSION < 5 ? std::to_string(EIGEN_WORLD_VERSION) + '.' + version : version;
}

int main()
{
  std::cout << "Conformal_equivalence " << CGAL_CONFORMAL_EQUIVALENCE_VERSION
            << ", CGAL " << CGAL_VERSION_STR
            << ", Eigen " << Eigen_version()
            << ", Boost " << BOOST_LIB_VERSION << std::endl;

  const bool ok = all_is_well<CGAL::Surface_mesh<Kernel::Point_3> >("Surface_mesh")
               && all_is_well<CGAL::Polyhedron_3<Kernel> >("Polyhedron_3")
               && hyperbolic_surface_is_well();
  return ok ? 0 : 1;
}
