// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Surface_correspondence.h
/// Two surfaces, point by point. Two closed surfaces without handles have the unit sphere in common, two disks the unit disk: the
/// map of the one to it (section 4.3 of Springborn, Schroeder and Pinkall, 2008; map_to_sphere.h, map_to_disk.h), followed by the
/// inverse of that of the other, takes the points of the one to those of the other. Within triangles, or the parts of triangles
/// where edges were flipped, either map is projective (section 3.4).
///
///             A                                        B
///        +---------+      +------------------+      +-----+
///        |   x     | ---> |  sphere or disk  | ---> | y   |         y = correspondence(x)
///        +---------+      +------------------+      +-----+         x = correspondence.inverse(y)

#ifndef CGAL_CONFORMAL_EQUIVALENCE_SURFACE_CORRESPONDENCE_H
#define CGAL_CONFORMAL_EQUIVALENCE_SURFACE_CORRESPONDENCE_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Disk_frame.h>
#include <CGAL/Conformal_equivalence/Image_locator.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Projective_atlas.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Three_point_transformation.h>
#include <CGAL/Conformal_equivalence/map_to_disk.h>
#include <CGAL/Conformal_equivalence/map_to_sphere.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/assertions.h>

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// Three vertices of one surface, and those of another one that correspond to them.
///
/// \tparam VertexA, VertexB vertex descriptors
template <typename VertexA, typename VertexB>
struct Three_landmarks
{
  std::array<VertexA, 3> a; ///< different vertices of the first surface
  std::array<VertexB, 3> b; ///< different vertices of the second surface
};

/// \ingroup PkgConformalEquivalenceLayout
///
/// The composed map of two surfaces with the same image, and its inverse: `make_sphere_correspondence()` and
/// `make_disk_correspondence()` make it.
///
/// Between two spheres it is one-to-one, and continuous: a path on the one becomes a path on the other. Points that go there and
/// back return to where they were, but for rounding: that of barycentric coordinates in `double`, as much as the maps stretch it.
/// Between two disks it is continuous, too, and takes all of the one to the other, but for the slivers by which the two inscribed
/// polygons differ: their points go to the nearest ones of the border.
///
/// Conformally equivalent surfaces with the same triangulation correspond vertex by vertex, if three vertices do.
///
/// \tparam LocatorA, LocatorB two instances of `Sphere_locator`, or of `Disk_locator`
template <typename LocatorA, typename LocatorB>
class Surface_correspondence
{
public:
  typedef typename LocatorA::vertex_descriptor Vertex_a;    ///< of the first surface
  typedef typename LocatorB::vertex_descriptor Vertex_b;    ///< of the second surface
  typedef typename LocatorA::Face_location Face_location_a; ///< a point of the first surface
  typedef typename LocatorB::Face_location Face_location_b; ///< a point of the second surface

  /// composes two maps, as they are.
  Surface_correspondence(LocatorA a, LocatorB b) : a_(std::move(a)), b_(std::move(b)), status_(status_of_maps()) {}

  /// composes two maps to the sphere, with the Moebius transformation of it between them that brings three points to three others.
  Surface_correspondence(LocatorA a, LocatorB b, const Three_landmarks<Vertex_a, Vertex_b>& landmarks)
    : Surface_correspondence(std::move(a), std::move(b))
  {
    if(!is_success(status_))
      return;
    internal::Three_point_transformation::Three_points a_points, b_points;
    for(std::size_t i = 0; i < 3; ++i)
    {
      a_points[i] = a_.image(a_.vertex_location(landmarks.a[i]));
      b_points[i] = b_.image(b_.vertex_location(landmarks.b[i]));
    }
    forward_.emplace(a_points, b_points);
    backward_.emplace(b_points, a_points);
    if(!forward_->is_valid())
      status_ = Status::SINGULAR_PROBLEM;
  }

  /// `OK`, or else the status of the map that failed; `SINGULAR_PROBLEM` if two landmarks lie at the same point
  Status status() const { return status_; }

  /// is `true` iff there are answers.
  explicit operator bool() const { return is_success(status_); }

  const LocatorA& first() const { return a_; }  ///< the map of the first surface, with its report
  const LocatorB& second() const { return b_; } ///< the map of the second surface, with its report

  /// returns the point of the second surface that corresponds to one of the first.
  /// \pre the correspondence is a success; otherwise as for `Image_locator::image_point()`, in time, too
  Face_location_b operator()(const Face_location_a& location) const
  {
    CGAL_precondition(bool(*this));
    return b_.preimage(moved(a_.image(location), forward_));
  }

  /// returns the point of the second surface that corresponds to a vertex of the first.
  Face_location_b operator()(Vertex_a v) const { return (*this)(a_.vertex_location(v)); }

  /// returns the point of the first surface that corresponds to one of the second.
  /// \pre as above
  Face_location_a inverse(const Face_location_b& location) const
  {
    CGAL_precondition(bool(*this));
    return a_.preimage(moved(b_.image(location), backward_));
  }

  /// returns the point of the first surface that corresponds to a vertex of the second.
  Face_location_a inverse(Vertex_b v) const { return inverse(b_.vertex_location(v)); }

private:
  typedef std::optional<internal::Three_point_transformation> Transformation;

  Status status_of_maps() const { return bool(a_) ? b_.report().status : a_.report().status; }

  static internal::Wide_vector moved(const internal::Wide_vector& p, const Transformation& transformation)
  {
    return transformation ? (*transformation)(internal::unit_vector(p)) : p;
  }

  LocatorA a_;
  LocatorB b_;
  Transformation forward_, backward_;
  Status status_;
};

/// \ingroup PkgConformalEquivalenceLayout
/// Between two closed surfaces of genus 0.
template <typename TriangleMeshA, typename TriangleMeshB>
using Sphere_correspondence = Surface_correspondence<Sphere_locator<TriangleMeshA>, Sphere_locator<TriangleMeshB> >;

/// \ingroup PkgConformalEquivalenceLayout
/// Between two topological disks.
template <typename TriangleMeshA, typename TriangleMeshB>
using Disk_correspondence = Surface_correspondence<Disk_locator<TriangleMeshA>, Disk_locator<TriangleMeshB> >;

/// \ingroup PkgConformalEquivalenceDoors
///
/// maps two closed surfaces of genus 0 to each other, by way of the unit sphere. Both are turned as `map_to_sphere()` does it, to
/// the points of their own vertices: so surfaces should look into the same direction, or be given landmarks.
///
/// \tparam TriangleMeshA, TriangleMeshB models of `FaceListGraph`
/// \param a, b the surfaces, of which references are kept
/// \param np_a, np_b optional sequences of \ref bgl_namedparameters "Named Parameters" for either, as for `Sphere_locator`
/// \return the map of points of `a` to those of `b`. Reports are in its `first()` and `second()`.
///
/// \sa `CGAL::Conformal_equivalence::map_to_sphere()`
template <typename TriangleMeshA, typename TriangleMeshB,
          typename NamedParametersA = parameters::Default_named_parameters,
          typename NamedParametersB = parameters::Default_named_parameters>
Sphere_correspondence<TriangleMeshA, TriangleMeshB>
make_sphere_correspondence(const TriangleMeshA& a, const TriangleMeshB& b,
                           const NamedParametersA& np_a = parameters::default_values(),
                           const NamedParametersB& np_b = parameters::default_values())
{
  return { Sphere_locator<TriangleMeshA>(a, np_a), Sphere_locator<TriangleMeshB>(b, np_b) };
}

/// \ingroup PkgConformalEquivalenceDoors
///
/// maps two closed surfaces of genus 0 to each other, by way of the unit sphere, so that three landmarks correspond: there is
/// exactly one Moebius transformation of the sphere that does it.
///
/// \param a, b, np_a, np_b as above
/// \param landmarks three vertices on either side. \pre none of them is isolated
/// \return as above; `SINGULAR_PROBLEM` if two landmarks of one side lie at the same point
template <typename TriangleMeshA, typename TriangleMeshB, typename VertexA, typename VertexB,
          typename NamedParametersA = parameters::Default_named_parameters,
          typename NamedParametersB = parameters::Default_named_parameters>
Sphere_correspondence<TriangleMeshA, TriangleMeshB>
make_sphere_correspondence(const TriangleMeshA& a, const TriangleMeshB& b,
                           const Three_landmarks<VertexA, VertexB>& landmarks,
                           const NamedParametersA& np_a = parameters::default_values(),
                           const NamedParametersB& np_b = parameters::default_values())
{
  return { Sphere_locator<TriangleMeshA>(a, np_a), Sphere_locator<TriangleMeshB>(b, np_b), landmarks };
}

/// \ingroup PkgConformalEquivalenceDoors
///
/// maps two topological disks to each other, by way of the unit disk. Which of the maps this is, is said by their frames
/// (`disk_frame`): the same inner point in the centre of both, say.
///
/// \tparam TriangleMeshA, TriangleMeshB models of `FaceListGraph`
/// \param a, b the surfaces, of which references are kept
/// \param np_a, np_b optional sequences of \ref bgl_namedparameters "Named Parameters" for either, as for `Disk_locator`
/// \return the map of points of `a` to those of `b`. Reports are in its `first()` and `second()`.
///
/// \sa `CGAL::Conformal_equivalence::map_to_disk()`
template <typename TriangleMeshA, typename TriangleMeshB,
          typename NamedParametersA = parameters::Default_named_parameters,
          typename NamedParametersB = parameters::Default_named_parameters>
Disk_correspondence<TriangleMeshA, TriangleMeshB>
make_disk_correspondence(const TriangleMeshA& a, const TriangleMeshB& b,
                         const NamedParametersA& np_a = parameters::default_values(),
                         const NamedParametersB& np_b = parameters::default_values())
{
  return { Disk_locator<TriangleMeshA>(a, np_a), Disk_locator<TriangleMeshB>(b, np_b) };
}

/// \ingroup PkgConformalEquivalenceDoors
///
/// maps two topological disks to each other, by way of the unit disk, so that three landmarks on the borders correspond
/// (`Three_point_disk_frame`).
///
/// \param a, b, np_a, np_b as above; frames among them do not count
/// \param landmarks three border vertices on either side, in the order in which they follow each other with the surface on the left
/// \return as above; `SINGULAR_PROBLEM` if landmarks are in the other order
template <typename TriangleMeshA, typename TriangleMeshB, typename VertexA, typename VertexB,
          typename NamedParametersA = parameters::Default_named_parameters,
          typename NamedParametersB = parameters::Default_named_parameters>
Disk_correspondence<TriangleMeshA, TriangleMeshB>
make_disk_correspondence(const TriangleMeshA& a, const TriangleMeshB& b,
                         const Three_landmarks<VertexA, VertexB>& landmarks,
                         const NamedParametersA& np_a = parameters::default_values(),
                         const NamedParametersB& np_b = parameters::default_values())
{
  const Three_point_disk_frame<VertexA> frame_a = { landmarks.a };
  const Three_point_disk_frame<VertexB> frame_b = { landmarks.b };
  return { Disk_locator<TriangleMeshA>(a, combine_named_parameters(np_a, parameters::disk_frame(frame_a))),
           Disk_locator<TriangleMeshB>(b, combine_named_parameters(np_b, parameters::disk_frame(frame_b))) };
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_SURFACE_CORRESPONDENCE_H
