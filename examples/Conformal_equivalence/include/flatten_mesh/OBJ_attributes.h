// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_OBJ_ATTRIBUTES_H
#define FLATTEN_MESH_OBJ_ATTRIBUTES_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace flattening {

// What an OBJ file says besides points and faces, to be written again: objects, groups, materials, smoothing and normals of faces, and colours of
// vertices.
struct OBJ_attributes
{
  enum Key { OBJECT, GROUP, MATERIAL, SMOOTHING, NUMBER_OF_KEYS };
  static constexpr const char* key_words[NUMBER_OF_KEYS] = { "o", "g", "usemtl", "s" };

  // What follows the key word in the last such line before a face; nothing if there is no such line.
  typedef std::array<std::optional<std::string>, NUMBER_OF_KEYS> Section;

  std::vector<std::string> libraries;           // what follows `mtllib`, a string for each line
  std::vector<Section> sections;                // each differs from the one before
  std::vector<std::size_t> first_faces;         // of the sections, in increasing order
  std::vector<std::array<double, 3> > normals;
  std::vector<std::vector<std::uint32_t> > face_normals; // by face, by corner; empty for a face without normals, or if there is none at all
  std::vector<std::optional<std::array<double, 3> > > colors; // by vertex; may end before the last one, and is empty if there is none at all
};

} // namespace flattening

#endif // FLATTEN_MESH_OBJ_ATTRIBUTES_H
