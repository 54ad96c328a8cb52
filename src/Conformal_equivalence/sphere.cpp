// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Part of the compiled library: the maps to the sphere and to the disk, for `double`.

#include <CGAL/Conformal_equivalence/internal/Sphere/Disk_cells.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Disk_normalization.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Inscribed_mapping.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Inscribed_polygon.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Sphere_cells.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/Sphere_normalization.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/disk_points.h>
#include <CGAL/Conformal_equivalence/internal/Sphere/sphere_points.h>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

template Ideal_polyhedron<double> Inscribed_mapping<double>::operator()(std::uint32_t, const Accept&) const;
template bool Inscribed_polygon<double>::operator()(Retriangulation);

template bool Sphere_normalization<Double_double>::operator()(Vectors&) const;
template bool Disk_normalization<Double_double>::operator()(const Indexed_disk_frame&, Vectors&) const;

template Sphere_cells<double>::Sphere_cells(const Intrinsic_triangulation<double>&, const Ideal_polyhedron<double>&);
template Disk_cells<double>::Disk_cells(const Intrinsic_triangulation<double>&, const Intrinsic_triangulation<double>&,
                                        const Ideal_polyhedron<double>&);

template std::vector<std::uint32_t> flipped_faces(const Intrinsic_triangulation<double>&, const std::vector<std::array<Double_double, 3> >&);
template std::vector<std::uint32_t> flipped_faces(const Intrinsic_triangulation<double>&, const std::vector<std::array<double, 3> >&);
template std::vector<std::uint32_t> flipped_faces(const Intrinsic_triangulation<double>&, const std::vector<std::array<Double_double, 2> >&);
template std::vector<std::uint32_t> flipped_faces(const Intrinsic_triangulation<double>&, const std::vector<std::array<double, 2> >&);

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL
