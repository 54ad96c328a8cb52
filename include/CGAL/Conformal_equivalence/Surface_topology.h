// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Surface_topology.h
/// What a surface is made of: its connected components, and of each the numbers of elements, its borders and its handles.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_SURFACE_TOPOLOGY_H
#define CGAL_CONFORMAL_EQUIVALENCE_SURFACE_TOPOLOGY_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceStatus
/// What a surface is made of, as found on import.
struct Surface_topology
{
  std::size_t number_of_vertices = 0;          ///< isolated ones included
  std::size_t number_of_edges = 0;             ///< edges with a face
  std::size_t number_of_faces = 0;             ///< triangles
  std::size_t number_of_isolated_vertices = 0; ///< vertices without a face: carried through untouched
  std::size_t number_of_components = 0;        ///< of the faces
  std::size_t number_of_borders = 0;           ///< border cycles
  std::size_t genus = 0;                       ///< sum over the components

  /// returns `true` iff the surface is one topological disk, apart from isolated vertices.
  bool is_disk() const
  {
    return number_of_components == 1 && number_of_borders == 1 && genus == 0;
  }
};

/// \ingroup PkgConformalEquivalenceMetric
///
/// The pieces that a surface is made of: its connected components, numbered in
/// the order of their first face, with what they have of each kind.
struct Surface_components
{
  std::vector<std::uint32_t> component_of_vertex;  ///< `null_index` for isolated vertices

  /// One connected component.
  struct Component
  {
    std::uint32_t first_face = 0;         ///< its face with the smallest index
    std::size_t number_of_vertices = 0;   ///< its vertices
    std::size_t number_of_edges = 0;      ///< its edges
    std::size_t number_of_faces = 0;      ///< its triangles
    std::size_t number_of_borders = 0;    ///< its border cycles

    /// the Euler characteristic |T| - |E| + |V|.
    std::ptrdiff_t euler_characteristic() const
    {
      return std::ptrdiff_t(number_of_faces) - std::ptrdiff_t(number_of_edges) + std::ptrdiff_t(number_of_vertices);
    }
    /// the number of handles.
    std::size_t genus() const
    {
      return std::size_t((2 - euler_characteristic() - std::ptrdiff_t(number_of_borders)) / 2);
    }
    /// `true` iff it has one border and no handle.
    bool is_disk() const { return number_of_borders == 1 && euler_characteristic() == 1; }
    /// `true` iff it is closed and has one handle.
    bool is_torus() const { return number_of_borders == 0 && euler_characteristic() == 0; }
  };
  std::vector<Component> components;               ///< in the order of their first face
  std::size_t number_of_isolated_vertices = 0;     ///< vertices without a face
};

/// \ingroup PkgConformalEquivalenceMetric
///
/// finds the connected components of `t`. Linear time.
/// \pre no vertex is in `non_manifold_vertices(t)`.
template <typename NT>
Surface_components connected_components(const Intrinsic_triangulation<NT>& t)
{
  typedef typename Intrinsic_triangulation<NT>::Index Index;
  const Index null_index = Intrinsic_triangulation<NT>::null_index;

  Surface_components result;
  std::vector<Index> component_of_face(t.number_of_faces(), null_index), stack;
  const auto enter = [&](Index f, Index component)
  {
    if(component_of_face[f] != null_index)
      return;
    component_of_face[f] = component;
    stack.push_back(f);
  };
  for(Index first = 0; first < t.number_of_faces(); ++first)
  {
    if(component_of_face[first] != null_index)
      continue;
    const Index component = Index(result.components.size());
    result.components.emplace_back();
    result.components.back().first_face = first;
    enter(first, component);
    while(!stack.empty())
    {
      const Index f = stack.back();
      stack.pop_back();
      for(const Index h : t.halfedges(f))
        if(!t.is_border(h))
          enter(t.face(t.twin(h)), component);
    }
  }

  std::vector<Index>& label = result.component_of_vertex;
  label.assign(t.number_of_vertices(), null_index);
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
    label[t.origin(h)] = component_of_face[t.face(h)];
  for(Index v = 0; v < t.number_of_vertices(); ++v)
  {
    if(label[v] == null_index)
      ++result.number_of_isolated_vertices;
    else
      ++result.components[label[v]].number_of_vertices;
  }
  for(Index f = 0; f < t.number_of_faces(); ++f)
    ++result.components[component_of_face[f]].number_of_faces;
  for(Index e = 0; e < t.number_of_edges(); ++e)
    ++result.components[component_of_face[t.face(t.edge_halfedge(e))]].number_of_edges;

  std::vector<char> seen(t.number_of_halfedges(), 0);
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
  {
    if(!t.is_border(h) || seen[h])
      continue;
    ++result.components[component_of_face[t.face(h)]].number_of_borders;
    for(Index b = h; !seen[b]; b = t.next_on_border(b))
      seen[b] = 1;
  }
  return result;
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// returns the sums of what `connected_components(t)` found.
template <typename NT>
Surface_topology surface_topology(const Intrinsic_triangulation<NT>& t, const Surface_components& pieces)
{
  Surface_topology result;
  result.number_of_vertices = t.number_of_vertices();
  result.number_of_edges = t.number_of_edges();
  result.number_of_faces = t.number_of_faces();
  result.number_of_isolated_vertices = pieces.number_of_isolated_vertices;
  result.number_of_components = pieces.components.size();
  for(const Surface_components::Component& c : pieces.components)
  {
    result.number_of_borders += c.number_of_borders;
    result.genus += c.genus();
  }
  return result;
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// returns the same for a single component.
inline Surface_topology surface_topology(const Surface_components::Component& component)
{
  Surface_topology result;
  result.number_of_vertices = component.number_of_vertices;
  result.number_of_edges = component.number_of_edges;
  result.number_of_faces = component.number_of_faces;
  result.number_of_components = 1;
  result.number_of_borders = component.number_of_borders;
  result.genus = component.genus();
  return result;
}

/// \ingroup PkgConformalEquivalenceMetric
///
/// returns the vertices of `t` whose triangles form more than one fan (where the
/// surface touches itself in a point). Linear time.
template <typename NT>
std::vector<std::uint32_t> non_manifold_vertices(const Intrinsic_triangulation<NT>& t)
{
  typedef typename Intrinsic_triangulation<NT>::Index Index;
  std::vector<Index> corners(t.number_of_vertices(), 0), result;
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
    ++corners[t.origin(h)];
  for(Index v = 0; v < t.number_of_vertices(); ++v)
    if(t.degree(v) != corners[v])
      result.push_back(v);
  return result;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template Surface_components connected_components(const Intrinsic_triangulation<double>&);
extern template Surface_topology surface_topology(const Intrinsic_triangulation<double>&, const Surface_components&);
extern template std::vector<std::uint32_t> non_manifold_vertices(const Intrinsic_triangulation<double>&);
#endif

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_SURFACE_TOPOLOGY_H
