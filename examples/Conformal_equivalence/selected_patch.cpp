#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/boost/graph/Face_filtered_graph.h>
#include <CGAL/boost/graph/selection.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef CGAL::Face_filtered_graph<Mesh>                      Patch;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;
typedef boost::graph_traits<Mesh>::face_descriptor           face_descriptor;

namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/elephant.off");
  const unsigned int number_of_rings = (argc > 2) ? std::atoi(argv[2]) : 6;

  Mesh sm;
  if(!PMP::IO::read_polygon_mesh(filename, sm) || is_empty(sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  //! [part]
  // Some rings of triangles around the first one, on a closed mesh.
  auto is_selected = sm.add_property_map<face_descriptor, bool>("f:is_selected", false).first;
  std::vector<face_descriptor> selection(1, *faces(sm).begin());
  is_selected[selection.front()] = true;
  CGAL::expand_face_selection(std::vector<face_descriptor>(selection), sm, number_of_rings,
                              is_selected, std::back_inserter(selection));
  const Patch patch(sm, selection);

  // The maps are those of the whole mesh; nothing is written outside of the patch.
  auto uv = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  auto u = sm.add_property_map<vertex_descriptor, double>("v:log_scale_factor", 0).first;
  const auto report = CE::flatten(patch, uv, params::log_scale_factor_map(u));
  //! [part]
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }

  double least = 0;
  for(vertex_descriptor v : vertices(patch))
    least = (std::min)(least, u[v]);
  const auto verdict = CE::verify_layout(patch, uv);
  std::cout << "flattened " << num_faces(patch) << " of " << num_faces(sm) << " triangles, u from " << least
            << ", " << (verdict.injectivity == CE::Injectivity::YES ? "injective" : "with overlaps") << std::endl;
  return EXIT_SUCCESS;
}
