// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The program flatten_mesh, run within this one, and the writers it uses. What it
// writes is judged from the files, by a checker that shares no code with the package.

#define BOOST_TEST_MODULE test_flatten_mesh
#include "include/boost_test.h"
#include "include/check_flattening.h"
#include "include/check_image.h"
#include "include/check_seams.h"
#include "include/flattened_meshes.h"
#include "include/test_meshes.h"

#include "../../examples/Conformal_equivalence/include/flatten_mesh/flatten_mesh.h"

#include <CGAL/Surface_mesh_parameterization/ARAP_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;
namespace CE = CGAL::Conformal_equivalence;
namespace SMP = CGAL::Surface_mesh_parameterization;
using flattening::Mesh;

namespace {

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

Run run(const std::vector<std::string>& arguments)
{
  std::vector<const char*> argv(1, "flatten_mesh");
  for(const std::string& a : arguments)
    argv.push_back(a.c_str());
  std::ostringstream out, err;
  const int status = flatten_mesh(static_cast<int>(argv.size()), argv.data(), out, err);
  return { status, out.str(), err.str() };
}

std::string content(const std::string& file)
{
  std::ifstream in(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// refused with this status and one line that holds `reason`
void check_refused(const std::vector<std::string>& arguments, int status, const std::string& reason)
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

typedef flattening::Triangle_soup Soup;

// n by n squares, each of two triangles, over a bumpy height field
Soup bumpy_grid(std::size_t n)
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

std::string number(double x)
{
  std::ostringstream out;
  out.precision(17);
  out << x;
  return out.str();
}

std::string point(const std::array<double, 3>& p) { return number(p[0]) + ' ' + number(p[1]) + ' ' + number(p[2]); }

std::string as_off(const Soup& soup)
{
  std::ostringstream out;
  out << "OFF # a comment\n\n" << soup.points.size() << ' ' << soup.triangles.size() << " 0\n";
  for(const auto& p : soup.points)
    out << point(p) << '\n';
  for(const auto& t : soup.triangles)
    out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return out.str();
}

std::string as_obj(const Soup& soup)
{
  std::ostringstream out;
  out << "# a comment\no grid\n";
  for(const auto& p : soup.points)
    out << "v " << point(p) << '\n';
  out << "vt 0 0\nvn 0 0 1\n";
  for(std::size_t f = 0; f < soup.triangles.size(); ++f)
  {
    const auto& t = soup.triangles[f];
    if(f % 2 == 0)
      out << "f " << t[0] + 1 << "/1/1 " << t[1] + 1 << "//1 " << t[2] + 1 << "/1\n";
    else
      for(std::size_t k = 0; k < 3; ++k)
        out << (k == 0 ? "f " : " ") << static_cast<long>(t[k]) - static_cast<long>(soup.points.size()) << (k == 2 ? "\n" : "");
  }
  return out.str();
}

std::string as_text_ply(const Soup& soup)
{
  std::ostringstream out;
  out << "ply\nformat ascii 1.0\ncomment a comment\nelement vertex " << soup.points.size()
      << "\nproperty double x\nproperty double y\nproperty uchar red\nproperty double z\nelement face " << soup.triangles.size()
      << "\nproperty list uchar int vertex_indices\nproperty int label\nend_header\n";
  for(const auto& p : soup.points)
    out << number(p[0]) << ' ' << number(p[1]) << " 255 " << number(p[2]) << '\n';
  for(const auto& t : soup.triangles)
    out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << " 7\n";
  return out.str();
}

template <typename T>
void append_bytes(std::string& bytes, T value, bool reverse)
{
  char b[sizeof(T)];
  std::memcpy(b, &value, sizeof(T));
  if(reverse)
    std::reverse(b, b + sizeof(T));
  bytes.append(b, sizeof(T));
}

std::string as_binary_ply(const Soup& soup, bool big_endian)
{
  const bool reverse = big_endian != flattening::is_big_endian();
  std::ostringstream head;
  head << "ply\nformat binary_" << (big_endian ? "big" : "little") << "_endian 1.0\nelement vertex " << soup.points.size()
       << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << soup.triangles.size()
       << "\nproperty list uchar uint vertex_index\nend_header\n";
  std::string bytes = head.str();
  for(const auto& p : soup.points)
    for(double x : p)
      append_bytes(bytes, x, reverse);
  for(const auto& t : soup.triangles)
  {
    append_bytes(bytes, std::uint8_t(3), reverse);
    for(std::uint32_t i : t)
      append_bytes(bytes, i, reverse);
  }
  return bytes;
}

std::string as_text_stl(const Soup& soup)
{
  std::ostringstream out;
  out << "solid grid of facets\n";
  for(const auto& t : soup.triangles)
  {
    out << "facet normal 0 0 1\nouter loop\n";
    for(std::uint32_t i : t)
      out << "vertex " << point(soup.points[i]) << '\n';
    out << "endloop\nendfacet\n";
  }
  out << "endsolid grid of facets\n";
  return out.str();
}

std::string as_binary_stl(const Soup& soup)
{
  const bool reverse = flattening::is_big_endian();
  std::string bytes("solid, but binary");
  bytes.resize(80, ' ');
  append_bytes(bytes, static_cast<std::uint32_t>(soup.triangles.size()), reverse);
  for(const auto& t : soup.triangles)
  {
    for(int i = 0; i < 3; ++i)
      append_bytes(bytes, 0.f, reverse);
    for(std::uint32_t i : t)
      for(double x : soup.points[i])
        append_bytes(bytes, static_cast<float>(x), reverse);
    append_bytes(bytes, std::uint16_t(0), reverse);
  }
  return bytes;
}

std::string off(const std::string& vertices, const std::string& faces)
{
  const auto lines = [](const std::string& s) { return std::count(s.begin(), s.end(), '\n'); };
  return "OFF\n" + std::to_string(lines(vertices)) + ' ' + std::to_string(lines(faces)) + " 0\n" + vertices + faces;
}

checking::Verdict judge(const std::string& input, const std::string& output, bool border_keeps_its_lengths = true,
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
nlohmann::json json(const std::string& file) { return nlohmann::json::parse(content(file)); }
#endif

} // namespace

// ------------------------------------------------------------------------------------------------
// The checker itself: other maps are refused
// ------------------------------------------------------------------------------------------------

namespace {

template <typename Parameterizer>
std::string write_map_of(Mesh mesh, Parameterizer parameterizer, const std::string& file)
{
  auto uv = mesh.add_property_map<flattening::Vertex, flattening::Kernel::Point_2>("v:uv").first;
  const SMP::Error_code error = SMP::parameterize(mesh, parameterizer, flattening::first_border_halfedge(mesh), uv);
  BOOST_TEST((error == SMP::OK));
  auto corner_uv = mesh.add_property_map<flattening::Halfedge, flattening::Kernel::Point_2>("h:uv").first;
  for(flattening::Halfedge h : mesh.halfedges())
    corner_uv[h] = uv[mesh.target(h)];
  BOOST_TEST(CE::IO::write_OBJ(file, mesh, corner_uv));
  return file;
}

// moves one vertex of the layout by this part of an edge there
std::string write_perturbed(const std::string& obj, double amount, const std::string& file)
{
  std::ifstream in(obj);
  std::ofstream out(file);
  out.precision(17);
  std::size_t n = 0;
  for(std::string line; std::getline(in, line); )
  {
    double u, v;
    if(line.substr(0, 3) == "vt " && n++ == 40 && std::sscanf(line.c_str(), "vt %lf %lf", &u, &v) == 2)
      out << "vt " << u + amount << ' ' << v << '\n';
    else
      out << line << '\n';
  }
  return file;
}

} // namespace

BOOST_AUTO_TEST_CASE(checker_refuses_other_maps)
{
  const Folder folder;
  const std::string input = folder.write("grid.off", as_off(bumpy_grid(12)));
  Mesh mesh;
  flattening::read_mesh(input, mesh);
  BOOST_TEST(! judge(input, write_map_of(mesh, SMP::LSCM_parameterizer_3<Mesh>(), folder / "lscm.obj")).is_good());
  BOOST_TEST(! judge(input, write_map_of(mesh, SMP::ARAP_parameterizer_3<Mesh>(), folder / "arap.obj")).is_good());

  BOOST_TEST(run({input, "-o", folder / "out.obj"}).status == 0);
  BOOST_TEST(judge(input, folder / "out.obj").is_good());
  BOOST_TEST(judge(input, write_perturbed(folder / "out.obj", 0, folder / "same.obj")).is_good());
  BOOST_TEST(! judge(input, write_perturbed(folder / "out.obj", 1e-6 / 12, folder / "moved.obj")).is_good());
}

// ------------------------------------------------------------------------------------------------
// Good input
// ------------------------------------------------------------------------------------------------

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
  BOOST_TEST(report["status"] == "OK");
  BOOST_TEST(report["vertices"] == soup.points.size());
  BOOST_TEST(report["faces"] == soup.triangles.size());
  BOOST_TEST(report["genus"] == 0);
  BOOST_TEST(report["borders"] == 1);
  BOOST_TEST(report["components"] == 1);
  BOOST_TEST(report["retriangulation"]["mode"] == "when-needed");
  BOOST_TEST(report["refinement"].is_null());
  BOOST_TEST(report["residual"].get<double>() <= 1e-12);
  BOOST_TEST(report["tolerance"].get<double>() == 1e-12);
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

BOOST_AUTO_TEST_CASE(every_format_gives_the_same)
{
  const Folder folder;
  const Soup soup = bumpy_grid(5);
  const std::vector<std::string> inputs = {
    folder.write("a.off", as_off(soup)), folder.write("b.obj", as_obj(soup)), folder.write("c.ply", as_text_ply(soup)),
    folder.write("d.ply", as_binary_ply(soup, false)), folder.write("e.PLY", as_binary_ply(soup, true)) };
  std::string first;
  for(const std::string& input : inputs)
  {
    const Run r = run({input, "-o", folder / "o.obj", "--quiet"});
    BOOST_TEST_CONTEXT(input << ": " << r.err)
    BOOST_TEST(r.status == 0);
    const std::string obj = content(folder / "o.obj");
    if(first.empty())
      first = obj;
    BOOST_TEST((obj == first));
  }
  for(const std::string& input : {folder.write("f.stl", as_text_stl(soup)), folder.write("g.stl", as_binary_stl(soup))})
  {
    const Run r = run({input, "-o", folder / "o.obj"});
    BOOST_TEST_CONTEXT(input << ": " << r.err)
    BOOST_TEST(r.status == 0);
    BOOST_TEST(contains(r.out, "36 vertices, 50 triangles"));
  }
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
  BOOST_TEST(std::log(weight(1) / weight(0)) == 0.3, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(std::log(weight(1) / weight(5)) == -0.2, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(weight(1) == weight(n));

  // the angle sum at the middle of the lower side
  const std::string angles = folder.write("angles.txt", "5 150\n");
  BOOST_TEST(run({input, "-o", folder / "a.obj", "--boundary", "angles=" + angles, "--boundary",
                  "scale=" + folder.write("v.txt", "4 .1\n")}).status == 0);
  BOOST_TEST(judge(input, folder / "a.obj", false).is_good());
  const checking::Surface with_angle = checking::read_surface(folder / "a.obj");
  const auto& p = with_angle.texture;
  const double turn = std::atan2(p[4][1] - p[5][1], p[4][0] - p[5][0]) - std::atan2(p[6][1] - p[5][1], p[6][0] - p[5][0]);
  BOOST_TEST(std::remainder(turn - 150 * CGAL_PI / 180, 2 * CGAL_PI) == 0, boost::test_tools::tolerance(1e-10));
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
    BOOST_TEST(std::abs(turn - (is_corner ? CGAL_PI / 2 : 0)) < 1e-10);
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

// ------------------------------------------------------------------------------------------------
// Any topology
// ------------------------------------------------------------------------------------------------

namespace {

Soup program_soup(const testing::Soup& soup) { return { soup.points, soup.triangles, 0 }; }

std::string write_off(const Folder& folder, const std::string& name, const testing::Soup& soup)
{
  return folder.write(name, as_off(program_soup(soup)));
}

// Corners of a layout, weights divided out.
std::array<double, 2> corner(const checking::Surface& s, std::size_t f, std::size_t k)
{
  const auto& t = s.texture[s.corners[f][k % 3]];
  return {{ t[0] / t[2], t[1] / t[2] }};
}

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

double area(const checking::Surface& s)
{
  double sum = 0;
  for(std::size_t f = 0; f < s.faces.size(); ++f)
  {
    const auto p = corner(s, f, 0), q = corner(s, f, 1), r = corner(s, f, 2);
    sum += ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) / 2;
  }
  return sum;
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

// a cone of this many degrees
std::optional<checking::Real> degrees(double angle) { return angle / 180 * checking::pi; }
const std::optional<checking::Real> free_angle;

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
// Each piece is a disk: the corners, as distinct points of the layout, satisfy Euler's formula.
void check_number_of_corners(const checking::Surface& s, const nlohmann::json& report)
{
  const long components = report["components"].get<long>();
  const long chi = 2 * components - report["borders"].get<long>() - 2 * report["genus"].get<long>();
  const long vertices = report["vertices"].get<long>() - report["isolated_vertices"].get<long>();
  BOOST_TEST(long(s.texture.size()) == vertices - chi + components + report["seam_edges"].get<long>());
}

// The lattice in the report is that of the layout of one torus.
void check_lattice(const checking::Surface& s, const nlohmann::json& report)
{
  BOOST_REQUIRE(report["lattices"].size() == 1u);
  const nlohmann::json& lattice = report["lattices"][0];
  BOOST_TEST(lattice["face"].is_number_integer());
  const auto p = lattice["periods"].get<std::array<std::array<double, 2>, 2> >();
  const auto tau = lattice["tau"].get<std::array<double, 2> >();
  const double det = p[0][0] * p[1][1] - p[0][1] * p[1][0], norm = p[0][0] * p[0][0] + p[0][1] * p[0][1];
  BOOST_TEST(std::abs(area(s) / det - 1) < 1e-10); // the torus covers the plane once
  BOOST_TEST(std::abs(tau[0] - (p[0][0] * p[1][0] + p[0][1] * p[1][1]) / norm) < 1e-10);
  BOOST_TEST(std::abs(tau[1] - det / norm) < 1e-10);
  BOOST_TEST(std::abs(tau[0]) <= .5 + 1e-10);
  BOOST_TEST(std::hypot(tau[0], tau[1]) >= 1 - 1e-10);
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
    BOOST_TEST(std::abs(f.report["cones"][v]["angle_degrees"].get<double>() - 270) < 1e-9);
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
  BOOST_TEST(std::abs((sums[7] + sums[8] + sums[9]) / CGAL_PI * 180 - (3 * 360 - 420)) < 1e-8);
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
    BOOST_TEST(std::abs(cone["angle_degrees"].get<double>() - sums[expected[i]] / CGAL_PI * 180) < 1e-8);
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
    BOOST_TEST(std::abs(sums[m * n + i] - (i % 10 == 0 ? CGAL_PI / 2 : CGAL_PI)) < 1e-10);
  for(std::size_t i = 0; i < n; ++i) // the inner border keeps its lengths
  {
    const double scale = (std::max)(scale_of_edge(f.layout, i, (i + 1) % n), scale_of_edge(f.layout, (i + 1) % n, i));
    BOOST_TEST(std::abs(scale - 1) < 1e-10);
  }
  check_refused({input, "--boundary", "rectangle=0,10,20,270"}, 1, "vertex 270 is not on the same border as vertex 0");
  check_refused({input, "--boundary", "rectangle=240,3,250,260"}, 1, "vertex 3 is not on the same border as vertex 240");
  check_refused({input, "--boundary", "rectangle=240,100,250,260"}, 1, "vertex 100 is not on the border");
  check_refused({input, "--boundary", "rectangle"}, 1, "wrong topology: found 1 component, 2 borders, genus 0");
  const std::string sphere = write_off(folder, "sphere.off", testing::icosphere(1));
  check_refused({sphere, "--boundary", "rectangle"}, 1, "the mesh is closed");
  check_refused({sphere, "--boundary", "rectangle=0,1,2,3"}, 1, "vertex 0 is not on the border");
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
  check_refused({input, "-o", folder / "p.obj"}, 1, "needs cones, whose curvatures (2 pi - angle) sum up to 12.56");
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
// The sphere and the disk
// ------------------------------------------------------------------------------------------------

namespace {

// An ellipsoid with bumps: its triangulation needs no flips.
testing::Soup bumpy_sphere(int levels)
{
  testing::Soup soup = testing::icosphere(levels);
  for(testing::Point& p : soup.points)
  {
    const double r = 1 + .1 * std::sin(5 * p[0]) * std::cos(4 * p[1] + p[2]);
    p = {{ 1.4 * r * p[0], r * p[1], .8 * r * p[2] }};
  }
  return soup;
}

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
    BOOST_TEST(std::abs(s.report["solid_angle"].get<double>() - 4 * CGAL_PI) < 1e-10);
    BOOST_TEST(s.report["barycentre"].get<double>() < 1e-12);
    BOOST_TEST(s.report["unit_sphere_error"].get<double>() < 2e-16);
    BOOST_TEST(s.report["cross_ratio_error"].get<double>() < 1e-10);
    BOOST_TEST(s.report["cross_ratio_error"].get<double>() > 0);
    BOOST_TEST(s.report["layout_length_error"].get<double>() < 1e-10);
    BOOST_TEST(s.report["quasi_conformal"]["mean"].get<double>() >= 1);
    BOOST_TEST(s.report["quasi_conformal"]["max"].get<double>() < 2);
    BOOST_TEST(s.report["residual"].get<double>() <= 1e-12);
#endif
  }
  // The sphere does not depend on the vertex at infinity.
  for(std::size_t v = 0; v < spheres[0].points.size(); ++v)
    for(std::size_t k = 0; k < 3; ++k)
      BOOST_TEST(std::abs(spheres[1].points[v][k] - spheres[0].points[v][k]) < 1e-9);

  // Other weights: the barycentre of the vertices is elsewhere.
  const Inscribed areas(folder, input, {"--target", "sphere", "--moebius-weights", "areas"});
  BOOST_TEST(! is_good(checking::check_sphere(areas.input, areas.output)));
  checking::Image_tolerances uncentred;
  uncentred.barycentre = 1;
  BOOST_TEST(is_good(checking::check_sphere(areas.input, areas.output, uncentred)));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST(areas.report["barycentre"].get<double>() < 1e-12); // with these weights
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
    BOOST_TEST(s.report["barycentre"].get<double>() < 1e-12);
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
    BOOST_TEST(d.report["unit_circle_error"].get<double>() < 4e-16);
    BOOST_TEST(d.report["cross_ratio_error"].get<double>() < 1e-9);
    BOOST_TEST(d.report["layout_length_error"].get<double>() < 1e-9);
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
  BOOST_TEST(difference < 1e-9); // another vertex at infinity
  BOOST_TEST(to_areas > 1e-4);
  BOOST_TEST(distance(place(disks[0], 91), 1, 0) < 1e-15); // the first border vertex
  BOOST_TEST(distance(place(disks[5], 20), 0, 0) < 1e-14);
  BOOST_TEST(distance(place(disks[0], 20), 0, 0) > 1e-3);
  BOOST_TEST(distance(place(disks[6], 95), 1, 0) < 1e-14);
  BOOST_TEST(distance(place(disks[6], 99), -.5, std::sqrt(.75)) < 1e-14);
  BOOST_TEST(distance(place(disks[6], 120), -.5, -std::sqrt(.75)) < 1e-14);

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

BOOST_AUTO_TEST_CASE(sphere_and_disk_are_refused)
{
  const Folder folder;
  const std::string grid = folder.write("grid.off", as_off(bumpy_grid(4))), obj = folder / "o.obj", // border: 0, 1, ..., 4, 9, ..., 24, ...
                    hill = folder.write("hill.off", as_off(hilly_rings())), sphere = write_off(folder, "sphere.off", bumpy_sphere(1)),
                    torus = write_off(folder, "torus.off", testing::torus(8, 8)), annulus = write_off(folder, "annulus.off", testing::annulus(4, 12));
  const std::set<std::string> before = folder.files();
  const auto refused = [&](const std::string& input, const std::string& target, const std::string& reason)
    { check_refused({input, "-o", obj, "--target", target}, 1, reason); };
  refused(grid, "sphere", "found 1 component, 1 border, genus 0; --target sphere takes closed surfaces");
  refused(torus, "sphere", "found 1 component, 0 borders, genus 1");
  refused(sphere, "disk", "found 1 component, 0 borders, genus 0; --target disk takes surfaces");
  refused(annulus, "disk", "found 1 component, 2 borders, genus 0");

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
  excluded({"--target", "sphere", "--html", "h"}, "--target sphere", "--html");
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

// ------------------------------------------------------------------------------------------------
// Cones that place themselves, and seamless layouts
// ------------------------------------------------------------------------------------------------

namespace {

// Two hills on a disk: rings of 6, 12, 18, ... vertices around the vertex 0.
testing::Soup two_hills(testing::Index number_of_rings)
{
  const auto hill = [](double x, double y) { return .8 * std::exp(-8 * (x * x + y * y)); };
  return testing::rings(number_of_rings, [=](double x, double y) { return hill(x - .5, y) + hill(x + .45, y - .1); });
}

std::size_t in_ring(std::size_t ring, std::size_t i) { return 1 + 3 * ring * (ring - 1) + i; }

std::string cone_lines(const std::vector<std::size_t>& vertices, const std::string& angle)
{
  std::string lines;
  for(std::size_t v : vertices)
    lines += std::to_string(v) + ' ' + angle + '\n';
  return lines;
}

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more)
{
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

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
  BOOST_TEST(area_distortion(g.layout) <= area_bound * (1 + 1e-9));
  BOOST_TEST(area_distortion(g.layout) > 1);
  fs::remove(folder.path / "first.json");

  const std::set<std::string> files = folder.files();
  for(const std::vector<std::string>& options : std::vector<std::vector<std::string> >{{"--max-scale", "1e-6"}, {"--max-area", "1.000001"}})
    check_refused(with({input, "-o", folder / "p.obj", "--cones", "auto=2"}, options), 1, "the bound on the distortion was not met: ");
  check_refused({input, "-o", folder / "p.obj", "--cones", "auto=1000"}, 1, "not enough vertices for the cones");
  const std::string sphere = write_off(folder, "sphere.off", testing::icosphere(1));
  check_refused({sphere, "-o", folder / "p.obj", "--cones", "auto=2"}, 1, "at least three");
  const std::string two = write_off(folder, "two.off", testing::together({testing::hill(4, .5), testing::hill(4, .5)}));
  check_refused({two, "-o", folder / "p.obj", "--cones", "auto=2"}, 1, "wrong topology: found 2 components");
  fs::remove(sphere);
  fs::remove(two);
  BOOST_TEST(folder.files() == files, boost::test_tools::per_element());
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
      BOOST_TEST(std::abs(angle / step - std::round(angle / step)) < 1e-9);
      BOOST_TEST(std::abs(angle - before) < 2 * step);
      BOOST_TEST(angle != before);
      BOOST_TEST(angle != 360);
      BOOST_TEST(cone["prescribed"] == true);
    }
    BOOST_TEST(std::abs(curvature - 720) < 1e-8);
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

namespace {

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
// The motions of the report, by path, are those of the layout; the cones lie where the report says.
void check_report_of_seams(const checking::Seam_checker& checker, const checking::Surface& s, const nlohmann::json& report)
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
  BOOST_TEST(edges == checker.verdict().seam_edges);
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
  BOOST_TEST(std::abs(seamless["tiles"].get<double>() / area(s) - 1) < 1e-9);
  BOOST_TEST(seamless["distortion"]["mean"].get<double>() >= 1);
  BOOST_TEST(seamless["distortion"]["max"].get<double>() >= seamless["distortion"]["mean"].get<double>());
  BOOST_TEST(seamless["quasi_conformal_mean"]["before"].get<double>() >= 1);
  BOOST_TEST(seamless["closest"].is_boolean());
  BOOST_TEST(seamless["scale"].get<double>() > 0);
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
    const checking::Seam_checker checker(given, layout, symmetry);
    verdict = checker.verdict();
    BOOST_TEST(verdict.is_good(), verdict);
    BOOST_TEST(contains(svg, "id=\"tiles\""));
    BOOST_TEST(contains(content(folder / "o.html"), "</html>"));
    BOOST_TEST(contains(r.out, "tiles                   "));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    report = json(folder / "o.json");
    check_report_of_seams(checker, layout, report);
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
    BOOST_TEST(contains(content(folder / "o.mtl"), "-o 0.25 0.25 -s 1 1 1 o.checker.png"));
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
  BOOST_TEST(Seamless(folder, sphere, {"--cones", octahedron, "--quantize", "120", "--tiles", "300", "--lattice-coordinates"}, 3).verdict.cones == 6u);
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
  BOOST_TEST(run({input, "-o", folder / "c.obj", "--svg", folder / "c.svg", "--cones", cones, "--quantize", "60", "--tiles", "100", "--seamless"}).status == 0);
  const checking::Surface cartesian = checking::read_surface(folder / "c.obj");
  for(std::size_t f = 0; f < cartesian.faces.size(); ++f)
    for(std::size_t k = 0; k < 3; ++k)
    {
      const auto p = corner(lattice.layout, f, k), q = corner(cartesian, f, k);
      BOOST_TEST(std::abs(p[0] + p[1] / 2 - q[0]) < 1e-13);
      BOOST_TEST(std::abs(p[1] * std::sqrt(.75) - q[1]) < 1e-13);
    }
  // the drawing is Cartesian in both cases
  BOOST_TEST(std::abs(double(content(folder / "c.svg").size()) - double(svg.size())) < 100);
}

BOOST_AUTO_TEST_CASE(seamless_layouts_are_refused)
{
  const Folder folder;
  const std::string input = write_off(folder, "hills.off", two_hills(5)), obj = folder / "o.obj";
  const auto refused = [&](const std::vector<std::string>& options, const std::string& reason) { check_refused(with({input, "-o", obj}, options), 2, reason); };
  // cones that place themselves
  refused({"--cones", "auto"}, "needs a number (--cones auto=N), or a bound (--max-scale U or --max-area A); a file of this name: ./auto");
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
  refused({"--seamless", "--refine"}, "--seamless and --refine exclude each other");
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
  BOOST_TEST(run({input, "--cones", folder.write("c.txt", "4 308.5714286\n"), "--quantize", "51.428571428571", "--quiet"}).status == 0); // 360 * 6 / 7

  // surfaces
  const std::string torus = write_off(folder, "torus.off", testing::torus(24, 8)), annulus = write_off(folder, "annulus.off", testing::annulus(4, 20, .4)),
                    sphere = write_off(folder, "sphere.off", testing::icosphere(1));
  check_refused({sphere, "-o", obj, "--seamless"}, 1, "--cones auto=N");
  check_refused({annulus, "-o", obj, "--seamless", "--cones", folder.write("c.txt", "50 270\n")}, 1, "the two sides of the seam do not differ by a multiple");
  check_refused({torus, "-o", obj, "--seamless", "--cones", folder.write("c.txt", "0 270\n100 450\n")}, 1, "the two sides of the seam do not differ by a multiple");
  BOOST_TEST((folder.files() == std::set<std::string>{"hills.off", "torus.off", "annulus.off", "sphere.off", "c.txt"}));
}

// ------------------------------------------------------------------------------------------------
// Bad input: a message of its own, nothing left behind
// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(wrong_usage)
{
  check_refused({}, 2, "no INPUT is given");
  check_refused({"a.off", "b.off"}, 2, "only one INPUT");
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
  check_refused({"a.off", "--solver", "abacus"}, 2, "simplicial");
  for(const char* precision : { "quadruple", "", "1", "-200", "1e2", "4097" })
    check_refused({"a.off", "--precision", precision}, 2, "--precision takes");
  check_refused({"a.off", "--cones", ""}, 2, "--cones needs the name of a file");
  check_refused({"a.off", "--cones", "auto"}, 2, "a file of this name: ./auto");
  check_refused({"a.off", "--cones", "e", "--cones", "f"}, 2, "--cones");
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
    BOOST_TEST(report["residual"].get<double>() <= 1e-12);
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
    BOOST_TEST(report["residual"].get<double>() <= (bits == 53 ? 1e-12 : 1e-57));
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
    BOOST_TEST(worst <= (bits == 53 ? 1e-14 : 1e-57));
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
    { return std::hypot(s.texture[s.corners[1][i]][0] - s.texture[s.corners[1][j]][0], s.texture[s.corners[1][i]][1] - s.texture[s.corners[1][j]][1]); };
  const double a = distance(0, 1), b = distance(1, 2), c = distance(2, 0);
  BOOST_TEST(a > 0);
  BOOST_TEST(a >= 1e-3 * .5);
  BOOST_TEST((a + b > c && a + c > b));
}

BOOST_AUTO_TEST_CASE(bad_files)
{
  const Folder folder;
  const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n", two = "3 0 1 2\n3 0 2 3\n";
  struct Case { const char* name; std::string content; const char* reason; };
  const std::vector<Case> cases = {
    {"a.off", "", "the file is empty"},
    {"a.xyz", "OFF\n", "unknown extension '.xyz'"},
    {"a.off", "OOF\n3 1 0\n", "line 1: an OFF file begins with 'OFF'"},
    {"a.off", "OFF\n", "line 2: expected an integer, found the end of the file"},
    {"a.off", "OFF\n3 one 0\n", "line 2: expected an integer, found 'one'"},
    {"a.off", "OFF\n-3 1 0\n", "announces -3 vertices"},
    {"a.off", "OFF\n3000000 1 0\n0 0 0\n", "cut off"},
    {"a.off", "OFF\n99999999999999999999 1 0\n0 0 0\n", "line 2: expected an integer"},
    {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n#0 1 0 .......\n", "cut off: it ends after 2 of 3 vertices"},
    {"a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n#........", "cut off: it ends after 1 of 2 faces"},
    {"a.off", off("0 0 0\n1 0\n0 1 0\n", "3 0 1 2\n"), "line 4: expected a number, found the end of the line"},
    {"a.off", off("0 0 0\n1 x 0\n0 1 0\n", "3 0 1 2\n"), "line 4: expected a number, found 'x'"},
    {"a.off", off("0 0 0\n1 nan 0\n0 1 0\n", "3 0 1 2\n"), "vertex 1 has the coordinate nan"},
    {"a.off", off("0 0 0\n1 0 0\n0 1 -inf\n", "3 0 1 2\n"), "vertex 2 has the coordinate -inf"},
    {"a.off", off("0 0 0\n1 0 0\n0 1e999 0\n", "3 0 1 2\n"), "vertex 2 has the coordinate inf"},
    {"a.off", off(square, "3 0 1 2\n3 0 2 4\n"), "line 8: face 1 names the vertex 4, but there are 4 vertices"},
    {"a.off", off(square, "3 0 1 2\n3 0 2 -1\n"), "face 1 names the vertex -1"},
    {"a.off", off(square, "3 0 1 2\n3 0 2\n"), "line 8: expected an integer"},
    {"a.off", off(square, "4 0 1 2 3\n"), "line 7: face 0 has 4 vertices; only triangle meshes"},
    {"a.off", off(square, "3 0 1 2\n2 0 1\n"), "face 1 has 2 vertices"},
    {"a.off", off(square, "3 0 1 2\n3 0 2 2\n"), "face 1 has the vertex 2 twice"},
    {"a.off", off(square, ""), "there are no faces"},
    {"a.off", off(square + "0 0 1\n", "3 0 1 2\n3 1 0 3\n3 0 1 4\n"), "not a manifold: the edge 0-1 lies in 3 faces"},
    {"a.off", off(square, "3 0 1 2\n3 0 3 2\n3 2 0 1\n"), "the faces 0 and 2 have opposite orientations at the edge 0-1"},
    {"a.off", off(square, "3 0 1 2\n3 0 3 2\n3 1 0 3\n"), "opposite orientations at the edge"},
    {"a.off", off(square + "0 0 1\n", "3 0 1 2\n3 0 3 4\n"), "not a manifold: the faces at the vertex 0 form more than one fan"},
    {"a.off", off("0 0 0\n1 0 0\n1 0 0\n0 1 0\n", two), "edge"},
    {"a.off", off("0 0 0\n1 0 0\n0 1 0\n0 0 1\n", "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"), "closed surface of genus other than 1 needs cones"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "line 4: face 0 names the vertex 4 (counted from 1)"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "line 4"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n", "face 0 names the vertex 0 (counted from 1)"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4 3\n", "line 5: face 0 has 4 vertices"},
    {"a.obj", "v 0 0\nv 1 0 0\n", "line 1: expected a number, found the end of the line"},
    {"a.obj", "hello\n", "there are no faces"},
    {"a.stl", "hello", "neither text nor binary STL"},
    {"a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n", "'endsolid' is missing"},
    {"a.stl", "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\nendsolid\n", "face 0 has 2 vertices"},
    {"a.stl", "solid\nfacet\nvertex 0 0 0\nvertex nan 0 0\nvertex 0 1 0\nendfacet\nendsolid\n", "vertex 1 has the coordinate nan"},
    {"a.ply", "play\n", "a PLY file begins with 'ply'"},
    {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "unknown line '' in the header"},
    {"a.ply", "ply\nformat ternary 1.0\nend_header\n", "unknown PLY format"},
    {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nend_header\n", "no property 'z'"},
    {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty quad x\n", "unknown type 'quad'"} };
  for(const Case& c : cases)
  {
    const std::string input = folder.write(c.name, c.content);
    BOOST_TEST_CONTEXT(c.content)
    check_refused({input, "-o", folder / "o.obj", "--svg", folder / "o.svg"}, 1, c.reason);
    fs::remove(input);
  }
  check_refused({folder / "missing.off"}, 1, "cannot be opened");
  fs::create_directory(folder.path / "folder.off");
  check_refused({folder / "folder.off"}, 1, "is a directory");
  BOOST_TEST(folder.files().size() == 1u);
}

// However a file is cut off or damaged, the program returns.
BOOST_AUTO_TEST_CASE(damaged_files)
{
  const Folder folder;
  const Soup soup = bumpy_grid(2);
  const std::vector<std::pair<const char*, std::string> > files = {
    {"a.off", as_off(soup)}, {"a.obj", as_obj(soup)}, {"a.ply", as_text_ply(soup)}, {"b.ply", as_binary_ply(soup, true)},
    {"a.stl", as_text_stl(soup)}, {"b.stl", as_binary_stl(soup)} };
  std::mt19937 random(1);
  for(const auto& file : files)
    for(std::size_t n = 0; n < file.second.size(); n += 3)
    {
      BOOST_TEST(run({folder.write(file.first, file.second.substr(0, n)), "--quiet"}).status != 2);
      std::string damaged = file.second;
      damaged[n] = static_cast<char>(random());
      BOOST_TEST(run({folder.write(file.first, damaged), "--quiet"}).status != 2);
    }
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
  check_refused({input, "--boundary", "scale=" + (folder / "missing.txt")}, 1, "missing.txt: cannot be opened");
  const std::string both = folder.write("c.txt", "0 90\n");
  check_refused({input, "--boundary", "scale=" + both, "--boundary", "angles=" + both}, 1, "has a condition already");
  // all border vertices have right angles: far from Gauss-Bonnet
  std::string all;
  for(std::size_t v : border_of_grid(4))
    all += std::to_string(v) + " 90\n";
  check("angles", all, "Gauss-Bonnet");
  BOOST_TEST((folder.files() == std::set<std::string>{"grid.off", "c.txt"}));
}

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
  check_sphere("0 180\n1 180\n2 180\n", "Gauss-Bonnet");
  check_sphere("# none\n", "needs cones");
  check_sphere("0 free\n1 free\n", "leave none for the vertices of fixed scale");
  check_sphere("0 1000\n1 free\n2 free\n", "vertex 0"); // more than five triangles can have
  BOOST_TEST((folder.files() == std::set<std::string>{"grid.off", "sphere.off", "c.txt"}));

  // a file with a name of its own
  const fs::path before = fs::current_path();
  folder.write("auto", "12 300\n");
  fs::current_path(folder.path);
  BOOST_TEST(run({input, "--cones", "./auto"}).status == 0);
  fs::current_path(before);
}

// ------------------------------------------------------------------------------------------------
// Outputs: all or none
// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(outputs_that_cannot_be_written)
{
  const Folder folder;
  const std::string input = folder.write("grid.off", as_off(bumpy_grid(4)));
  check_refused({input, "-o", folder / "none/o.obj"}, 1, "cannot write");
  check_refused({input, "-o", folder.path.string()}, 1, "it is a directory");
  check_refused({input, "-o", input}, 2, "would overwrite the input");
  const std::string cones = folder.write("o.mtl", "12 free\n");
  check_refused({input, "--cones", cones, "--svg", cones}, 2, "would overwrite the input");
  check_refused({input, "--cones", cones, "-o", folder / "o.obj"}, 2, "o.mtl would overwrite the input");
  fs::remove(cones);
  check_refused({input, "-o", folder / "o.x", "--svg", folder / "o.x"}, 2, "two outputs have the same name");
  if(fs::exists("/dev/full"))
    check_refused({input, "-o", folder / "o.obj", "--svg", "/dev/full"}, 1, "cannot write /dev/full");
  BOOST_TEST((folder.files() == std::set<std::string>{"grid.off"}));
  BOOST_TEST(content(input) == as_off(bumpy_grid(4)));

  // through a link, to the file itself
  folder.write("target.svg", "old");
  fs::create_symlink("target.svg", folder.path / "link.svg");
  BOOST_TEST(run({input, "--svg", folder / "link.svg"}).status == 0);
  BOOST_TEST(fs::is_symlink(folder.path / "link.svg"));
  BOOST_TEST(contains(content(folder / "target.svg"), "</svg>"));
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

// ------------------------------------------------------------------------------------------------
// The writers
// ------------------------------------------------------------------------------------------------

namespace {

// two triangles on a square, laid out apart
struct Two_triangles
{
  Mesh mesh;
  flattening::UV_map uv;

  Two_triangles()
  {
    flattening::Triangle_soup soup;
    soup.points = {{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}, {{0, 1, 0}}, {{0.1, 1e-300, -1e300}}};
    soup.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
    flattening::check_soup(soup, "two");
    flattening::build_mesh(soup, "two", mesh);
    uv = mesh.add_property_map<flattening::Halfedge, flattening::Kernel::Point_2>("h:uv").first;
    for(flattening::Halfedge h : mesh.halfedges())
    {
      const auto p = mesh.point(mesh.target(h));
      const double shift = ! mesh.is_border(h) && mesh.face(h).idx() == 1 ? 3 : 0;
      uv[h] = flattening::Kernel::Point_2(p.x() / 3 + shift, p.y());
    }
  }
};

} // namespace

BOOST_AUTO_TEST_CASE(write_obj_at_a_seam)
{
  Two_triangles two;
  std::ostringstream out;
  out.precision(2); // is not looked at
  BOOST_TEST(CE::IO::write_OBJ(out, two.mesh, two.uv));
  std::istringstream in(out.str());
  const checking::Surface s = checking::read_obj(in);
  BOOST_TEST(s.points.size() == 5u);
  BOOST_TEST(s.points[4][0] == 0.1);
  BOOST_TEST(s.points[4][1] == 1e-300);
  BOOST_TEST(s.points[4][2] == -1e300);
  BOOST_TEST(s.texture.size() == 6u);
  BOOST_TEST((s.faces == std::vector<std::array<std::size_t, 3> >{{{0, 1, 2}}, {{0, 2, 3}}}));
  for(std::size_t f = 0; f < 2; ++f)
    for(std::size_t k = 0; k < 3; ++k)
    {
      const auto& p = s.points[s.faces[f][k]];
      BOOST_TEST(s.texture[s.corners[f][k]][0] == p[0] / 3 + (f == 1 ? 3 : 0));
      BOOST_TEST(s.texture[s.corners[f][k]][1] == p[1]);
    }

  std::ofstream closed;
  BOOST_TEST(! CE::IO::write_OBJ(closed, two.mesh, two.uv));
  BOOST_TEST(! CE::IO::write_OBJ("/no such folder/o.obj", two.mesh, two.uv));
}

BOOST_AUTO_TEST_CASE(write_obj_with_other_points_and_weights)
{
  Two_triangles two;
  auto points = two.mesh.add_property_map<flattening::Vertex, flattening::Kernel::Point_3>("v:other").first;
  auto weights = two.mesh.add_property_map<flattening::Vertex, double>("v:w", 0.25).first;
  weights[flattening::Vertex(0)] = 1;
  points[flattening::Vertex(2)] = flattening::Kernel::Point_3(4, 5, 6);
  std::ostringstream out;
  CE::IO::OBJ_material material;
  material.file = "m.mtl";
  BOOST_TEST(CE::IO::write_OBJ(out, two.mesh, two.uv,
                               CGAL::parameters::projective_weight_map(weights).vertex_point_map(points), material));
  BOOST_TEST(contains(out.str(), "v 4 5 6\n"));
  BOOST_TEST(contains(out.str(), "vt 0 0 1\n"));
  BOOST_TEST(contains(out.str(), "vt 0.75 0 1\n") == false);
  BOOST_TEST(contains(out.str(), "mtllib m.mtl\n"));
  BOOST_TEST(contains(out.str(), "usemtl layout\n"));
  std::istringstream in(out.str());
  const checking::Surface s = checking::read_obj(in);
  BOOST_TEST(s.has_weights);
  BOOST_TEST(s.texture[s.corners[0][1]][0] == 1. / 3 * 0.25);
}

BOOST_AUTO_TEST_CASE(draw_layouts)
{
  Two_triangles two;
  auto value = two.mesh.add_property_map<flattening::Face, double>("f:value", 0.).first;
  value[flattening::Face(1)] = 7.5;
  const auto svg = [&](const flattening::SVG_options& options)
  {
    std::ostringstream out;
    BOOST_TEST(flattening::write_SVG(out, two.mesh, two.uv, value, options));
    return out.str();
  };
  flattening::SVG_options options;
  options.legend = "a < b & c";
  const std::string drawing = svg(options);
  BOOST_TEST(contains(drawing, "a &lt; b &amp; c"));
  BOOST_TEST(contains(drawing, ">7.5<"));
  BOOST_TEST(contains(drawing, ">0<"));
  BOOST_TEST(contains(drawing, "url(#checkerboard)"));
  const auto outline = drawing.substr(drawing.find("id=\"outline\""));
  const std::string path = outline.substr(0, outline.find("/>"));
  BOOST_TEST(std::count(path.begin(), path.end(), 'M') == 2); // two pieces, each closed
  BOOST_TEST(std::count(path.begin(), path.end(), 'z') == 2);

  // circles are within the frame: here it is [-3, 5] x [-3.5, 4.5]
  BOOST_TEST(! contains(drawing, "circle"));
  options.circles = { {{1, .5, 4}}, {{1, .5, 1}} };
  BOOST_TEST(contains(svg(options), "<circle cx=\"500\" cy=\"500\" r=\"500\"/>"));
  BOOST_TEST(contains(svg(options), "<circle cx=\"500\" cy=\"500\" r=\"125\"/>"));
  options.circles.clear();

  options.checkerboard = false;
  BOOST_TEST(! contains(svg(options), "pattern"));
  options.maximum_number_of_drawn_faces = 1;
  BOOST_TEST(contains(svg(options), "data:image/png;base64,"));

  // numbers of any kind: no crash, no "nan" in the drawing
  value[flattening::Face(0)] = std::numeric_limits<double>::quiet_NaN();
  two.uv[two.mesh.halfedge(flattening::Face(0))] = flattening::Kernel::Point_2(HUGE_VAL, 0);
  for(std::size_t drawn : {0, 10})
  {
    options.maximum_number_of_drawn_faces = drawn;
    BOOST_TEST(! contains(svg(options), "nan"));
    BOOST_TEST(! contains(svg(options), "inf"));
  }
  for(flattening::Halfedge h : two.mesh.halfedges())
    two.uv[h] = flattening::Kernel::Point_2(1e300, -1e-300); // all in one point
  BOOST_TEST(! contains(svg(options), "nan"));
}

BOOST_AUTO_TEST_CASE(write_page)
{
  Two_triangles two;
  auto value = two.mesh.add_property_map<flattening::Face, double>("f:value", 1.).first;
  auto weights = two.mesh.add_property_map<flattening::Vertex, double>("v:w", 1.).first;
  flattening::HTML_options options;
  options.title = "<script>";
  options.figures = {{"a", "<b>"}};
  for(bool with_weights : {false, true})
  {
    std::ostringstream out;
    BOOST_TEST((with_weights ? flattening::write_HTML(out, two.mesh, two.uv, value, options, CGAL::parameters::projective_weight_map(weights))
                             : flattening::write_HTML(out, two.mesh, two.uv, value, options)));
    const std::string page = out.str();
    BOOST_TEST(contains(page, "<title>&lt;script&gt;</title>"));
    BOOST_TEST(contains(page, "<td>a</td><td>&lt;b&gt;</td>"));
    // six corners of three floats are 72 bytes, 96 digits; six indices of four bytes are 24 bytes, 32 digits
    const auto digits = [&](const std::string& name)
    {
      const std::size_t begin = page.find(name + " = bytes(\"") + name.size() + 10;
      return page.find('"', begin) - begin;
    };
    BOOST_TEST(digits("points") == 96u);
    BOOST_TEST(digits("texture") == 96u);
    BOOST_TEST(digits("triangles") == 32u);
  }
}

BOOST_AUTO_TEST_CASE(encodings)
{
  using namespace flattening;
  const auto base64 = [](const std::string& s)
  {
    std::ostringstream out;
    {
      Text_buffer buffer(out);
      write_base64(buffer, reinterpret_cast<const unsigned char*>(s.data()), s.size());
    }
    return out.str();
  };
  BOOST_TEST(base64("") == ""); // the examples of RFC 4648, section 10
  BOOST_TEST(base64("f") == "Zg==");
  BOOST_TEST(base64("fo") == "Zm8=");
  BOOST_TEST(base64("foo") == "Zm9v");
  BOOST_TEST(base64("foobar") == "Zm9vYmFy");

  const std::string check = "123456789";
  BOOST_TEST(crc32(check.data(), check.data() + check.size()) == 0xcbf43926u);
  BOOST_TEST(adler32("Wikipedia") == 0x11e60398u);
  BOOST_TEST(round_number_below(0.7) == 0.5);
  BOOST_TEST(round_number_below(29) == 20.);
  BOOST_TEST(round_number_below(1) == 1.);
  BOOST_TEST(round_number_below(0) == 1.);
}
