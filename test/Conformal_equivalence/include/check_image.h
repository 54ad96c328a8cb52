// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Checks a map to the sphere, or what a map to the disk has beyond a flattening, from the files alone: the input mesh, and the OBJ file with
// the points of the sphere, or the texture coordinates. Shares no code with the package.
//
// What is checked of a sphere (Springborn, Schroeder, Pinkall 2008, section 4.3):
//  - vertices are as many, and faces the same, as those of the input; or those of a refinement, whose vertices begin with those
//    of the input;
//  - the surface is closed, and of Euler characteristic 2;
//  - every vertex with a face is a point of the unit sphere;
//  - every triangle is positive seen from outside, by an exact predicate: all but as many as were lost by rounding;
//  - the solid angles sum up to 4 pi: together the map is one-to-one;
//  - the barycentre of the vertices of the input is the origin;
//  - unless edges were flipped, each edge has the same length cross ratio (4) between points of the sphere as in the input.
//
// What is checked of a disk:
//  - vertices and faces are those of the input, or of a refinement, whose vertices begin with those of the input; Euler characteristic 1;
//  - every border vertex of the input is on the unit circle;
//  - every triangle is positive;
//  - the border goes around the origin once, counterclockwise.
// What else a layout has to be is checked by check_flattening.h.

#ifndef CGAL_TEST_CONFORMAL_EQUIVALENCE_CHECK_IMAGE_H
#define CGAL_TEST_CONFORMAL_EQUIVALENCE_CHECK_IMAGE_H

#include "check_flattening.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <ostream>
#include <set>
#include <utility>
#include <vector>

namespace checking {

struct Image_tolerances
{
  Real sphere = 2e-16;      // coordinates x of unit length that were rounded once: the sum of x^2 2^-53, which is 1.1e-16
  Real circle = 4e-16;      // the same after a few roundings more, as circles are made by divisions
  Real barycentre = 1e-12;  // what the search for the transformation is content with
  Real cross_ratio = 1e-8;  // as for layouts (check_flattening.h)
  bool edges_were_flipped = false;  // cross ratios are not compared
  std::size_t lost_triangles = 0;   // exactly so many are not positive
};

struct Image_verdict
{
  bool same_mesh = false, is_refined = false;
  long euler_characteristic = 0, expected_characteristic = 0;
  std::size_t border_edges = 0, not_positive_triangles = 0, expected_not_positive = 0, edges = 0;
  bool may_have_border = false;
  Worst distance, barycentre, cross_ratio, turn; // turn: of the solid angle from 4 pi, or of the border from 2 pi

  bool is_good() const
  {
    return same_mesh && euler_characteristic == expected_characteristic && (border_edges != 0) == may_have_border && distance.is_good()
        && barycentre.is_good() && cross_ratio.is_good() && turn.is_good() && not_positive_triangles == expected_not_positive;
  }
};

inline std::ostream& operator<<(std::ostream& out, const Image_verdict& v)
{
  const auto print = [&](const char* name, const Worst& w)
    { out << name << double(w.value) << (w.is_good() ? "" : "   TOO LARGE") << " (" << double(w.of_tolerance) << " of the tolerance)\n"; };
  out << "mesh of the input: " << (! v.same_mesh ? "NO" : v.is_refined ? "refined" : "yes") << '\n'
      << "Euler characteristic: " << v.euler_characteristic << ", border edges: " << v.border_edges << '\n';
  print(v.may_have_border ? "border, distance from the circle: " : "distance from the sphere: ", v.distance);
  print(v.may_have_border ? "turn of the border, difference from 2 pi: " : "solid angle, difference from 4 pi: ", v.turn);
  if(! v.may_have_border)
  {
    print("barycentre, largest coordinate: ", v.barycentre);
    print("length cross ratios, largest relative difference: ", v.cross_ratio);
    out << "edges compared: " << v.edges << '\n';
  }
  return out << "triangles not positive: " << v.not_positive_triangles << ", expected: " << v.expected_not_positive << " (exact)\n"
             << (v.is_good() ? "GOOD" : "BAD") << '\n';
}

class Image_checker
{
public:
  Image_checker(const Surface& input, const Surface& output, const Image_tolerances& tolerances)
    : input_(input), output_(output), tolerances_(tolerances)
  {
    verdict_.expected_not_positive = tolerances.lost_triangles;
  }

  Image_verdict sphere()
  {
    verdict_.expected_characteristic = 2;
    verdict_.is_refined = output_.faces != input_.faces;
    verdict_.same_mesh = verdict_.is_refined ? output_.points.size() >= input_.points.size()
                                               : output_.points.size() == input_.points.size();
    if(! verdict_.same_mesh || ! check_surface())
      return verdict_;
    Real sum = 0;
    for(const auto& f : output_.faces)
    {
      const Point p = point(f[0]), q = point(f[1]), r = point(f[2]);
      verdict_.not_positive_triangles += ! (is_finite(f) && is_positive(p, q, r));
      sum += solid_angle(f);
    }
    verdict_.turn.insert(std::abs(sum - 4 * pi), turn_tolerance_);
    check_points();
    if(! verdict_.is_refined && ! tolerances_.edges_were_flipped)
      check_cross_ratios();
    return verdict_;
  }

  Image_verdict disk()
  {
    verdict_.expected_characteristic = 1;
    verdict_.may_have_border = true;
    verdict_.is_refined = output_.faces != input_.faces;
    verdict_.same_mesh = output_.points.size() >= input_.points.size() && ! output_.texture.empty()
      && std::equal(input_.points.begin(), input_.points.end(), output_.points.begin())
      && (verdict_.is_refined || output_.points.size() == input_.points.size());
    if(! verdict_.same_mesh || ! check_surface())
      return verdict_;
    for(std::size_t f = 0; f < output_.faces.size(); ++f)
    {
      typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_2 Point_2;
      std::array<Point_2, 3> p;
      bool is_good = true;
      for(std::size_t k = 0; k < 3; ++k)
      {
        const auto x = place(f, k);
        is_good = is_good && std::isfinite(x[0]) && std::isfinite(x[1]);
        p[k] = Point_2(x[0], x[1]);
      }
      verdict_.not_positive_triangles += ! (is_good && CGAL::orientation(p[0], p[1], p[2]) == CGAL::LEFT_TURN);
    }
    check_circle();
    return verdict_;
  }

private:
  typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_3 Point;
  typedef std::pair<std::size_t, std::size_t> Side;

  Point point(std::size_t i) const { return Point(output_.points[i][0], output_.points[i][1], output_.points[i][2]); }

  bool is_finite(const std::array<std::size_t, 3>& f) const
  {
    Real sum = 0;
    for(std::size_t i : f)
      for(double x : output_.points[i])
        sum += x;
    return std::isfinite(sum);
  }

  static bool is_positive(const Point& p, const Point& q, const Point& r)
  {
    return CGAL::orientation(Point(0, 0, 0), p, q, r) == CGAL::POSITIVE;
  }

  Real solid_angle(const std::array<std::size_t, 3>& f) const
  {
    const auto &p = output_.points[f[0]], &q = output_.points[f[1]], &r = output_.points[f[2]];
    const auto dot = [](const auto& a, const auto& b) { return Real(a[0]) * b[0] + Real(a[1]) * b[1] + Real(a[2]) * b[2]; };
    // of differences: tiny triangles count, too
    const std::array<Real, 3> a{{ Real(q[0]) - p[0], Real(q[1]) - p[1], Real(q[2]) - p[2] }},
                              b{{ Real(r[0]) - p[0], Real(r[1]) - p[1], Real(r[2]) - p[2] }};
    const Real volume = p[0] * (a[1] * b[2] - a[2] * b[1]) + p[1] * (a[2] * b[0] - a[0] * b[2]) + p[2] * (a[0] * b[1] - a[1] * b[0]);
    return 2 * std::atan2(volume, 1 + dot(p, q) + dot(q, r) + dot(r, p));
  }

  // Sides, of which each is there once; whether it is a surface.
  bool check_surface()
  {
    std::set<Side> sides;
    std::set<std::size_t> used;
    for(const auto& f : output_.faces)
      for(std::size_t k = 0; k < 3; ++k)
      {
        used.insert(f[k]);
        if(f[k] >= output_.points.size() || ! sides.emplace(f[k], f[(k + 1) % 3]).second)
          return verdict_.same_mesh = false;
      }
    for(const Side& s : sides)
      if(sides.count({s.second, s.first}) == 0)
      {
        ++verdict_.border_edges;
        after_[s.first] = s.second;
      }
    const std::size_t edges = (sides.size() + verdict_.border_edges) / 2;
    verdict_.euler_characteristic = long(used.size()) - long(edges) + long(output_.faces.size());
    is_used_.assign(output_.points.size(), false);
    for(std::size_t i : used)
      is_used_[i] = true;
    return true;
  }

  void check_points()
  {
    std::array<Real, 3> sum{{ 0, 0, 0 }};
    std::size_t n = 0;
    for(std::size_t i = 0; i < output_.points.size(); ++i)
    {
      if(! is_used_[i])
        continue;
      const auto& p = output_.points[i];
      verdict_.distance.insert(std::abs(std::hypot(Real(p[0]), Real(p[1]), Real(p[2])) - 1), tolerances_.sphere);
      if(i >= input_.points.size())
        continue;
      ++n;
      for(std::size_t k = 0; k < 3; ++k)
        sum[k] += p[k];
    }
    for(Real x : sum)
      verdict_.barycentre.insert(std::abs(x) / Real(n), tolerances_.barycentre);
  }

  static Real length(const Surface& s, std::size_t i, std::size_t j)
  {
    const auto &p = s.points[i], &q = s.points[j];
    return std::hypot(Real(q[0]) - p[0], Real(q[1]) - p[1], Real(q[2]) - p[2]);
  }

  // Both at the edge between the triangles ijk and jil.
  void check_cross_ratios()
  {
    std::map<Side, std::size_t> apex;
    for(const auto& f : input_.faces)
      for(std::size_t k = 0; k < 3; ++k)
        apex[{f[k], f[(k + 1) % 3]}] = f[(k + 2) % 3];
    for(const auto& side : apex)
    {
      const std::size_t i = side.first.first, j = side.first.second, k = side.second;
      if(j < i)
        continue;
      const std::size_t l = apex[{j, i}];
      const auto cross_ratio = [&](const Surface& s)
        { return length(s, i, l) / length(s, l, j) * (length(s, j, k) / length(s, k, i)); };
      const auto chord = [&](std::size_t a, std::size_t b) { return length(output_, a, b); };
      const Real shortest = (std::min)({chord(i, j), chord(i, l), chord(l, j), chord(j, k), chord(k, i)});
      verdict_.cross_ratio.insert(std::abs(cross_ratio(output_) / cross_ratio(input_) - 1),
                                   tolerances_.cross_ratio + 16 * std::ldexp(Real(1), -53) / shortest);
      ++verdict_.edges;
    }
  }

  std::array<double, 2> place(std::size_t f, std::size_t k) const
  {
    const auto& t = output_.texture[output_.corners[f][k]];
    return {{ t[0] / t[2], t[1] / t[2] }};
  }

  void check_circle()
  {
    std::vector<std::array<double, 2> > places(output_.points.size());
    for(std::size_t f = 0; f < output_.faces.size(); ++f)
      for(std::size_t k = 0; k < 3; ++k)
        places[output_.faces[f][k]] = place(f, k);
    Real turn = 0;
    for(const auto& side : after_)
    {
      const auto &p = places[side.first], &q = places[side.second];
      if(side.first < input_.points.size())
        // three roundings more where weights were divided out
        verdict_.distance.insert(std::abs(std::hypot(Real(p[0]), Real(p[1])) - 1), tolerances_.circle * (output_.has_weights ? 4 : 1));
      turn += std::atan2(Real(p[0]) * q[1] - Real(p[1]) * q[0], Real(p[0]) * q[0] + Real(p[1]) * q[1]);
    }
    // a chord of more than a half turn counts as what it turns the other way: then the origin is outside of the polygon, and the sum is 0
    const bool has_long_chord = std::abs(turn) < 1;
    verdict_.turn.insert(has_long_chord ? std::abs(turn) : std::abs(turn - 2 * pi), turn_tolerance_);
  }

  // Turns are multiples of 2 pi or 4 pi, and have only to be told apart: of a million angles that are rounded by 2^-53 pi this leaves far more.
  static constexpr Real turn_tolerance_ = 1e-6L;

  const Surface& input_;
  const Surface& output_;
  Image_tolerances tolerances_;
  Image_verdict verdict_;
  std::map<std::size_t, std::size_t> after_; // along the border
  std::vector<bool> is_used_;
};

inline Image_verdict check_sphere(const Surface& input, const Surface& output, const Image_tolerances& tolerances = Image_tolerances())
{
  return Image_checker(input, output, tolerances).sphere();
}

inline Image_verdict check_disk(const Surface& input, const Surface& output, const Image_tolerances& tolerances = Image_tolerances())
{
  return Image_checker(input, output, tolerances).disk();
}

} // namespace checking

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_CHECK_IMAGE_H
