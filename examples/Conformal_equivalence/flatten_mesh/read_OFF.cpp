// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/readers.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace flattening {

namespace {

// Passes the key word, e.g. OFF, COFF, NOFF, and returns it: C announces colours, 4 homogeneous coordinates; none if it is absent.
std::string_view read_off_key_word(Scanner& in)
{
  Scanner after(in);
  const std::string_view key = after.word();
  double number;
  if(Scanner::parse(key, number))
    return ""; // the key word may be absent
  if(key.size() < 3 || key.substr(key.size() - 3) != "OFF"
     || key.substr(0, key.size() - 3).find_first_not_of("STCN4") != std::string_view::npos)
    in.error("an OFF file begins with 'OFF', not with '", Scanner::printable(key), "'");
  in = after;
  if(Scanner(in).word() == "BINARY")
    in.error("binary OFF is not supported; convert it to text");
  return key;
}

// Normals, colors and texture coordinates are skipped, but nothing that is no number. Returns how many they are.
std::size_t skip_numbers(Scanner& in)
{
  std::size_t n = 0;
  for(; ! in.at_end_of_line(); ++n)
    in.number_in_line();
  return n;
}

// All vertices have as many numbers: a face is not taken for one.
void read_off_vertices(Scanner& in, bool is_homogeneous, Polygon_soup& soup)
{
  std::size_t number_of_others = 0;
  for(std::size_t v = 0; v < soup.points.size(); ++v)
  {
    if(in.at_end())
      fail(in.file(), ": is cut off: it ends after ", v, " of ", soup.points.size(), " vertices");
    for(double& x : soup.points[v])
      x = in.number_in_line();
    if(is_homogeneous)
    {
      const double w = in.number_in_line();
      for(double& x : soup.points[v])
        x /= w;
    }
    const std::size_t n = skip_numbers(in);
    if(v == 0)
      number_of_others = n;
    else if(n != number_of_others)
      in.error("vertex ", v, " has ", n, " numbers after its coordinates, but vertex 0 has ", number_of_others);
  }
}

void read_off_faces(Scanner& in, Polygon_soup& soup)
{
  for(std::size_t f = 0; f < soup.faces.size(); ++f)
  {
    if(in.at_end())
      fail(in.file(), ": is cut off: it ends after ", f, " of ", soup.faces.size(), " faces");
    const std::int64_t n = in.integer_in_line();
    if(n < 1)
      fail_without_vertices(place(in), f);
    while(static_cast<std::int64_t>(soup.faces[f].size()) < n)
    {
      const std::int64_t v = in.integer_in_line();
      if(! is_index(v, soup.points.size()))
        fail_no_vertex(place(in), f, v, soup.points.size());
      soup.faces[f].push_back(static_cast<std::uint32_t>(v));
    }
    skip_numbers(in);
  }
}

} // namespace

Polygon_soup read_off(std::string_view content, const std::string& file)
{
  Scanner in(content, file, '#');
  const std::string_view key = read_off_key_word(in);
  const auto has = [&](char part) { return key.find(part) != std::string_view::npos; };
  const std::int64_t nv = in.integer(), nf = in.integer_in_line();
  skip_numbers(in); // that of the edges may be absent

  Polygon_soup soup;
  soup.points.resize(announced_number(nv, "vertices", 6, in.size() - in.position(), file));
  soup.faces.resize(announced_number(nf, "faces", 8, in.size() - in.position(), file));
  if(has('C'))
    soup.notices.push_back("skipped the colours of vertices");
  read_off_vertices(in, has('4'), soup);
  read_off_faces(in, soup);
  if(! in.at_end())
    in.error("there is more than the ", nv, " vertices and ", nf, " faces that are announced");
  return soup;
}

} // namespace flattening
