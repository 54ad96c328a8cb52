// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGULATION_PIECES_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGULATION_PIECES_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/wedges.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// What the cuts leave connected: laid out one by one.
struct Piece
{
  std::uint32_t central_face;          // the farthest from borders and cuts: from there nothing else is far
  std::vector<std::uint32_t> faces;    // in increasing order
  std::vector<std::uint32_t> wedges;   // in increasing order
};

// By face: the number of its piece. Pieces are numbered in the order of their first faces.
template <typename NT, typename Edge_set>
std::vector<std::uint32_t> pieces_of_faces(const Intrinsic_triangulation<NT>& t, const Edge_set& cut,
                                           std::uint32_t& number_of_pieces)
{
  typedef std::uint32_t Index;
  std::vector<Index> piece(t.number_of_faces(), t.null_index), stack;
  number_of_pieces = 0;
  for(Index first = 0; first < t.number_of_faces(); ++first)
  {
    if(piece[first] != t.null_index)
      continue;
    piece[first] = number_of_pieces;
    stack.push_back(first);
    while(!stack.empty())
    {
      const Index f = stack.back();
      stack.pop_back();
      for(const Index h : t.halfedges(f))
      {
        if(t.is_border(h) || cut[t.edge(h)] || piece[t.face(t.twin(h))] != t.null_index)
          continue;
        piece[t.face(t.twin(h))] = number_of_pieces;
        stack.push_back(t.face(t.twin(h)));
      }
    }
    ++number_of_pieces;
  }
  return piece;
}

// All faces, in the order of their distances, in steps of the dual graph, from all borders and cuts.
template <typename NT, typename Edge_set>
std::vector<std::uint32_t> faces_from_outside(const Intrinsic_triangulation<NT>& t, const Edge_set& cut)
{
  typedef std::uint32_t Index;
  std::vector<char> seen(t.number_of_faces(), 0);
  std::vector<Index> queue;
  queue.reserve(t.number_of_faces());
  const auto enter = [&](Index f) { if(!seen[f]) { seen[f] = 1; queue.push_back(f); } };
  std::size_t done = 0;
  const auto spread = [&]
  {
    for(; done < queue.size(); ++done)
      for(const Index h : t.halfedges(queue[done]))
        if(!t.is_border(h))
          enter(t.face(t.twin(h)));
  };
  for(Index h = 0; h < t.number_of_halfedges(); ++h)
    if(t.is_border(h) || cut[t.edge(h)])
      enter(t.face(h));
  spread();
  for(Index f = 0; f < t.number_of_faces(); ++f) // components without border and cut
  {
    enter(f);
    spread();
  }
  return queue;
}

template <typename NT, typename Edge_set>
std::vector<Piece> find_pieces(const Intrinsic_triangulation<NT>& t, const Edge_set& cut, const Wedges& wedges)
{
  typedef std::uint32_t Index;
  Index n = 0;
  const std::vector<Index> piece_of_face = pieces_of_faces(t, cut, n);
  std::vector<Piece> pieces(n);
  for(Index f : faces_from_outside(t, cut))
    pieces[piece_of_face[f]].central_face = f;
  std::vector<Index> piece_of_wedge(wedges.number_of_wedges, n);
  for(Index f = 0; f < t.number_of_faces(); ++f)
  {
    pieces[piece_of_face[f]].faces.push_back(f);
    for(const Index h : t.halfedges(f))
      piece_of_wedge[wedges.of_corner[h]] = piece_of_face[f];
  }
  for(Index w = 0; w < wedges.number_of_wedges; ++w)
    pieces[piece_of_wedge[w]].wedges.push_back(w);
  return pieces;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_TRIANGULATION_PIECES_H
