// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file compute_cut_graph.h
/// Where to cut a surface so that it can be laid out: a system of loops opens the handles
/// (Erickson and Whittlesey, 2005), and a tree connects the cones and the borders with it
/// (section 3.3 of Springborn, Schroeder and Pinkall, 2008).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_CUT_GRAPH_H
#define CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_CUT_GRAPH_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Cut_graph.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Layout/Cut_finder.h>
#include <CGAL/Conformal_equivalence/internal/Layout/Seam_conditions.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceLayout
///
/// finds edges along which `input` is to be cut so that every component becomes a disk with all cones
/// on its border: it has Euler characteristic 1 and one border, and can be laid out once its metric is flat
/// except at the cones.
///
/// In every component of genus g > 0, first a *system of loops* is found: 2g loops with a common base, the shortest ones
/// for this base, by the greedy algorithm of Erickson and Whittlesey (2005), a tree of shortest paths from the base and
/// a maximum spanning tree of the dual graph that does not cross it. The base is a border if there is
/// one (that of the first border vertex; loops then begin and end anywhere on it), else the cone with the smallest index, else the vertex
/// with the smallest index; in the last case, where nothing requires the base to be on the cut, it moves to the nearest
/// vertex where the loops part. Then a *cone spanning tree* connects cones, borders and the system of loops, of which each border and the
/// system count as one node (section 3.3 of Springborn, Schroeder and Pinkall, 2008). It is a minimum spanning tree for
/// the distances between these nodes, at most twice as long as the shortest tree there is.
///
/// The cut ends nowhere but at cones and borders, and none of its paths can be left out. This does not hold
/// for edges that are prescribed by `edge_is_seam_map`: they are cut as they are, and each of the pieces that they leave is treated as
/// a component.
///
/// O(n log n), plus the length of the loops.
///
/// \tparam NT number type of the lengths
/// \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
///
/// \param input a surface of any topology, with any number of components; isolated vertices are ignored
/// \param cones the vertices that must come to lie on the border, by index. Cones on a border or a prescribed seam lie there
///        already; one that is listed twice counts once.
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below.
///        Keys are indices of edges of `input`.
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{seam_weight_map}
///     \cgalParamDescription{what it costs to cut an edge: finite and not negative. Seams prefer edges of small weight.}
///     \cgalParamType{a readable property map with key type `std::uint32_t` and a value type convertible to `NT`}
///     \cgalParamDefault{the lengths}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_is_seam_map}
///     \cgalParamDescription{`true` for edges that are cut in any case. Border edges are ignored.}
///     \cgalParamType{a readable property map with key type `std::uint32_t` and value type `bool`}
///     \cgalParamDefault{`false` for all edges}
///     \cgalParamExtra{Not written; the result holds all edges that are cut.}
///   \cgalParamNEnd
///   \cgalParamNBegin{edge_is_constrained_map}
///     \cgalParamDescription{`true` for edges that must not be cut. Paths may cross them at a vertex. Border edges are ignored.}
///     \cgalParamType{a readable property map with key type `std::uint32_t` and value type `bool`}
///     \cgalParamDefault{`false` for all edges}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the edges to cut, prescribed ones included, and the system of loops. `Cut_graph::is_cut` is empty unless the status is `OK`. It is
///         - `EMPTY_MESH` if there is no face;
///         - `INVALID_NUMBER` if `Cut_graph::edges` have a weight that is negative or not finite;
///         - `WRONG_TOPOLOGY` with edges if these are prescribed as well as constrained; or if no cut can do without
///           constrained edges, `Cut_graph::edges` being those that are in the way of the best one;
///         - `WRONG_TOPOLOGY` with faces if they lie on spheres with fewer than two cones. Nothing of such a sphere could be
///           cut that ends at cones; with one cone or none there is no flat metric on it either (Gauss-Bonnet).
///           A prescribed edge makes it a disk.
///
/// \pre `cones` are less than `input.number_of_vertices()`; no vertex is in `non_manifold_vertices(input)`.
/// \sa `CGAL::Conformal_equivalence::compute_layout()`
/// \sa `CGAL::Conformal_equivalence::make_seam_mesh()`
template <typename NT, typename NamedParameters = parameters::Default_named_parameters>
Cut_graph compute_cut_graph(const Intrinsic_triangulation<NT>& input,
                            const std::vector<std::uint32_t>& cones,
                            const NamedParameters& np = parameters::default_values())
{
  if(input.number_of_faces() == 0)
    return internal::failed_cut(Status::EMPTY_MESH, {}, {});
  internal::Seam_conditions<NT> conditions = internal::read_seam_conditions(input, np);
  if(conditions.prescribed.status != Status::OK)
    return internal::failed_cut(conditions.prescribed.status, conditions.prescribed.edges, {});
  return internal::find_cut(input, cones, std::move(conditions));
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_COMPUTE_CUT_GRAPH_H
