// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/write_outputs.h"
#include "../include/flatten_mesh/color_scale.h"
#include "../include/flatten_mesh/Components.h"
#include "../include/flatten_mesh/layout_files.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/side_by_side.h"
#include "../include/flatten_mesh/Split_surface.h"
#include "../include/flatten_mesh/Stopwatch.h"
#include "../include/flatten_mesh/write_HTML.h"
#include "../include/flatten_mesh/write_material.h"
#include "../include/flatten_mesh/write_SVG.h"
#include "../include/flatten_mesh/Written_faces.h"

#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>
#include <CGAL/Conformal_equivalence/conformal_distortion.h>
#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/boost/graph/properties.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <string>
#include <system_error>
#include <vector>

namespace flattening {

namespace {

std::string name_without_folder(const std::string& file)
{
  return std::filesystem::path(file).filename().string();
}

// A vertex with this point, with as many digits as it takes to read it back; `i` is its number in the file read.
template <typename Point>
void write_vertex(Text_buffer& buffer, const Point& point, const OBJ_attribute_writer& attributes, std::size_t i)
{
  buffer << 'v';
  for(const auto& x : point)
    CE::internal::write_obj_number(buffer << ' ', x);
  attributes.write_after_point(buffer, i);
  buffer << '\n';
}

// The faces with the images of their vertices.
template <typename Point>
bool write_sphere_OBJ(std::ostream& out, const Given_surface& given, const Result& result, const OBJ_attributes& attributes,
                      const std::vector<Point>& points)
{
  const Written_faces faces(given, result);
  OBJ_attribute_writer attribute_writer(attributes, false, faces.are_of_file(), CE::IO::OBJ_material());
  {
    Text_buffer buffer(out);
    attribute_writer.write_libraries(buffer);
    for(std::size_t v = 0; v < points.size(); ++v)
    {
      const bool is_of_file = faces.are_of_file() && v < given.number_of_vertices;
      write_vertex(buffer, placed_point(result, points, is_of_file ? given.representative_of(v) : v), attribute_writer,
                   is_of_file || ! faces.are_of_file() ? v : given.vertex(Vertex(static_cast<Mesh::size_type>(v))));
    }
    write_face_lines(buffer, faces, attribute_writer, true, [](Text_buffer&, Halfedge) {});
  }
  out.flush();
  return out.good();
}

// The faces, with the layout `uv` of the mesh as texture coordinates: each corner of a face has one.
template <typename Uv, typename Weights>
bool write_layout_OBJ(std::ostream& out, const Given_surface& given, const Result& result, const OBJ_attributes& attributes,
                      const Uv& uv, const Weights& weights, const CE::IO::OBJ_material& material)
{
  const Mesh& mesh = result.mesh;
  const Written_faces faces(given, result);
  OBJ_attribute_writer attribute_writer(attributes, faces.are_of_file(), faces.are_of_file(), material);
  const auto number = get(CGAL::dynamic_halfedge_property_t<std::size_t>(), mesh);
  {
    Text_buffer buffer(out);
    attribute_writer.write_libraries(buffer);
    if(faces.are_of_file() && ! given.is_mesh())
      for(std::size_t i = 0; i < given.soup.points.size(); ++i)
        write_vertex(buffer, given.soup.points[i], attribute_writer, i);
    else
      for(Vertex v : mesh.vertices())
        write_vertex(buffer, std::array<double, 3>{{ mesh.point(v).x(), mesh.point(v).y(), mesh.point(v).z() }}, attribute_writer, v.idx());
    CE::internal::write_obj_texture_coordinates(buffer, mesh, uv, weights, number);
    attribute_writer.write_normals(buffer);
    write_face_lines(buffer, faces, attribute_writer, false, [&](Text_buffer& b, Halfedge h) { b << '/' << get(number, h) + 1; });
  }
  out.flush();
  return out.good();
}

const double distance_of_hemispheres = 2.2;

// Both sides of the sphere, side by side: as seen from the z-axis, and from its other end.
UV_map hemispheres(Result& result)
{
  UV_map uv = result.mesh.add_property_map<Halfedge, Kernel::Point_2>("h:hemispheres").first;
  for(Face f : result.mesh.faces())
  {
    const auto v = vertices_of_face(result.mesh, f);
    const auto plane = [&](Vertex w) { return std::array<double, 2>{{ result.image[w.idx()][0], result.image[w.idx()][1] }}; };
    const bool is_front = CE::internal::is_left_turn(plane(v[0]), plane(v[1]), plane(v[2]));
    for(Halfedge h : result.mesh.halfedges_around_face(result.mesh.halfedge(f)))
    {
      const std::array<double, 2> p = plane(result.mesh.target(h));
      const std::array<double, 2> c = result.centres.empty() ? std::array<double, 2>{{ 0, 0 }} : result.centres[result.mesh.target(h).idx()];
      uv[h] = Kernel::Point_2(2 * c[0] + (is_front ? p[0] : distance_of_hemispheres - p[0]), c[1] + p[1]);
    }
  }
  return uv;
}

// By component.
std::vector<std::array<double, 2> > centres(const Figures& figures)
{
  std::vector<std::array<double, 2> > result;
  for(const Mapped_component& component : figures.components)
    result.push_back(component.centre);
  if(result.empty())
    result.push_back({{0, 0}});
  return result;
}

// For a layout that has nothing to do with that of the surface.
SVG_options hemisphere_options(SVG_options options, const Figures& figures)
{
  options.checkerboard = options.seams = options.cones = false;
  for(const std::array<double, 2>& c : centres(figures))
    for(const bool is_back : {false, true})
    {
      const double x = 2 * c[0] + (is_back ? distance_of_hemispheres : 0);
      options.circles.push_back({{ x, c[1], 1 }});
      options.hemispheres.push_back({ {{ x, c[1] }}, is_back });
    }
  return options;
}

// What gives a triangle its colour in the drawing.
Face_map<double> face_colors(const Options& options, const Result& result, Figures& figures)
{
  Mesh& mesh = result.mesh;
  Face_map<double> value = mesh.add_property_map<Face, double>("f:color", 0.).first;
  for(Face f : mesh.faces())
  {
    const Halfedge h = mesh.halfedge(f);
    value[f] = options.color_by_quasi_conformal_factor
      ? CE::quasi_conformal_factor(mesh, result.uv, f)
      : (result.u[mesh.target(h)] + result.u[mesh.source(h)] + result.u[mesh.target(mesh.next(h))]) / 3;
  }
  std::vector<double> values;
  for(Face f : mesh.faces())
    values.push_back(value[f]);
  figures.color_range = Robust_range(values);
  return value;
}

SVG_options drawing_options(const Options& options, const Figures& figures)
{
  SVG_options drawing;
  if(options.seamless)
  {
    drawing.tiles = figures.report.tiling.symmetry;
    drawing.checkerboard = false;
  }
  drawing.legend = options.color_by_quasi_conformal_factor ? "quasi-conformal factor" : "u";
  if(options.target == Target::SPHERE)
    drawing = hemisphere_options(drawing, figures);
  else if(options.target == Target::DISK)
    for(const std::array<double, 2>& c : centres(figures))
      drawing.circles.push_back({{ c[0], c[1], 1 }});
  return drawing;
}

// Faces are called as in the file; vertices, too, unless another mesh was made.
HTML_options page_options(const Options& options, const Mesh& mesh, const Result& result, const Figures& figures, const SVG_options& drawing)
{
  HTML_options page;
  page.title = name_without_folder(options.input);
  page.figures = summary(options, mesh, figures);
  page.symmetry = options.seamless ? figures.report.tiling.symmetry : 0;
  page.mode = options.color_by_quasi_conformal_factor ? "quasi-conformal" : "pattern";
  page.hidden_edges = drawing.hidden_edges;
  if(options.target == Target::SPHERE)
  {
    for(Vertex v : result.mesh.vertices())
      page.points_of_spheres.push_back(placed_point(result, result.image, v.idx()));
    page.distance_of_spheres = distance_of_centres;
  }
  else
    page.circles = drawing.circles;
  const bool is_made = &result.mesh != &mesh;
  if(is_made || ! figures.given->is_mesh())
    for(Face f : result.mesh.faces())
      page.face_numbers.push_back(static_cast<std::uint32_t>(
        figures.given->face(is_made ? Face(static_cast<Mesh::size_type>(result.given_face[f.idx()])) : f)));
  if(! is_made && ! figures.given->is_mesh())
    for(Vertex v : mesh.vertices())
      page.vertex_numbers.push_back(static_cast<std::uint32_t>(figures.given->vertex(v)));
  return page;
}

// The picture in a unit square of the layout. As it repeats from one to the next, squares of a checkerboard are at most half a unit wide; and
// those of very small layouts are not as small as they could be, since the picture would be too large. Hexagons fit into the coordinates of their
// lattice.
Palette_image texture_of_OBJ(const Options& options, const Result& result)
{
  const double most_repetitions = 100;
  const Pattern pattern = texture_pattern(options);
  if(pattern == Pattern::HEXAGON_TILES && ! result.lattice_uv)
    return texture_image(Pattern::CHECKERBOARD);
  const double repetitions = (std::min)((std::max)(std::floor(texture_repetitions(result)), 1.), most_repetitions);
  return texture_image(pattern, static_cast<std::uint32_t>(repetitions));
}

// The number of the component of each face of the file; faces that are in none, as they were dropped, follow the one before.
std::vector<std::size_t> components_of_faces(const Given_surface& given, const Mesh& mesh)
{
  const Components components(mesh);
  std::vector<std::size_t> result(given.number_of_faces, Components::none);
  for(Face f : mesh.faces())
    result[given.face(f)] = components.of_face(f);
  std::size_t last = 0;
  for(std::size_t& c : result)
    last = c = c == Components::none ? last : c;
  return result;
}

// Writes the faces of the file, unless another mesh was made.
void write_obj(const Options& options, const Given_surface& given, const Mesh& mesh, const Result& result, const Figures& figures,
               const Material_files& beside, Output_files& files)
{
  OBJ_attributes attributes = seen_from(options.obj, options.input, given.attributes);
  if(options.target == Target::SPHERE && ! figures.components.empty())
    name_components(components_of_faces(given, mesh), attributes);
  CE::IO::OBJ_material material;
  material.file = name_without_folder(beside.material);
  files.write(options.obj, [&](std::ostream& out)
  {
    if(options.target == Target::SPHERE)
      return result.wide_image.empty() ? write_sphere_OBJ(out, given, result, attributes, result.image)
                                       : write_sphere_OBJ(out, given, result, attributes, result.wide_image);
    const auto write = [&](const auto& uv)
    {
      return options.projective ? write_layout_OBJ(out, given, result, attributes, uv, result.weight, material)
                                : write_layout_OBJ(out, given, result, attributes, uv, CGAL::internal_np::Param_not_found(), material);
    };
    return result.wide.is_used ? write(result.wide.uv) : write(result.lattice_uv ? *result.lattice_uv : result.uv);
  });
  if(beside.material.empty())
    return;
  files.write(beside.material, [&](std::ostream& out) { return write_MTL(out, material.name, name_without_folder(beside.texture)); });
  files.write(beside.texture, [&](std::ostream& out) { return write_PNG(out, texture_of_OBJ(options, result)); });
}

// A material file is overwritten only if this program has written it.
bool may_be_overwritten(const std::string& material)
{
  std::error_code ignored;
  if(! std::filesystem::exists(material, ignored))
    return true;
  const std::string beginning = material_beginning(CE::IO::OBJ_material().name);
  std::ifstream in(material, std::ios::binary);
  std::string found(beginning.size(), '\0');
  in.read(&found[0], static_cast<std::streamsize>(found.size()));
  return in.good() && found == beginning;
}

} // namespace

Material_files::Material_files(const std::string& obj)
{
  const std::filesystem::path path(obj);
  std::error_code ignored;
  if(path.extension().empty() || (std::filesystem::exists(path, ignored) && ! std::filesystem::is_regular_file(path, ignored)))
    return; // a device, for example
  const auto beside = [&](const char* extension) { return std::filesystem::path(path).replace_extension(extension).string(); };
  material = beside(".mtl");
  if(! may_be_overwritten(material))
  {
    foreign_material = material;
    material = beside(".layout.mtl");
    if(! may_be_overwritten(material))
      fail("the material files ", foreign_material, " and ", material, " are there, and were not written by this program; neither is overwritten "
           "(give -o another name, or remove one)");
  }
  texture = beside(".checker.png");
}

Material_files material_files(const Options& options)
{
  return Material_files(options.target == Target::SPHERE || options.target == Target::HYPERBOLIC ? "" : options.obj);
}

bool is_output_in_stream(const Options& options)
{
  const std::vector<std::string> files = outputs(options);
  return std::any_of(files.begin(), files.end(), is_standard_stream);
}

void announce_outputs(const Options& options, const Material_files& beside, Output_files& files)
{
  std::vector<std::string> written = outputs(options);
  if(! options.obj.empty())
    written.insert(written.begin() + 1, {beside.material, beside.texture});
  for(const std::string& file : written)
    for(const std::string& input : {options.input, options.cone_file, options.holonomy_file, options.angle_file, options.scale_file})
    {
      std::error_code ignored;
      if(! file.empty() && ! input.empty() && std::filesystem::equivalent(file, input, ignored))
        throw Usage_error("the output " + file + " would overwrite the input");
    }
  for(const std::string& file : written)
    if(! file.empty())
      files.announce(file);
}

void withdraw_material(Material_files& beside, Output_files& files)
{
  files.withdraw(beside.material);
  files.withdraw(beside.texture);
  beside = Material_files("");
}

void write_outputs(const Options& options, const Mesh& mesh, Result& result, const Material_files& beside,
                          Figures& figures, Output_files& files)
{
  const Stopwatch watch;
  const bool has_faces_of_file = &result.mesh == &mesh && ! figures.given->is_mesh();
  if(! options.obj.empty())
    write_obj(options, *figures.given, mesh, result, figures, beside, files);
  write_layout_files(options, *figures.given, result, files);
  if(! options.svg.empty() || ! options.html.empty())
  {
    const Face_map<double> colors = face_colors(options, result, figures);
    SVG_options drawing = drawing_options(options, figures);
    if(has_faces_of_file)
      for(Mesh::Edge_index e : mesh.edges())
        drawing.hidden_edges.push_back(is_diagonal(*figures.given, mesh, e));
    const UV_map layout = options.target == Target::SPHERE ? hemispheres(result) : result.uv;
    drawing.millimetres = options.true_scale;
    if(! options.svg.empty())
      files.write(options.svg, [&](std::ostream& out) { return write_SVG(out, result.mesh, layout, colors, drawing); });
    if(! options.html.empty())
      files.write(options.html, [&](std::ostream& out)
      {
        return write_HTML(out, result.mesh, result.uv, result.u, page_options(options, mesh, result, figures, drawing),
                          CGAL::parameters::projective_weight_map(result.weight));
      });
  }
  figures.writing_seconds = watch.seconds();
#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_JSON
  if(! options.report.empty())
    files.write(options.report, [&](std::ostream& out) { return (out << json_report(options, mesh, figures)).good(); });
#endif
  files.commit();
}

} // namespace flattening
