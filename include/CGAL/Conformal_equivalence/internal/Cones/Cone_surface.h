// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What the search for cones has to know of a surface: the graph of its vertices and edges, with the weights of the Laplacian and curvatures. So it
// may also be one of fewer vertices, on which cones are first searched for (coarse_surface.h).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_SURFACE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_SURFACE_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Number_constants.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Edge_graph.h>
#include <CGAL/Conformal_equivalence/internal/Solver/energy.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

class Cone_surface
{
public:
  typedef std::uint32_t Index;
  enum class Kind : char { INNER, BORDER, ISOLATED };
  struct Neighbour { Index vertex; double length; };

  std::vector<Kind> kind;                      // by vertex
  std::vector<double> degree;                  // by vertex: of triangles
  std::vector<double> curvature;               // by vertex; of inner ones only
  std::vector<double> own_curvature;           // by vertex, without that of others for which it stands
  std::vector<double> blur;                    // by vertex: what u there is less than it would be, by curvature of its own
  Index ground = 0;                            // the vertex that is grounded if there is no border: that of metrics, so that patterns are the same
  Vertex_vector u;                             // the scale that curvatures and weights are of
  std::vector<std::pair<Index, Index> > ends;  // by edge
  std::vector<double> weights;                 // by edge, as in Edge_graph.h
  std::vector<double> lengths;                 // by edge
  std::vector<std::size_t> first_neighbour;    // by vertex, and the end
  std::vector<Neighbour> neighbours;

  std::size_t number_of_vertices() const { return kind.size(); }
  bool is_border_vertex(Index v) const { return kind[v] == Kind::BORDER; }
  bool is_inner_vertex(Index v) const { return kind[v] == Kind::INNER; }

  template <typename Visit>
  void for_each_neighbour(Index v, Visit visit) const
  {
    for(std::size_t i = first_neighbour[v]; i < first_neighbour[v + 1]; ++i)
      visit(neighbours[i].vertex, neighbours[i].length);
  }

  // What Edge_graph asks for: a halfedge is twice its edge.
  Index number_of_edges() const { return Index(ends.size()); }
  Index edge_halfedge(Index e) const { return 2 * e; }
  Index origin(Index h) const { return ends[h / 2].first; }
  Index target(Index h) const { return ends[h / 2].second; }
};

// Where there can be cones.
template <typename NT>
std::size_t number_of_inner_vertices(const Intrinsic_triangulation<NT>& t)
{
  std::size_t n = 0;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    n += t.is_isolated_vertex(v) || t.is_border_vertex(v) ? 0 : 1;
  return n;
}

// Once each, in the order in which they are met around the vertices.
template <typename NT>
void add_neighbours(const Intrinsic_triangulation<NT>& t, Cone_surface& s)
{
  typedef typename Intrinsic_triangulation<NT>::Index Index;
  s.neighbours.reserve(2 * std::size_t(t.number_of_edges()));
  for(Index v = 0; v < t.number_of_vertices(); ++v)
  {
    s.first_neighbour.push_back(s.neighbours.size());
    if(t.is_isolated_vertex(v))
      continue;
    t.for_each_outgoing(v, [&](Index h)
    {
      s.neighbours.push_back({t.target(h), static_cast<double>(t.length(t.edge(h)))});
      if(t.is_border_vertex(v) && t.is_border_edge(t.edge(t.previous(h))))
        s.neighbours.push_back({t.apex(h), static_cast<double>(t.length(t.edge(t.previous(h))))});
    });
  }
  s.first_neighbour.push_back(s.neighbours.size());
}

// The surface with the lengths of `t` scaled by u. Returns whether it can be had.
template <typename NT>
bool make_cone_surface(const Intrinsic_triangulation<NT>& t, const Vertex_vector& u, Cone_surface& s)
{
  typedef typename Intrinsic_triangulation<NT>::Index Index;
  Conformal_energy<double, NT> energy(t, true);
  if(!energy.evaluate(u))
    return false;
  s = Cone_surface();
  s.ground = t.origin(0);
  s.u = u;
  s.weights = energy.weights();
  s.curvature.assign(u.size(), 0.);
  for(Index v = 0; v < t.number_of_vertices(); ++v)
  {
    s.kind.push_back(t.is_isolated_vertex(v) ? Cone_surface::Kind::ISOLATED
                     : t.is_border_vertex(v) ? Cone_surface::Kind::BORDER : Cone_surface::Kind::INNER);
    s.degree.push_back(t.is_isolated_vertex(v) ? 0. : double(t.degree(v)));
    if(s.is_inner_vertex(v))
      s.curvature[v] = 2 * Number_constants<double>::pi() - energy.angle_sums()[v];
  }
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    s.ends.emplace_back(t.origin(t.edge_halfedge(e)), t.target(t.edge_halfedge(e)));
    s.lengths.push_back(static_cast<double>(t.length(e)));
  }
  s.own_curvature = s.curvature;
  s.blur.assign(u.size(), 0.);
  add_neighbours(t, s);
  return true;
}

// Edges without weight where those of `other` are, which has the same vertices: then a factor has room for matrices of that, too.
template <typename NT>
void add_room_for(const Intrinsic_triangulation<NT>& other, Cone_surface& s)
{
  typedef typename Intrinsic_triangulation<NT>::Index Index;
  for(Index e = 0; e < other.number_of_edges(); ++e)
  {
    const Index v = other.origin(other.edge_halfedge(e)), w = other.target(other.edge_halfedge(e));
    if(s.ends[e] == std::make_pair(v, w) || s.ends[e] == std::make_pair(w, v))
      continue;
    s.ends.emplace_back(v, w);
    s.weights.push_back(0);
    s.lengths.push_back(static_cast<double>(other.length(e)));
  }
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_CONES_CONE_SURFACE_H
