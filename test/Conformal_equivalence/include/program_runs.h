// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The program flatten_mesh, run within a test. What it writes is judged from the files, by a
// checker that shares no code with the package.

#ifndef CONFORMAL_EQUIVALENCE_TEST_PROGRAM_RUNS_H
#define CONFORMAL_EQUIVALENCE_TEST_PROGRAM_RUNS_H

#include "boost_test.h"
#include "check_flattening.h"
#include "test_meshes.h"
#include "tolerances.h"

#include "../../../examples/Conformal_equivalence/include/flatten_mesh/flatten_mesh.h"

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
#  include <nlohmann/json.hpp>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace program {

namespace fs = std::filesystem;

// --- running ------------------------------------------------------------------------------------

// A folder of its own, gone at the end.
struct Folder
{
  fs::path path;

  Folder()
  {
    std::random_device random;
    do
      path = fs::temp_directory_path() / ("test_flatten_mesh_" + std::to_string(random()));
    while(! fs::create_directory(path));
  }
  ~Folder()
  {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }

  std::string operator/(const std::string& name) const { return (path / name).string(); }

  std::string write(const std::string& name, const std::string& content) const
  {
    std::ofstream(path / name, std::ios::binary) << content;
    return *this / name;
  }

  std::set<std::string> files() const
  {
    std::set<std::string> names;
    for(const auto& entry : fs::directory_iterator(path))
      names.insert(entry.path().filename().string());
    return names;
  }
};

struct Run
{
  int status;
  std::string out, err;
};

inline Run run(const std::vector<std::string>& arguments)
{
  std::vector<const char*> argv(1, "flatten_mesh");
  for(const std::string& a : arguments)
    argv.push_back(a.c_str());
  std::ostringstream out, err;
  const int status = flatten_mesh(static_cast<int>(argv.size()), argv.data(), out, err);
  return { status, out.str(), err.str() };
}

inline std::string content(const std::string& file)
{
  std::ifstream in(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// refused with this status and one line that holds `reason`
inline void check_refused(const std::vector<std::string>& arguments, int status, const std::string& reason)
{
  const Run r = run(arguments);
  BOOST_TEST_CONTEXT("expected: " << reason << "; said: " << r.err)
  {
    BOOST_TEST(r.status == status);
    BOOST_TEST(contains(r.err, reason));
    BOOST_TEST(std::count(r.err.begin(), r.err.end(), '\n') == 1);
    BOOST_TEST(r.out.empty());
  }
}

// --- meshes -------------------------------------------------------------------------------------

// Vertices and triangles, counted from 0.
struct Soup
{
  std::vector<std::array<double, 3> > points;
  std::vector<std::array<std::uint32_t, 3> > triangles;
};

// n by n squares, each of two triangles, over a bumpy height field
inline Soup bumpy_grid(std::size_t n)
{
  Soup soup;
  for(std::size_t j = 0; j <= n; ++j)
    for(std::size_t i = 0; i <= n; ++i)
    {
      const double x = double(i) / double(n), y = double(j) / double(n);
      soup.points.push_back({{ x, y, 0.25 * std::sin(4 * x + 1) * std::cos(5 * y) + 0.1 * x * y }});
    }
  const auto v = [n](std::size_t i, std::size_t j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for(std::size_t j = 0; j < n; ++j)
    for(std::size_t i = 0; i < n; ++i)
    {
      soup.triangles.push_back({{ v(i, j), v(i + 1, j), v(i + 1, j + 1) }});
      soup.triangles.push_back({{ v(i, j), v(i + 1, j + 1), v(i, j + 1) }});
    }
  return soup;
}

inline std::string number(double x)
{
  std::ostringstream out;
  out.precision(17);
  out << x;
  return out.str();
}

inline std::string point(const std::array<double, 3>& p) { return number(p[0]) + ' ' + number(p[1]) + ' ' + number(p[2]); }

inline std::string as_off(const Soup& soup)
{
  std::ostringstream out;
  out << "OFF # a comment\n\n" << soup.points.size() << ' ' << soup.triangles.size() << " 0\n";
  for(const auto& p : soup.points)
    out << point(p) << '\n';
  for(const auto& t : soup.triangles)
    out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return out.str();
}

inline std::string off(const std::string& vertices, const std::string& faces)
{
  const auto lines = [](const std::string& s) { return std::count(s.begin(), s.end(), '\n'); };
  return "OFF\n" + std::to_string(lines(vertices)) + ' ' + std::to_string(lines(faces)) + " 0\n" + vertices + faces;
}

inline checking::Verdict judge(const std::string& input, const std::string& output, bool border_keeps_its_lengths = true,
                               const checking::Cones& cones = {})
{
  checking::Tolerances tolerances;
  tolerances.border_keeps_its_lengths = border_keeps_its_lengths;
  const checking::Verdict verdict =
    checking::check_flattening(checking::read_surface(input), checking::read_surface(output), tolerances, cones);
  BOOST_TEST_MESSAGE(verdict);
  return verdict;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
inline nlohmann::json json(const std::string& file) { return nlohmann::json::parse(content(file)); }
#endif

// An ellipsoid with bumps: its triangulation needs no flips.
inline testing::Soup bumpy_sphere(int levels)
{
  testing::Soup soup = testing::icosphere(levels);
  for(testing::Point& p : soup.points)
  {
    const double r = 1 + .1 * std::sin(5 * p[0]) * std::cos(4 * p[1] + p[2]);
    p = {{ 1.4 * r * p[0], r * p[1], .8 * r * p[2] }};
  }
  return soup;
}

inline Soup program_soup(const testing::Soup& soup) { return { soup.points, soup.triangles }; }

inline std::string write_off(const Folder& folder, const std::string& name, const testing::Soup& soup)
{
  return folder.write(name, as_off(program_soup(soup)));
}

// Corners of a layout, weights divided out.
inline std::array<double, 2> corner(const checking::Surface& s, std::size_t f, std::size_t k)
{
  const auto& t = s.texture[s.corners[f][k % 3]];
  return {{ t[0] / t[2], t[1] / t[2] }};
}

inline double area(const checking::Surface& s)
{
  double sum = 0;
  for(std::size_t f = 0; f < s.faces.size(); ++f)
  {
    const auto p = corner(s, f, 0), q = corner(s, f, 1), r = corner(s, f, 2);
    sum += ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2;
  }
  return sum;
}

// a cone of this many degrees
inline std::optional<checking::Real> degrees(double angle) { return angle / 180 * checking::pi; }
const std::optional<checking::Real> free_angle;

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
// Each piece is a disk: the corners, as distinct points of the layout, satisfy Euler's formula.
inline void check_number_of_corners(const checking::Surface& s, const nlohmann::json& report)
{
  const long components = report["components"].get<long>();
  const long chi = 2 * components - report["borders"].get<long>() - 2 * report["genus"].get<long>();
  const long vertices = report["vertices"].get<long>() - report["isolated_vertices"].get<long>();
  BOOST_TEST(long(s.texture.size()) == vertices - chi + components + report["seam_edges"].get<long>());
}
#endif

// Runs the program, which succeeds and whose layout is good; returns its layout and its report.
struct Flattened
{
  checking::Surface layout;
  checking::Verdict verdict;
  std::string out;
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  nlohmann::json report;
#endif

  Flattened(const Folder& folder, const std::string& input, const std::vector<std::string>& options = {},
            const checking::Cones& cones = {}, bool borders_keep_their_lengths = true)
  {
    std::vector<std::string> arguments = { input, "-o", folder / "o.obj" };
    arguments.insert(arguments.end(), options.begin(), options.end());
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    arguments.insert(arguments.end(), { "--report", folder / "o.json" });
#endif
    const Run r = run(arguments);
    BOOST_TEST_CONTEXT(r.err)
    BOOST_REQUIRE(r.status == 0);
    out = r.out;
    BOOST_TEST_MESSAGE(out);
    verdict = judge(input, folder / "o.obj", borders_keep_their_lengths, cones);
    BOOST_TEST(verdict.is_good());
    layout = checking::read_surface(folder / "o.obj");
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    report = json(folder / "o.json");
    BOOST_TEST(report["residual"].get<double>() <= 1e-12);
    BOOST_TEST(report["flipped_triangles"] == 0);
    check_number_of_corners(layout, report);
#endif
  }
};

// Two hills on a disk: rings of 6, 12, 18, ... vertices around the vertex 0.
inline testing::Soup two_hills(testing::Index number_of_rings)
{
  const auto hill = [](double x, double y) { return .8 * std::exp(-8 * (x * x + y * y)); };
  return testing::rings(number_of_rings, [=](double x, double y) { return hill(x - .5, y) + hill(x + .45, y - .1); });
}

inline std::size_t in_ring(std::size_t ring, std::size_t i) { return 1 + 3 * ring * (ring - 1) + i; }

inline std::string cone_lines(const std::vector<std::size_t>& vertices, const std::string& angle)
{
  std::string lines;
  for(std::size_t v : vertices)
    lines += std::to_string(v) + ' ' + angle + '\n';
  return lines;
}

inline std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more)
{
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

} // namespace program

#endif // CONFORMAL_EQUIVALENCE_TEST_PROGRAM_RUNS_H
