#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/compute_seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/edge_lengths.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>
#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef Kernel::Point_3                                      Point_3;
typedef CGAL::Surface_mesh<Point_3>                          Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;
typedef boost::graph_traits<Mesh>::edge_descriptor           edge_descriptor;

namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

// A sheet with two horns: n times 2 n squares, each of two triangles.
Mesh make_sheet(int n)
{
  Mesh sm;
  const auto height = [](double x, double y) { return 1.5 * std::exp(-(x * x + y * y) / 0.18); };
  for(int j = 0; j <= n; ++j)
    for(int i = 0; i <= 2 * n; ++i)
    {
      const double x = 2. * i / n - 2, y = 2. * j / n - 1;
      sm.add_vertex(Point_3(x, y, height(x - 0.9, y) + height(x + 0.9, y)));
    }
  const auto vertex = [n](int i, int j) { return vertex_descriptor(j * (2 * n + 1) + i); };
  for(int j = 0; j < n; ++j)
    for(int i = 0; i < 2 * n; ++i)
    {
      sm.add_face(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      sm.add_face(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  return sm;
}

// Makes the layout, says what it is like, and writes it. Returns whether there is one, without flipped triangles.
template <typename NamedParameters>
bool make_seamless(Mesh& sm, const std::string& name, const NamedParameters& np)
{
  auto uv = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  const auto report = CE::compute_seamless_parameterization(sm, uv, np);
  if(!report)
  {
    std::cerr << name << ": " << CE::message(report) << std::endl;
    return false;
  }
  std::cout << name << ": " << report.tiling.number_of_tiles << " tiles, mean quasi-conformal factor " << report.tiling.mean_factor
            << " (" << report.tiling.mean_factor_before << " before the cones were moved)" << std::endl;
  for(const auto& cone : report.cones)
    std::cout << "  cone of " << cone.free_angle * 180 / CGAL_PI << " degrees, rounded to " << cone.angle * 180 / CGAL_PI << ", at ("
              << cone.lattice_point[0] << ", " << cone.lattice_point[1] << ")" << std::endl;
  return CE::verify_layout(sm, uv).number_of_flipped_triangles == 0 && CE::IO::write_OBJ(name + ".obj", sm, uv);
}

// Whether the layout has the length cross ratios of the mesh, across the seam, too.
bool is_conformal(Mesh& sm)
{
  auto uv = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first; // which is there
  auto length = sm.add_property_map<edge_descriptor, double>("e:length").first;
  auto laid_out_length = sm.add_property_map<edge_descriptor, double>("e:laid_out_length").first;
  for(halfedge_descriptor h : halfedges(sm))
    if(!is_border(h, sm))
    {
      length[edge(h, sm)] = std::sqrt(CGAL::squared_distance(sm.point(source(h, sm)), sm.point(target(h, sm))));
      laid_out_length[edge(h, sm)] = std::sqrt(CGAL::squared_distance(uv[prev(h, sm)], uv[h]));
    }
  return CE::are_conformally_equivalent(sm, length, laid_out_length, 1e-9);
}

int main(int argc, char* argv[])
{
  const std::string head_name = CGAL::data_file_path("meshes/mannequin-devil.off");
  const std::string lion_name = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/lion-head.off");

  Mesh sheet = make_sheet(30), head, lion;
  if(!PMP::IO::read_polygon_mesh(head_name, head) || !PMP::IO::read_polygon_mesh(lion_name, lion) || is_empty(head) || is_empty(lion))
  {
    std::cerr << "Invalid input: " << head_name << " or " << lion_name << std::endl;
    return EXIT_FAILURE;
  }

  //! [part]
  // Two cones of pi: turned and scaled so that they lie on the lattice, the layout stays conformally equivalent.
  if(!make_seamless(sheet, "seamless_sheet", params::number_of_cones(2).angle_quantum(CGAL_PI).number_of_tiles(200)))
    return EXIT_FAILURE;
  if(!is_conformal(sheet))
  {
    std::cerr << "The layout is not conformally equivalent to the mesh." << std::endl;
    return EXIT_FAILURE;
  }

  // More cones, with multiples of pi / 2, have to be moved to the lattice; there are as many tiles as it takes to do so with little distortion.
  const double right_angle = CGAL_PI / 2;
  if(!make_seamless(head, "seamless_head", params::number_of_cones(4).angle_quantum(right_angle)))
    return EXIT_FAILURE;
  if(!make_seamless(lion, "seamless_lion", params::number_of_cones(5).angle_quantum(right_angle).maximum_distortion(1.01)))
    return EXIT_FAILURE;
  //! [part]
  return EXIT_SUCCESS;
}
