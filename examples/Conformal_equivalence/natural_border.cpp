#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <CGAL/Surface_mesh_parameterization/Conformal_equivalence_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/IO/File_off.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <fstream>
#include <iostream>
#include <string>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;

namespace SMP = CGAL::Surface_mesh_parameterization;
namespace PMP = CGAL::Polygon_mesh_processing;

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/nefertiti.off");

  Mesh sm;
  if(!PMP::IO::read_polygon_mesh(filename, sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  // The border is natural: it keeps its lengths.
  const halfedge_descriptor bhd = PMP::longest_border(sm).first;
  if(bhd == Mesh::null_halfedge())
  {
    std::cerr << "The mesh has no border: " << filename << std::endl;
    return EXIT_FAILURE;
  }
  auto uv = sm.add_property_map<vertex_descriptor, Point_2>("v:uv").first;

  const SMP::Error_code e = SMP::parameterize(sm, SMP::Conformal_equivalence_parameterizer_3<Mesh>(), bhd, uv);
  if(e != SMP::OK)
  {
    std::cerr << "Not flattened: error " << e << std::endl;
    return EXIT_FAILURE;
  }

  std::ofstream out("natural_border.off");
  SMP::IO::output_uvmap_to_off(sm, bhd, uv, out);
  std::cout << "Flattened " << num_faces(sm) << " triangles into natural_border.off" << std::endl;
  return EXIT_SUCCESS;
}
