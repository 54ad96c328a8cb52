// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The engine of `compute_common_refinement()`: from the record of flips to the overlay, laid out and judged.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_REFINEMENT_BUILDER_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_REFINEMENT_BUILDER_H

#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Layout/layout_frames.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Cell_verdict.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Overlay.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/overlay_layout.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/normal_coordinates.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Surface_double.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename NT>
class Refinement_builder
{
  typedef std::uint32_t Index;
  typedef Conformal_metric<NT> Metric;
  typedef typename Metric::Wide_number Wide;
  typedef Complex_number<Wide> Complex;
  typedef Overlay_crossing<Wide> Crossing;
  typedef std::array<Wide, 2> Wide_point;

public:
  // `input` is what the metric was made of by flips: the surface given, or its double
  Refinement_builder(const Intrinsic_triangulation<NT>& input, const Metric& metric, const Cut_graph& cut, Surface_size size)
    : input_(input), metric_(metric), cut_(cut), size_(size)
  {}

  Common_refinement<NT> operator()(std::uint64_t maximum_number_of_crossings, const Any_frame& frame)
  {
    const Normal_coordinates record = replay_flips(input_, metric_.flips);
    result_.amount = static_cast<double>(record.total_crossings());
    if(record.has_overflowed() || record.total_crossings() > maximum_number_of_crossings
       || record.total_crossings() + input_.number_of_vertices() >= result_.null_index)
    {
      result_.status = Status::TOO_MANY_CROSSINGS;
      return std::move(result_);
    }
    const Overlay_layout<NT> layout(input_, metric_, cut_, size_, frame);
    const std::vector<Wide> weights = vertex_weights(metric_);
    Overlay<NT> overlay(input_, metric_, record, weights);
    write_vertices(weights, overlay.crossings);
    write_faces(layout, overlay);
    put_verdict(std::move(verdict_), result_);
    return std::move(result_);
  }

private:
  // Vertices of the input, and the crossings on its edges.
  void write_vertices(const std::vector<Wide>& weights, const std::vector<Crossing>& crossings)
  {
    const Intrinsic_triangulation<NT>& t = metric_.triangulation;
    result_.number_of_input_vertices = size_.vertices;
    result_.angle_sums.assign(size_.vertices, 0);
    for(Index v = 0; v < size_.vertices; ++v)
      result_.weights.push_back(static_cast<NT>(weights[v]));
    vertex_of_crossing_.assign(crossings.size(), result_.null_index);
    for(std::size_t c = 0; c < crossings.size(); ++c)
    {
      const Crossing& x = crossings[c];
      if(x.input_edge >= size_.edges)
        continue;
      vertex_of_crossing_[c] = result_.number_of_vertices();
      const Index e = t.edge(x.halfedge);
      const Wide parameter = x.halfedge == t.edge_halfedge(e) ? x.current_parameter : Wide(1 - x.current_parameter);
      result_.crossings.push_back({x.input_edge, static_cast<NT>(x.parameter), e, static_cast<NT>(parameter)});
      result_.weights.push_back(static_cast<NT>(x.weight));
    }
  }

  void write_faces(const Overlay_layout<NT>& layout, Overlay<NT>& overlay)
  {
    result_.first_corner.push_back(0);
    overlay.for_each_cell([&](Index flat_face, const std::vector<Overlay_corner>& cell)
    {
      const Index input_face = input_face_of_cell(input_, cell);
      if(input_face >= size_.faces)
        return;
      polygon_.clear();
      rounded_.clear();
      for(std::size_t i = 0; i < cell.size(); ++i)
        write_corner(layout, overlay.crossings, cell, i);
      judge_face();
      result_.input_face.push_back(input_face);
      result_.flat_face.push_back(flat_face);
      result_.first_corner.push_back(result_.corner_vertex.size());
    });
  }

  void write_corner(const Overlay_layout<NT>& layout, const std::vector<Crossing>& crossings, const std::vector<Overlay_corner>& cell,
                    std::size_t i)
  {
    const Overlay_corner& corner = cell[i];
    const Index before = cell[(i + cell.size() - 1) % cell.size()].input_halfedge, after = corner.input_halfedge;
    Complex z;
    if(corner.is_crossing)
    {
      const Crossing& x = crossings[corner.index];
      z = layout.place(x, after != result_.null_index ? after : before);
      result_.corner_vertex.push_back(vertex_of_crossing_[corner.index]);
    }
    else
    {
      // without an input edge at this corner, the current edge leads across the opposite side of the input triangle
      const Index h = after != result_.null_index ? input_.previous(after) :
                      before != result_.null_index ? before : input_.next(cell[(i + 1) % cell.size()].input_halfedge);
      z = layout.target(h);
      result_.corner_vertex.push_back(input_.target(h));
    }
    polygon_.push_back({{z.re, z.im}});
    rounded_.push_back(plane_point<NT>(z));
    result_.corner_uv.push_back(rounded_.back());
    result_.corner_halfedge.push_back(after);
  }

  // Of the face that is being written.
  void judge_face()
  {
    const std::size_t n = polygon_.size(), first = result_.first_corner.back();
    verdict_.judge(result_.number_of_faces(), [&] { return is_convex_polygon(rounded_); }, [&] { return is_convex_polygon(polygon_); });
    for(std::size_t i = 0; i < n; ++i)
    {
      const Index v = result_.corner_vertex[first + i];
      if(v < size_.vertices)
        result_.angle_sums[v] += angle_between(polygon_[(i + 1) % n], polygon_[i], polygon_[(i + n - 1) % n]);
    }
  }

  const Intrinsic_triangulation<NT>& input_;
  const Metric& metric_;
  const Cut_graph& cut_;
  const Surface_size size_;
  std::vector<Index> vertex_of_crossing_;
  std::vector<Wide_point> polygon_;         // the face that is being written
  std::vector<std::array<NT, 2> > rounded_;
  Cell_verdict verdict_;
  Common_refinement<NT> result_;
};

// The whole way, for a metric of the surface given or of its double.
template <typename NT>
Common_refinement<NT> build_refinement(const Intrinsic_triangulation<NT>& input, const Conformal_metric<NT>& metric, const Cut_graph& cut,
                                       std::uint64_t maximum_number_of_crossings, const Any_frame& frame)
{
  const Surface_size size = { input.number_of_vertices(), input.number_of_edges(), input.number_of_faces() };
  Common_refinement<NT> nothing;
  try
  {
    if(size.faces == 0)
      nothing.status = Status::EMPTY_MESH;
    else if(!metric.is_doubled)
      return Refinement_builder<NT>(input, metric, cut, size)(maximum_number_of_crossings, frame);
    else
    {
      const Surface_double<NT> twofold(input);
      return Refinement_builder<NT>(twofold.triangulation, metric, twofold.cut(input, cut), size)(maximum_number_of_crossings, frame);
    }
  }
  catch(const std::bad_alloc&)
  {
    nothing.status = Status::OUT_OF_MEMORY;
  }
  return nothing;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template Common_refinement<double> build_refinement(const Intrinsic_triangulation<double>&, const Conformal_metric<double>&,
                                                           const Cut_graph&, std::uint64_t, const Any_frame&);
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_REFINEMENT_BUILDER_H
