#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/flatten.h>

#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;
typedef Mesh::Property_map<vertex_descriptor, double>        Vertex_number_map;

namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

// Calls use(v, x) for every line "vertex-index number"; '#' begins a comment.
template <typename Use>
bool read_numbers(const std::string& filename, const Mesh& sm, Use use)
{
  std::ifstream in(filename);
  if(!in)
    return false;
  for(std::string text; std::getline(in, text); )
  {
    std::istringstream line(text.substr(0, text.find('#')));
    std::size_t index;
    double x;
    if(!(line >> index))
      continue;
    if(!(line >> x) || index >= num_vertices(sm))
      return false;
    use(vertex_descriptor(Mesh::size_type(index)), x);
  }
  return true;
}

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/nefertiti.off");
  const std::string angles_filename = (argc > 2) ? argv[2] : "data/border_angles.txt";
  const std::string scales_filename = (argc > 3) ? argv[3] : "data/border_scales.txt";

  Mesh sm;
  if(!PMP::IO::read_polygon_mesh(filename, sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  //! [part]
  // At each vertex of the border either u is fixed, to 0 (lengths are kept) if nothing else
  // is said, or the angle is.
  Vertex_number_map angle = sm.add_property_map<vertex_descriptor, double>("v:border_angle", 0).first;
  Vertex_number_map fixed_u = sm.add_property_map<vertex_descriptor, double>("v:fixed_u", 0).first;
  auto is_fixed = sm.add_property_map<vertex_descriptor, bool>("v:is_fixed", false).first;
  for(vertex_descriptor v : vertices(sm))
    is_fixed[v] = CGAL::is_border(v, sm).has_value();

  if(!read_numbers(angles_filename, sm, [&](vertex_descriptor v, double degrees)
                   { angle[v] = degrees * CGAL_PI / 180; is_fixed[v] = false; })
     || !read_numbers(scales_filename, sm, [&](vertex_descriptor v, double u)
                      { fixed_u[v] = u; is_fixed[v] = true; }))
  {
    std::cerr << "Invalid conditions: " << angles_filename << ", " << scales_filename << std::endl;
    return EXIT_FAILURE;
  }

  auto uv = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  Vertex_number_map u = sm.add_property_map<vertex_descriptor, double>("v:log_scale_factor", 0).first;
  const auto report = CE::flatten(sm, uv, params::border_angle_map(angle)
                                                 .prescribed_log_scale_factor_map(fixed_u)
                                                 .log_scale_factor_map(u)
                                                 .vertex_is_constrained_map(is_fixed));
  //! [part]
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }

  std::cout << "residual " << report.statistics.residual << " radians" << std::endl;
  for(halfedge_descriptor h : halfedges(sm))
    if(is_border(h, sm) && !is_fixed[target(h, sm)])
      std::cout << target(h, sm) << ": angle " << angle[target(h, sm)] * 180 / CGAL_PI
                << " degrees, u = " << u[target(h, sm)] << ", at " << uv[h] << std::endl;
  return EXIT_SUCCESS;
}
