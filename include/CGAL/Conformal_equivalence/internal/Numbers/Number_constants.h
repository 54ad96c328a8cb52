// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_NUMBER_CONSTANTS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_NUMBER_CONSTANTS_H

#include <CGAL/Conformal_equivalence/internal/Numbers/Double_double.h>

#include <boost/math/constants/constants.hpp>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template <typename NT>
struct Number_constants
{
  static NT pi() { return boost::math::constants::pi<NT>(); }
  static NT ln_2() { return boost::math::constants::ln_two<NT>(); }
};

template <>
struct Number_constants<Double_double>
{
  static Double_double pi() { return quick_two_sum(3.141592653589793116, 1.2246467991473531772e-16); }
  static Double_double ln_2() { return quick_two_sum(0.69314718055994528623, 2.3190468138462995584e-17); }
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_NUMBERS_NUMBER_CONSTANTS_H
