// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// One page to judge a map by: the surface in space and its layout, or the sphere, beside it, linked, with a pattern carried over, the logarithmic
// scale factors (section 2 of the paper), area and quasi-conformal factors (section 7), seams (section 3.3), cones (section 5) and
// figures. The page asks for nothing from anywhere; what it does is in the folder flatten_mesh/page.

#ifndef FLATTEN_MESH_WRITE_HTML_H
#define FLATTEN_MESH_WRITE_HTML_H

#include "color_scale.h"
#include "page_data.h"
#include "page_template.h"
#include "page_text.h"
#include "write_SVG.h"

#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/boost/graph/named_params_helper.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flattening {

// What `write_HTML()` shows beside the surface and its layout.
struct HTML_options
{
  // The title of the page.
  std::string title = "Layout";
  // Names and values, listed beside the pictures.
  std::vector<std::pair<std::string, std::string> > figures;
  // The symmetry n of a seamless layout (see `Tiling`): the pattern then fits its lattice, and continues across its seams. Otherwise 0.
  int symmetry = 0;
  // What is shown at first: "pattern", "u", "area" or "quasi-conformal".
  std::string mode = "pattern";
  // By position in edges(tm): edges that are not drawn. Empty: there are none.
  std::vector<bool> hidden_edges;
  // Circles that are drawn in the layout, each by its centre and its radius.
  std::vector<std::array<double, 3> > circles;
  // Instead of a layout, by position in vertices(tm): points of unit spheres, whose centres are (i d, j d, 0) with whole numbers i, j. The layout
  // given then has the triangles between the points, each laid out by itself. Empty: there is a layout.
  std::vector<std::array<double, 3> > points_of_spheres;
  double distance_of_spheres = 0; // d
  // By position in faces(tm) and vertices(tm): the numbers that they are called by. Empty: their positions.
  std::vector<std::uint32_t> face_numbers, vertex_numbers;
};

// The numbers of the page, as JSON. What is not finite becomes null.
class JSON_line
{
  Text_buffer& out_;
  bool is_first_ = true;

  void begin() { if(! is_first_) out_ << ','; is_first_ = false; }

public:
  explicit JSON_line(Text_buffer& out) : out_(out) {}

  JSON_line& name(const char* key) { begin(); out_ << '"' << key << "\":"; is_first_ = true; return *this; }
  JSON_line& open(char bracket)    { begin(); out_ << bracket; is_first_ = true; return *this; }
  JSON_line& close(char bracket)   { out_ << bracket; is_first_ = false; return *this; }
  JSON_line& text(const std::string& s) { begin(); out_ << '"' << s << '"'; return *this; } // `s` has nothing to be escaped
  template <typename Number>
  JSON_line& number(Number x)
  {
    begin();
    if(std::isfinite(static_cast<double>(x)))
      out_ << x;
    else
      out_ << "null";
    return *this;
  }
  template <typename Numbers>
  JSON_line& numbers(const Numbers& values)
  {
    open('[');
    for(auto x : values)
      number(x);
    return close(']');
  }
};

inline void write_page_numbers(Text_buffer& out, const Page_data& data, const HTML_options& options)
{
  JSON_line json(out);
  json.open('{');
  json.name("symmetry").number(options.symmetry);
  json.name("mode").text(options.mode);
  json.name("centre").numbers(data.layout_centre);
  json.name("distanceOfSpheres").number(options.points_of_spheres.empty() ? 0 : options.distance_of_spheres); // 0: there are none
  json.name("radius").number(data.layout_radius);
  json.name("surfaceCentre").numbers(data.surface_centre);
  json.name("surfaceRadius").number(data.surface_radius);
  json.name("areaRange").numbers(data.area_factor.range());
  json.name("factorRange").numbers(data.quasi_conformal_factor.range());
  json.name("circles").open('[');
  for(const std::array<double, 3>& c : options.circles)
    json.numbers(c);
  json.close(']');
  json.name("cones").open('[');
  for(const Page_data::Cone& cone : data.cones)
  {
    json.open('{');
    json.name("angle").number(cone.angle / CGAL_PI * 180);
    json.name("vertex").number(cone.vertex < options.vertex_numbers.size() ? options.vertex_numbers[cone.vertex] : cone.vertex);
    json.name("corners").numbers(cone.corners).close('}');
  }
  json.close(']');
  json.name("seamColors").open('[');
  for(std::size_t i = 0; i < data.number_of_seams; ++i)
    json.text(hexadecimal(distinct_color(i)));
  json.close(']');
  json.name("scale").open('['); // that of drawings
  for(std::size_t i = 0; i <= 8; ++i)
    json.text(hexadecimal(sequential_color(double(i) / 8)));
  json.close(']').close('}');
}

template <typename T>
void write_page_array(Text_buffer& out, const char* name, const std::vector<T>& values)
{
  out << "<script type=\"text/plain\" id=\"data-" << name << "\">";
  write_base64(out, reinterpret_cast<const unsigned char*>(values.data()), values.size() * sizeof(T));
  out << "</script>\n";
}

inline void write_page_data(Text_buffer& out, const Page_data& data, const HTML_options& options)
{
  out << "<script type=\"application/json\" id=\"data-numbers\">";
  write_page_numbers(out, data, options);
  out << "</script>\n";
  write_page_array(out, "points", data.points);
  write_page_array(out, "layout", data.layout);
  write_page_array(out, "weights", data.weights);
  write_page_array(out, "u", data.u);
  write_page_array(out, "triangles", data.triangles);
  write_page_array(out, "area-factors", data.area_factor.codes());
  write_page_array(out, "quasi-conformal-factors", data.quasi_conformal_factor.codes());
  write_page_array(out, "hidden-edges", data.hidden_edges);
  write_page_array(out, "seams", data.seams);
  write_page_array(out, "border", data.border);
  write_page_array(out, "face-numbers", options.face_numbers);
}

// Writes a page that shows the mesh in space and its layout. The page holds everything it needs: 0.6 MB, and 75 bytes a vertex. `tm` and
// `uv` are those of `write_SVG()`; `u` has the logarithmic scale factors of the vertices.
//
// Named parameters: `vertex_point_map`, the points of the vertices; `projective_weight_map`, weights for projective interpolation
// (section 3.4 of the paper) in each triangle, the largest 1 (none: linear interpolation).
//
// Returns `true` iff the stream is good after writing. Takes linear time. The machine's numbers must be little-endian, as those
// of the browser are.
template <typename TriangleMesh, typename HalfedgeUVMap, typename VertexScalarMap,
          typename NamedParameters = CGAL::parameters::Default_named_parameters>
bool write_HTML(std::ostream& out, const TriangleMesh& tm, HalfedgeUVMap uv, VertexScalarMap u,
                const HTML_options& options = HTML_options(),
                const NamedParameters& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;

  const auto vpm = choose_parameter(get_parameter(np, CGAL::internal_np::vertex_point),
                                    CGAL::get_const_property_map(CGAL::vertex_point, tm));
  const auto weights = get_parameter(np, CGAL::internal_np::conformal_weight);
  const Page_data data(tm, uv, u, vpm, weights, options.hidden_edges, options.points_of_spheres);
  {
    Text_buffer buffer(out);
    for(const std::string_view piece : page_template())
      if(piece == "<!--TITLE-->")
        buffer << escaped_for_xml(options.title);
      else if(piece == "<!--FIGURES-->")
        for(const auto& figure : options.figures)
          buffer << "<tr><td>" << escaped_for_xml(figure.first) << "</td><td>" << escaped_for_xml(figure.second) << "</td></tr>\n";
      else if(piece == "<!--DATA-->")
        write_page_data(buffer, data, options);
      else
        buffer.append(piece.data(), piece.size());
  }
  out.flush();
  return out.good();
}

} // namespace flattening

#endif // FLATTEN_MESH_WRITE_HTML_H
