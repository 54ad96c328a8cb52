// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The mesh, and what is prescribed on it.

#include "../include/flatten_mesh/conditions.h"
#include "../include/flatten_mesh/Components.h"
#include "../include/flatten_mesh/each_component.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/Polygon_soup.h"
#include "../include/flatten_mesh/Progress.h"
#include "../include/flatten_mesh/Scanner.h"

#include <CGAL/Conformal_equivalence/boundary_conditions.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace flattening {

namespace {

// The vertex that a line of a file begins with.
Vertex read_vertex(Scanner& in, const Given_surface& given)
{
  const std::int64_t i = in.integer_in_line();
  return given.vertex_of_mesh(i, text(in.file(), ": line ", in.line(), ": "));
}

void require_inside(const Scanner& in, const Mesh& mesh, Vertex v)
{
  if(mesh.is_isolated(v))
    in.error("vertex ", v.idx(), " has no face, it cannot be a cone");
  if(mesh.is_border(v))
    in.error("vertex ", v.idx(), " is on the border; a cone lies inside the surface");
}

// Whether angles of a file were in radians, and not in degrees, is seen by their size: a full turn has less than 7.
class Unit_of_angles
{
public:
  void add(double angle)
  {
    ++number_;
    largest_ = (std::max)(largest_, angle);
  }

  void require_degrees(const std::string& file) const
  {
    if(number_ != 0 && largest_ < 7)
      fail(file, ": all angles are below 7, as if they were in radians; they have to be in degrees");
  }

private:
  std::size_t number_ = 0;
  double largest_ = 0;
};

// A number of degrees; of a multiple of 360 / `quanta_of_turn`, if that is not zero, its rounding is undone.
double multiple_of_quantum(const Scanner& in, Vertex v, double degrees, unsigned int quanta_of_turn)
{
  if(quanta_of_turn == 0)
    return degrees;
  const double multiple = std::round(degrees * quanta_of_turn / 360), nearest = multiple * 360 / quanta_of_turn;
  if(! (multiple > 0) || std::abs(degrees - nearest) > 1e-6)
    in.error("vertex ", v.idx(), ": the angle ", degrees, " is no multiple of ", 360. / quanta_of_turn, " degrees (--quantize)");
  return nearest;
}

// In radians, from a word in degrees.
double cone_angle(const Scanner& in, Vertex v, std::string_view word, unsigned int quanta_of_turn)
{
  double degrees = 0;
  if(! Scanner::parse(word, degrees))
    in.error("vertex ", v.idx(), ": expected an angle in degrees or 'free', found '", Scanner::printable(word), "'");
  if(! std::isfinite(degrees))
    in.error("vertex ", v.idx(), ": the angle ", degrees, " is not a finite number");
  if(! (degrees / 180 * CGAL_PI > 0))
    in.error("vertex ", v.idx(), ": the angle ", degrees, " is not positive");
  return multiple_of_quantum(in, v, degrees, quanta_of_turn) / 180 * CGAL_PI;
}

// Calls `fix(vertex)` for each cone of free angle, and `prescribe(vertex, angle)` for each of the others, in the
// lines "vertex-index [angle in degrees | free]" of the file; # begins a comment. Each vertex is
// inside the surface and is listed once. No angle is free if all are to be multiples of 360 / `quanta_of_turn`.
template <typename Fix, typename Prescribe>
void read_cone_file(const std::string& file, const Mesh& mesh, const Given_surface& given, unsigned int quanta_of_turn, Fix fix, Prescribe prescribe)
{
  const std::string content = read_file(file);
  Scanner in(content, file, '#');
  std::unordered_map<std::size_t, std::size_t> line_of;
  Unit_of_angles unit;
  for(; ! in.at_end(); in.skip_line())
  {
    const Vertex v = read_vertex(in, given);
    require_inside(in, mesh, v);
    const auto listed = line_of.emplace(v.idx(), in.line());
    if(! listed.second)
      in.error("vertex ", v.idx(), " is listed twice, first in line ", listed.first->second);
    const std::string_view word = in.word_in_line();
    if(! word.empty() && word != "free")
    {
      const double angle = cone_angle(in, v, word, quanta_of_turn);
      unit.add(angle / CGAL_PI * 180);
      prescribe(v, angle);
    }
    else if(quanta_of_turn == 0)
      fix(v);
    else
      in.error("vertex ", v.idx(), ": a free cone has any angle, not a multiple of ", 360. / quanta_of_turn, " degrees (--quantize)");
    if(! in.at_end_of_line())
      in.error("vertex ", v.idx(), ": expected nothing after '", Scanner::printable(word), "', found '",
               Scanner::printable(in.word()), "'");
  }
  unit.require_degrees(file);
}

// Calls `use(vertex, value)` for each line "vertex-index value" of the file; # begins
// a comment. Each vertex is on the border and is named once, in `is_named`.
template <typename Use>
void read_condition_file(const std::string& file, const Mesh& mesh, const Given_surface& given, std::vector<bool>& is_named, Use use)
{
  const std::string content = read_file(file);
  Scanner in(content, file, '#');
  for(; ! in.at_end(); in.skip_line())
  {
    const Vertex v = read_vertex(in, given);
    const double value = in.number_in_line();
    if(! in.at_end_of_line())
      in.error("expected only a vertex and a number");
    if(! is_on_border(mesh, v))
      in.error("vertex ", v.idx(), " is not on the border");
    if(is_named[v])
      in.error("vertex ", v.idx(), " has a condition already");
    if(! std::isfinite(value))
      in.error("vertex ", v.idx(), ": ", value, " is not a finite number");
    is_named[v] = true;
    use(in, v, value);
  }
}

// Beyond that e^u is no `double` with all of its digits.
const double largest_log_scale_factor = 700;

void read_border_conditions(const Options& options, const Mesh& mesh, const Given_surface& given, Conditions& conditions)
{
  std::vector<bool> is_named(mesh.number_of_vertices(), false);
  Unit_of_angles unit;
  if(! options.angle_file.empty())
    read_condition_file(options.angle_file, mesh, given, is_named, [&](const Scanner& in, Vertex v, double degrees)
    {
      if(! (degrees > 0))
        in.error("the angle at vertex ", v.idx(), " must be positive");
      unit.add(degrees);
      conditions.border_angle[v] = degrees / 180 * CGAL_PI;
      conditions.is_constrained[v] = false;
    });
  unit.require_degrees(options.angle_file);
  if(! options.scale_file.empty())
    read_condition_file(options.scale_file, mesh, given, is_named, [&](const Scanner& in, Vertex v, double u)
    {
      if(std::abs(u) > largest_log_scale_factor)
        in.error("vertex ", v.idx(), ": u = ", u, " is beyond the range, from ", -largest_log_scale_factor, " to ", largest_log_scale_factor,
                 ": lengths are multiplied by e^u");
      conditions.u[v] = u;
    });
}

std::array<Vertex, 4> given_corners(const std::array<std::size_t, 4>& indices, const Mesh& mesh)
{
  std::array<Vertex, 4> corners;
  for(std::size_t k = 0; k < 4; ++k)
  {
    if(indices[k] >= mesh.number_of_vertices())
      fail("--boundary rectangle: there is no vertex ", indices[k], "; the mesh has ", mesh.number_of_vertices(), " vertices");
    corners[k] = Vertex(static_cast<Mesh::size_type>(indices[k]));
    if(! is_on_border(mesh, corners[k]))
      fail("--boundary rectangle: vertex ", indices[k], " is not on the border");
  }
  return corners;
}

// All corners are on the border of the first.
void require_one_border(const std::array<Vertex, 4>& corners, const Mesh& mesh, const std::vector<Halfedge>& border)
{
  for(Vertex v : corners)
    if(std::none_of(border.begin(), border.end(), [&](Halfedge h) { return mesh.target(h) == v; }))
      fail("--boundary rectangle: vertex ", v.idx(), " is not on the same border as vertex ", corners[0].idx());
}

// Corners are chosen for disks only. Messages begin with `where`; `as_given(report)` has the numbers of elements in the file.
template <typename As_given>
std::array<Vertex, 4> chosen_corners(const std::string& where, const Mesh& mesh, Progress& progress, As_given as_given)
{
  const Halfedge bhd = first_border_halfedge(mesh);
  if(bhd == Mesh::null_halfedge())
    fail(where, "a rectangle needs a border, the mesh is closed");
  Report report;
  Progress_visitor visitor(progress);
  const std::array<Vertex, 4> corners =
    CE::select_rectangle_corners(mesh, bhd, CGAL::parameters::flattening_report(std::ref(report)).visitor(std::ref(visitor)));
  if(report.status == CE::Status::STOPPED_BY_VISITOR)
    fail(where, "interrupted");
  if(report.status == CE::Status::MISSING_CONDITION)
    fail(where, "a rectangle needs at least 4 border vertices, there are ", border_cycle(mesh, bhd).size());
  if(! report)
    fail(where, "no corners for a rectangle are found: ", CE::message(as_given(report)),
         report.status == CE::Status::WRONG_TOPOLOGY ? " (give them: --boundary rectangle=i,j,k,l)" : "");
  return corners;
}

// On the border of the corners; the others stay as they are.
void prescribe_a_rectangle(const std::array<Vertex, 4>& corners, const Mesh& mesh, Conditions& conditions)
{
  const std::vector<Halfedge> border = border_cycle(mesh, border_halfedge_to(mesh, corners[0]));
  require_one_border(corners, mesh, border);
  CE::prescribe_rectangle(mesh, corners, conditions.border_angle);
  for(Halfedge h : border)
    conditions.is_constrained[mesh.target(h)] = false;
}

// Where corners are given; or each component becomes one.
void prescribe_rectangles(const Options& options, const Mesh& mesh, const Given_surface& given, Progress& progress, Conditions& conditions)
{
  const std::string file = options.input + ": ";
  const auto as_given = [&](Report report)
  {
    name_as_given(given, report);
    return report;
  };
  if(options.corners)
    return prescribe_a_rectangle(given_corners(*options.corners, mesh), mesh, conditions);
  const Components components(mesh);
  if(components.size() == 1)
    return prescribe_a_rectangle(chosen_corners(file, mesh, progress, as_given), mesh, conditions);
  for(std::size_t c = 0; c < components.size(); ++c)
  {
    Component_mesh part;
    components.get_mesh(c, part);
    const std::string where = file + name_of_component(given, part.faces.front(), part.faces.size());
    std::array<Vertex, 4> corners = chosen_corners(where, part.mesh, progress, [&](const Report& report)
      { return as_given(failure_in_whole(part, report)); });
    for(Vertex& v : corners)
      v = part.vertices[v.idx()];
    prescribe_a_rectangle(corners, mesh, conditions);
  }
}

void set_cones(const Options& options, const Mesh& mesh, const Given_surface& given, Conditions& conditions)
{
  read_cone_file(options.cone_file, mesh, given, options.quanta_of_turn,
                 [&](Vertex v) { conditions.is_constrained[v] = true; },
                 [&](Vertex v, double angle) { conditions.cone_angle[v] = angle; });
}

// Lines "quanta vertex-index vertex-index ...": a closed curve along the edges between vertices that follow each other, and from the last to the
// first; # begins a comment.
void read_loops(const std::string& file, const Mesh& mesh, const Given_surface& given, std::vector<Prescribed_loop>& loops)
{
  const std::string content = read_file(file);
  Scanner in(content, file, '#');
  for(; ! in.at_end(); in.skip_line())
  {
    const std::int64_t most = 1000000; // right angles and the like: more make no sense
    const std::int64_t quanta = in.integer_in_line();
    if(quanta < -most || quanta > most)
      in.error("a loop cannot turn by ", quanta, " times the angle of --quantize");
    std::vector<Vertex> vertices;
    while(! in.at_end_of_line())
      vertices.push_back(read_vertex(in, given));
    if(vertices.size() < 2)
      in.error("expected the vertices of a loop after the number ", quanta);
    loops.push_back({{}, static_cast<int>(quanta)});
    for(std::size_t i = 0; i < vertices.size(); ++i)
    {
      const Vertex v = vertices[i], w = vertices[(i + 1) % vertices.size()];
      const Halfedge h = mesh.halfedge(v, w);
      if(h == Mesh::null_halfedge())
        in.error("there is no edge from vertex ", v.idx(), " to vertex ", w.idx());
      loops.back().halfedges.push_back(h);
    }
  }
}

} // namespace

void build_mesh(const Polygon_soup& soup, Mesh& mesh)
{
  mesh.reserve(static_cast<Mesh::size_type>(soup.points.size()),
               static_cast<Mesh::size_type>(soup.number_of_edges),
               static_cast<Mesh::size_type>(soup.faces.size()));
  for(const auto& p : soup.points)
    mesh.add_vertex(Kernel::Point_3(p[0], p[1], p[2]));
  std::vector<std::vector<Vertex> > faces;
  faces.reserve(soup.faces.size());
  for(const Polygon& face : soup.faces)
    faces.emplace_back(face.begin(), face.end());
  CGAL::Euler::add_faces(faces, mesh); // all at once: face by face takes quadratic time around a vertex
}

bool is_on_border(const Mesh& mesh, Vertex v)
{
  return ! mesh.is_isolated(v) && mesh.is_border(v);
}

std::vector<Halfedge> border_cycle(const Mesh& mesh, Halfedge h)
{
  std::vector<Halfedge> cycle;
  const Halfedge first = h;
  do
  {
    cycle.push_back(h);
    h = mesh.next(h);
  }
  while(h != first);
  return cycle;
}

Halfedge first_border_halfedge(const Mesh& mesh)
{
  for(Halfedge h : mesh.halfedges())
    if(mesh.is_border(h))
      return h;
  return Mesh::null_halfedge();
}

Halfedge border_halfedge_to(const Mesh& mesh, Vertex v)
{
  for(Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v)))
    if(mesh.is_border(h))
      return h;
  return Mesh::null_halfedge();
}

std::array<Vertex, 3> vertices_of_face(const Mesh& mesh, Face f)
{
  const Halfedge h = mesh.halfedge(f);
  return {{ mesh.source(h), mesh.target(h), mesh.target(mesh.next(h)) }};
}

Conditions::Conditions(Mesh& mesh)
  : border_angle(mesh.add_property_map<Vertex, double>("v:border_angle", CGAL_PI).first),
    cone_angle(mesh.add_property_map<Vertex, double>("v:cone_angle", 2 * CGAL_PI).first),
    u(mesh.add_property_map<Vertex, double>("v:prescribed_u", 0.).first),
    is_constrained(mesh.add_property_map<Vertex, bool>("v:is_constrained", false).first),
    is_diagonal(mesh.add_property_map<Mesh::Edge_index, bool>("e:is_diagonal", false).first)
{
  for(Halfedge h : mesh.halfedges())
    if(mesh.is_border(h))
      is_constrained[mesh.target(h)] = true;
}

Conditions::Conditions(const Given_surface& given, Mesh& mesh) : Conditions(mesh)
{
  for(Mesh::Edge_index e : mesh.edges())
    is_diagonal[e] = flattening::is_diagonal(given, mesh, e);
}

void set_conditions(const Options& options, const Mesh& mesh, const Given_surface& given, Progress& progress, Conditions& conditions)
{
  if(! options.cone_file.empty())
    set_cones(options, mesh, given, conditions);
  if(! options.holonomy_file.empty())
    read_loops(options.holonomy_file, mesh, given, conditions.loops);
  if(options.is_rectangle)
    prescribe_rectangles(options, mesh, given, progress, conditions);
  else
    read_border_conditions(options, mesh, given, conditions);
}

} // namespace flattening
