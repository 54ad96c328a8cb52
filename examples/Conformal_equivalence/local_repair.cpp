#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>
#include <CGAL/Conformal_equivalence/flatten_repaired.h>

#include <fstream>
#include <iostream>
#include <string>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;

namespace CE = CGAL::Conformal_equivalence;

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/mannequin-devil.off");

  Mesh sm;
  if(!CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(filename, sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  //! [part]
  // Where the metric of the given triangulation breaks triangles, a copy of the mesh is changed.
  Mesh repaired;
  auto uv = repaired.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  const auto report = CE::flatten_repaired(sm, repaired, uv);
  //! [part]
  if(!report)
  {
    std::cerr << "Not flattened: " << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }

  for(const auto& change : report.changes)
  {
    if(change.kind == change.FLIP)
      std::cout << "flipped ";
    else
      std::cout << "new vertex " << change.new_vertex << " on ";
    std::cout << "edge " << change.vertices[0] << '-' << change.vertices[1] << '\n';
  }

  std::ofstream out("local_repair.obj");
  CE::IO::write_OBJ(out, repaired, uv);
  std::cout << "Flattened " << num_faces(repaired) << " triangles into local_repair.obj" << std::endl;
  return EXIT_SUCCESS;
}
