// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Feeds mangled mesh files, random conditions and options to the program flatten_mesh, run
// within this one. Whatever it is given, it ends with status 0, 1 or 2: on 0 all outputs are
// there, with finite coordinates and no flipped triangle; on 1 and 2 nothing is written and
// one line says why. Nothing but an own temporary folder is touched.
//
// Two drivers: libFuzzer (clang++ -fsanitize=fuzzer,address,undefined), whose mutations are
// those below; or, with CGAL_CONFORMAL_EQUIVALENCE_FUZZ_STANDALONE defined, a main function that needs
// no libFuzzer and mutates its own valid inputs, the same ones in every run:
//
//   test_fuzz_flatten_mesh [--runs N] [--seconds T] [--seed S] [--first I]   how much, and which mutations
//                          [--keep FILE]      write each input to this file before it runs
//                          [--corpus FOLDER]  write the valid inputs there, for libFuzzer, and stop
//                          [INPUT...]         run these inputs of either driver instead

#include "include/check_flattening.h"
#include "include/tolerances.h"

#include "../../examples/Conformal_equivalence/include/flatten_mesh/flatten_mesh.h"
#include "../../examples/Conformal_equivalence/include/flatten_mesh/messages.h"
#include "../../examples/Conformal_equivalence/include/flatten_mesh/read_soup.h"

#include <CGAL/assertions_behaviour.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <initializer_list>
#include <iostream>
#include <iterator>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#  include <unistd.h>
#endif

namespace fuzzing {

namespace fs = std::filesystem;

// ------------------------------------------------------------------------------------------------
// An input: the bytes of the fuzzer, in parts
// ------------------------------------------------------------------------------------------------

constexpr std::size_t maximum_size = 8192; // some hundred faces: most runs take milliseconds
constexpr int maximum_number_of_iterations = 20; // with coordinates beyond 1e100, each may take a tenth of a second
constexpr char separator = '\x1e';

enum Choice { FORMAT, BOUNDARY, CONES, WAY, RETRIANGULATION, FLAGS, OUTPUTS, ITERATIONS, NUMBER_OF_CHOICES };
enum Boundary { NOT_GIVEN, NATURAL, RECTANGLE, CORNERS, ANGLES, SCALE, ANGLES_AND_SCALE, CONTRADICTION, NUMBER_OF_BOUNDARIES };
enum Flag { PROJECTIVE = 1, REQUIRE_INJECTIVE = 2, QUIET = 4, UNIT_SQUARE = 8, QUASI_CONFORMAL = 16,
            TOLERANCE = 32, SIMPLICIAL = 64, REFINE = 128 };
enum Output { OBJ = 1, SVG = 2, HTML = 4, REPORT = 8, THERE_BEFORE = 16, NO_SUCH_FOLDER = 32 };
enum Text { CORNER_LIST, TOLERANCE_TEXT, ANGLE_FILE, SCALE_FILE, CONE_FILE, NUMBER_OF_TEXTS };

struct Input
{
  std::array<std::uint8_t, NUMBER_OF_CHOICES> choices{};
  std::array<std::string, NUMBER_OF_TEXTS> texts;
  std::string mesh;

  bool has(Flag flag) const { return (choices[FLAGS] & flag) != 0; }
  bool has(Output output) const { return (choices[OUTPUTS] & output) != 0; }
};

// Any bytes are an input: the choices, the texts with a separator after each, the mesh.
inline Input parse(const char* data, std::size_t size)
{
  Input input;
  const char* const end = data + size;
  for(std::uint8_t& choice : input.choices)
    choice = data == end ? 0 : static_cast<std::uint8_t>(*data++);
  for(std::string& text : input.texts)
  {
    const char* const stop = std::find(data, end, separator);
    text.assign(data, stop);
    data = stop == end ? end : stop + 1;
  }
  input.mesh.assign(data, end);
  return input;
}

inline std::string to_bytes(const Input& input)
{
  std::string bytes(input.choices.begin(), input.choices.end());
  for(std::string text : input.texts)
  {
    std::replace(text.begin(), text.end(), separator, ' ');
    bytes += text + separator;
  }
  return bytes + input.mesh;
}

// ------------------------------------------------------------------------------------------------
// Running the program
// ------------------------------------------------------------------------------------------------

// A folder of its own, gone at the end.
class Folder
{
public:
  Folder()
  {
    std::random_device random;
    do
      path_ = fs::temp_directory_path() / ("fuzz_flatten_mesh_" + std::to_string(random()));
    while(! fs::create_directory(path_));
  }
  ~Folder() { std::error_code ignored; fs::remove_all(path_, ignored); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

  void write(const std::string& name, const std::string& content) const
  {
    std::ofstream(path_ / name, std::ios::binary) << content;
  }

  std::string content(const std::string& name) const
  {
    std::ifstream in(path_ / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }

  std::set<std::string> files() const
  {
    std::set<std::string> names;
    for(const auto& entry : fs::directory_iterator(path_))
      names.insert(entry.path().filename().string());
    return names;
  }

  void clear() const
  {
    for(const std::string& name : files())
      fs::remove_all(path_ / name);
  }

private:
  fs::path path_;
};

// A value of an option: up to the first zero byte, and not endless.
inline std::string argument(const std::string& text)
{
  return text.substr(0, 64).c_str();
}

inline std::string mesh_name(const Input& input)
{
  const char* names[] = { "in.off", "in.obj", "in.ply", "in.stl" };
  return names[input.choices[FORMAT] % 4];
}

inline std::vector<std::string> boundary_arguments(const Input& input, const Folder& folder)
{
  const std::string angles = "--boundary=angles=" + (folder / "angles.txt"), scale = "--boundary=scale=" + (folder / "scale.txt");
  switch(input.choices[BOUNDARY] % NUMBER_OF_BOUNDARIES)
  {
    case NATURAL:          return { "--boundary=natural" };
    case RECTANGLE:        return { "--boundary=rectangle" };
    case CORNERS:          return { "--boundary=rectangle=" + argument(input.texts[CORNER_LIST]) };
    case ANGLES:           return { angles };
    case SCALE:            return { scale };
    case ANGLES_AND_SCALE: return { angles, scale };
    case CONTRADICTION:    return { angles, "--boundary=rectangle" };
    default:               return {};
  }
}

// Cones: of the file, or placed; of any angles, or multiples; and seamless layouts.
enum Cones { NO_CONES, FILE_OF_CONES, PLACED, QUANTIZED_FILE, PLACED_AND_QUANTIZED, SEAMLESS, SEAMLESS_FILE, SEAMLESS_WITHIN_BOUND, NUMBER_OF_CONES };
enum Tiles { BY_DISTORTION, BY_NUMBER, HEXAGONS, HALF_TURNS, NUMBER_OF_TILES };

inline Cones cones(const Input& input) { return Cones(input.choices[CONES] % NUMBER_OF_CONES); }
inline bool is_seamless(const Input& input) { return cones(input) >= SEAMLESS; }

constexpr std::uint8_t cone_choice(Cones cones, int number, Tiles tiles = BY_DISTORTION)
{
  return static_cast<std::uint8_t>(cones + NUMBER_OF_CONES * (number - 1 + 8 * tiles));
}

inline std::vector<std::string> cone_arguments(const Input& input, const Folder& folder)
{
  const std::string file = "--cones=" + (folder / "cones.txt"),
                    placed = "--cones=auto=" + std::to_string(1 + input.choices[CONES] / NUMBER_OF_CONES % 8);
  const std::vector<std::vector<std::string> > of_cones = {
    {}, { file }, { placed }, { file, "--quantize" }, { placed, "--quantize=60" }, { placed, "--seamless" },
    { file, "--seamless" }, { "--cones=auto", "--max-scale=1", "--max-area=20", "--seamless" } };
  const std::vector<std::vector<std::string> > of_tiles = {
    { "--distortion=1.1" }, { "--tiles=50" }, { "--quantize=60", "--lattice-coordinates" }, { "--quantize=180" } };
  std::vector<std::string> result = of_cones[cones(input)];
  if(is_seamless(input))
    for(const std::string& a : of_tiles[input.choices[CONES] / (8 * NUMBER_OF_CONES) % NUMBER_OF_TILES])
      result.push_back(a);
  return result;
}

// Where to, and what is done to the surface before.
enum Way { PLANE, SPHERE, SPHERE_OF_AREAS, SPHERE_BY_VERTEX, SPHERE_WITH_DIGITS, DISK, DISK_OF_AREAS, DISK_BY_VERTEX, DISK_AROUND_VERTEX,
           DISK_OF_POINTS, DISK_WITH_DIGITS, DIGITS, KEPT_BORDER, LOCAL_REPAIR, MOLLIFICATION, REPAIR, REPAIR_TO_SPHERE, REPAIR_TO_DISK,
           NUMBER_OF_WAYS };

inline Way way(const Input& input) { return Way(input.choices[WAY] % NUMBER_OF_WAYS); }

inline bool is_sphere(const Input& input)
{
  return (way(input) >= SPHERE && way(input) <= SPHERE_WITH_DIGITS) || way(input) == REPAIR_TO_SPHERE;
}

inline bool is_disk(const Input& input)
{
  return (way(input) >= DISK && way(input) <= DISK_WITH_DIGITS) || way(input) == REPAIR_TO_DISK;
}

inline bool is_repaired(const Input& input) { return way(input) >= REPAIR && way(input) <= REPAIR_TO_DISK; }

inline std::vector<std::string> way_arguments(const Input& input)
{
  const std::string vertex = std::to_string(input.choices[WAY] / NUMBER_OF_WAYS);
  const std::vector<std::vector<std::string> > of_ways = {
    {}, { "--target=sphere" }, { "--target=sphere", "--moebius-weights=areas" }, { "--target=sphere", "--vertex-at-infinity=" + vertex },
    { "--target=sphere", "--precision=100" }, { "--target=disk" }, { "--boundary=disk", "--moebius-weights=areas" },
    { "--target=disk", "--vertex-at-infinity=" + vertex }, { "--target=disk", "--disk-centre=" + vertex },
    { "--target=disk", "--disk-points=" + argument(input.texts[CORNER_LIST]) }, { "--target=disk", "--precision=100" },
    { "--precision=80" }, { "--keep-border" }, { "--local-repair" }, { "--mollify=1e-3" },
    { "--repair" }, { "--repair", "--target=sphere" }, { "--repair", "--target=disk" } };
  return of_ways[way(input)];
}

struct Output_file { Output output; const char* option; const char* name; };

constexpr Output_file output_files[] = { {OBJ, "--output=", "out.obj"}, {SVG, "--svg=", "out.svg"},
                                         {HTML, "--html=", "out.html"}, {REPORT, "--report=", "out.json"} };

// Whether the option says something together with the others: if not, that is wrong usage.
inline bool is_usable(const Input& input, Flag flag)
{
  const bool is_plane = ! is_sphere(input) && ! is_disk(input);
  switch(flag)
  {
    case PROJECTIVE:  return ! is_seamless(input) && ! is_sphere(input);
    case UNIT_SQUARE: return ! is_seamless(input) && is_plane;
    case REFINE:      return ! is_seamless(input);
    default:          return true;
  }
}

inline bool is_usable(const Input& input, Output output) { return output != HTML || ! is_sphere(input); }

// Conditions in the plane. Without flips on the way, and with more digits, no cones are placed.
inline std::vector<std::string> condition_arguments(const Input& input, const Folder& folder)
{
  if(is_sphere(input) || is_disk(input))
    return {};
  std::vector<std::string> a = boundary_arguments(input, folder);
  if((way(input) == LOCAL_REPAIR || way(input) == DIGITS) && cones(input) != FILE_OF_CONES)
    return a;
  const std::vector<std::string> of_cones = cone_arguments(input, folder);
  a.insert(a.end(), of_cones.begin(), of_cones.end());
  return a;
}

// Options end with "=value", so that no value is taken for another option.
inline std::vector<std::string> arguments(const Input& input, const Folder& folder)
{
  std::vector<std::string> a = condition_arguments(input, folder);
  for(const std::string& way_argument : way_arguments(input))
    a.push_back(way_argument);
  const char* retriangulations[] = { "never", "when-needed", "always" };
  if(way(input) != LOCAL_REPAIR)
    a.push_back(std::string("--retriangulate=") + retriangulations[input.choices[RETRIANGULATION] % 3]);
  a.push_back("--max-iterations=" + std::to_string(input.choices[ITERATIONS] % (maximum_number_of_iterations + 1)));
  const std::pair<Flag, std::string> flags[] = {
    {PROJECTIVE, "--projective"}, {REQUIRE_INJECTIVE, "--require-injective"}, {QUIET, "--quiet"},
    {UNIT_SQUARE, "--frame=unit-square"}, {QUASI_CONFORMAL, "--color-by=qc"},
    {TOLERANCE, "--tolerance=" + argument(input.texts[TOLERANCE_TEXT])}, {SIMPLICIAL, "--solver=simplicial"},
    {REFINE, "--refine"} };
  for(const auto& flag : flags)
    if(input.has(flag.first) && is_usable(input, flag.first))
      a.push_back(flag.second);
  for(const Output_file& file : output_files)
    if(input.has(file.output) && is_usable(input, file.output))
      a.push_back(file.option + (folder / (input.has(NO_SUCH_FOLDER) ? std::string("none/") + file.name : file.name)));
  a.push_back(folder / mesh_name(input));
  return a;
}

typedef std::function<int(int, const char* const*, std::ostream&, std::ostream&)> Program;

struct Run
{
  int status;
  std::string out, err;
};

inline Run run(const Program& program, const std::vector<std::string>& arguments)
{
  std::vector<const char*> argv(1, "flatten_mesh");
  for(const std::string& a : arguments)
    argv.push_back(a.c_str());
  std::ostringstream out, err;
  const int status = program(static_cast<int>(argv.size()), argv.data(), out, err);
  return { status, out.str(), err.str() };
}

// ------------------------------------------------------------------------------------------------
// What holds after every run
// ------------------------------------------------------------------------------------------------

const std::string content_before = "what was there before\n";

// The files that the program is given; returns their names and contents.
inline std::map<std::string, std::string> write_files(const Input& input, const Folder& folder)
{
  std::map<std::string, std::string> files = {
    { mesh_name(input), input.mesh }, { "angles.txt", input.texts[ANGLE_FILE] },
    { "scale.txt", input.texts[SCALE_FILE] }, { "cones.txt", input.texts[CONE_FILE] } };
  if(input.has(THERE_BEFORE))
    for(const Output_file& file : output_files)
      files[file.name] = content_before;
  for(const auto& file : files)
    folder.write(file.first, file.second);
  return files;
}

inline bool is_one_line(const std::string& text)
{
  return text.size() > 1 && text.find('\n') == text.size() - 1;
}

// The OBJ file without faces of other than three corners, which are of the input then.
inline std::string triangles_of(const std::string& obj)
{
  std::istringstream in(obj);
  std::string result;
  for(std::string line; std::getline(in, line); )
    if(line.compare(0, 2, "f ") != 0 || checking::count_words(line) == 4)
      result += line + '\n';
  return result;
}

// Empty if all triangles with exact coordinates are turned to the left, or flat.
inline std::string fault_of_triangles(const checking::Surface& s)
{
  typedef CGAL::Exact_predicates_inexact_constructions_kernel::Point_2 Point;
  for(std::size_t f = 0; f < s.faces.size() && ! s.has_weights; ++f)
  {
    Point p[3];
    for(std::size_t k = 0; k < 3; ++k)
      p[k] = Point(s.texture.at(s.corners[f][k])[0], s.texture.at(s.corners[f][k])[1]);
    if(CGAL::orientation(p[0], p[1], p[2]) == CGAL::NEGATIVE)
      return "face " + std::to_string(f) + " of the layout is flipped";
  }
  return "";
}

// Empty if the points of the OBJ file are on unit spheres, those of several components side by side at multiples of 2.25; vertices without a face
// are in the centre of the first.
inline std::string fault_of_sphere(const checking::Surface& s)
{
  const auto from_centre = [](double x) { return x - 2.25 * std::round(x / 2.25); };
  for(const auto& p : s.points)
  {
    const double r = std::hypot(from_centre(p[0]), from_centre(p[1]), p[2]);
    if(! (r == 0 || std::abs(r - 1) < testing::rounded_spheres_side_by_side))
      return "a point is off the sphere";
  }
  return "";
}

// Empty if the layout in the OBJ file is finite and, as far as the file has it exactly, flips nothing but what is said. Faces that were
// repaired lie as those do that stand for them.
inline std::string fault_of_layout(const Input& input, const std::string& obj, const std::string& message)
{
  if(obj.find("\nf ") == std::string::npos)
    return "the output has no faces";
  std::istringstream in(triangles_of(obj));
  const checking::Surface s = checking::read_obj(in);
  if(is_sphere(input))
    return fault_of_sphere(s);
  for(const auto& p : s.texture)
    for(double x : p)
      if(! std::isfinite(x))
        return "a texture coordinate is not a finite number";
  const bool may_be_flipped = is_repaired(input) || (is_disk(input) && (input.has(QUIET) || message.find("not positive") != std::string::npos));
  return may_be_flipped ? "" : fault_of_triangles(s);
}

// Notices, one a line.
inline bool are_notices(const std::string& message)
{
  std::istringstream in(message);
  for(std::string line; std::getline(in, line); )
    if(line.compare(0, 14, "flatten_mesh: ") != 0)
      return false;
  return true;
}

inline std::string fault_of_success(const Input& input, const Folder& folder, const Run& r)
{
  if(input.has(QUIET) ? ! r.err.empty() : ! are_notices(r.err))
    return "status 0, but there is a message: " + r.err;
  if(r.out.empty() != input.has(QUIET))
    return "status 0, but the summary is missing, or not quiet";
  for(const Output_file& file : output_files)
  {
    const std::string content = folder.content(file.name);
    const bool is_as_before = content == (input.has(THERE_BEFORE) ? content_before : ""),
               is_written = input.has(file.output) && is_usable(input, file.output);
    if(is_written ? is_as_before || content.empty() : ! is_as_before)
      return std::string("status 0, but ") + file.name + (is_written ? " is not written" : " is touched");
  }
  return input.has(OBJ) ? fault_of_layout(input, folder.content("out.obj"), r.err) : "";
}

inline std::string fault_of_failure(const std::map<std::string, std::string>& before, const Folder& folder, const Run& r)
{
  if(! is_one_line(r.err))
    return "status " + std::to_string(r.status) + ", but the message is not one line: " + r.err;
  if(! r.out.empty())
    return "status " + std::to_string(r.status) + ", but there is output: " + r.out;
  for(const std::string& name : folder.files())
    if(before.count(name) == 0)
      return "status " + std::to_string(r.status) + ", but " + name + " is left";
  return "";
}

inline std::string fault_of_files(const Input& input, const std::map<std::string, std::string>& before, const Folder& folder,
                                  const Run& r)
{
  std::set<std::string> allowed = { "out.mtl", "out.checker.png" };
  for(const Output_file& file : output_files)
    allowed.insert(file.name);
  for(const std::string& name : folder.files())
    if(before.count(name) == 0 && allowed.count(name) == 0)
      return name + " is left";
  for(const auto& file : before)
    if((r.status != 0 || allowed.count(file.first) == 0) && folder.content(file.first) != file.second)
      return file.first + " is changed";
  return r.status == 0 ? fault_of_success(input, folder, r) : fault_of_failure(before, folder, r);
}

// The first assertion of CGAL that failed in this run: the program would make an ordinary failure of it.
inline std::string& failed_assertion()
{
  static std::string text;
  return text;
}

inline void note_failed_assertion(const char* type, const char* expression, const char* file, int line, const char* message)
{
  if(failed_assertion().empty())
    failed_assertion() = flattening::text(type, ' ', expression, ", ", file, ':', line, ' ', message);
}

// Runs the program; returns what is wrong with the outcome, empty if nothing is.
inline std::string fault(const Input& input, const Folder& folder, const Program& program, int* status = nullptr)
{
  folder.clear();
  failed_assertion().clear();
  CGAL::set_error_handler(&note_failed_assertion);
  const std::map<std::string, std::string> before = write_files(input, folder);
  try
  {
    const Run r = run(program, arguments(input, folder));
    if(status)
      *status = r.status;
    if(! failed_assertion().empty())
      return "an assertion of CGAL failed: " + failed_assertion();
    if(r.status < 0 || r.status > 2)
      return "status " + std::to_string(r.status);
    return fault_of_files(input, before, folder, r);
  }
  catch(const std::exception& e)
  {
    return std::string("an exception escapes: ") + e.what();
  }
  catch(...)
  {
    return "an unknown exception escapes";
  }
}

// ------------------------------------------------------------------------------------------------
// Valid inputs to begin with
// ------------------------------------------------------------------------------------------------

struct Soup
{
  std::vector<std::array<double, 3> > points;
  std::vector<std::array<std::uint32_t, 3> > triangles;
};
typedef std::array<int, 3> Cube;

inline Soup grid(std::uint32_t n, double height, double stretch)
{
  Soup soup;
  for(std::uint32_t j = 0; j <= n; ++j)
    for(std::uint32_t i = 0; i <= n; ++i)
      soup.points.push_back({{ stretch * i, double(j), height * double((7 * i + 5 * j + i * j) % 4) }});
  for(std::uint32_t j = 0; j < n; ++j)
    for(std::uint32_t i = 0; i < n; ++i)
    {
      const std::uint32_t v = j * (n + 1) + i;
      soup.triangles.push_back({{ v, v + 1, v + n + 2 }});
      soup.triangles.push_back({{ v, v + n + 2, v + n + 1 }});
    }
  return soup;
}

// a fan of n triangles around the vertex 0: a star of needles if `depth` is small
inline Soup fan(std::uint32_t n, double depth)
{
  Soup soup;
  soup.points.push_back({{ 0, 0, 0.5 }});
  for(std::uint32_t i = 0; i < n; ++i)
  {
    const double a = 2 * CGAL_PI * i / n, r = i % 2 ? depth : 1;
    soup.points.push_back({{ r * std::cos(a), r * std::sin(a), 0 }});
    soup.triangles.push_back({{ 0, i + 1, (i + 1) % n + 1 }});
  }
  return soup;
}

inline Soup octahedron()
{
  Soup soup;
  soup.points = { {{1, 0, 0}}, {{-1, 0, 0}}, {{0, 1, 0}}, {{0, -1, 0}}, {{0, 0, 2}}, {{0, 0, -1}} };
  soup.triangles = { {{0, 2, 4}}, {{2, 1, 4}}, {{1, 3, 4}}, {{3, 0, 4}}, {{2, 0, 5}}, {{1, 2, 5}}, {{3, 1, 5}}, {{0, 3, 5}} };
  return soup;
}

inline Soup moved(Soup soup, double x)
{
  for(auto& p : soup.points)
    p[0] += x;
  return soup;
}

inline Soup together(Soup soup, const Soup& other)
{
  const std::uint32_t n = static_cast<std::uint32_t>(soup.points.size());
  soup.points.insert(soup.points.end(), other.points.begin(), other.points.end());
  for(const auto& t : other.triangles)
    soup.triangles.push_back({{ t[0] + n, t[1] + n, t[2] + n }});
  return soup;
}

// The surface of unit cubes, of any genus; without the squares at the height `open`, with borders.
inline Soup cubes(const std::set<Cube>& solid, int open = -1)
{
  Soup soup;
  std::map<Cube, std::uint32_t> number;
  const auto vertex = [&](const Cube& p)
  {
    const auto added = number.emplace(p, static_cast<std::uint32_t>(soup.points.size()));
    if(added.second)
      soup.points.push_back({{ double(p[0]), double(p[1]), double(p[2]) }});
    return added.first->second;
  };
  for(const Cube& c : solid)
    for(std::size_t axis = 0; axis < 3; ++axis)
      for(int side = 0; side < 2; ++side)
      {
        Cube next = c, corner[4];
        next[axis] += side ? 1 : -1;
        if(solid.count(next) || (axis == 2 && c[2] + side == open))
          continue;
        for(int k = 0; k < 4; ++k) // counterclockwise from outside
        {
          corner[k] = c;
          corner[k][axis] += side;
          corner[k][(axis + 1) % 3] += side ? (k == 1 || k == 2) : k >= 2;
          corner[k][(axis + 2) % 3] += side ? k >= 2 : (k == 1 || k == 2);
        }
        const std::uint32_t v[4] = { vertex(corner[0]), vertex(corner[1]), vertex(corner[2]), vertex(corner[3]) };
        soup.triangles.push_back({{ v[0], v[1], v[2] }});
        soup.triangles.push_back({{ v[0], v[2], v[3] }});
      }
  return soup;
}

// A row of rings: its surface has as many handles.
inline std::set<Cube> rings(int n)
{
  std::set<Cube> solid;
  for(int x = 0; x < 3; ++x)
    for(int y = 0; y <= 2 * n; ++y)
      if(x != 1 || y % 2 == 0)
        solid.insert({{ x, y, 0 }});
  return solid;
}

// Text with as many digits as it takes to read numbers back.
struct Exact_text : std::ostringstream
{
  Exact_text() { precision(17); }
};

// A line for each point, which begins like this.
inline void write_points(std::ostream& out, const Soup& soup, const char* beginning = "")
{
  for(const auto& p : soup.points)
    out << beginning << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
}

inline std::string as_off(const Soup& soup)
{
  Exact_text out;
  out << "OFF\n" << soup.points.size() << ' ' << soup.triangles.size() << " 0\n";
  write_points(out, soup);
  for(const auto& t : soup.triangles)
    out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return out.str();
}

inline std::string as_obj(const Soup& soup)
{
  Exact_text out;
  out << "# a mesh\n";
  write_points(out, soup, "v ");
  for(const auto& t : soup.triangles)
    out << "f " << t[0] + 1 << "//1 " << t[1] + 1 << "/2/1 " << long(t[2]) - long(soup.points.size()) << '\n';
  return out.str();
}

template <typename T>
void append(std::string& bytes, T value)
{
  char b[sizeof(T)];
  std::memcpy(b, &value, sizeof(T));
  if(flattening::is_big_endian())
    std::reverse(b, b + sizeof(T));
  bytes.append(b, sizeof(T));
}

inline std::string as_ply(const Soup& soup, bool is_text)
{
  Exact_text out;
  out << "ply\nformat " << (is_text ? "ascii" : "binary_little_endian") << " 1.0\nelement vertex " << soup.points.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << soup.triangles.size()
      << "\nproperty list uchar int vertex_indices\nproperty uchar label\nend_header\n";
  if(is_text)
  {
    write_points(out, soup);
    for(const auto& t : soup.triangles)
      out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << " 7\n";
    return out.str();
  }
  std::string bytes = out.str();
  for(const auto& p : soup.points)
    for(double x : p)
      append(bytes, x);
  for(const auto& t : soup.triangles)
  {
    append(bytes, std::uint8_t(3));
    for(std::uint32_t i : t)
      append(bytes, i);
    append(bytes, std::uint8_t(7));
  }
  return bytes;
}

inline std::string as_stl(const Soup& soup, bool is_text)
{
  Exact_text out;
  std::string bytes(80, ' ');
  append(bytes, static_cast<std::uint32_t>(soup.triangles.size()));
  out << "solid s\n";
  for(const auto& t : soup.triangles)
  {
    bytes.append(12, '\0');
    out << "facet normal 0 0 1\nouter loop\n";
    for(std::uint32_t i : t)
    {
      const auto& p = soup.points[i];
      out << "vertex " << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
      for(double x : p)
        append(bytes, std::fabs(x) <= double((std::numeric_limits<float>::max)()) ? static_cast<float>(x) : HUGE_VALF);
    }
    bytes.append(2, '\0');
    out << "endloop\nendfacet\n";
  }
  return is_text ? out.str() + "endsolid s\n" : bytes;
}

// Counts the vertices as they first come in the triangles, as readers of STL do.
inline Soup renumbered(const Soup& soup)
{
  Soup result;
  std::map<std::uint32_t, std::uint32_t> number;
  for(auto t : soup.triangles)
  {
    for(std::uint32_t& i : t)
    {
      const auto added = number.emplace(i, static_cast<std::uint32_t>(number.size()));
      if(added.second)
        result.points.push_back(soup.points[i]);
      i = added.first->second;
    }
    result.triangles.push_back(t);
  }
  return result;
}

// Triangles that follow each other and share a diagonal, as squares.
inline std::vector<std::vector<std::uint32_t> > squares(const Soup& soup)
{
  std::vector<std::vector<std::uint32_t> > faces;
  for(const auto& t : soup.triangles)
    if(! faces.empty() && faces.back().size() == 3 && faces.back()[0] == t[0] && faces.back()[2] == t[1])
      faces.back().push_back(t[2]);
    else
      faces.push_back({ t[0], t[1], t[2] });
  return faces;
}

inline std::string as_polygons(const Soup& soup)
{
  const auto faces = squares(soup);
  Exact_text out;
  out << "OFF\n" << soup.points.size() << ' ' << faces.size() << " 0\n";
  write_points(out, soup);
  for(const auto& face : faces)
  {
    out << face.size();
    for(std::uint32_t v : face)
      out << ' ' << v;
    out << '\n';
  }
  return out.str();
}

// Groups, materials, smoothing, normals; a line that is skipped, lines that are continued, and vertices after the faces.
inline std::string as_dressed_obj(const Soup& soup)
{
  Exact_text out;
  out << "\xEF\xBB\xBFmtllib m.mtl\no s\ng a b\nvn 0 0 1\n";
  std::size_t n = 0;
  for(const auto& face : squares(soup))
  {
    if(n++ % 7 == 3)
      out << "usemtl " << n << "\ns " << n % 3 << "\r\ng\nl 1 2\r";
    out << "f \\\n";
    for(std::uint32_t v : face)
      out << ' ' << v + 1 << (n % 3 == 0 ? "" : "//1");
    out << '\n';
  }
  for(const auto& p : soup.points)
    out << "v " << p[0] << ' ' << p[1] << " \\\r\n" << p[2] << " 0.5 0.5 0.5\n";
  return out.str();
}

// Strips, before the vertices, with another element between.
inline std::string as_strips(const Soup& soup)
{
  Exact_text out;
  out << "ply\rformat ascii 1.0\relement tristrips 1\rproperty list int int vertex_indices\relement edge 1\rproperty list uchar float a\r"
         "element vertex " << soup.points.size() << "\rproperty float x\rproperty double y\r"
         "property list uchar uchar b\rproperty double z\rend_header\r"
      << 4 * soup.triangles.size();
  for(const auto& t : soup.triangles)
    out << ' ' << t[0] << ' ' << t[1] << ' ' << t[2] << " -1";
  out << "\r2 0.5 0.5\r";
  for(const auto& p : soup.points)
    out << p[0] << ' ' << p[1] << " 0 " << p[2] << '\r';
  return out.str();
}

enum File_format { TEXT_OFF, TEXT_OBJ, TEXT_PLY, BINARY_PLY, TEXT_STL, BINARY_STL, POLYGON_OFF, DRESSED_OBJ, STRIP_PLY, NUMBER_OF_FORMATS };

inline void set_mesh(const Soup& soup, int format, Input& input)
{
  static const std::uint8_t extensions[NUMBER_OF_FORMATS] = { 0, 1, 2, 2, 3, 3, 0, 1, 2 };
  input.choices[FORMAT] = extensions[format];
  switch(format)
  {
    case TEXT_OFF:    input.mesh = as_off(soup); break;
    case TEXT_OBJ:    input.mesh = as_obj(soup); break;
    case POLYGON_OFF: input.mesh = as_polygons(soup); break;
    case DRESSED_OBJ: input.mesh = as_dressed_obj(soup); break;
    case STRIP_PLY:   input.mesh = as_strips(soup); break;
    case TEXT_PLY:
    case BINARY_PLY:  input.mesh = as_ply(soup, format == TEXT_PLY); break;
    default:          input.mesh = as_stl(soup, format == TEXT_STL);
  }
}

// the same surface in all formats, as the mesh of the input
inline void add_in_all_formats(Input input, const Soup& surface, std::vector<Input>& inputs)
{
  for(int format = 0; format < NUMBER_OF_FORMATS; ++format)
  {
    set_mesh(renumbered(surface), format, input);
    if(to_bytes(input).size() <= maximum_size)
      inputs.push_back(input);
  }
}

inline Input conditions(Boundary boundary, int retriangulation, int flags, const std::string& angles = "",
                        const std::string& cones = "", const std::string& scale = "", const std::string& corners = "")
{
  Input input;
  input.choices[BOUNDARY] = boundary;
  input.choices[CONES] = cones.empty() ? NO_CONES : FILE_OF_CONES;
  input.choices[RETRIANGULATION] = static_cast<std::uint8_t>(retriangulation);
  input.choices[FLAGS] = static_cast<std::uint8_t>(flags);
  input.choices[OUTPUTS] = OBJ | SVG | HTML;
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  input.choices[OUTPUTS] |= REPORT;
#endif
  input.choices[ITERATIONS] = maximum_number_of_iterations;
  input.texts = {{ corners, "1e-10", angles, scale, cones }};
  return input;
}

inline Input with_cones(Input input, std::uint8_t choice)
{
  input.choices[CONES] = choice;
  return input;
}

inline Input with_way(Input input, Way way, int vertex = 0)
{
  input.choices[WAY] = static_cast<std::uint8_t>(way + NUMBER_OF_WAYS * vertex);
  return input;
}

inline void add_inputs_of_several_components(std::vector<Input>& inputs)
{
  const Soup disks = together(grid(4, 0.3, 1), moved(grid(3, 0.2, 1), 8)), spheres = together(octahedron(), moved(cubes({ {{0, 0, 0}} }), 8));
  add_in_all_formats(conditions(RECTANGLE, 1, 0), disks, inputs);
  for(std::uint8_t choice : {cone_choice(PLACED, 2), cone_choice(SEAMLESS, 2, BY_NUMBER), cone_choice(SEAMLESS, 3, HEXAGONS)})
    add_in_all_formats(with_cones(conditions(NOT_GIVEN, 1, 0), choice), disks, inputs);
  for(Way w : {DISK, DISK_OF_POINTS, DISK_WITH_DIGITS})
    add_in_all_formats(with_way(conditions(NOT_GIVEN, 1, 0, "", "", "", "0,1,4"), w), disks, inputs);
  for(Way w : {SPHERE, SPHERE_WITH_DIGITS, REPAIR_TO_SPHERE})
    add_in_all_formats(with_way(conditions(NOT_GIVEN, 2, 0), w), spheres, inputs);
}

// All of them have solutions.
inline std::vector<Input> valid_inputs()
{
  std::vector<Input> inputs;
  const std::set<Cube> one = { {{0, 0, 0}} }, four = { {{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}} };
  add_in_all_formats(conditions(NOT_GIVEN, 0, 0), grid(1, 0, 1), inputs);
  add_in_all_formats(conditions(NATURAL, 0, PROJECTIVE), grid(4, 0.3, 1), inputs);
  add_in_all_formats(conditions(RECTANGLE, 1, UNIT_SQUARE), grid(3, 0.2, 1), inputs);
  add_in_all_formats(conditions(CORNERS, 0, QUASI_CONFORMAL, "", "", "", "0,4,8,7"), grid(2, 0.1, 1), inputs);
  add_in_all_formats(conditions(ANGLES, 1, 0, "1 120\n2 120\n3 120 # a corner\n"), fan(9, 1), inputs);
  add_in_all_formats(conditions(SCALE, 1, QUIET, "", "", "1 0.1\n2 -0.2\n3 0.5\n"), fan(6, 0.5), inputs);
  add_in_all_formats(conditions(ANGLES_AND_SCALE, 2, TOLERANCE, "0 90\n", "", "1 0.2\n"), grid(3, 0.5, 3), inputs);
  add_in_all_formats(conditions(NOT_GIVEN, 2, REFINE), fan(12, 0.01), inputs);
  add_in_all_formats(conditions(NOT_GIVEN, 2, 0, "", "0 180\n1 180\n2 180\n3 180\n"), octahedron(), inputs);
  add_in_all_formats(conditions(NOT_GIVEN, 0, SIMPLICIAL, "", "0 free\n1 free\n2 free\n"), octahedron(), inputs);
  add_in_all_formats(conditions(NOT_GIVEN, 1, 0, "", "0 270\n1 270\n2 270\n3 270\n4 270\n5 270\n6 270\n7 270\n"), cubes(one), inputs);
  add_in_all_formats(conditions(NOT_GIVEN, 1, 0), cubes(four, 0), inputs);
  add_in_all_formats(conditions(NOT_GIVEN, 0, 0), cubes(rings(1)), inputs);
  add_in_all_formats(conditions(NOT_GIVEN, 2, PROJECTIVE, "", "0 1080\n"), cubes(rings(2)), inputs);
  add_in_all_formats(conditions(NATURAL, 2, 0), cubes(rings(1), 1), inputs);
  add_in_all_formats(with_cones(conditions(NOT_GIVEN, 1, 0), cone_choice(PLACED, 2)), grid(4, 0.3, 1), inputs);
  add_in_all_formats(with_cones(conditions(NOT_GIVEN, 1, 0), cone_choice(PLACED_AND_QUANTIZED, 8)), cubes(one), inputs);
  add_in_all_formats(with_cones(conditions(NOT_GIVEN, 1, 0), cone_choice(SEAMLESS, 2, BY_NUMBER)), grid(5, 0.6, 1), inputs);
  add_in_all_formats(with_cones(conditions(NOT_GIVEN, 1, 0), cone_choice(SEAMLESS, 3, HEXAGONS)), grid(5, 0.6, 1), inputs);
  add_in_all_formats(with_cones(conditions(NOT_GIVEN, 1, 0, "", "0 270\n1 270\n2 270\n3 270\n4 270\n5 270\n6 270\n7 270\n"),
                                cone_choice(SEAMLESS_FILE, 1)), cubes(one), inputs);
  add_in_all_formats(with_cones(conditions(NOT_GIVEN, 2, 0, "", "0 180\n1 180\n2 180\n3 180\n"), cone_choice(SEAMLESS_FILE, 1, HALF_TURNS)),
                     octahedron(), inputs);
  add_in_all_formats(with_cones(conditions(NOT_GIVEN, 1, 0), cone_choice(SEAMLESS_WITHIN_BOUND, 1)), grid(4, 0.3, 1), inputs);
  for(Way w : {SPHERE, SPHERE_OF_AREAS, SPHERE_BY_VERTEX, SPHERE_WITH_DIGITS, REPAIR_TO_SPHERE})
    add_in_all_formats(with_way(conditions(NOT_GIVEN, 2, 0), w, 3), w == SPHERE || w == REPAIR_TO_SPHERE ? cubes(one) : octahedron(), inputs);
  for(Way w : {DISK, DISK_OF_AREAS, DISK_BY_VERTEX, DISK_AROUND_VERTEX, DISK_OF_POINTS, DISK_WITH_DIGITS, REPAIR_TO_DISK})
    add_in_all_formats(with_way(conditions(NOT_GIVEN, 1, 0, "", "", "", "0,1,4"), w, w == DISK_AROUND_VERTEX ? 5 : 0), grid(3, 0.3, 1), inputs);
  for(Way w : {DIGITS, KEPT_BORDER, LOCAL_REPAIR, MOLLIFICATION, REPAIR})
    add_in_all_formats(with_way(conditions(NATURAL, 0, 0), w), grid(4, 0.3, 1), inputs);
  add_inputs_of_several_components(inputs);
  return inputs;
}

// ------------------------------------------------------------------------------------------------
// Mutations
// ------------------------------------------------------------------------------------------------

class Mutator
{
public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  // Another surface, which can be read, or a few changes, of which some leave the mesh valid.
  void mutate(Input& input)
  {
    const bool is_new = below(3) == 0;
    if(is_new)
      set_new_surface(input);
    for(std::size_t n = is_new ? below(3) : 1 + below(4); n > 0; --n)
      switch(below(8))
      {
        case 0: case 1: mutate_choice(input); break;
        case 2: case 3: input.texts[ANGLE_FILE + below(3)] = new_conditions(); break;
        case 4: mutate_text(input.texts[below(NUMBER_OF_TEXTS)]); break;
        case 5: mutate_bytes(input.mesh); break;
        default: mutate_text(input.mesh); break;
      }
  }

  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_() % n); }

private:
  // --- surfaces ---

  static const std::vector<Soup>& surfaces()
  {
    static const std::vector<Soup> all = {
      grid(1, 0, 1), grid(2, 0.1, 1), grid(4, 0.3, 1), grid(5, 4, 0.1), fan(3, 1), fan(7, 0.5), fan(24, 0.01), octahedron(),
      cubes({ {{0, 0, 0}} }), cubes({ {{0, 0, 0}}, {{0, 0, 1}} }, 1), cubes(rings(1)), cubes(rings(1), 1), cubes(rings(2)),
      cubes(rings(2), 0) };
    return all;
  }

  // A surface with points moved, and conditions that can often be met.
  void set_new_surface(Input& input)
  {
    Soup soup = renumbered(surfaces()[below(surfaces().size())]);
    const bool is_closed = 2 * edges(soup) == 3 * soup.triangles.size();
    for(std::size_t n = below(16); n > 12; --n) // another component, or several
      soup = together(soup, below(2) == 0 ? soup : renumbered(surfaces()[below(surfaces().size())]));
    for(std::size_t n = below(4); n > 0; --n)
      deform(soup);
    if(below(16) == 0)
      soup.points.push_back(soup.points.front()); // isolated
    set_mesh(soup, static_cast<int>(below(NUMBER_OF_FORMATS)), input);

    input.choices[FLAGS] = static_cast<std::uint8_t>(below(4) == 0 ? below(256) : 0);
    input.choices[OUTPUTS] = OBJ | (below(4) == 0 ? SVG : 0) | (below(4) == 0 ? HTML : 0);
    input.choices[RETRIANGULATION] = static_cast<std::uint8_t>(below(3));
    input.choices[BOUNDARY] = static_cast<std::uint8_t>(is_closed ? std::size_t(NOT_GIVEN) : below(NUMBER_OF_BOUNDARIES));
    input.choices[ITERATIONS] = maximum_number_of_iterations;
    input.choices[CONES] = is_closed || below(4) == 0;
    input.choices[WAY] = static_cast<std::uint8_t>(below(3) == 0 ? below(256) : std::size_t(PLANE));
    input.texts[ANGLE_FILE] = new_conditions();
    input.texts[CONE_FILE] = is_closed && below(8) != 0 ? new_cones(soup) : new_conditions();
  }

  static std::size_t edges(const Soup& soup)
  {
    std::set<std::pair<std::uint32_t, std::uint32_t> > all;
    for(const auto& t : soup.triangles)
      for(std::size_t k = 0; k < 3; ++k)
        all.insert(std::minmax(t[k], t[(k + 1) % 3]));
    return all.size();
  }

  // The angles of some cones: their curvature is that of the surface, as Gauss and Bonnet have it.
  std::string new_cones(const Soup& soup)
  {
    const double euler = double(soup.points.size()) - double(soup.triangles.size()) / 2;
    std::map<std::size_t, double> shares;
    for(std::size_t n = 1 + below(below(4) == 0 ? 20 : 5); n > 0; --n)
      shares[below(soup.points.size())] = below(8) == 0 ? -0.2 * double(below(5)) : 1 + double(below(100));
    double sum = 0;
    for(const auto& share : shares)
      sum += share.second;
    Exact_text out;
    for(const auto& share : shares)
      out << share.first << ' ' << 360 - 360 * euler * share.second / sum << '\n';
    return out.str();
  }

  double power_of_two(std::size_t n) { return std::ldexp(1., static_cast<int>(below(2 * n + 1)) - static_cast<int>(n)); }

  void deform(Soup& soup)
  {
    const std::size_t v = below(soup.points.size()), w = below(soup.points.size()), k = below(3);
    const double scale = power_of_two(below(8) == 0 ? 600 : below(4) == 0 ? 60 : 10);
    switch(below(6))
    {
      case 0: // one axis: needles and caps
        for(auto& p : soup.points)
          p[k] *= scale;
        break;
      case 1: // all of them
        for(auto& p : soup.points)
          for(double& x : p)
            x *= scale;
        break;
      case 2: // two points that are one, or nearly
        soup.points[v] = soup.points[w];
        if(below(4) != 0)
          soup.points[v][k] += power_of_two(60);
        break;
      case 3: // noise
        for(auto& p : soup.points)
          for(double& x : p)
            x += (double(below(1001)) / 1000 - 0.5) * (std::min)(scale, 1.);
        break;
      case 4: // a far point
        soup.points[v][k] *= scale;
        break;
      default: // a point on a line
        for(std::size_t i = 0; i < 3; ++i)
          soup.points[v][i] = (soup.points[w][i] + soup.points[(w + 1) % soup.points.size()][i]) / 2;
    }
  }

  // --- parts of the input ---

  void mutate_choice(Input& input)
  {
    static const Choice most[] = { BOUNDARY, CONES, WAY, WAY, RETRIANGULATION, RETRIANGULATION, FLAGS, OUTPUTS, ITERATIONS };
    const std::size_t i = below(64) == 0 ? std::size_t(FORMAT) : std::size_t(most[below(sizeof most / sizeof *most)]);
    input.choices[i] = static_cast<std::uint8_t>(below(256));
  }

  std::string number()
  {
    static const char* special[] = { "nan", "inf", "-inf", "1e400", "-1e400", "1e-400", "-0", "0", "1e150", "1e-150", "1e308",
      "5e-324", "1e-17", "0.1", "2147483648", "4294967295", "4294967296", "9223372036854775807", "-9223372036854775808",
      "99999999999999999999", "-1", "1", "2", "3", "0x10", "+1", "++1", "1/2/3", "1e", ".", "#", "free", "" };
    switch(below(4))
    {
      case 0: return special[below(sizeof special / sizeof *special)];
      case 1: return std::to_string(below(64));
      case 2: return std::to_string(double(below(4001)) / 1000 - 2);
      default:
        std::ostringstream out;
        out.precision(17);
        out << std::ldexp(double(below(1 << 20)) / (1 << 19) - 1, static_cast<int>(below(120)) - 60);
        return out.str();
    }
  }

  // lines "vertex value", mostly of a sensible kind
  std::string new_conditions()
  {
    static const char* values[] = { "90", "180", "60", "45", "270", "360", "720", "30", "0.5", "0", "-1", "1", "-2.5", "20", "1e-9",
                                    "300", "359.9", "free", "1000", "7200" };
    std::string text;
    const std::size_t step = 1 + below(3), n = below(12);
    for(std::size_t i = below(16), k = 0; k < n; i += step, ++k)
      text += std::to_string(i) + ' ' + (below(16) == 0 ? number() : values[below(sizeof values / sizeof *values)]) + '\n';
    return text;
  }

  // [begin, end) of a word, or of a line
  std::pair<std::size_t, std::size_t> some_part(const std::string& s, const char* ends)
  {
    const std::size_t at = below(s.size());
    const std::size_t begin = s.find_last_of(ends, at), end = s.find_first_of(ends, at);
    return { begin == at ? at : begin == std::string::npos ? 0 : begin + 1, end == std::string::npos ? s.size() : end };
  }

  void mutate_text(std::string& s)
  {
    if(s.empty())
    {
      s = number();
      return;
    }
    const bool is_line = below(4) == 0;
    const char* ends = is_line ? "\n" : " \n/,";
    const auto part = some_part(s, ends);
    const std::size_t length = part.second - part.first;
    switch(below(is_line ? 3 : 8))
    {
      case 0: // again, elsewhere
      {
        const auto other = some_part(s, ends);
        s.insert(other.first, s.substr(part.first, length) + (is_line ? "\n" : " "));
        break;
      }
      case 1: // in the place of another
      {
        const std::string word = s.substr(part.first, length);
        const auto other = some_part(s, ends);
        s.replace(other.first, other.second - other.first, word);
        break;
      }
      case 2: // gone
        s.erase(part.first, length + (part.second < s.size()));
        break;
      default:
        s.replace(part.first, length, number());
    }
  }

  // From some place on.
  void replace_line_ends(std::string& s)
  {
    static const char* ends[] = { "\r", "\r\n", "\\\n", " \\\r\n", "\n\xEF\xBB\xBF", "\n#", " " };
    const std::string end = ends[below(sizeof ends / sizeof *ends)];
    for(std::size_t at = s.find('\n', below(s.size())), n = 1 + below(16); at != std::string::npos && n > 0; at = s.find('\n', at + end.size()), --n)
      s.replace(at, 1, end);
  }

  void mutate_bytes(std::string& s)
  {
    static const float special[] = { 0.f, -0.f, 1.f, 1e-38f, 1e-45f, 1e38f, HUGE_VALF, -HUGE_VALF, NAN };
    if(s.empty())
      return;
    const std::size_t at = below(s.size()), n = (std::min)(s.size() - at, std::size_t(1) << below(8));
    switch(below(8))
    {
      case 0: s[at] = static_cast<char>(s[at] ^ (1 << below(8))); break;
      case 1: s[at] = static_cast<char>(below(256)); break;
      case 2: s.erase(at, n); break;
      case 3: s.insert(below(s.size()), s.substr(at, n)); break;
      case 4: s.resize(at); break;
      case 6: replace_line_ends(s); break;
      case 5:
        if(at + 4 <= s.size())
          std::memcpy(&s[at], &special[below(sizeof special / sizeof *special)], 4);
        break;
      default: std::swap(s[at], s[below(s.size())]);
    }
  }

  std::mt19937_64 random_;
};

// ------------------------------------------------------------------------------------------------
// The drivers
// ------------------------------------------------------------------------------------------------

// Whether the outcome is good; otherwise says what is not.
inline bool is_good(const Input& input, int* status = nullptr)
{
  static const Folder folder;
  const std::string what = fault(input, folder, [](int argc, const char* const argv[], std::ostream& out, std::ostream& err)
                                 { return flatten_mesh(argc, argv, out, err); }, status);
  if(what.empty())
    return true;
  std::cerr << "FAULT: " << what << "\n  arguments:";
  for(const std::string& a : arguments(input, folder))
    std::cerr << ' ' << a;
  std::cerr << std::endl;
  return false;
}

} // namespace fuzzing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if(size <= fuzzing::maximum_size && ! fuzzing::is_good(fuzzing::parse(reinterpret_cast<const char*>(data), size)))
    std::abort();
  return 0;
}

#ifndef CGAL_CONFORMAL_EQUIVALENCE_FUZZ_STANDALONE

// What libFuzzer provides: its own mutations.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t maximum_size);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maximum_size, unsigned int seed)
{
  using namespace fuzzing;
  Mutator mutator(seed);
  if(mutator.below(4) == 0)
    return LLVMFuzzerMutate(data, size, maximum_size);
  if(size == 0 || mutator.below(256) == 0)
  {
    static const std::vector<Input> valid = valid_inputs();
    const std::string bytes = to_bytes(valid[mutator.below(valid.size())]);
    size = (std::min)(bytes.size(), maximum_size);
    std::memcpy(data, bytes.data(), size);
  }
  Input input = parse(reinterpret_cast<const char*>(data), size);
  mutator.mutate(input);
  const std::string bytes = to_bytes(input);
  size = (std::min)(bytes.size(), maximum_size);
  std::memcpy(data, bytes.data(), size);
  return size;
}

#else // CGAL_CONFORMAL_EQUIVALENCE_FUZZ_STANDALONE

namespace fuzzing {

typedef std::chrono::steady_clock Clock;

struct Settings
{
  std::size_t runs = 2000, first = 0;
  double seconds = 0; // 0: as long as it takes
  std::uint64_t seed = 1;
  std::string keep, corpus;
  std::vector<std::string> inputs;
};

inline Settings read_settings(int argc, char* argv[])
{
  Settings s;
  if(std::getenv("CONFORMAL_EQUIVALENCE_SKIP_SLOW_TESTS"))
    s.runs = 500;
  bool has_runs = false;
  for(int i = 1; i < argc; ++i)
  {
    const std::string option = argv[i];
    if(option.compare(0, 2, "--") != 0)
      s.inputs.push_back(option);
    else if(++i == argc)
      throw std::runtime_error(option + " needs a value");
    else if(option == "--runs")
      s.runs = std::stoul(argv[i]), has_runs = true;
    else if(option == "--first")
      s.first = std::stoul(argv[i]);
    else if(option == "--seconds")
      s.seconds = std::stod(argv[i]);
    else if(option == "--seed")
      s.seed = std::stoul(argv[i]);
    else if(option == "--keep")
      s.keep = argv[i];
    else if(option == "--corpus")
      s.corpus = argv[i];
    else
      throw std::runtime_error("unknown option " + option);
  }
  if(s.seconds > 0 && ! has_runs)
    s.runs = std::size_t(-1);
  return s;
}

inline void write_corpus(const std::string& folder)
{
  fs::create_directories(folder);
  const std::vector<Input> inputs = valid_inputs();
  for(std::size_t i = 0; i < inputs.size(); ++i)
    std::ofstream(fs::path(folder) / ("valid_" + std::to_string(i)), std::ios::binary) << to_bytes(inputs[i]);
  std::cout << inputs.size() << " inputs" << std::endl;
}

// The checks themselves see what is wrong: returns whether they refuse programs that misbehave.
inline bool checks_refuse_bad_programs()
{
  Input input = valid_inputs().front();
  const Folder folder;
  const auto writes = [&](const char* name, const char* content) { folder.write(name, content); return 0; };
  const char* const flipped = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/3 3/2\n";
  const char* const infinite = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt inf 0\nvt 0 1\nf 1/1 2/2 3/3\n";
  const char* const upright = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";
  const auto is_refused = [&](auto program)
  {
    return ! fault(input, folder, [&](int, const char* const*, std::ostream& out, std::ostream& err)
                                  { return program(out, err); }).empty();
  };
  const auto with_layout = [&](const char* obj)
    { return [&writes, obj](std::ostream& out, std::ostream&) { out << "done"; return writes("out.obj", obj); }; };

  bool is_good = is_refused([](auto&, auto& err) { err << "bad\n"; return 3; })
    && is_refused([](auto&, auto&) -> int { throw std::runtime_error("bad"); })
    && is_refused([](auto&, auto&) -> int { throw 1; })
    && is_refused([](auto&, auto& err) { try { CGAL_error(); } catch(const std::exception&) { err << "bad\n"; } return 1; })
    && is_refused([](auto&, auto& err) { err << "two\nlines\n"; return 1; })
    && is_refused([](auto&, auto&) { return 2; })
    && is_refused([](auto& out, auto& err) { out << "done"; err << "bad\n"; return 1; })
    && is_refused([&](auto&, auto& err) { err << "bad\n"; return writes("out.svg", "<svg/>") + 1; })
    && is_refused([&](auto&, auto& err) { err << "bad\n"; return writes("in.off", "") + 1; })
    && is_refused([](auto& out, auto&) { out << "done"; return 0; });
  input.choices[OUTPUTS] = OBJ;
  is_good = is_good && is_refused(with_layout(flipped)) && is_refused(with_layout(infinite)) && ! is_refused(with_layout(upright));
  if(! is_good)
    std::cerr << "the checks accept a program that misbehaves" << std::endl;
  return is_good;
}

// Ends the program if it is not called again in time: an endless loop is a fault.
inline void end_in(unsigned int seconds)
{
#if defined(__unix__) || defined(__APPLE__)
  std::signal(SIGALRM, [](int)
  {
    constexpr char message[] = "FAULT: no end in sight\n";
    const auto ignored = write(STDERR_FILENO, message, sizeof message - 1);
    static_cast<void>(ignored);
    std::abort();
  });
  alarm(seconds);
#else
  static_cast<void>(seconds);
#endif
}

// Counts of the outcomes, and the longest run.
struct Tally
{
  std::array<std::size_t, 3> number{};
  double longest = 0, sum = 0;
  std::size_t longest_run = 0;

  bool run(const Input& input)
  {
    end_in(240);
    const Clock::time_point begin = Clock::now();
    int status = 0;
    if(! is_good(input, &status))
      return false;
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    sum += seconds;
    if(seconds > longest)
    {
      longest = seconds;
      longest_run = total();
    }
    ++number[static_cast<std::size_t>(status)];
    return true;
  }

  std::size_t total() const { return number[0] + number[1] + number[2]; }
};

inline std::ostream& operator<<(std::ostream& out, const Tally& t)
{
  return out << t.total() << " runs: " << t.number[0] << " done, " << t.number[1] << " failed, " << t.number[2] << " wrong usage; "
             << t.sum << " s, the longest, number " << t.longest_run << ", " << t.longest << " s";
}

inline bool run_files(const std::vector<std::string>& files)
{
  bool result = true;
  for(const std::string& file : files)
  {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    std::cout << file << std::endl;
    Tally tally;
    result = tally.run(parse(bytes.data(), bytes.size())) && result;
    std::cout << tally << std::endl;
  }
  return result;
}

// The valid inputs, as they are: all of them succeed.
inline bool run_valid_inputs(const std::vector<Input>& valid)
{
  Tally tally;
  for(std::size_t i = 0; i < valid.size(); ++i)
    if(! tally.run(valid[i]) || tally.number[0] != i + 1)
    {
      std::cerr << "valid input " << i << " is refused" << std::endl;
      return false;
    }
  std::cout << "valid inputs: " << tally << std::endl;
  return true;
}

// Each run has its own mutations: input i of a seed is the same whatever was before.
inline bool run_mutations(const Settings& settings, const std::vector<Input>& valid)
{
  Tally tally;
  const Clock::time_point begin = Clock::now();
  for(std::size_t i = settings.first; i - settings.first < settings.runs; ++i)
  {
    if(settings.seconds > 0 && std::chrono::duration<double>(Clock::now() - begin).count() > settings.seconds)
      break;
    Mutator mutator((settings.seed << 32) + i);
    Input input = valid[mutator.below(valid.size())];
    mutator.mutate(input);
    const std::string bytes = to_bytes(input).substr(0, maximum_size);
    if(! settings.keep.empty())
      std::ofstream(settings.keep, std::ios::binary) << bytes; // also of a run that crashes
    if(! tally.run(parse(bytes.data(), bytes.size())))
    {
      std::cerr << "mutation " << i << " of seed " << settings.seed << " (--keep FILE keeps it)" << std::endl;
      return false;
    }
  }
  std::cout << "mutations: " << tally << std::endl;
  // mutations that hide all faults behind the first refusal would be of no use
  return tally.total() < 500 || *std::min_element(tally.number.begin(), tally.number.end()) > tally.total() / 100;
}

} // namespace fuzzing

int main(int argc, char* argv[])
{
  using namespace fuzzing;
  try
  {
    const Settings settings = read_settings(argc, argv);
    if(! settings.corpus.empty())
    {
      write_corpus(settings.corpus);
      return EXIT_SUCCESS;
    }
    if(! settings.inputs.empty())
      return run_files(settings.inputs) ? EXIT_SUCCESS : EXIT_FAILURE;
    const std::vector<Input> valid = valid_inputs();
    const bool result = checks_refuse_bad_programs() && run_valid_inputs(valid) && run_mutations(settings, valid);
    return result ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  catch(const std::exception& e)
  {
    std::cerr << e.what() << std::endl;
    return EXIT_FAILURE;
  }
}

#endif // CGAL_CONFORMAL_EQUIVALENCE_FUZZ_STANDALONE
