// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/readers.h"

#include <cctype>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace flattening {

bool is_big_endian()
{
  const std::uint16_t one = 1;
  return *reinterpret_cast<const unsigned char*>(&one) == 0;
}

std::size_t announced_number(std::int64_t n, const char* what, std::size_t bytes_each, std::size_t bytes_left, const std::string& file)
{
  constexpr std::size_t maximum = std::size_t(1) << 30;
  if(n < 0)
    fail(file, ": announces ", n, ' ', what);
  const std::size_t number = static_cast<std::size_t>(n);
  if(number > maximum)
    fail(file, ": announces ", number, ' ', what, ", more than this program can hold");
  if(number > bytes_left / bytes_each + 1)
    fail(file, ": is cut off: it announces ", number, ' ', what, ", for which it is too short");
  return number;
}

void fail_no_vertex(const std::string& where, std::size_t face, std::int64_t vertex, std::size_t number_of_vertices)
{
  fail(where, ": face ", face, " names the vertex ", vertex, ", but there are ", number_of_vertices, " vertices");
}

void fail_without_vertices(const std::string& where, std::size_t face)
{
  fail(where, ": face ", face, " has no vertices");
}

void Skipped::report(const std::string& kind, Polygon_soup& soup) const
{
  if(number_.empty())
    return;
  constexpr std::size_t maximum = 10;
  std::string list;
  std::size_t n = 0;
  for(const auto& what : number_)
    if(n++ < maximum)
      list += text(n == 1 ? "" : ", ", "'", what.first, "' (", what.second, ")");
  soup.notices.push_back(text("skipped ", kind, ": ", list, n > maximum ? text(" and ", n - maximum, " more kinds") : ""));
}

namespace {

std::string lower_case_extension(const std::string& file)
{
  std::string extension = std::filesystem::path(file).extension().string();
  for(char& c : extension)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

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

Polygon_soup read_soup(const std::string& file, const std::string& format)
{
  std::string extension = format.empty() ? lower_case_extension(file) : "." + format, content;
  if(file == "-")
  {
    content = read_file(file);
    if(format.empty())
      extension = extension_of_content(content);
  }
  if(extension != ".off" && extension != ".obj" && extension != ".stl" && extension != ".ply")
    fail(file, ": unknown extension '", extension, "'; known are .off, .obj, .ply and .stl (for others: --format)");
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
