#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/flatten_refined.h>
#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>

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
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/bull.off");

  Mesh sm;
  if(!CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(filename, sm) || is_empty(sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  // A closed surface with eight cones, the angles of which are found: u = 0 there.
  auto is_cone = sm.add_property_map<vertex_descriptor, bool>("v:cone", false).first;
  if(CGAL::is_closed(sm))
    for(std::size_t i = 0; i < 8; ++i)
      is_cone[*std::next(vertices(sm).begin(), i * num_vertices(sm) / 8)] = true;
  else
    for(vertex_descriptor v : vertices(sm))
      is_cone[v] = sm.is_border(v); // a natural border

  //! [part]
  // Edges are flipped if there is no such metric on the given triangulation. The new mesh has the vertices of the
  // given one, and those where edges of both triangulations cross.
  Mesh refined;
  auto uv = refined.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  auto weight = refined.add_property_map<vertex_descriptor, double>("v:weight", 1).first;
  const auto report = CE::flatten_refined(sm, refined, uv, params::vertex_is_constrained_map(is_cone),
                                          params::projective_weight_map(weight));
  //! [part]
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << report.statistics.number_of_flips << " flips; " << num_faces(refined) << " triangles for " << num_faces(sm)
            << "; of the given triangles, " << report.bent_faces.size() << " are not positive if drawn straight" << std::endl;
  return CE::IO::write_OBJ("refined_mesh.obj", refined, uv, params::projective_weight_map(weight)) ? EXIT_SUCCESS : EXIT_FAILURE;
}
