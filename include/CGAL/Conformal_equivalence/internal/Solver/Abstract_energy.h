// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// What the solver asks of an energy, whatever surface it is that of: a fixed triangulation, one that is flipped on the way, or the double
// of a surface. Newton's method and the last steps are compiled once for all of them; what an energy does in one call is a pass through
// a whole mesh, beside which a virtual call costs nothing.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ABSTRACT_ENERGY_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ABSTRACT_ENERGY_H

#include <CGAL/Conformal_equivalence/Conformal_conditions.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Edge_graph.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_residual.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// What Newton's method asks, in double.
class Abstract_energy
{
public:
  typedef std::uint32_t Index;

  virtual ~Abstract_energy() = default;

  // moves to u: computes angle sums and edge weights there. Returns false if a length overflows, underflows or is no number.
  virtual bool evaluate(const Vertex_vector& u) = 0;

  virtual const std::vector<double>& angle_sums() const = 0;  // by vertex
  virtual const std::vector<double>& weights() const = 0;     // by edge
  virtual const std::vector<Index>& broken_faces() const = 0; // that violate the triangle inequality

  // How far rounding alone may move the angle sums, in units of epsilon, by vertex.
  virtual std::vector<double> sensitivities() const = 0;

  // Whether `evaluate()` flips edges.
  virtual bool has_flips() const = 0;

  // Moves u at v alone, from x, until the angle sum there is about `target`, or by as much as `most`. Returns the new u. What is
  // known of other vertices is out of date until the next evaluation. (Only where edges are flipped.)
  virtual double relax(Index /* v */, double /* target */, double x, double /* most */, double /* close */) { return x; }

  // The same on a triangulation that stays as it is: minimizes E around some vertices, u being held everywhere else.
  virtual void minimize_around(const std::vector<Index>& /* seeds */, const Edge_graph&, const Vertex_vector& /* target */, Vertex_vector& /* u */) {}

  // The corners of broken faces, and whether one of these faces remains broken for all multiples of d up to `most`. (Only where no edges
  // are flipped.)
  virtual std::vector<Index> broken_corners() const { return std::vector<Index>(); }
  virtual bool stays_broken(const Vertex_vector& /* d */, double /* most */) const { return false; }

  // Were there lengths or factors at the last u that leave the range in which `double` is safe?
  virtual bool ranges_far() const { return false; }

  // How often a vertex was looked at by itself, in all calls of relax().
  virtual std::size_t number_of_probes() const { return 0; }
};

// What the last steps ask, too, which reduce the residual of the wide number type. Factors are s = e^{u / 2}, by vertex.
template <typename NT>
class Refinable_energy : public Abstract_energy
{
public:
  typedef typename Wider_number<NT>::type Wide;
  typedef std::vector<Wide> Factors;

  // How many threads may be used. Results do not depend on it.
  virtual void set_concurrency(const Concurrency& concurrency) = 0;

  // The angle sums less their targets.
  virtual Scaled_vector residual_at(const Factors& s, const Conformal_conditions<NT>& conditions) const = 0;

  // The edge weights of the metric in the wide type, rounded.
  virtual std::vector<double> weights_at(const Factors& s) const = 0;

  // Multiplies `s` by e^{d / 2} for a step d that is computed in the wide type. Returns whether there is one.
  virtual bool add_newton_step(const Edge_graph& graph, const Scaled_vector& residual, Factors& s) const = 0;

  // The faces that violate the triangle inequality, decided exactly.
  virtual std::vector<std::uint32_t> faces_violated_at(const Factors& s) const = 0;

  // Flips what is not Delaunay at the factors s, of which the logarithms are u / 2, beyond the errors of the lengths. Returns whether
  // there were any edges to flip.
  virtual bool make_delaunay(const Factors& /* s */, const Vertex_vector& /* u */) { return false; }

  // Goes back to the triangulation given, as after many flips lengths may be known too little to tell what is Delaunay.
  virtual void take_flips_back() {}
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_ABSTRACT_ENERGY_H
