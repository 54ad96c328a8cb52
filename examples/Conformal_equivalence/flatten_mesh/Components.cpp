// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/Components.h"

#include <CGAL/Conformal_equivalence/Imported_mesh.h>

#include <algorithm>
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
  Mesh& mesh = result.mesh;
  for(Vertex v : result.vertices)
  {
    number_in_component_[v.idx()] = static_cast<std::uint32_t>(mesh.number_of_vertices());
    mesh.add_vertex(mesh_.point(v));
  }
  align_halfedges(result);
}

// Edges are copied, and not made anew for the faces: polygons may have been divided by diagonals between vertices that have an edge already.
void Components::align_halfedges(Component_mesh& result) const
{
  Mesh& mesh = result.mesh;
  std::vector<Mesh::Edge_index> edges;
  for(Face f : result.faces)
    for(Halfedge h : mesh_.halfedges_around_face(mesh_.halfedge(f)))
      edges.push_back(mesh_.edge(h));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const auto vertex = [&](Vertex v) { return Vertex(number_in_component_[v.idx()]); };
  for(Mesh::Edge_index e : edges)
  {
    const Halfedge h = mesh_.halfedge(e);
    mesh.add_edge(vertex(mesh_.source(h)), vertex(mesh_.target(h)));
    result.halfedges.push_back(h);
    result.halfedges.push_back(mesh_.opposite(h));
  }
  const auto halfedge = [&](Halfedge h)
  {
    const auto place = std::lower_bound(edges.begin(), edges.end(), mesh_.edge(h));
    const Halfedge first = mesh.halfedge(Mesh::Edge_index(static_cast<Mesh::size_type>(place - edges.begin())));
    return h == mesh_.halfedge(*place) ? first : mesh.opposite(first);
  };
  for(Halfedge h : mesh.halfedges())
    mesh.set_next(h, halfedge(mesh_.next(result.halfedges[h.idx()])));
  for(Face f : result.faces)
  {
    const Face g = mesh.add_face();
    mesh.set_halfedge(g, halfedge(mesh_.halfedge(f)));
    for(Halfedge h : mesh.halfedges_around_face(mesh.halfedge(g)))
      mesh.set_face(h, g);
  }
  for(Vertex v : mesh.vertices())
    mesh.set_halfedge(v, halfedge(mesh_.halfedge(result.vertices[v.idx()])));
}

} // namespace flattening
