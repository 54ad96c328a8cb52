#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/flatten.h>

#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;

namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;

// The torus of revolution, of two circles with these radii, with 3 n times n vertices.
const double large_radius = 3, small_radius = 1;

Mesh make_torus(unsigned int n)
{
  Mesh sm;
  const unsigned int m = 3 * n;
  std::vector<vertex_descriptor> v;
  for(unsigned int i = 0; i < m; ++i)
    for(unsigned int j = 0; j < n; ++j)
    {
      const double x = 2 * CGAL_PI * i / m, y = 2 * CGAL_PI * j / n, r = large_radius + small_radius * std::cos(y);
      v.push_back(sm.add_vertex(Kernel::Point_3(r * std::cos(x), r * std::sin(x), small_radius * std::sin(y))));
    }
  for(unsigned int i = 0; i < m; ++i)
    for(unsigned int j = 0; j < n; ++j)
    {
      const unsigned int next_i = (i + 1) % m, next_j = (j + 1) % n;
      sm.add_face(v[i * n + j], v[next_i * n + j], v[next_i * n + next_j]);
      sm.add_face(v[i * n + j], v[next_i * n + next_j], v[i * n + next_j]);
    }
  return sm;
}

double rounded(double x) { return std::round(1e6 * x) / 1e6 + 0.; } // no negative zero

// Closed surfaces of genus 1 need no cones: they become flat, and their layouts tile the plane.
bool print_lattices(Mesh& sm)
{
  //! [part]
  auto uv = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  const auto report = CE::flatten(sm, uv);
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return false;
  }
  for(const auto& lattice : report.lattices)
    std::cout << num_faces(sm) << " triangles: periods (" << lattice.periods[0][0] << ", " << lattice.periods[0][1] << ") and ("
              << lattice.periods[1][0] << ", " << lattice.periods[1][1] << "), tau = "
              << rounded(lattice.tau[0]) << " + " << lattice.tau[1] << " i" << std::endl;
  //! [part]
  return true;
}

int main(int argc, char* argv[])
{
  std::cout << std::fixed << std::setprecision(6);
  if(argc > 1)
  {
    Mesh sm;
    if(PMP::IO::read_polygon_mesh(argv[1], sm) && !is_empty(sm))
      return print_lattices(sm) ? EXIT_SUCCESS : EXIT_FAILURE;
    std::cerr << "Invalid input: " << argv[1] << std::endl;
    return EXIT_FAILURE;
  }

  // Finer and finer meshes of a surface the conformal type of which is known.
  for(unsigned int n : {6, 12, 24, 48})
  {
    Mesh sm = make_torus(n);
    if(!print_lattices(sm))
      return EXIT_FAILURE;
  }
  std::cout << "the smooth torus: tau = " << std::sqrt(large_radius * large_radius - small_radius * small_radius) / small_radius
            << " i" << std::endl;
  return EXIT_SUCCESS;
}
