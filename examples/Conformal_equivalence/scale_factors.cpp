#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <CGAL/Surface_mesh_parameterization/Conformal_equivalence_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <string>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;

namespace SMP = CGAL::Surface_mesh_parameterization;
namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/nefertiti.off");

  Mesh sm;
  if(!PMP::IO::read_polygon_mesh(filename, sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }
  const halfedge_descriptor bhd = PMP::longest_border(sm).first;
  if(bhd == Mesh::null_halfedge())
  {
    std::cerr << "The mesh has no border: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  //! [part]
  auto uv = sm.add_property_map<vertex_descriptor, Point_2>("v:uv").first;
  auto u = sm.add_property_map<vertex_descriptor, double>("v:log_scale_factor").first;
  auto w = sm.add_property_map<vertex_descriptor, double>("v:projective_weight").first;

  // parameterize() takes the parameterizer by value: results come back through maps and the report.
  CE::Flattening_report<Mesh> report;
  SMP::Conformal_equivalence_parameterizer_3<Mesh> parameterizer(
    params::log_scale_factor_map(u).projective_weight_map(w).flattening_report(std::ref(report)));
  if(SMP::parameterize(sm, parameterizer, bhd, uv) != SMP::OK)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }
  //! [part]

  const auto u_range = std::minmax_element(u.begin(), u.end());
  std::cout << report.statistics.number_of_iterations << " Newton steps, residual "
            << report.statistics.residual << " radians" << std::endl;
  std::cout << "u from " << *u_range.first << " to " << *u_range.second << std::endl;
  std::cout << "smallest projective weight " << *std::min_element(w.begin(), w.end()) << std::endl;
  return EXIT_SUCCESS;
}
