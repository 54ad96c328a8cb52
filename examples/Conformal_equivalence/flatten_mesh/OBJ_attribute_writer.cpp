// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/OBJ_attribute_writer.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

namespace flattening {

namespace {

namespace fs = std::filesystem;

// What a line has to say for a face without it, after a face with it.
std::optional<std::string> absent_value(std::size_t key)
{
  switch(key)
  {
    case OBJ_attributes::GROUP:     return "default"; // its name, if none is given
    case OBJ_attributes::SMOOTHING: return "off";
    default:                        return std::nullopt;
  }
}

// The file `name`, in the folder `from` unless the name is absolute, as it is seen from the folder `to`.
std::string name_seen_from(const fs::path& to, const fs::path& from, const std::string& name)
{
  std::error_code error;
  const fs::path path = from / name, relative = fs::relative(path, to, error);
  if(fs::path(name).is_absolute())
    return name;
  return error || relative.empty() ? fs::absolute(path, error).generic_string() : relative.generic_string();
}

// The names that follow `mtllib` in the file `input`, as they are seen from the file `output`.
std::string libraries_seen_from(const std::string& output, const std::string& input, const std::string& names)
{
  if(names.empty())
    return names;
  std::error_code error;
  const fs::path from = fs::path(input).parent_path(), to = fs::absolute(output, error).parent_path();
  if(fs::equivalent(fs::absolute(from / ".", error), to, error))
    return names;
  if(fs::exists(from / names, error)) // a name may have spaces
    return name_seen_from(to, from, names);
  std::string result;
  std::istringstream words(names);
  for(std::string name; words >> name; )
    result += (result.empty() ? "" : " ") + name_seen_from(to, from, name);
  return result;
}

} // namespace

void OBJ_attribute_writer::write_libraries(Text_buffer& out) const
{
  if(! material_.file.empty())
    out << "mtllib " << material_.file << '\n';
  for(const std::string& names : attributes_.libraries)
    out << "mtllib " << names << '\n';
}

void OBJ_attribute_writer::write_after_point(Text_buffer& out, std::size_t vertex) const
{
  if(keeps_colors_ && vertex < attributes_.colors.size() && attributes_.colors[vertex])
    for(double x : *attributes_.colors[vertex])
      out << ' ' << x;
}

void OBJ_attribute_writer::write_normals(Text_buffer& out) const
{
  if(keeps_normals_)
    for(const auto& n : attributes_.normals)
      out << "vn " << n[0] << ' ' << n[1] << ' ' << n[2] << '\n';
}

OBJ_attributes::Section OBJ_attribute_writer::section(std::size_t number) const
{
  OBJ_attributes::Section result;
  if(number > 0)
    result = attributes_.sections[number - 1];
  if(! result[OBJ_attributes::MATERIAL] && ! material_.file.empty())
    result[OBJ_attributes::MATERIAL] = material_.name;
  return result;
}

void OBJ_attribute_writer::write_before_face(Text_buffer& out, std::size_t face)
{
  const auto& first = attributes_.first_faces;
  const std::size_t number = static_cast<std::size_t>(std::upper_bound(first.begin(), first.end(), face) - first.begin());
  if(number == last_number_)
    return;
  last_number_ = number;
  OBJ_attributes::Section lines = section(number);
  for(std::size_t k = 0; k < lines.size(); ++k)
  {
    if(! lines[k] && last_[k])
      lines[k] = absent_value(k);
    if(lines[k] && lines[k] != last_[k])
    {
      out << OBJ_attributes::key_words[k] << (lines[k]->empty() ? "" : " ") << *lines[k] << '\n';
      last_[k] = lines[k];
    }
  }
}

void OBJ_attribute_writer::write_after_corner(Text_buffer& out, std::size_t face, std::size_t corner) const
{
  if(keeps_normals_ && ! attributes_.face_normals[face].empty())
    out << '/' << attributes_.face_normals[face][corner] + 1;
}

bool all_faces_have_a_material(const OBJ_attributes& attributes)
{
  return ! attributes.sections.empty() && attributes.first_faces.front() == 0 && attributes.sections.front()[OBJ_attributes::MATERIAL];
}

void name_components(const std::vector<std::size_t>& component, OBJ_attributes& attributes)
{
  const std::vector<OBJ_attributes::Section> given = attributes.sections;
  const std::vector<std::size_t> first = attributes.first_faces;
  if(std::any_of(given.begin(), given.end(), [](const auto& section) { return section[OBJ_attributes::OBJECT].has_value(); }))
    return;
  attributes.sections.clear();
  attributes.first_faces.clear();
  std::size_t next = 0; // section
  for(std::size_t f = 0; f < component.size(); ++f)
  {
    const std::size_t before = next;
    while(next < first.size() && first[next] <= f)
      ++next;
    if(f != 0 && next == before && component[f] == component[f - 1])
      continue;
    attributes.sections.push_back(next == 0 ? OBJ_attributes::Section() : given[next - 1]);
    attributes.sections.back()[OBJ_attributes::OBJECT] = "component_" + std::to_string(component[f]);
    attributes.first_faces.push_back(f);
  }
}

OBJ_attributes seen_from(const std::string& output, const std::string& input, OBJ_attributes attributes)
{
  std::error_code ignored;
  const bool is_no_file = output == "-" || input == "-" || (fs::exists(output, ignored) && ! fs::is_regular_file(output, ignored));
  for(std::string& names : attributes.libraries)
    if(! is_no_file)
      names = libraries_seen_from(output, input, names);
  return attributes;
}

} // namespace flattening
