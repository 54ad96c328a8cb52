// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_OBJ_ATTRIBUTE_WRITER_H
#define FLATTEN_MESH_OBJ_ATTRIBUTE_WRITER_H

#include "OBJ_attributes.h"
#include "page_text.h"

#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>

#include <cstddef>
#include <string>
#include <vector>

namespace flattening {

// Writes what an OBJ file said besides points and faces into another one. Vertices, faces and corners are those of the file read; they may come in
// any order, and repeatedly.
class OBJ_attribute_writer
{
public:
  // Normals are written only if the corners of the faces written are those of the faces read, and in the same space; colours if the vertices are.
  // `material` is for faces that have none, or has no file.
  OBJ_attribute_writer(const OBJ_attributes& attributes, bool keeps_normals, bool keeps_colors,
                       const CGAL::Conformal_equivalence::IO::OBJ_material& material)
    : attributes_(attributes), keeps_normals_(keeps_normals && ! attributes.face_normals.empty()), keeps_colors_(keeps_colors), material_(material)
  {}

  // The lines that name files of materials.
  void write_libraries(Text_buffer& out) const;

  // What follows the point of a vertex.
  void write_after_point(Text_buffer& out, std::size_t vertex) const;

  void write_normals(Text_buffer& out) const;

  // The lines that hold for this face, and did not for the one before.
  void write_before_face(Text_buffer& out, std::size_t face);

  // What follows the vertex of a corner, and its texture coordinates.
  void write_after_corner(Text_buffer& out, std::size_t face, std::size_t corner) const;

private:
  // Sections are counted from 1; the faces before the first one are in section 0.
  OBJ_attributes::Section section(std::size_t number) const;

  const OBJ_attributes& attributes_;
  bool keeps_normals_, keeps_colors_;
  CGAL::Conformal_equivalence::IO::OBJ_material material_;
  std::size_t last_number_ = std::size_t(-1); // of the section of the last face
  OBJ_attributes::Section last_;              // what holds after the lines written so far
};

// Whether each face has a material.
bool all_faces_have_a_material(const OBJ_attributes& attributes);

// Makes each component an object of its own, unless objects are given. `component`: by face.
void name_components(const std::vector<std::size_t>& component, OBJ_attributes& attributes);

// The attributes, with the names of libraries in the file `input` as they are seen from the file `output`.
OBJ_attributes seen_from(const std::string& output, const std::string& input, OBJ_attributes attributes);

} // namespace flattening

#endif // FLATTEN_MESH_OBJ_ATTRIBUTE_WRITER_H
