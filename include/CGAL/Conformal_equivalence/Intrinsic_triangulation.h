// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Intrinsic_triangulation.h
/// A triangulated surface that knows no coordinates: triangles glued along
/// edges, one length an edge (section 2 of Springborn, Schroeder and Pinkall,
/// 2008: the abstract triangulation M = (V, E, T) and a discrete metric on it).
/// Everything between import and export runs on these flat arrays.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTRINSIC_TRIANGULATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTRINSIC_TRIANGULATION_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceMetric
///
/// An oriented triangulated surface with a length on every edge, held in flat
/// arrays of 32-bit indices.
///
/// The surface is a Delta-complex: a triangle may be glued to itself, two
/// triangles may share several edges, and an edge may begin and end at one
/// vertex. Halfedge `3f + k` is the `k`-th side of face `f`; it runs from
/// `origin(h)` to `target(h)` with the face on its left. A halfedge on the
/// border has no twin; there are no halfedges outside of the surface.
/// Vertices without a face (isolated vertices) are allowed.
///
/// \tparam NT_ the number type of the lengths: `double`, `long double` or a
///         Boost.Multiprecision number.
template <typename NT_ = double>
class Intrinsic_triangulation
{
public:
  typedef NT_ NT;               ///< number type of the lengths
  typedef std::uint32_t Index;  ///< of vertices, halfedges, edges and faces

  /// stands for "no such element".
  static constexpr Index null_index = (std::numeric_limits<Index>::max)();

  /// \name Construction
  /// @{

  /// constructs the empty surface.
  Intrinsic_triangulation() = default;

  /// constructs the surface with `number_of_vertices` vertices whose halfedge
  /// `h` begins at `origin[h]` and is glued to `twin[h]` (`null_index`: border).
  /// Edges are numbered in the order of their first halfedge; all lengths are 1.
  /// Linear time.
  /// \pre `origin.size() == twin.size()` is a multiple of 3; `twin` is an
  ///      involution without fixed points; glued halfedges are opposite.
  Intrinsic_triangulation(Index number_of_vertices, std::vector<Index> origin, std::vector<Index> twin);

  /// returns the surface with the same triangulation and other lengths, of the
  /// number type `Other_NT`.
  template <typename Other_NT>
  Intrinsic_triangulation<Other_NT> with_lengths(std::vector<Other_NT> lengths) const
  {
    CGAL_precondition(lengths.size() == length_.size());
    Intrinsic_triangulation<Other_NT> result;
    result.origin_ = origin_;
    result.twin_ = twin_;
    result.edge_ = edge_;
    result.halfedge_of_edge_ = halfedge_of_edge_;
    result.halfedge_of_vertex_ = halfedge_of_vertex_;
    result.length_ = std::move(lengths);
    return result;
  }

  /// @}
  /// \name Elements
  /// @{

  Index number_of_vertices() const { return Index(halfedge_of_vertex_.size()); } ///< isolated ones included
  Index number_of_halfedges() const { return Index(origin_.size()); }            ///< three for each face
  Index number_of_edges() const { return Index(halfedge_of_edge_.size()); }      ///< inside and on the border
  Index number_of_faces() const { return Index(origin_.size() / 3); }            ///< triangles

  static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }     ///< the next side of the face, counterclockwise
  static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; } ///< the next side of the face, clockwise
  static Index face(Index h) { return h / 3; }                          ///< the face on the left of `h`
  static Index halfedge(Index f, Index k = 0) { return 3 * f + k; }     ///< the side `k` of the face `f`, one of 0, 1, 2
  static Index position_in_face(Index h) { return h % 3; }              ///< the `k` of `h`

  /// returns the three sides of the face `f`, counterclockwise.
  static std::array<Index, 3> halfedges(Index f) { return {{halfedge(f), halfedge(f, 1), halfedge(f, 2)}}; }

  Index origin(Index h) const { return origin_[h]; }                    ///< the vertex where `h` begins
  Index target(Index h) const { return origin_[next(h)]; }              ///< the vertex where `h` ends
  Index apex(Index h) const { return origin_[previous(h)]; }   ///< the vertex of the face opposite to `h`
  Index twin(Index h) const { return twin_[h]; }               ///< `null_index` on the border
  Index edge(Index h) const { return edge_[h]; }               ///< the edge of `h`
  Index edge_halfedge(Index e) const { return halfedge_of_edge_[e]; } ///< the halfedge of `e` with the smaller index

  /// a halfedge that begins at `v`: for a border vertex the one on the border,
  /// `null_index` for an isolated vertex.
  Index vertex_halfedge(Index v) const { return halfedge_of_vertex_[v]; }

  bool is_border(Index h) const { return twin_[h] == null_index; } ///< `true` iff `h` has no twin
  bool is_border_edge(Index e) const { return is_border(halfedge_of_edge_[e]); } ///< `true` iff `e` has one face

  /// `true` iff `v` has no face.
  bool is_isolated_vertex(Index v) const { return halfedge_of_vertex_[v] == null_index; }
  /// `true` iff `v` lies on an edge with one face.
  bool is_border_vertex(Index v) const { return !is_isolated_vertex(v) && is_border(halfedge_of_vertex_[v]); }

  /// the next halfedge that begins at `origin(h)`, counterclockwise;
  /// `null_index` past the last triangle of a border vertex.
  Index next_around_origin(Index h) const { return twin_[previous(h)]; }

  /// calls `visit(h)` for every halfedge that begins at `v` and has a face on
  /// its left, counterclockwise.
  template <typename Visit>
  void for_each_outgoing(Index v, Visit visit) const
  {
    const Index first = halfedge_of_vertex_[v];
    for(Index h = first; h != null_index; )
    {
      visit(h);
      h = next_around_origin(h);
      if(h == first)
        break;
    }
  }

  /// the number of triangle corners at `v`.
  Index degree(Index v) const
  {
    Index result = 0;
    for_each_outgoing(v, [&](Index) { ++result; });
    return result;
  }

  /// the border halfedge that follows the border halfedge `h` along its border,
  /// with the surface on the left.
  Index next_on_border(Index h) const
  {
    CGAL_precondition(is_border(h));
    return halfedge_of_vertex_[target(h)];
  }

  /// @}
  /// \name Lengths
  /// @{

  const NT& length(Index e) const { return length_[e]; }                  ///< of the edge `e`
  const NT& halfedge_length(Index h) const { return length_[edge_[h]]; }  ///< of the edge of `h`
  void set_length(Index e, const NT& l) { length_[e] = l; }               ///< changes the length of the edge `e`
  const std::vector<NT>& lengths() const { return length_; }              ///< by edge

  /// @}
  /// \name Flips
  /// @{

  /// is `true` iff `e` can be flipped: it has two faces, and these are not the same.
  bool is_flippable(Index e) const
  {
    const Index h = halfedge_of_edge_[e];
    return !is_border(h) && face(h) != face(twin_[h]);
  }

  /// replaces the edge `e`, one diagonal of the quadrilateral made of its two faces, by the other diagonal, of length `length`.
  /// The edge keeps its index, and the two faces and the six halfedges are used again; with `h = edge_halfedge(e)` and
  /// `g = twin(h)`:
  ///
  ///                 k                             k
  ///               /   \                         / | \          Afterwards h runs from l to k, on the left of
  ///          p  /       \  n               p  /   |   \  n      it the triangle l, k, i, and g from k to l with
  ///           / face(h)   \                 /     |     \       k, l, j. What was next(h), previous(h),
  ///         i ----- h ----> j             i       h^      j     next(g), previous(g) becomes previous(g),
  ///           \ face(g)   /                 \     |     /       next(h), previous(h), next(g).
  ///          m  \       /  q               m  \   |   /  q
  ///               \   /                         \ | /
  ///                 l                             l
  ///
  /// Loops and multiple edges may arise. O(1).
  /// \pre `is_flippable(e)`
  void flip_edge(Index e, const NT& length)
  {
    CGAL_precondition(is_flippable(e));
    const Index h = halfedge_of_edge_[e], g = twin_[h];
    const Index k = apex(h), l = apex(g);
    const std::array<Index, 4> from = {{next(h), previous(h), next(g), previous(g)}},
                               to = {{previous(g), next(h), previous(h), next(g)}};
    const std::array<Index, 4> outer_origin = {{origin_[from[0]], origin_[from[1]], origin_[from[2]], origin_[from[3]]}},
                               outer_twin = {{twin_[from[0]], twin_[from[1]], twin_[from[2]], twin_[from[3]]}},
                               outer_edge = {{edge_[from[0]], edge_[from[1]], edge_[from[2]], edge_[from[3]]}};
    const auto moved = [&](Index a)
    {
      for(std::size_t s = 0; s < 4; ++s)
        if(a == from[s])
          return to[s];
      return a;
    };
    std::array<Index, 4> outgoing; // of the vertices where the outer sides begin, as it will be
    for(std::size_t s = 0; s < 4; ++s)
    {
      const Index o = halfedge_of_vertex_[outer_origin[s]];
      outgoing[s] = o == h || o == g ? to[s] : moved(o);
    }
    for(std::size_t s = 0; s < 4; ++s)
    {
      origin_[to[s]] = outer_origin[s];
      edge_[to[s]] = outer_edge[s];
      twin_[to[s]] = outer_twin[s] == null_index ? null_index : moved(outer_twin[s]);
    }
    for(std::size_t s = 0; s < 4; ++s)
    {
      if(twin_[to[s]] != null_index)
        twin_[twin_[to[s]]] = to[s];
      halfedge_of_edge_[outer_edge[s]] = (std::min)(to[s], twin_[to[s]]);
      halfedge_of_vertex_[outer_origin[s]] = outgoing[s];
    }
    origin_[h] = l;
    origin_[g] = k;
    length_[e] = length;
  }

  /// @}
  /// \name Splits
  /// @{

  /// splits the edge `e` by a new vertex m, the one with the number `number_of_vertices()` before, which is joined with the vertices
  /// opposite to `e`. What is new gets the next numbers; with `h = edge_halfedge(e)`, `g = twin(h)`, and `F` and `E` faces and edges before:
  ///
  ///                 k                             k
  ///               /   \                         / | \          h runs from i to m, on the left of it the triangle i, m, k; the edge im
  ///             /       \                     /   |   \        keeps the number e. The face F is m, j, k, its first side
  ///           / face(h)   \                 / f(h)|  F  \      from m to j. If g exists, it runs from j to m, on the left of it
  ///         i ----- h ----> j             i --h-> m <-g-- j     the triangle j, m, l; the face F + 1 is m, i, l, its
  ///           \ face(g)   /                 \ F+1 | f(g)/       first side from m to i. The edges mj, mk and ml
  ///             \       /                     \   |   /         are E, E + 1 and E + 2.
  ///               \   /                         \ | /
  ///                 l                             l
  ///
  /// O(1), amortized.
  /// \param e an edge
  /// \param lengths those of im, mj, mk and ml; the last one does not count if `e` is a border edge
  /// \return the new vertex
  /// \pre `is_border_edge(e) || is_flippable(e)`
  Index split_edge(Index e, const std::array<NT, 4>& lengths)
  {
    CGAL_precondition(is_border_edge(e) || is_flippable(e));
    const Index h = halfedge_of_edge_[e], g = twin_[h];
    const Index m = number_of_vertices(), first_edge = number_of_edges();
    halfedge_of_vertex_.push_back(null_index);
    halfedge_of_edge_.push_back(null_index);
    length_[e] = lengths[0];
    length_.push_back(lengths[1]);
    const Index beyond = split_face(h, m, lengths[2]); // from m to j
    halfedge_of_vertex_[m] = beyond;
    if(g == null_index)
      glue(beyond, null_index, first_edge);
    else
    {
      const Index back = split_face(g, m, lengths[3]); // from m to i
      glue(h, back, e);
      glue(beyond, g, first_edge);
    }
    return m;
  }

  /// @}

private:
  template <typename> friend class Intrinsic_triangulation;

  // Cuts the face of `h` in two, from the vertex `m` on `h` to the apex, by a new edge: `h` ends at `m`, and the new face, which is returned
  // by its first halfedge, is m, old target of `h`, apex. That halfedge is glued to nothing yet.
  Index split_face(Index h, Index m, const NT& length)
  {
    const Index x = next(h), first = number_of_halfedges(), y = first + 1, e = number_of_edges();
    const Index j = origin_[x], k = apex(h);
    for(const Index v : {m, j, k})
      origin_.push_back(v);
    twin_.insert(twin_.end(), {null_index, twin_[x], x});
    edge_.insert(edge_.end(), {null_index, edge_[x], e});
    glue(y, twin_[x], edge_[x]); // in the place of x
    if(halfedge_of_vertex_[j] == x)
      halfedge_of_vertex_[j] = y;
    origin_[x] = m;
    halfedge_of_edge_.push_back(x);
    length_.push_back(length);
    glue(x, y + 1, e);
    return first;
  }

  // Makes `h` and `g` the sides of the edge `e`; `g` may be `null_index`.
  void glue(Index h, Index g, Index e)
  {
    twin_[h] = g;
    edge_[h] = e;
    if(g != null_index)
    {
      twin_[g] = h;
      edge_[g] = e;
    }
    halfedge_of_edge_[e] = (std::min)(h, g);
  }

  void number_edges()
  {
    edge_.assign(origin_.size(), null_index);
    for(Index h = 0; h < number_of_halfedges(); ++h)
    {
      if(edge_[h] != null_index)
        continue;
      edge_[h] = number_of_edges();
      if(!is_border(h))
        edge_[twin_[h]] = edge_[h];
      halfedge_of_edge_.push_back(h);
    }
  }

  void find_outgoing_halfedges(Index number_of_vertices)
  {
    halfedge_of_vertex_.assign(number_of_vertices, null_index);
    for(Index h = 0; h < number_of_halfedges(); ++h)
    {
      Index& outgoing = halfedge_of_vertex_[origin_[h]];
      if(outgoing == null_index || is_border(h))
        outgoing = h;
    }
  }

  std::vector<Index> origin_, twin_, edge_;   // by halfedge
  std::vector<Index> halfedge_of_edge_;
  std::vector<Index> halfedge_of_vertex_;
  std::vector<NT> length_;                    // by edge
};

template <typename NT>
Intrinsic_triangulation<NT>::Intrinsic_triangulation(Index number_of_vertices, std::vector<Index> origin, std::vector<Index> twin)
  : origin_(std::move(origin)), twin_(std::move(twin))
{
  CGAL_precondition(origin_.size() == twin_.size() && origin_.size() % 3 == 0);
  number_edges();
  find_outgoing_halfedges(number_of_vertices);
  length_.assign(halfedge_of_edge_.size(), NT(1));
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template Intrinsic_triangulation<double>::Intrinsic_triangulation(std::uint32_t, std::vector<std::uint32_t>,
                                                                         std::vector<std::uint32_t>);
#endif

/// \ingroup PkgConformalEquivalenceMetric
///
/// returns the halfedges' twins that glue `triangles` (given by vertex indices,
/// counterclockwise) along the sides they share, for the constructor of
/// `Intrinsic_triangulation`. Halfedges that would be glued to more than one
/// other, or to one of the same direction, are written to `non_manifold` and left
/// unglued. O(n log n).
inline std::vector<std::uint32_t> glue_triangles(const std::vector<std::array<std::uint32_t, 3> >& triangles,
                                                 std::vector<std::uint32_t>* non_manifold = nullptr)
{
  typedef std::uint32_t Index;
  const Index null_index = Intrinsic_triangulation<>::null_index;
  struct Side { Index low, high, halfedge; };
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for(const std::array<Index, 3>& t : triangles)
    for(int k = 0; k < 3; ++k)
      sides.push_back({(std::min)(t[k], t[(k + 1) % 3]), (std::max)(t[k], t[(k + 1) % 3]), Index(sides.size())});
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b)
            { return std::tie(a.low, a.high, a.halfedge) < std::tie(b.low, b.high, b.halfedge); });

  std::vector<Index> twin(sides.size(), null_index);
  for(std::size_t first = 0, last; first < sides.size(); first = last)
  {
    for(last = first + 1; last < sides.size() && sides[last].low == sides[first].low
                                              && sides[last].high == sides[first].high; ++last) {}
    const Index a = sides[first].halfedge, b = sides[last - 1].halfedge;
    const auto origin = [&](Index h) { return triangles[h / 3][h % 3]; };
    if(last - first == 2 && origin(a) != origin(b))
    {
      twin[a] = b;
      twin[b] = a;
    }
    else if(last - first >= 2 && non_manifold != nullptr)
      for(std::size_t i = first; i < last; ++i)
        non_manifold->push_back(sides[i].halfedge);
  }
  return twin;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTRINSIC_TRIANGULATION_H
