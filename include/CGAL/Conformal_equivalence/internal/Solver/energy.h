// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The gradient and the Hessian of the energy E(u) of a triangulated surface
// (sections 2.1 and 3.1, equations (7) to (10), of Springborn, Schroeder and
// Pinkall, 2008), on all of R^n.
//
//   E(u) = sum over triangles ( f(lambda~) - pi/2 (u_i + u_j + u_k) ) + 1/2 sum Theta^_i u_i
//   dE/du_i = 1/2 (Theta^_i - Theta~_i)
//   (Hess E . d)_i = 1/4 sum over edges ij of w_ij (d_i - d_j),  w_ij = cot + cot
//
// E is C^1 and convex; where a triangle inequality fails, its angles are pi, 0, 0
// and its cotangents count as 0. Its value is found in conformal_energy.h.
//
// Only the ratios of the three sides of a triangle matter. So u may range beyond what e^{u/2} can be in the number type, as it does on long
// strips and after flips of steep surfaces: there a factor, or a length, is a mantissa with its binary exponent apart.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ENERGY_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ENERGY_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Concurrency.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Number_constants.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Scaled_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Vector_of.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/Incircle_vectors.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>

#include <CGAL/number_type_config.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The angles and cotangents of the metric l~ = e^{(u_i + u_j)/2} l at one u.
template <typename NT, typename Length = NT>
class Conformal_energy
{
public:
  typedef Intrinsic_triangulation<Length> Triangulation;
  typedef typename Triangulation::Index Index;

  // Keeps a reference to `t` and its lengths converted to NT. If `normalize`, they are
  // multiplied by a power of two that brings them near 1.
  explicit Conformal_energy(const Triangulation& t, bool normalize = false)
    : t_(t), scale_(t.number_of_vertices(), NT(1)),
      angle_sum_(t.number_of_vertices()), weight_(t.number_of_edges()), product_(sums_up_angles ? 0 : t.number_of_vertices())
  {
    exponent_ = normalize ? middle_exponent() : 0;
    length_.resize(t.number_of_edges());
    for(Index e = 0; e < t.number_of_edges(); ++e)
      update_length(e);
  }

  // How many threads may be used. Results do not depend on it.
  void set_concurrency(const Concurrency& concurrency) { concurrency_ = concurrency; }

  // The length of `e` has changed.
  void update_length(Index e)
  {
    using std::ldexp;
    const Length& l = t_.length(e);
    const bool is_usual = l > 0 && l - l == Length(0); // neither 0 nor no number
    const int exponent = is_usual ? binary_exponent(l) : exponent_;
    const int apart = set_apart(exponent - exponent_, e, t_.number_of_edges(), length_exponent_);
    length_[e] = static_cast<NT>(exponent_ + apart == 0 ? l : Length(ldexp(l, -(exponent_ + apart))));
  }

  // moves to u: computes angle sums and edge weights there.
  // Returns false if a length overflows, underflows or is no number.
  bool evaluate(const std::vector<NT>& u)
  {
    set_scales(u);
    clear();
    const bool is_finite = add_all_triangles();
    for(std::size_t v = 0; v < product_.size(); ++v)
      angle_sum_[v] = product_[v].radians();
    return is_finite;
  }

  const std::vector<NT>& angle_sums() const { return angle_sum_; }  // Theta~, by vertex
  const std::vector<NT>& weights() const { return weight_; }        // w, by edge
  const std::vector<Index>& broken_faces() const { return broken_; }

  // The angle sum at v on the triangulation and with the factors of now, and how fast it falls as u grows there.
  std::pair<NT, NT> angle_sum_at(Index v) const
  {
    Angle_sum<NT> sum;
    NT slope(0);
    t_.for_each_outgoing(v, [&](Index h)
    {
      const std::array<NT, 3> l = sides_from(h);
      const Incircle_form<NT> triangle(l[0], l[1], l[2]);
      if(!triangle.is_broken())
      {
        const NT unit = 1 / triangle.s;
        sum.add(triangle.tangent[1] * unit, triangle.r * unit);
        slope += (t_.target(h) == v ? NT(0) : cotangent(triangle, 0)) + (t_.apex(h) == v ? NT(0) : cotangent(triangle, 2));
      }
      else if(longest_side(l[0], l[1], l[2]) == 1)
        sum.add_straight();
    });
    return std::make_pair(sum.radians(), NT(slope / 2));
  }

  // How far rounding alone may move the angle sums, in units of epsilon, by vertex: a
  // corner's angle moves by (cot + cot of the two others) times the relative change of
  // the lengths. Linear time.
  std::vector<NT> sensitivities() const
  {
    using std::abs;
    std::vector<NT> result(t_.number_of_vertices(), NT(0));
    for(Index h = 0; h < t_.number_of_halfedges(); h += 3)
    {
      const std::array<NT, 3> l = sides_from(h);
      const Incircle_form<NT> triangle(l[0], l[1], l[2]);
      if(triangle.is_broken())
        continue;
      std::array<NT, 3> c;
      for(int k = 0; k < 3; ++k)
        c[k] = abs(cotangent(triangle, k));
      for(int k = 0; k < 3; ++k)
        result[t_.apex(h + k)] += 1 + c[(k + 1) % 3] + c[(k + 2) % 3];
    }
    return result;
  }

  // The corners of all broken faces.
  std::vector<Index> broken_corners() const
  {
    std::vector<Index> result;
    for(const Index f : broken_)
      for(Index h = 3 * f; h < 3 * f + 3; ++h)
        result.push_back(t_.origin(h));
    return result;
  }

  // Is there a face that is broken, and remains so whatever multiple of d, up to `most`, is added to u or subtracted from it?
  bool stays_broken(const std::vector<NT>& d, const NT& most) const
  {
    return std::any_of(broken_.begin(), broken_.end(), [&](Index f) { return is_too_long_after(f, d, most); });
  }

  // e^{u/2}, by vertex. \pre `!ranges_far()`
  const std::vector<NT>& scales() const { return scale_; }

  // Are there factors or lengths beyond the range in which they are plain numbers?
  bool ranges_far() const { return !scale_exponent_.empty() || !length_exponent_.empty(); }

  // e^{u/2}, by vertex, whatever u is.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  std::vector<Scaled_number<NT> > scales_with_exponents() const
  {
    std::vector<Scaled_number<NT> > result;
    for(Index v = 0; v < scale_.size(); ++v)
      result.push_back(scale_with_exponent(v));
    return result;
  }

  Scaled_number<NT> scale_with_exponent(Index v) const { return Scaled_number<NT>(scale_[v], exponent_of(v, scale_exponent_)); }

  // The scaled sides of the face `f`, in the order of its halfedges, up to a power of two for all three.
  std::array<NT, 3> sides_of(Index f) const { return sides_from(3 * f); }

  // Hess E . d at the u last evaluated, equation (10).
  std::vector<NT> hessian_product(const std::vector<NT>& d) const
  {
    std::vector<NT> result(d.size(), NT(0));
    for(Index e = 0; e < t_.number_of_edges(); ++e)
    {
      const Index i = t_.origin(t_.edge_halfedge(e)), j = t_.target(t_.edge_halfedge(e));
      const NT flux = weight_[e] * (d[i] - d[j]) / 4;
      result[i] += flux;
      result[j] -= flux;
    }
    return result;
  }

protected:
  // Arc tangents of `double` are cheap by vectors; of wider numbers, one for each vertex is enough.
  static constexpr bool sums_up_angles = std::is_same<NT, double>::value;

  // Nothing but the factor e^{u/2}: the next evaluation finds the rest.
  void set_log_scale(Index v, const NT& u)
  {
    using std::exp;
    const double half = static_cast<double>(u) / 2, farthest = 1e8; // beyond that u is of no use, and an exponent might overflow
    const double exponent = std::abs(half) < farthest ? std::round(half / double(ln_2())) : 0;
    const int apart = set_apart(int(exponent), v, t_.number_of_vertices(), scale_exponent_);
    scale_[v] = exp(apart == 0 ? NT(u / 2) : NT(u / 2 - apart * ln_2()));
  }

private:
  static NT ln_2() { return Number_constants<NT>::ln_2(); }

  // Of all vertices; one after the other where exponents may have to be set apart.
  void set_scales(const std::vector<NT>& u)
  {
    using std::abs;
    using std::exp;
    const double safe = 400; // well within what set_apart() leaves as it is
    scale_exponent_.clear();
    if(std::all_of(u.begin(), u.end(), [&](const NT& x) { return abs(x) < safe; }))
      concurrency_.for_each_range(t_.number_of_vertices(), [&](std::size_t first, std::size_t last)
      {
        for(std::size_t v = first; v < last; ++v)
          scale_[v] = exp(u[v] / 2);
      });
    else
      for(Index v = 0; v < t_.number_of_vertices(); ++v)
        set_log_scale(v, u[v]);
  }

  // The exponent `exponent` of the `i`-th of `size` numbers is written to `apart` if three such numbers may have a product out of range. Returns by
  // which power of two the number is to be divided.
  static int set_apart(int exponent, std::size_t i, std::size_t size, std::vector<int>& apart)
  {
    const int largest = 300; // of 1023
    if(std::abs(exponent) <= largest)
      exponent = 0;
    if(exponent != 0 && apart.empty())
      apart.assign(size, 0);
    if(!apart.empty())
      apart[i] = exponent;
    return exponent;
  }

  static int exponent_of(std::size_t i, const std::vector<int>& apart) { return apart.empty() ? 0 : apart[i]; }

  // The sides of the triangle of `h`, beginning with that of `h`.
  std::array<NT, 3> sides_from(Index h) const
  {
    const Index next = Triangulation::next(h), previous = Triangulation::previous(h);
    const Index i = t_.origin(h), j = t_.origin(next), k = t_.origin(previous);
    std::array<NT, 3> result = {{scale_[i] * length_[t_.edge(h)] * scale_[j], scale_[j] * length_[t_.edge(next)] * scale_[k],
                                 scale_[k] * length_[t_.edge(previous)] * scale_[i]}};
    if(ranges_far())
      equalize({{exponent_of_side(i, h, j), exponent_of_side(j, next, k), exponent_of_side(k, previous, i)}}, result);
    return result;
  }

  // What is set apart of the side of `h`, from i to j.
  int exponent_of_side(Index i, Index h, Index j) const
  {
    return exponent_of(i, scale_exponent_) + exponent_of(t_.edge(h), length_exponent_) + exponent_of(j, scale_exponent_);
  }

  // Multiplies sides by 2^`apart`, and all of them by a power of two that brings the longest near 1. What is as good as 0 beside it remains
  // positive.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  static void equalize(const std::array<int, 3>& apart, std::array<NT, 3>& sides)
  {
    using std::ldexp;
    std::array<int, 3> exponents;
    for(int k = 0; k < 3; ++k)
    {
      sides[k] = mantissa(sides[k], exponents[k]);
      exponents[k] += apart[k];
    }
    const int longest = *std::max_element(exponents.begin(), exponents.end()), least = -1000;
    for(int k = 0; k < 3; ++k)
      sides[k] = ldexp(sides[k], (std::max)(exponents[k] - longest, least));
  }

  // The long side of `f` against the two others, each at its longest. Both are compared with the long one: the change of u at the end that they
  // have in common with it cancels.
  bool is_too_long_after(Index f, const std::vector<NT>& d, const NT& most) const
  {
    using std::abs;
    using std::exp;
    const std::array<NT, 3> l = sides_of(f);
    const int k = longest_side(l[0], l[1], l[2]), next = (k + 1) % 3, previous = (k + 2) % 3;
    const auto growth = [&](int end) { return NT(exp(most * abs(d[t_.origin(3 * f + previous)] - d[t_.origin(3 * f + end)]) / 2)); };
    return l[next] * growth(k) + l[previous] * growth(next) < l[k];
  }

  // of the middle between shortest and longest length, logarithmically
  int middle_exponent() const
  {
    using std::frexp;
    int least = (std::numeric_limits<int>::max)(), most = (std::numeric_limits<int>::min)();
    for(const Length& l : t_.lengths())
    {
      int exponent;
      if(!(l > 0))
        continue;
      (void) frexp(l, &exponent);
      least = (std::min)(least, exponent);
      most = (std::max)(most, exponent);
    }
    return least > most ? 0 : least + (most - least) / 2;
  }

  void clear()
  {
    std::fill(product_.begin(), product_.end(), Angle_sum<NT>());
    std::fill(angle_sum_.begin(), angle_sum_.end(), NT(0));
    std::fill(weight_.begin(), weight_.end(), NT(0));
    broken_.clear();
  }

  // Adds all triangles, in their order; returns whether their lengths are positive and finite. Vectors of any width give the same bits, if the
  // program is not compiled for fused multiplications.
  bool add_all_triangles()
  {
    if constexpr(sums_up_angles)
      if(!ranges_far())
        return has_avx2() ? add_all_by_vectors<32>() : add_all_by_vectors<16>();
    return add_triangles(0);
  }

  // Of some thousand triangles at a time angles and cotangents are computed, by several threads, and then added, the ones and the others by one each.
  template <int bytes>
  bool add_all_by_vectors()
  {
    typedef Incircle_vectors<bytes> Triangles;
    const Index all = t_.number_of_faces() / Triangles::lanes, many = (concurrency_.is_sequential() ? 2048 : 65536) / Triangles::lanes;
    std::vector<Triangles> triangles((std::min)(all, many));
    bool is_finite = true;
    for(Index first = 0; first < all; first += many)
    {
      const Index n = (std::min)(many, all - first);
      concurrency_.for_each_range(n, [&](std::size_t from, std::size_t to)
      {
        compute(first + Index(from), first + Index(to), triangles.data() + from);
      });
      if(concurrency_.is_sequential())
        is_finite = add_blocks(first, n, triangles, true, true) && is_finite;
      else
        concurrency_.for_each(2, [&](int part)
        {
          const bool is_right = add_blocks(first, n, triangles, part == 0, part == 1);
          if(part == 0)
            is_finite = is_right && is_finite;
        });
    }
    return add_triangles(all * Triangles::lanes) && is_finite;
  }

  // The blocks of triangles from `first` on, as many as there are lanes in each.
  void compute(Index first, Index last, Incircle_vectors<16>* triangles) const { compute_blocks(first, last, triangles); }
  CGAL_CONFORMAL_EQUIVALENCE_AVX2 void compute(Index first, Index last, Incircle_vectors<32>* triangles) const
  {
    compute_blocks(first, last, triangles);
  }

  template <typename Triangles>
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void compute_blocks(Index first, Index last, Triangles* triangles) const
  {
    for(Index b = first; b < last; ++b)
      compute_block(b * Triangles::lanes, triangles[b - first], typename Triangles::Lanes());
  }

  template <typename Triangles, int... i>
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void compute_block(Index f, Triangles& triangles, std::integer_sequence<int, i...>) const
  {
    typedef typename Triangles::Vector Vector;
    const Index h = 3 * f;
    const Vector s[3] = {{scale_[t_.origin(h + 3 * i)]...}, {scale_[t_.origin(h + 3 * i + 1)]...}, {scale_[t_.origin(h + 3 * i + 2)]...}},
                 l[3] = {{length_[t_.edge(h + 3 * i)]...}, {length_[t_.edge(h + 3 * i + 1)]...}, {length_[t_.edge(h + 3 * i + 2)]...}};
    triangles.compute(s[0] * l[0] * s[1], s[1] * l[1] * s[2], s[2] * l[2] * s[0]);
  }

  // Adds angles, or cotangents, or both, of n blocks; returns whether the lengths are positive and finite.
  template <typename Triangles>
  bool add_blocks(Index first, Index n, const std::vector<Triangles>& triangles, bool adds_angles, bool adds_cotangents)
  {
    bool is_finite = true;
    for(Index b = 0; b < n; ++b)
      for(int i = 0; i < Triangles::lanes; ++i)
      {
        const Index h = 3 * ((first + b) * Triangles::lanes + Index(i));
        if(triangles[b].is_plain[i] == 0)
          is_finite = add_triangle(h, adds_angles, adds_cotangents) && is_finite;
        else
          for(Index k = 0; k < 3; ++k)
          {
            if(adds_angles)
              angle_sum_[t_.apex(h + k)] += triangles[b].angle[k][i];
            if(adds_cotangents)
              weight_[t_.edge(h + k)] += triangles[b].cotangent[k][i];
          }
      }
    return is_finite;
  }

  // The same for those from f on, one by one.
  bool add_triangles(Index f)
  {
    bool is_finite = true;
    for(; f < t_.number_of_faces(); ++f)
      is_finite = add_triangle(3 * f) && is_finite;
    return is_finite;
  }

  // Adds the triangle of h, or only one of both; returns whether its lengths are positive and finite.
  bool add_triangle(Index h, bool adds_angles = true, bool adds_cotangents = true)
  {
    const std::array<NT, 3> l = sides_from(h);
    const Incircle_form<NT> triangle(l[0], l[1], l[2]);
    if(!triangle.is_broken())
    {
      for(int k = 0; k < 3; ++k)
      {
        if(adds_angles)
          add_angle(t_.apex(h + k), triangle, k);
        if(adds_cotangents)
          weight_[t_.edge(h + k)] += cotangent(triangle, k);
      }
    }
    else if(adds_angles)
    {
      broken_.push_back(Triangulation::face(h));
      add_straight_angle(t_.apex(h + longest_side(l[0], l[1], l[2])));
    }
    return l[0] > 0 && l[1] > 0 && l[2] > 0 && triangle.s - triangle.s == NT(0);
  }

  void add_angle(Index v, const Incircle_form<NT>& triangle, int k)
  {
    if constexpr(sums_up_angles)
      angle_sum_[v] += angle(triangle, k);
    else
    {
      const NT unit = 1 / triangle.s;
      product_[v].add(triangle.tangent[k] * unit, triangle.r * unit);
    }
  }

  void add_straight_angle(Index v)
  {
    if constexpr(sums_up_angles)
      angle_sum_[v] += CGAL_PI;
    else
      product_[v].add_straight();
  }

  const Triangulation& t_;
  Concurrency concurrency_;
  int exponent_ = 0; // lengths are divided by this power of two
  std::vector<NT> length_, scale_, angle_sum_, weight_;
  std::vector<int> length_exponent_, scale_exponent_; // set apart from these; empty where there are none
  std::vector<Angle_sum<NT> > product_; // while it is formed, where angles are not summed up
  std::vector<Index> broken_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ENERGY_H
