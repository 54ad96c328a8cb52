// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Checks a flattening from the files alone: the input mesh, and the OBJ file with the
// texture coordinates. Shares no code with the package.
//
// What is checked (Springborn, Schroeder, Pinkall 2008):
//  - vertices and faces are those of the input;
//  - each interior edge has the same length cross ratio (4) in the layout as in space;
//  - both sides of an interior edge have the same length in the layout;
//  - border edges have the same scale, where the border is to keep its lengths;
//  - every triangle is positively oriented, by an exact predicate;
//  - weights w, if any, are those of (2): the scale of the edge ij is c / sqrt(w_i w_j).
//
// A relative tolerance t on a length l in a layout of diameter D reads max(t, 16 * 2^-53 * D / l): no
// coordinates of type double can promise more.

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

struct Tolerances
{
  Real cross_ratio = 1e-8, border_scale = 1e-9, weights = 1e-8;
  bool border_keeps_its_lengths = true;
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
  Worst cross_ratio, two_sides, border_scale, weights;
  std::size_t interior_edges = 0, border_edges = 0, not_positive_triangles = 0;

  bool is_good() const
  {
    return same_mesh && cross_ratio.is_good() && two_sides.is_good() && border_scale.is_good()
        && weights.is_good() && not_positive_triangles == 0;
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
  return out << "triangles not positively oriented: " << v.not_positive_triangles << " (exact)\n"
             << (v.is_good() ? "GOOD" : "BAD") << '\n';
}

class Checker
{
public:
  Checker(const Surface& input, const Surface& output, const Tolerances& tolerances)
    : m_input(input), m_output(output), m_tolerances(tolerances)
  {
    m_verdict.same_mesh = input.points == output.points && input.faces == output.faces && ! output.texture.empty();
    if(! m_verdict.same_mesh)
      return;
    divide_by_weights();
    check_orientations();
    measure_lengths();
    check_edges();
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

  void check_edges()
  {
    std::unordered_map<std::uint64_t, std::size_t> corner_of; // 3 f + k for each directed edge
    const auto key = [](std::size_t i, std::size_t j) { return (std::uint64_t(i) << 32) | std::uint64_t(j); };
    corner_of.reserve(3 * m_input.faces.size());
    for(std::size_t f = 0; f < m_input.faces.size(); ++f)
      for(std::size_t k = 0; k < 3; ++k)
        corner_of[key(m_input.faces[f][k], m_input.faces[f][(k + 1) % 3])] = 3 * f + k;

    Real least = std::numeric_limits<Real>::infinity(), largest = 0, loosest = 0;
    for(std::size_t f = 0; f < m_input.faces.size(); ++f)
      for(std::size_t k = 0; k < 3; ++k)
      {
        const std::size_t i = m_input.faces[f][k], j = m_input.faces[f][(k + 1) % 3];
        const auto other = corner_of.find(key(j, i));
        if(other == corner_of.end())
        {
          ++m_verdict.border_edges;
          const Real scale = m_out[f][k] / m_in[f][k];
          least = (std::min)(least, scale);
          largest = (std::max)(largest, scale);
          loosest = (std::max)(loosest, tolerance(m_tolerances.border_scale, m_out[f][k]));
        }
        else if(i < j)
          check_interior_edge(f, k, other->second / 3, other->second % 3);
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
    m_verdict.two_sides.insert(std::abs(a[k] / b[m] - 1), tolerance(m_tolerances.border_scale, (std::min)(a[k], b[m])));
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

  const Surface& m_input;
  const Surface& m_output;
  Tolerances m_tolerances;
  Verdict m_verdict;
  std::vector<std::array<double, 2> > m_layout;
  std::vector<Lengths> m_in, m_out;
  Real m_diameter = 0;
};

inline Verdict check_flattening(const Surface& input, const Surface& output, const Tolerances& tolerances = Tolerances())
{
  return Checker(input, output, tolerances).verdict();
}

} // namespace checking

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_CHECK_FLATTENING_H
