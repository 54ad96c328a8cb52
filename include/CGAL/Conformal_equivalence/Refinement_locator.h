// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Refinement_locator.h
/// Which point of the surface lies where, by the projective maps of the faces of a common refinement (section 3.4 of Springborn,
/// Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_REFINEMENT_LOCATOR_H
#define CGAL_CONFORMAL_EQUIVALENCE_REFINEMENT_LOCATOR_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Box_tree.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/projective_cell.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// answers where a point of the input surface lies in the layout, and which points of the surface lie at a point of the
/// plane, by the projective maps of the faces of a refinement. Keeps references to the two.
template <typename NT_ = double>
class Refinement_locator
{
public:
  typedef NT_ NT;               ///< number type of the coordinates
  typedef std::uint32_t Index;  ///< of faces

  /// A point of the input surface.
  struct Surface_point
  {
    Index input_face;               ///< the face of the input
    std::array<NT, 3> barycentric;  ///< with sum 1; entry `k` belongs to the origin of the halfedge `3 * input_face + k`
    Index face;                     ///< the face of the refinement
  };

  /// A point of the layout.
  struct Layout_point
  {
    std::array<NT, 2> uv;           ///< where it lies
    Index face;                     ///< the face of the refinement
  };

  /// prepares the queries. O(n log n) for `n` corners.
  /// \param input the triangulation that was given to the solver
  /// \param refinement what `compute_common_refinement()`, or `triangulate_refinement()`, returned for it
  Refinement_locator(const Intrinsic_triangulation<NT>& input, const Common_refinement<NT>& refinement)
    : input_(&input), refinement_(&refinement), tree_(boxes(refinement))
  {
    first_part_.assign(std::size_t(input.number_of_faces()) + 1, 0);
    for(Index f : refinement.input_face)
      ++first_part_[f + 1];
    for(std::size_t f = 0; f < input.number_of_faces(); ++f)
      first_part_[f + 1] += first_part_[f];
    std::vector<std::size_t> next(first_part_.begin(), first_part_.end() - 1);
    part_.resize(refinement.number_of_faces());
    for(Index f = 0; f < refinement.number_of_faces(); ++f)
      part_[next[refinement.input_face[f]]++] = f;
  }

  /// returns where the point with the barycentric coordinates `b` in the face `input_face` of the input lies. Linear in the
  /// number of parts of the face.
  /// \pre `b` has entries >= 0, not all 0; they need not sum up to 1
  Layout_point layout_point(Index input_face, const std::array<NT, 3>& b) const
  {
    Cells cells;
    for(std::size_t i = first_part_[input_face]; i < first_part_[input_face + 1]; ++i)
      add_cell(part_[i], cells);
    const auto point = cells.at(b);
    const std::array<NT, 3> image = point.image();
    return {{{ image[0], image[1] }}, part_[first_part_[input_face] + point.cell]};
  }

  /// returns the points of the surface that lie at `uv`: none outside of the layout, several where it covers itself, and one for each face on
  /// whose boundary `uv` is. Whether a face contains `uv` is decided exactly for `double`. About O(log n), and the number of
  /// faces with bounding boxes around `uv`.
  std::vector<Surface_point> surface_points(const std::array<NT, 2>& uv) const
  {
    std::vector<Surface_point> result;
    tree_.for_each_around({{ static_cast<double>(uv[0]), static_cast<double>(uv[1]) }}, [&](Index f)
    {
      Cells cell;
      add_cell(f, cell);
      cell.for_each_at(uv, [&](const auto& point) { result.push_back({ refinement_->input_face[f], point.preimage(), f }); });
    });
    std::sort(result.begin(), result.end(), [](const Surface_point& a, const Surface_point& b) { return a.face < b.face; });
    return result;
  }

private:
  typedef internal::Projective_cells<NT, NT> Cells;

  static std::vector<internal::Box<2> > boxes(const Common_refinement<NT>& r)
  {
    std::vector<internal::Box<2> > result;
    for(Index f = 0; f < r.number_of_faces(); ++f)
    {
      internal::Box<2> box = internal::Box<2>::empty();
      for(std::size_t c = r.first_corner[f]; c < r.first_corner[f + 1]; ++c)
        box.insert({{ static_cast<double>(r.corner_uv[c][0]), static_cast<double>(r.corner_uv[c][1]) }});
      result.push_back(box);
    }
    return result;
  }

  void add_cell(Index f, Cells& cells) const
  {
    const Common_refinement<NT>& r = *refinement_;
    for(std::size_t c = r.first_corner[f]; c < r.first_corner[f + 1]; ++c)
      cells.add_corner({ input_barycentric(*input_, r, f, c), r.corner_uv[c], r.weights[r.corner_vertex[c]] });
    cells.end_cell();
  }

  const Intrinsic_triangulation<NT>* input_;
  const Common_refinement<NT>* refinement_;
  internal::Box_tree<2> tree_;
  std::vector<std::size_t> first_part_; // by face of the input, into `part_`
  std::vector<Index> part_;             // the faces of the refinement, by face of the input
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_REFINEMENT_LOCATOR_H
