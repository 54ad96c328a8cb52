#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <CGAL/Surface_mesh_parameterization/ARAP_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_equivalence_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <CGAL/Conformal_equivalence/conformal_distortion.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
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

// The largest by the smallest scale of a border edge: 1 if the border keeps its lengths, up to a common factor.
template <typename UVMap>
double border_scale_range(const Mesh& sm, halfedge_descriptor bhd, UVMap uv)
{
  double least = 0, largest = 0;
  for(halfedge_descriptor h : halfedges_around_face(bhd, sm))
  {
    const Point_2 &p = uv[source(h, sm)], &q = uv[target(h, sm)];
    const double scale = std::sqrt(CGAL::squared_distance(p, q)) / PMP::edge_length(h, sm);
    least = (h == bhd) ? scale : (std::min)(least, scale);
    largest = (std::max)(largest, scale);
  }
  return largest / least;
}

template <typename Parameterizer>
bool measure(const std::string& name, const Mesh& mesh, const Parameterizer& parameterizer)
{
  Mesh sm(mesh);
  const halfedge_descriptor bhd = PMP::longest_border(sm).first;
  if(bhd == boost::graph_traits<Mesh>::null_halfedge())
  {
    std::cerr << "The mesh has no border" << std::endl;
    return false;
  }
  auto uv = sm.add_property_map<vertex_descriptor, Point_2>("v:uv").first;
  const SMP::Error_code error = SMP::parameterize(sm, parameterizer, bhd, uv);
  if(error != SMP::OK)
  {
    std::cerr << name << ": error " << error << std::endl;
    return false;
  }

  //! [part]
  auto corner = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  for(halfedge_descriptor h : halfedges(sm))
    corner[h] = uv[target(h, sm)];
  const auto distortion = CE::compute_conformal_distortion(sm, corner);
  const auto verdict = CE::verify_layout(sm, corner);
  //! [part]
  std::cout << std::left << std::setw(24) << name << std::right
            << std::setw(12) << distortion.mean_quasi_conformal_factor
            << std::setw(12) << distortion.maximum_quasi_conformal_factor
            << std::setw(10) << verdict.number_of_flipped_triangles
            << std::setw(14) << border_scale_range(sm, bhd, uv) << std::endl;
  return true;
}

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/three_peaks.off");

  Mesh sm;
  if(!PMP::IO::read_polygon_mesh(filename, sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  std::cout << "                         quasi-conformal factor   flipped  border scales\n"
            << "                                mean         max triangles     max / min" << std::endl;
  CE::Flattening_report<Mesh> report;
  const SMP::Conformal_equivalence_parameterizer_3<Mesh> conformal(params::flattening_report(std::ref(report)));
  bool done = measure("conformal equivalence", sm, conformal);
  if(!done)
    std::cerr << CE::message(report) << std::endl;
  done = measure("LSCM", sm, SMP::LSCM_parameterizer_3<Mesh>()) && done;
  done = measure("ARAP", sm, SMP::ARAP_parameterizer_3<Mesh>()) && done;
  std::cout << "conformal equivalence took " << report.statistics.number_of_iterations
            << " Newton steps, to a residual of " << report.statistics.residual << " radians" << std::endl;
  return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
