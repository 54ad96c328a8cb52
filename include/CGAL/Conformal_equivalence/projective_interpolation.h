// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_PROJECTIVE_INTERPOLATION_H
#define CGAL_CONFORMAL_EQUIVALENCE_PROJECTIVE_INTERPOLATION_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Kernel_traits.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

/// \file projective_interpolation.h
///
/// How a layout extends from the vertices of a mesh to the points of its triangles
/// (Springborn, Schroeder, Pinkall 2008, Section 3.4 and Appendix D).
///
/// Besides the piecewise linear map there is, for conformally equivalent metrics and only for them,
/// a continuous piecewise *projective* map: in each triangle the projective map that takes the vertices
/// to the vertices and the circumcircle to the circumcircle.  It is linear in homogeneous coordinates
/// once the image of vertex i is written as `w_i (s_i, t_i, 1)` with the weight `w_i = e^{-u_i}`.
///
///                     v2                                       w2 (s2, t2, 1)
///                    /  \          projective map                 / |
///                   / b  \         ------------->                /  |
///                  /______\                                     /___|
///                v0        v1                     w0 (s0, t0, 1)     w1 (s1, t1, 1)
///
/// First the formulas of one triangle, on any field type; then the same on a mesh.

namespace CGAL {
namespace Conformal_equivalence {

// ---------------------------------------------------------------------------------------------------
// One triangle
// ---------------------------------------------------------------------------------------------------

namespace internal {

// The triple divided by the sum of its entries.
template <typename NT>
std::array<NT, 3> normalized_barycentric(const std::array<NT, 3>& b)
{
  const NT sum = b[0] + b[1] + b[2];
  return {{ b[0] / sum, b[1] / sum, b[2] / sum }};
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceInterpolation
///
/// returns the weights of the projective map that takes a triangle with edge lengths `l` to one with edge
/// lengths `image_l` and the circumcircle to the circumcircle: `w_i = e^{-u_i}` with `u` from Equation (5)
/// of the paper, scaled to maximum 1.
///
/// Equation (5) reads `w_i = r_i / (r_j r_k)` with the ratios `r = new length / old length` of the edges opposite the
/// vertices, which is `r_i^2` up to a common factor.
///
/// \tparam NT a model of `Field` with `operator<`.
/// \param l, image_l the three edge lengths; entry `i` belongs to the edge opposite vertex `i`.
/// \return three positive weights.
/// \pre all lengths are positive.
template <typename NT>
std::array<NT, 3> circumcircle_preserving_weights(const std::array<NT, 3>& l,
                                                  const std::array<NT, 3>& image_l)
{
  const NT scale = (std::max)(l[0], (std::max)(l[1], l[2]));
  const NT image_scale = (std::max)(image_l[0], (std::max)(image_l[1], image_l[2]));
  std::array<NT, 3> ratio;                        // e^{(u_j + u_k) / 2} up to a factor; its square is that of e^{-u_i}
  for(std::size_t i = 0; i < 3; ++i)
    ratio[i] = (image_l[i] / image_scale) / (l[i] / scale);
  const NT largest = (std::max)(ratio[0], (std::max)(ratio[1], ratio[2]));

  std::array<NT, 3> w;
  for(std::size_t i = 0; i < 3; ++i)
  {
    const NT r = ratio[i] / largest;
    w[i] = r * r;
  }
  return w;
}

/// \ingroup PkgConformalEquivalenceInterpolation
///
/// returns the barycentric coordinates, in the image triangle, of the projective image of a point:
/// `b_i w_i / (b_0 w_0 + b_1 w_1 + b_2 w_2)`.
///
/// \tparam NT a model of `Field`.
/// \param b barycentric coordinates of the point in its triangle; any common factor is allowed.
/// \param w positive weights `e^{-u_i}` of the vertices; any common factor is allowed.
/// \return normalized barycentric coordinates (sum 1); a vertex goes to its image exactly.
/// \pre the denominator is not 0; it is positive for every point of the closed triangle.
template <typename NT>
std::array<NT, 3> projective_barycentric(const std::array<NT, 3>& b, const std::array<NT, 3>& w)
{
  return internal::normalized_barycentric<NT>({{ b[0] * w[0], b[1] * w[1], b[2] * w[2] }});
}

/// \ingroup PkgConformalEquivalenceInterpolation
///
/// is the inverse of `projective_barycentric()`: returns the normalized barycentric coordinates of the
/// point whose projective image has the barycentric coordinates `b`.
///
/// \tparam NT a model of `Field` with `operator<`.
/// \param b barycentric coordinates in the image triangle; any common factor is allowed.
/// \param w positive weights `e^{-u_i}` of the vertices; any common factor is allowed.
/// \pre `b_0/w_0 + b_1/w_1 + b_2/w_2` is not 0; it is positive for every point of the closed triangle.
template <typename NT>
std::array<NT, 3> inverse_projective_barycentric(const std::array<NT, 3>& b, const std::array<NT, 3>& w)
{
  const NT smallest = (std::min)(w[0], (std::min)(w[1], w[2]));      // keeps the quotients at most 1
  return internal::normalized_barycentric<NT>({{ b[0] * (smallest / w[0]),
                                                 b[1] * (smallest / w[1]),
                                                 b[2] * (smallest / w[2]) }});
}

/// \ingroup PkgConformalEquivalenceInterpolation
///
/// returns the point `b_0 p_0 + b_1 p_1 + b_2 p_2`.
///
/// \tparam NT a model of `Ring`.
/// \param p the corners of the triangle, two coordinates each.
/// \param b normalized barycentric coordinates (sum 1).
template <typename NT>
std::array<NT, 2> linear_map(const std::array<std::array<NT, 2>, 3>& p, const std::array<NT, 3>& b)
{
  return {{ b[0] * p[0][0] + b[1] * p[1][0] + b[2] * p[2][0],
            b[0] * p[0][1] + b[1] * p[1][1] + b[2] * p[2][1] }};
}

/// \ingroup PkgConformalEquivalenceInterpolation
///
/// returns the image of the point with barycentric coordinates `b` under the projective map that takes the
/// vertices to the corners `p` with weights `w` (Appendix D of the paper).
///
/// \tparam NT a model of `Field`.
/// \pre see `projective_barycentric()`.
template <typename NT>
std::array<NT, 2> projective_map(const std::array<std::array<NT, 2>, 3>& p,
                                 const std::array<NT, 3>& w,
                                 const std::array<NT, 3>& b)
{
  return linear_map(p, projective_barycentric(b, w));
}

namespace internal {

template <typename NT>
NT squared_length(const std::array<NT, 2>& a)
{
  return a[0] * a[0] + a[1] * a[1];
}

template <typename NT>
NT absolute_value(const NT& x)
{
  return x < NT(0) ? NT(-x) : x;
}

// The vectors from `origin` to the corners, divided by their largest coordinate, so that no product of two
// under- or overflows; returns false if all corners coincide with `origin`.
template <typename NT>
bool scaled_differences(const std::array<std::array<NT, 2>, 3>& p,
                        const std::array<NT, 2>& origin,
                        std::array<std::array<NT, 2>, 3>& d,
                        std::array<NT, 2>& q)
{
  NT scale(0);
  for(std::size_t i = 0; i < 3; ++i)
    for(std::size_t c = 0; c < 2; ++c)
    {
      d[i][c] = p[i][c] - origin[c];
      scale = (std::max)(scale, absolute_value(d[i][c]));
    }
  if(scale == NT(0))
    return false;
  for(std::size_t c = 0; c < 2; ++c)
  {
    for(std::size_t i = 0; i < 3; ++i)
      d[i][c] = d[i][c] / scale;
    q[c] = (q[c] - origin[c]) / scale;
  }
  return true;
}

// Barycentric coordinates of `q` on the longest of the collinear edges (d[k] is the corner k; d[0] = 0).
template <typename NT>
std::array<NT, 3> barycentric_on_segment(const std::array<std::array<NT, 2>, 3>& d,
                                         const std::array<NT, 2>& q)
{
  std::size_t from = 0, to = 1;
  NT longest(0);
  for(std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t j = (i + 1) % 3;
    const NT length = squared_length<NT>({{ d[j][0] - d[i][0], d[j][1] - d[i][1] }});
    if(longest < length) { longest = length; from = i; to = j; }
  }
  const std::array<NT, 2> e = {{ d[to][0] - d[from][0], d[to][1] - d[from][1] }};
  const NT t = (e[0] * (q[0] - d[from][0]) + e[1] * (q[1] - d[from][1])) / longest;
  std::array<NT, 3> b = {{ NT(0), NT(0), NT(0) }};
  b[from] = NT(1) - t;
  b[to] = t;
  return b;
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceInterpolation
///
/// is the inverse of `linear_map()`: returns the normalized barycentric coordinates of the point `q`, which
/// may lie outside of the triangle.
///
/// Total: if the corners are collinear, the coordinates of the orthogonal projection of `q` to the longest
/// edge are returned; if they coincide, those of the first corner.
///
/// \tparam NT a model of `Field` with `operator<`.
/// \param p the corners of the triangle, two coordinates each.
/// \param q the point.
template <typename NT>
std::array<NT, 3> inverse_linear_map(const std::array<std::array<NT, 2>, 3>& p, std::array<NT, 2> q)
{
  std::array<std::array<NT, 2>, 3> d;
  if(!internal::scaled_differences(p, std::array<NT, 2>(p[0]), d, q))
    return {{ NT(1), NT(0), NT(0) }};

  std::array<NT, 3> area;                       // entry i: of the triangle q, j, k, twice
  for(std::size_t i = 0; i < 3; ++i)
  {
    const std::array<NT, 2>& j = d[(i + 1) % 3];
    const std::array<NT, 2>& k = d[(i + 2) % 3];
    area[i] = (k[0] - j[0]) * (q[1] - j[1]) - (k[1] - j[1]) * (q[0] - j[0]);
  }
  if(d[1][0] * d[2][1] == d[1][1] * d[2][0] || area[0] + area[1] + area[2] == NT(0))
    return internal::barycentric_on_segment(d, q);
  return internal::normalized_barycentric(area);
}

/// \ingroup PkgConformalEquivalenceInterpolation
///
/// is the inverse of `projective_map()`: returns the normalized barycentric coordinates of the point whose
/// projective image is `q`.
///
/// Total on the closed triangle; a degenerate triangle is treated as by `inverse_linear_map()`.
///
/// \tparam NT a model of `Field` with `operator<`.
template <typename NT>
std::array<NT, 3> inverse_projective_map(const std::array<std::array<NT, 2>, 3>& p,
                                         const std::array<NT, 3>& w,
                                         const std::array<NT, 2>& q)
{
  return inverse_projective_barycentric(inverse_linear_map(p, q), w);
}

// ---------------------------------------------------------------------------------------------------
// On a mesh
// ---------------------------------------------------------------------------------------------------

namespace internal {

template <typename HalfedgeUVMap>
struct UV_traits
{
  typedef typename boost::property_traits<HalfedgeUVMap>::value_type    Point_2;
  typedef typename Kernel_traits<Point_2>::Kernel::FT                   FT;
};

// The corners of a face; corner i belongs to the source of the i-th halfedge of the face (the order of
// `Polygon_mesh_processing/locate.h`), whose layout is stored at the halfedge before it.
template <typename TriangleMesh, typename HalfedgeUVMap>
std::array<std::array<typename UV_traits<HalfedgeUVMap>::FT, 2>, 3>
uv_corners(const TriangleMesh& tm,
           HalfedgeUVMap uv,
           typename boost::graph_traits<TriangleMesh>::face_descriptor fd)
{
  std::array<std::array<typename UV_traits<HalfedgeUVMap>::FT, 2>, 3> corners;
  auto h = prev(halfedge(fd, tm), tm);
  for(auto& corner : corners)
  {
    const typename UV_traits<HalfedgeUVMap>::Point_2 p = get(uv, h);
    corner = {{ p.x(), p.y() }};
    h = next(h, tm);
  }
  return corners;
}

// The least weight that `FT` can hold and that has a reciprocal.
template <typename FT>
double smallest_weight()
{
  return std::is_same<FT, float>::value ? double((std::numeric_limits<float>::min)())
                                        : (std::numeric_limits<double>::min)();
}

// e^{-u}, scaled to a maximum of 1 and never 0.
inline double projective_weight(double u, double smallest_u)
{
  return (std::min)(1., (std::max)(std::exp(smallest_u - u), smallest_weight<double>()));
}

// The weights of the corners, in the same order, scaled in double so that a narrow `FT` holds them.
template <typename FT, typename TriangleMesh, typename VertexWeightMap>
std::array<FT, 3> corner_weights(const TriangleMesh& tm,
                                 VertexWeightMap weight_map,
                                 typename boost::graph_traits<TriangleMesh>::face_descriptor fd)
{
  std::array<double, 3> w;
  auto h = halfedge(fd, tm);
  for(double& w_i : w)
  {
    w_i = CGAL::to_double(get(weight_map, source(h, tm)));
    h = next(h, tm);
  }
  const double largest = (std::max)(w[0], (std::max)(w[1], w[2]));
  std::array<FT, 3> scaled;
  for(std::size_t i = 0; i < 3; ++i)
    scaled[i] = FT((std::max)(w[i] / largest, smallest_weight<FT>()));
  return scaled;
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceInterpolation
///
/// writes the weights of the projective interpolation, `w_i = e^{-(u_i - min u)}`, so that the largest is 1.
///
/// The minimum is taken over the vertices that have an edge.  A weight that would underflow (that is, where u
/// exceeds its minimum by more than 708) is the smallest positive normal number instead.
///
/// \tparam TriangleMesh a model of `VertexListGraph` and `HalfedgeGraph`.
/// \tparam LogScaleFactorMap a model of `ReadablePropertyMap` with key
///   `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a value convertible to `double`.
/// \tparam VertexWeightMap a model of `WritablePropertyMap` with the same key and value type `double`.
///
/// \param tm the mesh.
/// \param log_scale_factor_map u: a new edge length is `e^{(u_i + u_j) / 2}` times the old one.
/// \param weight_map receives the weights, in ]0, 1].
///
/// Linear in the number of vertices.
template <typename TriangleMesh, typename LogScaleFactorMap, typename VertexWeightMap>
void projective_weights(const TriangleMesh& tm,
                        LogScaleFactorMap log_scale_factor_map,
                        VertexWeightMap weight_map)
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;

  double smallest_u = (std::numeric_limits<double>::infinity)();
  for(auto v : vertices(tm))
    if(halfedge(v, tm) != Graph_traits::null_halfedge())
      smallest_u = (std::min)(smallest_u, double(get(log_scale_factor_map, v)));

  for(auto v : vertices(tm))
  {
    put(weight_map, v, internal::projective_weight(double(get(log_scale_factor_map, v)), smallest_u));
  }
}

/// \ingroup PkgConformalEquivalenceInterpolation
///
/// returns the image, in the layout, of a point of a face under the piecewise linear map.
///
/// \tparam TriangleMesh a model of `HalfedgeGraph` and `FaceGraph`.
/// \tparam HalfedgeUVMap a model of `ReadablePropertyMap` with key
///   `boost::graph_traits<TriangleMesh>::%halfedge_descriptor` and a `Point_2` of a \cgal kernel as value.
///
/// \param tm the mesh.
/// \param uv the layout: `uv[h]` is the corner of `target(h)` in `face(h)`.
/// \param fd a triangle of `tm`.
/// \param bary normalized barycentric coordinates; the i-th belongs to the source of the i-th halfedge of
///   the face, counted from `halfedge(fd, tm)`, as in `Polygon_mesh_processing`.
template <typename TriangleMesh, typename HalfedgeUVMap>
typename internal::UV_traits<HalfedgeUVMap>::Point_2
linear_map(const TriangleMesh& tm,
           HalfedgeUVMap uv,
           typename boost::graph_traits<TriangleMesh>::face_descriptor fd,
           const std::array<typename internal::UV_traits<HalfedgeUVMap>::FT, 3>& bary)
{
  const auto q = Conformal_equivalence::linear_map(internal::uv_corners(tm, uv, fd), bary);
  return typename internal::UV_traits<HalfedgeUVMap>::Point_2(q[0], q[1]);
}

/// \ingroup PkgConformalEquivalenceInterpolation
///
/// returns the image, in the layout, of a point of a face under the circumcircle preserving piecewise
/// projective map (Section 3.4 of the paper), which is continuous across the edges if and only if the layout
/// is discretely conformally equivalent to the mesh.
///
/// \tparam TriangleMesh, HalfedgeUVMap as for `linear_map()`.
/// \tparam VertexWeightMap a model of `ReadablePropertyMap` with key
///   `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`.
///
/// \param tm, uv, fd, bary as for `linear_map()`.
/// \param weight_map positive weights `e^{-u}` up to a common factor, see `projective_weights()`.
///
/// \pre the denominator `b_0 w_0 + b_1 w_1 + b_2 w_2` is not 0; it is positive on the closed triangle.
template <typename TriangleMesh, typename HalfedgeUVMap, typename VertexWeightMap>
typename internal::UV_traits<HalfedgeUVMap>::Point_2
projective_map(const TriangleMesh& tm,
               HalfedgeUVMap uv,
               VertexWeightMap weight_map,
               typename boost::graph_traits<TriangleMesh>::face_descriptor fd,
               const std::array<typename internal::UV_traits<HalfedgeUVMap>::FT, 3>& bary)
{
  typedef typename internal::UV_traits<HalfedgeUVMap>::FT FT;
  const std::array<FT, 3> w = internal::corner_weights<FT>(tm, weight_map, fd);
  return Conformal_equivalence::linear_map(tm, uv, fd, projective_barycentric(bary, w));
}

/// \ingroup PkgConformalEquivalenceInterpolation
///
/// is the inverse of `linear_map()` on the plane of one face: returns the normalized barycentric coordinates
/// of a point of the layout, in the order of `linear_map()`.
///
/// Total: in a triangle of zero area the point is projected to the longest edge.
///
/// \tparam TriangleMesh, HalfedgeUVMap as for `linear_map()`.
/// \param tm, uv, fd as for `linear_map()`.
/// \param point the point; it may lie outside of the triangle, which shows as negative coordinates.
template <typename TriangleMesh, typename HalfedgeUVMap>
std::array<typename internal::UV_traits<HalfedgeUVMap>::FT, 3>
inverse_linear_map(const TriangleMesh& tm,
                   HalfedgeUVMap uv,
                   typename boost::graph_traits<TriangleMesh>::face_descriptor fd,
                   const typename internal::UV_traits<HalfedgeUVMap>::Point_2& point)
{
  typedef typename internal::UV_traits<HalfedgeUVMap>::FT FT;
  return Conformal_equivalence::inverse_linear_map(internal::uv_corners(tm, uv, fd),
                                                   std::array<FT, 2>{{ point.x(), point.y() }});
}

/// \ingroup PkgConformalEquivalenceInterpolation
///
/// is the inverse of `projective_map()` on one face: returns the normalized barycentric coordinates of the
/// point of the face whose projective image is `point`.
///
/// \tparam TriangleMesh, HalfedgeUVMap, VertexWeightMap as for `projective_map()`.
/// \param tm, uv, weight_map, fd as for `projective_map()`.
/// \param point a point of the closed triangle in the layout.
template <typename TriangleMesh, typename HalfedgeUVMap, typename VertexWeightMap>
std::array<typename internal::UV_traits<HalfedgeUVMap>::FT, 3>
inverse_projective_map(const TriangleMesh& tm,
                       HalfedgeUVMap uv,
                       VertexWeightMap weight_map,
                       typename boost::graph_traits<TriangleMesh>::face_descriptor fd,
                       const typename internal::UV_traits<HalfedgeUVMap>::Point_2& point)
{
  typedef typename internal::UV_traits<HalfedgeUVMap>::FT FT;
  return inverse_projective_barycentric(Conformal_equivalence::inverse_linear_map(tm, uv, fd, point),
                                        internal::corner_weights<FT>(tm, weight_map, fd));
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_PROJECTIVE_INTERPOLATION_H
