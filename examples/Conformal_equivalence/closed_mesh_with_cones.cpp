#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/make_seam_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <set>
#include <string>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;
typedef boost::graph_traits<Mesh>::edge_descriptor           edge_descriptor;

namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

// The vertices that lie farthest in the directions of the first two axes.
std::set<vertex_descriptor> extreme_vertices(const Mesh& sm)
{
  std::set<vertex_descriptor> result;
  for(int axis = 0; axis < 2; ++axis)
  {
    const auto lies_before = [&](vertex_descriptor v, vertex_descriptor w) { return sm.point(v)[axis] < sm.point(w)[axis]; };
    const auto range = vertices(sm);
    result.insert(*std::min_element(range.begin(), range.end(), lies_before));
    result.insert(*std::max_element(range.begin(), range.end(), lies_before));
  }
  return result;
}

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/bear.off");

  Mesh sm;
  if(!PMP::IO::read_polygon_mesh(filename, sm) || is_empty(sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  //! [part]
  auto uv = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  auto angle = sm.add_property_map<vertex_descriptor, double>("v:cone_angle", 2 * CGAL_PI).first;
  auto seam = sm.add_property_map<edge_descriptor, bool>("e:is_seam", false).first;
  auto on_seam = sm.add_property_map<vertex_descriptor, bool>("v:is_on_seam", false).first;

  // Four cones of pi: the curvature of a sphere, 4 pi, is at four vertices alone.
  const std::set<vertex_descriptor> four_cones = extreme_vertices(sm);
  for(vertex_descriptor v : four_cones)
    angle[v] = CGAL_PI;
  const auto report = CE::flatten(sm, uv, params::cone_angle_map(angle).edge_is_seam_map(seam));
  //! [part]
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << "residual " << report.statistics.residual << ", cut along " << report.transitions.size() << " edges" << std::endl;

  // The layout is that of the surface cut open, which CGAL calls a Seam_mesh.
  auto seam_mesh = CE::make_seam_mesh(sm, seam, on_seam);
  CGAL::Bbox_2 box;
  std::size_t number_of_border_edges = 0;
  double border_length = 0;
  for(auto hd : halfedges(seam_mesh))
  {
    box += uv[target(hd, seam_mesh)].bbox();
    if(!is_border(hd, seam_mesh))
      continue;
    ++number_of_border_edges;
    border_length += std::sqrt(CGAL::squared_distance(uv[source(hd, seam_mesh)], uv[target(hd, seam_mesh)]));
  }
  std::cout << "the layout measures " << box.xmax() - box.xmin() << " by " << box.ymax() - box.ymin() << "; its border has "
            << number_of_border_edges << " edges and the length " << border_length << std::endl;

  // Both sides of the seam have the same lengths.
  const auto laid_out_length = [&](halfedge_descriptor h)
    { return std::sqrt(CGAL::squared_distance(uv[h], uv[prev(h, sm)])); };
  double difference = 0;
  for(edge_descriptor e : edges(sm))
    if(seam[e])
      difference = (std::max)(difference, std::abs(laid_out_length(halfedge(e, sm)) / laid_out_length(opposite(halfedge(e, sm), sm)) - 1));
  std::cout << "the two sides of the seam differ in length by a factor of 1 + " << difference << " at most" << std::endl;
  return EXIT_SUCCESS;
}
