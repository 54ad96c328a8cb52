#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/place_cones.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <string>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;

namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/lion-head.off");

  Mesh sm;
  if(!PMP::IO::read_polygon_mesh(filename, sm) || is_empty(sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }
  //! [part]
  auto uv = sm.add_property_map<halfedge_descriptor, Kernel::Point_2>("h:uv").first;
  auto angle = sm.add_property_map<vertex_descriptor, double>("v:cone_angle").first;
  auto u = sm.add_property_map<vertex_descriptor, double>("v:u").first;

  // Five cones, with multiples of a right angle.
  const std::size_t number_of_cones = 5;
  const auto placement = CE::place_cones(sm, angle, params::number_of_cones(number_of_cones).angle_quantum(CGAL_PI / 2));
  if(!placement)
  {
    std::cerr << CE::message(placement) << std::endl;
    return EXIT_FAILURE;
  }
  for(const auto& cone : placement.cones)
    std::cout << "cone at vertex " << cone.vertex_index << ", angle " << cone.angle * 180 / CGAL_PI << " degrees" << std::endl;
  //! [part]

  //! [flatten]
  // The mesh with these cones, laid out.
  const auto report = CE::flatten(sm, uv, params::cone_angle_map(angle).log_scale_factor_map(u));
  //! [flatten]
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }
  double largest = 0;
  for(vertex_descriptor v : vertices(sm))
    largest = (std::max)(largest, std::abs(u[v]));
  std::cout << "largest |u| " << largest << " after " << report.statistics.number_of_iterations << " Newton steps" << std::endl;
  return EXIT_SUCCESS;
}
