// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Angle sums to more digits than `double`. The sum at a vertex is twice the argument of the product of the numbers (s - a) + i r of its
// corners, so no transcendental function is needed.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_ANGLE_SUMS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_ANGLE_SUMS_H

#include <CGAL/Conformal_equivalence/Exact_angle.h>
#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Concurrency.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Complex_number.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double_vector.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Number_constants.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Vector_of.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/Wide_incircle_vectors.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The scaled length of h for the square roots `s` of the scale factors.
template <typename NT, typename Wide>
Wide wide_length(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s, std::uint32_t h)
{
  return s[t.origin(h)] * t.halfedge_length(h) * s[t.target(h)];
}

// The face f with scaled lengths; its side k is the halfedge 3f + k.
template <typename NT, typename Wide>
Incircle_form<Wide> wide_triangle(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s, std::uint32_t f)
{
  return Incircle_form<Wide>(wide_length(t, s, 3 * f), wide_length(t, s, 3 * f + 1), wide_length(t, s, 3 * f + 2));
}

// A sum of triangle corners, as in `Angle_sum`: the half angles as a product, of which the half turns are counted.
template <typename Wide>
class Wide_angle_sum
{
  template <int, typename> friend class Wide_corner_vectors;

  Complex_number<Wide> z_{Wide(1), Wide(0)};
  int half_turns_ = 0;

public:
  // 0 <= arg w <= pi / 2
  void add(const Complex_number<Wide>& w)
  {
    z_ = z_ * w;
    if(z_.im < 0 || (z_.im == 0 && z_.re < 0))
    {
      z_ = {-z_.re, -z_.im};
      ++half_turns_;
    }
    keep_size();
  }

  // e^{i (sum - target) / 2}, up to a positive factor
  template <typename NT>
  Complex_number<Wide> half_difference(const Exact_angle<NT>& target) const
  {
    const Complex_number<Wide> z = half_turns_ % 2 == 0 ? z_ : Complex_number<Wide>{-z_.re, -z_.im};
    if(target.is_exact() && target.units == 2 * Exact_angle<NT>::units_of_pi)
      return {-z.re, -z.im};
    if(target.is_exact() && target.units == Exact_angle<NT>::units_of_pi)
      return {z.im, -z.re};
    return z * unit_complex(Wide(-target.template radians<Wide>() / 2));
  }

  // The multiple of 4 pi by which sum - target differs from `remainder`, twice the argument of `half_difference()`. The sum need be known
  // only up to less than 2 pi: between so many half turns, doubled, and one more.
  template <typename NT>
  double missing_turns(const Exact_angle<NT>& target, double remainder) const
  {
    const double pi = Number_constants<double>::pi(), double_turn = 4 * pi, sum = (2. * half_turns_ + 1) * pi;
    return double_turn * std::round((sum - static_cast<double>(target.radians()) - remainder) / double_turn);
  }

private:
  // Only the argument counts: scales z where it has become small.
  void keep_size()
  {
    const double size = std::abs(static_cast<double>(z_.re)) + std::abs(static_cast<double>(z_.im));
    if(size < 1e-30)
      z_ = {z_.re / size, z_.im / size};
  }
};

// Adds the corners of f, whose incircle form, flat or hyperbolic, is multiplied by `unit`: it has to be about the inverse of its `s`.
template <typename NT, typename Triangle, typename Wide, typename Unit>
void add_corners_of(const Intrinsic_triangulation<NT>& t, std::uint32_t f, const Triangle& triangle, const Unit& unit,
                    std::vector<Wide_angle_sum<Wide> >& sum)
{
  typedef Complex_number<Wide> Complex;
  for(std::uint32_t k = 0; k < 3; ++k)
  {
    if(!triangle.is_broken())
      sum[t.apex(3 * f + k)].add(Complex{triangle.tangent[k] * unit, triangle.r * unit});
    else if(!(triangle.tangent[k] > 0))
      sum[t.apex(3 * f + k)].add(Complex{Wide(0), Wide(1)});
  }
}

// Adds the corners of f. Broken triangles count as in the extended energy.
template <typename NT, typename Triangle, typename Wide>
void add_corners(const Intrinsic_triangulation<NT>& t, std::uint32_t f, const Triangle& triangle, std::vector<Wide_angle_sum<Wide> >& sum)
{
  const double s = static_cast<double>(triangle.s);
  if(std::isnormal(s))
    add_corners_of(t, f, triangle, 1 / s, sum);
  else // out of the range of `double`
    add_corners_of(t, f, triangle, Wide(1 / triangle.s), sum);
}

// The same by its sides `a`, `b` and `c`.
template <typename NT, typename Wide>
void add_corners(const Intrinsic_triangulation<NT>& t, std::uint32_t f, const Wide& a, const Wide& b, const Wide& c,
                 std::vector<Wide_angle_sum<Wide> >& sum)
{
  add_corners(t, f, Incircle_form<Wide>(a, b, c), sum);
}

// How triangles are found from what is known of their sides: as many numbers of each, one after the other.
struct Flat_triangles
{
  static constexpr int numbers_per_side = 1; // the length
  template <int bytes> using Vectors = Wide_incircle_vectors<bytes>;

  static Incircle_form<Double_double> triangle(const Double_double* a, const Double_double* b, const Double_double* c)
  {
    return Incircle_form<Double_double>(*a, *b, *c);
  }
};

// The same for `Double_double`, by vectors: of a few triangles, and then, triangle by triangle, of its three corners, which are added to three
// products. To the same bits, unless the program is compiled for fused multiplications. As with `Incircle_vectors`, triangles that need care
// are left to the functions above.
template <int bytes, typename Triangles = Flat_triangles>
class Wide_corner_vectors
{
  typedef Double_double_vector<bytes>               Numbers;
  typedef typename Numbers::Vector                  Vector;
  typedef typename Numbers::Lanes                   Lanes;
  typedef Intrinsic_triangulation<double>           Triangulation;
  typedef std::vector<Wide_angle_sum<Double_double> > Sums;

public:
  static constexpr int lanes = Numbers::lanes;

  // The vertices of which corners are added: all, or a fourth of them, in pieces of which each has many that are neighbors.
  struct Part
  {
    int number = -1;

    bool is_all() const { return number < 0; }
    bool has(std::uint32_t v) const { return is_all() || int(v / 4096 % 4) == number; }
  };
  static constexpr int number_of_parts = 4;

  // The blocks of triangles from `first` to `last`, as many as there are lanes in each. Returns whether all corners can be added part by part.
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  bool compute_blocks(const Triangulation& t, const std::vector<Double_double>& sides, std::uint32_t first, std::uint32_t last,
                      Wide_corner_vectors* corners)
  {
    bool result = true;
    for(std::uint32_t b = first; b < last; ++b)
    {
      corners[b - first].compute(t, sides, b * lanes);
      for(int i = 0; i < lanes; ++i)
        result = result && corners[b - first].is_plain(t, b * lanes + std::uint32_t(i), i);
    }
    return result;
  }

  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  void add_blocks(const Triangulation& t, const std::vector<Double_double>& sides, std::uint32_t first, std::uint32_t last,
                  const Wide_corner_vectors* corners, Part part, Sums& sums)
  {
    for(std::uint32_t b = first; b < last; ++b)
      for(int i = 0; i < lanes; ++i)
        corners[b - first].add(t, sides, b * lanes + std::uint32_t(i), i, part, sums);
  }

  // The corners of f alone.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  static void add_one(const Triangulation& t, const std::vector<Double_double>& sides, std::uint32_t f, Sums& sums)
  {
    add_corners(t, f, Triangles::triangle(side_of(t, sides, 3 * f), side_of(t, sides, 3 * f + 1), side_of(t, sides, 3 * f + 2)), sums);
  }

private:
  static const Double_double* side_of(const Triangulation& t, const std::vector<Double_double>& sides, std::uint32_t h)
  {
    return &sides[Triangles::numbers_per_side * std::size_t(t.edge(h))];
  }

  // The numbers of the sides of h, h + 3, ...
  template <int... i>
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  void load_sides(const Triangulation& t, const std::vector<Double_double>& sides, std::uint32_t h, Numbers* side, std::integer_sequence<int, i...>)
  {
    const Double_double* const l[] = {side_of(t, sides, h + 3 * i)...};
    for(int n = 0; n < Triangles::numbers_per_side; ++n)
      side[3 * n].load({l[i][n].hi...}, {l[i][n].lo...});
  }

  CGAL_CONFORMAL_EQUIVALENCE_INLINE void compute(const Triangulation& t, const std::vector<Double_double>& sides, std::uint32_t f)
  {
    Numbers side[3 * Triangles::numbers_per_side], r;
    for(std::uint32_t k = 0; k < 3; ++k)
      load_sides(t, sides, 3 * f + k, side + k, Lanes());
    typename Triangles::template Vectors<bytes> triangle(side);
    const Vector unit = 1. / triangle.s.hi;
    Vector plain;
    triangle.set_plain(plain);
    std::memcpy(is_plain_, &plain, sizeof(plain));
    triangle.set_radius(plain, r);
    r.set_product(r, unit);
    r.store(y_hi_, y_lo_);
    for(int k = 0; k < 3; ++k)
    {
      triangle.tangent[k].set_product(triangle.tangent[k], unit);
      triangle.tangent[k].store(x_hi_[k], x_lo_[k]);
    }
  }

  // Triangle i, which is f: are its numbers right, and its corners at three vertices?
  CGAL_CONFORMAL_EQUIVALENCE_INLINE bool is_plain(const Triangulation& t, std::uint32_t f, int i) const
  {
    const std::uint32_t v[] = {t.apex(3 * f), t.apex(3 * f + 1), t.apex(3 * f + 2)};
    return is_plain_[i] != 0 && v[0] != v[1] && v[1] != v[2] && v[2] != v[0];
  }

  CGAL_CONFORMAL_EQUIVALENCE_INLINE
  void add(const Triangulation& t, const std::vector<Double_double>& sides, std::uint32_t f, int i, Part part, Sums& sums) const
  {
    const std::uint32_t v[] = {t.apex(3 * f), t.apex(3 * f + 1), t.apex(3 * f + 2)};
    const bool is_in_part[] = {part.has(v[0]), part.has(v[1]), part.has(v[2])};
    if(!is_in_part[0] && !is_in_part[1] && !is_in_part[2])
      return;
    if(!is_plain(t, f, i))
      return add_one(t, sides, f, sums);
    Wide_angle_sum<Double_double> none;
    Wide_angle_sum<Double_double>* const sum[] = {is_in_part[0] ? &sums[v[0]] : &none, is_in_part[1] ? &sums[v[1]] : &none,
                                                  is_in_part[2] ? &sums[v[2]] : &none, &none};
    const double x_hi[] = {x_hi_[0][i], x_hi_[1][i], x_hi_[2][i], 1}, x_lo[] = {x_lo_[0][i], x_lo_[1][i], x_lo_[2][i], 0};
    for(int k = 0; k < 4; k += lanes)
      multiply(sum + k, x_hi + k, x_lo + k, y_hi_[i], y_lo_[i], Lanes());
  }

  // Multiplies as many products as there are lanes by x + i y.
  template <int... j>
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  void multiply(Wide_angle_sum<Double_double>* const* sum, const double* x_hi, const double* x_lo, double y_hi, double y_lo,
                std::integer_sequence<int, j...>)
  {
    const Vector zero = {}, one = zero + 1.;
    const Numbers x = {{x_hi[j]...}, {x_lo[j]...}}, y = {zero + y_hi, zero + y_lo};
    const Numbers re = {{sum[j]->z_.re.hi...}, {sum[j]->z_.re.lo...}}, im = {{sum[j]->z_.im.hi...}, {sum[j]->z_.im.lo...}};
    Numbers next_re, next_im, product;
    next_re.set_product(re, x);
    product.set_product(im, y);
    next_re.set_difference(next_re, product);
    next_im.set_product(re, y);
    product.set_product(im, x);
    next_im.set_sum(next_im, product);

    const auto is_beyond = (next_im.hi < 0.) | ((next_im.hi == 0.) & (next_re.hi < 0.));
    const Numbers negative_re = {-next_re.hi, -next_re.lo}, negative_im = {-next_im.hi, -next_im.lo};
    const Vector half_turn = is_beyond ? one : zero;
    next_re.select(is_beyond, negative_re, next_re);
    next_im.select(is_beyond, negative_im, next_im);

    double re_hi[lanes], re_lo[lanes], im_hi[lanes], im_lo[lanes], half_turns[lanes];
    next_re.store(re_hi, re_lo);
    next_im.store(im_hi, im_lo);
    std::memcpy(half_turns, &half_turn, sizeof(half_turn));
    ((sum[j]->z_ = {Double_double(re_hi[j], re_lo[j]), Double_double(im_hi[j], im_lo[j])},
      sum[j]->half_turns_ += int(half_turns[j]), sum[j]->keep_size()), ...);
  }

  double x_hi_[3][lanes], x_lo_[3][lanes], y_hi_[lanes], y_lo_[lanes]; // ((s - a) + i r) / s, by side and triangle
  double is_plain_[lanes];
};

// The scaled lengths from `first` on, one by one.
template <typename NT, typename Wide>
void set_wide_lengths(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s, std::uint32_t first, std::uint32_t last,
                      std::vector<Wide>& result)
{
  for(std::uint32_t e = first; e < last; ++e)
    result[e] = wide_length(t, s, t.edge_halfedge(e));
}

// The same for `Double_double`, by vectors.
template <int bytes>
class Wide_length_vectors
{
  typedef Double_double_vector<bytes>     Numbers;
  typedef typename Numbers::Vector        Vector;
  typedef Intrinsic_triangulation<double> Triangulation;
  static constexpr int lanes = Numbers::lanes;

public:
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  void set_lengths(const Triangulation& t, const std::vector<Double_double>& s, std::uint32_t first, std::uint32_t last,
                   std::vector<Double_double>& result)
  {
    std::uint32_t e = first;
    for(; e + lanes <= last; e += lanes)
      set(t, s, e, result, typename Numbers::Lanes());
    set_wide_lengths(t, s, e, last, result);
  }

private:
  template <int... i>
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  void set(const Triangulation& t, const std::vector<Double_double>& s, std::uint32_t e, std::vector<Double_double>& result,
           std::integer_sequence<int, i...>)
  {
    const std::uint32_t h[] = {t.edge_halfedge(e + i)...};
    const Double_double* const from[] = {&s[t.origin(h[i])]...};
    const Double_double* const to[] = {&s[t.target(h[i])]...};
    const Numbers x = {{from[i]->hi...}, {from[i]->lo...}}, y = {{to[i]->hi...}, {to[i]->lo...}};
    Numbers product;
    product.set_product(x, Vector{t.length(e + i)...});
    product.set_product(product, y);
    double hi[lanes], lo[lanes];
    product.store(hi, lo);
    ((result[e + i] = Double_double(hi[i], lo[i])), ...);
    const bool is_finite = ((lo[i] - lo[i] == 0) && ...);
    if(!is_finite) // as there are factors beyond 2^996
      set_wide_lengths(t, s, e, e + lanes, result);
  }
};

// The entries of the above, for vectors of either width.
template <int bytes, typename Triangles = Flat_triangles>
struct Wide_vectors
{
  typedef Intrinsic_triangulation<double>             Triangulation;
  typedef std::vector<Double_double>                  Numbers;
  typedef std::vector<Wide_angle_sum<Double_double> > Sums;
  typedef std::uint32_t                               Index;
  typedef Wide_corner_vectors<bytes, Triangles>       Corners;

  static void set_lengths(const Triangulation& t, const Numbers& s, Index first, Index last, Numbers& result)
  {
    Wide_length_vectors<bytes>::set_lengths(t, s, first, last, result);
  }

  static bool compute(const Triangulation& t, const Numbers& sides, Index first, Index last, Corners* corners)
  {
    return Corners::compute_blocks(t, sides, first, last, corners);
  }

  static void add(const Triangulation& t, const Numbers& sides, Index first, Index last, const Corners* corners, typename Corners::Part part,
                  Sums& sums)
  {
    Corners::add_blocks(t, sides, first, last, corners, part, sums);
  }
};

template <typename Triangles = Flat_triangles>
struct Wide_vectors_with_avx2 : public Wide_vectors<32, Triangles>
{
  typedef Wide_vectors<32, Triangles> Base;
  using typename Base::Corners;
  using typename Base::Index;
  using typename Base::Numbers;
  using typename Base::Sums;
  using typename Base::Triangulation;

  CGAL_CONFORMAL_EQUIVALENCE_AVX2 static
  void set_lengths(const Triangulation& t, const Numbers& s, Index first, Index last, Numbers& result)
  {
    Wide_length_vectors<32>::set_lengths(t, s, first, last, result);
  }

  CGAL_CONFORMAL_EQUIVALENCE_AVX2 static
  bool compute(const Triangulation& t, const Numbers& sides, Index first, Index last, Corners* corners)
  {
    return Corners::compute_blocks(t, sides, first, last, corners);
  }

  CGAL_CONFORMAL_EQUIVALENCE_AVX2 static
  void add(const Triangulation& t, const Numbers& sides, Index first, Index last, const Corners* corners, typename Corners::Part part, Sums& sums)
  {
    Corners::add_blocks(t, sides, first, last, corners, part, sums);
  }
};

// The scaled lengths, by edge.
template <typename NT, typename Wide>
std::vector<Wide> wide_lengths(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s)
{
  std::vector<Wide> result(t.number_of_edges(), Wide(0));
  if constexpr(std::is_same<NT, double>::value && std::is_same<Wide, Double_double>::value)
    (has_avx2() ? Wide_vectors_with_avx2<>::set_lengths : Wide_vectors<16>::set_lengths)(t, s, 0, t.number_of_edges(), result);
  else
    set_wide_lengths(t, s, 0, t.number_of_edges(), result);
  return result;
}

// The corners of some thousand triangles at a time are computed by several threads, and added by several, too, each of which has vertices of its
// own. Only where triangles need care, one thread adds them all.
template <typename Vectors>
void add_wide_corners_by(const Intrinsic_triangulation<double>& t, const std::vector<Double_double>& sides,
                         std::vector<Wide_angle_sum<Double_double> >& sum, const Concurrency& concurrency)
{
  typedef typename Vectors::Corners Corners;
  typedef std::uint32_t Index;
  const Index all = t.number_of_faces() / Corners::lanes, many = (concurrency.is_sequential() ? 1024 : 65536) / Corners::lanes;
  std::vector<Corners> corners((std::min)(all, many));
  for(Index first = 0; first < all; first += many)
  {
    const Index n = (std::min)(many, all - first);
    std::atomic<bool> are_plain(!concurrency.is_sequential());
    concurrency.for_each_range(n, [&](std::size_t from, std::size_t to)
    {
      if(!Vectors::compute(t, sides, first + Index(from), first + Index(to), corners.data() + from))
        are_plain = false;
    });
    const bool has_parts = are_plain;
    concurrency.for_each(has_parts ? Corners::number_of_parts : 1, [&](int part)
    {
      Vectors::add(t, sides, first, first + n, corners.data(), typename Corners::Part{has_parts ? part : -1}, sum);
    });
  }
  for(Index f = all * Corners::lanes; f < t.number_of_faces(); ++f)
    Corners::add_one(t, sides, f, sum);
}

// Lengths are computed by several threads, too.
template <typename Vectors>
void add_wide_angles_by(const Intrinsic_triangulation<double>& t, const std::vector<Double_double>& s, std::vector<Double_double>& length,
                        std::vector<Wide_angle_sum<Double_double> >& sum, const Concurrency& concurrency)
{
  typedef std::uint32_t Index;
  concurrency.for_each_range(t.number_of_edges(), [&](std::size_t first, std::size_t last)
  {
    Vectors::set_lengths(t, s, Index(first), Index(last), length);
  });
  add_wide_corners_by<Vectors>(t, length, sum, concurrency);
}

inline void add_wide_angles(const Intrinsic_triangulation<double>& t, const std::vector<Double_double>& s, std::vector<Double_double>& length,
                            std::vector<Wide_angle_sum<Double_double> >& sum, const Concurrency& concurrency)
{
  if(has_avx2())
    add_wide_angles_by<Wide_vectors_with_avx2<> >(t, s, length, sum, concurrency);
  else
    add_wide_angles_by<Wide_vectors<16> >(t, s, length, sum, concurrency);
}

template <typename NT, typename Wide>
void add_wide_angles(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s, std::vector<Wide>& length,
                     std::vector<Wide_angle_sum<Wide> >& sum, const Concurrency&)
{
  set_wide_lengths(t, s, 0, t.number_of_edges(), length);
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
    add_corners(t, f, length[t.edge(3 * f)], length[t.edge(3 * f + 1)], length[t.edge(3 * f + 2)], sum);
}

// The angle sums, by vertex, for the square roots `s` of the scale factors.
template <typename NT, typename Wide>
std::vector<Wide_angle_sum<Wide> > wide_angle_sums(const Intrinsic_triangulation<NT>& t, const std::vector<Wide>& s,
                                                   const Concurrency& concurrency = Concurrency())
{
  std::vector<Wide_angle_sum<Wide> > result(t.number_of_vertices());
  std::vector<Wide> length(t.number_of_edges(), Wide(0));
  add_wide_angles(t, s, length, result, concurrency);
  return result;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_WIDE_ANGLE_SUMS_H
