// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file make_triangulation_on_hyperbolic_surface.h
/// From a mesh to the package 2D Triangulations on Hyperbolic Surfaces of \cgal 6.1 and later (what it takes are cross ratios, those of section 2 of
/// Bobenko, Pinkall and Springborn, "Discrete conformal maps and ideal hyperbolic polyhedra", 2015).

#ifndef CGAL_CONFORMAL_EQUIVALENCE_MAKE_TRIANGULATION_ON_HYPERBOLIC_SURFACE_H
#define CGAL_CONFORMAL_EQUIVALENCE_MAKE_TRIANGULATION_ON_HYPERBOLIC_SURFACE_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <CGAL/Conformal_equivalence/Exact_hyperbolic_surface.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>

#if __has_include(<CGAL/Triangulation_on_hyperbolic_surface_2.h>) || defined(DOXYGEN_RUNNING)

/// \ingroup PkgConformalEquivalenceHyperbolic
/// is defined iff `make_triangulation_on_hyperbolic_surface()` can be called: with \cgal 6.1 and later.
#define CGAL_CONFORMAL_EQUIVALENCE_HAS_HYPERBOLIC_SURFACES

#include <CGAL/Exact_rational.h>
#include <CGAL/Hyperbolic_Delaunay_triangulation_traits_2.h>
#include <CGAL/Hyperbolic_surface_traits_2.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Triangulation_on_hyperbolic_surface_2.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceHyperbolic
/// The default traits of `make_triangulation_on_hyperbolic_surface()`.
typedef Hyperbolic_surface_traits_2<Hyperbolic_Delaunay_triangulation_traits_2<Simple_cartesian<Exact_rational> > > Default_hyperbolic_surface_traits;

/// \ingroup PkgConformalEquivalenceHyperbolic
///
/// makes a triangulation of \cgal of a hyperbolic surface in rational numbers, of any genus: its triangles are those of `surface`, with exact
/// cross ratios at the edges, and the first face is the anchor. It is nearly Delaunay: what rounding has made of cocircular vertices is left to
/// `make_Delaunay()`.
///
/// Needs \cgal 6.1 or later; with earlier versions a call does not compile, and says so. Linear time.
///
/// \tparam Traits traits of `Triangulation_on_hyperbolic_surface_2` whose points are made of two numbers to which `Exact_rational` converts
/// \pre `surface.status` is `OK` or `BOUND_NOT_MET`: it has generators and points
template <typename Traits = Default_hyperbolic_surface_traits>
Triangulation_on_hyperbolic_surface_2<Traits> make_triangulation_on_hyperbolic_surface(const Exact_hyperbolic_surface& surface)
{
  typedef Triangulation_on_hyperbolic_surface_2<Traits> Result;
  typedef typename Result::Combinatorial_map_with_cross_ratios Map;
  typedef typename Result::Point Point;
  typedef typename Traits::FT FT;
  typedef std::uint32_t Index;
  const Intrinsic_triangulation<double>& t = surface.triangulation();
  const auto point = [](const Exact_hyperbolic_surface::Point& p) { return Point(FT(p[0]), FT(p[1])); };

  Map map;
  std::vector<typename Map::Dart_descriptor> dart;
  for(Index f = 0; f < t.number_of_faces(); ++f)
  {
    dart.push_back(map.make_combinatorial_polygon(3));
    dart.push_back(map.template beta<1>(dart.back()));
    dart.push_back(map.template beta<1>(dart.back()));
  }
  const Result formulas;
  for(Index e = 0; e < t.number_of_edges(); ++e)
  {
    const Index h = t.edge_halfedge(e), g = t.twin(h);
    const Point from = point(surface.vertex_point(t.origin(h))), to = point(surface.target_point(h)),
                left = point(surface.apex_point(h)), right = point(surface.target_point(t.next(g)));
    map.template sew<2>(dart[h], dart[g]);
    map.template set_attribute<1>(dart[h], map.template create_attribute<1>(formulas.cross_ratio(from, right, to, left)));
  }
  typename Result::Anchor anchor(dart[0], point(surface.vertex_point(t.origin(0))), point(surface.target_point(0)), point(surface.apex_point(0)));
  return Result(map, anchor);
}

} // namespace Conformal_equivalence
} // namespace CGAL

#else

#include <type_traits>

namespace CGAL {
namespace Conformal_equivalence {

template <typename Traits = void>
void make_triangulation_on_hyperbolic_surface(const Exact_hyperbolic_surface&)
{
  static_assert(!std::is_same<Traits, Traits>::value,
                "make_triangulation_on_hyperbolic_surface() needs CGAL 6.1 or later, which has Triangulation_on_hyperbolic_surface_2");
}

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL has hyperbolic surfaces

#endif // CGAL_CONFORMAL_EQUIVALENCE_MAKE_TRIANGULATION_ON_HYPERBOLIC_SURFACE_H
