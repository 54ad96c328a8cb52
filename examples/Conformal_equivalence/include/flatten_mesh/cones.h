// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_CONES_H
#define FLATTEN_MESH_CONES_H

#include "mesh.h"
#include "Scanner.h"

#include <CGAL/number_utils.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <unordered_map>

namespace flattening {

// The vertex that a line of a file begins with.
inline Vertex read_vertex(Scanner& in, const Mesh& mesh)
{
  const std::int64_t i = in.integer_in_line();
  if(i < 0 || static_cast<std::size_t>(i) >= mesh.number_of_vertices())
    in.error("there is no vertex ", i, "; the mesh has ", mesh.number_of_vertices(), " vertices");
  return Vertex(static_cast<Mesh::size_type>(i));
}

inline void require_inside(const Scanner& in, const Mesh& mesh, Vertex v)
{
  if(mesh.is_isolated(v))
    in.error("vertex ", v.idx(), " has no face, it cannot be a cone");
  if(mesh.is_border(v))
    in.error("vertex ", v.idx(), " is on the border; a cone lies inside the surface");
}

// A number of degrees; of a multiple of 360 / `quanta_of_turn`, if that is not zero, its rounding is undone.
inline double multiple_of_quantum(const Scanner& in, Vertex v, double degrees, unsigned int quanta_of_turn)
{
  if(quanta_of_turn == 0)
    return degrees;
  const double multiple = std::round(degrees * quanta_of_turn / 360), nearest = multiple * 360 / quanta_of_turn;
  if(! (multiple > 0) || std::abs(degrees - nearest) > 1e-6)
    in.error("vertex ", v.idx(), ": the angle ", degrees, " is no multiple of ", 360. / quanta_of_turn, " degrees (--quantize)");
  return nearest;
}

// In radians, from a word in degrees.
inline double cone_angle(const Scanner& in, Vertex v, std::string_view word, unsigned int quanta_of_turn)
{
  double degrees = 0;
  if(! Scanner::parse(word, degrees))
    in.error("vertex ", v.idx(), ": expected an angle in degrees or 'free', found '", Scanner::printable(word), "'");
  if(! std::isfinite(degrees))
    in.error("vertex ", v.idx(), ": the angle ", degrees, " is not a finite number");
  if(! (degrees / 180 * CGAL_PI > 0))
    in.error("vertex ", v.idx(), ": the angle ", degrees, " is not positive");
  return multiple_of_quantum(in, v, degrees, quanta_of_turn) / 180 * CGAL_PI;
}

// Calls `fix(vertex)` for each cone of free angle, and `prescribe(vertex, angle)` for each of the others, in the
// lines "vertex-index [angle in degrees | free]" of the file; # begins a comment. Each vertex is
// inside the surface and is listed once. No angle is free if all are to be multiples of 360 / `quanta_of_turn`.
template <typename Fix, typename Prescribe>
void read_cone_file(const std::string& file, const Mesh& mesh, unsigned int quanta_of_turn, Fix fix, Prescribe prescribe)
{
  const std::string content = read_file(file);
  Scanner in(content, file, '#');
  std::unordered_map<std::size_t, std::size_t> line_of;
  for(; ! in.at_end(); in.skip_line())
  {
    const Vertex v = read_vertex(in, mesh);
    require_inside(in, mesh, v);
    const auto listed = line_of.emplace(v.idx(), in.line());
    if(! listed.second)
      in.error("vertex ", v.idx(), " is listed twice, first in line ", listed.first->second);
    const std::string_view word = in.word_in_line();
    if(! word.empty() && word != "free")
      prescribe(v, cone_angle(in, v, word, quanta_of_turn));
    else if(quanta_of_turn == 0)
      fix(v);
    else
      in.error("vertex ", v.idx(), ": a free cone has any angle, not a multiple of ", 360. / quanta_of_turn, " degrees (--quantize)");
    if(! in.at_end_of_line())
      in.error("vertex ", v.idx(), ": expected nothing after '", Scanner::printable(word), "', found '",
               Scanner::printable(in.word()), "'");
  }
}

} // namespace flattening

#endif // FLATTEN_MESH_CONES_H
