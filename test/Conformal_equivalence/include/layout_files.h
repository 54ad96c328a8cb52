// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Reads the files that flatten_mesh writes for other programs, beside OBJ; shares no code with it.

#ifndef CONFORMAL_EQUIVALENCE_TEST_LAYOUT_FILES_H
#define CONFORMAL_EQUIVALENCE_TEST_LAYOUT_FILES_H

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
#  include <nlohmann/json.hpp>
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace checking {

// A number at this place of binary data, the lowest byte first, on a machine of that kind.
template <typename Number>
Number number_at(const std::string& bytes, std::size_t& at)
{
  Number x;
  if(bytes.size() < at + sizeof x)
    throw std::runtime_error("the file ends too early");
  std::memcpy(&x, bytes.data() + at, sizeof x);
  at += sizeof x;
  return x;
}

// Vertices with properties `double`, but for the last one, `uint vertex`; faces with a number.
struct Ply_file
{
  std::vector<std::string> names; // of the properties of vertices
  std::vector<std::string> types; // of these
  std::vector<std::map<std::string, double> > vertices;
  std::vector<std::vector<std::uint32_t> > faces;
  std::vector<std::uint32_t> charts;

  explicit Ply_file(const std::string& bytes)
  {
    const std::string end = "end_header\n";
    std::size_t at = bytes.find(end) + end.size(), number_of_vertices = 0, number_of_faces = 0;
    std::istringstream header(bytes.substr(0, at));
    bool is_vertex = false;
    for(std::string line; std::getline(header, line); )
    {
      std::istringstream words(line);
      std::string first, second, third;
      words >> first >> second >> third;
      if(first == "element")
        (second == "vertex" ? number_of_vertices : number_of_faces) = std::stoul(third);
      if(first == "element")
        is_vertex = second == "vertex";
      if(first != "property" || ! is_vertex)
        continue;
      names.push_back(third);
      types.push_back(second);
    }
    for(std::size_t i = 0; i < number_of_vertices; ++i)
    {
      vertices.emplace_back();
      for(std::size_t k = 0; k < names.size(); ++k)
        vertices.back()[names[k]] = types[k] == "uint"  ? number_at<std::uint32_t>(bytes, at)
                                  : types[k] == "uchar" ? number_at<unsigned char>(bytes, at)
                                                        : number_at<double>(bytes, at);
    }
    for(std::size_t f = 0; f < number_of_faces; ++f)
    {
      const std::size_t n = number_at<unsigned char>(bytes, at);
      faces.emplace_back();
      for(std::size_t k = 0; k < n; ++k)
        faces.back().push_back(number_at<std::uint32_t>(bytes, at));
      charts.push_back(number_at<std::uint32_t>(bytes, at));
    }
    if(at != bytes.size())
      throw std::runtime_error("the file does not end after its last face");
  }
};

// The polylines of each layer; a closed one repeats its first point.
struct Dxf_file
{
  typedef std::array<double, 2> Point;
  std::map<std::string, std::vector<std::vector<Point> > > layers;

  explicit Dxf_file(const std::string& text)
  {
    std::istringstream in(text);
    std::string code, value, entity, layer;
    std::vector<Point> points;
    bool is_closed = false, is_in_entities = false;
    while(std::getline(in, code) && std::getline(in, value))
    {
      if(code == "2" && value == "ENTITIES")
        is_in_entities = true;
      if(! is_in_entities)
        continue;
      if(code == "0")
      {
        entity = value;
        if(entity == "POLYLINE")
          points.clear();
        if(entity == "VERTEX")
          points.push_back({{ 0, 0 }});
        if(entity == "SEQEND" && is_closed)
          points.push_back(points.front());
        if(entity == "SEQEND")
          layers[layer].push_back(points);
      }
      else if(code == "8")
        layer = value;
      else if(code == "70" && entity == "POLYLINE")
        is_closed = value == "1";
      else if((code == "10" || code == "20") && entity == "VERTEX")
        points.back()[code == "20"] = std::stod(value);
    }
    if(value != "EOF")
      throw std::runtime_error("the file does not end");
  }

  // The segments of a layer, in their directions.
  std::multimap<Point, Point> segments(const std::string& layer) const
  {
    std::multimap<Point, Point> result;
    const auto found = layers.find(layer);
    if(found != layers.end())
      for(const std::vector<Point>& line : found->second)
        for(std::size_t i = 1; i < line.size(); ++i)
          result.emplace(line[i - 1], line[i]);
    return result;
  }
};

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
// The arrays of the only primitive, checked against what the specification of glTF 2.0 asks of them.
struct Glb_file
{
  nlohmann::json json;
  std::vector<std::uint32_t> indices;
  std::map<std::string, std::vector<std::vector<float> > > attributes;
  std::string image;

  explicit Glb_file(const std::string& bytes)
  {
    std::size_t at = 0;
    require(bytes.substr(0, 4) == "glTF", "magic");
    at = 4;
    require(number_at<std::uint32_t>(bytes, at) == 2, "version");
    require(number_at<std::uint32_t>(bytes, at) == bytes.size(), "length");
    const std::size_t json_size = number_at<std::uint32_t>(bytes, at);
    require(json_size % 4 == 0 && bytes.substr(at, 4) == "JSON", "first chunk");
    json = nlohmann::json::parse(bytes.substr(at + 4, json_size));
    at += 4 + json_size;
    const std::size_t size = number_at<std::uint32_t>(bytes, at);
    require(size % 4 == 0 && bytes.substr(at, 4) == std::string("BIN\0", 4), "second chunk");
    const std::string buffer = bytes.substr(at + 4);
    require(buffer.size() == size && json["buffers"].size() == 1 && json["buffers"][0]["byteLength"] == size, "buffer");
    require(json["asset"]["version"] == "2.0" && json["meshes"].size() == 1 && json["meshes"][0]["primitives"].size() == 1, "mesh");
    const nlohmann::json primitive = json["meshes"][0]["primitives"][0];
    require(primitive.value("mode", 4) == 4, "triangles");
    read_indices(buffer, json["accessors"][primitive["indices"].get<std::size_t>()]);
    for(const auto& attribute : primitive["attributes"].items())
      read_attribute(buffer, json["accessors"][attribute.value().get<std::size_t>()], attributes[attribute.key()]);
    for(const auto& attribute : attributes)
      require(attribute.second.size() == attributes["POSITION"].size(), "counts");
    for(std::uint32_t i : indices)
      require(i < attributes["POSITION"].size(), "indices");
    if(json.contains("images"))
      image = view(buffer, json["images"][0]["bufferView"].get<std::size_t>());
  }

private:
  static void require(bool is_good, const char* what)
  {
    if(! is_good)
      throw std::runtime_error(std::string("GLB: ") + what);
  }

  std::string view(const std::string& buffer, std::size_t i) const
  {
    const nlohmann::json v = json["bufferViews"][i];
    const std::size_t begin = v["byteOffset"], size = v["byteLength"];
    require(begin % 4 == 0 && begin + size <= buffer.size() && ! v.contains("byteStride"), "view");
    return buffer.substr(begin, size);
  }

  void read_indices(const std::string& buffer, const nlohmann::json& accessor)
  {
    const std::string bytes = view(buffer, accessor["bufferView"]);
    require(accessor["componentType"] == 5125 && accessor["type"] == "SCALAR" && accessor["count"].get<std::size_t>() * 4 == bytes.size(), "indices");
    for(std::size_t at = 0; at < bytes.size(); )
      indices.push_back(number_at<std::uint32_t>(bytes, at));
  }

  void read_attribute(const std::string& buffer, const nlohmann::json& accessor, std::vector<std::vector<float> >& values)
  {
    const std::string bytes = view(buffer, accessor["bufferView"]), type = accessor["type"];
    const std::size_t n = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
    require(accessor["componentType"] == 5126 && accessor["count"].get<std::size_t>() * 4 * n == bytes.size(), "attribute");
    std::vector<float> least, largest;
    for(std::size_t at = 0; at < bytes.size(); )
    {
      values.emplace_back();
      for(std::size_t k = 0; k < n; ++k)
        values.back().push_back(number_at<float>(bytes, at));
      if(least.empty())
        least = largest = values.back();
      for(std::size_t k = 0; k < n; ++k)
      {
        least[k] = (std::min)(least[k], values.back()[k]);
        largest[k] = (std::max)(largest[k], values.back()[k]);
      }
    }
    require(accessor["min"].get<std::vector<float> >() == least && accessor["max"].get<std::vector<float> >() == largest, "bounds");
  }
};
#endif

} // namespace checking

#endif // CONFORMAL_EQUIVALENCE_TEST_LAYOUT_FILES_H
