// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A surface and its image on the sphere, or in the plane, point by point and in both directions. The surface is cut into
// triangles that have straight images: the faces, or, where edges were flipped, the triangles of the refinement. A point of the
// sphere is given by any vector in its direction, a point (x, y) of the plane by a multiple of (x, y, 1): so both are treated
// alike. With the points p of the corners and the weights w = e^{-u}, the triangle with barycentric coordinates b goes to the sum
// of the b w p (section 3.4 of Springborn, Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_PROJECTIVE_ATLAS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_PROJECTIVE_ATLAS_H

#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Ideal_polyhedron.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Box_tree.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/projective_cell.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/sphere_predicates.h>

#include <CGAL/assertions.h>
#include <CGAL/boost/graph/iterator.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

typedef Ideal_polyhedron<double>::Wide Wide_number;
typedef std::array<Wide_number, 3> Wide_vector;

inline Wide_vector difference(const Wide_vector& p, const Wide_vector& q) { return {{ p[0] - q[0], p[1] - q[1], p[2] - q[2] }}; }

inline Wide_number dot_product(const Wide_vector& p, const Wide_vector& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }

// Divided by its greatest coordinate, so that products neither over- nor underflow. Not 0, and finite.
inline Wide_vector scaled_vector(const Wide_vector& p)
{
  double greatest = 0;
  for(const Wide_number& x : p)
    greatest = (std::max)(greatest, std::abs(static_cast<double>(x)));
  CGAL_precondition(greatest > 0 && std::isfinite(greatest));
  int exponent;
  std::frexp(greatest, &exponent);
  return {{ ldexp(p[0], -exponent), ldexp(p[1], -exponent), ldexp(p[2], -exponent) }};
}

inline Wide_vector unit_vector(const Wide_vector& p)
{
  const Wide_vector q = scaled_vector(p);
  const Wide_number length = sqrt(dot_product(q, q));
  return {{ q[0] / length, q[1] / length, q[2] / length }};
}

inline std::array<double, 3> rounded_vector(const Wide_vector& p)
{
  return {{ static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]) }};
}

// A box of the directions in a triangle of the sphere, given by three vectors almost of length 1. A triangle of great arcs is in the box of its
// corners, but for what it stands out of the flat one, of which the points are at least sqrt(1 - L^2 / 3) away from the origin, L its longest side.
inline Box<3> box_of_directions(const std::array<std::array<double, 3>, 3>& p)
{
  Box<3> result = { p[0], p[0] };
  double longest = 0; // squared
  for(std::size_t k = 0; k < 3; ++k)
  {
    result.insert(p[k]);
    double square = 0;
    for(std::size_t i = 0; i < 3; ++i)
      square += (p[(k + 1) % 3][i] - p[k][i]) * (p[(k + 1) % 3][i] - p[k][i]);
    longest = (std::max)(longest, square);
  }
  // 1 - sqrt(1 - L^2 / 3) at most, and rounding
  const double margin = (std::min)(longest / 3, 1.) + 32 * std::numeric_limits<double>::epsilon();
  for(std::size_t i = 0; i < 3; ++i)
  {
    result.low[i] -= margin;
    result.high[i] += margin;
  }
  return result;
}

template <typename TriangleMesh>
class Projective_atlas
{
public:
  typedef std::uint32_t Index;
  typedef std::pair<typename boost::graph_traits<TriangleMesh>::face_descriptor, std::array<double, 3> > Face_location;

  explicit Projective_atlas(Imported_mesh<TriangleMesh> mesh) : mesh_(std::move(mesh)) {}

  // `parts`: triangles; `points`, `weights`: by vertex of these. Returns the faces of the mesh with parts that are not positive,
  // which should be none.
  std::vector<Index> set(Common_refinement<double> parts, std::vector<Wide_vector> points, std::vector<Wide_number> weights)
  {
    parts_ = std::move(parts);
    points_ = std::move(points);
    weights_ = std::move(weights);
    find_parts_of_faces();
    std::vector<Index> result;
    for(Index f = 0; f < parts_.number_of_faces(); ++f)
    {
      CGAL_assertion(parts_.first_corner[f] == 3 * std::size_t(f));
      if(!is_counterclockwise(corner(3 * std::size_t(f)), corner(3 * std::size_t(f) + 1), corner(3 * std::size_t(f) + 2)))
        result.push_back(parts_.input_face[f]);
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    if(result.empty())
      tree_ = Box_tree<3>(boxes_of_parts());
    return result;
  }

  const Imported_mesh<TriangleMesh>& mesh() const { return mesh_; }
  const Common_refinement<double>& parts() const { return parts_; }
  const Wide_vector& point(Index v) const { return points_[v]; }

  Face_location vertex_location(typename boost::graph_traits<TriangleMesh>::vertex_descriptor v) const
  {
    const TriangleMesh& tm = mesh_.mesh();
    for(auto h : CGAL::halfedges_around_target(halfedge(v, tm), tm))
      if(mesh_.is_imported(h))
      {
        const Index i = mesh_.index_of_halfedge(h);
        std::array<double, 3> b = {{ 0, 0, 0 }};
        b[(i + 1) % 3] = 1;
        return Face_location(mesh_.face(i / 3), b);
      }
    return Face_location(boost::graph_traits<TriangleMesh>::null_face(), {{ 0, 0, 0 }});
  }

  // The image of a vertex is the point of that vertex, bit by bit.
  Wide_vector image(const Face_location& location) const
  {
    const Index face = mesh_.index_of_face(location.first);
    const Part_point at = point_of_part(face, normalized(location.second));
    const std::size_t c = 3 * std::size_t(at.part);
    Wide_number greatest(0), sum(0);
    for(std::size_t k = 0; k < 3; ++k)
      if(at.coordinates[k] > Wide_number(0))
        greatest = (std::max)(greatest, weight(c + k));
    Wide_vector share, result = {{ Wide_number(0), Wide_number(0), Wide_number(0) }};
    for(std::size_t k = 0; k < 3; ++k)
    {
      share[k] = at.coordinates[k] > Wide_number(0) ? at.coordinates[k] * (weight(c + k) / greatest) : Wide_number(0);
      sum += share[k];
    }
    for(std::size_t k = 0; k < 3; ++k)
      for(std::size_t i = 0; i < 3; ++i)
        result[i] += share[k] / sum * corner(c + k)[i];
    return result;
  }

  // A point of the surface that lies there, if there is one: decided exactly. On edges, that of the least part.
  std::optional<Face_location> preimage(const Wide_vector& direction) const
  {
    const Wide_vector q = scaled_vector(direction);
    std::optional<Index> found;
    tree_.for_each_around(rounded_vector(unit_vector(q)), [&](Index f)
    {
      if((!found || f < *found) && contains(f, q))
        found = f;
    });
    if(!found)
      return std::nullopt;
    return location(*found, coordinates(*found, q));
  }

  // The point of a part with these barycentric coordinates in the image, not all 0.
  Face_location location(Index part, const Wide_vector& b) const
  {
    const std::size_t c = 3 * std::size_t(part);
    Wide_number least((std::numeric_limits<double>::max)());
    for(std::size_t k = 0; k < 3; ++k)
      if(b[k] > Wide_number(0))
        least = (std::min)(least, weight(c + k));
    Wide_vector sum_of_places = {{ Wide_number(0), Wide_number(0), Wide_number(0) }};
    for(std::size_t k = 0; k < 3; ++k)
    {
      if(!(b[k] > Wide_number(0)))
        continue;
      const Wide_number share = b[k] * (least / weight(c + k));
      const std::array<double, 3> p = place(c + k);
      for(std::size_t i = 0; i < 3; ++i)
        sum_of_places[i] += share * p[i];
    }
    const Wide_vector& s = sum_of_places;
    const Wide_number sum = s[0] + s[1] + s[2];
    return Face_location(mesh_.face(parts_.input_face[part]), rounded_vector({{ s[0] / sum, s[1] / sum, s[2] / sum }}));
  }

private:
  // A point of the surface as one of a part, with barycentric coordinates in it.
  struct Part_point
  {
    Index part;
    Wide_vector coordinates;
  };

  std::vector<Box<3> > boxes_of_parts() const
  {
    std::vector<Box<3> > result;
    for(std::size_t c = 0; c < 3 * std::size_t(parts_.number_of_faces()); c += 3)
      result.push_back(box_of_directions({{ rounded_vector(unit_vector(corner(c))), rounded_vector(unit_vector(corner(c + 1))),
                                            rounded_vector(unit_vector(corner(c + 2))) }}));
    return result;
  }

  const Wide_vector& corner(std::size_t c) const { return points_[parts_.corner_vertex[c]]; }
  const Wide_number& weight(std::size_t c) const { return weights_[parts_.corner_vertex[c]]; }

  // Barycentric coordinates of a corner in the face of the mesh.
  std::array<double, 3> place(std::size_t c) const
  {
    return input_barycentric(mesh_.triangulation, parts_, Index(c / 3), c);
  }

  void find_parts_of_faces()
  {
    first_part_.assign(std::size_t(mesh_.triangulation.number_of_faces()) + 1, 0);
    for(Index f : parts_.input_face)
      ++first_part_[f + 1];
    for(std::size_t f = 1; f < first_part_.size(); ++f)
      first_part_[f] += first_part_[f - 1];
    std::vector<std::size_t> next(first_part_.begin(), first_part_.end() - 1);
    part_.resize(parts_.number_of_faces());
    for(Index f = 0; f < parts_.number_of_faces(); ++f)
      part_[next[parts_.input_face[f]]++] = f;
  }

  static Wide_vector normalized(const std::array<double, 3>& b)
  {
    double greatest = 0;
    for(double x : b)
      greatest = (std::max)(greatest, x);
    CGAL_precondition(greatest > 0 && std::isfinite(b[0]) && std::isfinite(b[1]) && std::isfinite(b[2]));
    Wide_vector result;
    Wide_number sum(0);
    for(std::size_t k = 0; k < 3; ++k)
    {
      result[k] = Wide_number((std::max)(b[k], 0.)) / greatest;
      sum += result[k];
    }
    for(Wide_number& x : result)
      x /= sum;
    return result;
  }

  // In the part in which the least coordinate is the greatest: parts without area, after rounding, hold nothing.
  Part_point point_of_part(Index face, const Wide_vector& b) const
  {
    Part_point best = { part_[first_part_[face]], {{ Wide_number(1), Wide_number(0), Wide_number(0) }} };
    Wide_number best_least(-(std::numeric_limits<double>::max)());
    for(std::size_t i = first_part_[face]; i < first_part_[face + 1]; ++i)
    {
      const Wide_vector x = coordinates_in_part(part_[i], b);
      const Wide_number least = (std::min)(x[0], (std::min)(x[1], x[2]));
      if(!(best_least < least))
        continue;
      best = { part_[i], x };
      best_least = least;
    }
    for(Wide_number& x : best.coordinates)
      x = (std::max)(x, Wide_number(0));
    return best;
  }

  Wide_vector coordinates_in_part(Index part, const Wide_vector& b) const
  {
    std::array<Wide_vector, 3> p;
    for(std::size_t k = 0; k < 3; ++k)
    {
      const std::array<double, 3> x = place(3 * std::size_t(part) + k);
      p[k] = {{ Wide_number(x[0]), Wide_number(x[1]), Wide_number(x[2]) }};
    }
    const Wide_vector d = {{ determinant(b, p[1], p[2]), determinant(p[0], b, p[2]), determinant(p[0], p[1], b) }};
    const Wide_number sum = d[0] + d[1] + d[2];
    if(!(sum > 0))
      return {{ Wide_number(-(std::numeric_limits<double>::max)()), Wide_number(0), Wide_number(0) }};
    return {{ d[0] / sum, d[1] / sum, d[2] / sum }};
  }

  bool contains(Index part, const Wide_vector& q) const
  {
    const std::size_t c = 3 * std::size_t(part);
    for(std::size_t k = 0; k < 3; ++k)
      if(is_counterclockwise(corner(c + (k + 1) % 3), corner(c + k), q))
        return false;
    return true;
  }

  // Those of a point of the part. Only what the corners have at right angles to q counts: small differences.
  Wide_vector coordinates(Index part, const Wide_vector& q) const
  {
    const std::size_t c = 3 * std::size_t(part);
    const Wide_number square = dot_product(q, q);
    std::array<Wide_vector, 3> d;
    for(std::size_t k = 0; k < 3; ++k)
    {
      const Wide_number along = dot_product(corner(c + k), q) / square;
      d[k] = difference(corner(c + k), {{ along * q[0], along * q[1], along * q[2] }});
    }
    Wide_vector result;
    bool is_any_positive = false;
    for(std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      result[k] = Wide_number(0);
      if(is_counterclockwise(corner(c + i), corner(c + j), q)) // otherwise q is on that side
        result[k] = (std::max)(determinant(q, d[i], d[j]), Wide_number(0));
      is_any_positive = is_any_positive || result[k] > Wide_number(0);
    }
    if(!is_any_positive) // a part too small for these numbers: the nearest corner
    {
      std::size_t nearest = 0;
      for(std::size_t k = 1; k < 3; ++k)
        if(dot_product(d[k], d[k]) < dot_product(d[nearest], d[nearest]))
          nearest = k;
      result[nearest] = Wide_number(1);
    }
    return result;
  }

  Imported_mesh<TriangleMesh> mesh_;
  Common_refinement<double> parts_;
  std::vector<Wide_vector> points_;     // by vertex of the parts
  std::vector<Wide_number> weights_;    // the same
  std::vector<std::size_t> first_part_; // by face of the mesh, into `part_`
  std::vector<Index> part_;
  Box_tree<3> tree_; // of the directions in each part
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_PROJECTIVE_ATLAS_H
