// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IMAGE_BORDER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IMAGE_BORDER_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Projective_atlas.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The border of the image of a disk: a convex polygon around the origin, counterclockwise. Finds its point nearest to a point
// outside of it.
class Image_border
{
  typedef std::uint32_t Index;
  typedef std::array<Wide_number, 2> Wide_point;

public:
  // A point of the border of a part, with barycentric coordinates there.
  struct Border_point
  {
    Index part;
    Wide_vector coordinates;
  };

  Image_border() = default;

  // `point(v)`: of the vertex `v` of the parts, which are triangles; (x, y, 1)
  template <typename Point>
  Image_border(const Intrinsic_triangulation<double>& surface, const Common_refinement<double>& parts, Point point)
  {
    const std::vector<std::size_t> corners = border_corners(surface, parts);
    double angle = 0;
    for(std::size_t i = 0; i < corners.size(); ++i)
    {
      const Wide_vector p = point(parts.corner_vertex[corners[i]]);
      const double x = static_cast<double>(p[0]), y = static_cast<double>(p[1]);
      if(i == 0)
        angle = std::atan2(y, x);
      else
      {
        const double u = static_cast<double>(sides_.back().origin[0]), v = static_cast<double>(sides_.back().origin[1]);
        angle += (std::max)(0., std::atan2(u * y - v * x, u * x + v * y));
      }
      sides_.push_back({ corners[i], {{ p[0], p[1] }} });
      angles_.push_back(angle);
    }
  }

  // The side that the ray from the origin to the point crosses is near; from there on, distances decrease towards the nearest one.
  Border_point nearest(const Wide_point& q) const
  {
    const double turn = 2 * Number_constants<double>::pi();
    double angle = std::atan2(static_cast<double>(q[1]), static_cast<double>(q[0]));
    while(angle < angles_.front())
      angle += turn;
    while(angle >= angles_.front() + turn)
      angle -= turn;
    const std::size_t n = sides_.size(), first = std::size_t(std::upper_bound(angles_.begin() + 1, angles_.end(), angle) - angles_.begin()) - 1;
    Place best = place(first, q);
    for(const std::size_t step : { std::size_t(1), n - 1 })
      for(std::size_t i = (first + step) % n; i != first; i = (i + step) % n)
      {
        const Place other = place(i, q);
        if(!(other.square < best.square))
          break;
        best = other;
      }
    const std::size_t corner = sides_[best.side].corner;
    Border_point result = { Index(corner / 3), {{ Wide_number(0), Wide_number(0), Wide_number(0) }} };
    result.coordinates[corner % 3] = 1 - best.parameter;
    result.coordinates[(corner % 3 + 1) % 3] = best.parameter;
    return result;
  }

private:
  struct Side
  {
    std::size_t corner; // the one where it begins
    Wide_point origin;
  };

  // The nearest point of a side.
  struct Place
  {
    std::size_t side;
    Wide_number parameter;
    Wide_number square; // of the distance
  };

  // The corners with a border side behind them, in their order.
  static std::vector<std::size_t> border_corners(const Intrinsic_triangulation<double>& surface, const Common_refinement<double>& parts)
  {
    std::vector<std::size_t> at_vertex(parts.number_of_vertices(), parts.corner_vertex.size()), result;
    std::size_t first = parts.corner_vertex.size();
    for(std::size_t c = 0; c < parts.corner_vertex.size(); ++c)
      if(parts.corner_halfedge[c] != parts.null_index && surface.is_border(parts.corner_halfedge[c]))
      {
        at_vertex[parts.corner_vertex[c]] = c;
        first = (std::min)(first, c);
      }
    std::size_t c = first;
    do
    {
      result.push_back(c);
      c = at_vertex[parts.corner_vertex[c % 3 == 2 ? c - 2 : c + 1]];
    }
    while(c != first);
    return result;
  }

  Place place(std::size_t i, const Wide_point& q) const
  {
    const Wide_point &p = sides_[i].origin, &r = sides_[(i + 1) % sides_.size()].origin;
    const Wide_point d = {{ r[0] - p[0], r[1] - p[1] }}, e = {{ q[0] - p[0], q[1] - p[1] }};
    const Wide_number length = d[0] * d[0] + d[1] * d[1], along = d[0] * e[0] + d[1] * e[1];
    Wide_number t(0);
    if(along > Wide_number(0) && length > Wide_number(0))
      t = along < length ? Wide_number(along / length) : Wide_number(1);
    const Wide_number x = e[0] - t * d[0], y = e[1] - t * d[1];
    return { i, t, x * x + y * y };
  }

  std::vector<Side> sides_;
  std::vector<double> angles_; // of their origins, increasing: once around from that of the first
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IMAGE_BORDER_H
