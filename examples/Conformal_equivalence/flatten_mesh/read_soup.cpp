// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/read_soup.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/Scanner.h"

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flattening {

bool is_big_endian()
{
  const std::uint16_t one = 1;
  return *reinterpret_cast<const unsigned char*>(&one) == 0;
}

namespace {

constexpr std::size_t maximum_number_of_elements = std::size_t(1) << 30;

// A number of elements as a file announces it: credible only if there is enough file.
std::size_t announced_number(std::int64_t n, const char* what, std::size_t bytes_each, std::size_t bytes_left,
                                    const std::string& file)
{
  if(n < 0)
    fail(file, ": announces ", n, ' ', what);
  const std::size_t number = static_cast<std::size_t>(n);
  if(number > maximum_number_of_elements)
    fail(file, ": announces ", number, ' ', what, ", more than this program can hold");
  if(number > bytes_left / bytes_each + 1)
    fail(file, ": is cut off: it announces ", number, ' ', what, ", for which it is too short");
  return number;
}

std::uint32_t checked_index(std::int64_t i, std::size_t number_of_vertices, std::size_t face, const std::string& where)
{
  if(i < 0 || static_cast<std::size_t>(i) >= number_of_vertices)
    fail(where, ": face ", face, " names the vertex ", i, ", but there are ", number_of_vertices, " vertices");
  return static_cast<std::uint32_t>(i);
}

[[noreturn]] void fail_with_number_of_vertices(const std::string& where, std::size_t face, double n)
{
  fail(where, ": face ", face, " has ", n, " vertices");
}

std::string place(const Scanner& in) { return text(in.file(), ": line ", in.line()); }

// --- OFF ----------------------------------------------------------------------------------------

// Passes the key word, e.g. OFF, COFF, NOFF; returns whether coordinates are homogeneous.
bool read_off_key_word(Scanner& in)
{
  Scanner after(in);
  const std::string_view key = after.word();
  double number;
  if(Scanner::parse(key, number))
    return false; // the key word may be absent
  if(key.size() < 3 || key.substr(key.size() - 3) != "OFF"
     || key.substr(0, key.size() - 3).find_first_not_of("STCN4") != std::string_view::npos)
    in.error("an OFF file begins with 'OFF', not with '", Scanner::printable(key), "'");
  in = after;
  if(Scanner(in).word() == "BINARY")
    in.error("binary OFF is not supported; convert it to text");
  return key.find('4') != std::string_view::npos;
}

Polygon_soup read_off(std::string_view content, const std::string& file)
{
  Scanner in(content, file, '#');
  const bool is_homogeneous = read_off_key_word(in);
  const std::int64_t nv = in.integer(), nf = in.integer_in_line();
  in.skip_line();

  Polygon_soup soup;
  soup.points.resize(announced_number(nv, "vertices", 6, in.size() - in.position(), file));
  soup.faces.resize(announced_number(nf, "faces", 8, in.size() - in.position(), file));
  for(std::size_t v = 0; v < soup.points.size(); ++v)
  {
    if(in.at_end())
      fail(file, ": is cut off: it ends after ", v, " of ", nv, " vertices");
    for(double& x : soup.points[v])
      x = in.number_in_line();
    if(is_homogeneous)
    {
      const double w = in.number_in_line();
      for(double& x : soup.points[v])
        x /= w;
    }
    in.skip_line(); // normals, colors, texture coordinates
  }
  for(std::size_t f = 0; f < soup.faces.size(); ++f)
  {
    if(in.at_end())
      fail(file, ": is cut off: it ends after ", f, " of ", nf, " faces");
    const std::int64_t n = in.integer_in_line();
    if(n < 1)
      fail_with_number_of_vertices(place(in), f, double(n));
    for(std::int64_t i = 0; i < n; ++i)
    {
      const std::int64_t index = in.integer_in_line();
      if(index < 0 || index >= nv)
        checked_index(index, soup.points.size(), f, place(in));
      soup.faces[f].push_back(static_cast<std::uint32_t>(index));
    }
    in.skip_line();
  }
  return soup;
}

// --- OBJ ----------------------------------------------------------------------------------------

// The vertex of a corner "v", "v/vt", "v//vn" or "v/vt/vn"; from 1, or backwards from the last if negative.
std::int64_t obj_vertex(Scanner& in, std::size_t number_of_points)
{
  std::string_view corner = in.word();
  corner = corner.substr(0, corner.find('/'));
  std::int64_t i = 0;
  if(! Scanner::parse(corner, i) || i == 0)
    in.error("a face: expected the number of a vertex, found '", Scanner::printable(corner), "'");
  return i > 0 ? i - 1 : static_cast<std::int64_t>(number_of_points) + i;
}

Polygon_soup read_obj(std::string_view content, const std::string& file)
{
  Scanner in(content, file, '#');
  Polygon_soup soup;
  std::vector<std::size_t> lines; // of the faces: a face may come before its vertices
  std::vector<boost::container::small_vector<std::int64_t, 4> > faces;
  for(; ! in.at_end(); in.skip_line())
  {
    const std::string_view key = in.word();
    if(key == "v")
    {
      soup.points.emplace_back();
      for(double& x : soup.points.back())
        x = in.number_in_line();
    }
    else if(key == "f")
    {
      faces.emplace_back();
      lines.push_back(in.line());
      while(! in.at_end_of_line())
        faces.back().push_back(obj_vertex(in, soup.points.size()));
      if(faces.back().empty())
        fail_with_number_of_vertices(place(in), faces.size() - 1, 0);
    }
  }
  for(std::size_t f = 0; f < faces.size(); ++f)
  {
    soup.faces.emplace_back();
    for(std::int64_t v : faces[f])
    {
      if(v < 0 || v >= static_cast<std::int64_t>(soup.points.size()))
        fail(file, ": line ", lines[f], ": face ", f, " names the vertex ", v + 1,
             " (counted from 1), but there are ", soup.points.size(), " vertices");
      soup.faces[f].push_back(static_cast<std::uint32_t>(v));
    }
  }
  return soup;
}

// --- STL ----------------------------------------------------------------------------------------

// Gives equal points one number, in the order in which they first come.
void merge_equal_points(Polygon_soup& soup)
{
  const auto& points = soup.points;
  std::vector<std::uint32_t> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b)
            { return points[a] != points[b] ? points[a] < points[b] : a < b; });
  for(std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = (i > 0 && points[order[i]] == points[order[i-1]]) ? first[order[i-1]] : order[i];

  std::vector<std::array<double, 3> > kept;
  std::vector<std::uint32_t> number(points.size());
  for(std::uint32_t i = 0; i < first.size(); ++i)
  {
    if(first[i] == i)
      kept.push_back(points[i]);
    number[i] = first[i] == i ? static_cast<std::uint32_t>(kept.size() - 1) : number[first[i]];
  }
  soup.points = std::move(kept);
  for(Polygon& face : soup.faces)
    for(std::uint32_t& i : face)
      i = number[i];
}

void add_stl_point(Polygon_soup& soup, double x, double y, double z)
{
  soup.points.push_back({{ x, y, z }});
  const std::uint32_t i = static_cast<std::uint32_t>(soup.points.size() - 1);
  if(i % 3 == 2)
  {
    soup.faces.emplace_back();
    for(std::uint32_t k = i - 2; k <= i; ++k)
      soup.faces.back().push_back(k);
  }
}

template <typename T>
T from_bytes(const char* bytes, bool reverse = false)
{
  char copy[sizeof(T)];
  std::memcpy(copy, bytes, sizeof(T));
  if(reverse)
    std::reverse(copy, copy + sizeof(T));
  T value;
  std::memcpy(&value, copy, sizeof(T));
  return value;
}

// The header has 80 bytes, each triangle 50: the normal, three points, two bytes more.
Polygon_soup read_binary_stl(std::string_view content)
{
  Polygon_soup soup;
  for(std::size_t at = 84; at + 50 <= content.size(); at += 50)
    for(std::size_t k = 1; k <= 3; ++k)
    {
      const char* p = content.data() + at + 12 * k;
      add_stl_point(soup, from_bytes<float>(p, is_big_endian()), from_bytes<float>(p + 4, is_big_endian()),
                    from_bytes<float>(p + 8, is_big_endian()));
    }
  return soup;
}

Polygon_soup read_text_stl(std::string_view content, const std::string& file)
{
  Scanner in(content, file, '\0');
  Polygon_soup soup;
  if(in.word() != "solid")
    fail(file, ": is neither text nor binary STL, or is cut off");
  in.skip_line();
  bool is_closed = false;
  std::size_t corners = 0;
  while(! in.at_end())
  {
    const std::string_view key = in.word();
    is_closed = key == "endsolid";
    if(key == "vertex")
    {
      const double x = in.number(), y = in.number(), z = in.number();
      add_stl_point(soup, x, y, z);
      ++corners;
    }
    else if(key == "endfacet")
    {
      if(corners != 3)
        fail(place(in), ": face ", soup.faces.size(), " has ", corners, " vertices, and not three");
      corners = 0;
    }
    else if(key == "solid" || key == "endsolid")
      in.skip_line();
  }
  if(! is_closed || corners != 0)
    fail(file, ": is cut off: 'endsolid' is missing");
  return soup;
}

Polygon_soup read_stl(std::string_view content, const std::string& file)
{
  // A binary file may begin with "solid", too: its size tells.
  bool is_binary = false;
  if(content.size() >= 84)
  {
    const std::uint64_t n = from_bytes<std::uint32_t>(content.data() + 80, is_big_endian());
    is_binary = content.size() == 84 + 50 * n;
  }
  Polygon_soup soup = is_binary ? read_binary_stl(content) : read_text_stl(content, file);
  check_points(soup, file); // before points are compared
  merge_equal_points(soup);
  return soup;
}

// --- PLY ----------------------------------------------------------------------------------------

enum class Ply_type { INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT, DOUBLE };

struct Ply_property
{
  std::string name;
  bool is_list = false;
  Ply_type size_type = Ply_type::UINT8, type = Ply_type::FLOAT;
};

struct Ply_element
{
  std::string name;
  std::int64_t number = 0;
  std::vector<Ply_property> properties;
};

// The numbers after the header, as text or as bytes.
class Ply_numbers
{
public:
  Ply_numbers(Scanner& in, std::string_view content, bool is_text, bool is_swapped)
    : in_(in), content_(content), at_(in.position() + 1), is_text_(is_text), is_swapped_(is_swapped)
  {}

  double next(Ply_type type)
  {
    if(is_text_)
      return in_.number();
    switch(type)
    {
      case Ply_type::INT8:   return read<std::int8_t>();
      case Ply_type::UINT8:  return read<std::uint8_t>();
      case Ply_type::INT16:  return read<std::int16_t>();
      case Ply_type::UINT16: return read<std::uint16_t>();
      case Ply_type::INT32:  return read<std::int32_t>();
      case Ply_type::UINT32: return read<std::uint32_t>();
      case Ply_type::FLOAT:  return read<float>();
      case Ply_type::DOUBLE: break;
    }
    return read<double>();
  }

  std::string place() const
  {
    return is_text_ ? flattening::place(in_) : text(in_.file(), ": byte ", at_);
  }

private:
  template <typename T>
  T read()
  {
    if(at_ + sizeof(T) > content_.size())
      fail(in_.file(), ": is cut off: it ends within its data");
    const T value = from_bytes<T>(content_.data() + at_, is_swapped_);
    at_ += sizeof(T);
    return value;
  }

  Scanner& in_;
  std::string_view content_;
  std::size_t at_;
  bool is_text_, is_swapped_;
};

Ply_type ply_type(Scanner& in)
{
  const std::string_view name = in.word();
  const char* names[][2] = { {"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"}, {"ushort", "uint16"},
                             {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"} };
  for(int i = 0; i < 8; ++i)
    if(name == names[i][0] || name == names[i][1])
      return static_cast<Ply_type>(i);
  in.error("unknown type '", Scanner::printable(name), "'");
}

struct Ply_header
{
  std::string format;
  std::vector<Ply_element> elements;
};

Ply_property read_ply_property(Scanner& in)
{
  Ply_property property;
  Scanner after(in);
  property.is_list = after.word() == "list";
  if(property.is_list)
  {
    in = after;
    property.size_type = ply_type(in);
  }
  property.type = ply_type(in);
  property.name = std::string(in.word());
  return property;
}

Ply_header read_ply_header(Scanner& in)
{
  if(in.word() != "ply")
    in.error("a PLY file begins with 'ply'");
  Ply_header header;
  for(in.skip_line(); ; in.skip_line())
  {
    const std::string_view key = in.word();
    if(key == "format")
      header.format = std::string(in.word());
    else if(key == "element")
    {
      header.elements.emplace_back();
      header.elements.back().name = std::string(in.word());
      header.elements.back().number = in.integer_in_line();
    }
    else if(key == "property")
    {
      if(header.elements.empty())
        in.error("a property without an element");
      header.elements.back().properties.push_back(read_ply_property(in));
    }
    else if(key == "end_header")
      break;
    else if(key != "comment" && key != "obj_info")
      in.error("unknown line '", Scanner::printable(key), "' in the header");
  }
  in.skip_line();
  return header;
}

void read_ply_vertices(Ply_numbers& numbers, const Ply_element& element, Polygon_soup& soup)
{
  for(auto& p : soup.points)
    for(const Ply_property& property : element.properties)
    {
      const double n = property.is_list ? numbers.next(property.size_type) : 1.;
      for(std::size_t i = 0; double(i) < n; ++i)
      {
        const double x = numbers.next(property.type);
        for(std::size_t k = 0; k < 3; ++k)
          if(property.name.size() == 1 && property.name[0] == "xyz"[k])
            p[k] = x;
      }
    }
}

bool is_vertex_list(const Ply_property& p)
{
  return p.is_list && (p.name == "vertex_indices" || p.name == "vertex_index");
}

void read_ply_faces(Ply_numbers& numbers, const Ply_element& element, Polygon_soup& soup)
{
  for(std::size_t f = 0; f < soup.faces.size(); ++f)
    for(const Ply_property& property : element.properties)
    {
      const double n = property.is_list ? numbers.next(property.size_type) : 1.;
      if(is_vertex_list(property) && ! (n >= 1))
        fail_with_number_of_vertices(numbers.place(), f, n);
      for(std::size_t i = 0; double(i) < n; ++i)
      {
        const double x = numbers.next(property.type);
        if(is_vertex_list(property))
          soup.faces[f].push_back(checked_index(x == std::floor(x) && std::fabs(x) < 1e18 ? static_cast<std::int64_t>(x) : -1,
                                                soup.points.size(), f, numbers.place()));
      }
    }
}

void skip_ply_element(Ply_numbers& numbers, const Ply_element& element)
{
  for(std::int64_t j = 0; j < element.number; ++j)
    for(const Ply_property& property : element.properties)
    {
      const double n = property.is_list ? numbers.next(property.size_type) : 1.;
      for(std::size_t i = 0; double(i) < n; ++i)
        numbers.next(property.type);
    }
}

void require_ply_properties(const Ply_header& header, const std::string& file)
{
  for(const Ply_element& e : header.elements)
  {
    const auto has = [&](auto is_wanted) { return std::any_of(e.properties.begin(), e.properties.end(), is_wanted); };
    for(std::string name : {"x", "y", "z"})
      if(e.name == "vertex" && ! has([&](const Ply_property& p) { return p.name == name && ! p.is_list; }))
        fail(file, ": the vertices have no property '", name, "'");
    if(e.name == "face" && ! has(is_vertex_list))
      fail(file, ": the faces have no list 'vertex_indices'");
    if(e.properties.empty() && e.number != 0)
      fail(file, ": the elements '", Scanner::printable(e.name), "' have no property");
  }
}

Polygon_soup read_ply(std::string_view content, const std::string& file)
{
  Scanner in(content, file, '\0');
  const Ply_header header = read_ply_header(in);
  if(header.format != "ascii" && header.format != "binary_little_endian" && header.format != "binary_big_endian")
    fail(file, ": unknown PLY format '", Scanner::printable(header.format), "'");
  require_ply_properties(header, file);
  Ply_numbers numbers(in, content, header.format == "ascii",
                      (header.format == "binary_big_endian") != is_big_endian());
  Polygon_soup soup;
  for(const Ply_element& element : header.elements)
  {
    const std::size_t n = announced_number(element.number, "elements", 1, content.size(), file);
    if(element.name == "vertex" && soup.points.empty())
    {
      soup.points.resize(n);
      read_ply_vertices(numbers, element, soup);
    }
    else if(element.name == "face" && soup.faces.empty())
    {
      soup.faces.resize(n);
      read_ply_faces(numbers, element, soup);
    }
    else
      skip_ply_element(numbers, element);
  }
  return soup;
}

// ------------------------------------------------------------------------------------------------

std::string lower_case_extension(const std::string& file)
{
  std::string extension = std::filesystem::path(file).extension().string();
  for(char& c : extension)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

} // namespace

namespace {

// The extension that files with this content have, as their first word tells. That of OBJ and of binary STL is arbitrary.
std::string extension_of_content(const std::string& content)
{
  Scanner in(content, "-", '#');
  const std::string_view word = in.word();
  if(word == "ply")
    return ".ply";
  if(word == "solid")
    return ".stl";
  if(word.size() >= 3 && word.substr(word.size() - 3) == "OFF")
    return ".off";
  return content.find('\0') == std::string::npos ? ".obj" : ".stl";
}

} // namespace

// Reads the file in the format that its extension names; the standard input in that of its content.
Polygon_soup read_soup(const std::string& file)
{
  std::string extension = lower_case_extension(file), content;
  if(file == "-")
  {
    content = read_file(file);
    extension = extension_of_content(content);
  }
  if(extension != ".off" && extension != ".obj" && extension != ".stl" && extension != ".ply")
    fail(file, ": unknown extension '", extension, "'; known are .off, .obj, .ply and .stl");
  if(file != "-")
    content = read_file(file);
  if(content.empty())
    fail(file, ": the file is empty");
  if(extension == ".off")
    return read_off(content, file);
  if(extension == ".obj")
    return read_obj(content, file);
  if(extension == ".stl")
    return read_stl(content, file);
  return read_ply(content, file);
}

} // namespace flattening
