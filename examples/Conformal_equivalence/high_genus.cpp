#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/edge_lengths.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;
typedef Mesh::Property_map<vertex_descriptor, double>        Angle_map;

namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

// Vertices far from each other, each the farthest from those before it, among those where the mesh is a saddle anyhow and that
// have enough triangles for an angle sum of 3 pi.
std::vector<vertex_descriptor> select_saddles(const Mesh& sm, const Angle_map& angle_sum, std::size_t number)
{
  std::vector<vertex_descriptor> candidates;
  for(vertex_descriptor v : vertices(sm))
    if(degree(v, sm) >= 7 && angle_sum[v] > 2.1 * CGAL_PI)
      candidates.push_back(v);

  std::vector<double> distance(candidates.size(), (std::numeric_limits<double>::max)());
  std::vector<vertex_descriptor> result;
  while(!candidates.empty() && result.size() < number)
  {
    const std::size_t farthest = std::max_element(distance.begin(), distance.end()) - distance.begin();
    result.push_back(candidates[farthest]);
    for(std::size_t i = 0; i < candidates.size(); ++i)
      distance[i] = (std::min)(distance[i], CGAL::squared_distance(sm.point(candidates[i]), sm.point(candidates[farthest])));
  }
  return result;
}

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/elephant.off");

  Mesh sm;
  if(!PMP::IO::read_polygon_mesh(filename, sm) || is_empty(sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  Angle_map angle_sum = sm.add_property_map<vertex_descriptor, double>("v:angle_sum").first;
  const auto report_of_mesh = CE::compute_angle_sums(sm, angle_sum);
  if(!report_of_mesh)
  {
    std::cerr << CE::message(report_of_mesh) << std::endl;
    return EXIT_FAILURE;
  }

  //! [part]
  // The total curvature of a closed surface of genus g is 4 pi (1 - g): 4 (g - 1) cones of 3 pi take it, each -pi.
  const int genus = int(report_of_mesh.topology.genus);
  Angle_map angle = sm.add_property_map<vertex_descriptor, double>("v:cone_angle", 2 * CGAL_PI).first;
  for(vertex_descriptor v : select_saddles(sm, angle_sum, (std::max)(0, 4 * (genus - 1))))
    angle[v] = 3 * CGAL_PI;

  auto uv = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  auto u = sm.add_property_map<vertex_descriptor, double>("v:log_scale_factor").first;
  const auto report = CE::flatten(sm, uv, params::cone_angle_map(angle).log_scale_factor_map(u));
  //! [part]
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }

  const auto range = std::minmax_element(u.begin(), u.end());
  std::cout << "genus " << report.topology.genus << ", " << report.cones.size() << " cones of 3 pi, "
            << report.transitions.size() << " edges cut" << std::endl;
  std::cout << "residual " << report.statistics.residual << ", u from " << *range.first << " to " << *range.second
            << ", lengths of the layout are right up to " << report.layout_length_error << std::endl;

  const auto verdict = CE::verify_layout(sm, uv);
  std::cout << "flipped triangles " << verdict.number_of_flipped_triangles << ", the layout "
            << (verdict.injectivity == CE::Injectivity::YES ? "does not overlap" : "overlaps itself") << std::endl;
  return EXIT_SUCCESS;
}
