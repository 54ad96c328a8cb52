// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The overlay of a surface and the inscribed polyhedron that flips have made of it. All of it is linear in the vectors of the light cone:
// where an input edge crosses an edge of the polyhedron is a positive combination of the vectors of the two ends of that edge, the points of a
// cell those of the vectors of its corners.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IDEAL_REFINEMENT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IDEAL_REFINEMENT_H

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Ideal_polyhedron.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/normal_coordinates.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Overlay.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/overlay_layout.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The triangulation of the polyhedron with the lengths of its chords.
template <typename NT>
Conformal_metric<NT> metric_of_chords(const Ideal_polyhedron<NT>& polyhedron)
{
  using std::log;
  using std::sqrt;
  typedef typename Ideal_polyhedron<NT>::Wide Wide;
  Conformal_metric<NT> result;
  result.triangulation = polyhedron.triangulation;
  result.flips = polyhedron.flips;
  result.status = polyhedron.status;
  result.amount = polyhedron.amount;
  result.statistics = polyhedron.statistics;
  for(const Light_vector<Wide>& v : polyhedron.vectors)
  {
    const Wide weight = v[3] > 0 ? v[3] : Wide(1);
    result.scale_factors.push_back(Wide(1) / Wide(sqrt(weight)));
    result.log_scale_factors.push_back(static_cast<NT>(-Wide(log(weight))));
  }
  return result;
}

// The refinement without points of the plane, and the vectors of its vertices.
template <typename NT>
struct Ideal_refinement
{
  typedef typename Ideal_polyhedron<NT>::Wide Wide;
  Common_refinement<NT> parts;
  std::vector<Light_vector<Wide> > vectors; // by vertex of `parts`
};

template <typename NT>
class Ideal_refinement_builder
{
  typedef std::uint32_t Index;
  typedef typename Ideal_polyhedron<NT>::Wide Wide;
  typedef Overlay_crossing<Wide> Crossing;

public:
  // `input` is what flips have made the polyhedron of: the surface given, of that size, or its double
  Ideal_refinement_builder(const Intrinsic_triangulation<NT>& input, const Ideal_polyhedron<NT>& polyhedron, Surface_size size)
    : input_(input), polyhedron_(polyhedron), metric_(metric_of_chords(polyhedron)), size_(size)
  {}

  // `weight(v)`: the linear form of a vector that is the weight of its point
  template <typename Weight>
  Ideal_refinement<NT> operator()(std::uint64_t maximum_number_of_crossings, Weight weight)
  {
    Common_refinement<NT>& parts = result_.parts;
    const Normal_coordinates record = replay_flips(input_, polyhedron_.flips);
    parts.amount = static_cast<double>(record.total_crossings());
    if(record.has_overflowed() || record.total_crossings() > maximum_number_of_crossings
       || record.total_crossings() + input_.number_of_vertices() >= parts.null_index)
    {
      parts.status = Status::TOO_MANY_CROSSINGS;
      return std::move(result_);
    }
    std::vector<Wide> weights;
    for(const Light_vector<Wide>& v : polyhedron_.vectors)
      weights.push_back(v[3] > 0 ? Wide(weight(v)) : Wide(1));
    Overlay<NT> overlay(input_, metric_, record, weights);
    write_vertices(weights, overlay.crossings);
    write_cells(overlay);
    return std::move(result_);
  }

private:
  void write_vertices(const std::vector<Wide>& weights, const std::vector<Crossing>& crossings)
  {
    Common_refinement<NT>& parts = result_.parts;
    const Intrinsic_triangulation<NT>& t = polyhedron_.triangulation;
    Wide largest(0);
    for(Index v = 0; v < size_.vertices; ++v)
      largest = input_.is_isolated_vertex(v) || !(largest < weights[v]) ? largest : weights[v];
    const auto add = [&](const Light_vector<Wide>& v, const Wide& w)
    {
      result_.vectors.push_back(v);
      parts.weights.push_back(static_cast<NT>(Wide(w / largest)));
    };
    parts.number_of_input_vertices = size_.vertices;
    for(Index v = 0; v < size_.vertices; ++v)
      add(polyhedron_.vectors[v], input_.is_isolated_vertex(v) ? largest : weights[v]);
    vertex_of_crossing_.assign(crossings.size(), parts.null_index);
    for(std::size_t c = 0; c < crossings.size(); ++c)
    {
      const Crossing& x = crossings[c];
      if(x.input_edge >= size_.edges)
        continue;
      const Index e = t.edge(x.halfedge), o = t.origin(x.halfedge), d = t.target(x.halfedge);
      vertex_of_crossing_[c] = parts.number_of_vertices();
      parts.crossings.push_back({x.input_edge, static_cast<NT>(x.parameter), e, static_cast<NT>(
        x.halfedge == t.edge_halfedge(e) ? x.current_parameter : Wide(1 - x.current_parameter))});
      const Wide at_o = Wide(1) - x.current_parameter, at_d = x.current_parameter;
      const Wide scale = x.weight / (at_o * weights[o] + at_d * weights[d]);
      Light_vector<Wide> v;
      for(std::size_t i = 0; i < 4; ++i)
        v[i] = scale * (at_o * polyhedron_.vectors[o][i] + at_d * polyhedron_.vectors[d][i]);
      add(v, x.weight);
    }
  }

  void write_cells(Overlay<NT>& overlay)
  {
    Common_refinement<NT>& parts = result_.parts;
    parts.first_corner.push_back(0);
    overlay.for_each_cell([&](Index flat_face, const std::vector<Overlay_corner>& cell)
    {
      const Index input_face = input_face_of_cell(input_, cell);
      if(input_face >= size_.faces)
        return;
      for(const Overlay_corner& corner : cell)
      {
        parts.corner_vertex.push_back(corner.is_crossing ? vertex_of_crossing_[corner.index]
                                                         : polyhedron_.triangulation.origin(corner.index));
        parts.corner_halfedge.push_back(corner.input_halfedge);
      }
      parts.input_face.push_back(input_face);
      parts.flat_face.push_back(flat_face);
      parts.first_corner.push_back(parts.corner_vertex.size());
    });
  }

  const Intrinsic_triangulation<NT>& input_;
  const Ideal_polyhedron<NT>& polyhedron_;
  const Conformal_metric<NT> metric_;
  const Surface_size size_;
  std::vector<Index> vertex_of_crossing_;
  Ideal_refinement<NT> result_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_IDEAL_REFINEMENT_H
