// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The files that the program flatten_mesh reads and writes, good and bad ones; and the checker of layouts itself.

#define BOOST_TEST_MODULE test_flatten_mesh_files
#include "include/boost_test.h"
#include "include/check_flattening.h"
#include "include/program_runs.h"

#include "../../examples/Conformal_equivalence/include/flatten_mesh/mesh.h"
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
#include <limits>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

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
  flattening::read_mesh(input, mesh);
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
    {"a.off", off(square, "3 0 1 2\n2 0 1\n"), "face 1 has only 2 vertices"},
    {"a.off", off(square, "3 0 1 2\n0\n"), "line 8: face 1 has no vertices"},
    {"a.off", off(square, two) + "3 0 1 2\n", "line 9: there is more than the 4 vertices and 2 faces that are announced"},
    {"a.off", "OFF\n4 2 0\n" + square + "0 0 1\n" + two, "line 7: face 0 has no vertices"}, // another vertex than announced
    {"a.off", off("0 0 0 1 0 0\n1 1 0\n0 1 0\n0 0 1\n", two) + "x\n", "line 9: there is more than"},
    {"a.off", off("0 0 0 red\n1 0 0\n0 1 0\n", "3 0 1 2\n"), "line 3: expected a number, found 'red'"},
    {"a.off", off("0 0 0\n1 0 0\n0 1 1.#INF\n", "3 0 1 2\n"), "line 5: expected a number, found '1.#INF'"},
    {"a.off", "\xFF\xFEO\0F\0F\0", "is encoded in UTF-16 or UTF-32; convert it to UTF-8"},
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
    {"a.ply", ply("element vertex 3\nproperty float x\nproperty float y\nproperty float x\nproperty float z\n", ""), "'vertex' have the property 'x' twice"},
    {"a.ply", ply(vertices + vertices, ""), "announces the elements 'vertex' twice"},
    {"a.ply", ply(vertices + "element face 1\nproperty list uchar int corners\n", ""), "the elements 'face' have no list 'vertex_indices'"},
    {"a.ply", ply(vertices + faces, "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n"), "line 13: there is more than the elements that the header announces"},
    {"a.ply", ply(vertices + faces, "0 0 0\n1 0 0\n0 1 0 0\n3 0 1 2\n"), "line 11: there are more numbers than the header has properties"},
    {"a.ply", ply(vertices + faces, "0 0 0\n1 0\n0\n0 1 0\n3 0 1 2\n"), "line 10: expected a number, found the end of the line"},
    {"a.ply", ply(vertices + faces, "0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n"), "face 0 names the vertex 1.5"},
    {"a.ply", ply(vertices + faces, "0 0 0\n1 0 0\n0 1 0\n-1 0 1 2\n"), "a list 'vertex_indices' of -1 values"},
    {"a.ply", ply(vertices + faces, "0 0 0\n1 0 0\n0 1 0\n2.5 0 1 2\n"), "a list 'vertex_indices' of 2.5 values"},
    {"a.ply", ply(faces + vertices, "3 0 1 3\n0 0 0\n1 0 0\n0 1 0\n"), "line 9: face 0 names the vertex 3, but there are 3 vertices"},
    {"a.ply", ply(vertices + "element tristrips 1\nproperty list int int vertex_indices\n", "0 0 0\n1 0 0\n0 1 0\n4 0 1 2 -2\n"), "face 1 names the vertex -2"},
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
      line = line.substr(0, 1) + "\\" + end + line.substr(1, line.rfind(' ') - 1) + "  \\" + end + line.substr(line.rfind(' ') + 1);
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

std::string replaced(std::string text, const std::string& what, const std::string& by)
{
  for(std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
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
  const Run r = run({folder.write("a.stl", bytes + "tail")});
  BOOST_TEST(r.status == 0);
  BOOST_TEST(contains(r.err, "a.stl: skipped 4 bytes after the last triangle\n"));

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
  BOOST_TEST(said("a.obj", square.substr(0, square.size() - 8) + "f 1//1 3//1 4//2\n")
             == "skipped the normals of 1 face, which names normals that are not there\n");
  BOOST_TEST(said("a.ply", "ply\nformat ascii 1.0\nelement edge 2\nproperty int a\nproperty int b\nelement vertex 3\nproperty float x\nproperty float y\n"
                           "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 1\n1 2\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
             == "skipped 2 elements 'edge'\n");
  BOOST_TEST(said("a.stl", "solid\ncolor 1 0 0\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\nendsolid\n") == "skipped words: 'color' (1)\n");
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
  flattening::read_mesh(input, mesh);
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
// What is written: all or nothing
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
    soup.faces = {{0, 1, 2}, {0, 2, 3}};
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
