// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Surface_locator.h
/// The map of a surface to a flat metric, point by point. Where the metric needed flips (section 3.2 of Springborn, Schroeder and
/// Pinkall, 2008), the map is projective on the parts into which the edges of both triangulations cut the surface
/// (Common_refinement.h). There can be many more of them than there are faces. But a point needs only those of its own face: how
/// often its sides are crossed tells how they are cut off (Gillespie, Sharp and Crane, "Integer Coordinates for Intrinsic Geometry
/// Processing", 2021), and the strips of flat triangles along the sides tell where.
///
///              2
///             / \            The sides of this input face are crossed 2, 3 and 3 times. What crosses two sides goes around the
///            /---\           corner between them: once around 0 and around 1, twice around 2. The five parts are convex
///           /-----\          polygons. Without crossings the face is the only one, and its map that of section 3.4 of the
///          / \   / \         paper.
///         0---------1

#ifndef CGAL_CONFORMAL_EQUIVALENCE_SURFACE_LOCATOR_H
#define CGAL_CONFORMAL_EQUIVALENCE_SURFACE_LOCATOR_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Layout.h>
#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Bounding_strip.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Box_tree.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Surface_double.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/normal_coordinates.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Geodesic_strip.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/Triangle_cells.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/overlay_layout.h>
#include <CGAL/Conformal_equivalence/internal/Overlay/projective_cell.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/assertions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// answers where a point of the input surface lies in the layout, and which points of the surface lie at a point of the plane,
/// without making the common refinement: for every query, only the parts of the faces in question are found. The map is that of
/// `compute_common_refinement()`; the vertices lie where `compute_layout()` puts them.
///
/// Memory is linear in the size of the surface; that of a query, in the number of crossings on the three sides of a face. For many
/// points of one face there is `face_map()`. Where all parts of the surface are needed, or points all over it, the refinement, with
/// `Refinement_locator`, is faster, as long as it fits into memory.
///
/// Queries change nothing: any number of them may run at the same time. Keeps references to the triangulation given and the metric.
///
/// For a mesh, `Imported_mesh` translates. A point of the face `fd` is a point of the input face `mesh.index_of_face(fd)`, and its
/// barycentric coordinates are those of the vertices around `fd` from `source(halfedge(fd, tm), tm)` on, as in a `Face_location` of
/// Polygon Mesh Processing; an answer lies in `mesh.face(point.input_face)`.
///
/// Its `status` is `OK`, `EMPTY_MESH`, `TOO_MANY_CROSSINGS` (more than allowed for one face, or of one edge more than 32 bits can
/// count), or `OUT_OF_MEMORY`; its `amount` is the number of crossings, for a metric of the double those of both halves.
///
/// \tparam NT_ number type of the coordinates: that of the metric
template <typename NT_ = double>
class Surface_locator : public Outcome
{
  typedef Conformal_metric<NT_> Metric;
  typedef typename Metric::Wide_number Wide;
  typedef internal::Complex_number<Wide> Complex;
  typedef internal::Overlay_crossing<Wide> Crossing;

public:
  typedef NT_ NT;               ///< number type of the coordinates
  typedef std::uint32_t Index;  ///< of faces

  /// A point of the input surface.
  struct Surface_point
  {
    Index input_face;               ///< the face of the input
    std::array<NT, 3> barycentric;  ///< with sum 1, none negative; entry `k` belongs to the origin of the halfedge `3 * input_face + k`
    Index flat_face;                ///< the face of `Conformal_metric::triangulation` in which the point lies
  };

  /// A point of the layout.
  struct Layout_point
  {
    std::array<NT, 2> uv;  ///< where it lies

    /// e^{-u} at the vertices, scaled to a maximum of 1 there. The homogeneous coordinates `weight` times (`uv`, 1) are linear in
    /// barycentric coordinates with sum 1, on every part of a face.
    NT weight;

    Index flat_face;       ///< the face of `Conformal_metric::triangulation` in which the point lies
  };

  /// The map of one face of the input: its parts, and their projective maps.
  class Face_map
  {
  public:
    /// the face of the input
    Index input_face() const { return input_face_; }

    /// the number of parts into which the edges of the metric's triangulation cut the face
    std::size_t number_of_parts() const { return flat_face_.size(); }

    /// returns where the point with the barycentric coordinates `b` lies. Linear in the number of parts.
    /// \pre `b` has finite entries >= 0, not all 0; they need not sum up to 1
    Layout_point layout_point(const std::array<NT, 3>& b) const
    {
      CGAL_precondition(is_place(b));
      const NT largest = (std::max)(b[0], (std::max)(b[1], b[2]));
      std::array<Wide, 3> place = {{ Wide(b[0]) / largest, Wide(b[1]) / largest, Wide(b[2]) / largest }};
      const Wide sum = place[0] + place[1] + place[2];
      for(Wide& x : place)
        x /= sum;
      const auto point = cells_.at(place);
      const std::array<Wide, 3> image = point.image();
      return {{{ static_cast<NT>(image[0]), static_cast<NT>(image[1]) }}, static_cast<NT>(image[2]), flat_face_[point.cell]};
    }

    /// returns the points of the face that lie at `uv`: one for each part in which `uv` is, or on whose boundary. Whether a part,
    /// with its corners rounded to `NT`, contains `uv` is decided exactly for `double`. Linear in the number of parts.
    std::vector<Surface_point> surface_points(const std::array<NT, 2>& uv) const
    {
      std::vector<Surface_point> result;
      cells_.for_each_at(uv, [&](const auto& point)
      {
        const std::array<Wide, 3> b = point.preimage();
        result.push_back({ input_face_, {{ static_cast<NT>(b[0]), static_cast<NT>(b[1]), static_cast<NT>(b[2]) }},
                           flat_face_[point.cell] });
      });
      return result;
    }

  private:
    friend class Surface_locator;

    Face_map() = default;

    static bool is_place(const std::array<NT, 3>& b)
    {
      for(const NT& x : b)
        if(!(x >= 0) || !std::isfinite(static_cast<double>(x)))
          return false;
      return b[0] > 0 || b[1] > 0 || b[2] > 0;
    }

    Index input_face_ = 0;
    internal::Projective_cells<Wide, NT> cells_;
    std::vector<Index> flat_face_; // by cell
  };

  /// prepares the queries. O(n log n) for `n` faces, and linear in the number of crossings, of which none is kept. If there were no
  /// flips, none are repeated.
  ///
  /// \param input the triangulation that was given to the solver
  /// \param metric what the solver returned
  /// \param cut what it leaves should be disks, with all cones on their borders, as `compute_cut_graph()` provides
  /// \param maximum_number_of_crossings the limit for the three sides of one face together; it is checked before memory is
  ///        allocated for them
  /// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
  ///
  /// \cgalNamedParamsBegin
  ///   \cgalParamNBegin{layout_frame} \cgalParamDescription{as in `compute_layout()`} \cgalParamNEnd
  /// \cgalNamedParamsEnd
  ///
  /// \pre `metric` is a success; its triangulation is `input`, or was made from it by `Conformal_metric::flips`.
  template <typename NamedParameters = parameters::Default_named_parameters>
  Surface_locator(const Intrinsic_triangulation<NT>& input, const Conformal_metric<NT>& metric, const Cut_graph& cut,
                  std::uint64_t maximum_number_of_crossings = default_maximum_number_of_crossings,
                  const NamedParameters& np = parameters::default_values())
    : input_(&input), metric_(&metric), size_{input.number_of_vertices(), input.number_of_edges(), input.number_of_faces()}
  {
    using parameters::choose_parameter;
    using parameters::get_parameter;
    CGAL_precondition(bool(metric));
    CGAL_precondition(metric.triangulation.number_of_halfedges() == (metric.is_doubled ? 2 : 1) * input.number_of_halfedges());
    if(input.number_of_faces() == 0)
    {
      status = Status::EMPTY_MESH;
      return;
    }
    const auto frame = choose_parameter(get_parameter(np, internal_np::conformal_layout_frame), Layout_frame::CANONICAL);
    try
    {
      if(!metric.is_doubled)
      {
        prepare(cut, maximum_number_of_crossings, frame);
        return;
      }
      const auto twofold = std::make_shared<const internal::Surface_double<NT> >(input);
      input_ = &twofold->triangulation;
      double_ = twofold;
      prepare(twofold->cut(input, cut), maximum_number_of_crossings, frame);
    }
    catch(const std::bad_alloc&)
    {
      status = Status::OUT_OF_MEMORY;
    }
  }

  /// returns where the point with the barycentric coordinates `b` in the face `input_face` of the input lies. Linear in the number
  /// of crossings on the sides of the face.
  /// \pre the locator is a success; `input_face` is the number of a face; `b` has finite entries >= 0, not all 0; they need not sum
  ///      up to 1
  Layout_point layout_point(Index input_face, const std::array<NT, 3>& b) const
  {
    return face_map(input_face).layout_point(b);
  }

  /// returns the points of the surface that lie at `uv`, ordered by faces: none outside of the layout, several where it covers
  /// itself, and one for each part of a face on whose boundary `uv` is. About O(log n), and linear in the number of crossings on the
  /// sides of the faces with bounding boxes around `uv`.
  /// \pre the locator is a success
  std::vector<Surface_point> surface_points(const std::array<NT, 2>& uv) const
  {
    CGAL_precondition(bool(*this));
    std::vector<Surface_point> result;
    const double x = static_cast<double>(uv[0]), y = static_cast<double>(uv[1]);
    tree_->for_each_around({{ x, y }}, [&](Index f)
    {
      if(!strips_[f].is_between(x, y))
        return;
      const std::vector<Surface_point> points = face_map(f).surface_points(uv);
      result.insert(result.end(), points.begin(), points.end());
    });
    std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.input_face < b.input_face; });
    return result;
  }

  /// returns the map of one face, with which several points of the face are found without finding its parts again. It needs the
  /// locator no longer. Time and memory are linear in the number of crossings on the sides of the face.
  /// \pre the locator is a success; `input_face` is the number of a face
  Face_map face_map(Index input_face) const
  {
    CGAL_precondition(bool(*this) && input_face < size_.faces);
    std::array<Side, 3> sides;
    for(Index k = 0; k < 3; ++k)
      sides[k] = side(3 * input_face + k);
    internal::Triangle_cells triangle;
    triangle.cut({{ sides[0].corners.size() - 1, sides[1].corners.size() - 1, sides[2].corners.size() - 1 }});
    Face_map result;
    result.input_face_ = input_face;
    triangle.for_each([&](const std::vector<internal::Triangle_cells::Segment>& cell)
    {
      Index flat_face = 0;
      for(const internal::Triangle_cells::Segment& segment : cell)
      {
        const Side& from = sides[triangle.side(segment.from)];
        const std::size_t position = triangle.position(segment.from);
        result.cells_.add_corner(from.corners[position]);
        if(segment.is_on_side)
          flat_face = from.flat_faces[position];
      }
      result.cells_.end_cell();
      result.flat_face_.push_back(flat_face);
    });
    return result;
  }

private:
  typedef internal::Normal_coordinates::Start Start;
  typedef internal::Normal_coordinates::Path Path;

  // One side of an input face, without its target.
  struct Side
  {
    std::vector<internal::Cell_corner<Wide, NT> > corners; // the origin, then the crossings
    std::vector<Index> flat_faces;                         // by corner: the face of the metric's triangulation between it and the next one
  };

  const Intrinsic_triangulation<NT>& flat() const { return metric_->triangulation; }

  void prepare(const Cut_graph& cut, std::uint64_t maximum_number_of_crossings, const internal::Any_frame& frame)
  {
    if(metric_->is_retriangulated() && !read_flips(maximum_number_of_crossings))
    {
      status = Status::TOO_MANY_CROSSINGS;
      return;
    }
    layout_.emplace(*input_, *metric_, cut, size_, frame);
    weights_ = internal::vertex_weights(*metric_);
    find_strips();
    std::vector<internal::Box<2> > boxes;
    boxes.reserve(strips_.size());
    for(const internal::Bounding_strip& strip : strips_)
      boxes.push_back(strip.box());
    tree_.emplace(std::move(boxes));
  }

  // Are there few enough crossings to go on?
  bool read_flips(std::uint64_t maximum_number_of_crossings)
  {
    record_.emplace(internal::replay_flips(*input_, metric_->flips));
    amount = static_cast<double>(record_->total_crossings());
    if(record_->has_overflowed())
      return false;
    const std::vector<Start> starts = record_->starts(flat()); // by halfedge
    starts_.reserve(size_.edges);
    for(Index e = 0; e < size_.edges; ++e)
      starts_.push_back(starts[input_->edge_halfedge(e)]);
    if(record_->total_crossings() <= maximum_number_of_crossings)
      return true;
    const auto length = [&](Index h)
      { return record_->length_of_path(flat(), starts[input_->edge_halfedge(input_->edge(h))], maximum_number_of_crossings + 1); };
    for(Index h = 0; h < 3 * size_.faces; h += 3)
      if(length(h) > maximum_number_of_crossings || length(h) + length(h + 1) + length(h + 2) > maximum_number_of_crossings)
        return false;
    return true;
  }

  // Calls `visit(crossing)` for the crossings on the edge `e` of the input, along its first halfedge.
  template <typename Visit>
  void for_each_crossing(Index e, internal::Geodesic_strip<NT>& geodesic, Visit visit) const
  {
    const Path path = record_->path(flat(), starts_[e]);
    if(!path.is_edge)
      geodesic(e, path, [&](std::size_t, const Crossing& crossing) { visit(crossing); });
  }

  // Of the input halfedge `h`.
  Side side(Index h) const
  {
    const Index e = input_->edge(h), k = h % 3;
    const bool is_first = h == input_->edge_halfedge(e);
    Side result;
    internal::Cell_corner<Wide, NT> corner = {{{ Wide(0), Wide(0), Wide(0) }}, internal::plane_point<NT>(layout_->origin(h)),
                                              weights_[input_->origin(h)]};
    corner.barycentric[k] = Wide(1);
    result.corners.push_back(corner);
    if(!record_)
    {
      result.flat_faces.push_back(input_->face(h));
      return result;
    }

    std::vector<Index> crossed; // the flat halfedges, from the face before the crossing to the one behind it
    internal::Geodesic_strip<NT> geodesic(*metric_, weights_);
    for_each_crossing(e, geodesic, [&](const Crossing& x)
    {
      const Wide rest = 1 - x.parameter;
      corner.barycentric[k] = is_first ? rest : x.parameter;
      corner.barycentric[(k + 1) % 3] = is_first ? x.parameter : rest;
      corner.uv = internal::plane_point<NT>(layout_->place(x, h));
      corner.weight = x.weight;
      result.corners.push_back(corner);
      crossed.push_back(is_first ? x.halfedge : flat().twin(x.halfedge));
    });
    if(crossed.empty()) // the side is an edge of the flat triangulation, too
    {
      const Index first = starts_[e].first;
      result.flat_faces.push_back(flat().face(is_first ? first : flat().twin(first)));
      return result;
    }
    if(!is_first)
    {
      std::reverse(result.corners.begin() + 1, result.corners.end());
      std::reverse(crossed.begin(), crossed.end());
    }
    for(Index c : crossed)
      result.flat_faces.push_back(flat().face(c));
    result.flat_faces.push_back(flat().face(flat().twin(crossed.back())));
    return result;
  }

  // They hold the corners of all parts, as rounded.
  void find_strips()
  {
    const auto point = [](const Complex& z)
    {
      const std::array<NT, 2> p = internal::plane_point<NT>(z);
      return std::array<double, 2>{{ static_cast<double>(p[0]), static_cast<double>(p[1]) }};
    };
    strips_.reserve(size_.faces);
    for(Index h = 0; h < 3 * size_.faces; h += 3)
      strips_.emplace_back(std::array<std::array<double, 2>, 3>{{ point(layout_->origin(h)), point(layout_->origin(h + 1)),
                                                                  point(layout_->origin(h + 2)) }});
    if(!record_)
      return;
    internal::Geodesic_strip<NT> geodesic(*metric_, weights_);
    for(Index e = 0; e < size_.edges; ++e)
    {
      const Index h = input_->edge_halfedge(e), g = input_->twin(h);
      for_each_crossing(e, geodesic, [&](const Crossing& x)
      {
        strips_[input_->face(h)].insert(point(layout_->place(x, h)));
        if(g != input_->null_index && input_->face(g) < size_.faces)
          strips_[input_->face(g)].insert(point(layout_->place(x, g)));
      });
    }
  }

  const Intrinsic_triangulation<NT>* input_;                      // the surface given, or its double
  std::shared_ptr<const internal::Surface_double<NT> > double_;
  const Metric* metric_;
  internal::Surface_size size_;
  std::optional<internal::Normal_coordinates> record_;            // if there are flips
  std::vector<Start> starts_;                                     // by edge: of its first halfedge
  std::optional<internal::Overlay_layout<NT> > layout_;
  std::vector<Wide> weights_;                                     // by vertex
  std::vector<internal::Bounding_strip> strips_;                  // by face of the surface given
  std::optional<internal::Box_tree<2> > tree_;                    // of their boxes
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_SURFACE_LOCATOR_H
