// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/layout_files.h"
#include "../include/flatten_mesh/Binary_text.h"
#include "../include/flatten_mesh/color_scale.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/page_text.h"
#include "../include/flatten_mesh/PNG.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <vector>

namespace flattening {

namespace {

// Text as it is made by a function of a `Text_buffer`.
template <typename Write>
std::string written(Write write)
{
  std::ostringstream out;
  {
    Text_buffer buffer(out);
    write(buffer);
  }
  return out.str();
}

void add_to_list(std::string& list, const std::string& item)
{
  list += (list.empty() ? "" : ",\n  ") + item;
}

// The two chunks of the file: what is in the buffer, and the JSON that says what it is.
class GLB_builder
{
public:
  GLB_builder(const std::string& name, std::size_t number_of_vertices) : name_(name), number_of_vertices_(number_of_vertices) {}

  void add_triangles(const Split_surface& surface)
  {
    const std::size_t begin = bytes_.size();
    std::size_t n = 0;
    for(Face f : surface.mesh().faces())
      for(Halfedge h : surface.mesh().halfedges_around_face(surface.mesh().halfedge(f)))
      {
        append_little_endian(bytes_, static_cast<std::uint32_t>(surface.number(h)));
        ++n;
      }
    add_view(begin, 34963); // ELEMENT_ARRAY_BUFFER
    add_to_list(accessors_, written([&](Text_buffer& out)
    {
      out << "{\"bufferView\":" << number_of_views_ - 1 << ",\"componentType\":5125,\"count\":" << n << ",\"type\":\"SCALAR\"}";
    }));
    indices_ = number_of_accessors_++;
  }

  // `value(i)` are the components of vertex `i`.
  template <std::size_t N, typename Value>
  void add_attribute(const char* attribute, const char* type, Value value)
  {
    const std::size_t begin = bytes_.size();
    std::array<Finite_range, N> range;
    for(std::size_t i = 0; i < number_of_vertices_; ++i)
    {
      const std::array<double, N> x = value(i);
      for(std::size_t k = 0; k < N; ++k)
      {
        const float rounded = single(x[k]);
        append_little_endian(bytes_, rounded);
        range[k].insert(rounded);
      }
    }
    add_view(begin, 34962); // ARRAY_BUFFER
    add_to_list(accessors_, written([&](Text_buffer& out)
    {
      out << "{\"bufferView\":" << number_of_views_ - 1 << ",\"componentType\":5126,\"count\":" << number_of_vertices_
          << ",\"type\":\"" << type << '"';
      write_numbers(out, ",\"min\":", range, [](const Finite_range& r) { return r.lower; });
      write_numbers(out, ",\"max\":", range, [](const Finite_range& r) { return r.upper; });
      out << '}';
    }));
    add_to_list(attributes_, written([&](Text_buffer& out) { out << '"' << attribute << "\":" << number_of_accessors_; }));
    ++number_of_accessors_;
  }

  void add_texture(const Palette_image& image)
  {
    const std::size_t begin = bytes_.size();
    bytes_ += png_file(image);
    add_view(begin, 0);
    image_ = number_of_views_ - 1;
    while(bytes_.size() % 4 != 0)
      bytes_ += '\0';
  }

  void write(std::ostream& out) const
  {
    std::string json = this->json();
    while(json.size() % 4 != 0)
      json += ' ';
    const std::uint64_t size = 12 + 8 + std::uint64_t(json.size()) + 8 + bytes_.size();
    if(size > std::numeric_limits<std::uint32_t>::max())
      fail("cannot write ", name_, ": a GLB file has less than 2^32 bytes");
    std::string header = "glTF";
    for(std::uint32_t x : {std::uint32_t(2), static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(json.size())})
      append_little_endian(header, x);
    header += "JSON";
    std::string second;
    append_little_endian(second, static_cast<std::uint32_t>(bytes_.size()));
    second += std::string("BIN\0", 4);
    out << header << json << second << bytes_;
  }

private:
  float single(double x) const
  {
    if(! (std::abs(x) <= double(std::numeric_limits<float>::max())))
      fail("cannot write ", name_, ": the number ", x, " is beyond single precision, which GLB files have");
    return static_cast<float>(x);
  }

  void add_view(std::size_t begin, int target)
  {
    add_to_list(views_, written([&](Text_buffer& out)
    {
      out << "{\"buffer\":0,\"byteOffset\":" << begin << ",\"byteLength\":" << bytes_.size() - begin;
      if(target != 0)
        out << ",\"target\":" << target;
      out << '}';
    }));
    ++number_of_views_;
  }

  // A float is exact as a double.
  template <std::size_t N, typename Bound>
  static void write_numbers(Text_buffer& out, const char* key, const std::array<Finite_range, N>& range, Bound bound)
  {
    out << key;
    for(std::size_t k = 0; k < N; ++k)
      out << (k == 0 ? '[' : ',') << bound(range[k]);
    out << ']';
  }

  std::string json() const
  {
    return written([&](Text_buffer& out)
    {
      out << "{\"asset\":{\"version\":\"2.0\",\"generator\":\"flatten_mesh\"},\n\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
             "\"nodes\":[{\"name\":\"layout\",\"mesh\":0}],\n\"meshes\":[{\"name\":\"layout\",\"primitives\":[{\"attributes\":{"
          << attributes_ << "},\"indices\":" << indices_ << ",\"material\":0}]}],\n"
          << "\"materials\":[{\"name\":\"layout\",\"doubleSided\":true,\"pbrMetallicRoughness\":{"
          << (image_ ? "\"baseColorTexture\":{\"index\":0}," : "") << "\"metallicFactor\":0,\"roughnessFactor\":1}}],\n";
      if(image_)
        out << "\"textures\":[{\"sampler\":0,\"source\":0}],\"samplers\":[{\"magFilter\":9729,\"minFilter\":9987,\"wrapS\":10497,\"wrapT\":10497}],"
               "\"images\":[{\"mimeType\":\"image/png\",\"bufferView\":" << *image_ << "}],\n";
      out << "\"accessors\":[" << accessors_ << "],\n\"bufferViews\":[" << views_ << "],\n\"buffers\":[{\"byteLength\":" << bytes_.size() << "}]}";
    });
  }

  std::string name_;
  std::size_t number_of_vertices_, number_of_views_ = 0, number_of_accessors_ = 0, indices_ = 0;
  std::optional<std::size_t> image_; // its view
  std::string bytes_, views_, accessors_, attributes_;
};

// Colours of files are meant for screens (sRGB), those of glTF are linear.
double linear_light(double x)
{
  x = (std::min)((std::max)(x, 0.), 1.);
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

std::array<double, 2> texture_coordinates(const Kernel::Point_2& p, const Texture_of_layout& texture)
{
  switch(texture.pattern)
  {
    case Pattern::CHECKERBOARD:
      return {{ p.x() * texture.repetitions, 1 - p.y() * texture.repetitions }};
    case Pattern::HEXAGON_TILES:
    {
      const double b = p.y() / (std::sqrt(3.) / 2);
      return {{ p.x() - b / 2, 1 - b }};
    }
    default:
      return {{ p.x(), 1 - p.y() }};
  }
}

void add_colors(const Given_surface& given, const Split_surface& surface, GLB_builder& glb)
{
  const auto& colors = given.attributes.colors;
  if(colors.empty() || ! surface.result().given_face.empty())
    return; // or they are not those of the mesh that is written
  glb.add_attribute<3>("COLOR_0", "VEC3", [&](std::size_t i)
  {
    const std::size_t v = given.vertex(surface.mesh().target(surface.corners()[i]));
    std::array<double, 3> color{{1, 1, 1}};
    if(v < colors.size() && colors[v])
      for(std::size_t k = 0; k < 3; ++k)
        color[k] = linear_light((*colors[v])[k]);
    return color;
  });
}

} // namespace

bool write_GLB(std::ostream& out, const Given_surface& given, const Split_surface& surface, const Texture_of_layout& texture, bool has_weights,
               const std::string& name)
{
  const Result& result = surface.result();
  const std::vector<Halfedge>& corners = surface.corners();
  GLB_builder glb(name, corners.size());
  glb.add_triangles(surface);
  glb.add_attribute<3>("POSITION", "VEC3", [&](std::size_t i) { return surface.point(corners[i]); });
  if(! surface.is_on_sphere())
    glb.add_attribute<2>("TEXCOORD_0", "VEC2", [&](std::size_t i) { return texture_coordinates(result.uv[corners[i]], texture); });
  if(has_weights)
    glb.add_attribute<1>("_WEIGHT", "SCALAR", [&](std::size_t i)
    {
      return std::array<double, 1>{{ result.weight[result.mesh.target(corners[i])] }};
    });
  add_colors(given, surface, glb);
  if(! surface.is_on_sphere())
    glb.add_texture(texture_image(texture.pattern));
  glb.write(out);
  out.flush();
  return out.good();
}

} // namespace flattening
