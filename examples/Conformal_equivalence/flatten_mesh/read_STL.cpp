// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/readers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flattening {

namespace {

// The header has 80 bytes, the number of triangles 4; each triangle has 50: the normal, three points, two bytes more.
constexpr std::size_t header_size = 84, triangle_size = 50;

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

Polygon_soup read_binary_stl(std::string_view content, const std::string& file)
{
  const std::uint64_t n = from_bytes<std::uint32_t>(content.data() + 80, is_big_endian());
  const std::size_t room = (content.size() - header_size) / triangle_size, extra = (content.size() - header_size) % triangle_size;
  if(n > room)
    fail(file, ": is cut off: it announces ", n, " triangles, but ends after ", room);
  if(n < room)
    fail(file, ": announces ", n, " triangles, but there is more: room for ", room);
  Polygon_soup soup;
  for(std::size_t f = 0; f < n; ++f)
  {
    for(std::size_t k = 1; k <= 3; ++k)
    {
      const char* p = content.data() + header_size + triangle_size * f + 12 * k;
      const auto coordinate = [p](std::size_t i) { return double(from_bytes<float>(p + 4 * i, is_big_endian())); };
      soup.points.push_back({{ coordinate(0), coordinate(1), coordinate(2) }});
    }
    const std::uint32_t end = static_cast<std::uint32_t>(soup.points.size());
    const std::array<std::uint32_t, 3> triangle = {{ end - 3, end - 2, end - 1 }};
    soup.faces.emplace_back(triangle.begin(), triangle.end());
  }
  if(extra != 0)
    soup.notices.push_back(text("skipped ", extra, extra == 1 ? " byte" : " bytes", " after the last triangle"));
  return soup;
}

std::string lower_case(std::string_view word)
{
  std::string result(word);
  for(char& c : result)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

// The words may be written in upper case, and "end solid" for "endsolid".
class Text_STL_reader
{
public:
  Text_STL_reader(std::string_view content, const std::string& file) : in_(content, file, '\0') {}

  Polygon_soup read()
  {
    if(lower_case(Scanner(in_).word()) != "solid")
      fail(in_.file(), ": is neither text nor binary STL, or is cut off");
    while(! in_.at_end())
      read_item(next_key());
    if(is_open_ || ! facet_.empty())
      fail(in_.file(), ": is cut off: 'endsolid' is missing");
    skipped_.report("words", soup_);
    return std::move(soup_);
  }

private:
  std::string next_key()
  {
    const std::string key = lower_case(in_.word());
    return key == "end" ? key + lower_case(in_.word_in_line()) : key;
  }

  void read_item(const std::string& key)
  {
    if(key == "solid" || key == "endsolid")
    {
      is_open_ = key == "solid";
      in_.skip_line(); // a name, of any words
    }
    else if(key == "facet")
      begin_facet();
    else if(key == "vertex")
    {
      const double x = in_.number(), y = in_.number(), z = in_.number();
      facet_.push_back(static_cast<std::uint32_t>(soup_.points.size()));
      soup_.points.push_back({{ x, y, z }});
    }
    else if(key == "endfacet")
      end_facet();
    else if(key != "outer" && key != "loop" && key != "endloop")
    {
      skipped_.count(key);
      in_.skip_line();
    }
  }

  void begin_facet()
  {
    if(! facet_.empty())
      in_.error("a facet begins before the last one ends: 'endfacet' is missing");
    Scanner after(in_);
    if(lower_case(after.word()) != "normal")
      return;
    in_ = after;
    for(int i = 0; i < 3; ++i)
      in_.word_in_line(); // some programs write "nan"
  }

  void end_facet()
  {
    if(facet_.size() < 3)
      fail(place(in_), ": face ", soup_.faces.size(), " has ", facet_.size(), facet_.size() == 1 ? " vertex" : " vertices",
           ", and not three");
    soup_.faces.emplace_back(facet_.begin(), facet_.end());
    facet_.clear();
  }

  Scanner in_;
  Polygon_soup soup_;
  std::vector<std::uint32_t> facet_; // the vertices of the one that is being read
  bool is_open_ = false;
  Skipped skipped_;
};

// A binary file may begin with "solid", too: its size tells. If that is not what it should be, the number of triangles does, which has a zero
// byte unless there are millions of them, as no text has.
bool is_binary_stl(std::string_view content)
{
  if(content.size() < header_size)
    return false;
  const std::uint64_t n = from_bytes<std::uint32_t>(content.data() + 80, is_big_endian());
  return content.size() == header_size + triangle_size * n || content.substr(80, 4).find('\0') != std::string_view::npos;
}

} // namespace

Polygon_soup read_stl(std::string_view content, const std::string& file)
{
  const bool is_binary = is_binary_stl(content);
  Polygon_soup soup = is_binary ? read_binary_stl(content, file) : Text_STL_reader(content, file).read();
  check_points(soup, file); // before points are compared
  merge_equal_points(soup);
  soup.vertices_are_points = true;
  soup.has_single_precision = is_binary;
  return soup;
}

} // namespace flattening
