// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Whether there are flat surfaces with given cones and given rotations of the handles at all, whatever their triangulations: what is known.
//
// A closed surface that is flat but for cones whose angles are multiples of 2 pi / n, and turns by such multiples along all loops, is one with a
// differential of order n: in the plane (dz)^n is well-defined. The rotations along loops, those around cones included, form a subgroup of Z_n,
// of an order d; then it is a differential of order d, and no power of one of a lower order. With angle sums 2 pi (1 + a / d) it has zeros of order
// a and poles of order -a, which sum up to d (2 g - 2). These are known to exist, but for
//
//   genus 1   no cones, and d > 1 (a torus without cones turns nowhere);
//             two cones, a = 1 and -1 (Izmestiev, Kusner, Rote, Springborn and Sullivan, 2013, "There is no triangulation of the torus with vertex
//             degrees 5, 6, ..., 6, 7 and related results");
//   genus 2   d = 2 and one cone a = 4, or two cones a = 3 and 1 (Masur and Smillie, 1993, "Quadratic differentials with prescribed singularities
//             and pseudo-Anosov diffeomorphisms");
//
// on spheres by Troyanov, 1986; for d > 2 and genus above 1 there is much (Gendron and Tahar, 2022), but not all of it has been verified here: then a
// surface is expected. What is known hangs on the group alone; which loops turn by how much may in addition be tied by the parity of a spin
// structure.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_SEAMLESS_SIGNATURE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_SEAMLESS_SIGNATURE_H

#include <CGAL/Conformal_equivalence/Flattening_report.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

struct Seamless_signature
{
  std::size_t genus = 0;
  long symmetry = 4;         // n
  std::vector<long> cones;   // angle sums, in units of 2 pi / n
  std::vector<long> loops;   // turnings of a basis of the first homology, in the same units

  // The order d of the group of rotations.
  long order() const
  {
    long divisor = symmetry;
    for(const std::vector<long>* quanta : {&cones, &loops})
      for(long q : *quanta)
        divisor = std::gcd(divisor, q);
    return symmetry / divisor;
  }

  // The orders a of zeros, and -a of poles, of the differential of order d; without those that are 0, in ascending order.
  std::vector<long> orders_of_zeros() const
  {
    std::vector<long> result;
    for(long q : cones)
      if(q != symmetry)
        result.push_back((q - symmetry) * order() / symmetry);
    std::sort(result.begin(), result.end());
    return result;
  }
};

// \pre the angle sums are positive, and satisfy the Gauss-Bonnet formula
inline Surface_existence existence(const Seamless_signature& signature)
{
  const long d = signature.order();
  const std::vector<long> zeros = signature.orders_of_zeros();
  const bool is_exception = (signature.genus == 1 && zeros.empty() && d > 1)
                         || (signature.genus == 1 && zeros == std::vector<long>{-1, 1})
                         || (signature.genus == 2 && d == 2 && (zeros == std::vector<long>{4} || zeros == std::vector<long>{1, 3}));
  if(is_exception)
    return Surface_existence::IMPOSSIBLE;
  return d > 2 && signature.genus > 1 ? Surface_existence::EXPECTED : Surface_existence::PROVEN;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_SEAMLESS_SIGNATURE_H
