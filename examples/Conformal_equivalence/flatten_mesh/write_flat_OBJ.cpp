// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/layout_files.h"
#include "../include/flatten_mesh/page_text.h"
#include "../include/flatten_mesh/Written_faces.h"

#include <CGAL/Conformal_equivalence/IO/write_OBJ.h>

#include <CGAL/boost/graph/properties.h>

#include <cstddef>
#include <ostream>
#include <vector>

namespace flattening {

namespace {

template <typename Uv>
bool write_flat_OBJ(std::ostream& out, const Given_surface& given, const Result& result, const Uv& uv)
{
  const Written_faces faces(given, result);
  const auto number = get(CGAL::dynamic_halfedge_property_t<std::size_t>(), static_cast<const Mesh&>(result.mesh));
  {
    Text_buffer buffer(out);
    for(Halfedge h : CE::internal::number_corner_values(result.mesh, uv, number))
    {
      const auto p = CE::internal::corner_value(uv, h);
      CE::internal::write_obj_number(buffer << "v ", p[0]);
      CE::internal::write_obj_number(buffer << ' ', p[1]);
      buffer << " 0\n";
    }
    std::vector<Halfedge> corners;
    for(std::size_t f = 0; f < faces.size(); ++f)
    {
      faces.get_corners(f, corners);
      buffer << 'f';
      for(Halfedge h : corners)
        buffer << ' ' << get(number, h) + 1;
      buffer << '\n';
    }
  }
  out.flush();
  return out.good();
}

} // namespace

bool write_flat_OBJ(std::ostream& out, const Given_surface& given, const Result& result)
{
  return result.wide.is_used ? write_flat_OBJ(out, given, result, result.wide.uv) : write_flat_OBJ(out, given, result, result.uv);
}

} // namespace flattening
