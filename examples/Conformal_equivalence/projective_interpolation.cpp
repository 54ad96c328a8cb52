#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/projective_interpolation.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <string>

typedef CGAL::Simple_cartesian<double>                       Kernel;
typedef Kernel::Point_2                                      Point_2;
typedef CGAL::Surface_mesh<Kernel::Point_3>                  Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor         vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor       halfedge_descriptor;
typedef boost::graph_traits<Mesh>::face_descriptor           face_descriptor;
typedef std::array<double, 3>                                Barycentric_coordinates;

namespace CE = CGAL::Conformal_equivalence;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

// The middle of an edge in the coordinates of the face on the left of h.
Barycentric_coordinates middle(const Mesh& sm, halfedge_descriptor h)
{
  Barycentric_coordinates b{{0, 0, 0}};
  halfedge_descriptor side = halfedge(face(h, sm), sm);
  for(int i = 0; i < 3; ++i, side = next(side, sm))
    b[i] = (source(side, sm) == source(h, sm) || source(side, sm) == target(h, sm)) ? 0.5 : 0;
  return b;
}

int main(int argc, char* argv[])
{
  const std::string filename = (argc > 1) ? argv[1] : CGAL::data_file_path("meshes/nefertiti.off");

  Mesh sm;
  if(!PMP::IO::read_polygon_mesh(filename, sm))
  {
    std::cerr << "Invalid input: " << filename << std::endl;
    return EXIT_FAILURE;
  }
  //! [part]
  auto uv = sm.add_property_map<halfedge_descriptor, Point_2>("h:uv").first;
  auto w = sm.add_property_map<vertex_descriptor, double>("v:projective_weight", 1).first;
  const auto report = CE::flatten(sm, uv, params::projective_weight_map(w));
  if(!report)
  {
    std::cerr << CE::message(report) << std::endl;
    return EXIT_FAILURE;
  }

  // The two ways to map a point of a face to the plane, and back.
  const face_descriptor f = *faces(sm).begin();
  const Barycentric_coordinates bary{{0.5, 0.3, 0.2}};
  const Point_2 linear = CE::linear_map(sm, uv, f, bary);
  const Point_2 projective = CE::projective_map(sm, uv, w, f, bary);
  std::cout << "linear map to     " << linear << "\nprojective map to " << projective << std::endl;
  //! [part]
  for(const Barycentric_coordinates& b : { CE::inverse_linear_map(sm, uv, f, linear),
                                           CE::inverse_projective_map(sm, uv, w, f, projective) })
    std::cout << "and back to       " << b[0] << " " << b[1] << " " << b[2] << std::endl;

  // The projective maps of two neighbors agree along their common edge.
  double gap = 0;
  for(halfedge_descriptor h : halfedges(sm))
    if(!is_border(h, sm) && !is_border(opposite(h, sm), sm))
    {
      const Point_2 p = CE::projective_map(sm, uv, w, face(h, sm), middle(sm, h));
      const Point_2 q = CE::projective_map(sm, uv, w, face(opposite(h, sm), sm), middle(sm, opposite(h, sm)));
      gap = (std::max)(gap, std::sqrt(CGAL::squared_distance(p, q)));
    }
  std::cout << "largest gap in the middle of an edge: " << gap << std::endl;
  return EXIT_SUCCESS;
}
