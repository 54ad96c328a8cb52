#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/measure.h>

#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/make_seam_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Conformal_equivalence_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <vector>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;
typedef boost::graph_traits<Mesh>::edge_descriptor           edge_descriptor;
typedef Mesh::Property_map<edge_descriptor, bool>            Seam_edge_map;
typedef Mesh::Property_map<vertex_descriptor, bool>          Seam_vertex_map;
typedef Mesh::Property_map<halfedge_descriptor, Point_2>     UV_map;
typedef CGAL::Seam_mesh<Mesh, Seam_edge_map, Seam_vertex_map> Seam_mesh;

namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace SMP = CGAL::Surface_mesh_parameterization;
namespace params = CGAL::parameters;

// A part of a plane between two circles, with hills on it.
Mesh make_annulus(unsigned int m, unsigned int n)
{
  Mesh sm;
  std::vector<vertex_descriptor> v;
  for(unsigned int i = 0; i <= m; ++i)
    for(unsigned int j = 0; j < n; ++j)
    {
      const double t = double(i) / m, r = 1 + t, phi = 2 * CGAL_PI * j / n;
      const double height = 0.6 * std::sin(CGAL_PI * t) * (1 + std::sin(3 * phi + 4 * t));
      v.push_back(sm.add_vertex(Kernel::Point_3(r * std::cos(phi), r * std::sin(phi), height)));
    }
  for(unsigned int i = 0; i < m; ++i)
    for(unsigned int j = 0; j < n; ++j)
    {
      const unsigned int a = i * n + j, b = i * n + (j + 1) % n;
      sm.add_face(v[a], v[a + n], v[b + n]);
      sm.add_face(v[a], v[b + n], v[b]);
    }
  return sm;
}

// The seam as a path from border to border.
std::vector<halfedge_descriptor> seam_path(const Mesh& sm, const Seam_edge_map& seam)
{
  std::vector<halfedge_descriptor> path;
  for(halfedge_descriptor h : halfedges(sm))
    if(path.empty() && seam[edge(h, sm)] && sm.is_border(source(h, sm)))
      path.push_back(h);
  while(!sm.is_border(target(path.back(), sm)))
    for(halfedge_descriptor h : halfedges_around_source(target(path.back(), sm), sm))
      if(seam[edge(h, sm)] && h != opposite(path.back(), sm))
      {
        path.push_back(h);
        break;
      }
  return path;
}

double distance(const Point_2& p, const Point_2& q) { return std::sqrt(CGAL::squared_distance(p, q)); }

// Edge by edge the sides of the seam have the same lengths. Are they congruent?
void compare_sides(const Mesh& sm, const Seam_edge_map& seam, const UV_map& uv)
{
  const std::vector<halfedge_descriptor> path = seam_path(sm, seam);
  double difference = 0;
  for(halfedge_descriptor h : path)
  {
    const double left = distance(uv[h], uv[prev(h, sm)]);
    const double right = distance(uv[opposite(h, sm)], uv[prev(opposite(h, sm), sm)]);
    difference = (std::max)(difference, std::abs(left / right - 1));
  }
  std::cout << "  edges of the seam differ by a factor of 1 + " << difference << " at most" << std::endl;
  std::cout << "  from end to end the left side measures " << distance(uv[path.back()], uv[prev(path.front(), sm)])
            << ", the right side "
            << distance(uv[prev(opposite(path.back(), sm), sm)], uv[opposite(path.front(), sm)]) << std::endl;
}

double largest_absolute_value(const Mesh::Property_map<vertex_descriptor, double>& u)
{
  double result = 0;
  for(double x : u)
    result = (std::max)(result, std::abs(x));
  return result;
}

int main(int argc, char* argv[])
{
  Mesh sm = make_annulus(24, 120);
  if(argc > 1 && !PMP::IO::read_polygon_mesh(argv[1], sm))
  {
    std::cerr << "Invalid input: " << argv[1] << std::endl;
    return EXIT_FAILURE;
  }
  UV_map uv = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  auto u = sm.add_property_map<vertex_descriptor, double>("v:log_scale_factor", 0).first;
  Seam_edge_map seam = sm.add_property_map<edge_descriptor, bool>("e:is_seam", false).first;
  Seam_vertex_map on_seam = sm.add_property_map<vertex_descriptor, bool>("v:is_on_seam", false).first;

  //! [part]
  // The annulus itself: both borders keep their lengths. The cut is there to lay it out, and changes nothing.
  const auto report = CE::flatten(sm, uv, params::log_scale_factor_map(u).edge_is_seam_map(seam));
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }
  if(report.topology.genus != 0 || report.topology.number_of_components != 1 || report.topology.number_of_borders != 2)
  {
    std::cerr << "The mesh is not an annulus" << std::endl;
    return EXIT_FAILURE;
  }
  std::cout << "flattened as an annulus: |u| is at most " << largest_absolute_value(u) << std::endl;
  compare_sides(sm, seam, uv);

  // The disk that it is when cut open: the seam is border, too, and keeps its lengths on both sides.
  Seam_mesh seam_mesh = CE::make_seam_mesh(sm, seam, on_seam);
  CE::Flattening_report<Mesh> report_of_disk;
  SMP::Conformal_equivalence_parameterizer_3<Seam_mesh>
    parameterizer(params::seam_is_border(true).log_scale_factor_map(u).flattening_report(std::ref(report_of_disk)));
  const auto bhd = PMP::longest_border(seam_mesh).first;
  if(SMP::parameterize(seam_mesh, parameterizer, bhd, uv) != SMP::OK)
  {
    std::cerr << CE::message(report_of_disk) << std::endl;
    return EXIT_FAILURE;
  }
  //! [part]
  // parameterize() writes a point for each vertex of the seam mesh; all halfedges to it shall have it.
  for(auto hd : halfedges(seam_mesh))
    if(!is_border(hd, seam_mesh))
      put(uv, halfedge_descriptor(hd), uv[target(hd, seam_mesh)]);
  std::cout << "cut open and flattened as a disk: |u| is at most " << largest_absolute_value(u) << std::endl;
  compare_sides(sm, seam, uv);
  return EXIT_SUCCESS;
}
