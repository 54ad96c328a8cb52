// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The program flatten_mesh in the plane: borders, flips, more digits, repairs, and what it says of wrong usage.

#define BOOST_TEST_MODULE test_flatten_mesh
#include "include/boost_test.h"
#include "include/check_flattening.h"
#include "include/program_runs.h"
#include "include/solids.h"
#include "include/test_meshes.h"

#include <CGAL/Conformal_equivalence/version.h>
#include <CGAL/Simple_cartesian.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace fs = std::filesystem;
using namespace program;

BOOST_AUTO_TEST_CASE(natural_border_and_all_outputs)
{
  const Folder folder;
  const Soup soup = bumpy_grid(15);
  const std::string input = folder.write("grid.off", as_off(soup));
  std::vector<std::string> arguments = {input, "-o", folder / "o.obj", "--svg", folder / "o.svg", "--html", folder / "o.html"};
  std::set<std::string> expected = {"grid.off", "o.obj", "o.mtl", "o.checker.png", "o.svg", "o.html"};
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  arguments.insert(arguments.end(), {"--report", folder / "o.json"});
  expected.insert("o.json");
#endif
  const Run r = run(arguments);
  BOOST_TEST_CONTEXT(r.err)
  BOOST_REQUIRE(r.status == 0);
  BOOST_TEST(r.err.empty());
  BOOST_TEST(contains(r.out, "flipped triangles       0 (exact)"));
  BOOST_TEST(folder.files() == expected, boost::test_tools::per_element());
  BOOST_TEST(judge(input, folder / "o.obj").is_good());

  const std::string obj = content(folder / "o.obj");
  BOOST_TEST(obj.substr(0, 13) == "mtllib o.mtl\n");
  BOOST_TEST(contains(content(folder / "o.mtl"), "o.checker.png"));
  BOOST_TEST(content(folder / "o.checker.png").substr(1, 3) == "PNG");
  BOOST_TEST(contains(content(folder / "o.svg"), "</svg>"));
  BOOST_TEST(contains(content(folder / "o.html"), "</html>"));
  BOOST_TEST(! contains(content(folder / "o.html"), "src="));

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  const nlohmann::json report = json(folder / "o.json");
  BOOST_TEST(report["program"] == "flatten_mesh");
  BOOST_TEST(report["version"] == CGAL_CONFORMAL_EQUIVALENCE_VERSION);
  BOOST_TEST(report["input"] == input);
  BOOST_TEST(report["options"]["output"] == folder / "o.obj");
  BOOST_TEST(report["options"].size() == 4u);
  BOOST_TEST(report["status"] == "OK");
  BOOST_TEST(report["vertices"] == soup.points.size());
  BOOST_TEST(report["faces"] == soup.triangles.size());
  BOOST_TEST(report["genus"] == 0);
  BOOST_TEST(report["borders"] == 1);
  BOOST_TEST(report["components"] == 1);
  BOOST_TEST(report["retriangulation"]["mode"] == "when-needed");
  BOOST_TEST(report["refinement"].is_null());
  BOOST_TEST(report["residual"].get<double>() <= testing::solver_tolerance);
  BOOST_TEST(report["tolerance"].get<double>() == testing::solver_tolerance);
  BOOST_TEST(report["flipped_triangles"] == 0);
  BOOST_TEST(report["injective"] == "yes");
  BOOST_TEST(report["quasi_conformal"]["mean"].get<double>() >= 1);
  BOOST_TEST(report["quasi_conformal"]["max"].get<double>() >= report["quasi_conformal"]["mean"].get<double>());
  BOOST_TEST(report["u_min"].get<double>() <= 0); // 0 at the border
  BOOST_TEST(report["u_max"].get<double>() >= 0);
  BOOST_TEST(report["cones"].empty());
  BOOST_TEST(report["seed"].is_null());
  for(const char* name : {"newton_steps", "pcg_iterations", "factorizations", "residual_floor", "layout_length_error", "peak_memory_bytes"})
    BOOST_TEST(report[name].is_number());
  for(const char* name : {"import", "solve", "cut", "layout", "verify", "write"})
    BOOST_TEST(report["seconds"][name].is_number());
#endif
}

// Each by itself, as if it were alone; one that fails keeps none from being flattened.
BOOST_AUTO_TEST_CASE(several_inputs)
{
  const Folder folder;
  const std::string grid = folder.write("grid.off", as_off(bumpy_grid(5))), bad = folder.write("bad.off", "OFF\n"),
                    other = folder.write("other.off", as_off(bumpy_grid(4)));
  BOOST_TEST(run({grid, "-o", folder / "alone.obj"}).status == 0);
  std::vector<std::string> arguments = {grid, bad, other, "-o", folder / "%_100%%.obj", "--boundary", "natural"};
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  arguments.insert(arguments.end(), {"--report", folder / "all.json"});
#endif
  const Run r = run(arguments);
  BOOST_TEST(r.status == 1);
  BOOST_TEST(std::count(r.err.begin(), r.err.end(), '\n') == 1);
  BOOST_TEST(contains(r.err, bad + ": "));
  BOOST_TEST(contains(r.out, "36 vertices, 50 triangles"));
  BOOST_TEST(contains(r.out, "25 vertices, 32 triangles"));
  const std::string among_others = content(folder / "grid_100%.obj"), alone = content(folder / "alone.obj");
  BOOST_TEST(among_others.substr(among_others.find('\n')) == alone.substr(alone.find('\n'))); // but for the name of the material
  BOOST_TEST(! fs::exists(folder / "bad_100%.obj"));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  const nlohmann::json reports = json(folder / "all.json");
  BOOST_TEST_REQUIRE(reports.size() == 3u);
  BOOST_TEST(reports[0]["input"] == grid);
  BOOST_TEST(reports[1]["status"] == "FAILED");
  BOOST_TEST(contains(r.err, reports[1]["message"].get<std::string>()));
  BOOST_TEST(reports[2]["vertices"] == 25);
  BOOST_TEST(reports[2]["options"]["boundary"] == "natural");
#endif
  check_refused({grid, grid, "-o", folder / "%.obj"}, 2, "two outputs have the same name");
  check_refused({grid, other, "--svg", folder / "%.off"}, 2, "would overwrite the input");
  BOOST_TEST(run({grid, other, "--quiet"}).status == 0);
}

BOOST_AUTO_TEST_CASE(quiet_help_version)
{
  const Folder folder;
  const std::string input = folder.write("grid.off", as_off(bumpy_grid(4)));
  const Run quiet = run({input, "--quiet"});
  BOOST_TEST(quiet.status == 0);
  BOOST_TEST(quiet.out.empty());
  BOOST_TEST(quiet.err.empty());
  BOOST_TEST(run({input}).out.size() > 100u);
  BOOST_TEST(contains(run({"--help"}).out, "--boundary"));
  BOOST_TEST(contains(run({"--version"}).out, CGAL_CONFORMAL_EQUIVALENCE_VERSION));
  BOOST_TEST(folder.files().size() == 1u);
}

BOOST_AUTO_TEST_CASE(projective_weights)
{
  const Folder folder;
  const std::string input = folder.write("grid.off", as_off(bumpy_grid(12)));
  BOOST_TEST(run({input, "-o", folder / "o.obj", "--projective"}).status == 0);
  const checking::Surface output = checking::read_surface(folder / "o.obj");
  BOOST_TEST(output.has_weights);
  BOOST_TEST(judge(input, folder / "o.obj").is_good()); // the weights, too
  double largest = 0;
  for(const auto& t : output.texture)
    largest = (std::max)(largest, t[2]);
  BOOST_TEST(largest == 1);
}

BOOST_AUTO_TEST_CASE(prescribed_scale_and_angles)
{
  const Folder folder;
  const std::size_t n = 10;
  const std::string input = folder.write("grid.off", as_off(bumpy_grid(n)));

  const std::string scale = folder.write("u.txt", "# u at two border vertices\n0 0.3\n\n5 -0.2 # here\n");
  BOOST_TEST(run({input, "-o", folder / "u.obj", "--projective", "--boundary", "scale=" + scale}).status == 0);
  BOOST_TEST(judge(input, folder / "u.obj", false).is_good());
  BOOST_TEST(! judge(input, folder / "u.obj", true).is_good());
  const checking::Surface with_u = checking::read_surface(folder / "u.obj");
  const auto weight = [&](std::size_t v) { return with_u.texture[v][2]; }; // one texture vertex for each vertex
  BOOST_TEST(std::log(weight(1) / weight(0)) == 0.3, boost::test_tools::tolerance(testing::few_residuals));
  BOOST_TEST(std::log(weight(1) / weight(5)) == -0.2, boost::test_tools::tolerance(testing::few_residuals));
  BOOST_TEST(weight(1) == weight(n));

  // the angle sum at the middle of the lower side
  const std::string angles = folder.write("angles.txt", "5 150\n");
  BOOST_TEST(run({input, "-o", folder / "a.obj", "--boundary", "angles=" + angles, "--boundary",
                  "scale=" + folder.write("v.txt", "4 .1\n")}).status == 0);
  BOOST_TEST(judge(input, folder / "a.obj", false).is_good());
  const checking::Surface with_angle = checking::read_surface(folder / "a.obj");
  const auto& p = with_angle.texture;
  const double turn = std::atan2(p[4][1] - p[5][1], p[4][0] - p[5][0]) - std::atan2(p[6][1] - p[5][1], p[6][0] - p[5][0]);
  BOOST_TEST(std::remainder(turn - 150 * CGAL_PI / 180, 2 * CGAL_PI) == 0, boost::test_tools::tolerance(testing::summed_residuals));
}

namespace {

// How far the border turns at each vertex from a straight line or from a right angle.
void check_rectangle(const checking::Surface& s, const std::vector<std::size_t>& border)
{
  std::size_t corners = 0;
  for(std::size_t i = 0; i < border.size(); ++i)
  {
    const auto& p = s.texture[border[i]];
    const auto& q = s.texture[border[(i + 1) % border.size()]];
    const auto& r = s.texture[border[(i + 2) % border.size()]];
    const double turn = std::atan2((q[0] - p[0]) * (r[1] - q[1]) - (q[1] - p[1]) * (r[0] - q[0]),
                                   (q[0] - p[0]) * (r[0] - q[0]) + (q[1] - p[1]) * (r[1] - q[1]));
    const bool is_corner = turn > 0.7;
    corners += is_corner;
    BOOST_TEST(std::abs(turn - (is_corner ? CGAL_PI / 2 : 0)) < testing::summed_residuals);
  }
  BOOST_TEST(corners == 4u);
}

std::vector<std::size_t> border_of_grid(std::size_t n)
{
  std::vector<std::size_t> border;
  const auto v = [n](std::size_t i, std::size_t j) { return j * (n + 1) + i; };
  for(std::size_t i = 0; i < n; ++i) border.push_back(v(i, 0));
  for(std::size_t i = 0; i < n; ++i) border.push_back(v(n, i));
  for(std::size_t i = n; i > 0; --i) border.push_back(v(i, n));
  for(std::size_t i = n; i > 0; --i) border.push_back(v(0, i));
  return border;
}

} // namespace

BOOST_AUTO_TEST_CASE(rectangle)
{
  const Folder folder;
  const std::size_t n = 10;
  const std::string input = folder.write("grid.off", as_off(bumpy_grid(n)));
  // The vertices 10 and 110 have one triangle each: they are corners whatever is chosen.
  for(const std::string boundary : {"rectangle", "rectangle=0,10,120,110", "rectangle=10,110,3,117"})
  {
    const Run r = run({input, "-o", folder / "o.obj", "--boundary", boundary});
    BOOST_TEST_CONTEXT(boundary << ": " << r.err)
    {
      BOOST_REQUIRE(r.status == 0);
      BOOST_TEST(judge(input, folder / "o.obj", false).is_good());
      check_rectangle(checking::read_surface(folder / "o.obj"), border_of_grid(n));
    }
  }
  BOOST_TEST(run({input, "-o", folder / "o.obj", "--boundary", "rectangle", "--frame", "unit-square"}).status == 0);
  for(const auto& t : checking::read_surface(folder / "o.obj").texture)
    for(std::size_t k = 0; k < 2; ++k)
      BOOST_TEST((t[k] >= 0 && t[k] <= 1));
  check_refused({input, "--boundary", "rectangle=0,10,120,500"}, 1, "there is no vertex 500");
  check_refused({input, "--boundary", "rectangle=0,10,120,60"}, 1, "vertex 60 is not on the border");
  const std::string triangle = folder.write("triangle.off", off("0 0 0\n1 0 0\n0 1 0\n", "3 0 1 2\n"));
  check_refused({triangle, "--boundary", "rectangle"}, 1, "needs at least 4 border vertices, there are 3");
  BOOST_TEST(run({triangle, "-o", folder / "triangle.obj"}).status == 0);
  BOOST_TEST(judge(triangle, folder / "triangle.obj").is_good());
}

BOOST_AUTO_TEST_CASE(isolated_vertices_are_carried_through)
{
  const Folder folder;
  const std::string input = folder.write("a.off",
    off("7 7 7\n0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n8 8 8\n.5 .5 .7\n", "3 1 2 6\n3 2 3 6\n3 3 4 6\n3 4 1 6\n"));
  const Run r = run({input, "-o", folder / "o.obj"});
  BOOST_TEST(r.status == 0);
  BOOST_TEST(contains(r.out, "isolated vertices       2, carried through"));
  BOOST_TEST(judge(input, folder / "o.obj").is_good());
  BOOST_TEST(contains(content(folder / "o.obj"), "v 8 8 8\n"));
  BOOST_TEST(checking::read_surface(folder / "o.obj").texture.size() == 5u);
}

BOOST_AUTO_TEST_CASE(lion_head, * testing::needs_mesh("lion-head.off"))
{
  const Folder folder;
  const std::string input = testing::mesh_path("lion-head.off");
  BOOST_TEST(run({input, "-o", folder / "o.obj", "--projective"}).status == 0);
  BOOST_TEST(judge(input, folder / "o.obj").is_good());
}

// The tip over one corner of the border of a pentagon: obtuse triangles there, that only flips across the border can help.
BOOST_AUTO_TEST_CASE(retriangulation)
{
  const Folder folder;
  Soup soup;
  soup.points.push_back({{.9, 0, .3}});
  for(int i = 0; i < 5; ++i)
    soup.points.push_back({{std::cos(2 * CGAL_PI * i / 5), std::sin(2 * CGAL_PI * i / 5), 0}});
  for(std::uint32_t i = 0; i < 5; ++i)
    soup.triangles.push_back({{0, 1 + i, 1 + (i + 1) % 5}});
  const std::string input = folder.write("tip.off", as_off(soup)), obj = folder / "o.obj", report_file = folder / "o.json";
  folder.write("angles.txt", "1 6\n2 174\n3 120\n4 120\n5 120\n");
  const std::string border = "angles=" + (folder / "angles.txt");

  check_refused({input, "-o", obj, "--boundary", border, "--retriangulate", "never"}, 1, "--retriangulate never; other values flip edges");
  check_refused({input, "-o", obj, "--boundary", border, "--retriangulate", "sometimes"}, 2, "unknown value 'sometimes' of --retriangulate");
  BOOST_TEST(!fs::exists(obj));
  for(const char* mode : { "when-needed", "always" })
  {
    const Run r = run({input, "-o", obj, "--boundary", border, "--retriangulate", mode
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
                      , "--report", report_file
#endif
                      });
    BOOST_TEST_REQUIRE(r.status == 0, r.err);
    BOOST_TEST(contains(r.out, " flips"));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    const nlohmann::json report = json(report_file);
    BOOST_TEST(report["retriangulation"]["mode"] == mode);
    BOOST_TEST(report["retriangulation"]["class"] != "fixed triangulation");
    BOOST_TEST(report["retriangulation"]["flips"].get<int>() > 0);
    BOOST_TEST(report["residual"].get<double>() <= testing::solver_tolerance);
    BOOST_TEST(report["flipped_triangles"] == 0);
    BOOST_TEST(report["refinement"].is_null()); // straight triangles will do
#endif
  }

  // The mesh of the parts, with the vertices of the input first, on which the map is projective.
  for(const char* option : { "--refine", "--projective" })
  {
    const Run r = run({input, "-o", obj, "--boundary", border, option});
    BOOST_TEST_REQUIRE(r.status == 0, r.err);
    BOOST_TEST(contains(r.out, "refined mesh"));
    const checking::Surface refined = checking::read_surface(obj);
    BOOST_TEST(refined.points.size() > soup.points.size());
    BOOST_TEST(refined.faces.size() > soup.triangles.size());
    for(std::size_t v = 0; v < soup.points.size(); ++v)
      BOOST_TEST((refined.points[v] == soup.points[v]));
    for(const auto& corner : refined.corners)
    {
      std::array<CGAL::Simple_cartesian<double>::Point_2, 3> p;
      for(std::size_t k = 0; k < 3; ++k)
      {
        const auto& t = refined.texture[corner[k]];
        p[k] = { t[0] / t[2], t[1] / t[2] };
      }
      BOOST_TEST(CGAL::area(p[0], p[1], p[2]) > 0);
    }
    const bool is_weighted = std::any_of(refined.texture.begin(), refined.texture.end(), [](const auto& t) { return t[2] != 1; });
    BOOST_TEST(is_weighted == (option == std::string("--projective")));
  }
}

// Lengths and coordinates with many digits, from the file.
BOOST_AUTO_TEST_CASE(many_digits)
{
  typedef boost::multiprecision::cpp_bin_float_100 Real;
  const Folder folder;
  const Soup soup = bumpy_grid(6);
  const std::string input = folder.write("bumpy.off", as_off(soup)), obj = folder / "o.obj", report_file = folder / "o.json";
  for(const int bits : { 53, 200 })
  {
    const Run r = run({input, "-o", obj, "--retriangulate", "never", "--precision", std::to_string(bits)
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
                      , "--report", report_file
#endif
                      });
    BOOST_TEST_REQUIRE(r.status == 0, r.err);
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    const nlohmann::json report = json(report_file);
    BOOST_TEST(report["precision_bits"] == bits);
    BOOST_TEST(report["residual"].get<double>() <= (bits == 53 ? testing::solver_tolerance : testing::rounding_of_200_bits));
    BOOST_TEST(report["residual"].get<double>() > 0);
    BOOST_TEST(report["triangles_lost_in_double"] == 0);
#endif

    // the border keeps its lengths
    std::vector<std::array<Real, 2> > texture;
    std::map<std::pair<std::size_t, std::size_t>, std::pair<std::size_t, std::size_t> > sides; // by vertices: places in `texture`
    std::istringstream in(content(obj));
    for(std::string line; std::getline(in, line); )
    {
      std::istringstream words(line);
      std::string kind;
      words >> kind;
      if(kind == "vt")
      {
        std::string x, y;
        words >> x >> y;
        BOOST_TEST((x.size() > 45) == (bits == 200));
        texture.push_back({{Real(x), Real(y)}});
      }
      if(kind == "f")
      {
        std::array<std::size_t, 3> v, t;
        char slash;
        for(std::size_t k = 0; k < 3; ++k)
          words >> v[k] >> slash >> t[k];
        for(std::size_t k = 0; k < 3; ++k)
          sides[{v[k] - 1, v[(k + 1) % 3] - 1}] = {t[k] - 1, t[(k + 1) % 3] - 1};
      }
    }
    Real worst = 0;
    std::size_t number_of_sides = 0;
    for(const auto& side : sides)
    {
      const std::size_t i = side.first.first, j = side.first.second;
      if(sides.count({j, i}) != 0)
        continue;
      ++number_of_sides;
      Real in_space = 0, in_plane = 0;
      for(std::size_t k = 0; k < 3; ++k)
        in_space += (Real(soup.points[i][k]) - soup.points[j][k]) * (Real(soup.points[i][k]) - soup.points[j][k]);
      const auto &p = texture[side.second.first], &q = texture[side.second.second];
      for(std::size_t k = 0; k < 2; ++k)
        in_plane += (p[k] - q[k]) * (p[k] - q[k]);
      worst = (std::max)(worst, Real(abs(Real(in_plane / in_space - 1))));
    }
    BOOST_TEST(number_of_sides == 24u);
    BOOST_TEST(worst <= (bits == 53 ? 100 * testing::unit_roundoff : testing::rounding_of_200_bits));
    BOOST_TEST(worst > (bits == 53 ? 1e-18 : 1e-75)); // of what rounding leaves
  }

  // A tube with one end closed: triangles at its ends differ by a factor of e^150.
  testing::Soup rod = testing::tube(300, 8, false, [](testing::Index i, testing::Index j)
  {
    const double x = 2 * testing::pi * (j + .25 * (i % 2)) / 8;
    return testing::Point{{std::cos(x), std::sin(x), .5 * i}};
  });
  rod.points.push_back({{0, 0, -.5}});
  for(testing::Index j = 0; j < 8; ++j)
    rod.triangles.push_back({{testing::Index(rod.points.size() - 1), j, (j + 1) % 8}});
  const std::string long_input = write_off(folder, "rod.off", rod);
  check_refused({long_input, "--precision", "100"}, 1, "not injective");
  const Run r = run({long_input, "--precision", "400"});
  BOOST_TEST_REQUIRE(r.status == 0, r.err);
  BOOST_TEST(contains(r.out, "triangles too small"));
  BOOST_TEST(contains(r.out, "undecided")); // for double
}

// A planar sheet with a point on an edge of one of its triangles, and a triangle of no area beyond: it comes out as itself.
BOOST_AUTO_TEST_CASE(faces_of_no_area)
{
  const Folder folder;
  testing::Soup sheet = testing::flat_grid(4);
  const std::size_t number = testing::divide_at_middles(sheet, 11, false);
  const Run r = run({write_off(folder, "sheet.off", sheet), "-o", folder / "o.obj", "--report", folder / "r.json"});
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST_REQUIRE(r.status == 0, r.err);
  const nlohmann::json report = json(folder / "r.json");
  BOOST_TEST(report["retriangulation"]["resolving_flips"] == number);
  BOOST_TEST(report["retriangulation"]["flips"] == number);
  BOOST_TEST(contains(r.out, "to resolve faces of no area"));
  for(const char* u : {"u_min", "u_max"}) // right up to the rounding of the lengths
    BOOST_TEST(std::abs(report[u].get<double>()) <= testing::few_roundings);
#else
  BOOST_TEST(r.status == 2);
  BOOST_TEST(number > 0u);
#endif
}

// Instead of flips on the way: edges of a copy of the mesh are flipped or split, and the copy is written.
BOOST_AUTO_TEST_CASE(local_repair, * testing::needs_mesh("blob.off"))
{
  const Folder folder;
  const std::string input = testing::mesh_path("blob.off"), obj = folder / "o.obj", report_file = folder / "o.json";
  const Run r = run({input, "-o", obj, "--local-repair"
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
                    , "--report", report_file
#endif
                    });
  BOOST_TEST_REQUIRE(r.status == 0, r.err);
  BOOST_TEST(contains(r.out, "repaired mesh"));
  const checking::Surface given = checking::read_surface(input), repaired = checking::read_surface(obj);
  BOOST_TEST_REQUIRE(repaired.points.size() > given.points.size());
  for(std::size_t v = 0; v < given.points.size(); ++v)
    BOOST_TEST((repaired.points[v] == given.points[v]));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  const nlohmann::json report = json(report_file);
  BOOST_TEST(report["retriangulation"]["mode"] == "local repair");
  BOOST_TEST(report["local_repair"]["vertices"] == repaired.points.size());
  BOOST_TEST(report["local_repair"]["splits"] == repaired.points.size() - given.points.size());
  BOOST_TEST(report["flipped_triangles"] == 0);
  BOOST_TEST(report["refinement"].is_null());
#endif
  check_refused({input, "--local-repair", "--retriangulate", "always"}, 2, "exclude each other");
  check_refused({input, "--local-repair", "--precision", "200"}, 2, "--local-repair");
}

BOOST_AUTO_TEST_CASE(mollification)
{
  const Folder folder;
  const std::string input = folder.write("coincident.off", off("0 0 0\n1 0 0\n1 0 0\n0 1 0\n", "3 0 1 3\n3 1 2 3\n")),
                    obj = folder / "o.obj";
  check_refused({input, "-o", obj}, 1, "edges of length zero; edge 1-2");
  check_refused({input, "-o", obj, "--mollify", "0"}, 1, "edges of length zero; edge 1-2");
  for(const char* bad : { "-1", "nan", "2", "little", "" })
    check_refused({input, "-o", obj, "--mollify", bad}, 2, "--mollify takes");
  const Run r = run({input, "-o", obj, "--mollify", "1e-3"});
  BOOST_TEST_REQUIRE(r.status == 0, r.err);
  // two sides of the second triangle become longer than the third by the slack
  const checking::Surface s = checking::read_surface(obj);
  const auto distance = [&](std::size_t i, std::size_t j)
  {
    const auto &p = s.texture[s.corners[1][i]], &q = s.texture[s.corners[1][j]];
    return std::hypot(p[0] - q[0], p[1] - q[1]);
  };
  const double a = distance(0, 1), b = distance(1, 2), c = distance(2, 0);
  BOOST_TEST(a > 0);
  BOOST_TEST(a >= 1e-3 * .5);
  BOOST_TEST((a + b > c && a + c > b));
}

// ------------------------------------------------------------------------------------------------
// Bad input: a message of its own, nothing left behind
// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(wrong_usage)
{
  check_refused({}, 2, "no INPUT is given");
  check_refused({"a.off", "b.off", "-o", "o.obj"}, 2, "-o needs a %");
  check_refused({"a.off", ""}, 2, "no INPUT is given");
  check_refused({"--print", "tcsh"}, 2, "unknown value 'tcsh' of --print");
  check_refused({"a.off", "--format", "step"}, 2, "unknown value 'step' of --format");
  check_refused({"a.off", "--frobnicate"}, 2, "--frobnicate");
  check_refused({"a.off", "--repor", "x"}, 2, "--repor");
  check_refused({"a.off", "-o"}, 2, "--output");
  check_refused({"a.off", "-o", ""}, 2, "--output");
  check_refused({"a.off", "--boundary", "square"}, 2, "unknown value 'square' of --boundary");
  check_refused({"a.off", "--boundary", "natural=3"}, 2, "natural=3");
  check_refused({"a.off", "--boundary", "rectangle=1,2,3"}, 2, "four different vertices");
  check_refused({"a.off", "--boundary", "rectangle=1,2,3,3"}, 2, "four different vertices");
  check_refused({"a.off", "--boundary", "rectangle=1,2,3,-4"}, 2, "four different vertices");
  check_refused({"a.off", "--boundary", "angles"}, 2, "angles=FILE");
  check_refused({"a.off", "--boundary", "rectangle", "--boundary", "scale=f"}, 2, "exclude each other");
  check_refused({"a.off", "--boundary", "scale=e", "--boundary", "scale=f"}, 2, "twice");
  check_refused({"a.off", "--tolerance", "zero"}, 2, "--tolerance");
  check_refused({"a.off", "--tolerance", "0"}, 2, "--tolerance");
  check_refused({"a.off", "--tolerance", "nan"}, 2, "--tolerance");
  check_refused({"a.off", "--max-iterations", "-1"}, 2, "--max-iterations");
  check_refused({"a.off", "--threads", "0"}, 2, "--threads");
  check_refused({"a.off", "--solver", "abacus"}, 2, "simplicial");
  for(const char* precision : { "quadruple", "", "1", "-200", "1e2", "16385" })
    check_refused({"a.off", "--precision", precision}, 2, "--precision takes");
  check_refused({"a.off", "--cones", ""}, 2, "--cones needs the name of a file");
  check_refused({"a.off", "--cones", "auto"}, 2, "a file of this name: ./auto");
  check_refused({"a.off", "--cones", "e", "--cones", "f"}, 2, "--cones");
}

BOOST_AUTO_TEST_CASE(bad_condition_files)
{
  const Folder folder;
  const std::string input = folder.write("grid.off", as_off(bumpy_grid(4)));
  const auto check = [&](const char* kind, const std::string& text, const std::string& reason)
    { check_refused({input, "-o", folder / "o.obj", "--boundary", kind + ("=" + folder.write("c.txt", text))}, 1, reason); };
  check("angles", "0 90\nfive 90\n", "c.txt: line 2: expected an integer, found 'five'");
  check("angles", "0\n1 90\n", "line 1: expected a number, found the end of the line");
  check("angles", "0 90 90\n", "line 1: expected only a vertex and a number");
  check("angles", "# border\n25 90\n", "line 2: there is no vertex 25");
  check("angles", "-1 90\n", "there is no vertex -1");
  check("angles", "6 90\n", "vertex 6 is not on the border");
  check("angles", "0 90\n0 80\n", "line 2: vertex 0 has a condition already");
  check("angles", "0 -90\n", "must be positive");
  check("angles", "0 inf\n", "not a finite number");
  check("scale", "0 nan\n", "not a finite number");
  check("angles", "0 1.5707963\n4 3.1415926\n", "c.txt: all angles are below 7, as if they were in radians");
  check("scale", "0 1000\n", "c.txt: line 1: vertex 0: u = 1000 is beyond the range, from -700 to 700");
  check_refused({input, "--boundary", "scale=" + (folder / "missing.txt")}, 1, "missing.txt: cannot be opened");
  const std::string both = folder.write("c.txt", "0 90\n");
  check_refused({input, "--boundary", "scale=" + both, "--boundary", "angles=" + both}, 1, "has a condition already");
  // all border vertices have right angles: far from Gauss-Bonnet
  std::string all;
  for(std::size_t v : border_of_grid(4))
    all += std::to_string(v) + " 90\n";
  check("angles", all, "sum up to 1080 degrees too little: on a component without fixed u they have to fit the Gauss-Bonnet formula");
  BOOST_TEST((folder.files() == std::set<std::string>{"grid.off", "c.txt"}));
}

// What is said, and what may help, where there is no result.
BOOST_AUTO_TEST_CASE(explanations)
{
  const Folder folder;
  const std::string grid = folder.write("grid.off", as_off(bumpy_grid(3)));
  // Sums come first: the corner 3, in one triangle only, has 180 degrees, which is too much without flips, and 90 more than fit.
  std::string angles;
  for(std::size_t v : border_of_grid(3))
    angles += std::to_string(v) + (v == 0 || v == 12 || v == 15 ? " 90\n" : " 180\n");
  for(const char* mode : {"never", "when-needed", "always"})
    check_refused({grid, "--boundary", "angles=" + folder.write("a.txt", angles), "--retriangulate", mode}, 1,
                  "the prescribed angles sum up to 90 degrees too much");
  // an angle out of its range alone
  check_refused({grid, "--boundary", "angles=" + folder.write("a.txt", "3 180\n"), "--retriangulate", "never"}, 1,
                "a prescribed angle is out of range: 180 degrees; vertex 3 (--retriangulate never; other values flip edges)");

  // the edge that is too long: e^(-1.5) at two sides of lengths 1, and sqrt(2)
  const std::string triangle = folder.write("triangle.off", off("0 0 0\n1 0 0\n0 1 0\n", "3 0 1 2\n"));
  check_refused({triangle, "--keep-border", "--boundary", "scale=" + folder.write("u.txt", "0 -3\n")}, 1,
                "the prescribed u give the edge 1-2 the length 1.414214, and the other edges of face 0 only 0.4462603 together");

  // what may help where the iteration does not converge
  check_refused({grid, "--max-iterations", "0"}, 1,
                "(--max-iterations above 0, --retriangulate always, --precision 200 or --mollify 1e-4 may help)");
  check_refused({grid, "--max-iterations", "0", "--retriangulate", "never", "--mollify", "1e-4", "--precision", "100"}, 1,
                "(--retriangulate never; other values flip edges; --max-iterations above 0 or --precision above 100 may help)");
}

// A fan of three triangles whose border cannot keep its lengths: the apex is so far away that, without flips, the angles there sum up to little.
// How far border edges are from their lengths, and cross ratios from those of the mesh, is what the files written show.
BOOST_AUTO_TEST_CASE(what_flips_cost)
{
  const Folder folder;
  const std::string input = folder.write("fan.off", off("0 0 9\n1 0 0\n-.5 .8 0\n-.5 -.8 0\n", "3 0 1 2\n3 0 2 3\n3 0 3 1\n"));
  const std::string scale = folder.write("u.txt", "1 0\n2 4\n3 4\n");
  const std::vector<std::string> arguments = {input, "-o", folder / "o.obj", "--boundary", "scale=" + scale};
  const Run r = run(arguments);
  BOOST_TEST_MESSAGE(r.out << r.err);
  BOOST_TEST_REQUIRE(r.status == 0);
  BOOST_TEST(contains(r.out, "border edges flipped"));
  BOOST_TEST(contains(r.out, "% longer or shorter than u makes them (--keep-border)"));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST(run(with(arguments, {"--report", folder / "o.json"})).status == 0);
  const nlohmann::json report = json(folder / "o.json");
  const checking::Surface s = checking::read_surface(folder / "o.obj"), given = checking::read_surface(input);
  BOOST_REQUIRE(report["refinement"].is_null());
  const auto length = [](const auto& p, const auto& q) { return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]); };
  const double u[] = {0, 0, 4, 4};
  double largest = 0;
  for(std::size_t f = 0; f < 3; ++f) // the border edge is opposite to the apex, the first corner
  {
    const auto& t = given.faces[f];
    const auto p = corner(s, f, 1), q = corner(s, f, 2);
    largest = (std::max)(largest, std::abs(std::hypot(p[0] - q[0], p[1] - q[1])
      / (std::exp((u[t[1]] + u[t[2]]) / 2) * length(given.points[t[1]], given.points[t[2]])) - 1));
  }
  BOOST_TEST(report["retriangulation"]["lost_border_length_error"].get<double>() == largest, boost::test_tools::tolerance(testing::many_residuals));
  BOOST_TEST(report["retriangulation"]["straight_cross_ratio_error"].get<double>() > 0);
#endif
  // without flips there is nothing to tell
  const std::string grid = folder.write("grid.off", as_off(bumpy_grid(4)));
  BOOST_TEST(! contains(run({grid}).out, "cross ratio"));
}

// A triangle without area has no quasi-conformal factor.
BOOST_AUTO_TEST_CASE(triangles_without_area)
{
  const Folder folder;
  const Run r = run({folder.write("flat.off", off("0 0 0\n1 0 0\n2 0 0\n", "3 0 1 2\n"))});
  BOOST_TEST((r.status == 1 || contains(r.out, "none: no triangle of the mesh has an area")));
  BOOST_TEST(! contains(r.out, "mean 1, max 1"));
}

BOOST_AUTO_TEST_CASE(broken_triangles_are_named_and_nothing_is_written)
{
  // Five wide triangles around the vertex 7 have an angle sum of about 5 * 2 asin(0.95 / s) there when the scale
  // of the edges to it is s. It must not exceed 2 pi, so s > 1.6; but the needles 5 and 6, with legs
  // of lengths s and 10 s, are triangles only while 9 s is less than their bases, 9.6 and 9.9.
  const Folder folder;
  const std::string input = folder.write("fan.off",
    off("1 0 0\n-.805 .593 0\n.995 .1 0\n-.805 .593 .05\n.99 .1 .05\n-.8 .58 .1\n4.5 8.5 2.7\n0 0 0\n",
        "3 0 1 7\n3 1 2 7\n3 2 3 7\n3 3 4 7\n3 4 5 7\n3 5 6 7\n3 6 0 7\n"));
  folder.write("o.obj", "what was there before");
  const Run r = run({input, "-o", folder / "o.obj", "--svg", folder / "o.svg", "--retriangulate", "never"});
  BOOST_TEST_MESSAGE(r.err);
  BOOST_TEST(r.status == 1);
  BOOST_TEST(std::count(r.err.begin(), r.err.end(), '\n') == 1);
  BOOST_TEST(contains(r.err, "faces 5, 6"));
  BOOST_TEST((folder.files() == std::set<std::string>{"o.obj", "fan.off"}));
  BOOST_TEST(content(folder / "o.obj") == "what was there before");
}
