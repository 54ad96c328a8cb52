// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Checks a seamless layout from its file alone, in exact arithmetic. Shares no code with the package.
//
// What is checked (Springborn, Schroeder, Pinkall 2008, section 6), for motions z -> e^{2 pi i k / n} z + t of the plane, t a point of
// the lattice:
//  - at each interior edge whose two sides lie apart, ONE of these motions takes both ends of one side to those of the other: exactly,
//    as the numbers are stored;
//  - where two such edges meet at a vertex that is no cone, and not on the border, their motions are the same, so that each path of a cut has one;
//  - the angles at each interior vertex sum up to a multiple of 2 pi / n; where that is not 2 pi, the vertex is a cone, and all of its
//    places are points of the lattice;
//  - every triangle is positively oriented, by an exact predicate.
//
// For n = 2 and 4 the lattice is Z + Z i. For n = 3 and 6 it is Z + Z e^{i pi / 3}, and the coordinates are those of the lattice, (a, b)
// for a + b e^{i pi / 3}: in them the rotation by 60 degrees is (a, b) -> (-b, a + b).

#ifndef CGAL_TEST_CONFORMAL_EQUIVALENCE_CHECK_SEAMS_H
#define CGAL_TEST_CONFORMAL_EQUIVALENCE_CHECK_SEAMS_H

#include "check_flattening.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <stdexcept>
#include <unordered_map>
#include <vector>

namespace checking {

struct Seam_verdict
{
  bool same_mesh = false, is_finite = false;
  int symmetry = 4;
  std::size_t seam_edges = 0, paths = 0, cones = 0;
  std::size_t edges_without_motion = 0;  // no rotation takes one side to the other, or one with a translation that is no point of the lattice
  std::size_t broken_paths = 0;          // vertices at which the motion changes
  std::size_t wrong_angles = 0;          // vertices whose angle sum is no multiple of 2 pi / n
  std::size_t cones_off_lattice = 0, not_positive_triangles = 0;

  bool is_good() const
  {
    return same_mesh && is_finite && edges_without_motion == 0 && broken_paths == 0 && wrong_angles == 0 && cones_off_lattice == 0
        && not_positive_triangles == 0;
  }
};

inline std::ostream& operator<<(std::ostream& out, const Seam_verdict& v)
{
  return out << "mesh of the input: " << (v.same_mesh ? "yes" : "NO") << ", finite: " << (v.is_finite ? "yes" : "NO") << '\n'
             << "seam edges: " << v.seam_edges << ", paths: " << v.paths << ", cones: " << v.cones << ", symmetry: " << v.symmetry << '\n'
             << "seam edges without a motion of the lattice: " << v.edges_without_motion << " (exact)\n"
             << "vertices where the motion of a path changes: " << v.broken_paths << " (exact)\n"
             << "angle sums that are no multiples: " << v.wrong_angles << ", cones beside the lattice: " << v.cones_off_lattice << " (exact)\n"
             << "triangles not positively oriented: " << v.not_positive_triangles << " (exact)\n"
             << (v.is_good() ? "GOOD" : "BAD") << '\n';
}

class Seam_checker
{
  typedef CGAL::Exact_rational  Exact;
  typedef std::array<Exact, 2>  Vector;

  struct Motion
  {
    int quanta = 0;
    Vector translation;

    friend bool operator==(const Motion& a, const Motion& b) { return a.quanta == b.quanta && a.translation == b.translation; }
  };

public:
  Seam_checker(const Surface& input, const Surface& output, int symmetry) : surface_(output), symmetry_(symmetry)
  {
    if(symmetry != 2 && symmetry != 3 && symmetry != 4 && symmetry != 6)
      throw std::runtime_error("there are motions of a lattice for the symmetries 2, 3, 4 and 6 only");
    verdict_.symmetry = symmetry;
    verdict_.same_mesh = input.points == output.points && input.faces == output.faces && ! output.texture.empty();
    verdict_.is_finite = std::all_of(output.texture.begin(), output.texture.end(), [](const std::array<double, 3>& t)
      { return std::isfinite(t[0]) && std::isfinite(t[1]) && t[2] == 1; });
    if(! verdict_.same_mesh || ! verdict_.is_finite)
      return;
    pair_sides();
    check_orientations();
    find_motions();
    find_cones();
    check_paths();
  }

  const Seam_verdict& verdict() const { return verdict_; }

  // Of the seam edges at a vertex, each seen from there: by how many quanta the motion from the left to the right side turns, and the translation.
  std::vector<std::array<double, 3> > motions_from(std::size_t v) const
  {
    std::vector<std::array<double, 3> > result;
    for(std::size_t s = 0; s < motion_.size(); ++s)
      if(motion_[s] && vertex(s) == v)
        result.push_back({{ double(motion_[s]->quanta), CGAL::to_double(motion_[s]->translation[0]),
                            CGAL::to_double(motion_[s]->translation[1]) }});
    return result;
  }

private:
  static constexpr std::size_t none = std::size_t(-1);

  // The side 3 f + k leads from corner k of the face f to corner k + 1.
  static std::size_t next(std::size_t side) { return side - side % 3 + (side + 1) % 3; }
  std::size_t vertex(std::size_t side) const { return surface_.faces[side / 3][side % 3]; }
  const std::array<double, 3>& place(std::size_t side) const { return surface_.texture[surface_.corners[side / 3][side % 3]]; }
  std::size_t number_of_sides() const { return 3 * surface_.faces.size(); }

  bool has_same_place(std::size_t s, std::size_t t) const { return place(s)[0] == place(t)[0] && place(s)[1] == place(t)[1]; }

  void pair_sides()
  {
    std::unordered_map<std::uint64_t, std::size_t> side_of;
    const auto key = [](std::size_t i, std::size_t j) { return (std::uint64_t(i) << 32) | std::uint64_t(j); };
    for(std::size_t s = 0; s < number_of_sides(); ++s)
      side_of[key(vertex(s), vertex(next(s)))] = s;
    is_on_border_.assign(surface_.points.size(), false);
    for(std::size_t s = 0; s < number_of_sides(); ++s)
    {
      const auto other = side_of.find(key(vertex(next(s)), vertex(s)));
      other_.push_back(other == side_of.end() ? none : other->second);
      if(other_.back() == none)
        is_on_border_[vertex(s)] = is_on_border_[vertex(next(s))] = true;
    }
  }

  void check_orientations()
  {
    typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_2 Point;
    const auto point = [&](std::size_t s) { return Point(place(s)[0], place(s)[1]); };
    for(std::size_t s = 0; s < number_of_sides(); s += 3)
      if(CGAL::orientation(point(s), point(s + 1), point(s + 2)) != CGAL::LEFT_TURN)
        ++verdict_.not_positive_triangles;
  }

  // --- motions -------------------------------------------------------------------------------------------

  bool has_hexagons() const { return symmetry_ % 3 == 0; }

  bool is_seam(std::size_t s) const
  {
    const std::size_t o = other_[s];
    return o != none && ! (has_same_place(s, next(o)) && has_same_place(next(s), o));
  }

  Vector exact_place(std::size_t s) const { return {{ Exact(place(s)[0]), Exact(place(s)[1]) }}; }

  // Turned by `quanta` / n of a full turn.
  Vector turned(Vector p, int quanta) const
  {
    const int smallest = has_hexagons() ? 6 : 4;
    for(int k = quanta * (smallest / symmetry_); k > 0; --k)
      p = has_hexagons() ? Vector{{ -p[1], p[0] + p[1] }} : Vector{{ -p[1], p[0] }};
    return p;
  }

  static bool is_integer(const Exact& x)
  {
    const double nearest = std::round(CGAL::to_double(x));
    return std::abs(nearest) < std::ldexp(1., 53) && x == Exact(nearest);
  }
  static bool is_in_lattice(const Vector& p) { return is_integer(p[0]) && is_integer(p[1]); }

  static Vector difference(const Vector& p, const Vector& q) { return {{ p[0] - q[0], p[1] - q[1] }}; }

  // From the side `s` to the other one.
  std::optional<Motion> motion_across(std::size_t s) const
  {
    const Vector p = exact_place(s), q = exact_place(next(s)), p_image = exact_place(next(other_[s])), q_image = exact_place(other_[s]);
    for(int k = 0; k < symmetry_; ++k)
    {
      const Vector t = difference(p_image, turned(p, k));
      if(t == difference(q_image, turned(q, k)) && is_in_lattice(t))
        return Motion{k, t};
    }
    return std::nullopt;
  }

  void find_motions()
  {
    motion_.resize(number_of_sides());
    for(std::size_t s = 0; s < number_of_sides(); ++s)
    {
      if(! is_seam(s))
        continue;
      motion_[s] = motion_across(s);
      if(s > other_[s])
        continue;
      ++verdict_.seam_edges;
      verdict_.edges_without_motion += ! motion_[s];
    }
  }

  // --- vertices ------------------------------------------------------------------------------------------

  Real angle(std::size_t s) const
  {
    const auto cartesian = [&](std::size_t t) -> std::array<Real, 2>
    {
      const Real x = place(t)[0], y = place(t)[1];
      return has_hexagons() ? std::array<Real, 2>{{ x + y / 2, y * std::sqrt(Real(3)) / 2 }} : std::array<Real, 2>{{ x, y }};
    };
    const auto p = cartesian(s), q = cartesian(next(s)), r = cartesian(next(next(s)));
    const Real a = q[0] - p[0], b = q[1] - p[1], c = r[0] - p[0], d = r[1] - p[1];
    return std::atan2(a * d - b * c, a * c + b * d);
  }

  void find_cones()
  {
    std::vector<Real> sum(surface_.points.size(), 0);
    for(std::size_t s = 0; s < number_of_sides(); ++s)
      sum[vertex(s)] += angle(s);
    is_cone_.assign(surface_.points.size(), false);
    for(std::size_t v = 0; v < sum.size(); ++v)
      if(! is_on_border_[v] && sum[v] != 0)
      {
        const Real quanta = sum[v] / (2 * pi) * symmetry_, nearest = std::round(quanta);
        verdict_.wrong_angles += ! (std::abs(quanta - nearest) < 1e-6L) || ! (nearest >= 1);
        is_cone_[v] = nearest != symmetry_;
        verdict_.cones += is_cone_[v];
      }
    std::vector<bool> is_off(is_cone_.size(), false);
    for(std::size_t s = 0; s < number_of_sides(); ++s)
      if(is_cone_[vertex(s)] && ! is_in_lattice(exact_place(s)))
        is_off[vertex(s)] = true;
    verdict_.cones_off_lattice = static_cast<std::size_t>(std::count(is_off.begin(), is_off.end(), true));
  }

  void check_paths()
  {
    std::vector<std::vector<std::size_t> > from(surface_.points.size()); // the seam edges at each vertex, as sides that begin there
    for(std::size_t s = 0; s < number_of_sides(); ++s)
      if(is_seam(s))
        from[vertex(s)].push_back(s);
    std::size_t ends = 0;
    for(std::size_t v = 0; v < from.size(); ++v)
      if(from[v].size() != 2 || is_cone_[v] || is_on_border_[v])
        ends += from[v].size();
      else if(! (motion_[from[v][0]] == motion_[other_[from[v][1]]]))
        ++verdict_.broken_paths;
    verdict_.paths = ends / 2;
  }

  const Surface& surface_;
  const int symmetry_;
  Seam_verdict verdict_;
  std::vector<std::size_t> other_; // the other side of the edge
  std::vector<bool> is_on_border_, is_cone_;
  std::vector<std::optional<Motion> > motion_; // by side
};

inline Seam_verdict check_seams(const Surface& input, const Surface& output, int symmetry = 4)
{
  return Seam_checker(input, output, symmetry).verdict();
}

} // namespace checking

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_CHECK_SEAMS_H
