// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/merge_refinements.h"

#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/multiprecision.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace flattening {

namespace {

typedef std::uint32_t Index;

// Adds one component, with the numbers that its elements have in the whole.
template <typename NT>
class Component_appender
{
  typedef CE::Common_refinement<NT> Parts;

public:
  Component_appender(const Component_mesh& part, Merged_refinement<NT>& merged)
    : part_(part), merged_(merged), whole_(merged.parts), first_crossing_(merged.parts.number_of_vertices())
  {}

  // `edges`: those of the whole, by edge of the component.
  void append(const Parts& found, const std::vector<Index>& edges)
  {
    append_crossings(found, edges);
    append_weights(found);
    for(Index f = 0; f < found.number_of_faces(); ++f)
    {
      for(std::size_t c = found.first_corner[f]; c < found.first_corner[f + 1]; ++c)
        add_corner(vertex(found, found.corner_vertex[c]), found.corner_uv[c],
                   found.corner_halfedge[c] == found.null_index ? found.null_index : halfedge(found.corner_halfedge[c]));
      add_face(found.input_face[f], found.flat_face[f]);
    }
    if(found.number_of_faces() != 0)
      merged_.number_of_flat_faces += *std::max_element(found.flat_face.begin(), found.flat_face.end()) + 1;
  }

  // The triangles as they are; `corner(h)` is the point of the target of `h`.
  template <typename Corner>
  void append_triangles(const Vertex_map<double>& weight, Corner corner)
  {
    const Mesh& mesh = part_.mesh;
    for(Vertex v : mesh.vertices())
      whole_.weights[vertex_of_whole(v.idx())] = NT(weight[v]);
    for(Face f : mesh.faces())
    {
      Halfedge h = mesh.halfedge(f);
      for(Index k = 0; k < 3; ++k, h = mesh.next(h))
        add_corner(vertex_of_whole(mesh.source(h).idx()), corner(mesh.prev(h)), halfedge(3 * Index(f.idx()) + k));
      add_face(f.idx(), f.idx());
    }
    merged_.number_of_flat_faces += static_cast<Index>(mesh.number_of_faces());
  }

private:
  void append_crossings(const Parts& found, const std::vector<Index>& edges)
  {
    Index number_of_flat_edges = 0;
    for(auto crossing : found.crossings)
    {
      number_of_flat_edges = (std::max)(number_of_flat_edges, crossing.flat_edge + 1);
      crossing.input_edge = edges[crossing.input_edge];
      crossing.flat_edge += merged_.number_of_flat_edges;
      whole_.crossings.push_back(crossing);
    }
    merged_.number_of_flat_edges += number_of_flat_edges;
  }

  void append_weights(const Parts& found)
  {
    const Index n = found.number_of_input_vertices;
    for(Index v = 0; v < n; ++v)
    {
      whole_.weights[vertex_of_whole(v)] = found.weights[v];
      if(! found.angle_sums.empty())
        whole_.angle_sums[vertex_of_whole(v)] = found.angle_sums[v];
    }
    whole_.weights.insert(whole_.weights.end(), found.weights.begin() + n, found.weights.end());
  }

  Index vertex_of_whole(std::size_t v) const { return static_cast<Index>(part_.vertices[v].idx()); }
  Index face_of_whole(std::size_t f) const { return static_cast<Index>(part_.faces[f].idx()); }

  // Halfedges as triangulations number them.
  Index halfedge(Index h) const { return 3 * face_of_whole(h / 3) + h % 3; }

  Index vertex(const Parts& found, Index v) const
  {
    return v < found.number_of_input_vertices ? vertex_of_whole(v) : first_crossing_ + (v - found.number_of_input_vertices);
  }

  void add_corner(Index vertex, const std::array<NT, 2>& uv, Index halfedge)
  {
    whole_.corner_vertex.push_back(vertex);
    whole_.corner_uv.push_back(uv);
    whole_.corner_halfedge.push_back(halfedge);
  }

  void add_face(std::size_t input_face, std::size_t flat_face)
  {
    whole_.input_face.push_back(face_of_whole(input_face));
    whole_.flat_face.push_back(merged_.number_of_flat_faces + static_cast<Index>(flat_face));
    whole_.first_corner.push_back(whole_.corner_vertex.size());
  }

  const Component_mesh& part_;
  Merged_refinement<NT>& merged_;
  Parts& whole_;
  const Index first_crossing_;
};

template <typename NT>
void begin(std::size_t number_of_vertices, Merged_refinement<NT>& merged)
{
  merged.parts.number_of_input_vertices = static_cast<Index>(number_of_vertices);
  merged.parts.weights.assign(number_of_vertices, NT(1));
  merged.parts.angle_sums.assign(number_of_vertices, 0.);
  merged.parts.first_corner.assign(1, 0);
}

template <typename NT>
void append_crossings(std::size_t first, const std::vector<std::array<NT, 3> >& found, std::vector<std::array<NT, 3> >& whole)
{
  if(found.size() > first)
    whole.insert(whole.end(), found.begin() + std::ptrdiff_t(first), found.end());
}

// The points of the whole, followed by those of crossings.
template <typename NT>
std::vector<std::array<NT, 3> > with_crossings(std::vector<std::array<NT, 3> > points, const std::vector<std::array<NT, 3> >& crossings)
{
  if(! points.empty())
    points.insert(points.end(), crossings.begin(), crossings.end());
  return points;
}

} // namespace

Refinement_merger::Refinement_merger(Results& whole) : whole_(whole)
{
  begin(whole.given.mesh.number_of_vertices(), merged_);
  begin(whole.given.mesh.number_of_vertices(), wide_);
}

void Refinement_merger::append(const Component_mesh& part, const Results& found, bool is_refined)
{
  is_any_refined_ = is_any_refined_ || is_refined;
  const bool is_wide = found.given.wide.is_used;
  Component_appender<double> in_double(part, merged_);
  Component_appender<CE::Multiprecision_number> wide(part, wide_);
  if(is_refined)
  {
    const std::vector<Index> edges = edges_of_whole(part);
    in_double.append(found.refinement, edges);
    if(is_wide)
      wide.append(found.given.wide.refinement, edges);
    append_crossings(part.vertices.size(), found.made.image, crossings_);
    append_crossings(part.vertices.size(), found.made.wide_image, wide_crossings_);
    return;
  }
  in_double.append_triangles(found.given.weight, [&](Halfedge h)
    { return std::array<double, 2>{{ found.given.uv[h].x(), found.given.uv[h].y() }}; });
  if(is_wide)
    wide.append_triangles(found.given.weight, [&](Halfedge h)
      { return std::array<CE::Multiprecision_number, 2>{{ found.given.wide.uv[h].x(), found.given.wide.uv[h].y() }}; });
}

void Refinement_merger::finish()
{
  if(! is_any_refined_)
    return;
  whole_.refinement = std::move(merged_.parts);
  if(whole_.given.wide.is_used)
    whole_.given.wide.refinement = std::move(wide_.parts);
  whole_.made.image = with_crossings(whole_.given.image, crossings_);
  whole_.made.wide_image = with_crossings(whole_.given.wide_image, wide_crossings_);
}

// Edges are numbered in the order of their first halfedges, which is the same in the whole.
std::vector<Index> Refinement_merger::edges_of_whole(const Component_mesh& part)
{
  if(edge_of_halfedge_.empty())
  {
    const CE::Imported_mesh<Mesh> whole(whole_.given.mesh);
    for(Index h = 0; h < whole.triangulation.number_of_halfedges(); ++h)
      edge_of_halfedge_.push_back(whole.triangulation.edge(h));
  }
  const CE::Imported_mesh<Mesh> imported(part.mesh);
  std::vector<Index> result;
  for(Index e = 0; e < imported.triangulation.number_of_edges(); ++e)
  {
    const Index h = imported.triangulation.edge_halfedge(e);
    result.push_back(edge_of_halfedge_[3 * part.faces[h / 3].idx() + h % 3]);
  }
  return result;
}

} // namespace flattening
