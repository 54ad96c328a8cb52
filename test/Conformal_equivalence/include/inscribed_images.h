// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What the tests of the maps to the sphere and to the disk share: surfaces, conformality at every edge, and overlays whose parts fill the faces.

#ifndef CGAL_TEST_CONFORMAL_EQUIVALENCE_INSCRIBED_IMAGES_H
#define CGAL_TEST_CONFORMAL_EQUIVALENCE_INSCRIBED_IMAGES_H

#include "boost_test.h"
#include "flattened_meshes.h"
#include "output_maps.h"
#include "tolerances.h"

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/discrete_metric.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace testing {

// --- bounds on errors ---------------------------------------------------------------------------

// The distance of a point of an image from where it belongs: images are found in pairs of `double`, and each of their coordinates, which are at most
// 1, is rounded by 2^-54: together, that is sqrt(3) 2^-54.
constexpr double rounded_place = unit_roundoff;

// The distance of the barycentre of an image from the centre: the search for the transformation is content with that where rounding keeps it from
// coming closer.
constexpr double centred = 1e-12;

// What that search goes on until, and reaches where points are spread over the whole sphere.
constexpr double centring_goal = 1e-14;

// The distance between the places of a vertex in two images of one surface in the default frame, or between the logarithms u of its factors. A
// transformation that moves the barycentre by the goal, once for either image, moves the points by that divided by the least eigenvalue of the mean
// of 1 - p p^T, which is above 1/5 for the surfaces of the tests.
constexpr double centred_place = 2 * centring_goal * 5;

// The sum of n angles at a centre or solid angles: each is an arc tangent of two numbers that are products of coordinates, so that some eight of
// their roundings, and one for its addition to a sum that is at most 4 pi, count.
inline double sum_of_angles(std::size_t n) { return 32 * unit_roundoff * double(n); }

// Flips the edge e, gives it the length of Ptolemy's theorem, and follows the bound on relative errors: the sum of two products is as inexact as
// the worse of them, and five operations round.
template <typename Triangulation>
void flip_with_error(Triangulation& lengths, std::vector<double>& error, Index e)
{
  const auto along = [&](auto h) { return lengths.edge(h); };
  const auto h = lengths.edge_halfedge(e), g = lengths.twin(h);
  const Index a = along(lengths.next(h)), b = along(lengths.previous(h)), c = along(lengths.next(g)), d = along(lengths.previous(g));
  error[e] += (std::max)(error[a] + error[c], error[b] + error[d]) + 5 * unit_roundoff;
  lengths.flip_edge(e, (lengths.length(a) * lengths.length(c) + lengths.length(b) * lengths.length(d)) / lengths.length(e));
}

// --- surfaces -----------------------------------------------------------------------------------

inline Soup distorted_sphere(int levels, double noise, unsigned seed)
{
  Soup soup = scaled(icosphere(levels), 1.3, 1, .8);
  add_noise(soup, noise, seed);
  return soup;
}

// Random heights on a long body: thin triangles that need flips.
inline Soup needles(unsigned seed)
{
  Soup soup = icosphere(2);
  Random random(seed);
  for(Point& p : soup.points)
  {
    const double r = std::exp(random(-.5, .5));
    p = {{5 * r * p[0], r * p[1], .4 * r * p[2]}};
  }
  return soup;
}

// --- conformality -------------------------------------------------------------------------------

// The lengths `chord(i, j)` of the edges of the image are those of the surface, scaled as in (2) by the factors u, and so have the same length
// cross ratios (4), up to a relative error; weights are exp(-u), up to a factor.
template <typename Image_point, typename Chord>
void check_scaling(const Image_maps<Image_point>& m, const CGAL::Conformal_equivalence::Intrinsic_triangulation<>& surface, const Chord& chord,
                   double tolerance)
{
  CGAL::Conformal_equivalence::Intrinsic_triangulation<> chords = surface;
  for(Index e = 0; e < surface.number_of_edges(); ++e)
  {
    const Vertex i(surface.origin(surface.edge_halfedge(e))), j(surface.target(surface.edge_halfedge(e)));
    chords.set_length(e, chord(i, j));
    const double scaled_length = std::exp((m.u[i] + m.u[j]) / 2) * surface.length(e);
    BOOST_TEST(std::abs(scaled_length / chords.length(e) - 1) <= tolerance + 4 * unit_roundoff * (std::abs(m.u[i]) + std::abs(m.u[j])));
  }
  for(Index e = 0; e < surface.number_of_edges(); ++e)
    if(!surface.is_border_edge(e))
      BOOST_TEST(std::abs(CGAL::Conformal_equivalence::length_cross_ratio(chords, e)
                          / CGAL::Conformal_equivalence::length_cross_ratio(surface, e) - 1) <= tolerance);

  double least_u = HUGE_VAL;
  for(Vertex v : vertices(m.sm))
    if(!m.sm.is_isolated(v))
      least_u = (std::min)(least_u, m.u[v]);
  for(Vertex v : vertices(m.sm))
    if(!m.sm.is_isolated(v)) // u itself is rounded
      BOOST_TEST(std::abs(m.weight[v] / std::exp(least_u - m.u[v]) - 1) <= 8 * unit_roundoff * (1 + std::abs(least_u) + std::abs(m.u[v])));
}

// --- overlays -----------------------------------------------------------------------------------

// Barycentric coordinates of a vertex of the overlay in a face of the input.
template <typename Refinement>
Point barycentric(const Refinement& parts, const CGAL::Conformal_equivalence::Intrinsic_triangulation<>& input, Index f, Index v)
{
  Point result = {{0, 0, 0}};
  if(v < parts.number_of_input_vertices)
  {
    for(Index k = 0; k < 3; ++k)
      result[k] = input.origin(3 * f + k) == v;
    BOOST_TEST(result[0] + result[1] + result[2] == 1);
    return result;
  }
  const auto& x = parts.crossings[v - parts.number_of_input_vertices];
  BOOST_TEST((x.input_parameter >= 0 && x.input_parameter <= 1));
  const Index h = input.edge_halfedge(x.input_edge), side = input.face(h) == f ? h : input.twin(h);
  BOOST_REQUIRE(side != input.null_index);
  BOOST_REQUIRE(input.face(side) == f);
  const double t = side == h ? x.input_parameter : 1 - x.input_parameter;
  result[side % 3] = 1 - t;
  result[input.next(side) % 3] = t;
  return result;
}

inline double determinant(const Point& p, const Point& q, const Point& r)
{
  return p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
}

// The parts of each face of the input fill it, and nothing else; an edge is cut in the same way from both sides, so that the map is continuous.
template <typename Refinement>
void check_that_parts_fill_faces(const Refinement& parts, const CGAL::Conformal_equivalence::Intrinsic_triangulation<>& input)
{
  std::vector<double> area(input.number_of_faces(), 0);
  std::vector<std::multiset<std::pair<Index, Index> > > along(input.number_of_edges()); // from the origin of its first halfedge
  for(Index f = 0; f < parts.number_of_faces(); ++f)
  {
    const std::size_t c = parts.first_corner[f];
    const Index in = parts.input_face[f];
    const auto corner = [&](std::size_t k) { return barycentric(parts, input, in, parts.corner_vertex[c + k]); };
    const double a = determinant(corner(0), corner(1), corner(2));
    BOOST_TEST(a >= -4 * unit_roundoff);
    area[in] += a;
    for(std::size_t k = 0; k < 3; ++k)
    {
      const Index h = parts.corner_halfedge[c + k], i = parts.corner_vertex[c + k], j = parts.corner_vertex[c + (k + 1) % 3];
      if(h == parts.null_index)
        continue;
      BOOST_TEST(input.face(h) == in);
      along[input.edge(h)].insert(h == input.edge_halfedge(input.edge(h)) ? std::make_pair(i, j) : std::make_pair(j, i));
    }
  }
  const double rounding = 8 * unit_roundoff * parts.number_of_faces(); // a determinant of numbers up to 1, and an addition, each of some roundings
  for(double a : area)
    BOOST_TEST(std::abs(a - 1) <= rounding);
  for(Index e = 0; e < input.number_of_edges(); ++e)
    for(const auto& segment : along[e])
      BOOST_TEST(along[e].count(segment) == (input.is_border_edge(e) ? 1u : 2u));
}

} // namespace testing

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_INSCRIBED_IMAGES_H
