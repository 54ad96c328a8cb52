// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_WRITTEN_FACES_H
#define FLATTEN_MESH_WRITTEN_FACES_H

#include "Given_surface.h"
#include "mesh.h"
#include "OBJ_attribute_writer.h"
#include "page_text.h"
#include "results.h"

#include <cstddef>
#include <vector>

namespace flattening {

// The faces that are written: those of the file or, if another mesh was made, those of that mesh.
class Written_faces
{
public:
  Written_faces(const Given_surface& given, const Result& result) : given_(given), result_(result)
  {
    if(are_of_file() && ! given.is_mesh())
      corners_ = corners_in_mesh(given, result.mesh);
  }

  bool are_of_file() const { return result_.given_face.empty(); }
  std::size_t size() const { return corners_.empty() ? result_.mesh.number_of_faces() : corners_.size(); }

  // The face of the file that the face `f` is, or is part of.
  std::size_t face_of_file(std::size_t f) const
  {
    return are_of_file() ? f : given_.face(Face(static_cast<Mesh::size_type>(result_.given_face[f])));
  }

  // The corners of the mesh that have the places of those of the face.
  void get_corners(std::size_t f, std::vector<Halfedge>& corners) const
  {
    if(! corners_.empty())
      corners = corners_[f];
    else
    {
      const auto around = result_.mesh.halfedges_around_face(result_.mesh.halfedge(Face(static_cast<Mesh::size_type>(f))));
      corners.assign(around.begin(), around.end());
    }
  }

  // The vertex at corner `k` of the face, whose place is that of `corner`. Copies that --repair has made are the vertices of the file that they are
  // copies of, except on the sphere, where each has its own point.
  std::size_t vertex(std::size_t f, std::size_t k, Halfedge corner, bool is_on_sphere) const
  {
    const std::size_t v = result_.mesh.target(corner).idx();
    return corners_.empty() || (is_on_sphere && v >= given_.number_of_vertices) ? v : given_.soup.faces[f][k];
  }

private:
  const Given_surface& given_;
  const Result& result_;
  std::vector<std::vector<Halfedge> > corners_; // empty: those of the mesh
};

// Lines `f`, and those that say more of the faces. `write_place(out, h)` writes what follows a vertex for its place in the layout.
template <typename WritePlace>
void write_face_lines(Text_buffer& out, const Written_faces& faces, OBJ_attribute_writer& attributes, bool is_on_sphere, WritePlace write_place)
{
  std::vector<Halfedge> corners;
  for(std::size_t f = 0; f < faces.size(); ++f)
  {
    attributes.write_before_face(out, faces.face_of_file(f));
    out << 'f';
    faces.get_corners(f, corners);
    for(std::size_t k = 0; k < corners.size(); ++k)
    {
      out << ' ' << faces.vertex(f, k, corners[k], is_on_sphere) + 1;
      write_place(out, corners[k]);
      attributes.write_after_corner(out, f, k);
    }
    out << '\n';
  }
}

} // namespace flattening

#endif // FLATTEN_MESH_WRITTEN_FACES_H
