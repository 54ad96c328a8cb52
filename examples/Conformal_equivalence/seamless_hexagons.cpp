#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>

#include <CGAL/Conformal_equivalence/compute_seamless_parameterization.h>

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
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;
typedef boost::graph_traits<Mesh>::edge_descriptor           edge_descriptor;
typedef boost::graph_traits<Mesh>::face_descriptor           face_descriptor;
typedef Mesh::Property_map<halfedge_descriptor, Point_2>     UV_map;

namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

// The point (a, b) of these coordinates is a + b theta in the plane, theta = e^{i pi / 3}. As theta^2 = theta - 1, a rotation by
// 60 degrees takes it to (-b, a + b), without any rounding.
Point_2 moved(Point_2 p, const CE::Seam_transition<Mesh>& t)
{
  for(int k = t.quanta; k > 0; --k)
    p = Point_2(-p.y(), p.x() + p.y());
  return Point_2(p.x() + double(t.lattice_translation[0]), p.y() + double(t.lattice_translation[1]));
}

// Whether the seam edges are taken from one side to the other, exactly.
bool is_seamless(const Mesh& sm, const UV_map& uv, const CE::Flattening_report<Mesh>& report)
{
  for(const auto& t : report.transitions)
  {
    const halfedge_descriptor h = t.halfedge, g = opposite(h, sm);
    if(moved(uv[h], t) != uv[prev(g, sm)] || moved(uv[prev(h, sm)], t) != uv[g])
      return false;
  }
  return true;
}

// The lattice point in the centre of the hexagon that holds p: a, b and c = - a - b are rounded, and that which changed most follows from the others.
Point_2 centre_of_tile(const Point_2& p)
{
  const double a = std::round(p.x()), b = std::round(p.y()), c = std::round(-p.x() - p.y());
  const double da = std::abs(a - p.x()), db = std::abs(b - p.y()), dc = std::abs(c + p.x() + p.y());
  return da > db && da > dc ? Point_2(-b - c, b) : db > dc ? Point_2(a, -a - c) : Point_2(a, b);
}

// A honeycomb, with all symmetries of the lattice: whether the centre of a face is in the wall of its cell.
// Distances from the middle of a tile are at most 1 / 2 in the directions of its neighbours, 1, theta and theta^2.
bool is_in_wall(const Mesh& sm, const UV_map& uv, face_descriptor f)
{
  const halfedge_descriptor h = halfedge(f, sm);
  const Point_2 p = CGAL::centroid(uv[h], uv[next(h, sm)], uv[prev(h, sm)]);
  const Kernel::Vector_2 d = p - centre_of_tile(p);
  return (std::max)({std::abs(d.x() + d.y() / 2), std::abs(d.x() / 2 + d.y()), std::abs(d.y() - d.x()) / 2}) > 0.38;
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
  // Six cones, with multiples of 60 degrees, and about 150 hexagons.
  UV_map uv = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  const auto report = CE::compute_seamless_parameterization(sm, uv, params::number_of_cones(6).angle_quantum(CGAL_PI / 3).number_of_tiles(150)
                                                                          .seamless_coordinates(CE::Seamless_coordinates::LATTICE));
  //! [part]
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }
  for(const auto& cone : report.cones)
    std::cout << "cone of " << cone.angle * 180 / CGAL_PI << " degrees in a cell with "
              << std::lround(cone.angle / (CGAL_PI / 3)) << " corners" << std::endl;

  if(!is_seamless(sm, uv, report))
  {
    std::cerr << "The two sides of the seam differ." << std::endl;
    return EXIT_FAILURE;
  }

  // The pattern knows nothing of seams, and has none: cells are whole.
  auto colour = sm.add_property_map<face_descriptor, CGAL::IO::Color>("f:color").first;
  auto is_outline = sm.add_property_map<edge_descriptor, bool>("e:is_outline", false).first;
  for(face_descriptor f : faces(sm))
    colour[f] = is_in_wall(sm, uv, f) ? CGAL::IO::Color(90, 60, 20) : CGAL::IO::Color(245, 190, 60);
  for(edge_descriptor e : edges(sm))
    if(!is_border(e, sm))
      is_outline[e] = colour[face(halfedge(e, sm), sm)] != colour[face(opposite(halfedge(e, sm), sm), sm)];
  auto part = sm.add_property_map<face_descriptor, std::size_t>("f:part").first;
  PMP::connected_components(sm, part, params::edge_is_constrained_map(is_outline));
  std::set<std::size_t> cells;
  for(face_descriptor f : faces(sm))
    if(!is_in_wall(sm, uv, f))
      cells.insert(part[f]);

  // Each cell has the area of a hexagon, apart from those with a cone. By the formula of Gauss and Bonnet these
  // lack the area of two hexagons if the surface is a sphere.
  std::cout << cells.size() << " cells, with the area of " << report.tiling.number_of_tiles << " hexagons" << std::endl;
  if(CGAL::is_closed(sm) && cells.size() != std::size_t(std::lround(report.tiling.number_of_tiles)) + 2)
  {
    std::cerr << "The faces are too large for this pattern." << std::endl;
    return EXIT_FAILURE;
  }
  return CGAL::IO::write_PLY("seamless_hexagons.ply", sm) ? EXIT_SUCCESS : EXIT_FAILURE;
}
