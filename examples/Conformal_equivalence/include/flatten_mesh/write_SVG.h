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
#include "page_text.h"
#include "PNG.h"
#include "Robust_range.h"
#include "SVG_frame.h"
#include "SVG_key.h"
#include "SVG_options.h"
#include "SVG_seams.h"
#include "SVG_sphere.h"
#include "SVG_tiles.h"

#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace flattening {

template <typename TriangleMesh, typename HalfedgeUVMap, typename FaceScalarMap>
class SVG_writer
{
  typedef boost::graph_traits<TriangleMesh>           Graph_traits;
  typedef typename Graph_traits::halfedge_descriptor  halfedge_descriptor;
  typedef typename Graph_traits::face_descriptor      face_descriptor;
  typedef std::array<double, 2>                       Point;

  static constexpr std::size_t number_of_classes = 64;
  static constexpr double shortest_edge_drawn = 4; // shorter ones would only hide the colours

public:
  SVG_writer(const TriangleMesh& tm, const HalfedgeUVMap& uv, const FaceScalarMap& scalar,
             const SVG_options& options)
    : tm_(tm), uv_(uv), scalar_(scalar), options_(options), frame_(frame())
  {
    if(! (options_.square > 0))
      options_.square = round_number_below(options_.size / frame_.scale / 14);
    std::vector<double> values;
    for(face_descriptor f : faces(tm_))
      values.push_back(CGAL::to_double(get(scalar_, f)));
    range_ = Robust_range(values);
  }

  // the side of a square of the checkerboard
  double square() const { return options_.square; }

  void write(Text_buffer& out) const
  {
    const SVG_tiles tiles(frame_, options_.tiles);
    const SVG_seams<TriangleMesh, HalfedgeUVMap> seams(frame_, tm_, uv_, options_.seams, options_.cones);
    const SVG_key key = this->key(tiles.note(), seams.has_seams(), seams.has_cones());
    const double margin = 20, width = frame_.width + 2 * margin + key.width, height = (std::max)(frame_.height, key.height()) + 2 * margin;
    out << "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" viewBox=\""
        << -margin << ' ' << -margin << ' ' << width << ' ' << height;
    if(options_.millimetres > 0)
      out << "\" width=\"" << width / frame_.scale * options_.millimetres << "mm\" height=\"" << height / frame_.scale * options_.millimetres << "mm";
    out << "\" font-family=\"sans-serif\" font-size=\"16\">\n";
    if(number_of_faces() > options_.maximum_number_of_drawn_faces)
      write_image(out);
    else
      write_triangles(out);
    tiles.write(out);
    if(number_of_faces() <= (std::min)(options_.maximum_number_of_drawn_faces, options_.maximum_number_of_faces_with_edges))
      write_edges(out);
    write_circles(out);
    write_outline(out);
    SVG_sphere(frame_, options_.hemispheres).write(out);
    seams.write(out);
    key.write(out, frame_.width + margin);
    out << "</svg>\n";
  }

private:
  std::size_t number_of_faces() const { return faces(tm_).size(); }

  SVG_key key(const std::string& note_of_tiles, bool has_seams, bool has_cones) const
  {
    SVG_key key(options_.legend, range_);
    if(options_.checkerboard)
      key.add_note("side of a square: " + short_text(options_.square));
    if(! note_of_tiles.empty())
      key.add_note(note_of_tiles);
    if(has_seams)
      key.explain_seams();
    if(has_cones)
      key.explain_cones();
    return key;
  }

  SVG_frame frame() const
  {
    Layout_box box = layout_box(tm_, uv_);
    for(const std::array<double, 3>& c : options_.circles)
      for(const double sign : {-1., 1.})
      {
        box.x.insert(c[0] + sign * c[2]);
        box.y.insert(c[1] + sign * c[2]);
      }
    return SVG_frame(box.x, box.y, options_.size);
  }

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
    const double t = range_.parameter(CGAL::to_double(get(scalar_, f)));
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

  const TriangleMesh& tm_;
  const HalfedgeUVMap& uv_;
  const FaceScalarMap& scalar_;
  SVG_options options_;
  SVG_frame frame_;
  Robust_range range_; // of colours
};

// Draws the layout `uv` of the triangle mesh `tm` as SVG: the triangles in 64 colours by the values of `scalar`, a checkerboard
// whose squares lie along the axes of the layout, or the tiles of a seamless one, the outline (borders and seams), the two sides
// of each seam path in the same colour and with the same number, the cones as dots, and a legend with the colours and the range over which they are
// spread: the `Robust_range` of the values, with the number of triangles whose values are beyond, which have the colours of its ends.
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
