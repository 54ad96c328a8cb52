// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A picture of a layout: its triangles coloured by a number each, for example the
// logarithmic scale factor (section 2 of the paper) or the quasi-conformal factor
// (section 7), under a checkerboard or the tiles of a seamless layout (section 6), with the
// outline, the two sides of each seam (section 3.3) in one colour, the cones (section 5), and a legend.

#ifndef FLATTEN_MESH_WRITE_SVG_H
#define FLATTEN_MESH_WRITE_SVG_H

#include "color_scale.h"
#include "layout_outline.h"
#include "layout_seams.h"
#include "page_text.h"
#include "PNG.h"

#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace flattening {

// How `write_SVG()` draws.
struct SVG_options
{
  // What stands over the colours of the legend.
  std::string legend = "u";
  // Whether a checkerboard lies over the triangles, its squares along the axes of the layout.
  bool checkerboard = true;
  // The side of a square; 0 chooses a round number such that about 20 squares lie along the layout.
  double square = 0;
  // The symmetry n of a seamless layout (see `Tiling`). Its tiles are drawn under the edges: for n = 2 and 4 unit squares with the
  // integers in their centres, for n = 3 and 6 regular hexagons about the points of Z + Z e^{i pi / 3}, and none for any other n.
  // Where tiles would take more than 1000 lines, larger squares are drawn, each of an odd number of tiles along its side; and no hexagons.
  int tiles = 0;
  // The longer side of the drawing.
  double size = 1000;
  // Up to this many faces the edges are drawn, apart from very short ones;
  std::size_t maximum_number_of_faces_with_edges = 20000;

  // By position in edges(tm): edges that are not drawn. Empty: there are none.
  std::vector<bool> hidden_edges;
  // up to this many the triangles are drawn as such; those of larger meshes become an image of pixels.
  std::size_t maximum_number_of_drawn_faces = 250000;
  // Whether the two sides of each seam path are drawn in a colour of their own. A seam is an interior edge of the mesh
  // whose two sides lie apart in the layout. A path of them ends where another number of seam edges than two meet, at the
  // border of the mesh, and at cones (if these are drawn).
  bool seams = true;
  // Whether a dot is drawn at each corner of a cone: an interior vertex of the mesh whose angles in the layout do not sum
  // up to 2 pi within 1e-6 and the rounding of the coordinates. Switch it off for a layout in charts: at their common
  // borders angles sum up to anything.
  bool cones = true;
  // The length of a unit of the layout in millimetres, which gives the drawing its size; 0: it has none.
  double millimetres = 0;
  // Circles that are drawn, too, each by its centre and its radius in the layout.
  std::vector<std::array<double, 3> > circles;
};

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

// From the layout to the drawing: y points down there, and coordinates are
// integers, hundredths of the unit of the drawing.
struct SVG_frame
{
  double left, top, scale, width, height;

  SVG_frame(const Finite_range& x, const Finite_range& y, double size)
    : left(x.empty() ? 0 : x.lower), top(y.empty() ? 0 : y.upper), scale(1), width(size), height(size)
  {
    const double w = x.empty() ? 0 : x.upper - x.lower, h = y.empty() ? 0 : y.upper - y.lower;
    const double longest = (std::max)(w, h);
    if(longest > 0 && std::isfinite(longest))
    {
      scale = size / longest;
      width = w / longest * size;
      height = h / longest * size;
    }
  }

  std::array<double, 2> operator()(const std::array<double, 2>& p) const
  {
    return {{ (p[0] - left) * scale, (top - p[1]) * scale }};
  }

  // the part of the layout that is drawn
  std::array<double, 2> lower_left() const  { return {{ left, top - height / scale }}; }
  std::array<double, 2> upper_right() const { return {{ left + width / scale, top }}; }

  std::array<std::int64_t, 2> in_hundredths(const std::array<double, 2>& p) const
  {
    // numbers too far apart for a frame are drawn at its rim
    const auto rounded = [](double x) { return std::llround((std::min)((std::max)(100 * x, -1e15), 1e15)); };
    const std::array<double, 2> q = (*this)(p);
    return {{ rounded(q[0]), rounded(q[1]) }};
  }
};

template <typename TriangleMesh, typename HalfedgeUVMap, typename FaceScalarMap>
class SVG_writer
{
  typedef boost::graph_traits<TriangleMesh>           Graph_traits;
  typedef typename Graph_traits::halfedge_descriptor  halfedge_descriptor;
  typedef typename Graph_traits::face_descriptor      face_descriptor;
  typedef std::array<double, 2>                       Point;
  typedef std::array<std::int64_t, 2>                 Grid_point;
  typedef Layout_seams<TriangleMesh, HalfedgeUVMap>   Seams;

  static constexpr std::size_t number_of_classes = 64;
  static constexpr double shortest_edge_drawn = 4; // shorter ones would only hide the colours
  static constexpr double most_lines_of_squares = 1000, most_hexagons = 10000;

public:
  SVG_writer(const TriangleMesh& tm, const HalfedgeUVMap& uv, const FaceScalarMap& scalar,
             const SVG_options& options)
    : tm_(tm), uv_(uv), scalar_(scalar), options_(options), frame_(frame())
  {
    if(! (options_.square > 0))
      options_.square = round_number_below(options_.size / frame_.scale / 14);
    for(face_descriptor f : faces(tm_))
      values_.insert(CGAL::to_double(get(scalar_, f)));
  }

  // the side of a square of the checkerboard
  double square() const { return options_.square; }

  void write(Text_buffer& out) const
  {
    const double margin = 20, legend_width = 200;
    const double width = frame_.width + 2 * margin + legend_width, height = (std::max)(frame_.height, 360.) + 2 * margin;
    out << "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" viewBox=\""
        << -margin << ' ' << -margin << ' ' << width << ' ' << height;
    if(options_.millimetres > 0)
      out << "\" width=\"" << width / frame_.scale * options_.millimetres << "mm\" height=\"" << height / frame_.scale * options_.millimetres << "mm";
    out << "\" font-family=\"sans-serif\" font-size=\"16\">\n";
    if(number_of_faces() > options_.maximum_number_of_drawn_faces)
      write_image(out);
    else
      write_triangles(out);
    write_tiles(out);
    if(number_of_faces() <= (std::min)(options_.maximum_number_of_drawn_faces, options_.maximum_number_of_faces_with_edges))
      write_edges(out);
    write_circles(out);
    write_outline(out);
    write_seams_and_cones(out);
    write_legend(out, frame_.width + margin);
    out << "</svg>\n";
  }

private:
  std::size_t number_of_faces() const { return faces(tm_).size(); }

  SVG_frame frame() const
  {
    Finite_range x, y;
    for(face_descriptor f : faces(tm_))
      for(const Point& p : corners(f))
        if(is_finite(p))
        {
          x.insert(p[0]);
          y.insert(p[1]);
        }
    for(const std::array<double, 3>& c : options_.circles)
      for(const double sign : {-1., 1.})
      {
        x.insert(c[0] + sign * c[2]);
        y.insert(c[1] + sign * c[2]);
      }
    return SVG_frame(x, y, options_.size);
  }

  static bool is_finite(const Point& p) { return std::isfinite(p[0]) && std::isfinite(p[1]); }

  std::array<Point, 3> corners(face_descriptor f) const
  {
    const halfedge_descriptor h = halfedge(f, tm_), n = next(h, tm_);
    return {{ corner_value(uv_, h), corner_value(uv_, n), corner_value(uv_, next(n, tm_)) }};
  }

  bool is_drawable(const std::array<Point, 3>& t) const
  {
    return is_finite(t[0]) && is_finite(t[1]) && is_finite(t[2]);
  }

  std::size_t color_class(face_descriptor f) const
  {
    const double t = values_.parameter(CGAL::to_double(get(scalar_, f)));
    return (std::min)(static_cast<std::size_t>(t * number_of_classes), number_of_classes - 1);
  }

  static std::string class_color(std::size_t c)
  {
    return hexadecimal(sequential_color((double(c) + 0.5) / number_of_classes));
  }

  // One path a colour.
  void write_triangles(Text_buffer& out) const
  {
    std::array<std::vector<face_descriptor>, number_of_classes> classes;
    for(face_descriptor f : faces(tm_))
      classes[color_class(f)].push_back(f);

    out << "<g id=\"triangles\" transform=\"scale(.01)\" stroke-width=\"30\" stroke-linejoin=\"round\">\n";
    for(std::size_t c = 0; c < number_of_classes; ++c)
    {
      if(classes[c].empty())
        continue;
      const std::string color = class_color(c);
      out << "<path fill=\"" << color << "\" stroke=\"" << color << "\" d=\"";
      for(face_descriptor f : classes[c])
        write_triangle(out, corners(f));
      out << "\"/>\n";
    }
    out << "</g>\n";
  }

  void write_triangle(Text_buffer& out, const std::array<Point, 3>& t) const
  {
    if(! is_drawable(t))
      return;
    const Grid_point a = frame_.in_hundredths(t[0]), b = frame_.in_hundredths(t[1]), c = frame_.in_hundredths(t[2]);
    out << 'M' << a[0] << ' ' << a[1];
    write_step(out << 'l', a, b);
    write_step(out << ' ', b, c);
    out << 'z';
  }

  static void write_step(Text_buffer& out, const Grid_point& a, const Grid_point& b)
  {
    out << b[0] - a[0] << ' ' << b[1] - a[1];
  }

  // --- the tiles of a seamless layout --------------------------------------------------------------------

  bool has_square_tiles() const    { return options_.tiles == 2 || options_.tiles == 4; }
  bool has_hexagonal_tiles() const { return options_.tiles == 3 || options_.tiles == 6; }

  void write_tiles(Text_buffer& out) const
  {
    const Point lower = frame_.lower_left(), upper = frame_.upper_right();
    const double squares = side_of_squares(), hexagons = (upper[0] - lower[0] + 1) * (upper[1] - lower[1] + 1) * 2 / std::sqrt(3.);
    if(has_square_tiles() ? ! (squares > 0) : ! has_hexagonal_tiles() || ! (hexagons <= most_hexagons))
      return;
    out << "<path id=\"tiles\" transform=\"scale(.01)\" fill=\"none\" stroke=\"#000\" stroke-opacity=\".5\" stroke-width=\"80\" d=\"";
    if(has_square_tiles())
      write_squares(out, squares);
    else
      write_hexagons(out);
    out << "\"/>\n";
  }

  // An odd number of tiles, so that the squares have integers in their centres; zero where numbers fail.
  double side_of_squares() const
  {
    const Point lower = frame_.lower_left(), upper = frame_.upper_right();
    const double lines = upper[0] - lower[0] + (upper[1] - lower[1]) + 2;
    if(! (lines < 1e15) || ! ((std::max)({std::abs(lower[0]), std::abs(lower[1]), std::abs(upper[0]), std::abs(upper[1])}) < 1e15))
      return 0;
    return 2 * std::floor((std::ceil(lines / most_lines_of_squares)) / 2) + 1;
  }

  // The lines (k + 1/2) side.
  void write_squares(Text_buffer& out, double side) const
  {
    const Point lower = frame_.lower_left(), upper = frame_.upper_right();
    for(std::size_t axis = 0; axis < 2; ++axis)
      for(double k = std::ceil(lower[axis] / side - 0.5); (k + 0.5) * side <= upper[axis]; ++k)
      {
        Point p = lower, q = upper;
        p[axis] = q[axis] = (k + 0.5) * side;
        const Grid_point a = frame_.in_hundredths(p), b = frame_.in_hundredths(q);
        out << 'M' << a[0] << ' ' << a[1];
        write_step(out << 'l', a, b);
      }
  }

  // Of each hexagon four corners, from the left to the right; the other edges are those of its neighbours below.
  void write_hexagons(Text_buffer& out) const
  {
    const Point lower = frame_.lower_left(), upper = frame_.upper_right();
    const double row = std::sqrt(3.) / 2, h = row / 3;
    for(double b = std::ceil(lower[1] / row) - 1; b * row <= upper[1] + h; ++b)
      for(double a = std::ceil(lower[0] - b / 2 - 0.5); a + b / 2 <= upper[0] + 0.5; ++a)
      {
        const double x = a + b / 2, y = b * row;
        const std::array<Point, 4> corners = {{ {{x - 0.5, y + h}}, {{x, y + 2 * h}}, {{x + 0.5, y + h}}, {{x + 0.5, y - h}} }};
        Grid_point previous = frame_.in_hundredths(corners[0]);
        out << 'M' << previous[0] << ' ' << previous[1];
        for(std::size_t k = 1; k < 4; ++k)
        {
          const Grid_point next = frame_.in_hundredths(corners[k]);
          write_step(out << 'l', previous, next);
          previous = next;
        }
      }
  }

  // -------------------------------------------------------------------------------------------------------

  void write_edges(Text_buffer& out) const
  {
    out << "<path id=\"edges\" transform=\"scale(.01)\" fill=\"none\" stroke=\"#fff\" stroke-opacity=\".35\" stroke-width=\"40\" d=\"";
    std::size_t i = 0;
    for(auto e : edges(tm_))
    {
      if(i++ < options_.hidden_edges.size() && options_.hidden_edges[i - 1])
        continue;
      halfedge_descriptor h = halfedge(e, tm_);
      if(is_border(h, tm_))
        h = opposite(h, tm_);
      if(is_border(h, tm_) || is_outline(tm_, uv_, h))
        continue;
      const Point p = corner_value(uv_, prev(h, tm_)), q = corner_value(uv_, h);
      if(! is_finite(p) || ! is_finite(q))
        continue;
      if(std::hypot(q[0] - p[0], q[1] - p[1]) * frame_.scale < shortest_edge_drawn)
        continue;
      const Grid_point a = frame_.in_hundredths(p), b = frame_.in_hundredths(q);
      out << 'M' << a[0] << ' ' << a[1];
      write_step(out << 'l', a, b);
    }
    out << "\"/>\n";
  }

  // The triangles of a large mesh, as pixels.
  void write_image(Text_buffer& out) const
  {
    std::vector<Palette_image::Color> palette(1, Palette_image::Color{{0, 0, 0, 0}});
    for(std::size_t c = 0; c < number_of_classes; ++c)
    {
      const RGB rgb = sequential_color((double(c) + 0.5) / number_of_classes);
      palette.push_back({{rgb[0], rgb[1], rgb[2], 255}});
    }
    const double pixels = 1.5; // in a unit of the drawing
    Palette_image image(number_of_pixels(pixels * frame_.width), number_of_pixels(pixels * frame_.height), palette);
    for(face_descriptor f : faces(tm_))
      fill(image, pixels, corners(f), static_cast<unsigned char>(1 + color_class(f)));

    const std::string png = png_file(image);
    out << "<image id=\"triangles\" width=\"" << image.width / pixels << "\" height=\"" << image.height / pixels
        << "\" xlink:href=\"data:image/png;base64,";
    write_base64(out, reinterpret_cast<const unsigned char*>(png.data()), png.size());
    out << "\"/>\n";
  }

  static std::uint32_t number_of_pixels(double x)
  {
    return static_cast<std::uint32_t>((std::max)(1., std::ceil(x)));
  }

  // Colours the pixels whose centres lie in the triangle, row by row; a triangle
  // that holds no centre still colours the pixel at its centroid.
  void fill(Palette_image& image, double pixels, const std::array<Point, 3>& t, unsigned char color) const
  {
    if(! is_drawable(t))
      return;
    std::array<Point, 3> q;
    for(std::size_t k = 0; k < 3; ++k)
    {
      q[k] = frame_(t[k]);
      q[k] = {{ q[k][0] * pixels - 0.5, q[k][1] * pixels - 0.5 }};
    }
    const auto pixel = [&](double x, double y) -> unsigned char&
    {
      const auto inside = [](double z, std::uint32_t n) { return static_cast<std::size_t>((std::min)((std::max)(z, 0.), n - 1.)); };
      return image.pixels[inside(y, image.height) * image.width + inside(x, image.width)];
    };
    pixel(std::round((q[0][0] + q[1][0] + q[2][0]) / 3), std::round((q[0][1] + q[1][1] + q[2][1]) / 3)) = color;

    const double bottom = (std::max)({q[0][1], q[1][1], q[2][1]});
    for(double y = std::ceil((std::min)({q[0][1], q[1][1], q[2][1]})); y <= bottom; ++y)
    {
      Finite_range row;
      for(std::size_t k = 0; k < 3; ++k)
      {
        const Point& a = q[k];
        const Point& b = q[(k + 1) % 3];
        if((a[1] <= y) != (b[1] <= y))
          row.insert(a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
      }
      for(double x = std::ceil(row.lower); x <= row.upper; ++x)
        pixel(x, y) = color;
    }
  }

  // The closed curves around the layout, filled with the checkerboard.
  void write_outline(Text_buffer& out) const
  {
    if(options_.checkerboard)
      write_checkerboard_pattern(out);
    out << "<path id=\"outline\" fill=\"" << (options_.checkerboard ? "url(#checkerboard)" : "none")
        << "\" stroke=\"#000\" stroke-width=\"1.5\" stroke-linejoin=\"round\" d=\"";
    auto is_done = get(CGAL::dynamic_halfedge_property_t<bool>(), tm_);
    for(halfedge_descriptor h : halfedges(tm_))
      put(is_done, h, false);
    for(halfedge_descriptor h : halfedges(tm_))
      if(! is_border(h, tm_) && ! get(is_done, h) && is_outline(tm_, uv_, h))
        write_closed_curve(out, h, is_done);
    out << "\"/>\n";
  }

  template <typename HalfedgeBoolMap>
  void write_closed_curve(Text_buffer& out, halfedge_descriptor first, HalfedgeBoolMap is_done) const
  {
    bool is_begun = false;
    Grid_point previous{{0, 0}};
    halfedge_descriptor h = first;
    do
    {
      put(is_done, h, true);
      const Point p = corner_value(uv_, h);
      if(is_finite(p))
      {
        const Grid_point q = frame_.in_hundredths(p);
        if(! is_begun)
          write_hundredths(out << 'M', q);
        else if(q != previous)
          write_hundredths(out << 'l', {{ q[0] - previous[0], q[1] - previous[1] }});
        is_begun = true;
        previous = q;
      }
      h = next_on_outline(tm_, uv_, h);
    }
    while(h != first);
    if(is_begun)
      out << 'z';
  }

  void write_circles(Text_buffer& out) const
  {
    if(options_.circles.empty())
      return;
    out << "<g id=\"circles\" fill=\"none\" stroke=\"#888\">\n";
    for(const std::array<double, 3>& c : options_.circles)
    {
      const Point centre = frame_({{ c[0], c[1] }});
      out << "<circle cx=\"" << centre[0] << "\" cy=\"" << centre[1] << "\" r=\"" << c[2] * frame_.scale << "\"/>\n";
    }
    out << "</g>\n";
  }

  void write_seams_and_cones(Text_buffer& out) const
  {
    if(! options_.seams && ! options_.cones)
      return;
    const Seams seams(tm_, uv_, options_.cones);
    if(options_.seams && ! seams.paths().empty())
      write_seams(out, seams.paths());
    if(! seams.cones().empty())
      write_cones(out, seams.cones());
  }

  // A path a seam path, with both of its sides.
  void write_seams(Text_buffer& out, const std::vector<typename Seams::Path>& paths) const
  {
    const std::vector<std::string> colors = seam_colors(paths.size());
    out << "<g id=\"seams\" transform=\"scale(.01)\" fill=\"none\" stroke-width=\"400\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n";
    for(std::size_t i = 0; i < paths.size(); ++i)
    {
      out << "<path stroke=\"" << colors[i] << "\" d=\"";
      write_side(out, paths[i], [&](halfedge_descriptor h)
        { return std::make_pair(corner_value(uv_, prev(h, tm_)), corner_value(uv_, h)); });
      write_side(out, paths[i], [&](halfedge_descriptor h)
      {
        const halfedge_descriptor o = opposite(h, tm_);
        return std::make_pair(corner_value(uv_, o), corner_value(uv_, prev(o, tm_)));
      });
      out << "\"><title>seam " << i + 1 << ", edges: " << paths[i].size() << "</title></path>\n";
    }
    out << "</g>\n";
  }

  template <typename EndsOfEdge>
  void write_side(Text_buffer& out, const typename Seams::Path& path, const EndsOfEdge& ends_of_edge) const
  {
    bool is_begun = false;
    Grid_point previous{{0, 0}};
    for(halfedge_descriptor h : path)
    {
      const std::pair<Point, Point> ends = ends_of_edge(h);
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

  static void write_hundredths(Text_buffer& out, const Grid_point& p)
  {
    out << static_cast<double>(p[0]) / 100 << ' ' << static_cast<double>(p[1]) / 100;
  }

  // Squares of the layout, one of them with its lower left corner at the origin.
  void write_checkerboard_pattern(Text_buffer& out) const
  {
    const double side = options_.square * frame_.scale, period = 2 * side;
    const Point origin = frame_({{0, 0}});
    out << "<defs><pattern id=\"checkerboard\" patternUnits=\"userSpaceOnUse\" x=\"" << std::fmod(origin[0], period)
        << "\" y=\"" << std::fmod(origin[1], period) << "\" width=\"" << period << "\" height=\"" << period
        << "\"><path d=\"M0 0h" << side << 'v' << period << 'h' << side << 'v' << -side << 'h' << -period
        << "z\" fill=\"#000\" fill-opacity=\".25\"/></pattern></defs>\n";
  }

  void write_legend(Text_buffer& out, double x) const
  {
    const double height = 256, top = 50;
    out << "<g id=\"legend\"><text x=\"" << x << "\" y=\"" << top - 30 << "\">"
        << escaped_for_xml(options_.legend) << "</text>\n<defs><linearGradient id=\"colors\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">";
    for(int i = 0; i <= 8; ++i)
      out << "<stop offset=\"" << i / 8. << "\" stop-color=\"" << hexadecimal(sequential_color(i / 8.)) << "\"/>";
    out << "</linearGradient></defs>\n<rect x=\"" << x << "\" y=\"" << top
        << "\" width=\"24\" height=\"" << height << "\" fill=\"url(#colors)\"/>\n";
    if(! values_.empty())
    {
      out << "<text x=\"" << x + 30 << "\" y=\"" << top + 12 << "\">" << short_text(values_.upper) << "</text>\n"
          << "<text x=\"" << x + 30 << "\" y=\"" << top + height << "\">" << short_text(values_.lower) << "</text>\n";
    }
    const auto write_note = [&](double line, const char* text, double value)
    {
      out << "<text x=\"" << x << "\" y=\"" << top + height + 34 + 20 * line << "\" font-size=\"13\">" << text << short_text(value) << "</text>\n";
    };
    if(options_.checkerboard)
      write_note(0, "side of a square: ", options_.square);
    if(has_square_tiles() && side_of_squares() > 1)
      write_note(1, "tiles in a square, along a side: ", side_of_squares());
    out << "</g>\n";
  }

  static std::string short_text(double x)
  {
    char text[32];
    const std::to_chars_result end = std::to_chars(text, text + sizeof text, x, std::chars_format::general, 6);
    return std::string(text, end.ptr);
  }

  const TriangleMesh& tm_;
  const HalfedgeUVMap& uv_;
  const FaceScalarMap& scalar_;
  SVG_options options_;
  SVG_frame frame_;
  Finite_range values_;
};

// Draws the layout `uv` of the triangle mesh `tm` as SVG: the triangles in 64 colours by the values of `scalar`, a checkerboard
// whose squares lie along the axes of the layout, or the tiles of a seamless one, the outline (borders and seams), the two sides
// of each seam path in the same colour, the cones as dots, and a legend with the colours, the least and the largest value.
//
// `uv[h]` is the place of the corner of `target(h, tm)` in `face(h, tm)`. Corners that are not finite are left out. The layout
// may have several pieces. `scalar` gives a number for each face; infinities are drawn at the ends of the scale of colours, NaN
// in its middle.
//
// Seams and cones are found in the layout itself (see `SVG_options`). Their titles, which browsers show under the mouse, give the
// number of a seam and of its edges, the place of a cone in `vertices(tm)` and its angle in degrees. The colours of seam paths
// are all different (of some thousands of paths: nearly all), and easily told apart if there are no more than 16.
//
// Returns `true` iff the stream is good after writing. Takes linear time. A drawing of 200 000 triangles takes about 6 MB.
template <typename TriangleMesh, typename HalfedgeUVMap, typename FaceScalarMap>
bool write_SVG(std::ostream& out, const TriangleMesh& tm, HalfedgeUVMap uv, FaceScalarMap scalar,
               const SVG_options& options = SVG_options())
{
  {
    Text_buffer buffer(out);
    SVG_writer<TriangleMesh, HalfedgeUVMap, FaceScalarMap>(tm, uv, scalar, options).write(buffer);
  }
  out.flush();
  return out.good();
}

} // namespace flattening

#endif // FLATTEN_MESH_WRITE_SVG_H
