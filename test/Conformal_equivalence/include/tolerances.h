// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// How exactly the tests expect what the package computes, and why so.

#ifndef CGAL_TEST_CONFORMAL_EQUIVALENCE_TOLERANCES_H
#define CGAL_TEST_CONFORMAL_EQUIVALENCE_TOLERANCES_H

namespace testing {

// What one rounding to double changes at most, relatively: 2^-53.
constexpr double unit_roundoff = 1.1102230246251565e-16;

// Relative, of a few products and one exponential or square root, each rounded.
constexpr double few_roundings = 9 * unit_roundoff;

// Radians: the residual at which the solver may stop, unless it is told otherwise. Angle sums at given vertices are right up to this.
constexpr double solver_tolerance = 1e-12;

// In u, where the metric given is the one asked for already: no step is made, or one that only rounding makes, of the sum of some six angles. Their
// rounding, 6 pi 2^-53, is divided by the smallest eigenvalue of the Hessian, which is about 1/4 on the small surfaces of the tests.
constexpr double unmoved_u = 1e-14;

// In u, where the solution is known. Newton's method doubles the number of digits with each step, so that the last one leaves rounding only: 2^-53
// times the condition number of the Hessian (10), which is below 1000 for the some hundred vertices and the shapes of triangles of the tests.
constexpr double rounded_u = 1e-13;

// In u, where two ways to the solution are compared, or triangles are thin, and the last step may have ended just below the solver's
// tolerance: that tolerance divided by the smallest eigenvalue of the Hessian, and what rounding adds.
constexpr double solved_u = 1e-12;

// Radians: the angle sums of a layout, in coordinates. Six angles or more around a vertex, each of coordinates that have been rounded in the unit of
// the whole layout, which is as wide as some tens of edges.
constexpr double layout_angle = 1e-11;

// Relative to the diameter of a layout: lengths, motions and periods in it. Its triangles are laid out one after the other, each with some roundings,
// and there are some hundred from one end to the other.
constexpr double rounded_layout = 1e-13;

// Distances from the centre of a unit sphere, of spheres side by side: each point is moved by up to some hundred, and rounded there.
constexpr double rounded_spheres_side_by_side = 1000 * unit_roundoff;

// Of layouts that come from the whole program, whose files have all digits. Radians; relative, for lengths and areas: each of the some hundred
// triangles on the way from one end of the layout to another may be off by the solver's tolerance, and passes it on.
constexpr double summed_residuals = 100 * solver_tolerance;

// The same, where the way is of some ten triangles, as to their neighbors: for distances in a layout of a diameter of about one.
constexpr double few_residuals = 10 * solver_tolerance;

// The same for differences of two layouts, or of sums over a thousand triangles, each with its own residuals.
constexpr double many_residuals = 1000 * solver_tolerance;

// Sums and differences of some angles that are off by `summed_residuals`, in degrees.
constexpr double summed_residuals_in_degrees = 180 / 3.14159265358979 * summed_residuals;

// Numbers with 200 bits, which are 60 decimal digits, of which some operations may take three.
constexpr double rounding_of_200_bits = 1e-57;

// Numbers of 50 digits, after some thousand operations, relative.
constexpr double wide_rounding = 1e-45;

} // namespace testing

#endif // CGAL_TEST_CONFORMAL_EQUIVALENCE_TOLERANCES_H
