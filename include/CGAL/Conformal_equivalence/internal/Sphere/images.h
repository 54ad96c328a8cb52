// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// How a surface is mapped to its image, as a policy of `Image_locator`: the sphere, where points are vectors in any direction, and the disk, where
// they are multiples of (x, y, 1).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IMAGES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IMAGES_H

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Disk_mapping.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Image_border.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Projective_atlas.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Sphere_mapping.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/disk_points.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>

#include <CGAL/assertions.h>

#include <array>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The parts of a surface that have straight images, in triangles, and by vertex of these the points and weights.
struct Straight_parts
{
  Common_refinement<double> parts;
  std::vector<Wide_vector> points;
  std::vector<Wide_number> weights;
};

class Sphere_image
{
  typedef Light_vector<Wide_number> Vector;

public:
  typedef std::array<double, 3> Point;
  template <typename TriangleMesh> using Mapping = Sphere_mapping<TriangleMesh, double>;

  template <typename TriangleMesh, typename NamedParameters>
  static void run(Mapping<TriangleMesh>& mapping, const NamedParameters& np) { mapping.run(np, std::true_type()); }

  template <typename TriangleMesh>
  static Straight_parts parts(Mapping<TriangleMesh>& mapping)
  {
    Straight_parts result;
    result.parts = std::move(mapping.refinement.parts);
    for(const Vector& v : mapping.refined_vectors)
    {
      const bool is_used = v[3] > Wide_number(0);
      result.points.push_back(is_used ? sphere_point(v) : Wide_vector{{ Wide_number(0), Wide_number(0), Wide_number(0) }});
      result.weights.push_back(sqrt(Wide_number(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]))); // crossings lie within the sphere
    }
    return result;
  }

  // There are answers for all points.
  template <typename TriangleMesh>
  void set_border(const Projective_atlas<TriangleMesh>&) {}

  // A vector in the direction of the point as it is; of length 1 for a vertex.
  static Wide_vector normalized(const Wide_vector& p) { return p; }

  static Point point(const Wide_vector& p) { return rounded_vector(unit_vector(p)); }
  static Wide_vector vector(const Point& p) { return {{ Wide_number(p[0]), Wide_number(p[1]), Wide_number(p[2]) }}; }

  template <typename TriangleMesh>
  typename Projective_atlas<TriangleMesh>::Face_location outside(const Projective_atlas<TriangleMesh>& atlas, const Wide_vector&) const
  {
    CGAL_assertion_msg(false, "positive triangles that cover the sphere once hold every direction");
    return atlas.location(0, {{ Wide_number(1), Wide_number(0), Wide_number(0) }});
  }
};

class Disk_image
{
  typedef Light_vector<Wide_number> Vector;

public:
  typedef std::array<double, 2> Point;
  template <typename TriangleMesh> using Mapping = Disk_mapping<TriangleMesh, double>;

  template <typename TriangleMesh, typename NamedParameters>
  static void run(Mapping<TriangleMesh>& mapping, const NamedParameters& np) { mapping.run(np, true, true); }

  template <typename TriangleMesh>
  static Straight_parts parts(Mapping<TriangleMesh>& mapping)
  {
    Straight_parts result;
    result.parts = std::move(mapping.refinement);
    for(const Vector& v : mapping.refined_vectors)
    {
      const std::array<Wide_number, 2> p = v[3] > Wide_number(0) ? disk_point(v) : std::array<Wide_number, 2>{{ Wide_number(0), Wide_number(0) }};
      result.points.push_back({{ p[0], p[1], Wide_number(1) }});
      result.weights.push_back(weight_in_disk(v));
    }
    return result;
  }

  template <typename TriangleMesh>
  void set_border(const Projective_atlas<TriangleMesh>& atlas)
  {
    border_ = Image_border(atlas.mesh().triangulation, atlas.parts(), [&](std::uint32_t v) { return atlas.point(v); });
  }

  static Wide_vector normalized(const Wide_vector& p) { return {{ p[0] / p[2], p[1] / p[2], Wide_number(1) }}; }
  static Point point(const Wide_vector& p) { return {{ static_cast<double>(p[0]), static_cast<double>(p[1]) }}; }
  static Wide_vector vector(const Point& p) { return {{ Wide_number(p[0]), Wide_number(p[1]), Wide_number(1) }}; }

  // The nearest point of the border.
  template <typename TriangleMesh>
  typename Projective_atlas<TriangleMesh>::Face_location outside(const Projective_atlas<TriangleMesh>& atlas, const Wide_vector& p) const
  {
    const Image_border::Border_point nearest = border_.nearest({{ p[0] / p[2], p[1] / p[2] }});
    return atlas.location(nearest.part, nearest.coordinates);
  }

private:
  Image_border border_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IMAGES_H
