// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_OBJ_ATTRIBUTE_WRITER_H
#define FLATTEN_MESH_OBJ_ATTRIBUTE_WRITER_H

#include "OBJ_attributes.h"
#include "page_text.h"

#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>

#include <cstddef>
#include <string>

namespace flattening {

// Writes what an OBJ file said of its faces into another one, between its vertices and faces. Faces and corners are those of the file read; they
// may come in any order, and repeatedly.
class OBJ_attribute_writer
{
public:
  // Normals are written only if the corners of the faces written are those of the faces read. `material` is for faces that have none.
  OBJ_attribute_writer(const OBJ_attributes& attributes, bool keeps_normals, const CGAL::Conformal_equivalence::IO::OBJ_material& material)
    : attributes_(attributes), keeps_normals_(keeps_normals && ! attributes.face_normals.empty()), material_(material)
  {}

  void write_libraries(Text_buffer& out) const;
  void write_normals(Text_buffer& out) const;

  // The lines that hold for this face, and did not for the one before.
  void write_before_face(Text_buffer& out, std::size_t face);

  // What follows the vertex, or the vertex and its texture coordinates, of a corner.
  void write_after_corner(Text_buffer& out, std::size_t face, std::size_t corner, bool has_texture) const;

private:
  OBJ_attributes::Section section_of(std::size_t face) const;

  const OBJ_attributes& attributes_;
  bool keeps_normals_;
  CGAL::Conformal_equivalence::IO::OBJ_material material_;
  OBJ_attributes::Section last_; // what holds after the lines written so far
};

// Whether each face has a material.
bool all_faces_have_a_material(const OBJ_attributes& attributes);

// The names of libraries that follow `mtllib` in the file `input`, as they are seen from the file `output`.
std::string libraries_seen_from(const std::string& output, const std::string& input, const std::string& names);

} // namespace flattening

#endif // FLATTEN_MESH_OBJ_ATTRIBUTE_WRITER_H
