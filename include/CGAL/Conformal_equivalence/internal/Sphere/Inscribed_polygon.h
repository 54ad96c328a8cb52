// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_INSCRIBED_POLYGON_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_INSCRIBED_POLYGON_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/Statistics.h>
#include <CGAL/Conformal_equivalence/Status.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/number_conversions.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Delaunay_flipper.h>
#include <CGAL/Conformal_equivalence/internal/Retriangulation/Surface_double.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Ideal_polyhedron.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/light_cone.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/options.h>
#include <CGAL/Conformal_equivalence/internal/compiled.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A surface without inner vertices as a polygon inscribed to the circle. There is nothing to solve: the three corners of a triangle go anywhere on
// the circle, and the others follow from cross ratios, one after the other.
template <typename NT>
class Inscribed_polygon
{
  typedef std::uint32_t Index;
  typedef Intrinsic_triangulation<NT> Triangulation;
  typedef typename Ideal_polyhedron<NT>::Wide Wide;
  typedef std::vector<Light_vector<Wide> > Vectors;

public:
  Ideal_polyhedron<NT> polyhedron; // of the surface, or of its double

  // The references are kept.
  Inscribed_polygon(const Triangulation& surface, const Surface_double<NT>& twofold) : surface_(surface), twofold_(twofold) {}

  // Finds the vectors, not normalized, or says by the status of `polyhedron` that they range too far. Returns whether this is such a surface, and,
  // where edges are flipped first, whether there are still all border edges, so that it can be developed.
  bool operator()(Retriangulation retriangulation);

private:
  bool has_only_border_vertices() const
  {
    for(Index v = 0; v < surface_.number_of_vertices(); ++v)
      if(!surface_.is_isolated_vertex(v) && !surface_.is_border_vertex(v))
        return false;
    return true;
  }

  // The triangulation whose cross ratios are kept: that given, or the intrinsic Delaunay triangulation of the double.
  bool start(Retriangulation retriangulation)
  {
    polyhedron.triangulation = surface_;
    if(retriangulation != Retriangulation::ALWAYS || surface_.number_of_faces() == 1)
      return true;
    Triangulation flipped = twofold_.triangulation;
    std::vector<Index> broken;
    if(!make_intrinsic_delaunay(flipped, broken, [&](Index e) { polyhedron.flips.push_back(e); }))
      return false; // refused by the mapping
    if(!polyhedron.flips.empty())
      polyhedron.triangulation = std::move(flipped);
    polyhedron.statistics.number_of_flips = polyhedron.flips.size();
    polyhedron.statistics.conformal_class = Conformal_class::DELAUNAY_TRIANGULATION;
    return twofold_.lost_border_edges(surface_, polyhedron.triangulation, polyhedron.flips).empty() || polyhedron.flips.empty();
  }

  // Along a strip vectors grow exponentially: until all are known, and how far they range, each has a power of two of its own.
  void place()
  {
    const Triangulation& t = polyhedron.triangulation;
    Vectors& vectors = polyhedron.vectors;
    vectors.assign(t.number_of_vertices(), Light_vector<Wide>{{Wide(0), Wide(0), Wide(0), Wide(0)}});
    exponents_.assign(t.number_of_vertices(), 0);
    std::vector<char> is_placed(t.number_of_vertices(), 0);
    place_first_triangle(vectors);
    for(Index h = 0; h < 3; ++h)
      is_placed[t.origin(h)] = 1;
    std::vector<Index> waiting(1, 0);
    for(std::size_t n = 0; n < waiting.size(); ++n)
      for(Index h = 3 * waiting[n]; h < 3 * waiting[n] + 3; ++h)
      {
        const Index g = t.twin(h);
        if(g == t.null_index || is_placed[t.apex(g)])
          continue;
        is_placed[t.apex(g)] = 1;
        place_across(h, t.apex(g));
        waiting.push_back(t.face(g));
      }
    join_exponents(is_placed);
  }

  void place_across(Index h, Index v)
  {
    const Triangulation& t = polyhedron.triangulation;
    const std::array<Index, 3> corners = {{t.origin(h), t.target(h), t.apex(h)}};
    const int largest = (std::max)({exponents_[corners[0]], exponents_[corners[1]], exponents_[corners[2]]});
    const auto vector = [&](int k) { return multiplied(polyhedron.vectors[corners[k]], exponents_[corners[k]] - largest); };
    const Light_vector<Wide> result = vector_across(h, vector(0), vector(1), vector(2));
    const int exponent = binary_exponent(result[3]);
    polyhedron.vectors[v] = multiplied(result, -exponent);
    exponents_[v] = largest + exponent;
  }

  static Light_vector<Wide> multiplied(const Light_vector<Wide>& x, int exponent)
  {
    using std::ldexp;
    return {{Wide(ldexp(x[0], exponent)), Wide(ldexp(x[1], exponent)), Wide(ldexp(x[2], exponent)), Wide(ldexp(x[3], exponent))}};
  }

  // Gives the vectors that were placed their powers of two, unless they range too far.
  void join_exponents(const std::vector<char>& is_placed)
  {
    int least = (std::numeric_limits<int>::max)(), largest = (std::numeric_limits<int>::min)();
    for(std::size_t v = 0; v < exponents_.size(); ++v)
      if(is_placed[v])
      {
        least = (std::min)(least, exponents_[v]);
        largest = (std::max)(largest, exponents_[v]);
      }
    const int farthest = 450; // of 1023: products of two are in range, too
    if(has_range_of_double<Wide>() && (std::max)(largest, -least) > farthest)
    {
      polyhedron.status = Status::SCALE_OUT_OF_RANGE;
      polyhedron.amount = std::log(2.) * (largest - least);
      return;
    }
    for(std::size_t v = 0; v < exponents_.size(); ++v)
      if(is_placed[v])
        polyhedron.vectors[v] = multiplied(polyhedron.vectors[v], exponents_[v]);
  }

  // The corners 0, 1, 2 of the first face at 0, 1 and infinity.
  void place_first_triangle(Vectors& v) const
  {
    typedef Complex_number<Wide> Complex;
    const Triangulation& t = polyhedron.triangulation;
    const Wide a(t.halfedge_length(0)), b(t.halfedge_length(1)), c(t.halfedge_length(2)); // between 0 and 1, 1 and 2, 2 and 0
    v[t.origin(0)] = light_vector(Complex{Wide(0), Wide(0)}, square_root_of(b / a / c));
    v[t.origin(1)] = light_vector(Complex{Wide(1), Wide(0)}, square_root_of(c / a / b));
    const Wide weight = b / a * c / 2;
    v[t.origin(2)] = {{Wide(0), Wide(0), -weight, weight}};
  }

  // The vertex l of the other triangle at the side ij of ijk: its products with the vectors of i and j are given, that with k by Ptolemy's theorem.
  Light_vector<Wide> vector_across(Index h, const Light_vector<Wide>& i, const Light_vector<Wide>& j, const Light_vector<Wide>& k) const
  {
    const Triangulation& t = polyhedron.triangulation;
    const Index g = t.twin(h);
    const Wide ij(t.halfedge_length(h)), jk(t.halfedge_length(t.next(h))), ki(t.halfedge_length(t.previous(h)));
    const Wide il(t.halfedge_length(t.next(g))), lj(t.halfedge_length(t.previous(g)));
    const Wide at_i = lj / ij * (il / ki * (jk / ij) + lj / ij), at_j = il / ij * (il / ij + lj / jk * (ki / ij)), at_k = il / ki * (lj / jk);
    Light_vector<Wide> result;
    for(std::size_t x = 0; x < 3; ++x)
      result[x] = at_i * i[x] + at_j * j[x] - at_k * k[x];
    result[3] = square_root_of(result[0] * result[0] + result[1] * result[1] + result[2] * result[2]);
    return result;
  }

  static Wide square_root_of(const Wide& x)
  {
    using std::sqrt;
    return Wide(sqrt(x));
  }

  const Triangulation& surface_;
  const Surface_double<NT>& twofold_;
  std::vector<int> exponents_; // of the vectors, while they are found
};

template <typename NT>
bool Inscribed_polygon<NT>::operator()(Retriangulation retriangulation)
{
  if(!has_only_border_vertices() || !start(retriangulation))
    return false;
  place();
  return true;
}

#ifdef CGAL_CONFORMAL_EQUIVALENCE_USE_COMPILED // see compiled.h
extern template bool Inscribed_polygon<double>::operator()(Retriangulation);
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SPHERE_INSCRIBED_POLYGON_H
