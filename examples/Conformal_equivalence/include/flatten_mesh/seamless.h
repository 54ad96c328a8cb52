// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Seamless layouts: their coordinates in the lattice of the tiles, the paths along which they are cut, and a texture of tiles.

#ifndef FLATTEN_MESH_SEAMLESS_H
#define FLATTEN_MESH_SEAMLESS_H

#include "layout_seams.h"
#include "mesh.h"
#include "results.h"

#include <CGAL/Conformal_equivalence/compute_seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <unordered_map>
#include <vector>

namespace flattening {

// The tiles are hexagons, about the points a + b e^{i pi / 3}; otherwise squares, about those a + b i.
inline bool has_hexagons(int symmetry) { return symmetry == 3 || symmetry == 6; }
inline bool has_squares(int symmetry)  { return symmetry == 2 || symmetry == 4; }

// The layout was found in coordinates (a, b) of the lattice: these are written, Cartesian ones are drawn.
inline void keep_lattice_coordinates(unsigned int symmetry, Result& result)
{
  UV_map lattice = result.mesh.add_property_map<Halfedge, Kernel::Point_2>("h:lattice_uv").first;
  for(Halfedge h : result.mesh.halfedges())
  {
    const Kernel::Point_2 p = lattice[h] = result.uv[h];
    if(has_hexagons(static_cast<int>(symmetry)))
      result.uv[h] = Kernel::Point_2(p.x() + p.y() / 2, p.y() * (std::sqrt(3.) / 2));
  }
  result.lattice_uv = lattice;
}

// A path of the seam, from one of its special vertices to another; the motion that takes its left side to the right one is a rotation by a
// number of quanta and then the translation by a point of the lattice.
struct Seam_path
{
  Vertex from, to;
  std::size_t number_of_edges = 0;
  int quanta = 0;
  std::array<std::int64_t, 2> translation = {{0, 0}};
};

// A point of the lattice turned by 2 pi `quanta` / `symmetry`.
inline std::array<std::int64_t, 2> turned(std::array<std::int64_t, 2> p, int quanta, int symmetry)
{
  const int smallest = has_hexagons(symmetry) ? 6 : 4; // the whole symmetry of the lattice
  for(int k = quanta * (smallest / symmetry); k > 0; --k)
    p = smallest == 6 ? std::array<std::int64_t, 2>{{-p[1], p[0] + p[1]}} : std::array<std::int64_t, 2>{{-p[1], p[0]}};
  return p;
}

// The motion back.
inline void invert(Seam_path& path, int symmetry)
{
  path.quanta = (symmetry - path.quanta) % symmetry;
  const std::array<std::int64_t, 2> p = turned(path.translation, path.quanta, symmetry);
  path.translation = {{ -p[0], -p[1] }};
}

inline std::vector<Seam_path> seam_paths(const Mesh& mesh, const UV_map& uv, const Report& report)
{
  std::unordered_map<std::size_t, const CE::Seam_transition<Mesh>*> transition_at;
  for(const auto& transition : report.transitions)
    transition_at.emplace(mesh.edge(transition.halfedge).idx(), &transition);

  const Layout_seams<Mesh, UV_map> seams(mesh, uv, true);
  std::vector<Seam_path> paths;
  for(const std::vector<Halfedge>& path : seams.paths())
  {
    const auto found = transition_at.find(mesh.edge(path.front()).idx());
    if(found == transition_at.end())
      continue;
    const CE::Seam_transition<Mesh>& transition = *found->second;
    Seam_path result;
    result.from = mesh.source(path.front());
    result.to = mesh.target(path.back());
    result.number_of_edges = path.size();
    result.quanta = transition.quanta;
    result.translation = transition.lattice_translation;
    if(transition.halfedge != path.front())
      invert(result, report.tiling.symmetry);
    paths.push_back(result);
  }
  return paths;
}

// The material of a texture of squares, its squares half as wide as a tile and one of them in the centre of each, so that it fits across seams.
inline void write_tile_material(std::ostream& out, const std::string& name, const std::string& texture)
{
  out << "newmtl " << name << "\nKa 1 1 1\nKd 1 1 1\nKs 0 0 0\nillum 1\nmap_Kd -o 0.25 0.25 -s 1 1 1 " << texture << '\n';
}

} // namespace flattening

#endif // FLATTEN_MESH_SEAMLESS_H
