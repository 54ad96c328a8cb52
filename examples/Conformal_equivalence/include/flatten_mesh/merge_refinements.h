// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Of refinements of components, one of the whole.

#ifndef FLATTEN_MESH_MERGE_REFINEMENTS_H
#define FLATTEN_MESH_MERGE_REFINEMENTS_H

#include "Components.h"
#include "mesh.h"
#include "precision.h"
#include "results.h"

#include <CGAL/Conformal_equivalence/Common_refinement.h>

#include <cstdint>
#include <vector>

namespace flattening {

// The refinement of the whole as far as components were added. Vertices of the mesh come first, then all crossings.
template <typename NT>
struct Merged_refinement
{
  CE::Common_refinement<NT> parts;
  std::uint32_t number_of_flat_edges = 0, number_of_flat_faces = 0; // with their numbers shifted, so that all are different
};

// Components that need no refinement consist of their triangles there.
class Refinement_merger
{
public:
  explicit Refinement_merger(Results& whole);

  // `found` is of the component; images of the vertices of the mesh are taken over elsewhere.
  void append(const Component_mesh& part, const Results& found, bool is_refined);

  // There is no refinement unless some component needs one.
  void finish();

private:
  std::vector<std::uint32_t> edges_of_whole(const Component_mesh& part);

  Results& whole_;
  Merged_refinement<double> merged_;
  Merged_refinement<CE::Multiprecision_number> wide_;
  std::vector<std::uint32_t> edge_of_halfedge_;  // of the whole, by halfedge as triangulations number them; empty until it is needed
  std::vector<Space_point> crossings_;           // of spheres
  std::vector<Wide_space_point> wide_crossings_;
  bool is_any_refined_ = false;
};

} // namespace flattening

#endif // FLATTEN_MESH_MERGE_REFINEMENTS_H
