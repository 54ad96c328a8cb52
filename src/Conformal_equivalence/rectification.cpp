// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Part of the compiled library: the rectification of seamless layouts, for `double`.

#include <CGAL/Conformal_equivalence/internal/Seamless/Rectification.h>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template Rectification<double>::Rectification(const Intrinsic_triangulation<double>&, const Cut_graph&, const Layout<double>&,
                                              const std::vector<Quantized_cone>&, const Texture_lattice&,
                                              const Rectification_options&, std::unique_ptr<Factorization>);
template Rectification<double>::~Rectification();
template Rectified_layout& Rectification<double>::run();

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL
