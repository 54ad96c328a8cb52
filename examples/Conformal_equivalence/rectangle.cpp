#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <CGAL/Conformal_equivalence/boundary_conditions.h>
#include <CGAL/Conformal_equivalence/flatten.h>

#include <iostream>
#include <string>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;

namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/nefertiti.off");

  Mesh sm;
  if(!PMP::IO::read_polygon_mesh(filename, sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }
  const halfedge_descriptor bhd = PMP::longest_border(sm).first;
  if(bhd == Mesh::null_halfedge())
  {
    std::cerr << "The mesh has no border: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  //! [part]
  auto uv = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  auto angle = sm.add_property_map<vertex_descriptor, double>("v:border_angle", 0).first;

  // Four right angles, all else straight. The aspect ratio is an outcome.
  const auto corners = CE::select_rectangle_corners(sm, bhd);
  CE::prescribe_rectangle(sm, corners, angle);
  const auto report = CE::flatten(sm, uv, params::border_angle_map(angle));
  //! [part]
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }

  std::cout << "corners:" << std::endl;
  for(halfedge_descriptor h : halfedges_around_face(bhd, sm))
    for(vertex_descriptor v : corners)
      if(target(h, sm) == v)
        std::cout << "  " << v << " at " << uv[h] << std::endl;
  return EXIT_SUCCESS;
}
