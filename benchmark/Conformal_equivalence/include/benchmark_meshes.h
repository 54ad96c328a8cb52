// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The meshes of the benchmarks: read from a file, or made from a specification.

#ifndef CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_BENCHMARK_MESHES_H
#define CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_BENCHMARK_MESHES_H

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/subdivision_method_3.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace benchmarks {

typedef CGAL::Simple_cartesian<double>           Kernel;
typedef Kernel::Point_2                          Point_2;
typedef Kernel::Point_3                          Point_3;
typedef CGAL::Surface_mesh<Point_3>              Mesh;
typedef boost::graph_traits<Mesh>::vertex_descriptor   vertex_descriptor;
typedef boost::graph_traits<Mesh>::halfedge_descriptor halfedge_descriptor;
typedef boost::graph_traits<Mesh>::edge_descriptor     edge_descriptor;
typedef boost::graph_traits<Mesh>::face_descriptor     face_descriptor;

// The same numbers on every platform.
class Random_numbers
{
  std::mt19937 engine_;

public:
  explicit Random_numbers(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) { return low + (high - low) * (engine_() / 4294967296.); }
};

// Hills of several sizes, about half as high as wide.
inline double terrain_height(double x, double y)
{
  double height = 0, size = 0.12, frequency = 7;
  for(int octave = 0; octave < 5; ++octave, size *= 0.5, frequency *= 2)
    height += size * std::sin(frequency * x + 1.3 * octave) * std::cos(frequency * 0.9 * y - 0.7 * octave);
  return height;
}

// Positive iff d lies inside of the circle through a, b, c, which are in counterclockwise order.
inline double in_circle(const Point_3& a, const Point_3& b, const Point_3& c, const Point_3& d)
{
  const double ax = a.x() - d.x(), ay = a.y() - d.y(), bx = b.x() - d.x(), by = b.y() - d.y(),
               cx = c.x() - d.x(), cy = c.y() - d.y();
  return (ax * ax + ay * ay) * (bx * cy - cx * by) - (bx * bx + by * by) * (ax * cy - cx * ay)
       + (cx * cx + cy * cy) * (ax * by - bx * ay);
}

// A height field over a jittered grid of about n vertices on the unit square; every
// quadrangle is divided by the diagonal that is locally Delaunay in the plane.
inline Mesh terrain(std::size_t n)
{
  const std::size_t m = std::size_t(std::lround(std::sqrt(double(n))));
  if(m < 2)
    throw std::runtime_error("a terrain needs 4 vertices");
  const double step = 1. / double(m - 1);
  Random_numbers random(1);
  Mesh mesh;
  mesh.reserve(m * m, 3 * m * m, 2 * m * m);
  for(std::size_t j = 0; j < m; ++j)
    for(std::size_t i = 0; i < m; ++i)
    {
      const double dx = random(-0.3, 0.3), dy = random(-0.3, 0.3);
      const double x = step * (double(i) + (i == 0 || i + 1 == m ? 0 : dx));
      const double y = step * (double(j) + (j == 0 || j + 1 == m ? 0 : dy));
      mesh.add_vertex(Point_3(x, y, terrain_height(x, y)));
    }
  for(std::size_t j = 0; j + 1 < m; ++j)
    for(std::size_t i = 0; i + 1 < m; ++i)
    {
      const vertex_descriptor a(std::uint32_t(j * m + i)), b(std::uint32_t(j * m + i + 1)),
                              c(std::uint32_t((j + 1) * m + i + 1)), d(std::uint32_t((j + 1) * m + i));
      if(in_circle(mesh.point(a), mesh.point(b), mesh.point(c), mesh.point(d)) > 0)
      {
        mesh.add_face(a, b, d);
        mesh.add_face(b, c, d);
      }
      else
      {
        mesh.add_face(a, b, c);
        mesh.add_face(a, c, d);
      }
    }
  return mesh;
}

// Moves every vertex by up to `amount` times the mean length of its edges, in each coordinate.
inline void add_noise(Mesh& mesh, double amount)
{
  Random_numbers random(2);
  std::vector<Point_3> moved;
  moved.reserve(num_vertices(mesh));
  for(vertex_descriptor v : vertices(mesh))
  {
    double length = 0;
    std::size_t degree = 0;
    for(halfedge_descriptor h : CGAL::halfedges_around_target(v, mesh))
    {
      length += std::sqrt(CGAL::squared_distance(mesh.point(v), mesh.point(source(h, mesh))));
      ++degree;
    }
    const double size = degree == 0 ? 0 : amount * length / double(degree);
    const double dx = random(-size, size), dy = random(-size, size), dz = random(-size, size);
    const Point_3& p = mesh.point(v);
    moved.emplace_back(p.x() + dx, p.y() + dy, p.z() + dz);
  }
  auto point = moved.begin();
  for(vertex_descriptor v : vertices(mesh))
    mesh.point(v) = *point++;
}

inline Mesh read_mesh(const std::string& file)
{
  Mesh mesh;
  if(!CGAL::IO::read_polygon_mesh(file, mesh))
    throw std::runtime_error("cannot read " + file);
  return mesh;
}

// `terrain:N`, `loop:K:NOISE:FILE`, or the name of a file.
inline Mesh make_mesh(const std::string& specification)
{
  if(specification.compare(0, 8, "terrain:") == 0)
    return terrain(std::strtoul(specification.c_str() + 8, nullptr, 10));
  if(specification.compare(0, 5, "loop:") != 0)
    return read_mesh(specification);

  std::istringstream rest(specification.substr(5));
  unsigned int times = 0;
  double noise = 0;
  char colon = 0, colon_2 = 0;
  std::string file;
  if(!(rest >> times >> colon >> noise >> colon_2) || colon != ':' || colon_2 != ':' || !std::getline(rest, file))
    throw std::runtime_error("expected loop:K:NOISE:FILE instead of " + specification);
  Mesh mesh = read_mesh(file);
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(times));
  if(noise > 0)
    add_noise(mesh, noise);
  return mesh;
}

} // namespace benchmarks

#endif // CGAL_BENCHMARK_CONFORMAL_EQUIVALENCE_BENCHMARK_MESHES_H
