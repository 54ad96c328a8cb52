#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>

#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>
#include <CGAL/Conformal_equivalence/conformal_distortion.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef Kernel::Vector_3                                     Vector_3;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;
typedef boost::graph_traits<Mesh>::edge_descriptor           edge_descriptor;
typedef boost::graph_traits<Mesh>::face_descriptor           face_descriptor;

namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

// Which of the six directions of the axes the face looks to.
int direction(face_descriptor f, const Mesh& sm)
{
  const Vector_3 n = PMP::compute_face_normal(f, sm);
  int axis = 0;
  for(int i = 1; i < 3; ++i)
    if(std::abs(n[i]) > std::abs(n[axis]))
      axis = i;
  return 2 * axis + (n[axis] < 0 ? 1 : 0);
}

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/blobby.off");

  Mesh sm;
  if(!PMP::IO::read_polygon_mesh(filename, sm) || is_empty(sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  //! [part]
  // Faces of the same number that hang together are a chart, with a border of its own, which keeps its lengths.
  auto patch = sm.add_property_map<face_descriptor, int>("f:patch").first;
  for(face_descriptor f : faces(sm))
    patch[f] = direction(f, sm);

  auto uv = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  auto seam = sm.add_property_map<edge_descriptor, bool>("e:is_seam", false).first;
  const auto report = CE::flatten(sm, uv, params::edge_is_seam_map(seam).face_patch_map(patch)
                                                 .layout_frame(CE::Layout_frame::UNIT_SQUARE));
  //! [part]
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }

  // Edges between charts are seams. Charts that are no disks have seams inside, too, with a transition for each.
  const auto number_of_seam_edges = std::count(seam.begin(), seam.end(), true);
  std::cout << report.topology.number_of_components << " charts with " << report.topology.number_of_borders << " borders; "
            << number_of_seam_edges << " seam edges, " << report.transitions.size() << " of them inside of charts" << std::endl;

  const auto distortion = CE::compute_conformal_distortion(sm, uv);
  const auto verdict = CE::verify_layout(sm, uv);
  std::cout << "quasi-conformal factor: mean " << distortion.mean_quasi_conformal_factor
            << ", max " << distortion.maximum_quasi_conformal_factor << "; "
            << (verdict.injectivity == CE::Injectivity::YES ? "no chart overlaps itself" : "some chart overlaps itself") << std::endl;

  if(argc > 2 && !CE::IO::write_OBJ(argv[2], sm, uv))
  {
    std::cerr << "Cannot write: " << argv[2] << std::endl;
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
