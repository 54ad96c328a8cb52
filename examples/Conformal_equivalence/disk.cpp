#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>
#include <CGAL/Conformal_equivalence/map_to_disk.h>

#include <cstdlib>
#include <iostream>
#include <string>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/nefertiti.off");

  Mesh sm;
  if(!CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(filename, sm) || is_empty(sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  // All border vertices go to the unit circle. Of the maps that do this, which differ by Moebius transformations, the one that takes
  // an inner vertex to the centre.
  vertex_descriptor centre = Mesh::null_vertex();
  for(vertex_descriptor v : vertices(sm))
    if(centre == Mesh::null_vertex() && !sm.is_isolated(v) && !sm.is_border(v))
      centre = v;
  if(centre == Mesh::null_vertex())
  {
    std::cerr << "There is no inner vertex." << std::endl;
    return EXIT_FAILURE;
  }

  //! [part]
  // Where edges had to be flipped, the refined mesh has vertices where edges cross; otherwise it is a copy.
  Mesh refined;
  auto uv = refined.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  auto weight = refined.add_property_map<vertex_descriptor, double>("v:weight", 1).first;
  const auto report = CE::map_to_disk_refined(sm, refined, uv, params::disk_frame(CE::Centred_disk_frame<vertex_descriptor>{centre}),
                                              params::projective_weight_map(weight));
  //! [part]
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << report.statistics.number_of_flips << " flips; " << num_faces(refined) << " triangles for " << num_faces(sm)
            << "; border edges flipped: " << report.lost_border_edges.size() << std::endl;
  return CE::IO::write_OBJ("disk.obj", refined, uv, params::projective_weight_map(weight)) ? EXIT_SUCCESS : EXIT_FAILURE;
}
