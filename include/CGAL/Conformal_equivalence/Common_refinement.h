// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file common_refinement.h
/// The map of a surface to a flat metric that needed flips. Where the triangulation was flipped (section 3.2 of Springborn,
/// Schroeder and Pinkall, 2008; Gillespie, Springborn and Crane, 2021), straight triangles between the images of the vertices are not
/// the image of the surface: an edge of the input becomes a broken line. Cut along the edges of both triangulations, the surface is
/// made of convex polygons, each of which is mapped projectively, as a triangle in section 3.4 of the paper is; together they are
/// a continuous map, one-to-one around every point that is no cone.
///
///           k                          k
///         / | \                      / | \        The edge ij of the input, and the edge kl that has replaced it: their crossing
///       /   |   \                  /   |   \      becomes a vertex x with a place on the input edge, one on the flat edge,
///     i-----x-----j     --->     i-----x-____\    and a weight.
///       \   |   /                  \   |     j    .
///         \ | /                      \ |   /
///           l                          l

#ifndef CGAL_CONFORMAL_EQUIVALENCE_COMMON_REFINEMENT_H
#define CGAL_CONFORMAL_EQUIVALENCE_COMMON_REFINEMENT_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Box_tree.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Surface_double.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/normal_coordinates.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Overlay.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/overlay_layout.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/projective_cell.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// The overlay of the triangulation that was given to the solver and the triangulation of the metric found, laid out.
///
/// The vertices are those of the input, with their numbers, then the crossings. Every face is a convex polygon of at most six corners, a
/// part of one face of the input and of one of `Conformal_metric::triangulation`; all of its points are mapped by one projective map:
/// with barycentric coordinates b of the corners, as points of the input face, the homogeneous coordinates are the sum
/// of the b w (x, y, 1) with the weight w and the point (x, y) of each corner.
///
/// The status is `OK`, `EMPTY_MESH`, `TOO_MANY_CROSSINGS` (more than allowed), or `OUT_OF_MEMORY`; `amount` is the number of crossings, for a
/// metric of the double that of both halves.
///
/// \tparam NT_ number type of the coordinates: that of the metric
template <typename NT_ = double>
struct Common_refinement : public Outcome
{
  typedef NT_ NT;               ///< number type of the coordinates
  typedef std::uint32_t Index;  ///< of vertices, edges and faces

  /// stands for "no such element".
  static constexpr Index null_index = (std::numeric_limits<Index>::max)();

  /// Where an edge of the input crosses an edge of the metric's triangulation.
  struct Crossing
  {
    Index input_edge;    ///< an edge of the input
    NT input_parameter;  ///< where on it: 0 at the origin, 1 at the target of its `edge_halfedge()`
    Index flat_edge;     ///< an edge of `Conformal_metric::triangulation`

    /// where on it, before it was scaled: 0 at the origin, 1 at the target of its `edge_halfedge()`. With the weights e^{-u} of
    /// the ends, it is the projective parameter in the flat metric.
    NT flat_parameter;
  };

  Index number_of_input_vertices = 0;  ///< isolated ones included
  std::vector<Crossing> crossings;     ///< the crossing `c` is the vertex `number_of_input_vertices + c`
  std::vector<NT> weights;             ///< by vertex: w, scaled to a maximum of 1 among the vertices of the input; 1 for isolated vertices

  /// \name Faces
  /// The corners of the face `f` are those with the numbers `first_corner[f]`, ..., `first_corner[f + 1] - 1`, counterclockwise.
  /// @{
  std::vector<std::size_t> first_corner;      ///< one more than there are faces
  std::vector<Index> input_face;              ///< by face: the face of the input
  std::vector<Index> flat_face;               ///< by face: the face of `Conformal_metric::triangulation`

  /// @}

  /// \name Corners
  /// @{
  std::vector<Index> corner_vertex;           ///< by corner: its vertex
  std::vector<std::array<NT, 2> > corner_uv;  ///< by corner: its point of the plane. Corners of a vertex that no cut separates are equal.

  /// by corner: the halfedge of the input along which the side from this corner to the next one runs, with the face on its left;
  /// `null_index` if the side lies within the input face
  std::vector<Index> corner_halfedge;
  /// @}

  /// \name Verdict
  /// A face is *positive* if it is a strictly convex polygon, counterclockwise. Positive faces whose angles sum up to 2 pi around every vertex
  /// that is no cone make the map one-to-one around every such point.
  /// @{
  std::vector<Index> flipped_faces;  ///< the faces that are not positive, for the coordinates as computed
  std::vector<Index> rounded_faces;  ///< the faces that are, but no longer with the coordinates rounded to `NT`, which are those of `corner_uv`
  std::vector<double> angle_sums;    ///< by vertex of the input: the sum of the angles of the layout there, in radians

  /// @}

  Index number_of_vertices() const { return number_of_input_vertices + Index(crossings.size()); } ///< of the overlay
  Index number_of_faces() const { return Index(input_face.size()); }                             ///< of the overlay

  /// is `true` iff all faces are positive, as rounded.
  bool is_positive() const { return flipped_faces.empty() && rounded_faces.empty(); }
};

/// \ingroup PkgConformalEquivalenceLayout
/// The number of crossings beyond which `compute_common_refinement()` refuses an overlay unless told otherwise: some 3 gigabytes.
constexpr std::uint64_t default_maximum_number_of_crossings = 10000000;

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

  template <typename Frame>
  Common_refinement<NT> operator()(std::uint64_t maximum_number_of_crossings, const Frame& frame)
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
    if(!is_convex_polygon(rounded_))
      (is_convex_polygon(polygon_) ? result_.rounded_faces : result_.flipped_faces).push_back(result_.number_of_faces());
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
  Common_refinement<NT> result_;
};

} // namespace internal

/// \ingroup PkgConformalEquivalenceLayout
///
/// overlays the triangulation that was given to the solver and that of the metric found, and lays the overlay out in the plane.
///
/// How edges run over one another is known in integers, from the flips alone. Where they cross follows from the lengths of the metric's
/// triangulation, in `Conformal_metric::Wide_number`: both triangulations are geodesic in one hyperbolic metric. The vertices of the input
/// lie where `compute_layout()` puts them, bit by bit. Along uncut edges the corners on both sides are equal bit by bit, and the sides of a cut
/// differ by the motion that `compute_layout()` reports. Seams run along input edges.
///
/// If no edge was flipped, the result is the input. After Ptolemy flips (`Retriangulation::WHEN_NEEDED`) the map preserves the circumcircles of the
/// input triangles; flips of the Euclidean metric that come before (`Retriangulation::ALWAYS`) are treated in the same way: the input
/// edges which they replace then cross the others as the geodesics of the hyperbolic metric do, not as straight lines of the surface.
///
/// \param input the triangulation that was given to the solver
/// \param metric what the solver returned
/// \param cut what it leaves should be disks, with all cones on their borders, as `compute_cut_graph()` provides
/// \param maximum_number_of_crossings the limit for both halves together if the metric is one of the double; it is checked before memory is allocated
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{layout_frame} \cgalParamDescription{as in `compute_layout()`} \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the refinement, with the verdict on its faces (exact for `double`; for other numbers a face counts as positive if that is certain), or `EMPTY_MESH`, `TOO_MANY_CROSSINGS`, `OUT_OF_MEMORY`.
///         Time and memory are linear in the sizes of the triangulations and the number of crossings.
/// \pre `metric` is a success; its triangulation is `input`, or was made from it by `Conformal_metric::flips`.
///
/// \sa `CGAL::Conformal_equivalence::make_refined_mesh()`
template <typename NT, typename NamedParameters = parameters::Default_named_parameters>
Common_refinement<NT> compute_common_refinement(const Intrinsic_triangulation<NT>& input,
                                                const Conformal_metric<NT>& metric,
                                                const Cut_graph& cut,
                                                std::uint64_t maximum_number_of_crossings = default_maximum_number_of_crossings,
                                                const NamedParameters& np = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  CGAL_precondition(bool(metric));
  CGAL_precondition(metric.triangulation.number_of_halfedges() == (metric.is_doubled ? 2 : 1) * input.number_of_halfedges());
  Common_refinement<NT> nothing;
  if(input.number_of_faces() == 0)
  {
    nothing.status = Status::EMPTY_MESH;
    return nothing;
  }
  const auto frame = choose_parameter(get_parameter(np, internal_np::conformal_layout_frame), Layout_frame::CANONICAL);
  const internal::Surface_size size = { input.number_of_vertices(), input.number_of_edges(), input.number_of_faces() };
  try
  {
    if(!metric.is_doubled)
      return internal::Refinement_builder<NT>(input, metric, cut, size)(maximum_number_of_crossings, frame);
    const internal::Surface_double<NT> twofold(input);
    const Cut_graph both = twofold.cut(input, cut);
    return internal::Refinement_builder<NT>(twofold.triangulation, metric, both, size)(maximum_number_of_crossings, frame);
  }
  catch(const std::bad_alloc&)
  {
    nothing.status = Status::OUT_OF_MEMORY;
    return nothing;
  }
}

namespace internal {

template <typename To, typename From> To convert_number(const From& x) { return To(x); }
template <typename To> To convert_number(const Double_double& x) { return To(x.hi) + To(x.lo); }

} // namespace internal

/// \ingroup PkgConformalEquivalenceLayout
///
/// returns the same metric held in numbers of another, wider type, nothing being rounded: where scale factors range too far for the
/// points of a layout to differ in `double`, `compute_common_refinement()` of the converted metric and `input.with_lengths()` lays it out with more digits.
///
/// \tparam Other_NT a number type wider than `Conformal_metric::Wide_number`, such as a Boost.Multiprecision number; not `double`
template <typename Other_NT, typename NT>
Conformal_metric<Other_NT> convert_metric(const Conformal_metric<NT>& metric)
{
  const Intrinsic_triangulation<NT>& t = metric.triangulation;
  Conformal_metric<Other_NT> result;
  std::vector<Other_NT> lengths;
  for(const NT& l : t.lengths())
    lengths.push_back(Other_NT(l));
  result.triangulation = t.with_lengths(std::move(lengths));
  result.is_doubled = metric.is_doubled;
  result.flips = metric.flips;
  for(const NT& u : metric.log_scale_factors)
    result.log_scale_factors.push_back(Other_NT(u));
  for(const auto& s : metric.scale_factors)
    result.scale_factors.push_back(internal::convert_number<Other_NT>(s));
  result.set_outcome(metric);
  result.statistics = metric.statistics;
  return result;
}

/// \ingroup PkgConformalEquivalenceLayout
///
/// returns the largest difference, in radians, of the angle sum that the refinement has at a vertex from the one that `conditions` prescribe there;
/// vertices of fixed u, and isolated ones, are left out. Below 1e-10, say, the faces around each vertex that is no cone turn once. Linear time.
/// \param input the triangulation that was given to the solver
/// \param refinement what `compute_common_refinement()` returned for it
/// \param conditions the conditions that were given to the solver
template <typename NT>
double angle_sum_error(const Intrinsic_triangulation<NT>& input, const Common_refinement<NT>& refinement,
                       const Conformal_conditions<NT>& conditions)
{
  double result = 0;
  for(std::uint32_t v = 0; v < refinement.number_of_input_vertices; ++v)
    if(!input.is_isolated_vertex(v) && !conditions.is_fixed(v))
    {
      const double error = std::abs(refinement.angle_sums[v] - static_cast<double>(conditions.angle_sum(v).radians()));
      result = std::isfinite(error) ? (std::max)(result, error) : std::numeric_limits<double>::infinity();
    }
  return result;
}

namespace internal {

// The corner of the face, counted from its first one, from which triangles to all other sides are thickest in the layout.
template <typename NT>
std::size_t best_fan_centre(const Common_refinement<NT>& refinement, std::uint32_t f)
{
  const std::size_t first = refinement.first_corner[f], n = refinement.first_corner[f + 1] - first;
  const auto doubled_area = [&](std::size_t i, std::size_t j, std::size_t k)
  {
    const std::array<NT, 2> &p = refinement.corner_uv[first + i % n], &q = refinement.corner_uv[first + j % n],
                            &r = refinement.corner_uv[first + k % n];
    return NT((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
  };
  std::size_t best = 0;
  NT largest(0);
  for(std::size_t a = 0; a < n; ++a)
  {
    NT least = doubled_area(a, a + 1, a + 2);
    for(std::size_t i = 2; i + 1 < n; ++i)
      least = (std::min)(least, doubled_area(a, a + i, a + i + 1));
    if(a == 0 || largest < least)
    {
      largest = least;
      best = a;
    }
  }
  return best;
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceLayout
///
/// returns the same refinement with every face cut into triangles, from one of its corners: from the one that leaves the thickest triangles in
/// the layout. All parts of a face are mapped by the same projective map as before. The verdict is renewed for the triangles. Linear time.
template <typename NT>
Common_refinement<NT> triangulate_refinement(const Common_refinement<NT>& refinement)
{
  typedef std::uint32_t Index;
  Common_refinement<NT> result;
  result.number_of_input_vertices = refinement.number_of_input_vertices;
  result.crossings = refinement.crossings;
  result.weights = refinement.weights;
  result.angle_sums = refinement.angle_sums;
  result.set_outcome(refinement);
  result.first_corner.push_back(0);
  for(Index f = 0; f < refinement.number_of_faces(); ++f)
  {
    const std::size_t first = refinement.first_corner[f], n = refinement.first_corner[f + 1] - first,
                      centre = internal::best_fan_centre(refinement, f);
    const bool is_flipped = std::binary_search(refinement.flipped_faces.begin(), refinement.flipped_faces.end(), f);
    for(std::size_t i = 1; i + 1 < n; ++i)
    {
      const std::array<std::size_t, 3> corner = {{first + centre, first + (centre + i) % n, first + (centre + i + 1) % n}};
      const std::array<bool, 3> is_side = {{i == 1, true, i + 2 == n}};
      for(std::size_t k = 0; k < 3; ++k)
      {
        result.corner_vertex.push_back(refinement.corner_vertex[corner[k]]);
        result.corner_uv.push_back(refinement.corner_uv[corner[k]]);
        result.corner_halfedge.push_back(is_side[k] ? refinement.corner_halfedge[corner[k]] : result.null_index);
      }
      if(!internal::is_left_turn(refinement.corner_uv[corner[0]], refinement.corner_uv[corner[1]], refinement.corner_uv[corner[2]]))
        (is_flipped ? result.flipped_faces : result.rounded_faces).push_back(result.number_of_faces());
      result.input_face.push_back(refinement.input_face[f]);
      result.flat_face.push_back(refinement.flat_face[f]);
      result.first_corner.push_back(result.corner_vertex.size());
    }
  }
  return result;
}

/// \ingroup PkgConformalEquivalenceLayout
///
/// returns the barycentric coordinates, in the input face of the face `f`, of the point of the input surface that is the corner number
/// `corner` of the refinement, one of the corners of `f`; entry `k` belongs to the origin of the halfedge `3 * input_face[f] + k`. O(1).
template <typename NT>
std::array<NT, 3> input_barycentric(const Intrinsic_triangulation<NT>& input, const Common_refinement<NT>& refinement,
                                    std::uint32_t f, std::size_t corner)
{
  typedef std::uint32_t Index;
  const std::size_t first = refinement.first_corner[f], last = refinement.first_corner[f + 1] - 1;
  const Index after = refinement.corner_halfedge[corner],
              before = refinement.corner_halfedge[corner == first ? last : corner - 1],
              beyond = refinement.corner_halfedge[corner == last ? first : corner + 1];
  const Index none = refinement.null_index, face = refinement.input_face[f], v = refinement.corner_vertex[corner];
  std::array<NT, 3> result = {{NT(0), NT(0), NT(0)}};
  if(v < refinement.number_of_input_vertices)
  {
    Index h = after != none ? after : before != none ? input.next(before) : beyond != none ? input.previous(beyond) : 3 * face;
    while(input.origin(h) != v) // at a corner between diagonals of a part no side is known
      h = input.next(h);
    result[h % 3] = NT(1);
    return result;
  }
  const auto& crossing = refinement.crossings[v - refinement.number_of_input_vertices];
  const Index first_side = input.edge_halfedge(crossing.input_edge);
  const Index h = after != none ? after : before != none ? before
                : input.face(first_side) == face ? first_side : input.twin(first_side);
  const bool is_first = h == input.edge_halfedge(crossing.input_edge);
  result[(is_first ? h : input.next(h)) % 3] = 1 - crossing.input_parameter;
  result[(is_first ? input.next(h) : h) % 3] = crossing.input_parameter;
  return result;
}

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
    tree_.for_each_around(static_cast<double>(uv[0]), static_cast<double>(uv[1]), [&](Index f)
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

  static std::vector<std::array<double, 4> > boxes(const Common_refinement<NT>& r)
  {
    std::vector<std::array<double, 4> > result;
    const double infinity = std::numeric_limits<double>::infinity();
    for(Index f = 0; f < r.number_of_faces(); ++f)
    {
      std::array<double, 4> box = {{ infinity, infinity, -infinity, -infinity }};
      for(std::size_t c = r.first_corner[f]; c < r.first_corner[f + 1]; ++c)
        for(std::size_t k = 0; k < 2; ++k)
        {
          box[k] = (std::min)(box[k], static_cast<double>(r.corner_uv[c][k]));
          box[k + 2] = (std::max)(box[k + 2], static_cast<double>(r.corner_uv[c][k]));
        }
      const bool is_finite = std::isfinite(box[0]) && std::isfinite(box[1]) && std::isfinite(box[2]) && std::isfinite(box[3]);
      result.push_back(is_finite ? box : std::array<double, 4>{{ 0, 0, -1, -1 }}); // which contains nothing
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
  internal::Box_tree tree_;
  std::vector<std::size_t> first_part_; // by face of the input, into `part_`
  std::vector<Index> part_;             // the faces of the refinement, by face of the input
};

/// \ingroup PkgConformalEquivalenceLayout
///
/// The elements of a mesh that `make_refined_mesh()` has made, by their numbers in the refinement.
template <typename RefinedMesh>
struct Refined_mesh_elements
{
  std::vector<typename boost::graph_traits<RefinedMesh>::vertex_descriptor> vertices; ///< by vertex of the refinement
  std::vector<typename boost::graph_traits<RefinedMesh>::face_descriptor> faces;      ///< by face of the refinement

  /// by corner of the refinement: the halfedge of its face that ends there
  std::vector<typename boost::graph_traits<RefinedMesh>::halfedge_descriptor> halfedges;
};

namespace internal {

// The vertices of a refinement, with their points on the input surface.
template <typename TriangleMesh, typename NT, typename PointMapIn, typename RefinedMesh, typename PointMapOut>
void add_refined_vertices(const Imported_mesh<TriangleMesh, NT>& mesh, const Common_refinement<NT>& refinement, PointMapIn point_in,
                          RefinedMesh& out, PointMapOut point_out, Refined_mesh_elements<RefinedMesh>& result)
{
  typedef std::uint32_t Index;
  typedef typename boost::property_traits<PointMapOut>::value_type Point_3;
  typedef std::decay_t<decltype(get(point_in, mesh.vertex(0)).x())> FT;
  const auto add = [&](const Point_3& p)
  {
    result.vertices.push_back(add_vertex(out));
    put(point_out, result.vertices.back(), p);
  };
  const Intrinsic_triangulation<NT>& t = mesh.triangulation;
  for(Index v = 0; v < refinement.number_of_input_vertices; ++v)
  {
    const auto& p = get(point_in, mesh.vertex(v));
    add(Point_3(p.x(), p.y(), p.z()));
  }
  for(const typename Common_refinement<NT>::Crossing& x : refinement.crossings)
  {
    const Index h = t.edge_halfedge(x.input_edge);
    const auto &p = get(point_in, mesh.vertex(t.origin(h))), &q = get(point_in, mesh.vertex(t.target(h)));
    const FT b(static_cast<double>(x.input_parameter)), a = 1 - b;
    add(Point_3(a * p.x() + b * q.x(), a * p.y() + b * q.y(), a * p.z() + b * q.z()));
  }
}

// Its faces, if the mesh can hold them.
template <typename NT, typename RefinedMesh>
bool add_refined_faces(const Common_refinement<NT>& refinement, RefinedMesh& out, Refined_mesh_elements<RefinedMesh>& result)
{
  typedef boost::graph_traits<RefinedMesh> Traits;
  std::vector<typename Traits::vertex_descriptor> corners;
  result.halfedges.resize(refinement.corner_vertex.size());
  for(std::uint32_t f = 0; f < refinement.number_of_faces(); ++f)
  {
    const std::size_t first = refinement.first_corner[f], last = refinement.first_corner[f + 1];
    corners.clear();
    for(std::size_t c = first; c < last; ++c)
      corners.push_back(result.vertices[refinement.corner_vertex[c]]);
    const typename Traits::face_descriptor fd = CGAL::Euler::add_face(corners, out);
    if(fd == Traits::null_face())
      return false;
    result.faces.push_back(fd);
    typename Traits::halfedge_descriptor h = halfedge(fd, out);
    while(target(h, out) != corners[0])
      h = next(h, out);
    for(std::size_t c = first; c < last; ++c, h = next(h, out))
      result.halfedges[c] = h;
  }
  return true;
}

template <typename NT, typename RefinedMesh, typename HalfedgeUVMap>
void write_refined_corners(const Common_refinement<NT>& refinement, const Refined_mesh_elements<RefinedMesh>& elements,
                           const RefinedMesh& out, HalfedgeUVMap uv)
{
  typedef typename boost::property_traits<HalfedgeUVMap>::value_type Point_2;
  const auto write = [&](typename boost::graph_traits<RefinedMesh>::halfedge_descriptor h, std::size_t c)
    { put(uv, h, Point_2(static_cast<double>(refinement.corner_uv[c][0]), static_cast<double>(refinement.corner_uv[c][1]))); };
  for(std::uint32_t f = 0; f < refinement.number_of_faces(); ++f)
  {
    const std::size_t first = refinement.first_corner[f], last = refinement.first_corner[f + 1];
    for(std::size_t c = first; c < last; ++c)
    {
      const auto h = elements.halfedges[c];
      write(h, c);
      if(CGAL::is_border(opposite(h, out), out))
        write(opposite(h, out), c == first ? last - 1 : c - 1);
    }
  }
}

template <typename NT, typename RefinedMesh, typename EdgeIsSeamMap>
void write_refined_seam(const Common_refinement<NT>& refinement, const Refined_mesh_elements<RefinedMesh>& elements,
                        RefinedMesh& out, EdgeIsSeamMap seam)
{
  typedef typename boost::graph_traits<RefinedMesh>::halfedge_descriptor halfedge_descriptor;
  const auto corner = get(CGAL::dynamic_halfedge_property_t<std::size_t>(), out);
  for(std::size_t c = 0; c < elements.halfedges.size(); ++c)
    put(corner, elements.halfedges[c], c);
  const auto point = [&](halfedge_descriptor h) { return refinement.corner_uv[get(corner, h)]; };
  for(halfedge_descriptor h : elements.halfedges)
  {
    const halfedge_descriptor g = opposite(h, out);
    const bool is_seam = !CGAL::is_border(g, out) && (point(h) != point(prev(g, out)) || point(g) != point(prev(h, out)));
    put(seam, edge(h, out), is_seam);
  }
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceLayout
///
/// makes a mesh of a refinement: with the polygons (or triangles) of the refinement for faces, which are parts of the input faces, the
/// points on the input surface, and texture coordinates.
///
/// The vertex `v` of the refinement becomes `vertices[v]` of the result; so it lies on the edge
/// `mesh.edge(refinement.crossings[c].input_edge)` if it is the crossing `c`; the face `f` is a part of `mesh.face(refinement.input_face[f])`.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam RefinedMesh a model of `MutableFaceGraph`
/// \tparam HalfedgeUVMap a model of `WritablePropertyMap` with key type `boost::graph_traits<RefinedMesh>::%halfedge_descriptor` and a
///         value type that can be made from two `double`
///
/// \param mesh the mesh of which the triangulation was given to the solver
/// \param refinement what `compute_common_refinement()`, or `triangulate_refinement()`, returned for it. \pre it is a success
/// \param out the mesh, to which vertices and faces are added. It has to be empty.
/// \param uv receives, at every halfedge `h` of `out`, where `target(h, out)` lies in `face(h, out)`; a border halfedge receives what
///        `prev(opposite(h, out), out)` does
/// \param np_in an optional sequence of \ref bgl_namedparameters "Named Parameters" for the mesh given: `vertex_point_map`
/// \param np_out an optional sequence of \ref bgl_namedparameters "Named Parameters" for the mesh made, among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{receives the points}
///     \cgalParamType{a read-write property map with key type `boost::graph_traits<RefinedMesh>::%vertex_descriptor` and as value type a `Point_3` that can be made from three coordinates}
///     \cgalParamDefault{`get(CGAL::vertex_point, out)`}
///   \cgalParamNEnd
///   \cgalParamNBegin{projective_weight_map}
///     \cgalParamDescription{receives the weights: homogeneous texture coordinates are w times (x, y, 1)}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<RefinedMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_is_seam_map}
///     \cgalParamDescription{receives whether the two sides of an edge lie in different places; `false` on borders}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<RefinedMesh>::%edge_descriptor` and value type `bool`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the elements made; without faces, and with `out` empty again, if `out` cannot hold them (several faces with the same corners: two triangles glued along
///         all sides). Linear time, but for the degrees of vertices.
template <typename TriangleMesh, typename NT, typename RefinedMesh, typename HalfedgeUVMap,
          typename NamedParametersIn = parameters::Default_named_parameters,
          typename NamedParametersOut = parameters::Default_named_parameters>
Refined_mesh_elements<RefinedMesh> make_refined_mesh(const Imported_mesh<TriangleMesh, NT>& mesh,
                                                     const Common_refinement<NT>& refinement,
                                                     RefinedMesh& out,
                                                     HalfedgeUVMap uv,
                                                     const NamedParametersIn& np_in = parameters::default_values(),
                                                     const NamedParametersOut& np_out = parameters::default_values())
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  using parameters::is_default_parameter;
  const auto point_in = choose_parameter(get_parameter(np_in, internal_np::vertex_point), get(CGAL::vertex_point, mesh.mesh()));
  auto point_out = choose_parameter(get_parameter(np_out, internal_np::vertex_point), get(CGAL::vertex_point, out));
  CGAL_precondition(bool(refinement) && vertices(out).begin() == vertices(out).end());

  Refined_mesh_elements<RefinedMesh> result;
  internal::add_refined_vertices(mesh, refinement, point_in, out, point_out, result);
  if(!internal::add_refined_faces(refinement, out, result))
  {
    CGAL::clear(out);
    return Refined_mesh_elements<RefinedMesh>();
  }
  internal::write_refined_corners(refinement, result, out, uv);
  if constexpr(!is_default_parameter<NamedParametersOut, internal_np::conformal_weight_t>::value)
    for(std::uint32_t v = 0; v < refinement.number_of_vertices(); ++v)
      put(get_parameter(np_out, internal_np::conformal_weight), result.vertices[v], static_cast<double>(refinement.weights[v]));
  if constexpr(!is_default_parameter<NamedParametersOut, internal_np::conformal_edge_is_seam_t>::value)
    internal::write_refined_seam(refinement, result, out, get_parameter(np_out, internal_np::conformal_edge_is_seam));
  return result;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_COMMON_REFINEMENT_H
