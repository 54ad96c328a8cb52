// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// A way to metrics to which Newton's method finds none by itself.
//
// On steep surfaces u ranges over hundreds, as it does on long strips, and angles jump from 0 to pi within tiny parts of that: from u = 0
// Newton's method walks among such jumps in circles. They are the wider the nearer lengths are to each other. So lengths l^p, with the same
// triangulation, take the place of l: whichever positive numbers they are, they are Penner coordinates of a surface with the same conditions, for
// which there is a solution as well. From p near 0, where the problem is one of the triangulation alone, p goes to 1 in steps that Newton's
// method copes with.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_TEMPERED_LENGTHS_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_TEMPERED_LENGTHS_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Edge_graph.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The lengths l^p by edge, up to a factor for all of them; for p = 1 those given. \pre They are positive.
template <typename NT>
std::vector<NT> tempered_lengths(const Intrinsic_triangulation<NT>& t, double p)
{
  using std::exp;
  using std::log;
  if(p == 1)
    return t.lengths();
  std::vector<double> logarithm;
  double middle = 0;
  for(const NT& l : t.lengths())
  {
    logarithm.push_back(static_cast<double>(NT(log(l))));
    middle += logarithm.back() / double(t.number_of_edges());
  }
  std::vector<NT> result;
  for(const double x : logarithm)
    result.push_back(NT(exp(NT(p * (x - middle)))));
  return result;
}

// Chooses the exponents p, and where to begin at the next one.
class Tempering
{
public:
  typedef std::vector<double> Vector;

  explicit Tempering(std::size_t number_of_vertices) : u_(number_of_vertices, 0.) {}

  bool is_done() const { return p_ == 1; }
  const Vector& u() const { return u_; } // the solution for the last exponent

  double next_exponent() const
  {
    const double next = p_ + step_, worth_a_step_more = 0.95;
    return next < worth_a_step_more ? next : 1;
  }

  // As u goes on from the last two solutions.
  Vector guess() const
  {
    Vector result = u_;
    for(std::size_t v = 0; v < last_u_.size(); ++v)
      result[v] += (u_[v] - last_u_[v]) * (next_exponent() - p_) / (p_ - last_p_);
    return result;
  }

  // The solution at the next exponent, found in so many steps, is `u`.
  void accept(Vector u, std::size_t number_of_iterations)
  {
    const std::size_t few = 12;
    const double next = next_exponent();
    last_u_ = p_ == 0 ? Vector() : std::move(u_);
    u_ = std::move(u);
    last_p_ = p_;
    p_ = next;
    if(number_of_iterations <= few)
      step_ *= 1.5;
  }

  // It was not found. Returns whether a shorter step is worth a try.
  bool shorten()
  {
    const double shortest = 0.02;
    step_ /= 3;
    return step_ >= shortest;
  }

private:
  double p_ = 0, last_p_ = 0, step_ = 0.2;
  Vector u_, last_u_; // at p_, and at last_p_; the last one is empty until there are two solutions
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_RETRIANGULATION_TEMPERED_LENGTHS_H
