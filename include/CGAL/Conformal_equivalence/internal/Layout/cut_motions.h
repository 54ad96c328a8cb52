// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The motions of the plane by which a layout goes on across the edges that are cut, and the lattices of flat tori.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_CUT_MOTIONS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_CUT_MOTIONS_H

#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Layout/Development.h>
#include <CGAL/Conformal_equivalence/internal/Layout/period_lattice.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/pieces.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/wedges.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The motion across the cut edge of h.
template <typename NT>
Cut_motion<typename Developed_surface<NT>::Wide>
find_motion(const Intrinsic_triangulation<NT>& t, const Wedges& wedges, const std::vector<std::uint32_t>& piece_of_face,
            const Developed_surface<NT>& development, std::uint32_t h)
{
  typedef typename Developed_surface<NT>::Wide Wide;
  typedef typename Developed_surface<NT>::Complex Complex;
  using std::sqrt;
  const std::uint32_t g = t.twin(h);
  const auto corner = [&](std::uint32_t i) -> const Complex& { return development.position[wedges.of_corner[i]]; };
  const Complex &p = corner(t.previous(h)), &q = corner(h), &p2 = corner(g), &q2 = corner(t.previous(g));
  const Complex edge = q - p, edge2 = q2 - p2;
  const double length = size_of(edge);
  const Complex side{Wide(edge.re / length), Wide(edge.im / length)}, side2{Wide(edge2.re / length), Wide(edge2.im / length)};
  Complex r = side2 / side;
  const Wide size = sqrt(square_norm(r));
  r = {Wide(r.re / size), Wide(r.im / size)};
  return {piece_of_face[t.face(h)], piece_of_face[t.face(g)], r, p2 - r * p, length};
}

// The pieces of each component by themselves, so that work on one component is no work on all of them.
struct Pieces_of_components
{
  std::vector<std::uint32_t> number_in_component; // by piece
  std::vector<std::uint32_t> number_of_pieces;    // by component

  template <typename NT>
  Pieces_of_components(const Intrinsic_triangulation<NT>& t, const Surface_components& surface, const std::vector<std::uint32_t>& piece_of_face,
                       std::uint32_t number_of_all)
    : number_in_component(number_of_all, t.null_index), number_of_pieces(surface.components.size(), 0)
  {
    for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
    {
      std::uint32_t& number = number_in_component[piece_of_face[f]];
      if(number == t.null_index)
        number = number_of_pieces[surface.component_of_vertex[t.origin(t.halfedge(f))]]++;
    }
  }
};

// The motions across the cut edges between faces that are laid out, and the lattices of the flat tori.
template <typename NT>
void find_transitions(const Intrinsic_triangulation<NT>& t, const Cut_graph& cut, const Wedges& wedges,
                      const Developed_surface<NT>& development, Layout<NT>& layout)
{
  typedef Cut_motion<typename Developed_surface<NT>::Wide> Motion;
  const auto rounded = [](const auto& z) { return std::array<NT, 2>{{static_cast<NT>(z.re), static_cast<NT>(z.im)}}; };
  std::uint32_t number_of_pieces = 0;
  const std::vector<std::uint32_t> piece_of_face = pieces_of_faces(t, cut, number_of_pieces);
  const Surface_components surface = connected_components(t);
  const Pieces_of_components pieces(t, surface, piece_of_face, number_of_pieces);
  std::vector<std::vector<Motion> > motions_of_torus(surface.components.size());

  for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
  {
    const std::uint32_t h = t.edge_halfedge(e), c = surface.component_of_vertex[t.origin(h)];
    if(!cut[e] || t.is_border(h) || !development.is_laid_out[t.face(h)] || !development.is_laid_out[t.face(t.twin(h))])
      continue;
    Motion motion = find_motion(t, wedges, piece_of_face, development, h);
    layout.transitions.push_back({h, rounded(motion.rotation), rounded(motion.translation)});
    if(!surface.components[c].is_torus())
      continue;
    motion.from_piece = pieces.number_in_component[motion.from_piece];
    motion.to_piece = pieces.number_in_component[motion.to_piece];
    motions_of_torus[c].push_back(motion);
  }
  for(std::size_t c = 0; c < motions_of_torus.size(); ++c)
  {
    if(motions_of_torus[c].empty())
      continue;
    const std::uint32_t first = surface.components[c].first_face;
    const auto basis = period_basis(motions_of_torus[c], pieces.number_in_component[piece_of_face[first]], pieces.number_of_pieces[c]);
    if(!basis.is_complete())
      continue;
    const auto periods = basis.standard_basis();
    layout.lattices.push_back({first, {{rounded(periods.first), rounded(periods.second)}},
                               rounded(periods.second / periods.first)});
  }
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_CUT_MOTIONS_H
