// Copyright (c) 2026  The Conformal_equivalence developers.
// SPDX-License-Identifier: GPL-3.0-or-later

// The energy on a triangulation that stays as it is, as the solver takes it.

#ifndef CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_FIXED_ENERGY_H
#define CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_FIXED_ENERGY_H

#include <CGAL/Conformal_equivalence/Intrinsic_triangulation.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Abstract_energy.h>
#include <CGAL/Conformal_equivalence/internal/Solver/Patchwise_energy.h>
#include <CGAL/Conformal_equivalence/internal/Solver/wide_newton_step.h>
#include <CGAL/Conformal_equivalence/internal/Triangles/length_predicates.h>

#include <cstdint>
#include <vector>

namespace CGAL {
namespace Conformal_equivalence {
namespace internal {

// The faces of a surface that violate the triangle inequality at the factors s, decided exactly.
template <typename Surface, typename Wide>
std::vector<std::uint32_t> violated_faces(const Surface& t, const std::vector<Wide>& s, const Concurrency& concurrency = Concurrency())
{
  std::vector<char> is_violated(t.number_of_faces(), 0);
  concurrency.for_each_range(is_violated.size(), [&](std::size_t first, std::size_t last)
  {
    for(std::uint32_t f = std::uint32_t(first); f < last; ++f)
      is_violated[f] = !is_scaled_triangle(s[t.origin(3 * f)], s[t.origin(3 * f + 1)], s[t.origin(3 * f + 2)],
                                           Wide(t.halfedge_length(3 * f)), Wide(t.halfedge_length(3 * f + 1)), Wide(t.halfedge_length(3 * f + 2)));
  });
  std::vector<std::uint32_t> result;
  for(std::uint32_t f = 0; f < t.number_of_faces(); ++f)
    if(is_violated[f])
      result.push_back(f);
  return result;
}

// What the last steps ask of an energy, answered for a `Surface`: a triangulation, or the double of one, folded.
template <typename NT, typename Surface>
class Energy_on_surface : public Refinable_energy<NT>
{
  typedef Refinable_energy<NT> Base;

public:
  typedef typename Base::Factors Factors;

  // Keeps a reference to `t`.
  explicit Energy_on_surface(const Surface& t) : surface_(t) {}

  void set_concurrency(const Concurrency& concurrency) override { concurrency_ = concurrency; }

  Scaled_vector residual_at(const Factors& s, const Conformal_conditions<NT>& conditions) const override
  {
    return scaled_wide_residual(surface_, s, conditions, concurrency_);
  }

  std::vector<double> weights_at(const Factors& s) const override { return wide_weights(surface_, s); }

  bool add_newton_step(const Edge_graph& graph, const Scaled_vector& residual, Factors& s) const override
  {
    return add_wide_newton_step(surface_, graph, residual, s);
  }

  std::vector<std::uint32_t> faces_violated_at(const Factors& s) const override { return violated_faces(surface_, s, concurrency_); }

protected:
  const Surface& surface() const { return surface_; }

private:
  const Surface& surface_;
  Concurrency concurrency_;
};

template <typename NT>
class Fixed_energy final : public Energy_on_surface<NT, Intrinsic_triangulation<NT> >
{
  typedef Energy_on_surface<NT, Intrinsic_triangulation<NT> > Base;

public:
  // Keeps a reference to `t`, which must not change. `normalize` as for `Conformal_energy`.
  explicit Fixed_energy(const Intrinsic_triangulation<NT>& t, bool normalize = false) : Base(t), energy_(t, normalize) {}

  void set_concurrency(const Concurrency& concurrency) override
  {
    Base::set_concurrency(concurrency);
    energy_.set_concurrency(concurrency);
  }

  bool evaluate(const Vertex_vector& u) override { return energy_.evaluate(u); }
  const std::vector<double>& angle_sums() const override { return energy_.angle_sums(); }
  const std::vector<double>& weights() const override { return energy_.weights(); }
  const std::vector<std::uint32_t>& broken_faces() const override { return energy_.broken_faces(); }
  std::vector<double> sensitivities() const override { return energy_.sensitivities(); }
  bool has_flips() const override { return false; }
  bool ranges_far() const override { return energy_.ranges_far(); }
  std::vector<std::uint32_t> broken_corners() const override { return energy_.broken_corners(); }
  bool stays_broken(const Vertex_vector& d, double most) const override { return energy_.stays_broken(d, most); }
  void minimize_around(const std::vector<std::uint32_t>& seeds, const Edge_graph& graph, const Vertex_vector& target, Vertex_vector& u) override
  {
    energy_.minimize_around(seeds, graph, target, u);
  }

private:
  Patchwise_energy<NT> energy_;
};

} // namespace internal
} // namespace Conformal_equivalence
} // namespace CGAL

#endif // CGAL_CONFORMAL_EQUIVALENCE_INTERNAL_SOLVER_FIXED_ENERGY_H
