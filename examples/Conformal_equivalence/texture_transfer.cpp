#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/locate.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/subdivision_method_3.h>

#include <CGAL/Conformal_equivalence/Surface_correspondence.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_3                                      Point_3;
typedef CGAL::Surface_mesh<Point_3>                          Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;

namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

// Two smooth bodies, in case that no files are given.
Mesh body(double length, double waist)
{
  Mesh sm;
  CGAL::make_icosahedron<Mesh, Point_3>(sm);
  CGAL::Subdivision_method_3::Loop_subdivision(sm, params::number_of_iterations(4));
  for(vertex_descriptor v : vertices(sm))
  {
    const Point_3 p = sm.point(v);
    const double r = 1 - waist * std::exp(-4 * p.z() * p.z());
    sm.point(v) = Point_3(r * p.x(), r * p.y(), length * p.z());
  }
  return sm;
}

// The texture of the first surface: cubes of space, in two colours.
CGAL::IO::Color color(const Point_3& p, double cube)
{
  const long sum = std::lround(std::floor(p.x() / cube) + std::floor(p.y() / cube) + std::floor(p.z() / cube));
  return sum % 2 == 0 ? CGAL::IO::Color(230, 230, 220) : CGAL::IO::Color(30, 80, 160);
}

// Every vertex of b gets the colour that the corresponding point of a has.
template <typename Correspondence>
int carry(const Mesh& a, Mesh& b, const Correspondence& correspondence)
{
  if(!correspondence)
  {
    std::cerr << "First mesh: " << CE::message(correspondence.first().report()) << "; second mesh: " << CE::message(correspondence.second().report())
              << std::endl;
    return EXIT_FAILURE;
  }
  const CGAL::Bbox_3 box = PMP::bbox(a);
  const double cube = (box.xmax() - box.xmin() + box.ymax() - box.ymin() + box.zmax() - box.zmin()) / 24;

  auto color_map = b.add_property_map<vertex_descriptor, CGAL::IO::Color>("v:color").first;
  double error = 0;
  for(vertex_descriptor v : vertices(b))
  {
    if(b.is_isolated(v))
      continue;
    const auto location = correspondence.inverse(v);       // on a: a face, and barycentric coordinates
    color_map[v] = color(PMP::construct_point(location, a), cube);
    const Point_3 back = PMP::construct_point(correspondence(location), b);
    error = (std::max)(error, std::sqrt(CGAL::squared_distance(back, b.point(v))));
  }
  std::cout << "There and back, points differ by " << error << " at most." << std::endl;
  return CGAL::IO::write_OFF("texture_transfer.off", b, params::vertex_color_map(color_map).stream_precision(17)) ? EXIT_SUCCESS : EXIT_FAILURE;
}

int main(int argc, char* argv[])
{
  Mesh a, b;
  if(argc < 3)
  {
    a = body(1, 0);
    b = body(1.6, .4);
  }
  else if(!PMP::IO::read_polygon_mesh(argv[1], a) || !PMP::IO::read_polygon_mesh(argv[2], b))
  {
    std::cerr << "Invalid input: " << argv[1] << " or " << argv[2] << std::endl;
    return EXIT_FAILURE;
  }

  //! [part]
  // Closed surfaces meet on the sphere, turned as they stand; disks on the disk, with their first border vertices at the same
  // point. Landmarks would say which points correspond: CE::Three_landmarks.
  return CGAL::is_closed(a) ? carry(a, b, CE::make_sphere_correspondence(a, b)) : carry(a, b, CE::make_disk_correspondence(a, b));
  //! [part]
}
