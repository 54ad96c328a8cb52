// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The overlay of an input triangulation and the triangulation that flips have made of it: all crossings of their edges, and the cells between.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_OVERLAY_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_OVERLAY_H

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Geodesic_strip.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Triangle_cells.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/normal_coordinates.h>

#include <CGAL/assertions.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A corner of a cell of the overlay, and the segment from there to the next corner, counterclockwise.
struct Overlay_corner
{
  bool is_crossing;
  std::uint32_t index;          // of the crossing; otherwise of the current halfedge that begins in this corner of its triangle
  std::uint32_t input_halfedge; // along which the segment runs, with the cell on the left; null_index if it runs along a current edge only
};

// All crossings, and the cells between the edges. Cells are convex polygons in each of the two triangles that they belong to.
template <typename NT>
class Overlay
{
  typedef std::uint32_t Index;
  typedef Conformal_metric<NT> Metric;

public:
  typedef typename Metric::Wide_number Wide;
  typedef Overlay_crossing<Wide> Crossing;

  std::vector<Crossing> crossings; // by current edge, and in the order along its first halfedge

  // Linear in the size of both and the number of crossings. \pre `record` is that of the flips of the metric
  Overlay(const Intrinsic_triangulation<NT>& input, const Metric& metric, const Normal_coordinates& record,
          const std::vector<Wide>& weights)
    : input_(input), t_(metric.triangulation), record_(record)
  {
    first_.reserve(std::size_t(t_.number_of_edges()) + 1);
    first_.push_back(0);
    for(Index e = 0; e < t_.number_of_edges(); ++e)
      first_.push_back(first_.back() + record.crossings(e));
    crossings.resize(first_.back());

    Geodesic_strip<NT> strip(metric, weights);
    const std::vector<Normal_coordinates::Start> starts = record.starts(t_);
    for(Index e = 0; e < input.number_of_edges(); ++e)
    {
      const Normal_coordinates::Path path = record.path(t_, starts[input.edge_halfedge(e)]);
      if(!path.is_edge)
        strip(e, path, [&](std::size_t m, const Crossing& crossing)
              { crossings[number_of_crossing(path.crossed[m], path.strand[m])] = crossing; });
    }
  }

  // Calls `visit(f, corners)` for every cell, where `f` is its current face and `corners` a vector of `Overlay_corner`.
  template <typename Visit>
  void for_each_cell(Visit visit)
  {
    for(Index f = 0; f < t_.number_of_faces(); ++f)
    {
      const auto crossings_of_side = [&](Index k) { return record_.crossings(t_.edge(t_.halfedge(f, k))); };
      triangle_.cut({{ crossings_of_side(0), crossings_of_side(1), crossings_of_side(2) }});
      triangle_.for_each([&](const std::vector<Triangle_cells::Segment>& segments)
      {
        cell_.clear();
        for(const Triangle_cells::Segment& segment : segments)
          cell_.push_back(corner(f, segment));
        visit(f, cell_);
      });
    }
  }

private:
  // The crossing of `h` that is number s from its origin.
  std::size_t number_of_crossing(Index h, std::size_t s) const
  {
    const Index e = t_.edge(h);
    return h == t_.edge_halfedge(e) ? first_[e] + s : first_[e + 1] - 1 - s;
  }

  // The same for a place on the border of the triangle f.
  std::size_t crossing_at(Index f, std::size_t place) const
  {
    return number_of_crossing(t_.halfedge(f, Index(triangle_.side(place))), triangle_.position(place) - 1);
  }

  Overlay_corner corner(Index f, const Triangle_cells::Segment& segment) const
  {
    const Index h = t_.halfedge(f, Index(triangle_.side(segment.from)));
    Overlay_corner result;
    result.is_crossing = !triangle_.is_corner(segment.from);
    result.index = result.is_crossing ? Index(crossing_at(f, segment.from)) : h;
    if(segment.is_on_side)
      result.input_halfedge = record_.coincides(t_.edge(h)) ? record_.input_halfedge(t_, h) : input_.null_index;
    else if(result.is_crossing)
      result.input_halfedge = input_halfedge(result.index, crossings[result.index].halfedge != h); // into the triangle
    else
    {
      const Index g = t_.halfedge(f, Index(triangle_.side(segment.to)));
      const std::size_t crossing = crossing_at(f, segment.to);
      result.input_halfedge = input_halfedge(crossing, crossings[crossing].halfedge == g); // out of it
    }
    return result;
  }

  Index input_halfedge(std::size_t crossing, bool is_forward) const
  {
    const Index h = input_.edge_halfedge(crossings[crossing].input_edge);
    return is_forward ? h : input_.twin(h);
  }

  const Intrinsic_triangulation<NT>& input_;
  const Intrinsic_triangulation<NT>& t_;
  const Normal_coordinates& record_;
  std::vector<std::size_t> first_; // by current edge: its first crossing
  Triangle_cells triangle_;        // the triangle at hand
  std::vector<Overlay_corner> cell_;
};

// The input face that a cell is a part of.
template <typename NT>
std::uint32_t input_face_of_cell(const Intrinsic_triangulation<NT>& input, const std::vector<Overlay_corner>& cell)
{
  std::uint32_t result = input.null_index;
  for(const Overlay_corner& corner : cell)
    if(corner.input_halfedge != input.null_index)
      result = input.face(corner.input_halfedge);
  CGAL_assertion(result != input.null_index);
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_OVERLAY_OVERLAY_H
