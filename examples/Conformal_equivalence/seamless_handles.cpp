#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/compute_refined_seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>
#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>

#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <string>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/eight.off");

  Mesh sm;
  if(!CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(filename, sm) || is_empty(sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  //! [part]
  // Sixteen cones, with multiples of a right angle; all loops around the handles turn by such multiples, too.
  auto uv = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  const auto np = params::number_of_cones(16).maximum_distortion(1.05);
  auto report = CE::compute_seamless_parameterization(sm, uv, np);

  // Where edges had to be flipped in such a way that straight triangles are inverted, on a mesh of parts.
  Mesh refined;
  auto refined_uv = refined.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  const bool is_refined = report.status == CE::Status::NOT_INJECTIVE;
  if(is_refined)
    report = CE::compute_refined_seamless_parameterization(sm, refined, refined_uv, np);
  //! [part]
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }

  for(const auto& loop : report.handles.loops)
    std::cout << "a loop across " << loop.halfedges.size() << " edges turned by " << loop.conformal_turning / (CGAL_PI / 2)
              << " right angles, and turns by " << loop.quanta << std::endl;
  std::cout << report.handles.number_of_steps << " steps; logarithms of length cross ratios have changed by "
            << report.handles.mean_departure << " (root of the mean square)" << std::endl;
  const Mesh& result = is_refined ? refined : sm;
  const auto& result_uv = is_refined ? refined_uv : uv;
  const std::size_t number_of_flipped_triangles = CE::verify_layout(result, result_uv).number_of_flipped_triangles;
  std::cout << report.cones.size() << " cones, " << report.tiling.number_of_tiles << " tiles; flipped triangles: "
            << number_of_flipped_triangles << std::endl;
  if(number_of_flipped_triangles > 0)
    return EXIT_FAILURE;
  return CE::IO::write_OBJ("seamless_handles.obj", result, result_uv) ? EXIT_SUCCESS : EXIT_FAILURE;
}
