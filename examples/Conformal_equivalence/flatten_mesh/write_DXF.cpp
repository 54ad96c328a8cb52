// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/layout_files.h"
#include "../include/flatten_mesh/layout_outline.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/page_text.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace flattening {

namespace {

class DXF_writer
{
  typedef std::array<double, 2> Point;

public:
  DXF_writer(const Result& result, double scale) : mesh_(result.mesh), uv_(result.uv), scale_(scale) {}

  void write(Text_buffer& out) const
  {
    write_header(out);
    write_layers(out);
    out << "0\nSECTION\n2\nENTITIES\n";
    std::vector<bool> is_done(mesh_.number_of_halfedges(), false);
    for(Halfedge h : mesh_.halfedges())
      if(! mesh_.is_border(h) && ! is_done[h.idx()] && is_outline(mesh_, uv_, h))
        write_curve(out, closed_curve(h, is_done));
    out << "0\nENDSEC\n0\nEOF\n";
  }

private:
  // The end of the halfedge.
  Point place(Halfedge h) const { return {{ uv_[h].x() * scale_, uv_[h].y() * scale_ }}; }

  const char* layer(Halfedge h) const { return mesh_.is_border(mesh_.opposite(h)) ? "OUTLINE" : "CUTS"; }

  std::vector<Halfedge> closed_curve(Halfedge first, std::vector<bool>& is_done) const
  {
    std::vector<Halfedge> curve;
    Halfedge h = first;
    do
    {
      is_done[h.idx()] = true;
      curve.push_back(h);
      h = next_on_outline(mesh_, uv_, h);
    }
    while(h != first);
    return curve;
  }

  // The parts of the curve that are in one layer, from the first change of layers on.
  void write_curve(Text_buffer& out, const std::vector<Halfedge>& curve) const
  {
    const std::size_t n = curve.size();
    const auto begins = [&](std::size_t i) { return layer(curve[i % n]) != std::string(layer(curve[(i + n - 1) % n])); };
    std::size_t first = 0;
    while(first < n && ! begins(first))
      ++first;
    if(first == n)
      return write_polyline(out, curve, true);
    std::vector<Halfedge> part;
    for(std::size_t i = first; i < first + n; ++i)
    {
      part.push_back(curve[i % n]);
      if(begins(i + 1))
      {
        write_polyline(out, part, false);
        part.clear();
      }
    }
  }

  void write_polyline(Text_buffer& out, const std::vector<Halfedge>& path, bool is_closed) const
  {
    const char* const name = layer(path.front());
    out << "0\nPOLYLINE\n8\n" << name << "\n66\n1\n10\n0.0\n20\n0.0\n30\n0.0\n70\n" << (is_closed ? 1 : 0) << '\n';
    if(! is_closed)
      write_vertex(out, name, place(mesh_.prev(path.front())));
    for(Halfedge h : path)
      write_vertex(out, name, place(h));
    out << "0\nSEQEND\n8\n" << name << '\n';
  }

  static void write_vertex(Text_buffer& out, const char* layer, const Point& p)
  {
    out << "0\nVERTEX\n8\n" << layer << '\n';
    write_point(out, p);
  }

  static void write_point(Text_buffer& out, const Point& p) { out << "10\n" << p[0] << "\n20\n" << p[1] << "\n30\n0.0\n"; }

  void write_header(Text_buffer& out) const
  {
    const Layout_box box = layout_box(mesh_, uv_);
    out << "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$EXTMIN\n";
    write_point(out, {{ box.x.lower * scale_, box.y.lower * scale_ }});
    out << "9\n$EXTMAX\n";
    write_point(out, {{ box.x.upper * scale_, box.y.upper * scale_ }});
    out << "0\nENDSEC\n";
  }

  static void write_layers(Text_buffer& out)
  {
    const int black = 7, red = 1;
    out << "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLTYPE\n70\n1\n0\nLTYPE\n2\nCONTINUOUS\n70\n0\n3\nSolid line\n72\n65\n73\n0\n40\n0.0\n0\nENDTAB\n"
        << "0\nTABLE\n2\nLAYER\n70\n2\n";
    for(const auto& [name, color] : {std::make_pair("OUTLINE", black), std::make_pair("CUTS", red)})
      out << "0\nLAYER\n2\n" << name << "\n70\n0\n62\n" << color << "\n6\nCONTINUOUS\n";
    out << "0\nENDTAB\n0\nENDSEC\n";
  }

  const Mesh& mesh_;
  const UV_map& uv_;
  double scale_;
};

} // namespace

bool write_DXF(std::ostream& out, const Result& result, double scale, const std::string& name)
{
  for(Halfedge h : result.mesh.halfedges())
    if(! result.mesh.is_border(h))
      for(double x : corner_value(result.uv, h))
        if(! std::isfinite(x * scale))
          fail("cannot write ", name, ": the number ", x, " times ", scale, " is not finite");
  {
    Text_buffer buffer(out);
    DXF_writer(result, scale).write(buffer);
  }
  out.flush();
  return out.good();
}

} // namespace flattening
