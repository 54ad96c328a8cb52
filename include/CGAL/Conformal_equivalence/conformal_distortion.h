// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_DISTORTION_H
#define CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_DISTORTION_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/quasi_conformal_factor.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

/// \file conformal_distortion.h
///
/// How far a layout of a triangle mesh in the plane is from being conformal and from preserving areas;
/// for any layout, made by this package or by another method
/// (Springborn, Schroeder, Pinkall 2008, Section 7, the column |qc|_1; Kharevych, Springborn, Schroeder 2006).
///
/// In each triangle the layout is an affine map f with singular values s_max >= s_min.  In complex notation
///
///     f(z) = f_z z + f_zbar conj(z) + const,    s_max = |f_z| + |f_zbar|,    s_min = | |f_z| - |f_zbar| |,
///
/// and the quasi-conformal factor is s_max / s_min: 1 where f is a similarity, infinite where the image of the
/// triangle is a segment or a point.

namespace CGAL {
namespace Conformal_equivalence {

// ---------------------------------------------------------------------------------------------------
// One triangle
// ---------------------------------------------------------------------------------------------------

/// \ingroup PkgConformalEquivalenceJudging
///
/// returns the quasi-conformal factor of the affine map from a triangle, given by its edge lengths, to a
/// triangle of the plane: the ratio `s_max / s_min` of its singular values.
///
/// \param lengths the edge lengths; entry `i` is opposite vertex `i`.
/// \param corners the coordinates of the images of the vertices.
/// \return a number >= 1, whichever way the image is oriented; infinity if the image has no area (decided
///   exactly) or a coordinate that is not finite; NaN if the triangle itself has no area or violates the
///   triangle inequality.
inline double quasi_conformal_factor(const std::array<double, 3>& lengths,
                                     const std::array<std::array<double, 2>, 3>& corners)
{
  return internal::quasi_conformal_factor(internal::frame_from_lengths(lengths), corners);
}

// ---------------------------------------------------------------------------------------------------
// A face of a mesh
// ---------------------------------------------------------------------------------------------------

namespace internal {

template <typename NamedParameters>
constexpr bool has_edge_length_map()
{
  return is_given<internal_np::conformal_edge_length_t, NamedParameters>;
}

// The halfedges h_0, h_1, h_2 of a face.  Vertex i is the target of h_i, where uv[h_i] belongs; opposite lies the
// edge of h_{i+2}, which goes from vertex i+1 to vertex i+2.
template <typename TriangleMesh>
std::array<typename boost::graph_traits<TriangleMesh>::halfedge_descriptor, 3>
halfedges_of_face(const TriangleMesh& tm, typename boost::graph_traits<TriangleMesh>::face_descriptor fd)
{
  const auto h = halfedge(fd, tm);
  return {{ h, next(h, tm), prev(h, tm) }};
}

template <typename Point>
Space_vector difference(const Point& q, const Point& p)
{
  return {{ CGAL::to_double(q.x() - p.x()), CGAL::to_double(q.y() - p.y()), CGAL::to_double(q.z() - p.z()) }};
}

template <typename TriangleMesh, typename NamedParameters>
Triangle_frame triangle_frame(const TriangleMesh& tm,
                              typename boost::graph_traits<TriangleMesh>::face_descriptor fd,
                              const NamedParameters& np)
{
  const auto h = halfedges_of_face(tm, fd);
  if constexpr(has_edge_length_map<NamedParameters>())
  {
    const auto lengths = parameters::get_parameter(np, internal_np::conformal_edge_length);
    std::array<double, 3> l;
    for(std::size_t i = 0; i < 3; ++i)
      l[i] = CGAL::to_double(get(lengths, edge(h[(i + 2) % 3], tm)));
    return frame_from_lengths(l);
  }
  else
  {
    const auto points = parameters::choose_parameter(
      parameters::get_parameter(np, internal_np::vertex_point), get_const_property_map(CGAL::vertex_point, tm));
    std::array<Space_vector, 3> e;
    for(std::size_t i = 0; i < 3; ++i)
      e[i] = difference(get(points, target(h[(i + 2) % 3], tm)), get(points, target(h[(i + 1) % 3], tm)));
    return frame_from_edge_vectors(e);
  }
}

template <typename TriangleMesh, typename HalfedgeUVMap>
UV_corners layout_corners(const TriangleMesh& tm,
                          HalfedgeUVMap uv,
                          typename boost::graph_traits<TriangleMesh>::face_descriptor fd)
{
  const auto h = halfedges_of_face(tm, fd);
  UV_corners w;
  for(std::size_t i = 0; i < 3; ++i)
  {
    const typename boost::property_traits<HalfedgeUVMap>::value_type p = get(uv, h[i]);
    w[i] = {{ CGAL::to_double(p.x()), CGAL::to_double(p.y()) }};
  }
  return w;
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceJudging
///
/// returns the quasi-conformal factor `s_max / s_min` of a layout in one face, for example to colour a picture.
///
/// \tparam TriangleMesh a model of `FaceGraph`.
/// \tparam HalfedgeUVMap a model of `ReadablePropertyMap` with key
///   `boost::graph_traits<TriangleMesh>::%halfedge_descriptor` and a `Point_2` of a \cgal kernel as value.
/// \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
///
/// \param tm the mesh.
/// \param uv the layout: `uv[h]` is the corner of `target(h)` in `face(h)`; read as `double`.
/// \param fd a triangle of `tm`.
/// \param np as for `compute_conformal_distortion()`.
/// \return a number >= 1, infinity if the face has no area in the layout, NaN if it has none in `tm`.
template <typename TriangleMesh, typename HalfedgeUVMap,
          typename NamedParameters = parameters::Default_named_parameters>
double quasi_conformal_factor(const TriangleMesh& tm,
                              HalfedgeUVMap uv,
                              typename boost::graph_traits<TriangleMesh>::face_descriptor fd,
                              const NamedParameters& np = parameters::default_values())
{
  return internal::quasi_conformal_factor(internal::triangle_frame(tm, fd, np),
                                          internal::layout_corners(tm, uv, fd));
}

// ---------------------------------------------------------------------------------------------------
// A whole mesh
// ---------------------------------------------------------------------------------------------------

/// \ingroup PkgConformalEquivalenceJudging
///
/// The distortion of a layout, as found by `compute_conformal_distortion()`.  Without any face of positive
/// area, the numbers keep the values of a similarity.
template <typename TriangleMesh>
struct Conformal_distortion
{
  /// a face of the mesh.
  typedef typename boost::graph_traits<TriangleMesh>::face_descriptor face_descriptor;

  /// the mean of the quasi-conformal factor, weighted by the areas of the faces in the mesh; >= 1;
  /// infinite if `number_of_collapsed_faces` is not 0.
  double mean_quasi_conformal_factor = 1;

  /// the maximum of the quasi-conformal factor.
  double maximum_quasi_conformal_factor = 1;

  /// a face where the maximum is attained (the first one); a null face if there is none of positive area.
  face_descriptor face_of_maximum = boost::graph_traits<TriangleMesh>::null_face();

  /// the least value of log(area in the layout / area in the mesh), both areas as parts of their totals.
  double minimum_log_area_ratio = 0;

  /// the largest value of the same.
  double maximum_log_area_ratio = 0;

  /// the root mean square of the same, weighted by the areas of the faces in the mesh.
  double root_mean_square_log_area_ratio = 0;

  /// the least u: of the map `log_scale_factor_map` if given, else of the corners' values by Equation (5).
  double minimum_log_scale_factor = 0;

  /// the largest u.
  double maximum_log_scale_factor = 0;

  /// the number of faces left out because they have no area in the mesh.
  std::size_t number_of_skipped_faces = 0;

  /// the number of faces that have an area in the mesh, but none, or no finite coordinates, in the layout.
  std::size_t number_of_collapsed_faces = 0;
};

namespace internal {

// Smallest and largest value met, of those that are numbers.
struct Value_range
{
  double smallest = (std::numeric_limits<double>::infinity)();
  double largest = -(std::numeric_limits<double>::infinity)();

  void include(double x)
  {
    if(x < smallest) smallest = x;
    if(x > largest) largest = x;
  }
  bool is_empty() const { return smallest > largest; }
};

// log of the lengths of the edges opposite the vertices of a frame, and of its image.
inline std::array<double, 3> log_lengths(const Triangle_frame& frame)
{
  const double scale = frame.exponent * 0.69314718055994530942;
  std::array<double, 3> lambda;
  lambda[frame.second()] = std::log(frame.length) + scale;
  lambda[frame.first] = std::log(std::hypot(frame.x, frame.y)) + scale;
  lambda[frame.origin] = std::log(std::hypot(frame.length - frame.x, frame.y)) + scale;
  return lambda;
}

inline std::array<double, 3> log_lengths(const UV_corners& w)
{
  std::array<double, 3> lambda;
  for(std::size_t i = 0; i < 3; ++i)
  {
    const UV_point &j = w[(i + 1) % 3], &k = w[(i + 2) % 3];
    lambda[i] = std::log(std::hypot(k[0] - j[0], k[1] - j[1]));
  }
  return lambda;
}

// The values of u at the corners of a face, Equation (5): u_i = d_j + d_k - d_i, d_i = log(new / old length).
inline void include_log_scale_factors(const Triangle_frame& frame, const UV_corners& w, Value_range& u)
{
  const std::array<double, 3> before = log_lengths(frame), after = log_lengths(w);
  for(std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const double u_i = (after[j] - before[j]) + (after[k] - before[k]) - (after[i] - before[i]);
    if(std::isfinite(u_i))
      u.include(u_i);
  }
}

// What the second pass needs of a face, once the total areas are known.
struct Face_distortion
{
  Scaled_number<double> area, layout_area;
  double factor;
};

// The sum of the areas as a multiple of 2^(exponent of the largest).
template <typename Area>
Scaled_number<double> total_area(const std::vector<Face_distortion>& faces, Area area)
{
  Scaled_number<double> total;
  bool is_first = true;
  for(const Face_distortion& f : faces)
  {
    const Scaled_number<double> a = area(f);
    if(a.mantissa > 0 && (is_first || a.exponent > total.exponent))
    {
      total.exponent = a.exponent;
      is_first = false;
    }
  }
  for(const Face_distortion& f : faces)
    total.mantissa += area(f).scaled_to(total.exponent);
  return total;
}

template <typename TriangleMesh>
void summarize(const std::vector<Face_distortion>& faces, Conformal_distortion<TriangleMesh>& result)
{
  const Scaled_number<double> total = total_area(faces, [](const Face_distortion& f) { return f.area; });
  const Scaled_number<double> layout_total = total_area(faces, [](const Face_distortion& f) { return f.layout_area; });
  const double log_total_ratio = layout_total.logarithm() - total.logarithm();

  double excess = 0, squares = 0;                  // the mean of factor - 1 loses no digits near 1
  Value_range ratios;
  for(const Face_distortion& f : faces)
  {
    const double weight = f.area.scaled_to(total.exponent) / total.mantissa;
    const double ratio = f.layout_area.mantissa > 0 ? f.layout_area.logarithm() - f.area.logarithm() - log_total_ratio
                                                    : -(std::numeric_limits<double>::infinity)();
    ratios.include(ratio);
    if(weight > 0)
    {
      excess += weight * (f.factor - 1);
      squares += weight * ratio * ratio;
    }
  }
  result.mean_quasi_conformal_factor = 1 + excess;
  result.minimum_log_area_ratio = ratios.smallest;
  result.maximum_log_area_ratio = ratios.largest;
  result.root_mean_square_log_area_ratio = std::sqrt(squares);
}

template <typename TriangleMesh, typename NamedParameters>
void include_given_log_scale_factors(const TriangleMesh& tm, const NamedParameters& np, Value_range& u)
{
  const auto u_map = parameters::get_parameter(np, internal_np::conformal_u);
  for(auto v : vertices(tm))
    if(halfedge(v, tm) != boost::graph_traits<TriangleMesh>::null_halfedge())
      u.include(CGAL::to_double(get(u_map, v)));
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceJudging
///
/// computes the angle and area distortion of a layout of a triangle mesh (paper, Section 7: |qc|_1 is the
/// mean, |u|_max follows from the range of u).
///
/// Faces without area in the mesh are left out and counted.  Flipped triangles count like others: see
/// `verify_layout()`, which decides about them exactly.  Areas and lengths may lie anywhere in the range of
/// `double`.  A factor above about 1e15 cannot be told from infinity where the differences of the layout's
/// coordinates are rounded.
///
/// \tparam TriangleMesh a model of `FaceListGraph` and `VertexListGraph`, all faces triangles.
/// \tparam HalfedgeUVMap a model of `ReadablePropertyMap` with key
///   `boost::graph_traits<TriangleMesh>::%halfedge_descriptor` and a `Point_2` of a \cgal kernel as value.
/// \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
///
/// \param tm the mesh.
/// \param uv the layout: `uv[h]` is the corner of `target(h)` in `face(h)`; read as `double`.
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{the points of the vertices, which define the metric}
///     \cgalParamType{a model of `ReadablePropertyMap` with key `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a `Point_3` as value}
///     \cgalParamDefault{`boost::get(CGAL::vertex_point, tm)`}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_length_map}
///     \cgalParamDescription{the edge lengths; if given, the points are not read}
///     \cgalParamType{a model of `ReadablePropertyMap` with key `boost::graph_traits<TriangleMesh>::%edge_descriptor` and a value convertible to `double`}
///     \cgalParamDefault{the distances of the points}
///   \cgalParamNEnd
///   \cgalParamNBegin{log_scale_factor_map}
///     \cgalParamDescription{u, of which the range is reported; only read here}
///     \cgalParamType{a model of `ReadablePropertyMap` with key `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{u is recovered at every corner of a face by Equation (5)}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \pre `tm` is a triangle mesh.
///
/// Linear in the size of the mesh.
template <typename TriangleMesh, typename HalfedgeUVMap,
          typename NamedParameters = parameters::Default_named_parameters>
Conformal_distortion<TriangleMesh>
compute_conformal_distortion(const TriangleMesh& tm,
                             HalfedgeUVMap uv,
                             const NamedParameters& np = parameters::default_values())
{
  constexpr bool u_is_given =
    internal::is_given<internal_np::conformal_u_t, NamedParameters>;

  Conformal_distortion<TriangleMesh> result;
  std::vector<internal::Face_distortion> distortions;
  internal::Value_range u;
  for(auto f : faces(tm))
  {
    const internal::Triangle_frame frame = internal::triangle_frame(tm, f, np);
    if(frame.is_degenerate())
    {
      ++result.number_of_skipped_faces;
      continue;
    }
    const internal::UV_corners w = internal::layout_corners(tm, uv, f);
    const double factor = internal::quasi_conformal_factor(frame, w);
    if(distortions.empty() || factor > result.maximum_quasi_conformal_factor)
    {
      result.maximum_quasi_conformal_factor = factor;
      result.face_of_maximum = f;
    }
    if(std::isinf(factor))
      ++result.number_of_collapsed_faces;
    if(!u_is_given)
      internal::include_log_scale_factors(frame, w, u);
    distortions.push_back({ frame.area(), internal::layout_area(w, frame), factor });
  }

  if constexpr(u_is_given)
    internal::include_given_log_scale_factors(tm, np, u);
  if(!u.is_empty())
  {
    result.minimum_log_scale_factor = u.smallest;
    result.maximum_log_scale_factor = u.largest;
  }
  if(!distortions.empty())
    internal::summarize(distortions, result);
  return result;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_DISTORTION_H
