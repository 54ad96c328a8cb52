#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Conformal_equivalence/flatten.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <vector>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;
typedef boost::graph_traits<Mesh>::edge_descriptor           edge_descriptor;
typedef std::complex<double>                                 Disk_point;

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;

// Where the vertices lie in Poincare's disk model of the hyperbolic plane: vertex 0 in
// the center, 6 k on the k-th ring.
const double disk_radius = 0.8;

Mesh make_disk(unsigned int number_of_rings, std::vector<Disk_point>& place)
{
  Mesh sm;
  const Kernel::Point_3 nowhere(0, 0, 0); // the mesh is connectivity alone
  std::vector<vertex_descriptor> inner(1, sm.add_vertex(nowhere)), outer;
  place.assign(1, Disk_point(0, 0));
  for(unsigned int k = 1; k <= number_of_rings; ++k)
  {
    outer.clear();
    for(unsigned int i = 0; i < 6 * k; ++i)
    {
      outer.push_back(sm.add_vertex(nowhere));
      place.push_back(std::polar(disk_radius * k / number_of_rings, 2 * CGAL_PI * i / (6 * k)));
    }
    for(unsigned int side = 0; side < 6; ++side)
      for(unsigned int i = 0; i < k; ++i)
      {
        const vertex_descriptor a = outer[side * k + i], b = outer[(side * k + i + 1) % outer.size()];
        const vertex_descriptor c = inner[(side * (k - 1) + i) % inner.size()];
        sm.add_face(a, b, c);
        if(i + 1 < k)
          sm.add_face(b, inner[(side * (k - 1) + i + 1) % inner.size()], c);
      }
    inner = outer;
  }
  return sm;
}

double hyperbolic_distance(const Disk_point& p, const Disk_point& q)
{
  return 2 * std::asinh(std::abs(p - q) / std::sqrt((1 - std::norm(p)) * (1 - std::norm(q))));
}

int main(int argc, char* argv[])
{
  const unsigned int number_of_rings = (argc > 1) ? std::atoi(argv[1]) : 20;
  if(number_of_rings == 0)
  {
    std::cerr << "Usage: " << argv[0] << " [number of rings]" << std::endl;
    return EXIT_FAILURE;
  }
  std::vector<Disk_point> place;
  Mesh sm = make_disk(number_of_rings, place);

  //! [part]
  // Triangles of the hyperbolic plane, as far as Euclid's triangles with the same sides go.
  auto length = sm.add_property_map<edge_descriptor, double>("e:length").first;
  for(edge_descriptor e : edges(sm))
    length[e] = hyperbolic_distance(place[source(e, sm)], place[target(e, sm)]);

  auto uv = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  auto u = sm.add_property_map<vertex_descriptor, double>("v:log_scale_factor").first;
  auto flat_length = sm.add_property_map<edge_descriptor, double>("e:flat_length").first;
  const auto report = CE::flatten(sm, uv, params::edge_length_map(length)
                                                 .log_scale_factor_map(u)
                                                 .scaled_edge_length_map(flat_length));
  //! [part]
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }

  // The disk model is conformal: it tells what to expect.
  std::cout << "u at the center " << u[vertex_descriptor(0)]
            << ", in the smooth case " << -std::log(1 - disk_radius * disk_radius) << std::endl;
  double least = (std::numeric_limits<double>::max)(), largest = 0;
  for(edge_descriptor e : edges(sm))
  {
    const double ratio = flat_length[e] / std::abs(place[source(e, sm)] - place[target(e, sm)]);
    least = (std::min)(least, ratio);
    largest = (std::max)(largest, ratio);
  }
  std::cout << "flat lengths are those of the disk model times " << least << " to " << largest << std::endl;
  return EXIT_SUCCESS;
}
