// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A cone whose angle is a multiple of 2 pi / n.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_QUANTIZED_CONE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_QUANTIZED_CONE_H

#include <cstdint>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

struct Quantized_cone
{
  std::uint32_t vertex;
  long quanta; // the angle sum, in units of 2 pi / n
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SEAMLESS_QUANTIZED_CONE_H
