// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What a page shows, as arrays of binary numbers that a graphics card takes as they are.

#ifndef FLATTEN_MESH_PAGE_DATA_H
#define FLATTEN_MESH_PAGE_DATA_H

#include "color_scale.h"
#include "layout_outline.h"
#include "layout_seams.h"

#include <CGAL/Conformal_equivalence/conformal_distortion.h>
#include <CGAL/Conformal_equivalence/internal/IO/corner_values.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>
#include <CGAL/Simple_cartesian.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace flattening {

// Positive numbers in 16 bits each: 1 ... 65534 are even steps of their logarithm, from the least to the largest, 65535 is infinity, and 0
// stands for no number.
class Coded_logarithms
{
  std::vector<double> logarithms_;
  Finite_range range_;

public:
  void push_back(double x)
  {
    logarithms_.push_back(std::log(x));
    range_.insert(logarithms_.back());
  }

  std::array<double, 2> range() const { return {{ range_.empty() ? 0 : range_.lower, range_.empty() ? 0 : range_.upper }}; }

  std::vector<std::uint16_t> codes() const
  {
    std::vector<std::uint16_t> result;
    result.reserve(logarithms_.size());
    for(double x : logarithms_)
      result.push_back(std::isfinite(x) ? static_cast<std::uint16_t>(1 + std::lround(65533 * range_.parameter(x))) : x > 0 ? 65535 : 0);
    return result;
  }
};

// A corner is a distinct value of the layout at a vertex, as in the files written. On spheres there are no seams, and each vertex is one corner.
class Page_data
{
  typedef CGAL::Simple_cartesian<double> Kernel;

public:
  struct Cone
  {
    double angle; // in radians
    std::size_t vertex;
    std::vector<std::uint32_t> corners;
  };

  // By corner. Both the surface and the layout are moved and scaled, so that they just fit into [-1, 1]. The layout has three coordinates on spheres.
  std::vector<float> points, layout, u;
  std::vector<float> weights; // for projective interpolation; empty if that is linear interpolation
  std::array<double, 3> layout_centre = {{0, 0, 0}}, surface_centre = {{0, 0, 0}};
  double layout_radius = 1, surface_radius = 1;

  // By triangle. The area factor is that of the scaled ones.
  std::vector<std::uint32_t> triangles;
  Coded_logarithms area_factor, quasi_conformal_factor;
  std::vector<unsigned char> hidden_edges; // bit k: the edge from corner k to the next one; empty if none is hidden

  // The ends of each seam edge in the triangle on its left, the same ends in the triangle on its right, and the number of its path.
  std::vector<std::uint32_t> seams;
  std::size_t number_of_seams = 0;
  std::vector<std::uint32_t> border; // the ends of each border edge
  std::vector<Cone> cones;

  template <typename TriangleMesh, typename HalfedgeUVMap, typename VertexScalarMap, typename VertexPointMap, typename WeightMap>
  Page_data(const TriangleMesh& tm, const HalfedgeUVMap& uv, const VertexScalarMap& log_scale_factors, const VertexPointMap& vpm,
            const WeightMap& weight_map, const std::vector<bool>& is_hidden, const std::vector<std::array<double, 3> >& points_of_spheres = {})
  {
    const bool is_sphere = ! points_of_spheres.empty();
    const auto number = get(CGAL::dynamic_halfedge_property_t<std::size_t>(), tm);
    std::vector<std::array<double, 3> > places, images;
    const auto corners = is_sphere ? number_vertices(tm, number, points_of_spheres, images)
                                   : CGAL::Conformal_equivalence::internal::number_corner_values(tm, uv, number);
    for(auto h : corners)
    {
      const auto& p = get(vpm, target(h, tm));
      places.push_back({{ CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()) }});
      if(! is_sphere)
        images.push_back(in_space(corner_value(uv, h)));
      u.push_back(static_cast<float>(CGAL::to_double(get(log_scale_factors, target(h, tm)))));
    }
    points = fit(places, 3, surface_centre, surface_radius);
    layout = fit(images, is_sphere ? 3 : 2, layout_centre, layout_radius);
    for(auto f : faces(tm))
    {
      std::array<std::size_t, 3> corner;
      std::size_t k = 0;
      for(auto h : CGAL::halfedges_around_face(halfedge(f, tm), tm))
        corner[k++] = get(number, h);
      triangles.insert(triangles.end(), corner.begin(), corner.end());
      area_factor.push_back(area_ratio(places, images, corner));
      quasi_conformal_factor.push_back(CGAL::Conformal_equivalence::quasi_conformal_factor(tm, uv, f));
    }
    if constexpr(! std::is_same<WeightMap, CGAL::internal_np::Param_not_found>::value)
      add_weights(tm, corners, weight_map);
    if(std::find(is_hidden.begin(), is_hidden.end(), true) != is_hidden.end())
      hide_edges(tm, is_hidden);
    if(! is_sphere)
      add_lines(tm, uv, number);
  }

private:
  static std::array<double, 3> in_space(const std::array<double, 2>& p) { return {{ p[0], p[1], 0 }}; }

  // A halfedge to each vertex that has a face, and its image.
  template <typename TriangleMesh, typename HalfedgeNumberMap>
  static std::vector<typename boost::graph_traits<TriangleMesh>::halfedge_descriptor>
  number_vertices(const TriangleMesh& tm, const HalfedgeNumberMap& number, const std::vector<std::array<double, 3> >& points_of_spheres,
                  std::vector<std::array<double, 3> >& images)
  {
    std::vector<typename boost::graph_traits<TriangleMesh>::halfedge_descriptor> corners;
    std::size_t i = 0;
    for(auto v : vertices(tm))
    {
      const std::array<double, 3>& image = points_of_spheres[i++];
      if(halfedge(v, tm) == boost::graph_traits<TriangleMesh>::null_halfedge())
        continue;
      for(auto h : CGAL::halfedges_around_target(v, tm))
        put(number, h, corners.size());
      corners.push_back(halfedge(v, tm));
      images.push_back(image);
    }
    return corners;
  }

  // The first `dimension` coordinates of each.
  static std::vector<float> fit(std::vector<std::array<double, 3> >& values, std::size_t dimension, std::array<double, 3>& centre, double& radius)
  {
    double longest = 0;
    for(std::size_t k = 0; k < dimension; ++k)
    {
      Finite_range range;
      for(const auto& p : values)
        range.insert(p[k]);
      if(range.empty())
        continue;
      centre[k] = range.lower / 2 + range.upper / 2;
      longest = (std::max)(longest, range.upper / 2 - range.lower / 2);
    }
    radius = longest > 0 ? longest : 1;
    std::vector<float> result;
    for(auto& p : values)
      for(std::size_t k = 0; k < dimension; ++k)
      {
        p[k] = (p[k] - centre[k]) / radius;
        result.push_back(static_cast<float>(p[k]));
      }
    return result;
  }

  static double area_ratio(const std::vector<std::array<double, 3> >& places, const std::vector<std::array<double, 3> >& images,
                           const std::array<std::size_t, 3>& corner)
  {
    const auto area = [&](const std::vector<std::array<double, 3> >& values)
    {
      const auto point = [&](std::size_t k) { const auto& p = values[corner[k]]; return Kernel::Point_3(p[0], p[1], p[2]); };
      const Kernel::Vector_3 n = CGAL::cross_product(point(1) - point(0), point(2) - point(0));
      return std::hypot(n.x(), n.y(), n.z()) / 2; // not by its square, which underflows before it does
    };
    return area(images) / area(places);
  }

  // Of projective interpolation only the ratios of weights in a triangle matter.
  template <typename TriangleMesh, typename Corners, typename WeightMap>
  void add_weights(const TriangleMesh& tm, const Corners& corners, const WeightMap& weight_map)
  {
    Finite_range range;
    for(auto h : corners)
    {
      const double w = CGAL::to_double(get(weight_map, target(h, tm)));
      weights.push_back(static_cast<float>(w));
      range.insert(w);
    }
    if(! (range.upper > range.lower))
      weights.clear();
  }

  template <typename TriangleMesh>
  void hide_edges(const TriangleMesh& tm, const std::vector<bool>& is_hidden)
  {
    const auto hides = get(CGAL::dynamic_edge_property_t<bool>(), tm);
    std::size_t i = 0;
    for(auto e : edges(tm))
    {
      put(hides, e, i < is_hidden.size() && is_hidden[i]);
      ++i;
    }
    for(auto f : faces(tm))
    {
      unsigned char mask = 0, bit = 1;
      for(auto h : CGAL::halfedges_around_face(halfedge(f, tm), tm)) // to corner k
      {
        if(get(hides, edge(next(h, tm), tm)))
          mask = static_cast<unsigned char>(mask | bit);
        bit = static_cast<unsigned char>(2 * bit);
      }
      hidden_edges.push_back(mask);
    }
  }

  template <typename TriangleMesh, typename HalfedgeUVMap, typename HalfedgeNumberMap>
  void add_lines(const TriangleMesh& tm, const HalfedgeUVMap& uv, const HalfedgeNumberMap& number)
  {
    const auto corner = [&](auto h) { return static_cast<std::uint32_t>(get(number, h)); };
    const Layout_seams<TriangleMesh, HalfedgeUVMap> found(tm, uv, true);
    for(const auto& path : found.paths())
    {
      for(auto h : path)
      {
        const auto o = opposite(h, tm);
        for(std::uint32_t x : { corner(prev(h, tm)), corner(h), corner(o), corner(prev(o, tm)), static_cast<std::uint32_t>(number_of_seams) })
          seams.push_back(x);
      }
      ++number_of_seams;
    }
    for(auto h : halfedges(tm))
      if(! is_border(h, tm) && is_border(opposite(h, tm), tm))
      {
        border.push_back(corner(prev(h, tm)));
        border.push_back(corner(h));
      }
    for(const auto& c : found.cones())
    {
      Cone cone = { c.angle, c.index, {} };
      for(auto h : CGAL::halfedges_around_target(c.vertex, tm))
        cone.corners.push_back(corner(h));
      std::sort(cone.corners.begin(), cone.corners.end());
      cone.corners.erase(std::unique(cone.corners.begin(), cone.corners.end()), cone.corners.end());
      cones.push_back(cone);
    }
  }
};

} // namespace flattening

#endif // FLATTEN_MESH_PAGE_DATA_H
