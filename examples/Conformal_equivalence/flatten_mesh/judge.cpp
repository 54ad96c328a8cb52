// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/figures.h"
#include "../include/flatten_mesh/Components.h"
#include "../include/flatten_mesh/layout_seams.h"
#include "../include/flatten_mesh/Stopwatch.h"

#include <CGAL/Conformal_equivalence/conformal_distortion.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Texture_lattice.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <unordered_map>
#include <vector>

namespace flattening {

namespace {

// The motion back.
void invert(Seam_path& path, int symmetry)
{
  path.quanta = (symmetry - path.quanta) % symmetry;
  const std::array<std::int64_t, 2> p = CE::internal::Texture_lattice(symmetry).rotated(path.quanta, path.translation);
  path.translation = {{ -p[0], -p[1] }};
}

// The vertices of the mesh given on a path of a mesh that begins with them. Between two of them lie parts of one edge, as seams run along edges, and
// paths end at cones, borders and where seams meet.
std::vector<Vertex> given_vertices(const Mesh& given, const Mesh& mesh, const std::vector<Halfedge>& path)
{
  std::vector<Vertex> result;
  const auto add = [&](Vertex v)
  {
    if(v.idx() < given.number_of_vertices())
      result.push_back(v);
  };
  add(mesh.source(path.front()));
  for(Halfedge h : path)
    add(mesh.target(h));
  return result;
}

// Every triangle of chords, laid out in the plane by itself.
void lay_out_chords(Result& result)
{
  const auto point = [&](Vertex v)
  {
    const Space_point& p = result.image[v.idx()];
    return Kernel::Point_3(p[0], p[1], p[2]);
  };
  for(Face f : result.mesh.faces())
  {
    const Halfedge h = result.mesh.halfedge(f), n = result.mesh.next(h), p = result.mesh.next(n);
    const Kernel::Point_3 a = point(result.mesh.target(h));
    const Kernel::Vector_3 x = point(result.mesh.target(n)) - a, y = point(result.mesh.target(p)) - a;
    const double length = std::hypot(x.x(), x.y(), x.z());
    const Kernel::Vector_3 normal = CGAL::cross_product(x, y);
    result.uv[h] = Kernel::Point_2(0, 0);
    result.uv[n] = Kernel::Point_2(length, 0);
    result.uv[p] = length > 0 ? Kernel::Point_2(x * y / length, std::hypot(normal.x(), normal.y(), normal.z()) / length)
                              : Kernel::Point_2(0, 0);
  }
}

// What is wrong only because of rounding.
void forget_rounded_triangles(Figures& figures)
{
  CE::Layout_verdict<Mesh>& verdict = figures.verdict;
  figures.number_of_rounded_triangles = verdict.number_of_flipped_triangles + verdict.number_of_degenerate_triangles;
  verdict.number_of_flipped_triangles = verdict.number_of_degenerate_triangles = 0;
  verdict.flipped_faces.clear();
  verdict.degenerate_faces.clear();
  if(figures.number_of_rounded_triangles != 0)
    verdict.injectivity = CE::Injectivity::UNDECIDED;
}

// On the sphere and on the disk all triangles were positive before they were rounded: the verdict is that of the points that are written.
void take_over_verdict(Target target, const Result& drawn, Figures& figures)
{
  const Image_figures& image = figures.image;
  CE::Layout_verdict<Mesh>& verdict = figures.verdict;
  const bool is_wide = ! drawn.wide_image.empty(), is_sphere = target == Target::SPHERE;
  const std::size_t number_of_components = figures.report.topology.number_of_components;
  verdict.flipped_faces.clear();
  verdict.degenerate_faces.clear();
  verdict.number_of_flipped_triangles = image.lost_faces.size() - image.number_of_flat_faces;
  verdict.number_of_degenerate_triangles = image.number_of_flat_faces;
  if(! image.lost_faces.empty())
    verdict.injectivity = CE::Injectivity::NO;
  else if(is_sphere ? std::abs(image.solid_angle / (4 * CGAL_PI) - double(number_of_components)) < 1e-7 : is_wide)
    verdict.injectivity = CE::Injectivity::YES;
  if(is_wide)
    figures.number_of_rounded_triangles = lost_faces(drawn.mesh, drawn.image, is_sphere).size();
  figures.report.layout_length_error = image.length_error;
}

} // namespace

std::vector<Seam_path> seam_paths(const Mesh& given, const Result& drawn, const Report& report)
{
  std::unordered_map<std::size_t, const CE::Seam_transition<Mesh>*> transition_at;
  for(const auto& transition : report.transitions)
    transition_at.emplace(given.edge(transition.halfedge).idx(), &transition);

  const Layout_seams<Mesh, UV_map> seams(drawn.mesh, drawn.uv, true);
  std::vector<Seam_path> paths;
  for(const std::vector<Halfedge>& path : seams.paths())
  {
    const std::vector<Vertex> vertices = given_vertices(given, drawn.mesh, path);
    const Halfedge first = vertices.size() < 2 ? Mesh::null_halfedge() : given.halfedge(vertices[0], vertices[1]);
    if(first == Mesh::null_halfedge())
      continue;
    const auto found = transition_at.find(given.edge(first).idx());
    if(found == transition_at.end())
      continue;
    const CE::Seam_transition<Mesh>& transition = *found->second;
    Seam_path result;
    result.from = vertices.front();
    result.to = vertices.back();
    result.number_of_edges = vertices.size() - 1;
    result.quanta = transition.quanta;
    result.translation = transition.lattice_translation;
    if(transition.halfedge != first)
      invert(result, report.tiling.symmetry);
    paths.push_back(result);
  }
  return paths;
}

void find_range_of_u(const Result& result, Figures& figures)
{
  const Mesh& mesh = result.mesh;
  const Given_surface& given = *figures.given;
  figures.u_min = std::numeric_limits<double>::infinity();
  figures.u_max = -figures.u_min;
  for(Vertex v : mesh.vertices())
    if(mesh.is_isolated(v))
      figures.number_of_isolated_vertices += given.representative_of(v.idx()) == v.idx(); // what was merged belongs to the surface
    else
    {
      figures.u_min = (std::min)(figures.u_min, result.u[v]);
      figures.u_max = (std::max)(figures.u_max, result.u[v]);
    }
}

void describe_components(const Result& given, Figures& figures)
{
  if(figures.report.topology.number_of_components < 2)
    return;
  const Components components(given.mesh);
  for(std::size_t c = 0; c < components.size(); ++c)
  {
    figures.component_figures.emplace_back();
    figures.component_figures.back().first_face = Face(components[c].first_face);
    figures.component_figures.back().topology = CE::surface_topology(components[c]);
  }
  for(Vertex v : given.mesh.vertices())
    if(! given.mesh.is_isolated(v))
    {
      Component_figures& its_figures = figures.component_figures[components.of_vertex(v)];
      its_figures.u_min = (std::min)(its_figures.u_min, given.u[v]);
      its_figures.u_max = (std::max)(its_figures.u_max, given.u[v]);
    }
  for(const auto& cone : figures.report.cones)
    ++figures.component_figures[components.of_vertex(cone.vertex)].number_of_cones;
}

void describe_made_mesh(const Results& results, bool is_refined, Figures& figures)
{
  figures.is_refined = is_refined;
  figures.number_of_crossings = is_refined ? results.made.mesh.number_of_vertices() - results.given.mesh.number_of_vertices() : 0;
  figures.repair = results.repair;
  figures.components = results.components;
  figures.placing_seconds = results.placing_seconds;
  figures.is_search_stopped = results.is_search_stopped;
  figures.number_of_made_vertices = results.made.mesh.number_of_vertices();
  figures.number_of_made_faces = results.made.mesh.number_of_faces();
}

void judge(const Options& options, const Result& given, Result& drawn, Figures& figures)
{
  const Stopwatch watch;
  if(options.target == Target::SPHERE)
    lay_out_chords(drawn);
  else
    figures.verdict = CE::verify_layout(drawn.mesh, drawn.lattice_uv ? *drawn.lattice_uv : drawn.uv);
  figures.distortion = CE::compute_conformal_distortion(drawn.mesh, drawn.uv);
  if(options.target != Target::PLANE)
  {
    figures.image = judge_image(options, figures.report, figures.components, given, drawn);
    take_over_verdict(options.target, drawn, figures);
  }
  else if(options.seamless)
    figures.seams = seam_paths(given.mesh, drawn, figures.report);
  else if(drawn.wide.is_used) // the triangles were found to be positive before they were rounded
    forget_rounded_triangles(figures);
  find_errors_of_straight_edges(options, given, &given == &drawn, figures);
  figures.verifying_seconds = watch.seconds();
}

} // namespace flattening
