#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/map_to_sphere.h>

#include <cstdlib>
#include <iostream>
#include <string>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_3                                      Point_3;
typedef CGAL::Surface_mesh<Point_3>                          Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/bear.off");

  Mesh sm;
  if(!CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(filename, sm) || is_empty(sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  //! [part]
  // A closed surface without handles, as the unit sphere. Where edges have to be flipped on the way, the triangles between the
  // points of the sphere may be flipped: the map is then that of the refined mesh, which has the vertices of the given one, and
  // those where edges cross.
  Mesh refined;
  auto sphere = refined.add_property_map<vertex_descriptor, Point_3>("v:sphere").first;
  const auto report = CE::map_to_sphere_refined(sm, refined, sphere, params::moebius_weights(CE::Moebius_weights::VERTICES));
  //! [part]
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << report.statistics.number_of_flips << " flips; " << num_faces(refined) << " triangles for " << num_faces(sm)
            << "; solid angle: " << report.solid_angle / CGAL_PI << " pi; triangles lost by rounding: " << report.rounded_faces.size() << std::endl;

  for(vertex_descriptor v : vertices(refined))
    refined.point(v) = sphere[v];
  return CGAL::IO::write_OFF("sphere.off", refined, params::stream_precision(17)) ? EXIT_SUCCESS : EXIT_FAILURE;
}
