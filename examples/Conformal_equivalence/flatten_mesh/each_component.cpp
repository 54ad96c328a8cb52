// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/each_component.h"
#include "../include/flatten_mesh/merge_refinements.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/seamless.h"
#include "../include/flatten_mesh/solve.h"

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace flattening {

namespace {

// ---- What is asked of one component

// The number of a vertex of the component, from that in the whole.
std::optional<std::size_t> number_in_component(const Component_mesh& part, std::size_t i)
{
  const Vertex v(static_cast<Mesh::size_type>(i));
  const auto place = std::lower_bound(part.vertices.begin(), part.vertices.end(), v);
  if(place == part.vertices.end() || *place != v)
    return std::nullopt;
  return static_cast<std::size_t>(place - part.vertices.begin());
}

// Vertices of other components do not concern it.
void name_vertices_of_component(const Component_mesh& part, Options& options)
{
  for(std::optional<std::size_t>* vertex : {&options.vertex_at_infinity, &options.disk_centre})
    if(*vertex)
      *vertex = number_in_component(part, **vertex);
  if(! options.disk_points)
    return;
  if(! number_in_component(part, (*options.disk_points)[0]))
    options.disk_points.reset();
  else
    for(std::size_t& i : *options.disk_points)
      i = *number_in_component(part, i);
}

bool has_enough_vertices_for_cones(const Components& components, std::size_t number_of_cones)
{
  for(std::size_t c = 0; c < components.size(); ++c)
    if(components.number_of_inner_vertices(c) >= number_of_cones)
      return true;
  return false;
}

// On a component without inner vertices no cone can be placed, and all lengths are those of the border, which are kept.
void limit_number_of_cones(std::size_t number_of_inner_vertices, Options& options)
{
  options.number_of_cones = (std::min)(options.number_of_cones, number_of_inner_vertices);
  if(number_of_inner_vertices == 0)
    options.places_cones = false;
}

// Those that run on the component.
void get_loops(const Conditions& whole, const Component_mesh& part, Conditions& result)
{
  if(whole.loops.empty())
    return;
  std::map<Halfedge, Halfedge> halfedge_of_part;
  for(Halfedge h : part.mesh.halfedges())
    halfedge_of_part[part.halfedges[h.idx()]] = h;
  for(const Prescribed_loop& loop : whole.loops)
  {
    if(halfedge_of_part.count(loop.halfedges.front()) == 0)
      continue;
    result.loops.push_back({{}, loop.quanta});
    for(Halfedge h : loop.halfedges)
      result.loops.back().halfedges.push_back(halfedge_of_part[h]);
  }
}

void get_conditions(const Conditions& whole, const Component_mesh& part, Conditions& result)
{
  for(Vertex v : part.mesh.vertices())
  {
    const Vertex w = part.vertices[v.idx()];
    result.border_angle[v] = whole.border_angle[w];
    result.cone_angle[v] = whole.cone_angle[w];
    result.u[v] = whole.u[w];
    result.is_constrained[v] = whole.is_constrained[w];
  }
  for(Mesh::Edge_index e : part.mesh.edges())
    result.is_diagonal[e] = whole.is_diagonal[Mesh::Edge_index(part.halfedges[part.mesh.halfedge(e).idx()])];
  get_loops(whole, part, result);
}

// ---- What was found

// Cones that were placed.
void take_over_conditions(const Component_mesh& part, const Conditions& found, const Conditions& whole)
{
  for(Vertex v : part.mesh.vertices())
  {
    whole.cone_angle[part.vertices[v.idx()]] = found.cone_angle[v];
    whole.is_constrained[part.vertices[v.idx()]] = found.is_constrained[v];
    whole.u[part.vertices[v.idx()]] = found.u[v];
  }
}

void take_over_lattice_coordinates(const Component_mesh& part, const Result& found, Result& whole)
{
  if(! found.lattice_uv)
    return;
  if(! whole.lattice_uv)
    whole.lattice_uv = add_lattice_coordinates(whole.mesh);
  for(Halfedge h : part.mesh.halfedges())
    (*whole.lattice_uv)[part.halfedges[h.idx()]] = (*found.lattice_uv)[h];
}

void take_over_wide_layout(const Component_mesh& part, const Wide_layout& found, Result& whole)
{
  if(! found.is_used)
    return;
  if(! whole.wide.is_used)
    use_wide_points(whole.mesh, whole.wide);
  for(Halfedge h : part.mesh.halfedges())
    whole.wide.uv[part.halfedges[h.idx()]] = found.uv[h];
}

template <typename NT>
void take_over_image(const Component_mesh& part, const std::vector<std::array<NT, 3> >& found, const Mesh& mesh,
                     std::vector<std::array<NT, 3> >& whole)
{
  if(found.empty())
    return;
  whole.resize(mesh.number_of_vertices(), origin<NT>());
  for(Vertex v : part.mesh.vertices())
    whole[part.vertices[v.idx()].idx()] = found[v.idx()];
}

void take_over_result(const Component_mesh& part, const Result& found, Result& whole)
{
  for(Halfedge h : part.mesh.halfedges())
    whole.uv[part.halfedges[h.idx()]] = found.uv[h];
  for(Vertex v : part.mesh.vertices())
  {
    whole.u[part.vertices[v.idx()]] = found.u[v];
    whole.weight[part.vertices[v.idx()]] = found.weight[v];
  }
  take_over_lattice_coordinates(part, found, whole);
  take_over_wide_layout(part, found.wide, whole);
  take_over_image(part, found.image, whole.mesh, whole.image);
  take_over_image(part, found.wide_image, whole.mesh, whole.wide_image);
}

// ---- Reports

void take_over_statistics(const CE::Statistics& found, CE::Statistics& whole)
{
  whole += found;
  if(found.conformal_class != CE::Conformal_class::FIXED_TRIANGULATION)
    whole.conformal_class = found.conformal_class;
  whole.is_doubled = whole.is_doubled || found.is_doubled;
  whole.number_of_flips += found.number_of_flips;
  whole.number_of_resolving_flips += found.number_of_resolving_flips;
  whole.number_of_regularized_rows += found.number_of_regularized_rows;
  whole.delaunay = (std::max)(whole.delaunay, found.delaunay);
  whole.refinement_arithmetic = (std::max)(whole.refinement_arithmetic, found.refinement_arithmetic);
  whole.residual = (std::max)(whole.residual, found.residual);
  whole.residual_floor = (std::max)(whole.residual_floor, found.residual_floor);
  whole.angle_defect_spread += found.angle_defect_spread;
  whole.least_u = (std::min)(whole.least_u, found.least_u);
  whole.largest_u = (std::max)(whole.largest_u, found.largest_u);
}

double area(const Mesh& mesh)
{
  double sum = 0;
  for(Face f : mesh.faces())
  {
    const auto v = vertices_of_face(mesh, f);
    const Kernel::Vector_3 normal = CGAL::cross_product(mesh.point(v[1]) - mesh.point(v[0]), mesh.point(v[2]) - mesh.point(v[0]));
    sum += std::hypot(normal.x(), normal.y(), normal.z()) / 2;
  }
  return sum;
}

// Of means over areas, `before` that of the components before.
void take_over_tiling(const CE::Tiling& found, double area, double before, CE::Tiling& whole)
{
  if(found.symmetry == 0)
    return;
  const auto mean = [&](double& of_whole, double of_part) { of_whole = (of_whole * before + of_part * area) / (before + area); };
  whole.symmetry = found.symmetry;
  whole.number_of_tiles += found.number_of_tiles;
  whole.scale = whole.rotation = std::numeric_limits<double>::quiet_NaN(); // each has its own
  if(before + area > 0)
  {
    mean(whole.mean_distortion, found.mean_distortion);
    mean(whole.mean_factor_before, found.mean_factor_before);
    mean(whole.mean_factor, found.mean_factor);
  }
  whole.maximum_distortion = (std::max)(whole.maximum_distortion, found.maximum_distortion);
  whole.is_closest = whole.is_closest && found.is_closest;
  whole.number_of_wound_vertices += found.number_of_wound_vertices;
}

// Elements of the component become those of the whole.
class Report_merger
{
public:
  Report_merger(const Component_mesh& part, const Report& found, Report& whole) : part_(part), found_(found), whole_(whole) {}

  void take_over_outcome()
  {
    whole_.status = found_.status;
    whole_.amount = found_.amount;
    append(found_.vertices, whole_.vertices);
    append(found_.edges, whole_.edges);
    append(found_.faces, whole_.faces);
    for(std::size_t v : found_.vertex_indices)
      whole_.vertex_indices.push_back(index(v));
    for(const auto& e : found_.edge_indices)
      whole_.edge_indices.push_back({{ index(e[0]), index(e[1]) }});
    for(std::size_t f : found_.face_indices)
      whole_.face_indices.push_back(part_.faces[f].idx());
  }

  // Of a success.
  void take_over_findings()
  {
    if(found_.status != CE::Status::OK)
      whole_.status = found_.status;
    whole_.amount = (std::max)(whole_.amount, found_.amount);
    whole_.layout_length_error = (std::max)(whole_.layout_length_error, found_.layout_length_error);
    whole_.solid_angle += found_.solid_angle;
    take_over_cones();
    append(found_.flattened_cones, whole_.flattened_cones);
    append(found_.lost_border_edges, whole_.lost_border_edges);
    append(found_.bent_faces, whole_.bent_faces);
    append(found_.flat_faces, whole_.flat_faces);
    append(found_.rounded_faces, whole_.rounded_faces);
  }

private:
  void take_over_cones()
  {
    for(auto cone : found_.cones)
    {
      cone.vertex = of_whole(cone.vertex);
      cone.vertex_index = cone.vertex.idx();
      whole_.cones.push_back(cone);
    }
    for(auto transition : found_.transitions)
    {
      transition.halfedge = part_.halfedges[transition.halfedge.idx()];
      whole_.transitions.push_back(transition);
    }
    for(auto lattice : found_.lattices)
    {
      lattice.face = part_.faces[lattice.face].idx();
      whole_.lattices.push_back(lattice);
    }
  }

  Vertex of_whole(Vertex v) const { return part_.vertices[v.idx()]; }
  Face of_whole(Face f) const { return part_.faces[f.idx()]; }
  Mesh::Edge_index of_whole(Mesh::Edge_index e) const { return Mesh::Edge_index(part_.halfedges[part_.mesh.halfedge(e).idx()]); }
  std::size_t index(std::size_t v) const { return part_.vertices[v].idx(); }

  template <typename Element>
  void append(const std::vector<Element>& found, std::vector<Element>& whole) const
  {
    for(Element e : found)
      whole.push_back(of_whole(e));
  }

  const Component_mesh& part_;
  const Report& found_;
  Report& whole_;
};

void describe_component(const CE::Surface_components::Component& given, const Report& found, Results& results)
{
  results.components.emplace_back();
  Mapped_component& component = results.components.back();
  component.first_face = Face(given.first_face);
  component.number_of_faces = given.number_of_faces;
  component.status = found.status;
  component.statistics = found.statistics;
  component.statistics.residuals = {};
  component.tiling = found.tiling;
}

} // namespace

Report failure_in_whole(const Component_mesh& part, const Report& found)
{
  Report result;
  Report_merger(part, found, result).take_over_outcome();
  result.topology = found.topology;
  result.statistics = found.statistics;
  return result;
}

Report map_each_component(const Components& components, const Options& options, const Conditions& conditions, Results& results,
                          Progress& progress, const Door& door)
{
  const bool limits_cones = options.places_cones && has_enough_vertices_for_cones(components, options.number_of_cones);
  Report report;
  report.statistics.least_u = std::numeric_limits<double>::infinity();
  report.statistics.largest_u = -report.statistics.least_u;
  double area_before = 0;
  Refinement_merger refinements(results);
  for(std::size_t c = 0; c < components.size(); ++c)
  {
    progress.begin("mapping components");
    progress.show(text(": ", c + 1, " of ", components.size()), double(c) / double(components.size()));
    Component_mesh part;
    components.get_mesh(c, part);
    Options its_options = options;
    name_vertices_of_component(part, its_options);
    if(limits_cones)
      limit_number_of_cones(components.number_of_inner_vertices(c), its_options);
    Conditions its_conditions(part.mesh);
    get_conditions(conditions, part, its_conditions);
    Results found(part.mesh);
    const Report its_report = door(its_options, its_conditions, found, progress);
    describe_component(components[c], its_report, results);
    if(! its_report)
      return failure_in_whole(part, its_report);

    take_over_conditions(part, its_conditions, conditions);
    take_over_result(part, found.given, results.given);
    refinements.append(part, found, is_refinement_needed(options, its_report, found.refinement));
    results.placing_seconds += found.placing_seconds;
    take_over_statistics(its_report.statistics, report.statistics);
    const double its_area = area(part.mesh);
    take_over_tiling(its_report.tiling, its_area, area_before, report.tiling);
    area_before += its_area;
    Report_merger(part, its_report, report).take_over_findings();
  }
  refinements.finish();
  report.topology = components.topology();
  return report;
}

} // namespace flattening
