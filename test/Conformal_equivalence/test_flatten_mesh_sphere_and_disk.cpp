// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The program flatten_mesh with --target sphere, disk and hyperbolic.

#define BOOST_TEST_MODULE test_flatten_mesh_sphere_and_disk
#include "include/boost_test.h"
#include "include/check_flattening.h"
#include "include/check_image.h"
#include "include/components.h"
#include "include/program_runs.h"
#include "include/test_meshes.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace fs = std::filesystem;
using namespace program;

namespace {

// Spikes: its triangulation needs flips. If they are long, straight triangles will not do.
testing::Soup spiky_sphere(double length)
{
  testing::Soup soup = testing::icosphere(2);
  for(std::size_t i = 0; i < soup.points.size(); i += 2)
    for(double& x : soup.points[i])
      x *= length;
  return soup;
}

// A closed rod, askew.
testing::Soup rod(testing::Index length)
{
  const std::array<testing::Point, 3> axes = {{ {{2 / std::sqrt(5.), -1 / std::sqrt(5.), 0}},
    {{3 / std::sqrt(70.), 6 / std::sqrt(70.), -5 / std::sqrt(70.)}}, {{1 / std::sqrt(14.), 2 / std::sqrt(14.), 3 / std::sqrt(14.)}} }};
  const auto place = [&](double x, double y, double z)
  {
    testing::Point result;
    for(std::size_t k = 0; k < 3; ++k)
      result[k] = x * axes[0][k] + y * axes[1][k] + z * axes[2][k];
    return result;
  };
  testing::Soup soup = testing::tube(length, 6, false, [&](testing::Index i, testing::Index j)
  {
    const double angle = -2 * testing::pi * (j + .5 * (i % 2)) / 6; // so that triangles look outwards
    return place(std::cos(angle), std::sin(angle), i);
  });
  const testing::Index n = testing::Index(soup.points.size());
  soup.points.push_back(place(0, 0, -.5));
  soup.points.push_back(place(0, 0, length + .5));
  for(testing::Index j = 0; j < 6; ++j)
  {
    soup.triangles.push_back({{n, j, (j + 1) % 6}});
    soup.triangles.push_back({{n + 1, n - 6 + (j + 1) % 6, n - 6 + j}});
  }
  return soup;
}

// A hill over 6 rings of triangles: its triangulation needs no flips. The border begins with vertex 91, and has 36 vertices.
Soup hilly_rings()
{
  return program_soup(testing::rings(6, [](double x, double y) { return .4 * std::sin(2 * x + 1) * std::cos(3 * y); }));
}

// Folds: edges of its double are flipped.
Soup steep_grid(std::size_t n)
{
  Soup soup = bumpy_grid(n);
  for(std::size_t i = 0; i < soup.points.size(); ++i)
    soup.points[i][2] = i % 3 == 0 ? .6 : 0;
  return soup;
}

template <typename Verdict>
bool is_good(const Verdict& verdict)
{
  BOOST_TEST_MESSAGE(verdict);
  return verdict.is_good();
}

// Runs the program, which succeeds.
struct Inscribed
{
  checking::Surface input, output;
  std::string out, err;
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  nlohmann::json report;
#endif

  Inscribed(const Folder& folder, const std::string& file, const std::vector<std::string>& options)
  {
    std::vector<std::string> arguments = { file, "-o", folder / "i.obj" };
    arguments.insert(arguments.end(), options.begin(), options.end());
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    arguments.insert(arguments.end(), { "--report", folder / "i.json" });
#endif
    const Run r = run(arguments);
    BOOST_TEST_REQUIRE(r.status == 0, r.err);
    out = r.out;
    err = r.err;
    input = checking::read_surface(file);
    output = checking::read_surface(folder / "i.obj");
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    report = json(folder / "i.json");
#endif
  }
};

// The vertex in the layout of a disk.
std::array<double, 2> place(const checking::Surface& s, std::size_t v)
{
  for(std::size_t f = 0; f < s.faces.size(); ++f)
    for(std::size_t k = 0; k < 3; ++k)
      if(s.faces[f][k] == v)
        return corner(s, f, k);
  return {{ 0, 0 }};
}

double distance(const std::array<double, 2>& p, double x, double y) { return std::hypot(p[0] - x, p[1] - y); }

} // namespace

BOOST_AUTO_TEST_CASE(checker_refuses_other_spheres_and_disks)
{
  const Folder folder;
  const std::string sphere = write_off(folder, "sphere.off", bumpy_sphere(2)), disk = folder.write("hill.off", as_off(hilly_rings()));
  const Inscribed s(folder, sphere, {"--target", "sphere"}), d(folder, disk, {"--target", "disk"});
  BOOST_TEST(is_good(checking::check_sphere(s.input, s.output)));
  BOOST_TEST(is_good(checking::check_disk(d.input, d.output)));

  checking::Surface bad = s.output;
  for(double& x : bad.points[7])
    x *= 1 + 1e-15;
  BOOST_TEST(! is_good(checking::check_sphere(s.input, bad))); // off the sphere
  bad = s.output;
  std::swap(bad.points[0], bad.points[7]);
  BOOST_TEST(! is_good(checking::check_sphere(s.input, bad))); // triangles flipped
  bad = s.output;
  for(auto& p : bad.points)
    p[2] = -p[2];
  BOOST_TEST(! is_good(checking::check_sphere(s.input, bad))); // a mirror image
  bad = s.output;
  bad.points[3] = {{ std::cos(1e-6) * bad.points[3][0] - std::sin(1e-6) * bad.points[3][1],
                     std::sin(1e-6) * bad.points[3][0] + std::cos(1e-6) * bad.points[3][1], bad.points[3][2] }};
  checking::Image_tolerances loose;
  loose.sphere = loose.barycentre = 1e-3;
  BOOST_TEST(! is_good(checking::check_sphere(s.input, bad, loose))); // not conformal
  loose.edges_were_flipped = true;
  BOOST_TEST(is_good(checking::check_sphere(s.input, bad, loose)));
  loose.lost_triangles = 1;
  BOOST_TEST(! is_good(checking::check_sphere(s.input, bad, loose)));
  bad = s.output;
  bad.faces.pop_back();
  BOOST_TEST(! is_good(checking::check_sphere(s.input, bad))); // a hole
  const checking::Surface unmapped = [&] // onto the sphere, but not conformally, and not centred
  {
    checking::Surface result = s.input;
    for(auto& p : result.points)
    {
      const double length = std::hypot(p[0], p[1], p[2]);
      for(double& x : p)
        x /= length;
    }
    return result;
  }();
  checking::Image_tolerances uncentred;
  uncentred.barycentre = 1;
  BOOST_TEST(! is_good(checking::check_sphere(s.input, unmapped, uncentred)));

  bad = d.output;
  for(auto& t : bad.texture)
    t[0] *= 1 + 1e-15;
  BOOST_TEST(! is_good(checking::check_disk(d.input, bad)));
  bad = d.output;
  for(auto& t : bad.texture)
    t[0] = -t[0];
  BOOST_TEST(! is_good(checking::check_disk(d.input, bad)));
}

BOOST_AUTO_TEST_CASE(target_sphere)
{
  const Folder folder;
  const std::string input = write_off(folder, "sphere.off", bumpy_sphere(3));
  std::vector<std::vector<std::string> > all = { {}, {"--vertex-at-infinity", "5"}, {"--retriangulate", "never"}, {"--refine"} };
  std::vector<checking::Surface> spheres;
  for(std::vector<std::string> options : all)
  {
    options.insert(options.end(), {"--target", "sphere", "--svg", folder / "i.svg"});
    const Inscribed s(folder, input, options);
    BOOST_TEST(is_good(checking::check_sphere(s.input, s.output)));
    BOOST_TEST(s.err.empty());
    BOOST_TEST(s.output.faces == s.input.faces);
    BOOST_TEST(s.output.texture.empty());
    BOOST_TEST(contains(s.out, "target                  sphere\n"));
    BOOST_TEST(contains(s.out, "flipped triangles       0 (exact)\n"));
    BOOST_TEST(contains(content(folder / "i.svg"), "</svg>"));
    BOOST_TEST(contains(content(folder / "i.svg"), "id=\"circles\""));
    BOOST_TEST(! fs::exists(folder / "i.mtl")); // no texture
    spheres.push_back(s.output);
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    BOOST_TEST(s.report["status"] == "OK");
    BOOST_TEST(s.report["target"] == "sphere");
    BOOST_TEST(s.report["injective"] == "yes");
    BOOST_TEST(s.report["flipped_triangles"] == 0);
    BOOST_TEST(s.report["flipped_by_rounding"] == 0);
    BOOST_TEST(s.report["retriangulation"]["flips"] == 0);
    BOOST_TEST(s.report["refinement"].is_null());
    BOOST_TEST(std::abs(s.report["solid_angle"].get<double>() - 4 * CGAL_PI) < testing::summed_residuals);
    BOOST_TEST(s.report["barycentre"].get<double>() < testing::solver_tolerance);
    BOOST_TEST(s.report["unit_sphere_error"].get<double>() < 2 * testing::unit_roundoff);
    BOOST_TEST(s.report["cross_ratio_error"].get<double>() < testing::summed_residuals);
    BOOST_TEST(s.report["cross_ratio_error"].get<double>() > 0);
    BOOST_TEST(s.report["layout_length_error"].get<double>() < testing::summed_residuals);
    BOOST_TEST(s.report["quasi_conformal"]["mean"].get<double>() >= 1);
    BOOST_TEST(s.report["quasi_conformal"]["max"].get<double>() < 2);
    BOOST_TEST(s.report["residual"].get<double>() <= testing::solver_tolerance);
#endif
  }
  // The sphere does not depend on the vertex at infinity.
  for(std::size_t v = 0; v < spheres[0].points.size(); ++v)
    for(std::size_t k = 0; k < 3; ++k)
      BOOST_TEST(std::abs(spheres[1].points[v][k] - spheres[0].points[v][k]) < testing::many_residuals);

  // Other weights: the barycentre of the vertices is elsewhere.
  const Inscribed areas(folder, input, {"--target", "sphere", "--moebius-weights", "areas"});
  BOOST_TEST(! is_good(checking::check_sphere(areas.input, areas.output)));
  checking::Image_tolerances uncentred;
  uncentred.barycentre = 1;
  BOOST_TEST(is_good(checking::check_sphere(areas.input, areas.output, uncentred)));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST(areas.report["barycentre"].get<double>() < testing::solver_tolerance); // with these weights
#endif
}

BOOST_AUTO_TEST_CASE(target_sphere_with_flips)
{
  const Folder folder;
  const std::string input = write_off(folder, "spiky.off", spiky_sphere(3));
  check_refused({input, "-o", folder / "i.obj", "--target", "sphere", "--retriangulate", "never"},
                1, "--retriangulate never; other values flip edges");
  BOOST_TEST((folder.files() == std::set<std::string>{"spiky.off"}));
  checking::Image_tolerances tolerances;
  tolerances.edges_were_flipped = true;
  const Inscribed straight(folder, input, {"--target", "sphere"}); // straight triangles will do
  BOOST_TEST(straight.output.faces == straight.input.faces);
  BOOST_TEST(is_good(checking::check_sphere(straight.input, straight.output, tolerances)));
  BOOST_TEST(! is_good(checking::check_sphere(straight.input, straight.output))); // cross ratios are others
  for(const std::string mode : {"when-needed", "always"})
  {
    const Inscribed s(folder, input, {"--target", "sphere", "--refine", "--retriangulate", mode, "--svg", folder / "i.svg"});
    BOOST_TEST(is_good(checking::check_sphere(s.input, s.output, tolerances)));
    BOOST_TEST(s.output.points.size() > s.input.points.size());
    BOOST_TEST(contains(s.out, "refined mesh"));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    BOOST_TEST(s.report["retriangulation"]["mode"] == mode);
    BOOST_TEST(s.report["retriangulation"]["flips"].get<int>() > 0);
    BOOST_TEST(s.report["refinement"]["vertices"] == s.output.points.size());
    BOOST_TEST(s.report["refinement"]["faces"] == s.output.faces.size());
    BOOST_TEST(s.report["cross_ratio_error"].is_null());
    BOOST_TEST(s.report["barycentre"].get<double>() < testing::solver_tolerance);
    BOOST_TEST(s.report["flipped_triangles"] == 0);
    BOOST_TEST(s.report["injective"] == "yes");
#endif
  }
}

// Straight triangles would be flipped: the refined mesh is written.
BOOST_AUTO_TEST_CASE(bent_triangles_on_the_sphere)
{
  const Folder folder;
  const std::string input = write_off(folder, "spiky.off", spiky_sphere(6));
  for(const std::string precision : {"double", "150"})
  {
    const Inscribed s(folder, input, {"--target", "sphere", "--precision", precision, "--require-injective", "--color-by", "qc"});
    BOOST_TEST(is_good(checking::check_sphere(s.input, s.output)));
    BOOST_TEST(s.output.points.size() > s.input.points.size());
  }
}

// The points have as many digits as they were computed with.
BOOST_AUTO_TEST_CASE(target_sphere_with_many_digits)
{
  typedef boost::multiprecision::cpp_bin_float_100 Real;
  const Folder folder;
  const std::string input = write_off(folder, "sphere.off", bumpy_sphere(1));
  const Inscribed s(folder, input, {"--target", "sphere", "--precision", "200"});
  BOOST_TEST(is_good(checking::check_sphere(s.input, s.output)));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST(s.report["precision_bits"] == 200);
  BOOST_TEST(s.report["cross_ratio_error"].get<double>() < 1e-55);
  BOOST_TEST(s.report["unit_sphere_error"].get<double>() < 1e-59);
  BOOST_TEST(s.report["triangles_lost_in_double"] == 0);
#endif
  std::istringstream in(content(folder / "i.obj"));
  std::size_t number_of_points = 0;
  Real worst = 0;
  for(std::string kind, line; in >> kind && std::getline(in, line); )
    if(kind == "v")
    {
      std::istringstream words(line);
      std::string x, y, z;
      words >> x >> y >> z;
      const Real square = Real(x) * Real(x) + Real(y) * Real(y) + Real(z) * Real(z);
      worst = (std::max)(worst, Real(abs(Real(square - 1))));
      ++number_of_points;
    }
  BOOST_TEST(number_of_points == s.input.points.size());
  BOOST_TEST(worst < 1e-59);
  BOOST_TEST(worst > 1e-80); // of what rounding leaves
}

// Near the ends of a rod, points of the sphere are the same in double: that is said, and with more digits it does not happen.
BOOST_AUTO_TEST_CASE(triangles_lost_on_the_sphere)
{
  const Folder folder;
  const std::string input = write_off(folder, "rod.off", rod(80));
  const Inscribed lost(folder, input, {"--target", "sphere"});
  BOOST_TEST(contains(lost.err, "because points were rounded"));
  BOOST_TEST(std::count(lost.err.begin(), lost.err.end(), '\n') == 1);
  BOOST_TEST(contains(lost.out, "injective               no"));
  const checking::Image_verdict verdict = checking::check_sphere(lost.input, lost.output);
  BOOST_TEST(! verdict.is_good());
  checking::Image_tolerances tolerances;
  tolerances.lost_triangles = verdict.not_positive_triangles;
  tolerances.edges_were_flipped = true; // between chords of length 0 there are no cross ratios
  BOOST_TEST(is_good(checking::check_sphere(lost.input, lost.output, tolerances)));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST(lost.report["flipped_by_rounding"] == verdict.not_positive_triangles);
  BOOST_TEST(lost.report["flipped_triangles"].get<std::size_t>() + lost.report["degenerate_triangles"].get<std::size_t>()
             == verdict.not_positive_triangles);
  BOOST_TEST(lost.report["injective"] == "no");
#endif
  BOOST_TEST(run({input, "--target", "sphere", "--quiet"}).err.empty());
  fs::remove(folder / "i.obj");
  check_refused({input, "-o", folder / "i.obj", "--target", "sphere", "--require-injective"}, 1, "because points were rounded");
  BOOST_TEST(! fs::exists(folder / "i.obj"));
  const Run wide = run({input, "-o", folder / "i.obj", "--target", "sphere", "--require-injective", "--precision", "300"});
  BOOST_TEST(wide.status == 0, wide.err);
  BOOST_TEST(contains(wide.out, "triangles too small"));
  BOOST_TEST(contains(wide.out, "injective               yes"));
}

BOOST_AUTO_TEST_CASE(target_disk)
{
  const Folder folder;
  const std::string input = folder.write("hill.off", as_off(hilly_rings()));
  const std::vector<std::vector<std::string> > all = {
    {"--target", "disk"}, {"--boundary", "disk"}, {"--boundary", "disk", "--target", "disk", "--vertex-at-infinity", "100"},
    {"--target", "disk", "--projective"}, {"--target", "disk", "--moebius-weights", "areas"},
    {"--target", "disk", "--disk-centre", "20"}, {"--target", "disk", "--disk-points", "95,99,120"} };
  std::vector<checking::Surface> disks;
  for(std::vector<std::string> options : all)
  {
    options.insert(options.end(), {"--svg", folder / "i.svg", "--html", folder / "i.html"});
    const Inscribed d(folder, input, options);
    BOOST_TEST(is_good(checking::check_disk(d.input, d.output)));
    BOOST_TEST(judge(input, folder / "i.obj", false).is_good());
    BOOST_TEST(d.output.has_weights == (options[2] == "--projective"));
    BOOST_TEST(contains(d.out, "target                  disk\n"));
    BOOST_TEST(contains(content(folder / "i.svg"), "id=\"circles\""));
    BOOST_TEST(contains(content(folder / "i.html"), "</html>"));
    BOOST_TEST(fs::exists(folder / "i.mtl"));
    disks.push_back(d.output);
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    BOOST_TEST(d.report["target"] == "disk");
    BOOST_TEST(d.report["injective"] == "yes");
    BOOST_TEST(d.report["flipped_by_rounding"] == 0);
    BOOST_TEST(d.report["unit_circle_error"].get<double>() < 4 * testing::unit_roundoff);
    BOOST_TEST(d.report["cross_ratio_error"].get<double>() < testing::many_residuals);
    BOOST_TEST(d.report["layout_length_error"].get<double>() < testing::many_residuals);
    BOOST_TEST(! d.report.contains("solid_angle"));
#endif
  }
  double difference = 0, to_areas = 0;
  for(std::size_t v = 0; v < 127; ++v)
  {
    const auto p = place(disks[0], v), q = place(disks[2], v), r = place(disks[4], v);
    BOOST_TEST((p == place(disks[1], v)));
    difference = (std::max)(difference, distance(p, q[0], q[1]));
    to_areas = (std::max)(to_areas, distance(p, r[0], r[1]));
  }
  BOOST_TEST(difference < testing::many_residuals); // another vertex at infinity
  BOOST_TEST(to_areas > 1e-4);
  BOOST_TEST(distance(place(disks[0], 91), 1, 0) < testing::few_roundings); // the first border vertex
  BOOST_TEST(distance(place(disks[5], 20), 0, 0) < 100 * testing::unit_roundoff);
  BOOST_TEST(distance(place(disks[0], 20), 0, 0) > 1e-3);
  BOOST_TEST(distance(place(disks[6], 95), 1, 0) < 100 * testing::unit_roundoff);
  BOOST_TEST(distance(place(disks[6], 99), -.5, std::sqrt(.75)) < 100 * testing::unit_roundoff);
  BOOST_TEST(distance(place(disks[6], 120), -.5, -std::sqrt(.75)) < 100 * testing::unit_roundoff);

  const Inscribed wide(folder, input, {"--target", "disk", "--precision", "200", "--disk-centre", "20"});
  BOOST_TEST(is_good(checking::check_disk(wide.input, wide.output)));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST(wide.report["cross_ratio_error"].get<double>() < 1e-50);
  BOOST_TEST(wide.report["unit_circle_error"].get<double>() < 1e-59);
  BOOST_TEST(wide.report["injective"] == "yes");
#endif
  const std::string obj = content(folder / "i.obj");
  BOOST_TEST(obj.substr(obj.find("vt ") + 3, 100).find(' ') > 45u); // digits

  // a disk without vertices inside
  const std::string triangle = folder.write("triangle.off", off("0 0 0\n1 0 0\n0 1 0\n", "3 0 1 2\n"));
  const Inscribed one(folder, triangle, {"--target", "disk"});
  BOOST_TEST(is_good(checking::check_disk(one.input, one.output)));
}

// What a long strip is refused with tells how many digits it takes, and with these it is mapped; two squares abreast have unknowns, one has none.
BOOST_AUTO_TEST_CASE(target_disk_of_long_strips)
{
  const Folder folder;
  for(const testing::Index width : { 1, 2 })
  {
    const std::string input = write_off(folder, "strip.off", testing::strip(width == 1 ? 1000 : 1200, width));
    const Run refused = run({input, "-o", folder / "i.obj", "--target", "disk"});
    BOOST_TEST(refused.status == 1);
    BOOST_TEST(contains(refused.err, "there is a metric, but its scale factors leave the range of the number type: u ranges over "));
    const std::string option = "--precision ", begin = "(" + option;
    BOOST_REQUIRE(contains(refused.err, begin));
    const int bits = std::stoi(refused.err.substr(refused.err.find(begin) + begin.size()));
    BOOST_TEST((bits > 53 && bits <= 16384));
    if(width == 1)
      BOOST_TEST(run({input, "-o", folder / "i.obj", "--target", "disk", "--precision", std::to_string(bits)}).status == 0);
  }
}

BOOST_AUTO_TEST_CASE(target_disk_with_flips)
{
  const Folder folder;
  const std::string input = folder.write("steep.off", as_off(steep_grid(9)));
  check_refused({input, "-o", folder / "i.obj", "--target", "disk", "--retriangulate", "never"}, 1, "--retriangulate never; other values flip edges");
  for(const std::vector<std::string>& more : { std::vector<std::string>{"--refine"}, {"--projective"}, {"--refine", "--precision", "150"} })
  {
    std::vector<std::string> options = more;
    options.insert(options.end(), {"--target", "disk"});
    const Inscribed d(folder, input, options);
    BOOST_TEST(is_good(checking::check_disk(d.input, d.output)));
    BOOST_TEST(d.output.points.size() > d.input.points.size());
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    BOOST_TEST(d.report["retriangulation"]["flips"].get<int>() > 0);
    BOOST_TEST(d.report["retriangulation"]["doubled"] == true);
    BOOST_TEST(d.report["refinement"]["vertices"] == d.output.points.size());
    BOOST_TEST(d.report["cross_ratio_error"].is_null());
    BOOST_TEST(d.report["flipped_triangles"] == 0);
#endif
  }
}

namespace {

// In rows and columns.
std::array<double, 2> centre(std::size_t component, std::size_t columns)
{
  return {{ 2.25 * double(component % columns), 2.25 * double(component / columns) }};
}

} // namespace

// Each component is mapped as if it were alone, and then moved.
BOOST_AUTO_TEST_CASE(several_spheres)
{
  const Folder folder;
  const Mixture all({bumpy_sphere(2), spiky_sphere(3), bumpy_sphere(2), testing::icosahedron(), testing::scaled(bumpy_sphere(1), 1e-9)});
  const Inscribed s(folder, write_off(folder, "all.off", all.soup), {"--target", "sphere", "--svg", folder / "i.svg"});
  BOOST_TEST(all.has_faces_of(s.output));
  BOOST_TEST(contains(s.out, "side by side            5 spheres\n"));
  BOOST_TEST((s.output.points[0] == std::array<double, 3>{{ 0, 0, 0 }})); // isolated
  for(std::size_t i = 0; i < all.parts.size(); ++i)
  {
    run_on_mixture(folder, "alone", all.parts[i], {"--target", "sphere", "--quiet"});
    const checking::Surface alone = checking::read_surface(folder / "alone.obj"), given = checking::read_surface(folder / "alone.off");
    checking::Surface part = all.part(s.output, i);
    const std::array<double, 2> c = centre(i, 3);
    bool is_same = true;
    for(std::size_t v = 0; v < part.points.size(); ++v)
      for(std::size_t k = 0; k < 3; ++k)
      {
        is_same = is_same && part.points[v][k] == alone.points[v][k] + (k < 2 ? c[k] : 0);
        part.points[v][k] -= k < 2 ? c[k] : 0;
      }
    BOOST_TEST(is_same);
    checking::Image_tolerances tolerances;
    tolerances.edges_were_flipped = i == 1;
    tolerances.sphere = 2e-15; // coordinates of up to 6 were rounded
    BOOST_TEST(is_good(checking::check_sphere(given, part, tolerances)));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    const nlohmann::json& figures = s.report["component_figures"][i];
    BOOST_TEST(figures["face"] == all.faces[i][0]);
    BOOST_TEST(figures["triangles"] == all.faces[i].size());
    BOOST_TEST((figures["centre"].get<std::array<double, 2> >() == c));
    BOOST_TEST((figures["flips"].get<int>() > 0) == (i == 1));
#endif
  }
  const std::string obj = content(folder / "i.obj");
  for(std::size_t i = 0; i < all.parts.size(); ++i)
    BOOST_TEST(contains(obj, "o component_" + std::to_string(i) + "\n"));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST(std::abs(s.report["solid_angle"].get<double>() - 5 * 4 * CGAL_PI) < testing::many_residuals);
  BOOST_TEST(s.report["injective"] == "yes");
  BOOST_TEST(s.report["barycentre"].get<double>() < testing::solver_tolerance);
  BOOST_TEST(s.report["cross_ratio_error"].get<double>() < 1e-8); // of those without flips
#endif
}

// Where straight triangles will not do, that component is refined, and the others are not.
BOOST_AUTO_TEST_CASE(several_refined_spheres)
{
  const Folder folder;
  const Mixture all({spiky_sphere(6), bumpy_sphere(1), spiky_sphere(6)});
  for(const std::string precision : {"double", "120"})
  {
    const Inscribed s(folder, write_off(folder, "all.off", all.soup), {"--target", "sphere", "--precision", precision, "--color-by", "qc"});
    std::vector<checking::Surface> alone;
    for(std::size_t i = 0; i < 2; ++i)
    {
      run_on_mixture(folder, "alone", all.parts[i], {"--target", "sphere", "--precision", precision, "--quiet"});
      alone.push_back(checking::read_surface(folder / "alone.obj"));
    }
    BOOST_REQUIRE(alone[0].points.size() > all.parts[0].points.size());
    BOOST_TEST(alone[1].points.size() == all.parts[1].points.size());
    BOOST_TEST(s.output.points.size() == 1 + 2 * alone[0].points.size() + alone[1].points.size());
    BOOST_TEST(s.output.faces.size() == 2 * alone[0].faces.size() + alone[1].faces.size());
    const std::size_t first = all.soup.points.size(), number = alone[0].points.size() - all.parts[0].points.size();
    bool is_same = true;
    for(std::size_t i = 0; i < 2; ++i) // crossings of the first and the third component
      for(std::size_t v = 0; v < number; ++v)
      {
        const auto &p = s.output.points[first + i * number + v], &q = alone[0].points[all.parts[0].points.size() + v];
        const std::array<double, 2> c = centre(2 * i, 2);
        const double difference = std::abs(p[0] - c[0] - q[0]) + std::abs(p[1] - c[1] - q[1]) + std::abs(p[2] - q[2]);
        is_same = is_same && (precision == "double" ? p == std::array<double, 3>{{ q[0] + c[0], q[1] + c[1], q[2] }}
                                                    : difference < testing::few_roundings);
      }
    BOOST_TEST(is_same);
    std::size_t lost = 0;
    const auto component = [&](std::size_t v)
    {
      for(std::size_t i = 0; i < 3; ++i)
        if(std::binary_search(all.vertices[i].begin(), all.vertices[i].end(), testing::Index(v)))
          return i;
      return v < first + number ? std::size_t(0) : std::size_t(2);
    };
    for(const auto& f : s.output.faces)
    {
      std::array<testing::Point, 3> p;
      for(std::size_t k = 0; k < 3; ++k)
      {
        const std::array<double, 2> c = centre(component(f[k]), 2);
        BOOST_TEST_REQUIRE(component(f[k]) == component(f[0]));
        p[k] = {{ s.output.points[f[k]][0] - c[0], s.output.points[f[k]][1] - c[1], s.output.points[f[k]][2] }};
      }
      const double volume = p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) + p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2])
                          + p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
      lost += ! (volume > -testing::few_roundings);
    }
    BOOST_TEST(lost == 0u);
  }
}

// Objects of the file are kept.
BOOST_AUTO_TEST_CASE(spheres_that_are_objects)
{
  const Folder folder;
  std::ostringstream obj;
  const testing::Soup sphere = testing::icosahedron();
  for(std::size_t i = 0; i < 2; ++i)
  {
    obj << (i == 0 ? "o left\n" : "o right\ng a\n");
    for(const auto& p : sphere.points)
      obj << "v " << point(p) << '\n';
    for(const auto& t : sphere.triangles)
      obj << "f " << 12 * i + t[0] + 1 << ' ' << 12 * i + t[1] + 1 << ' ' << 12 * i + t[2] + 1 << '\n';
  }
  const Run r = run({folder.write("a.obj", obj.str()), "-o", folder / "o.obj", "--target", "sphere"});
  BOOST_TEST_REQUIRE(r.status == 0, r.err);
  BOOST_TEST(contains(content(folder / "o.obj"), "o right\ng a\n"));
  BOOST_TEST(! contains(content(folder / "o.obj"), "component"));
}

BOOST_AUTO_TEST_CASE(several_disks)
{
  const Folder folder;
  const testing::Soup hill = testing::rings(6, [](double x, double y) { return .4 * std::sin(2 * x + 1) * std::cos(3 * y); });
  std::vector<testing::Soup> parts = single_triangles(2);
  parts.insert(parts.end(), {hill, testing::rings(4, [](double x, double y) { return .2 * std::sin(2 * x) * std::cos(y); }), hill}); // without flips
  const Mixture all(parts);
  const std::string input = write_off(folder, "all.off", all.soup),
                    vertex = std::to_string(all.vertices[2][20]), borders = std::to_string(all.vertices[2][95]) + ',' +
                    std::to_string(all.vertices[2][99]) + ',' + std::to_string(all.vertices[2][120]);
  const std::vector<std::vector<std::string> > options = { {}, {"--disk-centre", vertex}, {"--disk-points", borders}, {"--moebius-weights", "areas"},
                                                           {"--projective"}, {"--precision", "100"} };
  const std::vector<std::vector<std::string> > alone_options = { {}, {"--disk-centre", "20"}, {"--disk-points", "95,99,120"},
                                                                 {"--moebius-weights", "areas"}, {"--projective"}, {"--precision", "100"} };
  for(std::size_t o = 0; o < options.size(); ++o)
  {
    const Inscribed d(folder, input, with({"--target", "disk", "--svg", folder / "i.svg", "--html", folder / "i.html"}, options[o]));
    BOOST_TEST(contains(d.out, "side by side            5 disks\n"));
    BOOST_TEST(judge(input, folder / "i.obj", false).is_good());
    for(std::size_t i = 0; i < parts.size(); ++i)
    {
      const bool is_named = options[o].size() == 2 && (o == 1 || o == 2) && i != 2; // a vertex of another component
      run_on_mixture(folder, "alone", parts[i], with({"--target", "disk", "--quiet"}, is_named ? std::vector<std::string>() : alone_options[o]));
      const checking::Surface alone = checking::read_surface(folder / "alone.obj"), part = all.part(d.output, i);
      const std::array<double, 2> c = centre(i, 3);
      double largest = 0;
      for(std::size_t f = 0; f < part.faces.size(); ++f)
        for(std::size_t k = 0; k < 3; ++k)
          for(std::size_t j = 0; j < 2; ++j)
            largest = (std::max)(largest, std::abs(corner(part, f, k)[j] - (corner(alone, f, k)[j] + c[j])));
      BOOST_TEST(largest <= (o < 4 ? 0 : 4e-15)); // with weights, and with more digits, after their rounding
    }
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    BOOST_TEST(d.report["injective"] == "yes");
    BOOST_TEST(d.report["components"] == 5);
    BOOST_TEST(d.report["component_figures"].size() == 5u);
    BOOST_TEST(d.report["unit_circle_error"].get<double>() < (o == 5 ? 1e-28 : 2e-15));
#endif
  }
  check_refused({input, "--target", "disk", "--disk-points", "1,2," + std::to_string(all.vertices[2][95])}, 1, "is not on the component of vertex 1");
  check_refused({input, "--target", "disk", "--disk-centre", "1"}, 1, "vertex 1 is on the border");
  check_refused({input, "--target", "disk", "--vertex-at-infinity", "0"}, 1, "vertex 0 is isolated");
}

BOOST_AUTO_TEST_CASE(several_refined_disks)
{
  const Folder folder;
  const Soup steep = steep_grid(9);
  const Mixture all({{steep.points, steep.triangles}, testing::hill(5, .2), {steep.points, steep.triangles}});
  const std::string input = write_off(folder, "all.off", all.soup);
  for(const std::vector<std::string>& more : { std::vector<std::string>{"--refine"}, {"--projective"}, {"--refine", "--precision", "150"} })
  {
    const Inscribed d(folder, input, with({"--target", "disk"}, more));
    std::size_t points = 1, faces = 0; // one is isolated
    for(const testing::Soup& part : all.parts)
    {
      run_on_mixture(folder, "alone", part, with({"--target", "disk", "--quiet"}, more));
      const checking::Surface alone = checking::read_surface(folder / "alone.obj");
      points += alone.points.size();
      faces += alone.faces.size();
    }
    BOOST_TEST(points > all.soup.points.size());
    BOOST_TEST(d.output.points.size() == points);
    BOOST_TEST(d.output.faces.size() == faces);
  }
}

// A polygon may be divided between vertices that have an edge already, which is then there twice.
BOOST_AUTO_TEST_CASE(disks_with_double_edges)
{
  const Folder folder;
  const std::string points = "0 0 .6\n0 .2 .1\n0 .9 .1\n0 -.8 .2\n", faces = "4 0 1 2 3\n3 0 3 1\n", others = "4 4 5 6 7\n3 4 7 5\n";
  const std::string one = folder.write("one.off", off(points, faces)), two = folder.write("two.off", off(points + points, faces + others));
  BOOST_TEST(run({one, "-o", folder / "o.obj", "--target", "disk"}).status == 0);
  const Run r = run({two, "-o", folder / "o.obj", "--target", "disk"});
  BOOST_TEST(r.status == 0);
  BOOST_TEST(contains(r.out, "side by side            2 disks\n"));
}

BOOST_AUTO_TEST_CASE(a_thousand_disks)
{
  const Folder folder;
  const std::string input = write_off(folder, "all.off", Mixture(single_triangles(1000)).soup);
  const Inscribed d(folder, input, {"--target", "disk"});
  BOOST_TEST(judge(input, folder / "i.obj", false).is_good());
}

// Towards the ends of a long strip scales fall like e^(-pi x): in double the points there are the same. What is said to help does.
BOOST_AUTO_TEST_CASE(long_strips_need_digits)
{
  const testing::Index length = 60;
  testing::Soup strip;
  for(testing::Index x = 0; x <= length; ++x)
    for(const double y : { 0., .5, 1. })
      strip.points.push_back({{double(x), y, 0}});
  for(testing::Index a = 0; a < 3 * length; ++a)
    if(a % 3 != 2)
    {
      strip.triangles.push_back({{a, a + 3, a + 4}});
      strip.triangles.push_back({{a, a + 4, a + 1}});
    }
  const Folder folder;
  const std::string input = write_off(folder, "strip.off", strip);
  const Run in_double = run({input, "-o", folder / "o.obj", "--target", "disk"});
  BOOST_TEST(in_double.status == 1);
  const std::string before = "further than the 53 bits of coordinates: --precision ";
  const std::size_t at = in_double.err.find(before);
  BOOST_REQUIRE(at != std::string::npos);
  const std::string bits = std::to_string(std::stoi(in_double.err.substr(at + before.size())));
  BOOST_TEST(run({input, "-o", folder / "o.obj", "--target", "disk", "--precision", bits}).status == 0);
}

BOOST_AUTO_TEST_CASE(sphere_and_disk_are_refused)
{
  const Folder folder;
  const std::string grid = folder.write("grid.off", as_off(bumpy_grid(4))), obj = folder / "o.obj", // border: 0, 1, ..., 4, 9, ..., 24, ...
                    hill = folder.write("hill.off", as_off(hilly_rings())), sphere = write_off(folder, "sphere.off", bumpy_sphere(1)),
                    torus = write_off(folder, "torus.off", testing::torus(8, 8)), annulus = write_off(folder, "annulus.off", testing::annulus(4, 12));
  std::set<std::string> before = folder.files();
  before.insert("spheres.off");
  const auto refused = [&](const std::string& input, const std::string& target, const std::string& reason)
    { check_refused({input, "-o", obj, "--target", target}, 1, reason); };
  refused(grid, "sphere", "found 1 component, 1 border, genus 0; --target sphere takes closed surfaces");
  refused(torus, "sphere", "found 1 component, 0 borders, genus 1");
  refused(sphere, "disk", "found 1 component, 0 borders, genus 0; --target disk takes surfaces");
  refused(annulus, "disk", "found 1 component, 2 borders, genus 0");

  // in pieces: the one that has no map is named by a face
  const testing::Soup three = testing::together({testing::icosphere(1), testing::torus(8, 8), testing::icosphere(2)});
  const std::string spheres = write_off(folder, "spheres.off", three), wrong = "the surface has the wrong topology: found 1 component, 0 borders, ";
  refused(spheres, "sphere", "the component of face 80, with 128 triangles: " + wrong + "genus 1");
  refused(spheres, "disk", "the component of face 0, with 80 triangles: " + wrong + "genus 0");

  for(const std::string target : {"sphere", "disk"})
    for(const std::string mode : {"never", "when-needed", "always"})
      check_refused({target == "sphere" ? sphere : hill, "-o", obj, "--target", target, "--retriangulate", mode, "--max-iterations", "0"},
                    1, "did not converge");

  // vertices
  const auto of = [&](const std::string& input, const std::string& target, const std::vector<std::string>& options, const std::string& reason)
  {
    std::vector<std::string> arguments = {input, "-o", obj, "--target", target};
    arguments.insert(arguments.end(), options.begin(), options.end());
    check_refused(arguments, 1, reason);
  };
  of(sphere, "sphere", {"--vertex-at-infinity", "42"}, "there is no vertex 42; the mesh has 42 vertices");
  of(grid, "disk", {"--vertex-at-infinity", "6"}, "vertex 6 is not on the border");
  of(grid, "disk", {"--disk-centre", "25"}, "there is no vertex 25");
  of(grid, "disk", {"--disk-centre", "4"}, "vertex 4 is on the border");
  of(grid, "disk", {"--disk-points", "0,4,12"}, "vertex 12 is not on the border");
  of(grid, "disk", {"--disk-points", "0,24,4"}, "the vertices are given clockwise; counterclockwise: 0,4,24");
  BOOST_TEST(folder.files() == before, boost::test_tools::per_element());

  // usage
  const auto excluded = [&](const std::vector<std::string>& options, const std::string& a, const std::string& b)
  {
    std::vector<std::string> arguments = {"a.off"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    check_refused(arguments, 2, a);
    check_refused(arguments, 2, b);
  };
  for(const std::string target : {"sphere", "disk"})
  {
    const std::string name = "--target " + target;
    for(const std::string boundary : {"natural", "rectangle", "rectangle=1,2,3,4", "angles=f", "scale=f"})
      excluded({"--target", target, "--boundary", boundary}, name, "--boundary " + boundary);
    excluded({"--target", target, "--cones", "f"}, name, "--cones");
    excluded({"--target", target, "--frame", "unit-square"}, name, "--frame");
    excluded({"--target", target, "--local-repair"}, name, "--local-repair");
    excluded({"--target", target, "--keep-border"}, name, "--keep-border");
  }
  excluded({"--boundary", "disk", "--cones", "f"}, "--boundary disk", "--cones");
  excluded({"--boundary", "disk", "--target", "plane"}, "--boundary disk", "--target plane");
  excluded({"--boundary", "disk", "--target", "sphere"}, "--boundary disk", "--target sphere");
  check_refused({"a.off", "--boundary", "disk", "--boundary", "natural"}, 2, "exclude each other");
  check_refused({"a.off", "--boundary", "disk=3"}, 2, "unknown value 'disk=3'");
  check_refused({"a.off", "--target", "cube"}, 2, "unknown value 'cube' of --target");
  excluded({"--target", "sphere", "--projective"}, "--target sphere", "--projective");
  excluded({"--target", "sphere", "--flat", "f"}, "--target sphere", "--flat");
  excluded({"--target", "disk", "--disk-centre", "1", "--disk-points", "1,2,3"}, "--disk-centre", "--disk-points");
  excluded({"--target", "disk", "--disk-centre", "1", "--moebius-weights", "areas"}, "--disk-centre", "--moebius-weights");
  excluded({"--target", "disk", "--disk-points", "1,2,3", "--moebius-weights", "areas"}, "--disk-points", "--moebius-weights");
  for(const std::string target : {"plane", "sphere"})
  {
    check_refused({"a.off", "--target", target, "--disk-centre", "1"}, 2, "--disk-centre needs --target disk");
    check_refused({"a.off", "--target", target, "--disk-points", "1,2,3"}, 2, "--disk-points needs --target disk");
  }
  check_refused({"a.off", "--vertex-at-infinity", "1"}, 2, "--vertex-at-infinity needs --target sphere");
  check_refused({"a.off", "--moebius-weights", "areas"}, 2, "--moebius-weights needs --target sphere");
  check_refused({"a.off", "--target", "disk", "--moebius-weights", "masses"}, 2, "unknown value 'masses' of --moebius-weights");
  for(const std::string bad : {"", "-1", "1,2", "x", "1.5"})
  {
    check_refused({"a.off", "--target", "disk", "--vertex-at-infinity", bad}, 2, "--vertex-at-infinity takes the index of a vertex");
    check_refused({"a.off", "--target", "disk", "--disk-centre", bad}, 2, "--disk-centre takes the index of a vertex");
    check_refused({"a.off", "--target", "disk", "--disk-points", bad}, 2, "--disk-points takes the indices of three different vertices");
  }
  check_refused({"a.off", "--target", "disk", "--disk-points", "1,2,2"}, 2, "three different vertices");
}

// The corners of a closed surface of genus 2 in the disk, its picture, and its group.
BOOST_AUTO_TEST_CASE(target_hyperbolic, * testing::needs_mesh("eight.off"))
{
  const Folder folder;
  const std::string mesh = testing::mesh_path("eight.off"), obj = folder / "eight.obj", svg = folder / "eight.svg", html = folder / "eight.html";
  std::vector<std::string> arguments = {mesh, "--target", "hyperbolic", "-o", obj, "--svg", svg, "--html", html};
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  const std::string report = folder / "eight.json";
  arguments.insert(arguments.end(), {"--report", report});
#endif
  const Run done = run(arguments);
  BOOST_TEST_REQUIRE(done.status == 0);
  BOOST_TEST(contains(done.out, "genus 2"));
  BOOST_TEST(contains(content(svg), "<circle"));
  BOOST_TEST(contains(content(html), "</html>"));

  std::istringstream lines(content(obj));
  std::size_t corners = 0;
  for(std::string line; std::getline(lines, line); )
  {
    std::istringstream words(line);
    std::string kind;
    double x = 1, y = 1;
    if(!(words >> kind) || kind != "vt")
      continue;
    ++corners;
    BOOST_TEST(bool(words >> x >> y));
    BOOST_TEST(std::hypot(x, y) < 1);
  }
  BOOST_TEST(corners > 315u); // those of vertices on seams have several places

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  const nlohmann::json figures = nlohmann::json::parse(content(report));
  BOOST_TEST(figures["genus"] == 2);
  BOOST_TEST(std::abs(figures["area"].get<double>() - 4 * testing::pi) < testing::solver_tolerance);
  BOOST_TEST(figures["relation_error"].get<double>() < 1e-20);
  BOOST_TEST(figures["generators"].size() == 4u);
  BOOST_TEST(figures["exact"]["canonical_generators"].size() == 4u);
#endif

  const std::set<std::string> before = folder.files();
  const std::string ball = write_off(folder, "ball.off", testing::icosahedron()), other = folder / "other.svg";
  check_refused({ball, "--target", "hyperbolic", "--svg", other}, 1, "has no hyperbolic metric without cones");
  std::set<std::string> after = folder.files();
  after.erase("ball.off");
  BOOST_TEST(after == before, boost::test_tools::per_element());
  check_refused({"a.off", "--target", "hyperbolic", "--frame", "unit-square"}, 2, "--frame");
  check_refused({"a.off", "--target", "hyperbolic", "--cones", "auto=3"}, 2, "--cones FILE");
  check_refused({"a.off", "--target", "hyperbolic", "--boundary", "rectangle"}, 2, "--boundary rectangle");
}

// The double of a hyperbolic triangle, as an icosahedron with three cones.
BOOST_AUTO_TEST_CASE(target_hyperbolic_with_cones)
{
  const Folder folder;
  const std::string ball = write_off(folder, "ball.off", testing::icosahedron()), obj = folder / "ball.obj", svg = folder / "ball.svg",
                    cones = folder.write("cones.txt", "0 180\n3 120\n9 50\n"), flat = folder.write("flat.txt", "0 180\n3 120\n9 90\n");
  const Run done = run({ball, "--target", "hyperbolic", "--cones", cones, "-o", obj, "--svg", svg});
  BOOST_TEST_REQUIRE(done.status == 0);
  BOOST_TEST(contains(done.out, "genus 0"));
  BOOST_TEST(contains(done.out, "none: the surface has cones or borders"));
  BOOST_TEST(contains(content(svg), "<circle"));
  BOOST_TEST(contains(content(obj), "vt "));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  const std::string report = folder / "ball.json";
  BOOST_TEST_REQUIRE(run({ball, "--target", "hyperbolic", "--cones", cones, "--precision", "200", "--report", report}).status == 0);
  const std::string json = content(report), name = "\"residual\": ";
  BOOST_TEST(contains(json, "\"precision_bits\": 200"));
  BOOST_TEST(std::stod(json.substr(json.find(name) + name.size())) < 1e-45); // 2^-160
#endif
  check_refused({ball, "--target", "hyperbolic", "--cones", flat, "--svg", svg}, 1, "smaller by more than 30 degrees");
}
