// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file map_to_disk.h
/// A topological disk as the unit disk, with all border vertices on the circle (sections 4.2 and 4.3 of Springborn, Schroeder and Pinkall, 2008): one border
/// vertex is sent to infinity, the border becomes a straight line, and a Moebius transformation takes the half-plane to the disk. With flips
/// there is a map for every disk: one half of the map of its double to the sphere.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_MAP_TO_DISK_H
#define CGAL_CONFORMAL_EQUIVALENCE_MAP_TO_DISK_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Flattening_report.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/Common_refinement.h>
#include <CGAL/Conformal_equivalence/make_refined_mesh.h>
#include <CGAL/Conformal_equivalence/triangulate_refinement.h>
#include <CGAL/Conformal_equivalence/Surface_topology.h>
#include <CGAL/Conformal_equivalence/flatten.h>
#include <CGAL/Conformal_equivalence/internal/Doors/parameters_of_doors.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/plane_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/sphere_predicates.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Delaunay_flipper.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Surface_double.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/ideal_refinement.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Inscribed_mapping.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Moebius_centering.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/Conformal_equivalence/options.h>

#include <boost/graph/graph_traits.hpp>
#include <boost/property_map/property_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceEnums
/// How a map to the disk is chosen among those that differ by a Moebius transformation of the disk.
enum class Disk_frame
{
  BARYCENTRE ///< the barycentre of the vertices of the double on the sphere is its centre; the first border vertex lies at (1, 0)
};

/// \ingroup PkgConformalEquivalenceLayout
///
/// The frame in which an inner vertex lies in the centre, and the first border vertex at (1, 0): a value of the named parameter `disk_frame`.
/// \tparam Vertex a vertex descriptor
template <typename Vertex>
struct Centred_disk_frame
{
  Vertex centre; ///< a vertex that is not on the border
};

/// \ingroup PkgConformalEquivalenceLayout
///
/// The frame in which three border vertices lie at (1, 0), e^{2 pi i / 3} and e^{4 pi i / 3}: a value of the named parameter `disk_frame`.
/// \tparam Vertex a vertex descriptor
template <typename Vertex>
struct Three_point_disk_frame
{
  std::array<Vertex, 3> border; ///< different border vertices, in the order in which they follow each other with the surface on the left
};

namespace internal {

// The Moebius transformation of the disk of which the points are given by vectors with y = 0 on the circle and y > 0 inside.
template <typename Wide>
class Disk_normalization
{
  typedef std::uint32_t Index;
  typedef std::vector<Light_vector<Wide> > Vectors;

public:
  // `weights`: by vertex, those of the border half as large as they count on the double
  Disk_normalization(std::vector<double> weights, Index first_border_vertex) : weights_(std::move(weights)), first_(first_border_vertex) {}

  // Each of these returns whether there is such a transformation, and makes it.
  bool barycentre(Vectors& v) const { return Moebius_centering(weights_, true)(v) && turn(v, first_); }

  bool centre(Vectors& v, Index c) const
  {
    for(int round = 0; round < 40; ++round) // more than one for the digits, and where it is far
    {
      const Light_vector<double> p = rounded(v[c]);
      const double x = p[0] / p[3], z = p[2] / p[3], y = p[1] / p[3], size = std::hypot(x, z);
      if(!(size > 1e-16) || (round > 3 && size < 1e-14))
        break;
      // sinh of the distance from the axis of the disk, in the plane y = 0 of hyperbolic space above which the vertex lies
      const double rapidity = (std::min)(20., std::asinh(size / y)), scale = rapidity / size;
      transform(boost_matrix<Wide>({{ x * scale, 0, z * scale }}), v);
    }
    return turn(v, first_);
  }

  // The three vectors are linearly independent, and span the plane y = 0. In it, those of the three places, multiplied by factors so that products
  // are the same, are a basis, too: the linear map of one to the other is a Lorentz transformation.
  bool three_points(Vectors& v, const std::array<Index, 3>& border) const
  {
    using std::sqrt;
    std::array<std::array<Wide, 3>, 3> from, to;
    const std::array<Wide, 3> product = {{ -lorentz_product(v[border[1]], v[border[2]]), -lorentz_product(v[border[2]], v[border[0]]),
                                           -lorentz_product(v[border[0]], v[border[1]]) }};
    const Wide root = Wide(sqrt(Wide(3))) / 2, place = Wide(3) / 2; // minus the product of two of the three places
    const std::array<std::array<Wide, 2>, 3> uv = {{ {{ Wide(1), Wide(0) }}, {{ Wide(-0.5), root }}, {{ Wide(-0.5), -root }} }};
    for(std::size_t i = 0; i < 3; ++i)
    {
      // c_i c_j place = product_k
      const Wide c = sqrt(Wide(product[(i + 1) % 3] / place * (product[(i + 2) % 3] / product[i])));
      from[i] = {{ v[border[i]][0], v[border[i]][2], v[border[i]][3] }};
      to[i] = {{ c * uv[i][1], c * uv[i][0], c }};
    }
    const Wide all = determinant(from[0], from[1], from[2]);
    if(!(all * determinant(to[0], to[1], to[2]) > 0)) // two of them are the same, or in the wrong order
      return false;
    Lorentz_matrix<Wide> m = Lorentz_matrix<Wide>::identity();
    const std::array<std::size_t, 3> at = {{0, 2, 3}};
    for(std::size_t k = 0; k < 3; ++k) // the image of the k-th unit vector
    {
      std::array<Wide, 3> unit = {{Wide(0), Wide(0), Wide(0)}};
      unit[k] = Wide(1);
      const std::array<Wide, 3> b = {{ determinant(unit, from[1], from[2]) / all, determinant(from[0], unit, from[2]) / all,
                                       determinant(from[0], from[1], unit) / all }};
      for(std::size_t i = 0; i < 3; ++i)
        m.row[at[i]][at[k]] = b[0] * to[0][i] + b[1] * to[1][i] + b[2] * to[2][i];
    }
    transform(m, v);
    return turn(v, border[0]);
  }

private:
  // The point of the disk is (z, x) / (t + y). Turns the border vertex to (1, 0).
  static bool turn(Vectors& v, Index border)
  {
    using std::sqrt;
    const Wide x = v[border][0], z = v[border][2], size = Wide(sqrt(Wide(x * x + z * z)));
    if(!(size > 0))
      return false;
    const Wide c = z / size, s = x / size;
    Lorentz_matrix<Wide> m = Lorentz_matrix<Wide>::identity();
    m.row[0][0] = m.row[2][2] = c;
    m.row[0][2] = -s;
    m.row[2][0] = s;
    transform(m, v);
    return true;
  }

  std::vector<double> weights_;
  Index first_;
};

// ---- Points of the plane: stereographic projection from (0, -1, 0)

template <typename Wide>
Wide weight_in_disk(const Light_vector<Wide>& v)
{
  return v[3] + v[1];
}

template <typename Wide>
std::array<Wide, 2> disk_point(const Light_vector<Wide>& v)
{
  using std::sqrt;
  if(v[1] == Wide(0))
  {
    const Wide size = Wide(sqrt(Wide(v[2] * v[2] + v[0] * v[0])));
    if(v[3] - size < 1e-20 * v[3]) // on the circle, and no crossing on the axis: what rounding has done to t does not count
      return {{ v[2] / size, v[0] / size }};
  }
  return {{ v[2] / weight_in_disk(v), v[0] / weight_in_disk(v) }};
}

// One map to the disk: what the user gets is written by the caller.
template <typename TriangleMesh, typename NT>
struct Disk_mapping
{
  typedef std::uint32_t Index;
  typedef typename Ideal_polyhedron<NT>::Wide Wide;
  typedef std::array<Wide, 2> Wide_point;

  Imported_mesh<TriangleMesh, NT> mesh;
  Ideal_polyhedron<NT> polyhedron;             // of the surface, or, with flips, of its double
  std::vector<std::array<NT, 2> > points;      // by vertex of the mesh
  std::vector<Wide> weights;                   // e^{-u} in the disk, the same
  Common_refinement<NT> refinement;            // empty unless asked for
  std::vector<Light_vector<Wide> > refined_vectors; // by vertex of the refinement
  Flattening_report<TriangleMesh> report;

  explicit Disk_mapping(const TriangleMesh& tm) : mesh(tm) {}

  template <typename NamedParameters>
  void run(const NamedParameters& np, bool is_refined, bool is_always_made)
  {
    run_mapping(mesh, report, np, [](const Surface_topology& t) { return t.is_disk(); }, [&] { find(np); },
                [&] { judge(is_refined && (is_always_made || is_doubled(polyhedron))); });
  }

private:
  bool is_doubled(const Ideal_polyhedron<NT>& p) const { return p.triangulation.number_of_faces() != mesh.triangulation.number_of_faces(); }

  typedef std::vector<Light_vector<Wide> > Vectors;

  template <typename NamedParameters>
  void find(const NamedParameters& np)
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    const Index apex = given_apex(mesh, np);
    CGAL_precondition(apex == t.null_index || t.is_border_vertex(apex));
    if(!is_possible(given_frame(np)))
      return;
    twofold_ = std::make_unique<Surface_double<NT> >(t);
    if(is_polygon() && start_polygon(given_retriangulation(np)))
      return find_polygon(np);
    const Inscribed_mapping<NT, NamedParameters> mapping(t, twofold_->triangulation, np);
    polyhedron = mapping(apex, given_retriangulation(np), [&](Ideal_polyhedron<NT>& found)
    {
      normalize(found, np);
      return flipped_faces(found);
    });
    take_over(mesh, polyhedron, report);
    report.statistics.is_doubled = is_doubled(polyhedron);
  }

  // Are all vertices on the border?
  bool is_polygon() const
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      if(!t.is_isolated_vertex(v) && !t.is_border_vertex(v))
        return false;
    return true;
  }

  // The triangulation of a surface without inner vertices whose cross ratios are kept: that given, or the intrinsic Delaunay triangulation
  // of the double. Returns whether it has the border edges, so that it can be developed.
  bool start_polygon(Retriangulation retriangulation)
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    polyhedron.triangulation = t;
    if(retriangulation != Retriangulation::ALWAYS || t.number_of_faces() == 1)
      return true;
    Intrinsic_triangulation<NT> flipped = twofold_->triangulation;
    std::vector<Index> broken;
    if(!make_intrinsic_delaunay(flipped, broken, [&](Index e) { polyhedron.flips.push_back(e); }))
      return false; // refused by the mapping
    if(!polyhedron.flips.empty())
      polyhedron.triangulation = std::move(flipped);
    polyhedron.statistics.number_of_flips = polyhedron.flips.size();
    polyhedron.statistics.conformal_class = Conformal_class::DELAUNAY_TRIANGULATION;
    return twofold_->lost_border_edges(t, polyhedron.triangulation, polyhedron.flips).empty() || polyhedron.flips.empty();
  }

  // Then there is nothing to solve: the three corners of a triangle go anywhere on the circle, and the others follow from cross ratios, one after the other.
  template <typename NamedParameters>
  void find_polygon(const NamedParameters& np)
  {
    const Intrinsic_triangulation<NT>& t = polyhedron.triangulation;
    Vectors& vectors = polyhedron.vectors;
    vectors.assign(t.number_of_vertices(), Light_vector<Wide>{{Wide(0), Wide(0), Wide(0), Wide(0)}});
    place_first_triangle(vectors);
    std::vector<Index> waiting(1, 0);
    for(std::size_t n = 0; n < waiting.size(); ++n)
      for(Index h = 3 * waiting[n]; h < 3 * waiting[n] + 3; ++h)
      {
        const Index g = t.twin(h);
        if(g == t.null_index || vectors[t.apex(g)][3] > 0)
          continue;
        vectors[t.apex(g)] = vector_across(h);
        waiting.push_back(t.face(g));
      }
    normalize(polyhedron, np);
    take_over(mesh, polyhedron, report);
    report.statistics.is_doubled = is_doubled(polyhedron);
  }

  // The corners 0, 1, 2 of the first face at 0, 1 and infinity.
  void place_first_triangle(Vectors& v) const
  {
    typedef Complex_number<Wide> Complex;
    const Intrinsic_triangulation<NT>& t = polyhedron.triangulation;
    const Wide a(t.halfedge_length(0)), b(t.halfedge_length(1)), c(t.halfedge_length(2)); // between 0 and 1, 1 and 2, 2 and 0
    v[t.origin(0)] = light_vector(Complex{Wide(0), Wide(0)}, square_root(b / a / c));
    v[t.origin(1)] = light_vector(Complex{Wide(1), Wide(0)}, square_root(c / a / b));
    const Wide weight = b / a * c / 2;
    v[t.origin(2)] = {{Wide(0), Wide(0), -weight, weight}};
  }

  // The vertex l of the other triangle at the side ij of ijk: its products with the vectors of i and j are given, that with k by Ptolemy's theorem.
  Light_vector<Wide> vector_across(Index h) const
  {
    const Intrinsic_triangulation<NT>& t = polyhedron.triangulation;
    const Index g = t.twin(h);
    const Vectors& v = polyhedron.vectors;
    const Light_vector<Wide> &i = v[t.origin(h)], &j = v[t.target(h)], &k = v[t.apex(h)];
    const Wide ij(t.halfedge_length(h)), jk(t.halfedge_length(t.next(h))), ki(t.halfedge_length(t.previous(h)));
    const Wide il(t.halfedge_length(t.next(g))), lj(t.halfedge_length(t.previous(g)));
    const Wide at_i = lj / ij * (il / ki * (jk / ij) + lj / ij), at_j = il / ij * (il / ij + lj / jk * (ki / ij)), at_k = il / ki * (lj / jk);
    Light_vector<Wide> result;
    for(std::size_t x = 0; x < 3; ++x)
      result[x] = at_i * i[x] + at_j * j[x] - at_k * k[x];
    result[3] = square_root(result[0] * result[0] + result[1] * result[1] + result[2] * result[2]);
    return result;
  }

  static Wide square_root(const Wide& x)
  {
    using std::sqrt;
    return Wide(sqrt(x));
  }

  template <typename NamedParameters>
  void normalize(Ideal_polyhedron<NT>& found, const NamedParameters& np) const
  {
    using parameters::choose_parameter;
    using parameters::get_parameter;
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    const Moebius_weights kind = choose_parameter(get_parameter(np, internal_np::conformal_moebius_weights), Moebius_weights::VERTICES);
    std::vector<double> vertex_weights = moebius_weights(t, kind);
    Index first = t.null_index;
    for(Index v = 0; v < t.number_of_vertices(); ++v)
      if(t.is_border_vertex(v))
      {
        first = (std::min)(first, v);
        vertex_weights[v] /= kind == Moebius_weights::VERTICES ? 2 : 1; // the others are on the double twice
      }
    vertex_weights.resize(found.vectors.size(), 0);
    if(!place(given_frame(np), Disk_normalization<Wide>(std::move(vertex_weights), first), found.vectors))
    {
      found.status = Status::SINGULAR_PROBLEM;
      found.vertices.assign(1, found.apex == t.null_index ? first : found.apex);
    }
  }

  template <typename NamedParameters>
  static auto given_frame(const NamedParameters& np)
  {
    return parameters::choose_parameter(parameters::get_parameter(np, internal_np::conformal_disk_frame), Disk_frame::BARYCENTRE);
  }

  // Is there a map in that frame? Border points need to be different, and in the order in which they are on the circle.
  template <typename Frame>
  bool is_possible(const Frame&) const { return true; }

  template <typename Vertex>
  bool is_possible(const Three_point_disk_frame<Vertex>& frame)
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    const std::array<Index, 3> border = border_points(frame);
    Index v = t.target(t.vertex_halfedge(border[0]));
    while(v != border[0] && v != border[1] && v != border[2])
      v = t.target(t.vertex_halfedge(v));
    if(v == border[1] && border[0] != border[1] && border[0] != border[2] && border[1] != border[2])
      return true;
    report.status = Status::SINGULAR_PROBLEM;
    name_elements(mesh, std::vector<Index>(border.begin(), border.end()), {}, {}, report);
    return false;
  }

  template <typename Vertex>
  std::array<Index, 3> border_points(const Three_point_disk_frame<Vertex>& frame) const
  {
    std::array<Index, 3> result;
    for(std::size_t i = 0; i < 3; ++i)
    {
      result[i] = mesh.index_of_vertex(frame.border[i]);
      CGAL_precondition(mesh.triangulation.is_border_vertex(result[i]));
    }
    return result;
  }

  bool place(Disk_frame, const Disk_normalization<Wide>& normalization, Vectors& v) const { return normalization.barycentre(v); }

  template <typename Vertex>
  bool place(const Centred_disk_frame<Vertex>& frame, const Disk_normalization<Wide>& normalization, Vectors& v) const
  {
    const Index c = mesh.index_of_vertex(frame.centre);
    CGAL_precondition(!mesh.triangulation.is_isolated_vertex(c) && !mesh.triangulation.is_border_vertex(c));
    return normalization.centre(v, c);
  }

  template <typename Vertex>
  bool place(const Three_point_disk_frame<Vertex>& frame, const Disk_normalization<Wide>& normalization, Vectors& v) const
  {
    return normalization.three_points(v, border_points(frame));
  }

  static std::vector<Wide_point> wide_points(const Vectors& vectors)
  {
    std::vector<Wide_point> result;
    result.reserve(vectors.size());
    for(const Light_vector<Wide>& v : vectors)
      result.push_back(v[3] > 0 ? disk_point(v) : Wide_point{{Wide(0), Wide(0)}});
    return result;
  }

  static std::vector<std::array<NT, 2> > rounded_points(const std::vector<Wide_point>& p)
  {
    std::vector<std::array<NT, 2> > result;
    result.reserve(p.size());
    for(const Wide_point& x : p)
      result.push_back({{ static_cast<NT>(x[0]), static_cast<NT>(x[1]) }});
    return result;
  }

  template <typename Number>
  static bool is_positive(const std::array<Number, 2>& p, const std::array<Number, 2>& q, const std::array<Number, 2>& r)
  {
    return is_left_turn(p, q, r);
  }

  // Exact numbers only where they are needed: coordinates are at most 1, and the error of the determinant below 2^-100.
  static bool is_positive(const std::array<Double_double, 2>& p, const std::array<Double_double, 2>& q, const std::array<Double_double, 2>& r)
  {
    const double determinant = static_cast<double>((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]));
    return std::abs(determinant) > 1e-29 ? determinant > 0 : is_left_turn(p, q, r);
  }

  // Those of the surface that are not positive; of the double not those of the mirror image, and those across the axis.
  std::vector<Index> flipped_faces(const Ideal_polyhedron<NT>& found) const
  {
    const Intrinsic_triangulation<NT>& t = found.triangulation;
    const Index n = mesh.triangulation.number_of_vertices();
    const std::vector<Wide_point> p = wide_points(found.vectors);
    std::vector<Index> result;
    for(Index f = 0; f < t.number_of_faces(); ++f)
    {
      const Index i = t.origin(3 * f), j = t.origin(3 * f + 1), k = t.origin(3 * f + 2);
      if(i >= n || j >= n || k >= n)
        continue;
      const bool is_at_axis = mesh.triangulation.is_border_vertex(i) && mesh.triangulation.is_border_vertex(j) && mesh.triangulation.is_border_vertex(k);
      if(!(is_doubled(found) && is_at_axis) && !is_positive(p[i], p[j], p[k])) // at the axis it may belong to the image
        result.push_back(f);
    }
    return result;
  }

  // ---- Verdict

  void judge(bool is_refined)
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    std::vector<Wide_point> wide = wide_points(polyhedron.vectors);
    wide.resize(t.number_of_vertices());
    points = rounded_points(wide);
    for(const Light_vector<Wide>& v : polyhedron.vectors)
      weights.push_back(weight_in_disk(v));
    weights.resize(t.number_of_vertices());
    if(is_doubled(polyhedron))
      for(Index e : twofold_->lost_border_edges(t, polyhedron.triangulation, polyhedron.flips))
        report.lost_border_edges.push_back(mesh.edge(e));
    const std::vector<Index> flipped = straight_flipped_faces(wide);
    if(!turns_once(wide))
      report.status = Status::NOT_INJECTIVE;
    else if(is_refined)
      refine(flipped);
    else if(!flipped.empty())
    {
      report.status = Status::NOT_INJECTIVE;
      name_elements(mesh, {}, {}, flipped, report);
    }
    else
      for(Index f : straight_flipped_faces(points))
        report.rounded_faces.push_back(mesh.face(f));
  }

  template <typename Number>
  std::vector<Index> straight_flipped_faces(const std::vector<std::array<Number, 2> >& p) const
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    std::vector<Index> result;
    for(Index f = 0; f < t.number_of_faces(); ++f)
      if(!is_positive(p[t.origin(3 * f)], p[t.origin(3 * f + 1)], p[t.origin(3 * f + 2)]))
        result.push_back(f);
    return result;
  }

  // Does the border go once around, always counterclockwise? Then, with positive triangles, the map is one-to-one.
  bool turns_once(const std::vector<Wide_point>& p) const
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    Index first = 0;
    while(!t.is_border(first))
      ++first;
    double sum = 0;
    Index h = first;
    do
    {
      const Wide_point &a = p[t.origin(h)], &b = p[t.target(h)];
      const double angle = std::atan2(static_cast<double>(Wide(a[0] * b[1] - a[1] * b[0])), static_cast<double>(Wide(a[0] * b[0] + a[1] * b[1])));
      sum += angle < 0 ? angle + 2 * Number_constants<double>::pi() : angle;
      h = t.next_on_border(h);
    }
    while(h != first);
    return std::abs(sum - 2 * Number_constants<double>::pi()) < 1e-6;
  }

  // The overlay, in triangles; the verdict is on these.
  void refine(const std::vector<Index>& bent)
  {
    const Intrinsic_triangulation<NT>& t = mesh.triangulation;
    const Surface_size size = { t.number_of_vertices(), t.number_of_edges(), t.number_of_faces() };
    Ideal_refinement<NT> overlay = Ideal_refinement_builder<NT>(is_doubled(polyhedron) ? twofold_->triangulation : t, polyhedron, size)(
      default_maximum_number_of_crossings, weight_in_disk<Wide>);
    if(!bool(overlay.parts))
    {
      report.status = overlay.parts.status;
      report.amount = overlay.parts.amount;
      return;
    }
    const std::vector<Wide_point> wide = wide_points(overlay.vectors);
    const std::vector<std::array<NT, 2> > rounded = rounded_points(wide);
    for(Index v : overlay.parts.corner_vertex)
      overlay.parts.corner_uv.push_back(rounded[v]);
    refinement = triangulate_refinement(overlay.parts);
    refined_vectors = std::move(overlay.vectors);
    judge_parts(wide);
    for(Index f : bent)
      report.bent_faces.push_back(mesh.face(f));
  }

  void judge_parts(const std::vector<Wide_point>& wide)
  {
    std::vector<Index> flipped, lost;
    std::vector<Index> suspects = refinement.flipped_faces;
    suspects.insert(suspects.end(), refinement.rounded_faces.begin(), refinement.rounded_faces.end());
    std::sort(suspects.begin(), suspects.end());
    refinement.flipped_faces.clear();
    refinement.rounded_faces.clear();
    for(Index f : suspects)
    {
      const std::size_t c = refinement.first_corner[f];
      const bool is_rounded = is_positive(wide[refinement.corner_vertex[c]], wide[refinement.corner_vertex[c + 1]], wide[refinement.corner_vertex[c + 2]]);
      (is_rounded ? refinement.rounded_faces : refinement.flipped_faces).push_back(f);
      (is_rounded ? lost : flipped).push_back(refinement.input_face[f]);
    }
    if(!flipped.empty())
    {
      report.status = Status::NOT_INJECTIVE;
      name_elements(mesh, {}, {}, flipped, report);
    }
    std::sort(lost.begin(), lost.end());
    lost.erase(std::unique(lost.begin(), lost.end()), lost.end());
    for(Index f : lost)
      report.rounded_faces.push_back(mesh.face(f));
  }

  std::unique_ptr<Surface_double<NT> > twofold_;
};

template <typename TriangleMesh, typename NT, typename VertexUVMap, typename NamedParameters>
void write_disk(const Disk_mapping<TriangleMesh, NT>& mapping, VertexUVMap disk_map, const NamedParameters& np)
{
  typedef typename boost::property_traits<VertexUVMap>::value_type Point_2;
  const Intrinsic_triangulation<NT>& t = mapping.mesh.triangulation;
  for(std::uint32_t v = 0; v < t.number_of_vertices(); ++v)
    if(!t.is_isolated_vertex(v))
      put(disk_map, mapping.mesh.vertex(v), Point_2(mapping.points[v][0], mapping.points[v][1]));
  write_weights(mapping.mesh, mapping.weights, np);
}

} // namespace internal

/// \ingroup PkgConformalEquivalenceDoors
///
/// maps a topological disk to the unit disk: the image is a polygon inscribed to the unit circle, with all border vertices on the circle, and
/// discretely conformally equivalent to the mesh. Among these maps, which differ by Moebius transformations of the disk, `disk_frame` tells which.
///
/// On the triangulation of the mesh (`Retriangulation::NEVER`, or `WHEN_NEEDED` if that is possible) triangles become straight triangles, and length cross ratios are
/// preserved; the result is kept only if all triangles are positive. Otherwise edges are flipped, on the double of the surface, as by
/// `map_to_sphere()`: there is a map for every disk, which is straight on the parts of the triangles that `common_refinement` holds. Straight triangles between the images of the vertices may
/// then be flipped, which is an error (`NOT_INJECTIVE`) unless the refinement is asked for; and a border edge may become a broken line, which is a
/// little nearer to the circle than the chord (`lost_border_edges`). `map_to_disk_refined()` makes a mesh of the refinement.
///
/// Triangles are judged by exact predicates on the coordinates as they were computed, in pairs of `double`; those that are positive there, but not when rounded,
/// are listed (`Flattening_report::rounded_faces`). Positive triangles and a border that goes around once make the map one-to-one.
///
/// \tparam NT number type of lengths, and of the points: `double`, or a binary floating-point number of Boost.Multiprecision
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam VertexUVMap a model of `WritablePropertyMap` with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and a value type that
///         can be made from two `NT`, such as `Point_2`
///
/// \param tm a triangle mesh: one component with one border, without handles, apart from isolated vertices
/// \param disk_map receives the points; isolated vertices get none
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones listed below
///
/// \cgalNamedParamsBegin
///   \cgalParamNBegin{vertex_point_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{edge_length_map} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{mollification} \cgalParamDescription{as in `import_mesh()`} \cgalParamNEnd
///   \cgalParamNBegin{disk_frame}
///     \cgalParamDescription{which of the maps}
///     \cgalParamType{`Disk_frame`, `Centred_disk_frame<vertex_descriptor>`, or `Three_point_disk_frame<vertex_descriptor>`}
///     \cgalParamDefault{`Disk_frame::BARYCENTRE`}
///   \cgalParamNEnd
///   \cgalParamNBegin{moebius_weights}
///     \cgalParamDescription{what has its barycentre in the centre, for `Disk_frame::BARYCENTRE`}
///     \cgalParamType{`Moebius_weights`}
///     \cgalParamDefault{`Moebius_weights::VERTICES`}
///   \cgalParamNEnd
///   \cgalParamNBegin{vertex_at_infinity}
///     \cgalParamDescription{the border vertex that is sent to infinity on the way}
///     \cgalParamType{`boost::graph_traits<TriangleMesh>::%vertex_descriptor`}
///     \cgalParamDefault{the null vertex: one with well-shaped triangles around it is taken}
///   \cgalParamNEnd
///   \cgalParamNBegin{log_scale_factor_map}
///     \cgalParamDescription{receives u: the straight edges are e^{(u_i + u_j) / 2} times as long as those of the mesh}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{projective_weight_map}
///     \cgalParamDescription{receives the weights e^{-u} of projective interpolation, scaled to a maximum of 1}
///     \cgalParamType{a writable property map with key type `boost::graph_traits<TriangleMesh>::%vertex_descriptor` and value type `double`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{common_refinement}
///     \cgalParamDescription{if edges were flipped, receives the overlay of the mesh with the triangulation of the disk, in triangles; otherwise one without faces}
///     \cgalParamType{`std::reference_wrapper<Common_refinement<NT> >`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
///   \cgalParamNBegin{gradient_tolerance, number_of_iterations, newton_strategy, retriangulation, visitor}
///     \cgalParamDescription{as in `Conformal_metric_solver::solve()`; the solution is refined as far as the number type allows} \cgalParamNEnd
///   \cgalParamNBegin{sparse_linear_solver} \cgalParamDescription{as in `compute_conformal_metric()`} \cgalParamNEnd
///   \cgalParamNBegin{flattening_report}
///     \cgalParamDescription{receives a copy of what is returned}
///     \cgalParamType{`std::reference_wrapper<Flattening_report<TriangleMesh> >`}
///     \cgalParamDefault{none}
///   \cgalParamNEnd
/// \cgalNamedParamsEnd
///
/// \return the report. Maps are written iff it is a success. Statuses: those of `import_mesh()`; `WRONG_TOPOLOGY`, with what was found
///         (`Flattening_report::topology`); those of `Conformal_metric_solver::solve()`; `SINGULAR_PROBLEM` (vertices) if there is no such frame; `NOT_INJECTIVE`
///         (faces); those of `compute_common_refinement()` if the refinement was asked for.
///
/// \sa `CGAL::Conformal_equivalence::map_to_sphere()`
template <typename NT = double, typename TriangleMesh, typename VertexUVMap, typename NamedParameters = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> map_to_disk(const TriangleMesh& tm,
                                            VertexUVMap disk_map,
                                            const NamedParameters& np = parameters::default_values())
{
  static_assert(internal::Check_vertex_map<VertexUVMap, TriangleMesh>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_map_to_disk, TriangleMesh, NamedParameters>::value);
  constexpr bool is_refined = !parameters::is_default_parameter<NamedParameters, internal_np::conformal_common_refinement_t>::value;
  internal::Disk_mapping<TriangleMesh, NT> mapping(tm);
  mapping.run(np, is_refined, false);
  if(bool(mapping.report))
  {
    internal::write_disk(mapping, disk_map, np);
    if constexpr(is_refined)
      parameters::get_parameter(np, internal_np::conformal_common_refinement).get() = std::move(mapping.refinement);
  }
  internal::write_report(mapping.report, np);
  return mapping.report;
}

/// \ingroup PkgConformalEquivalenceDoors
///
/// maps a topological disk to the unit disk, as `map_to_disk()` does, and makes a mesh of the parts into which the edges of the triangulation of the disk
/// cut the given one. Where no edge was flipped that is a copy.
///
/// \tparam TriangleMesh a model of `FaceListGraph`
/// \tparam RefinedMesh a model of `MutableFaceGraph`
/// \tparam HalfedgeUVMap a model of `WritablePropertyMap` with key type `boost::graph_traits<RefinedMesh>::%halfedge_descriptor` and a
///         value type that can be made from two `double`
///
/// \param tm a triangle mesh
/// \param refined the mesh to be made, empty: vertices of `tm` come first, in the order of `vertices(tm)`, then the crossings of edges, which lie on edges of `tm`
/// \param uv receives, at every halfedge `h` of `refined`, the point of `target(h)`
/// \param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those of `map_to_disk()`, with maps of `tm`
/// \param np_refined an optional sequence of \ref bgl_namedparameters "Named Parameters" for `refined`: those of `make_refined_mesh()`
///
/// \return the report of `map_to_disk()`, with `bent_faces`; `NOT_REPRESENTABLE` if `refined` cannot hold the result. Meshes and maps are written iff it is a success.
template <typename TriangleMesh, typename RefinedMesh, typename HalfedgeUVMap,
          typename NamedParameters = parameters::Default_named_parameters,
          typename NamedParametersRefined = parameters::Default_named_parameters>
Flattening_report<TriangleMesh> map_to_disk_refined(const TriangleMesh& tm,
                                                    RefinedMesh& refined,
                                                    HalfedgeUVMap uv,
                                                    const NamedParameters& np = parameters::default_values(),
                                                    const NamedParametersRefined& np_refined = parameters::default_values())
{
  static_assert(internal::Check_halfedge_map<HalfedgeUVMap, RefinedMesh>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_map_to_disk, TriangleMesh, NamedParameters>::value);
  static_assert(internal::Check_pack<internal::Parameters_of_refined_mesh, RefinedMesh, NamedParametersRefined>::value);
  internal::Disk_mapping<TriangleMesh, double> mapping(tm);
  mapping.run(np, true, true);
  if(bool(mapping.report) && make_refined_mesh(mapping.mesh, mapping.refinement, refined, uv, np, np_refined).faces.empty())
    mapping.report.status = Status::NOT_REPRESENTABLE;
  if(bool(mapping.report))
    internal::write_weights(mapping.mesh, mapping.weights, np);
  if constexpr(!parameters::is_default_parameter<NamedParameters, internal_np::conformal_common_refinement_t>::value)
    if(bool(mapping.report))
      parameters::get_parameter(np, internal_np::conformal_common_refinement).get() = std::move(mapping.refinement);
  internal::write_report(mapping.report, np);
  return mapping.report;
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_MAP_TO_DISK_H
