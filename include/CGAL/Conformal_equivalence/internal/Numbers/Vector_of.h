// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Numbers by the vector, for loops that are worth it. One template is compiled for vectors of 16 bytes, which every x86-64 processor has, and
// of 32, for processors with AVX2, and chosen at run time.
//
// A function with a target of its own, such as CGAL_CONFORMAL_EQUIVALENCE_AVX2, is the entry: what it calls must become part of it
// (CGAL_CONFORMAL_EQUIVALENCE_INLINE), and neither takes nor returns vectors by value: how these are handed over depends on the processor.
//
// With AVX2 alone every lane computes what a plain `double` would, bit for bit: sums, products, quotients and square roots are rounded the same
// way everywhere. With fused multiplication (AVX2 and FMA) compilers may round a product and a sum at once.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_VECTOR_OF_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_VECTOR_OF_H

#if defined(__GNUC__)
#  define CGAL_CONFORMAL_EQUIVALENCE_INLINE __attribute__((always_inline))
#else
#  define CGAL_CONFORMAL_EQUIVALENCE_INLINE
#endif

#if defined(__GNUC__) && defined(__x86_64__)
#  define CGAL_CONFORMAL_EQUIVALENCE_AVX2 __attribute__((target("avx2")))
#  define CGAL_CONFORMAL_EQUIVALENCE_AVX2_AND_FMA __attribute__((target("avx2,fma")))
#else
#  define CGAL_CONFORMAL_EQUIVALENCE_AVX2
#  define CGAL_CONFORMAL_EQUIVALENCE_AVX2_AND_FMA
#endif

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// A vector of so many bytes, where the compiler has vectors; else one number.
template <typename Number, int bytes>
struct Vector_of
{
#if defined(__GNUC__)
  typedef Number type __attribute__((vector_size(bytes)));
  static constexpr int lanes = bytes / int(sizeof(Number));
#else
  typedef Number type;
  static constexpr int lanes = 1;
#endif
};

#if defined(__GNUC__) && defined(__x86_64__)
inline bool has_avx2()
{
  static const bool result = __builtin_cpu_supports("avx2");
  return result;
}

inline bool has_avx2_and_fma()
{
  static const bool result = has_avx2() && __builtin_cpu_supports("fma");
  return result;
}
#else
constexpr bool has_avx2() { return false; }
constexpr bool has_avx2_and_fma() { return false; }
#endif

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_VECTOR_OF_H
