#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/boost/graph/Seam_mesh.h>

#include <CGAL/Surface_mesh_parameterization/Conformal_equivalence_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/IO/File_off.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;
typedef boost::graph_traits<Mesh>::edge_descriptor           edge_descriptor;
typedef Mesh::Property_map<edge_descriptor, bool>            Seam_edge_map;
typedef Mesh::Property_map<vertex_descriptor, bool>          Seam_vertex_map;
typedef CGAL::Seam_mesh<Mesh, Seam_edge_map, Seam_vertex_map> Seam_mesh;

namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace SMP = CGAL::Surface_mesh_parameterization;
namespace params = CGAL::parameters;

// The vertices in the first line of a selection file.
std::vector<vertex_descriptor> read_selected_vertices(const std::string& filename, const Mesh& sm)
{
  std::vector<vertex_descriptor> result;
  std::ifstream in(filename);
  std::string line;
  std::getline(in, line);
  std::istringstream numbers(line);
  for(std::size_t i; numbers >> i; )
    if(i < num_vertices(sm))
      result.push_back(*std::next(vertices(sm).begin(), i));
  return result;
}

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/bear.off");
  const std::string selection_filename = (argc > 2) ? argv[2] : "data/bear_seam.selection.txt";

  Mesh sm;
  if(!PMP::IO::read_polygon_mesh(filename, sm) || is_empty(sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  // A selection file as CGAL's demo writes it: vertices in its first line, edges in the third. The edges are the seam,
  auto seam = sm.add_property_map<edge_descriptor, bool>("e:is_seam", false).first;
  auto on_seam = sm.add_property_map<vertex_descriptor, bool>("v:is_on_seam", false).first;
  Seam_mesh seam_mesh(sm, seam, on_seam);
  if(seam_mesh.add_seams(selection_filename.c_str()) == halfedge_descriptor())
  {
    std::cerr << "No seam in " << selection_filename << std::endl;
    return EXIT_FAILURE;
  }

  // and the vertices become cones. They share the curvature of the sphere, 4 pi.
  const std::vector<vertex_descriptor> cones = read_selected_vertices(selection_filename, sm);
  auto angle = sm.add_property_map<vertex_descriptor, double>("v:cone_angle", 2 * CGAL_PI).first;
  for(vertex_descriptor v : cones)
    angle[v] = 2 * CGAL_PI - 4 * CGAL_PI / cones.size();

  //! [part]
  // The maps of the parameterizer, and its report, are those of the mesh that is cut; the layout is that of the Seam_mesh.
  CE::Flattening_report<Mesh> report;
  SMP::Conformal_equivalence_parameterizer_3<Seam_mesh>
    parameterizer(params::cone_angle_map(angle).flattening_report(std::ref(report)));
  const auto bhd = PMP::longest_border(seam_mesh).first;
  auto uv = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  if(SMP::parameterize(seam_mesh, parameterizer, bhd, uv) != SMP::OK)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }
  //! [part]

  std::ofstream out("seam_mesh.off");
  SMP::IO::output_uvmap_to_off(seam_mesh, bhd, uv, out);
  std::cout << "residual " << report.statistics.residual << ", " << report.transitions.size() << " edges cut, cones:" << std::endl;
  for(const auto& cone : report.cones)
    std::cout << "  " << cone.vertex << " of " << cone.angle / CGAL_PI * 180 << " degrees" << std::endl;
  return EXIT_SUCCESS;
}
