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
    : m_input(input), m_output(output), m_tolerances(tolerances), m_cones(cones)
  {
    m_verdict.expected_not_positive = tolerances.lost_triangles;
    m_verdict.same_mesh = input.points == output.points && input.faces == output.faces && ! output.texture.empty();
    if(! m_verdict.same_mesh)
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

  const Verdict& verdict() const { return m_verdict; }

private:
  typedef std::array<Real, 3> Lengths; // lengths[k] of the edge from corner k to corner k + 1

  void divide_by_weights()
  {
    std::array<double, 2> lower{{HUGE_VAL, HUGE_VAL}}, upper{{-HUGE_VAL, -HUGE_VAL}};
    for(const auto& t : m_output.texture)
    {
      m_layout.push_back({{ t[0] / t[2], t[1] / t[2] }});
      for(std::size_t k = 0; k < 2; ++k)
      {
        lower[k] = (std::min)(lower[k], m_layout.back()[k]);
        upper[k] = (std::max)(upper[k], m_layout.back()[k]);
      }
    }
    m_diameter = std::hypot(upper[0] - lower[0], upper[1] - lower[1]);
  }

  void check_orientations()
  {
    typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_2 Point;
    const auto point = [&](std::size_t i) { return Point(m_layout[i][0], m_layout[i][1]); };
    for(const auto& c : m_output.corners)
    {
      const bool is_finite = std::isfinite(m_layout[c[0]][0] + m_layout[c[1]][0] + m_layout[c[2]][0]
                                         + m_layout[c[0]][1] + m_layout[c[1]][1] + m_layout[c[2]][1]);
      if(! is_finite || CGAL::orientation(point(c[0]), point(c[1]), point(c[2])) != CGAL::LEFT_TURN)
        ++m_verdict.not_positive_triangles;
    }
  }

  void measure_lengths()
  {
    for(std::size_t f = 0; f < m_input.faces.size(); ++f)
    {
      Lengths in, out;
      for(std::size_t k = 0; k < 3; ++k)
      {
        const auto& p = m_input.points[m_input.faces[f][k]];
        const auto& q = m_input.points[m_input.faces[f][(k + 1) % 3]];
        in[k] = std::hypot(Real(q[0]) - p[0], Real(q[1]) - p[1], Real(q[2]) - p[2]);
        const auto& a = m_layout[m_output.corners[f][k]];
        const auto& b = m_layout[m_output.corners[f][(k + 1) % 3]];
        out[k] = std::hypot(Real(b[0]) - a[0], Real(b[1]) - a[1]);
      }
      m_in.push_back(in);
      m_out.push_back(out);
    }
  }

  Real tolerance(Real stated, Real shortest) const
  {
    return (std::max)(stated, 16 * std::ldexp(Real(1), -53) * m_diameter / shortest);
  }

  // the edge k of the face f, seen from there: (length towards the apex) / (length from it)
  static Real half_cross_ratio(const Lengths& l, std::size_t k) { return l[(k + 1) % 3] / l[(k + 2) % 3]; }

  // m_other[3 f + k] is the other side of the edge k of the face f
  void pair_edges()
  {
    std::unordered_map<std::uint64_t, std::size_t> side_of; // of each directed edge
    const auto key = [](std::size_t i, std::size_t j) { return (std::uint64_t(i) << 32) | std::uint64_t(j); };
    side_of.reserve(3 * m_input.faces.size());
    for(std::size_t s = 0; s < 3 * m_input.faces.size(); ++s)
      side_of[key(vertex(s), vertex(next(s)))] = s;
    for(std::size_t s = 0; s < 3 * m_input.faces.size(); ++s)
    {
      const auto other = side_of.find(key(vertex(next(s)), vertex(s)));
      m_other.push_back(other == side_of.end() ? none : other->second);
    }
  }

  static std::size_t next(std::size_t side) { return side - side % 3 + (side + 1) % 3; }
  std::size_t vertex(std::size_t side) const { return m_input.faces[side / 3][side % 3]; }
  const std::array<double, 2>& place(std::size_t side) const { return m_layout[m_output.corners[side / 3][side % 3]]; }

  void check_edges()
  {
    Real least = std::numeric_limits<Real>::infinity(), largest = 0, loosest = 0;
    for(std::size_t s = 0; s < m_other.size(); ++s)
    {
      const std::size_t f = s / 3, k = s % 3;
      if(m_other[s] == none)
      {
        ++m_verdict.border_edges;
        const Real scale = m_out[f][k] / m_in[f][k];
        least = (std::min)(least, scale);
        largest = (std::max)(largest, scale);
        loosest = (std::max)(loosest, tolerance(m_tolerances.border_scale, m_out[f][k]));
      }
      else if(s < m_other[s])
        check_interior_edge(f, k, m_other[s] / 3, m_other[s] % 3);
    }
    if(m_tolerances.border_keeps_its_lengths && m_verdict.border_edges != 0)
      m_verdict.border_scale.insert(largest / least - 1, loosest);
  }

  void check_interior_edge(std::size_t f, std::size_t k, std::size_t g, std::size_t m)
  {
    ++m_verdict.interior_edges;
    const Lengths &a = m_out[f], &b = m_out[g];
    const Real shortest = (std::min)({a[0], a[1], a[2], b[0], b[1], b[2]});
    // both triangles seen from the same side: what leads to the apex of one leads from the apex of the other
    const Real in = half_cross_ratio(m_in[f], k) * half_cross_ratio(m_in[g], m);
    const Real out = half_cross_ratio(a, k) * half_cross_ratio(b, m);
    m_verdict.cross_ratio.insert(std::abs(out / in - 1), tolerance(m_tolerances.cross_ratio, shortest));
    m_verdict.two_sides.insert(std::abs(a[k] / b[m] - 1), tolerance(m_tolerances.two_sides, (std::min)(a[k], b[m])));
  }

  void check_weights()
  {
    Real sum = 0;
    std::size_t n = 0;
    const auto log_scale = [&](std::size_t f, std::size_t k)
    {
      const Real w = m_output.texture[m_output.corners[f][k]][2], x = m_output.texture[m_output.corners[f][(k + 1) % 3]][2];
      return std::log(m_out[f][k] / m_in[f][k]) + (std::log(w) + std::log(x)) / 2;
    };
    for(std::size_t f = 0; f < m_input.faces.size(); ++f)
      for(std::size_t k = 0; k < 3; ++k, ++n)
        sum += log_scale(f, k);
    for(std::size_t f = 0; f < m_input.faces.size(); ++f)
      for(std::size_t k = 0; k < 3; ++k)
        m_verdict.weights.insert(std::abs(log_scale(f, k) - sum / Real(n)), tolerance(m_tolerances.weights, m_out[f][k]));
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
    std::vector<Vertex> vertices(m_input.points.size());
    for(std::size_t s = 0; s < m_other.size(); ++s)
    {
      Vertex& v = vertices[vertex(s)];
      const Lengths& l = m_out[s / 3];
      v.angle += angle(s);
      v.shortest = (std::min)({v.shortest, l[s % 3], l[(s + 2) % 3]});
      ++v.faces;
      if(m_other[s] == none)
        v.is_on_border = vertices[vertex(next(s))].is_on_border = true;
    }
    for(std::size_t i = 0; i < vertices.size(); ++i)
    {
      const Vertex& v = vertices[i];
      const auto cone = m_cones.find(i);
      if(! v.is_interior())
        continue;
      ++m_verdict.interior_vertices;
      const Real bound = (std::max)(m_tolerances.angle, Real(v.faces) * tolerance(0, v.shortest));
      if(cone == m_cones.end())
        m_verdict.angle.insert(std::abs(v.angle - 2 * pi), bound);
      else if(cone->second)
        m_verdict.cone_angle.insert(std::abs(v.angle - *cone->second), bound);
    }
    m_verdict.cones = m_cones.size();
    for(const auto& cone : m_cones)
    {
      m_verdict.free_cones += ! cone.second;
      m_verdict.cones_not_inside += cone.first >= vertices.size() || ! vertices[cone.first].is_interior();
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
    const std::size_t o = m_other[s];
    return o != none && place(s) == place(next(o)) && place(next(s)) == place(o);
  }

  std::vector<Box> boxes_of_pieces() const
  {
    std::vector<Box> boxes;
    std::vector<bool> is_seen(m_input.faces.size(), false);
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
            visit(m_other[s] / 3);
        }
      }
    }
    return boxes;
  }

  void check_pieces()
  {
    std::vector<Box> boxes = boxes_of_pieces();
    m_verdict.pieces = boxes.size();
    std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.lower[0] < b.lower[0]; });
    for(std::size_t i = 0; i < boxes.size(); ++i)
      for(std::size_t j = i + 1; j < boxes.size() && boxes[j].lower[0] < boxes[i].upper[0]; ++j)
        m_verdict.overlapping_pieces += boxes[i].overlaps(boxes[j], 0) && boxes[i].overlaps(boxes[j], 1);
  }

  static constexpr std::size_t none = std::size_t(-1);

  const Surface& m_input;
  const Surface& m_output;
  Tolerances m_tolerances;
  Cones m_cones;
  Verdict m_verdict;
  std::vector<std::array<double, 2> > m_layout;
  std::vector<Lengths> m_in, m_out;
  std::vector<std::size_t> m_other;
  Real m_diameter = 0;
};

inline Verdict check_flattening(const Surface& input, const Surface& output, const Tolerances& tolerances = Tolerances(),
                                const Cones& cones = Cones())
{
  return Checker(input, output, tolerances, cones).verdict();
}

} // namespace checking

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_CHECK_FLATTENING_H
