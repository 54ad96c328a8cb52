// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The program flatten_mesh on surfaces of any topology, with cones that are given or place themselves.

#define BOOST_TEST_MODULE test_flatten_mesh_cones
#include "include/boost_test.h"
#include "include/check_flattening.h"
#include "include/components.h"
#include "include/program_runs.h"
#include "include/test_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using namespace program;

namespace {

// Angle sums of the layout at all vertices, 0 at isolated ones.
std::vector<double> angle_sums(const checking::Surface& s)
{
  std::vector<double> sums(s.points.size(), 0.);
  for(std::size_t f = 0; f < s.faces.size(); ++f)
    for(std::size_t k = 0; k < 3; ++k)
    {
      const auto p = corner(s, f, k), q = corner(s, f, k + 1), r = corner(s, f, k + 2);
      const double x = q[0] - p[0], y = q[1] - p[1], z = r[0] - p[0], w = r[1] - p[1];
      sums[s.faces[f][k]] += std::atan2(x * w - y * z, x * z + y * w);
    }
  return sums;
}

// Length in the layout by length in space, at the edge from a to b.
double scale_of_edge(const checking::Surface& s, std::size_t a, std::size_t b)
{
  for(std::size_t f = 0; f < s.faces.size(); ++f)
    for(std::size_t k = 0; k < 3; ++k)
      if(s.faces[f][k] == a && s.faces[f][(k + 1) % 3] == b)
      {
        const auto p = corner(s, f, k), q = corner(s, f, k + 1);
        return std::hypot(q[0] - p[0], q[1] - p[1]) / testing::distance<double>(s.points[a], s.points[b]);
      }
  return 0;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
// The lattice in the report is that of the layout of one torus.
void check_lattice(const checking::Surface& s, const nlohmann::json& report)
{
  BOOST_REQUIRE(report["lattices"].size() == 1u);
  const nlohmann::json& lattice = report["lattices"][0];
  BOOST_TEST(lattice["face"].is_number_integer());
  const auto p = lattice["periods"].get<std::array<std::array<double, 2>, 2> >();
  const auto tau = lattice["tau"].get<std::array<double, 2> >();
  const double det = p[0][0] * p[1][1] - p[0][1] * p[1][0], norm = p[0][0] * p[0][0] + p[0][1] * p[0][1];
  BOOST_TEST(std::abs(area(s) / det - 1) < testing::summed_residuals); // the torus covers the plane once
  BOOST_TEST(std::abs(tau[0] - (p[0][0] * p[1][0] + p[0][1] * p[1][1]) / norm) < testing::summed_residuals);
  BOOST_TEST(std::abs(tau[1] - det / norm) < testing::summed_residuals);
  BOOST_TEST(std::abs(tau[0]) <= .5 + testing::summed_residuals);
  BOOST_TEST(std::hypot(tau[0], tau[1]) >= 1 - testing::summed_residuals);
}
#endif

} // namespace

BOOST_AUTO_TEST_CASE(sphere_with_eight_cones)
{
  const Folder folder;
  const std::string input = write_off(folder, "sphere.off", testing::icosphere(3));
  const std::string cones = folder.write("cones.txt", "# equal angles\n\n0 270\n 1\t+270.0 # here\n2 2.7e2\n3 270\r\n4 270\n5 270\n6 270\n7 270");
  checking::Cones expected;
  for(std::size_t v = 0; v < 8; ++v)
    expected[v] = degrees(270);
  const Flattened f(folder, input, {"--cones", cones, "--projective", "--svg", folder / "o.svg"}, expected);
  BOOST_TEST(! judge(input, folder / "o.obj").is_good()); // taken for a layout without cones
  expected[3] = degrees(271);
  BOOST_TEST(! judge(input, folder / "o.obj", true, expected).is_good());
  BOOST_TEST(contains(f.out, "surface                 1 component, 0 borders, genus 0\n"));
  BOOST_TEST(contains(f.out, "cones                   8\n"));
  BOOST_TEST(contains(f.out, "seam edges              "));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST(f.report["genus"] == 0);
  BOOST_TEST(f.report["borders"] == 0);
  BOOST_TEST(f.report["components"] == 1);
  BOOST_TEST(f.report["lattices"].empty());
  BOOST_TEST(f.report["seam_edges"].get<int>() >= 7); // a tree that reaches all cones
  BOOST_REQUIRE(f.report["cones"].size() == 8u);
  for(std::size_t v = 0; v < 8; ++v)
  {
    BOOST_TEST(f.report["cones"][v]["vertex"] == v);
    BOOST_TEST(std::abs(f.report["cones"][v]["angle_degrees"].get<double>() - 270) < testing::summed_residuals_in_degrees);
    BOOST_TEST(f.report["cones"][v]["prescribed"] == true);
  }
#endif
}

BOOST_AUTO_TEST_CASE(sphere_with_free_cones)
{
  const Folder folder;
  const std::string input = write_off(folder, "sphere.off", testing::icosphere(3));
  const std::string cones = folder.write("cones.txt", "9 free\n8 # free, too\n0 200\n3 220\n7 free\n20 360\n");
  const Flattened f(folder, input, {"--cones", cones, "--projective"},
                    {{0, degrees(200)}, {3, degrees(220)}, {7, free_angle}, {8, free_angle}, {9, free_angle}});
  const std::vector<double> sums = angle_sums(f.layout);
  // 720 degrees of curvature, of which 300 are prescribed; u = 0 at the free cones
  BOOST_TEST(std::abs((sums[7] + sums[8] + sums[9]) / CGAL_PI * 180 - (3 * 360 - 420)) < 3 * testing::summed_residuals_in_degrees);
  std::map<std::size_t, double> weight;
  for(std::size_t i = 0; i < f.layout.faces.size(); ++i)
    for(std::size_t k = 0; k < 3; ++k)
      weight[f.layout.faces[i][k]] = f.layout.texture[f.layout.corners[i][k]][2];
  BOOST_TEST(weight[7] == weight[8]);
  BOOST_TEST(weight[7] == weight[9]);
  BOOST_TEST(contains(f.out, "cones                   5, 3 of them free\n"));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  const std::vector<std::size_t> expected = {0, 3, 7, 8, 9}; // an angle of 360 degrees is no cone
  BOOST_REQUIRE(f.report["cones"].size() == expected.size());
  for(std::size_t i = 0; i < expected.size(); ++i)
  {
    const nlohmann::json& cone = f.report["cones"][i];
    BOOST_TEST(cone["vertex"] == expected[i]);
    BOOST_TEST(cone["prescribed"] == (expected[i] < 7));
    BOOST_TEST(std::abs(cone["angle_degrees"].get<double>() - sums[expected[i]] / CGAL_PI * 180) < 2 * testing::summed_residuals_in_degrees);
  }
#endif
}

BOOST_AUTO_TEST_CASE(torus_and_its_lattice)
{
  const Folder folder;
  const std::string input = write_off(folder, "torus.off", testing::torus(48, 16));
  const Flattened f(folder, input);
  BOOST_TEST(contains(f.out, "genus 1\n"));
  BOOST_TEST(contains(f.out, "tau                     "));
  BOOST_TEST(! contains(f.out, "cones"));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST(f.report["genus"] == 1);
  BOOST_TEST(f.report["cones"].empty());
  check_lattice(f.layout, f.report);
  // the smooth torus has tau = i sqrt(3^2 - 1^2) / 1
  BOOST_TEST(std::abs(f.report["lattices"][0]["tau"][1].get<double>() - std::sqrt(8.)) < 0.1);
#endif
  // with cones there is no lattice
  const std::string cones = folder.write("cones.txt", "0 300\n400 420\n");
  const Flattened g(folder, input, {"--cones", cones}, {{0, degrees(300)}, {400, degrees(420)}});
  BOOST_TEST(! contains(g.out, "tau"));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST(g.report["lattices"].empty());
#endif
}

BOOST_AUTO_TEST_CASE(annulus)
{
  const Folder folder;
  const std::size_t m = 6, n = 40;
  const std::string input = write_off(folder, "annulus.off", testing::annulus(m, n, .4));
  const Flattened f(folder, input); // both borders keep their lengths
  BOOST_TEST(contains(f.out, "surface                 1 component, 2 borders, genus 0\n"));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST(f.report["borders"] == 2);
  BOOST_TEST(f.report["seam_edges"].get<int>() >= int(m)); // from one border to the other
#endif

  const std::string cones = folder.write("cones.txt", "100 330\n");
  Flattened(folder, input, {"--cones", cones}, {{100, degrees(330)}});
}

BOOST_AUTO_TEST_CASE(rectangle_on_one_of_two_borders)
{
  const Folder folder;
  const std::size_t m = 6, n = 40;
  const std::string input = write_off(folder, "annulus.off", testing::annulus(m, n, .4));
  const Flattened f(folder, input, {"--boundary", "rectangle=240,250,260,270"}, {}, false);
  const std::vector<double> sums = angle_sums(f.layout);
  for(std::size_t i = 0; i < n; ++i)
    BOOST_TEST(std::abs(sums[m * n + i] - (i % 10 == 0 ? CGAL_PI / 2 : CGAL_PI)) < testing::summed_residuals);
  for(std::size_t i = 0; i < n; ++i) // the inner border keeps its lengths
  {
    const double scale = (std::max)(scale_of_edge(f.layout, i, (i + 1) % n), scale_of_edge(f.layout, (i + 1) % n, i));
    BOOST_TEST(std::abs(scale - 1) < testing::summed_residuals);
  }
  check_refused({input, "--boundary", "rectangle=0,10,20,270"}, 1, "vertex 270 is not on the same border as vertex 0");
  check_refused({input, "--boundary", "rectangle=240,3,250,260"}, 1, "vertex 3 is not on the same border as vertex 240");
  check_refused({input, "--boundary", "rectangle=240,100,250,260"}, 1, "vertex 100 is not on the border");
  check_refused({input, "--boundary", "rectangle"}, 1, "wrong topology: found 1 component, 2 borders, genus 0");
  const std::string sphere = write_off(folder, "sphere.off", testing::icosphere(1));
  check_refused({sphere, "--boundary", "rectangle"}, 1, "the mesh is closed");
  check_refused({sphere, "--boundary", "rectangle=0,1,2,3"}, 1, "vertex 0 is not on the border");
}

// Each component becomes one, with the corners that it would have alone.
BOOST_AUTO_TEST_CASE(several_rectangles)
{
  const Folder folder;
  const Mixture all({two_hills(5), testing::hill(6, .4), two_hills(3)});
  const std::string input = write_off(folder, "all.off", all.soup);
  const Flattened f(folder, input, {"--boundary", "rectangle"}, {}, false);
  BOOST_TEST(f.verdict.pieces == 3u);
  const std::vector<double> sums = angle_sums(f.layout);
  for(std::size_t i = 0; i < all.parts.size(); ++i)
  {
    run_on_mixture(folder, "alone", all.parts[i], {"--boundary", "rectangle", "--quiet"});
    const std::vector<double> alone = angle_sums(checking::read_surface(folder / "alone.obj"));
    for(std::size_t v = 0; v < alone.size(); ++v)
      BOOST_TEST(std::abs(sums[all.vertices[i][v]] - alone[v]) < testing::many_residuals);
  }
  // corners that are given make one of them a rectangle
  const auto corners = [&](std::size_t i)
  {
    std::string list;
    for(std::size_t v : {0, 6, 48, 42})
      list += (list.empty() ? "rectangle=" : ",") + std::to_string(all.vertices[i][v]);
    return list;
  };
  const Flattened one(folder, input, {"--boundary", corners(1)}, {}, false);
  BOOST_TEST(std::abs(angle_sums(one.layout)[all.vertices[1][48]] - CGAL_PI / 2) < testing::many_residuals);

  const auto refused = [&](const testing::Soup& soup, const std::string& reason)
  {
    const std::string bad = write_off(folder, "bad.off", testing::together({testing::hill(3, .4), soup}));
    check_refused({bad, "-o", folder / "p.obj", "--boundary", "rectangle"}, 1, reason);
  };
  refused(testing::icosphere(0), "the component of face 18, with 20 triangles: a rectangle needs a border, the mesh is closed");
  refused(single_triangles(1)[0], "the component of face 18, with 1 triangle: a rectangle needs at least 4 border vertices, there are 3");
  refused(testing::annulus(2, 8), "the component of face 18, with 32 triangles: no corners for a rectangle are found");
  testing::Soup twice = testing::hill(3, .4); // two vertices in one place
  twice.points[5] = twice.points[6];
  refused(twice, "the component of face 18, with 18 triangles: no corners for a rectangle are found: the mesh has edges of length zero; edge 22-21");
  BOOST_TEST(! fs::exists(folder / "p.obj"));
}

BOOST_AUTO_TEST_CASE(two_components)
{
  const Folder folder;
  const testing::Soup hill = testing::hill(8, .5), sphere = testing::icosphere(2);
  const std::string input = write_off(folder, "two.off", testing::together({hill, sphere}, true));
  const std::size_t first = 1 + hill.points.size() + 1; // of the sphere
  std::string cones;
  checking::Cones expected;
  for(std::size_t i = 0; i < 12; ++i)
  {
    cones += std::to_string(first + i) + " 300\n";
    expected[first + i] = degrees(300);
  }
  const Flattened f(folder, input, {"--cones", folder.write("cones.txt", cones)}, expected);
  BOOST_TEST(f.verdict.pieces == 2u); // whose boxes do not overlap: that is part of the verdict
  BOOST_TEST(contains(f.out, "surface                 2 components, 1 border, genus 0\n"));
  BOOST_TEST(contains(f.out, "isolated vertices       2, carried through\n"));
  BOOST_TEST(contains(f.out, "cones                   12\n"));

  const Flattened g(folder, input, {"--cones", folder / "cones.txt", "--frame", "unit-square"}, expected);
  for(const auto& t : g.layout.texture)
    BOOST_TEST((t[0] >= 0 && t[0] <= 1 && t[1] >= 0 && t[1] <= 1));

  // the sphere alone lacks cones
  check_refused({input, "-o", folder / "p.obj"}, 1, "needs cones, whose curvatures (360 - angle) sum up to 720 degrees");
  BOOST_TEST(! fs::exists(folder / "p.obj"));
}

BOOST_AUTO_TEST_CASE(elephant, * testing::needs_mesh("elephant.off"))
{
  // 16 cones of 450 degrees, each as far as possible from those before, where at least six
  // triangles share the angle
  const Folder folder;
  const std::string input = testing::mesh_path("elephant.off");
  const checking::Surface s = checking::read_surface(input);
  std::vector<std::size_t> degree(s.points.size(), 0);
  for(const auto& f : s.faces)
    for(std::size_t v : f)
      ++degree[v];
  std::vector<double> distance(s.points.size(), HUGE_VAL);
  checking::Cones expected;
  std::string cones;
  std::size_t c = 0;
  while(degree[c] < 6)
    ++c;
  while(expected.size() < 16)
  {
    expected[c] = degrees(450);
    cones += std::to_string(c) + " 450\n";
    for(std::size_t v = 0; v < s.points.size(); ++v)
      distance[v] = (std::min)(distance[v], degree[v] < 6 ? 0. : testing::distance<double>(s.points[v], s.points[c]));
    c = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
  }
  const Flattened f(folder, input, {"--cones", folder.write("cones.txt", cones)}, expected);
  BOOST_TEST(contains(f.out, "surface                 1 component, 0 borders, genus 3\n"));
}

BOOST_AUTO_TEST_CASE(knot, * testing::needs_mesh("knot1.off"))
{
  const Folder folder;
  const Flattened f(folder, testing::mesh_path("knot1.off"));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  check_lattice(f.layout, f.report);
#endif
}

// ------------------------------------------------------------------------------------------------
// Cones that place themselves
// ------------------------------------------------------------------------------------------------

namespace {

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
double largest_u(const nlohmann::json& report) { return (std::max)(-report["u_min"].get<double>(), report["u_max"].get<double>()); }

// Runs the program twice: what the first run finds is checked in the second.
Flattened with_placed_cones(const Folder& folder, const std::string& input, const std::vector<std::string>& options)
{
  const Run r = run(with({input, "--report", folder / "first.json"}, options));
  BOOST_TEST_REQUIRE(r.status == 0, r.err);
  checking::Cones expected;
  const nlohmann::json first = json(folder / "first.json");
  for(const nlohmann::json& cone : first["cones"])
    expected[cone["vertex"].get<std::size_t>()] = degrees(cone["angle_degrees"].get<double>());
  return Flattened(folder, input, options, expected);
}

// The largest factor by which a triangle is scaled, or its inverse, relative to the whole area.
double area_distortion(const checking::Surface& s)
{
  std::vector<double> before, after;
  for(std::size_t f = 0; f < s.faces.size(); ++f)
  {
    const auto &a = s.points[s.faces[f][0]], &b = s.points[s.faces[f][1]], &c = s.points[s.faces[f][2]];
    const double l = testing::distance<double>(a, b), m = testing::distance<double>(b, c), n = testing::distance<double>(c, a), p = (l + m + n) / 2;
    before.push_back(std::sqrt(p * (p - l) * (p - m) * (p - n)));
    const auto q = corner(s, f, 0), r = corner(s, f, 1), t = corner(s, f, 2);
    after.push_back(((r[0] - q[0]) * (t[1] - q[1]) - (r[1] - q[1]) * (t[0] - q[0])) / 2);
  }
  const auto sum = [](const std::vector<double>& x) { return std::accumulate(x.begin(), x.end(), 0.); };
  double largest = 1;
  for(std::size_t f = 0; f < before.size(); ++f)
  {
    const double a = after[f] / before[f] * sum(before) / sum(after);
    largest = (std::max)({largest, a, 1 / a});
  }
  return largest;
}
#endif

} // namespace

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
BOOST_AUTO_TEST_CASE(cones_place_themselves)
{
  const Folder folder;
  const std::string input = write_off(folder, "hills.off", two_hills(9));
  const Flattened plain(folder, input);
  BOOST_TEST(plain.report["flattened_cones"].empty());
  BOOST_TEST(plain.report["seamless"].is_null());

  double before = largest_u(plain.report);
  for(const int n : {1, 2, 4})
  {
    const Flattened f = with_placed_cones(folder, input, {"--cones", "auto=" + std::to_string(n)});
    BOOST_REQUIRE(int(f.report["cones"].size()) == n);
    BOOST_TEST(contains(f.out, "cones                   " + std::to_string(n) + " free\n"));
    for(const nlohmann::json& cone : f.report["cones"])
    {
      BOOST_TEST(cone["prescribed"] == false);
      BOOST_TEST(! cone.contains("angle_before_degrees"));
      BOOST_TEST(! cone.contains("lattice"));
    }
    BOOST_TEST(largest_u(f.report) < before);
    before = largest_u(f.report);
    BOOST_TEST(f.report["seconds"]["place"].get<double>() > 0);
  }

  // until a bound is met
  const double bound = largest_u(plain.report) / 2;
  const Flattened f = with_placed_cones(folder, input, {"--cones", "auto", "--max-scale", number(bound)});
  BOOST_TEST(largest_u(f.report) <= bound);
  BOOST_TEST(f.report["cones"].size() >= 1u);
  const double area_bound = std::sqrt(area_distortion(plain.layout));
  const Flattened g = with_placed_cones(folder, input, {"--cones", "auto", "--max-area", number(area_bound)});
  BOOST_TEST(area_distortion(g.layout) <= area_bound * (1 + testing::many_residuals));
  BOOST_TEST(area_distortion(g.layout) > 1);
  const Flattened h = with_placed_cones(folder, input, {"--cones", "auto", "--max-rms", "0.05", "--cone-measure", "rms"});
  BOOST_TEST(h.report["cones"].size() >= 1u);
  fs::remove(folder.path / "first.json");

  const std::set<std::string> files = folder.files();
  for(const std::vector<std::string>& options : std::vector<std::vector<std::string> >{{"--max-scale", "1e-6"}, {"--max-area", "1.000001"}})
    check_refused(with({input, "-o", folder / "p.obj", "--cones", "auto=2"}, options), 1, "the bound on the distortion was not met: ");
  check_refused({input, "-o", folder / "p.obj", "--cones", "auto=2", "--cone-measure", "mean"}, 2,
                "--cone-measure takes max, rms or area, not 'mean'");
  check_refused({input, "-o", folder / "p.obj", "--cones", "auto=1000"}, 1, "not enough vertices for the cones");
  const std::string sphere = write_off(folder, "sphere.off", testing::icosphere(1));
  check_refused({sphere, "-o", folder / "p.obj", "--cones", "auto=2"}, 1, "a sphere needs three cones, at least");
  const std::string two = write_off(folder, "two.off", testing::together({testing::hill(4, .5), testing::icosphere(1)}));
  check_refused({two, "-o", folder / "p.obj", "--cones", "auto=2"}, 1,
                "the component of face 32, with 80 triangles: a condition is missing");
  check_refused({two, "-o", folder / "p.obj", "--cones", "auto=60"}, 1,
                "the component of face 0, with 32 triangles: there are not enough vertices for the cones: 9");
  check_refused({two, "-o", folder / "p.obj", "--cones", "auto=3", "--max-scale", "1e-6"}, 1,
                "the component of face 0, with 32 triangles: the bound on the distortion was not met");
  fs::remove(sphere);
  fs::remove(two);
  BOOST_TEST(folder.files() == files, boost::test_tools::per_element());
}

// On each component as if it were alone; fewer where there are not as many vertices inside.
BOOST_AUTO_TEST_CASE(cones_on_several_components)
{
  const Folder folder;
  const Mixture all({two_hills(7), testing::icosphere(2), single_triangles(1)[0], testing::cone(6, .5), testing::torus(12, 8), two_hills(7)});
  const std::string input = write_off(folder, "all.off", all.soup);
  const double bound = .05;
  for(const std::vector<std::string>& options : { std::vector<std::string>{"--cones", "auto=4"}, {"--cones", "auto", "--max-scale", number(bound)},
                                                  {"--cones", "auto=4", "--quantize", "60"} })
  {
    const bool has_bound = options.size() == 4 && options[2] == "--max-scale", is_rounded = options.size() == 4 && ! has_bound;
    const Flattened f = with_placed_cones(folder, input, options);
    for(std::size_t i = 0; i < all.parts.size(); ++i)
    {
      BOOST_TEST_INFO_SCOPE("component " << i);
      const std::size_t n = f.report["component_figures"][i]["cones"].get<std::size_t>();
      if(i == 2)
      {
        BOOST_TEST(n == 0u);
        continue;
      }
      std::vector<std::string> its_options = options;
      if(i == 3 && ! has_bound)
        its_options[1] = "auto=1"; // as many as it has vertices inside
      const Run r = run(with({write_off(folder, "alone.off", all.parts[i]), "--report", folder / "alone.json"}, its_options));
      BOOST_TEST_REQUIRE(r.status == 0, r.err);
      const nlohmann::json alone = json(folder / "alone.json");
      BOOST_TEST(alone["cones"].size() == n);
      for(const nlohmann::json& cone : alone["cones"])
        BOOST_TEST(std::any_of(f.report["cones"].begin(), f.report["cones"].end(), [&](const nlohmann::json& other)
        {
          return other["vertex"] == all.vertices[i][cone["vertex"].get<std::size_t>()]
              && std::abs(other["angle_degrees"].get<double>() - cone["angle_degrees"].get<double>()) < 2 * testing::summed_residuals_in_degrees;
        }));
      if(has_bound)
        BOOST_TEST(largest_u(f.report["component_figures"][i]) <= bound);
      else if(! is_rounded)
        BOOST_TEST(n == (i == 3 ? 1u : 4u));
    }
  }
}

// One component after another takes no longer than it would alone: the time for a thousand is that of a thousand.
BOOST_AUTO_TEST_CASE(cones_on_many_components)
{
  const Folder folder;
  std::vector<testing::Soup> parts = single_triangles(900);
  parts.insert(parts.end(), 100, testing::hill(4, .5));
  const Flattened f = with_placed_cones(folder, write_off(folder, "all.off", Mixture(parts).soup), {"--cones", "auto=1"});
  BOOST_TEST(f.report["cones"].size() == 100u);
  BOOST_TEST(f.report["component_figures"].size() == 1000u);
}

BOOST_AUTO_TEST_CASE(cones_are_rounded)
{
  const Folder folder;
  const std::string input = write_off(folder, "sphere.off", bumpy_sphere(3));
  for(const std::string quantum : {"--quantize", "--quantize=60"})
  {
    const double step = quantum == "--quantize" ? 90 : 60;
    const Flattened f = with_placed_cones(folder, input, {"--cones", "auto=8", quantum});
    double curvature = 0;
    for(const nlohmann::json& cone : f.report["cones"])
    {
      const double angle = cone["angle_degrees"].get<double>(), before = cone["angle_before_degrees"].get<double>();
      curvature += 360 - angle;
      BOOST_TEST(std::abs(angle / step - std::round(angle / step)) < 360 * testing::few_roundings);
      BOOST_TEST(std::abs(angle - before) < 2 * step);
      BOOST_TEST(angle != before);
      BOOST_TEST(angle != 360);
      BOOST_TEST(cone["prescribed"] == true);
    }
    BOOST_TEST(std::abs(curvature - 720) < 8 * 360 * testing::few_roundings);
    BOOST_TEST(f.report["cones"].size() + f.report["flattened_cones"].size() == 8u);
  }

  // gentle hills have cones of nearly 360 degrees
  const std::string hills = write_off(folder, "hills.off", testing::scaled(two_hills(6), 1, 1, .3));
  const Flattened f = with_placed_cones(folder, hills, {"--cones", "auto=2", "--quantize", "180"});
  BOOST_TEST(f.report["cones"].empty());
  BOOST_TEST(f.report["flattened_cones"].size() == 2u);
  BOOST_TEST(contains(f.out, "cones made flat         2\n"));
}
#endif

// ------------------------------------------------------------------------------------------------
// Bad input
// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(bad_cone_files)
{
  const Folder folder;
  testing::Soup soup = testing::hill(4, .5); // 25 vertices, of which 12 is in the middle
  soup.points.push_back({{7, 7, 7}});        // 25 has no face
  const std::string input = write_off(folder, "grid.off", soup);
  const auto check = [&](const std::string& text, const std::string& reason)
    { check_refused({input, "-o", folder / "o.obj", "--cones", folder.write("c.txt", text)}, 1, reason); };
  check("# cones\n12 free\n7 90\n12 90\n", "c.txt: line 4: vertex 12 is listed twice, first in line 2");
  check("12\n12\n", "c.txt: line 2: vertex 12 is listed twice, first in line 1");
  check("12 300\n26 90\n", "c.txt: line 2: there is no vertex 26; the mesh has 26 vertices");
  check("-1 90\n", "line 1: there is no vertex -1");
  check("99999999999999999999 90\n", "line 1: expected an integer");
  check("1.5 90\n", "line 1: expected an integer, found '1.5'");
  check("free 12\n", "line 1: expected an integer, found 'free'");
  check("\n3 90\n", "c.txt: line 2: vertex 3 is on the border");
  check("25 90\n", "line 1: vertex 25 has no face");
  check("12 0\n", "line 1: vertex 12: the angle 0 is not positive");
  check("12 -90\n", "line 1: vertex 12: the angle -90 is not positive");
  check("12 nan\n", "line 1: vertex 12: the angle nan is not a finite number");
  check("12 inf\n", "line 1: vertex 12: the angle inf is not a finite number");
  check("12 1e999\n", "line 1: vertex 12: the angle inf is not a finite number");
  check("12 ninety\n", "line 1: vertex 12: expected an angle in degrees or 'free', found 'ninety'");
  check("12 90deg\n", "line 1: vertex 12: expected an angle in degrees or 'free', found '90deg'");
  check("12 Free\n", "found 'Free'");
  check("12 90 free\n", "line 1: vertex 12: expected nothing after '90', found 'free'");
  check("12 free 90\n", "line 1: vertex 12: expected nothing after 'free', found '90'");
  check("12 1e300\n", "vertex 12"); // the library: out of range
  check_refused({input, "--cones", folder / "missing.txt"}, 1, "missing.txt: cannot be opened");
  check_refused({input, "--cones", folder.path.string()}, 1, "is a directory");
  BOOST_TEST((folder.files() == std::set<std::string>{"grid.off", "c.txt"}));

  // Gauss-Bonnet: the cones of a sphere have 720 degrees of curvature; or nothing is left for the free ones
  const std::string sphere = write_off(folder, "sphere.off", testing::icosphere(2));
  const auto check_sphere = [&](const std::string& text, const std::string& reason)
    { check_refused({sphere, "-o", folder / "o.obj", "--cones", folder.write("c.txt", text)}, 1, reason); };
  check_sphere("0 180\n1 180\n2 180\n", "sum up to 180 degrees too much: on a component without fixed u they have to fit the Gauss-Bonnet");
  check_sphere("0 90\n1 120\n2 60\n", "the prescribed angles sum up to 90 degrees too little");
  check_sphere("# none\n", "needs cones");
  check_sphere("0 free\n1 free\n", "leave none for the vertices of fixed scale: 0 degrees; vertices 0, 1 (a sphere needs three cones, at least)");
  check_sphere("0 2.0944\n1 2.0944\n2 2.0944\n", "c.txt: all angles are below 7, as if they were in radians; they have to be in degrees");
  check_sphere("0 1000\n1 free\n2 free\n", "vertex 0"); // more than five triangles can have
  BOOST_TEST((folder.files() == std::set<std::string>{"grid.off", "sphere.off", "c.txt"}));

  // a file with a name of its own
  const fs::path before = fs::current_path();
  folder.write("auto", "12 300\n");
  fs::current_path(folder.path);
  BOOST_TEST(run({input, "--cones", "./auto"}).status == 0);
  fs::current_path(before);
}
