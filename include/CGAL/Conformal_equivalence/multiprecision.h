// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

/// \file multiprecision.h
/// Numbers with as many bits as wanted, for everything here that is a template on the number type.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_MULTIPRECISION_H
#define CGAL_CONFORMAL_EQUIVALENCE_MULTIPRECISION_H

#include <CGAL/license/Surface_mesh_parameterization.h>

#include <boost/multiprecision/mpfr.hpp>

#include <cmath>

namespace CGAL {
namespace Conformal_equivalence {

/// \ingroup PkgConformalEquivalenceSolver
/// A binary floating-point number of MPFR. New ones have the precision that `Working_precision` sets.
typedef boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<0>, boost::multiprecision::et_off> Multiprecision_number;

/// \ingroup PkgConformalEquivalenceSolver
///
/// Sets the precision of new numbers of type `Multiprecision_number`, for as long as it lives. Computations with one
/// precision should all happen within: a number with more bits than the working precision is rounded sooner or later.
class Working_precision
{
public:
  /// sets the precision to at least `bits`.
  explicit Working_precision(unsigned int bits) : before_(Multiprecision_number::default_precision())
  {
    Multiprecision_number::default_precision(static_cast<unsigned int>(std::ceil(bits * .3010299957)));
  }

  /// restores the precision that was set before.
  ~Working_precision() { Multiprecision_number::default_precision(before_); }

  Working_precision(const Working_precision&) = delete;
  Working_precision& operator=(const Working_precision&) = delete;

private:
  unsigned int before_; // in decimal digits
};

} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_MULTIPRECISION_H
