// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Draws the pictures of the manual and of README.md from meshes that it generates, and prints
// the figures that the manual quotes beside them:
//
//   g++ -O2 -DNDEBUG -frounding-math -std=c++17 -Iinclude -I/usr/include/eigen3
//       doc/figures/make_figures.cpp -o make_figures -lgmp -lmpfr -lz
//   ./make_figures doc/Conformal_equivalence/fig horned_cap.off
//   flatten_mesh horned_cap.off --svg doc/Conformal_equivalence/fig/flatten_mesh.svg

#include "../../examples/Conformal_equivalence/include/flatten_mesh/PNG.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <CGAL/Conformal_equivalence/boundary_conditions.h>
#include <CGAL/Conformal_equivalence/compute_seamless_parameterization.h>
#include <CGAL/Conformal_equivalence/conformal_distortion.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/verify_layout.h>
#include <CGAL/Surface_mesh_parameterization/ARAP_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/LSCM_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

typedef CGAL::Simple_cartesian<double>                  Kernel;
typedef Kernel::Point_2                                 Point_2;
typedef Kernel::Point_3                                 Point_3;
typedef Kernel::Vector_3                                Vector_3;
typedef CGAL::Surface_mesh<Point_3>                     Mesh;
typedef Mesh::Vertex_index                              Vertex;
typedef Mesh::Halfedge_index                            Halfedge;
typedef Mesh::Face_index                                Face;
typedef Mesh::Property_map<Halfedge, Point_2>           UV_map;
typedef std::array<double, 3>                           Color;

namespace CE = CGAL::Conformal_equivalence;
namespace SMP = CGAL::Surface_mesh_parameterization;
namespace PMP = CGAL::Polygon_mesh_processing;
namespace params = CGAL::parameters;

// ------------------------------------------------------------- the meshes ----

// The cap of the unit sphere up to the polar angle `opening`, with three horns.
Point_3 on_cap(double polar, double azimuth, double height)
{
  const Vector_3 d(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
  double radius = 1;
  for(int k = 0; k < 3; ++k)
  {
    const double a = 0.4 + 2 * CGAL_PI * k / 3, p = 1.05;
    const Vector_3 horn(std::sin(p) * std::cos(a), std::sin(p) * std::sin(a), std::cos(p));
    radius += height * std::exp(-(d - horn).squared_length() / 0.12);
  }
  return CGAL::ORIGIN + radius * d;
}

// `rings` rings around a pole, the k-th of 6k vertices.
Mesh horned_cap(int rings, double opening, double height)
{
  Mesh mesh;
  std::vector<std::vector<Vertex> > ring(1, {mesh.add_vertex(on_cap(0, 0, height))});
  for(int k = 1; k <= rings; ++k)
  {
    ring.emplace_back();
    for(int i = 0; i < 6 * k; ++i)
      ring[k].push_back(mesh.add_vertex(on_cap(opening * k / rings, CGAL_PI * i / (3. * k), height)));
  }
  for(int k = 1; k <= rings; ++k)
    for(int side = 0; side < 6; ++side)
      for(int i = 0; i < k; ++i)
      {
        const auto outer = [&](int j) { return ring[k][(side * k + j) % (6 * k)]; };
        const auto inner = [&](int j) { return ring[k - 1][k == 1 ? 0 : (side * (k - 1) + j) % (6 * (k - 1))]; };
        CGAL::Euler::add_face(std::array<Vertex, 3>{outer(i), outer(i + 1), inner(i)}, mesh);
        if(i + 1 < k)
          CGAL::Euler::add_face(std::array<Vertex, 3>{inner(i), outer(i + 1), inner(i + 1)}, mesh);
      }
  return mesh;
}

// --------------------------------------------------------------- the canvas ----

class Canvas
{
public:
  Canvas(int width, int height)
    : width_(width), height_(height), color_(samples * samples * width * height, Color{1, 1, 1}),
      depth_(color_.size(), -std::numeric_limits<double>::infinity())
  {}

  // Fills the triangle of the points (x, y, depth); `shade` gives the colour at barycentric coordinates.
  template <typename Shade>
  void triangle(std::array<Point_3, 3> p, Shade shade)
  {
    for(Point_3& q : p)
      q = Point_3(q.x() * samples, q.y() * samples, q.z());
    const double area = cross(p[0], p[1], p[2].x(), p[2].y());
    if(area == 0)
      return;
    const auto x = std::minmax({p[0].x(), p[1].x(), p[2].x()}), y = std::minmax({p[0].y(), p[1].y(), p[2].y()});
    for(int j = (std::max)(0, int(y.first)); j <= (std::min)(samples * height_ - 1, int(y.second)); ++j)
      for(int i = (std::max)(0, int(x.first)); i <= (std::min)(samples * width_ - 1, int(x.second)); ++i)
      {
        const double px = i + 0.5, py = j + 0.5;
        const std::array<double, 3> b = {cross(p[1], p[2], px, py) / area, cross(p[2], p[0], px, py) / area,
                                         cross(p[0], p[1], px, py) / area};
        if(b[0] < 0 || b[1] < 0 || b[2] < 0)
          continue;
        const double z = b[0] * p[0].z() + b[1] * p[1].z() + b[2] * p[2].z();
        const std::size_t at = std::size_t(j) * samples * width_ + i;
        if(z < depth_[at])
          continue;
        depth_[at] = z;
        color_[at] = shade(b);
      }
  }

  // As PNG, with 32 levels of each colour.
  void write(const std::string& file) const
  {
    std::string pixels;
    for(int j = 0; j < height_; ++j)
    {
      pixels += '\1'; // each line: differences of neighbors
      std::array<unsigned char, 3> left = {0, 0, 0};
      for(int i = 0; i < width_; ++i)
        for(int c = 0; c < 3; ++c)
        {
          double sum = 0;
          for(int k = 0; k < samples * samples; ++k)
            sum += color_[std::size_t(j * samples + k / samples) * samples * width_ + i * samples + k % samples][c];
          const unsigned char value = static_cast<unsigned char>(
            255 * std::lround(31 * (std::min)(1., sum / (samples * samples))) / 31);
          pixels += static_cast<char>(value - left[c]);
          left[c] = value;
        }
    }
    uLongf size = compressBound(pixels.size());
    std::string data(size, 0);
    compress2(reinterpret_cast<Bytef*>(&data[0]), &size, reinterpret_cast<const Bytef*>(pixels.data()), pixels.size(), 9);
    data.resize(size);

    std::string header;
    flattening::append_big_endian(header, std::uint32_t(width_));
    flattening::append_big_endian(header, std::uint32_t(height_));
    header += std::string("\x08\x02\0\0\0", 5);
    std::string png = "\x89PNG\r\n\x1a\n";
    flattening::append_png_chunk(png, "IHDR", header);
    flattening::append_png_chunk(png, "IDAT", data);
    flattening::append_png_chunk(png, "IEND", "");
    std::ofstream(file, std::ios::binary) << png;
  }

private:
  static constexpr int samples = 3;

  static double cross(const Point_3& p, const Point_3& q, double x, double y)
  {
    return (q.x() - p.x()) * (y - p.y()) - (q.y() - p.y()) * (x - p.x());
  }

  int width_, height_;
  std::vector<Color> color_;
  std::vector<double> depth_;
};

struct Box { double left, top, width, height; };

Color mix(const Color& a, const Color& b, double t)
{
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

// From white over orange to dark red.
Color heat(double t)
{
  t = (std::min)(1., (std::max)(0., t));
  const Color white = {1, 0.98, 0.9}, orange = {0.95, 0.6, 0.25}, red = {0.55, 0.05, 0.1};
  return t < 0.5 ? mix(white, orange, 2 * t) : mix(orange, red, 2 * t - 1);
}

bool is_dark_square(double x, double y, double square)
{
  return (static_cast<long>(std::floor(x / square)) + static_cast<long>(std::floor(y / square))) % 2 != 0;
}

// ----------------------------------------------------------- the drawings ----

std::array<Halfedge, 3> corners(const Mesh& mesh, Face f)
{
  const Halfedge h = mesh.halfedge(f);
  return {h, mesh.next(h), mesh.next(mesh.next(h))};
}

// The surface from above; `color(h, b)` gives the colour at the barycentric coordinates `b` of the
// triangle with the corners `h`.
template <typename CornerColor>
void draw_surface(Canvas& canvas, const Box& box, Mesh& mesh, CornerColor color, double line_width = 0)
{
  const double tilt = 0.95;
  const auto view = [&](const Vector_3& p)
  {
    return Vector_3(p.x(), std::cos(tilt) * p.y() - std::sin(tilt) * -p.z(), std::cos(tilt) * p.z() - std::sin(tilt) * p.y());
  };
  auto normal = mesh.add_property_map<Vertex, Vector_3>("v:normal").first;
  PMP::compute_vertex_normals(mesh, normal);
  CGAL::Bbox_3 bounds;
  for(Vertex v : mesh.vertices())
    bounds += (CGAL::ORIGIN + view(mesh.point(v) - CGAL::ORIGIN)).bbox();
  const double scale = (std::min)(box.width / (bounds.xmax() - bounds.xmin()), box.height / (bounds.ymax() - bounds.ymin()));

  for(Face f : mesh.faces())
  {
    const auto h = corners(mesh, f);
    std::array<Point_3, 3> p;
    std::array<Vector_3, 3> n;
    for(int k = 0; k < 3; ++k)
    {
      const Vector_3 q = view(mesh.point(mesh.target(h[k])) - CGAL::ORIGIN);
      p[k] = Point_3(box.left + box.width / 2 + scale * (q.x() - (bounds.xmin() + bounds.xmax()) / 2),
                     box.top + box.height / 2 - scale * (q.y() - (bounds.ymin() + bounds.ymax()) / 2), q.z());
      n[k] = view(normal[mesh.target(h[k])]);
    }
    canvas.triangle(p, [&](const std::array<double, 3>& b)
    {
      Vector_3 m(0, 0, 0);
      for(int k = 0; k < 3; ++k)
        m = m + b[k] * n[k];
      const Vector_3 light(-0.35, 0.45, 0.82);
      const double brightness = 0.35 + 0.65 * std::abs(m * light) / std::sqrt(m.squared_length());
      Color c = color(h, b);
      if((std::min)({b[0], b[1], b[2]}) < line_width)
        c = mix(c, {0.75, 0.3, 0.2}, 0.8);
      return mix({0, 0, 0}, c, brightness);
    });
  }
  mesh.remove_property_map(normal);
}

// A checkerboard carried over from the layout: linearly, or projectively where weights are given.
struct Checkerboard
{
  const UV_map& uv;
  double square;
  const Mesh* mesh = nullptr;
  const Mesh::Property_map<Vertex, double>* weight = nullptr;

  Color operator()(const std::array<Halfedge, 3>& h, const std::array<double, 3>& b) const
  {
    double x = 0, y = 0, sum = 0;
    for(int k = 0; k < 3; ++k)
    {
      const double w = weight == nullptr ? b[k] : b[k] * (*weight)[mesh->target(h[k])];
      x += w * uv[h[k]].x();
      y += w * uv[h[k]].y();
      sum += w;
    }
    return is_dark_square(x / sum, y / sum, square) ? Color{0.27, 0.43, 0.63} : Color{0.97, 0.97, 0.94};
  }
};

// The layout in a box; `color` gives the colour of a face.
template <typename FaceColor>
void draw_layout(Canvas& canvas, const Box& box, const Mesh& mesh, const UV_map& uv, double square, FaceColor color)
{
  CGAL::Bbox_2 bounds;
  for(Face f : mesh.faces())
    for(Halfedge h : corners(mesh, f))
      bounds += uv[h].bbox();
  const double scale = (std::min)(box.width / (bounds.xmax() - bounds.xmin()), box.height / (bounds.ymax() - bounds.ymin()));
  for(Face f : mesh.faces())
  {
    const auto h = corners(mesh, f);
    std::array<Point_3, 3> p;
    for(int k = 0; k < 3; ++k)
      p[k] = Point_3(box.left + box.width / 2 + scale * (uv[h[k]].x() - (bounds.xmin() + bounds.xmax()) / 2),
                     box.top + box.height / 2 - scale * (uv[h[k]].y() - (bounds.ymin() + bounds.ymax()) / 2), 0);
    const Color c = color(f);
    std::array<double, 3> height; // pixels, over the side opposite to each corner
    const double area = std::abs(CGAL::area(Point_2(p[0].x(), p[0].y()), Point_2(p[1].x(), p[1].y()), Point_2(p[2].x(), p[2].y())));
    for(int k = 0; k < 3; ++k)
      height[k] = 2 * area / std::sqrt(CGAL::squared_distance(p[(k + 1) % 3], p[(k + 2) % 3]));
    canvas.triangle(p, [&](const std::array<double, 3>& b)
    {
      const double x = b[0] * uv[h[0]].x() + b[1] * uv[h[1]].x() + b[2] * uv[h[2]].x();
      const double y = b[0] * uv[h[0]].y() + b[1] * uv[h[1]].y() + b[2] * uv[h[2]].y();
      Color result = square > 0 && is_dark_square(x, y, square) ? mix(c, {0.27, 0.43, 0.63}, 0.35) : c;
      double nearest = 1e9;
      for(int k = 0; k < 3; ++k)
        nearest = (std::min)(nearest, b[k] * height[k]);
      return nearest < 0.33 ? mix(result, {0.2, 0.2, 0.25}, 0.45) : result;
    });
  }
}

double mean_of_corners(const Mesh& mesh, const Mesh::Property_map<Vertex, double>& u, Face f)
{
  double sum = 0;
  for(Halfedge h : corners(mesh, f))
    sum += u[mesh.target(h)] / 3;
  return sum;
}

void check(bool good, const std::string& what)
{
  if(good)
    return;
  std::cerr << what << std::endl;
  std::exit(EXIT_FAILURE);
}

// --------------------------------------------------------- the pictures ----

// A surface with the checkerboard of its layout, and the layout.
void introduction(const std::string& folder)
{
  Mesh mesh = horned_cap(32, 2.0, 0.55);
  auto uv = mesh.add_property_map<Halfedge, Point_2>("h:uv").first;
  auto u = mesh.add_property_map<Vertex, double>("v:u", 0).first;
  const auto report = CE::flatten(mesh, uv, params::log_scale_factor_map(u));
  check(bool(report), CE::message(report));
  const auto range = std::minmax_element(u.begin(), u.end());
  const auto distortion = CE::compute_conformal_distortion(mesh, uv);
  std::cout << "introduction: " << num_vertices(mesh) << " vertices, " << num_faces(mesh) << " triangles, "
            << report.statistics.number_of_iterations << " steps, residual " << report.statistics.residual
            << ", u from " << *range.first << " to " << *range.second << ", qc mean "
            << distortion.mean_quasi_conformal_factor << ", max " << distortion.maximum_quasi_conformal_factor << std::endl;

  const double square = 0.08;
  Canvas canvas(1000, 460);
  draw_surface(canvas, {10, 10, 500, 440}, mesh, Checkerboard{uv, square});
  draw_layout(canvas, {530, 10, 460, 440}, mesh, uv, square,
              [&](Face f) { return heat((*range.second - mean_of_corners(mesh, u, f)) / (*range.second - *range.first)); });
  canvas.write(folder + "/introduction.png");

  Canvas thumbnail(220, 200);
  draw_surface(thumbnail, {5, 5, 210, 190}, mesh, Checkerboard{uv, 2 * square});
  thumbnail.write(folder + "/conformal_equivalence.png");
}

// Natural border, five corners, rectangle.
void boundary_conditions(const std::string& folder)
{
  Mesh mesh = horned_cap(20, 1.7, 0.45);
  const Halfedge bhd = PMP::longest_border(mesh).first;
  auto uv = mesh.add_property_map<Halfedge, Point_2>("h:uv").first;
  auto u = mesh.add_property_map<Vertex, double>("v:u", 0).first;
  auto angle = mesh.add_property_map<Vertex, double>("v:angle", CGAL_PI).first;
  Canvas canvas(1000, 330);
  const auto draw = [&](double left, const CE::Flattening_report<Mesh>& report, const char* name)
  {
    check(bool(report), CE::message(report));
    const auto range = std::minmax_element(u.begin(), u.end());
    std::cout << name << ": u from " << *range.first << " to " << *range.second << std::endl;
    CGAL::Bbox_2 bounds;
    for(Halfedge h : mesh.halfedges())
      bounds += uv[h].bbox();
    draw_layout(canvas, {left, 10, 310, 310}, mesh, uv, (bounds.xmax() - bounds.xmin()) / 12,
                [&](Face f) { return heat((*range.second - mean_of_corners(mesh, u, f)) / (*range.second - *range.first)); });
  };
  draw(10, CE::flatten(mesh, uv, params::log_scale_factor_map(u)), "natural");

  std::vector<Vertex> border;
  for(Halfedge h : halfedges_around_face(bhd, mesh))
    border.push_back(mesh.target(h));
  for(std::size_t k = 0; k < 5; ++k)
    angle[border[k * border.size() / 5]] = 3 * CGAL_PI / 5;
  draw(345, CE::flatten(mesh, uv, params::border_angle_map(angle).log_scale_factor_map(u)), "pentagon");

  CE::prescribe_rectangle(mesh, CE::select_rectangle_corners(mesh, bhd), angle);
  draw(680, CE::flatten(mesh, uv, params::border_angle_map(angle).log_scale_factor_map(u)), "rectangle");
  canvas.write(folder + "/boundary_conditions.png");
}

// LSCM, ARAP, this package: the surface coloured by the quasi-conformal factor; flipped triangles are blue.
void comparison(const std::string& folder)
{
  Mesh mesh = horned_cap(24, 2.75, 0.8);
  const Halfedge bhd = PMP::longest_border(mesh).first;
  auto uv = mesh.add_property_map<Halfedge, Point_2>("h:uv").first;
  auto uv_of_vertex = mesh.add_property_map<Vertex, Point_2>("v:uv").first;
  Canvas canvas(1000, 330);
  const auto draw = [&](double left, const char* name)
  {
    const auto verdict = CE::verify_layout(mesh, uv);
    const auto distortion = CE::compute_conformal_distortion(mesh, uv);
    auto is_flipped = mesh.add_property_map<Face, bool>("f:is_flipped", false).first;
    for(Face f : verdict.flipped_faces)
      is_flipped[f] = true;
    std::cout << name << ": qc mean " << distortion.mean_quasi_conformal_factor << ", max "
              << distortion.maximum_quasi_conformal_factor << ", log area ratio from " << distortion.minimum_log_area_ratio << " to "
              << distortion.maximum_log_area_ratio << ", flipped " << verdict.number_of_flipped_triangles << std::endl;
    draw_surface(canvas, {left, 10, 310, 310}, mesh, [&](const std::array<Halfedge, 3>& h, const std::array<double, 3>&)
    {
      const Face f = mesh.face(h[0]);
      return is_flipped[f] ? Color{0.1, 0.2, 0.8} : heat(CE::quasi_conformal_factor(mesh, uv, f) - 1);
    });
    mesh.remove_property_map(is_flipped);
  };
  const auto draw_cgal = [&](double left, SMP::Error_code code, const char* name)
  {
    check(code == SMP::OK, std::string(name) + " failed");
    for(Halfedge h : mesh.halfedges())
      uv[h] = uv_of_vertex[mesh.target(h)];
    draw(left, name);
  };
  std::cout << "comparison: " << num_vertices(mesh) << " vertices, " << num_faces(mesh) << " triangles" << std::endl;
  draw_cgal(10, SMP::parameterize(mesh, SMP::LSCM_parameterizer_3<Mesh>(), bhd, uv_of_vertex), "LSCM");
  draw_cgal(345, SMP::parameterize(mesh, SMP::ARAP_parameterizer_3<Mesh>(), bhd, uv_of_vertex), "ARAP");
  const auto report = CE::flatten(mesh, uv);
  check(bool(report), CE::message(report));
  draw(680, "conformal equivalence");
  canvas.write(folder + "/comparison.png");
}

// The same coarse layout, interpolated linearly and projectively.
void interpolation(const std::string& folder)
{
  Mesh mesh = horned_cap(4, 2.5, 0);
  auto uv = mesh.add_property_map<Halfedge, Point_2>("h:uv").first;
  auto weight = mesh.add_property_map<Vertex, double>("v:weight", 1).first;
  const auto report = CE::flatten(mesh, uv, params::projective_weight_map(weight));
  check(bool(report), CE::message(report));
  Canvas canvas(1000, 470);
  draw_surface(canvas, {20, 10, 470, 450}, mesh, Checkerboard{uv, 0.1}, 0.01);
  draw_surface(canvas, {510, 10, 470, 450}, mesh, Checkerboard{uv, 0.1, &mesh, &weight}, 0.01);
  canvas.write(folder + "/interpolation.png");
}

// The conformally equivalent layout with the cones of a seamless one, and its scale.
template <typename NamedParameters>
void flatten_with_cones_of(const CE::Flattening_report<Mesh>& seamless, Mesh& mesh, UV_map uv, const NamedParameters& np)
{
  auto angle = mesh.add_property_map<Vertex, double>("v:cone_angle", 2 * CGAL_PI).first;
  for(const auto& cone : seamless.cones)
    angle[cone.vertex] = cone.angle;
  const auto report = CE::flatten(mesh, uv, CE::combine_named_parameters(np, params::cone_angle_map(angle)));
  check(bool(report), CE::message(report));
  for(Halfedge h : mesh.halfedges())
    uv[h] = CGAL::ORIGIN + seamless.tiling.scale * (uv[h] - CGAL::ORIGIN);
}

// The same cones with the conformally equivalent layout, and with the seamless one; squares have the integers in their centres.
void seamless(const std::string& folder)
{
  Mesh mesh = horned_cap(32, 2.0, 0.55);
  auto uv = mesh.add_property_map<Halfedge, Point_2>("h:uv").first;
  auto before = mesh.add_property_map<Halfedge, Point_2>("h:uv_before").first;
  auto weight = mesh.add_property_map<Mesh::Edge_index, double>("e:weight").first; // seams are to be seen: they go over the top
  for(Mesh::Edge_index e : mesh.edges())
    weight[e] = std::exp(-1.5 * mesh.point(mesh.vertex(e, 0)).z());
  const auto np = params::seam_weight_map(weight);
  const auto report = CE::compute_seamless_parameterization(mesh, uv, CE::combine_named_parameters(np, params::number_of_cones(3).number_of_tiles(150)));
  check(bool(report), CE::message(report));
  flatten_with_cones_of(report, mesh, before, np);
  std::cout << "seamless: " << report.tiling.number_of_tiles << " tiles, qc mean " << report.tiling.mean_factor_before << ", then "
            << report.tiling.mean_factor << "; cones of";
  for(const auto& cone : report.cones)
    std::cout << ' ' << cone.angle * 180 / CGAL_PI << " (" << cone.lattice_point[0] << ", " << cone.lattice_point[1] << ")";
  std::cout << std::endl;

  const Kernel::Vector_2 half(0.5, 0.5);
  for(Halfedge h : mesh.halfedges())
  {
    uv[h] = uv[h] + half;
    before[h] = before[h] + half;
  }
  auto is_beside_seam = mesh.add_property_map<Face, bool>("f:is_beside_seam", false).first;
  for(const auto& transition : report.transitions)
    is_beside_seam[mesh.face(transition.halfedge)] = is_beside_seam[mesh.face(mesh.opposite(transition.halfedge))] = true;
  Canvas canvas(900, 330);
  draw_surface(canvas, {5, 10, 340, 310}, mesh, Checkerboard{before, 1});
  draw_surface(canvas, {360, 10, 340, 310}, mesh, Checkerboard{uv, 1});
  draw_layout(canvas, {720, 10, 175, 310}, mesh, uv, 1, [&](Face f) { return is_beside_seam[f] ? Color{0.95, 0.6, 0.25} : Color{1, 0.98, 0.9}; });
  canvas.write(folder + "/seamless.png");
}

int main(int argc, char* argv[])
{
  const std::string folder = argc > 1 ? argv[1] : ".";
  introduction(folder);
  boundary_conditions(folder);
  interpolation(folder);
  comparison(folder);
  seamless(folder);
  if(argc > 2)
    std::ofstream(argv[2]) << std::setprecision(17) << horned_cap(20, 2.0, 0.55);
  return EXIT_SUCCESS;
}
