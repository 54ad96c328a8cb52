// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The formulas of hyperbolic_triangle.h for a few triangles at once, in `double` and in pairs of these. Every lane computes what one triangle
// would, with the same operations in the same order: so vectors of any width give the same bits, unless the program is compiled for fused
// multiplications. Triangles that need care are left to the formulas of one triangle, as with `Incircle_vectors`.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_INCIRCLE_VECTORS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_INCIRCLE_VECTORS_H

#include <CGAL/Conformal_equivalence/internal/Hyperbolic/hyperbolic_triangle.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double_vector.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Vector_of.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/Incircle_vectors.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/Wide_incircle_vectors.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// Angles of triangles, and their weights in the Hessian.
template <int bytes>
struct Hyperbolic_incircle_vectors : public Triangle_vectors<bytes>
{
  typedef Triangle_vectors<bytes> Base;
  using typename Base::Vector;
  using Base::lanes;

  // Opposite to side k of triangle i.
  double angle[3][lanes], weight[3][lanes];
  double is_plain[lanes]; // 1, or 0 where the triangle, or that of the chords, needs care; then the other numbers are without meaning

  // Triangles by the x = sinh(l/2) of their sides.
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void compute(const Vector (&x)[3])
  {
    Vector y[3], m[3], p[3], excess[3], tangent[3];
    for(int k = 0; k < 3; ++k)
    {
      const Vector square = x[k] * x[k];
      Base::set_root(1. + square, y[k]);
      m[k] = square / (1. + y[k]);
    }
    for(int k = 0; k < 3; ++k)
    {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      p[k] = x[i] * y[j] + y[i] * x[j];
      Base::set_excess(x[k], x[i], x[j], excess[k]);
    }
    const Vector s = p[0] * y[0] + x[0] * (y[1] * y[2] + x[1] * x[2]), unit = 1. / s;
    for(int k = 0; k < 3; ++k)
    {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      tangent[k] = (excess[k] + x[i] * m[j] + x[j] * m[i]) * ((p[k] + x[k]) * unit);
    }
    Vector r, half, is_hyperbolic;
    Base::set_radius(tangent, s, r, is_hyperbolic);
    for(int k = 0; k < 3; ++k)
    {
      Base::set_arc_tangent(r, tangent[k], half);
      Base::store(half + half, angle[k]);
    }
    compute_weights(x, excess, is_hyperbolic);
  }

private:
  // As hyperbolic_weights() has them where the chords form a triangle, of which `excess` is twice that from the corners to the inscribed circle.
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void compute_weights(const Vector (&x)[3], const Vector (&excess)[3], const Vector& is_hyperbolic)
  {
    const Vector tangent[3] = {excess[0] * 0.5, excess[1] * 0.5, excess[2] * 0.5}, s = (x[0] + x[1] + x[2]) * 0.5;
    Vector r, are_chords_plain, cosine, cotangent;
    Base::set_radius(tangent, s, r, are_chords_plain);
    Base::store(is_hyperbolic * are_chords_plain, is_plain);
    const Vector sinh_radius = x[0] / r * (x[1] / s) * x[2] * 0.5;
    Base::set_root(1. + sinh_radius * sinh_radius, cosine);
    const Vector unit = 0.5 / cosine;
    for(int k = 0; k < 3; ++k)
    {
      Base::set_cotangent(r / tangent[k], cotangent);
      Base::store(unit * cotangent, weight[k]);
    }
  }
};

// Of a side, in the order in which they are stored: x = sinh(l/2), cosh(l/2), and that less 1.
constexpr int numbers_per_hyperbolic_side = 3;

// As `Wide_incircle_vectors`, of hyperbolic triangles.
template <int bytes>
struct Wide_hyperbolic_incircle_vectors : public Wide_incircle_results<bytes>
{
  typedef Wide_incircle_results<bytes> Base;
  using typename Base::Numbers;
  using typename Base::Vector;
  using Base::s;
  using Base::tangent;

  // The first numbers of the three sides, their second ones, and their third ones.
  CGAL_CONFORMAL_EQUIVALENCE_INLINE explicit Wide_hyperbolic_incircle_vectors(const Numbers (&side)[3 * numbers_per_hyperbolic_side])
  {
    const Numbers *const x = side, *const y = side + 3, *const m = side + 6;
    Numbers p[3], unit, product;
    for(int k = 0; k < 3; ++k)
    {
      p[k].set_product(x[(k + 1) % 3], y[(k + 2) % 3]);
      product.set_product(y[(k + 1) % 3], x[(k + 2) % 3]);
      p[k].set_sum(p[k], product);
    }
    s.set_product(y[1], y[2]);
    product.set_product(x[1], x[2]);
    s.set_sum(s, product);
    product.set_product(x[0], s);
    s.set_product(p[0], y[0]);
    s.set_sum(s, product);
    const Vector zero = {};
    const Numbers one = {zero + 1., zero};
    unit.set_quotient(one, s);
    for(int k = 0; k < 3; ++k)
      set_tangent(x, m, p[k], unit, k);
    Base::set_square();
  }

private:
  CGAL_CONFORMAL_EQUIVALENCE_INLINE void set_tangent(const Numbers* x, const Numbers* m, const Numbers& p, const Numbers& unit, int k)
  {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    Numbers sum, product;
    Base::set_excess(x[k], x[i], x[j], tangent[k]);
    product.set_product(x[i], m[j]);
    tangent[k].set_sum(tangent[k], product);
    product.set_product(x[j], m[i]);
    tangent[k].set_sum(tangent[k], product);
    sum.set_sum(p, x[k]);
    sum.set_product(sum, unit);
    tangent[k].set_product(tangent[k], sum);
  }
};

// The numbers of the sides with the given x, from `first` to `last`.
template <typename Wide>
void set_hyperbolic_sides(const std::vector<Wide>& x, std::uint32_t first, std::uint32_t last, std::vector<Wide>& result)
{
  for(std::uint32_t e = first; e < last; ++e)
  {
    Wide* const side = &result[numbers_per_hyperbolic_side * std::size_t(e)];
    side[0] = x[e];
    side[1] = hyperbolic_cosine(x[e]);
    side[2] = hyperbolic_cosine_minus_one(x[e], side[1]);
  }
}

// The same by vectors.
template <int bytes>
struct Hyperbolic_side_vectors
{
  typedef Double_double_vector<bytes> Numbers;
  static constexpr int lanes = Numbers::lanes;

  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  void set_sides(const std::vector<Double_double>& x, std::vector<Double_double>& result)
  {
    const std::uint32_t n = std::uint32_t(x.size());
    std::uint32_t e = 0;
    for(; e + lanes <= n; e += lanes)
      set(x, e, result);
    set_hyperbolic_sides(x, e, n, result);
  }

private:
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  void set(const std::vector<Double_double>& all, std::uint32_t e, std::vector<Double_double>& result)
  {
    double hi[3][lanes], lo[3][lanes];
    for(int i = 0; i < lanes; ++i)
    {
      hi[0][i] = all[e + std::uint32_t(i)].hi;
      lo[0][i] = all[e + std::uint32_t(i)].lo;
    }
    const typename Numbers::Vector zero = {};
    const Numbers one = {zero + 1., zero};
    Numbers x, y, m, square;
    x.load(hi[0], lo[0]);
    square.set_product(x, x);
    y.set_sum(one, square);
    y.set_root(y);
    m.set_sum(one, y);
    m.set_quotient(square, m);
    y.store(hi[1], lo[1]);
    m.store(hi[2], lo[2]);
    bool is_finite = true;
    for(int i = 0; i < lanes; ++i)
    {
      is_finite = is_finite && lo[1][i] - lo[1][i] == 0 && lo[2][i] - lo[2][i] == 0;
      for(int k = 0; k < numbers_per_hyperbolic_side; ++k)
        result[numbers_per_hyperbolic_side * std::size_t(e + std::uint32_t(i)) + std::size_t(k)] = Double_double(hi[k][i], lo[k][i]);
    }
    if(!is_finite) // as the square is beyond the range of `double`
      set_hyperbolic_sides(all, e, e + lanes, result);
  }
};

inline void set_hyperbolic_sides_by_pairs(const std::vector<Double_double>& x, std::vector<Double_double>& result)
{
  Hyperbolic_side_vectors<16>::set_sides(x, result);
}

CGAL_CONFORMAL_EQUIVALENCE_AVX2
inline void set_hyperbolic_sides_with_avx2(const std::vector<Double_double>& x, std::vector<Double_double>& result)
{
  Hyperbolic_side_vectors<32>::set_sides(x, result);
}

// Of all sides.
inline std::vector<Double_double> hyperbolic_sides(const std::vector<Double_double>& x)
{
  std::vector<Double_double> result(numbers_per_hyperbolic_side * x.size());
  (has_avx2() ? set_hyperbolic_sides_with_avx2 : set_hyperbolic_sides_by_pairs)(x, result);
  return result;
}

template <typename Wide>
std::vector<Wide> hyperbolic_sides(const std::vector<Wide>& x)
{
  std::vector<Wide> result(numbers_per_hyperbolic_side * x.size(), Wide(0));
  set_hyperbolic_sides(x, 0, std::uint32_t(x.size()), result);
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_HYPERBOLIC_HYPERBOLIC_INCIRCLE_VECTORS_H
