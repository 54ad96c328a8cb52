// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/options.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/option_table.h"
#include "../include/flatten_mesh/Scanner.h"
#include "../include/flatten_mesh/several_inputs.h"

#include <boost/program_options.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace flattening {

namespace {

namespace po = boost::program_options;

// A value that is one word. Alternatives are divided by '|': words in capitals stand for something, others are meant as they are.
po::typed_value<std::string>* word(const char* name) { return po::value<std::string>()->value_name(name); }

po::typed_value<std::string>* word(const char* name, const char* if_absent) { return word(name)->default_value(if_absent); }

po::options_description visible_options()
{
  po::options_description options("Options", 110, 76); // longer names of values have a line of their own
  options.add_options()
    ("output,o", po::value<std::vector<std::string> >()->composing()->value_name("FILE"),
       "write the mesh with the layout as texture coordinates to this file; once for each format:\n"
       ".obj (also other names without an extension, and '-'): all digits, with a material (.mtl, .checker.png) beside it\n"
       ".glb: glTF 2.0, in single precision, with a texture that fits the layout\n"
       ".ply: double precision, with u, the weights of --projective, and the charts; vertices are split at seams")
    ("flat", word("FILE"), "write the layout as a surface in the plane z = 0 to this OBJ file")
    ("dxf", word("FILE"), "write borders (layer OUTLINE) and seams (layer CUTS) of the layout as DXF, for cutters")
    ("svg", word("FILE"), "draw the layout")
    ("true-scale", word("MM"), "with --svg or --dxf, a unit of the layout is so many millimetres long: the drawing has its true "
       "width and height, the numbers of the DXF file are millimetres")
    ("html", word("FILE"), "write a page that shows the textured mesh and the layout")
    ("report", word("FILE"), "write the figures as JSON; of several inputs, those of all as one array, unless the name has a %")
    ("boundary", po::value<std::vector<std::string> >()->composing()->value_name("natural|rectangle[=I,J,K,L]|angles=FILE|scale=FILE|disk"),
       "conditions at the border\n"
       "natural: it keeps its lengths (default)\n"
       "rectangle[=I,J,K,L]: with corners at these vertices of one border, other borders stay natural; "
       "or, on topological disks, each with chosen corners\n"
       "angles=FILE: angle sums in degrees, lines 'vertex-index angle'\n"
       "scale=FILE: u, lines 'vertex-index u'\n"
       "angles and scale may both be given; border vertices not named have u = 0\n"
       "disk: the same as --target disk")
    ("target", word("plane|sphere|disk|hyperbolic", "plane"), "where the surface is mapped to\n"
       "sphere: the unit sphere, for closed surfaces without handles; the vertices of the OBJ file are points of the sphere\n"
       "disk: the unit disk, for topological disks; all border vertices are on the circle\n"
       "hyperbolic: the hyperbolic surface, in Poincare's disk, for one connected surface of negative Euler characteristic, or with cones whose "
       "curvatures leave an area; borders become geodesics, unless there is --boundary. Written are the disk coordinates of the corners (-o), a "
       "picture with copies (--svg, --html), and, without cones, the group, rounded and in exact numbers (--report). With --precision BITS u is "
       "found with so many digits (--report), while layout and group have those of two doubles\n"
       "Several components: each has a sphere or disk of its own, the i-th (from 0) of n with its centre in (2.25 (i mod c), 2.25 floor(i / c), 0), "
       "where c is the root of n, rounded up; spheres are objects component_i of the OBJ file, unless INPUT has objects")
    ("moebius-weights", word("vertices|areas", "vertices"), "what has its barycentre in the centre "
       "of the sphere, or of the sphere of which the disk is one half")
    ("disk-centre", word("I"), "this vertex, inside the surface, becomes the centre of the disk instead")
    ("disk-points", word("I,J,K"), "instead, these border vertices, counterclockwise, become 1, e^(2 pi i / 3) and e^(4 pi i / 3)")
    ("vertex-at-infinity", word("I"), "on the way to the sphere this vertex, to the disk this border vertex, is sent to "
       "infinity; chosen by default")
    ("frame", word("canonical|unit-square", "canonical"), "where the layout is: centred and not scaled, or within the unit square")
    ("cones", word("FILE|auto[=N]"),
       "cones inside the surface, lines 'vertex-index [angle in degrees | free]'; at a free cone, or where nothing "
       "follows the vertex, u = 0 and the angle is found. Closed surfaces need cones, except for tori\n"
       "auto[=N]: N cones place themselves, or as many as it takes for --max-scale, --max-area or --max-rms (a file of such a name is given as "
       "./auto); their angles are chosen with their places. On each component, and on one with fewer than N vertices inside as many as it has, "
       "unless all are such")
    ("max-scale", word("U"), "with --cones auto, cones are placed until |u| is at most U everywhere")
    ("max-area", word("A"), "with --cones auto, cones are placed until no triangle is scaled by more than the factor A, "
       "relative to the mean of the areas")
    ("max-rms", word("E"), "with --cones auto, cones are placed until the area-weighted root mean square of u, less its mean, "
       "is at most E")
    ("cone-measure", word("max|rms|area"), "what --cones auto makes small: the largest |u|, the root mean square of u, or the "
       "largest factor between areas; by default what is bounded, or, with --seamless, rms, and else max")
    ("quantize", word("[DEGREES]"), "the angles of cones are multiples of this one, 360 / n (90 if none "
       "is given): those of --cones auto are rounded, those of a file have to be")
    ("seamless", po::bool_switch(), "the layout is scaled, turned and deformed as little as it takes, so that a texture of tiles fits across the "
       "seams; the tiles are squares with --quantize 90 (default) or 180, hexagons with 60 or 120. Each component by itself; all fit the same tiles. "
       "Where straight triangles would be flipped, it fails; with --refine it mostly does not")
    ("holonomy", word("FILE"), "with --seamless, how loops around handles turn, lines 'k vertex-index vertex-index ...': the "
       "closed curve along these edges, on their left, turns by k times the angle of --quantize, modulo a full turn; by default all are chosen, "
       "as near as can be to what is conformal")
    ("tiles", word("T"), "with --seamless, about so many tiles on each component; by default as few as --distortion allows")
    ("distortion", word("D", "1.02"), "with --seamless, bound on the mean quasi-conformal factor of the deformation")
    ("lattice-coordinates", po::bool_switch(), "with --seamless, the texture coordinates are (a, b) for the point "
       "a + b e^(2 pi i / m), where m is 4 for squares and 6 for hexagons: then the motions across the seams are exact for hexagons, too")
    ("retriangulate", word("never|when-needed|always", "when-needed"), "whether edges are flipped\n"
       "never: edges are kept\n"
       "when-needed: edges are flipped where there is no solution otherwise (default)\n"
       "always: the result depends on the surface alone, not on its triangulation")
    ("keep-border", po::bool_switch(), "no border edge is flipped, so that all are as long as u at their ends makes them; fails where that cannot be")
    ("refine", po::bool_switch(), "if edges were flipped, write the mesh of the parts into which they cut the triangles, on which the "
       "map is projective; otherwise this is done with --projective, and where the triangles are flipped if their edges are drawn straight. With "
       "--seamless, these parts are laid out, of one component, mostly with success where straight triangles would be flipped")
    ("repair", po::bool_switch(), "first make the surface an oriented manifold: equal points are merged, degenerate and duplicate faces "
       "dropped, faces turned, and the surface is taken apart where it is no manifold. No vertex is moved, and all faces of INPUT are written")
    ("local-repair", po::bool_switch(), "no flips on the way; instead, where triangles break, edges of a copy of the mesh are flipped or split, "
       "and the copy is written")
    ("mollify", word("SLACK", "0"), "add the least constant to all lengths with which every triangle inequality "
       "holds with this slack, relative to the mean length; 0: none")
    ("projective", po::bool_switch(), "write homogeneous texture coordinates u*w, v*w, w")
    ("require-injective", po::bool_switch(), "fail if the layout overlaps itself, or if rounding has cost triangles of the sphere or the disk")
    ("color-by", word("u|qc", "u"), "colours of the drawing: u, or the quasi-conformal factor")
    ("tolerance", word("X", "1e-12"), "largest error of an angle sum, in radians")
    ("max-iterations", po::value<long long>()->default_value(100)->value_name("N"), "bound on the number of Newton steps")
    ("precision", word("double|BITS", "double"), "double, or numbers of so many bits to compute with (up to 16384), "
       "as exactly as they allow, and writes all of their digits")
    ("solver", word("multifrontal|simplicial|cholmod"), "the linear solver: of this package, of Eigen, or CHOLMOD if it is compiled in")
    ("threads", po::value<long long>()->default_value(1)->value_name("N"), "how many threads the solver may use, if TBB is compiled in; "
       "the result is the same for any number")
    ("default-input", word("FILE"), "the INPUT if none is given; for scripts")
    ("default-output", word("FOLDER"), "where NAME.obj, NAME.svg and NAME.json are written, NAME being that of INPUT without its "
       "extension, if no output is asked for; for scripts")
    ("format", word("off|obj|ply|stl"), "what INPUT is; by default its extension tells, and of the standard input its beginning")
    ("print", word("man|bash|zsh|fish"), "print the manual page, or what a shell needs to complete these options")
    ("quiet", po::bool_switch(), "no summary and no progress")
    ("help,h", po::bool_switch(), "show this text")
    ("version", po::bool_switch(), "show the version");
  return options;
}

void refuse_unknown_values(const po::variables_map& values)
{
  const auto check = [&](const char* name, const std::vector<std::string>& known)
  {
    const std::string value = values[name].as<std::string>();
    if(std::find(known.begin(), known.end(), value) == known.end())
      throw Usage_error(text("unknown value '", value, "' of --", name));
  };
  check("target", {"plane", "sphere", "disk", "hyperbolic"});
  check("moebius-weights", {"vertices", "areas"});
  check("frame", {"canonical", "unit-square"});
  check("retriangulate", {"never", "when-needed", "always"});
  check("color-by", {"u", "qc"});
  if(values.count("format"))
    check("format", {"off", "obj", "ply", "stl"});
}

// Whether an option is on the command line, with a value or as a switch.
bool is_given(const po::variables_map& values, const std::string& name)
{
  return values.count(name) != 0 && ! values[name].defaulted();
}

// `what` does not go with any of these options.
void exclude(const po::variables_map& values, const std::string& what, const std::vector<std::string>& names)
{
  for(const std::string& name : names)
    if(is_given(values, name))
      throw Usage_error(text(what, " and --", name, " exclude each other"));
}

// These options say something only together with `what`.
void require(bool is_there, const po::variables_map& values, const std::string& what, const std::vector<std::string>& names)
{
  for(const std::string& name : names)
    if(! is_there && is_given(values, name))
      throw Usage_error(text("--", name, " needs ", what));
}

// Different vertices, separated by commas; `what` takes them, and says how many.
template <std::size_t N>
std::array<std::size_t, N> parse_vertices(const std::string& list, const char* what)
{
  std::array<std::size_t, N> vertices;
  std::vector<std::string> words(1);
  for(char c : list)
    if(c == ',')
      words.emplace_back();
    else
      words.back() += c;
  bool is_good = words.size() == N;
  for(std::size_t k = 0; is_good && k < N; ++k)
  {
    std::int64_t i = 0;
    is_good = Scanner::parse(words[k], i) && i >= 0;
    vertices[k] = static_cast<std::size_t>(i);
    for(std::size_t j = 0; is_good && j < k; ++j)
      is_good = vertices[j] != vertices[k];
  }
  if(! is_good)
    throw Usage_error(text(what, ", not '", list, "'"));
  return vertices;
}

void parse_boundary(const std::vector<std::string>& values, Options& options)
{
  bool is_natural = false, is_disk = false;
  for(const std::string& value : values)
  {
    const std::size_t equals = value.find('=');
    const std::string kind = value.substr(0, equals);
    const bool has_argument = equals != std::string::npos;
    const std::string argument = has_argument ? value.substr(equals + 1) : "";
    std::string* file = kind == "angles" ? &options.angle_file : kind == "scale" ? &options.scale_file : nullptr;
    if(kind == "disk" && ! has_argument)
      is_disk = true;
    else if(kind == "natural" && ! has_argument)
      is_natural = true;
    else if(kind == "rectangle")
    {
      options.is_rectangle = true;
      if(has_argument)
        options.corners = parse_vertices<4>(argument, "--boundary rectangle= takes the indices of four different vertices");
    }
    else if(file == nullptr)
      throw Usage_error(text("unknown value '", value, "' of --boundary"));
    else if(argument.empty())
      throw Usage_error(text("--boundary ", kind, " needs a file: ", kind, "=FILE"));
    else if(! file->empty())
      throw Usage_error(text("--boundary ", kind, " is given twice"));
    else
      *file = argument;
  }
  const bool is_from_files = ! options.angle_file.empty() || ! options.scale_file.empty();
  if(is_natural + is_disk + options.is_rectangle + is_from_files > 1 || (! is_from_files && values.size() > 1))
    throw Usage_error("these values of --boundary exclude each other; only angles=FILE and scale=FILE go together");
  if(is_disk)
    options.target = Target::DISK;
}

// What is said of a map to the sphere or the disk, `target`; other options do not go with it.
void parse_options_of_target(const po::variables_map& values, const std::string& target, Options& options)
{
  const auto vertex = [&](const char* name) -> std::optional<std::size_t>
  {
    if(! is_given(values, name))
      return std::nullopt;
    return parse_vertices<1>(values[name].as<std::string>(), text("--", name, " takes the index of a vertex").c_str())[0];
  };
  options.vertex_at_infinity = vertex("vertex-at-infinity");
  options.disk_centre = vertex("disk-centre");
  if(is_given(values, "disk-points"))
    options.disk_points = parse_vertices<3>(values["disk-points"].as<std::string>(), "--disk-points takes the indices of three different vertices");
  options.weighs_areas = values["moebius-weights"].as<std::string>() == "areas";

  require(options.target != Target::PLANE, values, "--target sphere or --target disk", {"vertex-at-infinity", "moebius-weights"});
  require(options.target == Target::DISK, values, "--target disk", {"disk-centre", "disk-points"});
  if(options.target == Target::PLANE)
    return;
  if(options.target == Target::HYPERBOLIC && (! options.glb.empty() || ! options.ply.empty()))
    throw Usage_error(target + " has no output in the formats GLB and PLY; -o *.obj has the disk coordinates");
  if(options.target == Target::HYPERBOLIC)
    exclude(values, target, {"vertex-at-infinity", "moebius-weights", "refine", "projective", "require-injective", "color-by",
                             "flat", "dxf", "true-scale"});
  else
    exclude(values, target, {"cones"});
  exclude(values, target, {"seamless", "frame", "keep-border", "local-repair"});
  if(options.target == Target::SPHERE)
    exclude(values, target, {"projective", "flat", "dxf", "true-scale"});
  if(is_given(values, "disk-centre"))
    exclude(values, "--disk-centre", {"disk-points", "moebius-weights"});
  if(is_given(values, "disk-points"))
    exclude(values, "--disk-points", {"moebius-weights"});
}

// Where the surface is mapped to: by --target, or by --boundary disk, which was read.
void parse_target(const po::variables_map& values, Options& options)
{
  const std::string name = values["target"].as<std::string>(), option = "--target " + name;
  const bool is_given = ! values["target"].defaulted(), is_boundary_disk = options.target == Target::DISK;
  const bool takes_boundary = name == "plane" || (name == "hyperbolic" && ! options.is_rectangle);
  if(values.count("boundary") && ((is_boundary_disk && is_given && name != "disk") || (! is_boundary_disk && ! takes_boundary)))
    throw Usage_error(text(option, " and --boundary ", values["boundary"].as<std::vector<std::string> >()[0], " exclude each other"));
  if(! is_boundary_disk)
    options.target = name == "sphere" ? Target::SPHERE : name == "disk" ? Target::DISK : name == "hyperbolic" ? Target::HYPERBOLIC : Target::PLANE;
  parse_options_of_target(values, is_boundary_disk && ! is_given ? "--boundary disk" : option, options);
}

// A finite number above `bound`.
double parse_number_above(double bound, const po::variables_map& values, const char* name)
{
  const std::string word = values[name].as<std::string>();
  double x = 0;
  if(! Scanner::parse(word, x) || ! std::isfinite(x) || ! (x > bound))
    throw Usage_error(text("--", name, " takes a number above ", bound, ", not '", word, "'"));
  return x;
}

// A positive integer.
std::size_t parse_count(const std::string& word, const std::string& option)
{
  std::int64_t n = 0;
  if(! Scanner::parse(word, n) || n < 1)
    throw Usage_error(text(option, " takes a positive integer, not '", word, "'"));
  return static_cast<std::size_t>(n);
}

// How often an angle goes into a full turn.
unsigned int parse_quantum(const std::string& word)
{
  const double most = 2520;
  double degrees = 0;
  if(! Scanner::parse(word, degrees) || ! (degrees >= 360 / most) || ! (degrees <= 360)
     || std::abs(360 / degrees - std::round(360 / degrees)) > 1e-6)
    throw Usage_error(text("--quantize takes 360 degrees divided by an integer up to ", most, ", not '", word, "'"));
  return static_cast<unsigned int>(std::round(360 / degrees));
}

CGAL::Conformal_equivalence::Cone_measure parse_cone_measure(const std::string& word)
{
  typedef CGAL::Conformal_equivalence::Cone_measure Measure;
  if(word == "max")
    return Measure::MAXIMUM_U;
  if(word == "rms")
    return Measure::ROOT_MEAN_SQUARE_U;
  if(word == "area")
    return Measure::AREA_DISTORTION;
  throw Usage_error("--cone-measure takes max, rms or area, not '" + word + "'");
}

void parse_placement(const po::variables_map& values, Options& options)
{
  const std::string cones = values["cones"].as<std::string>();
  options.places_cones = true;
  if(cones != "auto")
    options.number_of_cones = parse_count(cones.substr(5), "--cones auto=");
  if(is_given(values, "max-scale"))
    options.maximum_log_scale_factor = parse_number_above(0, values, "max-scale");
  if(is_given(values, "max-area"))
    options.maximum_area_distortion = parse_number_above(1, values, "max-area");
  if(is_given(values, "max-rms"))
    options.maximum_root_mean_square = parse_number_above(0, values, "max-rms");
  if(is_given(values, "cone-measure"))
    options.cone_measure = parse_cone_measure(values["cone-measure"].as<std::string>());
  if(cones == "auto" && ! is_given(values, "max-scale") && ! is_given(values, "max-area") && ! is_given(values, "max-rms"))
    throw Usage_error("--cones auto needs a number (--cones auto=N), or a bound (--max-scale U, --max-area A or --max-rms E); "
                      "a file of this name: ./auto");
  for(const std::string& boundary : values.count("boundary") ? values["boundary"].as<std::vector<std::string> >() : std::vector<std::string>())
    if(boundary != "natural")
      throw Usage_error(text("--cones ", cones, " and --boundary ", boundary, " exclude each other: cones are placed for natural borders"));
}

void parse_seamless(const po::variables_map& values, Options& options)
{
  options.seamless = true;
  if(options.quanta_of_turn == 0)
    options.quanta_of_turn = 4;
  const unsigned int n = options.quanta_of_turn;
  if(n != 2 && n != 3 && n != 4 && n != 6)
    throw Usage_error("--seamless takes --quantize 180, 120, 90 or 60: there are no tiles for other angles");
  if(is_given(values, "tiles"))
    options.number_of_tiles = parse_count(values["tiles"].as<std::string>(), "--tiles");
  options.maximum_distortion = parse_number_above(1, values, "distortion");
  options.lattice_coordinates = values["lattice-coordinates"].as<bool>();
  if(is_given(values, "holonomy"))
    options.holonomy_file = values["holonomy"].as<std::string>();
  exclude(values, "--seamless", {"projective"}); // what is deformed is not conformal, and has no such weights
  if(values["frame"].as<std::string>() == "unit-square")
    throw Usage_error("--seamless and --frame unit-square exclude each other");
  if(is_given(values, "tiles"))
    exclude(values, "--tiles", {"distortion"});
}

// Cones, given in a file or to be placed; and what becomes of them in the layout.
void parse_cones(const po::variables_map& values, Options& options)
{
  const std::string cones = is_given(values, "cones") ? values["cones"].as<std::string>() : "";
  const bool is_auto = cones == "auto" || cones.compare(0, 5, "auto=") == 0, is_seamless = values["seamless"].as<bool>();
  if(is_given(values, "cones") && cones.empty())
    throw Usage_error("--cones needs the name of a file");
  if(is_auto && options.target == Target::HYPERBOLIC)
    throw Usage_error("--target hyperbolic takes --cones FILE, but not --cones auto, whose cones make a surface flat and leave it no hyperbolic "
                      "area");
  require(is_auto, values, "--cones auto", {"max-scale", "max-area", "max-rms", "cone-measure"});
  require(is_seamless, values, "--seamless", {"tiles", "distortion", "lattice-coordinates", "holonomy"});
  require(is_seamless || ! cones.empty(), values, "--cones or --seamless", {"quantize"});
  if(is_given(values, "quantize"))
    options.quanta_of_turn = parse_quantum(values["quantize"].as<std::string>());
  if(is_auto)
    parse_placement(values, options);
  else
    options.cone_file = cones;
  if(is_seamless)
    parse_seamless(values, options);
  if(! is_auto && ! is_seamless)
    return;
  const std::string what = is_seamless ? "--seamless" : "--cones " + cones;
  exclude(values, what, {"local-repair"});
  if(values["precision"].as<std::string>() != "double")
    throw Usage_error(what + " is computed with --precision double only");
}

void parse_numbers(const po::variables_map& values, Options& options)
{
  const std::string tolerance = values["tolerance"].as<std::string>();
  if(! Scanner::parse(tolerance, options.tolerance) || ! std::isfinite(options.tolerance) || ! (options.tolerance > 0))
    throw Usage_error(text("--tolerance takes a positive number, not '", tolerance, "'"));
  const std::string precision = values["precision"].as<std::string>();
  std::int64_t bits = 53;
  if(precision != "double" && (! Scanner::parse(precision, bits) || bits < 2 || bits > most_bits))
    throw Usage_error(text("--precision takes 'double' or a number of bits up to ", most_bits, ", not '", precision, "'"));
  options.precision_in_bits = static_cast<unsigned int>((std::max)(bits, std::int64_t(53)));
  const std::string slack = values["mollify"].as<std::string>();
  if(! Scanner::parse(slack, options.mollification) || ! (options.mollification >= 0) || ! (options.mollification <= 1))
    throw Usage_error(text("--mollify takes a number from 0 to 1, not '", slack, "'"));
  const long long iterations = values["max-iterations"].as<long long>();
  if(iterations < 0 || iterations > 1000000)
    throw Usage_error("--max-iterations takes a number from 0 to 1000000");
  options.maximum_number_of_iterations = static_cast<unsigned int>(iterations);
  const long long threads = values["threads"].as<long long>();
  if(threads < 1 || threads > 1000)
    throw Usage_error("--threads takes a number from 1 to 1000");
  options.number_of_threads = static_cast<unsigned int>(threads);
}

CGAL::Conformal_equivalence::Retriangulation parse_retriangulation(const std::string& value)
{
  typedef CGAL::Conformal_equivalence::Retriangulation Retriangulation;
  return value == "always" ? Retriangulation::ALWAYS : value == "when-needed" ? Retriangulation::WHEN_NEEDED : Retriangulation::NEVER;
}

// The words of the command line. What follows --quantize belongs to it if it is a number, and only then.
std::vector<std::string> words_of_command_line(int argc, const char* const argv[])
{
  std::vector<std::string> words;
  for(int i = 1; i < argc; ++i)
  {
    words.push_back(argv[i]);
    double degrees;
    if(words.back() == "--quantize")
      words.back() += i + 1 < argc && Scanner::parse(argv[i + 1], degrees) ? std::string("=") + argv[++i] : "=90";
  }
  return words;
}

// What was given, beside the inputs, in its order.
std::vector<Given_option> given_options(const po::parsed_options& parsed)
{
  std::vector<Given_option> given;
  for(const po::option& option : parsed.options)
    if(option.string_key != "input")
      given.push_back({option.string_key, option.value.empty() ? std::nullopt : std::optional<std::string>(option.value[0])});
  return given;
}

po::variables_map parse_command_line(int argc, const char* const argv[], std::vector<Given_option>& given)
{
  po::options_description all;
  all.add(visible_options()).add_options()("input", po::value<std::vector<std::string> >());
  po::positional_options_description positions;
  positions.add("input", -1);
  po::variables_map values;
  try
  {
    namespace style = po::command_line_style;
    const po::parsed_options parsed = po::command_line_parser(words_of_command_line(argc, argv)).options(all).positional(positions)
                                        .style(style::default_style & ~style::allow_guessing).run();
    given = given_options(parsed);
    po::store(parsed, values);
    po::notify(values);
  }
  catch(const po::error& e)
  {
    throw Usage_error(e.what());
  }
  return values;
}

// The file of an output, empty if it is not wanted.
std::string output_file(const po::variables_map& values, const char* option)
{
  if(! values.count(option))
    return "";
  const std::string file = values[option].as<std::string>();
  if(file.empty())
    throw Usage_error(text("--", option, " needs the name of a file"));
  return file;
}

// Whether the extension is this one, in upper or lower case.
bool has_extension(const std::string& file, std::string extension)
{
  std::string found = std::filesystem::path(file).extension().string();
  std::transform(found.begin(), found.end(), found.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return found == extension;
}

// Whether something is there that is no regular file, such as a device, which may have any name.
bool is_special_file(const std::string& file)
{
  std::error_code ignored;
  return std::filesystem::exists(file, ignored) && ! std::filesystem::is_regular_file(file, ignored);
}

// What is written where nothing else was asked for.
void set_default_outputs(const std::string& folder, Options& options)
{
  const auto output = [&](const char* extension) { return (std::filesystem::path(literal_name(folder)) / (std::string("%") + extension)).string(); };
  std::error_code ignored; // what cannot be written is told later
  std::filesystem::create_directories(folder, ignored);
  options.obj = output(".obj");
  options.svg = output(".svg");
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  options.report = output(".json");
#endif
}

// One file of -o, whose extension says its format.
void parse_output(const std::string& file, Options& options)
{
  if(file.empty())
    throw Usage_error("--output needs the name of a file");
  const bool is_obj = file == "-" || std::filesystem::path(file).extension().empty() || has_extension(file, ".obj") || is_special_file(file);
  if(! is_obj && ! has_extension(file, ".glb") && ! has_extension(file, ".ply"))
    throw Usage_error(text("-o writes OBJ files, named *.obj, GLB files, named *.glb, and PLY files, named *.ply, not '", file, "'"));
  std::string& place = is_obj ? options.obj : has_extension(file, ".glb") ? options.glb : options.ply;
  if(! place.empty())
    throw Usage_error(text("-o is given once for each format, not for both '", place, "' and '", file, "'"));
  place = file;
}

// The files to be read and written.
void parse_files(const po::variables_map& values, Options& options)
{
  if(values.count("output"))
    for(const std::string& file : values["output"].as<std::vector<std::string> >())
      parse_output(file, options);
  options.svg = output_file(values, "svg");
  options.html = output_file(values, "html");
  options.report = output_file(values, "report");
  options.flat = output_file(values, "flat");
  options.dxf = output_file(values, "dxf");
  require(! options.svg.empty() || ! options.dxf.empty(), values, "--svg or --dxf", {"true-scale"});
  if(is_given(values, "true-scale"))
    options.true_scale = parse_number_above(0, values, "true-scale");
#ifndef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  if(! options.report.empty())
    throw Usage_error("--report is not available: the program was built without nlohmann-json");
#endif
  if(values.count("input"))
    options.inputs = values["input"].as<std::vector<std::string> >();
  else if(values.count("default-input"))
    options.inputs = { values["default-input"].as<std::string>() };
  if(values.count("format"))
    options.format = values["format"].as<std::string>();
  const std::vector<std::string> files = outputs(options);
  if(values.count("default-output") && std::all_of(files.begin(), files.end(), [](const std::string& file) { return file.empty(); }))
    set_default_outputs(values["default-output"].as<std::string>(), options);
}

// Of several inputs, each has files of its own.
void check_names_of_outputs(const Options& options)
{
  const auto check = [&](const char* option, const std::string& file)
  {
    if(options.inputs.size() > 1 && ! file.empty() && ! names_input(file))
      throw Usage_error(text(option, " needs a % in the name of its file, which stands for the name of each of the several inputs"));
  };
  for(const std::string& file : {options.obj, options.glb, options.ply})
    check("-o", file);
  check("--flat", options.flat);
  check("--dxf", options.dxf);
  check("--svg", options.svg);
  check("--html", options.html);
}

// The standard input and output can be used once each.
void check_standard_streams(const Options& options)
{
  const auto number = [](const std::vector<std::string>& files) { return std::count(files.begin(), files.end(), "-"); };
  const auto inputs = number(options.inputs), conditions = number({options.cone_file, options.holonomy_file, options.angle_file, options.scale_file});
  if(inputs + conditions > 1 || (conditions != 0 && options.inputs.size() > 1))
    throw Usage_error("the standard input, '-', can be read only once");
  if(number(outputs(options)) > 1)
    throw Usage_error("only one output can be written to the standard output, '-'");
}

// The linear solvers compiled in, the default first.
std::vector<std::string> solver_names()
{
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_CHOLMOD
  return { "multifrontal", "simplicial", "cholmod" };
#else
  return { "multifrontal", "simplicial" };
#endif
}

} // namespace

std::vector<std::string*> places_of_outputs(Options& options)
{
  return { &options.obj, &options.glb, &options.ply, &options.flat, &options.dxf, &options.svg, &options.html, &options.report };
}

std::vector<std::string> outputs(Options options)
{
  std::vector<std::string> names;
  for(const std::string* name : places_of_outputs(options))
    names.push_back(*name);
  return names;
}

std::string help_text()
{
  std::ostringstream out;
  out << "Usage: " << synopsis << "\n" << introduction << exit_status << "\n" << visible_options();
  return out.str();
}

std::vector<Option_entry> option_table()
{
  const po::options_description options = visible_options(); // what it holds lives as long as it does
  std::vector<Option_entry> table;
  for(const auto& option : options.options())
  {
    Option_entry entry;
    entry.name = option->long_name();
    const std::string letter = option->canonical_display_name(po::command_line_style::allow_dash_for_short); // "-o", or the name if there is none
    entry.letter = letter.size() == 2 && letter[0] == '-' ? letter.substr(1) : "";
    entry.value = option->semantic()->max_tokens() == 0 ? "" : option->format_parameter();
    const std::size_t preset = entry.value.find(" (="); // Boost.Program_options appends what is meant if the option is absent
    if(preset != std::string::npos)
    {
      entry.if_absent = entry.value.substr(preset + 3, entry.value.size() - preset - 4);
      entry.value.erase(preset);
    }
    entry.description = option->description();
    entry.is_repeatable = option->semantic()->is_composing();
    table.push_back(entry);
  }
  return table;
}

Options parse_options(int argc, const char* const argv[])
{
  Options options;
  const po::variables_map values = parse_command_line(argc, argv, options.given);
  options.is_help = values["help"].as<bool>();
  options.is_version = values["version"].as<bool>();
  if(values.count("print"))
    options.printed = values["print"].as<std::string>();
  if(options.is_help || options.is_version || ! options.printed.empty())
    return options;
  refuse_unknown_values(values);
  parse_files(values, options);
  if(options.inputs.empty() || std::count(options.inputs.begin(), options.inputs.end(), "") != 0)
    throw Usage_error("no INPUT is given");
  check_names_of_outputs(options);
  if(values.count("boundary"))
    parse_boundary(values["boundary"].as<std::vector<std::string> >(), options);
  parse_target(values, options);
  parse_cones(values, options);
  parse_numbers(values, options);
  options.unit_square = values["frame"].as<std::string>() == "unit-square";
  options.color_by_quasi_conformal_factor = values["color-by"].as<std::string>() == "qc";
  options.retriangulation = parse_retriangulation(values["retriangulate"].as<std::string>());
  options.keep_border = values["keep-border"].as<bool>();
  options.refine = values["refine"].as<bool>();
  options.repair = values["repair"].as<bool>();
  options.local_repair = values["local-repair"].as<bool>();
  if(options.local_repair && ! values["retriangulate"].defaulted())
    throw Usage_error("--local-repair and --retriangulate exclude each other");
  if(options.local_repair && values["precision"].as<std::string>() != "double")
    throw Usage_error("--local-repair is computed with --precision double only");
  options.projective = values["projective"].as<bool>();
  options.require_injective = values["require-injective"].as<bool>();
  options.quiet = values["quiet"].as<bool>();
  if(values.count("solver"))
    options.solver = values["solver"].as<std::string>();
  check_standard_streams(options);
  return options;
}

void check_solver(const std::string& name)
{
  std::string known;
  for(const std::string& s : solver_names())
  {
    if(name.empty() || name == s)
      return;
    known += (known.empty() ? "" : ", ") + s;
  }
  throw Usage_error(text("unknown solver '", name, "'; this program has: ", known));
}

} // namespace flattening
