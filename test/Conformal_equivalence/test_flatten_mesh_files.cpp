// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The files that the program flatten_mesh reads and writes, good and bad ones; and the checker of layouts itself.

#define BOOST_TEST_MODULE test_flatten_mesh_files
#include "include/boost_test.h"
#include "include/check_flattening.h"
#include "include/layout_files.h"
#include "include/program_runs.h"

#include "../../examples/Conformal_equivalence/include/flatten_mesh/Given_surface.h"
#include "../../examples/Conformal_equivalence/include/flatten_mesh/mesh.h"
#include "../../examples/Conformal_equivalence/include/flatten_mesh/Output_files.h"
#include "../../examples/Conformal_equivalence/include/flatten_mesh/page_text.h"
#include "../../examples/Conformal_equivalence/include/flatten_mesh/PNG.h"
#include "../../examples/Conformal_equivalence/include/flatten_mesh/read_soup.h"
#include "../../examples/Conformal_equivalence/include/flatten_mesh/write_HTML.h"
#include "../../examples/Conformal_equivalence/include/flatten_mesh/write_SVG.h"

#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/Surface_mesh_parameterization/ARAP_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <streambuf>
#include <string>
#include <utility>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#  include <csignal>
#  include <sys/wait.h>
#  include <unistd.h>
#endif

namespace fs = std::filesystem;
using namespace program;

namespace CE = CGAL::Conformal_equivalence;
namespace SMP = CGAL::Surface_mesh_parameterization;
using flattening::Mesh;

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
  flattening::read_surface(input, false, mesh);
  BOOST_TEST(! judge(input, write_map_of(mesh, SMP::LSCM_parameterizer_3<Mesh>(), folder / "lscm.obj")).is_good());
  BOOST_TEST(! judge(input, write_map_of(mesh, SMP::ARAP_parameterizer_3<Mesh>(), folder / "arap.obj")).is_good());

  BOOST_TEST(run({input, "-o", folder / "out.obj"}).status == 0);
  BOOST_TEST(judge(input, folder / "out.obj").is_good());
  BOOST_TEST(judge(input, write_perturbed(folder / "out.obj", 0, folder / "same.obj")).is_good());
  BOOST_TEST(! judge(input, write_perturbed(folder / "out.obj", 1e-6 / 12, folder / "moved.obj")).is_good());
}

// ------------------------------------------------------------------------------------------------
// What is read
// ------------------------------------------------------------------------------------------------

namespace {

std::string replaced(std::string text, const std::string& what, const std::string& by)
{
  for(std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

// Points and faces, and nothing else.
std::string as_bare_obj(const testing::Soup& soup)
{
  std::string obj;
  for(const auto& p : soup.points)
    obj += "v " + point(p) + '\n';
  for(const auto& t : soup.triangles)
    obj += "f " + std::to_string(t[0] + 1) + ' ' + std::to_string(t[1] + 1) + ' ' + std::to_string(t[2] + 1) + '\n';
  return obj;
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

} // namespace

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
    const std::string obj = replaced(content(folder / "o.obj"), "o grid\n", ""); // the name of the object, where the file has one
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

BOOST_AUTO_TEST_CASE(bad_files)
{
  const Folder folder;
  const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n", two = "3 0 1 2\n3 0 2 3\n";
  const auto obj = [](const std::string& lines) { return "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n" + lines; };
  const std::string vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n",
                    faces = "element face 1\nproperty list char int vertex_indices\n";
  const auto ply = [](const std::string& elements, const std::string& body) { return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + body; };
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
    {"a.off", off(square, "3 0 1 2\n2 0 1\n"), "face 1 has only 2 vertices (--repair"},
    {"a.off", off(square, "3 0 1 2\n0\n"), "line 8: face 1 has no vertices"},
    {"a.off", off(square, two) + "3 0 1 2\n", "line 9: there is more than the 4 vertices and 2 faces that are announced"},
    {"a.off", "OFF\n4 2 0\n" + square + "0 0 1\n" + two, "line 7: face 0 has no vertices"}, // another vertex than announced
    {"a.off", "OFF\n5 1 0\n" + square + two, "line 7: vertex 4 has 1 numbers after its coordinates, but vertex 0 has 0"}, // a face
    {"a.off", off("0 0 0 1 0 0\n1 1 0\n0 1 0\n0 0 1\n", two), "line 4: vertex 1 has 0 numbers after its coordinates, but vertex 0 has 3"},
    {"a.off", off("0 0 0 red\n1 0 0\n0 1 0\n", "3 0 1 2\n"), "line 3: expected a number, found 'red'"},
    {"a.off", off("0 0 0\n1 0 0\n0 1 1.#INF\n", "3 0 1 2\n"), "line 5: expected a number, found '1.#INF'"},
    {"a.off", "\xFF\xFEO\0F\0F\0", "is encoded in UTF-16 or UTF-32; convert it to UTF-8"},
    {"a.off", off(square, "3 0 1 2\n3 0 2 2\n"), "face 1 has the vertex 2 twice (--repair"},
    {"a.off", off(square, ""), "there are no faces"},
    {"a.off", off(square + "0 0 1\n", "3 0 1 2\n3 1 0 3\n3 0 1 4\n"), "not a manifold: the edge 0-1 lies in 3 faces (0, 1, ...) (--repair"},
    {"a.off", off(square, "3 0 1 2\n3 0 3 2\n3 2 0 1\n"), "the faces 0 and 2 have the same vertices (--repair"},
    {"a.off", off(square, "3 0 1 2\n3 0 3 2\n3 1 0 3\n"), "have opposite orientations at the edge 0-3 (--repair"},
    {"a.off", off(square + "0 0 1\n", "3 0 1 2\n3 0 3 4\n"), "not a manifold: the faces at the vertex 0 form more than one fan (--repair"},
    {"a.off", off("0 0 0\n1 0 0\n1 0 0\n0 1 0\n", two), "edges of length zero; edge 1-2 (--repair merges equal points; --mollify"},
    {"a.off", off("0 0 0\n1 0 0\n0 1 0\n0 0 1\n", "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"), "closed surface of genus other than 1 needs cones"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "line 4: face 0 names the vertex 4 (counted from 1)"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "line 4"},
    {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n", "face 0 names the vertex 0 (counted from 1)"},
    {"a.obj", obj("f 1 2 3/x\n"), "line 5: a face: expected the number of a texture coordinate, found 'x' in '3/x'"},
    {"a.obj", obj("f 1 2 3//y\n"), "expected the number of a normal, found 'y' in '3//y'"},
    {"a.obj", obj("f 1 2 3/1/1/1\n"), "expected a corner 'v/vt/vn', found '3/1/1/1'"},
    {"a.obj", obj("f 1 2 3/0\n"), "expected the number of a texture coordinate, found '0'"},
    {"a.obj", obj("f 1 2 /1\n"), "expected the number of a vertex, found '' in '/1'"},
    {"a.obj", obj("f 1 2 3\\\n4\n"), "line 5: the line is continued within a word"},
    {"a.obj", obj("f 1 2 3\n4\n"), "line 6: expected a key word, such as 'v' or 'f', found '4'"},
    {"a.obj", obj("f\n"), "line 5: face 0 has no vertices"},
    {"a.obj", obj("f 1 2 3 # \\\n 4\n"), "line 6: expected a key word"}, // a comment is not continued
    {"a.obj", obj("call more.obj\nf 1 2 3\n"), "line 5: 'call' takes lines from elsewhere"},
    {"a.obj", "v 0 0 0\n\xEF\xBB\xBFv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\n", "line 2: expected a key word, such as 'v' or 'f', found '???v'"},
    {"a.obj", "v 0 0 0 v 1 0 0\n", "line 1: expected a number, found 'v'"},
    {"a.obj", "v 0 0\nv 1 0 0\n", "line 1: expected a number, found the end of the line"},
    {"a.obj", "hello\n", "there are no faces"},
    {"a.obj", "# \\\nf 1 2 3\n", "face 0 names the vertex 1 (counted from 1), but there are 0 vertices"},
    {"a.stl", "hello", "neither text nor binary STL"},
    {"a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n", "'endsolid' is missing"},
    {"a.stl", "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\nendsolid\n", "face 0 has 2 vertices"},
    {"a.stl", "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nfacet\nendsolid\n", "line 6: a facet begins before the last one ends"},
    {"a.stl", "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 1.0 0e5 0\nendfacet\nendsolid\n",
     "points of face 0 coincide: it has (1, 0, 0) twice"},
    {"a.stl", as_binary_stl({{{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{1, 500000.01, 0}}, {{1, 500000, 0}}}, {{{0, 1, 2}}, {{1, 3, 4}}}}),
     "points of face 1 coincide in single precision, that of the file: it has (1, 500000, 0) twice"},
    {"a.stl", as_binary_stl(bumpy_grid(2)).substr(0, 200), "is cut off: it announces 8 triangles, but ends after 2"},
    {"a.stl", as_binary_stl(bumpy_grid(2)) + std::string(50, '\0'), "announces 8 triangles, but there is more: room for 9"},
    {"a.stl", "solid\nfacet\nvertex 0 0 0\nvertex nan 0 0\nvertex 0 1 0\nendfacet\nendsolid\n", "vertex 1 has the coordinate nan"},
    {"a.ply", "play\n", "a PLY file begins with 'ply'"},
    {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "unknown line '' in the header"},
    {"a.ply", "ply\nformat ternary 1.0\nend_header\n", "unknown PLY format"},
    {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nend_header\n", "no property 'z'"},
    {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty quad x\n", "unknown type 'quad'"},
    {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float\nproperty float y\n", "line 4: a property without a name"},
    {"a.ply", ply("element vertex 3\nproperty float x\nproperty float y\nproperty float x\nproperty float z\n", ""),
     "'vertex' have the property 'x' twice"},
    {"a.ply", ply(vertices + vertices, ""), "announces the elements 'vertex' twice"},
    {"a.ply", ply(vertices + "element face 1\nproperty list uchar int corners\n", ""), "the elements 'face' have no list 'vertex_indices'"},
    {"a.ply", ply(vertices + faces, "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n"), "line 14: there is more than the elements that the header announces"},
    {"a.ply", ply(vertices + faces, "0 0 0\n1 0 0\n0 1 0 0\n3 0 1 2\n"), "line 12: there are more numbers than the header has properties"},
    {"a.ply", ply(vertices + faces, "0 0 0\n1 0\n0\n0 1 0\n3 0 1 2\n"), "line 11: expected a number, found the end of the line"},
    {"a.ply", ply(vertices + faces, "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n"), "face 0 names the vertex 1.5"},
    {"a.ply", ply(vertices + faces, "0 0 0\n1 0 0\n0 1 0\n-1 0 1 2\n"), "a list 'vertex_indices' of -1 values"},
    {"a.ply", ply(vertices + faces, "0 0 0\n1 0 0\n0 1 0\n2.5 0 1 2\n"), "a list 'vertex_indices' of 2.5 values"},
    {"a.ply", ply(faces + vertices, "3 0 1 3\n0 0 0\n1 0 0\n0 1 0\n"), "line 10: face 0 names the vertex 3, but there are 3 vertices"},
    {"a.ply", ply(vertices + "element tristrips 1\nproperty list int int vertex_indices\n", "0 0 0\n1 0 0\n0 1 0\n4 0 1 2 -2\n"),
     "face 1 names the vertex -2"},
    {"a.ply", as_binary_ply(bumpy_grid(2), true) + "\3", "there is more than the elements that the header announces"},
    {"a.ply", as_binary_ply(bumpy_grid(2), false).substr(0, 400), "is cut off"} };
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

namespace {

// Vertices and faces, as a reader numbers them.
typedef std::pair<std::vector<std::array<double, 3> >, std::vector<std::vector<std::uint32_t> > > Elements;

Elements read_elements(const Folder& folder, const std::string& name, const std::string& content)
{
  const flattening::Polygon_soup soup = flattening::read_soup(folder.write(name, content));
  Elements result{soup.points, {}};
  for(const flattening::Polygon& face : soup.faces)
    result.second.emplace_back(face.begin(), face.end());
  return result;
}

std::string with_line_ends(const std::string& content, const std::string& end)
{
  std::string result;
  for(char c : content)
    result += c == '\n' ? end : std::string(1, c);
  return result;
}

// After the first and before the last word of each line that begins with one of these.
std::string with_continued_lines(const std::string& content, const std::string& end)
{
  std::istringstream in(content);
  std::string result;
  for(std::string line; std::getline(in, line); )
  {
    if(line[0] == 'v' || line[0] == 'f')
    {
      const std::size_t first = line.find(' '), last = line.rfind(' ');
      line = line.substr(0, first) + "\\" + end + line.substr(first, last - first) + "  \\" + end + line.substr(last + 1);
    }
    result += line + end;
  }
  return result;
}

std::string upper_case(std::string text)
{
  for(char& c : text)
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

} // namespace

// A byte order mark, line ends of any kind, padding at the end: the same mesh.
BOOST_AUTO_TEST_CASE(dressed_files)
{
  const Folder folder;
  const Soup soup = bumpy_grid(3);
  const std::string mark = "\xEF\xBB\xBF";
  const std::vector<std::pair<const char*, std::string> > texts = {
    {"a.off", as_off(soup)}, {"a.obj", as_obj(soup)}, {"a.ply", as_text_ply(soup)}, {"a.stl", as_text_stl(soup)} };
  for(const auto& file : texts)
    BOOST_TEST_CONTEXT(file.first)
    {
      const auto read = [&](const std::string& content) { return read_elements(folder, file.first, content); };
      const Elements plain = read(file.second);
      BOOST_TEST(plain.first.size() == soup.points.size());
      BOOST_TEST(plain.second.size() == soup.triangles.size());
      for(const char* end : {"\n", "\r\n", "\r"})
        BOOST_TEST((read(mark + with_line_ends(file.second, end)) == plain));
      BOOST_TEST((read(file.second.substr(0, file.second.size() - 1)) == plain)); // the last line has no end
      BOOST_TEST((read(file.second + "\n \x1a") == plain));
      BOOST_TEST((read(file.second + std::string(5, '\0')) == plain));
    }
  const Elements plain = read_elements(folder, "a.off", as_off(soup));
  for(const char* end : {"\n", "\r\n", "\r"})
    BOOST_TEST((read_elements(folder, "a.obj", with_continued_lines(as_obj(soup), end)) == plain));
  for(bool is_big : {false, true})
    BOOST_TEST((read_elements(folder, "a.ply", mark + as_binary_ply(soup, is_big) + "\r\n") == plain));

  // conditions, too
  const std::string input = folder.write("grid.off", as_off(soup));
  BOOST_TEST(run({input, "--cones", folder.write("cones.txt", mark + "5 300 # a cone\r6 420\r")}).status == 0);
}

// The data of a binary PLY file may begin with what might be the end of the header's last line.
BOOST_AUTO_TEST_CASE(binary_data_that_look_like_line_ends)
{
  const Folder folder;
  Soup soup = bumpy_grid(1);
  for(const char byte : {'\n', '\r', ' '})
  {
    double x = 0.5; // with this byte where the file has it first
    std::memcpy(reinterpret_cast<char*>(&x) + (flattening::is_big_endian() ? 7 : 0), &byte, 1);
    soup.points[0][0] = x;
    const Elements plain = read_elements(folder, "a.off", as_off(soup));
    const std::string bytes = as_binary_ply(soup, false);
    const std::size_t end = bytes.find("end_header\n") + 11;
    for(const char* line_end : {"\n", "\r\n", "\r"})
      BOOST_TEST((read_elements(folder, "a.ply", with_line_ends(bytes.substr(0, end), line_end) + bytes.substr(end)) == plain));
  }
}

// What formats allow besides the most usual forms.
BOOST_AUTO_TEST_CASE(forms_of_files)
{
  const Folder folder;
  const auto read = [&](const char* name, const std::string& content) { return read_elements(folder, name, content); };
  const std::string v = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const Elements square = read("a.obj", v + "f 1 2 3\nf 1 3 4\n");
  BOOST_TEST((square.second == std::vector<std::vector<std::uint32_t> >{{0, 1, 2}, {0, 2, 3}}));
  for(const char* faces : {"f 1/ 2/7 3//\nf 1//2 3/4/5 4\n", "fo 1 2 3\nfo -4 -2 -1\n", "f +1 2 3 # 4\nl 1 2\nf 1 3 4\n"})
    BOOST_TEST((read("a.obj", v + faces) == square));
  BOOST_TEST((read("a.obj", "f 1 2 3\nf 1 3 4\nv 0 0 0 1\nv 1 0 0 .1 .2 .3\nv 1 1 0 1 .5 .5 .5\nv 0 1 0\n") == square));

  const std::string vertices = "element vertex 4\nproperty int x\nproperty float y\nproperty double z\n",
                    strips = "element tristrips 1\nproperty list int int vertex_indices\n",
                    faces = "element face 2\nproperty uchar label\nproperty list uchar uint vertex_index\nproperty list uchar float texcoord\n",
                    points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const auto ply = [&](const std::string& body) { return read("a.ply", "ply\nformat ascii 1.0\n" + body); };
  BOOST_TEST((ply(vertices + faces + "end_header\n" + points + "7 3 0 1 2 6 0 0 1 0 1 1\n7 3 0 2 3 0\n") == square));
  BOOST_TEST((ply(faces + vertices + "end_header\n7 3 0 1 2 0\n7 3 0 2 3 0\n" + points) == square));
  BOOST_TEST((ply(vertices + strips + "end_header\n" + points + "7 0 1 2 -1 0 2 3\n") == square));
  BOOST_TEST((ply(strips + vertices + "end_header\n8 0 1 2 -1 -1 0 2 3\n" + points) == square));
  // every other triangle is turned over; triangles with a vertex twice lead on, and count
  const Elements strip = ply(vertices + strips + "end_header\n" + points + "4 1 2 0 3\n");
  BOOST_TEST((strip.second == std::vector<std::vector<std::uint32_t> >{{1, 2, 0}, {0, 2, 3}}));
  const Elements stitched = ply(vertices + strips + "end_header\n" + points + "8 0 1 2 2 2 2 0 3\n");
  BOOST_TEST((stitched.second == std::vector<std::vector<std::uint32_t> >{{0, 1, 2}, {0, 2, 3}}));

  BOOST_TEST((read("a.off", "4OFF 4 2\n0 0 0 2\n2 0 0 2\n1 1 0 1\n0 .5 0 .5\n3 0 1 2 255 0 0\n3 0 2 3\n") == square));
  BOOST_TEST((read("a.off", "COFF\n4 2 5\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n1 1 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2\n3 0 2 3") == square));

  // polygons stay as they are
  for(const auto& file : std::vector<std::pair<const char*, std::string> >{
        {"a.obj", v + "f 1 2 3\\\n 4\n"}, {"a.off", "OFF 4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"},
        {"a.ply", "ply\nformat ascii 1.0\n" + vertices + replaced(faces, "face 2", "face 1") + "end_header\n" + points + "0 4 0 1 2 3 0\n"},
        {"a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n"}})
    BOOST_TEST((read(file.first, file.second) == Elements{square.first, {{0, 1, 2, 3}}}));
}

BOOST_AUTO_TEST_CASE(forms_of_stl)
{
  const Folder folder;
  const Soup soup = bumpy_grid(3);
  const auto read = [&](const std::string& content) { return read_elements(folder, "a.stl", content); };
  const std::string text = as_text_stl(soup), bytes = as_binary_stl(soup);
  const Elements from_text = read(text), from_bytes = read(bytes);
  BOOST_TEST((from_text.second == from_bytes.second));
  for(const std::string& other : {replaced(text, "endsolid", "end solid"), upper_case(text), replaced(text, "endfacet", "end facet"),
                                  replaced(text, "normal 0 0 1", "normal nan nan nan"), replaced(text, "normal 0 0 1", ""),
                                  "  \n" + replaced(text, "\n", "\n\t"), replaced(text, "grid of facets", ""),
                                  replaced(text, "grid of facets", "facet vertex 1 2 3 endsolid")})
    BOOST_TEST((read(other) == from_text));
  BOOST_TEST((read(bytes + "tail") == from_bytes));
  BOOST_TEST((read("SOLID" + bytes.substr(5) + "tail") == from_bytes));
  const Run r = run({folder.write("b.stl", bytes + "tail")});
  BOOST_TEST(r.status == 0);
  BOOST_TEST(contains(r.err, "b.stl: skipped 4 bytes after the last triangle\n"));

  // two solids
  const std::size_t half = text.find("facet normal", text.size() / 2);
  BOOST_TEST((read(text.substr(0, half) + "endsolid\nsolid two\n" + text.substr(half)) == from_text));
}

// What is skipped is said, once, and does no harm.
BOOST_AUTO_TEST_CASE(notices)
{
  const Folder folder;
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\ng one\ns 1\nusemtl m\nf 1 2 3\nf 1 3 4\n";
  const auto said = [&](const char* name, const std::string& content)
  {
    const std::string input = folder.write(name, content);
    const Run r = run({input, "-o", folder / "o.obj"}), quiet = run({input, "--quiet"});
    BOOST_TEST(r.status == 0);
    BOOST_TEST(quiet.status == 0);
    BOOST_TEST(quiet.err == "");
    BOOST_TEST(! r.out.empty());
    const std::string begin = "flatten_mesh: " + input + ": ";
    return r.err.substr(0, begin.size()) == begin ? r.err.substr(begin.size()) : r.err;
  };
  BOOST_TEST(said("a.obj", square) == "");
  BOOST_TEST(said("a.obj", square + "l 1 2\nvp 0.5\nl 2 3\n-- a line --\n") == "skipped lines: '--' (1), 'l' (2), 'vp' (1)\n");
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST(run({folder / "a.obj", "--report", folder / "r.json", "--quiet"}).status == 0);
  BOOST_TEST(json(folder / "r.json")["notices"]
             == nlohmann::json::array({ (folder / "a.obj") + ": skipped lines: '--' (1), 'l' (2), 'vp' (1)" }));
#endif
  BOOST_TEST(said("a.obj", square.substr(0, square.size() - 8) + "f 1//1 3//1 4//2\n")
             == "skipped the normals of 1 face, where not every corner has one\n");
  BOOST_TEST(said("a.ply", "ply\nformat ascii 1.0\nelement edge 2\nproperty int a\nproperty int b\n"
                           "element vertex 3\nproperty float x\nproperty float y\n"
                           "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                           "0 1\n1 2\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
             == "skipped 2 elements 'edge'\n");
  BOOST_TEST(said("a.stl", "solid\ncolor 1 0 0\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\nendsolid\n")
             == "skipped words: 'color' (1)\n");
}

namespace {

// What an OBJ file says of a face: the last lines o, g, usemtl and s before it, and the normals of its corners.
struct Said_of_face
{
  std::map<std::string, std::string> lines;
  std::vector<std::string> normals;

  bool operator==(const Said_of_face& other) const { return lines == other.lines && normals == other.normals; }
};

std::vector<Said_of_face> said_of_faces(const std::string& obj)
{
  std::vector<Said_of_face> result;
  std::map<std::string, std::string> lines;
  std::vector<std::string> normals;
  std::istringstream in(obj);
  for(std::string line; std::getline(in, line); )
  {
    const std::size_t space = (std::min)(line.find(' '), line.size());
    const std::string key = line.substr(0, space), rest = space < line.size() ? line.substr(space + 1) : "";
    if(key == "o" || key == "g" || key == "usemtl" || key == "s")
      lines[key] = rest;
    if(key == "vn")
      normals.push_back(rest);
    if(key != "f")
      continue;
    result.push_back({lines, {}});
    std::istringstream corners(rest);
    for(std::string corner; corners >> corner; )
      if(std::count(corner.begin(), corner.end(), '/') == 2)
        result.back().normals.push_back(normals.at(std::stoul(corner.substr(corner.rfind('/') + 1)) - 1));
  }
  return result;
}

// Where faces are in another order, some may come back to what held before the first line. (There are no such words for an object.)
std::map<std::string, std::string> with_defaults(std::map<std::string, std::string> lines)
{
  lines.emplace("g", "default");
  lines.emplace("s", "off");
  lines.erase("o");
  return lines;
}

std::string lines_with(const std::string& key, const std::string& obj)
{
  std::istringstream in(obj);
  std::string result;
  for(std::string line; std::getline(in, line); )
    if(line.compare(0, key.size() + 1, key + ' ') == 0)
      result += line.substr(key.size() + 1) + '\n';
  return result;
}

// Its intrinsic Delaunay triangulation is another one.
testing::Soup spiky_icosahedron()
{
  testing::Soup soup = testing::icosphere(1);
  for(std::size_t i = 0; i < soup.points.size(); i += 2)
    for(double& x : soup.points[i])
      x *= 3;
  return soup;
}

// A grid in several groups, materials and smoothing groups; every third face has no normals.
std::string as_obj_with_attributes(const Soup& soup, bool has_materials_at_once)
{
  std::ostringstream out;
  out << "mtllib my colours.mtl\nmtllib a.mtl b.mtl\n";
  for(std::size_t v = 0; v < soup.points.size(); ++v)
    out << "v " << point(soup.points[v]) << "\nvn 0 " << v << " 1\n";
  const std::map<std::size_t, std::string> lines = { {0, has_materials_at_once ? "usemtl green\n" : ""}, {1, "g one\n"},
                                                     {3, "o thing\ns 1\nusemtl red\n"},
    {5, "g two \\\n  three\n"}, {6, "usemtl light blue\ns off\n"}, {7, "g\ng four\n"} };
  for(std::size_t f = 0; f < soup.triangles.size(); ++f)
  {
    if(lines.count(f) != 0)
      out << lines.at(f);
    out << 'f';
    for(std::uint32_t v : soup.triangles[f])
      out << ' ' << v + 1 << (f % 3 == 2 ? "" : "//" + std::to_string(v + 1));
    out << '\n';
  }
  return out.str();
}

} // namespace

BOOST_AUTO_TEST_CASE(what_obj_files_say_of_faces_is_kept)
{
  const Folder folder;
  fs::create_directory(folder.path / "in");
  fs::create_directory(folder.path / "out");
  folder.write("in/my colours.mtl", "newmtl red\n");
  const std::string obj = as_obj_with_attributes(bumpy_grid(2), false), input = folder.write("in/a.obj", obj);
  std::vector<Said_of_face> expected = said_of_faces(replaced(obj, "\\\n  ", ""));
  for(Said_of_face& face : expected) // those without a material get one
    face.lines.emplace("usemtl", "layout");
  const Run r = run({input, "-o", folder / "out/o.obj"});
  BOOST_TEST(r.err == "");
  const std::string written = content(folder / "out/o.obj");
  BOOST_TEST((said_of_faces(written) == expected));
  BOOST_TEST(lines_with("g", written) == "one\ntwo three\nfour\n");
  BOOST_TEST(lines_with("mtllib", written) == "o.mtl\n../in/my colours.mtl\n../in/a.mtl ../in/b.mtl\n");
  BOOST_TEST(run({folder / "out/o.obj", "-o", folder / "out/p.obj"}).status == 0);
  BOOST_TEST((said_of_faces(content(folder / "out/p.obj")) == expected));

  // Where all faces have a material, there is no need for another one.
  const std::string coloured = as_obj_with_attributes(bumpy_grid(2), true);
  BOOST_TEST(run({folder.write("in/b.obj", coloured), "-o", folder / "in/q.obj"}).status == 0);
  const std::string as_coloured = content(folder / "in/q.obj");
  BOOST_TEST((said_of_faces(as_coloured) == said_of_faces(replaced(coloured, "\\\n  ", ""))));
  BOOST_TEST(lines_with("mtllib", as_coloured) == "my colours.mtl\na.mtl b.mtl\n");
  BOOST_TEST(! fs::exists(folder / "in/q.mtl"));
  BOOST_TEST(! fs::exists(folder / "in/q.checker.png"));
}

// Of polygons; of the parts of a refinement, each of which lies in a face of the file; on the sphere.
BOOST_AUTO_TEST_CASE(what_is_said_of_faces_is_kept_in_other_meshes)
{
  const Folder folder;
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 .1\nv 0 1 0\nv 2 0 0\nvn 0 0 1\nvn 0 1 1\ng a\nf 1//1 2//2 3//1 4//2\ng b\nf 2//1 5//1 3//2\n";
  BOOST_TEST(run({folder.write("square.obj", square), "-o", folder / "o.obj", "--quiet"}).status == 0);
  std::vector<Said_of_face> expected = said_of_faces(square);
  for(Said_of_face& face : expected)
    face.lines.emplace("usemtl", "layout");
  BOOST_TEST((said_of_faces(content(folder / "o.obj")) == expected));

  const Soup grid = bumpy_grid(4);
  const std::string obj = as_obj_with_attributes(grid, true);
  const std::vector<Said_of_face> said = said_of_faces(replaced(obj, "\\\n  ", ""));
  const Run r = run({folder.write("grid.obj", obj), "-o", folder / "r.obj", "--retriangulate", "always", "--refine"});
  BOOST_TEST(r.status == 0);
  BOOST_TEST(contains(r.err, "its normals are not written"));
  const std::vector<Said_of_face> of_parts = said_of_faces(content(folder / "r.obj"));
  const checking::Surface parts = checking::read_surface(folder / "r.obj");
  BOOST_REQUIRE(of_parts.size() == parts.faces.size());
  BOOST_TEST(of_parts.size() > said.size()); // edges were flipped
  for(std::size_t f = 0; f < of_parts.size(); ++f)
  {
    double x = 0, y = 0; // the surface is a height field: of squares divided by the diagonal x = y
    for(std::size_t v : parts.faces[f])
    {
      x += 4 * parts.points[v][0] / 3;
      y += 4 * parts.points[v][1] / 3;
    }
    const std::size_t i = std::size_t(x), j = std::size_t(y), given = 2 * (4 * j + i) + (y - double(j) > x - double(i));
    BOOST_TEST((with_defaults(of_parts[f].lines) == with_defaults(said[given].lines)));
  }

  std::string closed = "s 1\n";
  for(std::size_t f = 0; f < 8; ++f) // an octahedron
  {
    const std::size_t x = 1 + f % 2, y = 3 + f / 2 % 2, z = 5 + f / 4;
    const bool is_even = (f % 2 + f / 2 % 2 + f / 4) % 2 == 0;
    closed += "g " + std::to_string(f) + "\nf " + std::to_string(x) + ' ' + std::to_string(is_even ? y : z) + ' '
            + std::to_string(is_even ? z : y) + '\n';
  }
  closed = "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n" + closed;
  BOOST_TEST(run({folder.write("closed.obj", closed), "--target", "sphere", "-o", folder / "s.obj"}).status == 0);
  BOOST_TEST((said_of_faces(content(folder / "s.obj")) == said_of_faces(closed)));
}

// With a weight before it, too; of polygons, on the sphere, and of a surface that was repaired, but not of a refined mesh.
BOOST_AUTO_TEST_CASE(colours_of_vertices_are_kept)
{
  const Folder folder;
  const std::string faces = "f 1 2 3 4\nf 2 5 3\n";
  const std::string square = "v 0 0 0 1 0 0.5\nv 1 0 0 1 0.25 0.125 0\nv 1 1 .1\nv 0 1 0 1\nv 2 0 0 0.1 0.2 0.3\n" + faces;
  const std::string coloured = "0 0 0 1 0 0.5\n1 0 0 0.25 0.125 0\n1 1 0.1\n0 1 0\n2 0 0 0.1 0.2 0.3\n";
  for(const std::vector<std::string>& options : { std::vector<std::string>{}, {"--repair"}, {"--projective", "--precision", "80"} })
  {
    const Run r = run(with({folder.write("a.obj", square), "-o", folder / "o.obj"}, options));
    BOOST_TEST(r.status == 0);
    if(options.size() > 1)
      BOOST_TEST(contains(r.err, "texture coordinates of the OBJ file are homogeneous"));
    else
      BOOST_TEST(r.err == "");
    BOOST_TEST(lines_with("v", content(folder / "o.obj")) == coloured);
  }
  BOOST_TEST(run({folder / "o.obj", "-o", folder / "p.obj"}).status == 0);
  BOOST_TEST(lines_with("v", content(folder / "p.obj")) == coloured);

  // in PLY as bytes, of which these are multiples
  std::string in_bytes = coloured;
  const std::vector<std::pair<std::string, std::string> > changes = {{"0.5", "0.6"}, {"0.25 0.125", "0.2 0.4"}, {"0.1 0.2 0.3", "0.8 0.2 0.4"},
                                                                     {"1 1 0.1", "1 1 0.1 1 1 1"}, {"0 1 0\n", "0 1 0 1 1 1\n"}};
  for(const auto& [from, to] : changes)
    in_bytes = replaced(in_bytes, from, to);
  std::string given;
  std::istringstream vertices(in_bytes);
  for(std::string line; std::getline(vertices, line);)
    given += "v " + line + '\n';
  BOOST_TEST(run({folder.write("c.obj", given + faces), "-o", folder / "c.ply"}).err == "");
  BOOST_TEST(run({folder / "c.ply", "-o", folder / "d.obj"}).err == "");
  BOOST_TEST(lines_with("v", content(folder / "d.obj")) == in_bytes);
  const Run off = run({folder.write("c.off", "COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2\n"), "-o", folder / "e.obj"});
  BOOST_TEST(contains(off.err, "skipped the colours of vertices"));

  const testing::Soup sphere = spiky_icosahedron();
  std::string obj;
  for(const auto& p : sphere.points)
    obj += "v " + point(p) + " 0.5 0.25 1\n";
  for(const auto& t : sphere.triangles)
    obj += "f " + std::to_string(t[0] + 1) + ' ' + std::to_string(t[1] + 1) + ' ' + std::to_string(t[2] + 1) + '\n';
  const std::string input = folder.write("s.obj", obj);
  BOOST_TEST(run({input, "-o", folder / "o.obj", "--target", "sphere"}).err == "");
  std::istringstream lines(lines_with("v", content(folder / "o.obj")));
  std::size_t number = 0;
  for(std::string line; std::getline(lines, line); ++number)
    BOOST_TEST(contains(line, " 0.5 0.25 1"));
  BOOST_TEST(number == sphere.points.size());

  const std::string lost = "the colours of its vertices are not written: they are not those of the mesh that is written";
  std::vector<std::string> arguments = {input, "-o", folder / "o.obj", "--target", "sphere", "--retriangulate", "always", "--refine"};
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  arguments.insert(arguments.end(), {"--report", folder / "o.json"});
#endif
  const Run r = run(arguments);
  BOOST_TEST(r.status == 0);
  BOOST_TEST(r.err == "flatten_mesh: " + input + ": " + lost + "\n");
  BOOST_TEST(! contains(content(folder / "o.obj"), "0.5 0.25 1"));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST(json(folder / "o.json")["notices"] == nlohmann::json::array({ input + ": " + lost }));
#endif
}

// Around a vertex of many faces, too, time is linear: in 100 000 triangles quadratic time would be more than ten seconds.
BOOST_AUTO_TEST_CASE(large_fan)
{
  const Folder folder;
  const std::uint32_t n = 100000;
  Soup soup;
  soup.points.push_back({{ 0, 0, 0 }});
  for(std::uint32_t i = 0; i < n; ++i)
  {
    soup.points.push_back({{ std::cos(2 * CGAL_PI * i / n), std::sin(2 * CGAL_PI * i / n), .1 }});
    soup.triangles.push_back({{ 0, i + 1, (i + 1) % n + 1 }});
  }
  const std::string input = folder.write("fan.off", as_off(soup));
  const std::clock_t begin = std::clock();
  Mesh mesh;
  flattening::read_surface(input, false, mesh);
  BOOST_TEST(double(std::clock() - begin) / CLOCKS_PER_SEC < 6);
  BOOST_TEST(mesh.number_of_faces() == n);
  BOOST_TEST(mesh.is_valid(false));
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

// ------------------------------------------------------------------------------------------------
// Faces with more than three sides, and surfaces that are repaired
// ------------------------------------------------------------------------------------------------

namespace {

// An OBJ file, with faces of any number of sides.
struct Obj
{
  typedef std::vector<std::size_t> Indices;
  std::vector<std::array<double, 3> > points;
  std::vector<std::array<double, 2> > places;
  std::vector<Indices> faces, corners; // of each face the vertices, and the places in the layout

  explicit Obj(const std::string& file)
  {
    std::ifstream in(file);
    for(std::string line; std::getline(in, line); )
    {
      std::istringstream words(line);
      std::string key;
      words >> key;
      if(key == "v" && points.emplace_back().size() != 0)
        words >> points.back()[0] >> points.back()[1] >> points.back()[2];
      else if(key == "vt" && places.emplace_back().size() != 0)
        words >> places.back()[0] >> places.back()[1];
      else if(key == "f")
        read_face(words);
    }
  }

  std::array<double, 2> place(std::size_t f, std::size_t k) const { return places.at(corners.at(f).at(k)); }

  double area(std::size_t f) const
  {
    double sum = 0;
    for(std::size_t k = 0; k < faces[f].size(); ++k)
    {
      const auto p = place(f, k), q = place(f, (k + 1) % faces[f].size());
      sum += (p[0] * q[1] - p[1] * q[0]) / 2;
    }
    return sum;
  }

private:
  void read_face(std::istringstream& words)
  {
    faces.emplace_back();
    corners.emplace_back();
    std::size_t v, vt;
    char slash;
    for(std::string corner; words >> corner; )
    {
      std::istringstream of_corner(corner);
      of_corner >> v;
      faces.back().push_back(v - 1);
      if(of_corner >> slash >> vt)
        corners.back().push_back(vt - 1);
    }
  }
};

// The largest difference of a distance between corners of the same face in the layout, in units of `scale`, and in space.
double largest_difference_of_distances(const Obj& obj, double scale = 1)
{
  double largest = 0;
  for(std::size_t f = 0; f < obj.faces.size(); ++f)
    for(std::size_t j = 0; j < obj.faces[f].size(); ++j)
      for(std::size_t k = 0; k < j; ++k)
      {
        const auto p = obj.place(f, j), q = obj.place(f, k);
        const auto &x = obj.points.at(obj.faces[f][j]), &y = obj.points.at(obj.faces[f][k]);
        largest = (std::max)(largest, std::abs(std::hypot(p[0] - q[0], p[1] - q[1]) / scale - std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2])));
      }
  return largest;
}

std::size_t number_of_borders(const Obj& obj)
{
  std::map<std::set<std::size_t>, int> sides;
  for(const auto& c : obj.corners)
    for(std::size_t k = 0; k < c.size(); ++k)
      ++sides[{c[k], c[(k + 1) % c.size()]}];
  return std::size_t(std::count_if(sides.begin(), sides.end(), [](const auto& side) { return side.second == 1; }));
}

// Runs the program, which succeeds, and reads what it has written.
Obj flattened(const Folder& folder, const std::string& input, const std::vector<std::string>& options = {})
{
  const Run r = run(with({input, "-o", folder / "o.obj", "--quiet"}, options));
  BOOST_TEST_CONTEXT(input << ": " << r.err)
  BOOST_REQUIRE(r.status == 0);
  return Obj(folder / "o.obj");
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
typedef std::map<std::string, std::size_t> Counts;

// What was repaired, without what was not.
Counts repairs(const Folder& folder, const std::string& input)
{
  const Run r = run({input, "--repair", "--quiet", "--report", folder / "o.json"});
  BOOST_TEST_CONTEXT(input << ": " << r.err)
  BOOST_REQUIRE(r.status == 0);
  Counts counts;
  const nlohmann::json report = json(folder / "o.json");
  for(const auto& count : report["repair"].items())
    if(count.value() != 0)
      counts[count.key()] = count.value().get<std::size_t>();
  return counts;
}
#endif

} // namespace

// On a sheet that is bent, and not stretched, the layout is an isometry of each face, whatever triangles are computed with.
BOOST_AUTO_TEST_CASE(polygons_are_written_as_they_were)
{
  const Folder folder;
  const std::string points = "0 0 0\n2 0 0\n2 2 0\n0 2 0\n1 1 0\n3 0 1\n3 2 1\n3 1 1\n5 0 1\n4 .25 1\n5 2 1\n",
                    faces = "5 0 1 2 3 4\n3 0 4 3\n5 1 5 7 6 2\n6 5 8 9 10 6 7\n";
  const Obj obj = flattened(folder, folder.write("sheet.off", off(points, faces)));
  const std::vector<Obj::Indices> expected = { {0, 1, 2, 3, 4}, {0, 4, 3}, {1, 5, 7, 6, 2}, {5, 8, 9, 10, 6, 7} };
  BOOST_TEST((obj.faces == expected));
  BOOST_TEST(obj.points.size() == 11u);
  BOOST_TEST(obj.places.size() == 11u); // nothing is cut: one place a vertex
  for(std::size_t f = 0; f < obj.faces.size(); ++f)
  {
    BOOST_TEST(obj.corners[f].size() == obj.faces[f].size());
    BOOST_TEST(obj.area(f) > 0);
  }
  BOOST_TEST(largest_difference_of_distances(obj) < testing::few_residuals); // lengths of 5

  // the same from other formats
  std::ostringstream ply;
  ply << "ply\nformat ascii 1.0\nelement vertex 11\nproperty double x\nproperty double y\nproperty double z\nelement face 4\n"
      << "property list uchar int vertex_indices\nend_header\n" << points << faces;
  const Obj from_ply = flattened(folder, folder.write("sheet.ply", ply.str()));
  BOOST_TEST((from_ply.faces == expected));
  BOOST_TEST((from_ply.places == obj.places));
  const Obj again = flattened(folder, folder.write("again.obj", content(folder / "o.obj")));
  BOOST_TEST((again.faces == expected));
  BOOST_TEST((again.places == obj.places));

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST(run({folder / "sheet.off", "--quiet", "--report", folder / "o.json"}).status == 0);
  const nlohmann::json report = json(folder / "o.json");
  BOOST_TEST(report["vertices"] == 11);
  BOOST_TEST(report["faces"] == 4);
  BOOST_TEST(report["triangles"] == 3 + 1 + 3 + 4);
  BOOST_TEST(report["repair"].is_null());
#endif
}

// A cube is flat but for its corners, cones of 270 degrees. Its squares are cut from each other along edges, and never along diagonals.
BOOST_AUTO_TEST_CASE(polygons_are_not_cut)
{
  const Folder folder;
  const std::string cube = folder.write("cube.off", off("0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n",
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"));
  const std::string cones = folder.write("cones.txt", cone_lines({0, 1, 2, 3, 4, 5, 6, 7}, "270"));
  for(const std::vector<std::string>& options : std::vector<std::vector<std::string> >{ {}, {"--precision", "100"}, {"--seamless", "--tiles", "6"} })
  {
    const Obj obj = flattened(folder, cube, with({"--cones", cones}, options));
    BOOST_TEST(obj.faces.size() == 6u);
    const double scale = std::sqrt(obj.area(0));
    BOOST_TEST(largest_difference_of_distances(obj, scale) < testing::summed_residuals);
    BOOST_TEST(number_of_borders(obj) == 14u); // twelve edges are cut but for the five between six squares in one piece
  }
  const Obj sphere = flattened(folder, cube, {"--target", "sphere"});
  BOOST_TEST((sphere.faces == Obj(folder.write("c.obj", "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")).faces));
  for(const auto& p : sphere.points)
    BOOST_TEST(std::hypot(p[0], p[1], p[2]) == 1, boost::test_tools::tolerance(100 * testing::unit_roundoff));
}

// Polygons that have no normal, or cross themselves, are divided, too.
BOOST_AUTO_TEST_CASE(odd_polygons)
{
  const Folder folder;
  const auto accepted = [&](const std::string& points, const std::string& faces)
  {
    const std::string input = folder.write("a.off", off(points, faces));
    const Run r = run({input, "-o", folder / "o.obj", "--quiet"});
    BOOST_TEST_CONTEXT(points << faces << r.err)
    BOOST_TEST(r.status == 0);
  };
  accepted("0 0 0\n1 1 0\n1 0 0\n0 1 0\n", "4 0 1 2 3\n");                       // crosses itself, its normal is zero
  accepted("0 0 0\n3 0 0\n1 2 0\n2 -1 0\n1.5 3 0\n", "5 0 1 2 3 4\n");           // crosses itself
  accepted("0 0 0\n1 0 .5\n2 0 0\n2 1 .5\n2 2 0\n0 2 1\n", "6 0 1 2 3 4 5\n");  // is not flat
}

// Faces that share no vertices, as in many files: the layout is that of the surface, and vertices and faces are as they were.
BOOST_AUTO_TEST_CASE(repair_merges_equal_points)
{
  const Folder folder;
  const Soup soup = bumpy_grid(6);
  Soup apart;
  for(const auto& t : soup.triangles)
  {
    apart.triangles.emplace_back();
    for(std::size_t k = 0; k < 3; ++k)
    {
      apart.triangles.back()[k] = static_cast<std::uint32_t>(apart.points.size());
      apart.points.push_back(soup.points[t[k]]);
    }
  }
  const Obj whole = flattened(folder, folder.write("whole.off", as_off(soup)));
  const Obj obj = flattened(folder, folder.write("apart.off", as_off(apart)), {"--repair"});
  BOOST_TEST((obj.points == apart.points));
  BOOST_REQUIRE(obj.faces.size() == whole.faces.size());
  double largest = 0;
  for(std::size_t f = 0; f < obj.faces.size(); ++f)
    for(std::size_t k = 0; k < 3; ++k)
    {
      BOOST_TEST(obj.faces[f][k] == 3 * f + k);
      const auto p = obj.place(f, k), q = whole.place(f, k);
      largest = (std::max)(largest, std::hypot(p[0] - q[0], p[1] - q[1]));
    }
  BOOST_TEST(largest < testing::few_residuals); // the frame of the layout is canonical, and the diameter about 1
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  const std::size_t inner_edges = (3 * soup.triangles.size() - 4 * 6) / 2;
  BOOST_TEST((repairs(folder, folder / "apart.off")
              == Counts{ {"merged_vertices", apart.points.size() - soup.points.size()}, {"stitched_edges", inner_edges} }));
  BOOST_TEST((repairs(folder, folder / "whole.off") == Counts()));
#endif

  // a condition for any of the equal vertices is one for the point
  const std::string angles = folder.write("angles.txt", std::to_string(obj.faces[2][0]) + " 150\n");
  BOOST_TEST(run({folder / "apart.off", "--repair", "--quiet", "--boundary", "angles=" + angles}).status == 0);

  // to the sphere: all copies of a point have the same image
  const testing::Soup ball = testing::icosphere(1);
  Soup pieces;
  for(const auto& t : ball.triangles)
  {
    const std::uint32_t n = static_cast<std::uint32_t>(pieces.points.size());
    pieces.triangles.push_back({{ n, n + 1, n + 2 }});
    for(std::uint32_t v : t)
      pieces.points.push_back(ball.points[v]);
  }
  const Obj sphere = flattened(folder, folder.write("ball.off", as_off(pieces)), {"--repair", "--target", "sphere"});
  BOOST_REQUIRE(sphere.points.size() == pieces.points.size());
  for(std::size_t i = 0; i < pieces.points.size(); ++i)
    for(std::size_t j = 0; j < i; ++j)
      BOOST_TEST((pieces.points[i] == pieces.points[j]) == (sphere.points[i] == sphere.points[j]));
}

// Faces that are dropped lie where their points lie; those that are turned are turned in the file, too.
BOOST_AUTO_TEST_CASE(repair_of_faces)
{
  const Folder folder;
  // two squares; the second upside down; the first again, from its other side; a face without area, and one that passes a point twice
  const std::string points = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n2 1 0\n1 0 0\n3 0 0\n3 1 0\n";
  const std::string input = folder.write("faces.off", off(points, "4 0 1 2 3\n4 1 2 5 4\n4 3 2 1 0\n3 1 6 2\n5 4 7 8 5 4\n2 0 1\n"));
  check_refused({input}, 1, "--repair");
  const Obj obj = flattened(folder, input, {"--repair"});
  const std::vector<Obj::Indices> expected = { {0, 1, 2, 3}, {4, 5, 2, 1}, {0, 1, 2, 3}, {1, 6, 2}, {4, 7, 8, 5, 4}, {0, 1} };
  BOOST_TEST((obj.faces == expected));
  BOOST_TEST((obj.corners[2] == obj.corners[0]));
  BOOST_TEST(obj.corners[3][0] == obj.corners[3][1]);
  for(std::size_t f : {0, 1, 2, 4})
    BOOST_TEST(obj.area(f) == 1, boost::test_tools::tolerance(testing::few_residuals));
  BOOST_TEST(largest_difference_of_distances(obj) < testing::few_residuals);
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST((repairs(folder, input) == Counts{ {"merged_vertices", 1}, {"degenerate_faces", 2}, {"duplicate_faces", 1}, {"turned_faces", 1} }));
#endif

  // a face that passes a vertex twice is divided there
  const std::string pinched = folder.write("pinched.off", off("0 0 0\n1 0 0\n1 1 0\n-1 0 0\n-1 -1 0\n", "6 0 1 2 0 3 4\n"));
  check_refused({pinched}, 1, "face 0 has the vertex 0 twice (--repair");
  const Obj parts = flattened(folder, pinched, {"--repair"});
  BOOST_TEST((parts.faces == std::vector<Obj::Indices>{ {0, 1, 2, 0, 3, 4} }));
  BOOST_TEST(run({folder.write("nothing.off", off("0 0 0\n0 0 0\n1 0 0\n", "3 0 1 2\n")), "--repair"}).status == 1);
}

BOOST_AUTO_TEST_CASE(repair_of_what_is_no_manifold)
{
  const Folder folder;
  // three squares at one edge: three pieces
  const std::string book = folder.write("book.off", off("0 0 0\n0 1 0\n1 0 0\n1 1 0\n-1 0 0\n-1 1 0\n0 0 1\n0 1 1\n",
                                                        "4 0 2 3 1\n4 0 1 5 4\n4 0 1 7 6\n"));
  check_refused({book}, 1, "the edge 0-1 lies in 3 faces (0, 1, ...) (--repair");
  const Obj pages = flattened(folder, book, {"--repair"});
  BOOST_TEST((pages.faces == std::vector<Obj::Indices>{ {0, 2, 3, 1}, {0, 1, 5, 4}, {0, 1, 7, 6} }));
  BOOST_TEST(pages.places.size() == 12u);
  BOOST_TEST(largest_difference_of_distances(pages) < testing::few_residuals);

  // two triangles at one vertex
  const std::string bow = folder.write("bow.off", off("0 0 0\n1 0 0\n1 1 0\n-1 0 0\n-1 -1 0\n", "3 0 1 2\n3 0 3 4\n"));
  check_refused({bow}, 1, "more than one fan (--repair");
  BOOST_TEST(flattened(folder, bow, {"--repair"}).places.size() == 6u);
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST((repairs(folder, book) == Counts{ {"non_manifold_edges", 1}, {"copied_vertices", 4} }));
  BOOST_TEST((repairs(folder, bow) == Counts{ {"copied_vertices", 1} }));
#endif
  check_refused({bow, "--repair", "--boundary", "scale=" + folder.write("u.txt", "0 .1\n")}, 1, "u.txt: line 1: vertex 0 is several vertices");
  BOOST_TEST(run({bow, "--repair", "--quiet", "--boundary", "scale=" + folder.write("u.txt", "1 .1\n")}).status == 0);

  // of the faces of one piece the fewer are turned, be it the first
  std::string grid = as_off(bumpy_grid(3));
  grid.replace(grid.find("3 0 1 5\n"), 8, "3 0 5 1\n");
  const std::string turned = folder.write("turned.off", grid);
  check_refused({turned}, 1, "opposite orientations");
  BOOST_TEST((flattened(folder, turned, {"--repair"}).faces[0] == Obj::Indices{1, 5, 0}));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  BOOST_TEST((repairs(folder, turned) == Counts{ {"turned_faces", 1} }));
#endif
}

BOOST_AUTO_TEST_CASE(what_cannot_be_oriented)
{
  const Folder folder;
  // a strip of n squares, the last of which meets the first upside down
  const auto strip = [&](int n, bool is_twisted)
  {
    std::ostringstream points, faces;
    for(int i = 0; i < n; ++i)
    {
      const double turn = 2 * CGAL_PI * i / n, half = is_twisted ? turn / 2 : 0;
      for(int side : {-1, 1})
        points << (3 + side * std::cos(half)) * std::cos(turn) << ' ' << (3 + side * std::cos(half)) * std::sin(turn) << ' '
               << side * std::sin(half) << '\n';
      const int j = (i + 1) % n, swap = is_twisted && j == 0 ? 1 : 0;
      faces << "4 " << 2 * i << ' ' << 2 * i + 1 << ' ' << 2 * j + 1 - swap << ' ' << 2 * j + swap << '\n';
    }
    return folder.write("strip.off", off(points.str(), faces.str()));
  };
  BOOST_TEST(run({strip(12, false), "--quiet"}).status == 0);
  for(const std::vector<std::string>& options : std::vector<std::vector<std::string> >{ {}, {"--repair"} })
    check_refused(with({strip(12, true), "-o", folder / "o.obj"}, options), 1, "the surface cannot be oriented");
}

// ------------------------------------------------------------------------------------------------
// What other programs read
// ------------------------------------------------------------------------------------------------

namespace {

typedef std::multimap<std::array<double, 2>, std::array<double, 2> > Segments;

// The directed edges of the layout at which it ends, `scale` times as large: those of borders, or those of seams.
Segments outline(const Obj& obj, bool of_border, double scale)
{
  std::map<std::pair<std::size_t, std::size_t>, std::pair<std::size_t, std::size_t> > sides; // by vertices: the places
  const auto each = [&](const auto& visit)
  {
    for(std::size_t f = 0; f < obj.faces.size(); ++f)
      for(std::size_t k = 0, n = obj.faces[f].size(); k < n; ++k)
        visit(std::make_pair(obj.faces[f][k], obj.faces[f][(k + 1) % n]), std::make_pair(obj.corners[f][k], obj.corners[f][(k + 1) % n]));
  };
  each([&](const auto& edge, const auto& places) { sides[edge] = places; });
  Segments result;
  each([&](const auto& edge, const auto& places)
  {
    const auto other = sides.find({edge.second, edge.first});
    const bool is_border = other == sides.end();
    if(is_border != of_border || (! is_border && other->second == std::make_pair(places.second, places.first)))
      return;
    const auto scaled = [&](std::size_t place) { return std::array<double, 2>{{ obj.places[place][0] * scale, obj.places[place][1] * scale }}; };
    result.emplace(scaled(places.first), scaled(places.second));
  });
  return result;
}

std::size_t number_of_places(const Obj& obj)
{
  std::set<std::pair<std::size_t, std::size_t> > places;
  for(std::size_t f = 0; f < obj.faces.size(); ++f)
    for(std::size_t k = 0; k < obj.faces[f].size(); ++k)
      places.emplace(obj.faces[f][k], obj.corners[f][k]);
  return places.size();
}

// The faces, points and layout are those of the OBJ file, bit for bit; u and the weights are of one scale.
void check_ply(const checking::Ply_file& ply, const Obj& obj)
{
  BOOST_TEST(ply.vertices.size() == number_of_places(obj));
  BOOST_TEST_REQUIRE(ply.faces.size() == obj.faces.size());
  for(std::size_t f = 0; f < obj.faces.size(); ++f)
  {
    BOOST_TEST_REQUIRE(ply.faces[f].size() == obj.faces[f].size());
    for(std::size_t k = 0; k < obj.faces[f].size(); ++k)
    {
      const auto& v = ply.vertices.at(ply.faces[f][k]);
      BOOST_TEST((std::array<double, 3>{{ v.at("x"), v.at("y"), v.at("z") }} == obj.points[obj.faces[f][k]]));
      BOOST_TEST((std::array<double, 2>{{ v.at("s"), v.at("t") }} == obj.place(f, k)));
      BOOST_TEST(v.at("vertex") == double(obj.faces[f][k]));
    }
  }
  double largest = 0, least_u = std::numeric_limits<double>::infinity();
  for(const auto& v : ply.vertices)
  {
    largest = (std::max)(largest, v.at("weight"));
    least_u = (std::min)(least_u, v.at("log_scale_factor"));
  }
  BOOST_TEST(largest == 1.);
  for(const auto& v : ply.vertices)
    BOOST_TEST(std::abs(v.at("weight") * std::exp(v.at("log_scale_factor") - least_u) - 1) < testing::rounded_u);
}

// The layout as a surface in the plane.
void check_flat(const Obj& flat, const Obj& obj)
{
  BOOST_TEST(flat.points.size() == number_of_places(obj));
  BOOST_TEST_REQUIRE(flat.faces.size() == obj.faces.size());
  for(std::size_t f = 0; f < obj.faces.size(); ++f)
    for(std::size_t k = 0; k < obj.faces[f].size(); ++k)
      BOOST_TEST((flat.points.at(flat.faces[f].at(k)) == std::array<double, 3>{{ obj.place(f, k)[0], obj.place(f, k)[1], 0 }}));
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
// The triangles of the OBJ file in single precision. The texture has `repetitions` steps in a unit of the layout, and begins at the top.
void check_glb(const checking::Glb_file& glb, const Obj& obj, double repetitions)
{
  BOOST_TEST(glb.attributes.at("POSITION").size() == number_of_places(obj));
  BOOST_TEST_REQUIRE(glb.indices.size() == 3 * obj.faces.size());
  for(std::size_t f = 0; f < obj.faces.size(); ++f)
  {
    std::multiset<std::vector<float> > expected, found; // triangles may begin with another corner
    for(std::size_t k = 0; k < 3; ++k)
    {
      const auto& p = obj.points[obj.faces[f][k]];
      const auto q = obj.place(f, k);
      expected.insert({ float(p[0]), float(p[1]), float(p[2]), float(q[0] * repetitions), float(1 - q[1] * repetitions) });
      std::vector<float> corner = glb.attributes.at("POSITION")[glb.indices[3 * f + k]];
      for(float x : glb.attributes.at("TEXCOORD_0")[glb.indices[3 * f + k]])
        corner.push_back(x);
      found.insert(corner);
    }
    BOOST_TEST((found == expected));
  }
  BOOST_TEST(glb.image.substr(0, 8) == "\x89PNG\r\n\x1a\n");
}
#endif

} // namespace

// Of a closed surface that is cut, and of a disk, in one run each: the files say the same.
BOOST_AUTO_TEST_CASE(formats_of_other_programs)
{
  const Folder folder;
  const std::vector<std::vector<std::string> > inputs = { { folder.write("closed.obj", as_bare_obj(spiky_icosahedron())), "--cones", "auto=4" },
                                                          { folder.write("grid.off", as_off(bumpy_grid(6))) } };
  for(const std::vector<std::string>& input : inputs)
  {
    const Run r = run(with(input, {"-o", folder / "o.obj", "-o", folder / "o.glb", "-o", folder / "o.ply", "--flat", folder / "flat.obj", "--dxf",
                                   folder / "o.dxf", "--svg", folder / "o.svg", "--true-scale", "25.4"}));
    BOOST_TEST_REQUIRE(r.status == 0, r.err);
    BOOST_TEST(contains(r.out, "wrote " + folder / "o.dxf"));
    const Obj obj(folder / "o.obj");
    const bool is_closed = input.size() > 1;
    BOOST_TEST((number_of_places(obj) > obj.points.size()) == is_closed);
    check_ply(checking::Ply_file(content(folder / "o.ply")), obj);
    check_flat(Obj(folder / "flat.obj"), obj);
    const checking::Dxf_file dxf(content(folder / "o.dxf"));
    for(const bool of_border : {true, false})
    {
      const Segments expected = outline(obj, of_border, 25.4), found = dxf.segments(of_border ? "OUTLINE" : "CUTS");
      BOOST_TEST(expected.empty() == (of_border == is_closed));
      BOOST_TEST((std::set<Segments::value_type>(found.begin(), found.end()) == std::set<Segments::value_type>(expected.begin(), expected.end())));
      BOOST_TEST(found.size() == expected.size());
    }
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
    double least[2] = {1e9, 1e9}, most[2] = {-1e9, -1e9};
    for(const auto& p : obj.places)
      for(std::size_t k = 0; k < 2; ++k)
      {
        least[k] = (std::min)(least[k], p[k]);
        most[k] = (std::max)(most[k], p[k]);
      }
    check_glb(checking::Glb_file(content(folder / "o.glb")), obj,
              0.5 / flattening::round_number_below((std::max)(most[0] - least[0], most[1] - least[1]) / 14));
#endif
    // a unit of the layout is 25.4 mm: of the drawing, the side of its viewBox and its width are in the same proportion
    const std::string svg = content(folder / "o.svg");
    double x = 0, y = 0, width = 0, height = 0, mm_wide = 0, mm_high = 0;
    BOOST_TEST(std::sscanf(svg.substr(svg.find("viewBox")).c_str(), "viewBox=\"%lf %lf %lf %lf", &x, &y, &width, &height) == 4);
    BOOST_TEST(std::sscanf(svg.substr(svg.find(" width=")).c_str(), " width=\"%lfmm\" height=\"%lfmm\"", &mm_wide, &mm_high) == 2);
    const Segments border = outline(obj, ! is_closed, 25.4);
    double longest = 0; // side of the box around the layout, which the drawing has as 1000
    for(std::size_t k = 0; k < 2; ++k)
    {
      const auto less = [k](const auto& a, const auto& b) { return a.first[k] < b.first[k]; };
      const auto range = std::minmax_element(border.begin(), border.end(), less);
      longest = (std::max)(longest, range.second->first[k] - range.first->first[k]);
    }
    BOOST_TEST(std::abs(mm_wide / width * 1000 / longest - 1) < 10 * testing::rounded_layout);
    BOOST_TEST(std::abs(mm_high / height * 1000 / longest - 1) < 10 * testing::rounded_layout);
  }
}

BOOST_AUTO_TEST_CASE(formats_keep_polygons_and_colours)
{
  const Folder folder;
  const std::string faces = "f 1 2 3 4\nf 2 5 3\n";
  const std::string input = folder.write("a.obj", "v 0 0 0 1 0 0.5\nv 1 0 0 0.25 0.125 0\nv 1 1 .1\nv 0 1 0\nv 2 0 0 0.1 0.2 0.04\n" + faces);
  BOOST_TEST(run({input, "-o", folder / "o.obj", "-o", folder / "o.ply", "-o", folder / "o.glb", "--flat", folder / "f.obj"}).status == 0);
  check_ply(checking::Ply_file(content(folder / "o.ply")), Obj(folder / "o.obj"));
  check_flat(Obj(folder / "f.obj"), Obj(folder / "o.obj"));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  const checking::Glb_file glb(content(folder / "o.glb"));
  BOOST_TEST(glb.indices.size() == 9u);
  BOOST_TEST(! glb.attributes.count("_WEIGHT"));
  std::map<float, std::vector<float> > color; // by x + 4 y
  for(std::size_t i = 0; i < 5; ++i)
    color[glb.attributes.at("POSITION")[i][0] + 4 * glb.attributes.at("POSITION")[i][1]] = glb.attributes.at("COLOR_0")[i];
  BOOST_TEST((color[4] == std::vector<float>{1, 1, 1})); // none was given
  BOOST_TEST(color[0][0] == 1);
  BOOST_TEST(color[0][1] == 0);
  BOOST_TEST(std::abs(color[0][2] - 0.214041) < 1e-5); // sRGB of IEC 61966-2-1
  BOOST_TEST(std::abs(color[2][2] - 0.04 / 12.92) < 1e-7);

  // weights, if they are asked for
  BOOST_TEST(run({input, "-o", folder / "o.glb", "--projective"}).err.empty());
  const checking::Glb_file weighted(content(folder / "o.glb"));
  BOOST_TEST(weighted.attributes.at("_WEIGHT").size() == 5u);
#endif
}

BOOST_AUTO_TEST_CASE(formats_on_the_sphere)
{
  const Folder folder;
  const std::string input = folder.write("s.obj", as_bare_obj(spiky_icosahedron()));
  BOOST_TEST(run({input, "--target", "sphere", "-o", folder / "o.obj", "-o", folder / "o.ply", "-o", folder / "o.glb"}).status == 0);
  const Obj sphere(folder / "o.obj");
  const checking::Ply_file ply(content(folder / "o.ply"));
  BOOST_TEST_REQUIRE(ply.vertices.size() == sphere.points.size());
  for(const auto& v : ply.vertices)
    BOOST_TEST((std::array<double, 3>{{ v.at("x"), v.at("y"), v.at("z") }} == sphere.points.at(static_cast<std::size_t>(v.at("vertex")))));
  BOOST_TEST(! ply.vertices[0].count("s"));
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  const checking::Glb_file glb(content(folder / "o.glb"));
  BOOST_TEST(glb.attributes.size() == 1u);
  BOOST_TEST(glb.attributes.at("POSITION").size() == sphere.points.size());
  BOOST_TEST(glb.image.empty());
#endif
  for(const char* option : {"--flat", "--dxf"})
    check_refused({input, "--target", "sphere", option, folder / "x.obj"}, 2, "exclude each other");
}

// Nothing is written of what does not fit into a format.
BOOST_AUTO_TEST_CASE(formats_that_cannot_be_written)
{
  const Folder folder;
  Soup soup = bumpy_grid(3);
  const std::string grid = folder.write("grid.off", as_off(soup));
  for(auto& p : soup.points)
    for(double& x : p)
      x *= 1e100;
  const std::string large = folder.write("large.off", as_off(soup));
  check_refused({large, "-o", folder / "o.obj", "-o", folder / "o.glb"}, 1, "is beyond single precision, which GLB files have");
  check_refused({large, "-o", folder / "o.obj", "--dxf", folder / "o.dxf", "--true-scale", "1e300"}, 1, "is not finite");
  check_refused({grid, "-o", folder / "o.obj", "--true-scale", "10"}, 2, "--true-scale needs --svg or --dxf");
  check_refused({grid, "--svg", folder / "o.svg", "--true-scale", "-1"}, 2, "--true-scale takes a number above 0");
  check_refused({grid, "--target", "hyperbolic", "-o", folder / "o.glb"}, 2, "no output in the formats GLB and PLY");
  check_refused({grid, "--flat", ""}, 2, "--flat needs the name of a file");
  BOOST_TEST(folder.files().size() == 2u);
}

// ------------------------------------------------------------------------------------------------
// What is written: all or nothing
// ------------------------------------------------------------------------------------------------

BOOST_AUTO_TEST_CASE(outputs_that_cannot_be_written)
{
  const Folder folder;
  const std::string input = folder.write("grid.off", as_off(bumpy_grid(4)));
  check_refused({input, "-o", folder / "none/o.obj"}, 1, "cannot write");
  for(const char* target : {"plane", "sphere", "hyperbolic"}) // before anything is read
    check_refused({folder / "missing.off", "--target", target, "--svg", folder / "none/o.svg"}, 1, "cannot write");
  check_refused({input, "-o", folder.path.string()}, 1, "it is a directory");
  check_refused({input, "--svg", input}, 2, "would overwrite the input");
  const std::string cones = folder.write("o.mtl", "12 free\n");
  check_refused({input, "--cones", cones, "--svg", cones}, 2, "would overwrite the input");
  fs::remove(cones);
  check_refused({input, "-o", folder / "o.obj", "--svg", folder / "o.obj"}, 2, "two outputs have the same name");
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

BOOST_AUTO_TEST_CASE(names_of_outputs)
{
  const Folder folder;
  const std::string input = folder.write("grid.off", as_off(bumpy_grid(4)));
  for(const char* name : {"o.gltf", "o.x", "o.obj.bak", "o.off"})
    check_refused({input, "-o", folder / name}, 2, "-o writes OBJ files, named *.obj, GLB files, named *.glb, and PLY files, named *.ply, not");
  check_refused({input, "-o", folder / "o.glb", "-o", folder / "p.GLB"}, 2, "once for each format");
  check_refused({input, "-o", folder / "o.obj", "--flat", folder / "o.obj"}, 2, "two outputs have the same name");
  BOOST_TEST(folder.files().size() == 1u);
  BOOST_TEST(run({input, "-o", folder / "o.OBJ", "--quiet"}).status == 0);
  BOOST_TEST(run({input, "-o", "/dev/null", "--quiet"}).status == 0);

  // what scripts ask for: only if nothing else is said
  BOOST_TEST(run({"--default-input", input, "--default-output", folder / "new/out", "--quiet"}).status == 0);
  BOOST_TEST(fs::exists(folder.path / "new/out/grid.obj"));
  BOOST_TEST(fs::exists(folder.path / "new/out/grid.svg"));
  fs::remove_all(folder.path / "new");
  BOOST_TEST(run({input, "--default-input", "none.off", "--default-output", folder / "new", "--svg", folder / "o.svg", "--quiet"}).status == 0);
  BOOST_TEST(! fs::exists(folder.path / "new"));
}

BOOST_AUTO_TEST_CASE(standard_streams)
{
  const Folder folder;
  const Soup soup = bumpy_grid(4);
  const std::string input = folder.write("grid.off", as_off(soup));
  BOOST_TEST(run({input, "-o", folder / "o.obj"}).status == 0);

  // one output there, and then nothing else
  const Run r = run({input, "-o", "-"});
  BOOST_TEST(r.status == 0);
  BOOST_TEST((Obj(folder.write("p.obj", r.out)).places == Obj(folder / "o.obj").places));
  BOOST_TEST(r.out.substr(0, 2) == "v ");
  BOOST_TEST(contains(r.err, "25 vertices, 32 triangles"));
  BOOST_TEST(contains(run({input, "--svg", "-", "--quiet"}).out, "</svg>"));
  check_refused({input, "-o", "-", "--svg", "-"}, 2, "only one output");
  check_refused({"-", "--boundary", "scale=-"}, 2, "only once");

  // every format is recognized
  for(const std::string& file : {as_off(soup), as_obj(soup), as_text_ply(soup), as_binary_ply(soup, true), as_text_stl(soup)})
  {
    std::istringstream in(file);
    std::streambuf* const before = std::cin.rdbuf(in.rdbuf());
    const Run read = run({"-"});
    std::cin.rdbuf(before);
    BOOST_TEST_CONTEXT(read.err)
    BOOST_TEST(contains(read.out, "25 vertices, 32 triangles"));
  }
}

BOOST_AUTO_TEST_CASE(materials_of_others_are_kept)
{
  const Folder folder;
  const std::string input = folder.write("grid.off", as_off(bumpy_grid(4)));
  const std::string foreign = "newmtl wood\nKd 1 0 0\n";
  folder.write("o.mtl", foreign);
  for(int repetition = 0; repetition < 2; ++repetition) // our own is overwritten
  {
    const Run r = run({input, "-o", folder / "o.obj"});
    BOOST_TEST(r.status == 0);
    BOOST_TEST(contains(r.err, "o.mtl was not written by this program, and is kept"));
    BOOST_TEST(content(folder / "o.mtl") == foreign);
    BOOST_TEST(content(folder / "o.obj").substr(0, 20) == "mtllib o.layout.mtl\n");
    BOOST_TEST(contains(content(folder / "o.layout.mtl"), "map_Kd"));
  }
  folder.write("o.layout.mtl", foreign);
  check_refused({input, "-o", folder / "o.obj"}, 1, "neither is overwritten");
  fs::remove(folder.path / "o.mtl");
  for(int repetition = 0; repetition < 2; ++repetition)
    BOOST_TEST(run({input, "-o", folder / "o.obj"}).err.empty());
  BOOST_TEST(content(folder / "o.layout.mtl") == foreign);
}

#if defined(__unix__) || defined(__APPLE__)
// Ended by a signal, a program leaves nothing of the files that it was writing; one that is ignored does not end it.
BOOST_AUTO_TEST_CASE(interrupted_while_writing)
{
  for(int signal : {SIGINT, SIGTERM, SIGHUP})
    for(bool is_ignored : {false, true})
    {
      const Folder folder;
      const std::string old = folder.write("old.obj", "old");
      const pid_t child = fork();
      if(child == 0)
      {
        std::signal(signal, is_ignored ? SIG_IGN : SIG_DFL);
        std::ostringstream none;
        {
          flattening::Output_files files(none);
          for(const char* name : {"a.obj", "old.obj"})
          {
            files.announce(folder / name);
            files.write(folder / name, [](std::ostream& out) { return (out << "new").good(); });
          }
          if(folder.files().size() != 3)
            _exit(2);
          std::raise(signal);
        }
        _exit(0);
      }
      int status = 0;
      BOOST_REQUIRE(waitpid(child, &status, 0) == child);
      BOOST_TEST(WIFSIGNALED(status) == ! is_ignored);
      BOOST_TEST((is_ignored ? WEXITSTATUS(status) == 0 : WTERMSIG(status) == signal));
      BOOST_TEST((folder.files() == std::set<std::string>{"old.obj"}));
      BOOST_TEST(content(old) == "old");
    }
}
#endif

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
    flattening::Polygon_soup soup;
    soup.points = {{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}, {{0, 1, 0}}, {{0.1, 1e-300, -1e300}}};
    soup.faces = { flattening::Polygon{0, 1, 2}, flattening::Polygon{0, 2, 3} };
    flattening::check_soup(soup, "two");
    flattening::build_mesh(soup, mesh);
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
  auto u = two.mesh.add_property_map<flattening::Vertex, double>("v:u", 1.).first;
  auto weights = two.mesh.add_property_map<flattening::Vertex, double>("v:w", 1.).first;
  flattening::HTML_options options;
  options.title = "<script>";
  options.figures = {{"a", "<b>"}};
  for(bool with_weights : {false, true})
  {
    put(weights, *two.mesh.vertices().begin(), with_weights ? 0.5 : 1.);
    std::ostringstream out;
    BOOST_TEST(flattening::write_HTML(out, two.mesh, two.uv, u, options, CGAL::parameters::projective_weight_map(weights)));
    const std::string page = out.str();
    BOOST_TEST(contains(page, "<title>&lt;script&gt;</title>"));
    BOOST_TEST(contains(page, "<td>a</td><td>&lt;b&gt;</td>"));
    BOOST_TEST(contains(page, "Permission is hereby granted")); // the licence of the library within
    // digits of base64, four for three bytes: six corners of three, two and one floats, six indices of four bytes, two codes of two bytes
    const auto digits = [&](const std::string& name)
    {
      const std::string beginning = "id=\"data-" + name + "\">";
      const std::size_t begin = page.find(beginning) + beginning.size();
      return page.find('<', begin) - begin;
    };
    BOOST_TEST(digits("points") == 96u);
    BOOST_TEST(digits("layout") == 64u);
    BOOST_TEST(digits("u") == 32u);
    BOOST_TEST(digits("weights") == (with_weights ? 32u : 0u)); // equal ones change nothing
    BOOST_TEST(digits("triangles") == 32u);
    BOOST_TEST(digits("area-factors") == 8u);
    BOOST_TEST(digits("quasi-conformal-factors") == 8u);
    BOOST_TEST(digits("hidden-edges") == 0u);
  }

  // numbers of any kind: no "nan" and no "inf" among the numbers of the page
  two.uv[two.mesh.halfedge(flattening::Face(0))] = flattening::Kernel::Point_2(HUGE_VAL, 0);
  put(u, *two.mesh.vertices().begin(), std::numeric_limits<double>::quiet_NaN());
  std::ostringstream out;
  BOOST_TEST(flattening::write_HTML(out, two.mesh, two.uv, u, options));
  const std::string page = out.str(), numbers = page.substr(page.find("id=\"data-numbers\""));
  BOOST_TEST(! contains(numbers.substr(0, numbers.find('\n')), "nan"));
  BOOST_TEST(! contains(numbers.substr(0, numbers.find('\n')), "inf"));
}

// What pages have of factors: even steps of the logarithm, and codes for what is no number.
BOOST_AUTO_TEST_CASE(coded_logarithms)
{
  flattening::Coded_logarithms coded;
  const double infinity = std::numeric_limits<double>::infinity();
  for(double x : { 1., 2., 4., 0., infinity, std::numeric_limits<double>::quiet_NaN() })
    coded.push_back(x);
  const std::vector<std::uint16_t> expected = { 1, 32768, 65534, 0, 65535, 0 };
  BOOST_TEST(coded.codes() == expected, boost::test_tools::per_element());
  BOOST_TEST(coded.range()[0] == 0);
  BOOST_TEST(std::abs(coded.range()[1] - std::log(4.)) < testing::few_roundings);
  BOOST_TEST(flattening::Coded_logarithms().range()[1] == 0);
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
