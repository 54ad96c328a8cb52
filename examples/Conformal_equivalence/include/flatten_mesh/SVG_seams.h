// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_SVG_SEAMS_H
#define FLATTEN_MESH_SVG_SEAMS_H

#include "color_scale.h"
#include "layout_outline.h"
#include "layout_seams.h"
#include "page_text.h"
#include "SVG_frame.h"

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace flattening {

// Colours that are all different, the i-th far from those before it: lightness and hue are the points of a sequence that fills the square evenly
// (the additive recurrence of the plastic number; Roberts 2018), in the cylindrical coordinates of Oklab (Ottosson 2020).
inline RGB distinct_color(std::size_t i)
{
  const auto fraction = [i](double step) { const double x = double(i) * step; return x - std::floor(x); };
  const double lightness = 0.45 + 0.35 * fraction(0.5698402909980532), hue = 2 * CGAL_PI * fraction(0.7548776662466927);
  const double a = 0.12 * std::cos(hue), b = 0.12 * std::sin(hue);
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lightness + 0.3963377774 * a + 0.2158037573 * b),
               m = cube(lightness - 0.1055613458 * a - 0.0638541728 * b),
               s = cube(lightness - 0.0894841775 * a - 1.2914855480 * b);
  const auto channel = [](double x) // of sRGB, from linear light
  {
    x = (std::min)((std::max)(x, 0.), 1.);
    return static_cast<unsigned char>(std::lround(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055)));
  };
  return {{ channel(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
            channel(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
            channel(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s) }};
}

// The two sides of each seam path, and the cones, as they are found in the layout.
template <typename TriangleMesh, typename HalfedgeUVMap>
class SVG_seams
{
  typedef typename boost::graph_traits<TriangleMesh>::halfedge_descriptor  halfedge_descriptor;
  typedef std::array<double, 2>                                            Point;
  typedef Layout_seams<TriangleMesh, HalfedgeUVMap>                        Seams;

  static constexpr double shortest_side_with_number = 30;
  static constexpr double farthest_number = 1e9; // where no drawing is

public:
  SVG_seams(const SVG_frame& frame, const TriangleMesh& tm, const HalfedgeUVMap& uv, bool with_seams, bool with_cones)
    : frame_(frame), tm_(tm), uv_(uv), with_seams_(with_seams)
  {
    if(with_seams || with_cones)
      seams_.emplace(tm, uv, with_cones);
  }

  bool has_seams() const { return with_seams_ && ! seams_->paths().empty(); }
  bool has_cones() const { return seams_ && ! seams_->cones().empty(); }

  void write(Text_buffer& out) const
  {
    if(has_seams())
      write_seams(out, seams_->paths());
    if(has_cones())
      write_cones(out, seams_->cones());
  }

private:
  // A path a seam path, with both of its sides.
  void write_seams(Text_buffer& out, const std::vector<typename Seams::Path>& paths) const
  {
    const std::vector<std::string> colors = seam_colors(paths.size());
    out << "<g id=\"seams\" transform=\"scale(.01)\" fill=\"none\" stroke-width=\"400\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
    for(std::size_t i = 0; i < paths.size(); ++i)
    {
      out << "<path stroke=\"" << colors[i] << "\" d=\"";
      for(const bool is_left : {true, false})
        write_side(out, paths[i], is_left);
      out << "\"><title>seam " << i + 1 << ", edges: " << paths[i].size() << "</title></path>\n";
    }
    out << "</g>\n";
    write_numbers(out, paths);
  }

  // The ends of an edge of a path, on one of its sides.
  std::pair<Point, Point> ends_of_edge(halfedge_descriptor h, bool is_left) const
  {
    if(is_left)
      return std::make_pair(corner_value(uv_, prev(h, tm_)), corner_value(uv_, h));
    const halfedge_descriptor o = opposite(h, tm_);
    return std::make_pair(corner_value(uv_, o), corner_value(uv_, prev(o, tm_)));
  }

  // Colours alone do not tell paths apart to everybody: each side has its number in its middle, unless it is too short.
  void write_numbers(Text_buffer& out, const std::vector<typename Seams::Path>& paths) const
  {
    out << "<g id=\"seam-numbers\" font-size=\"14\" font-weight=\"bold\">\n";
    for(std::size_t i = 0; i < paths.size(); ++i)
      for(const bool is_left : {true, false})
        if(const std::optional<Point> p = middle(paths[i], is_left))
          out << "<text x=\"" << std::round(10 * (*p)[0]) / 10 << "\" y=\"" << std::round(10 * ((*p)[1] + 5)) / 10 << "\" " << text_with_halo << '>'
              << i + 1 << "</text>\n";
    out << "</g>\n";
  }

  // Of a side, in the drawing; nothing if there is no room for a number, or if a place is not finite.
  std::optional<Point> middle(const typename Seams::Path& path, bool is_left) const
  {
    std::vector<std::pair<Point, Point> > edges;
    double length = 0;
    for(halfedge_descriptor h : path)
    {
      const std::pair<Point, Point> ends = ends_of_edge(h, is_left);
      edges.emplace_back(frame_(ends.first), frame_(ends.second));
      length += distance(edges.back());
    }
    if(! (length >= shortest_side_with_number) || ! std::isfinite(length))
      return std::nullopt;
    double rest = length / 2;
    for(const std::pair<Point, Point>& e : edges)
    {
      const double l = distance(e);
      if(rest <= l)
      {
        const double t = l > 0 ? rest / l : 0;
        const Point place{{ (1 - t) * e.first[0] + t * e.second[0], (1 - t) * e.first[1] + t * e.second[1] }};
        return std::hypot(place[0], place[1]) < farthest_number ? std::optional<Point>(place) : std::nullopt;
      }
      rest -= l;
    }
    return edges.back().second;
  }

  static double distance(const std::pair<Point, Point>& e) { return std::hypot(e.second[0] - e.first[0], e.second[1] - e.first[1]); }

  void write_side(Text_buffer& out, const typename Seams::Path& path, bool is_left) const
  {
    bool is_begun = false;
    Grid_point previous{{0, 0}};
    for(halfedge_descriptor h : path)
    {
      const std::pair<Point, Point> ends = ends_of_edge(h, is_left);
      if(! is_finite(ends.first) || ! is_finite(ends.second))
      {
        is_begun = false;
        continue;
      }
      const Grid_point a = frame_.in_hundredths(ends.first), b = frame_.in_hundredths(ends.second);
      if(! is_begun || a != previous)
        out << 'M' << a[0] << ' ' << a[1];
      if(a != b)
        write_step(out << 'l', a, b);
      is_begun = true;
      previous = b;
    }
  }

  // All are different; up to 16 are easy to tell apart.
  static std::vector<std::string> seam_colors(std::size_t number_of_paths)
  {
    std::vector<std::string> colors;
    for(std::size_t i = 0; i < number_of_paths; ++i)
      colors.push_back(number_of_paths <= number_of_categorical_colors ? std::string("#") + categorical_color(i) : hexadecimal(distinct_color(i)));
    return colors;
  }

  // A dot a place.
  void write_cones(Text_buffer& out, const std::vector<typename Seams::Cone>& cones) const
  {
    out << "<g id=\"cones\" fill=\"#111\" stroke=\"#fff\" stroke-width=\"1.5\">\n";
    for(const typename Seams::Cone& cone : cones)
    {
      std::vector<Grid_point> places;
      for(halfedge_descriptor h : CGAL::halfedges_around_target(cone.vertex, tm_))
        if(is_finite(corner_value(uv_, h)))
          places.push_back(frame_.in_hundredths(corner_value(uv_, h)));
      std::sort(places.begin(), places.end());
      places.erase(std::unique(places.begin(), places.end()), places.end());
      for(const Grid_point& p : places)
        out << "<circle cx=\"" << static_cast<double>(p[0]) / 100 << "\" cy=\"" << static_cast<double>(p[1]) / 100
            << "\" r=\"6\"><title>vertex " << cone.index << ", angle: " << short_text(cone.angle * (180 / CGAL_PI))
            << " degrees</title></circle>\n";
    }
    out << "</g>\n";
  }

  const SVG_frame& frame_;
  const TriangleMesh& tm_;
  const HalfedgeUVMap& uv_;
  bool with_seams_;
  std::optional<Seams> seams_;
};

} // namespace flattening

#endif // FLATTEN_MESH_SVG_SEAMS_H
