#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/compute_seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>
#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;
typedef Mesh::Property_map<halfedge_descriptor, Point_2>     UV_map;

namespace CE = CGAL::Conformal_equivalence;
namespace params = CGAL::parameters;

// The point i^k p + t, in complex numbers. Nothing is rounded here: the layout keeps to a grid that is coarse enough for that.
Point_2 moved(Point_2 p, int k, const std::array<std::int64_t, 2>& t)
{
  for(; k > 0; --k)
    p = Point_2(-p.y(), p.x());
  return Point_2(p.x() + double(t[0]), p.y() + double(t[1]));
}

// Whether the motions that are reported take each seam edge, as it lies on one side, to the place where it lies on the other.
bool is_seamless(const Mesh& sm, const UV_map& uv, const CE::Flattening_report<Mesh>& report)
{
  for(const auto& t : report.transitions)
  {
    const halfedge_descriptor h = t.halfedge, g = opposite(h, sm);
    if(moved(uv[h], t.quanta, t.lattice_translation) != uv[prev(g, sm)] || moved(uv[prev(h, sm)], t.quanta, t.lattice_translation) != uv[g])
      return false;
  }
  return true;
}

// Whether they also keep the colours of a checkerboard, the squares of which have the integers in their centres.
bool keeps_colours(const CE::Flattening_report<Mesh>& report)
{
  for(const auto& t : report.transitions)
    if((t.lattice_translation[0] + t.lattice_translation[1]) % 2 != 0)
      return false;
  return true;
}

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/blobby.off");

  Mesh sm;
  if(!CGAL::Polygon_mesh_processing::IO::read_polygon_mesh(filename, sm) || is_empty(sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }

  //! [part]
  // Eight cones, with multiples of a right angle, and about 500 squares.
  auto uv = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  const auto report = CE::compute_seamless_parameterization(sm, uv, params::number_of_cones(8).number_of_tiles(500));
  //! [part]
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }
  for(const auto& cone : report.cones)
    std::cout << "cone of " << cone.angle * 180 / CGAL_PI << " degrees at ("
              << cone.lattice_point[0] << ", " << cone.lattice_point[1] << ")" << std::endl;
  std::cout << report.tiling.number_of_tiles << " tiles; deformed by a mean quasi-conformal factor of " << report.tiling.mean_distortion
            << (report.tiling.is_closest ? ", the least one for its size" : "") << std::endl;

  const std::size_t number_of_flipped_triangles = CE::verify_layout(sm, uv).number_of_flipped_triangles;
  const bool seamless = is_seamless(sm, uv, report), colours = keeps_colours(report);
  std::cout << report.transitions.size() << " seam edges: " << (seamless ? "" : "not ") << "seamless, for a checkerboard, too: "
            << (colours ? "yes" : "no") << "; flipped triangles: " << number_of_flipped_triangles << std::endl;
  if(!seamless || !colours || number_of_flipped_triangles > 0)
    return EXIT_FAILURE;
  return CE::IO::write_OBJ("seamless_closed.obj", sm, uv) ? EXIT_SUCCESS : EXIT_FAILURE;
}
