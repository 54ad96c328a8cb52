// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Where a layout lies, and where it ends: at the border of the mesh, and at the two sides of each seam.

#ifndef FLATTEN_MESH_LAYOUT_OUTLINE_H
#define FLATTEN_MESH_LAYOUT_OUTLINE_H

#include "color_scale.h"

#include <CGAL/Conformal_equivalence/internal/IO/corner_values.h>

#include <cmath>

namespace flattening {

using CGAL::Conformal_equivalence::internal::corner_value;

// The rectangle that a layout lies in; empty if it has no finite points.
struct Layout_box
{
  Finite_range x, y;
};

template <typename TriangleMesh, typename HalfedgeUVMap>
Layout_box layout_box(const TriangleMesh& tm, const HalfedgeUVMap& uv)
{
  Layout_box box;
  for(auto h : halfedges(tm))
    if(! is_border(h, tm))
    {
      const auto p = corner_value(uv, h);
      if(! std::isfinite(p[0]) || ! std::isfinite(p[1]))
        continue;
      box.x.insert(p[0]);
      box.y.insert(p[1]);
    }
  return box;
}

// Edges at which the layout ends: borders, and edges whose two sides lie apart.
// To be asked of a halfedge that has a face.
template <typename TriangleMesh, typename HalfedgeUVMap, typename Halfedge>
bool is_outline(const TriangleMesh& tm, const HalfedgeUVMap& uv, Halfedge h)
{
  const Halfedge o = opposite(h, tm);
  return is_border(o, tm)
      || corner_value(uv, h) != corner_value(uv, prev(o, tm))
      || corner_value(uv, prev(h, tm)) != corner_value(uv, o);
}

// The halfedge of the outline that follows `h` along it, the layout on the left.
template <typename TriangleMesh, typename HalfedgeUVMap, typename Halfedge>
Halfedge next_on_outline(const TriangleMesh& tm, const HalfedgeUVMap& uv, Halfedge h)
{
  Halfedge n = next(h, tm);
  while(! is_outline(tm, uv, n))
    n = next(opposite(n, tm), tm);
  return n;
}

} // namespace flattening

#endif // FLATTEN_MESH_LAYOUT_OUTLINE_H
