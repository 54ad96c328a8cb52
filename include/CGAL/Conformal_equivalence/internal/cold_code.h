// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// Code for what is decided once in a million times, or goes wrong, is a good part of this package: numbers that are exact, arithmetic that is
// wider than the usual one, problems with bounds, lattices of tori, ways that are gone where the first has led nowhere. It is compiled in every
// program. Marked as cold, it is made short instead of fast, and nothing is inlined into it nor where it is called: that compiles faster.
//
// What is marked must not be called on every way through a function: compilers take the whole of that function, and what follows in the
// program that calls it, for cold, too.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_COLD_CODE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_COLD_CODE_H

#if defined(__GNUC__)
#  define CGAL_CONFORMAL_EQUIVALENCE_COLD __attribute__((cold))
#else
#  define CGAL_CONFORMAL_EQUIVALENCE_COLD
#endif

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_COLD_CODE_H
