#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/boundary_conditions.h>
#include <CGAL/Conformal_equivalence/compute_common_refinement.h>
#include <CGAL/Conformal_equivalence/make_refined_mesh.h>
#include <CGAL/Conformal_equivalence/triangulate_refinement.h>
#include <CGAL/Conformal_equivalence/compute_conformal_metric.h>
#include <CGAL/Conformal_equivalence/compute_cut_graph.h>
#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>

#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

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
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/cylinder_locally_refined.off");

  Mesh sm;
  if(!PMP::IO::read_polygon_mesh(filename, sm) || is_empty(sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }
  const CE::Imported_mesh<Mesh> mesh = CE::import_mesh(sm);
  if(mesh.status != CE::Status::OK)
  {
    std::cerr << CE::message(mesh.status) << std::endl;
    return EXIT_FAILURE;
  }

  //! [part]
  // The metric that keeps the lengths of the border. On the given triangulation it would violate triangle inequalities.
  std::vector<std::uint32_t> missing;
  const auto conditions = CE::read_conditions(mesh, missing);
  const auto metric = CE::compute_conformal_metric(mesh.triangulation, conditions,
                                                   params::retriangulation(CE::Retriangulation::WHEN_NEEDED));
  const auto cut = CE::compute_cut_graph(mesh.triangulation, std::vector<std::uint32_t>());
  if(!metric || !cut)
  {
    std::cerr << CE::message(metric ? cut.status : metric.status) << std::endl;
    return EXIT_FAILURE;
  }

  // The surface, cut along the edges of both triangulations: here the map is one-to-one around every point.
  const auto refinement = CE::compute_common_refinement(mesh.triangulation, metric, cut);
  std::cout << metric.flips.size() << " flips, " << refinement.crossings.size() << " crossings, "
            << refinement.flipped_faces.size() + refinement.rounded_faces.size() << " faces that are not positive, angle sums right up to "
            << CE::angle_sum_error(mesh.triangulation, refinement, conditions) << std::endl;

  // A mesh of it, on the surface, with texture coordinates; homogeneous ones, as the map is projective in each face.
  Mesh refined;
  auto uv = refined.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  auto weight = refined.add_property_map<vertex_descriptor, double>("v:weight", 1).first;
  const auto elements = CE::make_refined_mesh(mesh, CE::triangulate_refinement(refinement), refined, uv,
                                              params::default_values(), params::projective_weight_map(weight));
  //! [part]
  std::cout << "the refined mesh has " << num_faces(refined) << " triangles, the mesh " << num_faces(sm) << std::endl;
  if(elements.faces.empty() || !refinement.is_positive())
    return EXIT_FAILURE;
  return CE::IO::write_OBJ("common_refinement.obj", refined, uv, params::projective_weight_map(weight)) ? EXIT_SUCCESS : EXIT_FAILURE;
}
