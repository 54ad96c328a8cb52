// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The reader of each format, and what they have in common.

#ifndef FLATTEN_MESH_READERS_H
#define FLATTEN_MESH_READERS_H

#include "messages.h"
#include "Polygon_soup.h"
#include "read_soup.h"
#include "Scanner.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>

namespace flattening {

Polygon_soup read_off(std::string_view content, const std::string& file);
Polygon_soup read_obj(std::string_view content, const std::string& file);
Polygon_soup read_stl(std::string_view content, const std::string& file);
Polygon_soup read_ply(std::string_view content, const std::string& file);

// A number of elements as a file announces it: credible only if there is enough file.
std::size_t announced_number(std::int64_t n, const char* what, std::size_t bytes_each, std::size_t bytes_left, const std::string& file);

inline bool is_index(std::int64_t i, std::size_t number) { return i >= 0 && static_cast<std::size_t>(i) < number; }

inline std::string place(const Scanner& in) { return text(in.file(), ": line ", in.line()); }

// `where` is the place in the file.
[[noreturn]] void fail_no_vertex(const std::string& where, std::size_t face, std::int64_t vertex, std::size_t number_of_vertices);
[[noreturn]] void fail_without_vertices(const std::string& where, std::size_t face);

// The bytes of a number, which may be in the other order than those of the machine.
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

// What was skipped in a file, and how often, to be said once.
class Skipped
{
public:
  void count(std::string_view what) { ++number_[Scanner::printable(what)]; }

  // One notice for all; `kind` is what they are, e.g. "lines".
  void report(const std::string& kind, Polygon_soup& soup) const;

private:
  std::map<std::string, std::size_t> number_;
};

} // namespace flattening

#endif // FLATTEN_MESH_READERS_H
