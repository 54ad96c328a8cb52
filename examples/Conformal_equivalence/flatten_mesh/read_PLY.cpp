// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/readers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace flattening {

namespace {

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

// The numbers after the header, as text with a line for each element, or as bytes.
class Ply_numbers
{
public:
  // The text is at the end of the header's last line.
  Ply_numbers(Scanner& in, std::string_view content, std::size_t begin_of_bytes, bool is_text, bool is_swapped)
    : in_(in), content_(content), at_(begin_of_bytes), is_text_(is_text), is_swapped_(is_swapped)
  {}

  double next(Ply_type type)
  {
    if(is_text_)
    {
      const double x = is_first_ ? in_.number() : in_.number_in_line();
      is_first_ = false;
      return x;
    }
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

  // How many values the property has: 1, or the length of the list.
  std::size_t next_length(const Ply_property& property)
  {
    if(! property.is_list)
      return 1;
    const double n = next(property.size_type);
    if(! (n >= 0) || n != std::floor(n) || n > double(content_.size())) // each takes a byte at least
      fail(place(), ": a list '", Scanner::printable(property.name), "' of ", n, " values");
    return static_cast<std::size_t>(n);
  }

  void end_element()
  {
    if(is_text_ && ! in_.at_end_of_line())
      in_.error("there are more numbers than the header has properties");
    is_first_ = true;
  }

  // Throws a `Failure` unless the file ends here, but for ends of lines.
  void require_end()
  {
    if(is_text_ ? ! in_.at_end() : content_.find_first_not_of("\r\n", at_) != std::string_view::npos)
      fail(place(), ": there is more than the elements that the header announces");
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
  bool is_text_, is_swapped_, is_first_ = true;
};

Ply_type ply_type(Scanner& in)
{
  const std::string_view name = in.word_in_line();
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
  property.is_list = after.word_in_line() == "list";
  if(property.is_list)
  {
    in = after;
    property.size_type = ply_type(in);
  }
  property.type = ply_type(in);
  property.name = std::string(in.word_in_line());
  if(property.name.empty())
    in.error("a property without a name");
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
      header.format = std::string(in.word_in_line());
    else if(key == "element")
    {
      header.elements.emplace_back();
      header.elements.back().name = std::string(in.word_in_line());
      header.elements.back().number = in.integer_in_line();
    }
    else if(key == "property")
    {
      if(header.elements.empty())
        in.error("a property without an element");
      header.elements.back().properties.push_back(read_ply_property(in));
    }
    else if(key == "end_header")
      return header;
    else if(key != "comment" && key != "obj_info")
      in.error("unknown line '", Scanner::printable(key), "' in the header");
  }
}

// The first byte after the header, whose last word is behind the scanner. The last line ends as the first one does: what follows a CR may
// be data.
std::size_t end_of_ply_header(const Scanner& in, std::string_view content)
{
  const std::size_t first_end = content.find_first_of("\r\n");
  const std::string_view end = content.substr(first_end, content.substr(first_end, 2) == "\r\n" ? 2 : 1);
  const std::size_t last_end = content.find_first_not_of(end == "\n" ? " \t\r" : " \t", in.position());
  if(last_end == std::string_view::npos)
    return content.size();
  if(content.substr(last_end, end.size()) != end)
    in.error("the header does not end as its first line does");
  return last_end + end.size();
}

// The largest number of the type that stands for a full colour.
double full_color(Ply_type type)
{
  switch(type)
  {
    case Ply_type::FLOAT:
    case Ply_type::DOUBLE: return 1;
    case Ply_type::UINT16: return 65535;
    default:               return 255;
  }
}

// Which of x, y, z, red, green, blue the property is; 6: another one.
std::size_t place_of(const Ply_property& property)
{
  const std::array<std::string_view, 6> names{{"x", "y", "z", "red", "green", "blue"}};
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), property.name) - names.begin());
}

// Coordinates, and colours if there are the three of them.
void read_ply_vertices(Ply_numbers& numbers, const Ply_element& element, Polygon_soup& soup)
{
  std::array<bool, 7> has{};
  std::vector<std::size_t> places;
  for(const Ply_property& property : element.properties)
  {
    places.push_back(place_of(property));
    has[places.back()] = true;
  }
  const bool has_colors = has[3] && has[4] && has[5];
  soup.attributes.colors.resize(has_colors ? soup.points.size() : 0);
  for(std::size_t v = 0; v < soup.points.size(); ++v)
  {
    std::array<double, 3> color{{0, 0, 0}};
    for(std::size_t i = 0; i < places.size(); ++i)
      for(std::size_t n = numbers.next_length(element.properties[i]); n > 0; --n)
      {
        const double x = numbers.next(element.properties[i].type);
        if(places[i] < 3)
          soup.points[v][places[i]] = x;
        else if(places[i] < 6)
          color[places[i] - 3] = x / full_color(element.properties[i].type);
      }
    if(has_colors)
      soup.attributes.colors[v] = color;
    numbers.end_element();
  }
}

// The integer, or something that is no index.
std::int64_t integer(double x) { return x == std::floor(x) && std::fabs(x) < 1e15 ? static_cast<std::int64_t>(x) : -2; }

bool is_vertex_list(const Ply_property& p)
{
  return p.is_list && (p.name == "vertex_indices" || p.name == "vertex_index");
}

// The numbers of the list of vertices of one element; others are passed over.
std::vector<double> read_vertex_list(Ply_numbers& numbers, const Ply_element& element)
{
  std::vector<double> list;
  for(const Ply_property& property : element.properties)
    for(std::size_t n = numbers.next_length(property); n > 0; --n)
    {
      const double x = numbers.next(property.type);
      if(is_vertex_list(property))
        list.push_back(x);
    }
  return list;
}

// Vertices may come after faces.
std::uint32_t vertex_of_face(double x, std::size_t number_of_vertices, const Ply_numbers& numbers, std::size_t face)
{
  const std::int64_t v = integer(x);
  if(! is_index(v, number_of_vertices))
    fail(numbers.place(), ": face ", face, " names the vertex ", x, ", but there are ", number_of_vertices, " vertices");
  return static_cast<std::uint32_t>(v);
}

void read_ply_faces(Ply_numbers& numbers, const Ply_element& element, std::size_t number_of_vertices, Polygon_soup& soup)
{
  for(std::int64_t i = 0; i < element.number; ++i)
  {
    soup.faces.emplace_back();
    for(double x : read_vertex_list(numbers, element))
      soup.faces.back().push_back(vertex_of_face(x, number_of_vertices, numbers, soup.faces.size() - 1));
    if(soup.faces.back().empty())
      fail_without_vertices(numbers.place(), soup.faces.size() - 1);
    numbers.end_element();
  }
}

// Strips of triangles: each vertex makes a triangle with the two before it, every other one turned over. A strip ends at -1. Triangles
// that have a vertex twice only lead from one part of a strip to another.
void read_ply_strips(Ply_numbers& numbers, const Ply_element& element, std::size_t number_of_vertices, Polygon_soup& soup)
{
  for(std::int64_t i = 0; i < element.number; ++i)
  {
    std::vector<std::uint32_t> strip;
    for(double x : read_vertex_list(numbers, element))
    {
      if(x == -1)
      {
        strip.clear();
        continue;
      }
      strip.push_back(vertex_of_face(x, number_of_vertices, numbers, soup.faces.size()));
      const std::size_t n = strip.size();
      if(n < 3 || strip[n-1] == strip[n-2] || strip[n-2] == strip[n-3] || strip[n-1] == strip[n-3])
        continue;
      const bool is_turned = n % 2 == 0;
      const std::array<std::uint32_t, 3> triangle = {{ strip[is_turned ? n-2 : n-3], strip[is_turned ? n-3 : n-2], strip[n-1] }};
      soup.faces.emplace_back(triangle.begin(), triangle.end());
    }
    numbers.end_element();
  }
}

void skip_ply_element(Ply_numbers& numbers, const Ply_element& element)
{
  for(std::int64_t i = 0; i < element.number; ++i)
  {
    read_vertex_list(numbers, element);
    numbers.end_element();
  }
}

void require_one_property(const Ply_element& e, const std::string& name, bool is_list, const std::string& file)
{
  const auto n = std::count_if(e.properties.begin(), e.properties.end(), [&](const Ply_property& p)
                               { return is_list ? is_vertex_list(p) : p.name == name && ! p.is_list; });
  if(n == 0)
    fail(file, ": the elements '", e.name, "' have no ", is_list ? "list '" : "property '", name, "'");
  if(n > 1)
    fail(file, ": the elements '", e.name, "' have the ", is_list ? "list '" : "property '", name, "' twice");
}

bool has_faces(const Ply_element& e) { return e.name == "face" || e.name == "tristrips"; }

void require_ply_properties(const Ply_header& header, const std::string& file)
{
  for(const Ply_element& e : header.elements)
  {
    const auto is_same = [&](const Ply_element& other) { return other.name == e.name; };
    if((e.name == "vertex" || has_faces(e)) && std::count_if(header.elements.begin(), header.elements.end(), is_same) > 1)
      fail(file, ": announces the elements '", e.name, "' twice");
    if(e.name == "vertex")
      for(const char* name : {"x", "y", "z"})
        require_one_property(e, name, false, file);
    if(has_faces(e))
      require_one_property(e, "vertex_indices", true, file);
    if(e.properties.empty() && e.number != 0)
      fail(file, ": the elements '", Scanner::printable(e.name), "' have no property");
  }
}

std::size_t number_of_ply_vertices(const Ply_header& header)
{
  for(const Ply_element& e : header.elements)
    if(e.name == "vertex")
      return static_cast<std::size_t>(e.number);
  return 0;
}

} // namespace

Polygon_soup read_ply(std::string_view content, const std::string& file)
{
  Scanner in(content, file, '\0');
  const Ply_header header = read_ply_header(in);
  if(header.format != "ascii" && header.format != "binary_little_endian" && header.format != "binary_big_endian")
    fail(file, ": unknown PLY format '", Scanner::printable(header.format), "'");
  require_ply_properties(header, file);
  for(const Ply_element& element : header.elements)
    announced_number(element.number, "elements", 1, content.size(), file);
  const std::size_t number_of_vertices = number_of_ply_vertices(header);

  Ply_numbers numbers(in, content, end_of_ply_header(in, content), header.format == "ascii",
                      (header.format == "binary_big_endian") != is_big_endian());
  Polygon_soup soup;
  for(const Ply_element& element : header.elements)
    if(element.name == "vertex")
    {
      soup.points.resize(number_of_vertices);
      read_ply_vertices(numbers, element, soup);
    }
    else if(element.name == "face")
      read_ply_faces(numbers, element, number_of_vertices, soup);
    else if(element.name == "tristrips")
      read_ply_strips(numbers, element, number_of_vertices, soup);
    else
    {
      skip_ply_element(numbers, element);
      if(element.number != 0)
        soup.notices.push_back(text("skipped ", element.number, " elements '", Scanner::printable(element.name), "'"));
    }
  numbers.require_end();
  return soup;
}

} // namespace flattening
