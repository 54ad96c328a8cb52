// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_DISTORTION_H
#define CGAL_CONFORMAL_EQUIVALENCE_CONFORMAL_DISTORTION_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
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

namespace internal {

// ad - bc with a small relative error also where the products cancel (Kahan).
inline double difference_of_products(double a, double d, double b, double c)
{
  const double bc = b * c;
  return std::fma(a, d, -bc) + std::fma(-b, c, bc);
}

// A triangle, up to scale and motion: the vertex opposite the longest edge is the origin and the longer of its
// two edges goes along the x-axis.
//
//            (x, y)                 scaled by 2^-exponent such that 1/2 <= length < 1
//             /  `-.                y = 0 iff the triangle is degenerate
//            /      `-.
//     origin ----------- (length, 0)
//
struct Triangle_frame
{
  std::size_t origin = 0;      // the index of the vertex at the origin
  std::size_t first = 1;       // the index of the vertex on the x-axis; the third vertex is at (x, y)
  double length = 0, x = 0, y = 0;
  int exponent = 0;

  bool is_degenerate() const { return !(length > 0 && y > 0); }
  std::size_t second() const { return 3 - origin - first; }
  Scaled_number<double> area() const { return { 0.5 * length * y, 2 * std::int64_t(exponent) }; }
};

// Vertices at the ends of the longest edge are chosen so that first is opposite the shortest edge.
inline void choose_frame_vertices(const std::array<double, 3>& l, Triangle_frame& frame)
{
  const std::size_t longest = std::max_element(l.begin(), l.end()) - l.begin();
  const std::size_t j = (longest + 1) % 3, k = (longest + 2) % 3;
  frame.origin = longest;
  frame.first = l[k] >= l[j] ? j : k;          // the edge from the origin to j is opposite k
}

// The frame from the three edge lengths (l[i] is opposite vertex i): Heron's formula in Kahan's stable form.
inline Triangle_frame frame_from_lengths(std::array<double, 3> l)
{
  Triangle_frame frame;
  choose_frame_vertices(l, frame);
  const double longest = l[frame.origin];
  if(!(longest > 0) || !std::isfinite(longest) || !(l[frame.second()] > 0) || !(l[frame.first] > 0))
    return frame;

  frame.exponent = binary_exponent(l[frame.second()]);
  for(double& l_i : l)
    l_i = std::scalbn(l_i, -frame.exponent);
  const double a = l[frame.origin], b = l[frame.second()], c = l[frame.first];     // a >= b >= c
  const double excess = c - (a - b);               // <= 0: the triangle inequality fails
  frame.length = b;
  frame.x = (c * c - (a - b) * (a + b)) / (2 * b);
  if(excess > 0)
    frame.y = std::sqrt(excess) * std::sqrt(c + (a - b)) * (std::sqrt(a + (b + c)) * std::sqrt(a + (b - c)) / (2 * b));
  return frame;
}

typedef std::array<double, 3> Space_vector;

inline double largest_coordinate(const Space_vector& v)
{
  return (std::max)(std::fabs(v[0]), (std::max)(std::fabs(v[1]), std::fabs(v[2])));
}

inline double euclidean_norm(const Space_vector& v)
{
  return std::hypot(v[0], v[1], v[2]);
}

// The frame from the edge vectors of a triangle in space (e[i] goes from vertex i+1 to vertex i+2): exact in
// the angles of caps and needles as far as the vectors are.
inline Triangle_frame frame_from_edge_vectors(std::array<Space_vector, 3> e)
{
  Triangle_frame frame;
  const double largest = (std::max)(largest_coordinate(e[0]),
                                    (std::max)(largest_coordinate(e[1]), largest_coordinate(e[2])));
  if(!(largest > 0) || !std::isfinite(largest))
    return frame;
  frame.exponent = binary_exponent(largest);
  for(Space_vector& e_i : e)
    for(double& coordinate : e_i)
      coordinate = std::scalbn(coordinate, -frame.exponent);

  const std::array<double, 3> l = {{ euclidean_norm(e[0]), euclidean_norm(e[1]), euclidean_norm(e[2]) }};
  choose_frame_vertices(l, frame);
  const Space_vector& b = e[frame.second()];
  const Space_vector& c = e[frame.first];           // one of the two ends, the other begins at the origin
  const Space_vector cross = {{ difference_of_products(b[1], c[2], b[2], c[1]),
                          difference_of_products(b[2], c[0], b[0], c[2]),
                          difference_of_products(b[0], c[1], b[1], c[0]) }};
  frame.length = l[frame.second()];
  if(!(frame.length > 0))
    return frame;
  frame.x = -(b[0] * c[0] + b[1] * c[1] + b[2] * c[2]) / frame.length;
  frame.y = euclidean_norm(cross) / frame.length;
  return frame;
}

typedef Exact_predicates_inexact_constructions_kernel::Point_2 UV_point;
typedef std::array<UV_point, 3> UV_corners;

inline bool is_finite(const UV_corners& w)
{
  return std::all_of(w.begin(), w.end(), [](const UV_point& p)
                     { return std::isfinite(p.x()) && std::isfinite(p.y()); });
}

// The two edges of the image that start at the origin of the frame, scaled by 2^-exponent to at most 1.
struct Image_edges
{
  std::complex<double> first, second;
  int exponent = 0;
  bool is_point = true;

  double cross_product() const
  {
    return difference_of_products(first.real(), second.imag(), first.imag(), second.real());
  }
};

inline Image_edges image_edges(const UV_corners& w, const Triangle_frame& frame)
{
  const UV_point &o = w[frame.origin], &p = w[frame.first], &q = w[frame.second()];
  const double d[4] = { p.x() - o.x(), p.y() - o.y(), q.x() - o.x(), q.y() - o.y() };
  double largest = 0;
  for(double coordinate : d)
    largest = (std::max)(largest, std::fabs(coordinate));

  Image_edges image;
  image.is_point = !(largest > 0 && std::isfinite(largest));
  if(image.is_point)
    return image;
  image.exponent = binary_exponent(largest);
  image.first  = { std::scalbn(d[0], -image.exponent), std::scalbn(d[1], -image.exponent) };
  image.second = { std::scalbn(d[2], -image.exponent), std::scalbn(d[3], -image.exponent) };
  return image;
}

// The quasi-conformal factor of the affine map from the frame to the corners `w`.
//
// With the columns J_x, J_y of the Jacobian as complex numbers, 2 f_z = J_x - i J_y, 2 f_zbar = J_x + i J_y.
// Near a similarity one of the two is tiny and the quotient keeps its accuracy; elsewhere the small singular
// value comes from the determinant.
inline double quasi_conformal_factor(const Triangle_frame& frame, const UV_corners& w)
{
  const double infinity = (std::numeric_limits<double>::infinity)();
  if(frame.is_degenerate())
    return std::numeric_limits<double>::quiet_NaN();
  if(!is_finite(w) || CGAL::collinear(w[0], w[1], w[2]))
    return infinity;
  const Image_edges image = image_edges(w, frame);
  if(image.is_point)
    return infinity;

  const std::complex<double> i(0, 1);
  const std::complex<double> j_x = image.first * (frame.y / frame.length);                        // times y
  const std::complex<double> j_y = image.second - image.first * (frame.x / frame.length);         // times y
  const double f_z = std::abs(j_x - i * j_y), f_zbar = std::abs(j_x + i * j_y);
  const double larger = (std::max)(f_z, f_zbar), smaller = (std::min)(f_z, f_zbar);
  if(smaller < 0.5 * larger)
    return 1 + 2 * smaller / (larger - smaller);

  const double determinant = std::fabs(image.cross_product()) * (frame.y / frame.length);
  const double s = f_z + f_zbar;                                   // determinant = (f_z - f_zbar)(f_z + f_zbar) / 4
  return determinant > 0 ? (std::max)(1., 0.25 * s * s / determinant) : infinity;
}

inline Scaled_number<double> layout_area(const UV_corners& w, const Triangle_frame& frame)
{
  if(!is_finite(w))
    return Scaled_number<double>();
  const Image_edges image = image_edges(w, frame);
  return image.is_point ? Scaled_number<double>()
                        : Scaled_number<double>{ 0.5 * std::fabs(image.cross_product()), 2 * std::int64_t(image.exponent) };
}

} // namespace internal

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
  const internal::UV_corners w = {{ { corners[0][0], corners[0][1] },
                                    { corners[1][0], corners[1][1] },
                                    { corners[2][0], corners[2][1] } }};
  return internal::quasi_conformal_factor(internal::frame_from_lengths(lengths), w);
}

// ---------------------------------------------------------------------------------------------------
// A face of a mesh
// ---------------------------------------------------------------------------------------------------

namespace internal {

template <typename NamedParameters>
constexpr bool has_edge_length_map()
{
  return !parameters::is_default_parameter<NamedParameters, internal_np::conformal_edge_length_t>::value;
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
    w[i] = UV_point(CGAL::to_double(p.x()), CGAL::to_double(p.y()));
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
    lambda[i] = std::log(std::hypot(k.x() - j.x(), k.y() - j.y()));
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
///     \cgalParamType{a model of `ReadablePropertyMap` with key
///       `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a `Point_3` as value}
///     \cgalParamDefault{`boost::get(CGAL::vertex_point, tm)`}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_length_map}
///     \cgalParamDescription{the edge lengths; if given, the points are not read}
///     \cgalParamType{a model of `ReadablePropertyMap` with key
///       `boost::graph_traits<TriangleMesh>::%edge_descriptor` and a value convertible to `double`}
///     \cgalParamDefault{the distances of the points}
///   \cgalParamNEnd
///   \cgalParamNBegin{log_scale_factor_map}
///     \cgalParamDescription{u, of which the range is reported; only read here}
///     \cgalParamType{a model of `ReadablePropertyMap` with key
///       `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
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
    !parameters::is_default_parameter<NamedParameters, internal_np::conformal_u_t>::value;

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
