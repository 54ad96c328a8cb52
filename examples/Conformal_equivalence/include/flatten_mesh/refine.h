// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef FLATTEN_MESH_REFINE_H
#define FLATTEN_MESH_REFINE_H

#include "inscribe.h"
#include "mesh.h"
#include "messages.h"
#include "options.h"
#include "results.h"

#include <CGAL/Conformal_equivalence/make_refined_mesh.h>
#include <CGAL/Conformal_equivalence/triangulate_refinement.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flattening {

// Is the common refinement to be written, instead of the mesh? It has to be where edges were flipped and straight triangles will not do, or
// where the map in them is wanted, which is projective only on the parts; for the disk, also where the border is no polygon of border edges.
inline bool is_refinement_needed(const Options& options, const Report& report, const Refinement& refinement)
{
  return refinement.number_of_faces() != 0
      && (options.refine || options.projective || ! report.bent_faces.empty()
          || (options.target == Target::DISK && ! report.lost_border_edges.empty()));
}

// The weights of all vertices follow from the scale factors, and the scale factors of crossings from their weights.
inline void find_scale_factors(const Result& given, Result& refined)
{
  double least = std::numeric_limits<double>::infinity();
  for(Vertex v : given.mesh.vertices())
    if(! given.mesh.is_isolated(v))
      least = (std::min)(least, given.u[v]);
  for(Vertex v : refined.mesh.vertices())
    refined.u[v] = v.idx() < given.mesh.number_of_vertices() ? given.u[v] : least - std::log(refined.weight[v]);
}

// Makes the mesh of the refinement, of triangles if it can hold them.
inline void make_refined_mesh(const Options& options, const Result& given, const Refinement& refinement, Result& refined)
{
  const auto make = [&](const auto& mesh, const auto& parts)
  {
    const auto elements = CE::make_refined_mesh(mesh, parts, refined.mesh, refined.uv, CGAL::parameters::default_values(),
                                                CGAL::parameters::projective_weight_map(refined.weight));
    if(elements.faces.empty())
      fail(options.input, ": ", CE::message(CE::Status::NOT_REPRESENTABLE));
    return elements;
  };
  if(given.wide.is_used)
  {
    const Wide_refinement parts = CE::triangulate_refinement(given.wide.refinement);
    set_wide_points(parts, make(CE::import_mesh<CE::Multiprecision_number>(given.mesh), parts), refined.mesh, refined.wide);
  }
  else
    make(CE::import_mesh(given.mesh), CE::triangulate_refinement(refinement));
  find_scale_factors(given, refined);
  if(options.target == Target::DISK)
    find_image_of_corners(refined);
}

} // namespace flattening

#endif // FLATTEN_MESH_REFINE_H
