// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Conformal_equivalence_parameterizer_3.h
/// The door for applications that call \cgal's `parameterize()`: a model of
/// `Parameterizer_3` for discrete conformal equivalence (Springborn, Schroeder and
/// Pinkall, 2008).

#ifndef CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_EQUIVALENCE_PARAMETERIZER_3_H
#define CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_EQUIVALENCE_PARAMETERIZER_3_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/internal/Doors/parameters_of_doors.h>
#include <CGAL/Conformal_equivalence/make_seam_mesh.h>

#include <CGAL/Default.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Surface_mesh_parameterization/Error_code.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <boost/property_map/property_map.hpp>

#include <cstdint>
#include <functional>
#include <iterator>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// What the parameterizer has to know of a mesh: any mesh is its own underlying mesh, without seams.
template <typename TriangleMesh>
struct Seams_of
{
  typedef TriangleMesh Underlying_mesh;
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  static constexpr Status no_disk = Status::WRONG_TOPOLOGY;

  static const Underlying_mesh& underlying_mesh(const TriangleMesh& tm) { return tm; }
  static bool is_seam(const TriangleMesh&, typename Graph_traits::edge_descriptor) { return false; }
  static typename Graph_traits::vertex_descriptor
  corner(const TriangleMesh& tm, typename Graph_traits::halfedge_descriptor h) { return target(h, tm); }
};

template <typename TriangleMesh, typename EdgeIsSeamMap, typename VertexIsOnSeamMap>
struct Seams_of<CGAL::Seam_mesh<TriangleMesh, EdgeIsSeamMap, VertexIsOnSeamMap> >
{
  typedef CGAL::Seam_mesh<TriangleMesh, EdgeIsSeamMap, VertexIsOnSeamMap> Seam_mesh;
  typedef TriangleMesh Underlying_mesh;
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  static constexpr Status no_disk = Status::SEAM_LEAVES_NO_DISK;

  static const Underlying_mesh& underlying_mesh(const Seam_mesh& sm) { return sm.mesh(); }
  static bool is_seam(const Seam_mesh& sm, typename Graph_traits::edge_descriptor e) { return sm.has_on_seam(e); }
  static typename boost::graph_traits<Seam_mesh>::vertex_descriptor
  corner(const Seam_mesh& sm, typename Graph_traits::halfedge_descriptor h)
  {
    return target(typename boost::graph_traits<Seam_mesh>::halfedge_descriptor(h), sm);
  }
};

// The faces of the connected component of `f`, in the order of faces(tm).
template <typename TriangleMesh>
std::vector<typename boost::graph_traits<TriangleMesh>::face_descriptor>
faces_of_component(typename boost::graph_traits<TriangleMesh>::face_descriptor f, const TriangleMesh& tm)
{
  typedef typename boost::graph_traits<TriangleMesh>::face_descriptor face_descriptor;
  std::vector<face_descriptor> found, component;
  Polygon_mesh_processing::connected_component(f, tm, std::back_inserter(found));
  auto is_found = get(CGAL::dynamic_face_property_t<bool>(), tm);
  for(face_descriptor g : CGAL::make_range(faces(tm)))
    put(is_found, g, false);
  for(face_descriptor g : found)
    put(is_found, g, true);
  for(face_descriptor g : CGAL::make_range(faces(tm)))
    if(get(is_found, g))
      component.push_back(g);
  return component;
}

// The face at a halfedge of the border; the null face if there is none.
template <typename TriangleMesh>
typename boost::graph_traits<TriangleMesh>::face_descriptor
face_at_border(typename boost::graph_traits<TriangleMesh>::halfedge_descriptor bhd, const TriangleMesh& tm)
{
  typedef boost::graph_traits<TriangleMesh> Graph_traits;
  return bhd == Graph_traits::null_halfedge() ? Graph_traits::null_face() : face(opposite(bhd, tm), tm);
}

} // namespace internal
} // namespace Conformal_equivalence

namespace Surface_mesh_parameterization {

/// \ingroup PkgConformalEquivalenceDoors
///
/// Flattens a topological disk, or a surface cut open to a disk by a `Seam_mesh`, discretely conformally, through \cgal's own
/// `parameterize()`.
///
/// Without parameters the border is natural: it keeps its lengths (u = 0), which is the least
/// distorted of all conformally equivalent flat metrics. The result is exact in the sense of the
/// method: length cross ratios are preserved to rounding, and no triangle is flipped.
///
/// A `Seam_mesh` says where to cut, not what the conditions are: the metric is solved on the connected component of the underlying
/// mesh, with the user's cones, and laid out along the given seam. The two sides of the seam then have equal lengths
/// (section 3.3 of the paper). All maps given to the constructor, and the report, speak of the underlying mesh.
/// With the named parameter `seam_is_border` the surface that is cut open is solved instead, with the seam as border: for the natural
/// border, u = 0 on it.
///
/// `parameterize()` takes the parameterizer by value: everything that comes back, comes through
/// the maps and the report given to the constructor. This header overloads it for this parameterizer, without preconditions
/// on the mesh: a mesh without a border, for which `Polygon_mesh_processing::longest_border()` has no halfedge, is refused
/// like every other surface that is no disk.
///
/// Do not confuse it with `Discrete_conformal_map_parameterizer_3`, which is the
/// discretely harmonic map to a fixed border.
///
/// \tparam TriangleMesh_ a model of `FaceListGraph`; a `Seam_mesh` is cut open along its seam.
/// \tparam SolverTraits_ a model of `SparseLinearAlgebraWithFactorTraits_d`; the default is
///         `Conformal_equivalence::Default_solver_traits`.
///
/// \cgalModels{Parameterizer_3}
template <typename TriangleMesh_, typename SolverTraits_ = Default>
class Conformal_equivalence_parameterizer_3
{
  typedef Conformal_equivalence::internal::Seams_of<TriangleMesh_> Seams;

public:
  typedef TriangleMesh_ Triangle_mesh; ///< type of the mesh
  typedef TriangleMesh_ TriangleMesh;  ///< type of the mesh, under the name of the concept

#ifdef DOXYGEN_RUNNING
  typedef unspecified_type Underlying_mesh; ///< the mesh that a `Seam_mesh` cuts open; `TriangleMesh` itself otherwise
#else
  typedef typename Seams::Underlying_mesh Underlying_mesh;
#endif

  /// the linear solver
  typedef typename Default::Get<SolverTraits_, Conformal_equivalence::Default_solver_traits>::type Solver_traits;
  typedef Conformal_equivalence::Flattening_report<Underlying_mesh> Report; ///< what `flattening_report` receives

  typedef typename boost::graph_traits<Triangle_mesh>::vertex_descriptor   vertex_descriptor;   ///< of the mesh
  typedef typename boost::graph_traits<Triangle_mesh>::halfedge_descriptor halfedge_descriptor; ///< of the mesh
  typedef typename boost::graph_traits<Triangle_mesh>::edge_descriptor     edge_descriptor;     ///< of the mesh
  typedef typename boost::graph_traits<Triangle_mesh>::face_descriptor     face_descriptor;     ///< of the mesh

  /// natural border, no cones, nothing but coordinates comes back.
  Conformal_equivalence_parameterizer_3()
    : Conformal_equivalence_parameterizer_3(parameters::default_values())
  {}

  /// takes the named parameters of `Conformal_equivalence::flatten()`, with maps of the underlying mesh, which are kept
  /// by value, but those about cutting, charts and refinements (the seam is that of the mesh). And one more:
  ///
  /// \cgalNamedParamsBegin
  ///   \cgalParamNBegin{seam_is_border}
  ///     \cgalParamDescription{whether the metric is solved on the surface that is cut open, with the seam as border; conditions at a vertex on the seam then hold for all its copies}
  ///     \cgalParamType{`bool`}
  ///     \cgalParamDefault{`false`}
  ///     \cgalParamExtra{What is then written at a vertex on the seam is what was found for one of its copies. `Conformal_equivalence::flatten()`, called with the `Seam_mesh`, takes and returns values for each copy.}
  ///   \cgalParamNEnd
  /// \cgalNamedParamsEnd
  template <typename CGAL_NP_TEMPLATE_PARAMETERS>
  explicit Conformal_equivalence_parameterizer_3(const CGAL_NP_CLASS& np)
    : seam_is_border_(parameters::choose_parameter(parameters::get_parameter(np, internal_np::conformal_seam_is_border), false)),
      flatten_([np](Flattening& flattening, Conformal_equivalence::Cut_graph cut, std::uint32_t face)
      {
        flattening.run_along(std::move(cut), face, Seams::no_disk,
                             Conformal_equivalence::combine_named_parameters(np, parameters::sparse_linear_solver(Solver_traits())));
        if(bool(flattening.report))
          Conformal_equivalence::internal::write_metric(flattening, np);
        Conformal_equivalence::internal::write_report(flattening.report, np);
      }),
      refuse_([np](const Report& report) { Conformal_equivalence::internal::write_report(report, np); })
  {
    static_assert(Conformal_equivalence::internal::Check_pack<Conformal_equivalence::internal::Parameters_of_parameterizer,
                                                              Underlying_mesh, CGAL_NP_CLASS>::value);
  }

  /// flattens the connected component of `bhd`. The maps are written iff `OK` is returned. The index
  /// map is not used: the package has indices of its own.
  ///
  /// \param tm a triangle mesh
  /// \param bhd a halfedge of the border of a topological disk, which may be one that is cut open; `null_halfedge()` is refused
  ///        (`WRONG_TOPOLOGY`, with the topology of the mesh)
  /// \param uvmap receives the coordinates of the vertices of the component
  /// \param vpmap receives `true` at every vertex of the component
  ///
  /// \return `to_error_code()` of the status that the report says: one of `flatten()`, or `WRONG_TOPOLOGY` (the component is no disk),
  ///         `SEAM_LEAVES_NO_DISK` (edges: cut along this seam, it is no disk), `SEAM_MISSES_CONE` (vertices: cones that are not on
  ///         the seam, or on the border if there is no seam).
  template <typename VertexUVMap, typename VertexIndexMap, typename VertexParameterizedMap>
  Error_code parameterize(const Triangle_mesh& tm,
                          halfedge_descriptor bhd,
                          VertexUVMap uvmap,
                          VertexIndexMap /* vimap */,
                          VertexParameterizedMap vpmap)
  {
    typedef typename boost::property_traits<VertexUVMap>::value_type Point_2;
    const face_descriptor f = Conformal_equivalence::internal::face_at_border(bhd, tm);
    if(f == boost::graph_traits<Triangle_mesh>::null_face())
      return refuse_without_border(tm);
    const Conformal_equivalence::internal::Stopwatch stopwatch;
    Flattening flattening(seam_is_border_ ? import_cut_open(f, tm) : import_whole(f, tm), stopwatch);
    const std::uint32_t index_of_f = flattening.mesh.index_of_face(f);
    flatten_(flattening, seam(flattening.mesh, tm), index_of_f);
    if(!bool(flattening.report))
      return Conformal_equivalence::to_error_code(flattening.report.status);

    for(face_descriptor g : Conformal_equivalence::internal::faces_of_component(f, tm))
    {
      const std::uint32_t first = 3 * flattening.mesh.index_of_face(g);
      for(std::uint32_t h = first; h < first + 3; ++h)
      {
        const vertex_descriptor v = Seams::corner(tm, flattening.mesh.halfedge(h));
        put(uvmap, v, Point_2(flattening.layout.corner[h][0], flattening.layout.corner[h][1]));
        put(vpmap, v, true);
      }
    }
    return Conformal_equivalence::to_error_code(flattening.report.status);
  }

private:
  typedef Conformal_equivalence::internal::Flattening<Underlying_mesh> Flattening;
  typedef Conformal_equivalence::Imported_mesh<Underlying_mesh> Imported_mesh;

  Error_code refuse_without_border(const Triangle_mesh& tm) const
  {
    Report report = Conformal_equivalence::internal::import_report(Imported_mesh(Seams::underlying_mesh(tm)));
    if(bool(report))
      report.status = Conformal_equivalence::Status::WRONG_TOPOLOGY;
    refuse_(report);
    return Conformal_equivalence::to_error_code(report.status);
  }

  static Imported_mesh import_whole(face_descriptor f, const Triangle_mesh& tm)
  {
    const Underlying_mesh& underlying = Seams::underlying_mesh(tm);
    return Imported_mesh(underlying, Conformal_equivalence::internal::faces_of_component(f, underlying));
  }

  static Imported_mesh import_cut_open(face_descriptor f, const Triangle_mesh& tm)
  {
    return Imported_mesh(Seams::underlying_mesh(tm), Conformal_equivalence::internal::faces_of_component(f, tm),
                         [&](typename boost::graph_traits<Underlying_mesh>::edge_descriptor e) { return Seams::is_seam(tm, e); });
  }

  // The edges of the seam that are not border edges already.
  static Conformal_equivalence::Cut_graph seam(const Imported_mesh& mesh, const Triangle_mesh& tm)
  {
    const Conformal_equivalence::Intrinsic_triangulation<double>& t = mesh.triangulation;
    Conformal_equivalence::Cut_graph result;
    for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
    {
      if(t.is_border_edge(e) || !Seams::is_seam(tm, mesh.edge(e)))
        continue;
      result.is_cut.resize(t.number_of_edges(), 0);
      result.is_cut[e] = 1;
    }
    return result;
  }

  bool seam_is_border_;

  // the maps of the named parameters, whose types the class does not know
  std::function<void(Flattening&, Conformal_equivalence::Cut_graph, std::uint32_t)> flatten_;
  std::function<void(const Report&)> refuse_;
};

/// \ingroup PkgConformalEquivalenceDoors
///
/// does what \cgal's `parameterize()` does with this parameterizer, but for its preconditions: a halfedge that is null, as
/// `Polygon_mesh_processing::longest_border()` returns it for a closed mesh, is an error like others.
///
/// \param mesh a triangle mesh
/// \param parameterizer says what the conditions are, and where results other than coordinates go
/// \param bhd a halfedge of the border
/// \param uvmap receives the coordinates of the vertices of the component of `bhd`
///
/// \return what `Conformal_equivalence_parameterizer_3::parameterize()` returns
template <typename Mesh, typename TriangleMesh, typename SolverTraits, typename HD, typename VertexUVMap>
Error_code parameterize(Mesh& mesh, Conformal_equivalence_parameterizer_3<TriangleMesh, SolverTraits> parameterizer, HD bhd, VertexUVMap uvmap)
{
  const TriangleMesh& tm = mesh;
  const auto is_parameterized = get(CGAL::dynamic_vertex_property_t<bool>(), tm);
  return parameterizer.parameterize(tm, bhd, uvmap, boost::dummy_property_map(), is_parameterized);
}

} // namespace Surface_mesh_parameterization
} // namespace CGAL

#endif // CGAL_SURFACE_MESH_PARAMETERIZATION_CONFORMAL_EQUIVALENCE_PARAMETERIZER_3_H
