// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/image_figures.h"
#include "../include/flatten_mesh/Components.h"
#include "../include/flatten_mesh/inscribe.h"

#include <CGAL/Conformal_equivalence/discrete_metric.h>
#include <CGAL/Conformal_equivalence/Imported_mesh.h>
#include <CGAL/Conformal_equivalence/map_to_sphere.h>
#include <CGAL/Conformal_equivalence/named_parameters.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace flattening {

namespace {

template <typename NT>
NT norm(const std::array<NT, 3>& p)
{
  using std::sqrt;
  if constexpr(std::is_same<NT, double>::value)
    return std::hypot(p[0], p[1], p[2]);
  else
    return sqrt(NT(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]));
}

template <typename NT>
std::array<NT, 3> difference(const std::array<NT, 3>& p, const std::array<NT, 3>& q)
{
  return {{ NT(p[0] - q[0]), NT(p[1] - q[1]), NT(p[2] - q[2]) }};
}

// The triangles that are not positive: on the sphere seen from outside, on the disk from above. Exactly for `double`.
template <typename NT>
std::vector<Face> find_lost_faces(const Mesh& mesh, const std::vector<std::array<NT, 3> >& p, bool is_sphere)
{
  std::vector<Face> result;
  for(Face f : mesh.faces())
  {
    const auto v = vertices_of_face(mesh, f);
    const auto &a = p[v[0].idx()], &b = p[v[1].idx()], &c = p[v[2].idx()];
    const auto plane = [](const std::array<NT, 3>& x) { return std::array<NT, 2>{{ x[0], x[1] }}; };
    if(! (is_sphere ? CE::internal::is_counterclockwise(a, b, c) : CE::internal::is_left_turn(plane(a), plane(b), plane(c))))
      result.push_back(f);
  }
  return result;
}

// Whether the tetrahedron of the origin and these points is flat.
bool is_flat(const Space_point& a, const Space_point& b, const Space_point& c)
{
  return ! CE::internal::is_counterclockwise(a, b, c) && ! CE::internal::is_counterclockwise(b, a, c);
}

std::size_t number_of_flat_faces(const Mesh& mesh, const std::vector<Face>& faces, const std::vector<Space_point>& p, bool is_sphere)
{
  std::size_t result = 0;
  for(Face f : faces)
  {
    const auto v = vertices_of_face(mesh, f);
    const auto point = [&](std::size_t k)
    {
      const Space_point& q = p[v[k].idx()];
      return Space_point{{ q[0], q[1], is_sphere ? q[2] : 1 }};
    };
    result += is_flat(point(0), point(1), point(2));
  }
  return result;
}

double sum_of_solid_angles(const Mesh& mesh, const std::vector<Space_point>& p)
{
  double sum = 0;
  for(Face f : mesh.faces())
  {
    const auto v = vertices_of_face(mesh, f);
    sum += CE::internal::solid_angle(p[v[0].idx()], p[v[1].idx()], p[v[2].idx()]);
  }
  return sum;
}

template <typename NT>
double largest_distance_from_sphere(const Mesh& mesh, const std::vector<std::array<NT, 3> >& p, bool is_sphere)
{
  typedef std::conditional_t<std::is_same<NT, double>::value, long double, NT> Number;
  double largest = 0;
  for(Vertex v : mesh.vertices())
    if(! mesh.is_isolated(v) && (is_sphere || mesh.is_border(v)))
    {
      const std::array<NT, 3>& q = p[v.idx()];
      const Number square = Number(q[0]) * q[0] + Number(q[1]) * q[1] + Number(q[2]) * q[2];
      largest = (std::max)(largest, std::abs(static_cast<double>(Number(square - 1))) / 2);
    }
  return largest;
}

template <typename NT>
double largest_coordinate_of_barycentre(const std::vector<double>& weights, const std::vector<std::array<NT, 3> >& p)
{
  typedef std::conditional_t<std::is_same<NT, double>::value, long double, NT> Number;
  std::array<Number, 3> sum = {{ Number(0), Number(0), Number(0) }};
  double total = 0;
  for(std::size_t v = 0; v < weights.size(); ++v)
  {
    total += weights[v];
    for(std::size_t k = 0; k < 3; ++k)
      sum[k] += Number(p[v][k]) * weights[v];
  }
  double largest = 0;
  for(const Number& x : sum)
    largest = (std::max)(largest, std::abs(static_cast<double>(x)) / total);
  return largest;
}

// The chords, as the lengths of the edges.
template <typename NT>
CE::Intrinsic_triangulation<NT> with_chords(const CE::Intrinsic_triangulation<NT>& t, const std::vector<std::array<NT, 3> >& p)
{
  std::vector<NT> lengths;
  for(std::uint32_t e = 0; e < t.number_of_edges(); ++e)
  {
    const std::uint32_t h = t.edge_halfedge(e);
    lengths.push_back(norm(difference(p[t.origin(h)], p[t.target(h)])));
  }
  return t.with_lengths(std::move(lengths));
}

// The largest relative difference of a chord from what u makes of the edge.
template <typename NT>
double largest_length_error(const CE::Intrinsic_triangulation<NT>& edges, const CE::Intrinsic_triangulation<NT>& chords, const Result& result)
{
  const auto logarithm = [](const NT& x) { using std::log; return static_cast<double>(NT(log(x))); };
  double largest = 0;
  for(std::uint32_t e = 0; e < edges.number_of_edges(); ++e)
  {
    const std::uint32_t h = edges.edge_halfedge(e);
    const double u = (result.u[Vertex(edges.origin(h))] + result.u[Vertex(edges.target(h))]) / 2,
                 error = std::abs(std::expm1(logarithm(chords.length(e)) - logarithm(edges.length(e)) - u));
    if(! (error <= largest)) // also if it is not a number
      largest = error;
  }
  return largest;
}

// The larger number; NaN stands for none.
void include(double x, double& largest)
{
  if(! (x <= largest) && ! std::isnan(x))
    largest = x;
}

// The figures that compare with the mesh given, of one component.
template <typename NT>
void compare_with_component(const Options& options, bool is_flipped, const Result& given, const std::vector<std::array<NT, 3> >& p,
                            Image_figures& figures)
{
  if(options.target == Target::DISK && is_flipped)
    return;
  const auto mesh = CE::import_mesh<NT>(given.mesh, CGAL::parameters::mollification(options.mollification));
  if(options.target == Target::SPHERE)
  {
    const std::vector<double> weights = CE::internal::moebius_weights(mesh.triangulation, given_moebius_weights(options));
    include(largest_coordinate_of_barycentre(weights, p), figures.barycentre);
  }
  if(is_flipped)
    return;
  const auto chords = with_chords(mesh.triangulation, p);
  include(static_cast<double>(CE::largest_cross_ratio_difference(mesh.triangulation, chords)), figures.cross_ratio_error);
  include(largest_length_error(mesh.triangulation, chords, given), figures.length_error);
}

// The largest figures of all components. Each has lengths of its own with --mollify.
template <typename NT>
void compare_with_given_mesh(const Options& options, const Report& report, const std::vector<Mapped_component>& mapped, const Result& given,
                             const std::vector<std::array<NT, 3> >& p, Image_figures& figures)
{
  if(mapped.empty())
    return compare_with_component(options, report.statistics.number_of_flips != 0, given, p, figures);
  const Components components(given.mesh);
  for(std::size_t c = 0; c < components.size(); ++c)
  {
    Component_mesh part;
    components.get_mesh(c, part);
    Result its_result(part.mesh);
    std::vector<std::array<NT, 3> > its_points;
    for(Vertex v : part.mesh.vertices())
    {
      its_result.u[v] = given.u[part.vertices[v.idx()]];
      its_points.push_back(p[part.vertices[v.idx()].idx()]);
    }
    compare_with_component(options, mapped[c].statistics.number_of_flips != 0, its_result, its_points, figures);
  }
}

} // namespace

std::vector<Face> lost_faces(const Mesh& mesh, const std::vector<Space_point>& p, bool is_sphere)
{
  return find_lost_faces(mesh, p, is_sphere);
}

Image_figures judge_image(const Options& options, const Report& report, const std::vector<Mapped_component>& components, const Result& given,
                          const Result& drawn)
{
  Image_figures result;
  const bool is_sphere = options.target == Target::SPHERE;
  const auto judge = [&](const auto& given_points, const auto& drawn_points)
  {
    result.lost_faces = find_lost_faces(drawn.mesh, drawn_points, is_sphere);
    result.distance_from_sphere = is_sphere ? largest_distance_from_sphere(drawn.mesh, drawn_points, true)
                                            : largest_distance_from_sphere(given.mesh, given_points, false);
    compare_with_given_mesh(options, report, components, given, given_points, result);
  };
  if(given.wide_image.empty())
  {
    judge(given.image, drawn.image);
    result.number_of_flat_faces = number_of_flat_faces(drawn.mesh, result.lost_faces, drawn.image, is_sphere);
  }
  else
    judge(given.wide_image, drawn.wide_image);
  if(is_sphere)
    result.solid_angle = sum_of_solid_angles(drawn.mesh, drawn.image);
  return result;
}

} // namespace flattening
