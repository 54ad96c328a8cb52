// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The program flatten_mesh with --seamless.

#define BOOST_TEST_MODULE test_flatten_mesh_seamless
#include "include/boost_test.h"
#include "include/check_flattening.h"
#include "include/check_seams.h"
#include "include/components.h"
#include "include/layout_files.h"
#include "include/program_runs.h"
#include "include/test_meshes.h"

#include "../../examples/Conformal_equivalence/include/flatten_mesh/texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

using namespace program;

namespace {

bool is_good(const checking::Seam_verdict& verdict)
{
  BOOST_TEST_MESSAGE(verdict);
  return verdict.is_good();
}

// How many of the vertices that --refine adds to `number_given` others have several places: those where a seam edge is divided into parts.
std::size_t number_of_crossings_on_seams(const checking::Surface& s, std::size_t number_given)
{
  std::vector<std::set<std::size_t> > places(s.points.size());
  for(std::size_t f = 0; f < s.faces.size(); ++f)
    for(std::size_t k = 0; k < 3; ++k)
      places[s.faces[f][k]].insert(s.corners[f][k]);
  return static_cast<std::size_t>(std::count_if(places.begin() + std::ptrdiff_t(number_given), places.end(),
                                                [](const std::set<std::size_t>& p) { return p.size() > 1; }));
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
// The motions of the report, by path, are those of the layout; the cones lie where the report says. Edges are counted of the mesh given, which has
// `number_given` vertices.
void check_report_of_seams(const checking::Seam_checker& checker, const checking::Surface& s, std::size_t number_given, const nlohmann::json& report)
{
  const nlohmann::json& seamless = report["seamless"];
  BOOST_TEST(seamless["symmetry"] == checker.verdict().symmetry);
  BOOST_TEST(seamless["seams"].size() == checker.verdict().paths);
  std::size_t edges = 0;
  for(const nlohmann::json& path : seamless["seams"])
  {
    edges += path["edges"].get<std::size_t>();
    const auto t = path["translation"].get<std::array<double, 2> >();
    const std::array<double, 3> motion = {{ path["rotation"].get<double>(), t[0], t[1] }};
    const auto motions = checker.motions_from(path["from"].get<std::size_t>());
    BOOST_TEST((std::find(motions.begin(), motions.end(), motion) != motions.end()), path.dump());
    BOOST_TEST(! checker.motions_from(path["to"].get<std::size_t>()).empty());
  }
  BOOST_TEST(edges == checker.verdict().seam_edges - number_of_crossings_on_seams(s, number_given));
  BOOST_TEST(edges == report["seam_edges"].get<std::size_t>());

  BOOST_TEST(report["cones"].size() == checker.verdict().cones);
  for(const nlohmann::json& cone : report["cones"])
  {
    const auto p = cone["lattice"].get<std::array<double, 2> >();
    bool is_there = false;
    for(std::size_t f = 0; f < s.faces.size(); ++f)
      for(std::size_t k = 0; k < 3; ++k)
        is_there = is_there || (s.faces[f][k] == cone["vertex"].get<std::size_t>()
                                && s.texture[s.corners[f][k]][0] == p[0] && s.texture[s.corners[f][k]][1] == p[1]);
    BOOST_TEST(is_there);
  }
  // in coordinates of either lattice a tile has area 1
  BOOST_TEST(std::abs(seamless["tiles"].get<double>() / area(s) - 1) < testing::many_residuals);
  BOOST_TEST(seamless["distortion"]["mean"].get<double>() >= 1);
  BOOST_TEST(seamless["distortion"]["max"].get<double>() >= seamless["distortion"]["mean"].get<double>());
  BOOST_TEST(seamless["quasi_conformal_mean"]["before"].get<double>() >= 1);
  BOOST_TEST(seamless["closest"].is_boolean());
  BOOST_TEST(seamless["wound_vertices"] == 0);
  BOOST_TEST((report["components"] == 1 ? seamless["scale"].get<double>() > 0 : seamless["scale"].is_null()));
  BOOST_TEST(report["flipped_triangles"] == 0);
}
#endif

// Runs the program, which succeeds; the seams of what it writes are exact.
struct Seamless
{
  checking::Surface layout;
  checking::Seam_verdict verdict;
  std::string svg;
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  nlohmann::json report;
#endif

  Seamless(const Folder& folder, const std::string& input, const std::vector<std::string>& options, int symmetry = 4)
  {
    std::vector<std::string> arguments = { input, "-o", folder / "o.obj", "--svg", folder / "o.svg", "--html", folder / "o.html", "--seamless" };
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    arguments.insert(arguments.end(), { "--report", folder / "o.json" });
#endif
    const Run r = run(with(arguments, options));
    BOOST_TEST_REQUIRE(r.status == 0, r.err);
    BOOST_TEST_MESSAGE(r.out);
    layout = checking::read_surface(folder / "o.obj");
    svg = content(folder / "o.svg");
    const checking::Surface given = checking::read_surface(input);
    const bool is_refined = layout.points.size() > given.points.size();
    BOOST_TEST((! is_refined || std::count(options.begin(), options.end(), "--refine") == 1));
    const checking::Seam_checker checker(is_refined ? layout : given, layout, symmetry);
    verdict = checker.verdict();
    BOOST_TEST(verdict.is_good(), verdict);
    BOOST_TEST(contains(svg, "id=\"tiles\""));
    BOOST_TEST(contains(content(folder / "o.html"), "</html>"));
    BOOST_TEST(contains(r.out, "tiles                   "));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    report = json(folder / "o.json");
    check_report_of_seams(checker, layout, given.points.size(), report);
    BOOST_TEST(report["refinement"].is_null() == ! is_refined);
#endif
  }
};

} // namespace

// Two cones of pi on a disk: nothing has to be deformed, the layout is still conformally equivalent.
BOOST_AUTO_TEST_CASE(seamless_disk_with_two_cones)
{
  const Folder folder;
  const std::string input = write_off(folder, "hills.off", two_hills(9));
  const std::vector<std::size_t> vertices = { in_ring(4, 0), in_ring(4, 12) };
  const std::string cones = folder.write("cones.txt", cone_lines(vertices, "180"));
  const checking::Cones expected = { {vertices[0], degrees(180)}, {vertices[1], degrees(180)} };
  for(const std::string quantum : {"--quantize=180", "--quantize=90"})
  {
    const int n = quantum == "--quantize=180" ? 2 : 4;
    const Seamless f(folder, input, {"--cones", cones, quantum, "--tiles", "60"}, n);
    BOOST_TEST(f.verdict.cones == 2u);
    BOOST_TEST(judge(input, folder / "o.obj", true, expected).is_good());
    BOOST_TEST(contains(content(folder / "o.mtl"), "map_Kd o.checker.png\n"));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    BOOST_TEST(f.report["seamless"]["tiles"].get<double>() > 30);
    BOOST_TEST(f.report["seamless"]["tiles"].get<double>() < 120);
    BOOST_TEST(f.report["seamless"]["distortion"]["max"].get<double>() < 1 + 1e-6);
#endif
  }

  // one bit of one place: every one on the seam counts, no other
  const checking::Surface given = checking::read_surface(input), layout = checking::read_surface(folder / "o.obj");
  std::vector<std::set<std::size_t> > places(given.points.size());
  std::vector<std::size_t> vertex_of(layout.texture.size());
  for(std::size_t f = 0; f < layout.faces.size(); ++f)
    for(std::size_t k = 0; k < 3; ++k)
    {
      places[layout.faces[f][k]].insert(layout.corners[f][k]);
      vertex_of[layout.corners[f][k]] = layout.faces[f][k];
    }
  std::size_t on_seam = 0;
  for(std::size_t t = 0; t < layout.texture.size(); ++t)
  {
    const bool is_on_seam = places[vertex_of[t]].size() > 1 || expected.count(vertex_of[t]) == 1;
    checking::Surface changed = layout;
    changed.texture[t][t % 2] = std::nextafter(changed.texture[t][t % 2], HUGE_VAL);
    const checking::Seam_verdict verdict = checking::check_seams(given, changed, 4);
    BOOST_TEST((verdict.edges_without_motion > 0) == is_on_seam);
    BOOST_TEST(verdict.is_good() == ! is_on_seam);
    on_seam += is_on_seam;
  }
  BOOST_TEST(on_seam > 8u);
  BOOST_TEST(on_seam < layout.texture.size());
}

BOOST_AUTO_TEST_CASE(seamless_disk_without_cones)
{
  const Folder folder;
  const std::string input = write_off(folder, "hills.off", two_hills(5));
  const Seamless f(folder, input, {"--tiles", "12"});
  BOOST_TEST(f.verdict.seam_edges == 0u);
  BOOST_TEST(judge(input, folder / "o.obj").is_good());
  BOOST_TEST(std::abs(area(f.layout) - 12) < 6);
}

namespace {

// The layout of each component is the one that it has alone, moved by a point of the lattice. Returns how many places were rounded again. `options`
// begin with those for cones, which single triangles do not get.
std::size_t check_moves(const Folder& folder, const Mixture& all, const checking::Surface& layout, const std::vector<std::string>& options)
{
  std::size_t rounded = 0;
  for(std::size_t i = 0; i < all.parts.size(); ++i)
  {
    std::vector<std::string> its_options = options;
    if(all.parts[i].triangles.size() == 1)
      its_options.erase(its_options.begin(), its_options.begin() + 2);
    run_on_mixture(folder, "alone", all.parts[i], with(its_options, {"--seamless", "--quiet"}));
    const checking::Surface alone = checking::read_surface(folder / "alone.obj"), part = all.part(layout, i);
    const auto p = corner(part, 0, 0), q = corner(alone, 0, 0);
    const std::array<double, 2> by = {{ std::round(p[0] - q[0]), std::round(p[1] - q[1]) }};
    double largest = 0;
    for(std::size_t f = 0; f < part.faces.size(); ++f)
      for(std::size_t k = 0; k < 3; ++k)
        for(std::size_t j = 0; j < 2; ++j)
        {
          const double difference = corner(part, f, k)[j] - (corner(alone, f, k)[j] + by[j]);
          rounded += difference != 0;
          largest = (std::max)(largest, std::abs(difference));
        }
    BOOST_TEST(largest < testing::few_residuals);
  }
  return rounded;
}

} // namespace

BOOST_AUTO_TEST_CASE(several_seamless_surfaces)
{
  const Folder folder;
  const Mixture all({two_hills(7), bumpy_sphere(2), single_triangles(1)[0], two_hills(7), testing::icosphere(2)});
  const std::string input = write_off(folder, "all.off", all.soup);
  const std::vector<std::string> options = {"--cones", "auto=4", "--tiles", "60"};
  const Seamless f(folder, input, options); // which are exact
  BOOST_TEST(check_moves(folder, all, f.layout, options) == 0u);
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  double tiles = 0;
  for(std::size_t i = 0; i < all.parts.size(); ++i)
  {
    const nlohmann::json& figures = f.report["component_figures"][i];
    BOOST_TEST(figures["face"] == all.faces[i][0]);
    BOOST_TEST((figures["cones"].get<std::size_t>() > 0) == (i != 2));
    tiles += figures["seamless"]["tiles"].get<double>();
    BOOST_TEST(figures["seamless"]["scale"].get<double>() > 0);
  }
  BOOST_TEST(std::abs(f.report["seamless"]["tiles"].get<double>() - tiles) < testing::many_residuals);
  BOOST_TEST(f.report["seamless"]["scale"].is_null());
#endif

  // in coordinates of the lattice hexagons are exact, too
  const std::vector<std::string> hexagons = {"--cones", "auto=4", "--tiles", "60", "--quantize", "60", "--lattice-coordinates"};
  std::vector<std::string> arguments = {input, "-o", folder / "h.obj", "--seamless", "--svg", folder / "h.svg"};
  Run r = run(with(arguments, hexagons));
  BOOST_TEST_REQUIRE(r.status == 0, r.err);
  const checking::Surface given = checking::read_surface(input), layout = checking::read_surface(folder / "h.obj");
  BOOST_TEST(is_good(checking::check_seams(given, layout, 6)));
  BOOST_TEST(check_moves(folder, all, layout, hexagons) < layout.faces.size()); // only places on seams were rounded, if any
  r = run({input, "-o", folder / "h.obj", "--seamless", "--cones", "auto=4", "--quantize", "60"});
  BOOST_TEST_REQUIRE(r.status == 0, r.err);

  // cones of a file
  std::vector<std::size_t> vertices;
  for(std::size_t i : {1, 4})
    for(std::size_t v : {0, 2, 5, 9})
      vertices.push_back(all.vertices[i][v]);
  const std::string cones = folder.write("cones.txt", cone_lines(vertices, "180"));
  BOOST_TEST(Seamless(folder, input, {"--cones", cones, "--quantize", "180", "--tiles", "100"}, 2).verdict.cones == 8u);
}

// Those far out have fewer digits left: places on seams are rounded again, and seams are exact all the same.
BOOST_AUTO_TEST_CASE(many_seamless_surfaces)
{
  const Folder folder;
  std::vector<testing::Soup> parts;
  for(std::size_t i = 0; i < 90; ++i)
    parts.push_back(i % 3 == 0 ? testing::scaled(testing::icosphere(1), 1, 1, 1 + .01 * double(i)) : two_hills(3));
  const Mixture all(parts);
  const std::string input = write_off(folder, "all.off", all.soup);
  const checking::Surface given = checking::read_surface(input);
  for(const std::string quantum : {"90", "60"})
  {
    const std::vector<std::string> options = {"--cones", "auto=3", "--tiles", "5000", "--quantize", quantum, "--lattice-coordinates"};
    const Run r = run(with({input, "-o", folder / "o.obj", "--seamless", "--quiet"}, options));
    BOOST_TEST_REQUIRE(r.status == 0, r.err);
    const checking::Surface layout = checking::read_surface(folder / "o.obj");
    BOOST_TEST(is_good(checking::check_seams(given, layout, quantum == "90" ? 4 : 6)));
    BOOST_TEST(check_moves(folder, all, layout, options) > 0u);
  }
}

BOOST_AUTO_TEST_CASE(seamless_spheres)
{
  const Folder folder;
  const std::string input = write_off(folder, "sphere.off", bumpy_sphere(3));
  // a pillow: four cones of pi
  const std::string pillow = folder.write("pillow.txt", cone_lines({0, 2, 5, 9}, "180"));
  BOOST_TEST(Seamless(folder, input, {"--cones", pillow, "--quantize", "180", "--tiles", "300"}, 2).verdict.cones == 4u);
  // eight cones of a cube, which place themselves
  const Seamless cube(folder, input, {"--cones", "auto=8", "--tiles", "400"});
  BOOST_TEST(cube.verdict.cones >= 3u);
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  for(const nlohmann::json& cone : cube.report["cones"])
    BOOST_TEST(std::abs(cone["angle_before_degrees"].get<double>() - cone["angle_degrees"].get<double>()) < 180);
#endif
  // the tiles are hexagons: exact in the coordinates of their lattice
  const std::string sphere = write_off(folder, "icosphere.off", testing::icosphere(3));
  const std::string octahedron = folder.write("octahedron.txt", cone_lines({0, 1, 2, 3, 5, 9}, "240"));
  const std::string icosahedron = folder.write("icosahedron.txt", cone_lines({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, "300"));
  const std::vector<std::string> triangles = {"--cones", octahedron, "--quantize", "120", "--tiles", "300", "--lattice-coordinates"};
  BOOST_TEST(Seamless(folder, sphere, triangles, 3).verdict.cones == 6u);
  BOOST_TEST(Seamless(folder, sphere, {"--cones", icosahedron, "--quantize=60", "--tiles", "300", "--lattice-coordinates"}, 6).verdict.cones == 12u);
}

// Cartesian coordinates of hexagons are those of the lattice, rounded.
BOOST_AUTO_TEST_CASE(coordinates_of_hexagons)
{
  const Folder folder;
  const std::string input = write_off(folder, "icosphere.off", testing::icosphere(2));
  const std::string cones = folder.write("cones.txt", cone_lines({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, "300"));
  const Seamless lattice(folder, input, {"--cones", cones, "--quantize", "60", "--tiles", "100", "--lattice-coordinates"}, 6);
  const std::string svg = content(folder / "o.svg");
  BOOST_TEST(run({input, "-o", folder / "c.obj", "--svg", folder / "c.svg",
                  "--cones", cones, "--quantize", "60", "--tiles", "100", "--seamless"}).status == 0);
  const checking::Surface cartesian = checking::read_surface(folder / "c.obj");
  for(std::size_t f = 0; f < cartesian.faces.size(); ++f)
    for(std::size_t k = 0; k < 3; ++k)
    {
      const auto p = corner(lattice.layout, f, k), q = corner(cartesian, f, k);
      BOOST_TEST(std::abs(p[0] + p[1] / 2 - q[0]) < testing::rounded_layout);
      BOOST_TEST(std::abs(p[1] * std::sqrt(.75) - q[1]) < testing::rounded_layout);
    }
  // the drawing is Cartesian in both cases
  BOOST_TEST(std::abs(double(content(folder / "c.svg").size()) - double(svg.size())) < 100);
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
// The number of samples along seams at which the texture of the GLB file has two colours, by `color` of texture coordinates, that are not within the
// rounding of single precision of one; and that of all samples.
template <typename Color>
std::array<std::size_t, 2> mismatches(const checking::Glb_file& glb, const Color& color)
{
  typedef std::vector<float> Floats;
  const std::vector<Floats>&points = glb.attributes.at("POSITION"), &texture = glb.attributes.at("TEXCOORD_0");
  std::map<std::pair<Floats, Floats>, std::pair<Floats, Floats> > sides; // by the ends in space: those in the texture
  for(std::size_t i = 0; i < glb.indices.size(); ++i)
  {
    const std::size_t a = glb.indices[i], b = glb.indices[i - i % 3 + (i + 1) % 3];
    sides[{points[a], points[b]}] = {texture[a], texture[b]};
  }
  std::array<std::size_t, 2> result = {{0, 0}};
  for(const auto& [ends, left] : sides)
  {
    const auto other = sides.find({ends.second, ends.first});
    if(other == sides.end() || (other->second.first == left.second && other->second.second == left.first))
      continue;
    for(double t = 1 / 16.; t < 1; t += 1 / 8.)
    {
      const auto at = [&](const Floats& p, const Floats& q, double s)
      {
        return std::array<double, 2>{{ (1 - s) * p[0] + s * q[0], (1 - s) * p[1] + s * q[1] }};
      };
      ++result[1];
      result[0] += std::abs(color(at(left.first, left.second, t)) - color(at(other->second.first, other->second.second, 1 - t))) > 1e-4;
    }
  }
  return result;
}

// Continuous functions with the symmetries of the lattices, of texture coordinates, the second one of which points down; the patterns are their
// signs.
double square_color(const std::array<double, 2>& p) { return std::cos(2 * CGAL_PI * p[0]) * std::cos(2 * CGAL_PI * p[1]); }

double hexagon_color(const std::array<double, 2>& p)
{
  double least = 1; // distance to the bisectors of neighbours
  const double a = p[0], b = 1 - p[1];
  for(double i = std::floor(a); i <= std::floor(a) + 1; ++i)
    for(double j = std::floor(b); j <= std::floor(b) + 1; ++j)
    {
      const double x = a - i + (b - j) / 2, y = (b - j) * std::sqrt(.75);
      double largest = 0;
      for(int k = 0; k < 6; ++k)
        largest = (std::max)(largest, x * std::cos(k * CGAL_PI / 3) + y * std::sin(k * CGAL_PI / 3));
      least = (std::min)(least, largest);
    }
  return 0.44 - least;
}

// The picture shows where the function is positive: dark.
template <typename Color>
void check_texture(flattening::Pattern pattern, const Color& color)
{
  const flattening::Palette_image image = flattening::texture_image(pattern);
  std::size_t wrong = 0, sharp = 0;
  for(std::uint32_t y = 0; y < image.height; ++y)
    for(std::uint32_t x = 0; x < image.width; ++x)
    {
      const double c = color({{ (x + .5) / image.width, (y + .5) / image.height }});
      const unsigned char pixel = image.pixels[y * image.width + x];
      const bool is_dark = pixel == image.palette.size() - 1;
      if(std::abs(c) < 0.02)
        continue;
      ++sharp;
      wrong += is_dark != (c > 0) || (! is_dark && pixel != 0);
    }
  BOOST_TEST(wrong == 0u);
  BOOST_TEST(2 * sharp > image.pixels.size());
}

// As programs show it that know nothing of options: squares about all points of the lattice, and hexagons.
BOOST_AUTO_TEST_CASE(textures_fit_across_seams)
{
  check_texture(flattening::Pattern::SQUARE_TILES, square_color);
  check_texture(flattening::Pattern::HEXAGON_TILES, hexagon_color);

  const Folder folder;
  const std::string disk = write_off(folder, "hills.off", two_hills(9)), sphere = write_off(folder, "icosphere.off", testing::icosphere(2));
  const std::string disk_cones = folder.write("two.txt", cone_lines({in_ring(4, 0), in_ring(4, 12)}, "180"));
  const std::string sphere_cones = folder.write("twelve.txt", cone_lines({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, "300"));
  for(const std::string quantum : {"180", "90"})
  {
    const Run r = run({disk, "--seamless", "--cones", disk_cones, "--quantize", quantum, "--tiles", "60", "-o", folder / "o.glb"});
    BOOST_TEST_REQUIRE(r.status == 0, r.err);
    const checking::Glb_file glb(content(folder / "o.glb"));
    const auto count = mismatches(glb, square_color);
    BOOST_TEST(count[0] == 0u);
    BOOST_TEST(count[1] > 0u);
    BOOST_TEST(mismatches(glb, [](const std::array<double, 2>& p) { return std::sin(p[0]); })[0] > 0u); // something else does not fit
  }
  const std::vector<std::string> hexagons = {sphere, "--seamless", "--cones", sphere_cones, "--quantize", "60", "--tiles", "100"};
  const Run r = run(with(hexagons, {"-o", folder / "o.glb", "-o", folder / "o.obj"}));
  BOOST_TEST_REQUIRE(r.status == 0, r.err);
  BOOST_TEST(contains(r.err, "does not fit hexagons"));
  const auto count = mismatches(checking::Glb_file(content(folder / "o.glb")), hexagon_color);
  BOOST_TEST(count[0] == 0u);
  BOOST_TEST(count[1] > 0u);

  // the coordinates of the lattice have the same texture in both files
  BOOST_TEST(run(with(hexagons, {"--lattice-coordinates", "-o", folder / "o.obj"})).err.empty());
  const flattening::Palette_image image = flattening::texture_image(flattening::Pattern::HEXAGON_TILES);
  BOOST_TEST((content(folder / "o.checker.png") == flattening::png_file(image)));
}
#endif

namespace {

double area_in_space(const checking::Surface& s)
{
  double sum = 0;
  for(const auto& face : s.faces)
  {
    std::array<double, 3> a, b;
    for(std::size_t j = 0; j < 3; ++j)
    {
      a[j] = s.points[face[1]][j] - s.points[face[0]][j];
      b[j] = s.points[face[2]][j] - s.points[face[0]][j];
    }
    sum += std::hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]) / 2;
  }
  return sum;
}

} // namespace

// Edges are flipped, and straight triangles turned over: the message says what helps, and it does.
BOOST_AUTO_TEST_CASE(parts_of_triangles_are_laid_out, * testing::needs_mesh("joint.off"))
{
  const Folder folder;
  const std::string input = testing::mesh_path("joint.off");
  const std::vector<std::string> cones = {"--cones", "auto=8"};
  check_refused(with({input, "-o", folder / "o.obj", "--seamless"}, cones), 1, "edges were flipped: --refine lays out the parts");
  const checking::Surface given = checking::read_surface(input);
  const std::array<std::vector<std::string>, 2> tiles = {{ {"--refine"}, {"--refine", "--quantize", "60", "--lattice-coordinates"} }};
  for(const std::vector<std::string>& options : tiles)
  {
    const Seamless f(folder, input, with(cones, options), options.size() == 1 ? 4 : 6);
    const std::size_t n = given.points.size();
    BOOST_TEST_REQUIRE(f.layout.points.size() > n);
    BOOST_TEST(std::equal(given.points.begin(), given.points.end(), f.layout.points.begin())); // which come first
    BOOST_TEST(f.layout.points.size() + given.faces.size() / 2 == n + f.layout.faces.size() / 2); // of the same genus
    BOOST_TEST(std::abs(area_in_space(f.layout) / area_in_space(given) - 1) < testing::many_residuals);
    BOOST_TEST(number_of_crossings_on_seams(f.layout, n) > 0u); // so that seam edges have parts
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    BOOST_TEST(f.report["vertices"] == n);
    BOOST_TEST(f.report["refinement"]["vertices"] == f.layout.points.size());
    BOOST_TEST(f.report["refinement"]["crossings"] == f.layout.points.size() - n);
#endif
  }
}

namespace {

typedef std::array<double, 3> Space_point;

// Where the point lies on the segment from `a` to `b`: 0 to 1, or nothing if it lies elsewhere.
std::optional<double> place_on_segment(const Space_point& p, const Space_point& a, const Space_point& b)
{
  const double rounded_point = 1e-12; // of coordinates of up to 100 times the length of the segment, and then some
  double along = 0, squared_length = 0, off = 0;
  for(std::size_t j = 0; j < 3; ++j)
  {
    along += (p[j] - a[j]) * (b[j] - a[j]);
    squared_length += (b[j] - a[j]) * (b[j] - a[j]);
  }
  const double t = along / squared_length;
  for(std::size_t j = 0; j < 3; ++j)
    off = (std::max)(off, std::abs(a[j] + t * (b[j] - a[j]) - p[j]));
  return off < rounded_point * std::sqrt(squared_length) && t >= 0 && t <= 1 ? std::optional<double>(t) : std::nullopt;
}

} // namespace

// The u of a crossing lies on the line between those of the ends of its edge; weights are 1.
BOOST_AUTO_TEST_CASE(u_of_crossings, * testing::needs_mesh("joint.off"))
{
  const Folder folder;
  const std::string input = testing::mesh_path("joint.off");
  const Run r = run({input, "--cones", "auto=8", "--seamless", "--refine", "-o", folder / "o.ply", "--quiet"});
  BOOST_TEST_REQUIRE(r.status == 0, r.err);
  const checking::Surface given = checking::read_surface(input);
  const checking::Ply_file ply(content(folder / "o.ply"));
  std::map<std::size_t, double> u;
  for(auto v : ply.vertices)
    u[std::size_t(v["vertex"])] = v["log_scale_factor"];

  std::size_t wrong = 0, crossings = 0;
  for(auto v : ply.vertices)
  {
    BOOST_TEST(v["weight"] == 1);
    if(v["vertex"] < double(given.points.size()))
      continue;
    ++crossings;
    bool is_between = false;
    for(const auto& face : given.faces)
      for(std::size_t k = 0; k < 3; ++k)
      {
        const std::size_t a = face[k], b = face[(k + 1) % 3];
        const std::optional<double> t = place_on_segment({{ v["x"], v["y"], v["z"] }}, given.points[a], given.points[b]);
        is_between = is_between || (t && std::abs((1 - *t) * u[a] + *t * u[b] - v["log_scale_factor"]) < testing::many_residuals);
      }
    wrong += ! is_between;
  }
  BOOST_TEST(crossings > 0u);
  BOOST_TEST(wrong == 0u);
}

// Without flips, the layout and the mesh are those without --refine.
BOOST_AUTO_TEST_CASE(nothing_to_refine)
{
  const Folder folder;
  const std::string input = write_off(folder, "sphere.off", bumpy_sphere(2));
  const std::vector<std::string> options = {"--cones", "auto=4", "--tiles", "300"}; // so many that straight triangles do for the nearest places
  const checking::Surface straight = Seamless(folder, input, options).layout, refined = Seamless(folder, input, with(options, {"--refine"})).layout;
  BOOST_TEST((straight.points == refined.points));
  BOOST_TEST((straight.faces == refined.faces));
  for(std::size_t f = 0; f < straight.faces.size(); ++f)
    for(std::size_t k = 0; k < 3; ++k)
      for(std::size_t j = 0; j < 2; ++j)
        BOOST_TEST(std::abs(corner(straight, f, k)[j] - corner(refined, f, k)[j]) < testing::many_residuals);
}

BOOST_AUTO_TEST_CASE(seamless_layouts_are_refused)
{
  const Folder folder;
  const std::string input = write_off(folder, "hills.off", two_hills(5)), obj = folder / "o.obj";
  const auto refused = [&](const std::vector<std::string>& options, const std::string& reason)
    { check_refused(with({input, "-o", obj}, options), 2, reason); };
  // cones that place themselves
  refused({"--cones", "auto"},
          "needs a number (--cones auto=N), or a bound (--max-scale U, --max-area A or --max-rms E); a file of this name: ./auto");
  for(const char* number : {"", "0", "-1", "1.5", "many", "99999999999999999999"})
    refused({"--cones", std::string("auto=") + number}, "--cones auto= takes a positive integer");
  for(const char* bound : {"", "0", "-1", "nan", "inf", "small"})
    refused({"--cones", "auto", "--max-scale", bound}, "--max-scale takes a number above 0");
  for(const char* bound : {"1", "0.5", "nan", "inf"})
    refused({"--cones", "auto", "--max-area", bound}, "--max-area takes a number above 1");
  refused({"--max-scale", "1"}, "--max-scale needs --cones auto");
  refused({"--cones", "file", "--max-area", "2"}, "--max-area needs --cones auto");
  for(const char* quantum : {"0", "-90", "91", "400", "nan", "right", "0.1"})
    refused({"--cones", "auto=3", std::string("--quantize=") + quantum}, "--quantize takes 360 degrees divided by an integer");
  refused({"--quantize", "90"}, "--quantize needs --cones or --seamless");
  refused({"--quantize"}, "--quantize needs --cones or --seamless");
  refused({"--cones", "auto=3", "--boundary", "rectangle"}, "cones are placed for natural borders");
  refused({"--cones", "auto=3", "--local-repair"}, "--cones auto=3 and --local-repair exclude each other");
  refused({"--cones", "auto=3", "--precision", "100"}, "--cones auto=3 is computed with --precision double only");
  refused({"--cones", "auto=3", "--target", "sphere"}, "--target sphere and --cones exclude each other");
  // seamless layouts
  refused({"--tiles", "4"}, "--tiles needs --seamless");
  refused({"--distortion", "1.1"}, "--distortion needs --seamless");
  refused({"--lattice-coordinates"}, "--lattice-coordinates needs --seamless");
  refused({"--seamless", "--tiles", "0"}, "--tiles takes a positive integer");
  refused({"--seamless", "--distortion", "1"}, "--distortion takes a number above 1");
  refused({"--seamless", "--tiles", "4", "--distortion", "1.1"}, "--tiles and --distortion exclude each other");
  for(const char* quantum : {"72", "45", "360", "30"})
    refused({"--seamless", "--quantize", quantum}, "--seamless takes --quantize 180, 120, 90 or 60");
  refused({"--seamless", "--projective"}, "--seamless and --projective exclude each other");
  refused({"--seamless", "--local-repair"}, "--seamless and --local-repair exclude each other");
  refused({"--seamless", "--frame", "unit-square"}, "--seamless and --frame unit-square exclude each other");
  refused({"--seamless", "--precision", "100"}, "--seamless is computed with --precision double only");
  refused({"--seamless", "--target", "disk"}, "--target disk and --seamless exclude each other");
  refused({"--seamless", "--boundary", "disk"}, "--boundary disk and --seamless exclude each other");

  // what follows --quantize is an angle, or else something of its own
  const Run r = run({"--cones", "auto=1", "--quantize", input, "--quiet"});
  BOOST_TEST(r.status == 0, r.err);

  // cones of a file
  const auto file_refused = [&](const std::string& lines, const std::vector<std::string>& options, const std::string& reason)
    { check_refused(with({input, "-o", obj, "--cones", folder.write("c.txt", lines)}, options), 1, reason); };
  file_refused("3 90\n4 free\n", {"--seamless"}, "c.txt: line 2: vertex 4: a free cone has any angle, not a multiple of 90 degrees");
  file_refused("4\n", {"--quantize", "60"}, "c.txt: line 1: vertex 4: a free cone has any angle, not a multiple of 60 degrees");
  file_refused("4 300\n", {"--seamless"}, "line 1: vertex 4: the angle 300 is no multiple of 90 degrees");
  file_refused("4 1\n", {"--quantize", "120"}, "the angle 1 is no multiple of 120 degrees");
  BOOST_TEST(run({input, "--cones", folder.write("c.txt", "4 300\n"), "--quantize", "60", "--quiet"}).status == 0);
  const std::string six_sevenths = folder.write("c.txt", "4 308.5714286\n"); // 360 * 6 / 7
  BOOST_TEST(run({input, "--cones", six_sevenths, "--quantize", "51.428571428571", "--quiet"}).status == 0);

  // surfaces
  const std::string torus = write_off(folder, "torus.off", testing::torus(24, 8)),
                    annulus = write_off(folder, "annulus.off", testing::annulus(4, 20, .4)),
                    sphere = write_off(folder, "sphere.off", testing::icosphere(1));
  check_refused({sphere, "-o", obj, "--seamless"}, 1, "--cones auto=N");
  const std::string three = write_off(folder, "three.off", testing::together({two_hills(4), two_hills(4), testing::icosphere(1)}));
  check_refused({three, "-o", obj, "--seamless"}, 1, "the component of face 192, with 80 triangles: "); // which has no cones
  check_refused({three, "-o", obj, "--seamless", "--cones", "auto=2"}, 1, "the component of face 192, with 80 triangles: ");
  check_refused({three, "-o", obj, "--seamless", "--cones", "auto=3", "--refine"}, 1,
                "--seamless --refine takes a surface of one component, and this one has 3");
  std::filesystem::remove(three);
  BOOST_TEST(run({annulus, "--seamless", "--quiet"}).status == 0); // its borders are turned
  check_refused({torus, "-o", obj, "--seamless", "--cones", folder.write("c.txt", "0 270\n100 450\n")}, 1,
                "there is no flat surface with such cones");
  BOOST_TEST((folder.files() == std::set<std::string>{"hills.off", "torus.off", "annulus.off", "sphere.off", "c.txt"}));
}
