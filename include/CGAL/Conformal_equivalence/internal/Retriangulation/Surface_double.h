// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The double of a surface with border: the surface and its mirror image, glued along
// the border. It has no border, so that all of its edges can be flipped. What is unique on
// it is symmetric: a metric of the double restricts to one of the surface, with the border a straight
// line where the angle sum is 2 pi, twice the pi of the surface.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_SURFACE_DOUBLE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_SURFACE_DOUBLE_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/normal_coordinates.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The elements of the surface keep their numbers; those of the image follow. The side k of the face f of the
// surface becomes the side 2 - k of the face F + f, run backwards.
template <typename NT>
class Surface_double
{
  typedef std::uint32_t Index;
  Index number_of_halfedges_;
  std::vector<Index> image_of_vertex_; // the vertex itself on the border

public:
  Intrinsic_triangulation<NT> triangulation;

  explicit Surface_double(const Intrinsic_triangulation<NT>& t)
    : number_of_halfedges_(t.number_of_halfedges())
  {
    Index n = t.number_of_vertices();
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      image_of_vertex_.push_back(t.is_isolated_vertex(v) || t.is_border_vertex(v) ? v : n++);

    std::vector<Index> origin(2 * number_of_halfedges_), twin(2 * number_of_halfedges_);
    for(Index h = 0; h < number_of_halfedges_; ++h)
    {
      origin[h] = t.origin(h);
      origin[image(h)] = image_of_vertex_[t.target(h)];
      twin[h] = t.is_border(h) ? image(h) : t.twin(h);
      twin[image(h)] = t.is_border(h) ? h : image(t.twin(h));
    }
    triangulation = Intrinsic_triangulation<NT>(n, std::move(origin), std::move(twin));
    for(Index h = 0; h < number_of_halfedges_; ++h)
    {
      triangulation.set_length(triangulation.edge(h), t.halfedge_length(h));
      triangulation.set_length(triangulation.edge(image(h)), t.halfedge_length(h));
    }
  }

  Index image(Index h) const { return number_of_halfedges_ + 3 * (h / 3) + (2 - h % 3); }

  // The same conditions on both halves; the angle sums of the border count twice.
  template <typename Number>
  Conformal_conditions<Number> conditions(const Conformal_conditions<Number>& given) const
  {
    Conformal_conditions<Number> result(triangulation);
    for(Index v = 0; v < given.size(); ++v)
      for(Index w : {v, image_of_vertex_[v]})
      {
        if(given.is_fixed(v))
        {
          result.fix_log_scale_factor(w, given.log_scale_factor(v));
          continue;
        }
        Exact_angle<Number> angle = given.angle_sum(v);
        if(image_of_vertex_[v] == v)
        {
          angle.units *= 2;
          angle.rest *= 2;
        }
        if(given.is_bounded(v))
          result.prescribe_angle_sum_above(w, angle, given.lower_bound(v));
        else
          result.prescribe_angle_sum(w, angle);
      }
    return result;
  }

  // The same cut on both halves, and the border.
  Cut_graph cut(const Intrinsic_triangulation<NT>& t, const Cut_graph& given) const
  {
    Cut_graph result;
    result.is_cut.assign(triangulation.number_of_edges(), 0);
    for(Index h = 0; h < number_of_halfedges_; ++h)
      if(t.is_border(h) || given[t.edge(h)])
        result.is_cut[triangulation.edge(h)] = result.is_cut[triangulation.edge(image(h))] = 1;
    return result;
  }

  // The border edges of the surface that are no edges of the double any more, which these flips have made `flipped`: the border has lost their
  // lengths. (All of them, should the crossings of both triangulations be too many to be counted.)
  std::vector<Index> lost_border_edges(const Intrinsic_triangulation<NT>& t, const Intrinsic_triangulation<NT>& flipped,
                                       const std::vector<Index>& flips) const
  {
    const Normal_coordinates record = replay_flips(triangulation, flips);
    std::vector<char> is_kept(flipped.number_of_edges(), 0);
    if(!record.has_overflowed())
      for(Index e = 0; e < flipped.number_of_edges(); ++e)
        if(record.coincides(e))
          is_kept[triangulation.edge(record.input_halfedge(flipped, flipped.edge_halfedge(e)))] = 1;
    std::vector<Index> result;
    for(Index e = 0; e < t.number_of_edges(); ++e)
      if(t.is_border_edge(e) && !is_kept[triangulation.edge(t.edge_halfedge(e))])
        result.push_back(e);
    return result;
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_SURFACE_DOUBLE_H
