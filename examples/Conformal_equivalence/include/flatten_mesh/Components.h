// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The connected components of a mesh. What is found for one component only is found for each of them by itself, as a mesh of its own.

#ifndef FLATTEN_MESH_COMPONENTS_H
#define FLATTEN_MESH_COMPONENTS_H

#include "mesh.h"

#include <CGAL/Conformal_equivalence/Surface_topology.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace flattening {

// A component as a mesh of its own. Vertices and faces come in their order in the whole, and each face begins with the same corner: so this is the
// mesh that is read from a file with this component alone.
struct Component_mesh
{
  Mesh mesh;
  std::vector<Vertex> vertices;     // of the whole, by vertex
  std::vector<Face> faces;          // of the whole, by face
  std::vector<Halfedge> halfedges;  // of the whole, by halfedge
};

class Components
{
public:
  static constexpr std::uint32_t none = std::uint32_t(-1); // of isolated vertices

  explicit Components(const Mesh& mesh);

  std::size_t size() const { return found_.components.size(); }
  std::uint32_t of_vertex(Vertex v) const { return found_.component_of_vertex[v.idx()]; }
  std::uint32_t of_face(Face f) const { return of_vertex(mesh_.target(mesh_.halfedge(f))); }
  const CE::Surface_components::Component& operator[](std::size_t component) const { return found_.components[component]; }
  const CE::Surface_topology& topology() const { return topology_; } // of the whole

  // The number of vertices inside the surface, where cones may be.
  std::size_t number_of_inner_vertices(std::size_t component) const;

  // Linear in the size of the component.
  void get_mesh(std::size_t component, Component_mesh& result) const;

private:
  // Elements in the order of their components: those of one stand from `first[component]` to `first[component + 1]`.
  template <typename Element>
  struct Sorted
  {
    std::vector<std::size_t> first;
    std::vector<Element> elements;
  };

  template <typename Element, typename Range, typename Component_of>
  Sorted<Element> sorted(const Range& range, Component_of component_of) const;

  void align_halfedges(Component_mesh& result) const;

  const Mesh& mesh_;
  CE::Surface_components found_;
  CE::Surface_topology topology_;
  Sorted<Vertex> vertices_;
  Sorted<Face> faces_;
  mutable std::vector<std::uint32_t> number_in_component_; // by vertex; of the component looked at last
};

} // namespace flattening

#endif // FLATTEN_MESH_COMPONENTS_H
