// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Refined_mesh_elements.h
/// Which elements of a refined mesh are which of a refinement.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_REFINED_MESH_ELEMENTS_H
#define CGAL_CONFORMAL_EQUIVALENCE_REFINED_MESH_ELEMENTS_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <boost/graph/graph_traits.hpp>

#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// The elements of a mesh that `make_refined_mesh()` has made, by their numbers in the refinement.
template <typename RefinedMesh>
struct Refined_mesh_elements
{
  std::vector<typename boost::graph_traits<RefinedMesh>::vertex_descriptor> vertices; ///< by vertex of the refinement
  std::vector<typename boost::graph_traits<RefinedMesh>::face_descriptor> faces;      ///< by face of the refinement

  /// by corner of the refinement: the halfedge of its face that ends there
  std::vector<typename boost::graph_traits<RefinedMesh>::halfedge_descriptor> halfedges;
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_REFINED_MESH_ELEMENTS_H
