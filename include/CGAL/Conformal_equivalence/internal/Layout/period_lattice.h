// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The lattice of a flat torus, from the motions across the edges along which it was
// cut. These motions generate the group of all motions that take the development of
// the torus to itself; without cones they are translations, and their group is a lattice.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_PERIOD_LATTICE_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_PERIOD_LATTICE_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/triangle_formulas.h>
#include <CGAL/Conformal_equivalence/internal/cold_code.h>
#include <CGAL/Conformal_equivalence/internal/stable_order.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// z -> rotation * z + translation, from the layout of one face to that of its neighbor across a cut edge.
template <typename NT>
struct Cut_motion
{
  typedef Complex_number<NT> Complex;
  std::uint32_t from_piece, to_piece;
  Complex rotation, translation;
  double length; // of the edge: the motion across a long edge is known best

  Complex operator()(const Complex& z) const;
  Cut_motion inverse() const;
  Cut_motion after(const Cut_motion& b) const; // first `b`, then this
};

// Outside of the class, as what is inside is asked to be inlined, and products of wide numbers are long.

template <typename NT>
Complex_number<NT> Cut_motion<NT>::operator()(const Complex& z) const { return rotation * z + translation; }

template <typename NT>
Cut_motion<NT> Cut_motion<NT>::inverse() const
{
  const Complex r = conj(rotation);
  return {to_piece, from_piece, r, -(r * translation), length};
}

template <typename NT>
Cut_motion<NT> Cut_motion<NT>::after(const Cut_motion& b) const
{
  return {b.from_piece, to_piece, rotation * b.rotation, (*this)(b.translation), length};
}

// Reductions end by themselves, as numbers become smaller; rounding must not make them go round in circles. A pair of `double` of any
// size whatever is reduced in some hundred steps.
constexpr int maximum_number_of_reduction_steps = 1000;

// How far the quotient of two periods may be from the border of the fundamental domain and still count as lying on it, so that square and
// hexagonal tori get the same basis however they were rounded.
constexpr double fundamental_domain_tolerance = 1e-10;

// What is not longer than this, relative to the lengths that take part, is no period but the error of one ...
constexpr double period_tolerance = 1e-9;

// ... and a motion that turns by no more than this, in radians, is a translation. Cones turn by far more.
constexpr double rotation_tolerance = 1e-6;

// A lattice given by ever more generators, each known up to some error: what is not longer than
// the error is no vector.
template <typename NT>
class Reduced_basis
{
  typedef Complex_number<NT> Complex;
  std::vector<Complex> basis_; // at most two, reduced
  double error_;

  static Complex minus(const Complex& a, const Complex& b, double times) { return {a.re - times * b.re, a.im - times * b.im}; }

  // Subtracts the vector of the lattice that is nearest, or nearly so.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  Complex reduced(Complex z) const
  {
    if(basis_.size() == 2)
    {
      const NT area = cross_product(basis_[0], basis_[1]);
      const double x = static_cast<double>(NT(cross_product(z, basis_[1]) / area));
      const double y = static_cast<double>(NT(cross_product(basis_[0], z) / area));
      z = minus(minus(z, basis_[0], std::round(x)), basis_[1], std::round(y));
    }
    else if(basis_.size() == 1)
      z = minus(z, basis_[0], std::round(static_cast<double>(NT(dot_product(z, basis_[0]) / square_norm(basis_[0])))));
    return z;
  }

  bool are_independent(const Complex& a, const Complex& b) const
  {
    return std::abs(static_cast<double>(cross_product(a, b))) > error_ * (std::max)(size_of(a), size_of(b));
  }

  // Lagrange and Gauss: the shorter one first, the other as short as it can be.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  void reduce_pair()
  {
    for(int step = 0; step < maximum_number_of_reduction_steps; ++step)
    {
      if(size_of(basis_[1]) < size_of(basis_[0]))
        std::swap(basis_[0], basis_[1]);
      const double times = std::round(static_cast<double>(NT(dot_product(basis_[0], basis_[1]) / square_norm(basis_[0]))));
      if(times == 0)
        break;
      basis_[1] = minus(basis_[1], basis_[0], times);
    }
  }

public:
  explicit Reduced_basis(double error) : error_(error) {}

  // Euclid's algorithm: what is left of the generator replaces the longest vector, which becomes the next generator.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  void insert(Complex z)
  {
    for(int step = 0; step < maximum_number_of_reduction_steps; ++step)
    {
      z = reduced(z);
      if(!(size_of(z) > error_))
        return;
      if(basis_.empty() || (basis_.size() == 1 && are_independent(basis_[0], z)))
      {
        basis_.push_back(z);
        if(basis_.size() == 2)
          reduce_pair();
        return;
      }
      std::swap(basis_.back(), z);
      if(basis_.size() == 2 && !are_independent(basis_[0], basis_[1]))
        std::swap(basis_[0], z);
      if(basis_.size() == 2)
        reduce_pair();
    }
  }

  bool is_complete() const { return basis_.size() == 2; }

  // The basis whose quotient is in the standard fundamental domain.
  CGAL_CONFORMAL_EQUIVALENCE_COLD
  std::pair<Complex, Complex> standard_basis() const
  {
    Complex a = basis_[0], b = basis_[1];
    if(cross_product(a, b) < NT(0))
      b = -b;
    const double boundary = fundamental_domain_tolerance;
    const auto re_tau = [&] { return static_cast<double>(NT(dot_product(a, b) / square_norm(a))); };
    if(re_tau() < -.5 + boundary)
      b = minus(b, a, -1);
    if(size_of(b) < (1 + boundary) * size_of(a) && re_tau() < -boundary)
    {
      std::swap(a, b);
      b = -b;
    }
    return {a, b};
  }
};

// The lattice that the motions across the cut edges of one torus generate; nothing if it has cones. `first_piece` is
// the one whose coordinates count.
template <typename NT>
CGAL_CONFORMAL_EQUIVALENCE_COLD
Reduced_basis<NT> period_basis(const std::vector<Cut_motion<NT> >& given, std::uint32_t first_piece, std::uint32_t number_of_pieces)
{
  typedef Cut_motion<NT> Motion;
  typedef Complex_number<NT> Complex;
  std::vector<Motion> motions; // from the longest to the shortest
  motions.reserve(given.size());
  for(std::uint32_t i : stable_order(given.size(), [&](std::uint32_t i, std::uint32_t j) { return given[i].length > given[j].length; }))
    motions.push_back(given[i]);

  // motions to the first piece, along a tree of pieces
  std::vector<std::vector<std::size_t> > of_piece(number_of_pieces);
  for(std::size_t i = 0; i < motions.size(); ++i)
  {
    of_piece[motions[i].from_piece].push_back(i);
    of_piece[motions[i].to_piece].push_back(i);
  }
  std::vector<Motion> home(number_of_pieces, Motion{0, 0, Complex{NT(0), NT(0)}, Complex{NT(0), NT(0)}, 0});
  std::vector<char> is_reached(number_of_pieces, 0);
  std::vector<std::uint32_t> reached(1, first_piece);
  home[first_piece] = {first_piece, first_piece, Complex{NT(1), NT(0)}, Complex{NT(0), NT(0)}, 0};
  is_reached[first_piece] = 1;
  for(std::size_t k = 0; k < reached.size(); ++k)
    for(std::size_t i : of_piece[reached[k]])
    {
      const bool is_outward = motions[i].from_piece == reached[k];
      const std::uint32_t other = is_outward ? motions[i].to_piece : motions[i].from_piece;
      if(is_reached[other])
        continue;
      is_reached[other] = 1;
      home[other] = home[reached[k]].after(is_outward ? motions[i].inverse() : motions[i]);
      reached.push_back(other);
    }

  double longest = 0; // of all lengths that take part
  for(Motion& motion : motions)
  {
    const double length = motion.length;
    motion = home[motion.to_piece].after(motion.after(home[motion.from_piece].inverse()));
    longest = (std::max)(longest, (std::max)(length, size_of(motion.translation)));
  }
  Reduced_basis<NT> basis(period_tolerance * longest);
  for(const Motion& motion : motions)
  {
    if(std::abs(static_cast<double>(motion.rotation.re) - 1) + std::abs(static_cast<double>(motion.rotation.im)) > rotation_tolerance)
      return Reduced_basis<NT>(0);
    basis.insert(motion.translation);
  }
  return basis;
}

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_LAYOUT_PERIOD_LATTICE_H
