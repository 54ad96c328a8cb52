// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/layout_files.h"
#include "../include/flatten_mesh/Binary_text.h"
#include "../include/flatten_mesh/layout_outline.h"
#include "../include/flatten_mesh/Written_faces.h"

#include <CGAL/Polygon_mesh_processing/connected_components.h>

#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace flattening {

namespace {

// The number of the chart of each face of the mesh: charts are counted in the order of their first faces.
std::vector<std::uint32_t> charts(const Split_surface& surface)
{
  const Mesh& mesh = surface.mesh();
  const auto ends_chart = boost::make_function_property_map<Mesh::Edge_index>([&](Mesh::Edge_index e)
  {
    const Halfedge h = mesh.halfedge(e);
    return ! surface.is_on_sphere() && is_outline(mesh, surface.result().uv, mesh.is_border(h) ? mesh.opposite(h) : h);
  });
  std::vector<std::uint32_t> chart(mesh.number_of_faces());
  CGAL::Polygon_mesh_processing::connected_components(mesh, boost::make_iterator_property_map(chart.begin(), get(CGAL::face_index, mesh)),
                                                      CGAL::parameters::edge_is_constrained_map(ends_chart));
  return chart;
}

// Blocks of bytes on their way to a stream.
class Byte_stream
{
public:
  explicit Byte_stream(std::ostream& out) : out_(out) {}
  ~Byte_stream() { flush(); }
  Byte_stream(const Byte_stream&) = delete;
  Byte_stream& operator=(const Byte_stream&) = delete;

  template <typename Number>
  void append(Number x)
  {
    if(bytes_.size() > (1 << 16))
      flush();
    append_little_endian(bytes_, x);
  }
  void append_byte(std::size_t x) { bytes_ += static_cast<char>(static_cast<unsigned char>(x)); }

private:
  void flush()
  {
    out_.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
    bytes_.clear();
  }

  std::ostream& out_;
  std::string bytes_;
};

const std::size_t most_corners_in_a_byte = 255;

std::size_t largest_number_of_corners(const Written_faces& faces)
{
  std::size_t largest = 0;
  std::vector<Halfedge> corners;
  for(std::size_t f = 0; f < faces.size(); ++f)
  {
    faces.get_corners(f, corners);
    largest = (std::max)(largest, corners.size());
  }
  return largest;
}

void write_header(std::ostream& out, const Split_surface& surface, std::size_t number_of_faces, bool has_large_faces, bool has_colors)
{
  out << "ply\nformat binary_little_endian 1.0\ncomment s, t: the layout; log_scale_factor: u; weight: exp(-u), the largest 1\n"
      << "element vertex " << std::to_string(surface.corners().size()) << "\nproperty double x\nproperty double y\nproperty double z\n"
      << (surface.is_on_sphere() ? "" : "property double s\nproperty double t\n")
      << (has_colors ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "")
      << "property double log_scale_factor\nproperty double weight\nproperty uint vertex\n"
      << "element face " << std::to_string(number_of_faces) << "\nproperty list " << (has_large_faces ? "uint" : "uchar")
      << " uint vertex_indices\nproperty uint chart\nend_header\n";
}

// That of the vertex of the file, white if it has none.
void append_color(const std::vector<std::optional<std::array<double, 3> > >& colors, std::size_t v, Byte_stream& bytes)
{
  const double full = 255;
  for(double x : v < colors.size() && colors[v] ? *colors[v] : std::array<double, 3>{{1, 1, 1}})
    bytes.append_byte(static_cast<std::size_t>(std::lround(full * (x > 0 ? (std::min)(x, 1.) : 0.))));
}

} // namespace

bool write_PLY(std::ostream& out, const Given_surface& given, const Split_surface& surface)
{
  const Result& result = surface.result();
  const Written_faces faces(given, result);
  const bool has_large_faces = largest_number_of_corners(faces) > most_corners_in_a_byte;
  const std::vector<std::uint32_t> chart = charts(surface);
  const auto& colors = given.attributes.colors;
  const bool has_colors = ! colors.empty() && result.given_face.empty();
  write_header(out, surface, faces.size(), has_large_faces, has_colors);
  {
    Byte_stream bytes(out);
    const UV_map& uv = result.lattice_uv ? *result.lattice_uv : result.uv;
    for(Halfedge h : surface.corners())
    {
      const Vertex v = result.mesh.target(h);
      for(double x : surface.point(h))
        bytes.append(x);
      if(! surface.is_on_sphere())
      {
        bytes.append(uv[h].x());
        bytes.append(uv[h].y());
      }
      if(has_colors)
        append_color(colors, given.vertex(v), bytes);
      bytes.append(result.u[v]);
      bytes.append(result.weight[v]);
      bytes.append(static_cast<std::uint32_t>(faces.are_of_file() ? given.vertex(v) : v.idx()));
    }
    std::vector<Halfedge> corners;
    for(std::size_t f = 0; f < faces.size(); ++f)
    {
      faces.get_corners(f, corners);
      if(has_large_faces)
        bytes.append(static_cast<std::uint32_t>(corners.size()));
      else
        bytes.append_byte(corners.size());
      for(Halfedge h : corners)
        bytes.append(static_cast<std::uint32_t>(surface.number(h)));
      bytes.append(chart[result.mesh.face(corners.front()).idx()]);
    }
  }
  out.flush();
  return out.good();
}

} // namespace flattening
