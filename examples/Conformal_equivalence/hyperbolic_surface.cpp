#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/Exact_hyperbolic_surface.h>
#include <CGAL/Conformal_equivalence/make_triangulation_on_hyperbolic_surface.h>
#include <CGAL/Conformal_equivalence/uniformize_hyperbolic.h>

#include <cstdlib>
#include <iostream>
#include <string>

typedef CGAL::Simple_cartesian<double>        Kernel;
typedef CGAL::Surface_mesh<Kernel::Point_3>   Mesh;

namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/eight.off");

  Mesh sm;
  if(!PMP::IO::read_polygon_mesh(filename, sm) || is_empty(sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  //! [part]
  // The metric of curvature -1, the layout in the unit disk, and the group.
  const CE::Hyperbolic_uniformization u = CE::uniformize_hyperbolic(sm);
  if(!u || !u.is_laid_out())
  {
    std::cerr << (u ? "the surface is not connected" : CE::message(u.status)) << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << "genus " << u.genus << ", area " << u.metric.area << ", " << u.metric.statistics.number_of_iterations << " Newton steps, "
            << u.metric.flips.size() << " flips, residual " << u.metric.statistics.residual << std::endl;
  std::cout << "the relation of the " << u.generators.size() << " generators holds up to " << u.relation_error << std::endl;

  // The corners of the first triangle of the mesh.
  for(int h = 0; h < 3; ++h)
    std::cout << "(" << u.corner_points[h][0] << ", " << u.corner_points[h][1] << ")" << (h < 2 ? ", " : "\n");

  // A surface near to it in rational numbers.
  const CE::Exact_hyperbolic_surface exact = CE::realize_exactly(u);
  if(!exact)
  {
    std::cerr << CE::message(exact.status) << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << "exact generators of up to " << exact.number_of_digits() << " digits; edges are longer or shorter by "
            << exact.largest_length_difference() << std::endl;

#ifdef CGAL_CONFORMAL_EQUIVALENCE_HAS_HYPERBOLIC_SURFACES // CGAL 6.1 and later
  const auto triangulation = CE::make_triangulation_on_hyperbolic_surface(exact);
  std::cout << "as a triangulation of CGAL it is " << (triangulation.is_valid() ? "valid" : "not valid")
            << (triangulation.is_Delaunay() ? " and Delaunay" : "") << std::endl;
#endif
  //! [part]
  return EXIT_SUCCESS;
}
