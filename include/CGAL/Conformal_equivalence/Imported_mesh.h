// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file Imported_mesh.h
/// From a mesh of \cgal to flat arrays and back. Only what includes this header
/// knows of meshes; the mesh is never modified.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_IMPORTED_MESH_H
#define CGAL_CONFORMAL_EQUIVALENCE_IMPORTED_MESH_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Conformal_metric.h>
#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Outcome.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/internal/Triangulation/wedges.h>
#include <CGAL/Conformal_equivalence/internal/parameter_readers.h>
#include <CGAL/Conformal_equivalence/mollify.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>

#include <CGAL/boost/graph/helpers.h>
#include <CGAL/boost/graph/iterator.h>
#include <CGAL/boost/graph/named_params_helper.h>
#include <CGAL/boost/graph/properties.h>
#include <CGAL/number_utils.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

namespace internal {

// The global functions by which a mesh is walked, under names that no member of
// `Imported_mesh` hides.
template <typename Face, typename TriangleMesh>
auto first_halfedge(Face f, const TriangleMesh& tm) { return halfedge(f, tm); }

template <typename Edge, typename TriangleMesh>
auto halfedge_of_edge(Edge e, const TriangleMesh& tm) { return halfedge(e, tm); }

template <typename Halfedge, typename TriangleMesh>
auto edge_of_halfedge(Halfedge h, const TriangleMesh& tm) { return edge(h, tm); }

template <typename Halfedge, typename TriangleMesh>
auto face_of_halfedge(Halfedge h, const TriangleMesh& tm) { return face(h, tm); }

} // namespace internal

/// \ingroup PkgConformalEquivalenceMetric
///
/// The triangulation of a mesh with its edge lengths, and the correspondence of
/// indices and descriptors. Vertices and faces are numbered in the order of
/// `vertices(tm)` and `faces(tm)`; halfedge `3f + k` is the `k`-th after
/// `halfedge(face(f), tm)`.
///
/// Keeps a reference to the mesh, whose elements must not change meanwhile.
///
/// \tparam TriangleMesh a model of `FaceListGraph`, such as `Surface_mesh`, `Polyhedron_3`, `Seam_mesh`
///         or `Face_filtered_graph`
/// \tparam NT number type of the lengths
template <typename TriangleMesh, typename NT_ = double>
class Imported_mesh
{
public:
  typedef TriangleMesh Triangle_mesh; ///< type of the mesh
  typedef NT_ NT;                     ///< number type of the lengths
  typedef std::uint32_t Index;        ///< of vertices, halfedges, edges and faces
  typedef typename boost::graph_traits<TriangleMesh>::vertex_descriptor   vertex_descriptor;   ///< of the mesh
  typedef typename boost::graph_traits<TriangleMesh>::halfedge_descriptor halfedge_descriptor; ///< of the mesh
  typedef typename boost::graph_traits<TriangleMesh>::edge_descriptor     edge_descriptor;     ///< of the mesh
  typedef typename boost::graph_traits<TriangleMesh>::face_descriptor     face_descriptor;     ///< of the mesh

  /// imports the triangulation of all of `tm`, with all lengths 1. Linear time.
  explicit Imported_mesh(const TriangleMesh& tm) : Imported_mesh(tm, faces(tm)) {}

  /// imports the faces in `face_range` only. The vertices keep their numbers in `vertices(tm)`; those
  /// of no imported face become isolated. Linear time.
  template <typename FaceRange>
  Imported_mesh(const TriangleMesh& tm, const FaceRange& face_range)
    : mesh_(&tm),
      vertex_index_(get(Vertex_index_tag(), tm)),
      face_index_(get(Face_index_tag(), tm))
  {
    number_elements(face_range);
    if(status == Status::OK)
      glue([](edge_descriptor) { return false; });
    if(status == Status::OK)
      refuse_non_manifold_vertices();
  }

  /// imports the faces in `face_range`, cut open along the edges `e` for which `is_cut(e)` is `true`: these
  /// become border edges. A vertex whose triangles then form several fans becomes as many vertices; the first of them keeps its number
  /// in `vertices(tm)`, the others are numbered after all vertices of the mesh. (So no vertex is refused as
  /// not manifold.) Linear time.
  template <typename FaceRange, typename IsCut>
  Imported_mesh(const TriangleMesh& tm, const FaceRange& face_range, const IsCut& is_cut)
    : mesh_(&tm),
      vertex_index_(get(Vertex_index_tag(), tm)),
      face_index_(get(Face_index_tag(), tm))
  {
    number_elements(face_range);
    if(status != Status::OK)
      return;
    glue(is_cut);
    split_vertices();
  }

  /// the mesh that was imported.
  const TriangleMesh& mesh() const { return *mesh_; }

  /// the surface; meaningful iff `status` is `OK`.
  Intrinsic_triangulation<NT> triangulation;

  /// \name Result of the import
  /// `OK`, `EMPTY_MESH`, `NOT_TRIANGULATED` (faces), `NON_MANIFOLD` (vertices); and from
  /// `import_mesh()`: `INVALID_NUMBER` (vertices or edges), `ZERO_LENGTH_EDGE` (edges).
  /// Faces that are no triangles are named by their position in `faces(tm)`.
  /// @{
  Status status = Status::OK;          ///< whether the mesh could be imported, or why not
  std::vector<Index> faulty_vertices;  ///< vertices at fault
  std::vector<Index> faulty_edges;     ///< edges at fault
  std::vector<Index> faulty_faces;     ///< faces at fault
  /// @}

  /// \name Indices to descriptors
  /// @{

  /// the vertex number `v`; the same for all copies of a vertex that was split
  vertex_descriptor vertex(Index v) const { return vertices_[v]; }

  /// the face number `f`
  face_descriptor face(Index f) const { return faces_[f]; }

  /// the halfedge number `h`
  halfedge_descriptor halfedge(Index h) const
  {
    halfedge_descriptor result = internal::first_halfedge(faces_[h / 3], *mesh_);
    for(Index k = 0; k < h % 3; ++k)
      result = next(result, *mesh_);
    return result;
  }

  /// the edge number `e`
  edge_descriptor edge(Index e) const
  {
    return internal::edge_of_halfedge(halfedge(triangulation.edge_halfedge(e)), *mesh_);
  }
  /// @}

  /// \name Descriptors to indices
  /// @{

  /// the number of `v`, which is its position in `vertices(tm)`
  Index index_of_vertex(vertex_descriptor v) const { return get(vertex_index_, v); }

  /// the number of `f`; `Intrinsic_triangulation::null_index` if `f` was not imported
  Index index_of_face(face_descriptor f) const { return get(face_index_, f); }

  /// the number of `h`. \pre `h` has an imported face on its left
  Index index_of_halfedge(halfedge_descriptor h) const
  {
    const face_descriptor f = internal::face_of_halfedge(h, *mesh_);
    Index result = triangulation.halfedge(get(face_index_, f));
    for(halfedge_descriptor i = internal::first_halfedge(f, *mesh_); i != h; i = next(i, *mesh_))
      ++result;
    return result;
  }

  /// the position in `faces(tm)` of the face with index `f`: `f` itself if all faces were imported.
  Index position_of_face(Index f) const { return face_positions_[f]; }

  /// returns `true` iff there is an imported face on the left of `h`.
  bool is_imported(halfedge_descriptor h) const
  {
    const face_descriptor f = internal::face_of_halfedge(h, *mesh_);
    return f != boost::graph_traits<TriangleMesh>::null_face()
        && get(face_index_, f) != Intrinsic_triangulation<NT>::null_index;
  }

  /// the number of `e`; of the side of `halfedge(e, tm)` if `e` was cut. \pre a face at `e` was imported
  Index index_of_edge(edge_descriptor e) const
  {
    const halfedge_descriptor h = internal::halfedge_of_edge(e, *mesh_);
    return triangulation.edge(index_of_halfedge(is_imported(h) ? h : opposite(h, *mesh_)));
  }
  /// @}

private:
  typedef CGAL::dynamic_vertex_property_t<Index> Vertex_index_tag;
  typedef CGAL::dynamic_face_property_t<Index>   Face_index_tag;

  // Numbers vertices and faces and refuses faces that are no triangles.
  template <typename FaceRange>
  void number_elements(const FaceRange& face_range)
  {
    for(vertex_descriptor v : CGAL::make_range(vertices(*mesh_)))
    {
      put(vertex_index_, v, Index(vertices_.size()));
      vertices_.push_back(v);
    }
    for(face_descriptor f : CGAL::make_range(faces(*mesh_)))
      put(face_index_, f, Intrinsic_triangulation<NT>::null_index);
    for(face_descriptor f : face_range)
    {
      put(face_index_, f, Index(faces_.size()));
      if(!is_triangle(internal::first_halfedge(f, *mesh_), *mesh_))
        faulty_faces.push_back(Index(faces_.size()));
      faces_.push_back(f);
    }
    face_positions_.resize(faces_.size());
    Index position = 0;
    for(face_descriptor f : CGAL::make_range(faces(*mesh_)))
    {
      const Index i = get(face_index_, f);
      if(i != Intrinsic_triangulation<NT>::null_index)
        face_positions_[i] = position;
      ++position;
    }
    if(faces_.empty())
      status = Status::EMPTY_MESH;
    else if(!faulty_faces.empty())
      status = Status::NOT_TRIANGULATED;
  }

  template <typename IsCut>
  void glue(const IsCut& is_cut)
  {
    std::vector<Index> origin, twin;
    origin.reserve(3 * faces_.size());
    twin.reserve(3 * faces_.size());
    for(face_descriptor f : faces_)
    {
      halfedge_descriptor h = internal::first_halfedge(f, *mesh_);
      for(int k = 0; k < 3; ++k, h = next(h, *mesh_))
      {
        const halfedge_descriptor opposite_h = opposite(h, *mesh_);
        const bool is_glued = is_imported(opposite_h) && !is_cut(internal::edge_of_halfedge(h, *mesh_));
        origin.push_back(get(vertex_index_, source(h, *mesh_)));
        twin.push_back(is_glued ? index_of_halfedge(opposite_h) : Intrinsic_triangulation<NT>::null_index);
      }
    }
    triangulation = Intrinsic_triangulation<NT>(Index(vertices_.size()), std::move(origin), std::move(twin));
  }

  void refuse_non_manifold_vertices()
  {
    faulty_vertices = non_manifold_vertices(triangulation);
    if(!faulty_vertices.empty())
      status = Status::NON_MANIFOLD;
  }

  // Makes each fan of triangles around a vertex a vertex of its own.
  void split_vertices()
  {
    const Index null_index = Intrinsic_triangulation<NT>::null_index;
    const internal::Wedges fans = internal::find_wedges(triangulation, internal::Nothing_is_cut());
    std::vector<Index> vertex_of_fan(fans.number_of_wedges, null_index), origin(triangulation.number_of_halfedges()),
                       twin(triangulation.number_of_halfedges());
    std::vector<char> has_fan(vertices_.size(), 0);
    for(Index h = 0; h < triangulation.number_of_halfedges(); ++h)
    {
      const Index v = triangulation.origin(h);
      Index& own = vertex_of_fan[fans.of_corner[triangulation.previous(h)]];
      if(own == null_index)
      {
        own = has_fan[v] ? Index(vertices_.size()) : v;
        if(has_fan[v])
          vertices_.push_back(vertex_descriptor(vertices_[v]));
        has_fan[v] = 1;
      }
      origin[h] = own;
      twin[h] = triangulation.twin(h);
    }
    triangulation = Intrinsic_triangulation<NT>(Index(vertices_.size()), std::move(origin), std::move(twin));
  }

  const TriangleMesh* mesh_;
  typename boost::property_map<TriangleMesh, Vertex_index_tag>::const_type vertex_index_;
  typename boost::property_map<TriangleMesh, Face_index_tag>::const_type face_index_;
  std::vector<vertex_descriptor> vertices_;
  std::vector<face_descriptor> faces_;
  std::vector<Index> face_positions_;
};

namespace internal {

// The length of the vector (x, y, z), without over- or underflow.
inline double vector_length(double x, double y, double z)
{
  const double square = x * x + y * y + z * z;
  if(square > 1e-280 && square < 1e280)
    return std::sqrt(square);
  const double largest = (std::max)((std::max)(std::abs(x), std::abs(y)), std::abs(z));
  if(!(largest > 0) || !std::isfinite(largest))
    return square; // zero, infinite, or no number
  x /= largest;
  y /= largest;
  z /= largest;
  return largest * std::sqrt(x * x + y * y + z * z);
}

// The distance of two points, in `NT`; beyond `double`, coordinates are not rounded first if they need not be.
template <typename NT = double, typename Point>
NT distance(const Point& p, const Point& q)
{
  if constexpr(std::is_same<NT, double>::value)
    return vector_length(CGAL::to_double(q.x() - p.x()), CGAL::to_double(q.y() - p.y()), CGAL::to_double(q.z() - p.z()));
  else
  {
    using std::sqrt;
    const auto number = [](const auto& x)
    {
      if constexpr(std::is_constructible<NT, decltype(x)>::value)
        return NT(x);
      else
        return NT(CGAL::to_double(x));
    };
    const NT x = number(q.x()) - number(p.x()), y = number(q.y()) - number(p.y()), z = number(q.z()) - number(p.z());
    return NT(sqrt(NT(x * x + y * y + z * z)));
  }
}

template <typename Point>
bool is_finite_point(const Point& p)
{
  return std::isfinite(CGAL::to_double(p.x())) && std::isfinite(CGAL::to_double(p.y())) && std::isfinite(CGAL::to_double(p.z()));
}

template <typename TriangleMesh, typename NT, typename EdgeLengthMap>
void set_lengths_from_map(Imported_mesh<TriangleMesh, NT>& mesh, EdgeLengthMap length_map)
{
  for(std::uint32_t e = 0; e < mesh.triangulation.number_of_edges(); ++e)
    mesh.triangulation.set_length(e, NT(get(length_map, mesh.edge(e))));
}

template <typename TriangleMesh, typename NT, typename VertexPointMap>
void set_lengths_from_points(Imported_mesh<TriangleMesh, NT>& mesh, VertexPointMap vpm)
{
  Intrinsic_triangulation<NT>& t = mesh.triangulation;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v) && !is_finite_point(get(vpm, mesh.vertex(v))))
      mesh.faulty_vertices.push_back(v);
  if(!mesh.faulty_vertices.empty())
  {
    mesh.status = Status::INVALID_NUMBER;
    return;
  }
  for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
  {
    const std::uint32_t h = t.edge_halfedge(e);
    t.set_length(e, NT(distance<NT>(get(vpm, mesh.vertex(t.origin(h))), get(vpm, mesh.vertex(t.target(h))))));
  }
}

// Refuses lengths that are not finite, negative, or zero.
template <typename TriangleMesh, typename NT>
void check_lengths(Imported_mesh<TriangleMesh, NT>& mesh)
{
  std::vector<std::uint32_t> zero;
  for(std::uint32_t e = 0; e < mesh.triangulation.number_of_edges(); ++e)
  {
    const NT& l = mesh.triangulation.length(e);
    if(l == NT(0))
      zero.push_back(e);
    else if(!(l > NT(0)) || !(l - l == NT(0)))
      mesh.faulty_edges.push_back(e);
  }
  if(!mesh.faulty_edges.empty())
    mesh.status = Status::INVALID_NUMBER;
  else if(!zero.empty())
  {
    mesh.status = Status::ZERO_LENGTH_EDGE;
    mesh.faulty_edges = std::move(zero);
  }
}

template <typename TriangleMesh, typename NT, typename NamedParameters>
void set_lengths(Imported_mesh<TriangleMesh, NT>& mesh, const NamedParameters& np)
{
  using parameters::choose_parameter;
  using parameters::get_parameter;
  if(mesh.status != Status::OK)
    return;
  if constexpr(!internal::is_given<internal_np::conformal_edge_length_t, NamedParameters>)
    set_lengths_from_points(mesh, choose_parameter(get_parameter(np, internal_np::vertex_point),
                                                   get_const_property_map(vertex_point, mesh.mesh())));
  else
    set_lengths_from_map(mesh, get_parameter(np, internal_np::conformal_edge_length));
  const double slack = choose_parameter(get_parameter(np, internal_np::conformal_mollification), 0.);
  if(mesh.status == Status::OK && slack > 0)
    mesh.triangulation = mollify(std::move(mesh.triangulation), slack).triangulation; // as it is if lengths are invalid
  if(mesh.status == Status::OK)
    check_lengths(mesh);
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceMetric
///
/// imports the triangulation and the edge lengths of `tm`. Linear time.
///
/// \tparam NT number type of the lengths
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
///
/// \param tm a mesh, all of whose faces should be triangles
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{edge_length_map}
///     \cgalParamDescription{the lengths of the edges; no point is looked at if they are given}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%edge_descriptor` and a value type convertible to `NT`}
///     \cgalParamDefault{the distances of the points}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_point_map}
///     \cgalParamDescription{the points of the vertices}
///     \cgalParamType{a readable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a three-dimensional point type}
///     \cgalParamDefault{`boost::get(CGAL::vertex_point, tm)`}
///   \cgalParamNEnd
///   \cgalParamNBegin{mollification}
///     \cgalParamDescription{the slack of all triangle inequalities, relative to the mean length, that is reached by adding a constant to all lengths, see `mollify()`}
///     \cgalParamType{`double`}
///     \cgalParamDefault{`0`: lengths are taken as they are, and lengths of zero refused}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the mesh as arrays, with its `status` and the elements at fault: `EMPTY_MESH`, `NOT_TRIANGULATED`,
///         `NON_MANIFOLD`, `INVALID_NUMBER`, `ZERO_LENGTH_EDGE`. Lengths that violate the triangle
///         inequality are accepted here.
template <typename NT = double, typename TriangleMesh,
          typename NamedParameters = parameters::Default_named_parameters>
Imported_mesh<TriangleMesh, NT> import_mesh(const TriangleMesh& tm,
                                            const NamedParameters& np = parameters::default_values())
{
  Imported_mesh<TriangleMesh, NT> result(tm);
  internal::set_lengths(result, np);
  return result;
}

namespace internal {

// Names elements given by index.
template <typename TriangleMesh, typename NT>
void name_elements(const Imported_mesh<TriangleMesh, NT>& mesh, const std::vector<std::uint32_t>& vertices,
                   const std::vector<std::uint32_t>& edges, const std::vector<std::uint32_t>& faces,
                   Flattening_report<TriangleMesh>& report)
{
  for(std::uint32_t v : vertices)
  {
    report.vertices.push_back(mesh.vertex(v));
    report.vertex_indices.push_back(mesh.index_of_vertex(mesh.vertex(v)));
  }
  for(std::uint32_t e : edges)
  {
    const std::uint32_t h = mesh.triangulation.edge_halfedge(e);
    const auto position = [&](std::uint32_t v) { return mesh.index_of_vertex(mesh.vertex(v)); };
    report.edges.push_back(mesh.edge(e));
    report.edge_indices.push_back({{position(mesh.triangulation.origin(h)), position(mesh.triangulation.target(h))}});
  }
  for(std::uint32_t f : faces)
  {
    report.faces.push_back(mesh.face(f));
    report.face_indices.push_back(mesh.position_of_face(f));
  }
}

// The vertices of a surface among the ones given and those of faces of another triangulation of it, in increasing order. What is no vertex
// of the surface, but of its mirror image or new, has the larger numbers there.
template <typename NT>
std::vector<std::uint32_t> with_vertices_of_faces(const Intrinsic_triangulation<NT>& surface, std::vector<std::uint32_t> vertices,
                                                  const Intrinsic_triangulation<NT>& t, const std::vector<std::uint32_t>& faces)
{
  for(std::uint32_t f : faces)
    for(const std::uint32_t h : t.halfedges(f))
      vertices.push_back(t.origin(h));
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  vertices.erase(std::lower_bound(vertices.begin(), vertices.end(), surface.number_of_vertices()), vertices.end());
  return vertices;
}

// Tells what became of a computation on the triangulation of the mesh, with the elements at fault.
template <typename TriangleMesh, typename NT>
void report_outcome(const Imported_mesh<TriangleMesh, NT>& mesh, const Outcome& outcome, Flattening_report<TriangleMesh>& report)
{
  report.status = outcome.status;
  report.amount = outcome.amount;
  name_elements(mesh, outcome.vertices, outcome.edges, outcome.faces, report);
}

// The same for a computation that has changed the triangulation to `t`: faces are told by those of their vertices that the mesh has.
template <typename TriangleMesh, typename NT>
void report_outcome(const Imported_mesh<TriangleMesh, NT>& mesh, const Outcome& outcome, const Intrinsic_triangulation<NT>& t,
                    Flattening_report<TriangleMesh>& report)
{
  report.status = outcome.status;
  report.amount = outcome.amount;
  name_elements(mesh, with_vertices_of_faces(mesh.triangulation, outcome.vertices, t, outcome.faces), {}, {}, report);
}

// What the import of a mesh found.
template <typename TriangleMesh, typename NT>
Flattening_report<TriangleMesh> import_report(const Imported_mesh<TriangleMesh, NT>& mesh)
{
  Flattening_report<TriangleMesh> report;
  report.status = mesh.status;
  if(mesh.status == Status::OK)
    report.topology = surface_topology(mesh.triangulation, connected_components(mesh.triangulation));
  else
    name_elements(mesh, mesh.faulty_vertices, mesh.faulty_edges, mesh.faulty_faces, report);
  return report;
}

} // namespace internal

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_IMPORTED_MESH_H
