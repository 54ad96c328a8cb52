// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/Given_surface.h"
#include "../include/flatten_mesh/messages.h"
#include "../include/flatten_mesh/read_soup.h"
#include "../include/flatten_mesh/triangulate.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace flattening {

namespace {

typedef std::uint32_t Index;

bool consists_of_triangles(const Polygon_soup& soup)
{
  return std::all_of(soup.faces.begin(), soup.faces.end(), [](const Polygon& face) { return face.size() == 3; });
}

// The vertices that stand for those of a face, sorted.
Polygon points_of(const Given_surface& given, std::size_t f)
{
  Polygon points;
  for(Index v : given.soup.faces[f])
    points.push_back(static_cast<Index>(given.representative_of(v)));
  std::sort(points.begin(), points.end());
  return points;
}

// Whether faces with the same points pass them in opposite directions.
bool are_opposite(const Given_surface& given, const Polygon& a, const Polygon& b)
{
  const auto point = [&](const Polygon& face, std::size_t k) { return given.representative_of(face[k % face.size()]); };
  for(std::size_t k = 0; k < b.size(); ++k)
    if(point(b, k) == point(a, 0))
      return point(b, k + 1) != point(a, 1);
  return false;
}

// What was dropped because it has the same points as another face gets the orientation of that one, so that it lies in the layout as that does.
void turn_duplicates(const std::vector<bool>& is_kept, Given_surface& given)
{
  std::map<Polygon, std::size_t> kept_face;
  for(std::size_t f = 0; f < is_kept.size(); ++f)
    if(is_kept[f])
      kept_face.emplace(points_of(given, f), f);
  for(std::size_t f = 0; f < is_kept.size(); ++f)
  {
    const auto twin = is_kept[f] ? kept_face.end() : kept_face.find(points_of(given, f));
    if(twin != kept_face.end() && are_opposite(given, given.soup.faces[f], given.soup.faces[twin->second]))
      std::reverse(given.soup.faces[f].begin(), given.soup.faces[f].end());
  }
}

// What was repaired: `given.soup` is the soup of the file.
void take_over_repair(const Repaired_soup& repaired, Given_surface& given)
{
  given.repair = repaired.counts;
  given.original = repaired.given_vertex;
  given.representative = repaired.representative;
  for(Index& f : given.face_of_triangle)
    f = repaired.given_face[f];
  std::vector<bool> is_turned(given.soup.faces.size(), false), is_kept(given.soup.faces.size(), false);
  for(std::size_t f = 0; f < repaired.is_turned.size(); ++f)
  {
    is_kept[repaired.given_face[f]] = true;
    if(repaired.is_turned[f])
      is_turned[repaired.given_face[f]] = true;
  }
  for(std::size_t f = 0; f < is_turned.size(); ++f)
    if(is_turned[f])
    {
      std::reverse(given.soup.faces[f].begin(), given.soup.faces[f].end());
      if(! given.attributes.face_normals.empty())
        std::reverse(given.attributes.face_normals[f].begin(), given.attributes.face_normals[f].end());
    }
  if(repaired.counts.duplicate_faces != 0)
    turn_duplicates(is_kept, given);
}

// The triangles of each face of the file.
class Triangles_of_faces
{
  std::vector<std::size_t> first_;
  std::vector<Face> triangles_;

public:
  Triangles_of_faces(const Given_surface& given, const Mesh& mesh) : first_(given.number_of_faces + 1, 0), triangles_(mesh.number_of_faces())
  {
    for(Face t : mesh.faces())
      ++first_[given.face(t) + 1];
    for(std::size_t f = 0; f + 1 < first_.size(); ++f)
      first_[f + 1] += first_[f];
    std::vector<std::size_t> free = first_;
    for(Face t : mesh.faces())
      triangles_[free[given.face(t)]++] = t;
  }

  auto begin(std::size_t f) const { return triangles_.begin() + std::ptrdiff_t(first_[f]); }
  auto end(std::size_t f) const { return triangles_.begin() + std::ptrdiff_t(first_[f + 1]); }
};

// Finds corners of the mesh for those of the file.
class Corner_finder
{
public:
  Corner_finder(const Given_surface& given, const Mesh& mesh)
    : given_(given), mesh_(mesh), triangles_(given, mesh), corner_(given.number_of_vertices, Mesh::null_halfedge()),
      face_of_corner_(given.number_of_vertices, given.number_of_faces), first_copy_(given.number_of_vertices), next_copy_(mesh.number_of_vertices())
  {
    for(Vertex v : mesh.vertices())
      if(v.idx() < given.number_of_vertices)
        first_copy_[v.idx()] = v;
      else
        next_copy_[v.idx()] = std::exchange(first_copy_[given.vertex(v)], v);
  }

  std::vector<Halfedge> corners(std::size_t f)
  {
    for(auto t = triangles_.begin(f); t != triangles_.end(f); ++t)
      for(Halfedge h : mesh_.halfedges_around_face(mesh_.halfedge(*t)))
      {
        const std::size_t v = given_.vertex(mesh_.target(h));
        corner_[v] = h;
        face_of_corner_[v] = f;
      }
    std::vector<Halfedge> result;
    for(Index v : given_.soup.faces[f])
    {
      const std::size_t w = given_.representative_of(v);
      result.push_back(face_of_corner_[w] == f ? corner_[w] : best_corner(w, f));
    }
    fill_gaps(result);
    return result;
  }

private:
  // How many corners of the face g are points of the face f.
  std::ptrdiff_t number_of_common_points(std::size_t f, std::size_t g) const
  {
    const Polygon &a = given_.soup.faces[f], &b = given_.soup.faces[g];
    return std::count_if(b.begin(), b.end(), [&](Index v)
    {
      return std::any_of(a.begin(), a.end(), [&](Index w) { return given_.representative_of(v) == given_.representative_of(w); });
    });
  }

  // Of the faces at v that are in the mesh, the corner of the one that shares most points with the face f, which is not.
  Halfedge best_corner(std::size_t v, std::size_t f) const
  {
    Halfedge best = Mesh::null_halfedge();
    std::ptrdiff_t most = 0;
    for(Vertex w = first_copy_[v]; w != Mesh::null_vertex(); w = next_copy_[w.idx()])
      if(! mesh_.is_isolated(w))
        for(Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(w)))
        {
          const std::ptrdiff_t n = mesh_.is_border(h) ? 0 : number_of_common_points(f, given_.face(mesh_.face(h)));
          if(n > most)
          {
            most = n;
            best = h;
          }
        }
    return best;
  }

  // A point that only faces without area have lies where another corner of its face does, or anywhere.
  void fill_gaps(std::vector<Halfedge>& corners) const
  {
    const auto found = std::find_if(corners.begin(), corners.end(), [](Halfedge h) { return h != Mesh::null_halfedge(); });
    const Halfedge some = found != corners.end() ? *found : mesh_.halfedge(*mesh_.faces().begin());
    std::replace(corners.begin(), corners.end(), Mesh::null_halfedge(), Halfedge(some));
  }

  const Given_surface& given_;
  const Mesh& mesh_;
  Triangles_of_faces triangles_;
  std::vector<Halfedge> corner_;            // by vertex of the file: its corner in the face ...
  std::vector<std::size_t> face_of_corner_; // ... that was looked at last
  std::vector<Vertex> first_copy_;          // by vertex of the file: the first of a list of the vertices of the mesh that are copies of it
  std::vector<Vertex> next_copy_;           // by vertex of the mesh
};

// Several triangles of one face are one face.
void remove_repetitions(std::vector<std::size_t>& faces)
{
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
}

} // namespace

Vertex Given_surface::vertex_of_mesh(std::int64_t i, const std::string& where) const
{
  if(i < 0 || static_cast<std::size_t>(i) >= number_of_vertices)
    fail(where, "there is no vertex ", i, "; the mesh has ", number_of_vertices, " vertices");
  const std::size_t v = representative_of(static_cast<std::size_t>(i));
  if(std::find(original.begin() + std::ptrdiff_t((std::min)(number_of_vertices, original.size())), original.end(), v) != original.end())
    fail(where, "vertex ", i, " is several vertices after --repair, which takes the surface apart there");
  return Vertex(static_cast<Mesh::size_type>(v));
}

Given_surface read_surface(const std::string& file, bool repairs, Mesh& mesh, const std::string& format)
{
  Given_surface given;
  given.soup = read_soup(file, format);
  given.number_of_vertices = given.soup.points.size();
  given.number_of_faces = given.soup.faces.size();
  given.attributes = std::move(given.soup.attributes);
  given.notices = given.soup.notices;
  if(repairs)
  {
    require_faces(given.soup, file);
    check_points(given.soup, file);
    Repaired_soup repaired = repair_soup(given.soup, file);
    if(repaired.soup.faces.empty())
      fail(file, ": there is no face with three different points");
    check_soup(repaired.soup, file);
    build_mesh(repaired.soup, mesh);
    given.face_of_triangle = triangulate_faces(mesh);
    take_over_repair(repaired, given);
    return given;
  }
  check_soup(given.soup, file);
  build_mesh(given.soup, mesh);
  if(consists_of_triangles(given.soup))
  { // which would be copies of those of the mesh
    given.soup.points = {};
    given.soup.faces = {};
  }
  else
    given.face_of_triangle = triangulate_faces(mesh);
  return given;
}

Options with_vertices_of_mesh(Options options, const Given_surface& given)
{
  const auto translate = [&](std::size_t& i, const char* option)
    { i = given.vertex_of_mesh(static_cast<std::int64_t>(i), text(option, ": ")).idx(); };
  if(given.is_mesh())
    return options;
  if(options.vertex_at_infinity)
    translate(*options.vertex_at_infinity, "--vertex-at-infinity");
  if(options.disk_centre)
    translate(*options.disk_centre, "--disk-centre");
  if(options.disk_points)
    for(std::size_t& i : *options.disk_points)
      translate(i, "--disk-points");
  if(options.corners)
    for(std::size_t& i : *options.corners)
      translate(i, "--boundary rectangle");
  return options;
}

void name_as_given(const Given_surface& given, Report& report)
{
  if(given.is_mesh())
    return;
  const auto vertex = [&](std::size_t& i) { i = given.vertex(Vertex(static_cast<Mesh::size_type>(i))); };
  const auto face = [&](std::size_t& i) { i = given.face(Face(static_cast<Mesh::size_type>(i))); };
  for(std::size_t& i : report.vertex_indices)
    vertex(i);
  for(auto& edge : report.edge_indices)
    for(std::size_t& i : edge)
      vertex(i);
  for(std::size_t& i : report.face_indices)
    face(i);
  remove_repetitions(report.face_indices);
  for(auto& cone : report.cones)
    vertex(cone.vertex_index);
  for(auto& lattice : report.lattices)
  {
    std::size_t i = lattice.face;
    face(i);
    lattice.face = static_cast<decltype(lattice.face)>(i);
  }
}

std::string name_of_component(const Given_surface& given, Face first_face, std::size_t number_of_triangles)
{
  return text("the component of face ", given.face(first_face), ", with ", number_of_triangles,
              number_of_triangles == 1 ? " triangle: " : " triangles: ");
}

bool is_diagonal(const Given_surface& given, const Mesh& mesh, Mesh::Edge_index e)
{
  const Halfedge h = mesh.halfedge(e);
  return ! given.is_mesh() && ! mesh.is_border(e) && given.face(mesh.face(h)) == given.face(mesh.face(mesh.opposite(h)));
}

std::vector<std::vector<Halfedge> > corners_in_mesh(const Given_surface& given, const Mesh& mesh)
{
  Corner_finder finder(given, mesh);
  std::vector<std::vector<Halfedge> > result;
  for(std::size_t f = 0; f < given.number_of_faces; ++f)
    result.push_back(finder.corners(f));
  return result;
}

} // namespace flattening
