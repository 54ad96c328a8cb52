#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>

#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>

#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <vector>

typedef CGAL::Simple_cartesian<double>                   Kernel;
typedef Kernel::Point_2                                  Point_2;
typedef Kernel::Point_3                                  Point_3;
typedef CGAL::Surface_mesh<Point_3>                      Mesh;
typedef boost::graph_traits<Mesh>::halfedge_descriptor   halfedge_descriptor;
typedef std::vector<std::size_t>                         Polygon;

namespace PMP = CGAL::Polygon_mesh_processing;
namespace CE = CGAL::Conformal_equivalence;

int main()
{
  // A roof with a gable and a wall on its ridge, as files have it: nearly every face has points of its own; the gable is upside down, one face
  // comes twice, and one is a mere point. Three faces meet at the ridge.
  std::vector<Point_3> points = {
    Point_3(0, 0, 0), Point_3(4, 0, 0), Point_3(4, 2, 1), Point_3(0, 2, 1),
    Point_3(4, 4, 0), Point_3(0, 4, 0), Point_3(0, 2, 1), Point_3(4, 2, 1),
    Point_3(0, 2, 1), Point_3(4, 2, 1), Point_3(4, 2, 3), Point_3(0, 2, 3),
    Point_3(4, 0, 0), Point_3(4, 4, 0), Point_3(4, 2, 1) };
  std::vector<Polygon> polygons = { {0, 1, 2, 3}, {6, 7, 4, 5}, {8, 9, 10, 11}, {1, 0, 3, 2}, {2, 14, 7}, {12, 14, 13} };
  //! [part]
  // Equal points become one, faces with fewer than three different points are dropped, and all but one of equal faces.
  PMP::repair_polygon_soup(points, polygons);
  std::cout << points.size() << " points and " << polygons.size() << " faces are left" << std::endl;

  // Faces are turned to fit their neighbours; where the surface is no manifold points are copied, so that it comes apart. A surface that
  // cannot be oriented comes apart, too.
  if(!PMP::orient_polygon_soup(points, polygons))
    std::cout << "It was no manifold; now there are " << points.size() << " points" << std::endl;

  Mesh mesh;
  PMP::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  PMP::stitch_borders(mesh); // borders that are left between equal points

  if(!PMP::triangulate_faces(mesh))
  {
    std::cerr << "A face has no normal." << std::endl;
    return EXIT_FAILURE;
  }
  //! [part]

  //! [flatten]
  auto uv = mesh.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  const auto report = CE::flatten(mesh, uv);
  if(!report)
  {
    std::cerr << "Not flattened: " << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << num_faces(mesh) << " triangles of " << report.topology.number_of_components << " pieces are flat" << std::endl;

  return CE::IO::write_OBJ("repair_and_flatten.obj", mesh, uv) ? EXIT_SUCCESS : EXIT_FAILURE;
  //! [flatten]
}
