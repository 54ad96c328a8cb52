// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/Components.h"
#include "../include/flatten_mesh/Polygon_soup.h"

#include <CGAL/Conformal_equivalence/Imported_mesh.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace flattening {

Components::Components(const Mesh& mesh)
  : mesh_(mesh), number_in_component_(mesh.number_of_vertices())
{
  const CE::Imported_mesh<Mesh> imported(mesh);
  found_ = CE::connected_components(imported.triangulation);
  topology_ = CE::surface_topology(imported.triangulation, found_);
  vertices_ = sorted<Vertex>(mesh.vertices(), [&](Vertex v) { return of_vertex(v); });
  faces_ = sorted<Face>(mesh.faces(), [&](Face f) { return of_face(f); });
}

template <typename Element, typename Range, typename Component_of>
Components::Sorted<Element> Components::sorted(const Range& range, Component_of component_of) const
{
  Sorted<Element> result;
  result.first.assign(size() + 1, 0);
  for(Element e : range)
    if(component_of(e) != none)
      ++result.first[component_of(e) + 1];
  for(std::size_t c = 0; c < size(); ++c)
    result.first[c + 1] += result.first[c];
  result.elements.resize(result.first.back());
  std::vector<std::size_t> free = result.first;
  for(Element e : range)
    if(component_of(e) != none)
      result.elements[free[component_of(e)]++] = e;
  return result;
}

std::size_t Components::number_of_inner_vertices(std::size_t component) const
{
  return static_cast<std::size_t>(std::count_if(vertices_.elements.begin() + std::ptrdiff_t(vertices_.first[component]),
                                                vertices_.elements.begin() + std::ptrdiff_t(vertices_.first[component + 1]),
                                                [&](Vertex v) { return ! mesh_.is_border(v); }));
}

void Components::get_mesh(std::size_t component, Component_mesh& result) const
{
  result.vertices.assign(vertices_.elements.begin() + std::ptrdiff_t(vertices_.first[component]),
                         vertices_.elements.begin() + std::ptrdiff_t(vertices_.first[component + 1]));
  result.faces.assign(faces_.elements.begin() + std::ptrdiff_t(faces_.first[component]),
                      faces_.elements.begin() + std::ptrdiff_t(faces_.first[component + 1]));
  Polygon_soup soup;
  for(Vertex v : result.vertices)
  {
    number_in_component_[v.idx()] = static_cast<std::uint32_t>(soup.points.size());
    soup.points.push_back({{ mesh_.point(v).x(), mesh_.point(v).y(), mesh_.point(v).z() }});
  }
  for(Face f : result.faces)
  {
    soup.faces.emplace_back();
    for(Vertex v : vertices_of_face(mesh_, f))
      soup.faces.back().push_back(number_in_component_[v.idx()]);
  }
  soup.number_of_edges = found_.components[component].number_of_edges;
  build_mesh(soup, result.mesh);
  align_halfedges(result);
}

void Components::align_halfedges(Component_mesh& result) const
{
  Mesh& mesh = result.mesh;
  result.halfedges.resize(mesh.number_of_halfedges());
  const auto vertex = [&](Halfedge h) { return result.vertices[mesh.target(h).idx()]; };
  for(Face f : mesh.faces())
  {
    Halfedge of_whole = mesh_.halfedge(result.faces[f.idx()]), h = mesh.halfedge(f);
    while(vertex(h) != mesh_.target(of_whole))
      h = mesh.next(h);
    mesh.set_halfedge(f, h);
    for(int k = 0; k < 3; ++k, h = mesh.next(h), of_whole = mesh_.next(of_whole))
    {
      result.halfedges[h.idx()] = of_whole;
      result.halfedges[mesh.opposite(h).idx()] = mesh_.opposite(of_whole);
    }
  }
}

} // namespace flattening
