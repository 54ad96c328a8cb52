// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The triangles of one front of a development, that is, of the same distance from the first one: each of them depends on those of the front
// before alone, so that they can be laid out by vectors.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_DEVELOPMENT_STEPS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_DEVELOPMENT_STEPS_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Complex_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double_vector.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Vector_of.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_angle_sums.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/Wide_incircle_vectors.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A halfedge h of which both ends are placed, and what is wanted of the triangle on its left. `none` is what is not wanted.
struct Development_step
{
  static constexpr std::uint32_t none = (std::numeric_limits<std::uint32_t>::max)();

  std::uint32_t edges[3];                     // of h, the next and the previous side
  std::uint32_t side;                         // h in its front
  std::uint32_t origin, apex;                 // wedges; the apex is placed
  std::uint32_t beyond_next, beyond_previous; // in the next front: the two sides from beyond, whose directions are set
};

template <typename Wide>
struct Development_front
{
  typedef Complex_number<Wide> Complex;

  struct Side
  {
    std::uint32_t halfedge;
    Complex direction; // of absolute value 1
  };

  std::vector<Wide> length;      // by edge
  std::vector<Complex> position; // by wedge
  std::vector<Side> sides, next_sides;
  std::vector<Development_step> steps;

  void lay_out(const Development_step& step)
  {
    const Wide& along = length[step.edges[2]];
    const Incircle_form<Wide> triangle(length[step.edges[0]], length[step.edges[1]], along);
    const Complex& direction = sides[step.side].direction;
    if(step.beyond_next != step.none)
      next_sides[step.beyond_next].direction = direction * conj(rotation(triangle, 2));
    if(step.beyond_previous == step.none && step.apex == step.none)
      return;
    const Complex to_apex = direction * rotation(triangle, 1);
    if(step.apex != step.none)
      position[step.apex] = position[step.origin] + along * to_apex;
    if(step.beyond_previous != step.none)
      next_sides[step.beyond_previous].direction = to_apex;
  }
};

// A few steps at once, to the same bits, unless the program is compiled for fused multiplications. Triangles that need care are left to the
// function above.
template <int bytes>
class Development_vectors
{
  typedef Double_double_vector<bytes>       Numbers;
  typedef typename Numbers::Vector          Vector;
  typedef typename Numbers::Lanes           Lanes;
  typedef Development_front<Double_double>  Front;
  typedef Front::Complex                    Complex;
  static constexpr int lanes = Numbers::lanes;

  struct Complex_vector
  {
    Numbers re, im;

    // Gathered from their addresses.
    template <int... i>
    CGAL_CONFORMAL_EQUIVALENCE_INLINE void load(const Complex* const* z, std::integer_sequence<int, i...>)
    {
      re.load({z[i]->re.hi...}, {z[i]->re.lo...});
      im.load({z[i]->im.hi...}, {z[i]->im.lo...});
    }

    CGAL_CONFORMAL_EQUIVALENCE_INLINE void set_product(const Complex_vector& x, const Complex_vector& y)
    {
      Numbers product;
      re.set_product(x.re, y.re);
      product.set_product(x.im, y.im);
      re.set_difference(re, product);
      im.set_product(x.re, y.im);
      product.set_product(x.im, y.re);
      im.set_sum(im, product);
    }

    // e^{i alpha}, as rotation() has it
    CGAL_CONFORMAL_EQUIVALENCE_INLINE void set_rotation(const Numbers& x, const Numbers& y)
    {
      const auto is_obtuse = (x.hi < y.hi) | ((x.hi == y.hi) & (x.lo < y.lo));
      const Vector zero = {};
      const Numbers one = {zero + 1., zero};
      Numbers less, more, square, denominator, negative;
      less.select(is_obtuse, x, y);
      more.select(is_obtuse, y, x);
      less.set_quotient(less, more);
      square.set_product(less, less);
      denominator.set_sum(square, one);
      re.set_difference(one, square);
      re.set_quotient(re, denominator);
      negative = {-re.hi, -re.lo};
      re.select(is_obtuse, negative, re);
      less = {less.hi + less.hi, less.lo + less.lo};
      im.set_quotient(less, denominator);
    }
  };

  // What becomes of so many complex numbers, one by one.
  struct Results
  {
    double re_hi[lanes], re_lo[lanes], im_hi[lanes], im_lo[lanes];

    CGAL_CONFORMAL_EQUIVALENCE_INLINE explicit Results(const Complex_vector& z)
    {
      z.re.store(re_hi, re_lo);
      z.im.store(im_hi, im_lo);
    }

    CGAL_CONFORMAL_EQUIVALENCE_INLINE void write(int i, Complex& z) const
    {
      z.re = Double_double(re_hi[i], re_lo[i]);
      z.im = Double_double(im_hi[i], im_lo[i]);
    }
  };

public:
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void lay_out(Front& front)
  {
    for(std::size_t k = 0; k < front.steps.size(); k += lanes)
      lay_out(front, k, Lanes());
  }

private:
  // The steps from k on; where there are less than lanes, the last one several times.
  template <int... i>
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void lay_out(Front& front, std::size_t k, std::integer_sequence<int, i...> all)
  {
    const Development_step* const step[] = {&front.steps[(std::min)(k + std::size_t(i), front.steps.size() - 1)]...};
    Numbers side[3], r;
    for(int j = 0; j < 3; ++j)
    {
      const Double_double* const l[] = {&front.length[step[i]->edges[j]]...};
      side[j].load({l[i]->hi...}, {l[i]->lo...});
    }
    const Wide_incircle_vectors<bytes> triangle(side);
    const Vector zero = {};
    Vector plain;
    triangle.set_plain(plain);
    plain = triangle.s.hi < 1e250 ? plain : zero;
    double is_plain[lanes];
    std::memcpy(is_plain, &plain, sizeof(plain));
    triangle.set_radius(plain, r);

    const Complex* const from[] = {&front.sides[step[i]->side].direction...};
    const Complex* const origin[] = {&front.position[step[i]->origin]...};
    Complex_vector direction, turn, beyond_next, to_apex, apex;
    direction.load(from, all);
    apex.load(origin, all);
    turn.set_rotation(triangle.tangent[2], r);
    turn.im = {-turn.im.hi, -turn.im.lo};
    beyond_next.set_product(direction, turn);
    turn.set_rotation(triangle.tangent[1], r);
    to_apex.set_product(direction, turn);
    r.set_product(side[2], to_apex.re);
    apex.re.set_sum(apex.re, r);
    r.set_product(side[2], to_apex.im);
    apex.im.set_sum(apex.im, r);
    const Results next(beyond_next), previous(to_apex), place(apex);
    ((is_plain[i] != 0 ? write(front, *step[i], i, next, previous, place) : front.lay_out(*step[i])), ...);
  }

  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void write(Front& front, const Development_step& step, int i, const Results& next,
                                                      const Results& previous, const Results& place)
  {
    if(step.beyond_next != step.none)
      next.write(i, front.next_sides[step.beyond_next].direction);
    if(step.beyond_previous != step.none)
      previous.write(i, front.next_sides[step.beyond_previous].direction);
    if(step.apex != step.none)
      place.write(i, front.position[step.apex]);
  }
};

CGAL_CONFORMAL_EQUIVALENCE_AVX2 inline void lay_out_steps_with_avx2(Development_front<Double_double>& front)
{
  Development_vectors<32>::lay_out(front);
}

template <typename Wide>
void lay_out_steps(Development_front<Wide>& front)
{
  if constexpr(std::is_same<Wide, Double_double>::value)
    if(has_avx2())
      return lay_out_steps_with_avx2(front);
  for(const Development_step& step : front.steps)
    front.lay_out(step);
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_DEVELOPMENT_STEPS_H
