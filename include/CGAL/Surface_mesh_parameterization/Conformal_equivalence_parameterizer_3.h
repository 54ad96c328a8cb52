// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Conformal_equivalence_parameterizer_3.h
/// The door for applications that call \cgal's `parameterize()`: a model of
/// `Parameterizer_3` for discrete conformal equivalence (Springborn, Schroeder and
/// Pinkall, 2008).

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_EQUIVALENCE_PARAMETERIZER_3_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_EQUIVALENCE_PARAMETERIZER_3_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/flatten.h>

#include <CGAL/Default.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Surface_mesh_parameterization/Error_code.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>

#include <functional>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Surface_mesh_parameterization {

/// \ingroup PkgConformalEquivalenceDoors
///
/// Flattens a topological disk discretely conformally, through \cgal's own `parameterize()`.
///
/// Without parameters the border is natural: it keeps its lengths (u = 0), which is the least
/// distorted of all conformally equivalent flat metrics. The result is exact in the sense of the
/// method: length cross ratios are preserved to rounding, and no triangle is flipped.
///
/// `parameterize()` takes the parameterizer by value: everything that comes back, comes through
/// the maps and the report given to the constructor.
///
/// Do not confuse it with `Discrete_conformal_map_parameterizer_3`, which is the
/// discretely harmonic map to a fixed border.
///
/// \tparam TriangleMesh_ a model of `FaceListGraph`. A `Seam_mesh` is flattened as the surface that it is, cut open.
/// \tparam SolverTraits_ a model of `SparseLinearAlgebraWithFactorTraits_d`; the default is
///         `Conformal_equivalence::Default_solver_traits`.
///
/// \cgalModels{Parameterizer_3}
template <typename TriangleMesh_, typename SolverTraits_ = Default>
class Conformal_equivalence_parameterizer_3
{
public:
  typedef TriangleMesh_ Triangle_mesh; ///< type of the mesh
  typedef TriangleMesh_ TriangleMesh;  ///< type of the mesh, under the name of the concept

  /// the linear solver
  typedef typename Default::Get<SolverTraits_, Conformal_equivalence::Default_solver_traits>::type Solver_traits;
  typedef Conformal_equivalence::Flattening_report<Triangle_mesh> Report; ///< what `flattening_report` receives

  typedef typename boost::graph_traits<Triangle_mesh>::vertex_descriptor   vertex_descriptor;   ///< of the mesh
  typedef typename boost::graph_traits<Triangle_mesh>::halfedge_descriptor halfedge_descriptor; ///< of the mesh
  typedef typename boost::graph_traits<Triangle_mesh>::edge_descriptor     edge_descriptor;     ///< of the mesh
  typedef typename boost::graph_traits<Triangle_mesh>::face_descriptor     face_descriptor;     ///< of the mesh

  /// natural border, nothing but coordinates comes back.
  Conformal_equivalence_parameterizer_3()
    : Conformal_equivalence_parameterizer_3(parameters::default_values())
  {}

  /// takes every named parameter of `Conformal_equivalence::flatten()`. Maps are kept by value.
  template <typename CGAL_NP_TEMPLATE_PARAMETERS>
  explicit Conformal_equivalence_parameterizer_3(const CGAL_NP_CLASS& np)
    : flatten_([np](Flattening& flattening)
      {
        flattening.run(Conformal_equivalence::combine_named_parameters(
          np, parameters::sparse_linear_solver(Solver_traits())));
        if(bool(flattening.report))
          Conformal_equivalence::internal::write_metric(flattening, np);
        Conformal_equivalence::internal::write_report(flattening.report, np);
      })
  {}

  /// flattens the connected component of `bhd`. The maps are written iff `OK` is returned. The index
  /// map is not used: the package has indices of its own.
  ///
  /// \param tm a triangle mesh
  /// \param bhd a halfedge of the border of a topological disk
  /// \param uvmap receives the coordinates of the vertices of the component
  /// \param vpmap receives `true` at every vertex of the component
  ///
  /// \return `to_error_code()` of the status that the report says.
  template <typename VertexUVMap, typename VertexIndexMap, typename VertexParameterizedMap>
  Error_code parameterize(const Triangle_mesh& tm,
                          halfedge_descriptor bhd,
                          VertexUVMap uvmap,
                          VertexIndexMap /* vimap */,
                          VertexParameterizedMap vpmap)
  {
    typedef typename boost::property_traits<VertexUVMap>::value_type Point_2;
    Flattening flattening{Conformal_equivalence::Imported_mesh<Triangle_mesh>(tm, component_of(bhd, tm))};
    flatten_(flattening);
    if(bool(flattening.report))
    {
      const auto& t = flattening.mesh.triangulation;
      for(std::uint32_t h = 0; h < t.number_of_halfedges(); ++h)
      {
        const vertex_descriptor v = flattening.mesh.vertex(t.target(h));
        put(uvmap, v, Point_2(flattening.layout.corner[h][0], flattening.layout.corner[h][1]));
        put(vpmap, v, true);
      }
    }
    return Conformal_equivalence::to_error_code(flattening.report.status);
  }

private:
  typedef Conformal_equivalence::internal::Flattening<Triangle_mesh> Flattening;

  // The faces of the component of bhd, in the order of faces(tm).
  static std::vector<face_descriptor> component_of(halfedge_descriptor bhd, const Triangle_mesh& tm)
  {
    std::vector<face_descriptor> found, component;
    Polygon_mesh_processing::connected_component(face(opposite(bhd, tm), tm), tm, std::back_inserter(found));
    auto is_found = get(CGAL::dynamic_face_property_t<bool>(), tm);
    for(face_descriptor f : CGAL::make_range(faces(tm)))
      put(is_found, f, false);
    for(face_descriptor f : found)
      put(is_found, f, true);
    for(face_descriptor f : CGAL::make_range(faces(tm)))
      if(get(is_found, f))
        component.push_back(f);
    return component;
  }

  // the maps of the named parameters, whose types the class does not know
  std::function<void(Flattening&)> flatten_;
};

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_EQUIVALENCE_PARAMETERIZER_3_H
