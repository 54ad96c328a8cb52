// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_LAYOUT_SEAMS_H
#define FLATTEN_MESH_LAYOUT_SEAMS_H

#include "layout_outline.h"

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace flattening {

// What can be seen of seams and cones in a layout `uv[h]`, the corner of `target(h)` in `face(h)`, alone.
// A seam is an interior edge whose two sides lie apart; a cone is an interior vertex
// whose angles do not sum up to 2 pi. Takes linear time.
template <typename TriangleMesh, typename HalfedgeUVMap>
class Layout_seams
{
  typedef boost::graph_traits<TriangleMesh>           Graph_traits;
  typedef typename Graph_traits::vertex_descriptor    vertex_descriptor;
  typedef typename Graph_traits::halfedge_descriptor  halfedge_descriptor;
  typedef std::array<double, 2>                       Vector;

  template <typename Value>
  using Vertex_map = typename boost::property_map<TriangleMesh, CGAL::dynamic_vertex_property_t<Value> >::const_type;
  template <typename Value>
  using Halfedge_map = typename boost::property_map<TriangleMesh, CGAL::dynamic_halfedge_property_t<Value> >::const_type;

public:
  // Seam edges one after another, each as the halfedge that points on.
  typedef std::vector<halfedge_descriptor> Path;

  struct Cone
  {
    vertex_descriptor vertex;
    std::size_t index; // in vertices(tm)
    double angle;      // in radians
  };

  // Paths end where the number of seam edges is not two, at the border, and at cones
  // if these are to be found.
  Layout_seams(const TriangleMesh& tm, const HalfedgeUVMap& uv, bool with_cones)
    : tm_(tm), uv_(uv),
      degree_(get(CGAL::dynamic_vertex_property_t<std::size_t>(), tm)),
      is_end_(get(CGAL::dynamic_vertex_property_t<bool>(), tm)),
      is_done_(get(CGAL::dynamic_halfedge_property_t<bool>(), tm))
  {
    count_seams();
    if(with_cones)
      find_cones();
    find_ends();
    find_paths();
  }

  const std::vector<Path>& paths() const { return paths_; }
  const std::vector<Cone>& cones() const { return cones_; }

private:
  bool is_seam(halfedge_descriptor h) const
  {
    return ! is_border(h, tm_) && ! is_border(opposite(h, tm_), tm_) && is_outline(tm_, uv_, h);
  }

  void count_seams()
  {
    for(vertex_descriptor v : vertices(tm_))
    {
      put(degree_, v, 0);
      put(is_end_, v, false);
    }
    for(halfedge_descriptor h : halfedges(tm_))
    {
      put(is_done_, h, ! is_seam(h));
      if(! get(is_done_, h))
        put(degree_, target(h, tm_), get(degree_, target(h, tm_)) + 1);
    }
  }

  // --- cones ---------------------------------------------------------------------------------------------

  // The angle between two edges of the layout, and a bound of what the rounding of coordinates makes of it: an end of
  // an edge moves by at most sqrt(2) times that, so the edge turns by at most sqrt(8) times that over its length.
  struct Angle { double value, rounding; };

  static Angle angle(Vector a, Vector b, double rounding_of_coordinates)
  {
    const double l = std::hypot(a[0], a[1]), m = std::hypot(b[0], b[1]);
    for(std::size_t k = 0; k < 2; ++k)
    {
      a[k] /= l;
      b[k] /= m;
    }
    return { std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]),
             3 * rounding_of_coordinates * (1 / l + 1 / m) };
  }

  Angle angle_sum(vertex_descriptor v, double rounding_of_coordinates) const
  {
    Angle sum = { 0, 0 };
    for(halfedge_descriptor h : CGAL::halfedges_around_target(v, tm_))
    {
      const Vector p = corner_value(uv_, h), q = corner_value(uv_, next(h, tm_)), r = corner_value(uv_, prev(h, tm_));
      const Angle corner = angle({{ q[0] - p[0], q[1] - p[1] }}, {{ r[0] - p[0], r[1] - p[1] }}, rounding_of_coordinates);
      sum.value += corner.value;
      sum.rounding += corner.rounding;
    }
    return sum;
  }

  // The largest coordinate times the unit roundoff of the type of the coordinates.
  double rounding_of_coordinates() const
  {
    typedef std::decay_t<decltype(get(std::declval<const HalfedgeUVMap&>(), std::declval<halfedge_descriptor>()).x())> FT;
    double unit = std::numeric_limits<double>::epsilon() / 2;
    if constexpr(std::is_floating_point<FT>::value)
      unit = (std::max)(unit, static_cast<double>(std::numeric_limits<FT>::epsilon()) / 2);

    double largest = 0;
    for(halfedge_descriptor h : halfedges(tm_))
      if(! is_border(h, tm_))
        for(double x : corner_value(uv_, h))
          if(std::isfinite(x))
            largest = (std::max)(largest, std::abs(x));
    return unit * largest;
  }

  // Around a vertex without a seam the triangles close up: there angles of 4 pi, 6 pi, ... are cones.
  void find_cones()
  {
    const double full_turn = 2 * CGAL_PI, rounding = rounding_of_coordinates();
    std::size_t index = 0;
    for(vertex_descriptor v : vertices(tm_))
    {
      const std::size_t i = index++;
      if(halfedge(v, tm_) == Graph_traits::null_halfedge() || CGAL::is_border(v, tm_))
        continue;
      const Angle sum = angle_sum(v, rounding);
      if(std::abs(sum.value - full_turn) > (std::max)(1e-6, sum.rounding) && (get(degree_, v) > 0 || sum.value > full_turn))
        cones_.push_back({ v, i, sum.value });
    }
  }

  // --- paths ---------------------------------------------------------------------------------------------

  void find_ends()
  {
    for(vertex_descriptor v : vertices(tm_))
      if(get(degree_, v) > 0)
        put(is_end_, v, get(degree_, v) != 2 || CGAL::is_border(v, tm_));
    for(const Cone& cone : cones_)
      put(is_end_, cone.vertex, true);
  }

  // Those from ends in their order around each; then the closed ones.
  void find_paths()
  {
    for(vertex_descriptor v : vertices(tm_))
      if(get(is_end_, v) && get(degree_, v) > 0)
        for(halfedge_descriptor h : CGAL::halfedges_around_target(v, tm_))
          find_path(opposite(h, tm_));
    for(halfedge_descriptor h : halfedges(tm_))
      find_path(h);
  }

  void find_path(halfedge_descriptor h)
  {
    if(get(is_done_, h))
      return;
    Path path;
    for(;;)
    {
      put(is_done_, h, true);
      put(is_done_, opposite(h, tm_), true);
      path.push_back(h);
      if(get(is_end_, target(h, tm_)))
        break;
      const halfedge_descriptor first = h;
      do
        h = opposite(next(h, tm_), tm_);
      while(h != first && get(is_done_, h));
      if(h == first)
        break;
      h = opposite(h, tm_);
    }
    paths_.push_back(std::move(path));
  }

  const TriangleMesh& tm_;
  const HalfedgeUVMap& uv_;
  Vertex_map<std::size_t> degree_; // the number of seam edges
  Vertex_map<bool> is_end_;
  Halfedge_map<bool> is_done_;     // or no seam
  std::vector<Cone> cones_;
  std::vector<Path> paths_;
};

} // namespace flattening

#endif // FLATTEN_MESH_LAYOUT_SEAMS_H
