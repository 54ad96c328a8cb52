// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Checks a flattening from the files alone: the input mesh, and the OBJ file with the
// texture coordinates. Shares no code with the package.
//
// What is checked (Springborn, Schroeder, Pinkall 2008):
//  - vertices and faces are those of the input;
//  - each interior edge has the same length cross ratio (4) in the layout as in space;
//  - both sides of an interior edge have the same length in the layout;
//  - the angles at each interior vertex sum up to 2 pi, at a cone to its prescribed angle, if there is one;
//  - pieces of the layout (of faces that lie side by side there) have bounding boxes that do not overlap;
//  - border edges have the same scale, where the border is to keep its lengths;
//  - every triangle is positively oriented, by an exact predicate;
//  - weights w, if any, are those of (2): the scale of the edge ij is c / sqrt(w_i w_j).
//
// A relative tolerance t on a length l in a layout of diameter D reads max(t, 16 * 2^-53 * D / l): no
// coordinates of type double can promise more. A tolerance on the sum of n angles, whose shortest edge is l long, reads
// max(t, 16 n * 2^-53 * D / l): each end of an edge may be off by sqrt(2) * 2^-53 * D, each angle by sqrt(32) * 2^-53 * D / l,
// and three times that if the coordinates were divided by weights.

#ifndef CGAL_TEST_CONFORMAL_EQUIVALENCE_CHECK_FLATTENING_H
#define CGAL_TEST_CONFORMAL_EQUIVALENCE_CHECK_FLATTENING_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

namespace checking {

typedef long double Real; // for lengths and their ratios

struct Surface
{
  std::vector<std::array<double, 3> > points;
  std::vector<std::array<std::size_t, 3> > faces;
  std::vector<std::array<std::size_t, 3> > corners; // indices of texture coordinates, where there are any
  std::vector<std::array<double, 3> > texture;      // u w, v w, w
  bool has_weights = false;
};

inline std::array<double, 3> read_three(std::istringstream& line, double third)
{
  std::array<double, 3> x{{ 0, 0, third }};
  std::string word;
  for(std::size_t k = 0; k < 3 && line >> word; ++k)
    x[k] = std::strtod(word.c_str(), nullptr);
  return x;
}

inline std::size_t count_words(std::string line)
{
  std::istringstream words(line);
  std::size_t n = 0;
  for(std::string w; words >> w; )
    ++n;
  return n;
}

inline Surface read_obj(std::istream& in)
{
  Surface s;
  for(std::string text; std::getline(in, text); )
  {
    std::istringstream line(text);
    std::string key;
    line >> key;
    if(key == "v")
      s.points.push_back(read_three(line, 0));
    else if(key == "vt")
    {
      s.has_weights = count_words(text) == 4;
      s.texture.push_back(read_three(line, 1));
    }
    else if(key == "f")
    {
      std::array<std::size_t, 3> face{{0, 0, 0}}, corner{{0, 0, 0}};
      for(std::size_t k = 0; k < 3; ++k)
      {
        std::string word;
        line >> word;
        face[k] = std::stoul(word) - 1;
        const std::size_t slash = word.find('/');
        if(slash != std::string::npos)
          corner[k] = std::stoul(word.substr(slash + 1)) - 1;
      }
      s.faces.push_back(face);
      s.corners.push_back(corner);
    }
  }
  return s;
}

inline Surface read_off(std::istream& in)
{
  const auto next_line = [&](std::string& text)
  {
    while(std::getline(in, text))
    {
      text = text.substr(0, text.find('#'));
      if(text.find_first_not_of(" \t\r\n") != std::string::npos)
        return;
    }
    throw std::runtime_error("the OFF file is cut off");
  };
  std::string text;
  next_line(text);
  if(text.find("OFF") != std::string::npos)
    text = text.substr(text.find("OFF") + 3);
  if(count_words(text) == 0)
    next_line(text);
  std::istringstream counts(text);
  std::size_t nv = 0, nf = 0;
  counts >> nv >> nf;

  Surface s;
  for(std::size_t v = 0; v < nv; ++v)
  {
    next_line(text);
    std::istringstream line(text);
    s.points.push_back(read_three(line, 0));
  }
  for(std::size_t f = 0; f < nf; ++f)
  {
    next_line(text);
    std::istringstream line(text);
    std::size_t n = 0;
    std::array<std::size_t, 3> face;
    line >> n >> face[0] >> face[1] >> face[2];
    if(n != 3)
      throw std::runtime_error("the input has a face that is not a triangle");
    s.faces.push_back(face);
  }
  return s;
}

inline Surface read_surface(const std::string& file)
{
  std::ifstream in(file);
  if(! in)
    throw std::runtime_error("cannot open " + file);
  return file.size() > 4 && file.substr(file.size() - 4) == ".off" ? read_off(in) : read_obj(in);
}

// For each cone, by its vertex: the prescribed angle in radians, or none (a free cone).
typedef std::map<std::size_t, std::optional<Real> > Cones;

const Real pi = 3.141592653589793238462643383279502884L;

// Lines `vertex-index angle-in-degrees`, or `vertex-index free`; comments begin with #.
inline Cones read_cones(std::istream& in)
{
  Cones cones;
  for(std::string text; std::getline(in, text); )
  {
    text = text.substr(0, text.find('#'));
    if(count_words(text) == 0)
      continue;
    std::istringstream line(text);
    std::size_t vertex;
    std::string angle;
    if(! (line >> vertex >> angle) || count_words(text) != 2)
      throw std::runtime_error("not a cone: " + text);
    std::optional<Real> value;
    if(angle != "free")
      value = std::stold(angle) / 180 * pi;
    if(! cones.emplace(vertex, value).second)
      throw std::runtime_error("a cone is given twice: " + text);
  }
  return cones;
}

// What is allowed apart from the rounding of coordinates, relatively or in radians. The solver stops where angle sums are right up to 10^-12. Two
// ways to an edge that have n vertices between them end up n 10^-12 apart, then: room is left for 10^4 vertices, and, for the lengths of single
// edges, those of the border and those seen from two sides, for 10^3 and 10^2.
struct Tolerances
{
  Real cross_ratio = 1e-8, two_sides = 1e-10, border_scale = 1e-9, weights = 1e-8, angle = 1e-8;
  bool border_keeps_its_lengths = true;
  std::size_t lost_triangles = 0; // exactly so many are not positive: none, unless rounding has cost some
};

// A figure together with how it compares with its tolerance: at most 1 is good.
struct Worst
{
  Real value = 0, of_tolerance = 0;

  void insert(Real x, Real tolerance)
  {
    if(! std::isfinite(x))
      x = std::numeric_limits<Real>::infinity();
    value = (std::max)(value, x);
    of_tolerance = (std::max)(of_tolerance, x / tolerance);
  }
  bool is_good() const { return of_tolerance <= 1; }
};

struct Verdict
{
  bool same_mesh = false;
  Worst cross_ratio, two_sides, border_scale, weights, angle, cone_angle;
  std::size_t interior_edges = 0, border_edges = 0, interior_vertices = 0, not_positive_triangles = 0, expected_not_positive = 0;
  std::size_t cones = 0, free_cones = 0, cones_not_inside = 0, pieces = 0, overlapping_pieces = 0;

  bool is_good() const
  {
    return same_mesh && cross_ratio.is_good() && two_sides.is_good() && border_scale.is_good()
        && weights.is_good() && angle.is_good() && cone_angle.is_good() && cones_not_inside == 0
        && not_positive_triangles == expected_not_positive && overlapping_pieces == 0;
  }
};

inline std::ostream& operator<<(std::ostream& out, const Verdict& v)
{
  const auto print = [&](const char* name, const Worst& w)
    { out << name << double(w.value) << (w.is_good() ? "" : "   TOO LARGE") << " (" << double(w.of_tolerance) << " of the tolerance)\n"; };
  out << "mesh of the input: " << (v.same_mesh ? "yes" : "NO") << '\n';
  print("length cross ratios, largest relative difference: ", v.cross_ratio);
  print("two sides of an edge, largest relative difference: ", v.two_sides);
  print("border, spread of the scale: ", v.border_scale);
  print("weights, spread of the scale: ", v.weights);
  print("angle sums inside, largest difference from 2 pi: ", v.angle);
  print("cones, largest difference from the angle: ", v.cone_angle);
  out << "cones: " << v.cones << ", free: " << v.free_cones << ", not interior vertices: " << v.cones_not_inside << '\n'
      << "pieces: " << v.pieces << ", pairs whose boxes overlap: " << v.overlapping_pieces << '\n';
  return out << "triangles not positively oriented: " << v.not_positive_triangles << " (exact)\n"
             << (v.is_good() ? "GOOD" : "BAD") << '\n';
}

class Checker
{
public:
  Checker(const Surface& input, const Surface& output, const Tolerances& tolerances, const Cones& cones)
    : input_(input), output_(output), tolerances_(tolerances), cones_(cones)
  {
    verdict_.expected_not_positive = tolerances.lost_triangles;
    verdict_.same_mesh = input.points == output.points && input.faces == output.faces && ! output.texture.empty();
    if(! verdict_.same_mesh)
      return;
    divide_by_weights();
    check_orientations();
    measure_lengths();
    pair_edges();
    check_edges();
    check_angles();
    check_pieces();
    if(output.has_weights)
      check_weights();
  }

  const Verdict& verdict() const { return verdict_; }

private:
  typedef std::array<Real, 3> Lengths; // lengths[k] of the edge from corner k to corner k + 1

  void divide_by_weights()
  {
    std::array<double, 2> lower{{HUGE_VAL, HUGE_VAL}}, upper{{-HUGE_VAL, -HUGE_VAL}};
    for(const auto& t : output_.texture)
    {
      layout_.push_back({{ t[0] / t[2], t[1] / t[2] }});
      for(std::size_t k = 0; k < 2; ++k)
      {
        lower[k] = (std::min)(lower[k], layout_.back()[k]);
        upper[k] = (std::max)(upper[k], layout_.back()[k]);
      }
    }
    diameter_ = std::hypot(upper[0] - lower[0], upper[1] - lower[1]);
  }

  void check_orientations()
  {
    typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_2 Point;
    const auto point = [&](std::size_t i) { return Point(layout_[i][0], layout_[i][1]); };
    for(const auto& c : output_.corners)
    {
      const bool is_finite = std::isfinite(layout_[c[0]][0] + layout_[c[1]][0] + layout_[c[2]][0]
                                         + layout_[c[0]][1] + layout_[c[1]][1] + layout_[c[2]][1]);
      if(! is_finite || CGAL::orientation(point(c[0]), point(c[1]), point(c[2])) != CGAL::LEFT_TURN)
        ++verdict_.not_positive_triangles;
    }
  }

  void measure_lengths()
  {
    for(std::size_t f = 0; f < input_.faces.size(); ++f)
    {
      Lengths in, out;
      for(std::size_t k = 0; k < 3; ++k)
      {
        const auto& p = input_.points[input_.faces[f][k]];
        const auto& q = input_.points[input_.faces[f][(k + 1) % 3]];
        in[k] = std::hypot(Real(q[0]) - p[0], Real(q[1]) - p[1], Real(q[2]) - p[2]);
        const auto& a = layout_[output_.corners[f][k]];
        const auto& b = layout_[output_.corners[f][(k + 1) % 3]];
        out[k] = std::hypot(Real(b[0]) - a[0], Real(b[1]) - a[1]);
      }
      in_.push_back(in);
      out_.push_back(out);
    }
  }

  Real tolerance(Real stated, Real shortest) const
  {
    return (std::max)(stated, 16 * std::ldexp(Real(1), -53) * diameter_ / shortest);
  }

  // the edge k of the face f, seen from there: (length towards the apex) / (length from it)
  static Real half_cross_ratio(const Lengths& l, std::size_t k) { return l[(k + 1) % 3] / l[(k + 2) % 3]; }

  // other_[3 f + k] is the other side of the edge k of the face f
  void pair_edges()
  {
    std::unordered_map<std::uint64_t, std::size_t> side_of; // of each directed edge
    const auto key = [](std::size_t i, std::size_t j) { return (std::uint64_t(i) << 32) | std::uint64_t(j); };
    side_of.reserve(3 * input_.faces.size());
    for(std::size_t s = 0; s < 3 * input_.faces.size(); ++s)
      side_of[key(vertex(s), vertex(next(s)))] = s;
    for(std::size_t s = 0; s < 3 * input_.faces.size(); ++s)
    {
      const auto other = side_of.find(key(vertex(next(s)), vertex(s)));
      other_.push_back(other == side_of.end() ? none : other->second);
    }
  }

  static std::size_t next(std::size_t side) { return side - side % 3 + (side + 1) % 3; }
  std::size_t vertex(std::size_t side) const { return input_.faces[side / 3][side % 3]; }
  const std::array<double, 2>& place(std::size_t side) const { return layout_[output_.corners[side / 3][side % 3]]; }

  void check_edges()
  {
    Real least = std::numeric_limits<Real>::infinity(), largest = 0, loosest = 0;
    for(std::size_t s = 0; s < other_.size(); ++s)
    {
      const std::size_t f = s / 3, k = s % 3;
      if(other_[s] == none)
      {
        ++verdict_.border_edges;
        const Real scale = out_[f][k] / in_[f][k];
        least = (std::min)(least, scale);
        largest = (std::max)(largest, scale);
        loosest = (std::max)(loosest, tolerance(tolerances_.border_scale, out_[f][k]));
      }
      else if(s < other_[s])
        check_interior_edge(f, k, other_[s] / 3, other_[s] % 3);
    }
    if(tolerances_.border_keeps_its_lengths && verdict_.border_edges != 0)
      verdict_.border_scale.insert(largest / least - 1, loosest);
  }

  void check_interior_edge(std::size_t f, std::size_t k, std::size_t g, std::size_t m)
  {
    ++verdict_.interior_edges;
    const Lengths &a = out_[f], &b = out_[g];
    const Real shortest = (std::min)({a[0], a[1], a[2], b[0], b[1], b[2]});
    // both triangles seen from the same side: what leads to the apex of one leads from the apex of the other
    const Real in = half_cross_ratio(in_[f], k) * half_cross_ratio(in_[g], m);
    const Real out = half_cross_ratio(a, k) * half_cross_ratio(b, m);
    verdict_.cross_ratio.insert(std::abs(out / in - 1), tolerance(tolerances_.cross_ratio, shortest));
    verdict_.two_sides.insert(std::abs(a[k] / b[m] - 1), tolerance(tolerances_.two_sides, (std::min)(a[k], b[m])));
  }

  void check_weights()
  {
    Real sum = 0;
    std::size_t n = 0;
    const auto log_scale = [&](std::size_t f, std::size_t k)
    {
      const Real w = output_.texture[output_.corners[f][k]][2], x = output_.texture[output_.corners[f][(k + 1) % 3]][2];
      return std::log(out_[f][k] / in_[f][k]) + (std::log(w) + std::log(x)) / 2;
    };
    for(std::size_t f = 0; f < input_.faces.size(); ++f)
      for(std::size_t k = 0; k < 3; ++k, ++n)
        sum += log_scale(f, k);
    for(std::size_t f = 0; f < input_.faces.size(); ++f)
      for(std::size_t k = 0; k < 3; ++k)
        verdict_.weights.insert(std::abs(log_scale(f, k) - sum / Real(n)), tolerance(tolerances_.weights, out_[f][k]));
  }

  struct Vertex
  {
    Real angle = 0, shortest = std::numeric_limits<Real>::infinity();
    std::size_t faces = 0;
    bool is_on_border = false;
    bool is_interior() const { return faces != 0 && ! is_on_border; }
  };

  // The signed angle at the corner where the side `s` begins.
  Real angle(std::size_t s) const
  {
    const auto &p = place(s), &q = place(next(s)), &r = place(next(next(s)));
    const Real a = Real(q[0]) - p[0], b = Real(q[1]) - p[1], c = Real(r[0]) - p[0], d = Real(r[1]) - p[1];
    return std::atan2(a * d - b * c, a * c + b * d);
  }

  void check_angles()
  {
    std::vector<Vertex> vertices(input_.points.size());
    for(std::size_t s = 0; s < other_.size(); ++s)
    {
      Vertex& v = vertices[vertex(s)];
      const Lengths& l = out_[s / 3];
      v.angle += angle(s);
      v.shortest = (std::min)({v.shortest, l[s % 3], l[(s + 2) % 3]});
      ++v.faces;
      if(other_[s] == none)
        v.is_on_border = vertices[vertex(next(s))].is_on_border = true;
    }
    for(std::size_t i = 0; i < vertices.size(); ++i)
    {
      const Vertex& v = vertices[i];
      const auto cone = cones_.find(i);
      if(! v.is_interior())
        continue;
      ++verdict_.interior_vertices;
      const Real bound = (std::max)(tolerances_.angle, Real(v.faces) * tolerance(0, v.shortest));
      if(cone == cones_.end())
        verdict_.angle.insert(std::abs(v.angle - 2 * pi), bound);
      else if(cone->second)
        verdict_.cone_angle.insert(std::abs(v.angle - *cone->second), bound);
    }
    verdict_.cones = cones_.size();
    for(const auto& cone : cones_)
    {
      verdict_.free_cones += ! cone.second;
      verdict_.cones_not_inside += cone.first >= vertices.size() || ! vertices[cone.first].is_interior();
    }
  }

  struct Box
  {
    std::array<double, 2> lower{{HUGE_VAL, HUGE_VAL}}, upper{{-HUGE_VAL, -HUGE_VAL}};

    void insert(const std::array<double, 2>& p)
    {
      for(std::size_t k = 0; k < 2; ++k)
      {
        lower[k] = (std::min)(lower[k], p[k]);
        upper[k] = (std::max)(upper[k], p[k]);
      }
    }
    bool overlaps(const Box& b, std::size_t k) const { return lower[k] < b.upper[k] && b.lower[k] < upper[k]; }
  };

  bool sides_coincide(std::size_t s) const
  {
    const std::size_t o = other_[s];
    return o != none && place(s) == place(next(o)) && place(next(s)) == place(o);
  }

  std::vector<Box> boxes_of_pieces() const
  {
    std::vector<Box> boxes;
    std::vector<bool> is_seen(input_.faces.size(), false);
    std::vector<std::size_t> stack;
    const auto visit = [&](std::size_t f)
    {
      if(! is_seen[f])
        stack.push_back(f);
      is_seen[f] = true;
    };
    for(std::size_t first = 0; first < is_seen.size(); ++first)
    {
      if(is_seen[first])
        continue;
      boxes.emplace_back();
      for(visit(first); ! stack.empty(); )
      {
        const std::size_t f = stack.back();
        stack.pop_back();
        for(std::size_t s = 3 * f; s < 3 * f + 3; ++s)
        {
          boxes.back().insert(place(s));
          if(sides_coincide(s))
            visit(other_[s] / 3);
        }
      }
    }
    return boxes;
  }

  void check_pieces()
  {
    std::vector<Box> boxes = boxes_of_pieces();
    verdict_.pieces = boxes.size();
    std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.lower[0] < b.lower[0]; });
    for(std::size_t i = 0; i < boxes.size(); ++i)
      for(std::size_t j = i + 1; j < boxes.size() && boxes[j].lower[0] < boxes[i].upper[0]; ++j)
        verdict_.overlapping_pieces += boxes[i].overlaps(boxes[j], 0) && boxes[i].overlaps(boxes[j], 1);
  }

  static constexpr std::size_t none = std::size_t(-1);

  const Surface& input_;
  const Surface& output_;
  Tolerances tolerances_;
  Cones cones_;
  Verdict verdict_;
  std::vector<std::array<double, 2> > layout_;
  std::vector<Lengths> in_, out_;
  std::vector<std::size_t> other_;
  Real diameter_ = 0;
};

inline Verdict check_flattening(const Surface& input, const Surface& output, const Tolerances& tolerances = Tolerances(),
                                const Cones& cones = Cones())
{
  return Checker(input, output, tolerances, cones).verdict();
}

} // namespace checking

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_CHECK_FLATTENING_H
