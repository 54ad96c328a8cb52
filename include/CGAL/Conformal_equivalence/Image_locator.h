// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Image_locator.h
/// A surface on the unit sphere, or in the unit disk, point by point and in both directions (section 4.3 of Springborn, Schroeder and Pinkall, 2008;
/// map_to_sphere.h, map_to_disk.h). Within triangles, or the parts of triangles where edges were flipped, the map is projective (section 3.4).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_IMAGE_LOCATOR_H
#define CGAL_CONFORMAL_EQUIVALENCE_IMAGE_LOCATOR_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Inscribed_mapping.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Projective_atlas.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/images.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/assertions.h>

#include <boost/graph/graph_traits.hpp>

#include <array>
#include <cstdint>
#include <new>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// maps a mesh to the unit sphere or to the unit disk, and answers where a point of the mesh lies there, and which point of the mesh lies at a point
/// of the image: `Sphere_locator` and `Disk_locator`. Where edges were flipped, triangles are mapped part by part (`Spherical_refinement`,
/// `Common_refinement`).
///
/// The triangle, or part, that holds a point of the image is found by exact predicates on the points as they were computed, in pairs of
/// `double`. Keeps a reference to the mesh. Queries change nothing: any number of them may run at the same time.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam Image what the mesh is mapped to: named by `Sphere_locator` and `Disk_locator`
template <typename TriangleMesh, typename Image>
class Image_locator
{
  typedef boost::graph_traits<TriangleMesh> Traits;

public:
  typedef TriangleMesh Triangle_mesh;                           ///< type of the mesh
  typedef typename Traits::vertex_descriptor vertex_descriptor; ///< of the mesh
  typedef typename Traits::face_descriptor face_descriptor;     ///< of the mesh

  /// A point of the mesh: a face, and barycentric coordinates with sum 1, none negative, of the vertices around the face from
  /// `source(halfedge(f, tm), tm)` on. It is the `Face_location` of Polygon Mesh Processing.
  typedef std::pair<face_descriptor, std::array<double, 3> > Face_location;

  typedef typename Image::Point Image_point; ///< a point of space, or of the plane: an array of three or two `double`

  /// maps the mesh. Time is that of `map_to_sphere()`, or of `map_to_disk()`, with a refinement, and O(n log n) for `n` faces and crossings.
  ///
  /// \param tm a triangle mesh
  /// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of `map_to_sphere()`, or of `map_to_disk()`; of those
  ///        that receive results, only `visitor` has an effect
  template <typename NamedParameters = parameters::Default_named_parameters>
  explicit Image_locator(const TriangleMesh& tm, const NamedParameters& np = parameters::default_values())
    : atlas_(Imported_mesh<TriangleMesh>(tm))
  {
    typename Image::template Mapping<TriangleMesh> mapping(tm);
    Image::run(mapping, np);
    report_ = mapping.report;
    try
    {
      if(bool(report_))
        set(mapping);
    }
    catch(const std::bad_alloc&)
    {
      report_.status = Status::OUT_OF_MEMORY;
    }
  }

  /// the report of `map_to_sphere()`, or of `map_to_disk()`
  const Flattening_report<TriangleMesh>& report() const { return report_; }

  /// is `true` iff there are answers.
  explicit operator bool() const { return bool(report_); }

  /// returns where a vertex is. \pre `v` is not isolated
  Face_location vertex_location(vertex_descriptor v) const { return atlas_.vertex_location(v); }

  /// returns the point of the image at which a point of the mesh lies. Linear in the number of parts of the face, of which
  /// there is one without flips.
  /// \pre the locator is a success; the coordinates are finite, and one is positive; they need not sum up to 1, and negative ones
  /// count as 0
  Image_point image_point(const Face_location& location) const
  {
    CGAL_precondition(bool(*this));
    return Image::point(image(location));
  }

  /// returns the point of the mesh that lies at `p`: on the sphere, in the direction of `p`; in the disk, if `p` is outside of the image, at the
  /// point of its border that is nearest to `p`. About O(log n), where points do not crowd beyond the resolution of `double`. On an edge, any of its
  /// faces is chosen, but always the same one.
  /// \pre the locator is a success; `p` is finite, and not 0 if it is a direction
  Face_location surface_point(const Image_point& p) const { return preimage(Image::vector(p)); }

private:
  template <typename LocatorA, typename LocatorB> friend class Surface_correspondence;

  // Fills the atlas, and names faces that are not positive.
  void set(typename Image::template Mapping<TriangleMesh>& mapping)
  {
    internal::Straight_parts straight = Image::parts(mapping);
    atlas_ = internal::Projective_atlas<TriangleMesh>(std::move(mapping.mesh));
    const std::vector<std::uint32_t> flipped = atlas_.set(std::move(straight.parts), std::move(straight.points), std::move(straight.weights));
    internal::tell_verdict(atlas_.mesh(), flipped, {}, report_);
    if(bool(report_))
      image_.set_border(atlas_);
  }

  internal::Wide_vector image(const Face_location& location) const { return Image::normalized(atlas_.image(location)); }

  Face_location preimage(const internal::Wide_vector& p) const
  {
    CGAL_precondition(bool(*this));
    const std::optional<Face_location> result = atlas_.preimage(p);
    return result ? *result : image_.outside(atlas_, p);
  }

  internal::Projective_atlas<TriangleMesh> atlas_;
  Image image_;
  Flattening_report<TriangleMesh> report_;
};

/// \ingroup PkgConformalEquivalenceLayout
///
/// maps a closed mesh of genus 0 to the unit sphere, as `map_to_sphere()` does, and answers where a point of the mesh lies on the
/// sphere, and which point of the mesh lies in a direction: every direction has one, also on edges and at vertices.
template <typename TriangleMesh>
using Sphere_locator = Image_locator<TriangleMesh, internal::Sphere_image>;

/// \ingroup PkgConformalEquivalenceLayout
///
/// maps a topological disk to the unit disk, as `map_to_disk()` does, and answers where a point of the mesh lies in the disk, and
/// which point of the mesh lies at a point of the plane. The image is a polygon inscribed to the circle. What lies outside of it, between its sides
/// and the circle, say, belongs to the nearest point of its border.
template <typename TriangleMesh>
using Disk_locator = Image_locator<TriangleMesh, internal::Disk_image>;

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_IMAGE_LOCATOR_H
