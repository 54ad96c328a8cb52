// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#include "../include/flatten_mesh/side_by_side.h"
#include "../include/flatten_mesh/seamless.h"

#include <CGAL/Conformal_equivalence/internal/Layout/layout_frames.h>
#include <CGAL/Conformal_equivalence/internal/Seamless/Texture_lattice.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace flattening {

namespace {

// ---- Seamless layouts

typedef CE::internal::Lattice_coordinates<std::int64_t> Lattice_point;
typedef CE::internal::Lattice_coordinates<double>       Lattice_position;

// The rectangles that hold the components, larger by what moving to a point of the lattice may take.
std::vector<CE::internal::Bounding_box> bounding_boxes(const Components& components, const Result& layout)
{
  const double slack = .5;
  std::vector<CE::internal::Bounding_box> boxes(components.size());
  for(Face f : layout.mesh.faces())
    for(Halfedge h : layout.mesh.halfedges_around_face(layout.mesh.halfedge(f)))
    {
      CE::internal::Bounding_box& box = boxes[components.of_face(f)];
      const std::array<double, 2> p = {{ layout.uv[h].x(), layout.uv[h].y() }};
      for(std::size_t k = 0; k < 2; ++k)
      {
        box.low[k] = (std::min)(box.low[k], p[k] - slack);
        box.high[k] = (std::max)(box.high[k], p[k] + slack);
      }
    }
  return boxes;
}

// The points of the lattice by which components are moved.
std::vector<Lattice_point> lattice_moves(const Components& components, const Result& layout, const CE::internal::Texture_lattice& lattice)
{
  const std::vector<CE::internal::Bounding_box> boxes = bounding_boxes(components, layout);
  const auto places = CE::internal::places_beside_one_another(boxes);
  std::vector<Lattice_point> moves;
  for(std::size_t c = 0; c < boxes.size(); ++c)
  {
    const Lattice_position p = lattice.from_plane(std::complex<double>(places[c][0] - boxes[c].low[0], places[c][1] - boxes[c].low[1]));
    moves.push_back({{ std::llround(p[0]), std::llround(p[1]) }});
  }
  return moves;
}

// Moves the corners of components, in coordinates of the lattice, and their seams with them.
class Lattice_mover
{
public:
  Lattice_mover(const Components& components, const CE::internal::Texture_lattice& lattice, const std::vector<Lattice_point>& moves,
                const Mesh& mesh, UV_map uv, Report& report)
    : components_(components), lattice_(lattice), moves_(moves), mesh_(mesh), uv_(uv),
      transition_(mesh.number_of_edges(), nullptr), seam_vertices_(components.size()), largest_(components.size(), 1.)
  {
    for(auto& transition : report.transitions)
      move(transition);
    for(auto& cone : report.cones)
      cone.lattice_point = sum(cone.lattice_point, moves_[components_.of_vertex(cone.vertex)]);
  }

  void move_corners()
  {
    find_seam_vertices();
    const std::vector<char> is_rounded = components_to_be_rounded();
    for(Face f : mesh_.faces())
      for(Halfedge h : mesh_.halfedges_around_face(mesh_.halfedge(f)))
        uv_[h] = point(moved(h));
    for(std::size_t c = 0; c < components_.size(); ++c)
      if(is_rounded[c])
        for(Vertex v : seam_vertices_[c])
          round_places(v, number_of_bits(largest_[c]));
    for(Halfedge h : mesh_.halfedges())
      if(mesh_.is_border(h))
        uv_[h] = uv_[mesh_.prev(mesh_.opposite(h))];
  }

private:
  typedef CE::Seam_transition<Mesh> Transition;

  static Lattice_point sum(const Lattice_point& p, const Lattice_point& q) { return {{ p[0] + q[0], p[1] + q[1] }}; }
  static Lattice_point difference(const Lattice_point& p, const Lattice_point& q) { return {{ p[0] - q[0], p[1] - q[1] }}; }
  static Kernel::Point_2 point(const Lattice_position& p) { return Kernel::Point_2(p[0], p[1]); }

  // z -> R z + t becomes z + s -> R z + t + s.
  void move(Transition& transition)
  {
    const std::uint32_t c = components_.of_face(mesh_.face(transition.halfedge));
    const Lattice_point& s = moves_[c];
    Lattice_point& t = transition.lattice_translation;
    t = sum(t, difference(s, lattice_.rotated(transition.quanta, s)));
    const std::complex<double> z = lattice_.to_plane(t);
    transition.translation = {{ z.real(), z.imag() }};
    transition_[mesh_.edge(transition.halfedge).idx()] = &transition;
    seam_vertices_[c].push_back(mesh_.source(transition.halfedge));
    seam_vertices_[c].push_back(mesh_.target(transition.halfedge));
  }

  static void include(const Lattice_position& p, double& largest)
  {
    largest = (std::max)(largest, (std::max)(std::abs(p[0]), std::abs(p[1])));
  }

  Lattice_position moved(Halfedge h) const
  {
    const Lattice_point& s = moves_[components_.of_vertex(mesh_.target(h))];
    return {{ uv_[h].x() + double(s[0]), uv_[h].y() + double(s[1]) }};
  }

  void find_seam_vertices()
  {
    for(std::vector<Vertex>& vertices : seam_vertices_)
    {
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    }
  }

  template <typename Use>
  void for_each_seam_corner(std::size_t component, Use use) const
  {
    for(Vertex v : seam_vertices_[component])
      for(Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(v)))
        if(! mesh_.is_border(h))
          use(h);
  }

  // Of places, no larger than this, that motions take to one another exactly: with hexagons, they are less than twice as large when they are turned.
  int number_of_bits(double largest) const
  {
    return std::numeric_limits<double>::digits - (lattice_.trace() == 0 ? 0 : 1) - (std::ilogb(largest) + 1);
  }

  static bool is_multiple(double x, int bits) { return std::nearbyint(std::scalbn(x, bits)) == std::scalbn(x, bits); }
  static double rounded(double x, int bits) { return std::scalbn(std::nearbyint(std::scalbn(x, bits)), -bits); }

  std::vector<char> components_to_be_rounded()
  {
    std::vector<char> result(components_.size(), 0);
    for(std::size_t c = 0; c < components_.size(); ++c)
    {
      for_each_seam_corner(c, [&](Halfedge h) { include(moved(h), largest_[c]); });
      const int bits = number_of_bits(largest_[c]);
      for_each_seam_corner(c, [&](Halfedge h) { result[c] = result[c] || ! is_multiple(uv_[h].x(), bits) || ! is_multiple(uv_[h].y(), bits); });
    }
    return result;
  }

  // One place of the vertex is rounded; the others are its images under the motions.
  void round_places(Vertex v, int bits)
  {
    const Halfedge first = first_corner(v);
    uv_[first] = Kernel::Point_2(rounded(uv_[first].x(), bits), rounded(uv_[first].y(), bits));
    for(Halfedge h = first, next; ; h = next)
    {
      const Halfedge crossed = mesh_.next(h);
      next = mesh_.opposite(crossed);
      if(next == first || mesh_.is_border(next))
        return;
      uv_[next] = point(across(crossed, {{ uv_[h].x(), uv_[h].y() }}));
    }
  }

  // That on which the others follow, as next(opposite) around the vertex.
  Halfedge first_corner(Vertex v) const
  {
    for(Halfedge h : mesh_.halfedges_around_target(mesh_.halfedge(v)))
      if(! mesh_.is_border(h) && mesh_.is_border(mesh_.opposite(h)))
        return h;
    return mesh_.halfedge(v);
  }

  // Where a place, as laid out with the face of `h`, lies in the face of its opposite.
  Lattice_position across(Halfedge h, const Lattice_position& z) const
  {
    const Transition* transition = transition_[mesh_.edge(h).idx()];
    if(transition == nullptr)
      return z;
    const Lattice_position t = {{ double(transition->lattice_translation[0]), double(transition->lattice_translation[1]) }};
    if(transition->halfedge != h)
      return lattice_.rotated(-transition->quanta, Lattice_position{{ z[0] - t[0], z[1] - t[1] }});
    const Lattice_position turned = lattice_.rotated(transition->quanta, z);
    return {{ turned[0] + t[0], turned[1] + t[1] }};
  }

  const Components& components_;
  const CE::internal::Texture_lattice& lattice_;
  const std::vector<Lattice_point>& moves_;
  const Mesh& mesh_;
  UV_map uv_;
  std::vector<const Transition*> transition_;       // by edge; null if it is not on the seam
  std::vector<std::vector<Vertex> > seam_vertices_; // by component
  std::vector<double> largest_;                     // by component: coordinate of a place on the seam, at least 1
};

// Where coordinates are those of the plane, and the lattice is not: no seam is exact there.
void move_in_the_plane(const Components& components, const CE::internal::Texture_lattice& lattice, const std::vector<Lattice_point>& moves,
                       Result& layout)
{
  for(Halfedge h : layout.mesh.halfedges())
  {
    const std::complex<double> by = lattice.to_plane(moves[components.of_vertex(layout.mesh.target(h))]);
    layout.uv[h] = Kernel::Point_2(layout.uv[h].x() + by.real(), layout.uv[h].y() + by.imag());
  }
}

// ---- Spheres and disks

// In rows and columns, with a gap, at numbers that have few digits.
std::array<double, 2> centre(std::size_t component, std::size_t number_of_components)
{
  const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(double(number_of_components))));
  return {{ distance_of_centres * double(component % columns), distance_of_centres * double(component / columns) }};
}

// What is left of the points in point + centre: the difference is exact, as the centre is 0 or larger than the radius.
template <typename NT>
void round_to_places(const std::vector<std::array<double, 2> >& centres, std::vector<std::array<NT, 3> >& points)
{
  for(std::size_t v = 0; v < points.size(); ++v)
    for(std::size_t k = 0; k < 2; ++k)
    {
      const NT place = points[v][k] + NT(centres[v][k]);
      points[v][k] = place - NT(centres[v][k]);
    }
}

// By vertex of the mesh given, or of one made of it; `none` for isolated vertices.
std::vector<std::uint32_t> components_of_vertices(const Components& components, const Result& result)
{
  std::vector<std::uint32_t> component(result.mesh.number_of_vertices(), Components::none);
  for(Face f : result.mesh.faces())
  {
    const Face given = result.given_face.empty() ? f : Face(static_cast<Mesh::size_type>(result.given_face[f.idx()]));
    for(Vertex v : vertices_of_face(result.mesh, f))
      component[v.idx()] = components.of_face(given);
  }
  return component;
}

// The weights e^{-u} of a component have the maximum 1. That of all components is to be 1: the factors by component.
std::vector<double> common_weight_factors(const Components& components, const Result& given)
{
  std::vector<double> least(components.size(), std::numeric_limits<double>::infinity());
  for(Vertex v : given.mesh.vertices())
    if(! given.mesh.is_isolated(v))
      least[components.of_vertex(v)] = (std::min)(least[components.of_vertex(v)], given.u[v]);
  const double least_of_all = *std::min_element(least.begin(), least.end());
  for(double& x : least)
    x = std::exp(least_of_all - x);
  return least;
}

// `factors`: of weights, by component.
void place_images(Target target, const Components& components, const std::vector<Mapped_component>& mapped, const std::vector<double>& factors,
                  Result& result)
{
  if(result.mesh.number_of_faces() == 0)
    return;
  const std::vector<std::uint32_t> component = components_of_vertices(components, result);
  result.centres.assign(component.size(), {{0, 0}});
  for(Vertex v : result.mesh.vertices())
    if(component[v.idx()] != Components::none)
    {
      result.centres[v.idx()] = mapped[component[v.idx()]].centre;
      result.weight[v] = (std::max)(result.weight[v] * factors[component[v.idx()]], (std::numeric_limits<double>::min)());
    }
  round_to_places(result.centres, result.image);
  round_to_places(result.centres, result.wide_image);
  if(target != Target::DISK)
    return;
  for(Halfedge h : result.mesh.halfedges())
  {
    const std::size_t v = result.mesh.target(h).idx();
    const auto place = [&](const auto& points)
    {
      auto p = points[v];
      for(std::size_t k = 0; k < 2; ++k)
        p[k] += result.centres[v][k];
      return p;
    };
    const Space_point p = place(result.image);
    result.uv[h] = Kernel::Point_2(p[0], p[1]);
    if(! result.wide.is_used)
      continue;
    const Wide_space_point wide = place(result.wide_image);
    result.wide.uv[h] = Wide_point(wide[0], wide[1]);
  }
}

} // namespace

void place_tilings_side_by_side(const Components& components, Results& results, Report& report)
{
  Result& given = results.given;
  const CE::internal::Texture_lattice lattice(report.tiling.symmetry);
  const std::vector<Lattice_point> moves = lattice_moves(components, given, lattice);
  const bool has_exact_seams = given.lattice_uv || has_squares(report.tiling.symmetry);
  Lattice_mover mover(components, lattice, moves, given.mesh, given.lattice_uv ? *given.lattice_uv : given.uv, report);
  if(has_exact_seams)
    mover.move_corners();
  else
    move_in_the_plane(components, lattice, moves, given);
  if(given.lattice_uv)
    draw_lattice_coordinates(report.tiling.symmetry, given);
}

void place_images_side_by_side(Target target, Results& results)
{
  for(std::size_t c = 0; c < results.components.size(); ++c)
    results.components[c].centre = centre(c, results.components.size());
  const Components components(results.given.mesh);
  const std::vector<double> factors = common_weight_factors(components, results.given);
  place_images(target, components, results.components, factors, results.given);
  place_images(target, components, results.components, factors, results.made);
}

} // namespace flattening
