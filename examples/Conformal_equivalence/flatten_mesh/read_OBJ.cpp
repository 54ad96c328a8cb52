// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/readers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flattening {

namespace {

// The indices of a corner "v", "v/vt", "v//vn" or "v/vt/vn"; 0 for one that is absent. (Some programs write "v/" and "v//".)
std::array<std::int64_t, 3> corner_indices(Scanner& in)
{
  const std::string_view corner = in.word();
  std::array<std::int64_t, 3> indices{{0, 0, 0}};
  std::string_view rest = corner;
  for(std::size_t k = 0; k < 3; ++k)
  {
    const std::size_t slash = (std::min)(rest.find('/'), rest.size());
    const std::string_view index = rest.substr(0, slash);
    if((k == 0 || ! index.empty()) && (! Scanner::parse(index, indices[k]) || indices[k] == 0))
      in.error("a face: expected the number of a ", k == 0 ? "vertex" : k == 1 ? "texture coordinate" : "normal", ", found '",
               Scanner::printable(index), "' in '", Scanner::printable(corner), "'");
    if(slash == rest.size())
      return indices;
    rest.remove_prefix(slash + 1);
  }
  in.error("a face: expected a corner 'v/vt/vn', found '", Scanner::printable(corner), "'");
}

// Lines that mean nothing to the surface, by the words they begin with: they are skipped, and that is said.
bool may_be_skipped(std::string_view key)
{
  const unsigned char first = static_cast<unsigned char>(key[0]);
  double number;
  return first > 0x20 && first < 0x7f && ! Scanner::parse(key, number);
}

class OBJ_reader
{
public:
  OBJ_reader(std::string_view content, const std::string& file) : in_(content, file, '#', '\\') {}

  Polygon_soup read()
  {
    for(; ! in_.at_end(); in_.skip_line())
      read_line(in_.word());
    set_faces();
    set_normals();
    skipped_.report("lines", soup_);
    return std::move(soup_);
  }

private:
  struct Corner { std::int64_t vertex, normal; }; // from 0; -1: there is no normal

  struct Face { std::size_t line, first_corner; }; // its vertices may come later

  void read_line(std::string_view key)
  {
    if(key == "v")
      read_vertex();
    else if(key == "vn")
    {
      soup_.attributes.normals.emplace_back();
      for(double& x : soup_.attributes.normals.back())
        x = in_.number_in_line();
    }
    else if(key == "f" || key == "fo") // the latter is of older files
      read_face();
    else if(key == "mtllib")
      soup_.attributes.libraries.push_back(in_.rest_of_line());
    else if(key == "call" || key == "csh")
      in_.error("'", key, "' takes lines from elsewhere; that is not supported");
    else if(key != "vt" && ! read_attribute(key)) // the texture coordinates are those to be found
    {
      if(! may_be_skipped(key))
        in_.error("expected a key word, such as 'v' or 'f', found '", Scanner::printable(key), "'");
      skipped_.count(key);
    }
  }

  // A weight may follow, and a color.
  void read_vertex()
  {
    soup_.points.emplace_back();
    for(double& x : soup_.points.back())
      x = in_.number_in_line();
    std::array<double, 3> last{{ 0, 0, 0 }};
    std::size_t number = 0;
    for(; ! in_.at_end_of_line(); ++number)
      last = {{ last[1], last[2], in_.number_in_line() }};
    if(number != 3 && number != 4)
      return;
    soup_.attributes.colors.resize(soup_.points.size());
    soup_.attributes.colors.back() = last;
  }

  // A number from 1, or backwards from the last if negative, as one from 0.
  static std::int64_t from_zero(std::int64_t i, std::size_t number)
  {
    return i > 0 ? i - 1 : static_cast<std::int64_t>(number) + i;
  }

  void read_face()
  {
    faces_.push_back({in_.line(), corners_.size()});
    while(! in_.at_end_of_line())
    {
      const std::array<std::int64_t, 3> corner = corner_indices(in_);
      corners_.push_back({ from_zero(corner[0], soup_.points.size()),
                           corner[2] == 0 ? -1 : from_zero(corner[2], soup_.attributes.normals.size()) });
      has_normals_ = has_normals_ || corner[2] != 0;
    }
    if(corners_.size() == faces_.back().first_corner)
      fail_without_vertices(place(in_), faces_.size() - 1);
  }

  bool read_attribute(std::string_view key)
  {
    for(std::size_t k = 0; k < OBJ_attributes::NUMBER_OF_KEYS; ++k)
      if(key == OBJ_attributes::key_words[k])
      {
        current_section()[k] = in_.rest_of_line();
        return true;
      }
    return false;
  }

  // The section of the faces to come.
  OBJ_attributes::Section& current_section()
  {
    OBJ_attributes& a = soup_.attributes;
    if(a.sections.empty() || a.first_faces.back() != faces_.size())
    {
      a.sections.push_back(a.sections.empty() ? OBJ_attributes::Section() : OBJ_attributes::Section(a.sections.back()));
      a.first_faces.push_back(faces_.size());
    }
    return a.sections.back();
  }

  std::size_t end_of_face(std::size_t f) const
  {
    return f + 1 < faces_.size() ? faces_[f + 1].first_corner : corners_.size();
  }

  void set_faces()
  {
    soup_.faces.resize(faces_.size());
    for(std::size_t f = 0; f < faces_.size(); ++f)
      for(std::size_t c = faces_[f].first_corner; c < end_of_face(f); ++c)
      {
        if(! is_index(corners_[c].vertex, soup_.points.size()))
          fail(in_.file(), ": line ", faces_[f].line, ": face ", f, " names the vertex ", corners_[c].vertex + 1,
               " (counted from 1), but there are ", soup_.points.size(), " vertices");
        soup_.faces[f].push_back(static_cast<std::uint32_t>(corners_[c].vertex));
      }
  }

  // A face has normals if all of its corners have one.
  void set_normals()
  {
    if(! has_normals_)
      return;
    OBJ_attributes& a = soup_.attributes;
    a.face_normals.resize(faces_.size());
    std::size_t number_of_losses = 0;
    for(std::size_t f = 0; f < faces_.size(); ++f)
    {
      const auto begin = corners_.begin() + static_cast<std::ptrdiff_t>(faces_[f].first_corner),
                 end = corners_.begin() + static_cast<std::ptrdiff_t>(end_of_face(f));
      if(std::all_of(begin, end, [&](const Corner& c) { return is_index(c.normal, a.normals.size()); }))
        for(auto c = begin; c != end; ++c)
          a.face_normals[f].push_back(static_cast<std::uint32_t>(c->normal));
      else
        number_of_losses += std::any_of(begin, end, [&](const Corner& c) { return c.normal != -1; });
    }
    if(number_of_losses != 0)
      soup_.notices.push_back(text("skipped the normals of ", number_of_losses, number_of_losses == 1 ? " face" : " faces",
                                   ", where not every corner has one"));
    if(std::all_of(a.face_normals.begin(), a.face_normals.end(), [](const auto& normals) { return normals.empty(); }))
      a.face_normals.clear();
  }

  Scanner in_;
  Polygon_soup soup_;
  std::vector<Face> faces_;
  std::vector<Corner> corners_;
  bool has_normals_ = false;
  Skipped skipped_;
};

} // namespace

Polygon_soup read_obj(std::string_view content, const std::string& file)
{
  return OBJ_reader(content, file).read();
}

} // namespace flattening
