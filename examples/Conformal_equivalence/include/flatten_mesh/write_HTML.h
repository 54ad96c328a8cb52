// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// One page that shows the surface in space with a checkerboard carried over from its
// layout, the layout beside it, and figures. The page asks for nothing from
// anywhere; the checkerboard is interpolated projectively (section 3.4 of the
// paper) where weights are given.

#ifndef FLATTEN_MESH_WRITE_HTML_H
#define FLATTEN_MESH_WRITE_HTML_H

#include "layout_outline.h"
#include "page_text.h"
#include "write_SVG.h"

#include <CGAL/Conformal_equivalence/internal/IO/corner_values.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/named_params_helper.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace flattening {

// What `write_HTML()` shows beside the surface and its layout.
struct HTML_options
{
  // The title of the page.
  std::string title = "Layout";
  // Names and values, listed under the pictures.
  std::vector<std::pair<std::string, std::string> > figures;
  // How the layout is drawn.
  SVG_options svg;
};

// What goes to the graphics card, for each distinct corner value: place in space,
// scaled into the unit ball, and homogeneous texture coordinates in squares.
struct HTML_geometry
{
  std::vector<float> points, texture;
  std::vector<std::uint32_t> triangles;
};

template <typename TriangleMesh, typename HalfedgeUVMap, typename VertexPointMap, typename WeightMap>
HTML_geometry html_geometry(const TriangleMesh& tm, const HalfedgeUVMap& uv, const VertexPointMap& vpm,
                            const WeightMap& weights, double square)
{
  HTML_geometry geometry;
  auto number = get(CGAL::dynamic_halfedge_property_t<std::size_t>(), tm);
  const auto corners = CGAL::Conformal_equivalence::internal::number_corner_values(tm, uv, number);

  std::array<Finite_range, 3> box;
  const auto coordinates = [&](auto h) -> std::array<double, 3>
  {
    const auto& p = get(vpm, target(h, tm));
    return {{ CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()) }};
  };
  for(auto h : corners)
    for(std::size_t k = 0; k < 3; ++k)
      box[k].insert(coordinates(h)[k]);
  double longest = 0;
  for(const Finite_range& r : box)
    longest = (std::max)(longest, r.upper - r.lower);

  // the checkerboard begins near the layout, to keep its coordinates short
  const std::array<double, 2> origin = corners.empty() ? std::array<double, 2>{{0, 0}} : corner_value(uv, corners.front());
  for(auto h : corners)
  {
    const std::array<double, 3> p = coordinates(h);
    for(std::size_t k = 0; k < 3; ++k)
      geometry.points.push_back(static_cast<float>(
        longest > 0 ? 2 * ((p[k] - box[k].lower) - (box[k].upper - box[k].lower) / 2) / longest : 0.));
    double w = 1;
    if constexpr(! std::is_same<WeightMap, CGAL::internal_np::Param_not_found>::value)
      w = CGAL::to_double(get(weights, target(h, tm)));
    const std::array<double, 2> q = corner_value(uv, h);
    for(std::size_t k = 0; k < 2; ++k)
    {
      const double first = 2 * std::floor(origin[k] / (2 * square)) * square;
      geometry.texture.push_back(static_cast<float>((q[k] - first) / square * w));
    }
    geometry.texture.push_back(static_cast<float>(w));
  }
  for(auto f : faces(tm))
    for(auto h : CGAL::halfedges_around_face(halfedge(f, tm), tm))
      geometry.triangles.push_back(static_cast<std::uint32_t>(get(number, h)));
  return geometry;
}

template <typename T>
void write_html_array(Text_buffer& out, const char* name, const std::vector<T>& values)
{
  out << "const " << name << " = bytes(\"";
  write_base64(out, reinterpret_cast<const unsigned char*>(values.data()), values.size() * sizeof(T));
  out << "\");\n";
}

inline const char* html_head()
{
  return R"html(<style>
body { font-family: sans-serif; margin: 1.5em; color: #222; }
main { display: flex; flex-wrap: wrap; gap: 1.5em; align-items: flex-start; }
canvas, svg { width: 46vw; min-width: 320px; max-height: 80vh; background: #fafaf7; border: 1px solid #ddd; }
canvas { height: 80vh; cursor: grab; touch-action: none; }
table { border-collapse: collapse; margin-top: 1em; } td { padding: .15em 1em .15em 0; } td + td { font-variant-numeric: tabular-nums; }
</style>
)html";
}

// Turns with the mouse, comes nearer with the wheel. The derivative of the place
// gives the normal of the triangle.
inline const char* html_script()
{
  return R"html(
function bytes(text)
{
  const s = atob(text), b = new Uint8Array(s.length);
  for(let i = 0; i < s.length; ++i) b[i] = s.charCodeAt(i);
  return b.buffer;
}
const canvas = document.getElementById("surface"), gl = canvas.getContext("webgl");
if(gl && gl.getExtension("OES_element_index_uint") && gl.getExtension("OES_standard_derivatives")) start();
else document.getElementById("note").textContent = "This browser shows no WebGL.";
function shader(type, source) { const s = gl.createShader(type); gl.shaderSource(s, source); gl.compileShader(s); return s; }
function attribute(program, name, values) {
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer()); gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
  const a = gl.getAttribLocation(program, name); gl.enableVertexAttribArray(a); gl.vertexAttribPointer(a, 3, gl.FLOAT, false, 0, 0); }
function start() {
  const program = gl.createProgram();
  gl.attachShader(program, shader(gl.VERTEX_SHADER, `attribute vec3 place, board; uniform mat3 turn; uniform vec2 zoom;
    varying vec3 p; varying highp vec3 t;
    void main() { p = turn * place; t = board; gl_Position = vec4(p.xy * zoom, -p.z * .2, 1.); }`));
  gl.attachShader(program, shader(gl.FRAGMENT_SHADER, `#extension GL_OES_standard_derivatives : enable
    precision highp float; varying vec3 p; varying highp vec3 t;
    void main() { vec3 n = normalize(cross(dFdx(p), dFdy(p))); vec2 q = t.xy / t.z;
      vec2 d = abs(fract(q * .5) * 2. - 1.) - .5; vec2 s = clamp(d / max(fwidth(q), 1e-5) + .5, 0., 1.);
      float c = s.x * (1. - s.y) + s.y * (1. - s.x);
      vec3 color = mix(vec3(.96, .96, .94), vec3(.27, .43, .63), c);
      gl_FragColor = vec4(color * (.35 + .65 * abs(n.z)), 1.); }`));
  gl.linkProgram(program); gl.useProgram(program);
  attribute(program, "place", new Float32Array(points)); attribute(program, "board", new Float32Array(texture));
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  const indices = new Uint32Array(triangles); gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
  gl.enable(gl.DEPTH_TEST); gl.clearColor(.98, .98, .97, 1.);
  let turn = [1, 0, 0, 0, 1, 0, 0, 0, 1], zoom = .8, last = null;
  function times(a, b)
  {
    const c = [];
    for(let j = 0; j < 3; ++j) for(let i = 0; i < 3; ++i) c[3*j+i] = a[i]*b[3*j] + a[3+i]*b[3*j+1] + a[6+i]*b[3*j+2];
    return c;
  }
  function draw() {
    canvas.width = canvas.clientWidth; canvas.height = canvas.clientHeight; gl.viewport(0, 0, canvas.width, canvas.height);
    const side = Math.min(canvas.width, canvas.height);
    gl.uniformMatrix3fv(gl.getUniformLocation(program, "turn"), false, turn);
    gl.uniform2f(gl.getUniformLocation(program, "zoom"), zoom * side / canvas.width, zoom * side / canvas.height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT); gl.drawElements(gl.TRIANGLES, indices.length, gl.UNSIGNED_INT, 0); }
  canvas.onpointerdown = e => { last = [e.clientX, e.clientY]; canvas.setPointerCapture(e.pointerId); };
  canvas.onpointerup = () => { last = null; };
  canvas.onpointermove = e => { if(!last) return;
    const x = (e.clientX - last[0]) * .01, y = (e.clientY - last[1]) * .01; last = [e.clientX, e.clientY];
    const cx = Math.cos(x), sx = Math.sin(x), cy = Math.cos(y), sy = Math.sin(y);
    turn = times([1, 0, 0, 0, cy, sy, 0, -sy, cy], times([cx, 0, -sx, 0, 1, 0, sx, 0, cx], turn)); draw(); };
  canvas.onwheel = e => { e.preventDefault(); zoom *= Math.exp(-e.deltaY * .001); draw(); };
  window.onresize = draw; draw();
}
)html";
}

// Writes a page that shows the mesh in space with a checkerboard carried over from the layout, to be turned with the mouse, the
// drawing of `write_SVG()` beside it, and a table of figures. The page holds everything it needs. It takes about 60 bytes a
// vertex beside the drawing. `tm`, `uv` and `scalar` are those of `write_SVG()`.
//
// Named parameters: `vertex_point_map`, the points of the vertices; `projective_weight_map`, weights for projective interpolation
// in each triangle, the largest 1 (none: linear interpolation).
//
// Returns `true` iff the stream is good after writing. Takes linear time. The machine's numbers must be little-endian, as those
// of the browser are.
template <typename TriangleMesh, typename HalfedgeUVMap, typename FaceScalarMap,
          typename NamedParameters = CGAL::parameters::Default_named_parameters>
bool write_HTML(std::ostream& out, const TriangleMesh& tm, HalfedgeUVMap uv, FaceScalarMap scalar,
                const HTML_options& options = HTML_options(),
                const NamedParameters& np = CGAL::parameters::default_values())
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;

  const auto vpm = choose_parameter(get_parameter(np, CGAL::internal_np::vertex_point),
                                    CGAL::get_const_property_map(CGAL::vertex_point, tm));
  const auto weights = get_parameter(np, CGAL::internal_np::conformal_weight);
  {
    Text_buffer buffer(out);
    const SVG_writer<TriangleMesh, HalfedgeUVMap, FaceScalarMap> drawing(tm, uv, scalar, options.svg);
    const std::string title = escaped_for_xml(options.title);
    buffer << "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" << title << "</title>\n"
           << html_head() << "</head><body>\n<h1>" << title << "</h1>\n<main><canvas id=\"surface\"></canvas>\n";
    drawing.write(buffer);
    buffer << "</main><p id=\"note\"></p>\n<table>\n";
    for(const auto& figure : options.figures)
      buffer << "<tr><td>" << escaped_for_xml(figure.first) << "</td><td>"
             << escaped_for_xml(figure.second) << "</td></tr>\n";
    buffer << "</table>\n<script>\n";
    {
      const HTML_geometry geometry = html_geometry(tm, uv, vpm, weights, drawing.square());
      write_html_array(buffer, "points", geometry.points);
      write_html_array(buffer, "texture", geometry.texture);
      write_html_array(buffer, "triangles", geometry.triangles);
    }
    buffer << html_script() << "</script></body></html>\n";
  }
  out.flush();
  return out.good();
}

} // namespace flattening

#endif // FLATTEN_MESH_WRITE_HTML_H
