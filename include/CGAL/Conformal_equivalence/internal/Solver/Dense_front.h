// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The dense part of a multifrontal factorization (I. S. Duff and J. K. Reid, "The multifrontal solution of indefinite sparse symmetric linear
// equations", 1983): the first columns of a dense symmetric matrix are eliminated. Most fronts of surfaces have a few columns and some dozen rows,
// for which a call of a BLAS library costs as much as the work. Therefore all is made of one kernel: a strip of up to four columns, from which
// products of columns before are subtracted, held in registers for as many rows as vectors take.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_DENSE_FRONT_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_DENSE_FRONT_H

#include <CGAL/Conformal_equivalence/internal/Concurrency.h>
#include <CGAL/Conformal_equivalence/internal/Numbers/Vector_of.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// What can be done with a front (see below), by vectors of so many bytes.
template <typename Number, int bytes>
class Front_kernel
{
  typedef typename Vector_of<Number, bytes>::type Vector;
  static constexpr int lanes = Vector_of<Number, bytes>::lanes;

  // Columns of a strip. Columns after which the rest of the front is made to follow: the more, the less often it is read and written.
  static constexpr int width = 4;
  typedef std::make_integer_sequence<int, width> Strip;

public:
  static constexpr int block = 64;

  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  bool eliminate(Number* panel, Number* update, int columns, int rows, Number& least_pivot)
  {
    for(int first = 0; first < columns; first += block)
    {
      const int end = (std::min)(first + block, columns);
      if(!eliminate_block(panel, columns, rows, first, end, least_pivot))
        return false;
      subtract_block(panel, update, columns, rows, first, end, end, columns + rows);
    }
    return true;
  }

  // The columns from `first` to `end` by themselves. What has been subtracted from them before, is that of all columns before `first`.
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  bool eliminate_block(Number* panel, int columns, int rows, int first, int end, Number& least_pivot)
  {
    const int size = columns + rows;
    for(int j = first; j < end; j += width)
    {
      const int n = (std::min)(int(width), end - j);
      Number* const strip = panel + std::ptrdiff_t(j) * size + j;
      subtract_products(strip, size, panel + std::ptrdiff_t(first) * size + j, size, size - j, j - first, n, Strip());
      if(!eliminate_strip(strip, size, size - j, n, least_pivot))
        return false;
    }
    return true;
  }

  // Subtracts their products from the columns from `from` to `to`, of the panel or of the update.
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  void subtract_block(Number* panel, Number* update, int columns, int rows, int first, int end, int from, int to)
  {
    const int size = columns + rows;
    for(int j = from; j < to; j += width)
    {
      const bool is_in_panel = j < columns;
      const int step = is_in_panel ? size : rows, stop = is_in_panel ? (std::min)(to, columns) : to, n = (std::min)(int(width), stop - j);
      Number* const strip = is_in_panel ? panel + std::ptrdiff_t(j) * size + j : update + std::ptrdiff_t(j - columns) * rows + j - columns;
      subtract_products(strip, step, panel + std::ptrdiff_t(first) * size + j, size, size - j, end - first, n, Strip());
      if(n < width) // the next strip begins at the next kind of columns
        j = stop - width;
    }
  }

  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  void solve_forward(const Number* panel, int columns, int rows, Number* x)
  {
    const std::ptrdiff_t size = columns + rows;
    for(int j = 0; j < columns; j += width)
    {
      const Number* const l = panel + j * size + j;
      const int n = (std::min)(int(width), columns - j);
      for(int q = 0; q < n; ++q)
      {
        for(int p = 0; p < q; ++p)
          x[j + q] -= l[p * size + q] * x[j + p];
        x[j + q] *= l[q * size + q];
      }
      subtract_columns(x + j, l, size, int(size) - j, n, Strip());
    }
  }

  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  void solve_backward(const Number* panel, int columns, int rows, Number* x)
  {
    const std::ptrdiff_t size = columns + rows;
    for(int j = (columns - 1) / width * width; j >= 0; j -= width)
    {
      const Number* const l = panel + j * size + j;
      const int n = (std::min)(int(width), columns - j);
      Number product[width];
      multiply_columns(x + j, l, size, int(size) - j, n, product, Strip());
      for(int q = n - 1; q >= 0; --q)
      {
        Number sum = x[j + q] - product[q];
        for(int p = q + 1; p < n; ++p)
          sum -= l[q * size + p] * x[j + p];
        x[j + q] = sum * l[q * size + q];
      }
    }
  }

private:
  // (Vectors are not returned by value: how, depends on the processor.)
  template <typename From, typename To>
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void load(const From* p, To& x) { std::memcpy(&x, p, sizeof(x)); }
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void store(const Vector& x, Number* p) { std::memcpy(p, &x, sizeof(x)); }

  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void subtract(const Vector& x, Number* p)
  {
    Vector difference;
    load(p, difference);
    difference -= x;
    store(difference, p);
  }

  // Sets the first n of the numbers at p; the others stay.
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static void store_first(int n, const Vector& x, Number* p)
  {
#if defined(__GNUC__)
    typedef std::conditional_t<sizeof(Number) == 4, std::int32_t, std::int64_t> Integer;
    constexpr int most_lanes = 16;
    static constexpr Integer select[2 * most_lanes] = {-1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1, -1}; // then zeros
    typename Vector_of<Integer, bytes>::type mask, bits, old_bits;
    load(select + most_lanes - (std::min)(n, int(lanes)), mask);
    load(&x, bits);
    load(p, old_bits);
    bits = (bits & mask) | (old_bits & ~mask);
    std::memcpy(p, &bits, sizeof(bits));
#else
    if(n > 0)
      store(x, p);
#endif
  }

  // From the strip c, of `rows` rows and `columns` columns, the products of the rows of `a` with its first ones are subtracted. There are `depth`
  // columns in `a`. (What is computed for columns that a narrow strip does not have is thrown away.)
  template <int... q>
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  void subtract_products(Number* c, std::ptrdiff_t c_step, const Number* a, std::ptrdiff_t a_step, int rows, int depth, int columns,
                         std::integer_sequence<int, q...>)
  {
    if(depth == 0)
      return;
    int i = 0;
    for(; i + 2 * lanes <= rows; i += 2 * lanes)
    {
      Vector s[width] = {}, t[width] = {}, x0, x1;
      const Number *x = a + i, *y = a;
      for(int k = 0; k < depth; ++k, x += a_step, y += a_step)
      {
        load(x, x0);
        load(x + lanes, x1);
        ((s[q] += x0 * y[q], t[q] += x1 * y[q]), ...);
      }
      ((q < columns ? (subtract(s[q], c + q * c_step + i), subtract(t[q], c + q * c_step + i + lanes)) : void()), ...);
    }
    for(; i < rows; i += lanes)
    {
      Vector s[width] = {}, z;
      const Number *x = a + i, *y = a;
      for(int k = 0; k < depth; ++k, x += a_step, y += a_step)
      {
        load(x, z);
        ((s[q] += z * y[q]), ...);
      }
      ((q < columns ? (load(c + q * c_step + i, z), z -= s[q], store_first(rows - i, z, c + q * c_step + i)) : void()), ...);
    }
  }

  // Eliminates up to four columns by themselves.
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  bool eliminate_strip(Number* c, std::ptrdiff_t step, int rows, int columns, Number& least_pivot)
  {
    for(int q = 0; q < columns; ++q)
    {
      Number* const column = c + q * step;
      for(int i = q; i < columns; ++i)
        for(int p = 0; p < q; ++p)
          column[i] -= c[p * step + i] * c[p * step + q];
      const Number pivot = column[q];
      if(!(pivot > 0 && pivot <= (std::numeric_limits<Number>::max)()))
        return false;
      least_pivot = (std::min)(least_pivot, pivot);
      column[q] = 1 / std::sqrt(pivot);
      for(int i = q + 1; i < columns; ++i)
        column[i] *= column[q];
    }
    eliminate_rows(c, step, rows, columns, Strip());
    return true;
  }

  // The rows below the first ones of a strip.
  template <int... q>
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  void eliminate_rows(Number* c, std::ptrdiff_t step, int rows, int columns, std::integer_sequence<int, q...>)
  {
    Vector x[width];
    for(int i = columns; i < rows; i += lanes)
      ((q < columns ? (load(c + q * step + i, x[q]),
                       eliminate_vector(x, x[q], c + q, step, std::make_integer_sequence<int, q>()),
                       store_first(rows - i, x[q], c + q * step + i)) : void()), ...);
  }

  // The next column y of vectors, after the columns x; `l` is its row of L.
  template <int... p>
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  void eliminate_vector([[maybe_unused]] const Vector* x, Vector& y, const Number* l, std::ptrdiff_t step, std::integer_sequence<int, p...>)
  {
    ((y -= x[p] * l[p * step]), ...);
    y *= l[sizeof...(p) * step];
  }

  // x -= L x on the rows below a strip of columns, where x is known on the strip
  template <int... q>
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  void subtract_columns(Number* x, const Number* l, std::ptrdiff_t step, int rows, int columns, std::integer_sequence<int, q...>)
  {
    const Number y[] = {q < columns ? x[q] : Number(0)...};
    const Number* const column[] = {l + (std::min)(q, columns - 1) * step...};
    for(int i = columns; i < rows; i += lanes)
    {
      Vector z, entries;
      load(x + i, z);
      ((load(column[q] + i, entries), z -= entries * y[q]), ...);
      store(z, x + i);
    }
  }

  // the transpose of L times x, for a strip of columns
  template <int... q>
  CGAL_CONFORMAL_EQUIVALENCE_INLINE static
  void multiply_columns(const Number* x, const Number* l, std::ptrdiff_t step, int rows, int columns, Number* product,
                        std::integer_sequence<int, q...>)
  {
    const Number* const column[] = {l + (std::min)(q, columns - 1) * step...};
    Vector s[width] = {}, z, entries;
    for(int i = columns; i < rows; i += lanes)
    {
      load(x + i, z);
      ((load(column[q] + i, entries), s[q] += entries * z), ...);
    }
    ((product[q] = sum(s[q])), ...);
  }

  CGAL_CONFORMAL_EQUIVALENCE_INLINE static Number sum(const Vector& x)
  {
    Number entries[lanes], result = 0;
    std::memcpy(entries, &x, sizeof(x));
    for(Number entry : entries)
      result += entry;
    return result;
  }
};

// A front has `columns` columns to eliminate, and `rows` rows below. The panel holds the former, by columns of columns + rows numbers; the
// update holds the others, by columns of `rows` numbers. Of both the lower half counts. After the elimination the panel is the one of L, but with
// the reciprocals of its diagonal.
//
// Vectors reach beyond the end of columns: what is read there does not matter, and is not changed. So behind each array there must be
// `overhang` numbers, which are finite.
//
// The last bits of the results depend on whether the processor has AVX2.
template <typename Number>
class Dense_front
{
  typedef Front_kernel<Number, 16> Basic_kernel;
  typedef Front_kernel<Number, 32> Wide_kernel;

public:
  static constexpr std::ptrdiff_t overhang = 16;

  // Returns whether all pivots are positive and finite. `least_pivot` becomes the smallest one, if that is less.
  static bool eliminate(Number* panel, Number* update, int columns, int rows, Number& least_pivot)
  {
    return has_avx2_and_fma() ? wide_eliminate(panel, update, columns, rows, least_pivot)
                              : Basic_kernel::eliminate(panel, update, columns, rows, least_pivot);
  }

  // The same by several threads, to the same bits: block by block, what follows it is divided among them. As what vectors reach beyond a column is
  // stored again, parts must not begin at the first columns of the update, of which the next ones have numbers that count so near to their beginning.
  static bool eliminate(Number* panel, Number* update, int columns, int rows, Number& least_pivot, const Concurrency& concurrency)
  {
    constexpr int block = Basic_kernel::block;
    const auto number_of_parts = [](int n) { return (n + block - 1) / block; };
    for(int first = 0; first < columns; first += block)
    {
      const int end = (std::min)(first + block, columns);
      if(!eliminate_block(panel, columns, rows, first, end, least_pivot))
        return false;
      const int parts_of_panel = number_of_parts(columns - end);
      concurrency.for_each(parts_of_panel + number_of_parts(rows), [&](int part)
      {
        const bool is_in_panel = part < parts_of_panel;
        const int from = is_in_panel ? end + part * block : columns + (part - parts_of_panel) * block;
        subtract_block(panel, update, columns, rows, first, end, from, (std::min)(from + block, is_in_panel ? columns : columns + rows));
      });
    }
    return true;
  }

  // Solves with the panel's columns of L: x on the columns, and subtracts what they contribute to the rows below.
  static void solve_forward(const Number* panel, int columns, int rows, Number* x)
  {
    return has_avx2_and_fma() ? wide_solve_forward(panel, columns, rows, x) : Basic_kernel::solve_forward(panel, columns, rows, x);
  }

  // Solves with their transpose: x on the columns, where it is known on the rows below.
  static void solve_backward(const Number* panel, int columns, int rows, Number* x)
  {
    return has_avx2_and_fma() ? wide_solve_backward(panel, columns, rows, x) : Basic_kernel::solve_backward(panel, columns, rows, x);
  }

private:
  static bool eliminate_block(Number* panel, int columns, int rows, int first, int end, Number& least_pivot)
  {
    return has_avx2_and_fma() ? wide_eliminate_block(panel, columns, rows, first, end, least_pivot)
                              : Basic_kernel::eliminate_block(panel, columns, rows, first, end, least_pivot);
  }

  static void subtract_block(Number* panel, Number* update, int columns, int rows, int first, int end, int from, int to)
  {
    return has_avx2_and_fma() ? wide_subtract_block(panel, update, columns, rows, first, end, from, to)
                              : Basic_kernel::subtract_block(panel, update, columns, rows, first, end, from, to);
  }

  CGAL_CONFORMAL_EQUIVALENCE_AVX2_AND_FMA static
  bool wide_eliminate_block(Number* panel, int columns, int rows, int first, int end, Number& least_pivot)
  {
    return Wide_kernel::eliminate_block(panel, columns, rows, first, end, least_pivot);
  }

  CGAL_CONFORMAL_EQUIVALENCE_AVX2_AND_FMA static
  void wide_subtract_block(Number* panel, Number* update, int columns, int rows, int first, int end, int from, int to)
  {
    Wide_kernel::subtract_block(panel, update, columns, rows, first, end, from, to);
  }

  CGAL_CONFORMAL_EQUIVALENCE_AVX2_AND_FMA static bool wide_eliminate(Number* panel, Number* update, int columns, int rows, Number& least_pivot)
  {
    return Wide_kernel::eliminate(panel, update, columns, rows, least_pivot);
  }

  CGAL_CONFORMAL_EQUIVALENCE_AVX2_AND_FMA static void wide_solve_forward(const Number* panel, int columns, int rows, Number* x)
  {
    Wide_kernel::solve_forward(panel, columns, rows, x);
  }

  CGAL_CONFORMAL_EQUIVALENCE_AVX2_AND_FMA static void wide_solve_backward(const Number* panel, int columns, int rows, Number* x)
  {
    Wide_kernel::solve_backward(panel, columns, rows, x);
  }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_DENSE_FRONT_H
