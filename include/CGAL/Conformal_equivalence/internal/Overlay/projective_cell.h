// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The projective maps of convex polygons, from a triangle to the plane: with barycentric coordinates x of the corners, the point sum x p of
// the triangle, of which p are the corners, goes to the homogeneous coordinates sum x w (u, v, 1) (section 3.4 of Springborn, Schroeder
// and Pinkall, 2008, where the polygon is the triangle).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_PROJECTIVE_CELL_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_PROJECTIVE_CELL_H

#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/sphere_predicates.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename Number, typename NT>
struct Cell_corner
{
  std::array<Number, 3> barycentric; // p, in the triangle
  std::array<NT, 2> uv;              // in the plane
  Number weight;                     // w
};

// Whether the point is in the convex polygon with the corners [first, last), or on its border: exactly for `double`.
// A polygon that has lost its area in rounding holds the points of a segment, if any.
template <typename Number, typename NT>
bool contains(const Cell_corner<Number, NT>* first, const Cell_corner<Number, NT>* last, const std::array<NT, 2>& uv)
{
  for(std::size_t k = 0; k < 2; ++k)
  {
    bool is_above = false, is_below = false;
    for(const Cell_corner<Number, NT>* c = first; c != last; ++c)
    {
      if(!has_finite_coordinates(c->uv))
        return false;
      is_above = is_above || c->uv[k] <= uv[k];
      is_below = is_below || uv[k] <= c->uv[k];
    }
    if(!is_above || !is_below)
      return false;
  }
  for(const Cell_corner<Number, NT>* c = first; c != last; ++c)
    if(is_left_turn((c + 1 == last ? first : c + 1)->uv, c->uv, uv))
      return false;
  return true;
}

// A part of a cell, and a point: a triangle of corners, and barycentric coordinates in it.
template <typename Number, typename NT>
struct Point_in_cell
{
  typedef Cell_corner<Number, NT> Corner;

  std::size_t cell = 0;
  std::array<const Corner*, 3> corners = {{ nullptr, nullptr, nullptr }};
  std::array<Number, 3> coordinates;

  // u, v and w
  std::array<Number, 3> image() const
  {
    Number x(0), y(0), sum(0);
    for(std::size_t k = 0; k < 3; ++k)
    {
      const Number a = coordinates[k] * corners[k]->weight;
      x += a * corners[k]->uv[0];
      y += a * corners[k]->uv[1];
      sum += a;
    }
    return {{ x / sum, y / sum, sum }};
  }

  // The place of the point of the plane with these coordinates. Rounding does not put it out of the triangle.
  std::array<Number, 3> preimage() const
  {
    const Number least_weight = (std::min)(corners[0]->weight, (std::min)(corners[1]->weight, corners[2]->weight));
    std::array<Number, 3> result = {{ Number(0), Number(0), Number(0) }};
    Number sum(0);
    for(std::size_t k = 0; k < 3; ++k)
    {
      const Number a = (std::max)(Number(0), coordinates[k]) * (least_weight / corners[k]->weight);
      sum += a;
      for(std::size_t i = 0; i < 3; ++i)
        result[i] += a * corners[k]->barycentric[i];
    }
    for(Number& x : result)
      x /= sum;
    return result;
  }
};

// The cells into which a triangle was cut.
template <typename Number, typename NT>
class Projective_cells
{
public:
  typedef Cell_corner<Number, NT> Corner;
  typedef Point_in_cell<Number, NT> Point;

  void add_corner(const Corner& corner) { corners_.push_back(corner); }
  void end_cell() { first_corner_.push_back(corners_.size()); }

  std::size_t number_of_cells() const { return first_corner_.size() - 1; }

  // The point with the barycentric coordinates b, in the part that holds it best. Linear in the number of cells.
  Point at(const std::array<Number, 3>& b) const
  {
    Best best(corners_.front());
    for(std::size_t cell = 0; cell < number_of_cells(); ++cell)
      for_each_triangle(cell, [&](const Triangle& t)
      {
        const std::array<Number, 3> &p = t[0]->barycentric, &q = t[1]->barycentric, &r = t[2]->barycentric;
        best.offer(cell, t, {{ determinant(b, q, r), determinant(b, r, p), determinant(b, p, q) }});
      });
    return best.point;
  }

  // Calls `visit(point)` for the point of every cell in which `uv` is. Linear in the number of cells.
  template <typename Visit>
  void for_each_at(const std::array<NT, 2>& uv, Visit visit) const
  {
    for(std::size_t cell = 0; cell < number_of_cells(); ++cell)
      if(contains(corners_.data() + first_corner_[cell], corners_.data() + first_corner_[cell + 1], uv))
        visit(point_of_cell(cell, uv));
  }

private:
  typedef std::array<const Corner*, 3> Triangle;

  // Of all triangles offered, the one in which the least barycentric coordinate is the greatest; if all of them are degenerate, a corner.
  struct Best
  {
    Point point;
    bool is_found = false;

    explicit Best(const Corner& corner)
    {
      point.corners = {{ &corner, &corner, &corner }};
      point.coordinates = {{ Number(1), Number(0), Number(0) }};
    }

    // The determinants are those of the point with the sides opposite to the corners.
    void offer(std::size_t cell, const Triangle& triangle, const std::array<Number, 3>& determinants)
    {
      const Number sum = determinants[0] + determinants[1] + determinants[2];
      if(!(sum > 0))
        return;
      const std::array<Number, 3> x = {{ determinants[0] / sum, determinants[1] / sum, determinants[2] / sum }};
      if(is_found && !(least(point.coordinates) < least(x)))
        return;
      point.cell = cell;
      point.corners = triangle;
      point.coordinates = x;
      is_found = true;
    }

    static Number least(const std::array<Number, 3>& x) { return (std::min)(x[0], (std::min)(x[1], x[2])); }
  };

  template <typename Visit>
  void for_each_triangle(std::size_t cell, Visit visit) const
  {
    const std::size_t first = first_corner_[cell];
    for(std::size_t c = first + 1; c + 1 < first_corner_[cell + 1]; ++c)
      visit(Triangle{{ &corners_[first], &corners_[c], &corners_[c + 1] }});
  }

  Point point_of_cell(std::size_t cell, const std::array<NT, 2>& uv) const
  {
    Best best(corners_[first_corner_[cell]]);
    best.point.cell = cell;
    const auto area = [&](const Corner* p, const Corner* q)
    {
      const Number x = Number(p->uv[0]) - Number(uv[0]), y = Number(p->uv[1]) - Number(uv[1]);
      return Number(x * (Number(q->uv[1]) - Number(uv[1])) - y * (Number(q->uv[0]) - Number(uv[0])));
    };
    for_each_triangle(cell, [&](const Triangle& t) { best.offer(cell, t, {{ area(t[1], t[2]), area(t[2], t[0]), area(t[0], t[1]) }}); });
    return best.point;
  }

  std::vector<Corner> corners_;
  std::vector<std::size_t> first_corner_ = {0}; // by cell, and one more
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_PROJECTIVE_CELL_H
