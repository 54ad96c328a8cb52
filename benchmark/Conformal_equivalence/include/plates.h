// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Surfaces of any size with any number of borders or handles.

#ifndef CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_PLATES_H
#define CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_PLATES_H

#include "benchmark_meshes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace benchmarks {

// A terrain of about n vertices with holes; or a thin plate in this form, two terrains with noise glued along
// all of their borders: a closed surface whose genus is the number of holes.
class Plate
{
  std::size_t m_;        // vertices along a side of the grid
  std::size_t blocks_;   // along a side; each has at most one hole, a square of half its width
  std::size_t holes_;
  Random_numbers random_;
  Mesh mesh_;
  std::vector<vertex_descriptor> vertices_[2]; // of the grid, below and above

public:
  Plate(std::size_t n, std::size_t holes, bool is_closed)
    : blocks_((std::max)(std::size_t(1), std::size_t(std::ceil(std::sqrt(double(holes)))))), holes_(holes), random_(3)
  {
    const double filled = 1 - double(holes) / double(4 * blocks_ * blocks_);
    m_ = std::size_t(std::lround(std::sqrt(double(n) / (is_closed ? 2 : 1) / filled)));
    if(m_ < 12 * blocks_)
      throw std::runtime_error("more vertices are needed for so many holes");
    add_sheet(1);
    if(is_closed)
      add_sheet(0);
  }

  Mesh& mesh() { return mesh_; }

private:
  // Whether the quadrangle of the grid right of and above the vertex (i, j) is part of the plate.
  bool is_filled(std::size_t i, std::size_t j) const
  {
    if(i >= m_ - 1 || j >= m_ - 1) // beyond the grid; below zero, too
      return false;
    const std::size_t width = m_ / blocks_, a = i / width, b = j / width;
    const auto is_in_middle = [&](std::size_t k) { return 4 * (k % width) >= width && 4 * (k % width) < 3 * width; };
    return a >= blocks_ || b >= blocks_ || b * blocks_ + a >= holes_ || !is_in_middle(i) || !is_in_middle(j);
  }

  int number_of_filled_quadrangles(std::size_t i, std::size_t j) const
  {
    return int(is_filled(i, j)) + int(is_filled(i - 1, j)) + int(is_filled(i, j - 1)) + int(is_filled(i - 1, j - 1));
  }

  bool is_border(std::size_t i, std::size_t j) const { return number_of_filled_quadrangles(i, j) < 4; }

  vertex_descriptor vertex(int side, std::size_t i, std::size_t j) const { return vertices_[side][j * m_ + i]; }

  // `side` is 1 above, 0 below.
  void add_sheet(int side)
  {
    for(std::size_t j = 0; j < m_; ++j)
      for(std::size_t i = 0; i < m_; ++i)
        vertices_[side].push_back(add_vertex(side, i, j));
    for(std::size_t j = 0; j + 1 < m_; ++j)
      for(std::size_t i = 0; i + 1 < m_; ++i)
        if(is_filled(i, j))
          add_quadrangle(side, i, j);
  }

  vertex_descriptor add_vertex(int side, std::size_t i, std::size_t j)
  {
    if(number_of_filled_quadrangles(i, j) == 0)
      return boost::graph_traits<Mesh>::null_vertex();
    const bool on_border = is_border(i, j);
    if(on_border && side == 0)
      return vertex(1, i, j);
    const double step = 1. / double(m_ - 1), dx = random_(-0.3, 0.3), dy = random_(-0.3, 0.3);
    const double x = step * (double(i) + (on_border ? 0 : dx)), y = step * (double(j) + (on_border ? 0 : dy));
    const double thickness = on_border ? 0 : side == 1 ? step : -step;
    return mesh_.add_vertex(Point_3(x, y, terrain_height(x, y) + thickness));
  }

  // No edge that is not on the border joins vertices on it: it would be the same above and below.
  void add_quadrangle(int side, std::size_t i, std::size_t j)
  {
    const vertex_descriptor a = vertex(side, i, j), b = vertex(side, i + 1, j),
                            c = vertex(side, i + 1, j + 1), d = vertex(side, i, j + 1);
    const bool ac_on_border = is_border(i, j) && is_border(i + 1, j + 1);
    const bool bd_on_border = is_border(i + 1, j) && is_border(i, j + 1);
    const bool bd_is_delaunay = in_circle(mesh_.point(a), mesh_.point(b), mesh_.point(c), mesh_.point(d)) > 0;
    if(ac_on_border || (bd_is_delaunay && !bd_on_border))
    {
      add_triangle(side, a, b, d);
      add_triangle(side, b, c, d);
    }
    else
    {
      add_triangle(side, a, b, c);
      add_triangle(side, a, c, d);
    }
  }

  void add_triangle(int side, vertex_descriptor a, vertex_descriptor b, vertex_descriptor c)
  {
    const auto f = side == 1 ? mesh_.add_face(a, b, c) : mesh_.add_face(a, c, b);
    if(f == boost::graph_traits<Mesh>::null_face())
      throw std::runtime_error("a plate is no surface");
  }
};

} // namespace benchmarks

#endif // CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_PLATES_H
